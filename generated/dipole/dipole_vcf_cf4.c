/*
 * Dipole on a stick, T*SO(3) (thesis section 3.6): one step by vcf:cf4
 *
 * method:     family vcf, tableau cf4
 * source:     Celledoni, Marthinsen and Owren 2003; H. Marthinsen, thesis, Section 2.2.1
 * order:      4, certificate: exact (every order condition up to it is zero in exact arithmetic)
 * scene:      Dipole on a stick, T*SO(3) (thesis section 3.6), group SO(3)
 * state:      [0..8] q: element of SO(3), row by row
 *             [9..11] mu: right-trivialised momentum in the dual algebra of SO(3)
 * left out:   1 Adt, 23 Adtinv, 5 mul (zeros)
 *             16 Adtinv, 31 dexpt, 1 exp, 4 identity, 2 lin (sharing)
 *             1 identity (dead code)
 *             1 dexpt (factors)
 *             parameters, folded: beta = 1
 *             the time: the scene does not depend on it
 * operations: 129 add, 185 mul, 3 div, 2 sqrt, 1 stumpff_12 a step
 *             642 add, 890 mul, 9 div, 6 sqrt, 4 stumpff_12, 5 stumpff_23 a sweep of the equations
 *             of xi1, xi2, xi3, xi4, n1, n2, n3, n4
 * stack:      at most 5248 bytes, without what the mathematical library takes
 * made by:    orderconds emit dipole --method vcf:cf4 --target c -o .
 * version:    orderconds 0.1.0
 *
 * Build: cc -std=c11 -O2 -ffp-contract=off -c dipole_vcf_cf4.c
 * Use:
 *
 *     #include "dipole_vcf_cf4.h"
 *     #include <stdio.h>
 *
 *     int main(void)
 *     {
 *         double state[12] = {1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.01, 0.0};
 *         size_t completed;
 *         const int status = dipole_vcf_cf4_run(state, 0.005, 100, NULL, 0, NULL, &completed);
 *         printf("status %d after %zu steps\n", status, completed);
 *         for (int i = 0; i < 12; i++) {
 *             printf("%.17g\n", state[i]);
 *         }
 *         return status;
 *     }
 */
#include "dipole_vcf_cf4.h"

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

static void count_sweeps(dipole_vcf_cf4_statistics *statistics, size_t block, size_t sweeps, int failed)
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
    dipole_vcf_cf4_statistics *statistics)
{
    if (!isfinite(h)) {
        return DIPOLE_VCF_CF4_BAD_STEP;
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
    const double w18 = 0.1 * w17 - 0.1 * w10;
    const double w19 = w18 + mu1 * w2;
    const double w20 = w10 + w17;
    const double w21 = w20 + mu1 * w3;
    const double w22 = mu2 * w1;
    const double w23 = 2.0 * w5 * w9;
    const double w24 = 2.0 * w11 * w16;
    const double w25 = 0.1 * w24 - 0.1 * w23;
    const double w26 = w25 + mu2 * w2;
    const double w27 = w23 - 1.0 + w24;
    const double w28 = w27 + mu2 * w3;
    const double n0_0 = g20 * w4 + g21 * w19 + g22 * w21 - g10 * w22 - g11 * w26 - g12 * w28;
    const double w29 = mu0 * w1;
    const double w30 = 2.0 * w6 * w9;
    const double w31 = 2.0 * w12 * w16;
    const double w32 = 0.1 * w31 - 0.1 * w30;
    const double w33 = w32 + mu0 * w2;
    const double w34 = w30 + w31;
    const double w35 = w34 + mu0 * w3;
    const double n0_1 = g00 * w22 - (g20 * w29 + g21 * w33 + g22 * w35) + g01 * w26 + g02 * w28;
    const double n0_2 = g10 * w29 + g11 * w33 + g12 * w35 - g00 * w4 - g01 * w19 - g02 * w21;
    const double w36 = -0.5 * h;
    const double w37 = 0.5 * h;
    const double w75 = -0.25 * h;
    const double w77 = -0.16666666666666666 * h;
    const double w79 = 0.08333333333333333 * h;
    const double w90 = 0.25 * h;
    const double w125 = 0.16666666666666666 * h;
    const double w126 = -0.08333333333333333 * h;
    /* the equations of xi1, xi2, xi3, xi4, n1, n2, n3, n4: fixed point in xi1_0, xi1_1, xi1_2, xi2_0, xi2_1, xi2_2, xi3_0, xi3_1, xi3_2, xi4_0, xi4_1, xi4_2, n1_0, n1_1, n1_2, n2_0, n2_1, n2_2, n3_0, n3_1, n3_2, n4_0, n4_1, n4_2 */
    double xi1_0 = xi0_0;
    double xi1_1 = xi0_1;
    double xi1_2 = xi0_2;
    double xi2_0 = xi0_0;
    double xi2_1 = xi0_1;
    double xi2_2 = xi0_2;
    double xi3_0 = xi0_0;
    double xi3_1 = xi0_1;
    double xi3_2 = xi0_2;
    double xi4_0 = xi0_0;
    double xi4_1 = xi0_1;
    double xi4_2 = xi0_2;
    double n1_0 = n0_0;
    double n1_1 = n0_1;
    double n1_2 = n0_2;
    double n2_0 = n0_0;
    double n2_1 = n0_1;
    double n2_2 = n0_2;
    double n3_0 = n0_0;
    double n3_1 = n0_1;
    double n3_2 = n0_2;
    double n4_0 = n0_0;
    double n4_1 = n0_1;
    double n4_2 = n0_2;
    double nu4_2, nu2_2, nu4_1, nu2_1, nu4_0, nu2_0, nu3_2, nu3_1, nu3_0, ge1_6, ge1_7, ge1_8,
        ge1_3, ge1_4, ge1_5, ge1_0, ge1_1, ge1_2, f1_0, f1_1, f1_2, f2_0, f2_1, f2_2, f3_0,
        f3_1, f3_2, f4_0, f4_1, f4_2, r1_0, r1_1, r1_2;
    double previous_1 = 0.0;
    for (size_t sweep = 1;; sweep++) {
        const double xE2_1_1 = xi1_1 * w37;
        const double xE2_1_0 = xi1_0 * w37;
        const double xE2_1_2 = xi1_2 * w37;
        const double w38 = xE2_1_0 * xE2_1_0 + xE2_1_1 * xE2_1_1 + xE2_1_2 * xE2_1_2;
        double c1_1, c2_1;
        stumpff_12(w38, &c1_1, &c2_1);
        const double w40 = xE2_1_1 * c1_1;
        const double w42 = xE2_1_0 * c2_1;
        const double w43 = xE2_1_2 * w42;
        const double gE2_1_2 = w40 + w43;
        const double yE2_1_1 = xi1_1 * w36;
        const double w44 = h * xi3_1;
        const double xE4_2_1 = yE2_1_1 + w44;
        const double yE2_1_0 = xi1_0 * w36;
        const double w45 = h * xi3_0;
        const double xE4_2_0 = yE2_1_0 + w45;
        const double yE2_1_2 = xi1_2 * w36;
        const double w46 = h * xi3_2;
        const double xE4_2_2 = yE2_1_2 + w46;
        const double w47 = xE4_2_0 * xE4_2_0 + xE4_2_1 * xE4_2_1 + xE4_2_2 * xE4_2_2;
        double c1_2, c2_2;
        stumpff_12(w47, &c1_2, &c2_2);
        const double w49 = xE4_2_1 * c2_2;
        const double w50 = xE4_2_1 * w49;
        const double w51 = xE4_2_2 * c2_2 * xE4_2_2;
        const double gE4_2_0 = 1.0 - (w50 + w51);
        const double w52 = xE2_1_1 * c2_1;
        const double w53 = xE2_1_2 * w52;
        const double w54 = xE2_1_0 * c1_1;
        const double gE2_1_5 = w53 - w54;
        const double w55 = xE4_2_0 * c2_2;
        const double w56 = xE4_2_1 * w55;
        const double w58 = xE4_2_2 * c1_2;
        const double gE4_2_1 = w56 - w58;
        const double w59 = xE2_1_0 * w42;
        const double w60 = xE2_1_1 * w52;
        const double gE2_1_8 = 1.0 - (w59 + w60);
        const double w61 = xE4_2_1 * c1_2;
        const double w62 = xE4_2_2 * w55;
        const double gE4_2_2 = w61 + w62;
        const double E4_2_2 = gE2_1_2 * gE4_2_0 + gE2_1_5 * gE4_2_1 + gE2_1_8 * gE4_2_2;
        const double gE4_2_3 = w56 + w58;
        const double w63 = xE4_2_0 * w55;
        const double gE4_2_4 = 1.0 - (w51 + w63);
        const double w64 = xE4_2_2 * w49;
        const double w65 = xE4_2_0 * c1_2;
        const double gE4_2_5 = w64 - w65;
        const double E4_2_5 = gE2_1_2 * gE4_2_3 + gE2_1_5 * gE4_2_4 + gE2_1_8 * gE4_2_5;
        const double gE4_2_6 = w62 - w61;
        const double gE4_2_7 = w64 + w65;
        const double gE4_2_8 = 1.0 - (w50 + w63);
        const double E4_2_8 = gE2_1_2 * gE4_2_6 + gE2_1_5 * gE4_2_7 + gE2_1_8 * gE4_2_8;
        nu4_2 = n4_0 * E4_2_2 + n4_1 * E4_2_5 + n4_2 * E4_2_8;
        nu2_2 = n2_0 * gE2_1_2 + n2_1 * gE2_1_5 + n2_2 * gE2_1_8;
        const double s_nu2_2 = w36 * nu4_2 - h * nu2_2;
        const double w66 = yE2_1_0 * yE2_1_0 + yE2_1_1 * yE2_1_1 + yE2_1_2 * yE2_1_2;
        double c2_3, c3_1;
        stumpff_23(w66, &c2_3, &c3_1);
        const double w68 = xE2_1_1 * w42;
        const double w69 = xE2_1_2 * c1_1;
        const double gE2_1_1 = w68 - w69;
        const double w70 = xE2_1_2 * c2_1 * xE2_1_2;
        const double gE2_1_4 = 1.0 - (w59 + w70);
        const double gE2_1_7 = w53 + w54;
        const double E4_2_1 = gE4_2_0 * gE2_1_1 + gE4_2_1 * gE2_1_4 + gE4_2_2 * gE2_1_7;
        const double E4_2_4 = gE4_2_3 * gE2_1_1 + gE4_2_4 * gE2_1_4 + gE4_2_5 * gE2_1_7;
        const double E4_2_7 = gE4_2_6 * gE2_1_1 + gE4_2_7 * gE2_1_4 + gE4_2_8 * gE2_1_7;
        nu4_1 = n4_0 * E4_2_1 + n4_1 * E4_2_4 + n4_2 * E4_2_7;
        nu2_1 = n2_0 * gE2_1_1 + n2_1 * gE2_1_4 + n2_2 * gE2_1_7;
        const double s_nu2_1 = w36 * nu4_1 - h * nu2_1;
        const double gE2_1_0 = 1.0 - (w60 + w70);
        const double gE2_1_3 = w68 + w69;
        const double gE2_1_6 = w43 - w40;
        const double E4_2_0 = gE4_2_0 * gE2_1_0 + gE4_2_1 * gE2_1_3 + gE4_2_2 * gE2_1_6;
        const double E4_2_3 = gE4_2_3 * gE2_1_0 + gE4_2_4 * gE2_1_3 + gE4_2_5 * gE2_1_6;
        const double E4_2_6 = gE4_2_6 * gE2_1_0 + gE4_2_7 * gE2_1_3 + gE4_2_8 * gE2_1_6;
        nu4_0 = n4_0 * E4_2_0 + n4_1 * E4_2_3 + n4_2 * E4_2_6;
        nu2_0 = n2_0 * gE2_1_0 + n2_1 * gE2_1_3 + n2_2 * gE2_1_6;
        const double s_nu2_0 = w36 * nu4_0 - h * nu2_0;
        const double w71 = yE2_1_0 * s_nu2_1 - yE2_1_1 * s_nu2_0;
        const double w73 = yE2_1_2 * s_nu2_0 - yE2_1_0 * s_nu2_2;
        const double w74 = yE2_1_1 * s_nu2_2 - yE2_1_2 * s_nu2_1;
        const double w76 = xi2_0 + xi3_0;
        const double w78 = w76 * w77;
        const double ye1_0 = xi1_0 * w75 + w78 + xi4_0 * w79;
        const double w80 = xi2_1 + xi3_1;
        const double w81 = w77 * w80;
        const double ye1_1 = xi1_1 * w75 + w81 + xi4_1 * w79;
        const double w82 = xi2_2 + xi3_2;
        const double w83 = w77 * w82;
        const double ye1_2 = xi1_2 * w75 + w83 + xi4_2 * w79;
        const double w84 = ye1_0 * ye1_0 + ye1_1 * ye1_1 + ye1_2 * ye1_2;
        double c2_4, c3_2;
        stumpff_23(w84, &c2_4, &c3_2);
        const double w86 = mu1 * ye1_0 - mu0 * ye1_1;
        const double w88 = mu0 * ye1_2 - mu2 * ye1_0;
        const double w89 = mu2 * ye1_1 - mu1 * ye1_2;
        const double p1_2 = mu2 - w86 * c2_4 + (ye1_0 * w88 - ye1_1 * w89) * c3_2;
        const double w91 = n1_1 * ye1_0 - n1_0 * ye1_1;
        const double w92 = n1_0 * ye1_2 - n1_2 * ye1_0;
        const double w93 = n1_2 * ye1_1 - n1_1 * ye1_2;
        const double w94 = nu4_1 * ye1_0 - nu4_0 * ye1_1;
        const double w95 = nu4_0 * ye1_2 - nu4_2 * ye1_0;
        const double w96 = nu4_2 * ye1_1 - nu4_1 * ye1_2;
        const double w97 = n1_2 - w91 * c2_4 + (ye1_0 * w92 - ye1_1 * w93) * c3_2
            + (nu4_2 - w94 * c2_4 + (ye1_0 * w95 - ye1_1 * w96) * c3_2);
        const double m1_13_2 = gE2_1_6 * nu4_0 + gE2_1_7 * nu4_1 + gE2_1_8 * nu4_2;
        const double yE4_2_0 = xE2_1_0 - w45;
        const double yE4_2_1 = xE2_1_1 - w44;
        const double yE4_2_2 = xE2_1_2 - w46;
        const double w98 = yE4_2_0 * yE4_2_0 + yE4_2_1 * yE4_2_1 + yE4_2_2 * yE4_2_2;
        double c2_5, c3_3;
        stumpff_23(w98, &c2_5, &c3_3);
        const double m1_13_1 = gE2_1_3 * nu4_0 + gE2_1_4 * nu4_1 + gE2_1_5 * nu4_2;
        const double m1_13_0 = gE2_1_0 * nu4_0 + gE2_1_1 * nu4_1 + gE2_1_2 * nu4_2;
        const double w100 = yE4_2_0 * m1_13_1 - yE4_2_1 * m1_13_0;
        const double w102 = yE4_2_2 * m1_13_0 - m1_13_2 * yE4_2_0;
        const double w103 = m1_13_2 * yE4_2_1 - yE4_2_2 * m1_13_1;
        const double p1_13_2 = m1_13_2 - w100 * c2_5 + (yE4_2_0 * w102 - yE4_2_1 * w103) * c3_3;
        const double w104 = nu2_1 * ye1_0 - nu2_0 * ye1_1;
        const double w105 = nu2_0 * ye1_2 - nu2_2 * ye1_0;
        const double w106 = nu2_2 * ye1_1 - nu2_1 * ye1_2;
        const double xE3_1_1 = xi2_1 * w37;
        const double xE3_1_0 = xi2_0 * w37;
        const double xE3_1_2 = xi2_2 * w37;
        const double w107 = xE3_1_0 * xE3_1_0 + xE3_1_1 * xE3_1_1 + xE3_1_2 * xE3_1_2;
        double c1_3, c2_6;
        stumpff_12(w107, &c1_3, &c2_6);
        const double w109 = xE3_1_1 * c1_3;
        const double w111 = xE3_1_0 * c2_6;
        const double w112 = xE3_1_2 * w111;
        const double gE3_1_2 = w109 + w112;
        const double w113 = xE3_1_1 * c2_6;
        const double w114 = xE3_1_2 * w113;
        const double w115 = xE3_1_0 * c1_3;
        const double gE3_1_5 = w114 - w115;
        const double w116 = xE3_1_0 * w111;
        const double w117 = xE3_1_1 * w113;
        const double gE3_1_8 = 1.0 - (w116 + w117);
        nu3_2 = n3_0 * gE3_1_2 + n3_1 * gE3_1_5 + n3_2 * gE3_1_8;
        const double w118 = xE3_1_1 * w111;
        const double w119 = xE3_1_2 * c1_3;
        const double gE3_1_1 = w118 - w119;
        const double w120 = xE3_1_2 * c2_6 * xE3_1_2;
        const double gE3_1_4 = 1.0 - (w116 + w120);
        const double gE3_1_7 = w114 + w115;
        nu3_1 = n3_0 * gE3_1_1 + n3_1 * gE3_1_4 + n3_2 * gE3_1_7;
        const double gE3_1_0 = 1.0 - (w117 + w120);
        const double gE3_1_3 = w118 + w119;
        const double gE3_1_6 = w112 - w109;
        nu3_0 = n3_0 * gE3_1_0 + n3_1 * gE3_1_3 + n3_2 * gE3_1_6;
        const double w121 = ye1_0 * nu3_1 - ye1_1 * nu3_0;
        const double w122 = ye1_2 * nu3_0 - ye1_0 * nu3_2;
        const double w123 = ye1_1 * nu3_2 - ye1_2 * nu3_1;
        const double w124 = nu2_2 - w104 * c2_4 + (ye1_0 * w105 - ye1_1 * w106) * c3_2
            + (nu3_2 - w121 * c2_4 + (ye1_0 * w122 - ye1_1 * w123) * c3_2);
        const double xe1_2 = xi1_2 * w90 + w82 * w125 + xi4_2 * w126;
        const double xe1_0 = xi1_0 * w90 + w76 * w125 + xi4_0 * w126;
        const double xe1_1 = xi1_1 * w90 + w80 * w125 + xi4_1 * w126;
        const double w127 = xe1_0 * xe1_0 + xe1_1 * xe1_1 + xe1_2 * xe1_2;
        double c1_4, c2_7;
        stumpff_12(w127, &c1_4, &c2_7);
        const double w129 = xe1_0 * c2_7;
        const double w130 = xe1_2 * w129;
        const double w132 = xe1_1 * c1_4;
        ge1_6 = w130 - w132;
        const double w133 = xe1_0 * c1_4;
        const double w134 = xe1_1 * c2_7;
        const double w135 = xe1_2 * w134;
        ge1_7 = w133 + w135;
        const double w136 = xe1_0 * w129;
        const double w137 = xe1_1 * w134;
        ge1_8 = 1.0 - (w136 + w137);
        const double m1_6_2 = mu0 * ge1_6 + mu1 * ge1_7 + mu2 * ge1_8;
        const double ye2_0 = w78 + xi1_0 * w79 + xi4_0 * w75;
        const double ye2_1 = w81 + xi1_1 * w79 + xi4_1 * w75;
        const double ye2_2 = w83 + xi1_2 * w79 + xi4_2 * w75;
        const double w138 = ye2_0 * ye2_0 + ye2_1 * ye2_1 + ye2_2 * ye2_2;
        double c2_8, c3_4;
        stumpff_23(w138, &c2_8, &c3_4);
        const double w140 = xe1_2 * c1_4;
        const double w141 = xe1_1 * w129;
        ge1_3 = w140 + w141;
        const double w142 = xe1_2 * c2_7 * xe1_2;
        ge1_4 = 1.0 - (w136 + w142);
        ge1_5 = w135 - w133;
        const double m1_6_1 = mu0 * ge1_3 + mu1 * ge1_4 + mu2 * ge1_5;
        ge1_0 = 1.0 - (w137 + w142);
        ge1_1 = w141 - w140;
        ge1_2 = w130 + w132;
        const double m1_6_0 = mu0 * ge1_0 + mu1 * ge1_1 + mu2 * ge1_2;
        const double w143 = ye2_0 * m1_6_1 - ye2_1 * m1_6_0;
        const double w145 = ye2_2 * m1_6_0 - m1_6_2 * ye2_0;
        const double w146 = m1_6_2 * ye2_1 - ye2_2 * m1_6_1;
        const double p1_6_2 = m1_6_2 - w143 * c2_8 + (ye2_0 * w145 - ye2_1 * w146) * c3_4;
        const double m1_7_2 = n1_0 * ge1_6 + n1_1 * ge1_7 + n1_2 * ge1_8;
        const double m1_7_1 = n1_0 * ge1_3 + n1_1 * ge1_4 + n1_2 * ge1_5;
        const double m1_7_0 = n1_0 * ge1_0 + n1_1 * ge1_1 + n1_2 * ge1_2;
        const double w147 = ye2_0 * m1_7_1 - ye2_1 * m1_7_0;
        const double w148 = ye2_2 * m1_7_0 - ye2_0 * m1_7_2;
        const double w149 = ye2_1 * m1_7_2 - ye2_2 * m1_7_1;
        const double p1_7_2 = m1_7_2 - w147 * c2_8 + (ye2_0 * w148 - ye2_1 * w149) * c3_4;
        const double m1_10_2 = nu4_0 * ge1_6 + nu4_1 * ge1_7 + nu4_2 * ge1_8;
        const double m1_10_1 = nu4_0 * ge1_3 + nu4_1 * ge1_4 + nu4_2 * ge1_5;
        const double m1_10_0 = nu4_0 * ge1_0 + nu4_1 * ge1_1 + nu4_2 * ge1_2;
        const double w150 = ye2_0 * m1_10_1 - ye2_1 * m1_10_0;
        const double w151 = ye2_2 * m1_10_0 - ye2_0 * m1_10_2;
        const double w152 = ye2_1 * m1_10_2 - ye2_2 * m1_10_1;
        const double p1_10_2 = m1_10_2 - w150 * c2_8 + (ye2_0 * w151 - ye2_1 * w152) * c3_4;
        const double w153 = p1_7_2 + p1_10_2;
        const double w154 = 1.5 * p1_2 + w90 * w97 + w37 * (p1_13_2 + w124) - 0.5 * p1_6_2
            + w126 * w153;
        const double m1_8_2 = nu2_0 * ge1_6 + nu2_1 * ge1_7 + nu2_2 * ge1_8;
        const double m1_8_1 = nu2_0 * ge1_3 + nu2_1 * ge1_4 + nu2_2 * ge1_5;
        const double m1_8_0 = nu2_0 * ge1_0 + nu2_1 * ge1_1 + nu2_2 * ge1_2;
        const double w155 = ye2_0 * m1_8_1 - ye2_1 * m1_8_0;
        const double w156 = ye2_2 * m1_8_0 - ye2_0 * m1_8_2;
        const double w157 = ye2_1 * m1_8_2 - ye2_2 * m1_8_1;
        const double p1_8_2 = m1_8_2 - w155 * c2_8 + (ye2_0 * w156 - ye2_1 * w157) * c3_4;
        const double m1_9_2 = nu3_0 * ge1_6 + nu3_1 * ge1_7 + nu3_2 * ge1_8;
        const double m1_9_1 = nu3_0 * ge1_3 + nu3_1 * ge1_4 + nu3_2 * ge1_5;
        const double m1_9_0 = nu3_0 * ge1_0 + nu3_1 * ge1_1 + nu3_2 * ge1_2;
        const double w158 = ye2_0 * m1_9_1 - ye2_1 * m1_9_0;
        const double w159 = ye2_2 * m1_9_0 - ye2_0 * m1_9_2;
        const double w160 = ye2_1 * m1_9_2 - ye2_2 * m1_9_1;
        const double p1_9_2 = m1_9_2 - w158 * c2_8 + (ye2_0 * w159 - ye2_1 * w160) * c3_4;
        const double w161 = p1_8_2 + p1_9_2;
        const double M1_2 = w154 + w77 * w161
            + (s_nu2_2 - w71 * c2_3 + (yE2_1_0 * w73 - yE2_1_1 * w74) * c3_1);
        const double p1_0 = mu0 - w89 * c2_4 + (ye1_1 * w86 - ye1_2 * w88) * c3_2;
        const double w162 = n1_0 - w93 * c2_4 + (ye1_1 * w91 - ye1_2 * w92) * c3_2
            + (nu4_0 - w96 * c2_4 + (ye1_1 * w94 - ye1_2 * w95) * c3_2);
        const double p1_13_0 = m1_13_0 - w103 * c2_5 + (yE4_2_1 * w100 - yE4_2_2 * w102) * c3_3;
        const double w163 = nu2_0 - w106 * c2_4 + (ye1_1 * w104 - ye1_2 * w105) * c3_2
            + (nu3_0 - w123 * c2_4 + (ye1_1 * w121 - ye1_2 * w122) * c3_2);
        const double p1_6_0 = m1_6_0 - w146 * c2_8 + (ye2_1 * w143 - ye2_2 * w145) * c3_4;
        const double p1_7_0 = m1_7_0 - w149 * c2_8 + (ye2_1 * w147 - ye2_2 * w148) * c3_4;
        const double p1_10_0 = m1_10_0 - w152 * c2_8 + (ye2_1 * w150 - ye2_2 * w151) * c3_4;
        const double w164 = p1_7_0 + p1_10_0;
        const double w165 = 1.5 * p1_0 + w90 * w162 + w37 * (p1_13_0 + w163) - 0.5 * p1_6_0
            + w126 * w164;
        const double p1_8_0 = m1_8_0 - w157 * c2_8 + (ye2_1 * w155 - ye2_2 * w156) * c3_4;
        const double p1_9_0 = m1_9_0 - w160 * c2_8 + (ye2_1 * w158 - ye2_2 * w159) * c3_4;
        const double w166 = p1_8_0 + p1_9_0;
        const double M1_0 = w165 + w77 * w166
            + (s_nu2_0 - w74 * c2_3 + (yE2_1_1 * w71 - yE2_1_2 * w73) * c3_1);
        const double p1_1 = mu1 - w88 * c2_4 + (ye1_2 * w89 - ye1_0 * w86) * c3_2;
        const double w167 = n1_1 - w92 * c2_4 + (ye1_2 * w93 - ye1_0 * w91) * c3_2
            + (nu4_1 - w95 * c2_4 + (ye1_2 * w96 - ye1_0 * w94) * c3_2);
        const double p1_13_1 = m1_13_1 - w102 * c2_5 + (yE4_2_2 * w103 - yE4_2_0 * w100) * c3_3;
        const double w168 = nu2_1 - w105 * c2_4 + (ye1_2 * w106 - ye1_0 * w104) * c3_2
            + (nu3_1 - w122 * c2_4 + (ye1_2 * w123 - ye1_0 * w121) * c3_2);
        const double p1_6_1 = m1_6_1 - w145 * c2_8 + (ye2_2 * w146 - ye2_0 * w143) * c3_4;
        const double p1_7_1 = m1_7_1 - w148 * c2_8 + (ye2_2 * w149 - ye2_0 * w147) * c3_4;
        const double p1_10_1 = m1_10_1 - w151 * c2_8 + (ye2_2 * w152 - ye2_0 * w150) * c3_4;
        const double w169 = p1_7_1 + p1_10_1;
        const double w170 = 1.5 * p1_1 + w90 * w167 + w37 * (p1_13_1 + w168) - 0.5 * p1_6_1
            + w126 * w169;
        const double p1_8_1 = m1_8_1 - w156 * c2_8 + (ye2_2 * w157 - ye2_0 * w155) * c3_4;
        const double p1_9_1 = m1_9_1 - w159 * c2_8 + (ye2_2 * w160 - ye2_0 * w158) * c3_4;
        const double w171 = p1_8_1 + p1_9_1;
        const double M1_1 = w170 + w77 * w171
            + (s_nu2_1 - w73 * c2_3 + (yE2_1_2 * w74 - yE2_1_0 * w71) * c3_1);
        const double w172 = 0.9900990099009901 * (g00 * M1_0 + g10 * M1_1 + g20 * M1_2);
        const double w173 = g01 * M1_0 + g11 * M1_1 + g21 * M1_2;
        const double w174 = 100.0 * (g02 * M1_0 + g12 * M1_1 + g22 * M1_2);
        f1_0 = g00 * w172 + g01 * w173 + g02 * w174;
        f1_1 = g10 * w172 + g11 * w173 + g12 * w174;
        f1_2 = g20 * w172 + g21 * w173 + g22 * w174;
        const double Q2_0 = g00 * gE2_1_0 + g10 * gE2_1_1 + g20 * gE2_1_2;
        const double Q2_6 = g00 * gE2_1_6 + g10 * gE2_1_7 + g20 * gE2_1_8;
        const double w175 = 0.5 * (p1_2 + p1_6_2) + w79 * (w97 + p1_7_2 + p1_10_2)
            + w125 * (w124 + p1_8_2 + p1_9_2);
        const double yE3_1_0 = xi2_0 * w36;
        const double yE3_1_1 = xi2_1 * w36;
        const double yE3_1_2 = xi2_2 * w36;
        const double w176 = yE3_1_0 * yE3_1_0 + yE3_1_1 * yE3_1_1 + yE3_1_2 * yE3_1_2;
        double c2_9, c3_5;
        stumpff_23(w176, &c2_9, &c3_5);
        const double w178 = nu3_1 * yE3_1_0 - nu3_0 * yE3_1_1;
        const double w180 = nu3_0 * yE3_1_2 - nu3_2 * yE3_1_0;
        const double w181 = nu3_2 * yE3_1_1 - nu3_1 * yE3_1_2;
        const double M2_2 = w175
            + w36 * (nu3_2 - w178 * c2_9 + (yE3_1_0 * w180 - yE3_1_1 * w181) * c3_5);
        const double w182 = 0.5 * (p1_0 + p1_6_0) + w79 * (w162 + p1_7_0 + p1_10_0)
            + w125 * (w163 + p1_8_0 + p1_9_0);
        const double M2_0 = w182
            + w36 * (nu3_0 - w181 * c2_9 + (yE3_1_1 * w178 - yE3_1_2 * w180) * c3_5);
        const double Q2_3 = g00 * gE2_1_3 + g10 * gE2_1_4 + g20 * gE2_1_5;
        const double w183 = 0.5 * (p1_1 + p1_6_1) + w79 * (w167 + p1_7_1 + p1_10_1)
            + w125 * (w168 + p1_8_1 + p1_9_1);
        const double M2_1 = w183
            + w36 * (nu3_1 - w180 * c2_9 + (yE3_1_2 * w181 - yE3_1_0 * w178) * c3_5);
        const double w184 = 0.9900990099009901 * (Q2_0 * M2_0 + Q2_3 * M2_1 + Q2_6 * M2_2);
        const double Q2_1 = g01 * gE2_1_0 + g11 * gE2_1_1 + g21 * gE2_1_2;
        const double Q2_7 = g01 * gE2_1_6 + g11 * gE2_1_7 + g21 * gE2_1_8;
        const double Q2_4 = g01 * gE2_1_3 + g11 * gE2_1_4 + g21 * gE2_1_5;
        const double w185 = M2_0 * Q2_1 + M2_1 * Q2_4 + M2_2 * Q2_7;
        const double Q2_2 = g02 * gE2_1_0 + g12 * gE2_1_1 + g22 * gE2_1_2;
        const double Q2_8 = g02 * gE2_1_6 + g12 * gE2_1_7 + g22 * gE2_1_8;
        const double Q2_5 = g02 * gE2_1_3 + g12 * gE2_1_4 + g22 * gE2_1_5;
        const double w186 = 100.0 * (M2_0 * Q2_2 + M2_1 * Q2_5 + M2_2 * Q2_8);
        f2_0 = Q2_0 * w184 + Q2_1 * w185 + Q2_2 * w186;
        f2_1 = Q2_3 * w184 + Q2_4 * w185 + Q2_5 * w186;
        f2_2 = Q2_6 * w184 + Q2_7 * w185 + Q2_8 * w186;
        const double Q3_0 = g00 * gE3_1_0 + g10 * gE3_1_1 + g20 * gE3_1_2;
        const double Q3_6 = g00 * gE3_1_6 + g10 * gE3_1_7 + g20 * gE3_1_8;
        const double M3_2 = w175 + w36 * p1_13_2;
        const double M3_0 = w182 + w36 * p1_13_0;
        const double Q3_3 = g00 * gE3_1_3 + g10 * gE3_1_4 + g20 * gE3_1_5;
        const double M3_1 = w183 + w36 * p1_13_1;
        const double w187 = 0.9900990099009901 * (Q3_0 * M3_0 + Q3_3 * M3_1 + Q3_6 * M3_2);
        const double Q3_1 = g01 * gE3_1_0 + g11 * gE3_1_1 + g21 * gE3_1_2;
        const double Q3_7 = g01 * gE3_1_6 + g11 * gE3_1_7 + g21 * gE3_1_8;
        const double Q3_4 = g01 * gE3_1_3 + g11 * gE3_1_4 + g21 * gE3_1_5;
        const double w188 = M3_0 * Q3_1 + M3_1 * Q3_4 + M3_2 * Q3_7;
        const double Q3_2 = g02 * gE3_1_0 + g12 * gE3_1_1 + g22 * gE3_1_2;
        const double Q3_8 = g02 * gE3_1_6 + g12 * gE3_1_7 + g22 * gE3_1_8;
        const double Q3_5 = g02 * gE3_1_3 + g12 * gE3_1_4 + g22 * gE3_1_5;
        const double w189 = 100.0 * (M3_0 * Q3_2 + M3_1 * Q3_5 + M3_2 * Q3_8);
        f3_0 = Q3_0 * w187 + Q3_1 * w188 + Q3_2 * w189;
        f3_1 = Q3_3 * w187 + Q3_4 * w188 + Q3_5 * w189;
        f3_2 = Q3_6 * w187 + Q3_7 * w188 + Q3_8 * w189;
        const double Q4_0 = g00 * E4_2_0 + g10 * E4_2_1 + g20 * E4_2_2;
        const double Q4_6 = g00 * E4_2_6 + g10 * E4_2_7 + g20 * E4_2_8;
        const double M4_2 = w97 * w126 - 0.5 * p1_2 + w77 * w124 + 1.5 * p1_6_2 + w90 * w153
            + w37 * w161;
        const double M4_0 = w126 * w162 - 0.5 * p1_0 + w77 * w163 + 1.5 * p1_6_0 + w90 * w164
            + w37 * w166;
        const double Q4_3 = g00 * E4_2_3 + g10 * E4_2_4 + g20 * E4_2_5;
        const double M4_1 = w126 * w167 - 0.5 * p1_1 + w77 * w168 + 1.5 * p1_6_1 + w90 * w169
            + w37 * w171;
        const double w190 = 0.9900990099009901 * (Q4_0 * M4_0 + Q4_3 * M4_1 + Q4_6 * M4_2);
        const double Q4_1 = g01 * E4_2_0 + g11 * E4_2_1 + g21 * E4_2_2;
        const double Q4_7 = g01 * E4_2_6 + g11 * E4_2_7 + g21 * E4_2_8;
        const double Q4_4 = g01 * E4_2_3 + g11 * E4_2_4 + g21 * E4_2_5;
        const double w191 = M4_0 * Q4_1 + M4_1 * Q4_4 + M4_2 * Q4_7;
        const double Q4_2 = g02 * E4_2_0 + g12 * E4_2_1 + g22 * E4_2_2;
        const double Q4_8 = g02 * E4_2_6 + g12 * E4_2_7 + g22 * E4_2_8;
        const double Q4_5 = g02 * E4_2_3 + g12 * E4_2_4 + g22 * E4_2_5;
        const double w192 = 100.0 * (M4_0 * Q4_2 + M4_1 * Q4_5 + M4_2 * Q4_8);
        f4_0 = Q4_0 * w190 + Q4_1 * w191 + Q4_2 * w192;
        f4_1 = Q4_3 * w190 + Q4_4 * w191 + Q4_5 * w192;
        f4_2 = Q4_6 * w190 + Q4_7 * w191 + Q4_8 * w192;
        const double w193 = M1_1 * w172;
        const double w194 = w18 + M1_1 * w173;
        const double w195 = w20 + M1_1 * w174;
        const double w196 = M1_2 * w172;
        const double w197 = w25 + M1_2 * w173;
        const double w198 = w27 + M1_2 * w174;
        r1_0 = g20 * w193 + g21 * w194 + g22 * w195 - g10 * w196 - g11 * w197 - g12 * w198;
        const double w199 = M1_0 * w172;
        const double w200 = w32 + M1_0 * w173;
        const double w201 = w34 + M1_0 * w174;
        r1_1 = g00 * w196 - (g20 * w199 + g21 * w200 + g22 * w201) + g01 * w197 + g02 * w198;
        r1_2 = g10 * w199 + g11 * w200 + g12 * w201 - g00 * w193 - g01 * w194 - g02 * w195;
        const double w202 = M2_1 * w184;
        const double w203 = 1.5 + 0.1 * Q2_7 - Q2_8;
        const double w204 = 0.1 * Q2_1 - Q2_2;
        const double w205 = 0.1 * Q2_4 - Q2_5;
        const double w206 = 1.0 / sqrt(w204 * w204 + w205 * w205 + w203 * w203);
        const double w207 = w206 * w206 * (0.5 * w206);
        const double w208 = 2.0 * w205 * w207;
        const double w209 = 1.5 - 0.1 * Q2_7 - Q2_8;
        const double w210 = -0.1 * Q2_1 - Q2_2;
        const double w211 = -0.1 * Q2_4 - Q2_5;
        const double w212 = sqrt(w210 * w210 + w211 * w211 + w209 * w209);
        const double w213 = 1.0 / w212;
        const double w214 = -1.0 / w212 * w213 * (0.5 * w213);
        const double w215 = 2.0 * w211 * w214;
        const double w216 = 0.1 * w215 - 0.1 * w208 + M2_1 * w185;
        const double w217 = w208 + w215 + M2_1 * w186;
        const double w218 = M2_2 * w184;
        const double w219 = 2.0 * w203 * w207;
        const double w220 = 2.0 * w209 * w214;
        const double w221 = 0.1 * w220 - 0.1 * w219 + M2_2 * w185;
        const double w222 = w219 - 1.0 + w220 + M2_2 * w186;
        const double r2_0 = Q2_6 * w202 + Q2_7 * w216 + Q2_8 * w217 - Q2_3 * w218 - Q2_4 * w221
            - Q2_5 * w222;
        const double w223 = M2_0 * w184;
        const double w224 = 2.0 * w204 * w207;
        const double w225 = 2.0 * w210 * w214;
        const double w226 = 0.1 * w225 - 0.1 * w224 + M2_0 * w185;
        const double w227 = w224 + w225 + M2_0 * w186;
        const double r2_1 = Q2_0 * w218 - (Q2_6 * w223 + Q2_7 * w226 + Q2_8 * w227) + Q2_1 * w221
            + Q2_2 * w222;
        const double r2_2 = Q2_3 * w223 + Q2_4 * w226 + Q2_5 * w227 - Q2_0 * w202 - Q2_1 * w216
            - Q2_2 * w217;
        const double w228 = M3_1 * w187;
        const double w229 = 1.5 + 0.1 * Q3_7 - Q3_8;
        const double w230 = 0.1 * Q3_1 - Q3_2;
        const double w231 = 0.1 * Q3_4 - Q3_5;
        const double w232 = 1.0 / sqrt(w230 * w230 + w231 * w231 + w229 * w229);
        const double w233 = w232 * w232 * (0.5 * w232);
        const double w234 = 2.0 * w231 * w233;
        const double w235 = 1.5 - 0.1 * Q3_7 - Q3_8;
        const double w236 = -0.1 * Q3_1 - Q3_2;
        const double w237 = -0.1 * Q3_4 - Q3_5;
        const double w238 = sqrt(w236 * w236 + w237 * w237 + w235 * w235);
        const double w239 = 1.0 / w238;
        const double w240 = -1.0 / w238 * w239 * (0.5 * w239);
        const double w241 = 2.0 * w237 * w240;
        const double w242 = 0.1 * w241 - 0.1 * w234 + M3_1 * w188;
        const double w243 = w234 + w241 + M3_1 * w189;
        const double w244 = M3_2 * w187;
        const double w245 = 2.0 * w229 * w233;
        const double w246 = 2.0 * w235 * w240;
        const double w247 = 0.1 * w246 - 0.1 * w245 + M3_2 * w188;
        const double w248 = w245 - 1.0 + w246 + M3_2 * w189;
        const double r3_0 = Q3_6 * w228 + Q3_7 * w242 + Q3_8 * w243 - Q3_3 * w244 - Q3_4 * w247
            - Q3_5 * w248;
        const double w249 = M3_0 * w187;
        const double w250 = 2.0 * w230 * w233;
        const double w251 = 2.0 * w236 * w240;
        const double w252 = 0.1 * w251 - 0.1 * w250 + M3_0 * w188;
        const double w253 = w250 + w251 + M3_0 * w189;
        const double r3_1 = Q3_0 * w244 - (Q3_6 * w249 + Q3_7 * w252 + Q3_8 * w253) + Q3_1 * w247
            + Q3_2 * w248;
        const double r3_2 = Q3_3 * w249 + Q3_4 * w252 + Q3_5 * w253 - Q3_0 * w228 - Q3_1 * w242
            - Q3_2 * w243;
        const double w254 = M4_1 * w190;
        const double w255 = 1.5 + 0.1 * Q4_7 - Q4_8;
        const double w256 = 0.1 * Q4_1 - Q4_2;
        const double w257 = 0.1 * Q4_4 - Q4_5;
        const double w258 = 1.0 / sqrt(w256 * w256 + w257 * w257 + w255 * w255);
        const double w259 = w258 * w258 * (0.5 * w258);
        const double w260 = 2.0 * w257 * w259;
        const double w261 = 1.5 - 0.1 * Q4_7 - Q4_8;
        const double w262 = -0.1 * Q4_1 - Q4_2;
        const double w263 = -0.1 * Q4_4 - Q4_5;
        const double w264 = sqrt(w262 * w262 + w263 * w263 + w261 * w261);
        const double w265 = 1.0 / w264;
        const double w266 = -1.0 / w264 * w265 * (0.5 * w265);
        const double w267 = 2.0 * w263 * w266;
        const double w268 = 0.1 * w267 - 0.1 * w260 + M4_1 * w191;
        const double w269 = w260 + w267 + M4_1 * w192;
        const double w270 = M4_2 * w190;
        const double w271 = 2.0 * w255 * w259;
        const double w272 = 2.0 * w261 * w266;
        const double w273 = 0.1 * w272 - 0.1 * w271 + M4_2 * w191;
        const double w274 = w271 - 1.0 + w272 + M4_2 * w192;
        const double r4_0 = Q4_6 * w254 + Q4_7 * w268 + Q4_8 * w269 - Q4_3 * w270 - Q4_4 * w273
            - Q4_5 * w274;
        const double w275 = M4_0 * w190;
        const double w276 = 2.0 * w256 * w259;
        const double w277 = 2.0 * w262 * w266;
        const double w278 = 0.1 * w277 - 0.1 * w276 + M4_0 * w191;
        const double w279 = w276 + w277 + M4_0 * w192;
        const double r4_1 = Q4_0 * w270 - (Q4_6 * w275 + Q4_7 * w278 + Q4_8 * w279) + Q4_1 * w273
            + Q4_2 * w274;
        const double r4_2 = Q4_3 * w275 + Q4_4 * w278 + Q4_5 * w279 - Q4_0 * w254 - Q4_1 * w268
            - Q4_2 * w269;
        const double change_xi1_0 = fabs(f1_0 - xi1_0);
        const double change_xi1_1 = fabs(f1_1 - xi1_1);
        const double change_xi1_2 = fabs(f1_2 - xi1_2);
        const double change_xi2_0 = fabs(f2_0 - xi2_0);
        const double change_xi2_1 = fabs(f2_1 - xi2_1);
        const double change_xi2_2 = fabs(f2_2 - xi2_2);
        const double change_xi3_0 = fabs(f3_0 - xi3_0);
        const double change_xi3_1 = fabs(f3_1 - xi3_1);
        const double change_xi3_2 = fabs(f3_2 - xi3_2);
        const double change_xi4_0 = fabs(f4_0 - xi4_0);
        const double change_xi4_1 = fabs(f4_1 - xi4_1);
        const double change_xi4_2 = fabs(f4_2 - xi4_2);
        const double change_n1_0 = fabs(r1_0 - n1_0);
        const double change_n1_1 = fabs(r1_1 - n1_1);
        const double change_n1_2 = fabs(r1_2 - n1_2);
        const double change_n2_0 = fabs(r2_0 - n2_0);
        const double change_n2_1 = fabs(r2_1 - n2_1);
        const double change_n2_2 = fabs(r2_2 - n2_2);
        const double change_n3_0 = fabs(r3_0 - n3_0);
        const double change_n3_1 = fabs(r3_1 - n3_1);
        const double change_n3_2 = fabs(r3_2 - n3_2);
        const double change_n4_0 = fabs(r4_0 - n4_0);
        const double change_n4_1 = fabs(r4_1 - n4_1);
        const double change_n4_2 = fabs(r4_2 - n4_2);
        const double change = greater(greater(greater(greater(change_xi1_0, greater(change_xi1_1,
            change_xi1_2)), greater(change_xi2_0, greater(change_xi2_1, change_xi2_2))),
            greater(greater(change_xi3_0, greater(change_xi3_1, change_xi3_2)),
            greater(change_xi4_0, greater(change_xi4_1, change_xi4_2)))),
            greater(greater(greater(change_n1_0, greater(change_n1_1, change_n1_2)),
            greater(change_n2_0, greater(change_n2_1, change_n2_2))), greater(greater(change_n3_0,
            greater(change_n3_1, change_n3_2)), greater(change_n4_0, greater(change_n4_1,
            change_n4_2)))));
        const double scale = greater(greater(greater(greater(1.0, greater(fabs(xi1_0),
            fabs(xi1_1))), greater(fabs(xi1_2), greater(fabs(xi2_0), fabs(xi2_1)))),
            greater(greater(fabs(xi2_2), greater(fabs(xi3_0), fabs(xi3_1))), greater(fabs(xi3_2),
            greater(fabs(xi4_0), fabs(xi4_1))))), greater(greater(greater(fabs(xi4_2),
            greater(fabs(n1_0), fabs(n1_1))), greater(fabs(n1_2), greater(fabs(n2_0), fabs(n2_1)))),
            greater(greater(fabs(n2_2), greater(fabs(n3_0), fabs(n3_1))),
            greater(greater(fabs(n3_2), fabs(n4_0)), greater(fabs(n4_1), fabs(n4_2))))));
        if (!isfinite(change_xi1_0 + change_xi1_1 + change_xi1_2 + change_xi2_0 + change_xi2_1
            + change_xi2_2 + change_xi3_0 + change_xi3_1 + change_xi3_2 + change_xi4_0
            + change_xi4_1 + change_xi4_2 + change_n1_0 + change_n1_1 + change_n1_2 + change_n2_0
            + change_n2_1 + change_n2_2 + change_n3_0 + change_n3_1 + change_n3_2 + change_n4_0
            + change_n4_1 + change_n4_2)) {
            count_sweeps(statistics, 0, sweep, 1);
            return DIPOLE_VCF_CF4_NOT_FINITE;
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
            return DIPOLE_VCF_CF4_NOT_CONVERGED;
        }
        previous_1 = change;
        xi1_0 = f1_0;
        xi1_1 = f1_1;
        xi1_2 = f1_2;
        xi2_0 = f2_0;
        xi2_1 = f2_1;
        xi2_2 = f2_2;
        xi3_0 = f3_0;
        xi3_1 = f3_1;
        xi3_2 = f3_2;
        xi4_0 = f4_0;
        xi4_1 = f4_1;
        xi4_2 = f4_2;
        n1_0 = r1_0;
        n1_1 = r1_1;
        n1_2 = r1_2;
        n2_0 = r2_0;
        n2_1 = r2_1;
        n2_2 = r2_2;
        n3_0 = r3_0;
        n3_1 = r3_1;
        n3_2 = r3_2;
        n4_0 = r4_0;
        n4_1 = r4_1;
        n4_2 = r4_2;
    }
    const double xe2_1 = w126 * f1_1 + w125 * (f2_1 + f3_1) + w90 * f4_1;
    const double xe2_0 = w126 * f1_0 + w125 * (f2_0 + f3_0) + w90 * f4_0;
    const double xe2_2 = w126 * f1_2 + w125 * (f2_2 + f3_2) + w90 * f4_2;
    const double w280 = xe2_0 * xe2_0 + xe2_1 * xe2_1 + xe2_2 * xe2_2;
    double c1_5, c2_10;
    stumpff_12(w280, &c1_5, &c2_10);
    const double w282 = xe2_1 * c2_10;
    const double w283 = xe2_1 * w282;
    const double w284 = xe2_2 * c2_10 * xe2_2;
    const double ge2_0 = 1.0 - (w283 + w284);
    const double w285 = xe2_0 * c2_10;
    const double w286 = xe2_1 * w285;
    const double w288 = xe2_2 * c1_5;
    const double ge2_1 = w286 - w288;
    const double w289 = xe2_1 * c1_5;
    const double w290 = xe2_2 * w285;
    const double ge2_2 = w289 + w290;
    const double e2_0 = ge1_0 * ge2_0 + ge1_3 * ge2_1 + ge1_6 * ge2_2;
    const double e2_1 = ge1_1 * ge2_0 + ge1_4 * ge2_1 + ge1_7 * ge2_2;
    const double e2_2 = ge1_2 * ge2_0 + ge1_5 * ge2_1 + ge1_8 * ge2_2;
    const double ge2_3 = w286 + w288;
    const double w291 = xe2_0 * w285;
    const double ge2_4 = 1.0 - (w284 + w291);
    const double w292 = xe2_2 * w282;
    const double w293 = xe2_0 * c1_5;
    const double ge2_5 = w292 - w293;
    const double e2_3 = ge1_0 * ge2_3 + ge1_3 * ge2_4 + ge1_6 * ge2_5;
    const double e2_4 = ge1_1 * ge2_3 + ge1_4 * ge2_4 + ge1_7 * ge2_5;
    const double e2_5 = ge1_2 * ge2_3 + ge1_5 * ge2_4 + ge1_8 * ge2_5;
    const double ge2_6 = w290 - w289;
    const double ge2_7 = w292 + w293;
    const double ge2_8 = 1.0 - (w283 + w291);
    const double e2_6 = ge1_0 * ge2_6 + ge1_3 * ge2_7 + ge1_6 * ge2_8;
    const double e2_7 = ge1_1 * ge2_6 + ge1_4 * ge2_7 + ge1_7 * ge2_8;
    const double e2_8 = ge1_2 * ge2_6 + ge1_5 * ge2_7 + ge1_8 * ge2_8;
    const double w294 = 0.3333333333333333 * h;
    const double mubar_0 = mu0 + (nu2_0 + nu3_0) * w294 + w125 * (nu4_0 + r1_0);
    const double mubar_1 = mu1 + w294 * (nu2_1 + nu3_1) + w125 * (nu4_1 + r1_1);
    const double mubar_2 = mu2 + w294 * (nu2_2 + nu3_2) + w125 * (nu4_2 + r1_2);
    const double new_g00 = g00 * e2_0 + g10 * e2_1 + g20 * e2_2;
    const double new_g01 = g01 * e2_0 + g11 * e2_1 + g21 * e2_2;
    const double new_g02 = g02 * e2_0 + g12 * e2_1 + g22 * e2_2;
    const double new_g10 = g00 * e2_3 + g10 * e2_4 + g20 * e2_5;
    const double new_g11 = g01 * e2_3 + g11 * e2_4 + g21 * e2_5;
    const double new_g12 = g02 * e2_3 + g12 * e2_4 + g22 * e2_5;
    const double new_g20 = g00 * e2_6 + g10 * e2_7 + g20 * e2_8;
    const double new_g21 = g01 * e2_6 + g11 * e2_7 + g21 * e2_8;
    const double new_g22 = g02 * e2_6 + g12 * e2_7 + g22 * e2_8;
    const double new_mu0 = e2_0 * mubar_0 + e2_1 * mubar_1 + e2_2 * mubar_2;
    const double new_mu1 = e2_3 * mubar_0 + e2_4 * mubar_1 + e2_5 * mubar_2;
    const double new_mu2 = e2_6 * mubar_0 + e2_7 * mubar_1 + e2_8 * mubar_2;
    if (!(isfinite(new_g00) && isfinite(new_g01) && isfinite(new_g02) && isfinite(new_g10)
        && isfinite(new_g11) && isfinite(new_g12) && isfinite(new_g20) && isfinite(new_g21)
        && isfinite(new_g22) && isfinite(new_mu0) && isfinite(new_mu1) && isfinite(new_mu2))) {
        return DIPOLE_VCF_CF4_NOT_FINITE;
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
    return DIPOLE_VCF_CF4_OK;
}

int dipole_vcf_cf4_step(double state[static 12], double h,
    dipole_vcf_cf4_statistics *statistics)
{
    return advance(state, h, statistics);
}

int dipole_vcf_cf4_run(double state[static 12], double h, size_t steps, double *trajectory,
    size_t stride, dipole_vcf_cf4_statistics *statistics, size_t *completed)
{
    int status = DIPOLE_VCF_CF4_OK;
    size_t step = 0;
    double *row = stride > 0 ? trajectory : NULL;
    if (row != NULL) {
        memcpy(row, state, 12 * sizeof *state);
    }
    while (step < steps) {
        status = advance(state, h, statistics);
        if (status != DIPOLE_VCF_CF4_OK) {
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
