"""Fuzzes readers with mutated files, and the program with mutated command lines and results, each round with another seed.

    long_run.py --minutes M --readers FUZZ_TESTS --program DUSTBENCH --findings FOLDER [--seed SEED] [--cases N]

The default seed is the time; it is printed, and DUSTBENCH_FUZZ_SEED=SEED repeats a round. Each failure leaves a folder in FOLDER with the
output and, if a reader crashed, the file that it was reading. Exit code: 1 if anything was found.
"""

import argparse
import os
import pathlib
import shutil
import subprocess
import sys
import time

HERE = pathlib.Path(__file__).resolve().parent
ROUND_SECONDS = 1_200


def targets_of(readers, program):
    """Name and command of each target."""
    listed = subprocess.run([readers, "--gtest_list_tests", "--gtest_filter=Fuzz.*"], capture_output=True, text=True, check=True)
    targets = [(line.strip(), [readers, "--gtest_brief=1", "--gtest_filter=Fuzz." + line.strip()])
               for line in listed.stdout.splitlines() if line.startswith("  ")]
    for name in ("command_lines", "damaged_folders"):
        targets.append((name, [sys.executable, "-B", str(HERE / f"{name}_test.py"), program]))
    return targets


def one_round(name, command, seed, cases, findings):
    """True without a failure."""
    folder = findings / f"{name}-{seed}"
    (folder / "files").mkdir(parents=True)
    environment = dict(os.environ, TMPDIR=str(folder / "files"), DUSTBENCH_FUZZ_SEED=str(seed), DUSTBENCH_FUZZ_CASES=str(cases))
    with open(folder / "output.txt", "wb") as output:
        try:
            code = subprocess.run(command, env=environment, stdout=output, stderr=subprocess.STDOUT, timeout=ROUND_SECONDS).returncode
        except subprocess.TimeoutExpired:
            code = "none (timed out)"
    if code == 0:
        shutil.rmtree(folder)
    else:
        print(f"found: {name}, seed {seed}, exit code {code}: {folder}", flush=True)
    return code == 0


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--minutes", type=float, required=True)
    for name in ("readers", "program", "findings"):
        parser.add_argument("--" + name, required=True)
    parser.add_argument("--seed", type=int, default=int(time.time()))
    parser.add_argument("--cases", type=int, default=3_000)
    given = parser.parse_args()
    end, seed, counts, found = time.monotonic() + 60 * given.minutes, given.seed, {}, 0
    print(f"seed {seed}", flush=True)
    while time.monotonic() < end:
        for name, command in targets_of(given.readers, given.program):
            whole_program = name in ("command_lines", "damaged_folders")
            cases = max(given.cases // 30, 1) if whole_program else given.cases
            if time.monotonic() >= end:
                break
            found += not one_round(name, command, seed, cases, pathlib.Path(given.findings))
            counts[name] = counts.get(name, 0) + cases
        seed += 1
    for name, count in counts.items():
        print(f"{count:>9}  {name}")
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
