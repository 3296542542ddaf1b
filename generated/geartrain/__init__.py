# geartrain: Servo with coupling and two stages of gears on a table
#
# Written by tmm-gen 0.1.0. Do not edit: change the scene and run `tmm-gen build`.
# scene digest: 81f336894b4b7c41b0bfadf3b20b8112ee43edbda0e674b03b570e80ad5d65c3
# sha256 of the rest of this file: bee64a443c6a7d4231b0554c356eed38d71bb2899b8cb18d93356bc5d480b3d9
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
