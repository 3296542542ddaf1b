"""Nothing in an emitted controller is computed in vain: no table of zeros or that is not read, no term of nothing."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from functools import cache, partial

import numpy as np
import pytest

from tmm_gen.closed_loop.plant import Plant
from tmm_gen.control.bench import Bench
from tmm_gen.control.command import Controller, Status
from tmm_gen.control.condition import CONDITIONS
from tmm_gen.onboard.emit import EMITTED, emit_controller
from tmm_gen.onboard.native import EmittedController
from tmm_gen.scene import Scene

_TABLE = re.compile(r"static const \w+ (\w+)(?:\[[^\]]*\])+ = \{(.*?)\};", re.DOTALL)
_NUMBER = r"(?<![\w.])[-+]?\d+(?:\.\d*)?(?:e[-+]?\d+)?f?(?![\w.])"
_NOTHING = re.compile(r"(?<![\w.])0\.0f? [*/]|[*] \(?0\.0f?(?![\w.])|[-+] 0\.0f?(?![\w.])")


def written(files: Mapping[str, str]) -> str:
    """Return what is written for the controller itself and its example, without comments."""
    ours = (
        text
        for path, text in files.items()
        if path.endswith(".c") and "daqp" not in path and "kernel" not in path
    )
    return re.sub(r"/\*.*?\*/", "", "\n".join(ours), flags=re.DOTALL)


@pytest.fixture(scope="module", params=["at once", "half a sample", "two samples", "as late as the model"])
def late(request: pytest.FixtureRequest, swing: Scene, bench: Bench) -> Bench:
    """The swing, whose torques begin to act at different parts of a sample; in the last one links see one each."""
    sample = bench.problem.sample_time
    delay = {
        "at once": 0.0,
        "half a sample": 0.5 * sample,
        "two samples": 2.0 * sample,
        "as late as the model": sample * (1.0 - bench.step.delay.part) % sample,
    }[request.param]
    return bench if delay == 0.0 else Bench.of(swing.replace(**{"control.delay": delay}))


@pytest.fixture(scope="module")
def emitting(late: Bench) -> Callable[[str], tuple[str, dict[str, str]]]:
    """Write a controller, each once."""
    return cache(partial(emit_controller, late))


@pytest.mark.parametrize("kind", EMITTED)
def test_no_term_is_dead(kind: str, emitting: Callable[[str], tuple[str, dict[str, str]]]) -> None:
    _, files = emitting(kind)
    text = written(files)
    tables = _TABLE.findall(text)
    assert len(tables) > 8
    for name, numbers in tables:
        assert len(re.findall(rf"\b{name}\b", text)) > 1, f"{name} is never read"
        assert any(map(float, re.findall(_NUMBER, numbers.replace("f", "")))), f"{name} is nothing but zeros"
    for line in text.splitlines():
        assert not _NOTHING.search(line), line


@pytest.mark.compiler
@pytest.mark.parametrize("kind", EMITTED)
def test_it_does_what_the_one_in_python_does(
    kind: str,
    late: Bench,
    emitting: Callable[[str], tuple[str, dict[str, str]]],
    in_python: Callable[[Bench, str], Controller],
) -> None:
    name, files = emitting(kind)
    emitted = EmittedController(name, files, [0, 1], flags=("-O0", "-ffp-contract=off"))
    controller, plant = in_python(late, kind), Plant(late.scene, late.problem, CONDITIONS[1])
    for k in range(8 if kind == "rti" else 25):
        if k in (2, 5):  # weak for a while
            ends = np.array([-1.0]), np.array([2.0 if k == 2 else 1e6])
            assert emitted.limit(*ends) is controller.limit(*ends) is Status.OK
        measured = plant.measured()
        torque = controller.command(measured).torque
        assert np.isclose(emitted.command(measured).torque, torque, rtol=0.0, atol=1e-6)
        plant.advance(torque)
