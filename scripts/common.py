"""Shared by the programs of scripts/ and of scripts/studies/.

It has their common arguments, runs Footprint and other programs, reads results.json, formats numbers and tables.
"""
import argparse
import json
import os
import pathlib
import subprocess
import sys
import tomllib

ROOT = pathlib.Path(__file__).resolve().parent.parent
PROGRAM = pathlib.Path(os.environ.get("FOOTPRINT_PROGRAM", ROOT / "build/release/app/footprint"))


class Missing(Exception):
    """A result, method or figure that a page needs and the results lack."""


# What the scripts' arguments have in common.
ARGUMENTS = {
    "results": {"type": pathlib.Path, "metavar": "RESULTS"}, "maps": {"type": pathlib.Path, "metavar": "MAPS"},
    "--run": {"action": "store_true"}, "--quick": {"action": "store_true"},
    "--footprint": {"default": PROGRAM, "metavar": "PROGRAM"}, "--svg": {"type": pathlib.Path, "metavar": "FILE"},
    "--note": {"default": "", "metavar": "TEXT"},
}


def parser_of(documentation, *names):
    """A parser of some ARGUMENTS, whose help is a script's documentation."""
    parser = argparse.ArgumentParser(description=documentation, formatter_class=argparse.RawDescriptionHelpFormatter)
    for name in names:
        parser.add_argument(name, **ARGUMENTS[name])
    return parser


def reported(name, work):
    """The exit code of `work()`: its own, or 1 after a message if something is missing."""
    try:
        return work()
    except Missing as missing:
        print(f"{name}: {missing}", file=sys.stderr)
        return 1


# ---- files and programs

def load_toml(path):
    return tomllib.loads(path.read_text(encoding="utf-8"))


def load_results(path):
    """A results.json as a dictionary; Missing if it cannot be read."""
    try:
        return json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise Missing(f"{path}: {error}") from error


def run_footprint(*words, program=PROGRAM, cache=None):
    """The output of the program; Missing if it fails. `cache` is a folder for bakes instead of the user's own."""
    environment = os.environ | ({"FOOTPRINT_CACHE": str(cache.absolute())} if cache else {})
    done = subprocess.run([program, *map(str, words)], stdout=subprocess.PIPE, text=True, check=False, env=environment)
    if done.returncode != 0:
        raise Missing(f"`footprint {' '.join(map(str, words))}` failed (exit code {done.returncode})")
    return done.stdout


def tracked_files(root):
    """The names of the files that git tracks or would track; in a folder without git, of all but those of builds."""
    listed = subprocess.run(["git", "-C", root, "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
                            capture_output=True, text=True, check=False)
    names = listed.stdout.split("\0") if listed.returncode == 0 else [path.relative_to(root).as_posix() for path in root.rglob("*")]
    return sorted(name for name in names if (root / name).is_file() and not name.startswith("build"))


def run_command(*words, cwd=None):
    """What a program prints; Missing with its message if it fails."""
    done = subprocess.run(list(map(str, words)), capture_output=True, text=True, check=False, cwd=cwd)
    if done.returncode != 0:
        raise Missing(done.stderr.strip().splitlines()[-1] if done.stderr.strip() else f"{words[0]} failed")
    return done.stdout


# ---- numbers and tables

def number(value, digits=3, unit=""):
    """`value` with `digits` significant digits; "n/a" if there is none."""
    if value is None:
        return "n/a"
    return f"{value:.{digits}g}{' ' + unit if unit else ''}"


def cell(text):
    return str(text).replace("|", "\\|").replace("\n", " ")


def table_row(cells):
    return "| " + " | ".join(cells) + " |"


def table(titles, rows):
    """A Markdown table without a final line break."""
    return "\n".join([table_row(titles), "|" + "---|" * len(titles), *map(table_row, rows)])
