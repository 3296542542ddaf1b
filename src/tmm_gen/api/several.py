"""Arguments that are several words or numbers: what a study varies, what is compared."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import get_args

from tmm_gen.api.given import required
from tmm_gen.api.words import whole
from tmm_gen.errors import UserError
from tmm_gen.scene import Scene
from tmm_gen.scene.emit import Emit
from tmm_gen.scene.model import Linearisation
from tmm_gen.study.axes import axes_of
from tmm_gen.study.configuration import Backend
from tmm_gen.study.grid import Axes

__all__ = ["Few", "axes_given", "texts", "wholes"]

Few = Iterable[object] | object | None
"""One, several, or None for the usual ones."""

_CHOICES: Mapping[str, tuple[str, ...]] = {
    "linearisations": get_args(Linearisation),
    "reals": get_args(Emit.model_fields["real"].annotation),
    "backends": get_args(Backend),
}


def _listed(value: Few) -> tuple[object, ...]:
    if value is None:
        return ()
    return tuple(value) if isinstance(value, Iterable) and not isinstance(value, str | bytes) else (value,)


def texts(what: str, value: Few, choices: tuple[str, ...] = ()) -> tuple[str, ...]:
    """Return words, of some choices where there are such.

    Raises
    ------
    UserError
        If one is none.
    """
    found = []
    for each in _listed(value):
        if not isinstance(each, str):
            raise UserError(f"{what}: {each!r} is no name. Give one, or a list of them.")
        if choices and each not in choices:
            raise UserError(f"{what}: '{each}' is none of {', '.join(choices)}")
        found.append(each)
    return tuple(found)


def wholes(what: str, value: Few, least: int = 1) -> tuple[int, ...]:
    """Return whole numbers.

    Raises
    ------
    UserError
        If one is none, or too small.
    """
    return tuple(whole(what, each, least) for each in _listed(value))


def axes_given(scene: Scene, options: Mapping[str, Few]) -> Axes:
    """Return what a study varies; options by the names of the parameters of `Axes`, absent or None for the usual.

    Raises
    ------
    UserError
        If one is not of its kind, or does not suit the scene.
    """
    read: dict[str, tuple[object, ...]] = {"integrators": texts("integrators", options.get("integrators"))}
    read["steps"] = tuple(required("steps", each, "seconds") for each in _listed(options.get("steps")))
    for name, least in (("links", 1), ("iterations", 1), ("corrections", 0)):
        read[name] = wholes(name, options.get(name), least)
    for name, choices in _CHOICES.items():
        read[name] = texts(name, options.get(name), choices)
    return axes_of(scene, read)
