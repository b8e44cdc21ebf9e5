"""`footprint ndf` as a whole: the document against its schema, the pictures as other programs read them."""

import copy
import json
import re
import subprocess
import sys
import unittest

from whole_runs import SOURCE, WholeRunTest, run

sys.path.insert(0, str(SOURCE / "tests" / "report"))
from schema_test import jsonschema  # exit code 77 without the package python3-jsonschema

METHODS = ["toksvig", "toksvig:spread=2", "naive_mip"]


def ndf(folder, *arguments):
    run("ndf", *arguments, "--quiet", "-o", folder)
    return json.loads((folder / "ndf.json").read_text(encoding="utf-8"))


def channels_and_size(file):
    done = subprocess.run(["oiiotool", "--info", file], capture_output=True, text=True, check=True)
    return done.stdout.split(":", 1)[1]


class NdfTest(WholeRunTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.ndf_folder = cls.folder / "ndf"
        cls.document = ndf(cls.ndf_folder, "ribbed_plane", "--methods", ",".join(METHODS), "--picture-size", 64)

    def test_document_matches_its_schema(self):
        schema = json.loads((SOURCE / "docs" / "ndf.schema.json").read_text(encoding="utf-8"))
        jsonschema.Draft7Validator.check_schema(schema)
        validator = jsonschema.Draft7Validator(schema)
        validator.validate(self.document)
        for change in (
            lambda d: d.update(schema="footprint-ndf/0"),
            lambda d: d["truth"].update(peak=-1),
            lambda d: d["lobe"].update(narrowest="phong:1"),
        ):
            wrong = copy.deepcopy(self.document)
            change(wrong)
            self.assertFalse(validator.is_valid(wrong))

    def test_methods_are_keyed_as_written(self):
        self.assertEqual(list(self.document["methods"]), METHODS)

    def test_figures_are_what_they_must_be(self):
        exact, methods = self.document["truth"], self.document["methods"]
        self.assertAlmostEqual(exact["energy"], exact["expected_energy"], delta=1e-3)
        for name, method in methods.items():
            self.assertAlmostEqual(method["energy"], 1.0, delta=0.01, msg=name)
        self.assertLess(methods["toksvig"]["l2"], methods["naive_mip"]["l2"])

    def test_every_file_is_there_and_whole(self):
        images = [self.document["truth"]["images"]] + [m["images"] for m in self.document["methods"].values()]
        for group in images:
            self.assertIn("64 x   64, 1 channel, float openexr", channels_and_size(self.ndf_folder / group["density"]))
            for key in set(group) - {"density"}:
                self.assertIn("64 x   64, 3 channel, uint8 png", channels_and_size(self.ndf_folder / group[key]))
        self.assertIn("3 channel, uint8 png", channels_and_size(self.ndf_folder / self.document["pictures"]["strip"]))

    def test_the_page_compares_every_density(self):
        page = (self.ndf_folder / "index.html").read_text(encoding="utf-8")
        data = json.loads(re.search(r'id="data">(.*?)</script>', page, re.DOTALL)[1])
        (view,) = data["views"]
        self.assertEqual([image["name"] for image in view["images"]], ["truth", *METHODS])
        for image in view["images"]:
            for file in filter(None, (image["png"], image["values"], image["error"])):
                self.assertTrue((self.ndf_folder / file).is_file(), file)
        least = min(METHODS, key=lambda name: self.document["methods"][name]["l2"])
        self.assertIn(least, data["answer"][0].split(" closest")[0])

    def test_runs_are_the_same_to_the_last_byte(self):
        again = self.folder / "again"
        self.assertEqual(ndf(again, "ribbed_plane", "--methods", ",".join(METHODS), "--picture-size", 64), self.document)
        for file in self.ndf_folder.rglob("*.png"):
            self.assertEqual(file.read_bytes(), (again / file.relative_to(self.ndf_folder)).read_bytes(), file)

    def test_a_map_of_unit_normals_is_what_it_says(self):
        """The same constant normal, as an EXR of -1 to 1 and as 16 bits of 0 to 1."""
        signed, stored = self.folder / "signed.exr", self.folder / "stored.png"
        for file, color, depth in ((signed, "0.6,0,0.8", "float"), (stored, "0.8,0.5,0.9", "uint16")):
            subprocess.run(["oiiotool", "--pattern", f"constant:color={color}", "8x8", "3", "-d", depth, "-o", file], check=True)
            document = ndf(self.folder / file.stem, file, "--methods", "direct,toksvig,lean", "--lobe", "vmf:100", "--picture-size", 32)
            self.assertEqual(document["texels"]["distinct"], 1)
            for name, method in document["methods"].items():
                self.assertLess(method["l2"], 1e-3, (file, name))

    def test_maps_without_unit_normals_are_refused(self):
        for color, message in (("0.8,0.5,0.9", "encoded as 0 to 1"), ("0,0,0", "no texel of the footprint has a normal")):
            file = self.folder / "wrong.exr"
            pattern = f"constant:color={color}"
            subprocess.run(["oiiotool", "--pattern", pattern, "8x8", "3", "-d", "float", "-o", file], check=True)
            with self.assertRaisesRegex(AssertionError, f"exit code 2: .*wrong.*{message}"):
                ndf(self.folder / "refused", file)
            self.assertFalse((self.folder / "refused").exists())


if __name__ == "__main__":
    unittest.main()
