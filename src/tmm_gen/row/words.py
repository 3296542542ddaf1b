"""What rows of every kind say alike: places in words, inputs by place, motions to start from."""

from __future__ import annotations

from collections.abc import Sequence

import sympy as sp

from tmm_gen.row.row import Boundary, Load, Parameter, Reading, Signal
from tmm_gen.scene import Input, Output, Scene, station_of
from tmm_gen.scene.columns import columns_of, place
from tmm_gen.scene.quantity import INPUT_UNITS
from tmm_gen.scene.signal import kernel_names


def signals_of(scene: Scene) -> tuple[Signal, ...]:
    """Return the inputs of a scene's row: a prescribed angle comes with its rate and its acceleration."""
    return tuple(signal for described in scene.inputs for signal in _signals(described))


def _signals(described: Input) -> tuple[Signal, ...]:
    if described.acts != "angle":
        doc = f"{described.acts} acting at {place(described.at, described.part)}"
        if described.acts == "drive":
            doc = f"torque of '{described.part}', between both sides; a motor's acts gear-fold"
        return (Signal(described.name, doc, INPUT_UNITS[described.acts]),)
    names = kernel_names(described)
    return tuple(
        Signal(name, f"prescribed base {word}", unit)
        for name, (word, unit) in zip(names, BASE_MOTION, strict=True)
    )


BASE_MOTION = (("angle", "rad"), ("rate", "rad/s"), ("acceleration", "rad/s^2"))


def prescribed_of(scene: Scene) -> tuple[str, ...]:
    """Return the names of the inputs that move a prescribed base: angle, rate, acceleration."""
    return kernel_names(scene.prescribed) if scene.prescribed else ()


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
                load = Load(sp.Symbol(f"{prefix}{component}_"), doc, INPUT_UNITS[component], acting)
                found[where][component] = load
    return found


def reading_of(scene: Scene, output: Output, title: str, sign: int) -> Reading:
    """Return how an output is read off a row.

    Parameters
    ----------
    title : str
        For readers of the generated code; readings of the same title stand together.
    sign : int
        Of a joint's own torque, positive where the joint is bent toward positive angles.
    """
    quantity = scene.quantity(output)
    station = station_of(output.at, scene.stations)
    if quantity.in_joint:  # at the tip of an arm with a body there, beyond the last joint
        station = scene.stations + 1 if output.at == "tip" else max(station, int(not scene.parts))
    targets = tuple(Signal(column.name, column.what, column.unit) for column in columns_of(scene, output))
    kind = "" if quantity.in_joint or quantity.read == "through" else quantity.energy or "qva"[quantity.order]
    if quantity.read == "through":
        return Reading(title, targets, "own", station)
    inner = scene.inner(station) if quantity.read == "bend" else 0
    return Reading(title, targets, quantity.read, station, kind, sign if quantity.read == "own" else 1, inner)


def boundary_of(scene: Scene) -> Boundary:
    """Return what a scene's base does in the integrated coordinate."""
    return "free" if scene.hub else "prescribed" if scene.prescribed else "held"


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
