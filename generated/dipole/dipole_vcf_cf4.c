/*
 * Dipole on a stick, T*SO(3) (thesis section 3.6): one step by vcf:cf4
 *
 * method:     family vcf, tableau cf4
 * source:     Celledoni, Marthinsen and Owren 2003; H. Marthinsen, thesis, Section 2.2.1
 * order:      4, certificate: exact (every order condition up to it is zero in exact arithmetic)
 * scene:      Dipole on a stick, T*SO(3) (thesis section 3.6), group SO(3)
 * solved by:  the equations of xi1, xi2, xi3, xi4, n1, n2, n3, n4: fixed point, 12 unknowns (3.0
 *             sweeps of 1065 operations a step; Newton's method: 2.5 sweeps of 1341 operations and
 *             0.05 matrices of 11276; Newton's method with the matrix to first order in h: 2.3
 *             sweeps of 1341 operations and 1.00 matrices of 3992)
 * state:      [0..8] q: element of SO(3), row by row
 *             [9..11] mu: right-trivialised momentum in the dual algebra of SO(3)
 * left out:   1 Adt, 23 Adtinv, 5 mul (zeros)
 *             16 Adtinv, 31 dexpt, 1 exp, 4 identity, 2 lin (sharing)
 *             1 identity (dead code)
 *             1 dexpt (factors)
 *             4 Adtinv, 8 dexpt (common sums)
 *             1 lin (cancellation)
 *             1 lin (sharing)
 *             5 hamilton (body frame)
 *             3 Adt (opposites)
 *             6 Adtinv, 1 force (dead code)
 *             1 lin (sharing)
 *             5 dexpt (functions)
 *             3 Adinv, 4 legendre (sharing)
 *             parameters, folded: beta = 1, depth = 3/2
 *             the time: the scene does not depend on it
 * operations: 89 add, 131 mul, 2 sqrt, 2 div, 1 stumpff_12 a step
 *             2 mul a start, in steps that follow no other
 *             327 add, 489 mul, 6 div, 6 sqrt, 4 stumpff_12, 5 stumpff_23 a sweep of the equations
 *             of xi1, xi2, xi3, xi4, n1, n2, n3, n4
 * stack:      at most 4864 bytes, without what the mathematical library takes
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

/* For z > 1/16 and s = sqrt(z): c_1 = sin(s)/s, c_2 = (1 - cos(s))/s^2 */
static void stumpff_12_far(double z, double *c1, double *c2)
{
    if (z <= 1.0) {
        *c1 = stumpff_series_1(z);
        *c2 = stumpff_series_2(z);
        return;
    }
    const double half = 0.5 * sqrt(z <= 4503599627370496.0 ? z : NAN);
    const double sine = sin(half);
    const double cosine = cos(half);
    const double ratio = sine / half;
    *c1 = ratio * cosine;
    *c2 = 0.5 * (ratio * ratio);
}

/* For z >= 0 and s = sqrt(z): c_1 = sin(s)/s, c_2 = (1 - cos(s))/s^2 */
static inline void stumpff_12(double z, double *c1, double *c2)
{
    if (z <= 0.0625) {
        *c1 = stumpff_small_1(z);
        *c2 = stumpff_small_2(z);
    } else {
        stumpff_12_far(z, c1, c2);
    }
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

/* What one step of a run leaves for the next: solutions of its equations, the latest first. */
struct memory {
    size_t known;
    double first;
    double past[9][12];
    double rate_1;
};

/* Factors of the last solutions, by how many are known, in the value of their polynomial a step later. */
static const double weights[9][9] = {
    {1.0},
    {2.0, -1.0},
    {3.0, -3.0, 1.0},
    {4.0, -6.0, 4.0, -1.0},
    {5.0, -10.0, 10.0, -5.0, 1.0},
    {6.0, -15.0, 20.0, -15.0, 6.0, -1.0},
    {7.0, -21.0, 35.0, -35.0, 21.0, -7.0, 1.0},
    {8.0, -28.0, 56.0, -70.0, 56.0, -28.0, 8.0, -1.0},
    {9.0, -36.0, 84.0, -126.0, 126.0, -84.0, 36.0, -9.0, 1.0}
};

static inline double extrapolated(const struct memory *memory, size_t i)
{
    const double *const weight = weights[memory->known - 1];
    double total = weight[0] * memory->past[0][i];
    for (size_t k = 1; k < memory->known; k++) {
        total += weight[k] * memory->past[k][i];
    }
    return total;
}

static inline int advance(double state[static 12], double h, struct memory *memory,
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
    const double m_0 = g00 * mu0 + g10 * mu1 + g20 * mu2;
    const double m_1 = g01 * mu0 + g11 * mu1 + g21 * mu2;
    const double m_2 = g02 * mu0 + g12 * mu1 + g22 * mu2;
    double xi1_0, xi1_1, xi1_2, xi2_0, xi2_1, xi2_2, xi3_0, xi3_1, xi3_2, xi4_0, xi4_1, xi4_2;
    if (memory->known > 0) {
        xi1_0 = extrapolated(memory, 0);
        xi1_1 = extrapolated(memory, 1);
        xi1_2 = extrapolated(memory, 2);
        xi2_0 = extrapolated(memory, 3);
        xi2_1 = extrapolated(memory, 4);
        xi2_2 = extrapolated(memory, 5);
        xi3_0 = extrapolated(memory, 6);
        xi3_1 = extrapolated(memory, 7);
        xi3_2 = extrapolated(memory, 8);
        xi4_0 = extrapolated(memory, 9);
        xi4_1 = extrapolated(memory, 10);
        xi4_2 = extrapolated(memory, 11);
    } else {
        const double Wxi0_0 = 0.9900990099009901 * m_0;
        const double Wxi0_2 = 100.0 * m_2;
        xi1_0 = Wxi0_0;
        xi1_1 = m_1;
        xi1_2 = Wxi0_2;
        xi2_0 = Wxi0_0;
        xi2_1 = m_1;
        xi2_2 = Wxi0_2;
        xi3_0 = Wxi0_0;
        xi3_1 = m_1;
        xi3_2 = Wxi0_2;
        xi4_0 = Wxi0_0;
        xi4_1 = m_1;
        xi4_2 = Wxi0_2;
    }
    const double w1 = -0.5 * h;
    const double w2 = 0.5 * h;
    const double w60 = 0.16666666666666666 * h;
    const double w61 = -2.0 * g22;
    const double w62 = 1.5 + w61;
    const double w63 = -0.2 * g21;
    const double w64 = w62 + w63;
    const double w65 = 1.5 * w64;
    const double w66 = 1.01 + w65;
    const double w67 = sqrt(w66);
    const double w68 = 1.0 / w67;
    const double w69 = w68 * w68;
    const double w70 = 0.5 * w68;
    const double w71 = w69 * w70;
    const double w72 = 1.5 * w71;
    const double w73 = 0.2 * g21;
    const double w74 = w62 + w73;
    const double w75 = 1.5 * w74;
    const double w76 = 1.01 + w75;
    const double w77 = sqrt(w76);
    const double w78 = 1.0 / w77;
    const double w79 = w78 * w78;
    const double w80 = 0.5 * w78;
    const double w81 = w79 * w80;
    const double w82 = 1.5 * w81;
    const double w83 = w72 - w82;
    const double w84 = -2.0 * w83;
    const double w85 = w84 - 1.0;
    const double w86 = g21 * w85;
    const double w87 = -0.3 * w71;
    const double w88 = -0.3 * w81;
    const double w89 = w87 + w88;
    const double w90 = g22 * w89;
    const double w91 = w86 - w90;
    const double w113 = 0.3333333333333333 * h;
    const double w114 = -0.25 * h;
    const double w116 = -0.16666666666666666 * h;
    const double w118 = 0.08333333333333333 * h;
    const double w125 = g20 * w89;
    const double w126 = g20 * w85;
    const double w132 = 0.25 * h;
    const double w134 = -0.08333333333333333 * h;
    /* the equations of xi1, xi2, xi3, xi4, n1, n2, n3, n4: fixed point in xi1_0, xi1_1, xi1_2, xi2_0, xi2_1, xi2_2, xi3_0, xi3_1, xi3_2, xi4_0, xi4_1, xi4_2 */
    double s_p1_0, s_p1_2, s_p1_1, w133, w135, w136, ge1_0, ge1_1, ge1_2, ge1_6, ge1_7, ge1_8,
        ge1_3, ge1_4, ge1_5;
    double previous_1 = 0.0;
    double rate_1 = memory->known > 0 ? memory->rate_1 : 1.0;
    for (size_t sweep = 1;; sweep++) {
        const double xE2_1_1 = xi1_1 * w2;
        const double xE2_1_0 = xi1_0 * w2;
        const double xE2_1_2 = xi1_2 * w2;
        const double w3 = xE2_1_0 * xE2_1_0 + xE2_1_1 * xE2_1_1 + xE2_1_2 * xE2_1_2;
        double c1_1, c2_1;
        stumpff_12(w3, &c1_1, &c2_1);
        const double w5 = xE2_1_1 * c1_1;
        const double w7 = xE2_1_0 * c2_1;
        const double w8 = xE2_1_2 * w7;
        const double gE2_1_2 = w5 + w8;
        const double yE2_1_1 = xi1_1 * w1;
        const double w9 = h * xi3_1;
        const double xE4_2_1 = yE2_1_1 + w9;
        const double yE2_1_0 = xi1_0 * w1;
        const double w10 = h * xi3_0;
        const double xE4_2_0 = yE2_1_0 + w10;
        const double yE2_1_2 = xi1_2 * w1;
        const double w11 = h * xi3_2;
        const double xE4_2_2 = yE2_1_2 + w11;
        const double w12 = xE4_2_0 * xE4_2_0 + xE4_2_1 * xE4_2_1 + xE4_2_2 * xE4_2_2;
        double c1_2, c2_2;
        stumpff_12(w12, &c1_2, &c2_2);
        const double w14 = xE4_2_1 * c2_2;
        const double w15 = xE4_2_1 * w14;
        const double w16 = xE4_2_2 * c2_2 * xE4_2_2;
        const double gE4_2_0 = 1.0 - (w15 + w16);
        const double w17 = xE2_1_1 * c2_1;
        const double w18 = xE2_1_2 * w17;
        const double w19 = xE2_1_0 * c1_1;
        const double gE2_1_5 = w18 - w19;
        const double w20 = xE4_2_0 * c2_2;
        const double w21 = xE4_2_1 * w20;
        const double w23 = xE4_2_2 * c1_2;
        const double gE4_2_1 = w21 - w23;
        const double w24 = xE2_1_0 * w7;
        const double w25 = xE2_1_1 * w17;
        const double gE2_1_8 = 1.0 - (w24 + w25);
        const double w26 = xE4_2_1 * c1_2;
        const double w27 = xE4_2_2 * w20;
        const double gE4_2_2 = w26 + w27;
        const double E4_2_2 = gE2_1_2 * gE4_2_0 + gE2_1_5 * gE4_2_1 + gE2_1_8 * gE4_2_2;
        const double gE4_2_3 = w21 + w23;
        const double w28 = xE4_2_0 * w20;
        const double gE4_2_4 = 1.0 - (w16 + w28);
        const double w29 = xE4_2_2 * w14;
        const double w30 = xE4_2_0 * c1_2;
        const double gE4_2_5 = w29 - w30;
        const double E4_2_5 = gE2_1_2 * gE4_2_3 + gE2_1_5 * gE4_2_4 + gE2_1_8 * gE4_2_5;
        const double gE4_2_6 = w27 - w26;
        const double gE4_2_7 = w29 + w30;
        const double gE4_2_8 = 1.0 - (w15 + w28);
        const double E4_2_8 = gE2_1_2 * gE4_2_6 + gE2_1_5 * gE4_2_7 + gE2_1_8 * gE4_2_8;
        const double p_4_2 = 0.01 * (xi4_0 * E4_2_2 + xi4_1 * E4_2_5 + xi4_2 * E4_2_8);
        const double w31 = xE2_1_1 * w7;
        const double w32 = xE2_1_2 * c1_1;
        const double gE2_1_1 = w31 - w32;
        const double w33 = xE2_1_2 * c2_1 * xE2_1_2;
        const double gE2_1_4 = 1.0 - (w24 + w33);
        const double gE2_1_7 = w18 + w19;
        const double E4_2_1 = gE4_2_0 * gE2_1_1 + gE4_2_1 * gE2_1_4 + gE4_2_2 * gE2_1_7;
        const double E4_2_4 = gE4_2_3 * gE2_1_1 + gE4_2_4 * gE2_1_4 + gE4_2_5 * gE2_1_7;
        const double E4_2_7 = gE4_2_6 * gE2_1_1 + gE4_2_7 * gE2_1_4 + gE4_2_8 * gE2_1_7;
        const double a_5_1 = xi4_0 * E4_2_1 + xi4_1 * E4_2_4 + xi4_2 * E4_2_7;
        const double Q4_7 = g20 * E4_2_1 + g21 * E4_2_4 + g22 * E4_2_7;
        const double Q4_8 = g20 * E4_2_2 + g21 * E4_2_5 + g22 * E4_2_8;
        const double w34 = 1.5 - 2.0 * Q4_8;
        const double w35 = 1.0 / sqrt(1.01 + 1.5 * (w34 - 0.2 * Q4_7));
        const double w36 = w35 * w35 * (0.5 * w35);
        const double w37 = 1.0 / sqrt(1.01 + 1.5 * (w34 + 0.2 * Q4_7));
        const double w38 = w37 * w37 * (0.5 * w37);
        const double w39 = -1.0 - 2.0 * (1.5 * w36 - 1.5 * w38);
        const double w40 = -0.3 * w36 - 0.3 * w38;
        const double Nr4_0 = Q4_7 * w39 - Q4_8 * w40 + 99.0 * a_5_1 * p_4_2;
        const double p_2_2 = 0.01 * (xi2_0 * gE2_1_2 + xi2_1 * gE2_1_5 + xi2_2 * gE2_1_8);
        const double a_1 = xi2_0 * gE2_1_1 + xi2_1 * gE2_1_4 + xi2_2 * gE2_1_7;
        const double Q2_7 = g20 * gE2_1_1 + g21 * gE2_1_4 + g22 * gE2_1_7;
        const double Q2_8 = g20 * gE2_1_2 + g21 * gE2_1_5 + g22 * gE2_1_8;
        const double w41 = 1.5 - 2.0 * Q2_8;
        const double w42 = 1.0 / sqrt(1.01 + 1.5 * (w41 - 0.2 * Q2_7));
        const double w43 = w42 * w42 * (0.5 * w42);
        const double w44 = 1.0 / sqrt(1.01 + 1.5 * (w41 + 0.2 * Q2_7));
        const double w45 = w44 * w44 * (0.5 * w44);
        const double w46 = -1.0 - 2.0 * (1.5 * w43 - 1.5 * w45);
        const double w47 = -0.3 * w43 - 0.3 * w45;
        const double sum_Nr4_0 = Nr4_0 + 2.0 * (Q2_7 * w46 - Q2_8 * w47 + 99.0 * a_1 * p_2_2);
        const double s_nu2_0 = w1 * sum_Nr4_0;
        const double w48 = yE2_1_0 * yE2_1_0 + yE2_1_1 * yE2_1_1 + yE2_1_2 * yE2_1_2;
        double c2_3, c3_1;
        stumpff_23(w48, &c2_3, &c3_1);
        const double gE2_1_0 = 1.0 - (w25 + w33);
        const double gE2_1_3 = w31 + w32;
        const double gE2_1_6 = w8 - w5;
        const double E4_2_0 = gE4_2_0 * gE2_1_0 + gE4_2_1 * gE2_1_3 + gE4_2_2 * gE2_1_6;
        const double E4_2_3 = gE4_2_3 * gE2_1_0 + gE4_2_4 * gE2_1_3 + gE4_2_5 * gE2_1_6;
        const double E4_2_6 = gE4_2_6 * gE2_1_0 + gE4_2_7 * gE2_1_3 + gE4_2_8 * gE2_1_6;
        const double a_5_0 = xi4_0 * E4_2_0 + xi4_1 * E4_2_3 + xi4_2 * E4_2_6;
        const double Q4_6 = g20 * E4_2_0 + g21 * E4_2_3 + g22 * E4_2_6;
        const double Nr4_2 = 0.01 * a_5_0 * a_5_1 + w40 * Q4_6;
        const double a_0 = xi2_0 * gE2_1_0 + xi2_1 * gE2_1_3 + xi2_2 * gE2_1_6;
        const double Q2_6 = g20 * gE2_1_0 + g21 * gE2_1_3 + g22 * gE2_1_6;
        const double sum_Nr4_2 = Nr4_2 + 2.0 * (0.01 * a_0 * a_1 + w47 * Q2_6);
        const double s_nu2_2 = w1 * sum_Nr4_2;
        const double Nr4_1 = -100.0 * a_5_0 * p_4_2 - w39 * Q4_6;
        const double sum_Nr4_1 = Nr4_1 + 2.0 * (-100.0 * a_0 * p_2_2 - w46 * Q2_6);
        const double s_nu2_1 = w1 * sum_Nr4_1;
        const double w50 = yE2_1_1 * s_nu2_2 - yE2_1_2 * s_nu2_1;
        const double w52 = yE2_1_0 * s_nu2_1 - yE2_1_1 * s_nu2_0;
        const double w53 = yE2_1_2 * s_nu2_0 - yE2_1_0 * s_nu2_2;
        const double m1_13_0 = gE2_1_1 * Nr4_1 + Nr4_0 * gE2_1_0 + gE2_1_2 * Nr4_2;
        const double yE4_2_0 = xE2_1_0 - w10;
        const double yE4_2_1 = xE2_1_1 - w9;
        const double yE4_2_2 = xE2_1_2 - w11;
        const double w54 = yE4_2_0 * yE4_2_0 + yE4_2_1 * yE4_2_1 + yE4_2_2 * yE4_2_2;
        double c2_4, c3_2;
        stumpff_23(w54, &c2_4, &c3_2);
        const double m1_13_2 = gE2_1_7 * Nr4_1 + Nr4_0 * gE2_1_6 + gE2_1_8 * Nr4_2;
        const double m1_13_1 = gE2_1_4 * Nr4_1 + Nr4_0 * gE2_1_3 + gE2_1_5 * Nr4_2;
        const double w56 = yE4_2_1 * m1_13_2 - yE4_2_2 * m1_13_1;
        const double w58 = yE4_2_0 * m1_13_1 - m1_13_0 * yE4_2_1;
        const double w59 = m1_13_0 * yE4_2_2 - yE4_2_0 * m1_13_2;
        const double p1_13_0 = m1_13_0 - w56 * c2_4 + (yE4_2_1 * w58 - yE4_2_2 * w59) * c3_2;
        const double p_2 = 0.01 * xi1_2;
        const double xE3_1_1 = xi2_1 * w2;
        const double xE3_1_0 = xi2_0 * w2;
        const double xE3_1_2 = xi2_2 * w2;
        const double w92 = xE3_1_0 * xE3_1_0 + xE3_1_1 * xE3_1_1 + xE3_1_2 * xE3_1_2;
        double c1_3, c2_5;
        stumpff_12(w92, &c1_3, &c2_5);
        const double w94 = xE3_1_1 * c1_3;
        const double w96 = xE3_1_0 * c2_5;
        const double w97 = xE3_1_2 * w96;
        const double gE3_1_2 = w94 + w97;
        const double w98 = xE3_1_1 * c2_5;
        const double w99 = xE3_1_2 * w98;
        const double w100 = xE3_1_0 * c1_3;
        const double gE3_1_5 = w99 - w100;
        const double w101 = xE3_1_0 * w96;
        const double w102 = xE3_1_1 * w98;
        const double gE3_1_8 = 1.0 - (w101 + w102);
        const double p_3_2 = 0.01 * (xi3_0 * gE3_1_2 + xi3_1 * gE3_1_5 + xi3_2 * gE3_1_8);
        const double w103 = xE3_1_1 * w96;
        const double w104 = xE3_1_2 * c1_3;
        const double gE3_1_1 = w103 - w104;
        const double w105 = xE3_1_2 * c2_5 * xE3_1_2;
        const double gE3_1_4 = 1.0 - (w101 + w105);
        const double gE3_1_7 = w99 + w100;
        const double a_3_1 = xi3_0 * gE3_1_1 + xi3_1 * gE3_1_4 + xi3_2 * gE3_1_7;
        const double Q3_7 = g20 * gE3_1_1 + g21 * gE3_1_4 + g22 * gE3_1_7;
        const double Q3_8 = g20 * gE3_1_2 + g21 * gE3_1_5 + g22 * gE3_1_8;
        const double w106 = 1.5 - 2.0 * Q3_8;
        const double w107 = 1.0 / sqrt(1.01 + 1.5 * (w106 - 0.2 * Q3_7));
        const double w108 = w107 * w107 * (0.5 * w107);
        const double w109 = 1.0 / sqrt(1.01 + 1.5 * (w106 + 0.2 * Q3_7));
        const double w110 = w109 * w109 * (0.5 * w109);
        const double w111 = -1.0 - 2.0 * (1.5 * w108 - 1.5 * w110);
        const double w112 = -0.3 * w108 - 0.3 * w110;
        const double Nr3_0 = Q3_7 * w111 - Q3_8 * w112 + 99.0 * a_3_1 * p_3_2;
        s_p1_0 = m_0 + w60 * (w91 + 99.0 * xi1_1 * p_2 + sum_Nr4_0) + Nr3_0 * w113;
        const double w115 = xi2_0 + xi3_0;
        const double w117 = w115 * w116;
        const double ye1_0 = xi1_0 * w114 + w117 + xi4_0 * w118;
        const double w119 = xi2_1 + xi3_1;
        const double w120 = w116 * w119;
        const double ye1_1 = xi1_1 * w114 + w120 + xi4_1 * w118;
        const double w121 = xi2_2 + xi3_2;
        const double w122 = w116 * w121;
        const double ye1_2 = xi1_2 * w114 + w122 + xi4_2 * w118;
        const double w123 = ye1_0 * ye1_0 + ye1_1 * ye1_1 + ye1_2 * ye1_2;
        double c2_6, c3_3;
        stumpff_23(w123, &c2_6, &c3_3);
        const double gE3_1_0 = 1.0 - (w102 + w105);
        const double gE3_1_3 = w103 + w104;
        const double gE3_1_6 = w97 - w94;
        const double a_3_0 = xi3_0 * gE3_1_0 + xi3_1 * gE3_1_3 + xi3_2 * gE3_1_6;
        const double Q3_6 = g20 * gE3_1_0 + g21 * gE3_1_3 + g22 * gE3_1_6;
        const double Nr3_2 = 0.01 * a_3_0 * a_3_1 + w112 * Q3_6;
        s_p1_2 = m_2 + w60 * (0.01 * xi1_0 * xi1_1 + w125 + sum_Nr4_2) + w113 * Nr3_2;
        const double Nr3_1 = -100.0 * a_3_0 * p_3_2 - w111 * Q3_6;
        s_p1_1 = m_1 + w60 * (-100.0 * xi1_0 * p_2 - w126 + sum_Nr4_1) + w113 * Nr3_1;
        const double w127 = ye1_1 * s_p1_2 - ye1_2 * s_p1_1;
        const double w129 = ye1_0 * s_p1_1 - s_p1_0 * ye1_1;
        const double w130 = s_p1_0 * ye1_2 - ye1_0 * s_p1_2;
        const double p1_11_0 = s_p1_0 - w127 * c2_6 + (ye1_1 * w129 - ye1_2 * w130) * c3_3;
        const double w131 = s_nu2_0 - w50 * c2_3 + (yE2_1_1 * w52 - yE2_1_2 * w53) * c3_1
            + w2 * p1_13_0 + 1.5 * p1_11_0;
        w133 = w60 * w119;
        const double xe1_1 = xi1_1 * w132 + w133 + xi4_1 * w134;
        w135 = w60 * w115;
        const double xe1_0 = xi1_0 * w132 + w135 + xi4_0 * w134;
        w136 = w60 * w121;
        const double xe1_2 = xi1_2 * w132 + w136 + xi4_2 * w134;
        const double w137 = xe1_0 * xe1_0 + xe1_1 * xe1_1 + xe1_2 * xe1_2;
        double c1_4, c2_7;
        stumpff_12(w137, &c1_4, &c2_7);
        const double w139 = xe1_1 * c2_7;
        const double w140 = xe1_1 * w139;
        const double w141 = xe1_2 * c2_7 * xe1_2;
        ge1_0 = 1.0 - (w140 + w141);
        const double w142 = xe1_0 * c2_7;
        const double w143 = xe1_1 * w142;
        const double w145 = xe1_2 * c1_4;
        ge1_1 = w143 - w145;
        const double w146 = xe1_1 * c1_4;
        const double w147 = xe1_2 * w142;
        ge1_2 = w146 + w147;
        const double m1_6_2_0 = s_p1_0 * ge1_0 + s_p1_1 * ge1_1 + s_p1_2 * ge1_2;
        const double ye2_0 = w117 + xi1_0 * w118 + xi4_0 * w114;
        const double ye2_1 = w120 + xi1_1 * w118 + xi4_1 * w114;
        const double ye2_2 = w122 + xi1_2 * w118 + xi4_2 * w114;
        const double w148 = ye2_0 * ye2_0 + ye2_1 * ye2_1 + ye2_2 * ye2_2;
        double c2_8, c3_4;
        stumpff_23(w148, &c2_8, &c3_4);
        ge1_6 = w147 - w146;
        const double w150 = xe1_0 * c1_4;
        const double w151 = xe1_2 * w139;
        ge1_7 = w150 + w151;
        const double w152 = xe1_0 * w142;
        ge1_8 = 1.0 - (w140 + w152);
        const double m1_6_2_2 = s_p1_0 * ge1_6 + s_p1_1 * ge1_7 + s_p1_2 * ge1_8;
        ge1_3 = w143 + w145;
        ge1_4 = 1.0 - (w141 + w152);
        ge1_5 = w151 - w150;
        const double m1_6_2_1 = s_p1_0 * ge1_3 + s_p1_1 * ge1_4 + s_p1_2 * ge1_5;
        const double w153 = ye2_1 * m1_6_2_2 - ye2_2 * m1_6_2_1;
        const double w155 = ye2_0 * m1_6_2_1 - m1_6_2_0 * ye2_1;
        const double w156 = m1_6_2_0 * ye2_2 - ye2_0 * m1_6_2_2;
        const double p1_6_2_0 = m1_6_2_0 - w153 * c2_8 + (ye2_1 * w155 - ye2_2 * w156) * c3_4;
        const double p1_13_1 = m1_13_1 - w59 * c2_4 + (yE4_2_2 * w56 - yE4_2_0 * w58) * c3_2;
        const double p1_11_1 = s_p1_1 - w130 * c2_6 + (ye1_2 * w127 - ye1_0 * w129) * c3_3;
        const double w157 = s_nu2_1 - w53 * c2_3 + (yE2_1_2 * w50 - yE2_1_0 * w52) * c3_1
            + w2 * p1_13_1 + 1.5 * p1_11_1;
        const double p1_6_2_1 = m1_6_2_1 - w156 * c2_8 + (ye2_2 * w153 - ye2_0 * w155) * c3_4;
        const double p1_13_2 = m1_13_2 - w58 * c2_4 + (yE4_2_0 * w59 - yE4_2_1 * w56) * c3_2;
        const double p1_11_2 = s_p1_2 - w129 * c2_6 + (ye1_0 * w130 - ye1_1 * w127) * c3_3;
        const double w158 = s_nu2_2 - w52 * c2_3 + (yE2_1_0 * w53 - yE2_1_1 * w50) * c3_1
            + w2 * p1_13_2 + 1.5 * p1_11_2;
        const double p1_6_2_2 = m1_6_2_2 - w155 * c2_8 + (ye2_0 * w156 - ye2_1 * w153) * c3_4;
        const double w159 = 0.5 * (p1_11_0 + p1_6_2_0);
        const double yE3_1_0 = xi2_0 * w1;
        const double yE3_1_1 = xi2_1 * w1;
        const double yE3_1_2 = xi2_2 * w1;
        const double w160 = yE3_1_0 * yE3_1_0 + yE3_1_1 * yE3_1_1 + yE3_1_2 * yE3_1_2;
        double c2_9, c3_5;
        stumpff_23(w160, &c2_9, &c3_5);
        const double w162 = Nr3_2 * yE3_1_1 - Nr3_1 * yE3_1_2;
        const double w164 = Nr3_1 * yE3_1_0 - Nr3_0 * yE3_1_1;
        const double w165 = Nr3_0 * yE3_1_2 - Nr3_2 * yE3_1_0;
        const double M2_0 = w159
            + w1 * (Nr3_0 - w162 * c2_9 + (yE3_1_1 * w164 - yE3_1_2 * w165) * c3_5);
        const double w166 = 0.5 * (p1_11_1 + p1_6_2_1);
        const double M2_1 = w166
            + w1 * (Nr3_1 - w165 * c2_9 + (yE3_1_2 * w162 - yE3_1_0 * w164) * c3_5);
        const double w167 = 0.5 * (p1_11_2 + p1_6_2_2);
        const double M2_2 = w167
            + w1 * (Nr3_2 - w164 * c2_9 + (yE3_1_0 * w165 - yE3_1_1 * w162) * c3_5);
        const double Wf2_0 = 0.9900990099009901
            * (gE2_1_0 * M2_0 + gE2_1_3 * M2_1 + gE2_1_6 * M2_2);
        const double Pf2_1 = gE2_1_1 * M2_0 + gE2_1_4 * M2_1 + gE2_1_7 * M2_2;
        const double Wf2_2 = 100.0 * (gE2_1_2 * M2_0 + gE2_1_5 * M2_1 + gE2_1_8 * M2_2);
        const double M3_0 = w159 + w1 * p1_13_0;
        const double M3_1 = w166 + w1 * p1_13_1;
        const double M3_2 = w167 + w1 * p1_13_2;
        const double Wf3_0 = 0.9900990099009901
            * (gE3_1_0 * M3_0 + gE3_1_3 * M3_1 + gE3_1_6 * M3_2);
        const double Pf3_1 = gE3_1_1 * M3_0 + gE3_1_4 * M3_1 + gE3_1_7 * M3_2;
        const double Wf3_2 = 100.0 * (gE3_1_2 * M3_0 + gE3_1_5 * M3_1 + gE3_1_8 * M3_2);
        const double M4_0 = 1.5 * p1_6_2_0 - 0.5 * p1_11_0;
        const double M4_1 = 1.5 * p1_6_2_1 - 0.5 * p1_11_1;
        const double M4_2 = 1.5 * p1_6_2_2 - 0.5 * p1_11_2;
        const double Wf4_0 = 0.9900990099009901 * (E4_2_0 * M4_0 + E4_2_3 * M4_1 + E4_2_6 * M4_2);
        const double Pf4_1 = E4_2_1 * M4_0 + E4_2_4 * M4_1 + E4_2_7 * M4_2;
        const double Wf4_2 = 100.0 * (E4_2_2 * M4_0 + E4_2_5 * M4_1 + E4_2_8 * M4_2);
        const double next_xi1_0 = 0.9900990099009901 * (w131 - 0.5 * p1_6_2_0);
        const double next_xi1_1 = w157 - 0.5 * p1_6_2_1;
        const double next_xi1_2 = 100.0 * (w158 - 0.5 * p1_6_2_2);
        const double next_xi2_0 = gE2_1_0 * Wf2_0 + gE2_1_1 * Pf2_1 + gE2_1_2 * Wf2_2;
        const double next_xi2_1 = gE2_1_3 * Wf2_0 + gE2_1_4 * Pf2_1 + gE2_1_5 * Wf2_2;
        const double next_xi2_2 = gE2_1_6 * Wf2_0 + gE2_1_7 * Pf2_1 + gE2_1_8 * Wf2_2;
        const double next_xi3_0 = gE3_1_0 * Wf3_0 + gE3_1_1 * Pf3_1 + gE3_1_2 * Wf3_2;
        const double next_xi3_1 = gE3_1_3 * Wf3_0 + gE3_1_4 * Pf3_1 + gE3_1_5 * Wf3_2;
        const double next_xi3_2 = gE3_1_6 * Wf3_0 + gE3_1_7 * Pf3_1 + gE3_1_8 * Wf3_2;
        const double next_xi4_0 = E4_2_0 * Wf4_0 + E4_2_1 * Pf4_1 + E4_2_2 * Wf4_2;
        const double next_xi4_1 = E4_2_3 * Wf4_0 + E4_2_4 * Pf4_1 + E4_2_5 * Wf4_2;
        const double next_xi4_2 = E4_2_6 * Wf4_0 + E4_2_7 * Pf4_1 + E4_2_8 * Wf4_2;
        const double change_xi1_0 = fabs(next_xi1_0 - xi1_0);
        const double change_xi1_1 = fabs(next_xi1_1 - xi1_1);
        const double change_xi1_2 = fabs(next_xi1_2 - xi1_2);
        const double change_xi2_0 = fabs(next_xi2_0 - xi2_0);
        const double change_xi2_1 = fabs(next_xi2_1 - xi2_1);
        const double change_xi2_2 = fabs(next_xi2_2 - xi2_2);
        const double change_xi3_0 = fabs(next_xi3_0 - xi3_0);
        const double change_xi3_1 = fabs(next_xi3_1 - xi3_1);
        const double change_xi3_2 = fabs(next_xi3_2 - xi3_2);
        const double change_xi4_0 = fabs(next_xi4_0 - xi4_0);
        const double change_xi4_1 = fabs(next_xi4_1 - xi4_1);
        const double change_xi4_2 = fabs(next_xi4_2 - xi4_2);
        const double change = greater(greater(greater(change_xi1_0, greater(change_xi1_1,
            change_xi1_2)), greater(change_xi2_0, greater(change_xi2_1, change_xi2_2))),
            greater(greater(change_xi3_0, greater(change_xi3_1, change_xi3_2)),
            greater(change_xi4_0, greater(change_xi4_1, change_xi4_2))));
        const double scale = greater(greater(greater(1.0, greater(fabs(xi1_0), fabs(xi1_1))),
            greater(fabs(xi1_2), greater(fabs(xi2_0), fabs(xi2_1)))), greater(greater(fabs(xi2_2),
            greater(fabs(xi3_0), fabs(xi3_1))), greater(greater(fabs(xi3_2), fabs(xi4_0)),
            greater(fabs(xi4_1), fabs(xi4_2)))));
        if (!isfinite(change_xi1_0 + change_xi1_1 + change_xi1_2 + change_xi2_0 + change_xi2_1
            + change_xi2_2 + change_xi3_0 + change_xi3_1 + change_xi3_2 + change_xi4_0
            + change_xi4_1 + change_xi4_2)) {
            count_sweeps(statistics, 0, sweep, 1);
            return DIPOLE_VCF_CF4_NOT_FINITE;
        }
        const int still = previous_1 > 0.0 && change >= previous_1;
        if (sweep == 1) {
            memory->first = greater(memory->first, change);
        }
        if (previous_1 > 0.0) {
            rate_1 = greater(change / previous_1, 0.000244140625);
        }
        const int close = change <= 3.552713678800501e-15 * scale
            && change * rate_1 <= 1.1102230246251565e-16 * scale;
        if (close || (still && change <= 5.684341886080802e-14 * scale)) {
            count_sweeps(statistics, 0, sweep, 0);
            memory->rate_1 = sweep > 1 ? rate_1 : 2.0 * rate_1;
            break;
        }
        if (sweep == 100) {
            count_sweeps(statistics, 0, sweep, 1);
            return DIPOLE_VCF_CF4_NOT_CONVERGED;
        }
        previous_1 = change;
        xi1_0 = next_xi1_0;
        xi1_1 = next_xi1_1;
        xi1_2 = next_xi1_2;
        xi2_0 = next_xi2_0;
        xi2_1 = next_xi2_1;
        xi2_2 = next_xi2_2;
        xi3_0 = next_xi3_0;
        xi3_1 = next_xi3_1;
        xi3_2 = next_xi3_2;
        xi4_0 = next_xi4_0;
        xi4_1 = next_xi4_1;
        xi4_2 = next_xi4_2;
    }
    const double xe2_1 = w133 + xi1_1 * w134 + xi4_1 * w132;
    const double xe2_0 = w135 + xi1_0 * w134 + xi4_0 * w132;
    const double xe2_2 = w136 + xi1_2 * w134 + xi4_2 * w132;
    const double w168 = xe2_0 * xe2_0 + xe2_1 * xe2_1 + xe2_2 * xe2_2;
    double c1_5, c2_10;
    stumpff_12(w168, &c1_5, &c2_10);
    const double w170 = xe2_1 * c2_10;
    const double w171 = xe2_1 * w170;
    const double w172 = xe2_2 * c2_10 * xe2_2;
    const double ge2_0 = 1.0 - (w171 + w172);
    const double w173 = xe2_0 * c2_10;
    const double w174 = xe2_1 * w173;
    const double w176 = xe2_2 * c1_5;
    const double ge2_1 = w174 - w176;
    const double w177 = xe2_1 * c1_5;
    const double w178 = xe2_2 * w173;
    const double ge2_2 = w177 + w178;
    const double e2_0 = ge1_0 * ge2_0 + ge1_3 * ge2_1 + ge1_6 * ge2_2;
    const double ge2_3 = w174 + w176;
    const double w179 = xe2_0 * w173;
    const double ge2_4 = 1.0 - (w172 + w179);
    const double w180 = xe2_2 * w170;
    const double w181 = xe2_0 * c1_5;
    const double ge2_5 = w180 - w181;
    const double e2_3 = ge1_0 * ge2_3 + ge1_3 * ge2_4 + ge1_6 * ge2_5;
    const double ge2_6 = w178 - w177;
    const double ge2_7 = w180 + w181;
    const double ge2_8 = 1.0 - (w171 + w179);
    const double e2_6 = ge1_0 * ge2_6 + ge1_3 * ge2_7 + ge1_6 * ge2_8;
    const double e2_1 = ge1_1 * ge2_0 + ge1_4 * ge2_1 + ge1_7 * ge2_2;
    const double e2_4 = ge1_1 * ge2_3 + ge1_4 * ge2_4 + ge1_7 * ge2_5;
    const double e2_7 = ge1_1 * ge2_6 + ge1_4 * ge2_7 + ge1_7 * ge2_8;
    const double e2_2 = ge1_2 * ge2_0 + ge1_5 * ge2_1 + ge1_8 * ge2_2;
    const double e2_5 = ge1_2 * ge2_3 + ge1_5 * ge2_4 + ge1_8 * ge2_5;
    const double e2_8 = ge1_2 * ge2_6 + ge1_5 * ge2_7 + ge1_8 * ge2_8;
    const double change_0 = s_p1_0 * e2_0 + s_p1_1 * e2_1 + s_p1_2 * e2_2 - m_0;
    const double change_1 = s_p1_0 * e2_3 + s_p1_1 * e2_4 + s_p1_2 * e2_5 - m_1;
    const double change_2 = s_p1_0 * e2_6 + s_p1_1 * e2_7 + s_p1_2 * e2_8 - m_2;
    const double new_g00 = g00 * e2_0 + g01 * e2_3 + g02 * e2_6;
    const double new_g01 = g00 * e2_1 + g01 * e2_4 + g02 * e2_7;
    const double new_g02 = g00 * e2_2 + g01 * e2_5 + g02 * e2_8;
    const double new_g10 = g10 * e2_0 + g11 * e2_3 + g12 * e2_6;
    const double new_g11 = g10 * e2_1 + g11 * e2_4 + g12 * e2_7;
    const double new_g12 = g10 * e2_2 + g11 * e2_5 + g12 * e2_8;
    const double new_g20 = g20 * e2_0 + g21 * e2_3 + g22 * e2_6;
    const double new_g21 = g20 * e2_1 + g21 * e2_4 + g22 * e2_7;
    const double new_g22 = g20 * e2_2 + g21 * e2_5 + g22 * e2_8;
    const double new_mu0 = g00 * change_0 + g01 * change_1 + g02 * change_2 + mu0;
    const double new_mu1 = g10 * change_0 + g11 * change_1 + g12 * change_2 + mu1;
    const double new_mu2 = g20 * change_0 + g21 * change_1 + g22 * change_2 + mu2;
    if (!(isfinite(new_g00) && isfinite(new_g01) && isfinite(new_g02) && isfinite(new_g10)
        && isfinite(new_g11) && isfinite(new_g12) && isfinite(new_g20) && isfinite(new_g21)
        && isfinite(new_g22) && isfinite(new_mu0) && isfinite(new_mu1) && isfinite(new_mu2))) {
        return DIPOLE_VCF_CF4_NOT_FINITE;
    }
    const double moved = greater(greater(greater(fabs(xi1_0 - memory->past[0][0]),
        greater(fabs(xi1_1 - memory->past[0][1]), fabs(xi1_2 - memory->past[0][2]))),
        greater(fabs(xi2_0 - memory->past[0][3]), greater(fabs(xi2_1 - memory->past[0][4]),
        fabs(xi2_2 - memory->past[0][5])))), greater(greater(fabs(xi3_0 - memory->past[0][6]),
        greater(fabs(xi3_1 - memory->past[0][7]), fabs(xi3_2 - memory->past[0][8]))),
        greater(fabs(xi4_0 - memory->past[0][9]), greater(fabs(xi4_1 - memory->past[0][10]),
        fabs(xi4_2 - memory->past[0][11])))));
    memmove(memory->past[1], memory->past[0], 8 * sizeof memory->past[0]);
    memory->past[0][0] = xi1_0;
    memory->past[0][1] = xi1_1;
    memory->past[0][2] = xi1_2;
    memory->past[0][3] = xi2_0;
    memory->past[0][4] = xi2_1;
    memory->past[0][5] = xi2_2;
    memory->past[0][6] = xi3_0;
    memory->past[0][7] = xi3_1;
    memory->past[0][8] = xi3_2;
    memory->past[0][9] = xi4_0;
    memory->past[0][10] = xi4_1;
    memory->past[0][11] = xi4_2;
    if (memory->known > 1 && memory->first > 0.5 * moved) {
        memory->known = 1;
    } else if (memory->known < 9) {
        memory->known++;
    }
    memory->first = 0.0;
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
    struct memory memory = {0};
    return advance(state, h, &memory, statistics);
}

int dipole_vcf_cf4_run(double state[static 12], double h, size_t steps, double *trajectory,
    size_t stride, dipole_vcf_cf4_statistics *statistics, size_t *completed)
{
    int status = DIPOLE_VCF_CF4_OK;
    size_t step = 0;
    struct memory memory = {0};
    double *row = stride > 0 ? trajectory : NULL;
    if (row != NULL) {
        memcpy(row, state, 12 * sizeof *state);
    }
    while (step < steps) {
        status = advance(state, h, &memory, statistics);
        if (status != DIPOLE_VCF_CF4_OK && memory.known > 0) {
            /* the solutions before may mislead where the motion changes: begin as the first step does */
            memset(&memory, 0, sizeof memory);
            if (statistics != NULL) {
                statistics->failed = 0;
            }
            status = advance(state, h, &memory, statistics);
        }
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
