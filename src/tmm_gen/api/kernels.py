"""What is derived of an arm once, when it is first asked for."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from types import ModuleType
from typing import Any

from tmm_gen.control.arm.small_motion import SmallMotion
from tmm_gen.native.python_module import casadi_module
from tmm_gen.scene import Scene
from tmm_gen.simulate.stepping import Backend, Stepper

__all__ = ["Kernels"]


@dataclass(frozen=True, eq=False)
class Kernels:
    """Kernels of a scene.

    Parameters
    ----------
    scene : Scene
        Of any kind.
    """

    scene: Scene
    _made: dict[Backend, Any] = field(default_factory=dict)

    def of(self, backend: Backend) -> Any:
        """Return the kernel that a run steps with: the generated NumPy package, or compiled C."""
        if backend not in self._made:
            self._made[backend] = Stepper.of(self.scene, backend).kernel
        return self._made[backend]

    @cached_property
    def casadi(self) -> ModuleType:
        """The generated CasADi module."""
        return casadi_module(self.scene)

    @cached_property
    def small_motion(self) -> SmallMotion:
        """What linear models share."""
        return SmallMotion.of(self.scene)
