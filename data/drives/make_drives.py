#!/usr/bin/env python3
"""Writes the built-in drives of this folder. Python 3, standard library only: `python3 make_drives.py`.

NEDC breakpoints: UNECER83, the operations of the elementary urban cycle (part one) and the extra-urban cycle (part two).
The figure of eight is closed for a wheelbase of 2.6 m and a steering limit of 0.6 rad, the vehicle's defaults.
"""
import math
import os

WHEELBASE, STEER_LIMIT, STEP = 2.6, 0.6, 1 / 240
HERE = os.path.dirname(os.path.abspath(__file__))


def number(value):
    text = f"{value:.6f}".rstrip("0").rstrip(".")
    return "0" if text in ("", "-0") else text


def write(name, rows):
    with open(os.path.join(HERE, name + ".csv"), "w", newline="") as file:
        file.write("time_s,target_speed_mps,steer\n")
        for row in rows:
            file.write(",".join(number(value) for value in row) + "\n")


def steer_of_curvature(curvature):
    return math.atan(WHEELBASE * curvature) / STEER_LIMIT


def from_kilometres_per_hour(points):
    return [(time, speed / 3.6, 0) for time, speed in points]


ECE15 = [(0, 0), (11, 0), (15, 15), (23, 15), (25, 10), (28, 0), (49, 0), (54, 15), (56, 15), (61, 32), (85, 32),
         (93, 10), (96, 0), (117, 0), (122, 15), (124, 15), (133, 35), (135, 35), (143, 50), (155, 50), (163, 35),
         (176, 35), (178, 32), (185, 10), (188, 0), (195, 0)]
EUDC = [(0, 0), (20, 0), (25, 15), (27, 15), (36, 35), (38, 35), (46, 50), (48, 50), (61, 70), (111, 70), (119, 50),
        (188, 50), (201, 70), (251, 70), (286, 100), (316, 100), (336, 120), (346, 120), (362, 80), (370, 50),
        (380, 0), (400, 0)]


def slalom(speed=15, lateral=4, period=4, seconds=64, spacing=0.25):
    """A sine of lateral acceleration. Its first half waves have 1/4 and 3/4 of the height: heading and way swing about 0."""
    rows = []
    for i in range(int(seconds / spacing) + 1):
        time = i * spacing
        size = 0.25 if time < period / 2 else 0.75 if time < period else 1
        curvature = size * lateral / speed ** 2 * math.sin(2 * math.pi * time / period)
        rows.append((time, speed, steer_of_curvature(curvature)))
    return rows


def lobe(speed, steer, ramp, straight, hold):
    """Displacement and heading after: straight, ramp up, hold, ramp down, straight (bicycle model, midpoint rule)."""
    total = 2 * straight + 2 * ramp + hold
    steps = round(total / STEP)
    x = y = heading = 0.0
    for i in range(steps):
        time = (i + 0.5) * total / steps
        at_end = min(time, total - time) - straight
        share = max(0.0, min(1.0, at_end / ramp))
        turn = speed * math.tan(share * steer * STEER_LIMIT) / WHEELBASE * total / steps
        advance = speed * total / steps
        x += advance * math.cos(heading + turn / 2)
        y += advance * math.sin(heading + turn / 2)
        heading += turn
    return x, y, heading


def bisect(function, low, high):
    sign = function(low) > 0
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if (function(middle) > 0) == sign else (low, middle)
    return (low + high) / 2


def figure_of_eight(speed=12, radius=25, ramp=0.6, crossing=math.pi / 2, rounds=3):
    """Two lobes that turn by 360° less the angle of crossing; the straights close each lobe at the crossing."""
    steer = steer_of_curvature(1 / radius)
    turn = 2 * math.pi - crossing
    hold = bisect(lambda t: lobe(speed, steer, ramp, 0, t)[2] - turn, 0.1, 60)

    def gap(straight):
        x, y, heading = lobe(speed, steer, ramp, straight, hold)
        return x * math.cos(turn / 2) + y * math.sin(turn / 2)

    straight = bisect(gap, 0, 10)
    rows, time = [(0, speed, 0)], 0.0
    for _ in range(rounds):
        for side in (1, -1):
            for seconds, value in ((straight, 0), (ramp, side * steer), (hold, side * steer), (ramp, 0), (straight, 0)):
                time += seconds
                rows.append((time, speed, value))
    # The straights of neighbouring lobes are one.
    return [row for i, row in enumerate(rows) if not (0 < i < len(rows) - 1 and rows[i - 1][2] == row[2] == rows[i + 1][2])]


def stop_and_go():
    rows, time = [(0, 0, 0)], 0
    for speed, rise, hold, fall in ((8, 4, 6, 3), (14, 6, 6, 4), (6, 3, 4, 2), (18, 7, 8, 5)):
        for seconds, target in ((2, 0), (rise, speed), (hold, speed), (fall, 0)):
            time += seconds
            rows.append((time, target, 0))
    return rows + [(time + 4, 0, 0)]


write("straight", [(0, 20, 0), (75, 20, 0)])
write("acceleration", [(0, 0, 0), (2, 0, 0), (18, 40, 0), (64, 40, 0)])
write("slalom", slalom())
write("figure_of_eight", figure_of_eight())
write("stop_and_go", stop_and_go())
write("ece15", from_kilometres_per_hour(ECE15))
write("eudc", from_kilometres_per_hour(EUDC))
