/**
 * drivetrain: Servo drive with gearbox, roller, brake and encoder
 *
 * Written by tmm-gen 0.2.0. Do not edit: change the scene and run `tmm-gen build`.
 * scene digest: 260c88ca5ffe6b93ea5946fad67187e547942573db1dc2f710bcd9a0610b8738
 * sha256 of the rest of this file: c48654090ffa00cbdbe4eaa47b9a117c635377f090a796f73475107512396fac
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

    /* Factors of the sweep that do not change from step to step. */
    real impedance = 0.0;
    for (int j = DRIVETRAIN_STATIONS - 1; j >= 0; --j) {
        impedance = impedance - params->inertia[j];
        const real joint_impedance = (55.0 / 108.0) * params->damping[j] * step
            + (125.0 / 486.0) * (step * step) * params->stiffness[j];
        const real pivot = joint_impedance - impedance;
        if (!(pivot > 0.0) || !(pivot <= DBL_MAX)) {
            return DRIVETRAIN_VANISHING_PIVOT;
        }
        model->admittance[j] = 1.0 / pivot;
        model->transmission[j] = model->admittance[j] * joint_impedance;
        model->reflection[j] = -model->admittance[j] * impedance;
        impedance = impedance * model->transmission[j];
    }
    const real hub_impedance = params->hub_inertia + (55.0 / 108.0) * params->hub_damping * step;
    const real hub_pivot = hub_impedance - impedance;
    if (!(hub_pivot > 0.0) || !(hub_pivot <= DBL_MAX)) {
        return DRIVETRAIN_VANISHING_PIVOT;
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
    if (!isfinite(model->known_rate_per_acceleration + model->known_angle_per_acceleration
        + model->five_ninths_timestep + model->unknown_per_known_rate + model->angle_per_acceleration_2
        + model->angle_per_unknown + model->twelfth_timestep + model->eleven_twelfths_timestep
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

    real answer_own[DRIVETRAIN_STATIONS]; /* unknown of a station if its inner side kept its motion */
    real known_angle[DRIVETRAIN_STATIONS + 1]; /* angle of base and links without the unknown's share [rad] */
    real known_rate[DRIVETRAIN_STATIONS + 1]; /* rate of base and links without the unknown's share [rad/s] */
    real load_torque[DRIVETRAIN_STATIONS]; /* external torque on each link [N m] */
    real total = 0.0; /* of the new motion: is all of it finite? */

    /* Motion known before the sweep; sweep inward: force beyond each joint as an affine function of the
     * motion at it. */
    known_rate[0] = 0.0;
    known_angle[0] = 0.0;
    for (int j = 0; j < DRIVETRAIN_STATIONS; ++j) {
        known_rate[j + 1] = (initial_rate != NULL ? initial_rate[j] : 0.0);
        known_angle[j + 1] = (initial_angle != NULL ? initial_angle[j] : 0.0);
        load_torque[j] = 0.0;
    }
    load_torque[3] = inputs->load_torque;
    real torque = 0.0;

    /* Forces of the joints at the motion so far; sweep inward: force beyond each joint as an affine function
     * of the motion at it. */
    for (int j = DRIVETRAIN_STATIONS - 1; j >= 0; --j) {
        const real joint_torque = params->damping[j] * (known_rate[j + 1] - known_rate[j])
            + params->stiffness[j] * (known_angle[j + 1] - known_angle[j]);
        torque = load_torque[j] + torque;
        const real impedance = -params->inertia[j];
        const real pivot = -impedance;
        if (!(pivot > 0.0) || !(pivot <= DBL_MAX)) {
            return DRIVETRAIN_VANISHING_PIVOT;
        }
        const real start_admittance = 1.0 / pivot;
        answer_own[j] = start_admittance * (torque - joint_torque);
        torque = joint_torque;
    }

    /* The base. */
    if (!(params->hub_inertia > 0.0) || !(params->hub_inertia <= DBL_MAX)) {
        return DRIVETRAIN_VANISHING_PIVOT;
    }
    const real start_hub_admittance = 1.0 / params->hub_inertia;
    const real unknown = start_hub_admittance
        * (inputs->motor_torque + torque - params->hub_damping * known_rate[0]);
    const real hub_unknown = unknown;

    /* Sweep outward: the unknown of each station; motion at the end of the step. */
    state->hub_angle = known_angle[0];
    state->hub_rate = known_rate[0];
    state->hub_acceleration = hub_unknown;
    for (int j = 0; j < DRIVETRAIN_STATIONS; ++j) {
        state->angle[j] = known_angle[j + 1];
        state->rate[j] = known_rate[j + 1];
        state->acceleration[j] = answer_own[j];
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
    const real known_rate_per_acceleration = model->known_rate_per_acceleration;
    const real known_angle_per_acceleration = model->known_angle_per_acceleration;
    const real five_ninths_timestep = model->five_ninths_timestep;
    const real angle_per_acceleration_2 = model->angle_per_acceleration_2;
    const real angle_per_unknown = model->angle_per_unknown;
    const real twelfth_timestep = model->twelfth_timestep;
    const real eleven_twelfths_timestep = model->eleven_twelfths_timestep;
    real answer_own[DRIVETRAIN_STATIONS]; /* unknown of a station if its inner side kept its motion */
    real known_angle[DRIVETRAIN_STATIONS + 1]; /* angle of base and links without the unknown's share [rad] */
    real known_rate[DRIVETRAIN_STATIONS + 1]; /* rate of base and links without the unknown's share [rad/s] */
    real load_torque[DRIVETRAIN_STATIONS]; /* external torque on each link [N m] */
    real total = 0.0; /* of the new motion: is all of it finite? */

    /* Motion known before the sweep; sweep inward: force beyond each joint as an affine function of the
     * motion at it. */
    known_rate[0] = state->hub_rate + state->hub_acceleration * known_rate_per_acceleration;
    known_angle[0] = state->hub_angle + five_ninths_timestep * state->hub_rate
        + state->hub_acceleration * known_angle_per_acceleration;
    for (int j = 0; j < DRIVETRAIN_STATIONS; ++j) {
        known_rate[j + 1] = state->rate[j] + state->acceleration[j] * known_rate_per_acceleration;
        known_angle[j + 1] = state->angle[j] + state->acceleration[j] * known_angle_per_acceleration
            + five_ninths_timestep * state->rate[j];
        load_torque[j] = 0.0;
    }
    load_torque[3] = inputs->load_torque;
    real torque = 0.0;

    /* Forces of the joints at the motion so far; sweep inward: force beyond each joint as an affine function
     * of the motion at it. */
    for (int j = DRIVETRAIN_STATIONS - 1; j >= 0; --j) {
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

    /* Sweep outward: the unknown of each station; motion at the end of the step. */
    state->hub_angle = state->hub_angle + angle_per_acceleration_2 * state->hub_acceleration
        + angle_per_unknown * hub_unknown + state->hub_rate * step;
    state->hub_rate = state->hub_rate + eleven_twelfths_timestep * hub_unknown
        + state->hub_acceleration * twelfth_timestep;
    state->hub_acceleration = 1.5 * hub_unknown - 0.5 * state->hub_acceleration;
    for (int j = 0; j < DRIVETRAIN_STATIONS; ++j) {
        unknown = answer_own[j] + model->transmission[j] * unknown;
        state->angle[j] = state->angle[j] + state->acceleration[j] * angle_per_acceleration_2
            + angle_per_unknown * unknown + state->rate[j] * step;
        state->rate[j] = state->rate[j] + state->acceleration[j] * twelfth_timestep
            + eleven_twelfths_timestep * unknown;
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
