"""accuracy_vs_time.py and temporal_study.py on small parts of real runs: they write pages and run nothing twice."""
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

SOURCE = pathlib.Path(os.environ["FOOTPRINT_SOURCE_DIR"])
PROGRAM = os.environ["FOOTPRINT_PROGRAM"]


class QuickStudy(unittest.TestCase):
    def test_parts_are_run_once_and_make_a_page(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            command = [SOURCE / "scripts/studies/accuracy_vs_time.py", folder, "--quick", "--run", "--footprint", PROGRAM]
            first = subprocess.run(command, capture_output=True, text=True, check=False)
            self.assertEqual(first.returncode, 0, first.stderr)
            parts = sorted(folder.glob("accuracy_vs_time_quick/*/results.json"))
            self.assertEqual(len(parts), 2, "a part per filter")
            for said in ("## Fronts over all scenes", "**Steam Deck**", "| GPU | only by frame time |", "## Price list",
                         "Not run: nothing.", "`cells` | `trilinear`"):
                self.assertIn(said, first.stdout)
            again = subprocess.run(command[:-1] + ["false"], capture_output=True, text=True, check=False)
            self.assertEqual((again.returncode, again.stdout), (0, first.stdout), "complete parts are not run again")
            parts[0].unlink()
            again = subprocess.run(command[:-1] + ["false"], capture_output=True, text=True, check=False)
            self.assertEqual(again.returncode, 1, "`false` cannot run the lost part")
            self.assertRegex(again.stderr, "`footprint run .*accuracy_vs_time_quick.toml .*failed")
            page = subprocess.run(command[:3], capture_output=True, text=True, check=False)
            self.assertIn("Not run: `quick` under `shaded:2`.", page.stdout, "the page contains the other part")

    def test_a_still_camera_gains_by_its_history(self):
        with tempfile.TemporaryDirectory() as name:
            def study(*words):
                return subprocess.run([SOURCE / "scripts/studies/temporal_study.py", name, "--footprint", PROGRAM, *words],
                                      capture_output=True, text=True, check=False)

            self.assertEqual(study().returncode, 1, "no results")
            done = study("--run", "--quick")
            self.assertEqual(done.returncode, 0, done.stderr)
            errors = done.stdout[done.stdout.index("## Error"):]
            frame, history = (float(re.search(rf"\| `direct` \| `trilinear` \| {row} \| ([0-9.]+) \|", errors)[1])
                              for row in ("none", "jitter"))
            self.assertLess(history, 0.6 * frame)
            self.assertEqual(study().stdout, done.stdout)

    def test_a_method_has_the_same_colour_in_all_figures(self):
        methods = ["direct", "naive_mip", "toksvig", "toksvig:storage=unorm8"]
        asked = f"import study; print(*study.colours_of({methods}).values())"
        done = subprocess.run([sys.executable, "-B", "-c", asked], cwd=SOURCE / "scripts/studies", capture_output=True, text=True, check=True)
        self.assertEqual(done.stdout.split(), ["#444444", "#b5488a", "#0072b2", "#d55e00"], "as page_test has it of the page")


if __name__ == "__main__":
    unittest.main()
