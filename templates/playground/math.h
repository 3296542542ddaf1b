/* What emitted C takes of <math.h> where there is no C library: instructions of the machine. */
#define isfinite(x) __builtin_isfinite(x)
#define fabs(x) __builtin_fabs(x)
#define sqrt(x) __builtin_sqrt(x)
