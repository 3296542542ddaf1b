"""The way in is the derivative of the way out and of the exact forces: against finite differences."""

from __future__ import annotations

import numpy as np
import pytest
import sympy as sp

from tmm_gen.derive.elements import nodes
from tmm_gen.derive.elements.declaration import Element
from tmm_gen.derive.elements.planar import DAMPING, LENGTH, STIFFNESS
from tmm_gen.derive.station.frame import COSINE, GAINS, INNER, OUTER, SINE, Frame, force, impedance
from tmm_gen.derive.station.inward import Inward
from tmm_gen.derive.station.lets import Let, Update
from tmm_gen.derive.station.motion import Outward
from tmm_gen.row.planar import ALONG_X, ALONG_Y, ANGLE

C = (ALONG_X, ALONG_Y, ANGLE)
RNG = np.random.default_rng(11)
L, J, M = 0.3, -0.004, 0.6
ROD, MASS = nodes.ROD, nodes.MASS_AT_NODE
PIN = nodes.PIN.with_values({STIFFNESS: 21.0, DAMPING: 0.4})
GAIN = np.array([0.04, 0.3, 1.0])
POINT = {"q": 0.7, "v": -1.1, "a": 2.3}
ACCELERATION = np.array([0.4, -0.9])
S, E = RNG.normal(size=(3, 3)) + 5 * np.eye(3), RNG.normal(size=3)


def exact(k: np.ndarray) -> np.ndarray:
    """Force at the inner end of rod and mass, whose outer side asks for ``S k + E``, after a change of motion."""
    angle, rate, acceleration = np.array([*POINT.values()]) + GAIN * k[2]
    swing = L * np.array(
        [
            -np.cos(angle) * rate**2 - np.sin(angle) * acceleration,
            np.cos(angle) * acceleration - np.sin(angle) * rate**2,
        ]
    )
    a = ACCELERATION + k[:2] + swing
    before = L * np.array(
        [
            -np.cos(POINT["q"]) * POINT["v"] ** 2 - np.sin(POINT["q"]) * POINT["a"],
            np.cos(POINT["q"]) * POINT["a"] - np.sin(POINT["q"]) * POINT["v"] ** 2,
        ]
    )
    outer = np.array([*(k[:2] + swing - before), k[2]])
    fx, fy, torque = S @ outer + E + np.array([*(M * a), 0.0])
    return np.array([fx, fy, torque + L * (np.cos(angle) * fy - np.sin(angle) * fx) + J * acceleration])


def swept(frame: Frame, elements: tuple[Element, ...]) -> tuple[np.ndarray, np.ndarray, dict[str, float]]:
    """Evaluate the derived lines in order."""
    out = Outward(elements, frame, moved=elements[0] is ROD)
    inward = Inward(out)
    held: dict[sp.Symbol, float] = {GAINS[k]: g for k, g in zip("qva", GAIN, strict=True)}
    held |= {impedance(a, b): S[i, j] for i, a in enumerate(C) for j, b in enumerate(C)}
    held |= {force(a): E[i] for i, a in enumerate(C)}
    held |= {OUTER[k]: v for k, v in POINT.items()} | {INNER[k]: v / 2 for k, v in POINT.items()}
    held |= {LENGTH: L, nodes.BODY_INERTIA: J, nodes.POINT_MASS: M}
    held |= {SINE: np.sin(POINT["q"]), COSINE: np.cos(POINT["q"])}
    held |= {sp.Symbol("node_x", real=True): ACCELERATION[0], sp.Symbol("node_y", real=True): ACCELERATION[1]}
    for line in (*out.lets, *inward.known, *inward.lines):
        if isinstance(line, Let):
            held[line.symbol] = float(line.value.subs(held))
        elif isinstance(line, Update):
            held |= {s: float(sp.sympify(v).subs(held)) for s, v in line.values.items()}
    named = {s.name: v for s, v in held.items()}
    return (
        np.array([[held[impedance(a, b)] for b in C] for a in C]),
        np.array([held[force(a)] for a in C]),
        named,
    )


@pytest.mark.parametrize("unknown", ["all gains are symbols", "the acceleration is the unknown"])
def test_over_a_rod_it_is_the_derivative(unknown: str) -> None:
    last = sp.Integer(1) if "acceleration is" in unknown else GAINS["a"]
    frame = Frame(C, (GAINS["q"], GAINS["v"], last))
    slopes, bias, _ = swept(frame, (ROD, MASS))
    eps = 1e-6
    right = np.column_stack([(exact(eps * e) - exact(-eps * e)) / (2 * eps) for e in np.eye(3)])
    np.testing.assert_allclose(slopes, right, rtol=1e-7, atol=1e-8)
    np.testing.assert_allclose(bias, exact(np.zeros(3)), rtol=1e-12)


def test_over_a_pin_it_eliminates_the_angle() -> None:
    """The inner forces for a change of the inner motion: by the pin's law and the outer impedance, solved by NumPy."""
    frame = Frame(C, (GAINS["q"], GAINS["v"], sp.Integer(1)))
    slopes, bias, _ = swept(frame, (PIN,))
    stiff = 21.0 * GAIN[0] + 0.4 * GAIN[1]
    known = 21.0 * (POINT["q"] / 2 - POINT["q"]) + 0.4 * (POINT["v"] / 2 - POINT["v"])

    def inner(k: np.ndarray) -> np.ndarray:
        # S_u (cx, cy, u) + e_u = known + stiff (u_inner - u)
        u = (known + stiff * k[2] - E[2] - S[2, :2] @ k[:2]) / (S[2, 2] + stiff)
        return S @ np.array([*k[:2], u]) + E

    np.testing.assert_allclose(bias, inner(np.zeros(3)), rtol=1e-12)
    right = np.column_stack([inner(e) - inner(np.zeros(3)) for e in np.eye(3)])
    np.testing.assert_allclose(slopes, right, rtol=1e-11, atol=1e-12)
