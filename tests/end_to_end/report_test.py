"""The files of one comparison, read as a user's own programs would: schema, CSV, page, pictures, and what they say."""

import csv
import html.parser
import json
import math
import re
import subprocess
import sys
import unittest

from whole_runs import SOURCE, WholeRunTest, picture_facts, results_of, run

METHODS = ["direct", "naive_mip", "toksvig"]
NEAR, FAR = 1, 6


class References(html.parser.HTMLParser):
    """The files that a page loads: the values of src and href."""

    def __init__(self):
        super().__init__()
        self.found = []

    def handle_starttag(self, tag, attrs):
        self.found += [value for name, value in attrs if name in ("src", "href")]


class Report(WholeRunTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.out = cls.compare("out", "ribbed_plane", "--size", "64x64", "--spp", "256", "--distance", f"{NEAR},{FAR}")
        cls.results = results_of(cls.out)
        cls.records = {(record["method"], record["distance"]): record for record in cls.results["records"]}

    def error(self, method, distance, key="normalized_color"):
        return self.records[method, distance]["error"][key]

    def test_a_finest_level_has_no_noise_of_the_environments_directions(self):
        """Over a smooth sphere it is what many frames average to."""
        out = self.compare("lit", "glossy_sphere", "--size", "48x48", "--distance", "1", "--methods", "direct")
        found = results_of(out)
        self.assertLess(found["records"][0]["error"]["representation"], 1.25 * found["supersampling"][-1]["normalized_color"])

    # The files.

    def test_the_results_hold_to_their_schema(self):
        validator = SOURCE / "tests" / "report" / "schema_test.py"
        schema = SOURCE / "docs" / "results.schema.json"
        command = [sys.executable, "-B", validator, schema, self.out / "results.json"]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode == 77:
            self.skipTest(done.stdout.strip())
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_the_csv_has_a_row_a_record(self):
        with (self.out / "results.csv").open(encoding="utf-8", newline="") as file:
            rows = list(csv.DictReader(file, strict=True))
        self.assertEqual([(row["method"], float(row["distance"])) for row in rows], list(self.records))
        for row, record in zip(rows, self.records.values(), strict=True):
            self.assertNotIn(None, row, "a row is longer than the header")
            self.assertEqual(float(row["normalized_color_error"]), record["error"]["normalized_color"])
            self.assertEqual(float(row["frame_median_ms"]), record["time"]["frame_ms"]["median"])

    def test_the_page_asks_for_nothing_that_is_not_there(self):
        text = (self.out / "index.html").read_text(encoding="utf-8")
        references = References()
        references.feed(text)
        loaded = [path for path in references.found if not path.startswith(("data:", "#"))]
        pictures = set(re.findall(r"images/[\w.-]+\.(?:exr|png)", text))
        self.assertGreaterEqual(len(pictures), 2 * (1 + 2 * len(METHODS)))
        for path in [*loaded, *pictures]:
            self.assertTrue((self.out / path).is_file(), path)
        for image in {record["images"][kind] for record in self.records.values() for kind in ("color", "reference")}:
            self.assertTrue((self.out / image.replace(".exr", "_values.js")).is_file(), image)

    def test_every_picture_of_a_record_is_there(self):
        for record in self.records.values():
            for path in record["images"].values():
                self.assertTrue((self.out / path).is_file(), path)
                if path != record["images"]["standard_error"]:  # no picture to look at
                    self.assertTrue((self.out / path).with_suffix(".png").is_file(), path)

    def test_the_pictures_are_whole(self):
        files = sorted((self.out / "images").glob("*.exr"))
        self.assertEqual(len(files), 2 * (3 + len(METHODS)))  # the reference, its standard error, interior pixels, methods
        for name, facts in picture_facts(files).items():
            self.assertEqual(facts["size"], (64, 64), name)
            self.assertEqual(facts["format"], "float openexr", name)
            if str(name).endswith("_standard_error.exr"):
                self.assertEqual(facts["channels"], "R, G, B", name)
                continue
            self.assertEqual(facts["channels"], "R, G, B, A", name)
            self.assertEqual(facts["unusable"], [0] * 8, name)
            self.assertGreaterEqual(min(facts["least"]), 0.0, name)
            self.assertEqual(facts["most"][3], 1.0, name)

    # Their content.

    def test_the_filtered_method_is_nearer_to_the_reference(self):
        self.assertLess(self.error("toksvig", FAR), self.error("direct", FAR))
        self.assertLess(self.error("naive_mip", FAR), self.error("direct", FAR))
        for method in METHODS:
            self.assertGreater(self.error(method, FAR), self.error(method, FAR, "noise_floor"), method)

    def test_the_finest_level_is_the_surface_itself(self):
        for method in METHODS:
            for distance in (NEAR, FAR):
                self.assertLess(self.error(method, distance, "representation"), 1e-5, method)

    def test_more_samples_leave_less_error(self):
        for distance in (NEAR, FAR):
            curve = {p["spp"]: p["normalized_color"] for p in self.results["supersampling"] if p["distance"] == distance}
            self.assertEqual(list(curve), [1, 2, 4, 8, 16, 32, 64])
            # Stratified samples beat the square root of their number; half of it is left to chance.
            self.assertLess(curve[64], curve[1] / 4)
            self.assertLess(curve[64], curve[8])

    def test_causes_make_up_the_error(self):
        for record in self.records.values():
            error, pixels = record["error"], record["pixels"]
            self.assertEqual(pixels["bound"], pixels["interior"], "the bound of a small picture is drawn whole")
            self.assertGreater(pixels["interior"], 20)
            self.assertLessEqual(error["shading"], error["filter"] + error["method"] + 1e-9)
            edges = pixels["object"] - pixels["interior"]
            whole = (error["shading"] * pixels["interior"] + (error["edges"] or 0.0) * edges) / pixels["object"]
            self.assertTrue(math.isclose(whole, error["normalized_color"], rel_tol=1e-9))
            self.assertIsNone(error["light"], "no environment")

    def test_no_bound_without_a_request(self):
        arguments = ["ribbed_plane", "--size", "32x32", "--spp", "4", "--distance", "2", "--bound", "off"]
        for record in results_of(self.compare("unbound", *arguments))["records"]:
            self.assertIsNone(record["error"]["filter"])
            self.assertIsNone(record["pixels"]["bound"])
            self.assertIsNotNone(record["error"]["shading"])

    def test_one_sample_is_a_frame_of_direct(self):
        for point in self.results["supersampling"]:
            if point["spp"] == 1:
                self.assertAlmostEqual(point["normalized_color"], self.error("direct", point["distance"]), 9)
                self.assertAlmostEqual(point["shading"], self.error("direct", point["distance"], "shading"), 9)

    def test_direct_is_the_unit_of_time_and_of_samples(self):
        for distance in (NEAR, FAR):
            direct = self.records["direct", distance]
            self.assertEqual(direct["time"]["ratio_to_direct"], {"median": 1.0, "low": 1.0, "high": 1.0})
            self.assertEqual(direct["equivalent_spp"], 1.0)

    def test_the_unit_is_of_the_footprint_filter_that_is_named(self):
        settings = ["carved_disk", "--methods", "direct", "--size", "64x64", "--spp", "4", "--distance", "2"]
        for unit, is_own in {"trilinear": False, "anisotropic:8": True}.items():
            (record,) = results_of(self.compare(unit[:3], *settings, "--time-unit", unit))["records"]
            self.assertEqual(record["time"]["ratio_to_direct"]["median"] == 1.0, is_own)

    def test_each_distance_has_its_standard_error(self):
        errors = self.results["reference"]["standard_errors"]
        self.assertEqual(len(errors), 2)
        self.assertEqual(len(set(errors)), len(errors), "each reference has its own")

    def test_times_add_up(self):
        for record in self.records.values():
            time = record["time"]
            self.assertGreater(time["frame_ms"]["min"], 0.0)
            self.assertLessEqual(time["frame_ms"]["min"], time["frame_ms"]["median"])
            self.assertLessEqual(time["frame_ms"]["median"], time["frame_ms"]["p90"])
            self.assertTrue(math.isclose(time["fps"] * time["frame_ms"]["median"], 1000.0))

    def test_one_sample_has_no_noise_floor(self):
        one = results_of(self.compare("one", "ribbed_plane", "--size", "16x16", "--spp", "1", "--distance", "1"))
        self.assertEqual(one["reference"]["standard_errors"], [None])
        self.assertEqual([record["error"]["noise_floor"] for record in one["records"]], [None] * len(METHODS))

    def test_a_folder_that_is_used_again_keeps_no_image_of_the_earlier_run(self):
        settings = ["ribbed_plane", "--methods", "direct,toksvig", "--size", "24x20", "--spp", "8"]
        out = self.compare("used_again", *settings, "--distance", "1,2")
        (out / "images/notes.png").write_bytes(b"mine")
        self.compare("used_again", *settings, "--distance", "3")
        images = sorted(str(path.relative_to(out)) for path in out.glob("images/*"))
        self.assertEqual(results_of(out)["files"], [image for image in images if image != "images/notes.png"])
        self.assertTrue(all(image.startswith("images/d3_") for image in results_of(out)["files"]))
        self.assertIn("images/d3_all_errors.png", images)
        self.assertIn("images/notes.png", images, "a file of somebody else")

    def test_score_agrees_with_compare(self):
        """On images that `compare` wrote: the error, the exposure, and the pixels that count."""
        out = self.compare("clear", "clear_coat", "--distance", "4", "--size", "128x128", "--methods", "direct", "--spp", "64")
        record = results_of(out)["records"][0]
        self.assertGreater(record["pixels"]["unresolved"], 0, "a scene with unresolved pixels")
        score = self.folder / "scored"
        run("score", out / record["images"]["color"], "--reference", out / record["images"]["reference"], "-o", score)
        document = json.loads((score / "score.json").read_text(encoding="utf-8"))
        self.assertEqual(document["unresolved"], record["pixels"]["unresolved"])
        self.assertEqual(document["pixels"], record["pixels"]["object"])
        self.assertAlmostEqual(document["exposure"], results_of(out)["scene"]["exposure"], places=6)
        self.assertAlmostEqual(document["pictures"][0]["normalized_color"], record["error"]["normalized_color"], places=7)

    def test_an_effect_can_be_left_out(self):
        flat = results_of(
            self.compare("flat", "ribbed_plane", "--size", "64x64", "--spp", "4", "--distance", NEAR, "--without", "normal_variation")
        )
        self.assertTrue(any("as requested: normal_variation" in warning for warning in flat["scene"]["warnings"]))
        errors = {record["error"]["normalized_color"] for record in flat["records"]}
        self.assertEqual(len(errors), 1, "without bumps every method draws the same")
        for record in flat["records"]:
            self.assertNotIn("normal_variation", record["effects"]["on"])

    def test_a_far_object_has_no_error(self):
        far = results_of(self.compare("far", "ribbed_plane", "--size", "16x16", "--spp", "4", "--distance", "1000"))
        for record in far["records"]:
            self.assertIsNone(record["error"])
            self.assertIsNone(record["equivalent_spp"])
            self.assertEqual(record["equivalent_bound"], "n/a")


if __name__ == "__main__":
    unittest.main()
