"""The number of links of a scene's beam; of an arm in space the number of cells that all of its beams have."""

from __future__ import annotations

from tmm_gen.scene import Scene
from tmm_gen.scene.check import document_of
from tmm_gen.scene.spatial.document import SpatialDocument


def cut_into(scene: Scene) -> int | None:
    """Return the number; None without a beam, or where beams in space are cut into different numbers of cells."""
    if scene.spatial is None:
        return scene.beam.links if scene.beam is not None else None
    numbers = set(beams(scene).values())
    return numbers.pop() if len(numbers) == 1 else None


def can_be_cut(scene: Scene) -> bool:
    """Return whether there is a beam."""
    return scene.beam is not None or bool(beams(scene))


def cuts(scene: Scene, links: int) -> dict[str, tuple[object, object]]:
    """Return keys of the scene's file that say how beams are cut, each with what it says and what it is to say."""
    if scene.spatial is None:
        return {} if scene.beam is None else {"beam.links": (scene.beam.links, links)}
    return {f"beam.{name}.links": (old, links) for name, old in beams(scene).items()}


def beams(scene: Scene) -> dict[str, int]:
    """Return the cells of each beam of an arm in space, by its name."""
    if scene.spatial is None:
        return {}
    document = document_of(scene.source)
    assert isinstance(document, SpatialDocument)
    return {beam.name: beam.links for beam in document.beam}
