# SPDX-License-Identifier: Apache-2.0
"""A false-colour scale of even steps in OKLab (Ottosson 2020): lightness rises all the way, so it reads in
grey and with any colour vision."""
import numpy as np

# Lightness, chroma, hue in degrees: dark blue, violet, red, orange, pale yellow.
STOPS = ((.16, .06, 275), (.34, .15, 300), (.54, .19, 10), (.74, .17, 55), (.97, .07, 105))
STEPS = 64


def _srgb(lightness, a, b):
    l, m, s = ((lightness + p * a + q * b) ** 3 for p, q in
               ((.3963377774, .2158037573), (-.1055613458, -.0638541728), (-.0894841775, -1.2914855480)))
    linear = np.stack([4.0767416621 * l - 3.3077115913 * m + .2309699292 * s,
                       -1.2684380046 * l + 2.6097574011 * m - .3413193965 * s,
                       -.0041960863 * l - .7034186147 * m + 1.7076147010 * s], axis=-1).clip(0, 1)
    return np.where(linear <= .0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - .055)


def palette():
    """[STEPS, 3] bytes, from little to much."""
    at, x = np.linspace(0, 1, STEPS), np.linspace(0, 1, len(STOPS))
    lightness, chroma, hue = (np.array(v, float) for v in zip(*STOPS))
    a, b = chroma * np.cos(np.radians(hue)), chroma * np.sin(np.radians(hue))
    return (255 * _srgb(*(np.interp(at, x, v) for v in (lightness, a, b))) + .5).astype(np.uint8)


def indices(values, low, high, logarithmic=True):
    """Places on the scale. What is no number is shown as much, so that it is seen."""
    if logarithmic: t = np.log(np.maximum(values, 1e-30) / low) / np.log(high / low)
    else: t = (np.asarray(values, float) - low) / (high - low)
    return (np.clip(np.nan_to_num(t, nan=1.), 0, 1) * (STEPS - 1) + .5).astype(np.uint8)
