/* Heavy top with inertia fixed in space, T*SO(3): one step by slgi:midpoint: functions and status codes. heavy_top_slgi_midpoint.c has an example. */
#ifndef HEAVY_TOP_SLGI_MIDPOINT_H
#define HEAVY_TOP_SLGI_MIDPOINT_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

enum {
    HEAVY_TOP_SLGI_MIDPOINT_OK = 0, /* success */
    HEAVY_TOP_SLGI_MIDPOINT_NOT_CONVERGED = 1, /* an implicit block did not converge */
    HEAVY_TOP_SLGI_MIDPOINT_NOT_FINITE = 2, /* the new state would contain an infinity or a NaN */
    HEAVY_TOP_SLGI_MIDPOINT_BAD_STEP = 3, /* h is infinite or NaN */
    HEAVY_TOP_SLGI_MIDPOINT_TOO_FAR = 5, /* the step is too long: no finite new state was computed; a shorter step succeeds */
    HEAVY_TOP_SLGI_MIDPOINT_SINGULAR = 6 /* the matrix of an implicit block is singular */
};

/* Statistics of the iterations (sweeps) since the caller set all fields to zero. */
typedef struct {
    size_t sweeps[1]; /* by block: the equations of xi1, n1 */
    size_t most; /* largest number of sweeps of one block in one step or substep */
    size_t failed; /* number of the block that failed, counted from 1; 0 if none */
    size_t matrices; /* number of Newton matrices that were computed */
} heavy_top_slgi_midpoint_statistics;

/* Make one step of size h. When the status is not HEAVY_TOP_SLGI_MIDPOINT_OK, the state is unchanged. */
int heavy_top_slgi_midpoint_step(double state[12], double h,
    heavy_top_slgi_midpoint_statistics *statistics);

/*
 * Make the given number of steps of size h, or fewer if a step fails. On return, state is the last
 * good state, and *completed is the number of completed steps. The trajectory receives
 * steps/stride + 1 rows of 12 numbers: the initial state, and the state after every stride-th step.
 * statistics, trajectory and completed may be NULL.
 */
int heavy_top_slgi_midpoint_run(double state[12], double h, size_t steps,
    double *trajectory, size_t stride, heavy_top_slgi_midpoint_statistics *statistics,
    size_t *completed);

#ifdef __cplusplus
}
#endif

#endif
