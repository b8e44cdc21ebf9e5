"""Whether `footprint recommend` agrees with an exhaustive run: the same choice, or one within noise of it."""

import json


def same_candidate(a, b):
    return a["method"] == b["method"] and a["footprint"] == b["footprint"]


def find(candidates, wanted):
    return next((c for c in candidates if same_candidate(c, wanted)), None)


def cost_as_much(a, b):
    """Whether one's median is within the other's spread."""
    return (
        b["cost"]["low"] <= a["cost"]["median"] <= b["cost"]["high"]
        or a["cost"]["low"] <= b["cost"]["median"] <= a["cost"]["high"]
    )


def errors_differ(a, b):
    """Whether the errors differ by more than three standard errors of the difference."""
    if a["noise"] is None or b["noise"] is None:
        return False
    return abs(a["error"] - b["error"]) > 3 * (a["noise"] ** 2 + b["noise"] ** 2) ** 0.5


def chosen_of(advice):
    index = advice["chosen"] if advice["chosen"] is not None else advice["nearest"]
    return None if index is None else advice["candidates"][index]


def clocks_contradict(quick, a, b):
    """Whether the quick run, which measured both in full and chose a, did not find a more expensive than b. Where the exhaustive
    run did, the two runs' clocks part them: a frame takes milliseconds, and a shared machine stalls for as long."""
    one, other = find(quick["candidates"], a), find(quick["candidates"], b)
    return other is not None and (one["cost"]["median"] <= other["cost"]["median"] or cost_as_much(one, other))


def disagreement(quick, whole, max_error=None):
    """None where the advice for a material is the same, or parted by no more than noise: that of errors in the
    exhaustive run's own figures, that of costs in those of either run; else what differs, in words. Under a limit on the
    error the cheapest wins: only costs decide."""
    a, b = chosen_of(quick), chosen_of(whole)
    if a is None or b is None:
        return None if a is b else f"{a} and {b}"
    if same_candidate(a, b):
        return None
    measured = find(whole["candidates"], a)
    if measured is None:
        return f"{a['method']} under {a['footprint']} was no candidate of the exhaustive run"
    as_good = measured["worst"] <= max_error if max_error is not None else not errors_differ(measured, b)
    if as_good and (cost_as_much(measured, b) or clocks_contradict(quick, a, b)):
        return None
    return (
        f"{a['method']} under {a['footprint']} (error {measured['error']:.4g}, cost {measured['cost']['median']:.3g}), "
        f"exhaustively {b['method']} under {b['footprint']} (error {b['error']:.4g}, cost {b['cost']['median']:.3g})"
    )


def disagreements(quick_folder, whole_folder):
    """Those of all materials of two output folders."""
    quick, whole = (
        json.loads((folder / "recommend.json").read_text(encoding="utf-8")) for folder in (quick_folder, whole_folder)
    )
    assert [m["material"] for m in quick["materials"]] == [m["material"] for m in whole["materials"]]
    found = []
    for one, other in zip(quick["materials"], whole["materials"]):
        words = disagreement(one, other, whole["limits"]["max_error"])
        if words:
            found.append(f"{one['material']}: {words}")
    return found
