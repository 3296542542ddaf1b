# geartrain: Servo with two stages of gears on a table and a feeder
#
# Written by tmm-gen 0.1.0. Do not edit: change the scene and run `tmm-gen build`.
# scene digest: 066060c018d378c5aa38f61f583a4ed37c9ee269f8287dfe93f42445474eebe1
# sha256 of the rest of this file: 8a8a33c48810519cc5baea7f075a72033dc34f1b66d5d2998db3d718621d8e6d
"""geartrain: Servo with two stages of gears on a table and a feeder."""

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
