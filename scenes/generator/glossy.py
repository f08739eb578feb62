# SPDX-License-Identifier: Apache-2.0
"""Scenes for BRDF-oriented light sampling: of the same make-up as those of Liu, Xu and Yan 2019, section 6.
Small emitters that glossy surfaces show as highlights, of which neither light nor BSDF sampling finds the
right one."""
import math

from .files import write_scene
from .geometry import (add, area_light, cross, cuboid, glow_worm, quad, scaled, sphere, sub, torus_knot,
                       triangle_mesh, unit)

HEAD = '''LookAt %s
Camera "perspective" "float fov" %g
Sampler "bluenoise" "integer pixelsamples" 16
Integrator "directlighting" "integer maxdepth" 3 "string strategy" "adaptive" "string lightsampler" "brdf"
Film "image" "string filename" "%s.exr" "integer xresolution" %d "integer yresolution" %d
WorldBegin
'''
PLASTIC = 'Material "plastic" "rgb Kd" [%g %g %g] "rgb Ks" [%g %g %g] "float roughness" %g "bool remaproughness" "false"\n'
METAL = 'Material "metal" "rgb eta" [%g %g %g] "rgb k" [%g %g %g] "float roughness" %g "bool remaproughness" "false"\n'
FLOOR = ('Material "substrate" "rgb Kd" [%g %g %g] "rgb Ks" [%g %g %g] "float uroughness" %g "float vroughness" %g\n'
         '  "bool remaproughness" "false"\n')
BLACK = 'Material "matte" "rgb Kd" [0 0 0]\n'


def tube(curve, steps, sides, radius):
    """Triangles along the curve, a function of [0, 1]: 2 steps sides of them."""
    positions, triangles = [], []
    for i in range(steps + 1):
        t = i / steps
        tangent = unit(sub(curve(min(1, t + 1e-4)), curve(max(0, t - 1e-4))))
        helper = (0, 0, 1) if abs(tangent[2]) < .9 else (1, 0, 0)
        out = unit(cross(tangent, helper))
        side = cross(tangent, out)
        for k in range(sides):
            a = 2 * math.pi * k / sides
            positions.append(add(curve(t), scaled(add(scaled(out, math.cos(a)), scaled(side, math.sin(a))), radius)))
    for i in range(steps):
        for k in range(sides):
            a, b = i * sides + k, i * sides + (k + 1) % sides
            triangles += [(a, b, a + sides), (b, b + sides, a + sides)]
    return positions, triangles


def joined(meshes):
    positions, triangles = [], []
    for p, t in meshes:
        n = len(positions)
        positions += p
        triangles += [(a + n, b + n, c + n) for a, b, c in t]
    return triangle_mesh(positions, triangles)


def knot(centre, size, steps=240, sides=20):
    """A smooth figure that stands in for a statue."""
    positions, normals, triangles = torus_knot(2, 3, steps, sides, .15)
    turned = [add(centre, scaled((x, z, y), size)) for x, y, z in positions]
    shape = triangle_mesh(turned, triangles)
    return shape + '  "normal N" [%s]\n' % "  ".join("%.4g %.4g %.4g" % (x, z, y) for x, y, z in normals)


def floor_quad(size):
    return quad((-size, -size, 0), (size, -size, 0), (size, size, 0), (-size, size, 0))


def spiral(lights, rng):
    """A figure of polished metal within a luminous spiral."""
    del rng
    steps, turns = max(1, lights // 12), 5

    def curve(t):
        a = 2 * math.pi * turns * t
        return (1.7 * math.cos(a), 1.7 * math.sin(a), .3 + 2.7 * t)
    return [HEAD % ("0 -7 2.6  0 0 1.45  0 0 1", 32, "spiral", 400, 400),
            FLOOR % (.3, .28, .25, .1, .1, .1, .05, .05), floor_quad(20),
            METAL % (.2, .4, 1.3, 3.9, 2.5, 1.9, .08), knot((0, 0, 1.5), 1.15), BLACK,
            area_light(joined([tube(curve, steps, 6, .02)]), (14, 11, 8))]


def body(rings=80, segments=120):
    """The smooth shape of a lacquered car, more or less: a long superellipsoid with a cabin."""
    positions, normals, triangles = [], [], []

    def point(i, k):
        v, u = math.pi * (i / rings - .5), 2 * math.pi * k / segments
        power = lambda x, p: math.copysign(abs(x) ** p, x)
        x = 2.1 * power(math.cos(v), .5) * power(math.cos(u), .7)
        y = .85 * power(math.cos(v), .5) * power(math.sin(u), .7)
        z = .38 * power(math.sin(v), .8)
        cabin = math.exp(-((x + .2) / .95) ** 4) * math.exp(-(y / .7) ** 4)
        return (x, y, .55 + z + (.42 * cabin if z > 0 else 0) * min(1, z / .2))
    for i in range(rings + 1):
        for k in range(segments):
            positions.append(point(i, k))
    normals = [(0, 0, 0)] * len(positions)
    for i in range(rings):
        for k in range(segments):
            a, b = i * segments + k, i * segments + (k + 1) % segments
            for t in ((a, b, b + segments), (a, b + segments, a + segments)):
                triangles.append(t)
                p, q, r = (positions[v] for v in t)
                n = cross(sub(q, p), sub(r, p))
                for v in t: normals[v] = add(normals[v], n)
    normals = [unit(n) if any(n) else (0, 0, 1) for n in normals]
    return triangle_mesh(positions, triangles) + '  "normal N" [%s]\n' % "  ".join(
        "%.4g %.4g %.4g" % n for n in normals)


def disk(centre, normal, radius, sides):
    out = unit(cross(normal, (0, 0, 1) if abs(normal[2]) < .9 else (1, 0, 0)))
    side = cross(normal, out)
    rim = [add(centre, scaled(add(scaled(out, math.cos(a)), scaled(side, math.sin(a))), radius))
           for a in (2 * math.pi * k / sides for k in range(sides))]
    return [centre] + rim, [(0, 1 + k, 1 + (k + 1) % sides) for k in range(sides)]


def exhibition(lights, rng):
    """A lacquered car under a large panel, among small round lamps on the walls and above."""
    sides = 12
    disks = []
    for _ in range(max(1, (lights - 2) // sides)):
        a, h = rng.uniform(0, 2 * math.pi), rng.random()
        if h < .5:
            disks.append(disk((5.5 * math.cos(a), 5.5 * math.sin(a), rng.uniform(.3, 3.6)),
                              (-math.cos(a), -math.sin(a), 0), .022, sides))
        else:
            disks.append(disk((rng.uniform(-4.5, 4.5), rng.uniform(-4.5, 4.5), 3.9), (0, 0, -1), .022, sides))
    return [HEAD % ("-4.2 -3.6 1.9  0 0 .55  0 0 1", 42, "exhibition", 480, 270),
            FLOOR % (.12, .12, .13, .06, .06, .06, .1, .1), floor_quad(6),
            'Material "substrate" "rgb Kd" [.35 .02 .02] "rgb Ks" [.12 .12 .12] "float uroughness" .03\n'
            '  "float vroughness" .03 "bool remaproughness" "false"\n', body(),
            METAL % (2.9, 2.9, 2.6, 3.1, 3.3, 3.4, .1),
            *[sphere(x, y, .33, .32) for x in (-1.3, 1.3) for y in (-.8, .8)], BLACK,
            area_light(joined(disks), (60, 52, 40)),
            area_light(quad((-1.5, 1, 3.8), (1.5, 1, 3.8), (1.5, -1, 3.8), (-1.5, -1, 3.8)), (1.6, 1.8, 2))]


def cornell(lights, rng):
    """The box with figures of plastic and tiny lamps on two of its walls."""
    out = [HEAD % ("0 -3.9 1  0 0 1  0 0 1", 38, "cornell", 400, 400), 'Material "matte" "rgb Kd" [.7 .7 .7]\n',
           quad((-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)), quad((-1, -1, 2), (-1, 1, 2), (1, 1, 2), (1, -1, 2)),
           quad((-1, 1, 0), (1, 1, 0), (1, 1, 2), (-1, 1, 2)), 'Material "matte" "rgb Kd" [.6 .06 .05]\n',
           quad((-1, -1, 0), (-1, 1, 0), (-1, 1, 2), (-1, -1, 2)), 'Material "matte" "rgb Kd" [.1 .45 .1]\n',
           quad((1, -1, 0), (1, -1, 2), (1, 1, 2), (1, 1, 0)),
           PLASTIC % (.3, .25, .15, .6, .6, .6, .06), knot((-.38, .25, .55), .5),
           PLASTIC % (.1, .2, .35, .6, .6, .6, .03), sphere(.45, -.2, .4, .4),
           PLASTIC % (.25, .25, .25, .5, .5, .5, .12), cuboid((.1, .35, 0), (.8, .9, .9)), BLACK]
    # Any number of lamps has the same area in all.
    radius = .004 * (1494 / lights) ** .5
    for _ in range(lights):
        out.append(glow_worm(rng.choice((-.985, .985)), rng.uniform(-.9, .9), rng.uniform(.5, 1.9), radius,
                             (60, 51, 39)))
    return out


def lamp(lights, rng):
    """Luminous stalks that grow out of a box, whose shadow falls on a polished floor."""
    stalks, sides = 70, 3
    steps = max(1, lights // (2 * sides * stalks))

    def stalk():
        a, lean, height = rng.uniform(0, 2 * math.pi), rng.uniform(.2, 1), rng.uniform(.9, 1.7)
        foot = (rng.uniform(-.2, .2), rng.uniform(-.2, .2), .6)
        bend = rng.uniform(1, 2.5)
        return lambda t: add(foot, (lean * math.cos(a) * t ** bend, lean * math.sin(a) * t ** bend, height * t))
    return [HEAD % ("-.5 -5 1.9  0 0 .85  0 0 1", 36, "lamp", 400, 400),
            FLOOR % (.25, .24, .22, .15, .15, .15, .04, .04), floor_quad(12),
            PLASTIC % (.25, .2, .15, .3, .3, .3, .1), cuboid((-.7, -.7, 0), (.7, .7, .06)),
            cuboid((-.35, -.35, .06), (.35, .35, .6)), METAL % (.2, .9, 1.1, 3.9, 2.4, 2.2, .1), sphere(1.3, -.6, .3, .3),
            BLACK, area_light(joined([tube(stalk(), steps, sides, .004) for _ in range(stalks)]), (30, 26, 20))]


def staircase(lights, rng):
    """Polished steps between two large panels, and a few small lamps: four triangles, the rest spheres."""
    wood = FLOOR % (.3, .18, .09, .08, .08, .08, .08, .08)
    out = [HEAD % ("-.6 -4.6 1.9  .1 0 1.15  0 0 1", 44, "staircase", 320, 400), 'Material "matte" "rgb Kd" [.65 .63 .6]\n',
           quad((-2, 3, 0), (2, 3, 0), (2, 3, 4), (-2, 3, 4)), quad((-2, -5, 0), (-2, 3, 0), (-2, 3, 4), (-2, -5, 4)),
           quad((2, -5, 0), (2, -5, 4), (2, 3, 4), (2, 3, 0)), quad((-2, -5, 4), (-2, 3, 4), (2, 3, 4), (2, -5, 4)),
           wood, floor_quad(5), *[cuboid((-1, -1 + .35 * k, 0), (1.2, 3, .2 * (k + 1))) for k in range(10)],
           METAL % (.2, .9, 1.1, 3.9, 2.4, 2.2, .15), *[sphere(1.1, -.9 + .7 * k, .85 + .4 * k, .09) for k in range(5)],
           PLASTIC % (.2, .3, .35, .4, .4, .4, .05), knot((-1.45, -.2, .45), .5), BLACK,
           area_light(quad((-1.99, -2.5, 1), (-1.99, -.5, 1), (-1.99, -.5, 3), (-1.99, -2.5, 3)), (8, 9, 11)),
           area_light(quad((-.8, -2, 3.99), (-.8, 0, 3.99), (.8, 0, 3.99), (.8, -2, 3.99)), (10, 9, 7))]
    for k in range(max(1, lights - 4)):
        out.append(glow_worm(1.9, rng.uniform(-2.5, 2.6), rng.uniform(1, 3.6), .03, (40, 33, 24)))
    return out


SCENES = {"spiral": ("A metal figure within a luminous spiral", 6912, spiral),
          "exhibition": ("A lacquered car among small lamps, under a panel", 43202, exhibition),
          "cornell": ("Plastic figures between two walls of tiny lamps", 1494, cornell),
          "lamp": ("Luminous stalks that grow out of a box", 53760, lamp),
          "staircase": ("Polished steps between two large panels", 21, staircase)}


def write(folder, name, lights=None):
    write_scene(SCENES, folder, name, lights)
