"""Runs the program and reads back what it wrote with programs that are not its own."""

import json
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

PROGRAM = os.environ["FOOTPRINT_PROGRAM"]
SOURCE = pathlib.Path(os.environ["FOOTPRINT_SOURCE_DIR"])
ALL_TESTS = "FOOTPRINT_ALL_TESTS" in os.environ  # `scripts/test --all`: whole sweeps
HAS_COMPILERS = os.environ.get("FOOTPRINT_HAS_COMPILERS") != "OFF"  # of shaders (FOOTPRINT_SHADER_COMPILERS)
needs_compilers = unittest.skipUnless(HAS_COMPILERS, "this build has no compilers of shaders")


def run(*arguments):
    """The output of the program; fails with its error line."""
    done = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, check=False)
    assert done.returncode == 0, f"{arguments}: exit code {done.returncode}: {done.stderr}"
    return done.stdout


class WholeRunTest(unittest.TestCase):
    """Tests that share one scratch folder, removed at the end."""

    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory(prefix="footprint_end_to_end_")
        cls.addClassCleanup(cls.scratch.cleanup)
        cls.folder = pathlib.Path(cls.scratch.name)

    def assert_fails(self, done, code, *texts):
        """One line on standard error that has these texts, and the exit code."""
        self.assertEqual(done.returncode, code, done.stderr)
        self.assertEqual(len(done.stderr.strip().splitlines()), 1, done.stderr)
        for text in ("footprint: ", *texts):
            self.assertIn(text, done.stderr)

    @classmethod
    def compare(cls, name, *arguments):
        """The folder of a small comparison, quick to time."""
        folder = cls.folder / name
        run("compare", *arguments, "--repeats", 1, "--quiet", "-o", folder)
        return folder

    @classmethod
    def render(cls, name, *arguments):
        file = cls.folder / f"{name}.exr"
        run("render", *arguments, "--quiet", "-o", file)
        return file

    def assert_alike(self, first, second, largest, percent_beyond=0.0):
        """No channel of more than so many pixels differs by more than `largest`, as idiff finds it."""
        limits = ["-fail", largest, "-failpercent", percent_beyond, "-warn", largest, "-warnpercent", percent_beyond]
        done = subprocess.run(
            ["idiff", *map(str, limits), first, second], capture_output=True, text=True, check=False
        )
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def assert_matches_schema(self, out):
        validator = SOURCE / "tests" / "report" / "schema_test.py"
        command = ["/usr/bin/python3", "-B", validator, SOURCE / "docs" / "results.schema.json", out / "results.json"]
        done = subprocess.run([*map(str, command)], capture_output=True, text=True, check=False)
        self.assertIn(done.returncode, (0, 77), done.stderr)


def program_with(folder, shader, old, new):
    """A copy of the program in `folder` in which the text of a shader has `new` for `old`, in place of its first comment."""
    text = (SOURCE / shader).read_bytes()
    head = text[:text.find(b"*/\n") + 3] if text.startswith(b"/*") else b""
    changed = text[len(head):].partition(b"\n#")[2]
    assert old in changed, f"{shader} has no {old}"
    changed = (head + b"#" + changed.replace(old, new)).ljust(len(text))
    program = pathlib.Path(PROGRAM).read_bytes()
    assert len(changed) == len(text) and program.count(text) == 1, f"{shader}: no room for {new}, or not in the program"
    path = folder / "program"
    path.write_bytes(program.replace(text, changed))
    path.chmod(0o755)
    return path


def results_of(folder):
    return json.loads((folder / "results.json").read_text(encoding="utf-8"))


def largest_difference(first, second):
    """The largest difference of any channel of any pixel, as idiff finds it."""
    done = subprocess.run(["idiff", "-fail", "0", "-warn", "0", first, second], capture_output=True, text=True, check=False)
    if done.returncode == 0:
        return 0.0
    found = re.search(r"Max error\s*=\s*(\S+)", done.stdout)
    assert found, f"idiff {first} {second}: {done.stdout} {done.stderr}"
    return float(found[1])


def picture_facts(files):
    """The facts of oiiotool on each file: size, channels, statistics."""
    done = subprocess.run(["oiiotool", "--info", "-v", "--stats", *files], capture_output=True, text=True, check=True)
    facts = {}
    for block in done.stdout.split("Reading ")[1:]:
        size = re.search(r"(\d+) x\s+(\d+), (\d+) channel, (\S+) (\S+)", block)
        facts[block.split("\n", 1)[0].strip()] = {
            "size": (int(size[1]), int(size[2])),
            "format": f"{size[4]} {size[5]}",
            "channels": re.search(r"channel list: (.*)", block)[1],
            "unusable": [int(n) for n in " ".join(re.findall(r"(?:Nan|Inf)Count: (.*)", block)).split()],
            "least": [float(n) for n in re.search(r"Stats Min: ([^(]*)", block)[1].split()],
            "most": [float(n) for n in re.search(r"Stats Max: ([^(]*)", block)[1].split()],
        }
    return facts
