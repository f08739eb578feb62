# SPDX-License-Identifier: Apache-2.0
"""The overview of a page as text for the documentation, with the same numbers."""
from . import tables
from .plots import count


def _efficiency(variant):
    return tables.times(variant["against_base"]["trimmed"])


def _rmse(variant):
    """In relation to the base's at the same time, hence below 1 where it is better."""
    ratio = variant["against_base"]["mse"]
    if not ratio: return "–", ""
    low, high = ratio["ci"] or (None, None)
    return "%.2f" % ratio["value"] ** -.5, "%.2f – %.2f" % (high ** -.5, low ** -.5) if low else ""


def _entry(scene, variant, told):
    if variant is None: return ""
    if not variant["runs"]: return "failed"
    if variant["name"] == scene["base"]: return "1"
    ratio, ends = told(variant)
    return "%s (%s)" % (ratio, ends) if ends else ratio


def rmse(results):
    """RMSE of each variant in each scene at equal time, as a multiple of that of the scene's base, with its interval."""
    return _table(results, _rmse, lambda *_: None)


def overview(results):
    """Efficiency of each variant in each scene, as a multiple of the scene's base, with its interval."""
    return _table(results, _efficiency, tables.mean_entries)


def _table(results, told, mean_entries):
    titles, base = tables.columns(results)
    rows = [["scene", "lights", *titles.values()], ["---"] + ["---:"] * (1 + len(titles))]
    for s in results["scenes"]:
        by_name = {v["name"]: v for v in s["variants"]}
        rows.append([s["title"], count(s["lights"]), *(_entry(s, by_name.get(n), told) for n in titles)])
    mean = mean_entries(results["scenes"], titles, base)
    if mean: rows.append([mean[0], "", *mean[1]])
    return "\n".join("| %s |" % " | ".join(r) for r in rows)
