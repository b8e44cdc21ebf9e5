"""Checks the peak of a model's maps: at most 4 times the decoded maps for methods that bake little, and a bound for those
that bake much. By default a few of the models and methods."""

import json
import os
import subprocess
import unittest

from generated_model import model
from whole_runs import ALL_TESTS, PROGRAM, WholeRunTest

# Materials, sets of maps that they share, texels per side. The bake of a single large map takes the most memory.
LARGE_BAKES = {"tan_gmm": 6.5, "tan_gmm:n=2": 4}  # most times the decoded maps
MODELS = {"several": (2, 2, 1024), "single": (1, 1, 2048), "shared": (6, 1, 1024)}


def explained(file, method, cache=None):
    """The output of `explain` and its peak of memory in bytes. `cache` is the folder of stored bakes."""
    command = [PROGRAM, "explain", file, "--method", method, "--json", "--quiet"]
    environment = os.environ | {"FOOTPRINT_CACHE": str(cache)} if cache else None
    process = subprocess.Popen(command, stdout=subprocess.PIPE, env=environment)
    text = process.stdout.read()
    process.stdout.close()
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        raise AssertionError(f"explain {file}: exit code {process.returncode}")
    return json.loads(text)["memory"], 1024 * usage.ru_maxrss


class MemoryTest(WholeRunTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.without_maps = explained(model(cls.folder / "small", 2, 2, 4), "toksvig")[1]  # program and driver

    def test_peak_is_below_four_times_the_decoded_maps(self):
        for name, (count, sets, side) in MODELS.items():
            file = model(self.folder / name, count, sets, side)
            for method in ("toksvig", "lean") if ALL_TESTS else ("lean" if name == "single" else "toksvig",):
                with self.subTest(model=name, method=method):
                    memory, peak = explained(file, method)
                    texels = sets * side * side
                    self.assertEqual(memory["decoded_maps"], texels * 4 * (4 + 2 + 4))
                    # Two bytes of colour, one of roughness, two of normals: each map's third channel is constant.
                    self.assertLess(abs(memory["kept_maps"] - texels * (2 + 1 + 2)), 0.01 * texels)
                    self.check_peak(f"{name}, {method}", memory, peak, 4)

    def test_peak_of_large_bakes_that_are_put_on_the_disk(self):
        file, cache = model(self.folder / "large_bakes", *MODELS["single"]), self.folder / "cache"
        bakes = LARGE_BAKES if ALL_TESTS else {"tan_gmm": LARGE_BAKES["tan_gmm"]}
        for method, most in bakes.items():
            with self.subTest(method=method):
                self.check_peak(method, *explained(file, method, cache), most)
        self.assertEqual(len(list(cache.iterdir())), len(bakes))

    def check_peak(self, what, memory, peak, most):
        times = (peak - self.without_maps) / memory["decoded_maps"]
        print(f"{what}: {times:.2f} times the decoded maps")
        self.assertLess(times, most)


if __name__ == "__main__":
    unittest.main()
