"""The main figure of each paper in seconds: its claims come out as expected, and a fault in the paper's method shows."""

import subprocess
import unittest

from whole_runs import PROGRAM, SOURCE, WholeRunTest, program_with, results_of

# By experiment: the paper's own claims and a shader of its method, with a line and a fault in its place.
FAULTS = {
    "quick_tan2005": (
        ["tan_under_toksvig"], "methods/tan_gmm/tan_gmm.glsl",
        b"vec2 mean = filtered.yz / filtered.x;", b"vec2 mean = filtered.yz;"),
    "quick_xu2017": (
        ["under_direct", "under_lean", "under_plain_lean"], "methods/xu_vmf/xu_vmf.glsl",
        b"e.covered += weight * part.r.w;", b"e.covered += 4.0 * weight * part.r.w;"),
    "quick_iwasaki2012": (
        ["under_direct"], "methods/iwasaki_sg/iwasaki_sg.glsl",
        b"vec3(layer[value & 3])", b"vec3(layer[0])"),
    "quick_atanasov2020": (
        ["closer_than_direct"], "methods/atanasov_bins/atanasov_bins.glsl",
        b"return uint(cell.y) * uint(bins_across) + uint(cell.x);",
        b"return uint(cell.x) * uint(bins_across) + uint(cell.y);"),
}


class QuickPapers(WholeRunTest):
    def check(self, experiment, program=PROGRAM):
        """Exit code, and the claims that came out otherwise than expected."""
        out = self.folder / experiment
        command = [program, "check", experiment, "--quiet", "--no-cache", "-o", out]
        done = subprocess.run([*map(str, command)], capture_output=True, text=True, check=False)
        self.assertIn(done.returncode, (0, 1), done.stderr)
        claims = results_of(out)["experiment"]["claims"]
        return done.returncode, [claim["name"] for claim in claims if not claim["as_expected"]]

    def test_claims_come_out_as_expected_and_fail_with_a_fault_in_the_method(self):
        for experiment, (claims, *fault) in FAULTS.items():
            with self.subTest(experiment):
                self.assertIn(f'"{experiment}"', (SOURCE / "experiments/quick_papers.toml").read_text(encoding="utf-8"))
                self.assertEqual(self.check(experiment), (0, []))
                code, failed = self.check(experiment, program_with(self.folder, *fault))
                self.assertEqual((code, [name for name in claims if name not in failed]), (1, []))


if __name__ == "__main__":
    unittest.main()
