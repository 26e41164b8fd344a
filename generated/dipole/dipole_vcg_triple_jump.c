/*
 * Dipole on a stick, T*SO(3) (thesis section 3.6): one step by vcg:triple_jump
 *
 * method:     family vcg, tableau triple_jump
 * source:     Yoshida 1990; Hairer, Lubich and Wanner, (II.4.4); Table 3.2b of Bogfjellmo and
 *             Marthinsen
 * order:      4, certificate: exact (every order condition up to it is zero in exact arithmetic)
 * scene:      Dipole on a stick, T*SO(3) (thesis section 3.6), group SO(3)
 * state:      [0..8] q: element of SO(3), row by row
 *             [9..11] mu: right-trivialised momentum in the dual algebra of SO(3)
 * left out:   7 Adtinv, 3 exp, 7 mul (zeros)
 *             3 Adtinv, 3 dexpt, 3 exp, 6 identity, 6 lin, 1 mul, 2 zero (sharing)
 *             1 Adtinv, 3 dexpt, 1 identity, 1 zero (dead code)
 *             3 Adtinv, 6 dexpt (factors)
 *             1 lin (sharing)
 *             parameters, folded: beta = 1
 *             the time: the scene does not depend on it
 * operations: 202 add, 298 mul, 2 sqrt, 6 div, 3 stumpff_12 a step
 *             148 add, 230 mul, 6 div, 2 sqrt, 1 stumpff_12, 2 stumpff_23 a sweep of the equations
 *             of xi1, n1
 *             172 add, 266 mul, 6 div, 2 sqrt, 1 stumpff_12, 2 stumpff_23 a sweep of the equations
 *             of xi2, n2
 *             172 add, 266 mul, 6 div, 2 sqrt, 1 stumpff_12, 2 stumpff_23 a sweep of the equations
 *             of xi3, n3
 * made by:    orderconds emit dipole --method vcg:triple_jump --target c -o .
 * version:    orderconds 0.1.0
 *
 * Build: cc -std=c11 -O2 -ffp-contract=off -c dipole_vcg_triple_jump.c
 * Use:
 *
 *     #include "dipole_vcg_triple_jump.h"
 *     #include <stdio.h>
 *
 *     int main(void)
 *     {
 *         double state[12] = {1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.01, 0.0};
 *         size_t completed;
 *         const int status = dipole_vcg_triple_jump_run(state, 0.005, 100, NULL, 0, NULL, &completed);
 *         printf("status %d after %zu steps\n", status, completed);
 *         for (int i = 0; i < 12; i++) {
 *             printf("%.17g\n", state[i]);
 *         }
 *         return status;
 *     }
 */
#include "dipole_vcg_triple_jump.h"

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

/* For z >= 0 and s = sqrt(z): c_1 = sin(s)/s, c_2 = (1 - cos(s))/s^2 */
static inline void stumpff_12(double z, double *c1, double *c2)
{
    if (z <= 1.0) {
        *c1 = stumpff_series_1(z);
        *c2 = stumpff_series_2(z);
        return;
    }
    const double half = 0.5 * sqrt(z);
    const double sine = sin(half);
    const double cosine = cos(half);
    const double ratio = sine / half;
    *c1 = ratio * cosine;
    *c2 = 0.5 * (ratio * ratio);
}

static inline double greater(double a, double b)
{
    return a > b ? a : b;
}

static void count_sweeps(dipole_vcg_triple_jump_statistics *statistics, size_t block, size_t sweeps, int failed)
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
    dipole_vcg_triple_jump_statistics *statistics)
{
    if (!isfinite(h)) {
        return DIPOLE_VCG_TRIPLE_JUMP_BAD_STEP;
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
    const double w1 = 100.0 * g22;
    const double w2 = 100.0 * g02;
    const double w3 = 100.0 * g12;
    const double w4 = mu0 * w2 + mu1 * w3 + mu2 * w1;
    const double w5 = 0.9900990099009901 * g20;
    const double w6 = 0.9900990099009901 * g00;
    const double w7 = 0.9900990099009901 * g10;
    const double w8 = mu0 * w6 + mu1 * w7 + mu2 * w5;
    const double w9 = g01 * mu0 + g11 * mu1 + g21 * mu2;
    const double w10 = 0.5 * mu0;
    const double w11 = 0.5 * mu1;
    const double w12 = 0.5 * mu2;
    const double w13 = g01 * w10 + g11 * w11 + g21 * w12;
    const double w14 = g00 * w10 + g10 * w11 + g20 * w12;
    const double w15 = 0.5 * (g00 * w8 + g01 * w9 + g02 * w4) + g01 * w13 + w6 * w14;
    const double w16 = g02 * w10 + g12 * w11 + g22 * w12;
    const double xi0_0 = w15 + w2 * w16;
    const double w17 = 0.5 * (g10 * w8 + g11 * w9 + g12 * w4) + g11 * w13 + w7 * w14;
    const double xi0_1 = w17 + w3 * w16;
    const double w18 = 0.5 * (g20 * w8 + g21 * w9 + g22 * w4) + g21 * w13 + w5 * w14;
    const double xi0_2 = w18 + w1 * w16;
    const double w19 = w8 * w11 + 0.9900990099009901 * (mu1 * w14);
    const double w20 = 1.5 + 0.1 * g21 - g22;
    const double w21 = 0.1 * g01 - g02;
    const double w22 = 0.1 * g11 - g12;
    const double w23 = sqrt(w21 * w21 + w22 * w22 + w20 * w20);
    const double w24 = 1.0 / w23 / w23 * (0.5 / w23);
    const double w25 = 2.0 * w22 * w24;
    const double w26 = 1.5 - 0.1 * g21 - g22;
    const double w27 = -0.1 * g01 - g02;
    const double w28 = -0.1 * g11 - g12;
    const double w29 = sqrt(w27 * w27 + w28 * w28 + w26 * w26);
    const double w30 = -1.0 / w29 / w29 * (0.5 / w29);
    const double w31 = 2.0 * w28 * w30;
    const double w32 = 0.1 * w31 - 0.1 * w25 + w9 * w11 + mu1 * w13;
    const double w33 = w25 + w31 + w4 * w11 + 100.0 * (mu1 * w16);
    const double w34 = w8 * w12 + 0.9900990099009901 * (mu2 * w14);
    const double w35 = 2.0 * w20 * w24;
    const double w36 = 2.0 * w26 * w30;
    const double w37 = 0.1 * w36 - 0.1 * w35 + w9 * w12 + mu2 * w13;
    const double w38 = w35 - 1.0 + w36 + w4 * w12 + 100.0 * (mu2 * w16);
    const double n0_0 = g20 * w19 + g21 * w32 + g22 * w33 - g10 * w34 - g11 * w37 - g12 * w38;
    const double w39 = w8 * w10 + 0.9900990099009901 * (mu0 * w14);
    const double w40 = 2.0 * w21 * w24;
    const double w41 = 2.0 * w27 * w30;
    const double w42 = 0.1 * w41 - 0.1 * w40 + w9 * w10 + mu0 * w13;
    const double w43 = w40 + w41 + w4 * w10 + 100.0 * (mu0 * w16);
    const double n0_1 = g00 * w34 - (g20 * w39 + g21 * w42 + g22 * w43) + g01 * w37 + g02 * w38;
    const double n0_2 = g10 * w39 + g11 * w42 + g12 * w43 - g00 * w19 - g01 * w32 - g02 * w33;
    const double w44 = 0.6756035959798288 * h;
    const double w59 = 1.3512071919596575 * h;
    const double w60 = -1.3512071919596575 * h;
    const double w67 = -0.6756035959798288 * h;
    /* the equations of xi1, n1: fixed point in xi1_0, xi1_1, xi1_2, n1_0, n1_1, n1_2 */
    double xi1_0 = xi0_0;
    double xi1_1 = xi0_1;
    double xi1_2 = xi0_2;
    double n1_0 = n0_0;
    double n1_1 = n0_1;
    double n1_2 = n0_2;
    double nu1_2, s_mu_2, nu1_1, s_mu_1, nu1_0, s_mu_0, f1_0, f1_1, f1_2;
    double previous_1 = INFINITY;
    for (size_t sweep = 1;; sweep++) {
        const double xE1_1_1 = xi1_1 * w44;
        const double xE1_1_0 = xi1_0 * w44;
        const double xE1_1_2 = xi1_2 * w44;
        const double w45 = xE1_1_0 * xE1_1_0 + xE1_1_1 * xE1_1_1 + xE1_1_2 * xE1_1_2;
        double c1_1, c2_1;
        stumpff_12(w45, &c1_1, &c2_1);
        const double w47 = xE1_1_1 * c2_1;
        const double w48 = xE1_1_1 * w47;
        const double w49 = xE1_1_2 * c2_1 * xE1_1_2;
        const double gE1_1_0 = 1.0 - (w48 + w49);
        const double w50 = xE1_1_0 * c2_1;
        const double w51 = xE1_1_1 * w50;
        const double w53 = xE1_1_2 * c1_1;
        const double gE1_1_1 = w51 - w53;
        const double w54 = xE1_1_1 * c1_1;
        const double w55 = xE1_1_2 * w50;
        const double gE1_1_2 = w54 + w55;
        const double Q1_2 = g02 * gE1_1_0 + g12 * gE1_1_1 + g22 * gE1_1_2;
        const double w56 = xE1_1_2 * w47;
        const double w57 = xE1_1_0 * c1_1;
        const double gE1_1_5 = w56 - w57;
        const double w58 = xE1_1_0 * w50;
        const double gE1_1_8 = 1.0 - (w48 + w58);
        nu1_2 = n1_0 * gE1_1_2 + n1_1 * gE1_1_5 + n1_2 * gE1_1_8;
        s_mu_2 = mu2 + nu1_2 * w59;
        const double y1_0 = xi1_0 * w60;
        const double y1_1 = xi1_1 * w60;
        const double y1_2 = xi1_2 * w60;
        const double w61 = y1_0 * y1_0 + y1_1 * y1_1 + y1_2 * y1_2;
        double c2_2, c3_1;
        stumpff_23(w61, &c2_2, &c3_1);
        const double gE1_1_4 = 1.0 - (w49 + w58);
        const double gE1_1_7 = w56 + w57;
        nu1_1 = n1_0 * gE1_1_1 + n1_1 * gE1_1_4 + n1_2 * gE1_1_7;
        s_mu_1 = mu1 + w59 * nu1_1;
        const double gE1_1_3 = w51 + w53;
        const double gE1_1_6 = w55 - w54;
        nu1_0 = n1_0 * gE1_1_0 + n1_1 * gE1_1_3 + n1_2 * gE1_1_6;
        s_mu_0 = mu0 + w59 * nu1_0;
        const double w63 = y1_0 * s_mu_1 - y1_1 * s_mu_0;
        const double w65 = y1_2 * s_mu_0 - s_mu_2 * y1_0;
        const double w66 = s_mu_2 * y1_1 - y1_2 * s_mu_1;
        const double y1_2_0 = xi1_0 * w67;
        const double y1_2_1 = xi1_1 * w67;
        const double y1_2_2 = xi1_2 * w67;
        const double w68 = y1_2_0 * y1_2_0 + y1_2_1 * y1_2_1 + y1_2_2 * y1_2_2;
        double c2_3, c3_2;
        stumpff_23(w68, &c2_3, &c3_2);
        const double w70 = nu1_1 * y1_2_0 - nu1_0 * y1_2_1;
        const double w72 = nu1_0 * y1_2_2 - nu1_2 * y1_2_0;
        const double w73 = nu1_2 * y1_2_1 - nu1_1 * y1_2_2;
        const double M1_2 = s_mu_2 - w63 * c2_2 + (y1_0 * w65 - y1_1 * w66) * c3_1
            + w67 * (nu1_2 - w70 * c2_3 + (y1_2_0 * w72 - y1_2_1 * w73) * c3_2);
        const double Q1_8 = g02 * gE1_1_6 + g12 * gE1_1_7 + g22 * gE1_1_8;
        const double w74 = 100.0 * Q1_8;
        const double M1_0 = s_mu_0 - w66 * c2_2 + (y1_1 * w63 - y1_2 * w65) * c3_1
            + w67 * (nu1_0 - w73 * c2_3 + (y1_2_1 * w70 - y1_2_2 * w72) * c3_2);
        const double w75 = 100.0 * Q1_2;
        const double M1_1 = s_mu_1 - w65 * c2_2 + (y1_2 * w66 - y1_0 * w63) * c3_1
            + w67 * (nu1_1 - w72 * c2_3 + (y1_2_2 * w73 - y1_2_0 * w70) * c3_2);
        const double Q1_5 = g02 * gE1_1_3 + g12 * gE1_1_4 + g22 * gE1_1_5;
        const double w76 = 100.0 * Q1_5;
        const double w77 = M1_0 * w75 + M1_1 * w76 + M1_2 * w74;
        const double Q1_0 = g00 * gE1_1_0 + g10 * gE1_1_1 + g20 * gE1_1_2;
        const double Q1_6 = g00 * gE1_1_6 + g10 * gE1_1_7 + g20 * gE1_1_8;
        const double w78 = 0.9900990099009901 * Q1_6;
        const double w79 = 0.9900990099009901 * Q1_0;
        const double Q1_3 = g00 * gE1_1_3 + g10 * gE1_1_4 + g20 * gE1_1_5;
        const double w80 = 0.9900990099009901 * Q1_3;
        const double w81 = M1_0 * w79 + M1_1 * w80 + M1_2 * w78;
        const double Q1_1 = g01 * gE1_1_0 + g11 * gE1_1_1 + g21 * gE1_1_2;
        const double Q1_7 = g01 * gE1_1_6 + g11 * gE1_1_7 + g21 * gE1_1_8;
        const double Q1_4 = g01 * gE1_1_3 + g11 * gE1_1_4 + g21 * gE1_1_5;
        const double w82 = M1_0 * Q1_1 + M1_1 * Q1_4 + M1_2 * Q1_7;
        const double w83 = 0.5 * M1_0;
        const double w84 = 0.5 * M1_1;
        const double w85 = 0.5 * M1_2;
        const double w86 = Q1_1 * w83 + Q1_4 * w84 + Q1_7 * w85;
        const double w87 = Q1_0 * w83 + Q1_3 * w84 + Q1_6 * w85;
        const double w88 = 0.5 * (Q1_0 * w81 + Q1_1 * w82 + Q1_2 * w77) + Q1_1 * w86 + w79 * w87;
        const double w89 = Q1_2 * w83 + Q1_5 * w84 + Q1_8 * w85;
        f1_0 = w88 + w75 * w89;
        const double w90 = 0.5 * (Q1_3 * w81 + Q1_4 * w82 + Q1_5 * w77) + Q1_4 * w86 + w80 * w87;
        f1_1 = w90 + w76 * w89;
        const double w91 = 0.5 * (Q1_6 * w81 + Q1_7 * w82 + Q1_8 * w77) + Q1_7 * w86 + w78 * w87;
        f1_2 = w91 + w74 * w89;
        const double w92 = w81 * w84 + 0.9900990099009901 * (M1_1 * w87);
        const double w93 = 1.5 + 0.1 * Q1_7 - Q1_8;
        const double w94 = 0.1 * Q1_1 - Q1_2;
        const double w95 = 0.1 * Q1_4 - Q1_5;
        const double w96 = sqrt(w94 * w94 + w95 * w95 + w93 * w93);
        const double w97 = 1.0 / w96 / w96 * (0.5 / w96);
        const double w98 = 2.0 * w95 * w97;
        const double w99 = 1.5 - 0.1 * Q1_7 - Q1_8;
        const double w100 = -0.1 * Q1_1 - Q1_2;
        const double w101 = -0.1 * Q1_4 - Q1_5;
        const double w102 = sqrt(w100 * w100 + w101 * w101 + w99 * w99);
        const double w103 = -1.0 / w102 / w102 * (0.5 / w102);
        const double w104 = 2.0 * w101 * w103;
        const double w105 = 0.1 * w104 - 0.1 * w98 + w82 * w84 + M1_1 * w86;
        const double w106 = w98 + w104 + w77 * w84 + 100.0 * (M1_1 * w89);
        const double w107 = w81 * w85 + 0.9900990099009901 * (M1_2 * w87);
        const double w108 = 2.0 * w93 * w97;
        const double w109 = 2.0 * w99 * w103;
        const double w110 = 0.1 * w109 - 0.1 * w108 + w82 * w85 + M1_2 * w86;
        const double w111 = w108 - 1.0 + w109 + w77 * w85 + 100.0 * (M1_2 * w89);
        const double r1_0 = Q1_6 * w92 + Q1_7 * w105 + Q1_8 * w106 - Q1_3 * w107 - Q1_4 * w110
            - Q1_5 * w111;
        const double w112 = w81 * w83 + 0.9900990099009901 * (M1_0 * w87);
        const double w113 = 2.0 * w94 * w97;
        const double w114 = 2.0 * w100 * w103;
        const double w115 = 0.1 * w114 - 0.1 * w113 + w82 * w83 + M1_0 * w86;
        const double w116 = w113 + w114 + w77 * w83 + 100.0 * (M1_0 * w89);
        const double r1_1 = Q1_0 * w107 - (Q1_6 * w112 + Q1_7 * w115 + Q1_8 * w116) + Q1_1 * w110
            + Q1_2 * w111;
        const double r1_2 = Q1_3 * w112 + Q1_4 * w115 + Q1_5 * w116 - Q1_0 * w92 - Q1_1 * w105
            - Q1_2 * w106;
        const double change_xi1_0 = fabs(f1_0 - xi1_0);
        const double change_xi1_1 = fabs(f1_1 - xi1_1);
        const double change_xi1_2 = fabs(f1_2 - xi1_2);
        const double change_n1_0 = fabs(r1_0 - n1_0);
        const double change_n1_1 = fabs(r1_1 - n1_1);
        const double change_n1_2 = fabs(r1_2 - n1_2);
        const double change = greater(greater(change_xi1_0, greater(change_xi1_1, change_xi1_2)),
            greater(change_n1_0, greater(change_n1_1, change_n1_2)));
        const double scale = greater(greater(1.0, greater(fabs(xi1_0), fabs(xi1_1))),
            greater(greater(fabs(xi1_2), fabs(n1_0)), greater(fabs(n1_1), fabs(n1_2))));
        if (!isfinite(change_xi1_0 + change_xi1_1 + change_xi1_2 + change_n1_0 + change_n1_1
            + change_n1_2)) {
            count_sweeps(statistics, 0, sweep, 1);
            return DIPOLE_VCG_TRIPLE_JUMP_NOT_FINITE;
        }
        if (change <= 5.684341886080802e-14 * scale && (change >= previous_1 || change <= 0.0)) {
            count_sweeps(statistics, 0, sweep, 0);
            break;
        }
        if (sweep == 100) {
            count_sweeps(statistics, 0, sweep, 1);
            return DIPOLE_VCG_TRIPLE_JUMP_NOT_CONVERGED;
        }
        previous_1 = change;
        xi1_0 = f1_0;
        xi1_1 = f1_1;
        xi1_2 = f1_2;
        n1_0 = r1_0;
        n1_1 = r1_1;
        n1_2 = r1_2;
    }
    const double xe1_1 = w59 * f1_1;
    const double xe1_0 = w59 * f1_0;
    const double w117 = xe1_0 * xe1_0;
    const double w118 = xe1_1 * xe1_1;
    const double w119 = w117 + w118;
    const double xe1_2 = w59 * f1_2;
    const double w120 = xe1_2 * xe1_2;
    const double w121 = w119 + w120;
    double c1_2, c2_4;
    stumpff_12(w121, &c1_2, &c2_4);
    const double w123 = xe1_1 * c2_4;
    const double w124 = xe1_1 * w123;
    const double w125 = xe1_2 * c2_4;
    const double w126 = xe1_2 * w125;
    const double w127 = w124 + w126;
    const double ge1_0 = 1.0 - w127;
    const double w128 = -0.8512071919596577 * h;
    const double w135 = xe1_2 * c1_2;
    const double w136 = xe1_0 * c2_4;
    const double w137 = xe1_1 * w136;
    const double ge1_3 = w135 + w137;
    const double w142 = xe1_2 * w136;
    const double w143 = xe1_1 * c1_2;
    const double ge1_6 = w142 - w143;
    const double ge1_1 = w137 - w135;
    const double w146 = xe1_0 * w136;
    const double w147 = w126 + w146;
    const double ge1_4 = 1.0 - w147;
    const double w148 = xe1_0 * c1_2;
    const double w149 = xe1_2 * w123;
    const double ge1_7 = w148 + w149;
    const double ge1_2 = w142 + w143;
    const double ge1_5 = w149 - w148;
    const double w150 = w124 + w146;
    const double ge1_8 = 1.0 - w150;
    const double w151 = s_mu_0 * ge1_6;
    const double w152 = s_mu_1 * ge1_7;
    const double w153 = w151 + w152;
    const double w154 = s_mu_2 * ge1_8;
    const double m2_4_2 = w153 + w154;
    const double w158 = -1.7024143839193153 * h;
    const double w159 = 1.7024143839193153 * h;
    const double w162 = s_mu_0 * ge1_3;
    const double w163 = s_mu_1 * ge1_4;
    const double w164 = w162 + w163;
    const double w165 = s_mu_2 * ge1_5;
    const double m2_4_1 = w164 + w165;
    const double w166 = s_mu_0 * ge1_0;
    const double w167 = s_mu_1 * ge1_1;
    const double w168 = w166 + w167;
    const double w169 = s_mu_2 * ge1_2;
    const double m2_4_0 = w168 + w169;
    const double w174 = 0.8512071919596577 * h;
    /* the equations of xi2, n2: fixed point in xi2_0, xi2_1, xi2_2, n2_0, n2_1, n2_2 */
    double xi2_0 = xi0_0;
    double xi2_1 = xi0_1;
    double xi2_2 = xi0_2;
    double n2_0 = n0_0;
    double n2_1 = n0_1;
    double n2_2 = n0_2;
    double nu2_0, nu2_1, nu2_2, f2_0, f2_1, f2_2;
    double previous_2 = INFINITY;
    for (size_t sweep = 1;; sweep++) {
        const double xE2_2_1 = xi2_1 * w128;
        const double xE2_2_0 = xi2_0 * w128;
        const double xE2_2_2 = xi2_2 * w128;
        const double w129 = xE2_2_0 * xE2_2_0 + xE2_2_1 * xE2_2_1 + xE2_2_2 * xE2_2_2;
        double c1_3, c2_5;
        stumpff_12(w129, &c1_3, &c2_5);
        const double w131 = xE2_2_1 * c2_5;
        const double w132 = xE2_2_1 * w131;
        const double w133 = xE2_2_2 * c2_5 * xE2_2_2;
        const double gE2_2_0 = 1.0 - (w132 + w133);
        const double w138 = xE2_2_0 * c2_5;
        const double w139 = xE2_2_1 * w138;
        const double w141 = xE2_2_2 * c1_3;
        const double gE2_2_1 = w139 - w141;
        const double w144 = xE2_2_1 * c1_3;
        const double w145 = xE2_2_2 * w138;
        const double gE2_2_2 = w144 + w145;
        const double E2_2_0 = ge1_0 * gE2_2_0 + ge1_3 * gE2_2_1 + ge1_6 * gE2_2_2;
        const double E2_2_1 = gE2_2_0 * ge1_1 + gE2_2_1 * ge1_4 + gE2_2_2 * ge1_7;
        const double E2_2_2 = gE2_2_0 * ge1_2 + gE2_2_1 * ge1_5 + gE2_2_2 * ge1_8;
        const double Q2_2 = g02 * E2_2_0 + g12 * E2_2_1 + g22 * E2_2_2;
        const double gE2_2_3 = w139 + w141;
        const double w155 = xE2_2_0 * w138;
        const double gE2_2_4 = 1.0 - (w133 + w155);
        const double w156 = xE2_2_2 * w131;
        const double w157 = xE2_2_0 * c1_3;
        const double gE2_2_5 = w156 - w157;
        const double E2_2_3 = ge1_0 * gE2_2_3 + ge1_3 * gE2_2_4 + ge1_6 * gE2_2_5;
        const double gE2_2_6 = w145 - w144;
        const double gE2_2_7 = w156 + w157;
        const double gE2_2_8 = 1.0 - (w132 + w155);
        const double E2_2_6 = ge1_0 * gE2_2_6 + ge1_3 * gE2_2_7 + ge1_6 * gE2_2_8;
        nu2_0 = n2_0 * E2_2_0 + n2_1 * E2_2_3 + n2_2 * E2_2_6;
        const double E2_2_4 = ge1_1 * gE2_2_3 + ge1_4 * gE2_2_4 + ge1_7 * gE2_2_5;
        const double E2_2_7 = ge1_1 * gE2_2_6 + ge1_4 * gE2_2_7 + ge1_7 * gE2_2_8;
        nu2_1 = n2_0 * E2_2_1 + n2_1 * E2_2_4 + n2_2 * E2_2_7;
        const double E2_2_5 = ge1_2 * gE2_2_3 + ge1_5 * gE2_2_4 + ge1_8 * gE2_2_5;
        const double E2_2_8 = ge1_2 * gE2_2_6 + ge1_5 * gE2_2_7 + ge1_8 * gE2_2_8;
        nu2_2 = n2_0 * E2_2_2 + n2_1 * E2_2_5 + n2_2 * E2_2_8;
        const double m2_3_2 = ge1_6 * nu2_0 + ge1_7 * nu2_1 + ge1_8 * nu2_2;
        const double s_m2_2 = m2_4_2 + m2_3_2 * w158;
        const double y2_0 = xi2_0 * w159;
        const double y2_1 = xi2_1 * w159;
        const double y2_2 = xi2_2 * w159;
        const double w160 = y2_0 * y2_0 + y2_1 * y2_1 + y2_2 * y2_2;
        double c2_6, c3_3;
        stumpff_23(w160, &c2_6, &c3_3);
        const double m2_3_1 = ge1_3 * nu2_0 + ge1_4 * nu2_1 + ge1_5 * nu2_2;
        const double s_m2_1 = m2_4_1 + w158 * m2_3_1;
        const double m2_3_0 = ge1_0 * nu2_0 + ge1_1 * nu2_1 + ge1_2 * nu2_2;
        const double s_m2_0 = m2_4_0 + w158 * m2_3_0;
        const double w170 = y2_0 * s_m2_1 - y2_1 * s_m2_0;
        const double w172 = y2_2 * s_m2_0 - s_m2_2 * y2_0;
        const double w173 = s_m2_2 * y2_1 - y2_2 * s_m2_1;
        const double y2_2_0 = xi2_0 * w174;
        const double y2_2_1 = xi2_1 * w174;
        const double y2_2_2 = xi2_2 * w174;
        const double w175 = y2_2_0 * y2_2_0 + y2_2_1 * y2_2_1 + y2_2_2 * y2_2_2;
        double c2_7, c3_4;
        stumpff_23(w175, &c2_7, &c3_4);
        const double w177 = m2_3_1 * y2_2_0 - m2_3_0 * y2_2_1;
        const double w179 = m2_3_0 * y2_2_2 - m2_3_2 * y2_2_0;
        const double w180 = m2_3_2 * y2_2_1 - m2_3_1 * y2_2_2;
        const double M2_2 = s_m2_2 - w170 * c2_6 + (y2_0 * w172 - y2_1 * w173) * c3_3
            + w174 * (m2_3_2 - w177 * c2_7 + (y2_2_0 * w179 - y2_2_1 * w180) * c3_4);
        const double Q2_8 = g02 * E2_2_6 + g12 * E2_2_7 + g22 * E2_2_8;
        const double w181 = 100.0 * Q2_8;
        const double M2_0 = s_m2_0 - w173 * c2_6 + (y2_1 * w170 - y2_2 * w172) * c3_3
            + w174 * (m2_3_0 - w180 * c2_7 + (y2_2_1 * w177 - y2_2_2 * w179) * c3_4);
        const double w182 = 100.0 * Q2_2;
        const double M2_1 = s_m2_1 - w172 * c2_6 + (y2_2 * w173 - y2_0 * w170) * c3_3
            + w174 * (m2_3_1 - w179 * c2_7 + (y2_2_2 * w180 - y2_2_0 * w177) * c3_4);
        const double Q2_5 = g02 * E2_2_3 + g12 * E2_2_4 + g22 * E2_2_5;
        const double w183 = 100.0 * Q2_5;
        const double w184 = M2_0 * w182 + M2_1 * w183 + M2_2 * w181;
        const double Q2_0 = g00 * E2_2_0 + g10 * E2_2_1 + g20 * E2_2_2;
        const double Q2_6 = g00 * E2_2_6 + g10 * E2_2_7 + g20 * E2_2_8;
        const double w185 = 0.9900990099009901 * Q2_6;
        const double w186 = 0.9900990099009901 * Q2_0;
        const double Q2_3 = g00 * E2_2_3 + g10 * E2_2_4 + g20 * E2_2_5;
        const double w187 = 0.9900990099009901 * Q2_3;
        const double w188 = M2_0 * w186 + M2_1 * w187 + M2_2 * w185;
        const double Q2_1 = g01 * E2_2_0 + g11 * E2_2_1 + g21 * E2_2_2;
        const double Q2_7 = g01 * E2_2_6 + g11 * E2_2_7 + g21 * E2_2_8;
        const double Q2_4 = g01 * E2_2_3 + g11 * E2_2_4 + g21 * E2_2_5;
        const double w189 = M2_0 * Q2_1 + M2_1 * Q2_4 + M2_2 * Q2_7;
        const double w190 = 0.5 * M2_0;
        const double w191 = 0.5 * M2_1;
        const double w192 = 0.5 * M2_2;
        const double w193 = Q2_1 * w190 + Q2_4 * w191 + Q2_7 * w192;
        const double w194 = Q2_0 * w190 + Q2_3 * w191 + Q2_6 * w192;
        const double w195 = 0.5 * (Q2_0 * w188 + Q2_1 * w189 + Q2_2 * w184) + Q2_1 * w193
            + w186 * w194;
        const double w196 = Q2_2 * w190 + Q2_5 * w191 + Q2_8 * w192;
        f2_0 = w195 + w182 * w196;
        const double w197 = 0.5 * (Q2_3 * w188 + Q2_4 * w189 + Q2_5 * w184) + Q2_4 * w193
            + w187 * w194;
        f2_1 = w197 + w183 * w196;
        const double w198 = 0.5 * (Q2_6 * w188 + Q2_7 * w189 + Q2_8 * w184) + Q2_7 * w193
            + w185 * w194;
        f2_2 = w198 + w181 * w196;
        const double w199 = w188 * w191 + 0.9900990099009901 * (M2_1 * w194);
        const double w200 = 1.5 + 0.1 * Q2_7 - Q2_8;
        const double w201 = 0.1 * Q2_1 - Q2_2;
        const double w202 = 0.1 * Q2_4 - Q2_5;
        const double w203 = sqrt(w201 * w201 + w202 * w202 + w200 * w200);
        const double w204 = 1.0 / w203 / w203 * (0.5 / w203);
        const double w205 = 2.0 * w202 * w204;
        const double w206 = 1.5 - 0.1 * Q2_7 - Q2_8;
        const double w207 = -0.1 * Q2_1 - Q2_2;
        const double w208 = -0.1 * Q2_4 - Q2_5;
        const double w209 = sqrt(w207 * w207 + w208 * w208 + w206 * w206);
        const double w210 = -1.0 / w209 / w209 * (0.5 / w209);
        const double w211 = 2.0 * w208 * w210;
        const double w212 = 0.1 * w211 - 0.1 * w205 + w189 * w191 + M2_1 * w193;
        const double w213 = w205 + w211 + w184 * w191 + 100.0 * (M2_1 * w196);
        const double w214 = w188 * w192 + 0.9900990099009901 * (M2_2 * w194);
        const double w215 = 2.0 * w200 * w204;
        const double w216 = 2.0 * w206 * w210;
        const double w217 = 0.1 * w216 - 0.1 * w215 + w189 * w192 + M2_2 * w193;
        const double w218 = w215 - 1.0 + w216 + w184 * w192 + 100.0 * (M2_2 * w196);
        const double r2_0 = Q2_6 * w199 + Q2_7 * w212 + Q2_8 * w213 - Q2_3 * w214 - Q2_4 * w217
            - Q2_5 * w218;
        const double w219 = w188 * w190 + 0.9900990099009901 * (M2_0 * w194);
        const double w220 = 2.0 * w201 * w204;
        const double w221 = 2.0 * w207 * w210;
        const double w222 = 0.1 * w221 - 0.1 * w220 + w189 * w190 + M2_0 * w193;
        const double w223 = w220 + w221 + w184 * w190 + 100.0 * (M2_0 * w196);
        const double r2_1 = Q2_0 * w214 - (Q2_6 * w219 + Q2_7 * w222 + Q2_8 * w223) + Q2_1 * w217
            + Q2_2 * w218;
        const double r2_2 = Q2_3 * w219 + Q2_4 * w222 + Q2_5 * w223 - Q2_0 * w199 - Q2_1 * w212
            - Q2_2 * w213;
        const double change_xi2_0 = fabs(f2_0 - xi2_0);
        const double change_xi2_1 = fabs(f2_1 - xi2_1);
        const double change_xi2_2 = fabs(f2_2 - xi2_2);
        const double change_n2_0 = fabs(r2_0 - n2_0);
        const double change_n2_1 = fabs(r2_1 - n2_1);
        const double change_n2_2 = fabs(r2_2 - n2_2);
        const double change = greater(greater(change_xi2_0, greater(change_xi2_1, change_xi2_2)),
            greater(change_n2_0, greater(change_n2_1, change_n2_2)));
        const double scale = greater(greater(1.0, greater(fabs(xi2_0), fabs(xi2_1))),
            greater(greater(fabs(xi2_2), fabs(n2_0)), greater(fabs(n2_1), fabs(n2_2))));
        if (!isfinite(change_xi2_0 + change_xi2_1 + change_xi2_2 + change_n2_0 + change_n2_1
            + change_n2_2)) {
            count_sweeps(statistics, 1, sweep, 1);
            return DIPOLE_VCG_TRIPLE_JUMP_NOT_FINITE;
        }
        if (change <= 5.684341886080802e-14 * scale && (change >= previous_2 || change <= 0.0)) {
            count_sweeps(statistics, 1, sweep, 0);
            break;
        }
        if (sweep == 100) {
            count_sweeps(statistics, 1, sweep, 1);
            return DIPOLE_VCG_TRIPLE_JUMP_NOT_CONVERGED;
        }
        previous_2 = change;
        xi2_0 = f2_0;
        xi2_1 = f2_1;
        xi2_2 = f2_2;
        n2_0 = r2_0;
        n2_1 = r2_1;
        n2_2 = r2_2;
    }
    const double xe2_1 = w158 * f2_1;
    const double xe2_0 = w158 * f2_0;
    const double w224 = xe2_0 * xe2_0;
    const double w225 = xe2_1 * xe2_1;
    const double w226 = w224 + w225;
    const double xe2_2 = w158 * f2_2;
    const double w227 = xe2_2 * xe2_2;
    const double w228 = w226 + w227;
    double c1_4, c2_8;
    stumpff_12(w228, &c1_4, &c2_8);
    const double w230 = xe2_1 * c2_8;
    const double w231 = xe2_1 * w230;
    const double w232 = xe2_2 * c2_8;
    const double w233 = xe2_2 * w232;
    const double w234 = w231 + w233;
    const double ge2_0 = 1.0 - w234;
    const double w235 = ge1_0 * ge2_0;
    const double w236 = xe2_0 * c2_8;
    const double w237 = xe2_1 * w236;
    const double w239 = xe2_2 * c1_4;
    const double ge2_1 = w237 - w239;
    const double w240 = ge1_3 * ge2_1;
    const double w241 = w235 + w240;
    const double w242 = xe2_1 * c1_4;
    const double w243 = xe2_2 * w236;
    const double ge2_2 = w242 + w243;
    const double w244 = ge1_6 * ge2_2;
    const double e2_0 = w241 + w244;
    const double ge2_3 = w237 + w239;
    const double w250 = ge1_0 * ge2_3;
    const double w251 = xe2_0 * w236;
    const double w252 = w233 + w251;
    const double ge2_4 = 1.0 - w252;
    const double w253 = ge1_3 * ge2_4;
    const double w254 = w250 + w253;
    const double w255 = xe2_2 * w230;
    const double w256 = xe2_0 * c1_4;
    const double ge2_5 = w255 - w256;
    const double w257 = ge1_6 * ge2_5;
    const double e2_3 = w254 + w257;
    const double ge2_6 = w243 - w242;
    const double w262 = ge1_0 * ge2_6;
    const double ge2_7 = w255 + w256;
    const double w263 = ge1_3 * ge2_7;
    const double w264 = w262 + w263;
    const double w265 = w231 + w251;
    const double ge2_8 = 1.0 - w265;
    const double w266 = ge1_6 * ge2_8;
    const double e2_6 = w264 + w266;
    const double w269 = ge1_1 * ge2_0;
    const double w270 = ge1_4 * ge2_1;
    const double w271 = w269 + w270;
    const double w272 = ge1_7 * ge2_2;
    const double e2_1 = w271 + w272;
    const double w273 = ge1_1 * ge2_3;
    const double w274 = ge1_4 * ge2_4;
    const double w275 = w273 + w274;
    const double w276 = ge1_7 * ge2_5;
    const double e2_4 = w275 + w276;
    const double w277 = ge1_1 * ge2_6;
    const double w278 = ge1_4 * ge2_7;
    const double w279 = w277 + w278;
    const double w280 = ge1_7 * ge2_8;
    const double e2_7 = w279 + w280;
    const double w281 = ge1_2 * ge2_0;
    const double w282 = ge1_5 * ge2_1;
    const double w283 = w281 + w282;
    const double w284 = ge1_8 * ge2_2;
    const double e2_2 = w283 + w284;
    const double w285 = ge1_2 * ge2_3;
    const double w286 = ge1_5 * ge2_4;
    const double w287 = w285 + w286;
    const double w288 = ge1_8 * ge2_5;
    const double e2_5 = w287 + w288;
    const double w289 = ge1_2 * ge2_6;
    const double w290 = ge1_5 * ge2_7;
    const double w291 = w289 + w290;
    const double w292 = ge1_8 * ge2_8;
    const double e2_8 = w291 + w292;
    const double w293 = nu2_0 * w158;
    const double s_mu_3_0 = s_mu_0 + w293;
    const double w294 = e2_6 * s_mu_3_0;
    const double w295 = nu2_1 * w158;
    const double s_mu_3_1 = s_mu_1 + w295;
    const double w296 = e2_7 * s_mu_3_1;
    const double w297 = w294 + w296;
    const double w298 = nu2_2 * w158;
    const double s_mu_3_2 = s_mu_2 + w298;
    const double w299 = e2_8 * s_mu_3_2;
    const double m3_5_2 = w297 + w299;
    const double w305 = e2_3 * s_mu_3_0;
    const double w306 = e2_4 * s_mu_3_1;
    const double w307 = w305 + w306;
    const double w308 = e2_5 * s_mu_3_2;
    const double m3_5_1 = w307 + w308;
    const double w309 = e2_0 * s_mu_3_0;
    const double w310 = e2_1 * s_mu_3_1;
    const double w311 = w309 + w310;
    const double w312 = e2_2 * s_mu_3_2;
    const double m3_5_0 = w311 + w312;
    /* the equations of xi3, n3: fixed point in xi3_0, xi3_1, xi3_2, n3_0, n3_1, n3_2 */
    double xi3_0 = xi0_0;
    double xi3_1 = xi0_1;
    double xi3_2 = xi0_2;
    double n3_0 = n0_0;
    double n3_1 = n0_1;
    double n3_2 = n0_2;
    double nu3_0, nu3_1, nu3_2, f3_0, f3_1, f3_2;
    double previous_3 = INFINITY;
    for (size_t sweep = 1;; sweep++) {
        const double xE3_3_1 = xi3_1 * w44;
        const double xE3_3_0 = xi3_0 * w44;
        const double xE3_3_2 = xi3_2 * w44;
        const double w245 = xE3_3_0 * xE3_3_0 + xE3_3_1 * xE3_3_1 + xE3_3_2 * xE3_3_2;
        double c1_5, c2_9;
        stumpff_12(w245, &c1_5, &c2_9);
        const double w247 = xE3_3_1 * c2_9;
        const double w248 = xE3_3_1 * w247;
        const double w249 = xE3_3_2 * c2_9 * xE3_3_2;
        const double gE3_3_0 = 1.0 - (w248 + w249);
        const double w258 = xE3_3_0 * c2_9;
        const double w259 = xE3_3_1 * w258;
        const double w261 = xE3_3_2 * c1_5;
        const double gE3_3_1 = w259 - w261;
        const double w267 = xE3_3_1 * c1_5;
        const double w268 = xE3_3_2 * w258;
        const double gE3_3_2 = w267 + w268;
        const double E3_3_0 = e2_0 * gE3_3_0 + e2_3 * gE3_3_1 + e2_6 * gE3_3_2;
        const double E3_3_1 = gE3_3_0 * e2_1 + gE3_3_1 * e2_4 + gE3_3_2 * e2_7;
        const double E3_3_2 = gE3_3_0 * e2_2 + gE3_3_1 * e2_5 + gE3_3_2 * e2_8;
        const double Q3_2 = g02 * E3_3_0 + g12 * E3_3_1 + g22 * E3_3_2;
        const double gE3_3_3 = w259 + w261;
        const double w300 = xE3_3_0 * w258;
        const double gE3_3_4 = 1.0 - (w249 + w300);
        const double w301 = xE3_3_2 * w247;
        const double w302 = xE3_3_0 * c1_5;
        const double gE3_3_5 = w301 - w302;
        const double E3_3_3 = e2_0 * gE3_3_3 + e2_3 * gE3_3_4 + e2_6 * gE3_3_5;
        const double gE3_3_6 = w268 - w267;
        const double gE3_3_7 = w301 + w302;
        const double gE3_3_8 = 1.0 - (w248 + w300);
        const double E3_3_6 = e2_0 * gE3_3_6 + e2_3 * gE3_3_7 + e2_6 * gE3_3_8;
        nu3_0 = n3_0 * E3_3_0 + n3_1 * E3_3_3 + n3_2 * E3_3_6;
        const double E3_3_4 = e2_1 * gE3_3_3 + e2_4 * gE3_3_4 + e2_7 * gE3_3_5;
        const double E3_3_7 = e2_1 * gE3_3_6 + e2_4 * gE3_3_7 + e2_7 * gE3_3_8;
        nu3_1 = n3_0 * E3_3_1 + n3_1 * E3_3_4 + n3_2 * E3_3_7;
        const double E3_3_5 = e2_2 * gE3_3_3 + e2_5 * gE3_3_4 + e2_8 * gE3_3_5;
        const double E3_3_8 = e2_2 * gE3_3_6 + e2_5 * gE3_3_7 + e2_8 * gE3_3_8;
        nu3_2 = n3_0 * E3_3_2 + n3_1 * E3_3_5 + n3_2 * E3_3_8;
        const double m3_4_2 = e2_6 * nu3_0 + e2_7 * nu3_1 + e2_8 * nu3_2;
        const double s_m3_2 = m3_5_2 + w59 * m3_4_2;
        const double y3_0 = xi3_0 * w60;
        const double y3_1 = xi3_1 * w60;
        const double y3_2 = xi3_2 * w60;
        const double w303 = y3_0 * y3_0 + y3_1 * y3_1 + y3_2 * y3_2;
        double c2_10, c3_5;
        stumpff_23(w303, &c2_10, &c3_5);
        const double m3_4_1 = e2_3 * nu3_0 + e2_4 * nu3_1 + e2_5 * nu3_2;
        const double s_m3_1 = m3_5_1 + w59 * m3_4_1;
        const double m3_4_0 = e2_0 * nu3_0 + e2_1 * nu3_1 + e2_2 * nu3_2;
        const double s_m3_0 = m3_5_0 + w59 * m3_4_0;
        const double w313 = y3_0 * s_m3_1 - y3_1 * s_m3_0;
        const double w315 = y3_2 * s_m3_0 - s_m3_2 * y3_0;
        const double w316 = s_m3_2 * y3_1 - y3_2 * s_m3_1;
        const double y3_2_0 = xi3_0 * w67;
        const double y3_2_1 = xi3_1 * w67;
        const double y3_2_2 = xi3_2 * w67;
        const double w317 = y3_2_0 * y3_2_0 + y3_2_1 * y3_2_1 + y3_2_2 * y3_2_2;
        double c2_11, c3_6;
        stumpff_23(w317, &c2_11, &c3_6);
        const double w319 = m3_4_1 * y3_2_0 - m3_4_0 * y3_2_1;
        const double w321 = m3_4_0 * y3_2_2 - m3_4_2 * y3_2_0;
        const double w322 = m3_4_2 * y3_2_1 - m3_4_1 * y3_2_2;
        const double M3_2 = s_m3_2 - w313 * c2_10 + (y3_0 * w315 - y3_1 * w316) * c3_5
            + w67 * (m3_4_2 - w319 * c2_11 + (y3_2_0 * w321 - y3_2_1 * w322) * c3_6);
        const double Q3_8 = g02 * E3_3_6 + g12 * E3_3_7 + g22 * E3_3_8;
        const double w323 = 100.0 * Q3_8;
        const double M3_0 = s_m3_0 - w316 * c2_10 + (y3_1 * w313 - y3_2 * w315) * c3_5
            + w67 * (m3_4_0 - w322 * c2_11 + (y3_2_1 * w319 - y3_2_2 * w321) * c3_6);
        const double w324 = 100.0 * Q3_2;
        const double M3_1 = s_m3_1 - w315 * c2_10 + (y3_2 * w316 - y3_0 * w313) * c3_5
            + w67 * (m3_4_1 - w321 * c2_11 + (y3_2_2 * w322 - y3_2_0 * w319) * c3_6);
        const double Q3_5 = g02 * E3_3_3 + g12 * E3_3_4 + g22 * E3_3_5;
        const double w325 = 100.0 * Q3_5;
        const double w326 = M3_0 * w324 + M3_1 * w325 + M3_2 * w323;
        const double Q3_0 = g00 * E3_3_0 + g10 * E3_3_1 + g20 * E3_3_2;
        const double Q3_6 = g00 * E3_3_6 + g10 * E3_3_7 + g20 * E3_3_8;
        const double w327 = 0.9900990099009901 * Q3_6;
        const double w328 = 0.9900990099009901 * Q3_0;
        const double Q3_3 = g00 * E3_3_3 + g10 * E3_3_4 + g20 * E3_3_5;
        const double w329 = 0.9900990099009901 * Q3_3;
        const double w330 = M3_0 * w328 + M3_1 * w329 + M3_2 * w327;
        const double Q3_1 = g01 * E3_3_0 + g11 * E3_3_1 + g21 * E3_3_2;
        const double Q3_7 = g01 * E3_3_6 + g11 * E3_3_7 + g21 * E3_3_8;
        const double Q3_4 = g01 * E3_3_3 + g11 * E3_3_4 + g21 * E3_3_5;
        const double w331 = M3_0 * Q3_1 + M3_1 * Q3_4 + M3_2 * Q3_7;
        const double w332 = 0.5 * M3_0;
        const double w333 = 0.5 * M3_1;
        const double w334 = 0.5 * M3_2;
        const double w335 = Q3_1 * w332 + Q3_4 * w333 + Q3_7 * w334;
        const double w336 = Q3_0 * w332 + Q3_3 * w333 + Q3_6 * w334;
        const double w337 = 0.5 * (Q3_0 * w330 + Q3_1 * w331 + Q3_2 * w326) + Q3_1 * w335
            + w328 * w336;
        const double w338 = Q3_2 * w332 + Q3_5 * w333 + Q3_8 * w334;
        f3_0 = w337 + w324 * w338;
        const double w339 = 0.5 * (Q3_3 * w330 + Q3_4 * w331 + Q3_5 * w326) + Q3_4 * w335
            + w329 * w336;
        f3_1 = w339 + w325 * w338;
        const double w340 = 0.5 * (Q3_6 * w330 + Q3_7 * w331 + Q3_8 * w326) + Q3_7 * w335
            + w327 * w336;
        f3_2 = w340 + w323 * w338;
        const double w341 = w330 * w333 + 0.9900990099009901 * (M3_1 * w336);
        const double w342 = 1.5 + 0.1 * Q3_7 - Q3_8;
        const double w343 = 0.1 * Q3_1 - Q3_2;
        const double w344 = 0.1 * Q3_4 - Q3_5;
        const double w345 = sqrt(w343 * w343 + w344 * w344 + w342 * w342);
        const double w346 = 1.0 / w345 / w345 * (0.5 / w345);
        const double w347 = 2.0 * w344 * w346;
        const double w348 = 1.5 - 0.1 * Q3_7 - Q3_8;
        const double w349 = -0.1 * Q3_1 - Q3_2;
        const double w350 = -0.1 * Q3_4 - Q3_5;
        const double w351 = sqrt(w349 * w349 + w350 * w350 + w348 * w348);
        const double w352 = -1.0 / w351 / w351 * (0.5 / w351);
        const double w353 = 2.0 * w350 * w352;
        const double w354 = 0.1 * w353 - 0.1 * w347 + w331 * w333 + M3_1 * w335;
        const double w355 = w347 + w353 + w326 * w333 + 100.0 * (M3_1 * w338);
        const double w356 = w330 * w334 + 0.9900990099009901 * (M3_2 * w336);
        const double w357 = 2.0 * w342 * w346;
        const double w358 = 2.0 * w348 * w352;
        const double w359 = 0.1 * w358 - 0.1 * w357 + w331 * w334 + M3_2 * w335;
        const double w360 = w357 - 1.0 + w358 + w326 * w334 + 100.0 * (M3_2 * w338);
        const double r3_0 = Q3_6 * w341 + Q3_7 * w354 + Q3_8 * w355 - Q3_3 * w356 - Q3_4 * w359
            - Q3_5 * w360;
        const double w361 = w330 * w332 + 0.9900990099009901 * (M3_0 * w336);
        const double w362 = 2.0 * w343 * w346;
        const double w363 = 2.0 * w349 * w352;
        const double w364 = 0.1 * w363 - 0.1 * w362 + w331 * w332 + M3_0 * w335;
        const double w365 = w362 + w363 + w326 * w332 + 100.0 * (M3_0 * w338);
        const double r3_1 = Q3_0 * w356 - (Q3_6 * w361 + Q3_7 * w364 + Q3_8 * w365) + Q3_1 * w359
            + Q3_2 * w360;
        const double r3_2 = Q3_3 * w361 + Q3_4 * w364 + Q3_5 * w365 - Q3_0 * w341 - Q3_1 * w354
            - Q3_2 * w355;
        const double change_xi3_0 = fabs(f3_0 - xi3_0);
        const double change_xi3_1 = fabs(f3_1 - xi3_1);
        const double change_xi3_2 = fabs(f3_2 - xi3_2);
        const double change_n3_0 = fabs(r3_0 - n3_0);
        const double change_n3_1 = fabs(r3_1 - n3_1);
        const double change_n3_2 = fabs(r3_2 - n3_2);
        const double change = greater(greater(change_xi3_0, greater(change_xi3_1, change_xi3_2)),
            greater(change_n3_0, greater(change_n3_1, change_n3_2)));
        const double scale = greater(greater(1.0, greater(fabs(xi3_0), fabs(xi3_1))),
            greater(greater(fabs(xi3_2), fabs(n3_0)), greater(fabs(n3_1), fabs(n3_2))));
        if (!isfinite(change_xi3_0 + change_xi3_1 + change_xi3_2 + change_n3_0 + change_n3_1
            + change_n3_2)) {
            count_sweeps(statistics, 2, sweep, 1);
            return DIPOLE_VCG_TRIPLE_JUMP_NOT_FINITE;
        }
        if (change <= 5.684341886080802e-14 * scale && (change >= previous_3 || change <= 0.0)) {
            count_sweeps(statistics, 2, sweep, 0);
            break;
        }
        if (sweep == 100) {
            count_sweeps(statistics, 2, sweep, 1);
            return DIPOLE_VCG_TRIPLE_JUMP_NOT_CONVERGED;
        }
        previous_3 = change;
        xi3_0 = f3_0;
        xi3_1 = f3_1;
        xi3_2 = f3_2;
        n3_0 = r3_0;
        n3_1 = r3_1;
        n3_2 = r3_2;
    }
    const double xe3_1 = w59 * f3_1;
    const double xe3_0 = w59 * f3_0;
    const double xe3_2 = w59 * f3_2;
    const double w366 = xe3_0 * xe3_0 + xe3_1 * xe3_1 + xe3_2 * xe3_2;
    double c1_6, c2_12;
    stumpff_12(w366, &c1_6, &c2_12);
    const double w368 = xe3_1 * c2_12;
    const double w369 = xe3_1 * w368;
    const double w370 = xe3_2 * c2_12 * xe3_2;
    const double ge3_0 = 1.0 - (w369 + w370);
    const double w371 = xe3_0 * c2_12;
    const double w372 = xe3_1 * w371;
    const double w374 = xe3_2 * c1_6;
    const double ge3_1 = w372 - w374;
    const double w375 = xe3_1 * c1_6;
    const double w376 = xe3_2 * w371;
    const double ge3_2 = w375 + w376;
    const double e3_0 = e2_0 * ge3_0 + e2_3 * ge3_1 + e2_6 * ge3_2;
    const double e3_1 = e2_1 * ge3_0 + e2_4 * ge3_1 + e2_7 * ge3_2;
    const double e3_2 = e2_2 * ge3_0 + e2_5 * ge3_1 + e2_8 * ge3_2;
    const double ge3_3 = w372 + w374;
    const double w377 = xe3_0 * w371;
    const double ge3_4 = 1.0 - (w370 + w377);
    const double w378 = xe3_2 * w368;
    const double w379 = xe3_0 * c1_6;
    const double ge3_5 = w378 - w379;
    const double e3_3 = e2_0 * ge3_3 + e2_3 * ge3_4 + e2_6 * ge3_5;
    const double e3_4 = e2_1 * ge3_3 + e2_4 * ge3_4 + e2_7 * ge3_5;
    const double e3_5 = e2_2 * ge3_3 + e2_5 * ge3_4 + e2_8 * ge3_5;
    const double ge3_6 = w376 - w375;
    const double ge3_7 = w378 + w379;
    const double ge3_8 = 1.0 - (w369 + w377);
    const double e3_6 = e2_0 * ge3_6 + e2_3 * ge3_7 + e2_6 * ge3_8;
    const double e3_7 = e2_1 * ge3_6 + e2_4 * ge3_7 + e2_7 * ge3_8;
    const double e3_8 = e2_2 * ge3_6 + e2_5 * ge3_7 + e2_8 * ge3_8;
    const double mubar_0 = mu0 + w59 * (nu1_0 + nu3_0) + w293;
    const double mubar_1 = mu1 + w59 * (nu1_1 + nu3_1) + w295;
    const double mubar_2 = mu2 + w59 * (nu1_2 + nu3_2) + w298;
    const double new_g00 = g00 * e3_0 + g10 * e3_1 + g20 * e3_2;
    const double new_g01 = g01 * e3_0 + g11 * e3_1 + g21 * e3_2;
    const double new_g02 = g02 * e3_0 + g12 * e3_1 + g22 * e3_2;
    const double new_g10 = g00 * e3_3 + g10 * e3_4 + g20 * e3_5;
    const double new_g11 = g01 * e3_3 + g11 * e3_4 + g21 * e3_5;
    const double new_g12 = g02 * e3_3 + g12 * e3_4 + g22 * e3_5;
    const double new_g20 = g00 * e3_6 + g10 * e3_7 + g20 * e3_8;
    const double new_g21 = g01 * e3_6 + g11 * e3_7 + g21 * e3_8;
    const double new_g22 = g02 * e3_6 + g12 * e3_7 + g22 * e3_8;
    const double new_mu0 = e3_0 * mubar_0 + e3_1 * mubar_1 + e3_2 * mubar_2;
    const double new_mu1 = e3_3 * mubar_0 + e3_4 * mubar_1 + e3_5 * mubar_2;
    const double new_mu2 = e3_6 * mubar_0 + e3_7 * mubar_1 + e3_8 * mubar_2;
    if (!(isfinite(new_g00) && isfinite(new_g01) && isfinite(new_g02) && isfinite(new_g10)
        && isfinite(new_g11) && isfinite(new_g12) && isfinite(new_g20) && isfinite(new_g21)
        && isfinite(new_g22) && isfinite(new_mu0) && isfinite(new_mu1) && isfinite(new_mu2))) {
        return DIPOLE_VCG_TRIPLE_JUMP_NOT_FINITE;
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
    return DIPOLE_VCG_TRIPLE_JUMP_OK;
}

int dipole_vcg_triple_jump_step(double state[static 12], double h,
    dipole_vcg_triple_jump_statistics *statistics)
{
    return advance(state, h, statistics);
}

int dipole_vcg_triple_jump_run(double state[static 12], double h, size_t steps,
    double *trajectory, size_t stride, dipole_vcg_triple_jump_statistics *statistics,
    size_t *completed)
{
    int status = DIPOLE_VCG_TRIPLE_JUMP_OK;
    size_t step = 0;
    double *row = stride > 0 ? trajectory : NULL;
    if (row != NULL) {
        memcpy(row, state, 12 * sizeof *state);
    }
    while (step < steps) {
        status = advance(state, h, statistics);
        if (status != DIPOLE_VCG_TRIPLE_JUMP_OK) {
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
