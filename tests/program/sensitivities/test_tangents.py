"""Sensitivities by the sweep's own factors against CasADi's derivatives and finite differences."""

from __future__ import annotations

from typing import Any

import casadi as ca
import numpy as np
import pytest
from support.native_sensitivities import NativeSensitivities

from tmm_gen.emit.c import emit_kernel
from tmm_gen.emit.c.lower import lower
from tmm_gen.emit.c.reached import Reached
from tmm_gen.errors import UserError
from tmm_gen.native import compile_kernel
from tmm_gen.program.build import build_program
from tmm_gen.program.count import count_routine
from tmm_gen.program.evaluate import allocate, execute, key
from tmm_gen.program.statements import Loop
from tmm_gen.resources import scenes_dir
from tmm_gen.scene import load_scene, parse_scene

EXACT = 1e-11
FLAGS = ("-O1", "-ffp-contract=off")


def relative(found: np.ndarray, right: np.ndarray) -> float:
    """Return the largest error of any column, relative to its largest entry; columns of mere rounding are zero."""
    if right.size == 0:
        return 0.0
    scale = np.maximum(np.abs(right).max(axis=0), 1e-9 * np.abs(right).max())
    return float((np.abs(found - right).max(axis=0) / scale).max())


@pytest.mark.compiler
def test_emitted_c_has_casadis_derivatives(case: Any) -> None:
    kernel = case.native
    nx, nu = len(case.x), len(case.u)
    after, found = kernel.step(case.x, case.u, np.eye(nx, nx + nu), np.eye(nu, nx + nu, k=nx))
    assert np.allclose(after, case.x_next, rtol=1e-12, atol=1e-12 * np.abs(case.x_next).max())
    assert relative(found[:, :nx], case.a) < EXACT
    assert relative(found[:, nx:], case.b) < EXACT


@pytest.mark.compiler
@pytest.mark.parametrize("case", ["in space"], indirect=True)
def test_gathered_slopes_carry_what_the_sweep_does(case: Any) -> None:
    """A gear on a branch, whose shaft and joint are told apart by what each is found to do."""
    _carries(case)


@pytest.mark.compiler
def test_directions_leave_out_what_they_do_not_reach(without_branch: Any) -> None:
    """Without a branch walks begin where a direction does, one of a loop's two links too: each direction by itself."""
    case = without_branch
    assert case.program.sensitivities is not None
    lowered = lower(case.program).sensitivities
    assert lowered is not None
    late = [s for s in lowered.tangent.sections if isinstance(s, Reached)]
    assert [[v.name for v in s.follows] for s in late] == [
        ["d_predicted_angle", "d_predicted_rate"],
        ["d_predicted_angle"],
    ]
    assert any(isinstance(loop, Loop) and loop.stride > 1 for s in late for loop in s.statements)
    kernel, nx, nu = case.native, len(case.x), len(case.u)
    for k in range(nx + nu):
        dx, du = np.eye(nx, nx + nu)[:, [k]], np.eye(nu, nx + nu, k=nx)[:, [k]]
        found = kernel.step(case.x, case.u, dx, du)[1]
        assert relative(found, case.a @ dx + case.b @ du) < EXACT, k
    _carries(case)


def _carries(case: Any) -> None:
    """Show that gathered slopes carry every direction, and sums of them, as CasADi's derivatives do."""
    kernel, nx, nu = case.native, len(case.x), len(case.u)
    found = kernel.carried(case.x, case.u, np.eye(nx, nx + nu), np.eye(nu, nx + nu, k=nx))
    assert relative(found[:, :nx], case.a) < EXACT
    assert relative(found[:, nx:], case.b) < EXACT
    random = np.random.default_rng(6)
    dx, du = random.normal(size=(nx, 11)), random.normal(size=(nu, 11))
    assert relative(kernel.carried(case.x, case.u, dx, du), case.a @ dx + case.b @ du) < EXACT


def test_slopes_are_gathered_of_steps_that_follow_less_than_their_state(case: Any) -> None:
    """Only in space, where a direction takes more than a step; and of one stage, on a base that rests."""
    assert (case.program.sensitivities.reduced is not None) == (case.scene.name == "in_space")


@pytest.mark.compiler
@pytest.mark.parametrize("case", ["arm2", "chain", "two iterations"], indirect=True)
def test_the_linearised_step_is_the_step_to_the_last_bit(case: Any) -> None:
    plain = compile_kernel(case.program, case.scene, flags=FLAGS)
    plain.prepare()
    start, state = 0, {}
    for variable in case.program.state:
        stop = start + (variable.length or 1)
        state[variable.name] = case.x[start:stop] if variable.length else float(case.x[start])
        start = stop
    plain.state = state
    acting, start = {}, 0
    for variable in case.program.inputs:
        stop = start + (variable.length or 1)
        acting[variable.name] = case.u[start:stop] if variable.length else float(case.u[start])
        start = stop
    plain.step(acting)
    right = np.concatenate([np.ravel(plain.state[v.name]) for v in case.program.state])
    after, _ = case.native.step(case.x, case.u, np.zeros((len(case.x), 1)), np.zeros((len(case.u), 1)))
    assert np.array_equal(after, right)


def test_the_interpreter_has_casadis_derivatives(case: Any) -> None:
    """What no printer has touched, along one random direction."""
    program = case.program
    found = program.sensitivities
    values = allocate(
        (
            program.step,
            *program.parameters,
            *program.coefficients,
            *program.state,
            *program.inputs,
            *found.point,
        ),
        float,
    )
    execute(program.prepare, values)
    _fill(values, program.state, case.x)
    _fill(values, program.inputs, case.u)
    execute(found.linearise, values)
    random = np.random.default_rng(8)
    dx, du = random.normal(size=len(case.x)), random.normal(size=len(case.u))
    _fill(values, found.state, dx)
    _fill(values, found.inputs, du)
    execute(found.tangent, values)
    carried = np.concatenate([np.ravel(values[key(v)]) for v in found.state])
    right = case.a @ dx + case.b @ du
    assert np.abs(carried - right).max() < EXACT * np.abs(right).max()


def test_casadi_functions_of_the_sweep_have_casadis_derivatives(case: Any) -> None:
    """Of inputs held over all stages of a step, whose derivatives CasADi takes by itself."""
    module, size = case.module, len(case.x)
    acting = case.u[: len(module.INPUT_NAMES)]
    p = module.default_parameters()
    x, u = ca.SX.sym("x", size), ca.SX.sym("u", len(acting))
    plain = module.step_function()(x, u, p)[0]
    slopes = ca.Function("slopes", [x, u], [plain, ca.jacobian(plain, x), ca.jacobian(plain, u)])
    right_after, right_a, right_b = (np.array(value) for value in slopes(case.x, acting))
    after, a, b = (np.array(value) for value in module.jacobian_function()(case.x, acting, p))
    assert np.allclose(after, right_after, rtol=1e-12, atol=1e-12 * np.abs(right_after).max())
    assert relative(a, right_a) < EXACT
    assert relative(b, right_b) < EXACT
    directions = np.random.default_rng(5).normal(size=(size + len(acting), 3))
    tangent = module.tangent_function(3)(case.x, acting, p, directions[:size], directions[size:])
    right = right_a @ directions[:size] + right_b @ directions[size:]
    assert relative(np.array(tangent), right) < EXACT


def test_casadi_takes_the_jacobian_it_is_told(case: Any) -> None:
    """Inside a larger expression, and of inputs held over all stages of a step."""
    module = case.module
    p = module.default_parameters()
    x, u = ca.MX.sym("x", len(module.STATE_NAMES)), ca.MX.sym("u", len(module.INPUT_NAMES))
    step = module.step_with_jacobian()
    twice = step(step(x, u, p), 2.0 * u, p)
    plain = module.step_function()
    right = plain(plain(x, u, p)[0], 2.0 * u, p)[0]
    slopes = [ca.Function("slopes", [x, u], [ca.jacobian(y, x), ca.jacobian(y, u)]) for y in (twice, right)]
    acting = case.u[: len(module.INPUT_NAMES)]
    for found, expected in zip(slopes[0](case.x, acting), slopes[1](case.x, acting), strict=True):
        if expected.numel():
            assert relative(np.array(found), np.array(expected)) < 10 * EXACT


@pytest.mark.compiler
def test_finite_differences_agree_to_their_own_accuracy(case: Any) -> None:
    kernel = case.native
    random = np.random.default_rng(11)
    dx, du = random.normal(size=len(case.x)), random.normal(size=len(case.u))
    _, found = kernel.step(case.x, case.u, dx[:, None], du[:, None])
    none = np.zeros((len(case.x), 1)), np.zeros((len(case.u), 1))

    def after(h: float) -> np.ndarray:
        return kernel.step(case.x + h * dx, case.u + h * du, *none)[0]

    errors = []
    for h in (1e-2, 5e-3):
        difference = (after(h) - after(-h)) / (2.0 * h)
        errors.append(np.abs(difference - found[:, 0]).max() / np.abs(found).max())
    # central differences: a fourth at half the step, unless the step is linear and rounding is all there is
    assert errors[1] < 1e-9 or errors[0] / errors[1] == pytest.approx(4.0, rel=0.2)
    assert errors[1] < 1e-2


SOLVED_AT_ONCE = """
name = "pair"
[model]
kind = "spatial"
gravity = [0, 0, -9.81]
[integrator]
name = "radau2"
step = 2e-2
[base]
kind = "clamp"
[[motor]]
name = "yaw"
axis = "z"
rotor_inertia = 2e-5
gear = 20
stiffness = 6.0
damping_time = 1e-3
[[body]]
name = "post"
on = "yaw"
mass = 0.4
center = [0.1, 0.0, 0.05]
inertia = [1e-3, 2e-3, 2e-3, 0, 1e-4, 0]
[[joint]]
name = "elbow"
on = "post"
at = [0.2, 0.0, 0.1]
axis = "y"
stiffness = 0.5
[[body]]
name = "hand"
on = "elbow"
mass = 0.2
center = [0.1, 0.05, 0.0]
inertia = [1e-4, 1e-4, 1e-4]
[[input]]
name = "torque"
at = "yaw"
acts = "torque"
[[output]]
name = "hand"
at = "hand"
of = "position"
[emit]
sensitivities = true
"""


HUB = """kind = "free"
[[body]]
name = "hub"
on = "base"
mass = 1.0
inertia = [1e-2, 2e-2, 3e-2]"""


def afloat() -> str:
    """Return the scene without its elbow, on a base that floats."""
    once = SOLVED_AT_ONCE.replace('kind = "spatial"', 'kind = "spatial"\niterations = 1')
    inner, _, rest = once.replace('kind = "clamp"', HUB).partition("[[joint]]")
    return (inner + rest[rest.index("[[input]]") :]).replace('at = "hand"', 'at = "post"')


@pytest.mark.parametrize("text", [SOLVED_AT_ONCE, afloat()], ids=["clamp", "afloat"])
def test_stages_solved_at_once_in_space_have_the_slopes_that_differences_show(text: str) -> None:
    """A complex sweep and a second iteration by its factors, behind an elastic gear; nothing is compiled."""
    program = build_program(parse_scene(text))
    found = program.sensitivities
    sizes = [sum(v.length or 1 for v in group) for group in (program.state, program.inputs)]
    random = np.random.default_rng(9)
    point, along = (random.uniform(-0.6, 0.6, sum(sizes)) for _ in range(2))
    groups = (program.step, *program.parameters, *program.coefficients, *program.state, *program.inputs)
    values = allocate((*groups, *found.point), float)
    execute(program.prepare, values)

    def after(h: float) -> np.ndarray:
        moved = dict(values)
        _fill(moved, program.state, (point + h * along)[: sizes[0]])
        _fill(moved, program.inputs, (point + h * along)[sizes[0] :])
        execute(found.linearise, moved)
        values.update({key(v): moved[key(v)] for v in found.point} if h == 0.0 else {})
        return np.concatenate([np.ravel(moved[key(v)]) for v in program.state])

    after(0.0)
    _fill(values, found.state, along[: sizes[0]])
    _fill(values, found.inputs, along[sizes[0] :])
    execute(found.tangent, values)
    slope = np.concatenate([np.ravel(values[key(v)]) for v in found.state])
    errors = [
        np.abs((after(h) - after(-h)) / (2.0 * h) - slope).max() / np.abs(slope).max() for h in (4e-3, 2e-3)
    ]
    assert errors[0] / errors[1] == pytest.approx(4.0, rel=0.05)
    assert errors[1] < 1e-4


def test_a_direction_costs_less_than_a_step(case: Any) -> None:
    """In space, where factors are differentiated too, less than two."""
    program, most = case.program, 0.8 if case.scene.spatial is None else 2.0
    tangent, step = (count_routine(each).total for each in (program.sensitivities.tangent, program.main))
    assert tangent < most * step or program.sensitivities.point == ()


@pytest.mark.compiler
@pytest.mark.parametrize("case", ["in space"], indirect=True)
def test_single_precision_has_casadis_derivatives_to_its_own_digits(case: Any) -> None:
    scene = case.scene.replace(**{"emit.real": "float32"})
    kernel = NativeSensitivities(case.program, scene, flags=("-O0",))
    nx, nu = len(case.x), len(case.u)
    _, found = kernel.step(case.x, case.u, np.eye(nx, nx + nu), np.eye(nu, nx + nu, k=nx))
    assert EXACT < relative(found, np.hstack([case.a, case.b])) < 1e-4


def test_nothing_is_emitted_unless_asked_for() -> None:
    scene = load_scene(scenes_dir() / "arm2.toml")
    assert build_program(scene).sensitivities is None
    assert not any("sensitivities" in path for path in emit_kernel(build_program(scene), scene))


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"model.linearisation": "taylor"}, "model.linearisation = 'newton'"),
        ({"integrator.name": "houbolt"}, "start-up steps"),
    ],
)
def test_steps_without_derivatives_are_refused(changes: dict[str, object], said: str) -> None:
    scene = load_scene(scenes_dir() / "arm2.toml").replace(**{"emit.sensitivities": True, **changes})
    with pytest.raises(UserError, match=said):
        build_program(scene)


@pytest.mark.parametrize("case", ["in space"], indirect=True)
def test_steps_that_need_others_are_refused_in_space(case: Any) -> None:
    with pytest.raises(UserError, match="start-up steps"):
        build_program(case.scene.replace(**{"integrator.name": "houbolt"}))


def _fill(values: dict[str, Any], variables: tuple[Any, ...], numbers: np.ndarray) -> None:
    start = 0
    for variable in variables:
        stop = start + (variable.length or 1)
        part = [float(x) for x in numbers[start:stop]]
        values[key(variable)] = part if variable.length is not None else part[0]
        start = stop
