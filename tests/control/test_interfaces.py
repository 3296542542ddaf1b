"""The generated model in the hands of others: do-mpc, and acados' names."""

from __future__ import annotations

import casadi as ca
import numpy as np
import pytest
from numpy.testing import assert_allclose

from tmm_gen.control.acados import acados_fields
from tmm_gen.control.bench import Bench
from tmm_gen.reference.planar_arm import Arm


def test_acados_fields_of_the_discrete_model(small: Bench) -> None:
    fields = acados_fields(small.step)
    assert {"name", "x", "u", "p", "disc_dyn_expr", "x_labels", "u_labels"} <= set(fields)
    step = ca.Function("step", [fields["x"], fields["u"]], [fields["disc_dyn_expr"], fields["cost_y_expr"]])
    state = 0.1 * np.random.default_rng(0).standard_normal(small.step.size)
    after, angles = step(state, 0.7)
    assert_allclose(np.array(after), np.array(small.step.sample(state, [0.7, 0.7])), rtol=1e-14, atol=1e-15)
    assert float(angles[1]) == state[0]
    assert len(fields["x_labels"]) == small.step.size
    assert fields["x_labels"][0] == "hub_angle"


@pytest.mark.parametrize("gravity", [None, 9.81])
def test_acados_fields_of_the_continuous_model(swing, gravity: float | None) -> None:  # type: ignore[no-untyped-def]
    """The explicit right-hand side is that of Lagrange's equations."""
    changes = {"beam.links": 3, **({"model.gravity": gravity} if gravity else {})}
    bench = Bench.of(swing.replace(**changes))
    fields = acados_fields(bench.step, continuous=True)
    slope = ca.Function("f", [fields["x"], fields["u"]], [fields["f_expl_expr"]])
    random = np.random.default_rng(1)
    angles, rates = random.uniform(-0.5, 0.5, 4), random.uniform(-1.0, 1.0, 4)
    found = np.array(slope(np.concatenate([angles, rates]), 0.0)).ravel()
    arm = Arm(bench.step.scene, {})
    expected = arm.accelerations(np.zeros(1), angles[None], rates[None])[0]
    assert_allclose(found[:4], rates)
    assert_allclose(found[4:], expected, rtol=1e-9)
    implicit = ca.substitute(fields["f_impl_expr"], fields["xdot"], fields["f_expl_expr"])
    residual = ca.Function("g", [fields["x"], fields["u"]], [implicit])
    assert_allclose(np.array(residual(np.concatenate([angles, rates]), 0.3)), 0.0, atol=1e-12)


# do-mpc tells of its optional parts when it is imported
@pytest.mark.filterwarnings("ignore:The .* feature:UserWarning")
@pytest.mark.filterwarnings("ignore::FutureWarning")  # do-mpc calls NumPy on CasADi values
@pytest.mark.filterwarnings("ignore::SyntaxWarning")  # where no installer has compiled do-mpc before
def test_do_mpc_swings_the_arm(small: Bench) -> None:
    """The example of the documentation: do-mpc's controller with the generated step, a few samples long."""
    import do_mpc

    from tmm_gen.control.do_mpc import do_mpc_model

    model = do_mpc_model(small.step)
    state = 0.1 * np.random.default_rng(2).standard_normal(small.step.size)
    after = model._rhs_fun(state, 0.4, [], [], [], []) if hasattr(model, "_rhs_fun") else None
    if after is not None:
        assert_allclose(np.array(after), np.array(small.step.sample(state, [0.4, 0.4])), rtol=1e-13)
    mpc = do_mpc.controller.MPC(model)
    mpc.set_param(n_horizon=6, t_step=0.02, store_full_solution=False)
    mpc.settings.supress_ipopt_output()
    tip, torque = model.aux["tip"], model.u["hub_torque"]
    mpc.set_objective(mterm=(tip - 1.0) ** 2, lterm=(tip - 1.0) ** 2)
    mpc.set_rterm(hub_torque=1e-3)
    mpc.bounds["lower", "_u", "hub_torque"], mpc.bounds["upper", "_u", "hub_torque"] = -3.0, 3.0
    mpc.setup()
    assert torque.shape == (1, 1)
    mpc.x0 = small.step.straight(0.0)
    mpc.set_initial_guess()
    first = float(mpc.make_step(small.step.straight(0.0))[0, 0])
    assert 0.1 < first <= 3.0 + 1e-6
