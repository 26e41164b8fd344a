/*
 * Dipole on a stick, T*SO(3) (thesis section 3.6): one step by vrkmk(2):gauss2
 *
 * method:     family vrkmk(2), tableau gauss2
 * source:     Hammer and Hollingsworth 1955; Hairer, Lubich and Wanner, Table II.1.1; Table 3.1c
 *             of Bogfjellmo and Marthinsen
 * order:      4, certificate: exact (every order condition up to it is zero in exact arithmetic)
 * scene:      Dipole on a stick, T*SO(3) (thesis section 3.6), group SO(3)
 * solved by:  the equations of v1, v2, m1, m2: Newton's method with the matrix to first order in
 *             h, 6 unknowns (1.9 sweeps of 957 operations and 1.00 matrices of 671 a step; fixed
 *             point: 3.3 sweeps of 891 operations; Newton's method: 2.6 sweeps of 957 operations
 *             and 0.05 matrices of 5374)
 * state:      [0..8] q: element of SO(3), row by row
 *             [9..11] mu: right-trivialised momentum in the dual algebra of SO(3)
 * left out:   7 dexpt, 1 lin (sharing)
 *             1 dexpt, 2 lin (dead code)
 *             2 dexpt (common sums)
 *             1 lin (sharing)
 *             3 hamilton (body frame)
 *             2 Adt (opposites)
 *             1 force, 1 lin (dead code)
 *             2 Adinv, 2 Adt, 2 dexpinv, 2 dexpinvt, 3 dexpt (functions)
 *             2 legendre, 2 lin, 2 series, 2 seriest (sharing)
 *             2 Ad, 4 Adtinv, 2 seriest (factors)
 *             2 lin (scalars)
 *             parameters, folded: beta = 1, depth = 3/2
 *             the time: the scene does not depend on it
 * operations: 54 add, 74 mul, 1 stumpff_1 a step
 *             2 mul a start, in steps that follow no other
 *             102 add, 137 mul a matrix of the equations of v1, v2, m1, m2
 *             339 add, 489 mul, 6 div, 4 sqrt, 2 stumpff_123, 1 stumpff_23 a sweep of the
 *             equations of v1, v2, m1, m2
 * stack:      at most 4608 bytes, without what the mathematical library takes
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

/* For z > 1/16 and s = sqrt(z): c_1 = sin(s)/s */
static double stumpff_1_far(double z)
{
    if (z <= 1.0) {
        return stumpff_series_1(z);
    }
    const double s = sqrt(z <= 4503599627370496.0 ? z : NAN);
    return sin(s) / s;
}

/* For z > 1/16 and s = sqrt(z): c_1 = sin(s)/s, c_2 = (1 - cos(s))/s^2, c_3 = (s - sin(s))/s^3 */
static void stumpff_123_far(double z, double *c1, double *c2, double *c3)
{
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

/* For z >= 0 and s = sqrt(z): c_1 = sin(s)/s, c_2 = (1 - cos(s))/s^2, c_3 = (s - sin(s))/s^3 */
static inline void stumpff_123(double z, double *c1, double *c2, double *c3)
{
    if (z <= 0.0625) {
        *c1 = stumpff_small_1(z);
        *c2 = stumpff_small_2(z);
        *c3 = stumpff_small_3(z);
    } else {
        stumpff_123_far(z, c1, c2, c3);
    }
}

/* For z >= 0 and s = sqrt(z): c_1 = sin(s)/s */
static inline double stumpff_1(double z)
{
    return z <= 0.0625 ? stumpff_small_1(z) : stumpff_1_far(z);
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
        for (size_t j = 0; pivot != k && j < n; j++) {
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
        for (size_t i = 0; order[k] != k && i < n; i++) {
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

/* What one step of a run leaves for the next: solutions of its equations, the latest first. */
struct memory {
    size_t known;
    double first;
    double past[9][6];
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
    const double m_1 = g01 * mu0 + g11 * mu1 + g21 * mu2;
    const double m_2 = g02 * mu0 + g12 * mu1 + g22 * mu2;
    double v1_0, v1_1, v1_2, v2_0, v2_1, v2_2;
    if (memory->known > 0) {
        v1_0 = extrapolated(memory, 0);
        v1_1 = extrapolated(memory, 1);
        v1_2 = extrapolated(memory, 2);
        v2_0 = extrapolated(memory, 3);
        v2_1 = extrapolated(memory, 4);
        v2_2 = extrapolated(memory, 5);
    } else {
        const double Wxi0_0 = 0.9900990099009901 * m_0;
        const double Wxi0_2 = 100.0 * m_2;
        v1_0 = Wxi0_0;
        v1_1 = m_1;
        v1_2 = Wxi0_2;
        v2_0 = Wxi0_0;
        v2_1 = m_1;
        v2_2 = Wxi0_2;
    }
    const double w69 = 0.5 * h;
    const double w70 = 0.5386751345948129 * h;
    const double w71 = 0.25 * h;
    const double w104 = -0.03867513459481288 * h;
    const double w158 = -0.5386751345948129 * h;
    const double w172 = -0.25 * h;
    const double w187 = -0.25 * h;
    const double w188 = 0.03867513459481288 * h;
    /* the equations of v1, v2, m1, m2: Newton's method with the matrix to first order in h in v1_0, v1_1, v1_2, v2_0, v2_1, v2_2 */
    double s_L_0, Y_0, Y_1, Y_2, w137, w138, s_L_1, s_L_2;
    double previous_1 = 0.0;
    double rate_1 = memory->known > 0 ? memory->rate_1 : 1.0;
    const double w1 = -0.24752475247524752 * h;
    const double w2 = m_2 * w1;
    const double w3 = 50.0 * m_2 * h;
    const double w4 = w3 - 0.49504950495049505 * m_2 * h;
    const double w5 = 0.25 * w4;
    const double w6 = -0.24752475247524752 * h;
    const double w7 = 0.005 * v1_2 - 0.5 * v1_2;
    const double w8 = 0.99 * v1_2;
    const double w9 = 0.49504950495049505 * h;
    const double w10 = w6 + w9;
    const double w11 = m_1 * w1;
    const double w12 = 0.5 * m_1 * h;
    const double w13 = w12 - 0.49504950495049505 * m_1 * h;
    const double w14 = -0.25 * w13;
    const double w15 = 0.005 * v1_1 - 0.5 * v1_1;
    const double w16 = 0.99 * v1_1;
    const double w17 = -0.5333417174206068 * h;
    const double w18 = 0.005 * v2_2 - 0.5 * v2_2;
    const double w19 = 0.99 * v2_2;
    const double w20 = w9 + w17;
    const double w21 = 0.005 * v2_1 - 0.5 * v2_1;
    const double w22 = 0.99 * v2_1;
    const double w23 = -0.25 * h;
    const double w24 = m_2 * w23;
    const double w25 = w3 - 0.5 * m_2 * h;
    const double w26 = -0.25 * w25;
    const double w27 = -0.25 * h;
    const double w28 = 0.505 * v1_2 - 0.005 * v1_2;
    const double w29 = 0.5 * h;
    const double w30 = w27 + w29;
    const double w31 = m_0 * w23;
    const double w32 = 0.49504950495049505 * m_0 * h;
    const double w33 = w32 - 0.5 * m_0 * h;
    const double w34 = 0.25 * w33;
    const double w35 = 0.505 * v1_0 - 0.005 * v1_0;
    const double w36 = -0.5386751345948129 * h;
    const double w37 = 0.505 * v2_2 - 0.005 * v2_2;
    const double w38 = w29 + w36;
    const double w39 = 0.505 * v2_0 - 0.005 * v2_0;
    const double w40 = -25.0 * h;
    const double w41 = m_1 * w40;
    const double w42 = w12 - 50.0 * m_1 * h;
    const double w43 = 0.25 * w42;
    const double w44 = -25.0 * h;
    const double w45 = 0.5 * v1_1 - 0.505 * v1_1;
    const double w46 = 0.01 * v1_1;
    const double w47 = 50.0 * h;
    const double w48 = w44 + w47;
    const double w49 = m_0 * w40;
    const double w50 = w32 - 50.0 * m_0 * h;
    const double w51 = -0.25 * w50;
    const double w52 = 0.5 * v1_0 - 0.505 * v1_0;
    const double w53 = 0.01 * v1_0;
    const double w54 = -53.86751345948129 * h;
    const double w55 = 0.5 * v2_1 - 0.505 * v2_1;
    const double w56 = 0.01 * v2_1;
    const double w57 = w47 + w54;
    const double w58 = 0.5 * v2_0 - 0.505 * v2_0;
    const double w59 = 0.01 * v2_0;
    const double w60 = 0.03829221247011177 * h;
    const double w61 = w9 + w60;
    const double w62 = w1 + w9;
    const double w63 = 0.03867513459481288 * h;
    const double w64 = w29 + w63;
    const double w65 = w23 + w29;
    const double w66 = 3.8675134594812883 * h;
    const double w67 = w47 + w66;
    const double w68 = w40 + w47;
    double inverse_1[36];
    inverse_1[0] = 1.0;
    inverse_1[1] = w2 - (w5 + w6 * w7 + w8 * w10);
    inverse_1[2] = -(w14 + w6 * w15 + w10 * w16 + w11);
    inverse_1[3] = 0.0;
    inverse_1[4] = w2 - (w17 * w18 - 0.03867513459481288 * w4 + w19 * w20);
    inverse_1[5] = -(0.03867513459481288 * w13 + w17 * w21 + w20 * w22 + w11);
    inverse_1[6] = -(w26 + w27 * w28 - v1_2 * w30 + w24);
    inverse_1[7] = 1.0;
    inverse_1[8] = w31 - (w34 + w27 * w35 - v1_0 * w30);
    inverse_1[9] = -(0.03867513459481288 * w25 + w36 * w37 - v2_2 * w38 + w24);
    inverse_1[10] = 0.0;
    inverse_1[11] = w31 - (w36 * w39 - 0.03867513459481288 * w33 - v2_0 * w38);
    inverse_1[12] = w41 - (w43 + w44 * w45 + w46 * w48);
    inverse_1[13] = -(w51 + w44 * w52 + w48 * w53 + w49);
    inverse_1[14] = 1.0;
    inverse_1[15] = w41 - (w54 * w55 - 0.03867513459481288 * w42 + w56 * w57);
    inverse_1[16] = -(0.03867513459481288 * w50 + w54 * w58 + w57 * w59 + w49);
    inverse_1[17] = 0.0;
    inverse_1[18] = 0.0;
    inverse_1[19] = w2 - (0.5386751345948129 * w4 + w7 * w60 + w8 * w61);
    inverse_1[20] = -(w15 * w60 - 0.5386751345948129 * w13 + w16 * w61 + w11);
    inverse_1[21] = 1.0;
    inverse_1[22] = w2 - (w5 + w1 * w18 + w19 * w62);
    inverse_1[23] = -(w14 + w1 * w21 + w22 * w62 + w11);
    inverse_1[24] = -(w28 * w63 - 0.5386751345948129 * w25 - v1_2 * w64 + w24);
    inverse_1[25] = 0.0;
    inverse_1[26] = w31 - (0.5386751345948129 * w33 + w35 * w63 - v1_0 * w64);
    inverse_1[27] = -(w26 + w23 * w37 - v2_2 * w65 + w24);
    inverse_1[28] = 1.0;
    inverse_1[29] = w31 - (w34 + w23 * w39 - v2_0 * w65);
    inverse_1[30] = w41 - (0.5386751345948129 * w42 + w45 * w66 + w46 * w67);
    inverse_1[31] = -(w52 * w66 - 0.5386751345948129 * w50 + w53 * w67 + w49);
    inverse_1[32] = 0.0;
    inverse_1[33] = w41 - (w43 + w40 * w55 + w56 * w68);
    inverse_1[34] = -(w51 + w40 * w58 + w59 * w68 + w49);
    inverse_1[35] = 1.0;
    size_t order_1[6];
    if (!invert(6, inverse_1, order_1)) {
        count_sweeps(statistics, 0, 0, 1);
        return DIPOLE_VRKMK2_GAUSS2_NOT_CONVERGED;
    }
    for (size_t sweep = 1;; sweep++) {
        const double X2_0 = v1_0 * w70 + v2_0 * w71;
        const double X2_1 = v1_1 * w70 + v2_1 * w71;
        const double w72 = v2_1 * X2_0 - v2_0 * X2_1;
        const double X2_2 = v1_2 * w70 + v2_2 * w71;
        const double w73 = X2_0 * X2_0 + X2_1 * X2_1 + X2_2 * X2_2;
        double c1_1, c2_1, c3_1;
        stumpff_123(w73, &c1_1, &c2_1, &c3_1);
        const double w75 = 1.0 - 0.08333333333333333 * w73;
        const double w76 = 1.0 / (w75 * w75 + 0.25 * w73);
        const double w77 = w76 * (0.25 - 0.08333333333333333 * w75);
        const double w79 = -0.5 * w76;
        const double w80 = w73 * (w77 * c1_1 + w79 * c2_1) - (w79 + c1_1);
        const double w81 = v2_0 * X2_2 - v2_2 * X2_0;
        const double w82 = v2_2 * X2_1 - v2_1 * X2_2;
        const double w83 = X2_0 * w81 - X2_1 * w82;
        const double w84 = w77 + c2_1 + w79 * c1_1 - w77 * c2_1 * w73;
        const double p_2_2 = 0.01 * (v2_2 + w72 * w80 + w83 * w84);
        const double w85 = X2_2 * w82 - X2_0 * w72;
        const double a_6_1 = v2_1 + w80 * w81 + w84 * w85;
        const double w86 = X2_0 * c2_1;
        const double w87 = X2_1 * w86;
        const double w88 = X2_2 * c1_1;
        const double w89 = X2_0 * w86;
        const double w90 = X2_2 * c2_1 * X2_2;
        const double w91 = X2_0 * c1_1;
        const double w92 = X2_1 * c2_1;
        const double w93 = X2_2 * w92;
        const double Q2_7 = g20 * (w87 - w88) + g21 * (1.0 - (w89 + w90)) + g22 * (w91 + w93);
        const double w94 = X2_1 * c1_1;
        const double w95 = X2_2 * w86;
        const double w96 = X2_1 * w92;
        const double Q2_8 = g20 * (w94 + w95) + g21 * (w93 - w91) + g22 * (1.0 - (w89 + w96));
        const double w97 = 1.5 - 2.0 * Q2_8;
        const double w98 = 1.0 / sqrt(1.01 + 1.5 * (w97 - 0.2 * Q2_7));
        const double w99 = w98 * w98 * (0.5 * w98);
        const double w100 = 1.0 / sqrt(1.01 + 1.5 * (w97 + 0.2 * Q2_7));
        const double w101 = w100 * w100 * (0.5 * w100);
        const double w102 = -1.0 - 2.0 * (1.5 * w99 - 1.5 * w101);
        const double w103 = -0.3 * w99 - 0.3 * w101;
        const double Nn2_0 = Q2_7 * w102 - Q2_8 * w103 + 99.0 * a_6_1 * p_2_2;
        const double X1_0 = v1_0 * w71 + v2_0 * w104;
        const double X1_1 = v1_1 * w71 + v2_1 * w104;
        const double w105 = v1_1 * X1_0 - v1_0 * X1_1;
        const double X1_2 = v1_2 * w71 + v2_2 * w104;
        const double w106 = X1_0 * X1_0 + X1_1 * X1_1 + X1_2 * X1_2;
        double c1_2, c2_2, c3_2;
        stumpff_123(w106, &c1_2, &c2_2, &c3_2);
        const double w108 = 1.0 - 0.08333333333333333 * w106;
        const double w109 = 1.0 / (w108 * w108 + 0.25 * w106);
        const double w110 = w109 * (0.25 - 0.08333333333333333 * w108);
        const double w112 = -0.5 * w109;
        const double w113 = w106 * (w110 * c1_2 + w112 * c2_2) - (w112 + c1_2);
        const double w114 = v1_0 * X1_2 - v1_2 * X1_0;
        const double w115 = v1_2 * X1_1 - v1_1 * X1_2;
        const double w116 = X1_0 * w114 - X1_1 * w115;
        const double w117 = w110 + c2_2 + w112 * c1_2 - w110 * c2_2 * w106;
        const double p_2 = 0.01 * (v1_2 + w105 * w113 + w116 * w117);
        const double w118 = X1_2 * w115 - X1_0 * w105;
        const double a_2_1 = v1_1 + w113 * w114 + w117 * w118;
        const double w119 = X1_0 * c2_2;
        const double w120 = X1_1 * w119;
        const double w121 = X1_2 * c1_2;
        const double w122 = X1_0 * w119;
        const double w123 = X1_2 * c2_2 * X1_2;
        const double w124 = X1_0 * c1_2;
        const double w125 = X1_1 * c2_2;
        const double w126 = X1_2 * w125;
        const double Q1_7 = g20 * (w120 - w121) + g21 * (1.0 - (w122 + w123)) + g22 * (w124 + w126);
        const double w127 = X1_1 * c1_2;
        const double w128 = X1_2 * w119;
        const double w129 = X1_1 * w125;
        const double Q1_8 = g20 * (w127 + w128) + g21 * (w126 - w124) + g22 * (1.0 - (w122 + w129));
        const double w130 = 1.5 - 2.0 * Q1_8;
        const double w131 = 1.0 / sqrt(1.01 + 1.5 * (w130 - 0.2 * Q1_7));
        const double w132 = w131 * w131 * (0.5 * w131);
        const double w133 = 1.0 / sqrt(1.01 + 1.5 * (w130 + 0.2 * Q1_7));
        const double w134 = w133 * w133 * (0.5 * w133);
        const double w135 = -1.0 - 2.0 * (1.5 * w132 - 1.5 * w134);
        const double w136 = -0.3 * w132 - 0.3 * w134;
        const double Nn1_0 = Q1_7 * w135 - Q1_8 * w136 + 99.0 * a_2_1 * p_2;
        s_L_0 = m_0 + w69 * (Nn2_0 + Nn1_0);
        Y_0 = (v1_0 + v2_0) * w69;
        Y_1 = (v1_1 + v2_1) * w69;
        Y_2 = (v1_2 + v2_2) * w69;
        w137 = Y_0 * Y_0 + Y_1 * Y_1 + Y_2 * Y_2;
        double c2_3, c3_3;
        stumpff_23(w137, &c2_3, &c3_3);
        w138 = c2_3;
        const double w139 = X2_1 * w72 - X2_2 * w81;
        const double a_6_0 = v2_0 + w80 * w82 + w84 * w139;
        const double Q2_6 = g20 * (1.0 - (w90 + w96)) + g21 * (w87 + w88) + g22 * (w95 - w94);
        const double Nn2_1 = -100.0 * a_6_0 * p_2_2 - w102 * Q2_6;
        const double w140 = X1_1 * w105 - X1_2 * w114;
        const double a_2_0 = v1_0 + w113 * w115 + w117 * w140;
        const double Q1_6 = g20 * (1.0 - (w123 + w129)) + g21 * (w120 + w121) + g22 * (w128 - w127);
        const double Nn1_1 = -100.0 * a_2_0 * p_2 - w135 * Q1_6;
        s_L_1 = m_1 + w69 * (Nn2_1 + Nn1_1);
        const double Nn2_2 = 0.01 * a_6_0 * a_6_1 + w103 * Q2_6;
        const double Nn1_2 = 0.01 * a_2_0 * a_2_1 + w136 * Q1_6;
        s_L_2 = m_2 + w69 * (Nn2_2 + Nn1_2);
        const double w141 = Y_2 * s_L_1 - Y_1 * s_L_2;
        const double w143 = Y_0 * s_L_2 - s_L_0 * Y_2;
        const double w144 = s_L_0 * Y_1 - Y_0 * s_L_1;
        const double L_4_0 = s_L_0 - w138 * w141 + (Y_2 * w143 - Y_1 * w144) * c3_3;
        const double w145 = X2_1 * Nn2_2 - X2_2 * Nn2_1;
        const double w147 = X2_0 * Nn2_1 - X2_1 * Nn2_0;
        const double w148 = X2_2 * Nn2_0 - X2_0 * Nn2_2;
        const double p_2_0 = 1.01 * a_6_0;
        const double w149 = X2_2 * p_2_0 - X2_0 * p_2_2;
        const double w150 = X2_1 * p_2_2 - X2_2 * a_6_1;
        const double w151 = X2_0 * a_6_1 - X2_1 * p_2_0;
        const double a_8_1 = a_6_1 - w80 * w149 + w84 * (X2_2 * w150 - X2_0 * w151);
        const double a_5_2 = v2_2 - w72 * w79 + w77 * w83;
        const double a_5_1 = v2_1 - w79 * w81 + w77 * w85;
        const double a_5_0 = v2_0 - w79 * w82 + w77 * w139;
        const double w152 = 0.5 * a_5_2 - 0.08333333333333333 * (X2_0 * a_5_1 - X2_1 * a_5_0);
        const double a_8_2 = p_2_2 - w80 * w151 + w84 * (X2_0 * w149 - X2_1 * w150);
        const double w153 = 0.5 * a_5_1 - 0.08333333333333333 * (X2_2 * a_5_0 - X2_0 * a_5_2);
        const double a_8_0 = p_2_0 - w80 * w150 + w84 * (X2_1 * w151 - X2_2 * w149);
        const double w154 = X2_0 * a_8_2 - X2_2 * a_8_0;
        const double w155 = -0.08333333333333333 * a_5_2;
        const double w156 = X2_1 * a_8_0 - X2_0 * a_8_1;
        const double w157 = -0.08333333333333333 * a_5_1;
        const double sum_d2_0 = Nn2_0 + w145 * c2_1 + (X2_1 * w147 - X2_2 * w148) * c3_1
            - (a_8_1 * w152 - a_8_2 * w153 + (w154 * w155 - w156 * w157));
        const double w159 = X1_1 * Nn1_2 - X1_2 * Nn1_1;
        const double w161 = X1_0 * Nn1_1 - X1_1 * Nn1_0;
        const double w162 = X1_2 * Nn1_0 - X1_0 * Nn1_2;
        const double p_0 = 1.01 * a_2_0;
        const double w163 = X1_2 * p_0 - X1_0 * p_2;
        const double w164 = X1_1 * p_2 - X1_2 * a_2_1;
        const double w165 = X1_0 * a_2_1 - X1_1 * p_0;
        const double a_4_1 = a_2_1 - w113 * w163 + w117 * (X1_2 * w164 - X1_0 * w165);
        const double a_2 = v1_2 - w105 * w112 + w110 * w116;
        const double a_1 = v1_1 - w112 * w114 + w110 * w118;
        const double a_0 = v1_0 - w112 * w115 + w110 * w140;
        const double w166 = 0.5 * a_2 - 0.08333333333333333 * (X1_0 * a_1 - X1_1 * a_0);
        const double a_4_2 = p_2 - w113 * w165 + w117 * (X1_0 * w163 - X1_1 * w164);
        const double w167 = 0.5 * a_1 - 0.08333333333333333 * (X1_2 * a_0 - X1_0 * a_2);
        const double a_4_0 = p_0 - w113 * w164 + w117 * (X1_1 * w165 - X1_2 * w163);
        const double w168 = X1_0 * a_4_2 - X1_2 * a_4_0;
        const double w169 = -0.08333333333333333 * a_2;
        const double w170 = X1_1 * a_4_0 - X1_0 * a_4_1;
        const double w171 = -0.08333333333333333 * a_1;
        const double sum_d1_0 = Nn1_0 + w159 * c2_2 + (X1_1 * w161 - X1_2 * w162) * c3_2
            - (a_4_1 * w166 - a_4_2 * w167 + (w168 * w169 - w170 * w171));
        const double w1_0 = L_4_0 + sum_d2_0 * w158 + sum_d1_0 * w172;
        const double w173 = c1_2 - 0.5 - w106 * (0.08333333333333333 * c1_2 - 0.5 * c2_2);
        const double L_4_2 = s_L_2 - w138 * w144 + (Y_1 * w141 - Y_0 * w143) * c3_3;
        const double w174 = 0.5 * a_5_0 - 0.08333333333333333 * (X2_1 * a_5_2 - X2_2 * a_5_1);
        const double w175 = X2_2 * a_8_1 - X2_1 * a_8_2;
        const double w176 = -0.08333333333333333 * a_5_0;
        const double sum_d2_2 = Nn2_2 + w147 * c2_1 + (X2_0 * w148 - X2_1 * w145) * c3_1
            - (w153 * a_8_0 - a_8_1 * w174 + (w157 * w175 - w154 * w176));
        const double w177 = 0.5 * a_0 - 0.08333333333333333 * (X1_1 * a_2 - X1_2 * a_1);
        const double w178 = X1_2 * a_4_1 - X1_1 * a_4_2;
        const double w179 = -0.08333333333333333 * a_0;
        const double sum_d1_2 = Nn1_2 + w161 * c2_2 + (X1_0 * w162 - X1_1 * w159) * c3_2
            - (w167 * a_4_0 - a_4_1 * w177 + (w171 * w178 - w168 * w179));
        const double w1_2 = L_4_2 + w158 * sum_d2_2 + w172 * sum_d1_2;
        const double L_4_1 = s_L_1 - w138 * w143 + (Y_0 * w144 - Y_2 * w141) * c3_3;
        const double sum_d2_1 = Nn2_1 + w148 * c2_1 + (X2_2 * w145 - X2_0 * w147) * c3_1
            - (a_8_2 * w174 - w152 * a_8_0 + (w156 * w176 - w155 * w175));
        const double sum_d1_1 = Nn1_1 + w162 * c2_2 + (X1_2 * w159 - X1_0 * w161) * c3_2
            - (a_4_2 * w177 - w166 * a_4_0 + (w170 * w179 - w169 * w178));
        const double w1_1 = L_4_1 + w158 * sum_d2_1 + w172 * sum_d1_1;
        const double w180 = X1_1 * w1_2 - X1_2 * w1_1;
        const double w181 = 0.08333333333333333 + c2_2 - 0.5 * c1_2
            - 0.08333333333333333 * c2_2 * w106;
        const double w182 = X1_0 * w1_1 - X1_1 * w1_0;
        const double w183 = X1_2 * w1_0 - X1_0 * w1_2;
        const double Wxi1_0 = 0.9900990099009901
            * (w1_0 - w173 * w180 + w181 * (X1_1 * w182 - X1_2 * w183));
        const double Wxi1_2 = 100.0 * (w1_2 - w173 * w182 + w181 * (X1_0 * w183 - X1_1 * w180));
        const double Pxi1_1 = w1_1 - w173 * w183 + w181 * (X1_2 * w180 - X1_0 * w182);
        const double w184 = X1_1 * Wxi1_2 - X1_2 * Pxi1_1;
        const double w185 = X1_0 * Pxi1_1 - X1_1 * Wxi1_0;
        const double w186 = X1_2 * Wxi1_0 - X1_0 * Wxi1_2;
        const double w2_0 = L_4_0 + sum_d2_0 * w187 + sum_d1_0 * w188;
        const double w189 = c1_1 - 0.5 - w73 * (0.08333333333333333 * c1_1 - 0.5 * c2_1);
        const double w2_2 = L_4_2 + sum_d2_2 * w187 + sum_d1_2 * w188;
        const double w2_1 = L_4_1 + sum_d2_1 * w187 + sum_d1_1 * w188;
        const double w190 = X2_1 * w2_2 - X2_2 * w2_1;
        const double w191 = 0.08333333333333333 + c2_1 - 0.5 * c1_1
            - 0.08333333333333333 * c2_1 * w73;
        const double w192 = X2_0 * w2_1 - X2_1 * w2_0;
        const double w193 = X2_2 * w2_0 - X2_0 * w2_2;
        const double Wxi2_0 = 0.9900990099009901
            * (w2_0 - w189 * w190 + w191 * (X2_1 * w192 - X2_2 * w193));
        const double Wxi2_2 = 100.0 * (w2_2 - w189 * w192 + w191 * (X2_0 * w193 - X2_1 * w190));
        const double Pxi2_1 = w2_1 - w189 * w193 + w191 * (X2_2 * w190 - X2_0 * w192);
        const double w194 = X2_1 * Wxi2_2 - X2_2 * Pxi2_1;
        const double w195 = X2_0 * Pxi2_1 - X2_1 * Wxi2_0;
        const double w196 = X2_2 * Wxi2_0 - X2_0 * Wxi2_2;
        const double next_v1_0 = Wxi1_0 + w173 * w184 + w181 * (X1_1 * w185 - X1_2 * w186);
        const double next_v1_1 = Pxi1_1 + w173 * w186 + w181 * (X1_2 * w184 - X1_0 * w185);
        const double next_v1_2 = Wxi1_2 + w173 * w185 + w181 * (X1_0 * w186 - X1_1 * w184);
        const double next_v2_0 = Wxi2_0 + w189 * w194 + w191 * (X2_1 * w195 - X2_2 * w196);
        const double next_v2_1 = Pxi2_1 + w189 * w196 + w191 * (X2_2 * w194 - X2_0 * w195);
        const double next_v2_2 = Wxi2_2 + w189 * w195 + w191 * (X2_0 * w196 - X2_1 * w194);
        const double residual_v1_0 = next_v1_0 - v1_0;
        const double residual_v1_1 = next_v1_1 - v1_1;
        const double residual_v1_2 = next_v1_2 - v1_2;
        const double residual_v2_0 = next_v2_0 - v2_0;
        const double residual_v2_1 = next_v2_1 - v2_1;
        const double residual_v2_2 = next_v2_2 - v2_2;
        if (!isfinite(residual_v1_0 + residual_v1_1 + residual_v1_2 + residual_v2_0 + residual_v2_1
            + residual_v2_2)) {
            count_sweeps(statistics, 0, sweep, 1);
            return DIPOLE_VRKMK2_GAUSS2_NOT_FINITE;
        }
        const double change_v1_0 = inverse_1[0] * residual_v1_0 + inverse_1[1] * residual_v1_1
            + inverse_1[2] * residual_v1_2 + inverse_1[3] * residual_v2_0
            + inverse_1[4] * residual_v2_1 + inverse_1[5] * residual_v2_2;
        const double change_v1_1 = inverse_1[6] * residual_v1_0 + inverse_1[7] * residual_v1_1
            + inverse_1[8] * residual_v1_2 + inverse_1[9] * residual_v2_0
            + inverse_1[10] * residual_v2_1 + inverse_1[11] * residual_v2_2;
        const double change_v1_2 = inverse_1[12] * residual_v1_0 + inverse_1[13] * residual_v1_1
            + inverse_1[14] * residual_v1_2 + inverse_1[15] * residual_v2_0
            + inverse_1[16] * residual_v2_1 + inverse_1[17] * residual_v2_2;
        const double change_v2_0 = inverse_1[18] * residual_v1_0 + inverse_1[19] * residual_v1_1
            + inverse_1[20] * residual_v1_2 + inverse_1[21] * residual_v2_0
            + inverse_1[22] * residual_v2_1 + inverse_1[23] * residual_v2_2;
        const double change_v2_1 = inverse_1[24] * residual_v1_0 + inverse_1[25] * residual_v1_1
            + inverse_1[26] * residual_v1_2 + inverse_1[27] * residual_v2_0
            + inverse_1[28] * residual_v2_1 + inverse_1[29] * residual_v2_2;
        const double change_v2_2 = inverse_1[30] * residual_v1_0 + inverse_1[31] * residual_v1_1
            + inverse_1[32] * residual_v1_2 + inverse_1[33] * residual_v2_0
            + inverse_1[34] * residual_v2_1 + inverse_1[35] * residual_v2_2;
        const double change = greater(greater(fabs(change_v1_0), greater(fabs(change_v1_1),
            fabs(change_v1_2))), greater(fabs(change_v2_0), greater(fabs(change_v2_1),
            fabs(change_v2_2))));
        const double scale = greater(greater(1.0, greater(fabs(v1_0), fabs(v1_1))),
            greater(greater(fabs(v1_2), fabs(v2_0)), greater(fabs(v2_1), fabs(v2_2))));
        const int still = previous_1 > 0.0 && change >= previous_1;
        if (sweep == 1) {
            memory->first = greater(memory->first, change);
        }
        if (previous_1 > 0.0) {
            rate_1 = greater(change / previous_1, 0.000244140625);
        }
        const int close = change <= 5.684341886080802e-14 * scale
            && change * rate_1 <= 1.1102230246251565e-16 * scale;
        v1_0 += change_v1_0;
        v1_1 += change_v1_1;
        v1_2 += change_v1_2;
        v2_0 += change_v2_0;
        v2_1 += change_v2_1;
        v2_2 += change_v2_2;
        if (close || (still && change <= 5.684341886080802e-14 * scale)) {
            count_sweeps(statistics, 0, sweep, 0);
            memory->rate_1 = sweep > 1 ? rate_1 : 2.0 * rate_1;
            break;
        }
        if (sweep == 100) {
            count_sweeps(statistics, 0, sweep, 1);
            return DIPOLE_VRKMK2_GAUSS2_NOT_CONVERGED;
        }
        previous_1 = change;
    }
    const double w197 = Y_1 * w138;
    const double w198 = Y_1 * w197;
    const double w199 = Y_2 * w138 * Y_2;
    const double g_0 = 1.0 - (w198 + w199);
    const double c1_3 = stumpff_1(w137);
    const double w201 = Y_2 * c1_3;
    const double w202 = Y_0 * w138;
    const double w203 = Y_1 * w202;
    const double g_3 = w201 + w203;
    const double w204 = Y_2 * w202;
    const double w205 = Y_1 * c1_3;
    const double g_6 = w204 - w205;
    const double g_1 = w203 - w201;
    const double w206 = Y_0 * w202;
    const double g_4 = 1.0 - (w199 + w206);
    const double w207 = Y_0 * c1_3;
    const double w208 = Y_2 * w197;
    const double g_7 = w207 + w208;
    const double g_2 = w204 + w205;
    const double g_5 = w208 - w207;
    const double g_8 = 1.0 - (w198 + w206);
    const double change_0 = s_L_0 * g_0 + s_L_1 * g_1 + s_L_2 * g_2 - m_0;
    const double change_1 = s_L_0 * g_3 + s_L_1 * g_4 + s_L_2 * g_5 - m_1;
    const double change_2 = s_L_0 * g_6 + s_L_1 * g_7 + s_L_2 * g_8 - m_2;
    const double new_g00 = g00 * g_0 + g01 * g_3 + g02 * g_6;
    const double new_g01 = g00 * g_1 + g01 * g_4 + g02 * g_7;
    const double new_g02 = g00 * g_2 + g01 * g_5 + g02 * g_8;
    const double new_g10 = g10 * g_0 + g11 * g_3 + g12 * g_6;
    const double new_g11 = g10 * g_1 + g11 * g_4 + g12 * g_7;
    const double new_g12 = g10 * g_2 + g11 * g_5 + g12 * g_8;
    const double new_g20 = g20 * g_0 + g21 * g_3 + g22 * g_6;
    const double new_g21 = g20 * g_1 + g21 * g_4 + g22 * g_7;
    const double new_g22 = g20 * g_2 + g21 * g_5 + g22 * g_8;
    const double new_mu0 = g00 * change_0 + g01 * change_1 + g02 * change_2 + mu0;
    const double new_mu1 = g10 * change_0 + g11 * change_1 + g12 * change_2 + mu1;
    const double new_mu2 = g20 * change_0 + g21 * change_1 + g22 * change_2 + mu2;
    if (!(isfinite(new_g00) && isfinite(new_g01) && isfinite(new_g02) && isfinite(new_g10)
        && isfinite(new_g11) && isfinite(new_g12) && isfinite(new_g20) && isfinite(new_g21)
        && isfinite(new_g22) && isfinite(new_mu0) && isfinite(new_mu1) && isfinite(new_mu2))) {
        return DIPOLE_VRKMK2_GAUSS2_NOT_FINITE;
    }
    const double moved = greater(greater(fabs(v1_0 - memory->past[0][0]),
        greater(fabs(v1_1 - memory->past[0][1]), fabs(v1_2 - memory->past[0][2]))),
        greater(fabs(v2_0 - memory->past[0][3]), greater(fabs(v2_1 - memory->past[0][4]),
        fabs(v2_2 - memory->past[0][5]))));
    memmove(memory->past[1], memory->past[0], 8 * sizeof memory->past[0]);
    memory->past[0][0] = v1_0;
    memory->past[0][1] = v1_1;
    memory->past[0][2] = v1_2;
    memory->past[0][3] = v2_0;
    memory->past[0][4] = v2_1;
    memory->past[0][5] = v2_2;
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
    return DIPOLE_VRKMK2_GAUSS2_OK;
}

int dipole_vrkmk2_gauss2_step(double state[static 12], double h,
    dipole_vrkmk2_gauss2_statistics *statistics)
{
    struct memory memory = {0};
    return advance(state, h, &memory, statistics);
}

int dipole_vrkmk2_gauss2_run(double state[static 12], double h, size_t steps,
    double *trajectory, size_t stride, dipole_vrkmk2_gauss2_statistics *statistics,
    size_t *completed)
{
    int status = DIPOLE_VRKMK2_GAUSS2_OK;
    size_t step = 0;
    struct memory memory = {0};
    double *row = stride > 0 ? trajectory : NULL;
    if (row != NULL) {
        memcpy(row, state, 12 * sizeof *state);
    }
    while (step < steps) {
        status = advance(state, h, &memory, statistics);
        if (status != DIPOLE_VRKMK2_GAUSS2_OK && memory.known > 0) {
            /* the solutions before may mislead where the motion changes: begin as the first step does */
            memset(&memory, 0, sizeof memory);
            if (statistics != NULL) {
                statistics->failed = 0;
            }
            status = advance(state, h, &memory, statistics);
        }
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
