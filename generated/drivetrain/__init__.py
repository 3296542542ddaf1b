# drivetrain: Servo drive with gearbox, roller, brake and encoder
#
# Written by tmm-gen 0.1.0. Do not edit: change the scene and run `tmm-gen build`.
# scene digest: 260c88ca5ffe6b93ea5946fad67187e547942573db1dc2f710bcd9a0610b8738
# sha256 of the rest of this file: f4f7e293dd3e8053eee8f6a36307ce1596d664ed920e42deb61dd8725af6877a
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
