/*
 * Dipole on a stick, T*SO(3) (thesis section 3.6): one step by vrkmk(2):gauss2
 *
 * method:     family vrkmk(2), tableau gauss2
 * source:     Hammer and Hollingsworth 1955; Hairer, Lubich and Wanner, Table II.1.1; Table 3.1c
 *             of Bogfjellmo and Marthinsen
 * order:      4, certificate: exact (every order condition up to it is zero in exact arithmetic)
 * scene:      Dipole on a stick, T*SO(3) (thesis section 3.6), group SO(3)
 * solved by:  the equations of v1, v2, m1, m2: Newton's method, 6 unknowns (4.1 sweeps of 990
 *             operations and 0.12 matrices of 5744 a step, not 5.6 sweeps of 924 operations)
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
 * operations: 42 add, 64 mul, 1 stumpff_1 a step
 *             2 mul a start, in steps that follow no other
 *             2286 add, 2936 mul, 3 slope2, 3 slope3 a matrix of the equations of v1, v2, m1, m2
 *             345 add, 516 mul, 6 div, 4 sqrt, 2 stumpff_123, 1 stumpff_23 a sweep of the
 *             equations of v1, v2, m1, m2
 * stack:      at most 14976 bytes, without what the mathematical library takes
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

/* For z >= 0 and s = sqrt(z): c_1 = sin(s)/s */
static inline double stumpff_1(double z)
{
    return z <= 0.0625 ? stumpff_small_1(z) : stumpff_1_far(z);
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

static void count_matrix(dipole_vrkmk2_gauss2_statistics *statistics)
{
    if (statistics != NULL) {
        statistics->matrices++;
    }
}

/* What one step of a run leaves for the next: solutions of its equations, the latest first, and inverses of Newton's matrices. */
struct memory {
    size_t known;
    double past[3][6];
    int made_1;
    double inverse_1[36];
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
    const double w1 = 0.5 * h;
    const double w2 = 0.5386751345948129 * h;
    const double w3 = 0.25 * h;
    const double w52 = -0.03867513459481288 * h;
    const double w130 = -0.26933756729740643 * h;
    const double w152 = -0.125 * h;
    const double w209 = 0.01933756729740644 * h;
    /* the equations of v1, v2, m1, m2: Newton's method in v1_0, v1_1, v1_2, v2_0, v2_1, v2_2 */
    double s_L_0, Y_0, Y_1, Y_2, w101, w102, s_L_1, s_L_2;
    double previous_1 = 0.0;
    int make_1 = !memory->made_1;
    for (size_t sweep = 1;; sweep++) {
        const double X2_0 = v1_0 * w2 + v2_0 * w3;
        const double w4 = v2_1 * X2_0;
        const double X2_1 = v1_1 * w2 + v2_1 * w3;
        const double w5 = v2_0 * X2_1;
        const double w6 = w4 - w5;
        const double X2_2 = v1_2 * w2 + v2_2 * w3;
        const double w7 = X2_2 * X2_2;
        const double w8 = X2_0 * X2_0 + X2_1 * X2_1 + w7;
        double c1_1, c2_1, c3_1;
        stumpff_123(w8, &c1_1, &c2_1, &c3_1);
        const double w10 = 1.0 - 0.08333333333333333 * w8;
        const double w11 = 1.0 / (w10 * w10 + 0.25 * w8);
        const double w12 = 0.25 - 0.08333333333333333 * w10;
        const double w13 = w11 * w12;
        const double w15 = -0.5 * w11;
        const double w16 = w13 * c1_1 + w15 * c2_1;
        const double w17 = w8 * w16 - (w15 + c1_1);
        const double w18 = v2_0 * X2_2;
        const double w19 = v2_2 * X2_0;
        const double w20 = w18 - w19;
        const double w21 = v2_2 * X2_1;
        const double w22 = v2_1 * X2_2;
        const double w23 = w21 - w22;
        const double w24 = X2_0 * w20 - X2_1 * w23;
        const double w25 = w13 * c2_1;
        const double w26 = w13 + c2_1 + w15 * c1_1 - w8 * w25;
        const double a_6_2 = v2_2 + w6 * w17 + w24 * w26;
        const double p_2_2 = 0.01 * a_6_2;
        const double w27 = X2_2 * w23 - X2_0 * w6;
        const double a_6_1 = v2_1 + w17 * w20 + w26 * w27;
        const double w28 = 99.0 * a_6_1;
        const double w29 = X2_0 * c2_1;
        const double w30 = X2_1 * w29;
        const double w31 = X2_2 * c1_1;
        const double w32 = X2_0 * w29;
        const double w33 = X2_2 * c2_1;
        const double w34 = X2_2 * w33;
        const double w35 = X2_0 * c1_1;
        const double w36 = X2_1 * c2_1;
        const double w37 = X2_2 * w36;
        const double Q2_7 = g20 * (w30 - w31) + g21 * (1.0 - (w32 + w34)) + g22 * (w35 + w37);
        const double w38 = X2_1 * c1_1;
        const double w39 = X2_2 * w29;
        const double w40 = X2_1 * w36;
        const double Q2_8 = g20 * (w38 + w39) + g21 * (w37 - w35) + g22 * (1.0 - (w32 + w40));
        const double w41 = 1.5 - 2.0 * Q2_8;
        const double w42 = 1.0 / sqrt(1.01 + 1.5 * (w41 - 0.2 * Q2_7));
        const double w43 = w42 * w42;
        const double w44 = 0.5 * w42;
        const double w45 = w43 * w44;
        const double w46 = 1.0 / sqrt(1.01 + 1.5 * (w41 + 0.2 * Q2_7));
        const double w47 = w46 * w46;
        const double w48 = 0.5 * w46;
        const double w49 = w47 * w48;
        const double w50 = -1.0 - 2.0 * (1.5 * w45 - 1.5 * w49);
        const double w51 = -0.3 * w45 - 0.3 * w49;
        const double Nn2_0 = Q2_7 * w50 - Q2_8 * w51 + p_2_2 * w28;
        const double X1_0 = v1_0 * w3 + v2_0 * w52;
        const double w53 = v1_1 * X1_0;
        const double X1_1 = v1_1 * w3 + v2_1 * w52;
        const double w54 = v1_0 * X1_1;
        const double w55 = w53 - w54;
        const double X1_2 = v1_2 * w3 + v2_2 * w52;
        const double w56 = X1_2 * X1_2;
        const double w57 = X1_0 * X1_0 + X1_1 * X1_1 + w56;
        double c1_2, c2_2, c3_2;
        stumpff_123(w57, &c1_2, &c2_2, &c3_2);
        const double w59 = 1.0 - 0.08333333333333333 * w57;
        const double w60 = 1.0 / (w59 * w59 + 0.25 * w57);
        const double w61 = 0.25 - 0.08333333333333333 * w59;
        const double w62 = w60 * w61;
        const double w64 = -0.5 * w60;
        const double w65 = w62 * c1_2 + w64 * c2_2;
        const double w66 = w57 * w65 - (w64 + c1_2);
        const double w67 = v1_0 * X1_2;
        const double w68 = v1_2 * X1_0;
        const double w69 = w67 - w68;
        const double w70 = v1_2 * X1_1;
        const double w71 = v1_1 * X1_2;
        const double w72 = w70 - w71;
        const double w73 = X1_0 * w69 - X1_1 * w72;
        const double w74 = w62 * c2_2;
        const double w75 = w62 + c2_2 + w64 * c1_2 - w57 * w74;
        const double a_2_2 = v1_2 + w55 * w66 + w73 * w75;
        const double p_2 = 0.01 * a_2_2;
        const double w76 = X1_2 * w72 - X1_0 * w55;
        const double a_2_1 = v1_1 + w66 * w69 + w75 * w76;
        const double w77 = 99.0 * a_2_1;
        const double w78 = X1_0 * c2_2;
        const double w79 = X1_1 * w78;
        const double w80 = X1_2 * c1_2;
        const double w81 = X1_0 * w78;
        const double w82 = X1_2 * c2_2;
        const double w83 = X1_2 * w82;
        const double w84 = X1_0 * c1_2;
        const double w85 = X1_1 * c2_2;
        const double w86 = X1_2 * w85;
        const double Q1_7 = g20 * (w79 - w80) + g21 * (1.0 - (w81 + w83)) + g22 * (w84 + w86);
        const double w87 = X1_1 * c1_2;
        const double w88 = X1_2 * w78;
        const double w89 = X1_1 * w85;
        const double Q1_8 = g20 * (w87 + w88) + g21 * (w86 - w84) + g22 * (1.0 - (w81 + w89));
        const double w90 = 1.5 - 2.0 * Q1_8;
        const double w91 = 1.0 / sqrt(1.01 + 1.5 * (w90 - 0.2 * Q1_7));
        const double w92 = w91 * w91;
        const double w93 = 0.5 * w91;
        const double w94 = w92 * w93;
        const double w95 = 1.0 / sqrt(1.01 + 1.5 * (w90 + 0.2 * Q1_7));
        const double w96 = w95 * w95;
        const double w97 = 0.5 * w95;
        const double w98 = w96 * w97;
        const double w99 = -1.0 - 2.0 * (1.5 * w94 - 1.5 * w98);
        const double w100 = -0.3 * w94 - 0.3 * w98;
        const double Nn1_0 = Q1_7 * w99 - Q1_8 * w100 + p_2 * w77;
        s_L_0 = m_0 + w1 * (Nn2_0 + Nn1_0);
        Y_0 = (v1_0 + v2_0) * w1;
        Y_1 = (v1_1 + v2_1) * w1;
        Y_2 = (v1_2 + v2_2) * w1;
        w101 = Y_0 * Y_0 + Y_1 * Y_1 + Y_2 * Y_2;
        double c2_3, c3_3;
        stumpff_23(w101, &c2_3, &c3_3);
        w102 = c2_3;
        const double w103 = X2_1 * w6 - X2_2 * w20;
        const double a_6_0 = v2_0 + w17 * w23 + w26 * w103;
        const double w104 = -100.0 * a_6_0;
        const double w105 = p_2_2 * w104;
        const double Q2_6 = g20 * (1.0 - (w34 + w40)) + g21 * (w30 + w31) + g22 * (w39 - w38);
        const double w106 = w50 * Q2_6;
        const double Nn2_1 = w105 - w106;
        const double w107 = X1_1 * w55 - X1_2 * w69;
        const double a_2_0 = v1_0 + w66 * w72 + w75 * w107;
        const double w108 = -100.0 * a_2_0;
        const double w109 = p_2 * w108;
        const double Q1_6 = g20 * (1.0 - (w83 + w89)) + g21 * (w79 + w80) + g22 * (w88 - w87);
        const double w110 = w99 * Q1_6;
        const double Nn1_1 = w109 - w110;
        s_L_1 = m_1 + w1 * (Nn2_1 + Nn1_1);
        const double w111 = Y_2 * s_L_1;
        const double w112 = 0.01 * a_6_0;
        const double Nn2_2 = a_6_1 * w112 + w51 * Q2_6;
        const double w113 = 0.01 * a_2_0;
        const double Nn1_2 = a_2_1 * w113 + w100 * Q1_6;
        s_L_2 = m_2 + w1 * (Nn2_2 + Nn1_2);
        const double w114 = Y_1 * s_L_2;
        const double w115 = w111 - w114;
        const double w117 = Y_0 * s_L_2;
        const double w118 = s_L_0 * Y_2;
        const double w119 = w117 - w118;
        const double w120 = s_L_0 * Y_1;
        const double w121 = Y_0 * s_L_1;
        const double w122 = w120 - w121;
        const double w123 = Y_2 * w119 - Y_1 * w122;
        const double w124 = 0.5 * (s_L_0 - w102 * w115 + w123 * c3_3);
        const double w125 = X2_1 * Nn2_2 - X2_2 * Nn2_1;
        const double w127 = X2_0 * Nn2_1 - X2_1 * Nn2_0;
        const double w128 = X2_2 * Nn2_0 - X2_0 * Nn2_2;
        const double w129 = X2_1 * w127 - X2_2 * w128;
        const double d2_0 = Nn2_0 + w125 * c2_1 + w129 * c3_1;
        const double p_2_0 = 1.01 * a_6_0;
        const double w131 = X2_2 * p_2_0 - X2_0 * p_2_2;
        const double w132 = X2_1 * p_2_2 - X2_2 * a_6_1;
        const double w133 = X2_0 * a_6_1 - X2_1 * p_2_0;
        const double w134 = X2_2 * w132 - X2_0 * w133;
        const double a_8_1 = a_6_1 - w17 * w131 + w26 * w134;
        const double s_2_1 = 0.5 * a_8_1;
        const double a_5_2 = v2_2 - w6 * w15 + w13 * w24;
        const double a_5_1 = v2_1 - w15 * w20 + w13 * w27;
        const double a_5_0 = v2_0 - w15 * w23 + w13 * w103;
        const double w135 = 0.5 * a_5_2 - 0.08333333333333333 * (X2_0 * a_5_1 - X2_1 * a_5_0);
        const double w136 = X2_0 * w131 - X2_1 * w132;
        const double a_8_2 = p_2_2 - w17 * w133 + w26 * w136;
        const double s_2_2 = 0.5 * a_8_2;
        const double w137 = 0.5 * a_5_1 - 0.08333333333333333 * (X2_2 * a_5_0 - X2_0 * a_5_2);
        const double w138 = X2_0 * s_2_2;
        const double w139 = X2_1 * w133 - X2_2 * w131;
        const double a_8_0 = p_2_0 - w17 * w132 + w26 * w139;
        const double s_2_0 = 0.5 * a_8_0;
        const double w140 = X2_2 * s_2_0;
        const double w141 = w138 - w140;
        const double w142 = -0.08333333333333333 * a_5_2;
        const double w143 = X2_1 * s_2_0;
        const double w144 = X2_0 * s_2_1;
        const double w145 = w143 - w144;
        const double w146 = -0.08333333333333333 * a_5_1;
        const double P2_0 = s_2_1 * w135 - s_2_2 * w137 + (w141 * w142 - w145 * w146);
        const double w147 = X1_1 * Nn1_2 - X1_2 * Nn1_1;
        const double w149 = X1_0 * Nn1_1 - X1_1 * Nn1_0;
        const double w150 = X1_2 * Nn1_0 - X1_0 * Nn1_2;
        const double w151 = X1_1 * w149 - X1_2 * w150;
        const double d1_0 = Nn1_0 + w147 * c2_2 + w151 * c3_2;
        const double p_0 = 1.01 * a_2_0;
        const double w153 = X1_2 * p_0 - X1_0 * p_2;
        const double w154 = X1_1 * p_2 - X1_2 * a_2_1;
        const double w155 = X1_0 * a_2_1 - X1_1 * p_0;
        const double w156 = X1_2 * w154 - X1_0 * w155;
        const double a_4_1 = a_2_1 - w66 * w153 + w75 * w156;
        const double s_1 = 0.5 * a_4_1;
        const double a_2 = v1_2 - w55 * w64 + w62 * w73;
        const double a_1 = v1_1 - w64 * w69 + w62 * w76;
        const double a_0 = v1_0 - w64 * w72 + w62 * w107;
        const double w157 = 0.5 * a_2 - 0.08333333333333333 * (X1_0 * a_1 - X1_1 * a_0);
        const double w158 = X1_0 * w153 - X1_1 * w154;
        const double a_4_2 = p_2 - w66 * w155 + w75 * w158;
        const double s_2 = 0.5 * a_4_2;
        const double w159 = 0.5 * a_1 - 0.08333333333333333 * (X1_2 * a_0 - X1_0 * a_2);
        const double w160 = X1_0 * s_2;
        const double w161 = X1_1 * w155 - X1_2 * w153;
        const double a_4_0 = p_0 - w66 * w154 + w75 * w161;
        const double s_0 = 0.5 * a_4_0;
        const double w162 = X1_2 * s_0;
        const double w163 = w160 - w162;
        const double w164 = -0.08333333333333333 * a_2;
        const double w165 = X1_1 * s_0;
        const double w166 = X1_0 * s_1;
        const double w167 = w165 - w166;
        const double w168 = -0.08333333333333333 * a_1;
        const double P1_0 = s_1 * w157 - s_2 * w159 + (w163 * w164 - w167 * w168);
        const double w1_0 = 2.0 * (d2_0 * w130 + w2 * P2_0 + d1_0 * w152 + w3 * P1_0 + w124);
        const double w169 = c1_2 - 0.5;
        const double w170 = 0.08333333333333333 * c1_2 - 0.5 * c2_2;
        const double w171 = w57 * w170;
        const double w172 = w169 - w171;
        const double w173 = Y_1 * w115 - Y_0 * w119;
        const double w174 = 0.5 * (s_L_2 - w102 * w122 + w173 * c3_3);
        const double w175 = X2_0 * w128 - X2_1 * w125;
        const double d2_2 = Nn2_2 + w127 * c2_1 + w175 * c3_1;
        const double w176 = 0.5 * a_5_0 - 0.08333333333333333 * (X2_1 * a_5_2 - X2_2 * a_5_1);
        const double w177 = X2_2 * s_2_1;
        const double w178 = X2_1 * s_2_2;
        const double w179 = w177 - w178;
        const double w180 = -0.08333333333333333 * a_5_0;
        const double P2_2 = w137 * s_2_0 - s_2_1 * w176 + (w146 * w179 - w141 * w180);
        const double w181 = X1_0 * w150 - X1_1 * w147;
        const double d1_2 = Nn1_2 + w149 * c2_2 + w181 * c3_2;
        const double w182 = 0.5 * a_0 - 0.08333333333333333 * (X1_1 * a_2 - X1_2 * a_1);
        const double w183 = X1_2 * s_1;
        const double w184 = X1_1 * s_2;
        const double w185 = w183 - w184;
        const double w186 = -0.08333333333333333 * a_0;
        const double P1_2 = w159 * s_0 - s_1 * w182 + (w168 * w185 - w163 * w186);
        const double w1_2 = 2.0 * (w2 * P2_2 + w130 * d2_2 + w152 * d1_2 + w3 * P1_2 + w174);
        const double w187 = Y_0 * w122 - Y_2 * w115;
        const double w188 = 0.5 * (s_L_1 - w102 * w119 + w187 * c3_3);
        const double w189 = X2_2 * w125 - X2_0 * w127;
        const double d2_1 = Nn2_1 + w128 * c2_1 + w189 * c3_1;
        const double P2_1 = s_2_2 * w176 - w135 * s_2_0 + (w145 * w180 - w142 * w179);
        const double w190 = X1_2 * w147 - X1_0 * w149;
        const double d1_1 = Nn1_1 + w150 * c2_2 + w190 * c3_2;
        const double P1_1 = s_2 * w182 - w157 * s_0 + (w167 * w186 - w164 * w185);
        const double w1_1 = 2.0 * (w2 * P2_1 + w130 * d2_1 + w152 * d1_1 + w3 * P1_1 + w188);
        const double w191 = X1_1 * w1_2 - X1_2 * w1_1;
        const double w192 = 0.08333333333333333 + c2_2 - 0.5 * c1_2;
        const double w193 = 0.08333333333333333 * c2_2;
        const double w194 = w57 * w193;
        const double w195 = w192 - w194;
        const double w196 = X1_0 * w1_1 - X1_1 * w1_0;
        const double w197 = X1_2 * w1_0;
        const double w198 = X1_0 * w1_2;
        const double w199 = w197 - w198;
        const double w200 = X1_1 * w196 - X1_2 * w199;
        const double Wxi1_0 = 0.9900990099009901 * (w1_0 - w172 * w191 + w195 * w200);
        const double w201 = X1_0 * w199 - X1_1 * w191;
        const double Wxi1_2 = 100.0 * (w1_2 - w172 * w196 + w195 * w201);
        const double w202 = X1_2 * w191 - X1_0 * w196;
        const double Pxi1_1 = w1_1 - w172 * w199 + w195 * w202;
        const double w203 = X1_1 * Wxi1_2 - X1_2 * Pxi1_1;
        const double w204 = X1_0 * Pxi1_1 - X1_1 * Wxi1_0;
        const double w205 = X1_2 * Wxi1_0 - X1_0 * Wxi1_2;
        const double w206 = X1_1 * w204 - X1_2 * w205;
        const double w207 = X1_2 * w203 - X1_0 * w204;
        const double w208 = X1_0 * w205 - X1_1 * w203;
        const double w2_0 = 2.0 * (d2_0 * w152 + w3 * P2_0 + d1_0 * w209 + w52 * P1_0 + w124);
        const double w210 = c1_1 - 0.5;
        const double w211 = 0.08333333333333333 * c1_1 - 0.5 * c2_1;
        const double w212 = w8 * w211;
        const double w213 = w210 - w212;
        const double w2_2 = 2.0 * (w3 * P2_2 + w152 * d2_2 + d1_2 * w209 + w52 * P1_2 + w174);
        const double w2_1 = 2.0 * (w3 * P2_1 + w152 * d2_1 + d1_1 * w209 + w52 * P1_1 + w188);
        const double w214 = X2_1 * w2_2 - X2_2 * w2_1;
        const double w215 = 0.08333333333333333 + c2_1 - 0.5 * c1_1;
        const double w216 = 0.08333333333333333 * c2_1;
        const double w217 = w8 * w216;
        const double w218 = w215 - w217;
        const double w219 = X2_0 * w2_1 - X2_1 * w2_0;
        const double w220 = X2_2 * w2_0;
        const double w221 = X2_0 * w2_2;
        const double w222 = w220 - w221;
        const double w223 = X2_1 * w219 - X2_2 * w222;
        const double Wxi2_0 = 0.9900990099009901 * (w2_0 - w213 * w214 + w218 * w223);
        const double w224 = X2_0 * w222 - X2_1 * w214;
        const double Wxi2_2 = 100.0 * (w2_2 - w213 * w219 + w218 * w224);
        const double w225 = X2_2 * w214 - X2_0 * w219;
        const double Pxi2_1 = w2_1 - w213 * w222 + w218 * w225;
        const double w226 = X2_1 * Wxi2_2 - X2_2 * Pxi2_1;
        const double w227 = X2_0 * Pxi2_1 - X2_1 * Wxi2_0;
        const double w228 = X2_2 * Wxi2_0 - X2_0 * Wxi2_2;
        const double w229 = X2_1 * w227 - X2_2 * w228;
        const double w230 = X2_2 * w226 - X2_0 * w227;
        const double w231 = X2_0 * w228 - X2_1 * w226;
        const double next_v1_0 = Wxi1_0 + w172 * w203 + w195 * w206;
        const double next_v1_1 = Pxi1_1 + w172 * w205 + w195 * w207;
        const double next_v1_2 = Wxi1_2 + w172 * w204 + w195 * w208;
        const double next_v2_0 = Wxi2_0 + w213 * w226 + w218 * w229;
        const double next_v2_1 = Pxi2_1 + w213 * w228 + w218 * w230;
        const double next_v2_2 = Wxi2_2 + w213 * w227 + w218 * w231;
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
        if (make_1) {
            const double w232 = X1_1 * w195;
            const double w233 = w194 - w192;
            const double w234 = X1_2 * w233;
            const double w235 = X1_1 * w172;
            const double w236 = w235 - X1_0 * w234;
            const double w237 = 100.0 * w195;
            const double w238 = -100.0 * w172;
            const double w239 = X1_0 * w237;
            const double w240 = w199 * w237 + w1_1 * w238 - w1_2 * w239;
            const double w241 = 1.0 - X1_1 * w232 + X1_2 * w234;
            const double w242 = 0.9900990099009901 * w195;
            const double w243 = X1_1 * w242;
            const double w244 = X1_2 * w242;
            const double w245 = w1_1 * w243 + w1_2 * w244;
            const double w246 = X1_2 * w172;
            const double w247 = X1_0 * w232 - w246;
            const double w248 = X1_0 * w233;
            const double w249 = w171 - w169;
            const double w250 = w196 * w233 + w1_1 * w248 - w1_2 * w249;
            const double w251 = Pxi1_1 * w232 - Wxi1_2 * w234 + w236 * w240 + w241 * w245 + w247 * w250;
            const double w252 = X1_1 * w237;
            const double w253 = 100.0 - X1_0 * w239 - X1_1 * w252;
            const double w254 = -0.9900990099009901 * w172;
            const double w255 = X1_0 * w244 + X1_1 * w254;
            const double w256 = X1_2 * w195;
            const double w257 = X1_1 * w256;
            const double w258 = w257 - X1_0 * w249;
            const double w259 = w236 * w253 + w241 * w255 + w247 * w258;
            const double w260 = 2.0 * Y_0;
            const double w261 = slope3(w101);
            const double w262 = slope2(w101);
            const double w263 = w173 * w261 + w262 * (w121 - w120);
            const double w264 = w119 * c3_3;
            const double w265 = w1 * (w260 * w263 - w264);
            const double w266 = -0.5386751345948129 * h;
            const double w267 = w128 * c3_1;
            const double w268 = X2_0 * c3_1;
            const double w269 = w267 + Nn2_1 * c2_1 - Nn2_2 * w268;
            const double w270 = 1.0773502691896257 * h;
            const double w271 = 0.08333333333333333 * a_5_2;
            const double w272 = s_2_2 * w180;
            const double w273 = s_2_0 * w271 - w272;
            const double w274 = w266 * w269 + w270 * w273;
            const double w275 = -0.25 * h;
            const double w276 = w150 * c3_2;
            const double w277 = X1_0 * c3_2;
            const double w278 = w276 + Nn1_1 * c2_2 - Nn1_2 * w277;
            const double w279 = 0.08333333333333333 * a_2;
            const double w280 = s_2 * w186;
            const double w281 = s_0 * w279 - w280;
            const double w282 = w275 * w278 + w1 * w281;
            const double w283 = X1_0 * w186;
            const double w284 = X1_1 * w168;
            const double w285 = w283 + w284;
            const double w286 = w1 * w285;
            const double w287 = 0.5 * w75;
            const double w288 = X1_0 * w287;
            const double w289 = 0.5 - X1_0 * w288;
            const double w290 = X1_1 * w287;
            const double w291 = w289 - X1_1 * w290;
            const double w292 = 0.01 * w75;
            const double w293 = X1_0 * w292;
            const double w294 = 0.01 * w66;
            const double w295 = X1_2 * w293 - X1_1 * w294;
            const double w296 = -0.5 * w66;
            const double w297 = X1_0 * w296;
            const double w298 = w297 + X1_2 * w290;
            const double w299 = X1_0 * w75;
            const double w300 = X1_2 * w66;
            const double w301 = X1_1 * w299 + w300;
            const double w302 = -1.01 * X1_1;
            const double w303 = 1.01 * X1_2;
            const double w304 = w296 * w302 + w288 * w303;
            const double w305 = X1_1 * w75;
            const double w306 = X1_2 * w75;
            const double w307 = X1_2 * w306;
            const double w308 = 1.0 - X1_1 * w305 - w307;
            const double w309 = w153 * w287;
            const double w310 = a_2_1 * w296;
            const double w311 = w69 * w292 + v1_1 * w294 - v1_2 * w293;
            const double w312 = w54 - w53;
            const double w313 = v1_2 * w66;
            const double w314 = w75 * w312 - v1_1 * w299 - w313;
            const double w315 = v1_2 * w306;
            const double w316 = v1_1 * w305 + w315;
            const double w317 = w309 + w310 - p_2 * w288 + w291 * w311 + w298 * w314 + w304 * w316;
            const double w318 = w291 * w295 + w298 * w301 + w304 * w308 + w3 * w317;
            const double w319 = X1_2 * w168 - w182;
            const double w320 = w1 * w319;
            const double w321 = X1_2 * w287;
            const double w322 = X1_1 * w321 - w297;
            const double w323 = w289 - X1_2 * w321;
            const double w324 = w296 * w303 - w288 * w302;
            const double w325 = w155 * w287;
            const double w326 = p_2 * w296;
            const double w327 = w311 * w322 - (w325 + a_2_1 * w288 + w326) + w314 * w323 + w316 * w324;
            const double w328 = w295 * w322 + w301 * w323 + w308 * w324 + w3 * w327;
            const double w329 = w159 + X1_2 * w186;
            const double w330 = w1 * w329;
            const double w331 = X1_0 * w321 + X1_1 * w296;
            const double w332 = X1_0 * w290 - X1_2 * w296;
            const double w333 = 0.505 + w290 * w302 - w303 * w321;
            const double w334 = a_2_1 * w290;
            const double w335 = p_2 * w321;
            const double w336 = w334 + w335 + w311 * w331 + w314 * w332 + w316 * w333;
            const double w337 = w295 * w331 + w301 * w332 + w308 * w333 + w3 * w336;
            const double w338 = w265 + w2 * w274 + w3 * w282 - w286 * w318 + w320 * w328 + w330 * w337;
            const double w339 = 0.08333333333333333 * X1_0;
            const double w340 = -0.08333333333333333 * X1_1;
            const double w341 = s_0 * w339 - s_1 * w340;
            const double w342 = w1 * w341;
            const double w343 = X1_1 * w64;
            const double w344 = X1_0 * w62;
            const double w345 = v1_1 * w64;
            const double w346 = w62 * w69 - w345 - v1_2 * w344;
            const double w347 = w343 + X1_2 * w344 + w3 * w346;
            const double w348 = 0.08333333333333333 * X1_2;
            const double w349 = 0.25 * a_4_0 - 0.08333333333333333 * w185 - s_1 * w348;
            const double w350 = w1 * w349;
            const double w351 = X1_2 * w64;
            const double w352 = v1_2 * w64;
            const double w353 = w62 * w312 - v1_1 * w344 + w352;
            const double w354 = X1_1 * w344 - w351 + w3 * w353;
            const double w355 = -0.08333333333333333 * X1_2;
            const double w356 = s_0 * w355 - 0.08333333333333333 * (w162 - w160) - 0.25 * a_4_1;
            const double w357 = w1 * w356;
            const double w358 = X1_1 * w62;
            const double w359 = X1_1 * w358;
            const double w360 = X1_2 * w62;
            const double w361 = X1_2 * w360;
            const double w362 = v1_1 * w358;
            const double w363 = v1_2 * w360;
            const double w364 = w362 + w363;
            const double w365 = 1.0 - w359 - w361 + w3 * w364;
            const double w366 = X2_0 * w180;
            const double w367 = X2_1 * w146;
            const double w368 = w366 + w367;
            const double w369 = w270 * w368;
            const double w370 = 0.5 * w26;
            const double w371 = w131 * w370;
            const double w372 = -0.5 * w17;
            const double w373 = a_6_1 * w372;
            const double w374 = X2_0 * w370;
            const double w375 = 0.5 - X2_0 * w374;
            const double w376 = X2_1 * w370;
            const double w377 = w375 - X2_1 * w376;
            const double w378 = 0.01 * w26;
            const double w379 = 0.01 * w17;
            const double w380 = X2_0 * w378;
            const double w381 = w20 * w378 + v2_1 * w379 - v2_2 * w380;
            const double w382 = X2_0 * w372;
            const double w383 = w382 + X2_2 * w376;
            const double w384 = w5 - w4;
            const double w385 = X2_0 * w26;
            const double w386 = v2_2 * w17;
            const double w387 = w26 * w384 - v2_1 * w385 - w386;
            const double w388 = -1.01 * X2_1;
            const double w389 = 1.01 * X2_2;
            const double w390 = w372 * w388 + w374 * w389;
            const double w391 = X2_1 * w26;
            const double w392 = X2_2 * w26;
            const double w393 = v2_2 * w392;
            const double w394 = v2_1 * w391 + w393;
            const double w395 = w371 + w373 - p_2_2 * w374 + w377 * w381 + w383 * w387 + w390 * w394;
            const double w396 = w2 * w395;
            const double w397 = X2_2 * w146 - w176;
            const double w398 = w270 * w397;
            const double w399 = X2_2 * w370;
            const double w400 = X2_1 * w399 - w382;
            const double w401 = w133 * w370;
            const double w402 = p_2_2 * w372;
            const double w403 = w375 - X2_2 * w399;
            const double w404 = w372 * w389 - w374 * w388;
            const double w405 = w381 * w400 - (w401 + a_6_1 * w374 + w402) + w387 * w403 + w394 * w404;
            const double w406 = w2 * w405;
            const double w407 = w338 + w342 * w347 + w350 * w354 + w357 * w365 - w369 * w396
                + w398 * w406;
            const double w408 = w137 + X2_2 * w180;
            const double w409 = w270 * w408;
            const double w410 = a_6_1 * w376;
            const double w411 = p_2_2 * w399;
            const double w412 = X2_0 * w399 + X2_1 * w372;
            const double w413 = X2_0 * w376 - X2_2 * w372;
            const double w414 = 0.505 + w376 * w388 - w389 * w399;
            const double w415 = w410 + w411 + w381 * w412 + w387 * w413 + w394 * w414;
            const double w416 = w2 * w415;
            const double w417 = 0.08333333333333333 * X2_0;
            const double w418 = -0.08333333333333333 * X2_1;
            const double w419 = s_2_0 * w417 - s_2_1 * w418;
            const double w420 = w270 * w419;
            const double w421 = v2_1 * w15;
            const double w422 = X2_0 * w13;
            const double w423 = w13 * w20 - w421 - v2_2 * w422;
            const double w424 = w2 * w423;
            const double w425 = 0.08333333333333333 * X2_2;
            const double w426 = 0.25 * a_8_0 - 0.08333333333333333 * w179 - s_2_1 * w425;
            const double w427 = w270 * w426;
            const double w428 = v2_2 * w15;
            const double w429 = w13 * w384 - v2_1 * w422 + w428;
            const double w430 = w2 * w429;
            const double w431 = -0.08333333333333333 * X2_2;
            const double w432 = s_2_0 * w431 - 0.08333333333333333 * (w140 - w138) - 0.25 * a_8_1;
            const double w433 = w270 * w432;
            const double w434 = X2_1 * w13;
            const double w435 = v2_1 * w434;
            const double w436 = X2_2 * w13;
            const double w437 = v2_2 * w436;
            const double w438 = w435 + w437;
            const double w439 = w2 * w438;
            const double w440 = w1 * s_L_1;
            const double w441 = w102 * w440;
            const double w442 = w407 + w409 * w416 + w420 * w424 + w427 * w430 + w433 * w439 + w441;
            const double w443 = X1_0 * w238 + X1_2 * w252;
            const double w444 = X1_0 * w243 - X1_2 * w254;
            const double w445 = 1.0 + X1_0 * w248 - X1_2 * w256;
            const double w446 = w236 * w443 + w241 * w444 + w247 * w445;
            const double w447 = w122 * c3_3;
            const double w448 = w187 * w261 + w262 * (w118 - w117);
            const double w449 = w1 * (w447 + w260 * w448);
            const double w450 = w127 * c3_1;
            const double w451 = Nn2_2 * c2_1;
            const double w452 = w450 + Nn2_1 * w268 + w451;
            const double w453 = s_2_0 * w146;
            const double w454 = s_2_1 * w180 + w453;
            const double w455 = w266 * w452 + w270 * w454;
            const double w456 = w149 * c3_2;
            const double w457 = Nn1_2 * c2_2;
            const double w458 = w456 + Nn1_1 * w277 + w457;
            const double w459 = s_0 * w168;
            const double w460 = s_1 * w186 + w459;
            const double w461 = w275 * w458 + w1 * w460;
            const double w462 = w182 + X1_1 * w164;
            const double w463 = w1 * w462;
            const double w464 = X1_2 * w164;
            const double w465 = w283 + w464;
            const double w466 = w1 * w465;
            const double w467 = X1_1 * w186 - w157;
            const double w468 = w1 * w467;
            const double w469 = w449 - w2 * w455 - w3 * w461 + w318 * w463 - w328 * w466 + w337 * w468;
            const double w470 = -0.08333333333333333 * (w184 - w183) - 0.25 * a_4_0 + s_2 * w340;
            const double w471 = w1 * w470;
            const double w472 = -0.08333333333333333 * X1_0;
            const double w473 = s_2 * w348 - s_0 * w472;
            const double w474 = w1 * w473;
            const double w475 = 0.08333333333333333 * X1_1;
            const double w476 = -0.08333333333333333 * w167 - s_0 * w475 + 0.25 * a_4_2;
            const double w477 = w1 * w476;
            const double w478 = w176 + X2_1 * w142;
            const double w479 = w270 * w478;
            const double w480 = X2_2 * w142;
            const double w481 = w366 + w480;
            const double w482 = w270 * w481;
            const double w483 = w469 + w347 * w471 + w354 * w474 + w365 * w477 + w396 * w479
                - w406 * w482;
            const double w484 = X2_1 * w180 - w135;
            const double w485 = w270 * w484;
            const double w486 = -0.08333333333333333 * (w178 - w177) - 0.25 * a_8_0 + s_2_2 * w418;
            const double w487 = w270 * w486;
            const double w488 = -0.08333333333333333 * X2_0;
            const double w489 = s_2_2 * w425 - s_2_0 * w488;
            const double w490 = w270 * w489;
            const double w491 = 0.08333333333333333 * X2_1;
            const double w492 = -0.08333333333333333 * w145 - s_2_0 * w491 + 0.25 * a_8_2;
            const double w493 = w270 * w492;
            const double w494 = Y_0 * c3_3;
            const double w495 = w440 * w494;
            const double w496 = w483 + w416 * w485 + w424 * w487 + w430 * w490 + w439 * w493 - w495;
            const double w497 = X1_2 * w239 - X1_1 * w238;
            const double w498 = 0.9900990099009901 - X1_1 * w243 - X1_2 * w244;
            const double w499 = X1_1 * w248;
            const double w500 = X1_2 * w249 - w499;
            const double w501 = w236 * w497 + w241 * w498 + w247 * w500;
            const double w502 = w123 * w261 + w262 * (w114 - w111);
            const double w503 = w260 * w502 * w1;
            const double w504 = X2_1 * c3_1;
            const double w505 = X2_2 * c3_1;
            const double w506 = Nn2_2 * w505;
            const double w507 = Nn2_1 * w504 + w506;
            const double w508 = s_2_1 * w146;
            const double w509 = s_2_2 * w142;
            const double w510 = w508 + w509 + w508 - s_2_2 * w271;
            const double w511 = w266 * w507 + w270 * w510;
            const double w512 = X1_1 * c3_2;
            const double w513 = X1_2 * c3_2;
            const double w514 = Nn1_2 * w513;
            const double w515 = Nn1_1 * w512 + w514;
            const double w516 = s_1 * w168;
            const double w517 = s_2 * w164;
            const double w518 = w516 + w517 + w516 - s_2 * w279;
            const double w519 = w275 * w515 + w1 * w518;
            const double w520 = X1_0 * w164 - w159;
            const double w521 = w1 * w520;
            const double w522 = w157 + X1_0 * w168;
            const double w523 = w1 * w522;
            const double w524 = w284 + w464;
            const double w525 = w1 * w524;
            const double w526 = w503 + w2 * w511 + w3 * w519 + w318 * w521 + w328 * w523 - w337 * w525;
            const double w527 = 0.25 * a_4_1 - 0.08333333333333333 * w163 - s_2 * w339;
            const double w528 = w1 * w527;
            const double w529 = s_1 * w472 - 0.08333333333333333 * (w166 - w165) - 0.25 * a_4_2;
            const double w530 = w1 * w529;
            const double w531 = s_1 * w475 - s_2 * w355;
            const double w532 = w1 * w531;
            const double w533 = X2_0 * w142 - w137;
            const double w534 = w270 * w533;
            const double w535 = w135 + X2_0 * w146;
            const double w536 = w270 * w535;
            const double w537 = w526 + w347 * w528 + w354 * w530 + w365 * w532 + w396 * w534
                + w406 * w536;
            const double w538 = w367 + w480;
            const double w539 = w270 * w538;
            const double w540 = 0.25 * a_8_1 - 0.08333333333333333 * w141 - s_2_2 * w417;
            const double w541 = w270 * w540;
            const double w542 = s_2_1 * w488 - 0.08333333333333333 * (w144 - w143) - 0.25 * a_8_2;
            const double w543 = w270 * w542;
            const double w544 = s_2_1 * w491 - s_2_2 * w431;
            const double w545 = w270 * w544;
            const double w546 = Y_1 * c3_3;
            const double w547 = w440 * w546;
            const double w548 = w537 - w416 * w539 + w424 * w541 + w430 * w543 + w439 * w545 + w547;
            const double w549 = w1 * s_L_2;
            const double w550 = Y_2 * c3_3;
            const double w551 = w501 * w550 - (w102 * w446 + w259 * w494);
            const double w552 = w549 * w551;
            const double w553 = 0.99 * a_2_2;
            const double w554 = -2.0 * Q1_7;
            const double w555 = w96 * (0.5 * w96 + 2.0 * w95 * w97) * w97;
            const double w556 = 2.25 * w555;
            const double w557 = 0.45 * w555;
            const double w558 = w554 * w556 - Q1_8 * w557;
            const double w559 = w92 * (0.5 * w92 + 2.0 * w91 * w93) * w93;
            const double w560 = -2.25 * w559;
            const double w561 = 0.45 * w559;
            const double w562 = w554 * w560 - Q1_8 * w561;
            const double w563 = -2.0 * w558 - w100 - 2.0 * w562;
            const double w564 = g20 * X1_2;
            const double w565 = g22 * X1_0;
            const double w566 = w564 - w565;
            const double w567 = g22 * w78;
            const double w568 = g21 * c1_2;
            const double w569 = w566 * c2_2 - (w567 + w568);
            const double w570 = w99 + 0.2 * w558 - 0.2 * w562;
            const double w571 = g22 * c1_2;
            const double w572 = g21 * w78;
            const double w573 = g20 * X1_1;
            const double w574 = w573 - g21 * X1_0;
            const double w575 = w571 - w572 + w574 * c2_2;
            const double w576 = w563 * w569 + w570 * w575 + w77 * w311 + w314 * w553;
            const double w577 = w77 * w295 + w301 * w553 + w3 * w576;
            const double w578 = X1_2 * w277 - w85;
            const double w579 = w1 * Y_1;
            const double w580 = w102 * w579;
            const double w581 = w275 * w578 - w580;
            const double w582 = w82 + X1_1 * w277;
            const double w583 = w494 * w579;
            const double w584 = w275 * w582 + w583;
            const double w585 = X1_1 * w512;
            const double w586 = X1_2 * w513;
            const double w587 = 1.0 - w585 - w586;
            const double w588 = w546 * w579;
            const double w589 = w1 + w275 * w587 - w588;
            const double w590 = w1 * Y_2;
            const double w591 = w551 * w590;
            const double w592 = w259 * w581 + w446 * w584 + w501 * w589 - w591;
            const double w593 = w3 * w251 + w259 * w442 + w446 * w496 + w501 * w548 + w552
                + w577 * w592;
            const double w594 = -2.0 * Q2_7;
            const double w595 = w47 * (0.5 * w47 + 2.0 * w46 * w48) * w48;
            const double w596 = 2.25 * w595;
            const double w597 = 0.45 * w595;
            const double w598 = w594 * w596 - Q2_8 * w597;
            const double w599 = w43 * (0.5 * w43 + 2.0 * w42 * w44) * w44;
            const double w600 = -2.25 * w599;
            const double w601 = 0.45 * w599;
            const double w602 = w594 * w600 - Q2_8 * w601;
            const double w603 = -2.0 * w598 - w51 - 2.0 * w602;
            const double w604 = g20 * X2_2;
            const double w605 = g22 * X2_0;
            const double w606 = w604 - w605;
            const double w607 = g22 * w29;
            const double w608 = g21 * c1_1;
            const double w609 = w606 * c2_1 - (w607 + w608);
            const double w610 = w50 + 0.2 * w598 - 0.2 * w602;
            const double w611 = g22 * c1_1;
            const double w612 = g21 * w29;
            const double w613 = g20 * X2_1;
            const double w614 = w613 - g21 * X2_0;
            const double w615 = w611 - w612 + w614 * c2_1;
            const double w616 = 0.99 * a_6_2;
            const double w617 = w603 * w609 + w610 * w615 + w28 * w381 + w387 * w616;
            const double w618 = w2 * w617;
            const double w619 = X2_2 * w268 - w36;
            const double w620 = w266 * w619 - w580;
            const double w621 = w33 + X2_1 * w268;
            const double w622 = w583 + w266 * w621;
            const double w623 = X2_1 * w504;
            const double w624 = X2_2 * w505;
            const double w625 = 1.0 - w623 - w624;
            const double w626 = w1 + w266 * w625 - w588;
            const double w627 = w259 * w620 + w446 * w622 + w501 * w626 - w591;
            const double w628 = 0.01 * a_2_1;
            const double w629 = g22 * X1_2;
            const double w630 = w629 + g21 * X1_1;
            const double w631 = w630 * c2_2;
            const double w632 = Q1_6 * w557;
            const double w633 = Q1_6 * w561;
            const double w634 = -2.0 * w632 - 2.0 * w633;
            const double w635 = 0.2 * w632 - 0.2 * w633;
            const double w636 = w100 * w631 + w569 * w634 + w575 * w635 + w113 * w314 + w316 * w628;
            const double w637 = w113 * w301 + w308 * w628 + w3 * w636;
            const double w638 = 1.0 - X1_0 * w277;
            const double w639 = w638 - w585;
            const double w640 = w1 + w275 * w639;
            const double w641 = X1_1 * w513 - w78;
            const double w642 = w275 * w641;
            const double w643 = w85 + X1_0 * w513;
            const double w644 = w275 * w643;
            const double w645 = w1 * Y_0;
            const double w646 = w551 * w645;
            const double w647 = w259 * w546 - w446 * w550 - w102 * w501;
            const double w648 = w579 * w647;
            const double w649 = w259 * w640 + w446 * w642 + w501 * w644 + w646 - w648;
            const double w650 = 2.0 * Q1_6;
            const double w651 = w556 * w650;
            const double w652 = w560 * w650;
            const double w653 = -2.0 * w651 - 2.0 * w652;
            const double w654 = 0.2 * w651 - 0.2 * w652;
            const double w655 = w569 * w653 - w99 * w631 + w575 * w654 + w108 * w311 - a_2_2 * w316;
            const double w656 = w108 * w295 - a_2_2 * w308 + w3 * w655;
            const double w657 = w78 + X1_2 * w512;
            const double w658 = w102 * w645;
            const double w659 = w275 * w657 + w658;
            const double w660 = w638 - w586;
            const double w661 = w494 * w645;
            const double w662 = w1 + w275 * w660 - w661;
            const double w663 = X1_0 * w512 - w82;
            const double w664 = w546 * w645;
            const double w665 = w275 * w663 + w664;
            const double w666 = w590 * w647;
            const double w667 = w259 * w659 + w446 * w662 + w501 * w665 + w666;
            const double w668 = 2.0 * X1_0;
            const double w669 = w3 * w668;
            const double w670 = c3_2 - c2_2;
            const double w671 = slope2(w57);
            const double w672 = -0.25 * w670 - w193 + w59 * w671;
            const double w673 = 0.5 * w670;
            const double w674 = w673 * (1.0 - 0.08333333333333333 * w57) - w170 + 0.5 * w57 * w671;
            const double w675 = 100.0 * w201 * w672 - 100.0 * w196 * w674;
            const double w676 = 0.9900990099009901 * w200 * w672 - 0.9900990099009901 * w191 * w674;
            const double w677 = w202 * w672 + w674 * (w198 - w197);
            const double w678 = slope3(w57);
            const double w679 = w181 * w678 + w149 * w671;
            const double w680 = w57 * c2_2;
            const double w681 = w60 * w60;
            const double w682 = 0.25 - 0.16666666666666666 * w59;
            const double w683 = 0.006944444444444444 * w60 - w61 * w681 * w682;
            const double w684 = 0.5 * w681 * w682;
            const double w685 = w57 * w62;
            const double w686 = (1.0 - w680) * w683 - w74 + w684 * c1_2 + w64 * w673
                + w671 * (1.0 - w685);
            const double w687 = w65 + w57 * c1_2 * w683 + w684 * (w680 - 1.0) + w673 * (w685 - 1.0)
                + w57 * w64 * w671;
            const double w688 = 0.01 * w73 * w686 + 0.01 * w55 * w687;
            const double w689 = w76 * w686 + w69 * w687;
            const double w690 = w107 * w686 + w72 * w687;
            const double w691 = 0.5 * w158 * w686 - 0.5 * w155 * w687 + w291 * w688 + w298 * w689
                + w304 * w690;
            const double w692 = 0.5 * w156 * w686 - 0.5 * w153 * w687 + w322 * w688 + w323 * w689
                + w324 * w690;
            const double w693 = 0.5 * w161 * w686 - 0.5 * w154 * w687 + w331 * w688 + w332 * w689
                + w333 * w690;
            const double w694 = w73 * w683 + w312 * w684;
            const double w695 = w68 - w67;
            const double w696 = w76 * w683 + w684 * w695;
            const double w697 = w275 * w679 - w286 * w691 + w320 * w692 + w330 * w693 + w342 * w694
                + w350 * w696;
            const double w698 = w71 - w70;
            const double w699 = w107 * w683 + w684 * w698;
            const double w700 = w697 + w357 * w699;
            const double w701 = w206 * w672 + w203 * w674 + w236 * w675 + w241 * w676 + w247 * w677
                + w259 * w700;
            const double w702 = w190 * w678 + w150 * w671;
            const double w703 = w275 * w702 + w463 * w691 - w466 * w692 + w468 * w693 + w471 * w694
                + w474 * w696;
            const double w704 = w703 + w477 * w699;
            const double w705 = w151 * w678 + w147 * w671;
            const double w706 = w275 * w705 + w521 * w691 + w523 * w692 - w525 * w693 + w528 * w694
                + w530 * w696;
            const double w707 = w706 + w532 * w699;
            const double w708 = g21 * X1_2 - g22 * X1_1;
            const double w709 = w671 * (X1_1 * w708 + X1_0 * w566) + w574 * w673;
            const double w710 = w673 * (w565 - w564) + w671 * (X1_1 * w629 - g21 * w56 + X1_0 * w574);
            const double w711 = w563 * w709 + w570 * w710 + w77 * w688 + w553 * w689;
            const double w712 = w673 * w708;
            const double w713 = X1_0 * w630 - (g20 * w56 + X1_1 * w573);
            const double w714 = w100 * w712 + w100 * w713 * w671 + w634 * w709 + w635 * w710
                + w113 * w689;
            const double w715 = w714 + w628 * w690;
            const double w716 = w653 * w709 - (w99 * w712 + w99 * w713 * w671) + w654 * w710
                + w108 * w688;
            const double w717 = w716 - a_2_2 * w690;
            const double w718 = w701 + w446 * w704 + w501 * w707 + w592 * w711 + w649 * w715
                + w667 * w717;
            const double w719 = g22 * X2_2;
            const double w720 = w719 + g21 * X2_1;
            const double w721 = w720 * c2_1;
            const double w722 = Q2_6 * w597;
            const double w723 = Q2_6 * w601;
            const double w724 = -2.0 * w722 - 2.0 * w723;
            const double w725 = 0.2 * w722 - 0.2 * w723;
            const double w726 = 0.01 * a_6_1;
            const double w727 = w51 * w721 + w609 * w724 + w615 * w725 + w112 * w387 + w394 * w726;
            const double w728 = w2 * w727;
            const double w729 = 1.0 - X2_0 * w268;
            const double w730 = w729 - w623;
            const double w731 = w1 + w266 * w730;
            const double w732 = X2_1 * w505 - w29;
            const double w733 = w266 * w732;
            const double w734 = w36 + X2_0 * w505;
            const double w735 = w266 * w734;
            const double w736 = w259 * w731 + w446 * w733 + w501 * w735 + w646 - w648;
            const double w737 = w593 + w618 * w627 + w637 * w649 + w656 * w667 + w669 * w718
                + w728 * w736;
            const double w738 = 2.0 * Q2_6;
            const double w739 = w596 * w738;
            const double w740 = w600 * w738;
            const double w741 = -2.0 * w739 - 2.0 * w740;
            const double w742 = 0.2 * w739 - 0.2 * w740;
            const double w743 = w609 * w741 - w50 * w721 + w615 * w742 + w104 * w381 - a_6_2 * w394;
            const double w744 = w2 * w743;
            const double w745 = w29 + X2_2 * w504;
            const double w746 = w658 + w266 * w745;
            const double w747 = w729 - w624;
            const double w748 = w1 + w266 * w747 - w661;
            const double w749 = X2_0 * w504 - w33;
            const double w750 = w664 + w266 * w749;
            const double w751 = w259 * w746 + w446 * w748 + w501 * w750 + w666;
            const double w752 = 2.0 * X2_0;
            const double w753 = w2 * w752;
            const double w754 = slope3(w8);
            const double w755 = slope2(w8);
            const double w756 = w175 * w754 + w127 * w755;
            const double w757 = w8 * c2_1;
            const double w758 = w11 * w11;
            const double w759 = 0.25 - 0.16666666666666666 * w10;
            const double w760 = 0.006944444444444444 * w11 - w12 * w758 * w759;
            const double w761 = 0.5 * w758 * w759;
            const double w762 = c3_1 - c2_1;
            const double w763 = 0.5 * w762;
            const double w764 = w8 * w13;
            const double w765 = (1.0 - w757) * w760 - w25 + w761 * c1_1 + w15 * w763
                + w755 * (1.0 - w764);
            const double w766 = w16 + w8 * c1_1 * w760 + w761 * (w757 - 1.0) + w763 * (w764 - 1.0)
                + w8 * w15 * w755;
            const double w767 = 0.01 * w24 * w765 + 0.01 * w6 * w766;
            const double w768 = w27 * w765 + w20 * w766;
            const double w769 = w103 * w765 + w23 * w766;
            const double w770 = 0.5 * w136 * w765 - 0.5 * w133 * w766 + w377 * w767 + w383 * w768
                + w390 * w769;
            const double w771 = 0.5 * w134 * w765 - 0.5 * w131 * w766 + w400 * w767 + w403 * w768
                + w404 * w769;
            const double w772 = 0.5 * w139 * w765 - 0.5 * w132 * w766 + w412 * w767 + w413 * w768
                + w414 * w769;
            const double w773 = w24 * w760 + w384 * w761;
            const double w774 = w19 - w18;
            const double w775 = w27 * w760 + w761 * w774;
            const double w776 = w266 * w756 - w369 * w770 + w398 * w771 + w409 * w772 + w420 * w773
                + w427 * w775;
            const double w777 = w22 - w21;
            const double w778 = w103 * w760 + w761 * w777;
            const double w779 = w776 + w433 * w778;
            const double w780 = w189 * w754 + w128 * w755;
            const double w781 = w266 * w780 + w479 * w770 - w482 * w771 + w485 * w772 + w487 * w773
                + w490 * w775;
            const double w782 = w781 + w493 * w778;
            const double w783 = w129 * w754 + w125 * w755;
            const double w784 = w266 * w783 + w534 * w770 + w536 * w771 - w539 * w772 + w541 * w773
                + w543 * w775;
            const double w785 = w784 + w545 * w778;
            const double w786 = g21 * X2_2 - g22 * X2_1;
            const double w787 = w755 * (X2_1 * w786 + X2_0 * w606) + w614 * w763;
            const double w788 = w763 * (w605 - w604) + w755 * (X2_1 * w719 - g21 * w7 + X2_0 * w614);
            const double w789 = w603 * w787 + w610 * w788 + w28 * w767 + w616 * w768;
            const double w790 = w763 * w786;
            const double w791 = X2_0 * w720 - (g20 * w7 + X2_1 * w613);
            const double w792 = w51 * w790 + w51 * w791 * w755 + w724 * w787 + w725 * w788
                + w112 * w768;
            const double w793 = w792 + w726 * w769;
            const double w794 = w741 * w787 - (w50 * w790 + w50 * w791 * w755) + w742 * w788
                + w104 * w767;
            const double w795 = w794 - a_6_2 * w769;
            const double w796 = w259 * w779 + w446 * w782 + w501 * w785 + w627 * w789 + w736 * w793
                + w751 * w795;
            const double w797 = w172 * Wxi1_2;
            const double w798 = w191 * w237 + w1_0 * w238 + w1_2 * w252;
            const double w799 = w196 * w242 - w1_0 * w243 + w1_2 * w254;
            const double w800 = w1_2 * w256 - w1_0 * w248;
            const double w801 = w195 * w204 - Wxi1_0 * w232 + w797 - w236 * w798 + w241 * w799
                + w247 * w800;
            const double w802 = w115 * c3_3;
            const double w803 = 2.0 * Y_1;
            const double w804 = w1 * (w802 + w263 * w803);
            const double w805 = w125 * c3_1 + Nn2_0 * c2_1;
            const double w806 = w805 + Nn2_2 * w504;
            const double w807 = s_2_1 * w142;
            const double w808 = s_2_2 * w146 + w807;
            const double w809 = w266 * w806 + w270 * w808;
            const double w810 = w147 * c3_2 + Nn1_0 * c2_2;
            const double w811 = w810 + Nn1_2 * w512;
            const double w812 = s_1 * w164;
            const double w813 = s_2 * w168 + w812;
            const double w814 = w275 * w811 + w1 * w813;
            const double w815 = X1_1 * w292;
            const double w816 = X1_0 * w294 + X1_2 * w815;
            const double w817 = 1.0 - X1_0 * w299 - w307;
            const double w818 = X1_0 * w305 - w300;
            const double w819 = w292 * w698 - v1_0 * w294 - v1_2 * w815;
            const double w820 = w154 * w287 + p_0 * w296;
            const double w821 = w315 + v1_0 * w299;
            const double w822 = w55 * w75 - v1_0 * w305 + w313;
            const double w823 = w291 * w819 - (w820 + p_2 * w290) + w298 * w821 + w304 * w822;
            const double w824 = w291 * w816 + w298 * w817 + w304 * w818 + w3 * w823;
            const double w825 = p_0 * w288;
            const double w826 = w335 + w825 + w322 * w819 + w323 * w821 + w324 * w822;
            const double w827 = w322 * w816 + w323 * w817 + w324 * w818 + w3 * w826;
            const double w828 = w325 - p_0 * w290 + w326 + w331 * w819 + w332 * w821 + w333 * w822;
            const double w829 = w331 * w816 + w332 * w817 + w333 * w818 + w3 * w828;
            const double w830 = w804 - w2 * w809 - w3 * w814 - w286 * w824 + w320 * w827 + w330 * w829;
            const double w831 = X1_0 * w64;
            const double w832 = v1_0 * w64;
            const double w833 = w62 * w698 + w832 - v1_2 * w358;
            const double w834 = X1_2 * w358 - w831 + w3 * w833;
            const double w835 = 1.0 - X1_0 * w344;
            const double w836 = v1_0 * w344;
            const double w837 = w363 + w836;
            const double w838 = w835 - w361 + w3 * w837;
            const double w839 = w55 * w62 - v1_0 * w358 - w352;
            const double w840 = w351 + X1_0 * w358 + w3 * w839;
            const double w841 = X2_1 * w378;
            const double w842 = w378 * w777 - v2_0 * w379 - v2_2 * w841;
            const double w843 = w132 * w370 + p_2_0 * w372;
            const double w844 = w393 + v2_0 * w385;
            const double w845 = w6 * w26 - v2_0 * w391 + w386;
            const double w846 = w377 * w842 - (w843 + p_2_2 * w376) + w383 * w844 + w390 * w845;
            const double w847 = w2 * w846;
            const double w848 = p_2_0 * w374;
            const double w849 = w411 + w848 + w400 * w842 + w403 * w844 + w404 * w845;
            const double w850 = w2 * w849;
            const double w851 = w830 + w342 * w834 + w350 * w838 + w357 * w840 - w369 * w847
                + w398 * w850;
            const double w852 = w401 - p_2_0 * w376 + w402 + w412 * w842 + w413 * w844 + w414 * w845;
            const double w853 = w2 * w852;
            const double w854 = v2_0 * w15;
            const double w855 = w13 * w777 + w854 - v2_2 * w434;
            const double w856 = w2 * w855;
            const double w857 = v2_0 * w422;
            const double w858 = w437 + w857;
            const double w859 = w2 * w858;
            const double w860 = w6 * w13 - v2_0 * w434 - w428;
            const double w861 = w2 * w860;
            const double w862 = w1 * s_L_0;
            const double w863 = w102 * w862;
            const double w864 = w851 + w409 * w853 + w420 * w856 + w427 * w859 + w433 * w861 - w863;
            const double w865 = w448 * w803 * w1;
            const double w866 = Nn2_0 * w268;
            const double w867 = w506 + w866;
            const double w868 = s_2_0 * w180;
            const double w869 = 0.08333333333333333 * a_5_0;
            const double w870 = w509 + w868 - s_2_0 * w869 + w509;
            const double w871 = w266 * w867 + w270 * w870;
            const double w872 = Nn1_0 * w277;
            const double w873 = w514 + w872;
            const double w874 = s_0 * w186;
            const double w875 = 0.08333333333333333 * a_0;
            const double w876 = w517 + w874 - s_0 * w875 + w517;
            const double w877 = w275 * w873 + w1 * w876;
            const double w878 = w865 + w2 * w871 + w3 * w877 + w463 * w824 - w466 * w827 + w468 * w829;
            const double w879 = w878 + w471 * w834 + w474 * w838 + w477 * w840 + w479 * w847
                - w482 * w850;
            const double w880 = w494 * w862;
            const double w881 = w879 + w485 * w853 + w487 * w856 + w490 * w859 + w493 * w861 + w880;
            const double w882 = w1 * (w502 * w803 - w447);
            const double w883 = w450 - Nn2_0 * w504 + w451;
            const double w884 = s_2_1 * w869 - w453;
            const double w885 = w266 * w883 + w270 * w884;
            const double w886 = w456 - Nn1_0 * w512 + w457;
            const double w887 = s_1 * w875 - w459;
            const double w888 = w275 * w886 + w1 * w887;
            const double w889 = w882 + w2 * w885 + w3 * w888 + w521 * w824 + w523 * w827 - w525 * w829;
            const double w890 = w889 + w528 * w834 + w530 * w838 + w532 * w840 + w534 * w847
                + w536 * w850;
            const double w891 = w546 * w862;
            const double w892 = w890 - w539 * w853 + w541 * w856 + w543 * w859 + w545 * w861 - w891;
            const double w893 = g20 * c1_2;
            const double w894 = g22 * w85;
            const double w895 = w893 - w894 + w708 * c2_2;
            const double w896 = g20 * w78;
            const double w897 = w896 + w629 * c2_2;
            const double w898 = w563 * w895 + w570 * w897 + w77 * w819 + w553 * w821;
            const double w899 = w77 * w816 + w553 * w817 + w3 * w898;
            const double w900 = g20 * c1_1;
            const double w901 = g22 * w36;
            const double w902 = w900 - w901 + w786 * c2_1;
            const double w903 = g20 * w29;
            const double w904 = w903 + w719 * c2_1;
            const double w905 = w603 * w902 + w610 * w904 + w28 * w842 + w616 * w844;
            const double w906 = w2 * w905;
            const double w907 = w3 * w801 + w259 * w864 + w446 * w881 + w501 * w892 + w592 * w899
                + w627 * w906;
            const double w908 = w549 * w647;
            const double w909 = w572 - g20 * w85 - w571 - w573 * c2_2;
            const double w910 = w100 * w909 + w634 * w895 + w635 * w897 + w113 * w821 + w628 * w822;
            const double w911 = w113 * w817 + w628 * w818 + w3 * w910;
            const double w912 = w653 * w895 - w99 * w909 + w654 * w897 + w108 * w819 - a_2_2 * w822;
            const double w913 = w108 * w816 - a_2_2 * w818 + w3 * w912;
            const double w914 = 2.0 * X1_1;
            const double w915 = w3 * w914;
            const double w916 = w612 - g20 * w36 - w611 - w613 * c2_1;
            const double w917 = w51 * w916 + w724 * w902 + w725 * w904 + w112 * w844 + w726 * w845;
            const double w918 = w2 * w917;
            const double w919 = w741 * w902 - w50 * w916 + w742 * w904 + w104 * w842 - a_6_2 * w845;
            const double w920 = w2 * w919;
            const double w921 = w907 - w908 + w649 * w911 + w667 * w913 + w718 * w915 + w736 * w918
                + w751 * w920;
            const double w922 = 2.0 * X2_1;
            const double w923 = w2 * w922;
            const double w924 = w172 * Pxi1_1;
            const double w925 = w1_0 * w239 + w1_1 * w252;
            const double w926 = w199 * w242 + w1_0 * w244 + w1_1 * w254;
            const double w927 = w1_0 * w249 + w191 * w195 - w1_1 * w256;
            const double w928 = w205 * w233 + Wxi1_0 * w234 - w924 + w236 * w925 - w241 * w926
                + w247 * w927;
            const double w929 = 2.0 * Y_2;
            const double w930 = w263 * w929 * w1;
            const double w931 = w106 - w105;
            const double w932 = w866 - w504 * w931;
            const double w933 = 0.08333333333333333 * a_5_1;
            const double w934 = w508 + w868 + w868 - s_2_1 * w933;
            const double w935 = w266 * w932 + w270 * w934;
            const double w936 = w110 - w109;
            const double w937 = w872 - w512 * w936;
            const double w938 = 0.08333333333333333 * a_1;
            const double w939 = w516 + w874 + w874 - s_1 * w938;
            const double w940 = w275 * w937 + w1 * w939;
            const double w941 = 0.01 - X1_0 * w293 - X1_1 * w815;
            const double w942 = X1_1 * w306 - X1_0 * w66;
            const double w943 = X1_0 * w306 + X1_1 * w66;
            const double w944 = v1_0 * w293 + v1_1 * w815;
            const double w945 = w72 * w75 + v1_0 * w66 - v1_1 * w306;
            const double w946 = w75 * w695 - v1_0 * w306 - v1_1 * w66;
            const double w947 = w334 + w825 + w291 * w944 + w298 * w945 + w304 * w946;
            const double w948 = w291 * w941 + w298 * w942 + w304 * w943 + w3 * w947;
            const double w949 = w820 - a_2_1 * w321 + w322 * w944 + w323 * w945 + w324 * w946;
            const double w950 = w322 * w941 + w323 * w942 + w324 * w943 + w3 * w949;
            const double w951 = w331 * w944 - (w309 + p_0 * w321 + w310) + w332 * w945 + w333 * w946;
            const double w952 = w331 * w941 + w332 * w942 + w333 * w943 + w3 * w951;
            const double w953 = w930 + w2 * w935 + w3 * w940 - w286 * w948 + w320 * w950 + w330 * w952;
            const double w954 = w362 + w836;
            const double w955 = w835 - w359 + w3 * w954;
            const double w956 = w62 * w72 - w832 - v1_1 * w360;
            const double w957 = w831 + X1_1 * w360 + w3 * w956;
            const double w958 = w62 * w695 - v1_0 * w360 + w345;
            const double w959 = X1_0 * w360 - w343 + w3 * w958;
            const double w960 = v2_0 * w380 + v2_1 * w841;
            const double w961 = w23 * w26 + v2_0 * w17 - v2_1 * w392;
            const double w962 = w26 * w774 - v2_0 * w392 - v2_1 * w17;
            const double w963 = w410 + w848 + w377 * w960 + w383 * w961 + w390 * w962;
            const double w964 = w2 * w963;
            const double w965 = w843 - a_6_1 * w399 + w400 * w960 + w403 * w961 + w404 * w962;
            const double w966 = w2 * w965;
            const double w967 = w953 + w342 * w955 + w350 * w957 + w357 * w959 - w369 * w964
                + w398 * w966;
            const double w968 = w412 * w960 - (w371 + p_2_0 * w399 + w373) + w413 * w961 + w414 * w962;
            const double w969 = w2 * w968;
            const double w970 = w435 + w857;
            const double w971 = w2 * w970;
            const double w972 = w13 * w23 - w854 - v2_1 * w436;
            const double w973 = w2 * w972;
            const double w974 = w13 * w774 - v2_0 * w436 + w421;
            const double w975 = w2 * w974;
            const double w976 = w967 + w409 * w969 + w420 * w971 + w427 * w973 + w433 * w975;
            const double w977 = w1 * (w448 * w929 - w802);
            const double w978 = w805 + w505 * w931;
            const double w979 = s_2_2 * w933 - w807;
            const double w980 = w266 * w978 + w270 * w979;
            const double w981 = w810 + w513 * w936;
            const double w982 = s_2 * w938 - w812;
            const double w983 = w275 * w981 + w1 * w982;
            const double w984 = w977 + w2 * w980 + w3 * w983 + w463 * w948 - w466 * w950 + w468 * w952;
            const double w985 = w984 + w471 * w955 + w474 * w957 + w477 * w959 + w479 * w964
                - w482 * w966;
            const double w986 = w985 + w485 * w969 + w487 * w971 + w490 * w973 + w493 * w975;
            const double w987 = w1 * (w264 + w502 * w929);
            const double w988 = w931 * c2_1 - (w267 + Nn2_0 * w505);
            const double w989 = w272 + s_2_0 * w142;
            const double w990 = w266 * w988 - w270 * w989;
            const double w991 = w936 * c2_2 - (w276 + Nn1_0 * w513);
            const double w992 = w280 + s_0 * w164;
            const double w993 = w275 * w991 - w1 * w992;
            const double w994 = w987 + w2 * w990 + w3 * w993 + w521 * w948 + w523 * w950 - w525 * w952;
            const double w995 = w994 + w528 * w955 + w530 * w957 + w532 * w959 + w534 * w964
                + w536 * w966;
            const double w996 = w995 - w539 * w969 + w541 * w971 + w543 * w973 + w545 * w975;
            const double w997 = w551 * w862;
            const double w998 = w896 + g21 * w85;
            const double w999 = 2.0 * w82;
            const double w1000 = w894 - g21 * w999 - w893;
            const double w1001 = w563 * w998 + w570 * w1000 + w77 * w944 + w553 * w945;
            const double w1002 = w77 * w941 + w553 * w942 + w3 * w1001;
            const double w1003 = w3 * w928 + w259 * w976 + w446 * w986 + w501 * w996 - w997
                + w592 * w1002;
            const double w1004 = w903 + g21 * w36;
            const double w1005 = 2.0 * w33;
            const double w1006 = w901 - g21 * w1005 - w900;
            const double w1007 = w603 * w1004 + w610 * w1006 + w28 * w960 + w616 * w961;
            const double w1008 = w2 * w1007;
            const double w1009 = w440 * w647;
            const double w1010 = w567 - g20 * w999 + w568;
            const double w1011 = w100 * w1010 + w634 * w998 + w635 * w1000 + w113 * w945 + w628 * w946;
            const double w1012 = w113 * w942 + w628 * w943 + w3 * w1011;
            const double w1013 = w653 * w998 - w99 * w1010 + w654 * w1000 + w108 * w944 - a_2_2 * w946;
            const double w1014 = w108 * w941 - a_2_2 * w943 + w3 * w1013;
            const double w1015 = 2.0 * X1_2;
            const double w1016 = w3 * w1015;
            const double w1017 = w607 - g20 * w1005 + w608;
            const double w1018 = w51 * w1017 + w724 * w1004 + w725 * w1006 + w112 * w961 + w726 * w962;
            const double w1019 = w2 * w1018;
            const double w1020 = w1003 + w627 * w1008 + w1009 + w649 * w1012 + w667 * w1014
                + w718 * w1016 + w736 * w1019;
            const double w1021 = w741 * w1004 - w50 * w1017 + w742 * w1006 + w104 * w960 - a_6_2 * w962;
            const double w1022 = w2 * w1021;
            const double w1023 = 2.0 * X2_2;
            const double w1024 = w2 * w1023;
            const double w1025 = w52 * w317;
            const double w1026 = w52 * w327;
            const double w1027 = w52 * w336;
            const double w1028 = w265 + w3 * w274 + w52 * w282 - w286 * w1025 + w320 * w1026
                + w330 * w1027;
            const double w1029 = w52 * w346;
            const double w1030 = w52 * w353;
            const double w1031 = w52 * w364;
            const double w1032 = X2_2 * w380 - X2_1 * w379;
            const double w1033 = X2_2 * w17;
            const double w1034 = X2_1 * w385 + w1033;
            const double w1035 = X2_2 * w392;
            const double w1036 = 1.0 - X2_1 * w391 - w1035;
            const double w1037 = w377 * w1032 + w383 * w1034 + w390 * w1036 + w3 * w395;
            const double w1038 = w400 * w1032 + w403 * w1034 + w404 * w1036 + w3 * w405;
            const double w1039 = w1028 + w342 * w1029 + w350 * w1030 + w357 * w1031 - w369 * w1037
                + w398 * w1038;
            const double w1040 = w412 * w1032 + w413 * w1034 + w414 * w1036 + w3 * w415;
            const double w1041 = X2_1 * w15;
            const double w1042 = w1041 + X2_2 * w422 + w3 * w423;
            const double w1043 = X2_2 * w15;
            const double w1044 = X2_1 * w422 - w1043 + w3 * w429;
            const double w1045 = X2_1 * w434;
            const double w1046 = X2_2 * w436;
            const double w1047 = 1.0 - w1045 - w1046 + w3 * w438;
            const double w1048 = w1039 + w409 * w1040 + w420 * w1042 + w427 * w1044 + w433 * w1047
                + w441;
            const double w1049 = w449 - w3 * w455 - w52 * w461 + w463 * w1025 - w466 * w1026
                + w468 * w1027;
            const double w1050 = w1049 + w471 * w1029 + w474 * w1030 + w477 * w1031 + w479 * w1037
                - w482 * w1038;
            const double w1051 = w1050 + w485 * w1040 + w487 * w1042 + w490 * w1044 + w493 * w1047
                - w495;
            const double w1052 = w503 + w3 * w511 + w52 * w519 + w521 * w1025 + w523 * w1026
                - w525 * w1027;
            const double w1053 = w1052 + w528 * w1029 + w530 * w1030 + w532 * w1031 + w534 * w1037
                + w536 * w1038;
            const double w1054 = w1053 - w539 * w1040 + w541 * w1042 + w543 * w1044 + w545 * w1047
                + w547;
            const double w1055 = w52 * w576;
            const double w1056 = w52 * w251 + w259 * w1048 + w446 * w1051 + w501 * w1054 + w552
                + w592 * w1055;
            const double w1057 = w28 * w1032 + w616 * w1034 + w3 * w617;
            const double w1058 = w52 * w636;
            const double w1059 = w52 * w655;
            const double w1060 = w52 * w668;
            const double w1061 = w112 * w1034 + w726 * w1036 + w3 * w727;
            const double w1062 = w1056 + w627 * w1057 + w649 * w1058 + w667 * w1059 + w718 * w1060
                + w736 * w1061;
            const double w1063 = w104 * w1032 - a_6_2 * w1036 + w3 * w743;
            const double w1064 = w3 * w752;
            const double w1065 = w52 * w823;
            const double w1066 = w52 * w826;
            const double w1067 = w52 * w828;
            const double w1068 = w804 - w3 * w809 - w52 * w814 - w286 * w1065 + w320 * w1066
                + w330 * w1067;
            const double w1069 = w52 * w833;
            const double w1070 = w52 * w837;
            const double w1071 = w52 * w839;
            const double w1072 = X2_0 * w379 + X2_2 * w841;
            const double w1073 = 1.0 - X2_0 * w385 - w1035;
            const double w1074 = X2_0 * w391 - w1033;
            const double w1075 = w377 * w1072 + w383 * w1073 + w390 * w1074 + w3 * w846;
            const double w1076 = w400 * w1072 + w403 * w1073 + w404 * w1074 + w3 * w849;
            const double w1077 = w1068 + w342 * w1069 + w350 * w1070 + w357 * w1071 - w369 * w1075
                + w398 * w1076;
            const double w1078 = w412 * w1072 + w413 * w1073 + w414 * w1074 + w3 * w852;
            const double w1079 = X2_0 * w15;
            const double w1080 = X2_2 * w434 - w1079 + w3 * w855;
            const double w1081 = 1.0 - X2_0 * w422;
            const double w1082 = w1081 - w1046 + w3 * w858;
            const double w1083 = w1043 + X2_0 * w434 + w3 * w860;
            const double w1084 = w1077 + w409 * w1078 + w420 * w1080 + w427 * w1082 + w433 * w1083
                - w863;
            const double w1085 = w865 + w3 * w871 + w52 * w877 + w463 * w1065 - w466 * w1066
                + w468 * w1067;
            const double w1086 = w1085 + w471 * w1069 + w474 * w1070 + w477 * w1071 + w479 * w1075
                - w482 * w1076;
            const double w1087 = w1086 + w485 * w1078 + w487 * w1080 + w490 * w1082 + w493 * w1083
                + w880;
            const double w1088 = w882 + w3 * w885 + w52 * w888 + w521 * w1065 + w523 * w1066
                - w525 * w1067;
            const double w1089 = w1088 + w528 * w1069 + w530 * w1070 + w532 * w1071 + w534 * w1075
                + w536 * w1076;
            const double w1090 = w1089 - w539 * w1078 + w541 * w1080 + w543 * w1082 + w545 * w1083
                - w891;
            const double w1091 = w52 * w898;
            const double w1092 = w28 * w1072 + w616 * w1073 + w3 * w905;
            const double w1093 = w52 * w801 + w259 * w1084 + w446 * w1087 + w501 * w1090 + w592 * w1091
                + w627 * w1092;
            const double w1094 = w52 * w910;
            const double w1095 = w52 * w912;
            const double w1096 = w52 * w914;
            const double w1097 = w112 * w1073 + w726 * w1074 + w3 * w917;
            const double w1098 = w104 * w1072 - a_6_2 * w1074 + w3 * w919;
            const double w1099 = w1093 - w908 + w649 * w1094 + w667 * w1095 + w718 * w1096
                + w736 * w1097 + w751 * w1098;
            const double w1100 = w3 * w922;
            const double w1101 = w52 * w947;
            const double w1102 = w52 * w949;
            const double w1103 = w52 * w951;
            const double w1104 = w930 + w3 * w935 + w52 * w940 - w286 * w1101 + w320 * w1102
                + w330 * w1103;
            const double w1105 = w52 * w954;
            const double w1106 = w52 * w956;
            const double w1107 = w52 * w958;
            const double w1108 = 0.01 - X2_0 * w380 - X2_1 * w841;
            const double w1109 = X2_1 * w392 - X2_0 * w17;
            const double w1110 = X2_0 * w392 + X2_1 * w17;
            const double w1111 = w377 * w1108 + w383 * w1109 + w390 * w1110 + w3 * w963;
            const double w1112 = w400 * w1108 + w403 * w1109 + w404 * w1110 + w3 * w965;
            const double w1113 = w1104 + w342 * w1105 + w350 * w1106 + w357 * w1107 - w369 * w1111
                + w398 * w1112;
            const double w1114 = w412 * w1108 + w413 * w1109 + w414 * w1110 + w3 * w968;
            const double w1115 = w1081 - w1045 + w3 * w970;
            const double w1116 = w1079 + X2_1 * w436 + w3 * w972;
            const double w1117 = X2_0 * w436 - w1041 + w3 * w974;
            const double w1118 = w1113 + w409 * w1114 + w420 * w1115 + w427 * w1116 + w433 * w1117;
            const double w1119 = w977 + w3 * w980 + w52 * w983 + w463 * w1101 - w466 * w1102
                + w468 * w1103;
            const double w1120 = w1119 + w471 * w1105 + w474 * w1106 + w477 * w1107 + w479 * w1111
                - w482 * w1112;
            const double w1121 = w1120 + w485 * w1114 + w487 * w1115 + w490 * w1116 + w493 * w1117;
            const double w1122 = w987 + w3 * w990 + w52 * w993 + w521 * w1101 + w523 * w1102
                - w525 * w1103;
            const double w1123 = w1122 + w528 * w1105 + w530 * w1106 + w532 * w1107 + w534 * w1111
                + w536 * w1112;
            const double w1124 = w1123 - w539 * w1114 + w541 * w1115 + w543 * w1116 + w545 * w1117;
            const double w1125 = w52 * w1001;
            const double w1126 = w52 * w928 + w259 * w1118 + w446 * w1121 + w501 * w1124 - w997
                + w592 * w1125;
            const double w1127 = w28 * w1108 + w616 * w1109 + w3 * w1007;
            const double w1128 = w52 * w1011;
            const double w1129 = w52 * w1013;
            const double w1130 = w52 * w1015;
            const double w1131 = w112 * w1109 + w726 * w1110 + w3 * w1018;
            const double w1132 = w1126 + w627 * w1127 + w1009 + w649 * w1128 + w667 * w1129
                + w718 * w1130 + w736 * w1131;
            const double w1133 = w104 * w1108 - a_6_2 * w1110 + w3 * w1021;
            const double w1134 = w3 * w1023;
            const double w1135 = X1_0 * w172;
            const double w1136 = w257 - w1135;
            const double w1137 = w246 - w499;
            const double w1138 = w204 * w233 + Pxi1_1 * w248 - w797 + w240 * w1136 + w245 * w1137
                + w250 * w445;
            const double w1139 = w253 * w1136 + w255 * w1137 + w258 * w445;
            const double w1140 = w443 * w1136 + w444 * w1137 + w445 * w445;
            const double w1141 = w497 * w1136 + w498 * w1137 + w445 * w500;
            const double w1142 = w550 * w1141 - (w494 * w1139 + w102 * w1140);
            const double w1143 = w549 * w1142;
            const double w1144 = w590 * w1142;
            const double w1145 = w581 * w1139 + w584 * w1140 + w589 * w1141 - w1144;
            const double w1146 = w3 * w1138 + w442 * w1139 + w496 * w1140 + w548 * w1141 + w1143
                + w577 * w1145;
            const double w1147 = w620 * w1139 + w622 * w1140 + w626 * w1141 - w1144;
            const double w1148 = w645 * w1142;
            const double w1149 = w546 * w1139 - w550 * w1140 - w102 * w1141;
            const double w1150 = w579 * w1149;
            const double w1151 = w642 * w1140 + w640 * w1139 + w644 * w1141 + w1148 - w1150;
            const double w1152 = w590 * w1149;
            const double w1153 = w659 * w1139 + w662 * w1140 + w665 * w1141 + w1152;
            const double w1154 = w207 * w672 + w205 * w674 + w675 * w1136 + w676 * w1137 + w445 * w677
                + w700 * w1139;
            const double w1155 = w1154 + w704 * w1140 + w707 * w1141 + w711 * w1145 + w715 * w1151
                + w717 * w1153;
            const double w1156 = w733 * w1140 + w731 * w1139 + w735 * w1141 + w1148 - w1150;
            const double w1157 = w1146 + w618 * w1147 + w637 * w1151 + w656 * w1153 + w669 * w1155
                + w728 * w1156;
            const double w1158 = w746 * w1139 + w748 * w1140 + w750 * w1141 + w1152;
            const double w1159 = w779 * w1139 + w782 * w1140 + w785 * w1141 + w789 * w1147
                + w793 * w1156 + w795 * w1158;
            const double w1160 = Wxi1_2 * w256 - Wxi1_0 * w248 - w798 * w1136 + w799 * w1137
                + w445 * w800;
            const double w1161 = w3 * w1160 + w864 * w1139 + w881 * w1140 + w892 * w1141 + w899 * w1145
                + w906 * w1147;
            const double w1162 = w549 * w1149;
            const double w1163 = w1161 - w1162 + w911 * w1151 + w913 * w1153 + w915 * w1155
                + w918 * w1156 + w920 * w1158;
            const double w1164 = w172 * Wxi1_0;
            const double w1165 = w195 * w203 + w1164 - Pxi1_1 * w256 + w925 * w1136 - w926 * w1137
                + w445 * w927;
            const double w1166 = w862 * w1142;
            const double w1167 = w3 * w1165 + w976 * w1139 + w986 * w1140 + w996 * w1141 - w1166
                + w1002 * w1145;
            const double w1168 = w440 * w1149;
            const double w1169 = w1167 + w1008 * w1147 + w1168 + w1012 * w1151 + w1014 * w1153
                + w1016 * w1155 + w1019 * w1156;
            const double w1170 = w52 * w1138 + w1048 * w1139 + w1051 * w1140 + w1054 * w1141 + w1143
                + w1055 * w1145;
            const double w1171 = w1170 + w1057 * w1147 + w1058 * w1151 + w1059 * w1153 + w1060 * w1155
                + w1061 * w1156;
            const double w1172 = w52 * w1160 + w1084 * w1139 + w1087 * w1140 + w1090 * w1141
                + w1091 * w1145 + w1092 * w1147;
            const double w1173 = w1172 - w1162 + w1094 * w1151 + w1095 * w1153 + w1096 * w1155
                + w1097 * w1156 + w1098 * w1158;
            const double w1174 = w52 * w1165 + w1118 * w1139 + w1121 * w1140 + w1124 * w1141 - w1166
                + w1125 * w1145;
            const double w1175 = w1174 + w1127 * w1147 + w1168 + w1128 * w1151 + w1129 * w1153
                + w1130 * w1155 + w1131 * w1156;
            const double w1176 = X1_0 * w195;
            const double w1177 = X1_1 * w233;
            const double w1178 = 1.0 - X1_0 * w1176 + X1_1 * w1177;
            const double w1179 = X1_2 * w1176 - w235;
            const double w1180 = w1135 - X1_2 * w1177;
            const double w1181 = w924 + w195 * w205 - Wxi1_2 * w1176 + w240 * w1178 + w245 * w1179
                + w250 * w1180;
            const double w1182 = w253 * w1178 + w255 * w1179 + w258 * w1180;
            const double w1183 = w443 * w1178 + w444 * w1179 + w445 * w1180;
            const double w1184 = w497 * w1178 + w498 * w1179 + w500 * w1180;
            const double w1185 = w550 * w1184 - (w494 * w1182 + w102 * w1183);
            const double w1186 = w549 * w1185;
            const double w1187 = w590 * w1185;
            const double w1188 = w581 * w1182 + w584 * w1183 + w589 * w1184 - w1187;
            const double w1189 = w3 * w1181 + w442 * w1182 + w496 * w1183 + w548 * w1184 + w1186
                + w577 * w1188;
            const double w1190 = w620 * w1182 + w622 * w1183 + w626 * w1184 - w1187;
            const double w1191 = w645 * w1185;
            const double w1192 = w546 * w1182 - w550 * w1183 - w102 * w1184;
            const double w1193 = w579 * w1192;
            const double w1194 = w642 * w1183 + w640 * w1182 + w644 * w1184 + w1191 - w1193;
            const double w1195 = w590 * w1192;
            const double w1196 = w659 * w1182 + w662 * w1183 + w665 * w1184 + w1195;
            const double w1197 = w208 * w672 + w204 * w674 + w675 * w1178 + w676 * w1179 + w677 * w1180
                + w700 * w1182;
            const double w1198 = w1197 + w704 * w1183 + w707 * w1184 + w711 * w1188 + w715 * w1194
                + w717 * w1196;
            const double w1199 = w733 * w1183 + w731 * w1182 + w735 * w1184 + w1191 - w1193;
            const double w1200 = w1189 + w618 * w1190 + w637 * w1194 + w656 * w1196 + w669 * w1198
                + w728 * w1199;
            const double w1201 = w746 * w1182 + w748 * w1183 + w750 * w1184 + w1195;
            const double w1202 = w779 * w1182 + w782 * w1183 + w785 * w1184 + w789 * w1190
                + w793 * w1199 + w795 * w1201;
            const double w1203 = w203 * w233 - w1164 + Wxi1_2 * w1177 - w798 * w1178 + w799 * w1179
                + w800 * w1180;
            const double w1204 = w3 * w1203 + w864 * w1182 + w881 * w1183 + w892 * w1184 + w899 * w1188
                + w906 * w1190;
            const double w1205 = w549 * w1192;
            const double w1206 = w1204 - w1205 + w911 * w1194 + w913 * w1196 + w915 * w1198
                + w918 * w1199 + w920 * w1201;
            const double w1207 = Wxi1_0 * w1176 - Pxi1_1 * w1177 + w925 * w1178 - w926 * w1179
                + w927 * w1180;
            const double w1208 = w862 * w1185;
            const double w1209 = w3 * w1207 + w976 * w1182 + w986 * w1183 + w996 * w1184 - w1208
                + w1002 * w1188;
            const double w1210 = w440 * w1192;
            const double w1211 = w1209 + w1008 * w1190 + w1210 + w1012 * w1194 + w1014 * w1196
                + w1016 * w1198 + w1019 * w1199;
            const double w1212 = w52 * w1181 + w1048 * w1182 + w1051 * w1183 + w1054 * w1184 + w1186
                + w1055 * w1188;
            const double w1213 = w1212 + w1057 * w1190 + w1058 * w1194 + w1059 * w1196 + w1060 * w1198
                + w1061 * w1199;
            const double w1214 = w52 * w1203 + w1084 * w1182 + w1087 * w1183 + w1090 * w1184
                + w1091 * w1188 + w1092 * w1190;
            const double w1215 = w1214 - w1205 + w1094 * w1194 + w1095 * w1196 + w1096 * w1198
                + w1097 * w1199 + w1098 * w1201;
            const double w1216 = w52 * w1207 + w1118 * w1182 + w1121 * w1183 + w1124 * w1184 - w1208
                + w1125 * w1188;
            const double w1217 = w1216 + w1127 * w1190 + w1210 + w1128 * w1194 + w1129 * w1196
                + w1130 * w1198 + w1131 * w1199;
            const double w1218 = X2_1 * w218;
            const double w1219 = w217 - w215;
            const double w1220 = X2_2 * w1219;
            const double w1221 = X2_1 * w213;
            const double w1222 = w1221 - X2_0 * w1220;
            const double w1223 = 100.0 * w218;
            const double w1224 = -100.0 * w213;
            const double w1225 = X2_0 * w1223;
            const double w1226 = w222 * w1223 + w2_1 * w1224 - w2_2 * w1225;
            const double w1227 = 1.0 - X2_1 * w1218 + X2_2 * w1220;
            const double w1228 = 0.9900990099009901 * w218;
            const double w1229 = X2_1 * w1228;
            const double w1230 = X2_2 * w1228;
            const double w1231 = w2_1 * w1229 + w2_2 * w1230;
            const double w1232 = X2_2 * w213;
            const double w1233 = X2_0 * w1218 - w1232;
            const double w1234 = X2_0 * w1219;
            const double w1235 = w212 - w210;
            const double w1236 = w219 * w1219 + w2_1 * w1234 - w2_2 * w1235;
            const double w1237 = Pxi2_1 * w1218 - Wxi2_2 * w1220 + w1222 * w1226 + w1227 * w1231
                + w1233 * w1236;
            const double w1238 = X2_1 * w1223;
            const double w1239 = 100.0 - X2_0 * w1225 - X2_1 * w1238;
            const double w1240 = -0.9900990099009901 * w213;
            const double w1241 = X2_0 * w1230 + X2_1 * w1240;
            const double w1242 = X2_2 * w218;
            const double w1243 = X2_1 * w1242;
            const double w1244 = w1243 - X2_0 * w1235;
            const double w1245 = w1222 * w1239 + w1227 * w1241 + w1233 * w1244;
            const double w1246 = w1 * w273 + w269 * w275;
            const double w1247 = 0.03867513459481288 * h;
            const double w1248 = -0.07735026918962576 * h;
            const double w1249 = w278 * w1247 + w281 * w1248;
            const double w1250 = w285 * w1248;
            const double w1251 = w319 * w1248;
            const double w1252 = w329 * w1248;
            const double w1253 = w265 + w2 * w1246 + w3 * w1249 - w318 * w1250 + w328 * w1251
                + w337 * w1252;
            const double w1254 = w341 * w1248;
            const double w1255 = w349 * w1248;
            const double w1256 = w356 * w1248;
            const double w1257 = w1 * w368;
            const double w1258 = w1 * w397;
            const double w1259 = w1253 + w347 * w1254 + w354 * w1255 + w365 * w1256 - w396 * w1257
                + w406 * w1258;
            const double w1260 = w1 * w408;
            const double w1261 = w1 * w419;
            const double w1262 = w1 * w426;
            const double w1263 = w1 * w432;
            const double w1264 = w1259 + w416 * w1260 + w424 * w1261 + w430 * w1262 + w439 * w1263
                + w441;
            const double w1265 = X2_0 * w1224 + X2_2 * w1238;
            const double w1266 = X2_0 * w1229 - X2_2 * w1240;
            const double w1267 = 1.0 + X2_0 * w1234 - X2_2 * w1242;
            const double w1268 = w1222 * w1265 + w1227 * w1266 + w1233 * w1267;
            const double w1269 = w275 * w452 + w1 * w454;
            const double w1270 = w458 * w1247 + w460 * w1248;
            const double w1271 = w462 * w1248;
            const double w1272 = w465 * w1248;
            const double w1273 = w467 * w1248;
            const double w1274 = w449 - w2 * w1269 - w3 * w1270 + w318 * w1271 - w328 * w1272
                + w337 * w1273;
            const double w1275 = w470 * w1248;
            const double w1276 = w473 * w1248;
            const double w1277 = w476 * w1248;
            const double w1278 = w1 * w478;
            const double w1279 = w1 * w481;
            const double w1280 = w1274 + w347 * w1275 + w354 * w1276 + w365 * w1277 + w396 * w1278
                - w406 * w1279;
            const double w1281 = w1 * w484;
            const double w1282 = w1 * w486;
            const double w1283 = w1 * w489;
            const double w1284 = w1 * w492;
            const double w1285 = w1280 + w416 * w1281 + w424 * w1282 + w430 * w1283 + w439 * w1284
                - w495;
            const double w1286 = X2_2 * w1225 - X2_1 * w1224;
            const double w1287 = 0.9900990099009901 - X2_1 * w1229 - X2_2 * w1230;
            const double w1288 = X2_1 * w1234;
            const double w1289 = X2_2 * w1235 - w1288;
            const double w1290 = w1222 * w1286 + w1227 * w1287 + w1233 * w1289;
            const double w1291 = w275 * w507 + w1 * w510;
            const double w1292 = w515 * w1247 + w518 * w1248;
            const double w1293 = w520 * w1248;
            const double w1294 = w522 * w1248;
            const double w1295 = w524 * w1248;
            const double w1296 = w503 + w2 * w1291 + w3 * w1292 + w318 * w1293 + w328 * w1294
                - w337 * w1295;
            const double w1297 = w527 * w1248;
            const double w1298 = w529 * w1248;
            const double w1299 = w531 * w1248;
            const double w1300 = w1 * w533;
            const double w1301 = w1 * w535;
            const double w1302 = w1296 + w347 * w1297 + w354 * w1298 + w365 * w1299 + w396 * w1300
                + w406 * w1301;
            const double w1303 = w1 * w538;
            const double w1304 = w1 * w540;
            const double w1305 = w1 * w542;
            const double w1306 = w1 * w544;
            const double w1307 = w1302 - w416 * w1303 + w424 * w1304 + w430 * w1305 + w439 * w1306
                + w547;
            const double w1308 = w550 * w1290 - (w494 * w1245 + w102 * w1268);
            const double w1309 = w549 * w1308;
            const double w1310 = w578 * w1247 - w580;
            const double w1311 = w583 + w582 * w1247;
            const double w1312 = w1 + w587 * w1247 - w588;
            const double w1313 = w590 * w1308;
            const double w1314 = w1245 * w1310 + w1268 * w1311 + w1290 * w1312 - w1313;
            const double w1315 = w2 * w1237 + w1245 * w1264 + w1268 * w1285 + w1290 * w1307 + w1309
                + w577 * w1314;
            const double w1316 = w275 * w619 - w580;
            const double w1317 = w583 + w275 * w621;
            const double w1318 = w1 + w275 * w625 - w588;
            const double w1319 = w1245 * w1316 + w1268 * w1317 + w1290 * w1318 - w1313;
            const double w1320 = w1 + w639 * w1247;
            const double w1321 = w641 * w1247;
            const double w1322 = w643 * w1247;
            const double w1323 = w645 * w1308;
            const double w1324 = w546 * w1245 - w550 * w1268 - w102 * w1290;
            const double w1325 = w579 * w1324;
            const double w1326 = w1245 * w1320 + w1268 * w1321 + w1290 * w1322 + w1323 - w1325;
            const double w1327 = w658 + w657 * w1247;
            const double w1328 = w1 + w660 * w1247 - w661;
            const double w1329 = w664 + w663 * w1247;
            const double w1330 = w590 * w1324;
            const double w1331 = w1245 * w1327 + w1268 * w1328 + w1290 * w1329 + w1330;
            const double w1332 = w679 * w1247 - w691 * w1250 + w692 * w1251 + w693 * w1252
                + w694 * w1254 + w696 * w1255;
            const double w1333 = w1332 + w699 * w1256;
            const double w1334 = w702 * w1247 + w691 * w1271 - w692 * w1272 + w693 * w1273
                + w694 * w1275 + w696 * w1276;
            const double w1335 = w1334 + w699 * w1277;
            const double w1336 = w705 * w1247 + w691 * w1293 + w692 * w1294 - w693 * w1295
                + w694 * w1297 + w696 * w1298;
            const double w1337 = w1336 + w699 * w1299;
            const double w1338 = w1245 * w1333 + w1268 * w1335 + w1290 * w1337 + w711 * w1314
                + w715 * w1326 + w717 * w1331;
            const double w1339 = w1 + w275 * w730;
            const double w1340 = w275 * w732;
            const double w1341 = w275 * w734;
            const double w1342 = w1245 * w1339 + w1268 * w1340 + w1290 * w1341 + w1323 - w1325;
            const double w1343 = w1315 + w618 * w1319 + w637 * w1326 + w656 * w1331 + w669 * w1338
                + w728 * w1342;
            const double w1344 = w658 + w275 * w745;
            const double w1345 = w1 + w275 * w747 - w661;
            const double w1346 = w664 + w275 * w749;
            const double w1347 = w1245 * w1344 + w1268 * w1345 + w1290 * w1346 + w1330;
            const double w1348 = -0.25 * w762 - w216 + w10 * w755;
            const double w1349 = w763 * (1.0 - 0.08333333333333333 * w8) - w211 + 0.5 * w8 * w755;
            const double w1350 = 100.0 * w224 * w1348 - 100.0 * w219 * w1349;
            const double w1351 = 0.9900990099009901 * w223 * w1348 - 0.9900990099009901 * w214 * w1349;
            const double w1352 = w225 * w1348 + w1349 * (w221 - w220);
            const double w1353 = w275 * w756 - w770 * w1257 + w771 * w1258 + w772 * w1260 + w773 * w1261
                + w775 * w1262;
            const double w1354 = w1353 + w778 * w1263;
            const double w1355 = w229 * w1348 + w226 * w1349 + w1222 * w1350 + w1227 * w1351
                + w1233 * w1352 + w1245 * w1354;
            const double w1356 = w275 * w780 + w770 * w1278 - w771 * w1279 + w772 * w1281 + w773 * w1282
                + w775 * w1283;
            const double w1357 = w1356 + w778 * w1284;
            const double w1358 = w275 * w783 + w770 * w1300 + w771 * w1301 - w772 * w1303 + w773 * w1304
                + w775 * w1305;
            const double w1359 = w1358 + w778 * w1306;
            const double w1360 = w1355 + w1268 * w1357 + w1290 * w1359 + w789 * w1319 + w793 * w1342
                + w795 * w1347;
            const double w1361 = w213 * Wxi2_2;
            const double w1362 = w214 * w1223 + w2_0 * w1224 + w2_2 * w1238;
            const double w1363 = w219 * w1228 - w2_0 * w1229 + w2_2 * w1240;
            const double w1364 = w2_2 * w1242 - w2_0 * w1234;
            const double w1365 = w218 * w227 - Wxi2_0 * w1218 + w1361 - w1222 * w1362 + w1227 * w1363
                + w1233 * w1364;
            const double w1366 = w275 * w806 + w1 * w808;
            const double w1367 = w811 * w1247 + w813 * w1248;
            const double w1368 = w804 - w2 * w1366 - w3 * w1367 - w824 * w1250 + w827 * w1251
                + w829 * w1252;
            const double w1369 = w1368 + w834 * w1254 + w838 * w1255 + w840 * w1256 - w847 * w1257
                + w850 * w1258;
            const double w1370 = w1369 + w853 * w1260 + w856 * w1261 + w859 * w1262 + w861 * w1263
                - w863;
            const double w1371 = w275 * w867 + w1 * w870;
            const double w1372 = w873 * w1247 + w876 * w1248;
            const double w1373 = w865 + w2 * w1371 + w3 * w1372 + w824 * w1271 - w827 * w1272
                + w829 * w1273;
            const double w1374 = w1373 + w834 * w1275 + w838 * w1276 + w840 * w1277 + w847 * w1278
                - w850 * w1279;
            const double w1375 = w1374 + w853 * w1281 + w856 * w1282 + w859 * w1283 + w861 * w1284
                + w880;
            const double w1376 = w275 * w883 + w1 * w884;
            const double w1377 = w886 * w1247 + w887 * w1248;
            const double w1378 = w882 + w2 * w1376 + w3 * w1377 + w824 * w1293 + w827 * w1294
                - w829 * w1295;
            const double w1379 = w1378 + w834 * w1297 + w838 * w1298 + w840 * w1299 + w847 * w1300
                + w850 * w1301;
            const double w1380 = w1379 - w853 * w1303 + w856 * w1304 + w859 * w1305 + w861 * w1306
                - w891;
            const double w1381 = w2 * w1365 + w1245 * w1370 + w1268 * w1375 + w1290 * w1380
                + w899 * w1314 + w906 * w1319;
            const double w1382 = w549 * w1324;
            const double w1383 = w1381 - w1382 + w911 * w1326 + w913 * w1331 + w915 * w1338
                + w918 * w1342 + w920 * w1347;
            const double w1384 = w213 * Pxi2_1;
            const double w1385 = w2_0 * w1225 + w2_1 * w1238;
            const double w1386 = w222 * w1228 + w2_0 * w1230 + w2_1 * w1240;
            const double w1387 = w2_0 * w1235 + w214 * w218 - w2_1 * w1242;
            const double w1388 = w228 * w1219 + Wxi2_0 * w1220 - w1384 + w1222 * w1385 - w1227 * w1386
                + w1233 * w1387;
            const double w1389 = w275 * w932 + w1 * w934;
            const double w1390 = w937 * w1247 + w939 * w1248;
            const double w1391 = w930 + w2 * w1389 + w3 * w1390 - w948 * w1250 + w950 * w1251
                + w952 * w1252;
            const double w1392 = w1391 + w955 * w1254 + w957 * w1255 + w959 * w1256 - w964 * w1257
                + w966 * w1258;
            const double w1393 = w1392 + w969 * w1260 + w971 * w1261 + w973 * w1262 + w975 * w1263;
            const double w1394 = w275 * w978 + w1 * w979;
            const double w1395 = w981 * w1247 + w982 * w1248;
            const double w1396 = w977 + w2 * w1394 + w3 * w1395 + w948 * w1271 - w950 * w1272
                + w952 * w1273;
            const double w1397 = w1396 + w955 * w1275 + w957 * w1276 + w959 * w1277 + w964 * w1278
                - w966 * w1279;
            const double w1398 = w1397 + w969 * w1281 + w971 * w1282 + w973 * w1283 + w975 * w1284;
            const double w1399 = w275 * w988 - w1 * w989;
            const double w1400 = w991 * w1247 - w992 * w1248;
            const double w1401 = w987 + w2 * w1399 + w3 * w1400 + w948 * w1293 + w950 * w1294
                - w952 * w1295;
            const double w1402 = w1401 + w955 * w1297 + w957 * w1298 + w959 * w1299 + w964 * w1300
                + w966 * w1301;
            const double w1403 = w1402 - w969 * w1303 + w971 * w1304 + w973 * w1305 + w975 * w1306;
            const double w1404 = w862 * w1308;
            const double w1405 = w2 * w1388 + w1245 * w1393 + w1268 * w1398 + w1290 * w1403 - w1404
                + w1002 * w1314;
            const double w1406 = w440 * w1324;
            const double w1407 = w1405 + w1008 * w1319 + w1406 + w1012 * w1326 + w1014 * w1331
                + w1016 * w1338 + w1019 * w1342;
            const double w1408 = w265 + w3 * w1246 + w52 * w1249 - w1025 * w1250 + w1026 * w1251
                + w1027 * w1252;
            const double w1409 = w1408 + w1029 * w1254 + w1030 * w1255 + w1031 * w1256 - w1037 * w1257
                + w1038 * w1258;
            const double w1410 = w1409 + w1040 * w1260 + w1042 * w1261 + w1044 * w1262 + w1047 * w1263
                + w441;
            const double w1411 = w449 - w3 * w1269 - w52 * w1270 + w1025 * w1271 - w1026 * w1272
                + w1027 * w1273;
            const double w1412 = w1411 + w1029 * w1275 + w1030 * w1276 + w1031 * w1277 + w1037 * w1278
                - w1038 * w1279;
            const double w1413 = w1412 + w1040 * w1281 + w1042 * w1282 + w1044 * w1283 + w1047 * w1284
                - w495;
            const double w1414 = w503 + w3 * w1291 + w52 * w1292 + w1025 * w1293 + w1026 * w1294
                - w1027 * w1295;
            const double w1415 = w1414 + w1029 * w1297 + w1030 * w1298 + w1031 * w1299 + w1037 * w1300
                + w1038 * w1301;
            const double w1416 = w1415 - w1040 * w1303 + w1042 * w1304 + w1044 * w1305 + w1047 * w1306
                + w547;
            const double w1417 = w3 * w1237 + w1245 * w1410 + w1268 * w1413 + w1290 * w1416 + w1309
                + w1055 * w1314;
            const double w1418 = w1417 + w1057 * w1319 + w1058 * w1326 + w1059 * w1331 + w1060 * w1338
                + w1061 * w1342;
            const double w1419 = w804 - w3 * w1366 - w52 * w1367 - w1065 * w1250 + w1066 * w1251
                + w1067 * w1252;
            const double w1420 = w1419 + w1069 * w1254 + w1070 * w1255 + w1071 * w1256 - w1075 * w1257
                + w1076 * w1258;
            const double w1421 = w1420 + w1078 * w1260 + w1080 * w1261 + w1082 * w1262 + w1083 * w1263
                - w863;
            const double w1422 = w865 + w3 * w1371 + w52 * w1372 + w1065 * w1271 - w1066 * w1272
                + w1067 * w1273;
            const double w1423 = w1422 + w1069 * w1275 + w1070 * w1276 + w1071 * w1277 + w1075 * w1278
                - w1076 * w1279;
            const double w1424 = w1423 + w1078 * w1281 + w1080 * w1282 + w1082 * w1283 + w1083 * w1284
                + w880;
            const double w1425 = w882 + w3 * w1376 + w52 * w1377 + w1065 * w1293 + w1066 * w1294
                - w1067 * w1295;
            const double w1426 = w1425 + w1069 * w1297 + w1070 * w1298 + w1071 * w1299 + w1075 * w1300
                + w1076 * w1301;
            const double w1427 = w1426 - w1078 * w1303 + w1080 * w1304 + w1082 * w1305 + w1083 * w1306
                - w891;
            const double w1428 = w3 * w1365 + w1245 * w1421 + w1268 * w1424 + w1290 * w1427
                + w1091 * w1314 + w1092 * w1319;
            const double w1429 = w1428 - w1382 + w1094 * w1326 + w1095 * w1331 + w1096 * w1338
                + w1097 * w1342 + w1098 * w1347;
            const double w1430 = w930 + w3 * w1389 + w52 * w1390 - w1101 * w1250 + w1102 * w1251
                + w1103 * w1252;
            const double w1431 = w1430 + w1105 * w1254 + w1106 * w1255 + w1107 * w1256 - w1111 * w1257
                + w1112 * w1258;
            const double w1432 = w1431 + w1114 * w1260 + w1115 * w1261 + w1116 * w1262 + w1117 * w1263;
            const double w1433 = w977 + w3 * w1394 + w52 * w1395 + w1101 * w1271 - w1102 * w1272
                + w1103 * w1273;
            const double w1434 = w1433 + w1105 * w1275 + w1106 * w1276 + w1107 * w1277 + w1111 * w1278
                - w1112 * w1279;
            const double w1435 = w1434 + w1114 * w1281 + w1115 * w1282 + w1116 * w1283 + w1117 * w1284;
            const double w1436 = w987 + w3 * w1399 + w52 * w1400 + w1101 * w1293 + w1102 * w1294
                - w1103 * w1295;
            const double w1437 = w1436 + w1105 * w1297 + w1106 * w1298 + w1107 * w1299 + w1111 * w1300
                + w1112 * w1301;
            const double w1438 = w1437 - w1114 * w1303 + w1115 * w1304 + w1116 * w1305 + w1117 * w1306;
            const double w1439 = w3 * w1388 + w1245 * w1432 + w1268 * w1435 + w1290 * w1438 - w1404
                + w1125 * w1314;
            const double w1440 = w1439 + w1127 * w1319 + w1406 + w1128 * w1326 + w1129 * w1331
                + w1130 * w1338 + w1131 * w1342;
            const double w1441 = X2_0 * w213;
            const double w1442 = w1243 - w1441;
            const double w1443 = w1232 - w1288;
            const double w1444 = w227 * w1219 + Pxi2_1 * w1234 - w1361 + w1226 * w1442 + w1231 * w1443
                + w1236 * w1267;
            const double w1445 = w1239 * w1442 + w1241 * w1443 + w1244 * w1267;
            const double w1446 = w1265 * w1442 + w1266 * w1443 + w1267 * w1267;
            const double w1447 = w1286 * w1442 + w1287 * w1443 + w1267 * w1289;
            const double w1448 = w550 * w1447 - (w494 * w1445 + w102 * w1446);
            const double w1449 = w549 * w1448;
            const double w1450 = w590 * w1448;
            const double w1451 = w1310 * w1445 + w1311 * w1446 + w1312 * w1447 - w1450;
            const double w1452 = w2 * w1444 + w1264 * w1445 + w1285 * w1446 + w1307 * w1447 + w1449
                + w577 * w1451;
            const double w1453 = w1316 * w1445 + w1317 * w1446 + w1318 * w1447 - w1450;
            const double w1454 = w645 * w1448;
            const double w1455 = w546 * w1445 - w550 * w1446 - w102 * w1447;
            const double w1456 = w579 * w1455;
            const double w1457 = w1321 * w1446 + w1320 * w1445 + w1322 * w1447 + w1454 - w1456;
            const double w1458 = w590 * w1455;
            const double w1459 = w1327 * w1445 + w1328 * w1446 + w1329 * w1447 + w1458;
            const double w1460 = w1333 * w1445 + w1335 * w1446 + w1337 * w1447 + w711 * w1451
                + w715 * w1457 + w717 * w1459;
            const double w1461 = w1340 * w1446 + w1339 * w1445 + w1341 * w1447 + w1454 - w1456;
            const double w1462 = w1452 + w618 * w1453 + w637 * w1457 + w656 * w1459 + w669 * w1460
                + w728 * w1461;
            const double w1463 = w1344 * w1445 + w1345 * w1446 + w1346 * w1447 + w1458;
            const double w1464 = w230 * w1348 + w228 * w1349 + w1350 * w1442 + w1351 * w1443
                + w1267 * w1352 + w1354 * w1445;
            const double w1465 = w1464 + w1357 * w1446 + w1359 * w1447 + w789 * w1453 + w793 * w1461
                + w795 * w1463;
            const double w1466 = Wxi2_2 * w1242 - Wxi2_0 * w1234 - w1362 * w1442 + w1363 * w1443
                + w1267 * w1364;
            const double w1467 = w2 * w1466 + w1370 * w1445 + w1375 * w1446 + w1380 * w1447
                + w899 * w1451 + w906 * w1453;
            const double w1468 = w549 * w1455;
            const double w1469 = w1467 - w1468 + w911 * w1457 + w913 * w1459 + w915 * w1460
                + w918 * w1461 + w920 * w1463;
            const double w1470 = w213 * Wxi2_0;
            const double w1471 = w218 * w226 + w1470 - Pxi2_1 * w1242 + w1385 * w1442 - w1386 * w1443
                + w1267 * w1387;
            const double w1472 = w862 * w1448;
            const double w1473 = w2 * w1471 + w1393 * w1445 + w1398 * w1446 + w1403 * w1447 - w1472
                + w1002 * w1451;
            const double w1474 = w440 * w1455;
            const double w1475 = w1473 + w1008 * w1453 + w1474 + w1012 * w1457 + w1014 * w1459
                + w1016 * w1460 + w1019 * w1461;
            const double w1476 = w3 * w1444 + w1410 * w1445 + w1413 * w1446 + w1416 * w1447 + w1449
                + w1055 * w1451;
            const double w1477 = w1476 + w1057 * w1453 + w1058 * w1457 + w1059 * w1459 + w1060 * w1460
                + w1061 * w1461;
            const double w1478 = w3 * w1466 + w1421 * w1445 + w1424 * w1446 + w1427 * w1447
                + w1091 * w1451 + w1092 * w1453;
            const double w1479 = w1478 - w1468 + w1094 * w1457 + w1095 * w1459 + w1096 * w1460
                + w1097 * w1461 + w1098 * w1463;
            const double w1480 = w3 * w1471 + w1432 * w1445 + w1435 * w1446 + w1438 * w1447 - w1472
                + w1125 * w1451;
            const double w1481 = w1480 + w1127 * w1453 + w1474 + w1128 * w1457 + w1129 * w1459
                + w1130 * w1460 + w1131 * w1461;
            const double w1482 = X2_0 * w218;
            const double w1483 = X2_1 * w1219;
            const double w1484 = 1.0 - X2_0 * w1482 + X2_1 * w1483;
            const double w1485 = X2_2 * w1482 - w1221;
            const double w1486 = w1441 - X2_2 * w1483;
            const double w1487 = w1384 + w218 * w228 - Wxi2_2 * w1482 + w1226 * w1484 + w1231 * w1485
                + w1236 * w1486;
            const double w1488 = w1239 * w1484 + w1241 * w1485 + w1244 * w1486;
            const double w1489 = w1265 * w1484 + w1266 * w1485 + w1267 * w1486;
            const double w1490 = w1286 * w1484 + w1287 * w1485 + w1289 * w1486;
            const double w1491 = w550 * w1490 - (w494 * w1488 + w102 * w1489);
            const double w1492 = w549 * w1491;
            const double w1493 = w590 * w1491;
            const double w1494 = w1310 * w1488 + w1311 * w1489 + w1312 * w1490 - w1493;
            const double w1495 = w2 * w1487 + w1264 * w1488 + w1285 * w1489 + w1307 * w1490 + w1492
                + w577 * w1494;
            const double w1496 = w1316 * w1488 + w1317 * w1489 + w1318 * w1490 - w1493;
            const double w1497 = w645 * w1491;
            const double w1498 = w546 * w1488 - w550 * w1489 - w102 * w1490;
            const double w1499 = w579 * w1498;
            const double w1500 = w1321 * w1489 + w1320 * w1488 + w1322 * w1490 + w1497 - w1499;
            const double w1501 = w590 * w1498;
            const double w1502 = w1327 * w1488 + w1328 * w1489 + w1329 * w1490 + w1501;
            const double w1503 = w1333 * w1488 + w1335 * w1489 + w1337 * w1490 + w711 * w1494
                + w715 * w1500 + w717 * w1502;
            const double w1504 = w1340 * w1489 + w1339 * w1488 + w1341 * w1490 + w1497 - w1499;
            const double w1505 = w1495 + w618 * w1496 + w637 * w1500 + w656 * w1502 + w669 * w1503
                + w728 * w1504;
            const double w1506 = w1344 * w1488 + w1345 * w1489 + w1346 * w1490 + w1501;
            const double w1507 = w231 * w1348 + w227 * w1349 + w1350 * w1484 + w1351 * w1485
                + w1352 * w1486 + w1354 * w1488;
            const double w1508 = w1507 + w1357 * w1489 + w1359 * w1490 + w789 * w1496 + w793 * w1504
                + w795 * w1506;
            const double w1509 = w226 * w1219 - w1470 + Wxi2_2 * w1483 - w1362 * w1484 + w1363 * w1485
                + w1364 * w1486;
            const double w1510 = w2 * w1509 + w1370 * w1488 + w1375 * w1489 + w1380 * w1490
                + w899 * w1494 + w906 * w1496;
            const double w1511 = w549 * w1498;
            const double w1512 = w1510 - w1511 + w911 * w1500 + w913 * w1502 + w915 * w1503
                + w918 * w1504 + w920 * w1506;
            const double w1513 = Wxi2_0 * w1482 - Pxi2_1 * w1483 + w1385 * w1484 - w1386 * w1485
                + w1387 * w1486;
            const double w1514 = w862 * w1491;
            const double w1515 = w2 * w1513 + w1393 * w1488 + w1398 * w1489 + w1403 * w1490 - w1514
                + w1002 * w1494;
            const double w1516 = w440 * w1498;
            const double w1517 = w1515 + w1008 * w1496 + w1516 + w1012 * w1500 + w1014 * w1502
                + w1016 * w1503 + w1019 * w1504;
            const double w1518 = w3 * w1487 + w1410 * w1488 + w1413 * w1489 + w1416 * w1490 + w1492
                + w1055 * w1494;
            const double w1519 = w1518 + w1057 * w1496 + w1058 * w1500 + w1059 * w1502 + w1060 * w1503
                + w1061 * w1504;
            const double w1520 = w3 * w1509 + w1421 * w1488 + w1424 * w1489 + w1427 * w1490
                + w1091 * w1494 + w1092 * w1496;
            const double w1521 = w1520 - w1511 + w1094 * w1500 + w1095 * w1502 + w1096 * w1503
                + w1097 * w1504 + w1098 * w1506;
            const double w1522 = w3 * w1513 + w1432 * w1488 + w1435 * w1489 + w1438 * w1490 - w1514
                + w1125 * w1494;
            const double w1523 = w1522 + w1127 * w1496 + w1516 + w1128 * w1500 + w1129 * w1502
                + w1130 * w1503 + w1131 * w1504;
            memory->inverse_1[0] = 1.0 - (w737 + w744 * w751 + w753 * w796);
            memory->inverse_1[1] = -(w921 + w796 * w923);
            memory->inverse_1[2] = -(w1020 + w751 * w1022 + w796 * w1024);
            memory->inverse_1[3] = -(w1062 + w751 * w1063 + w796 * w1064);
            memory->inverse_1[4] = -(w1099 + w796 * w1100);
            memory->inverse_1[5] = -(w1132 + w751 * w1133 + w796 * w1134);
            memory->inverse_1[6] = -(w1157 + w744 * w1158 + w753 * w1159);
            memory->inverse_1[7] = 1.0 - (w1163 + w923 * w1159);
            memory->inverse_1[8] = -(w1169 + w1022 * w1158 + w1024 * w1159);
            memory->inverse_1[9] = -(w1171 + w1063 * w1158 + w1064 * w1159);
            memory->inverse_1[10] = -(w1173 + w1100 * w1159);
            memory->inverse_1[11] = -(w1175 + w1133 * w1158 + w1134 * w1159);
            memory->inverse_1[12] = -(w1200 + w744 * w1201 + w753 * w1202);
            memory->inverse_1[13] = -(w1206 + w923 * w1202);
            memory->inverse_1[14] = 1.0 - (w1211 + w1022 * w1201 + w1024 * w1202);
            memory->inverse_1[15] = -(w1213 + w1063 * w1201 + w1064 * w1202);
            memory->inverse_1[16] = -(w1215 + w1100 * w1202);
            memory->inverse_1[17] = -(w1217 + w1133 * w1201 + w1134 * w1202);
            memory->inverse_1[18] = -(w1343 + w744 * w1347 + w753 * w1360);
            memory->inverse_1[19] = -(w1383 + w923 * w1360);
            memory->inverse_1[20] = -(w1407 + w1022 * w1347 + w1024 * w1360);
            memory->inverse_1[21] = 1.0 - (w1418 + w1063 * w1347 + w1064 * w1360);
            memory->inverse_1[22] = -(w1429 + w1100 * w1360);
            memory->inverse_1[23] = -(w1440 + w1133 * w1347 + w1134 * w1360);
            memory->inverse_1[24] = -(w1462 + w744 * w1463 + w753 * w1465);
            memory->inverse_1[25] = -(w1469 + w923 * w1465);
            memory->inverse_1[26] = -(w1475 + w1022 * w1463 + w1024 * w1465);
            memory->inverse_1[27] = -(w1477 + w1063 * w1463 + w1064 * w1465);
            memory->inverse_1[28] = 1.0 - (w1479 + w1100 * w1465);
            memory->inverse_1[29] = -(w1481 + w1133 * w1463 + w1134 * w1465);
            memory->inverse_1[30] = -(w1505 + w744 * w1506 + w753 * w1508);
            memory->inverse_1[31] = -(w1512 + w923 * w1508);
            memory->inverse_1[32] = -(w1517 + w1022 * w1506 + w1024 * w1508);
            memory->inverse_1[33] = -(w1519 + w1063 * w1506 + w1064 * w1508);
            memory->inverse_1[34] = -(w1521 + w1100 * w1508);
            memory->inverse_1[35] = 1.0 - (w1523 + w1133 * w1506 + w1134 * w1508);
            size_t order_1[6];
            memory->made_1 = invert(6, memory->inverse_1, order_1);
            count_matrix(statistics);
            if (!memory->made_1) {
                count_sweeps(statistics, 0, sweep, 1);
                return DIPOLE_VRKMK2_GAUSS2_NOT_CONVERGED;
            }
        }
        const double change_v1_0 = memory->inverse_1[0] * residual_v1_0
            + memory->inverse_1[1] * residual_v1_1 + memory->inverse_1[2] * residual_v1_2
            + memory->inverse_1[3] * residual_v2_0 + memory->inverse_1[4] * residual_v2_1
            + memory->inverse_1[5] * residual_v2_2;
        const double change_v1_1 = memory->inverse_1[6] * residual_v1_0
            + memory->inverse_1[7] * residual_v1_1 + memory->inverse_1[8] * residual_v1_2
            + memory->inverse_1[9] * residual_v2_0 + memory->inverse_1[10] * residual_v2_1
            + memory->inverse_1[11] * residual_v2_2;
        const double change_v1_2 = memory->inverse_1[12] * residual_v1_0
            + memory->inverse_1[13] * residual_v1_1 + memory->inverse_1[14] * residual_v1_2
            + memory->inverse_1[15] * residual_v2_0 + memory->inverse_1[16] * residual_v2_1
            + memory->inverse_1[17] * residual_v2_2;
        const double change_v2_0 = memory->inverse_1[18] * residual_v1_0
            + memory->inverse_1[19] * residual_v1_1 + memory->inverse_1[20] * residual_v1_2
            + memory->inverse_1[21] * residual_v2_0 + memory->inverse_1[22] * residual_v2_1
            + memory->inverse_1[23] * residual_v2_2;
        const double change_v2_1 = memory->inverse_1[24] * residual_v1_0
            + memory->inverse_1[25] * residual_v1_1 + memory->inverse_1[26] * residual_v1_2
            + memory->inverse_1[27] * residual_v2_0 + memory->inverse_1[28] * residual_v2_1
            + memory->inverse_1[29] * residual_v2_2;
        const double change_v2_2 = memory->inverse_1[30] * residual_v1_0
            + memory->inverse_1[31] * residual_v1_1 + memory->inverse_1[32] * residual_v1_2
            + memory->inverse_1[33] * residual_v2_0 + memory->inverse_1[34] * residual_v2_1
            + memory->inverse_1[35] * residual_v2_2;
        const double change = greater(greater(fabs(change_v1_0), greater(fabs(change_v1_1),
            fabs(change_v1_2))), greater(fabs(change_v2_0), greater(fabs(change_v2_1),
            fabs(change_v2_2))));
        const double scale = greater(greater(1.0, greater(fabs(v1_0), fabs(v1_1))),
            greater(greater(fabs(v1_2), fabs(v2_0)), greater(fabs(v2_1), fabs(v2_2))));
        const int still = previous_1 > 0.0 && change >= previous_1;
        const int close = change <= 3.552713678800501e-15 * scale
            && change * change <= 1.1102230246251565e-16 * scale * previous_1;
        v1_0 += change_v1_0;
        v1_1 += change_v1_1;
        v1_2 += change_v1_2;
        v2_0 += change_v2_0;
        v2_1 += change_v2_1;
        v2_2 += change_v2_2;
        if (close || (still && change <= 5.684341886080802e-14 * scale)) {
            count_sweeps(statistics, 0, sweep, 0);
            break;
        }
        if (sweep == 100) {
            count_sweeps(statistics, 0, sweep, 1);
            return DIPOLE_VRKMK2_GAUSS2_NOT_CONVERGED;
        }
        make_1 = 0.0625 * previous_1 > 0.0 && change > 0.0625 * previous_1;
        previous_1 = change;
    }
    const double w1524 = Y_1 * w102;
    const double w1525 = Y_1 * w1524;
    const double w1526 = Y_2 * w102 * Y_2;
    const double g_0 = 1.0 - (w1525 + w1526);
    const double c1_3 = stumpff_1(w101);
    const double w1528 = Y_2 * c1_3;
    const double w1529 = Y_0 * w102;
    const double w1530 = Y_1 * w1529;
    const double g_3 = w1528 + w1530;
    const double w1531 = Y_2 * w1529;
    const double w1532 = Y_1 * c1_3;
    const double g_6 = w1531 - w1532;
    const double q1_0 = g00 * g_0 + g01 * g_3 + g02 * g_6;
    const double g_1 = w1530 - w1528;
    const double w1533 = Y_0 * w1529;
    const double g_4 = 1.0 - (w1526 + w1533);
    const double w1534 = Y_0 * c1_3;
    const double w1535 = Y_2 * w1524;
    const double g_7 = w1534 + w1535;
    const double q1_1 = g00 * g_1 + g01 * g_4 + g02 * g_7;
    const double g_2 = w1531 + w1532;
    const double g_5 = w1535 - w1534;
    const double g_8 = 1.0 - (w1525 + w1533);
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
    memmove(memory->past[1], memory->past[0], 2 * sizeof memory->past[0]);
    memory->past[0][0] = v1_0;
    memory->past[0][1] = v1_1;
    memory->past[0][2] = v1_2;
    memory->past[0][3] = v2_0;
    memory->past[0][4] = v2_1;
    memory->past[0][5] = v2_2;
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
