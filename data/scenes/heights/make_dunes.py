#!/usr/bin/env python3
"""Writes dunes.png, a height field of 257 x 257 samples, 16-bit grey. Python 3, standard library only: `python3 make_dunes.py`.

Long dune crests with hills between them, level at the rim (grey 0.5), so that the ground goes on as a plain outside.
At 3 m a sample and 12 m from black to white no slope exceeds 0.25.
"""
import math
import os
import struct
import zlib

SIZE, SPACING, HEIGHT = 257, 3.0, 12.0
MIDDLE = (SIZE - 1) / 2


def smooth(t):
    t = max(0.0, min(1.0, t))
    return t * t * t * (t * (6 * t - 15) + 10)


def height(x, z):
    """Metres above the plain."""
    bend = 24 * math.sin(z / 61.0 + 0.4) + 11 * math.sin(z / 29.0 + 1.9)
    phase = (x + bend) / 82.0 * 2 * math.pi
    crest = math.sin(phase + 0.45 * math.cos(phase))  # a gentle windward side, a steeper lee side
    hills = math.sin(x / 37.0 + 1.3) * math.sin(z / 43.0 - 0.6) + 0.5 * math.sin(x / 19.0 - z / 23.0)
    rim = max(abs(x), abs(z)) / (MIDDLE * SPACING)
    return (1.75 * crest + 1.05 * hills) * (1 - smooth((rim - 0.72) / 0.26))


def main():
    heights = [[height((i - MIDDLE) * SPACING, (j - MIDDLE) * SPACING) for i in range(SIZE)] for j in range(SIZE)]
    steepest = max(max(abs(heights[j][i + 1] - heights[j][i]), abs(heights[j + 1][i] - heights[j][i])) / SPACING
                   for j in range(SIZE - 1) for i in range(SIZE - 1))
    assert steepest < 0.25 and max(max(row) for row in heights) < HEIGHT / 2, steepest
    rows = b"".join(b"\0" + b"".join(struct.pack(">H", round((h / HEIGHT + 0.5) * 65535)) for h in row) for row in heights)

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    here = os.path.dirname(os.path.abspath(__file__))
    with open(os.path.join(here, "dunes.png"), "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", SIZE, SIZE, 16, 0, 0, 0, 0)) +
                   chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b""))


main()
