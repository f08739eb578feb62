# SPDX-License-Identifier: Apache-2.0
"""Which renders a scene of a suite needs, and in which order."""
import os

from . import images, measures
from .runs import Failed, Task, content_hash, key_of
from .suite import AOV_SHARE

AOVS = ("lightcut", "bsdfshare", "lightentropy", "variance", "pathlength", "time")
AOV_SEED = 0
REFERENCE_SEED = 1000000  # above those of runs: a reference must be independent of them


def reference_halves(runner, suite, scene, file):
    wanted = suite.scene_reference(scene)
    limit = ("--seconds", "%g" % wanted.seconds) if wanted.seconds else ("--spp", str(wanted.spp))
    define = tuple(suite.scene_define(scene) + wanted.define)
    # Named by what they are made from: scenes of a suite that differ in their variants only share them.
    stem = os.path.splitext(os.path.basename(file))[0]
    where = "references/%s-%s" % (stem, key_of(runner.scene_hash(file), define, limit)[:8])
    return [runner.render(Task("%s-%d" % (where, k), file, define, limit, REFERENCE_SEED + k),
                          depends_on_binary=False) for k in (0, 1)]


def mask(runner, suite, scene, file):
    """None, or an array [row, column, 1]: 0 where a pixel counts nowhere, else 1."""
    if not suite.mask: return None
    define, limit = tuple(suite.scene_define(scene) + suite.mask.define), ("--spp", str(suite.mask.spp))
    key = key_of(runner.scene_hash(file), define, limit)[:8]
    stem = os.path.splitext(os.path.basename(file))[0]
    record = runner.render(Task("references/%s-%s-mask" % (stem, key), file, define, limit, REFERENCE_SEED),
                           depends_on_binary=False)
    return (images.load(runner.path(record["image"])).max(axis=2, keepdims=True) == 0).astype(float)


def held_against(reference, files):
    """What makes of a record's snapshots the points of a curve: their errors stay, their images go."""
    def digest(record):
        record["curve"] = []
        for shot in record["stats"].get("snapshots", []):
            errors = measures.errors(files.image(shot["file"]), reference)
            record["curve"].append({"seconds": shot["seconds"], "spp": shot["spp"], **errors})
            os.remove(shot["file"])
    return digest


def scene_runs(runner, suite, scene, file, references, files, first_seed=1):
    """{variant: {"runs": [record], "aovs": record or None, "failed": text}}.

    A repetition runs every variant once before the next begins, and each begins with another variant: what
    else the machine does in the meantime befalls all alike."""
    variants = suite.scene_variants(scene)
    found = {v.name: {"runs": [], "aovs": None, "failed": ""} for v in variants}
    paths = [runner.path(r["image"]) for r in references]
    judge = key_of(*map(content_hash, paths), files.counted_share())
    digest = held_against(sum(map(files.image, paths)) / len(paths), files)
    seconds, snapshots = suite.scene_seconds(scene), tuple(suite.snapshot_seconds(scene))

    def attempt(variant, name, limit, **options):
        if found[variant.name]["failed"]: return None
        define = tuple(suite.scene_define(scene) + variant.define)
        task = Task("runs/%s/%s/%s" % (scene.name, variant.name, name), file, define, ("--seconds", "%g" % limit), **options)
        try: return runner.render(task, digest=digest)
        except Failed as e:
            found[variant.name]["failed"] = str(e)
            runner.say("    %s failed: %s" % (variant.name, e))

    for k in range(suite.repetitions):
        first = k % len(variants)
        for v in variants[first:] + variants[:first]:
            record = attempt(v, "%02d" % k, seconds, seed=first_seed + k, snapshots=snapshots, judge=judge)
            if record: found[v.name]["runs"].append(record)
    for v in variants:
        found[v.name]["aovs"] = attempt(v, "aovs", seconds * AOV_SHARE, seed=AOV_SEED, aovs=AOVS)
    return found
