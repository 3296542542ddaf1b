"""Rules across the tables of a scene: each looks at a well-formed document and yields what does not fit."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from tmm_gen.scene.document import Document
from tmm_gen.scene.parts.document import PartsDocument
from tmm_gen.scene.problem import Finding
from tmm_gen.scene.rules.beams import beams_given
from tmm_gen.scene.rules.control import control_possible
from tmm_gen.scene.rules.emission import (
    bound_without_sensitivities,
    box_names,
    budget_not_empty,
    compensated_suits,
    real_is_used,
)
from tmm_gen.scene.rules.inputs import inputs_possible, prescribed_motion
from tmm_gen.scene.rules.integration import (
    explicit_needs_acceleration,
    integrator_parameters,
)
from tmm_gen.scene.rules.kinds import base_hub, kind_keys, newton_keys
from tmm_gen.scene.rules.names import distinct_names
from tmm_gen.scene.rules.outputs import outputs_possible
from tmm_gen.scene.rules.parts import (
    beams_in_range,
    carriers,
    one_tree,
    part_initial,
    part_inputs,
    part_names,
    part_outputs,
    parts_suit,
)
from tmm_gen.scene.rules.stations import initial_lengths, stations_consistent

Rule = Callable[[Document], Iterator[Finding]]

RULES: tuple[Rule, ...] = (
    kind_keys,
    newton_keys,
    base_hub,
    stations_consistent,
    initial_lengths,
    integrator_parameters,
    explicit_needs_acceleration,
    distinct_names,
    inputs_possible,
    prescribed_motion,
    outputs_possible,
    real_is_used,
    bound_without_sensitivities,
    budget_not_empty,
    compensated_suits,
    box_names,
    control_possible,
)


def broken_rules(document: Document) -> list[Finding]:
    """Return everything in a document that breaks a rule, in the order of the rules."""
    return [*beams_given(document)] or [finding for rule in RULES for finding in rule(document)]


PartRule = Callable[[PartsDocument], Iterator[Finding]]

HANG_TOGETHER: tuple[tuple[PartRule, ...], ...] = (
    (part_names, parts_suit, beams_given),
    (one_tree,),
    (carriers,),
)
"""Rules of arms by parts; each group takes those before it for granted."""

PART_RULES: tuple[PartRule, ...] = (
    newton_keys,
    base_hub,
    beams_in_range,
    part_initial,
    integrator_parameters,
    explicit_needs_acceleration,
    distinct_names,
    part_inputs,
    prescribed_motion,
    part_outputs,
    real_is_used,
    bound_without_sensitivities,
    budget_not_empty,
    compensated_suits,
    box_names,
)


def broken_part_rules(document: PartsDocument) -> list[Finding]:
    """Return everything in an arm by parts that breaks a rule; how parts hang together comes first."""
    for group in (*HANG_TOGETHER, PART_RULES):
        if broken := [finding for rule in group for finding in rule(document)]:
            return broken
    return []
