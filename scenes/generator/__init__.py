# SPDX-License-Identifier: Apache-2.0
"""The example scenes and those for benchmarks, one module a family."""
