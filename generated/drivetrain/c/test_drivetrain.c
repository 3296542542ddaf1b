/**
 * drivetrain: Servo drive with gearbox, roller, brake and encoder
 *
 * Written by tmm-gen 0.2.0. Do not edit: change the scene and run `tmm-gen build`.
 * scene digest: 260c88ca5ffe6b93ea5946fad67187e547942573db1dc2f710bcd9a0610b8738
 * sha256 of the rest of this file: ad88648cc951cf1b59d1472bee40673ee94d812072fc16b9e11c734d10d8c4b1
 *
 * model: torsional chain (linear)
 * stations: 6
 * base: motor
 * integrator: Generalised alpha (Chung & Hulbert 1993), rho_inf = 0.8
 * sweep: riccati
 * unknown: acceleration
 * operations of a step: 215, 35.83 per station (107 additions, 108 multiplications)
 * operations of prepare: 88, 14.67 per station (20 additions, 61 multiplications, 7 divisions)
 * number type: double
 * bytes of the structs: params 160, model 320, state 168, inputs 16, outputs 32
 *
 * A test for any machine: the kernel against 30 digits, within what rounding explains.
 *
 * @file test_drivetrain.c
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
#undef motor_torque
#undef load_torque
#undef motor_speed
#undef roller_speed
#undef shaft_torque
#undef encoder

#include "drivetrain.h"

typedef drivetrain_real real;

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
    drivetrain_status value,
    drivetrain_status right)
{
    ++count->checks;
    if (value != right) {
        ++count->failures;
        printf("%s: status is %d, not %d\n", what, (int)value, (int)right);
    }
}

static void test_motion(tally *count)
{
    drivetrain_params params;
    drivetrain_model model;
    drivetrain_state state;
    drivetrain_inputs inputs;
    drivetrain_outputs outputs;
    drivetrain_status status;
    real initial_angle[DRIVETRAIN_STATIONS];
    real initial_rate[DRIVETRAIN_STATIONS];

    memset(&state, 0, sizeof state); /* padding too: it is compared below */
    drivetrain_default_params(&params);
    status = drivetrain_prepare(&model, &params, DRIVETRAIN_STEP);
    expect_code(count, "prepare", status, DRIVETRAIN_OK);

    for (int j = 0; j < DRIVETRAIN_STATIONS; ++j) {
        initial_angle[j] = (real)((7 * j + 3) % 16 - 8) / 64.0;
    }
    for (int j = 0; j < DRIVETRAIN_STATIONS; ++j) {
        initial_rate[j] = (real)((7 * j + 3) % 16 - 8) / 64.0;
    }
    inputs.motor_torque = -0.375;
    inputs.load_torque = 0.0;
    status = drivetrain_initialise(&state, &params, initial_angle, initial_rate, &inputs);
    expect_code(count, "initialise", status, DRIVETRAIN_OK);

    /* Step 1. */
    inputs.motor_torque = 0.25;
    inputs.load_torque = -0.5;
    status = drivetrain_step(&model, &state, &inputs);
    expect_code(count, "step 1", status, DRIVETRAIN_OK);
    drivetrain_output(&model, &state, &outputs);
    expect(count, "motor_speed", outputs.motor_speed, -61.024806447828844, 5.4e-13);
    expect(count, "roller_speed", outputs.roller_speed, -0.09904640937712796, 1.6e-14);
    expect(count, "shaft_torque", outputs.shaft_torque, 167.6346636174372, 7.7e-13);
    expect(count, "encoder", outputs.encoder, -0.02611482485798894, 3e-16);

    /* Step 2. */
    inputs.motor_torque = -0.25;
    inputs.load_torque = 0.125;
    status = drivetrain_step(&model, &state, &inputs);
    expect_code(count, "step 2", status, DRIVETRAIN_OK);
    drivetrain_output(&model, &state, &outputs);
    expect(count, "motor_speed", outputs.motor_speed, -98.77387702963955, 5.4e-13);
    expect(count, "roller_speed", outputs.roller_speed, 0.11255501683301643, 1.6e-14);
    expect(count, "shaft_torque", outputs.shaft_torque, 96.8496758239049, 7.7e-13);
    expect(count, "encoder", outputs.encoder, -0.011162430095813669, 3e-16);

    /* Step 3. */
    inputs.motor_torque = 0.375;
    inputs.load_torque = -0.375;
    status = drivetrain_step(&model, &state, &inputs);
    expect_code(count, "step 3", status, DRIVETRAIN_OK);
    drivetrain_output(&model, &state, &outputs);
    expect(count, "motor_speed", outputs.motor_speed, -111.46094748328005, 5.4e-13);
    expect(count, "roller_speed", outputs.roller_speed, 0.6278515733339045, 1.6e-14);
    expect(count, "shaft_torque", outputs.shaft_torque, 44.880339023435965, 7.7e-13);
    expect(count, "encoder", outputs.encoder, 0.012321368558414677, 3e-16);

    /* State after the last step. */
    expect(count, "hub_angle", state.hub_angle, -0.021532709670283718, 1.3e-16);
    expect(count, "hub_rate", state.hub_rate, -111.46094748328005, 5.4e-13);
    expect(count, "hub_acceleration", state.hub_acceleration, -39908.70737376771, 5.3e-09);
    expect(count, "angle[0]", state.angle[0], -0.02463023044911083, 5.4e-16);
    expect(count, "angle[1]", state.angle[1], -0.11715231892466477, 5.4e-16);
    expect(count, "angle[2]", state.angle[2], -0.03542834886844454, 5.4e-16);
    expect(count, "angle[3]", state.angle[3], 3.3004812831880204e-05, 5.4e-16);
    expect(count, "angle[4]", state.angle[4], 0.1057981039837523, 5.4e-16);
    expect(count, "angle[5]", state.angle[5], 0.012321368558414677, 5.4e-16);
    expect(count, "rate[0]", state.rate[0], 24.71642241167215, 4.2e-12);
    expect(count, "rate[1]", state.rate[1], -364.1218995833173, 4.2e-12);
    expect(count, "rate[2]", state.rate[2], 261.0515349645026, 4.2e-12);
    expect(count, "rate[3]", state.rate[3], 0.6278515733339045, 4.2e-12);
    expect(count, "rate[4]", state.rate[4], -23.670663400815847, 4.2e-12);
    expect(count, "rate[5]", state.rate[5], 273.43303562716665, 4.2e-12);
    expect(count, "acceleration[0]", state.acceleration[0], -1974030.6133621156, 6e-08);
    expect(count, "acceleration[1]", state.acceleration[1], 5092740.739935137, 6e-08);
    expect(count, "acceleration[2]", state.acceleration[2], -1662098.2416419468, 6e-08);
    expect(count, "acceleration[3]", state.acceleration[3], 6165.752084388428, 6e-08);
    expect(count, "acceleration[4]", state.acceleration[4], -75701.5165144554, 6e-08);
    expect(count, "acceleration[5]", state.acceleration[5], 695859.6222743149, 6e-08);

    /* Bad input is refused and leaves the state alone. */
    drivetrain_state before;
    memcpy(&before, &state, sizeof before);
    const real bad[] = {(real)NAN, (real)INFINITY, -(real)INFINITY};
    for (int k = 0; k < 3; ++k) {
        real good;
        good = inputs.motor_torque;
        inputs.motor_torque = bad[k];
        status = drivetrain_step(&model, &state, &inputs);
        expect_code(count, "bad motor_torque", status, DRIVETRAIN_NON_FINITE_INPUT);
        inputs.motor_torque = good;
        good = inputs.load_torque;
        inputs.load_torque = bad[k];
        status = drivetrain_step(&model, &state, &inputs);
        expect_code(count, "bad load_torque", status, DRIVETRAIN_NON_FINITE_INPUT);
        inputs.load_torque = good;
    }
    ++count->checks;
    if (memcmp(&before, &state, sizeof state) != 0) {
        ++count->failures;
        printf("bad input has changed the state\n");
    }
}

static void test_refusals(tally *count)
{
    drivetrain_params params;
    drivetrain_model model;
    drivetrain_status status;

    drivetrain_default_params(&params);
    status = drivetrain_prepare(&model, &params, 0.0);
    expect_code(count, "no step", status, DRIVETRAIN_INVALID_STEP);
    status = drivetrain_prepare(&model, &params, (real)NAN);
    expect_code(count, "bad step", status, DRIVETRAIN_INVALID_STEP);

    drivetrain_default_params(&params);
    params.stiffness[DRIVETRAIN_STATIONS - 1] = (real)NAN;
    status = drivetrain_prepare(&model, &params, DRIVETRAIN_STEP);
    expect_code(count, "bad stiffness", status, DRIVETRAIN_NON_FINITE_INPUT);

    drivetrain_default_params(&params);
    params.damping[DRIVETRAIN_STATIONS - 1] = (real)NAN;
    status = drivetrain_prepare(&model, &params, DRIVETRAIN_STEP);
    expect_code(count, "bad damping", status, DRIVETRAIN_NON_FINITE_INPUT);

    drivetrain_default_params(&params);
    params.inertia[DRIVETRAIN_STATIONS - 1] = (real)NAN;
    status = drivetrain_prepare(&model, &params, DRIVETRAIN_STEP);
    expect_code(count, "bad inertia", status, DRIVETRAIN_NON_FINITE_INPUT);

    drivetrain_default_params(&params);
    params.hub_inertia = (real)NAN;
    status = drivetrain_prepare(&model, &params, DRIVETRAIN_STEP);
    expect_code(count, "bad hub_inertia", status, DRIVETRAIN_NON_FINITE_INPUT);

    drivetrain_default_params(&params);
    params.hub_damping = (real)NAN;
    status = drivetrain_prepare(&model, &params, DRIVETRAIN_STEP);
    expect_code(count, "bad hub_damping", status, DRIVETRAIN_NON_FINITE_INPUT);
}

/* Arrays that are absent are the scene's own; any other pointer that is absent is refused. */
static void test_absent(tally *count)
{
    drivetrain_params params;
    drivetrain_model model;
    drivetrain_state state;
    drivetrain_inputs inputs;
    drivetrain_status status;

    memset(&inputs, 0, sizeof inputs);
    drivetrain_default_params(&params);
    drivetrain_default_params(NULL);
    status = drivetrain_prepare(NULL, &params, DRIVETRAIN_STEP);
    expect_code(count, "no model", status, DRIVETRAIN_NULL_POINTER);
    status = drivetrain_prepare(&model, NULL, DRIVETRAIN_STEP);
    expect_code(count, "no parameters", status, DRIVETRAIN_NULL_POINTER);
    status = drivetrain_prepare(&model, &params, DRIVETRAIN_STEP);
    expect_code(count, "prepare", status, DRIVETRAIN_OK);
    status = drivetrain_initialise(NULL, &params, NULL, NULL, &inputs);
    expect_code(count, "no state", status, DRIVETRAIN_NULL_POINTER);
    status = drivetrain_initialise(&state, &params, NULL, NULL, &inputs);
    expect_code(count, "the scene's start", status, DRIVETRAIN_OK);
    status = drivetrain_step(&model, NULL, &inputs);
    expect_code(count, "no state", status, DRIVETRAIN_NULL_POINTER);
    status = drivetrain_step(NULL, &state, &inputs);
    expect_code(count, "no model", status, DRIVETRAIN_NULL_POINTER);
    status = drivetrain_initialise(&state, &params, NULL, NULL, NULL);
    expect_code(count, "no inputs", status, DRIVETRAIN_NULL_POINTER);
    status = drivetrain_step(&model, &state, NULL);
    expect_code(count, "no inputs", status, DRIVETRAIN_NULL_POINTER);
    drivetrain_output(&model, &state, NULL);
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
