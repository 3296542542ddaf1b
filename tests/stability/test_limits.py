"""The largest stable step is where a run of the kernel begins to grow."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pytest

from tmm_gen.derive.integrators.registry import integrator
from tmm_gen.errors import UserError
from tmm_gen.native.python_module import numpy_module
from tmm_gen.scene import Scene
from tmm_gen.stability.growth import Growth
from tmm_gen.stability.limits import scene_integrators, standing
from tmm_gen.stability.motion import small_motion
from tmm_gen.stability.variants import with_integrator


@pytest.mark.parametrize(
    ("scene", "name"), [("thesis10", "zhai"), ("thesis10", "zhou"), ("drivetrain", "zhai")]
)
def test_kernels_grow_beyond_it_and_not_before(
    scene: str, name: str, example: Callable[[str], Scene]
) -> None:
    """Coupled damping included: a long run from random angles, just within and just beyond."""
    motion = small_motion(example(scene))
    method = integrator(name)
    found = standing(motion, Growth(method))
    assert found.exact
    assert 0.0 < found.largest_step < math.inf
    module = numpy_module(with_integrator(motion.scene, method))
    angle = np.random.default_rng(0).normal(size=(motion.scene.stations, 1))
    steps = found.largest_step * np.array([0.99, 1.02])
    model = module.prepare(step=steps)
    state = module.initialise(initial_angle=np.repeat(angle, 2, axis=1))
    sizes = []
    for _ in range(3000):
        state = module.step(model, state)
        sizes.append(np.max(np.abs(np.diff(state.angle, axis=0)), axis=0))
    first, last = sizes[500], sizes[-1]
    assert last[0] <= 1.01 * first[0]
    assert last[1] > 1e3 * first[1]


def test_verdicts_and_margins(example: Callable[[str], Scene]) -> None:
    motion = small_motion(example("arm10"))
    by_name = {
        each.integrator.name: each
        for each in (
            standing(motion, Growth(method))
            for method in scene_integrators(motion.scene, ["newmark", "zhou", "zhai"])
        )
    }
    assert by_name["newmark"].chosen
    assert by_name["newmark"].stable
    assert math.isinf(by_name["newmark"].largest_step)
    assert by_name["newmark"].order == 2
    for name in ("zhou", "zhai"):
        assert not by_name[name].stable
        assert by_name[name].largest_step < motion.scene.integrator.step
        assert by_name[name].radius_excess > 0.05
    assert by_name["zhai"].limit == 2.0
    assert by_name["zhai"].limit_damped < 0.3  # the highest mode is overdamped


def test_without_damping_any_step_grows_with_zhou(example: Callable[[str], Scene]) -> None:
    scene = example("thesis10").replace(**{"joint.1.damping": 0.0})
    found = standing(small_motion(scene), Growth(integrator("zhou")))
    assert found.largest_step == 0.0
    assert not found.stable


def test_a_chain_too_long_for_dense_matrices_is_refused(example: Callable[[str], Scene]) -> None:
    scene = example("thesis10").replace(**{"joint.1.repeat": 2000, "link.1.repeat": 2000})
    with pytest.raises(UserError, match="at most 1000"):
        small_motion(scene)
