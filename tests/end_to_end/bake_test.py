"""`footprint bake` as a whole: the manifest against its schema, the maps as other programs read them."""

import copy
import json
import re
import struct
import subprocess
import sys
import unittest

from generated_model import model
from whole_runs import PROGRAM, SOURCE, WholeRunTest, results_of, run

sys.path.insert(0, str(SOURCE / "tests" / "report"))
from schema_test import jsonschema  # exit code 77 without the package python3-jsonschema


def bake(folder, *arguments):
    run("bake", *arguments, "--quiet", "-o", folder)
    return json.loads((folder / "manifest.json").read_text(encoding="utf-8"))


# What only `--bakes` reads, and manifests of older versions lack.
OPTIONAL = {"method_file", "method_notes", "surface_coordinates", "lookup", "vertex_set"}


def described(node, place):
    """Every property says what it is, and every object says which keys it takes."""
    assert node.get("description"), f"{place} has no description"
    if "object" in node.get("type", ""):
        assert "additionalProperties" in node, f"{place} takes any key"
    for name, child in node.get("properties", {}).items():
        described(child, f"{place}/{name}")
        assert (name in node["required"]) != (name in OPTIONAL), f"{place}/{name} may be left out"
    if "items" in node:
        described(node["items"], f"{place}/items")


def schema_of_bakes():
    schema = json.loads((SOURCE / "docs" / "bake.schema.json").read_text(encoding="utf-8"))
    jsonschema.Draft7Validator.check_schema(schema)
    return schema


class BakeTest(WholeRunTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.maps = cls.folder / "maps"
        cls.manifest = bake(cls.maps, "v_grooves", "--method", "toksvig:storage=unorm8")

    def test_manifest_matches_its_schema(self):
        schema = schema_of_bakes()
        described(schema, "")
        validator = jsonschema.Draft7Validator(schema)
        validator.validate(self.manifest)
        texture = lambda d: d["materials"][0]["textures"][0]
        for change in (
            lambda d: d.update(extra=1),
            lambda d: d.update(schema="footprint-bake/0"),
            lambda d: d.pop("module"),
            lambda d: d.update(materials=[]),
            lambda d: d["brdf"].update(distribution="phong"),
            lambda d: d["materials"][0]["uniforms"].update(lobe_cutoff="1"),
            lambda d: texture(d).update(storage="fp64"),
            lambda d: texture(d).update(channels=5),
            lambda d: texture(d).update(levels=[]),
            lambda d: texture(d)["coordinates"].update(wrap=["repeat"]),
            lambda d: texture(d).update(exr=[]),
        ):
            wrong = copy.deepcopy(self.manifest)
            change(wrong)
            self.assertFalse(validator.is_valid(wrong))

    def test_several_materials_hold_to_it_too(self):
        manifest = bake(self.folder / "spheres", "bi_scale_spheres", "--method", "naive_mip:storage=fp16")
        jsonschema.Draft7Validator(schema_of_bakes()).validate(manifest)
        self.assertGreater(len(manifest["materials"]), 1)
        folders = {file.rsplit("/", 1)[0] for m in manifest["materials"] for t in m["textures"] for file in t["exr"]}
        self.assertEqual(len(folders), sum(bool(m["textures"]) for m in manifest["materials"]))

    def test_exr_has_its_levels_to_openimageio(self):
        for texture in self.manifest["materials"][0]["textures"]:
            done = subprocess.run(
                ["oiiotool", "--info", "-v", self.maps / texture["exr"][0]], capture_output=True, text=True, check=True
            )
            levels = [f"{width}x{height}" for width, height in texture["levels"]]
            self.assertIn("MIP-map levels: " + " ".join(levels), done.stdout)

    def test_png_is_exr_in_bytes(self):
        texture = self.manifest["materials"][0]["textures"][0]
        self.assertEqual(len(texture["png"]), len(texture["levels"]))
        for level, (png, size) in enumerate(zip(texture["png"], texture["levels"])):
            done = subprocess.run(["oiiotool", "--info", self.maps / png], capture_output=True, text=True, check=True)
            self.assertTrue(re.search(rf"{size[0]} x\s+{size[1]}, 3 channel, uint8 png", done.stdout), done.stdout)
            exr = self.folder / f"level{level}.exr"
            subprocess.run(
                ["oiiotool", self.maps / texture["exr"][0], "--selectmip", str(level), "-o", exr], check=True
            )
            self.assert_alike(exr, self.maps / png, 1e-6)

    def test_summary_names_maps_and_manifest(self):
        output = run("bake", "v_grooves", "--method", "toksvig", "--quiet", "-o", self.folder / "again")
        self.assertIn("mean_normal: ", output)
        self.assertIn(str(self.folder / "again" / "manifest.json"), output)


class ReadBackTest(WholeRunTest):
    """The maps of a bake as those of a run: the same bytes, until they are changed."""

    SMALL = ["--size", "32x32"]

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.scene = model(cls.folder / "model", count=2, sets=2, side=16)

    def refusal(self, *arguments):
        """The last line of a run that ends with exit code 2 and leaves nothing."""
        out = self.folder / "refused.exr"
        done = subprocess.run([PROGRAM, *map(str, arguments), "--quiet", "-o", out], capture_output=True, text=True,
                              check=False)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertFalse(out.exists())
        return done.stderr.strip().splitlines()[-1]

    def test_pictures_have_the_same_bytes(self):
        # Plain maps, arrays, tables, and maps that the GPU builds.
        for method in ("toksvig:storage=fp16", "tan_gmm", "ndf_atlas", "xu_vmf:j=4"):
            name = method.replace(":", "_")
            bake(self.folder / name, self.scene, "--method", method)
            own = self.render(f"own_{name}", self.scene, "--method", method, *self.SMALL)
            read = self.render(f"read_{name}", self.scene, "--method", method, "--bakes", self.folder / name, *self.SMALL)
            self.assertEqual(own.read_bytes(), read.read_bytes(), method)

    def test_compare_takes_several_folders_and_bakes_the_rest(self):
        methods = ["direct", "toksvig", "lean:storage=fp16"]
        arguments = [self.scene, "--methods", ",".join(methods), "--distance", "1", "--spp", "4", *self.SMALL]
        own = results_of(self.compare("own", *arguments))
        for name, method in (("toksvig", methods[1]), ("lean", methods[2])):
            bake(self.folder / f"of_{name}", self.scene, "--method", method)
            arguments += ["--bakes", self.folder / f"of_{name}"]
        given = results_of(self.compare("given", *arguments))
        for before, after in zip(own["records"], given["records"]):
            first, second = (self.folder / folder / record["images"]["color"]
                             for folder, record in (("own", before), ("given", after)))
            self.assertEqual(first.read_bytes(), second.read_bytes(), after["method"])
            self.assertEqual(after["precompute"]["cached"], after["method"] != "direct")
            self.assertEqual(after["precompute"]["bytes"], before["precompute"]["bytes"])
        warnings = "\n".join(given["scene"]["warnings"])
        self.assertIn(f"maps from {self.folder / 'of_lean'}", warnings)
        self.assert_matches_schema(self.folder / "given")

    def test_changed_texels_change_the_picture(self):
        maps = self.folder / "changed"
        manifest = bake(maps, self.scene, "--method", "toksvig")
        arguments = [self.scene, "--method", "toksvig", "--bakes", maps, *self.SMALL]
        before = self.render("before", *arguments).read_bytes()
        for texture in manifest["materials"][0]["textures"]:
            file = maps / texture["ktx2"]
            data = bytearray(file.read_bytes())
            offset, length = struct.unpack_from("<QQ", data, 80)  # of the finest level
            data[offset : offset + length] = struct.pack("<f", 0.25) * (length // 4)
            file.write_bytes(data)
        self.assertNotEqual(self.render("after", *arguments).read_bytes(), before)

    def test_each_difference_is_refused(self):
        maps = self.folder / "refused"
        bake(maps, self.scene, "--method", "toksvig")
        given = ["--bakes", maps, *self.SMALL]
        self.assertIn("not of lean", self.refusal("render", self.scene, "--method", "lean", *given))
        self.assertIn("option storage is fp32 there and fp16 here",
                      self.refusal("render", self.scene, "--method", "toksvig:storage=fp16", *given))
        self.assertIn("which has no maps", self.refusal("render", self.scene, "--method", "reference", *given))
        self.assertIn("for 2 materials", self.refusal("render", "v_grooves", "--method", "toksvig", *given))
        self.assertIn("which is none of the run's methods",
                      self.refusal("compare", self.scene, "--methods", "direct,lean", *given))
        self.assertIn("give one of them", self.refusal("compare", self.scene, "--bakes", maps, *given))
        self.assertIn("the maps are for",
                      self.refusal("compare", self.scene, "--without", "normal_variation", *given))
        self.assertIn("no such file", self.refusal("render", self.scene, "--method", "toksvig", "--bakes", self.folder))
        next((maps / "maps").rglob("*.ktx2")).unlink()
        self.assertIn("copy the whole folder", self.refusal("render", self.scene, "--method", "toksvig", *given))


if __name__ == "__main__":
    unittest.main()
