"""What rows of every kind say alike: places in words, inputs by place, motions to start from."""

from __future__ import annotations

from collections.abc import Sequence

import sympy as sp

from tmm_gen.row.row import Load, Parameter, Signal
from tmm_gen.scene import Input, Scene, station_of
from tmm_gen.scene.signal import kernel_names

UNITS = {"torque": "N m", "drive": "N m", "force_x": "N", "force_y": "N", "angle": "rad"}


def place(at: str | int, part: str = "") -> str:
    """Return a place in words: a part by its name where there is one."""
    if part:
        return f"'{part}'"
    return f"station {at}" if isinstance(at, int) else f"the {at}"


def signals_of(scene: Scene) -> tuple[Signal, ...]:
    """Return the inputs of a scene's row: a prescribed angle comes with its rate and its acceleration."""
    return tuple(signal for described in scene.inputs for signal in _signals(described))


def _signals(described: Input) -> tuple[Signal, ...]:
    if described.acts != "angle":
        doc = f"{described.acts} acting at {place(described.at, described.part)}"
        if described.acts == "drive":
            doc = f"torque of '{described.part}', between both sides; a motor's acts gear-fold"
        return (Signal(described.name, doc, UNITS[described.acts]),)
    names = kernel_names(described)
    return tuple(
        Signal(name, f"prescribed base {word}", unit)
        for name, (word, unit) in zip(names, BASE_MOTION, strict=True)
    )


BASE_MOTION = (("angle", "rad"), ("rate", "rad/s"), ("acceleration", "rad/s^2"))


def prescribed_of(scene: Scene) -> tuple[str, ...]:
    """Return the names of the inputs that move a prescribed base: angle, rate, acceleration."""
    return next((kernel_names(item) for item in scene.inputs if item.acts == "angle"), ())


def parameter(name: str, doc: str, unit: str, values: Sequence[float]) -> Parameter:
    """Return a parameter; one value where there is but one."""
    return Parameter(name, doc, unit, tuple(values))


def optional(name: str, doc: str, unit: str, value: float | None) -> Parameter | None:
    """Return a parameter where its value is not zero."""
    return Parameter(name, doc, unit, (value,)) if value else None


def symbol(found: Parameter | None) -> sp.Expr:
    """Return what stands for a parameter in elements, zero where there is none."""
    return found.symbol if found is not None else sp.Integer(0)


def loads_of(scene: Scene, components: tuple[str, ...]) -> dict[str, dict[str, Load]]:
    """Sort a scene's loads by where their element stands ("base", "station", "tail") and by component."""
    places: dict[tuple[str, str], list[tuple[int | None, str]]] = {}
    for described in scene.inputs:
        if described.acts in ("angle", "drive"):
            continue
        link = station_of(described.at, scene.stations)
        where = "base" if link == 0 else "tail" if link == scene.stations else "station"
        index = link - 1 if where == "station" else None
        places.setdefault((where, described.acts), []).append((index, described.name))
    names = {"base": "base_", "station": "load_", "tail": "tip_"}
    found: dict[str, dict[str, Load]] = {where: {} for where in names}
    for component in components:
        for where, prefix in names.items():
            if (where, component) in places:
                acting = tuple(sorted(places[where, component], key=lambda p: p[0] or 0))
                doc = f"external {component} on each link"
                load = Load(sp.Symbol(f"{prefix}{component}_"), doc, UNITS[component], acting)
                found[where][component] = load
    return found


def facts_of(scene: Scene, model: str, integrator_title: str, **more: str) -> dict[str, str]:
    """Return what headers say of a row, in reading order."""
    return {
        "model": model,
        "stations": str(scene.stations),
        "base": scene.base.kind,
        "integrator": integrator_title,
        **more,
        "sweep": scene.model.sweep,
        "unknown": scene.model.unknown,
    }


BOUNDARIES = {"clamp": "held", "motor": "free", "prescribed": "prescribed"}
"""What a scene's base does."""
