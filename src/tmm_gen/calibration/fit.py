"""What a scene with changed numbers is off from a record."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tmm_gen.calibration.fitted_keys import changes, replaced, tried
from tmm_gen.errors import UserError
from tmm_gen.inputs.clock import from_start, refuse_what_is_unknown, spacing
from tmm_gen.inputs.signals import Signal, Table
from tmm_gen.native import NativeKernel, compile_kernel
from tmm_gen.native.series import Series
from tmm_gen.program.build import build_program
from tmm_gen.program.space.kernel_parameters import parameter_values
from tmm_gen.scene import Scene
from tmm_gen.scene.columns import output_columns
from tmm_gen.scene.model import FloatingBase
from tmm_gen.scene.problem import SceneError
from tmm_gen.simulate.prescribed import kernel_signals

Array = NDArray[np.float64]

MOST_STEPS = 100_000
"""Of one simulation; a fit takes some fifty of them."""

_DIVERGED = 1e3
"""What a motion that leaves all bounds is off, in the record's standard deviations."""

MAD = 1.4826
"""Standard deviation of a normal distribution over its median deviation."""


class Fit:
    """Simulates a scene with changed numbers, on one compiled kernel.

    Parameters
    ----------
    scene : Scene
        As it is.
    record : mapping from str to Signal
        Inputs and outputs by name, on one clock.
    keys : sequence of str
        Numbers that change; see :mod:`tmm_gen.calibration.fitted_keys`.
    given : array
        Their values in the scene.
    start : float
        Of the motion, on the clock of the record.
    robust : bool
        Whether single samples that are far off are kept out of the record's standard deviation.

    Raises
    ------
    UserError
        If nothing recorded is an output, clocks do not fit, or the record takes too many steps.
    """

    def __init__(
        self,
        scene: Scene,
        record: Mapping[str, Signal],
        keys: Sequence[str],
        given: Array,
        start: float,
        robust: bool,
    ) -> None:
        self.scene, self.keys, self.given = scene, keys, given
        # links and joints that are alike share a number in the kernel; those to be fitted apart must not, so each
        # key is changed by a factor of its own that makes no two numbers of a file alike by chance
        apart = {
            key: value * float(np.exp(1e-3 * np.sqrt(k + 2)))
            for k, (key, value) in enumerate(zip(keys, given, strict=True))
        }
        unlike = replaced(scene, changes(scene, apart))
        program = build_program(unlike)
        inputs, outputs = sorted_out(scene, record)
        self.start = start
        self.outputs = _after_start(from_start(outputs, self.start), scene, self.start)
        rows = spacing(self.outputs)
        self.until = rows.last
        signals = from_start(inputs, self.start)
        refuse_what_is_unknown(signals, self.until, min(rows.interval, self.until))
        step = scene.integrator.step
        steps = _steps(scene, self.until, step)
        self.scales = {name: _scale(table.values, robust) for name, table in self.outputs.items()}
        times = np.concatenate([table.times for table in self.outputs.values()])
        self.instants = np.unique(times, return_inverse=True)[1]
        self.times = step * np.arange(steps + 1)
        self.kernel: NativeKernel = compile_kernel(program, unlike)
        taken = {name: each.at for name, each in kernel_signals(unlike, signals).items()}
        self.series = Series(self.kernel, taken, steps, step)

    def remains(self, logarithms: Array) -> Array:
        """Return what the model is off at the recorded instants, relative to the record's standard deviation."""
        values = dict(zip(self.keys, (self.given * np.exp(logarithms)).tolist(), strict=True))
        try:
            known = parameters_of(tried(self.scene, changes(self.scene, values)))
            parameters = {
                v.name: known[v.name] if v.length or np.ndim(known[v.name]) == 0 else known[v.name][0]
                for v in self.kernel.program.parameters
            }
            found = self.series.run(parameters)
        except (ArithmeticError, SceneError):
            return np.full(len(self.instants), _DIVERGED)
        return np.concatenate(
            [
                (np.interp(table.times, self.times, found[name]) - table.values) / self.scales[name]
                for name, table in self.outputs.items()
            ]
        )


def sorted_out(scene: Scene, record: Mapping[str, Signal]) -> tuple[dict[str, Signal], dict[str, Table]]:
    """Return a record's inputs, and its outputs.

    Raises
    ------
    UserError
        If there is no output.
    """
    names = {item.name for item in scene.inputs}
    known = [column.name for column in output_columns(scene)]
    inputs = {name: record[name] for name in record if name in names}
    outputs = {name: column for name in known if isinstance(column := record.get(name), Table)}
    if not outputs:
        raise UserError(
            f"{scene.source.origin}: the record has none of the outputs {', '.join(known)}. Add a column."
        )
    return inputs, outputs


def _after_start(signals: Mapping[str, Signal], scene: Scene, start: float) -> dict[str, Table]:
    """Return tables without the rows before the start, where the scene says nothing.

    Raises
    ------
    UserError
        If none are left.
    """
    found = {}
    for name, signal in signals.items():
        assert isinstance(signal, Table)
        later = signal.times >= -1e-9
        if np.any(later):
            found[name] = Table(signal.times[later], signal.values[later])
    if not found:
        raise UserError(
            f"{scene.source.origin}: the record ends before --start {start:g}. Name an earlier time."
        )
    return found


def _steps(scene: Scene, until: float, step: float) -> int:
    """Return the steps to the end of the record.

    Raises
    ------
    UserError
        If they are too many.
    """
    if until / step > MOST_STEPS:
        raise UserError(
            f"{scene.source.origin}: the record lasts {until:g} s, {until / step:.3g} steps of {step:g} s; a fit takes "
            f"{MOST_STEPS} at most. If its clock does not count seconds, name its unit (--time-unit ms); else cut "
            "the record, or choose a longer integrator.step."
        )
    return int(np.ceil(until / step)) + 1


def _scale(values: Array, robust: bool) -> float:
    """Return the standard deviation of a record, single samples that are far off cut down where that is asked for."""
    if robust:
        middle = float(np.median(values))
        if reach := 5.0 * MAD * float(np.median(np.abs(values - middle))):
            values = np.clip(values, middle - reach, middle + reach)
    return float(np.std(values)) or 1.0


def parameters_of(scene: Scene) -> dict[str, Any]:
    """Return the physical parameters of a scene by their names in a kernel."""
    if scene.spatial is not None:
        return {
            name: values if len(values) > 1 else values[0]
            for name, values in parameter_values(scene.spatial).items()
        }
    joints, links = scene.joints, scene.links
    found: dict[str, Any] = {
        "stiffness": [joint.stiffness for joint in joints],
        "damping": [joint.damping for joint in joints],
        "rest": [joint.rest for joint in joints],
        "rotor_inertia": [joint.rotor_inertia for joint in joints],
        "gear": [joint.gear for joint in joints],
        "ratio": [joint.ratio for joint in joints],
        "inertia": [link.inertia for link in links],
        "mass": [link.mass for link in links],
        "length": [link.length for link in links],
        "center": [link.center for link in links],
        "gravity": scene.model.gravity or 0.0,
        "hub_inertia": scene.base.inertia,
        "hub_damping": scene.base.damping,
    }
    if isinstance(scene.base, FloatingBase):
        found["hub_mass"] = scene.base.mass
    if scene.tip is not None:
        found |= {"tip_mass": scene.tip.mass, "tip_inertia": scene.tip.inertia}
    return found
