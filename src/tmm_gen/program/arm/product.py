"""A sweep by the plain product of transfer matrices: out with what a base unknown leads to, then solved at the tip."""

from __future__ import annotations

import sympy as sp

from tmm_gen.derive.elements.declaration import Element
from tmm_gen.derive.integrators.relations import UnsuitableUnknownError
from tmm_gen.derive.station import product as derived
from tmm_gen.derive.station.inward import Inward
from tmm_gen.derive.station.lets import Let, Line, composed
from tmm_gen.derive.station.station import outward
from tmm_gen.program.arm.at_places import BASE, hub_unknown
from tmm_gen.program.arm.walks import Walks
from tmm_gen.program.statements import Assign, Loop, Order, Section, Statement
from tmm_gen.program.variables import Role, Variable

ZERO, ONE = sp.Integer(0), sp.Integer(1)


class ProductWalks(Walks):
    """Builds the sections of one sweep by the plain product, for rows of one coordinate."""

    def plain(self) -> list[Section]:
        """Return the whole sweep, with scratch of stations as scalars."""
        return [
            Section("forces of the joints at the motion so far", tuple(self.joint_forces())),
            Section("product outward: motion and force per unknown of the base", tuple(self._gains())),
            Section(
                "product outward: state of each station if the base unknown were zero", tuple(self._known())
            ),
        ]

    @property
    def _free(self) -> bool:
        return self.layout.row.boundary == "free"

    def _product(
        self, elements: tuple[Element, ...], known: list[Let], *, moved: bool = False
    ) -> derived.Product:
        out = outward(elements, self.frame, moved=moved)
        found = derived.product(out, known)
        if not found.gives_way:
            raise UnsuitableUnknownError(
                "an explicit integrator has no joint impedance to multiply by; use sweep = 'riccati'"
            )
        return found

    def _each(self) -> list[tuple[int, int, derived.Product]]:
        return [
            (start, stop, self._product(elements, self._known_of(inner)))
            for (start, stop, elements), inner in zip(self.runs, self._derived.inwards, strict=True)
        ]

    def _known_of(self, inner: Inward) -> list[Let]:
        return list(inner.known)

    def _gains(self) -> list[Statement]:
        here, base, tip = self.at_station(), self.at_node(BASE), self.at_node(self.layout.stations)
        first = {derived.MOTION_GAIN: ZERO, derived.FORCE_GAIN: ONE}
        if self._free:
            hub = composed(self._product(self.layout.row.base, [], moved=True).gains)
            at_hub = {derived.MOTION_GAIN: ONE, derived.FORCE_GAIN: ZERO}
            first = {
                derived.MOTION_GAIN: ONE,
                derived.FORCE_GAIN: hub.get(derived.FORCE_GAIN, ZERO).subs(at_hub),
            }
        found: list[Statement] = [Assign(base.target(s), base.value(v)) for s, v in first.items()]
        for start, stop, product in self._each():
            body = here.lines([*product.gains])
            body.append(Assign(self._unknown_gain.at(), here.target(derived.MOTION_GAIN)))
            found.append(Loop(Order.OUTWARD, start, stop, tuple(body)))
        left = composed(self._product(self.layout.row.tail, [], moved=True).gains)
        force = left.get(derived.FORCE_GAIN, derived.FORCE_GAIN)
        self.scratch.described["tip_compliance"] = ("base unknown per torque left over at the tip", "1")
        return [*found, Assign(self.scratch.ref("tip_compliance"), tip.value(1 / force))]

    def _known(self) -> list[Statement]:
        here, base, tip = self.at_station(), self.at_node(BASE), self.at_node(self.layout.stations)
        unknown = self.scratch.ref("unknown")
        motion, force = base.target(derived.MOTION), base.target(derived.FORCE)
        first: list[Statement] = [Assign(motion, ZERO), Assign(force, ZERO)]
        if self._free:
            lines: list[Line] = [*self._product(self.layout.row.base, [], moved=True).known]
            start = {derived.MOTION: ZERO, derived.FORCE: ZERO}
            first[1] = Assign(force, base.value(composed(lines).get(derived.FORCE, ZERO).subs(start)))
        elif self.layout.row.boundary == "prescribed":
            first = [*self.base(), Assign(motion, unknown), Assign(force, ZERO)]
        found: list[Statement] = [*self.loads.filled_besides(()), *first]
        for begin, stop, product in self._each():
            body = here.lines(product.known)
            place = next(i for i, s in enumerate(body) if isinstance(s, Assign) and s.target == motion)
            body.insert(place + 1, Assign(self._partial.at(), motion))
            found.append(Loop(Order.OUTWARD, begin, stop, tuple(body)))
        left = composed(self._product(self.layout.row.tail, [], moved=True).known)
        beyond = sp.expand(-left.get(derived.FORCE, derived.FORCE))
        found.append(Assign(unknown, tip.value(self.scratch.ref("tip_compliance") * beyond)))
        if self._free:
            found.append(Assign(hub_unknown(), unknown))
        for begin, stop, _ in self._each():
            value = self._unknown_gain.at() * unknown + self._partial.at()
            found.append(Loop(Order.OUTWARD, begin, stop, (Assign(self.solved.at(), value),)))
        return found

    @property
    def _unknown_gain(self) -> Variable:
        doc = "unknown of each station per base unknown"
        return Variable("unknown_gain", Role.WORK, self.layout.stations, doc)

    @property
    def _partial(self) -> Variable:
        doc = "unknown of each station if the base's were zero"
        return Variable("partial", Role.WORK, self.layout.stations, doc)
