"""Methods from files: equal to the program's own, in every command; hostile files end in one error."""

import json
import os
import shutil
import subprocess
import unittest

from whole_runs import PROGRAM, SOURCE, WholeRunTest, largest_difference, needs_compilers, results_of, run

SMALL = ("--size", "48x48")
HEAD = '/*\nname = "mine"\nsummary = "A test."\nreads = ["mean_normal"]\nleaves_out = ["environment_light"]\n*/\n'
BODY = """#include "mean_normal.glsl"
#include "facets_module.glsl"
Effective effective(Footprints f) {
  float lobe = lobe_cutoff.x;
  return Effective(evenFacets(meanNormal(f).xyz, lobe));
}
"""


class MethodFileTest(WholeRunTest):
    def setUp(self):
        os.chdir(self.folder)

    def file(self, text, name="mine.glsl"):
        (self.folder / name).write_text(text, encoding="utf-8")
        return f"./{name}"

    def copy_of(self, method):
        shutil.copy(SOURCE / "methods" / method / f"{method}.glsl", self.folder / f"copy_{method}.glsl")
        return f"./copy_{method}.glsl"

    def refused(self, *arguments, code=2):
        """The one error line of a command."""
        done = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, code, done.stderr)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        return done.stderr

    def test_a_copy_of_a_method_gives_its_picture_bit_for_bit(self):
        for method, scene, filter_name in (("toksvig", "bumps", "trilinear"),
                                           ("toksvig:storage=fp16:spread=0.5", "carved_disk", "anisotropic:4"),
                                           ("naive_mip:averages=lobe", "carved_disk", "shaded:2"),
                                           ("fixed_brdf", "bumps", "box:2"), ("lean:variant=clean", "bumps", "hardware:4")):
            arguments = (scene, *SMALL, "--footprint", filter_name)
            name, _, options = method.partition(":")
            own = self.render("own", *arguments, "--method", method)
            copy = self.render("copy", *arguments, "--method", f"{self.copy_of(name)}:{options}".rstrip(":"))
            self.assertEqual(largest_difference(own, copy), 0.0, f"{method} {filter_name}")
        other = self.render("other", *arguments, "--method", "toksvig")
        self.assertGreater(largest_difference(own, other), 0.0)

    def test_the_tutorial_is_true(self):
        page = (SOURCE / "docs/guides/method-files.md").read_text(encoding="utf-8")
        text = page.split("```glsl\n", 1)[1].split("```", 1)[0]
        self.assertLessEqual(text.count("\n"), 20)
        mine = self.render("mine", "bumps", *SMALL, "--method", self.file(text))
        same = self.render("same", "bumps", *SMALL, "--method", "toksvig:diffuse=normalized")
        self.assertEqual(largest_difference(mine, same), 0.0)
        half = self.render("half", "bumps", *SMALL, "--method", "./mine.glsl:strength=0.5")
        self.assertGreater(largest_difference(half, same), 0.0)
        self.assertIn("0 to 4", self.refused("render", "bumps", "--method", "./mine.glsl:strength=5", "-o", "a.exr"))

    def test_compare_measures_it_beside_others(self):
        copy = self.copy_of("toksvig")
        out = self.compare("compare", "bumps", *SMALL, "--spp", 4, "--methods", f"toksvig,{copy},{copy}:spread=0")
        own, same, unwidened = results_of(out)["records"][:3]
        self.assertEqual(same["method"], copy)
        self.assertEqual(same["options"], own["options"])
        self.assertEqual(same["error"], own["error"])  # the whole error, and by cause
        self.assertNotEqual(unwidened["error"], own["error"])
        self.assertTrue(list((out / "images").glob("*copy_toksvig*")))

    def test_compare_gives_one_that_does_not_compile_a_row(self):
        broken = self.file(HEAD + BODY.replace("lobe_cutoff.x", "lobe_cutof.x"), "broken.glsl")
        arguments = ("bumps", *SMALL, "--spp", 4, "--methods", f"toksvig,{broken}", "--repeats", 1, "-q", "-o", "row")
        self.assertIn("5 of 10 rows failed", self.refused("compare", *arguments, code=1))
        own, failed = results_of(self.folder / "row")["records"][:2]
        self.assertIsNone(own["failure"])
        self.assertIn("./broken.glsl:10: ", failed["failure"])

    def test_an_image_that_is_not_finite_is_named_with_exit_code_1(self):
        broken = self.file(HEAD + BODY.replace("= lobe_cutoff.x", "= sqrt(-1.0 - lobe_cutoff.x)"), "broken.glsl")
        for name in ("not_finite.exr", "not_finite.png"):
            error = self.refused("render", "bumps", *SMALL, "--method", broken, "--quiet", "-o", name, code=1)
            self.assertRegex(error, f"{name}: [1-9][0-9]* of 2304 pixels are not finite")
        arguments = ("bumps", *SMALL, "--spp", 4, "--methods", f"toksvig,{broken}", "-q", "-o", "all")
        self.assertIn("the value is not a finite number", self.refused("compare", *arguments, code=1))
        self.assertEqual(list((self.folder / "all/images").glob("*broken*")), [])

    def test_errors_of_its_text_name_its_line(self):
        broken = self.file(HEAD + BODY.replace("lobe_cutoff.x", "lobe_cutof.x"), "broken.glsl")
        error = self.refused("render", "bumps", *SMALL, "--method", broken, "--quiet", "-o", "broken.exr")
        self.assertIn("./broken.glsl:10: ", error)
        self.assertIn("lobe_cutof", error)
        self.assertFalse((self.folder / "broken.exr").exists())
        error = self.refused("ndf", "bumps", "--methods", broken, "--quiet", "-o", "broken")
        self.assertIn("./broken.glsl:10: ", error)
        unknown = self.file(HEAD + "#if NORMAL_VARIATIO\n#endif\n" + BODY, "unknown.glsl")
        error = self.refused("render", "bumps", *SMALL, "--method", unknown, "--quiet", "-o", "broken.exr")
        self.assertIn("./unknown.glsl, line 7: unknown flag", error)
        former = self.file(HEAD + "//? include mean_normal.glsl if normal_variation\n" + BODY, "former.glsl")
        error = self.refused("render", "bumps", *SMALL, "--method", former, "--quiet", "-o", "broken.exr")
        self.assertIn("./former.glsl, line 7: ", error)
        self.assertIn('write `#if NORMAL_VARIATION`, `#include "mean_normal.glsl"` and `#endif`', error)
        part = self.file(HEAD + BODY.replace('#include "facets_module.glsl"\n', "struct Effective { Facets facets; };\n"),
                         "part.glsl")
        for command in ("render", "bumps", *SMALL, "--method", part), ("ndf", "bumps", "--methods", part):
            error = self.refused(*command, "--quiet", "-o", "broken.exr")
            self.assertIn("./part.glsl: does not define `Reflected shade(Effective e, Surface s, vec3 wi, vec3 wo)`", error)

    def test_other_commands_take_it(self):
        copy = self.copy_of("toksvig")
        self.assertIn("Toksvig 2005", run("list", copy))
        run("bake", "bumps", "--method", copy + ":storage=fp16", "-o", "maps")
        self.assertTrue((self.folder / "maps" / "toksvig.glsl").exists())
        run("ndf", "bumps", "--methods", f"toksvig,{copy}", "--quiet", "-o", "ndf")
        methods = json.loads((self.folder / "ndf" / "ndf.json").read_text(encoding="utf-8"))["methods"]
        self.assertEqual(methods[copy]["l2"], methods["toksvig"]["l2"])
        self.assertIn("mean_normal", run("explain", "bumps", "--method", copy))
        run("animate", "bumps", *SMALL, "--methods", copy, "--frames", 2, "--quiet", "-o", "animation")

    @needs_compilers
    def test_its_cost_is_estimated(self):
        copy = self.copy_of("toksvig")
        run("cost", "bumps", *SMALL, "--methods", f"toksvig,{copy}", "--gpu", "Steam Deck", "-q", "-o", "cost")
        own, same = json.loads((self.folder / "cost" / "cost.json").read_text(encoding="utf-8"))["methods"]
        self.assertEqual(same["gpus"][0]["cost_ns"], own["gpus"][0]["cost_ns"])

    def test_experiments_name_it_relative_to_their_file(self):
        folder = self.folder / "study"
        folder.mkdir()
        shutil.copy(SOURCE / "methods" / "toksvig" / "toksvig.glsl", folder / "mine.glsl")
        (folder / "study.toml").write_text(
            '[experiment]\ntitle = "T"\nscene = "bumps"\nmethods = ["toksvig", "mine.glsl", "mine.glsl:spread=0"]\n'
            'size = [48, 48]\n[reference]\nspp = 4\n[zoom]\ndistances = [2]\n'
            '[threshold]\n"abs(error(toksvig) - error(mine.glsl))" = 0\n"error(toksvig) - error(mine.glsl:spread=0)" = 0\n',
            encoding="utf-8",
        )
        run("check", folder / "study.toml", "--quiet", "-o", "checked")
        kept = {part.name for part in (self.folder / "checked" / "kept").iterdir()}
        self.assertEqual(len(kept), 1)
        run("check", folder / "study.toml", "--quiet", "-o", "checked")
        self.assertEqual({part.name for part in (self.folder / "checked" / "kept").iterdir()}, kept)
        with open(folder / "mine.glsl", "a", encoding="utf-8") as file:
            file.write("// another file: its results are measured again\n")
        run("check", folder / "study.toml", "--quiet", "-o", "checked")
        self.assertGreater({part.name for part in (self.folder / "checked" / "kept").iterdir()}, kept)

    def test_hostile_files_end_in_one_error(self):
        def of(text, *words):
            error = self.refused("render", "bumps", *SMALL, "--method", self.file(text, "bad.glsl"), "-q", "-o", "x.exr")
            for word in words:
                self.assertIn(word, error)

        of(HEAD + '#include "/etc/passwd"\n' + BODY, "bad.glsl, line 7", "`/etc/passwd` is not a shader text")
        of(HEAD + "#include /etc/passwd\n" + BODY, "bad.glsl, line 7", "names no file in quotes")
        of(HEAD + BODY + " " * (300 << 10), "bad.glsl", "262144")
        of(HEAD + "\0" + BODY, "bad.glsl:7", "is not text")
        of(HEAD + "[" * 10000, "bad.glsl")
        of("/*\na = " + "[" * 10000 + "\n*/\n", "bad.glsl:2")
        of(HEAD + "".join(f"float f{i}(float x) {{ return sin(x) * {i}.0; }}\n" for i in range(4000)), "bad.glsl")
        error = self.refused("render", "bumps", "--method", "./missing.glsl", "-q", "-o", "x.exr")
        self.assertIn("./missing.glsl: no such file", error)

    def test_a_loop_without_end_ends(self):
        """llvmpipe counts the rounds of a pixel; another driver's watch or the program's own limit ends it."""
        loop = BODY.replace("  return", "  while (lobe > -1.0) lobe = abs(sin(lobe) + lobe);\n  return")
        file = self.file(HEAD + loop, "endless.glsl")
        command = [PROGRAM, "render", "bumps", "--size", "16x16", "--method", file, "--quiet", "-o", "endless.exr"]
        done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=100)
        self.assertIn(done.returncode, (0, 3))
        self.assertEqual(done.stderr.count("\n"), 0 if done.returncode == 0 else 1)


if __name__ == "__main__":
    unittest.main()
