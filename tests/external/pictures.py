"""Reads the pictures of all programs as arrays of floats, rows from the top: scan lines of OpenEXR, and 16-bit PPM."""

import re
import struct
import zlib

import numpy

SAMPLES = {1: numpy.dtype("<f2"), 2: numpy.dtype("<f4")}
LINES = {0: 1, 2: 1, 3: 16}  # lines per block, by compression: none, ZIPS, ZIP


def unpacked(data, size):
    """Undoes the filter of OpenEXR's ZIP: byte differences, with the first half at even positions."""
    if len(data) == size:
        return data
    sums = numpy.frombuffer(zlib.decompress(data), numpy.uint8).astype(numpy.int64)
    sums[1:] -= 128
    bytes_ = (numpy.cumsum(sums) % 256).astype(numpy.uint8)
    result = numpy.empty_like(bytes_)
    half = (len(bytes_) + 1) // 2
    result[0::2], result[1::2] = bytes_[:half], bytes_[half:]
    return result.tobytes()


def read_exr(path):
    """The channels by name."""
    with open(path, "rb") as file:
        content = file.read()
    magic, version = struct.unpack_from("<iI", content)
    if magic != 20000630 or version & 0x1a00:
        raise ValueError(f"{path}: expected an OpenEXR file of scan lines")
    at, header = 8, {}
    while content[at]:
        name, kind, rest = content[at:at + 600].split(b"\0", 2)
        at += len(name) + len(kind) + 2
        size, = struct.unpack_from("<i", content, at)
        header[name.decode()] = content[at + 4:at + 4 + size]
        at += 4 + size
    at += 1
    channels, list_ = [], header["channels"]
    while list_[0]:
        name, list_ = list_.split(b"\0", 1)
        channels.append((name.decode(), SAMPLES[struct.unpack_from("<i", list_)[0]]))
        list_ = list_[16:]
    left, top, right, bottom = struct.unpack("<4i", header["dataWindow"])
    width, height = right - left + 1, bottom - top + 1
    lines = LINES[header["compression"][0]]
    result = {name: numpy.empty((height, width)) for name, _ in channels}
    row_size = sum(kind.itemsize for _, kind in channels) * width
    for block in range(-(-height // lines)):
        start, = struct.unpack_from("<Q", content, at + 8 * block)
        first, size = struct.unpack_from("<ii", content, start)
        first -= top
        count = min(lines, height - first)
        data, place = unpacked(content[start + 8:start + 8 + size], row_size * count), 0
        for row in range(first, first + count):
            for name, kind in channels:
                result[name][row] = numpy.frombuffer(data, kind, width, place)
                place += kind.itemsize * width
    return result


def read_ppm(path):
    """The first channel of a 16-bit PPM, 0..1."""
    with open(path, "rb") as file:
        content = file.read()
    words, at = [], 0  # the header: words, or comment lines
    while len(words) < 4:
        found = re.compile(rb"\s*(?:#[^\n]*\n|([^\s#]+)\s)").match(content, at)
        words += [found.group(1)] if found.group(1) else []
        at = found.end()
    if words[0] != b"P6" or words[3] != b"65535":
        raise ValueError(f"{path}: expected a 16-bit PPM")
    width, height = int(words[1]), int(words[2])
    return numpy.frombuffer(content, ">u2", 3 * width * height, at).reshape(height, width, 3)[:, :, 0] / 65535
