#!/usr/bin/env python3
"""System calls that fail, one at a time: nothing is lost, duplicated or half-written, and no number is wrong.

    faults_test.py PROGRAM LIBRARY WORK [--every N]

LIBRARY is the compiled failing_calls.c, which is preloaded. A small suite is run once for each call of a kind (or every N-th) with
that call failing, and again over its own results. It must exit with 0 or 2 and leave complete results; the same command without the
fault must then finish. The choice of every N-th call depends on the seed, which is printed, so that repeated runs cover all calls.
"""

import argparse
import csv
import errno
import hashlib
import json
import os
import random
import shutil
import struct
import subprocess
import sys

SUITE = """title = "Two short runs"
methods = ["null_method"]
sizes = ["48x36"]
frames = 2
warmup = 0
images = 1
[parameters]
preroll = 0.1
particles = [50, 100]
"""
ERRORS = {"write": (errno.ENOSPC, errno.EDQUOT, errno.EIO, errno.EFBIG),
          "fsync": (errno.EIO, errno.ENOSPC, errno.EDQUOT),
          "open": (errno.EMFILE, errno.ENOSPC, errno.ENFILE),
          "rename": (errno.ENOSPC, errno.EIO), "mkdir": (errno.ENOSPC, errno.EDQUOT), "fork": (errno.EAGAIN, errno.ENOMEM)}
failures = []


class Place:
    def __init__(self, program, library, work):
        self.program, self.library = program, library
        self.work = os.path.abspath(work)
        shutil.rmtree(self.work, ignore_errors=True)
        os.makedirs(self.work)
        self.out = os.path.join(self.work, "out")
        self.count = os.path.join(self.work, "count")
        self.suite = os.path.join(self.work, "suite.toml")
        with open(self.suite, "w", encoding="utf-8") as file:
            file.write(SUITE)

    def call(self, arguments, fault=None):
        """The program's exit code and stderr; `fault` is (kind, n, error number), n with + for all later calls."""
        environment = dict(os.environ)
        if fault:
            with open(self.count, "wb") as file:
                file.write(bytes(8))
            kind, n, number = fault
            environment |= {"LD_PRELOAD": self.library, "DUSTBENCH_FAULT": f"{kind}:{n}:{number}",
                            "DUSTBENCH_FAULT_BELOW": self.work + "/", "DUSTBENCH_FAULT_COUNT": self.count}
        called = subprocess.run([self.program, *arguments], env=environment, capture_output=True, text=True, timeout=300)
        return called.returncode, called.stderr

    def measure(self, fault=None):
        return self.call(["suite", self.suite, "--out", self.out], fault)

    def calls(self):
        with open(self.count, "rb") as file:
            return struct.unpack("q", file.read(8))[0]

    def clear(self):
        shutil.rmtree(self.out, ignore_errors=True)


def sum_of(file):
    with open(file, "rb") as stream:
        return hashlib.sha256(stream.read()).hexdigest()


def faults_of(out, expected=None):
    """Faults in the results that a reader sees; there must be `expected` of them."""
    found = []
    runs = os.path.join(out, "runs")
    names = [name for name in (os.listdir(runs) if os.path.isdir(runs) else []) if not name.startswith(".")]
    for name in names:
        place = os.path.join(runs, name)
        try:
            with open(os.path.join(place, "run.json"), encoding="utf-8") as file:
                record = json.load(file)
        except (OSError, ValueError) as error:
            found.append(f"{name}: {error}")
            continue
        if record["run_id"] != name or record["status"] != "done":
            found.append(f"{name}: is {record['run_id']}, {record['status']}: {record['reason']}")
        for output in record["outputs"] or []:
            file = os.path.join(place, output["file"])
            if not os.path.isfile(file) or sum_of(file) != output["sha256"]:
                found.append(f"{name}: {output['file']} was altered")
    if expected is not None:
        if len(names) != expected:
            found.append(f"{len(names)} runs, expected {expected}")
        hidden = [name for name in os.listdir(runs) if name.startswith(".")]
        if hidden:
            found.append(f"left: {hidden}")
        try:
            with open(os.path.join(out, "summary.csv"), encoding="utf-8", newline="") as file:
                rows = [row["run_id"] for row in csv.DictReader(file)]
        except OSError as error:
            return [*found, str(error)]
        if sorted(rows) != sorted(names):
            found.append(f"summary.csv has {rows}, expected {names}")
    return found


def sums_of_runs(out):
    runs = os.path.join(out, "runs")
    return {name: sum_of(os.path.join(runs, name, "run.json")) for name in os.listdir(runs)
            if os.path.isfile(os.path.join(runs, name, "run.json"))}


def said_wrong(code, said, what):
    """Faults in the exit code and the messages."""
    lines = [line for line in said.splitlines() if line.startswith("dustbench:")]
    found = []
    if code not in (0, 2):
        found.append(f"exit code {code}, allowed: 0 or 2")
    if code == 2 and not any(line.startswith("dustbench: aborted: ") for line in lines):
        found.append("does not report why it was aborted")
    if len(lines) > 1 or any("internal error" in line for line in lines):
        found.append(f"printed {lines}")
    return [f"{what}: {each}; {said[-300:]!r}" for each in found]


def chosen(total, every, chance):
    return range(1 + chance.randrange(min(every, total)), total + 1, every) if total else []


def try_kind(place, kind, every, chance):
    """Lets each chosen call fail, in a fresh suite and in one with existing results."""
    tried = 0
    for fresh in (True, False):
        place.clear()
        if not fresh and place.measure()[0]:
            failures.append("the suite does not run")
            return tried
        before = {} if fresh else sums_of_runs(place.out)
        code, said = place.measure((kind, 0, 0))
        failures.extend(said_wrong(code, said, f"{kind} counted"))
        for n in chosen(place.calls(), every, chance):
            for mark in ("", "+") if chance.random() < 0.3 else ("",):
                if fresh:
                    place.clear()
                number = chance.choice(ERRORS[kind])
                what = f"{kind} {n}{mark} with {errno.errorcode[number]}, {'fresh' if fresh else 'again'}"
                code, said = place.measure((kind, f"{n}{mark}", number))
                failures.extend(said_wrong(code, said, what))
                failures.extend(f"{what}: {each}" for each in faults_of(place.out))
                code, said = place.measure()
                if code:
                    failures.append(f"{what}: the same command then exits with {code}: {said[-300:]!r}")
                failures.extend(f"{what}, then: {each}" for each in faults_of(place.out, 2))
                if not fresh and sums_of_runs(place.out) != before:
                    failures.append(f"{what}: was measured again or lost")
                    place.clear()
                    place.measure()
                    before = sums_of_runs(place.out)
                tried += 1
    return tried


def try_reading(place, every, chance):
    """Memory runs out while results are read: `report` and `merge` abort and write nothing wrong."""
    place.clear()
    place.measure()
    tried = 0
    merged = os.path.join(place.work, "merged")
    for arguments in (["report", place.out], ["merge", "--out", merged, place.out]):
        shutil.rmtree(merged, ignore_errors=True)
        place.call(arguments, ("alloc", 0, 0))
        for n in chosen(place.calls(), every * 4, chance):
            shutil.rmtree(merged, ignore_errors=True)
            code, said = place.call(arguments, ("alloc", n, errno.ENOMEM))
            failures.extend(said_wrong(code, said, f"alloc {n} of {arguments[0]}"))
            failures.extend(f"alloc {n} of {arguments[0]}: {each}" for each in faults_of(place.out, 2))
            tried += 1
    return tried


def try_order(place):
    """Nothing gets its final name before it is on disk, in a fresh suite and in its report."""
    place.clear()
    merged = os.path.join(place.work, "merged")
    shutil.rmtree(merged, ignore_errors=True)
    for arguments in (["suite", place.suite, "--out", place.out], ["merge", "--out", merged, place.out], ["report", place.out]):
        code, said = place.call(arguments, ("unsynced", 0, 0))
        failures.extend(said_wrong(code, said, arguments[0]))
        if place.calls():
            failures.append(f"{arguments[0]}: {place.calls()} files or folders got their final name before they were on disk")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("library")
    parser.add_argument("work")
    parser.add_argument("--every", type=int, default=1)
    parser.add_argument("--seed", type=int, default=random.SystemRandom().randrange(10**6))
    given = parser.parse_args()
    chance = random.Random(given.seed)
    place = Place(os.path.abspath(given.program), os.path.abspath(given.library), given.work)
    tried = {kind: try_kind(place, kind, given.every, chance) for kind in ERRORS}
    tried["alloc"] = try_reading(place, given.every, chance)
    try_order(place)
    print(f"seed {given.seed}: " + ", ".join(f"{count} of {kind}" for kind, count in tried.items()))
    for failure in failures[:40]:
        print(failure)
    print(f"{len(failures)} failures")
    return 1 if failures or not all(tried.values()) else 0


if __name__ == "__main__":
    sys.exit(main())
