"""The library of the studies in this folder.

It reads experiments and results.json, averages numbers, wraps text, draws charts and has the Pareto front. The studies
import from here what they share with the other scripts (scripts/common.py).
"""
import collections
import json
import math
import pathlib
import sys
import textwrap

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))
from common import (PROGRAM, ROOT, Missing, load_results, load_toml, number, parser_of, reported, run_command,
                    run_footprint, table)

PROSE_WIDTH = 120
OURS = ("cells", "ndf_atlas")
UNPUBLISHED = (*OURS, "tan_gmm:covariance=full")  # no paper has this variant of tan_gmm either
PLAIN = "plain supersampling"
SUPERSAMPLING = (1, 2, 4, 8, 16, 32, 64)


# ---- experiments and results

def matrix_of(name):
    """The [matrix] of an experiment's file, over that of its presets."""
    file = ROOT / "experiments" / f"{name}.toml"
    content = load_toml(file)
    presets = content["experiment"].get("presets")
    shared = load_toml(file.parent / presets).get("matrix", {}) if presets else {}
    return shared | content.get("matrix", {})


def results_in(folder):
    """All results of the runs in a folder, in the order of their names."""
    return [load_results(file) for file in sorted(folder.glob("*/results.json"))]


def results_by_filter(folder):
    return {results["footprint"]: results for results in results_in(folder)}


# ---- numbers and text

def mean(values):
    return sum(values) / len(values)


def geometric_mean(values):
    return math.exp(mean([math.log(max(v, 1e-9)) for v in values]))


def counted(maps):
    return f"{len(maps)} map{'' if len(maps) == 1 else 's'}"


def spread(values):
    """Geometric mean and geometric standard deviation."""
    middle = geometric_mean(values)
    deviation = math.exp(math.sqrt(mean([math.log(max(v, 1e-9) / middle) ** 2 for v in values])))
    return f"{number(middle)} ×/÷ {deviation:.2f}"


def wrapped(text):
    """Paragraphs and items wrapped; tables, headings and images as they are."""
    lines = []
    for line in text.split("\n"):
        indent = "  " if line.startswith("- ") else ""
        is_prose = line and line[0] not in "|#!"
        lines += (textwrap.wrap(line, PROSE_WIDTH, subsequent_indent=indent, break_on_hyphens=False) if is_prose
                  else [line])
    return "\n".join(lines)


# ---- charts

def palette():
    """The colours of all reports and figures."""
    return load_results(ROOT / "results/report/palette.json")["light"]


def colours_of(methods, program=PROGRAM):
    """{method: its colour}, as the program assigns them in all reports."""
    return {method: colours["light"] for method, colours in json.loads(run_footprint("method-colors", *methods, program=program)).items()}


class LogChart:
    """An SVG with logarithmic axes over points (x, y), all above 0."""

    def __init__(self, points, titles, ticks):
        """titles, ticks: of x and of y; only ticks within the points are drawn."""
        self.ends = [(math.log(min(values)) - 0.15, math.log(max(values)) + 0.15) for values in zip(*points)]
        self.svg = ['<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 960 540" font-family="sans-serif" font-size="11">',
                    '<rect width="960" height="540" fill="white"/>',
                    f'<text x="420" y="525" text-anchor="middle">{titles[0]}</text>',
                    f'<text x="15" y="250" text-anchor="middle" transform="rotate(-90 15 250)">{titles[1]}</text>']
        for axis in (0, 1):
            for tick in ticks[axis]:
                if self.ends[axis][0] < math.log(tick) < self.ends[axis][1]:
                    self._add_tick(axis, tick)

    def _place(self, value, axis):
        low, high = self.ends[axis]
        share = (math.log(value) - low) / (high - low)
        return 60 + 720 * share if axis == 0 else 480 - 460 * share

    def _add_tick(self, axis, tick):
        at = self._place(tick, axis)
        line, text = (f"M{at:.1f} 20V480", f'x="{at:.1f}" y="496"') if axis == 0 else (f"M60 {at:.1f}H780", f'x="28" y="{at:.1f}"')
        self.svg.append(f'<path d="{line}" stroke="#dddddd"/><text {text}>{tick:g}</text>')

    def add_line(self, points, colour):
        places = " ".join(f"{self._place(x, 0):.1f},{self._place(y, 1):.1f}" for x, y in points)
        self.svg.append(f'<polyline points="{places}" fill="none" stroke="{colour}"/>')

    def add_point(self, point, colour, radius=3, title="", label=""):
        x, y = (self._place(value, axis) for axis, value in enumerate(point))
        self.svg.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{radius}" fill="{colour}"><title>{title}</title></circle>')
        if label:
            self.svg.append(f'<text x="{x + 6:.1f}" y="{y - 4:.1f}" font-size="9">{label}</text>')

    def add_legend(self, colours):
        """colours: {name: colour}."""
        for i, (name, colour) in enumerate(colours.items()):
            self.svg.append(f'<circle cx="800" cy="{40 + 20 * i}" r="4" fill="{colour}"/><text x="812" y="{44 + 20 * i}">{name}</text>')

    def write(self, file):
        file.write_text("\n".join(self.svg + ["</svg>"]) + "\n", encoding="utf-8")


# ---- records of a study over footprint filters

def grouped(pairs):
    """{key: its values, in order}."""
    groups = collections.defaultdict(list)
    for key, value in pairs:
        groups[key].append(value)
    return groups


def code(names):
    return [f"`{name}`" for name in names]


def records_of(by_filter):
    """((filter, method), record) of all results of a part."""
    return [((name, r["method"]), r) for name, results in by_filter.items() for r in results["records"]]


def costs_of(by_filter):
    """Frames of `direct`, by filter and method: (geometric mean of the medians over distances, least, most)."""
    ratios_to_direct = grouped((key, r["time"]["ratio_to_direct"]) for key, r in records_of(by_filter))
    costs = {key: (geometric_mean([r["median"] for r in over]), min(r["low"] for r in over),
                   max(r["high"] for r in over)) for key, over in ratios_to_direct.items()}
    return costs | {(name, f"{PLAIN} {spp}"): (float(spp),) * 3 for name in by_filter for spp in SUPERSAMPLING}


def gpu_costs_of(by_filter):
    """{GPU: costs as costs_of has them, by estimated cost over that of `direct`}."""
    estimates = grouped(((cost["gpu"], key), cost["ratio_to_direct"]) for key, r in records_of(by_filter)
                        for cost in r.get("gpu_costs", []) if cost["ratio_to_direct"])
    plain = costs_of({name: {"records": []} for name in by_filter})
    return {gpu: plain | {key: (geometric_mean(over), min(over), max(over))
                          for (own, key), over in estimates.items() if own == gpu}
            for gpu in dict.fromkeys(gpu for gpu, _ in estimates)}


# ---- Pareto fronts

def front_of(entries):
    """The Pareto-optimal entries of (cost, error, ...), cheapest first."""
    front = []
    for entry in sorted(entries, key=lambda e: e[:2]):
        if not front or entry[1] < front[-1][1]:
            front.append(entry)
    return front


def error_on_front(front, cost):
    """The front's error at a cost, interpolated in logarithms; its last error beyond its end, None before its start."""
    before = [f for f in front if f[0] <= cost]
    after = [f for f in front if f[0] > cost]
    if not before:
        return None
    if not after:
        return before[-1][1]
    (c0, e0), (c1, e1) = before[-1][:2], after[0][:2]
    t = (math.log(cost) - math.log(c0)) / (math.log(c1) - math.log(c0))
    return math.exp(math.log(e0) + t * (math.log(e1) - math.log(e0)))
