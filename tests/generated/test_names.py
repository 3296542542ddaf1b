"""Signals called like anything the generated modules of Python say themselves, builtins and modules included."""

from __future__ import annotations

import builtins
import io
import random
import re
import tokenize
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from tmm_gen.emit.casadi.model import symbol
from tmm_gen.scene import Scene, parse_scene
from tmm_gen.scene.identifier import name_fault, scene_name_fault

Generate = Callable[[Scene], Any]

SCENE = """
name = "small"
[model]
kind = "{kind}"
[integrator]
name = "{integrator}"
step = 0.01
[base]
kind = "motor"
inertia = 0.5
[[joint]]
stiffness = 20.0
[[link]]
inertia = 1.0
{planar}
[[joint]]
stiffness = 35.0
[[link]]
inertia = 2.0
{planar}
[[input]]
name = "{0}"
at = "base"
acts = "torque"
[[input]]
name = "{1}"
at = "tip"
acts = "torque"
[[output]]
name = "{2}"
at = "tip"
of = "angle"
[[output]]
name = "{3}"
at = 1
of = "velocity"
"""


def scene(names: list[str], integrator: str = "newmark") -> Scene:
    return parse_scene(SCENE.format(*names, kind="chain", integrator=integrator, planar=""))


def words(text: str) -> set[str]:
    found = tokenize.generate_tokens(io.StringIO(text).readline)
    return {token.string for token in found if token.type == tokenize.NAME}


@pytest.mark.parametrize("integrator", ["newmark", "houbolt", "sdirk2"])
def test_every_name_of_the_modules_themselves(integrator: str, generate: Generate) -> None:
    plain = generate(scene(["aa", "bb", "cc", "dd"], integrator))
    from tmm_gen.emit.casadi import emit_casadi

    text = plain.text + emit_casadi(plain.program, plain.scene)["casadi_model.py"]
    known = words(text) | set(dir(builtins)) | {"self", "math", "u", "x", "p", "lambda_", "match", "type", "_x"[1:]}
    names = sorted(name for name in known if name_fault(name) is None)
    assert len(names) > 150
    random.Random(1).shuffle(names)
    expected = plain.kernel.simulate(0.05, {"aa": 1.0, "bb": -0.5}, initial_angle=0.1)
    column = np.asarray(plain.casadi.step_function()(*at(plain), plain.casadi.default_parameters())[0])
    for start in range(0, 24 if integrator == "newmark" else 8, 4):
        four = names[start : start + 4]
        made = generate(scene(four, integrator))
        found = made.kernel.simulate(0.05, {four[0]: 1.0, four[1]: -0.5}, initial_angle=0.1)
        np.testing.assert_array_equal(found.outputs[four[2]], expected.outputs["cc"], err_msg=str(four))
        np.testing.assert_array_equal(found.outputs[four[3]], expected.outputs["dd"], err_msg=str(four))
        stepped = made.casadi.step_function()(*at(made), made.casadi.default_parameters())[0]
        np.testing.assert_array_equal(np.asarray(stepped), column, err_msg=str(four))


def at(made: Any) -> tuple[list[float], list[float]]:
    """Return a state and inputs for CasADi's step."""
    return [0.1 + 0.01 * k for k in range(len(made.casadi.STATE_NAMES))], [1.0, -0.5]


def test_no_program_has_a_name_that_the_templates_use_for_a_users() -> None:
    for name in ("np", "math", "self", "u", "x", "p", "y", "h", "stiffness", "mass", "input", "output", "step", "k"):
        assert name_fault(name) is None, name


@pytest.mark.parametrize("name", ["arm", "Arm", "a__b", "a_", "a__", "A_1", "step"])
def test_casadi_takes_the_functions_of_every_scene(name: str) -> None:
    assert scene_name_fault(name) is None
    casadi = pytest.importorskip("casadi")
    assert casadi.Function.check_name(f"{symbol(name)}_step")
    assert casadi.Function.check_name(f"jac_{symbol(name)}_step")
    assert re.fullmatch(r"\w+", symbol(name))


def test_functions_of_two_models_have_two_names(generate: Generate) -> None:
    one = generate(scene(["a", "b", "c", "d"]))
    other = generate(one.scene.replace(name="Small"))
    functions = [made.casadi.step_function().name() for made in (one, other)]
    assert len(set(functions)) == 2
