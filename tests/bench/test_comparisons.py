#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Tests of bench/compare_builds.py and bench/contact_sheet.py."""
import os
import stat
import subprocess
import sys
import tempfile
import unittest

try:
    import numpy as np
except ImportError:
    print("SKIPPED: numpy is missing")
    sys.exit(0)

BENCH = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "bench")
sys.path.insert(0, BENCH)
import compare_builds
import contact_sheet
from evaluation import intervals


class Medians(unittest.TestCase):
    def test_interval_of_order_statistics(self):
        # Of 9 values the second and the eighth hold the median with 96.1 %, the third and the seventh with 82 %.
        self.assertEqual(intervals.median([9, 1, 8, 2, 7, 3, 6, 4, 5]), {"value": 5, "ci": [2, 8]})
        self.assertEqual(intervals.median(range(6)), {"value": 2.5, "ci": [0, 5]})
        self.assertIsNone(intervals.median(range(5))["ci"])

    def test_holds_the_truth_as_often_as_it_says(self):
        rng = np.random.default_rng(4)
        ends = [intervals.median(rng.standard_cauchy(20))["ci"] for _ in range(2000)]
        held = np.mean([low <= 0 <= high for low, high in ends])
        self.assertGreater(held, .935)  # 95.9 % are expected; 5 standard deviations below


class CompareBuilds(unittest.TestCase):
    def run_with(self, base, other, *options):
        """Stand-ins that add numbers so many thousand times."""
        with tempfile.TemporaryDirectory() as folder:
            names = []
            for k, work in enumerate((base, other)):
                names.append(os.path.join(folder, "program%d" % k))
                with open(names[-1], "w") as f: f.write("#!%s -S\nsum(range(%d000))\n" % (sys.executable, work))
                os.chmod(names[-1], stat.S_IRWXU)
            return subprocess.run([sys.executable, os.path.join(BENCH, "compare_builds.py"), *names, "scene.pbrt",
                                   "--startup", "60", *options], capture_output=True, text=True)

    def test_slower_builds_fail(self):
        slower = self.run_with(1, 5000, "--pairs", "6")
        self.assertEqual(slower.returncode, 1, slower.stdout + slower.stderr)
        self.assertIn("FAIL", slower.stdout)
        self.assertIn("1 of 2 pass", slower.stdout)

    def test_faster_builds_pass(self):
        faster = self.run_with(5000, 1, "--pairs", "6")
        self.assertEqual(faster.returncode, 0, faster.stdout + faster.stderr)
        self.assertIn("2 of 2 pass", faster.stdout)

    def test_too_few_pairs_are_refused(self): self.assertEqual(self.run_with(1, 1, "--pairs", "5").returncode, 2)

    def test_verdicts(self):
        self.assertEqual([compare_builds.verdict(*e, .02) for e in ((.9, 1.02), (.99, 1.03), (1.03, 1.1))],
                         ["PASS", "UNSURE", "FAIL"])


class ContactSheet(unittest.TestCase):
    def definitions(self, text):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "a.pbrt")
            with open(path, "w") as f: f.write(text)
            return contact_sheet.definitions(path, 160, 8)

    def test_scenes_get_small(self):
        self.assertEqual(self.definitions("WorldBegin\nWorldEnd"),
                         ["film.xresolution=160", "film.yresolution=90", "integrator.maxdepth=5"])
        text = '''#Film "image" "integer xresolution" 7
Integrator "bdpt" "integer maxdepth" [ 65 ]
Film "image" "integer yresolution" [ 800 ] "integer xresolution" 400
WorldBegin
"integer xresolution" 3'''
        self.assertEqual(self.definitions(text), ["film.xresolution=80", "film.yresolution=160", "integrator.maxdepth=8",
                                                  "integrator=path"])

    def test_names(self):
        self.assertEqual(contact_sheet.name_of("rooms/kitchen/scene.pbrt"), "kitchen")
        self.assertEqual(contact_sheet.name_of("rooms/kitchen/night.pbrt"), "night")

    def test_table(self):
        variants = [{"name": "spatial", "runs": [1], "seconds": 2, "spp": 30},
                    {"name": "bvh", "runs": [1], "seconds": 2, "spp": 40,
                     "against_base": {"trimmed": {"value": 5, "ci": [4, 6]}}}]
        failed = [{**v, "runs": []} for v in variants]
        rows = contact_sheet.table([{"name": "a", "lights": 7, "variants": variants},
                                    {"name": "b", "lights": 7, "variants": failed}], [np.zeros((90, 160, 3))] * 2).split("\n")
        self.assertEqual(rows[2], "| a | 160 × 90 | 7 | 2.0 | 30 | 40 | 5.00× (4.0 – 6.0) |")
        self.assertIn("failed", rows[3])


if __name__ == "__main__":
    unittest.main()
