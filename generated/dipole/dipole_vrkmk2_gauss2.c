/*
 * Dipole on a stick, T*SO(3) (thesis section 3.6): one step by vrkmk(2):gauss2
 *
 * method:     family vrkmk(2), tableau gauss2
 * source:     Hammer and Hollingsworth 1955; Hairer, Lubich and Wanner, Table II.1.1; Table 3.1c
 *             of Bogfjellmo and Marthinsen
 * order:      4, certificate: exact (every order condition up to it is zero in exact arithmetic)
 * scene:      Dipole on a stick, T*SO(3) (thesis section 3.6), group SO(3)
 * state:      [0..8] q: element of SO(3), row by row
 *             [9..11] mu: right-trivialised momentum in the dual algebra of SO(3)
 * left out:   7 dexpt, 1 lin (sharing)
 *             1 dexpt, 2 lin (dead code)
 *             parameters, folded: beta = 1
 *             the time: the scene does not depend on it
 * operations: 54 add, 81 mul, 1 stumpff_1 a step
 *             365 add, 535 mul, 6 div, 4 sqrt, 2 stumpff_123, 1 stumpff_23 a sweep of the
 *             equations of v1, v2, m1, m2
 * stack:      at most 3200 bytes, without what the mathematical library takes
 * made by:    orderconds emit dipole --method 'vrkmk(2):gauss2' --target c -o .
 * version:    orderconds 0.1.0
 *
 * Build: cc -std=c11 -O2 -ffp-contract=off -c dipole_vrkmk2_gauss2.c
 * Use:
 *
 *     #include "dipole_vrkmk2_gauss2.h"
 *     #include <stdio.h>
 *
 *     int main(void)
 *     {
 *         double state[12] = {1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.01, 0.0};
 *         size_t completed;
 *         const int status = dipole_vrkmk2_gauss2_run(state, 0.005, 100, NULL, 0, NULL, &completed);
 *         printf("status %d after %zu steps\n", status, completed);
 *         for (int i = 0; i < 12; i++) {
 *             printf("%.17g\n", state[i]);
 *         }
 *         return status;
 *     }
 */
#include "dipole_vrkmk2_gauss2.h"

#include <math.h>
#include <string.h>

#if defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__
#error "compile without -ffast-math (-ffinite-math-only): it removes the checks for infinities and NaNs"
#endif

/* c_3(z) = sum (-z)^j/(2j+3)! for small z */
static inline double stumpff_series_3(double z)
{
    const double w = z * z;
    const double w2 = w * w;
    if (z <= 0.0625) {
        return (0.16666666666666666 + z * -0.008333333333333333)
            + w * (0.0001984126984126984 + z * -2.7557319223985893e-06)
            + w2 * (2.505210838544172e-08 + z * -1.6059043836821613e-10);
    }
    double even = -1.9572941063391263e-20;
    even = -1.6059043836821613e-10 + w * -2.8114572543455206e-15 + w2 * even;
    even = -0.008333333333333333 + w * -2.7557319223985893e-06 + w2 * even;
    double odd = 3.868170170630684e-23;
    odd = 7.647163731819816e-13 + w * 8.22063524662433e-18 + w2 * odd;
    odd = 0.0001984126984126984 + w * 2.505210838544172e-08 + w2 * odd;
    return 0.16666666666666666 + z * (even + z * odd);
}

/* c_2(z) = sum (-z)^j/(2j+2)! for small z */
static inline double stumpff_series_2(double z)
{
    const double w = z * z;
    const double w2 = w * w;
    if (z <= 0.0625) {
        return (0.5 + z * -0.041666666666666664)
            + w * (0.001388888888888889 + z * -2.48015873015873e-05)
            + w2 * (2.755731922398589e-07 + z * -2.08767569878681e-09);
    }
    double even = -2.08767569878681e-09 + w * -4.779477332387385e-14;
    even = -0.041666666666666664 + w * -2.48015873015873e-05 + w2 * even;
    double odd = 1.1470745597729725e-11 + w * 1.5619206968586225e-16;
    odd = 0.001388888888888889 + w * 2.755731922398589e-07 + w2 * odd;
    return 0.5 + z * (even + z * odd);
}

/* c_1(z) = sum (-z)^j/(2j+1)! for small z */
static inline double stumpff_series_1(double z)
{
    const double w = z * z;
    const double w2 = w * w;
    if (z <= 0.0625) {
        return (1.0 + z * -0.16666666666666666)
            + w * (0.008333333333333333 + z * -0.0001984126984126984)
            + w2 * (2.7557319223985893e-06 + z * -2.505210838544172e-08);
    }
    double even = -2.505210838544172e-08 + w * -7.647163731819816e-13;
    even = -0.16666666666666666 + w * -0.0001984126984126984 + w2 * even;
    double odd = 1.6059043836821613e-10 + w * 2.8114572543455206e-15;
    odd = 0.008333333333333333 + w * 2.7557319223985893e-06 + w2 * odd;
    return 1.0 + z * (even + z * odd);
}

/* For z >= 0 and s = sqrt(z): c_2 = (1 - cos(s))/s^2, c_3 = (s - sin(s))/s^3 */
static inline void stumpff_23(double z, double *c2, double *c3)
{
    if (z <= 1.0) {
        *c2 = stumpff_series_2(z);
        *c3 = stumpff_series_3(z);
        return;
    }
    const double half = 0.5 * sqrt(z);
    const double sine = sin(half);
    const double cosine = cos(half);
    const double ratio = sine / half;
    *c2 = 0.5 * (ratio * ratio);
    *c3 = z <= 4.0 ? stumpff_series_3(z) : (1.0 - ratio * cosine) / z;
}

/* For z >= 0 and s = sqrt(z): c_1 = sin(s)/s, c_2 = (1 - cos(s))/s^2, c_3 = (s - sin(s))/s^3 */
static inline void stumpff_123(double z, double *c1, double *c2, double *c3)
{
    if (z <= 1.0) {
        *c1 = stumpff_series_1(z);
        *c2 = stumpff_series_2(z);
        *c3 = stumpff_series_3(z);
        return;
    }
    const double half = 0.5 * sqrt(z);
    const double sine = sin(half);
    const double cosine = cos(half);
    const double ratio = sine / half;
    *c1 = ratio * cosine;
    *c2 = 0.5 * (ratio * ratio);
    *c3 = z <= 4.0 ? stumpff_series_3(z) : (1.0 - ratio * cosine) / z;
}

/* For z >= 0 and s = sqrt(z): c_1 = sin(s)/s */
static inline double stumpff_1(double z)
{
    if (z <= 1.0) {
        return stumpff_series_1(z);
    }
    const double s = sqrt(z);
    return sin(s) / s;
}

static inline double greater(double a, double b)
{
    return a > b ? a : b;
}

static void count_sweeps(dipole_vrkmk2_gauss2_statistics *statistics, size_t block, size_t sweeps, int failed)
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

static inline int advance(double state[static 12], double h,
    dipole_vrkmk2_gauss2_statistics *statistics)
{
    if (!isfinite(h)) {
        return DIPOLE_VRKMK2_GAUSS2_BAD_STEP;
    }
    const double g00 = state[0];
    const double g01 = state[1];
    const double g02 = state[2];
    const double g10 = state[3];
    const double g11 = state[4];
    const double g12 = state[5];
    const double g20 = state[6];
    const double g21 = state[7];
    const double g22 = state[8];
    const double mu0 = state[9];
    const double mu1 = state[10];
    const double mu2 = state[11];
    const double w1 = 0.9900990099009901 * (g00 * mu0 + g10 * mu1 + g20 * mu2);
    const double w2 = g01 * mu0 + g11 * mu1 + g21 * mu2;
    const double w3 = 100.0 * (g02 * mu0 + g12 * mu1 + g22 * mu2);
    const double xi0_0 = g00 * w1 + g01 * w2 + g02 * w3;
    const double xi0_1 = g10 * w1 + g11 * w2 + g12 * w3;
    const double xi0_2 = g20 * w1 + g21 * w2 + g22 * w3;
    const double m0_1_0 = 0.5 * mu0;
    const double m0_1_1 = 0.5 * mu1;
    const double m0_1_2 = 0.5 * mu2;
    const double w4 = 0.25 * h;
    const double w5 = -0.03867513459481288 * h;
    const double w29 = 0.5386751345948129 * h;
    const double w83 = -0.26933756729740643 * h;
    const double w120 = -0.125 * h;
    const double w121 = 0.5 * h;
    const double w149 = 0.01933756729740644 * h;
    /* the equations of v1, v2, m1, m2: fixed point in v1_0, v1_1, v1_2, v2_0, v2_1, v2_2, m1_0, m1_1, m1_2, m2_0, m2_1, m2_2 */
    double v1_0 = xi0_0;
    double v1_1 = xi0_1;
    double v1_2 = xi0_2;
    double v2_0 = xi0_0;
    double v2_1 = xi0_1;
    double v2_2 = xi0_2;
    double m1_0 = m0_1_0;
    double m1_1 = m0_1_1;
    double m1_2 = m0_1_2;
    double m2_0 = m0_1_0;
    double m2_1 = m0_1_1;
    double m2_2 = m0_1_2;
    double nu2_0, Y_0, Y_1, Y_2, w122, w123, nu2_1, nu2_2, nu1_0, nu1_1, nu1_2;
    double previous_1 = 0.0;
    for (size_t sweep = 1;; sweep++) {
        const double X1_1 = v1_1 * w4 + v2_1 * w5;
        const double X1_0 = v1_0 * w4 + v2_0 * w5;
        const double X1_2 = v1_2 * w4 + v2_2 * w5;
        const double w6 = X1_0 * X1_0 + X1_1 * X1_1 + X1_2 * X1_2;
        double c1_1, c2_1, c3_1;
        stumpff_123(w6, &c1_1, &c2_1, &c3_1);
        const double w8 = X1_1 * c2_1;
        const double w9 = X1_1 * w8;
        const double w10 = X1_2 * c2_1 * X1_2;
        const double g1_0 = 1.0 - (w9 + w10);
        const double w11 = X1_0 * c2_1;
        const double w12 = X1_1 * w11;
        const double w14 = X1_2 * c1_1;
        const double g1_1 = w12 - w14;
        const double w15 = X1_1 * c1_1;
        const double w16 = X1_2 * w11;
        const double g1_2 = w15 + w16;
        const double Q1_0 = g00 * g1_0 + g10 * g1_1 + g20 * g1_2;
        const double w1_2 = 2.0 * m1_2;
        const double w1_0 = 2.0 * m1_0;
        const double w1_1 = 2.0 * m1_1;
        const double w17 = X1_1 * w1_0 - X1_0 * w1_1;
        const double w18 = X1_2 * w1_1 - X1_1 * w1_2;
        const double w19 = X1_0 * w1_2 - X1_2 * w1_0;
        const double M1_2 = w1_2 - 0.5 * w17 + 0.08333333333333333 * (X1_1 * w18 - X1_0 * w19);
        const double g1_6 = w16 - w15;
        const double w20 = X1_0 * c1_1;
        const double w21 = X1_2 * w8;
        const double g1_7 = w20 + w21;
        const double w22 = X1_0 * w11;
        const double g1_8 = 1.0 - (w9 + w22);
        const double Q1_6 = g00 * g1_6 + g10 * g1_7 + g20 * g1_8;
        const double M1_0 = w1_0 - 0.5 * w18 + 0.08333333333333333 * (X1_2 * w19 - X1_1 * w17);
        const double M1_1 = w1_1 - 0.5 * w19 + 0.08333333333333333 * (X1_0 * w17 - X1_2 * w18);
        const double g1_3 = w12 + w14;
        const double g1_4 = 1.0 - (w10 + w22);
        const double g1_5 = w21 - w20;
        const double Q1_3 = g00 * g1_3 + g10 * g1_4 + g20 * g1_5;
        const double w23 = 0.9900990099009901 * (M1_1 * Q1_3 + Q1_0 * M1_0 + M1_2 * Q1_6);
        const double Q1_1 = g01 * g1_0 + g11 * g1_1 + g21 * g1_2;
        const double Q1_7 = g01 * g1_6 + g11 * g1_7 + g21 * g1_8;
        const double Q1_4 = g01 * g1_3 + g11 * g1_4 + g21 * g1_5;
        const double w24 = M1_0 * Q1_1 + M1_1 * Q1_4 + M1_2 * Q1_7;
        const double Q1_2 = g02 * g1_0 + g12 * g1_1 + g22 * g1_2;
        const double Q1_8 = g02 * g1_6 + g12 * g1_7 + g22 * g1_8;
        const double Q1_5 = g02 * g1_3 + g12 * g1_4 + g22 * g1_5;
        const double w25 = 100.0 * (M1_0 * Q1_2 + M1_1 * Q1_5 + M1_2 * Q1_8);
        const double xi1_0 = Q1_0 * w23 + Q1_1 * w24 + Q1_2 * w25;
        const double xi1_2 = Q1_6 * w23 + Q1_7 * w24 + Q1_8 * w25;
        const double xi1_1 = Q1_3 * w23 + Q1_4 * w24 + Q1_5 * w25;
        const double w26 = X1_1 * xi1_2 - X1_2 * xi1_1;
        const double w27 = X1_0 * xi1_1 - X1_1 * xi1_0;
        const double w28 = X1_2 * xi1_0 - X1_0 * xi1_2;
        const double u1_0 = xi1_0 - 0.5 * w26 + 0.08333333333333333 * (X1_1 * w27 - X1_2 * w28);
        const double u1_1 = xi1_1 - 0.5 * w28 + 0.08333333333333333 * (X1_2 * w26 - X1_0 * w27);
        const double u1_2 = xi1_2 - 0.5 * w27 + 0.08333333333333333 * (X1_0 * w28 - X1_1 * w26);
        const double X2_1 = v1_1 * w29 + v2_1 * w4;
        const double X2_0 = v1_0 * w29 + v2_0 * w4;
        const double X2_2 = v1_2 * w29 + v2_2 * w4;
        const double w30 = X2_0 * X2_0 + X2_1 * X2_1 + X2_2 * X2_2;
        double c1_2, c2_2, c3_2;
        stumpff_123(w30, &c1_2, &c2_2, &c3_2);
        const double w32 = X2_1 * c2_2;
        const double w33 = X2_1 * w32;
        const double w34 = X2_2 * c2_2 * X2_2;
        const double g2_0 = 1.0 - (w33 + w34);
        const double w35 = X2_0 * c2_2;
        const double w36 = X2_1 * w35;
        const double w38 = X2_2 * c1_2;
        const double g2_1 = w36 - w38;
        const double w39 = X2_1 * c1_2;
        const double w40 = X2_2 * w35;
        const double g2_2 = w39 + w40;
        const double Q2_0 = g00 * g2_0 + g10 * g2_1 + g20 * g2_2;
        const double w2_2 = 2.0 * m2_2;
        const double w2_0 = 2.0 * m2_0;
        const double w2_1 = 2.0 * m2_1;
        const double w41 = X2_1 * w2_0 - X2_0 * w2_1;
        const double w42 = X2_2 * w2_1 - X2_1 * w2_2;
        const double w43 = X2_0 * w2_2 - X2_2 * w2_0;
        const double M2_2 = w2_2 - 0.5 * w41 + 0.08333333333333333 * (X2_1 * w42 - X2_0 * w43);
        const double g2_6 = w40 - w39;
        const double w44 = X2_0 * c1_2;
        const double w45 = X2_2 * w32;
        const double g2_7 = w44 + w45;
        const double w46 = X2_0 * w35;
        const double g2_8 = 1.0 - (w33 + w46);
        const double Q2_6 = g00 * g2_6 + g10 * g2_7 + g20 * g2_8;
        const double M2_0 = w2_0 - 0.5 * w42 + 0.08333333333333333 * (X2_2 * w43 - X2_1 * w41);
        const double M2_1 = w2_1 - 0.5 * w43 + 0.08333333333333333 * (X2_0 * w41 - X2_2 * w42);
        const double g2_3 = w36 + w38;
        const double g2_4 = 1.0 - (w34 + w46);
        const double g2_5 = w45 - w44;
        const double Q2_3 = g00 * g2_3 + g10 * g2_4 + g20 * g2_5;
        const double w47 = 0.9900990099009901 * (M2_1 * Q2_3 + Q2_0 * M2_0 + M2_2 * Q2_6);
        const double Q2_1 = g01 * g2_0 + g11 * g2_1 + g21 * g2_2;
        const double Q2_7 = g01 * g2_6 + g11 * g2_7 + g21 * g2_8;
        const double Q2_4 = g01 * g2_3 + g11 * g2_4 + g21 * g2_5;
        const double w48 = M2_0 * Q2_1 + M2_1 * Q2_4 + M2_2 * Q2_7;
        const double Q2_2 = g02 * g2_0 + g12 * g2_1 + g22 * g2_2;
        const double Q2_8 = g02 * g2_6 + g12 * g2_7 + g22 * g2_8;
        const double Q2_5 = g02 * g2_3 + g12 * g2_4 + g22 * g2_5;
        const double w49 = 100.0 * (M2_0 * Q2_2 + M2_1 * Q2_5 + M2_2 * Q2_8);
        const double xi2_0 = Q2_0 * w47 + Q2_1 * w48 + Q2_2 * w49;
        const double xi2_2 = Q2_6 * w47 + Q2_7 * w48 + Q2_8 * w49;
        const double xi2_1 = Q2_3 * w47 + Q2_4 * w48 + Q2_5 * w49;
        const double w50 = X2_1 * xi2_2 - X2_2 * xi2_1;
        const double w51 = X2_0 * xi2_1 - X2_1 * xi2_0;
        const double w52 = X2_2 * xi2_0 - X2_0 * xi2_2;
        const double u2_0 = xi2_0 - 0.5 * w50 + 0.08333333333333333 * (X2_1 * w51 - X2_2 * w52);
        const double u2_1 = xi2_1 - 0.5 * w52 + 0.08333333333333333 * (X2_2 * w50 - X2_0 * w51);
        const double u2_2 = xi2_2 - 0.5 * w51 + 0.08333333333333333 * (X2_0 * w52 - X2_1 * w50);
        const double w53 = M2_1 * w47;
        const double w54 = 1.5 + 0.1 * Q2_7 - Q2_8;
        const double w55 = 0.1 * Q2_1 - Q2_2;
        const double w56 = 0.1 * Q2_4 - Q2_5;
        const double w57 = 1.0 / sqrt(w55 * w55 + w56 * w56 + w54 * w54);
        const double w58 = w57 * w57 * (0.5 * w57);
        const double w59 = 2.0 * w56 * w58;
        const double w60 = 1.5 - 0.1 * Q2_7 - Q2_8;
        const double w61 = -0.1 * Q2_1 - Q2_2;
        const double w62 = -0.1 * Q2_4 - Q2_5;
        const double w63 = sqrt(w61 * w61 + w62 * w62 + w60 * w60);
        const double w64 = 1.0 / w63;
        const double w65 = -1.0 / w63 * w64 * (0.5 * w64);
        const double w66 = 2.0 * w62 * w65;
        const double w67 = 0.1 * w66 - 0.1 * w59 + M2_1 * w48;
        const double w68 = w59 + w66 + M2_1 * w49;
        const double w69 = M2_2 * w47;
        const double w70 = 2.0 * w54 * w58;
        const double w71 = 2.0 * w60 * w65;
        const double w72 = 0.1 * w71 - 0.1 * w70 + M2_2 * w48;
        const double w73 = w70 - 1.0 + w71 + M2_2 * w49;
        const double n2_0 = Q2_6 * w53 + Q2_7 * w67 + Q2_8 * w68 - Q2_3 * w69 - Q2_4 * w72
            - Q2_5 * w73;
        const double w74 = M2_0 * w47;
        const double w75 = 2.0 * w55 * w58;
        const double w76 = 2.0 * w61 * w65;
        const double w77 = 0.1 * w76 - 0.1 * w75 + M2_0 * w48;
        const double w78 = w75 + w76 + M2_0 * w49;
        const double n2_2 = Q2_3 * w74 + Q2_4 * w77 + Q2_5 * w78 - Q2_0 * w53 - Q2_1 * w67
            - Q2_2 * w68;
        const double n2_1 = Q2_0 * w69 - (Q2_6 * w74 + Q2_7 * w77 + Q2_8 * w78) + Q2_1 * w72
            + Q2_2 * w73;
        const double w79 = X2_1 * n2_2 - X2_2 * n2_1;
        const double w81 = X2_0 * n2_1 - X2_1 * n2_0;
        const double w82 = X2_2 * n2_0 - X2_0 * n2_2;
        const double d2_0 = n2_0 - w79 * c2_2 + (X2_1 * w81 - X2_2 * w82) * c3_2;
        const double w84 = 0.5 * xi2_2 - 0.08333333333333333 * w51;
        const double w85 = 0.5 * xi2_1 - 0.08333333333333333 * w52;
        const double w86 = m2_2 * X2_0 - m2_0 * X2_2;
        const double w87 = -0.08333333333333333 * xi2_2;
        const double w88 = m2_0 * X2_1 - m2_1 * X2_0;
        const double w89 = -0.08333333333333333 * xi2_1;
        const double P2_0 = m2_1 * w84 - m2_2 * w85 + (w86 * w87 - w88 * w89);
        const double w90 = M1_1 * w23;
        const double w91 = 1.5 + 0.1 * Q1_7 - Q1_8;
        const double w92 = 0.1 * Q1_1 - Q1_2;
        const double w93 = 0.1 * Q1_4 - Q1_5;
        const double w94 = 1.0 / sqrt(w92 * w92 + w93 * w93 + w91 * w91);
        const double w95 = w94 * w94 * (0.5 * w94);
        const double w96 = 2.0 * w93 * w95;
        const double w97 = 1.5 - 0.1 * Q1_7 - Q1_8;
        const double w98 = -0.1 * Q1_1 - Q1_2;
        const double w99 = -0.1 * Q1_4 - Q1_5;
        const double w100 = sqrt(w98 * w98 + w99 * w99 + w97 * w97);
        const double w101 = 1.0 / w100;
        const double w102 = -1.0 / w100 * w101 * (0.5 * w101);
        const double w103 = 2.0 * w99 * w102;
        const double w104 = 0.1 * w103 - 0.1 * w96 + M1_1 * w24;
        const double w105 = w96 + w103 + M1_1 * w25;
        const double w106 = M1_2 * w23;
        const double w107 = 2.0 * w91 * w95;
        const double w108 = 2.0 * w97 * w102;
        const double w109 = 0.1 * w108 - 0.1 * w107 + M1_2 * w24;
        const double w110 = w107 - 1.0 + w108 + M1_2 * w25;
        const double n1_0 = Q1_6 * w90 + Q1_7 * w104 + Q1_8 * w105 - Q1_3 * w106 - Q1_4 * w109
            - Q1_5 * w110;
        const double w111 = M1_0 * w23;
        const double w112 = 2.0 * w92 * w95;
        const double w113 = 2.0 * w98 * w102;
        const double w114 = 0.1 * w113 - 0.1 * w112 + M1_0 * w24;
        const double w115 = w112 + w113 + M1_0 * w25;
        const double n1_2 = Q1_3 * w111 + Q1_4 * w114 + Q1_5 * w115 - Q1_0 * w90 - Q1_1 * w104
            - Q1_2 * w105;
        const double n1_1 = Q1_0 * w106 - (Q1_6 * w111 + Q1_7 * w114 + Q1_8 * w115) + Q1_1 * w109
            + Q1_2 * w110;
        const double w116 = X1_1 * n1_2 - X1_2 * n1_1;
        const double w118 = X1_0 * n1_1 - X1_1 * n1_0;
        const double w119 = X1_2 * n1_0 - X1_0 * n1_2;
        const double d1_0 = n1_0 - w116 * c2_1 + (X1_1 * w118 - X1_2 * w119) * c3_1;
        nu2_0 = g2_0 * n2_0 + g2_3 * n2_1 + g2_6 * n2_2;
        Y_0 = w121 * (u1_0 + u2_0);
        Y_1 = w121 * (u1_1 + u2_1);
        Y_2 = w121 * (u1_2 + u2_2);
        w122 = Y_0 * Y_0 + Y_1 * Y_1 + Y_2 * Y_2;
        double c2_3, c3_3;
        stumpff_23(w122, &c2_3, &c3_3);
        w123 = c2_3;
        nu2_1 = g2_1 * n2_0 + g2_4 * n2_1 + g2_7 * n2_2;
        nu2_2 = g2_2 * n2_0 + g2_5 * n2_1 + g2_8 * n2_2;
        const double w124 = Y_2 * nu2_1 - Y_1 * nu2_2;
        const double w126 = Y_0 * nu2_2 - nu2_0 * Y_2;
        const double w127 = nu2_0 * Y_1 - Y_0 * nu2_1;
        const double L_3_0 = nu2_0 - w123 * w124 + (Y_2 * w126 - Y_1 * w127) * c3_3;
        const double w128 = 0.5 * xi1_2 - 0.08333333333333333 * w27;
        const double w129 = 0.5 * xi1_1 - 0.08333333333333333 * w28;
        const double w130 = m1_2 * X1_0 - m1_0 * X1_2;
        const double w131 = -0.08333333333333333 * xi1_2;
        const double w132 = m1_0 * X1_1 - m1_1 * X1_0;
        const double w133 = -0.08333333333333333 * xi1_1;
        const double P1_0 = m1_1 * w128 - m1_2 * w129 + (w130 * w131 - w132 * w133);
        nu1_0 = g1_0 * n1_0 + g1_3 * n1_1 + g1_6 * n1_2;
        nu1_1 = g1_1 * n1_0 + g1_4 * n1_1 + g1_7 * n1_2;
        nu1_2 = g1_2 * n1_0 + g1_5 * n1_1 + g1_8 * n1_2;
        const double w134 = Y_2 * nu1_1 - Y_1 * nu1_2;
        const double w135 = Y_0 * nu1_2 - Y_2 * nu1_0;
        const double w136 = Y_1 * nu1_0 - Y_0 * nu1_1;
        const double L_2_0 = nu1_0 - w123 * w134 + (Y_2 * w135 - Y_1 * w136) * c3_3;
        const double w137 = mu1 * Y_2 - mu2 * Y_1;
        const double w138 = mu2 * Y_0 - mu0 * Y_2;
        const double w139 = mu0 * Y_1 - mu1 * Y_0;
        const double w140 = 0.5 * (mu0 - w123 * w137 + (Y_2 * w138 - Y_1 * w139) * c3_3);
        const double p1_0 = d2_0 * w83 + w29 * P2_0 + d1_0 * w120 + w4 * (P1_0 + L_2_0 + L_3_0)
            + w140;
        const double d2_1 = n2_1 - w82 * c2_2 + (X2_2 * w79 - X2_0 * w81) * c3_2;
        const double w141 = 0.5 * xi2_0 - 0.08333333333333333 * w50;
        const double w142 = -0.08333333333333333 * xi2_0;
        const double w143 = m2_1 * X2_2 - m2_2 * X2_1;
        const double P2_1 = m2_2 * w141 - m2_0 * w84 + (w88 * w142 - w87 * w143);
        const double d1_1 = n1_1 - w119 * c2_1 + (X1_2 * w116 - X1_0 * w118) * c3_1;
        const double L_3_1 = nu2_1 - w123 * w126 + (Y_0 * w127 - Y_2 * w124) * c3_3;
        const double w144 = 0.5 * xi1_0 - 0.08333333333333333 * w26;
        const double w145 = -0.08333333333333333 * xi1_0;
        const double w146 = m1_1 * X1_2 - m1_2 * X1_1;
        const double P1_1 = m1_2 * w144 - m1_0 * w128 + (w132 * w145 - w131 * w146);
        const double L_2_1 = nu1_1 - w123 * w135 + (Y_0 * w136 - Y_2 * w134) * c3_3;
        const double w147 = 0.5 * (mu1 - w123 * w138 + (Y_0 * w139 - Y_2 * w137) * c3_3);
        const double p1_1 = w29 * P2_1 + w83 * d2_1 + w120 * d1_1 + w4 * (P1_1 + L_2_1 + L_3_1)
            + w147;
        const double d2_2 = n2_2 - w81 * c2_2 + (X2_0 * w82 - X2_1 * w79) * c3_2;
        const double P2_2 = m2_0 * w85 - m2_1 * w141 + (w89 * w143 - w86 * w142);
        const double d1_2 = n1_2 - w118 * c2_1 + (X1_0 * w119 - X1_1 * w116) * c3_1;
        const double L_3_2 = nu2_2 - w123 * w127 + (Y_1 * w124 - Y_0 * w126) * c3_3;
        const double P1_2 = m1_0 * w129 - m1_1 * w144 + (w133 * w146 - w130 * w145);
        const double L_2_2 = nu1_2 - w123 * w136 + (Y_1 * w134 - Y_0 * w135) * c3_3;
        const double w148 = 0.5 * (mu2 - w123 * w139 + (Y_1 * w137 - Y_0 * w138) * c3_3);
        const double p1_2 = w29 * P2_2 + w83 * d2_2 + w120 * d1_2 + w4 * (P1_2 + L_2_2 + L_3_2)
            + w148;
        const double p2_0 = d2_0 * w120 + w4 * (P2_0 + L_2_0 + L_3_0) + d1_0 * w149 + w5 * P1_0
            + w140;
        const double p2_1 = w4 * (P2_1 + L_2_1 + L_3_1) + w120 * d2_1 + d1_1 * w149 + w5 * P1_1
            + w147;
        const double p2_2 = w4 * (P2_2 + L_2_2 + L_3_2) + w120 * d2_2 + d1_2 * w149 + w5 * P1_2
            + w148;
        const double change_v1_0 = fabs(u1_0 - v1_0);
        const double change_v1_1 = fabs(u1_1 - v1_1);
        const double change_v1_2 = fabs(u1_2 - v1_2);
        const double change_v2_0 = fabs(u2_0 - v2_0);
        const double change_v2_1 = fabs(u2_1 - v2_1);
        const double change_v2_2 = fabs(u2_2 - v2_2);
        const double change_m1_0 = fabs(p1_0 - m1_0);
        const double change_m1_1 = fabs(p1_1 - m1_1);
        const double change_m1_2 = fabs(p1_2 - m1_2);
        const double change_m2_0 = fabs(p2_0 - m2_0);
        const double change_m2_1 = fabs(p2_1 - m2_1);
        const double change_m2_2 = fabs(p2_2 - m2_2);
        const double change = greater(greater(greater(change_v1_0, greater(change_v1_1,
            change_v1_2)), greater(change_v2_0, greater(change_v2_1, change_v2_2))),
            greater(greater(change_m1_0, greater(change_m1_1, change_m1_2)), greater(change_m2_0,
            greater(change_m2_1, change_m2_2))));
        const double scale = greater(greater(greater(1.0, greater(fabs(v1_0), fabs(v1_1))),
            greater(fabs(v1_2), greater(fabs(v2_0), fabs(v2_1)))), greater(greater(fabs(v2_2),
            greater(fabs(m1_0), fabs(m1_1))), greater(greater(fabs(m1_2), fabs(m2_0)),
            greater(fabs(m2_1), fabs(m2_2)))));
        if (!isfinite(change_v1_0 + change_v1_1 + change_v1_2 + change_v2_0 + change_v2_1
            + change_v2_2 + change_m1_0 + change_m1_1 + change_m1_2 + change_m2_0 + change_m2_1
            + change_m2_2)) {
            count_sweeps(statistics, 0, sweep, 1);
            return DIPOLE_VRKMK2_GAUSS2_NOT_FINITE;
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
            return DIPOLE_VRKMK2_GAUSS2_NOT_CONVERGED;
        }
        previous_1 = change;
        v1_0 = u1_0;
        v1_1 = u1_1;
        v1_2 = u1_2;
        v2_0 = u2_0;
        v2_1 = u2_1;
        v2_2 = u2_2;
        m1_0 = p1_0;
        m1_1 = p1_1;
        m1_2 = p1_2;
        m2_0 = p2_0;
        m2_1 = p2_1;
        m2_2 = p2_2;
    }
    const double w150 = Y_1 * w123;
    const double w151 = Y_1 * w150;
    const double w152 = Y_2 * w123 * Y_2;
    const double g_0 = 1.0 - (w151 + w152);
    const double w153 = Y_0 * w123;
    const double w154 = Y_1 * w153;
    const double c1_3 = stumpff_1(w122);
    const double w156 = Y_2 * c1_3;
    const double g_1 = w154 - w156;
    const double w157 = Y_1 * c1_3;
    const double w158 = Y_2 * w153;
    const double g_2 = w157 + w158;
    const double g_3 = w154 + w156;
    const double w159 = Y_0 * w153;
    const double g_4 = 1.0 - (w152 + w159);
    const double w160 = Y_2 * w150;
    const double w161 = Y_0 * c1_3;
    const double g_5 = w160 - w161;
    const double g_6 = w158 - w157;
    const double g_7 = w160 + w161;
    const double g_8 = 1.0 - (w151 + w159);
    const double mubar_0 = mu0 + w121 * (nu2_0 + nu1_0);
    const double mubar_1 = mu1 + w121 * (nu2_1 + nu1_1);
    const double mubar_2 = mu2 + w121 * (nu2_2 + nu1_2);
    const double new_g00 = g00 * g_0 + g10 * g_1 + g20 * g_2;
    const double new_g01 = g01 * g_0 + g11 * g_1 + g21 * g_2;
    const double new_g02 = g02 * g_0 + g12 * g_1 + g22 * g_2;
    const double new_g10 = g00 * g_3 + g10 * g_4 + g20 * g_5;
    const double new_g11 = g01 * g_3 + g11 * g_4 + g21 * g_5;
    const double new_g12 = g02 * g_3 + g12 * g_4 + g22 * g_5;
    const double new_g20 = g00 * g_6 + g10 * g_7 + g20 * g_8;
    const double new_g21 = g01 * g_6 + g11 * g_7 + g21 * g_8;
    const double new_g22 = g02 * g_6 + g12 * g_7 + g22 * g_8;
    const double new_mu0 = g_0 * mubar_0 + g_1 * mubar_1 + g_2 * mubar_2;
    const double new_mu1 = g_3 * mubar_0 + g_4 * mubar_1 + g_5 * mubar_2;
    const double new_mu2 = g_6 * mubar_0 + g_7 * mubar_1 + g_8 * mubar_2;
    if (!(isfinite(new_g00) && isfinite(new_g01) && isfinite(new_g02) && isfinite(new_g10)
        && isfinite(new_g11) && isfinite(new_g12) && isfinite(new_g20) && isfinite(new_g21)
        && isfinite(new_g22) && isfinite(new_mu0) && isfinite(new_mu1) && isfinite(new_mu2))) {
        return DIPOLE_VRKMK2_GAUSS2_NOT_FINITE;
    }
    state[0] = new_g00;
    state[1] = new_g01;
    state[2] = new_g02;
    state[3] = new_g10;
    state[4] = new_g11;
    state[5] = new_g12;
    state[6] = new_g20;
    state[7] = new_g21;
    state[8] = new_g22;
    state[9] = new_mu0;
    state[10] = new_mu1;
    state[11] = new_mu2;
    return DIPOLE_VRKMK2_GAUSS2_OK;
}

int dipole_vrkmk2_gauss2_step(double state[static 12], double h,
    dipole_vrkmk2_gauss2_statistics *statistics)
{
    return advance(state, h, statistics);
}

int dipole_vrkmk2_gauss2_run(double state[static 12], double h, size_t steps,
    double *trajectory, size_t stride, dipole_vrkmk2_gauss2_statistics *statistics,
    size_t *completed)
{
    int status = DIPOLE_VRKMK2_GAUSS2_OK;
    size_t step = 0;
    double *row = stride > 0 ? trajectory : NULL;
    if (row != NULL) {
        memcpy(row, state, 12 * sizeof *state);
    }
    while (step < steps) {
        status = advance(state, h, statistics);
        if (status != DIPOLE_VRKMK2_GAUSS2_OK) {
            break;
        }
        step++;
        if (row != NULL && step % stride == 0) {
            row += 12;
            memcpy(row, state, 12 * sizeof *state);
        }
    }
    if (completed != NULL) {
        *completed = step;
    }
    return status;
}
