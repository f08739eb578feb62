# SPDX-License-Identifier: Apache-2.0
"""Which renders a scene of a suite needs, and in which order."""
import os

from .runs import Failed, Task, key_of

REFERENCE_SEED = 1000000  # runs have the seeds 1, 2, …: a reference must be independent of them


def reference_halves(runner, suite, scene, file):
    wanted = suite.scene_reference(scene)
    limit = ("--seconds", "%g" % wanted.seconds) if wanted.seconds else ("--spp", str(wanted.spp))
    define = tuple(suite.scene_define(scene) + wanted.define)
    # Named by what they are made from: scenes of a suite that differ in their variants only share them.
    stem = os.path.splitext(os.path.basename(file))[0]
    where = "references/%s-%s" % (stem, key_of(runner.scene_hash(file), define, limit)[:8])
    return [runner.render(Task("%s-%d" % (where, k), file, define, limit, REFERENCE_SEED + k),
                          depends_on_binary=False) for k in (0, 1)]


def curve_points(runner, where, file, define, spps, seed):
    """Renders with each number of samples: [{"spp", "seconds", "image"}]."""
    points = []
    for spp in sorted(spps):
        record = runner.render(Task("%s-spp%d" % (where, spp), file, define, ("--spp", str(spp)), seed))
        points.append({"spp": spp, "seconds": record["stats"]["seconds"]["render"], "image": record["image"]})
    return points


def scene_runs(runner, suite, scene, file):
    """{variant: {"runs": [record], "curves": [points], "failed": text}}.

    A repetition runs every variant once before the next begins, and each begins with another variant: what
    else the machine does in the meantime befalls all alike."""
    variants = suite.scene_variants(scene)
    found = {v.name: {"runs": [], "curves": [], "failed": ""} for v in variants}
    curve = suite.scene_curve(scene)
    seconds = "%g" % suite.scene_seconds(scene)

    def attempt(variant, action):
        if found[variant.name]["failed"]: return
        try: action(found[variant.name], tuple(suite.scene_define(scene) + variant.define))
        except Failed as e:
            found[variant.name]["failed"] = str(e)
            runner.say("    %s failed: %s" % (variant.name, e))

    for k in range(max(suite.repetitions, curve.repetitions if curve.spp else 0)):
        first = k % len(variants)
        for v in variants[first:] + variants[:first]:
            where = "runs/%s/%s/%02d" % (scene.name, v.name, k)
            if k < suite.repetitions:
                attempt(v, lambda f, define: f["runs"].append(
                    runner.render(Task(where, file, define, ("--seconds", seconds), k + 1))))
            if curve.spp and k < curve.repetitions:
                attempt(v, lambda f, define: f["curves"].append(
                    curve_points(runner, where, file, define, curve.spp, k + 1)))
    return found
