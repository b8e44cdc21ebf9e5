"""The documents show the program's output: examples are run, and lists of names and options are compared.

CONTRIBUTING.md ("Examples in documents") describes how an example is written.
"""
import functools
import json
import os
import pathlib
import re
import shlex
import subprocess
import tempfile
import unittest

SOURCE = pathlib.Path(os.environ["FOOTPRINT_SOURCE_DIR"])
PROGRAM = os.environ["FOOTPRINT_PROGRAM"]

FENCE = re.compile(r"(?P<slow>^<!-- slow -->\n)?(?:^<!-- file: (?P<file>[\w.]+) -->\n)?^```(?P<kind>\w*)\n(?P<text>.*?)^```$", re.MULTILINE | re.DOTALL)
NUMBER = re.compile(r"[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?")
N = r"[-+]?\d+(?:\.\d+)?"
# Times: "1.6 (1.5-1.7)", "1.6 times", "0.3 s", "12 ms".
TIMES = re.compile(rf"{N} \({N}-{N}\)|<?{N}(?= (?:times|s|ms)\b)")
TOLERANCE = 0.02  # between kinds of processors
ROUNDING = 1e-6


def run(*words, folder=None):
    done = subprocess.run([PROGRAM, *words], capture_output=True, text=True, check=False, cwd=folder)
    if done.returncode == 0:
        return done.stdout
    return "\n".join([done.stdout + "".join(done.stderr.splitlines()[-1:]), f"exit code {done.returncode}"])


@functools.cache
def help_of(*subcommand):
    return run(*subcommand, "--help")


@functools.cache
def listed(kind):
    return json.loads(run("list", kind, "--json"))[kind]


# ---- comparing printed text

def simplified(line):
    """Without times, and without what only aligns columns."""
    return re.sub(r"-{2,}", "--", " ".join(TIMES.sub("TIME", line).split()))


def is_close(shown, printed):
    last_place = 10.0 ** -len(shown.partition(".")[2].partition("e")[0])
    wanted, found = float(shown), float(printed)
    return abs(wanted - found) <= max(TOLERANCE * abs(wanted), last_place if "e" not in shown else 0, ROUNDING)


def is_same_line(shown, printed):
    if shown.startswith("exit code "):
        return shown == printed
    shown, printed = simplified(shown), simplified(printed)
    numbers, found = NUMBER.findall(shown), NUMBER.findall(printed)
    return (NUMBER.sub("#", shown) == NUMBER.sub("#", printed) and
            all(is_close(*pair) for pair in zip(numbers, found, strict=True)))


def difference_after(count, shown, printed):
    """Lines that agree, `count` and further ones, and the fault behind them; None if all agree."""
    if not shown:
        return (count, f"prints also `{printed[0]}`") if printed else None
    if shown[0].strip() == "...":
        rests = [difference_after(count, shown[1:], printed[i:]) for i in range(len(printed) + 1)]
        return None if None in rests else max(rests, key=lambda rest: rest[0])
    if not printed:
        return count, f"does not print `{shown[0]}`"
    if not is_same_line(shown[0], printed[0]):
        return count, f"shows `{shown[0]}`, prints `{printed[0]}`"
    return difference_after(count + 1, shown[1:], printed[1:])


def first_difference(shown, printed):
    """The first line that differs; None if all agree. "..." matches any lines."""
    found = difference_after(0, shown, printed)
    return found and found[1]


def trimmed(lines):
    text = "\n".join(line.rstrip() for line in lines).strip("\n")
    return text.split("\n") if text else []


# ---- examples

def commands_of(block):
    """Pairs of a command and the lines below it."""
    text = block["text"].replace("\\\n", " ")
    if block["kind"] == "console":
        parts = [part.split("\n") for part in re.split(r"^\$ ", text, flags=re.MULTILINE)[1:]]
        return [(lines[0], lines[1:]) for lines in parts]
    return [(line, []) for line in text.split("\n") if block["kind"] == "sh" and line.startswith("footprint ")]


def methods_fault(words):
    known = {method["name"]: {option["name"] for option in method["options"]} for method in listed("methods")}
    for text in words.split(","):
        name, *options = text.split(":")
        if re.fullmatch("[a-z_]+", name) and name != "reference" and name not in known:
            return f"unknown method {name}"
        for option in options if name in known else []:
            if option.partition("=")[0] not in known[name]:
                return f"{name} has no option {option.partition('=')[0]}"
    return None


def command_fault(command):
    """Why the program would not take the command; None if it knows subcommand, options, methods and scene."""
    words = shlex.split(command.partition(" | ")[0].partition(" > ")[0], comments=True)[1:]
    if not words or not re.fullmatch("[a-z]+", words[0]):
        return None
    text = help_of(words[0])
    if "Usage: footprint " + words[0] not in text:
        return f"no subcommand {words[0]}"
    for option, value in zip(words[1:], [*words[2:], ""]):
        if re.fullmatch("--?[a-z-]+", option) and not re.search(rf"(?<!\S){option}(?![\w-])", text):
            return f"{words[0]} has no option {option}"
        if option in ("--method", "--methods") and (fault := methods_fault(value)):
            return fault
    takes_scene = f"Usage: footprint {words[0]} SCENE" in text
    if takes_scene and len(words) > 1 and re.fullmatch("[a-z_0-9]+", words[1]) and words[1] not in listed("scenes"):
        return f"no scene {words[1]}"
    return None


def documents():
    names = subprocess.run(["git", "-C", SOURCE, "ls-files", "*.md"], capture_output=True, text=True, check=False).stdout
    files = [SOURCE / name for name in names.split("\n") if name] or sorted(SOURCE.rglob("*.md"))
    return [file for file in files if file.name not in ("CHANGELOG.md", "reproduction.md") and file.parent.name != "reproduction"]


def faults_of(name, text, run_examples):
    """Faults of a document's examples, each with its line."""
    with tempfile.TemporaryDirectory() as folder:
        for block in FENCE.finditer(text):
            line = text.count("\n", 0, block.start("text")) + 1
            if block["file"]:
                pathlib.Path(folder, block["file"]).write_text(block["text"], encoding="utf-8")
            for command, shown in commands_of(block):
                if fault := command_fault(command):
                    yield f"{name}:{line}: {command}: {fault}"
                elif run_examples and block["kind"] == "console" and not block["slow"] and command.startswith("footprint "):
                    printed = run(*shlex.split(command)[1:], folder=folder).replace(folder, ".")
                    if fault := first_difference(trimmed(shown), trimmed(printed.split("\n"))):
                        yield f"{name}:{line}: {command}: {fault}"


# ---- tables

def table_below(text, heads):
    """Rows of every table whose head starts with these cells, as lists of cells."""
    rows = []
    for table in re.finditer(r"^\|.*\n\|[-:| ]+\|\n(?:\|.*\n)*", text, re.MULTILINE):
        head, _, *lines = [[cell.strip() for cell in re.split(r"(?<!\\)\|", line)[1:-1]] for line in table.group().splitlines()]
        if head[:len(heads)] == heads:
            rows += lines
    return rows


def code(cell):
    return re.findall(r"`([^`]*)`", cell)


def option_fault(option, default, values):
    """The difference of a method's option from its row; None without one."""
    own_default = option["default"] if isinstance(option["default"], str) else f"{option['default']:g}"
    if own_default not in (code(default) or default.split(" ")):
        return f"{option['name']}: default {own_default}, shown {default}"
    if "choices" in option and re.fullmatch(r"`\w+`(, `\w+`)+", values) and code(values) != option["choices"]:
        return f"{option['name']}: choices {option['choices']}, shown {values}"
    bounds = re.fullmatch(f"({N}) to ({N})", values)
    if "minimum" in option and bounds and [float(n) for n in bounds.groups()] != [option["minimum"], option["maximum"]]:
        return f"{option['name']}: {option['minimum']:g} to {option['maximum']:g}, shown {values}"
    return None


def method_faults(method, text):
    rows = {code(row[0])[0]: row for row in table_below(text, ["option", "default", "values"])}
    options = {option["name"]: option for option in method["options"]}
    if rows.keys() != options.keys():
        yield f"{method['name']}: options {sorted(options)}, shown {sorted(rows)}"
        return
    yield from (f"{method['name']}: {fault}" for name, row in rows.items() if (fault := option_fault(options[name], *row[1:3])))
    shown = {word for row in table_below(text, ["`preset`"]) for word in code(row[0])[:1]}
    missing = set(options.get("preset", {}).get("choices", [])) - shown
    if missing:
        yield f"{method['name']}: presets {sorted(missing)} are not shown"


def help_options(subcommand):
    return set(re.findall(r"^  (?:-\w, )?(--[a-z-]+)", help_of(subcommand), re.MULTILINE)) - {"--help", "--quiet"}


def subcommand_faults(subcommand, text):
    """Options that command-line.md lacks or that the program does not have."""
    settings = {code(row[0])[0].split(" ")[0] for row in table_below(text, ["option", "of"]) if subcommand in row[1].split(", ")}
    section = next((part for part in re.split(r"^## ", text, flags=re.MULTILINE)
                    if subcommand in re.split(r", | and |\n", part.split("\n")[0])), "")
    shown = set(re.findall(r"(?<![\w-])--[a-z-]+", section))
    missing = help_options(subcommand) - settings - shown - ({"--output"} if " -o " in section else set())
    if missing:
        yield f"{subcommand}: {sorted(missing)} are not in command-line.md"
    rows = {option for row in table_below(section, ["option"]) for option in re.findall("--[a-z-]+", row[0])}
    known = help_options(subcommand)
    if subcommand in ("run", "check"):
        known = help_options("run") | help_options("check")
    if rows - known:
        yield f"{subcommand}: {sorted(rows - known)} are in command-line.md, and not in the program"


class Comparison(unittest.TestCase):
    def test_equal_texts_agree(self):
        shown = ["| a |  0.085 | 1.60 (1.43-1.67) |", "|:--|-------:|", "bake 0.02 s"]
        printed = ["| a | 0.0851 |  2.5 (2-3) |", "|:---|---:|", "bake 31 s"]
        self.assertIsNone(first_difference(shown, printed))

    def test_a_number_that_differs_is_reported(self):
        self.assertIn("shows `error 0.085`", first_difference(["error 0.085"], ["error 0.097"]))

    def test_a_word_that_differs_is_reported(self):
        self.assertIn("prints `lean`", first_difference(["leadr"], ["lean"]))

    def test_lines_too_many_or_too_few_are_reported(self):
        self.assertEqual(first_difference(["a"], ["a", "b"]), "prints also `b`")
        self.assertEqual(first_difference(["a", "b"], ["a"]), "does not print `b`")

    def test_dots_stand_for_any_lines(self):
        self.assertIsNone(first_difference(["a", "...", "d"], ["a", "b", "c", "d"]))
        self.assertIsNone(first_difference(["..."], []))
        self.assertEqual(first_difference(["...", "c", "e", "..."], ["a", "b", "c", "d"]), "shows `e`, prints `d`")

    def test_an_example_that_the_program_does_not_take_is_reported(self):
        text = "```sh\nfootprint %s\n```\n"
        for command, fault in (("compere bumps", "no subcommand compere"), ("compare bumps --methds lean", "has no option --methds"),
                               ("compare bumps --methods leen", "unknown method leen"), ("compare bmps", "no scene bmps"),
                               ("render bumps --method lean:storge=fp16 -o a.exr", "lean has no option storge")):
            self.assertIn(fault, "".join(faults_of("a.md", text % command, False)))

    def test_an_output_that_is_not_printed_is_reported(self):
        text = "Words.\n\n```console\n$ footprint surface bumps --resolution 8 -o a.exr\nb.exr\n```\n"
        self.assertEqual(list(faults_of("a.md", text, True)),
                         ["a.md:4: footprint surface bumps --resolution 8 -o a.exr: shows `b.exr`, prints `a.exr`"])
        self.assertEqual(list(faults_of("a.md", text.replace("b.exr", "a.exr"), True)), [])
        self.assertEqual(list(faults_of("a.md", text.replace("```console", "<!-- slow -->\n```console"), True)), [])

    def test_files_of_a_document_are_there_and_failures_are_shown(self):
        text = "<!-- file: a.toml -->\n```toml\n[experiment]\n```\n```console\n$ footprint check a.toml\n%s\nexit code %d\n```\n"
        self.assertIn("prints `footprint: a.toml:1: `title`", "".join(faults_of("a.md", text % ("nothing", 2), True)))
        self.assertIn("shows `exit code 1`", "".join(faults_of("a.md", text % ("...", 1), True)))

    def test_options_that_differ_are_reported(self):
        method = {"name": "m", "options": [{"name": "k", "default": 3.0, "minimum": 1, "maximum": 9},
                                           {"name": "preset", "default": "a", "choices": ["a", "b"]}]}
        table = "| option | default | values | meaning |\n|---|---|---|---|\n| `k` | 3 | 1 to 9 | |\n| `preset` | `a` | above | |\n"
        presets = "| `preset` | of |\n|---|---|\n| `a` | |\n| `b` | |\n\n"
        self.assertEqual(list(method_faults(method, presets + table)), [])
        for before, after, fault in (("`k`", "`j`", "options"), ("| 3 ", "| 4 ", "default 3"), ("to 9", "to 8", "1 to 9"),
                                     ("| `b` | |\n", "", "['b'] are not shown")):
            self.assertIn(fault, "".join(method_faults(method, (presets + table).replace(before, after))))

    def test_options_that_command_line_lacks_are_reported(self):
        text = (SOURCE / "docs/reference/command-line.md").read_text(encoding="utf-8")
        self.assertIn("--gltf-level", "".join(subcommand_faults("bake", text.replace("--gltf-level", "--other"))))
        self.assertIn("--other", "".join(subcommand_faults("bake", text.replace("`--gltf-level", "`--other"))))


class Documents(unittest.TestCase):
    def test_examples_are_what_the_program_takes_and_prints(self):
        faults = [fault for file in documents()
                  for fault in faults_of(file.relative_to(SOURCE).as_posix(), file.read_text(encoding="utf-8"), True)]
        self.assertEqual(faults, [])

    def test_methods_are_those_of_the_program(self):
        rows = table_below((SOURCE / "README.md").read_text(encoding="utf-8"), ["method", "after"])
        self.assertEqual(sorted(code(row[0])[0] for row in rows), sorted(method["name"] for method in listed("methods")))

    def test_options_of_methods_are_those_of_the_program(self):
        faults = [fault for method in listed("methods") for fault in
                  method_faults(method, (SOURCE / f"methods/{method['name']}/README.md").read_text(encoding="utf-8"))]
        self.assertEqual(faults, [])

    def test_subcommands_and_their_options_are_those_of_the_program(self):
        text = (SOURCE / "docs/reference/command-line.md").read_text(encoding="utf-8")
        subcommands = re.findall(r"^  ([a-z]+)  ", help_of(), re.MULTILINE)
        self.assertEqual([word for word in subcommands if not re.search(rf"^## .*\b{word}\b", text, re.MULTILINE)], [])
        self.assertEqual([fault for word in subcommands for fault in subcommand_faults(word, text)], [])

    def test_surfaces_and_experiments_are_those_of_the_program(self):
        text = (SOURCE / "scenes/surfaces/README.md").read_text(encoding="utf-8")
        shown = {name for row in table_below(text, ["", "name"]) for name in code(row[1])}
        self.assertEqual(shown, {surface["name"] for surface in listed("surfaces")})
        shown = set(re.findall(r"`([a-z0-9_]+)\.toml`", (SOURCE / "experiments/README.md").read_text(encoding="utf-8")))
        self.assertEqual(shown, set(listed("experiments")))

    def test_footprint_filters_are_those_of_the_program(self):
        rows = table_below((SOURCE / "docs/reference/filters.md").read_text(encoding="utf-8"), ["`--footprint`"])
        shown = [re.match("[a-z_]+", code(row[0])[0])[0] for row in rows]
        choices = " ".join(re.search(r"--footprint FILTER(.*?)\n  --|\Z", help_of("compare"), re.DOTALL)[1].split())
        self.assertEqual(shown, [word for word in re.findall(r"[a-z_]+(?=:N|\[:N|, anis)", choices)])


if __name__ == "__main__":
    unittest.main()
