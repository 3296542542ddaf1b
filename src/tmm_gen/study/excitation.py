"""What moves the arm during a study: loads that are smooth after the start, so that orders show.

A load that jumps or kinks on the way would cut every integrator down to the first or second order, and the study
would compare nothing but how they meet the kink. Amplitudes follow from the scene: a joint torque that turns the arm
by about a radian, a force that does the same by its lever, a base that is moved by one radian. What loads do to arms
in space, and to those that float, :mod:`tmm_gen.study.turning_loads` tells by their motion from rest.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from tmm_gen.errors import UserError
from tmm_gen.inputs.clock import refuse_other_clock
from tmm_gen.inputs.curve import Curve
from tmm_gen.inputs.signals import Constant, Signal, Sine, Table
from tmm_gen.modal.limbs import limbs_of
from tmm_gen.reference.duration import default_duration
from tmm_gen.scene import Input, Output, Scene, station_of
from tmm_gen.scene.spatial.arm import ArmOutput, SpatialArm
from tmm_gen.simulate.prescribed import prescribed
from tmm_gen.study.rise import Rise
from tmm_gen.study.turning_loads import turning_loads

_TURN = 1.0
"""rad; what an input does to the arm, about."""

_SHORTEST, _LONGEST = 1e-12, 1e12
"""s; beyond these, numbers that are derived from a time run out of range."""

_SWINGS = 1.5
"""Periods of the first load over the whole time; of the next half as many more, and so on."""


@dataclass(frozen=True)
class Excitation:
    """What the arm goes through, and what is looked at.

    Parameters
    ----------
    signals : mapping from str to Signal
        Inputs by name.
    until : float
        Time simulated, s.
    output : str
        Output that errors are measured at.
    """

    signals: Mapping[str, Signal]
    until: float
    output: str

    def told(self, scene: Scene) -> list[str]:
        """Say in words what the arm goes through, one line for each load."""
        lines = [f"{name}: {_words(signal)}" for name, signal in self.signals.items()]
        if gravity := _gravity(scene):
            lines.append(f"gravity of {gravity:g} m/s^2")
        if _initial(scene):
            lines.append("the scene's initial motion")
        return lines or ["nothing"]


def excitation(
    scene: Scene,
    given: Mapping[str, Signal] | None = None,
    until: float | None = None,
    output: str | None = None,
) -> Excitation:
    """Return what a scene goes through in a study.

    Parameters
    ----------
    scene : Scene
        What is computed.
    given : mapping from str to Signal, optional
        Inputs that the user gives; others are then zero. Without any, all inputs act as described above.
    until : float, optional
        s; by default five slow periods.
    output : str, optional
        Output that errors are measured at; by default place or angle of the tip, or the first output.

    Raises
    ------
    UserError
        If there is no such output, nothing moves, the time is absurd, an input has another clock, or a prescribed
        angle jumps.
    """
    duration = until or default_duration(scene)
    if not _SHORTEST <= duration <= _LONGEST:
        raise UserError(
            f"--until {duration:g}: simulate between {_SHORTEST:g} and {_LONGEST:g} s; a few slow periods tell most."
        )
    signals = prescribed(scene, given, duration) if given else _default_signals(scene, duration)
    refuse_other_clock(signals, duration)
    chosen = Excitation(signals, duration, _output(scene, output).name)
    moving = any(not isinstance(signal, Constant) or signal.value for signal in signals.values())
    if not (moving or _initial(scene) or _gravity(scene)):
        raise UserError(
            f"scene '{scene.name}': nothing moves: there is no load, no gravity and no initial motion. "
            "Add an [[input]] or [initial] to it."
        )
    return chosen


def unit(scene: Scene, output: str) -> str:
    """Return the unit of an output."""
    return scene.quantity(_output(scene, output)).unit


def columns(scene: Scene, output: str) -> tuple[str, ...]:
    """Return the columns of an output: one, or two of a vector."""
    return scene.quantity(_output(scene, output)).columns(output)


def _output(scene: Scene, name: str | None) -> Output:
    if name is not None:
        for item in scene.outputs:
            if item.name == name:
                return item
        names = ", ".join(item.name for item in scene.outputs)
        raise UserError(f"--output {name}: no such output; choose from {names}.")
    if not scene.outputs:
        raise UserError(f"scene '{scene.name}' has no [[output]] to measure errors at. Add one.")
    if scene.spatial is not None:
        return _farthest(scene, scene.spatial)
    at_tip = [item for item in scene.outputs if item.at == "tip"]
    for wanted in ("place", "motion"):
        for item in at_tip:
            quantity = scene.quantity(item)
            if quantity.read == wanted and quantity.order == 0:
                return item
    return (at_tip or list(scene.outputs))[0]


def _farthest(scene: Scene, arm: SpatialArm) -> Output:
    """Return the place of the part that is farthest out, or the first output."""
    places = [k for k, item in enumerate(scene.outputs) if scene.quantity(item).unit == "m"]
    return scene.outputs[max(places, key=lambda k: _station(arm.outputs[k])) if places else 0]


def _station(output: ArmOutput) -> int:
    return output.frame.joint if output.frame is not None else 0


def _gravity(scene: Scene) -> float:
    """Return the size of gravity, m/s^2; 0 without."""
    return math.hypot(*scene.spatial.gravity) if scene.spatial else scene.model.gravity or 0.0


def _initial(scene: Scene) -> bool:
    """Whether the arm starts moved or moving."""
    if scene.spatial is not None:
        base = scene.spatial.base
        afloat = base is not None and any((*base.velocity, *base.rate))
        return afloat or any(joint.angle or joint.rate for joint in scene.spatial.joints)
    return any(scene.initial.angles) or any(scene.initial.rates)


def _default_signals(scene: Scene, until: float) -> dict[str, Signal]:
    frequency = 2.0 * math.pi * _SWINGS / until
    frequencies = {item.name: frequency * (1.0 + 0.5 * k) for k, item in enumerate(scene.inputs)}
    if scene.spatial is not None or scene.floats:
        given = {item.name: _TURN if item.acts == "angle" else _TURN * scene.reach for item in scene.motions}
        acting = {name: frequency for name, frequency in frequencies.items() if name not in given}
        sizes = turning_loads(scene, acting, until, _TURN)
        rise: dict[str, Signal] = {name: Rise(way, 0.5 * until) for name, way in given.items()}
        return rise | {name: Sine(_rounded(size), acting[name]) for name, size in sizes.items()}
    return {item.name: _signal(scene, item, frequencies[item.name], until) for item in scene.inputs}


def _signal(scene: Scene, item: Input, frequency: float, until: float) -> Signal:
    if item.acts == "angle":
        return Rise(_TURN, 0.5 * until)
    if item.acts == "drive" and isinstance(item.at, int):
        torque = _torque(scene, frequency, item.at)
        return Sine(_rounded(torque / scene.joints[item.at - 1].gear), frequency)
    at = station_of(item.at, scene.stations)
    if scene.model.in_plane and (joint := _free_before(scene, at)):
        # a joint that nothing holds turns by what is beyond it, however heavy the arm is before it
        torque = _against(_inertia_beyond(scene, joint), scene.joints[joint - 1].damping, frequency)
        return Sine(
            _rounded(torque if item.acts == "torque" else torque / _lever(scene, joint, at)), frequency
        )
    torque = _torque(scene, frequency) * ((1.0, *scene.turns)[at] / item.factor) ** 2
    return Sine(_rounded(torque if item.acts == "torque" else torque / (scene.reach or 1.0)), frequency)


def _free_before(scene: Scene, link: int) -> int:
    """Return the outermost joint without a spring on the way to a link, 1 to n; 0 where springs hold all."""
    while link and scene.joints[link - 1].stiffness > 0.0:
        link = scene.host(link)
    return link


def _lever(scene: Scene, joint: int, link: int) -> float:
    """Return the length from a joint to the outer end of a link beyond it, m."""
    length = scene.links[link - 1].length
    while link != joint:
        link = scene.host(link)
        length += scene.links[link - 1].length
    return length or 1.0


def _torque(scene: Scene, frequency: float, joint: int = 0) -> float:
    """Return a torque, N m, that turns the arm by about `_TURN`, against its springs, or inertia and damper where free.

    A torque in a joint turns what is beyond the joint. With gears it is that on the base's shaft.
    """
    if not scene.hub and all(joint.stiffness > 0.0 for joint in scene.joints):
        softness = np.array([t * t / j.stiffness for t, j in zip(scene.turns, scene.joints, strict=True)])
        return _TURN / float(np.max(limbs_of(scene).outward(softness)))
    if joint:
        return _against(_inertia_beyond(scene, joint), scene.joints[joint - 1].damping, frequency)
    return _against(_inertia_about_base(scene), scene.base.damping, frequency)


def _against(inertia: float, damping: float, frequency: float) -> float:
    """Return the amplitude of a torque that swings an inertia on a damper by `_TURN`, N m."""
    return math.hypot(inertia * frequency**2, damping * frequency) * _TURN


def _inertia_about_base(scene: Scene) -> float:
    inertia = scene.base.inertia
    for number, joint in enumerate(scene.joints, start=1):
        inertia += joint.armature if scene.host(number) else _inertia_beyond(scene, number)
    return inertia


def _inertia_beyond(scene: Scene, joint: int) -> float:
    """Return the inertia about a joint, 1 to n, of its rotor and the straight arm beyond, kg m^2."""
    inertia, ways = scene.joints[joint - 1].armature, {joint: 0.0}
    for number, link in enumerate(scene.links[joint - 1 :], start=joint):
        way = ways.get(number if number == joint else scene.host(number))
        if way is None:  # the next branch
            break
        own = link.inertia / scene.turns[number - 1] ** 2
        inertia += own + link.mass * (way + link.center * link.length) ** 2
        ways[number] = way + link.length
    tip, way = scene.tip, ways[max(ways)]
    return inertia + (tip.mass * way**2 + tip.inertia if tip else 0.0)


def _rounded(value: float) -> float:
    return float(f"{value:.1g}")


def _words(signal: Signal) -> str:
    if isinstance(signal, Constant):
        return f"{signal.value:g}, constant"
    if isinstance(signal, Sine):
        shape = "cos" if signal.phase else "sin"
        return f"{signal.amplitude:g} {shape}({signal.frequency:.4g} t)"
    if isinstance(signal, Rise):
        return f"rises smoothly from 0 to {signal.amplitude:g} in {signal.duration:g} s, then stays"
    if isinstance(signal, Table | Curve):
        return f"a table of {len(signal.times)} rows"
    return "as given"
