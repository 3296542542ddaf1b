"""The operations that headers promise are those that the kernels do."""

from __future__ import annotations

import math
import operator
import re
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tmm_gen.program.count import count_routine
from tmm_gen.scene import METHODS, Scene

SCENES = sorted(path.stem for path in (Path(__file__).resolve().parents[2] / "scenes").glob("*.toml"))
DONE: Counter[str] = Counter()


class Counting:
    """A number that counts what is done with it; changes of sign and comparisons are free."""

    def __init__(self, value: Any) -> None:
        self.value = float(value.value if isinstance(value, Counting) else value)

    def _do(self, kind: str, operation: Callable[..., float], *operands: Any) -> Any:
        if any(isinstance(operand, np.ndarray) for operand in operands):
            return NotImplemented  # the array does it element by element
        DONE[kind] += 1
        return Counting(operation(*(Counting(operand).value for operand in operands)))

    def __add__(self, other: Any) -> Any:
        return self._do("additions", operator.add, self, other)

    def __radd__(self, other: Any) -> Any:
        return self._do("additions", operator.add, other, self)

    def __sub__(self, other: Any) -> Any:
        return self._do("additions", operator.sub, self, other)

    def __rsub__(self, other: Any) -> Any:
        return self._do("additions", operator.sub, other, self)

    def __mul__(self, other: Any) -> Any:
        return self._do("multiplications", operator.mul, self, other)

    def __rmul__(self, other: Any) -> Any:
        return self._do("multiplications", operator.mul, other, self)

    def __truediv__(self, other: Any) -> Any:
        return self._do("divisions", operator.truediv, self, other)

    def __rtruediv__(self, other: Any) -> Any:
        return self._do("divisions", operator.truediv, other, self)

    def __neg__(self) -> Counting:
        return Counting(-self.value)

    def __gt__(self, other: Any) -> bool:
        return self.value > Counting(other).value

    def __lt__(self, other: Any) -> bool:
        return self.value < Counting(other).value

    def call(self, function: Callable[[float], float]) -> Any:
        return self._do("sines and cosines", function, self)


FUNCTIONS = {
    "sin": lambda x: Counting(x).call(math.sin),
    "cos": lambda x: Counting(x).call(math.cos),
    "sqrt": lambda x: Counting(x).call(math.sqrt),
}


@contextmanager
def counted() -> Iterator[Counter[str]]:
    """Count what is done inside."""
    DONE.clear()
    found: Counter[str] = Counter()
    yield found
    found.update(DONE)


def promised(text: str, what: str) -> Counter[str]:
    """Return the operations a header promises, by kind."""
    (line,) = re.findall(rf"^# operations of {what}: (.*)$", text.replace("\n#     ", " "), re.MULTILINE)
    total = line.partition(",")[0]
    kinds = re.findall(r"(\d+) (additions|multiplications|divisions|sines and cosines)", line)
    found = Counter({kind: int(number) for number, kind in kinds})
    assert found.total() == int(total)
    return found


def check(generated: Any) -> None:
    kernel = generated.kernel_in(Counting, lambda above, below: Counting(above / below), FUNCTIONS)
    values = generated.random(np.random.default_rng(1))
    values = {name: np.vectorize(Counting, otypes=[object])(value) for name, value in values.items()}
    with counted() as done:
        model = kernel.prepare()
    # Loops of C do for every station what whole arrays do once, where only numbers of the arm are combined.
    assert done <= promised(generated.text, "prepare")
    assert done == promised(generated.text, "prepare") or generated.scene.model.kind == "planar"
    titles = [f"start-up step {k + 1}" for k in range(len(generated.program.startup))]
    for place, title in enumerate([*titles, "a step"]):
        state, acting = generated.state(kernel, values, place), generated.input(kernel, values, place)
        with counted() as done:
            kernel.step(model, state, acting)
        assert done == promised(generated.text, title)


@pytest.mark.parametrize("integrator", [method.name for method in METHODS])
@pytest.mark.parametrize("alike", [True, False], ids=["alike", "different"])
def test_kernels_do_what_headers_promise(
    integrator: str, alike: bool, chain: Callable[..., Scene], generate: Callable[[Scene], Any]
) -> None:
    inputs = [("push", "tip", "torque"), ("pull", 1, "torque"), ("drive", "base", "torque")]
    shape = (
        {"joints": [(20.0, 0.5)] * 3, "links": [1.0] * 3} if alike else {"base": "motor", "inputs": inputs}
    )
    check(generate(chain(**shape, integrator=integrator)))


@pytest.mark.parametrize("name", SCENES)
def test_kernels_of_the_committed_scenes_do_what_headers_promise(
    name: str, committed: dict[str, Scene], generate: Callable[[Scene], Any]
) -> None:
    check(generate(committed[name]))


def test_ten_stations_by_newmark_take_at_most_thirty_operations_each(
    committed: dict[str, Scene], generate: Callable[[Scene], Any]
) -> None:
    generated = generate(committed["thesis10"])
    assert (generated.scene.integrator.name, generated.scene.model.sweep) == ("newmark", "riccati")
    assert promised(generated.text, "a step").total() <= 30 * 10
    assert promised(generated.text, "a step").total() == count_routine(generated.program.main).total
