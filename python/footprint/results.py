"""What the program wrote, read back: results.json as Results, a matrix of them as Matrix, other documents as they are."""
import json
import pathlib

import numpy

from footprint.images import read_image
from footprint.program import Error

# The documents that this package reads, with the version of their format.
FORMATS = {
    "results.json": "footprint-results/2",
    "matrix.json": "footprint-matrix/1",
    "region.json": "footprint-region/1",
    "recommend.json": "footprint-recommend/1",
    "score.json": "footprint-score/1",
    "cost.json": "footprint-cost/1",
    "ndf.json": "footprint-ndf/1",
    "manifest.json": "footprint-bake/1",
    "edit.json": "footprint-edit/1",
}


class Table:
    """A document beside its results.csv."""

    def __init__(self, document, folder):
        self.document = document
        self.folder = folder

    def to_dataframe(self):
        """results.csv as a pandas DataFrame; absent and infinite figures are NaN."""
        try:
            import pandas
        except ImportError as error:
            raise ImportError("dataframes need pandas: install the package python3-pandas") from error
        return pandas.read_csv(self.folder / "results.csv", keep_default_na=False, na_values=[""],
                               float_precision="round_trip")


class Matrix(Table):
    """A matrix.json."""

    @property
    def members(self):
        """{name: Results} of its members."""
        return {member["folder"]: read(self.folder / member["folder"]) for member in self.document["members"]}


class Results(Table):
    """A results.json, whose keys docs/reference/results.md describes."""

    @property
    def records(self):
        """One dictionary per method and distance, or per method and frame."""
        return self.document["records"]

    def select(self, **where):
        """The records with these values: select(method="lean", distance=2)."""
        return [record for record in self.records if all(_value(record, key) == wanted for key, wanted in where.items())]

    def axis(self, key):
        """The different values of a key, in the order of the records: the labels of an array."""
        return list(dict.fromkeys(_value(record, key) for record in self.records))

    def array(self, key, by=None):
        """The values of a key such as "error.shading", one per record; null is NaN.

        `by` lists keys, such as ("method", "distance"): the array then has one dimension per key, over `axis(key)`.
        """
        if by is None:
            values = [_value(record, key) for record in self.records]
            is_numeric = all(value is None or isinstance(value, (int, float)) for value in values)
            return numpy.array(values, dtype=float if is_numeric else None)
        axes = [self.axis(name) for name in by]
        array = numpy.full([len(axis) for axis in axes], numpy.nan)
        filled = set()
        for record in self.records:
            place = tuple(axis.index(_value(record, name)) for name, axis in zip(by, axes))
            if place in filled:
                raise ValueError(f"by={by!r}: several records have the same values, add a key that separates them")
            filled.add(place)
            array[place] = _value(record, key)
        return array

    def front(self, x="time.ratio_to_direct.median", y="error.shading", **where):
        """The Pareto front: the selected records that no other one beats in x and y, both the lower the better, by x."""
        points = [(_value(record, x), _value(record, y), record) for record in self.select(**where)]
        front = []
        for point in sorted((p for p in points if None not in p[:2]), key=lambda p: p[:2]):
            if not front or point[1] < front[-1][1]:
                front.append(point)
        return [record for _, _, record in front]

    def image(self, method, distance=None, frame=None, kind="color"):
        """The image of a method as an array (`read_image`); kind is a key of `images` of a record."""
        where = {"method": method, "distance": distance, "frame": frame}
        return self._image(kind, {key: value for key, value in where.items() if value is not None})

    def reference(self, distance=None, frame=None):
        """The reference of a distance or frame, as an array."""
        where = {"distance": distance, "frame": frame}
        return self._image("reference", {key: value for key, value in where.items() if value is not None})

    def _image(self, kind, where):
        files = {record["images"][kind] for record in self.select(**where)} - {""}
        if len(files) != 1:
            raise LookupError(f"{len(files)} images `{kind}` for {where}: the results have the methods "
                              f"{self.axis('method')} at the distances {self.axis('distance')}")
        return read_image(self.folder / files.pop())


def read(path):
    """A document that the program wrote, by its file or folder: Results, Matrix, or a dictionary.

    A folder of several runs, as of `run` with `all=True`, is a dictionary of them by the names of their folders.
    """
    path = pathlib.Path(path)
    found = read_folder(path) if path.is_dir() else _read_file(path)
    if found is None:
        raise Error(f"{path}: no document of Footprint in this folder ({', '.join(FORMATS)})")
    return found


def read_folder(folder):
    """None without a document."""
    for name in FORMATS:
        if (folder / name).is_file():
            return _read_file(folder / name)
    inner = {child.name: read_folder(child) for child in sorted(folder.iterdir()) if child.is_dir()}
    return {name: found for name, found in inner.items() if found is not None} or None


def _read_file(path):
    try:
        document = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise Error(f"{path}: {error}") from error
    schema = document.get("schema") if isinstance(document, dict) else None
    if schema not in FORMATS.values():
        raise Error(f"{path}: its format is {schema!r}; this package reads {', '.join(FORMATS.values())} "
                    "(install python3-footprint in the version of the program)")
    kind = {FORMATS["results.json"]: Results, FORMATS["matrix.json"]: Matrix}.get(schema)
    return kind(document, path.parent) if kind else document


def _value(record, key):
    """The value of a key with dots, such as "time.frame_ms.median" or "size.0"; None where a part of it is null."""
    value = record
    for part in key.split("."):
        if value is None:
            return None
        try:
            value = value[int(part) if isinstance(value, list) else part]
        except (LookupError, TypeError, ValueError):
            raise KeyError(f"records have no `{key}` (docs/reference/results.md has their keys)") from None
    return value
