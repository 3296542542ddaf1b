/*
 * An observer of a flexible arm: a timer interrupt reads what was measured, advances the model by a millisecond and
 * corrects its state by how far its hub is from the encoder's. What it sends out is that difference, and where it
 * takes the tip to be, which no sensor sees.
 *
 * In place of a converter and an encoder there is a recording, in place of a serial line semihosting. All else is
 * as on a real board: SysTick at 1 kHz, the model's memory static, nothing allocated, the main loop asleep.
 */
#include "beam5.h"
#include "gain.h"
#include "recorded.h"

#include <stdint.h>
#include <stdio.h>

#define CLOCK_HZ 25000000u /* of SysTick on this board */
#define RATE_HZ 1000u
#define TELEMETRY_EVERY 10u /* samples: 100 Hz */
#define RING 64u            /* messages waiting to be sent */

#define SYST_CSR (*(volatile uint32_t *)0xE000E010u)
#define SYST_RVR (*(volatile uint32_t *)0xE000E014u)
#define SYST_CVR (*(volatile uint32_t *)0xE000E018u)
#define SYST_RUNS_AND_INTERRUPTS 7u
#define SYST_HAS_COUNTED_DOWN 0x10000u

typedef struct {
    uint32_t sample;
    float residual; /* encoder less model, before the correction [rad] */
    beam5_outputs model;
} message;

static beam5_state state;
static message ring[RING];
static volatile uint32_t written;
static volatile uint32_t sent;
static volatile uint32_t samples;
static volatile uint32_t overruns;  /* interrupts that took longer than a period */
static volatile uint32_t dropped;   /* messages for which there was no room */
static volatile uint32_t longest;   /* ticks of the timer in an interrupt */
static volatile int failure;        /* first status of the model that was no success */

/* Move the state towards what the encoder says, by a gain that gain.py has computed; its first row is the hub's. */
static void correct(float residual)
{
    state.hub_angle += gain_angle[0] * residual;
    state.hub_rate += gain_rate[0] * residual;
    state.hub_acceleration += gain_acceleration[0] * residual;
    for (int j = 0; j < BEAM5_STATIONS; ++j) {
        state.angle[j] += gain_angle[j + 1] * residual;
        state.rate[j] += gain_rate[j + 1] * residual;
        state.acceleration[j] += gain_acceleration[j + 1] * residual;
    }
}

/* The name by which the start-up code of picolibc knows the interrupt of SysTick. */
void arm_systick_isr(void);

void arm_systick_isr(void)
{
    const uint32_t k = samples;
    if (k >= RECORDED_ROWS) {
        return;
    }
    const uint32_t begin = SYST_CVR;
    (void)SYST_CSR; /* reading it clears the flag */

    const beam5_inputs inputs = {.hub_torque = recorded_hub_torque[k]};
    const beam5_status status = beam5_step(&state, &inputs);
    if (status != BEAM5_OK && failure == 0) {
        failure = (int)status; /* the state is what it was */
    }
    const float residual = recorded_hub_angle[k] - state.hub_angle;
    correct(residual);
    beam5_outputs outputs;
    beam5_output(&state, &outputs);
    if ((k + 1u) % TELEMETRY_EVERY == 0u) {
        if (written - sent < RING) {
            message *next = &ring[written % RING];
            next->sample = k + 1u;
            next->residual = residual;
            next->model = outputs;
            written = written + 1u;
        } else {
            dropped = dropped + 1u;
        }
    }
    samples = k + 1u;

    const uint32_t ticks = begin - SYST_CVR; /* it counts down */
    if (SYST_CSR & SYST_HAS_COUNTED_DOWN) {
        overruns = overruns + 1u;
    } else if (ticks > longest) {
        longest = ticks;
    }
}

static void send(const message *next)
{
    printf(
        "%lu,%.9g,%.9g,%.9g,%.9g\n",
        (unsigned long)next->sample,
        (double)next->model.hub,
        (double)next->model.tip_x,
        (double)next->model.tip_y,
        (double)next->residual);
}

int main(void)
{
    const float at_rest[BEAM5_STATIONS] = {0.0f};
    const beam5_inputs none = {.hub_torque = 0.0f};

    if (beam5_initialise(&state, at_rest, at_rest, &none) != BEAM5_OK) {
        return 1;
    }
    printf("sample,hub,tip_x,tip_y,residual\n");
    SYST_RVR = CLOCK_HZ / RATE_HZ - 1u;
    SYST_CVR = 0u;
    SYST_CSR = SYST_RUNS_AND_INTERRUPTS;

    while (samples < RECORDED_ROWS || sent != written) {
        if (sent == written) {
            __asm__ volatile("wfi");
            continue;
        }
        send(&ring[sent % RING]);
        sent = sent + 1u;
    }
    printf(
        "# %lu samples, %lu overruns, %lu messages dropped, longest interrupt %lu of %lu ticks, status %d\n",
        (unsigned long)samples,
        (unsigned long)overruns,
        (unsigned long)dropped,
        (unsigned long)longest,
        (unsigned long)(CLOCK_HZ / RATE_HZ),
        failure);
    return overruns == 0u && dropped == 0u && failure == 0 ? 0 : 1;
}
