#!/usr/bin/env python3
"""Draws work_precision.svg and work_precision_structure.svg from work_precision.csv, the points.csv of `dustbench precision`,
and prints the table of reports/guide/work-precision.md.

    python3 reports/pictures/make_work_precision.py

Run it from the root of the tree, with any Python.
"""

import csv
import math
import pathlib

HERE = pathlib.Path(__file__).parent
PROBLEMS = {"plume": "plume past a ball", "ring": "vortex ring against a wall", "car": "car in a wind tunnel"}
SOLVERS = {"dustbench": "#1f6fb4", "mantaflow": "#c8501e"}
SCHEMES = {"revert_midstep": ("12 2", "inverted"), "revert": ("", "circle"), "clamp": ("7 3", "square"), "unlimited": ("2 3", "diamond"), "midpoint": ("9 3 2 3", "diamond"), "semi_lagrangian": ("4 4", "triangle")}
CHARTS = {
    "work_precision": {"density_error": "error of the density", "velocity_error": "error of the velocity"},
    "work_precision_structure": {"enstrophy_error": "error of the enstrophy", "spectrum_error": "error of the spectrum"},
}
WIDTH, HEIGHT, LEFT, TOP, GAP_X, GAP_Y = 290, 230, 66, 66, 34, 66


def points():
    rows = list(csv.DictReader((HERE / "work_precision.csv").open()))
    references = {(row["problem"], row["reference"], row["reference_cells"]) for row in rows}
    return [row for row in rows if (row["problem"], row["solver"], row["cells"]) not in references and row["ms_per_second"]]


def mark(shape, x, y, colour, filled):
    fill = colour if filled else "white"
    style = f'fill="{fill}" stroke="{colour}" stroke-width="1.5"'
    if shape == "circle":
        return f'<circle cx="{x:.1f}" cy="{y:.1f}" r="4" {style}/>'
    corners = {"square": [(-4, -4), (4, -4), (4, 4), (-4, 4)], "diamond": [(0, -5), (5, 0), (0, 5), (-5, 0)], "triangle": [(0, -5), (5, 4), (-5, 4)], "inverted": [(0, 5), (5, -4), (-5, -4)]}[shape]
    return f'<polygon points="{" ".join(f"{x + a:.1f},{y + b:.1f}" for a, b in corners)}" {style}/>'


class Panel:
    """One chart, both of its axes logarithmic."""

    def __init__(self, left, top, xs, ys):
        self.left, self.top = left, top
        self.x = (math.log10(min(xs)) - 0.1, math.log10(max(xs)) + 0.1)
        self.y = (math.log10(min(ys)) - 0.08, math.log10(max(ys)) + 0.08)

    def across(self, value):
        return self.left + WIDTH * (math.log10(value) - self.x[0]) / (self.x[1] - self.x[0])

    def up(self, value):
        return self.top + HEIGHT * (1 - (math.log10(value) - self.y[0]) / (self.y[1] - self.y[0]))

    def axes(self):
        yield f'<rect x="{self.left}" y="{self.top}" width="{WIDTH}" height="{HEIGHT}" fill="none" stroke="#888"/>'
        for (low, high), place, vertical in ((self.x, self.across, False), (self.y, self.up, True)):
            wide = high - low > 1.6
            for decade in range(math.floor(low), math.ceil(high) + 1):
                for digit in (1,) if wide else (1, 2, 5):
                    value = digit * 10.0**decade
                    if not low <= math.log10(value) <= high:
                        continue
                    at, text = place(value), f"{value:,g}"
                    if vertical:
                        yield f'<line x1="{self.left}" x2="{self.left + WIDTH}" y1="{at:.1f}" y2="{at:.1f}" stroke="#e4e4e4"/>'
                        yield f'<text x="{self.left - 6}" y="{at + 4:.1f}" text-anchor="end">{text}</text>'
                    else:
                        yield f'<line x1="{at:.1f}" x2="{at:.1f}" y1="{self.top}" y2="{self.top + HEIGHT}" stroke="#e4e4e4"/>'
                        yield f'<text x="{at:.1f}" y="{self.top + HEIGHT + 16}" text-anchor="middle">{text}</text>'


def curves(panel, rows, measure):
    """A line for each solver, scheme and reference: filled marks against dustbench's reference, hollow ones against Mantaflow's."""
    keys = sorted({(row["solver"], row["scheme"], row["reference"]) for row in rows})
    for solver, scheme, reference in keys:
        own = sorted((float(row["ms_per_second"]), float(row[measure])) for row in rows if (row["solver"], row["scheme"], row["reference"]) == (solver, scheme, reference))
        colour, (dash, shape) = SOLVERS[solver], SCHEMES[scheme]
        filled = reference == "dustbench"
        places = [(panel.across(x), panel.up(y)) for x, y in own]
        path = " ".join(f"{x:.1f},{y:.1f}" for x, y in places)
        yield f'<polyline points="{path}" fill="none" stroke="{colour}" stroke-width="{1.6 if filled else 0.8}" stroke-dasharray="{dash}"/>'
        for x, y in places:
            yield mark(shape, x, y, colour, filled)


def legend(width, names):
    x, y = LEFT, 22
    for solver, colour in SOLVERS.items():
        yield f'<rect x="{x}" y="{y - 9}" width="18" height="9" fill="{colour}"/><text x="{x + 24}" y="{y}">{solver if solver == "dustbench" else "Mantaflow"}</text>'
        x += 112
    for scheme, (dash, shape) in SCHEMES.items():
        if scheme not in names:
            continue
        yield f'<line x1="{x}" x2="{x + 34}" y1="{y - 4}" y2="{y - 4}" stroke="#444" stroke-width="1.6" stroke-dasharray="{dash}"/>' + mark(shape, x + 17, y - 4, "#444", True)
        yield f'<text x="{x + 40}" y="{y}">{scheme.replace("_", "-")}</text>'
        x += 62 + 7 * len(scheme)
    yield f'<text x="{LEFT}" y="{y + 20}" fill="#555">filled, thick: against dustbench’s reference; hollow, thin: against Mantaflow’s. Left and below is better. revert-midstep was timed on another day: see the text.</text>'


def draw(name, measures, rows):
    width = LEFT + len(PROBLEMS) * WIDTH + (len(PROBLEMS) - 1) * (GAP_X + 30) + 36
    height = TOP + len(measures) * (HEIGHT + GAP_Y)
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" viewBox="0 0 {width} {height}" font-family="sans-serif" font-size="12" fill="#222">',
             f'<rect width="{width}" height="{height}" fill="white"/>']
    parts += legend(width, {row["scheme"] for row in rows})
    for column, (problem, title) in enumerate(PROBLEMS.items()):
        ofProblem = [row for row in rows if row["problem"] == problem]
        left = LEFT + column * (WIDTH + GAP_X + 30)
        for line, (measure, label) in enumerate(measures.items()):
            top = TOP + 8 + line * (HEIGHT + GAP_Y)
            if not ofProblem:
                continue
            panel = Panel(left, top, [float(row["ms_per_second"]) for row in ofProblem], [max(float(row[measure]), 1e-3) for row in ofProblem])
            for row in ofProblem:
                row[measure] = max(float(row[measure]), 1e-3)
            parts += panel.axes()
            parts += curves(panel, ofProblem, measure)
            parts.append(f'<text x="{left}" y="{top - 8}" font-weight="bold">{title}: {label}</text>')
            parts.append(f'<text x="{left + WIDTH / 2}" y="{top + HEIGHT + 34}" text-anchor="middle">ms of computing per simulated second</text>')
    parts.append("</svg>")
    (HERE / f"{name}.svg").write_text("\n".join(parts) + "\n")


def table(rows):
    """Errors against dustbench's reference / Mantaflow's."""
    print("| Problem | Solver, scheme | Cells | ms per second | Density | Velocity | Enstrophy | Spectrum |\n|---|---|--:|--:|--:|--:|--:|--:|")
    keys = dict.fromkeys((row["problem"], row["solver"], row["scheme"], int(row["cells"])) for row in rows if row["scheme"] in ("revert_midstep", "revert", "midpoint", "semi_lagrangian"))
    for problem, solver, scheme, cells in sorted(keys, key=lambda key: (list(PROBLEMS).index(key[0]), key[1], key[2], key[3])):
        found = {row["reference"]: row for row in rows if (row["problem"], row["solver"], row["scheme"], int(row["cells"])) == (problem, solver, scheme, cells)}
        ms = float(next(iter(found.values()))["ms_per_second"])
        errors = [" / ".join(f"{float(found[reference][measure]):.3f}" if reference in found else "–" for reference in SOLVERS) for measures in CHARTS.values() for measure in measures]
        name = solver if solver == "dustbench" else "Mantaflow"
        print(f"| `{problem}` | {name}, `{scheme}` | {cells} | {float(f'{ms:.3g}'):,.0f} | {' | '.join(errors)} |")


def main():
    rows = points()
    table(rows)
    for name, measures in CHARTS.items():
        draw(name, measures, [dict(row) for row in rows])


main()
