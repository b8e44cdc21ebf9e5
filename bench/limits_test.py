"""The gates of `footprint_bench`: exit code 1 if a bake or a footprint exceeds a limit, else 0."""

import os
import re
import subprocess
import unittest


def bench(*arguments):
    command = [os.environ["FOOTPRINT_BENCH"], *arguments, "--methods", "atanasov_bins:m=63:roughness=bin"]
    return subprocess.run(command, capture_output=True, text=True, check=False)


def bakes(*limits):
    return bench("--bakes", "1", "--scene", "scratched_metal_1k", *limits)


class LimitsTest(unittest.TestCase):
    # A map of 1024 x 1024 texels: a sixteenth of the map that takes less than 10 s and 2 GB.
    def test_a_bake_within_its_limits_passes(self):
        result = bakes("--most-seconds", "10", "--most-gigabytes", "2")
        self.assertEqual(result.returncode, 0, result.stderr)
        row = re.search(r"roughness=bin +([0-9.]+) +([0-9.]+) +([0-9.]+) +([0-9.]+)", result.stdout)
        self.assertIsNotNone(row, result.stdout)
        seconds, _, megabytes, peak = (float(value) for value in row.groups())
        self.assertLess(seconds, 10)
        self.assertAlmostEqual(megabytes, 8.8 * 1024 * 1024e-6, delta=1.0)
        self.assertGreater(peak, 1e-3 * megabytes)

    def test_a_bake_beyond_them_is_refused(self):
        for limit, words in (("--most-seconds", "s, 0.0001 are allowed"), ("--most-gigabytes", "GB, 0.0001 are allowed")):
            result = bakes(limit, "0.0001")
            self.assertEqual(result.returncode, 1, result.stdout)
            self.assertIn(words, result.stderr)

    def test_a_footprint_that_is_dearer_than_others_is_refused(self):
        sizes = ("--footprints", "1", "--resolution", "4", "--most-ratio")
        within = bench(*sizes, "1000")
        self.assertEqual(within.returncode, 0, within.stderr)
        self.assertEqual(len(re.findall(r"[0-9.]+ lookups", within.stdout)), 2 * 3)  # `direct` too, 1, 4 and 16 texels
        refused = bench(*sizes, "1.0001")
        self.assertEqual(refused.returncode, 1, refused.stdout)
        self.assertIn("times the median, 1 are allowed", refused.stderr)


if __name__ == "__main__":
    unittest.main()
