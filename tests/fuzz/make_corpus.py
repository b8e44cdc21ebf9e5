"""Writes what the fuzzers start from, a folder a reader: a small file of each kind that the reader takes.

  make_corpus.py PROGRAM FOLDER      PROGRAM: footprint, which renders and bakes some of them
"""
import base64
import json
import os
import pathlib
import shutil
import struct
import subprocess
import sys
import tempfile

SOURCE = pathlib.Path(__file__).resolve().parents[2]
POSITIONS = (-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0)
UVS = (0, 1, 1, 1, 1, 0, 0, 0)
NORMALS = (0, 0, 1) * 4
INDICES = (0, 1, 2, 0, 2, 3)


def quad_buffer():
    """The bytes of a quad, and the views of positions, normals, uvs and indices in them."""
    parts = [struct.pack(f"<{len(values)}f", *values) for values in (POSITIONS, NORMALS, UVS)]
    parts.append(struct.pack("<6H", *INDICES))
    views, offset = [], 0
    for part in parts:
        views.append({"buffer": 0, "byteOffset": offset, "byteLength": len(part)})
        offset += len(part)
    return b"".join(parts), views


def quad(buffer):
    """A glTF document of that quad with what the loader reads: material, camera, light, a map."""
    _, views = quad_buffer()
    texture = {"index": 0, "extensions": {"KHR_texture_transform": {"scale": [2, 2], "rotation": 0.5}}}
    return {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
        "extensionsUsed": ["KHR_lights_punctual", "KHR_texture_transform"],
        "extensions": {"KHR_lights_punctual": {"lights": [{"type": "spot", "spot": {"outerConeAngle": 0.5}}]}},
        "nodes": [{"mesh": 0, "rotation": [0, 0, 0, 1]},
                  {"camera": 0, "translation": [0, 0, 5], "extensions": {"KHR_lights_punctual": {"light": 0}}}],
        "cameras": [{"type": "perspective", "perspective": {"yfov": 0.5, "znear": 0.1}}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2}, "indices": 3,
                                    "material": 0}]}],
        "materials": [{"normalTexture": texture, "alphaMode": "MASK",
                       "pbrMetallicRoughness": {"roughnessFactor": 0.3, "metallicFactor": 0.5}}],
        "textures": [{"source": 0, "sampler": 0}], "samplers": [{"wrapS": 33071, "wrapT": 33648}],
        "images": [{"uri": "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADElEQVR4nGNoaPgPAAMEAgFgOK+"
                           "NAAAAAElFTkSuQmCC"}],
        "buffers": [buffer], "bufferViews": views,
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [-1, -1, 0], "max": [1, 1, 0]},
            {"bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC3"},
            {"bufferView": 2, "componentType": 5126, "count": 4, "type": "VEC2"},
            {"bufferView": 3, "componentType": 5123, "count": 6, "type": "SCALAR"}]}


def gltf():
    data, _ = quad_buffer()
    uri = "data:application/octet-stream;base64," + base64.b64encode(data).decode()
    return json.dumps(quad({"byteLength": len(data), "uri": uri})).encode()


def glb():
    data, _ = quad_buffer()
    text = json.dumps(quad({"byteLength": len(data)})).encode()
    text += b" " * (-len(text) % 4)
    data += b"\0" * (-len(data) % 4)
    body = struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(data), b"BIN\0") + data
    return struct.pack("<4sII", b"glTF", 2, 12 + len(body)) + body


def pictures(program, folder, scratch):
    """Small files of the formats that OpenImageIO reads for us, and a results.json that lists some."""
    surface = scratch / "surface.exr"
    subprocess.run([program, "surface", "bumps", "--resolution", "16", "-o", surface], check=True, capture_output=True)
    for name in ("map.exr", "map.png", "map.hdr", "map.jpg", "map.tif", "map.tga", "map.bmp", "map.webp"):
        subprocess.run(["oiiotool", surface, "--ch", "R,G,B", "--resize", "8x4", "-o", folder / "picture" / name],
                       check=False, capture_output=True)
    data = (folder / "picture" / "map.hdr").read_bytes().partition(b"\n\n")[2].partition(b"\n")[2]
    head = b"#?RADIANCE\nEXPOSURE=2\nCOLORCORR=1 2 4\nPRIMARIES=.7 .3 .2 .7 .1 .1 .3 .3\nFORMAT=32-bit_rle_xyze\n\n"
    (folder / "picture" / "declared.hdr").write_bytes(head + b"+X 4 +Y 8\n" + data)
    for picture in (folder / "picture").iterdir():  # as data there, as pictures here
        shutil.copy(picture, folder / "environment" / picture.name)


SMALL_EXPERIMENT = """[experiment]
title = "A small one"
scene = "{scene}"
size = [8, 8]
methods = ["direct", "toksvig:spread=0.5"]
repeats = 1
[reference]
spp = 1
[zoom]
distances = [1, 2]
[threshold]
"error(toksvig)" = 1
[[claim]]
name = "closer"
text = "One is closer."
inequality = "error(toksvig) < 0.6 * error(direct)"
expect = "reproduced"
reason = "it is"
[[ndf]]
name = "one"
footprint = [0.1, 0.1, 0.3, 0.3]
"""


def parts(program, folder, scratch):
    """The project's own experiments, and what a part of a small one says of itself."""
    for experiment in SOURCE.glob("experiments/*.toml"):
        shutil.copy(experiment, folder / "experiment" / experiment.name)
    small = scratch / "small.toml"
    small.write_text(SMALL_EXPERIMENT.format(scene=SOURCE / "scenes/bumps"))
    shutil.copy(small, folder / "experiment" / "small.toml")
    subprocess.run([program, "run", small, "--shard", "1/2", "-q", "-o", scratch / "part"], check=True,
                   capture_output=True)
    shutil.copy(scratch / "part" / "part.json", folder / "part" / "part.json")


def runs(program, folder, scratch):
    """A results.json."""
    out = scratch / "out"
    subprocess.run([program, "compare", "bumps", "--methods", "direct,fournier", "--size", "8x8", "--spp", "1", "--repeats",
                    "1", "--quiet", "-o", out], check=True, capture_output=True,
                   env=os.environ | {"FOOTPRINT_CACHE": str(scratch / "cache")})
    shutil.copy(out / "results.json", folder / "results" / "results.json")


# A plane with the map beside it: what is baked of 16 x 16 texels stays small.
PLANE = """
[plane]
size = [2.0, 2.0]
normal_map = "map.png"
[camera]
frame_bounds = { direction = [0.0, 0.0, 1.0] }
[[light]]
type = "directional"
direction = [0.0, 0.0, -1.0]
intensity = 1.0
"""


def bakes(program, folder, scratch):
    """The cache files of two methods for a small map."""
    subprocess.run([program, "surface", "bumps", "--resolution", "16", "-o", scratch / "map.png"], check=True,
                   capture_output=True)
    (scratch / "plane.toml").write_text(PLANE)
    for method in ("fournier:peaks=2", "tan_gmm:n=2"):
        subprocess.run([program, "render", scratch / "plane.toml", "--method", method, "--size", "8x8", "-q", "-o",
                        scratch / "a.exr"], check=True, capture_output=True,
                       env=os.environ | {"FOOTPRINT_CACHE": str(scratch / "bakes")})
    for entry in (scratch / "bakes").glob("*.bake"):
        shutil.copy(entry, folder / "cache_entry" / entry.name)


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    program, folder = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])
    for reader in ("gltf", "glb", "obj", "mtl", "merl", "picture", "environment", "scene", "method", "cache_entry", "experiment",
                   "part", "results"):
        (folder / reader).mkdir(parents=True, exist_ok=True)
    (folder / "gltf" / "quad.gltf").write_bytes(gltf())
    (folder / "glb" / "quad.glb").write_bytes(glb())
    (folder / "obj" / "quad.obj").write_text(
        "mtllib a.mtl\no quad\nv -1 -1 0\nv 1 -1 0 0.5\nv 1 1 0\nv -1 1 0\nvt 0 1\nvt 1 1\nvt 1 0\nvt 0 0\nvn 0 0 1\n"
        "usemtl a\ns 1\nf 1/1/1 2/2/1 3/3/1 4/4/1\nf -4//1 -3//1 -2//1\n")
    (folder / "obj" / "odd.obj").write_text(
        "\ufefff 1 2 3 4 5\nv 0 0 0\nv 1 0 0 \\\n 1 0 0\nv +1 1 0 2\nv 0.5 0.2 1e-60\nv 0 1 0\nvt 0\nv 1.#IND nan inf\n"
        "usemtl b\nl 1 2\nfo 1/1 -4/1 3/1 # a comment\n")
    (folder / "mtl" / "a.mtl").write_text(
        "newmtl a\nKd 0.8 0.1 0.1\nKs 0.5\nNs 200\nPr 0.5\nPm 1\nKe 0 1 0\nd 0.5\nmap_Kd -s 2 2 1 -o 0.5 -clamp on a b.png\n"
        "map_Bump -bm 0.5 -imfchan r input.mtl\nnorm -t 1 1 n.png\nmap_Pr \"r.png\"\nnewmtl b\nKd spectral a.rfl\n")
    (folder / "merl" / "small.binary").write_bytes(struct.pack("<3i", 90, 90, 180) + struct.pack("<6d", *range(6)))
    (folder / "merl" / "other.binary").write_bytes(struct.pack("<3i", 1, 1, 1) + struct.pack("<3d", 1, 2, 3))
    for scene in SOURCE.glob("scenes/*/scene.toml"):
        shutil.copy(scene, folder / "scene" / f"{scene.parent.name}.toml")
    for method in ("toksvig", "naive_mip"):
        shutil.copy(SOURCE / "methods" / method / f"{method}.glsl", folder / "method")
    with tempfile.TemporaryDirectory() as scratch:
        pictures(program, folder, pathlib.Path(scratch))
        runs(program, folder, pathlib.Path(scratch))
        parts(program, folder, pathlib.Path(scratch))
        bakes(program, folder, pathlib.Path(scratch))


if __name__ == "__main__":
    main()
