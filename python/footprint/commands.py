"""One function per subcommand: it runs the program and reads what it wrote.

Options are keyword arguments by their names on the command line, with `_` for `-`; the program's defaults apply.
"""
import contextlib
import dataclasses
import pathlib
import tempfile

from footprint.images import read_image
from footprint.program import Error, run_program
from footprint.results import read, read_folder


@dataclasses.dataclass
class Outcome:
    """Whether all claims, thresholds or limits passed, a line for each that failed, and the document, if any."""

    passed: bool
    failed: list
    result: object


def compare(scene, output="out", **options):
    """Results of `footprint compare`."""
    run_program("compare", scene, output=output, **options)
    return read(output)


def animate(scene, methods, output="out", **options):
    """Results of `footprint animate`."""
    run_program("animate", scene, methods=methods, output=output, **options)
    return read(output)


def run(experiment, output="out", **options):
    """Results of `footprint run`; a Matrix, or a dictionary of either, where the experiment has members."""
    run_program("run", experiment, output=output, **options)
    return read(output)


def check(experiment, output="out", **options):
    """The Outcome of `footprint check`."""
    return _outcome("check", experiment, output=output, **options)


def score(*images, output=None, **options):
    """The Outcome of `footprint score`, with score.json, of folders by the names of their images."""
    with _folder(output) as folder:
        return _outcome("score", *images, output=folder, **options)


def recommend(scene, output="out", **options):
    """recommend.json of `footprint recommend`."""
    run_program("recommend", scene, output=output, **options)
    return read(output)


def cost(scene, output=None, **options):
    """cost.json of `footprint cost`."""
    with _folder(output) as folder:
        run_program("cost", scene, output=folder, **options)
        return read(folder)


def ndf(scene, output=None, **options):
    """ndf.json of `footprint ndf`."""
    with _folder(output) as folder:
        run_program("ndf", scene, output=folder, **options)
        return read(folder)


def bake(scene, method, output, **options):
    """manifest.json of `footprint bake`."""
    run_program("bake", scene, method=method, output=output, **options)
    return read(output)


def render(scene, method, **options):
    """The image of `footprint render` as an array: linear radiance, with coverage in alpha."""
    with _folder(None) as folder:
        file = folder.with_suffix(".exr")
        run_program("render", scene, method=method, output=file, **options)
        return read_image(file)


def _outcome(*words, output, **options):
    try:
        run_program(*words, output=output, **options)
        passed, failed = True, []
    except Error as error:
        if error.exit_code != 1:
            raise
        lines = [line.removeprefix("failed: ") for line in error.output.splitlines() if line.startswith("failed: ")]
        passed, failed = False, lines or [str(error)]
    return Outcome(passed, failed, read_folder(pathlib.Path(output)))


@contextlib.contextmanager
def _folder(output):
    """The folder to write to; without one a temporary folder."""
    with tempfile.TemporaryDirectory(prefix="footprint_") as scratch:
        yield pathlib.Path(output or f"{scratch}/out")
