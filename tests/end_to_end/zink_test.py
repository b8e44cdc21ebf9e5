"""Images by a second OpenGL, Mesa's zink over lavapipe, against those by llvmpipe: of every method with `scripts/test
--all`, else of the methods with the most GL code."""

import json
import os
import pathlib
import re
import subprocess
import sys
import unittest

from whole_runs import ALL_TESTS, PROGRAM, SOURCE, WholeRunTest, picture_facts, run

sys.path.insert(0, str(SOURCE / "scripts"))
import zink  # noqa: E402  it is in scripts/

# `xu_vmf` builds its map in several ways.
VARIANTS = ("xu_vmf:j=4", "xu_vmf:j=adaptive:thresholds=blended", "xu_vmf:space=camera", "reference")
MOST_GL = ("exact", "tan_gmm", "xu_vmf:space=camera", "atanasov_bins", "reference")
SETTINGS = ("ribbed_plane", "--size", "48x48", "--distance", "2", "--exposure", "1", "--backend", "egl")
WITHIN = 1e-5  # of the image's mean


def mean_difference(first, second):
    """The mean absolute difference of all channels, over the mean of the first picture's."""
    done = subprocess.run(["oiiotool", first, second, "--absdiff", "--printstats", first, "--printstats"], capture_output=True,
                          text=True, check=True)
    difference, level = [[float(n) for n in found.split()] for found in re.findall(r"Stats Avg: ([^(]*)", done.stdout)]
    return sum(difference) / sum(level)


@unittest.skipIf(zink.lavapipe() is None, "lavapipe is not installed (mesa-vulkan-drivers): no second OpenGL to draw by")
class Zink(WholeRunTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        os.environ["FOOTPRINT_CACHE"] = str(cls.folder / "cache")  # both drivers draw by the same bakes
        runtime = cls.folder / "runtime"
        runtime.mkdir(mode=0o700)
        cls.environment = zink.environment(zink.lavapipe(), runtime)

    def run_by_zink(self, *arguments):
        done = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, env=self.environment,
                              check=False)
        self.assertEqual(done.returncode, 0, f"{arguments}: {done.stderr}")
        return done.stdout

    def render_by_zink(self, name, *arguments):
        file = self.folder / f"{name}_zink.exr"
        self.run_by_zink("render", *arguments, "--quiet", "-o", file)
        return file

    def test_it_is_zink_and_reported_as_software(self):
        backends = json.loads(self.run_by_zink("list", "backends", "--json"))["backends"]
        egl = next(backend for backend in backends if backend["name"] == "egl")
        self.assertIn("zink", egl["renderer"])
        self.assertTrue(egl["software"])

    def test_probing_survives_a_driver_that_osmesa_lacks(self):
        # OSMesa of Mesa 22.3 crashes where GALLIUM_DRIVER names a driver that needs a device.
        osmesa = re.search(r"osmesa +(.*)", self.run_by_zink("info"))[1]
        if "install libosmesa6" in osmesa:
            self.skipTest(osmesa)
        self.assertRegex(osmesa, r"^(llvmpipe|softpipe|OSMesa)")

    def test_methods_draw_the_same_image_as_by_llvmpipe(self):
        methods = [method["name"] for method in json.loads(run("list", "methods", "--json"))["methods"]]
        self.assertGreater(len(methods), 10)
        for number, method in enumerate([*methods, *VARIANTS] if ALL_TESTS else MOST_GL):
            with self.subTest(method):
                settings = (*SETTINGS, "--method", method)
                here = self.render(f"picture_{number}", *settings)
                self.assertGreater(max(picture_facts([here])[str(here)]["most"][:3]), 0.0, "the image is black")
                self.assertLess(mean_difference(here, self.render_by_zink(f"picture_{number}", *settings)), WITHIN)

    def test_a_ten_thousandth_more_light_would_be_found(self):
        here = self.render("as_it_is", *SETTINGS, "--method", "direct")
        brighter = pathlib.Path(self.folder, "brighter.exr")
        subprocess.run(["oiiotool", here, "--mulc", "1.0001", "-o", brighter], check=True)
        self.assertGreater(mean_difference(here, brighter), WITHIN)


if __name__ == "__main__":
    unittest.main()
