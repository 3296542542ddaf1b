/**
 * geartrain: Servo with two stages of gears on a table and a feeder
 *
 * Written by tmm-gen 0.2.0. Do not edit: change the scene and run `tmm-gen build`.
 * scene digest: 066060c018d378c5aa38f61f583a4ed37c9ee269f8287dfe93f42445474eebe1
 * sha256 of the rest of this file: 9f067140dcb5ee3f598bd2f42f99ceed43f56e40418c1ad4d57d7517671f0a44
 *
 * model: torsional chain (linear)
 * stations: 4
 * base: motor
 * integrator: Generalised alpha (Chung & Hulbert 1993), rho_inf = 0.8
 * sweep: riccati
 * unknown: acceleration
 * joints in arrays, from 0: coupling 0, belt 1, second 2, shaft 3
 * links in arrays, from 0: pinion 0, layshaft 0, feeder 1, wheel 2, table 3
 * operations of a step: 159, 39.75 per station (75 additions, 84 multiplications)
 * operations of prepare: 75, 18.75 per station (13 additions, 51 multiplications, 11 divisions)
 * number type: double
 * bytes of the structs: params 144, model 288, state 120, inputs 24, outputs 48
 *
 * @file geartrain.c
 */
#if defined(__FAST_MATH__) || defined(__ASSOCIATIVE_MATH__) || defined(_M_FP_FAST) \
    || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "-Ofast and -ffast-math remove checks of this file: use -O3, or put -fno-fast-math behind them"
#endif

#include <float.h>
#include <math.h>
#include <stddef.h>

/* Members of the header below: no macro of a header above may have their names. */
#undef motor_torque
#undef load_torque
#undef feeder_torque
#undef motor_speed
#undef table
#undef table_speed
#undef feeder_speed
#undef coupling_torque
#undef teeth

#include "geartrain.h"

typedef geartrain_real real;

static int inputs_are_finite(const geartrain_inputs *inputs)
{
    /* Infinities and NaN less themselves are NaN, all other numbers 0. */
    const real lost = (inputs->motor_torque - inputs->motor_torque)
        + (inputs->load_torque - inputs->load_torque) + (inputs->feeder_torque - inputs->feeder_torque);
    if (!(lost >= 0.0)) {
        return 0;
    }
    return 1;
}

void geartrain_default_params(geartrain_params *params)
{
    static const real stiffness[] = {
        150.0, 60.0, 60000.0, 2500.0
    };
    static const real damping[] = {
        0.02, 0.01, 4.0, 0.8
    };
    static const real ratio[] = {
        1.0, -4.0, 20.0, 1.0
    };
    static const real inertia[] = {
        0.00027, 0.0008, 0.011, 0.65
    };
    if (params == NULL) {
        return;
    }
    for (int j = 0; j < GEARTRAIN_STATIONS; ++j) {
        params->stiffness[j] = stiffness[j];
    }
    for (int j = 0; j < GEARTRAIN_STATIONS; ++j) {
        params->damping[j] = damping[j];
    }
    for (int j = 0; j < GEARTRAIN_STATIONS; ++j) {
        params->ratio[j] = ratio[j];
    }
    for (int j = 0; j < GEARTRAIN_STATIONS; ++j) {
        params->inertia[j] = inertia[j];
    }
    params->hub_inertia = 0.0006;
    params->hub_damping = 0.001;
}

geartrain_status geartrain_prepare(
    geartrain_model *model,
    const geartrain_params *params,
    geartrain_real step)
{
    if (model == NULL || params == NULL) {
        return GEARTRAIN_NULL_POINTER;
    }
    if (!(step > 0.0) || !(step <= DBL_MAX)) {
        return GEARTRAIN_INVALID_STEP;
    }
    /* Infinities and NaN less themselves are NaN, all other numbers 0. */
    real lost = (params->hub_inertia - params->hub_inertia) + (params->hub_damping - params->hub_damping);
    for (int j = 0; j < GEARTRAIN_STATIONS; ++j) {
        lost += (params->stiffness[j] - params->stiffness[j]) + (params->damping[j] - params->damping[j])
            + (params->ratio[j] - params->ratio[j]) + (params->inertia[j] - params->inertia[j]);
    }
    if (!(lost >= 0.0)) {
        return GEARTRAIN_NON_FINITE_INPUT;
    }

    real impedance;

    /* How gears turn. */
    for (int j = 0; j < GEARTRAIN_STATIONS; ++j) {
        model->turn[j] = 1.0 / params->ratio[j];
    }

    /* Factors of the sweep that do not change from step to step. */
    for (int j = GEARTRAIN_STATIONS - 1; j >= 3; --j) {
        impedance = -params->inertia[j];
        const real joint_impedance = (55.0 / 108.0) * params->damping[j] * step
            + (125.0 / 486.0) * (step * step) * params->stiffness[j];
        const real pivot = joint_impedance - impedance;
        if (!(pivot > 0.0) || !(pivot <= DBL_MAX)) {
            return GEARTRAIN_VANISHING_PIVOT;
        }
        model->admittance[j] = 1.0 / pivot;
        model->transmission[j] = model->admittance[j] * joint_impedance;
        model->reflection[j] = -model->admittance[j] * impedance;
        impedance = impedance * model->transmission[j];
    }
    for (int j = 2; j >= 2; --j) {
        impedance = impedance - params->inertia[j];
        const real joint_impedance = (55.0 / 108.0) * params->damping[j] * step
            + (125.0 / 486.0) * (step * step) * params->stiffness[j];
        const real pivot = joint_impedance - impedance;
        if (!(pivot > 0.0) || !(pivot <= DBL_MAX)) {
            return GEARTRAIN_VANISHING_PIVOT;
        }
        model->admittance[j] = 1.0 / pivot;
        model->transmission[j] = model->admittance[j] * joint_impedance * model->turn[j];
        model->reflection[j] = -model->admittance[j] * impedance * model->turn[j];
        impedance = impedance * model->transmission[j] * model->turn[j];
    }
    const real impedance_of_branch_3 = impedance;
    for (int j = 1; j >= 1; --j) {
        impedance = -params->inertia[j];
        const real joint_impedance = (55.0 / 108.0) * params->damping[j] * step
            + (125.0 / 486.0) * (step * step) * params->stiffness[j];
        const real pivot = joint_impedance - impedance;
        if (!(pivot > 0.0) || !(pivot <= DBL_MAX)) {
            return GEARTRAIN_VANISHING_PIVOT;
        }
        model->admittance[j] = 1.0 / pivot;
        model->transmission[j] = model->admittance[j] * joint_impedance * model->turn[j];
        model->reflection[j] = -model->admittance[j] * impedance * model->turn[j];
        impedance = impedance * model->transmission[j] * model->turn[j];
    }
    impedance = impedance + impedance_of_branch_3;
    for (int j = 0; j >= 0; --j) {
        impedance = impedance - params->inertia[j];
        const real joint_impedance = (55.0 / 108.0) * params->damping[j] * step
            + (125.0 / 486.0) * (step * step) * params->stiffness[j];
        const real pivot = joint_impedance - impedance;
        if (!(pivot > 0.0) || !(pivot <= DBL_MAX)) {
            return GEARTRAIN_VANISHING_PIVOT;
        }
        model->admittance[j] = 1.0 / pivot;
        model->transmission[j] = model->admittance[j] * joint_impedance;
        model->reflection[j] = -model->admittance[j] * impedance;
        impedance = impedance * model->transmission[j];
    }
    const real hub_impedance = params->hub_inertia + (55.0 / 108.0) * params->hub_damping * step;
    const real hub_pivot = hub_impedance - impedance;
    if (!(hub_pivot > 0.0) || !(hub_pivot <= DBL_MAX)) {
        return GEARTRAIN_VANISHING_PIVOT;
    }
    model->hub_admittance = 1.0 / hub_pivot;

    /* Factors of the step that depend on the time step and parameters alone. */
    model->known_rate_per_acceleration = (5.0 / 108.0) * step;
    model->known_angle_per_acceleration = (5.0 / 243.0) * (step * step);
    model->five_ninths_timestep = (5.0 / 9.0) * step;
    model->unknown_per_known_rate = model->hub_admittance * params->hub_damping;
    model->angle_per_acceleration_2 = (1.0 / 27.0) * (step * step);
    model->angle_per_unknown = (25.0 / 54.0) * (step * step);
    model->twelfth_timestep = (1.0 / 12.0) * step;
    model->eleven_twelfths_timestep = (11.0 / 12.0) * step;
    model->teeth_per_angle = params->stiffness[2] / params->ratio[2];
    model->teeth_per_rate = params->damping[2] / params->ratio[2];

    /* What the step needs as it is. */
    model->step = step;
    for (int j = 0; j < GEARTRAIN_STATIONS; ++j) {
        model->stiffness[j] = params->stiffness[j];
    }
    for (int j = 0; j < GEARTRAIN_STATIONS; ++j) {
        model->damping[j] = params->damping[j];
    }

    real total = 0.0; /* of the model: is all of it finite? */
    for (int j = 0; j < GEARTRAIN_STATIONS; ++j) {
        total += model->turn[j] + model->admittance[j] + model->transmission[j] + model->reflection[j];
    }
    if (!isfinite(model->known_rate_per_acceleration + model->known_angle_per_acceleration
        + model->five_ninths_timestep + model->unknown_per_known_rate + model->angle_per_acceleration_2
        + model->angle_per_unknown + model->twelfth_timestep + model->eleven_twelfths_timestep
        + model->teeth_per_angle + model->teeth_per_rate + model->hub_admittance + total)) {
        return GEARTRAIN_NON_FINITE_MODEL;
    }
    return GEARTRAIN_OK;
}

geartrain_status geartrain_initialise(
    geartrain_state *state,
    const geartrain_params *params,
    const geartrain_real initial_angle[GEARTRAIN_STATIONS],
    const geartrain_real initial_rate[GEARTRAIN_STATIONS],
    const geartrain_inputs *inputs)
{
    if (state == NULL || params == NULL || inputs == NULL) {
        return GEARTRAIN_NULL_POINTER;
    }
    if (!inputs_are_finite(inputs)) {
        return GEARTRAIN_NON_FINITE_INPUT;
    }
    for (int j = 0; j < GEARTRAIN_STATIONS; ++j) {
        if ((initial_angle != NULL && !isfinite(initial_angle[j]))
            || (initial_rate != NULL && !isfinite(initial_rate[j]))) {
            return GEARTRAIN_NON_FINITE_INPUT;
        }
    }

    real answer_own[GEARTRAIN_STATIONS]; /* unknown of a station if its inner side kept its motion */
    real known_angle[GEARTRAIN_STATIONS + 1]; /* angle of base and links without the unknown's share [rad] */
    real known_rate[GEARTRAIN_STATIONS + 1]; /* rate of base and links without the unknown's share [rad/s] */
    real load_torque[GEARTRAIN_STATIONS]; /* external torque on each link [N m] */
    real solved[GEARTRAIN_STATIONS]; /* unknown of each station */
    real start_turn[GEARTRAIN_STATIONS]; /* turns of a joint's outer side per turn of its inner one */
    real total = 0.0; /* of the new motion: is all of it finite? */

    /* How gears turn; motion known before the sweep; sweep inward: force beyond each joint as an affine
     * function of the motion at it. */
    known_rate[0] = 0.0;
    known_angle[0] = 0.0;
    for (int j = 0; j < GEARTRAIN_STATIONS; ++j) {
        start_turn[j] = 1.0 / params->ratio[j];
        known_rate[j + 1] = (initial_rate != NULL ? initial_rate[j] : 0.0);
        known_angle[j + 1] = (initial_angle != NULL ? initial_angle[j] : 0.0);
        load_torque[j] = 0.0;
    }
    load_torque[1] = inputs->feeder_torque;
    real torque = inputs->load_torque;

    /* Forces of the joints at the motion so far; sweep inward: force beyond each joint as an affine function
     * of the motion at it. */
    for (int j = GEARTRAIN_STATIONS - 1; j >= 3; --j) {
        const real joint_torque = params->damping[j] * (known_rate[j + 1] - known_rate[j])
            + params->stiffness[j] * (known_angle[j + 1] - known_angle[j]);
        torque = load_torque[j] + torque;
        const real impedance = -params->inertia[j];
        const real pivot = -impedance;
        if (!(pivot > 0.0) || !(pivot <= DBL_MAX)) {
            return GEARTRAIN_VANISHING_PIVOT;
        }
        const real start_admittance = 1.0 / pivot;
        answer_own[j] = start_admittance * (torque - joint_torque);
        torque = joint_torque;
    }
    for (int j = 2; j >= 2; --j) {
        const real joint_torque = params->damping[j] * known_rate[j + 1]
            + known_angle[j + 1] * params->stiffness[j] - params->damping[j] * known_rate[1] * start_turn[j]
            - known_angle[1] * start_turn[j] * params->stiffness[j];
        torque = load_torque[j] + torque;
        const real impedance = -params->inertia[j];
        const real pivot = -impedance;
        if (!(pivot > 0.0) || !(pivot <= DBL_MAX)) {
            return GEARTRAIN_VANISHING_PIVOT;
        }
        const real start_admittance = 1.0 / pivot;
        answer_own[j] = start_admittance * (torque - joint_torque);
        torque = joint_torque * start_turn[j];
    }
    const real torque_of_branch_3 = torque;
    for (int j = 1; j >= 1; --j) {
        const real joint_torque = params->damping[j] * known_rate[j + 1]
            + known_angle[j + 1] * params->stiffness[j] - params->damping[j] * known_rate[j] * start_turn[j]
            - known_angle[j] * start_turn[j] * params->stiffness[j];
        const real impedance = -params->inertia[j];
        const real pivot = -impedance;
        if (!(pivot > 0.0) || !(pivot <= DBL_MAX)) {
            return GEARTRAIN_VANISHING_PIVOT;
        }
        const real start_admittance = 1.0 / pivot;
        answer_own[j] = start_admittance * (load_torque[j] - joint_torque);
        torque = joint_torque * start_turn[j];
    }
    torque = torque + torque_of_branch_3;
    for (int j = 0; j >= 0; --j) {
        const real joint_torque = params->damping[j] * (known_rate[j + 1] - known_rate[j])
            + params->stiffness[j] * (known_angle[j + 1] - known_angle[j]);
        torque = load_torque[j] + torque;
        const real impedance = -params->inertia[j];
        const real pivot = -impedance;
        if (!(pivot > 0.0) || !(pivot <= DBL_MAX)) {
            return GEARTRAIN_VANISHING_PIVOT;
        }
        const real start_admittance = 1.0 / pivot;
        answer_own[j] = start_admittance * (torque - joint_torque);
        torque = joint_torque;
    }

    /* The base. */
    if (!(params->hub_inertia > 0.0) || !(params->hub_inertia <= DBL_MAX)) {
        return GEARTRAIN_VANISHING_PIVOT;
    }
    const real start_hub_admittance = 1.0 / params->hub_inertia;
    const real unknown = start_hub_admittance
        * (inputs->motor_torque + torque - params->hub_damping * known_rate[0]);
    const real hub_unknown = unknown;

    /* Sweep outward: the unknown of each station. */
    for (int j = 0; j < 2; ++j) {
        solved[j] = answer_own[j];
    }
    for (int j = 2; j < GEARTRAIN_STATIONS; ++j) {
        solved[j] = answer_own[j];
    }

    /* Motion at the end of the step. */
    state->hub_angle = known_angle[0];
    state->hub_rate = known_rate[0];
    state->hub_acceleration = hub_unknown;
    for (int j = 0; j < GEARTRAIN_STATIONS; ++j) {
        state->angle[j] = known_angle[j + 1];
        state->rate[j] = known_rate[j + 1];
        state->acceleration[j] = solved[j];
        total += state->angle[j] + state->rate[j] + state->acceleration[j];
    }

    if (!isfinite(total + state->hub_angle + state->hub_rate + state->hub_acceleration)) {
        return GEARTRAIN_NON_FINITE_STATE;
    }
    return GEARTRAIN_OK;
}

geartrain_status geartrain_step(
    const geartrain_model *model,
    geartrain_state *state,
    const geartrain_inputs *inputs)
{
    if (model == NULL || state == NULL || inputs == NULL) {
        return GEARTRAIN_NULL_POINTER;
    }
    if (!inputs_are_finite(inputs)) {
        return GEARTRAIN_NON_FINITE_INPUT;
    }

    const real step = model->step;
    const real known_rate_per_acceleration = model->known_rate_per_acceleration;
    const real known_angle_per_acceleration = model->known_angle_per_acceleration;
    const real five_ninths_timestep = model->five_ninths_timestep;
    const real angle_per_acceleration_2 = model->angle_per_acceleration_2;
    const real angle_per_unknown = model->angle_per_unknown;
    const real twelfth_timestep = model->twelfth_timestep;
    const real eleven_twelfths_timestep = model->eleven_twelfths_timestep;
    real answer_own[GEARTRAIN_STATIONS]; /* unknown of a station if its inner side kept its motion */
    real known_angle[GEARTRAIN_STATIONS + 1]; /* angle of base and links without the unknown's share [rad] */
    real known_rate[GEARTRAIN_STATIONS + 1]; /* rate of base and links without the unknown's share [rad/s] */
    real load_torque[GEARTRAIN_STATIONS]; /* external torque on each link [N m] */
    real solved[GEARTRAIN_STATIONS]; /* unknown of each station */
    real total = 0.0; /* of the new motion: is all of it finite? */

    /* Motion known before the sweep; sweep inward: force beyond each joint as an affine function of the
     * motion at it. */
    known_rate[0] = state->hub_rate + state->hub_acceleration * known_rate_per_acceleration;
    known_angle[0] = state->hub_angle + five_ninths_timestep * state->hub_rate
        + state->hub_acceleration * known_angle_per_acceleration;
    for (int j = 0; j < GEARTRAIN_STATIONS; ++j) {
        known_rate[j + 1] = state->rate[j] + state->acceleration[j] * known_rate_per_acceleration;
        known_angle[j + 1] = state->angle[j] + state->acceleration[j] * known_angle_per_acceleration
            + five_ninths_timestep * state->rate[j];
        load_torque[j] = 0.0;
    }
    load_torque[1] = inputs->feeder_torque;
    real torque = inputs->load_torque;

    /* Forces of the joints at the motion so far; sweep inward: force beyond each joint as an affine function
     * of the motion at it. */
    for (int j = GEARTRAIN_STATIONS - 1; j >= 3; --j) {
        const real joint_torque = model->damping[j] * (known_rate[j + 1] - known_rate[j])
            + model->stiffness[j] * (known_angle[j + 1] - known_angle[j]);
        torque = load_torque[j] + torque;
        answer_own[j] = model->admittance[j] * (torque - joint_torque);
        torque = joint_torque * model->reflection[j] + torque * model->transmission[j];
    }
    for (int j = 2; j >= 2; --j) {
        const real joint_torque = model->damping[j] * known_rate[j + 1]
            + known_angle[j + 1] * model->stiffness[j] - model->damping[j] * known_rate[1] * model->turn[j]
            - known_angle[1] * model->stiffness[j] * model->turn[j];
        torque = load_torque[j] + torque;
        answer_own[j] = model->admittance[j] * (torque - joint_torque);
        torque = joint_torque * model->reflection[j] + torque * model->transmission[j];
    }
    const real torque_of_branch_3 = torque;
    for (int j = 1; j >= 1; --j) {
        const real joint_torque = model->damping[j] * known_rate[j + 1]
            + known_angle[j + 1] * model->stiffness[j] - model->damping[j] * known_rate[j] * model->turn[j]
            - known_angle[j] * model->stiffness[j] * model->turn[j];
        answer_own[j] = model->admittance[j] * (load_torque[j] - joint_torque);
        torque = joint_torque * model->reflection[j] + load_torque[j] * model->transmission[j];
    }
    torque = torque + torque_of_branch_3;
    for (int j = 0; j >= 0; --j) {
        const real joint_torque = model->damping[j] * (known_rate[j + 1] - known_rate[j])
            + model->stiffness[j] * (known_angle[j + 1] - known_angle[j]);
        torque = load_torque[j] + torque;
        answer_own[j] = model->admittance[j] * (torque - joint_torque);
        torque = joint_torque * model->reflection[j] + torque * model->transmission[j];
    }

    /* The base. */
    real unknown = model->hub_admittance * (inputs->motor_torque + torque)
        - known_rate[0] * model->unknown_per_known_rate;
    const real hub_unknown = unknown;

    /* Sweep outward: the unknown of each station. */
    for (int j = 0; j < 2; ++j) {
        unknown = answer_own[j] + model->transmission[j] * unknown;
        solved[j] = unknown;
    }
    unknown = solved[0];
    for (int j = 2; j < GEARTRAIN_STATIONS; ++j) {
        unknown = answer_own[j] + model->transmission[j] * unknown;
        solved[j] = unknown;
    }

    /* Motion at the end of the step. */
    state->hub_angle = state->hub_angle + angle_per_acceleration_2 * state->hub_acceleration
        + angle_per_unknown * hub_unknown + state->hub_rate * step;
    state->hub_rate = state->hub_rate + eleven_twelfths_timestep * hub_unknown
        + state->hub_acceleration * twelfth_timestep;
    state->hub_acceleration = 1.5 * hub_unknown - 0.5 * state->hub_acceleration;
    for (int j = 0; j < GEARTRAIN_STATIONS; ++j) {
        state->angle[j] = state->angle[j] + state->acceleration[j] * angle_per_acceleration_2
            + angle_per_unknown * solved[j] + state->rate[j] * step;
        state->rate[j] = state->rate[j] + state->acceleration[j] * twelfth_timestep
            + eleven_twelfths_timestep * solved[j];
        state->acceleration[j] = 1.5 * solved[j] - 0.5 * state->acceleration[j];
        total += state->angle[j] + state->rate[j] + state->acceleration[j];
    }

    if (!isfinite(total + state->hub_angle + state->hub_rate + state->hub_acceleration)) {
        return GEARTRAIN_NON_FINITE_STATE;
    }
    return GEARTRAIN_OK;
}

void geartrain_output(
    const geartrain_model *model,
    const geartrain_state *state,
    geartrain_outputs *outputs)
{
    if (model == NULL || state == NULL || outputs == NULL) {
        return;
    }
    /* Outputs. */
    outputs->motor_speed = state->hub_rate;
    outputs->table = state->angle[3];
    outputs->table_speed = state->rate[3];
    outputs->feeder_speed = state->rate[1];
    outputs->coupling_torque = model->damping[0] * (state->hub_rate - state->rate[0])
        + model->stiffness[0] * (state->hub_angle - state->angle[0]);
    outputs->teeth = state->angle[0] * model->teeth_per_angle - state->angle[2] * model->stiffness[2]
        - model->damping[2] * state->rate[2] + state->rate[0] * model->teeth_per_rate;
}
