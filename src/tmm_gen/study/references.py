"""Reference motions of a scene by number of links, each integrated once."""

from __future__ import annotations

import hashlib
from dataclasses import replace
from pathlib import Path

from tmm_gen.errors import UserError
from tmm_gen.scene import Scene
from tmm_gen.study.cells import cut_into, cuts
from tmm_gen.study.configuration import own
from tmm_gen.study.excitation import Excitation
from tmm_gen.study.store import Store
from tmm_gen.study.tasks import study_key
from tmm_gen.study.truth import Truth, find_truth, packed, unpacked


class References:
    """Reference motions by number of links, each integrated once, and kept in the store if there is one.

    Relative errors are relative to the travel of the output with the scene's own links.

    Parameters
    ----------
    scene : Scene
        As the user wrote it.
    excitation : Excitation
        What it goes through.
    store : Path, optional
        See :class:`Store`.
    """

    def __init__(self, scene: Scene, excitation: Excitation, store: Path | None = None) -> None:
        self._scene = scene
        self._excitation = excitation
        self._store = store
        self._found: dict[int | None, Truth] = {}

    def of(self, links: int | None) -> Truth:
        """Return the reference with a number of links.

        Raises
        ------
        SceneError
            If the scene cannot have so many.
        ReferenceError
            If the equations cannot be integrated.
        """
        if links not in self._found:
            mine = own(self._scene).family.links
            found = self._find(links)
            # one unit for all, so that errors of different numbers of links can be added and compared
            self._found[links] = found if links == mine else replace(found, unit=self.travel())
        return self._found[links]

    def travel(self) -> float:
        """Return how far the output gets with the scene's own links.

        Raises
        ------
        UserError
            If it does not move.
        ReferenceError
            If the equations cannot be integrated.
        """
        found = self.of(own(self._scene).family.links).travel
        if not found > 0.0:
            raise UserError(
                f"scene '{self._scene.name}': the output '{self._excitation.output}' does not move in "
                f"{self._excitation.until:g} s, so that there is nothing to compare. Choose another --output, "
                "another --input, or a longer time (--until)."
            )
        return found

    def _find(self, links: int | None) -> Truth:
        scene = self._scene
        if links is not None and links != cut_into(scene):
            scene = scene.replace(**{key: new for key, (_, new) in cuts(scene, links).items()})
        if self._store is None:
            return find_truth(scene, self._excitation)
        key = hashlib.sha256(f"{study_key(self._scene, self._excitation)} {links}".encode()).hexdigest()
        with Store(self._store) as store:
            if (known := store.reference(key)) is not None:
                return Truth(scene, self._excitation, unpacked(known))
            truth = find_truth(scene, self._excitation)
            if truth.trajectory is not None:
                store.keep_reference(key, packed(truth.trajectory))
            return truth
