# SPDX-License-Identifier: Apache-2.0
"""Equal-time comparisons: suite -> runs (files) -> summary (results.json) -> page. See docs/evaluation.md."""
