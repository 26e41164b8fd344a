/*
 * Dipole on a stick, T*SO(3) (thesis section 3.6): one step by vcg:midpoint
 *
 * method:     family vcg, tableau midpoint
 * source:     Table 3.2a of Bogfjellmo and Marthinsen
 * order:      2, certificate: exact (every order condition up to it is zero in exact arithmetic)
 * scene:      Dipole on a stick, T*SO(3) (thesis section 3.6), group SO(3)
 * solved by:  the equations of xi1, n1: Newton's method, 3 unknowns (3.4 sweeps of 285 operations
 *             and 0.12 matrices of 851 a step, not 5.6 sweeps of 270 operations)
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
 *             3 Adtinv, 1 force (dead code)
 *             1 Adt, 2 dexpt (functions)
 *             1 Adinv (opposites)
 *             1 legendre (sharing)
 *             1 lin, 2 seriest (factors)
 *             parameters, folded: beta = 1, depth = 3/2
 *             the time: the scene does not depend on it
 * operations: 42 add, 59 mul, 1 stumpff_12 a step
 *             2 mul a start, in steps that follow no other
 *             277 add, 445 mul, 2 slope2, 2 slope3, 1 stumpff_3 a matrix of the equations of xi1,
 *             n1
 *             75 add, 127 mul, 2 div, 2 sqrt, 1 stumpff_12, 1 stumpff_23, 1 stumpff_3 a sweep of
 *             the equations of xi1, n1
 * stack:      at most 3840 bytes, without what the mathematical library takes
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

/* The derivative of c_3 for z >= 0 */
static inline double slope3(double z)
{
    if (z > 1.0) {
        double before, c;
        stumpff_23(z, &before, &c);
        return 0.5 * (before - 3.0 * c) / z;
    }
    double total = 6.576508197299464e-17;
    total = -1.9680200780418645e-14 + z * total;
    total = 4.58829823909189e-12 + z * total;
    total = -8.029521918410807e-10 + z * total;
    total = 1.0020843354176688e-07 + z * total;
    total = -8.267195767195768e-06 + z * total;
    total = 0.0003968253968253968 + z * total;
    total = -0.008333333333333333 + z * total;
    return total;
}

/* The derivative of c_2 for z >= 0 */
static inline double slope2(double z)
{
    if (z > 1.0) {
        double before, c;
        stumpff_12(z, &before, &c);
        return 0.5 * (before - 2.0 * c) / z;
    }
    double total = 1.249536557486898e-15;
    total = -3.3456341326711696e-13 + z * total;
    total = 6.882447358637835e-11 + z * total;
    total = -1.043837849393405e-08 + z * total;
    total = 1.1022927689594355e-06 + z * total;
    total = -7.440476190476191e-05 + z * total;
    total = 0.002777777777777778 + z * total;
    total = -0.041666666666666664 + z * total;
    return total;
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

static void count_matrix(dipole_vcg_midpoint_statistics *statistics)
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
        xi1_0 = 0.9900990099009901 * m_0;
        xi1_1 = m_1;
        xi1_2 = 100.0 * m_2;
    }
    const double w1 = 0.5 * h;
    const double w39 = -0.5 * h;
    /* the equations of xi1, n1: Newton's method in xi1_0, xi1_1, xi1_2 */
    double s_mu_0, xe1_0, xe1_1, xe1_2, w29, s_mu_2, s_mu_1;
    double previous_1 = 0.0;
    int make_1 = !memory->made_1;
    for (size_t sweep = 1;; sweep++) {
        const double xE1_1_1 = xi1_1 * w1;
        const double xE1_1_0 = xi1_0 * w1;
        const double xE1_1_2 = xi1_2 * w1;
        const double w2 = xE1_1_2 * xE1_1_2;
        const double w3 = xE1_1_0 * xE1_1_0 + xE1_1_1 * xE1_1_1 + w2;
        double c1_1, c2_1;
        stumpff_12(w3, &c1_1, &c2_1);
        const double w5 = xE1_1_1 * c2_1;
        const double w6 = xE1_1_1 * w5;
        const double w7 = xE1_1_2 * c2_1;
        const double w8 = xE1_1_2 * w7;
        const double gE1_1_0 = 1.0 - (w6 + w8);
        const double p_2 = 0.01 * xi1_2;
        const double w9 = xE1_1_0 * c2_1;
        const double w10 = xE1_1_1 * w9;
        const double w12 = xE1_1_2 * c1_1;
        const double gE1_1_1 = w10 - w12;
        const double w13 = xE1_1_0 * w9;
        const double gE1_1_4 = 1.0 - (w8 + w13);
        const double w14 = xE1_1_0 * c1_1;
        const double w15 = xE1_1_2 * w5;
        const double gE1_1_7 = w14 + w15;
        const double Q1_7 = g20 * gE1_1_1 + g21 * gE1_1_4 + g22 * gE1_1_7;
        const double w16 = xE1_1_1 * c1_1;
        const double w17 = xE1_1_2 * w9;
        const double gE1_1_2 = w16 + w17;
        const double gE1_1_5 = w15 - w14;
        const double gE1_1_8 = 1.0 - (w6 + w13);
        const double Q1_8 = g20 * gE1_1_2 + g21 * gE1_1_5 + g22 * gE1_1_8;
        const double w18 = 1.5 - 2.0 * Q1_8;
        const double w19 = 1.0 / sqrt(1.01 + 1.5 * (w18 - 0.2 * Q1_7));
        const double w20 = w19 * w19;
        const double w21 = 0.5 * w19;
        const double w22 = w20 * w21;
        const double w23 = 1.0 / sqrt(1.01 + 1.5 * (w18 + 0.2 * Q1_7));
        const double w24 = w23 * w23;
        const double w25 = 0.5 * w23;
        const double w26 = w24 * w25;
        const double w27 = -1.0 - 2.0 * (1.5 * w22 - 1.5 * w26);
        const double w28 = -0.3 * w22 - 0.3 * w26;
        const double Nr1_0 = Q1_7 * w27 - Q1_8 * w28 + 99.0 * xi1_1 * p_2;
        s_mu_0 = m_0 + h * Nr1_0;
        xe1_0 = h * xi1_0;
        xe1_1 = h * xi1_1;
        xe1_2 = h * xi1_2;
        w29 = xe1_0 * xe1_0 + xe1_1 * xe1_1 + xe1_2 * xe1_2;
        const double w30 = 0.25 * w29;
        const double c3_1 = stumpff_3(w30);
        const double w32 = 0.25 * c3_1;
        const double w33 = 0.01 * xi1_0;
        const double gE1_1_3 = w10 + w12;
        const double gE1_1_6 = w17 - w16;
        const double Q1_6 = g20 * gE1_1_0 + g21 * gE1_1_3 + g22 * gE1_1_6;
        const double Nr1_2 = xi1_1 * w33 + w28 * Q1_6;
        s_mu_2 = m_2 + h * Nr1_2;
        const double w34 = xe1_0 * s_mu_2 - s_mu_0 * xe1_2;
        const double w35 = -100.0 * xi1_0 * p_2;
        const double w36 = w27 * Q1_6;
        const double Nr1_1 = w35 - w36;
        s_mu_1 = m_1 + h * Nr1_1;
        const double w37 = s_mu_0 * xe1_1 - xe1_0 * s_mu_1;
        const double w38 = xe1_2 * w34 - xe1_1 * w37;
        const double y1_2_0 = xi1_0 * w39;
        const double y1_2_1 = xi1_1 * w39;
        const double y1_2_2 = xi1_2 * w39;
        const double w40 = y1_2_0 * y1_2_0 + y1_2_1 * y1_2_1 + y1_2_2 * y1_2_2;
        double c2_2, c3_2;
        stumpff_23(w40, &c2_2, &c3_2);
        const double w42 = Nr1_2 * y1_2_1 - Nr1_1 * y1_2_2;
        const double w44 = Nr1_1 * y1_2_0 - Nr1_0 * y1_2_1;
        const double w45 = Nr1_0 * y1_2_2 - Nr1_2 * y1_2_0;
        const double w46 = y1_2_1 * w44 - y1_2_2 * w45;
        const double Wf1_0 = 0.9900990099009901
            * (s_mu_0 + w32 * w38 + w39 * (Nr1_0 + w42 * c2_2 + w46 * c3_2));
        const double w47 = xe1_2 * s_mu_1 - xe1_1 * s_mu_2;
        const double w48 = xe1_0 * w37 - xe1_2 * w47;
        const double w49 = y1_2_2 * w42 - y1_2_0 * w44;
        const double M1_2_1 = s_mu_1 + w32 * w48 + w39 * (Nr1_1 + w45 * c2_2 + w49 * c3_2);
        const double w50 = xe1_1 * w47 - xe1_0 * w34;
        const double w51 = y1_2_0 * w45 - y1_2_1 * w42;
        const double Wf1_2 = 100.0 * (s_mu_2 + w32 * w50 + w39 * (Nr1_2 + w44 * c2_2 + w51 * c3_2));
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
        if (make_1) {
            const double w52 = w1 * c2_1;
            const double w53 = xE1_1_2 * w52;
            const double w54 = xE1_1_1 * w52;
            const double w55 = -50.0 * h;
            const double w56 = w55 * c3_2;
            const double w57 = 25.0 * c3_1;
            const double w58 = xe1_0 * w57;
            const double w59 = h * s_mu_2;
            const double w60 = slope3(w40);
            const double w61 = slope2(w40);
            const double w62 = w51 * w55 * w60 + w44 * w55 * w61;
            const double w63 = 2.0 * y1_2_0 * w39;
            const double w64 = 100.0 * w50;
            const double w65 = 0.0625 * slope3(w30);
            const double w66 = 2.0 * xe1_0 * w65 * h;
            const double w67 = w45 * w56 * w39 - w34 * w57 * h - w58 * w59 + w62 * w63 + w64 * w66;
            const double w68 = w55 * c2_2;
            const double w69 = Nr1_1 * w39;
            const double w70 = y1_2_0 * w56;
            const double w71 = Nr1_2 * w39;
            const double w72 = h * xe1_0;
            const double w73 = xe1_1 * w57;
            const double w74 = h * xe1_1;
            const double w75 = y1_2_1 * w56;
            const double w76 = 100.0 * h + w55 - w58 * w72 - w73 * w74 - y1_2_0 * w70 - y1_2_1 * w75;
            const double w77 = g22 * w28;
            const double w78 = g21 * w28;
            const double w79 = 0.01 * xi1_1 + w53 * w77 + w54 * w78;
            const double w80 = w1 * w9;
            const double w81 = w80 + xE1_1_0 * w52;
            const double w82 = w1 * c1_1;
            const double w83 = g21 * w82;
            const double w84 = g20 * w53 - (g22 * w81 + w83);
            const double w85 = -2.0 * Q1_7;
            const double w86 = w24 * (0.5 * w24 + 2.0 * w23 * w25) * w25;
            const double w87 = 2.25 * w86;
            const double w88 = 0.45 * w86;
            const double w89 = w85 * w87 - Q1_8 * w88;
            const double w90 = w20 * (0.5 * w20 + 2.0 * w19 * w21) * w21;
            const double w91 = -2.25 * w90;
            const double w92 = 0.45 * w90;
            const double w93 = w85 * w91 - Q1_8 * w92;
            const double w94 = -2.0 * w89 - w28 - 2.0 * w93;
            const double w95 = h * xe1_2;
            const double w96 = w58 * w95 - y1_2_1 * w68 + y1_2_2 * w70;
            const double w97 = Q1_6 * w88;
            const double w98 = Q1_6 * w92;
            const double w99 = -2.0 * w97 - 2.0 * w98;
            const double w100 = w94 * w96 + w76 * w99;
            const double w101 = w73 * w95 + y1_2_0 * w68 + y1_2_2 * w75;
            const double w102 = 2.0 * Q1_6;
            const double w103 = w87 * w102;
            const double w104 = w91 * w102;
            const double w105 = -2.0 * w103 - 2.0 * w104;
            const double w106 = g22 * w27;
            const double w107 = g21 * w27;
            const double w108 = w84 * w105 - (xi1_2 + w53 * w106 + w54 * w107);
            const double w109 = w67 + w68 * w69 - w70 * w71 + w76 * w79 + w84 * w100 + w101 * w108;
            const double w110 = g22 * w82;
            const double w111 = w110 - g21 * w81 + g20 * w54;
            const double w112 = w27 + 0.2 * w89 - 0.2 * w93;
            const double w113 = 0.2 * w97 - 0.2 * w98;
            const double w114 = 0.2 * w103 - 0.2 * w104;
            const double w115 = w96 * w112 + w76 * w113 + w101 * w114;
            const double w116 = w109 + w111 * w115;
            const double w117 = 0.24752475247524752 * c3_1;
            const double w118 = xe1_1 * w117;
            const double w119 = h * s_mu_1;
            const double w120 = xe1_2 * w117;
            const double w121 = -0.49504950495049505 * h;
            const double w122 = w46 * w121 * w60 + w42 * w121 * w61;
            const double w123 = 0.9900990099009901 * w38;
            const double w124 = w121 * c3_2;
            const double w125 = y1_2_1 * w124;
            const double w126 = y1_2_2 * w124;
            const double w127 = w118 * w119 + w59 * w120 + w63 * w122 + w66 * w123 + w69 * w125
                + w71 * w126;
            const double w128 = w121 * c2_2;
            const double w129 = y1_2_0 * w126 + w72 * w120 + y1_2_1 * w128;
            const double w130 = 0.9900990099009901 * h + w121 - w74 * w118 - w95 * w120 - y1_2_1 * w125
                - y1_2_2 * w126;
            const double w131 = w94 * w130 + w99 * w129;
            const double w132 = y1_2_0 * w125 + w72 * w118 - y1_2_2 * w128;
            const double w133 = w112 * w130 + w113 * w129 + w114 * w132;
            const double w134 = w127 + w79 * w129 + w84 * w131 + w108 * w132 + w111 * w133;
            const double w135 = w39 * c3_2;
            const double w136 = xe1_0 * w32;
            const double w137 = w39 * w49 * w60 + w39 * w45 * w61;
            const double w138 = w32 * w37 * h - w44 * w135 * w39 - w119 * w136 + w63 * w137 + w48 * w66;
            const double w139 = y1_2_0 * w135;
            const double w140 = w39 * c2_2;
            const double w141 = xe1_2 * w32;
            const double w142 = y1_2_2 * w135;
            const double w143 = w74 * w141 - y1_2_0 * w140 + y1_2_1 * w142;
            const double w144 = y1_2_1 * w139 + w74 * w136 + y1_2_2 * w140;
            const double w145 = w94 * w144 + w99 * w143;
            const double w146 = h + w39 - w72 * w136 - w95 * w141 - y1_2_0 * w139 - y1_2_2 * w142;
            const double w147 = w138 - w69 * w139 - w71 * w140 + w79 * w143 + w84 * w145 + w108 * w146;
            const double w148 = w112 * w144 + w113 * w143 + w114 * w146;
            const double w149 = w147 + w111 * w148;
            const double w150 = 2.0 * xE1_1_0 * w1;
            const double c3_3 = stumpff_3(w3);
            const double w151 = 0.5 * (c3_3 - c2_1);
            const double w152 = xE1_1_1 * w151;
            const double w153 = slope2(w3);
            const double w154 = w2 * w153;
            const double w155 = xE1_1_1 * w153;
            const double w156 = xE1_1_1 * w155;
            const double w157 = xE1_1_2 * w151;
            const double w158 = xE1_1_0 * w153;
            const double w159 = xE1_1_2 * w158;
            const double w160 = xE1_1_1 * w158;
            const double w161 = Wf1_2 * w152 - (Wf1_0 * w154 + Wf1_0 * w156 + M1_2_1 * w157)
                + Wf1_2 * w159 + M1_2_1 * w160;
            const double w162 = g21 * w157 - (g20 * w154 + g20 * w156) - g22 * w152;
            const double w163 = w28 * w162 + w77 * w159 + w78 * w160;
            const double w164 = xE1_1_0 * w158;
            const double w165 = xE1_1_0 * w151;
            const double w166 = xE1_1_2 * w155;
            const double w167 = g20 * w152 - (g22 * w156 + g22 * w164) - g21 * w165 + g21 * w166
                + g20 * w159;
            const double w168 = w105 * w167 - (w27 * w162 + w106 * w159 + w107 * w160);
            const double w169 = g22 * w165 - (g21 * w154 + g21 * w164 + g20 * w157) + g22 * w166
                + g20 * w160;
            const double w170 = w76 * w163 + w100 * w167 + w101 * w168 + w115 * w169;
            const double w171 = w129 * w163 + w131 * w167 + w132 * w168 + w133 * w169;
            const double w172 = w143 * w163 + w145 * w167 + w146 * w168 + w148 * w169;
            const double w173 = w161 + gE1_1_2 * w170 + gE1_1_0 * w171 + gE1_1_1 * w172;
            const double w174 = Wf1_2 * w53 + M1_2_1 * w54 + gE1_1_2 * w116 + gE1_1_0 * w134
                + gE1_1_1 * w149 + w150 * w173;
            const double w175 = Wf1_2 * w82;
            const double w176 = 2.0 * w5 * w1;
            const double w177 = 2.0 * y1_2_1 * w39;
            const double w178 = 2.0 * xe1_1 * w65 * h;
            const double w179 = w47 * w57 * h - w42 * w56 * w39 - w59 * w73 + w62 * w177 + w64 * w178;
            const double w180 = Nr1_0 * w39;
            const double w181 = 0.99 * xi1_2;
            const double w182 = w110 + g20 * w176;
            const double w183 = w33 - w28 * w182 + w78 * w80;
            const double w184 = g20 * w82;
            const double w185 = w1 * w7;
            const double w186 = w184 - g22 * w176 + g21 * w185;
            const double w187 = w179 - w68 * w180 - w71 * w75 + w96 * w181 + w76 * w183 + w100 * w186;
            const double w188 = w27 * w182 - w80 * w107 + w105 * w186;
            const double w189 = g20 * w80;
            const double w190 = g22 * w185 + w189;
            const double w191 = w187 + w101 * w188 + w115 * w190;
            const double w192 = h * s_mu_0;
            const double w193 = w44 * w124 * w39 - w37 * w117 * h - w118 * w192 + w122 * w177
                + w123 * w178;
            const double w194 = w193 - w125 * w180 + w71 * w128 + w130 * w181 + w129 * w183
                + w131 * w186;
            const double w195 = w194 + w132 * w188 + w133 * w190;
            const double w196 = w136 * w192 + w59 * w141 + w137 * w177 + w48 * w178 + w139 * w180
                + w71 * w142;
            const double w197 = w196 + w144 * w181 + w143 * w183 + w145 * w186 + w146 * w188
                + w148 * w190;
            const double w198 = w175 - Wf1_0 * w176 + M1_2_1 * w80 + gE1_1_2 * w191 + gE1_1_0 * w195
                + gE1_1_1 * w197;
            const double w199 = 2.0 * xE1_1_1 * w1;
            const double w200 = 2.0 * w7 * w1;
            const double w201 = M1_2_1 * w82;
            const double w202 = 2.0 * y1_2_2 * w39;
            const double w203 = 2.0 * xe1_2 * w65 * h;
            const double w204 = w39 * (w36 - w35);
            const double w205 = w58 * w192 + w73 * w119 + w62 * w202 + w64 * w203 + w70 * w180
                - w75 * w204;
            const double w206 = 0.99 * xi1_1;
            const double w207 = w83 - g20 * w200;
            const double w208 = w28 * w207 + w77 * w80;
            const double w209 = w1 * w5;
            const double w210 = w189 + g21 * w209;
            const double w211 = w105 * w210 - (xi1_0 + w27 * w207 + w80 * w106);
            const double w212 = g22 * w209 - (w184 + g21 * w200);
            const double w213 = w205 + w96 * w206 + w76 * w208 + w100 * w210 + w101 * w211
                + w115 * w212;
            const double w214 = w34 * w117 * h - w45 * w124 * w39 - w120 * w192 + w122 * w202
                + w123 * w203;
            const double w215 = w214 - w126 * w180 + w128 * w204 + w130 * w206 + w129 * w208
                + w131 * w210;
            const double w216 = w215 + w132 * w211 + w133 * w212;
            const double w217 = w42 * w135 * w39 - w32 * w47 * h - w119 * w141 + w137 * w202
                + w48 * w203;
            const double w218 = w217 + w140 * w180 + w142 * w204 + w144 * w206 + w143 * w208
                + w145 * w210;
            const double w219 = w218 + w146 * w211 + w148 * w212;
            const double w220 = Wf1_2 * w80 - (Wf1_0 * w200 + w201) + gE1_1_2 * w213 + gE1_1_0 * w216
                + gE1_1_1 * w219;
            const double w221 = 2.0 * xE1_1_2 * w1;
            const double w222 = Wf1_0 * w54 - (w175 + M1_2_1 * w81) + gE1_1_5 * w116 + gE1_1_3 * w134
                + gE1_1_4 * w149;
            const double w223 = Wf1_0 * w157 - (M1_2_1 * w154 + M1_2_1 * w164) - Wf1_2 * w165
                + Wf1_2 * w166 + Wf1_0 * w160;
            const double w224 = w223 + gE1_1_5 * w170 + gE1_1_3 * w171 + gE1_1_4 * w172;
            const double w225 = Wf1_0 * w80;
            const double w226 = Wf1_2 * w185 + w225 + gE1_1_5 * w191 + gE1_1_3 * w195 + gE1_1_4 * w197
                + w199 * w224;
            const double w227 = Wf1_0 * w82;
            const double w228 = w227 - M1_2_1 * w200 + Wf1_2 * w209 + gE1_1_5 * w213 + gE1_1_3 * w216
                + gE1_1_4 * w219;
            const double w229 = w201 - Wf1_2 * w81 + Wf1_0 * w53 + gE1_1_8 * w116 + gE1_1_6 * w134
                + gE1_1_7 * w149;
            const double w230 = M1_2_1 * w165 - (Wf1_2 * w156 + Wf1_2 * w164 + Wf1_0 * w152)
                + M1_2_1 * w166 + Wf1_0 * w159;
            const double w231 = w230 + gE1_1_8 * w170 + gE1_1_6 * w171 + gE1_1_7 * w172;
            const double w232 = M1_2_1 * w185 - (w227 + Wf1_2 * w176) + gE1_1_8 * w191 + gE1_1_6 * w195
                + gE1_1_7 * w197;
            const double w233 = w225 + M1_2_1 * w209 + gE1_1_8 * w213 + gE1_1_6 * w216 + gE1_1_7 * w219
                + w221 * w231;
            memory->inverse_1[0] = 1.0 - w174;
            memory->inverse_1[1] = -(w198 + w173 * w199);
            memory->inverse_1[2] = -(w220 + w173 * w221);
            memory->inverse_1[3] = -(w222 + w150 * w224);
            memory->inverse_1[4] = 1.0 - w226;
            memory->inverse_1[5] = -(w228 + w221 * w224);
            memory->inverse_1[6] = -(w229 + w150 * w231);
            memory->inverse_1[7] = -(w232 + w199 * w231);
            memory->inverse_1[8] = 1.0 - w233;
            size_t order_1[3];
            memory->made_1 = invert(3, memory->inverse_1, order_1);
            count_matrix(statistics);
            if (!memory->made_1) {
                count_sweeps(statistics, 0, sweep, 1);
                return DIPOLE_VCG_MIDPOINT_NOT_CONVERGED;
            }
        }
        const double change_xi1_0 = memory->inverse_1[0] * residual_xi1_0
            + memory->inverse_1[1] * residual_xi1_1 + memory->inverse_1[2] * residual_xi1_2;
        const double change_xi1_1 = memory->inverse_1[3] * residual_xi1_0
            + memory->inverse_1[4] * residual_xi1_1 + memory->inverse_1[5] * residual_xi1_2;
        const double change_xi1_2 = memory->inverse_1[6] * residual_xi1_0
            + memory->inverse_1[7] * residual_xi1_1 + memory->inverse_1[8] * residual_xi1_2;
        const double change = greater(fabs(change_xi1_0), greater(fabs(change_xi1_1),
            fabs(change_xi1_2)));
        const double scale = greater(greater(1.0, fabs(xi1_0)), greater(fabs(xi1_1), fabs(xi1_2)));
        const int still = previous_1 > 0.0 && change >= previous_1;
        const int close = change <= 3.552713678800501e-15 * scale
            && change * change <= 1.1102230246251565e-16 * scale * previous_1;
        xi1_0 += change_xi1_0;
        xi1_1 += change_xi1_1;
        xi1_2 += change_xi1_2;
        if (close || (still && change <= 5.684341886080802e-14 * scale)) {
            count_sweeps(statistics, 0, sweep, 0);
            break;
        }
        if (sweep == 100) {
            count_sweeps(statistics, 0, sweep, 1);
            return DIPOLE_VCG_MIDPOINT_NOT_CONVERGED;
        }
        make_1 = 0.0625 * previous_1 > 0.0 && change > 0.0625 * previous_1;
        previous_1 = change;
    }
    double c1_2, c2_3;
    stumpff_12(w29, &c1_2, &c2_3);
    const double w235 = xe1_1 * c2_3;
    const double w236 = xe1_1 * w235;
    const double w237 = xe1_2 * c2_3 * xe1_2;
    const double ge1_0 = 1.0 - (w236 + w237);
    const double w239 = xe1_2 * c1_2;
    const double w240 = xe1_0 * c2_3;
    const double w241 = xe1_1 * w240;
    const double ge1_3 = w239 + w241;
    const double w242 = xe1_2 * w240;
    const double w243 = xe1_1 * c1_2;
    const double ge1_6 = w242 - w243;
    const double q1_0 = g00 * ge1_0 + g01 * ge1_3 + g02 * ge1_6;
    const double ge1_1 = w241 - w239;
    const double w244 = xe1_0 * w240;
    const double ge1_4 = 1.0 - (w237 + w244);
    const double w245 = xe1_0 * c1_2;
    const double w246 = xe1_2 * w235;
    const double ge1_7 = w245 + w246;
    const double q1_1 = g00 * ge1_1 + g01 * ge1_4 + g02 * ge1_7;
    const double ge1_2 = w242 + w243;
    const double ge1_5 = w246 - w245;
    const double ge1_8 = 1.0 - (w236 + w244);
    const double q1_2 = g00 * ge1_2 + g01 * ge1_5 + g02 * ge1_8;
    const double q1_3 = g10 * ge1_0 + g11 * ge1_3 + g12 * ge1_6;
    const double q1_4 = g10 * ge1_1 + g11 * ge1_4 + g12 * ge1_7;
    const double q1_5 = g10 * ge1_2 + g11 * ge1_5 + g12 * ge1_8;
    const double q1_6 = g20 * ge1_0 + g21 * ge1_3 + g22 * ge1_6;
    const double q1_7 = g20 * ge1_1 + g21 * ge1_4 + g22 * ge1_7;
    const double q1_8 = g20 * ge1_2 + g21 * ge1_5 + g22 * ge1_8;
    const double new_mu0 = s_mu_0 * q1_0 + s_mu_1 * q1_1 + s_mu_2 * q1_2;
    const double new_mu1 = s_mu_0 * q1_3 + s_mu_1 * q1_4 + s_mu_2 * q1_5;
    const double new_mu2 = s_mu_0 * q1_6 + s_mu_1 * q1_7 + s_mu_2 * q1_8;
    if (!(isfinite(q1_0) && isfinite(q1_1) && isfinite(q1_2) && isfinite(q1_3) && isfinite(q1_4)
        && isfinite(q1_5) && isfinite(q1_6) && isfinite(q1_7) && isfinite(q1_8)
        && isfinite(new_mu0) && isfinite(new_mu1) && isfinite(new_mu2))) {
        return DIPOLE_VCG_MIDPOINT_NOT_FINITE;
    }
    memmove(memory->past[1], memory->past[0], 2 * sizeof memory->past[0]);
    memory->past[0][0] = xi1_0;
    memory->past[0][1] = xi1_1;
    memory->past[0][2] = xi1_2;
    if (memory->known < 3) {
        memory->known++;
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
