/*
 * Free rigid body on the sphere: one step by cg:cg3
 *
 * method:     family cg, tableau cg3
 * source:     Crouch and Grossman 1993; Hairer, Lubich and Wanner, Table IV.8.1, left
 * order:      3, certificate: exact (the residuals of all order conditions up to this order are
 *             zero in exact arithmetic)
 * digits:     with the coefficients rounded to double precision, the residuals of the order
 *             conditions are at most 1.6e-16
 * scene:      Free rigid body on the sphere, group SO(3)
 * state:      [0..2] y: point on which SO(3) acts by rotation
 * left out:   1 evaluation of the field: equal values are computed once
 *             6 exponentials: exp(x).y is computed without exp(x)
 *             arguments for constant parameters: alpha = 0
 *             the time is not needed: no formula depends on the time
 *             a solver for implicit equations: all stages are explicit
 * operations: 84 add, 161 mul, 6 stumpff_12 a step
 * stack:      at most 1152 bytes with gcc 12 and clang 14 at -O0 to -O3 on x86-64; math library
 *             functions need extra bytes
 * command:    orderconds emit free_rigid_body --method cg:cg3 --target c -o .
 * version:    orderconds 0.1.0
 *
 * Build: cc -std=c11 -O2 -ffp-contract=off -c free_rigid_body_cg3.c
 * Use:
 *
 *     #include "free_rigid_body_cg3.h"
 *     #include <stdio.h>
 *
 *     int main(void)
 *     {
 *         double state[3] = {0.4535961214255773, 0.0, 0.8912073600614354};
 *         size_t completed;
 *         const int status = free_rigid_body_cg3_run(state, 0.02, 100, NULL, 0, &completed);
 *         printf("status %d after %zu steps\n", status, completed);
 *         for (int i = 0; i < 3; i++) {
 *             printf("%.17g\n", state[i]);
 *         }
 *         return status;
 *     }
 */
#include "free_rigid_body_cg3.h"

#include <math.h>
#include <string.h>

#if defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__
#error "compile without -ffast-math (-ffinite-math-only): it removes the checks for infinities and NaNs"
#endif

/* c_2(z) for z <= 1/256 */
static inline double free_rigid_body_cg3_stumpff_tiny_2(double z)
{
    const double w = z * z;
    return (0.5 + z * -0.04166666666666365)
        + w * (0.0013888888842068215 + z * -2.4799519568559804e-05);
}

/* c_1(z) for z <= 1/256 */
static inline double free_rigid_body_cg3_stumpff_tiny_1(double z)
{
    const double w = z * z;
    return (1.0 + z * -0.16666666666663651)
        + w * (0.00833333328651266 + z * -0.00019839202108242344);
}

/* c_2(z) for z <= 1/16 */
static inline double free_rigid_body_cg3_stumpff_small_2(double z)
{
    const double w = z * z;
    return (0.5 + z * -0.041666666666666664)
        + w * (0.0013888888888888278 + z * -2.4801587297080002e-05)
        + w * w * (2.7557304737591345e-07 + z * -2.0855622118602925e-09);
}

/* c_1(z) for z <= 1/16 */
static inline double free_rigid_body_cg3_stumpff_small_1(double z)
{
    const double w = z * z;
    return (1.0 + z * -0.16666666666666666)
        + w * (0.008333333333332476 + z * -0.0001984126983495962)
        + w * w * (2.755729894303353e-06 + z * -2.5022519568470477e-08);
}

/* c_2(z) = sum_j (-z)^j/(2j+2)!, truncated, for 0 <= z <= 1 */
static inline double free_rigid_body_cg3_stumpff_series_2(double z)
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
static inline double free_rigid_body_cg3_stumpff_series_1(double z)
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
static void free_rigid_body_cg3_stumpff_12_far(double z, double *c1, double *c2)
{
    if (z <= 1.0) {
        *c1 = free_rigid_body_cg3_stumpff_series_1(z);
        *c2 = free_rigid_body_cg3_stumpff_series_2(z);
        return;
    }
    /* NaN if the angle is too large for an accurate result */
    const double half = 0.5 * sqrt(z <= 16777216.0 ? z : (double)NAN);
    const double sine = sin(half);
    const double cosine = cos(half);
    const double ratio = sine / half;
    *c1 = ratio * cosine;
    *c2 = 0.5 * (ratio * ratio);
}

/* For z >= 0 and s = sqrt(z): c_1 = sin(s)/s, c_2 = (1 - cos(s))/s^2 */
static inline void free_rigid_body_cg3_stumpff_12(double z, double *c1, double *c2)
{
    if (z <= 0.00390625) {
        *c1 = free_rigid_body_cg3_stumpff_tiny_1(z);
        *c2 = free_rigid_body_cg3_stumpff_tiny_2(z);
    } else if (z <= 0.0625) {
        *c1 = free_rigid_body_cg3_stumpff_small_1(z);
        *c2 = free_rigid_body_cg3_stumpff_small_2(z);
    } else {
        free_rigid_body_cg3_stumpff_12_far(z, c1, c2);
    }
}

/* The loop over the steps of a run. */
static int free_rigid_body_cg3_loop(double state[static 3], double h, size_t steps,
    double *trajectory, size_t stride, size_t *completed)
{
    int status = FREE_RIGID_BODY_CG3_OK;
    size_t step = 0;
    const int recording = stride > 0 && trajectory != NULL;
    size_t row = 0;
    if (recording) {
        memcpy(trajectory, state, 3 * sizeof *state);
    }
    if (steps > 0 && !isfinite(h)) {
        status = FREE_RIGID_BODY_CG3_BAD_STEP;
    }
    double m0 = state[0];
    double m1 = state[1];
    double m2 = state[2];
    while (status == FREE_RIGID_BODY_CG3_OK && step < steps) {
        const double w1 = -0.12745098039215685 * h * m0;
        const double w2 = 0.2549019607843137 * h * m1;
        const double w3 = -0.38235294117647056 * h * m2;
        const double w4 = w1 * w1 + w2 * w2 + w3 * w3;
        double c1_1, c2_1;
        free_rigid_body_cg3_stumpff_12(w4, &c1_1, &c2_1);
        const double w6 = m2 * w2 + m1 * w3;
        const double w8 = m1 * w1 + m0 * w2;
        const double w9 = m0 * w3 - m2 * w1;
        const double w10 = m0 - w6 * c1_1 - (w2 * w8 + w3 * w9) * c2_1;
        const double w11 = -0.375 * h * m0;
        const double w12 = 0.75 * h * m1;
        const double w13 = -1.125 * h * m2;
        const double w14 = w11 * w11 + w12 * w12 + w13 * w13;
        double c1_2, c2_2;
        free_rigid_body_cg3_stumpff_12(w14, &c1_2, &c2_2);
        const double w16 = m2 * w12 + m1 * w13;
        const double w18 = m1 * w11 + m0 * w12;
        const double w19 = m0 * w13 - m2 * w11;
        const double w20 = m0 - w16 * c1_2 - (w12 * w18 + w13 * w19) * c2_2;
        const double w21 = 0.3333333333333333 * h * w20;
        const double w22 = (w13 * w16 + w11 * w18) * c2_2 - (m1 + w19 * c1_2);
        const double w23 = -0.6666666666666666 * h * w22;
        const double w24 = m2 + w18 * c1_2 + (w11 * w19 - w12 * w16) * c2_2;
        const double w25 = h * w24;
        const double w26 = w21 * w21 + w23 * w23 + w25 * w25;
        double c1_3, c2_3;
        free_rigid_body_cg3_stumpff_12(w26, &c1_3, &c2_3);
        const double w28 = m2 + w8 * c1_1 + (w1 * w9 - w2 * w6) * c2_1;
        const double w29 = m1 + w9 * c1_1 - (w3 * w6 + w1 * w8) * c2_1;
        const double w30 = w23 * w28 - w25 * w29;
        const double w32 = w21 * w29 - w10 * w23;
        const double w33 = w10 * w25 - w21 * w28;
        const double w34 = w10 + w30 * c1_3 + (w23 * w32 - w25 * w33) * c2_3;
        const double w35 = -0.27546296296296297 * h * m0;
        const double w36 = 0.5509259259259259 * h * m1;
        const double w37 = -0.8263888888888888 * h * m2;
        const double w38 = w35 * w35 + w36 * w36 + w37 * w37;
        double c1_4, c2_4;
        free_rigid_body_cg3_stumpff_12(w38, &c1_4, &c2_4);
        const double w40 = m2 * w36 + m1 * w37;
        const double w42 = m1 * w35 + m0 * w36;
        const double w43 = m0 * w37 - m2 * w35;
        const double w44 = m0 - w40 * c1_4 - (w36 * w42 + w37 * w43) * c2_4;
        const double w45 = -0.0787037037037037 * h * w20;
        const double w46 = 0.1574074074074074 * h * w22;
        const double w47 = -0.2361111111111111 * h * w24;
        const double w48 = w45 * w45 + w46 * w46 + w47 * w47;
        double c1_5, c2_5;
        free_rigid_body_cg3_stumpff_12(w48, &c1_5, &c2_5);
        const double w50 = m2 + w42 * c1_4 + (w35 * w43 - w36 * w40) * c2_4;
        const double w51 = m1 + w43 * c1_4 - (w37 * w40 + w35 * w42) * c2_4;
        const double w52 = w46 * w50 - w47 * w51;
        const double w54 = w45 * w51 - w44 * w46;
        const double w55 = w44 * w47 - w45 * w50;
        const double w56 = -0.7058823529411765 * h
            * (w44 + w52 * c1_5 + (w46 * w54 - w47 * w55) * c2_5);
        const double w57 = 1.411764705882353 * h
            * (w51 + w55 * c1_5 + (w47 * w52 - w45 * w54) * c2_5);
        const double w58 = -2.1176470588235294 * h
            * (w50 + w54 * c1_5 + (w45 * w55 - w46 * w52) * c2_5);
        const double w59 = w56 * w56 + w57 * w57 + w58 * w58;
        double c1_6, c2_6;
        free_rigid_body_cg3_stumpff_12(w59, &c1_6, &c2_6);
        const double w61 = w28 + w32 * c1_3 + (w21 * w33 - w23 * w30) * c2_3;
        const double w62 = w29 + w33 * c1_3 + (w25 * w30 - w21 * w32) * c2_3;
        const double w63 = w57 * w61 + w58 * w62;
        const double w65 = w34 * w57 + w56 * w62;
        const double w66 = w34 * w58 - w56 * w61;
        const double new_m0 = w34 - w63 * c1_6 - (w57 * w65 + w58 * w66) * c2_6;
        const double new_m1 = w62 + w66 * c1_6 - (w58 * w63 + w56 * w65) * c2_6;
        const double new_m2 = w61 + w65 * c1_6 + (w56 * w66 - w57 * w63) * c2_6;
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
            status = FREE_RIGID_BODY_CG3_NOT_FINITE;
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
static int free_rigid_body_cg3_cause(const double state[static 3], double h)
{
    double same[3];
    memcpy(same, state, sizeof same);
    const int status = free_rigid_body_cg3_loop(same, 0.0 * h, 1, NULL, 0, NULL);
    return status == FREE_RIGID_BODY_CG3_OK ? FREE_RIGID_BODY_CG3_TOO_FAR
        : FREE_RIGID_BODY_CG3_NOT_FINITE;
}

int free_rigid_body_cg3_run(double state[static 3], double h, size_t steps,
    double *trajectory, size_t stride, size_t *completed)
{
    int status = free_rigid_body_cg3_loop(state, h, steps, trajectory, stride, completed);
    if (status == FREE_RIGID_BODY_CG3_NOT_FINITE) {
        status = free_rigid_body_cg3_cause(state, h);
    }
    return status;
}

int free_rigid_body_cg3_step(double state[static 3], double h)
{
    const int status = free_rigid_body_cg3_run(state, h, 1, NULL, 0, NULL);
    return status;
}
