"""Running what a program is printed as."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import pytest

from tmm_gen.emit.numpy import emit_numpy
from tmm_gen.program.statements import Program
from tmm_gen.scene import Scene


@pytest.fixture(scope="session")
def run_numpy() -> Callable[..., Any]:
    """Return a function that steps the printed NumPy kernel and returns its last state."""

    def run(program: Program, scene: Scene, acting: Mapping[str, float], steps: int) -> Any:
        import sys
        from types import ModuleType

        module = ModuleType("row_kernel")
        sys.modules["row_kernel"] = module  # dataclasses look their module up by its name
        try:
            exec(compile(emit_numpy(program, scene)["kernel.py"], "kernel.py", "exec"), module.__dict__)
        finally:
            del sys.modules["row_kernel"]
        model = module.prepare()
        held = module.Input(**acting)
        state = module.initialise(input=held)
        for _ in range(steps):
            state = module.step(model, state, held)
        return state

    return run
