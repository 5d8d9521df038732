#!/usr/bin/env python3
"""Fetches the Stanford bunny: `python3 fetch_bunny.py` writes meshes/bunny.ply beside this file.

It comes from the npm package `bunny` 1.0.1 (licence field: Public Domain; the scan is the Stanford Computer Graphics
Laboratory's) through npm, and its sum is checked before anything is read from it. Python 3, standard library, and npm.
Without it the preset `bunny` uses the hare that make_meshes.py writes.
"""
import hashlib
import json
import os
import re
import subprocess
import sys
import tarfile
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
PACKAGE = "bunny@1.0.1"
SHA512 = ("2ac32def9e44d005588de52741e38fb55346b832e25a327a548a32cb02e6571e"
          "51e90962b8be404b45ff822f8e4430e50597ce683040a9da82bf95c0945f6d09")


def fetch():
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run(["npm", "pack", "--silent", PACKAGE], cwd=folder, check=True, stdout=subprocess.DEVNULL)
        archive = os.path.join(folder, os.listdir(folder)[0])
        with open(archive, "rb") as file:
            got = hashlib.sha512(file.read()).hexdigest()
        if got != SHA512:
            sys.exit(f"fetch_bunny: the sum of {PACKAGE} is {got}, expected {SHA512}: nothing is used of it")
        with tarfile.open(archive) as tar:
            return tar.extractfile("package/index.js").read().decode()


def numbers(text, name):
    return json.loads(re.search(r"exports\." + name + r"\s*=\s*(\[\[.*?\]\])", text, re.S).group(1))


def main():
    text = fetch()
    positions, cells = numbers(text, "positions"), numbers(text, "cells")
    target = os.path.join(HERE, "meshes", "bunny.ply")
    with open(target + ".part", "w") as file:
        file.write("ply\nformat ascii 1.0\ncomment Stanford bunny, npm package bunny 1.0.1\n"
                   f"element vertex {len(positions)}\nproperty float x\nproperty float y\nproperty float z\n"
                   f"element face {len(cells)}\nproperty list uchar int vertex_indices\nend_header\n")
        file.writelines("%.6g %.6g %.6g\n" % tuple(p) for p in positions)
        file.writelines("3 %d %d %d\n" % tuple(c) for c in cells)
    os.replace(target + ".part", target)
    print(f"{target}: {len(positions)} vertices, {len(cells)} triangles")


if __name__ == "__main__":
    main()
