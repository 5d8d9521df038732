#!/usr/bin/env python3
"""Makes voxel_shapes.png, the presets of voxel_shape, each seen from nearby; and voxel_slices.png, what the paper's
slices leave of a shape: bunny, figure and car (rows) by slices along z, slices along all axes, and all voxels (columns).

    python3 reports/pictures/make_voxel_shapes.py [NAME …]    these are drawn anew; default: all

Run it from the root of the tree after `make build`; `python3 data/shapes/fetch_bunny.py` first brings the bunny, in whose
place a hare sits otherwise. Single tiles are in out/voxel_shapes/NAME.png. Needs oiiotool.
"""

import pathlib
import re
import shutil
import subprocess
import sys

OUT = pathlib.Path("out/voxel_shapes")
DRAWN, SHOWN = "576x400", "240x167"  # size of a tile

# Name: the eye's and the target's place (x ahead, y up, z to the right of the car, metres), seconds before the picture, options.
VIEWS = {
    "car": ((-1.2, 2.3, 3.6), (-4.4, 0.55, -2.9), 1.5, ""),
    "helicopter": ((0.8, 2.8, 8.4), (-5.0, 3.9, 0.5), 1.5, ""),
    "figure": ((0.2, 1.9, 6.0), (-4.0, 1.5, 2.2), 1.5, "-P sprite_pixels=8"),
    "bunny": ((-0.4, 2.2, 6.6), (-4.0, 1.25, 2.0), 1.5, ""),
    "bunny_lit": ((-4.2, 2.2, 7.4), (-4.0, 1.25, 2.0), 1.5, ""),
    "crossing": ((0.2, 1.9, 6.4), (-4.1, 1.45, 2.2), 1.95, ""),
    "forces": ((-0.2, 2.3, 6.9), (-5.6, 0.85, -0.6), 1.5, ""),
    "stressed": ((-1.4, 2.2, 6.9), (-4.7, 1.0, 1.2), 1.5, ""),
    "dusty": ((0.6, 2.0, 5.4), (-2.9, 1.4, 0.4), 2.5, "-P particles=4000"),
    "whirl": ((0.0, 2.3, 8.6), (-4.0, 1.9, 2.2), 2.0, ""),
    "fire": ((-1.0, 1.2, 4.8), (-4.0, 0.75, 1.5), 1.5, ""),
    "fade": ((-0.5, 1.5, 5.0), (-3.5, 0.9, 2.0), 1.5, ""),
    "loaded": ((-3.6, 1.9, 7.4), (-4.2, 1.2, 1.4), 1.5, ""),
    "laden": ((0.0, 2.3, 8.6), (-4.0, 1.9, 2.2), 2.0, ""),
    "spikes_drawn": ((-0.5, 2.0, 6.8), (-3.5, 1.6, 2.0), 1.5, ""),
    "ball": ((-0.5, 2.0, 6.8), (-3.5, 1.0, 2.0), 1.5, ""),
}
SLICED = {}
for shape in ("bunny", "figure", "car"):
    for voxeliser in ("slices", "slices_xyz", "conservative"):
        eye, target, seconds, options = VIEWS[shape]
        SLICED[f"{shape}-{voxeliser}"] = (eye, target, seconds, f"{options} -P shape={shape} -P voxeliser={voxeliser}")


def triple(place):
    return "[" + ", ".join(f"{number:.3f}" for number in place) + "]"


def scene_with(name, eye, target):
    """The plain scene with this camera."""
    text = pathlib.Path("data/scenes/plain.toml").read_text()
    folder = pathlib.Path("data/scenes").resolve()
    text = re.sub(r'"(meshes|heights)/', rf'"{folder}/\1/', text)
    text = re.sub(r"(?m)^offset = .*", f"offset = {triple(eye)}", text)
    text = re.sub(r"(?m)^look_at = \[-4\.2.*", f"look_at = {triple(target)}", text)
    text = re.sub(r"(?m)^field_of_view_degrees = .*", "field_of_view_degrees = 36", text)
    file = OUT / f"{name}.toml"
    file.write_text(text)
    return file


def draw(name):
    eye, target, seconds, options = (VIEWS | SLICED)[name]
    runs = OUT / "runs" / name
    shutil.rmtree(runs, ignore_errors=True)
    frame = round(60 * seconds)
    command = ["build/release/dustbench", "run", "--method", "voxel_shape", *([] if "shape=" in options else ["-P", f"shape={name}"]), "--scene", str(scene_with(name, eye, target)),
               "-P", "preroll=0.5", "--size", DRAWN, "--warmup", "0", "--frames", str(frame + 1),
               "--images", str(frame), *options.split(), "--out", str(runs)]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def tile(name):
    picture = sorted((OUT / "runs" / name).glob("runs/*/images/*.png"))[-1]
    file = str(OUT / f"{name}.png")
    subprocess.run(["oiiotool", str(picture), "--ch", "R,G,B", "--resize", SHOWN, "-o", file], check=True)
    return file


def sheet(names, columns, file):
    tiles = [tile(name) for name in names]
    layout = f"{columns}x{-(-len(tiles) // columns)}"
    subprocess.run(["oiiotool", *tiles, "--mosaic", layout, "-d", "uint8", "--compression", "zip:9", "-o", f"reports/pictures/{file}"], check=True)


def main(names):
    OUT.mkdir(parents=True, exist_ok=True)
    for name in names or VIEWS | SLICED:
        draw(name)
    sheet(VIEWS, 4, "voxel_shapes.png")
    sheet(SLICED, 3, "voxel_slices.png")


if __name__ == "__main__":
    main(sys.argv[1:])
