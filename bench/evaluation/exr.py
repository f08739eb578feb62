# SPDX-License-Identifier: Apache-2.0
"""Reads the OpenEXR files that the program writes: one part, scan lines, without compression or with zlib's.

Source: "OpenEXR File Layout", openexr.com."""
import math
import struct
import zlib

import numpy as np

MAGIC = 20000630
LINES = {0: 1, 2: 1, 3: 16}  # a block has, by compression: none, ZIPS, ZIP
TYPES = {0: "<u4", 1: "<f2", 2: "<f4"}
TILED_DEEP_OR_PARTS = 0x1A00


def _text(data, at):
    end = data.index(b"\0", at)
    return data[at:end].decode("utf-8"), end + 1


def _header(data):
    """The attributes' bytes by name, and where they end."""
    attributes, at = {}, 8
    while data[at]:
        name, at = _text(data, at)
        _, at = _text(data, at)
        size, = struct.unpack_from("<i", data, at)
        attributes[name] = data[at + 4:at + 4 + size]
        at += 4 + size
    return attributes, at + 1


def _channels(data):
    """[(name, numpy type)] in the order of the file."""
    found, at = [], 0
    while data[at]:
        name, at = _text(data, at)
        kind, _, *sampling = struct.unpack_from("<iiii", data, at)
        if sampling != [1, 1]: raise ValueError("channel '%s' is subsampled" % name)
        found.append((name, TYPES[kind]))
        at += 16
    return found


def _unpacked(block, size):
    """A block that doesn't get smaller is stored as it is. Else bytes are differences, odd places after even ones."""
    if len(block) == size: return block
    steps = np.frombuffer(zlib.decompress(block), np.uint8).astype(np.int64)
    steps[1:] -= 128
    values = steps.cumsum().astype(np.uint8)
    out = np.empty(size, np.uint8)
    half = (size + 1) // 2
    out[0::2], out[1::2] = values[:half], values[half:]
    return out.tobytes()


def read(path):
    """{channel: [row, column] of float32}."""
    with open(path, "rb") as f: data = f.read()
    magic, version = struct.unpack_from("<ii", data)
    if magic != MAGIC or version & TILED_DEEP_OR_PARTS: raise ValueError("%s: no EXR file of scan lines" % path)
    attributes, at = _header(data)
    compression = attributes["compression"][0]
    if compression not in LINES: raise ValueError("%s: compression %d is not supported" % (path, compression))
    x0, y0, x1, y1 = struct.unpack("<4i", attributes["dataWindow"])
    width, height = x1 - x0 + 1, y1 - y0 + 1
    row = np.dtype([(name, kind, (width,)) for name, kind in _channels(attributes["channels"])])
    image = np.empty(height, row)
    lines = LINES[compression]
    for offset in struct.unpack_from("<%dQ" % math.ceil(height / lines), data, at):
        y, size = struct.unpack_from("<ii", data, offset)
        count = min(lines, y1 + 1 - y)
        block = _unpacked(data[offset + 8:offset + 8 + size], count * row.itemsize)
        image[y - y0:y - y0 + count] = np.frombuffer(block, row)
    return {name: image[name].astype(np.float32) for name in row.names}
