"""Blender's Cycles on the CPU: the grid that dustbench exports as a volume of absorption and emission; see cycles_scene.py."""

import json
import math
import os

from pictures import read_exr
from truth import HERE, call, grid

import cases

NAME, COMMAND, PACKAGE = "cycles", "blender", "blender"


def version():
    return call([COMMAND, "--version"]).splitlines()[0].strip()


def draw(program, case, folder, samples=16, step=0.5):
    """Alpha, the edge of a cell in metres, and the settings as text."""
    file, edge = grid(program, case, folder)
    picture, settings = os.path.join(folder, "picture.exr"), os.path.join(folder, "settings.json")
    with open(settings, "w") as out:
        json.dump({"grid": os.path.abspath(file), "step": step * edge, "ground": case.ground, "angle": math.radians(case.field_of_view),
                   "axes": case.axes, "eye": case.eye, "samples": samples, "size": [cases.WIDTH, cases.HEIGHT],
                   "picture": os.path.abspath(picture)}, out)
    call([COMMAND, "-b", "--factory-startup", "--python-exit-code", "1", "-P", os.path.join(HERE, "cycles_scene.py"), "--", settings])
    return read_exr(picture)["G"], edge, f"step {step} voxel; {samples} samples; filter 0.01; full precision"


def explained(case, edge):
    """A grid widens puffs. Cycles treats a voxel's corner as its centre, which shifts everything by half a voxel along each axis."""
    return case.widened(edge).moved(edge / 2)
