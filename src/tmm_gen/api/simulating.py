"""Runs as a program asks for them."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from tmm_gen.api.given import positive, signals
from tmm_gen.errors import UserError
from tmm_gen.inputs.clock import refuse_other_clock
from tmm_gen.reference.duration import default_duration
from tmm_gen.scene import Scene
from tmm_gen.simulate.run import number_of_steps, simulate
from tmm_gen.simulate.simulation import Simulation
from tmm_gen.simulate.stepping import Backend

__all__ = ["simulated"]


def simulated(
    scene: Scene,
    kernel_of: Callable[[Backend], Any],
    until: float | None,
    step: float | None,
    backend: Backend,
    acting: Mapping[str, object],
) -> Simulation:
    """Simulate a scene; arguments as of :meth:`tmm_gen.Arm.simulate`, inputs by column."""
    known: tuple[object, ...] = ("numpy", "c")
    if backend not in known:
        raise UserError(f"backend: must be 'numpy' or 'c', not {backend!r}.")
    own = positive("step", step, "seconds")
    if own is not None:
        scene = scene.replace(**{"integrator.step": own})
    duration = positive("until", until, "seconds") or default_duration(scene)
    acts = signals(scene, acting, number_of_steps(duration, scene.integrator.step))
    refuse_other_clock(acts, duration)
    # a step that was asked for is taken or refused, not divided
    return simulate(scene, acts, duration, backend, kernel=kernel_of(backend), substeps=own is None)
