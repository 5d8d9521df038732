#!/usr/bin/env python3
"""Writes the heights (16-bit grey) and colours (8-bit sRGB) of the reliefs. Python 3, standard library only:
`python3 make_reliefs.py`.

White is at the face, black at the panel's greatest depth. The first row is the top.
"""
import math
import os
import struct
import zlib


def smooth(t):
    t = max(0.0, min(1.0, t))
    return t * t * (3 - 2 * t)


def mix(a, b, share):
    return a + (b - a) * share


def noise_at(i, j, seed):
    """A repeatable number in 0..1 for a lattice point."""
    h = (i * 374761393 + j * 668265263 + seed * 2246822519) & 0xFFFFFFFF
    h = ((h ^ (h >> 13)) * 1274126177) & 0xFFFFFFFF
    return ((h ^ (h >> 16)) & 0xFFFF) / 65535


def noise(x, y, seed):
    i, j = math.floor(x), math.floor(y)
    s, t = smooth(x - i), smooth(y - j)
    return mix(mix(noise_at(i, j, seed), noise_at(i + 1, j, seed), s),
               mix(noise_at(i, j + 1, seed), noise_at(i + 1, j + 1, seed), s), t)


def box_distance(x, y, half_width, half_height, corner):
    """To the rim of a rectangle with round corners about the origin; negative inside."""
    dx, dy = abs(x) - half_width + corner, abs(y) - half_height + corner
    return math.hypot(max(dx, 0), max(dy, 0)) + min(max(dx, dy), 0) - corner


def bricks(x, y):
    """A running bond, 4 m by 2 m. x, y: metres from the lower left corner."""
    course = math.floor(y / 0.125)
    along = x / 0.25 + (0.5 if course % 2 else 0.0)
    brick = math.floor(along) % 16
    u, v = (along - math.floor(along) - 0.5) * 0.25, y - (course + 0.5) * 0.125
    rough = noise(x * 90, y * 90, 1) * 0.5 + noise(x * 31, y * 31, 2) * 0.5
    own = noise_at(brick, course, 3)
    inside = smooth((-box_distance(u, v, 0.117, 0.0545, 0.012)) / 0.010)
    height = mix(0.18 + 0.10 * rough, 0.80 + 0.15 * own + 0.05 * rough, inside)
    tone = 0.55 + 0.6 * own + 0.35 * (rough - 0.5)
    brick_colour = (0.50 * tone, (0.20 + 0.05 * noise_at(brick, course, 4)) * tone, 0.13 * tone)
    mortar = tuple(0.55 * (0.8 + 0.3 * rough) for _ in range(3))
    return height, tuple(mix(m, b, inside) for m, b in zip(mortar, brick_colour))


# Strokes of the letters in a cell of 1 x 1.5: lines, and arcs as polygons.
ARC = [(math.cos(a * math.pi / 16), math.sin(a * math.pi / 16)) for a in range(-8, 9)]
LETTERS = {
    "D": [[(0, 0), (0, 1.5)], [(0, 0), (0.25, 0)] + [(0.25 + 0.75 * c, 0.75 + 0.75 * s) for c, s in ARC] + [(0.25, 1.5), (0, 1.5)]],
    "U": [[(0, 1.5), (0, 0.5)] + [(0.5 - 0.5 * s * -1, 0.5 - 0.5 * c) for c, s in ARC] + [(1, 0.5), (1, 1.5)]],
    "S": [[(0.95, 1.25), (0.8, 1.45), (0.5, 1.5), (0.2, 1.45), (0.04, 1.25), (0.04, 1.02), (0.2, 0.85), (0.5, 0.77),
           (0.8, 0.68), (0.97, 0.48), (0.97, 0.27), (0.8, 0.06), (0.5, 0), (0.2, 0.05), (0.03, 0.25)]],
    "T": [[(0, 1.5), (1, 1.5)], [(0.5, 1.5), (0.5, 0)]],
}


def segment_distance(x, y, a, b):
    dx, dy = b[0] - a[0], b[1] - a[1]
    length = dx * dx + dy * dy
    t = max(0.0, min(1.0, ((x - a[0]) * dx + (y - a[1]) * dy) / length)) if length else 0.0
    return math.hypot(x - a[0] - t * dx, y - a[1] - t * dy)


def rounded(stroke):
    """Cuts the corners of a polygon three times (Chaikin); its ends stay."""
    for _ in range(3):
        cut = [stroke[0]]
        for a, b in zip(stroke, stroke[1:]):
            cut += [(mix(a[0], b[0], t), mix(a[1], b[1], t)) for t in (0.25, 0.75)]
        stroke = cut + [stroke[-1]]
    return stroke


WIDTH, HEIGHT, ADVANCE = 0.165, 0.2, 0.235  # metres a cell, and from letter to letter
LETTERS["S"] = [rounded(LETTERS["S"][0])]


def word_distance(x, y, word):
    """Metres to the strokes of a word whose first letter starts at the origin."""
    nearest = 9.0
    for place, letter in enumerate(word):
        left = x - place * ADVANCE
        if not -0.1 < left < WIDTH + 0.1:
            continue
        for stroke in LETTERS[letter]:
            points = [(WIDTH * u, HEIGHT * v) for u, v in stroke]
            for a, b in zip(points, points[1:]):
                nearest = min(nearest, segment_distance(left, y, a, b))
    return nearest


def sign(x, y):
    """A warning board with raised letters and rim, 1.2 m by 0.6 m. x, y: metres from the lower left corner."""
    letters = word_distance(x - 0.165, y - 0.15, "DUST") - 0.024
    rim = abs(box_distance(x - 0.6, y - 0.3, 0.555, 0.255, 0.05)) - 0.010
    raised = smooth(0.5 - min(letters, rim) / 0.006)
    grain = noise(x * 300, y * 300, 5)
    height = mix(0.35 + 0.02 * grain, 0.97 + 0.03 * grain, raised)
    paint, black = (0.95, 0.68, 0.04), (0.05, 0.05, 0.05)
    return height, tuple(mix(p, b, smooth(0.5 - min(letters, rim) / 0.003)) for p, b in zip(paint, black))


def encode(linear):
    linear = max(0.0, min(1.0, linear))
    return 12.92 * linear if linear <= 0.0031308 else 1.055 * linear ** (1 / 2.4) - 0.055


def write_png(name, width, height, bits, kind, rows):
    def chunk(tag, data):
        return struct.pack(">I", len(data)) + tag + data + struct.pack(">I", zlib.crc32(tag + data))

    here = os.path.dirname(os.path.abspath(__file__))
    with open(os.path.join(here, name), "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, bits, kind, 0, 0, 0)) +
                   chunk(b"IDAT", zlib.compress(b"".join(b"\0" + row for row in rows), 9)) + chunk(b"IEND", b""))


def write(name, relief, columns, rows, width_metres, height_metres):
    heights, colours = [], []
    for row in range(rows):
        y = height_metres * (rows - row - 0.5) / rows
        texels = [relief(width_metres * (column + 0.5) / columns, y) for column in range(columns)]
        heights.append(b"".join(struct.pack(">H", round(65535 * h) & 0xFFC0) for h, _ in texels))
        colours.append(bytes(round(255 * encode(c)) for _, colour in texels for c in colour))
    write_png(name + "_heights.png", columns, rows, 16, 0, heights)
    write_png(name + "_colours.png", columns, rows, 8, 2, colours)


write("bricks", bricks, 1024, 512, 4.0, 2.0)
write("sign", sign, 512, 256, 1.2, 0.6)
