"""`check --region`: claims whose region is known, shards of it, and what is refused."""

import json
import pathlib
import subprocess
import unittest

import jsonschema
from whole_runs import PROGRAM, SOURCE, WholeRunTest, run

EXPERIMENT = """[experiment]
title = "Known regions"
scene = "ribbed_plane"
methods = ["direct", "toksvig"]
size = [64, 64]
[zoom]
distances = [2]
[reference]
spp = 16
[[claim]]
name = "many_pixels"
text = "The plane covers more than 500 pixels."
inequality = "interior_pixels(toksvig, distance=2) > 500"
expect = "reproduced"
reason = "the plane covers 2601 pixels at distance 1"
[[claim]]
name = "small"
text = "The maps take less than 100 kB."
inequality = "bytes(toksvig) < 100000"
expect = "not_reproduced"
reason = "32-bit floats take 262 kB"
"""
REGION = """[region]
distance = [0.5, 1, 2]
size = ["32x32", "64x64"]
options = { toksvig = { storage = ["fp32", "unorm8"] } }
"""


class Region(WholeRunTest):
    def experiment(self, name, region=REGION):
        file = self.folder / f"{name}.toml"
        file.write_text(EXPERIMENT + region, encoding="utf-8")
        return file

    def refused(self, *arguments):
        done = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 2, done.stderr)
        return done.stderr

    def test_claims_are_true_where_they_must(self):
        out = self.folder / "whole"
        text = run("check", self.experiment("known"), "--region", "--quiet", "-o", out)
        region = json.loads((out / "region.json").read_text(encoding="utf-8"))
        many, small = region["claims"]
        self.assertEqual((many["stated"], small["stated"]), ("reproduced", "not_reproduced"))
        self.assertEqual(len(region["settings"]), 12)
        for setting, has_many, is_small in zip(region["settings"], many["outcomes"], small["outcomes"]):
            values = setting["values"]
            far, wide = float(values["distance"]), int(values["size"].split("x")[0])
            self.assertEqual(has_many, "reproduced" if 2601 * (wide / 64 / far) ** 2 / 4 > 500 else "not_reproduced", values)
            self.assertEqual(is_small, "reproduced" if "unorm8" in values["toksvig"] else "not_reproduced", values)
            self.assertTrue((out / setting["name"] / "results.json").is_file())
        self.assertIn("True in 6 of 12 settings, all of them with toksvig:storage=unorm8; at the stated setting it is false.", text)
        self.assertEqual((out / "table.md").read_text(encoding="utf-8").strip(), text.split("\npage: ")[0].strip())
        self.assertIn("True in 6 of 12 settings", (out / "index.html").read_text(encoding="utf-8"))
        validator = jsonschema.Draft7Validator(json.loads((SOURCE / "docs" / "region.schema.json").read_text(encoding="utf-8")))
        validator.validate(region)
        self.assertFalse(validator.is_valid(region | {"axes": [{"key": 1}]}))
        self.parts_are_joined_to_the_same(out)

    def parts_are_joined_to_the_same(self, whole):
        parts = [self.folder / "part1", self.folder / "part2"]
        for number, part in enumerate(parts, 1):
            run("run", self.experiment("known"), "--region", "--shard", f"{number}/2", "--quiet", "-o", part)
        run("merge", *parts, "--quiet", "-o", self.folder / "joined")
        documents = [json.loads(pathlib.Path(folder, "region.json").read_text(encoding="utf-8")) for folder in (whole, self.folder / "joined")]
        self.assertEqual(documents[0]["claims"], documents[1]["claims"])
        self.assertEqual(documents[0]["settings"], documents[1]["settings"])

    def test_a_stated_outcome_that_is_not_expected_fails(self):
        file = self.experiment("other", '[region]\nsize = ["64x64"]\n')
        file.write_text(file.read_text(encoding="utf-8").replace('"not_reproduced"', '"reproduced"'), encoding="utf-8")
        done = subprocess.run([PROGRAM, "check", file, "--region", "--quiet", "-o", self.folder / "other"], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertTrue((self.folder / "other" / "region.json").is_file())

    def test_faults_are_named(self):
        out = ["--quiet", "-o", self.folder / "faulty"]
        self.assertIn("has no [region]", self.refused("check", self.experiment("none", ""), "--region", *out))
        self.assertIn("excludes --region", self.refused("check", self.experiment("known"), "--region", "--only", "1", *out))
        self.assertIn("is of one experiment", self.refused("run", "--all", "--region", *out))
        for region, fault in (("[region]\n", "varies nothing"), ("[region]\nsize = [\"8x8\", \"8x8\"]\n", "twice"),
                              ("[region]\ndistance = [1, 1]\n", "twice"), ("[region]\nscene = [\"bumps\"]\n", "unknown"),
                              ("[region]\noptions = { toksvig = { storage = [\"fp12\"] } }\n", "fp12"),
                              ("[region]\nseed = [1]\n[matrix]\nsize = [\"8x8\"]\n", "matrix")):
            said = self.refused("run", self.experiment("faulty", region), *out)
            self.assertIn(fault, said)
            self.assertRegex(said, r"faulty\.toml:\d+")


if __name__ == "__main__":
    unittest.main()
