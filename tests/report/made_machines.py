"""Makes results folders of several machines without measurements: times from formulas, made-up provenance.

A machine is a dictionary: `fog`, the frame time of the method fog in ms per 100 particles; `ratio`, the ratio of haze to fog; and
fields that override the provenance. Both drift together by 5 % per repetition; the logarithm of the ratio scatters by 1 %.
"""

import json
import math
import os

SCATTER = 0.01
LOADS = (100, 200, 400)
REPETITIONS = 6
PROVENANCE = {"cpu": "Made-up CPU at 3 GHz", "cores": 8, "ram_bytes": 17179869184, "governor": "performance", "kernel": "6.1.0-30-amd64",
              "virtual_machine": False, "gl_vendor": "Made Up Corporation", "gl_renderer": "Made-up GPU 4000", "gl_version": "4.6 driver 550.1",
              "gl_platform": "device", "version": "0.2.0", "git_commit": "0123456789abcdef0123", "git_dirty": False,
              "compiler": "GNU 12.2.0", "flags": "-O3 -march=native", "build_type": "Release", "started_utc": "2026-03-01T10:20:30Z"}


def key_of(method, load, repetition, size, extra):
    lines = {"method": method, "scene": "plain", "drive": "straight", "p.particles": load, **extra, "frames": 30, "warmup": 5,
             "size": size, "seed": 1, "threads": 0, "sync": "frame", "images": 0, "repetition": repetition}
    return "".join(f"{name}={value}\n" for name, value in lines.items())


def frame_ms(machine, method, load, repetition):
    fog = machine["fog"] * load / 100 * 1.05 ** repetition
    if method == "fog":
        return fog
    sign = 1 if repetition % 2 else -1
    return fog * machine["ratio"] * math.exp(sign * SCATTER)


def write_run(folder, method, load, repetition, machine, *, size="320x240", extra=None, status="done", warnings=()):
    key = key_of(method, load, repetition, size, extra or {})
    width, height = map(int, size.split("x"))
    settings = "".join(f"-{value}" for value in (extra or {}).values())
    run_id = f"{method}{settings}-{load}-{size}-r{repetition}"
    ms = frame_ms(machine, method, load, repetition)
    provenance = PROVENANCE | {name: value for name, value in machine.items() if name not in ("fog", "ratio")}
    summary = {"run_id": run_id, "status": status, "reason": "" if status == "done" else "it broke", "method": method, "scene": "plain",
               "drive": "straight", "seed": 1, "repetition": repetition, "width": width, "height": height, "sync": "frame",
               "threads": provenance["cores"]}
    if status == "done":
        summary |= {"frames": 30, "fps_avg": 1000 / ms, "frame_ms_median": ms}
    place = os.path.join(folder, "runs", run_id)
    os.makedirs(place, exist_ok=True)
    with open(os.path.join(place, "run.json"), "w", encoding="utf-8") as stream:
        json.dump({"run_id": run_id, "status": status, "reason": summary["reason"], "method": method,
                   "parameters": {"particles": load} | {name[2:]: value for name, value in (extra or {}).items()},
                   "state_hash": f"{load:016x}", "method_hash": None, "summary": summary, "outputs": [], "warnings": list(warnings),
                   "provenance": provenance | {"inputs": [{"file": "scenes/plain.toml", "sha256": "01"}], "key": key}}, stream)
    return run_id


def write(folder, machine, *, loads=LOADS, methods=("fog", "haze"), size="320x240", extra=None, warnings=()):
    for method in methods:
        for load in loads:
            for repetition in range(1, REPETITIONS + 1):
                write_run(folder, method, load, repetition, machine, size=size, extra=(extra or {}).get(method), warnings=warnings)
