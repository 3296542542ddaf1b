"""A simulation of a planar arm that loses the motion says when, where, why and what to do."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from tmm_gen.errors import UserError
from tmm_gen.scene import Scene
from tmm_gen.simulate.divergence import DivergedError
from tmm_gen.simulate.run import simulate
from tmm_gen.simulate.stepping import Backend

pytestmark = pytest.mark.compiler


@pytest.mark.parametrize("backend", ["numpy", "c"])
def test_the_frozen_step_is_told_by_time_link_cause_and_remedy(
    backend: Backend, falling: Callable[..., Scene]
) -> None:
    scene = falling(5, **{"model.linearisation": "frozen"})
    with pytest.raises(DivergedError) as told:
        simulate(scene, {}, 1.0, backend)
    for words in ("t = 0.0", "link 1 of 5", "'frozen'", "--set model.linearisation=newton"):
        assert words in str(told.value)


def test_the_taylor_step_fails_at_small_steps_with_its_own_remedy(falling: Callable[..., Scene]) -> None:
    scene = falling(5, **{"model.linearisation": "taylor", "integrator.step": 1e-3})
    with pytest.raises(DivergedError, match="'taylor'") as told:
        simulate(scene, {}, 2.0, "c")
    assert "newton" in str(told.value)
    assert "iterations" not in str(told.value)


def test_a_step_beyond_the_integrators_limit_is_its_cause(falling: Callable[..., Scene]) -> None:
    scene = falling(20, **{"integrator.name": "zhai"})
    with pytest.raises(UserError, match=r"beyond the limit|cannot be solved"):
        simulate(scene, {}, 1.0, "c")


@pytest.mark.long
def test_what_turns_too_far_in_a_step_is_refused_at_once(unlike: Callable[..., Scene]) -> None:
    scene = unlike("motor", step=0.01).replace(initial={"angles": 0.0, "rates": 60.0})
    once = scene.replace(**{"model.iterations": 1})
    with pytest.raises(UserError, match=r"turn by 0.6 rad in one step.*Use a step below 0.008 s"):
        simulate(once, {}, 1.0, "c")
    for sweeps in (2, "auto"):
        more = scene.replace(**{"model.iterations": sweeps})
        found = simulate(more, {}, 0.02, "c", refuse=False, judge=False)
        assert np.all(np.isfinite(found.outputs["angle_of_base"]))
