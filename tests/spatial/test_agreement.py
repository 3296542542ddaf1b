"""NumPy, C in both number types and CasADi take the same step: trees, arms with beams, every kind of integrator."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from pathlib import Path

import pytest
from support.spatial.afloat import random_afloat
from support.spatial.kernels import HEADED, program_of
from support.spatial.random_arms import random_arm

from tmm_gen.native import compile_kernel
from tmm_gen.native.python_module import casadi_module, numpy_module
from tmm_gen.program.build import build_program
from tmm_gen.program.space.assemble import SpaceChoices
from tmm_gen.program.statements import Program
from tmm_gen.scene import Scene, parse_scene
from tmm_gen.verify.agreement import (
    casadi_step,
    largest_difference,
    native_step,
    numpy_step,
    reached_vectors,
)

pytestmark = pytest.mark.compiler

TOLERANCE, SINGLE = 1e-12, 2e-3
YAW3 = Path(__file__).parents[2] / "examples" / "space" / "yaw3.toml"
METHODS = ("generalized_alpha", "bathe")
"""Of one stage that is not the step's end, and of two; Newmark and what has a history are among the trees."""
CHOICES = SpaceChoices(1e-3, iterations=2)
TREES = {"exact": (1, "newmark", replace(CHOICES, exact=True)), "park": (2, "park", CHOICES)}


@cache
def tree(seed: int, method: str, choices: SpaceChoices) -> Program:
    return program_of(random_arm(seed, 3, tree=True), method, choices)


@cache
def afloat(seed: int, method: str, choices: SpaceChoices) -> Program:
    return program_of(random_afloat(seed, 2 if choices.exact else 1), method, choices)


@cache
def yaw3(method: str) -> Scene:
    """Return the scene with another integrator, its beams of two cells."""
    text = YAW3.read_text("utf-8").replace('"newmark"', f'"{method}"').replace("links = 5", "links = 2")
    return parse_scene(text)


def agree(program: Program, scene: Scene, *, single: bool) -> None:
    """Hold the backends against each other; ``single`` is asked once for each kind of arm."""
    module = numpy_module(scene, program)
    ours = numpy_step(module, program)
    vectors = list(reached_vectors(module, program, 2, relative=True))
    native = native_step(compile_kernel(program, scene, flags=("-O0",)), program)
    assert largest_difference(ours, native, vectors) < TOLERANCE
    assert largest_difference(ours, casadi_step(casadi_module(scene, program), program), vectors) < TOLERANCE
    if single:
        halved = scene.replace(**{"emit.real": "float32"})
        native = native_step(compile_kernel(program, halved, flags=("-O0",)), program)
        assert TOLERANCE < largest_difference(ours, native, vectors) < SINGLE


@pytest.mark.parametrize("kind", TREES)
def test_trees(kind: str) -> None:
    agree(tree(*TREES[kind]), HEADED, single=kind == "park")


@pytest.mark.parametrize("kind", TREES)
def test_bases_that_float(kind: str) -> None:
    """Under forces and moments on the base too; with a history of turns where the method has one."""
    agree(afloat(*TREES[kind]), HEADED, single=kind == "exact")


@pytest.mark.parametrize("method", METHODS)
def test_arms_with_beams(method: str) -> None:
    scene = yaw3(method)
    agree(build_program(scene), scene, single=method == "bathe")
