#!/usr/bin/env python3
"""Kills at random moments: finished results stay, and nothing is duplicated or half-written.

    kills.py PROGRAM WORK [--kills 1000]

Commands that write results, merge, report, export and bundle are started in one folder and killed after a random time, alone or with
their children. After each kill, every result that a reader sees must be complete, and earlier results must not be missing or changed.
At the end, all commands must finish.
"""

import argparse
import hashlib
import os
import random
import shutil
import signal
import subprocess
import sys
import tarfile
import time

from faults_test import Place, faults_of, sum_of

SUITE = """title = "Twelve short runs"
methods = ["null_method"]
sizes = ["48x36"]
frames = 2
warmup = 0
images = 1
seed = [1, 2, 3, 4, 5, 6]
[parameters]
preroll = 0.1
particles = [50, 100]
"""


def commands(place):
    merged, volumes = os.path.join(place.work, "merged"), os.path.join(place.work, "volumes")
    bundle = os.path.join(place.work, "bundle.tar")
    return {"suite": ["suite", place.suite, "--out", place.out], "merge": ["merge", "--out", merged, place.out],
            "report": ["report", place.out],
            "export": ["export", "--method", "billboard", "--frames", "0:4:1", "--resolution", "16", "--size", "48x36",
                       "-P", "particles=50", "-P", "preroll=0.1", "--format", "vti,vtp,vdb", "--out", volumes],
            "bundle": ["bundle", place.out, "--out", bundle]}


def finished(folder):
    runs = os.path.join(folder, "runs")
    names = [name for name in (os.listdir(runs) if os.path.isdir(runs) else []) if not name.startswith(".")]
    return {name: sum_of(os.path.join(runs, name, "run.json")) for name in names}


def volumes_of(folder):
    """A file under its final name is complete: OpenVDB and VTK files have their proper end."""
    found = []
    for name in os.listdir(folder) if os.path.isdir(folder) else []:
        path = os.path.join(folder, name)
        if name.startswith(".") or not os.path.isfile(path):
            continue
        if name.endswith((".vti", ".vtp", ".pvd", ".vtm")):
            with open(path, "rb") as file:
                if not file.read().rstrip().endswith(b"</VTKFile>"):
                    found.append(f"{name} is incomplete")
        elif os.path.getsize(path) == 0:
            found.append(f"{name} is empty")
    return found


def bundle_of(work):
    """A bundle under its final name contains every file that it lists, unchanged. It is removed, so that the next one can be packed."""
    bundle = os.path.join(work, "bundle.tar")
    if not os.path.exists(bundle):
        return []
    try:
        with tarfile.open(bundle) as archive:
            texts = {entry.name.split("/", 1)[1]: archive.extractfile(entry).read() for entry in archive}
        sums = {name: hashlib.sha256(text).hexdigest() for name, text in texts.items()}
        lines = texts["SHA256SUMS"].decode().splitlines()
        listed = dict(reversed(line.split("  ", 1)) for line in lines)
        found = [f"{name} of the bundle does not match its checksum" for name in listed if sums.get(name) != listed[name]]
        if not listed or len(sums) != len(listed) + 1:
            found.append(f"the bundle contains {len(sums)} files and lists {len(listed)}")
    except (tarfile.TarError, KeyError, IndexError, ValueError) as error:
        found = [f"the bundle is incomplete: {error}"]
    os.remove(bundle)
    return found


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("work")
    parser.add_argument("--kills", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=random.SystemRandom().randrange(10**6))
    given = parser.parse_args()
    chance = random.Random(given.seed)
    place = Place(os.path.abspath(given.program), "", given.work)
    with open(place.suite, "w", encoding="utf-8") as file:
        file.write(SUITE)
    merged, volumes = os.path.join(place.work, "merged"), os.path.join(place.work, "volumes")
    failures, killed = [], dict.fromkeys(commands(place), 0)
    before, before_merged, rounds = {}, {}, 0
    for kill in range(given.kills):
        name = chance.choices(list(killed), (6, 2, 1, 2, 2))[0]
        process = subprocess.Popen([place.program, *commands(place)[name]], stdout=subprocess.DEVNULL,
                                   stderr=subprocess.DEVNULL, start_new_session=True)
        time.sleep(chance.random() * (1.2 if name == "suite" else 0.4))
        killed[name] += process.poll() is None
        if chance.random() < 0.5:
            process.kill()
        else:
            try:
                os.killpg(process.pid, signal.SIGKILL)
            except ProcessLookupError:
                pass
        process.wait()
        now, now_merged = finished(place.out), finished(merged)
        found = faults_of(place.out) + faults_of(merged) + volumes_of(volumes) + bundle_of(place.work)
        found += [f"{run} is gone or changed" for run in before if now.get(run) != before[run]]
        found += [f"merged {run} is gone or changed" for run in before_merged if now_merged.get(run) != before_merged[run]]
        failures.extend(f"kill {kill} of {name}: {each}" for each in found)
        before, before_merged = now, now_merged
        if len(now) == 12:  # complete: start again
            rounds += 1
            for folder in (place.out, merged, volumes):
                shutil.rmtree(folder, ignore_errors=True)
            before, before_merged = {}, {}
    for name, command in commands(place).items():
        code, said = place.call(command)
        if code:
            failures.append(f"{name} then exits with {code}: {said[-300:]!r}")
    if not os.path.exists(os.path.join(place.work, "bundle.tar")):
        failures.append("bundle then packs nothing")
    failures.extend(faults_of(place.out, 12) + faults_of(merged, 12) + volumes_of(volumes) + bundle_of(place.work))
    print(f"seed {given.seed}: {given.kills} kills, " + ", ".join(f"{count} of {name}" for name, count in killed.items()) +
          f" while it worked; {rounds} complete suites")
    for failure in failures[:40]:
        print(failure)
    print(f"{len(failures)} failures")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
