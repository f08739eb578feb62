#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Stands in for the program: a grey image with noise whose variance the scene file and -D tell.

The scene holds numbers: "seconds of a sample". -D fake.variance, fake.bias and fake.fail make variants."""
import array
import json
import math
import random
import struct
import sys

WIDTH, HEIGHT = 32, 24
AOVS = {"lightcut": 4.5, "lightentropy": 2, "bsdfshare": .25, "pathlength": 3, "time": 20}


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


def pixels_of(rng, defines, spp):
    sigma, mean = math.sqrt(defines["fake.variance"] / spp), 1 + defines.get("fake.bias", 0)
    return [[rng.gauss(mean, sigma) for _ in range(WIDTH * HEIGHT)] for _ in "RGB"]


def write_pfm(path, planes):
    flat = array.array("f", (v for pixel in zip(*planes) for v in pixel))
    with open(path, "wb") as f: f.write(b"PF\n%d %d\n-1.0\n" % (WIDTH, HEIGHT) + flat.tobytes())


def write_exr(path, planes):
    """{channel: values}, 32 bit, not compressed, a line a block."""
    names = sorted(planes)

    def attribute(name, kind, data): return b"%s\0%s\0" % (name, kind) + struct.pack("<i", len(data)) + data
    channels = b"".join(n.encode() + b"\0" + struct.pack("<iiii", 2, 0, 1, 1) for n in names) + b"\0"
    window = struct.pack("<4i", 0, 0, WIDTH - 1, HEIGHT - 1)
    header = struct.pack("<ii", 20000630, 2) + attribute(b"channels", b"chlist", channels) + attribute(
        b"compression", b"compression", b"\0") + attribute(b"dataWindow", b"box2i", window) + b"\0"
    size = 4 * WIDTH * len(names)
    start = len(header) + 8 * HEIGHT
    with open(path, "wb") as f:
        f.write(header + struct.pack("<%dQ" % HEIGHT, *(start + y * (8 + size) for y in range(HEIGHT))))
        for y in range(HEIGHT):
            f.write(struct.pack("<ii", y, size))
            for n in names: f.write(array.array("f", planes[n][y * WIDTH:(y + 1) * WIDTH]).tobytes())


def write_image(path, planes, aovs):
    if path.endswith(".pfm"): return write_pfm(path, planes)
    layers = {a + ".Y": [value] * (WIDTH * HEIGHT) for a, value in AOVS.items() if a in aovs}
    if "variance" in aovs: layers.update({"variance." + c: [.01] * (WIDTH * HEIGHT) for c in "RGB"})
    write_exr(path, {**dict(zip("RGB", planes)), **layers})


def main():
    if "--version" in sys.argv: return print("fake 1")
    values, defines = options(sys.argv[1:])
    with open(sys.argv[0] + ".calls", "a") as f: f.write(" ".join(sys.argv[1:]) + "\n")
    if defines.get("fake.fail"): sys.exit("error: this one always fails")
    with open(sys.argv[1]) as f: sample_seconds = float(f.read()) * defines.get("fake.cost", 1)
    spp = int(values["--spp"]) if "--spp" in values else round(float(values["--seconds"]) / sample_seconds)
    rng = random.Random("%s %s" % (values["--seed"], defines))
    def write(path, spp): write_image(path, pixels_of(rng, defines, spp), values.get("--aov", "").split(","))
    write(values["--out"], spp)
    snapshots = []
    for name in filter(None, values.get("--snapshots", "").split(",")):
        file, reached = values["--out"].replace(".pfm", "-%s.exr" % name), max(1, round(float(name[:-1]) / sample_seconds))
        write(file, reached)
        snapshots.append({"name": name, "seconds": reached * sample_seconds, "spp": reached, "file": file})
    stats = {"snapshots": snapshots, "seconds": {"load": .01, "render": spp * sample_seconds}, "statistics": {
        "scene": {"lights": 3, "triangles": 12},
        "render": {"samples per pixel": spp, "camera paths per second": 768 / sample_seconds}}}
    with open(values["--stats"], "w") as f: json.dump(stats, f)


if __name__ == "__main__":
    main()
