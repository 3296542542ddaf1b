/**
 * arm50: Stiff arm of fifty links on a servo
 *
 * Written by tmm-gen 0.2.0. Do not edit: change the scene and run `tmm-gen build`.
 * scene digest: 7e2e87b8a48332cf3886a22711bd9428eeea692a0d70cc5ae1662962d37ffc57
 * sha256 of the rest of this file: 2098ae153ce9b2c421d88a7aac7a51581c50462150a3068838a214671a9511c5
 *
 * model: planar arm, large rotations, tip mass
 * stations: 50
 * base: prescribed
 * integrator: SDIRK, order 4, 5 stages (Hairer & Wanner 1996)
 * linearisation: newton
 * sweep: riccati
 * unknown: acceleration
 * operations of a step: 29465, 589.3 per station (13600 additions, 15115 multiplications, 250 divisions, 500
 *     sines and cosines)
 * operations of prepare: 329, 6.58 per station (55 additions, 274 multiplications)
 * number type: double
 * bytes of the structs: params 848, model 1392, state 1216, inputs 120, outputs 48
 *
 * A test for any machine: the kernel against 30 digits, within what rounding explains.
 *
 * @file test_arm50.c
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
#undef base_angle
#undef base_angle_rate
#undef base_angle_acceleration
#undef tip_x
#undef tip_y
#undef tip_angle
#undef reaction_x
#undef reaction_y
#undef drive

#include "arm50.h"

typedef arm50_real real;

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
    arm50_status value,
    arm50_status right)
{
    ++count->checks;
    if (value != right) {
        ++count->failures;
        printf("%s: status is %d, not %d\n", what, (int)value, (int)right);
    }
}

static void test_motion(tally *count)
{
    arm50_params params;
    arm50_model model;
    arm50_state state;
    arm50_inputs inputs;
    arm50_outputs outputs;
    arm50_status status;
    real initial_angle[ARM50_STATIONS];
    real initial_rate[ARM50_STATIONS];

    memset(&state, 0, sizeof state); /* padding too: it is compared below */
    arm50_default_params(&params);
    status = arm50_prepare(&model, &params, ARM50_STEP);
    expect_code(count, "prepare", status, ARM50_OK);

    for (int j = 0; j < ARM50_STATIONS; ++j) {
        initial_angle[j] = (real)((7 * j + 3) % 16 - 8) / 16777216.0;
    }
    for (int j = 0; j < ARM50_STATIONS; ++j) {
        initial_rate[j] = (real)((7 * j + 3) % 16 - 8) / 16777216.0;
    }
    inputs.base_angle[0] = -1.430511474609375e-06;
    inputs.base_angle[1] = -4.76837158203125e-07;
    inputs.base_angle[2] = 4.76837158203125e-07;
    inputs.base_angle[3] = 1.430511474609375e-06;
    inputs.base_angle[4] = -1.9073486328125e-06;
    inputs.base_angle_rate[0] = 0.0;
    inputs.base_angle_rate[1] = 9.5367431640625e-07;
    inputs.base_angle_rate[2] = 1.9073486328125e-06;
    inputs.base_angle_rate[3] = -1.430511474609375e-06;
    inputs.base_angle_rate[4] = -4.76837158203125e-07;
    inputs.base_angle_acceleration[0] = 1.430511474609375e-06;
    inputs.base_angle_acceleration[1] = -1.9073486328125e-06;
    inputs.base_angle_acceleration[2] = -9.5367431640625e-07;
    inputs.base_angle_acceleration[3] = 0.0;
    inputs.base_angle_acceleration[4] = 9.5367431640625e-07;
    status = arm50_initialise(&state, &params, initial_angle, initial_rate, &inputs);
    expect_code(count, "initialise", status, ARM50_OK);

    /* Step 1. */
    inputs.base_angle[0] = 9.5367431640625e-07;
    inputs.base_angle[1] = 1.9073486328125e-06;
    inputs.base_angle[2] = -1.430511474609375e-06;
    inputs.base_angle[3] = -4.76837158203125e-07;
    inputs.base_angle[4] = 4.76837158203125e-07;
    inputs.base_angle_rate[0] = -1.9073486328125e-06;
    inputs.base_angle_rate[1] = -9.5367431640625e-07;
    inputs.base_angle_rate[2] = 0.0;
    inputs.base_angle_rate[3] = 9.5367431640625e-07;
    inputs.base_angle_rate[4] = 1.9073486328125e-06;
    inputs.base_angle_acceleration[0] = -4.76837158203125e-07;
    inputs.base_angle_acceleration[1] = 4.76837158203125e-07;
    inputs.base_angle_acceleration[2] = 1.430511474609375e-06;
    inputs.base_angle_acceleration[3] = -1.9073486328125e-06;
    inputs.base_angle_acceleration[4] = -9.5367431640625e-07;
    status = arm50_step(&model, &state, &inputs);
    expect_code(count, "step 1", status, ARM50_OK);
    arm50_output(&model, &state, &outputs);
    expect(count, "tip_x", outputs.tip_x, 0.7999999999942251, 9.4e-15);
    expect(count, "tip_y", outputs.tip_y, -2.880113430839688e-08, 1.8e-16);
    expect(count, "tip_angle", outputs.tip_angle, -2.381432336305946e-08, 1.6e-15);
    expect(count, "reaction_x", outputs.reaction_x, -4.975183846760653e-05, 9.1e-15);
    expect(count, "reaction_y", outputs.reaction_y, 1.6583070962886979, 3.5e-11);
    expect(count, "drive", outputs.drive, -0.08772188480999438, 2.9e-12);

    /* Step 2. */
    inputs.base_angle[0] = -9.5367431640625e-07;
    inputs.base_angle[1] = 0.0;
    inputs.base_angle[2] = 9.5367431640625e-07;
    inputs.base_angle[3] = 1.9073486328125e-06;
    inputs.base_angle[4] = -1.430511474609375e-06;
    inputs.base_angle_rate[0] = 4.76837158203125e-07;
    inputs.base_angle_rate[1] = 1.430511474609375e-06;
    inputs.base_angle_rate[2] = -1.9073486328125e-06;
    inputs.base_angle_rate[3] = -9.5367431640625e-07;
    inputs.base_angle_rate[4] = 0.0;
    inputs.base_angle_acceleration[0] = 1.9073486328125e-06;
    inputs.base_angle_acceleration[1] = -1.430511474609375e-06;
    inputs.base_angle_acceleration[2] = -4.76837158203125e-07;
    inputs.base_angle_acceleration[3] = 4.76837158203125e-07;
    inputs.base_angle_acceleration[4] = 1.430511474609375e-06;
    status = arm50_step(&model, &state, &inputs);
    expect_code(count, "step 2", status, ARM50_OK);
    arm50_output(&model, &state, &outputs);
    expect(count, "tip_x", outputs.tip_x, 0.7999999999931233, 9.4e-15);
    expect(count, "tip_y", outputs.tip_y, 4.799431743542084e-09, 1.8e-16);
    expect(count, "tip_angle", outputs.tip_angle, -3.823199472629874e-06, 1.6e-15);
    expect(count, "reaction_x", outputs.reaction_x, -1.6342636196468835e-05, 9.1e-15);
    expect(count, "reaction_y", outputs.reaction_y, 0.8010694573375713, 3.5e-11);
    expect(count, "drive", outputs.drive, -0.04984730647904703, 2.9e-12);

    /* Step 3. */
    inputs.base_angle[0] = 1.430511474609375e-06;
    inputs.base_angle[1] = -1.9073486328125e-06;
    inputs.base_angle[2] = -9.5367431640625e-07;
    inputs.base_angle[3] = 0.0;
    inputs.base_angle[4] = 9.5367431640625e-07;
    inputs.base_angle_rate[0] = -1.430511474609375e-06;
    inputs.base_angle_rate[1] = -4.76837158203125e-07;
    inputs.base_angle_rate[2] = 4.76837158203125e-07;
    inputs.base_angle_rate[3] = 1.430511474609375e-06;
    inputs.base_angle_rate[4] = -1.9073486328125e-06;
    inputs.base_angle_acceleration[0] = 0.0;
    inputs.base_angle_acceleration[1] = 9.5367431640625e-07;
    inputs.base_angle_acceleration[2] = 1.9073486328125e-06;
    inputs.base_angle_acceleration[3] = -1.430511474609375e-06;
    inputs.base_angle_acceleration[4] = -4.76837158203125e-07;
    status = arm50_step(&model, &state, &inputs);
    expect_code(count, "step 3", status, ARM50_OK);
    arm50_output(&model, &state, &outputs);
    expect(count, "tip_x", outputs.tip_x, 0.7999999999914352, 9.4e-15);
    expect(count, "tip_y", outputs.tip_y, 4.1740593813060265e-07, 1.8e-16);
    expect(count, "tip_angle", outputs.tip_angle, 1.1947586103501569e-05, 1.6e-15);
    expect(count, "reaction_x", outputs.reaction_x, -3.46850610367445e-05, 9.1e-15);
    expect(count, "reaction_y", outputs.reaction_y, 1.2065779130309793, 3.5e-11);
    expect(count, "drive", outputs.drive, -0.06330408711891466, 2.9e-12);

    /* State after the last step. */
    expect(count, "hub_angle", state.hub_angle, 9.5367431640625e-07, 1.3e-21);
    expect(count, "hub_rate", state.hub_rate, -1.9073486328125e-06, 1.7e-21);
    expect(count, "angle[0]", state.angle[0], -4.539565732191602e-06, 1.6e-15);
    expect(count, "angle[5]", state.angle[5], -3.956546575790395e-06, 1.6e-15);
    expect(count, "angle[11]", state.angle[11], -4.796837239535226e-07, 1.6e-15);
    expect(count, "angle[16]", state.angle[16], -2.6546920916122985e-06, 1.6e-15);
    expect(count, "angle[22]", state.angle[22], -3.0298265300403506e-06, 1.6e-15);
    expect(count, "angle[27]", state.angle[27], -7.458709921883524e-07, 1.6e-15);
    expect(count, "angle[33]", state.angle[33], 1.114851559683051e-06, 1.6e-15);
    expect(count, "angle[38]", state.angle[38], 3.087764394122053e-06, 1.6e-15);
    expect(count, "angle[44]", state.angle[44], 8.016937494330643e-06, 1.6e-15);
    expect(count, "angle[49]", state.angle[49], 1.1947586103501569e-05, 1.6e-15);
    expect(count, "rate[0]", state.rate[0], 0.03467318525929301, 1.1e-12);
    expect(count, "rate[5]", state.rate[5], -0.016224749386546555, 1.1e-12);
    expect(count, "rate[11]", state.rate[11], 0.003585162103440013, 1.1e-12);
    expect(count, "rate[16]", state.rate[16], 0.00917889585647528, 1.1e-12);
    expect(count, "rate[22]", state.rate[22], -0.006123253942813842, 1.1e-12);
    expect(count, "rate[27]", state.rate[27], -0.007726695006370253, 1.1e-12);
    expect(count, "rate[33]", state.rate[33], 0.0004873793077872551, 1.1e-12);
    expect(count, "rate[38]", state.rate[38], 0.0028068407308045463, 1.1e-12);
    expect(count, "rate[44]", state.rate[44], 0.0026118045378037366, 1.1e-12);
    expect(count, "rate[49]", state.rate[49], 0.0045518233250874465, 1.1e-12);
    expect(count, "acceleration[0]", state.acceleration[0], 179.70729161238492, 4.1e-09);
    expect(count, "acceleration[5]", state.acceleration[5], -30.443323284468278, 4.1e-09);
    expect(count, "acceleration[11]", state.acceleration[11], -72.28874998114266, 4.1e-09);
    expect(count, "acceleration[16]", state.acceleration[16], 18.974478206772346, 4.1e-09);
    expect(count, "acceleration[22]", state.acceleration[22], 23.352935785639918, 4.1e-09);
    expect(count, "acceleration[27]", state.acceleration[27], -16.82480042218215, 4.1e-09);
    expect(count, "acceleration[33]", state.acceleration[33], -5.240542270804542, 4.1e-09);
    expect(count, "acceleration[38]", state.acceleration[38], 15.07954074752109, 4.1e-09);
    expect(count, "acceleration[44]", state.acceleration[44], 0.9380284293603288, 4.1e-09);
    expect(count, "acceleration[49]", state.acceleration[49], -22.482039284403584, 4.1e-09);

    /* Bad input is refused and leaves the state alone. */
    arm50_state before;
    memcpy(&before, &state, sizeof before);
    const real bad[] = {(real)NAN, (real)INFINITY, -(real)INFINITY};
    for (int k = 0; k < 3; ++k) {
        real good;
        good = inputs.base_angle[ARM50_STAGES - 1];
        inputs.base_angle[ARM50_STAGES - 1] = bad[k];
        status = arm50_step(&model, &state, &inputs);
        expect_code(count, "bad base_angle", status, ARM50_NON_FINITE_INPUT);
        inputs.base_angle[ARM50_STAGES - 1] = good;
        good = inputs.base_angle_rate[ARM50_STAGES - 1];
        inputs.base_angle_rate[ARM50_STAGES - 1] = bad[k];
        status = arm50_step(&model, &state, &inputs);
        expect_code(count, "bad base_angle_rate", status, ARM50_NON_FINITE_INPUT);
        inputs.base_angle_rate[ARM50_STAGES - 1] = good;
        good = inputs.base_angle_acceleration[ARM50_STAGES - 1];
        inputs.base_angle_acceleration[ARM50_STAGES - 1] = bad[k];
        status = arm50_step(&model, &state, &inputs);
        expect_code(count, "bad base_angle_acceleration", status, ARM50_NON_FINITE_INPUT);
        inputs.base_angle_acceleration[ARM50_STAGES - 1] = good;
    }
    ++count->checks;
    if (memcmp(&before, &state, sizeof state) != 0) {
        ++count->failures;
        printf("bad input has changed the state\n");
    }
}

static void test_refusals(tally *count)
{
    arm50_params params;
    arm50_model model;
    arm50_status status;

    arm50_default_params(&params);
    status = arm50_prepare(&model, &params, 0.0);
    expect_code(count, "no step", status, ARM50_INVALID_STEP);
    status = arm50_prepare(&model, &params, (real)NAN);
    expect_code(count, "bad step", status, ARM50_INVALID_STEP);

    arm50_default_params(&params);
    params.length = (real)NAN;
    status = arm50_prepare(&model, &params, ARM50_STEP);
    expect_code(count, "bad length", status, ARM50_NON_FINITE_INPUT);

    arm50_default_params(&params);
    params.mass = (real)NAN;
    status = arm50_prepare(&model, &params, ARM50_STEP);
    expect_code(count, "bad mass", status, ARM50_NON_FINITE_INPUT);

    arm50_default_params(&params);
    params.inertia = (real)NAN;
    status = arm50_prepare(&model, &params, ARM50_STEP);
    expect_code(count, "bad inertia", status, ARM50_NON_FINITE_INPUT);

    arm50_default_params(&params);
    params.center = (real)NAN;
    status = arm50_prepare(&model, &params, ARM50_STEP);
    expect_code(count, "bad center", status, ARM50_NON_FINITE_INPUT);

    arm50_default_params(&params);
    params.stiffness[ARM50_STATIONS - 1] = (real)NAN;
    status = arm50_prepare(&model, &params, ARM50_STEP);
    expect_code(count, "bad stiffness", status, ARM50_NON_FINITE_INPUT);

    arm50_default_params(&params);
    params.damping[ARM50_STATIONS - 1] = (real)NAN;
    status = arm50_prepare(&model, &params, ARM50_STEP);
    expect_code(count, "bad damping", status, ARM50_NON_FINITE_INPUT);

    arm50_default_params(&params);
    params.tip_mass = (real)NAN;
    status = arm50_prepare(&model, &params, ARM50_STEP);
    expect_code(count, "bad tip_mass", status, ARM50_NON_FINITE_INPUT);

    arm50_default_params(&params);
    params.tip_inertia = (real)NAN;
    status = arm50_prepare(&model, &params, ARM50_STEP);
    expect_code(count, "bad tip_inertia", status, ARM50_NON_FINITE_INPUT);
}

/* Arrays that are absent are the scene's own; any other pointer that is absent is refused. */
static void test_absent(tally *count)
{
    arm50_params params;
    arm50_model model;
    arm50_state state;
    arm50_inputs inputs;
    arm50_status status;

    memset(&inputs, 0, sizeof inputs);
    arm50_default_params(&params);
    arm50_default_params(NULL);
    status = arm50_prepare(NULL, &params, ARM50_STEP);
    expect_code(count, "no model", status, ARM50_NULL_POINTER);
    status = arm50_prepare(&model, NULL, ARM50_STEP);
    expect_code(count, "no parameters", status, ARM50_NULL_POINTER);
    status = arm50_prepare(&model, &params, ARM50_STEP);
    expect_code(count, "prepare", status, ARM50_OK);
    status = arm50_initialise(NULL, &params, NULL, NULL, &inputs);
    expect_code(count, "no state", status, ARM50_NULL_POINTER);
    status = arm50_initialise(&state, &params, NULL, NULL, &inputs);
    expect_code(count, "the scene's start", status, ARM50_OK);
    status = arm50_step(&model, NULL, &inputs);
    expect_code(count, "no state", status, ARM50_NULL_POINTER);
    status = arm50_step(NULL, &state, &inputs);
    expect_code(count, "no model", status, ARM50_NULL_POINTER);
    status = arm50_initialise(&state, &params, NULL, NULL, NULL);
    expect_code(count, "no inputs", status, ARM50_NULL_POINTER);
    status = arm50_step(&model, &state, NULL);
    expect_code(count, "no inputs", status, ARM50_NULL_POINTER);
    arm50_output(&model, &state, NULL);
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
