#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Renders scene files with the light sampler bvh and, for the same time, with pbrt-v3's (spatial): a picture of each
scene on one sheet, and a table of how many times more efficient the first is.

usage: contact_sheet.py SCENE.pbrt ... [--out DIR] [--width 160] [--seconds 4] ...

Writes DIR/results.json, which report.py shows as a page, and DIR/sheet.png; prints the table as Markdown. Interrupted, it
goes on where it was. Scenes keep their integrator if it is path, volpath or directlighting, else path takes its place.
Needs matplotlib (Debian: python3-matplotlib)."""
import argparse
import json
import math
import os
import re
import sys

import equal_time
from evaluation import images, suite as suites, tables

KEPT = ("path", "volpath", "directlighting")
DEFAULT = {"xresolution": 1280, "yresolution": 720, "maxdepth": 5}


def arguments():
    p = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    p.add_argument("scenes", nargs="+", metavar="SCENE.pbrt")
    p.add_argument("--out", default=os.path.join(suites.ROOT, "build", "bench", "contact-sheet"), help="folder (build/bench/contact-sheet)")
    p.add_argument("--binary", default=os.path.join(suites.ROOT, "build", "release", "lampyris"))
    p.add_argument("--width", type=int, default=160, help="pixels of an image's longer side (160)")
    p.add_argument("--depth", type=int, default=8, help="longest paths, unless the scene's are shorter (8)")
    p.add_argument("--seconds", type=float, default=4, help="of each run (4)")
    p.add_argument("--repetitions", type=int, default=3, help="of each run (3)")
    p.add_argument("--reference-seconds", type=float, default=12, help="of each half of a reference (12)")
    p.add_argument("--columns", type=int, default=5, help="pictures in a row of the sheet (5)")
    return p.parse_args()


def name_of(path):
    """That of the file, or of its folder where all are called scene.pbrt."""
    stem = os.path.splitext(os.path.basename(path))[0]
    return os.path.basename(os.path.dirname(os.path.abspath(path))) if stem == "scene" else stem


def definitions(path, width, depth):
    """What makes the scene small enough. Options are looked for in the file itself, not in those it includes."""
    with open(path, errors="replace") as f: head = re.sub(r"#.*", "", f.read()).partition("WorldBegin")[0]
    def number(name):
        found = re.search(r'"integer %s"\s*\[?\s*(\d+)' % name, head)
        return int(found.group(1)) if found else DEFAULT[name]
    size = number("xresolution"), number("yresolution")
    integrator = re.search(r'^\s*Integrator\s+"([^"]*)"', head, re.M)
    define = ["film.%sresolution=%d" % (axis, max(1, round(n * width / max(size)))) for axis, n in zip("xy", size)]
    define.append("integrator.maxdepth=%d" % min(depth, number("maxdepth")))
    return define if integrator is None or integrator.group(1) in KEPT else define + ["integrator=path"]


def suite_of(args):
    scenes = [{"name": name_of(s), "file": os.path.abspath(s), "define": definitions(s, args.width, args.depth)} for s in args.scenes]
    variants = [{"name": n, "define": ["lightsampler=" + n]} for n in ("spatial", "bvh")]
    return suites.parse({"name": "contact-sheet", "title": "Contact sheet", "base": "spatial", "variants": variants,
                         "seconds": args.seconds, "repetitions": args.repetitions, "scenes": scenes,
                         "reference": {"define": ["lightsampler=bvh"], "seconds": args.reference_seconds}})


def table(scenes, pictures):
    rows = [("scene", "resolution", "lights", "seconds", "spp, spatial", "spp, bvh", "efficiency of bvh"), ("---",) + ("---:",) * 6]
    for s, picture in zip(scenes, pictures):
        spatial, bvh = s["variants"]
        if not spatial["runs"] or not bvh["runs"]: rows.append((s["name"], "", "", "", "failed", "", ""))
        else: rows.append((s["name"], "%d × %d" % picture.shape[1::-1], "%d" % (s["lights"] or 0), "%.1f" % bvh["seconds"],
                           "%.0f" % spatial["spp"], "%.0f" % bvh["spp"], "%s (%s)" % tables.times(bvh["against_base"]["trimmed"])))
    return "\n".join("| %s |" % " | ".join(r) for r in rows)


def sheet(path, scenes, pictures, columns):
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    columns = min(columns, len(scenes))
    figure, axes = pyplot.subplots(math.ceil(len(scenes) / columns), columns, squeeze=False, layout="constrained",
                                   figsize=(2.4 * columns, 2.2 * math.ceil(len(scenes) / columns)))
    for each in axes.flat: each.axis("off")
    for each, s, picture in zip(axes.flat, scenes, pictures):
        each.imshow(images.tone_mapped(picture, images.exposure_for(picture)))
        each.set_title(s["name"], fontsize=8)
    figure.savefig(path, dpi=150)


def main():
    args = arguments()
    try: suite = suite_of(args)
    except (suites.SuiteError, OSError) as e: sys.exit("error: %s" % e)
    with open(equal_time.run(suite, args.binary, args.out)) as f: scenes = json.load(f)["scenes"]
    folder = images.Folder(args.out)
    pictures = [sum(map(folder.image, s["reference"]["images"])) / 2 for s in scenes]
    print(table(scenes, pictures))
    path = os.path.join(args.out, "sheet.png")
    sheet(path, scenes, pictures, args.columns)
    print(path)


if __name__ == "__main__":
    main()
