"""Arms in space with exact values: beams as cells beside the solutions of their continuous equations, and a heavy top.

Numbers in SI units. What is exact is computed here from the differential equations, by nothing the arms are made of.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq, fsolve
from support.spatial.beams import Beam, End, add_beam

from tmm_gen.scene.spatial.arm import ArmInput, ArmOutput, Frame, Revolute, RigidBody, SpatialArm

Array = np.ndarray

CANTILEVER = Beam(1.0, (2.0, 5.0), 0.8, 1.0, 2e-4)
SIDE = Beam(0.5, (4.0, 4.0), 3.0, 1.0, 2e-4)
"""Each of the two of the L-frame."""

_THIN, _DEEP, _YOUNG, _POISSON = 3.2024e-3, 12.377e-3, 71.7e9, 0.31
_SHEAR = _YOUNG / (2.0 * (1.0 + _POISSON))
STRIP = Beam(
    0.508,
    (_YOUNG * _DEEP * _THIN**3 / 12.0, _YOUNG * _THIN * _DEEP**3 / 12.0),
    _SHEAR * _DEEP * _THIN**3 * (1.0 / 3.0 - 0.21 * _THIN / _DEEP * (1.0 - _THIN**4 / (12.0 * _DEEP**4))),
    2700.0 * _THIN * _DEEP,
    2700.0 * _THIN * _DEEP * (_THIN**2 + _DEEP**2) / 12.0,
)
"""A beam as the Princeton experiment's: soft about y, so along z; torsion by Roark's formula for rectangles."""

_QUARTER = ((0.0, -1.0, 0.0), (1.0, 0.0, 0.0), (0.0, 0.0, 1.0))
"""About z: the frame's second side goes along y."""


def beam_arm(beam: Beam, cells: int, *, alternate: bool = True) -> SpatialArm:
    """Return a clamped beam, a force in world axes on its tip, the tip's place read."""
    joints: list[Revolute] = []
    return _arm(joints, add_beam(joints, beam, cells, alternate=alternate))


def cantilever(cells: int) -> SpatialArm:
    """Return a clamped beam whose frequencies are `cantilever_frequencies`."""
    return beam_arm(CANTILEVER, cells)


def cantilever_frequencies() -> dict[str, tuple[float, float]]:
    """Return the first two natural frequencies of bending about y and z and of twisting, rad/s."""
    beam = CANTILEVER
    roots = _roots(lambda x: math.cosh(x) * math.cos(x) + 1.0, np.arange(0.1, 8.0, 0.1))[:2]
    about = [
        tuple(root**2 * math.sqrt(stiffness / (beam.mass * beam.length**4)) for root in roots)
        for stiffness in beam.bending
    ]
    quarter = math.pi / 2.0 * math.sqrt(beam.torsion / beam.polar) / beam.length
    return {"bend_y": _pair(about[0]), "bend_z": _pair(about[1]), "twist_x": (quarter, 3.0 * quarter)}


def frame(cells: int) -> SpatialArm:
    """Return an L-frame: two beams at a right angle, the second one along y."""
    joints: list[Revolute] = []
    corner = add_beam(joints, SIDE, cells, name="inner")
    tip = add_beam(joints, SIDE, cells, End(corner.joint, corner.at, _QUARTER), name="outer")
    return _arm(joints, tip)


def frame_frequencies() -> tuple[tuple[float, float], tuple[float, float]]:
    """Return the first two natural frequencies out of the frame's plane and in it, rad/s."""
    over = np.arange(1.0, 60.0, 1.0)
    return _pair(_roots(_out_of_plane, over)), _pair(_roots(_in_plane, over))


def _out_of_plane(omega: float) -> float:
    """Return the determinant of the frame's conditions: the first side bends along z and twists, so does the second.

    The corner's rotation is ``(phi_1, -w_1')`` about x and y, and ``(w_2', phi_2)`` in terms of the second side.
    """
    b, wave = SIDE, omega * math.sqrt(SIDE.polar / SIDE.torsion)
    ei, gj = b.bending[0], b.torsion
    end, start = _bent(omega, b.length), _bent(omega, 0.0)
    sine, cosine = math.sin(wave * b.length), math.cos(wave * b.length)
    rows = np.zeros((9, 9))
    # unknown: two of w_1, clamped; one of phi_1; four of w_2; two of phi_2
    first = np.array([[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]])
    w1 = end @ first
    rows[0, :2], rows[0, 3:7] = w1[0], -start[0]
    rows[1, 2], rows[1, 3:7] = sine, -start[1]
    rows[2, :2], rows[2, 7] = w1[1], 1.0
    rows[3, :2], rows[3, 8] = ei * w1[2], gj * wave
    rows[4, :2], rows[4, 3:7] = w1[3], -start[3]
    rows[5, 2], rows[5, 3:7] = gj * wave * cosine, -ei * start[2]
    rows[6, 3:7], rows[7, 3:7] = end[2], end[3]
    rows[8, 7:] = -sine, cosine
    return float(np.linalg.det(rows))


def _in_plane(omega: float) -> float:
    """Return the determinant of the frame's conditions: neither side gets longer, so the second rides on the first."""
    b = SIDE
    end, start = _bent(omega, b.length), _bent(omega, 0.0)
    first = np.array([[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]])
    v1 = end @ first
    ei, riding = b.bending[0], b.mass * b.length * omega**2
    rows = np.zeros((6, 6))
    # the second side's deflection is along -x, which a turn about z makes positive
    rows[0, 2:] = start[0]
    rows[1, :2], rows[1, 2:] = v1[1], -start[1]
    rows[2, :2], rows[2, 2:] = v1[2], -start[2]
    rows[3, :2] = ei * v1[3] + riding * v1[0]
    rows[4, 2:], rows[5, 2:] = end[2], end[3]
    return float(np.linalg.det(rows))


def _bent(omega: float, x: float) -> Array:
    """Return cosh, sinh, cos, sin of the bending wave and their three derivatives at a place, (4, 4), of a side."""
    k = (SIDE.mass * omega**2 / SIDE.bending[0]) ** 0.25
    c, s, co, si = math.cosh(k * x), math.sinh(k * x), math.cos(k * x), math.sin(k * x)
    return np.array(
        [
            [c, s, co, si],
            [k * s, k * c, -k * si, k * co],
            [k**2 * c, k**2 * s, -(k**2) * co, -(k**2) * si],
            [k**3 * s, k**3 * c, k**3 * si, -(k**3) * co],
        ]
    )


def strip(cells: int, *, alternate: bool = True) -> SpatialArm:
    """Return the thin beam whose tip a force of `strip_force` moves by `strip_tip`."""
    return beam_arm(STRIP, cells, alternate=alternate)


def strip_force(load: float, degrees: float) -> dict[str, float]:
    """Return a dead load on the tip by input column, N, at an angle from the stiff direction, which is y."""
    angle = math.radians(degrees)
    return {"push_x": 0.0, "push_y": load * math.cos(angle), "push_z": load * math.sin(angle)}


def strip_tip(load: float, degrees: float) -> Array:
    """Return where the tip comes to lie, (3,), m: a Kirchhoff rod, by shooting from the clamp.

    ``r' = d_1``, ``R' = R [kappa]x`` with ``kappa = diag(GJ, EI_y, EI_z)^-1 R^T m``, and
    ``m' = -d_1 x F``, zero on the tip.
    """
    stiffness = np.array([STRIP.torsion, *STRIP.bending])
    force = np.array(list(strip_force(load, degrees).values()))

    def solved(moment: Array, share: float) -> Array:
        def slope(_: float, state: Array) -> Array:
            turn, m = state[3:12].reshape(3, 3), state[12:]
            x, y, z = turn.T @ m / stiffness
            bent = turn @ np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
            return np.concatenate([turn[:, 0], bent.ravel(), -np.cross(turn[:, 0], share * force)])

        start = np.concatenate([np.zeros(3), np.eye(3).ravel(), moment])
        ways = solve_ivp(slope, (0.0, STRIP.length), start, method="DOP853", rtol=1e-12, atol=1e-13)
        return np.asarray(ways.y[:, -1])

    moment = np.zeros(3)
    for share in (0.25, 0.5, 0.75, 1.0):  # each load starts where the last one has led
        moment = fsolve(lambda m, share=share: solved(m, share)[12:], moment, xtol=1e-12)
    end = solved(moment, 1.0)
    assert np.max(np.abs(end[12:])) < 1e-9 * load * STRIP.length
    return end[:3]


@dataclass(frozen=True)
class Top:
    """A heavy symmetric top in steady precession.

    Parameters
    ----------
    mass, lever : float
        kg; from the point it stands on to its centre, m.
    across, along : float
        Inertia about its centre across and along its axis, kg m^2.
    tilt, spin : float
        Of its axis from upright, rad; angular velocity along its axis, rad/s.
    weight : float
        m/s^2.
    """

    mass: float = 1.0
    lever: float = 0.1
    across: float = 0.002
    along: float = 0.001
    tilt: float = 0.5
    spin: float = 250.0
    weight: float = 9.81

    @property
    def precession(self) -> float:
        """The slower root of ``A cos(tilt) W^2 - C spin W + m g l = 0``, rad/s."""
        about = (self.across + self.mass * self.lever**2) * math.cos(self.tilt)
        momentum = self.along * self.spin
        return (momentum - math.sqrt(momentum**2 - 4.0 * about * self.mass * self.weight * self.lever)) / (
            2.0 * about
        )

    @property
    def rates(self) -> tuple[float, float, float]:
        """Of the joints: precession, tilting, and what the top turns in its yoke, rad/s; they stay as they are."""
        return self.precession, 0.0, self.spin - self.precession * math.cos(self.tilt)

    @property
    def arm(self) -> SpatialArm:
        """The top on joints about z, y and z at one point, started in steady precession."""
        body = RigidBody(
            self.mass, (0.0, 0.0, self.lever), (self.across, self.across, self.along, 0.0, 0.0, 0.0)
        )
        first, second, third = self.rates
        joints = (
            Revolute("precess", 0, axis=2, rate=first),
            Revolute("tilt", 1, axis=1, angle=self.tilt, rate=second),
            Revolute("spin", 2, axis=2, body=body, rate=third),
        )
        outputs = tuple(
            ArmOutput(f"{joint.name}_rate", "rate", joint=k + 1) for k, joint in enumerate(joints)
        )
        return SpatialArm(joints, (), (0.0, 0.0, -self.weight), (), outputs)


def _arm(joints: list[Revolute], end: End) -> SpatialArm:
    tip = Frame("tip", end.joint, end.at, end.turn)
    push = ArmInput("push", "force", frame=tip, axes="world")
    return SpatialArm(
        tuple(joints), (tip,), inputs=(push,), outputs=(ArmOutput("tip", "position", frame=tip),)
    )


def _roots(function: Callable[[float], float], over: Array) -> tuple[float, ...]:
    """Return where a function changes sign between neighbours of some places."""
    values = [function(float(x)) for x in over]
    found = [
        brentq(function, float(over[k]), float(over[k + 1]), xtol=1e-13, rtol=1e-14)
        for k in range(len(over) - 1)
        if values[k] * values[k + 1] < 0.0
    ]
    return tuple(found)


def _pair(values: tuple[float, ...]) -> tuple[float, float]:
    return values[0], values[1]
