"""When a step reads its inputs, and which of them move a prescribed base."""

from __future__ import annotations

from tmm_gen.derive.integrators.declaration import CONSISTENT_START, Scheme
from tmm_gen.program.variables import Variable
from tmm_gen.row.row import Row
from tmm_gen.scene.signal import ACCELERATION, RATE


def input_instants(row: Row, scheme: Scheme) -> tuple[float, ...]:
    """Return the instants of a step, in steps, at which its inputs are read.

    These are those of its stages. Where the last stage is not at the end of the step, a prescribed base is asked
    there too: no formula of the integrator knows better where it is. The start stands at its only instant.
    """
    stages = tuple(float(stage.instant) for stage in scheme.stages)
    if row.boundary != "prescribed" or scheme is CONSISTENT_START or stages[-1] == 1.0:
        return stages
    return (*stages, 1.0)


def prescribed_names(inputs: tuple[Variable, ...]) -> tuple[tuple[str, str, str], ...]:
    """Return the names of what moves a prescribed base among a kernel's inputs, each with rate and acceleration."""
    told = (variable.name for variable in inputs if variable.unit in ("rad", "m"))
    return tuple((name, name + RATE, name + ACCELERATION) for name in told)
