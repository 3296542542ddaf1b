"""The continuous beam in the frequency domain, exact: dynamic stiffness, counting of modes, roots, shapes."""

from __future__ import annotations

from tmm_gen.modal.beam.arm import BeamArm, BeamBase, Body, beam_arm
from tmm_gen.modal.beam.counting import modes_below
from tmm_gen.modal.beam.member import Member
from tmm_gen.modal.beam.poles import damped_pole
from tmm_gen.modal.beam.roots import frequencies_below, natural_frequencies
from tmm_gen.modal.beam.shapes import beam_shape
from tmm_gen.modal.beam.stiffness import clamped_count, dynamic_stiffness

__all__ = [
    "BeamArm",
    "BeamBase",
    "Body",
    "Member",
    "beam_arm",
    "beam_shape",
    "clamped_count",
    "damped_pole",
    "dynamic_stiffness",
    "frequencies_below",
    "modes_below",
    "natural_frequencies",
]
