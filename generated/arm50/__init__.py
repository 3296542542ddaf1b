# arm50: Stiff arm of fifty links on a servo
#
# Written by tmm-gen 0.1.0. Do not edit: change the scene and run `tmm-gen build`.
# scene digest: 9874dff5d90e21876dbd2271ff786b55b83dc2e6467819bdcfde7e890f954cb6
# sha256 of the rest of this file: ecc8af9042a76f42b2324abbf087ca2507c3dd75bce830e9d7b3fc09e7094326
"""arm50: Stiff arm of fifty links on a servo."""

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
