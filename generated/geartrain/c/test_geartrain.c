/**
 * geartrain: Servo with two stages of gears on a table and a feeder
 *
 * Written by tmm-gen 0.2.0. Do not edit: change the scene and run `tmm-gen build`.
 * scene digest: 066060c018d378c5aa38f61f583a4ed37c9ee269f8287dfe93f42445474eebe1
 * sha256 of the rest of this file: d067ff09f197803cdb7b52c8640e96617bc82d559707f023f04a0b00dfccf774
 *
 * model: torsional chain (linear)
 * stations: 4
 * base: motor
 * integrator: Generalised alpha (Chung & Hulbert 1993), rho_inf = 0.8
 * sweep: riccati
 * unknown: acceleration
 * joints in arrays, from 0: coupling 0, belt 1, second 2, shaft 3
 * links in arrays, from 0: pinion 0, layshaft 0, feeder 1, wheel 2, table 3
 * operations of a step: 159, 39.75 per station (75 additions, 84 multiplications)
 * operations of prepare: 75, 18.75 per station (13 additions, 51 multiplications, 11 divisions)
 * number type: double
 * bytes of the structs: params 144, model 288, state 120, inputs 24, outputs 48
 *
 * A test for any machine: the kernel against 30 digits, within what rounding explains.
 *
 * @file test_geartrain.c
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
#undef feeder_torque
#undef motor_speed
#undef table
#undef table_speed
#undef feeder_speed
#undef coupling_torque
#undef teeth

#include "geartrain.h"

typedef geartrain_real real;

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
    geartrain_status value,
    geartrain_status right)
{
    ++count->checks;
    if (value != right) {
        ++count->failures;
        printf("%s: status is %d, not %d\n", what, (int)value, (int)right);
    }
}

static void test_motion(tally *count)
{
    geartrain_params params;
    geartrain_model model;
    geartrain_state state;
    geartrain_inputs inputs;
    geartrain_outputs outputs;
    geartrain_status status;
    real initial_angle[GEARTRAIN_STATIONS];
    real initial_rate[GEARTRAIN_STATIONS];

    memset(&state, 0, sizeof state); /* padding too: it is compared below */
    geartrain_default_params(&params);
    status = geartrain_prepare(&model, &params, GEARTRAIN_STEP);
    expect_code(count, "prepare", status, GEARTRAIN_OK);

    for (int j = 0; j < GEARTRAIN_STATIONS; ++j) {
        initial_angle[j] = (real)((7 * j + 3) % 16 - 8) / 64.0;
    }
    for (int j = 0; j < GEARTRAIN_STATIONS; ++j) {
        initial_rate[j] = (real)((7 * j + 3) % 16 - 8) / 64.0;
    }
    inputs.motor_torque = -0.375;
    inputs.load_torque = 0.0;
    inputs.feeder_torque = 0.375;
    status = geartrain_initialise(&state, &params, initial_angle, initial_rate, &inputs);
    expect_code(count, "initialise", status, GEARTRAIN_OK);

    /* Step 1. */
    inputs.motor_torque = 0.25;
    inputs.load_torque = -0.5;
    inputs.feeder_torque = -0.125;
    status = geartrain_step(&model, &state, &inputs);
    expect_code(count, "step 1", status, GEARTRAIN_OK);
    geartrain_output(&model, &state, &outputs);
    expect(count, "motor_speed", outputs.motor_speed, -2.1677538859447267, 5.2e-14);
    expect(count, "table", outputs.table, -1.8962830226200724e-06, 7.4e-20);
    expect(count, "table_speed", outputs.table_speed, -0.037967211540185127, 4.5e-16);
    expect(count, "feeder_speed", outputs.feeder_speed, -0.04463246954874612, 3.2e-15);
    expect(count, "coupling_torque", outputs.coupling_torque, 14.636766946471084, 1.1e-13);
    expect(count, "teeth", outputs.teeth, 5887.288122276116, 3.1e-11);

    /* Step 2. */
    inputs.motor_torque = -0.25;
    inputs.load_torque = 0.125;
    inputs.feeder_torque = 0.5;
    status = geartrain_step(&model, &state, &inputs);
    expect_code(count, "step 2", status, GEARTRAIN_OK);
    geartrain_output(&model, &state, &outputs);
    expect(count, "motor_speed", outputs.motor_speed, -4.981993627096389, 5.2e-14);
    expect(count, "table", outputs.table, -7.144445481021442e-06, 7.4e-20);
    expect(count, "table_speed", outputs.table_speed, -0.06705924429706382, 4.5e-16);
    expect(count, "feeder_speed", outputs.feeder_speed, -0.0055913511816196556, 3.2e-15);
    expect(count, "coupling_torque", outputs.coupling_torque, 18.7809369954115, 1.1e-13);
    expect(count, "teeth", outputs.teeth, 5113.756451402415, 3.1e-11);

    /* Step 3. */
    inputs.motor_torque = 0.375;
    inputs.load_torque = -0.375;
    inputs.feeder_torque = 0.0;
    status = geartrain_step(&model, &state, &inputs);
    expect_code(count, "step 3", status, GEARTRAIN_OK);
    geartrain_output(&model, &state, &outputs);
    expect(count, "motor_speed", outputs.motor_speed, -8.481573088403998, 5.2e-14);
    expect(count, "table", outputs.table, -1.4805203527039135e-05, 7.4e-20);
    expect(count, "table_speed", outputs.table_speed, -0.08621605002598696, 4.5e-16);
    expect(count, "feeder_speed", outputs.feeder_speed, 0.05430677453196881, 3.2e-15);
    expect(count, "coupling_torque", outputs.coupling_torque, 23.787516928126887, 1.1e-13);
    expect(count, "teeth", outputs.teeth, 4069.811567185458, 3.1e-11);

    /* State after the last step. */
    expect(count, "hub_angle", state.hub_angle, -0.0011395772192789105, 4.8e-18);
    expect(count, "hub_rate", state.hub_rate, -8.481573088403998, 5.2e-14);
    expect(count, "hub_acceleration", state.hub_acceleration, -37130.41333567505, 5.4e-10);
    expect(count, "angle[0]", state.angle[0], -0.12338621486510096, 5.2e-16);
    expect(count, "angle[1]", state.angle[1], 0.031249273567854494, 5.2e-16);
    expect(count, "angle[2]", state.angle[2], -0.08508212736348587, 5.2e-16);
    expect(count, "angle[3]", state.angle[3], -1.4805203527039135e-05, 5.2e-16);
    expect(count, "rate[0]", state.rate[0], -281.00763715108303, 1.9e-12);
    expect(count, "rate[1]", state.rate[1], 0.05430677453196881, 1.9e-12);
    expect(count, "rate[2]", state.rate[2], 152.1889756495436, 1.9e-12);
    expect(count, "rate[3]", state.rate[3], -0.08621605002598696, 1.9e-12);
    expect(count, "acceleration[0]", state.acceleration[0], -690951.6905826383, 1.1e-08);
    expect(count, "acceleration[1]", state.acceleration[1], 176.50017576579143, 1.1e-08);
    expect(count, "acceleration[2]", state.acceleration[2], 390616.1862587189, 1.1e-08);
    expect(count, "acceleration[3]", state.acceleration[3], -153.684013590159, 1.1e-08);

    /* Bad input is refused and leaves the state alone. */
    geartrain_state before;
    memcpy(&before, &state, sizeof before);
    const real bad[] = {(real)NAN, (real)INFINITY, -(real)INFINITY};
    for (int k = 0; k < 3; ++k) {
        real good;
        good = inputs.motor_torque;
        inputs.motor_torque = bad[k];
        status = geartrain_step(&model, &state, &inputs);
        expect_code(count, "bad motor_torque", status, GEARTRAIN_NON_FINITE_INPUT);
        inputs.motor_torque = good;
        good = inputs.load_torque;
        inputs.load_torque = bad[k];
        status = geartrain_step(&model, &state, &inputs);
        expect_code(count, "bad load_torque", status, GEARTRAIN_NON_FINITE_INPUT);
        inputs.load_torque = good;
        good = inputs.feeder_torque;
        inputs.feeder_torque = bad[k];
        status = geartrain_step(&model, &state, &inputs);
        expect_code(count, "bad feeder_torque", status, GEARTRAIN_NON_FINITE_INPUT);
        inputs.feeder_torque = good;
    }
    ++count->checks;
    if (memcmp(&before, &state, sizeof state) != 0) {
        ++count->failures;
        printf("bad input has changed the state\n");
    }
}

static void test_refusals(tally *count)
{
    geartrain_params params;
    geartrain_model model;
    geartrain_status status;

    geartrain_default_params(&params);
    status = geartrain_prepare(&model, &params, 0.0);
    expect_code(count, "no step", status, GEARTRAIN_INVALID_STEP);
    status = geartrain_prepare(&model, &params, (real)NAN);
    expect_code(count, "bad step", status, GEARTRAIN_INVALID_STEP);

    geartrain_default_params(&params);
    params.stiffness[GEARTRAIN_STATIONS - 1] = (real)NAN;
    status = geartrain_prepare(&model, &params, GEARTRAIN_STEP);
    expect_code(count, "bad stiffness", status, GEARTRAIN_NON_FINITE_INPUT);

    geartrain_default_params(&params);
    params.damping[GEARTRAIN_STATIONS - 1] = (real)NAN;
    status = geartrain_prepare(&model, &params, GEARTRAIN_STEP);
    expect_code(count, "bad damping", status, GEARTRAIN_NON_FINITE_INPUT);

    geartrain_default_params(&params);
    params.ratio[GEARTRAIN_STATIONS - 1] = (real)NAN;
    status = geartrain_prepare(&model, &params, GEARTRAIN_STEP);
    expect_code(count, "bad ratio", status, GEARTRAIN_NON_FINITE_INPUT);

    geartrain_default_params(&params);
    params.inertia[GEARTRAIN_STATIONS - 1] = (real)NAN;
    status = geartrain_prepare(&model, &params, GEARTRAIN_STEP);
    expect_code(count, "bad inertia", status, GEARTRAIN_NON_FINITE_INPUT);

    geartrain_default_params(&params);
    params.hub_inertia = (real)NAN;
    status = geartrain_prepare(&model, &params, GEARTRAIN_STEP);
    expect_code(count, "bad hub_inertia", status, GEARTRAIN_NON_FINITE_INPUT);

    geartrain_default_params(&params);
    params.hub_damping = (real)NAN;
    status = geartrain_prepare(&model, &params, GEARTRAIN_STEP);
    expect_code(count, "bad hub_damping", status, GEARTRAIN_NON_FINITE_INPUT);
}

/* Arrays that are absent are the scene's own; any other pointer that is absent is refused. */
static void test_absent(tally *count)
{
    geartrain_params params;
    geartrain_model model;
    geartrain_state state;
    geartrain_inputs inputs;
    geartrain_status status;

    memset(&inputs, 0, sizeof inputs);
    geartrain_default_params(&params);
    geartrain_default_params(NULL);
    status = geartrain_prepare(NULL, &params, GEARTRAIN_STEP);
    expect_code(count, "no model", status, GEARTRAIN_NULL_POINTER);
    status = geartrain_prepare(&model, NULL, GEARTRAIN_STEP);
    expect_code(count, "no parameters", status, GEARTRAIN_NULL_POINTER);
    status = geartrain_prepare(&model, &params, GEARTRAIN_STEP);
    expect_code(count, "prepare", status, GEARTRAIN_OK);
    status = geartrain_initialise(NULL, &params, NULL, NULL, &inputs);
    expect_code(count, "no state", status, GEARTRAIN_NULL_POINTER);
    status = geartrain_initialise(&state, &params, NULL, NULL, &inputs);
    expect_code(count, "the scene's start", status, GEARTRAIN_OK);
    status = geartrain_step(&model, NULL, &inputs);
    expect_code(count, "no state", status, GEARTRAIN_NULL_POINTER);
    status = geartrain_step(NULL, &state, &inputs);
    expect_code(count, "no model", status, GEARTRAIN_NULL_POINTER);
    status = geartrain_initialise(&state, &params, NULL, NULL, NULL);
    expect_code(count, "no inputs", status, GEARTRAIN_NULL_POINTER);
    status = geartrain_step(&model, &state, NULL);
    expect_code(count, "no inputs", status, GEARTRAIN_NULL_POINTER);
    geartrain_output(&model, &state, NULL);
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
