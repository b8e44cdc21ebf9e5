"""Compares docs/results.schema.json with results.json, or docs/matrix.schema.json with matrix.json.

schema_test.py SCHEMA PROGRAM    with the examples that PROGRAM writes
schema_test.py SCHEMA X.json     with a run's own results

A written document validates, and documents that break a limit or a condition in one place each do not. The structure
of the schemas is the subject of footprint_schemas_test. Exit code 77 (skipped) without the package python3-jsonschema.
"""

import copy
import json
import pathlib
import subprocess
import sys
import tempfile

SKIPPED = 77

try:
    import jsonschema
except ImportError:
    print("skipped: the package python3-jsonschema is not installed")
    sys.exit(SKIPPED)


MATRIX_CHANGES = {
    "another schema": lambda d: d.update(schema="footprint-matrix/0"),
    "no members": lambda d: d.update(members=[]),
    "a member without records": lambda d: d["members"][0].update(records=0),
}


FILM_CHANGES = {
    "another path": lambda d: d["way"].update(path="walk"),
    "a flicker above 2": lambda d: d["records"][4]["flicker"].update(mean=2.5),
    "an error above 1": lambda d: d["records"][4]["error"].update(normalized_color=1.5),
    "a negative highlight": lambda d: d["records"][0].update(highlight_energy=-1),
    "an angle that is not a number": lambda d: d["records"][0].update(degrees=None),
    "one time of three": lambda d: d["records"][0]["time"]["frame_ms"].update(p90=1),
}


def broken(document):
    """Copies of the document, each wrong in one place."""
    if "members" in document:
        return changed(document, MATRIX_CHANGES)
    if document["way"]:
        return changed(document, FILM_CHANGES)
    changes = {
        "an unknown key": lambda d: d.update(extra=1),
        "a missing key": lambda d: d["records"][0]["error"].pop("psnr"),
        "another schema": lambda d: d.update(schema="footprint-results/0"),
        "a negative time": lambda d: d["records"][0]["time"]["frame_ms"].update(median=-1),
        "an error above 1": lambda d: d["records"][0]["error"].update(normalized_color=1.5),
        "null for a time": lambda d: d["records"][0]["time"]["frame_ms"].update(p90=None),
        "a ratio of 0": lambda d: d["records"][0]["time"]["ratio_to_direct"].update(low=0),
        "a bound of another kind": lambda d: d["records"][0].update(equivalent_bound="many"),
        "no sample": lambda d: d["reference"].update(spp=0),
        "a frame before the first": lambda d: d["records"][0].update(frame=-1),
        "no width": lambda d: d["records"][0].update(size=[0, 512]),
        "another timing of frame builds": lambda d: d["records"][0]["time"].update(frame_build="sometimes"),
    }
    if document["experiment"] and document["experiment"]["claims"]:  # a run's own results may have none
        changes["another expectation"] = lambda d: d["experiment"]["claims"][0].update(expect="nothing")
    return changed(document, changes)


def changed(document, changes):
    for name, change in changes.items():
        wrong = copy.deepcopy(document)
        change(wrong)
        yield name, wrong


def agree(document):
    """The outcomes of claims and thresholds agree with their figures."""
    experiment = document["experiment"] or {"claims": [], "thresholds": []}
    for claim in experiment["claims"]:
        is_excused = bool(claim["undecidable"]) or claim["expect"] == "undecided"
        assert claim["as_expected"] == (not claim["problem"] and (is_excused or claim["outcome"] == claim["expect"])), claim["name"]
        assert not claim["undecidable"] or claim["outcome"] == "undecided", claim["name"]
    for threshold in experiment["thresholds"]:
        measured = threshold["measured"]
        assert threshold["held"] == (measured is not None and measured <= threshold["limit"]), threshold["measure"]


def documents(schema_file, source):
    """The documents to compare with the schema, each with its name."""
    if source.endswith(".json"):
        yield source, json.loads(pathlib.Path(source).read_text(encoding="utf-8"))
        return
    of_matrix = pathlib.Path(schema_file).name.startswith("matrix")
    for kind in ("matrix",) if of_matrix else ("example", "hostile", "film", "hostile_film"):
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([source, folder, kind], check=True)
            file = pathlib.Path(folder) / ("matrix.json" if of_matrix else "results.json")
            yield kind, json.loads(file.read_text(encoding="utf-8"))


def main(schema_file, source):
    schema = json.loads(pathlib.Path(schema_file).read_text(encoding="utf-8"))
    jsonschema.Draft7Validator.check_schema(schema)
    validator = jsonschema.Draft7Validator(schema)
    for title, document in documents(schema_file, source):
        validator.validate(document)
        agree(document)
        for name, wrong in broken(document):
            assert not validator.is_valid(wrong), f"{title}: the schema takes {name}"
    print("documents match their schema, and broken documents do not")


if __name__ == "__main__":
    main(*sys.argv[1:])
