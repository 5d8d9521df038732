#!/usr/bin/env python3
"""Writes shapes/flow/whirl_*.vti, the flow of whirl.toml: a whirlwind whose axis sways, as VTK image data with cell data
`velocity` (m/s) in the shape's frame. Standard library only; the same content every time."""

import base64
import math
import pathlib
import struct

CELLS = (12, 14, 12)
EDGE = 0.4  # m
ORIGIN = (-2.4, 0.0, -2.4)  # its middle stands on the shape's origin
TIMES = (0.0, 1.0, 2.0, 3.0)
CORE = 0.7  # m: radius at which the wind is strongest
TURN = 2.6  # m/s there
RISE = 0.9  # m/s on the axis
SWAY = 0.5  # m


def velocity(x, y, z, t):
    """A Rankine-like vortex about an axis that sways, with a rising core and a weak draught inwards."""
    phase = math.pi / 3 * 2 * t + 0.8 * y
    dx, dz = x - SWAY * y / 3 * math.cos(phase), z - SWAY * y / 3 * math.sin(phase)
    r2 = (dx * dx + dz * dz) / CORE**2
    turn = 2 * TURN / CORE / (1 + r2)
    inwards = 0.15 * turn
    return (turn * dz - inwards * dx, RISE * math.exp(-r2 / 2), -turn * dx - inwards * dz)


def write(file, t):
    values = bytearray()
    for k in range(CELLS[2]):
        for j in range(CELLS[1]):
            for i in range(CELLS[0]):
                place = [o + EDGE * (n + 0.5) for o, n in zip(ORIGIN, (i, j, k))]
                values += struct.pack("<3f", *velocity(*place, t))
    extent = " ".join(f"0 {n}" for n in CELLS)

    def encoded(data):
        return base64.b64encode(struct.pack("<Q", len(data)) + bytes(data)).decode()

    file.write_text(
        f"""<VTKFile type="ImageData" version="1.0" byte_order="LittleEndian" header_type="UInt64">
  <ImageData WholeExtent="{extent}" Origin="{ORIGIN[0]} {ORIGIN[1]} {ORIGIN[2]}" Spacing="{EDGE} {EDGE} {EDGE}">
    <FieldData>
      <DataArray type="Float64" Name="TimeValue" NumberOfTuples="1" format="ascii">{t}</DataArray>
    </FieldData>
    <Piece Extent="{extent}">
      <CellData>
        <DataArray type="Float32" Name="velocity" NumberOfComponents="3" format="binary">{encoded(values)}</DataArray>
      </CellData>
    </Piece>
  </ImageData>
</VTKFile>
"""
    )


if __name__ == "__main__":
    folder = pathlib.Path(__file__).parent / "flow"
    folder.mkdir(exist_ok=True)
    for time in TIMES:
        write(folder / f"whirl_{int(time)}.vti", time)
