"""Scenes, and their kernels in C to hold exported models against."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from tmm_gen.native import NativeKernel, compile_kernel
from tmm_gen.program.build import build_program
from tmm_gen.program.statements import Program
from tmm_gen.scene import Scene, load_scene

SCENES = Path(__file__).resolve().parents[2] / "scenes"


@pytest.fixture(scope="session")
def scene_named() -> Callable[[str], Scene]:
    """Read a committed scene."""
    return lambda name: load_scene(SCENES / f"{name}.toml")


@pytest.fixture(scope="session")
def program_of() -> Callable[[Scene], Program]:
    """Build a scene's program, once for all number types."""
    known: dict[Scene, Program] = {}

    def of(scene: Scene) -> Program:
        key = scene.replace(**{"emit.real": "float64"})
        if key not in known:
            known[key] = build_program(key)
        return known[key]

    return of


@pytest.fixture(scope="session")
def direct(program_of: Callable[[Scene], Program]) -> Callable[[Scene], NativeKernel]:
    """Compile a scene's kernel, with the flags users get; each scene once."""
    known: dict[Scene, NativeKernel] = {}

    def of(scene: Scene) -> NativeKernel:
        if scene not in known:
            known[scene] = compile_kernel(program_of(scene), scene)
        return known[scene]

    return of
