/**
 * cube: Satellite with two flexible panels
 *
 * Written by tmm-gen 0.2.0. Do not edit: change the scene and run `tmm-gen build`.
 * scene digest: f046f23ff154c77eb0de6f429bf04f6275910b87af75eea62b4aa0e7be8a3583
 * sha256 of the rest of this file: 324f9b3bd779afa7e29833ca92c1a3cc151d00f0265dbc3c577f4177d3554c92
 *
 * model: planar arm, large rotations
 * stations: 12
 * base: free
 * integrator: Newmark 1959, beta = 0.25, gamma = 0.5
 * linearisation: newton
 * sweep: riccati
 * unknown: acceleration
 * joints in arrays, from 0: left_latch 0, right_latch 6
 * links in arrays, from 0: left_yoke 0, left_panel 1 to 5, right_yoke 6, right_panel 7 to 11
 * operations of a step: 1462, 121.8 per station (686 additions, 734 multiplications, 18 divisions, 24 sines
 *     and cosines)
 * operations of prepare: 201, 16.75 per station (62 additions, 139 multiplications)
 * number type: double
 * bytes of the structs: params 600, model 720, state 360, inputs 16, outputs 48
 *
 * @file cube.c
 */
#if defined(__FAST_MATH__) || defined(__ASSOCIATIVE_MATH__) || defined(_M_FP_FAST) \
    || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "-Ofast and -ffast-math remove checks of this file: use -O3, or put -fno-fast-math behind them"
#endif

#include <float.h>
#include <math.h>
#include <stddef.h>

/* Members of the header below: no macro of a header above may have their names. */
#undef wheel
#undef thruster
#undef attitude
#undef hub_x
#undef hub_y
#undef right_end_x
#undef right_end_y
#undef latch_torque

#include "cube.h"

typedef cube_real real;

static int inputs_are_finite(const cube_inputs *inputs)
{
    if (!isfinite(inputs->wheel) || !isfinite(inputs->thruster)) {
        return 0;
    }
    return 1;
}

void cube_default_params(cube_params *params)
{
    static const real length[] = {
        0.15, 0.2, 0.2, 0.2, 0.2, 0.1, 0.15, 0.2, 0.2, 0.2, 0.2, 0.1
    };
    static const real mass[] = {
        0.12, 0.28, 0.28, 0.28, 0.28, 0.14, 0.12, 0.28, 0.28, 0.28, 0.28, 0.14
    };
    static const real inertia[] = {
        0.000225, 0.0009333333333333333, 0.0009333333333333333, 0.0009333333333333333, 0.0009333333333333333,
        0.00011666666666666667, 0.000225, 0.0009333333333333333, 0.0009333333333333333, 0.0009333333333333333,
        0.0009333333333333333, 0.00011666666666666667
    };
    static const real stiffness[] = {
        60.0, 90.0, 45.0, 45.0, 45.0, 45.0, 60.0, 90.0, 45.0, 45.0, 45.0, 45.0
    };
    static const real damping[] = {
        0.02, 0.09, 0.045, 0.045, 0.045, 0.045, 0.02, 0.09, 0.045, 0.045, 0.045, 0.045
    };
    static const real rest[] = {
        3.141592653589793, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    };
    if (params == NULL) {
        return;
    }
    for (int j = 0; j < CUBE_STATIONS; ++j) {
        params->length[j] = length[j];
    }
    for (int j = 0; j < CUBE_STATIONS; ++j) {
        params->mass[j] = mass[j];
    }
    for (int j = 0; j < CUBE_STATIONS; ++j) {
        params->inertia[j] = inertia[j];
    }
    params->center = 0.5;
    for (int j = 0; j < CUBE_STATIONS; ++j) {
        params->stiffness[j] = stiffness[j];
    }
    for (int j = 0; j < CUBE_STATIONS; ++j) {
        params->damping[j] = damping[j];
    }
    for (int j = 0; j < CUBE_STATIONS; ++j) {
        params->rest[j] = rest[j];
    }
    params->hub_inertia = 0.12;
    params->hub_mass = 14.0;
}

cube_status cube_prepare(
    cube_model *model,
    const cube_params *params,
    cube_real step)
{
    if (model == NULL || params == NULL) {
        return CUBE_NULL_POINTER;
    }
    if (!(step > 0.0) || !(step <= DBL_MAX)) {
        return CUBE_INVALID_STEP;
    }
    /* Infinities and NaN less themselves are NaN, all other numbers 0. */
    real lost = (params->center - params->center) + (params->hub_inertia - params->hub_inertia)
        + (params->hub_mass - params->hub_mass);
    for (int j = 0; j < CUBE_STATIONS; ++j) {
        lost += (params->length[j] - params->length[j]) + (params->mass[j] - params->mass[j])
            + (params->inertia[j] - params->inertia[j]) + (params->stiffness[j] - params->stiffness[j])
            + (params->damping[j] - params->damping[j]) + (params->rest[j] - params->rest[j]);
    }
    if (!(lost >= 0.0)) {
        return CUBE_NON_FINITE_INPUT;
    }

    const real center = params->center;

    /* Masses at the nodes between links, and what they leave over. */
    for (int j = 0; j < 11; ++j) {
        model->node_mass[j] = center * params->mass[j] + params->mass[j + 1] * (1.0 - center);
    }
    model->node_mass[5] = center * params->mass[5];
    model->node_mass[11] = center * params->mass[11];
    for (int j = 0; j < CUBE_STATIONS; ++j) {
        model->rod_inertia[j] = params->inertia[j]
            - center * (params->length[j] * params->length[j]) * params->mass[j] * (1.0 - center);
    }
    model->base_mass = params->hub_mass + params->mass[0] * (1.0 - center) + params->mass[6] * (1.0 - center);

    /* Factors of the sweep that do not change from step to step. */
    for (int j = CUBE_STATIONS - 1; j >= 0; --j) {
        model->joint_impedance[j] = 0.5 * params->damping[j] * step
            + 0.25 * (step * step) * params->stiffness[j];
    }

    /* Factors of the step that depend on the time step and parameters alone. */
    model->half_step_squared = 0.5 * (step * step);
    model->angle_per_acceleration = 0.25 * (step * step);
    model->rate_per_acceleration = 0.5 * step;

    /* What the step needs as it is. */
    model->step = step;
    for (int j = 0; j < CUBE_STATIONS; ++j) {
        model->length[j] = params->length[j];
    }
    for (int j = 0; j < CUBE_STATIONS; ++j) {
        model->stiffness[j] = params->stiffness[j];
    }
    for (int j = 0; j < CUBE_STATIONS; ++j) {
        model->damping[j] = params->damping[j];
    }
    for (int j = 0; j < CUBE_STATIONS; ++j) {
        model->rest[j] = params->rest[j];
    }
    model->hub_inertia = params->hub_inertia;

    real total = 0.0; /* of the model: is all of it finite? */
    for (int j = 0; j < CUBE_STATIONS; ++j) {
        total += model->node_mass[j] + model->rod_inertia[j] + model->joint_impedance[j];
    }
    if (!isfinite(model->half_step_squared + model->angle_per_acceleration + model->rate_per_acceleration
        + model->base_mass + total)) {
        return CUBE_NON_FINITE_MODEL;
    }
    return CUBE_OK;
}

/* The scene's angles to start from [rad]. */
static const real scene_initial_angle[CUBE_STATIONS] = {
    3.141592653589793, 3.141592653589793, 3.141592653589793, 3.141592653589793, 3.141592653589793,
    3.141592653589793, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
};

cube_status cube_initialise(
    cube_state *state,
    const cube_params *params,
    const cube_real initial_angle[CUBE_STATIONS],
    const cube_real initial_rate[CUBE_STATIONS],
    const cube_inputs *inputs)
{
    if (state == NULL || params == NULL || inputs == NULL) {
        return CUBE_NULL_POINTER;
    }
    if (!inputs_are_finite(inputs)) {
        return CUBE_NON_FINITE_INPUT;
    }
    for (int j = 0; j < CUBE_STATIONS; ++j) {
        if ((initial_angle != NULL && !isfinite(initial_angle[j]))
            || (initial_rate != NULL && !isfinite(initial_rate[j]))) {
            return CUBE_NON_FINITE_INPUT;
        }
    }

    const real center = params->center;
    real acceleration_x[CUBE_STATIONS + 1]; /* acceleration of the nodes along x [m/s^2] */
    real acceleration_y[CUBE_STATIONS + 1]; /* acceleration of the nodes along y [m/s^2] */
    real answer_own[CUBE_STATIONS]; /* unknown of a station if its inner side kept its motion */
    real answer_x[CUBE_STATIONS]; /* answer of the unknown to the joint's acceleration along x */
    real answer_y[CUBE_STATIONS]; /* answer of the unknown to the joint's acceleration along y */
    real lever_cosine[CUBE_STATIONS]; /* length times cosine of the angle [m] */
    real lever_sine[CUBE_STATIONS]; /* length times sine of the angle [m] */
    /* acceleration of base and links as predicted [rad/s^2] */
    real predicted_acceleration[CUBE_STATIONS + 1];
    real predicted_angle[CUBE_STATIONS + 1]; /* angle of base and links as predicted [rad] */
    real predicted_rate[CUBE_STATIONS + 1]; /* rate of base and links as predicted [rad/s] */
    real solved[CUBE_STATIONS]; /* unknown of each station */
    real start_node_mass[CUBE_STATIONS]; /* mass at the outer end of each link [kg] */
    real start_rod_inertia[CUBE_STATIONS]; /* inertia of a link that masses at its ends leave over [kg m^2] */
    real total = 0.0; /* of the new motion: is all of it finite? */

    /* Masses at the nodes between links, and what they leave over. */
    for (int j = 0; j < 11; ++j) {
        start_node_mass[j] = center * params->mass[j] + params->mass[j + 1] * (1.0 - center);
    }
    start_node_mass[5] = center * params->mass[5];
    start_node_mass[11] = center * params->mass[11];
    const real start_base_mass = params->hub_mass + params->mass[0] * (1.0 - center)
        + params->mass[6] * (1.0 - center);

    /* What is the same at every station. */
    if (!(params->hub_inertia > 0.0) || !(params->hub_inertia <= DBL_MAX)) {
        return CUBE_VANISHING_PIVOT;
    }

    /* Masses at the nodes between links, and what they leave over; predicted motion. */
    real trial_acceleration_x = 0.0;
    real trial_acceleration_y = 0.0;
    predicted_rate[0] = 0.0;
    predicted_angle[0] = 0.0;
    predicted_acceleration[0] = 0.0;
    for (int j = 0; j < CUBE_STATIONS; ++j) {
        start_rod_inertia[j] = params->inertia[j]
            - center * (params->length[j] * params->length[j]) * params->mass[j] * (1.0 - center);
        predicted_rate[j + 1] = (initial_rate != NULL ? initial_rate[j] : 0.0);
        predicted_angle[j + 1] = (initial_angle != NULL ? initial_angle[j] : scene_initial_angle[j]);
        predicted_acceleration[j + 1] = 0.0;
    }

    /* Accelerations of the nodes. */
    real node_x = trial_acceleration_x;
    real node_y = trial_acceleration_y;
    acceleration_x[0] = trial_acceleration_x;
    acceleration_y[0] = trial_acceleration_y;
    for (int j = 0; j < 6; ++j) {
        lever_cosine[j] = params->length[j] * cos(predicted_angle[j + 1]);
        lever_sine[j] = params->length[j] * sin(predicted_angle[j + 1]);
        const real square = predicted_rate[j + 1] * predicted_rate[j + 1];
        const real relative_x = -lever_cosine[j] * square - lever_sine[j] * predicted_acceleration[j + 1];
        const real relative_y = lever_cosine[j] * predicted_acceleration[j + 1] - lever_sine[j] * square;
        node_x = node_x + relative_x;
        node_y = node_y + relative_y;
        acceleration_x[j + 1] = node_x;
        acceleration_y[j + 1] = node_y;
    }
    node_x = acceleration_x[0];
    node_y = acceleration_y[0];
    for (int j = 6; j < CUBE_STATIONS; ++j) {
        lever_cosine[j] = params->length[j] * cos(predicted_angle[j + 1]);
        lever_sine[j] = params->length[j] * sin(predicted_angle[j + 1]);
        const real square = predicted_rate[j + 1] * predicted_rate[j + 1];
        const real relative_x = -lever_cosine[j] * square - lever_sine[j] * predicted_acceleration[j + 1];
        const real relative_y = lever_cosine[j] * predicted_acceleration[j + 1] - lever_sine[j] * square;
        node_x = node_x + relative_x;
        node_y = node_y + relative_y;
        acceleration_x[j + 1] = node_x;
        acceleration_y[j + 1] = node_y;
    }

    /* Forces of the joints at the motion so far; sweep inward: force beyond each joint as an affine function
     * of the motion at it. */
    real impedance_xx = 0.0;
    real impedance_xy = 0.0;
    real impedance_yx = 0.0;
    real impedance_yy = 0.0;
    real force_x = 0.0;
    real force_y = 0.0;
    real torque = 0.0;
    for (int j = CUBE_STATIONS - 1; j >= 7; --j) {
        const real joint_torque = params->damping[j] * (predicted_rate[j] - predicted_rate[j + 1])
            + params->stiffness[j] * (predicted_angle[j] - predicted_angle[j + 1]);
        impedance_xx = impedance_xx + start_node_mass[j];
        force_x = force_x + acceleration_x[j + 1] * start_node_mass[j];
        impedance_yy = impedance_yy + start_node_mass[j];
        force_y = force_y + acceleration_y[j + 1] * start_node_mass[j];
        const real impedance_xu = impedance_xy * lever_cosine[j] - impedance_xx * lever_sine[j];
        const real impedance_yu = impedance_yy * lever_cosine[j] - impedance_yx * lever_sine[j];
        const real impedance_ux = impedance_yx * lever_cosine[j] - impedance_xx * lever_sine[j];
        const real impedance_uy = impedance_yy * lever_cosine[j] - impedance_xy * lever_sine[j];
        const real impedance_uu = start_rod_inertia[j] - impedance_xu * lever_sine[j]
            + impedance_yu * lever_cosine[j];
        torque = torque - force_x * lever_sine[j] + force_y * lever_cosine[j]
            + predicted_acceleration[j + 1] * start_rod_inertia[j];
        if (!(impedance_uu > 0.0) || !(impedance_uu <= DBL_MAX)) {
            return CUBE_VANISHING_PIVOT;
        }
        const real admittance = 1.0 / impedance_uu;
        answer_own[j] = admittance * (joint_torque - torque);
        answer_x[j] = admittance * impedance_ux;
        answer_y[j] = admittance * impedance_uy;
        impedance_xx = impedance_xx - answer_x[j] * impedance_xu;
        impedance_xy = impedance_xy - answer_y[j] * impedance_xu;
        force_x = force_x + answer_own[j] * impedance_xu;
        impedance_yx = impedance_yx - answer_x[j] * impedance_yu;
        impedance_yy = impedance_yy - answer_y[j] * impedance_yu;
        force_y = force_y + answer_own[j] * impedance_yu;
        torque = joint_torque;
    }
    for (int j = 6; j >= 6; --j) {
        const real joint_torque = params->damping[j] * (predicted_rate[0] - predicted_rate[j + 1])
            + params->stiffness[j] * (predicted_angle[0] - predicted_angle[j + 1]);
        impedance_xx = impedance_xx + start_node_mass[j];
        force_x = force_x + acceleration_x[j + 1] * start_node_mass[j];
        impedance_yy = impedance_yy + start_node_mass[j];
        force_y = force_y + acceleration_y[j + 1] * start_node_mass[j];
        const real impedance_xu = impedance_xy * lever_cosine[j] - impedance_xx * lever_sine[j];
        const real impedance_yu = impedance_yy * lever_cosine[j] - impedance_yx * lever_sine[j];
        const real impedance_ux = impedance_yx * lever_cosine[j] - impedance_xx * lever_sine[j];
        const real impedance_uy = impedance_yy * lever_cosine[j] - impedance_xy * lever_sine[j];
        const real impedance_uu = start_rod_inertia[j] - impedance_xu * lever_sine[j]
            + impedance_yu * lever_cosine[j];
        torque = torque - force_x * lever_sine[j] + force_y * lever_cosine[j]
            + predicted_acceleration[j + 1] * start_rod_inertia[j];
        if (!(impedance_uu > 0.0) || !(impedance_uu <= DBL_MAX)) {
            return CUBE_VANISHING_PIVOT;
        }
        const real admittance = 1.0 / impedance_uu;
        answer_own[j] = admittance * (joint_torque - torque);
        answer_x[j] = admittance * impedance_ux;
        answer_y[j] = admittance * impedance_uy;
        impedance_xx = impedance_xx - answer_x[j] * impedance_xu;
        impedance_xy = impedance_xy - answer_y[j] * impedance_xu;
        force_x = force_x + answer_own[j] * impedance_xu;
        impedance_yx = impedance_yx - answer_x[j] * impedance_yu;
        impedance_yy = impedance_yy - answer_y[j] * impedance_yu;
        force_y = force_y + answer_own[j] * impedance_yu;
        torque = joint_torque;
    }
    const real impedance_xx_of_branch_7 = impedance_xx;
    const real impedance_xy_of_branch_7 = impedance_xy;
    const real impedance_yx_of_branch_7 = impedance_yx;
    const real impedance_yy_of_branch_7 = impedance_yy;
    const real force_x_of_branch_7 = force_x;
    const real force_y_of_branch_7 = force_y;
    const real torque_of_branch_7 = torque;
    impedance_xx = 0.0;
    impedance_xy = 0.0;
    impedance_yx = 0.0;
    impedance_yy = 0.0;
    force_x = 0.0;
    force_y = 0.0;
    torque = 0.0;
    for (int j = 5; j >= 1; --j) {
        const real joint_torque = params->damping[j] * (predicted_rate[j] - predicted_rate[j + 1])
            + params->stiffness[j] * (predicted_angle[j] - predicted_angle[j + 1]);
        impedance_xx = impedance_xx + start_node_mass[j];
        force_x = force_x + acceleration_x[j + 1] * start_node_mass[j];
        impedance_yy = impedance_yy + start_node_mass[j];
        force_y = force_y + acceleration_y[j + 1] * start_node_mass[j];
        const real impedance_xu = impedance_xy * lever_cosine[j] - impedance_xx * lever_sine[j];
        const real impedance_yu = impedance_yy * lever_cosine[j] - impedance_yx * lever_sine[j];
        const real impedance_ux = impedance_yx * lever_cosine[j] - impedance_xx * lever_sine[j];
        const real impedance_uy = impedance_yy * lever_cosine[j] - impedance_xy * lever_sine[j];
        const real impedance_uu = start_rod_inertia[j] - impedance_xu * lever_sine[j]
            + impedance_yu * lever_cosine[j];
        torque = torque - force_x * lever_sine[j] + force_y * lever_cosine[j]
            + predicted_acceleration[j + 1] * start_rod_inertia[j];
        if (!(impedance_uu > 0.0) || !(impedance_uu <= DBL_MAX)) {
            return CUBE_VANISHING_PIVOT;
        }
        const real admittance = 1.0 / impedance_uu;
        answer_own[j] = admittance * (joint_torque - torque);
        answer_x[j] = admittance * impedance_ux;
        answer_y[j] = admittance * impedance_uy;
        impedance_xx = impedance_xx - answer_x[j] * impedance_xu;
        impedance_xy = impedance_xy - answer_y[j] * impedance_xu;
        force_x = force_x + answer_own[j] * impedance_xu;
        impedance_yx = impedance_yx - answer_x[j] * impedance_yu;
        impedance_yy = impedance_yy - answer_y[j] * impedance_yu;
        force_y = force_y + answer_own[j] * impedance_yu;
        torque = joint_torque;
    }
    for (int j = 0; j >= 0; --j) {
        const real joint_torque = params->damping[j] * (predicted_rate[j] - predicted_rate[j + 1])
            + params->rest[j] * params->stiffness[j]
            + params->stiffness[j] * (predicted_angle[j] - predicted_angle[j + 1]);
        impedance_xx = impedance_xx + start_node_mass[j];
        force_x = force_x + acceleration_x[j + 1] * start_node_mass[j];
        impedance_yy = impedance_yy + start_node_mass[j];
        force_y = force_y + acceleration_y[j + 1] * start_node_mass[j];
        const real impedance_xu = impedance_xy * lever_cosine[j] - impedance_xx * lever_sine[j];
        const real impedance_yu = impedance_yy * lever_cosine[j] - impedance_yx * lever_sine[j];
        const real impedance_ux = impedance_yx * lever_cosine[j] - impedance_xx * lever_sine[j];
        const real impedance_uy = impedance_yy * lever_cosine[j] - impedance_xy * lever_sine[j];
        const real impedance_uu = start_rod_inertia[j] - impedance_xu * lever_sine[j]
            + impedance_yu * lever_cosine[j];
        torque = torque - force_x * lever_sine[j] + force_y * lever_cosine[j]
            + predicted_acceleration[j + 1] * start_rod_inertia[j];
        if (!(impedance_uu > 0.0) || !(impedance_uu <= DBL_MAX)) {
            return CUBE_VANISHING_PIVOT;
        }
        const real admittance = 1.0 / impedance_uu;
        answer_own[j] = admittance * (joint_torque - torque);
        answer_x[j] = admittance * impedance_ux;
        answer_y[j] = admittance * impedance_uy;
        impedance_xx = impedance_xx - answer_x[j] * impedance_xu;
        impedance_xy = impedance_xy - answer_y[j] * impedance_xu;
        force_x = force_x + answer_own[j] * impedance_xu;
        impedance_yx = impedance_yx - answer_x[j] * impedance_yu;
        impedance_yy = impedance_yy - answer_y[j] * impedance_yu;
        force_y = force_y + answer_own[j] * impedance_yu;
        torque = joint_torque;
    }
    impedance_xx = impedance_xx + impedance_xx_of_branch_7;
    impedance_xy = impedance_xy + impedance_xy_of_branch_7;
    impedance_yx = impedance_yx + impedance_yx_of_branch_7;
    impedance_yy = impedance_yy + impedance_yy_of_branch_7;
    force_x = force_x + force_x_of_branch_7;
    force_y = force_y + force_y_of_branch_7;
    torque = torque + torque_of_branch_7;

    /* The base. */
    const real whole_impedance_xx = impedance_xx + start_base_mass;
    const real whole_impedance_yy = impedance_yy + start_base_mass;
    if (!(whole_impedance_xx > 0.0) || !(whole_impedance_xx <= DBL_MAX)) {
        return CUBE_VANISHING_PIVOT;
    }
    const real share_yx = impedance_yx / whole_impedance_xx;
    const real impedance_yy_freed_x = whole_impedance_yy - impedance_xy * share_yx;
    if (!(impedance_yy_freed_x > 0.0) || !(impedance_yy_freed_x <= DBL_MAX)) {
        return CUBE_VANISHING_PIVOT;
    }
    const real whole_force_x = force_x + acceleration_x[0] * start_base_mass;
    const real whole_force_y = force_y - inputs->thruster + acceleration_y[0] * start_base_mass;
    const real whole_torque = torque - inputs->wheel + params->hub_inertia * predicted_acceleration[0];
    const real force_y_freed_x = whole_force_y - share_yx * whole_force_x;
    real unknown = -whole_torque / params->hub_inertia;
    real change_y = -force_y_freed_x / impedance_yy_freed_x;
    real change_x = (-whole_force_x - change_y * impedance_xy) / whole_impedance_xx;
    const real base_change_x = change_x;
    const real base_change_y = change_y;
    const real hub_unknown = unknown;

    /* Sweep outward: the unknown of each station. */
    change_x = base_change_x;
    change_y = base_change_y;
    for (int j = 0; j < 6; ++j) {
        unknown = answer_own[j] - answer_x[j] * change_x - answer_y[j] * change_y;
        change_x = change_x - lever_sine[j] * unknown;
        change_y = change_y + lever_cosine[j] * unknown;
        solved[j] = unknown;
    }
    change_x = base_change_x;
    change_y = base_change_y;
    for (int j = 6; j < CUBE_STATIONS; ++j) {
        unknown = answer_own[j] - answer_x[j] * change_x - answer_y[j] * change_y;
        change_x = change_x - lever_sine[j] * unknown;
        change_y = change_y + lever_cosine[j] * unknown;
        solved[j] = unknown;
    }

    /* Motion at the end of the step. */
    trial_acceleration_x = base_change_x + trial_acceleration_x;
    trial_acceleration_y = base_change_y + trial_acceleration_y;
    state->hub_angle = predicted_angle[0];
    state->hub_rate = predicted_rate[0];
    state->hub_acceleration = hub_unknown + predicted_acceleration[0];
    state->base_place_x = 0.0;
    state->base_velocity_x = 0.0;
    state->base_acceleration_x = trial_acceleration_x;
    state->base_place_y = 0.0;
    state->base_velocity_y = 0.0;
    state->base_acceleration_y = trial_acceleration_y;
    for (int j = 0; j < CUBE_STATIONS; ++j) {
        state->angle[j] = predicted_angle[j + 1];
        state->rate[j] = predicted_rate[j + 1];
        state->acceleration[j] = predicted_acceleration[j + 1] + solved[j];
        total += state->angle[j] + state->rate[j] + state->acceleration[j];
    }

    if (!isfinite(total + state->hub_angle + state->hub_rate + state->hub_acceleration + state->base_place_x
        + state->base_velocity_x + state->base_acceleration_x + state->base_place_y + state->base_velocity_y
        + state->base_acceleration_y)) {
        return CUBE_NON_FINITE_STATE;
    }
    return CUBE_OK;
}

cube_status cube_step(
    const cube_model *model,
    cube_state *state,
    const cube_inputs *inputs)
{
    if (model == NULL || state == NULL || inputs == NULL) {
        return CUBE_NULL_POINTER;
    }
    if (!inputs_are_finite(inputs)) {
        return CUBE_NON_FINITE_INPUT;
    }

    const real step = model->step;
    const real half_step_squared = model->half_step_squared;
    const real angle_per_acceleration = model->angle_per_acceleration;
    const real rate_per_acceleration = model->rate_per_acceleration;
    real acceleration_x[CUBE_STATIONS + 1]; /* acceleration of the nodes along x [m/s^2] */
    real acceleration_y[CUBE_STATIONS + 1]; /* acceleration of the nodes along y [m/s^2] */
    real answer_own[CUBE_STATIONS]; /* unknown of a station if its inner side kept its motion */
    real answer_x[CUBE_STATIONS]; /* answer of the unknown to the joint's acceleration along x */
    real answer_y[CUBE_STATIONS]; /* answer of the unknown to the joint's acceleration along y */
    real lever_cosine[CUBE_STATIONS]; /* length times cosine of the angle [m] */
    real lever_sine[CUBE_STATIONS]; /* length times sine of the angle [m] */
    real predicted_angle[CUBE_STATIONS + 1]; /* angle of base and links as predicted [rad] */
    real predicted_rate[CUBE_STATIONS + 1]; /* rate of base and links as predicted [rad/s] */
    real solved[CUBE_STATIONS]; /* unknown of each station */
    real swing_x[CUBE_STATIONS]; /* change of the outer end's acceleration along x per unknown [m] */
    real swing_y[CUBE_STATIONS]; /* change of the outer end's acceleration along y per unknown [m] */
    real transmission[CUBE_STATIONS]; /* share of motion and torque each joint passes on */
    real total = 0.0; /* of the new motion: is all of it finite? */

    /* Predicted motion. */
    real trial_acceleration_x = state->base_acceleration_x;
    real trial_acceleration_y = state->base_acceleration_y;
    predicted_rate[0] = state->hub_rate + state->hub_acceleration * step;
    predicted_angle[0] = state->hub_angle + half_step_squared * state->hub_acceleration
        + state->hub_rate * step;
    for (int j = 0; j < CUBE_STATIONS; ++j) {
        predicted_rate[j + 1] = state->rate[j] + state->acceleration[j] * step;
        predicted_angle[j + 1] = state->angle[j] + state->acceleration[j] * half_step_squared
            + state->rate[j] * step;
    }

    /* Accelerations of the nodes. */
    real node_x = trial_acceleration_x;
    real node_y = trial_acceleration_y;
    acceleration_x[0] = trial_acceleration_x;
    acceleration_y[0] = trial_acceleration_y;
    for (int j = 0; j < 6; ++j) {
        lever_cosine[j] = model->length[j] * cos(predicted_angle[j + 1]);
        lever_sine[j] = model->length[j] * sin(predicted_angle[j + 1]);
        const real square = predicted_rate[j + 1] * predicted_rate[j + 1];
        const real relative_x = -state->acceleration[j] * lever_sine[j] - lever_cosine[j] * square;
        const real relative_y = state->acceleration[j] * lever_cosine[j] - lever_sine[j] * square;
        const real turning = predicted_rate[j + 1] * step;
        swing_x[j] = -lever_sine[j] - angle_per_acceleration * relative_y - lever_cosine[j] * turning;
        swing_y[j] = lever_cosine[j] + angle_per_acceleration * relative_x - lever_sine[j] * turning;
        node_x = node_x + relative_x;
        node_y = node_y + relative_y;
        acceleration_x[j + 1] = node_x;
        acceleration_y[j + 1] = node_y;
    }
    node_x = acceleration_x[0];
    node_y = acceleration_y[0];
    for (int j = 6; j < CUBE_STATIONS; ++j) {
        lever_cosine[j] = model->length[j] * cos(predicted_angle[j + 1]);
        lever_sine[j] = model->length[j] * sin(predicted_angle[j + 1]);
        const real square = predicted_rate[j + 1] * predicted_rate[j + 1];
        const real relative_x = -state->acceleration[j] * lever_sine[j] - lever_cosine[j] * square;
        const real relative_y = state->acceleration[j] * lever_cosine[j] - lever_sine[j] * square;
        const real turning = predicted_rate[j + 1] * step;
        swing_x[j] = -lever_sine[j] - angle_per_acceleration * relative_y - lever_cosine[j] * turning;
        swing_y[j] = lever_cosine[j] + angle_per_acceleration * relative_x - lever_sine[j] * turning;
        node_x = node_x + relative_x;
        node_y = node_y + relative_y;
        acceleration_x[j + 1] = node_x;
        acceleration_y[j + 1] = node_y;
    }

    /* Forces of the joints at the motion so far; sweep inward: force beyond each joint as an affine function
     * of the motion at it. */
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
    for (int j = CUBE_STATIONS - 1; j >= 7; --j) {
        const real joint_torque = model->damping[j] * (predicted_rate[j] - predicted_rate[j + 1])
            + model->stiffness[j] * (predicted_angle[j] - predicted_angle[j + 1]);
        impedance_xx = impedance_xx + model->node_mass[j];
        force_x = force_x + acceleration_x[j + 1] * model->node_mass[j];
        impedance_yy = impedance_yy + model->node_mass[j];
        force_y = force_y + acceleration_y[j + 1] * model->node_mass[j];
        impedance_xu = impedance_xu + impedance_xx * swing_x[j] + impedance_xy * swing_y[j];
        impedance_yu = impedance_yu + impedance_yx * swing_x[j] + impedance_yy * swing_y[j];
        impedance_uu = impedance_uu + impedance_ux * swing_x[j] + impedance_uy * swing_y[j];
        impedance_ux = impedance_ux - impedance_xx * lever_sine[j] + impedance_yx * lever_cosine[j];
        impedance_uy = impedance_uy - impedance_xy * lever_sine[j] + impedance_yy * lever_cosine[j];
        impedance_uu = impedance_uu + model->rod_inertia[j]
            + lever_cosine[j] * (impedance_yu - angle_per_acceleration * force_x)
            + lever_sine[j] * (-impedance_xu - angle_per_acceleration * force_y);
        torque = torque + state->acceleration[j] * model->rod_inertia[j] - force_x * lever_sine[j]
            + force_y * lever_cosine[j];
        const real pivot = impedance_uu + model->joint_impedance[j];
        if (!(pivot > 0.0) || !(pivot <= DBL_MAX)) {
            return CUBE_VANISHING_PIVOT;
        }
        const real admittance = 1.0 / pivot;
        answer_own[j] = admittance * (joint_torque - torque);
        answer_x[j] = admittance * impedance_ux;
        answer_y[j] = admittance * impedance_uy;
        transmission[j] = admittance * model->joint_impedance[j];
        impedance_xx = impedance_xx - answer_x[j] * impedance_xu;
        impedance_xy = impedance_xy - answer_y[j] * impedance_xu;
        force_x = force_x + answer_own[j] * impedance_xu;
        impedance_xu = impedance_xu * transmission[j];
        impedance_yx = impedance_yx - answer_x[j] * impedance_yu;
        impedance_yy = impedance_yy - answer_y[j] * impedance_yu;
        force_y = force_y + answer_own[j] * impedance_yu;
        impedance_yu = impedance_yu * transmission[j];
        impedance_ux = answer_x[j] * model->joint_impedance[j];
        impedance_uy = answer_y[j] * model->joint_impedance[j];
        impedance_uu = impedance_uu * transmission[j];
        torque = joint_torque - answer_own[j] * model->joint_impedance[j];
    }
    for (int j = 6; j >= 6; --j) {
        const real joint_torque = model->damping[j] * (predicted_rate[0] - predicted_rate[j + 1])
            + model->stiffness[j] * (predicted_angle[0] - predicted_angle[j + 1]);
        impedance_xx = impedance_xx + model->node_mass[j];
        force_x = force_x + acceleration_x[j + 1] * model->node_mass[j];
        impedance_yy = impedance_yy + model->node_mass[j];
        force_y = force_y + acceleration_y[j + 1] * model->node_mass[j];
        impedance_xu = impedance_xu + impedance_xx * swing_x[j] + impedance_xy * swing_y[j];
        impedance_yu = impedance_yu + impedance_yx * swing_x[j] + impedance_yy * swing_y[j];
        impedance_uu = impedance_uu + impedance_ux * swing_x[j] + impedance_uy * swing_y[j];
        impedance_ux = impedance_ux - impedance_xx * lever_sine[j] + impedance_yx * lever_cosine[j];
        impedance_uy = impedance_uy - impedance_xy * lever_sine[j] + impedance_yy * lever_cosine[j];
        impedance_uu = impedance_uu + model->rod_inertia[j]
            + lever_cosine[j] * (impedance_yu - angle_per_acceleration * force_x)
            + lever_sine[j] * (-impedance_xu - angle_per_acceleration * force_y);
        torque = torque + state->acceleration[j] * model->rod_inertia[j] - force_x * lever_sine[j]
            + force_y * lever_cosine[j];
        const real pivot = impedance_uu + model->joint_impedance[j];
        if (!(pivot > 0.0) || !(pivot <= DBL_MAX)) {
            return CUBE_VANISHING_PIVOT;
        }
        const real admittance = 1.0 / pivot;
        answer_own[j] = admittance * (joint_torque - torque);
        answer_x[j] = admittance * impedance_ux;
        answer_y[j] = admittance * impedance_uy;
        transmission[j] = admittance * model->joint_impedance[j];
        impedance_xx = impedance_xx - answer_x[j] * impedance_xu;
        impedance_xy = impedance_xy - answer_y[j] * impedance_xu;
        force_x = force_x + answer_own[j] * impedance_xu;
        impedance_xu = impedance_xu * transmission[j];
        impedance_yx = impedance_yx - answer_x[j] * impedance_yu;
        impedance_yy = impedance_yy - answer_y[j] * impedance_yu;
        force_y = force_y + answer_own[j] * impedance_yu;
        impedance_yu = impedance_yu * transmission[j];
        impedance_ux = answer_x[j] * model->joint_impedance[j];
        impedance_uy = answer_y[j] * model->joint_impedance[j];
        impedance_uu = impedance_uu * transmission[j];
        torque = joint_torque - answer_own[j] * model->joint_impedance[j];
    }
    const real impedance_xx_of_branch_7 = impedance_xx;
    const real impedance_xy_of_branch_7 = impedance_xy;
    const real impedance_xu_of_branch_7 = impedance_xu;
    const real impedance_yx_of_branch_7 = impedance_yx;
    const real impedance_yy_of_branch_7 = impedance_yy;
    const real impedance_yu_of_branch_7 = impedance_yu;
    const real impedance_ux_of_branch_7 = impedance_ux;
    const real impedance_uy_of_branch_7 = impedance_uy;
    const real impedance_uu_of_branch_7 = impedance_uu;
    const real force_x_of_branch_7 = force_x;
    const real force_y_of_branch_7 = force_y;
    const real torque_of_branch_7 = torque;
    impedance_xx = 0.0;
    impedance_xy = 0.0;
    impedance_xu = 0.0;
    impedance_yx = 0.0;
    impedance_yy = 0.0;
    impedance_yu = 0.0;
    impedance_ux = 0.0;
    impedance_uy = 0.0;
    impedance_uu = 0.0;
    force_x = 0.0;
    force_y = 0.0;
    torque = 0.0;
    for (int j = 5; j >= 1; --j) {
        const real joint_torque = model->damping[j] * (predicted_rate[j] - predicted_rate[j + 1])
            + model->stiffness[j] * (predicted_angle[j] - predicted_angle[j + 1]);
        impedance_xx = impedance_xx + model->node_mass[j];
        force_x = force_x + acceleration_x[j + 1] * model->node_mass[j];
        impedance_yy = impedance_yy + model->node_mass[j];
        force_y = force_y + acceleration_y[j + 1] * model->node_mass[j];
        impedance_xu = impedance_xu + impedance_xx * swing_x[j] + impedance_xy * swing_y[j];
        impedance_yu = impedance_yu + impedance_yx * swing_x[j] + impedance_yy * swing_y[j];
        impedance_uu = impedance_uu + impedance_ux * swing_x[j] + impedance_uy * swing_y[j];
        impedance_ux = impedance_ux - impedance_xx * lever_sine[j] + impedance_yx * lever_cosine[j];
        impedance_uy = impedance_uy - impedance_xy * lever_sine[j] + impedance_yy * lever_cosine[j];
        impedance_uu = impedance_uu + model->rod_inertia[j]
            + lever_cosine[j] * (impedance_yu - angle_per_acceleration * force_x)
            + lever_sine[j] * (-impedance_xu - angle_per_acceleration * force_y);
        torque = torque + state->acceleration[j] * model->rod_inertia[j] - force_x * lever_sine[j]
            + force_y * lever_cosine[j];
        const real pivot = impedance_uu + model->joint_impedance[j];
        if (!(pivot > 0.0) || !(pivot <= DBL_MAX)) {
            return CUBE_VANISHING_PIVOT;
        }
        const real admittance = 1.0 / pivot;
        answer_own[j] = admittance * (joint_torque - torque);
        answer_x[j] = admittance * impedance_ux;
        answer_y[j] = admittance * impedance_uy;
        transmission[j] = admittance * model->joint_impedance[j];
        impedance_xx = impedance_xx - answer_x[j] * impedance_xu;
        impedance_xy = impedance_xy - answer_y[j] * impedance_xu;
        force_x = force_x + answer_own[j] * impedance_xu;
        impedance_xu = impedance_xu * transmission[j];
        impedance_yx = impedance_yx - answer_x[j] * impedance_yu;
        impedance_yy = impedance_yy - answer_y[j] * impedance_yu;
        force_y = force_y + answer_own[j] * impedance_yu;
        impedance_yu = impedance_yu * transmission[j];
        impedance_ux = answer_x[j] * model->joint_impedance[j];
        impedance_uy = answer_y[j] * model->joint_impedance[j];
        impedance_uu = impedance_uu * transmission[j];
        torque = joint_torque - answer_own[j] * model->joint_impedance[j];
    }
    for (int j = 0; j >= 0; --j) {
        const real joint_torque = model->damping[j] * (predicted_rate[j] - predicted_rate[j + 1])
            + model->rest[j] * model->stiffness[j]
            + model->stiffness[j] * (predicted_angle[j] - predicted_angle[j + 1]);
        impedance_xx = impedance_xx + model->node_mass[j];
        force_x = force_x + acceleration_x[j + 1] * model->node_mass[j];
        impedance_yy = impedance_yy + model->node_mass[j];
        force_y = force_y + acceleration_y[j + 1] * model->node_mass[j];
        impedance_xu = impedance_xu + impedance_xx * swing_x[j] + impedance_xy * swing_y[j];
        impedance_yu = impedance_yu + impedance_yx * swing_x[j] + impedance_yy * swing_y[j];
        impedance_uu = impedance_uu + impedance_ux * swing_x[j] + impedance_uy * swing_y[j];
        impedance_ux = impedance_ux - impedance_xx * lever_sine[j] + impedance_yx * lever_cosine[j];
        impedance_uy = impedance_uy - impedance_xy * lever_sine[j] + impedance_yy * lever_cosine[j];
        impedance_uu = impedance_uu + model->rod_inertia[j]
            + lever_cosine[j] * (impedance_yu - angle_per_acceleration * force_x)
            + lever_sine[j] * (-impedance_xu - angle_per_acceleration * force_y);
        torque = torque + state->acceleration[j] * model->rod_inertia[j] - force_x * lever_sine[j]
            + force_y * lever_cosine[j];
        const real pivot = impedance_uu + model->joint_impedance[j];
        if (!(pivot > 0.0) || !(pivot <= DBL_MAX)) {
            return CUBE_VANISHING_PIVOT;
        }
        const real admittance = 1.0 / pivot;
        answer_own[j] = admittance * (joint_torque - torque);
        answer_x[j] = admittance * impedance_ux;
        answer_y[j] = admittance * impedance_uy;
        transmission[j] = admittance * model->joint_impedance[j];
        impedance_xx = impedance_xx - answer_x[j] * impedance_xu;
        impedance_xy = impedance_xy - answer_y[j] * impedance_xu;
        force_x = force_x + answer_own[j] * impedance_xu;
        impedance_xu = impedance_xu * transmission[j];
        impedance_yx = impedance_yx - answer_x[j] * impedance_yu;
        impedance_yy = impedance_yy - answer_y[j] * impedance_yu;
        force_y = force_y + answer_own[j] * impedance_yu;
        impedance_yu = impedance_yu * transmission[j];
        impedance_ux = answer_x[j] * model->joint_impedance[j];
        impedance_uy = answer_y[j] * model->joint_impedance[j];
        impedance_uu = impedance_uu * transmission[j];
        torque = joint_torque - answer_own[j] * model->joint_impedance[j];
    }
    impedance_xx = impedance_xx + impedance_xx_of_branch_7;
    impedance_xy = impedance_xy + impedance_xy_of_branch_7;
    impedance_xu = impedance_xu + impedance_xu_of_branch_7;
    impedance_yx = impedance_yx + impedance_yx_of_branch_7;
    impedance_yy = impedance_yy + impedance_yy_of_branch_7;
    impedance_yu = impedance_yu + impedance_yu_of_branch_7;
    impedance_ux = impedance_ux + impedance_ux_of_branch_7;
    impedance_uy = impedance_uy + impedance_uy_of_branch_7;
    impedance_uu = impedance_uu + impedance_uu_of_branch_7;
    force_x = force_x + force_x_of_branch_7;
    force_y = force_y + force_y_of_branch_7;
    torque = torque + torque_of_branch_7;

    /* The base. */
    const real whole_impedance_xx = model->base_mass + impedance_xx;
    const real whole_impedance_yy = model->base_mass + impedance_yy;
    const real whole_impedance_uu = model->hub_inertia + impedance_uu;
    if (!(whole_impedance_xx > 0.0) || !(whole_impedance_xx <= DBL_MAX)) {
        return CUBE_VANISHING_PIVOT;
    }
    const real share_yx = impedance_yx / whole_impedance_xx;
    const real impedance_yy_freed_x = whole_impedance_yy - impedance_xy * share_yx;
    const real impedance_yu_freed_x = impedance_yu - impedance_xu * share_yx;
    const real share_ux = impedance_ux / whole_impedance_xx;
    const real impedance_uy_freed_x = impedance_uy - impedance_xy * share_ux;
    const real impedance_uu_freed_x = whole_impedance_uu - impedance_xu * share_ux;
    if (!(impedance_yy_freed_x > 0.0) || !(impedance_yy_freed_x <= DBL_MAX)) {
        return CUBE_VANISHING_PIVOT;
    }
    const real share_uy = impedance_uy_freed_x / impedance_yy_freed_x;
    const real impedance_uu_freed_y = impedance_uu_freed_x - impedance_yu_freed_x * share_uy;
    if (!(impedance_uu_freed_y > 0.0) || !(impedance_uu_freed_y <= DBL_MAX)) {
        return CUBE_VANISHING_PIVOT;
    }
    const real whole_force_x = force_x + acceleration_x[0] * model->base_mass;
    const real whole_force_y = force_y - inputs->thruster + acceleration_y[0] * model->base_mass;
    const real whole_torque = torque - inputs->wheel + state->hub_acceleration * model->hub_inertia;
    const real force_y_freed_x = whole_force_y - share_yx * whole_force_x;
    const real torque_freed_x = whole_torque - share_ux * whole_force_x;
    const real torque_freed_y = torque_freed_x - force_y_freed_x * share_uy;
    real unknown = -torque_freed_y / impedance_uu_freed_y;
    real change_y = (-force_y_freed_x - impedance_yu_freed_x * unknown) / impedance_yy_freed_x;
    real change_x = (-whole_force_x - change_y * impedance_xy - impedance_xu * unknown) / whole_impedance_xx;
    const real base_change_x = change_x;
    const real base_change_y = change_y;
    const real hub_unknown = unknown;

    /* Sweep outward: the unknown of each station. */
    change_x = base_change_x;
    change_y = base_change_y;
    for (int j = 0; j < 6; ++j) {
        unknown = answer_own[j] - answer_x[j] * change_x - answer_y[j] * change_y + transmission[j] * unknown;
        change_x = change_x + swing_x[j] * unknown;
        change_y = change_y + swing_y[j] * unknown;
        solved[j] = unknown;
    }
    change_x = base_change_x;
    change_y = base_change_y;
    unknown = hub_unknown;
    for (int j = 6; j < CUBE_STATIONS; ++j) {
        unknown = answer_own[j] - answer_x[j] * change_x - answer_y[j] * change_y + transmission[j] * unknown;
        change_x = change_x + swing_x[j] * unknown;
        change_y = change_y + swing_y[j] * unknown;
        solved[j] = unknown;
    }

    /* Motion at the end of the step. */
    trial_acceleration_x = base_change_x + trial_acceleration_x;
    trial_acceleration_y = base_change_y + trial_acceleration_y;
    state->hub_angle = predicted_angle[0] + angle_per_acceleration * hub_unknown;
    state->hub_rate = predicted_rate[0] + hub_unknown * rate_per_acceleration;
    state->hub_acceleration = state->hub_acceleration + hub_unknown;
    state->base_place_x = state->base_place_x
        + angle_per_acceleration * (state->base_acceleration_x + trial_acceleration_x)
        + state->base_velocity_x * step;
    state->base_velocity_x = state->base_velocity_x
        + rate_per_acceleration * (state->base_acceleration_x + trial_acceleration_x);
    state->base_acceleration_x = trial_acceleration_x;
    state->base_place_y = state->base_place_y
        + angle_per_acceleration * (state->base_acceleration_y + trial_acceleration_y)
        + state->base_velocity_y * step;
    state->base_velocity_y = state->base_velocity_y
        + rate_per_acceleration * (state->base_acceleration_y + trial_acceleration_y);
    state->base_acceleration_y = trial_acceleration_y;
    for (int j = 0; j < CUBE_STATIONS; ++j) {
        state->angle[j] = predicted_angle[j + 1] + angle_per_acceleration * solved[j];
        state->rate[j] = predicted_rate[j + 1] + rate_per_acceleration * solved[j];
        state->acceleration[j] = state->acceleration[j] + solved[j];
        total += state->angle[j] + state->rate[j] + state->acceleration[j];
    }

    if (!isfinite(total + state->hub_angle + state->hub_rate + state->hub_acceleration + state->base_place_x
        + state->base_velocity_x + state->base_acceleration_x + state->base_place_y + state->base_velocity_y
        + state->base_acceleration_y)) {
        return CUBE_NON_FINITE_STATE;
    }
    return CUBE_OK;
}

void cube_output(
    const cube_model *model,
    const cube_state *state,
    cube_outputs *outputs)
{
    if (model == NULL || state == NULL || outputs == NULL) {
        return;
    }
    /* Output attitude: angle. */
    outputs->attitude = state->hub_angle;

    /* Output hub: position. */
    outputs->hub_x = state->base_place_x;
    outputs->hub_y = state->base_place_y;

    /* Output right_end: position. */
    outputs->right_end_x = state->base_place_x;
    outputs->right_end_y = state->base_place_y;
    for (int j = 6; j < CUBE_STATIONS; ++j) {
        outputs->right_end_x = outputs->right_end_x + model->length[j] * cos(state->angle[j]);
        outputs->right_end_y = outputs->right_end_y + model->length[j] * sin(state->angle[j]);
    }

    /* Output latch_torque: joint torque. */
    outputs->latch_torque = model->damping[6] * (state->hub_rate - state->rate[6])
        + model->stiffness[6] * (state->hub_angle - state->angle[6]);
}
