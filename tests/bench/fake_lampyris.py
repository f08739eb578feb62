#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Stands in for the program: a grey image with noise whose variance the scene file and -D tell.

The scene holds numbers: "seconds of a sample". -D fake.variance, fake.bias and fake.fail make variants."""
import array
import json
import math
import random
import sys


def options(arguments):
    values, defines, k = {}, {}, 1
    while k < len(arguments):
        if arguments[k] == "-D":
            name, _, value = arguments[k + 1].partition("=")
            defines[name] = float(value)
            k += 2
        elif arguments[k].startswith("--"):
            values[arguments[k]] = arguments[k + 1]
            k += 2
        else: k += 1
    return values, defines


def main():
    if "--version" in sys.argv: return print("fake 1")
    values, defines = options(sys.argv[1:])
    with open(sys.argv[0] + ".calls", "a") as f: f.write(" ".join(sys.argv[1:]) + "\n")
    if defines.get("fake.fail"): sys.exit("error: this one always fails")
    with open(sys.argv[1]) as f: sample_seconds = float(f.read()) * defines.get("fake.cost", 1)
    spp = int(values["--spp"]) if "--spp" in values else round(float(values["--seconds"]) / sample_seconds)
    rng = random.Random("%s %s" % (values["--seed"], defines))
    sigma, mean = math.sqrt(defines["fake.variance"] / spp), 1 + defines.get("fake.bias", 0)
    pixels = array.array("f", (rng.gauss(mean, sigma) for _ in range(24 * 32 * 3)))
    with open(values["--out"], "wb") as f: f.write(b"PF\n32 24\n-1.0\n" + pixels.tobytes())
    stats = {"seconds": {"load": .01, "render": spp * sample_seconds}, "statistics": {
        "scene": {"lights": 3, "triangles": 12}, "light cut": {"mean lights": 4.5},
        "render": {"samples per pixel": spp, "camera paths per second": 768 / sample_seconds}}}
    with open(values["--stats"], "w") as f: json.dump(stats, f)


if __name__ == "__main__":
    main()
