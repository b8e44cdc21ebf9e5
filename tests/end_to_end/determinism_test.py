"""Same seed, same bytes: pictures and all figures but times; `render` makes the pictures of `compare`."""

import unittest

from whole_runs import WholeRunTest, results_of

SETTINGS = ["ribbed_plane", "--size", "48x40", "--spp", "8", "--distance", "1,6"]


def without_times(results):
    """The document without what a clock decides."""
    for point in results["supersampling"]:
        del point["ms"]
    for record in results["records"]:
        del record["time"]["frame_ms"], record["time"]["fps"], record["time"]["ratio_to_direct"]
        del record["precompute"]["seconds"]
    del results["reference"]["seconds"]
    return results


def image_bytes(folder):
    return {file.name: file.read_bytes() for file in (folder / "images").iterdir()}


class Determinism(WholeRunTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.first = cls.compare("first", *SETTINGS, "--seed", "7")
        cls.images = image_bytes(cls.first)

    def test_same_seed_gives_the_same_bytes(self):
        second = self.compare("second", *SETTINGS, "--seed", "7")
        again = image_bytes(second)
        self.assertEqual(self.images.keys(), again.keys())
        self.assertEqual([name for name, content in self.images.items() if again[name] != content], [])
        self.assertEqual(without_times(results_of(self.first)), without_times(results_of(second)))

    def test_another_seed_changes_the_reference_alone(self):
        other = image_bytes(self.compare("other", *SETTINGS, "--seed", "8"))
        self.assertNotEqual(self.images["d1_reference.exr"], other["d1_reference.exr"])
        self.assertNotEqual(self.images["d6_reference.exr"], other["d6_reference.exr"])
        self.assertEqual(self.images["d1_toksvig.exr"], other["d1_toksvig.exr"])

    def test_render_makes_the_pictures_of_compare(self):
        shared = ["ribbed_plane", "--size", "48x40", "--distance", "6"]
        toksvig = self.render("toksvig", *shared, "--method", "toksvig")
        self.assertEqual(toksvig.read_bytes(), self.images["d6_toksvig.exr"])
        reference = self.render("reference", *shared, "--method", "reference", "--spp", "8", "--seed", "7")
        self.assertEqual(reference.read_bytes(), self.images["d6_reference.exr"])


if __name__ == "__main__":
    unittest.main()
