/**
 * thesis2: Two-station torsional chain, Gholampour (2018), table 3-2
 *
 * Written by tmm-gen 0.2.0. Do not edit: change the scene and run `tmm-gen build`.
 * scene digest: 8302c2fdab02afb73919e09c91c3abafc3d83d0760e2c0e63be40bfdc341e62e
 * sha256 of the rest of this file: 06b9cb7d0b8d2d7030dc1777acca870233187fe1f855756bbbf62a159a97c514
 *
 * model: torsional chain (linear)
 * stations: 2
 * base: clamp
 * integrator: Newmark 1959, beta = 0.25, gamma = 0.5
 * sweep: riccati
 * unknown: acceleration
 * operations of a step: 44, 22 per station (22 additions, 22 multiplications)
 * operations of prepare: 21, 10.5 per station (5 additions, 14 multiplications, 2 divisions)
 * number type: double
 * bytes of the structs: params 24, model 88, state 48, inputs 8, outputs 16
 *
 * @file thesis2.c
 */
#if defined(__FAST_MATH__) || defined(__ASSOCIATIVE_MATH__) || defined(_M_FP_FAST) \
    || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "-Ofast and -ffast-math remove checks of this file: use -O3, or put -fno-fast-math behind them"
#endif

#include <float.h>
#include <math.h>
#include <stddef.h>

/* Members of the header below: no macro of a header above may have their names. */
#undef tip_torque
#undef tip
#undef base_torque

#include "thesis2.h"

typedef thesis2_real real;

static int inputs_are_finite(const thesis2_inputs *inputs)
{
    if (!isfinite(inputs->tip_torque)) {
        return 0;
    }
    return 1;
}

void thesis2_default_params(thesis2_params *params)
{
    if (params == NULL) {
        return;
    }
    params->stiffness = 20.0;
    params->damping = 5.0;
    params->inertia = 5.0;
}

thesis2_status thesis2_prepare(
    thesis2_model *model,
    const thesis2_params *params,
    thesis2_real step)
{
    if (model == NULL || params == NULL) {
        return THESIS2_NULL_POINTER;
    }
    if (!(step > 0.0) || !(step <= DBL_MAX)) {
        return THESIS2_INVALID_STEP;
    }
    /* Infinities and NaN less themselves are NaN, all other numbers 0. */
    const real lost = (params->stiffness - params->stiffness) + (params->damping - params->damping)
        + (params->inertia - params->inertia);
    if (!(lost >= 0.0)) {
        return THESIS2_NON_FINITE_INPUT;
    }

    const real inertia = params->inertia;

    /* Factors of the sweep that do not change from step to step. */
    real impedance = 0.0;
    const real joint_impedance = 0.5 * params->damping * step + 0.25 * (step * step) * params->stiffness;
    for (int j = THESIS2_STATIONS - 1; j >= 0; --j) {
        impedance = impedance - inertia;
        const real pivot = joint_impedance - impedance;
        if (!(pivot > 0.0) || !(pivot <= DBL_MAX)) {
            return THESIS2_VANISHING_PIVOT;
        }
        model->admittance[j] = 1.0 / pivot;
        model->transmission[j] = model->admittance[j] * joint_impedance;
        model->reflection[j] = -model->admittance[j] * impedance;
        impedance = impedance * model->transmission[j];
    }

    /* Factors of the step that depend on the time step and parameters alone. */
    model->rate_per_acceleration = 0.5 * step;
    model->angle_per_acceleration = 0.25 * (step * step);

    /* What the step needs as it is. */
    model->step = step;
    model->stiffness = params->stiffness;
    model->damping = params->damping;

    real total = 0.0; /* of the model: is all of it finite? */
    for (int j = 0; j < THESIS2_STATIONS; ++j) {
        total += model->admittance[j] + model->transmission[j] + model->reflection[j];
    }
    if (!isfinite(model->rate_per_acceleration + model->angle_per_acceleration + total)) {
        return THESIS2_NON_FINITE_MODEL;
    }
    return THESIS2_OK;
}

thesis2_status thesis2_initialise(
    thesis2_state *state,
    const thesis2_params *params,
    const thesis2_real initial_angle[THESIS2_STATIONS],
    const thesis2_real initial_rate[THESIS2_STATIONS],
    const thesis2_inputs *inputs)
{
    if (state == NULL || params == NULL || inputs == NULL) {
        return THESIS2_NULL_POINTER;
    }
    if (!inputs_are_finite(inputs)) {
        return THESIS2_NON_FINITE_INPUT;
    }
    for (int j = 0; j < THESIS2_STATIONS; ++j) {
        if ((initial_angle != NULL && !isfinite(initial_angle[j]))
            || (initial_rate != NULL && !isfinite(initial_rate[j]))) {
            return THESIS2_NON_FINITE_INPUT;
        }
    }

    const real stiffness = params->stiffness;
    const real damping = params->damping;
    real known_angle[THESIS2_STATIONS + 1]; /* angle of base and links without the unknown's share [rad] */
    real known_rate[THESIS2_STATIONS + 1]; /* rate of base and links without the unknown's share [rad/s] */
    real total = 0.0; /* of the new motion: is all of it finite? */

    /* What is the same at every station. */
    const real impedance = -params->inertia;
    const real pivot = -impedance;
    const real start_admittance = 1.0 / pivot;

    /* Motion known before the sweep. */
    known_rate[0] = 0.0;
    known_angle[0] = 0.0;
    for (int j = 0; j < THESIS2_STATIONS; ++j) {
        known_rate[j + 1] = (initial_rate != NULL ? initial_rate[j] : 0.0);
        known_angle[j + 1] = (initial_angle != NULL ? initial_angle[j] : 0.0);
    }

    /* Sweep inward: force beyond each joint as an affine function of the motion at it. */
    real torque = inputs->tip_torque;

    /* Forces of the joints at the motion so far; sweep inward: force beyond each joint as an affine function
     * of the motion at it; sweep outward: the unknown of each station; motion at the end of the step. */
    for (int j = THESIS2_STATIONS - 1; j >= 0; --j) {
        const real joint_torque = damping * (known_rate[j + 1] - known_rate[j])
            + stiffness * (known_angle[j + 1] - known_angle[j]);
        const real answer_own = start_admittance * (torque - joint_torque);
        torque = joint_torque;
        state->angle[j] = known_angle[j + 1];
        state->rate[j] = known_rate[j + 1];
        state->acceleration[j] = answer_own;
        total += state->angle[j] + state->rate[j] + state->acceleration[j];
    }

    if (!isfinite(total)) {
        return THESIS2_NON_FINITE_STATE;
    }
    return THESIS2_OK;
}

thesis2_status thesis2_step(
    const thesis2_model *model,
    thesis2_state *state,
    const thesis2_inputs *inputs)
{
    if (model == NULL || state == NULL || inputs == NULL) {
        return THESIS2_NULL_POINTER;
    }
    if (!inputs_are_finite(inputs)) {
        return THESIS2_NON_FINITE_INPUT;
    }

    const real step = model->step;
    const real stiffness = model->stiffness;
    const real damping = model->damping;
    const real rate_per_acceleration = model->rate_per_acceleration;
    const real angle_per_acceleration = model->angle_per_acceleration;
    real answer_own[THESIS2_STATIONS]; /* unknown of a station if its inner side kept its motion */
    real known_angle[THESIS2_STATIONS + 1]; /* angle of base and links without the unknown's share [rad] */
    real known_rate[THESIS2_STATIONS + 1]; /* rate of base and links without the unknown's share [rad/s] */
    real total = 0.0; /* of the new motion: is all of it finite? */

    /* Motion known before the sweep. */
    known_rate[0] = 0.0;
    known_angle[0] = 0.0;
    for (int j = 0; j < THESIS2_STATIONS; ++j) {
        known_rate[j + 1] = state->rate[j] + state->acceleration[j] * rate_per_acceleration;
        known_angle[j + 1] = state->angle[j] + state->acceleration[j] * angle_per_acceleration
            + state->rate[j] * step;
    }

    /* Forces of the joints at the motion so far; sweep inward: force beyond each joint as an affine function
     * of the motion at it. */
    real torque = inputs->tip_torque;
    for (int j = THESIS2_STATIONS - 1; j >= 0; --j) {
        const real joint_torque = damping * (known_rate[j + 1] - known_rate[j])
            + stiffness * (known_angle[j + 1] - known_angle[j]);
        answer_own[j] = model->admittance[j] * (torque - joint_torque);
        torque = joint_torque * model->reflection[j] + torque * model->transmission[j];
    }

    /* The base. */
    real unknown = 0.0;

    /* Sweep outward: the unknown of each station; motion at the end of the step. */
    for (int j = 0; j < THESIS2_STATIONS; ++j) {
        unknown = answer_own[j] + model->transmission[j] * unknown;
        state->angle[j] = known_angle[j + 1] + angle_per_acceleration * unknown;
        state->rate[j] = known_rate[j + 1] + rate_per_acceleration * unknown;
        state->acceleration[j] = unknown;
        total += state->angle[j] + state->rate[j];
    }

    if (!isfinite(total + state->acceleration[THESIS2_STATIONS - 1])) {
        return THESIS2_NON_FINITE_STATE;
    }
    return THESIS2_OK;
}

void thesis2_output(
    const thesis2_model *model,
    const thesis2_state *state,
    thesis2_outputs *outputs)
{
    if (model == NULL || state == NULL || outputs == NULL) {
        return;
    }
    /* Outputs. */
    outputs->tip = state->angle[1];
    outputs->base_torque = state->angle[0] * model->stiffness + model->damping * state->rate[0];
}
