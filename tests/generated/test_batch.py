"""Many arms at once: a batch gives, bit for bit, what its arms give one by one."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import pytest

from tmm_gen.scene import Scene

DIFFERENT = {
    "base": "motor",
    "inputs": [("push", 2, "torque"), ("drive", "base", "torque")],
    "outputs": [("tip", "tip", "angle"), ("hub", "base", "velocity"), ("twist", 2, "torque")],
}
ALIKE = {"joints": [(20.0, 0.5)] * 3, "links": [1.0] * 3}

# Where the batch of shape (2, 3) comes from; each part may have all of it, some of its axes, or none.
SOURCES = {
    "state": {"state": (2, 3)},
    "inputs": {"inputs": (2, 3)},
    "parameters of stations": {"stations": (2, 3)},
    "parameters of the arm": {"arm": (2, 3)},
    "step": {"step": (2, 3)},
    "all": {"state": (2, 3), "inputs": (2, 3), "stations": (2, 3), "arm": (2, 3), "step": (2, 3)},
    "different axes": {"state": (3,), "inputs": (2, 1), "stations": (3,), "arm": (2, 1), "step": ()},
    "axes that meet in the state": {"state": (2, 1), "stations": (3,)},
    "nothing": {},
}


def spread(value: Any, shape: tuple[int, ...], rng: np.random.Generator, stationwise: bool) -> Any:
    """Return different values around one for every arm of a batch."""
    value = np.asarray(value, dtype=float)
    if stationwise:
        value = value.reshape(*value.shape, *(1,) * len(shape))
        return value * rng.uniform(0.5, 2.0, size=(value.shape[0], *shape))
    return value * rng.uniform(0.5, 2.0, size=shape)


def of_arm(value: Any, arm: tuple[int, ...], stationwise: bool) -> Any:
    """Return one arm's part of a batched value."""
    array = np.asarray(value)
    lead = array.shape[:1] if stationwise else ()
    own = array.shape[len(lead) :]
    whole = np.broadcast_to(array.reshape(*lead, *(1,) * (2 - len(own)), *own), (*lead, 2, 3))
    return whole[(slice(None), *arm) if stationwise else arm]


def arms() -> Iterator[tuple[int, int]]:
    yield from np.ndindex(2, 3)


@pytest.mark.parametrize("sources", SOURCES.values(), ids=SOURCES)
@pytest.mark.parametrize("shape", [DIFFERENT, ALIKE], ids=["different stations", "alike stations"])
@pytest.mark.parametrize("integrator", ["newmark", "mixed", "bathe", "zhai"])
def test_a_batch_is_its_arms_one_by_one(
    shape: dict[str, Any],
    integrator: str,
    sources: dict[str, tuple[int, ...]],
    chain: Callable[..., Scene],
    generate: Callable[[Scene], Any],
) -> None:
    generated = generate(chain(**shape, integrator=integrator))
    program, kernel = generated.program, generated.kernel
    rng = np.random.default_rng(11)
    parameters = {
        v.name: spread(v.default, sources.get("stations" if v.length else "arm", ()), rng, bool(v.length))
        for v in program.parameters
    }
    step = spread(program.step.default, sources.get("step", ()), rng, False)
    one = generated.random(rng)
    state = {
        v.name: spread(one[v.name], sources.get("state", ()), rng, bool(v.length)) for v in program.state
    }
    inputs = {v.name: rng.normal(size=sources.get("inputs", ())) for v in program.inputs}

    def run(parameters: Any, step: Any, state: Any, inputs: Any) -> list[Any]:
        model = kernel.prepare(kernel.Params(**parameters), step)
        now = kernel.State(**state)
        found: list[Any] = []
        for _ in range(len(program.steps) + 1):
            now = kernel.step(model, now, kernel.Input(**inputs))
            outputs = kernel.output(model, now)
            found += [getattr(now, v.name) for v in program.state]
            found += [getattr(outputs, v.name) for v in program.outputs]
        return found

    batched = run(parameters, step, state, inputs)
    stationwise = [*(bool(v.length) for v in program.state), *(False for _ in program.outputs)]
    stationwise *= len(program.steps) + 1
    lengths = {v.name: bool(v.length) for v in (*program.parameters, *program.state)}
    for arm in arms():
        single = run(
            {name: of_arm(value, arm, lengths[name]) for name, value in parameters.items()},
            of_arm(step, arm, False),
            {name: of_arm(value, arm, lengths[name]) for name, value in state.items()},
            {name: of_arm(value, arm, False) for name, value in inputs.items()},
        )
        for whole, alone, along in zip(batched, single, stationwise, strict=True):
            assert np.array_equal(of_arm(whole, arm, along), alone)


@pytest.mark.parametrize("integrator", ["newmark", "houbolt"])
def test_a_batch_starts_as_its_arms_do(
    integrator: str, chain: Callable[..., Scene], generate: Callable[[Scene], Any]
) -> None:
    kernel = generate(chain(**DIFFERENT, integrator=integrator)).kernel
    rng = np.random.default_rng(5)
    inertia, angle, push = rng.uniform(1, 2, (3, 3)), rng.normal(size=(3, 2, 1)), rng.normal(size=(2, 3))
    batched = kernel.initialise(kernel.Params(inertia=inertia), kernel.Input(push=push), initial_angle=angle)
    assert batched.angle.shape == batched.acceleration.shape == (3, 2, 3)
    assert batched.hub_angle.shape == (2, 3)
    for row, column in arms():
        params, acting = kernel.Params(inertia=inertia[:, column]), kernel.Input(push=push[row, column])
        alone = kernel.initialise(params, acting, initial_angle=angle[:, row, 0])
        for name in ("angle", "rate", "acceleration"):
            assert np.array_equal(getattr(batched, name)[:, row, column], getattr(alone, name)), name
        for name in ("hub_angle", "hub_rate", "hub_acceleration"):
            assert np.array_equal(getattr(batched, name)[row, column], getattr(alone, name)), name


def test_a_batch_of_simulations(chain: Callable[..., Scene], generate: Callable[[Scene], Any]) -> None:
    kernel = generate(chain(integrator="bathe")).kernel
    size = np.array([1.0, -2.0, 0.5])

    def push(time: float) -> Any:
        return size * np.sin(3.0 * time)

    result = kernel.simulate(0.5, {"push": push}, step=0.05)
    assert result.times.shape == (11,)
    assert {name: series.shape for name, series in result.outputs.items()} == {
        "tip": (11, 3),
        "held": (11, 3),
    }
    for arm in range(3):
        alone = kernel.simulate(0.5, {"push": lambda time, arm=arm: push(time)[arm]}, step=0.05)
        for name in ("tip", "held"):
            assert np.array_equal(result.outputs[name][:, arm], alone.outputs[name])


def test_a_batch_that_comes_with_an_input_counts_from_the_start(
    chain: Callable[..., Scene], generate: Callable[[Scene], Any]
) -> None:
    kernel = generate(chain()).kernel

    def push(time: float) -> Any:
        return 0.0 if time < 0.025 else np.array([0.0, 1.0])

    outputs = kernel.simulate(0.05, {"push": push}).outputs
    assert outputs["tip"].shape == (6, 2)
    assert np.array_equal(outputs["tip"][:, 0], np.zeros(6))
    assert not outputs["tip"][:3, 1].any()
    assert outputs["tip"][3:, 1].all()


def test_batches_that_do_not_fit_are_refused(
    chain: Callable[..., Scene], generate: Callable[[Scene], Any]
) -> None:
    kernel = generate(chain()).kernel
    state = kernel.initialise(initial_angle=np.zeros((3, 4)))
    with pytest.raises(ValueError, match=r"batch shapes do not fit together: \[.*\(3,\), \(4,\)\]"):
        kernel.step(kernel.prepare(), state, kernel.Input(push=np.zeros(3)))
