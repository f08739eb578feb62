# SPDX-License-Identifier: Apache-2.0
"""The page of a results file: one HTML text that refers to nothing outside of itself."""
import html
import os
from collections import Counter

from . import plots, tables
from .exhibits import Exhibits
from .plots import number

HERE = os.path.dirname(os.path.abspath(__file__))
COLOURS = 7  # in page.css
BUSY = .9  # share of its processors that a program gets on a machine that is its own


def _file(name):
    with open(os.path.join(HERE, name), encoding="utf-8") as f: return f.read()


def _series(scene, colour_of, x, bar):
    """The curves of a scene's variants over `x`, and the equal-time runs as a mark with an interval."""
    for v in scene["variants"]:
        points = [(p[x], p["trimmed"]) for p in v["curve"]]
        mark = None
        if bar and v["runs"]:
            e = v["errors"]["trimmed"]
            mark = (v[x], e["value"], *(e["ci"] or (e["value"], e["value"])))
        if points or mark: yield {"title": v["title"], "colour": colour_of[v["name"]], "points": points, "bar": mark}


def _mark(variant, colour_of):
    return {"colour": colour_of[variant["name"]], **variant["against_base"]["trimmed"]}


def _bars(scene, colour_of):
    return [{"title": v["title"], "marks": [_mark(v, colour_of)]} for v in scene["variants"]
            if v["runs"] and v["against_base"]["trimmed"]]


def _plots(scene, colour_of):
    error, floor = tables.METRIC_TITLES["trimmed"], scene["reference"]["floor"]["trimmed"]
    over_time = plots.convergence(list(_series(scene, colour_of, "seconds", True)), "seconds", error, floor)
    over_samples = plots.convergence(list(_series(scene, colour_of, "spp", True)), "samples per pixel", error, floor)
    bars = plots.intervals(_bars(scene, colour_of), "efficiency, as a multiple of that of %s" % scene["base"])
    return ('<div class="pair"><figure>%s<figcaption><b>Error over time.</b> Small marks: one render each; large, hollow marks: '
            "the runs of the table, with the 95 %% interval of their mean. Further left is better.</figcaption></figure>"
            "<figure>%s<figcaption><b>Error over samples.</b> The same renders: what a sample is worth, whatever it costs."
            "</figcaption></figure></div><figure>%s<figcaption><b>Efficiency</b>, 1 / (error × time), with 95 %% intervals over pairs "
            "of runs.</figcaption></figure>" % (over_time, over_samples, bars))


def _pictures(shown):
    return ('<figure class="exhibit"><div>%s<figcaption><b>One run of each at equal time.</b> Choose two and move the border. The '
            "frames are the details on the right.</figcaption></div><div>%s<figcaption><b>Details</b>, where the base errs most."
            "</figcaption></div></figure><figure>%s<figcaption><b>Relative error</b> of each pixel, the root mean square over the "
            "runs.</figcaption></figure>" % (shown.slider(1, len(shown.variants)), shown.enlarged(), shown.error_maps()))


def _warnings(scene):
    runs = [v for v in scene["variants"] if v["runs"]]
    if any(v["cpu_share"] is not None and v["cpu_share"] < BUSY for v in runs):
        yield ("The program got only %s of its processors: the machine was busy with other things, so times and times' ratios are "
               "not to be trusted." % ", ".join("%.0f %%" % (100 * v["cpu_share"]) for v in runs))
    if any(abs(v["bias"]["z"] or 0) > tables.SUSPICIOUS_Z for v in runs):
        yield "A mean differs from the reference's by more than chance explains: a sampler is biased, or the reference is."
    if any(v["against_base"]["trimmed"] is None for v in runs):
        yield "The reference is too noisy for this: an error is less than twice the reference's own."


def _facts(scene):
    facts = ["%s lights" % number(scene["lights"], 7), "%s triangles" % number(scene["triangles"], 7)]
    if scene["tree_bytes"]:
        facts.append("light tree of %s built in %s s" % (tables.size(scene["tree_bytes"]), number(scene["tree_seconds"], 2)))
    facts.append("%s s a run" % number(scene["seconds"]))
    reference = scene["reference"]
    facts.append("reference: two halves of %s spp, %s" % (
        " and ".join(number(s) for s in reference["spp"]), " ".join(reference["define"]) or "as the scene says"))
    return " · ".join(html.escape(f) for f in facts)


def _scene(k, scene, colour_of, load):
    """The section, and the style sheet of its images."""
    shown = Exhibits(scene, "i%d" % k, load)
    body = ['<section id="scene-%d"><h2><span class="n">%d</span>%s</h2><p class="facts">%s</p>' % (
        k, k, html.escape(scene["title"]), _facts(scene))]
    body += ['<p class="warning">%s</p>' % html.escape(w) for w in _warnings(scene)]
    body.append(tables.scene_table(scene, colour_of))
    if shown.variants: body += [_plots(scene, colour_of), _pictures(shown)]
    body.append("</section>")
    return "\n".join(body), shown.css()


def _definitions(facts):
    rows = "".join("<dt>%s</dt><dd>%s</dd>" % (html.escape(k), html.escape(str(v))) for k, v in facts.items() if v)
    return "<dl>%s</dl>" % rows


def _forest(scenes, colour_of, base):
    rows = []
    for s in scenes:
        marks = [_mark(v, colour_of) for v in s["variants"]
                 if v["runs"] and v["name"] != s["base"] and v["against_base"]["trimmed"]]
        if marks and s["base"] == base: rows.append({"title": s["title"], "marks": marks})
    return plots.intervals(rows, "efficiency, as a multiple of that of %s" % base, 280, 940)


def page(results, load):
    """The HTML. `load` gives the image of a file name in the results."""
    scenes = results["scenes"]
    titles = {v["name"]: v["title"] for s in scenes for v in s["variants"]}
    base = Counter(s["base"] for s in scenes).most_common(1)[0][0]
    ordered = [base] + [n for n in titles if n != base]
    titles, colour_of = {n: titles[n] for n in ordered}, {n: k % COLOURS for k, n in enumerate(ordered)}
    sections = [_scene(k + 1, s, colour_of, load) for k, s in enumerate(scenes)]
    how = {"date": results["date"], "a run": "%s s on %d threads" % (number(results["seconds"]), results["threads"]),
           "repetitions": results["repetitions"], **{k: v for k, v in results["machine"].items()}}
    title = html.escape(results["title"])
    return """<!doctype html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">
<title>%s</title><style>%s
%s</style></head><body>
<header><div class="kicker">Lampyris · equal-time comparison</div><h1>%s</h1><p class="lead">%s</p></header>
<div class="meta">%s%s</div>
%s<figure>%s<figcaption><b>Efficiency in all scenes</b> on a logarithmic axis, with 95 %% intervals over pairs of runs.</figcaption></figure>
%s
<footer>relMSE: mean of (I − R)² / (R² + ε), ε = (1 %% of the reference's mean)². Trimmed: without the 0.1 %% of pixels with the largest
error. The reference's own error is subtracted where ratios are formed. The method: docs/evaluation.md.</footer>
<script>%s</script></body></html>
""" % (title, _file("page.css"), "\n".join(css for _, css in sections), title, html.escape(results["description"]),
       _definitions(how), _definitions(results["build"]), tables.overview(scenes, titles, colour_of, base),
       _forest(scenes, colour_of, base), "\n".join(body for body, _ in sections), _file("page.js"))
