# beam5: Five-link arm on a hub, the model of an observer
#
# Written by tmm-gen 0.2.0. Do not edit: change the scene and run `tmm-gen build`.
# scene digest: 7cda6afdfe9f28eb257c67670c83631d86f159a73ec0c14225ebe1e38843e797
# sha256 of the rest of this file: 81e5bf91ca150552fe9cba30abdf643d232732e93048d9b9140fb2d893f75fef
"""beam5: Five-link arm on a hub, the model of an observer."""

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
