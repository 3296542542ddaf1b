# drivetrain: Servo drive with gearbox, roller, brake and encoder
#
# Written by tmm-gen 0.2.0. Do not edit: change the scene and run `tmm-gen build`.
# scene digest: 260c88ca5ffe6b93ea5946fad67187e547942573db1dc2f710bcd9a0610b8738
# sha256 of the rest of this file: 2144cf53660a4e70ed93900df986b14cd350ea9ec29048f94b77bca7d783b4cf
"""drivetrain: Servo drive with gearbox, roller, brake and encoder."""

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
