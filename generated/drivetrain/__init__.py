# drivetrain: Servo drive with gearbox, roller, brake and encoder
#
# Written by tmm-gen 0.1.0. Do not edit: change the scene and run `tmm-gen build`.
# scene digest: 4ef6e83f7b983f9b3916fd8784109ad0b9257c6846d06f8cdd99f62ef9379a40
# sha256 of the rest of this file: 0ab132f59c392889d336e420135271dff5c4002b434da1d86cbf2f22e485d7c4
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
