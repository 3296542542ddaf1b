/**
 * arm10: Ten-link arm swung by a hub motor
 *
 * Written by tmm-gen 0.1.0. Do not edit: change the scene and run `tmm-gen build`.
 * scene digest: d9d28dc691ae4f0a1d62cb9cfa9f4612d111fa76a756dd286c77eac7f930ab35
 * sha256 of the rest of this file: ebd303f2e14b21ea30e46994283ef8cf158be492280d066fbee26cfda08e87c0
 *
 * model: planar arm, large rotations, gravity, tip mass
 * stations: 10
 * base: motor
 * integrator: Newmark 1959, beta = 0.25, gamma = 0.5
 * linearisation: newton
 * sweep: riccati
 * unknown: acceleration
 * operations of a step: 1351, 135.1 per station (621 additions, 699 multiplications, 11 divisions, 20
 *     functions)
 * operations of prepare: 77, 7.7 per station (13 additions, 64 multiplications)
 * number type: double
 * bytes of the structs: params 224, model 352, state 264, inputs 16, outputs 32
 *
 * @file arm10.c
 */
#if defined(__FAST_MATH__) || defined(__ASSOCIATIVE_MATH__) || defined(_M_FP_FAST) \
    || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "-Ofast and -ffast-math remove checks of this file: use -O3, or put -fno-fast-math behind them"
#endif

#include <float.h>
#include <math.h>
#include <stddef.h>
#include <stdint.h>

/* Members of the header below: no macro of a header above may have their names. */
#undef hub_torque
#undef tip_force
#undef tip_x
#undef tip_y
#undef hub
#undef root

#include "arm10.h"

typedef arm10_real real;

/* Sine and cosine of an angle. */
typedef struct {
    real sine;
    real cosine;
} circle;

/*
 * Sine and cosine, right within 2.5e-16 for angles up to 1647099 rad. Additions and multiplications alone, and
 * the same ones for every angle: the same bits on every machine, in the same time.
 */
static circle circle_of(real angle)
{
    /* Sines of no, one, two, three and four quarters of a turn. */
    static const real sine_of_quarters[5] = {
        0.0, 1.0, 0.0, -1.0, 0.0
    };
    circle result;

    /* So large a number that it has no digits behind the point: its last ones count quarters of a turn. */
    const union {
        real number;
        uint64_t digits;
    } counted = {angle * 0.6366197723675814 + 6755399441055744.0};
    const uint64_t quarters = counted.digits & 3u;

    /* The angle without these quarters, in three parts. One expression, so that an analyser sees how small it is. */
    const real rest = angle
        - ((angle * 0.6366197723675814 + 6755399441055744.0) - 6755399441055744.0) * 1.5707963267341256
        - ((angle * 0.6366197723675814 + 6755399441055744.0) - 6755399441055744.0) * 6.077100506303966e-11
        - ((angle * 0.6366197723675814 + 6755399441055744.0) - 6755399441055744.0) * 2.0222662487959506e-21;

    /* Polynomials, of an eighth of a turn at most. */
    const real z = rest * rest;
    real sine = 1.5917030971117794e-10;
    sine = -2.5051116540593934e-08 + z * sine;
    sine = 2.7557316028832514e-06 + z * sine;
    sine = -0.00019841269836615895 + z * sine;
    sine = 0.008333333333330854 + z * sine;
    sine = -0.16666666666666666 + z * sine;
    sine = rest + rest * z * sine;
    real cosine = -1.1381945321240986e-11;
    cosine = 2.0876136694130206e-09 + z * cosine;
    cosine = -2.7557317225611814e-07 + z * cosine;
    cosine = 2.4801587298676432e-05 + z * cosine;
    cosine = -0.001388888888888734 + z * cosine;
    cosine = 0.041666666666666664 + z * cosine;
    cosine = (1.0 - 0.5 * z) + z * z * cosine;

    /* Theorem of addition. */
    result.sine = sine * sine_of_quarters[quarters + 1u] + cosine * sine_of_quarters[quarters];
    result.cosine = cosine * sine_of_quarters[quarters + 1u] - sine * sine_of_quarters[quarters];
    return result;
}

static int inputs_are_finite(const arm10_inputs *inputs)
{
    if (!isfinite(inputs->hub_torque) || !isfinite(inputs->tip_force)) {
        return 0;
    }
    return 1;
}

void arm10_default_params(arm10_params *params)
{
    static const real stiffness[] = {
        64.0, 32.0, 32.0, 32.0, 32.0, 32.0, 32.0, 32.0, 32.0, 32.0
    };
    static const real damping[] = {
        0.128, 0.064, 0.064, 0.064, 0.064, 0.064, 0.064, 0.064, 0.064, 0.064
    };
    if (params == NULL) {
        return;
    }
    params->length = 0.1;
    params->mass = 0.05;
    params->inertia = 4.1666666666666665e-05;
    params->center = 0.5;
    for (int j = 0; j < ARM10_STATIONS; ++j) {
        params->stiffness[j] = stiffness[j];
    }
    for (int j = 0; j < ARM10_STATIONS; ++j) {
        params->damping[j] = damping[j];
    }
    params->gravity = 9.81;
    params->hub_inertia = 0.05;
    params->hub_damping = 0.01;
    params->tip_mass = 0.1;
}

arm10_status arm10_prepare(
    arm10_model *model,
    const arm10_params *params,
    arm10_real step)
{
    if (model == NULL || params == NULL) {
        return ARM10_NULL_POINTER;
    }
    if (!(step > 0.0) || !(step <= DBL_MAX)) {
        return ARM10_INVALID_STEP;
    }
    /* Infinities and NaN less themselves are NaN, all other numbers 0. */
    real lost = (params->length - params->length) + (params->mass - params->mass)
        + (params->inertia - params->inertia) + (params->center - params->center)
        + (params->gravity - params->gravity) + (params->hub_inertia - params->hub_inertia)
        + (params->hub_damping - params->hub_damping) + (params->tip_mass - params->tip_mass);
    for (int j = 0; j < ARM10_STATIONS; ++j) {
        lost += (params->stiffness[j] - params->stiffness[j]) + (params->damping[j] - params->damping[j]);
    }
    if (!(lost >= 0.0)) {
        return ARM10_NON_FINITE_INPUT;
    }

    /* Masses by the ends they act at, and joint impedances. */
    model->carried_mass = params->center * params->mass;
    model->inner_mass = params->mass - params->center * params->mass;
    model->pin_inertia = params->inertia
        + params->center * params->center * (params->length * params->length) * params->mass;
    for (int j = 0; j < ARM10_STATIONS; ++j) {
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
    model->length = params->length;
    model->mass = params->mass;
    for (int j = 0; j < ARM10_STATIONS; ++j) {
        model->stiffness[j] = params->stiffness[j];
    }
    for (int j = 0; j < ARM10_STATIONS; ++j) {
        model->damping[j] = params->damping[j];
    }
    model->gravity = params->gravity;
    model->hub_inertia = params->hub_inertia;
    model->hub_damping = params->hub_damping;
    model->tip_mass = params->tip_mass;

    real total = 0.0; /* of the model: is all of it finite? */
    for (int j = 0; j < ARM10_STATIONS; ++j) {
        total += model->joint_impedance[j];
    }
    if (!isfinite(model->step2_1_over_2 + model->angle_per_acceleration + model->factor_3
        + model->rate_per_acceleration + model->carried_mass + model->inner_mass + model->pin_inertia
        + total)) {
        return ARM10_NON_FINITE_MODEL;
    }
    return ARM10_OK;
}

arm10_status arm10_initialise(
    arm10_state *state,
    const arm10_params *params,
    const arm10_real initial_angle[ARM10_STATIONS],
    const arm10_real initial_rate[ARM10_STATIONS],
    const arm10_inputs *inputs)
{
    if (state == NULL || params == NULL || inputs == NULL) {
        return ARM10_NULL_POINTER;
    }
    if (!inputs_are_finite(inputs)) {
        return ARM10_NON_FINITE_INPUT;
    }
    for (int j = 0; j < ARM10_STATIONS; ++j) {
        if ((initial_angle != NULL && !isfinite(initial_angle[j]))
            || (initial_rate != NULL && !isfinite(initial_rate[j]))) {
            return ARM10_NON_FINITE_INPUT;
        }
    }

    const real length = params->length;
    const real mass = params->mass;
    const real inertia = params->inertia;
    const real center = params->center;
    real acceleration_x[ARM10_STATIONS + 1]; /* acceleration of the nodes along x [m/s^2] */
    real acceleration_y[ARM10_STATIONS + 1]; /* acceleration of the nodes along y [m/s^2] */
    real answer_own[ARM10_STATIONS]; /* increment of the unknown if the inner side kept its motion */
    real answer_x[ARM10_STATIONS]; /* answer to the joint's acceleration along x */
    real answer_y[ARM10_STATIONS]; /* answer to the joint's acceleration along y */
    real lever_cosine[ARM10_STATIONS]; /* length times cosine of the predicted angle [m] */
    real lever_sine[ARM10_STATIONS]; /* length times sine of the predicted angle [m] */
    /* acceleration of base and links as predicted [rad/s^2] */
    real predicted_acceleration[ARM10_STATIONS + 1];
    real predicted_angle[ARM10_STATIONS + 1]; /* angle of base and links as predicted [rad] */
    real predicted_rate[ARM10_STATIONS + 1]; /* rate of base and links as predicted [rad/s] */
    real swing_x[ARM10_STATIONS]; /* change of the outer end's acceleration along x per unknown [m] */
    real swing_y[ARM10_STATIONS]; /* change of the outer end's acceleration along y per unknown [m] */
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
    for (int j = 0; j < ARM10_STATIONS; ++j) {
        predicted_angle[j + 1] = (initial_angle != NULL ? initial_angle[j] : 0.0);
        predicted_rate[j + 1] = (initial_rate != NULL ? initial_rate[j] : 0.0);
        predicted_acceleration[j + 1] = 0.0;
        if (!(fabs(predicted_angle[j + 1]) <= ARM10_LARGEST_ANGLE)) {
            return ARM10_OUT_OF_RANGE;
        }
        const circle turn_1 = circle_of(predicted_angle[j + 1]);
        lever_sine[j] = length * turn_1.sine;
        lever_cosine[j] = length * turn_1.cosine;
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
    real impedance_uu = 0.0;
    real force_x = acceleration_x[10] * params->tip_mass;
    real force_y = acceleration_y[10] * params->tip_mass - inputs->tip_force;
    real torque = 0.0;
    for (int j = ARM10_STATIONS - 1; j >= 0; --j) {
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
        if (!(link_uu > 3.814697265625e-06) || !(link_uu <= DBL_MAX)) {
            return ARM10_VANISHING_PIVOT;
        }
        const real inverse_pivot = 1.0 / link_uu;
        answer_own[j] = inverse_pivot * (joint_torque - torque);
        if (!(answer_own[j] > -536870912.0) || !(answer_own[j] < 536870912.0)) {
            return ARM10_OUT_OF_RANGE;
        }
        answer_x[j] = inverse_pivot * link_ux;
        if (!(answer_x[j] > -1024.0) || !(answer_x[j] < 1024.0)) {
            return ARM10_OUT_OF_RANGE;
        }
        answer_y[j] = inverse_pivot * link_uy;
        if (!(answer_y[j] > -2048.0) || !(answer_y[j] < 2048.0)) {
            return ARM10_OUT_OF_RANGE;
        }
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
    if (!(hub_pivot > 0.00048828125) || !(hub_pivot <= DBL_MAX)) {
        return ARM10_VANISHING_PIVOT;
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
    for (int j = 0; j < ARM10_STATIONS; ++j) {
        unknown = answer_own[j] - answer_x[j] * change_x - answer_y[j] * change_y;
        change_x = change_x + swing_x[j] * unknown;
        change_y = change_y + swing_y[j] * unknown;
        state->angle[j] = predicted_angle[j + 1];
        state->rate[j] = predicted_rate[j + 1];
        state->acceleration[j] = predicted_acceleration[j + 1] + unknown;
        total += state->angle[j] + state->rate[j] + state->acceleration[j];
    }

    if (!isfinite(total + state->hub_angle + state->hub_rate + state->hub_acceleration)) {
        return ARM10_NON_FINITE_STATE;
    }
    return ARM10_OK;
}

arm10_status arm10_step(
    const arm10_model *model,
    arm10_state *state,
    const arm10_inputs *inputs)
{
    if (model == NULL || state == NULL || inputs == NULL) {
        return ARM10_NULL_POINTER;
    }
    if (!inputs_are_finite(inputs)) {
        return ARM10_NON_FINITE_INPUT;
    }

    const real step = model->step;
    const real length = model->length;
    const real mass = model->mass;
    const real step2_1_over_2 = model->step2_1_over_2;
    const real angle_per_acceleration = model->angle_per_acceleration;
    const real rate_per_acceleration = model->rate_per_acceleration;
    const real carried_mass = model->carried_mass;
    const real inner_mass = model->inner_mass;
    const real pin_inertia = model->pin_inertia;
    real acceleration_x[ARM10_STATIONS + 1]; /* acceleration of the nodes along x [m/s^2] */
    real acceleration_y[ARM10_STATIONS + 1]; /* acceleration of the nodes along y [m/s^2] */
    real answer_from_inner[ARM10_STATIONS]; /* answer to the inner link's unknown */
    real answer_own[ARM10_STATIONS]; /* increment of the unknown if the inner side kept its motion */
    real answer_x[ARM10_STATIONS]; /* answer to the joint's acceleration along x */
    real answer_y[ARM10_STATIONS]; /* answer to the joint's acceleration along y */
    real lever_cosine[ARM10_STATIONS]; /* length times cosine of the predicted angle [m] */
    real lever_sine[ARM10_STATIONS]; /* length times sine of the predicted angle [m] */
    /* acceleration of base and links as predicted [rad/s^2] */
    real predicted_acceleration[ARM10_STATIONS + 1];
    real predicted_angle[ARM10_STATIONS + 1]; /* angle of base and links as predicted [rad] */
    real predicted_rate[ARM10_STATIONS + 1]; /* rate of base and links as predicted [rad/s] */
    real swing_x[ARM10_STATIONS]; /* change of the outer end's acceleration along x per unknown [m] */
    real swing_y[ARM10_STATIONS]; /* change of the outer end's acceleration along y per unknown [m] */
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
    for (int j = 0; j < ARM10_STATIONS; ++j) {
        predicted_angle[j + 1] = state->angle[j] + state->acceleration[j] * step2_1_over_2
            + state->rate[j] * step;
        predicted_rate[j + 1] = state->rate[j] + state->acceleration[j] * step;
        predicted_acceleration[j + 1] = state->acceleration[j];
        if (!(fabs(predicted_angle[j + 1]) <= ARM10_LARGEST_ANGLE)) {
            return ARM10_OUT_OF_RANGE;
        }
        const circle turn_1 = circle_of(predicted_angle[j + 1]);
        lever_sine[j] = length * turn_1.sine;
        lever_cosine[j] = length * turn_1.cosine;
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
    real impedance_uu = 0.0;
    real force_x = acceleration_x[10] * model->tip_mass;
    real force_y = acceleration_y[10] * model->tip_mass - inputs->tip_force;
    real torque = 0.0;
    for (int j = ARM10_STATIONS - 1; j >= 0; --j) {
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
        if (!(pivot > 3.814697265625e-06) || !(pivot <= DBL_MAX)) {
            return ARM10_VANISHING_PIVOT;
        }
        const real inverse_pivot = 1.0 / pivot;
        answer_own[j] = inverse_pivot * (joint_torque - torque);
        if (!(answer_own[j] > -134217728.0) || !(answer_own[j] < 134217728.0)) {
            return ARM10_OUT_OF_RANGE;
        }
        answer_x[j] = inverse_pivot * link_ux;
        if (!(answer_x[j] > -1024.0) || !(answer_x[j] < 1024.0)) {
            return ARM10_OUT_OF_RANGE;
        }
        answer_y[j] = inverse_pivot * link_uy;
        if (!(answer_y[j] > -1024.0) || !(answer_y[j] < 1024.0)) {
            return ARM10_OUT_OF_RANGE;
        }
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
    if (!(hub_pivot > 0.00048828125) || !(hub_pivot <= DBL_MAX)) {
        return ARM10_VANISHING_PIVOT;
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
    for (int j = 0; j < ARM10_STATIONS; ++j) {
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
        return ARM10_NON_FINITE_STATE;
    }
    return ARM10_OK;
}

void arm10_output(
    const arm10_model *model,
    const arm10_state *state,
    arm10_outputs *outputs)
{
    if (model == NULL || state == NULL || outputs == NULL) {
        return;
    }
    const real length = model->length;

    /* Tip: position. */
    outputs->tip_x = 0.0;
    outputs->tip_y = 0.0;
    for (int j = 0; j < ARM10_STATIONS; ++j) {
        const circle turn_1 = circle_of(state->angle[j]);
        outputs->tip_x = outputs->tip_x + length * turn_1.cosine;
        outputs->tip_y = outputs->tip_y + length * turn_1.sine;
    }

    /* Hub: angle. */
    outputs->hub = state->hub_angle;

    /* Root: torque. */
    outputs->root = model->damping[0] * (state->rate[0] - state->hub_rate)
        + model->stiffness[0] * (state->angle[0] - state->hub_angle);
}
