"""`report` on damaged results: it exits with 0 as long as one run is complete, and names every run with a damaged file.

    damaged_folders_test.py PROGRAM

100 folders, or DUSTBENCH_FUZZ_CASES; DUSTBENCH_FUZZ_SEED selects others. Each is a copy of a small result of three runs, of which up to
two have one to three files cut, changed, removed or replaced; tables next to the runs may also be damaged.
"""

import collections
import concurrent.futures
import os
import pathlib
import random
import shutil
import sys
import tempfile

import called

SUITE = ('title = "tiny"\nmethods = ["billboard"]\nsizes = ["64x48"]\nframes = 4\nwarmup = 0\nrepetitions = 3\nbaseline = false\n'
         "images = 2\n[parameters]\npreroll = 0.1\nparticles = 50\n")
JSON = [b'"abc"', b"1e999", b"-1", b"2147483647", b"null", b"[]", b"{}", b"[" * 3_000, b'"' + b"7" * 50_000 + b'"', b'"__proto__"', b"\x1b[31m"]


def damaged(content, chance):
    """A damaged copy; never equal to the original."""
    kind, at = chance.randrange(6), chance.randrange(len(content) + 1)
    if kind == 0:
        changed = content[:at]
    elif kind == 1:
        changed = content[:at] + chance.randbytes(1 + chance.randrange(8)) + content[at:]
    elif kind == 2:
        changed = content[:at] + content[at + 1 + chance.randrange(20):]
    elif kind == 3:
        changed = content[:at] + chance.randbytes(1) + content[at + 1:]
    elif kind == 4:
        values = [found for found in range(len(content)) if content[found:found + 2] in (b": ", b",")]
        at = (chance.choice(values) + 1) if values else at
        changed = content[:at] + chance.choice(JSON) + content[at + 1 + chance.randrange(12):]
    else:
        changed = chance.randbytes(len(content))
    return changed if changed != content else content + b"\0"


def damage(file, chance):
    """Damages the file; returns how."""
    kind = chance.randrange(10)
    if kind < 6:
        file.write_bytes(damaged(file.read_bytes(), chance))
        return "changed"
    file.unlink()
    if kind == 6:
        return "removed"
    if kind == 7:
        os.mkfifo(file)
        return "a pipe"
    if kind == 8:
        file.symlink_to(chance.choice([file.name, "/dev/zero", "/proc/self/mem", "..", "/nowhere"]))
        return "a link"
    file.mkdir()
    return "a folder"


def damage_folder(folder, chance):
    """Damages runs; returns them with file and kind of damage."""
    done = []
    runs = sorted(folder.glob("runs/*"))
    for run in chance.sample(runs, 1 + chance.randrange(2)):
        files = sorted(file for file in run.rglob("*") if file.is_file() and file.name != "log.txt")
        for file in chance.sample(files, 1 + chance.randrange(3)):
            done.append((run.name, file.name, damage(file, chance)))
    if chance.randrange(3) == 0:
        damage(folder / "summary.csv", chance)
    return done


def main(program):
    program = str(pathlib.Path(program).resolve())
    count = called.cases(100)
    with tempfile.TemporaryDirectory(prefix="dustbench-damaged-") as place:
        place = pathlib.Path(place)
        (place / "tiny.toml").write_text(SUITE)
        made = called.Call(program, ["suite", "tiny.toml", "--out", "whole"], place)
        if made.code != 0 or len(list(place.glob("whole/runs/*"))) != 3:
            sys.exit(f"the result to damage: exit code {made.code}: {made.err.decode()}")

        def one(number):
            chance = random.Random(called.seed() * 100_000 + number)
            parent = place / str(number)
            shutil.copytree(place / "whole", parent / "res")
            done = damage_folder(parent / "res", chance)
            call = called.Call(program, ["report", "res", "--pictures", "1"], parent)
            if call.code != 0:
                call.faults.append(f"exit code {call.code}")
            said = (call.out + call.err).decode(errors="replace")
            # A changed run.json is read as it is: nothing else records its original content, nor then that of the other files.
            rewritten = {run for run, file, way in done if (file, way) == ("run.json", "changed")}
            for run, file, way in done:
                if run not in said and run not in rewritten:
                    call.faults.append(f"{file} of {run} was {way}, but not reported")
            if not (parent / "res" / "index.html").is_file():
                call.faults.append("no page")
            shutil.rmtree(parent)
            return call, [way for _, _, way in done]

        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            results = list(pool.map(one, range(count)))
    ways = collections.Counter(way for _, done in results for way in done)
    print(f"{count} damaged folders, seed {called.seed()}: {dict(ways)}; at most {max(call.seconds for call, _ in results):.1f} s and "
          f"{max(call.resident_bytes for call, _ in results) / 1e6:.0f} MB")
    faulty = [f"folder {number}: {call}" for number, (call, _) in enumerate(results) if call.faults]
    if faulty:
        sys.exit(f"{len(faulty)} of them:\n" + "\n".join(faulty[:20]))


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(sys.argv[1])
