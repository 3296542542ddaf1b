# arm10: Ten-link arm swung by a hub motor
#
# Written by tmm-gen 0.1.0. Do not edit: change the scene and run `tmm-gen build`.
# scene digest: d9d28dc691ae4f0a1d62cb9cfa9f4612d111fa76a756dd286c77eac7f930ab35
# sha256 of the rest of this file: 5b576b591798cc0fbc612207c6809892b37b30ccc3a93b85821829b8a0acdb3e
"""arm10: Ten-link arm swung by a hub motor."""

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
