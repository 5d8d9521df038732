#!/usr/bin/env python3
"""Makes carr_geyer.png: billboards (above) and the octree (below), as Carr & Geyer print them (left) and by the optical
model (right), all of the same dust at the same moment.

    python3 reports/pictures/make_carr_geyer.py

Run it from the root of the tree after `make build`. Needs oiiotool.
"""

import pathlib
import shutil
import subprocess

OUT = pathlib.Path("out/carr_geyer")
SIZE, CUT, SHOWN = "1600x900", "960x540+300+240", "640x360"  # the car and the trail behind it
TILES = [(method, mode) for method in ("billboard", "octree_recursive") for mode in ("paper", "fixed")]


def draw(method, mode):
    runs = OUT / "runs" / f"{method}_{mode}"
    shutil.rmtree(runs, ignore_errors=True)
    own = [] if mode == "paper" else ["-P", "policy=accumulate"] if method == "octree_recursive" else ["-P", "soft=true"]
    subprocess.run(["build/release/dustbench", "run", "--method", method, "-P", f"mode={mode}", *own, "--scene", "carr_plain", "-P", "speed=10", "--seed", "1", "--size", SIZE,
                    "--warmup", "0", "--frames", "1", "--images", "1", "--out", str(runs)], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    picture = next((runs / "runs").glob("*/images/f000000.png"))
    tile = OUT / f"{method}_{mode}.png"
    subprocess.run(["oiiotool", str(picture), "--ch", "R,G,B", "--cut", CUT, "--resize", SHOWN, "-o", str(tile)], check=True)
    return str(tile)


OUT.mkdir(parents=True, exist_ok=True)
tiles = [draw(method, mode) for method, mode in TILES]
subprocess.run(["oiiotool", *tiles, "--mosaic:pad=4", "2x2", "-o", "reports/pictures/carr_geyer.png"], check=True)
