"""The page: several integrators of one scene as modules, sliders, and the arm in motion."""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Sequence
from typing import Any

from tmm_gen.emit.templates import render
from tmm_gen.errors import UserError
from tmm_gen.playground.figure import figure_of
from tmm_gen.playground.load import loads
from tmm_gen.playground.method import method
from tmm_gen.playground.payload import FACTORS, payload_of
from tmm_gen.scene import Scene
from tmm_gen.study.excitation import Excitation, excitation
from tmm_gen.version import __version__

REFERENCE = "sdirk4"
"""What the fine step is taken with: fourth order, and serving every arm."""

USUAL = ("newmark", "bathe", "houbolt", "zhai", REFERENCE)
"""Integrators of a page: the two most used, one that damps too much, an explicit one, one of high order."""

HALVINGS, DOUBLINGS = 1, 5
"""Of the scene's step, on the slider; the fine step is the shortest."""

MOST_STEPS = 5000
"""Steps of the scene in a run, so that a telephone has the fine one within a second or two."""


def served_names(scene: Scene, names: Sequence[str]) -> tuple[str, ...]:
    """Return the integrators of a page, the scene's own first, the finest among them.

    Raises
    ------
    UserError
        If one does not exist or does not serve the arm.
    """
    for name in names:
        if name not in scene.integrators:
            raise UserError(f"integrator '{name}': choose from {', '.join(scene.integrators)}.")
    own = (scene.integrator.name, *(names or USUAL), REFERENCE)
    return tuple(dict.fromkeys(own))


def require_played(scene: Scene) -> None:
    """Refuse a scene that no page shows yet.

    Raises
    ------
    UserError
        Where an input moves the base in space.
    """
    if scene.motions and scene.spatial is not None:
        raise UserError(
            f"scene '{scene.name}': the input '{scene.motions[0].name}' moves its base in space, which a playground "
            'does not show yet. Write kind = "clamp" under [base], and a [[motor]] on it where the base turns.'
        )


def playground(
    scene: Scene,
    names: Sequence[str] = (),
    until: float | None = None,
    advance: Callable[[str], None] = lambda doing: None,
) -> str:
    """Return the page.

    Parameters
    ----------
    scene : Scene
        What is shown.
    names : sequence of str
        Integrators to choose from, besides the scene's own and the fine one; by default `USUAL`.
    until : float, optional
        Length of a run, s; by default five slow periods, or fewer.
    advance : callable
        Told what is being done.

    Raises
    ------
    UserError
        If no page shows the scene yet, an integrator does not serve it, nothing moves, or there is no compiler.
    """
    require_played(scene)
    chosen = served_names(scene, names)
    went, length = _run(scene, until)
    methods = []
    for name in chosen:
        advance(f"{name} of {scene.name}")
        methods.append(method(scene, name))
    data = {
        "name": scene.name,
        "figure": figure_of(scene),
        "signals": loads(scene, went.signals),
        "until": length,
        "step": scene.integrator.step,
        "halvings": HALVINGS,
        "doublings": DOUBLINGS,
        "methods": methods,
        "fine": chosen.index(REFERENCE),
        "payload": _payload(scene),
    }
    # what a scene says must not end the element that holds it
    text = json.dumps(data, separators=(",", ":")).replace("<", "\\u003c")
    told = [line.replace("^2", "²") for line in went.told(scene)]
    return render(
        "playground/page.html.jinja",
        name=scene.name,
        title=scene.title,
        told=told,
        data=text,
        version=__version__,
    )


def _run(scene: Scene, until: float | None) -> tuple[Excitation, float]:
    """Return what the arm goes through, and for how long: so many of the longest steps, s."""
    longest = scene.integrator.step * 2.0**DOUBLINGS
    if until is None:
        until = min(excitation(scene).until, MOST_STEPS * scene.integrator.step)
    steps = max(1, math.ceil(until / longest * (1.0 - 1e-9)))
    return excitation(scene, until=steps * longest), steps * longest


def _payload(scene: Scene) -> dict[str, Any] | None:
    payload = payload_of(scene)
    if payload is None:
        return None
    values = [float(f"{payload.value * factor:.3g}") for factor in FACTORS]
    return {"values": values, "unit": payload.unit, "own": FACTORS.index(1.0)}
