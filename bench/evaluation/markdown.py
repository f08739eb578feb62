# SPDX-License-Identifier: Apache-2.0
"""The overview of a page as text for the documentation, with the same numbers."""
from . import tables
from .plots import count


def _entry(scene, variant):
    if variant is None: return ""
    if not variant["runs"]: return "failed"
    if variant["name"] == scene["base"]: return "1"
    ratio, ends = tables.times(variant["against_base"]["trimmed"])
    return "%s (%s)" % (ratio, ends) if ends else ratio


def overview(results):
    """Efficiency of each variant in each scene, as a multiple of the scene's base, with its interval."""
    titles, base = tables.columns(results)
    rows = [["scene", "lights", *titles.values()], ["---"] + ["---:"] * (1 + len(titles))]
    for s in results["scenes"]:
        by_name = {v["name"]: v for v in s["variants"]}
        rows.append([s["title"], count(s["lights"]), *(_entry(s, by_name.get(n)) for n in titles)])
    mean = tables.mean_entries(results["scenes"], titles, base)
    if mean: rows.append([mean[0], "", *mean[1]])
    return "\n".join("| %s |" % " | ".join(r) for r in rows)
