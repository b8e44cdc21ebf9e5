"""Estimated costs on GPUs: the same on every run, ordered as the work is, and one clear error for what cannot be."""

import csv
import json
import os
import subprocess
import unittest

from whole_runs import HAS_COMPILERS, PROGRAM, SOURCE, WholeRunTest, needs_compilers, program_with

SCENE = ["ribbed_plane", "--size", "32x32", "--distance", "2"]
METHODS = ["direct", "toksvig", "lean", "tan_gmm:n=1", "tan_gmm:n=2", "tan_gmm:n=4"]


def cost(*arguments, **variables):
    command = [PROGRAM, "cost", *map(str, arguments), "-q"]
    return subprocess.run(command, capture_output=True, text=True, check=False, env=os.environ | variables, timeout=300)


@needs_compilers
class Costs(WholeRunTest):
    three = None  # what three_methods() made

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.four_lights = cls.folder / "carved_disk.toml"  # a small map: bakes take a moment
        text = (SOURCE / "scenes/carved_disk/scene.toml").read_text(encoding="utf-8")
        cls.four_lights.write_text(text.replace("resolution = 1024", "resolution = 64"), encoding="utf-8")

    def report(self, name, *arguments, scene=SCENE):
        folder = self.folder / name
        done = cost(*scene, *arguments, "-o", folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        report = json.loads((folder / "cost.json").read_text())
        for method in report["methods"]:
            for gpu in method["gpus"]:
                gpu.pop("compile_seconds")
        return report

    def test_equal_runs_give_equal_estimates(self):
        first, second = (self.report(name, "--methods", "toksvig,xu_vmf", "--gpu", "Steam Deck") for name in "ab")
        self.assertEqual(first["methods"], second["methods"])

    def test_costs_rise_with_the_work(self):
        report = self.report("rise", "--methods", ",".join(METHODS), "--gpu", "RX 480,Steam Deck")
        self.assertEqual([method["method"] for method in report["methods"]], METHODS)
        for gpu in range(2):
            figures = [method["gpus"][gpu] for method in report["methods"]]
            for figure in figures:
                self.assertIsNone(figure["failure"])
                bounds = {name: figure[f"{name}_ns"] for name in ("arithmetic", "bandwidth")}
                bounds["textures"] = figure["texture_ns"]
                self.assertEqual(figure["cost_ns"], max(bounds.values()))
                self.assertEqual(figure["passes_ns"], 0)
                self.assertEqual(figure["cost_ns"], bounds[figure["bound"]])
                self.assertEqual(figure["scratch_bytes"], 0)
            alu = [figure["alu_clocks"] for figure in figures]
            self.assertLess(alu[0], alu[1])  # direct, toksvig
            self.assertLess(alu[1], alu[2])  # lean
            self.assertEqual(alu[3:], sorted(alu[3:]))  # by the number of components
            self.assertLess(alu[3], alu[5])
        with open(self.folder / "rise" / "cost.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(len(rows), 2 * len(METHODS))
        self.assertEqual(float(rows[0]["cost_ns"]), report["methods"][0]["gpus"][0]["cost_ns"])

    def test_more_lobes_cost_more_under_four_lights(self):
        steps = [["tan_gmm:n=2", "tan_gmm:n=4"], ["cells:k=2", "cells:k=4"], ["xu_vmf:j=1", "xu_vmf:j=4"]]
        done = cost(self.four_lights, "--size", "32x32", "--methods", ",".join(sum(steps, [])), "--gpu", "RX 480", "-o",
                    self.folder / "lobes")
        self.assertEqual(done.returncode, 0, done.stderr)
        methods = json.loads((self.folder / "lobes/cost.json").read_text())["methods"]
        alu = {method["method"]: method["gpus"][0]["alu_clocks"] for method in methods}
        for less, more in steps:
            self.assertLess(1.2 * alu[less], alu[more])

    def test_every_light_counts_where_its_loop_contains_others(self):
        report = self.report("lights", "--methods", "ndf_atlas", "--gpu", "RX 480,Steam Deck", "--footprint", "trilinear",
                             scene=[self.four_lights, "--size", "32x32"])
        for gpu in report["methods"][0]["gpus"]:
            self.assertEqual(gpu["reads_by_format"]["32-bit bilinear"], 8)  # two tables for each of four lights

    def test_more_probes_cost_more(self):
        figures = [self.report(name, "--methods", "lean", "--gpu", "Steam Deck", "--footprint", name)["methods"][0]
                   for name in ("box:1", "box:2", "box:4")]
        self.assertEqual([figure["trips"]["probes"] for figure in figures], [1, 4, 16])
        reads = [figure["gpus"][0]["texture_reads"] for figure in figures]
        self.assertEqual([reads[1] / reads[0], reads[2] / reads[0]], [4, 16])

    def test_the_finest_level_costs_whole_cache_lines_far_away(self):
        # 16 bytes per texel and 8 of the output. A bilinear sample touches (w + 1)^2 texels' worth of lines of w x w texels.
        for distance, gcn, rdna in ((0.02, 8 + 1.25 * 16, 8 + 1.25 * 16), (4, 8 + 16 * 3**2, 8 + 16 * (8**0.5 + 1)**2)):
            scene = ["ribbed_plane", "--size", "32x32", "--distance", str(distance)]
            report = self.report(f"lines{distance}", "--methods", "direct", "--gpu", "RX 480,Steam Deck", scene=scene)
            bytes_read = [gpu["bytes_from_memory"] for gpu in report["methods"][0]["gpus"]]
            self.assertAlmostEqual(bytes_read[0], gcn, delta=0.001 * gcn)
            self.assertAlmostEqual(bytes_read[1], rdna, delta=0.001 * rdna)

    def test_passes_of_a_frame_count_where_they_are_repeated(self):
        always, changed, many = (
            self.report(name, "--methods", method, "--gpu", "RX 480,Steam Deck")["methods"][0]["gpus"]
            for name, method in (("always", "xu_vmf:j=4"), ("changed", "xu_vmf:j=4:rebuild=changed"), ("many", "xu_vmf:j=8")))
        for each, kept, more in zip(always, changed, many):
            self.assertIsNone(each["failure"])
            self.assertGreater(each["passes_ns"], 0)
            self.assertGreater(more["passes_ns"], each["passes_ns"])
            self.assertEqual(kept["passes_ns"], 0)
            self.assertAlmostEqual(each["cost_ns"], kept["cost_ns"] + each["passes_ns"], places=12)
            self.assertEqual(each["texture_reads"], kept["texture_reads"])

    def test_the_passes_of_a_frame_are_shared_by_its_pixels(self):
        small, large = (
            self.report(size, "--methods", "xu_vmf:j=4", "--gpu", "RX 480", scene=["ribbed_plane", "--size", size])["methods"][0]
            for size in ("32x32", "64x64"))
        self.assertGreater(large["pixels"], 3 * small["pixels"])
        totals = [method["pixels"] * method["gpus"][0]["passes_ns"] for method in (small, large)]
        self.assertAlmostEqual(totals[0] / totals[1], 1, places=9)

    def check(self, name, experiment, program=PROGRAM, command=("check",), **variables):
        """The finished process of an experiment, and the lines of what failed."""
        arguments = [program, *command, experiment, "-q", "-o", self.folder / name]
        done = subprocess.run(list(map(str, arguments)), capture_output=True, text=True, check=False,
                              env=os.environ | variables, timeout=300)
        return done, [line for line in done.stdout.splitlines() if line.startswith("failed: ")]

    def three_methods(self):
        """An experiment over three methods on one GPU, with bounds 0.01% above their costs, and those costs: made once."""
        if Costs.three:
            return Costs.three
        report = self.report("bounds", "--methods", "direct,toksvig,lean", "--gpu", "Steam Deck")
        costs = {method["method"]: method["gpus"][0]["cost_ns"] for method in report["methods"]}
        bounds = "".join(f'"gpu_cost({method})" = {1.0001 * ns!r}\n' for method, ns in costs.items())
        experiment = self.folder / "three.toml"
        experiment.write_text('[experiment]\ntitle = "t"\nscene = "ribbed_plane"\nmethods = ["direct", "toksvig", "lean"]\n'
                              'size = [32, 32]\ngpu = ["Steam Deck"]\nrepeats = 1\n[zoom]\ndistances = [2]\n'
                              f'[reference]\nspp = 4\nsupersampling = [1]\n[threshold]\n{bounds}')
        Costs.three = experiment, list(costs.values())
        return Costs.three

    def costs_in(self, name):
        results = json.loads((self.folder / name / "results.json").read_text())
        return [record["gpu_costs"][0]["cost_ns"] for record in results["records"]]

    def test_a_check_reports_the_estimates(self):
        experiment, costs = self.three_methods()
        done, _ = self.check("passes", experiment)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertEqual(self.costs_in("passes"), costs)
        self.assertIn("Estimated cost on GPUs", (self.folder / "passes" / "index.html").read_text())
        self.assertIn("## Estimated cost on GPUs", (self.folder / "passes" / "table.md").read_text())

    def test_a_part_of_a_run_estimates_too(self):
        experiment, costs = self.three_methods()
        for part in "12":
            done, _ = self.check(f"part{part}", experiment, command=("run", "--shard", f"{part}/2"))
            self.assertEqual(done.returncode, 0, done.stderr)
        parts = [str(self.folder / f"part{part}") for part in "12"]
        subprocess.run([PROGRAM, "merge", *parts, "-q", "-o", str(self.folder / "merged")],
                       capture_output=True, check=True, timeout=300)
        self.assertEqual(self.costs_in("merged"), costs)

    def test_the_quick_check_notices_one_more_texture_fetch(self):
        # The value that it reads changes nothing: no length of a mean normal exceeds 1.
        line = b"  vec4 mean = meanNormal(f);\n"
        more = line + b"  f.normal.uv += 0.25;\n  mean.w = min(mean.w, 2.0 + fetch(mean_normal, f.normal).x);\n"
        done, failed = self.check("more", "quick", program_with(self.folder, "methods/toksvig/toksvig.glsl", line, more))
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertEqual(len(failed), 1, failed)
        self.assertIn("threshold gpu_cost(toksvig): at most 0.37494, measured ", failed[0])

    def test_without_a_driver_a_check_judges_everything_else(self):
        icds = "/usr/share/vulkan/icd.d"
        other = next(f"{icds}/{name}" for name in os.listdir(icds) if name.startswith("lvp_icd"))
        done, failed = self.check("lacks", "quick", VK_DRIVER_FILES=other)
        self.assert_fails(done, 1, "quick: 5 claims and thresholds failed", "not measured: ", "mesa-vulkan-drivers")
        self.assertEqual(len(failed), 5, failed)
        for line in failed:
            self.assertIn("threshold gpu_cost(", line)
        results = json.loads((self.folder / "lacks" / "results.json").read_text())
        measured = [outcome["measured"] for outcome in results["experiment"]["thresholds"]]
        self.assertEqual(sum(value is None for value in measured), 5)
        self.assertTrue(all(record["error"] for record in results["records"]))

    def test_a_run_without_a_driver_fails_and_is_completed_with_one(self):
        experiment, costs = self.three_methods()
        done, _ = self.check("alone", experiment, command=("run",), VK_DRIVER_FILES="/nonexistent/radeon_icd.json")
        self.assert_fails(done, 1, "3 of 3 rows failed", "/nonexistent/radeon_icd.json does not exist")
        done, _ = self.check("alone", experiment)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.costs_in("alone"), costs)

    def test_recommend_limits_the_estimated_cost(self):
        costs = {method["method"]: method["gpus"][0]["cost_ns"] for method in
                 self.report("limits", "--methods", "direct,toksvig,lean", "--gpu", "PS4", "--footprint", "trilinear")["methods"]}
        between = 0.5 * (costs["toksvig"] + costs["lean"]) / costs["direct"]
        command = [PROGRAM, "recommend", *SCENE, "--methods", "direct,toksvig,lean", "--footprints", "trilinear", "--spp", "16",
                   "--max-cost", f"{between}@PS4", "-q", "-o", str(self.folder / "advice")]
        done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=300)
        self.assertEqual(done.returncode, 0, done.stderr)
        advice = json.loads((self.folder / "advice" / "recommend.json").read_text())
        self.assertEqual(advice["limits"]["gpu"], "PS4")
        candidates = {candidate["method"]: candidate for candidate in advice["materials"][0]["candidates"]}
        self.assertAlmostEqual(candidates["toksvig"]["cost"]["median"], costs["toksvig"] / costs["direct"], places=9)
        self.assertGreater(candidates.get("lean", {"cost": {"median": 2 * between}})["cost"]["median"], between)
        self.assertLessEqual(advice["materials"][0]["candidates"][advice["materials"][0]["chosen"]]["cost"]["median"], between)

    def test_a_claim_about_a_gpu_that_is_not_there(self):
        experiment = self.folder / "none.toml"
        experiment.write_text('[experiment]\ntitle = "t"\nscene = "ribbed_plane"\nmethods = ["direct"]\n'
                              '[threshold]\n"gpu_cost(direct, gpu=PS4)" = 1.0\n')
        command = [PROGRAM, "check", str(experiment), "-q", "-o", str(self.folder / "none")]
        done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=60)
        self.assert_fails(done, 2, "none.toml:6", "no GPU's cost is estimated", "gpu = ")

    def test_an_unknown_gpu(self):
        self.assert_fails(cost(*SCENE, "--gpu", "RX 6900"), 2, "--gpu", "rx 6900", "did you mean", "rx 6800")

    def test_a_driver_that_is_not_there(self):
        done = cost(*SCENE, VK_DRIVER_FILES="/nonexistent/radeon_icd.json")
        self.assert_fails(done, 3, "VK_DRIVER_FILES", "/nonexistent/radeon_icd.json does not exist")

    def test_a_driver_without_the_compiler(self):
        files = [name for name in os.listdir("/usr/share/vulkan/icd.d") if name.startswith("lvp_icd")]
        self.assertTrue(files)
        done = cost(*SCENE, VK_DRIVER_FILES=f"/usr/share/vulkan/icd.d/{files[0]}")
        self.assert_fails(done, 3, "--gpu Steam Deck")


@unittest.skipIf(HAS_COMPILERS, "this build has compilers of shaders")
class WithoutCompilers(WholeRunTest):
    """A build without Vulkan's headers, glslang or SPIRV-Cross: one error before any work, and GLSL as ever."""

    def refused(self, *arguments):
        done = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, check=False)
        self.assert_fails(done, 3, "this program was built without", "FOOTPRINT_SHADER_COMPILERS=ON")
        return done.stderr

    def test_what_needs_them_says_what_is_missing(self):
        self.assertIn("cost: ", self.refused("cost", *SCENE, "-q"))
        self.assertIn("--gpu: ", self.refused("compare", *SCENE, "--gpu", "PS4", "-q", "-o", self.folder / "none"))
        self.assertIn("--max-cost: ", self.refused("recommend", *SCENE, "--max-cost", "2@PS4", "-q", "-o", self.folder / "none"))
        self.assertIn("--language hlsl: ", self.refused("shader", "lean", "--language", "hlsl"))
        self.assertIn("--language essl: ", self.refused("bake", *SCENE[:1], "--method", "lean", "--language", "essl", "-o", self.folder / "none"))
        self.assertFalse((self.folder / "none").exists())

    def test_glsl_is_written(self):
        done = subprocess.run([PROGRAM, "shader", "lean"], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("reflectedTowards(", done.stdout)

    def test_an_experiment_has_all_but_the_estimates(self):
        file = self.folder / "gpu.toml"
        file.write_text('[experiment]\ntitle = "t"\nmethods = ["direct"]\nscene = "ribbed_plane"\nsize = [32, 32]\n'
                        'gpu = ["PS4"]\nrepeats = 1\n[zoom]\ndistances = [2]\n[reference]\nspp = 4\nnoise = 1.0\n', encoding="utf-8")
        done = subprocess.run([PROGRAM, "run", file, "-q", "-o", self.folder / "run"], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 1, done.stderr)
        record = json.loads((self.folder / "run/results.json").read_text(encoding="utf-8"))["records"][0]
        self.assertIn("was built without", record["gpu_costs"][0]["failure"])


if __name__ == "__main__":
    unittest.main()
