"""The gates of `footprint_bench`: what is within its limits passes, what is beyond one ends with exit code 1."""

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
        kept = bench(*sizes, "1000")
        self.assertEqual(kept.returncode, 0, kept.stderr)
        self.assertEqual(len(re.findall(r"[0-9.]+ lookups", kept.stdout)), 2 * 3)  # `direct` too, 1, 4 and 16 texels
        refused = bench(*sizes, "1.0001")
        self.assertEqual(refused.returncode, 1, refused.stdout)
        self.assertIn("times the median, 1 are allowed", refused.stderr)

    def test_a_zoom_has_a_row_a_distance_and_method(self):
        result = bench("--zoom", "1", "--scene", "scratched_metal_1k", "--distance", "1,16")
        self.assertEqual(result.returncode, 0, result.stderr)
        rows = re.findall(r"^([0-9]+) +(direct|atanasov_bins\S+) +[0-9.]+ +([0-9.]+)$", result.stdout, re.M)
        self.assertEqual([distance for distance, _, _ in rows], ["1", "1", "16", "16"], result.stdout)
        for _, method, ratio in rows:
            self.assertEqual(method == "direct", float(ratio) == 1.0, result.stdout)

    def test_frames_are_held_against_the_samples_that_are_as_good(self):
        result = bench("--zoom", "1", "--scene", "scratched_metal_1k", "--distance", "4", "--samples", "64")
        self.assertEqual(result.returncode, 0, result.stderr)
        row = r"(direct|atanasov_bins)\S* .* error ([0-9.]+) \(noise ([0-9.]+)\): (?:better than )?([0-9]+) samples, ([0-9.]+) x their time$"
        rows = {name: figures for name, *figures in re.findall(row, result.stdout, re.M)}
        self.assertEqual(set(rows), {"direct", "atanasov_bins"}, result.stdout)
        for error, noise, samples, ratio in rows.values():
            self.assertGreater(float(error), float(noise))
            self.assertIn(int(samples), (1, 2, 4, 8, 16))  # up to a quarter of the truth's
            self.assertGreater(float(ratio), 0.0)
        # What is closer to the truth is as good as more samples, or as many.
        nearer, farther = sorted(rows.values(), key=lambda row: float(row[0]))
        self.assertGreaterEqual(int(nearer[2]), int(farther[2]))


if __name__ == "__main__":
    unittest.main()
