"""Holds docs/animation.schema.json and animation.json against each other: animation_schema_test.py SCHEMA PROGRAM.

What PROGRAM writes validates, and documents that are broken in one place each do not. Exit code 77 (skipped) without
the package python3-jsonschema.
"""

import copy
import json
import pathlib
import subprocess
import sys
import tempfile

from schema_test import described, jsonschema


def broken(document):
    """Copies of the document, each wrong in one place."""
    changes = {
        "an unknown key": lambda d: d.update(extra=1),
        "another schema": lambda d: d.update(schema="footprint-animation/1"),
        "another path": lambda d: d.update(path="walk"),
        "an axis of two": lambda d: d.update(axis=[0, 1]),
        "a missing cause": lambda d: d["records"][4]["flicker"].pop("edges"),
        "an unknown cause": lambda d: d["records"][4]["flicker"].update(luck=0),
        "a flicker above 2": lambda d: d["records"][4]["flicker"].update(mean=2.5),
        "a cause without its percentile": lambda d: d["records"][4]["flicker"]["shading"].pop("p99"),
        "an error above 1": lambda d: d["records"][4]["error"].update(normalized_color=1.5),
        "a negative highlight": lambda d: d["records"][0].update(highlight_energy=-1),
        "half a frame": lambda d: d["frames"][0].update(frame=0.5),
        "one frame": lambda d: d.update(frames=d["frames"][:1]),
        "no pixels": lambda d: d["frames"][0].pop("pixels"),
    }
    for name, change in changes.items():
        wrong = copy.deepcopy(document)
        change(wrong)
        yield name, wrong


def main(schema_file, program):
    schema = json.loads(pathlib.Path(schema_file).read_text(encoding="utf-8"))
    jsonschema.Draft7Validator.check_schema(schema)
    described(schema, "")
    validator = jsonschema.Draft7Validator(schema)
    for kind in ("film", "hostile_film"):
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([program, folder, kind], check=True)
            document = json.loads((pathlib.Path(folder) / "animation.json").read_text(encoding="utf-8"))
        validator.validate(document)
        for name, wrong in broken(document):
            assert not validator.is_valid(wrong), f"{kind}: the schema takes {name}"
    print("animation.json holds to its schema, and broken documents do not")


if __name__ == "__main__":
    main(*sys.argv[1:])
