/* Free rigid body on the sphere: one step by rkmk:rk4: functions and status codes. free_rigid_body_rkmk_rk4.c has an example. */
#ifndef FREE_RIGID_BODY_RKMK_RK4_H
#define FREE_RIGID_BODY_RKMK_RK4_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

enum {
    FREE_RIGID_BODY_RKMK_RK4_OK = 0, /* success */
    FREE_RIGID_BODY_RKMK_RK4_NOT_FINITE = 2, /* the new state would contain an infinity or a NaN */
    FREE_RIGID_BODY_RKMK_RK4_BAD_STEP = 3 /* h is infinite or a NaN */
};

/* Make one step of size h. When the status is not FREE_RIGID_BODY_RKMK_RK4_OK, the state is unchanged. */
int free_rigid_body_rkmk_rk4_step(double state[3], double h);

/*
 * Make up to steps steps of size h, until one fails; the state is then the last good one and *completed
 * the number of completed steps. A trajectory receives the initial state and every stride-th one after
 * it: steps/stride + 1 rows of 3. trajectory and completed may be NULL.
 */
int free_rigid_body_rkmk_rk4_run(double state[3], double h, size_t steps,
    double *trajectory, size_t stride, size_t *completed);

#ifdef __cplusplus
}
#endif

#endif
