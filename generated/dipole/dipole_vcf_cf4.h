/* Dipole on a stick, T*SO(3): one step by vcf:cf4: functions and status codes. dipole_vcf_cf4.c has an example. */
#ifndef DIPOLE_VCF_CF4_H
#define DIPOLE_VCF_CF4_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

enum {
    DIPOLE_VCF_CF4_OK = 0, /* success */
    DIPOLE_VCF_CF4_NOT_CONVERGED = 1, /* an implicit block did not converge */
    DIPOLE_VCF_CF4_NOT_FINITE = 2, /* the new state would contain an infinity or a NaN */
    DIPOLE_VCF_CF4_BAD_STEP = 3, /* h is infinite or NaN */
    DIPOLE_VCF_CF4_TOO_FAR = 5, /* the step is too long: no finite new state was computed; a shorter step succeeds */
    DIPOLE_VCF_CF4_SINGULAR = 6 /* the matrix of an implicit block is singular */
};

/* Statistics of the iterations (sweeps) since the caller set all fields to zero. */
typedef struct {
    size_t sweeps[1]; /* by block: the equations of xi1, xi2, xi3, xi4, n1, n2, n3, n4 */
    size_t most; /* largest number of sweeps of one block in one step or substep */
    size_t failed; /* number of the block that failed, counted from 1; 0 if none */
    size_t matrices; /* number of Newton matrices that were computed */
} dipole_vcf_cf4_statistics;

/* Make one step of size h. When the status is not DIPOLE_VCF_CF4_OK, the state is unchanged. */
int dipole_vcf_cf4_step(double state[12], double h, dipole_vcf_cf4_statistics *statistics);

/*
 * Make the given number of steps of size h, or fewer if a step fails. On return, state is the last
 * good state, and *completed is the number of completed steps. The trajectory receives
 * steps/stride + 1 rows of 12 numbers: the initial state, and the state after every stride-th step.
 * statistics, trajectory and completed may be NULL.
 */
int dipole_vcf_cf4_run(double state[12], double h, size_t steps, double *trajectory,
    size_t stride, dipole_vcf_cf4_statistics *statistics, size_t *completed);

#ifdef __cplusplus
}
#endif

#endif
