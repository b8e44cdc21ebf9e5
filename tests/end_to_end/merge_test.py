"""Parts of a run joined: the result is that of one run, and parts that do not fit are refused, each for its own reason."""

import json
import shutil
import unittest

from kept_runs import DISTANCES, MATRIX, NDF, ZOOM, FinishedWorkTest, finished, outcome

COUNT = 3


class Merged(FinishedWorkTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.distances = cls.write("distances", DISTANCES + NDF)
        cls.zoom = cls.write("zoom", ZOOM)
        cls.group = cls.write_group("group", cls.distances, cls.zoom)
        cls.whole = cls.folder / "whole"
        cls.parts = [cls.folder / f"part_{i}" for i in range(1, COUNT + 1)]
        runs = [["-o", cls.whole]] + [["--shard", f"{i}/{COUNT}", "-o", part] for i, part in enumerate(cls.parts, 1)]
        for arguments in runs:
            code, errors = cls.execute("run", cls.group, "-q", *arguments)
            assert code == 0, errors
        cls.expected = outcome(cls.whole)

    def copy(self, part, name):
        out = self.folder / name
        shutil.copytree(self.parts[part], out)
        return out

    def with_document(self, part, name, **changes):
        """A copy of a part whose part.json says something else."""
        out = self.copy(part, name)
        document = json.loads((out / "part.json").read_text(encoding="utf-8"))
        document.update(changes)
        (out / "part.json").write_text(json.dumps(document), encoding="utf-8")
        return out

    def assert_refused(self, parts, *words):
        out = self.folder / "refused"
        code, errors = self.execute("merge", *parts, "-q", "-o", out)
        self.assertEqual(code, 2, errors)
        for word in words:
            self.assertIn(word, errors)
        self.assertFalse(list(out.rglob("results.json")), "nothing is reported")
        shutil.rmtree(out, ignore_errors=True)

    def test_the_parts_in_any_order_are_one_run(self):
        out = self.folder / "merged"
        self.must("merge", self.parts[2], self.parts[0], self.parts[1], "-q", "-o", out)
        self.assert_same_outcome(self.expected, outcome(out))
        self.assertEqual(finished(out).keys(), finished(self.whole).keys())
        node = json.loads((out / "zoom/results.json").read_text(encoding="utf-8"))["records"][0]["time"]["node"]
        self.assertEqual(node, json.loads((self.parts[2] / "part.json").read_text(encoding="utf-8"))["node"])

    def test_each_part_does_its_own_and_no_more(self):
        records = [{key for key in finished(part) if "/distance_" in key} for part in self.parts]
        self.assertEqual(sum(map(len, records)), len(set.union(*records)), "nothing is measured twice")
        self.assertTrue(all(records))

    def test_more_parts_than_work(self):
        parts = [self.folder / f"many_{i}" for i in range(1, 3)]
        single = self.write("single", "[zoom]\ndistances = [1]\n")
        for i, part in enumerate(parts, 1):
            self.must("run", single, "-q", "--shard", f"{i}/2", "-o", part)
        self.assertEqual(sorted(len(finished(part)) for part in parts), [0, 2])
        self.must("merge", *parts, "-q", "-o", self.folder / "of_many")
        self.assertTrue((self.folder / "of_many/index.html").is_file())

    def test_members_that_were_chosen(self):
        part = self.folder / "only"
        self.must("run", self.group, "-q", "--only", "^zo+m$", "--shard", "1/1", "-o", part)
        self.must("merge", part, "-q", "-o", self.folder / "of_only")
        self.assertEqual(sorted(p.name for p in (self.folder / "of_only").iterdir()), ["kept", "zoom"])

    def test_a_matrix_in_parts_goes_on_as_one(self):
        """Members that were run before are not run again, and parts of all of them are one matrix."""
        file, whole = self.write("matrix", MATRIX), self.folder / "matrix_whole"
        self.must("run", file, "-q", "--only", "seed2", "-o", whole)
        before = finished(whole)
        self.must("run", file, "-q", "-o", whole)
        after = finished(whole)
        self.assertEqual({key: after.get(key) for key in before}, before, "finished work was done again")
        self.assertGreater(len(after), len(before))
        parts = [self.folder / f"matrix_{i}" for i in range(1, 4)]
        for i, part in enumerate(parts, 1):
            self.must("run", file, "-q", "--shard", f"{i}/3", "-o", part)
        merged = self.folder / "matrix_merged"
        self.must("merge", *parts, "-q", "-o", merged)
        self.assert_same_outcome(outcome(whole), outcome(merged))
        document = json.loads((merged / "matrix.json").read_text(encoding="utf-8"))
        self.assertEqual([member["folder"] for member in document["members"]],
                         ["trilinear-seed1", "trilinear-seed2", "box_2-seed1", "box_2-seed2"])
        self.assertTrue(all(threshold["held"] for threshold in document["experiment"]["thresholds"]))

    # Parts that do not fit.

    def test_a_part_is_missing(self):
        self.assert_refused([self.parts[0], self.parts[2]], "part 2 of 3 is missing", "--shard 2/3")

    def test_a_part_is_there_twice(self):
        self.assert_refused([*self.parts, self.copy(0, "again")], "is part 1, and so is", str(self.parts[0]))

    def test_a_part_is_not_finished(self):
        part = self.copy(1, "unfinished")
        (part / "part.json").unlink()
        self.assert_refused([self.parts[0], part, self.parts[2]], "unfinished/part.json", "unfinished")

    def test_a_part_of_another_experiment(self):
        other = self.folder / "other"
        self.must("run", self.zoom, "-q", "--shard", f"2/{COUNT}", "-o", other)
        self.assert_refused([self.parts[0], other, self.parts[2]], "other/part.json", "another experiment")

    def test_a_part_of_other_options(self):
        other = self.folder / "quick"
        self.must("run", self.group, "-q", "--quick", "--shard", f"2/{COUNT}", "-o", other)
        self.assert_refused([self.parts[0], other, self.parts[2]], "quick/part.json", "other options")

    def test_a_part_of_another_program(self):
        maker = "0123456789abcdef llvmpipe"
        self.assert_refused([self.parts[0], self.with_document(1, "program", maker=maker), self.parts[2]],
                            "program/part.json", "another program")
        own = [self.with_document(i, f"program_{i}", maker=maker) for i in range(COUNT)]
        self.assert_refused(own, "another program than this one")

    def test_a_part_of_another_count(self):
        self.assert_refused([self.parts[0], self.with_document(1, "count", shard=[2, 4]), self.parts[2]],
                            "one of 4 parts", "one of 3")

    def test_a_damaged_list(self):
        part = self.copy(1, "list")
        (part / "part.json").write_text("{", encoding="utf-8")
        self.assert_refused([self.parts[0], part, self.parts[2]], "list/part.json", "is damaged")
        for number, change in enumerate([{"shard": [0, COUNT]}, {"shard": [2, 1e300]}, {"shard": [-1, -1]},
                                         {"processes": -3}, {"tile": 2**40}, {"keys": [1]}]):
            name = f"numbers_{number}"
            part = self.with_document(1, name, **change)
            self.assert_refused([self.parts[0], part, self.parts[2]], f"{name}/part.json", "is damaged")

    def test_damaged_work(self):
        part = self.copy(1, "work")
        item = sorted((part / "kept").glob("*/distance_*.json"))[0]
        content = bytearray(item.read_bytes())
        content[len(content) // 2] ^= 1
        item.write_bytes(content)
        self.assert_refused([self.parts[0], part, self.parts[2]], item.name, "missing or damaged")

    def test_work_that_is_gone(self):
        part = self.copy(1, "gone")
        item = sorted((part / "kept").glob("*/distance_*.json"))[0]
        item.unlink()
        self.assert_refused([self.parts[0], part, self.parts[2]], item.name, "missing or damaged")

    def test_a_damaged_picture(self):
        part = self.copy(1, "picture")
        picture = sorted((part / "kept").glob("*/images/*.exr"))[0]
        picture.write_bytes(picture.read_bytes()[:-1] + b"?")
        self.assert_refused([self.parts[0], part, self.parts[2]], picture.parent.parent.name, "missing or damaged")

    def test_an_experiment_that_changed_meanwhile(self):
        changing = self.write("changing", "[zoom]\ndistances = [1]\n")
        part = self.folder / "before_change"
        self.must("run", changing, "-q", "--shard", "1/1", "-o", part)
        self.write("changing", "[zoom]\ndistances = [2]\n")
        self.assert_refused([part], "changing.toml has changed")

    def test_no_part_at_all(self):
        for text in ("0/3", "4/3", "1", "1/0", "-1/3", "one/3", "1/3/3"):
            code, errors = self.execute("run", self.zoom, "--shard", text, "-o", self.folder / "no")
            self.assertEqual(code, 2, text)
            self.assertIn("--shard", errors)
        self.assertFalse((self.folder / "no").exists())


if __name__ == "__main__":
    unittest.main()
