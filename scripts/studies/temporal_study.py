#!/usr/bin/env python3
"""Compares prefiltering with temporal accumulation, still and in motion, and prints docs/results/temporal-study.md.

  scripts/studies/temporal_study.py RESULTS --run         # runs everything that RESULTS lacks, then prints the page
  scripts/studies/temporal_study.py RESULTS --run --quick # one scene, still and fast, four frames: tests the script, measures nothing

A run is an animation of a scene along a path at a speed and a distance, under a footprint filter, of every method with and
without histories. Depths of stochastic footprints and frame times have runs of their own. The results of a run are
RESULTS/KIND/SCENE/.../results.json. An interrupted run resumes. Speeds are the mean over the surface, in pixels per
frame. The page depends only on the results that are there. Exit code 1 if there are none, or if a run fails.
--svg FILE also draws bias against noise over the depths.
"""
import math
import sys

from study import (ROOT, LogChart, Missing, code, colours_of, geometric_mean, grouped, load_results, load_toml, mean, number,
                   parser_of, reported, run_footprint, table, wrapped)

SCENES = ("scales", "carved_disk")
METHODS = ("direct", "toksvig", "lean", "tan_gmm:n=4", "cells:k=4")
FILTERS = ("trilinear", "anisotropic:8", "stochastic:1", "stochastic:1:2", "stochastic:1:1")
CHEAP = "roughness_bake"  # what engines ship, only a level below the draw (the last filter)
# Options of a method. 24 frames with alpha 0.1 have 0.92 of a history's weights: what is left of the first frame is 0.08.
HISTORY = ":history=24"
STILL = ":history_jitter=off"  # a stochastic kernel covers the pixel already
VARIANCE = ":history_clamp=variance"
HISTORIES = {"none": "", "jitter": HISTORY, "jitter, box": HISTORY + ":history_clamp=box", "jitter, variance": HISTORY + VARIANCE,
             "no jitter": HISTORY + STILL, "no jitter, variance": HISTORY + STILL + VARIANCE}
SPEEDS = (0.1, 0.5, 1, 2, 4, 8)
SLOW_ZOOM = 1.02  # over all frames, at DISTANCE
UNORDERED = ("slow zoom", "light")  # paths without a speed
SIZE, FRAMES, SPP = 128, 8, 64
DISTANCE = 2
DISTANCES = (0.5, 1, DISTANCE, 4, 8)  # the others have the first three filters
DEPTHS = {"0": "stochastic:1:0", "1": "stochastic:1:1", "2": "stochastic:1:2", "3": "stochastic:1:3", "4": "stochastic:1:4",
          "none": "stochastic:1"}
# The mean of the draws: with independent draws it has 1/200 of their variance, and 0.006 of the first frame.
MEAN = ":history=512:history_alpha=0.01" + STILL
COSTED = ("none", "jitter", "jitter, variance")
NORMAL = "0,0,1"  # of both scenes: a camera that turns about it moves the surface in its plane


def pixels_per_radian(distance):
    """The mean over the visible surface of the distance from the image's middle, in pixels: 2/3 of a disk's radius, which is
    half the image at distance 1, and at most the mean over the image, 0.3826 of its width."""
    return SIZE * min(1 / (3 * distance), 0.3826)


def paths(distance, quick):
    """{name: options of animate}."""
    frames = 4 if quick else FRAMES
    found = {"still": ("--path", "zoom", "--from", distance, "--to", distance * 1.000001, "--frames", frames)}
    for speed in SPEEDS[-1:] if quick else SPEEDS:
        turn = math.degrees(speed / pixels_per_radian(distance)) * (frames - 1)
        found[f"{speed:g}"] = ("--path", "orbit", "--axis", NORMAL, "--degrees", f"{turn:.4f}", "--distance", distance, "--frames", frames)
    if not quick and distance == DISTANCE:
        found["slow zoom"] = ("--path", "zoom", "--from", distance, "--to", SLOW_ZOOM * distance, "--frames", frames)
    if not quick:
        found["light"] = ("--path", "light", "--degrees", 3 * (frames - 1), "--distance", distance, "--frames", frames)
    return found


def folder_of(results, key):
    return results.joinpath(*(str(part).replace(":", "_").replace(" ", "_") for part in key))


def variants(histories, methods=(*METHODS, CHEAP)):
    """{method of a run: (method, its history)}."""
    return {method + options: (method, history) for method in methods for history, options in histories.items()}


def runs(quick):
    """{("speeds", scene, distance, path, filter), ("depths", scene, depth) or ("costs", filter): words of the command}."""
    scenes, depths, filters = (SCENES[:1], ["0", "none"], FILTERS[:3:2]) if quick else (SCENES, DEPTHS, FILTERS)
    methods = METHODS[:2] if quick else METHODS
    histories = {name: HISTORIES[name] for name in list(HISTORIES)[:2 if quick else None]}
    found = {}

    def add(*key, command, shown, filter_name, spp, bound, more):
        found[key] = (*command, "--methods", ",".join(shown), "--footprint", filter_name, "--spp", spp, "--bound", bound, *more)

    for scene in scenes:
        command = ("animate", scene, "--size", f"{SIZE}x{SIZE}")
        for distance in (DISTANCE,) if quick else DISTANCES:
            for path, options in paths(distance, quick).items():
                for filter_name in filters if distance == DISTANCE else filters[:3]:
                    shown = (*methods, CHEAP) if filter_name == FILTERS[-1] else methods
                    add("speeds", scene, distance, path, filter_name, command=command, shown=variants(histories, shown), filter_name=filter_name,
                        spp=16 if quick else SPP, bound="on" if distance == DISTANCE and ":1" not in filter_name else "off", more=options)
        for depth in depths:
            add("depths", scene, depth, command=command, shown=variants({"": "", "mean": HISTORY if quick else MEAN}, methods),
                filter_name=DEPTHS[depth], spp=16 if quick else 16 * SPP, bound="off", more=paths(DISTANCE, quick)["still"])
    for filter_name in filters[:3]:
        add("costs", filter_name, command=("compare", SCENES[-1], "--size", "64x64" if quick else "512x512"),
            shown=variants({name: HISTORIES[name] for name in COSTED}, methods), filter_name=filter_name, spp=2, bound="off",
            more=("--time-unit", "trilinear", "--distance", 1, "--repeats", 2 if quick else 20))
    return found


def run_all(results, quick, program):
    for key, words in runs(quick).items():
        folder = folder_of(results, key)
        if not (folder / "results.json").is_file():
            print(folder.relative_to(results), file=sys.stderr)
            run_footprint(*words, "-q", "-o", folder, program=program, cache=results / "cache")


def flicker_of(record, cause):
    """Mean flicker by a cause; None where it was not measured."""
    found = record["flicker"] and record["flicker"][cause]
    return found["mean"] if isinstance(found, dict) else found


# What a table can show of an animation: a value of each record, or None where it has none.
FIGURES = {
    "error": lambda r: r["error"]["shading"],
    "flicker": lambda r: flicker_of(r, "mean"),
    "filter": lambda r: flicker_of(r, "filter"),
    "method": lambda r: flicker_of(r, "method"),
    "ghosting": lambda r: flicker_of(r, "ghosting"),
    "highlights": lambda r: r["highlight_energy"] / r["reference_highlight_energy"] if r["reference_highlight_energy"] else None,
}


class Study:
    """The mean of every figure over the frames: {(figure, distance, path, filter, history, method): {scene: value}}."""

    def __init__(self, results):
        self.runs = {key: load_results(file) for key in runs(False) if (file := folder_of(results, key) / "results.json").is_file()}
        self.found = {}
        self.texels = {}  # {distance: {scene: texels per pixel, along an edge}}
        known = variants(HISTORIES)
        for (_, scene, *key), run in ((key, run) for key, run in self.runs.items() if key[0] == "speeds"):
            for variant, records in grouped((r["method"], r) for r in run["records"]).items():
                method, history = known[variant]
                for figure, value_of in FIGURES.items():
                    values = [v for v in map(value_of, records) if v is not None]
                    if values:
                        self.found.setdefault((figure, *key, history, method), {})[scene] = mean(values)
            if key[0] == DISTANCE:
                texels = load_toml(ROOT / "scenes" / scene / "scene.toml")["surface"]["resolution"] ** 2
                for distance in DISTANCES:
                    self.texels.setdefault(distance, {})[scene] = distance / DISTANCE * math.sqrt(
                        texels / run["records"][0]["pixels"]["object"])

    def value(self, figure, *key):
        """Geometric mean over the scenes; None if no scene has it."""
        by_scene = self.found.get((figure, *key))
        return geometric_mean(list(by_scene.values())) if by_scene else None

    def cells(self, columns, *key):
        """The values of (figure, path) at DISTANCE."""
        return [number(self.value(figure, DISTANCE, path, *key)) for figure, path in columns]

    def paths(self, distance=DISTANCE):
        return [path for path in paths(distance, False) if any(key[:3] == ("error", distance, path) for key in self.found)]

    def distances(self):
        return [distance for distance in DISTANCES if self.paths(distance)]

    def rows(self, filters=FILTERS, path=None):
        """(filter, history, method) of everything measured at DISTANCE (along a path)."""
        return [(f, h, m) for m in (*METHODS, CHEAP) for f in filters for h in HISTORIES
                if any(key[:2] == ("error", DISTANCE) and key[3:] == (f, h, m) and path in (None, key[2]) for key in self.found)]


def titled(path):
    return path if path in ("still", *UNORDERED) else f"{path} px"


def speed_table(study, figure, filters=FILTERS, columns=None):
    """A table with a column per path (None: all) and a row per method, filter and history."""
    columns = columns or study.paths()
    body = [[*code((method, filter_name)), history, *study.cells([(figure, path) for path in columns], filter_name, history, method)]
            for filter_name, history, method in study.rows(filters)]
    return table(["method", "filter", "history", *map(titled, columns)], body)


def best_part(study):
    """The best configuration at each speed, with and without a history."""
    rows = []
    for path in study.paths():
        by_error = sorted((study.value("error", DISTANCE, path, *row), row) for row in study.rows(path=path))
        single, history = (next(((error, row) for error, row in by_error if (row[1] == "none") == alone), None) for alone in (True, False))
        if single and history:
            rows.append([path, f"`{single[1][2]}`, `{single[1][0]}`", number(single[0]),
                         f"`{history[1][2]}`, `{history[1][0]}`, {history[1][1]}", number(history[0])])
    return "## The best at each speed\n\n" + table(["pixels per frame", "single frames", "error", "history", "error"], rows)


def crossing(study, distance, one, other):
    """In words, from which speed on `one` (filter, history, method) has more error than `other`."""
    last = None
    for path in (path for path in study.paths(distance) if path not in UNORDERED):
        a, b = (study.value("error", distance, path, *key) for key in (one, other))
        if a is None or b is None:
            continue
        if a > b:
            return f"{last} to {path}" if last else "always"
        last = path
    return "never" if last else "n/a"


def crossings_part(study):
    histories = (("trilinear", "jitter"), ("trilinear", "jitter, variance"), ("stochastic:1", "no jitter"),
                 ("stochastic:1", "no jitter, variance"))
    rivals = [(prefiltered, method) for prefiltered in ("trilinear", "anisotropic:8") for method in METHODS[1:]]
    rows = []
    for distance in study.distances():
        texels = " and ".join(number(study.texels[distance][scene], 2) for scene in SCENES if scene in study.texels[distance])
        rows += [[texels, f"`{filter_name}`, {history}", *(
            crossing(study, distance, (filter_name, history, "direct"), (prefiltered, "none", method)) for prefiltered, method in rivals)]
                 for filter_name, history in histories if distance == DISTANCE or "variance" not in history]
    return ("## Where prefiltering pays\n\nAbove these pixels per frame, single frames of a method beat a history of `direct`. "
            f"The first column has the texels along a pixel's edge ({', '.join(SCENES)}).\n\n" +
            table(["texels", "history of `direct`", *(f"`{method}`, `{prefiltered}`" for prefiltered, method in rivals)], rows))


def root_of_difference(whole, part):
    return math.sqrt(max(whole ** 2 - part ** 2, 0))


def depths_of(study):
    """{method: {depth: (bias, noise, error of one frame, error of the mean)}}, geometric means over the scenes."""
    figures = {}  # by depth and method of a run: one pair per scene
    for (kind, *key), run in study.runs.items():
        for variant, records in grouped((r["method"], r["error"]) for r in run["records"]).items() if kind == "depths" else ():
            rmse = math.sqrt(mean([error["relative_rmse"] ** 2 for error in records]))
            figures.setdefault((key[1], variant), []).append((rmse, mean([error["shading"] for error in records])))
    found = {method: {} for method in METHODS}
    for method in METHODS:
        for depth in DEPTHS:
            single = figures.get((depth, method), [])
            average = next((v for (d, name), v in figures.items() if d == depth and name.startswith(method + ":history")), [])
            if single and len(single) == len(average):
                noises = [root_of_difference(one[0], many[0]) for one, many in zip(single, average)]
                biases, means = zip(*average)
                found[method][depth] = [geometric_mean(list(v)) for v in (biases, noises, [v[1] for v in single], means)]
    return {method: by_depth for method, by_depth in found.items() if by_depth}


def depths_part(study, svg):
    found = depths_of(study)
    depths = [depth for depth in DEPTHS if any(depth in by_depth for by_depth in found.values())]
    rows = [[f"`{method}`", name, *(number(by_depth.get(depth, [None] * 4)[i]) for depth in depths)]
            for method, by_depth in found.items() for i, name in enumerate(("bias", "noise", "error of a frame", "error of the mean"))]
    shown = f"![Bias against noise over the depths](../images/{svg.name})\n\n" if svg else ""
    return ("## Bias against noise\n\nThe filter is `stochastic:1:DEPTH`, the camera still. A draw covers 2⁻ᵈ of the footprint's "
            "edges at depth d, and a texel without a depth. Bias is the relative RMSE of the mean of 512 frames with alpha 0.01. "
            "Noise is √(e² − bias²), e the relative RMSE of one frame. Draws without a depth have no bias: theirs is the noise "
            "left in the mean.\n\n" + shown +
            table(["method", "depth", *depths], rows))


def drawn_depths(study, file, program):
    """The chart of bias against noise: a line per method, a point per depth."""
    found = {method: {depth: v[:2] for depth, v in by_depth.items() if min(v[:2]) > 0} for method, by_depth in depths_of(study).items()}
    ticks = [v * 10 ** e for e in range(-4, 2) for v in (1, 2, 3, 4, 5, 6, 8)]
    chart = LogChart([v for by_depth in found.values() for v in by_depth.values()],
                     ("bias: relative RMSE of the mean of all draws", "noise: relative RMSE of one draw about that mean"), (ticks, ticks))
    colours = colours_of(found, program)
    for method, by_depth in found.items():
        chart.add_line(list(by_depth.values()), colours[method])
        for depth, point in by_depth.items():
            chart.add_point(point, colours[method], title=f"{method}, depth {depth}", label=depth)
    chart.add_legend(colours)
    chart.write(file)


def causes_part(study):
    columns = [(cause, path) for path in ("1", "light") for cause in ("flicker", "filter", "method")]
    rows = [[*code((method, filter_name)), *study.cells(columns, filter_name, history, method)]
            for filter_name, history, method in study.rows(("trilinear", "anisotropic:8")) if history == "none"]
    return ("## Flicker by cause\n\nThe frames are single. Histories and stochastic footprints have no footprint filter, so their "
            "flicker is not split. All flicker is shading, because the images have no edges.\n\n" +
            table(["method", "filter", *(f"{titled(path)}: {cause}" for cause, path in columns)], rows))


def costs_part(study):
    rows = []
    for (kind, *key), run in study.runs.items():
        for record in run["records"] if kind == "costs" else ():
            method, history = variants(HISTORIES)[record["method"]]
            ratio = record["time"]["ratio_to_direct"]
            rows.append([*code((method, *key)), history, number(ratio["median"]), f"{number(ratio['low'])} to {number(ratio['high'])}"])
    return (f"## Cost per frame\n\nThe frame times of `{SCENES[-1]}` are relative to one of `direct` under `trilinear`. They were measured "
            "on llvmpipe at 512 x 512 pixels, with the pass of a moving camera: median and 95% interval.\n\n" +
            table(["method", "filter", "history", "frames", "interval"], rows))


def document(study, svg):
    scenes = sorted({scene for by_scene in study.found.values() for scene in by_scene})
    head = (f"# Prefiltering beside temporal accumulation\n\n`scripts/studies/temporal_study.py` prints this page. "
            f"[temporal.md](../explanation/temporal.md) has the formulas, [metrics.md](../reference/metrics.md) the measures. Scenes: "
            f"{', '.join(scenes)}; {SIZE} x {SIZE} pixels, {FRAMES} frames, references of {SPP} samples per pixel. The distance is "
            f"{DISTANCE} unless a table has texels per pixel. Histories have alpha 0.1 and 24 frames before the first one. Columns: a "
            "still camera; orbits in mean pixels per frame; a zoom by 2% over all frames; lights that turn 3 degrees per frame. "
            "Errors are shading errors. Values are means over the frames and geometric means over the scenes.")
    few = ("anisotropic:8", "stochastic:1")
    return wrapped("\n\n".join([
        head, best_part(study), crossings_part(study), depths_part(study, svg), costs_part(study),
        "## Error\n\n" + speed_table(study, "error"),
        causes_part(study),
        "## Flicker\n\n" + speed_table(study, "flicker", few),
        "## Ghosting\n\n" + speed_table(study, "ghosting", few, ["light"]),
        "## Energy of highlights over the reference's\n\n" + speed_table(study, "highlights", few)])) + "\n"


def main():
    arguments = parser_of(__doc__, "results", "--run", "--quick", "--footprint", "--svg").parse_args()
    if arguments.run:
        run_all(arguments.results, arguments.quick, arguments.footprint)
    study = Study(arguments.results)
    if not study.found:
        raise Missing(f"{arguments.results} has no results; make them with --run")
    if arguments.svg:
        drawn_depths(study, arguments.svg, arguments.footprint)
    sys.stdout.write(document(study, arguments.svg))
    return 0


if __name__ == "__main__":
    sys.exit(reported("temporal_study", main))
