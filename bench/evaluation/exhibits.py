# SPDX-License-Identifier: Apache-2.0
"""The images of a scene on a page: sliders, enlarged details, false-colour maps. Every image is in the page once, as a
class of its style sheet; whatever shows it refers to that."""
import base64
import html

import numpy as np

from . import heatmaps, images, measures

DETAIL = 6  # a detail is the sixth part of the image's shorter edge
LABELS = "ABC"


def css_image(name, data):
    return ".%s{background-image:url(data:image/png;base64,%s)}" % (name, base64.b64encode(data).decode())


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
    """What to show of one scene. `files` reads the images that the results name."""

    def __init__(self, scene, prefix, files):
        self.prefix, self.variants = prefix, [v for v in scene["variants"] if v["runs"]]
        halves = [files.image(name) for name in scene["reference"]["images"]]
        self.reference = (halves[0] + halves[1]) / 2
        self.pictures, errors = [], []
        for v in self.variants:
            renders = [files.image(r["image"]) for r in v["runs"]]
            self.pictures.append(renders[0])
            squares = np.mean([measures.relative_squares(i, self.reference) for i in renders], axis=0)
            errors.append(np.sqrt(squares))
        self.height, self.width = self.reference.shape[:2]
        self.details = details(errors[0]) if errors else []
        layers = [files.layers(v["aovs"]) if v["aovs"] else None for v in self.variants]
        self.maps = heatmaps.maps(errors, layers, self.reference)

    def names(self):
        """(class, title) of the images: the reference first."""
        return [(self.prefix + "r", "reference")] + [
            ("%s%d" % (self.prefix, k), v["title"]) for k, v in enumerate(self.variants)]

    def css(self):
        exposure = images.exposure_for(self.reference)
        shown = [images.png(*images.quantised(images.tone_mapped(i, exposure))) for i in [self.reference, *self.pictures]]
        out = [css_image(name, data) for (name, _), data in zip(self.names(), shown)]
        out += [css_image(self.map_class(m, k), m.png(a)) for m in self.maps for k, a in enumerate(m.arrays) if a is not None]
        return "\n".join(out)

    def map_class(self, m, k): return self.prefix + m.key + str(k)

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

    def false_colours(self):
        """A map of every quantity for each variant, of which one quantity is shown at a time."""
        options = "".join('<option value="%d">%s</option>' % (k, html.escape(m.title)) for k, m in enumerate(self.maps))
        sheets = "".join('<div class="sheet"%s><p class="facts"><b>%s.</b> %s</p>%s%s</div>' % (
            " hidden" if k else "", html.escape(m.title.capitalize()), html.escape(m.text), self.tiles(m), m.scale())
            for k, m in enumerate(self.maps))
        return '<div class="sheets"><div class="choose"><label>shown: <select>%s</select></label></div>%s</div>' % (
            options, sheets)

    def tiles(self, m):
        tiles = "".join(
            '<div><div class="picture %s" style="aspect-ratio:%d/%d"></div>%s<small>%s</small></div>' % (
                self.map_class(m, k), self.width, self.height, html.escape(v["title"]), m.median(m.arrays[k]))
            for k, v in enumerate(self.variants))
        return '<div class="tiles" style="--n:%d">%s</div>' % (min(6, max(2, len(self.variants))), tiles)
