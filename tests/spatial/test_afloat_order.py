"""Steps of arms on a base that floats go to the reference with the order of their integrators, turns included."""

from __future__ import annotations

from dataclasses import replace
from types import ModuleType

import numpy as np
import pytest
from support.spatial.afloat import coordinates, random_afloat
from support.spatial.kernels import package_of, stepped

from tmm_gen.program.space.assemble import SpaceChoices
from tmm_gen.reference.spatial_motion import motion
from tmm_gen.scene.spatial.arm import SpatialArm
from tmm_gen.verify.check_row import SLOPE
from tmm_gen.verify.spatial_order import fitted_order

UNTIL = 0.1
"""s."""
ONCE, TWICE, THRICE = (SpaceChoices(1e-3, iterations=count) for count in (1, 2, 3))


def bare(seed: int, joints: int = 1) -> SpatialArm:
    """Return an arm; two joints are for one method: what they do to each other, its base that floats does to one."""
    return replace(random_afloat(seed, joints, loads=False), outputs=())


def generated(arm: SpatialArm, name: str, choices: SpaceChoices) -> ModuleType:
    return package_of(arm, name, choices)


@pytest.mark.parametrize(
    ("name", "choices", "order"),
    [
        ("newmark", TWICE, 2),
        ("newmark", replace(ONCE, exact=True, held=True), 2),
        ("sdirk4", replace(THRICE, held=True), 4),
        ("sdirk4", replace(ONCE, exact=True, held=True), 4),
        ("park", TWICE, 2),
        ("radau3", TWICE, 4),
        ("radau3", THRICE, 5),
        ("gauss2", TWICE, 4),
    ],
    ids=["newmark", "newmark, exact", "sdirk4", "sdirk4, exact", "park", "radau3", "radau3, two", "gauss2"],
)
def test_order(name: str, choices: SpaceChoices, order: int) -> None:
    """Park's method looks back over two steps, which are turned to where each step begins.

    Where stages are solved at once, it takes what the last step left of angular accelerations to begin so well.
    """
    arm = bare(3, 2 if name == "newmark" else 1)
    fitted, _ = fitted_order(arm, generated(arm, name, choices))
    assert fitted == pytest.approx(order, abs=SLOPE)


def test_heavier_base_shows() -> None:
    """A kernel of another base does not go to this one's motion."""
    arm = bare(3)
    assert arm.base is not None
    body = replace(arm.base.body, mass=1.01 * arm.base.body.mass)
    other = replace(arm, base=replace(arm.base, body=body))
    fitted, _ = fitted_order(arm, generated(other, "newmark", TWICE))
    assert abs(fitted - 2.0) > SLOPE


@pytest.fixture(scope="module")
def place() -> np.ndarray:
    """Coordinates of an arm after a tenth of a second."""
    return motion(bare(4), {}, np.array([UNTIL]))[0][0]


@pytest.mark.parametrize("name", ["houbolt", "zhou", "zhai", "wilson", "bathe", "generalized_alpha"])
def test_every_other_method_goes_there(name: str, place: np.ndarray) -> None:
    """Those with a history too."""
    module = generated(bare(4), name, TWICE)
    errors = []
    for steps in (50, 100):
        state = stepped(module, UNTIL / steps, steps)[-1]
        errors.append(float(np.abs(coordinates(state)[0] - place).max()))
    assert errors[1] < 2e-3
    assert np.log2(errors[0] / errors[1]) > 1.7
