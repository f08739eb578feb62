#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Makes the example scenes, and large ones for benchmarks.

usage: generate.py quickstart [FOLDER]         scenes/quickstart.pbrt and its mesh
       generate.py room FOLDER [SPHERES]       a closed room of 150,000 triangles with sphere lights
       generate.py points FILE [COUNT]         COUNT point lights under a ceiling (1.6 million: 141 MB)
       generate.py thesis FOLDER [NAME[=COUNT] ...]     the scenes of Ma's thesis, with COUNT lights
       generate.py glossy FOLDER [NAME[=COUNT] ...]     small emitters that glossy surfaces show as highlights
       generate.py splitting FOLDER [NAME[=COUNT] ...]  emitters in groups close to what they light
       generate.py guided FOLDER [NAME[=WIDTH] ...]     light that is hard to find, WIDTH pixels wide
"""
import os
import sys

from generator import benchmarks, glossy, guided, quickstart, splitting, thesis

HERE = os.path.dirname(os.path.abspath(__file__))


def family(scenes, folder, wanted):
    for item in wanted or scenes.SCENES:
        name, _, count = item.partition("=")
        if name not in scenes.SCENES: sys.exit("no scene '%s'; there are: %s" % (name, ", ".join(scenes.SCENES)))
        if count and not (count.isdigit() and int(count) > 0): sys.exit("'%s' is no number of lights" % count)
        scenes.write(folder, name, int(count) if count else None)


def main():
    kind, args = sys.argv[1:2], sys.argv[2:]
    if {"-h", "--help"} & set(sys.argv[1:]): print(__doc__)
    elif kind == ["quickstart"] and len(args) <= 1: quickstart.quickstart(args[0] if args else HERE)
    elif kind == ["room"] and 1 <= len(args) <= 2: benchmarks.room(args[0], int(args[1]) if args[1:] else 1494)
    elif kind == ["points"] and 1 <= len(args) <= 2: benchmarks.points(args[0], int(args[1]) if args[1:] else 1600000)
    elif kind == ["thesis"] and args: family(thesis, args[0], args[1:])
    elif kind == ["glossy"] and args: family(glossy, args[0], args[1:])
    elif kind == ["splitting"] and args: family(splitting, args[0], args[1:])
    elif kind == ["guided"] and args: family(guided, args[0], args[1:])
    else: sys.exit(__doc__)


if __name__ == "__main__":
    main()
