"""Rules across the tables of a scene: each looks at a well-formed document and yields what does not fit."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TypeVar

from tmm_gen.scene.document import Document
from tmm_gen.scene.parts.document import ChainDocument, PartsDocument
from tmm_gen.scene.problem import Finding
from tmm_gen.scene.rules.beams import beams_given
from tmm_gen.scene.rules.control import control_possible
from tmm_gen.scene.rules.control_motors import motors_controlled
from tmm_gen.scene.rules.control_payload import payload_by_parts
from tmm_gen.scene.rules.control_trajectory import moves_by_parts
from tmm_gen.scene.rules.drivetrain_signals import chain_inputs, chain_outputs
from tmm_gen.scene.rules.drivetrains import (
    chain_in_range,
    chain_suits,
    free_base,
    shafts,
)
from tmm_gen.scene.rules.emission import (
    batch_suits,
    bound_without_sensitivities,
    box_names,
    budget_not_empty,
    compensated_suits,
    corrections_without_sensitivities,
    favour_suits,
    real_is_used,
)
from tmm_gen.scene.rules.floating import floating_base
from tmm_gen.scene.rules.inputs import inputs_possible, prescribed_motion
from tmm_gen.scene.rules.integration import (
    coupled_suits,
    explicit_needs_acceleration,
    integrator_parameters,
    steps_may_change,
)
from tmm_gen.scene.rules.kinds import base_hub, held, kind_keys, newton_keys
from tmm_gen.scene.rules.names import distinct_names
from tmm_gen.scene.rules.outputs import outputs_possible
from tmm_gen.scene.rules.part_initial import chain_initial, part_initial
from tmm_gen.scene.rules.part_signals import part_inputs, part_outputs
from tmm_gen.scene.rules.parts import (
    beams_in_range,
    carriers,
    one_tree,
    part_names,
    parts_suit,
)
from tmm_gen.scene.rules.stations import initial_lengths, stations_consistent

Rule = Callable[[Document], Iterator[Finding]]

RULES: tuple[Rule, ...] = (
    kind_keys,
    newton_keys,
    held,
    base_hub,
    stations_consistent,
    initial_lengths,
    integrator_parameters,
    explicit_needs_acceleration,
    coupled_suits,
    steps_may_change,
    distinct_names,
    inputs_possible,
    prescribed_motion,
    outputs_possible,
    real_is_used,
    bound_without_sensitivities,
    corrections_without_sensitivities,
    budget_not_empty,
    compensated_suits,
    batch_suits,
    favour_suits,
    box_names,
    control_possible,
    moves_by_parts,
    payload_by_parts,
)


def broken_rules(document: Document) -> list[Finding]:
    """Return everything in a document that breaks a rule, in the order of the rules."""
    return [*beams_given(document)] or [finding for rule in RULES for finding in rule(document)]


PartRule = Callable[[PartsDocument], Iterator[Finding]]
ChainRule = Callable[[ChainDocument], Iterator[Finding]]

_ALL: tuple[Rule, ...] = (
    integrator_parameters,
    explicit_needs_acceleration,
    coupled_suits,
    steps_may_change,
    distinct_names,
    prescribed_motion,
    real_is_used,
    bound_without_sensitivities,
    corrections_without_sensitivities,
    budget_not_empty,
    compensated_suits,
    batch_suits,
    favour_suits,
    box_names,
)
"""Rules of all arms by parts."""

PART_RULES: tuple[tuple[PartRule, ...], ...] = (
    (part_names, parts_suit, beams_given),
    (one_tree,),
    (carriers,),
    (newton_keys, floating_base, base_hub, beams_in_range, part_initial, part_inputs, part_outputs, *_ALL),
    (motors_controlled,),
)
"""Rules of arms by parts; each group takes those before it for granted."""

CHAIN_RULES: tuple[tuple[ChainRule, ...], ...] = (
    (part_names, chain_suits),
    (one_tree,),
    (shafts,),
    (free_base, base_hub),
    (chain_in_range, chain_initial, chain_inputs, chain_outputs, *_ALL),
)
"""The same of chains by parts."""


def broken_part_rules(document: PartsDocument) -> list[Finding]:
    """Return everything in an arm by parts that breaks a rule; how parts hang together comes first."""
    if isinstance(document, ChainDocument):
        return _first_broken(document, CHAIN_RULES)
    return _first_broken(document, PART_RULES)


_Doc = TypeVar("_Doc", bound=PartsDocument)


def _first_broken(
    document: _Doc, groups: tuple[tuple[Callable[[_Doc], Iterator[Finding]], ...], ...]
) -> list[Finding]:
    for group in groups:
        if broken := [finding for rule in group for finding in rule(document)]:
            return broken
    return []
