#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Runs a suite of scenes and variants at equal time and writes what came out: OUT/results.json.

usage: equal_time.py SUITE.json [--out DIR] ...      then: report.py OUT/results.json -o report.html

Interrupted, it goes on where it was when it is started again. docs/evaluation.md has the method."""
import argparse
import datetime
import json
import math
import os
import subprocess
import sys

from evaluation import images, machine, schedule, suite as suites, summary
from evaluation.runs import Failed, Runner


def arguments():
    p = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    p.add_argument("suite", help="suite file")
    p.add_argument("--out", help="folder for images, records and results (build/bench/NAME)")
    p.add_argument("--binary", default=os.path.join(suites.ROOT, "build", "release", "lampyris"))
    p.add_argument("--quick", action="store_true", help="a tenth of the time: to see that all works, not to quote")
    p.add_argument("--scenes", help="only these, separated by commas")
    p.add_argument("--seconds", type=float, help="of each run, instead of the suite's")
    p.add_argument("--repetitions", type=int, help="instead of the suite's")
    p.add_argument("--reference-seconds", type=float, help="of each half of a reference, instead of the suite's")
    p.add_argument("--threads", type=int, help="of the program, instead of the suite's; 0: all")
    p.add_argument("--first-seed", type=int, default=1, help="of the first repetition; another makes an independent run of "
                   "the suite, which agreement.py compares")
    return p.parse_args()


def selected(suite, args):
    """The suite as the command line changes it."""
    if args.scenes:
        names = args.scenes.split(",")
        unknown = set(names) - {s.name for s in suite.scenes}
        if unknown: raise suites.SuiteError("no scene '%s' in this suite" % "', '".join(sorted(unknown)))
        suite.scenes = [s for s in suite.scenes if s.name in names]
    if args.repetitions: suite.repetitions = args.repetitions
    if args.seconds:
        suite.seconds = args.seconds
        for s in suite.scenes: s.seconds = 0
    if args.reference_seconds:
        for r in [suite.reference, *(s.reference for s in suite.scenes if s.reference)]:
            r.seconds, r.spp = args.reference_seconds, 0
    if args.threads is not None: suite.threads = args.threads
    if not 1 <= args.first_seed < schedule.REFERENCE_SEED - suite.repetitions:
        raise suites.SuiteError("--first-seed must be from 1, and below the seeds of references")
    return suite


def measure(suite, runner, first_seed):
    """Yields the summary of one scene after another."""
    for s in suite.scenes:
        runner.say(s.name)
        try:
            file = runner.scene_file(s)
            references = schedule.reference_halves(runner, suite, s, file)
            files = images.Folder(runner.out, schedule.mask(runner, suite, s, file))
            found = schedule.scene_runs(runner, suite, s, file, references, files, first_seed)
            yield summary.scene(suite, s, runner.scene_hash(file), references, found, files)
        except (Failed, OSError, ValueError, subprocess.CalledProcessError) as e:
            runner.say("  the scene is left out: %s" % e)


def run(suite, binary, out, first_seed=1):
    """Measures all scenes; the path of the results."""
    suite.threads = suite.threads or os.cpu_count()
    runner = Runner(binary, out, suite.threads, lambda text: print(text, flush=True))
    results = {"suite": suite.name, "title": suite.title or suite.name, "description": suite.description,
               "date": datetime.date.today().isoformat(), "seconds": suite.seconds, "threads": suite.threads,
               "repetitions": suite.repetitions, "first_seed": first_seed, "machine": machine.machine(), "build": machine.build(binary),
               "variants": {v.name: v.title or v.name for v in suite.variants}, "scenes": []}
    path, (seconds, renders) = runner.path("results.json"), suite.expected_seconds()
    print("%s: %d renders of %.0f minutes in all; loading and evaluating come to that, what is done already goes off"
          % (suite.name, renders, math.ceil(seconds / 60)), flush=True)
    try:
        for s in measure(suite, runner, first_seed):
            results["scenes"].append(s)
            # After each scene, so that there is something to look at before the end.
            with open(path + ".tmp", "w") as f: json.dump(results, f, indent=1)
            os.replace(path + ".tmp", path)
    except KeyboardInterrupt: sys.exit("interrupted; the same command goes on from here")
    if not results["scenes"]: sys.exit("error: no scene could be measured")
    return path


def main():
    args = arguments()
    try: suite = selected(suites.read(args.suite, args.quick), args)
    except (suites.SuiteError, OSError) as e: sys.exit("error: %s" % e)
    print(run(suite, args.binary, args.out or os.path.join(suites.ROOT, "build", "bench", suite.name), args.first_seed))


if __name__ == "__main__":
    main()
