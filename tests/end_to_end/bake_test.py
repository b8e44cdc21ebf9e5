"""`footprint bake` as a whole: the manifest against its schema, the maps as other programs read them."""

import copy
import json
import re
import subprocess
import sys
import unittest

from whole_runs import SOURCE, WholeRunTest, run

sys.path.insert(0, str(SOURCE / "tests" / "report"))
from schema_test import jsonschema  # exit code 77 without the package python3-jsonschema


def bake(folder, *arguments):
    run("bake", *arguments, "--quiet", "-o", folder)
    return json.loads((folder / "manifest.json").read_text(encoding="utf-8"))


def described(node, place):
    """Every property says what it is, and every object says which keys it takes."""
    assert node.get("description"), f"{place} has no description"
    if "object" in node.get("type", ""):
        assert "additionalProperties" in node, f"{place} takes any key"
    for name, child in node.get("properties", {}).items():
        described(child, f"{place}/{name}")
        assert name in node["required"], f"{place}/{name} may be left out"
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


if __name__ == "__main__":
    unittest.main()
