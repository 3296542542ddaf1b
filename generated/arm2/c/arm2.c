/**
 * arm2: Two unlike links swung by a motor
 *
 * Written by tmm-gen 0.1.0. Do not edit: change the scene and run `tmm-gen build`.
 * scene digest: c5e09abbb61734735cef8cfddf39dd959eb5765da3ad6484bed2957b4fdf212c
 * sha256 of the rest of this file: 13fa492ede0374b932972ba7ae6a4ef20ae94ecba862dcf4f9847284987b5c4b
 *
 * model: planar arm, large rotations, gravity, tip mass
 * stations: 2
 * base: motor
 * integrator: Newmark 1959, beta = 0.25, gamma = 0.5
 * linearisation: newton
 * sweep: riccati
 * unknown: acceleration
 * operations of a step: 287, 143.5 per station (132 additions, 148 multiplications, 3 divisions, 4 functions)
 * operations of prepare: 37, 18.5 per station (7 additions, 30 multiplications)
 * number type: double
 * bytes of the structs: params 136, model 208, state 72, inputs 8, outputs 32
 *
 * @file arm2.c
 */
#if defined(__FAST_MATH__) || defined(__ASSOCIATIVE_MATH__) || defined(_M_FP_FAST) \
    || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "-Ofast and -ffast-math remove checks of this file: use -O3, or put -fno-fast-math behind them"
#endif

#include <float.h>
#include <math.h>
#include <stddef.h>

/* Members of the header below: no macro of a header above may have their names. */
#undef hub_torque
#undef tip_x
#undef tip_y
#undef hub
#undef elbow

#include "arm2.h"

typedef arm2_real real;

static int inputs_are_finite(const arm2_inputs *inputs)
{
    if (!isfinite(inputs->hub_torque)) {
        return 0;
    }
    return 1;
}

void arm2_default_params(arm2_params *params)
{
    static const real length[] = {
        0.45, 0.35
    };
    static const real mass[] = {
        0.9, 0.5
    };
    static const real inertia[] = {
        0.016, 0.006
    };
    static const real center[] = {
        0.4, 0.45
    };
    static const real stiffness[] = {
        120.0, 40.0
    };
    static const real damping[] = {
        0.6, 0.2
    };
    if (params == NULL) {
        return;
    }
    for (int j = 0; j < ARM2_STATIONS; ++j) {
        params->length[j] = length[j];
    }
    for (int j = 0; j < ARM2_STATIONS; ++j) {
        params->mass[j] = mass[j];
    }
    for (int j = 0; j < ARM2_STATIONS; ++j) {
        params->inertia[j] = inertia[j];
    }
    for (int j = 0; j < ARM2_STATIONS; ++j) {
        params->center[j] = center[j];
    }
    for (int j = 0; j < ARM2_STATIONS; ++j) {
        params->stiffness[j] = stiffness[j];
    }
    for (int j = 0; j < ARM2_STATIONS; ++j) {
        params->damping[j] = damping[j];
    }
    params->gravity = 9.81;
    params->hub_inertia = 0.05;
    params->hub_damping = 0.05;
    params->tip_mass = 0.1;
    params->tip_inertia = 0.0002;
}

arm2_status arm2_prepare(
    arm2_model *model,
    const arm2_params *params,
    arm2_real step)
{
    if (model == NULL || params == NULL) {
        return ARM2_NULL_POINTER;
    }
    if (!(step > 0.0) || !(step <= 1.7976931348623157e+308)) {
        return ARM2_INVALID_STEP;
    }
    /* Infinities and NaN less themselves are NaN, all other numbers 0. */
    real lost = (params->gravity - params->gravity) + (params->hub_inertia - params->hub_inertia)
        + (params->hub_damping - params->hub_damping) + (params->tip_mass - params->tip_mass)
        + (params->tip_inertia - params->tip_inertia);
    for (int j = 0; j < ARM2_STATIONS; ++j) {
        lost += (params->length[j] - params->length[j]) + (params->mass[j] - params->mass[j])
            + (params->inertia[j] - params->inertia[j]) + (params->center[j] - params->center[j])
            + (params->stiffness[j] - params->stiffness[j]) + (params->damping[j] - params->damping[j]);
    }
    if (!(lost >= 0.0)) {
        return ARM2_NON_FINITE_INPUT;
    }

    /* Masses by the ends they act at, and joint impedances. */
    for (int j = 0; j < ARM2_STATIONS; ++j) {
        model->carried_mass[j] = params->center[j] * params->mass[j];
        model->inner_mass[j] = params->mass[j] - params->center[j] * params->mass[j];
        model->pin_inertia[j] = params->inertia[j]
            + params->center[j] * params->center[j] * (params->length[j] * params->length[j])
            * params->mass[j];
        model->joint_impedance[j] = 0.5 * params->damping[j] * step
            + 0.25 * (step * step) * params->stiffness[j];
    }

    /* Factors of the step that depend on the time step and parameters alone. */
    model->step2_1_over_2 = 0.5 * (step * step);
    model->angle_per_acceleration = 0.25 * (step * step);
    model->factor_3 = 0.5 * (2.0 * params->hub_inertia + params->hub_damping * step);
    model->rate_per_acceleration = 0.5 * step;

    /* What the step needs as it is. */
    model->step = step;
    for (int j = 0; j < ARM2_STATIONS; ++j) {
        model->length[j] = params->length[j];
    }
    for (int j = 0; j < ARM2_STATIONS; ++j) {
        model->mass[j] = params->mass[j];
    }
    for (int j = 0; j < ARM2_STATIONS; ++j) {
        model->stiffness[j] = params->stiffness[j];
    }
    for (int j = 0; j < ARM2_STATIONS; ++j) {
        model->damping[j] = params->damping[j];
    }
    model->gravity = params->gravity;
    model->hub_inertia = params->hub_inertia;
    model->hub_damping = params->hub_damping;
    model->tip_mass = params->tip_mass;
    model->tip_inertia = params->tip_inertia;

    real total = 0.0; /* of the model: is all of it finite? */
    for (int j = 0; j < ARM2_STATIONS; ++j) {
        total += model->carried_mass[j] + model->inner_mass[j] + model->pin_inertia[j]
            + model->joint_impedance[j];
    }
    if (!isfinite(model->step2_1_over_2 + model->angle_per_acceleration + model->factor_3
        + model->rate_per_acceleration + total)) {
        return ARM2_NON_FINITE_MODEL;
    }
    return ARM2_OK;
}

arm2_status arm2_initialise(
    arm2_state *state,
    const arm2_params *params,
    const arm2_real initial_angle[ARM2_STATIONS],
    const arm2_real initial_rate[ARM2_STATIONS],
    const arm2_inputs *inputs)
{
    if (state == NULL || params == NULL || inputs == NULL) {
        return ARM2_NULL_POINTER;
    }
    if (!inputs_are_finite(inputs)) {
        return ARM2_NON_FINITE_INPUT;
    }
    for (int j = 0; j < ARM2_STATIONS; ++j) {
        if ((initial_angle != NULL && !isfinite(initial_angle[j]))
            || (initial_rate != NULL && !isfinite(initial_rate[j]))) {
            return ARM2_NON_FINITE_INPUT;
        }
    }

    real acceleration_x[ARM2_STATIONS + 1]; /* acceleration of the nodes along x [m/s^2] */
    real acceleration_y[ARM2_STATIONS + 1]; /* acceleration of the nodes along y [m/s^2] */
    real answer_own[ARM2_STATIONS]; /* increment of the unknown if the inner side kept its motion */
    real answer_x[ARM2_STATIONS]; /* answer to the joint's acceleration along x */
    real answer_y[ARM2_STATIONS]; /* answer to the joint's acceleration along y */
    real lever_cosine[ARM2_STATIONS]; /* length times cosine of the predicted angle [m] */
    real lever_sine[ARM2_STATIONS]; /* length times sine of the predicted angle [m] */
    /* acceleration of base and links as predicted [rad/s^2] */
    real predicted_acceleration[ARM2_STATIONS + 1];
    real predicted_angle[ARM2_STATIONS + 1]; /* angle of base and links as predicted [rad] */
    real predicted_rate[ARM2_STATIONS + 1]; /* rate of base and links as predicted [rad/s] */
    real swing_x[ARM2_STATIONS]; /* change of the outer end's acceleration along x per unknown [m] */
    real swing_y[ARM2_STATIONS]; /* change of the outer end's acceleration along y per unknown [m] */
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
    for (int j = 0; j < ARM2_STATIONS; ++j) {
        predicted_angle[j + 1] = (initial_angle != NULL ? initial_angle[j] : 0.0);
        predicted_rate[j + 1] = (initial_rate != NULL ? initial_rate[j] : 0.0);
        predicted_acceleration[j + 1] = 0.0;
        lever_sine[j] = params->length[j] * sin(predicted_angle[j + 1]);
        lever_cosine[j] = params->length[j] * cos(predicted_angle[j + 1]);
        const real square = predicted_rate[j + 1] * predicted_rate[j + 1];
        node_x = node_x - lever_cosine[j] * square - lever_sine[j] * predicted_acceleration[j + 1];
        node_y = node_y + lever_cosine[j] * predicted_acceleration[j + 1] - lever_sine[j] * square;
        acceleration_x[j + 1] = node_x;
        acceleration_y[j + 1] = node_y;
    }

    /* How each link's outer end answers to its unknown, and the predicted joint torques; sweep inward: force
     * beyond each joint as an affine function of the motion at it. */
    real impedance_xx = params->tip_mass;
    real impedance_xy = 0.0;
    real impedance_xu = 0.0;
    real impedance_yx = 0.0;
    real impedance_yy = params->tip_mass;
    real impedance_yu = 0.0;
    real impedance_ux = 0.0;
    real impedance_uy = 0.0;
    real impedance_uu = params->tip_inertia;
    real force_x = acceleration_x[2] * params->tip_mass;
    real force_y = acceleration_y[2] * params->tip_mass;
    real torque = predicted_acceleration[2] * params->tip_inertia;
    for (int j = ARM2_STATIONS - 1; j >= 0; --j) {
        swing_x[j] = -lever_sine[j];
        swing_y[j] = lever_cosine[j];
        const real joint_torque = params->damping[j] * (predicted_rate[j] - predicted_rate[j + 1])
            + params->stiffness[j] * (predicted_angle[j] - predicted_angle[j + 1]);
        const real outer_x = impedance_xu + impedance_xx * swing_x[j] + impedance_xy * swing_y[j];
        const real outer_y = impedance_yu + impedance_yx * swing_x[j] + impedance_yy * swing_y[j];
        const real outer_u = impedance_uu + impedance_ux * swing_x[j] + impedance_uy * swing_y[j];
        const real load_x = force_x + acceleration_x[j] * params->center[j] * params->mass[j];
        const real load_y = force_y + acceleration_y[j] * params->center[j] * params->mass[j];
        const real link_ux = impedance_ux + impedance_yx * lever_cosine[j]
            - lever_sine[j] * (impedance_xx + params->center[j] * params->mass[j]);
        const real link_uy = impedance_uy - impedance_xy * lever_sine[j]
            + lever_cosine[j] * (impedance_yy + params->center[j] * params->mass[j]);
        const real link_uu = params->inertia[j] + outer_u + lever_cosine[j] * outer_y
            - lever_sine[j] * outer_x
            + params->center[j] * params->center[j] * (params->length[j] * params->length[j])
            * params->mass[j];
        const real link_xx = impedance_xx + params->mass[j];
        const real link_xu = outer_x + params->center[j] * params->mass[j] * swing_x[j];
        const real link_yy = impedance_yy + params->mass[j];
        const real link_yu = outer_y + params->center[j] * params->mass[j] * swing_y[j];
        torque = torque + lever_cosine[j] * load_y - lever_sine[j] * load_x
            + predicted_acceleration[j + 1]
            * (params->inertia[j]
            + params->center[j] * params->center[j] * (params->length[j] * params->length[j])
            * params->mass[j]);
        force_x = force_x + acceleration_x[j] * (params->mass[j] - params->center[j] * params->mass[j])
            + acceleration_x[j + 1] * params->center[j] * params->mass[j];
        force_y = force_y + acceleration_y[j] * (params->mass[j] - params->center[j] * params->mass[j])
            + acceleration_y[j + 1] * params->center[j] * params->mass[j];
        if (!(link_uu > 0.0) || !(link_uu <= DBL_MAX)) {
            return ARM2_VANISHING_PIVOT;
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

    /* The hub. */
    const real hub_pivot = params->hub_inertia + impedance_uu;
    if (!(hub_pivot > 0.0) || !(hub_pivot <= DBL_MAX)) {
        return ARM2_VANISHING_PIVOT;
    }
    real unknown = (inputs->hub_torque - torque - params->hub_damping * predicted_rate[0]
        - params->hub_inertia * predicted_acceleration[0]) / hub_pivot;
    const real hub_unknown = unknown;

    /* Sweep outward: the increment of each link's unknown. */
    real change_x = 0.0;
    real change_y = 0.0;

    /* Sweep outward: the increment of each link's unknown; motion at the end of the step. */
    state->hub_angle = predicted_angle[0];
    state->hub_rate = predicted_rate[0];
    state->hub_acceleration = hub_unknown + predicted_acceleration[0];
    for (int j = 0; j < ARM2_STATIONS; ++j) {
        unknown = answer_own[j] - answer_x[j] * change_x - answer_y[j] * change_y;
        change_x = change_x + swing_x[j] * unknown;
        change_y = change_y + swing_y[j] * unknown;
        state->angle[j] = predicted_angle[j + 1];
        state->rate[j] = predicted_rate[j + 1];
        state->acceleration[j] = predicted_acceleration[j + 1] + unknown;
        total += state->angle[j] + state->rate[j] + state->acceleration[j];
    }

    if (!isfinite(total + state->hub_angle + state->hub_rate + state->hub_acceleration)) {
        return ARM2_NON_FINITE_STATE;
    }
    return ARM2_OK;
}

arm2_status arm2_step(
    const arm2_model *model,
    arm2_state *state,
    const arm2_inputs *inputs)
{
    if (model == NULL || state == NULL || inputs == NULL) {
        return ARM2_NULL_POINTER;
    }
    if (!inputs_are_finite(inputs)) {
        return ARM2_NON_FINITE_INPUT;
    }

    const real step = model->step;
    const real step2_1_over_2 = model->step2_1_over_2;
    const real angle_per_acceleration = model->angle_per_acceleration;
    const real rate_per_acceleration = model->rate_per_acceleration;
    real acceleration_x[ARM2_STATIONS + 1]; /* acceleration of the nodes along x [m/s^2] */
    real acceleration_y[ARM2_STATIONS + 1]; /* acceleration of the nodes along y [m/s^2] */
    real answer_from_inner[ARM2_STATIONS]; /* answer to the inner link's unknown */
    real answer_own[ARM2_STATIONS]; /* increment of the unknown if the inner side kept its motion */
    real answer_x[ARM2_STATIONS]; /* answer to the joint's acceleration along x */
    real answer_y[ARM2_STATIONS]; /* answer to the joint's acceleration along y */
    real lever_cosine[ARM2_STATIONS]; /* length times cosine of the predicted angle [m] */
    real lever_sine[ARM2_STATIONS]; /* length times sine of the predicted angle [m] */
    /* acceleration of base and links as predicted [rad/s^2] */
    real predicted_acceleration[ARM2_STATIONS + 1];
    real predicted_angle[ARM2_STATIONS + 1]; /* angle of base and links as predicted [rad] */
    real predicted_rate[ARM2_STATIONS + 1]; /* rate of base and links as predicted [rad/s] */
    real swing_x[ARM2_STATIONS]; /* change of the outer end's acceleration along x per unknown [m] */
    real swing_y[ARM2_STATIONS]; /* change of the outer end's acceleration along y per unknown [m] */
    real total = 0.0; /* of the new motion: is all of it finite? */

    /* Predicted motion. */
    predicted_angle[0] = state->hub_angle + state->hub_acceleration * step2_1_over_2 + state->hub_rate * step;
    predicted_rate[0] = state->hub_rate + state->hub_acceleration * step;
    predicted_acceleration[0] = state->hub_acceleration;

    /* Predicted motion; accelerations of the nodes, seen from a falling frame: gravity is the base's own. */
    real node_x = 0.0;
    real node_y = model->gravity;
    acceleration_x[0] = node_x;
    acceleration_y[0] = model->gravity;
    for (int j = 0; j < ARM2_STATIONS; ++j) {
        predicted_angle[j + 1] = state->angle[j] + state->acceleration[j] * step2_1_over_2
            + state->rate[j] * step;
        predicted_rate[j + 1] = state->rate[j] + state->acceleration[j] * step;
        predicted_acceleration[j + 1] = state->acceleration[j];
        lever_sine[j] = model->length[j] * sin(predicted_angle[j + 1]);
        lever_cosine[j] = model->length[j] * cos(predicted_angle[j + 1]);
        const real square = predicted_rate[j + 1] * predicted_rate[j + 1];
        node_x = node_x - lever_cosine[j] * square - lever_sine[j] * predicted_acceleration[j + 1];
        node_y = node_y + lever_cosine[j] * predicted_acceleration[j + 1] - lever_sine[j] * square;
        acceleration_x[j + 1] = node_x;
        acceleration_y[j + 1] = node_y;
    }

    /* How each link's outer end answers to its unknown, and the predicted joint torques; sweep inward: force
     * beyond each joint as an affine function of the motion at it. */
    real impedance_xx = model->tip_mass;
    real impedance_xy = 0.0;
    real impedance_xu = 0.0;
    real impedance_yx = 0.0;
    real impedance_yy = model->tip_mass;
    real impedance_yu = 0.0;
    real impedance_ux = 0.0;
    real impedance_uy = 0.0;
    real impedance_uu = model->tip_inertia;
    real force_x = acceleration_x[2] * model->tip_mass;
    real force_y = acceleration_y[2] * model->tip_mass;
    real torque = predicted_acceleration[2] * model->tip_inertia;
    for (int j = ARM2_STATIONS - 1; j >= 0; --j) {
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
        const real load_x = force_x + acceleration_x[j] * model->carried_mass[j];
        const real load_y = force_y + acceleration_y[j] * model->carried_mass[j];
        const real link_ux = impedance_ux + impedance_yx * lever_cosine[j]
            - lever_sine[j] * (model->carried_mass[j] + impedance_xx);
        const real link_uy = impedance_uy - impedance_xy * lever_sine[j]
            + lever_cosine[j] * (model->carried_mass[j] + impedance_yy);
        const real link_uu = outer_u + model->pin_inertia[j]
            + angle_per_acceleration * (-lever_cosine[j] * load_x - lever_sine[j] * load_y)
            + lever_cosine[j] * outer_y - lever_sine[j] * outer_x;
        const real link_xx = impedance_xx + model->mass[j];
        const real link_xu = outer_x + model->carried_mass[j] * swing_x[j];
        const real link_yy = impedance_yy + model->mass[j];
        const real link_yu = outer_y + model->carried_mass[j] * swing_y[j];
        torque = torque + lever_cosine[j] * load_y - lever_sine[j] * load_x
            + model->pin_inertia[j] * predicted_acceleration[j + 1];
        force_x = force_x + acceleration_x[j + 1] * model->carried_mass[j]
            + acceleration_x[j] * model->inner_mass[j];
        force_y = force_y + acceleration_y[j + 1] * model->carried_mass[j]
            + acceleration_y[j] * model->inner_mass[j];
        const real pivot = model->joint_impedance[j] + link_uu;
        if (!(pivot > 0.0) || !(pivot <= DBL_MAX)) {
            return ARM2_VANISHING_PIVOT;
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

    /* The hub. */
    const real hub_pivot = model->factor_3 + impedance_uu;
    if (!(hub_pivot > 0.0) || !(hub_pivot <= DBL_MAX)) {
        return ARM2_VANISHING_PIVOT;
    }
    real unknown = (inputs->hub_torque - torque - model->hub_damping * predicted_rate[0]
        - model->hub_inertia * predicted_acceleration[0]) / hub_pivot;
    const real hub_unknown = unknown;

    /* Sweep outward: the increment of each link's unknown. */
    real change_x = 0.0;
    real change_y = 0.0;

    /* Sweep outward: the increment of each link's unknown; motion at the end of the step. */
    state->hub_angle = predicted_angle[0] + angle_per_acceleration * hub_unknown;
    state->hub_rate = predicted_rate[0] + hub_unknown * rate_per_acceleration;
    state->hub_acceleration = hub_unknown + predicted_acceleration[0];
    for (int j = 0; j < ARM2_STATIONS; ++j) {
        unknown = answer_own[j] + answer_from_inner[j] * unknown - answer_x[j] * change_x
            - answer_y[j] * change_y;
        change_x = change_x + swing_x[j] * unknown;
        change_y = change_y + swing_y[j] * unknown;
        state->angle[j] = predicted_angle[j + 1] + angle_per_acceleration * unknown;
        state->rate[j] = predicted_rate[j + 1] + rate_per_acceleration * unknown;
        state->acceleration[j] = predicted_acceleration[j + 1] + unknown;
        total += state->angle[j] + state->rate[j] + state->acceleration[j];
    }

    if (!isfinite(total + state->hub_angle + state->hub_rate + state->hub_acceleration)) {
        return ARM2_NON_FINITE_STATE;
    }
    return ARM2_OK;
}

void arm2_output(
    const arm2_model *model,
    const arm2_state *state,
    arm2_outputs *outputs)
{
    if (model == NULL || state == NULL || outputs == NULL) {
        return;
    }
    /* Tip: position. */
    outputs->tip_x = 0.0;
    outputs->tip_y = 0.0;
    for (int j = 0; j < ARM2_STATIONS; ++j) {
        outputs->tip_x = outputs->tip_x + model->length[j] * cos(state->angle[j]);
        outputs->tip_y = outputs->tip_y + model->length[j] * sin(state->angle[j]);
    }

    /* Hub: angle. */
    outputs->hub = state->hub_angle;

    /* Elbow: torque. */
    outputs->elbow = model->damping[1] * (state->rate[1] - state->rate[0])
        + model->stiffness[1] * (state->angle[1] - state->angle[0]);
}
