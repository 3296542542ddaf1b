"""What sensors of an emitted controller are called, and what they measure."""

from __future__ import annotations

from tmm_gen.control.arm.motor_rows import Motors

_BEHIND = (
    ("tip accelerometer", "acceleration across the last link at the tip"),
    ("root strain gauge", "bending moment at the root"),
)
_UNITS = ("m/s^2", "N m")


def sensor_words(motors: Motors, number: int) -> tuple[str, str]:
    """Return name and unit of a sensor: of m encoders, then m accelerometers, then m strain gauges."""
    kind, motor = divmod(number, motors.count)
    name = motors.names[motor]
    if kind == 0:
        told = "hub" if motors.on_hub else f"'{name}'"
        return f"{told} encoder", f"{told} angle [rad]"
    (called, measured), unit = _BEHIND[kind - 1], _UNITS[kind - 1]
    if motors.on_hub:
        return called, f"{measured} [{unit}]"
    return f"{called} of '{name}'", f"{measured} of '{name}' [{unit}]"
