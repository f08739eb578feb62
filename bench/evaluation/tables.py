# SPDX-License-Identifier: Apache-2.0
"""The tables of a page."""
import html
import math
from collections import Counter

from .measures import METRICS
from .plots import count, marker, number

METRIC_TITLES = {"trimmed": "trimmed relMSE", "relmse": "relMSE", "mse": "MSE"}
SUSPICIOUS_Z = 4


def swatch(colour):
    return '<svg class="swatch" viewBox="-7 -7 14 14" aria-hidden="true"><g class="k%d">%s</g></svg>' % (
        colour, marker(colour, 0, 0, 5))


def cell(content, small="", kind=""):
    return "<td%s>%s%s</td>" % (
        ' class="%s"' % kind if kind else "", content, "<small>%s</small>" % small if small else "")


def interval(ends):
    if not ends: return ""
    low, high = (number(v, 2).partition(" × ") for v in ends)
    if low[2] and low[2] == high[2]: return "(%s – %s) × %s" % (low[0], high[0], low[2])
    return "%s – %s" % tuple(map("".join, (low, high)))


def times(estimate):
    """A ratio with its interval."""
    if not estimate: return "–", ""
    return number(estimate["value"]) + "×", interval(estimate["ci"])


def size(number_of_bytes):
    if number_of_bytes is None: return "–"
    exponent = min(3, int(math.log2(max(1, number_of_bytes)) // 10))
    return "%s %s" % (number(number_of_bytes / 2 ** (10 * exponent)), ("B", "KiB", "MiB", "GiB")[exponent])


def bias_cell(bias):
    if bias["z"] is None: return cell("%.4f" % bias["ratio"])
    kind = "doubt" if abs(bias["z"]) > SUSPICIOUS_Z else ""
    z = round(bias["z"], 1)
    sign = "−" if z < 0 else "+" if z > 0 else ""
    return cell("%.4f" % bias["ratio"], "z = %s%.1f" % (sign, abs(z)), kind)


def best_of(variants, value):
    """The name of the variant with the largest value, if there is more than one to compare."""
    values = {v["name"]: value(v) for v in variants if v["runs"] and value(v) is not None}
    return max(values, key=values.get) if len(values) > 1 else None


def variant_rows(scene, colour_of, with_lights):
    best = best_of(scene["variants"], lambda v: (v["against_base"]["trimmed"] or {}).get("value"))
    columns = 9 + with_lights
    for v in scene["variants"]:
        head = '<tr><th scope="row">%s%s%s</th>' % (
            swatch(colour_of[v["name"]]), html.escape(v["title"]), " (then failed)" if v["runs"] and v["failed"] else "")
        if not v["runs"]:
            yield head + '<td class="why" colspan="%d">failed: %s</td></tr>' % (
                columns, html.escape(v["failed"].strip().split("\n")[-1][:300]))
            continue
        cells = [cell(number(v["seconds"]) + " s"), cell(count(v["spp"]), number(v["samples_per_second"]) + "/s")]
        for m in METRICS:
            e = v["errors"][m]
            cells.append(cell(number(e["value"]), interval(e["ci"])))
        cells.append(bias_cell(v["bias"]))
        cells += ratio_cells(scene, v, best)
        if with_lights: cells.append(light_cell(v["light_statistics"]))
        cells.append(cell(size(v["memory"]), number(v["load_seconds"], 2) + " s"))
        yield head + "".join(cells) + "</tr>"


def light_cell(statistics):
    if not statistics: return cell("–")
    return cell(number(statistics["entropy, bits"]) + " bit", number(statistics["lights drawn"]))


def ratio_cells(scene, v, best):
    kind, equal = "best" if v["name"] == best else "", v["equal_samples"]
    if v["name"] == scene["base"]: return [cell("1", kind=kind), cell("1" if equal else "–")]
    ratio, ends = times(equal["trimmed"] if equal else None)
    at = "<br>%s spp" % number(equal["spp"], 2) if equal else ""
    return [cell(*times(v["against_base"]["trimmed"]), kind), cell(ratio, ends + at)]


def masked(scene):
    """Which pixels count, if not all."""
    share = scene.get("counted_share", 1.)
    return "" if share == 1 else "Errors and means are those of %s %% of the pixels; the suite masks the others. " % number(100 * share)


def scene_table(scene, colour_of):
    with_lights = any(v["light_statistics"] for v in scene["variants"] if v["runs"])
    heads = ["time", "spp, samples", *(METRIC_TITLES[m] for m in METRICS), "mean", "at equal time",
             "at equal spp", *["entropy, lights"] * with_lights, "memory, load"]
    floor = scene["reference"]["floor"]
    caption = ("Medians of the runs; errors are means, with 95 %% intervals below. <b>Mean</b> is the ratio to the "
               "reference's, z its distance from 1 in standard deviations. <b>At equal time</b>: how many times less time "
               "it needs than <i>%s</i> for the same %s; <b>at equal spp</b>: how many times smaller that error is, at the most samples "
               "that all runs of both have. %s<b>Entropy</b> of the choice of a light, in bits, and how many <b>lights</b> are "
               "drawn: means over the points where lights are sampled. The "
               "reference's own error: %s." % (
                   html.escape(scene["base"]), METRIC_TITLES["trimmed"], masked(scene),
                   ", ".join("%s %s" % (METRIC_TITLES[m], number(floor[m], 2)) for m in METRICS)))
    return table(caption, "<th>light sampler</th>" + "".join("<th>%s</th>" % h for h in heads),
                 "".join(variant_rows(scene, colour_of, with_lights)))


def table(caption, head, body, foot=""):
    # The caption is no <caption>, because a wide table scrolls and its caption must not.
    return ('<figure class="tabular"><div class="scroll"><table><thead><tr>%s</tr></thead><tbody>%s</tbody>%s</table>'
            "</div><figcaption>%s</figcaption></figure>" % (head, body, foot, caption))


def geometric_means(scenes, titles, base):
    """Of the variants that were measured in every scene that has this base; and how many scenes these are."""
    ratios = [{v["name"]: v["against_base"]["trimmed"] for v in s["variants"]} for s in scenes if s["base"] == base]
    complete = [n for n in titles if all(r.get(n) for r in ratios)]
    return {n: math.exp(sum(math.log(r[n]["value"]) for r in ratios) / len(ratios)) for n in complete}, len(ratios)


def columns(results):
    """({name: title} of the variants that any scene has, the most common base first; that base)."""
    scenes = results["scenes"]
    shown = {v["name"] for s in scenes for v in s["variants"]}
    base = Counter(s["base"] for s in scenes).most_common(1)[0][0]
    ordered = [base] + [n for n in results["variants"] if n in shown and n != base]
    return {n: results["variants"][n] for n in ordered}, base


def mean_entries(scenes, titles, base):
    """(what it is a mean of, entries), if that is of more than one scene."""
    means, counted = geometric_means(scenes, titles, base)
    if counted < 2: return None
    return "geometric mean of %d" % counted, [
        "–" if n not in means else "1" if n == base else number(means[n]) + "×" for n in titles]


def mean_row(scenes, titles, base):
    found = mean_entries(scenes, titles, base)
    return found and '<tfoot><tr><th scope="row">%s</th><td></td>%s</tr></tfoot>' % (
        found[0], "".join(map(cell, found[1]))) or ""


def overview(scenes, titles, colour_of, base):
    rows = []
    for k, s in enumerate(scenes):
        by_name = {v["name"]: v for v in s["variants"]}
        best = best_of(s["variants"], lambda v: (v["against_base"]["trimmed"] or {}).get("value"))
        cells = []
        for n in titles:
            v = by_name.get(n)
            if not v: cells.append(cell(""))
            elif not v["runs"]: cells.append(cell("failed", kind="none"))
            elif n == s["base"]: cells.append(cell("1", kind="best" if n == best else ""))
            else: cells.append(cell(*times(v["against_base"]["trimmed"]), "best" if n == best else ""))
        rows.append('<tr><th scope="row"><a href="#scene-%d">%s</a></th><td>%s</td>%s</tr>' % (
            k + 1, html.escape(s["title"]), count(s["lights"]), "".join(cells)))
    heads = "".join('<th class="name">%s%s</th>' % (swatch(colour_of[n]), html.escape(t)) for n, t in titles.items())
    caption = ("How many times less time each needs for the same error (trimmed relMSE) as the scene's base, the one with "
               "1: the mean over pairs of runs, below it the 95 % interval. Bold: the best.")
    return table(caption, "<th>scene</th><th>lights</th>" + heads, "".join(rows),
                 mean_row(scenes, titles, base))
