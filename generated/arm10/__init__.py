# arm10: Ten-link arm swung by a hub motor
#
# Written by tmm-gen 0.1.0. Do not edit: change the scene and run `tmm-gen build`.
# scene digest: 525c1f48f30bec4efe0533edca417c45a4e26085c7c23db491d2c2e6aa2d5335
# sha256 of the rest of this file: 3ede3deb8ea6c666f7fdafd35b28c073c0139116ff5154b50c64e2fabc3acda0
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
