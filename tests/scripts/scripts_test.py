"""The checks of scripts/ and packaging/ refuse: a changed picture, an archive that is too large, missing output."""
import collections
import importlib.machinery
import importlib.util
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import tomllib
import unittest

SOURCE = pathlib.Path(os.environ["FOOTPRINT_SOURCE_DIR"])
sys.path += [str(SOURCE / folder) for folder in ("packaging", "scripts", "scripts/studies")]

import accuracy_vs_time  # noqa: E402
import engine_constants  # noqa: E402
import portable  # noqa: E402

# Replaces the program: writes pictures whose bytes are those of the file beside it.
PROGRAM = """#!/bin/sh
while [ "$1" != "-o" ]; do shift; done
mkdir -p "$2/images"
cp "$(dirname "$0")"/pictures/* "$2/images/"
"""


def command_module(name):
    """A command of scripts/, whose file has no extension, as a module."""
    loader = importlib.machinery.SourceFileLoader(name, str(SOURCE / "scripts" / name))
    made = importlib.util.module_from_spec(importlib.util.spec_from_loader(name, loader))
    loader.exec_module(made)
    return made


class InFolder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)


class TestScript(unittest.TestCase):
    def test_an_unknown_option_is_refused(self):
        done = subprocess.run([SOURCE / "scripts/test", "--al"], capture_output=True, text=True, check=False)
        self.assertEqual((done.returncode, done.stdout), (3, ""))
        self.assertIn("--all", done.stderr)


class CiScript(InFolder):
    """The commands of the action with a stand-in for the program."""

    def script(self, file, *words):
        return subprocess.run([sys.executable, SOURCE / "packaging/ci_script.py", file, *words], capture_output=True, text=True, check=False)

    def test_the_action_passes_arguments_and_exit_code(self):
        (self.folder / "footprint").write_text("#!/bin/sh\nprintf '%s\\n' \"$@\"\nexit 1\n", encoding="utf-8")
        (self.folder / "footprint").chmod(0o755)
        made = self.script(SOURCE / "integrations/github/action.yml", "arguments=score a*  $HOME\n --max p99=0.05", "junit=j k.xml")
        environment = os.environ | {"PATH": f"{self.folder}:{os.environ['PATH']}"}
        done = subprocess.run(["bash"], input=made.stdout, capture_output=True, text=True, check=False, env=environment)
        self.assertEqual((done.returncode, done.stdout.splitlines()),
                         (1, ["score", "a*", "$HOME", "--max", "p99=0.05", "--github", "--junit", "j k.xml"]))

    def test_what_it_does_not_know_is_refused(self):
        action = (SOURCE / "integrations/github/action.yml").read_text(encoding="utf-8")
        (self.folder / "action.yml").write_text(action.replace("    - name: Run", "    - uses: a/b@v1\n      name: Run"), encoding="utf-8")
        (self.folder / "Containerfile").write_text("FROM debian\nADD a b\n", encoding="utf-8")
        for words, fault in ((["action.yml", "arguments=score a"], "Run Footprint: only"), (["action.yml"], r"needs \['arguments'\]"),
                             (["action.yml", "arguments=a", "argument=a"], r"no \['argument'\]"), (["Containerfile", "/"], "ADD: not")):
            done = self.script(self.folder / words[0], *words[1:])
            self.assertEqual(done.returncode, 1)
            self.assertRegex(done.stderr, fault)


class PictureHashes(InFolder):
    def setUp(self):
        super().setUp()
        self.pictures = self.folder / "pictures"
        self.pictures.mkdir()
        (self.pictures / "a.exr").write_bytes(b"one")
        (self.pictures / "b.exr").write_bytes(b"two")
        (self.folder / "program").write_text(PROGRAM, encoding="utf-8")
        (self.folder / "program").chmod(0o755)
        self.assertEqual(self.run_script("record").returncode, 0)

    def run_script(self, mode):
        return subprocess.run([SOURCE / "scripts/picture_hashes", mode, self.folder / "program", self.folder / "hashes",
                               "--scene", "bumps"], capture_output=True, text=True, check=False)

    def test_equal_pictures_pass(self):
        done = self.run_script("check")
        self.assertEqual((done.returncode, done.stdout), (0, "2 pictures are what they were\n"))

    def test_one_byte_is_found(self):
        (self.pictures / "b.exr").write_bytes(b"twO")
        done = self.run_script("check")
        self.assertEqual((done.returncode, done.stdout), (1, "bumps/b.exr: differs\n"))

    def test_pictures_that_come_and_go_are_found(self):
        (self.pictures / "b.exr").rename(self.pictures / "c.exr")
        done = self.run_script("check")
        self.assertEqual(done.returncode, 1)
        self.assertEqual(done.stdout, "bumps/b.exr: not rendered any more\nbumps/c.exr: was not recorded\n")

    def test_a_program_that_fails_is_reported(self):
        (self.folder / "program").write_text("#!/bin/sh\necho broken >&2\nexit 3\n", encoding="utf-8")
        done = self.run_script("check")
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("ended with 3", done.stderr)
        self.assertIn("broken", done.stderr)


class PortableArchive(InFolder):
    def setUp(self):
        super().setUp()
        self.tree = self.folder / "tree"
        self.tree.mkdir()
        (self.tree / "file").write_bytes(os.urandom(1 << 16))

    def test_an_archive_under_the_limit_stays(self):
        portable.pack(self.tree, self.folder / "small.tar.xz", portable.LIMIT)
        self.assertTrue((self.folder / "small.tar.xz").exists())

    def test_one_over_the_limit_is_refused_and_leaves_nothing(self):
        with self.assertRaises(SystemExit) as refused:
            portable.pack(self.tree, self.folder / "large.tar.xz", 1 << 15)
        self.assertIn("more than 32768", str(refused.exception))
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), ["tree"])

    def test_the_limit_is_what_is_promised(self):
        self.assertEqual(portable.LIMIT, 60 << 20)


class ExpectedOutput(InFolder):
    FILES = ["results.json", "results.csv", "table.md", "index.html", "images/d1_all.png"]

    def setUp(self):
        super().setUp()
        (self.folder / "images").mkdir()
        for name in self.FILES:
            (self.folder / name).write_text("x", encoding="utf-8")

    def expect(self):
        return subprocess.run(["bash", "-c", '. "$1/scripts/common.sh"; expect_output "$2" prog', "-", SOURCE,
                               self.folder], capture_output=True, text=True, check=False)

    def test_all_that_is_there_passes(self):
        self.assertEqual(self.expect().returncode, 0)

    def test_each_file_that_is_missing_or_empty_is_named(self):
        for name in self.FILES:
            (self.folder / name).write_text("", encoding="utf-8")
            done = self.expect()
            self.assertNotEqual(done.returncode, 0, name)
            self.assertIn(f"prog left no {name}", done.stderr + done.stdout)
            (self.folder / name).write_text("x", encoding="utf-8")


# Replaces the program: recommends `quick_choice` or, exhaustively, `whole_choice` of the folder beside it.
ADVISER = """#!/bin/sh
here=$(dirname "$0"); choice=quick_choice
for word in "$@"; do [ "$word" = --exhaustive ] && choice=whole_choice; done
echo "$@" >> "$here/calls"
while [ "$1" != "-o" ]; do shift; done
mkdir -p "$2" && cp "$here/$choice" "$2/recommend.json"
"""


class CheckRecommendations(InFolder):
    """Finished runs are stored and not repeated; differences and failures are reported."""

    def setUp(self):
        super().setUp()
        (self.folder / "program").write_text(ADVISER, encoding="utf-8")
        (self.folder / "program").chmod(0o755)
        self.choose("quick", 0)
        self.choose("whole", 0)

    def choose(self, run, index):
        costs = lambda median: {"low": 0.9 * median, "median": median, "high": 1.1 * median}
        candidates = [{"method": "direct", "footprint": "trilinear", "error": 0.2, "noise": 0.001, "cost": costs(1.0)},
                      {"method": "lean", "footprint": "trilinear", "error": 0.1, "noise": 0.001, "cost": costs(3.0)}]
        advice = {"material": "stone", "candidates": candidates, "chosen": index, "nearest": None}
        document = {"limits": {"max_error": None}, "materials": [advice]}
        (self.folder / f"{run}_choice").write_text(json.dumps(document), encoding="utf-8")

    def check(self, *words):
        return subprocess.run([SOURCE / "scripts/check_recommendations", "--keep", self.folder / "kept", *words],
                              env={**os.environ, "FOOTPRINT_PROGRAM": str(self.folder / "program")},
                              capture_output=True, text=True, check=False)

    def test_stored_runs_are_not_repeated(self):
        for _ in range(2):
            done = self.check("--small", "bumps", "scales")
            self.assertEqual((done.returncode, done.stdout), (0, "bumps: agrees\nscales: agrees\n"))
        calls = (self.folder / "calls").read_text(encoding="utf-8").splitlines()
        self.assertEqual(len(calls), 4)
        self.assertTrue(all("--size 64x64" in call for call in calls))

    def test_another_choice_is_reported(self):
        self.choose("whole", 1)
        done = self.check("bumps")
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stdout, "^bumps: stone: direct .* exhaustively lean ")

    def test_a_run_that_fails_is_reported_and_leaves_nothing_that_counts(self):
        (self.folder / "program").write_text("#!/bin/sh\nexit 3\n", encoding="utf-8")
        done = self.check("bumps")
        self.assertEqual((done.returncode, done.stdout), (1, "bumps: could not be measured\n"))
        self.assertEqual(list((self.folder / "kept" / "bumps").iterdir()), [])

    def test_runs_with_other_options_are_not_mixed(self):
        self.assertEqual(self.check("--small", "bumps").returncode, 0)
        done = self.check("bumps")
        self.assertEqual(done.returncode, 2)
        self.assertIn("contains runs with other options", done.stderr)


# Stand for footprint_bench, whose frame takes 20 ms, and for a program that answers or fails.
BENCH = """#!/bin/sh
echo '{"benchmarks": [{"cpu_time": 20.0}]}'
"""
RUNS = """#!/bin/sh
echo "$*" >> "$(dirname "$0")/calls"
case $1 in
  explain) echo '{"cost": [{"effect": "environment_light", "with_ms": 30, "without_ms": 12}]}' ;;
  recommend) echo "First answer (coarse, 25% of the pixels):" ;;
  compare) case $* in *--without*) echo "wrong" >&2; exit 2 ;; esac ;;
esac
"""


class RunCosts(InFolder):
    def setUp(self):
        super().setUp()
        self.bottle = self.folder / "WaterBottle/glTF/WaterBottle.gltf"
        self.bottle.parent.mkdir(parents=True)
        for name, text in (("app/footprint", RUNS), ("bench/footprint_bench", BENCH)):
            (self.folder / name).parent.mkdir()
            (self.folder / name).write_text(text, encoding="utf-8")
            (self.folder / name).chmod(0o755)

    def table(self, *arguments):
        done = subprocess.run([SOURCE / "scripts/run_costs", "--quick", "--models", self.folder, "--programs", self.folder, *arguments],
                              capture_output=True, text=True, check=False)
        cells = [[cell.strip() for cell in line.split("|")[1:-1]] for line in done.stdout.splitlines()[2:]]
        return done, {first: rest for first, *rest in cells}

    def test_a_model_that_is_absent_is_said_to_be(self):
        done, rows = self.table("--only", "WaterBottle")
        self.assertEqual((done.returncode, [cells[0] for cells in rows.values()]), (0, ["model absent"] * 2))
        self.assertFalse((self.folder / "app/calls").exists())

    def test_rows_have_seconds_and_ratios(self):
        self.bottle.touch()
        done, rows = self.table("--only", "WaterBottle|carved")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(len(rows), 3)
        self.assertRegex(rows["recommend WaterBottle `--max-cost 2`"][0], r"^0\.\d \(first answer 0\.\d\)$")
        for cells in rows.values():
            self.assertAlmostEqual(float(cells[2]), float(cells[1]) / 0.02, delta=3)  # of seconds in one digit
        self.assertIn("--size 64x64", (self.folder / "app/calls").read_text(encoding="utf-8"))

    @unittest.skipUnless(pathlib.Path("/usr/share/assimp/models/glTF2/ClearCoat-glTF").exists(), "no ClearCoatTest")
    def test_a_failed_run_is_reported_and_the_others_go_on(self):
        done, rows = self.table()
        self.assertEqual(done.returncode, 1)
        self.assertEqual([name for name, cells in rows.items() if cells[0] == "failed"], ["the same, `--without environment_light`"])
        self.assertIn("ratio 2.50", [cells[2] for cells in rows.values()])


class EngineConstants(InFolder):
    """The page is what results say: the least error wins, and what is missing is named."""

    def setUp(self):
        super().setUp()
        self.script = engine_constants
        errors = {method: 0.5 for method in {**self.script.CONSTANTS, **self.script.BESIDE}.values()}
        errors.update({self.script.CONSTANTS["1"]: 0.25, self.script.CONSTANTS["2"]: 0.125})
        for name in self.script.SURFACES:
            self.write(name, errors, name in self.script.SPREADS)
        screen = {"direct": 0.75, "specular_aa:preset=unity": 0.375, "specular_aa:preset=o3de": 0.3125}
        screen.update({method: float(constant) for method, constant in self.script.ROUND.items()})
        self.write(self.script.SCREEN[0], screen, False)

    def write(self, name, errors, with_spreads):
        record = {"shading_floor": 0.01, "energy_bias": 0.0}
        records = [{"method": method, "pixels": {"interior": 3, "object": 4},
                    "error": {**record, "shading": error + step, "normalized_color": error + step},
                    "flicker": {"mean": error} if step else None}
                   for method, error in errors.items() for step in (0.0, 0.0625)]
        quantities = []
        if with_spreads:
            for method, error in errors.items():
                quantities += [{"method": method, "name": "ndf_a15_s20", "value": error},
                               {"method": method, "name": "best_a15_s20", "value": 2.25}]
        results = {"tool": {"version": "1"}, "backend": {"renderer": "r"}, "reference": {"spp": 4}, "footprint": "f",
                   "scene": {"name": f"engine_constants_{name}"}, "records": records, "quantities": quantities}
        folder = self.folder / "engine_constants" / name
        folder.mkdir(parents=True, exist_ok=True)
        (folder / "results.json").write_text(json.dumps(results), encoding="utf-8")

    def run_script(self):
        return subprocess.run([SOURCE / "scripts/studies/engine_constants.py", self.folder], capture_output=True, text=True,
                              check=False)

    def test_the_least_error_wins_and_is_cited(self):
        done = self.run_script()
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertLessEqual(max(len(line) for line in done.stdout.split("\n") if line[:1] != "|"), 120)
        page = " ".join(done.stdout.split())
        self.assertIn("| 2 | 2 of 2 | 7 of 7 | 7 of 7 |", done.stdout)
        self.assertIn("| GGX of alpha 0.4, steep bumps | 0.531 | 0.531 | 0.531 | 0.281 | 0.156 |", page)
        self.assertIn("`engine_constants_ggx_satin`; quantities such as `ndf_a15_s20` and `best_a15_s20`", page)
        self.assertIn("0.0833 has the least error, 0.115, and 0.318 the most", page)
        self.assertIn("`specular_aa:preset=o3de` has the least error, 0.344", page)
        self.assertIn("3 of 4 pixels", page)

    def test_another_result_is_another_page(self):
        errors = {method: 0.5 for method in {**self.script.CONSTANTS, **self.script.BESIDE}.values()}
        errors[self.script.CONSTANTS["0.5"]] = 0.125
        self.write("ggx_rough", errors, False)
        self.assertIn("| 0.5 | 0 of 2 | 1 of 7 | 1 of 7 |", self.run_script().stdout)

    def test_what_is_missing_is_named(self):
        (self.folder / "engine_constants/ggx_rough/results.json").unlink()
        done = self.run_script()
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertIn("engine_constants_ggx_rough", done.stderr)

    def test_a_method_that_is_missing_is_named(self):
        self.write("ggx_rough", {"direct": 0.5}, False)
        done = self.run_script()
        self.assertEqual(done.returncode, 1)
        self.assertIn("engine_constants_ggx_rough has no record of roughness_bake", done.stderr)

    def test_every_method_of_the_page_is_one_of_the_experiments(self):
        experiment = tomllib.loads((SOURCE / "experiments/engine_constants.toml").read_text(encoding="utf-8"))
        for method in {**self.script.CONSTANTS, **self.script.BESIDE}.values():
            self.assertIn(method, experiment["experiment"]["methods"])
        self.assertEqual([pathlib.Path(scene).name for scene in experiment["matrix"]["scene"]],
                         list(self.script.SURFACES))


class MeasureGpu(InFolder):
    def setUp(self):
        super().setUp()
        self.script = command_module("measure_gpu")

    def test_only_bounds_on_estimates_may_fail(self):
        program = self.folder / "footprint"
        for kind, code, passes in (("gpu_cost", 1, True), ("error", 1, False), ("gpu_cost", 3, False)):
            program.write_text(f"#!/bin/sh\necho 'failed: threshold {kind}(lean): at most 1'\nexit {code}\n")
            program.chmod(0o755)
            if passes:
                self.script.check_quick(program)
                continue
            with self.assertRaisesRegex(self.script.Missing, f"exit code {code}.*\n.*threshold {kind}"):
                self.script.check_quick(program)

    def test_the_first_hardware_backend_is_taken(self):
        lines = ["  egl                    llvmpipe (LLVM 15), OpenGL 4.5 (Core Profile) Mesa 22.3.6, software",
                 "  egl-device --device 0  not available: EGL device: the driver gives no OpenGL 4.5 core context",
                 "  egl-device --device 1  NVIDIA H100, OpenGL 4.5.0 NVIDIA 580"]
        self.assertIsNone(self.script.HARDWARE.search("\n".join(lines[:2])))
        self.assertEqual(self.script.HARDWARE.search("\n".join(lines)).groups(), ("egl-device", "1"))

    def test_fixed_costs_of_a_frame_and_builds_are_no_part_of_a_pixel(self):
        def record(method, distance, pixels, ms, build):
            return {"method": method, "distance": distance, "pixels": {"object": pixels},
                    "time": {"frame_ms": {"median": ms}, "frame_build_ms": build}}

        records = [record("direct", 1.2, 1_001_000, 3.0, None), record("direct", 100.0, 1_000, 1.0, None),
                   record("xu_vmf", 1.2, 1_001_000, 12.0, 5.0), record("xu_vmf", 100.0, 1_000, 6.0, 5.0)]
        costs = [{"method": method, "gpus": [{"gpu": "Deck", "cost_ns": cost, "passes_ns": passes, "arithmetic_ns": alu}]}
                 for method, cost, passes, alu in (("direct", 2.0, 0.0, 1.0), ("xu_vmf", 9.0, 4.0, 3.0))]
        table = self.script.ratios_to_direct(records, costs)
        self.assertIn("| `direct` | 2 | 1 |  | 1 (1) |", table)  # (3 - 1) ms over a million pixels
        self.assertIn("| `xu_vmf` | 6 | 3 | 5 | 2.5 (3) |", table)


class AccuracyVsTime(InFolder):
    """The page is what parts say: fronts, prices and findings; parts that are there are not run again."""

    METHODS = {"direct": (1.0, 0.4), "toksvig": (2.0, 0.2), "tan_gmm": (4.0, 0.1), "cells": (4.0, 0.05)}
    ON_GPU = collections.defaultdict(lambda: None, {"direct": 1.0, "toksvig": 3.0, "tan_gmm": 1.5, "cells": 6.0})

    def setUp(self):
        super().setUp()
        self.script = accuracy_vs_time
        self.filters = self.script.planned(self.script.EXPERIMENTS)["cost"]
        for name in self.filters:
            for member in ("cost", "flicker", "bound", "bumps"):
                self.write(name, member)

    def write(self, name, member, factor=1.0, by_filter=0.02):
        records = []
        for method, (time, error) in self.METHODS.items():
            records.append({"method": method, "distance": 3.0, "pixels": {"object": 256},
                            "gpu_costs": [{"gpu": "Deck", "ratio_to_direct": self.ON_GPU[method]}] if member == "cost" else [],
                            "error": {"shading": factor * error, "shading_floor": 0.001, "filter": by_filter,
                                      "method": 0.5 * error},
                            "precompute": {"bytes": 65536 * 16, "bytes_per_texel": 16.0, "seconds": 0.5 * time,
                                           "cached": name != "trilinear"},
                            "flicker": {"mean": 0.1 * error, "noise_floor": 0.002} if member == "flicker" else None,
                            "time": {"frame_ms": {"median": 2.0 * time}, "fetches": 1.0, "lobes": 1.0,
                                     "ratio_to_direct": {"median": time, "low": time, "high": time}}})
        scene = member if member in ("bumps", "scales") else "disk"
        results = {"tool": {"version": "1"}, "backend": {"renderer": "r"}, "footprint": name,
                   "scene": {"materials": 1, "name": scene}, "reference": {"spp": 4},
                   "supersampling": [{"spp": 64, "distance": 3.0, "ms": 64.0, "shading": 0.3, "normalized_color": 0.3}],
                   "records": records}
        folder = self.part_folder(name, member)
        folder.mkdir(parents=True, exist_ok=True)
        (folder / "results.json").write_text(json.dumps(results), encoding="utf-8")

    def part_folder(self, name, member):
        experiment = self.script.EXPERIMENTS.get(member, self.script.STUDY)
        return self.folder / experiment / f"{member}-{name.replace(':', '_')}"

    def run_script(self, *options):
        return subprocess.run([SOURCE / "scripts/studies/accuracy_vs_time.py", self.folder, *options], capture_output=True,
                              text=True, check=False)

    def test_fronts_prices_and_findings(self):
        done = self.run_script("--svg", self.folder / "fronts.svg", "--note", "It was busy.")
        self.assertEqual(done.returncode, 0, done.stderr)
        page = done.stdout
        self.assertIn("| cells * | trilinear | 4 | 0.05 ×/÷ 1.00 |", page)
        self.assertNotIn("| tan_gmm | trilinear | 4 |", page, "cells costs the same and errs less")
        self.assertIn("| `cells` | `trilinear` | 0.5 ×/÷ 1.00 | 1 |", page)
        self.assertIn("Both aims are met by `cells` under `trilinear`,", " ".join(page.split()))
        self.assertIn("geometric mean: refuted by `tan_gmm`", " ".join(page.split()))
        self.assertIn("| ahead | | every width |", page.replace("  ", " "))
        self.assertIn("| 16 to 32 | 1 |", page, "256 texels along 16 pixels")
        self.assertIn("`toksvig` costs 2 frames of `direct`. Under `trilinear`, `tan_gmm` costs 4", " ".join(page.split()))
        self.assertIn("Not run: `v_grooves` under any, `scales` under any", " ".join(page.split()))
        self.assertIn("over its distances. It was busy. Means", " ".join(page.split()))
        self.assertIn("| `cells` | 2 | 2 | 1 | 1, 1 | 1, 1 |", page, "seconds, MiB, lookups and lobes")
        self.assertIn("| `cells` | 0.005 | 0.005 | 0.005 | 0.005 | 0.005 |", page, "flicker")
        self.assertIn("noise makes at most 0.002 of it", " ".join(page.split()))
        self.assertIn("| `bumps` | 3 | 16 | 0.001 |", page, "texels along a footprint, floor")
        self.assertIn("</svg>", (self.folder / "fronts.svg").read_text(encoding="utf-8"))

    def test_fronts_by_estimated_cost_are_apart(self):
        page = self.run_script().stdout
        apart = " ".join(page[page.index("**Deck**"):page.index("## Every method")].split())
        self.assertIn("| tan_gmm | trilinear | 1.5 | 0.1 ×/÷ 1.00 | | cells * | trilinear | 6 |", apart)
        self.assertNotIn("| toksvig |", apart, "tan_gmm costs less here")
        self.assertIn("| Deck | `toksvig` trilinear | `tan_gmm` trilinear |", apart)
        self.ON_GPU = collections.defaultdict(lambda: None)
        for name in self.filters:
            self.write(name, "cost")
        self.assertIn("Not estimated: `cost` names no GPU.", self.run_script().stdout)

    def test_other_results_are_another_page(self):
        for name in self.filters:
            self.write(name, "bumps", by_filter=0.2)
        self.write("shaded:2", "bumps", factor=0.25)
        page = self.run_script().stdout
        self.assertIn("by the geometric mean: confirmed.", " ".join(page.split()))
        self.assertIn("| ahead | | no width |", page.replace("  ", " "))
        self.assertIn("by the mean ratio, 2 ×/÷ 1.00, it is ahead", " ".join(page.split()))

    def test_what_no_paper_has_is_in_a_front_of_its_own(self):
        self.METHODS = {**self.METHODS, "tan_gmm:covariance=full": (4.0, 0.0625)}
        for name in self.filters:
            for member in ("cost", "bumps"):
                self.write(name, member)
        page = " ".join(self.run_script().stdout.split())
        self.assertIn("| published methods, plain supersampling | `cells` | `anisotropic:8` | 4 | 0.5, met |", page)
        self.assertIn("| the same and `tan_gmm:covariance=full` | `cells` | `anisotropic:8` | 4 | 0.8, missed |", page)

    def test_costs_are_means_over_distances(self):
        folder = self.part_folder("trilinear", "cost")
        results = json.loads((folder / "results.json").read_text(encoding="utf-8"))
        for r in [r for r in results["records"] if r["method"] == "cells"]:
            ratio = {"median": 9.0, "low": 3.0, "high": 10.0}
            results["records"].append({**r, "distance": 4.0, "time": {**r["time"], "ratio_to_direct": ratio}})
        (folder / "results.json").write_text(json.dumps(results), encoding="utf-8")
        self.assertIn("| `cells` | 6 (3 to 10), 0.05 ×/÷ 1.00 | 4 (4 to 4)", self.run_script().stdout)

    def test_an_aim_that_is_missed_is_not_called_met(self):
        self.METHODS = {**self.METHODS, "cells": (4.4, 0.05)}
        for name in self.filters:
            self.write(name, "cost")
        self.assertIn("- Both aims are met by none.", self.run_script().stdout)

    def test_exact_filtering_stands_beside_all_others(self):
        self.assertIn("### How far from exact?\n\nNot run: `bound`.", self.run_script().stdout)
        self.METHODS = {**self.METHODS, self.script.EXACT: (500.0, 0.01)}
        for name in self.filters:
            self.write(name, "bound", by_filter=0.03)
        page = " ".join(self.run_script().stdout.split())
        self.assertIn("| `trilinear` | 0.03 | 3 | `cells`, 4 | 0.05 | 5 |", page)
        self.assertIn("closest is 5 times as far off as exact filtering", page)
        self.assertIn("the kernels alone are 3 times off", page)
        self.assertIn("| cells * | trilinear | 4 | 0.05 ×/÷ 1.00 |", page, "it is not a scene of the study")
        for name in self.filters:
            self.write(name, "bound", by_filter=0.015)
        self.assertNotIn("the kernels alone", self.run_script().stdout)

    def test_a_scene_without_all_filters_is_in_no_mean(self):
        self.write("trilinear", "scales", factor=0.1)
        page = self.run_script().stdout
        self.assertIn("| cells * | trilinear | 4 | 0.05 ×/÷ 1.00 |", page)
        self.assertIn("| `scales` | 3 |", page)

    def test_flicker_is_of_its_own_part(self):
        for name in self.filters:
            shutil.rmtree(self.part_folder(name, "flicker"))
        page = self.run_script().stdout
        self.assertIn("## Flicker\n\nNot run: `flicker`.", page)
        self.assertIn("| cells * | trilinear | 4 | 0.05 ×/÷ 1.00 |", page)

    def test_without_parts_there_is_no_page(self):
        for experiment in self.script.EXPERIMENTS.values():
            shutil.rmtree(self.folder / experiment)
        done = self.run_script()
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertIn("make them with --run", done.stderr)

    def test_an_experiment_that_fails_is_named_and_leaves_nothing(self):
        shutil.rmtree(self.part_folder("trilinear", "cost"))
        done = self.run_script("--run", "--footprint", "false")
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr, "`footprint run .*accuracy_vs_time_cost.toml .*failed")
        self.assertFalse(self.part_folder("trilinear", "cost").exists())

    def test_every_experiment_varies_the_same_filters(self):
        for experiments in (self.script.EXPERIMENTS, self.script.QUICK):
            parts = self.script.planned(experiments)
            self.assertEqual(len({tuple(filters) for filters in parts.values()}), 1)
        self.assertEqual(len(self.script.planned(self.script.EXPERIMENTS)), 15)


class MethodFigures(InFolder):
    """Documents print figures of methods from one file."""

    def stale(self):
        done = subprocess.run([sys.executable, SOURCE / "scripts/doc_pictures", "--check", self.folder],
                              capture_output=True, text=True, check=False)
        self.assertEqual((done.returncode, done.stderr), (1 if done.stdout else 0, ""))
        return [line.split(":")[0] for line in done.stdout.splitlines()]

    def test_documents_have_the_figures_of_the_file(self):
        for file in [SOURCE / "README.md", SOURCE / "results/methods.json", *SOURCE.glob("methods/*/README.md")]:
            copy = self.folder / file.relative_to(SOURCE)
            copy.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(file, copy)
        self.assertEqual(self.stale(), [])
        views = json.loads((self.folder / "results/methods.json").read_text(encoding="utf-8"))
        views["carved_disk"]["methods"]["leadr"]["ratio_to_direct"] *= 9
        (self.folder / "results/methods.json").write_text(json.dumps(views), encoding="utf-8")
        self.assertEqual(self.stale(), ["README.md", "methods/leadr/README.md"])


if __name__ == "__main__":
    unittest.main()
