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


def verdicts(page, without=()):
    """The lines of the table of methods and groups: words and counts, no figure that a processor could change.

    without: the columns that are left out.
    """
    lines = page.splitlines()
    first = next(i for i, line in enumerate(lines) if line.startswith("| method | lobes |"))
    table = [line.strip("| ").split(" | ") for line in lines[first:first + lines[first:].index("")]]
    kept = [i for i, name in enumerate(table[0]) if name not in without]
    return ["| " + " | ".join(row[i] for i in kept) + " |" for row in table[2:]]


def columns_without(program):
    """The groups of cases that this machine cannot run."""
    listed = json.loads(subprocess.run([program, "list", "backends", "--json"], capture_output=True, check=True).stdout)
    osmesa = next(backend for backend in listed["backends"] if backend["name"] == "osmesa")
    return [] if osmesa["available"] else ["backends"]


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
        expected = verdicts(pathlib.Path(docs_page).read_text(), columns_without(program))
        different = differences(found, [line for line in expected if name_in(line) in names])
        if different:
            sys.exit("\n".join([f"{docs_page} is not what was measured: run scripts/stability. On one of the pages:", *different]))


if __name__ == "__main__":
    main(*sys.argv[1:])
