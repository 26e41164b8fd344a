/* Free rigid body on the sphere: one step by cg:cg3: functions and status codes. free_rigid_body_cg3.c has an example. */
#ifndef FREE_RIGID_BODY_CG3_H
#define FREE_RIGID_BODY_CG3_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

enum {
    FREE_RIGID_BODY_CG3_OK = 0, /* success */
    FREE_RIGID_BODY_CG3_NOT_FINITE = 2, /* the new state would contain an infinity or a NaN */
    FREE_RIGID_BODY_CG3_BAD_STEP = 3, /* h is infinite or NaN */
    FREE_RIGID_BODY_CG3_TOO_FAR = 5 /* the step is too long: no finite new state was computed; a shorter step succeeds */
};

/* Make one step of size h. When the status is not FREE_RIGID_BODY_CG3_OK, the state is unchanged. */
int free_rigid_body_cg3_step(double state[3], double h);

/*
 * Make the given number of steps of size h, or fewer if a step fails. On return, state is the last
 * good state, and *completed is the number of completed steps. The trajectory receives
 * steps/stride + 1 rows of 3 numbers: the initial state, and the state after every stride-th step.
 * trajectory and completed may be NULL.
 */
int free_rigid_body_cg3_run(double state[3], double h, size_t steps, double *trajectory,
    size_t stride, size_t *completed);

#ifdef __cplusplus
}
#endif

#endif
