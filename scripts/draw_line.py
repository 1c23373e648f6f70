#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws the floor of worlds/line.toml: a dark closed line on white, a grey PNG of 1 mm a pixel.

    scripts/draw_line.py [worlds/line.png]

The middle of the line, in metres: x = 0.45 cos t, y = 0.28 sin t + 0.06 sin 2t; its width is 18 mm.
"""
import math
import pathlib
import struct
import sys
import zlib

WIDTH_M, DEPTH_M, PIXEL_M, LINE_M = 1.2, 0.9, 0.001, 0.018
WHITE, BLACK = 250, 10


def chunk(kind, body):
    return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))


def main():
    path = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent.parent / "worlds/line.png")
    columns, rows = round(WIDTH_M / PIXEL_M), round(DEPTH_M / PIXEL_M)
    image = [bytearray([WHITE]) * columns for _ in range(rows)]
    reach = LINE_M / 2 / PIXEL_M  # pixels
    for i in range(6000):  # a disc every half millimetre
        t = 2 * math.pi * i / 6000
        column = (0.45 * math.cos(t) + WIDTH_M / 2) / PIXEL_M
        row = (DEPTH_M / 2 - 0.28 * math.sin(t) - 0.06 * math.sin(2 * t)) / PIXEL_M
        for y in range(math.floor(row - reach), math.ceil(row + reach) + 1):
            for x in range(math.floor(column - reach), math.ceil(column + reach) + 1):
                if (x + 0.5 - column) ** 2 + (y + 0.5 - row) ** 2 <= reach ** 2:
                    image[y][x] = BLACK
    scanlines = b"".join(b"\0" + bytes(line) for line in image)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", columns, rows, 8, 0, 0, 0, 0)) +
                     chunk(b"IDAT", zlib.compress(scanlines, 9)) + chunk(b"IEND", b""))


if __name__ == "__main__":
    main()
