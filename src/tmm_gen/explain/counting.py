"""What each term of a scene costs or saves, counted in programs with and without it."""

from __future__ import annotations

from collections.abc import Callable

from tmm_gen.c_language.real import Real, real_of
from tmm_gen.derive.integrators.history import history_depth
from tmm_gen.derive.integrators.registry import integrator
from tmm_gen.explain.cost import footprint, footprint_of
from tmm_gen.explain.explanation import Explained, Explanation
from tmm_gen.explain.footprint import Footprint
from tmm_gen.explain.space_shares import shares
from tmm_gen.explain.space_terms import space_terms
from tmm_gen.explain.terms import Term, terms_of, up_to
from tmm_gen.program.build import build_program
from tmm_gen.program.statements import Program
from tmm_gen.program.variables import Variable
from tmm_gen.scene import Scene
from tmm_gen.scene.check import document_of
from tmm_gen.scene.spatial.document import SpatialDocument

NOTHING = Footprint(0, 0, 0, 0, 0)


def counted(scene: Scene, advance: Callable[[str], None]) -> Explanation:
    """Build the programs of a scene with and without each term, and count them; ``advance`` hears of each."""
    program = build_program(scene)
    own = footprint_of(program, real_of(scene.emit))
    advance("the scene")
    found = []
    full = scene
    for term in terms_of(scene) if scene.spatial is None else space_terms(scene, scene.spatial):
        found.append(_explained(term, scene, own))
        if not term.modelled:
            full = term.other(full)
        advance(term.name)
    found = [*(_parts(scene, own) if scene.spatial is None else _shares(scene, program)), *found]
    found += [_history(scene, program), _hoisted(scene, program, own), *_side_by_side(scene, own)]
    whole = build_program(full)
    everything = footprint_of(whole, real_of(scene.emit))
    everything = everything - Footprint(
        -everything.prepare,
        0,
        everything.prepare,
        -_history(full, whole).worth.state_bytes,
        _coefficient_bytes(whole, real_of(scene.emit)),
    )
    advance("everything")
    return Explanation(scene, own, tuple(found), everything)


def _shares(scene: Scene, program: Program) -> list[Explained]:
    """Return what each part, load and output in space costs: all of the program together."""
    document = document_of(scene.source)
    assert isinstance(document, SpatialDocument)
    assert scene.spatial is not None
    found = shares(document, scene.spatial, program, real_of(scene.emit))
    return [Explained(share.name, True, share.why, share.worth) for share in found]


def _parts(scene: Scene, own: Footprint) -> list[Explained]:
    """Return what each beam and link costs with the joint that carries it: the arm up to it less that before it."""
    found = []
    before, carried = NOTHING, ""
    for part in scene.parts:
        if part.joint:
            carried = f", on {part.kind} '{part.name}'"
        if part.kind not in ("beam", "link") or part.fixed or not part.last:  # not of its own, or the hub
            continue
        upto = own if part.last == scene.stations else footprint(up_to(scene, part.last))
        count = part.last - part.first + 1
        why = (f"links {part.first} to {part.last}" if count > 1 else f"link {part.last}") + carried
        found.append(Explained(f"{part.kind} '{part.name}'", True, why, upto - before))
        before, carried = upto, ""
    return found


def _explained(term: Term, scene: Scene, own: Footprint) -> Explained:
    other = footprint(term.other(scene))
    worth = own - other if term.modelled else other - own
    return Explained(term.name, term.modelled, term.why, worth)


def _history(scene: Scene, program: Program) -> Explained:
    """Count the numbers a state would hold if it kept angle, rate and acceleration of each instant looked back to.

    Of a step whose stages are solved at once, accelerations at all of them.
    """
    method = integrator(scene.integrator.name, **scene.integrator.parameters)
    depth = history_depth(method)
    turning = scene.stations + scene.base.moves
    motion = [v for v in program.state if _is_motion(v)]
    kept = sum(v.length or 1 for v in motion)
    accelerations = len(method.main.stages) if method.main.coupled else 1
    saved = ((2 + accelerations) * depth * turning - kept) * real_of(scene.emit).number_size
    per_link = sum(1 for v in motion if v.length is not None)
    each = "link" if scene.spatial is None else "joint"
    why = f"{method.name} looks back {depth} instant{'s' * (depth > 1)}: {per_link} numbers a {each} are read"
    return Explained("history that no step reads", False, why, Footprint(0, 0, 0, saved, 0))


def _is_motion(variable: Variable) -> bool:
    names = ("angle", "rate", "acceleration")
    return variable.name.removeprefix("hub_").partition("_")[0] in names


def _hoisted(scene: Scene, program: Program, own: Footprint) -> Explained:
    """Count what each step would repeat if parameters or step could change between steps."""
    why = "parameters and step stay as they are: prepare computes what depends on them alone, once"
    bytes_kept = _coefficient_bytes(program, real_of(scene.emit))
    return Explained(
        "parameters that change between steps", False, why, Footprint(own.prepare, 0, 0, 0, -bytes_kept)
    )


def _side_by_side(scene: Scene, own: Footprint) -> list[Explained]:
    """Say what the kernel for many arms keeps, and what it does for that; nothing where there is none."""
    arms = scene.emit.batch
    if arms is None:
        return []
    why = f"a second kernel steps {arms} by the instructions of one, {own.step} operations an arm; it holds all of them"
    return [
        Explained(
            "arms side by side",
            True,
            why,
            Footprint(0, 0, 0, (arms - 1) * own.state_bytes, (arms - 1) * own.model_bytes),
        )
    ]


def _coefficient_bytes(program: Program, real: Real) -> int:
    """Return the bytes of what prepare computes and the model keeps."""
    return sum(v.length or 1 for v in program.coefficients) * real.number_size
