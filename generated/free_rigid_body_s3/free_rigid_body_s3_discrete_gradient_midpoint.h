/* Free rigid body with attitude, S^3: one step by discrete_gradient:midpoint: functions and status codes. free_rigid_body_s3_discrete_gradient_midpoint.c has an example. */
#ifndef FREE_RIGID_BODY_S3_DISCRETE_GRADIENT_MIDPOINT_H
#define FREE_RIGID_BODY_S3_DISCRETE_GRADIENT_MIDPOINT_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

enum {
    FREE_RIGID_BODY_S3_DISCRETE_GRADIENT_MIDPOINT_OK = 0, /* success */
    FREE_RIGID_BODY_S3_DISCRETE_GRADIENT_MIDPOINT_NOT_CONVERGED = 1, /* an implicit block did not converge */
    FREE_RIGID_BODY_S3_DISCRETE_GRADIENT_MIDPOINT_NOT_FINITE = 2, /* the new state would contain an infinity or a NaN */
    FREE_RIGID_BODY_S3_DISCRETE_GRADIENT_MIDPOINT_BAD_STEP = 3, /* h is infinite or NaN */
    FREE_RIGID_BODY_S3_DISCRETE_GRADIENT_MIDPOINT_TOO_FAR = 5 /* the step is too long: no finite new state was computed; a shorter step succeeds */
};

/* Statistics of the iterations (sweeps) since the caller set all fields to zero. */
typedef struct {
    size_t sweeps[1]; /* by block: the equations of xi */
    size_t most; /* largest number of sweeps of one block in one step or substep */
    size_t failed; /* number of the block that failed, counted from 1; 0 if none */
    size_t matrices; /* number of Newton matrices that were computed */
} free_rigid_body_s3_discrete_gradient_midpoint_statistics;

/* Make one step of size h. When the status is not FREE_RIGID_BODY_S3_DISCRETE_GRADIENT_MIDPOINT_OK, the state is unchanged. */
int free_rigid_body_s3_discrete_gradient_midpoint_step(double state[4], double h,
    free_rigid_body_s3_discrete_gradient_midpoint_statistics *statistics);

/*
 * Make the given number of steps of size h, or fewer if a step fails. On return, state is the last
 * good state, and *completed is the number of completed steps. The trajectory receives
 * steps/stride + 1 rows of 4 numbers: the initial state, and the state after every stride-th step.
 * statistics, trajectory and completed may be NULL.
 */
int free_rigid_body_s3_discrete_gradient_midpoint_run(double state[4], double h,
    size_t steps, double *trajectory, size_t stride,
    free_rigid_body_s3_discrete_gradient_midpoint_statistics *statistics,
    size_t *completed);

#ifdef __cplusplus
}
#endif

#endif
