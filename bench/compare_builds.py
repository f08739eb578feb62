#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Tells whether one build of the program renders scenes as fast as another: plugins that a scene doesn't use must not
make it slower.

usage: compare_builds.py BASE OTHER SCENE.pbrt ... [-D film.xresolution=64 ...] [--pairs N] [--instructions]

For every scene: the processor times of two runs on one thread, BASE and OTHER side by side on one processor, so that
whatever else the machine does befalls both alike; told are the median of the ratios and the interval that holds it by
95 %. With --instructions, instead, how many
instructions rendering takes (those of 2N samples a pixel less those of N: starting and loading cancel out), which are the
same on a busy machine; valgrind counts them, and knows none of AVX-512: configure both builds with -D LAMPYRIS_PORTABLE=ON.
The last line is OTHER's start-up: the least time, by the clock, that a run of an empty scene takes.

Exit code 0: every ratio is at most 1 + --limit, the ends of intervals too, and the start-up at most --startup."""
import argparse
import os
import re
import subprocess
import sys
import tempfile
import time

from evaluation import intervals

EMPTY = 'Film "image" "integer xresolution" 16 "integer yresolution" 16\nWorldBegin\nWorldEnd\n'
STARTS = 20


def arguments():
    p = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    p.add_argument("base", help="program that sets the standard")
    p.add_argument("other", help="program that is held against it")
    p.add_argument("scenes", nargs="+", metavar="SCENE.pbrt")
    p.add_argument("-D", dest="define", action="append", default=[], metavar="KIND.PARAMETER=VALUE", help="given to both")
    p.add_argument("--spp", type=int, default=16, help="samples a pixel (16)")
    p.add_argument("--pairs", type=int, default=20, help="runs of each program in every scene (20)")
    p.add_argument("--instructions", action="store_true", help="count instructions instead")
    p.add_argument("--limit", type=float, default=.02, help="what counts as slower (0.02)")
    p.add_argument("--startup", type=float, default=.05, help="most seconds of an empty scene (0.05)")
    args = p.parse_args()
    if args.pairs < intervals.FEWEST_FOR_MEDIAN:
        p.error("--pairs must be %d or more for an interval" % intervals.FEWEST_FOR_MEDIAN)
    return args


def failed(command, code, text=""):
    sys.exit("error: %s ended with %d\n%s" % (" ".join(command), code, text))


def stay_on_one_processor():
    os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})


class Runs:
    def __init__(self, folder, define):
        self.folder, self.define = folder, define

    def command(self, program, scene, spp, image="image.pfm"):
        return [os.path.abspath(program), scene, "--spp", str(spp), "--threads", "1", "--seed", "1", "-q", "--out",
                os.path.join(self.folder, image), *(word for d in self.define for word in ("-D", d))]

    def run(self, program, scene, spp, before=()):
        """What the run printed as errors."""
        command = [*before, *self.command(program, scene, spp)]
        done = subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        if done.returncode: failed(command, done.returncode, done.stderr)
        return done.stderr

    def instructions(self, program, scene, spp):
        text = self.run(program, scene, spp, ("valgrind", "--tool=cachegrind", "--cache-sim=no",
                                              "--cachegrind-out-file=" + os.path.join(self.folder, "counts")))
        return int(re.search(r"I\s+refs:\s+([\d,]+)", text).group(1).replace(",", ""))

    def rendering(self, program, scene, spp):
        """Instructions of `spp` samples of every pixel."""
        return self.instructions(program, scene, 2 * spp) - self.instructions(program, scene, spp)

    def seconds(self, programs, scene, spp):
        """Of processor time, starting and loading included, of each of the programs, which run at once."""
        commands = [self.command(p, scene, spp, "image%d.pfm" % k) for k, p in enumerate(programs)]
        started = [subprocess.Popen(c, stdout=subprocess.DEVNULL, preexec_fn=stay_on_one_processor) for c in commands]
        times = []
        for process, command in zip(started, commands):
            _, status, usage = os.wait4(process.pid, 0)
            process.returncode = os.waitstatus_to_exitcode(status)
            if process.returncode: failed(command, process.returncode)
            times.append(usage.ru_utime + usage.ru_stime)
        return times

    def ratios_of_time(self, base, other, scene, spp, pairs):
        """Every pair starts in the other order than the pair before."""
        found = []
        for k in range(pairs):
            if k % 2: of_base, of_other = self.seconds((base, other), scene, spp)
            else: of_other, of_base = self.seconds((other, base), scene, spp)
            found.append(of_other / of_base)
        return found

    def startup(self, program):
        scene = os.path.join(self.folder, "empty.pbrt")
        with open(scene, "w") as f: f.write(EMPTY)
        def wall():
            before = time.monotonic()
            self.run(program, scene, 1)
            return time.monotonic() - before
        return min(wall() for _ in range(STARTS))


def verdict(low, high, limit):
    if high <= 1 + limit: return "PASS"
    return "FAIL" if low > 1 + limit else "UNSURE"


def measured(runs, args, scene):
    """The ratio of the costs, with its interval."""
    if not args.instructions: return intervals.median(runs.ratios_of_time(args.base, args.other, scene, args.spp, args.pairs))
    base, other = (runs.rendering(p, scene, args.spp) for p in (args.base, args.other))
    return {"value": other / base, "ci": [other / base] * 2}


def compare(runs, args, scene):
    ratio = measured(runs, args, scene)
    found = verdict(*ratio["ci"], args.limit)
    ends = "" if args.instructions else "(%.4f – %.4f)" % tuple(ratio["ci"])
    print("%-28s ratio %.4f %-17s %s" % (os.path.basename(scene), ratio["value"], ends, found), flush=True)
    return found


def main():
    args = arguments()
    with tempfile.TemporaryDirectory() as folder:
        runs = Runs(folder, args.define)
        found = [compare(runs, args, scene) for scene in args.scenes]
        runs.define = []
        startup = runs.startup(args.other)
    found.append("PASS" if startup <= args.startup else "FAIL")
    print("start-up %.1f ms, at most %.0f ms: %s" % (1e3 * startup, 1e3 * args.startup, found[-1]))
    print("%d of %d pass" % (found.count("PASS"), len(found)))
    sys.exit(0 if set(found) == {"PASS"} else 1)


if __name__ == "__main__":
    main()
