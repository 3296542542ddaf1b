"""An explanation as rows and sentences."""

from __future__ import annotations

from tmm_gen.explain.explanation import Explained, Explanation
from tmm_gen.scene import Scene
from tmm_gen.scene.check import document_of
from tmm_gen.scene.spatial.beam import per_length
from tmm_gen.scene.spatial.document import SpatialDocument
from tmm_gen.scene.spatial.tables import SpatialBeam

__all__ = ["beam_rows", "beam_sentences", "headline", "term_row", "whole_sentence"]


def headline(found: Explanation) -> str:
    """Say what the whole scene costs."""
    own = found.own
    return (
        f"{found.scene.title}: {own.step} operations a step, {own.state_bytes} bytes of state, "
        f"{own.model_bytes} of model"
    )


def whole_sentence(found: Explanation) -> str:
    """Say what the scene would cost with all that was left out."""
    own, everything = found.own, found.everything
    return (
        f"all that was left out put in at once: {everything.step} operations a step "
        f"({everything.step / max(own.step, 1):.1f} times as many), {everything.state_bytes} bytes of state"
    )


def beam_sentences(scene: Scene) -> list[str]:
    """Say what beams weigh and how stiff they are, where that follows from material and section."""
    return [
        f"{beam['beam']}: {_bending(beam)} and {beam['mass_per_length']:.6g} kg/m, "
        "as material and section have it"
        for beam in beam_rows(scene)
        if beam["from_section"]
    ]


def term_row(explained: Explained) -> dict[str, object]:
    """Return what a table shows of a term."""
    worth = explained.worth
    return {
        "term": explained.term,
        "status": "modelled" if explained.modelled else "left out",
        "why": explained.why,
        "operations_per_step": worth.step,
        "operations_per_output": worth.output,
        "operations_of_prepare": worth.prepare,
        "state_bytes": worth.state_bytes,
        "model_bytes": worth.model_bytes,
    }


def beam_rows(scene: Scene) -> list[dict[str, object]]:
    """Return the numbers of each beam, given or as they follow from its material and section."""
    document = document_of(scene.source)
    if isinstance(document, SpatialDocument):
        return [_in_space(beam) for beam in document.beam]
    found: list[dict[str, object]] = []
    for beam in document.beams().values():
        name, (stiffness, mass) = getattr(beam, "name", ""), beam.stiffness_and_mass()
        found.append(
            {
                "beam": f"beam '{name}'" if name else "beam",
                "bending_stiffness": stiffness,
                "mass_per_length": mass,
                "from_section": beam.section is not None,
            }
        )
    return found


def _in_space(beam: SpatialBeam) -> dict[str, object]:
    """Return the numbers of a beam in space: EI about its y and z axes, GJ where it twists."""
    numbers = per_length(beam)
    return {
        "beam": f"beam '{beam.name}'",
        "bending_stiffness": [float(each) for each in numbers.bending],
        "torsional_stiffness": None if numbers.twisting is None else float(numbers.twisting),
        "mass_per_length": float(numbers.mass),
        "from_section": beam.section is not None,
    }


def _bending(beam: dict[str, object]) -> str:
    """Return the stiffnesses of a beam in words."""
    bending, twisting = beam["bending_stiffness"], beam.get("torsional_stiffness")
    if not isinstance(bending, list):
        return f"EI = {bending:.6g} N m^2"
    y, z = bending
    told = f"EI = {y:.6g} and {z:.6g} N m^2 about y and z"
    return told if twisting is None else f"{told}, GJ = {twisting:.6g} N m^2"
