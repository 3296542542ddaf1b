/* Ten thousand arms of scatter.toml under one plan of torque: where are their payloads after 0.6 s? */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "scatter_batch.h"

enum { ARMS = 10000, STEPS = 600 };

/* A number between -1 and 1, the same on every machine. */
static double drawn(unsigned *seed)
{
    *seed = *seed * 1664525u + 1013904223u;
    return (double)(*seed >> 8) / 8388608.0 - 1.0;
}

static double spread(const double *numbers, double *mean)
{
    double squares = 0.0;
    *mean = 0.0;
    for (int arm = 0; arm < ARMS; ++arm) {
        *mean += numbers[arm] / ARMS;
    }
    for (int arm = 0; arm < ARMS; ++arm) {
        squares += (numbers[arm] - *mean) * (numbers[arm] - *mean) / ARMS;
    }
    return sqrt(squares);
}

int main(void)
{
    scatter_model *models = malloc(ARMS * sizeof *models);
    scatter_state *states = malloc(ARMS * sizeof *states);
    scatter_status *status = malloc(ARMS * sizeof *status);
    double *outputs = malloc(4 * ARMS * sizeof *outputs); /* x and y, at the start and at the end */
    double torque[STEPS];
    unsigned seed = 1;

    if (models == NULL || states == NULL || status == NULL || outputs == NULL) {
        return 1;
    }
    for (int k = 0; k < STEPS; ++k) {
        torque[k] = k < 200 ? 0.04 : k < 400 ? -0.035 : 0.0;
    }
    const scatter_inputs first = {torque[0]};
    for (int arm = 0; arm < ARMS; ++arm) {
        scatter_params params;
        scatter_default_params(&params);
        const double stiffness = 1.0 + 0.05 * drawn(&seed);
        for (int j = 0; j < SCATTER_STATIONS; ++j) {
            params.stiffness[j] *= stiffness;
        }
        params.tip_mass *= 1.0 + 0.3 * drawn(&seed); /* the payload */
        if (scatter_prepare(&models[arm], &params, SCATTER_STEP) != SCATTER_OK
            || scatter_initialise(&states[arm], &params, NULL, NULL, &first) != SCATTER_OK) {
            return 1;
        }
    }

    const scatter_signal_batch signals[] = {{torque, 1, 0, 0}}; /* from step to step, the same for all arms */
    const long ended = scatter_run_batch(ARMS, 0, ARMS, STEPS, STEPS, models, states, signals, outputs, status);

    double x, y;
    const double scatter_x = spread(outputs + 2 * ARMS, &x);
    const double scatter_y = spread(outputs + 3 * ARMS, &y);
    printf("%ld arms refused\n", ended);
    printf("x %.4f m, scatter %.1f mm\n", x, 1e3 * scatter_x);
    printf("y %.4f m, scatter %.1f mm\n", y, 1e3 * scatter_y);
    free(models);
    free(states);
    free(status);
    free(outputs);
    return ended != 0;
}
