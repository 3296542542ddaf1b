"""Planar arms that nothing holds: what their base is made of, and what they do not go with."""

from __future__ import annotations

from collections.abc import Iterator

from tmm_gen.scene.model import FloatingBase
from tmm_gen.scene.parts.document import PartsDocument
from tmm_gen.scene.problem import Finding


def floating_base(document: PartsDocument) -> Iterator[Finding]:
    """Find a floating base that nothing gives inertia, and what does not go with one."""
    if document.base.kind != "free":
        return
    for key in ("inertia", "damping"):
        if key in document.base.model_fields_set:
            yield Finding(
                ("base", key),
                'contradicts kind = "free": such a base is made of the bodies on it, and nothing damps it',
                'Remove it; inertia and mass are those of a [[body]] with `on = "base"`.',
                getattr(document.base, key),
            )
    base = document.expansion.base
    if isinstance(base, FloatingBase) and base.inertia == 0.0:
        first = next((i for i, b in enumerate(document.body) if b.name in document.expansion.on_base), None)
        if first is not None:
            yield Finding(
                ("body", first, "inertia"),
                "is 0 or missing, and nothing else gives the base that floats the inertia to turn",
                "Write `inertia = 0.01`.",
                document.body[first].inertia,
            )
        else:
            yield Finding(
                ("base", "kind"),
                "lets the base float, and nothing on it has the inertia to turn",
                'Add [[body]] with `name = "hub"`, `on = "base"`, `mass = 1.0`, `inertia = 0.01`.',
                "free",
            )
