# SPDX-License-Identifier: Apache-2.0
"""Do two runs of one suite tell the same?"""
from dataclasses import dataclass

from .plots import number


@dataclass(frozen=True)
class Pair:
    """What two runs say of a variant: times as efficient as its scene's base."""
    scene: str
    variant: str
    first: dict  # {"value", "ci"}
    second: dict

    @property
    def agrees(self):
        """Do the intervals have a number in common?"""
        (a, b), (c, d) = self.first["ci"], self.second["ci"]
        return a <= d and c <= b


def _ratios(results, metric):
    return {(s["name"], v["name"]): v["against_base"][metric] for s in results["scenes"] for v in s["variants"]
            if v["name"] != s["base"] and v["runs"] and v["against_base"][metric]}


def pairs(first, second, metric="trimmed"):
    """One for each ratio that both tell with an interval."""
    a, b = _ratios(first, metric), _ratios(second, metric)
    return [Pair(*key, a[key], b[key]) for key in a if key in b and a[key]["ci"] and b[key]["ci"]]


def table(compared):
    """For documents."""
    def told(e): return "%s× (%s – %s)" % (number(e["value"]), *(number(x, 2) for x in e["ci"]))
    yield "| scene | variant | first run | second run | |"
    yield "| --- | --- | ---: | ---: | --- |"
    for p in compared:
        yield "| %s | %s | %s | %s | %s |" % (
            p.scene, p.variant, told(p.first), told(p.second), "" if p.agrees else "**apart**")
