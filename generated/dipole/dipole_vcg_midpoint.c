/*
 * Dipole on a stick, T*SO(3) (thesis section 3.6): one step by vcg:midpoint
 *
 * method:     family vcg, tableau midpoint
 * source:     Table 3.2a of Bogfjellmo and Marthinsen
 * order:      2, certificate: exact (every order condition up to it is zero in exact arithmetic)
 * scene:      Dipole on a stick, T*SO(3) (thesis section 3.6), group SO(3)
 * solved by:  the equations of xi1, n1: Newton's method with the matrix to first order in h, 3
 *             unknowns (2.0 sweeps of 285 operations and 1.00 matrices of 68 a step; fixed point:
 *             3.2 sweeps of 270 operations; Newton's method: 2.5 sweeps of 285 operations and 0.05
 *             matrices of 842)
 * state:      [0..8] q: element of SO(3), row by row
 *             [9..11] mu: right-trivialised momentum in the dual algebra of SO(3)
 * left out:   3 Adtinv, 2 mul (zeros)
 *             1 identity (sharing)
 *             1 identity (dead code)
 *             1 dexpt (factors)
 *             1 lin (sharing)
 *             2 hamilton (body frame)
 *             1 Adinv (opposites)
 *             1 Adt (opposites)
 *             2 Adtinv, 1 force (dead code)
 *             1 Adt, 2 dexpt (functions)
 *             1 Adinv (opposites)
 *             1 legendre (sharing)
 *             1 lin, 2 seriest (factors)
 *             parameters, folded: beta = 1, depth = 3/2
 *             the time: the scene does not depend on it
 * operations: 54 add, 68 mul, 1 stumpff_12 a step
 *             2 mul a start, in steps that follow no other
 *             17 add, 47 mul, 1 div a matrix of the equations of xi1, n1
 *             75 add, 127 mul, 2 div, 2 sqrt, 1 stumpff_12, 1 stumpff_23, 1 stumpff_3 a sweep of
 *             the equations of xi1, n1
 * stack:      at most 2624 bytes, without what the mathematical library takes
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

/* For z > 1/16 and s = sqrt(z): c_3 = (s - sin(s))/s^3 */
static double stumpff_3_far(double z)
{
    if (z <= 4.0) {
        return stumpff_series_3(z);
    }
    const double s = sqrt(z <= 4503599627370496.0 ? z : NAN);
    return (1.0 - sin(s) / s) / z;
}

/* For z >= 0 and s = sqrt(z): c_3 = (s - sin(s))/s^3 */
static inline double stumpff_3(double z)
{
    return z <= 0.0625 ? stumpff_small_3(z) : stumpff_3_far(z);
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

/* What one step of a run leaves for the next: solutions of its equations, the latest first. */
struct memory {
    size_t known;
    double first;
    double past[9][3];
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
    const double m_0 = g00 * mu0 + g10 * mu1 + g20 * mu2;
    const double m_1 = g01 * mu0 + g11 * mu1 + g21 * mu2;
    const double m_2 = g02 * mu0 + g12 * mu1 + g22 * mu2;
    double xi1_0, xi1_1, xi1_2;
    if (memory->known > 0) {
        xi1_0 = extrapolated(memory, 0);
        xi1_1 = extrapolated(memory, 1);
        xi1_2 = extrapolated(memory, 2);
    } else {
        const double Wxi0_0 = 0.9900990099009901 * m_0;
        const double Wxi0_2 = 100.0 * m_2;
        xi1_0 = Wxi0_0;
        xi1_1 = m_1;
        xi1_2 = Wxi0_2;
    }
    const double w20 = 0.5 * h;
    const double w49 = -0.5 * h;
    /* the equations of xi1, n1: Newton's method with the matrix to first order in h in xi1_0, xi1_1, xi1_2 */
    double s_mu_0, xe1_0, xe1_1, xe1_2, w43, s_mu_2, s_mu_1;
    double previous_1 = 0.0;
    double rate_1 = memory->known > 0 ? memory->rate_1 : 1.0;
    const double Wxi0_0_ = 0.9900990099009901 * m_0;
    const double w1 = h * Wxi0_0_;
    const double w2 = 0.01 * xi1_0;
    const double w3 = 50.0 * h;
    const double w4 = w2 * w3 - 0.5 * w1;
    const double w5 = 0.5 * h;
    const double w6 = -100.0 * xi1_0;
    const double w7 = 0.5 * w1 + 0.01 * (w5 * w6);
    const double w8 = 1.0 - w4 * w7;
    const double Wxi0_2_ = 100.0 * m_2;
    const double w9 = h * Wxi0_2_;
    const double w10 = 0.49504950495049505 * h;
    const double w11 = 0.5 * w9 + 0.99 * xi1_2 * w10;
    const double w12 = h * m_1;
    const double w13 = 0.5 * w12 + 0.01 * xi1_1 * w3;
    const double xE1_1_2 = xi1_2 * w5;
    const double w14 = xE1_1_2 + 0.5 * w9;
    const double w15 = w7 * w13 - w14;
    const double w16 = 99.0 * xi1_1;
    const double w17 = 0.01 * (w10 * w16) - 0.5 * w12;
    const double w18 = w13 - w4 * w14;
    const double w19 = 1.0 / (w8 - w11 * w15 - w17 * w18);
    const double inverse_1_0 = w8 * w19;
    const double inverse_1_1 = w19 * (w11 + w4 * w17);
    const double inverse_1_2 = w19 * (w17 + w7 * w11);
    const double inverse_1_3 = w15 * w19;
    const double inverse_1_4 = w19 * (1.0 - w13 * w17);
    const double inverse_1_5 = w19 * (w7 - w14 * w17);
    const double inverse_1_6 = w18 * w19;
    const double inverse_1_7 = w19 * (w4 + w11 * w13);
    const double inverse_1_8 = w19 * (1.0 + w11 * w14);
    for (size_t sweep = 1;; sweep++) {
        const double xE1_1_1 = xi1_1 * w20;
        const double xE1_1_0 = xi1_0 * w20;
        const double xE1_1_2_ = xi1_2 * w20;
        const double w21 = xE1_1_0 * xE1_1_0 + xE1_1_1 * xE1_1_1 + xE1_1_2_ * xE1_1_2_;
        double c1_1, c2_1;
        stumpff_12(w21, &c1_1, &c2_1);
        const double w23 = xE1_1_1 * c2_1;
        const double w24 = xE1_1_1 * w23;
        const double w25 = xE1_1_2_ * c2_1 * xE1_1_2_;
        const double gE1_1_0 = 1.0 - (w24 + w25);
        const double p_2 = 0.01 * xi1_2;
        const double w26 = 99.0 * xi1_1;
        const double w27 = xE1_1_0 * c2_1;
        const double w28 = xE1_1_1 * w27;
        const double w30 = xE1_1_2_ * c1_1;
        const double gE1_1_1 = w28 - w30;
        const double w31 = xE1_1_0 * w27;
        const double gE1_1_4 = 1.0 - (w25 + w31);
        const double w32 = xE1_1_0 * c1_1;
        const double w33 = xE1_1_2_ * w23;
        const double gE1_1_7 = w32 + w33;
        const double Q1_7 = g20 * gE1_1_1 + g21 * gE1_1_4 + g22 * gE1_1_7;
        const double w34 = xE1_1_1 * c1_1;
        const double w35 = xE1_1_2_ * w27;
        const double gE1_1_2 = w34 + w35;
        const double gE1_1_5 = w33 - w32;
        const double gE1_1_8 = 1.0 - (w24 + w31);
        const double Q1_8 = g20 * gE1_1_2 + g21 * gE1_1_5 + g22 * gE1_1_8;
        const double w36 = 1.5 - 2.0 * Q1_8;
        const double w37 = 1.0 / sqrt(1.01 + 1.5 * (w36 - 0.2 * Q1_7));
        const double w38 = w37 * w37 * (0.5 * w37);
        const double w39 = 1.0 / sqrt(1.01 + 1.5 * (w36 + 0.2 * Q1_7));
        const double w40 = w39 * w39 * (0.5 * w39);
        const double w41 = -1.0 - 2.0 * (1.5 * w38 - 1.5 * w40);
        const double w42 = -0.3 * w38 - 0.3 * w40;
        const double Nr1_0 = Q1_7 * w41 - Q1_8 * w42 + p_2 * w26;
        s_mu_0 = m_0 + h * Nr1_0;
        xe1_0 = h * xi1_0;
        xe1_1 = h * xi1_1;
        xe1_2 = h * xi1_2;
        w43 = xe1_0 * xe1_0 + xe1_1 * xe1_1 + xe1_2 * xe1_2;
        const double c3_1 = stumpff_3(0.25 * w43);
        const double w44 = 0.25 * c3_1;
        const double w45 = 0.01 * xi1_0;
        const double gE1_1_3 = w28 + w30;
        const double gE1_1_6 = w35 - w34;
        const double Q1_6 = g20 * gE1_1_0 + g21 * gE1_1_3 + g22 * gE1_1_6;
        const double Nr1_2 = xi1_1 * w45 + w42 * Q1_6;
        s_mu_2 = m_2 + h * Nr1_2;
        const double w46 = xe1_0 * s_mu_2 - s_mu_0 * xe1_2;
        const double w47 = -100.0 * xi1_0;
        const double Nr1_1 = p_2 * w47 - w41 * Q1_6;
        s_mu_1 = m_1 + h * Nr1_1;
        const double w48 = s_mu_0 * xe1_1 - xe1_0 * s_mu_1;
        const double y1_2_0 = xi1_0 * w49;
        const double y1_2_1 = xi1_1 * w49;
        const double y1_2_2 = xi1_2 * w49;
        const double w50 = y1_2_0 * y1_2_0 + y1_2_1 * y1_2_1 + y1_2_2 * y1_2_2;
        double c2_2, c3_2;
        stumpff_23(w50, &c2_2, &c3_2);
        const double w52 = Nr1_2 * y1_2_1 - Nr1_1 * y1_2_2;
        const double w54 = Nr1_1 * y1_2_0 - Nr1_0 * y1_2_1;
        const double w55 = Nr1_0 * y1_2_2 - Nr1_2 * y1_2_0;
        const double M1_2_0 = s_mu_0 + w44 * (xe1_2 * w46 - xe1_1 * w48)
            + w49 * (Nr1_0 + w52 * c2_2 + (y1_2_1 * w54 - y1_2_2 * w55) * c3_2);
        const double Wf1_0 = 0.9900990099009901 * M1_2_0;
        const double w56 = xe1_2 * s_mu_1 - xe1_1 * s_mu_2;
        const double M1_2_1 = s_mu_1 + w44 * (xe1_0 * w48 - xe1_2 * w56)
            + w49 * (Nr1_1 + w55 * c2_2 + (y1_2_2 * w52 - y1_2_0 * w54) * c3_2);
        const double M1_2_2 = s_mu_2 + w44 * (xe1_1 * w56 - xe1_0 * w46)
            + w49 * (Nr1_2 + w54 * c2_2 + (y1_2_0 * w55 - y1_2_1 * w52) * c3_2);
        const double Wf1_2 = 100.0 * M1_2_2;
        const double next_xi1_0 = gE1_1_0 * Wf1_0 + gE1_1_1 * M1_2_1 + gE1_1_2 * Wf1_2;
        const double next_xi1_1 = gE1_1_3 * Wf1_0 + gE1_1_4 * M1_2_1 + gE1_1_5 * Wf1_2;
        const double next_xi1_2 = gE1_1_6 * Wf1_0 + gE1_1_7 * M1_2_1 + gE1_1_8 * Wf1_2;
        const double residual_xi1_0 = next_xi1_0 - xi1_0;
        const double residual_xi1_1 = next_xi1_1 - xi1_1;
        const double residual_xi1_2 = next_xi1_2 - xi1_2;
        if (!isfinite(residual_xi1_0 + residual_xi1_1 + residual_xi1_2)) {
            count_sweeps(statistics, 0, sweep, 1);
            return DIPOLE_VCG_MIDPOINT_NOT_FINITE;
        }
        const double change_xi1_0 = inverse_1_0 * residual_xi1_0 + inverse_1_1 * residual_xi1_1
            + inverse_1_2 * residual_xi1_2;
        const double change_xi1_1 = inverse_1_3 * residual_xi1_0 + inverse_1_4 * residual_xi1_1
            + inverse_1_5 * residual_xi1_2;
        const double change_xi1_2 = inverse_1_6 * residual_xi1_0 + inverse_1_7 * residual_xi1_1
            + inverse_1_8 * residual_xi1_2;
        const double change = greater(fabs(change_xi1_0), greater(fabs(change_xi1_1),
            fabs(change_xi1_2)));
        const double scale = greater(greater(1.0, fabs(xi1_0)), greater(fabs(xi1_1), fabs(xi1_2)));
        const int still = previous_1 > 0.0 && change >= previous_1;
        if (sweep == 1) {
            memory->first = greater(memory->first, change);
        }
        if (previous_1 > 0.0) {
            rate_1 = greater(change / previous_1, 0.000244140625);
        }
        const int close = change <= 5.684341886080802e-14 * scale
            && change * rate_1 <= 1.1102230246251565e-16 * scale;
        xi1_0 += change_xi1_0;
        xi1_1 += change_xi1_1;
        xi1_2 += change_xi1_2;
        if (close || (still && change <= 5.684341886080802e-14 * scale)) {
            count_sweeps(statistics, 0, sweep, 0);
            memory->rate_1 = sweep > 1 ? rate_1 : 2.0 * rate_1;
            break;
        }
        if (sweep == 100) {
            count_sweeps(statistics, 0, sweep, 1);
            return DIPOLE_VCG_MIDPOINT_NOT_CONVERGED;
        }
        previous_1 = change;
    }
    double c1_2, c2_3;
    stumpff_12(w43, &c1_2, &c2_3);
    const double w58 = xe1_1 * c2_3;
    const double w59 = xe1_1 * w58;
    const double w60 = xe1_2 * c2_3 * xe1_2;
    const double ge1_0 = 1.0 - (w59 + w60);
    const double w62 = xe1_2 * c1_2;
    const double w63 = xe1_0 * c2_3;
    const double w64 = xe1_1 * w63;
    const double ge1_3 = w62 + w64;
    const double w65 = xe1_2 * w63;
    const double w66 = xe1_1 * c1_2;
    const double ge1_6 = w65 - w66;
    const double ge1_1 = w64 - w62;
    const double w67 = xe1_0 * w63;
    const double ge1_4 = 1.0 - (w60 + w67);
    const double w68 = xe1_0 * c1_2;
    const double w69 = xe1_2 * w58;
    const double ge1_7 = w68 + w69;
    const double ge1_2 = w65 + w66;
    const double ge1_5 = w69 - w68;
    const double ge1_8 = 1.0 - (w59 + w67);
    const double change_0 = s_mu_0 * ge1_0 + s_mu_1 * ge1_1 + s_mu_2 * ge1_2 - m_0;
    const double change_1 = s_mu_0 * ge1_3 + s_mu_1 * ge1_4 + s_mu_2 * ge1_5 - m_1;
    const double change_2 = s_mu_0 * ge1_6 + s_mu_1 * ge1_7 + s_mu_2 * ge1_8 - m_2;
    const double new_g00 = g00 * ge1_0 + g01 * ge1_3 + g02 * ge1_6;
    const double new_g01 = g00 * ge1_1 + g01 * ge1_4 + g02 * ge1_7;
    const double new_g02 = g00 * ge1_2 + g01 * ge1_5 + g02 * ge1_8;
    const double new_g10 = g10 * ge1_0 + g11 * ge1_3 + g12 * ge1_6;
    const double new_g11 = g10 * ge1_1 + g11 * ge1_4 + g12 * ge1_7;
    const double new_g12 = g10 * ge1_2 + g11 * ge1_5 + g12 * ge1_8;
    const double new_g20 = g20 * ge1_0 + g21 * ge1_3 + g22 * ge1_6;
    const double new_g21 = g20 * ge1_1 + g21 * ge1_4 + g22 * ge1_7;
    const double new_g22 = g20 * ge1_2 + g21 * ge1_5 + g22 * ge1_8;
    const double new_mu0 = g00 * change_0 + g01 * change_1 + g02 * change_2 + mu0;
    const double new_mu1 = g10 * change_0 + g11 * change_1 + g12 * change_2 + mu1;
    const double new_mu2 = g20 * change_0 + g21 * change_1 + g22 * change_2 + mu2;
    if (!(isfinite(new_g00) && isfinite(new_g01) && isfinite(new_g02) && isfinite(new_g10)
        && isfinite(new_g11) && isfinite(new_g12) && isfinite(new_g20) && isfinite(new_g21)
        && isfinite(new_g22) && isfinite(new_mu0) && isfinite(new_mu1) && isfinite(new_mu2))) {
        return DIPOLE_VCG_MIDPOINT_NOT_FINITE;
    }
    const double moved = greater(fabs(xi1_0 - memory->past[0][0]),
        greater(fabs(xi1_1 - memory->past[0][1]), fabs(xi1_2 - memory->past[0][2])));
    memmove(memory->past[1], memory->past[0], 8 * sizeof memory->past[0]);
    memory->past[0][0] = xi1_0;
    memory->past[0][1] = xi1_1;
    memory->past[0][2] = xi1_2;
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
    return DIPOLE_VCG_MIDPOINT_OK;
}

int dipole_vcg_midpoint_step(double state[static 12], double h,
    dipole_vcg_midpoint_statistics *statistics)
{
    struct memory memory = {0};
    return advance(state, h, &memory, statistics);
}

int dipole_vcg_midpoint_run(double state[static 12], double h, size_t steps,
    double *trajectory, size_t stride, dipole_vcg_midpoint_statistics *statistics,
    size_t *completed)
{
    int status = DIPOLE_VCG_MIDPOINT_OK;
    size_t step = 0;
    struct memory memory = {0};
    double *row = stride > 0 ? trajectory : NULL;
    if (row != NULL) {
        memcpy(row, state, 12 * sizeof *state);
    }
    while (step < steps) {
        status = advance(state, h, &memory, statistics);
        if (status != DIPOLE_VCG_MIDPOINT_OK && memory.known > 0) {
            /* the solutions before may mislead where the motion changes: begin as the first step does */
            memset(&memory, 0, sizeof memory);
            if (statistics != NULL) {
                statistics->failed = 0;
            }
            status = advance(state, h, &memory, statistics);
        }
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
