"""Runs the program: keyword arguments become its options, its error line an exception."""
import os
import subprocess
import sys
import tempfile
from collections.abc import Iterable, Mapping


class Error(Exception):
    """An error of the program, or of a file that is not what it writes.

    `exit_code` is the program's (docs/reference/command-line.md), None if it did not run; `output` is what it printed.
    """

    def __init__(self, message, exit_code=None, output=""):
        super().__init__(message)
        self.exit_code = exit_code
        self.output = output


def _option_words(options):
    """`spp=64` as --spp=64; a list with commas, a dictionary as one NAME=VALUE each, True as a flag, None and False not."""
    for name, value in options.items():
        option = "--" + name.strip("_").replace("_", "-")
        if value is True:
            yield option
        elif isinstance(value, Mapping):
            yield from (f"{option}={key}={part}" for key, part in value.items())
        elif isinstance(value, Iterable) and not isinstance(value, str):
            yield f"{option}={','.join(map(str, value))}"
        elif value is not None and value is not False:
            yield f"{option}={value}"


def run_program(subcommand, *arguments, **options):
    """Runs `footprint SUBCOMMAND` and returns what it prints. Progress and warnings go to sys.stderr.

    The program is FOOTPRINT_PROGRAM, else `footprint` in PATH. It alone knows its options: it reports a wrong one.
    """
    program = os.environ.get("FOOTPRINT_PROGRAM", "footprint")
    command = [program, subcommand, *map(str, arguments), *_option_words(options)]
    last = ""
    with tempfile.TemporaryFile("w+", encoding="utf-8") as output:
        try:
            process = subprocess.Popen(command, stdout=output, stderr=subprocess.PIPE, encoding="utf-8")
        except OSError as error:
            hint = "install the package footprint, or set FOOTPRINT_PROGRAM to the program"
            raise Error(f"{program}: {error.strerror} ({hint})") from error
        with process:
            try:
                for line in process.stderr:
                    if line.startswith("footprint: "):  # the last one may be the error
                        last, line = line, last
                    sys.stderr.write(line)
            except BaseException:
                process.terminate()  # it then leaves nothing half-written
                process.wait()
                raise
        output.seek(0)
        printed = output.read()
    if process.returncode != 0:
        message = last.strip().removeprefix("footprint: ") or f"{program} ended with {process.returncode}"
        raise Error(message, process.returncode, printed)
    sys.stderr.write(last)
    return printed
