#!/usr/bin/env python3
"""Compares our ground truth with pictures of other programs: a row for each program and case.

    external.py PROGRAM [--with povray,vdb_render,cycles] [--cases one_puff,…] [--width F] [--mass F] [--write figures.csv]

PROGRAM is dustbench. `--width` and `--mass` plant a fault: our puffs become F times as wide or as heavy as theirs. Exit code: 1 if a
figure misses its limit, 77 if none of the other programs is installed.
"""

import argparse
import csv
import datetime
import os
import shutil
import sys
import tempfile

try:
    import numpy
except ImportError:
    sys.exit("external.py: needs python3-numpy")

import truth
import with_cycles
import with_povray
import with_vdb_render
from cases import CASES

OTHERS = {other.NAME: other for other in (with_povray, with_vdb_render, with_cycles)}
PSNR_BAR_DB = 50.0
DEPTH_BAR = 0.004  # 1 % of mass changes alpha by at most 0.0037, which PSNR does not detect
COLUMNS = ("program version case settings cell_m psnr_mask_db error_max depth_ratio tiles_psnr_mask_db explained_psnr_mask_db "
           "explained_error_max explained_depth_ratio holds date").split()


def figures(theirs, ours):
    """PSNR of alpha within the mask, the maximum error there, and the ratio of the sums of the optical depths."""
    mask = (theirs > 1 / 255) | (ours > 1 / 255)
    error = (theirs - ours)[mask]
    middle = (ours > 0.02) & (ours < 0.9)  # below, rounding dominates; above, the logarithm of rounding
    depths = [numpy.log1p(-numpy.clip(alpha[middle], 0, 0.9999)).sum() for alpha in (theirs, ours)]
    return -10 * numpy.log10(max(1e-20, (error ** 2).mean())), numpy.abs(error).max(), depths[0] / depths[1]


def holds(psnr, ratio):
    return psnr >= PSNR_BAR_DB and abs(ratio - 1) <= DEPTH_BAR


def compare(program, other, case, work, width, mass):
    def folder(name):
        return os.path.join(work, f"{other.NAME}-{case.name}-{name}")

    theirs, edge, settings = other.draw(program, case, folder("theirs"))
    judge, tiles = truth.alphas(program, case.altered(width, mass), folder("ours"))
    model, _ = truth.alphas(program, other.explained(case, edge).altered(width, mass), folder("explained"))
    numpy.savez(folder("alpha.npz"), theirs=theirs, ours=judge, explained=model)
    psnr, error, ratio = figures(theirs, judge)
    model_psnr, model_error, model_ratio = figures(theirs, model)
    good = "yes" if holds(psnr, ratio) else "explained" if holds(model_psnr, model_ratio) else "no"
    return dict(zip(COLUMNS, (
        other.NAME, other.version(), case.name, settings, f"{edge:.6g}" if edge else "", f"{psnr:.2f}", f"{error:.6f}", f"{ratio:.6f}",
        f"{figures(theirs, tiles)[0]:.2f}", f"{model_psnr:.2f}", f"{model_error:.6f}", f"{model_ratio:.6f}", good,
        datetime.date.today().isoformat())))


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("--with", dest="others", default=",".join(OTHERS))
    parser.add_argument("--cases", default=",".join(case.name for case in CASES))
    parser.add_argument("--width", type=float, default=1.0)
    parser.add_argument("--mass", type=float, default=1.0)
    parser.add_argument("--write")
    parser.add_argument("--keep", help="folder for scenes and pictures; default: a temporary one")
    given = parser.parse_args()
    work = given.keep or tempfile.mkdtemp(prefix="dustbench-external-")
    rows = []
    try:
        for name in given.others.split(","):
            if name not in OTHERS:
                parser.error(f"--with {name}: expected {', '.join(OTHERS)}")
            if not shutil.which(OTHERS[name].COMMAND):
                print(f"skipped {name}: needs {OTHERS[name].COMMAND} (Debian package {OTHERS[name].PACKAGE})", file=sys.stderr)
                continue
            for case in CASES:
                if case.name in given.cases.split(","):
                    rows.append(compare(os.path.abspath(given.program), OTHERS[name], case, work, given.width, given.mass))
                    row = rows[-1]
                    print(f"{name:11} {case.name:9} {row['psnr_mask_db']:>6} dB, error {row['error_max']}, depth x {row['depth_ratio']}; "
                          f"explained {row['explained_psnr_mask_db']:>6} dB, depth x {row['explained_depth_ratio']}: {row['holds']}", flush=True)
    except (RuntimeError, ValueError, OSError) as error:
        sys.exit(f"external.py: {error}")
    finally:
        if not given.keep:
            shutil.rmtree(work, ignore_errors=True)
    missed = any(row["holds"] == "no" for row in rows)
    if given.write and rows:
        done = {(row["program"], row["case"]) for row in rows}
        if os.path.exists(given.write):  # keeps rows of programs that are not installed
            with open(given.write, newline="") as file:
                rows = [row for row in csv.DictReader(file) if (row["program"], row["case"]) not in done] + rows
        with open(given.write, "w", newline="") as file:
            table = csv.DictWriter(file, COLUMNS, lineterminator="\n")
            table.writeheader()
            table.writerows(rows)
    if not rows:
        return 77
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
