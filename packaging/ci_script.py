#!/usr/bin/env python3
"""Prints a composite action or a Containerfile as a bash script, so that a chroot can try its very commands.

  packaging/ci_script.py action.yml [INPUT=VALUE ...]
  packaging/ci_script.py Containerfile CONTEXT         the script passes its arguments to the entry point

It knows the keys and instructions that ours use, and refuses others. FROM is the chroot itself.
"""
import json
import pathlib
import re
import shlex
import sys

import yaml


def action_script(text, given):
    action = yaml.safe_load(text)
    inputs = action["inputs"]
    lacking = [name for name, entry in inputs.items() if entry.get("required") and name not in given]
    if lacking or given.keys() - inputs.keys():
        sys.exit(f"the action needs {lacking} and has no {sorted(given.keys() - inputs.keys())}")
    values = {name: given.get(name, entry.get("default", "")) for name, entry in inputs.items()}
    yield "set -e"
    for step in action["runs"]["steps"]:
        if step.keys() - {"name", "shell", "env", "run"} or step["shell"] != "bash":
            sys.exit(f"{step['name']}: only name, shell (bash), env and run are known")
        yield "(set -eo pipefail"
        for name, value in step.get("env", {}).items():
            value = re.sub(r"\$\{\{ inputs\.(\w+) \}\}", lambda found: values[found[1]], value)
            yield f"export {name}={shlex.quote(value)}"
        yield step["run"] + ")"


def container_script(text, context):
    lines = [line for line in text.splitlines() if line and not line.startswith("#")]
    yield "set -e"
    for instruction in re.split(r"(?<!\\)\n", "\n".join(lines)):
        word, rest = instruction.split(" ", 1)
        if word == "COPY":
            *sources, target = rest.split()
            yield f"cp -r {' '.join(f'{shlex.quote(context)}/{source}' for source in sources)} {target}"
        elif word == "RUN":
            yield f"({rest})"
        elif word == "WORKDIR":
            yield f"mkdir -p {rest} && cd {rest}"
        elif word == "ENTRYPOINT":
            yield f"{shlex.join(json.loads(rest))} \"$@\""
        elif word != "FROM":
            sys.exit(f"{word}: not one of FROM, COPY, RUN, WORKDIR, ENTRYPOINT")


def main():
    file, *words = sys.argv[1:]
    text = pathlib.Path(file).read_text(encoding="utf-8")
    is_action = file.endswith(".yml")
    print("\n".join(action_script(text, dict(word.split("=", 1) for word in words)) if is_action else container_script(text, *words)))


if __name__ == "__main__":
    main()
