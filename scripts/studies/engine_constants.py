#!/usr/bin/env python3
"""Writes docs/results/engine-constants.md from the results of the experiments engine_constants and engine_constants_screen.

  footprint run --all --only engine_constants -o out
  scripts/studies/engine_constants.py out > docs/results/engine-constants.md

The page depends only on the files results.json under RESULTS. It names the scenes and the figures that it is based
on. Exit code 1 if a scene, a method or a figure is missing.
"""
import re
import sys

from study import Missing, grouped, load_results, mean, number, parser_of, reported, table, wrapped

BAKE = "roughness_bake"
# The constants in dispute, by their addition to alpha^2 or, if it says so, to rho^2 = alpha.
CONSTANTS = {
    "0": f"{BAKE}:preset=free:constant=0",
    "0.5": f"{BAKE}:preset=free:constant=0.5",
    "0.75 on ρ²": f"{BAKE}:preset=godot",
    "1": f"{BAKE}:preset=free:constant=1",
    "2": f"{BAKE}:preset=free:constant=2",
    "2 on ρ²": f"{BAKE}:preset=filament_rho",
    "`fit`": BAKE,
}
ARGUED = ["0.5", "0.75 on ρ²", "1", "2"]
BESIDE = {"0.5, capped (`unity`)": f"{BAKE}:preset=unity", "`toksvig`": "toksvig",
          "`fit`, then `o3de` on screen": "specular_aa:preset=o3de:bake=fit", "`direct`": "direct"}
SCENE = "engine_constants_"  # prefix of the scenes' names
SURFACES = {"ggx_polished": "GGX of alpha 0.05, steep bumps", "ggx_satin": "GGX of alpha 0.15, steep bumps",
            "ggx_satin_shallow": "GGX of alpha 0.15, shallow bumps", "ggx_rough": "GGX of alpha 0.4, steep bumps",
            "beckmann_polished": "Beckmann of alpha 0.05, steep bumps",
            "beckmann_satin": "Beckmann of alpha 0.15, steep bumps",
            "beckmann_rough": "Beckmann of alpha 0.4, steep bumps"}
SPREADS = ["ggx_satin", "beckmann_satin"]  # one scene of each distribution of normals
SCREEN = ("screen", "a smooth model, GGX of alpha 0.08")
ROUND = {f"specular_aa:preset=free:constant={c}:cap=1": c for c in ("0.0833", "0.159", "0.318")}


class Member:
    """The results of one scene, as means over the frames of its zoom."""

    def __init__(self, documents, scene, title):
        self.name, self.title = SCENE + scene, title
        if self.name not in documents:
            raise Missing(f"no results of {self.name}; run the experiments engine_constants* into this folder")
        self.results = documents[self.name]
        self.records = grouped((r["method"], r) for r in self.results["records"])
        self.quantities = {(q["method"], q["name"]): q["value"] for q in self.results["quantities"]}

    def mean(self, method, figure):
        if method not in self.records:
            raise Missing(f"{self.name} has no record of {method}")
        values = [(r["flicker"] and r["flicker"]["mean"]) if figure == "flicker" else r["error"][figure] for r in self.records[method]]
        values = [v for v in values if v is not None]
        if not values:
            raise Missing(f"{self.name}: {method} has no {figure}")
        return mean(values)

    def quantity(self, method, name):
        if (method, name) not in self.quantities:
            raise Missing(f"{self.name} has no quantity {name} of {method}")
        return self.quantities[method, name]

    def spreads(self):
        """(alpha, sigma, suffix) of the quantities about the distribution of normals, in order."""
        matches = [re.fullmatch(r"ndf_(a(\d+)_s(\d+))", name) for name in dict.fromkeys(name for _, name in self.quantities)]
        return [(int(m[2]) / 100, int(m[3]) / 100, m[1]) for m in matches if m]


def ends_of(values):
    """The names of the least and of the greatest value."""
    return min(values, key=values.get), max(values, key=values.get)


def spread_part(member):
    rows = [[alpha, sigma, member.quantity(BAKE, f"best_{suffix}"), *(member.quantity(method, f"ndf_{suffix}") for method in CONSTANTS.values())]
            for alpha, sigma, suffix in member.spreads()]
    example = member.spreads()[-1][2]
    return (f"Scene `{member.name}`; quantities such as `ndf_{example}` and `best_{example}`:\n\n" +
            table(["α", "σ", "best c", *CONSTANTS], [map(number, row) for row in rows]))


def picture_part(members):
    parts = []
    for figure, words in (("shading", "Error over interior pixels"), ("energy_bias", "Energy bias"), ("flicker", "Flicker")):
        columns = {title: (method, figure) for title, method in {**CONSTANTS, **BESIDE}.items()}
        if figure == "shading":
            columns["noise floor"] = (BAKE, "shading_floor")
        rows = [[m.title, *(number(m.mean(*column)) for column in columns.values())] for m in members]
        parts.append(f"**{words}** (`{figure}`):\n\n" + table(["surface", *columns], rows))
    return "\n\n".join(parts)


def screen_part(member):
    figures = {"error": "normalized_color", "error over interior pixels": "shading", "energy bias": "energy_bias", "flicker": "flicker"}
    found = {method: {figure: member.mean(method, figure) for figure in figures.values()} for method in member.records}
    errors = {method: values["normalized_color"] for method, values in found.items()}
    constants = {constant: errors[method] for method, constant in ROUND.items()}
    least, most = ends_of(constants)
    presets = {method: error for method, error in errors.items() if method not in ROUND and method != "direct"}
    best, worst = ends_of(presets)
    steady = {method: values["flicker"] for method, values in found.items()}
    calm, restless = ends_of(steady)
    rows = [[f"`{method}`", *map(number, values.values())] for method, values in found.items()]
    return table(["method", *figures], rows) + "\n\n" + "\n".join((
        f"- Of the constants c in α² + c S alone, {least} has the least error, {number(constants[least])}, and {most} the most, "
        f"{number(constants[most])}. `direct` has {number(errors['direct'])}.",
        f"- Of the presets `{best}` has the least error, {number(presets[best])}, and `{worst}` the most, {number(presets[worst])}.",
        f"- `{calm}` flickers least, {number(steady[calm])}, and `{restless}` most, {number(steady[restless])}."))


def verdict(members, spreads):
    """How often each constant in dispute is the best, over distributions of normals, images and flicker."""
    cases = {"distributions of normals": [{name: member.quantity(CONSTANTS[name], f"ndf_{suffix}") for name in ARGUED}
                                          for member in spreads for _, _, suffix in member.spreads()]}
    for title, figure in (("pictures", "shading"), ("flicker", "flicker")):
        cases[title] = [{name: member.mean(CONSTANTS[name], figure) for name in ARGUED} for member in members]
    best = {title: [ends_of(case)[0] for case in found] for title, found in cases.items()}
    return table(["constant", *best], [[name, *(f"{won.count(name)} of {len(won)}" for won in best.values())] for name in ARGUED])


def document(folder):
    documents = {d["scene"]["name"]: d for d in map(load_results, sorted(folder.rglob("results.json")))}
    members = [Member(documents, *surface) for surface in SURFACES.items()]
    spreads = [Member(documents, scene, SURFACES[scene]) for scene in SPREADS]
    screen = Member(documents, *SCREEN)
    backend, reference, pixels = (screen.results["backend"], screen.results["reference"], screen.results["records"][0]["pixels"])
    head = f"""# Which constant is right?

Engines widen a lobe by c / κ, where κ follows from the length of the mean normal. They ship c = 0.5, 0.75 (on \
ρ² = α), 1 and 2 ([roughness_bake](../../methods/roughness_bake/README.md)). On screen they add c S, where S is the sum \
of the normal's squared derivatives ([specular_aa](../../methods/specular_aa/README.md)). `scripts/studies/engine_constants.py` writes \
this page from `experiments/engine_constants.toml` and `engine_constants_screen.toml`: Footprint {screen.results["tool"]["version"]}, \
{backend["renderer"]}, {reference["spp"]} samples per pixel, filter {screen.results["footprint"]}.

Each of these constants is the best in so many of the cases below:

{verdict(members, spreads)}

## The distribution of normals

The relative L2 difference of the one lobe from the true density of normals. The texels' slopes are an even Gaussian of \
deviation σ. `best c` is the constant with the least difference.

"""
    parts = [f"### {m.title.split(' of')[0]}\n\n{spread_part(m)}" for m in spreads]
    parts.append(f"""## Pictures

The surfaces have bumps of a pixel and less, under two small lights. Values are means over the frames of a zoom. The \
scenes are, in order, {", ".join(f"`{m.name}`" for m in members)}.

{picture_part(members)}""")
    parts.append(f"""## On screen

The scene `{screen.name}` is {screen.title}, without a normal map. Only {pixels["interior"]} of \
{pixels["object"]} pixels of its first frame are interior. The others contain an edge or a fold, which no filter on \
screen sees. The error is `normalized_color`.

{screen_part(screen)}
""")
    return wrapped(head + "\n\n".join(parts))


def main():
    sys.stdout.write(document(parser_of(__doc__, "results").parse_args().results))
    return 0


if __name__ == "__main__":
    sys.exit(reported("engine_constants", main))
