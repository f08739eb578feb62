#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Shows the results of equal_time.py as one self-contained HTML page.

usage: report.py RESULTS.json -o report.html
       report.py RESULTS.json --markdown        prints the table of efficiencies that the page begins with"""
import argparse
import json
import os
import sys

from evaluation import images, markdown, page


def main():
    p = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    p.add_argument("results", help="results.json; the images it names are relative to its folder")
    p.add_argument("-o", "--out", default="report.html", help="page to write (report.html)")
    p.add_argument("--markdown", action="store_true", help="print the overview as a Markdown table, and write no page")
    args = p.parse_args()
    folder = os.path.dirname(os.path.abspath(args.results))
    try:
        with open(args.results) as f: results = json.load(f)
        if args.markdown: return print(markdown.overview(results))
        text = page.page(results, images.Folder(folder))
    except (OSError, ValueError) as e: sys.exit("error: %s" % e)
    with open(args.out, "w", encoding="utf-8") as f: f.write(text)


if __name__ == "__main__":
    main()
