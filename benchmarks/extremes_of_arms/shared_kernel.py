"""One compiled kernel for all arms of a kind: what sets them apart are parameters, and where they start."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from tmm_gen.native import NativeKernel, compile_kernel
from tmm_gen.program.build import build_program
from tmm_gen.scene import Scene


def kernel_of(scene: Scene) -> NativeKernel:
    """Compile a scene's kernel as `run` does."""
    return compile_kernel(build_program(scene, auto=scene.model.auto), scene)


class SharedKernel:
    """A kernel with the parameters and the start of one arm.

    Parameters
    ----------
    kernel : NativeKernel
        That others use as well.
    values : mapping from str
        Parameters of this arm.
    start : mapping from str
        Initial angles and rates, by the names that the kernel takes.
    """

    def __init__(self, kernel: NativeKernel, values: Mapping[str, Any], start: Mapping[str, Any]) -> None:
        self._kernel, self._values, self._start = kernel, values, start

    def prepare(self, parameters: Mapping[str, float], step: float) -> None:
        """Prepare it for this arm."""
        self._kernel.prepare({**self._values, **parameters}, step)

    def initialise(self, inputs: Mapping[str, float], **start: Any) -> None:
        """Start where this arm does."""
        self._kernel.initialise(inputs, **{**self._start, **start})

    def __getattr__(self, name: str) -> Any:
        """Do all else as the kernel does."""
        return getattr(self._kernel, name)
