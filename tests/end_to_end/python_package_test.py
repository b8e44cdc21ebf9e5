"""The Python package against the program's files, read by json and csv, and against formulas of the documents."""

import contextlib
import csv
import doctest
import io
import json
import math
import os
import pathlib
import re
import shutil
import subprocess
import unittest
from unittest import mock

import footprint
import matplotlib.image
import numpy
from whole_runs import PROGRAM, SOURCE, WholeRunTest, needs_compilers, results_of

matplotlib.use("agg")
METHODS = ["direct", "toksvig", "tan_gmm:n=2"]
DISTANCES = [2, 4]
SMALL = {"size": "48x48", "spp": 16, "repeats": 1, "quiet": True}
INSTALLED_EXAMPLES = pathlib.Path("/usr/share/doc/python3-footprint/examples")

EXPERIMENT = """[experiment]
title = "Two methods"
scene = "ribbed_plane"
size = [32, 32]
methods = ["direct", "toksvig"]
repeats = 1
[zoom]
distances = [2.0]
[reference]
spp = 16
supersampling = [1]
[threshold]
"bytes(direct)" = {bytes}
"""


class PythonPackage(WholeRunTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.out = cls.folder / "out"
        cls.results = footprint.compare("ribbed_plane", cls.out, methods=METHODS, distance=DISTANCES, **SMALL)
        cls.plain = results_of(cls.out)
        with (cls.out / "results.csv").open(encoding="utf-8", newline="") as file:
            cls.rows = list(csv.DictReader(file, strict=True))

    def experiment(self, name, most_bytes, more=""):
        file = self.folder / f"{name}.toml"
        file.write_text(EXPERIMENT.format(bytes=most_bytes) + more, encoding="utf-8")
        return file

    # Results.

    def test_records_are_those_of_the_file(self):
        self.assertEqual(self.results.records, self.plain["records"])
        self.assertEqual(footprint.read(self.out / "results.json").document, self.plain)
        self.assertEqual([r["method"] for r in self.results.select(distance=2)], METHODS)

    def test_an_array_has_the_figures_of_the_csv(self):
        flat = self.results.array("error.shading")
        self.assertEqual(flat.tolist(), [float(row["shading_error"]) for row in self.rows])
        by = self.results.array("error.shading", by=("method", "distance"))
        self.assertEqual((by.shape, self.results.axis("method"), self.results.axis("distance")), ((3, 2), METHODS, DISTANCES))
        for row in self.rows:
            place = METHODS.index(row["method"]), DISTANCES.index(float(row["distance"]))
            self.assertEqual(by[place], float(row["shading_error"]))
        self.assertEqual(self.results.array("size.0").tolist(), [48.0] * 6)
        self.assertEqual(self.results.array("method").tolist(), [row["method"] for row in self.rows])
        self.assertTrue(numpy.isnan(self.results.array("flicker.mean")).all(), "no flicker without frames")

    def test_keys_that_do_not_fit_are_errors(self):
        with self.assertRaisesRegex(KeyError, "no `error.shadng`"):
            self.results.array("error.shadng")
        with self.assertRaisesRegex(ValueError, "add a key"):
            self.results.array("error.shading", by=("method",))
        with self.assertRaisesRegex(LookupError, "2 images `color` for .*'toksvig'"):
            self.results.image("toksvig")

    def test_a_dataframe_has_the_columns_and_cells_of_the_csv(self):
        frame = self.results.to_dataframe()
        self.assertEqual(list(frame.columns), list(self.rows[0]))
        for name in frame.columns:
            for cell, text in zip(frame[name], (row[name] for row in self.rows), strict=True):
                is_absent = isinstance(cell, float) and math.isnan(cell)
                self.assertTrue(text == "" if is_absent else str(cell) == text or str(cell).lower() == text
                                or float(cell) == float(text), f"{name}: {cell!r}, {text!r}")

    def test_only_empty_cells_are_nan(self):
        (self.folder / "results.csv").write_bytes(b"method,equivalent_bound\r\na,n/a\r\nb,\r\n")
        first, second = footprint.Results({}, self.folder).to_dataframe()["equivalent_bound"]
        self.assertEqual(first, "n/a")
        self.assertTrue(math.isnan(second))

    def test_the_front_has_those_that_none_beats(self):
        for distance in DISTANCES:
            points = {r["method"]: (r["time"]["ratio_to_direct"]["median"], r["error"]["shading"])
                      for r in self.plain["records"] if r["distance"] == distance}
            best = {name for name, (x, y) in points.items()
                    if not any(a <= x and b <= y and (a, b) != (x, y) for a, b in points.values())}
            front = [r["method"] for r in self.results.front(distance=distance)]
            self.assertEqual((set(front), len(front)), (best, len(best)))
            self.assertEqual(front, sorted(front, key=points.get))

    # Images.

    def test_images_have_the_error_of_their_record(self):
        """docs/reference/metrics.md's formula over the arrays gives what the program computed."""
        exposure = self.plain["scene"]["exposure"]
        for record in self.plain["records"]:
            image = self.results.image(record["method"], record["distance"])
            reference = self.results.reference(record["distance"])
            self.assertEqual((image.shape, image.dtype), ((48, 48, 4), numpy.float32))
            counts = reference[..., 3] == 1
            shown = [(part[..., :3].astype(float) * exposure).clip(0, 1)[counts] for part in (image, reference)]
            error = numpy.linalg.norm(shown[0] - shown[1], axis=-1).mean() / math.sqrt(3)
            self.assertEqual(counts.sum(), record["pixels"]["object"])
            self.assertAlmostEqual(error, record["error"]["normalized_color"], delta=1e-6)

    def test_a_picture_has_displayed_colours(self):
        record = self.plain["records"][0]
        shown = footprint.read_image((self.out / record["images"]["color"]).with_suffix(".png"))
        linear = (self.results.image("direct", 2)[..., :3] * self.plain["scene"]["exposure"]).clip(0, 1)
        srgb = numpy.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)
        self.assertEqual(shown.dtype, numpy.uint8)
        self.assertLessEqual(numpy.abs(shown[..., :3] - 255 * srgb).max(), 1.0)

    def test_pixels_are_as_stored(self):
        stored = numpy.arange(0, 240, 10, dtype=numpy.uint8).reshape(2, 3, 4)  # colours beside less than full coverage
        matplotlib.image.imsave(self.folder / "stored.png", stored)
        numpy.testing.assert_array_equal(footprint.read_image(self.folder / "stored.png"), stored)

    def test_a_rendered_image_is_that_of_the_comparison(self):
        image = footprint.render("ribbed_plane", "toksvig", distance=4, size="48x48", quiet=True)
        numpy.testing.assert_array_equal(image, self.results.image("toksvig", 4))

    # Other subcommands.

    def test_a_check_that_fails_is_an_outcome(self):
        passed = footprint.check(self.experiment("passing", 1e9), self.folder / "passed", quiet=True)
        self.assertEqual((passed.passed, passed.failed), (True, []))
        failed = footprint.check(self.experiment("failing", 1), self.folder / "failed", quiet=True)
        self.assertFalse(failed.passed)
        self.assertEqual(len(failed.failed), 1)
        self.assertIn("bytes(direct)", failed.failed[0])
        thresholds = results_of(self.folder / "failed")["experiment"]["thresholds"]
        self.assertEqual(failed.result.document["experiment"]["thresholds"], thresholds)

    def test_a_matrix_has_its_members(self):
        file = self.experiment("matrix", 1e9, '[matrix]\nfootprint = ["trilinear", "shaded:2"]\n')
        matrix = footprint.run(file, self.folder / "matrix", quiet=True)
        listed = json.loads((self.folder / "matrix" / "matrix.json").read_text(encoding="utf-8"))["members"]
        self.assertEqual(list(matrix.members), [member["folder"] for member in listed])
        self.assertEqual({part.document["footprint"] for part in matrix.members.values()}, {"trilinear", "shaded:2"})
        self.assertEqual(len(matrix.to_dataframe()), 4)
        folder = self.folder / "several"
        shutil.copytree(self.out, folder / "a")
        shutil.copytree(self.folder / "matrix", folder / "b")
        several = footprint.read(folder)
        self.assertEqual({name: type(part) for name, part in several.items()}, {"a": footprint.Results, "b": footprint.Matrix})

    def test_scores_are_those_of_the_records(self):
        record = self.plain["records"][0]
        image, reference = (self.out / record["images"][kind] for kind in ("color", "reference"))
        outcome = footprint.score(image, reference=reference, max={"p99": 0, "normalized_color": 1})
        self.assertFalse(outcome.passed)
        self.assertIn("p99", outcome.failed[0])
        self.assertEqual(outcome.result["pictures"][0]["normalized_color"], record["error"]["normalized_color"])
        self.assertTrue(footprint.score(image, reference=reference, max={"normalized_color": 1}).passed)

    def test_other_documents_are_dictionaries(self):
        self.assertEqual(footprint.bake("ribbed_plane", "lean", self.folder / "maps", quiet=True)["method"], "lean")
        self.assertEqual(footprint.ndf("ribbed_plane", methods="lean", resolution=32, quiet=True)["schema"], "footprint-ndf/1")
        advice = footprint.recommend("ribbed_plane", self.folder / "advice", methods=["direct", "toksvig"], footprints="trilinear",
                                     distance=4, **SMALL)
        self.assertEqual(advice["schema"], "footprint-recommend/1")

    def stand_in(self, name, command):
        """The environment with a shell command instead of the program."""
        file = self.folder / name
        file.write_text(f"#!/bin/sh\n{command}\n", encoding="utf-8")
        file.chmod(0o755)
        return mock.patch.dict(os.environ, FOOTPRINT_PROGRAM=str(file))

    def test_an_animation_has_the_flicker_of_its_file(self):
        film = footprint.animate("ribbed_plane", ["direct", "toksvig"], self.folder / "film", frames=3, **(SMALL | {"repeats": None}))
        plain = results_of(self.folder / "film")
        means = {(r["method"], r["frame"]): r["flicker"]["mean"] for r in plain["records"] if r["flicker"]}
        found = film.array("flicker.mean", by=("method", "frame"))
        self.assertEqual(found.shape, (2, 3))
        self.assertTrue(numpy.isnan(found[:, 0]).all(), "nothing is before the first frame")
        self.assertEqual({(m, f): found[film.axis("method").index(m), film.axis("frame").index(f)] for m, f in means}, means)

    @needs_compilers
    def test_a_cost_is_that_of_its_file(self):
        found = footprint.cost("ribbed_plane", self.folder / "cost", methods=["direct", "toksvig"], quiet=True)
        self.assertEqual(found, json.loads((self.folder / "cost/cost.json").read_text(encoding="utf-8")))
        again = footprint.cost("ribbed_plane", methods=["direct", "toksvig"], quiet=True)  # in a folder of its own

        def estimates(document):
            return re.sub(r'"compile_seconds": [^,}]*', "", json.dumps(document))

        self.assertEqual(estimates(found), estimates(again))

    def test_keyword_arguments_become_options(self):
        with self.stand_in("echo", "printf '%s\\n' \"$@\""):
            words = footprint.run_program("x", pathlib.Path("a b"), from_=1, no_cache=True, quiet=False, seed=None,
                                          distance=numpy.array([0.5, 2]), max={"p99": 0.05, "rejected": 0}, axis=(-1, 0, 0))
        self.assertEqual(words.splitlines(), ["x", "a b", "--from=1", "--no-cache", "--distance=0.5,2.0", "--max=p99=0.05",
                                              "--max=rejected=0", "--axis=-1,0,0"])

    # Errors.

    def test_a_program_that_is_killed_is_reported(self):
        with self.stand_in("killed", "kill -9 $$"), self.assertRaisesRegex(footprint.Error, "killed ended with -9") as caught:
            footprint.run_program("list")
        self.assertEqual(caught.exception.exit_code, -9)

    def test_a_wrong_option_is_the_programs_error(self):
        command = [PROGRAM, "compare", "ribbed_plane", "--methds=lean"]
        said = subprocess.run(command, capture_output=True, text=True, check=False)
        with self.assertRaises(footprint.Error) as caught:
            footprint.compare("ribbed_plane", self.folder / "none", methds="lean")
        self.assertEqual((f"footprint: {caught.exception}\n", caught.exception.exit_code), (said.stderr, 2))
        self.assertFalse((self.folder / "none").exists())

    def test_a_missing_program_is_named(self):
        with mock.patch.dict(os.environ, FOOTPRINT_PROGRAM="/nowhere/footprint"):
            with self.assertRaisesRegex(footprint.Error, "^/nowhere/footprint: .*install the package footprint") as caught:
                footprint.run_program("list")
        self.assertIsNone(caught.exception.exit_code)

    def test_a_missing_package_is_named(self):
        with mock.patch.dict("sys.modules", pandas=None), self.assertRaisesRegex(ImportError, "python3-pandas"):
            self.results.to_dataframe()
        with mock.patch.dict("sys.modules", OpenImageIO=None), self.assertRaisesRegex(ImportError, "python3-openimageio"):
            self.results.reference(2)

    def test_files_that_it_does_not_know_are_refused(self):
        for name, text, fault in (("newer", json.dumps(self.plain | {"schema": "footprint-results/3"}), "footprint-results/3"),
                                  ("list", "[]", "None"), ("broken", "{", "Expecting")):
            folder = self.folder / name
            folder.mkdir()
            (folder / "results.json").write_text(text, encoding="utf-8")
            with self.assertRaisesRegex(footprint.Error, f"{name}/results.json: .*{fault}"):
                footprint.read(folder)
        (self.folder / "empty").mkdir()
        with self.assertRaisesRegex(footprint.Error, "no document"):
            footprint.read(self.folder / "empty")
        with self.assertRaisesRegex(footprint.Error, "out/table.md"):
            footprint.read(self.out / "table.md")
        with self.assertRaisesRegex(footprint.Error, "table.md"):
            footprint.read_image(self.out / "table.md")

    def test_formats_are_those_of_the_schemas(self):
        for schema in (SOURCE / "docs").glob("*.schema.json"):
            wanted = json.loads(schema.read_text(encoding="utf-8"))["properties"]["schema"]["const"]
            self.assertIn(wanted, footprint.results.FORMATS.values(), schema)

    def test_progress_is_shown_and_an_interrupt_ends_the_program(self):
        class Interrupts(io.StringIO):
            def write(self, text):
                super().write(text)
                if "4096 samples per pixel" in text:
                    raise KeyboardInterrupt

        with contextlib.redirect_stderr(Interrupts()), self.assertRaises(KeyboardInterrupt):
            footprint.compare("ribbed_plane", self.folder / "interrupted", size="512x512", spp=4096)
        self.assertEqual(list(self.folder.glob("*interrupted*")), [])

    # The examples.

    def test_the_document_shows_what_python_prints(self):
        text = (SOURCE / "docs/guides/python.md").read_text(encoding="utf-8")
        session = "\n".join(re.findall(r"^```pycon\n(.*?)^```$", text, re.MULTILINE | re.DOTALL))
        self.assertGreater(session.count(">>>"), 9)
        test = doctest.DocTestParser().get_doctest(session, {}, "python.md", "docs/guides/python.md", 0)
        printed = io.StringIO()
        with contextlib.chdir(self.folder), contextlib.redirect_stderr(io.StringIO()):
            doctest.DocTestRunner(optionflags=doctest.NORMALIZE_WHITESPACE).run(test, out=printed.write)
        self.assertEqual(printed.getvalue(), "")

    def test_the_notebook_draws_the_front(self):
        folder = next(place for place in (SOURCE / "python/examples", INSTALLED_EXAMPLES) if place.is_dir())
        notebook = json.loads((folder / "front.ipynb").read_text(encoding="utf-8"))
        self.assertEqual(notebook["nbformat"], 4)
        code = ["".join(cell["source"]) for cell in notebook["cells"] if cell["cell_type"] == "code"]
        self.assertEqual([cell["outputs"] for cell in notebook["cells"] if cell["cell_type"] == "code"], [[]] * len(code))
        with contextlib.chdir(self.folder):
            scope = {}
            for cell in code:
                exec(compile(cell, "front.ipynb", "exec"), scope)
            drawn = footprint.read_image("front.png")
            self.assertGreater(len(numpy.unique(drawn.reshape(-1, drawn.shape[-1]), axis=0)), 5, "points, names and a line")
            self.assertTrue((self.folder / "images.png").is_file())


if __name__ == "__main__":
    unittest.main()
