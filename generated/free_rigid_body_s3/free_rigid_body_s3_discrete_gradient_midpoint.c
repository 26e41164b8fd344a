/*
 * Free rigid body with attitude, S^3 (thesis section 2.6): one step by discrete_gradient:midpoint
 *
 * method:     family discrete_gradient, tableau midpoint
 * source:     Table 3.2a of Bogfjellmo and Marthinsen
 * order:      2, certificate: exact (every order condition up to it is zero in exact arithmetic)
 * scene:      Free rigid body with attitude, S^3 (thesis section 2.6), group S^3
 * solved by:  the equations of xi: Newton's method, 3 unknowns (a fixed point does not settle with
 *             steps 8 times as long)
 * state:      [0..3] y: element of S^3, real part first
 * left out:   1 lin (zeros)
 *             1 act, 1 exp, 2 lin (sharing)
 *             3 act (fusion)
 *             3 exp (dead code)
 *             the time: the scene does not depend on it
 * operations: 34 add, 59 mul, 1 stumpff_01 a step
 *             21 add, 42 mul a start, in steps that follow no other
 *             606 add, 798 mul, 2 quotient, 2 stumpff_23 a matrix of the equations of xi
 *             148 add, 240 mul, 3 quotient, 2 stumpff_01 a sweep of the equations of xi
 * stack:      at most 5184 bytes, without what the mathematical library takes
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

/* c_3(z) for z <= 1/16 */
static inline double stumpff_small_3(double z)
{
    const double w = z * z;
    const double w2 = w * w;
    return (0.16666666666666666 + z * -0.008333333333333333)
        + w * (0.0001984126984126984 + z * -2.7557319223985893e-06)
        + w2 * (2.505210838544172e-08 + z * -1.6059043836821613e-10);
}

/* c_2(z) for z <= 1/16 */
static inline double stumpff_small_2(double z)
{
    const double w = z * z;
    const double w2 = w * w;
    return (0.5 + z * -0.041666666666666664)
        + w * (0.001388888888888889 + z * -2.48015873015873e-05)
        + w2 * (2.755731922398589e-07 + z * -2.08767569878681e-09);
}

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

/* c_3(z) = sum (-z)^j/(2j+3)! up to z = 4 */
static inline double stumpff_series_3(double z)
{
    const double w = z * z;
    const double w2 = w * w;
    double even = -1.9572941063391263e-20;
    even = -1.6059043836821613e-10 + w * -2.8114572543455206e-15 + w2 * even;
    even = -0.008333333333333333 + w * -2.7557319223985893e-06 + w2 * even;
    double odd = 3.868170170630684e-23;
    odd = 7.647163731819816e-13 + w * 8.22063524662433e-18 + w2 * odd;
    odd = 0.0001984126984126984 + w * 2.505210838544172e-08 + w2 * odd;
    return 0.16666666666666666 + z * (even + z * odd);
}

/* c_2(z) = sum (-z)^j/(2j+2)! up to z = 1 */
static inline double stumpff_series_2(double z)
{
    const double w = z * z;
    const double w2 = w * w;
    double even = -2.08767569878681e-09 + w * -4.779477332387385e-14;
    even = -0.041666666666666664 + w * -2.48015873015873e-05 + w2 * even;
    double odd = 1.1470745597729725e-11 + w * 1.5619206968586225e-16;
    odd = 0.001388888888888889 + w * 2.755731922398589e-07 + w2 * odd;
    return 0.5 + z * (even + z * odd);
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

/* For z > 1/16 and s = sqrt(z): c_2 = (1 - cos(s))/s^2, c_3 = (s - sin(s))/s^3 */
static void stumpff_23_far(double z, double *c2, double *c3)
{
    if (z <= 1.0) {
        *c2 = stumpff_series_2(z);
        *c3 = stumpff_series_3(z);
        return;
    }
    const double half = 0.5 * sqrt(z <= 4503599627370496.0 ? z : NAN);
    const double sine = sin(half);
    const double cosine = cos(half);
    const double ratio = sine / half;
    *c2 = 0.5 * (ratio * ratio);
    *c3 = z <= 4.0 ? stumpff_series_3(z) : (1.0 - ratio * cosine) / z;
}

/* For z >= 0 and s = sqrt(z): c_2 = (1 - cos(s))/s^2, c_3 = (s - sin(s))/s^3 */
static inline void stumpff_23(double z, double *c2, double *c3)
{
    if (z <= 0.0625) {
        *c2 = stumpff_small_2(z);
        *c3 = stumpff_small_3(z);
    } else {
        stumpff_23_far(z, c2, c3);
    }
}

/* For z > 1/16 and s = sqrt(z): c_0 = cos(s), c_1 = sin(s)/s */
static void stumpff_01_far(double z, double *c0, double *c1)
{
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

/* For z >= 0 and s = sqrt(z): c_0 = cos(s), c_1 = sin(s)/s */
static inline void stumpff_01(double z, double *c0, double *c1)
{
    if (z <= 0.0625) {
        *c0 = stumpff_small_0(z);
        *c1 = stumpff_small_1(z);
    } else {
        stumpff_01_far(z, c0, c1);
    }
}

/* a/b, and 0 where b = 0, which is the limit there */
static inline double quotient(double a, double b)
{
    return b > 0.0 || b < 0.0 ? a / b : b;
}

/* Replace an n x n matrix, by rows, by its inverse (Gauss-Jordan, rows exchanged); return 0 where it has none. */
static int invert(size_t n, double *a, size_t *order)
{
    for (size_t k = 0; k < n; k++) {
        size_t pivot = k;
        for (size_t i = k + 1; i < n; i++) {
            if (fabs(a[i * n + k]) > fabs(a[pivot * n + k])) {
                pivot = i;
            }
        }
        if (!(fabs(a[pivot * n + k]) > 0.0)) {
            return 0;
        }
        order[k] = pivot;
        for (size_t j = 0; j < n; j++) {
            const double kept = a[k * n + j];
            a[k * n + j] = a[pivot * n + j];
            a[pivot * n + j] = kept;
        }
        const double factor = 1.0 / a[k * n + k];
        a[k * n + k] = 1.0;
        for (size_t j = 0; j < n; j++) {
            a[k * n + j] *= factor;
        }
        for (size_t i = 0; i < n; i++) {
            if (i != k) {
                const double multiple = a[i * n + k];
                a[i * n + k] = 0.0;
                for (size_t j = 0; j < n; j++) {
                    a[i * n + j] -= multiple * a[k * n + j];
                }
            }
        }
    }
    for (size_t k = n; k-- > 0;) {
        for (size_t i = 0; i < n; i++) {
            const double kept = a[i * n + k];
            a[i * n + k] = a[i * n + order[k]];
            a[i * n + order[k]] = kept;
        }
    }
    return 1;
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

static void count_matrix(free_rigid_body_s3_discrete_gradient_midpoint_statistics *statistics)
{
    if (statistics != NULL) {
        statistics->matrices++;
    }
}

/* What one step of a run leaves for the next: solutions of its equations, the latest first, and inverses of Newton's matrices. */
struct memory {
    size_t known;
    double past[3][3];
    int made_1;
    double inverse_1[9];
};

/* The polynomial through the last solutions, continued by a step. */
static inline double extrapolated(const struct memory *memory, size_t i)
{
    const double last = memory->past[0][i];
    switch (memory->known) {
    case 1:
        return last;
    case 2:
        return 2.0 * last - memory->past[1][i];
    default:
        return 3.0 * (last - memory->past[1][i]) + memory->past[2][i];
    }
}

static inline int advance(double state[static 4], double h, struct memory *memory,
    free_rigid_body_s3_discrete_gradient_midpoint_statistics *statistics)
{
    if (!isfinite(h)) {
        return FREE_RIGID_BODY_S3_DISCRETE_GRADIENT_MIDPOINT_BAD_STEP;
    }
    const double q0 = state[0];
    const double q1 = state[1];
    const double q2 = state[2];
    const double q3 = state[3];
    const double w1 = -120.0 * q2 - 5.0 * q3;
    const double w2 = 2.0 * q3;
    const double w3 = 120.0 * q1 + w2;
    const double w4 = -2.0 * q2;
    const double w5 = 5.0 * q1 + w4;
    const double w6 = -1.0 - 0.016666666666666666 * q0 * w5 + 0.016666666666666666 * q1 * w3
        - 0.016666666666666666 * q2 * w1;
    const double w7 = 1.0 - q0 * w1 + q2 * w5 - q3 * w3;
    const double w8 = 0.5 - 0.2 * q0 * w3 - 0.2 * q1 * w5 + 0.2 * q3 * w1;
    double xi_0, xi_1, xi_2;
    if (memory->known > 0) {
        xi_0 = extrapolated(memory, 0);
        xi_1 = extrapolated(memory, 1);
        xi_2 = extrapolated(memory, 2);
    } else {
        const double w9 = -0.5 * q3;
        const double w10 = w2 * w7 - 2.0 * q1 * w6;
        const double w11 = 0.5 * q2;
        const double w12 = w4 * w7 + 2.0 * q1 * w8;
        const double w13 = 2.0 * q2 * w6 - 2.0 * q3 * w8;
        const double w14 = 0.5 * q0;
        const double w15 = 0.5 - 0.5 * q0 * w1 + w13 * w14 + w5 * w11 + w11 * w12 + w3 * w9;
        const double w16 = 0.25 - 0.1 * q0 * w3 + w10 * w14 - 0.1 * q1 * w5 - 0.5 * q1 * w12;
        const double w17 = -0.5 - 0.008333333333333333 * q0 * w5 + w12 * w14
            + 0.008333333333333333 * q1 * w3 + 0.5 * q1 * w10;
        xi_0 = w9 * w10 + w15;
        xi_1 = w16 + 0.1 * q3 * w1 + 0.5 * q3 * w13;
        xi_2 = w17 - 0.008333333333333333 * q2 * w1 - 0.5 * q2 * w13;
    }
    const double w18 = 0.5 * h;
    const double w94 = w7 * w7;
    const double w95 = 0.5 * w94;
    const double w96 = q1 * w3;
    const double w97 = q0 * w5;
    const double w98 = -60.0 - w97;
    const double w99 = w96 + w98;
    const double w100 = q2 * w1;
    const double w101 = w99 - w100;
    const double w102 = 0.5 * w101;
    const double w103 = w6 * w102;
    const double w104 = q3 * w1;
    const double w105 = q0 * w3;
    const double w106 = 2.5 - w105;
    const double w107 = q1 * w5;
    const double w108 = w106 - w107;
    const double w109 = w104 + w108;
    const double w110 = 0.5 * w109;
    const double w111 = w8 * w110;
    const double w112 = w103 + w111;
    const double H0 = w95 + w112;
    /* the equations of xi: Newton's method in xi_0, xi_1, xi_2 */
    double previous_1 = 0.0;
    int make_1 = !memory->made_1;
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
        const double w33 = q0 * c0_1;
        const double w34 = q1 * w21 + q2 * w22 + q3 * w24;
        const double Y1_0 = w33 - w34;
        const double w35 = -0.016666666666666666 * Y1_0;
        const double w36 = w32 * w35 - 1.0 + w29 * w30 + w26 * w27;
        const double w37 = -2.0 * Y1_1;
        const double w38 = 1.0 - w26 * Y1_0 + Y1_2 * w32;
        const double w39 = Y1_3 * w29;
        const double w40 = w38 - w39;
        const double w41 = w36 * w37 + w28 * w40;
        const double w42 = 0.5 * Y1_2;
        const double w43 = 0.2 * Y1_3;
        const double w44 = -0.2 * Y1_1;
        const double w45 = -0.2 * Y1_0;
        const double w46 = 0.5 + w29 * w45 + w32 * w44 + w26 * w43;
        const double w47 = 2.0 * Y1_1;
        const double w48 = w46 * w47 + w31 * w40;
        const double w49 = 2.0 * Y1_2;
        const double w50 = -2.0 * Y1_3;
        const double w51 = w36 * w49 + w46 * w50;
        const double w52 = 0.5 * Y1_0;
        const double w53 = -0.5 * Y1_0;
        const double w54 = 0.5 + w26 * w53 + w51 * w52 + w32 * w42 + w42 * w48 + w25 * w29;
        const double w55 = w25 * w41 + w54;
        const double w56 = Y1_3 * w26;
        const double w57 = 2.5 - w29 * Y1_0 - Y1_1 * w32 + w56;
        const double w58 = 0.5 * w57;
        const double w59 = 0.5 * w46;
        const double w60 = 0.5 * w36;
        const double w61 = Y1_2 * w26;
        const double w62 = -60.0 - w32 * Y1_0 + Y1_1 * w29 - w61;
        const double w63 = 0.5 * w62;
        const double w64 = w39 - w38;
        const double w65 = Y1_3 * w64;
        const double w66 = w45 * w58 - Y1_0 * w59 + Y1_1 * w60 + w30 * w63 + w65;
        const double w67 = -0.2 * (w32 * w58) - w32 * w59 + w29 * w60
            + 0.016666666666666666 * (w29 * w63) + 120.0 * w66;
        const double w68 = w44 * w58 - Y1_1 * w59 - Y1_0 * w60 + w35 * w63 + Y1_2 * w40;
        const double w69 = w67 + 5.0 * w68;
        const double w70 = -0.2 * (w29 * w58) - w29 * w59 - w32 * w60
            - 0.016666666666666666 * (w32 * w63) + w26 * w64;
        const double w71 = Y1_3 * w59 + w43 * w58 - Y1_2 * w60 + w27 * w63 + Y1_0 * w64;
        const double w72 = -0.016666666666666666 * (w26 * w63) - w26 * w60 - 120.0 * w71 + w32 * w40
            - 2.0 * w68;
        const double w73 = w26 * w59 + 0.2 * (w26 * w58) + w29 * w64 + 2.0 * w66 - 5.0 * w71;
        const double d1_0 = Y1_0 * w69 - Y1_1 * w70 - Y1_3 * w72 + Y1_2 * w73;
        const double x_0 = h * xi_0;
        const double x_2 = h * xi_2;
        const double x_1 = h * xi_1;
        const double w74 = x_0 * x_0 + x_1 * x_1 + x_2 * x_2;
        double c0_2, c1_2;
        stumpff_01(w74, &c0_2, &c1_2);
        const double w76 = x_2 * c1_2;
        const double w77 = x_0 * c1_2;
        const double w79 = x_1 * c1_2;
        const double Y_2 = q1 * w76 - q3 * w77 + (q0 * w79 + q2 * c0_2);
        const double Y_1 = q3 * w79 - q2 * w76 + (q0 * w77 + q1 * c0_2);
        const double w80 = 5.0 * Y_1 - 2.0 * Y_2;
        const double Y_0 = q0 * c0_2 - (q1 * w77 + q2 * w79 + q3 * w76);
        const double Y_3 = q2 * w77 - q1 * w79 + (q0 * w76 + q3 * c0_2);
        const double w81 = -120.0 * Y_2 - 5.0 * Y_3;
        const double w82 = 120.0 * Y_1 + 2.0 * Y_3;
        const double w83 = 1.0 - Y_0 * w81 + Y_2 * w80 - Y_3 * w82;
        const double w84 = -0.016666666666666666 * Y_2;
        const double w85 = 0.016666666666666666 * Y_1;
        const double w86 = -0.016666666666666666 * Y_0;
        const double w87 = w80 * w86 - 1.0 + w82 * w85 + w81 * w84;
        const double w88 = 0.5 * (-60.0 - w80 * Y_0 + Y_1 * w82 - Y_2 * w81);
        const double w89 = 0.2 * Y_3;
        const double w90 = -0.2 * Y_1;
        const double w91 = -0.2 * Y_0;
        const double w92 = 0.5 + w82 * w91 + w80 * w90 + w81 * w89;
        const double w93 = 0.5 * (2.5 - Y_0 * w82 - Y_1 * w80 + Y_3 * w81);
        const double w113 = Y1_3 * w69 - Y1_2 * w70 + Y1_0 * w72;
        const double w114 = Y1_1 * w73;
        const double d1_1 = w113 - w114;
        const double d1_2 = Y1_1 * w72 - (Y1_3 * w70 + Y1_2 * w69) + Y1_0 * w73;
        const double w115 = w87 * w88 + w92 * w93 + 0.5 * (w83 * w83) - H0
            - (d1_0 * x_0 + x_1 * d1_1 + x_2 * d1_2);
        const double w116 = quotient(w115, w74);
        const double D_0 = d1_0 + x_0 * w116;
        const double D_1 = d1_1 + x_1 * w116;
        const double D_2 = d1_2 + x_2 * w116;
        const double w117 = d1_0 * d1_0 + d1_1 * d1_1 + d1_2 * d1_2;
        const double w118 = quotient(d1_0 * D_0 + d1_1 * D_1 + d1_2 * D_2, w117);
        const double w119 = 0.5 * Y1_3;
        const double w120 = 0.1 * Y1_3;
        const double w121 = -0.5 * Y1_1;
        const double w122 = -0.1 * Y1_1;
        const double w123 = -0.1 * Y1_0;
        const double w124 = 0.25 + w29 * w123 + w41 * w52 + w32 * w122 + w48 * w121 + w26 * w120;
        const double w125 = w51 * w119 + w124;
        const double w126 = -0.5 * Y1_2;
        const double w127 = -0.008333333333333333 * Y1_2;
        const double w128 = 0.5 * Y1_1;
        const double w129 = 0.008333333333333333 * Y1_1;
        const double w130 = -0.008333333333333333 * Y1_0;
        const double w131 = w32 * w130 - 0.5 + w48 * w52 + w29 * w129 + w41 * w128 + w26 * w127;
        const double w132 = w51 * w126 + w131;
        const double w133 = quotient(D_1 * w125 + w55 * D_0 + D_2 * w132, w117);
        const double next_xi_0 = w55 * w118 - d1_0 * w133;
        const double next_xi_1 = w118 * w125 - d1_1 * w133;
        const double next_xi_2 = w118 * w132 - d1_2 * w133;
        const double residual_xi_0 = next_xi_0 - xi_0;
        const double residual_xi_1 = next_xi_1 - xi_1;
        const double residual_xi_2 = next_xi_2 - xi_2;
        if (!isfinite(residual_xi_0 + residual_xi_1 + residual_xi_2)) {
            count_sweeps(statistics, 0, sweep, 1);
            return FREE_RIGID_BODY_S3_DISCRETE_GRADIENT_MIDPOINT_NOT_FINITE;
        }
        if (make_1) {
            const double w134 = quotient(1.0, w117);
            const double w135 = d1_0 * w134;
            const double w136 = h * w116;
            const double w137 = quotient(1.0, w74);
            const double w138 = w93 * w137;
            const double w139 = 0.5 * w92 * w137;
            const double w140 = 0.5 * w87 * w137;
            const double w141 = w88 * w137;
            const double w142 = w83 * w137;
            const double w143 = w91 * w138 - Y_0 * w139 + Y_1 * w140 + w85 * w141 - Y_3 * w142;
            const double w144 = -0.2 * w80 * w138 - w80 * w139 + w82 * w140
                + 0.016666666666666666 * w82 * w141 + 120.0 * w143;
            const double w145 = w90 * w138 - Y_1 * w139 - Y_0 * w140 + w86 * w141 + Y_2 * w142;
            const double w146 = w144 + 5.0 * w145;
            const double w147 = w81 * w142;
            const double w148 = -0.2 * w82 * w138 - w82 * w139 - w80 * w140
                - 0.016666666666666666 * w80 * w141;
            const double w149 = w147 - w148;
            const double w150 = Y_3 * w139 + w89 * w138 - Y_2 * w140 + w84 * w141 - Y_0 * w142;
            const double w151 = w81 * w139 + 0.2 * w81 * w138 - w82 * w142 + 2.0 * w143 - 5.0 * w150;
            const double w152 = -0.016666666666666666 * w81 * w141 - w81 * w140 - 120.0 * w150
                + w80 * w142 - 2.0 * w145;
            const double w153 = q0 * w146 + q1 * w149 + q2 * w151 - q3 * w152;
            const double w154 = q0 * w151 + q3 * w149 + q1 * w152 - q2 * w146;
            const double w155 = q0 * w152 + q2 * w149 - q1 * w151 + q3 * w146;
            double c2_1, c3_1;
            stumpff_23(w74, &c2_1, &c3_1);
            const double w156 = (x_2 * w154 + x_1 * w155 + x_0 * w153) * (0.5 * (c3_1 - c2_1));
            const double w157 = (q3 * w151 + q2 * w152 + q1 * w146 + q0 * (w148 - w147)) * (0.5 * c1_2);
            const double w158 = w156 - (w116 * w137 + w157);
            const double w159 = h * (w153 * c1_2 - d1_0 * w137 + 2.0 * x_0 * w158);
            const double w160 = d1_2 * w134;
            const double w161 = d1_1 * w134;
            const double w162 = x_2 * w160 + x_1 * w161 + x_0 * w135;
            const double w163 = w135 * w136 + w159 * w162;
            const double w164 = w18 * c1_1;
            const double w165 = q2 * w164;
            const double w166 = 2.0 * x1_0 * w18;
            double c2_2, c3_2;
            stumpff_23(w19, &c2_2, &c3_2);
            const double w167 = 0.5 * (c3_2 - c2_2);
            const double w168 = x1_2 * w167;
            const double w169 = 0.5 * c1_1;
            const double w170 = x1_1 * w167;
            const double w171 = x1_0 * w167;
            const double w172 = q0 * w168 - q3 * w169 - q1 * w170 + q2 * w171;
            const double w173 = w165 + w166 * w172;
            const double w174 = -2.0 * w46;
            const double w175 = 2.0 * w40;
            const double w176 = w52 * w174 - 0.5 * (w29 + w41) + w25 * w175;
            const double w177 = w53 * w118;
            const double w178 = w25 * w118;
            const double w179 = D_2 * w134;
            const double w180 = 2.0 * d1_2;
            const double w181 = w118 * w134;
            const double w182 = x_2 * w137;
            const double w183 = w179 - w180 * w181 + w160 - w162 * w182;
            const double w184 = w55 * w183;
            const double w185 = w59 + 0.1 * w57;
            const double w186 = 2.0 * w64 - 5.0 * w185;
            const double w187 = 0.08333333333333333 * Y1_2 + 0.03333333333333333 * Y1_1;
            const double w188 = w185 + w126 * w187;
            const double w189 = -0.016666666666666666 * w32;
            const double w190 = Y1_3 * w189;
            const double w191 = Y1_0 * w188 - (w65 + w126 * w190);
            const double w192 = w29 - 5.0 * Y1_0;
            const double w193 = w28 + w192;
            const double w194 = Y1_0 * w193 - w56;
            const double w195 = 0.5 * w26 - 2.5 * Y1_3;
            const double w196 = 0.2 * w26 - Y1_3 - 0.4 * Y1_0;
            const double w197 = -0.2 * w29;
            const double w198 = Y1_0 * w196 - Y1_3 * w197;
            const double w199 = -0.008333333333333333 * w62 - w60;
            const double w200 = -0.016666666666666666 * w26;
            const double w201 = 0.03333333333333333 * Y1_0;
            const double w202 = w49 + w200 + w201;
            const double w203 = w199 + w126 * w202;
            const double w204 = -120.0 * Y1_0;
            const double w205 = 0.4 * Y1_1 - 24.0 * Y1_3;
            const double w206 = -120.0 * w185 - 5.0 * w203 + w192 * w204 + w195 * w205;
            const double w207 = Y1_0 * w186 - w70 - 5.0 * w191 + w192 * w194 + w195 * w198
                + Y1_1 * w206;
            const double w208 = w64 + w128 * w187;
            const double w209 = -0.1 * w57 - w59;
            const double w210 = w128 * w202 + Y1_3 * w204 + w53 * w205;
            const double w211 = Y1_0 * w208 - (Y1_3 * w209 + w128 * w190) + Y1_3 * w194 + w53 * w198
                + Y1_1 * w210;
            const double w212 = 0.016666666666666666 * w29 - 0.08333333333333333 * Y1_0 + w47;
            const double w213 = w126 * w212;
            const double w214 = 120.0 * Y1_3;
            const double w215 = -0.2 * w32 - Y1_1 - 24.0 * Y1_0;
            const double w216 = w60 + 0.008333333333333333 * w62;
            const double w217 = w216 + w128 * w212 + Y1_3 * w214 + w53 * w215;
            const double w218 = 120.0 * w64 - 5.0 * w213 + w192 * w214 + w195 * w215 + 2.0 * w217;
            const double w219 = w207 + 2.0 * w211 - Y1_2 * w218;
            const double w220 = w34 - w33;
            const double w221 = -5.0 * w220 - w29 + w50;
            const double w222 = w31 * w42 + w25 * w28;
            const double w223 = w31 + w32;
            const double w224 = 5.0 * Y1_2;
            const double w225 = Y1_1 * w223 - Y1_2 * w224;
            const double w226 = w118 * w222 + w184 * w225;
            const double w227 = D_1 * w134;
            const double w228 = 2.0 * d1_1;
            const double w229 = x_1 * w137;
            const double w230 = w227 - w181 * w228 + w161 - w162 * w229;
            const double w231 = w55 * w230;
            const double w232 = Y1_2 * w189;
            const double w233 = Y1_2 * w64 + w126 * w232 + Y1_1 * w188;
            const double w234 = w61 + Y1_1 * w193;
            const double w235 = Y1_2 * w197 + Y1_1 * w196;
            const double w236 = w69 - Y1_1 * w186 + 5.0 * w233 - w192 * w234 - w195 * w235
                + Y1_0 * w206;
            const double w237 = Y1_0 * w210
                - (Y1_2 * w209 + w128 * w232 + Y1_1 * w208 + Y1_3 * w234 + w53 * w235);
            const double w238 = Y1_0 * w223 + Y1_3 * w224;
            const double w239 = w236 + 2.0 * w237 + Y1_3 * w218 + w221 * w238;
            const double w240 = w118 * w176 - 5.0 * w177 + 2.0 * w178 + w184 * w219 + w221 * w226
                + w231 * w239;
            const double w241 = w49 * w52 + w25 * w37;
            const double w242 = Y1_1 + 2.5 * Y1_2;
            const double w243 = -0.5 * w32;
            const double w244 = -0.5 * w26;
            const double w245 = w244 + 60.0 * Y1_2 + Y1_0;
            const double w246 = 0.5 * w29;
            const double w247 = w246 + 2.5 * w220 + 60.0 * Y1_1;
            const double w248 = Y1_0 * w242 - Y1_3 * w243 + Y1_1 * w245 - Y1_2 * w247;
            const double w249 = Y1_0 * w245 - (Y1_2 * w243 + Y1_1 * w242) + Y1_3 * w247;
            const double w250 = w118 * w241 + w184 * w248 + w231 * w249;
            const double w251 = w240 + w187 * w250;
            const double w252 = q1 * w168 - q2 * w169 + q0 * w170 - q3 * w171;
            const double w253 = q3 * w164;
            const double w254 = w166 * w252 - w253;
            const double w255 = 2.0 * w36;
            const double w256 = -2.0 * w40;
            const double w257 = 0.5 * (w32 + w48) + w52 * w255 + w42 * w256;
            const double w258 = w42 * w118;
            const double w259 = Y1_3 * w199;
            const double w260 = Y1_0 + w244;
            const double w261 = w187 * w260 - 5.0 * w199;
            const double w262 = w49 - w32 + w204;
            const double w263 = 2.0 * w259 - w69 - w190 * w260 + Y1_0 * w261 - 120.0 * w191
                + w194 * w262;
            const double w264 = Y1_1 - 60.0 * Y1_3;
            const double w265 = w256 - 120.0 * w199 + w256 + w202 * w260 - 120.0 * w203 + w204 * w262
                + w205 * w264;
            const double w266 = 5.0 * w40 - 2.0 * w209;
            const double w267 = w266 + w212 * w260 - 120.0 * w213 + w214 * w262 + w215 * w264;
            const double w268 = w263 + w198 * w264 + Y1_1 * w265 - Y1_2 * w267;
            const double w269 = w223 - 120.0 * w220;
            const double w270 = Y1_2 * w199;
            const double w271 = 2.0 * w270 - w70 - w232 * w260 - Y1_1 * w261 + 120.0 * w233
                - w234 * w262;
            const double w272 = w271 - w235 * w264 + Y1_0 * w265 + Y1_3 * w267 + w238 * w269;
            const double w273 = w118 * w257 - 2.0 * w258 - 120.0 * w177 + w184 * w268 + w226 * w269
                + w231 * w272;
            const double w274 = w200 + w201 + w49;
            const double w275 = w273 + w250 * w274;
            const double w276 = q0 * w164;
            const double w277 = q3 * w170 - (q1 * w169 + q2 * w168) + q0 * w171;
            const double w278 = w276 + w166 * w277;
            const double w279 = 2.0 * w46;
            const double w280 = -2.0 * w36;
            const double w281 = w42 * w279 + w25 * w280;
            const double w282 = w246 - 2.5 * Y1_0;
            const double w283 = 2.0 * w216 + w187 * w282;
            const double w284 = -5.0 * Y1_2;
            const double w285 = w243 - 2.5 * Y1_1;
            const double w286 = w72 - 5.0 * w259 - w190 * w282 + Y1_0 * w283 + w194 * w284
                + w198 * w285;
            const double w287 = w266 + w202 * w282 + w204 * w284 + w205 * w285;
            const double w288 = 5.0 * w209;
            const double w289 = w288 + 120.0 * w216 + w288 + w212 * w282 + w214 * w284 + w215 * w285
                + 120.0 * w217;
            const double w290 = w286 + Y1_1 * w287 + 120.0 * w211 - Y1_2 * w289;
            const double w291 = w224 - 120.0 * Y1_3;
            const double w292 = -5.0 * w270 - w73 - w232 * w282 - Y1_1 * w283 - w234 * w284
                - w235 * w285;
            const double w293 = w292 + Y1_0 * w287 + 120.0 * w237 + Y1_3 * w289 + w238 * w291;
            const double w294 = w118 * w281 + 5.0 * w258 + 120.0 * w178 + w184 * w290 + w226 * w291
                + w231 * w293;
            const double w295 = w294 + w212 * w250;
            const double w296 = w55 * w134;
            const double w297 = w132 * w134;
            const double w298 = w125 * w134;
            const double w299 = x_2 * w297 + x_1 * w298 + x_0 * w296;
            const double w300 = w126 * w174 + w128 * w175;
            const double w301 = 0.5 * w51;
            const double w302 = 0.1 * w26 + w301 + w119 * w174 + w52 * w175;
            const double w303 = D_0 * w134;
            const double w304 = w127 * w179 + w120 * w227 + w53 * w303;
            const double w305 = w129 * w179 + w123 * w227 + w25 * w303;
            const double w306 = w133 * w134;
            const double w307 = w297 - w180 * w306 - w182 * w299;
            const double w308 = w179 * w300 + w227 * w302 + w176 * w303 - 5.0 * w304 + 2.0 * w305
                + w219 * w307;
            const double w309 = w31 * w52 + w28 * w128;
            const double w310 = w31 * w121 + w28 * w52;
            const double w311 = w179 * w309 + w227 * w310 + w222 * w303 + w225 * w307;
            const double w312 = w298 - w228 * w306 - w229 * w299;
            const double w313 = w49 * w126 + w37 * w128;
            const double w314 = w49 * w119 + w37 * w52;
            const double w315 = w179 * w313 + w227 * w314 + w241 * w303 + w248 * w307 + w249 * w312;
            const double w316 = w308 + w221 * w311 + w239 * w312 + w187 * w315;
            const double w317 = -0.008333333333333333 * w26 - 0.5 * w51 + w126 * w255 + w52 * w256;
            const double w318 = w119 * w255 + w121 * w256;
            const double w319 = w130 * w179 + w122 * w227 + w42 * w303;
            const double w320 = w179 * w317 + w227 * w318 + w257 * w303 - 2.0 * w319 - 120.0 * w304
                + w268 * w307;
            const double w321 = w320 + w269 * w311 + w272 * w312 + w274 * w315;
            const double w322 = 0.5 * w41;
            const double w323 = 0.008333333333333333 * w29 + w322 + w52 * w279 + w128 * w280;
            const double w324 = -0.1 * w32 - 0.5 * w48 + w121 * w279 + w52 * w280;
            const double w325 = w179 * w323 + w227 * w324 + w281 * w303 + 5.0 * w319 + 120.0 * w305
                + w290 * w307;
            const double w326 = w325 + w291 * w311 + w293 * w312 + w212 * w315;
            const double w327 = w159 * w299 + w136 * w296 + w173 * w316 + w254 * w321 + w278 * w326;
            const double w328 = Y1_1 * w189;
            const double w329 = Y1_2 * w188 - (Y1_1 * w64 + w126 * w328);
            const double w330 = Y1_2 * w193 - w26 * Y1_1;
            const double w331 = Y1_2 * w196 - Y1_1 * w197;
            const double w332 = Y1_2 * w186 - w72 - 5.0 * w329 + w192 * w330 + w195 * w331
                - Y1_3 * w206;
            const double w333 = Y1_2 * w208 - (Y1_1 * w209 + w128 * w328) + Y1_3 * w330 + w53 * w331
                - Y1_3 * w210;
            const double w334 = Y1_0 * w224 - Y1_3 * w223;
            const double w335 = Y1_2 * w242 - Y1_1 * w243 - Y1_3 * w245 + Y1_0 * w247;
            const double w336 = w332 + 2.0 * w333 + Y1_0 * w218 + w221 * w334 + w187 * w335;
            const double w337 = Y1_1 * w199;
            const double w338 = w73 + 2.0 * w337 - w260 * w328 + Y1_2 * w261 - 120.0 * w329
                + w262 * w330;
            const double w339 = w338 + w264 * w331 - Y1_3 * w265 + Y1_0 * w267 + w269 * w334
                + w274 * w335;
            const double w340 = -5.0 * w337 - w70 - w282 * w328 + Y1_2 * w283 + w284 * w330
                + w285 * w331;
            const double w341 = w340 - Y1_3 * w287 + 120.0 * w333 + Y1_0 * w289 + w291 * w334
                + w212 * w335;
            const double w342 = w173 * w336 + w254 * w339 + w278 * w341;
            const double w343 = 2.0 * d1_0;
            const double w344 = x_0 * w137;
            const double w345 = w303 - w181 * w343 + w135 - w162 * w344;
            const double w346 = w296 - w306 * w343 - w299 * w344;
            const double w347 = w55 * w345 - w133 - d1_0 * w346;
            const double w348 = w55 * w163 + w173 * w251 + w254 * w275 + w278 * w295 - d1_0 * w327
                + w342 * w347;
            const double w349 = w173 * w196 + w205 * w254 + w215 * w278;
            const double w350 = w50 * w52 + w42 * w47;
            const double w351 = w195 + w220;
            const double w352 = -0.5 * w29;
            const double w353 = w285 + 60.0 * w220;
            const double w354 = Y1_0 * w351 - Y1_3 * w352 + Y1_1 * w264 - Y1_2 * w353;
            const double w355 = Y1_0 * w264 - (Y1_2 * w352 + Y1_1 * w351) + Y1_3 * w353;
            const double w356 = w50 * w126 + w47 * w52;
            const double w357 = w50 * w119 + w47 * w121;
            const double w358 = w179 * w356 + w227 * w357 + w303 * w350 + w307 * w354 + w312 * w355;
            const double w359 = Y1_2 * w351 - Y1_1 * w352 - Y1_3 * w264 + Y1_0 * w353;
            const double w360 = w118 * w350 + w184 * w354 + w231 * w355 - d1_0 * w358 + w347 * w359;
            const double w361 = q1 * w164;
            const double w362 = q0 * w169 + q3 * w168 + q2 * w170 + q1 * w171;
            const double w363 = w361 + w166 * w362;
            const double w364 = w244 + w301;
            const double w365 = 2.0 * w209 - 5.0 * w64 + w187 * w243;
            const double w366 = -120.0 * w64 - 2.0 * w199 + w202 * w243 + w26 * w204 + w205 * w352;
            const double w367 = w73 - w190 * w243 + Y1_0 * w365 + w26 * w194 + w198 * w352
                + Y1_1 * w366;
            const double w368 = 5.0 * w199 + 120.0 * w209 + w212 * w243 + w26 * w214 + w215 * w352;
            const double w369 = w367 - Y1_2 * w368;
            const double w370 = w72 - w232 * w243 - Y1_1 * w365 - w26 * w234 - w235 * w352
                + Y1_0 * w366;
            const double w371 = w370 + Y1_3 * w368 - w26 * w238;
            const double w372 = 0.5 * w48 - 0.008333333333333333 * w32;
            const double w373 = w322 - 0.1 * w29;
            const double w374 = w179 * w372 + w227 * w373 + w303 * w364 + w307 * w369 - w26 * w311
                + w312 * w371;
            const double w375 = w374 + w189 * w315;
            const double w376 = w118 * w364 + w184 * w369 - w26 * w226 + w231 * w371 + w189 * w250
                - d1_0 * w375;
            const double w377 = w69 - w243 * w328 + Y1_2 * w365 + w26 * w330 + w331 * w352
                - Y1_3 * w366;
            const double w378 = w377 + Y1_0 * w368 - w26 * w334 + w189 * w335;
            const double w379 = w376 + w347 * w378 + w197 * w360;
            const double w380 = 2.0 * x1_1 * w18;
            const double w381 = w165 + w362 * w380;
            const double w382 = h * (w155 * c1_2 - d1_1 * w137 + 2.0 * x_1 * w158);
            const double w383 = w136 * w161 + w162 * w382;
            const double w384 = w172 * w380 - w361;
            const double w385 = w276 + w252 * w380;
            const double w386 = w253 + w277 * w380;
            const double w387 = w136 * w298 + w299 * w382 + w316 * w384 + w321 * w385 + w326 * w386;
            const double w388 = w336 * w384 + w339 * w385 + w341 * w386;
            const double w389 = w55 * w383 + w251 * w384 + w275 * w385 + w295 * w386 - d1_0 * w387
                + w347 * w388;
            const double w390 = w196 * w384 + w205 * w385 + w215 * w386;
            const double w391 = 2.0 * x1_2 * w18;
            const double w392 = w253 + w362 * w391;
            const double w393 = h * (w154 * c1_2 - d1_2 * w137 + 2.0 * x_2 * w158);
            const double w394 = w136 * w160 + w162 * w393;
            const double w395 = w276 + w172 * w391;
            const double w396 = w361 + w252 * w391;
            const double w397 = w277 * w391 - w165;
            const double w398 = w136 * w297 + w299 * w393 + w316 * w395 + w321 * w396 + w326 * w397;
            const double w399 = w336 * w395 + w339 * w396 + w341 * w397;
            const double w400 = w55 * w394 + w251 * w395 + w275 * w396 + w295 * w397 - d1_0 * w398
                + w347 * w399;
            const double w401 = w196 * w395 + w205 * w396 + w215 * w397;
            const double w402 = w125 * w183;
            const double w403 = w118 * w310 + w225 * w402;
            const double w404 = w125 * w230 - w133;
            const double w405 = w118 * w314 + w248 * w402 + w249 * w404;
            const double w406 = w114 - w113;
            const double w407 = w118 * w373 + w369 * w402 - w26 * w403 + w371 * w404 + w189 * w405
                + w375 * w406;
            const double w408 = w125 * w345 + w346 * w406;
            const double w409 = w118 * w357 + w354 * w402 + w355 * w404 + w358 * w406 + w359 * w408;
            const double w410 = w407 + w378 * w408 + w197 * w409;
            const double w411 = w118 * w120;
            const double w412 = w118 * w123;
            const double w413 = w118 * w302 - 5.0 * w411 + 2.0 * w412 + w219 * w402 + w221 * w403
                + w239 * w404;
            const double w414 = w413 + w187 * w405;
            const double w415 = w118 * w122;
            const double w416 = w118 * w318 - 2.0 * w415 - 120.0 * w411 + w268 * w402 + w269 * w403
                + w272 * w404;
            const double w417 = w416 + w274 * w405;
            const double w418 = w118 * w324 + 5.0 * w415 + 120.0 * w412 + w290 * w402 + w291 * w403
                + w293 * w404;
            const double w419 = w418 + w212 * w405;
            const double w420 = w125 * w163 + w173 * w414 + w254 * w417 + w278 * w419 + w327 * w406
                + w342 * w408;
            const double w421 = w125 * w383 + w384 * w414 + w385 * w417 + w386 * w419 + w387 * w406
                + w388 * w408;
            const double w422 = w125 * w394 + w395 * w414 + w396 * w417 + w397 * w419 + w398 * w406
                + w399 * w408;
            const double w423 = w132 * w183 - w133;
            const double w424 = w118 * w309 + w225 * w423;
            const double w425 = w132 * w230;
            const double w426 = w118 * w313 + w248 * w423 + w249 * w425;
            const double w427 = w118 * w372 + w369 * w423 - w26 * w424 + w371 * w425 + w189 * w426
                - d1_2 * w375;
            const double w428 = w132 * w345 - d1_2 * w346;
            const double w429 = w118 * w356 + w354 * w423 + w355 * w425 - d1_2 * w358 + w359 * w428;
            const double w430 = w427 + w378 * w428 + w197 * w429;
            const double w431 = w118 * w127;
            const double w432 = w118 * w129;
            const double w433 = w118 * w300 - 5.0 * w431 + 2.0 * w432 + w219 * w423 + w221 * w424
                + w239 * w425;
            const double w434 = w433 + w187 * w426;
            const double w435 = w118 * w130;
            const double w436 = w118 * w317 - 2.0 * w435 - 120.0 * w431 + w268 * w423 + w269 * w424
                + w272 * w425;
            const double w437 = w436 + w274 * w426;
            const double w438 = w118 * w323 + 5.0 * w435 + 120.0 * w432 + w290 * w423 + w291 * w424
                + w293 * w425;
            const double w439 = w438 + w212 * w426;
            const double w440 = w132 * w163 + w173 * w434 + w254 * w437 + w278 * w439 - d1_2 * w327
                + w342 * w428;
            const double w441 = w132 * w383 + w384 * w434 + w385 * w437 + w386 * w439 - d1_2 * w387
                + w388 * w428;
            const double w442 = w132 * w394 + w395 * w434 + w396 * w437 + w397 * w439 - d1_2 * w398
                + w399 * w428;
            memory->inverse_1[0] = 1.0 - (w348 + w349 * w360 - w363 * w379);
            memory->inverse_1[1] = w379 * w381 - (w389 + w360 * w390);
            memory->inverse_1[2] = w379 * w392 - (w400 + w360 * w401);
            memory->inverse_1[3] = w363 * w410 - (w420 + w349 * w409);
            memory->inverse_1[4] = 1.0 - (w421 + w390 * w409 - w381 * w410);
            memory->inverse_1[5] = w392 * w410 - (w422 + w401 * w409);
            memory->inverse_1[6] = w363 * w430 - (w440 + w349 * w429);
            memory->inverse_1[7] = w381 * w430 - (w441 + w390 * w429);
            memory->inverse_1[8] = 1.0 - (w442 + w401 * w429 - w392 * w430);
            size_t order_1[3];
            memory->made_1 = invert(3, memory->inverse_1, order_1);
            count_matrix(statistics);
            if (!memory->made_1) {
                count_sweeps(statistics, 0, sweep, 1);
                return FREE_RIGID_BODY_S3_DISCRETE_GRADIENT_MIDPOINT_NOT_CONVERGED;
            }
        }
        const double change_xi_0 = memory->inverse_1[0] * residual_xi_0
            + memory->inverse_1[1] * residual_xi_1 + memory->inverse_1[2] * residual_xi_2;
        const double change_xi_1 = memory->inverse_1[3] * residual_xi_0
            + memory->inverse_1[4] * residual_xi_1 + memory->inverse_1[5] * residual_xi_2;
        const double change_xi_2 = memory->inverse_1[6] * residual_xi_0
            + memory->inverse_1[7] * residual_xi_1 + memory->inverse_1[8] * residual_xi_2;
        const double change = greater(fabs(change_xi_0), greater(fabs(change_xi_1),
            fabs(change_xi_2)));
        const double scale = greater(greater(1.0, fabs(xi_0)), greater(fabs(xi_1), fabs(xi_2)));
        const int still = previous_1 > 0.0 && change >= previous_1;
        const int close = change <= 9.094947017729282e-13 * scale
            && change * change <= 1.1102230246251565e-16 * scale * previous_1;
        xi_0 += change_xi_0;
        xi_1 += change_xi_1;
        xi_2 += change_xi_2;
        if (close || (still && change <= 5.684341886080802e-14 * scale)) {
            count_sweeps(statistics, 0, sweep, 0);
            break;
        }
        if (sweep == 100) {
            count_sweeps(statistics, 0, sweep, 1);
            return FREE_RIGID_BODY_S3_DISCRETE_GRADIENT_MIDPOINT_NOT_CONVERGED;
        }
        make_1 = 0.0625 * previous_1 > 0.0 && change > 0.0625 * previous_1;
        previous_1 = change;
    }
    const double x_0_ = h * xi_0;
    const double x_1_ = h * xi_1;
    const double x_2_ = h * xi_2;
    const double w443 = x_0_ * x_0_ + x_1_ * x_1_ + x_2_ * x_2_;
    double c0_3, c1_3;
    stumpff_01(w443, &c0_3, &c1_3);
    const double w446 = x_0_ * c1_3;
    const double w447 = x_1_ * c1_3;
    const double w448 = x_2_ * c1_3;
    const double Y_0_ = q0 * c0_3 - (q1 * w446 + q2 * w447 + q3 * w448);
    const double Y_1_ = q3 * w447 - q2 * w448 + (q0 * w446 + q1 * c0_3);
    const double Y_2_ = q1 * w448 - q3 * w446 + (q0 * w447 + q2 * c0_3);
    const double Y_3_ = q2 * w446 - q1 * w447 + (q0 * w448 + q3 * c0_3);
    if (!(isfinite(Y_0_) && isfinite(Y_1_) && isfinite(Y_2_) && isfinite(Y_3_))) {
        return FREE_RIGID_BODY_S3_DISCRETE_GRADIENT_MIDPOINT_NOT_FINITE;
    }
    memmove(memory->past[1], memory->past[0], 2 * sizeof memory->past[0]);
    memory->past[0][0] = xi_0;
    memory->past[0][1] = xi_1;
    memory->past[0][2] = xi_2;
    if (memory->known < 3) {
        memory->known++;
    }
    state[0] = Y_0_;
    state[1] = Y_1_;
    state[2] = Y_2_;
    state[3] = Y_3_;
    return FREE_RIGID_BODY_S3_DISCRETE_GRADIENT_MIDPOINT_OK;
}

int free_rigid_body_s3_discrete_gradient_midpoint_step(double state[static 4], double h,
    free_rigid_body_s3_discrete_gradient_midpoint_statistics *statistics)
{
    struct memory memory = {0};
    return advance(state, h, &memory, statistics);
}

int free_rigid_body_s3_discrete_gradient_midpoint_run(double state[static 4], double h,
    size_t steps, double *trajectory, size_t stride,
    free_rigid_body_s3_discrete_gradient_midpoint_statistics *statistics, size_t *completed)
{
    int status = FREE_RIGID_BODY_S3_DISCRETE_GRADIENT_MIDPOINT_OK;
    size_t step = 0;
    struct memory memory = {0};
    double *row = stride > 0 ? trajectory : NULL;
    if (row != NULL) {
        memcpy(row, state, 4 * sizeof *state);
    }
    while (step < steps) {
        status = advance(state, h, &memory, statistics);
        if (status != FREE_RIGID_BODY_S3_DISCRETE_GRADIENT_MIDPOINT_OK && memory.known > 0) {
            /* the solutions before may mislead where the motion changes: begin as the first step does */
            memset(&memory, 0, sizeof memory);
            if (statistics != NULL) {
                statistics->failed = 0;
            }
            status = advance(state, h, &memory, statistics);
        }
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
