# SPDX-License-Identifier: Apache-2.0
"""Images as arrays [row, column, RGB] of doubles: reading renders, writing PNGs for pages."""
import struct
import zlib

import numpy as np


def load(path):
    """Linear RGB. PFM needs numpy only; OpenImageIO reads all else."""
    image = _load_pfm(path) if path.endswith(".pfm") else _load_other(path)
    if not np.isfinite(image).all(): raise ValueError("%s: values that are not finite" % path)
    return image


def _load_pfm(path):
    with open(path, "rb") as f:
        kind = f.readline().strip()
        width, height = map(int, f.readline().split())
        scale = float(f.readline())
        data = np.frombuffer(f.read(), "<f4" if scale < 0 else ">f4")
    channels = {b"PF": 3, b"Pf": 1}[kind]
    # Rows go from the bottom up.
    image = data.reshape(height, width, channels)[::-1].astype(np.float64)
    return image if channels == 3 else np.repeat(image, 3, axis=2)


def _load_other(path):
    import OpenImageIO as oiio
    buffer = oiio.ImageBuf(path)
    if buffer.has_error: raise OSError(buffer.geterror())
    names = list(buffer.spec().channelnames)
    pixels = np.asarray(buffer.get_pixels(oiio.FLOAT), np.float64)
    return pixels[..., [names.index(c) for c in "RGB"]]


def tone_mapped(image, exposure):
    """sRGB bytes."""
    c = np.clip(np.nan_to_num(image) * exposure, 0, 1)
    c = np.where(c <= .0031308, 12.92 * c, 1.055 * c ** (1 / 2.4) - .055)
    return (255 * c + .5).astype(np.uint8)


def exposure_for(reference):
    """Middling: the 90th percentile of the luminance becomes 0.5, so that lamps clip and walls don't."""
    bright = np.percentile(reference @ (.2126, .7152, .0722), 90)
    return .5 / bright if bright > 0 else 1.


def png(pixels, palette=None):
    """The bytes of a PNG file: [h, w, 3] RGB, or [h, w] indices into a palette [n, 3]."""
    height, width = pixels.shape[:2]

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    rows = pixels.reshape(height, -1).astype(np.uint8)
    if palette is None:
        # Differences to the pixel on the left (filter 1) pack better.
        left = np.zeros_like(rows)
        left[:, 3:] = rows[:, :-3]
        rows = rows - left
    filtered = np.insert(rows, 0, 1 if palette is None else 0, axis=1)
    header = struct.pack(">IIBBBBB", width, height, 8, 2 if palette is None else 3, 0, 0, 0)
    extra = b"" if palette is None else chunk(b"PLTE", np.asarray(palette, np.uint8).tobytes())
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + extra +
            chunk(b"IDAT", zlib.compress(filtered.tobytes(), 9)) + chunk(b"IEND", b""))
