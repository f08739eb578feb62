# SPDX-License-Identifier: Apache-2.0
"""Images as arrays [row, column, RGB] of doubles: reading renders, writing PNGs for pages."""
import os
import struct
import zlib

import numpy as np

from . import exr


def load(path):
    """Linear RGB."""
    image = _load_pfm(path) if path.endswith(".pfm") else np.stack([exr.read(path)[c] for c in "RGB"], -1).astype(float)
    if not np.isfinite(image).all(): raise ValueError("%s: values that are not finite" % path)
    return image


class Folder:
    """Where the images are that results name."""

    def __init__(self, path, mask=None):
        """`mask` [row, column, 1]: what each pixel counts, 0 or 1."""
        self.path, self.mask = path, mask
    def image(self, name):
        """Black where the pixel doesn't count: in all images alike, so that no error is there."""
        whole = load(os.path.join(self.path, name))
        return whole if self.mask is None else whole * self.mask
    def counted_share(self): return 1. if self.mask is None else float(self.mask.mean())
    def layers(self, name): return exr.read(os.path.join(self.path, name))


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


def tone_mapped(image, exposure):
    """sRGB bytes."""
    c = np.clip(np.nan_to_num(image) * exposure, 0, 1)
    c = np.where(c <= .0031308, 12.92 * c, 1.055 * c ** (1 / 2.4) - .055)
    return (255 * c + .5).astype(np.uint8)


def exposure_for(reference):
    """Middling: the 90th percentile of the luminance becomes 0.5, so that lamps clip and walls don't."""
    bright = np.percentile(reference @ (.2126, .7152, .0722), 90)
    return .5 / bright if bright > 0 else 1.


def smaller(values, factor):
    """Means over squares of factor x factor pixels; what doesn't fill one at the edges is left out."""
    h, w = (n // factor for n in values.shape)
    return values[:h * factor, :w * factor].reshape(h, factor, w, factor).mean(axis=(1, 3))


def quantised(pixels, most=256):
    """(indices, palette) of few colours near those of bytes [h, w, 3]: boxes of colours are split, each time the one
    with the largest sum of squared differences, at its mean (after Heckbert 1982 and Wan et al. 1988)."""
    colours = pixels.reshape(-1, 3).astype(np.float32)

    def box(members):
        spread = colours[members].var(axis=0)
        return float(spread.max()) * len(members), int(spread.argmax()), members
    boxes = [box(np.arange(len(colours)))]
    while len(boxes) < most:
        k = max(range(len(boxes)), key=lambda i: boxes[i][0])
        if boxes[k][0] <= 0: break
        _, axis, members = boxes.pop(k)
        values = colours[members, axis]
        above = values > values.mean()
        if not above.any(): break
        boxes += [box(members[above]), box(members[~above])]
    indices = np.empty(len(colours), np.uint8)
    for k, (_, _, members) in enumerate(boxes): indices[members] = k
    palette = np.array([colours[m].mean(axis=0) + .5 for _, _, m in boxes]).astype(np.uint8)
    return indices.reshape(pixels.shape[:2]), palette


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
