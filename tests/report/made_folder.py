"""Makes a results folder without measurements: the runs of real suites, with times and metrics from formulas.

Every number in the folder comes from a formula here, so a test knows the numbers that the page must show.
"""

import csv
import functools
import json
import os
import struct
import subprocess
import zlib

EVIL = "</script><img src=x onerror=\"document.title='broken'\">&amp;"
STAGES = "input simulate build sort upload scene draw wait".split()

# The files of a paper whose suite takes seconds.
TINY_PAPER = {
    "paper.toml": """id = "tiny"
title = "A very short paper"
authors = "Nobody"
year = 2026
venue = ""
key = "Carr2006"
summary = "Two loads."
suites = ["tiny-loads"]
""",
    "suites/tiny-loads.toml": """title = "Two loads"
summary = ""
methods = ["billboard"]
sizes = ["96x72"]
frames = 120
warmup = 1
images = 80
[parameters]
preroll = 6
particles = [100, 300]
""",
    "claims.toml": """[[claim]]
id = "T1"
text = "more particles make more billboards"
suite = "tiny-loads"
quantity = "growth"
column = "primitives_median"
against = "p.particles"
of = "billboard"
over = "none"
min = 2
reason = "three times as many particles"
[[claim.control]]
why = "for each particle there is one"
gives = "refuted"
per = "p.particles"
""",
}


@functools.cache
def png(width, height, colour):
    """A PNG of one colour with a diagonal, so that the wipe of the viewer is visible."""
    rows = b"".join(b"\0" + b"".join(bytes((255, 255, 255)) if x == y else bytes(colour) for x in range(width))
                    for y in range(height))

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def planned(program, suite, out):
    """Run id, method, parameters and repetition of every run in the quick run of the suite."""
    said = subprocess.run([program, "suite", suite, "--quick", "--dry-run", "--out", out], check=True,
                          capture_output=True, text=True).stdout
    for line in said.splitlines():
        words = line.split()
        if "rep" not in words:
            continue
        yield (words[0], next(word for word in words[1:] if word not in ("to", "do", "done")),
               dict(word.split("=", 1) for word in words if "=" in word), int(words[-1].split("/")[0]))


def stages_of(method, settings, repetition):
    """The recursive octree builds in 8/10 of the time of the searching one; runs scatter by 1 %."""
    particles, speed = float(settings.get("particles", 100)), float(settings.get("speed", 20))
    scatter = 1 + 0.01 * ((repetition * 7 + len(method)) % 5 - 2) / 2
    build = {"octree_recursive": 0.8, "octree_search": 1.0}.get(method, 0)
    draw = (2 if method == "billboard" else 1) * particles / 200 * 20 / speed
    times = dict.fromkeys(STAGES, 0.01)
    times.update(build=build * particles / 500, sort=particles / 4000, scene=8, draw=draw, wait=1)
    return {stage: ms * scatter for stage, ms in times.items()}


def gaps_of(speed, seed):
    """Over the five seeds the median is that of seed 3."""
    return speed / 400 * (1 + 0.1 * (seed - 3))


def flip_of(row, settings):
    """The octree with levels=2 at speed 40 and seed 4 has the largest error."""
    return 0.5 if settings.get("levels") == "2" and settings["speed"] == "40" and row["seed"] == 4 else row["flip"]


def write_metrics(place, flip):
    with open(os.path.join(place, "metrics.csv"), "w", encoding="utf-8") as stream:
        stream.write(f"frame,psnr_db,ssim,flip\n0,44.123,0.9912,{flip / 2}\n15,33.456,0.9823,{flip}\n")


def write_run(folder, row, settings, warnings=()):
    place = os.path.join(folder, "runs", row["run_id"])
    os.makedirs(place)
    with open(os.path.join(place, "run.json"), "w", encoding="utf-8") as stream:
        json.dump({"run_id": row["run_id"], "status": row["status"], "reason": row["reason"], "method": row["method"],
                   "parameters": settings | ({"world_edge": "128"} if "depth" in settings else {}), "state_hash": "", "method_hash": None, "summary": row, "warnings": warnings,
                   "provenance": {"cpu": "made up " + EVIL, "cores": 2, "governor": "", "gl_renderer": "llvmpipe (made up)",
                                  "build_type": "Release", "inputs": []}}, stream)
    return place


def write_others(folder):
    """Runs outside any suite, one of them failed, with an unknown column and loads that rounding would change."""
    for particles in (25, 125, 333):
        ms = 5 + particles / 100
        write_run(folder, {"run_id": f"odd-{particles}", "status": "done", "reason": "", "method": "billboard", "scene": EVIL,
                           "repetition": 1, "frames": 3, "fps_avg": 1000 / ms, "frame_ms_median": ms, "draw_ms_median": ms,
                           "moon_phase": 3}, {"particles": particles})
    write_run(folder, {"run_id": "odd-500", "status": "failed", "reason": "it said " + EVIL, "method": "billboard",
                       "scene": EVIL, "repetition": 1}, {"particles": 500})


def write(program, folder, suites):
    """Writes the folder with summary.csv and returns its rows."""
    write_others(folder)
    rows = []
    for suite in suites:
        for run_id, method, settings, repetition in planned(program, suite, folder):
            if any(row["run_id"] == run_id for row in rows):  # a run of the null method that two suites share
                continue
            seed = int(settings.pop("seed", 1))
            stages = stages_of(method, settings, repetition)
            frame = sum(stages.values())
            flaws = suite.endswith("flaws")
            size = (320, 240)
            row = {"run_id": run_id, "status": "done", "reason": "", "method": method, "scene": "plain",
                   "drive": "straight", "seed": seed, "repetition": repetition, "width": size[0], "height": size[1],
                   "sync": "frame", "threads": 2, "frames": 30, "fps_avg": 1000 / frame, "frame_ms_median": frame,
                   "frame_ms_p95": frame * 1.1, "frame_ms_p99": frame * 1.2, "cpu_bytes": 2e6, "gpu_bytes": 3e7,
                   "primitives_median": float(settings.get("particles", 100)) * (1 if method == "billboard" else 0.4)}
            row.update({f"{stage}_ms_median": ms for stage, ms in stages.items()})
            if flaws:
                speed = float(settings["speed"])
                row.update(psnr_db=40 - speed / 10, ssim=0.99, flip=0.01 if method == "billboard" else 0.02,
                           rmse_linear=0.01, identical=0, popping=0.01, popping_max=0.02, gaps=gaps_of(speed, seed),
                           components=2, cutoff=0.02, self_similarity=0.1, quads_per_pixel=0.3, metric_reference="exact",
                           FILE_image=f"runs/{run_id}/images/f000000.png")
            rows.append(row | {"p." + name: value for name, value in settings.items()})
            place = write_run(folder, row, settings, [f"{EVIL} {frame} ms"])
            with open(os.path.join(place, "frames.csv"), "w", encoding="utf-8") as stream:
                stream.write("frame,time_s,frame_ms\n")
                stream.writelines(f"{i},{i / 60},{frame * (1 + 0.02 * (i % 3))}\n" for i in range(30))
            if flaws:
                os.makedirs(os.path.join(place, "images"))
                write_metrics(place, flip_of(row, settings))
            for number in (0, 15) if flaws else ():
                for ending, colour in (("", (200, 180, 140)), ("_reference", (90, 140, 200)), ("_difference", (20, 0, 40))):
                    with open(os.path.join(place, "images", f"f{number:06}{ending}.png"), "wb") as stream:
                        stream.write(png(*size, colour))
    write_summary(folder, rows)
    return rows


def rewrite_runs(folder, rows):
    """Writes the numbers of these rows to the files of their runs."""
    for row in rows:
        file = os.path.join(folder, "runs", row["run_id"], "run.json")
        with open(file, encoding="utf-8") as stream:
            run = json.load(stream)
        run["summary"] = {name: value for name, value in row.items() if not name.startswith("p.")}
        with open(file, "w", encoding="utf-8") as stream:
            json.dump(run, stream)


def write_summary(folder, rows):
    columns = list(dict.fromkeys(name for row in rows for name in row))
    with open(os.path.join(folder, "summary.csv"), "w", encoding="utf-8", newline="") as stream:
        table = csv.DictWriter(stream, columns, restval="", lineterminator="\n")
        table.writeheader()
        table.writerows(rows)
