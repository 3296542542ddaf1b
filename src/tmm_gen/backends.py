"""The one registry of backends: those of tmm-gen, and those that other packages bring by an entry point.

Another package adds a backend by an entry point of the group ``tmm_gen.backends``, whose name is what scenes write in
``[emit] backends`` and whose value is a function of a program and a scene that returns texts by path::

    [project.entry-points."tmm_gen.backends"]
    julia = "my_package.julia:emit_julia"

Here are names only: reading a scene must not wait for what prints it.
"""

from __future__ import annotations

from functools import cache
from importlib.metadata import EntryPoint, entry_points

GROUP = "tmm_gen.backends"

OWN: tuple[EntryPoint, ...] = (
    EntryPoint("numpy", "tmm_gen.emit.numpy:emit_numpy", GROUP),
    EntryPoint("c", "tmm_gen.emit.c:emit_c", GROUP),
    EntryPoint("casadi", "tmm_gen.emit.casadi:emit_casadi", GROUP),
    EntryPoint("jax", "tmm_gen.emit.jax:emit_jax", GROUP),
)
"""Backends that come with tmm-gen, in the order in which scenes list them."""

USUAL = ("numpy", "c", "casadi")
"""Those that are written for a scene that names none."""


def backend_named(name: str) -> EntryPoint | None:
    """Return where the emitter of a backend lies; ``.load()`` imports it. None if there is no such backend.

    A backend of tmm-gen is found without a look at other packages, and none of these can take its name.
    """
    return next((each for each in (*OWN, *_others(name)) if each.name == name), None)


def backend_names() -> tuple[str, ...]:
    """Return the names of all backends: tmm-gen's own, then others by name."""
    own = [each.name for each in OWN]
    others = {each.name for each in entry_points(group=GROUP)}
    return (*own, *sorted(others.difference(own)))


@cache
def _others(name: str) -> tuple[EntryPoint, ...]:
    if any(each.name == name for each in OWN):
        return ()
    return tuple(entry_points(group=GROUP, name=name))
