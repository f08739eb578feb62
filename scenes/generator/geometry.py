# SPDX-License-Identifier: Apache-2.0
"""Vectors, meshes and the shapes that several scenes are made of."""
import math
import struct


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


def triangle_mesh(positions, triangles):
    return 'Shape "trianglemesh" "integer indices" [%s]\n  "point P" [%s]\n' % (
        "  ".join("%d %d %d" % t for t in triangles),
        "  ".join("%.6g %.6g %.6g" % tuple(p) for p in positions))


def quad(a, b, c, d):
    """Its normal follows the right-hand rule around a, b, c, d."""
    return triangle_mesh((a, b, c, d), ((0, 1, 2), (0, 2, 3)))


def cuboid(lo, hi):
    box = "4 6 5 4 7 6  0 1 2 0 2 3  0 4 5 0 5 1  1 5 6 1 6 2  2 6 7 2 7 3  3 7 4 3 4 0"
    (a, b, c), (d, e, f) = lo, hi
    p = [(a, b, c), (d, b, c), (d, e, c), (a, e, c), (a, b, f), (d, b, f), (d, e, f), (a, e, f)]
    return 'Shape "trianglemesh" "integer indices" [%s] "point P" [%s]\n' % (
        box, " ".join("%g %g %g" % q for q in p))


def faceted_sphere(centre, radius, triangles):
    """A sphere of about so many triangles (2000 are 2000), facing outwards."""
    # 2 segments (rings - 1) triangles; 1.5 segments a ring give them a good shape.
    segments = max(3, round(math.sqrt(.8 * triangles)))
    rings = max(2, round(triangles / (2 * segments)) + 1)
    positions = [(0, 0, 1), (0, 0, -1)]
    for i in range(1, rings):
        a = math.pi * i / rings
        for k in range(segments):
            b = 2 * math.pi * k / segments
            positions.append((math.sin(a) * math.cos(b), math.sin(a) * math.sin(b), math.cos(a)))

    def at(i, k): return 2 + (i - 1) * segments + k % segments
    faces = []
    for k in range(segments):
        faces += [(0, at(1, k), at(1, k + 1)), (1, at(rings - 1, k + 1), at(rings - 1, k))]
        for i in range(1, rings - 1):
            a, b, c, d = at(i, k), at(i, k + 1), at(i + 1, k), at(i + 1, k + 1)
            faces += [(a, c, d), (a, d, b)]
    return triangle_mesh([add(centre, scaled(p, radius)) for p in positions], faces)


def light_panel(corner, u, v, columns, rows, radiance, gap=.1):
    """columns x rows small squares that emit along u x v, two triangles each; one light object."""
    positions, triangles = [], []
    for j in range(rows):
        for i in range(columns):
            n = len(positions)
            for s, t in ((gap, gap), (1 - gap, gap), (1 - gap, 1 - gap), (gap, 1 - gap)):
                positions.append(add(corner, add(scaled(u, (i + s) / columns), scaled(v, (j + t) / rows))))
            triangles += [(n, n + 1, n + 2), (n, n + 2, n + 3)]
    return area_light(triangle_mesh(positions, triangles), radiance)


def area_light(shape, radiance):
    return 'AttributeBegin\n  AreaLightSource "diffuse" "rgb L" [%.4g %.4g %.4g]\n  %sAttributeEnd\n' % (
        *radiance, shape)
