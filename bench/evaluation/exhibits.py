# SPDX-License-Identifier: Apache-2.0
"""The images of a scene on a page: sliders, enlarged details, error maps. Every image is in the page once, as a
class of its style sheet; whatever shows it refers to that."""
import base64
import html

import numpy as np

from . import colours, images, measures
from .plots import number

DETAIL = 6  # a detail is the sixth part of the image's shorter edge
LABELS = "ABC"


def css_image(name, data):
    return ".%s{background-image:url(data:image/png;base64,%s)}" % (name, base64.b64encode(data).decode())


def nice(value, up):
    """The next of 1, 2, 5, 10, … above or below."""
    steps = [m * 10. ** e for e in range(-8, 8) for m in (1, 2, 5)]
    return min(s for s in steps if s >= value) if up else max(s for s in steps if s <= value)


def details(error_map):
    """Where to look: the squares (x, y, size) with most error that don't overlap."""
    h, w = error_map.shape
    size = max(8, min(h, w) // DETAIL)
    sums = np.pad(np.minimum(error_map, 4 * error_map.mean()).cumsum(0).cumsum(1), ((1, 0), (1, 0)))
    boxes = sums[size:, size:] - sums[:-size, size:] - sums[size:, :-size] + sums[:-size, :-size]
    found = []
    for _ in LABELS:
        y, x = np.unravel_index(np.argmax(boxes), boxes.shape)
        if boxes[y, x] < 0: break
        found.append((int(x), int(y), size))
        boxes[max(0, y - 2 * size):y + 2 * size, max(0, x - 2 * size):x + 2 * size] = -1
    return found


class Exhibits:
    """What to show of one scene. `load` gives the image of a file name of the results."""

    def __init__(self, scene, prefix, load):
        self.prefix, self.variants = prefix, [v for v in scene["variants"] if v["runs"]]
        halves = [load(name) for name in scene["reference"]["images"]]
        self.reference = (halves[0] + halves[1]) / 2
        self.pictures, self.maps = [], []
        for v in self.variants:
            renders = [load(r["image"]) for r in v["runs"]]
            self.pictures.append(renders[0])
            squares = np.mean([measures.relative_squares(i, self.reference) for i in renders], axis=0)
            self.maps.append(np.sqrt(squares))
        self.height, self.width = self.reference.shape[:2]
        self.details = details(self.maps[0]) if self.maps else []
        # Without pixels that are exact, as where there is nothing to see.
        errors = np.concatenate([np.array([.1]), *(m[m > 0] for m in self.maps)])
        low, high = np.percentile(errors, (2, 99.5))
        self.low, self.high = nice(max(low, 1e-4), False), nice(min(max(high, 1e-3), 1e6), True)

    def names(self):
        """(class, title) of the images: the reference first."""
        return [(self.prefix + "r", "reference")] + [
            ("%s%d" % (self.prefix, k), v["title"]) for k, v in enumerate(self.variants)]

    def css(self):
        exposure, ramp = images.exposure_for(self.reference), colours.palette()
        shown = [images.png(images.tone_mapped(i, exposure)) for i in [self.reference, *self.pictures]]
        out = [css_image(name, data) for (name, _), data in zip(self.names(), shown)]
        out += [css_image("%se%d" % (self.prefix, k), images.png(colours.indices(m, self.low, self.high), ramp))
                for k, m in enumerate(self.maps)]
        return "\n".join(out)

    def slider(self, left, right):
        """Two of the images (by number in names()) with a border to move."""
        def choice(place, chosen):
            options = "".join('<option value="%s"%s>%s</option>' % (
                c, " selected" if k == chosen else "", html.escape(t)) for k, (c, t) in enumerate(self.names()))
            return '<select name="%s" aria-label="%s image">%s</select>' % (place, place, options)
        windows = "".join(
            '<div class="window" style="left:%.2f%%;top:%.2f%%;width:%.2f%%;height:%.2f%%"><span>%s</span></div>' % (
                100 * x / self.width, 100 * y / self.height, 100 * s / self.width, 100 * s / self.height, LABELS[k])
            for k, (x, y, s) in enumerate(self.details))
        panes = "".join('<div class="picture %s %s"></div>' % (place, self.names()[k][0])
                        for place, k in (("right", right), ("left", left)))
        return ('<div class="comparison"><div class="choose">%s%s</div>'
                '<div class="compare" style="aspect-ratio:%d/%d">%s%s<div class="bar"></div>'
                '<input type="range" min="0" max="100" step="0.5" value="50" '
                'aria-label="border between the images"></div></div>' % (
                    choice("left", left), choice("right", right), self.width, self.height, panes, windows))

    def enlarged(self):
        """A row of every image for each detail."""
        rows = []
        for k, (x, y, s) in enumerate(self.details):
            style = "aspect-ratio:1;background-size:%.3f%% %.3f%%;background-position:%.3f%% %.3f%%" % (
                100 * self.width / s, 100 * self.height / s,
                100 * x / max(1, self.width - s), 100 * y / max(1, self.height - s))
            tiles = "".join('<div><div class="picture %s" style="%s"></div>%s</div>' % (
                c, style, "%s · %s" % (LABELS[k], html.escape(t))) for c, t in self.names())
            rows.append('<div class="tiles" style="--n:%d">%s</div>' % (min(6, len(self.names())), tiles))
        return "\n".join(rows)

    def error_maps(self):
        tiles = "".join(
            '<div><div class="picture %se%d" style="aspect-ratio:%d/%d"></div>%s<small>median %s %%</small></div>' % (
                self.prefix, k, self.width, self.height, html.escape(v["title"]), number(100 * float(np.median(m)), 2))
            for k, (v, m) in enumerate(zip(self.variants, self.maps)))
        return '<div class="tiles" style="--n:%d">%s</div>%s' % (min(6, max(2, len(self.maps))), tiles, self.scale())

    def scale(self):
        stops = ",".join("#%02x%02x%02x" % tuple(c) for c in colours.palette()[::7])
        span = np.log(self.high / self.low)
        at = {v: np.log(v / self.low) / span for v in [self.low, self.high, *(10. ** e for e in range(-5, 8))]}
        marks = "".join('<span style="left:%.1f%%">%s %%</span>' % (100 * t, number(100 * v, 1))
                        for v, t in at.items() if t in (0, 1) or .2 < t < .8)
        return ('<div class="scale"><span>relative error</span><div class="ramp picture" '
                'style="background-image:linear-gradient(90deg,%s)">%s</div></div>' % (stops, marks))
