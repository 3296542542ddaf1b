"""What an arm does does not depend on the order in which its file lists its branches.

Whatever takes the link before for the link inside, or the last link for the end of the arm, answers differently.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
import pytest

from tmm_gen.inputs.signals import Constant
from tmm_gen.modal.matrices import matrices
from tmm_gen.modal.modes import find_modes
from tmm_gen.modal.response import frequency_response
from tmm_gen.modal.situation import resting_arm
from tmm_gen.reference.duration import default_duration
from tmm_gen.reference.frequency import fastest_mode
from tmm_gen.scene import Scene
from tmm_gen.simulate.run import simulate
from tmm_gen.study.excitation import excitation

ORDERS = (("left", "right", "back"), ("back", "left", "right"))
NAMES = ("stem", "left_arm", "shin", "rod", "back_arm", "prop_arm")


@pytest.fixture
def pair(fork: Callable[..., Scene]) -> list[Scene]:
    """The same arm twice, with two branches exchanged in the file."""
    both = [fork(order=order, **{"model.gravity": 9.81}) for order in ORDERS]
    assert both[0].hosts != both[1].hosts
    return both


def numbers(scene: Scene) -> list[int]:
    """Indices of the links, part by part, in an order that is the same for both."""
    by_name = {part.name: part for part in scene.parts if part.last}
    return [k for name in NAMES for k in range(by_name[name].first - 1, by_name[name].last)]


def test_modes(pair: Sequence[Scene]) -> None:
    arms = [resting_arm(scene) for scene in pair]
    places = [numbers(scene) for scene in pair]
    one, other = (arm.rest.angles[place] for arm, place in zip(arms, places, strict=True) if arm.rest)
    assert one == pytest.approx(other, abs=1e-9)
    for a, b in zip(*(find_modes(matrices(arm)) for arm in arms), strict=True):
        assert np.array(a.poles) == pytest.approx(np.array(b.poles), rel=1e-8)
        here, there = a.shape[places[0]], b.shape[places[1]]
        assert np.minimum(np.abs(here - there).max(), np.abs(here + there).max()) <= 1e-6


def test_frequency_response(pair: Sequence[Scene]) -> None:
    one, other = (
        frequency_response(resting_arm(scene), 2j * np.pi * np.array([1.0, 30.0])) for scene in pair
    )
    assert set(one) == set(other)
    for name, values in one.items():
        assert values == pytest.approx(other[name], rel=1e-7, abs=1e-9 * np.abs(values).max()), name


def test_run(pair: Sequence[Scene]) -> None:
    held = {"push": Constant(0.2), "turn": Constant(0.002)}
    one, other = (simulate(scene, held, 0.1) for scene in pair)
    for name, values in one.outputs.items():
        assert values == pytest.approx(other.outputs[name], abs=1e-8 * np.abs(values).max()), name
    assert one.accuracy is not None
    assert other.accuracy is not None
    assert one.accuracy.error == pytest.approx(other.accuracy.error, rel=0.2)


def test_what_studies_take_from_an_arm(pair: Sequence[Scene]) -> None:
    one, other = pair
    assert one.reach == other.reach == pytest.approx(0.55)
    assert default_duration(one) == default_duration(other)
    assert fastest_mode(one).frequency == pytest.approx(fastest_mode(other).frequency, rel=1e-9)
    signals = [excitation(scene, output="shin").told(scene) for scene in pair]
    assert sorted(signals[0]) == sorted(signals[1])
