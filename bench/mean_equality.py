#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Do two integrators have the same mean? Renders scenes with both and compares blocks of pixels.

usage: mean_equality.py SCENE.pbrt|FOLDER ... [--other guidedpath] [--spp 32] [-D kind.parameter=value ...]

Takes the scenes whose integrator is "path" or "volpath", with @SPP@ and @OUT@ in place of numbers and file names if
they are templates; folders that are absent are skipped. A block's difference over
its standard error (of the samples of both, drawn by the random sampler, so that they are independent) is normal where
the means agree. A scene fails if in the same block and channel two renders with fresh seeds both exceed the bound that
one of the blocks exceeds with the probability 1e-3: by chance once in a million scenes, or less."""
import argparse
import glob
import os
import re
import subprocess
import sys
import tempfile
from statistics import NormalDist

import numpy as np

from evaluation import exr, suite

BLOCK = 12
ALARM = 1e-3


def arguments():
    p = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    p.add_argument("scenes", nargs="+")
    p.add_argument("--other", default="guidedpath", help="integrator in place of the scene's")
    p.add_argument("--spp", type=int, default=32)
    p.add_argument("-D", dest="overrides", action="append", default=[], help="for the other integrator alone")
    p.add_argument("--binary", default=os.path.join(suite.ROOT, "build", "release", "lampyris"))
    return p.parse_args()


def scene_files(names):
    for name in names:
        if not os.path.exists(name): print("%s: not there, skipped" % name)
        for f in sorted(glob.glob(os.path.join(name, "*.pbrt"))) if os.path.isdir(name) else [name]:
            if os.path.isfile(f) and not os.path.basename(f).startswith("_") and re.search(r'^\s*Integrator\s+"(path|volpath)"', open(f).read(), re.M): yield f


def blocks(channel):
    rows, columns = (n // BLOCK * BLOCK for n in channel.shape)
    cut = channel[:rows, :columns].astype(float)
    return cut.reshape(rows // BLOCK, BLOCK, columns // BLOCK, BLOCK).sum((1, 3))


def render(args, scene, seed, overrides):
    """Sums over blocks of the image, and of the squared standard errors: [channel, row, column]."""
    with tempfile.TemporaryDirectory() as folder:
        out = os.path.join(folder, "a.exr")
        command = [args.binary, "-", "-q", "-o", out, "--spp", str(args.spp), "--seed", str(seed), "--aov", "variance",
                   "-D", "sampler=random"]
        for o in overrides: command += ["-D", o]
        with open(scene) as f: text = f.read().replace("@SPP@", str(args.spp)).replace("@OUT@", "image.exr")
        done = subprocess.run(command, input=text, cwd=os.path.dirname(scene) or ".", capture_output=True, text=True)
        if done.returncode: sys.exit("%s: %s" % (scene, done.stderr))
        layers = exr.read(out)
    return (np.stack([blocks(layers[c]) for c in "RGB"]), np.stack([blocks(layers["variance." + c]) for c in "RGB"]))


def scores(args, scene, seed):
    own, own_errors = render(args, scene, seed, [])
    other, other_errors = render(args, scene, seed + 1, ["integrator=" + args.other, *args.overrides])
    # Where nothing is random, rounding differs.
    error = np.sqrt(own_errors + other_errors) + 1e-5 * np.abs(own)
    return np.divide(other - own, error, out=np.zeros_like(own), where=error > 0)


def main():
    args = arguments()
    failed = count = 0
    for scene in scene_files(args.scenes):
        count += 1
        z = scores(args, scene, 100)
        bound = NormalDist().inv_cdf(1 - ALARM / 2 / z.size)
        suspect = np.abs(z) > bound
        verdict = "same"
        if suspect.any():
            again = scores(args, scene, 200)
            confirmed = suspect & (np.abs(again) > bound) & (np.sign(again) == np.sign(z))
            verdict = "DIFFERENT" if confirmed.any() else "same (%d suspect, not confirmed)" % suspect.sum()
            failed += confirmed.any()
        print("%-36s %4d blocks  rms z %.2f  most %5.2f of %.2f  %s" % (
            os.path.basename(scene), z.size, np.sqrt((z ** 2).mean()), np.abs(z).max(), bound, verdict), flush=True)
    print("%d scenes, %d different" % (count, failed))
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
