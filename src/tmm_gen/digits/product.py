"""How many stations the plain product of transfer matrices survives.

The product finds the base's unknown from what is left over at the tip, and each station's motion as the
difference of two numbers that have grown from station to station. A torque of 1 at the base, with the
base held, grows to ``f`` at the tip: about ``log10(f)`` digits of that difference are gone. ``f``
follows from the derived product itself, with the gains of the integrator at the scene's step.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Callable, Iterator, Sequence
from itertools import islice

import sympy as sp

from tmm_gen.derive.elements.torsion import DAMPING, INERTIA, JOINT, LINK, STIFFNESS
from tmm_gen.derive.integrators.declaration import STEP, Integrator
from tmm_gen.derive.integrators.relations import affine_motion
from tmm_gen.derive.station.frame import GAINS, Frame
from tmm_gen.derive.station.law import KINDS
from tmm_gen.derive.station.lets import Coordinate, composed
from tmm_gen.derive.station.product import FORCE_GAIN, MOTION_GAIN, product
from tmm_gen.derive.station.station import inward, outward
from tmm_gen.errors import UserError
from tmm_gen.scene import Scene
from tmm_gen.scene.emit import Emit

DIGITS = {"float64": 6, "float32": 3}
"""Digits to be kept, by the number type of the C code."""

_EPSILON = {"float64": sys.float_info.epsilon, "float32": 2.0**-23}
_COMPENSATED = 2.0**-45
"""The same for sums of two floats."""

_MARGIN = 10.0
"""Errors measured are within this factor of ``epsilon * f``: rounding adds up over steps and stages."""

_FOREVER = 100_000
"""More stations than a scene can have."""


def safe_stations(scene: Scene, integrator: Integrator) -> int:
    """Return the number of stations up to which the product keeps `DIGITS` digits at the scene's step.

    Beyond the scene's own, stations are taken to be like its last one.

    Parameters
    ----------
    scene : Scene
        Of kind "chain"; its sweep does not matter.
    integrator : Integrator
        With its parameters bound to numbers.

    Raises
    ------
    UnsuitableUnknownError
        If the integrator cannot be solved for the scene's unknown.
    """
    bound = _bound(scene.emit)
    for stations, growth in enumerate(torque_growth(scene, integrator), start=1):
        if growth > bound or stations > _FOREVER:
            return stations - 1
    raise AssertionError("unreachable")


def torque_growth(scene: Scene, integrator: Integrator) -> Iterator[float]:
    """Yield what a torque of 1 at the held base grows to, station by station, without end.

    Of several stages and start-up steps, each with gains of its own, the one that grows most counts.
    """
    laws = [_station_law(gains) for gains in _gain_sets(scene, integrator)]
    motion, torque = [0.0] * len(laws), [1.0] * len(laws)
    stations = list(zip(scene.joints, scene.links, strict=True))
    while True:
        joint, link = stations.pop(0) if len(stations) > 1 else stations[0]
        numbers = (joint.stiffness, joint.damping, link.inertia)
        for i, law in enumerate(laws):
            motion[i], torque[i] = law(motion[i], torque[i], *numbers)
        yield max(abs(t) for t in torque)


def require_safe_product(scene: Scene, integrator: Integrator) -> None:
    """Refuse a scene that asks for the plain product beyond the number of stations it survives.

    Raises
    ------
    UserError
        Naming that number and what to do.
    """
    if scene.model.sweep != "product":
        return
    bound = _bound(scene.emit)
    if all(growth <= bound for growth in islice(torque_growth(scene, integrator), scene.stations)):
        return
    safe = safe_stations(scene, integrator)
    asked = 'model.sweep = "product"'
    line = scene.source.lines.get(("model", "sweep"))
    place = f"{scene.source.origin}:{line}" if line else scene.source.origin
    real = scene.emit.real
    holds = f"up to {safe} station{'s' if safe != 1 else ''}" if safe else "for no number of stations"
    raise UserError(
        f"{place}: model.sweep: the plain product keeps {DIGITS[real]} digits in {real} {holds} at a step of "
        f"{scene.integrator.step:g} s; this scene has {scene.stations} (got {asked}). "
        'Write sweep = "riccati", which is right at any length and costs no more.'
    )


def _bound(emit: Emit) -> float:
    """Return the largest growth that leaves the digits to be kept."""
    epsilon = _COMPENSATED if emit.compensated else _EPSILON[emit.real]
    return 10.0 ** -DIGITS[emit.real] / (_MARGIN * epsilon)


def _gain_sets(scene: Scene, integrator: Integrator) -> list[dict[sp.Symbol, float]]:
    """Return the distinct gains of all stages of all schemes, at the scene's step."""
    found: list[dict[sp.Symbol, float]] = []
    for scheme in integrator.schemes:
        for index in range(1, len(scheme.stages) + 1):
            gain = affine_motion(scheme, index, scene.model.unknown).gain
            numbers = {GAINS[k]: float(value.subs(STEP, scene.integrator.step)) for k, value in gain.items()}
            if numbers not in found:
                found.append(numbers)
    return found


def _station_law(gains: dict[sp.Symbol, float]) -> _Law:
    """Return the product over one station: joint, then link."""
    arguments = (MOTION_GAIN, FORCE_GAIN, STIFFNESS, DAMPING, INERTIA)
    q, v, a = (sp.sympify(gains[GAINS[k]]) for k in KINDS)
    frame = Frame((Coordinate("", "torque", True, "rad/s^2", "N m"),), (q, v, a), sign=-1)
    station = (JOINT, LINK)
    known = inward(station, frame, frozenset()).known
    derived = product(outward(station, frame), known)
    if not derived.gives_way:  # an explicit method has no joint impedance to divide by
        return _Law(lambda *_: (math.inf, math.inf))
    carried = composed(derived.gains)
    return _Law(sp.lambdify(arguments, [carried[MOTION_GAIN], carried[FORCE_GAIN]], "math"))


class _Law:
    """A derived law as numbers; what overflows or divides by zero has grown without bound."""

    def __init__(self, function: Callable[..., Sequence[float]]) -> None:
        self._function = function

    def __call__(self, motion: float, torque: float, *parameters: float) -> tuple[float, float]:
        try:
            motion, torque = self._function(motion, torque, *parameters)
        except (OverflowError, ZeroDivisionError):
            return motion, math.inf
        return motion, torque if math.isfinite(torque) else math.inf
