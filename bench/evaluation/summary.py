# SPDX-License-Identifier: Apache-2.0
"""From the records of runs to numbers: one dictionary a scene, which results.json holds and pages show."""
import numpy as np

from . import measures
from .measures import METRICS


def _median(values):
    return float(np.median(values)) if len(values) else None


def _statistics(record, section, name):
    return record["stats"].get("statistics", {}).get(section, {}).get(name)


def _cut_statistics(runs):
    """Whatever the program says of light cuts, whichever section it is in: medians over the runs."""
    found = {}
    for r in runs:
        for section, entries in r["stats"].get("statistics", {}).items():
            for name, value in entries.items():
                words = ("%s %s" % (section, name)).lower().replace("-", " ").split()
                if isinstance(value, (int, float)) and "cut" in words:
                    found.setdefault(name, []).append(value)
    return {name: _median(values) for name, values in found.items()}


def _run(record, errors):
    stats = record["stats"]
    return {"seed": record["seed"], "seconds": stats["seconds"]["render"], "load_seconds": stats["seconds"]["load"],
            "spp": _statistics(record, "render", "samples per pixel"),
            "samples_per_second": _statistics(record, "render", "camera paths per second"),
            "others_share": record["others"], "memory": record["memory"],
            "image": record["image"], **errors}


def _mean_curve(curves, load, reference):
    """At each number of samples the mean over repetitions of time and errors; errors of each repetition too."""
    points = []
    for same in zip(*curves):
        errors = [measures.errors(load(p["image"]), reference) for p in same]
        points.append({"spp": same[0]["spp"], "seconds": float(np.mean([p["seconds"] for p in same])),
                       "each": errors, **{m: float(np.mean([e[m] for e in errors])) for m in METRICS}})
    return points


def _efficiencies(runs, floor):
    result = {}
    for m in METRICS:
        own = [measures.over_floor(r[m], floor[m]) for r in runs]
        sure = own and all(e is not None for e in own)
        result[m] = measures.efficiency(own, [r["seconds"] for r in runs]) if sure else None
    return result


def _against(base, other, cost, floor):
    """Pairs are runs with the same seed, made one after the other; cost(run) multiplies the error."""
    result = {}
    by_seed = {r["seed"]: r for r in base}
    pairs = [(by_seed[r["seed"]], r) for r in other if r["seed"] in by_seed]
    for m in METRICS:
        costs = [[measures.over_floor(r[m], floor[m]) for r in pair] for pair in pairs]
        sure = costs and all(c is not None for pair in costs for c in pair)
        result[m] = measures.ratio_of_pairs(*zip(*[
            (a * cost(p), b * cost(q)) for (p, q), (a, b) in zip(pairs, costs)])) if sure else None
    return result


def _equal_samples(base, other, floor):
    """At the most samples that curves have: how many times smaller the error is than the base's."""
    if not base or not other or base[-1]["spp"] != other[-1]["spp"]: return None
    def runs(point): return [{"seed": k, **e} for k, e in enumerate(point["each"])]
    return {"spp": other[-1]["spp"], **_against(runs(base[-1]), runs(other[-1]), lambda run: 1, floor)}


def _variant(variant, found, halves, floor, load):
    reference = (halves[0] + halves[1]) / 2
    pictures = [load(r["image"]) for r in found["runs"]]
    runs = [_run(r, measures.errors(p, reference)) for r, p in zip(found["runs"], pictures)]
    result = {"name": variant.name, "title": variant.title or variant.name, "define": variant.define,
              "failed": found["failed"], "runs": runs, "curve": _mean_curve(found["curves"], load, reference)}
    if not runs: return result
    for key in ("seconds", "spp", "samples_per_second", "memory", "load_seconds", "others_share"):
        result[key] = _median([r[key] for r in runs if r[key] is not None])
    result["errors"] = {m: measures.mean([r[m] for r in runs]) for m in METRICS}
    result["bias"] = measures.bias(pictures, halves)
    result["efficiency"] = _efficiencies(runs, floor)
    result["light_cut"] = _cut_statistics(found["runs"])
    return result


def _facts(found):
    """What the program says of the scene and its light tree, from any run."""
    records = [r for f in found.values() for r in f["runs"]]
    def first(section, name):
        return next((v for v in (_statistics(r, section, name) for r in records) if v is not None), None)
    return {"lights": first("scene", "lights"), "triangles": first("scene", "triangles"),
            "tree_bytes": first("light tree", "bytes"), "tree_seconds": first("light tree", "build seconds")}


def scene(suite, scene, file_hash, references, found, load):
    """`load` gives the image of a record's file name."""
    halves = [load(r["image"]) for r in references]
    floor = measures.floor_of(halves)
    variants = [_variant(v, found[v.name], halves, floor, load) for v in suite.scene_variants(scene)]
    base = next(v for v in variants if v["name"] == suite.scene_base(scene))
    for v in variants:
        v["against_base"] = _against(base["runs"], v["runs"], lambda run: run["seconds"], floor)
        v["equal_samples"] = _equal_samples(base["curve"], v["curve"], floor)
    return {"name": scene.name, "title": scene.title or scene.name, "hash": file_hash, "base": base["name"],
            "seconds": suite.scene_seconds(scene), "define": suite.scene_define(scene), **_facts(found),
            "reference": {"define": suite.scene_reference(scene).define, "images": [r["image"] for r in references],
                          "spp": [_statistics(r, "render", "samples per pixel") for r in references],
                          "seconds": sum(r["stats"]["seconds"]["render"] for r in references), "floor": floor},
            "variants": variants}


