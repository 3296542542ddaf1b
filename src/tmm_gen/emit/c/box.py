"""The box a scene states: bounds of state and inputs within which its C code is proved free of faults."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from tmm_gen.errors import UserError
from tmm_gen.program.statements import Program
from tmm_gen.program.variables import Role, Variable
from tmm_gen.scene import Scene

STATES = {"rad": "angles", "rad/s": "rates", "rad/s^2": "accelerations"}
"""Keys of the box for state variables, by unit."""

BASE_STATES = {"m": "base_places", "m/s": "base_velocities", "m/s^2": "base_accelerations"}
"""The same for the place of a base that floats."""


@dataclass(frozen=True)
class Box:
    """Bounds by name.

    Parameters
    ----------
    bounds : mapping from str to (float, float)
        As the scene states them.
    inputs : tuple of str
        Names of the scene's inputs.
    """

    bounds: Mapping[str, tuple[float, float]]
    inputs: tuple[str, ...]

    def key_of(self, variable: Variable) -> str | None:
        """Return the key that bounds a state variable or an input; None where there is no such key."""
        if variable.role is Role.INPUT:
            return variable.name
        held = [name for name in self.inputs if variable.name == f"held_{name}"]
        of_base = variable.name.startswith("base_")
        return held[0] if held else (BASE_STATES if of_base else STATES).get(variable.unit)

    def of(self, variable: Variable) -> tuple[float, float]:
        """Return the bounds of a state variable or an input."""
        key = self.key_of(variable)
        assert key is not None
        return self.bounds[key]

    def missing(self, program: Program) -> list[str]:
        """Return the keys that are needed and not stated.

        Raises
        ------
        UserError
            If the state has a variable that no key bounds.
        """
        keys: dict[str, None] = {}
        for variable in (*program.state, *program.inputs):
            key = self.key_of(variable)
            if key is None and variable.name.startswith("base_quaternion"):
                raise UserError(
                    f"{program.name}: the C of an arm in space whose base floats is not proved yet: [emit.box] has no "
                    "bounds for how it is turned. `tmm-gen check` without --prove compares it with all else."
                )
            if key is None:
                raise UserError(
                    f"{program.name}: [emit.box] has no key for the state's '{variable.name}' ({variable.unit}): "
                    "its linearisation or integrator keeps more than angles, rates and accelerations"
                )
            keys[key] = None
        return [key for key in keys if key not in self.bounds]


def box_of(scene: Scene) -> Box | None:
    """Return a scene's box, None where it states none."""
    if scene.emit.box is None:
        return None
    return Box(scene.emit.box, tuple(item.name for item in scene.inputs))


def complete_box(scene: Scene, program: Program) -> Box | None:
    """Return a scene's box if it bounds everything."""
    box = box_of(scene)
    if box is None:
        return None
    try:
        return None if box.missing(program) else box
    except UserError:
        return None
