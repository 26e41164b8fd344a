/* rigid: functions and status codes. rigid.c has an example. */
#ifndef RIGID_H
#define RIGID_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

enum {
    RIGID_OK = 0, /* success */
    RIGID_NOT_FINITE = 2, /* the new state would contain an infinity or a NaN */
    RIGID_BAD_STEP = 3 /* h is infinite or a NaN */
};

/* Make one step of size h. When the status is not RIGID_OK, the state is unchanged. */
int rigid_step(double state[3], double h);

/*
 * Make up to steps steps of size h, until one fails; the state is then the last good one and *completed
 * the number of completed steps. A trajectory receives the initial state and every stride-th one after
 * it: steps/stride + 1 rows of 3. trajectory and completed may be NULL.
 */
int rigid_run(double state[3], double h, size_t steps, double *trajectory, size_t stride,
    size_t *completed);

#ifdef __cplusplus
}
#endif

#endif
