# elbow: Flexible arm with motors at shoulder and elbow
#
# Written by tmm-gen 0.1.0. Do not edit: change the scene and run `tmm-gen build`.
# scene digest: 06f298327cf2c2c8fa821c06747d2f49d9011eb9eaa180b506b84fce6306d06e
# sha256 of the rest of this file: a3ca510df1ba6942673cdab48b9dbf2b72306c77e12532320db789c2924c2df5
"""elbow: Flexible arm with motors at shoulder and elbow."""

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
