/*
 * Free rigid body with attitude, S^3 (thesis section 2.6): one step by discrete_gradient:midpoint
 *
 * method:     family discrete_gradient, tableau midpoint
 * source:     Table 3.2a of Bogfjellmo and Marthinsen
 * order:      2, certificate: exact (every order condition up to it is zero in exact arithmetic)
 * scene:      Free rigid body with attitude, S^3 (thesis section 2.6), group S^3
 * state:      [0..3] y: element of S^3, real part first
 * left out:   1 lin (zeros)
 *             1 act, 1 exp, 2 lin (sharing)
 *             3 act (fusion)
 *             3 exp (dead code)
 *             the time: the scene does not depend on it
 * operations: 55 add, 101 mul, 1 stumpff_01 a step
 *             142 add, 231 mul, 3 quotient, 2 stumpff_01 a sweep of the equations of xi
 * stack:      at most 1856 bytes, without what the mathematical library takes
 * made by:    orderconds emit free_rigid_body_s3 --method discrete_gradient:midpoint --target c -o
 *             .
 * version:    orderconds 0.1.0
 *
 * Build: cc -std=c11 -O2 -ffp-contract=off -c free_rigid_body_s3_discrete_gradient_midpoint.c
 * Use:
 *
 *     #include "free_rigid_body_s3_discrete_gradient_midpoint.h"
 *     #include <stdio.h>
 *
 *     int main(void)
 *     {
 *         double state[4] = {1.0, 0.0, 0.0, 0.0};
 *         size_t completed;
 *         const int status = free_rigid_body_s3_discrete_gradient_midpoint_run(state, 0.02, 100, NULL, 0, NULL, &completed);
 *         printf("status %d after %zu steps\n", status, completed);
 *         for (int i = 0; i < 4; i++) {
 *             printf("%.17g\n", state[i]);
 *         }
 *         return status;
 *     }
 */
#include "free_rigid_body_s3_discrete_gradient_midpoint.h"

#include <math.h>
#include <string.h>

#if defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__
#error "compile without -ffast-math (-ffinite-math-only): it removes the checks for infinities and NaNs"
#endif

/* c_1(z) for z <= 1/16 */
static inline double stumpff_small_1(double z)
{
    const double w = z * z;
    const double w2 = w * w;
    return (1.0 + z * -0.16666666666666666)
        + w * (0.008333333333333333 + z * -0.0001984126984126984)
        + w2 * (2.7557319223985893e-06 + z * -2.505210838544172e-08);
}

/* c_0(z) for z <= 1/16 */
static inline double stumpff_small_0(double z)
{
    const double w = z * z;
    const double w2 = w * w;
    return (1.0 + z * -0.5)
        + w * (0.041666666666666664 + z * -0.001388888888888889)
        + w2 * (2.48015873015873e-05 + z * -2.755731922398589e-07)
        + w * w2 * (2.08767569878681e-09);
}

/* c_1(z) = sum (-z)^j/(2j+1)! up to z = 1 */
static inline double stumpff_series_1(double z)
{
    const double w = z * z;
    const double w2 = w * w;
    double even = -2.505210838544172e-08 + w * -7.647163731819816e-13;
    even = -0.16666666666666666 + w * -0.0001984126984126984 + w2 * even;
    double odd = 1.6059043836821613e-10 + w * 2.8114572543455206e-15;
    odd = 0.008333333333333333 + w * 2.7557319223985893e-06 + w2 * odd;
    return 1.0 + z * (even + z * odd);
}

/* c_0(z) = sum (-z)^j/(2j+0)! up to z = 1 */
static inline double stumpff_series_0(double z)
{
    const double w = z * z;
    const double w2 = w * w;
    double even = -1.5619206968586225e-16;
    even = -2.755731922398589e-07 + w * -1.1470745597729725e-11 + w2 * even;
    even = -0.5 + w * -0.001388888888888889 + w2 * even;
    double odd = 2.08767569878681e-09 + w * 4.779477332387385e-14;
    odd = 0.041666666666666664 + w * 2.48015873015873e-05 + w2 * odd;
    return 1.0 + z * (even + z * odd);
}

/* For z >= 0 and s = sqrt(z): c_0 = cos(s), c_1 = sin(s)/s */
static inline void stumpff_01(double z, double *c0, double *c1)
{
    if (z <= 0.0625) {
        *c0 = stumpff_small_0(z);
        *c1 = stumpff_small_1(z);
        return;
    }
    if (z <= 1.0) {
        *c0 = stumpff_series_0(z);
        *c1 = stumpff_series_1(z);
        return;
    }
    const double s = sqrt(z <= 4503599627370496.0 ? z : NAN);
    const double ratio = sin(s) / s;
    *c0 = cos(s);
    *c1 = ratio;
}

/* a/b, and 0 where b = 0, which is the limit there */
static inline double quotient(double a, double b)
{
    return b > 0.0 || b < 0.0 ? a / b : b;
}

static inline double greater(double a, double b)
{
    return a > b ? a : b;
}

static void count_sweeps(free_rigid_body_s3_discrete_gradient_midpoint_statistics *statistics, size_t block, size_t sweeps, int failed)
{
    if (statistics == NULL) {
        return;
    }
    statistics->sweeps[block] += sweeps;
    if (sweeps > statistics->most) {
        statistics->most = sweeps;
    }
    if (failed) {
        statistics->failed = block + 1;
    }
}

static inline int advance(double state[static 4], double h,
    free_rigid_body_s3_discrete_gradient_midpoint_statistics *statistics)
{
    if (!isfinite(h)) {
        return FREE_RIGID_BODY_S3_DISCRETE_GRADIENT_MIDPOINT_BAD_STEP;
    }
    const double q0 = state[0];
    const double q1 = state[1];
    const double q2 = state[2];
    const double q3 = state[3];
    const double w1 = -0.5 * q3;
    const double w2 = -120.0 * q2 - 5.0 * q3;
    const double w3 = 2.0 * q3;
    const double w4 = 120.0 * q1 + w3;
    const double w5 = -2.0 * q2;
    const double w6 = 5.0 * q1 + w5;
    const double w7 = -1.0 - 0.016666666666666666 * q0 * w6 + 0.016666666666666666 * q1 * w4
        - 0.016666666666666666 * q2 * w2;
    const double w8 = 1.0 - q0 * w2 + q2 * w6 - q3 * w4;
    const double w9 = w3 * w8 - 2.0 * q1 * w7;
    const double w10 = 0.5 * q2;
    const double w11 = 0.5 - 0.2 * q0 * w4 - 0.2 * q1 * w6 + 0.2 * q3 * w2;
    const double w12 = w5 * w8 + 2.0 * q1 * w11;
    const double w13 = 2.0 * q2 * w7 - 2.0 * q3 * w11;
    const double w14 = 0.5 * q0;
    const double w15 = 0.5 - 0.5 * q0 * w2 + w13 * w14 + w6 * w10 + w10 * w12 + w1 * w4;
    const double w16 = 0.25 - 0.1 * q0 * w4 + w9 * w14 - 0.1 * q1 * w6 - 0.5 * q1 * w12;
    const double w17 = -0.5 - 0.008333333333333333 * q0 * w6 + w12 * w14
        + 0.008333333333333333 * q1 * w4 + 0.5 * q1 * w9;
    const double w18 = 0.5 * h;
    const double w73 = w8 * w8;
    const double w74 = 0.5 * w73;
    const double w75 = q1 * w4;
    const double w76 = q0 * w6;
    const double w77 = -60.0 - w76;
    const double w78 = w75 + w77;
    const double w79 = q2 * w2;
    const double w80 = w78 - w79;
    const double w81 = 0.5 * w80;
    const double w82 = w7 * w81;
    const double w83 = q3 * w2;
    const double w84 = q0 * w4;
    const double w85 = 2.5 - w84;
    const double w86 = q1 * w6;
    const double w87 = w85 - w86;
    const double w88 = w83 + w87;
    const double w89 = 0.5 * w88;
    const double w90 = w11 * w89;
    const double w91 = w82 + w90;
    const double H0 = w74 + w91;
    /* the equations of xi: fixed point in xi_0, xi_1, xi_2 */
    double xi_0 = w1 * w9 + w15;
    double xi_1 = w16 + 0.1 * q3 * w2 + 0.5 * q3 * w13;
    double xi_2 = w17 - 0.008333333333333333 * q2 * w2 - 0.5 * q2 * w13;
    double f_0, f_1, f_2;
    double previous_1 = 0.0;
    for (size_t sweep = 1;; sweep++) {
        const double x1_0 = xi_0 * w18;
        const double x1_1 = xi_1 * w18;
        const double x1_2 = xi_2 * w18;
        const double w19 = x1_0 * x1_0 + x1_1 * x1_1 + x1_2 * x1_2;
        double c0_1, c1_1;
        stumpff_01(w19, &c0_1, &c1_1);
        const double w21 = x1_0 * c1_1;
        const double w22 = x1_1 * c1_1;
        const double w24 = x1_2 * c1_1;
        const double Y1_3 = q2 * w21 - q1 * w22 + (q0 * w24 + q3 * c0_1);
        const double w25 = -0.5 * Y1_3;
        const double Y1_2 = q1 * w24 - q3 * w21 + (q0 * w22 + q2 * c0_1);
        const double w26 = -120.0 * Y1_2 - 5.0 * Y1_3;
        const double w27 = -0.016666666666666666 * Y1_2;
        const double Y1_1 = q3 * w22 - q2 * w24 + (q0 * w21 + q1 * c0_1);
        const double w28 = 2.0 * Y1_3;
        const double w29 = 120.0 * Y1_1 + w28;
        const double w30 = 0.016666666666666666 * Y1_1;
        const double w31 = -2.0 * Y1_2;
        const double w32 = 5.0 * Y1_1 + w31;
        const double Y1_0 = q0 * c0_1 - (q1 * w21 + q2 * w22 + q3 * w24);
        const double w33 = -0.016666666666666666 * Y1_0;
        const double w34 = w32 * w33 - 1.0 + w29 * w30 + w26 * w27;
        const double w35 = 1.0 - w26 * Y1_0 + Y1_2 * w32;
        const double w36 = Y1_3 * w29;
        const double w37 = w35 - w36;
        const double w38 = w28 * w37 - 2.0 * Y1_1 * w34;
        const double w39 = 0.5 * Y1_2;
        const double w40 = 0.2 * Y1_3;
        const double w41 = -0.2 * Y1_1;
        const double w42 = -0.2 * Y1_0;
        const double w43 = 0.5 + w29 * w42 + w32 * w41 + w26 * w40;
        const double w44 = 2.0 * Y1_1 * w43 + w31 * w37;
        const double w45 = 2.0 * Y1_2 * w34 - 2.0 * Y1_3 * w43;
        const double w46 = 0.5 * Y1_0;
        const double w47 = 0.5 - 0.5 * Y1_0 * w26 + w45 * w46 + w32 * w39 + w39 * w44 + w25 * w29;
        const double w48 = w25 * w38 + w47;
        const double w49 = 0.5 * (2.5 - w29 * Y1_0 - Y1_1 * w32 + Y1_3 * w26);
        const double w50 = 0.5 * w43;
        const double w51 = 0.5 * w34;
        const double w52 = 0.5 * (-60.0 - w32 * Y1_0 + Y1_1 * w29 - Y1_2 * w26);
        const double w53 = w36 - w35;
        const double w54 = w42 * w49 - Y1_0 * w50 + Y1_1 * w51 + w30 * w52 + Y1_3 * w53;
        const double w55 = -0.2 * (w32 * w49) - w32 * w50 + w29 * w51
            + 0.016666666666666666 * (w29 * w52) + 120.0 * w54;
        const double w56 = w41 * w49 - Y1_1 * w50 - Y1_0 * w51 + w33 * w52 + Y1_2 * w37;
        const double w57 = w55 + 5.0 * w56;
        const double w58 = -0.2 * (w29 * w49) - w29 * w50 - w32 * w51
            - 0.016666666666666666 * (w32 * w52) + w26 * w53;
        const double w59 = Y1_3 * w50 + w40 * w49 - Y1_2 * w51 + w27 * w52 + Y1_0 * w53;
        const double w60 = -0.016666666666666666 * (w26 * w52) - w26 * w51 - 120.0 * w59 + w32 * w37
            - 2.0 * w56;
        const double w61 = w26 * w50 + 0.2 * (w26 * w49) + w29 * w53 + 2.0 * w54 - 5.0 * w59;
        const double d1_0 = Y1_0 * w57 - Y1_1 * w58 - Y1_3 * w60 + Y1_2 * w61;
        const double x_0 = h * xi_0;
        const double x_2 = h * xi_2;
        const double x_1 = h * xi_1;
        const double w62 = x_0 * x_0 + x_1 * x_1 + x_2 * x_2;
        double c0_2, c1_2;
        stumpff_01(w62, &c0_2, &c1_2);
        const double w64 = x_2 * c1_2;
        const double w65 = x_0 * c1_2;
        const double w67 = x_1 * c1_2;
        const double Y_2 = q1 * w64 - q3 * w65 + (q0 * w67 + q2 * c0_2);
        const double Y_1 = q3 * w67 - q2 * w64 + (q0 * w65 + q1 * c0_2);
        const double w68 = 5.0 * Y_1 - 2.0 * Y_2;
        const double Y_0 = q0 * c0_2 - (q1 * w65 + q2 * w67 + q3 * w64);
        const double Y_3 = q2 * w65 - q1 * w67 + (q0 * w64 + q3 * c0_2);
        const double w69 = -120.0 * Y_2 - 5.0 * Y_3;
        const double w70 = 120.0 * Y_1 + 2.0 * Y_3;
        const double w71 = (-1.0 - 0.016666666666666666 * Y_0 * w68 + 0.016666666666666666 * Y_1 * w70 - 0.016666666666666666 * Y_2 * w69)
            * (0.5 * (-60.0 - w68 * Y_0 + Y_1 * w70 - Y_2 * w69));
        const double w72 = (0.5 - 0.2 * Y_0 * w70 - 0.2 * Y_1 * w68 + 0.2 * Y_3 * w69)
            * (0.5 * (2.5 - Y_0 * w70 - Y_1 * w68 + Y_3 * w69));
        const double p_1 = 1.0 - Y_0 * w69 + Y_2 * w68 - Y_3 * w70;
        const double H1 = w71 + w72 + 0.5 * (p_1 * p_1);
        const double d1_1 = Y1_3 * w57 - Y1_2 * w58 + Y1_0 * w60 - Y1_1 * w61;
        const double d1_2 = Y1_1 * w60 - (Y1_3 * w58 + Y1_2 * w57) + Y1_0 * w61;
        const double w92 = quotient(H1 - H0 - (d1_0 * x_0 + x_1 * d1_1 + x_2 * d1_2), w62);
        const double D_0 = d1_0 + x_0 * w92;
        const double D_1 = d1_1 + x_1 * w92;
        const double D_2 = d1_2 + x_2 * w92;
        const double w93 = d1_0 * d1_0 + d1_1 * d1_1 + d1_2 * d1_2;
        const double w94 = quotient(d1_0 * D_0 + d1_1 * D_1 + d1_2 * D_2, w93);
        const double w95 = 0.25 - 0.1 * Y1_0 * w29 + w38 * w46 - 0.1 * Y1_1 * w32
            - 0.5 * Y1_1 * w44;
        const double w96 = 0.1 * Y1_3 * w26 + w95 + 0.5 * Y1_3 * w45;
        const double w97 = -0.5 - 0.008333333333333333 * Y1_0 * w32 + w44 * w46
            + 0.008333333333333333 * Y1_1 * w29 + 0.5 * Y1_1 * w38;
        const double w98 = w97 - 0.008333333333333333 * Y1_2 * w26 - 0.5 * Y1_2 * w45;
        const double w99 = quotient(D_1 * w96 + w48 * D_0 + D_2 * w98, w93);
        f_0 = w48 * w94 - d1_0 * w99;
        f_1 = w94 * w96 - d1_1 * w99;
        f_2 = w94 * w98 - d1_2 * w99;
        const double change_xi_0 = fabs(f_0 - xi_0);
        const double change_xi_1 = fabs(f_1 - xi_1);
        const double change_xi_2 = fabs(f_2 - xi_2);
        const double change = greater(change_xi_0, greater(change_xi_1, change_xi_2));
        const double scale = greater(greater(1.0, fabs(xi_0)), greater(fabs(xi_1), fabs(xi_2)));
        if (!isfinite(change_xi_0 + change_xi_1 + change_xi_2)) {
            count_sweeps(statistics, 0, sweep, 1);
            return FREE_RIGID_BODY_S3_DISCRETE_GRADIENT_MIDPOINT_NOT_FINITE;
        }
        const int still = previous_1 > 0.0 && change >= previous_1;
        const int close = change <= 3.552713678800501e-15 * scale
            && change * change <= 1.1102230246251565e-16 * scale * previous_1;
        if (close || (still && change <= 5.684341886080802e-14 * scale)) {
            count_sweeps(statistics, 0, sweep, 0);
            break;
        }
        if (sweep == 100) {
            count_sweeps(statistics, 0, sweep, 1);
            return FREE_RIGID_BODY_S3_DISCRETE_GRADIENT_MIDPOINT_NOT_CONVERGED;
        }
        previous_1 = change;
        xi_0 = f_0;
        xi_1 = f_1;
        xi_2 = f_2;
    }
    const double x1_2_0 = h * f_0;
    const double x1_2_1 = h * f_1;
    const double x1_2_2 = h * f_2;
    const double w100 = x1_2_0 * x1_2_0 + x1_2_1 * x1_2_1 + x1_2_2 * x1_2_2;
    double c0_3, c1_3;
    stumpff_01(w100, &c0_3, &c1_3);
    const double w103 = x1_2_0 * c1_3;
    const double w104 = x1_2_1 * c1_3;
    const double w105 = x1_2_2 * c1_3;
    const double new_q0 = q0 * c0_3 - (q1 * w103 + q2 * w104 + q3 * w105);
    const double new_q1 = q3 * w104 - q2 * w105 + (q0 * w103 + q1 * c0_3);
    const double new_q2 = q1 * w105 - q3 * w103 + (q0 * w104 + q2 * c0_3);
    const double new_q3 = q2 * w103 - q1 * w104 + (q0 * w105 + q3 * c0_3);
    if (!(isfinite(new_q0) && isfinite(new_q1) && isfinite(new_q2) && isfinite(new_q3))) {
        return FREE_RIGID_BODY_S3_DISCRETE_GRADIENT_MIDPOINT_NOT_FINITE;
    }
    state[0] = new_q0;
    state[1] = new_q1;
    state[2] = new_q2;
    state[3] = new_q3;
    return FREE_RIGID_BODY_S3_DISCRETE_GRADIENT_MIDPOINT_OK;
}

int free_rigid_body_s3_discrete_gradient_midpoint_step(double state[static 4], double h,
    free_rigid_body_s3_discrete_gradient_midpoint_statistics *statistics)
{
    return advance(state, h, statistics);
}

int free_rigid_body_s3_discrete_gradient_midpoint_run(double state[static 4], double h,
    size_t steps, double *trajectory, size_t stride,
    free_rigid_body_s3_discrete_gradient_midpoint_statistics *statistics, size_t *completed)
{
    int status = FREE_RIGID_BODY_S3_DISCRETE_GRADIENT_MIDPOINT_OK;
    size_t step = 0;
    double *row = stride > 0 ? trajectory : NULL;
    if (row != NULL) {
        memcpy(row, state, 4 * sizeof *state);
    }
    while (step < steps) {
        status = advance(state, h, statistics);
        if (status != FREE_RIGID_BODY_S3_DISCRETE_GRADIENT_MIDPOINT_OK) {
            break;
        }
        step++;
        if (row != NULL && step % stride == 0) {
            row += 4;
            memcpy(row, state, 4 * sizeof *state);
        }
    }
    if (completed != NULL) {
        *completed = step;
    }
    return status;
}
