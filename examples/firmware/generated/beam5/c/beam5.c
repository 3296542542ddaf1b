/**
 * beam5: Five-link arm on a hub, the model of an observer
 *
 * Written by tmm-gen 0.2.0. Do not edit: change the scene and run `tmm-gen build`.
 * scene digest: 7cda6afdfe9f28eb257c67670c83631d86f159a73ec0c14225ebe1e38843e797
 * sha256 of the rest of this file: e6522927927b3012535711bf30bd58abc412604c3882b1b44918d98f9ada5250
 *
 * model: planar arm, large rotations, gravity, tip mass
 * stations: 5
 * base: motor
 * integrator: Newmark 1959, beta = 0.25, gamma = 0.5
 * linearisation: newton
 * sweep: riccati
 * unknown: acceleration
 * operations of a step: 595, 119 per station (275 additions, 304 multiplications, 6 divisions, 10 sines and
 *     cosines)
 * operations of prepare: 47, 9.4 per station (10 additions, 37 multiplications)
 * number type: float
 * bytes of the structs: state 72, inputs 4, outputs 12
 *
 * @file beam5.c
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
#undef hub
#undef tip_x
#undef tip_y

#include "beam5.h"

typedef beam5_real real;

/* Sine and cosine of an angle. */
typedef struct {
    real sine;
    real cosine;
} circle;

/*
 * Sine and cosine, right within 1.3e-07 for angles up to 6433 rad. Additions and multiplications alone, and
 * the same ones for every angle: the same bits on every machine, in the same time.
 */
static circle circle_of(real angle)
{
    /* Sines of no, one, two, three and four quarters of a turn. */
    static const real sine_of_quarters[5] = {
        0.0f, 1.0f, 0.0f, -1.0f, 0.0f
    };
    circle result;

    /* So large a number that it has no digits behind the point: its last ones count quarters of a turn. */
    const union {
        real number;
        uint32_t digits;
    } counted = {angle * 0.63661975f + 12582912.0f};
    const uint32_t quarters = counted.digits & 3u;

    /* The angle without these quarters, in three parts. One expression, so that an analyser sees how small it is. */
    const real rest = angle
        - ((angle * 0.63661975f + 12582912.0f) - 12582912.0f) * 1.5708008f
        - ((angle * 0.63661975f + 12582912.0f) - 12582912.0f) * -4.4535846e-06f
        - ((angle * 0.63661975f + 12582912.0f) - 12582912.0f) * -8.705516e-10f;

    /* Polynomials, of an eighth of a turn at most. */
    const real z = rest * rest;
    real sine = -0.0001958592f;
    sine = 0.008332739f + z * sine;
    sine = -0.16666664f + z * sine;
    sine = rest + rest * z * sine;
    real cosine = 2.4545967e-05f;
    cosine = -0.0013888294f + z * cosine;
    cosine = 0.041666664f + z * cosine;
    cosine = (1.0f - 0.5f * z) + z * z * cosine;

    /* Theorem of addition. */
    result.sine = sine * sine_of_quarters[quarters + 1u] + cosine * sine_of_quarters[quarters];
    result.cosine = cosine * sine_of_quarters[quarters + 1u] - sine * sine_of_quarters[quarters];
    return result;
}

static int inputs_are_finite(const beam5_inputs *inputs)
{
    if (!isfinite(inputs->hub_torque)) {
        return 0;
    }
    return 1;
}

/* Parameters and what follows from them and the time step: constants, as this arm is the only one. */
static const real step = 0.001f; /* time step [s] */
static const real length = 0.2f; /* link length, the same everywhere [m] */
static const real mass = 0.1f; /* link mass, the same everywhere [kg] */
/* link inertia about its centre of mass, the same everywhere [kg m^2] */
static const real inertia = 0.00033333333f;
static const real center = 0.5f; /* centre of mass along the link, 0 to 1, the same everywhere */
/* joint stiffness, base to tip [N m/rad] */
static const real stiffness[BEAM5_STATIONS] = {
    32.0f, 16.0f, 16.0f, 16.0f, 16.0f
};
/* joint damping, base to tip [N m s/rad] */
static const real damping[BEAM5_STATIONS] = {
    0.064f, 0.032f, 0.032f, 0.032f, 0.032f
};
static const real gravity = 9.81f; /* gravity along -y [m/s^2] */
static const real hub_inertia = 0.05f; /* hub inertia [kg m^2] */
static const real hub_damping = 0.01f; /* viscous damping of the hub to ground [N m s/rad] */
static const real tip_mass = 0.1f; /* mass at the tip [kg] */
static const real half_step_squared = 5.0000006e-07f; /* step**2/2 [s^2] */
/* angle per unit of acceleration: step**2/4 [s^2] */
static const real angle_per_acceleration = 2.5000003e-07f;
static const real rate_per_acceleration = 0.0005f; /* rate per unit of acceleration: step/2 [s] */
static const real end_mass = 0.05f; /* mass at the tip less the share of a link beyond it [kg] */
/* inertia of a link that masses at its ends leave over [kg m^2] */
static const real rod_inertia = -0.0006666667f;
/* torque of a joint per difference of unknowns [kg m^2] */
static const real joint_impedance[BEAM5_STATIONS] = {
    4.0000006e-05f, 2.0000003e-05f, 2.0000003e-05f, 2.0000003e-05f, 2.0000003e-05f
};
static const real hub_impedance = 0.050005f; /* torque of the hub per unknown [kg m^2] */

beam5_status beam5_initialise(
    beam5_state *state,
    const beam5_real initial_angle[BEAM5_STATIONS],
    const beam5_real initial_rate[BEAM5_STATIONS],
    const beam5_inputs *inputs)
{
    if (state == NULL || inputs == NULL) {
        return BEAM5_NULL_POINTER;
    }
    if (!inputs_are_finite(inputs)) {
        return BEAM5_NON_FINITE_INPUT;
    }
    for (int j = 0; j < BEAM5_STATIONS; ++j) {
        if ((initial_angle != NULL && !isfinite(initial_angle[j]))
            || (initial_rate != NULL && !isfinite(initial_rate[j]))) {
            return BEAM5_NON_FINITE_INPUT;
        }
    }

    real acceleration_x[BEAM5_STATIONS + 1]; /* acceleration of the nodes along x [m/s^2] */
    real acceleration_y[BEAM5_STATIONS + 1]; /* acceleration of the nodes along y [m/s^2] */
    real answer_own[BEAM5_STATIONS]; /* unknown of a station if its inner side kept its motion */
    real answer_x[BEAM5_STATIONS]; /* answer of the unknown to the joint's acceleration along x */
    real answer_y[BEAM5_STATIONS]; /* answer of the unknown to the joint's acceleration along y */
    real lever_cosine[BEAM5_STATIONS]; /* length times cosine of the angle [m] */
    real lever_sine[BEAM5_STATIONS]; /* length times sine of the angle [m] */
    /* acceleration of base and links as predicted [rad/s^2] */
    real predicted_acceleration[BEAM5_STATIONS + 1];
    real predicted_angle[BEAM5_STATIONS + 1]; /* angle of base and links as predicted [rad] */
    real predicted_rate[BEAM5_STATIONS + 1]; /* rate of base and links as predicted [rad/s] */
    real total = 0.0f; /* of the new motion: is all of it finite? */

    /* Masses at the nodes between links, and what they leave over. */
    const real start_end_mass = tip_mass - mass * (1.0f - center);
    const real start_rod_inertia = inertia - center * (length * length) * mass * (1.0f - center);

    /* What is the same at every station. */
    const real hub_pivot = hub_inertia;
    if (!(hub_inertia > 0.0f) || !(hub_inertia <= FLT_MAX)) {
        return BEAM5_VANISHING_PIVOT;
    }

    /* Predicted motion. */
    predicted_rate[0] = 0.0f;
    predicted_angle[0] = 0.0f;
    predicted_acceleration[0] = 0.0f;

    /* Predicted motion; accelerations of the nodes, seen from a falling frame: gravity is the base's own. */
    real node_x = 0.0f;
    real node_y = gravity;
    acceleration_x[0] = node_x;
    acceleration_y[0] = gravity;
    for (int j = 0; j < BEAM5_STATIONS; ++j) {
        predicted_rate[j + 1] = (initial_rate != NULL ? initial_rate[j] : 0.0f);
        predicted_angle[j + 1] = (initial_angle != NULL ? initial_angle[j] : 0.0f);
        predicted_acceleration[j + 1] = 0.0f;
        if (!(fabsf(predicted_angle[j + 1]) <= BEAM5_LARGEST_ANGLE)) {
            return BEAM5_OUT_OF_RANGE;
        }
        const circle turn_1 = circle_of(predicted_angle[j + 1]);
        lever_cosine[j] = length * turn_1.cosine;
        lever_sine[j] = length * turn_1.sine;
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
    real impedance_xx = start_end_mass;
    real impedance_xy = 0.0f;
    real impedance_yx = 0.0f;
    real impedance_yy = start_end_mass;
    real force_x = acceleration_x[5] * start_end_mass;
    real force_y = acceleration_y[5] * start_end_mass;
    real torque = 0.0f;
    for (int j = BEAM5_STATIONS - 1; j >= 0; --j) {
        const real joint_torque = damping[j] * (predicted_rate[j] - predicted_rate[j + 1])
            + stiffness[j] * (predicted_angle[j] - predicted_angle[j + 1]);
        impedance_xx = impedance_xx + mass;
        force_x = force_x + acceleration_x[j + 1] * mass;
        impedance_yy = impedance_yy + mass;
        force_y = force_y + acceleration_y[j + 1] * mass;
        const real impedance_xu = impedance_xy * lever_cosine[j] - impedance_xx * lever_sine[j];
        const real impedance_yu = impedance_yy * lever_cosine[j] - impedance_yx * lever_sine[j];
        const real impedance_ux = impedance_yx * lever_cosine[j] - impedance_xx * lever_sine[j];
        const real impedance_uy = impedance_yy * lever_cosine[j] - impedance_xy * lever_sine[j];
        const real impedance_uu = start_rod_inertia - impedance_xu * lever_sine[j]
            + impedance_yu * lever_cosine[j];
        torque = torque - force_x * lever_sine[j] + force_y * lever_cosine[j]
            + predicted_acceleration[j + 1] * start_rod_inertia;
        if (!(impedance_uu > 0.0f) || !(impedance_uu <= FLT_MAX)) {
            return BEAM5_VANISHING_PIVOT;
        }
        const real admittance = 1.0f / impedance_uu;
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

    /* The base. */
    real unknown = (inputs->hub_torque - torque - hub_damping * predicted_rate[0]
        - hub_inertia * predicted_acceleration[0]) / hub_pivot;
    const real hub_unknown = unknown;

    /* Sweep outward: the unknown of each station. */
    real change_x = 0.0f;
    real change_y = 0.0f;

    /* Sweep outward: the unknown of each station; motion at the end of the step. */
    state->hub_angle = predicted_angle[0];
    state->hub_rate = predicted_rate[0];
    state->hub_acceleration = hub_unknown + predicted_acceleration[0];
    for (int j = 0; j < BEAM5_STATIONS; ++j) {
        unknown = answer_own[j] - answer_x[j] * change_x - answer_y[j] * change_y;
        change_x = change_x - lever_sine[j] * unknown;
        change_y = change_y + lever_cosine[j] * unknown;
        state->angle[j] = predicted_angle[j + 1];
        state->rate[j] = predicted_rate[j + 1];
        state->acceleration[j] = predicted_acceleration[j + 1] + unknown;
        total += state->angle[j] + state->rate[j] + state->acceleration[j];
    }

    if (!isfinite(total + state->hub_angle + state->hub_rate + state->hub_acceleration)) {
        return BEAM5_NON_FINITE_STATE;
    }
    return BEAM5_OK;
}

beam5_status beam5_step(
    beam5_state *state,
    const beam5_inputs *inputs)
{
    if (state == NULL || inputs == NULL) {
        return BEAM5_NULL_POINTER;
    }
    if (!inputs_are_finite(inputs)) {
        return BEAM5_NON_FINITE_INPUT;
    }

    real acceleration_x[BEAM5_STATIONS + 1]; /* acceleration of the nodes along x [m/s^2] */
    real acceleration_y[BEAM5_STATIONS + 1]; /* acceleration of the nodes along y [m/s^2] */
    real answer_own[BEAM5_STATIONS]; /* unknown of a station if its inner side kept its motion */
    real answer_x[BEAM5_STATIONS]; /* answer of the unknown to the joint's acceleration along x */
    real answer_y[BEAM5_STATIONS]; /* answer of the unknown to the joint's acceleration along y */
    real lever_cosine[BEAM5_STATIONS]; /* length times cosine of the angle [m] */
    real lever_sine[BEAM5_STATIONS]; /* length times sine of the angle [m] */
    real predicted_angle[BEAM5_STATIONS + 1]; /* angle of base and links as predicted [rad] */
    real predicted_rate[BEAM5_STATIONS + 1]; /* rate of base and links as predicted [rad/s] */
    real swing_x[BEAM5_STATIONS]; /* change of the outer end's acceleration along x per unknown [m] */
    real swing_y[BEAM5_STATIONS]; /* change of the outer end's acceleration along y per unknown [m] */
    real transmission[BEAM5_STATIONS]; /* share of motion and torque each joint passes on */
    real total = 0.0f; /* of the new motion: is all of it finite? */

    /* Predicted motion. */
    predicted_rate[0] = state->hub_rate + state->hub_acceleration * step;
    predicted_angle[0] = state->hub_angle + half_step_squared * state->hub_acceleration
        + state->hub_rate * step;

    /* Predicted motion; accelerations of the nodes, seen from a falling frame: gravity is the base's own. */
    real node_x = 0.0f;
    real node_y = gravity;
    acceleration_x[0] = node_x;
    acceleration_y[0] = gravity;
    for (int j = 0; j < BEAM5_STATIONS; ++j) {
        predicted_rate[j + 1] = state->rate[j] + state->acceleration[j] * step;
        predicted_angle[j + 1] = state->angle[j] + state->acceleration[j] * half_step_squared
            + state->rate[j] * step;
        if (!(fabsf(predicted_angle[j + 1]) <= BEAM5_LARGEST_ANGLE)) {
            return BEAM5_OUT_OF_RANGE;
        }
        const circle turn_1 = circle_of(predicted_angle[j + 1]);
        lever_cosine[j] = length * turn_1.cosine;
        lever_sine[j] = length * turn_1.sine;
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
    real impedance_xx = end_mass;
    real impedance_xy = 0.0f;
    real impedance_xu = 0.0f;
    real impedance_yx = 0.0f;
    real impedance_yy = end_mass;
    real impedance_yu = 0.0f;
    real impedance_ux = 0.0f;
    real impedance_uy = 0.0f;
    real impedance_uu = 0.0f;
    real force_x = acceleration_x[5] * end_mass;
    real force_y = acceleration_y[5] * end_mass;
    real torque = 0.0f;
    for (int j = BEAM5_STATIONS - 1; j >= 0; --j) {
        const real joint_torque = damping[j] * (predicted_rate[j] - predicted_rate[j + 1])
            + stiffness[j] * (predicted_angle[j] - predicted_angle[j + 1]);
        impedance_xx = impedance_xx + mass;
        force_x = force_x + acceleration_x[j + 1] * mass;
        impedance_yy = impedance_yy + mass;
        force_y = force_y + acceleration_y[j + 1] * mass;
        impedance_xu = impedance_xu + impedance_xx * swing_x[j] + impedance_xy * swing_y[j];
        impedance_yu = impedance_yu + impedance_yx * swing_x[j] + impedance_yy * swing_y[j];
        impedance_uu = impedance_uu + impedance_ux * swing_x[j] + impedance_uy * swing_y[j];
        impedance_ux = impedance_ux - impedance_xx * lever_sine[j] + impedance_yx * lever_cosine[j];
        impedance_uy = impedance_uy - impedance_xy * lever_sine[j] + impedance_yy * lever_cosine[j];
        impedance_uu = impedance_uu + rod_inertia
            + lever_cosine[j] * (impedance_yu - angle_per_acceleration * force_x)
            + lever_sine[j] * (-impedance_xu - angle_per_acceleration * force_y);
        torque = torque + state->acceleration[j] * rod_inertia - force_x * lever_sine[j]
            + force_y * lever_cosine[j];
        const real pivot = impedance_uu + joint_impedance[j];
        if (!(pivot > 0.0f) || !(pivot <= FLT_MAX)) {
            return BEAM5_VANISHING_PIVOT;
        }
        const real admittance = 1.0f / pivot;
        answer_own[j] = admittance * (joint_torque - torque);
        answer_x[j] = admittance * impedance_ux;
        answer_y[j] = admittance * impedance_uy;
        transmission[j] = admittance * joint_impedance[j];
        impedance_xx = impedance_xx - answer_x[j] * impedance_xu;
        impedance_xy = impedance_xy - answer_y[j] * impedance_xu;
        force_x = force_x + answer_own[j] * impedance_xu;
        impedance_xu = impedance_xu * transmission[j];
        impedance_yx = impedance_yx - answer_x[j] * impedance_yu;
        impedance_yy = impedance_yy - answer_y[j] * impedance_yu;
        force_y = force_y + answer_own[j] * impedance_yu;
        impedance_yu = impedance_yu * transmission[j];
        impedance_ux = answer_x[j] * joint_impedance[j];
        impedance_uy = answer_y[j] * joint_impedance[j];
        impedance_uu = impedance_uu * transmission[j];
        torque = joint_torque - answer_own[j] * joint_impedance[j];
    }

    /* The base. */
    const real hub_pivot = hub_impedance + impedance_uu;
    if (!(hub_pivot > 0.0f) || !(hub_pivot <= FLT_MAX)) {
        return BEAM5_VANISHING_PIVOT;
    }
    real unknown = (inputs->hub_torque - torque - state->hub_acceleration * hub_inertia
        - hub_damping * predicted_rate[0]) / hub_pivot;
    const real hub_unknown = unknown;

    /* Sweep outward: the unknown of each station. */
    real change_x = 0.0f;
    real change_y = 0.0f;

    /* Sweep outward: the unknown of each station; motion at the end of the step. */
    state->hub_angle = predicted_angle[0] + angle_per_acceleration * hub_unknown;
    state->hub_rate = predicted_rate[0] + hub_unknown * rate_per_acceleration;
    state->hub_acceleration = state->hub_acceleration + hub_unknown;
    for (int j = 0; j < BEAM5_STATIONS; ++j) {
        unknown = answer_own[j] - answer_x[j] * change_x - answer_y[j] * change_y + transmission[j] * unknown;
        change_x = change_x + swing_x[j] * unknown;
        change_y = change_y + swing_y[j] * unknown;
        state->angle[j] = predicted_angle[j + 1] + angle_per_acceleration * unknown;
        state->rate[j] = predicted_rate[j + 1] + rate_per_acceleration * unknown;
        state->acceleration[j] = state->acceleration[j] + unknown;
        total += state->angle[j] + state->rate[j] + state->acceleration[j];
    }

    if (!isfinite(total + state->hub_angle + state->hub_rate + state->hub_acceleration)) {
        return BEAM5_NON_FINITE_STATE;
    }
    return BEAM5_OK;
}

void beam5_output(
    const beam5_state *state,
    beam5_outputs *outputs)
{
    if (state == NULL || outputs == NULL) {
        return;
    }
    /* Output hub: angle. */
    outputs->hub = state->hub_angle;

    /* Output tip: position. */
    outputs->tip_x = 0.0f;
    outputs->tip_y = 0.0f;
    for (int j = 0; j < BEAM5_STATIONS; ++j) {
        const circle turn_1 = circle_of(state->angle[j]);
        outputs->tip_x = outputs->tip_x + length * turn_1.cosine;
        outputs->tip_y = outputs->tip_y + length * turn_1.sine;
    }
}
