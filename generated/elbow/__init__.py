# elbow: Flexible arm with motors at shoulder and elbow
#
# Written by tmm-gen 0.1.0. Do not edit: change the scene and run `tmm-gen build`.
# scene digest: a37910a69b52f238259a20213fd8db76ea0063d6b7948a86cd4625c4f988d405
# sha256 of the rest of this file: b34cf54593df2be91f129822bbacc979f9cc488e4504550ca8c3f3f7e9ff2dc3
"""elbow: Flexible arm with motors at shoulder and elbow."""

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
