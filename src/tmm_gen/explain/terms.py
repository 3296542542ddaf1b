"""Terms a scene may have or not: whether it has them, why, and the same scene with the term put in or taken out."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

from tmm_gen.scene import Input, Output, Scene, station_of
from tmm_gen.scene.beam import Tip
from tmm_gen.scene.model import Base
from tmm_gen.scene.signal import Acts, Of

Change = Callable[[Scene], Scene]

_MORE = 1e-3
"""By how much stations are made to differ, relatively: any difference needs an array."""


@dataclass(frozen=True)
class Term:
    """A term of the model.

    Parameters
    ----------
    name : str
        In a few words.
    modelled : bool
        Whether the scene has it.
    why : str
        What in the scene says so.
    other : callable
        Makes the scene with the term put in, or taken out if it is modelled.
    """

    name: str
    modelled: bool
    why: str
    other: Change


def terms_of(scene: Scene) -> list[Term]:
    """Return the terms of a scene, in the order of its file."""
    found = [_joint_damping(scene), *_base(scene)]
    if scene.parts:  # by their nature unlike
        found += [*_gears(scene), *_motors(scene)]
    else:
        found[1:1] = [_alike_joints(scene), _alike_links(scene)]
    planar = scene.model.in_plane
    if planar:
        found = [_gravity(scene), _iterations(scene), *found, *([] if scene.hosts else _tip(scene))]
        if not scene.emit.sensitivities:  # neither has derivatives
            if scene.model.iterates and not scene.coupled:
                found.insert(2, _corrections(scene))
            found.append(_heat(scene))
    return [*found, _inputs(scene, planar), _outputs(scene, planar)]


def _gravity(scene: Scene) -> Term:
    g = scene.model.gravity
    why = f"model.gravity = {g:g}" if g else "no model.gravity"
    return Term("gravity", bool(g), why, lambda s: _with_model(s, gravity=None if g else 9.81))


def _iterations(scene: Scene) -> Term:
    count = scene.sweeps
    why = f"model.iterations = {count}"
    changed = 1 if count > 1 else 2
    return Term("a second sweep in each stage", count > 1, why, lambda s: _with_model(s, iterations=changed))


def _corrections(scene: Scene) -> Term:
    count = scene.model.corrections
    why = f"model.corrections = {count}" if count else "no model.corrections"
    changed = count - 1 if count else 1
    name = f"{'the last' if count > 1 else 'a'} correction in each stage"
    return Term(name, count > 0, why, lambda s: _with_model(s, corrections=changed))


def _joint_damping(scene: Scene) -> Term:
    damped = sum(joint.damping > 0.0 for joint in scene.joints)
    if damped:
        why = f"{damped} of {scene.stations} joints have a damper"
        return Term("joint damping", True, why, lambda s: _with_damping(s, 0.0))
    why = "no joint has damping" + (", no beam.damping_time" if scene.beam else "")
    return Term("joint damping", False, why, lambda s: _with_damping(s, _MORE))


def _with_damping(scene: Scene, time: float) -> Scene:
    # a joint that turns freely has no stiffness to be damped by
    joints = tuple(j.model_copy(update={"damping": time * (j.stiffness or 1.0)}) for j in scene.joints)
    return replace(scene, joints=joints)


def _alike_joints(scene: Scene) -> Term:
    unlike = len({(j.stiffness, j.damping) for j in scene.joints}) > 1
    why = "joints differ: an array of each number" if unlike else "joints are identical: one number for all"

    def other(s: Scene) -> Scene:
        if unlike:
            return replace(s, joints=s.joints[:1] * s.stations)
        return replace(s, joints=_spread(s.joints, ("stiffness", "damping")))

    return Term("joints of their own", unlike, why, other)


def _alike_links(scene: Scene) -> Term:
    names = ("inertia", "mass", "length", "center")  # a chain takes notice of the inertia alone
    unlike = len({tuple(getattr(link, name) for name in names) for link in scene.links}) > 1
    why = "links differ: an array of each number" if unlike else "links are identical: one number for all"

    def other(s: Scene) -> Scene:
        if unlike:
            return replace(s, links=s.links[:1] * s.stations)
        return replace(s, links=_spread(s.links, names))

    return Term("links of their own", unlike, why, other)


def _gears(scene: Scene) -> list[Term]:
    """Return joints whose sides turn by a ratio, beside joints without."""
    geared = sum(joint.ratio != 1.0 for joint in scene.joints)
    plain = tuple(joint.model_copy(update={"ratio": 1.0}) for joint in scene.joints)
    why = f"{geared} of {scene.stations} joints have gears beside them or are teeth"
    return [Term("ratios of gears", True, why, lambda s: replace(s, joints=plain))] if geared else []


def _motors(scene: Scene) -> list[Term]:
    """Return each motor, driven joint and slack angle, beside a joint without."""
    found = []
    for part in scene.parts:
        if not part.joint:
            continue
        joint = scene.joints[part.joint - 1]
        driven = any(i.acts == "drive" and i.at == part.joint for i in scene.inputs)
        if part.kind == "motor" or driven or joint.rest:
            what = (
                f"gear = {joint.gear:g}, {joint.armature:.4g} kg m^2 at the joint"
                if part.kind == "motor"
                else ""
            )
            told = [*([what] if what else []), *([f"rest = {joint.rest:g}"] if joint.rest else [])]
            told += ["a torque acts in it"] if driven else []
            name = f"motor '{part.name}'" if part.kind == "motor" else f"what is in joint '{part.name}'"
            found.append(
                Term(f"{name} in place of a plain joint", True, ", ".join(told), _plain_joint(part.joint))
            )
    return found


def _plain_joint(number: int) -> Change:
    def other(s: Scene) -> Scene:
        plain = s.joints[number - 1].model_copy(update={"rest": 0.0, "rotor_inertia": 0.0, "gear": 1.0})
        inputs = tuple(i for i in s.inputs if i.acts != "drive" or i.at != number)
        return replace(s, joints=(*s.joints[: number - 1], plain, *s.joints[number:]), inputs=inputs)

    return other


def up_to(scene: Scene, station: int) -> Scene:
    """Return the inner part of an arm, with what acts and is measured there."""
    n = scene.stations
    initial = replace(
        scene.initial, angles=scene.initial.angles[:station], rates=scene.initial.rates[:station]
    )
    return replace(
        scene,
        joints=scene.joints[:station],
        links=scene.links[:station],
        hosts=scene.hosts[:station],
        tip=scene.tip if station == n else None,
        inputs=tuple(i for i in scene.inputs if station_of(i.at, n) <= station),
        outputs=tuple(o for o in scene.outputs if o.at == "arm" or station_of(o.at, n) <= station),
        initial=initial,
    )


def _spread(stations: tuple[Any, ...], names: tuple[str, ...]) -> tuple[Any, ...]:
    """Return stations that are all a little different."""
    return tuple(
        each.model_copy(
            update={name: getattr(each, name) * (1.0 + _MORE * k / len(stations)) for name in names}
        )
        for k, each in enumerate(stations)
    )


def _base(scene: Scene) -> list[Term]:
    hub = "a hub that turns"
    if not scene.base.moves:
        return [Term(hub, False, 'base.kind = "clamp"', lambda s: _with_base(s, kind="motor", inertia=1.0))]
    hub = "a base that floats" if scene.floats else hub
    found = [Term(hub, True, f'base.kind = "{scene.base.kind}"', _clamped)]
    if scene.hub and not scene.floats:
        c = scene.base.damping
        why = f"base.damping = {c:g}" if c else "no base.damping"
        found.append(
            Term("friction of the hub", c > 0.0, why, lambda s: _with_base(s, damping=0.0 if c else 1.0))
        )
    return found


def _clamped(scene: Scene) -> Scene:
    """Return the scene on a clamp, without what acts on the hub or is read off it."""
    inputs = tuple(i for i in scene.inputs if i.at != "base")
    outputs = tuple(o for o in scene.outputs if o.at != "base" or scene.quantity(o).in_joint)
    clamp = Base.model_construct(kind="clamp", inertia=0.0, damping=0.0)
    return replace(scene, inputs=inputs, outputs=outputs, base=clamp)


def _tip(scene: Scene) -> list[Term]:
    found = []
    for what in ("mass", "inertia"):
        value = getattr(scene.tip, what) if scene.tip else 0.0
        why = f"{_key_at_tip(scene, what)} = {value:g}" if value else f"no {_key_at_tip(scene, what)}"
        found.append(Term(f"{what} at the tip", value > 0.0, why, _tip_changed(what, 0.0 if value else 1.0)))
    return found


def _key_at_tip(scene: Scene, what: str) -> str:
    """Return what the file calls a number of the tip: of [tip], or of the bodies on the last part."""
    if not scene.parts:
        return f"tip.{what}"
    last = scene.parts[-1].last
    bodies = [f"'{part.name}'" for part in scene.parts if part.kind == "body" and part.last == last]
    return f"{what} of {' and '.join(bodies)}" if bodies else f"[[body]] with {what} on the last part"


def _tip_changed(what: str, value: float) -> Change:
    return lambda s: replace(s, tip=(s.tip or Tip()).model_copy(update={what: value}))


def _heat(scene: Scene) -> Term:
    asked = any(scene.quantity(o).accumulates for o in scene.outputs)
    damped = any(j.damping for j in scene.joints) or scene.base.damping > 0.0
    why = "an output asks for it" if asked else "no output of dissipated_energy"
    if not damped:
        why += ", and nothing turns energy to heat"

    def other(s: Scene) -> Scene:
        if asked:
            return replace(s, outputs=tuple(o for o in s.outputs if not s.quantity(o).accumulates))
        return replace(s, outputs=(*s.outputs, Output(name="explain_heat", at="arm", of="dissipated_energy")))

    return Term("counting energy turned to heat", asked and damped, why, other)


def _inputs(scene: Scene, planar: bool) -> Term:
    n = scene.stations
    taken = {station_of(i.at, n) for i in scene.inputs if i.acts != "drive"}
    missing = [k for k in range(1, n + 1) if k not in taken]
    acts: tuple[Acts, ...] = ("torque", "force_x", "force_y") if planar else ("torque",)
    what = "torques and forces" if len(acts) > 1 else "torques"

    def other(s: Scene) -> Scene:
        new = tuple(Input(name=f"explain_{a}_{k}", at=k, acts=a) for k in missing for a in acts)
        return replace(s, inputs=(*s.inputs, *new))

    why = f"no [[input]] at {len(missing)} of {n} links"
    return Term(f"{what} on links without an input", False, why, other)


def _outputs(scene: Scene, planar: bool) -> Term:
    n = scene.stations
    kinds: tuple[Of, ...] = ("position", "velocity", "torque")
    if not planar:
        kinds = ("angle", "velocity", "acceleration", "torque")
    asked = {(station_of(o.at, n), o.of) for o in scene.outputs}
    missing = [(k, of) for k in range(1, n + 1) for of in kinds if (k, of) not in asked]

    def other(s: Scene) -> Scene:
        new = tuple(Output(name=f"explain_{of}_{k}", at=k, of=of) for k, of in missing)
        return replace(s, outputs=(*s.outputs, *new))

    why = f"the scene has {len(scene.outputs)} [[output]]s"
    return Term(f"{', '.join(kinds)} of every link as outputs", False, why, other)


def _with_model(scene: Scene, **update: object) -> Scene:
    return replace(scene, model=scene.model.model_copy(update=update))


def _with_base(scene: Scene, **update: object) -> Scene:
    return replace(scene, base=scene.base.model_copy(update=update))
