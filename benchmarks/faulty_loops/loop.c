/* A controller on an arm whose sensors fail for a while; CONTROLLER_ and PLANT_ stand for prefixes. */
#include "CONTROLLER_.h"
#include "plant.h"

#include <math.h>

typedef struct {
    double start;   /* the arm is at rest there [rad] */
    double target;  /* [rad] */
    double low;     /* [N m] */
    double high;    /* [N m] */
    double gravity; /* [m/s^2] */
    int before;     /* true samples, then as many with faults, then true ones again */
    int faults;
    int after;
    int substeps;
} loop_case;

typedef struct {
    int first_ok;   /* true samples after the last wrong one up to the first OK, or -1 */
    int last_other; /* and up to the last that is not OK */
    int last_off;   /* and up to the last that is more than 0.02 rad off the target */
    int outside;    /* torques that are not finite, or out of bounds */
    int counts[9];  /* of statuses */
    int late[9];    /* of those later than one second after the last wrong sample */
    double tip;     /* in the end [rad] */
} loop_result;

static CONTROLLER__controller controller;

static double tip_of(const plant_state *state)
{
    double sum = 0.0;
    for (int j = 0; j < PLANT_STATIONS; ++j) {
        sum += state->angle[j];
    }
    return sum / PLANT_STATIONS;
}

/* kinds: 0 true, 1 as before the fault, 2 the value, 3 the value added, 4 the value and not valid; of all three sensors at
 * each sample. Half of the samples are prepared. */
int run_loop(const loop_case *given, const int kinds[][3], const double values[][3], const int sensors[], loop_result *found)
{
    plant_params params;
    plant_model model;
    plant_state state;
    plant_inputs inputs = {0};
    double angles[PLANT_STATIONS];
    double rates[PLANT_STATIONS] = {0};
    double held[3] = {0};

    for (int j = 0; j < PLANT_STATIONS; ++j) {
        angles[j] = given->start;
    }
    plant_default_params(&params);
    if (plant_prepare(&model, &params, (double)CONTROLLER_SAMPLE_TIME / given->substeps) != PLANT_OK
        || plant_initialise(&state, &params, angles, rates, &inputs) != PLANT_OK) {
        return 1;
    }
    state.hub_angle = given->start;
    state.hub_acceleration = 0.0;
    for (int j = 0; j < PLANT_STATIONS; ++j) {
        state.acceleration[j] = 0.0;
    }
    *found = (loop_result){.first_ok = -1};
    CONTROLLER__reset(&controller);
    for (int k = 0; k < given->before + given->faults + given->after; ++k) {
        const int at = k - given->before;
        const double turn = 6.283185307179586;
        double shown[3];
        CONTROLLER__real measured[CONTROLLER_SENSORS];
        int valid[CONTROLLER_SENSORS];
        CONTROLLER__real torque = 0;
        plant_outputs out;
        int status;

        plant_output(&model, &state, &out);
        shown[0] = floor(state.hub_angle / turn * 65536.0 + 0.5) * turn / 65536.0;
        shown[1] = cos(state.angle[PLANT_STATIONS - 1]) * (out.tip_acceleration_y + given->gravity)
            - sin(state.angle[PLANT_STATIONS - 1]) * out.tip_acceleration_x;
        shown[2] = out.root;
        for (int i = 0; i < 3; ++i) {
            if (at <= 0) {
                held[i] = shown[i];
            }
            if (at >= 0 && at < given->faults) {
                shown[i] = kinds[at][i] == 1 ? held[i] : kinds[at][i] == 2 || kinds[at][i] == 4 ? values[at][i]
                    : kinds[at][i] == 3 ? shown[i] + values[at][i] : shown[i];
            }
        }
        for (int i = 0; i < CONTROLLER_SENSORS; ++i) {
            measured[i] = (CONTROLLER__real)shown[sensors[i]];
            valid[i] = !(at >= 0 && at < given->faults && kinds[at][sensors[i]] == 4);
        }
        if ((unsigned)k * 2654435761u >> 31) {
            (void)CONTROLLER__prepare(&controller);
        }
        status = (int)CONTROLLER__command_valid(&controller, measured, valid, &torque);
        ++found->counts[status];
        found->outside += !((double)torque >= given->low && (double)torque <= given->high);
        if (at >= given->faults) {
            const int since = at - given->faults + 1;
            if (status == 0 && found->first_ok < 0) {
                found->first_ok = since;
            }
            found->late[status] += since * (double)CONTROLLER_SAMPLE_TIME > 1.0;
            if (status != 0) {
                found->last_other = since;
            }
            if (!(fabs(tip_of(&state) - given->target) <= 0.02)) {
                found->last_off = since;
            }
        }
        inputs = (plant_inputs){(double)torque};
        for (int i = 0; i < given->substeps; ++i) {
            if (plant_step(&model, &state, &inputs) != PLANT_OK) {
                return 2;
            }
        }
    }
    found->tip = tip_of(&state);
    return 0;
}
