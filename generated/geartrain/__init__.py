# geartrain: Servo with coupling and two stages of gears on a table
#
# Written by tmm-gen 0.1.0. Do not edit: change the scene and run `tmm-gen build`.
# scene digest: 10b4b8f399a3649c436276ea79ba3f340140fef049f792349601aea3a4882696
# sha256 of the rest of this file: 5e332698ef8969fd1bf8b5318877081f4cb745b30c0f1ae3132636a4f965fab8
"""geartrain: Servo with coupling and two stages of gears on a table."""

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
