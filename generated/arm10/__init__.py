# arm10: Ten-link arm swung by a hub motor
#
# Written by tmm-gen 0.2.0. Do not edit: change the scene and run `tmm-gen build`.
# scene digest: d9d28dc691ae4f0a1d62cb9cfa9f4612d111fa76a756dd286c77eac7f930ab35
# sha256 of the rest of this file: 20f96fa9c2f95d426094e6d87996f2c095ac10bb6bcb8cd21baf3d39a5f0bd7e
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
