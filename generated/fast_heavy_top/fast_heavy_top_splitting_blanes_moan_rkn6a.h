/* Fast heavy top with body inertia, T*SO(3) (Brüls and Cardona 2010): one step by: functions and status codes. fast_heavy_top_splitting_blanes_moan_rkn6a.c has an example. */
#ifndef FAST_HEAVY_TOP_SPLITTING_BLANES_MOAN_RKN6A_H
#define FAST_HEAVY_TOP_SPLITTING_BLANES_MOAN_RKN6A_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

enum {
    FAST_HEAVY_TOP_SPLITTING_BLANES_MOAN_RKN6A_OK = 0, /* success */
    FAST_HEAVY_TOP_SPLITTING_BLANES_MOAN_RKN6A_NOT_FINITE = 2, /* the new state would contain an infinity or a NaN */
    FAST_HEAVY_TOP_SPLITTING_BLANES_MOAN_RKN6A_BAD_STEP = 3, /* h is infinite or NaN */
    FAST_HEAVY_TOP_SPLITTING_BLANES_MOAN_RKN6A_TOO_FAR = 5 /* the step is too long: no finite new state was computed; a shorter step succeeds */
};

/* Make one step of size h. When the status is not FAST_HEAVY_TOP_SPLITTING_BLANES_MOAN_RKN6A_OK, the state is unchanged. */
int fast_heavy_top_splitting_blanes_moan_rkn6a_step(double state[12], double h);

/*
 * Make the given number of steps of size h, or fewer if a step fails. On return, state is the last
 * good state, and *completed is the number of completed steps. The trajectory receives
 * steps/stride + 1 rows of 12 numbers: the initial state, and the state after every stride-th step.
 * trajectory and completed may be NULL.
 */
int fast_heavy_top_splitting_blanes_moan_rkn6a_run(double state[12], double h, size_t steps,
    double *trajectory, size_t stride, size_t *completed);

#ifdef __cplusplus
}
#endif

#endif
