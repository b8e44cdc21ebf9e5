#!/usr/bin/env python3
"""Writes ribs_normal.png: the normals of a periodic field of rounded ribs, exact but for 8-bit rounding.

The height over one period of the map (x, y in [0, 1)) is
    h(x, y) = A / (2 pi 8) * cos(2 pi (8 x + sin(2 pi y) / 4)),
eight ribs that weave once from top to bottom; A = 0.9 is the steepest slope across a rib. Texels sample it at their
centres, y upwards, and store (n + 1) / 2. Needs Python's standard library alone.
"""
import math
import pathlib
import struct
import zlib

SIZE = 128
RIBS = 8
STEEPEST = 0.9


def normal(x, y):
    """The unit normal at x, y (both in [0, 1), y upwards)."""
    phase = 2 * math.pi * (RIBS * x + math.sin(2 * math.pi * y) / 4)
    dx = -STEEPEST * math.sin(phase)
    dy = dx / RIBS * (2 * math.pi * math.cos(2 * math.pi * y) / 4)
    length = math.sqrt(dx * dx + dy * dy + 1)
    return -dx / length, -dy / length, 1 / length


def chunk(name, data):
    """One chunk of a PNG file."""
    body = name + data
    return struct.pack(">I", len(data)) + body + struct.pack(">I", zlib.crc32(body))


def main():
    rows = bytearray()
    for row in range(SIZE):
        rows.append(0)  # PNG filter: none
        for column in range(SIZE):
            n = normal((column + 0.5) / SIZE, 1 - (row + 0.5) / SIZE)
            rows.extend(round((c + 1) / 2 * 255) for c in n)
    header = struct.pack(">IIBBBBB", SIZE, SIZE, 8, 2, 0, 0, 0)
    file = pathlib.Path(__file__).with_name("ribs_normal.png")
    file.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(bytes(rows), 9))
                     + chunk(b"IEND", b""))


if __name__ == "__main__":
    main()
