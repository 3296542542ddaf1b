# hundred: Uniform shaft of a hundred stations
#
# Written by tmm-gen 0.2.0. Do not edit: change the scene and run `tmm-gen build`.
# scene digest: 1ec2a071f5720229c3b5c9d847fa0a44d6fa112015051ca13c1d73444e6eb10a
# sha256 of the rest of this file: b3e4acf0fa9a88ef8fb4d639cff971b09ddd42d51622129ae03f9a1233402286
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
