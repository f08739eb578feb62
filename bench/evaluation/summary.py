# SPDX-License-Identifier: Apache-2.0
"""From the records of runs to numbers: one dictionary a scene, which results.json holds and pages show."""
import numpy as np

from . import intervals, measures
from .measures import METRICS


def _median(values):
    return float(np.median(values)) if len(values) else None


def _statistics(record, section, name):
    return record["stats"].get("statistics", {}).get(section, {}).get(name)


def _run(record, errors):
    stats = record["stats"]
    return {"seed": record["seed"], "seconds": stats["seconds"]["render"], "load_seconds": stats["seconds"]["load"],
            "spp": _statistics(record, "render", "samples per pixel"),
            "samples_per_second": _statistics(record, "render", "camera paths per second"),
            "others_share": record["others"], "memory": record["memory"],
            "image": record["image"], **errors}


def _light_statistics(aovs, layers):
    """What happens at the points where lights are sampled: means over the pixels that have any."""
    if not aovs: return {}
    layer = layers(aovs["image"])
    lit = layer["lightcut.Y"] > 0
    if not lit.any(): return {}
    return {"lights drawn": float(layer["lightcut.Y"][lit].mean()),
            "entropy, bits": float(layer["lightentropy.Y"][lit].mean())}


def _with_end(record, run):
    """The points of a run's curve. Snapshots at times before the first sample of every pixel are one and the same."""
    points = []
    for p in [*record["curve"], {k: run[k] for k in ("seconds", "spp", *METRICS)}]:
        if not points or p["spp"] > points[-1]["spp"]: points.append(p)
    return points


def _mean_curve(curves):
    """Over repetitions. Those that are cut short by the first pass have fewer points; the ends correspond."""
    count = min(map(len, curves), default=0)
    return [{k: float(np.mean([p[k] for p in same])) for k in ("seconds", "spp", *METRICS)}
            for same in zip(*(c[-count:] for c in curves))] if count else []


def _efficiencies(runs, floor):
    result = {}
    for m in METRICS:
        own = [measures.over_floor(r[m], floor[m]) for r in runs]
        sure = own and all(e is not None for e in own)
        result[m] = intervals.efficiency(own, [r["seconds"] for r in runs]) if sure else None
    return result


def _against(base, other, cost, floor):
    """Pairs are runs with the same seed, made one after the other; cost(run) multiplies the error."""
    result = {}
    by_seed = {r["seed"]: r for r in base}
    pairs = [(by_seed[r["seed"]], r) for r in other if r["seed"] in by_seed]
    for m in METRICS:
        costs = [[measures.over_floor(r[m], floor[m]) for r in pair] for pair in pairs]
        sure = costs and all(c is not None for pair in costs for c in pair)
        result[m] = intervals.ratio_of_pairs(*zip(*[
            (a * cost(p), b * cost(q)) for (p, q), (a, b) in zip(pairs, costs)])) if sure else None
    return result


def _equal_samples(base, other, floor):
    """How many times smaller the error is than the base's, at the most samples that all runs of both have."""
    curves = [r["curve"] for r in base + other]
    if not all(curves): return None
    spp = min(c[-1]["spp"] for c in curves)
    if spp < max(c[0]["spp"] for c in curves): return None
    def runs(of): return [{"seed": r["seed"], **{m: measures.at_samples(r["curve"], spp, m) for m in METRICS}} for r in of]
    return {"spp": spp, **_against(runs(base), runs(other), lambda run: 1, floor)}


def _variant(variant, found, halves, floor, files):
    reference = (halves[0] + halves[1]) / 2
    pictures = [files.image(r["image"]) for r in found["runs"]]
    runs = [_run(r, measures.errors(p, reference)) for r, p in zip(found["runs"], pictures)]
    for run, record in zip(runs, found["runs"]): run["curve"] = _with_end(record, run)
    result = {"name": variant.name, "title": variant.title or variant.name, "define": variant.define,
              "failed": found["failed"], "runs": runs, "curve": _mean_curve([r["curve"] for r in runs])}
    if not runs: return result
    for key in ("seconds", "spp", "samples_per_second", "memory", "load_seconds", "others_share"):
        result[key] = _median([r[key] for r in runs if r[key] is not None])
    result["errors"] = {m: intervals.mean([r[m] for r in runs]) for m in METRICS}
    result["bias"] = measures.bias(pictures, halves)
    result["efficiency"] = _efficiencies(runs, floor)
    result["aovs"] = found["aovs"]["image"] if found["aovs"] else None
    result["light_statistics"] = _light_statistics(found["aovs"], files.layers)
    return result


def _facts(found):
    """What the program says of the scene and its light tree, from any run."""
    records = [r for f in found.values() for r in f["runs"]]
    def first(section, name):
        return next((v for v in (_statistics(r, section, name) for r in records) if v is not None), None)
    return {"lights": first("scene", "lights"), "triangles": first("scene", "triangles"),
            "tree_bytes": first("light tree", "bytes"), "tree_seconds": first("light tree", "build seconds")}


def scene(suite, scene, file_hash, references, found, files):
    """`files` reads the images that records name."""
    halves = [files.image(r["image"]) for r in references]
    floor = measures.floor_of(halves)
    variants = [_variant(v, found[v.name], halves, floor, files) for v in suite.scene_variants(scene)]
    base = next(v for v in variants if v["name"] == suite.scene_base(scene))
    for v in variants:
        v["against_base"] = _against(base["runs"], v["runs"], lambda run: run["seconds"], floor)
        v["equal_samples"] = _equal_samples(base["runs"], v["runs"], floor)
    return {"name": scene.name, "title": scene.title or scene.name, "hash": file_hash, "base": base["name"],
            "seconds": suite.scene_seconds(scene), "define": suite.scene_define(scene), **_facts(found),
            "counted_share": files.counted_share(),
            "reference": {"define": suite.scene_reference(scene).define, "images": [r["image"] for r in references],
                          "spp": [_statistics(r, "render", "samples per pixel") for r in references],
                          "seconds": sum(r["stats"]["seconds"]["render"] for r in references), "floor": floor},
            "variants": variants}


