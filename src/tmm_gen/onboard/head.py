"""The head of the files of a controller in C."""

from __future__ import annotations

import textwrap

from tmm_gen.c_language.real import Real
from tmm_gen.c_language.wrap import WIDTH
from tmm_gen.control.task.problem import ControlProblem
from tmm_gen.version import __version__


def head(title: str, kind: str, problem: ControlProblem, real: Real, lead: str) -> str:
    """Return the lines of the head, each after a lead.

    Parameters
    ----------
    title, kind : str
        What the files are, and of what controller: a line each.
    problem : ControlProblem
        What that solves.
    real : Real
        Number type.
    lead : str
        Of a line of comment.
    """
    lines = [
        title,
        "",
        f"Written by tmm-gen {__version__}. Do not edit: change the scene and run `tmm-gen mpc --emit`.",
        "",
        kind,
        f"delay: {problem.delay:g} s, {_torques(problem)}",
        f"number type: {real.c}",
        "quadratic programs: DAQP (MIT licence), in daqp/",
    ]
    wrapped = [part for line in lines for part in (textwrap.wrap(line, WIDTH - len(lead) - 1) or [""])]
    return "\n".join(f"{lead} {line}".rstrip() for line in wrapped)


def _torques(problem: ControlProblem) -> str:
    """Return the bounds of the torques, in words."""
    told = [f"{low:g} to {high:g} N m" for low, high in zip(*problem.torque, strict=True)]
    if problem.motors.on_hub:
        return f"torque: {told[0]}"
    return "torques: " + ", ".join(
        f"{name} {each}" for name, each in zip(problem.motors.names, told, strict=True)
    )
