"""What a step reads from outside, and when: loads, and the motion of a prescribed base."""

from __future__ import annotations

from collections.abc import Mapping

import sympy as sp

from tmm_gen.derive.integrators.declaration import KINDS, Integrator, Kind, Past, Scheme
from tmm_gen.program.fields import MOTION_NAMES
from tmm_gen.program.statements import Assign
from tmm_gen.program.variables import Role, Variable
from tmm_gen.scene import Scene
from tmm_gen.scene.signal import ACCELERATION, RATE, kernel_names

UNITS = {"torque": "N m", "force_x": "N", "force_y": "N"}


def input_instants(scene: Scene, scheme: Scheme) -> tuple[float, ...]:
    """Return the instants of a step, in steps, at which its inputs are read.

    These are those of its stages. Where the last stage is not at the end of the step, a prescribed base is asked
    there too: no formula of the integrator knows better where it is.
    """
    stages = tuple(float(stage.instant) for stage in scheme.stages)
    if scene.base.kind != "prescribed" or stages[-1] == 1.0:
        return stages
    return (*stages, 1.0)


def input_variables(scene: Scene, integrator: Integrator) -> tuple[Variable, ...]:
    """Return the inputs of a scene's kernel; arrays where a step reads them more than once."""
    instants = max((input_instants(scene, scheme) for scheme in integrator.schemes), key=len)
    length = len(instants) if len(instants) > 1 else None
    again = ", at each stage of the step" if length else ""
    if len(instants) > max(len(scheme.stages) for scheme in integrator.schemes):
        again += " and at its end"
    found: list[Variable] = []
    for item in scene.inputs:
        place = f"station {item.at}" if isinstance(item.at, int) else f"the {item.at}"
        names = kernel_names(item)
        if item.acts == "angle":
            words = [(f"prescribed base {MOTION_NAMES[k][0]}", MOTION_NAMES[k][1]) for k in KINDS]
        else:
            words = [(f"{item.acts} acting at {place}", UNITS[item.acts])]
        found += [
            Variable(name, Role.INPUT, length, doc + again, unit)
            for name, (doc, unit) in zip(names, words, strict=True)
        ]
    return tuple(found)


def prescribed_names(inputs: tuple[Variable, ...]) -> tuple[str, str, str] | None:
    """Return the names of angle, rate and acceleration of a prescribed base among a kernel's inputs, if it has them."""
    angle = next((variable.name for variable in inputs if variable.unit == "rad"), None)
    return None if angle is None else (angle, angle + RATE, angle + ACCELERATION)


def prescribed_motion(scene: Scene, inputs: tuple[Variable, ...], instant: int) -> dict[Kind, sp.Expr]:
    """Return angle, rate and acceleration of a prescribed base at an instant (from 0) of the step, else nothing."""
    by_name = {variable.name: variable for variable in inputs}
    for item in scene.inputs:
        if item.acts == "angle":
            names = dict(zip(KINDS, kernel_names(item), strict=True))
            return {kind: by_name[name].entry(instant) for kind, name in names.items()}
    return {}


def prescribed_end(hub: Mapping[Past, Variable], motion: Mapping[Kind, sp.Expr]) -> list[Assign]:
    """Return the statements that put a prescribed base where it is at the end of the step."""
    return [Assign(variable.ref, motion[p.kind]) for p, variable in hub.items() if motion and not p.lag]
