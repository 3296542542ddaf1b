"""An arm in space in motion: one page of HTML that needs nothing else and that the reader turns.

What the page moves is data, not pictures: the points of the arm at some hundred instants, as whole multiples of a
length that no eye can see.
"""

from __future__ import annotations

import json
import math
from typing import Any

import numpy as np

from tmm_gen.emit.templates import render
from tmm_gen.report.space_motion import SpaceMotion, space_motion
from tmm_gen.simulate.simulation import Simulation

MOST_INSTANTS = 600
MOST_NUMBERS = 120_000
"""Coordinates in a page; each takes seven characters at most, as no point is farther away than the reach."""

FINEST = 2e-4
"""A page's unit of length is below this share of the reach, and a power of ten."""


def space_page(simulation: Simulation) -> bytes:
    """Return a page that shows a simulation.

    Parameters
    ----------
    simulation : Simulation
        Of an arm in space, traced.

    Raises
    ------
    ValueError
        If the motion was not traced.
    """
    scene = simulation.scene
    step = f"{scene.integrator.name}, step {scene.integrator.step:g} s, {simulation.backend} kernel"
    return motion_page(space_motion(simulation), scene.name, scene.title, step)


def motion_page(motion: SpaceMotion, name: str, title: str, told: str) -> bytes:
    """Return a page that shows an arm at some instants.

    Parameters
    ----------
    motion : SpaceMotion
        Where its joints are over time.
    name, title : str
        Of the scene.
    told : str
        A line below the title.
    """
    # what a scene says must not end the element that holds it
    data = json.dumps(page_data(motion), separators=(",", ":")).replace("<", "\\u003c")
    page = render("report/space/page.html.jinja", name=name, title=title, told=told, motion=data)
    return page.encode()


def page_data(motion: SpaceMotion) -> dict[str, Any]:
    """Return what a page is told.

    Parameters
    ----------
    motion : SpaceMotion
        Where its joints are over time.

    Returns
    -------
    dict
        ``time``, s, one for each row of ``points``, which are x, y and z of all spots and then of the ends of all pins,
        in multiples of ``unit``, m; ``lines`` through spots, ``pins`` as numbers of a spot and of a point, ``tips``;
        ``axes`` of the view by rows, the third upward, and ``reach``, m.
    """
    skeleton, reach = motion.skeleton, motion.reach
    spots, pins = len(skeleton.spots), len(skeleton.pins)
    shown = motion.thinned(max(2, min(MOST_INSTANTS, MOST_NUMBERS // (3 * (spots + pins)))))
    unit = 10.0 ** math.floor(math.log10(FINEST * reach))
    points = np.concatenate(shown.places, axis=1)
    whole = np.rint(points / unit).astype(int)
    return {
        "time": [float(f"{time:.6g}") for time in shown.time],
        "unit": unit,
        "points": whole.reshape(len(whole), -1).tolist(),
        "lines": skeleton.lines,
        "pins": [(skeleton.of_joints[joint], spots + k) for k, joint in enumerate(skeleton.pins)],
        "tips": [{"spot": tip.spot, "name": tip.name} for tip in skeleton.tips],
        "axes": _view_axes(*motion.upward),
        "reach": float(f"{reach:.6g}"),
    }


def _view_axes(up: int, sign: int) -> list[list[int]]:
    """Return right-handed axes by rows, the third upward."""
    first, second = ((up + 1) % 3, (up + 2) % 3)[::sign]
    axes = [[0] * 3 for _ in range(3)]
    axes[0][first] = axes[1][second] = 1
    axes[2][up] = sign
    return axes
