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
 * operations: 178 add, 259 mul, 3 div, 2 sqrt, 3 stumpff_12 a step
 *             124 add, 191 mul, 3 div, 2 sqrt, 1 stumpff_12, 2 stumpff_23 a sweep of the equations
 *             of xi1, n1
 *             148 add, 227 mul, 3 div, 2 sqrt, 1 stumpff_12, 2 stumpff_23 a sweep of the equations
 *             of xi2, n2
 *             148 add, 227 mul, 3 div, 2 sqrt, 1 stumpff_12, 2 stumpff_23 a sweep of the equations
 *             of xi3, n3
 * stack:      at most 5440 bytes, without what the mathematical library takes
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
    const double w1 = 0.9900990099009901 * (g00 * mu0 + g10 * mu1 + g20 * mu2);
    const double w2 = g01 * mu0 + g11 * mu1 + g21 * mu2;
    const double w3 = 100.0 * (g02 * mu0 + g12 * mu1 + g22 * mu2);
    const double xi0_0 = g00 * w1 + g01 * w2 + g02 * w3;
    const double xi0_1 = g10 * w1 + g11 * w2 + g12 * w3;
    const double xi0_2 = g20 * w1 + g21 * w2 + g22 * w3;
    const double w4 = mu1 * w1;
    const double w5 = 1.5 + 0.1 * g21 - g22;
    const double w6 = 0.1 * g01 - g02;
    const double w7 = 0.1 * g11 - g12;
    const double w8 = 1.0 / sqrt(w6 * w6 + w7 * w7 + w5 * w5);
    const double w9 = w8 * w8 * (0.5 * w8);
    const double w10 = 2.0 * w7 * w9;
    const double w11 = 1.5 - 0.1 * g21 - g22;
    const double w12 = -0.1 * g01 - g02;
    const double w13 = -0.1 * g11 - g12;
    const double w14 = sqrt(w12 * w12 + w13 * w13 + w11 * w11);
    const double w15 = 1.0 / w14;
    const double w16 = -1.0 / w14 * w15 * (0.5 * w15);
    const double w17 = 2.0 * w13 * w16;
    const double w18 = 0.1 * w17 - 0.1 * w10 + mu1 * w2;
    const double w19 = w10 + w17 + mu1 * w3;
    const double w20 = mu2 * w1;
    const double w21 = 2.0 * w5 * w9;
    const double w22 = 2.0 * w11 * w16;
    const double w23 = 0.1 * w22 - 0.1 * w21 + mu2 * w2;
    const double w24 = w21 - 1.0 + w22 + mu2 * w3;
    const double n0_0 = g20 * w4 + g21 * w18 + g22 * w19 - g10 * w20 - g11 * w23 - g12 * w24;
    const double w25 = mu0 * w1;
    const double w26 = 2.0 * w6 * w9;
    const double w27 = 2.0 * w12 * w16;
    const double w28 = 0.1 * w27 - 0.1 * w26 + mu0 * w2;
    const double w29 = w26 + w27 + mu0 * w3;
    const double n0_1 = g00 * w20 - (g20 * w25 + g21 * w28 + g22 * w29) + g01 * w23 + g02 * w24;
    const double n0_2 = g10 * w25 + g11 * w28 + g12 * w29 - g00 * w4 - g01 * w18 - g02 * w19;
    const double w30 = 0.6756035959798288 * h;
    const double w45 = 1.3512071919596575 * h;
    const double w46 = -1.3512071919596575 * h;
    const double w53 = -0.6756035959798288 * h;
    /* the equations of xi1, n1: fixed point in xi1_0, xi1_1, xi1_2, n1_0, n1_1, n1_2 */
    double xi1_0 = xi0_0;
    double xi1_1 = xi0_1;
    double xi1_2 = xi0_2;
    double n1_0 = n0_0;
    double n1_1 = n0_1;
    double n1_2 = n0_2;
    double nu1_2, s_mu_2, nu1_1, s_mu_1, nu1_0, s_mu_0, f1_0, f1_1, f1_2;
    double previous_1 = 0.0;
    for (size_t sweep = 1;; sweep++) {
        const double xE1_1_1 = xi1_1 * w30;
        const double xE1_1_0 = xi1_0 * w30;
        const double xE1_1_2 = xi1_2 * w30;
        const double w31 = xE1_1_0 * xE1_1_0 + xE1_1_1 * xE1_1_1 + xE1_1_2 * xE1_1_2;
        double c1_1, c2_1;
        stumpff_12(w31, &c1_1, &c2_1);
        const double w33 = xE1_1_1 * c2_1;
        const double w34 = xE1_1_1 * w33;
        const double w35 = xE1_1_2 * c2_1 * xE1_1_2;
        const double gE1_1_0 = 1.0 - (w34 + w35);
        const double w36 = xE1_1_0 * c2_1;
        const double w37 = xE1_1_1 * w36;
        const double w39 = xE1_1_2 * c1_1;
        const double gE1_1_1 = w37 - w39;
        const double w40 = xE1_1_1 * c1_1;
        const double w41 = xE1_1_2 * w36;
        const double gE1_1_2 = w40 + w41;
        const double Q1_0 = g00 * gE1_1_0 + g10 * gE1_1_1 + g20 * gE1_1_2;
        const double gE1_1_6 = w41 - w40;
        const double w42 = xE1_1_0 * c1_1;
        const double w43 = xE1_1_2 * w33;
        const double gE1_1_7 = w42 + w43;
        const double w44 = xE1_1_0 * w36;
        const double gE1_1_8 = 1.0 - (w34 + w44);
        const double Q1_6 = g00 * gE1_1_6 + g10 * gE1_1_7 + g20 * gE1_1_8;
        const double gE1_1_5 = w43 - w42;
        nu1_2 = n1_0 * gE1_1_2 + n1_1 * gE1_1_5 + n1_2 * gE1_1_8;
        s_mu_2 = mu2 + nu1_2 * w45;
        const double y1_0 = xi1_0 * w46;
        const double y1_1 = xi1_1 * w46;
        const double y1_2 = xi1_2 * w46;
        const double w47 = y1_0 * y1_0 + y1_1 * y1_1 + y1_2 * y1_2;
        double c2_2, c3_1;
        stumpff_23(w47, &c2_2, &c3_1);
        const double gE1_1_4 = 1.0 - (w35 + w44);
        nu1_1 = n1_0 * gE1_1_1 + n1_1 * gE1_1_4 + n1_2 * gE1_1_7;
        s_mu_1 = mu1 + w45 * nu1_1;
        const double gE1_1_3 = w37 + w39;
        nu1_0 = n1_0 * gE1_1_0 + n1_1 * gE1_1_3 + n1_2 * gE1_1_6;
        s_mu_0 = mu0 + w45 * nu1_0;
        const double w49 = y1_0 * s_mu_1 - y1_1 * s_mu_0;
        const double w51 = y1_2 * s_mu_0 - s_mu_2 * y1_0;
        const double w52 = s_mu_2 * y1_1 - y1_2 * s_mu_1;
        const double y1_2_0 = xi1_0 * w53;
        const double y1_2_1 = xi1_1 * w53;
        const double y1_2_2 = xi1_2 * w53;
        const double w54 = y1_2_0 * y1_2_0 + y1_2_1 * y1_2_1 + y1_2_2 * y1_2_2;
        double c2_3, c3_2;
        stumpff_23(w54, &c2_3, &c3_2);
        const double w56 = nu1_1 * y1_2_0 - nu1_0 * y1_2_1;
        const double w58 = nu1_0 * y1_2_2 - nu1_2 * y1_2_0;
        const double w59 = nu1_2 * y1_2_1 - nu1_1 * y1_2_2;
        const double M1_2 = s_mu_2 - w49 * c2_2 + (y1_0 * w51 - y1_1 * w52) * c3_1
            + w53 * (nu1_2 - w56 * c2_3 + (y1_2_0 * w58 - y1_2_1 * w59) * c3_2);
        const double M1_0 = s_mu_0 - w52 * c2_2 + (y1_1 * w49 - y1_2 * w51) * c3_1
            + w53 * (nu1_0 - w59 * c2_3 + (y1_2_1 * w56 - y1_2_2 * w58) * c3_2);
        const double Q1_3 = g00 * gE1_1_3 + g10 * gE1_1_4 + g20 * gE1_1_5;
        const double M1_1 = s_mu_1 - w51 * c2_2 + (y1_2 * w52 - y1_0 * w49) * c3_1
            + w53 * (nu1_1 - w58 * c2_3 + (y1_2_2 * w59 - y1_2_0 * w56) * c3_2);
        const double w60 = 0.9900990099009901 * (Q1_0 * M1_0 + Q1_3 * M1_1 + Q1_6 * M1_2);
        const double Q1_1 = g01 * gE1_1_0 + g11 * gE1_1_1 + g21 * gE1_1_2;
        const double Q1_7 = g01 * gE1_1_6 + g11 * gE1_1_7 + g21 * gE1_1_8;
        const double Q1_4 = g01 * gE1_1_3 + g11 * gE1_1_4 + g21 * gE1_1_5;
        const double w61 = M1_0 * Q1_1 + M1_1 * Q1_4 + M1_2 * Q1_7;
        const double Q1_2 = g02 * gE1_1_0 + g12 * gE1_1_1 + g22 * gE1_1_2;
        const double Q1_8 = g02 * gE1_1_6 + g12 * gE1_1_7 + g22 * gE1_1_8;
        const double Q1_5 = g02 * gE1_1_3 + g12 * gE1_1_4 + g22 * gE1_1_5;
        const double w62 = 100.0 * (M1_0 * Q1_2 + M1_1 * Q1_5 + M1_2 * Q1_8);
        f1_0 = Q1_0 * w60 + Q1_1 * w61 + Q1_2 * w62;
        f1_1 = Q1_3 * w60 + Q1_4 * w61 + Q1_5 * w62;
        f1_2 = Q1_6 * w60 + Q1_7 * w61 + Q1_8 * w62;
        const double w63 = M1_1 * w60;
        const double w64 = 1.5 + 0.1 * Q1_7 - Q1_8;
        const double w65 = 0.1 * Q1_1 - Q1_2;
        const double w66 = 0.1 * Q1_4 - Q1_5;
        const double w67 = 1.0 / sqrt(w65 * w65 + w66 * w66 + w64 * w64);
        const double w68 = w67 * w67 * (0.5 * w67);
        const double w69 = 2.0 * w66 * w68;
        const double w70 = 1.5 - 0.1 * Q1_7 - Q1_8;
        const double w71 = -0.1 * Q1_1 - Q1_2;
        const double w72 = -0.1 * Q1_4 - Q1_5;
        const double w73 = sqrt(w71 * w71 + w72 * w72 + w70 * w70);
        const double w74 = 1.0 / w73;
        const double w75 = -1.0 / w73 * w74 * (0.5 * w74);
        const double w76 = 2.0 * w72 * w75;
        const double w77 = 0.1 * w76 - 0.1 * w69 + M1_1 * w61;
        const double w78 = w69 + w76 + M1_1 * w62;
        const double w79 = M1_2 * w60;
        const double w80 = 2.0 * w64 * w68;
        const double w81 = 2.0 * w70 * w75;
        const double w82 = 0.1 * w81 - 0.1 * w80 + M1_2 * w61;
        const double w83 = w80 - 1.0 + w81 + M1_2 * w62;
        const double r1_0 = Q1_6 * w63 + Q1_7 * w77 + Q1_8 * w78 - Q1_3 * w79 - Q1_4 * w82
            - Q1_5 * w83;
        const double w84 = M1_0 * w60;
        const double w85 = 2.0 * w65 * w68;
        const double w86 = 2.0 * w71 * w75;
        const double w87 = 0.1 * w86 - 0.1 * w85 + M1_0 * w61;
        const double w88 = w85 + w86 + M1_0 * w62;
        const double r1_1 = Q1_0 * w79 - (Q1_6 * w84 + Q1_7 * w87 + Q1_8 * w88) + Q1_1 * w82
            + Q1_2 * w83;
        const double r1_2 = Q1_3 * w84 + Q1_4 * w87 + Q1_5 * w88 - Q1_0 * w63 - Q1_1 * w77
            - Q1_2 * w78;
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
        const int still = previous_1 > 0.0 && change >= previous_1;
        const int close = change <= 3.552713678800501e-15 * scale
            && change * change <= 1.1102230246251565e-16 * scale * previous_1;
        if (close || (still && change <= 5.684341886080802e-14 * scale)) {
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
    const double xe1_1 = w45 * f1_1;
    const double xe1_0 = w45 * f1_0;
    const double w89 = xe1_0 * xe1_0;
    const double w90 = xe1_1 * xe1_1;
    const double w91 = w89 + w90;
    const double xe1_2 = w45 * f1_2;
    const double w92 = xe1_2 * xe1_2;
    const double w93 = w91 + w92;
    double c1_2, c2_4;
    stumpff_12(w93, &c1_2, &c2_4);
    const double w95 = xe1_1 * c2_4;
    const double w96 = xe1_1 * w95;
    const double w97 = xe1_2 * c2_4;
    const double w98 = xe1_2 * w97;
    const double w99 = w96 + w98;
    const double ge1_0 = 1.0 - w99;
    const double w100 = -0.8512071919596577 * h;
    const double w107 = xe1_2 * c1_2;
    const double w108 = xe1_0 * c2_4;
    const double w109 = xe1_1 * w108;
    const double ge1_3 = w107 + w109;
    const double w114 = xe1_2 * w108;
    const double w115 = xe1_1 * c1_2;
    const double ge1_6 = w114 - w115;
    const double ge1_1 = w109 - w107;
    const double w118 = xe1_0 * w108;
    const double w119 = w98 + w118;
    const double ge1_4 = 1.0 - w119;
    const double w120 = xe1_0 * c1_2;
    const double w121 = xe1_2 * w95;
    const double ge1_7 = w120 + w121;
    const double ge1_2 = w114 + w115;
    const double ge1_5 = w121 - w120;
    const double w122 = w96 + w118;
    const double ge1_8 = 1.0 - w122;
    const double w126 = s_mu_0 * ge1_6;
    const double w127 = s_mu_1 * ge1_7;
    const double w128 = w126 + w127;
    const double w129 = s_mu_2 * ge1_8;
    const double m2_4_2 = w128 + w129;
    const double w130 = -1.7024143839193153 * h;
    const double w131 = 1.7024143839193153 * h;
    const double w134 = s_mu_0 * ge1_3;
    const double w135 = s_mu_1 * ge1_4;
    const double w136 = w134 + w135;
    const double w137 = s_mu_2 * ge1_5;
    const double m2_4_1 = w136 + w137;
    const double w138 = s_mu_0 * ge1_0;
    const double w139 = s_mu_1 * ge1_1;
    const double w140 = w138 + w139;
    const double w141 = s_mu_2 * ge1_2;
    const double m2_4_0 = w140 + w141;
    const double w146 = 0.8512071919596577 * h;
    /* the equations of xi2, n2: fixed point in xi2_0, xi2_1, xi2_2, n2_0, n2_1, n2_2 */
    double xi2_0 = xi0_0;
    double xi2_1 = xi0_1;
    double xi2_2 = xi0_2;
    double n2_0 = n0_0;
    double n2_1 = n0_1;
    double n2_2 = n0_2;
    double nu2_0, nu2_1, nu2_2, f2_0, f2_1, f2_2;
    double previous_2 = 0.0;
    for (size_t sweep = 1;; sweep++) {
        const double xE2_2_1 = xi2_1 * w100;
        const double xE2_2_0 = xi2_0 * w100;
        const double xE2_2_2 = xi2_2 * w100;
        const double w101 = xE2_2_0 * xE2_2_0 + xE2_2_1 * xE2_2_1 + xE2_2_2 * xE2_2_2;
        double c1_3, c2_5;
        stumpff_12(w101, &c1_3, &c2_5);
        const double w103 = xE2_2_1 * c2_5;
        const double w104 = xE2_2_1 * w103;
        const double w105 = xE2_2_2 * c2_5 * xE2_2_2;
        const double gE2_2_0 = 1.0 - (w104 + w105);
        const double w110 = xE2_2_0 * c2_5;
        const double w111 = xE2_2_1 * w110;
        const double w113 = xE2_2_2 * c1_3;
        const double gE2_2_1 = w111 - w113;
        const double w116 = xE2_2_1 * c1_3;
        const double w117 = xE2_2_2 * w110;
        const double gE2_2_2 = w116 + w117;
        const double E2_2_0 = ge1_0 * gE2_2_0 + ge1_3 * gE2_2_1 + ge1_6 * gE2_2_2;
        const double E2_2_1 = gE2_2_0 * ge1_1 + gE2_2_1 * ge1_4 + gE2_2_2 * ge1_7;
        const double E2_2_2 = gE2_2_0 * ge1_2 + gE2_2_1 * ge1_5 + gE2_2_2 * ge1_8;
        const double Q2_0 = g00 * E2_2_0 + g10 * E2_2_1 + g20 * E2_2_2;
        const double gE2_2_6 = w117 - w116;
        const double w123 = xE2_2_0 * c1_3;
        const double w124 = xE2_2_2 * w103;
        const double gE2_2_7 = w123 + w124;
        const double w125 = xE2_2_0 * w110;
        const double gE2_2_8 = 1.0 - (w104 + w125);
        const double E2_2_6 = ge1_0 * gE2_2_6 + ge1_3 * gE2_2_7 + ge1_6 * gE2_2_8;
        const double E2_2_7 = ge1_1 * gE2_2_6 + ge1_4 * gE2_2_7 + ge1_7 * gE2_2_8;
        const double E2_2_8 = ge1_2 * gE2_2_6 + ge1_5 * gE2_2_7 + ge1_8 * gE2_2_8;
        const double Q2_6 = g00 * E2_2_6 + g10 * E2_2_7 + g20 * E2_2_8;
        const double gE2_2_3 = w111 + w113;
        const double gE2_2_4 = 1.0 - (w105 + w125);
        const double gE2_2_5 = w124 - w123;
        const double E2_2_3 = ge1_0 * gE2_2_3 + ge1_3 * gE2_2_4 + ge1_6 * gE2_2_5;
        nu2_0 = n2_0 * E2_2_0 + n2_1 * E2_2_3 + n2_2 * E2_2_6;
        const double E2_2_4 = ge1_1 * gE2_2_3 + ge1_4 * gE2_2_4 + ge1_7 * gE2_2_5;
        nu2_1 = n2_0 * E2_2_1 + n2_1 * E2_2_4 + n2_2 * E2_2_7;
        const double E2_2_5 = ge1_2 * gE2_2_3 + ge1_5 * gE2_2_4 + ge1_8 * gE2_2_5;
        nu2_2 = n2_0 * E2_2_2 + n2_1 * E2_2_5 + n2_2 * E2_2_8;
        const double m2_3_2 = ge1_6 * nu2_0 + ge1_7 * nu2_1 + ge1_8 * nu2_2;
        const double s_m2_2 = m2_4_2 + m2_3_2 * w130;
        const double y2_0 = xi2_0 * w131;
        const double y2_1 = xi2_1 * w131;
        const double y2_2 = xi2_2 * w131;
        const double w132 = y2_0 * y2_0 + y2_1 * y2_1 + y2_2 * y2_2;
        double c2_6, c3_3;
        stumpff_23(w132, &c2_6, &c3_3);
        const double m2_3_1 = ge1_3 * nu2_0 + ge1_4 * nu2_1 + ge1_5 * nu2_2;
        const double s_m2_1 = m2_4_1 + w130 * m2_3_1;
        const double m2_3_0 = ge1_0 * nu2_0 + ge1_1 * nu2_1 + ge1_2 * nu2_2;
        const double s_m2_0 = m2_4_0 + w130 * m2_3_0;
        const double w142 = y2_0 * s_m2_1 - y2_1 * s_m2_0;
        const double w144 = y2_2 * s_m2_0 - s_m2_2 * y2_0;
        const double w145 = s_m2_2 * y2_1 - y2_2 * s_m2_1;
        const double y2_2_0 = xi2_0 * w146;
        const double y2_2_1 = xi2_1 * w146;
        const double y2_2_2 = xi2_2 * w146;
        const double w147 = y2_2_0 * y2_2_0 + y2_2_1 * y2_2_1 + y2_2_2 * y2_2_2;
        double c2_7, c3_4;
        stumpff_23(w147, &c2_7, &c3_4);
        const double w149 = m2_3_1 * y2_2_0 - m2_3_0 * y2_2_1;
        const double w151 = m2_3_0 * y2_2_2 - m2_3_2 * y2_2_0;
        const double w152 = m2_3_2 * y2_2_1 - m2_3_1 * y2_2_2;
        const double M2_2 = s_m2_2 - w142 * c2_6 + (y2_0 * w144 - y2_1 * w145) * c3_3
            + w146 * (m2_3_2 - w149 * c2_7 + (y2_2_0 * w151 - y2_2_1 * w152) * c3_4);
        const double M2_0 = s_m2_0 - w145 * c2_6 + (y2_1 * w142 - y2_2 * w144) * c3_3
            + w146 * (m2_3_0 - w152 * c2_7 + (y2_2_1 * w149 - y2_2_2 * w151) * c3_4);
        const double Q2_3 = g00 * E2_2_3 + g10 * E2_2_4 + g20 * E2_2_5;
        const double M2_1 = s_m2_1 - w144 * c2_6 + (y2_2 * w145 - y2_0 * w142) * c3_3
            + w146 * (m2_3_1 - w151 * c2_7 + (y2_2_2 * w152 - y2_2_0 * w149) * c3_4);
        const double w153 = 0.9900990099009901 * (Q2_0 * M2_0 + Q2_3 * M2_1 + Q2_6 * M2_2);
        const double Q2_1 = g01 * E2_2_0 + g11 * E2_2_1 + g21 * E2_2_2;
        const double Q2_7 = g01 * E2_2_6 + g11 * E2_2_7 + g21 * E2_2_8;
        const double Q2_4 = g01 * E2_2_3 + g11 * E2_2_4 + g21 * E2_2_5;
        const double w154 = M2_0 * Q2_1 + M2_1 * Q2_4 + M2_2 * Q2_7;
        const double Q2_2 = g02 * E2_2_0 + g12 * E2_2_1 + g22 * E2_2_2;
        const double Q2_8 = g02 * E2_2_6 + g12 * E2_2_7 + g22 * E2_2_8;
        const double Q2_5 = g02 * E2_2_3 + g12 * E2_2_4 + g22 * E2_2_5;
        const double w155 = 100.0 * (M2_0 * Q2_2 + M2_1 * Q2_5 + M2_2 * Q2_8);
        f2_0 = Q2_0 * w153 + Q2_1 * w154 + Q2_2 * w155;
        f2_1 = Q2_3 * w153 + Q2_4 * w154 + Q2_5 * w155;
        f2_2 = Q2_6 * w153 + Q2_7 * w154 + Q2_8 * w155;
        const double w156 = M2_1 * w153;
        const double w157 = 1.5 + 0.1 * Q2_7 - Q2_8;
        const double w158 = 0.1 * Q2_1 - Q2_2;
        const double w159 = 0.1 * Q2_4 - Q2_5;
        const double w160 = 1.0 / sqrt(w158 * w158 + w159 * w159 + w157 * w157);
        const double w161 = w160 * w160 * (0.5 * w160);
        const double w162 = 2.0 * w159 * w161;
        const double w163 = 1.5 - 0.1 * Q2_7 - Q2_8;
        const double w164 = -0.1 * Q2_1 - Q2_2;
        const double w165 = -0.1 * Q2_4 - Q2_5;
        const double w166 = sqrt(w164 * w164 + w165 * w165 + w163 * w163);
        const double w167 = 1.0 / w166;
        const double w168 = -1.0 / w166 * w167 * (0.5 * w167);
        const double w169 = 2.0 * w165 * w168;
        const double w170 = 0.1 * w169 - 0.1 * w162 + M2_1 * w154;
        const double w171 = w162 + w169 + M2_1 * w155;
        const double w172 = M2_2 * w153;
        const double w173 = 2.0 * w157 * w161;
        const double w174 = 2.0 * w163 * w168;
        const double w175 = 0.1 * w174 - 0.1 * w173 + M2_2 * w154;
        const double w176 = w173 - 1.0 + w174 + M2_2 * w155;
        const double r2_0 = Q2_6 * w156 + Q2_7 * w170 + Q2_8 * w171 - Q2_3 * w172 - Q2_4 * w175
            - Q2_5 * w176;
        const double w177 = M2_0 * w153;
        const double w178 = 2.0 * w158 * w161;
        const double w179 = 2.0 * w164 * w168;
        const double w180 = 0.1 * w179 - 0.1 * w178 + M2_0 * w154;
        const double w181 = w178 + w179 + M2_0 * w155;
        const double r2_1 = Q2_0 * w172 - (Q2_6 * w177 + Q2_7 * w180 + Q2_8 * w181) + Q2_1 * w175
            + Q2_2 * w176;
        const double r2_2 = Q2_3 * w177 + Q2_4 * w180 + Q2_5 * w181 - Q2_0 * w156 - Q2_1 * w170
            - Q2_2 * w171;
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
        const int still = previous_2 > 0.0 && change >= previous_2;
        const int close = change <= 3.552713678800501e-15 * scale
            && change * change <= 1.1102230246251565e-16 * scale * previous_2;
        if (close || (still && change <= 5.684341886080802e-14 * scale)) {
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
    const double xe2_1 = w130 * f2_1;
    const double xe2_0 = w130 * f2_0;
    const double w182 = xe2_0 * xe2_0;
    const double w183 = xe2_1 * xe2_1;
    const double w184 = w182 + w183;
    const double xe2_2 = w130 * f2_2;
    const double w185 = xe2_2 * xe2_2;
    const double w186 = w184 + w185;
    double c1_4, c2_8;
    stumpff_12(w186, &c1_4, &c2_8);
    const double w188 = xe2_1 * c2_8;
    const double w189 = xe2_1 * w188;
    const double w190 = xe2_2 * c2_8;
    const double w191 = xe2_2 * w190;
    const double w192 = w189 + w191;
    const double ge2_0 = 1.0 - w192;
    const double w193 = ge1_0 * ge2_0;
    const double w194 = xe2_0 * c2_8;
    const double w195 = xe2_1 * w194;
    const double w197 = xe2_2 * c1_4;
    const double ge2_1 = w195 - w197;
    const double w198 = ge1_3 * ge2_1;
    const double w199 = w193 + w198;
    const double w200 = xe2_1 * c1_4;
    const double w201 = xe2_2 * w194;
    const double ge2_2 = w200 + w201;
    const double w202 = ge1_6 * ge2_2;
    const double e2_0 = w199 + w202;
    const double ge2_3 = w195 + w197;
    const double w208 = ge1_0 * ge2_3;
    const double w209 = xe2_0 * w194;
    const double w210 = w191 + w209;
    const double ge2_4 = 1.0 - w210;
    const double w211 = ge1_3 * ge2_4;
    const double w212 = w208 + w211;
    const double w213 = xe2_2 * w188;
    const double w214 = xe2_0 * c1_4;
    const double ge2_5 = w213 - w214;
    const double w215 = ge1_6 * ge2_5;
    const double e2_3 = w212 + w215;
    const double ge2_6 = w201 - w200;
    const double w220 = ge1_0 * ge2_6;
    const double ge2_7 = w213 + w214;
    const double w221 = ge1_3 * ge2_7;
    const double w222 = w220 + w221;
    const double w223 = w189 + w209;
    const double ge2_8 = 1.0 - w223;
    const double w224 = ge1_6 * ge2_8;
    const double e2_6 = w222 + w224;
    const double w227 = ge1_1 * ge2_0;
    const double w228 = ge1_4 * ge2_1;
    const double w229 = w227 + w228;
    const double w230 = ge1_7 * ge2_2;
    const double e2_1 = w229 + w230;
    const double w231 = ge1_1 * ge2_3;
    const double w232 = ge1_4 * ge2_4;
    const double w233 = w231 + w232;
    const double w234 = ge1_7 * ge2_5;
    const double e2_4 = w233 + w234;
    const double w235 = ge1_1 * ge2_6;
    const double w236 = ge1_4 * ge2_7;
    const double w237 = w235 + w236;
    const double w238 = ge1_7 * ge2_8;
    const double e2_7 = w237 + w238;
    const double w239 = ge1_2 * ge2_0;
    const double w240 = ge1_5 * ge2_1;
    const double w241 = w239 + w240;
    const double w242 = ge1_8 * ge2_2;
    const double e2_2 = w241 + w242;
    const double w243 = ge1_2 * ge2_3;
    const double w244 = ge1_5 * ge2_4;
    const double w245 = w243 + w244;
    const double w246 = ge1_8 * ge2_5;
    const double e2_5 = w245 + w246;
    const double w247 = ge1_2 * ge2_6;
    const double w248 = ge1_5 * ge2_7;
    const double w249 = w247 + w248;
    const double w250 = ge1_8 * ge2_8;
    const double e2_8 = w249 + w250;
    const double w254 = nu2_0 * w130;
    const double s_mu_3_0 = s_mu_0 + w254;
    const double w255 = e2_6 * s_mu_3_0;
    const double w256 = nu2_1 * w130;
    const double s_mu_3_1 = s_mu_1 + w256;
    const double w257 = e2_7 * s_mu_3_1;
    const double w258 = w255 + w257;
    const double w259 = nu2_2 * w130;
    const double s_mu_3_2 = s_mu_2 + w259;
    const double w260 = e2_8 * s_mu_3_2;
    const double m3_5_2 = w258 + w260;
    const double w263 = e2_3 * s_mu_3_0;
    const double w264 = e2_4 * s_mu_3_1;
    const double w265 = w263 + w264;
    const double w266 = e2_5 * s_mu_3_2;
    const double m3_5_1 = w265 + w266;
    const double w267 = e2_0 * s_mu_3_0;
    const double w268 = e2_1 * s_mu_3_1;
    const double w269 = w267 + w268;
    const double w270 = e2_2 * s_mu_3_2;
    const double m3_5_0 = w269 + w270;
    /* the equations of xi3, n3: fixed point in xi3_0, xi3_1, xi3_2, n3_0, n3_1, n3_2 */
    double xi3_0 = xi0_0;
    double xi3_1 = xi0_1;
    double xi3_2 = xi0_2;
    double n3_0 = n0_0;
    double n3_1 = n0_1;
    double n3_2 = n0_2;
    double nu3_0, nu3_1, nu3_2, f3_0, f3_1, f3_2;
    double previous_3 = 0.0;
    for (size_t sweep = 1;; sweep++) {
        const double xE3_3_1 = xi3_1 * w30;
        const double xE3_3_0 = xi3_0 * w30;
        const double xE3_3_2 = xi3_2 * w30;
        const double w203 = xE3_3_0 * xE3_3_0 + xE3_3_1 * xE3_3_1 + xE3_3_2 * xE3_3_2;
        double c1_5, c2_9;
        stumpff_12(w203, &c1_5, &c2_9);
        const double w205 = xE3_3_1 * c2_9;
        const double w206 = xE3_3_1 * w205;
        const double w207 = xE3_3_2 * c2_9 * xE3_3_2;
        const double gE3_3_0 = 1.0 - (w206 + w207);
        const double w216 = xE3_3_0 * c2_9;
        const double w217 = xE3_3_1 * w216;
        const double w219 = xE3_3_2 * c1_5;
        const double gE3_3_1 = w217 - w219;
        const double w225 = xE3_3_1 * c1_5;
        const double w226 = xE3_3_2 * w216;
        const double gE3_3_2 = w225 + w226;
        const double E3_3_0 = e2_0 * gE3_3_0 + e2_3 * gE3_3_1 + e2_6 * gE3_3_2;
        const double E3_3_1 = gE3_3_0 * e2_1 + gE3_3_1 * e2_4 + gE3_3_2 * e2_7;
        const double E3_3_2 = gE3_3_0 * e2_2 + gE3_3_1 * e2_5 + gE3_3_2 * e2_8;
        const double Q3_0 = g00 * E3_3_0 + g10 * E3_3_1 + g20 * E3_3_2;
        const double gE3_3_6 = w226 - w225;
        const double w251 = xE3_3_0 * c1_5;
        const double w252 = xE3_3_2 * w205;
        const double gE3_3_7 = w251 + w252;
        const double w253 = xE3_3_0 * w216;
        const double gE3_3_8 = 1.0 - (w206 + w253);
        const double E3_3_6 = e2_0 * gE3_3_6 + e2_3 * gE3_3_7 + e2_6 * gE3_3_8;
        const double E3_3_7 = e2_1 * gE3_3_6 + e2_4 * gE3_3_7 + e2_7 * gE3_3_8;
        const double E3_3_8 = e2_2 * gE3_3_6 + e2_5 * gE3_3_7 + e2_8 * gE3_3_8;
        const double Q3_6 = g00 * E3_3_6 + g10 * E3_3_7 + g20 * E3_3_8;
        const double gE3_3_3 = w217 + w219;
        const double gE3_3_4 = 1.0 - (w207 + w253);
        const double gE3_3_5 = w252 - w251;
        const double E3_3_3 = e2_0 * gE3_3_3 + e2_3 * gE3_3_4 + e2_6 * gE3_3_5;
        nu3_0 = n3_0 * E3_3_0 + n3_1 * E3_3_3 + n3_2 * E3_3_6;
        const double E3_3_4 = e2_1 * gE3_3_3 + e2_4 * gE3_3_4 + e2_7 * gE3_3_5;
        nu3_1 = n3_0 * E3_3_1 + n3_1 * E3_3_4 + n3_2 * E3_3_7;
        const double E3_3_5 = e2_2 * gE3_3_3 + e2_5 * gE3_3_4 + e2_8 * gE3_3_5;
        nu3_2 = n3_0 * E3_3_2 + n3_1 * E3_3_5 + n3_2 * E3_3_8;
        const double m3_4_2 = e2_6 * nu3_0 + e2_7 * nu3_1 + e2_8 * nu3_2;
        const double s_m3_2 = m3_5_2 + w45 * m3_4_2;
        const double y3_0 = xi3_0 * w46;
        const double y3_1 = xi3_1 * w46;
        const double y3_2 = xi3_2 * w46;
        const double w261 = y3_0 * y3_0 + y3_1 * y3_1 + y3_2 * y3_2;
        double c2_10, c3_5;
        stumpff_23(w261, &c2_10, &c3_5);
        const double m3_4_1 = e2_3 * nu3_0 + e2_4 * nu3_1 + e2_5 * nu3_2;
        const double s_m3_1 = m3_5_1 + w45 * m3_4_1;
        const double m3_4_0 = e2_0 * nu3_0 + e2_1 * nu3_1 + e2_2 * nu3_2;
        const double s_m3_0 = m3_5_0 + w45 * m3_4_0;
        const double w271 = y3_0 * s_m3_1 - y3_1 * s_m3_0;
        const double w273 = y3_2 * s_m3_0 - s_m3_2 * y3_0;
        const double w274 = s_m3_2 * y3_1 - y3_2 * s_m3_1;
        const double y3_2_0 = xi3_0 * w53;
        const double y3_2_1 = xi3_1 * w53;
        const double y3_2_2 = xi3_2 * w53;
        const double w275 = y3_2_0 * y3_2_0 + y3_2_1 * y3_2_1 + y3_2_2 * y3_2_2;
        double c2_11, c3_6;
        stumpff_23(w275, &c2_11, &c3_6);
        const double w277 = m3_4_1 * y3_2_0 - m3_4_0 * y3_2_1;
        const double w279 = m3_4_0 * y3_2_2 - m3_4_2 * y3_2_0;
        const double w280 = m3_4_2 * y3_2_1 - m3_4_1 * y3_2_2;
        const double M3_2 = s_m3_2 - w271 * c2_10 + (y3_0 * w273 - y3_1 * w274) * c3_5
            + w53 * (m3_4_2 - w277 * c2_11 + (y3_2_0 * w279 - y3_2_1 * w280) * c3_6);
        const double M3_0 = s_m3_0 - w274 * c2_10 + (y3_1 * w271 - y3_2 * w273) * c3_5
            + w53 * (m3_4_0 - w280 * c2_11 + (y3_2_1 * w277 - y3_2_2 * w279) * c3_6);
        const double Q3_3 = g00 * E3_3_3 + g10 * E3_3_4 + g20 * E3_3_5;
        const double M3_1 = s_m3_1 - w273 * c2_10 + (y3_2 * w274 - y3_0 * w271) * c3_5
            + w53 * (m3_4_1 - w279 * c2_11 + (y3_2_2 * w280 - y3_2_0 * w277) * c3_6);
        const double w281 = 0.9900990099009901 * (Q3_0 * M3_0 + Q3_3 * M3_1 + Q3_6 * M3_2);
        const double Q3_1 = g01 * E3_3_0 + g11 * E3_3_1 + g21 * E3_3_2;
        const double Q3_7 = g01 * E3_3_6 + g11 * E3_3_7 + g21 * E3_3_8;
        const double Q3_4 = g01 * E3_3_3 + g11 * E3_3_4 + g21 * E3_3_5;
        const double w282 = M3_0 * Q3_1 + M3_1 * Q3_4 + M3_2 * Q3_7;
        const double Q3_2 = g02 * E3_3_0 + g12 * E3_3_1 + g22 * E3_3_2;
        const double Q3_8 = g02 * E3_3_6 + g12 * E3_3_7 + g22 * E3_3_8;
        const double Q3_5 = g02 * E3_3_3 + g12 * E3_3_4 + g22 * E3_3_5;
        const double w283 = 100.0 * (M3_0 * Q3_2 + M3_1 * Q3_5 + M3_2 * Q3_8);
        f3_0 = Q3_0 * w281 + Q3_1 * w282 + Q3_2 * w283;
        f3_1 = Q3_3 * w281 + Q3_4 * w282 + Q3_5 * w283;
        f3_2 = Q3_6 * w281 + Q3_7 * w282 + Q3_8 * w283;
        const double w284 = M3_1 * w281;
        const double w285 = 1.5 + 0.1 * Q3_7 - Q3_8;
        const double w286 = 0.1 * Q3_1 - Q3_2;
        const double w287 = 0.1 * Q3_4 - Q3_5;
        const double w288 = 1.0 / sqrt(w286 * w286 + w287 * w287 + w285 * w285);
        const double w289 = w288 * w288 * (0.5 * w288);
        const double w290 = 2.0 * w287 * w289;
        const double w291 = 1.5 - 0.1 * Q3_7 - Q3_8;
        const double w292 = -0.1 * Q3_1 - Q3_2;
        const double w293 = -0.1 * Q3_4 - Q3_5;
        const double w294 = sqrt(w292 * w292 + w293 * w293 + w291 * w291);
        const double w295 = 1.0 / w294;
        const double w296 = -1.0 / w294 * w295 * (0.5 * w295);
        const double w297 = 2.0 * w293 * w296;
        const double w298 = 0.1 * w297 - 0.1 * w290 + M3_1 * w282;
        const double w299 = w290 + w297 + M3_1 * w283;
        const double w300 = M3_2 * w281;
        const double w301 = 2.0 * w285 * w289;
        const double w302 = 2.0 * w291 * w296;
        const double w303 = 0.1 * w302 - 0.1 * w301 + M3_2 * w282;
        const double w304 = w301 - 1.0 + w302 + M3_2 * w283;
        const double r3_0 = Q3_6 * w284 + Q3_7 * w298 + Q3_8 * w299 - Q3_3 * w300 - Q3_4 * w303
            - Q3_5 * w304;
        const double w305 = M3_0 * w281;
        const double w306 = 2.0 * w286 * w289;
        const double w307 = 2.0 * w292 * w296;
        const double w308 = 0.1 * w307 - 0.1 * w306 + M3_0 * w282;
        const double w309 = w306 + w307 + M3_0 * w283;
        const double r3_1 = Q3_0 * w300 - (Q3_6 * w305 + Q3_7 * w308 + Q3_8 * w309) + Q3_1 * w303
            + Q3_2 * w304;
        const double r3_2 = Q3_3 * w305 + Q3_4 * w308 + Q3_5 * w309 - Q3_0 * w284 - Q3_1 * w298
            - Q3_2 * w299;
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
        const int still = previous_3 > 0.0 && change >= previous_3;
        const int close = change <= 3.552713678800501e-15 * scale
            && change * change <= 1.1102230246251565e-16 * scale * previous_3;
        if (close || (still && change <= 5.684341886080802e-14 * scale)) {
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
    const double xe3_1 = w45 * f3_1;
    const double xe3_0 = w45 * f3_0;
    const double xe3_2 = w45 * f3_2;
    const double w310 = xe3_0 * xe3_0 + xe3_1 * xe3_1 + xe3_2 * xe3_2;
    double c1_6, c2_12;
    stumpff_12(w310, &c1_6, &c2_12);
    const double w312 = xe3_1 * c2_12;
    const double w313 = xe3_1 * w312;
    const double w314 = xe3_2 * c2_12 * xe3_2;
    const double ge3_0 = 1.0 - (w313 + w314);
    const double w315 = xe3_0 * c2_12;
    const double w316 = xe3_1 * w315;
    const double w318 = xe3_2 * c1_6;
    const double ge3_1 = w316 - w318;
    const double w319 = xe3_1 * c1_6;
    const double w320 = xe3_2 * w315;
    const double ge3_2 = w319 + w320;
    const double e3_0 = e2_0 * ge3_0 + e2_3 * ge3_1 + e2_6 * ge3_2;
    const double e3_1 = e2_1 * ge3_0 + e2_4 * ge3_1 + e2_7 * ge3_2;
    const double e3_2 = e2_2 * ge3_0 + e2_5 * ge3_1 + e2_8 * ge3_2;
    const double ge3_3 = w316 + w318;
    const double w321 = xe3_0 * w315;
    const double ge3_4 = 1.0 - (w314 + w321);
    const double w322 = xe3_2 * w312;
    const double w323 = xe3_0 * c1_6;
    const double ge3_5 = w322 - w323;
    const double e3_3 = e2_0 * ge3_3 + e2_3 * ge3_4 + e2_6 * ge3_5;
    const double e3_4 = e2_1 * ge3_3 + e2_4 * ge3_4 + e2_7 * ge3_5;
    const double e3_5 = e2_2 * ge3_3 + e2_5 * ge3_4 + e2_8 * ge3_5;
    const double ge3_6 = w320 - w319;
    const double ge3_7 = w322 + w323;
    const double ge3_8 = 1.0 - (w313 + w321);
    const double e3_6 = e2_0 * ge3_6 + e2_3 * ge3_7 + e2_6 * ge3_8;
    const double e3_7 = e2_1 * ge3_6 + e2_4 * ge3_7 + e2_7 * ge3_8;
    const double e3_8 = e2_2 * ge3_6 + e2_5 * ge3_7 + e2_8 * ge3_8;
    const double mubar_0 = mu0 + w45 * (nu1_0 + nu3_0) + w254;
    const double mubar_1 = mu1 + w45 * (nu1_1 + nu3_1) + w256;
    const double mubar_2 = mu2 + w45 * (nu1_2 + nu3_2) + w259;
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
