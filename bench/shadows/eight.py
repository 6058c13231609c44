#!/usr/bin/env -S python3 -B
"""Errors and costs of all shadow methods, means over the eight cases of the scene family "shadows" (0 .. 7).

    eight.py DAPPLE [--size N] [--samples N] [--cases FIRST-LAST] [--keep FOLDER]

Runs `dapple shadow --compare all` with one thread on each case and prints the means as a Markdown table. Times are
wall times, the least of three runs each: on a busy machine only their ratios say something."""
import argparse
import json
import os
import subprocess
import tempfile

COLUMNS = ("rmse", "penumbra", "contact", "leak", "over_shadow", "ms", "ns_per_pixel", "fetches_per_pixel")
HEADS = ("RMSE", "penumbra", "contact", "leak", "over-shadow", "ms", "ns/px", "fetches/px")
FORMATS = ("%.4f",) * 5 + ("%.1f", "%.0f", "%.1f")


def compare(dapple, folder, case, samples):
    stem = os.path.join(folder, f"shadows-{case:02d}")
    subprocess.run([dapple, "shadow", stem + ".json", "-o", stem + ".png", "--compare", "all", "--samples",
                    str(samples), "--threads", "1", "--stats", stem + ".stats"],
                   check=True, stdout=subprocess.DEVNULL)
    with open(stem + ".stats", encoding="utf-8") as stream:
        return json.load(stream)["methods"]


def print_means(cases):
    print("| method | " + " | ".join(HEADS) + " |")
    print("|---|" + "---|" * len(HEADS))
    for rows in zip(*cases):
        means = [sum(row[key] for row in rows) / len(rows) for key in COLUMNS]
        print(f"| {rows[0]['method']} | " + " | ".join(f % m for f, m in zip(FORMATS, means)) + " |")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("dapple")
    parser.add_argument("--size", type=int, default=512)
    parser.add_argument("--samples", type=int, default=256)
    parser.add_argument("--cases", default="0-7")
    parser.add_argument("--keep", help="leave scenes, sheets and numbers in this folder")
    given = parser.parse_args()
    first, last = (int(part) for part in given.cases.split("-"))
    with tempfile.TemporaryDirectory() as temporary:
        folder = given.keep or temporary
        subprocess.run([given.dapple, "scenes", "shadows", "--seed", "1", "--size", str(given.size), "--out", folder],
                       check=True)
        print_means([compare(given.dapple, folder, case, given.samples) for case in range(first, last + 1)])


if __name__ == "__main__":
    main()
