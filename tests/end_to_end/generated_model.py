"""A glTF model of some materials, each with maps in which nothing is constant."""

import json
import random
import struct
import zlib


def png(side, seed):
    """A picture in which nothing is constant: rows of noise of 8 bits that point out of the surface as normals."""
    numbers = random.Random(seed)
    texel = lambda: (numbers.randrange(90, 166), numbers.randrange(90, 166), 230)
    row = b"\0" + bytes(channel for _ in range(side) for channel in texel())
    rows = b"".join(row[:1] + row[1 + 3 * (y % side) :] + row[1 : 1 + 3 * (y % side)] for y in range(side))
    chunk = lambda kind, data: struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    header = struct.pack(">IIBBBBB", side, side, 8, 2, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows, 1)) + chunk(b"IEND", b"")


def model(folder, count, sets, side):
    """Triangles side by side, each of a material of its own; sets of a colour, a roughness and a normal map in turn."""
    folder.mkdir()
    images, materials, meshes = [], [], []
    for i in range(3 * sets):
        (folder / f"map{i}.png").write_bytes(png(side, i))
        images.append({"uri": f"map{i}.png"})
    for i in range(count):
        texture = lambda kind: {"index": 3 * (i % sets) + kind}
        surface = {"baseColorTexture": texture(0), "metallicRoughnessTexture": texture(1)}
        materials.append({"pbrMetallicRoughness": surface, "normalTexture": texture(2)})
        meshes.append({"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "material": i}]})
    data = struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0) + struct.pack("<6f", 0, 0, 1, 0, 0, 1)
    (folder / "model.bin").write_bytes(data)
    document = {
        "asset": {"version": "2.0"},
        "buffers": [{"uri": "model.bin", "byteLength": len(data)}],
        "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 36},
                        {"buffer": 0, "byteOffset": 36, "byteLength": 24}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
                      {"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC2"}],
        "images": images, "textures": [{"source": i} for i in range(len(images))],
        "materials": materials, "meshes": meshes,
        "nodes": [{"mesh": i, "translation": [i, 0, 0]} for i in range(count)],
    }
    (folder / "model.gltf").write_text(json.dumps(document), encoding="utf-8")
    return folder / "model.gltf"
