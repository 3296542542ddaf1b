"""The payload of an arm as its kernel has it: which of its parameters a mass at its end changes."""

from __future__ import annotations

from dataclasses import replace

from tmm_gen.control.arms import arm_of
from tmm_gen.program.space.kernel_parameters import parameter_values
from tmm_gen.scene import Scene

_TIP = "tip_mass"


def payload_of(scene: Scene) -> float | None:
    """Return the mass at the end of an arm, kg; in space of the outermost body, None if there are more."""
    if scene.spatial is None:
        return None if scene.tip is None else scene.tip.mass
    masses = tuple(arm_of(scene).payloads().values())
    return masses[0] if len(masses) == 1 and masses[0] > 0.0 else None


def laden(scene: Scene, payload: float) -> Scene:
    """Return the scene of an arm with another mass at its end, kg."""
    if scene.spatial is not None:
        return scene.replace(**dict.fromkeys(arm_of(scene).payloads(), payload))
    assert scene.tip is not None
    return replace(scene, tip=scene.tip.model_copy(update={"mass": payload}))


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
