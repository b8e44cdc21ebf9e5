#!/usr/bin/python3
"""Fits the model of `footprint recommend --quick`, and prints results/quick_model.json.

  scripts/studies/quick_model.py MAPS RESULTS [--surfaces FOLDER] > new.json   fits and calibrates it
  scripts/studies/quick_model.py MAPS [--surfaces FOLDER] > new.json           keeps the fit, and says again where it is valid

MAPS and RESULTS are the folders of real_maps.py and real_maps_study.py. Per method and footprint filter, the
logarithm of the shading error is a constant per footprint size, and a sum over the logarithms of alpha and of the errors
of four simple lobes (`footprint statistics`), by ridge regression over the maps for development. Their range is the
model's domain. The held-out maps only calibrate it: their residuals are its intervals, and they say how often its order
and its choice are right. With --surfaces, surfaces of the project's own generators, which nothing was fitted on, calibrate
it again: FOLDER is made if it is missing, and measured by some methods. Exit code 1 if a part is missing.
"""
import json
import pathlib
import sys

import numpy

from real_maps import SCENE
from study import ROOT, Missing, gpu_costs_of, load_results, load_toml, parser_of, reported, results_by_filter, results_in, run_footprint

FILTERS = ("trilinear", "anisotropic:8", "shaded:2")
LEVELS = (1, 2, 3, 4)  # the distances of a scene: 2, 4, 8 and 16 texels per pixel
RIDGE = 0.3
LEAST_ERROR = 1e-6  # under which a logarithm says nothing
ALIKE = 1.1         # factor between errors whose order does not matter
MODEL = ROOT / "results/quick_model.json"
# Generated surfaces, and some of other parameters, by the name of their scenes.
GENERATED = {"bumps": "bumps", "steep_bumps": "bumps steepness=2", "v_grooves": "v_grooves", "flat_grooves": "v_grooves tilt_degrees=8",
             "scales": "scales", "scratches": "scratches", "scratched_metal": "scratched_metal", "carved_disk": "carved_disk",
             "golden_armor": "golden_armor", "desert": "desert", "studs": "studs", "cast_metal": "cast_metal"}
RESOLUTION, PIXELS = 512, 128
ALPHAS = (0.15, 0.3)
MEASURED = ("direct", "naive_mip", "toksvig", "roughness_bake", "lean", "leadr", "tan_gmm:n=4", "tan_gmm:n=8", "cells:k=4")


def inputs_of(folder):
    """Per level: which one it is, and the logarithms of alpha and of the simple lobes' errors."""
    scene = load_toml(folder / "scene.toml")
    alpha = scene["brdf"].get("alpha")
    words = ("--alpha", alpha) if alpha else ("--roughness", folder / scene["maps"]["roughness"]["file"])
    found = json.loads(run_footprint("statistics", folder / scene["plane"]["normal_map"], *words, "--json"))
    by_level = {level["level"]: level["lobe_errors"] for level in found["levels"]}
    features = [[found["mean_alpha"], *numpy.maximum(by_level[level], LEAST_ERROR)] for level in LEVELS]
    return numpy.hstack([numpy.eye(len(LEVELS)), numpy.log(features)])


def measured(results, part):
    """{(filter, method): {scene: errors by level}} of the forms main and alpha, and bytes per texel by method."""
    errors, texel_bytes = {}, {}
    for form in ("main", "alpha"):
        for found in results_in(results / f"{part}_{form}"):
            for r in sorted(found["records"], key=lambda r: r["distance"]):
                texel_bytes[r["method"]] = r["precompute"]["bytes_per_texel"]
                by_scene = errors.setdefault((found["footprint"], r["method"]), {})
                by_scene.setdefault(found["scene"]["name"], []).append(r["error"] and r["error"]["shading"] or numpy.nan)
    return errors, texel_bytes


def ridge(inputs, errors):
    """The weights that give the logarithms of the errors from inputs, one row each."""
    known = ~numpy.isnan(errors)
    x, y = inputs[known], numpy.log(errors[known])
    return numpy.linalg.solve(x.T @ x + RIDGE * numpy.eye(x.shape[1]), x.T @ y)


def quantile(values, share):
    return sorted(values)[min(int(share * len(values)), len(values) - 1)]


def calibration(footprint, models, errors, inputs):
    """How far off the predictions of one filter are on held-out maps, and how often their order is right."""
    mine = {method: weights for (name, method), weights in models.items() if name == footprint}
    scenes = sorted(errors[footprint, "direct"])
    # By method, scene and level.
    found = numpy.array([[errors[footprint, method][scene] for scene in scenes] for method in mine])
    guessed = numpy.exp([[inputs[scene] @ weights for scene in scenes] for weights in mine.values()])
    residuals = numpy.log(found / guessed)[~numpy.isnan(found)]
    means, guesses = found.mean(axis=2), guessed.mean(axis=2)
    one, other = numpy.tril_indices(len(mine), -1)
    ratio, guessed_ratio = means[one] / means[other], guesses[one] / guesses[other]
    matters = numpy.abs(numpy.log(ratio)) > numpy.log(ALIKE)
    chosen = numpy.take_along_axis(means, guesses.argmin(axis=0)[None], axis=0)[0]
    return {"footprint": footprint, "scenes": len(scenes), "predictions": len(residuals),
            "median_factor": numpy.exp(quantile(numpy.abs(residuals), 0.5)),
            "interval_80": [numpy.exp(quantile(residuals, share)) for share in (0.1, 0.9)],
            "order_factor": numpy.exp(quantile(numpy.abs(numpy.log(guessed_ratio / ratio)).ravel(), 0.68)),
            "order_right": ((guessed_ratio < 1) == (ratio < 1))[matters].mean(),
            "choice_right": (chosen <= ALIKE * means.min(axis=0)).mean()}


def rounded(value):
    """The floats of a tree of lists and dictionaries with five digits."""
    if isinstance(value, dict):
        return {key: rounded(inner) for key, inner in value.items()}
    if isinstance(value, (list, numpy.ndarray)):
        return [rounded(inner) for inner in value]
    return float(f"{value:.5g}") if isinstance(value, float) else value


def write_surfaces(folder):
    """A plane of each generated surface and alpha, and the experiment that measures them, in a new folder."""
    folder.mkdir(parents=True)
    for name, words in GENERATED.items():
        surface, *parameters = words.split()
        run_footprint("surface", surface, "--resolution", RESOLUTION, *(word for p in parameters for word in ("--parameter", p)),
                      "-o", folder / f"{name}.exr")
        for alpha in ALPHAS:
            scene = folder / f"{name}_{alpha}"
            scene.mkdir()
            (scene / "scene.toml").write_text(SCENE.format(
                source="scripts/studies/quick_model.py", package="footprint", name=scene.name, file=name, alpha=alpha, map=f"../{name}.exr",
                roughness=f"alpha = {alpha}", tiles=[1, 1], sky="", pixels=PIXELS,
                distances=[2**level * PIXELS / RESOLUTION for level in LEVELS]), encoding="utf-8")
    (folder / "surfaces.toml").write_text(
        f"""[experiment]
title = "Generated surfaces"
methods = {json.dumps(MEASURED)}
repeats = 1

[matrix]
scene = {json.dumps([f"{name}_{alpha}" for name in GENERATED for alpha in ALPHAS])}
footprint = {json.dumps(FILTERS)}

[reference]
spp = 128
supersampling = [1]
bound = "off"
""", encoding="utf-8")


def surface_calibrations(folder, models):
    """How wrong the model is on generated surfaces, which are made and measured unless they are there."""
    if not (folder / "surfaces.toml").exists():
        write_surfaces(folder)
    if not (folder / "results/matrix.json").exists():
        run_footprint("run", folder / "surfaces.toml", "-q", "-o", folder / "results")
    errors = {}
    for found in results_in(folder / "results"):
        for r in sorted(found["records"], key=lambda r: r["distance"]):
            by_scene = errors.setdefault((found["footprint"], r["method"]), {})
            by_scene.setdefault(found["scene"]["name"], []).append(r["error"] and r["error"]["shading"] or numpy.nan)
    inputs = {f"{name}_{alpha}": inputs_of(folder / f"{name}_{alpha}") for name in GENERATED for alpha in ALPHAS}
    mine = {key: weights for key, weights in models.items() if key in errors}
    return [calibration(footprint, mine, errors, inputs) for footprint in FILTERS if (footprint, "direct") in mine]


def domain_of(maps):
    """Per level, the range of each logarithm over the maps for development."""
    found = numpy.array([inputs_of(scene.parent)[:, len(LEVELS):] for scene in sorted(maps.glob("development/*/scene.toml"))])
    if not len(found):
        raise Missing(f"{maps}: has no scenes for development (scripts/studies/real_maps.py {maps})")
    return numpy.stack([found.min(axis=0), found.max(axis=0)], axis=-1)


def model_of(maps, results):
    fitted, texel_bytes = measured(results, "development")
    held_out, _ = measured(results, "held_out")
    # A method that ran on some maps alone, as means of concentrations on maps with a gloss map, has no model for the others.
    keys = [key for key in fitted if key[0] in FILTERS and key in held_out and all(
        errors[key].keys() == errors[key[0], "direct"].keys() for errors in (fitted, held_out))]
    if not keys:
        raise Missing(f"{results}: no results of maps for development and of held-out maps under {', '.join(FILTERS)}")
    inputs = {scene: inputs_of(maps / part / scene) for part, errors in (("development", fitted), ("held_out", held_out))
              for scene in set().union(*(errors[key] for key in keys))}
    models = {key: ridge(numpy.vstack([inputs[scene] for scene in fitted[key]]), numpy.concatenate([*fitted[key].values()]))
              for key in keys}
    costs = gpu_costs_of(results_by_filter(results / "cost"))
    return {"schema": "footprint-quick-model/1", "texels_per_pixel": [2**level for level in LEVELS],
            "scenes": max(len(fitted[key]) for key in keys),
            "calibration": [calibration(footprint, models, held_out, inputs) for footprint in FILTERS if (footprint, "direct") in models],
            "methods": [{"method": method, "bytes_per_texel": texel_bytes[method],
                         "filters": [{"footprint": footprint, "weights": models[footprint, method],
                                      "costs": {gpu: by_key[footprint, method][0] for gpu, by_key in costs.items()
                                                if (footprint, method) in by_key}}
                                     for footprint in FILTERS if (footprint, method) in models]}
                        for method in dict.fromkeys(method for _, method in keys)]}


def models_in(model):
    """The weights of a model by footprint filter and method."""
    return {(own["footprint"], entry["method"]): numpy.array(own["weights"]) for entry in model["methods"] for own in entry["filters"]}


def main():
    parser = parser_of(__doc__, "maps")
    parser.add_argument("results", type=pathlib.Path, nargs="?", metavar="RESULTS")
    parser.add_argument("--surfaces", type=pathlib.Path, metavar="FOLDER")
    arguments = parser.parse_args()
    maps = arguments.maps.resolve()
    model = {"surfaces": []} | (model_of(maps, arguments.results) if arguments.results else load_results(MODEL))
    model["domain"] = domain_of(maps)
    if arguments.surfaces:
        model["surfaces"] = surface_calibrations(arguments.surfaces.resolve(), models_in(model))
    print(json.dumps(rounded(model), indent=1))
    return 0


if __name__ == "__main__":
    sys.exit(reported("quick_model", main))
