"""What is there for chains and arms in a plane, and not yet for arms in space."""

from __future__ import annotations

from tmm_gen.errors import UserError
from tmm_gen.scene.scene import Scene


def require_flat(scene: Scene, what: str) -> None:
    """Refuse an arm in space.

    Parameters
    ----------
    what : str
        What is asked for, to be read before "serve arms in space yet": "modes do not".

    Raises
    ------
    UserError
        If the scene is of kind "spatial".
    """
    if scene.spatial is not None:
        raise UserError(
            f'{scene.source.origin}: {what} serve arms in space yet (model.kind = "spatial"). '
            'Use a scene with kind = "planar" or "chain".'
        )
