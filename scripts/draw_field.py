#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws the floor of worlds/soccer.toml: a green field with white lines, a PNG of 2 mm a pixel.

    scripts/draw_field.py [worlds/soccer.png]
"""
import pathlib
import struct
import sys
import zlib

WIDTH_M, DEPTH_M, PIXEL_M = 1.72, 1.02, 0.002
FIELD_X_M, FIELD_Y_M = 0.75, 0.5       # half the field
GOAL_M, AREA_X_M, AREA_Y_M = 0.18, 0.6, 0.26
CIRCLE_M, LINE_M = 0.15, 0.01
LIGHT, DARK, WHITE, NET = (70, 150, 70), (62, 138, 62), (245, 245, 245), (170, 170, 170)


def chunk(kind, body):
    return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))


def colour_at(x, y):
    """Of a point, in m from the middle."""
    half = LINE_M / 2
    far_x, far_y = abs(x), abs(y)
    if far_x > FIELD_X_M:
        return NET if far_y < GOAL_M else DARK
    on_line = (far_x < half or far_x > FIELD_X_M - LINE_M or abs((x * x + y * y) ** 0.5 - CIRCLE_M) < half or
               (abs(far_x - AREA_X_M) < half and far_y < AREA_Y_M + half) or
               (abs(far_y - AREA_Y_M) < half and far_x > AREA_X_M - half) or (x * x + y * y) ** 0.5 < LINE_M)
    if on_line or far_y > FIELD_Y_M - LINE_M:
        return WHITE
    return LIGHT if int((x + 10) / 0.15) % 2 else DARK


def main():
    path = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent.parent / "worlds/soccer.png")
    columns, rows = round(WIDTH_M / PIXEL_M), round(DEPTH_M / PIXEL_M)
    scanlines = b"".join(
        b"\0" + b"".join(bytes(colour_at((c + 0.5) * PIXEL_M - WIDTH_M / 2, DEPTH_M / 2 - (r + 0.5) * PIXEL_M))
                         for c in range(columns)) for r in range(rows))
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", columns, rows, 8, 2, 0, 0, 0)) +
                     chunk(b"IDAT", zlib.compress(scanlines, 9)) + chunk(b"IEND", b""))


if __name__ == "__main__":
    main()
