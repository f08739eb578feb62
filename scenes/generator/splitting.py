# SPDX-License-Identifier: Apache-2.0
"""Scenes for the splitting of light trees: large groups of emitters lie close to what they light, so that
one light drawn from a group says little about the rest of it (Conty and Kulla 2018, section 5.4)."""

from .files import write_scene
from .geometry import add, cuboid, light_panel, quad, scaled, sphere

HEAD = '''LookAt %s
Camera "perspective" "float fov" %g
Sampler "bluenoise" "integer pixelsamples" 64
Integrator "path" "integer maxdepth" 4 "string lightsampler" "bvh"
Film "image" "string filename" "%s.exr" "integer xresolution" 480 "integer yresolution" 320
WorldBegin
'''
COLOURS = ((1, .55, .2), (1, .8, .5), (.35, .6, 1), (1, .3, .35), (.4, 1, .6))


def coloured(rng, strength):
    return scaled(rng.choice(COLOURS), strength * rng.uniform(.4, 1.6))


def cove(lights, rng):
    """Strips in front of a wall, turned towards it, and a polished floor: each strip a row of emitters."""
    strips = 8
    columns = max(1, round(lights / (2 * strips)))
    out = [HEAD % ("-3 -6.5 1.6  0.3 0 1.9  0 0 1", 44, "cove"),
           'Material "matte" "rgb Kd" [.7 .7 .7]\n', quad((-6, 0, 0), (-6, 0, 5), (6, 0, 5), (6, 0, 0)),
           'Material "substrate" "rgb Kd" [.25 .25 .25] "rgb Ks" [.3 .3 .3]\n'
           '  "float uroughness" .05 "float vroughness" .05\n',
           quad((-6, -9, 0), (6, -9, 0), (6, 0, 0), (-6, 0, 0))]
    for i in range(strips):
        z = .2 + 4.5 * i / (strips - 1)
        # The board behind a strip hides it from the camera.
        out.append('Material "matte" "rgb Kd" [.12 .12 .12]\n')
        out.append(cuboid((-5, -.2, z - .035), (5, -.17, z + .035)))
        for k in range(10):
            out.append(light_panel((5 - k, -.165, z - .03), (-1, 0, 0), (0, 0, .06), max(1, columns // 10), 1,
                                   coloured(rng, 9)))
    return out


def shelves(lights, rng):
    """A wall of compartments, each lit from its own ceiling by a board full of emitters."""
    columns, rows = 12, 8
    side = max(1, round((lights / (2 * columns * rows)) ** .5))
    out = [HEAD % ("0 -9 2.6  0 0 2  0 0 1", 38, "shelves"), 'Material "matte" "rgb Kd" [.65 .62 .58]\n',
           quad((-6, 0, 0), (-6, 0, 4), (6, 0, 4), (6, 0, 0)),
           quad((-9, -9, -.02), (9, -9, -.02), (9, 0, -.02), (-9, 0, -.02))]
    out += [cuboid((-6 + i - .02, -.8, 0), (-6 + i + .02, 0, 4)) for i in range(columns + 1)]
    out += [cuboid((-6, -.8, .5 * j - .02), (6, 0, .5 * j + .02)) for j in range(rows + 1)]
    for j in range(rows):
        for i in range(columns):
            corner = (-6 + i + .05, -.75, .5 * j + .475)
            out.append(light_panel(corner, (0, .7, 0), (.9, 0, 0), side, side, coloured(rng, 1.2)))
            out.append('Material "plastic" "rgb Kd" [%.2f %.2f %.2f] "rgb Ks" [.3 .3 .3] "float roughness" .05\n%s' % (
                *(rng.uniform(.2, .7) for _ in range(3)),
                sphere(*add(corner, (rng.uniform(.2, .7), rng.uniform(.2, .5), -.325)), .13)))
    return out


SCENES = {"cove": ("8 strips of emitters before a wall", 5600, cove),
          "shelves": ("96 compartments under boards of emitters", 12288, shelves)}


def write(folder, name, lights=None):
    write_scene(SCENES, folder, name, lights)
