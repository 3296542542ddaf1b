"""Generated kernels of arms in space that no scene file stands for: built from the arm itself, stepped in NumPy."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np

from tmm_gen.derive.integrators.registry import integrator
from tmm_gen.emit.numpy import emit_numpy
from tmm_gen.native.python_module import import_package
from tmm_gen.program.space.assemble import SpaceChoices, build_in_space
from tmm_gen.program.statements import Program
from tmm_gen.scene import Scene, load_scene
from tmm_gen.scene.spatial.arm import SpatialArm

HEADED: Scene = load_scene(Path(__file__).resolve().parents[3] / "scenes" / "arm10.toml")
"""Any scene: headers are written of one."""
NAME = HEADED.name
"""Of all these packages."""


def program_of(arm: SpatialArm, name: str = "newmark", choices: SpaceChoices | None = None) -> Program:
    """Return the program of an arm with an integrator by its name, at a step of 1 ms unless chosen otherwise."""
    return build_in_space(arm, NAME, NAME, integrator(name), choices or SpaceChoices(1e-3))


def package_of(arm: SpatialArm, name: str = "newmark", choices: SpaceChoices | None = None) -> ModuleType:
    """Return its NumPy package."""
    return import_package(emit_numpy(program_of(arm, name, choices), HEADED), NAME)


def stepped(
    module: ModuleType,
    step: float,
    steps: int,
    inputs: Callable[[float], Mapping[str, float]] = lambda _: {},
    **changed: Any,
) -> list[Any]:
    """Return the states of a package: at the start and after each step.

    Parameters
    ----------
    step : float
        s.
    steps : int
    inputs : callable
        Columns by time.
    changed : Any
        Parameters that are not the arm's.
    """

    def given(time: float) -> Any:
        return module.Input(**inputs(time))

    params = module.Params(**changed)
    model, state = module.prepare(params, step=step), module.initialise(params, given(0.0))
    states = [state]
    for k in range(steps):
        instants = module.STAGE_INSTANTS[min(k, len(module.STAGE_INSTANTS) - 1)]
        stages = [given((k + at) * step) for at in instants]
        state = module.step(model, state, stages if len(stages) > 1 else stages[0])
        states.append(state)
    return states


def angles_of(states: list[Any]) -> np.ndarray:
    """Return the joints' angles, (steps + 1, n), rad."""
    return np.array([state.angle for state in states])
