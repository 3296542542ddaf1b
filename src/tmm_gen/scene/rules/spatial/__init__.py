"""Rules across the tables of an arm in space."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from tmm_gen.scene.problem import Finding
from tmm_gen.scene.spatial.document import SpatialDocument

Rule = Callable[[SpatialDocument], Iterator[Finding]]

RULES: tuple[tuple[Rule, ...], ...] = ()
"""Each group takes those before it for granted."""


def broken_spatial_rules(document: SpatialDocument) -> list[Finding]:
    """Return everything in an arm in space that breaks a rule; how parts hang together comes first."""
    for group in RULES:
        if broken := [finding for rule in group for finding in rule(document)]:
            return broken
    return []
