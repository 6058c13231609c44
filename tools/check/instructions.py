#!/usr/bin/env -S python3 -B
"""Did anything get slower? Instructions of small pieces of work, counted by callgrind and held against a stored
table. Counts repeat to parts per million however busy the machine is. Called by tools/check/test.sh.

    instructions.py              fails when a count is off its stored one by more than the tolerance
    instructions.py --update     stores this compiler's counts anew
    instructions.py --only NAME  one piece of work (bench_gate --list says which there are)
    instructions.py --where NAME where its instructions are, by function

Counts belong to a compiler: the table, bench/gate/instructions.csv, has rows for each that it knows. For any
other there is nothing to compare with, which is said and, where CI is set, is an error."""
import argparse
import concurrent.futures
import csv
import os
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
TABLE = os.path.join(ROOT, "bench", "gate", "instructions.csv")
PROGRAM = os.path.join(ROOT, "build", "release", "bench", "bench_gate")
COLUMNS = ("compiler", "isa", "work", "instructions")
# Callgrind of Debian 12 knows AVX2 and hides AVX-512.
ISA = "avx2"
TOLERANCE = 0.01
# The C library picks its memcpy() by the processor: the same one everywhere.
PLAIN_LIBC = "glibc.cpu.hwcaps=-AVX512F,-AVX512VL,-AVX512BW,-ERMS,-FSRM"


def compiler_of(program):
    """As the program says that it was built: "gcc 12.2.0, Release"."""
    return subprocess.run([program, "--about"], stdout=subprocess.PIPE, check=True, text=True).stdout.strip()


def names_of(program):
    listed = subprocess.run([program, "--list"], stdout=subprocess.PIPE, check=True, text=True).stdout
    return [line.split("\t")[0] for line in listed.splitlines()]


def profile(program, name, out):
    """Writes callgrind's file: what ran between the entry and the return of the function that is measured."""
    command = ["valgrind", "--tool=callgrind", f"--callgrind-out-file={out}",
               "--toggle-collect=dpl_bench_gate_measured", program, "--work", name, "--isa", ISA]
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                          env={"PATH": os.environ["PATH"], "GLIBC_TUNABLES": PLAIN_LIBC})
    if done.returncode != 0:
        said = [line for line in done.stderr.splitlines() if not line.startswith("==")]
        raise RuntimeError(f"{name}: {said[-1] if said else done.stderr.strip()}")


def count(program, name):
    with tempfile.TemporaryDirectory() as folder:
        out = os.path.join(folder, "counts")
        profile(program, name, out)
        with open(out, encoding="ascii", errors="replace") as file:
            total = re.search(r"^totals: (\d+)$", file.read(), re.MULTILINE)
    if not total or int(total.group(1)) == 0:
        raise RuntimeError(f"{name}: callgrind counted nothing")
    return int(total.group(1))


def print_where(program, name):
    """The functions that hold 95 % of the instructions."""
    with tempfile.TemporaryDirectory() as folder:
        out = os.path.join(folder, "counts")
        profile(program, name, out)
        listed = subprocess.run(["callgrind_annotate", "--threshold=95", out], stdout=subprocess.PIPE,
                                check=True, text=True).stdout
    for number, share, function in re.findall(r"^ *([\d,]+) \( *([\d.]+)%\) +\S*:(\S+)", listed, re.MULTILINE):
        print(f"{number:>14} {share:>6} %  {function}")


def count_all(program, names):
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        return dict(zip(names, pool.map(lambda name: count(program, name), names)))


def read_table():
    """{(compiler, isa, work): instructions}"""
    if not os.path.exists(TABLE):
        return {}
    with open(TABLE, encoding="utf-8", newline="") as file:
        return {tuple(row[c] for c in COLUMNS[:3]): int(row[COLUMNS[3]]) for row in csv.DictReader(file)}


def write_table(table):
    with open(TABLE, "w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(COLUMNS)
        writer.writerows(key + (number,) for key, number in table.items())


def verdict(stored, found):
    """What to say of one count, and whether it is good."""
    if stored is None:
        return "not in the table: run instructions.py --update", False
    change = found / stored - 1
    if change > TOLERANCE:
        return f"{change:+.2%}: SLOWER than the table allows", False
    if change < -TOLERANCE:
        return f"{change:+.2%}: faster; run instructions.py --update to keep it", False
    return f"{change:+.4%}", True


def compare(table, key, found):
    wrong = 0
    for name, number in found.items():
        text, good = verdict(table.get(key + (name,)), number)
        wrong += not good
        print(f"{name:20} {number:12,}  {text}")
    return wrong


def update(table, key, found, names):
    """Keeps the rows of other compilers, and drops those of work that there is no more."""
    kept = {k: n for k, n in table.items() if k[:2] != key or k[2] in names}
    kept.update({key + (name,): number for name, number in found.items()})
    order = {name: i for i, name in enumerate(names)}
    write_table(dict(sorted(kept.items(), key=lambda item: (item[0][:2], order.get(item[0][2], -1)))))


def main():
    parser = argparse.ArgumentParser(description="instructions of small pieces of work, against a stored table")
    parser.add_argument("program", nargs="?", default=PROGRAM, help="bench_gate, of a release build")
    parser.add_argument("--update", action="store_true", help="store the counts")
    parser.add_argument("--only", metavar="NAME", help="one piece of work")
    parser.add_argument("--where", metavar="NAME", help="print the functions of one piece of work")
    arguments = parser.parse_args()
    if not shutil.which("valgrind"):
        sys.exit("instructions: valgrind is not installed (tools/check/setup.sh test installs it)")
    key = (compiler_of(arguments.program), ISA)
    table = read_table()
    names = names_of(arguments.program)
    chosen = [arguments.only] if arguments.only else names
    if arguments.where:
        print_where(arguments.program, arguments.where)
        return 0
    if not arguments.update and not any(k[:2] == key for k in table):
        print(f"instructions: the table has no counts of {key[0]}, {ISA}: nothing to compare with")
        return 1 if os.environ.get("CI") else 0
    try:
        found = count_all(arguments.program, chosen)
    except RuntimeError as error:
        sys.exit(f"instructions: {error}")
    if arguments.update:
        update(table, key, found, names)
    wrong = compare(table if not arguments.update else read_table(), key, found)
    stale = [k[2] for k in table if k[:2] == key and k[2] not in names]
    if stale and not arguments.update:
        print("instructions: in the table, but no work any more:", ", ".join(stale))
    print(f"{len(found)} counts of {key[0]}, {ISA}; tolerance {TOLERANCE:.0%}; {wrong} outside it")
    return 1 if wrong or (stale and not arguments.update) else 0


if __name__ == "__main__":
    sys.exit(main())
