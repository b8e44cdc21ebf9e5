"""Small experiments that store their finished work, for the tests that kill, split and merge them."""

import json
import subprocess

from whole_runs import PROGRAM, WholeRunTest

HEAD = """[experiment]
title = "A small one"
scene = "{scene}"
size = [24, 20]
methods = [{methods}]
repeats = 1
[reference]
spp = 8
supersampling = [1, 4]
"""
DISTANCES = "[zoom]\ndistances = [1, 2, 6]\n"
ZOOM = "[zoom]\nfrom = 1.5\nto = 3\nframes = 3\n"
MATRIX = """[zoom]
distances = [1, 2]
[matrix]
seed = [1, 2]
footprint = ["trilinear", "box:2"]
[threshold]
"error(toksvig, seed=2)" = 0.9
"error(direct, footprint=box:2, distance=2)" = 0.9
"""
NDF = '[[ndf]]\nname = "one"\nfootprint = [0.1, 0.1, 0.3, 0.3]\n'
METHODS = '"direct", "toksvig"'


def without_times(results):
    """The document without what a clock, or which machine it was, decides."""
    for point in results["supersampling"]:
        del point["ms"], point["node"]
    for record in results["records"]:
        for key in ("node", "frame_ms", "frame_build_ms", "fps", "ratio_to_direct"):
            del record["time"][key]
        del record["precompute"]["seconds"], record["precompute"]["cached"]
    del results["reference"]["seconds"]
    return results


def outcome(folder):
    """All results and pictures below a folder, by their place."""
    found = {}
    for file in sorted(folder.rglob("*")):
        place = file.relative_to(folder)
        if "kept" in place.parts or not file.is_file():
            continue
        if file.name == "results.json":
            found[place] = without_times(json.loads(file.read_text(encoding="utf-8")))
        elif file.name == "matrix.json":
            found[place] = json.loads(file.read_text(encoding="utf-8"))
        elif file.suffix in (".exr", ".png"):
            found[place] = file.read_bytes()
    return found


def finished(folder):
    """When each finished part was written, by its key RUN/NAME."""
    work = folder / "kept"
    return {str(file.relative_to(work).with_suffix("")): file.stat().st_mtime_ns for file in work.glob("*/*.json")}


def names(keys):
    """The names of parts, sorted."""
    return sorted(key.split("/")[1] for key in keys)


class FinishedWorkTest(WholeRunTest):
    """Writes experiments and runs them; files stand under absolute paths, so that reports name them alike."""

    @classmethod
    def write(cls, name, content=DISTANCES, scene="ribbed_plane", methods=METHODS):
        file = cls.folder / f"{name}.toml"
        file.write_text(HEAD.format(scene=scene, methods=methods) + content, encoding="utf-8")
        return file

    @classmethod
    def write_group(cls, name, *members):
        file = cls.folder / f"{name}.toml"
        names = ", ".join(f'"{member.stem}"' for member in members)
        file.write_text(f'[experiment]\ntitle = "All"\nmembers = [{names}]\n', encoding="utf-8")
        return file

    @classmethod
    def start(cls, *arguments):
        return subprocess.Popen([PROGRAM, *map(str, arguments)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)

    @classmethod
    def execute(cls, *arguments):
        """Exit code and standard error."""
        process = cls.start(*arguments)
        _, errors = process.communicate()
        return process.returncode, errors

    def must(self, *arguments):
        code, errors = self.execute(*arguments)
        self.assertEqual(code, 0, errors)
        return errors

    def assert_same_outcome(self, first, second):
        self.assertEqual(first.keys(), second.keys())
        for place, content in first.items():
            if isinstance(content, dict):
                for key in content:
                    self.assertEqual(content[key], second[place][key], f"{place}: {key}")
            else:
                self.assertTrue(content == second[place], f"{place} differs")
