/*
 * A step of Newmark's for a clamped planar arm of like links, written by hand: one Newton iteration on the exact
 * equations, by a sweep in whose 3 x 3 matrix of forces per acceleration of the joint (x, y) and turn of the inner link
 * stands written out. It checks nothing, and takes the C library's sines.
 */
#define _POSIX_C_SOURCE 199309L

#include <math.h>
#include <time.h>

#ifndef LINKS
#error "compile with -DLINKS=..."
#endif

typedef struct {
    double length, mass, inertia, stiffness, damping, gravity, tip, step;
} arm;

void hand_step(const arm *p, double *angle, double *rate, double *acceleration);
double hand_seconds(const arm *p, double *angle, double *rate, double *acceleration, long steps);

void hand_step(const arm *p, double *angle, double *rate, double *acceleration)
{
    const double l = p->length, m = p->mass, half = 0.5 * l, h = p->step;
    const double per_turn = 4.0 / (h * h), rate_per_turn = 2.0 / h; /* acceleration and rate per change of an angle */
    const double spring = p->stiffness + p->damping * rate_per_turn;
    double sine[LINKS], cosine[LINKS], swing_x[LINKS], swing_y[LINKS], pull_x[LINKS], pull_y[LINKS], left[LINKS];
    double by_x[LINKS], by_y[LINKS], by_turn[LINKS], own[LINKS];
    double ax = 0.0, ay = p->gravity, angle_before = 0.0, rate_before = 0.0;

    for (int j = 0; j < LINKS; ++j) {
        const double a = acceleration[j];
        const double q = angle[j] + h * rate[j] + 0.5 * h * h * a;
        const double v = rate[j] + h * a;
        const double s = sin(q), c = cos(q), square = v * v;
        const double x = -l * (s * a + c * square), y = l * (c * a - s * square);
        swing_x[j] = -y - l * (s * per_turn + 2.0 * c * v * rate_per_turn);
        swing_y[j] = x + l * (c * per_turn - 2.0 * s * v * rate_per_turn);
        pull_x[j] = m * (ax + 0.5 * x);
        pull_y[j] = m * (ay + 0.5 * y);
        ax += x;
        ay += y;
        const double torque = p->stiffness * (angle_before - q) + p->damping * (rate_before - v);
        left[j] = torque - p->inertia * a;
        if (j > 0) {
            left[j - 1] -= torque;
        }
        sine[j] = s;
        cosine[j] = c;
        angle[j] = q;
        rate[j] = v;
        angle_before = q;
        rate_before = v;
    }

    double xx = p->tip, xy = 0.0, xt = 0.0, yx = 0.0, yy = p->tip, yt = 0.0, tx = 0.0, ty = 0.0, tt = 0.0;
    double fx = p->tip * ax, fy = p->tip * ay, ex = 0.0, ey = 0.0, et = 0.0;
    for (int j = LINKS - 1; j >= 0; --j) {
        const double s = half * sine[j], c = half * cosine[j], gx = swing_x[j], gy = swing_y[j];
        const double beyond_x = fx, beyond_y = fy;
        fx += pull_x[j];
        fy += pull_y[j];
        const double sum_x = fx + beyond_x, sum_y = fy + beyond_y;
        const double bx = xx * gx + xy * gy + xt, by = yx * gx + yy * gy + yt, bt = tx * gx + ty * gy + tt;
        const double dx = bx + 0.5 * m * gx, dy = by + 0.5 * m * gy;
        const double inverse = 1.0
            / (p->inertia * per_turn + spring + bt - s * sum_y - c * sum_x + c * (by + dy) - s * (bx + dx));
        by_x[j] = -inverse * (tx + c * 2.0 * yx - s * (2.0 * xx + m));
        by_y[j] = -inverse * (ty + c * (2.0 * yy + m) - s * 2.0 * xy);
        by_turn[j] = inverse * spring;
        own[j] = inverse * (left[j] - c * sum_y + s * sum_x - et - 2.0 * (c * ey - s * ex));
        xx += m + dx * by_x[j];
        xy += dx * by_y[j];
        xt = dx * by_turn[j];
        yx += dy * by_x[j];
        yy += m + dy * by_y[j];
        yt = dy * by_turn[j];
        ex += dx * own[j];
        ey += dy * own[j];
        tx = -spring * by_x[j];
        ty = -spring * by_y[j];
        tt = spring * (1.0 - by_turn[j]);
        et = -spring * own[j];
    }

    double change_x = 0.0, change_y = 0.0, turn = 0.0;
    for (int j = 0; j < LINKS; ++j) {
        turn = by_x[j] * change_x + by_y[j] * change_y + by_turn[j] * turn + own[j];
        change_x += swing_x[j] * turn;
        change_y += swing_y[j] * turn;
        angle[j] += turn;
        rate[j] += rate_per_turn * turn;
        acceleration[j] += per_turn * turn;
    }
}

double hand_seconds(const arm *p, double *angle, double *rate, double *acceleration, long steps)
{
    struct timespec begin, end;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &begin);
    for (long k = 0; k < steps; ++k) {
        hand_step(p, angle, rate, acceleration);
    }
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &end);
    return (double)(end.tv_sec - begin.tv_sec) + 1e-9 * (double)(end.tv_nsec - begin.tv_nsec);
}
