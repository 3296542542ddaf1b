# fall10: Soft clamped beam falling under its own weight
#
# Written by tmm-gen 0.1.0. Do not edit: change the scene and run `tmm-gen build`.
# scene digest: 7fb53ee7611dfaa9a6a8f9157801d68007a3a764d7f41a8fa8cf16397006e130
# sha256 of the rest of this file: ee0e0753e1ad8cb8d1d399d973cbfdc670aece54cd5274b5aeeb5be8499f47d6
"""fall10: Soft clamped beam falling under its own weight."""

from .kernel import (
    INPUT_NAMES,
    OUTPUT_NAMES,
    STAGE_INSTANTS,
    STATIONS,
    STEP,
    Input,
    Model,
    Output,
    Params,
    Result,
    State,
    VanishingPivotError,
    initialise,
    output,
    prepare,
    simulate,
    step,
)

__all__ = [
    "INPUT_NAMES",
    "OUTPUT_NAMES",
    "STAGE_INSTANTS",
    "STATIONS",
    "STEP",
    "Input",
    "Model",
    "Output",
    "Params",
    "Result",
    "State",
    "VanishingPivotError",
    "initialise",
    "output",
    "prepare",
    "simulate",
    "step",
]
