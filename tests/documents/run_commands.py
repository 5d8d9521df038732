"""Runs the commands of a document in a temporary folder, with options that shorten them.

    run_commands.py PROGRAM DOCUMENT

Commands are the fenced blocks marked `sh`. Comments directly before a block change how it is run:

    <!-- short: --frames 2 -->       replaces these options in each line of the block that calls dustbench
    <!-- exit: 3 -->                 the exit code of the block's last line; with several numbers, one of them
    <!-- not run: the reason -->     skips the block

Debian's Python runs the blocks marked `python`, each after all earlier ones. Without pandas they are skipped, except in CI (`CI` is set),
where that is an error.

A fenced block below a line that contains only `` `FILE` `` is first written to that file. The folder looks like the tree, with
`build/release/dustbench` in its place. It is removed afterwards, with everything that the commands have written.
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
BLOCK = re.compile(r"(?m)(?P<comments>(?:^<!--[^\n]*-->\n)*)^(?:`(?P<file>[^`\n]+)`\n)?^```(?P<kind>\w+)\n(?P<text>(?:.*\n)*?)^```$")


def said(comments, word):
    found = re.search(rf"<!-- {word}: (.*?) -->", comments)
    return found[1] if found else None


def commands(text):
    """The lines of a block, with continued lines joined."""
    return [line for line in text.replace("\\\n", " ").splitlines() if line.strip() and not line.startswith("#")]


def shortened(line, short):
    """The line with these options in place of its own; the name of `-P name=value` is `-P name`."""
    for option, value in re.findall(r"(--?[\w-]+)(?: (?!--)(\S+))?", short):
        if option == "-P":
            line = re.sub(rf" -P {re.escape(value.split('=')[0])}=\S+", "", line)
        else:
            line = re.sub(rf" {option}\b" + (r" \S+" if value else ""), "", line)
    return f"{line} {short}"


def work_folder(program):
    folder = pathlib.Path(tempfile.mkdtemp(prefix="dustbench-document-"))
    (folder / "build" / "release").mkdir(parents=True)
    (folder / "build" / "release" / "dustbench").symlink_to(program)
    (folder / "out").mkdir()
    for name in ("data", "methods", "Makefile"):
        (folder / name).symlink_to(ROOT / name)
    (folder / "reports").mkdir()
    for entry in (ROOT / "reports").iterdir():
        if entry.name != "out":
            (folder / "reports" / entry.name).symlink_to(entry)
    return folder


PYTHON = "/usr/bin/python3"


def has_pandas():
    there = pathlib.Path(PYTHON).exists() and subprocess.run([PYTHON, "-c", "import pandas"], capture_output=True).returncode == 0
    if not there and os.environ.get("CI"):
        sys.exit(f"{PYTHON} has no pandas; run .ci/install pandas")
    return there


def main(program, document):
    text = pathlib.Path(document).read_text()
    folder = work_folder(pathlib.Path(program).resolve())
    environment = {name: value for name, value in os.environ.items() if name != "DUSTBENCH_DATA"}
    count, session = 0, ""
    try:
        for block in BLOCK.finditer(text):
            comments = block["comments"]
            if block["file"]:
                (folder / block["file"]).parent.mkdir(parents=True, exist_ok=True)
                (folder / block["file"]).write_text(block["text"])
            if said(comments, "not run"):
                continue
            if block["kind"] == "python" and not block["file"]:
                session += block["text"]
                if has_pandas():
                    called = subprocess.run([PYTHON, "-W", "error", "-c", session], cwd=folder, env=environment, capture_output=True, text=True)
                    count += 1
                    if called.returncode:
                        sys.exit(f"{document}: Python ended with exit code {called.returncode} at\n{block['text']}{called.stderr}")
            if block["kind"] != "sh":
                continue
            lines = commands(block["text"])
            short = said(comments, "short")
            expected = [int(code) for code in (said(comments, "exit") or "0").split()]
            for number, line in enumerate(lines):
                command = shortened(line, short) if short and "dustbench " in line else line
                called = subprocess.run(["bash", "-c", command], cwd=folder, env=environment, capture_output=True, text=True)
                wanted = expected if number + 1 == len(lines) else [0]
                count += 1
                if called.returncode not in wanted:
                    sys.exit(f"{document}: `{command}` ended with exit code {called.returncode}, expected {wanted}\n{called.stderr}{called.stdout[-2000:]}")
    finally:
        shutil.rmtree(folder)
    if count == 0:
        sys.exit(f"{document}: contains no command to run")
    print(f"{document}: {count} commands")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
