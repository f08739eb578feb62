# SPDX-License-Identifier: Apache-2.0
"""The scenes of Ma 2018, "Importance Sampling with Light BVH", chapter 4: what lights them and how many
there are is the thesis's; positions come from a generator of their own, materials are chosen afresh.

The room is 10 x 16 x 7 units, seen along y from a man's height near one end."""
import math

from .files import write_scene
from .geometry import area_light, cuboid, faceted_sphere, light_panel, quad, sphere

LOW, HIGH = (-5, -11, 0), (5, 5, 7)
MARGIN = .05  # of lights at random from the walls

HEAD = '''LookAt 0 -10 1.5  0 1 1.5  0 0 1
Camera "perspective" "float fov" 45
Sampler "bluenoise" "integer pixelsamples" 64
Integrator "path" "integer maxdepth" 5 "string lightsampler" "bvh"
Film "image" "string filename" "%s.exr" "integer xresolution" 400 "integer yresolution" 400
WorldBegin
'''


def furnished_room():
    """Walls that face inwards, two hanging boxes, a sphere each of glass, plastic and metal."""
    (x0, y0, z0), (x1, y1, z1) = LOW, HIGH
    a, b, c, d = (x0, y0, z0), (x1, y0, z0), (x1, y1, z0), (x0, y1, z0)
    e, f, g, h = (x0, y0, z1), (x1, y0, z1), (x1, y1, z1), (x0, y1, z1)
    walls = [quad(*w) for w in ((a, b, c, d), (e, h, g, f), (d, c, g, h), (b, a, e, f), (a, d, h, e), (c, b, f, g))]
    spheres = [('"glass"', (0, -2)), ('"plastic" "rgb Kd" [.25 .25 .25] "rgb Ks" [.25 .25 .25] "float roughness" .1',
                                      (1, 3)), ('"metal" "float roughness" .01', (-1, -3))]
    return "".join(
        ['Material "matte" "rgb Kd" [.8 .8 .8]\n', *walls,
         'Material "matte" "rgb Kd" [.6 .6 .1]\n', cuboid((1.5, 2, 3), (3.5, 4, 5)),
         'Material "matte" "rgb Kd" [.1 .6 .6]\n', cuboid((-3.5, 2, 3), (-1.5, 4, 5))] +
        ['Material %s\n%s' % (material, sphere(x, y, .5, .5)) for material, (x, y) in spheres])


def point_light(at, intensity):
    return 'LightSource "point" "point from" [%.6g %.6g %.6g] "rgb I" [%.4g %.4g %.4g]\n' % (*at, *3 * (intensity,))


def spot_light(at, to, cone, intensity):
    return ('LightSource "spot" "point from" [%.6g %.6g %.6g] "point to" [%.6g %.6g %.6g] "float coneangle" %.4g '
            '"rgb I" [%.4g %.4g %.4g]\n' % (*at, *to, cone, *3 * (intensity,)))


def somewhere(rng):
    return tuple(rng.uniform(a + MARGIN, b - MARGIN) for a, b in zip(LOW, HIGH))


def random_points(count, total, rng):
    for _ in range(count):
        yield point_light(somewhere(rng), total / count)


def random_spots(count, total, rng):
    for _ in range(count):
        at, z, a = somewhere(rng), rng.uniform(-1, 1), rng.uniform(0, 2 * math.pi)
        r = math.sqrt(1 - z * z)
        to = tuple(p + d for p, d in zip(at, (r * math.cos(a), r * math.sin(a), z)))
        yield spot_light(at, to, rng.uniform(5, 60), total / count)


def spots_20(count, rng):
    """Groups that point to the floor, the ceiling and either side wall."""
    aims = ((0, 0, -1), (1, 0, 0), (0, 0, 1), (-1, 0, 0))
    for i in range(count):
        aim = aims[i * len(aims) // count]
        at = (rng.uniform(-4, 4), rng.uniform(-5, 4), rng.uniform(1, 6))
        yield spot_light(at, tuple(p + d for p, d in zip(at, aim)), 30, 60 / count)


def ceiling_points(count, rng):
    """A square raster a little below the ceiling."""
    side = max(1, round(math.sqrt(count * 10 / 16)))
    rows = math.ceil(count / side)
    for i in range(count):
        x, y = (i % side + .5) / side, (i // side + .5) / rows
        yield point_light((LOW[0] + 10 * x, LOW[1] + 16 * y, HIGH[2] - .1), 12 / count)


def raster_points(count, rng):
    """As many cells along each edge as make them about cubic."""
    edges = [b - a for a, b in zip(LOW, HIGH)]
    cell = (edges[0] * edges[1] * edges[2] / count) ** (1 / 3)
    n = [max(1, round(e / cell)) for e in edges]
    total = n[0] * n[1] * n[2]
    for i in range(total):
        index = (i % n[0], i // n[0] % n[1], i // (n[0] * n[1]))
        yield point_light(tuple(a + e * (k + .5) / m for a, e, k, m in zip(LOW, edges, index, n)), 12 / total)


def ceiling_emitters(count, rng):
    """Two triangles to a square, on a raster that leaves gaps."""
    columns = max(1, round(math.sqrt(count / 2 * 10 / 16)))
    rows = max(1, round(count / 2 / columns))
    # v before u: the panel looks down.
    yield light_panel((LOW[0], LOW[1], HIGH[2] - .001), (0, 16, 0), (10, 0, 0), rows, columns, (.5, .5, .5))


def emissive_spheres(count, rng, strength=1):
    for centre, radiance in (((0, 0, 3.5), .7), ((-2, -3, 4.5), 1), ((2, 3, 1.5), 1.5)):
        yield area_light(faceted_sphere(centre, .38, count / 3), 3 * (strength * 4 * radiance,))


def mixed(count, rng):
    """3 : 2 : 2 triangles, spots and points."""
    yield from emissive_spheres(count * 3 // 7, rng, .5)
    yield from random_spots(count * 2 // 7, 40, rng)
    yield from random_points(count * 2 // 7, 6, rng)


SCENES = {  # name: (what it is, lights, the generator of its lights)
    "spots-20": ("20 spots", 20, spots_20),
    "ceiling-points": ("1.6 million points on the ceiling", 1600000, ceiling_points),
    "raster-points": ("12,000 points in a raster", 12000, raster_points),
    "random-points": ("12,000 random points", 12000, lambda n, rng: random_points(n, 12, rng)),
    "random-spots": ("12,000 random spots", 12000, lambda n, rng: random_spots(n, 120, rng)),
    "ceiling-emitters": ("2,000 emitters on the ceiling", 2000, ceiling_emitters),
    "emissive-spheres": ("6,000 triangles in three spheres, with glass", 6000, emissive_spheres),
    "mixed": ("6,000 triangles, 4,000 spots, 4,000 points", 14000, mixed),
}


def write(folder, name, lights=None):
    write_scene(SCENES, folder, name, lights, HEAD % name + furnished_room())
