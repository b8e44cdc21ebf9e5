"""`footprint recommend` as a whole: the document against its schema, and the choice against an exhaustive run."""

import copy
import json
import re
import subprocess
import sys
import unittest

from generated_model import model
from recommendations import disagreement, disagreements
from whole_runs import PROGRAM, SOURCE, WholeRunTest, results_of, run

sys.path.insert(0, str(SOURCE / "tests" / "report"))
from schema_test import jsonschema  # exit code 77 without the package python3-jsonschema

SMALL = ["--size", "64x64", "--spp", "32", "--repeats", "3", "--footprints", "trilinear,anisotropic:8", "--quiet"]
METHODS = "direct,toksvig,lean"


def document_of(folder):
    return json.loads((folder / "recommend.json").read_text(encoding="utf-8"))


def file_of(footprint):
    return footprint.replace(":", "_")


def candidate(method, cost, error=0.05):
    spread = {"median": cost, "low": 0.95 * cost, "high": 1.05 * cost}
    return {"method": method, "footprint": "trilinear", "error": error, "worst": error, "noise": 0.001, "cost": spread}


class RecommendTest(WholeRunTest):
    @classmethod
    def recommend(cls, name, scene, *arguments):
        folder = cls.folder / name
        output = run("recommend", scene, "--methods", METHODS, *SMALL, *arguments, "-o", folder)
        return folder, output

    @staticmethod
    def validator():
        schema = json.loads((SOURCE / "docs" / "recommend.schema.json").read_text(encoding="utf-8"))
        jsonschema.Draft7Validator.check_schema(schema)
        return jsonschema.Draft7Validator(schema)

    def test_document_matches_its_schema(self):
        folder, _ = self.recommend("schema", model(self.folder / "model", 3, 3, 64), "--distance", "1")
        document = document_of(folder)
        validator = self.validator()
        validator.validate(document)
        self.assertEqual(len(document["materials"]), 3)
        for change in (
            lambda d: d.update(schema="footprint-recommend/0"),
            lambda d: d["limits"].update(max_error=-1),
            lambda d: d["materials"][0].update(chosen=-1),
        ):
            wrong = copy.deepcopy(document)
            change(wrong)
            self.assertFalse(validator.is_valid(wrong))

    def test_page_shows_what_the_text_says(self):
        folder, output = self.recommend("page", "v_grooves", "--distance", "4")
        page = (folder / "index.html").read_text(encoding="utf-8")
        for words in document_of(folder)["materials"][0]["words"]:
            self.assertIn(words, output)
        command = document_of(folder)["materials"][0]["command"]
        self.assertIn(f"Bake it: {command}\n", output)
        data = json.loads(re.search(r'id="data">(.*?)</script>', page, re.DOTALL)[1])
        section = data["sections"][0]
        self.assertEqual(section["sentences"], document_of(folder)["materials"][0]["words"])
        self.assertEqual(section["command"], command)
        self.assertEqual([point["name"] for point in section["plot"]["points"]], [" · ".join(row[:2]) for row in section["table"]["rows"]])
        for image in data["views"][0]["images"]:
            for file in filter(None, (image["png"], image["values"], image["error"])):
                self.assertTrue((folder / file).is_file(), file)
        self.assertNotIn("{{", page)
        for report in document_of(folder)["reports"]:
            self.assertTrue((folder / report).is_file(), report)
        for record in results_of(folder / "trilinear")["records"]:
            error = record["error"]
            self.assertEqual([error["representation"], error["filtering"], error["light"]], [None] * 3)
            self.assertGreater(error["normalized_color"], 0)
        for source in page.split('<img src="')[1:]:
            self.assertTrue((folder / source.split('"', 1)[0]).is_file(), source)

    def test_a_killed_run_has_a_first_answer_and_resumes(self):
        folder = self.folder / "killed"
        arguments = ["recommend", "v_grooves", "--methods", METHODS, "--footprints", "trilinear,anisotropic:8", "--size", "256x256", "--distance", "2", "-o", folder]
        killed = subprocess.Popen([PROGRAM, *map(str, arguments)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.addCleanup(killed.communicate)
        self.assertEqual(killed.stdout.readline(), "First answer (coarse, 25% of the pixels):\n")
        self.assertRegex(killed.stdout.readline(), r"  \S+: (Use|Do not filter)")
        killed.kill()
        killed.wait()
        self.assertFalse((folder / "recommend.json").exists())
        [hidden] = [*self.folder.glob(".killed.partial-*"), *folder.glob(".killed.partial-*")]
        answer = document_of(hidden)
        self.assertEqual((answer["coarse"], answer["measured"], answer["reports"]), (0.25, 0, []))
        self.validator().validate(answer)
        self.assertIn("the run is not finished", (hidden / "index.html").read_text(encoding="utf-8"))

        resumed = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, check=True)
        self.assertIn("finished parts of an earlier run were reused", resumed.stderr)
        self.assertNotIn("coarse, trilinear, bake", resumed.stderr)
        self.assertFalse(hidden.exists())
        document = document_of(folder)
        self.assertIsNone(document["coarse"])
        again = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, check=True)
        self.assertNotIn("reference, ", again.stderr)
        self.assertEqual(document_of(folder), document)
        fresh = subprocess.run([PROGRAM, *map(str, arguments), "--fresh"], capture_output=True, text=True, check=True)
        self.assertNotIn("were reused", fresh.stderr)

    def test_a_reference_is_resumed_for_the_filters_that_follow(self):
        """Methods under shaded:2 would need more samples than those under the first filter, which are not measured again."""
        def references(name, *filters):
            folder = self.folder / name
            for listed in filters:
                run("recommend", *self.SHOTS, "--exhaustive", "--methods", "direct,toksvig", "--footprints", listed, "-o", folder)
            return [(folder / "shaded_2" / "images" / f"d{distance}_reference.exr").read_bytes() for distance in (1, 4)]

        self.assertEqual(references("resumed", "trilinear", "trilinear,shaded:2"), references("at_once", "trilinear,shaded:2"))

    def test_agrees_with_an_exhaustive_run(self):
        """With a limit that plain direct is beyond, and with none."""
        for scene, limit in (("v_grooves", ["--max-error", "0.1"]), ("worn_disk", [])):
            arguments = ["--distance", "4", *limit]
            quick, _ = self.recommend(f"{scene}_quick", scene, *arguments)
            whole, _ = self.recommend(f"{scene}_whole", scene, *arguments, "--exhaustive")
            self.assertEqual(disagreements(quick, whole), [], scene)
            whole_document = document_of(whole)
            self.assertEqual(whole_document["measured"], whole_document["tried"])
            if limit:
                advice = whole_document["materials"][0]
                worst = {(c["method"], c["footprint"]): c["worst"] for c in advice["candidates"]}
                chosen = advice["candidates"][advice["chosen"]]
                self.assertLessEqual(worst[chosen["method"], chosen["footprint"]], 0.1)
                self.assertGreater(worst["direct", "trilinear"], 0.1)

    SHOTS = ["v_grooves", "--distance", "1,4", "--size", "48x48", "--repeats", "1", "--quiet"]

    def test_a_reference_that_is_taken_over_is_what_it_would_have_been(self):
        """Measured behind another footprint filter, whose reference it takes over, and alone, by as many samples."""
        figures = {}
        for filters in ("box:2,anisotropic:8", "anisotropic:8", "box:2"):
            folder = self.folder / f"shared_{len(figures)}"
            options = ["--methods", METHODS, "--spp", "64", "--exhaustive", "--footprints", filters]
            run("recommend", *self.SHOTS, *options, "-o", folder)
            records = results_of(folder / file_of(filters.split(",")[-1]))["records"]
            figures[filters] = [(r["method"], r["distance"], r["error"]) for r in records]
        self.assertEqual(figures["box:2,anisotropic:8"], figures["anisotropic:8"])
        self.assertNotEqual(figures["box:2"], figures["anisotropic:8"])

    def test_all_filters_are_measured_against_one_reference(self):
        """Its noise is a part of every error: against another one, drawn until two methods are separated that lie
        farther from one another, an error would be larger by nothing of the method's."""
        together, alone = self.folder / "together", self.folder / "alone"
        shots = [*self.SHOTS, "--exhaustive", "--spp-max", "256"]
        run("recommend", *shots, "--methods", METHODS, "--footprints", "trilinear,shaded:2", "-o", together)
        run("recommend", *shots, "--methods", "direct", "--footprints", "shaded:2", "-o", alone)

        def reference_of(folder):
            images = [folder / "images" / f"d{distance}_reference.exr" for distance in (1, 4)]
            return results_of(folder)["reference"]["samples"], [image.read_bytes() for image in images]

        self.assertEqual(reference_of(together / "trilinear"), reference_of(together / "shaded_2"))
        self.assertNotEqual(reference_of(alone / "shaded_2"), reference_of(together / "shaded_2"), "the gate")

    def test_a_disagreement_is_found(self):
        both = [candidate("direct", 1.0, error=0.2), candidate("lean", 2.0)]
        whole = {"chosen": 1, "nearest": None, "candidates": both}
        quick = {"chosen": 0, "nearest": None, "candidates": both}
        self.assertIn("exhaustively lean", disagreement(quick, whole))
        self.assertIn("exhaustively lean", disagreement(quick, whole, max_error=0.1))
        self.assertIsNone(disagreement(whole, whole))
        none = {"chosen": None, "nearest": None, "candidates": []}
        self.assertIsNotNone(disagreement(none, whole))

    def test_costs_that_two_runs_measure_the_other_way_round_are_no_disagreement(self):
        whole = {"chosen": 1, "nearest": None, "candidates": [candidate("toksvig", 1.3), candidate("lean", 1.0)]}
        stalled = {"chosen": 0, "nearest": None, "candidates": [candidate("toksvig", 1.1), candidate("lean", 1.5)]}
        for max_error in (None, 0.1):
            self.assertIsNone(disagreement(stalled, whole, max_error))
            # If the quick run saw that it is more expensive, did not measure the cheaper one, or took a larger error for it:
            saw = {**stalled, "candidates": [candidate("toksvig", 1.3), candidate("lean", 1.0)]}
            self.assertIn("exhaustively lean", disagreement(saw, whole, max_error))
            dropped = {**stalled, "candidates": [candidate("toksvig", 1.1)]}
            self.assertIn("exhaustively lean", disagreement(dropped, whole, max_error))
            worse = {**whole, "candidates": [candidate("toksvig", 1.3, error=0.2), candidate("lean", 1.0)]}
            self.assertIn("exhaustively lean", disagreement(stalled, worse, max_error))


if __name__ == "__main__":
    unittest.main()
