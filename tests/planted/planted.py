#!/usr/bin/env python3
"""Plants faults in a copy of the tree and checks that a test or the verdict of a claim detects each.

    planted.py [NAME …]        patches of this folder, without `.patch`; default: all
    planted.py --fit           only checks that every patch has a header and applies to the sources, and that the sample
                               reports have the expected verdicts; builds nothing

A patch begins with a header:

    Fault: the fault in one sentence
    Build: targets of the build, separated by spaces
    Test: one test of one of these targets, Suite.Name                        which must then fail
    Claim: ID of PAPER, from SUITE, VERDICT                                   or a claim, which must no longer have this verdict

For each fault, the unchanged copy is built first and must pass the test or have the verdict. Then the fault is planted and
must be detected. The copy build/planted/tree is kept, so that the next call builds little. Exit code: 0 if all faults are
detected, 1 if one is not, 3 for a wrong name or an invalid patch.
"""

import csv
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tomllib

HERE = pathlib.Path(__file__).resolve().parent
SOURCE = HERE.parents[1]
TREE = SOURCE / "build" / "planted" / "tree"
BUILD = TREE / "build" / "release"
PARTS = ("CMakeLists.txt", "CMakePresets.json", "methods", "bench", "data", "reports", "tests")
KEYS = {"Fault", "Build", "Test", "Claim"}
CLAIM = re.compile(r"(\S+) of (\S+), from (\S+), (confirmed|refuted|depends)")


class BadPatch(Exception):
    pass


class Unexpected(Exception):
    """A failure other than the planted fault."""


def read(file):
    """The patch's header."""
    header = {}
    for line in file.read_text().splitlines():
        if not line.strip():
            break
        key, _, value = line.partition(": ")
        if key not in KEYS or not value:
            raise BadPatch(f"{file.name}: got the line '{line}', expected one of {', '.join(sorted(KEYS))} and a value")
        header[key] = value
    if "Fault" not in header or "Build" not in header or ("Test" in header) == ("Claim" in header):
        raise BadPatch(f"{file.name}: expected Fault, Build, and either Test or Claim")
    if "Claim" in header and not CLAIM.fullmatch(header["Claim"]):
        raise BadPatch(f"{file.name}: got 'Claim: {header['Claim']}', expected 'Claim: ID of PAPER, from SUITE, VERDICT'; "
                       "verdicts: confirmed, refuted, depends")
    return header


def chosen(names):
    known = {file.stem: file for file in sorted(HERE.glob("*.patch"))}
    for name in names:
        if name not in known:
            raise BadPatch(f"no patch '{name}'; known: {' '.join(known)}")
    return {name: known[name] for name in (names or known)}


def synchronise():
    """Makes the copy equal to the tree. Equal files keep their modification time, so that they are not built again."""
    wanted = set()
    for part in PARTS:
        top = SOURCE / part
        for file in [top] if top.is_file() else sorted(top.rglob("*")):
            place = file.relative_to(SOURCE)
            if not file.is_file() or place.parts[:2] == ("reports", "out") or "__pycache__" in place.parts:
                continue
            wanted.add(place)
            copy = TREE / place
            if copy.exists() and copy.read_bytes() == file.read_bytes():
                continue
            copy.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(file, copy)  # with the current time
    for part in PARTS:
        for file in (TREE / part).rglob("*"):
            if file.is_file() and file.relative_to(TREE) not in wanted:
                file.unlink()


def call(command, **options):
    return subprocess.run(command, cwd=TREE, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, **options)


def build(targets):
    environment = os.environ | {"CCACHE_BASEDIR": str(TREE)}
    subprocess.run([str(SOURCE / ".ci" / "drop-stale-builds"), str(BUILD)], check=True)
    if not (BUILD / "build.ninja").exists():
        werror = os.environ.get("DUSTBENCH_WERROR", "OFF")  # as in the tree's own build, whose objects are in the compiler cache
        configured = call(["cmake", "--preset", "release", f"-DDUSTBENCH_WERROR={werror}"], env=environment)
        if configured.returncode != 0:
            raise Unexpected(f"the copy cannot be configured:\n{configured.stdout}")
    jobs = os.environ.get("JOBS", str(os.cpu_count()))
    built = call(["cmake", "--build", str(BUILD), "--parallel", jobs, "--target", *targets], env=environment)
    if built.returncode != 0:
        raise Unexpected(f"{' '.join(targets)} cannot be built:\n{built.stdout[-4000:]}")


def plant(file, *options, tree=TREE):
    planted = subprocess.run(["patch", f"--directory={tree}", "--strip=1", "--forward", "--no-backup-if-mismatch", *options, f"--input={file}"],
                             stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if planted.returncode != 0:
        raise Unexpected(f"the patch no longer applies to the sources:\n{planted.stdout}")


def check_sample(claim):
    """A patch cannot change a verdict that the claim no longer has, or that another suite gives."""
    identity, paper, suite, expected = CLAIM.fullmatch(claim).groups()
    entries = tomllib.loads((SOURCE / "data" / "papers" / paper / "claims.toml").read_text())["claim"]
    judged = [entry.get("suite", suite) for entry in entries if entry["id"] == identity]  # without one, the paper's own suite
    if judged != [suite]:
        raise Unexpected(f"{identity} of {paper}: the patch runs the suite {suite}, the claim is judged from {' '.join(judged) or 'none'}")
    with open(SOURCE / "reports" / "sample" / paper / "claims.csv", newline="", encoding="utf-8") as file:
        found = [row["verdict"] for row in csv.DictReader(file) if row["id"] == identity]
    if found != [expected]:
        raise Unexpected(f"expected {identity} of {paper} to be {expected}; reports/sample has {' '.join(found) or 'no such claim'}")


def fit():
    """Prints the patches that do not apply to the sources; returns the exit code."""
    code = 0
    for name, file in chosen([]).items():
        try:
            header = read(file)
            if "Claim" in header:
                check_sample(header["Claim"])
            changed = re.findall(r"(?m)^\+\+\+ b/(\S+)$", file.read_text())
            if all((SOURCE / path).parent.exists() for path in changed):  # a method's folder may have been deleted
                plant(file, "--dry-run", tree=SOURCE)
        except Unexpected as error:
            print(f"{name}: {error}")
            code = 1
    return code


def test_passes(targets, name):
    for target in targets:
        program = BUILD / target
        listed = call([str(program), f"--gtest_filter={name}", "--gtest_list_tests"])
        if name.split(".")[1] not in listed.stdout:
            continue
        return call([str(program), f"--gtest_filter={name}", "--gtest_brief=1"]).returncode == 0
    raise Unexpected(f"{' and '.join(targets)} have no test {name}")


def verdict(name, identity, paper, suite):
    out = TREE / "out" / name
    shutil.rmtree(out, ignore_errors=True)
    for command in (["suite", suite, "--quick", "--out", str(out)], ["report", str(out)]):
        called = call([str(BUILD / "dustbench"), *command])
        if called.returncode not in (0, 1):  # 1: a run failed, perhaps because of the fault
            raise Unexpected(f"dustbench {' '.join(command)}: exit code {called.returncode}\n{called.stdout[-2000:]}")
    with open(out / "claims.csv", newline="") as file:
        for row in csv.DictReader(file):
            if row["id"] == identity and row["paper"] == paper:
                return row["verdict"]
    raise Unexpected(f"claims.csv has no claim {identity} of {paper}")


def state(name, header):
    """True without a fault in the copy, and the state as text."""
    targets = header["Build"].split()
    build(targets)
    if "Test" in header:
        well = test_passes(targets, header["Test"])
        return well, "passes" if well else "fails"
    *claim, expected = CLAIM.fullmatch(header["Claim"]).groups()
    word = verdict(name, *claim)
    return word == expected, f"is {word}"


def notices(name, file):
    """Tests one fault and prints the result; returns whether it is detected."""
    header = read(file)
    judge = header.get("Test") or f"claim {header['Claim']}"
    print(f"{name}: {header['Fault']}", flush=True)
    synchronise()
    well, word = state(name, header)
    print(f"    without the fault {judge} {word}", flush=True)
    if not well:
        print("    NOT TESTED: it must pass without the fault", flush=True)
        return False
    plant(file)
    well, word = state(name, header)
    print(f"    with it           {judge} {word}: {'NOT DETECTED' if well else 'detected'}", flush=True)
    return not well


def main():
    try:
        if sys.argv[1:] == ["--fit"]:
            return fit()
        patches = chosen(sys.argv[1:])
        for file in patches.values():
            read(file)
    except BadPatch as error:
        print(f"planted: {error}", file=sys.stderr)
        return 3
    noticed = []
    for name, file in patches.items():
        try:
            if notices(name, file):
                noticed.append(name)
        except Unexpected as error:
            print(f"    NOT TESTED: {error}", flush=True)
    print(f"planted: {len(noticed)} of {len(patches)} faults are detected")
    return 0 if len(noticed) == len(patches) else 1


if __name__ == "__main__":
    sys.exit(main())
