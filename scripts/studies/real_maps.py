#!/usr/bin/env python3
"""Collects normal maps that others made, as scenes: scripts/studies/real_maps.py FOLDER [PACKAGE=FOLDER ...] [--record]

Downloads the Debian packages of PACKAGES into FOLDER/packages and unpacks them there, without installing anything. A
PACKAGE=FOLDER has an unpacked tree instead. Each map is checked, described by `footprint statistics` and put in a class.
A hash of its file's name puts it in a part: two thirds are for development. The rest is held out: no constant of a method may
be chosen on it. FOLDER/maps.json lists maps and those that are left out, each with its reason; FOLDER/PART/NAME/scene.toml
are the scenes: GGX with Smith under two lights and a sky, alpha from a gloss map beside the normal map, else 0.1, 0.2, 0.4.
The maps themselves are never committed: results/real_maps.json has their names, hashes and parts, and --record writes it.
Exit code 1 if a package cannot be downloaded or no map is found, or if a map is not the recorded one.
"""
import hashlib
import itertools
import json
import os
import pathlib
import re
import shutil
import sys

from study import PROGRAM, ROOT, Missing, load_results, reported, run_command

PACKAGES = {"supertuxkart-data": "usr/share/games/supertuxkart/data", "assimp-testmodels": "usr/share/assimp/models",
            "glmark2-data": "usr/share/glmark2"}
NORMAL = re.compile(r"normal", re.IGNORECASE)
RECORD = ROOT / "results/real_maps.json"
RECORDED = ("name", "package", "file", "sha256", "licence", "class", "part")
IMAGES = {".png", ".jpg", ".jpeg", ".tga", ".bmp"}
LEAST_UNIT_SHARE = 0.95  # of the texels of a normal map
CLASS_LEVEL = 3  # blocks of 8 x 8 texels
ALPHAS = (0.1, 0.2, 0.4)
MAIN_ALPHA = 0.2
# SuperTuxKart's shaders turn gloss g into the exponent 2^(10 g + 1) of a Blinn-Phong lobe; alpha^2 = 2 / (exponent + 2), and
# roughness is the root of alpha.
GLOSS_STEPS = 64
SCENE = """# Written by scripts/studies/real_maps.py from {source} ({package}).
[scene]
name = "{name}"
description = "{file} of {package}, GGX, alpha {alpha}"

[plane]
size = [2.0, 2.0]
normal_map = "{map}"

[tiling]
uv = {tiles}

[brdf]
distribution = "ggx"
geometry = "smith"
fresnel = "schlick"
diffuse = false
specular = [0.9, 0.9, 0.9]
{roughness}

[camera]
frame_bounds = {{ direction = [0.0, -0.3, 1.0], fov_degrees = 30.0, margin = 1.0 }}

[frame]
size = [{pixels}, {pixels}]

[[light]]
type = "directional"
direction = [0.25, -0.1, -1.0]
intensity = 0.5

[[light]]
type = "directional"
direction = [-0.5, 0.4, -0.8]
intensity = 0.5

[zoom]
distances = {distances}
{sky}"""
SKY = """
[environment]
kind = "sky"
sun_direction = [0.7, 0.35, 0.6]
intensity = 0.15
"""
EXPERIMENT = """# Written by scripts/studies/real_maps.py.
[experiment]
title = "Normal maps that others made: {part}, {form}"
presets = "{presets}"

[matrix]
scene = {scenes}
footprint = {filters}
"""
COST = """# Written by scripts/studies/real_maps.py. What each method costs: the surface fills the image, at 4 texels per pixel.
[experiment]
title = "Normal maps that others made: cost"
presets = "{presets}"
scene = "{scene}"
size = [{size}, {size}]
repeats = 5
gpu = ["PS4", "RX 480", "Steam Deck", "RX 6800"]
time_unit = "trilinear"

[matrix]
footprint = {filters}

[zoom]
distances = [0.8]

[reference]
noise = 1.0
spp = 1
supersampling = [1]
bound = "off"
"""
COST_SIZE = 320
PARTS = ("development", "held_out")
FILTERS = ["trilinear", "anisotropic:8", "ewa:8", "box:3", "area:3", "shaded:2"]
# Per form: title, which scenes of a map, footprint filters, experiments/presets/NAME.toml.
FORMS = {"main": ("under two lights", "main", FILTERS, "real_maps"),
         "alpha": ("under two lights, smoother and rougher", "alpha", ["trilinear", "shaded:2"], "real_maps"),
         "sky": ("under two lights and a sky", "sky", ["trilinear"], "real_maps_sky"),
         "storage": ("smaller storages under two lights", "main", ["trilinear"], "real_maps_storage")}
PIXELS = 128  # the side of an image, which the surface fills at distance 1
LEAST_TEXELS = 512  # that a surface is wide; smaller maps are repeated
TEXELS_PER_PIXEL = (2, 4, 8, 16)


def unpacked(package, folder):
    """The folder of a package's files, downloaded once; a folder gets its name once it is complete."""
    target = folder / package
    if not target.exists():
        part = folder / f"{package}.part"
        shutil.rmtree(part, ignore_errors=True)
        part.mkdir(parents=True)
        run_command("apt-get", "download", package, cwd=part)
        archive = next(part.glob("*.deb"))
        (part / "version").write_text(archive.name.split("_")[1], encoding="utf-8")
        run_command("dpkg-deb", "--extract", archive, part)
        archive.unlink()
        part.rename(target)
    return target


def part_of(file_name):
    """`held_out` for a third of all names, by their hash."""
    return "held_out" if int(hashlib.sha256(file_name.encode()).hexdigest(), 16) % 3 == 0 else "development"


def class_of(level):
    """What a map is like over 8 x 8 texels: hardly any relief, lines, rare steep texels, or none of these."""
    if level["variance"] < 1e-3:
        return "flat"
    if level["anisotropy"] >= 0.7:
        return "lines"
    return "rare" if level["tails"] >= 2.0 else "rough"


def gloss_of(file):
    """The gloss map beside a normal map: the same name with gloss in place of normal."""
    wanted = {NORMAL.sub(word, file.stem).lower() for word in ("gloss", "glossy")}
    return next((found for found in sorted(file.parent.iterdir())
                 if found.suffix.lower() in IMAGES and found.stem.lower() in wanted), None)


def licence_of(file, root):
    """The nearest file of licences above a map, else the package's own."""
    for folder in file.parents:
        for found in sorted(folder.glob("[Ll]icen[cs]e*")):
            return str(found.relative_to(root))
        if folder == root:
            break
    return next((str(found.relative_to(root)) for found in root.glob("usr/share/doc/*/copyright")), "")


def described(file, root, package):
    """An entry of maps.json; Missing with the reason if it is not a normal map."""
    gloss = gloss_of(file)
    try:
        found = json.loads(run_command(PROGRAM, "statistics", file, "--json", *(["--gloss", gloss] if gloss else [])))
    except Missing:
        found, gloss = json.loads(run_command(PROGRAM, "statistics", file, "--json")), None
    if found["unit_share"] < LEAST_UNIT_SHARE:
        raise Missing(f"{found['unit_share']:.1%} of its texels are unit vectors out of the surface")
    levels = {level["level"]: level for level in found["levels"]}
    if CLASS_LEVEL not in levels:
        raise Missing(f"has {found['size'][0]} x {found['size'][1]} texels")
    return {"name": re.sub(r"[^a-z0-9]+", "_", NORMAL.sub("", file.stem).lower()).strip("_"), "package": package,
            "file": str(file.relative_to(root)), "sha256": hashlib.sha256(file.read_bytes()).hexdigest(),
            "licence": licence_of(file, root), "size": found["size"], "class": class_of(levels[CLASS_LEVEL]),
            "part": part_of(file.name), "gloss": str(gloss.relative_to(root)) if gloss else None,
            "gloss_correlation": found["gloss_correlation"], "levels": found["levels"]}


def maps_of(package, root, below, maps, left_out):
    """Adds the maps of a tree, and what is left out of it."""
    for file in sorted(found for found in (root / below).rglob("*") if found.suffix.lower() in IMAGES
                       and NORMAL.search(found.stem) and found.is_file()):
        try:
            entry = described(file, root, package)
            twin = next((other for other in maps if other["sha256"] == entry["sha256"]), None)
            if twin:
                raise Missing(f"is the same as {twin['file']}")
            while any(other["name"] == entry["name"] for other in maps):
                entry["name"] += "_2"
            maps.append(entry)
        except Missing as reason:
            left_out.append({"package": package, "file": str(file.relative_to(root)), "reason": str(reason)})


def write_roughness(gloss, file):
    """The roughness of a gloss map, by a table of GLOSS_STEPS entries."""
    roughness = [(1.0 + 2.0 ** (10.0 * i / (GLOSS_STEPS - 1))) ** -0.25 for i in range(GLOSS_STEPS)]
    run_command("oiiotool", gloss, "--ch", "0", "--colormap", ",".join(f"{r:.6f},{r:.6f},{r:.6f}" for r in roughness), "--ch", "0",
        "-o", file)


def forms_of(entry):
    """(form, its name, its roughness in scene.toml, its sky) of the scenes of a map."""
    if entry["gloss"]:
        shades = [("main", "gloss", '[maps.roughness]\nfile = "roughness.png"')]
    else:
        shades = [("main" if alpha == MAIN_ALPHA else "alpha", str(alpha).replace(".", ""), f"alpha = {alpha}")
                  for alpha in ALPHAS]
    return [(*shade, "") for shade in shades] + [("sky", f"{name}_sky", roughness, SKY)
                                                 for form, name, roughness in shades if form == "main"]


def write_scenes(entry, root, folder):
    """The scenes of a map; returns their folders by form."""
    scenes = {}
    for form, name, roughness, sky in forms_of(entry):
        scene = folder / entry["part"] / f"{entry['name']}_{name}"
        scene.mkdir(parents=True, exist_ok=True)
        if entry["gloss"]:
            write_roughness(root / entry["gloss"], scene / "roughness.png")
        alpha = "of a gloss map" if entry["gloss"] else roughness.split()[-1]
        tiles = [max(1, LEAST_TEXELS // side) for side in entry["size"]]
        across = max(side * count for side, count in zip(entry["size"], tiles))
        (scene / "scene.toml").write_text(
            SCENE.format(source=entry["file"], package=entry["package"], name=scene.name, file=pathlib.Path(entry["file"]).name,
                         alpha=alpha, map=os.path.relpath(root / entry["file"], scene), roughness=roughness, tiles=tiles, sky=sky,
                         pixels=PIXELS, distances=[per_pixel * PIXELS / across for per_pixel in TEXELS_PER_PIXEL]),
            encoding="utf-8")
        scenes.setdefault(form, []).append(str(scene.relative_to(folder)))
    return scenes


def write_experiments(maps, folder):
    """FOLDER/PART_FORM.toml: the scenes of a form under its footprint filters, for `footprint run`; FOLDER/cost.toml."""
    presets = os.path.relpath(ROOT / "experiments/presets", folder)
    for part, (form, (title, wanted, filters, name)) in itertools.product(PARTS, FORMS.items()):
        scenes = [scene for entry in maps if entry["part"] == part for scene in entry["scenes"].get(wanted, [])]
        if scenes:
            (folder / f"{part}_{form}.toml").write_text(
                EXPERIMENT.format(part=part.replace("_", " "), form=title, scenes=json.dumps(scenes),
                                  filters=json.dumps(filters), presets=f"{presets}/{name}.toml"), encoding="utf-8")
    first = max(maps, key=lambda entry: (entry["part"] == PARTS[0], entry["size"]))
    (folder / "cost.toml").write_text(COST.format(presets=f"{presets}/real_maps.toml", scene=first["scenes"]["main"][0], size=COST_SIZE,
                                                  filters=json.dumps(FILTERS)), encoding="utf-8")


def check_record(maps):
    """Missing if a map of the record has another content here."""
    known = {(entry["package"], entry["file"]): entry["sha256"] for entry in load_results(RECORD)["maps"]}
    changed = [entry["file"] for entry in maps if known.get((entry["package"], entry["file"]), entry["sha256"]) !=
               entry["sha256"]]
    if changed:
        raise Missing(f"{', '.join(changed)}: not as in {RECORD}; use the package's recorded version, or --record")


def written(path, content):
    path.write_text(json.dumps(content, indent=1) + "\n", encoding="utf-8")


def main(words):
    record = "--record" in words
    words = [word for word in words if word != "--record"]
    if not words or words[0].startswith("-") or any("=" not in word for word in words[1:]):
        print(__doc__)
        return 0 if words[:1] in (["-h"], ["--help"]) else 2
    folder, given = pathlib.Path(words[0]), dict(word.split("=", 1) for word in words[1:])
    roots = {name: pathlib.Path(path) for name, path in given.items()} or {
        name: unpacked(name, folder / "packages") for name in PACKAGES}
    maps, left_out = [], []
    for package, root in roots.items():
        maps_of(package, root.resolve(), PACKAGES.get(package, ""), maps, left_out)
    if not maps:
        raise Missing("no normal map was found")
    for entry in maps:
        entry["scenes"] = write_scenes(entry, roots[entry["package"]].resolve(), folder.resolve())
    write_experiments(maps, folder.resolve())
    versions = {name: (root / "version").read_text(encoding="utf-8") for name, root in roots.items()
                if (root / "version").exists()}
    written(folder / "maps.json", {"packages": versions, "texels_per_pixel": TEXELS_PER_PIXEL, "maps": maps,
                                   "left_out": left_out})
    if record:
        recorded = [{key: entry[key] for key in RECORDED} for entry in maps]
        written(RECORD, {"packages": versions, "maps": recorded, "left_out": left_out})
    check_record(maps)
    counts = {part: sum(entry["part"] == part for entry in maps) for part in PARTS}
    print(f"{len(maps)} maps, {counts['development']} for development and {counts['held_out']} held out; {len(left_out)} "
          f"files are left out: {folder / 'maps.json'}")
    return 0


if __name__ == "__main__":
    sys.exit(reported("real_maps", lambda: main(sys.argv[1:])))
