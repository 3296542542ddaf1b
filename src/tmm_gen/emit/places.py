"""Which elements of a generated package's arrays are whose: of scenes that write their parts by name."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import groupby

from tmm_gen.scene import Scene
from tmm_gen.scene.spatial.beam import CellName


def places(scene: Scene) -> dict[str, str]:
    """Return the elements, counted from 0, of joints and of links by the names of their parts.

    Returns
    -------
    dict of str to str
        ``{"joints": "shoulder 0, elbow 6", "links": "upper 0 to 5, forearm 6 to 11"}``; in space joints alone, and
        nothing where no part has a name.
    """
    if scene.spatial is not None:
        cells = ((joint.name, CellName.of(joint.name)) for joint in scene.spatial.joints)
        names = [cell.beam if cell else name for name, cell in cells]
        runs = (
            (name, [at for at, _ in run]) for name, run in groupby(enumerate(names), key=lambda of: of[1])
        )
        return {"joints": _told((name, run[0], run[-1]) for name, run in runs)}
    joints = [
        (part.name, part.joint - 1, max(part.joint, part.gear) - 1) for part in scene.parts if part.joint
    ]
    links = [
        (part.name, part.first - 1, part.last - 1) for part in scene.parts if part.kind in ("beam", "link")
    ]
    return {what: _told(found) for what, found in (("joints", joints), ("links", links)) if found}


def _told(found: Iterable[tuple[str, int, int]]) -> str:
    """Return names with their first and last element."""
    return ", ".join(f"{name} {first}{f' to {last}' if last > first else ''}" for name, first, last in found)
