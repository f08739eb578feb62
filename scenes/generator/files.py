# SPDX-License-Identifier: Apache-2.0
"""Writes the scenes of a family: {name: (title, number of lights, make(lights, rng) -> lines)}."""
import os
import random


def write_scene(family, folder, name, lights=None, before=""):
    """Writes folder/name.pbrt; `before` comes between the title and what the family's function makes."""
    title, count, make = family[name]
    os.makedirs(folder, exist_ok=True)
    with open(os.path.join(folder, name + ".pbrt"), "w") as f:
        f.write("# %s. Made by generate.py.\n\n" % title)
        f.write(before)
        f.writelines(make(lights or count, random.Random(name)))
        f.write("WorldEnd\n")
