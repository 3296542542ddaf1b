"""The planar arm's recursions, derived from its elements: exact motion and forces, and their linearisation.

Per link the unknown is the increment of ``u`` (see :mod:`tmm_gen.derive.integrators.relations`) from its
predicted value, with ``d theta = P_q du``, ``d omega = P_v du``, ``d alpha = P_a du``; per node they are the
increments of its two accelerations. Positions are no unknowns: nothing but angles is integrated.

Outboard of a link, forces follow motion as ``f = S k + e`` with ``k = (d a_x, d a_y, du)`` and
``f = (F_x, F_y, M)``. The formulas below carry that over a link and over a joint; each is a derivative, taken by
SymPy, of the elements' exact equations, or a solution of them.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import sympy as sp

from tmm_gen.derive.elements.planar import DAMPING, JOINT, LENGTH, LINK, MASS, STIFFNESS, TIP
from tmm_gen.derive.torsion_chain import GAINS

SINE, COSINE = sp.symbols("s c", real=True)
RATE, ACCELERATION = sp.symbols("omega alpha", real=True)
A_X, A_Y = sp.symbols("a_x a_y", real=True)
OUTER_A_X, OUTER_A_Y = sp.symbols("a_x_outer a_y_outer", real=True)
F_X, F_Y, TORQUE = sp.symbols("F_x F_y M", real=True)

# names for what occurs again and again
LEVER_SINE, LEVER_COSINE = sp.symbols("l_s l_c", real=True)
CARRIED_MASS, PIN_INERTIA = sp.symbols("m_o J", real=True)
LOAD_X, LOAD_Y = sp.symbols("L_x L_y", real=True)
TANGENTIAL, TURNING = sp.symbols("P_t P_r", real=True)
GAIN_X, GAIN_Y = sp.symbols("X Y", real=True)
OWN_X, OWN_Y = sp.symbols("X_own Y_own", real=True)
"""Change of the carried mass's acceleration per unknown: that of the outer end, where its motion is exact."""
S = sp.Matrix(3, 3, lambda i, k: sp.Symbol(f"S{i + 1}{k + 1}", real=True))
E = sp.Matrix([sp.Symbol(f"e{i + 1}", real=True) for i in range(3)])
JOINT_IMPEDANCE, JOINT_TORQUE, PIVOT_INVERSE = sp.symbols("K w D_inv", real=True)


@dataclass(frozen=True)
class LinkLaw:
    """A link's exact equations, solved for what the sweeps need, in the named symbols of this module.

    Parameters
    ----------
    lever_sine, lever_cosine : sympy.Expr
        ``l s`` and ``l c``.
    carried_mass, pin_inertia : sympy.Expr
        Mass acting at the outer end, inertia about the inner end.
    outer_x, outer_y : sympy.Expr
        Accelerations of the outer end.
    force_x, force_y : sympy.Expr
        At the inner end, from those at the outer end and the accelerations of both ends.
    load_x, load_y : sympy.Expr
        What the lever arms turn into torque: force at the outer end and the inertia of the carried mass.
    torque : sympy.Expr
        At the inner end.
    """

    lever_sine: sp.Expr
    lever_cosine: sp.Expr
    carried_mass: sp.Expr
    pin_inertia: sp.Expr
    outer_x: sp.Expr
    outer_y: sp.Expr
    force_x: sp.Expr
    force_y: sp.Expr
    load_x: sp.Expr
    load_y: sp.Expr
    torque: sp.Expr


@cache
def link_law() -> LinkLaw:
    """Solve the link's equations for outer motion and inner forces, and name their parts."""
    outer_x, outer_y, force_x, force_y, torque = _solved_link()
    turned = sp.collect(torque, [SINE, COSINE], evaluate=False)
    load_x = sp.expand(-turned[SINE] / LENGTH)
    load_y = sp.expand(turned[COSINE] / LENGTH)
    rest = sp.collect(turned[sp.Integer(1)], ACCELERATION, evaluate=False)
    carried = sp.expand(load_x).coeff(A_X)
    if sp.expand(load_y).coeff(A_Y) != carried:
        raise ArithmeticError("the carried mass should not depend on direction")
    named = {SINE: LEVER_SINE / LENGTH, COSINE: LEVER_COSINE / LENGTH}
    # the force needs no sines of its own: the swing of the centre is a share of the swing of the outer end
    swing_x, swing_y = outer_x - A_X, outer_y - A_Y
    inner_x = force_x - carried * swing_x
    inner_y = force_y - carried * swing_y
    return LinkLaw(
        lever_sine=LENGTH * SINE,
        lever_cosine=LENGTH * COSINE,
        carried_mass=carried,
        pin_inertia=rest[ACCELERATION],
        outer_x=A_X + _by_levers(sp.expand(swing_x.subs(named))),
        outer_y=A_Y + _by_levers(sp.expand(swing_y.subs(named))),
        force_x=_shared(inner_x, carried, A_X, OUTER_A_X),
        force_y=_shared(inner_y, carried, A_Y, OUTER_A_Y),
        load_x=load_x.subs(carried, CARRIED_MASS),
        load_y=load_y.subs(carried, CARRIED_MASS),
        torque=rest[sp.Integer(1)] + PIN_INERTIA * ACCELERATION + LEVER_COSINE * LOAD_Y - LEVER_SINE * LOAD_X,
    )


@dataclass(frozen=True)
class LinkSweep:
    """The linearised recursion over a link, each formula using the ones before it.

    Parameters
    ----------
    tangential, turning : sympy.Expr
        Change, per unknown, of the outer end's acceleration across and along the link, per length.
    gain_x, gain_y : sympy.Expr
        The same in x and y.
    outer : 3 sympy.Expr
        Change of ``(F_x, F_y, M)`` at the outer end per unknown of this link.
    impedance : 3x3 sympy.Matrix
        ``S`` at the inner end; column 3 in terms of ``outer`` (symbols ``U1, U2, U3``).
    bias : 3 sympy.Expr
        ``e`` at the inner end.
    """

    tangential: sp.Expr
    turning: sp.Expr
    gain_x: sp.Expr
    gain_y: sp.Expr
    outer: tuple[sp.Expr, sp.Expr, sp.Expr]
    impedance: sp.Matrix
    bias: tuple[sp.Expr, sp.Expr, sp.Expr]


OUTER_COLUMN = sp.symbols("U1 U2 U3", real=True)


@cache
def link_sweep() -> LinkSweep:
    """Differentiate the link's law by its unknowns.

    The Jacobian of "force times lever arm" is taken at ``e``, the force that acts if no unknown moved: it is the
    predicted force, corrected by all links outboard.
    """
    law = link_law()
    by_length = {LEVER_SINE: LENGTH * SINE, LEVER_COSINE: LENGTH * COSINE}
    slope_x = sp.expand(_by_unknown((law.outer_x - A_X).subs(by_length)) / LENGTH)
    slope_y = sp.expand(_by_unknown((law.outer_y - A_Y).subs(by_length)) / LENGTH)
    tangential, turning = slope_y.coeff(COSINE), -slope_y.coeff(SINE)
    if sp.expand(slope_x + SINE * tangential + COSINE * turning) != 0:
        raise ArithmeticError("the outer end should swing across and along the link alike in x and y")
    slope_torque = _by_unknown(law.torque.subs(by_length))
    columns = []
    for index in range(3):
        if index < 2:
            change = {F_X: S[0, index], F_Y: S[1, index], TORQUE: S[2, index]}
            own = [sp.Integer(index == 0), sp.Integer(index == 1)]
            outer_own, turned = own, sp.Integer(0)
        else:
            change = dict(zip((F_X, F_Y, TORQUE), OUTER_COLUMN, strict=True))
            own = [sp.Integer(0), sp.Integer(0)]
            outer_own, turned = [OWN_X, OWN_Y], slope_torque
        inner_x = _differential(law.force_x, change, own, outer_own)
        inner_y = _differential(law.force_y, change, own, outer_own)
        load_x = _differential(law.load_x, change, own, outer_own)
        load_y = _differential(law.load_y, change, own, outer_own)
        held = sp.diff(law.torque, TORQUE) * change[TORQUE]
        levers = sp.diff(law.torque, LOAD_X) * load_x + sp.diff(law.torque, LOAD_Y) * load_y
        columns.append([inner_x, inner_y, held + levers + _grouped(turned)])
    at_bias = {F_X: E[0], F_Y: E[1], TORQUE: E[2]}
    return LinkSweep(
        tangential=sp.collect(tangential, GAINS["q"]),
        turning=turning,
        gain_x=-LEVER_SINE * TANGENTIAL - LEVER_COSINE * TURNING,
        gain_y=LEVER_COSINE * TANGENTIAL - LEVER_SINE * TURNING,
        outer=tuple(S[i, 0] * GAIN_X + S[i, 1] * GAIN_Y + S[i, 2] for i in range(3)),
        impedance=sp.Matrix(columns).T,
        bias=(law.force_x.subs(at_bias), law.force_y.subs(at_bias), law.torque.subs(at_bias)),
    )


@dataclass(frozen=True)
class JointSweep:
    """The recursion over a joint, by its impedance ``K``, known torque ``w`` and inverse pivot.

    Parameters
    ----------
    impedance, known_torque : sympy.Expr
        ``K`` and ``w`` (torque on the outer link) by the joint's own law, in the symbols of
        :func:`joint_symbols`.
    pivot : sympy.Expr
        Inverse of ``D_inv``.
    unknown : sympy.Expr
        The link's unknown, affine in the inner one (``u_inner``), ``d a_x`` and ``d a_y``.
    """

    impedance: sp.Expr
    known_torque: sp.Expr
    pivot: sp.Expr
    unknown: sp.Expr


INNER_UNKNOWN, D_A_X, D_A_Y = sp.symbols("u_inner da_x da_y", real=True)
INNER_ANGLE, INNER_RATE, OUTER_ANGLE, OUTER_RATE = sp.symbols("th_i om_i th_o om_o", real=True)


@cache
def joint_sweep() -> JointSweep:
    """Solve the joint's law together with ``M = S_31 da_x + S_32 da_y + S_33 u + e_3`` for the link's unknown."""
    law = JOINT.equations[-1]
    inner, outer = JOINT.inboard.motions[2], JOINT.outboard.motions[2]
    (torque,) = sp.solve(law, JOINT.outboard.forces[2])
    known = torque.subs(
        {inner.q: INNER_ANGLE, inner.v: INNER_RATE, outer.q: OUTER_ANGLE, outer.v: OUTER_RATE}
    )
    impedance = sp.diff(torque, inner.q) * GAINS["q"] + sp.diff(torque, inner.v) * GAINS["v"]
    u = sp.Symbol("u_outer", real=True)
    outboard = S[2, 0] * D_A_X + S[2, 1] * D_A_Y + S[2, 2] * u + E[2]
    (solved,) = sp.solve(JOINT_IMPEDANCE * (INNER_UNKNOWN - u) + JOINT_TORQUE - outboard, u)
    pivot = JOINT_IMPEDANCE + S[2, 2]
    return JointSweep(
        impedance=sp.expand(impedance),
        known_torque=STIFFNESS * (INNER_ANGLE - OUTER_ANGLE) + DAMPING * (INNER_RATE - OUTER_RATE)
        if sp.expand(known - STIFFNESS * (INNER_ANGLE - OUTER_ANGLE) - DAMPING * (INNER_RATE - OUTER_RATE))
        == 0
        else known,
        pivot=pivot,
        unknown=sp.expand(sp.cancel(solved * pivot)),
    )


@dataclass(frozen=True)
class TipLaw:
    """Forces a free outer end and the body fixed to it ask of the last link: ``F_x, F_y, M`` without loads."""

    force_x: sp.Expr
    force_y: sp.Expr
    torque: sp.Expr


@cache
def tip_law() -> TipLaw:
    """Solve the tip's equations with nothing beyond it."""
    x_in, y_in, th_in = TIP.inboard.motions
    free = dict.fromkeys(TIP.outboard.forces, 0)
    forces = sp.solve([e.subs(free) for e in TIP.equations[3:]], TIP.inboard.forces, dict=True)[0]
    named = {x_in.a: A_X, y_in.a: A_Y, th_in.a: ACCELERATION}
    return TipLaw(*(forces[f].subs(named) for f in TIP.inboard.forces))


def _solved_link() -> tuple[sp.Expr, ...]:
    x_in, y_in, th_in = LINK.inboard.motions
    x_out, y_out, th_out = LINK.outboard.motions
    targets = [x_out.a, y_out.a, *LINK.inboard.forces, th_out.q]
    solution = sp.solve(LINK.equations, targets, dict=True)[0]
    names = {
        sp.sin(th_in.q): SINE,
        sp.cos(th_in.q): COSINE,
        th_in.v: RATE,
        th_in.a: ACCELERATION,
        x_in.a: A_X,
        y_in.a: A_Y,
        **dict(zip(LINK.outboard.forces, (F_X, F_Y, TORQUE), strict=True)),
    }
    tidy = []
    for target in targets[:5]:
        named = sp.expand(sp.expand(solution[target]).subs(names))
        tidy.append(sp.expand(named.subs(SINE**2, 1 - COSINE**2)))
    return tuple(tidy)


def _by_unknown(expression: sp.Expr) -> sp.Expr:
    """Differentiate by a link's unknown: its angle, rate and acceleration move together."""
    turned = sp.diff(expression, SINE) * COSINE - sp.diff(expression, COSINE) * SINE
    return sp.expand(
        GAINS["q"] * turned
        + GAINS["v"] * sp.diff(expression, RATE)
        + GAINS["a"] * sp.diff(expression, ACCELERATION)
    )


def _differential(
    expression: sp.Expr, forces: dict[sp.Symbol, sp.Expr], own: list[sp.Expr], outer: list[sp.Expr]
) -> sp.Expr:
    """Return the change of an expression when forces and accelerations of both ends change."""
    changes = {**forces, A_X: own[0], A_Y: own[1], OUTER_A_X: outer[0], OUTER_A_Y: outer[1]}
    return sp.Add(*(sp.diff(expression, symbol) * change for symbol, change in changes.items()))


def _by_levers(swing: sp.Expr) -> sp.Expr:
    return sp.collect(swing, [LEVER_SINE, LEVER_COSINE])


def _shared(inner: sp.Expr, carried: sp.Expr, a: sp.Symbol, outer: sp.Symbol) -> sp.Expr:
    """Write a force by the accelerations of both ends: the carried mass moves with the outer one."""
    inner = sp.expand(inner)
    own = sp.expand(inner.coeff(a) - carried)
    rest = sp.expand(inner - inner.coeff(a) * a)
    if rest.has(SINE, COSINE):
        raise ArithmeticError("the centre's swing should be a share of the outer end's")
    if sp.expand(own - MASS + carried) == 0:
        own = MASS - CARRIED_MASS
    return rest + own * a + CARRIED_MASS * outer


def _grouped(slope: sp.Expr) -> sp.Expr:
    """Write the torque's own slope by lever arms."""
    named = sp.expand(slope.subs({SINE: LEVER_SINE / LENGTH, COSINE: LEVER_COSINE / LENGTH}))
    return sp.collect(named, GAINS["q"])
