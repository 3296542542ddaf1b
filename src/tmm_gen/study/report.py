"""A study as one page of HTML that needs nothing else: no network, no script, no other file."""

from __future__ import annotations

import base64
import math
from collections import Counter
from typing import Any

from tmm_gen.csv_text import csv_text
from tmm_gen.emit.templates import render
from tmm_gen.study.excitation import unit
from tmm_gen.study.figures import (
    modelling_picture,
    operations_picture,
    step_picture,
    time_picture,
)
from tmm_gen.study.findings import Finding, by_family, findings, plain_number
from tmm_gen.study.machine import machine
from tmm_gen.study.outcome import Outcome
from tmm_gen.study.point import Point
from tmm_gen.study.study import Study
from tmm_gen.version import __version__


def report(study: Study) -> str:
    """Return the page.

    Parameters
    ----------
    study : Study
        With one finished point at least.
    """
    found = findings(study)
    return render(
        "report/trade.html.jinja",
        study=study,
        scene=study.scene,
        unit=unit(study.scene, study.excitation.output),
        told=study.excitation.told(study.scene),
        sentences=[each.sentence() for each in found],
        figures=_figures(study),
        levels=[f"{each.level:g}" for each in found],
        race=_race(found),
        front=[_row(point) for point in study.front()],
        points=[_row(point) for point in study.points],
        modelling=sorted(study.modelling.values(), key=lambda each: each.links),
        outcomes=[(each.value, study.count(each)) for each in Outcome if study.count(each)],
        failures=_failures(study),
        machine=machine() if study.timed else "",
        version=__version__,
        csv=base64.b64encode(csv_text([point.values() for point in study.points]).encode()).decode(),
    )


def _figures(study: Study) -> list[dict[str, str]]:
    drawn = [
        (step_picture, "Error against step. Straight lines of slope p: order p."),
        (operations_picture, "The same in floating-point operations, which no clock can get wrong."),
    ]
    if study.timed:
        drawn.insert(0, (time_picture, "Error against time: down and left is better. Rings: beaten by none."))
    if len(study.modelling) > 1:
        drawn.append((modelling_picture, "Error of too few links, however time is stepped."))
    return [{"svg": _inline(make(study, "svg", wide=False)), "caption": text} for make, text in drawn]


def _inline(svg: bytes) -> str:
    """Return the element alone, to be scaled by the page."""
    text = svg.decode()
    return text[text.index("<svg") :]


def _race(found: tuple[Finding, ...]) -> list[dict[str, Any]]:
    """Return a row for each integrator: what it needs at each level, and the factor over Newmark's method.

    All cells are in one unit. Where a longer step than those tried may do, the cost is a bound, and there is no factor.
    """
    families = dict.fromkeys(way.family for each in found for way in each.ways)
    timed = all(way.ns is not None for each in found for way in each.ways)
    rows = []
    for family in families:
        cells = []
        for each in found:
            way = next((way for way in each.ways if way.family == family), None)
            if way is None:
                cells.append({"cost": "-", "factor": "", "best": False})
                continue
            factor = each.factor(way) if timed else each.operations_factor(way)
            cost = way.ns / 1e3 if timed and way.ns is not None else way.operations
            told = "-" if cost is None else f"{'' if way.known else '≤ '}{plain_number(cost)}"
            best = way is each.ways[0] and not each.rivals
            cells.append({"cost": told, "factor": "" if factor is None else f"{factor:.3g} ×", "best": best})
        rows.append({"label": family.integrator, "cells": cells})
    return rows


def _row(point: Point) -> dict[str, str]:
    result = point.result
    return {
        "label": point.configuration.family.label,
        "step": f"{point.configuration.step:.4g}",
        "error": _number(result.error) or result.outcome.value,
        "modelling": _number(result.modelling_error),
        "time": f"{point.ns_per_second / 1e3:.4g}" if point.ns_per_second is not None else "",
        "spread": f"{100.0 * point.cost.spread:.0f}" if point.cost else "",
        "operations": str(result.operations or ""),
        "code": str(result.code_bytes or ""),
        "state": str(result.state_bytes or ""),
        "reason": result.reason,
    }


def _number(value: float | None) -> str:
    return "" if value is None or not math.isfinite(value) else f"{value:.2e}"


def _failures(study: Study) -> list[str]:
    """Return a sentence for each family some of whose runs did not finish."""
    lines = []
    for family, finished in by_family(study.points):
        members = [p for p in study.points if p.configuration.family == family]
        failed = [p for p in members if not p.finished]
        if not failed:
            continue
        counts = Counter(p.result.outcome.value for p in failed)
        told = " and ".join(f"{count} {outcome}" for outcome, count in counts.items())
        longest = f", all with steps longer than {finished[0].configuration.step:.3g} s" if finished else ""
        beyond = (
            all(p.configuration.step > finished[0].configuration.step for p in failed) if finished else True
        )
        example = failed[-1]
        lines.append(
            f"{family.label}: {told} of {len(members)}{longest if beyond else ''}; "
            f"at {example.configuration.step:.3g} s: {example.result.reason}"
        )
    return lines
