"""Steps whose stages and systems are parts of vectors: the same motion to rounding, the same refusals."""

from __future__ import annotations

import re
import shutil
import tomllib
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tmm_gen.c_language.real import REALS
from tmm_gen.emit.c import emit_kernel
from tmm_gen.emit.c.vector_printer import VectorPrinter
from tmm_gen.native import NativeKernel, compile_kernel
from tmm_gen.native.cuda import cuda_source
from tmm_gen.native.library import OutOfRangeError, VanishingPivotError
from tmm_gen.program.build import build_program
from tmm_gen.program.count import count_routine
from tmm_gen.program.passes.side_by_side import Lane, SideBySide
from tmm_gen.program.statements import Assign, Program, Section
from tmm_gen.program.variables import Ref, Role, Spread, Variable, local
from tmm_gen.scene import Scene, parse_scene
from tmm_gen.verify.host_test import run_host_test

ARM = """
name = "tree"
[model]
kind = "spatial"
gravity = [0, 0, -9.81]
[integrator]
name = "gauss3"
step = 5e-3
[base]
kind = "prescribed"
axis = "z"
[[input]]
name = "table"
at = "base"
acts = "angle"
[[motor]]
name = "drive"
on = "base"
axis = "y"
rotor_inertia = 1e-3
gear = 10.0
damping = 0.5
[[joint]]
name = "hinge"
on = "drive"
axis = "y"
stiffness = 200.0
damping = 0.05
[[joint]]
name = "left"
on = "hinge"
at = [0.3, 0.1, 0.0]
axis = "x"
stiffness = 10.0
damping = 0.05
[[joint]]
name = "right"
on = "hinge"
at = [0.3, -0.1, 0.0]
axis = "z"
stiffness = 5.0
damping = 0.05
[[body]]
name = "rod"
on = "hinge"
mass = 0.5
center = [0.15, 0.0, 0.0]
inertia = [1e-3, 4e-3, 4e-3]
[[body]]
name = "load"
on = "left"
mass = 0.4
center = [0.2, 0.0, 0.05]
inertia = [1e-3, 2e-3, 2e-3]
[[body]]
name = "hand"
on = "right"
mass = 0.2
center = [0.1, 0.0, 0.0]
inertia = [1e-4, 2e-4, 2e-4]
[[input]]
name = "torque"
at = "drive"
acts = "torque"
[[input]]
name = "push"
at = "load"
acts = "force"
in = "world"
[[output]]
name = "left"
at = "left"
of = "angle"
"""
FAST = {"emit.favour": "speed"}
OWN = {"emit.trigonometry": "own"}


def scene(**changes: Any) -> Scene:
    return parse_scene(ARM).replace(**changes)


def after(kernel: NativeKernel, steps: int) -> dict[str, Any]:
    """Return the state after steps under inputs that differ from stage to stage, from a start off rest."""
    kernel.prepare()
    draw = np.random.default_rng(5)
    kernel.initialise({"torque": 0.1})
    state = {k: np.asarray(v) + draw.uniform(-0.1, 0.1, np.shape(v)) for k, v in kernel.state.items()}
    kernel.state = state
    for _ in range(steps):
        kernel.step({v.name: draw.uniform(-0.1, 0.1, v.length) for v in kernel.program.inputs})
    return kernel.state


def both(program: Program, **changes: Any) -> tuple[NativeKernel, NativeKernel]:
    """Return the small kernel of a program and the fast one."""
    small, fast = scene(**changes), scene(**changes, **FAST)
    return compile_kernel(program, small), compile_kernel(program, fast)


@pytest.fixture(scope="module")
def tree() -> Program:
    return build_program(scene(**OWN, **FAST))


def agree(program: Program, digits: float, **changes: Any) -> tuple[dict[str, Any], dict[str, Any]]:
    """Take steps in both ways, and return the states."""
    expected, found = (after(kernel, 3) for kernel in both(program, **changes))
    assert expected.keys() == found.keys()
    for key, value in expected.items():
        # accelerations are quotients by squares of the step
        size = max(1.0, float(np.abs(value).max())) * (100.0 if "acceleration" in key else 1.0)
        np.testing.assert_allclose(found[key], value, rtol=0, atol=digits * size, err_msg=key)
    return expected, found


@pytest.mark.compiler
def test_motion_is_the_same_to_rounding(tree: Program) -> None:
    """A real and a complex system, three stages and the middle of the step."""
    agree(tree, 1e-12, **OWN)


@pytest.mark.compiler
@pytest.mark.parametrize(
    ("changes", "digits"),
    [
        ({"integrator.name": "radau2"}, 1e-12),  # vectors of two parts, the C library's sines
        ({**OWN, "emit.real": "float32", "integrator.name": "radau3"}, 3e-5),
    ],
    ids=["radau2", "float32"],
)
def test_so_it_is_in_vectors_of_other_sizes(changes: dict[str, Any], digits: float) -> None:
    agree(build_program(scene(**changes, **FAST)), digits, **changes)


@pytest.mark.compiler
def test_iterates_until_one_changes_next_to_nothing() -> None:
    expected, found = agree(build_program(scene(**OWN, **FAST), auto=True), 1e-12, **OWN)
    assert expected["sweeps"] == found["sweeps"] > 2


@pytest.mark.compiler
def test_refusals_are_the_same_and_leave_the_state(tree: Program) -> None:
    for kernel in both(tree, **OWN):
        kernel.prepare()
        kernel.initialise({})
        rest = kernel.state
        for key, value, error in (
            ("angle", 1e9, OutOfRangeError),
            ("rate", np.nan, OutOfRangeError),
            ("acceleration_stage2", np.inf, OutOfRangeError),
        ):
            spoilt = {**rest, key: np.append(rest[key][:-1], value)}
            kernel.state = spoilt
            with pytest.raises(error):
                kernel.step({})
            np.testing.assert_array_equal(kernel.state[key], spoilt[key])
        kernel.prepare({"mass": -1.0})
        kernel.state = rest
        with pytest.raises(VanishingPivotError):
            kernel.step({})
        np.testing.assert_array_equal(kernel.state["angle"], rest["angle"])


@pytest.mark.compiler
def test_emitted_test_passes_without_a_warning(tree: Program) -> None:
    for cc in filter(shutil.which, ("gcc", "clang")):
        assert run_host_test(tree, scene(**OWN, **FAST), cc)[0] == 0, cc


def test_it_is_what_the_page_writes() -> None:
    page = Path(__file__).resolve().parents[2] / "docs" / "space.md"
    (block,) = re.findall(r"```toml\n(.*?)```", page.read_text(), re.DOTALL)
    keys = {f"{table}.{k}": v for table, values in tomllib.loads(block).items() for k, v in values.items()}
    written, here = scene(**keys), scene(**OWN, **FAST)
    assert (written.integrator, written.emit) == (here.integrator, here.emit)


def test_operations_are_less_than_half(tree: Program) -> None:
    assert tree.vectors is not None
    assert tree.vectors.parts == 4
    # three stages in one operation; of systems one and four products in two
    assert count_routine(tree.vectors.step).total < 0.45 * count_routine(tree.main).total


def test_arms_side_by_side_and_threads_are_lanes_already(tree: Program) -> None:
    asked = scene(**OWN, **FAST)
    assert "vector_size" in emit_kernel(tree, asked)["c/tree.c"]
    assert "vector_size" not in cuda_source(tree, asked)
    assert "vector_size" not in emit_kernel(tree, asked.replace(**{"emit.batch": 4}))["c/tree.c"]


def test_integrators_with_one_stage_after_the_other_have_no_vectors() -> None:
    small, fast = (scene(**{"integrator.name": "newmark"}, **more) for more in ({}, FAST))
    program = build_program(fast)
    assert program.vectors is None
    texts = [emit_kernel(program, asked)["c/tree.c"] for asked in (small, fast)]
    assert not any("vector_size" in text for text in texts)
    vectors = emit_kernel(build_program(scene(**FAST)), scene(**FAST))
    assert any("vector_size" in text for text in vectors.values())


def complex_of(text: str, **values: complex) -> complex:
    """Evaluate what is written for systems, with the meaning that macros of the template have."""
    functions = {
        "real_of": lambda y: y.real,
        "imaginary_of": lambda y: 1j * y.imag,
        "turned": lambda x: x,  # together with the one above: x i is x turned, with the first sign changed
        "times": lambda x, y: x * y,
        "inverse_of": lambda x: 1 / x,
        "TMM_GEN_REAL": complex,
    }
    return complex(eval(text, functions | values))


def test_products_of_systems_are_those_of_complex_numbers() -> None:
    x, y, z = (Variable(name, Role.LOCAL, spread=Spread.SYSTEMS).ref for name in "xyz")
    s = local("s")
    printer = VectorPrinter(REALS["float64"], str)
    values = {"x": 0.3 + 0.4j, "y": -1.1 + 0.2j, "z": 0.7 - 0.9j, "s": 2.5}
    for e in (
        s - x * y,
        s * x * y + z,
        x * y * z - s,
        (x + s) * (y - z),
        1 / (x * y + s),
        x / z,
        -s * x / (z + 1),
        x**2 - y * (x - s) / s,
        s,
    ):
        text = printer.written(e, Spread.SYSTEMS)
        assert complex_of(text, **values) == pytest.approx(
            complex(e.subs({r: values[str(r)] for r in e.free_symbols}))
        )


def test_what_differs_goes_into_vectors_and_nothing_else() -> None:
    given, same, made = (local(name) for name in ("given", "same", "made"))
    lane = Lane("_stages", "at all stages", spread=Spread.STAGES)
    (section,) = SideBySide((lane,), {}, [given.variable]).sections(
        [Section("", (Assign(same, local("other")), Assign(made, same * given)))]
    )
    first, second = section.statements
    assert isinstance(first, Assign)
    assert isinstance(second, Assign)
    assert first.target == same
    assert second.target.variable.spread is Spread.STAGES
    assert {r.variable.spread for r in second.value.atoms(Ref)} == {None, Spread.STAGES}
