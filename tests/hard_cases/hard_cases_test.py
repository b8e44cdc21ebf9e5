#!/usr/bin/python3
"""Every method through every hard case, by the program itself; docs/results/stability.md says what came of it.

usage: hard_cases_test.py PROGRAM DOCS_PAGE
"""
import pathlib
import subprocess
import sys
import tempfile


def verdicts(page):
    """The lines of the table of methods and groups: words and counts, no figure that a processor could change."""
    lines = page.splitlines()
    first = next(i for i, line in enumerate(lines) if line.startswith("| method | lobes |"))
    return [line for line in lines[first:first + 200] if line.startswith("| `")][:lines[first:].index("") - 2]


def main(program, docs_page):
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "out"
        run = subprocess.run([program, "check", "hard_cases", "--quiet", "-o", str(out)], capture_output=True, text=True)
        print(run.stdout, run.stderr)
        if run.returncode != 0:
            sys.exit(f"exit code {run.returncode}")
        found = verdicts((out / "stability.md").read_text())
        written = verdicts(pathlib.Path(docs_page).read_text())
        if not found or found != written:
            for line in found:
                if line not in written:
                    print("not in the page:", line)
            sys.exit(f"{docs_page} is not what was measured: run scripts/stability")


if __name__ == "__main__":
    main(*sys.argv[1:])
