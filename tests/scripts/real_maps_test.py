"""scripts/studies/real_maps.py and real_maps_study on small trees, and no constant is chosen on held-out maps."""
import hashlib
import json
import os
import pathlib
import re
import shutil
import struct
import subprocess
import tempfile
import unittest
import zlib

SOURCE = pathlib.Path(os.environ["FOOTPRINT_SOURCE_DIR"])
PROGRAM = os.environ["FOOTPRINT_PROGRAM"]
RECORDED = SOURCE / "results/real_maps.json"
WITH_CONSTANTS = ("methods", "renderer", "experiments", "scenes", "scripts")


def write_grey(file, side, value):
    """A grey PNG of one value."""
    write_rows(file, side, (b"\0" + bytes([value]) * 3 * side) * side)


def write_rows(file, side, rows):
    """A PNG of 8-bit RGB rows, each after its filter byte."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    file.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", side, side, 8, 2, 0, 0, 0)) +
                     chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def write_stripes(file, side, values):
    """A grey PNG of columns with the given values in turn."""
    row = b"\0" + b"".join(bytes([values[x % len(values)]]) * 3 for x in range(side))
    write_rows(file, side, row * side)


def held_out_uses(files, recorded):
    """The files that name a held-out map."""
    names = [pathlib.Path(entry["file"]).name for entry in recorded["maps"] if entry["part"] == "held_out"]
    return [str(file) for file in files if any(name in file.read_text(encoding="utf-8", errors="replace") for name in names)]


def development_name(surface):
    """A file name for a normal map that is for development by its hash."""
    names = (f"{surface}_{i}_Normal" for i in range(100))
    return next(name for name in names if int(hashlib.sha256(f"{name}.png".encode()).hexdigest(), 16) % 3)


class RealMaps(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.tree, self.out = self.folder / "tree", self.folder / "out"
        (self.tree / "grooves").mkdir(parents=True)

    def surface(self, surface, name, resolution=64):
        subprocess.run([PROGRAM, "surface", surface, "--resolution", str(resolution), "-o", self.tree / name], check=True,
                       capture_output=True)

    def collect(self):
        return subprocess.run([SOURCE / "scripts/studies/real_maps.py", self.out, f"some-package={self.tree}"], capture_output=True,
                              text=True, check=False, env=os.environ)

    def test_maps_become_scenes_and_the_rest_is_named(self):
        self.surface("bumps", "bumps_Normal.png")
        self.surface("v_grooves", "grooves/Grooves_normal.png")
        shutil.copyfile(self.tree / "bumps_Normal.png", self.tree / "copy_Normal.png")
        write_grey(self.tree / "grey_Normal.png", 16, 128)
        write_grey(self.tree / "grooves/Grooves_gloss.png", 64, 255)
        write_grey(self.tree / "other.png", 16, 128)
        (self.tree / "grooves/licenses.txt").write_text("free")
        done = self.collect()
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("2 maps", done.stdout)
        listed = json.loads((self.out / "maps.json").read_text())
        reasons = {entry["file"]: entry["reason"] for entry in listed["left_out"]}
        self.assertEqual(set(reasons), {"copy_Normal.png", "grey_Normal.png"})
        self.assertIn("is the same as bumps_Normal.png", reasons["copy_Normal.png"])
        self.assertIn("0.0% of its texels", reasons["grey_Normal.png"])
        bumps, grooves = listed["maps"]
        self.assertEqual((bumps["name"], grooves["name"]), ("bumps", "grooves"))
        self.assertEqual((grooves["class"], grooves["gloss"], grooves["licence"]),
                         ("lines", "grooves/Grooves_gloss.png", "grooves/licenses.txt"))
        for entry, name in ((bumps, "bumps_Normal.png"), (grooves, "Grooves_normal.png")):
            remainder = int.from_bytes(hashlib.sha256(name.encode()).digest(), "big") % 3
            self.assertEqual(entry["part"], "development" if remainder else "held_out")
        self.assertEqual([{form: len(scenes) for form, scenes in entry["scenes"].items()} for entry in (bumps, grooves)],
                         [{"main": 1, "alpha": 2, "sky": 1}, {"main": 1, "sky": 1}])
        scenes = [scene for entry in (bumps, grooves) for found in entry["scenes"].values() for scene in found]
        for scene in scenes:
            self.assertEqual(subprocess.run([PROGRAM, "explain", self.out / scene / "scene.toml", "--quiet"],
                                            capture_output=True, check=False).returncode, 0, scene)
        stats = subprocess.run(["oiiotool", "--stats", self.out / grooves["scenes"]["main"][0] / "roughness.png"], check=True,
                               capture_output=True, text=True).stdout
        average = float(re.search(r"Stats Avg: ([\d.]+)", stats)[1])
        self.assertAlmostEqual(average / 255, 1025 ** -0.25, delta=1 / 255)  # gloss 1: exponent 2048

    def study(self, *words):
        return subprocess.run([SOURCE / "scripts/studies/real_maps_study.py", self.out, self.folder / "results", *words],
                              capture_output=True, text=True, check=False, env=os.environ)

    def test_the_study_compares_methods_over_maps(self):
        for surface in ("bumps", "v_grooves"):
            self.surface(surface, f"{development_name(surface)}.png")
        self.assertEqual(self.collect().returncode, 0)
        missing = self.study()
        self.assertEqual(missing.returncode, 1)
        self.assertIn("has no results", missing.stderr)
        done = self.study("--run", "--quick", "--parts", "development_(main|storage)")
        self.assertEqual(done.returncode, 0, done.stderr)
        rows = {row[1].strip("` *"): row[2:-1] for row in (re.split(r" ?\| ?", line) for line in done.stdout.split("### Pairs")[0].splitlines())
                if row[0] == "" and len(row) == 5}
        self.assertEqual(rows["method"], ["bytes", "`trilinear`, 2 maps"])
        self.assertEqual(rows["direct"][1], "1 (1 to 1)")
        errors = {method: float(cells[1].split()[0]) for method, cells in rows.items() if cells[1].endswith(")")}
        self.assertEqual(len(errors), 48)
        self.assertLess(errors["tan_gmm:n=8"], errors["naive_mip"])
        self.assertRegex(done.stdout, r"`tan_gmm:n=4` has [\d.]+ \([\d.]+ to [\d.]+\)\s+of\s+the\s+error\s+of\s+`lean`")
        storages = {tuple(row[1:3]): row[3:6] for row in (re.split(r" ?\| ?", line) for line in done.stdout.split("### Storages")[1].splitlines())
                    if len(row) == 7}
        self.assertEqual(storages["`naive_mip`", "`fp16`"][1:], ["1 (1 to 1)", "1"])
        self.assertAlmostEqual(float(storages["`naive_mip`", "`bc5`"][0]), 4 / 3, delta=0.05)  # 8 bits per texel, and its mips
        self.assertNotEqual(storages["`toksvig`", "`bc1`"][2], "1")
        self.assertIn("## Held-out maps\n\nNot run.", done.stdout)
        members = list((self.folder / "results/development_main").glob("*/results.json"))
        self.assertEqual([json.loads(member.read_text())["pairs"] for member in members], [[], []], "more than 24 methods")
        again = self.study()
        self.assertEqual(again.stdout, done.stdout, "bootstraps are seeded")
        page = self.folder / "page.md"
        page.write_text("# Page\n\n## Maps for development\n\nOld.\n\n## Held-out maps\n\nOld too.\n", encoding="utf-8")
        self.assertEqual(self.study("--keep", page).stdout, done.stdout.replace("Not run.", "Old too."))
        self.quick_model_of_these()

    def quick_model_of_these(self):
        def fitted():
            return subprocess.run([SOURCE / "scripts/studies/quick_model.py", self.out, self.folder / "results"], capture_output=True,
                                  text=True, check=False, env=os.environ)

        alone = fitted()
        self.assertEqual((alone.returncode, "held-out maps" in alone.stderr), (1, True))
        shutil.copytree(self.out / "development", self.out / "held_out", dirs_exist_ok=True)
        shutil.copytree(self.folder / "results/development_main", self.folder / "results/held_out_main")
        done = fitted()
        self.assertEqual(done.returncode, 0, done.stderr)
        model = json.loads(done.stdout)
        self.assertEqual(len(model["methods"]), 48)
        own = model["calibration"][0]
        self.assertEqual((own["scenes"], own["predictions"]), (2, 2 * 48 * 4))
        self.assertEqual([len(level) for level in model["domain"]], 4 * [5])
        self.assertTrue(all(least <= most for level in model["domain"] for least, most in level))
        self.assertEqual(model["surfaces"], [])
        # Nine weights describe the eight errors that they were fitted on.
        self.assertLess(own["median_factor"], 1.2)
        self.assertGreater(own["order_right"], 0.8)
        # A method that some held-out map lacks cannot be calibrated over all of them.
        member = min((self.folder / "results/held_out_main").glob("*/results.json"))
        found = json.loads(member.read_text())
        found["records"] = [record for record in found["records"] if record["method"] != "lean"]
        member.write_text(json.dumps(found), encoding="utf-8")
        fewer = json.loads(fitted().stdout)["methods"]
        self.assertEqual((len(fewer), "lean" in {method["method"] for method in fewer}), (47, False))

    def test_parts_of_roughness_stay_within_their_aim(self):
        """At most 0.6 of the error of tan_gmm over three small maps with gloss maps; a twin without those parts must fail."""
        for surface in ("bumps", "scales", "v_grooves"):
            self.surface(surface, f"{surface}_Normal.png")
            write_stripes(self.tree / f"{surface}_gloss.png", 64, (230, 230, 60))
        self.assertEqual(self.collect().returncode, 0)
        scenes = sorted(str(scene.parent.relative_to(self.out)) for scene in self.out.glob("*/*_gloss/scene.toml"))
        self.assertEqual(len(scenes), 3)
        for roughness, code in (("joint", 0), ("separate", 1)):
            method = f"cells:k=4:roughness={roughness}"
            text = (f'[experiment]\ntitle = "aim"\nmethods = ["direct", "tan_gmm:n=4", "{method}"]\nrepeats = 1\n'
                    f'[matrix]\nscene = {json.dumps(scenes)}\n[reference]\nspp = 64\nsupersampling = [1]\n[threshold]\n')
            text += f'"error({method}) - 0.6 * error(tan_gmm:n=4)" = 0\n'
            (self.out / f"{roughness}.toml").write_text(text)
            done = subprocess.run([PROGRAM, "check", self.out / f"{roughness}.toml", "-o", self.folder / roughness],
                                  capture_output=True, text=True, check=False, env=os.environ)
            self.assertEqual(done.returncode, code, done.stdout + done.stderr)

    def test_errors_are_broken_down_into_filter_lobes_and_fit(self):
        self.surface("bumps", f"{development_name('bumps')}.png", 32)
        self.assertEqual(self.collect().returncode, 0)

        def lobes(*words):
            return subprocess.run([SOURCE / "scripts/studies/real_maps_study.py", self.out, self.folder / "lobes", "--lobes", *words],
                                  capture_output=True, text=True, check=False, env=os.environ)

        missing = lobes()
        self.assertEqual((missing.returncode, "has no results" in missing.stderr), (1, True))
        done = lobes("--run")
        self.assertEqual(done.returncode, 0, done.stderr)
        cells = re.split(r" ?\| ?", done.stdout.splitlines()[2])[1:-1]
        self.assertRegex(cells[0], "^[a-z]+, 1 map$")
        best = float(cells[2])
        for cell in cells[3:]:
            own, fit = map(float, cell.split(";"))
            self.assertLess(best, own)
            self.assertAlmostEqual(own - best, fit, delta=0.01 * own)
        self.assertEqual(lobes("--run").stdout, done.stdout, "what is there is not run again")

    def test_a_tree_without_maps_is_an_error(self):
        done = self.collect()
        self.assertEqual((done.returncode, done.stderr), (1, "real_maps: no normal map was found\n"))

    def test_no_constant_is_chosen_on_held_out_maps(self):
        recorded = json.loads(RECORDED.read_text(encoding="utf-8"))
        self.assertGreater(sum(entry["part"] == "held_out" for entry in recorded["maps"]), 10)
        listed = subprocess.run(["git", "-C", SOURCE, "ls-files", *WITH_CONSTANTS], capture_output=True, text=True, check=False)
        files = [SOURCE / name for name in listed.stdout.splitlines()] or [
            file for folder in WITH_CONSTANTS for file in (SOURCE / folder).rglob("*") if file.is_file()]
        self.assertEqual(held_out_uses(files, recorded), [])
        name = next(entry["file"] for entry in recorded["maps"] if entry["part"] == "held_out")
        (self.folder / "fit.toml").write_text(f'scene = "maps/{pathlib.Path(name).name}"')
        self.assertEqual(len(held_out_uses([self.folder / "fit.toml"], recorded)), 1, "this must be found")


if __name__ == "__main__":
    unittest.main()
