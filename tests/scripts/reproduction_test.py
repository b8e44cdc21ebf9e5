"""scripts/reproduction: the document is made of results, faults in it are reported, floors too."""
import json
import os
import pathlib
import shutil
import subprocess
import tempfile
import tomllib
import unittest

SOURCE = pathlib.Path(os.environ["FOOTPRINT_SOURCE_DIR"])
NAME = "tan2005_fig6"
MISCOUNTED = "Tan et al. 2005: the paper's own: the document does not count the claims that it has"


def script(name, *arguments):
    return subprocess.run([SOURCE / "scripts" / name, *map(str, arguments)], capture_output=True, text=True, check=False)


def record(method, error, floor):
    return {"method": method, "distance": 1, "frame": 0, "flicker": None,
            "error": {"normalized_color": error, "noise_floor": floor, "shading_floor": floor}}


def results(left, right, floor=0.001, inequality="error(a:x=1) < 0.5 * error(b)", **experiment):
    claim = {"name": "n", "inequality": inequality, "left": left, "right": right, "outcome": "reproduced",
             "expect": "reproduced", "as_expected": True}
    return {"tool": {"version": "0"}, "backend": {"cpu": "some", "renderer": "none", "version": "4.5"},
            "scene": {"warnings": ["a | bar"]}, "reference": {"samples": 64},
            "records": [record("a:x=1", 2 * left, floor), record("b", 2 * right, floor)],
            "experiment": {"name": "e", "quick": False, "claims": [claim], "published": [], "pictures": [], **experiment}}


class Tree(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)

    def write(self, name, document):
        (self.folder / "out" / name).mkdir(parents=True)
        (self.folder / "out" / name / "results.json").write_text(json.dumps(document), encoding="utf-8")
        return self.folder / "out"


    def write_matrix(self, experiment, members, **claim):
        """The results of a matrix of footprint filters; `claim` changes its one claim. Members have none."""
        whole = results(0.01, 0.02)
        whole["experiment"]["claims"][0].update(claim)
        folder = self.write(experiment, {}) / experiment
        (folder / "results.json").unlink()
        for member, document in members.items():
            document["experiment"]["claims"] = []
            (folder / member).mkdir()
            (folder / member / "results.json").write_text(json.dumps(document), encoding="utf-8")
        whole["members"] = [{"folder": member, "footprint": member} for member in members]
        (folder / "matrix.json").write_text(json.dumps({key: whole[key] for key in ("tool", "backend", "experiment", "members")}),
                                            encoding="utf-8")
        return folder.parent


class Floors(Tree):
    def lines_of(self, document):
        done = script("reproduction", "--floors", self.write("e", document))
        return done.returncode, done.stdout.splitlines()

    def test_a_floor_under_a_third_passes(self):
        code, lines = self.lines_of(results(0.01, 0.02, floor=0.0033))
        self.assertEqual((code, lines[-1]), (0, "1 of 1 claims have a floor under a third of their difference"))

    def test_a_floor_above_a_third_is_reported_with_the_samples_that_would_do(self):
        code, lines = self.lines_of(results(0.01, 0.02, floor=0.02 / 3))
        self.assertEqual(code, 1)
        self.assertIn("n  difference 0.01000  floor 0.00667  not converged with 64 samples per pixel; 256 would do", lines[0])

    def test_claims_of_other_things_have_none(self):
        for inequality in ("time(a:x=1) < 2 * time(b)", "error(a:x=1, spp=16) < error(b)", "error(a:x=1) / error(b) < 2",
                           "abs(energy_bias(b)) < 0.1"):
            with self.subTest(inequality):
                shutil.rmtree(self.folder / "out", ignore_errors=True)
                code, lines = self.lines_of(results(0.01, 0.02, floor=1.0, inequality=inequality))
                self.assertEqual((code, len(lines)), (0, 1))

    def test_selectors_choose_the_records(self):
        document = results(0.01, 0.02, floor=0.001, inequality="error(a:x=1, frame=0) < error(b, distance=1)")
        document["records"].append({**record("b", 1, 1.0), "frame": 1, "distance": 2})
        self.assertEqual(self.lines_of(document)[0], 0)

    def test_members_of_a_matrix_are_chosen_by_their_filter(self):
        folder = self.write_matrix("e", {"trilinear": results(0.01, 0.02, floor=1.0), "box:2": results(0.01, 0.02, floor=0.001)},
                                   inequality="error(a:x=1, footprint=box:2) < 0.5 * error(b, footprint=box:2)")
        done = script("reproduction", "--floors", folder)
        self.assertEqual((done.returncode, len(done.stdout.splitlines())), (0, 2), done.stdout + done.stderr)
        other = json.loads((folder / "e/matrix.json").read_text(encoding="utf-8"))
        other["experiment"]["claims"][0]["inequality"] = "error(a:x=1, footprint=trilinear) < 0.5 * error(b, footprint=box:2)"
        (folder / "e/matrix.json").write_text(json.dumps(other), encoding="utf-8")
        self.assertEqual(script("reproduction", "--floors", folder).returncode, 1)

    def test_what_is_no_measurement_is_refused(self):
        self.assertEqual(script("reproduction", "--floors", self.write("e", results(0.1, 0.2, quick=True))).returncode, 2)
        self.assertIn("has no results.json", script("reproduction", "--floors", self.folder / "none").stderr)


class Document(Tree):
    def setUp(self):
        super().setUp()
        for part in ("experiments", "results/published"):
            shutil.copytree(SOURCE / part, self.folder / part, ignore=shutil.ignore_patterns("*.cpp", "*.hpp", "*.txt"))
        self.claims = tomllib.loads((SOURCE / "experiments" / f"{NAME}.toml").read_text(encoding="utf-8"))["claim"]
        claim = self.claims[0]
        document = results(0.01, 0.02)
        document["experiment"]["claims"][0].update(name=claim["name"], inequality=claim["inequality"])
        out = self.write(NAME, document)
        done = script("reproduction", out, self.folder / "docs")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.text = (self.folder / "docs/results/reproduction/tan2005.md").read_text(encoding="utf-8")

    def faults(self, text=None):
        if text is not None:
            (self.folder / "docs/results/reproduction/tan2005.md").write_text(text, encoding="utf-8")
        done = script("reproduction", "--check", self.folder / "docs")
        self.assertEqual(done.stderr, "")
        self.assertEqual(done.returncode, 1 if done.stdout else 0)
        return done.stdout.splitlines()

    def test_the_projects_own_agrees(self):
        done = script("reproduction", "--check")
        self.assertEqual((done.returncode, done.stdout), (0, ""), done.stderr)

    def test_what_was_measured_stands_in_it(self):
        self.assertEqual(self.faults(), [])
        self.assertIn("0.01 against 0.02 | reproduced |", self.text)
        self.assertIn("Warning: a \\| bar.", self.text)
        self.assertIn("Not measured in this run.", self.text)
        self.assertIn("| Figure 3 | a drawing: why components", self.text)

    def test_a_claim_that_is_missing_changed_or_no_more_is_reported(self):
        row = next(line for line in self.text.splitlines() if "0.01 against 0.02" in line)
        name, claims = row.split("`")[1], len(self.claims)
        self.assertEqual(self.faults(self.text.replace(row + "\n", "")),
                         [MISCOUNTED, f"{NAME}: the claim {name} is not in the document"])
        self.assertEqual(self.faults(self.text.replace(row, row.replace("error(", "relmse("))),
                         [f"{NAME}: the claim {name} is not what its file says"])
        self.assertEqual(self.faults(self.text.replace(row, row + "\n" + row.replace(name, "another"))),
                         [MISCOUNTED, f"{NAME}: the document has {claims + 1} claims, its file {claims}"])
        self.assertEqual(self.faults(self.text.replace(f"### `{NAME}`", "### gone")), [f"{NAME}: is not in the document"])

    def rewritten(self, change, **results_of_another):
        """The document after another run, of `tan2005_fig5`, into the same folder, whose file of NAME `change` changed."""
        copy = self.folder / "copy"
        shutil.copytree(SOURCE / "scripts", copy / "scripts", ignore=shutil.ignore_patterns("__pycache__"))
        for part in ("experiments", "results"):
            shutil.move(self.folder / part, copy / part)
        file = copy / "experiments" / f"{NAME}.toml"
        file.write_text(change(file.read_text(encoding="utf-8")), encoding="utf-8")
        shutil.rmtree(self.folder / "out")
        out = self.write("tan2005_fig5", results(0.3, 0.4, **results_of_another))
        subprocess.run([copy / "scripts/reproduction", out, self.folder / "docs"], check=True)
        return (self.folder / "docs/results/reproduction/tan2005.md").read_text(encoding="utf-8")

    def test_another_run_leaves_what_it_did_not_measure(self):
        text = self.rewritten(lambda content: content.replace('text = "', 'text = "Newly said: '))
        row = next(line for line in text.splitlines() if "0.01 against 0.02" in line)
        self.assertIn("| Newly said: ", row)
        self.assertIn("| reproduced |", row)
        self.assertEqual(text.count("Warning: a \\| bar."), 2)  # of both runs

    def test_a_claim_on_a_printed_figure_is_judged_by_its_row(self):
        table = "| Figure 6 | `fps(tan_gmm)` | 9 fps | 2.5 fps | note |\n| Figure 6 | `precompute(tan_gmm)` | 300 s | n/a | note |"
        page = self.folder / "docs/results/reproduction/tan2005.md"
        page.write_text(self.text.replace("| claim |", f"{table}\n\n| claim |"), encoding="utf-8")
        wanted = ("fps(tan_gmm) >= 2.5", "fps(tan_gmm) > 2.5", "fps(tan_gmm) >= 9", "precompute(tan_gmm) <= 300", "fps(other) < 9")
        claims = "".join(f'[[claim]]\nname = "c{i}"\ntext = "t"\nsource = "ours"\ninequality = "{text}"\n'
                         'expect = "reproduced"\nreason = "r"\n' for i, text in enumerate(wanted))
        text = self.rewritten(lambda content: claims + content)
        rows = [next(line for line in text.splitlines() if f"`{inequality}`" in line) for inequality in wanted]
        self.assertEqual([row.split(" | ")[-3:-1] for row in rows],
                         [["2.5 against 2.5", "reproduced"], ["2.5 against 2.5", "**not reproduced**; expected: reproduced"],
                          ["2.5 against 9", "**not reproduced**; expected: reproduced"], ["n/a", "not measured"],
                          ["n/a", "not measured"]])

    def test_a_claim_whose_inequality_changed_is_not_measured(self):
        text = self.rewritten(lambda content: content.replace("error(tan_gmm) <", "relmse(tan_gmm) <"))
        self.assertNotIn("0.01 against 0.02", text)
        self.assertIn("`relmse(tan_gmm) < error(tan_gmm:align=off)` | n/a | not measured |", text)

    def test_an_outcome_that_is_no_longer_expected_is_marked(self):
        text = self.rewritten(lambda content: content.replace('expect = "reproduced"', 'expect = "not_reproduced"'))
        self.assertIn("0.01 against 0.02 | reproduced; expected: not reproduced |", text)

    def test_a_claim_that_is_now_expected_to_be_undecided_is_so(self):
        text = self.rewritten(lambda content: content.replace('expect = "reproduced"', 'expect = "undecided"'))
        self.assertIn("0.01 against 0.02 | undecided |", text)

    def test_times_that_decide_nothing_are_undecided_with_their_estimates(self):
        claim = tomllib.loads((SOURCE / "experiments/tan2005_fig5.toml").read_text(encoding="utf-8"))["claim"][0]
        measured = {"name": claim["name"], "inequality": claim["inequality"], "left": 9, "right": 120, "outcome": "undecided"}
        verdict = {"claim": claim["name"], "gpu": "RX 480", "left": 500, "right": 120, "outcome": "reproduced", "problem": ""}
        none = verdict | {"gpu": "PS4", "left": None}
        text = self.rewritten(lambda content: content, claims=[measured], second_verdicts=[verdict, none])
        self.assertIn("| 9 against 120; RX 480, by estimate: 500 against 120 | undecided; expected: reproduced |", text)
        self.assertNotIn("PS4", text)

    def test_the_results_of_a_matrix_are_one_section(self):
        claim = tomllib.loads((SOURCE / "experiments/tan2005_fig5.toml").read_text(encoding="utf-8"))["claim"][0]
        members = {name: results(0.3, 0.4) for name in ("trilinear", "box:2")}
        members["box:2"]["scene"]["warnings"].append("of one member")
        shutil.rmtree(self.folder / "out")
        out = self.write_matrix("tan2005_fig5", members, name=claim["name"], inequality=claim["inequality"])
        done = script("reproduction", out, self.folder / "docs")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        page = (self.folder / "docs/results/reproduction/tan2005.md").read_text(encoding="utf-8")
        section = page[page.index("### `tan2005_fig5`"):].split("\n### ")[0]
        self.assertEqual(section.count("Warning: "), 2)
        self.assertIn("0.01 against 0.02 | reproduced |", section)
        self.assertEqual(self.faults(), [])

    def test_regions_are_shown_and_stay_until_they_are_measured_again(self):
        claim = {"name": "c", "outcomes": ["reproduced", "not_reproduced", "undecided", "reproduced"], "sentence": "True in 2 of 4."}
        region = {"axes": [{"key": "size", "values": ["8x8", "9x9"]}, {"key": "distance", "values": ["1", "2"]}],
                  "settings": 4 * [{}], "claims": [claim]}
        folder = self.folder / "out" / f"{NAME}.region"
        (folder / "stated").mkdir(parents=True)
        (folder / "region.json").write_text(json.dumps(region), encoding="utf-8")
        (folder / "stated/results.json").write_text("{}", encoding="utf-8")  # is no result of an experiment of its own

        def section():
            done = script("reproduction", self.folder / "out", self.folder / "docs")
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            page = (self.folder / "docs/results/reproduction/tan2005.md").read_text(encoding="utf-8")
            return page[page.index(f"### `{NAME}`"):].split("\n### ")[0]

        first = section()
        self.assertIn("**Region** of 4 settings: size 8x8, 9x9; distance 1, 2.", first)
        self.assertIn("| `c` | True in 2 of 4. | ●○ –● |", first)
        shutil.rmtree(folder)
        self.assertEqual(section(), first)
        shutil.rmtree(self.folder / "out" / NAME)
        self.write("tan2005_fig5", results(0.01, 0.02))
        self.assertEqual(section(), first)
        self.assertEqual(self.faults(), [])

    def test_claims_are_counted_by_their_source(self):
        main = self.folder / "docs/results/reproduction.md"
        text = main.read_text(encoding="utf-8")
        counted = next(line for line in text.splitlines() if line.startswith("| Tan et al. 2005: the paper's own |"))
        number, *outcomes = map(int, counted[2:-2].split(" | ")[1:])
        self.assertEqual((outcomes[:3], sum(outcomes)), ([1, 0, 0], number))
        main.write_text(text.replace(counted, counted.replace("| 1 |", "| 2 |")), encoding="utf-8")
        self.assertEqual(self.faults(),
                         [MISCOUNTED])
        moved = self.text.replace("| paper | Interpolation of unaligned", "| ours | Interpolation of unaligned")
        self.assertIn(f"{NAME}: the claim aligned_under_unaligned is not what its file says", self.faults(moved))

    def test_a_claim_without_a_source_is_reported(self):
        file = self.folder / "experiments" / f"{NAME}.toml"
        file.write_text(file.read_text(encoding="utf-8").replace('source = "paper"\n', "", 1), encoding="utf-8")
        self.assertIn(f"{NAME}: the claim aligned_under_unaligned has no source", self.faults())

    def test_an_experiment_that_shows_no_figure_is_reported(self):
        shutil.copy(SOURCE / "experiments" / f"{NAME}.toml", self.folder / "experiments/tan2005_new.toml")
        self.assertEqual(self.faults(), ["figures.toml: tan2005_new shows no figure"])

    def test_a_figure_without_a_text_is_reported(self):
        file = self.folder / "results/published/figures.toml"
        more = '\n[[figure]]\npaper = "xu2017"\nname = "Figure 9"\nshows = "nothing"\n'
        file.write_text(file.read_text(encoding="utf-8") + more, encoding="utf-8")
        self.assertEqual(self.faults(), ["figures.toml: xu2017, Figure 9: give experiments, or why it is not shown",
                                         "xu2017, Figure 9: is not in the document as figures.toml has it"])

    def test_no_results_are_refused(self):
        done = script("reproduction", self.folder / "none", self.folder / "elsewhere")
        self.assertIn("none: has no results", done.stderr)
        self.assertFalse((self.folder / "elsewhere").exists())


if __name__ == "__main__":
    unittest.main()
