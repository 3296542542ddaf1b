"""A prescribed base: what drives it, what cannot, and what is said of it.

Kernels take angle, rate and acceleration, and the same of places in space. An angle that jumps is none of a base: its
rate would be infinite, and the damper of joint 1 with it. A rate that jumps is, where springs and dampers alone stand
on the base: the torque in joint 1 is finite. Masses that move with the base, and rotors, would be struck.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tmm_gen.errors import UserError
from tmm_gen.inputs.curve import Curve, through
from tmm_gen.inputs.signals import Constant, Signal, Table
from tmm_gen.inputs.waveforms import Step
from tmm_gen.reference.duration import default_duration
from tmm_gen.scene import Input, Scene
from tmm_gen.scene.quantity import INPUT_UNITS
from tmm_gen.scene.signal import PRESCRIBED, kernel_names, said

Array = NDArray[np.float64]

_FEW = 5
"""Steps that a way between two corners must take, so that the step sees a way and no jump."""

_FITS = 1e-2
"""The base may start beside the arm by this share of how far it goes: records begin where they were switched on."""

_SHOWN = 3
"""Corners that are named; of more, the number."""


@dataclass(frozen=True)
class Derivative:
    """The rate or the acceleration of an input, as an input of its own.

    Parameters
    ----------
    of : Signal
        The input.
    order : {1, 2}
        First or second derivative.
    """

    of: Signal
    order: int

    @property
    def knots(self) -> Array:
        """Those of the input."""
        return self.of.knots

    @property
    def ends(self) -> float:
        """As the input."""
        return self.of.ends

    def at(self, time: ArrayLike) -> Array:
        """Return the derivatives at instants."""
        return self.of.slope(time) if self.order == 1 else self.of.curvature(time)


def kernel_signals(scene: Scene, signals: Mapping[str, Signal]) -> dict[str, Signal | Derivative]:
    """Return what a scene's kernel takes for its inputs: what moves a base with rate and acceleration.

    Parameters
    ----------
    scene : Scene
        Whose kernel.
    signals : mapping from str to Signal
        Inputs by name; those not given are left out.
    """
    found: dict[str, Signal | Derivative] = {}
    for item in scene.inputs:
        if item.name not in signals:
            continue
        signal = _moving(signals[item.name]) if item.acts in PRESCRIBED else signals[item.name]
        for order, name in enumerate(kernel_names(item)):
            if order == 0:
                found[name] = signal
            else:
                found[name] = Constant(0.0) if isinstance(signal, Constant) else Derivative(signal, order)
    return found


def _moving(signal: Signal) -> Signal:
    return through(signal) if isinstance(signal, Table) else signal


def prescribed(scene: Scene, signals: Mapping[str, Signal], until: float) -> dict[str, Signal]:
    """Return the inputs of a scene, those of a prescribed base as motions that a base can make.

    Parameters
    ----------
    scene : Scene
        With the step it is computed at.
    signals : mapping from str to Signal
        Inputs by name.
    until : float
        How long the base moves, s.

    Raises
    ------
    UserError
        If one jumps, on the way or where the arm starts, or its rate does where that strikes masses or rotors.
    """
    found = dict(signals)
    for item in scene.motions:
        signal = _moving(signals.get(item.name, Constant(0.0)))
        if isinstance(signal, Step) and signal.before != signal.after and signal.instant > 0.0:
            raise UserError(_jumps(scene, item, signal.before, signal.after, signal.instant, "", ""))
        if isinstance(signal, Curve):
            _refuse_jumps(scene, item, signal)
            if _struck(scene):
                _refuse_blows(scene, item, signal, until)
        _refuse_start(scene, item, signal)
        if item.name in signals:
            found[item.name] = signal
    return found


def _refuse_jumps(scene: Scene, item: Input, curve: Curve) -> None:
    """Refuse a way between two corners that takes but a few steps."""
    step, corners = scene.integrator.step, dict(curve.corners)
    for row in corners:
        span = curve.times[row + 1] - curve.times[row] if row + 1 in corners else np.inf
        if span >= _FEW * step * (1.0 - 1e-9):
            continue
        table = curve.table
        before, after = table.values[row], table.values[row + 1]
        smaller = float(f"{span / _FEW:.1g}")
        smaller = smaller if smaller <= span / _FEW else 0.5 * smaller
        others = f", rows at least {_FEW} steps apart, or a smaller step, --step {smaller:.3g}"
        within = f" within {span:.3g} s"
        where = f" ({table.row(row + 1)})" if table.lines else ""
        raise UserError(
            _jumps(scene, item, before, after, float(table.times[row]), within, others, where=where)
        )


def _struck(scene: Scene) -> bool:
    """Whether masses move with the base, as in space, or rotors turn against it."""
    on_base = (joint for k, joint in enumerate(scene.joints, start=1) if not scene.inner(k))
    return scene.spatial is not None or any(joint.rotor_inertia for joint in on_base)


def _refuse_blows(scene: Scene, item: Input, curve: Curve, until: float) -> None:
    """Refuse a rate that jumps on the way; a base that moves when the clock starts had the arm with it before."""
    for row, jump in curve.corners:
        instant, table = float(curve.times[row]), curve.table
        if not 0.0 < instant < until:
            continue
        where = f" ({table.row(row)})" if table.lines else ""
        way = _way(
            scene, item, float(table.values[0]), float(table.values[-1]), max(0.0, float(curve.times[0]))
        )
        raise UserError(
            f"scene '{scene.name}', input '{item.name}'{where}: the rate of the prescribed base jumps by {jump:+.3g} "
            f"{INPUT_UNITS[item.acts]}/s at t = {instant:.6g} s, which strikes what moves with it: a force without "
            f"bounds. Use a smooth way, --input {way}, or give rows that round the corner off."
        )


def _jumps(
    scene: Scene,
    item: Input,
    before: float,
    after: float,
    instant: float,
    within: str,
    others: str,
    *,
    where: str = "",
) -> str:
    """Say that a base cannot jump, and what it can."""
    return (
        f"scene '{scene.name}', input '{item.name}'{where}: the {said(item.acts)} of the prescribed base jumps from "
        f"{before:.6g} to {after:.6g} {INPUT_UNITS[item.acts]}{within} at t = {instant:.6g} s, and no base can. "
        f"Use a smooth way, --input {_way(scene, item, before, after, instant)}{others}."
    )


def _way(scene: Scene, item: Input, before: float, after: float, instant: float) -> str:
    """Return a profile that goes there in a time that suits the arm: half a slow period, and many steps."""
    duration = max(0.1 * default_duration(scene), 100.0 * scene.integrator.step)
    start = f":{instant:.6g}s" if instant else ""
    return f"{item.name}=smooth:{before:.6g}:{after:.6g}:{duration:.2g}s{start}"


def _refuse_start(scene: Scene, item: Input, signal: Signal) -> None:
    """Refuse a base that stands elsewhere than a straight arm at rest at the beginning."""
    angles = scene.initial.angles
    # in space angles are those of joints, whatever the base does; bent at first: as the scene says
    if scene.spatial is not None or np.ptp(angles) > 0.0:
        return
    start, arm = float(signal.at(0.0)), float(angles[0])
    way = np.abs(signal.at(np.concatenate([signal.knots, [0.0]])) - start)
    if abs(start - arm) <= max(_FITS * float(np.max(way)), 1e-9 * max(abs(start), abs(arm))):
        return
    profile = ""
    if isinstance(signal, Constant | Step):
        profile = f", or use a smooth way, --input {_way(scene, item, arm, start, 0.0)}"
    raise UserError(
        f"scene '{scene.name}', input '{item.name}': the prescribed base starts at {start:.6g} rad and the arm at "
        f"{arm:.6g} rad: joint 1 would strike. Start the arm there, --set initial.angles={start:.6g}{profile}."
    )


def followed(scene: Scene, signals: Mapping[str, Signal], until: float) -> Iterator[str]:
    """Yield what there is to say of how tables of a prescribed base are followed, in sentences."""
    for item in scene.motions:
        if isinstance(curve := signals.get(item.name), Curve):
            yield from _followed(item, curve, until, struck=_struck(scene))


def _followed(item: Input, curve: Curve, until: float, *, struck: bool) -> Iterator[str]:
    last = len(curve.times) - 1
    corners = [
        (float(curve.times[row]), jump)
        for row, jump in curve.corners
        if 0.0 <= curve.times[row] < until * (1.0 - 1e-9) or (row < last and curve.times[row] < until)
    ]
    if not corners:
        return
    if struck:  # no other is left
        ((_, jump),) = corners
        yield f"{item.name} moves the base at {jump:+.3g} {INPUT_UNITS[item.acts]}/s when the clock starts already"
        return
    told = [f"{jump:+.3g} {INPUT_UNITS[item.acts]}/s at {time:.4g} s" for time, jump in corners[:_SHOWN]]
    more = f" and at {len(corners) - _SHOWN} more rows" if len(corners) > _SHOWN else ""
    name = item.name
    yield (
        f"{name} has corners: the base's rate jumps by {', '.join(told)}{more}. For a smooth motion give more rows, "
        f"the columns {name}_rate and {name}_acceleration, or a profile such as {name}=smooth:0:1:0.5s"
    )
