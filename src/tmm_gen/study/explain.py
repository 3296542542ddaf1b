"""A tuning in words: what was chosen and why, or why nothing could be."""

from __future__ import annotations

from dataclasses import replace

from tmm_gen.study.budgets import Allowance
from tmm_gen.study.by_tolerance import ByTolerance
from tmm_gen.study.configuration import own
from tmm_gen.study.findings import time_text
from tmm_gen.study.point import Point
from tmm_gen.study.rewrite import rewritten, with_tolerance
from tmm_gen.study.tune import Tuning


def explained(tuning: Tuning, allowed: Allowance | None = None) -> list[str]:
    """Return sentences, the most important first; last, why a budget could not be looked after."""
    if tuning.cheaper is not None:
        lines = [_by_tolerance(tuning, tuning.cheaper)]
        if tuning.chosen is not None:
            first, *others = _chosen(tuning)
            lines += [f"Of equal steps, {first}", *others]
    else:
        lines = _chosen(tuning) if tuning.chosen is not None else _none(tuning)
    lines += [_by_tolerance(tuning, each) for each in tuning.by_tolerance if each is not tuning.cheaper]
    if allowed is not None and allowed.unchecked:
        lines.append(f"The budget of the scene was not checked: {allowed.unchecked}")
    return lines


def bounds_of(tuning: Tuning) -> str:
    """Return the bounds in words."""
    return f"error {tuning.max_error:.3g} of the travel, {tuning.max_time:.3g} s for a simulated second"


def under(tuning: Tuning) -> str:
    """Say what the arm went through."""
    told = "; ".join(tuning.excitation.told(tuning.scene))
    return (
        f"All under {tuning.excitation.until:g} s of {told}; the travel is {tuning.travel:.3g} {tuning.unit}."
    )


def tuned_text(tuning: Tuning, text: str) -> str:
    """Return the text of a scene file with the configuration that was chosen, and remarks on where it comes from."""
    if tuning.cheaper is not None:
        run = tuning.cheaper.run
        return with_tolerance(text, tuning.scene, run.family, run.tolerance, remarks(tuning))
    assert tuning.chosen is not None
    accepted = tuning.verified.accepted if tuning.verified is not None else None
    return rewritten(text, tuning.scene, tuning.chosen.configuration, remarks(tuning), accepted)


def remarks(tuning: Tuning) -> list[str]:
    """Return what a scene file should say about where its configuration comes from."""
    winner = tuning.winner
    assert winner is not None
    error = _error(tuning, winner.error)
    return [
        f"Tuned by `tmm-gen tune`: the output '{tuning.excitation.output}' is off by at most {error}",
        f"over {tuning.excitation.until:g} s of {'; '.join(tuning.excitation.told(tuning.scene))};",
        f"a simulated second takes {time_text(winner.ns_per_second)} on the machine it was tuned on.",
    ]


def _by_tolerance(tuning: Tuning, each: ByTolerance) -> str:
    run = each.run
    return (
        f"{run.family.integrator} by a tolerance of {run.tolerance:g}: {run.steps} steps, from {run.smallest:.2g} to "
        f"{run.largest:.2g} s; the output '{tuning.excitation.output}' is off by at most {_error(tuning, run.error)}, "
        f"and a simulated second takes {time_text(each.ns_per_second)}, with all that chooses and measures."
    )


def _chosen(tuning: Tuning) -> list[str]:
    point, checked, winner = tuning.chosen, tuning.verified, tuning.of_equal_steps
    assert point is not None
    assert checked is not None
    assert winner is not None
    step = point.configuration.step
    lines = [
        f"{_label(tuning, point)} with steps of {step:g} s: run afresh, the output '{tuning.excitation.output}' is off "
        f"by at most {_error(tuning, winner.error)}, and a simulated second takes "
        f"{time_text(checked.ns_per_second)} ({checked.ns_per_step:.0f} ns a step)."
    ]
    if point.result.modelling_error:
        lines.append(
            f"Of that error {_error(tuning, point.result.modelling_error)} come from cutting the beam into "
            f"{point.configuration.family.links} links, {_error(tuning, checked.error)} from stepping time."
        )
    if tuning.beyond is not None and tuning.beyond[1].error is not None:
        longer, result = tuning.beyond
        lines.append(
            f"Longer steps will not do: at {longer.step:.3g} s it is {_error(tuning, result.total_error)}."
        )
    lines += [
        f"{family.label} would be cheaper but does not fit the budget: {reason}."
        for family, reason in tuning.over_budget.items()
    ]
    others = [p for p in tuning.candidates if p.configuration.family not in tuning.over_budget]
    behind = [p for p in others if p.configuration.family != point.configuration.family and p.ns_per_second]
    if behind and point.ns_per_second:
        second = behind[0]
        # both as measured by turns; the fresh run was at another time
        ratio = (second.ns_per_second or 0.0) / point.ns_per_second
        lines.append(
            f"Next comes {_label(tuning, second)} with steps of {second.configuration.step:g} s, "
            f"at {ratio:.2g} times the time."
        )
    if tuning.nearest:
        failed = ", ".join(_label(tuning, p) for p in tuning.nearest)
        lines.append(f"Not accurate enough at any step worth its time: {failed}.")
    lines.append(_before(tuning, point))
    return lines


def _before(tuning: Tuning, chosen: Point) -> str:
    """Say how the scene as it was compares: in cost only if it keeps the bound on the error too."""
    mine = tuning.own
    named = f"The scene as it was ({mine.configuration.family.integrator}, {mine.configuration.step:g} s)"
    if not mine.finished or mine.ns_per_second is None:
        return f"{named} did not finish: {mine.result.reason}."
    off = f"{named} is off by {_error(tuning, mine.result.error)} in time"
    if not _keeps(tuning, chosen) or not chosen.ns_per_second:
        return f"{off} and takes {time_text(mine.ns_per_second)} for a simulated second."
    ratio = mine.ns_per_second / chosen.ns_per_second
    compared = f"{ratio:.3g} times as long" if ratio >= 1.0 else f"{1.0 / ratio:.3g} times less"
    return f"{off}, within the bound too, and takes {compared}."


def _keeps(tuning: Tuning, chosen: Point) -> bool:
    """Whether the scene as it was is known to keep the bound that the chosen one keeps."""
    mine = tuning.own
    if chosen.result.modelling_error is not None and mine.result.modelling_error is None:
        return False
    return mine.error <= tuning.max_error


def _none(tuning: Tuning) -> list[str]:
    wanted = f"an error of at most {_error(tuning, tuning.max_error)}"
    limit = f"{time_text(1e9 * tuning.max_time)} for a simulated second"
    lines = [f"Nothing keeps both {wanted} and {limit}."]
    if not tuning.candidates:
        lines.append(f"No configuration keeps {wanted}, whatever it costs.")
        if tuning.nearest:
            near = tuning.nearest[0]
            lines.append(
                f"Nearest: {_label(tuning, near)} with steps of {near.configuration.step:.3g} s is off by "
                f"{_error(tuning, near.error)}. Allow such an error, or other integrators or number types."
            )
        return lines
    for family, reason in tuning.over_budget.items():
        lines.append(f"{family.label} does both but does not fit the budget: {reason}.")
    fits = [p for p in tuning.candidates if p.configuration.family not in tuning.over_budget]
    if fits:
        near = fits[0]
        ns = near.ns_per_second or 0.0
        lines.append(
            f"Nearest: {_label(tuning, near)} with steps of {near.configuration.step:g} s is accurate enough "
            f"({_error(tuning, near.error)}), but takes {time_text(ns)}, "
            f"{ns / (1e9 * tuning.max_time):.3g} times the time allowed: its step alone takes "
            f"{near.cost.ns_per_step if near.cost else 0.0:.0f} ns, and longer ones are not accurate."
        )
    return lines


def _label(tuning: Tuning, point: Point) -> str:
    """Name a configuration by what of it differs from the scene."""
    family, mine = point.configuration.family, own(tuning.scene).family
    return family.integrator if replace(family, integrator=mine.integrator) == mine else family.label


def _error(tuning: Tuning, relative: float | None) -> str:
    if relative is None:
        return "nobody knows how much"
    return f"{relative:.3g} of its travel ({relative * tuning.travel:.2g} {tuning.unit})"
