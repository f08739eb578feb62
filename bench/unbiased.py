#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Holds adaptive direct lighting against brute force on the scenes of suites/brdf.json, with fewer lights, for
cut thresholds and sample counts from end to end.

usage: unbiased.py [--seeds N] [--scenes A,B] [--spp N] [--binary FILE]

Brute force samples every light at every point. It and the render that is tested have the same seeds, so the same
points of the image; the test is Student's t on the differences, per block of pixels and for the mean of the image.
Chance makes one of all tests of a run fail with a probability of ALARM, were the means normal."""
import argparse
import math
import os
import subprocess
import sys
import tempfile

import numpy as np

from evaluation import images, suite as suites

SCENES = {"cornell": 600, "exhibition": 1202, "spiral": 1200, "lamp": 1260, "staircase": 21}
THRESHOLDS, COUNTS = (.005, .05, .5, .7), (1, 7, 50)
SIZE, BLOCK = 24, 6  # pixels
ALARM = 1e-4
ADAPTIVE = ["integrator.strategy=adaptive", "lightsampler=brdf"]


def tail(t, freedom):
    """Probability that the absolute value of Student's t is larger."""
    angles = np.linspace(0, math.pi / 2, 20001)
    density = np.cos(angles) ** (freedom - 1)
    return float(np.trapz(np.where(angles >= math.atan(abs(t) / math.sqrt(freedom)), density, 0), angles) /
                 np.trapz(density, angles))


def render(binary, folder, scene, seed, spp, define):
    out = os.path.join(folder, "image.pfm")
    command = [binary, os.path.join(folder, scene + ".pbrt"), "--spp", str(spp), "--seed", str(seed), "-q", "--out", out]
    for d in ["integrator.maxdepth=1", "film.xresolution=%d" % SIZE, "film.yresolution=%d" % SIZE, *define]:
        command += ["-D", d]
    subprocess.run(command, check=True)
    return images.load(out).mean(axis=2)


def t_of(samples):
    """Along the first axis; 0 where nothing varies, as at pixels that show none but emitters."""
    error = samples.std(axis=0, ddof=1) / math.sqrt(len(samples))
    return np.divide(samples.mean(axis=0), error, out=np.zeros_like(error), where=error > 0)


def compare(differences):
    """(t of the blocks, t of the mean)."""
    n = SIZE // BLOCK
    blocks = differences.reshape(-1, n, BLOCK, n, BLOCK).mean(axis=(2, 4))
    return t_of(blocks).ravel(), float(t_of(blocks.mean(axis=(1, 2))))


def main():
    p = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    p.add_argument("--binary", default=os.path.join(suites.ROOT, "build", "release", "lampyris"))
    p.add_argument("--seeds", type=int, default=24, help="pairs of renders (24)")
    p.add_argument("--spp", type=int, default=4, help="samples a pixel of each (4)")
    p.add_argument("--scenes", help="only these, separated by commas")
    args = p.parse_args()
    scenes = args.scenes.split(",") if args.scenes else list(SCENES)
    configurations = [(d, n) for d in THRESHOLDS for n in COUNTS]
    tests = len(scenes) * len(configurations) * ((SIZE // BLOCK) ** 2 + 1)
    failed = 0
    print("| scene | δ | N_max | mean to brute force | t of the mean | largest t of a block |\n|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        generate = os.path.join(suites.ROOT, "scenes", "generate.py")
        subprocess.run([sys.executable, generate, "glossy", folder, *("%s=%d" % (s, SCENES[s]) for s in scenes)], check=True)
        seeds = range(1, args.seeds + 1)
        for scene in scenes:
            truth = np.array([render(args.binary, folder, scene, k, args.spp, ["integrator.strategy=all"]) for k in seeds])
            for threshold, count in configurations:
                define = ADAPTIVE + ["lightsampler.cutthreshold=%g" % threshold, "integrator.maxbrdfsamples=%d" % count]
                mine = np.array([render(args.binary, folder, scene, k, args.spp, define) for k in seeds])
                blocks, mean = compare(mine - truth)
                wrong = tail(max(abs(mean), *abs(blocks)), args.seeds - 1) * tests < ALARM
                failed += wrong
                print("| %s | %g | %d | %.4f | %.1f | %.1f%s |" % (
                    scene, threshold, count, mine.mean() / truth.mean(), mean, abs(blocks).max(),
                    " FAILED" if wrong else ""), flush=True)
    sys.exit("%d configurations are biased" % failed if failed else 0)


if __name__ == "__main__":
    main()
