"""Rules across the tables of an arm in space."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from tmm_gen.scene.problem import Finding
from tmm_gen.scene.rules.beams import beams_given
from tmm_gen.scene.rules.emission import (
    batch_suits,
    bound_without_sensitivities,
    budget_not_empty,
    compensated_suits,
    favour_suits,
    real_is_used,
)
from tmm_gen.scene.rules.integration import (
    coupled_suits,
    explicit_needs_acceleration,
    integrator_parameters,
    steps_may_change,
)
from tmm_gen.scene.rules.spatial.control import motors_in_space_controlled
from tmm_gen.scene.rules.spatial.hanging import not_too_many, one_tree, part_names
from tmm_gen.scene.rules.spatial.inertia import base_to_turn, something_to_turn
from tmm_gen.scene.rules.spatial.parts import elastic_gears, ends, in_range, inertias, twists
from tmm_gen.scene.rules.spatial.settings import boxed, keys_of_base, own_tables
from tmm_gen.scene.rules.spatial.signals import (
    distinct_names,
    initial_by_name,
    inputs_possible,
    outputs_possible,
)
from tmm_gen.scene.spatial.document import SpatialDocument

Rule = Callable[[SpatialDocument], Iterator[Finding]]

RULES: tuple[tuple[Rule, ...], ...] = (
    (keys_of_base, own_tables, part_names, beams_given, not_too_many),
    (one_tree, twists, ends, elastic_gears, inertias),
    (in_range, initial_by_name),
    (
        base_to_turn,
        something_to_turn,
        inputs_possible,
        outputs_possible,
        distinct_names,
        integrator_parameters,
        explicit_needs_acceleration,
        coupled_suits,
        steps_may_change,
        real_is_used,
        bound_without_sensitivities,
        budget_not_empty,
        batch_suits,
        favour_suits,
        boxed,
        compensated_suits,
    ),
    (motors_in_space_controlled,),
)
"""Each group takes those before it for granted."""


def broken_spatial_rules(document: SpatialDocument) -> list[Finding]:
    """Return everything in an arm in space that breaks a rule; how parts hang together comes first."""
    for group in RULES:
        if broken := [finding for rule in group for finding in rule(document)]:
            return broken
    return []
