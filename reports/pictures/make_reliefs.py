#!/usr/bin/env python3
"""Makes the pictures and charts of the guide on reliefs.

    python3 reports/pictures/make_reliefs.py [NAME …]    these are made anew: signs, within, grazing, slalom, paths, angles

Run it from the root of the tree after `make build`. Single pictures are in out/reliefs/. Needs oiiotool and rsvg-convert.
"""

import csv
import json
import math
import pathlib
import re
import subprocess
import sys

PROGRAM = "build/release/dustbench"
OUT = pathlib.Path("out/reliefs")
PICTURES = pathlib.Path("reports/pictures")
# Eye, target (x along the way, y up, metres) and field of view in degrees.
SIGN = ((11.6, 0.95, -0.45), (11.2, 0.8, -1.9), 48)
WITHIN = ((12.1, 0.95, -1.1), (11.28, 0.79, -1.95), 36)
WALL = ((8.0, 1.25, 0.9), (8.0, 0.85, -1.9), 62)


def triple(place):
    return "[" + ", ".join(f"{number:.4f}" for number in place) + "]"


def scene_with(name, camera, changes=()):
    """The scene relief_wall with this fixed camera, and lines replaced."""
    eye, target, degrees = camera
    text = pathlib.Path("data/scenes/relief_wall.toml").read_text()
    for key, value in (("eye", triple(eye)), ("target", triple(target)), ("field_of_view_degrees", f"{degrees:.1f}"), *changes):
        text, count = re.subn(rf"(?m)^{key} = [^#\n]*", f"{key} = {value} ", text)
        assert count > 0, key
    file = OUT / f"{name}.toml"
    file.write_text(text)
    return file


def run(name, scene, options, size, frames, every):
    """Runs the method and returns the folder of its pictures."""
    out = OUT / name
    subprocess.run(
        [PROGRAM, "run", "--method", "relief", "--scene", str(scene), "-P", "camera=fixed", "--size", size, "--warmup", "0",
         "--frames", str(frames), "--images", str(every), "--out", str(out), *options.split()],
        check=True, stdout=subprocess.DEVNULL)
    return max(out.glob("runs/*/images"), key=lambda folder: folder.stat().st_mtime)


def mosaic(pictures, columns, width, target):
    """Scales pictures to a width and puts them side by side."""
    command = ["oiiotool"]
    for picture in pictures:
        command += [str(picture), "--resize", f"{width}x0"]
    rows = -(-len(pictures) // columns)
    subprocess.run([*command, f"--mosaic:pad=6", f"{columns}x{rows}", "-o", str(PICTURES / target)], check=True)


def signs():
    """The sign, fresh and after the car has passed it with two loads of dust."""
    scene = scene_with("sign", SIGN)
    made = [run("sign-fresh", scene, "-P particles=100 -P hardness=1e12", "576x360", 1, 1) / "f000000.png"]
    made.append(run("sign-crater", scene, "-P particles=20000 -P mass_kilograms=0.01", "480x300", 240, 239) / "f000239.png")
    made.append(run("sign-paper", scene, "-P particles=20000 -P ageing=paper", "480x300", 240, 239) / "f000239.png")
    made.append(run("sign-deposit", scene, "-P particles=20000 -P ageing=deposit -P mass_kilograms=0.02", "480x300", 240, 239)
                / "f000239.png")
    mosaic(made, 2, 480, "relief_signs.png")


def grazing():
    """The wall from 86 degrees off its normal: the paper's march, four times its steps, the safe one, the mesh."""
    scene = scene_with("grazing", ((5.7, 1.05, -1.78), (8.0, 1.0, -1.93), 30), [("depth_metres", "0.12")])
    ways = ("march=paper", "march=paper -P linear_steps=60", "march=safe", "march=mesh")
    made = [run(f"grazing-{n}", scene, f"-P particles=10 -P {way}", "576x360", 1, 1) / "f000000.png" for n, way in enumerate(ways)]
    mosaic(made, 2, 480, "relief_grazing.png")


def within():
    """Live particles within the sign, which is deep here. The dust before it is many small puffs, too thin to hide them."""
    dust = pathlib.Path("data/particles/wheel_dust.toml").read_text()
    for key, value in (("average_seconds", 1.2), ("variation_seconds", 0.2), ("start_metres", 0.05), ("end_metres", 0.2), ("speed", 1.5)):
        dust, count = re.subn(rf"(?m)^{key} = .*", f"{key} = {value}", dust)
        assert count == 1, key
    dust = re.sub(r"(?m)^(opacity_\w+ = )([0-9.]+)", lambda found: f"{found[1]}{float(found[2]) / 400}", dust)
    thin = OUT / "thin_dust.toml"
    thin.write_text(dust)
    scene = scene_with("within", WITHIN, [("drive", f'"straight"\ndust = "{thin.resolve()}"')])
    scene.write_text(scene.read_text().replace("depth_metres = 0.02", "depth_metres = 0.25"))  # of the sign alone
    run("within", scene, "-P particles=500000 -P gravity=1 -P grain_metres=0.005 -P hardness=1e6", "720x405", 65, 64)
    mosaic([max(OUT.glob("within/runs/*/images/f000064.png"), key=lambda file: file.stat().st_mtime)], 1, 720, "relief_within.png")


def slalom():
    """The wall before and after the car's slalom."""
    scene = scene_with("slalom", WALL)
    made = [run("wall-fresh", scene, "-P particles=100 -P hardness=1e12", "720x405", 1, 1) / "f000000.png"]
    made.append(run("wall-slalom", scene, "--drive slalom -P particles=30000 -P mass_kilograms=0.01", "720x405", 360, 359) / "f000359.png")
    mosaic(made, 1, 720, "relief_slalom.png")


class Chart:
    """A line chart as SVG, drawn by rsvg-convert."""

    COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#444444", "#a05a2c")
    WIDTH, HEIGHT, LEFT, RIGHT, TOP, BOTTOM = 460, 330, 62, 128, 34, 48

    def __init__(self, title, x_title, y_title, x_range, y_range, x_ticks, y_ticks, x_place=lambda x: x, y_place=lambda y: y):
        self.x_place, self.y_place, self.x_range, self.y_range = x_place, y_place, x_range, y_range
        self.parts = [f'<text x="{self.LEFT}" y="20" font-size="14" font-weight="bold">{title}</text>']
        right, bottom = self.WIDTH - self.RIGHT, self.HEIGHT - self.BOTTOM
        for x, label in x_ticks:
            at = self.x(x)
            self.parts.append(f'<line x1="{at}" x2="{at}" y1="{self.TOP}" y2="{bottom}" stroke="#e4e4e4"/>')
            self.parts.append(f'<text x="{at}" y="{bottom + 16}" text-anchor="middle">{label}</text>')
        for y, label in y_ticks:
            at = self.y(y)
            self.parts.append(f'<line x1="{self.LEFT}" x2="{right}" y1="{at}" y2="{at}" stroke="#e4e4e4"/>')
            self.parts.append(f'<text x="{self.LEFT - 6}" y="{at + 4}" text-anchor="end">{label}</text>')
        self.parts.append(f'<text x="{(self.LEFT + right) / 2}" y="{self.HEIGHT - 10}" text-anchor="middle">{x_title}</text>')
        middle = (self.TOP + bottom) / 2
        self.parts.append(f'<text transform="translate(14 {middle}) rotate(-90)" text-anchor="middle">{y_title}</text>')
        self.names = 0

    def share(self, value, place, ends):
        low, high = place(ends[0]), place(ends[1])
        return (place(value) - low) / (high - low)

    def x(self, value):
        return round(self.LEFT + self.share(value, self.x_place, self.x_range) * (self.WIDTH - self.LEFT - self.RIGHT), 2)

    def y(self, value):
        clamped = min(max(value, min(self.y_range)), max(self.y_range))
        return round(self.HEIGHT - self.BOTTOM - self.share(clamped, self.y_place, self.y_range) * (self.HEIGHT - self.TOP - self.BOTTOM), 2)

    def line(self, name, points, dashed=False):
        colour = self.COLOURS[self.names % len(self.COLOURS)]
        places = " ".join(f"{self.x(x)},{self.y(y)}" for x, y in points)
        dash = ' stroke-dasharray="6 4"' if dashed else ""
        self.parts.append(f'<polyline points="{places}" fill="none" stroke="{colour}" stroke-width="2"{dash}/>')
        self.parts += [f'<circle cx="{self.x(x)}" cy="{self.y(y)}" r="3" fill="{colour}"/>' for x, y in points]
        at = self.TOP + 12 + 18 * self.names
        left = self.WIDTH - self.RIGHT + 12
        self.parts.append(f'<line x1="{left}" x2="{left + 18}" y1="{at - 4}" y2="{at - 4}" stroke="{colour}" stroke-width="2"{dash}/>')
        self.parts.append(f'<text x="{left + 24}" y="{at}">{name}</text>')
        self.names += 1

    def svg(self, left=0):
        return f'<g transform="translate({left} 0)">' + "".join(self.parts) + "</g>"


def write_charts(charts, target):
    width = Chart.WIDTH * len(charts)
    body = "".join(chart.svg(n * Chart.WIDTH) for n, chart in enumerate(charts))
    svg = (f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{Chart.HEIGHT}" font-family="DejaVu Sans" font-size="11">'
           f'<rect width="100%" height="100%" fill="white"/>{body}</svg>')
    (OUT / "chart.svg").write_text(svg)
    subprocess.run(["rsvg-convert", "--zoom", "1.5", "-o", str(PICTURES / target), str(OUT / "chart.svg")], check=True)


def path(law, steps, dt=1 / 60, gravity=-9.8, speed=(1.0, 0.5)):
    """Places of a particle under relief_particles.h's laws, from the origin."""
    (x, y), (u, v), places = (0.0, 0.0), speed, [(0.0, 0.0)]
    for age in range(1, steps + 1):
        t = age * dt if law == "paper" else dt
        x, y = x + u * t, y + v * t + gravity * t * t / 2
        u, v = (u * age, (v + gravity * dt) * age) if law == "paper" else (u, v + gravity * dt)
        places.append((x, y))
    return places


def paths():
    """The paths of both laws of motion, and how far they are after each step."""
    fixed, paper = path("fixed", 24), path("paper", 7)
    near = Chart("Path of a particle, 60 steps a second", "x (m)", "y (m)", (0, 0.8), (-0.8, 0.1),
                 [(x / 10, f"{x / 10:g}") for x in range(0, 9, 2)], [(y / 10, f"{y / 10:g}") for y in range(-8, 2, 2)])
    near.line("fixed", fixed)
    near.line("paper", [(x, y) for x, y in paper if x <= 0.8 and y >= -0.8])
    far = Chart("Distance from the start", "step", "m", (0, 12), (0.01, 1e8), [(n, n) for n in range(0, 13, 2)],
                [(10.0**n, f"10<tspan dy='-4' font-size='8'>{n}</tspan>") for n in range(-2, 9, 2)], y_place=math.log10)
    for name in ("fixed", "paper"):
        far.line(name, [(n, math.hypot(*place)) for n, place in enumerate(path(name, 12)) if n > 0])
    write_charts([near, far], "relief_paths.png")


ANGLES = (0, 45, 70, 80, 86)
STEPS = (8, 15, 30, 60, 120, 240)


def flip(steps, angle):
    """FLIP of the paper's march against the mesh, of the sign seen from this angle."""
    turn = math.radians(12 + angle)
    eye = (11.2 + 1.6 * math.sin(turn), 0.8, -1.9 + 1.6 * math.cos(turn))
    scene = scene_with(f"angle-{angle}", (eye, (11.2, 0.8, -1.9), 34))
    pictures = []
    for name, options in ((f"angle-{angle}-{steps}", f"-P march=paper -P linear_steps={steps}"), (f"angle-{angle}-mesh", "-P march=mesh")):
        folder = OUT / name
        found = sorted(folder.glob("runs/*/images/f000000.png"))
        pictures.append(found[0] if found else run(name, scene, f"-P particles=10 -P preroll=0 -P shadow=off {options}", "320x200", 1, 1) / "f000000.png")
    result = subprocess.run([PROGRAM, "diff", str(pictures[1]), str(pictures[0]), "--json"], capture_output=True, text=True, check=False)
    return json.loads(result.stdout)["flip"]


def angles():
    """What the paper's march misses over angle and steps. The findings are those of `reproduce --paper bergeron`."""
    reproduced = OUT / "reproduced"  # taken as it is if it is there
    if not list(reproduced.rglob("experiments.csv")):
        subprocess.run([PROGRAM, "reproduce", "--paper", "bergeron", "--quick", "--out", str(reproduced)], check=False,
                       stdout=subprocess.DEVNULL)
    table = next(reproduced.rglob("experiments.csv"))
    with open(table, newline="") as file:
        found = {row["quantity"]: float(row["value"]) for row in csv.DictReader(file) if row["experiment"] == "view_angle"}
    ticks = [(n, n) for n in STEPS]
    missed = Chart("Pixels that show the wrong point", "linear steps (and 5 binary)", "share", (8, 240), (1e-4, 1), ticks,
                   [(10.0**n, f"{10.0**n:g}") for n in range(-4, 1)], x_place=math.log, y_place=math.log10)
    for angle in ANGLES:
        missed.line(f"{angle}° off", [(n, found[f"missed_{n}_{angle}"]) for n in STEPS])
    missed.line("safe, worst", [(n, max(found[f"missed_safe_{angle}"] for angle in ANGLES)) for n in (8, 240)], dashed=True)
    difference = Chart("FLIP against the mesh", "linear steps (and 5 binary)", "FLIP", (8, 240), (0, 0.02), ticks,
                       [(n / 200, f"{n / 200:g}") for n in range(0, 5)], x_place=math.log)
    for angle in ANGLES:
        difference.line(f"{angle}° off", [(n, flip(n, angle)) for n in STEPS])
    write_charts([missed, difference], "relief_angles.png")


PICTURES_MADE = {make.__name__: make for make in (signs, within, grazing, slalom, paths, angles)}

if __name__ == "__main__":
    OUT.mkdir(parents=True, exist_ok=True)
    for wanted in sys.argv[1:] or PICTURES_MADE:
        PICTURES_MADE[wanted]()
