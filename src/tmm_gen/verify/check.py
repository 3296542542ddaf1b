"""Checks of a scene: its backends against each other, and against the exact response."""

from __future__ import annotations

import inspect
import math
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass
from functools import cached_property
from types import ModuleType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tmm_gen.errors import CheckFailed
from tmm_gen.inputs.signals import Constant, Signal, Sine
from tmm_gen.native.python_module import casadi_module, jax_module, numpy_module
from tmm_gen.native.timing import by_turns
from tmm_gen.reference.duration import default_duration
from tmm_gen.reference.frequency import fastest_mode
from tmm_gen.reference.reference import exact_response
from tmm_gen.scene import Input, Scene
from tmm_gen.simulate.divergence import BrokenOffError
from tmm_gen.simulate.metrics import convergence_slope, largest_error, rms_error
from tmm_gen.simulate.run import simulate
from tmm_gen.simulate.simulation import Simulation
from tmm_gen.verify.agreement import (
    Step,
    Vector,
    casadi_step,
    jax_step,
    largest_difference,
    native_step,
    numpy_step,
    random_vectors,
    reached_vectors,
)
from tmm_gen.verify.check_row import CheckRow
from tmm_gen.verify.host_test import run_host_test
from tmm_gen.verify.lasting import broken_off, remedy, too_coarse
from tmm_gen.verify.planar_order import planar_slope
from tmm_gen.verify.spatial_order import spatial_slope, swings, turned_alike

Array = NDArray[np.float64]

ONE_STEP = {"float64": 1e-13, "float32": 2e-5}
"""Relative difference allowed between backends after one step, by the number type of the C code."""

PLANAR_STEP = {"float64": 1e-12, "float32": 2e-3}
"""The same for a planar arm, whose forces cancel where it is stiff."""

RUN = {"float64": 1e-9, "float32": 1e-3}
"""The same over a whole run, in which differences add up."""

ERROR = 0.05
"""RMS error over a run, relative to the peak, beyond which a step is too coarse for its scene."""

SLOPE = 0.1
"""How far the fitted order may be from the derived one."""

_LONGEST_RUN = 2000
"""Steps of a run, unless one slow period takes fewer."""

_SWING = 2.0
"""rad/s of a prescribed base."""

_OF_RUN = "error_against_exact"
"""The comparison whose cause says most where several have one."""

_SAID = 200
"""Characters shown of what a compiler or a test says."""

_STEPS = (64, 128, 256, 512)
_TURN = 0.2
"""Highest natural frequency, or decay rate, times the coarsest step of the slope."""


@dataclass(frozen=True)
class CheckReport:
    """All comparisons of a scene.

    Parameters
    ----------
    rows : tuple of CheckRow
        In the order in which they were made.
    facts : dict from str to object
        Further figures by key: ``ns_per_step``, ``ns_spread``, ``operations_per_step``, ``fitted_order``,
        ``derived_order``.
    why : str
        The cause where the motion breaks off or errs too much, and a step with which everything holds or that none
        was found; empty otherwise.
    """

    rows: tuple[CheckRow, ...]
    facts: Mapping[str, object]
    why: str = ""

    @property
    def passed(self) -> bool:
        """Whether every value is within its bound."""
        return all(row.passed for row in self.rows)


def check_scene(
    scene: Scene,
    advance: Callable[[float, str], None],
    loads: Mapping[str, Signal] | None = None,
    *,
    find_remedy: bool = True,
) -> CheckReport:
    """Compile and compare every backend of a scene.

    Parameters
    ----------
    scene : Scene
        Of any kind.
    advance : callable
        Called with the share of the work that is done and what comes next.
    loads : mapping from str to Signal, optional
        Inputs of the run, by name; those not given are as :func:`unit_inputs` has them.
    find_remedy : bool
        Whether to look for a step or inputs with which everything holds, where the motion breaks off or errs too much.

    Raises
    ------
    UserError
        If the scene asks for something that does not exist, or there is no C compiler.
    """
    from tmm_gen.native import compile_kernel
    from tmm_gen.program.build import build_program
    from tmm_gen.program.count import count_routine

    backends, real = scene.emit.backends, scene.emit.real
    linear = scene.model.linear
    program = build_program(scene)
    facts: dict[str, object] = {"operations_per_step": count_routine(program.main).total}
    module = numpy_module(scene, program)
    reference = numpy_step(module, program)
    allowed = ONE_STEP if linear else PLANAR_STEP
    relative = scene.spatial is not None
    vectors = _Vectors(
        lambda: list(
            random_vectors(program) if linear else reached_vectors(module, program, relative=relative)
        )
    )

    def one_step(name: str, other: Step, bound: float) -> CheckRow:
        check = f"numpy_against_{name}"
        return _unless_broken(
            scene, check, bound, lambda: _one_step(check, reference, other, vectors.all, bound)
        )

    rows: list[CheckRow] = []
    kernel = None
    if "c" in backends:
        advance(0.1, "compiling the C")
        rows.append(_host_test(program, scene))
        kernel = compile_kernel(program, scene)
        rows.append(one_step("c", native_step(kernel, program), allowed[real]))
        with suppress(ArithmeticError):  # said by the other rows
            cost = by_turns({"c": kernel.timer()})["c"]
            facts |= {"ns_per_step": cost.ns_per_step, "ns_spread": cost.spread}
    if "casadi" in backends:
        advance(0.2, "building the CasADi model")
        step = casadi_step(casadi_module(scene, program), program)
        rows.append(one_step("casadi", step, allowed["float64"]))
    if "jax" in backends:
        advance(0.0, "compiling the JAX kernel")
        rows.append(one_step("jax", jax_step(jax_module(scene, program), program), allowed["float64"]))
    advance(0.2, "simulating")
    run = _Run.of(scene, module, kernel, loads or {})
    rows += run.rows()
    advance(0.3, "refining the step")
    slope = spatial_slope if scene.spatial is not None else _slope if linear else planar_slope
    rows.append(_unless_broken(scene, "order_against_derived", SLOPE, lambda: slope(scene, module, facts)))
    advance(0.2, "done")
    causes = [row.why for row in sorted(rows, key=lambda row: row.check != _OF_RUN) if row.why]
    why = ""
    if find_remedy and causes:

        def passes(other: Scene, factor: float) -> bool:
            report = check_scene(other, lambda share, doing: None, run.scaled(factor), find_remedy=False)
            return report.passed

        why = f"{causes[0]} {remedy(scene, run.duration, run.holds, passes)}"
    return CheckReport(tuple(rows), facts, why)


_BREAKS = (CheckFailed, BrokenOffError, ArithmeticError, np.linalg.LinAlgError)
"""What ends a motion that does not last."""


def _unless_broken(scene: Scene, check: str, bound: float, compare: Callable[[], CheckRow]) -> CheckRow:
    """Return a comparison, or why it broke off."""
    try:
        return compare()
    except _BREAKS as error:
        return CheckRow(check, math.inf, bound, "broke off", broken_off(scene, error))


@dataclass(frozen=True)
class _Vectors:
    """States to step from, found when they are asked for."""

    find: Callable[[], list[Vector]]

    @cached_property
    def all(self) -> list[Vector]:
        """All of them; raises what kernels raise where they cannot be reached."""
        return self.find()


def _host_test(program: Any, scene: Scene) -> CheckRow:
    failures, said = run_host_test(program, scene)
    if len(said) > _SAID:
        said = f"{said[:_SAID].rsplit(' ', 1)[0]} ..."
    return CheckRow(
        "c_host_test",
        failures,
        0,
        f"the generated C compiles without a warning and passes its own test ({said})",
    )


def _one_step(check: str, one: Step, other: Step, vectors: list[Vector], bound: float) -> CheckRow:
    return CheckRow(
        check,
        largest_difference(one, other, vectors),
        bound,
        f"largest relative difference after one step from {len(vectors)} random states",
    )


def unit_inputs(scene: Scene) -> dict[str, Signal]:
    """Return a constant 1 for every input, of motors at the joint; a prescribed base swings from there.

    What an arm in space can bear differs by decades from joint to joint: there, inputs are as large as it is heavy.
    """
    if scene.spatial is not None:
        return swings(scene.spatial)
    swing = Sine(1.0, _SWING, math.pi / 2.0)
    return {i.name: swing if i.acts == "angle" else Constant(_unit(scene, i)) for i in scene.inputs}


def _unit(scene: Scene, item: Input) -> float:
    drives = item.acts == "drive" and isinstance(item.at, int)
    return 1.0 / scene.joints[int(item.at) - 1].gear if drives else 1.0


def _at_base_angle(scene: Scene) -> Scene:
    """Return a scene whose links stand along a prescribed base at the start."""
    if not scene.prescribed:
        return scene
    return scene.replace(initial={"angles": 1.0, "rates": 0.0})


@dataclass(frozen=True, eq=False)
class _Run:
    """A run, to be compared with the exact response and with the same run in C."""

    scene: Scene
    loads: Mapping[str, Signal]
    duration: float
    module: ModuleType
    kernel: Any

    @classmethod
    def of(cls, scene: Scene, module: ModuleType, kernel: Any, loads: Mapping[str, Signal]) -> _Run:
        """Return the run of a scene; kernels are made anew where they start elsewhere by themselves."""
        duration = min(default_duration(scene) / 5, _LONGEST_RUN * scene.integrator.step)
        started = _at_base_angle(scene)
        if started is not scene:
            from tmm_gen.native import compile_kernel
            from tmm_gen.program.build import build_program

            program = build_program(started)
            module = numpy_module(started, program)
            kernel = compile_kernel(program, started) if kernel is not None else None
        return cls(started, {**unit_inputs(scene), **loads}, duration, module, kernel)

    @property
    def _told(self) -> str:
        if self.loads != unit_inputs(self.scene):
            return "the inputs given"
        return "sines as large as the arm is heavy" if self.scene.spatial is not None else "unit inputs"

    def rows(self) -> list[CheckRow]:
        """Return both comparisons; the first alone where there is nothing to compare C with."""
        try:
            found, exact, scale = self._compared(self.scene, self.loads)
        except _BREAKS as error:
            why = broken_off(self.scene, error)
            return [CheckRow(_OF_RUN, math.inf, ERROR, "the run broke off", why)]
        worst = max(exact, key=lambda name: rms_error(found.outputs[name], exact[name], scale[name]))
        apart = rms_error(found.outputs[worst], exact[worst], scale[worst])
        rows = [
            CheckRow(
                _OF_RUN,
                apart,
                ERROR,
                f"RMS error of {worst} over {found.time[-1]:.3g} s under {self._told}, relative to its peak",
                "" if apart <= ERROR else too_coarse(self.scene),
            )
        ]
        if self.kernel is None:
            return rows
        check, bound = "c_run_against_numpy", RUN[self.scene.emit.real]
        return [
            *rows,
            _unless_broken(self.scene, check, bound, lambda: self._native(check, bound, found, scale)),
        ]

    def scaled(self, factor: float) -> dict[str, Signal]:
        """Return the loads, forces and torques multiplied by a factor where they are constant."""
        angles = {item.name for item in self.scene.inputs if item.acts == "angle"}
        return {
            name: Constant(factor * signal.value)
            if isinstance(signal, Constant) and name not in angles
            else signal
            for name, signal in self.loads.items()
        }

    def holds(self, other: Scene, factor: float) -> bool:
        """Whether a run of the same duration with another step is near the exact response, loads being scaled."""
        scene = self.scene.replace(**{"integrator.step": other.integrator.step})
        try:
            found, exact, scale = self._compared(scene, self.scaled(factor))
        except _BREAKS:
            return False
        return all(rms_error(found.outputs[name], exact[name], scale[name]) <= ERROR for name in exact)

    def _compared(
        self, scene: Scene, loads: Mapping[str, Signal]
    ) -> tuple[Simulation, dict[str, Array], dict[str, float]]:
        """Return a run, the exact outputs at its instants, and the peaks of these."""
        found = simulate(scene, loads, self.duration, kernel=self.module, judge=False)
        exact = exact_response(scene, loads, found.time)
        if scene.spatial is not None:
            exact = turned_alike(scene.spatial, exact, found.outputs)
        return found, exact, {name: float(np.max(np.abs(values))) or 1.0 for name, values in exact.items()}

    def _native(self, check: str, bound: float, found: Simulation, scale: Mapping[str, float]) -> CheckRow:
        native = simulate(self.scene, self.loads, self.duration, "c", kernel=self.kernel, judge=False)
        return CheckRow(
            check,
            max(largest_error(native.outputs[k], found.outputs[k], scale[k]) for k in scale),
            bound,
            f"largest difference over the same {found.steps} steps, relative to the peak",
        )


def _slope(scene: Scene, module: ModuleType, facts: dict[str, object]) -> CheckRow:
    """Fit the order of convergence of the tip angle under unit inputs, the links moving from the start."""
    from tmm_gen.derive.integrators.order import order
    from tmm_gen.derive.integrators.registry import integrator

    derived = order(integrator(scene.integrator.name, **scene.integrator.parameters))
    mode = fastest_mode(scene)
    coarsest = _TURN / (mode.frequency * max(1.0, 2.0 * mode.damping_ratio))
    tip = [{"name": "tip_angle", "at": "tip", "of": "angle"}]
    moving = scene.replace(**{"output": tip, "initial": {"angles": 0.0, "rates": 1.0}})
    times: Array = coarsest * np.arange(1, _STEPS[0] + 1, dtype=float)
    held = {item.name: Constant(1.0) for item in scene.inputs}
    exact = exact_response(moving, held, times)["tip_angle"]
    errors = []
    for steps in _STEPS:
        stride = steps // _STEPS[0]
        found = _moving_tip(module, scene, coarsest / stride, steps)
        errors.append(largest_error(found[stride - 1 :: stride], exact, float(np.max(np.abs(exact)))))
    fitted = convergence_slope([1.0 / steps for steps in _STEPS], errors).order
    facts |= {"fitted_order": fitted, "derived_order": derived}
    return CheckRow(
        "order_against_derived",
        abs(fitted - derived),
        SLOPE,
        f"error goes with step^{fitted:.3f}, fitted on {len(_STEPS)} steps from {coarsest:.2g} s down; "
        f"derived: step^{derived}",
    )


def _moving_tip(module: ModuleType, scene: Scene, step: float, steps: int) -> Array:
    """Return the tip angle after each step under unit inputs, all links turning at 1 rad/s at first."""
    given = module.Input(**{item.name: 1.0 for item in scene.inputs})
    start = {"initial_angle": 0.0, "initial_rate": 1.0}
    if "step" in inspect.signature(module.initialise).parameters:
        start["step"] = step
    model, state = module.prepare(step=step), module.initialise(module.Params(), given, **start)
    tip = np.empty(steps)
    for index in range(steps):
        state = module.step(model, state, given)
        tip[index] = state.angle[-1] + getattr(state, "turned", 0.0)
    return tip
