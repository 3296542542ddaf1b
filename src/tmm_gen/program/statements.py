"""Statements, routines and programs: what every backend prints."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from enum import Enum
from functools import cached_property
from typing import TYPE_CHECKING

import sympy as sp

from tmm_gen.program.variables import Ref, Role, Variable, refs_in, variables_in

if TYPE_CHECKING:
    from tmm_gen.program.sensitivities.reduced import Reduced


@dataclass(frozen=True)
class Assign:
    """``target = value``."""

    target: Ref
    value: sp.Expr


@dataclass(frozen=True)
class Require:
    """Leave the routine with ``vanishing_pivot`` unless ``value`` is positive and finite.

    Pivots of a passive arm are positive; a zero, negative or non-finite one means the model cannot be solved.
    """

    value: sp.Expr


@dataclass(frozen=True)
class Repeat:
    """Do what stands up to the next :class:`Until` again and again, so often at most: a mark, which may not nest."""

    most: int
    value: sp.Expr = field(default=sp.Integer(0), init=False)


@dataclass(frozen=True)
class Until:
    """End what :class:`Repeat` began; leave it unless ``value`` is positive."""

    value: sp.Expr


Mark = Repeat | Until


class Order(Enum):
    """In which order a loop visits stations."""

    OUTWARD = "outward"
    INWARD = "inward"


@dataclass(frozen=True)
class Loop:
    """A loop over stations ``j`` in ``range(start, stop, stride)``, from base to tip or from tip to base.

    With a stride, the body does so many stations at a time: ``j``, ``j + 1`` and so on, which may be unlike each other
    where they come again and again in one order.
    """

    order: Order
    start: int
    stop: int
    body: tuple[Assign | Require, ...]
    stride: int = 1

    def __hash__(self) -> int:
        """Hash once: passes ask again and again, and bodies are long."""
        return self._hash

    @cached_property
    def _hash(self) -> int:
        return hash((self.order, self.start, self.stop, self.body, self.stride))

    @property
    def last(self) -> int:
        """The largest ``j``."""
        return self.stop - self.stride

    @property
    def visits(self) -> range:
        """Every ``j``, base to tip."""
        return range(self.start, self.stop, self.stride)

    @property
    def parallel(self) -> bool:
        """Whether iterations are independent, so that a backend may do all stations at once."""
        if self.stride > 1:
            return False
        written = {s.target.variable: s.target.offset for s in self.body if isinstance(s, Assign)}
        assigned: set[sp.Symbol] = set()
        for statement in self.body:
            for ref in refs_in(statement.value):
                if ref.variable not in written:
                    continue
                if ref.offset is None:
                    if ref not in assigned:
                        return False  # a scalar carried from one station to the next
                elif ref.offset != written[ref.variable]:
                    return False  # another station's element
            if isinstance(statement, Assign):
                assigned.add(statement.target)
        return True


@dataclass(frozen=True)
class Section:
    """Statements under a title; titles become comments in the generated code."""

    title: str
    statements: tuple[Assign | Require | Loop | Mark, ...]


Statement = Assign | Require | Loop | Mark


@dataclass(frozen=True)
class Routine:
    """A function of the generated kernel.

    Parameters
    ----------
    name : str
        "prepare", "initialise", "step", "step_start1", ... or "output".
    doc : str
        What it does, for readers of the generated code.
    sections : tuple of Section
        The body.
    """

    name: str
    doc: str
    sections: tuple[Section, ...]

    def statements(self) -> Iterator[Statement]:
        """Yield top-level statements (loops included) in order."""
        for section in self.sections:
            yield from section.statements

    def assignments(self) -> Iterator[Assign]:
        """Yield every assignment, also those inside loops."""
        for statement in self.statements():
            for inner in statement.body if isinstance(statement, Loop) else (statement,):
                if isinstance(inner, Assign):
                    yield inner

    def values(self) -> Iterator[sp.Expr]:
        """Yield every expression that is evaluated."""
        for statement in self.statements():
            for inner in statement.body if isinstance(statement, Loop) else (statement,):
                yield inner.value

    def read(self) -> frozenset[Variable]:
        """Variables that occur in expressions."""
        return self._read

    @cached_property
    def _read(self) -> frozenset[Variable]:
        return frozenset().union(*map(variables_in, self.values()))

    def written(self) -> frozenset[Variable]:
        """Variables that are assigned."""
        return frozenset(assign.target.variable for assign in self.assignments())

    def variables(self, role: Role) -> tuple[Variable, ...]:
        """Variables of a role that the routine reads or writes, by name."""
        return tuple(
            sorted((v for v in self.read() | self.written() if v.role is role), key=lambda v: v.name)
        )


@dataclass(frozen=True)
class Sensitivities:
    """How a step's result follows its state and inputs, to first order: exact, one direction at a time.

    Parameters
    ----------
    point : tuple of Variable
        What the step keeps for its tangents (role POINT); none where the arm is linear.
    state, inputs : tuple of Variable
        Changes of the program's state and inputs, in their order and under their names (roles TANGENT and
        INPUT_TANGENT).
    linearise : Routine
        The step, which also writes the point.
    tangent : Routine
        From the changes before the step to the changes of the state after it, with the factors of the point.
    reduced : Reduced, optional
        How else a tangent is carried, where there are fewer directions than the state has.
    """

    point: tuple[Variable, ...]
    state: tuple[Variable, ...]
    inputs: tuple[Variable, ...]
    linearise: Routine
    tangent: Routine
    reduced: Reduced | None = None


@dataclass(frozen=True)
class Vectors:
    """A step whose stages are solved at once, with vectors of stages and of systems: the same motion to rounding.

    Parameters
    ----------
    step : Routine
        In place of the main one.
    parts : int
        Of each vector.
    """

    step: Routine
    parts: int


@dataclass(frozen=True)
class Program:
    """A whole kernel.

    Parameters
    ----------
    name, title : str
        Of the scene.
    stations : int
        Number of links.
    step : Variable
        The time step, with the scene's default.
    parameters, coefficients, state, inputs, outputs, given : tuple of Variable
        In the order in which backends lay them out. Inputs are scalars, or, where a step has several stages,
        arrays over the stages: the value at ``t + instant*h`` of each (``stage_instants``); a held input repeats it.
    prepare, initialise, output : Routine
        Phases besides the step.
    startup : tuple of Routine
        The first steps, one routine each (empty for one-step methods).
    main : Routine
        The step.
    stage_instants : tuple of tuple of float
        For each start-up routine and then the main one: instants in units of the step at which inputs are read.
    facts : mapping from str to str
        For headers: integrator, sweep, unknown and so on, in reading order.
    sensitivities : Sensitivities, optional
        Where the scene asks for them.
    vectors : Vectors, optional
        The step in vectors, for backends that have them, where it is asked for.
    """

    name: str
    title: str
    stations: int
    step: Variable
    parameters: tuple[Variable, ...]
    coefficients: tuple[Variable, ...]
    state: tuple[Variable, ...]
    inputs: tuple[Variable, ...]
    outputs: tuple[Variable, ...]
    given: tuple[Variable, ...]
    prepare: Routine
    initialise: Routine
    startup: tuple[Routine, ...]
    main: Routine
    output: Routine
    stage_instants: tuple[tuple[float, ...], ...]
    facts: dict[str, str] = field(default_factory=dict, hash=False)
    sensitivities: Sensitivities | None = None
    vectors: Vectors | None = None

    @property
    def steps(self) -> tuple[Routine, ...]:
        """Start-up routines in order, then the main one."""
        return (*self.startup, self.main)

    @cached_property
    def model(self) -> tuple[Variable, ...]:
        """What prepare leaves for the later phases: coefficients, and parameters the later phases read."""
        routines = [*self.steps, self.output]
        if self.sensitivities is not None:
            routines += [self.sensitivities.linearise, self.sensitivities.tangent]
        if self.vectors is not None:
            routines.append(self.vectors.step)
        later = set().union(*(routine.read() for routine in routines))
        kept = tuple(v for v in (self.step, *self.parameters) if v in later)
        return (*kept, *(c for c in self.coefficients if c in later))
