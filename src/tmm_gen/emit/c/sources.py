"""Where functions of C find variables: behind which pointer."""

from __future__ import annotations

from tmm_gen.program.variables import Role

SOURCES: dict[str, dict[Role, str]] = {
    "prepare": {Role.STEP: "", Role.PARAMETER: "params->", Role.COEFFICIENT: "model->"},
    "initialise": {
        Role.STEP: "",
        Role.GIVEN: "",
        Role.PARAMETER: "params->",
        Role.INPUT: "inputs->",
        Role.STATE: "state->",
    },
    "step": {
        **dict.fromkeys((Role.STEP, Role.PARAMETER, Role.COEFFICIENT), "model->"),
        Role.INPUT: "inputs->",
        Role.STATE: "state->",
    },
    "output": {
        **dict.fromkeys((Role.STEP, Role.PARAMETER, Role.COEFFICIENT), "model->"),
        Role.STATE: "state->",
        Role.OUTPUT: "outputs->",
    },
    "linearise": {
        **dict.fromkeys((Role.STEP, Role.PARAMETER, Role.COEFFICIENT), "model->"),
        Role.INPUT: "inputs->",
        Role.STATE: "state->",
        Role.POINT: "point->",
    },
    "tangent": {
        **dict.fromkeys((Role.STEP, Role.PARAMETER, Role.COEFFICIENT), "model->"),
        Role.POINT: "point->",
        Role.INPUT_TANGENT: "causes->",
        Role.TANGENT: "changes->",
    },
}
"""For each kind of function, where variables of a role are found."""
