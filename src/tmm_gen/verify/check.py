"""Checks of a scene: its backends against each other, and against the exact response."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tmm_gen.inputs.signals import Signal
from tmm_gen.native.python_module import casadi_module, jax_module, numpy_module
from tmm_gen.native.timing import by_turns
from tmm_gen.scene import Scene
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
from tmm_gen.verify.chain_order import chain_slope
from tmm_gen.verify.check_row import SLOPE, CheckRow
from tmm_gen.verify.host_test import run_host_test
from tmm_gen.verify.lasting import remedy
from tmm_gen.verify.planar_order import planar_slope
from tmm_gen.verify.spatial_order import spatial_slope
from tmm_gen.verify.unbroken import unless_broken
from tmm_gen.verify.whole_run import OF_RUN, WholeRun

ONE_STEP = {"float64": 1e-13, "float32": 2e-5}
"""Relative difference allowed between backends after one step, by the number type of the C code."""

PLANAR_STEP = {"float64": 1e-12, "float32": 2e-3}
"""The same for a planar arm, whose forces cancel where it is stiff."""

_SAID = 200
"""Characters shown of what a compiler or a test says."""


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
        Inputs of the run, by name; those not given are as :func:`~tmm_gen.verify.whole_run.unit_inputs` has them.
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
            random_vectors(program)
            if linear
            else reached_vectors(
                module, program, relative=relative, about=None if relative else near_slack(scene)
            )
        )
    )

    def one_step(name: str, other: Step, bound: float) -> CheckRow:
        check = f"numpy_against_{name}"
        return unless_broken(
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
    run = WholeRun.of(scene, module, kernel, loads or {})
    rows += run.rows()
    advance(0.3, "refining the step")
    slope = spatial_slope if scene.spatial is not None else chain_slope if linear else planar_slope
    rows.append(unless_broken(scene, "order_against_derived", SLOPE, lambda: slope(scene, module, facts)))
    advance(0.2, "done")
    causes = [row.why for row in sorted(rows, key=lambda row: row.check != OF_RUN) if row.why]
    why = ""
    if find_remedy and causes:

        def passes(other: Scene, factor: float) -> bool:
            report = check_scene(other, lambda share, doing: None, run.scaled(factor), find_remedy=False)
            return report.passed

        why = f"{causes[0]} {remedy(scene, run.duration, run.holds, passes)}"
    return CheckReport(tuple(rows), facts, why)


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


def near_slack(scene: Scene) -> NDArray[np.float64]:
    """Return angles of a planar arm's links for starts at random, (n,), rad: half the way to where springs are slack.

    From straight ahead springs that are slack elsewhere ask for more than long steps of some methods can solve, and
    where all are slack, motions are so small beside angles that single precision has no digits of them.
    """
    angles = [0.0]
    for number, joint in enumerate(scene.joints, start=1):
        angles.append(angles[scene.host(number)] + joint.rest)
    return 0.5 * np.array(angles[1:])
