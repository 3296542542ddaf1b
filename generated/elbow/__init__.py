# elbow: Flexible arm with motors at shoulder and elbow
#
# Written by tmm-gen 0.1.0. Do not edit: change the scene and run `tmm-gen build`.
# scene digest: 2cf3828155010d9c4885fc2a677583998b6bf00b0d62ade41f995022bcf74f11
# sha256 of the rest of this file: 3bf36e86d981101f32a19d7547aba3f8f4b6863f679a7e9d8f130420dcf1fc8d
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
