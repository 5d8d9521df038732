#!/usr/bin/env python3
"""Writes cloud.vti: a small cloud, for the method `volume` as long as it is given no other.

Density is the sum of Gaussian puffs, averaged over each cell by error functions, so that its integral is known: the sum
of the puffs' masses. Python 3 and its standard library alone; the same content every time.
"""
import base64
import math
import pathlib
import random
import struct
import zlib

CELLS = (40, 24, 32)
EDGE = 0.125  # metres
ORIGIN = (-2.5, 0.0, -2.0)
BLOCK = 1 << 15


def share(centre, deviation, low):
    """Share of a Gaussian's mass between low and low + EDGE along one axis."""
    scale = 1 / (math.sqrt(2) * deviation)
    return 0.5 * (math.erf((low + EDGE - centre) * scale) - math.erf((low - centre) * scale))


def densities():
    chance = random.Random(20261124)
    values = [0.0] * (CELLS[0] * CELLS[1] * CELLS[2])
    for _ in range(60):
        angle, out = chance.uniform(0, 2 * math.pi), chance.uniform(0, 1)
        centre = (1.3 * out * math.cos(angle), 0.9 + chance.gauss(0, 0.25), 0.9 * out * math.sin(angle))
        deviation = chance.uniform(0.15, 0.3)
        mass = chance.uniform(0.1, 0.3)  # m2: the integral of its extinction
        along = [[share(centre[axis], deviation, ORIGIN[axis] + i * EDGE) for i in range(CELLS[axis])]
                 for axis in range(3)]
        cell = 0
        for z in along[2]:
            for y in along[1]:
                for x in along[0]:
                    values[cell] += mass * x * y * z / EDGE**3
                    cell += 1
    return values


def compressed(values):
    data = struct.pack(f"<{len(values)}f", *(value if value > 1e-5 else 0 for value in values))
    blocks = [zlib.compress(data[i:i + BLOCK], 9) for i in range(0, len(data), BLOCK)]
    last = len(data) % BLOCK
    head = struct.pack(f"<{3 + len(blocks)}I", len(blocks), BLOCK, last, *map(len, blocks))
    return (base64.b64encode(head) + base64.b64encode(b"".join(blocks))).decode()


def main():
    extent = f"0 {CELLS[0]} 0 {CELLS[1]} 0 {CELLS[2]}"
    place = f'WholeExtent="{extent}" Origin="{" ".join(map(str, ORIGIN))}" Spacing="{EDGE} {EDGE} {EDGE}"'
    text = f"""<?xml version="1.0"?>
<VTKFile type="ImageData" version="1.0" byte_order="LittleEndian" header_type="UInt32" compressor="vtkZLibDataCompressor">
<ImageData {place}>
<Piece Extent="{extent}">
<CellData Scalars="density">
<DataArray type="Float32" Name="density" format="binary">
{compressed(densities())}
</DataArray>
</CellData>
</Piece>
</ImageData>
</VTKFile>
"""
    (pathlib.Path(__file__).parent / "cloud.vti").write_text(text)


if __name__ == "__main__":
    main()
