"""Footprint from Python: runs the installed program, and reads what it wrote (docs/guides/python.md).

Nothing is measured here: every figure is one of the program's.
"""
from footprint.commands import Outcome, animate, bake, check, compare, cost, ndf, recommend, render, run, score
from footprint.images import read_image
from footprint.program import Error, run_program
from footprint.results import Matrix, Results, read

__all__ = ["Error", "Matrix", "Outcome", "Results", "animate", "bake", "check", "compare", "cost", "ndf", "read",
           "read_image", "recommend", "render", "run", "run_program", "score"]
