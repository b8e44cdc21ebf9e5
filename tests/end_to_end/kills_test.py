"""`compare` killed or interrupted at any moment leaves no list or page over anything but one run's files.

FOOTPRINT_KILLS: how many of each kind (scripts/kills asks for more); FOOTPRINT_SEED: of their moments.
"""

import os
import pathlib
import random
import shutil
import signal
import subprocess
import time
import unittest

from kept_runs import outcome
from whole_runs import PROGRAM, WholeRunTest, results_of

KILLS = int(os.environ.get("FOOTPRINT_KILLS", "2"))
SEED = int(os.environ.get("FOOTPRINT_SEED", "1"))
SETTINGS = ["ribbed_plane", "--methods", "direct,toksvig", "--size", "24x20", "--spp", "8", "--distance", "1,2"]


class Killed(WholeRunTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.before = cls.compare("before", *SETTINGS, "--seed", "8")
        begin = time.monotonic()
        cls.after = cls.compare("after", *SETTINGS, "--seed", "7")
        cls.seconds = time.monotonic() - begin
        cls.states = [outcome(cls.before), outcome(cls.after)]
        cls.random = random.Random(SEED)

    def stopped(self, out, number):
        """Exit code and standard error of a comparison that gets a signal at some moment, often while files move."""
        process = subprocess.Popen([PROGRAM, "compare", *SETTINGS, "--repeats", "1", "--quiet", "--seed", "7", "-o", out], stdout=subprocess.DEVNULL,
                                   stderr=subprocess.PIPE, text=True)
        time.sleep(self.seconds * self.random.choice([self.random.uniform(0, 1), self.random.uniform(0.85, 1)]))
        process.send_signal(number)
        errors = process.communicate()[1]
        if process.returncode == -signal.SIGINT and not errors:  # while its libraries are loaded; shells call it 130 too
            return 130, "footprint: interrupted"
        return process.returncode, errors

    def left_beside(self, out):
        return [path.name for path in out.parent.glob(f".{out.name}*")]

    def assert_old_or_new(self, out, states):
        """If a list or a page exists, all images are of one state, and results.json, if it exists, is of the same."""
        if not any(path.is_file() for path in out.glob("*")):
            return  # images without a list: they are not a run
        there = {place: content for place, content in outcome(out).items() if ".partial-" not in place.parts[0]}
        pictures = lambda state: {place: content for place, content in state.items() if place.suffix != ".json"}
        of = [state for state in states if pictures(state) == pictures(there)]
        self.assertTrue(of, f"{out}: pictures of neither the old run nor the new one, or of both")
        listed = pathlib.Path("results.json")
        self.assertTrue(listed not in there or there == of[0], f"{out}: results.json is of another run than the pictures")

    def stop_many_times(self, number, code):
        """Over nothing and over an earlier run in turn, until KILLS came before the end."""
        stopped = 0
        for attempt in range(20 * KILLS):
            out = self.folder / f"out_{int(number)}_{attempt % 2}"
            over = attempt % 2 == 1
            if over and not out.exists():
                shutil.copytree(self.before, out)
            states = [self.states[0] if over else {}, self.states[1]]
            returned, errors = self.stopped(out, number)
            self.assertIn(returned, (0, code), errors)
            self.assert_old_or_new(out, states)
            if returned == 0:
                self.assertTrue(outcome(out) == self.states[1], f"{out} is not what an undisturbed run leaves")
                shutil.rmtree(out)
                continue
            if code == 130:
                self.assertEqual(self.left_beside(out), [], "an interrupted comparison cleans up behind itself")
                self.assertRegex(errors.strip().splitlines()[-1], "^footprint: .*interrupted")
            shutil.rmtree(out, ignore_errors=True)
            stopped += 1
            if stopped == KILLS:
                break
        self.assertEqual(stopped, KILLS)

    def test_killed(self):
        self.stop_many_times(signal.SIGKILL, -signal.SIGKILL)
        for turn in range(2):  # the next run takes away what killed ones left
            out = self.folder / f"out_{int(signal.SIGKILL)}_{turn}"
            self.compare(out.name, *SETTINGS, "--seed", "7")
            self.assertTrue(outcome(out) == self.states[1], f"{out} is not what an undisturbed run leaves")
            self.assertEqual(self.left_beside(out), [])

    def test_interrupted(self):
        self.stop_many_times(signal.SIGINT, 130)

    def test_a_run_in_progress_has_a_page(self):
        out = self.folder / "going"
        process = subprocess.Popen([PROGRAM, "compare", *SETTINGS[:-2], "--distance", "1,2,3,4", "--repeats", "400", "-o", out], stdout=subprocess.DEVNULL,
                                   stderr=subprocess.PIPE, text=True)
        self.addCleanup(process.kill)
        end = time.monotonic() + 60
        while not (pages := list(self.folder.glob(".going*/index.html"))):
            self.assertLess(time.monotonic(), end)
            self.assertIsNone(process.poll())
            time.sleep(0.01)
        results = results_of(pages[0].parent)
        distances = sorted({record["distance"] for record in results["records"]})
        self.assertEqual(distances, [1, 2, 3, 4][: len(distances)])
        self.assertLess(len(distances), 4)
        self.assertIn("the run is not finished; more distances follow", results["scene"]["warnings"])
        for record in results["records"]:
            for image in (record["images"]["color"], record["images"]["error"]):
                self.assertTrue((pages[0].parent / image).is_file(), image)
        process.send_signal(signal.SIGINT)
        self.assertIn(f"page of the finished distances, until the run ends: {pages[0]}", process.communicate()[1])
        self.assertEqual(process.returncode, 130)
        self.assertFalse(out.exists() or self.left_beside(out))

    def test_a_mixture_is_found_out(self):
        mixed = self.folder / "mixed"
        shutil.copytree(self.before, mixed)
        (mixed / "images/d1_reference.exr").write_bytes((self.after / "images/d1_reference.exr").read_bytes())
        with self.assertRaises(AssertionError):
            self.assert_old_or_new(mixed, self.states)


if __name__ == "__main__":
    unittest.main()
