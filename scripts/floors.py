"""The reference's noise floor beside the differences of errors that an experiment's claims speak of.

A reference has converged for a claim where its floor, the error that its own noise causes, lies under a third of the
difference between both sides. Only claims that compare errors against the converged reference have one: those over
times, bytes, quantities or distributions, those against a reference of few samples (`spp=`, a paper's own), and those
over quotients do not.
"""
import math
import re

FLOOR_OF = {"error": "noise_floor", "shading_error": "shading_floor", "edge_error": "noise_floor",
            "representation": "noise_floor", "filtering": "noise_floor"}
CALL = re.compile(r"([a-z_0-9]+)\(((?:[^()]|\([^()]*\))*)\)")
SHARE = 3.0


def calls_of(inequality):
    """The calls in it: function, method, selectors; those within `abs` too."""
    found = []
    for function, inside in CALL.findall(inequality):
        if function == "abs":
            found += calls_of(inside)
            continue
        method, *selectors = [part.strip() for part in inside.split(",")]
        found.append((function, method, dict(selector.split("=", 1) for selector in selectors)))
    return found


def is_method(written, method):
    """Whether a record's method is the one that a call names: as written, or by the name that it alone has."""
    return written == method or (":" not in method and written.split(":")[0] == method)


def floor_of_call(records, function, method, selectors):
    named = [r for r in records if r["method"] == method] or [r for r in records if is_method(r["method"], method)]
    chosen = [r for r in named if ("frame" not in selectors or r["frame"] == int(selectors["frame"]))
              and ("distance" not in selectors or math.isclose(r["distance"], float(selectors["distance"])))]
    if function == "flicker":
        floors = [r["flicker"]["noise_floor"] for r in chosen if r["flicker"]]
    else:
        floors = [r["error"][FLOOR_OF[function]] for r in chosen if r["error"]]
    return None if not floors or None in floors else sum(floors) / len(floors)


def floors(document):
    """For each claim of a results.json that has one: its name, the difference of its sides, the floor."""
    for claim in document["experiment"]["claims"]:
        calls = calls_of(claim["inequality"])
        sides = (claim["left"], claim["right"])
        of_errors = all(function in FLOOR_OF or function == "flicker" for function, _, _ in calls)
        if not calls or not of_errors or "/" in claim["inequality"] or None in sides:
            continue
        if any("spp" in selectors for _, _, selectors in calls):
            continue
        values = [floor_of_call(document["records"], *call) for call in calls]
        if None in values:
            continue
        yield claim["name"], abs(sides[0] - sides[1]), max(values)


def has_converged(difference, floor):
    return SHARE * floor < difference
