"""Statements of a program in JAX: parallel loops become whole-array statements, others walks along the stations.

Nothing is unrolled, so that what is compiled does not grow with the arm; only a loop of one visit is no loop.
"""

from __future__ import annotations

from collections.abc import Sequence

from tmm_gen.emit.expressions import element
from tmm_gen.emit.python.lines import assignment, call, comment, listing
from tmm_gen.emit.python.names import Names
from tmm_gen.emit.python.printer import PythonPrinter
from tmm_gen.emit.python.routine import PythonRoutine
from tmm_gen.emit.python.storage import rebound, vectorised
from tmm_gen.errors import UserError
from tmm_gen.program.passes.join import join
from tmm_gen.program.passes.lifetimes import carried_scalars, dead_after, written_scalars
from tmm_gen.program.statements import Assign, Loop, Order, Repeat, Require, Routine, Statement, Until
from tmm_gen.program.variables import Ref, Variable

_INDENT = "    "
_LONG = 50
"""Characters from which on a value that is put into an array has a line of its own."""
_BESIDE = {0: "here", 1: "next", -1: "before"}


class RoutineText(PythonRoutine):
    """The body of one generated function, see :class:`~tmm_gen.emit.python.routine.PythonRoutine`."""

    def __init__(self, routine: Routine, names: Names, stations: int) -> None:
        routine = join(routine)
        super().__init__(routine, names, stations)
        self._statements = tuple(routine.statements())
        whole = vectorised(routine)
        self._whole = frozenset(
            k for k in whole if isinstance(s := self._statements[k], Loop) and len(s.visits) > 1
        )
        self._rebound = rebound(routine, self._whole)
        self._inside = ""  # what is repeated stands in a function of its own
        self._seen: set[tuple[str, str]] = set()

    def lines(self, known: Sequence[Variable]) -> list[str]:
        """Return the statements, indented once, after zeros for what they fill piece by piece and do not know."""
        filled = {v for v in self._routine.written() if v.length is not None} - self._rebound
        filled |= {v for k in range(len(self._statements)) for v in self._kept(k)}
        made = self._names.in_order(filled - set(known))
        lines = [f"{_INDENT}{self._names[v]} = {self._zeros(v)}" for v in made]
        place = 0
        for section in self._routine.sections:
            lines += ["", *comment(section.title, _INDENT + self._inside)]
            for statement in section.statements:
                new = self._statement(statement, place)
                if (
                    new
                    and new[0].lstrip().startswith("def ")
                    and not lines[-1].lstrip().startswith(("#", "def"))
                ):
                    lines.append("")
                lines += new
                place += 1
        return lines

    def _statement(self, statement: Statement, place: int) -> list[str]:
        indent = _INDENT + self._inside
        if isinstance(statement, Repeat | Until):
            return self._repeated(statement, place)
        if not isinstance(statement, Loop):
            target = statement.target.variable if isinstance(statement, Assign) else None
            if target and target.length is None and dead_after(target, self._later(place)):
                return []  # what a loop sets anew at each station
            return self._single(statement, None, indent)
        if len(statement.visits) == 1 or place in self._whole:
            return [line for inner in statement.body for line in self._single(inner, statement, indent)]
        return self._walk(statement, place, indent)

    def _single(self, statement: Assign | Require, loop: Loop | None, indent: str) -> list[str]:
        """Write a statement for all visits of a loop at once."""
        value = PythonPrinter(lambda ref: self._elements(ref, loop), "jnp").text(statement.value)
        if isinstance(statement, Require):
            return call("good = good & _positive", [value], indent)
        if statement.target.variable.length is None:
            name = self._names[statement.target.variable] + self._types.annotation(statement)
            return assignment(name, value, indent)
        return self._put(statement.target, value, loop, indent)

    def _put(self, target: Ref, value: str, loop: Loop | None, indent: str) -> list[str]:
        """Write where the values of all visits go."""
        name, length = self._names[target.variable], target.variable.length
        if target.variable in self._rebound:
            return assignment(name, value, indent)
        visits = range(1) if loop is None else loop.visits
        first, last = (target.entry or 0,) * 2
        if target.offset is not None:
            first, last = visits[0] + target.offset, visits[-1] + target.offset
        if value.startswith("made[") and (last + 1 - first, visits.step) == (length, 1):
            return assignment(name, value, indent)
        lines = []
        if len(value) > _LONG:
            lines, value = assignment("new", value, indent), "new"
        if visits.step > 1 and first != last:
            return [*lines, f"{indent}{name} = {name}.at[{first}:{last + 1}:{visits.step}].set({value})"]
        return [*lines, *call(f"{name} = _put", [name, value, str(first), str(last + 1)], indent)]

    def _zeros(self, variable: Variable) -> str:
        return "0.0" if variable.length is None else f"jnp.zeros({self.count(variable.length)}, dtype)"

    def _elements(self, ref: Ref, loop: Loop | None) -> str:
        """Write all of a loop's elements of an array, or the one of its only visit."""
        name = self._names[ref.variable]
        if ref.variable.length is None or ref.offset is None or loop is None:
            return element(name, ref)
        first, last = loop.visits[0] + ref.offset, loop.visits[-1] + ref.offset
        if first == last:
            return f"{name}[{first}]"
        if (first, last + 1, loop.stride) == (0, ref.variable.length, 1):
            return name
        return f"{name}[{first}:{last + 1}{f':{loop.stride}' if loop.stride > 1 else ''}]"

    def _walk(self, loop: Loop, place: int, indent: str) -> list[str]:
        """Write a loop whose stations hand scalars on."""
        carried, later = carried_scalars(loop), self._later(place)
        alive = {v for v in written_scalars(loop) if not dead_after(v, later)}
        carry = self._names.in_order(carried | alive)
        targets = dict.fromkeys(s.target for s in loop.body if isinstance(s, Assign))
        written = [ref for ref in targets if ref.variable.length is not None]
        along: dict[Ref, str] = {}
        made: set[Ref] = set()

        def refer(ref: Ref) -> str:
            if any(_before(ref, other, loop) for other in written):
                raise UserError(
                    f"emit.backends: jax cannot write {self._routine.name}, where {ref.variable.name} goes from one "
                    'station to the next in an array. Leave "jax" out.'
                )
            if ref.variable.length is None or ref.offset is None:
                return element(self._names[ref.variable], ref)
            if ref not in made:
                along[ref] = self._elements(ref, loop)
            return self._here(ref)

        printer = PythonPrinter(refer, "jnp")
        body: list[str] = []
        inner_indent = indent + _INDENT
        for inner in loop.body:
            value = printer.text(inner.value)
            if isinstance(inner, Require):
                body += call("good = good & _positive", [value], inner_indent)
            else:
                body += assignment(self._here(inner.target), value, inner_indent)
                made.add(inner.target)
        good = ["good"] * any(isinstance(inner, Require) for inner in loop.body)
        names = [self._names[v] for v in carry] + good
        starts = [self._names[v] if v in carried else "0.0" for v in carry] + good
        order = ["inward=True"] * (loop.order is Order.INWARD)
        return [
            f"{indent}def _visit{place}(carry: Any, here: Any) -> Any:",
            *_unpacked(names, "carry", inner_indent),
            *_unpacked([self._here(ref) for ref in along], "here", inner_indent),
            *body,
            *listing("carry = ", names, inner_indent),
            *listing("made = ", [self._here(ref) for ref in written], inner_indent),
            f"{inner_indent}return carry, made",
            "",
            *listing(f"{self._any('carry')} = ", starts, indent),
            *listing(f"{self._any('along')} = ", list(along.values()), indent),
            *call(
                "carry, made = _walk",
                [f"_visit{place}", "carry", "along", "dtype", str(len(loop.visits)), *order],
                indent,
            ),
            *_unpacked(names, "carry", indent),
            *(line for k, ref in enumerate(written) for line in self._put(ref, f"made[{k}]", loop, indent)),
        ]

    def _here(self, ref: Ref) -> str:
        """Return the name of what a visit sees of a variable."""
        if ref.variable.length is None:
            return self._names[ref.variable]
        offset = ref.offset or 0
        word = _BESIDE.get(offset, f"{'plus' if offset > 0 else 'minus'}{abs(offset)}")
        return self._names.beside(ref.variable, word)

    def _any(self, name: str) -> str:
        """Return a name, with its type where a function has it for the first time."""
        known = (name, self._inside) in self._seen
        self._seen.add((name, self._inside))
        return name if known else f"{name}: Any"

    # -- what is repeated

    def _block(self, place: int) -> range:
        """Return the places that are repeated together with one, which may be that of the mark at either end."""
        marks = [k for k, s in enumerate(self._statements) if isinstance(s, Repeat | Until)]
        ends = zip(marks[::2], marks[1::2], strict=True)
        return next((range(a + 1, b) for a, b in ends if a <= place <= b), range(0))

    def _later(self, place: int) -> tuple[Statement, ...]:
        """Return what may be done after a statement, marks by what they read."""
        block = self._block(place)
        places = [
            *range(place + 1, block.stop),
            *block,
            *range(max(place + 1, block.stop), len(self._statements)),
        ]
        lines = (self._statements[k] for k in places)
        return tuple(Require(s.value) if isinstance(s, Repeat | Until) else s for s in lines)

    def _kept(self, place: int) -> list[Variable]:
        """Return what a repeated block hands on to its next time, and to what follows."""
        block = self._block(place)
        written = {v for k in block for v in _written(self._statements[k])}
        later = self._later(block.stop - 1) if block else ()
        return self._names.in_order(v for v in written if v.length is not None or not dead_after(v, later))

    def _repeated(self, mark: Repeat | Until, place: int) -> list[str]:
        """Begin or end what is repeated, a function of what it hands on."""
        block, names = self._block(place), [self._names[v] for v in self._kept(place)] + ["good"]
        if isinstance(mark, Repeat):
            self._inside = _INDENT
            self._seen = {("carry", _INDENT), *(each for each in self._seen if not each[1])}
            return [
                f"{_INDENT}def _again{block.start}(carry: Any) -> Any:",
                *_unpacked(names, "carry", 2 * _INDENT),
            ]
        self._inside = ""
        first = self._statements[block.start - 1]
        assert isinstance(first, Repeat)
        more = PythonPrinter(lambda ref: self._elements(ref, None), "jnp").text(mark.value)
        return [
            *listing("carry = ", names, 2 * _INDENT),
            f"{2 * _INDENT}return carry, {more} > 0.0",
            "",
            *listing(f"{self._any('carry')} = ", names, _INDENT),
            f"{_INDENT}carry = _repeat(_again{block.start}, carry, dtype, {first.most})",
            *_unpacked(names, "carry", _INDENT),
        ]


def _written(statement: Statement) -> list[Variable]:
    inner = statement.body if isinstance(statement, Loop) else (statement,)
    return [each.target.variable for each in inner if isinstance(each, Assign)]


def _before(ref: Ref, written: Ref, loop: Loop) -> bool:
    """Whether an earlier visit wrote what is read."""
    if ref.variable != written.variable or ref == written:
        return False
    if ref.offset is None or written.offset is None:
        return True
    apart = ref.offset - written.offset
    return apart % loop.stride == 0 and (apart < 0) == (loop.order is Order.OUTWARD)


def _unpacked(names: list[str], source: str, indent: str) -> list[str]:
    return listing("", names, indent, f" = {source}") if names else []
