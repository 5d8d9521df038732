"""The results of dustbench for a case: the ground truth, and the grid as an OpenVDB file."""

import csv
import glob
import os
import shutil
import subprocess

from pictures import read_exr

import cases

HERE = os.path.dirname(os.path.abspath(__file__))


def inputs(case, folder):
    """Writes cloud and camera to files; returns the options that name them."""
    dust, path = os.path.join(folder, "cloud.csv"), os.path.join(folder, "camera.csv")
    with open(dust, "w", newline="") as file:
        table = csv.writer(file)
        table.writerow(["id", "x", "y", "z", "radius", "opacity", "r", "g", "b"])
        for number, puff in enumerate(case.puffs):
            table.writerow([number, *puff.centre, puff.radius, puff.opacity, 1, 1, 1])
    with open(path, "w", newline="") as file:
        table = csv.writer(file)
        table.writerow("time_s,eye_x,eye_y,eye_z,target_x,target_y,target_z,fov_deg".split(","))
        table.writerow([0, *case.eye, *case.target, case.field_of_view])
    return ["--scene", os.path.join(HERE, "black.toml"), "--dust", dust, "--camera-path", path,
            "--size", f"{cases.WIDTH}x{cases.HEIGHT}", "--warmup", "0", "-P", "preroll=0", "--out", os.path.join(folder, "out")]


def call(arguments, **options):
    done = subprocess.run(arguments, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, **options)
    if done.returncode:
        raise RuntimeError(f"{' '.join(arguments)}\nended with {done.returncode}: {done.stdout[-2000:]}")
    return done.stdout


def fresh(folder):
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    return folder


def alphas(program, case, folder):
    """Alpha of the reference image and of the method exact_tiles: white dust in a black scene."""
    options = inputs(case, fresh(folder))
    call([program, "run", "--method", "exact_tiles", "--frames", "1", "--images", "1", "--metrics", *options])
    images = glob.glob(os.path.join(folder, "out", "runs", "*", "images"))[0]
    return tuple(read_exr(os.path.join(images, name))["G"] for name in ("f000000_reference.exr", "f000000.exr"))


def grid(program, case, folder, above_ground=False):
    """The cloud's cell averages in single precision: the file, and the edge of a cell in metres.

    `above_ground`: the centres of the lowest cells are at y = 0, where a march through stored cells ends.
    """
    options = inputs(case, fresh(folder))
    box = case.region
    edge = max(box[i + 3] - box[i] for i in range(3)) / case.resolution
    if above_ground:
        box[1] = -edge / 2
    call([program, "export", "--method", "exact_tiles", "--frames", "0", "--format", "vdb", "--vdb-precision", "float",
          "--resolution", str(case.resolution), "--region=" + ",".join(f"{x:.9g}" for x in box), *options])
    return os.path.join(folder, "out", "f000000.vdb"), edge
