"""An arm with another payload: at its tip, the body told to be it or the last of its file, or a chain's last link."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any

from tmm_gen.derive.integrators.declaration import Integrator
from tmm_gen.program.space.layout import layout_of
from tmm_gen.row.scene import row_of
from tmm_gen.scene import Scene

FACTORS = (0.1, 0.25, 0.5, 0.75, 1.0, 1.5, 2.0, 3.0, 5.0)
"""Of the scene's payload, of which the middle one is itself."""


@dataclass(frozen=True)
class Payload:
    """What a slider changes.

    Parameters
    ----------
    value : float
        The scene's, in `unit`.
    unit : str
        "kg" or "kg m^2".
    keys : dict from str to object
        The scene's numbers by key of its file; none for the last link of a chain.
    """

    value: float
    unit: str
    keys: dict[str, Any]


def payload_of(scene: Scene) -> Payload | None:
    """Return the payload of a scene; None where it has none."""
    if scene.model.linear:
        return Payload(scene.links[-1].inertia, "kg m^2", {})
    data: Mapping[str, Any] = scene.source.data
    places = [("tip", data["tip"])] if data.get("tip") else []
    places += [(f"body.{k}", body) for k, body in reversed(list(enumerate(data.get("body", ()), start=1)))]
    told = None if scene.control is None else scene.control.payload_body
    for place, table in places:
        if told not in (None, table.get("name")):
            continue
        if isinstance(mass := table.get("mass"), int | float) and mass > 0:
            keys = {f"{place}.{key}": table[key] for key in ("mass", "inertia") if key in table}
            return Payload(float(mass), "kg", keys)
    return None


def with_payload(scene: Scene, payload: Payload, factor: float) -> Scene:
    """Return a scene whose payload is so many times as heavy."""
    if not payload.keys:
        last = scene.links[-1]
        return replace(
            scene, links=(*scene.links[:-1], last.model_copy(update={"inertia": factor * last.inertia}))
        )
    return scene.replace(**{key: _times(factor, value) for key, value in payload.keys.items()})


def _times(factor: float, value: Any) -> Any:
    return [factor * each for each in value] if isinstance(value, list | tuple) else factor * value


def parameter_values(scene: Scene, integrator: Integrator) -> dict[str, tuple[float, ...]]:
    """Return the values of a scene's parameters by name: one for each station, or a single one."""
    return dict(_values(scene, integrator))


def _values(scene: Scene, integrator: Integrator) -> Iterator[tuple[str, tuple[float, ...]]]:
    if scene.spatial is None:
        yield from ((each.name, each.values) for each in row_of(scene, integrator).parameters)
        return
    layout = layout_of(scene.spatial, scene.name, scene.title, integrator, scene.integrator.step)
    of_base = layout.base.parameters.values() if layout.base else ()
    for variable in (*layout.parameters.values(), *of_base):
        value = variable.default
        yield variable.name, value if isinstance(value, tuple) else (float(value or 0.0),)
