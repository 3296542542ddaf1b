# elbow: Flexible arm with motors at shoulder and elbow
#
# Written by tmm-gen 0.1.0. Do not edit: change the scene and run `tmm-gen build`.
# scene digest: b7474d2f501b0139799e3f1e1a14aa2a3a455ea0221cabb6918551519b3600d0
# sha256 of the rest of this file: 031e8d84cd43d8b716229c79cb20244b3424111812862bfb12f2275f2f750509
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
