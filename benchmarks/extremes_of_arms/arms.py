"""Planar arms far from the usual: each motion is right, or it is refused.

An arm of 1 m and 0.5 kg is let go from the horizontal under a weight that bends it by about a third of its length at
most, or spun on a free hub. Right means: the tip follows Lagrange's equations to the error that the integrator's own
order explains; beyond the reach of that reference (many links), the energies balance to the same.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cache
from typing import Any

import numpy as np
from extremes_of_arms.limit import OutOfTime, limit
from extremes_of_arms.shared_kernel import SharedKernel, kernel_of
from extremes_of_arms.verdict import Verdict, checkpoints, honest, off

from tmm_gen.derive.integrators.registry import integrator
from tmm_gen.errors import CheckFailed, UserError
from tmm_gen.native import NativeKernel
from tmm_gen.reference.planar_reference import planar_response
from tmm_gen.row.scene import row_of
from tmm_gen.scene import Scene, SceneError, parse_scene
from tmm_gen.simulate.run import simulate
from tmm_gen.simulate.simulation import Simulation

MOST_LINKS = 60
"""Of the reference, whose cost goes with the cube."""

_MASS, _LENGTH = 0.5, 1.0
_HUB = 1e-4
"""Inertia of the hub as a share of the arm's: it starts at rest, and is to follow the spinning arm at once."""

_PATIENCE = 10.0
"""How many times more time the reference has where energies do not balance."""

_SHARE = 10.0
"""What faster modes add to the error of the first."""

_CHECKPOINTS = 1000
"""So many that an arm which turns is not always caught where it began."""

_SAG = 0.3
"""Largest static sag by a linear beam's formula, as a share of the length."""

_SCENE = """
name = "extreme"
[model]
kind = "planar"
{iterations}
{gravity}
[integrator]
name = "{integrator}"
step = {step!r}
[base]
kind = "{base}"
{inertia}
[[joint]]
stiffness = {first!r}
damping = {first_damping!r}
{joints}
[[link]]
mass = {mass!r}
length = {length!r}
inertia = {link_inertia!r}
repeat = {links}
[tip]
mass = {tip!r}
[[output]]
name = "tip"
at = "tip"
of = "position"
[initial]
rates = {rate!r}
"""
_MORE = """[[joint]]
stiffness = {k!r}
damping = {c!r}
repeat = {more}"""


@dataclass(frozen=True)
class Extreme:
    """An arm and a step.

    Parameters
    ----------
    links : int
        Number of links.
    stiffness : float
        EI, N m^2.
    slenderness : float
        Inertia of a link about its centre over that of a thin rod: 0.001 for a mass at a point, 100 for a stubby block.
    tip_ratio : float
        Tip mass over that of the arm.
    step : float
        As a share of the first period.
    revolutions : float
        Per second; spins on a free hub without weight if not zero.
    damping : float
        Joint damping over stiffness, as a share of the first period.
    integrator : str
        Name.
    iterations : int or None
        Sweeps per stage; None for as many as it takes.
    """

    links: int = 5
    stiffness: float = 1.0
    slenderness: float = 1.0
    tip_ratio: float = 0.0
    step: float = 1e-3
    revolutions: float = 0.0
    damping: float = 2e-3
    integrator: str = "newmark"
    iterations: int | None = None

    @property
    def period(self) -> float:
        """First period of the clamped beam with its tip mass, about, s."""
        tip = self.tip_ratio * _MASS
        return 2.0 * math.pi * math.sqrt((tip + 0.243 * _MASS) * _LENGTH**3 / (3.0 * self.stiffness))

    @property
    def steps(self) -> int:
        """How many: half a period, where that is neither a handful nor more than patience."""
        return min(max(round(0.5 / self.step), 20), 5000 if self.links <= MOST_LINKS else 500)

    def scene(self) -> Scene:
        """Return it as a scene."""
        tip, length, mass = self.tip_ratio * _MASS, _LENGTH / self.links, _MASS / self.links
        # w L^4 / 8 EI and P L^3 / 3 EI, for weights of arm and tip
        sag = (_MASS / 8.0 + tip / 3.0) * _LENGTH**3 / self.stiffness
        k = self.stiffness / length
        c = self.damping * self.period * k
        more = _MORE.format(k=k, c=c, more=self.links - 1) if self.links > 1 else ""
        spun = self.revolutions > 0.0
        return parse_scene(
            _SCENE.format(
                gravity="" if spun else f"gravity = {_SAG * _LENGTH / sag!r}",
                integrator=self.integrator,
                iterations=f"iterations = {self.iterations}" if self.iterations else "",
                step=self.step * self.period,
                base="motor" if spun else "clamp",
                inertia=f"inertia = {_HUB * _MASS * _LENGTH**2!r}" if spun else "",
                first=2.0 * k,
                first_damping=2.0 * c,
                joints=more,
                mass=mass,
                length=length,
                link_inertia=self.slenderness * mass * length**2 / 12.0,
                links=self.links,
                tip=tip,
                rate=2.0 * math.pi * self.revolutions,
            )
        )

    @property
    def bound(self) -> float:
        """Largest error of a second-order step, as a share of the largest motion.

        Newmark's method is late by ``w^2 h^2 / 12`` of the way; beside the first mode and the rotation, faster modes
        have a share in it.
        """
        turn = 2.0 * math.pi * self.step * max(1.0, self.revolutions * self.period)
        passed = max(1.0, self.steps * turn)
        return min(0.5, _SHARE * turn**2 / 12.0 * passed + 1e-6)


def judge(
    extreme: Extreme, *, refuse: bool = True, substeps: bool = True, seconds: float = math.inf
) -> Verdict:
    """Simulate an extreme in compiled C, as `run` does, and compare.

    Parameters
    ----------
    extreme : Extreme
        What to simulate.
    refuse : bool
        For its error, and for what its sweeps leave unsolved.
    substeps : bool
        Divide steps that are too long, as `run` does without --step.
    seconds : float
        For the run, and once more for the reference, ten times as much where energies do not balance. Without
        reference, it is energies that are judged.
    """
    try:
        scene = extreme.scene()
        until = extreme.steps * scene.integrator.step
        kernel: Any = _shared(
            _kernel(replace(extreme, **_SAME, revolutions=float(extreme.revolutions > 0.0))), scene
        )
        with limit(seconds):
            run = simulate(
                scene, {}, until, "c", kernel=kernel, trace=True, refuse=refuse, substeps=refuse and substeps
            )
    except OutOfTime:
        return Verdict("out of time")
    except (UserError, SceneError, CheckFailed) as refusal:
        return Verdict("refused", said=str(refusal))
    assert run.accuracy is not None
    balanced = honest(run.imbalance or 0.0, run)
    error = None
    if extreme.links <= MOST_LINKS:
        error = _in_time(run, seconds)
        if error is None and not balanced:  # which proves nothing: modes too fast to matter may ring falsely
            error = _in_time(run, _PATIENCE * seconds)
            if error is None:
                return Verdict("out of time", accuracy=run.accuracy.error, imbalance=run.imbalance or 0.0)
    right, said = "right", "follows Lagrange's equations"
    if error is None:
        right, said, error = "right by energies", "energies balance", run.imbalance or 0.0
    return Verdict(
        right if honest(error, run) else "wrong",
        error,
        extreme.bound,
        run.accuracy.error,
        run.accuracy.sensitivity or 0.0,
        run.sweeps_per_step or 0.0,
        run.unsolved or 0.0,
        run.step_error or 0.0,
        run.imbalance or 0.0,
        run.substeps.count,
        said,
    )


_SAME: dict[str, Any] = {
    "stiffness": 1.0,
    "slenderness": 1.0,
    "tip_ratio": 1.0,
    "step": 1e-3,
    "damping": 2e-3,
}
"""What kernels of a kind share: their parameters are free."""


@cache
def _kernel(kind: Extreme) -> NativeKernel:
    return kernel_of(kind.scene())


def _shared(kernel: NativeKernel, scene: Scene) -> SharedKernel:
    """Return a kernel with the parameters and the start of one arm."""
    row = row_of(scene, integrator(scene.integrator.name))
    known = {variable.name: variable for variable in kernel.program.parameters}
    values: dict[str, Any] = {
        p.name: p.values if known[p.name].length else p.values[0] for p in row.parameters if p.name in known
    }
    values["tip_mass"] = scene.tip.mass if scene.tip else 0.0
    start = {
        "initial_angle": np.array(scene.initial.angles),
        "initial_rate": np.array(scene.initial.rates),
    }
    return SharedKernel(kernel, values, start)


def _in_time(run: Simulation, seconds: float) -> float | None:
    """Return how far the tip is from where it should be; None if the reference takes longer."""
    try:
        with limit(seconds):
            return _off(run)
    except OutOfTime:
        return None


def _off(run: Simulation) -> float:
    """Return how far the tip is from where Lagrange's equations have it, as a share of how far it goes."""
    shown = checkpoints(run, _CHECKPOINTS)
    return off(run, planar_response(run.scene, {}, run.time[shown], 1e-10), shown)
