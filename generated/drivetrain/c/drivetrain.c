/**
 * drivetrain: Servo drive with gearbox, roller, brake and encoder
 *
 * Written by tmm-gen 0.1.0. Do not edit: change the scene and run `tmm-gen build`.
 * scene digest: 260c88ca5ffe6b93ea5946fad67187e547942573db1dc2f710bcd9a0610b8738
 * sha256 of the rest of this file: eaad34c615efe763ec3569a05d26193a6b185a98ebbc9c34da906d3d56e30e3d
 *
 * model: torsional chain (linear)
 * stations: 6
 * base: motor
 * integrator: Generalised alpha (Chung & Hulbert 1993), rho_inf = 0.8
 * sweep: riccati
 * unknown: acceleration
 * operations of a step: 215, 35.83 per station (107 additions, 108 multiplications)
 * operations of prepare: 88, 14.67 per station (20 additions, 61 multiplications, 7 divisions)
 * number type: double
 * bytes of the structs: params 160, model 320, state 168, inputs 16, outputs 32
 *
 * @file drivetrain.c
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
#undef motor_speed
#undef roller_speed
#undef shaft_torque
#undef encoder

#include "drivetrain.h"

typedef drivetrain_real real;

static int inputs_are_finite(const drivetrain_inputs *inputs)
{
    if (!isfinite(inputs->motor_torque) || !isfinite(inputs->load_torque)) {
        return 0;
    }
    return 1;
}

void drivetrain_default_params(drivetrain_params *params)
{
    static const real stiffness[] = {
        24000.0, 2600.0, 60000.0, 2000.0, 1600.0, 150.0
    };
    static const real damping[] = {
        0.05, 1.5, 0.4, 0.1, 0.08, 0.002
    };
    static const real inertia[] = {
        0.0004, 0.0011, 0.0028, 0.019, 0.0024, 2e-05
    };
    if (params == NULL) {
        return;
    }
    for (int j = 0; j < DRIVETRAIN_STATIONS; ++j) {
        params->stiffness[j] = stiffness[j];
    }
    for (int j = 0; j < DRIVETRAIN_STATIONS; ++j) {
        params->damping[j] = damping[j];
    }
    for (int j = 0; j < DRIVETRAIN_STATIONS; ++j) {
        params->inertia[j] = inertia[j];
    }
    params->hub_inertia = 0.0027;
    params->hub_damping = 0.001;
}

drivetrain_status drivetrain_prepare(
    drivetrain_model *model,
    const drivetrain_params *params,
    drivetrain_real step)
{
    if (model == NULL || params == NULL) {
        return DRIVETRAIN_NULL_POINTER;
    }
    if (!(step > 0.0) || !(step <= DBL_MAX)) {
        return DRIVETRAIN_INVALID_STEP;
    }
    /* Infinities and NaN less themselves are NaN, all other numbers 0. */
    real lost = (params->hub_inertia - params->hub_inertia) + (params->hub_damping - params->hub_damping);
    for (int j = 0; j < DRIVETRAIN_STATIONS; ++j) {
        lost += (params->stiffness[j] - params->stiffness[j]) + (params->damping[j] - params->damping[j])
            + (params->inertia[j] - params->inertia[j]);
    }
    if (!(lost >= 0.0)) {
        return DRIVETRAIN_NON_FINITE_INPUT;
    }

    /* Riccati factors, swept from tip to base. */
    real impedance = 0.0;
    for (int j = DRIVETRAIN_STATIONS - 1; j >= 0; --j) {
        const real joint_impedance = (55.0 / 108.0) * params->damping[j] * step
            + (125.0 / 486.0) * (step * step) * params->stiffness[j];
        impedance = impedance - params->inertia[j];
        const real pivot = joint_impedance - impedance;
        if (!(pivot > 0.0) || !(pivot <= DBL_MAX)) {
            return DRIVETRAIN_VANISHING_PIVOT;
        }
        model->admittance[j] = 1.0 / pivot;
        model->transmission[j] = model->admittance[j] * joint_impedance;
        model->reflection[j] = -model->admittance[j] * impedance;
        impedance = impedance * model->transmission[j];
    }
    const real hub_pivot = params->hub_inertia - impedance + (55.0 / 108.0) * params->hub_damping * step;
    if (!(hub_pivot > 0.0) || !(hub_pivot <= DBL_MAX)) {
        return DRIVETRAIN_VANISHING_PIVOT;
    }
    model->hub_admittance = 1.0 / hub_pivot;

    /* Factors of the step that depend on the time step and parameters alone. */
    model->step_5_over_108 = (5.0 / 108.0) * step;
    model->step2_5_over_243 = (5.0 / 243.0) * (step * step);
    model->step_5_over_9 = (5.0 / 9.0) * step;
    model->factor_4 = model->hub_admittance * params->hub_damping;
    model->step2_1_over_27 = (1.0 / 27.0) * (step * step);
    model->step2_25_over_54 = (25.0 / 54.0) * (step * step);
    model->step_1_over_12 = (1.0 / 12.0) * step;
    model->step_11_over_12 = (11.0 / 12.0) * step;

    /* What the step needs as it is. */
    model->step = step;
    for (int j = 0; j < DRIVETRAIN_STATIONS; ++j) {
        model->stiffness[j] = params->stiffness[j];
    }
    for (int j = 0; j < DRIVETRAIN_STATIONS; ++j) {
        model->damping[j] = params->damping[j];
    }

    real total = 0.0; /* of the model: is all of it finite? */
    for (int j = 0; j < DRIVETRAIN_STATIONS; ++j) {
        total += model->admittance[j] + model->transmission[j] + model->reflection[j];
    }
    if (!isfinite(model->step_5_over_108 + model->step2_5_over_243 + model->step_5_over_9 + model->factor_4
        + model->step2_1_over_27 + model->step2_25_over_54 + model->step_1_over_12 + model->step_11_over_12
        + model->hub_admittance + total)) {
        return DRIVETRAIN_NON_FINITE_MODEL;
    }
    return DRIVETRAIN_OK;
}

drivetrain_status drivetrain_initialise(
    drivetrain_state *state,
    const drivetrain_params *params,
    const drivetrain_real initial_angle[DRIVETRAIN_STATIONS],
    const drivetrain_real initial_rate[DRIVETRAIN_STATIONS],
    const drivetrain_inputs *inputs)
{
    if (state == NULL || params == NULL || inputs == NULL) {
        return DRIVETRAIN_NULL_POINTER;
    }
    if (!inputs_are_finite(inputs)) {
        return DRIVETRAIN_NON_FINITE_INPUT;
    }
    for (int j = 0; j < DRIVETRAIN_STATIONS; ++j) {
        if ((initial_angle != NULL && !isfinite(initial_angle[j]))
            || (initial_rate != NULL && !isfinite(initial_rate[j]))) {
            return DRIVETRAIN_NON_FINITE_INPUT;
        }
    }

    real correction[DRIVETRAIN_STATIONS]; /* unknown of each station if its inner neighbour's were zero */
    /* angle of each node without the unknown's share, base first [rad] */
    real known_angle[DRIVETRAIN_STATIONS + 1];
    /* rate of each node without the unknown's share, base first [rad/s] */
    real known_rate[DRIVETRAIN_STATIONS + 1];
    real load[DRIVETRAIN_STATIONS]; /* external torque on each link but the last [N m] */
    real total = 0.0; /* of the new motion: is all of it finite? */

    /* Motion known before the sweep; sweep inward: torque beyond each joint as if its inner side did not
     * move. */
    known_rate[0] = 0.0;
    known_angle[0] = 0.0;
    for (int j = 0; j < DRIVETRAIN_STATIONS; ++j) {
        known_rate[j + 1] = (initial_rate != NULL ? initial_rate[j] : 0.0);
        known_angle[j + 1] = (initial_angle != NULL ? initial_angle[j] : 0.0);
        load[j] = 0.0;
    }
    load[3] = inputs->load_torque;
    real bias = 0.0;

    /* Torque of each joint at the known motion; sweep inward: torque beyond each joint as if its inner side
     * did not move. */
    for (int j = DRIVETRAIN_STATIONS - 1; j >= 0; --j) {
        const real joint_torque = params->damping[j] * (known_rate[j + 1] - known_rate[j])
            + params->stiffness[j] * (known_angle[j + 1] - known_angle[j]);
        bias = bias + load[j];
        correction[j] = (bias - joint_torque) / params->inertia[j];
        bias = joint_torque;
    }

    /* The base. */
    const real unknown = (bias + inputs->motor_torque - params->hub_damping * known_rate[0])
        / params->hub_inertia;
    const real hub_unknown = unknown;

    /* Sweep outward: the unknown of each station; motion at the end of the step. */
    state->hub_angle = known_angle[0];
    state->hub_rate = known_rate[0];
    state->hub_acceleration = hub_unknown;
    for (int j = 0; j < DRIVETRAIN_STATIONS; ++j) {
        state->angle[j] = known_angle[j + 1];
        state->rate[j] = known_rate[j + 1];
        state->acceleration[j] = correction[j];
        total += state->angle[j] + state->rate[j] + state->acceleration[j];
    }

    if (!isfinite(total + state->hub_angle + state->hub_rate + state->hub_acceleration)) {
        return DRIVETRAIN_NON_FINITE_STATE;
    }
    return DRIVETRAIN_OK;
}

drivetrain_status drivetrain_step(
    const drivetrain_model *model,
    drivetrain_state *state,
    const drivetrain_inputs *inputs)
{
    if (model == NULL || state == NULL || inputs == NULL) {
        return DRIVETRAIN_NULL_POINTER;
    }
    if (!inputs_are_finite(inputs)) {
        return DRIVETRAIN_NON_FINITE_INPUT;
    }

    const real step = model->step;
    const real step_5_over_108 = model->step_5_over_108;
    const real step2_5_over_243 = model->step2_5_over_243;
    const real step_5_over_9 = model->step_5_over_9;
    const real step2_1_over_27 = model->step2_1_over_27;
    const real step2_25_over_54 = model->step2_25_over_54;
    const real step_1_over_12 = model->step_1_over_12;
    const real step_11_over_12 = model->step_11_over_12;
    real correction[DRIVETRAIN_STATIONS]; /* unknown of each station if its inner neighbour's were zero */
    /* angle of each node without the unknown's share, base first [rad] */
    real known_angle[DRIVETRAIN_STATIONS + 1];
    /* rate of each node without the unknown's share, base first [rad/s] */
    real known_rate[DRIVETRAIN_STATIONS + 1];
    real load[DRIVETRAIN_STATIONS]; /* external torque on each link but the last [N m] */
    real total = 0.0; /* of the new motion: is all of it finite? */

    /* Motion known before the sweep; sweep inward: torque beyond each joint as if its inner side did not
     * move. */
    known_rate[0] = state->hub_rate + state->hub_acceleration * step_5_over_108;
    known_angle[0] = state->hub_angle + state->hub_acceleration * step2_5_over_243
        + state->hub_rate * step_5_over_9;
    for (int j = 0; j < DRIVETRAIN_STATIONS; ++j) {
        known_rate[j + 1] = state->rate[j] + state->acceleration[j] * step_5_over_108;
        known_angle[j + 1] = state->angle[j] + state->acceleration[j] * step2_5_over_243
            + state->rate[j] * step_5_over_9;
        load[j] = 0.0;
    }
    load[3] = inputs->load_torque;
    real bias = 0.0;

    /* Torque of each joint at the known motion; sweep inward: torque beyond each joint as if its inner side
     * did not move. */
    for (int j = DRIVETRAIN_STATIONS - 1; j >= 0; --j) {
        const real joint_torque = model->damping[j] * (known_rate[j + 1] - known_rate[j])
            + model->stiffness[j] * (known_angle[j + 1] - known_angle[j]);
        bias = bias + load[j];
        correction[j] = model->admittance[j] * (bias - joint_torque);
        bias = bias * model->transmission[j] + joint_torque * model->reflection[j];
    }

    /* The base. */
    real unknown = model->hub_admittance * (bias + inputs->motor_torque) - model->factor_4 * known_rate[0];
    const real hub_unknown = unknown;

    /* Sweep outward: the unknown of each station; motion at the end of the step. */
    state->hub_angle = state->hub_angle + state->hub_acceleration * step2_1_over_27 + state->hub_rate * step
        + hub_unknown * step2_25_over_54;
    state->hub_rate = state->hub_rate + state->hub_acceleration * step_1_over_12
        + hub_unknown * step_11_over_12;
    state->hub_acceleration = 1.5 * hub_unknown - 0.5 * state->hub_acceleration;
    for (int j = 0; j < DRIVETRAIN_STATIONS; ++j) {
        unknown = correction[j] + model->transmission[j] * unknown;
        const real solved = unknown;
        state->angle[j] = state->angle[j] + state->acceleration[j] * step2_1_over_27 + state->rate[j] * step
            + solved * step2_25_over_54;
        state->rate[j] = state->rate[j] + state->acceleration[j] * step_1_over_12 + solved * step_11_over_12;
        state->acceleration[j] = 1.5 * unknown - 0.5 * state->acceleration[j];
        total += state->angle[j] + state->rate[j] + state->acceleration[j];
    }

    if (!isfinite(total + state->hub_angle + state->hub_rate + state->hub_acceleration)) {
        return DRIVETRAIN_NON_FINITE_STATE;
    }
    return DRIVETRAIN_OK;
}

void drivetrain_output(
    const drivetrain_model *model,
    const drivetrain_state *state,
    drivetrain_outputs *outputs)
{
    if (model == NULL || state == NULL || outputs == NULL) {
        return;
    }
    /* Outputs. */
    outputs->motor_speed = state->hub_rate;
    outputs->roller_speed = state->rate[3];
    outputs->shaft_torque = model->damping[3] * (state->rate[3] - state->rate[2])
        + model->stiffness[3] * (state->angle[3] - state->angle[2]);
    outputs->encoder = state->angle[5];
}
