"""Which bodies of an arm are its payload."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from tmm_gen.scene import Scene


def payload_body(scene: Scene) -> str | None:
    """Return the name of the body that is told to be the payload; None where those outermost are."""
    return None if scene.control is None else scene.control.payload_body


def payload_words(scene: Scene) -> str:
    """Return what the mass of the payload is called."""
    told = payload_body(scene)
    return "mass at the tip" if told is None else f"mass of '{told}'"


def tip_bodies(scene: Scene) -> Mapping[str, float]:
    """Return the masses of the bodies at the tip of an arm of parts in a plane, by their names, kg."""
    names = [part.name for part in scene.parts if part.kind == "body" and part.last == scene.stations]
    entries: Any = scene.source.data.get("body", [])
    masses = {entry["name"]: entry["mass"] for entry in entries if "mass" in entry}
    return {name: masses[name] for name in names if name in masses}


def beside_payload(scene: Scene) -> float:
    """Return what other bodies weigh at the tip of an arm in a plane, where one of them is the payload, kg."""
    told = payload_body(scene)
    return 0.0 if told is None else sum(mass for name, mass in tip_bodies(scene).items() if name != told)
