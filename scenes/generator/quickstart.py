# SPDX-License-Identifier: Apache-2.0
"""The scene of the README: a knot among glow-worms."""
import math
import os
import random

from .geometry import glow_worm, scaled, sphere, torus_knot, write_ply


def quickstart(folder):
    rng = random.Random(7)
    os.makedirs(os.path.join(folder, "models"), exist_ok=True)
    write_ply(os.path.join(folder, "models", "knot.ply"), *torus_knot(2, 3, 240, 20, 0.15))
    out = ['''# Glow-worms: a golden knot, glass and lacquer, lit by 480 small lights and a dim night sky.
# Made by generate.py.

LookAt 0 -7.6 2.35  0 0 1.02  0 0 1
Camera "perspective" "float fov" 31
Sampler "bluenoise" "integer pixelsamples" 64
Integrator "path" "integer maxdepth" 6 "string lightsampler" "bvh"
PixelFilter "gaussian" "float xwidth" 1.5 "float ywidth" 1.5
Film "image" "string filename" "quickstart.exr" "float scale" 1.3 "integer xresolution" 800 "integer yresolution" 450

WorldBegin

LightSource "infinite" "rgb L" [.012 .018 .04]

MakeNamedMaterial "floor" "string type" "substrate" "rgb Kd" [.09 .085 .1] "rgb Ks" [.22 .22 .22]
  "float uroughness" .06 "float vroughness" .06
MakeNamedMaterial "backdrop" "string type" "matte" "rgb Kd" [.22 .2 .3] "float sigma" 20
MakeNamedMaterial "gold" "string type" "metal" "rgb eta" [.17 .35 1.5] "rgb k" [3.1 2.7 1.9] "float roughness" .05
MakeNamedMaterial "glass" "string type" "glass" "float eta" 1.5
MakeNamedMaterial "red" "string type" "plastic" "rgb Kd" [.5 .03 .03] "rgb Ks" [.3 .3 .3] "float roughness" .02
MakeNamedMaterial "teal" "string type" "plastic" "rgb Kd" [.02 .25 .28] "rgb Ks" [.2 .2 .2] "float roughness" .15
MakeNamedMaterial "chalk" "string type" "matte" "rgb Kd" [.75 .72 .68] "float sigma" 30
MakeNamedMaterial "steel" "string type" "metal" "rgb eta" [2.9 2.9 2.6] "rgb k" [3.1 3.3 3.4] "float roughness" .1
''']
    out.append('''
NamedMaterial "floor"
Shape "trianglemesh" "integer indices" [0 1 2 0 2 3] "point P" [-30 -30 0  30 -30 0  30 30 0  -30 30 0]
NamedMaterial "backdrop"
''')
    # The backdrop: a wall that rises from the floor in a quarter circle.
    strips, p, n = 24, [], []
    for i in range(strips + 1):
        a = math.pi / 2 * i / strips
        y, z = 4 + 4 * math.sin(a), 4 - 4 * math.cos(a) + 0.001
        for x in (-30, 30):
            p.append("%g %.5g %.5g" % (x, y, z))
            n.append("0 %.5g %.5g" % (-math.sin(a), math.cos(a)))
    for x in (-30, 30):
        p.append("%g 8 30" % x)
        n.append("0 -1 0")
    quads = []
    for i in range(strips + 1):
        a = 2 * i
        quads.append("%d %d %d %d %d %d" % (a, a + 1, a + 3, a, a + 3, a + 2))
    out.append('Shape "trianglemesh" "integer indices" [%s]\n  "point P" [%s]\n  "normal N" [%s]\n' %
               ("  ".join(quads), "  ".join(p), "  ".join(n)))
    out.append('''
AttributeBegin
  NamedMaterial "gold"
  Translate 0 0.25 1.28
  Rotate 78 1 0 0
  Rotate 20 0 0 1
  Scale 1.12 1.12 1.12
  Shape "plymesh" "string filename" "models/knot.ply"
AttributeEnd
''')
    still_life = [("glass", -1.85, -0.75, .62), ("red", 1.9, -0.35, .7), ("steel", -3.0, 0.9, .85),
                  ("teal", 3.15, 1.3, 1.0), ("chalk", -0.95, -1.85, .3), ("glass", 1.0, -1.75, .36),
                  ("steel", 0.15, -2.3, .2), ("red", -2.75, -1.6, .24), ("chalk", 2.75, -1.7, .32),
                  ("teal", -4.6, 2.4, .55), ("chalk", 4.9, 2.9, .6), ("gold", 2.05, -2.35, .17)]
    for material, x, y, r in still_life:
        out.append('NamedMaterial "%s"\n%s' % (material, sphere(x, y, r, r)))

    out.append('\n# The glow-worms.\nNamedMaterial "chalk"\n')
    colours = [(1, .62, .1), (.6, 1, .12), (1, .3, .05), (.12, .55, 1), (1, .12, .3)]
    count = 0

    def free(x, y, z, r):
        return all((x - a) ** 2 + (y - b) ** 2 + (z - c) ** 2 > (c + r + .03) ** 2
                   for _, a, b, c in still_life)

    def place(x, y, z, strength):
        nonlocal count
        r = rng.uniform(.032, .058)
        if z < r + .004 or not free(x, y, z, r): return
        c = rng.choices(colours, (8, 4, 5, 3, 3))[0]
        # The same flux whatever the size: small ones are brighter.
        s = strength * (.045 / r) ** 2
        out.append(glow_worm(x, y, z, r, scaled(c, s)))
        count += 1

    # Two ribbons that wind around the knot, a carpet on the floor, and strays in the air.
    for i in range(130):
        t = i / 129
        for turn in (0, math.pi):
            a = turn + 2.6 * 2 * math.pi * t
            r = 1.55 + .35 * math.sin(5 * t * math.pi) + rng.gauss(0, .04)
            place(r * math.cos(a), .25 + r * math.sin(a), .12 + 2.75 * t + rng.gauss(0, .03), 5.5)
    for _ in range(170):
        a, d = rng.uniform(0, 2 * math.pi), 1.1 + 4.2 * math.sqrt(rng.random())
        place(d * math.cos(a), .4 + .8 * d * math.sin(a), rng.uniform(.06, .09), 4.2)
    while count < 480:
        place(rng.uniform(-5.5, 5.5), rng.uniform(-2.4, 5.5), rng.uniform(.1, 3.6), 4)
    out.append("WorldEnd\n")
    with open(os.path.join(folder, "quickstart.pbrt"), "w") as f:
        f.write("".join(out))
    print("quickstart.pbrt: %d lights" % count)
