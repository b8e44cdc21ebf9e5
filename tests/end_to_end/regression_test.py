"""What continuous integration checks: every method has bounds on error and energy, and figures like the baseline's. Each
gate is seen to fail."""

import json
import re
import subprocess
import tomllib
import unittest

from whole_runs import PROGRAM, SOURCE, WholeRunTest, results_of, run

BASELINE = SOURCE / "results" / "baselines" / "regression.json"


class Regression(WholeRunTest):
    def check_regression(self, experiment="regression", baseline=BASELINE):
        """Exit code and lines of failures of what continuous integration checks, or of a file with other bounds; measured
        once, then reused."""
        command = [PROGRAM, "check", experiment, "--quiet", "-o", self.folder / "regression", "--baseline", baseline]
        done = subprocess.run([*map(str, command)], capture_output=True, text=True, check=False)
        return done.returncode, [line for line in done.stdout.splitlines() if line.startswith("failed: ")]

    @staticmethod
    def members():
        """The files of the experiment `regression`, as text, by name."""
        load = lambda name: (SOURCE / "experiments" / f"{name}.toml").read_text(encoding="utf-8")
        return {name: load(name) for name in tomllib.loads(load("regression"))["experiment"]["members"]}

    @staticmethod
    def without_bounds(methods, members):
        """Bounds on a method of its own that no member has. A bound on every method says little of a single one."""
        bounded = {measure for content in members.values() for measure in tomllib.loads(content)["threshold"]}
        return [own for method in methods for own in (f"error({method})", f"abs(energy_bias({method}))") if own not in bounded]

    def test_every_method_has_bounds_and_is_within_them_and_like_the_baseline(self):
        methods = [method["name"] for method in json.loads(run("list", "methods", "--json"))["methods"]]
        members = self.members()
        self.assertEqual(self.without_bounds(methods, members), [])
        self.assertEqual(self.without_bounds(["new"], members), ["error(new)", "abs(energy_bias(new))"])
        less = {"quick": members["quick"].replace('"error(cells)"', '"error(*)"')}
        self.assertEqual(self.without_bounds(["cells"], less), ["error(cells)"])
        self.assertEqual(self.check_regression(), (0, []))
        for name in members:
            self.assert_matches_schema(self.folder / "regression" / name)

    def test_bounds_just_below_what_is_measured_fail_for_every_method(self):
        self.check_regression()
        members, bounds = self.members(), 0
        for name, content in members.items():
            thresholds = results_of(self.folder / "regression" / name)["experiment"]["thresholds"]
            measured = {threshold["measure"]: threshold["measured"] for threshold in thresholds}
            tight, count = re.subn(r'(?m)^"(error\(\w+\)|abs\(energy_bias\(\w+\)\))" = .*$',
                                   lambda bound: f'"{bound[1]}" = {0.999 * measured[bound[1]]}', content)
            (self.folder / f"{name}.toml").write_text(tight, encoding="utf-8")
            bounds += count
        twin = self.folder / "tight.toml"
        twin.write_text(f'[experiment]\ntitle = "t"\nmembers = {json.dumps([*members])}\n', encoding="utf-8")
        code, failed = self.check_regression(twin)
        self.assertEqual((code, len(failed), sum(": threshold " in line for line in failed)), (1, bounds, bounds))

    def test_another_figure_in_the_baseline_fails_with_method_distance_and_figure(self):
        document = json.loads(BASELINE.read_text(encoding="utf-8"))
        document["figures"]["quick"]["cells at 4"]["error"] += 2 * document["tolerance"]
        doctored = self.folder / "doctored.json"
        doctored.write_text(json.dumps(document), encoding="utf-8")
        code, failed = self.check_regression(baseline=doctored)
        self.assertEqual((code, len(failed)), (1, 1))
        self.assertRegex(failed[0], r"quick: baseline cells at 4: error 0\.\d+, was 0\.\d+$")


if __name__ == "__main__":
    unittest.main()
