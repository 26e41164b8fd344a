/*
 * rigid
 *
 * method:     hand-made, for tests
 * order:      1
 * state:      [0..2] m: angular momentum in the body
 * operations: 14 add, 26 mul, 1 stumpff_12 a step
 * stack:      at most 704 bytes with gcc 12 and clang 14 at -O0 to -O3 on x86-64; math library
 *             functions need extra bytes
 * command:    none
 * version:    orderconds test
 *
 * Build: cc -std=c11 -O2 -ffp-contract=off -c rigid.c
 * Use:
 *
 *     #include "rigid.h"
 *     #include <stdio.h>
 *
 *     int main(void)
 *     {
 *         double state[3] = {0.4, -0.3, 0.9};
 *         size_t completed;
 *         const int status = rigid_run(state, 0.125, 8, NULL, 0, &completed);
 *         printf("status %d after %zu steps\n", status, completed);
 *         for (int i = 0; i < 3; i++) {
 *             printf("%.17g\n", state[i]);
 *         }
 *         return status;
 *     }
 */
#include "rigid.h"

#include <math.h>
#include <string.h>

#if defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__
#error "compile without -ffast-math (-ffinite-math-only): it removes the checks for infinities and NaNs"
#endif

/* c_2(z) for z <= 1/256 */
static inline double rigid_stumpff_tiny_2(double z)
{
    const double w = z * z;
    return (0.5 + z * -0.04166666666666365)
        + w * (0.0013888888842068215 + z * -2.4799519568559804e-05);
}

/* c_1(z) for z <= 1/256 */
static inline double rigid_stumpff_tiny_1(double z)
{
    const double w = z * z;
    return (1.0 + z * -0.16666666666663651)
        + w * (0.00833333328651266 + z * -0.00019839202108242344);
}

/* c_2(z) for z <= 1/16 */
static inline double rigid_stumpff_small_2(double z)
{
    const double w = z * z;
    return (0.5 + z * -0.041666666666666664)
        + w * (0.0013888888888888278 + z * -2.4801587297080002e-05)
        + w * w * (2.7557304737591345e-07 + z * -2.0855622118602925e-09);
}

/* c_1(z) for z <= 1/16 */
static inline double rigid_stumpff_small_1(double z)
{
    const double w = z * z;
    return (1.0 + z * -0.16666666666666666)
        + w * (0.008333333333332476 + z * -0.0001984126983495962)
        + w * w * (2.755729894303353e-06 + z * -2.5022519568470477e-08);
}

/* c_2(z) = sum_j (-z)^j/(2j+2)!, truncated, for 0 <= z <= 1 */
static inline double rigid_stumpff_series_2(double z)
{
    const double w = z * z;
    const double w2 = w * w;
    double even = -2.08767569878681e-09 + w * -4.779477332387385e-14;
    even = -0.041666666666666664 + w * -2.48015873015873e-05 + w2 * even;
    double odd = 1.1470745597729725e-11 + w * 1.5619206968586225e-16;
    odd = 0.001388888888888889 + w * 2.755731922398589e-07 + w2 * odd;
    return 0.5 + z * (even + z * odd);
}

/* c_1(z) = sum_j (-z)^j/(2j+1)!, truncated, for 0 <= z <= 1 */
static inline double rigid_stumpff_series_1(double z)
{
    const double w = z * z;
    const double w2 = w * w;
    double even = -2.505210838544172e-08 + w * -7.647163731819816e-13;
    even = -0.16666666666666666 + w * -0.0001984126984126984 + w2 * even;
    double odd = 1.6059043836821613e-10 + w * 2.8114572543455206e-15;
    odd = 0.008333333333333333 + w * 2.7557319223985893e-06 + w2 * odd;
    return 1.0 + z * (even + z * odd);
}

/* For z > 1/16 and s = sqrt(z): c_1 = sin(s)/s, c_2 = (1 - cos(s))/s^2 */
static void rigid_stumpff_12_far(double z, double *c1, double *c2)
{
    if (z <= 1.0) {
        *c1 = rigid_stumpff_series_1(z);
        *c2 = rigid_stumpff_series_2(z);
        return;
    }
    /* NaN if the angle is too large for an accurate result */
    const double half = 0.5 * sqrt(z <= 4398046511104.0 ? z : (double)NAN);
    const double sine = sin(half);
    const double cosine = cos(half);
    const double ratio = sine / half;
    *c1 = ratio * cosine;
    *c2 = 0.5 * (ratio * ratio);
}

/* For z >= 0 and s = sqrt(z): c_1 = sin(s)/s, c_2 = (1 - cos(s))/s^2 */
static inline void rigid_stumpff_12(double z, double *c1, double *c2)
{
    if (z <= 0.00390625) {
        *c1 = rigid_stumpff_tiny_1(z);
        *c2 = rigid_stumpff_tiny_2(z);
    } else if (z <= 0.0625) {
        *c1 = rigid_stumpff_small_1(z);
        *c2 = rigid_stumpff_small_2(z);
    } else {
        rigid_stumpff_12_far(z, c1, c2);
    }
}

/* The loop over the steps of a run. */
static int rigid_loop(double state[static 3], double h, size_t steps, double *trajectory,
    size_t stride, size_t *completed)
{
    int status = RIGID_OK;
    size_t step = 0;
    const int recording = stride > 0 && trajectory != NULL;
    size_t row = 0;
    if (recording) {
        memcpy(trajectory, state, 3 * sizeof *state);
    }
    if (steps > 0 && !isfinite(h)) {
        status = RIGID_BAD_STEP;
    }
    double m0 = state[0];
    double m1 = state[1];
    double m2 = state[2];
    while (status == RIGID_OK && step < steps) {
        const double w0 = -0.5 * m0 * h;
        const double w1 = -h * m1;
        const double w2 = -1.5 * m2 * h;
        const double z = w0 * w0 + w1 * w1 + w2 * w2;
        const double v0 = m2 * w1 - m1 * w2;
        const double v1 = m0 * w2 - m2 * w0;
        const double v2 = m1 * w0 - m0 * w1;
        double c1_1, c2_1;
        rigid_stumpff_12(z, &c1_1, &c2_1);
        const double new_m0 = m0 + v0 * c1_1 + (w1 * v2 - w2 * v1) * c2_1;
        const double new_m1 = m1 + v1 * c1_1 + (w2 * v0 - w0 * v2) * c2_1;
        const double new_m2 = m2 + v2 * c1_1 + (w0 * v1 - w1 * v0) * c2_1;
        /* If the sum of all x overflows, test each x: x - x is 0 only if x is finite. */
        if (isfinite(new_m0 + new_m1 + new_m2) || new_m0 - new_m0 + (new_m1 - new_m1)
            + (new_m2 - new_m2) == 0.0) {
            m0 = new_m0;
            m1 = new_m1;
            m2 = new_m2;
            step++;
            if (recording && step % stride == 0) {
                row++;
                trajectory[3 * row] = m0;
                trajectory[3 * row + 1] = m1;
                trajectory[3 * row + 2] = m2;
            }
        } else {
            status = RIGID_NOT_FINITE;
        }
    }
    state[0] = m0;
    state[1] = m1;
    state[2] = m2;
    if (completed != NULL) {
        *completed = step;
    }
    return status;
}

/*
 * Find the cause of a failed step. If a step of size zero succeeds, the cause is the step size.
 * Otherwise the cause is the state.
 */
static int rigid_cause(const double state[static 3], double h)
{
    double same[3];
    memcpy(same, state, sizeof same);
    const int status = rigid_loop(same, 0.0 * h, 1, NULL, 0, NULL);
    return status == RIGID_OK ? RIGID_TOO_FAR : RIGID_NOT_FINITE;
}

int rigid_run(double state[static 3], double h, size_t steps, double *trajectory,
    size_t stride, size_t *completed)
{
    int status = rigid_loop(state, h, steps, trajectory, stride, completed);
    if (status == RIGID_NOT_FINITE) {
        status = rigid_cause(state, h);
    }
    return status;
}

int rigid_step(double state[static 3], double h)
{
    const int status = rigid_run(state, h, 1, NULL, 0, NULL);
    return status;
}
