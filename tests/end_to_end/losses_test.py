"""What illustrates a measurement costs only itself: each writer fails in turn, and everything else is there."""

import json
import os
import pathlib
import re
import resource
import subprocess
import unittest

from whole_runs import PROGRAM, WholeRunTest, results_of, run

FAULT = os.environ["FOOTPRINT_FAULT_REFUSED_FILE"]
SCENE = ["ribbed_plane", "--size", "32x32", "--distance", "2", "--exposure", "1"]
COMPARE = ["compare", *SCENE, "--methods", "direct,toksvig", "--spp", "16", "--bound", "off", "--repeats", "1", "--quiet"]
# The files of that comparison, but for results.json: a pattern for each writer.
WRITERS = ["/results.csv$", "/table.md$", "/index.html$", "/d2_all.png$", "/d2_all_errors.png$", "/d2_toksvig.exr$", "/d2_toksvig.png$",
           "/d2_toksvig_values.js$", "/d2_toksvig_error.png$", "/d2_toksvig_flip.png$", "/d2_reference.exr$",
           "/d2_reference_standard_error.exr$", "/d2_interior.exr$", "/d2_direct_or_toksvig.png$"]


def files_in(folder):
    return {path.relative_to(folder).as_posix() for path in folder.rglob("*") if path.is_file()}


def errors_of(folder):
    return [record["error"] for record in results_of(folder)["records"]]


class Losses(WholeRunTest):
    def refuse(self, pattern, *arguments, **environment):
        """The finished program, for which files whose paths match cannot be put in their place."""
        settings = os.environ | {"LD_PRELOAD": FAULT, "FOOTPRINT_FAULT_FILES": pattern} | environment
        return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, check=False, env=settings)

    def assert_lost(self, done, *texts):
        """Exit code 1, with one line that has these texts."""
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertEqual(len(done.stderr.strip().splitlines()), 1, done.stderr)
        for text in ("everything else is there", *texts):
            self.assertIn(text, done.stderr)

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.whole = cls.folder / "whole"
        run(*COMPARE, "-o", cls.whole)

    def test_every_writer_of_a_comparison_is_listed(self):
        """A file that no pattern names would be a writer that is not tried."""
        refused = {name for name in files_in(self.whole) if any(re.search(pattern, "/" + name) for pattern in WRITERS)}
        twins = {"images/d2_reference.png", "images/d2_reference_values.js", "images/d2_interior.png"}  # of functions that others show
        twins |= {name for name in files_in(self.whole) if "/d2_direct" in name}
        self.assertEqual(files_in(self.whole) - refused - twins, {"results.json"})

    def test_each_costs_only_itself(self):
        for number, pattern in enumerate(WRITERS):
            with self.subTest(pattern=pattern):
                out = self.folder / f"lost{number}"
                done = self.refuse(pattern, *COMPARE, "-o", out)
                lost = {name for name in files_in(self.whole) if re.search(pattern, "/" + name)}
                self.assert_lost(done, str(out / next(iter(lost))), "No space left on device", "free some space")
                missing = files_in(self.whole) - files_in(out)
                self.assertEqual(missing - self.made_of(lost), lost)
                self.assertEqual(errors_of(out), errors_of(self.whole))
                if "index.html" not in pattern:
                    note = re.search(r"not written(?:, the first)?: (\S+): cannot be put in place", (out / "index.html").read_text())
                    self.assertIn(note[1], lost)

    @staticmethod
    def made_of(lost):
        """Pictures that are made of pictures that were written."""
        stem = next(iter(lost))
        if stem.endswith("d2_toksvig.exr"):
            return {"images/d2_toksvig_error.png", "images/d2_toksvig_flip.png"}
        if stem.endswith("d2_reference.exr"):
            return {f"images/d2_{name}.png" for name in ("direct_error", "direct_flip", "toksvig_error", "toksvig_flip", "all", "all_errors")}
        return set()

    def test_without_the_document_nothing_is_left(self):
        """The document is no illustration."""
        done = self.refuse("/results.json$", *COMPARE, "-o", self.folder / "nothing")
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertIn("No space left on device", done.stderr)
        self.assertFalse((self.folder / "nothing").exists())

    def test_a_limit_on_file_sizes(self):
        """Every image is refused by the system itself."""
        out = self.folder / "limited"
        limit = 24 << 10
        larger = ["128x128" if word == "32x32" else word for word in COMPARE]
        done = subprocess.run([PROGRAM, *larger, "-o", out], capture_output=True, text=True, check=False,
                              preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit)))
        self.assert_lost(done, "File too large", "files were not written")
        self.assertEqual(len(results_of(out)["records"]), 2)

    def test_without_a_font_pictures_have_no_captions(self):
        out = self.folder / "plain"
        done = self.refuse("^$", *COMPARE, "-o", out, FOOTPRINT_FONT="/nowhere/DejaVuSans.ttf")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("warning: pictures get no captions: the font DejaVu Sans was not found", done.stderr)
        self.assertEqual(files_in(out), files_in(self.whole))
        self.assertNotEqual((out / "images/d2_all.png").read_bytes(), (self.whole / "images/d2_all.png").read_bytes())

    def test_the_other_commands(self):
        experiment = self.folder / "tiny.toml"
        experiment.write_text('[experiment]\ntitle = "Tiny"\nscene = "ribbed_plane"\nmethods = ["direct", "toksvig"]\nsize = [32, 32]\n'
                              '[reference]\nspp = 16\n[zoom]\ndistances = [2.0]\n', encoding="utf-8")
        image = self.whole / "images/d2_toksvig.exr"
        reference = self.whole / "images/d2_reference.exr"
        small = ["--spp", "16", "--quiet"]
        cases = {
            "recommend": (["recommend", *SCENE, "--methods", "direct,toksvig", "--repeats", "1", *small], "/index.html$", "recommend.json"),
            "animate": (["animate", *SCENE[:3], "--methods", "toksvig", "--frames", "2", "--exposure", "1", *small], "_0001.png$", "results.json"),
            "run": (["run", experiment, "--quiet"], "/table.md$", "results.json"),
            "check": (["check", experiment, "--quiet"], "/d2_all.png$", "results.json"),
            "kept": (["run", experiment, "--quiet"], "/kept/.*distance_2", "results.json"),
            "score": (["score", image, "--reference", reference, "--exposure", "1"], "/ldr_flip_1.png$", "score.json"),
            "ndf": (["ndf", self.map(), "--methods", "toksvig", "--quiet"], "/ndf.png$", "ndf.json"),
            "edit": (["edit", *SCENE[:3], "--method", "toksvig", "--set", "brdf.exponent=20:40", "--frames", "2", "--quiet"], "_0001.exr$", "edit.json"),
        }
        for name, (arguments, pattern, document) in cases.items():
            with self.subTest(command=name):
                out = self.folder / name
                self.assert_lost(self.refuse(pattern, *arguments, "-o", out), "No space left on device")
                self.assertTrue(json.loads((out / document).read_text()))

    def test_what_an_interim_page_loses_is_no_loss(self):
        """The first results.json and page of a run are of what is finished; the last ones take their place."""
        methods = ["--methods", "direct,toksvig", "--repeats", "1", "--spp", "16"]
        cases = {
            "compare": (["compare", *SCENE[:3], "--distance", "2,4", "--bound", "off", *methods], "page of the finished distances"),
            "recommend": (["recommend", *SCENE, *methods], "page of the first answer"),
        }
        for name, (arguments, announcement) in cases.items():
            for file in ("index.html", {"compare": "results.json", "recommend": "recommend.json"}[name]):
                with self.subTest(command=name, file=file):
                    out = self.folder / f"interim_{name}_{file}"
                    done = self.refuse(f"interim_{name}_[^/]*/{file}$", *arguments, "-o", out, FOOTPRINT_FAULT_TIMES="1")
                    self.assertEqual(done.returncode, 0, done.stderr)
                    self.assertTrue((out / file).is_file())
                    self.assertNotIn("not written", (out / "index.html").read_text())
                    self.assertEqual(announcement in done.stderr, file != "index.html", done.stderr)

    def map(self):
        file = self.folder / "bumps.png"
        if not file.exists():
            run("surface", "bumps", "--resolution", "64", "-o", file)
        return file

    def test_a_part_that_is_not_stored_fails(self):
        """Without it nothing can be merged."""
        out = self.folder / "part"
        done = self.refuse("/kept/.*/frame_0000.json$", "animate", *SCENE[:3], "--methods", "toksvig", "--frames", "2", "--exposure", "1",
                           "--spp", "16", "--quiet", "--shard", "1/2", "-o", out)
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertFalse((out / "part.json").exists())


if __name__ == "__main__":
    unittest.main()
