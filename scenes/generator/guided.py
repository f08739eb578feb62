# SPDX-License-Identifier: Apache-2.0
"""Scenes in which light is hard to find: what guided path tracing is measured with.

Of the same make-up as those in Bashford-Rogers et al. 2012, "A Significance Cache for Accelerating
Global Illumination", section 4."""
import os

from .geometry import cuboid, quad, sphere


def matte(r, g, b): return 'Material "matte" "rgb Kd" [%g %g %g]\n' % (r, g, b)


def light(r, g, b, shape):
    return 'AttributeBegin\nAreaLightSource "diffuse" "rgb L" [%g %g %g]\n%s%sAttributeEnd\n' % (
        r, g, b, matte(0, 0, 0), shape)


def hall():
    """A vaulted nave with two rows of columns, lit from behind the camera."""
    out = [matte(.62, .58, .52), cuboid((-6, -14, 0), (6, 16, 9))]
    out.append(matte(.68, .63, .55))
    for y in range(-11, 16, 4):  # columns, capitals and the ribs that join them
        for x in (-2.6, 2.6):
            out.append(cuboid((x - .35, y - .35, 0), (x + .35, y + .35, 5)))
            out.append(cuboid((x - .5, y - .5, 5), (x + .5, y + .5, 5.4)))
        for x, X, z in ((-2.6, -1.3, 6.6), (-1.3, 1.3, 7.2), (1.3, 2.6, 6.6)):
            out.append(cuboid((x, y - .25, z), (X, y + .25, 9)))
        for x in (-6, 2.6): out.append(cuboid((x, y - .25, 6), (x + 3.4, y + .25, 9)))
    out.append(matte(.5, .3, .2))
    for y in range(-6, 12, 2):  # pews
        for x in (-2, .5): out.append(cuboid((x, y, 0), (x + 1.5, y + .4, .8)))
    out.append(light(60, 55, 45, quad((-1, -12.5, 5), (-1, -10.5, 5), (1, -10.5, 5), (1, -12.5, 5))))
    return "LookAt 0 -8.5 1.8  0 4 5.5  0 0 1\n", 65, 8, "path", "".join(out)


def office():
    """A room with a desk; the lamp is in the room beyond a door that stands ajar."""
    out = [matte(.7, .68, .64),
           quad((-3, -3, 0), (9, -3, 0), (9, 3, 0), (-3, 3, 0)),                # floor
           quad((-3, -3, 2.8), (-3, 3, 2.8), (9, 3, 2.8), (9, -3, 2.8)),        # ceiling
           quad((-3, -3, 0), (-3, -3, 2.8), (9, -3, 2.8), (9, -3, 0)),
           quad((-3, 3, 0), (9, 3, 0), (9, 3, 2.8), (-3, 3, 2.8)),
           quad((-3, -3, 0), (-3, 3, 0), (-3, 3, 2.8), (-3, -3, 2.8)),
           quad((9, -3, 0), (9, -3, 2.8), (9, 3, 2.8), (9, 3, 0)),
           cuboid((3, -3, 0), (3.15, .6, 2.8)), cuboid((3, 1.6, 0), (3.15, 3, 2.8)),  # the wall with the door
           cuboid((3, .6, 2.1), (3.15, 1.6, 2.8))]
    out.append('Material "matte" "rgb Kd" [.45 .3 .18]\nAttributeBegin\nTranslate 3.08 .6 0\nRotate 50 0 0 1\n' +
               cuboid((-.03, 0, 0), (.03, 1, 2.1)) + "AttributeEnd\n")
    out.append(matte(.4, .25, .15) + cuboid((-2, .4, .7), (.4, 1.5, .76)))
    for x in (-1.95, .3):
        for y in (.45, 1.4): out.append(cuboid((x, y, 0), (x + .06, y + .06, .7)))
    out.append(matte(.2, .35, .5) + cuboid((-1.2, -.5, 0), (-.6, .1, .45)) + cuboid((-1.2, -.5, .45), (-1.12, .1, 1)))
    out.append(matte(.5, .5, .55) + cuboid((-2.9, -2.9, 0), (-2.3, -.8, 1.9)))
    out.append('Material "plastic" "rgb Kd" [.3 .1 .1] "rgb Ks" [.3 .3 .3] "float roughness" .1\n' +
               sphere(-.9, .95, .96, .2))
    out.append(light(90, 85, 70, quad((6, -1, 2.7), (6, 1, 2.7), (7, 1, 2.7), (7, -1, 2.7))))
    return "LookAt 2 -2.6 1.7  -1 1 .9  0 0 1\n", 62, 10, "path", "".join(out)


def caustic():
    """Light through a glass sphere onto a highly glossy floor, whose sampling is specular for 95 %."""
    # As a Ward BRDF with a specular weight of 0.95: lobes are drawn by their albedo.
    out = ['MakeNamedMaterial "gloss" "string type" "metal" "rgb eta" [.14 .14 .14] "rgb k" [4.1 4.1 4.1] '
           '"float roughness" .2 "bool remaproughness" "false"\n'
           'MakeNamedMaterial "base" "string type" "matte" "rgb Kd" [1 1 1]\n'
           'Material "mix" "string namedmaterial1" "gloss" "string namedmaterial2" "base" "rgb amount" [.95 .95 .95]\n',
           quad((-6, -6, 0), (6, -6, 0), (6, 6, 0), (-6, 6, 0)),
           'Material "glass" "float eta" 1.5\n', sphere(0, .2, 1.1, .8),
           light(120, 115, 100, sphere(1.6, -.6, 4.5, .3))]
    return "LookAt 0 -5.5 3.2  0 .3 .5  0 0 1\n", 38, 8, "path", "".join(out)


def medium():
    """A glass sphere in a Cornell box full of a scattering medium; a small lamp above, out of sight."""
    out = ['MakeNamedMedium "mist" "string type" "homogeneous" "rgb sigma_a" [.02 .02 .02] "rgb sigma_s" [.3 .3 .3]\n'
           'MediumInterface "mist" "mist"\n']
    out += [matte(.7, .7, .68), quad((-1, -1, -1), (1, -1, -1), (1, 1, -1), (-1, 1, -1)),
            quad((-1, -1, 1), (-1, 1, 1), (1, 1, 1), (1, -1, 1)), quad((-1, 1, -1), (1, 1, -1), (1, 1, 1), (-1, 1, 1)),
            quad((-1, -1, -1), (-1, -1, 1), (1, -1, 1), (1, -1, -1)),
            matte(.6, .08, .06), quad((-1, -1, -1), (-1, 1, -1), (-1, 1, 1), (-1, -1, 1)),
            matte(.1, .45, .12), quad((1, -1, -1), (1, -1, 1), (1, 1, 1), (1, 1, -1)),
            'AttributeBegin\nMediumInterface "" "mist"\nMaterial "glass" "float eta" 1.5\n' + sphere(0, .2, 0, .4) +
            "AttributeEnd\n",
            light(360, 340, 280, quad((-.06, .14, .98), (-.06, .26, .98), (.06, .26, .98), (.06, .14, .98)))]
    return "LookAt 0 -.97 0  0 1 -.35  0 0 1\n", 70, 12, "volpath", "".join(out)


SCENES = {"hall": hall, "office": office, "caustic": caustic, "medium": medium}


def write(folder, name, count=None):
    """Writes folder/name.pbrt; `count` is its width in pixels."""
    os.makedirs(folder, exist_ok=True)
    look, fov, depth, integrator, world = SCENES[name]()
    width = count or 600
    with open(os.path.join(folder, name + ".pbrt"), "w") as f:
        f.write("# %s\n%s" % (SCENES[name].__doc__, look))
        f.write('Camera "perspective" "float fov" %g\nSampler "random" "integer pixelsamples" 64\n'
                'Integrator "%s" "integer maxdepth" %d\nPixelFilter "box"\n'
                'Film "image" "string filename" "%s.exr" "integer xresolution" %d "integer yresolution" %d\nWorldBegin\n'
                % (fov, integrator, depth, name, width, width * 2 // 3))
        f.write(world + "WorldEnd\n")
