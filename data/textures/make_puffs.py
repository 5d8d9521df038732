#!/usr/bin/env python3
"""Makes the puff pictures of this folder: puff.png, puffs.png (4 side by side) and puff_animated.png (12 frames).

Each is a small cloud of fractal noise within a ball, lit from above left and marched from the front: grey is how much
light reaches what one sees, alpha is its optical depth relative to the densest spot. Needs only Python's own library;
the same pictures come out every time.
"""

import math
import pathlib
import struct
import zlib

OCTAVES = 4


def lattice(x, y, z, seed):
    """A number in [0, 1) for a lattice point."""
    h = (x * 0x8DA6B343 ^ y * 0xD8163841 ^ z * 0xCB1AB31F ^ seed * 0x9E3779B1) & 0xFFFFFFFF
    h ^= h >> 16
    h = h * 0x7FEB352D & 0xFFFFFFFF
    h ^= h >> 15
    h = h * 0x846CA68B & 0xFFFFFFFF
    return (h ^ h >> 16) / 2**32


class Noise:
    """Smooth value noise, and its sum over octaves."""

    def __init__(self, seed):
        self.seed = seed
        self.known = {}

    def corner(self, x, y, z):
        key = (x, y, z)
        value = self.known.get(key)
        if value is None:
            value = self.known[key] = lattice(x, y, z, self.seed)
        return value

    def at(self, x, y, z):
        ix, iy, iz = math.floor(x), math.floor(y), math.floor(z)
        fx, fy, fz = x - ix, y - iy, z - iz
        fx, fy, fz = (f * f * (3 - 2 * f) for f in (fx, fy, fz))
        c = self.corner

        def along(y1, z1):
            a = c(ix, y1, z1)
            return a + (c(ix + 1, y1, z1) - a) * fx

        low = along(iy, iz)
        low += (along(iy + 1, iz) - low) * fy
        high = along(iy, iz + 1)
        high += (along(iy + 1, iz + 1) - high) * fy
        return low + (high - low) * fz

    def fractal(self, x, y, z):
        total, weight = 0.0, 0.5
        for _ in range(OCTAVES):
            total += weight * self.at(x, y, z)
            x, y, z, weight = 2 * x + 17, 2 * y + 31, 2 * z + 47, weight / 2
        return total / (1 - 0.5**OCTAVES)


def density(noise, edge, shift, spread):
    """Density on a grid of edge³ over [−1, 1]³: a ball whose rim the noise frays."""
    cells = []
    for k in range(edge):
        z = (2 * k + 1) / edge - 1
        for j in range(edge):
            y = (2 * j + 1) / edge - 1
            for i in range(edge):
                x = (2 * i + 1) / edge - 1
                r = math.sqrt(x * x + y * y + z * z)
                if r >= 1:
                    cells.append(0.0)
                    continue
                n = noise.fractal(2.6 * x + shift, 2.6 * y - shift, 2.6 * z + 9)
                ball = math.exp(-r * r * 4.5 / spread) * (1 - r * r) ** 0.5
                cells.append(max(0.0, ball * (0.25 + 2.6 * max(0.0, n - 0.36))))
    return cells


def picture(cells, edge):
    """(grey, alpha) of each pixel, both in [0, 1], rows from the top."""

    def at(x, y, z):
        i, j, k = (int((c + 1) * edge / 2) for c in (x, y, z))
        if min(i, j, k) < 0 or max(i, j, k) >= edge:
            return 0.0
        return cells[(k * edge + j) * edge + i]

    # Light from above left and in front; the depth towards it is summed cell by cell, coarsely.
    light = (-0.45, 0.75, 0.48)
    step = 2 / edge
    greys, depths = [], []
    for row in range(edge):
        y = 1 - (2 * row + 1) / edge
        for column in range(edge):
            x = (2 * column + 1) / edge - 1
            through, seen, depth = 1.0, 0.0, 0.0
            for k in range(edge - 1, -1, -1):  # from the front
                z = (2 * k + 1) / edge - 1
                d = at(x, y, z)
                if d <= 0.003:
                    continue
                shadow = sum(at(x + s * light[0], y + s * light[1], z + s * light[2]) for s in (0.08, 0.2, 0.36, 0.56, 0.8))
                lit = 0.25 + 0.75 * math.exp(-2.0 * shadow)
                part = 1 - math.exp(-6 * d * step)
                seen += through * part * lit
                through *= 1 - part
                depth += d * step
            greys.append(seen / (1 - through) if through < 1 else 0.7)
            depths.append(depth)
    return greys, depths


def encode(linear):
    """sRGB."""
    return 12.92 * linear if linear <= 0.0031308 else 1.055 * linear ** (1 / 2.4) - 0.055


def write_png(file, width, height, pixels):
    """8-bit grey and alpha."""

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    rows = b"".join(b"\0" + pixels[2 * width * y : 2 * width * (y + 1)] for y in range(height))
    head = struct.pack(">IIBBBBB", width, height, 8, 4, 0, 0, 0)
    data = b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"sRGB", b"\0")
    file.write_bytes(data + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b""))


def write_strip(name, frames, edge):
    most = max(max(depths) for _, depths in frames)
    pixels = bytearray()
    for row in range(edge):
        for greys, depths in frames:
            for i in range(row * edge, (row + 1) * edge):
                pixels += bytes((round(255 * encode(greys[i])), round(255 * depths[i] / most)))
    write_png(pathlib.Path(__file__).parent / name, edge * len(frames), edge, bytes(pixels))


def frame(seed, edge, shift=0.0, spread=1.0):
    return picture(density(Noise(seed), edge, shift, spread), edge)


if __name__ == "__main__":
    write_strip("puff.png", [frame(1, 96)], 96)
    write_strip("puffs.png", [frame(seed, 64) for seed in (2, 3, 5, 7)], 64)
    # An old puff drifts through the noise and is spread a little wider than a young one.
    write_strip("puff_animated.png", [frame(11, 48, 0.09 * i, 0.8 + 0.05 * i) for i in range(12)], 48)
