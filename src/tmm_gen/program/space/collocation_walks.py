"""Walks of a step whose stages are solved at once: what its equations leave over, and a sweep for what mends that."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache

import sympy as sp

from tmm_gen.derive.space import base_balance
from tmm_gen.derive.space.declaration import ANGLE
from tmm_gen.derive.space.inward import BIAS, Inertial
from tmm_gen.derive.space.outward import COSINE, SINE
from tmm_gen.derive.space.pattern import Pattern
from tmm_gen.derive.space.reaction import lacking_lines
from tmm_gen.derive.station.lets import Line
from tmm_gen.program.space.walks import SpaceWalks, outward
from tmm_gen.program.statements import Assign, Loop, Order, Section


@lru_cache(maxsize=256)
def mending(pattern: Pattern, products: bool) -> Inertial:
    """Return the way in and back over stations of a pattern, where torques of joints alone act."""
    return Inertial(outward(pattern, True), sp.S.One, acting=False, products=products)


class ResidualWalks(SpaceWalks):
    """Walks out with motion and in with exact forces, at the motion of a stage."""

    def left_over(self) -> Section:
        """Return the way in, to what torque each joint lacks."""
        at_base = self._of_base(lambda _: base_balance.lacking_lines())
        lines = self.walk(Order.INWARD, lambda p: lacking_lines(outward(p, False)), tuple(BIAS), base=at_base)
        return Section("in: what the equations of the stages leave over", tuple(lines))


class MendingWalks(SpaceWalks):
    """The sweep that finds what changes of accelerations make up for what the equations leave over."""

    def circles(self) -> Section:
        """Return the sines of the joints' angles, which alone of the motion enter."""
        loops = []
        for start, stop in self.layout.tree.stretches:
            angle = self._motion[ANGLE].at()
            if self.layout.tree.geared(start):
                loops.append(self._circle(start, start + 1, angle + self._motion[ANGLE].at(-1)))
                start += 1
            if start < stop:
                loops.append(self._circle(start, stop, angle))
        return Section("sines of the angles at the middle of the step", tuple(loops))

    def _circle(self, start: int, stop: int, angle: sp.Expr) -> Loop:
        body = (Assign(self.array(SINE).at(), sp.sin(angle)), Assign(self.array(COSINE).at(), sp.cos(angle)))
        return Loop(Order.OUTWARD, start, stop, body)

    def _eliminated(self, pattern: Pattern, still: bool) -> Inertial:
        del still
        return mending(pattern, self.layout.single)

    def _answered(self) -> Sequence[Line]:
        # in its own axes: each stage has others
        return base_balance.change_lines()
