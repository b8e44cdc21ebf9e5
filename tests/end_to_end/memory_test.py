"""What `explain` says that a model's maps take at their peak, held against what they take: 4 times the maps at most."""

import json
import os
import random
import struct
import subprocess
import unittest
import zlib

from whole_runs import PROGRAM, WholeRunTest

# Materials, sets of maps that they share out among them, texels a side; a single one's bake weighs most.
MODELS = {"several": (2, 2, 1024), "single": (1, 1, 2048), "shared": (6, 1, 1024)}
LEAST, MOST = 0.75, 1.25  # of the estimate


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


def explained(file, method):
    """What `explain` says, and the most memory that it took, in bytes."""
    command = [PROGRAM, "explain", file, "--method", method, "--json", "--quiet"]
    process = subprocess.Popen(command, stdout=subprocess.PIPE)
    text = process.stdout.read()
    process.stdout.close()
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        raise AssertionError(f"explain {file}: exit code {process.returncode}")
    return json.loads(text)["memory"], 1024 * usage.ru_maxrss


def holds(measured, estimated):
    return LEAST * estimated <= measured <= MOST * estimated


class MemoryTest(WholeRunTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.without_maps = explained(model(cls.folder / "small", 2, 2, 4), "toksvig")[1]  # program and driver alone

    def test_peak_is_as_estimated_and_below_four_times_the_decoded_maps(self):
        for name, (count, sets, side) in MODELS.items():
            file = model(self.folder / name, count, sets, side)
            for method in ("toksvig", "lean"):
                with self.subTest(model=name, method=method):
                    self.hold(*explained(file, method), sets * side * side, name, method)

    def hold(self, memory, peak, texels, name, method):
        measured, estimated = peak - self.without_maps, memory["estimated_peak"]
        print(f"{name}, {method}: {measured / estimated:.2f} of the estimate, "
              f"{measured / memory['decoded_maps']:.2f} times the decoded maps")
        self.assertEqual(memory["decoded_maps"], texels * 4 * (4 + 2 + 4))
        # Two bytes of colour, one of roughness, two of normals: each map's third channel is constant.
        self.assertLess(abs(memory["kept_maps"] - texels * (2 + 1 + 2)), 0.01 * texels)
        self.assertLess(measured, 4 * memory["decoded_maps"])
        self.assertTrue(holds(measured, estimated), f"{measured} measured, {estimated} estimated")
        for wrong in (0.5, 2.0):  # an estimate that forgets what lies there, or counts it twice
            self.assertFalse(holds(measured, wrong * estimated))


if __name__ == "__main__":
    unittest.main()
