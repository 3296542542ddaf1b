/**
 * gripper: Gripper with two fingers on a flexible wrist
 *
 * Written by tmm-gen 0.2.0. Do not edit: change the scene and run `tmm-gen build`.
 * scene digest: c8f8226e93fd9d4e49ccbb14a6d21dfabaa9c32be55619277914a499c6eae156
 * sha256 of the rest of this file: 64e2e83673790fb177d41b5c28c185d315367deef6c7496ee587d6742b24fa47
 *
 * model: planar arm, large rotations, gravity
 * stations: 8
 * base: clamp
 * integrator: Newmark 1959, beta = 0.25, gamma = 0.5
 * linearisation: newton
 * sweep: riccati
 * unknown: acceleration
 * joints in arrays, from 0: left 4, left_hinge 5, right 6, right_hinge 7
 * links in arrays, from 0: wrist 0 to 3, left_finger 4, left_pad 5, right_finger 6, right_pad 7
 * operations of a step: 892, 111.5 per station (404 additions, 464 multiplications, 8 divisions, 16 sines and
 *     cosines)
 * operations of prepare: 148, 18.5 per station (42 additions, 106 multiplications)
 * number type: double
 * bytes of the structs: params 584, model 616, state 192, inputs 16, outputs 48
 *
 * A test for any machine: the kernel against 30 digits, within what rounding explains.
 *
 * @file test_gripper.c
 */
#if defined(__FAST_MATH__) || defined(__ASSOCIATIVE_MATH__) || defined(_M_FP_FAST) \
    || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "-Ofast and -ffast-math remove checks of this file: use -O3, or put -fno-fast-math behind them"
#endif

#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

/* Members of the header below: no macro of a header above may have their names. */
#undef left_torque
#undef right_torque
#undef left_tip_x
#undef left_tip_y
#undef right_tip_x
#undef right_tip_y
#undef left
#undef right

#include "gripper.h"

typedef gripper_real real;

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

static void expect_code(
    tally *count,
    const char *what,
    gripper_status value,
    gripper_status right)
{
    ++count->checks;
    if (value != right) {
        ++count->failures;
        printf("%s: status is %d, not %d\n", what, (int)value, (int)right);
    }
}

static void test_motion(tally *count)
{
    gripper_params params;
    gripper_model model;
    gripper_state state;
    gripper_inputs inputs;
    gripper_outputs outputs;
    gripper_status status;
    real initial_angle[GRIPPER_STATIONS];
    real initial_rate[GRIPPER_STATIONS];

    memset(&state, 0, sizeof state); /* padding too: it is compared below */
    gripper_default_params(&params);
    status = gripper_prepare(&model, &params, GRIPPER_STEP);
    expect_code(count, "prepare", status, GRIPPER_OK);

    for (int j = 0; j < GRIPPER_STATIONS; ++j) {
        initial_angle[j] = (real)((7 * j + 3) % 16 - 8) / 64.0;
    }
    for (int j = 0; j < GRIPPER_STATIONS; ++j) {
        initial_rate[j] = (real)((7 * j + 3) % 16 - 8) / 64.0;
    }
    inputs.left_torque = -0.375;
    inputs.right_torque = 0.0;
    status = gripper_initialise(&state, &params, initial_angle, initial_rate, &inputs);
    expect_code(count, "initialise", status, GRIPPER_OK);

    /* Step 1. */
    inputs.left_torque = 0.25;
    inputs.right_torque = -0.5;
    status = gripper_step(&model, &state, &inputs);
    expect_code(count, "step 1", status, GRIPPER_OK);
    gripper_output(&model, &state, &outputs);
    expect(count, "left_tip_x", outputs.left_tip_x, 0.23922753256306775, 9.1e-16);
    expect(count, "left_tip_y", outputs.left_tip_y, 0.0027224847232369363, 1.7e-16);
    expect(count, "right_tip_x", outputs.right_tip_x, 0.23942608400451557, 9.4e-16);
    expect(count, "right_tip_y", outputs.right_tip_y, -0.0009316356351664623, 1.7e-16);
    expect(count, "left", outputs.left, 0.10857944124100102, 6.8e-16);
    expect(count, "right", outputs.right, 0.07581759748485563, 1.4e-15);

    /* Step 2. */
    inputs.left_torque = -0.25;
    inputs.right_torque = 0.125;
    status = gripper_step(&model, &state, &inputs);
    expect_code(count, "step 2", status, GRIPPER_OK);
    gripper_output(&model, &state, &outputs);
    expect(count, "left_tip_x", outputs.left_tip_x, 0.23893584373726964, 9.1e-16);
    expect(count, "left_tip_y", outputs.left_tip_y, 0.002496377733116894, 1.7e-16);
    expect(count, "right_tip_x", outputs.right_tip_x, 0.23923830559024625, 9.4e-16);
    expect(count, "right_tip_y", outputs.right_tip_y, -0.0009031131606128145, 1.7e-16);
    expect(count, "left", outputs.left, 0.10700040920635824, 6.8e-16);
    expect(count, "right", outputs.right, 0.06980457099456629, 1.4e-15);

    /* Step 3. */
    inputs.left_torque = 0.375;
    inputs.right_torque = -0.375;
    status = gripper_step(&model, &state, &inputs);
    expect_code(count, "step 3", status, GRIPPER_OK);
    gripper_output(&model, &state, &outputs);
    expect(count, "left_tip_x", outputs.left_tip_x, 0.23833673172753786, 9.1e-16);
    expect(count, "left_tip_y", outputs.left_tip_y, 0.0022347855171369435, 1.7e-16);
    expect(count, "right_tip_x", outputs.right_tip_x, 0.238890872665501, 9.4e-16);
    expect(count, "right_tip_y", outputs.right_tip_y, -0.0007139489305274812, 1.7e-16);
    expect(count, "left", outputs.left, 0.10749491042494437, 6.8e-16);
    expect(count, "right", outputs.right, 0.0633676100953071, 1.4e-15);

    /* State after the last step. */
    expect(count, "angle[0]", state.angle[0], -0.07848625255781526, 7.2e-15);
    expect(count, "angle[1]", state.angle[1], -0.05685635436783249, 7.2e-15);
    expect(count, "angle[2]", state.angle[2], -0.07345433166029998, 7.2e-15);
    expect(count, "angle[3]", state.angle[3], 0.050898333806720986, 7.2e-15);
    expect(count, "angle[4]", state.angle[4], 0.15839324423166537, 7.2e-15);
    expect(count, "angle[5]", state.angle[5], -0.1417607094699053, 7.2e-15);
    expect(count, "angle[6]", state.angle[6], 0.11426594390202809, 7.2e-15);
    expect(count, "angle[7]", state.angle[7], -0.12792472807450606, 7.2e-15);
    expect(count, "rate[0]", state.rate[0], -11.542477441284314, 2.2e-11);
    expect(count, "rate[1]", state.rate[1], -60.82191744804474, 2.2e-11);
    expect(count, "rate[2]", state.rate[2], -1.5806056022805681, 2.2e-11);
    expect(count, "rate[3]", state.rate[3], 81.65362219482728, 2.2e-11);
    expect(count, "rate[4]", state.rate[4], 91.76804314866682, 2.2e-11);
    expect(count, "rate[5]", state.rate[5], -212.43031806898838, 2.2e-11);
    expect(count, "rate[6]", state.rate[6], 59.7248018019136, 2.2e-11);
    expect(count, "rate[7]", state.rate[7], -92.57442597078493, 2.2e-11);
    expect(count, "acceleration[0]", state.acceleration[0], -412603.32669742004, 1.5e-07);
    expect(count, "acceleration[1]", state.acceleration[1], 398555.4448173251, 1.5e-07);
    expect(count, "acceleration[2]", state.acceleration[2], 247974.51142034258, 1.5e-07);
    expect(count, "acceleration[3]", state.acceleration[3], -158270.9951450543, 1.5e-07);
    expect(count, "acceleration[4]", state.acceleration[4], -37063.70756643285, 1.5e-07);
    expect(count, "acceleration[5]", state.acceleration[5], 53133.1643411311, 1.5e-07);
    expect(count, "acceleration[6]", state.acceleration[6], -161698.94759494535, 1.5e-07);
    expect(count, "acceleration[7]", state.acceleration[7], 455466.1412043478, 1.5e-07);

    /* Bad input is refused and leaves the state alone. */
    gripper_state before;
    memcpy(&before, &state, sizeof before);
    const real bad[] = {(real)NAN, (real)INFINITY, -(real)INFINITY};
    for (int k = 0; k < 3; ++k) {
        real good;
        good = inputs.left_torque;
        inputs.left_torque = bad[k];
        status = gripper_step(&model, &state, &inputs);
        expect_code(count, "bad left_torque", status, GRIPPER_NON_FINITE_INPUT);
        inputs.left_torque = good;
        good = inputs.right_torque;
        inputs.right_torque = bad[k];
        status = gripper_step(&model, &state, &inputs);
        expect_code(count, "bad right_torque", status, GRIPPER_NON_FINITE_INPUT);
        inputs.right_torque = good;
    }
    ++count->checks;
    if (memcmp(&before, &state, sizeof state) != 0) {
        ++count->failures;
        printf("bad input has changed the state\n");
    }
}

static void test_refusals(tally *count)
{
    gripper_params params;
    gripper_model model;
    gripper_status status;

    gripper_default_params(&params);
    status = gripper_prepare(&model, &params, 0.0);
    expect_code(count, "no step", status, GRIPPER_INVALID_STEP);
    status = gripper_prepare(&model, &params, (real)NAN);
    expect_code(count, "bad step", status, GRIPPER_INVALID_STEP);

    gripper_default_params(&params);
    params.length[GRIPPER_STATIONS - 1] = (real)NAN;
    status = gripper_prepare(&model, &params, GRIPPER_STEP);
    expect_code(count, "bad length", status, GRIPPER_NON_FINITE_INPUT);

    gripper_default_params(&params);
    params.mass[GRIPPER_STATIONS - 1] = (real)NAN;
    status = gripper_prepare(&model, &params, GRIPPER_STEP);
    expect_code(count, "bad mass", status, GRIPPER_NON_FINITE_INPUT);

    gripper_default_params(&params);
    params.inertia[GRIPPER_STATIONS - 1] = (real)NAN;
    status = gripper_prepare(&model, &params, GRIPPER_STEP);
    expect_code(count, "bad inertia", status, GRIPPER_NON_FINITE_INPUT);

    gripper_default_params(&params);
    params.center[GRIPPER_STATIONS - 1] = (real)NAN;
    status = gripper_prepare(&model, &params, GRIPPER_STEP);
    expect_code(count, "bad center", status, GRIPPER_NON_FINITE_INPUT);

    gripper_default_params(&params);
    params.stiffness[GRIPPER_STATIONS - 1] = (real)NAN;
    status = gripper_prepare(&model, &params, GRIPPER_STEP);
    expect_code(count, "bad stiffness", status, GRIPPER_NON_FINITE_INPUT);

    gripper_default_params(&params);
    params.damping[GRIPPER_STATIONS - 1] = (real)NAN;
    status = gripper_prepare(&model, &params, GRIPPER_STEP);
    expect_code(count, "bad damping", status, GRIPPER_NON_FINITE_INPUT);

    gripper_default_params(&params);
    params.rest[GRIPPER_STATIONS - 1] = (real)NAN;
    status = gripper_prepare(&model, &params, GRIPPER_STEP);
    expect_code(count, "bad rest", status, GRIPPER_NON_FINITE_INPUT);

    gripper_default_params(&params);
    params.rotor_inertia[GRIPPER_STATIONS - 1] = (real)NAN;
    status = gripper_prepare(&model, &params, GRIPPER_STEP);
    expect_code(count, "bad rotor_inertia", status, GRIPPER_NON_FINITE_INPUT);

    gripper_default_params(&params);
    params.gear[GRIPPER_STATIONS - 1] = (real)NAN;
    status = gripper_prepare(&model, &params, GRIPPER_STEP);
    expect_code(count, "bad gear", status, GRIPPER_NON_FINITE_INPUT);

    gripper_default_params(&params);
    params.gravity = (real)NAN;
    status = gripper_prepare(&model, &params, GRIPPER_STEP);
    expect_code(count, "bad gravity", status, GRIPPER_NON_FINITE_INPUT);
}

/* Arrays that are absent are the scene's own; any other pointer that is absent is refused. */
static void test_absent(tally *count)
{
    gripper_params params;
    gripper_model model;
    gripper_state state;
    gripper_inputs inputs;
    gripper_status status;

    memset(&inputs, 0, sizeof inputs);
    gripper_default_params(&params);
    gripper_default_params(NULL);
    status = gripper_prepare(NULL, &params, GRIPPER_STEP);
    expect_code(count, "no model", status, GRIPPER_NULL_POINTER);
    status = gripper_prepare(&model, NULL, GRIPPER_STEP);
    expect_code(count, "no parameters", status, GRIPPER_NULL_POINTER);
    status = gripper_prepare(&model, &params, GRIPPER_STEP);
    expect_code(count, "prepare", status, GRIPPER_OK);
    status = gripper_initialise(NULL, &params, NULL, NULL, &inputs);
    expect_code(count, "no state", status, GRIPPER_NULL_POINTER);
    status = gripper_initialise(&state, &params, NULL, NULL, &inputs);
    expect_code(count, "the scene's start", status, GRIPPER_OK);
    status = gripper_step(&model, NULL, &inputs);
    expect_code(count, "no state", status, GRIPPER_NULL_POINTER);
    status = gripper_step(NULL, &state, &inputs);
    expect_code(count, "no model", status, GRIPPER_NULL_POINTER);
    status = gripper_initialise(&state, &params, NULL, NULL, NULL);
    expect_code(count, "no inputs", status, GRIPPER_NULL_POINTER);
    status = gripper_step(&model, &state, NULL);
    expect_code(count, "no inputs", status, GRIPPER_NULL_POINTER);
    gripper_output(&model, &state, NULL);
}

int main(void)
{
    tally count = {0, 0};

    test_motion(&count);
    test_absent(&count);
    test_refusals(&count);
    if (count.failures > 0) {
        printf("%d of %d checks failed\n", count.failures, count.checks);
        return 1;
    }
    printf("%d checks passed\n", count.checks);
    return 0;
}
