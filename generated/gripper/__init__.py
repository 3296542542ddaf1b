# gripper: Gripper with two fingers on a flexible wrist
#
# Written by tmm-gen 0.1.0. Do not edit: change the scene and run `tmm-gen build`.
# scene digest: c8f8226e93fd9d4e49ccbb14a6d21dfabaa9c32be55619277914a499c6eae156
# sha256 of the rest of this file: 80ae9dc69519e5e1c85a7a4f0006f5985fc8d85492eceb6196528d85a76c9310
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
