/**
 * geartrain: Servo with coupling and two stages of gears on a table
 *
 * Written by tmm-gen 0.1.0. Do not edit: change the scene and run `tmm-gen build`.
 * scene digest: 1a4a8b5623facd447e81b78b9ab542ac7459a89297606c12999073246348dce9
 * sha256 of the rest of this file: 59164b928fa6657a2c20fb0dab2db138a70c1aa7d2227321bd433f8b550096df
 *
 * model: torsional chain (linear)
 * stations: 3
 * base: motor
 * integrator: Generalised alpha (Chung & Hulbert 1993), rho_inf = 0.8
 * sweep: riccati
 * unknown: acceleration
 * operations of a step: 120, 40 per station (56 additions, 64 multiplications)
 * operations of prepare: 59, 19.67 per station (10 additions, 40 multiplications, 9 divisions)
 * number type: double
 * bytes of the structs: params 112, model 240, state 96, inputs 16, outputs 40
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
#undef motor_speed
#undef table
#undef table_speed
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
    status = geartrain_initialise(&state, &params, initial_angle, initial_rate, &inputs);
    expect_code(count, "initialise", status, GEARTRAIN_OK);

    /* Step 1. */
    inputs.motor_torque = 0.25;
    inputs.load_torque = -0.5;
    status = geartrain_step(&model, &state, &inputs);
    expect_code(count, "step 1", status, GEARTRAIN_OK);
    geartrain_output(&model, &state, &outputs);
    expect(count, "motor_speed", outputs.motor_speed, -1.8189539208005785, 1.9e-14);
    expect(count, "table", outputs.table, -0.10938331467932685, 3.9e-16);
    expect(count, "table_speed", outputs.table_speed, -0.056902112210041426, 9.2e-16);
    expect(count, "coupling_torque", outputs.coupling_torque, 10.526920375353068, 6.2e-14);
    expect(count, "teeth", outputs.teeth, -1944.5565149358129, 6.9e-12);

    /* Step 2. */
    inputs.motor_torque = -0.25;
    inputs.load_torque = 0.125;
    status = geartrain_step(&model, &state, &inputs);
    expect_code(count, "step 2", status, GEARTRAIN_OK);
    geartrain_output(&model, &state, &outputs);
    expect(count, "motor_speed", outputs.motor_speed, -3.4609783081391354, 1.9e-14);
    expect(count, "table", outputs.table, -0.10938654245784944, 3.9e-16);
    expect(count, "table_speed", outputs.table_speed, -0.007631594729682739, 9.2e-16);
    expect(count, "coupling_torque", outputs.coupling_torque, 8.81657208815583, 6.2e-14);
    expect(count, "teeth", outputs.teeth, -1655.411103744341, 6.9e-12);

    /* Step 3. */
    inputs.motor_torque = 0.375;
    inputs.load_torque = -0.375;
    status = geartrain_step(&model, &state, &inputs);
    expect_code(count, "step 3", status, GEARTRAIN_OK);
    geartrain_output(&model, &state, &outputs);
    expect(count, "motor_speed", outputs.motor_speed, -4.707153353167352, 1.9e-14);
    expect(count, "table", outputs.table, -0.10938503227177694, 3.9e-16);
    expect(count, "table_speed", outputs.table_speed, 0.037859578232898636, 9.2e-16);
    expect(count, "coupling_torque", outputs.coupling_torque, 6.731501938769636, 6.2e-14);
    expect(count, "teeth", outputs.teeth, -1265.2148004857593, 6.9e-12);

    /* State after the last step. */
    expect(count, "hub_angle", state.hub_angle, -0.0007630420279636112, 4.9e-18);
    expect(count, "hub_rate", state.hub_rate, -4.707153353167352, 1.9e-14);
    expect(count, "hub_acceleration", state.hub_acceleration, -10151.706291883245, 2.8e-10);
    expect(count, "angle[0]", state.angle[0], -0.06071564558429004, 3.9e-16);
    expect(count, "angle[1]", state.angle[1], 0.022193530815347244, 3.9e-16);
    expect(count, "angle[2]", state.angle[2], -0.10938503227177694, 3.9e-16);
    expect(count, "rate[0]", state.rate[0], 108.36227638079907, 8.6e-13);
    expect(count, "rate[1]", state.rate[1], -56.71788247794643, 8.6e-13);
    expect(count, "rate[2]", state.rate[2], 0.037859578232898636, 8.6e-13);
    expect(count, "acceleration[0]", state.acceleration[0], 269027.69418162934, 4e-09);
    expect(count, "acceleration[1]", state.acceleration[1], -145420.58423429244, 4e-09);
    expect(count, "acceleration[2]", state.acceleration[2], 439.62663624868003, 4e-09);

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
