#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Makes the example scenes, and large ones for benchmarks.

usage: generate.py quickstart [FOLDER]         scenes/quickstart.pbrt and its mesh
       generate.py room FOLDER [SPHERES]       a closed room of 150,000 triangles with sphere lights
       generate.py points FILE [COUNT]         COUNT point lights under a ceiling (1.6 million: 141 MB)
"""
import math
import os
import random
import struct
import sys

HERE = os.path.dirname(os.path.abspath(__file__))


def write_ply(path, positions, normals, triangles):
    """A binary little-endian PLY file."""
    with open(path, "wb") as f:
        f.write((
            "ply\nformat binary_little_endian 1.0\nelement vertex %d\n"
            "property float x\nproperty float y\nproperty float z\n"
            "property float nx\nproperty float ny\nproperty float nz\n"
            "element face %d\nproperty list uchar int vertex_indices\nend_header\n"
            % (len(positions), len(triangles))).encode())
        for p, n in zip(positions, normals):
            f.write(struct.pack("<6f", *p, *n))
        for t in triangles:
            f.write(struct.pack("<B3i", 3, *t))


def sub(a, b): return tuple(x - y for x, y in zip(a, b))
def add(a, b): return tuple(x + y for x, y in zip(a, b))
def scaled(a, s): return tuple(x * s for x in a)
def cross(a, b): return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])
def unit(a): return scaled(a, 1 / math.sqrt(sum(x * x for x in a)))


def torus_knot(p, q, steps, sides, radius):
    """A tube of the given radius along the (p, q) torus knot, about one unit across."""
    def curve(t):
        r = 2 + math.cos(q * t)
        return (r * math.cos(p * t) / 3, r * math.sin(p * t) / 3, math.sin(q * t) / 3)
    positions, normals, triangles = [], [], []
    for i in range(steps):
        t = 2 * math.pi * i / steps
        c = curve(t)
        tangent = unit(sub(curve(t + 1e-3), curve(t - 1e-3)))
        # The knot's torus gives a frame that closes: outwards from the ring's centre line.
        ring = (2 / 3 * math.cos(p * t), 2 / 3 * math.sin(p * t), 0)
        out = sub(c, ring)
        out = unit(sub(out, scaled(tangent, sum(x * y for x, y in zip(out, tangent)))))
        side = cross(tangent, out)
        for k in range(sides):
            a = 2 * math.pi * k / sides
            n = add(scaled(out, math.cos(a)), scaled(side, math.sin(a)))
            normals.append(n)
            positions.append(add(c, scaled(n, radius)))
    for i in range(steps):
        for k in range(sides):
            a, b = i * sides + k, i * sides + (k + 1) % sides
            c, d = ((i + 1) % steps) * sides + k, ((i + 1) % steps) * sides + (k + 1) % sides
            triangles += [(a, c, b), (b, c, d)]
    return positions, normals, triangles


def sphere(x, y, z, r):
    return 'AttributeBegin\n  Translate %.4g %.4g %.4g\n  Shape "sphere" "float radius" %.4g\nAttributeEnd\n' % (x, y, z, r)


def glow_worm(x, y, z, r, rgb):
    return ('AttributeBegin\n  AreaLightSource "diffuse" "rgb L" [%.3g %.3g %.3g]\n  Translate %.4g %.4g %.4g\n'
            '  Shape "sphere" "float radius" %.3g\nAttributeEnd\n' % (*rgb, x, y, z, r))


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


def room(folder, spheres):
    """A closed room with a bumpy floor and furniture-like boxes, 150,000 triangles in all."""
    rng = random.Random(3)
    os.makedirs(folder, exist_ok=True)
    n = 270  # 2 n² triangles of floor: 145,800
    positions, normals, triangles = [], [], []
    for j in range(n + 1):
        for i in range(n + 1):
            x, y = 10 * i / n - 5, 10 * j / n - 5
            h = .12 * math.sin(2.1 * x) * math.sin(1.7 * y) + .03 * math.sin(9 * x + 4 * y)
            gx = .12 * 2.1 * math.cos(2.1 * x) * math.sin(1.7 * y) + .27 * math.cos(9 * x + 4 * y)
            gy = .12 * 1.7 * math.sin(2.1 * x) * math.cos(1.7 * y) + .12 * math.cos(9 * x + 4 * y)
            positions.append((x, y, h))
            normals.append(unit((-gx, -gy, 1)))
    for j in range(n):
        for i in range(n):
            a = j * (n + 1) + i
            triangles += [(a, a + 1, a + n + 2), (a, a + n + 2, a + n + 1)]
    write_ply(os.path.join(folder, "floor.ply"), positions, normals, triangles)
    box = "4 6 5 4 7 6  0 1 2 0 2 3  0 4 5 0 5 1  1 5 6 1 6 2  2 6 7 2 7 3  3 7 4 3 4 0"

    def cuboid(lo, hi):
        (a, b, c), (d, e, f) = lo, hi
        p = [(a, b, c), (d, b, c), (d, e, c), (a, e, c), (a, b, f), (d, b, f), (d, e, f), (a, e, f)]
        return 'Shape "trianglemesh" "integer indices" [%s] "point P" [%s]\n' % (
            box, " ".join("%g %g %g" % q for q in p))
    out = ['''LookAt 0 -4.6 2.2  0 0 1.4  0 0 1
Camera "perspective" "float fov" 70
Sampler "random" "integer pixelsamples" 16
Integrator "path" "integer maxdepth" 5
PixelFilter "box"
Film "image" "string filename" "room.exr" "integer xresolution" 640 "integer yresolution" 480
WorldBegin
Material "matte" "rgb Kd" [.6 .6 .6]
''', cuboid((-5, -5, -.5), (5, 5, 5)), 'Shape "plymesh" "string filename" "floor.ply"\n']
    for _ in range(340):
        x, y, s = rng.uniform(-4.5, 4.5), rng.uniform(-3, 4.5), rng.uniform(.05, .25)
        out.append('Material "matte" "rgb Kd" [%.2f %.2f %.2f]\n' % tuple(rng.uniform(.2, .8) for _ in range(3)))
        out.append(cuboid((x, y, 0), (x + s, y + s, rng.uniform(.3, 1.5))))
    for _ in range(spheres):
        out.append(glow_worm(rng.uniform(-4.8, 4.8), rng.uniform(-4.8, 4.8), rng.uniform(1.8, 4.8), .01,
                             (20, 18, 14)))
    out.append("WorldEnd\n")
    with open(os.path.join(folder, "room.pbrt"), "w") as f:
        f.write("".join(out))


def points(path, count):
    side = math.ceil(math.sqrt(count))
    with open(path, "w") as f:
        f.write('''LookAt 0 -10 1.5  0 1 1.5  0 0 1
Camera "perspective" "float fov" 45
Sampler "random" "integer pixelsamples" 1
Integrator "path" "integer maxdepth" 3
Film "image" "string filename" "points.exr" "integer xresolution" 64 "integer yresolution" 64
WorldBegin
Material "matte"
Shape "trianglemesh" "integer indices" [0 1 2 0 2 3] "point P" [-20 -20 0 20 -20 0 20 20 0 -20 20 0]
''')
        for i in range(count):
            f.write('LightSource "point" "point from" [ %f %f %f ] "color I" [%g %g %g] \n' %
                    (-5 + 10 * (i % side) / side, -11 + 22 * (i // side) / side, 6.999, 1e-6, 1e-6, 1e-6))
        f.write("WorldEnd\n")


def main():
    args = sys.argv[1:]
    if args[:1] == ["quickstart"] and len(args) <= 2: quickstart(args[1] if len(args) > 1 else HERE)
    elif args[:1] == ["room"] and 2 <= len(args) <= 3: room(args[1], int(args[2]) if len(args) > 2 else 1494)
    elif args[:1] == ["points"] and 2 <= len(args) <= 3: points(args[1], int(args[2]) if len(args) > 2 else 1600000)
    else: sys.exit(__doc__)


if __name__ == "__main__":
    main()
