"""What is not finite: an arm of a batch that has it is NaN, the others are right, and NumPy does not complain."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from tmm_gen.scene import Scene, load_scene

Generate = Callable[[Scene], Any]
SCENES = Path(__file__).resolve().parents[2] / "scenes"
ODD = (np.nan, np.inf, -np.inf, 1.7e308, -1.7e308, 5e-324, 0.0, -1.0)
WHERE = ("step", "parameter", "input", "start", "state")
ARMS = 4


def motion(made: Any, arm: dict[str, Any], batch: tuple[int, ...]) -> dict[str, Any]:
    """Return outputs after two steps; ``arm`` says by how much what is given is multiplied, by place."""
    kernel, program = made.kernel, made.program

    def times(value: Any, factor: Any) -> Any:
        array = np.asarray(value, dtype=float)
        return array.reshape((*array.shape, *(1,) * len(batch))) * factor

    first = program.parameters[0].name
    with np.errstate(all="ignore"):  # of the test's own products
        params = kernel.Params(**{first: times(getattr(kernel.Params(), first), arm["parameter"])})
        step = kernel.STEP * arm["step"]
        start = {program.given[0].name: times(np.full(kernel.STATIONS, 0.01), arm["start"])}
    extra = {"step": step} if program.step in program.initialise.read() else {}
    input = kernel.Input(**{kernel.INPUT_NAMES[0]: arm["input"]})
    model = kernel.prepare(params, step)
    state = kernel.initialise(params, input, **start, **extra)
    fields = {v.name: getattr(state, v.name) for v in program.state}
    with np.errstate(all="ignore"):
        fields[program.state[0].name] = fields[program.state[0].name] * arm["state"]
    more = {"steps_taken": state.steps_taken} if program.startup else {}
    state = kernel.State(**fields, **more)
    for _ in range(2):
        state = kernel.step(model, state, input)
    found = kernel.output(model, state)
    values = {v.name: getattr(state, v.name) for v in program.state}
    return values | {name: getattr(found, name) for name in kernel.OUTPUT_NAMES}


odd_arms = st.lists(
    st.dictionaries(st.sampled_from(WHERE), st.sampled_from(ODD), max_size=2), min_size=ARMS, max_size=ARMS
)


@pytest.mark.parametrize("name", ["drivetrain", "arm2", "thesis2", "houbolt", "sdirk2"])
@settings(max_examples=15, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(odd=odd_arms)
def test_a_batch_gives_what_its_arms_give_and_nan_for_those_that_are_refused(
    name: str, odd: list[dict[str, float]], generate: Generate, chain: Any
) -> None:
    file = SCENES / f"{name}.toml"
    made = generate(load_scene(file) if file.exists() else chain(integrator=name))
    arms = [{where: found.get(where, 1.0 + 0.1 * k) for where in WHERE} for k, found in enumerate(odd)]
    single: list[dict[str, Any] | None] = []
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for arm in arms:
            try:
                single.append(motion(made, arm, ()))
            except (ArithmeticError, ValueError):
                single.append(None)
        together = {where: np.array([arm[where] for arm in arms]) for where in WHERE}
        if not any(single):
            with pytest.raises((ArithmeticError, ValueError)):
                motion(made, together, (ARMS,))
            return
        found = motion(made, together, (ARMS,))
    for k, alone in enumerate(single):
        for what, values in found.items():
            column = values[..., k]
            if alone is None:
                assert np.isnan(column).all(), (what, arms[k])
            else:
                np.testing.assert_array_equal(column, alone[what], err_msg=f"{what} {arms[k]}")
