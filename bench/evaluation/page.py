# SPDX-License-Identifier: Apache-2.0
"""The page of a results file: one HTML text that refers to nothing outside of itself."""
import html
import os

from . import plots, tables
from .exhibits import Exhibits
from .plots import count, number

HERE = os.path.dirname(os.path.abspath(__file__))
COLOURS = 7  # in page.css
BUSY = .05  # share of the processors that others take on a machine that is not quiet


def _file(name):
    with open(os.path.join(HERE, name), encoding="utf-8") as f: return f.read()


def _series(scene, colour_of, x):
    """The curves of a scene's variants over `x`, and the equal-time runs as a mark with an interval."""
    for v in scene["variants"]:
        points = [(p[x], p["trimmed"]) for p in v["curve"]]
        mark = None
        if v["runs"]:
            e = v["errors"]["trimmed"]
            mark = (v["curve"][-1][x], e["value"], *(e["ci"] or (e["value"], e["value"])))
        if points or mark: yield {"title": v["title"], "colour": colour_of[v["name"]], "points": points, "bar": mark}


def _mark(variant, colour_of):
    return {"colour": colour_of[variant["name"]], **variant["against_base"]["trimmed"]}


def _bars(scene, colour_of):
    return [{"title": v["title"], "marks": [_mark(v, colour_of)]} for v in scene["variants"]
            if v["runs"] and v["name"] != scene["base"] and v["against_base"]["trimmed"]]


def _worths(scene, colour_of):
    """What one sample costs and leaves of the error, the base's being 1."""
    runs = [v for v in scene["variants"] if v["runs"] and v["against_base"]["trimmed"]]
    base = next((v for v in runs if v["name"] == scene["base"]), None)
    if not base: return
    for v in runs:
        time = v["seconds"] / v["spp"] / (base["seconds"] / base["spp"])
        # So that its place on the plot is the efficiency that the table tells.
        yield {"title": v["title"], "colour": colour_of[v["name"]], "time": time,
               "error": 1 / (v["against_base"]["trimmed"]["value"] * time)}


def _figure(content, title, text):
    return "<figure>%s<figcaption><b>%s</b>%s</figcaption></figure>" % (content, title, text)


def _plots(scene, colour_of):
    error, floor = tables.METRIC_TITLES["trimmed"], scene["reference"]["floor"]["trimmed"]
    efficiency = "efficiency, as a multiple of that of %s" % scene["base"]
    return '<div class="pair">%s</div>' % "".join((
        _figure(plots.convergence(list(_series(scene, colour_of, "seconds")), "seconds", error, floor),
                "Error over time.", " Small marks: on the way of the runs, means over them; large, hollow ones: their ends, "
                "with the 95 % interval. Further left is better."),
        _figure(plots.convergence(list(_series(scene, colour_of, "spp")), "samples per pixel", error, floor),
                "Error over samples.", " The same runs: what a sample is worth, whatever it costs."),
        _figure(plots.intervals(_bars(scene, colour_of), efficiency),
                "Efficiency", ", 1 / (error × time), with 95 % intervals over pairs of runs."),
        _figure(plots.worth(list(_worths(scene, colour_of))), "What a sample costs and what it is worth.",
                " On a line all are equally efficient; further down and left is better.")))


def _pictures(shown):
    one = _figure(shown.slider(1, len(shown.variants)), "One run of each at equal time.",
                  " Choose two and move the border. The frames are the details beside it.")
    return '<div class="exhibit">%s%s</div>%s' % (
        one, _figure(shown.enlarged(), "Details", ", where the base errs most."),
        _figure(shown.false_colours(), "What happens in each pixel.", " One scale for all light samplers of a scene; the lighter, the more."))


def _warnings(scene):
    runs = [v for v in scene["variants"] if v["runs"]]
    others = max((v["others_share"] for v in runs), default=0)
    if others > BUSY:
        yield "Other programs took up to %.0f %% of the processors: times are not to be trusted." % (100 * others)
    if any(abs(v["bias"]["z"] or 0) > tables.SUSPICIOUS_Z for v in runs):
        yield "A mean differs from the reference's by more than chance: a light sampler is biased, or the reference is."
    if any(v["against_base"]["trimmed"] is None for v in runs):
        yield "The reference is too noisy for this: an error is less than twice the reference's own."


def _facts(scene):
    facts = ["%s lights" % count(scene["lights"]), "%s triangles" % count(scene["triangles"])]
    if scene["tree_bytes"]:
        facts.append("light tree of %s, built in %s s" % (
            tables.size(scene["tree_bytes"]), number(scene["tree_seconds"], 2)))
    facts.append("%g s a run" % scene["seconds"])
    reference = scene["reference"]
    facts.append("reference: two halves of %s spp, %s" % (
        " and ".join(count(s) for s in reference["spp"]), " ".join(reference["define"]) or "as the scene says"))
    return " · ".join(html.escape(f) for f in facts)


def _scene(k, scene, colour_of, files):
    """The section, and the style sheet of its images."""
    shown = Exhibits(scene, "i%d" % k, files)
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
    drawn = plots.intervals(rows, "efficiency, as a multiple of that of %s" % base, 280, 940)
    return _figure(drawn, "Efficiency in all scenes",
                   " on a logarithmic axis, with 95 % intervals over pairs of runs.")


def page(results, files):
    """The HTML. `files` reads the images that the results name."""
    scenes = results["scenes"]
    titles, base = tables.columns(results)
    colour_of = {n: k % COLOURS for k, n in enumerate(titles)}
    sections = [_scene(k + 1, s, colour_of, files) for k, s in enumerate(scenes)]
    how = {"date": results["date"], "a run": "%g s on %d threads" % (results["seconds"], results["threads"]),
           "repetitions": results["repetitions"], **{k: v for k, v in results["machine"].items()}}
    title = html.escape(results["title"])
    return """<!doctype html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">
<title>%s</title><style>%s
%s</style></head><body>
<header><div class="kicker">Lampyris · equal-time comparison</div><h1>%s</h1><p class="lead">%s</p></header>
<div class="meta">%s%s</div>
%s%s
%s
<footer>relMSE: mean of (I − R)² / (R² + ε), ε = (1 %% of the reference's mean)². Trimmed: without the 0.1 %% of pixels
with the largest error. The reference's own error is subtracted where ratios are formed. The method:
docs/evaluation.md.</footer>
<script>%s</script></body></html>
""" % (title, _file("page.css"), "\n".join(css for _, css in sections), title, html.escape(results["description"]),
       _definitions(how), _definitions(results["build"]), tables.overview(scenes, titles, colour_of, base),
       _forest(scenes, colour_of, base), "\n".join(body for body, _ in sections), _file("page.js"))
