"""Mutated command lines: for any arguments the program ends in time, reports errors in one line, and needs little memory.

    command_lines_test.py PROGRAM

300 cases, or DUSTBENCH_FUZZ_CASES; DUSTBENCH_FUZZ_SEED selects others. `called.py` defines the faults. Each case has a folder with all
its files, and links to devices and system files; no argument points outside it.
"""

import collections
import concurrent.futures
import json
import os
import pathlib
import random
import re
import shutil
import struct
import sys
import tempfile
import zlib

import called

RUN = "--frames 2 --warmup 1 --size 64x48 -P particles=50 -P preroll=0.1 --out out".split()
BASES = [
    ["list", "methods", "--json"],
    ["list", "parts"],
    ["list", "metrics", "--data", "data"],
    ["run", "--method", "billboard", *RUN],
    ["run", "--method", "billboard", "--seed", "3", "--threads", "2", "--sync", "stage", "--images", "1", *RUN],
    ["run", "--method", "octree_search", "--volumes", "0:2:1", "--format", "vti,vdb", "--resolution", "8", *RUN],
    ["run", "--method", "billboard", "--scene", "scene.toml", "--drive", "drive.csv", "--dust", "dust.toml", *RUN],
    ["suite", "suite.toml", "--dry-run", "--out", "out"],
    ["suite", "suite.toml", "--repetitions", "1", "--timeout", "5", "--order", "batch", "--out", "out"],
    ["suite", "suite.toml", "--slurm", "3", "--out", "out"],
    ["compare", "./res", "./other", "--fail-on-regression", "5", "--columns", "fps_avg,frame_ms_p95"],
    ["merge", "--out", "merged", "res", "other"],
    ["report", "res", "--pictures", "1"],
    ["report", "res", "--text"],
    ["report", "res", "--chart", "frames", "--format", "svg"],
    ["report", "res", "other", "--out", "out/page.html"],
    ["report", "./res", "./other", "--label", "a", "--label", "b", "--text"],
    ["diff", "a.png", "b.png", "--json"],
    ["diff", "a.png", "b.png", "--out", "d.png", "--pixels-per-degree", "67"],
    ["export", "--method", "billboard", "--frames", "0:2:1", "--format", "vti", "--resolution", "8", "-P", "particles=50",
     "-P", "preroll=0.1", "--out", "out"],
    ["view", "--method", "billboard", "-P", "particles=50", "-P", "preroll=0.1", "--picture", "p.png", "--frame", "1"],
]
NUMBERS = ["-1", "0", "1", "nan", "inf", "1e999", "-1e-310", "2147483648", "-9223372036854775809", "18446744073709551616", "0x7f",
           " 7", "7 ", "1e3", "1_000", "٣", "1:1000000:1", "0.001:10:0.000001", "1:0:1", "0:1:0", "1,2,", ""]
PIECES = ["\x1b[31m", "\x07", "\x7f", "\n", "\t", "\r\n", "\udcff", "\u202e", "'", '"', "=", ",", ":", "*", "%s%n", "--", "-", " ",
          "A" * 5_000, "é" * 3_000, "__proto__"]
PATHS = ["zero", "full", "memory", "pipe", "loop", "folder", "missing/none", "empty", "binary", "sparse", "deep.toml", "bomb.png",
         "res", "res/runs", "suite.toml", "scene.toml", "a.png", "out", ".", ""]
OPTIONS = ["--out", "--frames", "--size", "--seed", "--threads", "--data", "--adapter", "--json", "--method", "-P", "--scene",
           "--drive", "--dust", "--camera-path", "--at", "--metrics", "--volumes", "--format", "--region", "--help", "--version",
           "--nothing", "--dry-run", "--shard", "--repetitions", "--cooldown", "--images", "--text", "--chart", "--across-machines"]


def png(width, height, shade):
    """A grey picture; `shade` is a number, or None for a picture that is shorter than its header states."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    rows = b"" if shade is None else (b"\0" + bytes([shade]) * width) * height
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def make_template(program, folder):
    data = pathlib.Path(__file__).resolve().parents[2] / "data"
    (folder / "folder").mkdir()
    (folder / "data" / "scenes").mkdir(parents=True)
    shutil.copy(data / "scenes" / "plain.toml", folder / "scene.toml")
    shutil.copy(data / "scenes" / "plain.toml", folder / "data" / "scenes" / "mine.toml")
    shutil.copy(data / "drives" / "slalom.csv", folder / "drive.csv")
    shutil.copy(data / "particles" / "fountain.toml", folder / "dust.toml")
    (folder / "suite.toml").write_text(
        'title = "tiny"\nmethods = ["billboard"]\nsizes = ["64x48"]\nframes = 2\nwarmup = 0\nrepetitions = 1\nbaseline = false\n'
        "[parameters]\npreroll = 0.1\nparticles = [50, 60]\n")
    (folder / "a.png").write_bytes(png(16, 12, 90))
    (folder / "b.png").write_bytes(png(16, 12, 100))
    (folder / "bomb.png").write_bytes(png(30_000, 30_000, None))
    (folder / "empty").write_bytes(b"")
    (folder / "binary").write_bytes(random.Random(1).randbytes(5_000))
    (folder / "deep.toml").write_text("a = " + "[" * 31_000)
    for name, target in (("zero", "/dev/zero"), ("full", "/dev/full"), ("memory", "/proc/self/mem"), ("loop", "loop")):
        (folder / name).symlink_to(target)
    for name in ("res", "other"):
        call = called.Call(program, ["run", "--method", "billboard", *RUN[:-1], name], folder)
        if call.code != 0:
            sys.exit(f"the template's run ends with {call.code}: {call.err.decode()}")


def copy_template(template, folder):
    shutil.copytree(template, folder, symlinks=True)
    os.mkfifo(folder / "pipe")
    with open(folder / "sparse", "wb") as file:
        file.truncate(10**12)


def stays_inside(argument):
    """True if no part that could be a path leaves the folder of the case."""
    return not re.search(r"(^|[=:,'\"\s])/|\.\.", argument)


def mutated(argument, chance):
    kind = chance.randrange(5)
    at = chance.randrange(len(argument) + 1)
    if kind == 0 and re.search(r"\d", argument):
        number = chance.choice([found.span() for found in re.finditer(r"[\d.]+", argument)])
        return argument[:number[0]] + chance.choice(NUMBERS) + argument[number[1]:]
    if kind == 1:
        return argument[:at] + chance.choice(PIECES) + argument[at:]
    if kind == 2:
        return argument[:at] + argument[at + 1 + chance.randrange(3):]
    if kind == 3:
        return argument[:at] + chr(chance.randrange(1, 127)) + argument[at + 1:]
    return chance.choice(PATHS)


def mutated_line(chance):
    line = list(chance.choice(BASES))
    for _ in range(1 + chance.randrange(3)):
        at = chance.randrange(len(line)) if line else 0
        kind = chance.randrange(10)
        if kind < 6 and line:
            changed = mutated(line[at], chance)
            line[at] = changed if stays_inside(changed) else "7"
        elif kind == 6 and line:
            del line[at]
        elif kind == 7 and line:
            line.insert(at, line[chance.randrange(len(line))])
        elif kind == 8 and line:
            other = chance.randrange(len(line))
            line[at], line[other] = line[other], line[at]
        else:
            line[at:at] = [chance.choice(OPTIONS), chance.choice(NUMBERS + PATHS)][:1 + chance.randrange(2)]
    return [argument.encode("utf-8", "surrogateescape") for argument in line]


def main(program):
    program = str(pathlib.Path(program).resolve())
    chance = random.Random(called.seed())
    lines = [mutated_line(chance) for _ in range(called.cases(300))]
    with tempfile.TemporaryDirectory(prefix="dustbench-lines-") as place:
        template = pathlib.Path(place) / "template"
        template.mkdir()
        make_template(program, template)

        def one(number):
            folder = pathlib.Path(place) / str(number)
            copy_template(template, folder)
            call = called.Call(program, lines[number], folder)
            shutil.rmtree(folder)
            return call

        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            calls = list(pool.map(one, range(len(lines))))
    codes = collections.Counter(call.code for call in calls)
    print(f"{len(calls)} command lines, seed {called.seed()}, exit codes {json.dumps(dict(sorted(codes.items())))}, at most "
          f"{max(call.seconds for call in calls):.1f} s and {max(call.resident_bytes for call in calls) / 1e6:.0f} MB")
    faulty = [str(call) for call in calls if call.faults]
    if faulty:
        sys.exit(f"{len(faulty)} of them:\n" + "\n".join(faulty[:20]))


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(sys.argv[1])
