# geartrain: Servo with coupling and two stages of gears on a table
#
# Written by tmm-gen 0.1.0. Do not edit: change the scene and run `tmm-gen build`.
# scene digest: 1a4a8b5623facd447e81b78b9ab542ac7459a89297606c12999073246348dce9
# sha256 of the rest of this file: 6521ffc45e425d163a0818ca8d4eb35fb7d241e6a0acb96d22c560d5b646e2eb
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
