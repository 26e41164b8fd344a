/* Dipole on a stick, T*SO(3): one step by vrkmk(2):gauss2: functions and status codes. dipole_vrkmk2_gauss2.c has an example. */
#ifndef DIPOLE_VRKMK2_GAUSS2_H
#define DIPOLE_VRKMK2_GAUSS2_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

enum {
    DIPOLE_VRKMK2_GAUSS2_OK = 0, /* success */
    DIPOLE_VRKMK2_GAUSS2_NOT_CONVERGED = 1, /* an implicit block did not converge */
    DIPOLE_VRKMK2_GAUSS2_NOT_FINITE = 2, /* the new state would contain an infinity or a NaN */
    DIPOLE_VRKMK2_GAUSS2_BAD_STEP = 3, /* h is infinite or NaN */
    DIPOLE_VRKMK2_GAUSS2_TOO_FAR = 5, /* the step is too long: no finite new state was computed; a shorter step succeeds */
    DIPOLE_VRKMK2_GAUSS2_SINGULAR = 6 /* the matrix of an implicit block is singular */
};

/* Statistics of the iterations (sweeps) since the caller set all fields to zero. */
typedef struct {
    size_t sweeps[1]; /* by block: the equations of v1, v2, m1, m2 */
    size_t most; /* largest number of sweeps of one block in one step or substep */
    size_t failed; /* number of the block that failed, counted from 1; 0 if none */
    size_t matrices; /* number of Newton matrices that were computed */
} dipole_vrkmk2_gauss2_statistics;

/* Make one step of size h. When the status is not DIPOLE_VRKMK2_GAUSS2_OK, the state is unchanged. */
int dipole_vrkmk2_gauss2_step(double state[12], double h,
    dipole_vrkmk2_gauss2_statistics *statistics);

/*
 * Make the given number of steps of size h, or fewer if a step fails. On return, state is the last
 * good state, and *completed is the number of completed steps. The trajectory receives
 * steps/stride + 1 rows of 12 numbers: the initial state, and the state after every stride-th step.
 * statistics, trajectory and completed may be NULL.
 */
int dipole_vrkmk2_gauss2_run(double state[12], double h, size_t steps, double *trajectory,
    size_t stride, dipole_vrkmk2_gauss2_statistics *statistics, size_t *completed);

#ifdef __cplusplus
}
#endif

#endif
