"""POV-Ray: a medium whose density is the formula itself, without a grid.

One box with a medium, over a white background and unshaded white ground, so that pixels are transmittances.
"""

import os
import re
import subprocess

from pictures import read_ppm
from truth import call, fresh

import cases

NAME, COMMAND, PACKAGE = "povray", "povray", "povray"

HEAD = """#version 3.7;
global_settings {{ assumed_gamma 1.0 max_trace_level 400 }}
background {{ rgb 1 }}
camera {{ perspective location {eye} direction {ahead} right {right} up {up} }}
"""
PLANE = "plane { y, 0 pigment { rgb 1 } finish { ambient 0 diffuse 0 emission 1 } }\n"
# Pattern values must be within 0 to 1: the pattern is half of the extinction divided by the sum of all peaks.
CLOUD = """box {{ {minimum}, {maximum} hollow pigment {{ rgbt 1 }} finish {{ ambient 0 diffuse 0 }} no_shadow
  interior {{ media {{ absorption {scale:.12g} method 3 intervals 1 samples {samples}, {samples} aa_level 3 aa_threshold 1e-5 jitter 0
    density {{ function {{ {formula} }} color_map {{ [0 rgb 0] [1 rgb 1] }} }} }} }} }}
"""
SAMPLES = 800


def version():
    said = subprocess.run([COMMAND, "--version"], capture_output=True, text=True)
    return "POV-Ray " + re.search(r"POV-Ray ([\d.]+\d)", said.stdout + said.stderr).group(1)


def draw(program, case, folder):
    """Alpha, no cells, and the settings as text."""
    fresh(folder)
    scene, picture = os.path.join(folder, "scene.pov"), os.path.join(folder, "picture.ppm")

    def vector(values, factor=1.0):
        return "<" + ", ".join(f"{value * factor:.12g}" for value in values) + ">"

    (right, up, ahead), (wide, high) = case.axes, case.slopes
    with open(scene, "w") as file:
        file.write(HEAD.format(eye=vector(case.eye), ahead=vector(ahead), right=vector(right, 2 * wide), up=vector(up, 2 * high)))
        file.write(PLANE if case.ground else "")
        scale = 2 * sum(puff.peak for puff in case.puffs)
        formula = " + ".join("{:.12g}*exp(-(pow(x-({:.12g}),2)+pow(y-({:.12g}),2)+pow(z-({:.12g}),2))*{:.12g})".format(
            puff.peak / scale, *puff.centre, 0.5 / puff.deviation ** 2) for puff in case.puffs)
        box = case.region
        file.write(CLOUD.format(minimum=vector(box[:3]), maximum=vector(box[3:]), scale=scale, formula=formula, samples=SAMPLES))
    call([COMMAND, f"+I{scene}", f"+O{picture}", f"+W{cases.WIDTH}", f"+H{cases.HEIGHT}", "+FP16", "File_Gamma=1.0", "-A", "-D",
          "-GA", "+WT2", "Dither=off"])
    return 1 - read_ppm(picture), None, f"method 3; samples {SAMPLES}; jitter 0; 16 bit"


def explained(case, edge):
    """With n samples, method 3 multiplies the depth of a medium that is 0 at both ends of a ray by (n + 4)/(n + 2)."""
    return case.altered(1, (SAMPLES + 4) / (SAMPLES + 2))
