"""The payload of an arm as its kernel has it: which of its parameters a mass at its end changes."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import replace

from tmm_gen.control.arm.arms import arm_of
from tmm_gen.control.arm.payload_body import beside_payload, payload_body
from tmm_gen.program.space.kernel_parameters import parameter_values
from tmm_gen.scene import Scene

_TIP = "tip_mass"


def payload_of(scene: Scene) -> float | None:
    """Return the mass of the body that is told to be the payload, kg, or at the end of an arm.

    In space that is of the outermost body; None if there are more.
    """
    if scene.spatial is None and not beside_payload(scene):
        return None if scene.tip is None else scene.tip.mass
    masses = tuple(arm_of(scene).payloads().values())
    weighs = len(masses) == 1 and (masses[0] > 0.0 or payload_body(scene) is not None)
    return masses[0] if weighs else None


def laden(scene: Scene, payload: float) -> Scene:
    """Return the scene of an arm with another payload, kg."""
    if scene.spatial is not None or beside_payload(scene):
        return scene.replace(**dict.fromkeys(arm_of(scene).payloads(), payload))
    assert scene.tip is not None
    return replace(scene, tip=scene.tip.model_copy(update={"mass": payload}))


def kept_out(scene: Scene, known: Collection[str]) -> tuple[str, ...]:
    """Return the parameters that another payload changes and a kernel of the scene has no number for.

    Parameters
    ----------
    scene : Scene
        With a payload.
    known : collection of str
        The parameters of the kernel. What is zero at a joint is among them, and not in its code.
    """
    payload = payload_of(scene)
    assert payload is not None
    changed = changed_parameters(scene, laden(scene, payload + 1.0))
    if scene.spatial is None:
        return tuple(set(changed) - set(known))
    before = parameter_values(scene.spatial)
    return tuple(name for name in changed if name not in known or not _value(before, name))


def _value(values: Mapping[str, tuple[float, ...]], name: str) -> float:
    parameter, _, place = name.rpartition("_")
    return values[parameter][int(place) - 1]


def changed_parameters(scene: Scene, other: Scene) -> dict[str, float]:
    """Return the parameters of the kernel in which one arm differs from another, as CasADi's module calls them."""
    if scene.spatial is None or other.spatial is None:
        assert other.tip is not None
        return {_TIP: other.tip.mass}
    before, after = parameter_values(scene.spatial), parameter_values(other.spatial)
    return {
        f"{name}_{place + 1}": value
        for name in before
        for place, value in enumerate(after[name])
        if value != before[name][place]
    }
