"""One picture, however it is made: by every backend, in tiles, beyond the size that OpenGL draws at once."""

import json
import unittest

from whole_runs import SOURCE, WholeRunTest, largest_difference, picture_facts, run

# A flat, matt plane: no texture to alias, so that tiles must agree to the last digits.
FLAT = """
[plane]
size = [4000.0, 2.0]
[[light]]
type = "directional"
direction = [-0.4, -0.3, -1.0]
intensity = 2.0
[camera]
position = [0.0, 0.0, 2.0]
target = [0.0, 0.0, 0.0]
"""

# The ribs seen at a flat angle, where a footprint is long and narrow.
OBLIQUE = """
[plane]
size = [2.0, 2.0]
normal_map = "{maps}/ribs_normal.png"
[tiling]
uv = [4.0, 4.0]
[[light]]
type = "directional"
direction = [-0.4, -0.3, -1.0]
intensity = 2.0
[camera]
frame_bounds = {{ direction = [0.1, -1.0, 0.2] }}
"""


class Pictures(WholeRunTest):
    def scene(self, name, text):
        file = self.folder / f"{name}.toml"
        file.write_text(text, encoding="utf-8")
        return file

    def test_every_backend_gives_the_same_picture(self):
        backends = json.loads(run("list", "backends", "--json"))["backends"]
        names = [backend["name"] for backend in backends if backend["available"] and backend["device"] == 0]
        self.assertIn("egl", names)
        settings = ["ribbed_plane", "--method", "toksvig", "--distance", "2", "--size", "64x64"]
        pictures = [self.render(name, *settings, "--backend", name) for name in names]
        for picture in pictures[1:]:
            self.assert_alike(pictures[0], picture, 1e-6)

    def test_tiles_leave_no_trace(self):
        settings = ["ribbed_plane", "--size", "150x100"]
        whole = self.render("whole", *settings, "--method", "toksvig")
        tiles = self.render("tiles", *settings, "--method", "toksvig", "--tile", "64")
        self.assert_alike(whole, tiles, 1e-3)

    def test_tiles_leave_the_reference_its_samples(self):
        settings = ["ribbed_plane", "--size", "150x100", "--method", "reference", "--spp", "5", "--seed", "3"]
        whole = self.render("reference_whole", *settings)
        tiles = self.render("reference_tiles", *settings, "--tile", "64")
        # Rounding may take a sample across the edge of its texel; other samples would change every pixel by far more.
        self.assert_alike(whole, tiles, 1e-3, percent_beyond=0.1)

    def test_probes_matter_at_a_flat_angle(self):
        oblique = self.scene("oblique", OBLIQUE.format(maps=SOURCE / "scenes" / "ribbed_plane"))
        settings = [oblique, "--method", "toksvig", "--size", "64x64"]
        isotropic = self.render("isotropic", *settings, "--footprint", "trilinear")
        probes = self.render("probes", *settings, "--footprint", "anisotropic:8")
        self.assertGreater(largest_difference(isotropic, probes), 1e-2)

    def test_a_frame_wider_than_opengl_draws_at_once(self):
        flat = self.scene("flat", FLAT)
        settings = [flat, "--method", "direct", "--size", "40000x16"]
        wide = self.render("wide", *settings)
        facts = picture_facts([wide])[str(wide)]
        self.assertEqual(facts["size"], (40000, 16))
        self.assertEqual(facts["unusable"], [0] * 8)
        self.assertEqual(facts["least"][3], 1.0, "the plane fills the frame")
        self.assert_alike(wide, self.render("other_tiles", *settings, "--tile", "3000"), 1e-3)


if __name__ == "__main__":
    unittest.main()
