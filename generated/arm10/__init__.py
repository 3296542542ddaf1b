# arm10: Ten-link arm swung by a hub motor
#
# Written by tmm-gen 0.1.0. Do not edit: change the scene and run `tmm-gen build`.
# scene digest: 95c81c6eb7e0b6f1ffc37b1b0540e1023a1118b007e8b573b96cceed3f286490
# sha256 of the rest of this file: 7464b29a0ee83e4c36f18dd49010a0ff31101338a8c2e493f18e01f5be301dc2
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
