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
 *             2 lin (cancellation)
 *             1 lin (sharing)
 *             4 hamilton (body frame)
 *             1 Adinv (opposites)
 *             3 Adt (opposites)
 *             7 Adtinv, 1 force (dead code)
 *             6 dexpt (functions)
 *             1 Adinv (opposites)
 *             2 Adinv, 3 legendre (sharing)
 *             parameters, folded: beta = 1, depth = 3/2
 *             the time: the scene does not depend on it
 * operations: 117 add, 166 mul, 3 stumpff_12 a step
 *             78 add, 128 mul, 2 div, 2 sqrt, 1 stumpff_12, 2 stumpff_23 a sweep of the equations
 *             of xi1, n1
 *             114 add, 182 mul, 2 div, 2 sqrt, 1 stumpff_12, 2 stumpff_23 a sweep of the equations
 *             of xi2, n2
 *             114 add, 182 mul, 2 div, 2 sqrt, 1 stumpff_12, 2 stumpff_23 a sweep of the equations
 *             of xi3, n3
 * stack:      at most 4352 bytes, without what the mathematical library takes
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

/* For z >= 0 and s = sqrt(z): c_2 = (1 - cos(s))/s^2, c_3 = (s - sin(s))/s^3 */
static inline void stumpff_23(double z, double *c2, double *c3)
{
    if (z <= 0.0625) {
        *c2 = stumpff_small_2(z);
        *c3 = stumpff_small_3(z);
        return;
    }
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

/* For z >= 0 and s = sqrt(z): c_1 = sin(s)/s, c_2 = (1 - cos(s))/s^2 */
static inline void stumpff_12(double z, double *c1, double *c2)
{
    if (z <= 0.0625) {
        *c1 = stumpff_small_1(z);
        *c2 = stumpff_small_2(z);
        return;
    }
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
    const double m_0 = g00 * mu0 + g10 * mu1 + g20 * mu2;
    const double Wxi0_0 = 0.9900990099009901 * m_0;
    const double m_1 = g01 * mu0 + g11 * mu1 + g21 * mu2;
    const double m_2 = g02 * mu0 + g12 * mu1 + g22 * mu2;
    const double Wxi0_2 = 100.0 * m_2;
    const double w1 = 0.6756035959798288 * h;
    const double w23 = 1.3512071919596575 * h;
    const double w24 = -1.3512071919596575 * h;
    const double w31 = -0.6756035959798288 * h;
    /* the equations of xi1, n1: fixed point in xi1_0, xi1_1, xi1_2 */
    double xi1_0 = Wxi0_0;
    double xi1_1 = m_1;
    double xi1_2 = Wxi0_2;
    double Nr1_0, s_mu_0, Nr1_2, s_mu_2, Nr1_1, s_mu_1;
    double previous_1 = 0.0;
    for (size_t sweep = 1;; sweep++) {
        const double xE1_1_1 = xi1_1 * w1;
        const double xE1_1_0 = xi1_0 * w1;
        const double xE1_1_2 = xi1_2 * w1;
        const double w2 = xE1_1_0 * xE1_1_0 + xE1_1_1 * xE1_1_1 + xE1_1_2 * xE1_1_2;
        double c1_1, c2_1;
        stumpff_12(w2, &c1_1, &c2_1);
        const double w4 = xE1_1_1 * c2_1;
        const double w5 = xE1_1_1 * w4;
        const double w6 = xE1_1_2 * c2_1 * xE1_1_2;
        const double gE1_1_0 = 1.0 - (w5 + w6);
        const double p_2 = 0.01 * xi1_2;
        const double w7 = xE1_1_0 * c2_1;
        const double w8 = xE1_1_1 * w7;
        const double w10 = xE1_1_2 * c1_1;
        const double gE1_1_1 = w8 - w10;
        const double w11 = xE1_1_0 * w7;
        const double gE1_1_4 = 1.0 - (w6 + w11);
        const double w12 = xE1_1_0 * c1_1;
        const double w13 = xE1_1_2 * w4;
        const double gE1_1_7 = w12 + w13;
        const double Q1_7 = g20 * gE1_1_1 + g21 * gE1_1_4 + g22 * gE1_1_7;
        const double w14 = xE1_1_1 * c1_1;
        const double w15 = xE1_1_2 * w7;
        const double gE1_1_2 = w14 + w15;
        const double gE1_1_5 = w13 - w12;
        const double gE1_1_8 = 1.0 - (w5 + w11);
        const double Q1_8 = g20 * gE1_1_2 + g21 * gE1_1_5 + g22 * gE1_1_8;
        const double w16 = 1.5 - 2.0 * Q1_8;
        const double w17 = 1.0 / sqrt(1.01 + 1.5 * (w16 - 0.2 * Q1_7));
        const double w18 = w17 * w17 * (0.5 * w17);
        const double w19 = 1.0 / sqrt(1.01 + 1.5 * (w16 + 0.2 * Q1_7));
        const double w20 = w19 * w19 * (0.5 * w19);
        const double w21 = -1.0 - 2.0 * (1.5 * w18 - 1.5 * w20);
        const double w22 = -0.3 * w18 - 0.3 * w20;
        Nr1_0 = Q1_7 * w21 - Q1_8 * w22 + 99.0 * xi1_1 * p_2;
        s_mu_0 = m_0 + Nr1_0 * w23;
        const double y1_0 = xi1_0 * w24;
        const double y1_1 = xi1_1 * w24;
        const double y1_2 = xi1_2 * w24;
        const double w25 = y1_0 * y1_0 + y1_1 * y1_1 + y1_2 * y1_2;
        double c2_2, c3_1;
        stumpff_23(w25, &c2_2, &c3_1);
        const double gE1_1_3 = w8 + w10;
        const double gE1_1_6 = w15 - w14;
        const double Q1_6 = g20 * gE1_1_0 + g21 * gE1_1_3 + g22 * gE1_1_6;
        Nr1_2 = 0.01 * xi1_0 * xi1_1 + w22 * Q1_6;
        s_mu_2 = m_2 + w23 * Nr1_2;
        Nr1_1 = -100.0 * xi1_0 * p_2 - w21 * Q1_6;
        s_mu_1 = m_1 + w23 * Nr1_1;
        const double w27 = y1_1 * s_mu_2 - y1_2 * s_mu_1;
        const double w29 = y1_0 * s_mu_1 - s_mu_0 * y1_1;
        const double w30 = s_mu_0 * y1_2 - y1_0 * s_mu_2;
        const double y1_2_0 = xi1_0 * w31;
        const double y1_2_1 = xi1_1 * w31;
        const double y1_2_2 = xi1_2 * w31;
        const double w32 = y1_2_0 * y1_2_0 + y1_2_1 * y1_2_1 + y1_2_2 * y1_2_2;
        double c2_3, c3_2;
        stumpff_23(w32, &c2_3, &c3_2);
        const double w34 = Nr1_2 * y1_2_1 - Nr1_1 * y1_2_2;
        const double w36 = Nr1_1 * y1_2_0 - Nr1_0 * y1_2_1;
        const double w37 = Nr1_0 * y1_2_2 - Nr1_2 * y1_2_0;
        const double M1_0 = s_mu_0 - w27 * c2_2 + (y1_1 * w29 - y1_2 * w30) * c3_1
            + w31 * (Nr1_0 - w34 * c2_3 + (y1_2_1 * w36 - y1_2_2 * w37) * c3_2);
        const double M1_1 = s_mu_1 - w30 * c2_2 + (y1_2 * w27 - y1_0 * w29) * c3_1
            + w31 * (Nr1_1 - w37 * c2_3 + (y1_2_2 * w34 - y1_2_0 * w36) * c3_2);
        const double M1_2 = s_mu_2 - w29 * c2_2 + (y1_0 * w30 - y1_1 * w27) * c3_1
            + w31 * (Nr1_2 - w36 * c2_3 + (y1_2_0 * w37 - y1_2_1 * w34) * c3_2);
        const double Wf1_0 = 0.9900990099009901
            * (gE1_1_0 * M1_0 + gE1_1_3 * M1_1 + gE1_1_6 * M1_2);
        const double Pf1_1 = gE1_1_1 * M1_0 + gE1_1_4 * M1_1 + gE1_1_7 * M1_2;
        const double Wf1_2 = 100.0 * (gE1_1_2 * M1_0 + gE1_1_5 * M1_1 + gE1_1_8 * M1_2);
        const double next_xi1_0 = gE1_1_0 * Wf1_0 + gE1_1_1 * Pf1_1 + gE1_1_2 * Wf1_2;
        const double next_xi1_1 = gE1_1_3 * Wf1_0 + gE1_1_4 * Pf1_1 + gE1_1_5 * Wf1_2;
        const double next_xi1_2 = gE1_1_6 * Wf1_0 + gE1_1_7 * Pf1_1 + gE1_1_8 * Wf1_2;
        const double change_xi1_0 = fabs(next_xi1_0 - xi1_0);
        const double change_xi1_1 = fabs(next_xi1_1 - xi1_1);
        const double change_xi1_2 = fabs(next_xi1_2 - xi1_2);
        const double change = greater(change_xi1_0, greater(change_xi1_1, change_xi1_2));
        const double scale = greater(greater(1.0, fabs(xi1_0)), greater(fabs(xi1_1), fabs(xi1_2)));
        if (!isfinite(change_xi1_0 + change_xi1_1 + change_xi1_2)) {
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
        xi1_0 = next_xi1_0;
        xi1_1 = next_xi1_1;
        xi1_2 = next_xi1_2;
    }
    const double xe1_1 = xi1_1 * w23;
    const double xe1_0 = xi1_0 * w23;
    const double w38 = xe1_0 * xe1_0;
    const double w39 = xe1_1 * xe1_1;
    const double w40 = w38 + w39;
    const double xe1_2 = xi1_2 * w23;
    const double w41 = xe1_2 * xe1_2;
    const double w42 = w40 + w41;
    double c1_2, c2_4;
    stumpff_12(w42, &c1_2, &c2_4);
    const double w44 = xe1_1 * c2_4;
    const double w45 = xe1_1 * w44;
    const double w46 = xe1_2 * c2_4;
    const double w47 = xe1_2 * w46;
    const double w48 = w45 + w47;
    const double ge1_0 = 1.0 - w48;
    const double w49 = -0.8512071919596577 * h;
    const double w56 = xe1_2 * c1_2;
    const double w57 = xe1_0 * c2_4;
    const double w58 = xe1_1 * w57;
    const double ge1_3 = w56 + w58;
    const double w63 = xe1_2 * w57;
    const double w64 = xe1_1 * c1_2;
    const double ge1_6 = w63 - w64;
    const double ge1_2 = w63 + w64;
    const double w67 = xe1_2 * w44;
    const double w68 = xe1_0 * c1_2;
    const double ge1_5 = w67 - w68;
    const double w69 = xe1_0 * w57;
    const double w70 = w45 + w69;
    const double ge1_8 = 1.0 - w70;
    const double ge1_1 = w58 - w56;
    const double w74 = w47 + w69;
    const double ge1_4 = 1.0 - w74;
    const double ge1_7 = w67 + w68;
    const double w82 = -1.7024143839193153 * h;
    const double w86 = 1.7024143839193153 * h;
    const double w93 = 0.8512071919596577 * h;
    /* the equations of xi2, n2: fixed point in xi2_0, xi2_1, xi2_2 */
    double xi2_0 = Wxi0_0;
    double xi2_1 = m_1;
    double xi2_2 = Wxi0_2;
    double w83, s_m2_4_0, w84, s_m2_4_1, w85, s_m2_4_2;
    double previous_2 = 0.0;
    for (size_t sweep = 1;; sweep++) {
        const double xE2_2_1 = xi2_1 * w49;
        const double xE2_2_0 = xi2_0 * w49;
        const double xE2_2_2 = xi2_2 * w49;
        const double w50 = xE2_2_0 * xE2_2_0 + xE2_2_1 * xE2_2_1 + xE2_2_2 * xE2_2_2;
        double c1_3, c2_5;
        stumpff_12(w50, &c1_3, &c2_5);
        const double w52 = xE2_2_1 * c2_5;
        const double w53 = xE2_2_1 * w52;
        const double w54 = xE2_2_2 * c2_5 * xE2_2_2;
        const double gE2_2_0 = 1.0 - (w53 + w54);
        const double w59 = xE2_2_0 * c2_5;
        const double w60 = xE2_2_1 * w59;
        const double w62 = xE2_2_2 * c1_3;
        const double gE2_2_1 = w60 - w62;
        const double w65 = xE2_2_1 * c1_3;
        const double w66 = xE2_2_2 * w59;
        const double gE2_2_2 = w65 + w66;
        const double E2_2_0 = ge1_0 * gE2_2_0 + ge1_3 * gE2_2_1 + ge1_6 * gE2_2_2;
        const double E2_2_2 = gE2_2_0 * ge1_2 + gE2_2_1 * ge1_5 + gE2_2_2 * ge1_8;
        const double gE2_2_3 = w60 + w62;
        const double w71 = xE2_2_0 * w59;
        const double gE2_2_4 = 1.0 - (w54 + w71);
        const double w72 = xE2_2_2 * w52;
        const double w73 = xE2_2_0 * c1_3;
        const double gE2_2_5 = w72 - w73;
        const double E2_2_5 = ge1_2 * gE2_2_3 + ge1_5 * gE2_2_4 + ge1_8 * gE2_2_5;
        const double gE2_2_6 = w66 - w65;
        const double gE2_2_7 = w72 + w73;
        const double gE2_2_8 = 1.0 - (w53 + w71);
        const double E2_2_8 = ge1_2 * gE2_2_6 + ge1_5 * gE2_2_7 + ge1_8 * gE2_2_8;
        const double p_2_2 = 0.01 * (xi2_0 * E2_2_2 + xi2_1 * E2_2_5 + xi2_2 * E2_2_8);
        const double E2_2_1 = gE2_2_0 * ge1_1 + gE2_2_1 * ge1_4 + gE2_2_2 * ge1_7;
        const double E2_2_4 = gE2_2_3 * ge1_1 + gE2_2_4 * ge1_4 + gE2_2_5 * ge1_7;
        const double E2_2_7 = gE2_2_6 * ge1_1 + gE2_2_7 * ge1_4 + gE2_2_8 * ge1_7;
        const double a_3_1 = xi2_0 * E2_2_1 + xi2_1 * E2_2_4 + xi2_2 * E2_2_7;
        const double Q2_7 = g20 * E2_2_1 + g21 * E2_2_4 + g22 * E2_2_7;
        const double Q2_8 = g20 * E2_2_2 + g21 * E2_2_5 + g22 * E2_2_8;
        const double w75 = 1.5 - 2.0 * Q2_8;
        const double w76 = 1.0 / sqrt(1.01 + 1.5 * (w75 - 0.2 * Q2_7));
        const double w77 = w76 * w76 * (0.5 * w76);
        const double w78 = 1.0 / sqrt(1.01 + 1.5 * (w75 + 0.2 * Q2_7));
        const double w79 = w78 * w78 * (0.5 * w78);
        const double w80 = -1.0 - 2.0 * (1.5 * w77 - 1.5 * w79);
        const double w81 = -0.3 * w77 - 0.3 * w79;
        const double Nr2_0 = Q2_7 * w80 - Q2_8 * w81 + 99.0 * a_3_1 * p_2_2;
        w83 = Nr2_0 * w82;
        s_m2_4_0 = s_mu_0 + w83;
        const double E2_2_3 = ge1_0 * gE2_2_3 + ge1_3 * gE2_2_4 + ge1_6 * gE2_2_5;
        const double E2_2_6 = ge1_0 * gE2_2_6 + ge1_3 * gE2_2_7 + ge1_6 * gE2_2_8;
        const double a_3_0 = xi2_0 * E2_2_0 + xi2_1 * E2_2_3 + xi2_2 * E2_2_6;
        const double Q2_6 = g20 * E2_2_0 + g21 * E2_2_3 + g22 * E2_2_6;
        const double Nr2_1 = -100.0 * a_3_0 * p_2_2 - w80 * Q2_6;
        w84 = w82 * Nr2_1;
        s_m2_4_1 = s_mu_1 + w84;
        const double Nr2_2 = 0.01 * a_3_0 * a_3_1 + w81 * Q2_6;
        w85 = w82 * Nr2_2;
        s_m2_4_2 = s_mu_2 + w85;
        const double m2_4_2_0 = ge1_0 * s_m2_4_0 + ge1_1 * s_m2_4_1 + ge1_2 * s_m2_4_2;
        const double y2_0 = xi2_0 * w86;
        const double y2_1 = xi2_1 * w86;
        const double y2_2 = xi2_2 * w86;
        const double w87 = y2_0 * y2_0 + y2_1 * y2_1 + y2_2 * y2_2;
        double c2_6, c3_3;
        stumpff_23(w87, &c2_6, &c3_3);
        const double m2_4_2_2 = ge1_6 * s_m2_4_0 + ge1_7 * s_m2_4_1 + ge1_8 * s_m2_4_2;
        const double m2_4_2_1 = ge1_3 * s_m2_4_0 + ge1_4 * s_m2_4_1 + ge1_5 * s_m2_4_2;
        const double w89 = y2_1 * m2_4_2_2 - y2_2 * m2_4_2_1;
        const double w91 = y2_0 * m2_4_2_1 - m2_4_2_0 * y2_1;
        const double w92 = m2_4_2_0 * y2_2 - y2_0 * m2_4_2_2;
        const double m2_3_0 = ge1_0 * Nr2_0 + ge1_1 * Nr2_1 + ge1_2 * Nr2_2;
        const double y2_2_0 = xi2_0 * w93;
        const double y2_2_1 = xi2_1 * w93;
        const double y2_2_2 = xi2_2 * w93;
        const double w94 = y2_2_0 * y2_2_0 + y2_2_1 * y2_2_1 + y2_2_2 * y2_2_2;
        double c2_7, c3_4;
        stumpff_23(w94, &c2_7, &c3_4);
        const double m2_3_2 = ge1_6 * Nr2_0 + ge1_7 * Nr2_1 + ge1_8 * Nr2_2;
        const double m2_3_1 = ge1_3 * Nr2_0 + ge1_4 * Nr2_1 + ge1_5 * Nr2_2;
        const double w96 = y2_2_1 * m2_3_2 - y2_2_2 * m2_3_1;
        const double w98 = y2_2_0 * m2_3_1 - m2_3_0 * y2_2_1;
        const double w99 = m2_3_0 * y2_2_2 - y2_2_0 * m2_3_2;
        const double M2_0 = m2_4_2_0 - w89 * c2_6 + (y2_1 * w91 - y2_2 * w92) * c3_3
            + w93 * (m2_3_0 - w96 * c2_7 + (y2_2_1 * w98 - y2_2_2 * w99) * c3_4);
        const double M2_1 = m2_4_2_1 - w92 * c2_6 + (y2_2 * w89 - y2_0 * w91) * c3_3
            + w93 * (m2_3_1 - w99 * c2_7 + (y2_2_2 * w96 - y2_2_0 * w98) * c3_4);
        const double M2_2 = m2_4_2_2 - w91 * c2_6 + (y2_0 * w92 - y2_1 * w89) * c3_3
            + w93 * (m2_3_2 - w98 * c2_7 + (y2_2_0 * w99 - y2_2_1 * w96) * c3_4);
        const double Wf2_0 = 0.9900990099009901 * (E2_2_0 * M2_0 + E2_2_3 * M2_1 + E2_2_6 * M2_2);
        const double Pf2_1 = E2_2_1 * M2_0 + E2_2_4 * M2_1 + E2_2_7 * M2_2;
        const double Wf2_2 = 100.0 * (E2_2_2 * M2_0 + E2_2_5 * M2_1 + E2_2_8 * M2_2);
        const double next_xi2_0 = E2_2_0 * Wf2_0 + E2_2_1 * Pf2_1 + E2_2_2 * Wf2_2;
        const double next_xi2_1 = E2_2_3 * Wf2_0 + E2_2_4 * Pf2_1 + E2_2_5 * Wf2_2;
        const double next_xi2_2 = E2_2_6 * Wf2_0 + E2_2_7 * Pf2_1 + E2_2_8 * Wf2_2;
        const double change_xi2_0 = fabs(next_xi2_0 - xi2_0);
        const double change_xi2_1 = fabs(next_xi2_1 - xi2_1);
        const double change_xi2_2 = fabs(next_xi2_2 - xi2_2);
        const double change = greater(change_xi2_0, greater(change_xi2_1, change_xi2_2));
        const double scale = greater(greater(1.0, fabs(xi2_0)), greater(fabs(xi2_1), fabs(xi2_2)));
        if (!isfinite(change_xi2_0 + change_xi2_1 + change_xi2_2)) {
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
        xi2_0 = next_xi2_0;
        xi2_1 = next_xi2_1;
        xi2_2 = next_xi2_2;
    }
    const double xe2_1 = xi2_1 * w82;
    const double xe2_0 = xi2_0 * w82;
    const double w100 = xe2_0 * xe2_0;
    const double w101 = xe2_1 * xe2_1;
    const double w102 = w100 + w101;
    const double xe2_2 = xi2_2 * w82;
    const double w103 = xe2_2 * xe2_2;
    const double w104 = w102 + w103;
    double c1_4, c2_8;
    stumpff_12(w104, &c1_4, &c2_8);
    const double w106 = xe2_1 * c2_8;
    const double w107 = xe2_1 * w106;
    const double w108 = xe2_2 * c2_8;
    const double w109 = xe2_2 * w108;
    const double w110 = w107 + w109;
    const double ge2_0 = 1.0 - w110;
    const double w111 = ge1_0 * ge2_0;
    const double w112 = xe2_0 * c2_8;
    const double w113 = xe2_1 * w112;
    const double w115 = xe2_2 * c1_4;
    const double ge2_1 = w113 - w115;
    const double w116 = ge1_3 * ge2_1;
    const double w117 = w111 + w116;
    const double w118 = xe2_1 * c1_4;
    const double w119 = xe2_2 * w112;
    const double ge2_2 = w118 + w119;
    const double w120 = ge1_6 * ge2_2;
    const double e2_0 = w117 + w120;
    const double ge2_3 = w113 + w115;
    const double w126 = ge1_0 * ge2_3;
    const double w127 = xe2_0 * w112;
    const double w128 = w109 + w127;
    const double ge2_4 = 1.0 - w128;
    const double w129 = ge1_3 * ge2_4;
    const double w130 = w126 + w129;
    const double w131 = xe2_2 * w106;
    const double w132 = xe2_0 * c1_4;
    const double ge2_5 = w131 - w132;
    const double w133 = ge1_6 * ge2_5;
    const double e2_3 = w130 + w133;
    const double ge2_6 = w119 - w118;
    const double w138 = ge1_0 * ge2_6;
    const double ge2_7 = w131 + w132;
    const double w139 = ge1_3 * ge2_7;
    const double w140 = w138 + w139;
    const double w141 = w107 + w127;
    const double ge2_8 = 1.0 - w141;
    const double w142 = ge1_6 * ge2_8;
    const double e2_6 = w140 + w142;
    const double w145 = ge1_2 * ge2_0;
    const double w146 = ge1_5 * ge2_1;
    const double w147 = w145 + w146;
    const double w148 = ge1_8 * ge2_2;
    const double e2_2 = w147 + w148;
    const double w149 = ge1_2 * ge2_3;
    const double w150 = ge1_5 * ge2_4;
    const double w151 = w149 + w150;
    const double w152 = ge1_8 * ge2_5;
    const double e2_5 = w151 + w152;
    const double w153 = ge1_2 * ge2_6;
    const double w154 = ge1_5 * ge2_7;
    const double w155 = w153 + w154;
    const double w156 = ge1_8 * ge2_8;
    const double e2_8 = w155 + w156;
    const double w160 = ge1_1 * ge2_0;
    const double w161 = ge1_4 * ge2_1;
    const double w162 = w160 + w161;
    const double w163 = ge1_7 * ge2_2;
    const double e2_1 = w162 + w163;
    const double w164 = ge1_1 * ge2_3;
    const double w165 = ge1_4 * ge2_4;
    const double w166 = w164 + w165;
    const double w167 = ge1_7 * ge2_5;
    const double e2_4 = w166 + w167;
    const double w168 = ge1_1 * ge2_6;
    const double w169 = ge1_4 * ge2_7;
    const double w170 = w168 + w169;
    const double w171 = ge1_7 * ge2_8;
    const double e2_7 = w170 + w171;
    /* the equations of xi3, n3: fixed point in xi3_0, xi3_1, xi3_2 */
    double xi3_0 = Wxi0_0;
    double xi3_1 = m_1;
    double xi3_2 = Wxi0_2;
    double Nr3_0, Nr3_1, Nr3_2;
    double previous_3 = 0.0;
    for (size_t sweep = 1;; sweep++) {
        const double xE3_3_1 = xi3_1 * w1;
        const double xE3_3_0 = xi3_0 * w1;
        const double xE3_3_2 = xi3_2 * w1;
        const double w121 = xE3_3_0 * xE3_3_0 + xE3_3_1 * xE3_3_1 + xE3_3_2 * xE3_3_2;
        double c1_5, c2_9;
        stumpff_12(w121, &c1_5, &c2_9);
        const double w123 = xE3_3_1 * c2_9;
        const double w124 = xE3_3_1 * w123;
        const double w125 = xE3_3_2 * c2_9 * xE3_3_2;
        const double gE3_3_0 = 1.0 - (w124 + w125);
        const double w134 = xE3_3_0 * c2_9;
        const double w135 = xE3_3_1 * w134;
        const double w137 = xE3_3_2 * c1_5;
        const double gE3_3_1 = w135 - w137;
        const double w143 = xE3_3_1 * c1_5;
        const double w144 = xE3_3_2 * w134;
        const double gE3_3_2 = w143 + w144;
        const double E3_3_0 = e2_0 * gE3_3_0 + e2_3 * gE3_3_1 + e2_6 * gE3_3_2;
        const double E3_3_2 = gE3_3_0 * e2_2 + gE3_3_1 * e2_5 + gE3_3_2 * e2_8;
        const double gE3_3_3 = w135 + w137;
        const double w157 = xE3_3_0 * w134;
        const double gE3_3_4 = 1.0 - (w125 + w157);
        const double w158 = xE3_3_2 * w123;
        const double w159 = xE3_3_0 * c1_5;
        const double gE3_3_5 = w158 - w159;
        const double E3_3_5 = e2_2 * gE3_3_3 + e2_5 * gE3_3_4 + e2_8 * gE3_3_5;
        const double gE3_3_6 = w144 - w143;
        const double gE3_3_7 = w158 + w159;
        const double gE3_3_8 = 1.0 - (w124 + w157);
        const double E3_3_8 = e2_2 * gE3_3_6 + e2_5 * gE3_3_7 + e2_8 * gE3_3_8;
        const double p_3_2 = 0.01 * (xi3_0 * E3_3_2 + xi3_1 * E3_3_5 + xi3_2 * E3_3_8);
        const double E3_3_1 = gE3_3_0 * e2_1 + gE3_3_1 * e2_4 + gE3_3_2 * e2_7;
        const double E3_3_4 = gE3_3_3 * e2_1 + gE3_3_4 * e2_4 + gE3_3_5 * e2_7;
        const double E3_3_7 = gE3_3_6 * e2_1 + gE3_3_7 * e2_4 + gE3_3_8 * e2_7;
        const double a_5_1 = xi3_0 * E3_3_1 + xi3_1 * E3_3_4 + xi3_2 * E3_3_7;
        const double Q3_7 = g20 * E3_3_1 + g21 * E3_3_4 + g22 * E3_3_7;
        const double Q3_8 = g20 * E3_3_2 + g21 * E3_3_5 + g22 * E3_3_8;
        const double w172 = 1.5 - 2.0 * Q3_8;
        const double w173 = 1.0 / sqrt(1.01 + 1.5 * (w172 - 0.2 * Q3_7));
        const double w174 = w173 * w173 * (0.5 * w173);
        const double w175 = 1.0 / sqrt(1.01 + 1.5 * (w172 + 0.2 * Q3_7));
        const double w176 = w175 * w175 * (0.5 * w175);
        const double w177 = -1.0 - 2.0 * (1.5 * w174 - 1.5 * w176);
        const double w178 = -0.3 * w174 - 0.3 * w176;
        Nr3_0 = Q3_7 * w177 - Q3_8 * w178 + 99.0 * a_5_1 * p_3_2;
        const double s_m3_5_0 = s_m2_4_0 + w23 * Nr3_0;
        const double E3_3_3 = e2_0 * gE3_3_3 + e2_3 * gE3_3_4 + e2_6 * gE3_3_5;
        const double E3_3_6 = e2_0 * gE3_3_6 + e2_3 * gE3_3_7 + e2_6 * gE3_3_8;
        const double a_5_0 = xi3_0 * E3_3_0 + xi3_1 * E3_3_3 + xi3_2 * E3_3_6;
        const double Q3_6 = g20 * E3_3_0 + g21 * E3_3_3 + g22 * E3_3_6;
        Nr3_1 = -100.0 * a_5_0 * p_3_2 - w177 * Q3_6;
        const double s_m3_5_1 = s_m2_4_1 + w23 * Nr3_1;
        Nr3_2 = 0.01 * a_5_0 * a_5_1 + w178 * Q3_6;
        const double s_m3_5_2 = s_m2_4_2 + w23 * Nr3_2;
        const double m3_5_2_0 = e2_0 * s_m3_5_0 + e2_1 * s_m3_5_1 + e2_2 * s_m3_5_2;
        const double y3_0 = xi3_0 * w24;
        const double y3_1 = xi3_1 * w24;
        const double y3_2 = xi3_2 * w24;
        const double w179 = y3_0 * y3_0 + y3_1 * y3_1 + y3_2 * y3_2;
        double c2_10, c3_5;
        stumpff_23(w179, &c2_10, &c3_5);
        const double m3_5_2_2 = e2_6 * s_m3_5_0 + e2_7 * s_m3_5_1 + e2_8 * s_m3_5_2;
        const double m3_5_2_1 = e2_3 * s_m3_5_0 + e2_4 * s_m3_5_1 + e2_5 * s_m3_5_2;
        const double w181 = y3_1 * m3_5_2_2 - y3_2 * m3_5_2_1;
        const double w183 = y3_0 * m3_5_2_1 - m3_5_2_0 * y3_1;
        const double w184 = m3_5_2_0 * y3_2 - y3_0 * m3_5_2_2;
        const double m3_4_0 = e2_0 * Nr3_0 + e2_1 * Nr3_1 + e2_2 * Nr3_2;
        const double y3_2_0 = xi3_0 * w31;
        const double y3_2_1 = xi3_1 * w31;
        const double y3_2_2 = xi3_2 * w31;
        const double w185 = y3_2_0 * y3_2_0 + y3_2_1 * y3_2_1 + y3_2_2 * y3_2_2;
        double c2_11, c3_6;
        stumpff_23(w185, &c2_11, &c3_6);
        const double m3_4_2 = e2_6 * Nr3_0 + e2_7 * Nr3_1 + e2_8 * Nr3_2;
        const double m3_4_1 = e2_3 * Nr3_0 + e2_4 * Nr3_1 + e2_5 * Nr3_2;
        const double w187 = y3_2_1 * m3_4_2 - y3_2_2 * m3_4_1;
        const double w189 = y3_2_0 * m3_4_1 - m3_4_0 * y3_2_1;
        const double w190 = m3_4_0 * y3_2_2 - y3_2_0 * m3_4_2;
        const double M3_0 = m3_5_2_0 - w181 * c2_10 + (y3_1 * w183 - y3_2 * w184) * c3_5
            + w31 * (m3_4_0 - w187 * c2_11 + (y3_2_1 * w189 - y3_2_2 * w190) * c3_6);
        const double M3_1 = m3_5_2_1 - w184 * c2_10 + (y3_2 * w181 - y3_0 * w183) * c3_5
            + w31 * (m3_4_1 - w190 * c2_11 + (y3_2_2 * w187 - y3_2_0 * w189) * c3_6);
        const double M3_2 = m3_5_2_2 - w183 * c2_10 + (y3_0 * w184 - y3_1 * w181) * c3_5
            + w31 * (m3_4_2 - w189 * c2_11 + (y3_2_0 * w190 - y3_2_1 * w187) * c3_6);
        const double Wf3_0 = 0.9900990099009901 * (E3_3_0 * M3_0 + E3_3_3 * M3_1 + E3_3_6 * M3_2);
        const double Pf3_1 = E3_3_1 * M3_0 + E3_3_4 * M3_1 + E3_3_7 * M3_2;
        const double Wf3_2 = 100.0 * (E3_3_2 * M3_0 + E3_3_5 * M3_1 + E3_3_8 * M3_2);
        const double next_xi3_0 = E3_3_0 * Wf3_0 + E3_3_1 * Pf3_1 + E3_3_2 * Wf3_2;
        const double next_xi3_1 = E3_3_3 * Wf3_0 + E3_3_4 * Pf3_1 + E3_3_5 * Wf3_2;
        const double next_xi3_2 = E3_3_6 * Wf3_0 + E3_3_7 * Pf3_1 + E3_3_8 * Wf3_2;
        const double change_xi3_0 = fabs(next_xi3_0 - xi3_0);
        const double change_xi3_1 = fabs(next_xi3_1 - xi3_1);
        const double change_xi3_2 = fabs(next_xi3_2 - xi3_2);
        const double change = greater(change_xi3_0, greater(change_xi3_1, change_xi3_2));
        const double scale = greater(greater(1.0, fabs(xi3_0)), greater(fabs(xi3_1), fabs(xi3_2)));
        if (!isfinite(change_xi3_0 + change_xi3_1 + change_xi3_2)) {
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
        xi3_0 = next_xi3_0;
        xi3_1 = next_xi3_1;
        xi3_2 = next_xi3_2;
    }
    const double xe3_1 = xi3_1 * w23;
    const double xe3_0 = xi3_0 * w23;
    const double xe3_2 = xi3_2 * w23;
    const double w191 = xe3_0 * xe3_0 + xe3_1 * xe3_1 + xe3_2 * xe3_2;
    double c1_6, c2_12;
    stumpff_12(w191, &c1_6, &c2_12);
    const double w193 = xe3_1 * c2_12;
    const double w194 = xe3_1 * w193;
    const double w195 = xe3_2 * c2_12 * xe3_2;
    const double ge3_0 = 1.0 - (w194 + w195);
    const double w196 = xe3_0 * c2_12;
    const double w197 = xe3_1 * w196;
    const double w199 = xe3_2 * c1_6;
    const double ge3_1 = w197 - w199;
    const double w200 = xe3_1 * c1_6;
    const double w201 = xe3_2 * w196;
    const double ge3_2 = w200 + w201;
    const double e3_0 = e2_0 * ge3_0 + e2_3 * ge3_1 + e2_6 * ge3_2;
    const double ge3_3 = w197 + w199;
    const double w202 = xe3_0 * w196;
    const double ge3_4 = 1.0 - (w195 + w202);
    const double w203 = xe3_2 * w193;
    const double w204 = xe3_0 * c1_6;
    const double ge3_5 = w203 - w204;
    const double e3_3 = e2_0 * ge3_3 + e2_3 * ge3_4 + e2_6 * ge3_5;
    const double ge3_6 = w201 - w200;
    const double ge3_7 = w203 + w204;
    const double ge3_8 = 1.0 - (w194 + w202);
    const double e3_6 = e2_0 * ge3_6 + e2_3 * ge3_7 + e2_6 * ge3_8;
    const double q1_0 = g00 * e3_0 + g01 * e3_3 + g02 * e3_6;
    const double e3_1 = e2_1 * ge3_0 + e2_4 * ge3_1 + e2_7 * ge3_2;
    const double e3_4 = e2_1 * ge3_3 + e2_4 * ge3_4 + e2_7 * ge3_5;
    const double e3_7 = e2_1 * ge3_6 + e2_4 * ge3_7 + e2_7 * ge3_8;
    const double q1_1 = g00 * e3_1 + g01 * e3_4 + g02 * e3_7;
    const double e3_2 = e2_2 * ge3_0 + e2_5 * ge3_1 + e2_8 * ge3_2;
    const double e3_5 = e2_2 * ge3_3 + e2_5 * ge3_4 + e2_8 * ge3_5;
    const double e3_8 = e2_2 * ge3_6 + e2_5 * ge3_7 + e2_8 * ge3_8;
    const double q1_2 = g00 * e3_2 + g01 * e3_5 + g02 * e3_8;
    const double q1_3 = g10 * e3_0 + g11 * e3_3 + g12 * e3_6;
    const double q1_4 = g10 * e3_1 + g11 * e3_4 + g12 * e3_7;
    const double q1_5 = g10 * e3_2 + g11 * e3_5 + g12 * e3_8;
    const double q1_6 = g20 * e3_0 + g21 * e3_3 + g22 * e3_6;
    const double q1_7 = g20 * e3_1 + g21 * e3_4 + g22 * e3_7;
    const double q1_8 = g20 * e3_2 + g21 * e3_5 + g22 * e3_8;
    const double mubar_0 = m_0 + w23 * (Nr1_0 + Nr3_0) + w83;
    const double mubar_1 = m_1 + w23 * (Nr1_1 + Nr3_1) + w84;
    const double mubar_2 = m_2 + w23 * (Nr1_2 + Nr3_2) + w85;
    const double new_mu0 = q1_0 * mubar_0 + q1_1 * mubar_1 + q1_2 * mubar_2;
    const double new_mu1 = q1_3 * mubar_0 + q1_4 * mubar_1 + q1_5 * mubar_2;
    const double new_mu2 = q1_6 * mubar_0 + q1_7 * mubar_1 + q1_8 * mubar_2;
    if (!(isfinite(q1_0) && isfinite(q1_1) && isfinite(q1_2) && isfinite(q1_3) && isfinite(q1_4)
        && isfinite(q1_5) && isfinite(q1_6) && isfinite(q1_7) && isfinite(q1_8)
        && isfinite(new_mu0) && isfinite(new_mu1) && isfinite(new_mu2))) {
        return DIPOLE_VCG_TRIPLE_JUMP_NOT_FINITE;
    }
    state[0] = q1_0;
    state[1] = q1_1;
    state[2] = q1_2;
    state[3] = q1_3;
    state[4] = q1_4;
    state[5] = q1_5;
    state[6] = q1_6;
    state[7] = q1_7;
    state[8] = q1_8;
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
