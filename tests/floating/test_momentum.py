"""Nothing pushes a floating arm: its momentum stays what it was, to the integrator's order."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from tmm_gen.native import NativeKernel, compile_kernel
from tmm_gen.program.build import build_program
from tmm_gen.scene import Scene
from tmm_gen.scene.model import FloatingBase

Array = NDArray[np.float64]

pytestmark = pytest.mark.compiler

UNTIL = 0.5


def momentum(scene: Scene, state: Mapping[str, Any]) -> Array:
    """Along x, along y, and about the origin, from the bodies one by one."""
    base = scene.base
    assert isinstance(base, FloatingBase)
    place, velocity = (np.array([state[f"base_{w}_{k}"] for k in "xy"], float) for w in ("place", "velocity"))
    angles, rates = (np.append(state[f"hub_{w}"], state[w]) for w in ("angle", "rate"))
    about = base.mass * (place[0] * velocity[1] - place[1] * velocity[0]) + base.inertia * rates[0]
    found = np.array([*(base.mass * velocity), about])
    ends = {0: (place, velocity)}
    for number, link in enumerate(scene.links, start=1):
        along = np.array([np.cos(angles[number]), np.sin(angles[number])])
        across = rates[number] * np.array([-along[1], along[0]])
        begin, moved = ends[scene.host(number)]
        center, speed = begin + link.center * link.length * along, moved + link.center * link.length * across
        ends[number] = (begin + link.length * along, moved + link.length * across)
        spin = center[0] * speed[1] - center[1] * speed[0]
        found += [*(link.mass * speed), link.mass * spin + link.inertia * rates[number]]
    return found


def drift(scene: Scene, kernel: NativeKernel, step: float) -> Array:
    """Return how far momentum moves from what it was, at most over the run, kg m/s and kg m^2/s."""
    kernel.prepare(step=step)
    kernel.initialise({})
    seen = [momentum(scene, kernel.state)]
    for _ in range(round(UNTIL / step)):
        kernel.step({})
        seen.append(momentum(scene, kernel.state))
    found: Array = np.max(np.abs(np.array(seen) - seen[0]), axis=0)
    return found


@pytest.mark.parametrize(
    ("integrator", "order"), [("newmark", 2), ("bathe", 2), ("sdirk4", 4), ("radau3", 5)]
)
def test_momentum_is_conserved(integrator: str, order: int, cube: Scene) -> None:
    """Panels let go as they are bent, unlike on both sides, swing, and the hub with them."""
    angles = {"left_yoke": 3.1, "left_panel": 3.0, "right_yoke": 0.05, "right_panel": 0.12}
    rates = {"left_yoke": 0.3, "left_panel": -0.4, "right_yoke": 0.2, "right_panel": 0.4}
    changes = {"integrator.name": integrator, "initial.angles": angles, "initial.rates": rates}
    scene = cube.replace(**changes)
    steps = [2e-3, 1e-3, 5e-4]
    if scene.coupled:  # of fewer pieces, for the time it takes
        pieces = {f"beam.{side}_panel.links": 2 for side in ("left", "right")}
        scene = scene.replace(**pieces, **{"model.iterations": 2})
        steps = [8e-3, 4e-3, 2e-3]
    kernel = compile_kernel(build_program(scene), scene, flags=("-O1",))
    errors = np.array([drift(scene, kernel, step) for step in steps])
    for component in errors.T:
        assert np.polyfit(np.log(steps), np.log(component), 1)[0] > order - 0.3
    assert np.all(errors[-1] < 1e-3)


@pytest.mark.parametrize("wheel", [0.0, 0.7])
def test_what_starts_symmetric_stays_so(wheel: float, cube: Scene) -> None:
    """Turned by its wheel, a satellite alike on both sides stays where it is; its wheel's torque is all it gains."""
    kernel = compile_kernel(build_program(cube), cube, flags=("-O1",))
    kernel.prepare()
    kernel.initialise({"wheel": wheel})
    for _ in range(500):
        kernel.step({"wheel": wheel})
    found = momentum(cube, kernel.state)
    np.testing.assert_allclose(found[:2], 0.0, atol=1e-12)
    assert found[2] == pytest.approx(wheel * 500 * cube.integrator.step, rel=1e-6, abs=1e-12)


def test_what_falls_falls_as_galilei_says(drifter: Callable[..., Scene]) -> None:
    """The centre of mass of an arm that swings as it likes."""
    scene, free = drifter(gravity=9.81), drifter()
    ended = []
    for each in (scene, free):
        kernel = compile_kernel(build_program(each), each, flags=("-O1",))
        kernel.prepare()
        kernel.initialise({})
        for _ in range(400):
            kernel.step({})
        ended.append(kernel.output())
    time = 400 * scene.integrator.step
    falling, floating = ended
    assert falling["hub_y"] - floating["hub_y"] == pytest.approx(-0.5 * 9.81 * time**2, rel=1e-10)
    assert falling["hub_x"] == pytest.approx(floating["hub_x"], abs=1e-11)
    assert falling["attitude"] == pytest.approx(floating["attitude"], abs=1e-11)
