#!/usr/bin/python3
"""Every method through every hard case, by the program itself; docs/results/stability.md says what came of it.

SLOW methods, whose fits take most of the time, are tested with `scripts/test --all` only.

usage: hard_cases_test.py PROGRAM DOCS_PAGE
"""
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ALL_TESTS = "FOOTPRINT_ALL_TESTS" in os.environ  # `scripts/test --all`
SLOW = {"best_lobes"}


def verdicts(page):
    """The lines of the table of methods and groups: words and counts, no figure that a processor could change."""
    lines = page.splitlines()
    first = next(i for i, line in enumerate(lines) if line.startswith("| method | lobes |"))
    return [line for line in lines[first:first + 200] if line.startswith("| `")][:lines[first:].index("") - 2]


def name_in(line):
    return re.match(r"\| `(\w+)", line)[1]


def differences(found, written):
    """The lines that only one of two pages has, or that the pages have in another order."""
    return sorted(set(found) ^ set(written)) or [line for line, other in zip(found, written) if line != other]


def main(program, docs_page):
    documented = verdicts(pathlib.Path(docs_page).read_text())
    changed = [documented[0].replace("passed", "1 failed", 1), *documented[1:]]
    if not differences(changed, documented) or not differences(documented[::-1], documented):
        sys.exit("the comparison takes a changed page for the same")
    listed = json.loads(subprocess.run([program, "list", "methods", "--json"], capture_output=True, check=True).stdout)
    names = [method["name"] for method in listed["methods"] if ALL_TESTS or method["name"] not in SLOW]
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "out"
        only = [] if ALL_TESTS else ["--methods", ",".join(names)]
        run = subprocess.run([program, "check", "hard_cases", *only, "--quiet", "-o", str(out)], capture_output=True, text=True)
        print(run.stdout, run.stderr)
        if run.returncode != 0:
            sys.exit(f"exit code {run.returncode}")
        found = verdicts((out / "stability.md").read_text())
        different = differences(found, [line for line in documented if name_in(line) in names])
        if different:
            sys.exit("\n".join([f"{docs_page} is not what was measured: run scripts/stability. On one of the pages:", *different]))


if __name__ == "__main__":
    main(*sys.argv[1:])
