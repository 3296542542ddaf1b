# hundred: Uniform shaft of a hundred stations
#
# Written by tmm-gen 0.1.0. Do not edit: change the scene and run `tmm-gen build`.
# scene digest: 1ec2a071f5720229c3b5c9d847fa0a44d6fa112015051ca13c1d73444e6eb10a
# sha256 of the rest of this file: f2a40e5f38ad618954e08c5c4f66502aca92ee6233c69fc8b8b35bfc2cc344d3
"""hundred: Uniform shaft of a hundred stations."""

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
