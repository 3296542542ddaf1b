"""What a study varies, where that suits a scene."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from tmm_gen.errors import UserError
from tmm_gen.scene import Scene
from tmm_gen.scene.integrator import INTEGRATOR_NAMES, underscored
from tmm_gen.study.cells import can_be_cut
from tmm_gen.study.grid import Axes

__all__ = ["axes_of"]


def axes_of(scene: Scene, options: Mapping[str, Any]) -> Axes:
    """Return what is varied.

    Parameters
    ----------
    scene : Scene
        What is computed.
    options : mapping from str to tuple
        By the names of the parameters of :class:`Axes`; all of them, empty for the scene's own choice.

    Raises
    ------
    UserError
        If an option does not suit the scene, or names no integrator.
    """
    names = tuple(underscored(name) for name in options["integrators"])
    for name in names:
        if name not in INTEGRATOR_NAMES:
            raise UserError(
                f"--integrators {name}: no such integrator; there are {', '.join(INTEGRATOR_NAMES)}."
            )
        if name not in scene.integrators:
            raise UserError(
                f"--integrators {name}: does not serve this arm yet; there are {', '.join(scene.integrators)}."
            )
    if options["links"] and not can_be_cut(scene):
        raise UserError("--links: the scene has no [beam] to cut into links; it lists them. Leave it out.")
    given = [f"--{name}" for name in ("linearisations", "iterations", "corrections") if options[name]]
    if given and scene.model.linear:
        raise UserError(f"{', '.join(given)}: a chain is linear, nothing is iterated. Leave that out.")
    if options["corrections"] and scene.spatial is not None:
        raise UserError(
            "--corrections: in space --iterations counts a sweep and its corrections. Write --iterations 1,2."
        )
    return Axes(
        integrators=names,
        steps=options["steps"],
        links=options["links"],
        linearisations=options["linearisations"],
        iterations=options["iterations"],
        corrections=options["corrections"],
        reals=options["reals"],
        backends=options["backends"],
    )
