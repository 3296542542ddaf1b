"""What goes with the elastic gear of a motor, in a plane and in space."""

from __future__ import annotations

from collections.abc import Iterator

from tmm_gen.scene.parts.tables import MotorPart
from tmm_gen.scene.problem import Finding, Path
from tmm_gen.scene.spatial.tables import SpatialMotor


def broken_gears(motor: MotorPart | SpatialMotor, path: Path) -> Iterator[Finding]:
    """Find a rotor without inertia behind an elastic gear, and what damps a spring that is not there.

    Parameters
    ----------
    path : Path
        Where the motor stands in the file.
    """
    if motor.stiffness is not None and motor.rotor_inertia == 0.0:
        yield Finding(
            (*path, "rotor_inertia"),
            "is 0 or missing, and a rotor behind an elastic gear cannot turn without inertia",
            "Write `rotor_inertia = 1e-5`, or remove `stiffness` for a rigid gear.",
            motor.rotor_inertia,
        )
    if motor.stiffness is None and motor.damping_time:
        yield Finding(
            (*path, "damping_time"),
            "damps the spring of an elastic gear, and without `stiffness` the gear is rigid",
            "Write `stiffness` too, or remove the key: `damping` and `motor_damping` damp a rigid gear.",
            motor.damping_time,
        )
