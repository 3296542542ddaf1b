"""Planar arms written as arms in space move as planar kernels have them move, once sweeps have converged.

Joints turn about z, links lie along x, gravity pulls along -y. Angles are those of links in the plane, and those of
joints in space.
"""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
from support.spatial.kernels import angles_of

from tmm_gen.native.python_module import numpy_module
from tmm_gen.program.build import build_program
from tmm_gen.scene import Scene, parse_scene
from tmm_gen.scene.model import MOST_SWEEPS

STEPS, STEP = 200, 2e-3
ALIKE = 1e-10
COUPLED = ("radau3",)
"""Solve all stages at once: as many iterations as it takes, in one loop."""

CHAIN = (
    ("motor", "hub", "base", "rotor_inertia = 2e-4\ngear = 10\ndamping = 0.02"),
    ("link", "upper", "hub", (0.3, 0.4, 0.4, 4e-3)),
    ("joint", "bend", "upper", "stiffness = 3.0\ndamping = 0.02\nrest = 0.3"),
    ("link", "middle", "bend", (0.25, 0.3, 0.5, 2e-3)),
    ("joint", "hinge", "middle", ""),
    ("link", "lower", "hinge", (0.2, 0.2, 0.6, 1e-3)),
)
"""Motor, spring and free hinge; of links the length, m, mass, kg, centre as a share, and inertia, kg m^2."""
BRANCH = (
    ("motor", "wrist", "upper", "rotor_inertia = 1e-4\ngear = 5\ndamping = 0.01"),
    ("link", "finger", "wrist", (0.15, 0.1, 0.5, 3e-4)),
    ("joint", "pad", "finger", "stiffness = 0.5\ndamping = 1e-3"),
    ("link", "nail", "pad", (0.1, 0.05, 0.3, 1e-4)),
)
"""Hung on the first link."""
ARMS = {"chain": CHAIN, "tree": (*CHAIN, *BRANCH)}
TORQUE = {"hub_torque": 0.02}


def scene(kind: str, arm: str, integrator: str, iterations: int | str) -> Scene:
    """Return an arm of either kind."""
    spatial = kind == "spatial"
    gravity = "[0, -9.81, 0]" if spatial else "9.81"
    text = (
        f'name = "{arm}_{kind}"\n[model]\nkind = "{kind}"\ngravity = {gravity}\niterations = {iterations}\n'
        f'[integrator]\nname = "{integrator}"\nstep = {STEP}\n[base]\nkind = "clamp"\n'
    )
    for table, name, host, said in ARMS[arm]:
        text += f'[[{table}]]\nname = "{name}"\non = "{host}"\n'
        if isinstance(said, str):
            text += said + ('\naxis = "z"\n' if spatial else "\n")
            continue
        length, mass, share, inertia = said
        text += f"mass = {mass}\n"
        text += (
            f"end = [{length}, 0, 0]\ncenter = [{share * length!r}, 0, 0]\n"
            f"inertia = [{inertia / 2}, {inertia / 2}, {inertia}]\n"
            if spatial
            else f"length = {length}\ncenter = {share}\ninertia = {inertia}\n"
        )
    text += '[[input]]\nname = "hub_torque"\nat = "hub"\nacts = "torque"\n'
    text += '[[output]]\nname = "hub"\nat = "hub"\nof = "angle"\n'
    return parse_scene(text)


def hosts(arm: str) -> list[int]:
    """Return for each joint the index of the joint behind whose link it stands, -1 for the base."""
    movers = [name for table, name, _, _ in ARMS[arm] if table != "link"]
    behind = {name: host for _, name, host, _ in ARMS[arm]}
    return [-1 if behind[m] == "base" else movers.index(behind[behind[m]]) for m in movers]


def absolute(arm: str, relative: np.ndarray) -> np.ndarray:
    """Return angles of links from those of joints, (..., n) both."""
    found = relative.copy()
    for k, host in enumerate(hosts(arm)):
        if host >= 0:
            found[..., k] += found[..., host]
    return found


@cache
def moved(kind: str, arm: str, integrator: str) -> np.ndarray:
    """Return the angles of the links, (steps + 1, n)."""
    if integrator in COUPLED:
        iterated = scene(kind, arm, integrator, '"auto"')
        module, least = numpy_module(iterated, build_program(iterated, auto=True)), {"least_turn": 1e-6}
    else:
        sweeps = MOST_SWEEPS if kind == "spatial" else 6
        module, least = numpy_module(scene(kind, arm, integrator, sweeps)), {}
    count = len(hosts(arm))
    angle, rate = np.linspace(0.5, -0.4, count), np.linspace(-1.0, 2.0, count)
    if kind == "planar":
        angle, rate = absolute(arm, angle), absolute(arm, rate)
    given = module.Input(**TORQUE)
    model = module.prepare(module.Params(**least), step=STEP)
    states = [module.initialise(module.Params(), given, initial_angle=angle, initial_rate=rate)]
    stages = [given] * len(module.STAGE_INSTANTS[-1])
    for _ in range(STEPS):
        states.append(module.step(model, states[-1], stages if len(stages) > 1 else given))
    found = angles_of(states)
    return found if kind == "planar" else absolute(arm, found)


@pytest.mark.parametrize(
    ("arm", "integrator"),
    [("chain", "newmark"), ("tree", "newmark"), ("tree", "sdirk4"), ("chain", "radau3")],
)
def test_twins_move_alike(arm: str, integrator: str) -> None:
    plane, space = (moved(kind, arm, integrator) for kind in ("planar", "spatial"))
    assert np.max(np.abs(plane - space)) < ALIKE
    assert np.min(np.ptp(plane, axis=0)) > 0.3


def test_another_integrator_is_no_twin() -> None:
    """How near they would come if they were not the same step."""
    assert (
        np.max(np.abs(moved("planar", "tree", "newmark") - moved("spatial", "tree", "sdirk4"))) > 1e3 * ALIKE
    )
