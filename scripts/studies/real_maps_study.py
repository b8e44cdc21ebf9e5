#!/usr/bin/env python3
"""Runs the study on normal maps that others made, and prints its page (docs/results/real-maps-study.md).

  scripts/studies/real_maps.py MAPS                             # collects the maps and writes scenes and experiments
  scripts/studies/real_maps_study.py MAPS RESULTS --run         # runs every part that RESULTS lacks, then prints the page
  scripts/studies/real_maps_study.py MAPS RESULTS --quick --run # tests the machinery, under one filter: no measurement
  scripts/studies/real_maps_study.py MAPS RESULTS --lobes --run # breaks errors down into filter, lobes and fit (real-maps.md)

A part is an experiment MAPS/PART.toml; its results are RESULTS/PART/MEMBER/results.json. An interrupted run resumes. The
page depends only on the results that are there, and says how many maps each figure is of. With --keep PAGE, a half of it
(development or held-out maps) without any result stays as PAGE has it. Intervals are those of 95% of
2000 bootstraps over maps, from a fixed seed. --parts REGEX restricts what is run, --note is a sentence about the run. Exit
code 1 if there is no result, or if a part cannot be run.

With --lobes a part is a map for development, cut to its middle 128 x 128 texels, because `best_lobes` takes minutes for so
many, and repeated over its scene; RESULTS/MAP has the scene and its results. The table is of all results that are there.
"""
import math
import pathlib
import random
import re
import sys

from study import (OURS, UNPUBLISHED, Missing, costs_of, counted, geometric_mean, gpu_costs_of, grouped, load_results,
                   load_toml, mean, number, parser_of, reported, results_by_filter, results_in, run_command, run_footprint, table,
                   wrapped)

RESAMPLES, SEED = 2000, 1
UNIT = "direct"
MEAN = ":roughness_mean=concentration"
CLASSES = ("flat", "lines", "rare", "rough")
PARTS = {"development": "Maps for development", "held_out": "Held-out maps"}
# What a reader may ask: is the first better than the second?
DUELS = [("lean", "toksvig"), ("leadr", "lean"), ("roughness_bake", "toksvig"), ("specular_aa:preset=filament", "naive_mip"),
         ("roughness_bake", "roughness_bake:preset=filament"), ("tan_gmm:n=4", "lean"), ("tan_gmm:n=8", "tan_gmm:n=4"),
         ("xu_vmf:j=8", "tan_gmm:n=8"), ("fournier", "tan_gmm:n=8"), ("tan_gmm:n=4:covariance=full", "tan_gmm:n=8"),
         ("cells:k=4", "tan_gmm:n=4"), ("cells:k=4", "tan_gmm:n=4" + MEAN), ("tan_gmm:n=4" + MEAN, "tan_gmm:n=4"), ("cells:k=4", "tan_gmm:n=5"), ("cells:k=6", "tan_gmm:n=8"),
         ("ndf_atlas", "tan_gmm:n=8"), ("lean:storage=fp16", "lean")]

BOUNDED = ("toksvig", "lean", "tan_gmm:n=2", "tan_gmm:n=4", "tan_gmm:n=8", "cells:k=4", "ndf_atlas", "fournier")
CUT = 128  # texels
BOUND = "best_lobes:k=4"
BELOW = ("tan_gmm:n=4", "cells:k=4", "fournier:peaks=4")  # methods of as many lobes


def plain(key):
    """The same configuration with the default mean of roughnesses: it costs as much, and where no roughness varies it is
    the same."""
    return (key[0], key[1].replace(MEAN, ""), *key[2:])


class Form:
    """The errors of the scenes of a form (main, alpha, sky, storage) in a part."""

    def __init__(self, runs, filters, map_of):
        self.errors = {}  # {(filter, method): {map: {number of a distance: [error of each scene]}}}
        self.own = {}  # {(filter, method): {map: [(error of the filter, of the method)]}}
        self.bytes = {}
        self.renderers = {results["backend"]["renderer"] for results in runs}
        for results in runs:
            entry = map_of[results["scene"]["name"]]
            distances = sorted({r["distance"] for r in results["records"]})
            for r in (r for r in results["records"] if r["error"] and r["error"]["shading"]):
                key, error, at = (results["footprint"], r["method"]), r["error"], distances.index(r["distance"])
                self.errors.setdefault(key, {}).setdefault(entry["name"], {}).setdefault(at, []).append(error["shading"])
                self.bytes.setdefault(r["method"], []).append(r["precompute"]["bytes"] / math.prod(entry["size"]))
                if error["filter"] and error["method"]:
                    self.own.setdefault(key, {}).setdefault(entry["name"], []).append((error["filter"], error["method"]))
        constant = {entry["name"] for entry in map_of.values() if not entry["gloss"]}
        for by_key in (self.errors, self.own):
            for key in (key for key in by_key if key != plain(key)):
                by_key[key] |= {name: values for name, values in by_key[plain(key)].items() if name in constant}
        self.bytes |= {method: self.bytes[method.replace(MEAN, "")] for method in self.bytes}
        self.filters = [name for name in filters if any(name == found for found, _ in self.errors)]
        self.methods = list(dict.fromkeys(method for _, method in self.errors))

    def maps(self, *filters):
        """The maps that every method has errors of under each of the filters; without one, under the first."""
        found = [set(by_map) for (name, _), by_map in self.errors.items() if name in (filters or self.filters[:1])]
        return sorted(set.intersection(*found)) if found else []

    def error(self, key, name, at=None):
        """At a distance, or the geometric mean over all."""
        return geometric_mean([error for i, errors in self.errors[key][name].items() if at in (None, i) for error in errors])

    def parts(self, key, maps):
        """What the filter and the method alone cause, each over the error of UNIT under the first filter."""
        return [geometric_mean([geometric_mean(part) / self.error((self.filters[0], UNIT), name) for name, part in zip(maps, parts)])
                for parts in zip(*(zip(*self.own[key][name]) for name in maps))]

    def ratios(self, one, other, maps, at=None):
        """{map: error of `one` over that of `other`}; each is (filter, method)."""
        return {name: self.error(one, name, at) / self.error(other, name, at) for name in maps
                if all(at in (None, *self.errors.get(key, {}).get(name, ())) and name in self.errors.get(key, {}) for key in (one, other))}

    def over_unit(self, key, maps, at=None):
        """The geometric mean over maps of a configuration's error over that of UNIT under the first filter; None without a map."""
        found = self.ratios(key, (self.filters[0], UNIT), maps, at)
        return geometric_mean([*found.values()]) if found else None


def interval_text(ratios):
    """Geometric mean, and the 95% interval of its bootstrap over maps."""
    logs, draw = [math.log(r) for r in ratios], random.Random(SEED)
    means = sorted(mean(draw.choices(logs, k=len(logs))) for _ in range(RESAMPLES))
    middle, low, high = (number(math.exp(v)) for v in (mean(logs), means[int(0.025 * RESAMPLES)], means[int(0.975 * RESAMPLES)]))
    return f"{middle} ({low} to {high})"


def starred(method):
    return f"`{method}`" + (" *" if method.startswith(UNPUBLISHED) else "")


def all_part(form):
    first = form.filters[0]
    counts = {name: form.maps(first, name) for name in form.filters}
    rows = []
    for method in sorted(form.methods, key=lambda m: form.over_unit((first, m), counts[first])):
        rows.append([starred(method), number(geometric_mean(form.bytes[method])),
                     interval_text(form.ratios((first, method), (first, UNIT), counts[first]).values()),
                     *(number(form.over_unit((name, method), counts[name])) for name in form.filters[1:])])
    titles = [f"`{name}`, {counted(counts[name])}" for name in form.filters]
    return (f"### Every method under every filter\n\nErrors are over that of `{UNIT}` under `{first}` on the same map. "
            "Bytes are those of all levels per texel of the finest.\n\n" +
            table(["method", "bytes", *titles], rows))


def bounds_part(form):
    """What the footprint filters alone lose, and so what is left for any representation to gain."""
    first, rows = form.filters[0], []
    for name in form.filters:
        maps = [m for m in form.maps(first, name) if all(m in form.own.get((name, method), {}) for method in BOUNDED)]
        if maps:
            alone = form.parts((name, UNIT), maps)[0]
            rows.append([f"`{name}`, {counted(maps)}", number(alone)] + [
                f"{number(form.parts((name, method), maps)[1])}; {number(alone / form.over_unit((name, method), maps))}" for method in BOUNDED])
    return ("### What no representation can beat\n\nThe second column is the error of the filter with exact lobes, over that of "
            f"`{UNIT}` under `{first}`. A method's cell has its own part of the error, then the ratio of that filter's error to "
            "the method's. At equal cost, no method can have a smaller ratio.\n\n" +
            table(["filter", "filter alone", *(starred(m) for m in BOUNDED)], rows))


def duels_part(form):
    first = form.filters[0]
    lines = []
    for one, other in DUELS:
        ratios = form.ratios((first, one), (first, other), form.maps())
        if ratios:
            against = sum(ratio > 1.0 for ratio in ratios.values())
            lines.append(f"- `{one}` has {interval_text(ratios.values())} of the error of `{other}`; `{other}` is better on "
                         f"{against} of {counted(ratios)}.")
    return f"### Pairs\n\nUnder `{first}`, all distances.\n\n" + "\n".join(lines)


def groups_part(title, groups, methods):
    """A table of errors over UNIT, by groups of (name, form, maps, the number of a distance)."""
    first = groups[0][1].filters[0]
    rows = [[starred(method)] + [number(form.over_unit((first, method), maps, *distance)) for _, form, maps, *distance in groups]
            for method in methods]
    return (f"### {title}\n\nErrors are over that of `{UNIT}` under `{first}`.\n\n" +
            table(["method", *(f"{name}, {counted(maps)}" for name, _, maps, *_ in groups)], rows))


def class_of(entry):
    return "with a gloss map" if entry["gloss"] else entry["class"]


def by_class(maps, wanted):
    """{class: the names of its maps among the wanted ones}; those with a gloss map are also a class."""
    known = [entry for entry in maps if entry["name"] in wanted]
    groups = {name: [entry["name"] for entry in known if entry["class"] == name] for name in CLASSES}
    groups["with a gloss map"] = [entry["name"] for entry in known if entry["gloss"]]
    return {name: found for name, found in groups.items() if found}


def entries_of(form, costs, maps):
    """(cost, error, bytes, filter, method) of every configuration, over maps that have every filter."""
    return [(costs[plain(key)][0], form.over_unit(key, maps), geometric_mean(form.bytes[key[1]]), *key)
            for key in form.errors if plain(key) in costs] if maps else []


def is_beaten(entry, others):
    return any(all(b <= a for a, b in zip(entry[:3], other[:3])) and other[:3] != entry[:3] for other in others)


def best_own(entries):
    """(factor, ours, theirs): the best of ours against what is published, at equal cost and bytes or less; or None."""
    published = [e for e in entries if not e[4].startswith(UNPUBLISHED)]
    found = []
    for own in (e for e in entries if e[4].startswith(OURS)):
        rivals = [e for e in published if e[0] <= own[0] and e[2] <= own[2]]
        if rivals:
            best = min(rivals, key=lambda e: e[1])
            found.append((own[1] / best[1], own, best))
    return min(found, default=None)


def own_finding(form, costs, maps, glossy):
    """The best of ours over all maps, and over those with and without a gloss map."""
    over = {name: best_own(entries_of(form, costs, some)) for name, some in (
        ("all", maps), ("with", [m for m in maps if m in glossy]), ("without", [m for m in maps if m not in glossy])) if some}
    if not over["all"]:
        return ""
    factor, own, best = over["all"]
    text = (f"\n\n- The best of ours, `{own[4]}` under `{own[3]}`, has {number(factor)} of the error of the best published method "
            f"within its cost and bytes: `{best[4]}` under `{best[3]}`.")
    halves = [f"{number(over[name][0])} on maps {name} a gloss map" for name in ("with", "without") if over.get(name)]
    return text + (f" The best of ours has {' and '.join(halves)}." if len(halves) == 2 else "")


def storages_part(form):
    """What a storage costs in error: per map, over that of the same method with 32-bit floats."""
    first, rows = form.filters[0], []
    for method in (m for m in form.methods if ":storage=" in m):
        base, storage = method.split(":storage=")
        ratios = list(form.ratios((first, method), (first, base), form.maps()).values())
        rows.append([f"`{base}`", f"`{storage}`", number(geometric_mean(form.bytes[method])), interval_text(ratios), number(max(ratios))])
    return (f"### Storages\n\nError with a smaller storage over that with 32-bit floats, under `{first}`, "
            f"{counted(form.maps())}.\n\n" + table(["method", "storage", "bytes", "error", "of the worst map"], rows))


def fronts_part(form, costs_by_unit, glossy):
    whole = form.maps(*form.filters)
    text = (f"### Fronts of error, cost and bytes\n\nNo other configuration beats these in all three; {len(whole)} maps have every "
            f"filter. Cost and error are over those of `{UNIT}` under `{form.filters[0]}`; `*` is unpublished.")
    for unit, costs in costs_by_unit.items():
        entries = entries_of(form, costs, whole)
        if not entries:
            return text + "\n\nNot known: no map has every filter, or no cost is there."
        front = [entry for entry in sorted(entries) if not is_beaten(entry, entries)]
        rows = [[starred(e[4]), e[3], number(e[0]), number(e[1]), number(e[2])] for e in front]
        text += f"\n\n**{unit}**\n\n" + table(["method", "filter", "cost", "error", "bytes"], rows) + own_finding(form, costs, whole, glossy)
    return text


def costs_by_unit(folder):
    """{unit: {(filter, method): costs}}: frame times, then GPUs."""
    by_filter = results_by_filter(folder)
    if not by_filter:
        return {}
    renderer = next(iter(by_filter.values()))["backend"]["renderer"]
    times = {f"Frame times, {renderer}": costs_of(by_filter)}
    return times | {f"Estimated cost, {gpu}": costs for gpu, costs in gpu_costs_of(by_filter).items()}


def part_text(part, folder, results, listed, costs, kept):
    """The sections of the development or the held-out maps; those of `kept`, an earlier page, if there is no result."""
    maps = [entry for entry in listed["maps"] if entry["part"] == part]
    map_of = {scene.split("/")[-1]: entry for entry in maps for scenes in entry["scenes"].values() for scene in scenes}
    forms = {file.stem.removeprefix(f"{part}_"): Form(results_in(results / file.stem), load_toml(file)["matrix"]["footprint"], map_of)
             for file in folder.glob(f"{part}_*.toml")}
    main = forms.get("main")
    if not main or not main.errors:
        found = re.search(rf"^## {PARTS[part]}$.*?(?=\n+## |\Z)", kept, re.MULTILINE | re.DOTALL)
        return found[0].rstrip() if found else f"## {PARTS[part]}\n\nNot run."
    renderers = ", ".join(sorted(set().union(*(form.renderers for form in forms.values()))))
    classes = grouped((entry["class"], entry["name"]) for entry in maps)
    head = (f"## {PARTS[part]}\n\n{counted(maps)}: " +
            ", ".join(f"{len(classes[name])} {name}" for name in CLASSES if name in classes) + f". Rendered by {renderers}.")
    whole, texels = main.maps(), listed["texels_per_pixel"]
    parts = [head, all_part(main), bounds_part(main), duels_part(main),
             groups_part("By class of map", [(name, main, found) for name, found in by_class(maps, whole).items()], main.methods),
             groups_part("By texels per pixel", [(f"{number(per_pixel)} texels", main, whole, i)
                                                 for i, per_pixel in enumerate(texels)], main.methods),
             fronts_part(main, costs, {entry["name"] for entry in maps if entry["gloss"]})]
    others = [(name, forms[form], forms[form].maps()) for name, form in (("other alpha", "alpha"), ("with a sky", "sky"))
              if form in forms and forms[form].errors]
    if others:
        parts.append(groups_part("Other alpha, and a sky", others, main.methods))
    if "storage" in forms and forms["storage"].errors:
        parts.append(storages_part(forms["storage"]))
    return "\n\n".join(parts)


def document(maps_folder, results, note, kept):
    listed = load_results(maps_folder / "maps.json")
    versions = ", ".join(f"`{name}` {version}" for name, version in listed["packages"].items()) or "unpacked packages"
    parts = [part_text(part, maps_folder, results, listed, costs_by_unit(results / "cost"), kept) for part in PARTS]
    if all(part.endswith("Not run.") for part in parts):
        raise Missing(f"{results} has no results; make them with --run")
    head = (f"# Filtering methods on normal maps that others made\n\n`scripts/studies/real_maps_study.py` prints this page. [real-maps.md]"
            f"(real-maps.md) describes the maps, from {versions}. [real_maps.json](../../results/real_maps.json) has their "
            f"hashes.{' ' + note if note else ''} Error is the shading error over interior pixels "
            "([metrics.md](../reference/metrics.md)). Means over distances and maps are geometric. Brackets have the 95% interval of a "
            "bootstrap over maps.")
    return wrapped("\n\n".join([head, *parts])) + "\n"


def run_parts(maps_folder, results, wanted, quick, program):
    for file in sorted(file for file in maps_folder.glob("*.toml") if re.search(wanted, file.stem)):
        print(file.stem, file=sys.stderr)
        run_footprint("run", file, "-q", *(["--quick", "--only", "trilinear$"] if quick else []), "-o", results / file.stem,
                      program=program, cache=results / "cache")


# ---- filter, lobes and fit

def cut_scene(scene, folder):
    """The scene of a map as FOLDER/scene.toml, with the middle of its maps, repeated over as many texels as before."""
    folder.mkdir(parents=True, exist_ok=True)
    text, content = (scene / "scene.toml").read_text(encoding="utf-8"), load_toml(scene / "scene.toml")
    files = [content["plane"]["normal_map"], *(entry["file"] for entry in content.get("maps", {}).values())]
    sizes = [[int(side) for side in re.search(r"(\d+) x +(\d+)", run_command("oiiotool", "--info", scene / file)).groups()] for file in files]
    edges = [min(CUT, side) for side in sizes[0]]
    for file, size, name in zip(files, sizes, ("normal.png", "roughness.png")):
        if size != sizes[0]:
            raise Missing(f"{scene / file} is not as large as the normal map")
        corner = [(side - edge) // 2 for side, edge in zip(size, edges)]
        run_command("oiiotool", scene / file, "--cut", "{}x{}+{}+{}".format(*edges, *corner), "-o", folder / name)
        text = text.replace(f'"{file}"', f'"{name}"')
    tiles = [count * side / edge for count, side, edge in zip(content["tiling"]["uv"], sizes[0], edges)]
    (folder / "scene.toml").write_text(re.sub(r"uv = \[.*\]", f"uv = {tiles}", text), encoding="utf-8")


def run_lobes(maps_folder, results, entries, program):
    for entry in entries:
        folder = results / entry["name"]
        if not (folder / "out/results.json").exists():
            print(entry["name"], file=sys.stderr)
            cut_scene(maps_folder / entry["scenes"]["main"][0], folder)
            run_footprint("compare", folder, "--methods", ",".join((UNIT, *BELOW, BOUND)), "--footprint", "trilinear", "--bound", "on",
                          "--noise", "0.003", "--spp-max", "1024", "--repeats", "1", "-q", "-o", folder / "out",
                          program=program, cache=results / "cache")


def lobes_text(results, entries):
    """By class of map: everything over the error of UNIT, geometric means over maps."""
    files = [file for entry in entries if (file := results / entry["name"] / "out/results.json").exists()]
    if not files:
        raise Missing(f"{results} has no results; make them with --run")
    form = Form([load_results(file) for file in files], ["trilinear"], {entry["scenes"]["main"][0].split("/")[-1]: entry for entry in entries})
    distances = max(len(errors) for by_map in form.own.values() for errors in by_map.values())
    whole = {name for name, errors in form.own["trilinear", UNIT].items() if len(errors) == distances}
    rows = []
    for title, maps in sorted(grouped((class_of(entry), entry["name"]) for entry in entries if entry["name"] in whole).items()):
        alone, lobes = form.parts(("trilinear", BOUND), maps)
        own = [form.parts(("trilinear", method), maps)[1] for method in BELOW]
        rows.append([f"{title}, {counted(maps)}", number(alone), number(lobes), *(f"{number(error)}; {number(error - lobes)}" for error in own)])
    left_out = len(files) - len(whole)
    return (table(["class", "filter", "lobes", *(f"`{method}`: own; fit" for method in BELOW)], rows) + "\n" +
            (f"\n{left_out} without relief in the middle are left out.\n" if left_out else ""))


def main():
    parser = parser_of(__doc__, "maps", "results", "--run", "--quick", "--note", "--footprint")
    parser.add_argument("--parts", default="", metavar="REGEX")
    parser.add_argument("--keep", type=pathlib.Path, metavar="PAGE")
    parser.add_argument("--lobes", action="store_true")
    arguments = parser.parse_args()
    maps, results, program = arguments.maps, arguments.results, arguments.footprint
    if arguments.lobes:
        entries = [entry for entry in load_results(maps / "maps.json")["maps"]
                   if entry["part"] == "development" and re.search(arguments.parts, entry["name"])]
        if arguments.run:
            run_lobes(maps, results, entries, program)
        sys.stdout.write(lobes_text(results, entries))
        return 0
    if arguments.run:
        run_parts(maps, results, arguments.parts, arguments.quick, program)
    kept = arguments.keep.read_text(encoding="utf-8") if arguments.keep else ""
    sys.stdout.write(document(maps, results, arguments.note, kept))
    return 0


if __name__ == "__main__":
    sys.exit(reported("real_maps_study", main))
