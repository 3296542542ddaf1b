/**
 * swing: Flexible arm swung by one radian
 *
 * Written by tmm-gen 0.1.0. Do not edit: change the scene and run `tmm-gen build`.
 * scene digest: 1d772428e2d772ebb733ea95a16abbe042281079aa7667facf050e2b156d94bf
 * sha256 of the rest of this file: a1935f740b1fc3162a7a2ed68df41b4a0801f6fe148c712842f49aa2b122dfcc
 *
 * model: planar arm, large rotations, tip mass
 * stations: 5
 * base: motor
 * integrator: Newmark 1959, beta = 0.25, gamma = 0.5
 * linearisation: newton
 * sweep: riccati
 * unknown: acceleration
 * operations of a step: 595, 119 per station (275 additions, 304 multiplications, 6 divisions, 10 sines and
 *     cosines)
 * operations of prepare: 47, 9.4 per station (10 additions, 37 multiplications)
 * number type: double
 * bytes of the structs: params 136, model 208, state 144, inputs 8, outputs 24
 *
 * A test for any machine: the kernel against 30 digits, within what rounding explains.
 *
 * @file test_swing.c
 */
#include "swing.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

typedef swing_real real;

typedef struct {
    int checks;
    int failures;
} tally;

static void expect(tally *count, const char *what, real value, real right, real tolerance)
{
    ++count->checks;
    if (!(fabs(value - right) <= tolerance)) {
        ++count->failures;
        printf("%s is %.17g, not %.17g within %.2g\n", what, (double)value, (double)right, (double)tolerance);
    }
}

static void expect_status(
    tally *count,
    const char *what,
    swing_status value,
    swing_status right)
{
    ++count->checks;
    if (value != right) {
        ++count->failures;
        printf("%s: status is %d, not %d\n", what, (int)value, (int)right);
    }
}

static void test_motion(tally *count)
{
    swing_params params;
    swing_model model;
    swing_state state;
    swing_inputs inputs;
    swing_outputs outputs;
    swing_status status;
    real initial_angle[SWING_STATIONS];
    real initial_rate[SWING_STATIONS];

    memset(&state, 0, sizeof state); /* padding too: it is compared below */
    swing_default_params(&params);
    status = swing_prepare(&model, &params, SWING_STEP);
    expect_status(count, "prepare", status, SWING_OK);

    for (int j = 0; j < SWING_STATIONS; ++j) {
        initial_angle[j] = (real)((7 * j + 3) % 16 - 8) / 64.0;
    }
    for (int j = 0; j < SWING_STATIONS; ++j) {
        initial_rate[j] = (real)((7 * j + 3) % 16 - 8) / 64.0;
    }
    inputs.hub_torque = -0.375;
    status = swing_initialise(&state, &params, initial_angle, initial_rate, &inputs);
    expect_status(count, "initialise", status, SWING_OK);

    /* Step 1. */
    inputs.hub_torque = 0.25;
    status = swing_step(&model, &state, &inputs);
    expect_status(count, "step 1", status, SWING_OK);
    swing_output(&model, &state, &outputs);
    expect(count, "tip_x", outputs.tip_x, 0.9944888561865907, 9e-15);
    expect(count, "tip_y", outputs.tip_y, -0.006876209878036483, 4.3e-15);
    expect(count, "hub", outputs.hub, -0.00018929673569545764, 1.3e-15);

    /* Step 2. */
    inputs.hub_torque = -0.25;
    status = swing_step(&model, &state, &inputs);
    expect_status(count, "step 2", status, SWING_OK);
    swing_output(&model, &state, &outputs);
    expect(count, "tip_x", outputs.tip_x, 0.9417398026423862, 9e-15);
    expect(count, "tip_y", outputs.tip_y, 0.009808930773380253, 4.3e-15);
    expect(count, "hub", outputs.hub, 0.0021623781127092217, 1.3e-15);

    /* Step 3. */
    inputs.hub_torque = 0.375;
    status = swing_step(&model, &state, &inputs);
    expect_status(count, "step 3", status, SWING_OK);
    swing_output(&model, &state, &outputs);
    expect(count, "tip_x", outputs.tip_x, 0.89744992971305, 9e-15);
    expect(count, "tip_y", outputs.tip_y, 0.027721687178938255, 4.3e-15);
    expect(count, "hub", outputs.hub, 0.007285009529283765, 1.3e-15);

    /* State after the last step. */
    expect(count, "hub_angle", state.hub_angle, 0.007285009529283765, 1.3e-15);
    expect(count, "hub_rate", state.hub_rate, 1.0326639329897624, 2.5e-13);
    expect(count, "hub_acceleration", state.hub_acceleration, -265.3390391386854, 3.3e-11);
    expect(count, "angle[0]", state.angle[0], -0.019154097070595556, 5.9e-14);
    expect(count, "angle[1]", state.angle[1], -0.499891647473002, 5.9e-14);
    expect(count, "angle[2]", state.angle[2], 0.8731757359000331, 5.9e-14);
    expect(count, "angle[3]", state.angle[3], 0.1029698931689304, 5.9e-14);
    expect(count, "angle[4]", state.angle[4], -0.23420431516834836, 5.9e-14);
    expect(count, "rate[0]", state.rate[0], -57.015146546393325, 5.4e-12);
    expect(count, "rate[1]", state.rate[1], 51.35807062333766, 5.4e-12);
    expect(count, "rate[2]", state.rate[2], 30.00667760312016, 5.4e-12);
    expect(count, "rate[3]", state.rate[3], 65.01485768222538, 5.4e-12);
    expect(count, "rate[4]", state.rate[4], -53.617093802221895, 5.4e-12);
    expect(count, "acceleration[0]", state.acceleration[0], -12344.38220788358, 1.3e-09);
    expect(count, "acceleration[1]", state.acceleration[1], 18223.937911735644, 1.3e-09);
    expect(count, "acceleration[2]", state.acceleration[2], -21151.009684135122, 1.3e-09);
    expect(count, "acceleration[3]", state.acceleration[3], 11913.737819000522, 1.3e-09);
    expect(count, "acceleration[4]", state.acceleration[4], -3131.831214149258, 1.3e-09);

    /* Bad input is refused and leaves the state alone. */
    swing_state before;
    memcpy(&before, &state, sizeof before);
    const real bad[] = {(real)NAN, (real)INFINITY, -(real)INFINITY};
    for (int k = 0; k < 3; ++k) {
        const real hub_torque = inputs.hub_torque;
        inputs.hub_torque = bad[k];
        status = swing_step(&model, &state, &inputs);
        expect_status(count, "bad hub_torque", status, SWING_NON_FINITE_INPUT);
        inputs.hub_torque = hub_torque;
    }
    ++count->checks;
    if (memcmp(&before, &state, sizeof state) != 0) {
        ++count->failures;
        printf("bad input has changed the state\n");
    }
}

static void test_refusals(tally *count)
{
    swing_params params;
    swing_model model;
    swing_status status;

    swing_default_params(&params);
    status = swing_prepare(&model, &params, 0.0);
    expect_status(count, "no step", status, SWING_INVALID_STEP);
    status = swing_prepare(&model, &params, (real)NAN);
    expect_status(count, "bad step", status, SWING_INVALID_STEP);

    swing_default_params(&params);
    params.length = (real)NAN;
    status = swing_prepare(&model, &params, SWING_STEP);
    expect_status(count, "bad length", status, SWING_NON_FINITE_INPUT);

    swing_default_params(&params);
    params.mass = (real)NAN;
    status = swing_prepare(&model, &params, SWING_STEP);
    expect_status(count, "bad mass", status, SWING_NON_FINITE_INPUT);

    swing_default_params(&params);
    params.inertia = (real)NAN;
    status = swing_prepare(&model, &params, SWING_STEP);
    expect_status(count, "bad inertia", status, SWING_NON_FINITE_INPUT);

    swing_default_params(&params);
    params.center = (real)NAN;
    status = swing_prepare(&model, &params, SWING_STEP);
    expect_status(count, "bad center", status, SWING_NON_FINITE_INPUT);

    swing_default_params(&params);
    params.stiffness[SWING_STATIONS - 1] = (real)NAN;
    status = swing_prepare(&model, &params, SWING_STEP);
    expect_status(count, "bad stiffness", status, SWING_NON_FINITE_INPUT);

    swing_default_params(&params);
    params.damping[SWING_STATIONS - 1] = (real)NAN;
    status = swing_prepare(&model, &params, SWING_STEP);
    expect_status(count, "bad damping", status, SWING_NON_FINITE_INPUT);

    swing_default_params(&params);
    params.hub_inertia = (real)NAN;
    status = swing_prepare(&model, &params, SWING_STEP);
    expect_status(count, "bad hub_inertia", status, SWING_NON_FINITE_INPUT);

    swing_default_params(&params);
    params.hub_damping = (real)NAN;
    status = swing_prepare(&model, &params, SWING_STEP);
    expect_status(count, "bad hub_damping", status, SWING_NON_FINITE_INPUT);

    swing_default_params(&params);
    params.tip_mass = (real)NAN;
    status = swing_prepare(&model, &params, SWING_STEP);
    expect_status(count, "bad tip_mass", status, SWING_NON_FINITE_INPUT);
}

int main(void)
{
    tally count = {0, 0};

    test_motion(&count);
    test_refusals(&count);
    if (count.failures > 0) {
        printf("%d of %d checks failed\n", count.failures, count.checks);
        return 1;
    }
    printf("%d checks passed\n", count.checks);
    return 0;
}
