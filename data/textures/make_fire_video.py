#!/usr/bin/env python3
"""Records fire_video.png, a loop of 24 frames, from the fire in fire_video/: make_fire_video.py PROGRAM

PROGRAM is `dustbench`. It solves the fire and draws it on black. A pixel's alpha is its brightest channel, so that its
colour times its alpha is the fire's light. The frames after the loop fade into its beginning. Needs only Python's own
library. The same program on the same GPU writes the same pictures.
"""

import pathlib
import struct
import subprocess
import sys
import tempfile
import zlib

HERE = pathlib.Path(__file__).resolve().parent
EDGE = 128
FRAMES = 24  # of the loop
FADE = 8  # frames after the loop
STEPS = 3  # of 1/60 s for each frame


def record(program, folder):
    """The pictures, in order."""
    subprocess.run(
        [program, "run", "--method", "grid_fluid", "--scene", HERE / "fire_video/scene.toml", "--size", f"{EDGE}x{EDGE}",
         "-P", f"fluid={HERE / 'fire_video/fluid.toml'}", "-P", "grid=64x96x64", "-P", "camera=fixed", "-P", "preroll=1.5",
         "--frames", str((FRAMES + FADE) * STEPS), "--images", str(STEPS), "--out", folder],
        check=True,
    )
    return sorted(pathlib.Path(folder).glob("runs/*/images/*.png"))


def read_png(file):
    """Rows of RGB triples, bytes, from the top: 8 bits, RGB or RGBA, not interlaced."""
    data = file.read_bytes()
    at, packed = 8, b""
    while at < len(data):
        (length,) = struct.unpack(">I", data[at : at + 4])
        kind, body = data[at + 4 : at + 8], data[at + 8 : at + 8 + length]
        if kind == b"IHDR":
            width, height, bits, colour, _, _, interlaced = struct.unpack(">IIBBBBB", body)
            if bits != 8 or colour not in (2, 6) or interlaced:
                sys.exit(f"{file}: got {bits} bits, colour type {colour}, expected 8 bits of RGB or RGBA")
        if kind == b"IDAT":
            packed += body
        at += 12 + length
    channels = 3 if colour == 2 else 4
    raw, stride = zlib.decompress(packed), channels * width
    rows, before = [], bytes(stride)
    for y in range(height):
        kind, line = raw[y * (stride + 1)], bytearray(raw[y * (stride + 1) + 1 : (y + 1) * (stride + 1)])
        for i in range(stride):
            left = line[i - channels] if i >= channels else 0
            above, corner = before[i], before[i - channels] if i >= channels else 0
            guess = left + above - corner
            nearest = min((abs(guess - left), 0, left), (abs(guess - above), 1, above), (abs(guess - corner), 2, corner))[2]
            line[i] = line[i] + (0, left, above, (left + above) // 2, nearest)[kind] & 255
        rows.append([tuple(line[i : i + 3]) for i in range(0, stride, channels)])
        before = line
    return rows


def decode(byte):
    """Linear."""
    value = byte / 255
    return value / 12.92 if value <= 0.04045 else ((value + 0.055) / 1.055) ** 2.4


def encode(linear):
    """sRGB."""
    return round(255 * (12.92 * linear if linear <= 0.0031308 else 1.055 * linear ** (1 / 2.4) - 0.055))


def looped(pictures):
    """The loop's frames in linear light. Frame FRAMES + i fades out over frame i, which it would follow without a jump."""
    table = [decode(byte) for byte in range(256)]
    light = [[[table[c] for c in pixel] for row in picture for pixel in row] for picture in pictures]
    for i in range(FADE):
        share = (i + 0.5) / FADE
        light[i] = [[share * a + (1 - share) * b for a, b in zip(*both)] for both in zip(light[i], light[FRAMES + i])]
    return light[:FRAMES]


def texel(light):
    """RGBA, straight, of a pixel's light."""
    alpha = max(light)
    if round(255 * alpha) == 0:
        return bytes(4)
    return bytes([*(encode(min(c / alpha, 1)) for c in light), round(255 * alpha)])


def write_png(file, width, height, rows):
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    data = b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 6, 0, 0, 0)) + chunk(b"sRGB", b"\0")
    packed = zlib.compress(b"".join(b"\0" + row for row in rows), 9)
    file.write_bytes(data + chunk(b"IDAT", packed) + chunk(b"IEND", b""))


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    with tempfile.TemporaryDirectory() as folder:
        frames = looped([read_png(each) for each in record(sys.argv[1], folder)])
    rows = [b"".join(texel(pixel) for frame in frames for pixel in frame[y * EDGE : (y + 1) * EDGE]) for y in range(EDGE)]
    write_png(HERE / "fire_video.png", EDGE * FRAMES, EDGE, rows)


if __name__ == "__main__":
    main()
