/*
 * Dipole on a stick, T*SO(3) (thesis section 3.6): one step by vcg:midpoint
 *
 * method:     family vcg, tableau midpoint
 * source:     Table 3.2a of Bogfjellmo and Marthinsen
 * order:      2, certificate: exact (every order condition up to it is zero in exact arithmetic)
 * scene:      Dipole on a stick, T*SO(3) (thesis section 3.6), group SO(3)
 * state:      [0..8] q: element of SO(3), row by row
 *             [9..11] mu: right-trivialised momentum in the dual algebra of SO(3)
 * left out:   3 Adtinv, 2 mul (zeros)
 *             1 identity (sharing)
 *             1 identity (dead code)
 *             1 dexpt (factors)
 *             1 lin (sharing)
 *             parameters, folded: beta = 1
 *             the time: the scene does not depend on it
 * operations: 90 add, 139 mul, 3 div, 2 sqrt, 1 stumpff_12 a step
 *             124 add, 191 mul, 3 div, 2 sqrt, 1 stumpff_12, 2 stumpff_23 a sweep of the equations
 *             of xi1, n1
 * stack:      at most 2112 bytes, without what the mathematical library takes
 * made by:    orderconds emit dipole --method vcg:midpoint --target c -o .
 * version:    orderconds 0.1.0
 *
 * Build: cc -std=c11 -O2 -ffp-contract=off -c dipole_vcg_midpoint.c
 * Use:
 *
 *     #include "dipole_vcg_midpoint.h"
 *     #include <stdio.h>
 *
 *     int main(void)
 *     {
 *         double state[12] = {1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.01, 0.0};
 *         size_t completed;
 *         const int status = dipole_vcg_midpoint_run(state, 0.005, 100, NULL, 0, NULL, &completed);
 *         printf("status %d after %zu steps\n", status, completed);
 *         for (int i = 0; i < 12; i++) {
 *             printf("%.17g\n", state[i]);
 *         }
 *         return status;
 *     }
 */
#include "dipole_vcg_midpoint.h"

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

static void count_sweeps(dipole_vcg_midpoint_statistics *statistics, size_t block, size_t sweeps, int failed)
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
    dipole_vcg_midpoint_statistics *statistics)
{
    if (!isfinite(h)) {
        return DIPOLE_VCG_MIDPOINT_BAD_STEP;
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
    const double w30 = 0.5 * h;
    const double w54 = -0.5 * h;
    /* the equations of xi1, n1: fixed point in xi1_0, xi1_1, xi1_2, n1_0, n1_1, n1_2 */
    double xi1_0 = g00 * w1 + g01 * w2 + g02 * w3;
    double xi1_1 = g10 * w1 + g11 * w2 + g12 * w3;
    double xi1_2 = g20 * w1 + g21 * w2 + g22 * w3;
    double n1_0 = n0_0;
    double n1_1 = n0_1;
    double n1_2 = n0_2;
    double s_mu_2, s_mu_0, s_mu_1, f1_0, f1_1, f1_2;
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
        const double nu1_2 = n1_0 * gE1_1_2 + n1_1 * gE1_1_5 + n1_2 * gE1_1_8;
        s_mu_2 = mu2 + h * nu1_2;
        const double w45 = h * xi1_0;
        const double w46 = h * xi1_1;
        const double w47 = h * xi1_2;
        const double w48 = w45 * w45 + w46 * w46 + w47 * w47;
        double c2_2, c3_1;
        stumpff_23(w48, &c2_2, &c3_1);
        const double gE1_1_3 = w37 + w39;
        const double nu1_0 = n1_0 * gE1_1_0 + n1_1 * gE1_1_3 + n1_2 * gE1_1_6;
        s_mu_0 = mu0 + h * nu1_0;
        const double gE1_1_4 = 1.0 - (w35 + w44);
        const double nu1_1 = n1_0 * gE1_1_1 + n1_1 * gE1_1_4 + n1_2 * gE1_1_7;
        s_mu_1 = mu1 + h * nu1_1;
        const double w50 = w46 * s_mu_0 - w45 * s_mu_1;
        const double w52 = w47 * s_mu_1 - s_mu_2 * w46;
        const double w53 = s_mu_2 * w45 - w47 * s_mu_0;
        const double y1_2_0 = xi1_0 * w54;
        const double y1_2_1 = xi1_1 * w54;
        const double y1_2_2 = xi1_2 * w54;
        const double w55 = y1_2_0 * y1_2_0 + y1_2_1 * y1_2_1 + y1_2_2 * y1_2_2;
        double c2_3, c3_2;
        stumpff_23(w55, &c2_3, &c3_2);
        const double w57 = nu1_1 * y1_2_0 - nu1_0 * y1_2_1;
        const double w59 = nu1_0 * y1_2_2 - nu1_2 * y1_2_0;
        const double w60 = nu1_2 * y1_2_1 - nu1_1 * y1_2_2;
        const double M1_2 = s_mu_2 - w50 * c2_2 + (w46 * w52 - w45 * w53) * c3_1
            + w54 * (nu1_2 - w57 * c2_3 + (y1_2_0 * w59 - y1_2_1 * w60) * c3_2);
        const double M1_0 = s_mu_0 - w52 * c2_2 + (w47 * w53 - w46 * w50) * c3_1
            + w54 * (nu1_0 - w60 * c2_3 + (y1_2_1 * w57 - y1_2_2 * w59) * c3_2);
        const double Q1_3 = g00 * gE1_1_3 + g10 * gE1_1_4 + g20 * gE1_1_5;
        const double M1_1 = s_mu_1 - w53 * c2_2 + (w45 * w50 - w47 * w52) * c3_1
            + w54 * (nu1_1 - w59 * c2_3 + (y1_2_2 * w60 - y1_2_0 * w57) * c3_2);
        const double w61 = 0.9900990099009901 * (Q1_0 * M1_0 + Q1_3 * M1_1 + Q1_6 * M1_2);
        const double Q1_1 = g01 * gE1_1_0 + g11 * gE1_1_1 + g21 * gE1_1_2;
        const double Q1_7 = g01 * gE1_1_6 + g11 * gE1_1_7 + g21 * gE1_1_8;
        const double Q1_4 = g01 * gE1_1_3 + g11 * gE1_1_4 + g21 * gE1_1_5;
        const double w62 = M1_0 * Q1_1 + M1_1 * Q1_4 + M1_2 * Q1_7;
        const double Q1_2 = g02 * gE1_1_0 + g12 * gE1_1_1 + g22 * gE1_1_2;
        const double Q1_8 = g02 * gE1_1_6 + g12 * gE1_1_7 + g22 * gE1_1_8;
        const double Q1_5 = g02 * gE1_1_3 + g12 * gE1_1_4 + g22 * gE1_1_5;
        const double w63 = 100.0 * (M1_0 * Q1_2 + M1_1 * Q1_5 + M1_2 * Q1_8);
        f1_0 = Q1_0 * w61 + Q1_1 * w62 + Q1_2 * w63;
        f1_1 = Q1_3 * w61 + Q1_4 * w62 + Q1_5 * w63;
        f1_2 = Q1_6 * w61 + Q1_7 * w62 + Q1_8 * w63;
        const double w64 = M1_1 * w61;
        const double w65 = 1.5 + 0.1 * Q1_7 - Q1_8;
        const double w66 = 0.1 * Q1_1 - Q1_2;
        const double w67 = 0.1 * Q1_4 - Q1_5;
        const double w68 = 1.0 / sqrt(w66 * w66 + w67 * w67 + w65 * w65);
        const double w69 = w68 * w68 * (0.5 * w68);
        const double w70 = 2.0 * w67 * w69;
        const double w71 = 1.5 - 0.1 * Q1_7 - Q1_8;
        const double w72 = -0.1 * Q1_1 - Q1_2;
        const double w73 = -0.1 * Q1_4 - Q1_5;
        const double w74 = sqrt(w72 * w72 + w73 * w73 + w71 * w71);
        const double w75 = 1.0 / w74;
        const double w76 = -1.0 / w74 * w75 * (0.5 * w75);
        const double w77 = 2.0 * w73 * w76;
        const double w78 = 0.1 * w77 - 0.1 * w70 + M1_1 * w62;
        const double w79 = w70 + w77 + M1_1 * w63;
        const double w80 = M1_2 * w61;
        const double w81 = 2.0 * w65 * w69;
        const double w82 = 2.0 * w71 * w76;
        const double w83 = 0.1 * w82 - 0.1 * w81 + M1_2 * w62;
        const double w84 = w81 - 1.0 + w82 + M1_2 * w63;
        const double r1_0 = Q1_6 * w64 + Q1_7 * w78 + Q1_8 * w79 - Q1_3 * w80 - Q1_4 * w83
            - Q1_5 * w84;
        const double w85 = M1_0 * w61;
        const double w86 = 2.0 * w66 * w69;
        const double w87 = 2.0 * w72 * w76;
        const double w88 = 0.1 * w87 - 0.1 * w86 + M1_0 * w62;
        const double w89 = w86 + w87 + M1_0 * w63;
        const double r1_1 = Q1_0 * w80 - (Q1_6 * w85 + Q1_7 * w88 + Q1_8 * w89) + Q1_1 * w83
            + Q1_2 * w84;
        const double r1_2 = Q1_3 * w85 + Q1_4 * w88 + Q1_5 * w89 - Q1_0 * w64 - Q1_1 * w78
            - Q1_2 * w79;
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
            return DIPOLE_VCG_MIDPOINT_NOT_FINITE;
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
            return DIPOLE_VCG_MIDPOINT_NOT_CONVERGED;
        }
        previous_1 = change;
        xi1_0 = f1_0;
        xi1_1 = f1_1;
        xi1_2 = f1_2;
        n1_0 = r1_0;
        n1_1 = r1_1;
        n1_2 = r1_2;
    }
    const double xe1_1 = h * f1_1;
    const double xe1_0 = h * f1_0;
    const double xe1_2 = h * f1_2;
    const double w90 = xe1_0 * xe1_0 + xe1_1 * xe1_1 + xe1_2 * xe1_2;
    double c1_2, c2_4;
    stumpff_12(w90, &c1_2, &c2_4);
    const double w92 = xe1_1 * c2_4;
    const double w93 = xe1_1 * w92;
    const double w94 = xe1_2 * c2_4 * xe1_2;
    const double ge1_0 = 1.0 - (w93 + w94);
    const double w95 = xe1_0 * c2_4;
    const double w96 = xe1_1 * w95;
    const double w98 = xe1_2 * c1_2;
    const double ge1_1 = w96 - w98;
    const double w99 = xe1_1 * c1_2;
    const double w100 = xe1_2 * w95;
    const double ge1_2 = w99 + w100;
    const double ge1_3 = w96 + w98;
    const double w101 = xe1_0 * w95;
    const double ge1_4 = 1.0 - (w94 + w101);
    const double w102 = xe1_2 * w92;
    const double w103 = xe1_0 * c1_2;
    const double ge1_5 = w102 - w103;
    const double ge1_6 = w100 - w99;
    const double ge1_7 = w102 + w103;
    const double ge1_8 = 1.0 - (w93 + w101);
    const double new_g00 = g00 * ge1_0 + g10 * ge1_1 + g20 * ge1_2;
    const double new_g01 = g01 * ge1_0 + g11 * ge1_1 + g21 * ge1_2;
    const double new_g02 = g02 * ge1_0 + g12 * ge1_1 + g22 * ge1_2;
    const double new_g10 = g00 * ge1_3 + g10 * ge1_4 + g20 * ge1_5;
    const double new_g11 = g01 * ge1_3 + g11 * ge1_4 + g21 * ge1_5;
    const double new_g12 = g02 * ge1_3 + g12 * ge1_4 + g22 * ge1_5;
    const double new_g20 = g00 * ge1_6 + g10 * ge1_7 + g20 * ge1_8;
    const double new_g21 = g01 * ge1_6 + g11 * ge1_7 + g21 * ge1_8;
    const double new_g22 = g02 * ge1_6 + g12 * ge1_7 + g22 * ge1_8;
    const double new_mu0 = s_mu_0 * ge1_0 + s_mu_1 * ge1_1 + s_mu_2 * ge1_2;
    const double new_mu1 = s_mu_0 * ge1_3 + s_mu_1 * ge1_4 + s_mu_2 * ge1_5;
    const double new_mu2 = s_mu_0 * ge1_6 + s_mu_1 * ge1_7 + s_mu_2 * ge1_8;
    if (!(isfinite(new_g00) && isfinite(new_g01) && isfinite(new_g02) && isfinite(new_g10)
        && isfinite(new_g11) && isfinite(new_g12) && isfinite(new_g20) && isfinite(new_g21)
        && isfinite(new_g22) && isfinite(new_mu0) && isfinite(new_mu1) && isfinite(new_mu2))) {
        return DIPOLE_VCG_MIDPOINT_NOT_FINITE;
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
    return DIPOLE_VCG_MIDPOINT_OK;
}

int dipole_vcg_midpoint_step(double state[static 12], double h,
    dipole_vcg_midpoint_statistics *statistics)
{
    return advance(state, h, statistics);
}

int dipole_vcg_midpoint_run(double state[static 12], double h, size_t steps,
    double *trajectory, size_t stride, dipole_vcg_midpoint_statistics *statistics,
    size_t *completed)
{
    int status = DIPOLE_VCG_MIDPOINT_OK;
    size_t step = 0;
    double *row = stride > 0 ? trajectory : NULL;
    if (row != NULL) {
        memcpy(row, state, 12 * sizeof *state);
    }
    while (step < steps) {
        status = advance(state, h, statistics);
        if (status != DIPOLE_VCG_MIDPOINT_OK) {
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
