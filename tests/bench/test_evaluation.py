#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Tests of bench/: measures on made-up data whose answers are known, and whole suites with a program that is made up
as well. All random numbers are seeded."""
import json
import os
import shutil
import stat
import subprocess
import sys
import tempfile
import unittest
import zlib
from html.parser import HTMLParser

HERE = os.path.dirname(os.path.abspath(__file__))
BENCH = os.path.join(HERE, "..", "..", "bench")
sys.path[:0] = [BENCH, os.path.join(BENCH, "..", "scenes")]
try:
    import numpy as np
except ImportError:
    print("SKIPPED: numpy is missing (Debian: python3-numpy)")
    sys.exit(0)
from evaluation import agreement, colours, exr, heatmaps, images, intervals, markdown, measures, plots  # noqa: E402
from evaluation import suite as suites, tables  # noqa: E402
from generator import glossy, splitting, thesis  # noqa: E402


def noisy(rng, sigma, shape=(40, 50, 3)): return 1 + rng.normal(0, sigma, shape)


class Measures(unittest.TestCase):
    def test_errors_of_known_differences(self):
        reference = np.full((20, 50, 3), 2.)
        image = reference + .2
        e = measures.errors(image, reference)
        self.assertAlmostEqual(e["mse"], .04)
        self.assertAlmostEqual(e["relmse"], .04 / (4 + .0004))
        self.assertAlmostEqual(e["trimmed"], e["relmse"])

    def test_trimming_leaves_fireflies_out(self):
        reference = np.ones((20, 50, 3))
        image = reference + .1
        image[3, 4] = 1000
        e = measures.errors(image, reference)
        self.assertAlmostEqual(e["trimmed"], .01 / 1.0001)
        self.assertGreater(e["relmse"], 900)

    def test_errors_do_not_depend_on_brightness(self):
        rng = np.random.default_rng(1)
        a, b = noisy(rng, .1), noisy(rng, .1)
        for m in ("relmse", "trimmed"):
            self.assertAlmostEqual(measures.errors(a, b)[m], measures.errors(1e6 * a, 1e6 * b)[m])

    @unittest.skipUnless(os.environ.get("LAMPYRIS_BINARY"), "LAMPYRIS_BINARY is not set")
    def test_errors_are_those_of_the_program(self):
        rng = np.random.default_rng(7)
        pixels = [rng.gamma(.5, 2, (30, 40, 3)).astype("<f4") for _ in range(2)]
        with tempfile.TemporaryDirectory() as folder:
            paths = [os.path.join(folder, name) for name in ("a.pfm", "b.pfm")]
            for path, p in zip(paths, pixels):
                with open(path, "wb") as f: f.write(b"PF\n40 30\n-1.0\n" + p.tobytes())
            done = subprocess.run([os.environ["LAMPYRIS_BINARY"], "compare", *paths], capture_output=True, text=True, check=True)
            told = dict(line.rsplit(None, 1) for line in done.stdout.splitlines() if line)
            own = measures.errors(*map(images.load, paths))
        for name, key in (("MSE", "mse"), ("relMSE", "relmse"), ("relMSE, trimmed", "trimmed")):
            self.assertAlmostEqual(float(told[name]) / own[key], 1, delta=1e-5)

    def test_floor_is_the_error_of_the_reference(self):
        rng = np.random.default_rng(2)
        floor = measures.floor_of([noisy(rng, .1), noisy(rng, .1)])
        self.assertAlmostEqual(floor["mse"], .1 ** 2 / 2, delta=.0005)

    def test_errors_under_the_floor_are_not_told(self):
        self.assertIsNone(measures.over_floor(.019, .01))
        self.assertAlmostEqual(measures.over_floor(.05, .01), .04)

    def test_bias_is_found_and_noise_is_not(self):
        rng = np.random.default_rng(3)
        halves = [noisy(rng, .05), noisy(rng, .05)]
        fair = measures.bias([noisy(rng, .3) for _ in range(4)], halves)
        biased = measures.bias([1.03 * noisy(rng, .3) for _ in range(4)], halves)
        self.assertLess(abs(fair["z"]), 4)
        self.assertGreater(biased["z"], 6)
        self.assertAlmostEqual(biased["ratio"], 1.03, delta=.01)

    def test_z_is_standard_normal(self):
        rng = np.random.default_rng(4)
        z = [measures.bias([noisy(rng, .3, (64, 64, 3)) for _ in range(3)],
                           [noisy(rng, .2, (64, 64, 3)) for _ in range(2)])["z"] for _ in range(400)]
        self.assertAlmostEqual(np.std(z), 1, delta=.15)
        self.assertAlmostEqual(np.mean(z), 0, delta=.2)
        # |z| > 4 is marked, which chance does once in 16,000 times.
        self.assertLess(np.abs(z).max(), 4)

    def test_pixels_that_depend_on_each_other_raise_no_alarm(self):
        def blurred(sigma):
            image = noisy(rng, sigma, (65, 65, 3))
            return (image[1:, 1:] + image[:-1, 1:] + image[1:, :-1] + image[:-1, :-1]) / 4
        rng = np.random.default_rng(8)
        z = [measures.bias([blurred(.3) for _ in range(3)], [blurred(.2) for _ in range(2)])["z"] for _ in range(300)]
        self.assertAlmostEqual(np.std(z), 1.1, delta=.2)

    def test_two_per_cent_are_found(self):
        rng = np.random.default_rng(9)
        halves = [noisy(rng, .1, (64, 64, 3)) for _ in range(2)]
        z = [measures.bias([scale * noisy(rng, .3, (64, 64, 3)) for _ in range(3)], halves)["z"]
             for scale in (1.02, .98)]
        self.assertGreater(z[0], 4)
        self.assertLess(z[1], -4)

    def test_errors_between_the_points_of_a_curve(self):
        curve = [{"spp": n, "mse": 3 / n ** 1.5} for n in (1, 4, 32)]
        self.assertAlmostEqual(measures.at_samples(curve, 9, "mse"), 3 / 27)
        self.assertIsNone(measures.at_samples(curve, .9, "mse"))
        self.assertIsNone(measures.at_samples(curve, 33, "mse"))


class Intervals(unittest.TestCase):
    """What two suites tell of one machine: few repetitions, errors with tails, a machine that is busy now and then."""
    REPETITIONS, TRUTH = 5, 3.

    def ratio(self, rng):
        n = self.REPETITIONS
        busy = rng.uniform(1, 2, n)  # befalls both of a pair
        base, other = (rng.lognormal(0, .05, n) * rng.chisquare(40, n) / 40 * busy for _ in range(2))
        return intervals.ratio_of_pairs(self.TRUTH * base, other)

    def test_quantiles_are_those_of_tables(self):
        for freedom, t in ((1, 12.706), (2, 4.303), (4, 2.776), (30, 2.042), (1000, 1.962)):
            self.assertAlmostEqual(intervals.t_quantile(freedom), t, delta=.003)

    def test_ratios_hold_the_truth_as_often_as_they_say(self):
        rng = np.random.default_rng(5)
        ends = np.array([self.ratio(rng)["ci"] for _ in range(3000)])
        held = ((ends[:, 0] < self.TRUTH) & (self.TRUTH < ends[:, 1])).mean()
        self.assertAlmostEqual(held, .95, delta=.015)

    def test_two_suites_agree(self):
        rng = np.random.default_rng(6)
        apart = 0
        for _ in range(1500):
            a, b = self.ratio(rng)["ci"], self.ratio(rng)["ci"]
            apart += not agreement.Pair("scene", "variant", {"ci": a}, {"ci": b}).agrees
        self.assertLess(apart / 1500, .01)

    def test_means_hold_the_truth_as_often_as_they_say(self):
        rng = np.random.default_rng(10)
        samples = rng.chisquare(40, (2000, self.REPETITIONS)) / 40
        ends = np.array([intervals.mean(s)["ci"] for s in samples])
        self.assertAlmostEqual(((ends[:, 0] < 1) & (1 < ends[:, 1])).mean(), .95, delta=.015)
        self.assertTrue((ends > 0).all())

    def test_efficiencies_hold_the_truth_as_often_as_they_say(self):
        rng = np.random.default_rng(11)
        ends = np.array([intervals.efficiency(rng.chisquare(40, 5) / 40, 2 * rng.lognormal(0, .05, 5))["ci"]
                         for _ in range(2000)]) * 2
        self.assertAlmostEqual(((ends[:, 0] < 1) & (1 < ends[:, 1])).mean(), .95, delta=.015)

    def test_one_sample_has_no_interval(self):
        self.assertEqual(intervals.mean([3.]), {"value": 3., "ci": None})

    def test_pairs_cancel_what_befalls_both(self):
        rng = np.random.default_rng(6)
        load = rng.uniform(1, 10, 20)  # how busy the machine is from pair to pair
        ratio = intervals.ratio_of_pairs(3 * load * rng.normal(1, .02, 20), load * rng.normal(1, .02, 20))
        self.assertAlmostEqual(ratio["value"], 3, delta=.1)
        self.assertLess(ratio["ci"][1] - ratio["ci"][0], .2)


class Pictures(unittest.TestCase):
    def test_png_holds_the_pixels(self):
        pixels = np.arange(5 * 7 * 3, dtype=np.uint8).reshape(5, 7, 3)
        data = images.png(pixels)
        start = data.index(b"IDAT")
        size = int.from_bytes(data[start - 4:start], "big")
        rows = np.frombuffer(zlib.decompress(data[start + 4:start + 4 + size]), np.uint8).reshape(5, 22)
        decoded = rows[:, 1:].reshape(5, 7, 3).cumsum(axis=1, dtype=np.uint8)
        self.assertTrue((decoded == pixels).all())

    def test_pfm_is_read_top_row_first(self):
        with tempfile.NamedTemporaryFile(suffix=".pfm") as f:
            f.write(b"PF\n1 2\n-1.0\n" + np.array([1, 2, 3, 4, 5, 6], "<f4").tobytes())
            f.flush()
            self.assertEqual(images.load(f.name).tolist(), [[[4, 5, 6]], [[1, 2, 3]]])

    def test_masked_pixels_are_black(self):
        with tempfile.TemporaryDirectory() as folder:
            with open(os.path.join(folder, "a.pfm"), "wb") as f:
                f.write(b"Pf\n1 2\n-1.0\n" + np.array([1, 2], "<f4").tobytes())
            half = images.Folder(folder, np.array([[[0.]], [[1.]]]))
            self.assertEqual(half.image("a.pfm")[:, :, 0].tolist(), [[0], [1]])
            self.assertEqual(half.counted_share(), .5)
            self.assertEqual(images.Folder(folder).image("a.pfm")[:, :, 0].tolist(), [[2], [1]])

    def test_false_colours_get_lighter(self):
        grey = colours.palette() @ (.2126, .7152, .0722)
        self.assertTrue((np.diff(grey) > 0).all())
        self.assertEqual(colours.indices(np.array([0, 1e9, np.nan]), .01, 10).tolist(), [0, 63, 63])
        self.assertEqual(colours.indices(np.array([2, 5, 8]), 2, 8, logarithmic=False).tolist(), [0, 32, 63])

    def test_blocks_of_exr_are_unpacked(self):
        data = np.random.default_rng(1).integers(0, 9, 101).astype(np.uint8)
        parted = np.concatenate([data[0::2], data[1::2]]).astype(np.int64)
        steps = np.diff(parted, prepend=0)
        steps[1:] += 128
        packed = zlib.compress(steps.astype(np.uint8).tobytes())
        self.assertEqual(exr._unpacked(packed, 101), data.tobytes())
        self.assertEqual(exr._unpacked(data.tobytes(), 101), data.tobytes())

    def test_few_colours_stay_exact_and_many_near(self):
        rng = np.random.default_rng(2)
        few = rng.integers(0, 256, (9, 3)).astype(np.uint8)[rng.integers(0, 9, (20, 30))]
        indices, palette = images.quantised(few)
        self.assertTrue((palette[indices] == few).all())
        ramp = np.stack(np.broadcast_arrays(np.arange(200)[:, None], np.arange(200)[None], 90), -1).astype(np.uint8)
        indices, palette = images.quantised(ramp)
        self.assertLess(np.sqrt(((palette[indices].astype(float) - ramp) ** 2).mean()), 5)

    def test_smaller_images_are_means(self):
        self.assertEqual(images.smaller(np.arange(15.).reshape(3, 5), 2).tolist(), [[3, 5]])

    def test_scales_of_maps_have_round_ends(self):
        m = heatmaps.Map("x", "", "", [np.geomspace(.013, 7, 1000), None], logarithmic=True).fit()
        self.assertEqual((m.low, m.high), (.01, 10))
        self.assertEqual(heatmaps.Map("x", "", "", [np.ones((4, 4))], low=1).fit().high, 2)


class Numbers(unittest.TestCase):
    def test_are_written_as_in_a_text(self):
        for value, written in ((0, "0"), (.0146, "0.0146"), (3.14159, "3.14"), (9.999, "10.0"),
                               (12e-7, "1.20 × 10⁻⁶"),
                               (None, "–"), (float("nan"), "–"), (123456, "123\u202f456")):
            self.assertEqual(plots.number(value), written)


class SuiteFiles(unittest.TestCase):
    def test_those_of_the_project_are_right(self):
        folder = os.path.join(BENCH, "suites")
        for name in os.listdir(folder):
            for scene in suites.read(os.path.join(folder, name)).scenes:
                family, made = scene.generate
                self.assertIn(made.partition("=")[0], {"glossy": glossy, "thesis": thesis, "splitting": splitting}[family].SCENES)

    def test_faults_are_told(self):
        good = {"name": "s", "base": "a", "variants": [{"name": "a"}], "scenes": [{"name": "x", "file": "x.pbrt"}],
                "reference": {"spp": 4}}
        suites.parse(good)
        for change, told in (({"bse": 1}, "unknown: bse"), ({"base": "b"}, "no variant 'b'"),
                             ({"reference": {}}, "either"),
                             ({"scenes": [{"name": "../x", "file": "x"}]}, "no name"),
                             ({"variants": [{"name": "a"}, {"name": "a"}]}, "two variants")):
            with self.assertRaisesRegex(suites.SuiteError, told):
                suites.parse({**json.loads(json.dumps(good)), **change})


    def test_quick_is_a_tenth(self):
        path = os.path.join(BENCH, "suites", "thesis.json")
        full, quick = (suites.read(path, q).expected_seconds()[0] for q in (False, True))
        self.assertLess(full, 25 * 60)
        self.assertLess(quick, 2.5 * 60)


class Links(HTMLParser):
    """Everything in a page that could refer to something else; and whether elements close."""
    VOID = {"meta", "input", "link", "img", "br"}

    def __init__(self):
        super().__init__()
        self.links, self.open, self.ids = [], [], set()

    def handle_starttag(self, tag, attributes):
        a = dict(attributes)
        self.links += [a[n] for n in ("href", "src", "srcset", "data") if n in a]
        if "id" in a: self.ids.add(a["id"])
        if tag not in self.VOID: self.open.append(tag)

    def handle_startendtag(self, tag, attributes): pass

    def handle_endtag(self, tag):
        if not self.open or self.open.pop() != tag: raise ValueError("</%s> closes nothing" % tag)


class WholeSuites(unittest.TestCase):
    SUITE = {
        "name": "made-up", "title": "Made <up>", "seconds": 2, "repetitions": 4, "threads": 1, "base": "plain",
        "reference": {"define": ["fake.variance=1"], "spp": 20000}, "snapshots": 2,
        "variants": [{"name": "plain", "define": ["fake.variance=1"]},
                     {"name": "better", "define": ["fake.variance=0.1", "fake.cost=2"]},
                     {"name": "biased", "define": ["fake.variance=0.5", "fake.bias=0.02"]},
                     {"name": "broken", "define": ["fake.variance=1", "fake.fail=1"]}],
        "scenes": [{"name": "grey", "file": "grey.pbrt"},
                   {"name": "other", "file": "grey.pbrt", "variants": ["plain", "better"]}]}

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp()
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        with open(os.path.join(HERE, "fake_lampyris.py")) as f: text = f.read()
        binary = os.path.join(cls.folder, "fake")
        with open(binary, "w") as f: f.write(text.replace("/usr/bin/env python3", sys.executable, 1))
        os.chmod(binary, stat.S_IRWXU)
        with open(os.path.join(cls.folder, "grey.pbrt"), "w") as f: f.write("0.02")
        with open(os.path.join(cls.folder, "suite.json"), "w") as f: json.dump(cls.SUITE, f)
        cls.results = cls.run_suite(cls.folder)

    @staticmethod
    def run_suite(folder, out="out", *options):
        subprocess.run([sys.executable, os.path.join(BENCH, "equal_time.py"), os.path.join(folder, "suite.json"),
                        "--out", os.path.join(folder, out), "--binary", os.path.join(folder, "fake"), *options],
                       check=True, capture_output=True, text=True)
        with open(os.path.join(folder, out, "results.json")) as f: return json.load(f)

    @staticmethod
    def calls(folder):
        with open(os.path.join(folder, "fake.calls")) as f: return f.readlines()

    def test_known_efficiency_comes_back(self):
        v = {v["name"]: v for v in self.results["scenes"][0]["variants"]}
        # A tenth of the variance at twice the cost: 5 times as efficient, 10 times at equal samples.
        for m in measures.METRICS:
            self.assertAlmostEqual(v["better"]["against_base"][m]["value"], 5, delta=.6)
            self.assertAlmostEqual(v["better"]["equal_samples"][m]["value"], 10, delta=1.2)
        low, high = v["better"]["against_base"]["mse"]["ci"]
        self.assertTrue(low <= v["better"]["against_base"]["mse"]["value"] <= high)
        self.assertAlmostEqual(v["plain"]["errors"]["mse"]["value"], 1 / 100, delta=.001)
        self.assertAlmostEqual(v["better"]["errors"]["mse"]["value"], .1 / 50, delta=.0002)
        self.assertEqual([p["spp"] for p in v["plain"]["curve"]], [25, 50, 100])
        self.assertEqual(v["better"]["equal_samples"]["spp"], 50)
        self.assertEqual(v["plain"]["light_statistics"], {"lights drawn": 4.5, "entropy, bits": 2})
        self.assertLess(abs(v["plain"]["bias"]["z"]), 5)
        self.assertGreater(v["biased"]["bias"]["z"], 10)
        self.assertIn("always fails", v["broken"]["failed"])
        self.assertEqual(v["broken"]["runs"], [])
        left = [f for _, _, files in os.walk(os.path.join(self.folder, "out", "runs")) for f in files if f.endswith("s.exr")]
        self.assertEqual(set(left), {"aovs.exr"})  # no snapshots

    def test_goes_on_where_it_was(self):
        folder = os.path.join(self.folder, "copy")
        shutil.copytree(self.folder, folder)
        done = len(self.calls(folder))
        self.assertEqual(self.run_suite(folder), self.results)
        self.assertEqual(len(self.calls(folder)), done + 1)  # what failed is tried again
        os.remove(os.path.join(folder, "out/runs/grey/better/01.json"))
        self.run_suite(folder)
        self.assertEqual(len(self.calls(folder)), done + 3)
        # Another program: all is run again but the references.
        with open(os.path.join(folder, "fake"), "a") as f: f.write("# changed\n")
        references = 2  # both scenes are one file
        self.run_suite(folder)
        self.assertEqual(len(self.calls(folder)), 2 * done + 3 - references)

    def test_runs_take_turns(self):
        turns = [line.split(" -D ")[1].strip() for line in self.calls(self.folder)
                 if "out/runs/grey" in line and "--seconds 2 " in line and "fail" not in line]
        # Each repetition begins with the variant after the one that the last began with.
        plain, better, biased = "fake.variance=1", "fake.variance=0.1", "fake.variance=0.5"
        self.assertEqual(turns[:6], [plain, better, biased, better, biased, plain])

    def test_another_first_seed_makes_an_independent_run(self):
        folder = os.path.join(self.folder, "again")
        shutil.copytree(self.folder, folder)
        second = self.run_suite(folder, "second", "--first-seed", "101")
        runs = second["scenes"][0]["variants"][0]["runs"]
        self.assertEqual([r["seed"] for r in runs], [101, 102, 103, 104])
        first, other = (os.path.join(folder, o, "results.json") for o in ("out", "second"))

        def compare():
            return subprocess.run([sys.executable, os.path.join(BENCH, "agreement.py"), first, other],
                                  capture_output=True, text=True)
        done = compare()
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("3 of 3 ratios agree", done.stdout)
        better = second["scenes"][1]["variants"][1]["against_base"]["trimmed"]
        for part in ("value", "ci"): better[part] = (np.array(better[part]) * 3).tolist()
        with open(other, "w") as f: json.dump(second, f)
        done = compare()
        self.assertEqual(done.returncode, 1)
        self.assertIn("2 of 3 ratios agree", done.stdout)
        self.assertIn("**apart**", done.stdout)

    def test_page_stands_alone(self):
        out = os.path.join(self.folder, "page.html")
        subprocess.run([sys.executable, os.path.join(BENCH, "report.py"),
                        os.path.join(self.folder, "out", "results.json"), "-o", out], check=True)
        with open(out, encoding="utf-8") as f: text = f.read()
        page = Links()
        page.feed(text)
        self.assertEqual(page.open, [])
        self.assertTrue(all(link.startswith("#") and link[1:] in page.ids for link in page.links), page.links)
        self.assertEqual(text.count("url("), text.count("url(data:image/png;base64,"))
        for outside in ("http:", "https:", "@import"): self.assertNotIn(outside, text)
        self.assertIn("Made &lt;up&gt;", text)
        self.assertIn("always fails", text)
        self.assertIn("A mean differs from the reference", text)
        self.assertEqual(text.count("<polyline"), 2 * (3 + 2))
        self.assertEqual(text.count('class="sheet"'), 2 * 7)
        self.assertNotIn("nan", [n for n in text.lower().split('"') if len(n) < 9])

    def test_markdown_has_the_numbers_of_the_page(self):
        results = os.path.join(self.folder, "out", "results.json")
        done = subprocess.run([sys.executable, os.path.join(BENCH, "report.py"), results, "--markdown"],
                              check=True, capture_output=True, text=True)
        rows = [[c.strip() for c in line.strip("|").split("|")] for line in done.stdout.splitlines()]
        self.assertEqual(rows[0], ["scene", "lights", "plain", "better", "biased", "broken"])
        with open(results) as f: told = json.load(f)["scenes"][0]["variants"][1]["against_base"]["trimmed"]
        self.assertEqual(rows[2][3], "%s× (%s)" % (plots.number(told["value"]), tables.interval(told["ci"])))
        self.assertEqual(rows[2][5], "failed")
        self.assertEqual(rows[4][0], "geometric mean of 2")

    def test_rmse_is_that_at_equal_time(self):
        with open(os.path.join(self.folder, "out", "results.json")) as f: results = json.load(f)
        told = results["scenes"][0]["variants"][1]["against_base"]["mse"]
        entry = markdown.rmse(results).splitlines()[2].split("|")[4].strip()
        self.assertEqual(entry, "%.2f (%.2f – %.2f)" % tuple(
            v ** -.5 for v in (told["value"], told["ci"][1], told["ci"][0])))
        self.assertLess(told["value"] ** -.5, 1)


if __name__ == "__main__":
    unittest.main()
