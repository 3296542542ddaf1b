/**
 * fall10: Soft clamped beam falling under its own weight
 *
 * Written by tmm-gen 0.1.0. Do not edit: change the scene and run `tmm-gen build`.
 * scene digest: 225557ccb20983327784b6fc8326b9127fb185b183a5e99d150385ab258b9303
 * sha256 of the rest of this file: f122bfe428eb88229199d1bdd59bb083f12ac851b4045666648cc4502670794e
 *
 * model: planar arm, large rotations, gravity
 * stations: 10
 * base: clamp
 * integrator: Newmark 1959, beta = 0.25, gamma = 0.5
 * linearisation: newton
 * sweep: riccati
 * unknown: acceleration
 * operations of a step: 1330, 133 per station (610 additions, 690 multiplications, 10 divisions, 20
 *     functions)
 * operations of prepare: 73, 7.3 per station (12 additions, 61 multiplications)
 * number type: double
 * bytes of the structs: params 200, model 320, state 240, inputs 8, outputs 40
 *
 * @file fall10.c
 */
#if defined(__FAST_MATH__) || defined(__ASSOCIATIVE_MATH__) || defined(_M_FP_FAST) \
    || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "-Ofast and -ffast-math remove checks of this file: use -O3, or put -fno-fast-math behind them"
#endif

#include <float.h>
#include <math.h>
#include <stddef.h>

/* Members of the header below: no macro of a header above may have their names. */
#undef tip_x
#undef tip_y
#undef speed_x
#undef speed_y
#undef root

#include "fall10.h"

typedef fall10_real real;

void fall10_default_params(fall10_params *params)
{
    static const real stiffness[] = {
        32.0, 16.0, 16.0, 16.0, 16.0, 16.0, 16.0, 16.0, 16.0, 16.0
    };
    static const real damping[] = {
        0.064, 0.032, 0.032, 0.032, 0.032, 0.032, 0.032, 0.032, 0.032, 0.032
    };
    if (params == NULL) {
        return;
    }
    params->length = 0.1;
    params->mass = 0.03;
    params->inertia = 2.5e-05;
    params->center = 0.5;
    for (int j = 0; j < FALL10_STATIONS; ++j) {
        params->stiffness[j] = stiffness[j];
    }
    for (int j = 0; j < FALL10_STATIONS; ++j) {
        params->damping[j] = damping[j];
    }
    params->gravity = 9.81;
}

fall10_status fall10_prepare(
    fall10_model *model,
    const fall10_params *params,
    fall10_real step)
{
    if (model == NULL || params == NULL) {
        return FALL10_NULL_POINTER;
    }
    if (!(step > 0.0) || !(step <= 1.7976931348623157e+308)) {
        return FALL10_INVALID_STEP;
    }
    /* Infinities and NaN less themselves are NaN, all other numbers 0. */
    real lost = (params->length - params->length) + (params->mass - params->mass)
        + (params->inertia - params->inertia) + (params->center - params->center)
        + (params->gravity - params->gravity);
    for (int j = 0; j < FALL10_STATIONS; ++j) {
        lost += (params->stiffness[j] - params->stiffness[j]) + (params->damping[j] - params->damping[j]);
    }
    if (!(lost >= 0.0)) {
        return FALL10_NON_FINITE_INPUT;
    }

    /* Masses by the ends they act at, and joint impedances. */
    model->carried_mass = params->center * params->mass;
    model->inner_mass = params->mass - params->center * params->mass;
    model->pin_inertia = params->inertia
        + params->center * params->center * (params->length * params->length) * params->mass;
    for (int j = 0; j < FALL10_STATIONS; ++j) {
        model->joint_impedance[j] = 0.5 * params->damping[j] * step
            + 0.25 * (step * step) * params->stiffness[j];
    }

    /* Factors of the step that depend on the time step and parameters alone. */
    model->step2_1_over_2 = 0.5 * (step * step);
    model->angle_per_acceleration = 0.25 * (step * step);
    model->rate_per_acceleration = 0.5 * step;

    /* What the step needs as it is. */
    model->step = step;
    model->length = params->length;
    model->mass = params->mass;
    for (int j = 0; j < FALL10_STATIONS; ++j) {
        model->stiffness[j] = params->stiffness[j];
    }
    for (int j = 0; j < FALL10_STATIONS; ++j) {
        model->damping[j] = params->damping[j];
    }
    model->gravity = params->gravity;

    real total = 0.0; /* of the model: is all of it finite? */
    for (int j = 0; j < FALL10_STATIONS; ++j) {
        total += model->joint_impedance[j];
    }
    if (!isfinite(model->step2_1_over_2 + model->angle_per_acceleration + model->rate_per_acceleration
        + model->carried_mass + model->inner_mass + model->pin_inertia + total)) {
        return FALL10_NON_FINITE_MODEL;
    }
    return FALL10_OK;
}

fall10_status fall10_initialise(
    fall10_state *state,
    const fall10_params *params,
    const fall10_real initial_angle[FALL10_STATIONS],
    const fall10_real initial_rate[FALL10_STATIONS],
    const fall10_inputs *inputs)
{
    if (state == NULL || params == NULL) {
        return FALL10_NULL_POINTER;
    }
    for (int j = 0; j < FALL10_STATIONS; ++j) {
        if ((initial_angle != NULL && !isfinite(initial_angle[j]))
            || (initial_rate != NULL && !isfinite(initial_rate[j]))) {
            return FALL10_NON_FINITE_INPUT;
        }
    }
    (void)inputs;

    const real length = params->length;
    const real mass = params->mass;
    const real inertia = params->inertia;
    const real center = params->center;
    real acceleration_x[FALL10_STATIONS + 1]; /* acceleration of the nodes along x [m/s^2] */
    real acceleration_y[FALL10_STATIONS + 1]; /* acceleration of the nodes along y [m/s^2] */
    real answer_own[FALL10_STATIONS]; /* increment of the unknown if the inner side kept its motion */
    real answer_x[FALL10_STATIONS]; /* answer to the joint's acceleration along x */
    real answer_y[FALL10_STATIONS]; /* answer to the joint's acceleration along y */
    real lever_cosine[FALL10_STATIONS]; /* length times cosine of the predicted angle [m] */
    real lever_sine[FALL10_STATIONS]; /* length times sine of the predicted angle [m] */
    /* acceleration of base and links as predicted [rad/s^2] */
    real predicted_acceleration[FALL10_STATIONS + 1];
    real predicted_angle[FALL10_STATIONS + 1]; /* angle of base and links as predicted [rad] */
    real predicted_rate[FALL10_STATIONS + 1]; /* rate of base and links as predicted [rad/s] */
    real swing_x[FALL10_STATIONS]; /* change of the outer end's acceleration along x per unknown [m] */
    real swing_y[FALL10_STATIONS]; /* change of the outer end's acceleration along y per unknown [m] */
    real total = 0.0; /* of the new motion: is all of it finite? */

    /* Predicted motion. */
    predicted_angle[0] = 0.0;
    predicted_rate[0] = 0.0;
    predicted_acceleration[0] = 0.0;

    /* Predicted motion; accelerations of the nodes, seen from a falling frame: gravity is the base's own. */
    real node_x = 0.0;
    real node_y = params->gravity;
    acceleration_x[0] = node_x;
    acceleration_y[0] = params->gravity;
    for (int j = 0; j < FALL10_STATIONS; ++j) {
        predicted_angle[j + 1] = (initial_angle != NULL ? initial_angle[j] : 0.0);
        predicted_rate[j + 1] = (initial_rate != NULL ? initial_rate[j] : 0.0);
        predicted_acceleration[j + 1] = 0.0;
        lever_sine[j] = length * sin(predicted_angle[j + 1]);
        lever_cosine[j] = length * cos(predicted_angle[j + 1]);
        const real square = predicted_rate[j + 1] * predicted_rate[j + 1];
        node_x = node_x - lever_cosine[j] * square - lever_sine[j] * predicted_acceleration[j + 1];
        node_y = node_y + lever_cosine[j] * predicted_acceleration[j + 1] - lever_sine[j] * square;
        acceleration_x[j + 1] = node_x;
        acceleration_y[j + 1] = node_y;
    }

    /* How each link's outer end answers to its unknown, and the predicted joint torques; sweep inward: force
     * beyond each joint as an affine function of the motion at it. */
    real impedance_xx = 0.0;
    real impedance_xy = 0.0;
    real impedance_xu = 0.0;
    real impedance_yx = 0.0;
    real impedance_yy = 0.0;
    real impedance_yu = 0.0;
    real impedance_ux = 0.0;
    real impedance_uy = 0.0;
    real impedance_uu = 0.0;
    real force_x = 0.0;
    real force_y = 0.0;
    real torque = 0.0;
    for (int j = FALL10_STATIONS - 1; j >= 0; --j) {
        swing_x[j] = -lever_sine[j];
        swing_y[j] = lever_cosine[j];
        const real joint_torque = params->damping[j] * (predicted_rate[j] - predicted_rate[j + 1])
            + params->stiffness[j] * (predicted_angle[j] - predicted_angle[j + 1]);
        const real outer_x = impedance_xu + impedance_xx * swing_x[j] + impedance_xy * swing_y[j];
        const real outer_y = impedance_yu + impedance_yx * swing_x[j] + impedance_yy * swing_y[j];
        const real outer_u = impedance_uu + impedance_ux * swing_x[j] + impedance_uy * swing_y[j];
        const real load_x = force_x + acceleration_x[j] * center * mass;
        const real load_y = force_y + acceleration_y[j] * center * mass;
        const real link_ux = impedance_ux + impedance_yx * lever_cosine[j]
            - lever_sine[j] * (impedance_xx + center * mass);
        const real link_uy = impedance_uy - impedance_xy * lever_sine[j]
            + lever_cosine[j] * (impedance_yy + center * mass);
        const real link_uu = inertia + outer_u + lever_cosine[j] * outer_y - lever_sine[j] * outer_x
            + center * center * (length * length) * mass;
        const real link_xx = impedance_xx + mass;
        const real link_xu = outer_x + center * mass * swing_x[j];
        const real link_yy = impedance_yy + mass;
        const real link_yu = outer_y + center * mass * swing_y[j];
        torque = torque + lever_cosine[j] * load_y - lever_sine[j] * load_x
            + predicted_acceleration[j + 1] * (inertia + center * center * (length * length) * mass);
        force_x = force_x + acceleration_x[j] * (mass - center * mass)
            + acceleration_x[j + 1] * center * mass;
        force_y = force_y + acceleration_y[j] * (mass - center * mass)
            + acceleration_y[j + 1] * center * mass;
        if (!(link_uu > 0.0) || !(link_uu <= DBL_MAX)) {
            return FALL10_VANISHING_PIVOT;
        }
        const real inverse_pivot = 1.0 / link_uu;
        answer_own[j] = inverse_pivot * (joint_torque - torque);
        answer_x[j] = inverse_pivot * link_ux;
        answer_y[j] = inverse_pivot * link_uy;
        impedance_xx = link_xx - answer_x[j] * link_xu;
        impedance_xy = impedance_xy - answer_y[j] * link_xu;
        impedance_xu = 0.0;
        force_x = force_x + answer_own[j] * link_xu;
        impedance_yx = impedance_yx - answer_x[j] * link_yu;
        impedance_yy = link_yy - answer_y[j] * link_yu;
        impedance_yu = 0.0;
        force_y = force_y + answer_own[j] * link_yu;
        impedance_ux = 0.0;
        impedance_uy = 0.0;
        impedance_uu = 0.0;
        torque = joint_torque;
    }

    /* The base does not move. */
    real unknown = 0.0;

    /* Sweep outward: the increment of each link's unknown; motion at the end of the step. */
    real change_x = 0.0;
    real change_y = 0.0;
    for (int j = 0; j < FALL10_STATIONS; ++j) {
        unknown = answer_own[j] - answer_x[j] * change_x - answer_y[j] * change_y;
        change_x = change_x + swing_x[j] * unknown;
        change_y = change_y + swing_y[j] * unknown;
        state->angle[j] = predicted_angle[j + 1];
        state->rate[j] = predicted_rate[j + 1];
        state->acceleration[j] = predicted_acceleration[j + 1] + unknown;
        total += state->angle[j] + state->rate[j] + state->acceleration[j];
    }

    if (!isfinite(total)) {
        return FALL10_NON_FINITE_STATE;
    }
    return FALL10_OK;
}

fall10_status fall10_step(
    const fall10_model *model,
    fall10_state *state,
    const fall10_inputs *inputs)
{
    if (model == NULL || state == NULL) {
        return FALL10_NULL_POINTER;
    }
    (void)inputs;

    const real step = model->step;
    const real length = model->length;
    const real mass = model->mass;
    const real step2_1_over_2 = model->step2_1_over_2;
    const real angle_per_acceleration = model->angle_per_acceleration;
    const real rate_per_acceleration = model->rate_per_acceleration;
    const real carried_mass = model->carried_mass;
    const real inner_mass = model->inner_mass;
    const real pin_inertia = model->pin_inertia;
    real acceleration_x[FALL10_STATIONS + 1]; /* acceleration of the nodes along x [m/s^2] */
    real acceleration_y[FALL10_STATIONS + 1]; /* acceleration of the nodes along y [m/s^2] */
    real answer_from_inner[FALL10_STATIONS]; /* answer to the inner link's unknown */
    real answer_own[FALL10_STATIONS]; /* increment of the unknown if the inner side kept its motion */
    real answer_x[FALL10_STATIONS]; /* answer to the joint's acceleration along x */
    real answer_y[FALL10_STATIONS]; /* answer to the joint's acceleration along y */
    real lever_cosine[FALL10_STATIONS]; /* length times cosine of the predicted angle [m] */
    real lever_sine[FALL10_STATIONS]; /* length times sine of the predicted angle [m] */
    /* acceleration of base and links as predicted [rad/s^2] */
    real predicted_acceleration[FALL10_STATIONS + 1];
    real predicted_angle[FALL10_STATIONS + 1]; /* angle of base and links as predicted [rad] */
    real predicted_rate[FALL10_STATIONS + 1]; /* rate of base and links as predicted [rad/s] */
    real swing_x[FALL10_STATIONS]; /* change of the outer end's acceleration along x per unknown [m] */
    real swing_y[FALL10_STATIONS]; /* change of the outer end's acceleration along y per unknown [m] */
    real total = 0.0; /* of the new motion: is all of it finite? */

    /* Predicted motion. */
    predicted_angle[0] = 0.0;
    predicted_rate[0] = 0.0;
    predicted_acceleration[0] = 0.0;

    /* Predicted motion; accelerations of the nodes, seen from a falling frame: gravity is the base's own. */
    real node_x = 0.0;
    real node_y = model->gravity;
    acceleration_x[0] = node_x;
    acceleration_y[0] = model->gravity;
    for (int j = 0; j < FALL10_STATIONS; ++j) {
        predicted_angle[j + 1] = state->angle[j] + state->acceleration[j] * step2_1_over_2
            + state->rate[j] * step;
        predicted_rate[j + 1] = state->rate[j] + state->acceleration[j] * step;
        predicted_acceleration[j + 1] = state->acceleration[j];
        lever_sine[j] = length * sin(predicted_angle[j + 1]);
        lever_cosine[j] = length * cos(predicted_angle[j + 1]);
        const real square = predicted_rate[j + 1] * predicted_rate[j + 1];
        node_x = node_x - lever_cosine[j] * square - lever_sine[j] * predicted_acceleration[j + 1];
        node_y = node_y + lever_cosine[j] * predicted_acceleration[j + 1] - lever_sine[j] * square;
        acceleration_x[j + 1] = node_x;
        acceleration_y[j + 1] = node_y;
    }

    /* How each link's outer end answers to its unknown, and the predicted joint torques; sweep inward: force
     * beyond each joint as an affine function of the motion at it. */
    real impedance_xx = 0.0;
    real impedance_xy = 0.0;
    real impedance_xu = 0.0;
    real impedance_yx = 0.0;
    real impedance_yy = 0.0;
    real impedance_yu = 0.0;
    real impedance_ux = 0.0;
    real impedance_uy = 0.0;
    real impedance_uu = 0.0;
    real force_x = 0.0;
    real force_y = 0.0;
    real torque = 0.0;
    for (int j = FALL10_STATIONS - 1; j >= 0; --j) {
        const real tangential = 1.0
            - angle_per_acceleration * (predicted_rate[j + 1] * predicted_rate[j + 1]);
        const real turning = angle_per_acceleration * predicted_acceleration[j + 1]
            + predicted_rate[j + 1] * step;
        swing_x[j] = -lever_cosine[j] * turning - lever_sine[j] * tangential;
        swing_y[j] = lever_cosine[j] * tangential - lever_sine[j] * turning;
        const real joint_torque = model->damping[j] * (predicted_rate[j] - predicted_rate[j + 1])
            + model->stiffness[j] * (predicted_angle[j] - predicted_angle[j + 1]);
        const real outer_x = impedance_xu + impedance_xx * swing_x[j] + impedance_xy * swing_y[j];
        const real outer_y = impedance_yu + impedance_yx * swing_x[j] + impedance_yy * swing_y[j];
        const real outer_u = impedance_uu + impedance_ux * swing_x[j] + impedance_uy * swing_y[j];
        const real load_x = force_x + acceleration_x[j] * carried_mass;
        const real load_y = force_y + acceleration_y[j] * carried_mass;
        const real link_ux = impedance_ux + impedance_yx * lever_cosine[j]
            - lever_sine[j] * (carried_mass + impedance_xx);
        const real link_uy = impedance_uy - impedance_xy * lever_sine[j]
            + lever_cosine[j] * (carried_mass + impedance_yy);
        const real link_uu = outer_u + pin_inertia
            + angle_per_acceleration * (-lever_cosine[j] * load_x - lever_sine[j] * load_y)
            + lever_cosine[j] * outer_y - lever_sine[j] * outer_x;
        const real link_xx = impedance_xx + mass;
        const real link_xu = outer_x + carried_mass * swing_x[j];
        const real link_yy = impedance_yy + mass;
        const real link_yu = outer_y + carried_mass * swing_y[j];
        torque = torque + lever_cosine[j] * load_y - lever_sine[j] * load_x
            + pin_inertia * predicted_acceleration[j + 1];
        force_x = force_x + acceleration_x[j + 1] * carried_mass + acceleration_x[j] * inner_mass;
        force_y = force_y + acceleration_y[j + 1] * carried_mass + acceleration_y[j] * inner_mass;
        const real pivot = model->joint_impedance[j] + link_uu;
        if (!(pivot > 0.0) || !(pivot <= DBL_MAX)) {
            return FALL10_VANISHING_PIVOT;
        }
        const real inverse_pivot = 1.0 / pivot;
        answer_own[j] = inverse_pivot * (joint_torque - torque);
        answer_x[j] = inverse_pivot * link_ux;
        answer_y[j] = inverse_pivot * link_uy;
        answer_from_inner[j] = inverse_pivot * model->joint_impedance[j];
        impedance_xx = link_xx - answer_x[j] * link_xu;
        impedance_xy = impedance_xy - answer_y[j] * link_xu;
        impedance_xu = answer_from_inner[j] * link_xu;
        force_x = force_x + answer_own[j] * link_xu;
        impedance_yx = impedance_yx - answer_x[j] * link_yu;
        impedance_yy = link_yy - answer_y[j] * link_yu;
        impedance_yu = answer_from_inner[j] * link_yu;
        force_y = force_y + answer_own[j] * link_yu;
        impedance_ux = answer_x[j] * model->joint_impedance[j];
        impedance_uy = answer_y[j] * model->joint_impedance[j];
        impedance_uu = answer_from_inner[j] * link_uu;
        torque = joint_torque - answer_own[j] * model->joint_impedance[j];
    }

    /* The base does not move. */
    real unknown = 0.0;

    /* Sweep outward: the increment of each link's unknown; motion at the end of the step. */
    real change_x = 0.0;
    real change_y = 0.0;
    for (int j = 0; j < FALL10_STATIONS; ++j) {
        unknown = answer_own[j] + answer_from_inner[j] * unknown - answer_x[j] * change_x
            - answer_y[j] * change_y;
        change_x = change_x + swing_x[j] * unknown;
        change_y = change_y + swing_y[j] * unknown;
        state->angle[j] = predicted_angle[j + 1] + angle_per_acceleration * unknown;
        state->rate[j] = predicted_rate[j + 1] + rate_per_acceleration * unknown;
        state->acceleration[j] = predicted_acceleration[j + 1] + unknown;
        total += state->angle[j] + state->rate[j] + state->acceleration[j];
    }

    if (!isfinite(total)) {
        return FALL10_NON_FINITE_STATE;
    }
    return FALL10_OK;
}

void fall10_output(
    const fall10_model *model,
    const fall10_state *state,
    fall10_outputs *outputs)
{
    if (model == NULL || state == NULL || outputs == NULL) {
        return;
    }
    const real length = model->length;

    /* Tip: position. */
    outputs->tip_x = 0.0;
    outputs->tip_y = 0.0;

    /* Tip: position; speed: velocity. */
    outputs->speed_x = 0.0;
    outputs->speed_y = 0.0;
    for (int j = 0; j < FALL10_STATIONS; ++j) {
        outputs->tip_x = outputs->tip_x + length * cos(state->angle[j]);
        outputs->tip_y = outputs->tip_y + length * sin(state->angle[j]);
        outputs->speed_x = outputs->speed_x - length * state->rate[j] * sin(state->angle[j]);
        outputs->speed_y = outputs->speed_y + length * state->rate[j] * cos(state->angle[j]);
    }

    /* Root: torque. */
    outputs->root = state->angle[0] * model->stiffness[0] + model->damping[0] * state->rate[0];
}
