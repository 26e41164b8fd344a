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
 *             2 dexpt (common sums)
 *             1 lin (sharing)
 *             3 hamilton (body frame)
 *             2 Adt (opposites)
 *             1 Adtinv, 1 force, 1 lin (dead code)
 *             2 Adinv, 2 Adt, 2 dexpinv, 2 dexpinvt, 3 dexpt (functions)
 *             2 legendre, 2 lin, 2 series, 2 seriest (sharing)
 *             2 Ad, 4 Adtinv, 2 seriest (factors)
 *             parameters, folded: beta = 1, depth = 3/2
 *             the time: the scene does not depend on it
 * operations: 42 add, 66 mul, 1 stumpff_1 a step
 *             315 add, 480 mul, 6 div, 4 sqrt, 2 stumpff_123, 1 stumpff_23 a sweep of the
 *             equations of v1, v2, m1, m2
 * stack:      at most 2816 bytes, without what the mathematical library takes
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

/* For z >= 0 and s = sqrt(z): c_1 = sin(s)/s, c_2 = (1 - cos(s))/s^2, c_3 = (s - sin(s))/s^3 */
static inline void stumpff_123(double z, double *c1, double *c2, double *c3)
{
    if (z <= 0.0625) {
        *c1 = stumpff_small_1(z);
        *c2 = stumpff_small_2(z);
        *c3 = stumpff_small_3(z);
        return;
    }
    if (z <= 1.0) {
        *c1 = stumpff_series_1(z);
        *c2 = stumpff_series_2(z);
        *c3 = stumpff_series_3(z);
        return;
    }
    const double half = 0.5 * sqrt(z <= 4503599627370496.0 ? z : NAN);
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
    if (z <= 0.0625) {
        return stumpff_small_1(z);
    }
    if (z <= 1.0) {
        return stumpff_series_1(z);
    }
    const double s = sqrt(z <= 4503599627370496.0 ? z : NAN);
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
    const double m_0 = g00 * mu0 + g10 * mu1 + g20 * mu2;
    const double Wxi0_0 = 0.9900990099009901 * m_0;
    const double m_1 = g01 * mu0 + g11 * mu1 + g21 * mu2;
    const double m_2 = g02 * mu0 + g12 * mu1 + g22 * mu2;
    const double Wxi0_2 = 100.0 * m_2;
    const double w1 = 0.5 * h;
    const double w2 = 0.5386751345948129 * h;
    const double w3 = 0.25 * h;
    const double w36 = -0.03867513459481288 * h;
    const double w82 = -0.26933756729740643 * h;
    const double w96 = -0.125 * h;
    const double w122 = 0.01933756729740644 * h;
    /* the equations of v1, v2, m1, m2: fixed point in v1_0, v1_1, v1_2, v2_0, v2_1, v2_2 */
    double v1_0 = Wxi0_0;
    double v1_1 = m_1;
    double v1_2 = Wxi0_2;
    double v2_0 = Wxi0_0;
    double v2_1 = m_1;
    double v2_2 = Wxi0_2;
    double s_L_0, Y_0, Y_1, Y_2, w69, w70, s_L_1, s_L_2;
    double previous_1 = 0.0;
    for (size_t sweep = 1;; sweep++) {
        const double X2_0 = v1_0 * w2 + v2_0 * w3;
        const double X2_1 = v1_1 * w2 + v2_1 * w3;
        const double w4 = v2_1 * X2_0 - v2_0 * X2_1;
        const double X2_2 = v1_2 * w2 + v2_2 * w3;
        const double w5 = X2_0 * X2_0 + X2_1 * X2_1 + X2_2 * X2_2;
        double c1_1, c2_1, c3_1;
        stumpff_123(w5, &c1_1, &c2_1, &c3_1);
        const double w7 = 1.0 - 0.08333333333333333 * w5;
        const double w8 = 1.0 / (w7 * w7 + 0.25 * w5);
        const double w9 = w8 * (0.25 - 0.08333333333333333 * w7);
        const double w11 = -0.5 * w8;
        const double w12 = w5 * (w9 * c1_1 + w11 * c2_1) - (w11 + c1_1);
        const double w13 = v2_0 * X2_2 - v2_2 * X2_0;
        const double w14 = v2_2 * X2_1 - v2_1 * X2_2;
        const double w15 = X2_0 * w13 - X2_1 * w14;
        const double w16 = w9 + c2_1 + w11 * c1_1 - w9 * c2_1 * w5;
        const double p_2_2 = 0.01 * (v2_2 + w4 * w12 + w15 * w16);
        const double w17 = X2_2 * w14 - X2_0 * w4;
        const double a_6_1 = v2_1 + w12 * w13 + w16 * w17;
        const double w18 = X2_0 * c2_1;
        const double w19 = X2_1 * w18;
        const double w20 = X2_2 * c1_1;
        const double w21 = X2_0 * w18;
        const double w22 = X2_2 * c2_1 * X2_2;
        const double w23 = X2_0 * c1_1;
        const double w24 = X2_1 * c2_1;
        const double w25 = X2_2 * w24;
        const double Q2_7 = g20 * (w19 - w20) + g21 * (1.0 - (w21 + w22)) + g22 * (w23 + w25);
        const double w26 = X2_1 * c1_1;
        const double w27 = X2_2 * w18;
        const double w28 = X2_1 * w24;
        const double Q2_8 = g20 * (w26 + w27) + g21 * (w25 - w23) + g22 * (1.0 - (w21 + w28));
        const double w29 = 1.5 - 2.0 * Q2_8;
        const double w30 = 1.0 / sqrt(1.01 + 1.5 * (w29 - 0.2 * Q2_7));
        const double w31 = w30 * w30 * (0.5 * w30);
        const double w32 = 1.0 / sqrt(1.01 + 1.5 * (w29 + 0.2 * Q2_7));
        const double w33 = w32 * w32 * (0.5 * w32);
        const double w34 = -1.0 - 2.0 * (1.5 * w31 - 1.5 * w33);
        const double w35 = -0.3 * w31 - 0.3 * w33;
        const double Nn2_0 = Q2_7 * w34 - Q2_8 * w35 + 99.0 * a_6_1 * p_2_2;
        const double X1_0 = v1_0 * w3 + v2_0 * w36;
        const double X1_1 = v1_1 * w3 + v2_1 * w36;
        const double w37 = v1_1 * X1_0 - v1_0 * X1_1;
        const double X1_2 = v1_2 * w3 + v2_2 * w36;
        const double w38 = X1_0 * X1_0 + X1_1 * X1_1 + X1_2 * X1_2;
        double c1_2, c2_2, c3_2;
        stumpff_123(w38, &c1_2, &c2_2, &c3_2);
        const double w40 = 1.0 - 0.08333333333333333 * w38;
        const double w41 = 1.0 / (w40 * w40 + 0.25 * w38);
        const double w42 = w41 * (0.25 - 0.08333333333333333 * w40);
        const double w44 = -0.5 * w41;
        const double w45 = w38 * (w42 * c1_2 + w44 * c2_2) - (w44 + c1_2);
        const double w46 = v1_0 * X1_2 - v1_2 * X1_0;
        const double w47 = v1_2 * X1_1 - v1_1 * X1_2;
        const double w48 = X1_0 * w46 - X1_1 * w47;
        const double w49 = w42 + c2_2 + w44 * c1_2 - w42 * c2_2 * w38;
        const double p_2 = 0.01 * (v1_2 + w37 * w45 + w48 * w49);
        const double w50 = X1_2 * w47 - X1_0 * w37;
        const double a_2_1 = v1_1 + w45 * w46 + w49 * w50;
        const double w51 = X1_0 * c2_2;
        const double w52 = X1_1 * w51;
        const double w53 = X1_2 * c1_2;
        const double w54 = X1_0 * w51;
        const double w55 = X1_2 * c2_2 * X1_2;
        const double w56 = X1_0 * c1_2;
        const double w57 = X1_1 * c2_2;
        const double w58 = X1_2 * w57;
        const double Q1_7 = g20 * (w52 - w53) + g21 * (1.0 - (w54 + w55)) + g22 * (w56 + w58);
        const double w59 = X1_1 * c1_2;
        const double w60 = X1_2 * w51;
        const double w61 = X1_1 * w57;
        const double Q1_8 = g20 * (w59 + w60) + g21 * (w58 - w56) + g22 * (1.0 - (w54 + w61));
        const double w62 = 1.5 - 2.0 * Q1_8;
        const double w63 = 1.0 / sqrt(1.01 + 1.5 * (w62 - 0.2 * Q1_7));
        const double w64 = w63 * w63 * (0.5 * w63);
        const double w65 = 1.0 / sqrt(1.01 + 1.5 * (w62 + 0.2 * Q1_7));
        const double w66 = w65 * w65 * (0.5 * w65);
        const double w67 = -1.0 - 2.0 * (1.5 * w64 - 1.5 * w66);
        const double w68 = -0.3 * w64 - 0.3 * w66;
        const double Nn1_0 = Q1_7 * w67 - Q1_8 * w68 + 99.0 * a_2_1 * p_2;
        s_L_0 = m_0 + w1 * (Nn2_0 + Nn1_0);
        Y_0 = (v1_0 + v2_0) * w1;
        Y_1 = (v1_1 + v2_1) * w1;
        Y_2 = (v1_2 + v2_2) * w1;
        w69 = Y_0 * Y_0 + Y_1 * Y_1 + Y_2 * Y_2;
        double c2_3, c3_3;
        stumpff_23(w69, &c2_3, &c3_3);
        w70 = c2_3;
        const double w71 = X2_1 * w4 - X2_2 * w13;
        const double a_6_0 = v2_0 + w12 * w14 + w16 * w71;
        const double Q2_6 = g20 * (1.0 - (w22 + w28)) + g21 * (w19 + w20) + g22 * (w27 - w26);
        const double Nn2_1 = -100.0 * a_6_0 * p_2_2 - w34 * Q2_6;
        const double w72 = X1_1 * w37 - X1_2 * w46;
        const double a_2_0 = v1_0 + w45 * w47 + w49 * w72;
        const double Q1_6 = g20 * (1.0 - (w55 + w61)) + g21 * (w52 + w53) + g22 * (w60 - w59);
        const double Nn1_1 = -100.0 * a_2_0 * p_2 - w67 * Q1_6;
        s_L_1 = m_1 + w1 * (Nn2_1 + Nn1_1);
        const double Nn2_2 = 0.01 * a_6_0 * a_6_1 + w35 * Q2_6;
        const double Nn1_2 = 0.01 * a_2_0 * a_2_1 + w68 * Q1_6;
        s_L_2 = m_2 + w1 * (Nn2_2 + Nn1_2);
        const double w73 = Y_2 * s_L_1 - Y_1 * s_L_2;
        const double w75 = Y_0 * s_L_2 - s_L_0 * Y_2;
        const double w76 = s_L_0 * Y_1 - Y_0 * s_L_1;
        const double w77 = 0.5 * (s_L_0 - w70 * w73 + (Y_2 * w75 - Y_1 * w76) * c3_3);
        const double w78 = X2_1 * Nn2_2 - X2_2 * Nn2_1;
        const double w80 = X2_0 * Nn2_1 - X2_1 * Nn2_0;
        const double w81 = X2_2 * Nn2_0 - X2_0 * Nn2_2;
        const double d2_0 = Nn2_0 + w78 * c2_1 + (X2_1 * w80 - X2_2 * w81) * c3_1;
        const double p_2_0 = 1.01 * a_6_0;
        const double w83 = X2_2 * p_2_0 - X2_0 * p_2_2;
        const double w84 = X2_1 * p_2_2 - X2_2 * a_6_1;
        const double w85 = X2_0 * a_6_1 - X2_1 * p_2_0;
        const double s_2_1 = 0.5 * (a_6_1 - w12 * w83 + w16 * (X2_2 * w84 - X2_0 * w85));
        const double a_5_2 = v2_2 - w4 * w11 + w9 * w15;
        const double a_5_1 = v2_1 - w11 * w13 + w9 * w17;
        const double a_5_0 = v2_0 - w11 * w14 + w9 * w71;
        const double w86 = 0.5 * a_5_2 - 0.08333333333333333 * (X2_0 * a_5_1 - X2_1 * a_5_0);
        const double s_2_2 = 0.5 * (p_2_2 - w12 * w85 + w16 * (X2_0 * w83 - X2_1 * w84));
        const double w87 = 0.5 * a_5_1 - 0.08333333333333333 * (X2_2 * a_5_0 - X2_0 * a_5_2);
        const double s_2_0 = 0.5 * (p_2_0 - w12 * w84 + w16 * (X2_1 * w85 - X2_2 * w83));
        const double w88 = X2_0 * s_2_2 - X2_2 * s_2_0;
        const double w89 = -0.08333333333333333 * a_5_2;
        const double w90 = X2_1 * s_2_0 - X2_0 * s_2_1;
        const double w91 = -0.08333333333333333 * a_5_1;
        const double P2_0 = s_2_1 * w86 - s_2_2 * w87 + (w88 * w89 - w90 * w91);
        const double w92 = X1_1 * Nn1_2 - X1_2 * Nn1_1;
        const double w94 = X1_0 * Nn1_1 - X1_1 * Nn1_0;
        const double w95 = X1_2 * Nn1_0 - X1_0 * Nn1_2;
        const double d1_0 = Nn1_0 + w92 * c2_2 + (X1_1 * w94 - X1_2 * w95) * c3_2;
        const double p_0 = 1.01 * a_2_0;
        const double w97 = X1_2 * p_0 - X1_0 * p_2;
        const double w98 = X1_1 * p_2 - X1_2 * a_2_1;
        const double w99 = X1_0 * a_2_1 - X1_1 * p_0;
        const double s_1 = 0.5 * (a_2_1 - w45 * w97 + w49 * (X1_2 * w98 - X1_0 * w99));
        const double a_2 = v1_2 - w37 * w44 + w42 * w48;
        const double a_1 = v1_1 - w44 * w46 + w42 * w50;
        const double a_0 = v1_0 - w44 * w47 + w42 * w72;
        const double w100 = 0.5 * a_2 - 0.08333333333333333 * (X1_0 * a_1 - X1_1 * a_0);
        const double s_2 = 0.5 * (p_2 - w45 * w99 + w49 * (X1_0 * w97 - X1_1 * w98));
        const double w101 = 0.5 * a_1 - 0.08333333333333333 * (X1_2 * a_0 - X1_0 * a_2);
        const double s_0 = 0.5 * (p_0 - w45 * w98 + w49 * (X1_1 * w99 - X1_2 * w97));
        const double w102 = X1_0 * s_2 - X1_2 * s_0;
        const double w103 = -0.08333333333333333 * a_2;
        const double w104 = X1_1 * s_0 - X1_0 * s_1;
        const double w105 = -0.08333333333333333 * a_1;
        const double P1_0 = s_1 * w100 - s_2 * w101 + (w102 * w103 - w104 * w105);
        const double w1_0 = 2.0 * (d2_0 * w82 + w2 * P2_0 + d1_0 * w96 + w3 * P1_0 + w77);
        const double w106 = c1_2 - 0.5 - w38 * (0.08333333333333333 * c1_2 - 0.5 * c2_2);
        const double w107 = 0.5 * (s_L_2 - w70 * w76 + (Y_1 * w73 - Y_0 * w75) * c3_3);
        const double d2_2 = Nn2_2 + w80 * c2_1 + (X2_0 * w81 - X2_1 * w78) * c3_1;
        const double w108 = 0.5 * a_5_0 - 0.08333333333333333 * (X2_1 * a_5_2 - X2_2 * a_5_1);
        const double w109 = X2_2 * s_2_1 - X2_1 * s_2_2;
        const double w110 = -0.08333333333333333 * a_5_0;
        const double P2_2 = w87 * s_2_0 - s_2_1 * w108 + (w91 * w109 - w88 * w110);
        const double d1_2 = Nn1_2 + w94 * c2_2 + (X1_0 * w95 - X1_1 * w92) * c3_2;
        const double w111 = 0.5 * a_0 - 0.08333333333333333 * (X1_1 * a_2 - X1_2 * a_1);
        const double w112 = X1_2 * s_1 - X1_1 * s_2;
        const double w113 = -0.08333333333333333 * a_0;
        const double P1_2 = w101 * s_0 - s_1 * w111 + (w105 * w112 - w102 * w113);
        const double w1_2 = 2.0 * (w2 * P2_2 + w82 * d2_2 + w96 * d1_2 + w3 * P1_2 + w107);
        const double w114 = 0.5 * (s_L_1 - w70 * w75 + (Y_0 * w76 - Y_2 * w73) * c3_3);
        const double d2_1 = Nn2_1 + w81 * c2_1 + (X2_2 * w78 - X2_0 * w80) * c3_1;
        const double P2_1 = s_2_2 * w108 - w86 * s_2_0 + (w90 * w110 - w89 * w109);
        const double d1_1 = Nn1_1 + w95 * c2_2 + (X1_2 * w92 - X1_0 * w94) * c3_2;
        const double P1_1 = s_2 * w111 - w100 * s_0 + (w104 * w113 - w103 * w112);
        const double w1_1 = 2.0 * (w2 * P2_1 + w82 * d2_1 + w96 * d1_1 + w3 * P1_1 + w114);
        const double w115 = X1_1 * w1_2 - X1_2 * w1_1;
        const double w116 = 0.08333333333333333 + c2_2 - 0.5 * c1_2
            - 0.08333333333333333 * c2_2 * w38;
        const double w117 = X1_0 * w1_1 - X1_1 * w1_0;
        const double w118 = X1_2 * w1_0 - X1_0 * w1_2;
        const double Wxi1_0 = 0.9900990099009901
            * (w1_0 - w106 * w115 + w116 * (X1_1 * w117 - X1_2 * w118));
        const double Wxi1_2 = 100.0 * (w1_2 - w106 * w117 + w116 * (X1_0 * w118 - X1_1 * w115));
        const double Pxi1_1 = w1_1 - w106 * w118 + w116 * (X1_2 * w115 - X1_0 * w117);
        const double w119 = X1_1 * Wxi1_2 - X1_2 * Pxi1_1;
        const double w120 = X1_0 * Pxi1_1 - X1_1 * Wxi1_0;
        const double w121 = X1_2 * Wxi1_0 - X1_0 * Wxi1_2;
        const double w2_0 = 2.0 * (d2_0 * w96 + w3 * P2_0 + d1_0 * w122 + w36 * P1_0 + w77);
        const double w123 = c1_1 - 0.5 - w5 * (0.08333333333333333 * c1_1 - 0.5 * c2_1);
        const double w2_2 = 2.0 * (w3 * P2_2 + w96 * d2_2 + d1_2 * w122 + w36 * P1_2 + w107);
        const double w2_1 = 2.0 * (w3 * P2_1 + w96 * d2_1 + d1_1 * w122 + w36 * P1_1 + w114);
        const double w124 = X2_1 * w2_2 - X2_2 * w2_1;
        const double w125 = 0.08333333333333333 + c2_1 - 0.5 * c1_1
            - 0.08333333333333333 * c2_1 * w5;
        const double w126 = X2_0 * w2_1 - X2_1 * w2_0;
        const double w127 = X2_2 * w2_0 - X2_0 * w2_2;
        const double Wxi2_0 = 0.9900990099009901
            * (w2_0 - w123 * w124 + w125 * (X2_1 * w126 - X2_2 * w127));
        const double Wxi2_2 = 100.0 * (w2_2 - w123 * w126 + w125 * (X2_0 * w127 - X2_1 * w124));
        const double Pxi2_1 = w2_1 - w123 * w127 + w125 * (X2_2 * w124 - X2_0 * w126);
        const double w128 = X2_1 * Wxi2_2 - X2_2 * Pxi2_1;
        const double w129 = X2_0 * Pxi2_1 - X2_1 * Wxi2_0;
        const double w130 = X2_2 * Wxi2_0 - X2_0 * Wxi2_2;
        const double next_v1_0 = Wxi1_0 + w106 * w119 + w116 * (X1_1 * w120 - X1_2 * w121);
        const double next_v1_1 = Pxi1_1 + w106 * w121 + w116 * (X1_2 * w119 - X1_0 * w120);
        const double next_v1_2 = Wxi1_2 + w106 * w120 + w116 * (X1_0 * w121 - X1_1 * w119);
        const double next_v2_0 = Wxi2_0 + w123 * w128 + w125 * (X2_1 * w129 - X2_2 * w130);
        const double next_v2_1 = Pxi2_1 + w123 * w130 + w125 * (X2_2 * w128 - X2_0 * w129);
        const double next_v2_2 = Wxi2_2 + w123 * w129 + w125 * (X2_0 * w130 - X2_1 * w128);
        const double change_v1_0 = fabs(next_v1_0 - v1_0);
        const double change_v1_1 = fabs(next_v1_1 - v1_1);
        const double change_v1_2 = fabs(next_v1_2 - v1_2);
        const double change_v2_0 = fabs(next_v2_0 - v2_0);
        const double change_v2_1 = fabs(next_v2_1 - v2_1);
        const double change_v2_2 = fabs(next_v2_2 - v2_2);
        const double change = greater(greater(change_v1_0, greater(change_v1_1, change_v1_2)),
            greater(change_v2_0, greater(change_v2_1, change_v2_2)));
        const double scale = greater(greater(1.0, greater(fabs(v1_0), fabs(v1_1))),
            greater(greater(fabs(v1_2), fabs(v2_0)), greater(fabs(v2_1), fabs(v2_2))));
        if (!isfinite(change_v1_0 + change_v1_1 + change_v1_2 + change_v2_0 + change_v2_1
            + change_v2_2)) {
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
        v1_0 = next_v1_0;
        v1_1 = next_v1_1;
        v1_2 = next_v1_2;
        v2_0 = next_v2_0;
        v2_1 = next_v2_1;
        v2_2 = next_v2_2;
    }
    const double w131 = Y_1 * w70;
    const double w132 = Y_1 * w131;
    const double w133 = Y_2 * w70 * Y_2;
    const double g_0 = 1.0 - (w132 + w133);
    const double c1_3 = stumpff_1(w69);
    const double w135 = Y_2 * c1_3;
    const double w136 = Y_0 * w70;
    const double w137 = Y_1 * w136;
    const double g_3 = w135 + w137;
    const double w138 = Y_2 * w136;
    const double w139 = Y_1 * c1_3;
    const double g_6 = w138 - w139;
    const double q1_0 = g00 * g_0 + g01 * g_3 + g02 * g_6;
    const double g_1 = w137 - w135;
    const double w140 = Y_0 * w136;
    const double g_4 = 1.0 - (w133 + w140);
    const double w141 = Y_0 * c1_3;
    const double w142 = Y_2 * w131;
    const double g_7 = w141 + w142;
    const double q1_1 = g00 * g_1 + g01 * g_4 + g02 * g_7;
    const double g_2 = w138 + w139;
    const double g_5 = w142 - w141;
    const double g_8 = 1.0 - (w132 + w140);
    const double q1_2 = g00 * g_2 + g01 * g_5 + g02 * g_8;
    const double q1_3 = g10 * g_0 + g11 * g_3 + g12 * g_6;
    const double q1_4 = g10 * g_1 + g11 * g_4 + g12 * g_7;
    const double q1_5 = g10 * g_2 + g11 * g_5 + g12 * g_8;
    const double q1_6 = g20 * g_0 + g21 * g_3 + g22 * g_6;
    const double q1_7 = g20 * g_1 + g21 * g_4 + g22 * g_7;
    const double q1_8 = g20 * g_2 + g21 * g_5 + g22 * g_8;
    const double new_mu0 = s_L_0 * q1_0 + s_L_1 * q1_1 + s_L_2 * q1_2;
    const double new_mu1 = s_L_0 * q1_3 + s_L_1 * q1_4 + s_L_2 * q1_5;
    const double new_mu2 = s_L_0 * q1_6 + s_L_1 * q1_7 + s_L_2 * q1_8;
    if (!(isfinite(q1_0) && isfinite(q1_1) && isfinite(q1_2) && isfinite(q1_3) && isfinite(q1_4)
        && isfinite(q1_5) && isfinite(q1_6) && isfinite(q1_7) && isfinite(q1_8)
        && isfinite(new_mu0) && isfinite(new_mu1) && isfinite(new_mu2))) {
        return DIPOLE_VRKMK2_GAUSS2_NOT_FINITE;
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
