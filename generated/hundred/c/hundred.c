/**
 * hundred: Uniform shaft of a hundred stations
 *
 * Written by tmm-gen 0.2.0. Do not edit: change the scene and run `tmm-gen build`.
 * scene digest: 1ec2a071f5720229c3b5c9d847fa0a44d6fa112015051ca13c1d73444e6eb10a
 * sha256 of the rest of this file: 73796b22c670e53a8f40f0ecd91490e639220d87f9eddbbc486d90595fb665ba
 *
 * model: torsional chain (linear)
 * stations: 100
 * base: clamp
 * integrator: Newmark 1959, beta = 0.25, gamma = 0.5
 * sweep: riccati
 * unknown: acceleration
 * operations of a step: 2200, 22 per station (1100 additions, 1100 multiplications)
 * operations of prepare: 609, 6.09 per station (201 additions, 308 multiplications, 100 divisions)
 * number type: double
 * bytes of the structs: params 24, model 2440, state 2400, inputs 8, outputs 24
 *
 * @file hundred.c
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
#undef middle
#undef base_torque

#include "hundred.h"

typedef hundred_real real;

static int inputs_are_finite(const hundred_inputs *inputs)
{
    if (!isfinite(inputs->tip_torque)) {
        return 0;
    }
    return 1;
}

void hundred_default_params(hundred_params *params)
{
    if (params == NULL) {
        return;
    }
    params->stiffness = 400.0;
    params->damping = 0.02;
    params->inertia = 0.01;
}

hundred_status hundred_prepare(
    hundred_model *model,
    const hundred_params *params,
    hundred_real step)
{
    if (model == NULL || params == NULL) {
        return HUNDRED_NULL_POINTER;
    }
    if (!(step > 0.0) || !(step <= DBL_MAX)) {
        return HUNDRED_INVALID_STEP;
    }
    /* Infinities and NaN less themselves are NaN, all other numbers 0. */
    const real lost = (params->stiffness - params->stiffness) + (params->damping - params->damping)
        + (params->inertia - params->inertia);
    if (!(lost >= 0.0)) {
        return HUNDRED_NON_FINITE_INPUT;
    }

    const real inertia = params->inertia;

    /* Factors of the sweep that do not change from step to step. */
    real impedance = 0.0;
    const real joint_impedance = 0.5 * params->damping * step + 0.25 * (step * step) * params->stiffness;
    for (int j = HUNDRED_STATIONS - 1; j >= 0; --j) {
        impedance = impedance - inertia;
        const real pivot = joint_impedance - impedance;
        if (!(pivot > 0.0) || !(pivot <= DBL_MAX)) {
            return HUNDRED_VANISHING_PIVOT;
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
    for (int j = 0; j < HUNDRED_STATIONS; ++j) {
        total += model->admittance[j] + model->transmission[j] + model->reflection[j];
    }
    if (!isfinite(model->rate_per_acceleration + model->angle_per_acceleration + total)) {
        return HUNDRED_NON_FINITE_MODEL;
    }
    return HUNDRED_OK;
}

hundred_status hundred_initialise(
    hundred_state *state,
    const hundred_params *params,
    const hundred_real initial_angle[HUNDRED_STATIONS],
    const hundred_real initial_rate[HUNDRED_STATIONS],
    const hundred_inputs *inputs)
{
    if (state == NULL || params == NULL || inputs == NULL) {
        return HUNDRED_NULL_POINTER;
    }
    if (!inputs_are_finite(inputs)) {
        return HUNDRED_NON_FINITE_INPUT;
    }
    for (int j = 0; j < HUNDRED_STATIONS; ++j) {
        if ((initial_angle != NULL && !isfinite(initial_angle[j]))
            || (initial_rate != NULL && !isfinite(initial_rate[j]))) {
            return HUNDRED_NON_FINITE_INPUT;
        }
    }

    const real stiffness = params->stiffness;
    const real damping = params->damping;
    real known_angle[HUNDRED_STATIONS + 1]; /* angle of base and links without the unknown's share [rad] */
    real known_rate[HUNDRED_STATIONS + 1]; /* rate of base and links without the unknown's share [rad/s] */
    real total = 0.0; /* of the new motion: is all of it finite? */

    /* What is the same at every station. */
    const real impedance = -params->inertia;
    const real pivot = -impedance;
    const real start_admittance = 1.0 / pivot;

    /* Motion known before the sweep. */
    known_rate[0] = 0.0;
    known_angle[0] = 0.0;
    for (int j = 0; j < HUNDRED_STATIONS; ++j) {
        known_rate[j + 1] = (initial_rate != NULL ? initial_rate[j] : 0.0);
        known_angle[j + 1] = (initial_angle != NULL ? initial_angle[j] : 0.0);
    }

    /* Sweep inward: force beyond each joint as an affine function of the motion at it. */
    real torque = inputs->tip_torque;

    /* Forces of the joints at the motion so far; sweep inward: force beyond each joint as an affine function
     * of the motion at it; sweep outward: the unknown of each station; motion at the end of the step. */
    for (int j = HUNDRED_STATIONS - 1; j >= 0; --j) {
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
        return HUNDRED_NON_FINITE_STATE;
    }
    return HUNDRED_OK;
}

hundred_status hundred_step(
    const hundred_model *model,
    hundred_state *state,
    const hundred_inputs *inputs)
{
    if (model == NULL || state == NULL || inputs == NULL) {
        return HUNDRED_NULL_POINTER;
    }
    if (!inputs_are_finite(inputs)) {
        return HUNDRED_NON_FINITE_INPUT;
    }

    const real step = model->step;
    const real stiffness = model->stiffness;
    const real damping = model->damping;
    const real rate_per_acceleration = model->rate_per_acceleration;
    const real angle_per_acceleration = model->angle_per_acceleration;
    real answer_own[HUNDRED_STATIONS]; /* unknown of a station if its inner side kept its motion */
    real known_angle[HUNDRED_STATIONS + 1]; /* angle of base and links without the unknown's share [rad] */
    real known_rate[HUNDRED_STATIONS + 1]; /* rate of base and links without the unknown's share [rad/s] */
    real total = 0.0; /* of the new motion: is all of it finite? */

    /* Motion known before the sweep: at the last station. */
    known_rate[0] = 0.0;
    known_angle[0] = 0.0;
    known_rate[100] = state->rate[99] + state->acceleration[99] * rate_per_acceleration;
    known_angle[100] = state->angle[99] + state->acceleration[99] * angle_per_acceleration
        + state->rate[99] * step;

    /* Motion known before the sweep; forces of the joints at the motion so far; sweep inward: force beyond
     * each joint as an affine function of the motion at it. */
    real torque = inputs->tip_torque;
    for (int j = HUNDRED_STATIONS - 1; j >= 1; --j) {
        known_rate[j] = state->rate[j - 1] + state->acceleration[j - 1] * rate_per_acceleration;
        known_angle[j] = state->angle[j - 1] + state->acceleration[j - 1] * angle_per_acceleration
            + state->rate[j - 1] * step;
        const real joint_torque = damping * (known_rate[j + 1] - known_rate[j])
            + stiffness * (known_angle[j + 1] - known_angle[j]);
        answer_own[j] = model->admittance[j] * (torque - joint_torque);
        torque = joint_torque * model->reflection[j] + torque * model->transmission[j];
    }
    const real first_joint_torque = damping * (known_rate[1] - known_rate[0])
        + stiffness * (known_angle[1] - known_angle[0]);
    answer_own[0] = model->admittance[0] * (torque - first_joint_torque);
    torque = first_joint_torque * model->reflection[0] + torque * model->transmission[0];

    /* The base. */
    real unknown = 0.0;

    /* Sweep outward: the unknown of each station; motion at the end of the step. */
    for (int j = 0; j < HUNDRED_STATIONS; ++j) {
        unknown = answer_own[j] + model->transmission[j] * unknown;
        state->angle[j] = known_angle[j + 1] + angle_per_acceleration * unknown;
        state->rate[j] = known_rate[j + 1] + rate_per_acceleration * unknown;
        state->acceleration[j] = unknown;
        total += state->angle[j] + state->rate[j];
    }

    if (!isfinite(total + state->acceleration[HUNDRED_STATIONS - 1])) {
        return HUNDRED_NON_FINITE_STATE;
    }
    return HUNDRED_OK;
}

void hundred_output(
    const hundred_model *model,
    const hundred_state *state,
    hundred_outputs *outputs)
{
    if (model == NULL || state == NULL || outputs == NULL) {
        return;
    }
    /* Outputs. */
    outputs->tip = state->angle[99];
    outputs->middle = state->angle[49];
    outputs->base_torque = state->angle[0] * model->stiffness + model->damping * state->rate[0];
}
