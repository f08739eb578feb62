# SPDX-License-Identifier: Apache-2.0
"""What happens in each pixel, in false colour: errors of the runs, and the layers that the program writes (docs/aovs.md)."""
import html
from dataclasses import dataclass

import numpy as np

from . import colours, images
from .plots import number

WIDTH = 110  # of a layer's map, about: these are smooth, and a page has hundreds of them


@dataclass
class Map:
    """One quantity of all variants on one scale. An array is None where there is none of a variant."""
    key: str
    title: str
    text: str
    arrays: list
    unit: str = ""
    low: float = 0
    high: float = 0
    logarithmic: bool = False
    factor: float = 1  # from values to what is written

    def fit(self):
        """A scale that holds all but the outliers, with round ends."""
        found = np.concatenate([a[a > 0] for a in self.arrays if a is not None] or [np.array([])])
        if self.high == 0:
            low, high = np.percentile(found, (2, 99.5)) if found.size else (.1, 1)
            if self.logarithmic: self.low = nice(max(low, 1e-5 * high), False)
            self.high = nice(max(high, 1.01 * self.low), True)
        return self

    def png(self, array):
        return images.png(colours.indices(array, self.low, self.high, self.logarithmic), colours.palette())

    def scale(self):
        stops = ",".join("#%02x%02x%02x" % tuple(c) for c in colours.palette()[::7])
        if self.logarithmic:
            span = np.log(self.high / self.low)
            at = {v: np.log(v / self.low) / span for v in [self.low, self.high, *(10. ** e for e in range(-8, 12))]}
            at = {v: t for v, t in at.items() if t in (0, 1) or .2 < t < .8}
        else: at = {self.low + t * (self.high - self.low): t for t in (0, .25, .5, .75, 1)}
        marks = "".join('<span style="left:%.1f%%">%s</span>' % (100 * t, short(self.factor * v) + self.unit)
                        for v, t in at.items())
        return ('<div class="scale"><span>%s</span><div class="ramp picture" '
                'style="background-image:linear-gradient(90deg,%s)">%s</div></div>' % (html.escape(self.title), stops, marks))

    def median(self, array):
        return "" if array is None else "median %s%s" % (number(self.factor * float(np.median(array)), 2), self.unit)


def short(v):
    return "%g" % v if v == 0 or 1e-3 <= v < 1e5 else number(v, 1)


def nice(value, up):
    """The next of 1, 2, 5, 10, … above or below."""
    steps = [m * 10. ** e for e in range(-12, 12) for m in (1, 2, 5)]
    return min(s for s in steps if s >= value) if up else max(s for s in steps if s <= value)


def _layer(layers, name):
    """At the size of a map. A layer of three channels is a colour; its mean is enough here."""
    if layers is None: return None
    planes = [layers[c] for c in (name + ".Y", name + ".R", name + ".G", name + ".B") if c in layers]
    if not planes: return None
    mean = np.mean(planes, axis=0, dtype=float)
    return images.smaller(mean, max(1, round(mean.shape[1] / WIDTH)))


def _relative_noise(variance, reference):
    """Standard error of the pixels in relation to the reference, of which 1 % keeps dark ones from standing out."""
    if variance is None: return None
    grey = images.smaller(reference.mean(axis=2), max(1, round(reference.shape[1] / WIDTH)))
    return np.sqrt(np.maximum(variance, 0)) / (grey + .01 * grey.mean())


def maps(error_maps, layers, reference):
    """[Map]: relative errors first; then what the program tells, as far as any variant has it. `layers`: a dictionary
    of channels, or None, for each variant."""
    def of(name): return [_layer(each, name) for each in layers]
    noise = [_relative_noise(v, reference) for v in of("variance")]
    found = [
        Map("e", "relative error", "The root mean square over the runs of the pixel's relative error.", error_maps,
            " %", logarithmic=True, factor=100),
        Map("n", "estimated noise", "Standard error that the program itself estimates, in relation to the reference, after "
            "a quarter of a run's time. Where it is dark and the error is not, light was missed.", noise, " %",
            logarithmic=True, factor=100),
        Map("h", "entropy of the choice of lights", "Bits: 0 where one light is certain, log₂ n where n lights are drawn "
            "alike. The darker, the more the sampler knows.", of("lightentropy"), " bit"),
        Map("c", "lights drawn", "The size of the light cut: lights drawn at a point where one would do.", of("lightcut"),
            low=1),
        Map("b", "share of BSDF samples", "Of the direct light, what BSDF samples rather than light samples found.",
            of("bsdfshare"), low=0, high=1),
        Map("p", "rays of a path", "How far paths go: rays without shadow rays.", of("pathlength")),
        Map("t", "time of a sample", "By the clock: where the light sampler thinks, and where paths are long.", of("time"),
            " µs", logarithmic=True)]
    return [m.fit() for m in found if any(a is not None for a in m.arrays)]
