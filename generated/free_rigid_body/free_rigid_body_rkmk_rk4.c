/*
 * Free rigid body on the sphere: one step by rkmk:rk4
 *
 * method:     family rkmk, tableau rk4
 * source:     Kutta 1901; Hairer, Norsett and Wanner, Solving Ordinary Differential Equations I,
 *             Table II.1.2; with brackets: Munthe-Kaas 1998
 * order:      4, certificate: exact (the residuals of all order conditions up to this order are
 *             zero in exact arithmetic)
 * digits:     with the coefficients rounded to double precision, the residuals of the order
 *             conditions are at most 5.6e-17
 * scene:      Free rigid body on the sphere, group SO(3)
 * state:      [0..2] y: point on which SO(3) acts by rotation
 * left out:   1 action, 1 exponential: coefficients are zero, or terms cancel
 *             1 evaluation of the field, 1 sum: equal values are computed once
 *             4 exponentials: exp(x).y is computed without exp(x)
 *             arguments for constant parameters: alpha = 0
 *             the time is not needed: no formula depends on the time
 *             a solver for implicit equations: all stages are explicit
 * operations: 77 add, 141 mul, 4 stumpff_12 a step
 * stack:      at most 1088 bytes with gcc 12 and clang 14 at -O0 to -O3 on x86-64; math library
 *             functions need extra bytes
 * command:    orderconds emit free_rigid_body --method rkmk:rk4 --target c -o .
 * version:    orderconds 0.1.0
 *
 * Build: cc -std=c11 -O2 -ffp-contract=off -c free_rigid_body_rkmk_rk4.c
 * Use:
 *
 *     #include "free_rigid_body_rkmk_rk4.h"
 *     #include <stdio.h>
 *
 *     int main(void)
 *     {
 *         double state[3] = {0.4535961214255773, 0.0, 0.8912073600614354};
 *         size_t completed;
 *         const int status = free_rigid_body_rkmk_rk4_run(state, 0.02, 100, NULL, 0, &completed);
 *         printf("status %d after %zu steps\n", status, completed);
 *         for (int i = 0; i < 3; i++) {
 *             printf("%.17g\n", state[i]);
 *         }
 *         return status;
 *     }
 */
#include "free_rigid_body_rkmk_rk4.h"

#include <math.h>
#include <string.h>

#if defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__
#error "compile without -ffast-math (-ffinite-math-only): it removes the checks for infinities and NaNs"
#endif

/* c_2(z) for z <= 1/256 */
static inline double free_rigid_body_rkmk_rk4_stumpff_tiny_2(double z)
{
    const double w = z * z;
    return (0.5 + z * -0.04166666666666365)
        + w * (0.0013888888842068215 + z * -2.4799519568559804e-05);
}

/* c_1(z) for z <= 1/256 */
static inline double free_rigid_body_rkmk_rk4_stumpff_tiny_1(double z)
{
    const double w = z * z;
    return (1.0 + z * -0.16666666666663651)
        + w * (0.00833333328651266 + z * -0.00019839202108242344);
}

/* c_2(z) for z <= 1/16 */
static inline double free_rigid_body_rkmk_rk4_stumpff_small_2(double z)
{
    const double w = z * z;
    return (0.5 + z * -0.041666666666666664)
        + w * (0.0013888888888888278 + z * -2.4801587297080002e-05)
        + w * w * (2.7557304737591345e-07 + z * -2.0855622118602925e-09);
}

/* c_1(z) for z <= 1/16 */
static inline double free_rigid_body_rkmk_rk4_stumpff_small_1(double z)
{
    const double w = z * z;
    return (1.0 + z * -0.16666666666666666)
        + w * (0.008333333333332476 + z * -0.0001984126983495962)
        + w * w * (2.755729894303353e-06 + z * -2.5022519568470477e-08);
}

/* c_2(z) = sum_j (-z)^j/(2j+2)!, truncated, for 0 <= z <= 1 */
static inline double free_rigid_body_rkmk_rk4_stumpff_series_2(double z)
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
static inline double free_rigid_body_rkmk_rk4_stumpff_series_1(double z)
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
static void free_rigid_body_rkmk_rk4_stumpff_12_far(double z, double *c1, double *c2)
{
    if (z <= 1.0) {
        *c1 = free_rigid_body_rkmk_rk4_stumpff_series_1(z);
        *c2 = free_rigid_body_rkmk_rk4_stumpff_series_2(z);
        return;
    }
    /* NaN if the angle is too large for an accurate result */
    const double half = 0.5 * sqrt(z <= 65536.0 ? z : (double)NAN);
    const double sine = sin(half);
    const double cosine = cos(half);
    const double ratio = sine / half;
    *c1 = ratio * cosine;
    *c2 = 0.5 * (ratio * ratio);
}

/* For z >= 0 and s = sqrt(z): c_1 = sin(s)/s, c_2 = (1 - cos(s))/s^2 */
static inline void free_rigid_body_rkmk_rk4_stumpff_12(double z, double *c1, double *c2)
{
    if (z <= 0.00390625) {
        *c1 = free_rigid_body_rkmk_rk4_stumpff_tiny_1(z);
        *c2 = free_rigid_body_rkmk_rk4_stumpff_tiny_2(z);
    } else if (z <= 0.0625) {
        *c1 = free_rigid_body_rkmk_rk4_stumpff_small_1(z);
        *c2 = free_rigid_body_rkmk_rk4_stumpff_small_2(z);
    } else {
        free_rigid_body_rkmk_rk4_stumpff_12_far(z, c1, c2);
    }
}

/* The loop over the steps of a run. */
static int free_rigid_body_rkmk_rk4_loop(double state[static 3], double h, size_t steps,
    double *trajectory, size_t stride, size_t *completed)
{
    int status = FREE_RIGID_BODY_RKMK_RK4_OK;
    size_t step = 0;
    const int recording = stride > 0 && trajectory != NULL;
    size_t row = 0;
    if (recording) {
        memcpy(trajectory, state, 3 * sizeof *state);
    }
    if (steps > 0 && !isfinite(h)) {
        status = FREE_RIGID_BODY_RKMK_RK4_BAD_STEP;
    }
    double m0 = state[0];
    double m1 = state[1];
    double m2 = state[2];
    while (status == FREE_RIGID_BODY_RKMK_RK4_OK && step < steps) {
        const double w1 = -0.5 * h;
        const double w2 = -0.25 * h;
        const double w3 = m0 * w2;
        const double w4 = 0.5 * h;
        const double w5 = m1 * w4;
        const double w6 = -0.75 * h;
        const double w7 = m2 * w6;
        const double w8 = w3 * w3 + w5 * w5 + w7 * w7;
        double c1_1, c2_1;
        free_rigid_body_rkmk_rk4_stumpff_12(w8, &c1_1, &c2_1);
        const double w10 = m2 * w5 + m1 * w7;
        const double w12 = m1 * w3 + m0 * w5;
        const double w13 = m0 * w7 - m2 * w3;
        const double w14 = m0 - w10 * c1_1 - (w5 * w12 + w7 * w13) * c2_1;
        const double w15 = h * m1;
        const double w16 = m2 + w12 * c1_1 + (w3 * w13 - w5 * w10) * c2_1;
        const double w17 = 0.1875 * h * w16;
        const double w18 = -1.5 * h;
        const double w19 = m2 * w18;
        const double w20 = (w7 * w10 + w3 * w12) * c2_1 - (m1 + w13 * c1_1);
        const double w21 = -0.125 * h * w20;
        const double w22 = w2 * w14 - (w15 * w17 + w19 * w21);
        const double w23 = 0.0625 * h * w14;
        const double w24 = m0 * w1;
        const double w25 = w19 * w23 - w17 * w24 + w4 * w20;
        const double w26 = w15 * w23 + w21 * w24 + w6 * w16;
        const double w27 = w22 * w22 + w25 * w25 + w26 * w26;
        double c1_2, c2_2;
        free_rigid_body_rkmk_rk4_stumpff_12(w27, &c1_2, &c2_2);
        const double w29 = m2 * w25 - m1 * w26;
        const double w31 = m1 * w22 - m0 * w25;
        const double w32 = m0 * w26 - m2 * w22;
        const double w33 = m0 + w29 * c1_2 + (w25 * w31 - w26 * w32) * c2_2;
        const double w34 = w1 * w33;
        const double w35 = m1 + w32 * c1_2 + (w26 * w29 - w22 * w31) * c2_2;
        const double w36 = h * w35;
        const double w37 = m2 + w31 * c1_2 + (w22 * w32 - w25 * w29) * c2_2;
        const double w38 = w18 * w37;
        const double w39 = w34 * w34 + w36 * w36 + w38 * w38;
        double c1_3, c2_3;
        free_rigid_body_rkmk_rk4_stumpff_12(w39, &c1_3, &c2_3);
        const double w41 = m2 * w36 + m1 * w38;
        const double w43 = m1 * w34 + m0 * w36;
        const double w44 = m0 * w38 - m2 * w34;
        const double w45 = m0 - w41 * c1_3 - (w36 * w43 + w38 * w44) * c2_3;
        const double w46 = 0.16666666666666666 * h;
        const double w47 = 0.3333333333333333 * h;
        const double w48 = m2 + w43 * c1_3 + (w34 * w44 - w36 * w41) * c2_3;
        const double w49 = 0.125 * h * w48;
        const double w50 = (w38 * w41 + w34 * w43) * c2_3 - (m1 + w44 * c1_3);
        const double w51 = -0.08333333333333333 * h * w50;
        const double w52 = (-0.5 * m0 - 0.5 * w45) * w46 + (-0.5 * w14 - 0.5 * w33) * w47
            - (w15 * w49 + w19 * w51);
        const double w53 = 0.041666666666666664 * h * w45;
        const double w54 = w19 * w53 - w24 * w49 + (w46 * (w50 - m1) + w47 * (w20 - w35));
        const double w55 = w24 * w51 + w15 * w53
            + (w46 * (-1.5 * m2 - 1.5 * w48) + w47 * (-1.5 * w16 - 1.5 * w37));
        const double w56 = w52 * w52 + w54 * w54 + w55 * w55;
        double c1_4, c2_4;
        free_rigid_body_rkmk_rk4_stumpff_12(w56, &c1_4, &c2_4);
        const double w58 = m2 * w54 - m1 * w55;
        const double w60 = m1 * w52 - m0 * w54;
        const double w61 = m0 * w55 - m2 * w52;
        const double new_m0 = m0 + w58 * c1_4 + (w54 * w60 - w55 * w61) * c2_4;
        const double new_m1 = m1 + w61 * c1_4 + (w55 * w58 - w52 * w60) * c2_4;
        const double new_m2 = m2 + w60 * c1_4 + (w52 * w61 - w54 * w58) * c2_4;
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
            status = FREE_RIGID_BODY_RKMK_RK4_NOT_FINITE;
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
static int free_rigid_body_rkmk_rk4_cause(const double state[static 3], double h)
{
    double same[3];
    memcpy(same, state, sizeof same);
    const int status = free_rigid_body_rkmk_rk4_loop(same, 0.0 * h, 1, NULL, 0, NULL);
    return status == FREE_RIGID_BODY_RKMK_RK4_OK ? FREE_RIGID_BODY_RKMK_RK4_TOO_FAR
        : FREE_RIGID_BODY_RKMK_RK4_NOT_FINITE;
}

int free_rigid_body_rkmk_rk4_run(double state[static 3], double h, size_t steps,
    double *trajectory, size_t stride, size_t *completed)
{
    int status = free_rigid_body_rkmk_rk4_loop(state, h, steps, trajectory, stride, completed);
    if (status == FREE_RIGID_BODY_RKMK_RK4_NOT_FINITE) {
        status = free_rigid_body_rkmk_rk4_cause(state, h);
    }
    return status;
}

int free_rigid_body_rkmk_rk4_step(double state[static 3], double h)
{
    const int status = free_rigid_body_rkmk_rk4_run(state, h, 1, NULL, 0, NULL);
    return status;
}
