"""What rounding leaves of a chain's motion, told from its parameters: which steps are too long, which too short.

Too long: a link light beside what its joints pass on in a step, ``mu = (z_in + z_out) / inertia`` with the joints'
impedances ``z`` of the derived sweep, rings with accelerations of ``mu`` times its angle over the step squared. Where
the accelerations are what the sweep solves for, the angle is what is left of numbers ``mu`` times larger: ``mu`` times
the rounding error of it is lost. A sweep for increments of the angle has no such numbers, where the integrator ends on
a stage.

Too short: what a step adds to the angle is rounded off. Where the first period takes ``N`` steps, up to a tenth of
``N`` rounding errors add up over it.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Iterator, Mapping

import numpy as np
import sympy as sp
from numpy.typing import NDArray

from tmm_gen.derive.elements.torsion import DAMPING, JOINT, STIFFNESS
from tmm_gen.derive.integrators.declaration import STEP, Integrator, Kind, Scheme, stage
from tmm_gen.derive.integrators.history import history_depth
from tmm_gen.derive.integrators.relations import affine_motion
from tmm_gen.derive.integrators.spectrum import spectrum_of
from tmm_gen.derive.station.frame import GAINS
from tmm_gen.derive.station.law import impedance_law
from tmm_gen.digits.product import DIGITS
from tmm_gen.errors import UserError
from tmm_gen.scene import Scene

Array = NDArray[np.float64]

_EPSILON = {"float64": sys.float_info.epsilon / 2.0, "float32": 2.0**-24}
"""Unit roundoff."""
_COMPENSATED = 2.0**-46
"""The same of sums of two floats."""

LONG_MARGIN = 10.0
"""Errors measured are below this times ``epsilon * mu``."""

SHORT_MARGIN = 0.1
"""Errors measured over a period are below this times ``epsilon * N``, of accelerations."""

_SWEEPS = 12
"""Of the iteration for the first period, of which the order of magnitude is wanted."""


def require_digits(scene: Scene, integrator: Integrator) -> None:
    """Refuse a chain of which rounding leaves fewer digits than promised.

    Raises
    ------
    UserError
        Naming the cause and what to do.
    """
    Rounding(integrator).require(scene)


class Rounding:
    """What an integrator makes of rounding errors.

    Parameters
    ----------
    integrator : Integrator
        With its parameters bound to numbers.
    """

    def __init__(self, integrator: Integrator) -> None:
        self._integrator = integrator
        self.keeps_increments = _keeps_increments(integrator)
        law = impedance_law(JOINT)
        shares = []
        for scheme in integrator.schemes:
            for gain in _gains(scheme):
                impedance = law.subs({GAINS[k]: value for k, value in gain.items()})
                shares.append([impedance.coeff(STIFFNESS), impedance.coeff(DAMPING)])
        self._shares = sp.lambdify(STEP, shares, "math")

    def require(self, scene: Scene) -> None:
        """Refuse a scene; see :func:`require_digits`."""
        real, h, unknown = scene.emit.real, scene.integrator.step, scene.model.unknown
        promised = 10.0 ** -DIGITS[real]
        epsilon = _COMPENSATED if scene.emit.compensated else _EPSILON[real]
        if unknown == "acceleration" or (unknown == "increment" and not self.keeps_increments):
            stiffest = self.step_stiffness(scene)
            if LONG_MARGIN * epsilon * stiffest > promised:
                raise UserError(
                    f"{_place(scene)}: at a step of {h:g} s a joint is {stiffest:.1e} times as stiff as the link "
                    f"beside it is heavy: with {self._integrator.name} and {unknown}s as unknowns, {real} cannot keep "
                    f"{DIGITS[real]} digits of the angles. {self._remedy}"
                )
        period = first_period(scene)
        shortest = SHORT_MARGIN * epsilon * period / promised
        if h < shortest:
            larger = ', or real = "float64"' if real == "float32" else ""
            raise UserError(
                f"{_place(scene)}: integrator.step: a step of {h:g} s is {h / period:.1e} of the first period: in "
                f"{real} what it adds is rounded off. Use a step above {shortest:.2g} s{larger}."
            )

    def step_stiffness(self, scene: Scene) -> float:
        """Return ``mu``, the largest ratio of the impedances of a link's joints to its inertia, over all stages."""
        stiffness = np.array([joint.stiffness for joint in scene.joints])
        damping = np.array([joint.damping for joint in scene.joints])
        inertia = np.array([link.inertia for link in scene.links])
        ratio = np.array([joint.ratio for joint in scene.joints])
        largest = 0.0
        for of_stiffness, of_damping in self._shares(scene.integrator.step):
            impedance = of_stiffness * stiffness + of_damping * damping
            inward = impedance / ratio**2  # as seen from the inner sides
            around = impedance + _carried(scene, inward)[1:]
            largest = max(largest, float(np.max(around / inertia)))
            if scene.hub:
                at_hub = float(_carried(scene, inward)[0]) + of_damping * scene.base.damping
                largest = max(largest, at_hub / scene.base.inertia)
        return largest

    @property
    def _remedy(self) -> str:
        if self.keeps_increments:
            return 'Write unknown = "increment" under [model], which can, or take a smaller step.'
        return (
            'Take a smaller step, or an integrator such as newmark with unknown = "increment" under [model].'
        )


def _gains(scheme: Scheme) -> Iterator[Mapping[Kind, sp.Expr]]:
    """Yield what displacement, rate and acceleration are per unknown of each sweep, of complex ones the sizes."""
    if scheme.coupled:
        for size in spectrum_of(scheme).moduli:
            yield {"q": STEP**2 * size**2, "v": STEP * size, "a": sp.S.One}
        return
    for index in range(1, len(scheme.stages) + 1):
        yield affine_motion(scheme, index, "acceleration").gain


def _keeps_increments(integrator: Integrator) -> bool:
    """Return whether a sweep for increments yields the new angle without a difference of larger numbers.

    It does where the step ends on its last stage, and looks back no further than the last step: any other composes the
    angle from accelerations.
    """
    update = integrator.main.update["q"]
    one_step = not integrator.startup and not integrator.main.coupled and history_depth(integrator) == 1
    return bool(one_step and update == stage("q", len(integrator.main.stages)))


def first_period(scene: Scene) -> float:
    """Return about the first period of a chain whose base is held, s; zero for one that turns freely.

    By inverse iteration from the static deflection. Flexibilities are sums of positive numbers: no digits are lost.
    """
    if scene.hub:
        return 0.0
    turns = np.array(scene.turns)  # all seen from the base's shaft
    compliance = turns**2 / np.array([joint.stiffness for joint in scene.joints])
    inertia = np.array([link.inertia for link in scene.links]) / turns**2
    shape = _summed(scene, compliance)
    square = 0.0
    for _ in range(_SWEEPS):
        shape = shape / np.max(shape)
        moved = _summed(scene, compliance * _beyond(scene, inertia * shape))
        square = float(np.sum(inertia * shape * moved) / np.sum(inertia * moved * moved))
        shape = moved
    # beyond the range of floating point a joint is as good as none
    return 2.0 * math.pi / math.sqrt(square) if 0.0 < square < math.inf else 0.0


def _carried(scene: Scene, joints: Array) -> Array:
    """Return the sum over the joints that each link carries, (n + 1,); the base is first."""
    if not scene.hosts:
        return np.append(joints, 0.0)
    return np.bincount(scene.hosts, joints, len(joints) + 1).astype(float)


def _summed(scene: Scene, joints: Array) -> Array:
    """Return the sum over the joints from the base to each link, (n,)."""
    if not scene.hosts:
        return np.cumsum(joints)
    found = np.zeros(len(joints) + 1)
    for number, value in enumerate(joints, start=1):
        found[number] = found[scene.host(number)] + value
    return found[1:]


def _beyond(scene: Scene, links: Array) -> Array:
    """Return the sum over all links that each joint carries, (n,)."""
    if not scene.hosts:
        return np.cumsum(links[::-1])[::-1]
    found = np.append(0.0, links)
    for number in range(len(links), 0, -1):
        found[scene.host(number)] += found[number]
    return found[1:]


def _place(scene: Scene) -> str:
    line = scene.source.lines.get(("integrator", "step"))
    return f"{scene.source.origin}:{line}" if line else scene.source.origin
