#!/usr/bin/env python3
"""Runs the experiments accuracy_vs_time* and writes docs/results/accuracy-vs-time.md from their results.

  scripts/studies/accuracy_vs_time.py out --run                       # runs every part that RESULTS lacks, then writes the page
  scripts/studies/accuracy_vs_time.py out > docs/results/accuracy-vs-time.md  # writes the page only
  scripts/studies/accuracy_vs_time.py out --quick --run               # tests the machinery in seconds: no measurement

A part is a member of one of the experiments: a scene under a footprint filter, RESULTS/EXPERIMENT/MEMBER/results.json.
An interrupted run resumes. Bakes are cached in RESULTS/cache, where all filters share them. The experiments
accuracy_vs_time_cost, _flicker and _bound time frames, measure flicker and render exact filtering. --footprint names
the program, --svg the file for the chart of the fronts, --note a sentence about the machine. The page depends only on
the parts, and names those that are missing. Exit code 1 if there is none, or if one cannot be run.
"""
import collections
import math
import sys

from study import (OURS, PLAIN, ROOT, UNPUBLISHED, LogChart, Missing, code, costs_of, error_on_front, front_of,
                   geometric_mean, gpu_costs_of, grouped, matrix_of, mean, number,
                   palette, parser_of, records_of, reported, results_in, run_footprint, spread, table, wrapped)

STUDY = "accuracy_vs_time"
EXPERIMENTS = {"cost": f"{STUDY}_cost", "flicker": f"{STUDY}_flicker", "bound": f"{STUDY}_bound", "": STUDY}
QUICK = {"quick": f"{STUDY}_quick"}
LEAST = 1e-3  # smaller values of `error.method` count as this: they are below a level of 8 bits
# Steps of the price list: from, to, description.
STEPS = [("tan_gmm:n=2", "tan_gmm", "two more Gaussians"), ("cells:k=2", "cells:k=3", "a third part"),
         ("cells:k=3", "cells", "a fourth part"), ("cells:storage=fp16", "cells", "fp32 for fp16"),
         ("cells", "cells:covariance=full", "whole covariances for those on a part's axes"),
         ("lean:storage=fp16", "lean", "fp32 for fp16"), ("xu_vmf:j=1", "xu_vmf", "parts where a pixel needs them"),
         ("naive_mip", "roughness_bake", "a constant on baked roughness"),
         ("toksvig", "lean", "a covariance for a length"),
         ("tan_gmm", "tan_gmm:covariance=full", "full covariances for round ones"),
         ("lean", "cells", "four parts for one"), ("tan_gmm", "cells", "moments of four parts for four Gaussians"),
         ("cells:k=3", "ndf_atlas", "tables over three parts"),
         ("ndf_atlas:level=3", "ndf_atlas", "tables from a finer level on")]
UP_TO_LEAN = ["direct", "naive_mip", "roughness_bake", "specular_aa", "toksvig", "lean", "lean:storage=fp16", "leadr",
              "xu_vmf:j=1"]  # one lobe
EXACT = "exact:kernel=pixel"
AIM = 0.75
WIDTHS = [(0, 8), (8, 16), (16, 32), (32, 64), (64, 1e9)]
PROBED = ["toksvig", "lean", "tan_gmm", "cells"]  # the price list has a step from filter to filter for each

Point = collections.namedtuple("Point", "scene filter method distance error floor by_filter by_method bytes width")


def planned(experiments):
    """{part: its filters}; the parts of the experiment "" are its scenes."""
    parts = {}
    for part, experiment in experiments.items():
        matrix = matrix_of(experiment)
        parts |= {name: matrix["footprint"] for name in ([part] if part else matrix["scene"])}
    return parts


def read_parts(folder, experiments):
    """{part: {filter: results}} of the results in the folder, in the order of the plan."""
    plan = planned(experiments)
    found = {part: dict.fromkeys(filters) for part, filters in plan.items()}
    for part, experiment in experiments.items():
        for results in results_in(folder / experiment):
            found.setdefault(part or results["scene"]["name"], {})[results["footprint"]] = results
    found = {part: {f: results for f, results in by_filter.items() if results} for part, by_filter in found.items()}
    return {part: by_filter for part, by_filter in found.items() if by_filter}


def run_missing(folder, experiments, program):
    """Runs each experiment of which the folder lacks a part; the program resumes those that were interrupted."""
    for part, experiment in experiments.items():
        parts = read_parts(folder, {part: experiment})
        if any(set(filters) - parts.get(name, {}).keys() for name, filters in planned({part: experiment}).items()):
            print(experiment, file=sys.stderr)
            run_footprint("run", ROOT / f"experiments/{experiment}.toml", "-q", "-o", folder / experiment, program=program,
                          cache=folder / "cache")


def points_of(scene, name, results):
    """All errors of a scene under a filter; supersampling with N samples is a method of its own, `plain supersampling N`."""
    texels = max((r["precompute"]["bytes"] / r["precompute"]["bytes_per_texel"] for r in results["records"]
                  if r["precompute"]["bytes_per_texel"]), default=0) if results["scene"]["materials"] == 1 else 0
    for r in results["records"]:
        error, pixels = r["error"], r["pixels"]["object"]
        if error["shading"]:
            yield Point(scene, name, r["method"], r["distance"], error["shading"], error["shading_floor"] or 0.0, error["filter"],
                        max(error["method"], LEAST) if error["method"] is not None else None, r["precompute"]["bytes"],
                        math.sqrt(texels / pixels) if pixels else None)
    for s in results["supersampling"]:
        yield Point(scene, name, f"{PLAIN} {s['spp']}", s["distance"], s["shading"] or s["normalized_color"], 0.0, None, None, 0, None)


class Study:
    def __init__(self, folder, experiments):
        self.plan, self.parts = planned(experiments), read_parts(folder, experiments)
        if not self.parts:
            raise Missing(f"{folder} has no part of the study; make them with --run")
        self.cost, self.flickering, self.bound = ([p for p in experiments if p] * 3)[:3]
        self.filters = next(iter(self.plan.values()))
        self.points = [point for scene in [p for p in self.parts if p not in experiments] or list(self.parts)
                       for name, results in self.parts[scene].items() for point in points_of(scene, name, results)]
        self.costs = costs_of(self.of(self.cost))
        self.gpu_costs = gpu_costs_of(self.of(self.cost))
        flicker = grouped((key, (r["flicker"]["mean"], r["flicker"]["noise_floor"]))
                          for key, r in records_of(self.of(self.flickering)) if r.get("flicker"))
        self.flicker = {key: tuple(map(mean, zip(*frames))) for key, frames in flicker.items()}  # means over frames, and of noise floors
        bakes = {}  # seconds of those that did not come from the cache: one per part
        for part, by_filter in self.parts.items():
            for (_, method), r in records_of(by_filter):
                if not r["precompute"]["cached"]:
                    bakes.setdefault((method, part), r["precompute"]["seconds"])
        self.bakes = grouped((method, seconds) for (method, _), seconds in bakes.items())
        self.scenes = list(dict.fromkeys(p.scene for p in self.points))
        covered = {(p.scene, p.filter) for p in self.points}
        self.used = [f for f in self.filters if (f, "direct") in self.costs and any(f == name for _, name in covered)]
        self.whole = [s for s in self.scenes if all((s, f) in covered for f in self.used)]
        self.distances = sorted({p.distance for p in self.points})
        self.at = {(p.scene, p.filter, p.method, p.distance): p for p in self.points}
        self.methods = [m for m in dict.fromkeys(p.method for p in self.points) if not m.startswith(PLAIN)]
        if not self.used or not self.whole:
            raise Missing("no scene has every filter, or no filter has its costs")

    def of(self, part):
        """The results of a part, by filter."""
        return self.parts.get(part, {})

    def get(self, scene, name, method, distance):
        return self.at.get((scene, name, method, distance))

    def errors(self, name, method, distances):
        found = [self.get(s, name, method, d) for s in self.whole for d in distances]
        return [p.error for p in found if p]

    def entries(self, distances, without=(), costs=None):
        """(cost, error, filter, method): geometric means over the whole scenes, without the methods of `without`."""
        first, costs = self.used[0], costs or self.costs
        methods = [m for m in self.methods if not m.startswith(without)]
        tried = [(name, method, name) for name in self.used for method in methods]
        tried += [(name, method, "-") for name, method in costs if name == first and method.startswith(PLAIN)]
        return [(costs[name, method][0], geometric_mean(values), shown, method) for name, method, shown in tried
                if (name, method) in costs and (values := self.errors(name, method, distances))]


def head_part(study, note):
    whole = [results for scene in study.whole for results in study.of(scene).values()]
    results, timed = whole[0], next(iter(study.of(study.cost).values()))
    renderers = ", ".join(sorted({r["backend"]["renderer"] for r in whole}))
    samples = [r["reference"].get("samples", r["reference"]["spp"]) for r in whole]
    ends = dict.fromkeys(f"{end(samples):.0f}" for end in (min, max))  # one if they are equal
    width, height = results["records"][0].get("size", ("?", "?"))
    lacking = {part: [f for f in filters if f not in study.of(part)] for part, filters in study.plan.items()}
    lacks = [f"`{part}` under {'any' if filters == study.plan[part] else ', '.join(code(filters))}"
             for part, filters in lacking.items() if filters]
    return f"""# What accuracy costs in time

`scripts/studies/accuracy_vs_time.py` writes this page from `experiments/accuracy_vs_time.toml`: \
Footprint {results["tool"]["version"]}; images by {renderers}; times by {timed["backend"]["renderer"]}. The scenes have {width} x \
{height} pixels and references of {" to ".join(ends)} samples per pixel. Error is the shading error over interior pixels \
([metrics.md](../reference/metrics.md)). Cost is the frame time over that of `direct` in the member `{study.cost}`: median of \
interleaved rounds, geometric mean over its distances.{note} Means are geometric, over the scenes that have every \
[filter](../reference/filters.md). ×/÷ is the geometric standard deviation over scenes and distances.

Not run: {", ".join(lacks) if lacks else "nothing"}."""


def front_table(study, front, distances, unit):
    rows = [[method + (" *" if method.startswith(OURS) else ""), name, number(cost),
             spread(study.errors(study.used[0] if name == "-" else name, method, distances))]
            for cost, _, name, method in front]
    return table(["method", "filter", unit, "error"], rows)


def fronts_part(study):
    parts = ["## Fronts over all scenes\n\nPareto-optimal configurations, with plain supersampling; `*` is our own."]
    every = [(f"Distance {number(d)}", [d]) for d in study.distances] + [("All distances", study.distances)]
    for title, distances in every:
        front = front_of(study.entries(distances))
        parts.append(f"**{title}**\n\n" + front_table(study, front, distances, "frames of `direct`"))
    return "\n\n".join(parts)


def gpu_part(study):
    """Fronts by estimated cost, and what they change in the front by frame time."""
    text = "## Fronts by estimated cost on GPUs\n\n"
    if not study.gpu_costs:
        return text + f"Not estimated: `{study.cost}` names no GPU."
    text += ("These fronts have the same errors over all distances, against the [estimated cost](../explanation/gpu-cost.md) of "
             f"`{study.cost}`, including the passes of each frame.")
    by_time = [entry[2:] for entry in front_of(study.entries(study.distances))]
    changes, best = [], []
    for gpu, costs in study.gpu_costs.items():
        front = front_of(study.entries(study.distances, costs=costs))
        here = [entry[2:] for entry in front]
        changes.append([gpu] + ["; ".join(f"`{method}` {name}" for name, method in found) or "none" for found in (
            [entry for entry in by_time if entry not in here], [entry for entry in here if entry not in by_time])])
        best += best_of_ours(study, UNPUBLISHED, gpu, costs)
        text += f"\n\n**{gpu}**\n\n" + front_table(study, front, study.distances, "cost over `direct`")
    text += ("\n\nThese configurations are on only one of the fronts:\n\n" +
             table(["GPU", "only by frame time", "only by estimated cost"], changes))
    if best:
        text += ("\n\nThese are our lowest errors relative to the front of published methods and plain supersampling "
                 "([method](#our-own-against-tan_gmm-and-the-front)):\n\n" +
                 table(["GPU", "method", "filter", "cost", "error"], best))
    return text


def all_part(study):
    def cell_of(name, method):
        cost, values = study.costs.get((name, method)), study.errors(name, method, study.distances)
        return (f"{number(cost[0])} ({number(cost[1])} to {number(cost[2])}), {spread(values)}" if cost and values
                else "n/a")

    rows = [[f"`{method}`"] + [cell_of(name, method) for name in study.used] for method in study.methods]
    return ("## Every method under every filter\n\nA cell has frames of `direct` (least to most of the "
            "rounds), then the error over all scenes and distances.\n\n" + table(["method"] + code(study.used), rows))


def work_part(study):
    """Seconds and bytes of the bakes; texture lookups and lobes per pixel."""
    records = grouped(records_of(study.of(study.cost)))

    def work_of(name, method):
        found = [r["time"] for r in records.get((name, method), ())]
        if not found or any(time["fetches"] is None for time in found):
            return number(None)
        return ", ".join(number(mean([time[figure] for time in found])) for figure in ("fetches", "lobes"))

    rows = []
    for method in study.methods:
        seconds, found = study.bakes.get(method), records.get((study.used[0], method))
        rows.append([f"`{method}`", number(seconds and mean(seconds)), number(seconds and max(seconds)),
                     number(found and found[0]["precompute"]["bytes"] / 2**20), *(work_of(name, method) for name in study.used)])
    return ("## Bakes, memory and work per pixel\n\nBakes have the mean and the most over the scenes. The columns of "
            f"filters have texture lookups and lobes per pixel of `{study.cost}`, means over its distances.\n\n" +
            table(["method", "bake, s", "most", "MiB"] + code(study.used), rows))


def flicker_part(study):
    head = "## Flicker\n\n"
    if not study.flicker:
        return head + f"Not run: `{study.flickering}`."
    results = next(iter(study.of(study.flickering).values()))
    distances = [r["distance"] for r in results["records"]]
    used = [f for f in study.filters if any(f == name for name, _ in study.flicker)]
    rows = [[f"`{method}`"] + [number(study.flicker.get((name, method), [None])[0]) for name in used]
            for method in study.methods]
    floor = max(floor for _, floor in study.flicker.values())
    return (head + f"[Flicker](../reference/metrics.md) of `{results['scene']['name']}` from distance {number(min(distances))} to "
            f"{number(max(distances))}, mean over frames. The reference's noise makes at most {number(floor)} of it.\n\n" +
            table(["method"] + code(used), rows))


def scenes_part(study):
    rows = []
    for scene, d in [(scene, d) for scene in study.scenes for d in study.distances]:
        here = [p for p in study.points if (p.scene, p.distance) == (scene, d)]
        front = front_of([(study.costs[name, method][0], p.error, name, method) for name in study.used
                          for method in study.methods
                          if (p := study.get(scene, name, method, d)) and (name, method) in study.costs])
        if front:
            rows.append([f"`{scene}`", number(d), number(next((p.width for p in here if p.width), None)),
                         number(max(p.floor for p in here)),
                         "; ".join(f"`{e[3]}` {e[2]} {number(e[0])}: {number(e[1])}" for e in front)])
    return ("## Fronts by scene\n\nAn entry of a front is method, filter, frames of `direct`: error. Width is the "
            "texels along a pixel's footprint if the map covers the object once (one material). Floor is the error from the "
            "reference's noise.\n\n" +
            table(["scene", "distance", "width", "floor", "front"], rows))


def steps_of(study, before, after, distances):
    """The points of `before` and `after`, each (filter, method), at the same place of the whole scenes."""
    pairs = [(study.get(scene, *before, d), study.get(scene, *after, d)) for scene in study.whole for d in distances]
    return [(a, b) for a, b in pairs if a and b]


def ratios(study, before, after, distances, field="error"):
    """field(after) / field(before) over the whole scenes."""
    return [getattr(b, field) / getattr(a, field) for a, b in steps_of(study, before, after, distances)
            if getattr(a, field) and getattr(b, field)]


def prices_part(study):
    first, rows = study.used[0], []
    steps = [((first, a), (first, b), f"{words} (`{a}` to `{b}`), `{first}`") for a, b, words in STEPS]
    steps += [((first, m), (f, m), f"`{f}` for `{first}`, `{m}`") for m in PROBED for f in study.used[1:]]
    for before, after, words in steps:
        by_distance = [ratios(study, before, after, [d]) for d in study.distances]
        if before not in study.costs or after not in study.costs or not all(by_distance):
            continue
        some, other = steps_of(study, before, after, study.distances)[0]
        factors = [study.costs[after][0] / study.costs[before][0], other.bytes / some.bytes if some.bytes else None]
        rows.append([words] + [f"×{number(factor)}" if factor is not None else "n/a" for factor in factors] +
                    ["×" + spread(values) for values in by_distance])
    return ("## Price list\n\nEach step multiplies time, memory and error.\n\n" +
            table(["step", "time", "bytes"] + [f"error at {number(d)}" for d in study.distances], rows))


def kernel_finding(study):
    """Whether the filter's kernel causes more error than the method, by method."""
    name, lines, above = study.used[0], [], {}
    for method in study.methods:
        shares = [p.by_filter / p.by_method for p in study.points
                  if (p.filter, p.method) == (name, method) and p.by_filter and p.by_method]
        if not shares or method == "direct":
            continue
        lines.append([f"`{method}`", f"{sum(share > 1 for share in shares)} of {len(shares)}", spread(shares)])
        if method not in UP_TO_LEAN:
            above[method] = geometric_mean(shares)
    less = code(m for m, ratio in above.items() if ratio <= 1.0)
    return ("### Does the kernel cost more than the NDF's form?\n\nThe table counts scenes and distances under "
            f"`{name}` where `error.filter` is above `error.method` (at least 0.001).\n\n" +
            table(["method", "kernel costs more", "filter / method"], lines) + "\n\n"
            "- The kernel costs more for every method above LEAN (of more than one lobe), by the geometric mean: " +
            (f"refuted by {', '.join(less)}" if less else "confirmed") + ".")


def duel_finding(study):
    """A cheap method shaded at 2 x 2 against a better one with one lookup, by the footprint's width."""
    cheap, better = ("shaded:2", "toksvig"), (study.used[0], "tan_gmm")
    text = "### A cheap method shaded twice each way, or a better NDF under one lookup?\n\n"
    if cheap not in study.costs or better not in study.costs:
        return text + "Not decided: one of the two was not run."
    text += ("The table has the error over that of `toksvig` under `shaded:2`, by width of the footprint. Below 1 the better "
             f"NDF wins. `toksvig` costs {number(study.costs[cheap][0])} frames of `direct`. Under `{study.used[0]}`, `tan_gmm` costs "
             f"{number(study.costs[better][0])} and `cells` {number(study.costs[study.used[0], 'cells'][0])}.\n\n")
    rivals = [better, (study.used[0], "cells")] + [(f, "cells") for f in study.used[1:] if f != cheap[0]]
    cases = [p for p in study.points if (p.filter, p.method) == cheap]

    def against(rival, points):
        return [r.error / p.error for p in points if (r := study.get(p.scene, *rival, p.distance))]

    groups = {width: [p for p in cases if p.width and width[0] <= p.width < width[1]] for width in WIDTHS}
    rows = [[f"{low} to {high}" if high < 1e9 else f"{low} and more", str(len(found))] +
            [spread(values) if (values := against(rival, found)) else "n/a" for rival in rivals]
            for (low, high), found in groups.items() if found]
    rows.append(["ahead", ""] + [stays_ahead([(low, geometric_mean(values)) for (low, _), found in groups.items()
                                              if (values := against(rival, found))]) for rival in rivals])
    text += table(["width, texels", "cases"] + [f"`{m}`, `{f}`" for f, m in rivals], rows)
    if both := against(better, cases):
        text += (f"\n\n- `toksvig` is ahead of `tan_gmm` in {sum(ratio > 1.0 for ratio in both)} of {len(both)} scenes and "
                 f"distances; by the mean ratio, {spread(both)}, it is {'ahead' if geometric_mean(both) > 1.0 else 'behind'}.")
    return text


def stays_ahead(by_width):
    """The width from which a rival stays ahead."""
    start = None
    for low, ratio in by_width:
        start = (low if start is None else start) if ratio < 1.0 else None
    if start is None:
        return "no width"
    return "every width" if start == by_width[0][0] else f"from {start}"


def aims_finding(study):
    """Our methods against `tan_gmm` under the same filter, and against the fronts of others."""
    far = study.distances[1:] or study.distances
    lines, met = [], []
    for method, name in [(m, name) for m in study.methods if m.startswith(OURS) for name in study.used]:
        own = ratios(study, (name, "tan_gmm"), (name, method), far, "by_method")
        if own and (name, method) in study.costs:
            time = study.costs[name, method][0] / study.costs[name, "tan_gmm"][0]
            lines.append([f"`{method}`", f"`{name}`", spread(own), number(time)])
            met += [f"`{method}` under `{name}`"] if geometric_mean(own) <= 0.6 and time <= 1.0 else []
    text = ("### Our own against `tan_gmm` and the front\n\nThe table compares with `tan_gmm` under the same filter, over "
            "the middle and far distances, by `error.method` (at least 0.001) and time. The aims are 0.6 and 1 times "
            "`tan_gmm`.\n\n" + table(["method", "filter", "error.method", "time"], lines))
    text += "\n\n- Both aims are met by " + (", ".join(met) if met else "none") + "."
    best = (best_of_ours(study, UNPUBLISHED, "published methods, plain supersampling") +
            best_of_ours(study, OURS, "the same and `tan_gmm:covariance=full`"))
    if best:
        text += ("\n\nOur lowest error is relative to the front at the same cost, between 1.5 and 8 times `direct`, over these "
                 f"distances. The front is interpolated in logarithms. The aim is {AIM}.\n\n") + table(["front", "method", "filter", "cost", "error"], best)
    return text


def best_of_ours(study, without, first, costs=None):
    """A row with the lowest error of our methods relative to a front over all filters at the same cost; none without one."""
    far = study.distances[1:] or study.distances
    front = front_of(study.entries(far, without, costs))
    best = [(error / error_on_front(front, cost), cost, name, method)
            for cost, error, name, method in study.entries(far, costs=costs)
            if method.startswith(OURS) and 1.5 <= cost <= 8.0 and error_on_front(front, cost)]
    if not best:
        return []
    ratio, cost, name, method = min(best)
    return [[first, f"`{method}`", f"`{name}`", number(cost), f"{number(ratio)}, {'met' if ratio <= AIM else 'missed'}"]]


def exact_finding(study):
    """The closest methods below 8 frames of `direct`, next to exact filtering and the kernels alone."""
    text = "### How far from exact?\n\n"
    records = records_of(study.of(study.bound))
    errors_of = grouped((key, r["error"]["shading"]) for key, r in records)
    methods = {key: geometric_mean(errors) for key, errors in errors_of.items()}
    least = min((error for (_, method), error in methods.items() if method == EXACT), default=None)
    if least is None:
        return text + f"Not run: `{study.bound}`."
    filter_errors = {(name, r["distance"]): r["error"]["filter"] for (name, _), r in records if r["error"]["filter"]}
    kernels = {name: geometric_mean(errors) for name, errors in
               grouped((name, error) for (name, _), error in filter_errors.items()).items() if name in study.used}
    rows, found = [], []
    for name in [f for f in study.used if f in kernels]:
        error, frames, method = min(((error, study.costs[key][0], key[1]) for key, error in methods.items()
                                     if key[0] == name and key in study.costs and study.costs[key][0] < 8.0), default=(None,) * 3)
        found += [error / least] if method else []
        rows.append([f"`{name}`", number(kernels[name]), number(kernels[name] / least),
                     *([f"`{method}`, {number(frames)}", number(error), number(error / least)] if method else ["n/a"] * 3)])
    kernel = min(kernels.values()) / least
    results = next(iter(study.of(study.bound).values()))
    text += (f"`{EXACT}`, the true distribution over each pixel's parallelogram, leaves {number(least)} on "
             f"`{results['scene']['name']}` against {results['reference']['spp']} samples per pixel (geometric mean over "
             "distances). The table has each filter's kernel with the true distribution, and the closest method below 8 frames of "
             "`direct`.\n\n" +
             table(["filter", "kernel alone", "of exact", "closest, frames", "error", "of exact"], rows))
    if found:
        text += (f"\n\n- The closest is {number(min(found))} times as far off as exact filtering (the aim is 2)." + (
                 f" No form of the distribution can meet the aim, because the kernels alone are {number(kernel)} times off."
                 if kernel > 2.0 else ""))
    return text


def picture(study, file):
    """An SVG of all entries over all distances and of their front."""
    entries = study.entries(study.distances)
    chart = LogChart([entry[:2] for entry in entries], ("frames of direct", "error of shading"),
                     ((1, 2, 4, 8, 16, 32, 64), (0.01, 0.02, 0.03, 0.05, 0.07, 0.1, 0.15, 0.2, 0.3)))
    colours = dict(zip(["-", *study.filters], [palette()[-1], *palette()]))
    front = front_of(entries)
    chart.add_line([entry[:2] for entry in front], "black")
    for cost, error, name, method in entries:
        chart.add_point((cost, error), colours.get(name, "black"), 5 if method.startswith(OURS) else 3,
                        f"{method} {name} {number(cost)}: {number(error)}",
                        method.replace(PLAIN, "plain") if (cost, error, name, method) in front else "")
    chart.add_legend({name if name != "-" else PLAIN: colours.get(name, "black") for name in ["-", *study.used]})
    chart.write(file)


def document(study, svg, note):
    parts = [head_part(study, " " + note if note else "")]
    if svg:
        parts.append(f"![Error against time, all scenes and distances](../images/{svg.name})\n*Every method under every filter. "
                     "The line is the front; large dots are our own.*")
    parts += [fronts_part(study), gpu_part(study), all_part(study), work_part(study), flicker_part(study), prices_part(study),
              "## Findings", kernel_finding(study), duel_finding(study), aims_finding(study), exact_finding(study),
              scenes_part(study)]
    return wrapped("\n\n".join(parts)) + "\n"


def main():
    arguments = parser_of(__doc__, "results", "--run", "--quick", "--footprint", "--svg", "--note").parse_args()
    experiments = QUICK if arguments.quick else EXPERIMENTS
    if arguments.run:
        run_missing(arguments.results, experiments, arguments.footprint)
    study = Study(arguments.results, experiments)
    if arguments.svg:
        picture(study, arguments.svg)
    sys.stdout.write(document(study, arguments.svg, arguments.note))
    return 0


if __name__ == "__main__":
    sys.exit(reported("accuracy_vs_time", main))
