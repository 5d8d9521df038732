"""OpenVDB's vdb_render: a march through the grid that dustbench exports.

Its alpha is 1 - T, T the product of exp(-k d h) over the samples d of a ray, h voxels apart; k = scatter + absorb. With k the edge
of a voxel in metres, k h d is the optical depth of a step. It does not support a ground: the grid ends there.
"""

import os
import re

from pictures import read_exr
from truth import call, grid

import cases

NAME, COMMAND, PACKAGE = "vdb_render", "vdb_render", "libopenvdb-tools"


def version():
    return "OpenVDB " + re.search(r"OpenVDB (?:library version|version)?:? ?([\d.]+)", call([COMMAND, "-version"])).group(1)


def draw(program, case, folder):
    """Alpha, the edge of a cell in metres, and the settings as text."""
    # The sum over the steps is nearly exact if the ray begins and ends outside; if it is cut, half a step's depth is missing.
    step = 0.1 if case.ground or case.name == "inside" else 0.5
    file, edge = grid(program, case, folder, above_ground=case.ground)
    picture = os.path.join(folder, "picture.exr")
    wide = 2 * case.slopes[0] * 50  # width of the aperture, with a focal length of 50

    def triple(values):
        return ",".join(f"{value:.9g}" for value in values)

    call([COMMAND, file, picture, "-camera", "perspective", "-focal", "50", "-aperture", f"{wide:.9g}",
          "-translate", triple(case.eye), "-lookat", triple(case.target), "-up", "0,1,0", "-near", "1e-6",
          "-res", f"{cases.WIDTH}x{cases.HEIGHT}", "-compression", "none", "-cpus", "2",
          "-absorb", triple([edge] * 3), "-scatter", "0,0,0", "-gain", "0", "-cutoff", "0", "-step", str(step),
          "-shadowstep", "1e6"])
    return read_exr(picture)["A"], edge, f"step {step} voxel; gain 0; cutoff 0"


def explained(case, edge):
    """A grid widens puffs."""
    return case.widened(edge)
