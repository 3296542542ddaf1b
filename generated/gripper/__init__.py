# gripper: Gripper with two fingers on a flexible wrist
#
# Written by tmm-gen 0.1.0. Do not edit: change the scene and run `tmm-gen build`.
# scene digest: 8bddb6557c10b75c631be7e126f0d8c58d4f977d0dedba2f6c8b1b3d350bb90a
# sha256 of the rest of this file: ad487ad0e3c6976c143f8f83d7046d9c974dfc7da8977d123ecf0c2e778f9015
"""gripper: Gripper with two fingers on a flexible wrist."""

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
