"""What `explain` says that a model's maps take at their peak, held against what they take: 4 times the maps at most by
methods that keep little, and as estimated by those that keep much."""

import json
import os
import subprocess
import unittest

from generated_model import model
from whole_runs import PROGRAM, WholeRunTest

# Materials, sets of maps that they share out among them, texels a side; a single one's bake weighs most.
MODELS = {"several": (2, 2, 1024), "single": (1, 1, 2048), "shared": (6, 1, 1024)}
LEAST, MOST = 0.75, 1.25  # of the estimate


def explained(file, method, cache=None):
    """What `explain` says, and the most memory that it took, in bytes. `cache`: where bakes are kept."""
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


def holds(measured, estimated):
    return LEAST * estimated <= measured <= MOST * estimated


class MemoryTest(WholeRunTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.without_maps = explained(model(cls.folder / "small", 2, 2, 4), "toksvig")[1]  # program and driver alone

    def test_peak_is_as_estimated_and_below_four_times_the_decoded_maps(self):
        for name, (count, sets, side) in MODELS.items():
            file = model(self.folder / name, count, sets, side)
            for method in ("toksvig", "lean"):
                with self.subTest(model=name, method=method):
                    self.hold(*explained(file, method), sets * side * side, name, method)

    def test_peak_of_large_bakes_that_are_put_on_the_disk_is_as_estimated(self):
        file, cache = model(self.folder / "large_bakes", *MODELS["single"]), self.folder / "cache"
        for method in ("tan_gmm", "tan_gmm:n=2"):
            with self.subTest(method=method):
                memory, peak = explained(file, method, cache)
                self.hold_estimate(memory, peak - self.without_maps, method)
        self.assertEqual(len(list(cache.iterdir())), 2)

    def hold(self, memory, peak, texels, name, method):
        measured = peak - self.without_maps
        self.hold_estimate(memory, measured, f"{name}, {method}")
        self.assertEqual(memory["decoded_maps"], texels * 4 * (4 + 2 + 4))
        # Two bytes of colour, one of roughness, two of normals: each map's third channel is constant.
        self.assertLess(abs(memory["kept_maps"] - texels * (2 + 1 + 2)), 0.01 * texels)
        self.assertLess(measured, 4 * memory["decoded_maps"])

    def hold_estimate(self, memory, measured, what):
        estimated = memory["estimated_peak"]
        print(f"{what}: {measured / estimated:.2f} of the estimate, "
              f"{measured / memory['decoded_maps']:.2f} times the decoded maps")
        self.assertTrue(holds(measured, estimated), f"{measured} measured, {estimated} estimated")
        for wrong in (0.5, 2.0):  # an estimate that forgets what lies there, or counts it twice
            self.assertFalse(holds(measured, wrong * estimated))


if __name__ == "__main__":
    unittest.main()
