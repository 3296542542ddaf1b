"""What each part of an arm in space costs in a step: every operation is one part's, one load's, or no one's own."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

from tmm_gen.c_language.real import Real
from tmm_gen.explain.cost import footprint_of
from tmm_gen.explain.footprint import Footprint
from tmm_gen.program.count import count_by_station
from tmm_gen.program.space.loads import load_title
from tmm_gen.program.statements import Program, Routine, Section
from tmm_gen.program.variables import Variable
from tmm_gen.scene.spatial.arm import ArmInput, SpatialArm
from tmm_gen.scene.spatial.document import SpatialDocument

SHARED = "what is no single joint's"


@dataclass(frozen=True)
class Share:
    """What something in the scene costs.

    Parameters
    ----------
    name : str
        A part, a load, an output.
    why : str
        Which joints are its own, or what it is.
    worth : Footprint
        Of a step, an output call, prepare, and of the structs.
    """

    name: str
    why: str
    worth: Footprint


def shares(document: SpatialDocument, arm: SpatialArm, program: Program, real: Real) -> list[Share]:
    """Return what parts, loads and outputs cost; together all of the program's footprint.

    Parameters
    ----------
    document : SpatialDocument
        The scene as it is written.
    arm : SpatialArm
        What it makes.
    program : Program
        Of the arm.
    real : Real
        Number type of the C.
    """
    loads = {load_title(item): item for item in arm.inputs if item.frame is not None and item.frame.joint}
    own = [s for s in program.main.sections if _load(s, loads) is None]
    step = _counted(own)
    prepare = _counted(program.prepare.sections)
    state, model = (_by_station(v) for v in (program.state, program.model))
    found = []
    for name, stations in _parts(document):
        numbers = _bytes(state, stations, real), _bytes(model, stations, real)
        worth = Footprint(_sum(step, stations), 0, _sum(prepare, stations), *numbers)
        title, why = _told(document, arm, name, stations)
        found.append(Share(title, why, worth))
    found += _loads(program.main, loads)
    whole = footprint_of(program, real)
    scalars = [
        total - sum(getattr(share.worth, key) for share in found)
        for key, total in (("state_bytes", whole.state_bytes), ("model_bytes", whole.model_bytes))
    ]
    rest = Footprint(step[None], 0, prepare[None], *scalars)
    afloat = "the base, which floats, " if arm.base is not None else ""
    found.append(Share(SHARED, f"{afloat}scalars, and torques as they come in", rest))
    return [*found, *_outputs(program)]


def _parts(document: SpatialDocument) -> Iterator[tuple[str, list[int]]]:
    """Yield the name of each part that turns or bends, and its stations from 0, base to tips."""
    inner = document.expansion.inner
    for name in dict.fromkeys(inner):
        yield name, [k for k, part in enumerate(inner) if part == name]


def _told(document: SpatialDocument, arm: SpatialArm, name: str, stations: Sequence[int]) -> tuple[str, str]:
    """Return what a part is called, and why it costs something."""
    turning = arm.joints[stations[0]].given
    if turning:
        return "the base", f"turns as input '{turning}' says"
    return f"{_kind(document, name)} '{name}'", _why(document, arm, name, stations)


def _kind(document: SpatialDocument, name: str) -> str:
    return next(
        kind
        for kind in ("motor", "joint", "beam")
        if any(part.name == name for part in getattr(document, kind))
    )


def _why(document: SpatialDocument, arm: SpatialArm, name: str, stations: Sequence[int]) -> str:
    first, last = stations[0] + 1, stations[-1] + 1
    if first == last:
        told = f"joint {first} about its {'xyz'[arm.joints[first - 1].axis]} axis"
    elif _kind(document, name) == "motor":
        axis = "xyz"[arm.joints[first - 1].axis]
        told = f"joints {first} and {last} about one {axis} axis, the rotor and its elastic gear"
    else:
        cells = next(beam.links for beam in document.beam if beam.name == name)
        told = f"{cells} cell{'s' * (cells != 1)}, joints {first} to {last}"
    carried = [f.name for f in arm.frames if f.name != name and f.joint == last]
    return told + (f", and the bodies of {_listed(carried)}" if carried else "")


def _listed(names: Sequence[str]) -> str:
    quoted = [f"'{name}'" for name in names]
    return quoted[0] if len(quoted) == 1 else f"{', '.join(quoted[:-1])} and {quoted[-1]}"


def _loads(main: Routine, loads: dict[str, ArmInput]) -> Iterator[Share]:
    """Yield forces and moments; several of one kind on one frame are one load to the code."""
    total: Counter[str] = Counter()
    for section in main.sections:
        if (title := _load(section, loads)) is not None:
            total[title] += sum(_counted([section]).values())
    for title, count in total.items():
        yield Share(f"input '{loads[title].name}'", title, Footprint(count, 0, 0, 0, 0))


def _load(section: Section, loads: dict[str, ArmInput]) -> str | None:
    return next((title for title in loads if section.title.endswith(title)), None)


def _outputs(program: Program) -> Iterator[Share]:
    for section in program.output.sections:
        name, _, of = section.title.partition(": ")
        count = sum(_counted([section]).values())
        yield Share(f"output '{name.removeprefix('output ')}'", of, Footprint(0, count, 0, 0, 0))


def _counted(sections: Iterable[Section]) -> Counter[int | None]:
    return count_by_station(s for section in sections for s in section.statements)


def _sum(counts: Counter[int | None], stations: Iterable[int]) -> int:
    return sum(counts[k] for k in stations)


def _by_station(variables: Iterable[Variable]) -> int:
    """Return how many numbers each station has."""
    return sum(v.length is not None for v in variables)


def _bytes(numbers: int, stations: Sequence[int], real: Real) -> int:
    return numbers * len(stations) * real.number_size
