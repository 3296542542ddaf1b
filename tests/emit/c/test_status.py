"""What kernels refuse, and how they say it."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from tmm_gen.native import NonFiniteStateError
from tmm_gen.program.evaluate import VanishingPivotError

pytestmark = pytest.mark.compiler
BAD = [math.nan, math.inf, -math.inf]


@pytest.fixture(scope="module", params=["float64", "float32"])
def kernel(request: Any, chain: Any) -> Any:
    of = chain(base="motor", inner=True, real=request.param, integrator="sdirk2")
    made = of.kernel
    made.initialise()
    return made


def repeat(kernel: Any, steps: int, inputs: dict[str, float] | None = None) -> None:
    for _ in range(steps):
        kernel.step(inputs)


@pytest.mark.parametrize("bad", BAD)
def test_bad_inputs_leave_the_state_alone(kernel: Any, bad: float) -> None:
    kernel.step({"hub_torque": 1.0, "tip_torque": -0.5})
    before = kernel.state
    for name in ("hub_torque", "inner_torque", "tip_torque"):
        for value in (bad, [1.0, bad]):
            with pytest.raises(FloatingPointError, match="argument is not finite"):
                kernel.step({name: value})
    assert all(np.array_equal(before[name], kernel.state[name]) for name in before)


@pytest.mark.parametrize("bad", BAD)
def test_bad_starts_leave_the_state_alone(kernel: Any, bad: float) -> None:
    before = kernel.state
    arguments: list[dict[str, Any]] = [
        {"inputs": {"tip_torque": bad}},
        {"initial_angle": [0.0, 0.0, 0.0, bad]},
        {"initial_rate": [bad, 0.0, 0.0, 0.0]},
    ]
    for given in arguments:
        with pytest.raises(FloatingPointError, match="argument is not finite"):
            kernel.initialise(**given)
    assert all(np.array_equal(before[name], kernel.state[name]) for name in before)


@pytest.mark.parametrize("bad", BAD)
@pytest.mark.parametrize("name", ["stiffness", "damping", "inertia", "hub_inertia", "hub_damping"])
def test_bad_parameters(kernel: Any, name: str, bad: float) -> None:
    value = bad if name.startswith("hub") else [1.0, 1.0, 1.0, bad]
    with pytest.raises(FloatingPointError, match="argument is not finite"):
        kernel.prepare({name: value})
    kernel.prepare()


@pytest.mark.parametrize("bad", [*BAD, 0.0, -0.01])
def test_bad_steps(kernel: Any, bad: float) -> None:
    with pytest.raises(ValueError, match="positive number"):
        kernel.prepare(step=bad)
    kernel.prepare()


@pytest.mark.parametrize(
    "params",
    [
        {"inertia": -1.0},
        {"inertia": 0.0, "stiffness": 0.0, "damping": 0.0},
        {"stiffness": [30.0, 30.0, 30.0, -1e9]},
        {"hub_inertia": -1e6},
    ],
    ids=str,
)
def test_vanishing_pivots(kernel: Any, params: dict[str, Any]) -> None:
    with pytest.raises(VanishingPivotError, match="pivot"):
        kernel.prepare(params)
    kernel.prepare()


def test_overflow_is_noticed(kernel: Any) -> None:
    """Finite inputs, but more than the type can hold after some steps: not a NaN in the state unnoticed."""
    largest = 3e38 if kernel.real == "float32" else 1.5e308
    kernel.initialise()
    with pytest.raises(NonFiniteStateError):
        repeat(kernel, 200, {"hub_torque": largest, "tip_torque": -largest})
    kernel.initialise()
    kernel.step()


@pytest.mark.parametrize(
    "kind",
    [
        {"base": "motor", "inner": True},
        {"integrator": "newmark", "parameters": "beta = 0.0", "damped": False},
        {"integrator": "zhai", "base": "motor", "damped": False},
        {"integrator": "houbolt", "base": "prescribed"},
        {"integrator": "sdirk4"},
        {"sweep": "product", "base": "motor"},
    ],
    ids=lambda kind: "-".join(map(str, kind.values())),
)
@pytest.mark.parametrize("bad", BAD)
def test_no_bad_number_hides_in_the_state(kind: dict[str, Any], bad: float, chain: Any) -> None:
    """Wherever one is put, the step that computes with it says so; what no step reads is overwritten."""
    of = chain(**kind)
    kernel = of.kernel
    noticed = 0
    for variable in of.program.state:
        for place in range(variable.length or 1):
            kernel.initialise()
            value = np.zeros(variable.length or 1)
            value[place] = bad
            started = {"start_steps_taken": len(of.program.startup)} if of.program.startup else {}
            kernel.state = {variable.name: value if variable.length else bad, **started}
            try:
                repeat(kernel, 1 + len(of.program.startup))  # older history may be copied first
            except NonFiniteStateError:
                noticed += 1
            else:
                assert np.isfinite(np.hstack([*kernel.state.values()])).all()
    assert noticed >= 2 * of.stations  # angles and rates are always read
