#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Shows the results of equal_time.py as one self-contained HTML page.

usage: report.py [RESULTS.json] [-o report.html]
       report.py RESULTS.json --markdown        prints the table of efficiencies that the page begins with
       report.py RESULTS.json --markdown rmse   prints RMSE at equal time in relation to the base's"""
import argparse
import glob
import json
import os
import sys

from evaluation import images, markdown, page, suite


def newest_results():
    """Of the suites that were run without --out."""
    found = glob.glob(os.path.join(suite.ROOT, "build", "bench", "*", "results.json"))
    if not found: sys.exit("error: no results yet: run equal_time.py first, or name its results.json")
    return max(found, key=os.path.getmtime)


TABLES = {"efficiency": markdown.overview, "rmse": markdown.rmse}


def main():
    p = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    p.add_argument("results", nargs="?", help="results.json, which lies beside its images (the newest in build/bench)")
    p.add_argument("-o", "--out", default="report.html", help="page to write (report.html)")
    p.add_argument("--markdown", nargs="?", const="efficiency", choices=TABLES,
                   help="print the overview as a Markdown table, and write no page")
    args = p.parse_args()
    path = args.results or newest_results()
    folder = os.path.dirname(os.path.abspath(path))
    try:
        with open(path) as f: results = json.load(f)
        if args.markdown: return print(TABLES[args.markdown](results))
        text = page.page(results, images.Folder(folder))
        with open(args.out, "w", encoding="utf-8") as f: f.write(text)
    except (OSError, ValueError) as e: sys.exit("error: %s" % e)
    print(args.out)


if __name__ == "__main__":
    main()
