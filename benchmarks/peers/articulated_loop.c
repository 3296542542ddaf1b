/* Repeats a step that CasADi has written, and measures it. */
#define _POSIX_C_SOURCE 199309L

#include <string.h>
#include <time.h>

int arm_step(const double **arg, double **res, long long *iw, double *w, int mem);
double peer_seconds(const double *start, double *final, const double *u, int size, long steps);

double peer_seconds(const double *start, double *final, const double *u, int size, long steps)
{
    double first[size];
    double second[size];
    double *from = first;
    double *to = second;
    struct timespec begin;
    struct timespec end;

    memcpy(from, start, sizeof first);
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &begin);
    for (long k = 0; k < steps; ++k) {
        const double *arg[] = { from, u };
        double *res[] = { to };
        double *const old = from;
        arm_step(arg, res, 0, 0, 0);
        from = to;
        to = old;
    }
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &end);
    memcpy(final, from, sizeof first);
    return (double)(end.tv_sec - begin.tv_sec) + 1e-9 * (double)(end.tv_nsec - begin.tv_nsec);
}
