"""The generated NumPy kernel as its users meet it."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from tmm_gen.scene import Scene

Generate = Callable[[Scene], Any]
Chain = Callable[..., Scene]


@pytest.fixture
def kernel(chain: Chain, generate: Generate) -> Any:
    return generate(chain()).kernel


def test_defaults_are_those_of_the_scene(kernel: Any) -> None:
    params = kernel.Params()
    assert (params.stiffness, params.damping) == ((20.0, 35.0, 15.0), (0.5, 0.2, 0.0))
    assert (kernel.STATIONS, kernel.STEP) == (3, 0.01)
    assert (kernel.INPUT_NAMES, kernel.OUTPUT_NAMES) == (("push",), ("tip", "held"))
    assert np.array_equal(kernel.prepare().admittance, kernel.prepare(kernel.Params(), 0.01).admittance)
    assert not kernel.initialise().acceleration.any()


def test_what_is_alike_everywhere_is_one_number(chain: Chain, generate: Generate) -> None:
    kernel = generate(chain(joints=[(20.0, 0.0)] * 3, links=[1.0] * 3)).kernel
    assert kernel.Params().stiffness == 20.0
    assert not hasattr(kernel.Params(), "damping")


def test_a_state_is_left_as_it_is(chain: Chain, generate: Generate) -> None:
    kernel = generate(chain(integrator="houbolt")).kernel
    model, state = kernel.prepare(), kernel.initialise(input=kernel.Input(push=1.0))
    for _ in range(4):
        held = [value.copy() for name, value in vars(state).items() if name != "steps_taken"]
        for name, value in vars(state).items():
            if name != "steps_taken":
                value.setflags(write=False)
        after = kernel.step(model, state, kernel.Input(push=1.0))
        now = [value for name, value in vars(state).items() if name != "steps_taken"]
        assert all(np.array_equal(a, b) for a, b in zip(held, now, strict=True))
        state = after


def test_start_up_steps_are_counted(chain: Chain, generate: Generate) -> None:
    kernel = generate(chain(integrator="houbolt")).kernel
    model, state = kernel.prepare(), kernel.initialise()
    assert len(kernel.STAGE_INSTANTS) == 3
    counts = []
    for _ in range(4):
        counts.append(state.steps_taken)
        state = kernel.step(model, state)
    assert counts == [0, 1, 2, 3]


def test_one_number_starts_all_stations(kernel: Any) -> None:
    assert np.array_equal(kernel.initialise(initial_angle=0.1).angle, [0.1] * 3)
    assert np.array_equal(kernel.initialise(initial_rate=[1, 2, 3]).rate, [1.0, 2.0, 3.0])


def test_the_start_is_in_equilibrium(kernel: Any) -> None:
    """I a = torque in, less torque out, with the joints' laws written out here."""
    angle, rate, push = np.array([0.1, -0.2, 0.4]), np.array([1.0, 0.5, -1.0]), 2.5
    state = kernel.initialise(input=kernel.Input(push=push), initial_angle=angle, initial_rate=rate)
    params = kernel.Params()
    torque = np.array(params.stiffness) * np.diff(angle, prepend=0.0)
    torque += np.array(params.damping) * np.diff(rate, prepend=0.0)
    expected = (np.append(torque[1:], push) - torque) / np.array(params.inertia)
    np.testing.assert_allclose(state.acceleration, expected, rtol=1e-14)


@pytest.mark.parametrize("value", [math.nan, math.inf, [math.nan, -math.inf]])
def test_inputs_that_are_not_finite_are_refused(kernel: Any, value: Any) -> None:
    model, state = kernel.prepare(), kernel.initialise()
    with pytest.raises(FloatingPointError, match="input push must be finite"):
        kernel.step(model, state, kernel.Input(push=value))
    with pytest.raises(FloatingPointError, match="input push must be finite"):
        kernel.initialise(input=kernel.Input(push=value))


def test_parameters_that_are_not_finite_are_refused(kernel: Any) -> None:
    with pytest.raises(FloatingPointError, match="stiffness must be finite"):
        kernel.prepare(kernel.Params(stiffness=math.nan))
    with pytest.raises(FloatingPointError, match="step must be finite"):
        kernel.prepare(step=math.inf)
    with pytest.raises(FloatingPointError, match="initial_angle must be finite"):
        kernel.initialise(initial_angle=math.nan)


def test_what_is_no_number_is_refused(kernel: Any) -> None:
    with pytest.raises(TypeError, match="stiffness must be numeric, not 'soft'"):
        kernel.prepare(kernel.Params(stiffness="soft"))


def test_arrays_of_another_number_of_stations_are_refused(kernel: Any) -> None:
    with pytest.raises(
        ValueError, match=r"inertia must have shape \(3, \*batch\), or be one number; it has shape"
    ):
        kernel.prepare(kernel.Params(inertia=[1.0, 2.0]))


def test_a_vanishing_pivot_names_station_and_remedy(kernel: Any) -> None:
    with pytest.raises(
        kernel.VanishingPivotError, match="pivot of station 2 must be positive and finite"
    ) as raised:
        kernel.prepare(kernel.Params(inertia=[1.0, -9.0, 0.5]))
    assert isinstance(raised.value, ArithmeticError)
    model = kernel.prepare(kernel.Params(inertia=np.array([[1.0, 1.0], [1.0, -9.0], [0.5, 0.5]])))
    good = kernel.prepare(kernel.Params(inertia=[1.0, 1.0, 0.5]))
    np.testing.assert_array_equal(model.admittance[:, 0], good.admittance)
    assert np.isnan(model.admittance[:, 1]).all()  # the other arm of the batch


@pytest.mark.parametrize("step", [0.0, -0.01, -math.inf])
def test_a_step_that_is_not_positive_is_refused(kernel: Any, step: float) -> None:
    with pytest.raises((ValueError, FloatingPointError), match="step must be"):
        kernel.prepare(step=step)


def test_a_motion_beyond_all_numbers_is_refused(kernel: Any) -> None:
    model, state = kernel.prepare(), kernel.initialise()
    with pytest.raises(FloatingPointError, match="outgrown"):
        kernel.step(model, dataclasses.replace(state, rate=np.array([1.7e308, -1.7e308, 0.0])))
    with pytest.raises(ArithmeticError, match="finite|too large"):
        kernel.prepare(step=1e300)


def test_a_vanishing_hub_pivot_is_told(chain: Chain, generate: Generate) -> None:
    kernel = generate(chain(base="motor")).kernel
    with pytest.raises(kernel.VanishingPivotError, match="hub_pivot must be positive"):
        kernel.prepare(kernel.Params(hub_inertia=-50.0))


def test_simulate_is_the_steps_it_says(kernel: Any) -> None:
    result = kernel.simulate(0.055, {"push": 2.0}, initial_rate=0.1)
    np.testing.assert_allclose(result.times, 0.01 * np.arange(6), rtol=1e-15)
    model = kernel.prepare()
    state = kernel.initialise(input=kernel.Input(push=2.0), initial_rate=0.1)
    for index in range(6):
        assert result.outputs["tip"][index] == kernel.output(model, state).tip
        assert result.outputs["held"][index] == kernel.output(model, state).held
        state = kernel.step(model, state, kernel.Input(push=2.0))
    assert result.state.angle.shape == (3,)


@pytest.mark.parametrize("integrator", ["newmark", "generalized_alpha", "bathe", "sdirk4", "houbolt"])
def test_simulate_reads_inputs_at_the_instants_of_the_stages(
    integrator: str, chain: Chain, generate: Generate
) -> None:
    kernel = generate(chain(integrator=integrator)).kernel
    asked: list[float] = []

    def push(time: float) -> float:
        asked.append(time)
        return math.sin(time)

    kernel.simulate(0.2, {"push": push}, step=0.1)
    first, second = kernel.STAGE_INSTANTS[0], kernel.STAGE_INSTANTS[min(1, len(kernel.STAGE_INSTANTS) - 1)]
    expected = [0.0, *(0.1 * at for at in first), *(0.1 + 0.1 * at for at in second)]
    assert asked == pytest.approx(expected, abs=1e-15)


def test_inputs_at_stages_are_seen(chain: Chain, generate: Generate) -> None:
    kernel = generate(chain(integrator="sdirk4")).kernel
    model, state = kernel.prepare(), kernel.initialise()
    held = kernel.step(model, state, kernel.Input(push=1.0))
    same = kernel.step(model, state, [kernel.Input(push=1.0)] * 5)
    assert np.array_equal(held.angle, same.angle)
    for stage in range(5):
        inputs = [kernel.Input(push=1.0 + (k == stage)) for k in range(5)]
        assert not np.array_equal(held.angle, kernel.step(model, state, inputs).angle), stage
    with pytest.raises(ValueError, match="for each of 5 stages; there are 2"):
        kernel.step(model, state, [kernel.Input()] * 2)


def test_misuse_of_simulate_is_told(kernel: Any) -> None:
    with pytest.raises(ValueError, match="no input is named pull; there are: push"):
        kernel.simulate(1.0, {"pull": 1.0})
    for step in (0.0, -0.1, math.nan, [0.1, 0.2]):
        with pytest.raises(ValueError, match="step must be one positive number"):
            kernel.simulate(1.0, step=step)
    for duration in (-1.0, math.inf, math.nan):
        with pytest.raises(ValueError, match="duration must be a time"):
            kernel.simulate(duration)
    assert kernel.simulate(0.0).times.shape == (1,)


def test_names_that_the_kernel_uses_itself_are_no_trouble(chain: Chain, generate: Generate) -> None:
    names = ["model", "batch", "bias", "solved", "dtype"]
    inputs = [(names[0], "tip", "torque"), (names[1], 1, "torque"), (names[2], 2, "torque")]
    outputs = [("range", "tip", "angle"), ("numbers", 1, "torque")]
    plain = [("in1", "tip", "torque"), ("in2", 1, "torque"), ("in3", 2, "torque")]
    odd, even = generate(chain(inputs=inputs, outputs=outputs)), generate(chain(inputs=plain))
    values = dict(zip(names, (1.0, 2.0, -0.5), strict=False))
    found = odd.kernel.simulate(0.1, values)
    expected = even.kernel.simulate(0.1, dict(zip(("in1", "in2", "in3"), values.values(), strict=True)))
    assert np.array_equal(found.outputs["range"], expected.outputs["tip"])
    u = np.array(list(values.values()))
    x = np.random.default_rng(1).normal(size=9)
    advanced = [
        g.casadi.step_function()(x=x, u=u, p=g.casadi.default_parameters())["x_next"] for g in (odd, even)
    ]
    assert np.array_equal(np.array(advanced[0]), np.array(advanced[1]))
