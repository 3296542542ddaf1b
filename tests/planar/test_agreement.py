"""NumPy, C and CasADi take the same step, whatever the arm and the integrator."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from tmm_gen.native import compile_kernel
from tmm_gen.native.python_module import casadi_module, numpy_module
from tmm_gen.program.build import build_program
from tmm_gen.scene import METHODS, Scene, load_scene
from tmm_gen.verify.agreement import (
    casadi_step,
    largest_difference,
    native_step,
    numpy_step,
    random_vectors,
    reached_vectors,
)
from tmm_gen.verify.check import near_slack

pytestmark = pytest.mark.compiler

TOLERANCE = 1e-12
BASES = ("clamp", "motor", "prescribed")
# an explicit integrator cannot follow a prescribed base
DRAWN = [
    (
        method.name,
        "motor" if method.explicit({}) else BASES[k % 3],
        1 + k % 4,
        {"tip": k % 2 == 0, "gravity": 9.81 if k % 3 else None, "seed": k},
    )
    for k, method in enumerate(METHODS)
]
DRAWN += [
    ("newmark", base, 4, {"seed": 20 + k, "unknown": unknown, "iterations": 1 + k % 2})
    for k, (base, unknown) in enumerate(
        zip(BASES, ("increment", "displacement", "acceleration"), strict=True)
    )
]


@pytest.mark.parametrize(
    ("name", "base", "links", "more"), DRAWN, ids=lambda x: x if isinstance(x, str) else ""
)
def test_backends_agree(name: str, base: str, links: int, more: dict, unlike: Callable[..., Scene]) -> None:
    scene = unlike(base, links, integrator=name, **more)
    program = build_program(scene)
    module = numpy_module(scene, program)
    native = native_step(compile_kernel(program, scene, flags=("-O1",)), program)
    casadi = casadi_step(casadi_module(scene, program), program)
    ours = numpy_step(module, program)
    # joints of these arms are soft enough for states that are random altogether; a history must fit together
    altogether = [] if program.startup else random_vectors(program, 5)
    vectors = [*altogether, *reached_vectors(module, program, 5)]
    assert largest_difference(ours, native, vectors) < TOLERANCE
    assert largest_difference(ours, casadi, vectors) < TOLERANCE


def test_reached_vectors_are_those_of_an_arm(unlike: Callable[..., Scene]) -> None:
    """Gentle bends and finite accelerations, different every time, the same in every process."""
    scene = unlike("motor", integrator="zhou")
    program = build_program(scene)
    module = numpy_module(scene, program)
    once, again = (list(reached_vectors(module, program, 3)) for _ in range(2))
    assert [v.taken for v in once] == [0, 0, 0, 1, 1, 1]
    assert all(np.array_equal(a.state["angle"], b.state["angle"]) for a, b in zip(once, again, strict=True))
    assert all(np.max(np.abs(v.state["angle"])) < 1.0 for v in once)
    assert not np.array_equal(once[0].state["angle"], once[1].state["angle"])


def test_a_check_begins_half_the_way_to_where_springs_are_slack(repository: Path) -> None:
    """Straight ahead the latch of the satellite's left panel would be bent by half a turn: gauss3 breaks off there."""
    scene = load_scene(repository / "scenes" / "cube.toml").replace(**{"integrator.name": "gauss3"})
    about = near_slack(scene)
    np.testing.assert_allclose(about, 0.5 * np.pi * np.repeat([1, 0], 6))
    program = build_program(scene)
    module = numpy_module(scene, program)
    assert len(list(reached_vectors(module, program, 10, about=about))) == 20
    with pytest.raises(ArithmeticError, match="pivot"):
        list(reached_vectors(module, program, 10))
