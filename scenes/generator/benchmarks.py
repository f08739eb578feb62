# SPDX-License-Identifier: Apache-2.0
"""Large scenes for measuring rays and the reader of scene files."""
import math
import os
import random

from .geometry import cuboid, glow_worm, unit, write_ply


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
