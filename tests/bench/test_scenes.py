#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Tests of scenes/generate.py: always the same files, as many lights as asked for, and the program renders them."""
import filecmp
import json
import os
import subprocess
import sys
import tempfile
import unittest

SCENES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "scenes")
sys.path.insert(0, SCENES)
from generator import splitting, thesis  # noqa: E402

BINARY = os.environ.get("LAMPYRIS_BINARY", "")
LIGHTS = 800  # in each scene, about: rasters and spheres come near it


def generate(*arguments):
    return subprocess.run([sys.executable, os.path.join(SCENES, "generate.py"), *arguments],
                          capture_output=True, text=True)


class Generator(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def each(self):
        for family in (thesis, splitting):
            for name in family.SCENES:
                with self.subTest(name):
                    family.write(self.folder, name, LIGHTS)
                    yield family, name, os.path.join(self.folder, name + ".pbrt")

    def test_makes_the_same_again(self):
        other = os.path.join(self.folder, "other")
        for family, name, path in self.each():
            family.write(other, name, LIGHTS)
            self.assertTrue(filecmp.cmp(path, os.path.join(other, name + ".pbrt"), shallow=False))

    def test_quickstart_is_the_one_of_the_project(self):
        self.assertEqual(generate("quickstart", self.folder).returncode, 0)
        for name in ("quickstart.pbrt", "models/knot.ply"):
            self.assertTrue(filecmp.cmp(os.path.join(self.folder, name), os.path.join(SCENES, name), shallow=False))

    @unittest.skipUnless(BINARY, "LAMPYRIS_BINARY is not set")
    def test_program_renders_them(self):
        stats = os.path.join(self.folder, "stats.json")
        for _, name, path in self.each():
            done = subprocess.run([BINARY, path, "--spp", "1", "-D", "film.xresolution=8", "-D", "film.yresolution=8",
                                   "-q", "--stats", stats, "--out", os.path.join(self.folder, "image.pfm")],
                                  capture_output=True, text=True)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            with open(stats) as f: scene = json.load(f)["statistics"]["scene"]
            self.assertAlmostEqual(scene["lights"], LIGHTS, delta=LIGHTS / 4)

    def test_wrong_use_is_told(self):
        for arguments, told in ((["thesis", self.folder, "nowhere"], "no scene 'nowhere'"),
                                (["thesis", self.folder, "mixed=some"], "no number of lights"), (["thesis"], "usage")):
            done = generate(*arguments)
            self.assertNotEqual(done.returncode, 0)
            self.assertIn(told, done.stderr)


if __name__ == "__main__":
    unittest.main()
