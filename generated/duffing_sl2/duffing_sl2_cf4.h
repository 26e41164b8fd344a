/* Duffing's equation, SL(2) acting linearly: one step by cf:cf4: functions and status codes. duffing_sl2_cf4.c has an example. */
#ifndef DUFFING_SL2_CF4_H
#define DUFFING_SL2_CF4_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

enum {
    DUFFING_SL2_CF4_OK = 0, /* success */
    DUFFING_SL2_CF4_NOT_FINITE = 2, /* the new state would contain an infinity or a NaN */
    DUFFING_SL2_CF4_BAD_STEP = 3, /* h is infinite or NaN */
    DUFFING_SL2_CF4_TOO_FAR = 5 /* the step is too long: no finite new state was computed; a shorter step succeeds */
};

/* Make one step of size h. When the status is not DUFFING_SL2_CF4_OK, the state is unchanged. */
int duffing_sl2_cf4_step(double state[2], double h);

/*
 * Make the given number of steps of size h, or fewer if a step fails. On return, state is the last
 * good state, and *completed is the number of completed steps. The trajectory receives
 * steps/stride + 1 rows of 2 numbers: the initial state, and the state after every stride-th step.
 * trajectory and completed may be NULL.
 */
int duffing_sl2_cf4_run(double state[2], double h, size_t steps, double *trajectory,
    size_t stride, size_t *completed);

#ifdef __cplusplus
}
#endif

#endif
