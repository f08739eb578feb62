#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Compares the efficiency ratios of two runs of a suite: do their confidence intervals overlap?

usage: equal_time.py SUITE --out A; equal_time.py SUITE --out B --first-seed 1001; agreement.py A/results.json B/results.json

Exit code 1 if any two lie apart."""
import argparse
import json
import sys

from evaluation import agreement


def read(path):
    with open(path) as f: return json.load(f)


def main():
    p = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    p.add_argument("first", help="results.json of one run")
    p.add_argument("second", help="results.json of the other")
    args = p.parse_args()
    try: first, second = read(args.first), read(args.second)
    except (OSError, ValueError) as e: sys.exit("error: %s" % e)
    if first["first_seed"] == second["first_seed"]: print("note: the runs have the same seeds, so they are not independent")
    compared = agreement.pairs(first, second)
    if not compared: sys.exit("error: the two have no ratio with an interval in common")
    for line in agreement.table(compared): print(line)
    apart = sum(not p.agrees for p in compared)
    print("\n%d of %d ratios agree" % (len(compared) - apart, len(compared)))
    sys.exit(1 if apart else 0)


if __name__ == "__main__":
    main()
