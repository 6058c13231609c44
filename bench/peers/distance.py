#!/usr/bin/python3 -B
"""The exact distance transform beside its peers: OpenCV, SciPy, npm's distance-transform.

    distance.py [--sizes PX,PX] [--rounds N] [--node-modules DIR] [--out DIR]

Run by hand, as docs/benchmarks.md says; nothing else needs these packages. `bench_distance` draws the pictures and
times ours; each round runs every transform in turn, on one thread, and counts processor time. What is missing is
named, with the way to get it, and left out. Writes peers-distance.csv and peers-distance.md.

Distances are between pixels' centres in all of them; `off` is the greatest difference from ours, which tests hold
against brute force."""
import argparse
import csv
import json
import os
import re
import shutil
import statistics
import subprocess
import sys
import tempfile
import time

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
PROGRAM = os.path.join(ROOT, "build", "release", "bench", "bench_distance")
SCRIPT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "distance.mjs")
COLUMNS = ("picture", "size", "transform", "cpu_ms_min", "cpu_ms_median", "samples", "off")
SAMPLES = 3  # of a transform in a round; ours takes as many of each instruction set

try:
    import numpy
except ImportError:
    sys.exit("distance.py: numpy is missing: apt-get install python3-numpy, and run with /usr/bin/python3")


class Peer:
    """A transform in this process: made ready once per picture, then timed."""

    def __init__(self, name, prepare, run):
        self.name, self.prepare, self.run = name, prepare, run

    def sample(self, walls, count):
        """Processor times [ms] and the distances."""
        ready, times = self.prepare(walls), []
        for _ in range(count):
            start = time.thread_time()
            found = self.run(ready)
            times.append((time.thread_time() - start) * 1e3)
        return times, found


def opencv():
    import cv2
    cv2.setNumThreads(1)
    return Peer(f"OpenCV {cv2.__version__}", lambda walls: numpy.where(walls, 0, 255).astype(numpy.uint8),
                lambda free: cv2.distanceTransform(free, cv2.DIST_L2, cv2.DIST_MASK_PRECISE))


def scipy():
    import scipy as package
    from scipy import ndimage
    return Peer(f"SciPy {package.__version__}", lambda walls: walls == 0, ndimage.distance_transform_edt)


class NodePeer:
    """npm's, in a node of its own that is kept from round to round, so that its code is compiled."""

    def __init__(self, modules):
        self.node = subprocess.Popen(["node", SCRIPT, modules], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                     stderr=subprocess.DEVNULL, text=True)
        hello = self.node.stdout.readline()
        if not hello:
            raise ImportError("node ended")
        self.name = json.loads(hello)["name"]

    def sample(self, walls, count):
        with tempfile.TemporaryDirectory() as folder:
            inward, outward = os.path.join(folder, "in"), os.path.join(folder, "out")
            walls.tofile(inward)
            request = {"size": walls.shape[0], "count": count, "in": inward, "out": outward}
            print(json.dumps(request), file=self.node.stdin, flush=True)
            times = json.loads(self.node.stdout.readline())["times"]
            return times, numpy.fromfile(outward, numpy.float64).reshape(walls.shape)


def peers_here(modules):
    """Those that load; says which do not."""
    wanted = (("OpenCV", opencv, "apt-get install --no-install-recommends python3-opencv"),
              ("SciPy", scipy, "apt-get install --no-install-recommends python3-scipy"),
              ("npm's distance-transform", lambda: NodePeer(modules),
               "npm install --prefix DIR distance-transform ndarray, then --node-modules DIR/node_modules"))
    here = []
    for name, load, remedy in wanted:
        try:
            here.append(load())
        except (ImportError, OSError) as fault:
            print(f"distance.py: without {name} ({fault}): {remedy}", file=sys.stderr)
    return here


def ours(folder, size, pictures):
    """One run of bench_distance: {(picture, instruction set): least ms}."""
    command = [PROGRAM, "--smallest", str(size), "--largest", str(size), "--rounds", str(SAMPLES), "--out", folder]
    subprocess.run(command + (["--pictures"] if pictures else []), check=True, stderr=subprocess.DEVNULL)
    with open(os.path.join(folder, "distance.csv"), encoding="utf-8") as file:
        return {(row["picture"], row["isa"]): float(row["cpu_ms_min"]) for row in csv.DictReader(file)}


def plane(folder, picture, size, ending, kind):
    return numpy.fromfile(os.path.join(folder, f"{picture}-{size}.{ending}"), kind).reshape(size, size)


def measure(folder, size, rounds, peers):
    """Rows of COLUMNS for one size."""
    times, off = {}, {}
    for turn in range(rounds):
        for (picture, isa), least in ours(folder, size, turn == 0).items():
            times.setdefault((picture, f"Dapple, {isa}"), []).append(least)
        for picture in dict.fromkeys(key[0] for key in times):
            walls = plane(folder, picture, size, "u8", numpy.uint8)
            known = plane(folder, picture, size, "f32", numpy.float32).astype(numpy.float64)
            for peer in peers:
                taken, found = peer.sample(walls, SAMPLES)
                # a first round makes ready: planes are allocated, code is compiled
                times.setdefault((picture, peer.name), []).extend([min(taken)] if turn else [])
                off[picture, peer.name] = float(numpy.max(numpy.abs(found - known)))
    return [(picture, size, name, min(all_of), statistics.median(all_of), len(all_of),
             off.get((picture, name), 0.0)) for (picture, name), all_of in times.items()]


def write_csv(path, rows):
    with open(path, "w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(COLUMNS)
        writer.writerows((*row[:3], f"{row[3]:.4f}", f"{row[4]:.4f}", row[5], f"{row[6]:.3g}") for row in rows)


def off_text(off):
    return "" if off == 0 else f" [{off:.0f}]" if off >= 10 else f" [{off:.1g}]"


def write_table(path, command, about, rows):
    names = list(dict.fromkeys(row[2] for row in rows))
    cells = {(row[0], row[1], row[2]): row for row in rows}
    with open(path, "w", encoding="utf-8") as file:
        file.write("# The exact distance transform beside its peers\n\n")
        file.write(f"- command: `{command}`\n{about}\n")
        file.write(f"Processor time of one thread [ms]: least (median) of the rounds, each the least of {SAMPLES} in a "
                   "row; all took turns.\nIn brackets behind: greatest difference from ours [px], where it is not 0.\n\n")
        file.write("| walls | px | " + " | ".join(names) + " |\n|---|---|" + "---|" * len(names) + "\n")
        for picture, size in dict.fromkeys((row[0], row[1]) for row in rows):
            line = [picture, str(size)]
            for name in names:
                row = cells[picture, size, name]
                line.append(f"{row[3]:.2f} ({row[4]:.2f})" + off_text(row[6]))
            file.write("| " + " | ".join(line) + " |\n")


def slug_of(machine):
    """A folder's name, as the benchmarks make it."""
    return re.sub(r"[^a-z0-9]+", "-", re.sub(r"\(.*?\)", "", machine).lower().split("@")[0]).strip("-")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--sizes", default="512,2048")
    parser.add_argument("--rounds", type=int, default=12, help="at least 2; the first of peers is not counted")
    parser.add_argument("--node-modules", default="node_modules")
    parser.add_argument("--out", help="default bench/results/MACHINE")
    options = parser.parse_args()
    if options.rounds < 2 or not os.path.exists(PROGRAM) or not shutil.which("node"):
        parser.error("needs at least 2 rounds, node, and bench_distance built by the release preset")
    peers = peers_here(os.path.abspath(options.node_modules))
    with tempfile.TemporaryDirectory() as folder:
        rows = []
        for size in options.sizes.split(","):
            rows += measure(folder, int(size), options.rounds, peers)
        with open(os.path.join(folder, "distance.md"), encoding="utf-8") as file:
            about = "".join(line for line in file if line.startswith("- ") and "command:" not in line)
    machine = re.search("- machine: ([^,]*)", about).group(1)
    out = options.out or os.path.join(ROOT, "bench", "results", slug_of(machine))
    os.makedirs(out, exist_ok=True)
    write_csv(os.path.join(out, "peers-distance.csv"), rows)
    write_table(os.path.join(out, "peers-distance.md"),
                f"bench/peers/distance.py --sizes {options.sizes} --rounds {options.rounds}", about, rows)


if __name__ == "__main__":
    main()
