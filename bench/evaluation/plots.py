# SPDX-License-Identifier: Apache-2.0
"""Figures as SVG text. Colours are classes (k0, k1, …) that the page's style sheet defines for light and dark;
each series has a shape of its own as well."""
import html
import math

WIDTH, HEIGHT = 460, 330
LEFT, RIGHT, TOP, BOTTOM = 58, 14, 46, 44
SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def number(x, digits=3):
    """With so many significant digits, as one writes it in a text."""
    if x is None or not math.isfinite(x): return "–"
    if x == 0: return "0"
    exponent = math.floor(math.log10(abs(float("%.*e" % (digits - 1, x)))))
    if -4 < exponent < 6: return "{:,.{}f}".format(x, max(0, digits - 1 - exponent)).replace(",", "\u202f")
    return "%.*f × 10%s" % (digits - 1, x / 10 ** exponent, str(exponent).translate(SUPERSCRIPTS))


def count(x):
    """A number of things: all its digits, unless it is a median between two."""
    return number(x) if x is None or x != round(x) else "{:,d}".format(round(x)).replace(",", "\u202f")


def text(x, y, content, anchor="middle", extra=""):
    return '<text x="%.1f" y="%.1f" text-anchor="%s" %s>%s</text>' % (x, y, anchor, extra, html.escape(content))


def line(x0, y0, x1, y1, kind):
    return '<line x1="%.1f" y1="%.1f" x2="%.1f" y2="%.1f" class="%s"/>' % (x0, y0, x1, y1, kind)


def marker(shape, x, y, r=4.2):
    """One of five shapes; equal in weight to the eye."""
    if shape % 5 == 0: return '<circle cx="%.1f" cy="%.1f" r="%.1f"/>' % (x, y, r)
    corners = {1: ((-.9, -.9), (.9, -.9), (.9, .9), (-.9, .9)), 2: ((0, -1.25), (1.15, .8), (-1.15, .8)),
               3: ((0, -1.35), (1.2, 0), (0, 1.35), (-1.2, 0)), 4: ((0, 1.25), (1.15, -.8), (-1.15, -.8))}[shape % 5]
    return '<polygon points="%s"/>' % " ".join("%.1f,%.1f" % (x + r * a, y + r * b) for a, b in corners)


class LogAxis:
    """Values to places along an axis from `start` to `end` pixels."""

    def __init__(self, values, start, end, pad=1.15):
        low, high = min(values) / pad, max(values) * pad
        if high / low < 4: low, high = low / 2, high * 2
        self.low, self.high, self.start, self.end = low, high, start, end

    def at(self, v):
        t = math.log(v / self.low) / math.log(self.high / self.low)
        return self.start + t * (self.end - self.start)

    def ticks(self):
        """(value, label or ""): decades, and 2 and 5 between them if there is room."""
        decades = math.log10(self.high / self.low)
        labelled = (1,) if decades > 2.6 else (1, 3) if decades > 1.6 else (1, 2, 5)
        first = math.floor(math.log10(self.low))
        for e in range(first, math.ceil(math.log10(self.high)) + 1):
            for m in range(1, 10):
                v = m * 10. ** e
                if self.low <= v <= self.high: yield v, self.label(m, e) if m in labelled else ""

    @staticmethod
    def label(m, e):
        if -3 <= e <= 3: return "%g" % (m * 10. ** e)
        power = "10" + str(e).translate(SUPERSCRIPTS)
        return power if m == 1 else "%d×%s" % (m, power)


def frame(x, y, x_title, y_title):
    out = []
    for v, label in x.ticks():
        p = x.at(v)
        if label: out += [line(p, y.start, p, y.end, "grid"), text(p, y.start + 16, label)]
        out.append(line(p, y.start, p, y.start + (5 if label else 3), "axis"))
    for v, label in y.ticks():
        p = y.at(v)
        if label: out += [line(x.start, p, x.end, p, "grid"), text(x.start - 8, p + 4, label, "end")]
        out.append(line(x.start - (5 if label else 3), p, x.start, p, "axis"))
    out += [line(x.start, y.start, x.end, y.start, "axis"), line(x.start, y.start, x.start, y.end, "axis"),
            text((x.start + x.end) / 2, y.start + 36, x_title, extra='class="title"'),
            text(x.start - 50, y.end - 14, y_title, "start", 'class="title"')]
    return out


def svg(width, height, parts, label):
    return '<svg viewBox="0 0 %d %d" role="img" aria-label="%s">%s</svg>' % (
        width, height, html.escape(label, quote=True), "".join(parts))


def text_width(content):
    """About, in the page's sans serif of 12 pixels."""
    return sum(3.7 if c in "fijlrt,.·' " else 7.3 for c in content)


def legend(series, right, y):
    """In one row that ends at `right`."""
    out = []
    for s in reversed(series):
        right -= text_width(s["title"])
        out.append(text(right, y + 4, s["title"], "start"))
        right -= 12
        out.append('<g class="k%d">%s</g>' % (s["colour"], marker(s["colour"], right, y)))
        right -= 18
    return out


def convergence(series, x_title, y_title, floor):
    """series: [{"title", "colour", "points": [(x, y)], "bar": (x, y, low, high) or None}]. Log-log, with a
    guide of slope -1 and the reference's own error, if that is near."""
    points = [p for s in series for p in s["points"]]
    points += [(s["bar"][0], v) for s in series if s["bar"] for v in s["bar"][1:]]
    points = [(a, b) for a, b in points if a > 0 and b > 0]
    if not points: return ""
    x = LogAxis([p[0] for p in points], LEFT, WIDTH - RIGHT)
    lowest = min(p[1] for p in points)
    near = [floor] if lowest / 30 < floor < lowest * 30 else []
    y = LogAxis([p[1] for p in points] + near, HEIGHT - BOTTOM, TOP)
    out = frame(x, y, x_title, y_title)
    if near:
        out += [line(x.start, y.at(floor), x.end, y.at(floor), "floor"),
                text(x.end, y.at(floor) - 5, "error of the reference itself", "end", 'class="note"')]
    out += slope_guide(x, y)
    for s in series:
        out.append('<g class="k%d">' % s["colour"])
        here = [(x.at(a), y.at(b)) for a, b in s["points"] if a > 0 and b > 0]
        if len(here) > 1: out.append('<polyline points="%s"/>' % " ".join("%.1f,%.1f" % p for p in here))
        out += [marker(s["colour"], *p) for p in here]
        if s["bar"]:
            a, b, low, high = s["bar"]
            out.append(line(x.at(a), y.at(low), x.at(a), y.at(high), "whisker"))
            out.append('<g class="hollow">%s</g>' % marker(s["colour"], x.at(a), y.at(b), 5.4))
        out.append("</g>")
    out += legend(series, WIDTH - RIGHT, 10)
    return svg(WIDTH, HEIGHT, out, "%s over %s" % (y_title, x_title))


def worth(series):
    """series: [{"title", "colour", "time", "error"}], both of one sample as multiples of the base's. What lies on a
    dotted line is equally efficient."""
    if not series: return ""
    x = LogAxis([s["time"] for s in series] + [1.], LEFT, WIDTH - RIGHT, 1.3)
    y = LogAxis([s["error"] for s in series] + [1.], HEIGHT - BOTTOM, TOP, 1.3)
    out = frame(x, y, "time of a sample, as a multiple", "error of a sample, as a multiple")
    for e in range(-4, 15):
        product = 2. ** -e  # error x time
        low, high = max(x.low, product / y.high), min(x.high, product / y.low)
        if low >= high: continue
        a, b = x.at(high), y.at(product / high)
        out.append(line(x.at(low), y.at(product / low), a, b, "unity" if e == 0 else "guide"))
        near_end = a > x.end - 26
        out.append(text(a - 4 if near_end else a, b - (7 if near_end else 4), "%g×" % 2 ** e,
                        "end" if near_end else "start", 'class="note"'))
    for s in series:
        out.append('<g class="k%d">%s</g>' % (s["colour"], marker(s["colour"], x.at(s["time"]), y.at(s["error"]), 5.4)))
    out += legend(series, WIDTH - RIGHT, 10)
    return svg(WIDTH, HEIGHT, out, "error over time of one sample")


def slope_guide(x, y):
    """A short line of slope -1 in the lower left corner, where curves that fall leave room."""
    a0 = x.low * (x.high / x.low) ** .06
    b0 = y.low * (y.high / y.low) ** .3
    f = min((x.high / x.low) ** .2, (y.high / y.low) ** .22)
    ends = (x.at(a0), y.at(b0), x.at(a0 * f), y.at(b0 / f))
    return [line(*ends, "guide"), text(ends[0] + 2, ends[3] + 4, "∝ 1/n", "start", 'class="note"')]


def intervals(rows, x_title, label_width=150, width=WIDTH):
    """rows: [{"title", "marks": [{"colour", "value", "ci"}]}], values on a logarithmic axis with 1 marked;
    one mark to a line. A row without a title belongs to the one before."""
    marks = [m for r in rows for m in r["marks"]]
    values = [v for m in marks for v in (m["value"], *(m["ci"] or ())) if v > 0]
    if not values: return ""
    # Rows of several marks are close; single ones get room.
    step, gap = (17, 9) if len(marks) > len(rows) else (22, 12)
    top = 16
    height = top + sum(step * len(r["marks"]) + gap for r in rows) + BOTTOM
    x = LogAxis(values + [1.], label_width, width - 62)
    bottom, out, y = height - BOTTOM, [], top
    for v, name in x.ticks():
        if name: out += [line(x.at(v), top - 8, x.at(v), bottom, "grid"), text(x.at(v), bottom + 16, name)]
        out.append(line(x.at(v), bottom, x.at(v), bottom + (5 if name else 3), "axis"))
    out += [line(x.start, bottom, x.end, bottom, "axis"), line(x.at(1), top - 8, x.at(1), bottom, "unity"),
            text((x.start + x.end) / 2, bottom + 36, x_title, extra='class="title"')]
    for r in rows:
        out.append(text(x.start - 12, y + step * len(r["marks"]) / 2 + 3, r["title"], "end"))
        for m in r["marks"]:
            out += interval_mark(x, y + step / 2, m, width)
            y += step
        y += gap
    return svg(width, height, out, x_title)


def interval_mark(x, y, m, width):
    """A bar from 1 to the value, its confidence interval, and the number at the right edge."""
    a, b = sorted((x.at(1), x.at(m["value"])))
    out = ['<g class="k%d"><rect x="%.1f" y="%.1f" width="%.1f" height="8" class="bar"/>' % (
        m["colour"], a, y - 4, b - a)]
    if m["ci"]:
        low, high = (x.at(v) for v in m["ci"])
        out += [line(low, y, high, y, "whisker"), line(low, y - 3.5, low, y + 3.5, "whisker"),
                line(high, y - 3.5, high, y + 3.5, "whisker")]
    out += [marker(m["colour"], x.at(m["value"]), y, 3.6), "</g>"]
    return out + [text(width - 4, y + 4, number(m["value"]) + "×", "end")]
