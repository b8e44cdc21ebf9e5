"""A sweep over a real Slurm of this one host: four tasks, one of them killed in its middle and requeued; what is merged
is what a single run says. FOOTPRINT_KILLS: how many kills, over all tasks (1).

Where Slurm is not installed the test says so and is skipped: apt-get install slurmctld slurmd slurm-client munge.
"""

import collections
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "end_to_end"))

from kept_runs import DISTANCES, ZOOM, KeptRunTest, finished, outcome  # noqa: E402
from one_host_slurm import OneHostSlurm, missing_programs  # noqa: E402
from whole_runs import PROGRAM, SOURCE  # noqa: E402

TASKS = 4
KILLS = int(os.environ.get("FOOTPRINT_KILLS", "1"))
SKIPPED = 77


def process_of(part):
    """The id of the program that works on a part, told by the part's own folder; none while there is none."""
    for entry in pathlib.Path("/proc").iterdir():
        try:
            words = (entry / "cmdline").read_bytes().split(b"\0") if entry.name.isdigit() else []
        except OSError:
            continue
        if words[:1] == [PROGRAM.encode()] and str(part).encode() in words:
            return int(entry.name)
    return None


class Sweep(KeptRunTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        members = [cls.write(f"distances_{i}", DISTANCES.replace("1", str(i))) for i in (1, 4)] + [cls.write("zoom", ZOOM, methods='"direct", "tan_gmm"')]
        cls.group = cls.write_group("group", *members)
        place = tempfile.TemporaryDirectory(prefix="footprint_slurm_")  # short: a socket's path has 108 bytes
        cls.addClassCleanup(place.cleanup)
        slurm = OneHostSlurm(pathlib.Path(place.name) / "s", cpus=2)
        cls.slurm = slurm.__enter__()
        cls.addClassCleanup(slurm.__exit__)

    def submit(self, out, *more):
        command = [SOURCE / "scripts/slurm/submit", self.group, "-N", TASKS, "-o", out, "--footprint", PROGRAM, "--poll", 0.2,
                   "--cache", self.folder / "cache", *more]
        return subprocess.Popen([*map(str, command)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                env=self.slurm.environment)

    def kill_in_the_middle(self, process, part, least):
        """Kills the program of a part once it has finished `least` pieces of it; the pieces that were there, or none
        where the part came to its end before."""
        while process.poll() is None and not (part / "part.json").exists():
            found = process_of(part) if len(finished(part)) >= least else None
            if found:
                os.kill(found, signal.SIGKILL)
                return finished(part)
            time.sleep(0.002)
        return None

    def start_again_at_once(self, job, part, restarts):
        """Slurm lets two minutes pass before what was requeued starts again; here there is nobody to be spared."""
        task = f"{job}_{part.name}"
        end = time.monotonic() + 60
        shown = ""
        while not (f"Restarts={restarts}" in shown and "JobState=PENDING" in shown):
            self.assertLess(time.monotonic(), end, f"it was not requeued: {shown}")
            time.sleep(0.1)
            shown = self.slurm.ask("scontrol", "show", "job", task)
        time.sleep(2)  # until the node has done with the start that was ended, which those two minutes are for
        self.slurm.ask("scontrol", "update", f"JobId={task}", "StartTime=now")

    def test_a_killed_task_is_requeued_and_nothing_is_lost(self):
        whole, out = self.folder / "whole", self.folder / "swept"
        self.must("run", self.group, "-q", "-o", whole)
        process = self.submit(out)
        self.addCleanup(process.kill)
        before, kills = {}, collections.Counter()
        for kill in range(KILLS):
            part = out / "parts" / str(2 + kill % 3)
            pieces = self.kill_in_the_middle(process, part, 1 + len(before.get(part, {})))
            if pieces is None:
                continue
            before[part] = pieces
            kills[part] += 1
            job = (out / "job").read_text(encoding="utf-8").strip()
            self.start_again_at_once(job, part, kills[part])
        print(f"{kills.total()} of {KILLS} kills hit a part in its middle")
        self.assertGreaterEqual(kills.total(), 1)
        output, errors = process.communicate(timeout=240)
        logs = "".join(f"{log.name}: {log.read_text(encoding='utf-8')}" for log in sorted((out / "logs").glob("*.log")))
        self.assertEqual(process.returncode, 0, errors + logs)
        self.assertIn(f"4 of {TASKS} parts finished", errors)
        self.assertIn("page: ", output)
        for part, pieces in before.items():
            self.assertTrue(pieces)
            now = finished(part)
            self.assertEqual({key: now.get(key) for key in pieces}, pieces, "finished work was done again")
            self.assertIn("ended with 137", (out / "logs" / f"{part.name}.log").read_text(encoding="utf-8"))
        self.assert_same_outcome(outcome(whole), self.merged(out))
        self.assertEqual(finished(out).keys(), finished(whole).keys())
        self.assertTrue(any((self.folder / "cache").iterdir()), "bakes go to the node's own folder")
        self.goes_on(out)

    def merged(self, out):
        return {place: content for place, content in outcome(out).items() if place.parts[0] != "parts"}

    def goes_on(self, out):
        """The same command again submits the part that is missing, and it alone."""
        shutil.rmtree(out / "parts/3")
        others = {part: (out / "parts" / part / "part.json").stat().st_mtime_ns for part in "124"}
        _, errors = self.submit(out).communicate(timeout=240)
        self.assertIn("parts 3 of 4", errors)
        self.assertEqual(others, {part: (out / "parts" / part / "part.json").stat().st_mtime_ns for part in "124"})
        self.assertTrue((out / "parts/3/part.json").is_file())

    def test_what_is_wrong_is_not_tried_again(self):
        out = self.folder / "wrong"
        _, errors = (process := self.submit(out, "--run=--only=nothing")).communicate(timeout=240)
        self.assertEqual(process.returncode, 2, errors)
        self.assertIn("parts 1-4 are not finished: see", errors)
        self.assertIn("--only: no member of group", (out / "logs/1.log").read_text(encoding="utf-8"))

    def test_a_job_that_slurm_refuses(self):
        _, errors = (process := self.submit(self.folder / "refused", "--sbatch=--partition=none")).communicate(timeout=60)
        self.assertEqual(process.returncode, 2)
        self.assertIn("sbatch refused the job", errors)


if __name__ == "__main__":
    if missing := missing_programs():
        print(f"skipped: {', '.join(missing)} not found; apt-get install slurmctld slurmd slurm-client munge")
        sys.exit(SKIPPED)
    unittest.main()
