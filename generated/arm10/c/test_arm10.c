/**
 * arm10: Ten-link arm swung by a hub motor
 *
 * Written by tmm-gen 0.1.0. Do not edit: change the scene and run `tmm-gen build`.
 * scene digest: 525c1f48f30bec4efe0533edca417c45a4e26085c7c23db491d2c2e6aa2d5335
 * sha256 of the rest of this file: deed5259a5fa6b03643dc05918316d027fed6205128e01c2af738c95e92a15ba
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
 * A test for any machine: the kernel against 30 digits, within what rounding explains.
 *
 * @file test_arm10.c
 */
#include "arm10.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

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

static void expect_status(tally *count, const char *what, arm10_status value, arm10_status right)
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
    expect_status(count, "prepare", status, ARM10_OK);

    for (int j = 0; j < ARM10_STATIONS; ++j) {
        initial_angle[j] = (real)((7 * j + 3) % 16 - 8) / 16777216.0;
    }
    for (int j = 0; j < ARM10_STATIONS; ++j) {
        initial_rate[j] = (real)((7 * j + 3) % 16 - 8) / 16777216.0;
    }
    inputs.hub_torque = -1.430511474609375e-06;
    inputs.tip_force = 0.0;
    status = arm10_initialise(&state, &params, initial_angle, initial_rate, &inputs);
    expect_status(count, "initialise", status, ARM10_OK);

    /* Step 1. */
    inputs.hub_torque = 9.5367431640625e-07;
    inputs.tip_force = -1.9073486328125e-06;
    status = arm10_step(&model, &state, &inputs);
    expect_status(count, "step 1", status, ARM10_OK);
    arm10_output(&model, &state, &outputs);
    expect(count, "tip_x", outputs.tip_x, 0.9999999999016497, 110.0);
    expect(count, "tip_y", outputs.tip_y, -4.9461777893288495e-06, 77000000.0);
    expect(count, "hub", outputs.hub, -6.916030281711698e-08, 1900.0);
    expect(count, "root", outputs.root, -0.013813855299020754, 370000000.0);

    /* Step 2. */
    inputs.hub_torque = -9.5367431640625e-07;
    inputs.tip_force = 4.76837158203125e-07;
    status = arm10_step(&model, &state, &inputs);
    expect_status(count, "step 2", status, ARM10_OK);
    arm10_output(&model, &state, &outputs);
    expect(count, "tip_x", outputs.tip_x, 0.9999999987092694, 110.0);
    expect(count, "tip_y", outputs.tip_y, -1.9660121341566614e-05, 77000000.0);
    expect(count, "hub", outputs.hub, -4.052724800124546e-07, 1900.0);
    expect(count, "root", outputs.root, -0.02575118125674388, 370000000.0);

    /* Step 3. */
    inputs.hub_torque = 1.430511474609375e-06;
    inputs.tip_force = -1.430511474609375e-06;
    status = arm10_step(&model, &state, &inputs);
    expect_status(count, "step 3", status, ARM10_OK);
    arm10_output(&model, &state, &outputs);
    expect(count, "tip_x", outputs.tip_x, 0.9999999944299124, 110.0);
    expect(count, "tip_y", outputs.tip_y, -4.418382768008004e-05, 77000000.0);
    expect(count, "hub", outputs.hub, -1.2570263023564921e-06, 1900.0);
    expect(count, "root", outputs.root, -0.03783634537438047, 370000000.0);

    /* State after the last step. */
    expect(count, "hub_angle", state.hub_angle, -1.2570263023564921e-06, 1900.0);
    expect(count, "hub_rate", state.hub_rate, -0.001169603895931634, 3700000.0);
    expect(count, "hub_acceleration", state.hub_acceleration, -0.7564643764789308, 7400000000.0);
    expect(count, "angle[0]", state.angle[0], -0.00028977895138189793, 400000000.0);
    expect(count, "angle[1]", state.angle[1], -0.00016390401719219684, 400000000.0);
    expect(count, "angle[2]", state.angle[2], -1.2108058133547089e-05, 400000000.0);
    expect(count, "angle[3]", state.angle[3], 1.9373315657368458e-05, 400000000.0);
    expect(count, "angle[4]", state.angle[4], 6.486358135177658e-06, 400000000.0);
    expect(count, "angle[5]", state.angle[5], -8.557521301556167e-07, 400000000.0);
    expect(count, "angle[6]", state.angle[6], -7.746698572909185e-07, 400000000.0);
    expect(count, "angle[7]", state.angle[7], -1.2346361246132754e-07, 400000000.0);
    expect(count, "angle[8]", state.angle[8], 3.409607821028971e-08, 400000000.0);
    expect(count, "angle[9]", state.angle[9], -1.8713915245830093e-07, 400000000.0);
    expect(count, "rate[0]", state.rate[0], -0.15250508959350834, 790000000000.0);
    expect(count, "rate[1]", state.rate[1], -0.13485622703547287, 790000000000.0);
    expect(count, "rate[2]", state.rate[2], -0.03088422979784136, 790000000000.0);
    expect(count, "rate[3]", state.rate[3], 0.016237194273879523, 790000000000.0);
    expect(count, "rate[4]", state.rate[4], 0.009274498622600227, 790000000000.0);
    expect(count, "rate[5]", state.rate[5], -0.0002370836748978286, 790000000000.0);
    expect(count, "rate[6]", state.rate[6], -0.0012859687220611368, 790000000000.0);
    expect(count, "rate[7]", state.rate[7], -0.00016812735863203226, 790000000000.0);
    expect(count, "rate[8]", state.rate[8], 5.86850795612309e-05, 790000000000.0);
    expect(count, "rate[9]", state.rate[9], 8.241169787734476e-05, 790000000000.0);
    expect(count, "acceleration[0]", state.acceleration[0], -18.815275093156206, 1600000000000000.0);
    expect(count, "acceleration[1]", state.acceleration[1], -54.84654143000488, 1600000000000000.0);
    expect(count, "acceleration[2]", state.acceleration[2], -35.363277496585404, 1600000000000000.0);
    expect(count, "acceleration[3]", state.acceleration[3], -1.1006827470452012, 1600000000000000.0);
    expect(count, "acceleration[4]", state.acceleration[4], 12.308153144498805, 1600000000000000.0);
    expect(count, "acceleration[5]", state.acceleration[5], 1.4356272550776417, 1600000000000000.0);
    expect(count, "acceleration[6]", state.acceleration[6], -1.405577688093445, 1600000000000000.0);
    expect(count, "acceleration[7]", state.acceleration[7], -0.5233554294144938, 1600000000000000.0);
    expect(count, "acceleration[8]", state.acceleration[8], 0.16971107315088324, 1600000000000000.0);
    expect(count, "acceleration[9]", state.acceleration[9], 0.04879454629203342, 1600000000000000.0);

    /* Bad input is refused and leaves the state alone. */
    arm10_state before;
    memcpy(&before, &state, sizeof before);
    const real bad[] = {(real)NAN, (real)INFINITY, -(real)INFINITY};
    for (int k = 0; k < 3; ++k) {
        const real hub_torque = inputs.hub_torque;
        inputs.hub_torque = bad[k];
        status = arm10_step(&model, &state, &inputs);
        expect_status(count, "bad hub_torque", status, ARM10_NON_FINITE_INPUT);
        inputs.hub_torque = hub_torque;
        const real tip_force = inputs.tip_force;
        inputs.tip_force = bad[k];
        status = arm10_step(&model, &state, &inputs);
        expect_status(count, "bad tip_force", status, ARM10_NON_FINITE_INPUT);
        inputs.tip_force = tip_force;
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
    expect_status(count, "no step", status, ARM10_INVALID_STEP);
    status = arm10_prepare(&model, &params, (real)NAN);
    expect_status(count, "bad step", status, ARM10_INVALID_STEP);

    arm10_default_params(&params);
    params.length = (real)NAN;
    status = arm10_prepare(&model, &params, ARM10_STEP);
    expect_status(count, "bad length", status, ARM10_NON_FINITE_INPUT);

    arm10_default_params(&params);
    params.mass = (real)NAN;
    status = arm10_prepare(&model, &params, ARM10_STEP);
    expect_status(count, "bad mass", status, ARM10_NON_FINITE_INPUT);

    arm10_default_params(&params);
    params.inertia = (real)NAN;
    status = arm10_prepare(&model, &params, ARM10_STEP);
    expect_status(count, "bad inertia", status, ARM10_NON_FINITE_INPUT);

    arm10_default_params(&params);
    params.center = (real)NAN;
    status = arm10_prepare(&model, &params, ARM10_STEP);
    expect_status(count, "bad center", status, ARM10_NON_FINITE_INPUT);

    arm10_default_params(&params);
    params.stiffness[ARM10_STATIONS - 1] = (real)NAN;
    status = arm10_prepare(&model, &params, ARM10_STEP);
    expect_status(count, "bad stiffness", status, ARM10_NON_FINITE_INPUT);

    arm10_default_params(&params);
    params.damping[ARM10_STATIONS - 1] = (real)NAN;
    status = arm10_prepare(&model, &params, ARM10_STEP);
    expect_status(count, "bad damping", status, ARM10_NON_FINITE_INPUT);

    arm10_default_params(&params);
    params.gravity = (real)NAN;
    status = arm10_prepare(&model, &params, ARM10_STEP);
    expect_status(count, "bad gravity", status, ARM10_NON_FINITE_INPUT);

    arm10_default_params(&params);
    params.hub_inertia = (real)NAN;
    status = arm10_prepare(&model, &params, ARM10_STEP);
    expect_status(count, "bad hub_inertia", status, ARM10_NON_FINITE_INPUT);

    arm10_default_params(&params);
    params.hub_damping = (real)NAN;
    status = arm10_prepare(&model, &params, ARM10_STEP);
    expect_status(count, "bad hub_damping", status, ARM10_NON_FINITE_INPUT);

    arm10_default_params(&params);
    params.tip_mass = (real)NAN;
    status = arm10_prepare(&model, &params, ARM10_STEP);
    expect_status(count, "bad tip_mass", status, ARM10_NON_FINITE_INPUT);
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
