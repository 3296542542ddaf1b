"""One step from a random state: the interpreter, NumPy and CasADi agree, whatever the scene."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import mpmath
import numpy as np
import pytest
from hypothesis import HealthCheck, Phase, assume, given, settings
from hypothesis import strategies as st

from tmm_gen.program.evaluate import key
from tmm_gen.scene import METHODS, Scene

METHOD_NAMES = [method.name for method in METHODS]
UNKNOWNS = {
    method.name: ["acceleration"] if method.explicit({}) or method.coupled else ["acceleration", "increment", "displacement"]
    for method in METHODS
}
EVERY = [(name, unknown) for name in METHOD_NAMES for unknown in UNKNOWNS[name]]
TOLERANCE = 1e-13
SCENES = sorted(path.stem for path in (Path(__file__).resolve().parents[2] / "scenes").glob("*.toml"))

positive = st.floats(0.05, 50.0).map(lambda x: float(f"{x:.3g}"))
damping = st.just(0.0) | st.floats(0.01, 5.0).map(lambda x: float(f"{x:.3g}"))


@st.composite
def chains(draw: st.DrawFn) -> dict[str, Any]:
    """Draw the shape of a chain: alike or different stations, any base, signals anywhere."""
    n = draw(st.integers(1, 6))

    def many(numbers: st.SearchStrategy[Any]) -> list[Any]:
        return draw(st.lists(numbers, min_size=n, max_size=n) | numbers.map(lambda x: [x] * n))

    base = draw(st.sampled_from(["clamp", "motor", "prescribed"]))
    places = draw(st.lists(st.sampled_from([*range(1, n), "tip"]), unique=True, max_size=3))
    inputs = [(f"torque_{at}", at, "torque") for at in places]
    if base != "clamp":
        inputs.append(("at_base", "base", "torque" if base == "motor" else "angle"))
    moving = [*range(1, n + 1), "tip", *(["base"] if base != "clamp" else [])]
    motion = st.tuples(st.sampled_from(moving), st.sampled_from(["angle", "velocity", "acceleration"]))
    measured = motion | st.tuples(st.sampled_from(["base", *range(1, n + 1)]), st.just("torque"))
    outputs = [
        (f"{of}_of_{at}", at, of) for at, of in draw(st.lists(measured, unique=True, min_size=1, max_size=4))
    ]
    return {
        "joints": many(st.tuples(positive, damping)),
        "links": many(positive),
        "base": base,
        "hub": (draw(positive), draw(damping)),
        "inputs": inputs,
        "outputs": outputs,
        "step": draw(st.sampled_from([1e-3, 0.01, 0.1])),
    }


def check(generated: Any, seed: int) -> None:
    """Compare every step of a scene, the start-up steps first."""
    for place in range(len(generated.program.steps)):
        values = generated.random(np.random.default_rng(seed))
        new, outputs = numpy_step(generated, generated.kernel, values, place)
        compare_with_casadi(generated, values, place, new, outputs)
        compare_with_interpreter(generated, values, place)
        # Other unknowns cancel digits by themselves (like 1/h^2), the product too; 60 digits have told.
        if (generated.scene.model.unknown, generated.scene.model.sweep) == ("acceleration", "riccati"):
            expected = generated.interpret(values, "prepare", "output", f"step{place}")
            assert close(new, [expected[v.name] for v in generated.program.state])
            assert close(outputs, [expected[key(v)] for v in generated.program.outputs])


def numpy_step(generated: Any, kernel: Any, values: Any, place: int) -> tuple[list[Any], list[Any]]:
    """Return the new state and the outputs at the old one."""
    model = kernel.prepare()
    state = generated.state(kernel, values, place)
    new = kernel.step(model, state, generated.input(kernel, values, place))
    outputs = kernel.output(model, state)
    found = [getattr(new, v.name) for v in generated.program.state]
    return found, [getattr(outputs, v.name) for v in generated.program.outputs]


def compare_with_casadi(generated: Any, values: Any, place: int, new: list[Any], outputs: list[Any]) -> None:
    held = {"held": False} if generated.several_stages else {}
    functions = (*generated.casadi.start_functions(**held), generated.casadi.step_function(**held))
    stages = len(generated.program.stage_instants[place]) if generated.several_stages else 1
    given = [np.atleast_1d(values[v.name])[:stages] for v in generated.program.inputs]
    found = functions[place](
        x=flat([values[v.name] for v in generated.program.state]),
        u=np.array(given).reshape(len(given), stages),
        p=generated.casadi.default_parameters(),
    )
    assert close([np.array(found["x_next"]).ravel()], [flat(new)])
    assert close([np.array(found["y"]).ravel()], [flat(outputs)])


def compare_with_interpreter(generated: Any, values: Any, place: int) -> None:
    """Run both in 60 digits: what is printed is what was built, however ill-conditioned the arithmetic."""
    with mpmath.workdps(60):
        functions = {name: getattr(mpmath, name) for name in ("sin", "cos", "sqrt")}
        kernel = generated.kernel_in(mpmath.mpf, lambda a, b: mpmath.mpf(a) / mpmath.mpf(b), functions)
        exact = {name: np.vectorize(mpmath.mpf, otypes=[object])(value) for name, value in values.items()}
        new, outputs = numpy_step(generated, kernel, exact, place)
        routines = ("prepare", "output", f"step{place}")
        expected = generated.interpret(values, *routines, number=mpmath.mpf, modules="mpmath")
        assert close(new, [expected[v.name] for v in generated.program.state], mpmath.mpf("1e-40"))
        assert close(outputs, [expected[key(v)] for v in generated.program.outputs], mpmath.mpf("1e-40"))


def flat(values: list[Any]) -> Any:
    return np.concatenate([np.atleast_1d(value) for value in values]) if values else np.zeros(0)


def close(found: list[Any], expected: list[Any], tolerance: Any = TOLERANCE) -> bool:
    """Compare relative to the largest entry."""
    a, b = flat(found), flat(expected)
    if a.shape != b.shape:
        return False
    return all(abs(a - b) <= tolerance * max(abs(b))) if len(b) else True


@pytest.mark.parametrize(("integrator", "unknown"), EVERY)
@given(shape=chains(), seed=st.integers(0, 2**32 - 1))
@settings(max_examples=2, phases=[Phase.generate], suppress_health_check=[HealthCheck.too_slow])
def test_a_step_of_any_chain_by_any_integrator(
    integrator: str,
    unknown: str,
    shape: dict[str, Any],
    seed: int,
    chain: Callable[..., Scene],
    generate: Callable[[Scene], Any],
) -> None:
    if shape["base"] == "prescribed":
        assume(len(UNKNOWNS[integrator]) > 1)  # an explicit method cannot follow it, and the scene says so
    check(generate(chain(**shape, integrator=integrator, unknown=unknown)), seed)


@pytest.mark.parametrize("integrator", [name for name in METHOD_NAMES if len(UNKNOWNS[name]) > 1])
@pytest.mark.parametrize("base", ["clamp", "motor", "prescribed"])
def test_a_step_by_the_product(
    integrator: str, base: str, chain: Callable[..., Scene], generate: Callable[[Scene], Any]
) -> None:
    inputs = [("push", 2, "torque"), ("drive", "base", "angle" if base == "prescribed" else "torque")]
    used = inputs[: 1 if base == "clamp" else 2]
    scene = chain(base=base, integrator=integrator, sweep="product", inputs=used, step=0.5)
    check(generate(scene), 7)


@pytest.mark.parametrize("name", SCENES)
def test_a_step_of_the_committed_scenes(
    name: str, committed: dict[str, Scene], generate: Callable[[Scene], Any]
) -> None:
    check(generate(committed[name]), 1)


@pytest.mark.parametrize("integrator", METHOD_NAMES)
def test_the_start_is_the_same_in_all(
    integrator: str, chain: Callable[..., Scene], generate: Callable[[Scene], Any]
) -> None:
    generated = generate(chain(base="motor", integrator=integrator))
    program, kernel = generated.program, generated.kernel
    values = generated.random(np.random.default_rng(3), ("given", "inputs"))
    given = {v.name: values[v.name] for v in program.given}
    acting = generated.input(kernel, values, 0)
    first = acting[0] if isinstance(acting, list) else acting
    state = kernel.initialise(kernel.Params(), first, **given)
    expected = generated.interpret(values, "initialise")
    assert close([getattr(state, v.name) for v in program.state], [expected[v.name] for v in program.state])
    u = [getattr(first, v.name) for v in program.inputs]
    x = generated.casadi.initial_function()(**given, u=u, p=generated.casadi.default_parameters())["x"]
    assert close([np.array(x).ravel()], [getattr(state, v.name) for v in program.state])


@pytest.mark.parametrize("integrator", METHOD_NAMES)
def test_a_step_of_a_planar_arm(
    integrator: str, committed: dict[str, Scene], generate: Callable[[Scene], Any]
) -> None:
    check(generate(committed["arm2"].replace(**{"integrator.name": integrator})), 5)
