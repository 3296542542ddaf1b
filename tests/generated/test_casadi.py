"""The generated CasADi functions as their users meet them."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import casadi as ca
import numpy as np
import pytest

from tmm_gen.scene import Scene

Generate = Callable[[Scene], Any]
Chain = Callable[..., Scene]


def test_arguments_are_named_and_flat(chain: Chain, generate: Generate) -> None:
    outputs = [("tip", "tip", "angle"), ("hub", "base", "angle")]
    model = generate(chain(base="motor", integrator="houbolt", outputs=outputs)).casadi
    step = model.step_function()
    assert (step.name_in(), step.name_out()) == (["x", "u", "p"], ["x_next", "y"])
    assert model.STATE_NAMES[:2] == ("hub_angle", "hub_rate")
    assert "angle_3" in model.STATE_NAMES
    assert "angle_1_ago_3" in model.STATE_NAMES
    assert (model.INPUT_NAMES, model.OUTPUT_NAMES) == (("push",), ("tip", "hub"))
    assert model.PARAMETER_NAMES[:4] == ("step", "stiffness_1", "stiffness_2", "stiffness_3")
    sizes = [step.size1_in(name) for name in ("x", "u", "p")] + [
        step.size1_out(name) for name in ("x_next", "y")
    ]
    assert sizes == [len(model.STATE_NAMES), 1, len(model.PARAMETER_NAMES), len(model.STATE_NAMES), 2]
    values = dict(zip(model.PARAMETER_NAMES, np.array(model.default_parameters()).ravel(), strict=True))
    assert (values["step"], values["stiffness_2"], values["hub_inertia"]) == (0.01, 35.0, 0.7)
    assert len(set(model.STATE_NAMES)) == len(model.STATE_NAMES)
    assert model.initial_function().name_in() == ["initial_angle", "initial_rate", "u", "p"]


@pytest.mark.parametrize("integrator", ["newmark", "houbolt", "sdirk4"])
def test_the_first_steps_are_those_of_numpy(integrator: str, chain: Chain, generate: Generate) -> None:
    generated = generate(chain(base="motor", integrator=integrator))
    model, kernel = generated.casadi, generated.kernel
    p = model.default_parameters()
    x = model.initial_function()(0.1, 0.0, 1.5, p)
    functions = [*model.start_functions(), model.step_function(), model.step_function()]
    assert len(model.start_functions()) == len(kernel.STAGE_INSTANTS) - 1
    expected = kernel.simulate(len(functions) * 0.01, {"push": 1.5}, initial_angle=0.1).outputs
    for index, function in enumerate(functions):
        x_next, y = function(x, 1.5, p)
        assert np.array(y).ravel() == pytest.approx(
            [expected["tip"][index], expected["held"][index]], rel=1e-14
        )
        x = x_next


def test_inputs_may_be_held_or_given_for_each_stage(chain: Chain, generate: Generate) -> None:
    model = generate(chain(integrator="bathe")).casadi
    held, staged = model.step_function(), model.step_function(held=False)
    assert (held.size_in("u"), staged.size_in("u")) == ((1, 1), (1, 2))
    x, p = np.random.default_rng(2).normal(size=held.size1_in("x")), model.default_parameters()
    assert np.array_equal(np.array(held(x, 2.0, p)[0]), np.array(staged(x, ca.DM([[2.0, 2.0]]), p)[0]))
    assert not np.array_equal(np.array(held(x, 2.0, p)[0]), np.array(staged(x, ca.DM([[2.0, 1.0]]), p)[0]))


def test_a_scene_without_inputs(chain: Chain, generate: Generate) -> None:
    for integrator in ("newmark", "bathe"):
        generated = generate(chain(inputs=[], integrator=integrator))
        step = generated.casadi.step_function()
        assert step.size1_in("u") == 0
        x = np.random.default_rng(2).normal(size=step.size1_in("x"))
        state = generated.kernel.State(angle=x[:3], rate=x[3:6], acceleration=x[6:])
        after = generated.kernel.step(generated.kernel.prepare(), state)
        found = np.array(step(x, ca.DM.zeros(0, 1), generated.casadi.default_parameters())[0]).ravel()
        assert np.array_equal(found, np.concatenate([after.angle, after.rate, after.acceleration]))


def test_the_step_is_linear_and_its_derivative_the_difference(chain: Chain, generate: Generate) -> None:
    model = generate(chain()).casadi
    step, p = model.step_function(), model.default_parameters()
    x, u = ca.SX.sym("x", step.size1_in("x")), ca.SX.sym("u", 1)
    x_next = step(x, u, p)[0]
    derivative = ca.Function("d", [x, u], [ca.jacobian(x_next, x), ca.jacobian(x_next, u)])
    a, b = (np.array(matrix) for matrix in derivative(0.0, 0.0))
    point = np.random.default_rng(3).normal(size=a.shape[0])
    expected = a @ point + b[:, 0] * 0.7
    np.testing.assert_allclose(np.array(step(point, 0.7, p)[0]).ravel(), expected, rtol=1e-12, atol=1e-12)


def test_casadi_simplifies_again_afterwards(chain: Chain, generate: Generate) -> None:
    assert ca.GlobalOptions.getSimplificationOnTheFly()
    generate(chain()).casadi.step_function()
    assert ca.GlobalOptions.getSimplificationOnTheFly()
