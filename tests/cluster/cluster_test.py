"""A sweep over a real Slurm of this one host: four tasks, one of them killed in its middle and requeued; what is merged
is what a single run says. FOOTPRINT_KILLS: how many kills (1), at random moments over the tasks of a sweep that grows with
their number; FOOTPRINT_SEED: of those moments (1).

Where Slurm is not installed the test says so and is skipped: apt-get install slurmctld slurmd slurm-client munge.
"""

import collections
import os
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "end_to_end"))

from kept_runs import ZOOM, FinishedWorkTest, finished, outcome  # noqa: E402
from one_host_slurm import OneHostSlurm, missing_programs  # noqa: E402
from whole_runs import PROGRAM, SOURCE  # noqa: E402

KILLS = int(os.environ.get("FOOTPRINT_KILLS", "1"))
TASKS = 4 + KILLS // 3
MOST_RESTARTS = 3  # of a task: scripts/slurm/submit
MORE = '"direct", "toksvig", "lean", "roughness_bake", "specular_aa"'  # of a sweep that has to last
SKIPPED = 77


def process_of(part):
    """The id of the program that works on a part, found by the part's own folder; none if it is not running."""
    for entry in pathlib.Path("/proc").iterdir():
        try:
            words = (entry / "cmdline").read_bytes().split(b"\0") if entry.name.isdigit() else []
        except OSError:
            continue
        if words[:1] == [PROGRAM.encode()] and str(part).encode() in words:
            return int(entry.name)
    return None


def state_of(process):
    """Slurm's tasks are not children of this process: R, S, T where it is stopped, Z where it is dead, none where it is gone."""
    try:
        return pathlib.Path(f"/proc/{process}/stat").read_text(encoding="utf-8").rpartition(")")[2].split()[0]
    except OSError:
        return None


def kill_unless_finished(process, part):
    """Kills it in its middle: stops it first, so that its finished work is inspected while it does nothing more. Whether it
    was killed; one that has written its part, or died meanwhile, goes on as it would."""
    try:
        os.kill(process, signal.SIGSTOP)
        while (state := state_of(process)) not in ("T", "Z", "X", None):
            time.sleep(0.001)
        in_its_middle = state == "T" and not (part / "part.json").exists()
        os.kill(process, signal.SIGKILL if in_its_middle else signal.SIGCONT)
        return in_its_middle
    except ProcessLookupError:  # it came to its end
        return False


class Sweep(FinishedWorkTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        members = [cls.write_member(i) for i in range(1 + KILLS)]
        members.append(cls.write("zoom", ZOOM, methods='"direct", "tan_gmm"'))
        cls.group = cls.write_group("group", *members)
        place = tempfile.TemporaryDirectory(prefix="footprint_slurm_")  # short: a socket's path has 108 bytes
        cls.addClassCleanup(place.cleanup)
        slurm = OneHostSlurm(pathlib.Path(place.name) / "s", cpus=2)
        cls.slurm = slurm.__enter__()
        cls.addClassCleanup(slurm.__exit__)

    @classmethod
    def write_member(cls, number):
        """A part is more than its start, so that it has a middle; with many kills all have to last until the last of them."""
        distances = ", ".join(f"{1.1**i:.3f}" for i in range(30))
        zoom = f"[zoom]\ndistances = [{distances}, {20 + number}]\n"
        if KILLS == 1:
            return cls.write(f"distances_{number}", zoom)
        file = cls.write(f"distances_{number}", zoom, methods=MORE)
        file.write_text(file.read_text(encoding="utf-8").replace("spp = 8\n", "spp = 1024\n"), encoding="utf-8")
        return file

    def submit(self, out, *more):
        command = [SOURCE / "scripts/slurm/submit", self.group, "-N", TASKS, "-o", out, "--footprint", PROGRAM, "--poll", 0.2,
                   "--cache", self.folder / "cache", *more]
        return subprocess.Popen([*map(str, command)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                env=self.slurm.environment)

    def kill_one(self, out, before, kills):
        """Kills the program of some part that has finished more than when it was killed last; that part, or none where the
        sweep is past it."""
        parts = [out / "parts" / str(task) for task in range(1, TASKS + 1)]
        self.moments.shuffle(parts)
        for part in parts:
            pieces = len(finished(part))
            if kills[part] == MOST_RESTARTS or pieces <= len(before.get(part, {})) or (part / "part.json").exists():
                continue
            if found := process_of(part):
                time.sleep(self.moments.uniform(0, 0.3) if KILLS > 1 else 0)
                if kill_unless_finished(found, part):
                    return part
        return None

    def kill_in_the_middle(self, process, out, before, kills):
        """Kills one program of the sweep, with what its part had finished; none where the sweep ended before."""
        while process.poll() is None and not all((out / "parts" / str(i + 1) / "part.json").exists() for i in range(TASKS)):
            if part := self.kill_one(out, before, kills):
                return part
            time.sleep(0.01)
        return None

    def start_again_at_once(self, job, part, restarts):
        """Slurm lets two minutes pass before what was requeued starts again; here the wait protects no user."""
        task = f"{job}_{part.name}"
        end = time.monotonic() + 60
        shown = ""
        while not (f"Restarts={restarts}" in shown and "JobState=PENDING" in shown):
            self.assertLess(time.monotonic(), end, f"it was not requeued: {shown}")
            time.sleep(0.1)
            shown = self.slurm.query("scontrol", "show", "job", task)
        time.sleep(2)  # until the node has done with the start that was ended, which those two minutes are for
        self.slurm.query("scontrol", "update", f"JobId={task}", "StartTime=now")

    def test_a_killed_task_is_requeued_and_nothing_is_lost(self):
        whole, out = self.folder / "whole", self.folder / "swept"
        self.must("run", self.group, "-q", "-o", whole)
        process = self.submit(out)
        self.addCleanup(process.kill)
        before, kills = {}, collections.Counter()
        self.moments = random.Random(int(os.environ.get("FOOTPRINT_SEED", "1")))
        while kills.total() < KILLS and (part := self.kill_in_the_middle(process, out, before, kills)):
            before[part] = finished(part)
            kills[part] += 1
            job = (out / "job").read_text(encoding="utf-8").strip()
            self.start_again_at_once(job, part, kills[part])
        print(f"{kills.total()} of {KILLS} kills, over {len(kills)} of {TASKS} tasks")
        self.assertEqual(kills.total(), KILLS)
        output, errors = process.communicate(timeout=600)
        logs = "".join(f"{log.name}: {log.read_text(encoding='utf-8')}" for log in sorted((out / "logs").glob("*.log")))
        self.assertEqual(process.returncode, 0, errors + logs)
        self.assertIn(f"{TASKS} of {TASKS} parts finished", errors)
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
        others = lambda: {part: (part / "part.json").stat().st_mtime_ns for part in (out / "parts").iterdir() if part.name != "3"}
        before = others()
        _, errors = self.submit(out).communicate(timeout=240)
        self.assertIn(f"parts 3 of {TASKS}", errors)
        self.assertEqual(before, others())
        self.assertTrue((out / "parts/3/part.json").is_file())

    def test_a_kill_strikes_in_the_middle_or_not_at_all(self):
        part = self.folder / "struck"
        part.mkdir()
        for finishes, state in ((False, -signal.SIGKILL), (True, 0)):
            if finishes:
                (part / "part.json").touch()
            process = subprocess.Popen(["sleep", "0.2"])
            self.assertEqual(kill_unless_finished(process.pid, part), not finishes)
            self.assertEqual(process.wait(timeout=10), state)
        (part / "part.json").unlink()
        process = subprocess.Popen(["true"])
        while state_of(process.pid) != "Z":
            time.sleep(0.01)
        self.assertFalse(kill_unless_finished(process.pid, part))
        process.wait(timeout=10)
        self.assertFalse(kill_unless_finished(process.pid, part))

    def test_what_is_wrong_is_not_tried_again(self):
        out = self.folder / "wrong"
        _, errors = (process := self.submit(out, "--run=--only=nothing")).communicate(timeout=240)
        self.assertEqual(process.returncode, 2, errors)
        self.assertIn(f"parts 1-{TASKS} are not finished: see", errors)
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
