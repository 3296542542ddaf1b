/**
 * fall10: Soft clamped beam falling under its own weight
 *
 * Written by tmm-gen 0.1.0. Do not edit: change the scene and run `tmm-gen build`.
 * scene digest: 7fb53ee7611dfaa9a6a8f9157801d68007a3a764d7f41a8fa8cf16397006e130
 * sha256 of the rest of this file: 1b539393964c28915e59a30f31a8e2bdfce5bc588ac3075ccddfdbd3122761e5
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
 * A test for any machine: the kernel against 30 digits, within what rounding explains.
 *
 * @file test_fall10.c
 */
#include "fall10.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

typedef fall10_real real;

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

static void expect_status(tally *count, const char *what, fall10_status value, fall10_status right)
{
    ++count->checks;
    if (value != right) {
        ++count->failures;
        printf("%s: status is %d, not %d\n", what, (int)value, (int)right);
    }
}

static void test_motion(tally *count)
{
    fall10_params params;
    fall10_model model;
    fall10_state state;
    fall10_inputs inputs;
    fall10_outputs outputs;
    fall10_status status;
    real initial_angle[FALL10_STATIONS];
    real initial_rate[FALL10_STATIONS];

    memset(&state, 0, sizeof state); /* padding too: it is compared below */
    fall10_default_params(&params);
    status = fall10_prepare(&model, &params, FALL10_STEP);
    expect_status(count, "prepare", status, FALL10_OK);

    for (int j = 0; j < FALL10_STATIONS; ++j) {
        initial_angle[j] = (real)((7 * j + 3) % 16 - 8) / 16777216.0;
    }
    for (int j = 0; j < FALL10_STATIONS; ++j) {
        initial_rate[j] = (real)((7 * j + 3) % 16 - 8) / 16777216.0;
    }
    inputs.none = 0.0;
    status = fall10_initialise(&state, &params, initial_angle, initial_rate, &inputs);
    expect_status(count, "initialise", status, FALL10_OK);

    /* Step 1. */
    status = fall10_step(&model, &state, &inputs);
    expect_status(count, "step 1", status, FALL10_OK);
    fall10_output(&model, &state, &outputs);
    expect(count, "tip_x", outputs.tip_x, 0.9999999998953575, 2.7);
    expect(count, "tip_y", outputs.tip_y, -4.943504566712754e-06, 2700000.0);
    expect(count, "speed_x", outputs.speed_x, -4.161242248643103e-07, 7700.0);
    expect(count, "speed_y", outputs.speed_y, -0.009803520901375864, 5400000000.0);
    expect(count, "root", outputs.root, -0.0071923537989688514, 5200000.0);

    /* Step 2. */
    status = fall10_step(&model, &state, &inputs);
    expect_status(count, "step 2", status, FALL10_OK);
    fall10_output(&model, &state, &outputs);
    expect(count, "tip_x", outputs.tip_x, 0.9999999986248969, 2.7);
    expect(count, "tip_y", outputs.tip_y, -1.965358609735469e-05, 2700000.0);
    expect(count, "speed_x", outputs.speed_x, -2.5135849095752867e-06, 7700.0);
    expect(count, "speed_y", outputs.speed_y, -0.019616642105119552, 5400000000.0);
    expect(count, "root", outputs.root, -0.013695589169611085, 5200000.0);

    /* Step 3. */
    status = fall10_step(&model, &state, &inputs);
    expect_status(count, "step 3", status, FALL10_OK);
    fall10_output(&model, &state, &outputs);
    expect(count, "tip_x", outputs.tip_x, 0.9999999940832699, 2.7);
    expect(count, "tip_y", outputs.tip_y, -4.417426879810555e-05, 2700000.0);
    expect(count, "speed_x", outputs.speed_x, -7.10183446968252e-06, 7700.0);
    expect(count, "speed_y", outputs.speed_y, -0.02942472314247692, 5400000000.0);
    expect(count, "root", outputs.root, -0.020293210053701348, 5200000.0);

    /* State after the last step. */
    expect(count, "angle[0]", state.angle[0], -0.0003070284509293782, 16000000.0);
    expect(count, "angle[1]", state.angle[1], -0.00015390553173953627, 16000000.0);
    expect(count, "angle[2]", state.angle[2], -1.9360298547318943e-06, 16000000.0);
    expect(count, "angle[3]", state.angle[3], 1.894976480068906e-05, 16000000.0);
    expect(count, "angle[4]", state.angle[4], 4.053203266792103e-06, 16000000.0);
    expect(count, "angle[5]", state.angle[5], -1.3037213754694043e-06, 16000000.0);
    expect(count, "angle[6]", state.angle[6], -4.822046908619442e-07, 16000000.0);
    expect(count, "angle[7]", state.angle[7], -3.878621281170385e-09, 16000000.0);
    expect(count, "angle[8]", state.angle[8], 4.658243870849402e-08, 16000000.0);
    expect(count, "angle[9]", state.angle[9], -1.324267061817655e-07, 16000000.0);
    expect(count, "rate[0]", state.rate[0], -0.1635671816243945, 31000000000.0);
    expect(count, "rate[1]", state.rate[1], -0.13245768847171996, 31000000000.0);
    expect(count, "rate[2]", state.rate[2], -0.021004953710777024, 31000000000.0);
    expect(count, "rate[3]", state.rate[3], 0.01809266403706673, 31000000000.0);
    expect(count, "rate[4]", state.rate[4], 0.006678194624814257, 31000000000.0);
    expect(count, "rate[5]", state.rate[5], -0.0011868128890295975, 31000000000.0);
    expect(count, "rate[6]", state.rate[6], -0.0009746499151068747, 31000000000.0);
    expect(count, "rate[7]", state.rate[7], 3.465847558013642e-05, 31000000000.0);
    expect(count, "rate[8]", state.rate[8], 6.363615011019497e-05, 31000000000.0);
    expect(count, "rate[9]", state.rate[9], 7.48926237431189e-05, 31000000000.0);
    expect(count, "acceleration[0]", state.acceleration[0], -21.458482844967726, 62000000000000.0);
    expect(count, "acceleration[1]", state.acceleration[1], -57.58405792570898, 62000000000000.0);
    expect(count, "acceleration[2]", state.acceleration[2], -32.623779753035244, 62000000000000.0);
    expect(count, "acceleration[3]", state.acceleration[3], 4.298146888503945, 62000000000000.0);
    expect(count, "acceleration[4]", state.acceleration[4], 10.804648893159365, 62000000000000.0);
    expect(count, "acceleration[5]", state.acceleration[5], -0.23643973065390708, 62000000000000.0);
    expect(count, "acceleration[6]", state.acceleration[6], -1.2905885638838088, 62000000000000.0);
    expect(count, "acceleration[7]", state.acceleration[7], -0.18266456022097177, 62000000000000.0);
    expect(count, "acceleration[8]", state.acceleration[8], 0.17700924966584797, 62000000000000.0);
    expect(count, "acceleration[9]", state.acceleration[9], 0.019333078263037796, 62000000000000.0);
}

static void test_refusals(tally *count)
{
    fall10_params params;
    fall10_model model;
    fall10_status status;

    fall10_default_params(&params);
    status = fall10_prepare(&model, &params, 0.0);
    expect_status(count, "no step", status, FALL10_INVALID_STEP);
    status = fall10_prepare(&model, &params, (real)NAN);
    expect_status(count, "bad step", status, FALL10_INVALID_STEP);

    fall10_default_params(&params);
    params.length = (real)NAN;
    status = fall10_prepare(&model, &params, FALL10_STEP);
    expect_status(count, "bad length", status, FALL10_NON_FINITE_INPUT);

    fall10_default_params(&params);
    params.mass = (real)NAN;
    status = fall10_prepare(&model, &params, FALL10_STEP);
    expect_status(count, "bad mass", status, FALL10_NON_FINITE_INPUT);

    fall10_default_params(&params);
    params.inertia = (real)NAN;
    status = fall10_prepare(&model, &params, FALL10_STEP);
    expect_status(count, "bad inertia", status, FALL10_NON_FINITE_INPUT);

    fall10_default_params(&params);
    params.center = (real)NAN;
    status = fall10_prepare(&model, &params, FALL10_STEP);
    expect_status(count, "bad center", status, FALL10_NON_FINITE_INPUT);

    fall10_default_params(&params);
    params.stiffness[FALL10_STATIONS - 1] = (real)NAN;
    status = fall10_prepare(&model, &params, FALL10_STEP);
    expect_status(count, "bad stiffness", status, FALL10_NON_FINITE_INPUT);

    fall10_default_params(&params);
    params.damping[FALL10_STATIONS - 1] = (real)NAN;
    status = fall10_prepare(&model, &params, FALL10_STEP);
    expect_status(count, "bad damping", status, FALL10_NON_FINITE_INPUT);

    fall10_default_params(&params);
    params.gravity = (real)NAN;
    status = fall10_prepare(&model, &params, FALL10_STEP);
    expect_status(count, "bad gravity", status, FALL10_NON_FINITE_INPUT);
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
