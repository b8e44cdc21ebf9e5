"""A run goes on where it was killed: nothing is lost, nothing is measured twice, and the result is that of one run.

FOOTPRINT_KILLS: how many kills at random moments (scripts/kills asks for more); FOOTPRINT_SEED: of those moments.
"""

import os
import random
import shutil
import time
import unittest

from kept_runs import DISTANCES, MATRIX, METHODS, NDF, ZOOM, FinishedWorkTest, finished, names, outcome

KILLS = int(os.environ.get("FOOTPRINT_KILLS", "3"))
SEED = int(os.environ.get("FOOTPRINT_SEED", "1"))
ALL_PARTS = 9  # two members, each with 3 distances and a head; the NDF of one


class WholeAndKilled(FinishedWorkTest):
    """An experiment that was run whole once, and what it takes to kill it; a subclass says which (`written`)."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.experiment = cls.written()
        cls.whole = cls.folder / "whole"
        begin = time.monotonic()
        code, errors = cls.execute("run", cls.experiment, "-q", "-o", cls.whole)
        cls.seconds = time.monotonic() - begin
        assert code == 0, errors
        cls.expected = outcome(cls.whole)

    def copy(self, name):
        out = self.folder / name
        shutil.copytree(self.whole, out)
        return out

    def run_until(self, out, stop):
        """Starts the run and kills it as soon as `stop` says so; whether it was killed."""
        process = self.start("run", self.experiment, "-q", "-o", out)
        while process.poll() is None and not stop():
            time.sleep(0.002)
        killed = process.poll() is None
        process.kill()
        _, errors = process.communicate()
        if not killed:
            self.assertEqual(process.returncode, 0, errors)
        return killed

    def assert_goes_on(self, out, before):
        """Finished parts are unchanged, the rest is done, and no file is left that a run would not leave."""
        self.must("run", self.experiment, "-q", "-o", out)
        after = finished(out)
        self.assertEqual({key: after.get(key) for key in before}, before, "finished work was lost or done again")
        self.assertEqual(after.keys(), finished(self.whole).keys())
        self.assert_same_outcome(self.expected, outcome(out))
        left = [p.name for p in [*out.iterdir(), *out.parent.glob(f".{out.name}*")] if ".partial-" in p.name]
        self.assertEqual(left, [], "the killed run's own folder stays")

    def kill_at_random_moments(self):
        generator = random.Random(SEED)
        out, kills, before = self.folder / "random", 0, {}
        for attempt in range(20 * KILLS):
            moment = time.monotonic() + generator.uniform(0.02, self.seconds)
            killed = self.run_until(out, lambda end=moment: time.monotonic() > end)
            now = finished(out)
            self.assertEqual({key: now.get(key) for key in before}, before, f"attempt {attempt}")
            before, kills = now, kills + killed
            if kills == KILLS:
                break
            if not killed:  # it got to its end: that is one whole run, and the next starts over
                self.assert_goes_on(out, before)
                shutil.rmtree(out)
                before = {}
        self.assertEqual(kills, KILLS)
        self.assert_goes_on(out, before)


class ResumedMatrix(WholeAndKilled):
    @classmethod
    def written(cls):
        return cls.write("matrix", MATRIX)

    def test_killed_at_random_moments(self):
        self.kill_at_random_moments()


class Resumed(WholeAndKilled):
    @classmethod
    def written(cls):
        cls.distances = cls.write("distances", DISTANCES + NDF)
        return cls.write_group("group", cls.distances, cls.write("zoom", ZOOM))

    def test_killed_at_random_moments(self):
        self.kill_at_random_moments()

    def test_how_many_parts_there_are(self):
        self.assertEqual(len(finished(self.whole)), ALL_PARTS)

    def test_killed_after_a_few_parts(self):
        for count in (1, 5):
            out = self.folder / f"after_{count}"
            self.run_until(out, lambda o=out, c=count: len(finished(o)) >= c)
            before = finished(out)
            self.assertGreaterEqual(len(before), count)
            self.assert_goes_on(out, before)

    def test_a_whole_run_is_reported_again_and_nothing_measured(self):
        out = self.copy("again")
        before = finished(out)
        errors = self.must("run", self.experiment, "-o", out)
        self.assertIn("finished parts of an earlier run were reused from", errors)
        self.assertEqual(finished(out), before)
        self.assert_same_outcome(self.expected, outcome(out))

    def test_fresh_measures_again(self):
        out = self.copy("fresh")
        before = finished(out)
        self.must("run", self.experiment, "-q", "--fresh", "-o", out)
        after = finished(out)
        self.assertEqual(after.keys(), before.keys())
        self.assertFalse([key for key in after if after[key] == before[key]])

    # Only damaged parts are done again.

    def assert_done_again(self, out, before, expected):
        after = finished(out)
        self.assertEqual(names(key for key in after if after[key] != before.get(key)), expected)

    def test_a_damaged_part_is_measured_again(self):
        out = self.copy("damaged")
        before = finished(out)
        part = sorted((out / "kept").glob("*/distance_6.json"))[0]
        content = bytearray(part.read_bytes())
        content[len(content) // 2] ^= 1
        part.write_bytes(content)
        self.must("run", self.experiment, "-q", "-o", out)
        self.assert_done_again(out, before, ["distance_6"])
        self.assert_same_outcome(self.expected, outcome(out))

    def test_a_damaged_picture_is_rendered_again(self):
        out = self.copy("damaged_picture")
        before = finished(out)
        # The stored image and the one in images/ are one file, unless it was copied.
        of_direct = (self.whole / "distances/images/d2_direct.exr").read_bytes()
        for file in (out / "kept").glob("*/images/d2_direct.exr"):
            if file.read_bytes() == of_direct:
                file.write_bytes(of_direct[:-1] + b"?")
        self.must("run", self.experiment, "-q", "-o", out)
        self.assert_done_again(out, before, ["distance_2"])
        self.assert_same_outcome(self.expected, outcome(out))


SCENE = """[surface]
name = "bumps"
resolution = 64
seed = 1
[brdf]
distribution = "blinn_phong"
exponent = 64.0
[[light]]
type = "directional"
direction = [-0.4, -0.3, -1.0]
intensity = {}
"""


class Changed(FinishedWorkTest):
    """Only parts that depend on a change are measured again."""

    def parts_after(self, distances, more="", methods=METHODS):
        """The names of the parts that a run of such a file adds."""
        out = self.folder / "out"
        file = self.write("changing", f"[zoom]\ndistances = {distances}\n{more}", self.scene, methods)
        before = finished(out)
        self.must("run", file, "-q", "-o", out)
        return names(key for key in finished(out) if key not in before)

    def test_changes(self):
        self.scene = self.folder / "own.toml"
        self.scene.write_text(SCENE.format(1.5), encoding="utf-8")
        everything = ["distance_1", "distance_2", "head"]
        self.assertEqual(self.parts_after([1, 2]), everything)
        self.assertEqual(self.parts_after([1, 2], '[threshold]\n"error(toksvig)" = 1\n'), [], "a threshold")
        self.assertEqual(self.parts_after([1, 2, 3]), ["distance_3"], "a distance more")
        self.assertEqual(self.parts_after([1, 2], methods=METHODS + ', "naive_mip"'), everything, "a method more")
        self.scene.write_text(SCENE.format(2.5), encoding="utf-8")
        self.assertEqual(self.parts_after([1, 2]), everything, "another light")


if __name__ == "__main__":
    unittest.main()
