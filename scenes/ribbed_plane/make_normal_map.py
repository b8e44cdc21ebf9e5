#!/usr/bin/env python3
"""Writes ribs_normal.png, the normals of a periodic field of rounded ribs, exact but for 8-bit rounding, and its heights in
16 bits as ../ribbed_heights/ribs_height.png.

The height over one period of the map (x, y in [0, 1)) is
    h(x, y) = A / (2 pi 8) * cos(2 pi (8 x + sin(2 pi y) / 4)),
eight ribs that weave once from top to bottom; A = 0.9 is the steepest slope across a rib. Texels sample it at their
centres, y upwards, and store (n + 1) / 2. Heights are stored from the lowest, 0, to the highest, 65535, which are A / (8 pi)
apart in widths of the map. Needs Python's standard library alone.
"""
import math
import pathlib
import struct
import zlib

SIZE = 128
RIBS = 8
STEEPEST = 0.9


def phase(x, y):
    """The angle whose cosine is the height at x, y (both in [0, 1), y upwards)."""
    return 2 * math.pi * (RIBS * x + math.sin(2 * math.pi * y) / 4)


def normal(x, y):
    """The unit normal there."""
    dx = -STEEPEST * math.sin(phase(x, y))
    dy = dx / RIBS * (2 * math.pi * math.cos(2 * math.pi * y) / 4)
    length = math.sqrt(dx * dx + dy * dy + 1)
    return -dx / length, -dy / length, 1 / length


def chunk(name, data):
    """One chunk of a PNG file."""
    body = name + data
    return struct.pack(">I", len(data)) + body + struct.pack(">I", zlib.crc32(body))


def write_png(file, bits, color, texel):
    """A PNG of whole numbers of `bits` bits: texel(x, y) gives those of a texel."""
    rows = bytearray()
    for row in range(SIZE):
        rows.append(0)  # PNG filter: none
        for column in range(SIZE):
            for value in texel((column + 0.5) / SIZE, 1 - (row + 0.5) / SIZE):
                rows.extend(round(value * (2**bits - 1)).to_bytes(bits // 8, "big"))
    header = struct.pack(">IIBBBBB", SIZE, SIZE, bits, color, 0, 0, 0)
    file.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(bytes(rows), 9))
                     + chunk(b"IEND", b""))


def main():
    folder = pathlib.Path(__file__).parent
    write_png(folder / "ribs_normal.png", 8, 2, lambda x, y: [(c + 1) / 2 for c in normal(x, y)])
    write_png(folder.parent / "ribbed_heights" / "ribs_height.png", 16, 0, lambda x, y: [(math.cos(phase(x, y)) + 1) / 2])


if __name__ == "__main__":
    main()
