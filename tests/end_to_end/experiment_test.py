"""Experiments as users run them; each gate is seen to fail."""

import csv
import json
import os
import re
import shutil
import signal
import subprocess
import time
import unittest
import xml.etree.ElementTree

from kept_runs import without_times
from whole_runs import PROGRAM, SOURCE, WholeRunTest, largest_difference, picture_facts, results_of, run

HEAD = """[experiment]
title = "A small one"
scene = "ribbed_plane"
size = "32x32"
methods = ["direct", "toksvig"]
repeats = 1
[reference]
spp = 16
other_spp = [4]
"""
CLAIM = """[[claim]]
name = "the_claim"
text = "t"
inequality = "{}"
expect = "{}"
reason = "r"
"""


class Experiments(WholeRunTest):
    def execute(self, name, content, command="check"):
        """Exit code, standard output, standard error and folder of an experiment of its own."""
        file = self.folder / f"{name}.toml"
        file.write_text(content, encoding="utf-8")
        out = self.folder / f"{name}_out"
        arguments = [PROGRAM, command, file, "--quiet", "-o", out]
        done = subprocess.run([*map(str, arguments)], capture_output=True, text=True, check=False)
        return done.returncode, done.stdout, done.stderr, out

    def assert_falls_short(self, name, content, *parts):
        code, output, errors, out = self.execute(name, content)
        self.assertEqual(code, 1, errors)
        short = [line for line in output.splitlines() if line.startswith("failed: ")]
        self.assertEqual(len(short), 1, output)
        for part in parts:
            self.assertIn(part, short[0])
        self.assertRegex(errors, r"^footprint: .*1 claims and thresholds failed")
        self.assertTrue((out / "index.html").is_file(), "the report is written all the same")

    # Each gate must be able to fall.

    def test_a_threshold_that_is_too_low_falls(self):
        content = HEAD + '[threshold]\n"error(direct)" = 0.2\n"error(toksvig)" = 1\n'
        self.assert_falls_short("low", content, "threshold error(direct): at most 0.20000, measured 0.")

    def test_a_threshold_without_a_figure_falls(self):
        content = HEAD + '[zoom]\ndistances = [1000000]\n[threshold]\n"error(toksvig)" = 1\n'
        self.assert_falls_short("without", content, "no record has this figure")

    def test_a_threshold_within_the_noise_is_refused_before_anything_is_timed(self):
        content = HEAD.replace("spp = 16", "spp = 2") + '[threshold]\n"error(toksvig)" = 0.001\n'
        code, _, errors, out = self.execute("within_noise", content)
        self.assertEqual(code, 2, errors)
        self.assertRegex(errors, r"within_noise.toml:\d+: the threshold error\(toksvig\) = 0.001 is within the "
                                 r"reference's noise, 0\.")
        self.assertFalse((out / "kept").exists(), "no distance was finished")
        self.assertFalse((out / "results.json").exists())

    def test_a_threshold_of_each_method_falls_for_the_one_that_exceeds_it(self):
        limit = 0.3  # between the two
        self.assert_falls_short("each", HEAD + f'[threshold]\n"error(*)" = {limit}\n', "error(direct)")

    def test_a_claim_that_does_not_hold_falls(self):
        content = HEAD + CLAIM.format("error(direct) < error(toksvig)", "reproduced")
        self.assert_falls_short("fails", content, "the_claim: not reproduced, expected reproduced", "error(direct) = 0.")

    def test_a_claim_that_holds_unexpectedly_falls(self):
        content = HEAD + CLAIM.format("error(toksvig) < error(direct)", "not_reproduced")
        self.assert_falls_short("holds", content, "the_claim: reproduced, expected not reproduced")

    def test_claims_that_come_out_as_expected_hold(self):
        content = HEAD + CLAIM.format("error(direct, spp=4) < error(toksvig)", "not_reproduced")
        content += '[threshold]\n"error(*)" = 1\n"-psnr(*)" = 0\n'
        code, output, errors, out = self.execute("expected", content)
        self.assertEqual((code, errors), (0, ""))
        self.assertIn("All 5 claims and thresholds are as expected", output)
        self.assertTrue(results_of(out)["experiment"]["claims"][0]["as_expected"])

    def test_run_reports_what_check_refuses(self):
        content = HEAD.replace("spp = 16", "spp = 256") + '[threshold]\n"error(toksvig)" = 0.05\n'
        code, output, _, out = self.execute("report", content, "run")
        self.assertEqual(code, 0)
        self.assertIn("Failed:", output)
        self.assertFalse(results_of(out)["experiment"]["thresholds"][0]["held"])

    # The files that other programs read.

    def check(self, name, content, *more):
        """Exit code and standard output of a check whose finished work is reused from call to call."""
        file = self.folder / f"{name}.toml"
        file.write_text(content, encoding="utf-8")
        command = [PROGRAM, "check", file, "--quiet", "-o", self.folder / f"{name}_out", *more]
        done = subprocess.run([*map(str, command)], capture_output=True, text=True, check=False)
        return done.returncode, done.stdout, done.stderr

    def test_junit_and_annotations(self):
        junit = self.folder / "junit.xml"
        content = HEAD + '[threshold]\n"error(direct)" = 0.2\n"error(toksvig)" = 1\n'
        code, output, _ = self.check("read", content, "--junit", junit, "--github")
        self.assertEqual(code, 1)
        suites = xml.etree.ElementTree.parse(junit).getroot()
        self.assertEqual((suites.tag, suites.get("tests"), suites.get("failures")), ("testsuites", "2", "1"))
        failed = [case for case in suites.iter("testcase") if case.find("failure") is not None]
        self.assertEqual([case.get("name") for case in failed], ["threshold error(direct)"])
        self.assertIn("at most 0.20000", failed[0].find("failure").get("message"))
        line = 1 + content[:content.index('"error(direct)"')].count("\n")
        self.assertRegex(output, rf"(?m)^::error file=.*read\.toml,line={line},title=read%3A threshold error\(direct\)::at most")

    def test_times_of_a_gpu_are_undecided_on_a_software_renderer(self):
        junit = self.folder / "undecided.xml"
        claim = CLAIM.format("fps(direct) > 1e9", "reproduced")
        content = HEAD + claim + 'source = "gpu_time"\ngpu_class = ["GeForce"]\n'
        code, output, errors = self.check("gpu", content, "--junit", junit, "--github")
        self.assertEqual((code, errors), (0, ""))
        self.assertRegex(output, r"the_claim: .*Figures: fps\(direct\) = .*\n *Undecided: timed on .*, a software renderer")
        self.assertIn("All 1 claims and thresholds are as expected, 1 undecided.", output)
        self.assertNotIn("::error", output)
        suites = xml.etree.ElementTree.parse(junit).getroot()
        self.assertEqual((suites.get("failures"), suites.get("skipped")), ("0", "1"))
        self.assertIn("a software renderer", suites.find(".//skipped").get("message"))
        code, output, errors = self.check("gpu", HEAD + claim)
        self.assertEqual(code, 1, "a claim of ours over the same time is decided")

    def test_a_baseline_is_written_on_request_passes_and_fails(self):
        baseline = self.folder / "baseline.json"
        code, _, errors = self.check("based", HEAD, "--baseline", baseline)
        self.assertEqual(code, 2)
        self.assertIn("baseline.json: no such baseline (--update-baseline writes it)", errors)
        self.assertEqual(self.check("based", HEAD, "--update-baseline")[0], 2)
        code, output, errors = self.check("based", HEAD, "--baseline", baseline, "--update-baseline")
        self.assertEqual((code, errors), (0, ""))
        self.assertIn("based: baseline toksvig at 1: this record is missing in the baseline", output)
        written = baseline.read_text(encoding="utf-8")
        self.assertEqual(self.check("based", HEAD, "--baseline", baseline)[0], 0)
        document = json.loads(written)
        document["figures"]["based"]["toksvig at 1"]["error"] += 0.01
        document["figures"]["another"] = {"x at 1": {"error": 0.5}}
        baseline.write_text(json.dumps(document), encoding="utf-8")
        code, output, errors = self.check("based", HEAD, "--baseline", baseline)
        self.assertEqual(code, 1)
        self.assertRegex(output, r"(?m)^failed: baseline toksvig at 1: error 0\.\d+, was 0\.\d+$")
        self.assertIn("1 claims and thresholds failed", errors)
        code, output, _ = self.check("based", HEAD, "--baseline", baseline, "--update-baseline")
        self.assertEqual(code, 0)
        self.assertRegex(output, r"based: baseline toksvig at 1: error 0\.\d+, was 0\.\d+\n")
        updated = json.loads(baseline.read_text(encoding="utf-8"))
        self.assertEqual(updated["figures"].pop("another"), {"x at 1": {"error": 0.5}}, "what was not run stays")
        self.assertEqual(updated, json.loads(written))
        baseline.write_text("{", encoding="utf-8")
        code, _, errors = self.check("based", HEAD, "--baseline", baseline)
        self.assertEqual(code, 2)
        self.assertIn("baseline.json: is damaged", errors)

    # The files that a run writes.

    def test_measured_stands_beside_published_and_the_figure_is_composed(self):
        (self.folder / "paper.toml").write_text(
            '[[value]]\nfigure = "Figure 1"\nmeasure = "error(toksvig, spp=4)"\nvalue = 0.25\n', encoding="utf-8")
        content = HEAD + """
[zoom]
from = 1
to = 2
frames = 2
[published]
file = "paper.toml"
figures = ["Figure 1"]
[figure]
crop = [0.25, 0.25, 0.75, 0.75]
inset = [0, 0, 0.25, 0.25]
[[figure.row]]
pictures = [{ method = "direct", label = "(a)" }, { method = "toksvig", frame = 1 }, { method = "reference" }]
[[figure.row]]
pictures = [{ method = "toksvig", crop = [0, 0, 0.5, 1] }]
"""
        code, output, errors, out = self.execute("figure", content)
        self.assertEqual(code, 0, errors)
        results = results_of(out)
        of_method = [r for r in results["records"] if r["method"] == "toksvig"]
        mean = sum(r["other_references"][0]["normalized_color"] for r in of_method) / len(of_method)
        published = results["experiment"]["published"][0]
        self.assertAlmostEqual(published["measured"], mean, 12)
        self.assertEqual(published["published"], 0.25)
        self.assertRegex(output, r"\| Figure 1 +\| error\(toksvig, spp=4\) \| +0.25000 \| +0\.\d+ \|")
        self.assertEqual([r["flicker"] is None for r in results["records"]], [True, True, False, False])
        page = (out / "index.html").read_text(encoding="utf-8")
        for picture in results["experiment"]["pictures"]:
            self.assertTrue((out / picture).is_file())
            self.assertIn(f'src="{picture}"', page)
        self.assertEqual(results["experiment"]["pictures"], ["images/figure.png", "images/figure_errors.png"])
        width, height = picture_facts([str(out / "images/figure.png")])[str(out / "images/figure.png")]["size"]
        self.assertGreater(width, 3 * 300)  # 16 pixels per side, enlarged by whole factors
        self.assertGreater(height, 300 + 600)
        self.assert_matches_schema(out)

    def test_quick_says_that_it_is_no_measurement(self):
        file = self.folder / "quick_of_small.toml"
        file.write_text(HEAD, encoding="utf-8")
        output = run("run", file, "--quick", "--quiet", "-o", self.folder / "quick_of_small")
        self.assertIn("not a measurement", output)
        self.assertEqual(results_of(self.folder / "quick_of_small")["records"][0]["size"], [8, 8])

    def test_every_experiment_of_the_tree_is_readable(self):
        """An output that cannot be: what the files say is found right before anything is rendered."""
        refused = lambda name: subprocess.run([PROGRAM, "run", name, "--quick", "--quiet", "-o", "/dev/null"],
                                              capture_output=True, text=True, check=False).stderr
        errors = refused("--all")
        for name in json.loads(run("list", "experiments", "--json"))["experiments"]:
            content = (SOURCE / "experiments" / f"{name}.toml").read_text(encoding="utf-8")
            self.assertNotIn('reason = ""', content)
            if re.search("^members = ", content, re.MULTILINE):
                self.assertIn(": /dev/null", refused(name))
            else:
                self.assertIn(f"{name} was not run: /dev/null/{name}: cannot be created", errors)

    # animate.

    def test_the_frames_of_an_animation_and_their_figures(self):
        out = self.folder / "zoom"
        run("animate", "ribbed_plane", "--methods", "direct,toksvig", "--frames", 3, "--from", 1, "--to", 4, "--size",
            "32x32", "--spp", 16, "--quiet", "-o", out)
        document = results_of(out)
        self.assertEqual(document["way"], {"path": "zoom", "axis": None})
        self.assertEqual([r["distance"] for r in document["records"][::2]], [1, 2, 4])
        self.assertEqual([r["frame"] for r in document["records"]], [0, 0, 1, 1, 2, 2])
        for record in document["records"]:
            self.assertEqual(record["flicker"] is None, record["frame"] == 0)
            for image in (record["images"]["color"], record["images"]["reference"]):
                self.assertTrue((out / image).is_file())
                self.assertTrue((out / image).with_suffix(".png").is_file())
        with (out / "results.csv").open(encoding="utf-8", newline="") as file:
            rows = list(csv.DictReader(file, strict=True))
        self.assertEqual([float(r["normalized_color_error"]) for r in rows],
                         [r["error"]["normalized_color"] for r in document["records"]])
        # A frame is the picture that `render` makes, and its error the one that `compare` finds.
        still = self.render("still", "ribbed_plane", "--method", "toksvig", "--distance", 2, "--size", "32x32")
        self.assertEqual(largest_difference(still, out / "images" / "toksvig_0001.exr"), 0.0)
        compared = self.compare("compared", "ribbed_plane", "--methods", "toksvig", "--distance", "2", "--size", "32x32",
                                "--spp", "16")
        self.assertEqual(results_of(compared)["records"][0]["error"]["normalized_color"],
                         document["records"][3]["error"]["normalized_color"])
        # Flicker's parts make the whole: interior pixels and edges, weighed by how many they are.
        for record in document["records"][2:]:
            means = [record["flicker"][part]["mean"] for part in ("shading", "edges") if record["flicker"][part]]
            self.assertLessEqual(min(means), record["flicker"]["mean"])
            self.assertGreaterEqual(max(means), record["flicker"]["mean"])
            self.assertIsNotNone(record["flicker"]["method"])

    LIGHT = ["ribbed_plane", "--methods", "direct,lean", "--path", "light", "--degrees", 40, "--frames", 3, "--size", "24x24",
             "--spp", 4, "--quiet"]

    def files(self, folder):
        """The images and table.md as bytes, and results.json without times."""
        found = {str(file.relative_to(folder)): file.read_bytes() for file in folder.glob("images/*")}
        return {**found, "table.md": (folder / "table.md").read_bytes(), "results.json": without_times(results_of(folder))}

    def test_an_animation_is_the_same_in_parts_and_in_pieces(self):
        whole, again, merged = (self.folder / name for name in ("whole", "again", "merged"))
        scene = self.folder / "unexposed/scene.toml"  # so that its exposure is that of the first frame, in all parts
        shutil.copytree(SOURCE / "scenes/ribbed_plane", scene.parent)
        text = (SOURCE / "scenes/ribbed_plane/scene.toml").read_text(encoding="utf-8")
        scene.write_text(re.sub(r"(?m)^exposure.*\n", "", text), encoding="utf-8")
        light = [scene, *self.LIGHT[1:]]
        run("animate", *light, "-o", whole)
        run("animate", *light, "-o", again)
        self.assertEqual(results_of(whole)["scene"]["exposure_source"], "automatic")
        self.assertEqual(self.files(whole), self.files(again), "two runs")
        parts = [self.folder / f"part_{i}" for i in (1, 2)]
        for i, part in enumerate(parts, 1):
            run("animate", *light, "--shard", f"{i}/2", "-o", part)
        run("merge", *reversed(parts), "-q", "-o", merged)
        self.assertEqual(self.files(whole), self.files(merged), "one run and its parts")
        self.assertEqual(len({name for name in self.files(whole) if name.endswith(".exr")}), 9)
        frames = {self.files(whole)[f"images/reference_000{i}.exr"] for i in range(3)}
        self.assertEqual(len(frames), 3, "the light moves")
        # A frame that was lost, as by a kill, is rendered again; the others are not.
        lost = next((again / "kept").glob("*/frame_*.json"))
        lost.unlink()
        run("animate", *light, "-o", again)
        self.assertEqual(self.files(whole), self.files(again))

        def refused(arguments, *words):
            out = self.folder / "refused"
            done = subprocess.run([PROGRAM, "merge", *map(str, arguments), "-q", "-o", str(out)], capture_output=True,
                                  text=True, check=False)
            self.assertEqual(done.returncode, 2, done.stderr)
            for word in words:
                self.assertIn(word, done.stderr)
            self.assertFalse((out / "results.json").exists())

        refused(parts[:1], "part 2 of 2 is missing")
        refused([parts[0], parts[0]], "name each part once")
        other = self.folder / "other"
        run("animate", *light, "--seed", 2, "--shard", "2/2", "-o", other)
        refused([parts[0], other], "other options")

    def test_a_history_is_the_same_in_parts_and_in_pieces(self):
        whole, again, merged, single = (self.folder / name for name in ("whole", "again", "merged", "single"))
        light = [*self.LIGHT, "--footprint", "stochastic:1"]
        history = [*light, "--history", 3, "--history-clamp", "box"]
        run("animate", *history, "-o", whole)
        accumulated = {"frames": 3, "alpha": 0.1, "clamp": "box", "jitter": True}
        for record in results_of(whole)["records"]:
            self.assertEqual(record["history"], accumulated)
        parts = [self.folder / f"part_{i}" for i in (1, 2)]
        for i, part in enumerate(parts, 1):
            run("animate", *history, "--shard", f"{i}/2", "-o", part)
        run("merge", *parts, "-q", "-o", merged)
        self.assertEqual(self.files(whole), self.files(merged), "one run and its parts")
        run("animate", *history, "-o", again)
        next((again / "kept").glob("*/frame_0001.json")).unlink()
        run("animate", *history, "-o", again)
        self.assertEqual(self.files(whole), self.files(again), "a lost frame is accumulated again")
        # Histories of one run, side by side: each is as it is alone, and they share their maps.
        both = "direct,direct:history=3:history_clamp=box"
        run("animate", *(both if word == "direct,lean" else word for word in light), "-o", single)
        records = results_of(single)["records"]
        self.assertEqual([r["history"] for r in records[:2]], [None, accumulated])
        self.assertEqual(largest_difference(whole / "images/direct_0002.exr",
                                            single / "images/direct_history_3_history_clamp_box_0002.exr"), 0.0)
        self.assertGreater(largest_difference(*(folder / "images/direct_0002.exr" for folder in (whole, single))), 0.01)
        # The first frame of a path is the still image of as many frames.
        still = self.render("still", "ribbed_plane", "--method", "direct", "--size", "24x24", "--footprint", "stochastic:1",
                            "--history", 3, "--history-clamp", "box")
        self.assertEqual(largest_difference(still, whole / "images/direct_0000.exr"), 0.0)

    def test_a_history_is_better_than_prefiltering_below_a_speed(self):
        for speed in ("slow", "fast"):
            run("check", SOURCE / f"experiments/temporal_{speed}.toml", "-q", "-o", self.folder / speed)
        fast = (SOURCE / "experiments/temporal_fast.toml").read_text(encoding="utf-8")
        wrong = self.folder / "wrong.toml"
        wrong.write_text(fast.replace("history=24) >", "history=24) <"), encoding="utf-8")
        done = subprocess.run([PROGRAM, "check", wrong, "-q", "-o", self.folder / "wrong"], capture_output=True, text=True,
                              check=False)
        self.assertEqual(done.returncode, 1, done.stderr)

    def film(self, name, script, **options):
        """Runs with a program of that script as ffmpeg."""
        tools = self.folder / f"{name}_tools"
        tools.mkdir()
        (tools / "ffmpeg").write_text("#!/bin/sh\n" + script, encoding="utf-8")
        (tools / "ffmpeg").chmod(0o755)
        out = self.folder / f"{name}_out"
        environment = {**os.environ, "PATH": f"{tools}:{os.environ['PATH']}"}
        process = subprocess.Popen([PROGRAM, "animate", *map(str, self.LIGHT), "--video", "-o", str(out)], env=environment,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, **options)
        return process, tools, out

    def test_the_film_is_whole_or_not_there(self):
        process, tools, out = self.film("good", 'for last; do :; done; echo "$@" > "$(dirname "$0")/said"; echo film > $last')
        self.assertEqual(process.communicate()[1], "")
        said = (tools / "said").read_text(encoding="utf-8")
        self.assertIn("-i images/reference_%04d.png -framerate 30 -i images/direct_%04d.png -framerate 30 -i images/lean_%04d.png",
                      said)
        self.assertEqual((out / "images/film.mp4").read_text(encoding="utf-8"), "film\n")
        self.assertEqual(results_of(out)["film"], "images/film.mp4")
        process, _, out = self.film("bad", 'for last; do :; done; echo half > $last; echo "no such codec" >&2; exit 1')
        self.assertIn("--video: ffmpeg ended with 1: no such codec", process.communicate()[1])
        self.assertEqual(process.returncode, 1)
        self.assertEqual(list(out.rglob("film*")), [])
        self.assertIsNone(results_of(out)["film"])
        process, tools, out = self.film("stopped", 'touch "$(dirname "$0")/started"; for last; do :; done; echo half > $last; exec sleep 60')
        while not (tools / "started").exists() and process.poll() is None:
            time.sleep(0.02)
        process.send_signal(signal.SIGINT)
        process.communicate()
        self.assertEqual(process.returncode, 130)
        self.assertEqual(list(out.rglob("film*")) + list(out.glob("*.json")), [])

    def test_the_flicker_of_an_animation_by_hand(self):
        out = self.folder / "by_hand"
        run("animate", "ribbed_plane", "--method", "direct", "--frames", 2, "--to", 1.5, "--size", "32x32", "--spp", 256, "--exposure", 1,
            "--quiet", "-o", out)

        def pixels(name):
            done = subprocess.run(["oiiotool", "--dumpdata", str(out / "images" / f"{name}.exr")], capture_output=True,
                                  text=True, check=True)
            rows = re.findall(r"\): *(\S+) +(\S+) +(\S+) +(\S+)", done.stdout)
            return [[float(value) for value in row] for row in rows]

        frames = [pixels(f"{who}_000{i}") for who in ("direct", "reference") for i in (0, 1)]
        sums = []
        for old, new, old_reference, reference in zip(*frames, strict=True):
            if old_reference[3] < 1 or reference[3] < 1:
                continue
            shown = [[min(max(value, 0), 1) for value in pixel[:3]] for pixel in (old, new, old_reference, reference)]
            sums.append(sum((b - a - d + c) ** 2 for a, b, c, d in zip(*shown, strict=True)) ** 0.5 / 3 ** 0.5)
        flicker = results_of(out)["records"][1]["flicker"]
        self.assertGreater(len(sums), 100)
        self.assertAlmostEqual(flicker["mean"], sum(sums) / len(sums), 5)


if __name__ == "__main__":
    unittest.main()
