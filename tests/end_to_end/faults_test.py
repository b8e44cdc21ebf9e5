"""Faults of machines: no thread, Ctrl-C before main, a folder that takes nothing, two at once."""

import json
import os
import resource
import subprocess
import unittest

from whole_runs import PROGRAM, WholeRunTest, needs_compilers

SETTINGS = ["ribbed_plane", "--method", "toksvig", "--size", "32x32", "--distance", "2", "--exposure", "1"]
FAULTS = {name: os.environ[f"FOOTPRINT_FAULT_{name.upper()}"] for name in ("no_thread", "no_memory", "no_gl_memory", "lost_context", "early_interrupt",
                                                                            "crashing_driver")}


def try_run(*arguments, **settings):
    return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, check=False, **settings)


class Faults(WholeRunTest):
    def with_fault(self, name, *arguments):
        # OpenBLAS, which OpenImageIO may load, raises SIGINT itself if it gets no thread of its own.
        return try_run(*arguments, env=os.environ | {"LD_PRELOAD": FAULTS[name], "OPENBLAS_NUM_THREADS": "1"}, timeout=60)

    def test_no_thread_to_be_had(self):
        self.assert_fails(self.with_fault("no_thread", "--version"), 3, "cannot create a thread", "ulimit -u")

    def test_no_memory_to_be_had(self):
        done = self.with_fault("no_memory", "render", *SETTINGS, "-q", "-o", self.folder / "none.exr")
        self.assert_fails(done, 3, "ribbed_plane, --size 32x32: out of memory: up to ", " was taken, ")
        self.assertFalse((self.folder / "none.exr").exists())

    def test_no_memory_of_opengl(self):
        sizes = ["--size", "512x512", "-q", "-o", self.folder / "none.exr"]
        done = self.with_fault("no_gl_memory", "render", *SETTINGS[:3], *sizes)
        self.assert_fails(done, 3, "512x512 texels of format", "cannot be allocated (GL_OUT_OF_MEMORY)")
        self.assertFalse((self.folder / "none.exr").exists())

    @needs_compilers
    def test_a_gpu_driver_that_crashes(self):
        driver = self.folder / "radeon_icd.json"
        library = {"library_path": FAULTS["crashing_driver"], "api_version": "1.1.0"}
        driver.write_text(json.dumps({"file_format_version": "1.0.0", "ICD": library}))
        done = try_run("cost", *SETTINGS[:1], *SETTINGS[3:7], "--methods", "direct", "--gpu", "PS4", "-q",
                       env=os.environ | {"VK_DRIVER_FILES": str(driver)}, timeout=60)
        self.assert_fails(done, 3, "--gpu PS4: the driver crashes before it compiles")

    def small_grooves(self):
        """A map of 256 x 256: the normals take 1 MiB, tan_gmm's lobes 5."""
        scene = self.folder / "scene.toml"
        scene.write_text('[surface]\nname = "v_grooves"\nresolution = 256\n[[light]]\ntype = "directional"\ndirection = [0, 0, -1]\n')
        return scene

    def test_recommend_leaves_out_what_opengl_refuses(self):
        out = self.folder / "advice"
        done = self.with_fault("no_gl_memory", "recommend", self.small_grooves(), "--size", "32x32", "--distance", "2",
                               "--methods", "direct,toksvig,tan_gmm", "--repeats", "1", "--exhaustive", "-q", "--no-cache", "-o", out)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("left out tan_gmm: ", done.stdout)
        advice = json.loads((out / "recommend.json").read_text())
        self.assertEqual([left["method"] for left in advice["left_out"]], ["tan_gmm"])
        self.assertIn("cannot be allocated (GL_OUT_OF_MEMORY)", advice["left_out"][0]["reason"])
        methods = {candidate["method"] for candidate in advice["materials"][0]["candidates"]}
        self.assertEqual(methods, {"direct", "toksvig"})
        self.assertEqual(advice["tried"], 6, "two methods under three filters")
        self.assertIn("tan_gmm is left out because it does not run here", (out / "index.html").read_text())

    def test_a_refused_method_loses_its_row(self):
        """The image of every other method, and the report, are there."""
        out = self.folder / "compared"
        done = self.with_fault("no_gl_memory", "compare", self.small_grooves(), "--size", "32x32", "--distance", "1,2",
                               "--methods", "direct,tan_gmm,toksvig", "--repeats", "1", "-q", "--no-cache", "-o", out)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("2 of 6 rows failed; the first, at distance 1: method tan_gmm", done.stderr)
        self.assertIn("cannot be allocated (GL_OUT_OF_MEMORY)", done.stderr)
        records = json.loads((out / "results.json").read_text())["records"]
        failed = [record for record in records if record["failure"]]
        self.assertEqual([record["method"] for record in failed], ["tan_gmm"] * 2)
        for record in failed:
            self.assertIn("GL_OUT_OF_MEMORY", record["failure"])
            self.assertEqual((record["error"], record["time"]["frame_ms"]["median"], record["images"]["color"]), (None, None, ""))
        for record in (record for record in records if not record["failure"]):
            self.assertTrue((out / record["images"]["color"]).is_file())
            self.assertIsNotNone(record["error"])
            self.assertGreater(record["time"]["frame_ms"]["median"], 0)
        for document in ("index.html", "table.md"):
            self.assertIn("distance 1: tan_gmm failed: method tan_gmm", (out / document).read_text().replace("\n  ", " "))

    def test_a_comparison_without_any_row(self):
        out = self.folder / "without_rows"
        done = self.with_fault("no_gl_memory", "compare", self.small_grooves(), "--size", "32x32", "--distance", "1",
                               "--methods", "tan_gmm", "--repeats", "1", "-q", "-o", out)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("1 of 1 rows failed; the first, at distance 1: method tan_gmm", done.stderr)
        self.assertNotIn("strip", done.stderr)
        records = json.loads((out / "results.json").read_text())["records"]
        self.assertIn("GL_OUT_OF_MEMORY", records[0]["failure"])
        self.assertIn("tan_gmm", (out / "index.html").read_text())

    def test_a_lost_context_ends_a_comparison(self):
        done = self.with_fault("lost_context", "compare", SETTINGS[0], "--methods", "direct,toksvig", *SETTINGS[3:], "-q", "-o", self.folder / "none")
        self.assert_fails(done, 3, "GL_CONTEXT_LOST: the driver was reset")
        self.assertFalse((self.folder / "none").exists())

    def test_a_lost_context(self):
        done = self.with_fault("lost_context", "render", *SETTINGS, "-q", "-o", self.folder / "none.exr")
        self.assert_fails(done, 3, "GL_CONTEXT_LOST: the driver was reset")
        self.assertFalse((self.folder / "none.exr").exists())

    def limited(self, mebibytes, *arguments):
        """With so much address space."""
        limit = mebibytes << 20
        return try_run(*arguments, preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (limit, limit)))

    def test_too_little_address_space_for_opengl(self):
        # The driver itself would crash at some of these.
        for mebibytes in (762, 768, 1000):
            with self.subTest(mebibytes=mebibytes):
                done = self.limited(mebibytes, "render", *SETTINGS, "-q", "-o", self.folder / "none.exr")
                self.assert_fails(done, 3, "OpenGL: it needs up to", "that `ulimit -v` grants")
        self.assertFalse((self.folder / "none.exr").exists())

    def test_a_map_over_the_address_space(self):
        done = self.limited(1000, "surface", "bumps", "--resolution", "16384", "-o", self.folder / "none.png")
        self.assert_fails(done, 3, "a map of 16384 x 16384 texels needs", "of the 1000 MiB that `ulimit -v` grants is available")

    def grooves(self, resolution):
        scene = self.folder / f"grooves{resolution}.toml"
        scene.write_text(f'[surface]\nname = "v_grooves"\nresolution = {resolution}\n[[light]]\ntype = "directional"\ndirection = [0, 0, -1]\n')
        return scene

    def test_a_scene_whose_map_exceeds_the_address_space(self):
        done = self.limited(1000, "compare", self.grooves(16384), "--methods", "lean", "-q", "-o", self.folder / "none")
        self.assert_fails(done, 3, "surface v_grooves: a map of 16384 x 16384 texels needs 4.00 GiB of memory",
                          "of the 1000 MiB that `ulimit -v` grants is available")
        self.assertFalse((self.folder / "none").exists())

    def test_bakes_under_any_limit_of_the_address_space_end_without_a_crash(self):
        scene, settings = self.grooves(4096), ["--method", "lean", "--size", "32x32", "--distance", "2", "--exposure", "1", "--no-cache", "-q"]
        for mebibytes in (1800, 2100, 2400):  # of which the maps of the bake exceed at least one
            with self.subTest(mebibytes=mebibytes):
                done = self.limited(mebibytes, "render", scene, *settings, "-o", self.folder / "limited.exr")
                if done.returncode != 0:
                    self.assert_fails(done, 3, "memory" if "OpenGL" not in done.stderr else "address space")
        self.assertNotEqual(self.limited(1800, "render", scene, *settings, "-o", self.folder / "limited.exr").returncode, 0)

    def test_interrupted_before_main(self):
        self.assert_fails(self.with_fault("early_interrupt", "--version"), 130, "interrupted")

    def test_a_library_that_does_nothing_does_no_harm(self):
        self.assertEqual(try_run("--version").returncode, 0)

    def test_a_folder_that_takes_nothing(self):
        folder = self.folder / "read_only"
        folder.mkdir()
        folder.chmod(0o555)
        # Root writes wherever it likes: it becomes nobody, who must reach its scratch folder and this picture's.
        self.folder.chmod(0o755)
        user = {"user": 65534, "group": 65534, "extra_groups": []} if os.getuid() == 0 else {}
        picture = folder / "picture.exr"
        done = try_run("render", *SETTINGS, "--no-cache", "-q", "-o", picture, **user)
        self.assert_fails(done, 3, str(picture), "a folder that you can write to")
        self.assertEqual(list(folder.iterdir()), [])

    def test_two_at_once_on_one_cache_and_one_output(self):
        cache = self.folder / "cache"
        alone = self.folder / "alone.exr"
        both = self.folder / "both.exr"
        settings = [PROGRAM, "render", *SETTINGS[:2], "fournier", *SETTINGS[3:], "-q", "-o"]
        environment = os.environ | {"FOOTPRINT_CACHE": str(cache)}
        pair = [subprocess.Popen([*settings, both], env=environment, stderr=subprocess.PIPE, stdout=subprocess.DEVNULL)
                for _ in range(2)]
        self.assertEqual([(one.communicate()[1], one.returncode) for one in pair], [(b"", 0)] * 2)
        subprocess.run([*settings, alone], env=os.environ | {"FOOTPRINT_CACHE": str(self.folder / "other")}, check=True,
                       stdout=subprocess.DEVNULL)
        self.assertEqual(both.read_bytes(), alone.read_bytes())
        again = self.folder / "again.exr"
        subprocess.run([*settings, again], env=environment, check=True, stdout=subprocess.DEVNULL)
        self.assertEqual(again.read_bytes(), alone.read_bytes(), "what the two left in the cache")
        partial = [path for path in self.folder.rglob("*partial*")] + [path for path in cache.rglob(".*") if path.is_file()]
        self.assertEqual(partial, [])


if __name__ == "__main__":
    unittest.main()
