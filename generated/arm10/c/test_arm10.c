/**
 * arm10: Ten-link arm swung by a hub motor
 *
 * Written by tmm-gen 0.2.0. Do not edit: change the scene and run `tmm-gen build`.
 * scene digest: d9d28dc691ae4f0a1d62cb9cfa9f4612d111fa76a756dd286c77eac7f930ab35
 * sha256 of the rest of this file: 6487f261760de83ca390ff54bd5c354a561d153bed0730d2c5de7f3e021f7f3e
 *
 * model: planar arm, large rotations, gravity, tip mass
 * stations: 10
 * base: motor
 * integrator: Newmark 1959, beta = 0.25, gamma = 0.5
 * linearisation: newton
 * sweep: riccati
 * unknown: acceleration
 * operations of a step: 1171, 117.1 per station (541 additions, 599 multiplications, 11 divisions, 20 sines
 *     and cosines)
 * operations of prepare: 77, 7.7 per station (15 additions, 62 multiplications)
 * number type: double
 * bytes of the structs: params 224, model 336, state 264, inputs 16, outputs 32
 *
 * A test for any machine: the kernel against 30 digits, within what rounding explains.
 *
 * @file test_arm10.c
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
#undef hub_torque
#undef tip_force
#undef tip_x
#undef tip_y
#undef hub
#undef root

#include "arm10.h"

typedef arm10_real real;

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
    arm10_status value,
    arm10_status right)
{
    ++count->checks;
    if (value != right) {
        ++count->failures;
        printf("%s: status is %d, not %d\n", what, (int)value, (int)right);
    }
}

static void test_motion(tally *count)
{
    arm10_params params;
    arm10_model model;
    arm10_state state;
    arm10_inputs inputs;
    arm10_outputs outputs;
    arm10_status status;
    real initial_angle[ARM10_STATIONS];
    real initial_rate[ARM10_STATIONS];

    memset(&state, 0, sizeof state); /* padding too: it is compared below */
    arm10_default_params(&params);
    status = arm10_prepare(&model, &params, ARM10_STEP);
    expect_code(count, "prepare", status, ARM10_OK);

    for (int j = 0; j < ARM10_STATIONS; ++j) {
        initial_angle[j] = (real)((7 * j + 3) % 16 - 8) / 64.0;
    }
    for (int j = 0; j < ARM10_STATIONS; ++j) {
        initial_rate[j] = (real)((7 * j + 3) % 16 - 8) / 64.0;
    }
    inputs.hub_torque = -0.375;
    inputs.tip_force = 0.0;
    status = arm10_initialise(&state, &params, initial_angle, initial_rate, &inputs);
    expect_code(count, "initialise", status, ARM10_OK);

    /* Step 1. */
    inputs.hub_torque = 0.25;
    inputs.tip_force = -0.5;
    status = arm10_step(&model, &state, &inputs);
    expect_code(count, "step 1", status, ARM10_OK);
    arm10_output(&model, &state, &outputs);
    expect(count, "tip_x", outputs.tip_x, 0.9979174518326092, 4.9e-15);
    expect(count, "tip_y", outputs.tip_y, -0.010880664560434617, 3e-16);
    expect(count, "hub", outputs.hub, -3.888180620851496e-05, 2.4e-18);
    expect(count, "root", outputs.root, -2.6421388778271626, 3e-14);

    /* Step 2. */
    inputs.hub_torque = -0.25;
    inputs.tip_force = 0.125;
    status = arm10_step(&model, &state, &inputs);
    expect_code(count, "step 2", status, ARM10_OK);
    arm10_output(&model, &state, &outputs);
    expect(count, "tip_x", outputs.tip_x, 0.9986543302037392, 4.9e-15);
    expect(count, "tip_y", outputs.tip_y, -0.010807568816472367, 3e-16);
    expect(count, "hub", outputs.hub, -0.00013800301056501565, 2.4e-18);
    expect(count, "root", outputs.root, -1.6313619341541177, 3e-14);

    /* Step 3. */
    inputs.hub_torque = 0.375;
    inputs.tip_force = -0.375;
    status = arm10_step(&model, &state, &inputs);
    expect_code(count, "step 3", status, ARM10_OK);
    arm10_output(&model, &state, &outputs);
    expect(count, "tip_x", outputs.tip_x, 0.9990198473307055, 4.9e-15);
    expect(count, "tip_y", outputs.tip_y, -0.01074762623368833, 3e-16);
    expect(count, "hub", outputs.hub, -0.0002741687549532674, 2.4e-18);
    expect(count, "root", outputs.root, -1.6337509991897192, 3e-14);

    /* State after the last step. */
    expect(count, "hub_angle", state.hub_angle, -0.0002741687549532674, 2.4e-18);
    expect(count, "hub_rate", state.hub_rate, -0.15185269248053215, 1.5e-15);
    expect(count, "hub_acceleration", state.hub_acceleration, -25.144649445298278, 6.4e-13);
    expect(count, "angle[0]", state.angle[0], -0.04397411693167322, 1.6e-15);
    expect(count, "angle[1]", state.angle[1], -0.03328704665367567, 1.6e-15);
    expect(count, "angle[2]", state.angle[2], -0.07219083885776702, 1.6e-15);
    expect(count, "angle[3]", state.angle[3], 0.0006852108802715843, 1.6e-15);
    expect(count, "angle[4]", state.angle[4], 0.07052149602242849, 1.6e-15);
    expect(count, "angle[5]", state.angle[5], 0.025436561761334967, 1.6e-15);
    expect(count, "angle[6]", state.angle[6], 0.03661232378922562, 1.6e-15);
    expect(count, "angle[7]", state.angle[7], -0.015419792929348577, 1.6e-15);
    expect(count, "angle[8]", state.angle[8], -0.012705971745627972, 1.6e-15);
    expect(count, "angle[9]", state.angle[9], -0.06321077042160098, 1.6e-15);
    expect(count, "rate[0]", state.rate[0], 8.934441714709761, 1.2e-12);
    expect(count, "rate[1]", state.rate[1], -19.215728971750707, 1.2e-12);
    expect(count, "rate[2]", state.rate[2], 16.243172323519513, 1.2e-12);
    expect(count, "rate[3]", state.rate[3], 0.26534397119816444, 1.2e-12);
    expect(count, "rate[4]", state.rate[4], -19.247810458380012, 1.2e-12);
    expect(count, "rate[5]", state.rate[5], 16.66630933871246, 1.2e-12);
    expect(count, "rate[6]", state.rate[6], -3.8716425341656224, 1.2e-12);
    expect(count, "rate[7]", state.rate[7], 5.367441100540439, 1.2e-12);
    expect(count, "rate[8]", state.rate[8], -13.466822671440287, 1.2e-12);
    expect(count, "rate[9]", state.rate[9], 8.986539803794486, 1.2e-12);
    expect(count, "acceleration[0]", state.acceleration[0], -8632.529750536567, 2.4e-09);
    expect(count, "acceleration[1]", state.acceleration[1], 15910.957637966529, 2.4e-09);
    expect(count, "acceleration[2]", state.acceleration[2], -5514.617660538606, 2.4e-09);
    expect(count, "acceleration[3]", state.acceleration[3], -3101.8235401335583, 2.4e-09);
    expect(count, "acceleration[4]", state.acceleration[4], 7343.941095431939, 2.4e-09);
    expect(count, "acceleration[5]", state.acceleration[5], -13033.00199647011, 2.4e-09);
    expect(count, "acceleration[6]", state.acceleration[6], 8675.922547523856, 2.4e-09);
    expect(count, "acceleration[7]", state.acceleration[7], -5806.937826596593, 2.4e-09);
    expect(count, "acceleration[8]", state.acceleration[8], 6972.9230476551675, 2.4e-09);
    expect(count, "acceleration[9]", state.acceleration[9], -2876.835818551366, 2.4e-09);

    /* Bad input is refused and leaves the state alone. */
    arm10_state before;
    memcpy(&before, &state, sizeof before);
    const real bad[] = {(real)NAN, (real)INFINITY, -(real)INFINITY};
    for (int k = 0; k < 3; ++k) {
        real good;
        good = inputs.hub_torque;
        inputs.hub_torque = bad[k];
        status = arm10_step(&model, &state, &inputs);
        expect_code(count, "bad hub_torque", status, ARM10_NON_FINITE_INPUT);
        inputs.hub_torque = good;
        good = inputs.tip_force;
        inputs.tip_force = bad[k];
        status = arm10_step(&model, &state, &inputs);
        expect_code(count, "bad tip_force", status, ARM10_NON_FINITE_INPUT);
        inputs.tip_force = good;
    }
    ++count->checks;
    if (memcmp(&before, &state, sizeof state) != 0) {
        ++count->failures;
        printf("bad input has changed the state\n");
    }
}

static void test_refusals(tally *count)
{
    arm10_params params;
    arm10_model model;
    arm10_status status;

    arm10_default_params(&params);
    status = arm10_prepare(&model, &params, 0.0);
    expect_code(count, "no step", status, ARM10_INVALID_STEP);
    status = arm10_prepare(&model, &params, (real)NAN);
    expect_code(count, "bad step", status, ARM10_INVALID_STEP);

    arm10_default_params(&params);
    params.length = (real)NAN;
    status = arm10_prepare(&model, &params, ARM10_STEP);
    expect_code(count, "bad length", status, ARM10_NON_FINITE_INPUT);

    arm10_default_params(&params);
    params.mass = (real)NAN;
    status = arm10_prepare(&model, &params, ARM10_STEP);
    expect_code(count, "bad mass", status, ARM10_NON_FINITE_INPUT);

    arm10_default_params(&params);
    params.inertia = (real)NAN;
    status = arm10_prepare(&model, &params, ARM10_STEP);
    expect_code(count, "bad inertia", status, ARM10_NON_FINITE_INPUT);

    arm10_default_params(&params);
    params.center = (real)NAN;
    status = arm10_prepare(&model, &params, ARM10_STEP);
    expect_code(count, "bad center", status, ARM10_NON_FINITE_INPUT);

    arm10_default_params(&params);
    params.stiffness[ARM10_STATIONS - 1] = (real)NAN;
    status = arm10_prepare(&model, &params, ARM10_STEP);
    expect_code(count, "bad stiffness", status, ARM10_NON_FINITE_INPUT);

    arm10_default_params(&params);
    params.damping[ARM10_STATIONS - 1] = (real)NAN;
    status = arm10_prepare(&model, &params, ARM10_STEP);
    expect_code(count, "bad damping", status, ARM10_NON_FINITE_INPUT);

    arm10_default_params(&params);
    params.gravity = (real)NAN;
    status = arm10_prepare(&model, &params, ARM10_STEP);
    expect_code(count, "bad gravity", status, ARM10_NON_FINITE_INPUT);

    arm10_default_params(&params);
    params.hub_inertia = (real)NAN;
    status = arm10_prepare(&model, &params, ARM10_STEP);
    expect_code(count, "bad hub_inertia", status, ARM10_NON_FINITE_INPUT);

    arm10_default_params(&params);
    params.hub_damping = (real)NAN;
    status = arm10_prepare(&model, &params, ARM10_STEP);
    expect_code(count, "bad hub_damping", status, ARM10_NON_FINITE_INPUT);

    arm10_default_params(&params);
    params.tip_mass = (real)NAN;
    status = arm10_prepare(&model, &params, ARM10_STEP);
    expect_code(count, "bad tip_mass", status, ARM10_NON_FINITE_INPUT);
}

/* Arrays that are absent are the scene's own; any other pointer that is absent is refused. */
static void test_absent(tally *count)
{
    arm10_params params;
    arm10_model model;
    arm10_state state;
    arm10_inputs inputs;
    arm10_status status;

    memset(&inputs, 0, sizeof inputs);
    arm10_default_params(&params);
    arm10_default_params(NULL);
    status = arm10_prepare(NULL, &params, ARM10_STEP);
    expect_code(count, "no model", status, ARM10_NULL_POINTER);
    status = arm10_prepare(&model, NULL, ARM10_STEP);
    expect_code(count, "no parameters", status, ARM10_NULL_POINTER);
    status = arm10_prepare(&model, &params, ARM10_STEP);
    expect_code(count, "prepare", status, ARM10_OK);
    status = arm10_initialise(NULL, &params, NULL, NULL, &inputs);
    expect_code(count, "no state", status, ARM10_NULL_POINTER);
    status = arm10_initialise(&state, &params, NULL, NULL, &inputs);
    expect_code(count, "the scene's start", status, ARM10_OK);
    status = arm10_step(&model, NULL, &inputs);
    expect_code(count, "no state", status, ARM10_NULL_POINTER);
    status = arm10_step(NULL, &state, &inputs);
    expect_code(count, "no model", status, ARM10_NULL_POINTER);
    status = arm10_initialise(&state, &params, NULL, NULL, NULL);
    expect_code(count, "no inputs", status, ARM10_NULL_POINTER);
    status = arm10_step(&model, &state, NULL);
    expect_code(count, "no inputs", status, ARM10_NULL_POINTER);
    arm10_output(&model, &state, NULL);
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
