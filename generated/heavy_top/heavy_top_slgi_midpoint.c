/*
 * Heavy top with inertia fixed in space, T*SO(3): one step by slgi:midpoint
 *
 * method:     family slgi, tableau midpoint
 * source:     Table 3.2a of Bogfjellmo and Marthinsen
 * order:      2, certificate: exact (the residuals of all order conditions up to this order are
 *             zero in exact arithmetic)
 * digits:     with the coefficients rounded to double precision, the residuals of the order
 *             conditions are zero
 * scene:      Heavy top with inertia fixed in space, T*SO(3), group SO(3)
 * solved by:  the equations of xi1, n1: Newton's method, 6 unknowns; 4.85 sweeps and 1 matrix a
 *             step, measured over the first 20 steps of size h = 0.01
 * state:      [0..8] q: element of SO(3), row by row
 *             [9..11] mu: right-trivialised momentum in the dual of the Lie algebra of SO(3)
 * left out:   the time is not needed: no formula depends on the time
 * operations: 50 add, 71 mul, 1 stumpff_1 a step
 *             3 mul once in each run, for the initial guess of the first step
 *             105 add, 215 mul, 2 slope2, 2 slope3 for each matrix of the equations of xi1, n1
 *             73 add, 111 mul, 1 stumpff_123, 1 stumpff_23 for each sweep of the equations of xi1,
 *             n1
 * stack:      at most 6336 bytes with gcc 12 and clang 14 at -O0 to -O3 on x86-64; 1120 of these
 *             bytes are a safety margin; math library functions need extra bytes
 * command:    orderconds emit heavy_top --method slgi:midpoint --target c -o .
 * version:    orderconds 0.1.0
 *
 * Build: cc -std=c11 -O2 -ffp-contract=off -c heavy_top_slgi_midpoint.c
 * Use:
 *
 *     #include "heavy_top_slgi_midpoint.h"
 *     #include <stdio.h>
 *
 *     int main(void)
 *     {
 *         double state[12] = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 10000.0, 50000.0, 60000.0};
 *         size_t completed;
 *         const int status = heavy_top_slgi_midpoint_run(state, 0.01, 100, NULL, 0, NULL, &completed);
 *         printf("status %d after %zu steps\n", status, completed);
 *         for (int i = 0; i < 12; i++) {
 *             printf("%.17g\n", state[i]);
 *         }
 *         return status;
 *     }
 */
#include "heavy_top_slgi_midpoint.h"

#include <math.h>
#include <string.h>

#if defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__
#error "compile without -ffast-math (-ffinite-math-only): it removes the checks for infinities and NaNs"
#endif

/* c_3(z) for z <= 1/256 */
static inline double heavy_top_slgi_midpoint_stumpff_tiny_3(double z)
{
    const double w = z * z;
    return (0.16666666666666666 + z * -0.008333333333333059)
        + w * (0.00019841269798705593 + z * -2.7555439466688165e-06);
}

/* c_2(z) for z <= 1/256 */
static inline double heavy_top_slgi_midpoint_stumpff_tiny_2(double z)
{
    const double w = z * z;
    return (0.5 + z * -0.04166666666666365)
        + w * (0.0013888888842068215 + z * -2.4799519568559804e-05);
}

/* c_1(z) for z <= 1/256 */
static inline double heavy_top_slgi_midpoint_stumpff_tiny_1(double z)
{
    const double w = z * z;
    return (1.0 + z * -0.16666666666663651)
        + w * (0.00833333328651266 + z * -0.00019839202108242344);
}

/* c_3(z) for z <= 1/16 */
static inline double heavy_top_slgi_midpoint_stumpff_small_3(double z)
{
    const double w = z * z;
    return (0.16666666666666666 + z * -0.008333333333333163)
        + w * (0.0001984126983861331 + z * -2.755730638646008e-06)
        + w * w * 2.5027657390139978e-08;
}

/* c_2(z) for z <= 1/16 */
static inline double heavy_top_slgi_midpoint_stumpff_small_2(double z)
{
    const double w = z * z;
    return (0.5 + z * -0.041666666666666664)
        + w * (0.0013888888888888278 + z * -2.4801587297080002e-05)
        + w * w * (2.7557304737591345e-07 + z * -2.0855622118602925e-09);
}

/* c_1(z) for z <= 1/16 */
static inline double heavy_top_slgi_midpoint_stumpff_small_1(double z)
{
    const double w = z * z;
    return (1.0 + z * -0.16666666666666666)
        + w * (0.008333333333332476 + z * -0.0001984126983495962)
        + w * w * (2.755729894303353e-06 + z * -2.5022519568470477e-08);
}

/* c_3(z) = sum_j (-z)^j/(2j+3)!, truncated, for 0 <= z <= 4 */
static inline double heavy_top_slgi_midpoint_stumpff_series_3(double z)
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

/* c_2(z) = sum_j (-z)^j/(2j+2)!, truncated, for 0 <= z <= 1 */
static inline double heavy_top_slgi_midpoint_stumpff_series_2(double z)
{
    const double w = z * z;
    const double w2 = w * w;
    double even = -2.08767569878681e-09 + w * -4.779477332387385e-14;
    even = -0.041666666666666664 + w * -2.48015873015873e-05 + w2 * even;
    double odd = 1.1470745597729725e-11 + w * 1.5619206968586225e-16;
    odd = 0.001388888888888889 + w * 2.755731922398589e-07 + w2 * odd;
    return 0.5 + z * (even + z * odd);
}

/* c_1(z) = sum_j (-z)^j/(2j+1)!, truncated, for 0 <= z <= 1 */
static inline double heavy_top_slgi_midpoint_stumpff_series_1(double z)
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
static inline void heavy_top_slgi_midpoint_stumpff_23_far(double z, double *c2, double *c3)
{
    if (z <= 1.0) {
        *c2 = heavy_top_slgi_midpoint_stumpff_series_2(z);
        *c3 = heavy_top_slgi_midpoint_stumpff_series_3(z);
        return;
    }
    /* NaN if the angle is too large for an accurate result */
    const double half = 0.5 * sqrt(z <= 4398046511104.0 ? z : (double)NAN);
    const double sine = sin(half);
    const double cosine = cos(half);
    const double ratio = sine / half;
    *c2 = 0.5 * (ratio * ratio);
    *c3 = z <= 4.0 ? heavy_top_slgi_midpoint_stumpff_series_3(z) : (1.0 - ratio * cosine) / z;
}

/* For z >= 0 and s = sqrt(z): c_2 = (1 - cos(s))/s^2, c_3 = (s - sin(s))/s^3 */
static inline void heavy_top_slgi_midpoint_stumpff_23(double z, double *c2, double *c3)
{
    if (z <= 0.00390625) {
        *c2 = heavy_top_slgi_midpoint_stumpff_tiny_2(z);
        *c3 = heavy_top_slgi_midpoint_stumpff_tiny_3(z);
    } else if (z <= 0.0625) {
        *c2 = heavy_top_slgi_midpoint_stumpff_small_2(z);
        *c3 = heavy_top_slgi_midpoint_stumpff_small_3(z);
    } else {
        heavy_top_slgi_midpoint_stumpff_23_far(z, c2, c3);
    }
}

/* For z > 1/16 and s = sqrt(z): c_1 = sin(s)/s */
static inline double heavy_top_slgi_midpoint_stumpff_1_far(double z)
{
    if (z <= 1.0) {
        return heavy_top_slgi_midpoint_stumpff_series_1(z);
    }
    /* NaN if the angle is too large for an accurate result */
    const double s = sqrt(z <= 4398046511104.0 ? z : (double)NAN);
    return sin(s) / s;
}

/* For z > 1/16 and s = sqrt(z): c_1 = sin(s)/s, c_2 = (1 - cos(s))/s^2 */
static inline void heavy_top_slgi_midpoint_stumpff_12_far(double z, double *c1, double *c2)
{
    if (z <= 1.0) {
        *c1 = heavy_top_slgi_midpoint_stumpff_series_1(z);
        *c2 = heavy_top_slgi_midpoint_stumpff_series_2(z);
        return;
    }
    /* NaN if the angle is too large for an accurate result */
    const double half = 0.5 * sqrt(z <= 4398046511104.0 ? z : (double)NAN);
    const double sine = sin(half);
    const double cosine = cos(half);
    const double ratio = sine / half;
    *c1 = ratio * cosine;
    *c2 = 0.5 * (ratio * ratio);
}

/* For z > 1/16 and s = sqrt(z): c_1 = sin(s)/s, c_2 = (1 - cos(s))/s^2, c_3 = (s - sin(s))/s^3 */
static inline void heavy_top_slgi_midpoint_stumpff_123_far(double z, double *c1, double *c2, double *c3)
{
    if (z <= 1.0) {
        *c1 = heavy_top_slgi_midpoint_stumpff_series_1(z);
        *c2 = heavy_top_slgi_midpoint_stumpff_series_2(z);
        *c3 = heavy_top_slgi_midpoint_stumpff_series_3(z);
        return;
    }
    /* NaN if the angle is too large for an accurate result */
    const double half = 0.5 * sqrt(z <= 4398046511104.0 ? z : (double)NAN);
    const double sine = sin(half);
    const double cosine = cos(half);
    const double ratio = sine / half;
    *c1 = ratio * cosine;
    *c2 = 0.5 * (ratio * ratio);
    *c3 = z <= 4.0 ? heavy_top_slgi_midpoint_stumpff_series_3(z) : (1.0 - ratio * cosine) / z;
}

/* For z >= 0 and s = sqrt(z): c_1 = sin(s)/s, c_2 = (1 - cos(s))/s^2, c_3 = (s - sin(s))/s^3 */
static inline void heavy_top_slgi_midpoint_stumpff_123(double z, double *c1, double *c2, double *c3)
{
    if (z <= 0.0625) {
        *c1 = heavy_top_slgi_midpoint_stumpff_small_1(z);
        *c2 = heavy_top_slgi_midpoint_stumpff_small_2(z);
        *c3 = heavy_top_slgi_midpoint_stumpff_small_3(z);
    } else {
        heavy_top_slgi_midpoint_stumpff_123_far(z, c1, c2, c3);
    }
}

/* For z >= 0 and s = sqrt(z): c_1 = sin(s)/s, c_2 = (1 - cos(s))/s^2 */
static inline void heavy_top_slgi_midpoint_stumpff_12(double z, double *c1, double *c2)
{
    if (z <= 0.00390625) {
        *c1 = heavy_top_slgi_midpoint_stumpff_tiny_1(z);
        *c2 = heavy_top_slgi_midpoint_stumpff_tiny_2(z);
    } else if (z <= 0.0625) {
        *c1 = heavy_top_slgi_midpoint_stumpff_small_1(z);
        *c2 = heavy_top_slgi_midpoint_stumpff_small_2(z);
    } else {
        heavy_top_slgi_midpoint_stumpff_12_far(z, c1, c2);
    }
}

/* For z >= 0 and s = sqrt(z): c_1 = sin(s)/s */
static inline double heavy_top_slgi_midpoint_stumpff_1(double z)
{
    if (z <= 0.00390625) {
        return heavy_top_slgi_midpoint_stumpff_tiny_1(z);
    }
    return z <= 0.0625 ? heavy_top_slgi_midpoint_stumpff_small_1(z) : heavy_top_slgi_midpoint_stumpff_1_far(z);
}

/* The derivative of c_3 for z >= 0 */
static inline double heavy_top_slgi_midpoint_slope3(double z)
{
    if (z > 1.0) {
        double before, c;
        heavy_top_slgi_midpoint_stumpff_23(z, &before, &c);
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
static inline double heavy_top_slgi_midpoint_slope2(double z)
{
    if (z > 1.0) {
        double before, c;
        heavy_top_slgi_midpoint_stumpff_12(z, &before, &c);
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

/* The largest absolute value of n numbers */
static double heavy_top_slgi_midpoint_largest(const double *x, size_t n)
{
    double size = 0.0;
    for (size_t i = 0; i < n; i++) {
        size = fabs(x[i]) > size ? fabs(x[i]) : size;
    }
    return size;
}

/* Invert an n x n matrix, stored row by row, in place (Gauss-Jordan with row exchanges). Return 0 if it is
 * singular or not finite, else 1. Here n is always 6. */
static size_t heavy_top_slgi_midpoint_invert(size_t n, double *restrict a)
{
    double row[6];
    size_t order[6];
    for (size_t k = 0; k < n; k++) {
        size_t pivot = k;
        for (size_t i = k + 1; i < n; i++) {
            if (fabs(a[i * n + k]) > fabs(a[pivot * n + k])) {
                pivot = i;
            }
        }
        if (!(fabs(a[pivot * n + k]) > 0.0 && isfinite(a[pivot * n + k]))) {
            return 0;
        }
        order[k] = pivot;
        for (size_t j = 0; pivot != k && j < n; j++) {
            const double kept = a[k * n + j];
            a[k * n + j] = a[pivot * n + j];
            a[pivot * n + j] = kept;
        }
        const double factor = 1.0 / a[k * n + k];
        for (size_t j = 0; j < n; j++) {
            row[j] = a[k * n + j] *= factor;
        }
        a[k * n + k] = factor;
        for (size_t i = 0; i < n; i++) {
            if (i != k) {
                double *const b = a + i * n;
                const double multiple = b[k];
                b[0] -= multiple * row[0];
                b[1] -= multiple * row[1];
                b[2] -= multiple * row[2];
                b[3] -= multiple * row[3];
                b[4] -= multiple * row[4];
                b[5] -= multiple * row[5];
                b[k] = -(multiple * factor);
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

static inline double heavy_top_slgi_midpoint_greater(double a, double b)
{
    return a > b ? a : b;
}

/* Whether n numbers are all finite */
static int heavy_top_slgi_midpoint_all_finite(const double *x, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        if (!isfinite(x[i])) {
            return 0;
        }
    }
    return 1;
}

/*
 * Data that a step stores for the next step of the run: solutions of the implicit equations, the
 * latest first, and inverse matrices of Newton's method.
 */
struct heavy_top_slgi_midpoint_memory {
    size_t known; /* number of stored solutions */
    double first; /* error of the latest guess */
    size_t degree; /* degree of the extrapolation */
    size_t place; /* row of the latest solution */
    double guess[6]; /* initial guess for the next step */
    double values[32][6]; /* ring buffer, stored twice to avoid a modulo */
    double rate_1;
    size_t age_1; /* age of the stored inverse of the Newton matrix; 0 if none is stored */
    double inverse_1[36];
};

/* Row k: coefficients of the backward difference of order k, latest solution first. */
static const double heavy_top_slgi_midpoint_differences[17][18] = {
    {1.0},
    {1.0, -1.0},
    {1.0, -2.0, 1.0},
    {1.0, -3.0, 3.0, -1.0},
    {1.0, -4.0, 6.0, -4.0, 1.0},
    {1.0, -5.0, 10.0, -10.0, 5.0, -1.0},
    {1.0, -6.0, 15.0, -20.0, 15.0, -6.0, 1.0},
    {1.0, -7.0, 21.0, -35.0, 35.0, -21.0, 7.0, -1.0},
    {1.0, -8.0, 28.0, -56.0, 70.0, -56.0, 28.0, -8.0, 1.0},
    {1.0, -9.0, 36.0, -84.0, 126.0, -126.0, 84.0, -36.0, 9.0, -1.0},
    {1.0, -10.0, 45.0, -120.0, 210.0, -252.0, 210.0, -120.0, 45.0, -10.0, 1.0},
    {1.0, -11.0, 55.0, -165.0, 330.0, -462.0, 462.0, -330.0, 165.0, -55.0, 11.0, -1.0},
    {1.0, -12.0, 66.0, -220.0, 495.0, -792.0, 924.0, -792.0, 495.0, -220.0, 66.0, -12.0, 1.0},
    {1.0, -13.0, 78.0, -286.0, 715.0, -1287.0, 1716.0, -1716.0, 1287.0, -715.0, 286.0, -78.0, 13.0, -1.0},
    {1.0, -14.0, 91.0, -364.0, 1001.0, -2002.0, 3003.0, -3432.0, 3003.0, -2002.0, 1001.0, -364.0, 91.0, -14.0, 1.0},
    {1.0, -15.0, 105.0, -455.0, 1365.0, -3003.0, 5005.0, -6435.0, 6435.0, -5005.0, 3003.0, -1365.0, 455.0, -105.0, 15.0, -1.0},
    {1.0, -16.0, 120.0, -560.0, 1820.0, -4368.0, 8008.0, -11440.0, 12870.0, -11440.0, 8008.0, -4368.0, 1820.0, -560.0, 120.0, -16.0, 1.0},
};

/* Record the number of sweeps over one block, and whether the block failed. */
static void heavy_top_slgi_midpoint_count_sweeps(heavy_top_slgi_midpoint_statistics *statistics,
    size_t block, size_t sweeps, int failed)
{
    if (statistics != NULL) {
        statistics->sweeps[block] += sweeps;
        if (sweeps > statistics->most) {
            statistics->most = sweeps;
        }
        if (failed) {
            statistics->failed = block + 1;
        }
    }
}

/* Add one matrix. */
static void heavy_top_slgi_midpoint_count_matrix(heavy_top_slgi_midpoint_statistics *statistics)
{
    if (statistics != NULL) {
        statistics->matrices++;
    }
}

/*
 * Let 1, d_1, ..., d_order be the coefficients of the backward difference of the given order. Let u_0
 * be the latest stored solution, and u_k the solution k steps earlier. If first = 0 and sign = 1,
 * compute the backward difference sum = u_0 + d_1 u_1 + ... + d_order u_order. If first = 1 and sign =
 * -1, compute the solution extrapolated to the next step, sum = -d_1 u_0 - ... - d_order u_(order-1).
 */
static inline void heavy_top_slgi_midpoint_difference(const struct heavy_top_slgi_midpoint_memory *memory,
    size_t order, size_t first, double sign, double sum[static 6])
{
    double sum_0 = 0.0;
    double sum_1 = 0.0;
    double sum_2 = 0.0;
    double sum_3 = 0.0;
    double sum_4 = 0.0;
    double sum_5 = 0.0;
    for (size_t pair = (order - first) / 2 + 1; pair-- > 0;) {
        const size_t row = memory->place + 2 * pair;
        const size_t column = first + 2 * pair;
        const double newer = heavy_top_slgi_midpoint_differences[order][column];
        const double older = heavy_top_slgi_midpoint_differences[order][column + 1];
        sum_0 += sign * (newer * memory->values[row][0] + older * memory->values[row + 1][0]);
        sum_1 += sign * (newer * memory->values[row][1] + older * memory->values[row + 1][1]);
        sum_2 += sign * (newer * memory->values[row][2] + older * memory->values[row + 1][2]);
        sum_3 += sign * (newer * memory->values[row][3] + older * memory->values[row + 1][3]);
        sum_4 += sign * (newer * memory->values[row][4] + older * memory->values[row + 1][4]);
        sum_5 += sign * (newer * memory->values[row][5] + older * memory->values[row + 1][5]);
    }
    sum[0] = sum_0;
    sum[1] = sum_1;
    sum[2] = sum_2;
    sum[3] = sum_3;
    sum[4] = sum_4;
    sum[5] = sum_5;
}

/* The sum of the absolute values of the components of a backward difference. */
static double heavy_top_slgi_midpoint_difference_size(const struct heavy_top_slgi_midpoint_memory *memory,
    size_t order)
{
    double row[6];
    heavy_top_slgi_midpoint_difference(memory, order, 0, 1.0, row);
    double size = 0.0;
    for (size_t i = 0; i < 6; i++) {
        size += fabs(row[i]);
    }
    return size;
}

/*
 * Store a solution. Then compute the guess for the next step by polynomial extrapolation of the latest
 * stored solutions.
 */
static inline void heavy_top_slgi_midpoint_remember(struct heavy_top_slgi_midpoint_memory *memory,
    const double solution[static 6])
{
    /* the guess is tested only if at least three solutions are stored */
    if (memory->known > 2) {
        double moved = 0.0;
        moved += fabs(solution[0] - memory->values[memory->place][0]);
        moved += fabs(solution[1] - memory->values[memory->place][1]);
        moved += fabs(solution[2] - memory->values[memory->place][2]);
        moved += fabs(solution[3] - memory->values[memory->place][3]);
        moved += fabs(solution[4] - memory->values[memory->place][4]);
        moved += fabs(solution[5] - memory->values[memory->place][5]);
        if (memory->first > 0.5 * moved) {
            memory->known = 0;
            memory->degree = 0;
        }
    }
    memory->first = 0.0;
    const size_t place = memory->place > 0 ? memory->place - 1 : 15;
    memory->place = place;
    memcpy(memory->values[place], solution, 6 * sizeof *solution);
    memcpy(memory->values[place + 16], solution, 6 * sizeof *solution);
    if (memory->known < 16) {
        memory->known++;
    }
    /* adapt the degree in each step until the ring buffer is full, then every 8 steps */
    if (memory->known < 16 || place % 8 == 0) {
        const double size = heavy_top_slgi_midpoint_difference_size(memory, memory->degree);
        int grows = 0;
        if (memory->degree + 1 < memory->known) {
            const double higher = heavy_top_slgi_midpoint_difference_size(memory, memory->degree + 1);
            grows = higher < size;
        }
        if (grows) {
            memory->degree++;
        } else if (memory->degree > 0) {
            const double lower = heavy_top_slgi_midpoint_difference_size(memory, memory->degree - 1);
            if (size > lower) {
                memory->degree--;
            }
        }
    }
    /* extrapolate the polynomial through the latest solutions */
    heavy_top_slgi_midpoint_difference(memory, memory->degree + 1, 1, -1.0, memory->guess);
}

/* One step. */
static inline int heavy_top_slgi_midpoint_advance(double state[static 12], double h,
    struct heavy_top_slgi_midpoint_memory *memory,
    heavy_top_slgi_midpoint_statistics *statistics)
{
    if (!isfinite(h)) {
        return HEAVY_TOP_SLGI_MIDPOINT_BAD_STEP;
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
    double xi1_0, xi1_1, xi1_2, n1_0, n1_1, n1_2;
    if (memory->known > 0) {
        xi1_0 = memory->guess[0];
        xi1_1 = memory->guess[1];
        xi1_2 = memory->guess[2];
        n1_0 = memory->guess[3];
        n1_1 = memory->guess[4];
        n1_2 = memory->guess[5];
    } else {
        xi1_0 = 0.001 * mu0;
        xi1_1 = 0.0002 * mu1;
        xi1_2 = 0.00016666666666666666 * mu2;
        n1_0 = -g12;
        n1_1 = g02;
        n1_2 = 0.0;
    }
    const double w8 = -0.5 * h;
    const double w16 = 0.5 * h;
    /* the equations of xi1, n1: Newton's method, 6 unknowns */
    double previous_1 = 0.0;
    double rate_1 = memory->known > 0 ? memory->rate_1 : 1.0;
    int make_1 = !(memory->age_1 > 0);
    int astray = 0;
    size_t sweep = 0;
    int status = HEAVY_TOP_SLGI_MIDPOINT_NOT_CONVERGED;
    double Y_0, Y_1, Y_2, w1, w2, z_0, z_1, z_2, w10, w21;
    do {
        sweep++;
        Y_0 = h * xi1_0;
        Y_1 = h * xi1_1;
        Y_2 = h * xi1_2;
        w1 = Y_0 * Y_0 + Y_1 * Y_1 + Y_2 * Y_2;
        double c2_1, c3_1;
        heavy_top_slgi_midpoint_stumpff_23(w1, &c2_1, &c3_1);
        w2 = c2_1;
        const double w3 = mu1 * Y_2 - mu2 * Y_1;
        const double w5 = mu2 * Y_0 - mu0 * Y_2;
        const double w6 = mu0 * Y_1 - mu1 * Y_0;
        const double w7 = Y_2 * w5 - Y_1 * w6;
        z_0 = xi1_0 * w8;
        z_1 = xi1_1 * w8;
        z_2 = xi1_2 * w8;
        const double w9 = z_0 * z_0 + z_1 * z_1 + z_2 * z_2;
        double c1_1, c2_2, c3_2;
        heavy_top_slgi_midpoint_stumpff_123(w9, &c1_1, &c2_2, &c3_2);
        w10 = c2_2;
        const double w11 = n1_2 * z_1 - n1_1 * z_2;
        const double w13 = n1_1 * z_0 - n1_0 * z_1;
        const double w14 = n1_0 * z_2 - n1_2 * z_0;
        const double w15 = z_1 * w13 - z_2 * w14;
        const double M1_0 = mu0 - w2 * w3 + w7 * c3_1 + w16 * (n1_0 - w10 * w11 + w15 * c3_2);
        const double w17 = Y_0 * w6 - Y_2 * w3;
        const double w18 = z_2 * w11 - z_0 * w13;
        const double M1_1 = mu1 - w2 * w5 + w17 * c3_1 + w16 * (n1_1 - w10 * w14 + w18 * c3_2);
        const double w19 = Y_1 * w3 - Y_0 * w5;
        const double w20 = z_0 * w14 - z_1 * w11;
        const double M1_2 = mu2 - w2 * w6 + w19 * c3_1 + w16 * (n1_2 - w10 * w13 + w20 * c3_2);
        const double X1_2 = xi1_2 * w16;
        w21 = c1_1;
        const double w22 = X1_2 * w21;
        const double X1_1 = xi1_1 * w16;
        const double X1_0 = xi1_0 * w16;
        const double w23 = w10 * X1_0;
        const double w24 = X1_1 * w23;
        const double w25 = w10 * X1_2;
        const double w26 = X1_2 * w25;
        const double w27 = w10 * X1_1;
        const double Q1_5 = g02 * (w22 + w24) + g12 * (1.0 - (X1_0 * w23 + w26))
            + g22 * (X1_2 * w27 - w21 * X1_0);
        const double Q1_2 = g12 * (w24 - w22) + g02 * (1.0 - (w26 + X1_1 * w27))
            + g22 * (X1_2 * w23 + w21 * X1_1);
        const double next_xi1_0 = 0.001 * M1_0;
        const double next_xi1_1 = 0.0002 * M1_1;
        const double next_xi1_2 = 0.00016666666666666666 * M1_2;
        const double next_n1_0 = -Q1_5;
        const double next_n1_2 = 0.0;
        const double residual_xi1_0 = next_xi1_0 - xi1_0;
        const double residual_xi1_1 = next_xi1_1 - xi1_1;
        const double residual_xi1_2 = next_xi1_2 - xi1_2;
        const double residual_n1_0 = next_n1_0 - n1_0;
        const double residual_n1_1 = Q1_2 - n1_1;
        const double residual_n1_2 = next_n1_2 - n1_2;
        if (make_1 && isfinite(residual_xi1_0 + residual_xi1_1 + residual_xi1_2 + residual_n1_0
            + residual_n1_1 + residual_n1_2)) {
            const double w28 = 0.001 * c3_1;
            const double w29 = Y_1 * w28;
            const double w30 = h * mu1;
            const double w31 = Y_2 * w28;
            const double w32 = h * mu2;
            const double w33 = heavy_top_slgi_midpoint_slope3(w1);
            const double w34 = heavy_top_slgi_midpoint_slope2(w1);
            const double w35 = 0.001 * w7 * w33 - 0.001 * w3 * w34;
            const double w36 = 2.0 * Y_0 * h;
            const double w37 = 0.0005 * h;
            const double w38 = w37 * c3_2;
            const double w39 = z_1 * w38;
            const double w40 = n1_1 * w8;
            const double w41 = z_2 * w38;
            const double w42 = n1_2 * w8;
            const double w43 = heavy_top_slgi_midpoint_slope3(w9);
            const double w44 = heavy_top_slgi_midpoint_slope2(w9);
            const double w45 = w15 * w37 * w43 - w11 * w37 * w44;
            const double w46 = 2.0 * z_0 * w8;
            const double w47 = w29 * w30 + w31 * w32 + w35 * w36 + w39 * w40 + w41 * w42 + w45 * w46;
            const double w48 = h * mu0;
            const double w49 = -0.001 * w2;
            const double w50 = 2.0 * Y_1 * h;
            const double w51 = w13 * w38 * w8 - w6 * w28 * h - w29 * w48 - w32 * w49 + w35 * w50;
            const double w52 = n1_0 * w8;
            const double w53 = w10 * w37;
            const double w54 = 2.0 * z_1 * w8;
            const double w55 = 2.0 * Y_2 * h;
            const double w56 = w5 * w28 * h - w14 * w38 * w8 - w31 * w48 + w30 * w49 + w35 * w55;
            const double w57 = 2.0 * z_2 * w8;
            const double w58 = 0.0002 * c3_1;
            const double w59 = 0.0001 * h;
            const double w60 = w59 * c3_2;
            const double w61 = Y_0 * w58;
            const double w62 = -0.0002 * w2;
            const double w63 = 0.0002 * w17 * w33 - 0.0002 * w5 * w34;
            const double w64 = w6 * w58 * h - w13 * w60 * w8 - w30 * w61 + w32 * w62 + w36 * w63;
            const double w65 = z_0 * w60;
            const double w66 = w10 * w59;
            const double w67 = w18 * w59 * w43 - w14 * w59 * w44;
            const double w68 = Y_2 * w58;
            const double w69 = z_2 * w60;
            const double w70 = w48 * w61 + w32 * w68 + w50 * w63 + w52 * w65 + w42 * w69 + w54 * w67;
            const double w71 = w11 * w60 * w8 - w3 * w58 * h - w48 * w62 - w30 * w68 + w55 * w63;
            const double w72 = 8.333333333333333e-05 * h;
            const double w73 = w72 * c3_2;
            const double w74 = 0.00016666666666666666 * c3_1;
            const double w75 = -0.00016666666666666666 * w2;
            const double w76 = Y_0 * w74;
            const double w77 = 0.00016666666666666666 * w19 * w33 - 0.00016666666666666666 * w6 * w34;
            const double w78 = w14 * w73 * w8 - w5 * w74 * h - w30 * w75 - w32 * w76 + w36 * w77;
            const double w79 = w10 * w72;
            const double w80 = z_0 * w73;
            const double w81 = w20 * w72 * w43 - w13 * w72 * w44;
            const double w82 = Y_1 * w74;
            const double w83 = w3 * w74 * h - w11 * w73 * w8 + w48 * w75 - w32 * w82 + w50 * w77;
            const double w84 = z_1 * w73;
            const double w85 = w48 * w76 + w30 * w82 + w55 * w77 + w52 * w80 + w40 * w84 + w57 * w81;
            const double w86 = g22 * w21;
            const double w87 = w10 * w16;
            const double w88 = g02 * X1_1;
            const double w89 = g12 * X1_0 - w88;
            const double w90 = 0.5 * (c3_2 - w10);
            const double w91 = X1_2 * w90;
            const double w92 = X1_2 * X1_2;
            const double w93 = g22 * X1_2;
            const double w94 = g22 * X1_0 * w90 - g02 * w91
                + w44 * (g12 * w92 - X1_1 * w93 + X1_0 * w89);
            const double w95 = w16 * w23;
            const double w96 = 2.0 * w25;
            const double w97 = w16 * w21;
            const double w98 = w93 + g12 * X1_1;
            const double w99 = g22 * X1_1 * w90 - g12 * w91
                + w44 * (X1_0 * w98 - (g02 * w92 + X1_1 * w88));
            const double w100 = -(w16 * (w86 - g02 * w27) + g12 * w95 - w87 * w88 + w54 * w99);
            memory->inverse_1[0] = 1.0 - w47;
            memory->inverse_1[1] = -(w51 - w39 * w52 - w42 * w53 + w45 * w54);
            memory->inverse_1[2] = -(w56 - w41 * w52 + w40 * w53 + w45 * w57);
            memory->inverse_1[3] = z_2 * w41 - (w37 - z_1 * w39);
            memory->inverse_1[4] = -(z_0 * w39 + z_2 * w53);
            memory->inverse_1[5] = z_1 * w53 - z_0 * w41;
            memory->inverse_1[6] = -(w64 - w40 * w65 + w42 * w66 + w46 * w67);
            memory->inverse_1[7] = 1.0 - w70;
            memory->inverse_1[8] = -(w71 - w52 * w66 - w40 * w69 + w57 * w67);
            memory->inverse_1[9] = z_2 * w66 - z_1 * w65;
            memory->inverse_1[10] = z_2 * w69 - (w59 - z_0 * w65);
            memory->inverse_1[11] = -(z_0 * w66 + z_1 * w69);
            memory->inverse_1[12] = -(w78 - w40 * w79 - w42 * w80 + w46 * w81);
            memory->inverse_1[13] = -(w83 + w52 * w79 - w42 * w84 + w54 * w81);
            memory->inverse_1[14] = 1.0 - w85;
            memory->inverse_1[15] = -(z_1 * w79 + z_2 * w80);
            memory->inverse_1[16] = z_0 * w79 - z_2 * w84;
            memory->inverse_1[17] = z_1 * w84 - (w72 - z_0 * w80);
            memory->inverse_1[18] = -(w16 * (g12 * w23 + w86) + w87 * w89 + w46 * w94);
            memory->inverse_1[19] = g02 * w95 + w87 * w93 - w54 * w94;
            memory->inverse_1[20] = -(w16 * (g12 * w96 - g22 * w27) - g02 * w97 + w57 * w94);
            memory->inverse_1[21] = 1.0;
            memory->inverse_1[22] = 0.0;
            memory->inverse_1[23] = 0.0;
            memory->inverse_1[24] = -(w87 * w98 + w46 * w99);
            memory->inverse_1[25] = w100;
            memory->inverse_1[26] = -(w16 * (g22 * w23 - g02 * w96) - g12 * w97 + w57 * w99);
            memory->inverse_1[27] = 0.0;
            memory->inverse_1[28] = 1.0;
            memory->inverse_1[29] = 0.0;
            memory->inverse_1[30] = 0.0;
            memory->inverse_1[31] = 0.0;
            memory->inverse_1[32] = 0.0;
            memory->inverse_1[33] = 0.0;
            memory->inverse_1[34] = 0.0;
            memory->inverse_1[35] = 1.0;
            memory->age_1 = heavy_top_slgi_midpoint_invert(6, memory->inverse_1);
            if (memory->age_1 > 0) {
                heavy_top_slgi_midpoint_count_matrix(statistics);
            }
        }
        const double change_xi1_0 = memory->inverse_1[0] * residual_xi1_0
            + memory->inverse_1[1] * residual_xi1_1 + (memory->inverse_1[2] * residual_xi1_2
            + memory->inverse_1[3] * residual_n1_0) + (memory->inverse_1[4] * residual_n1_1
            + memory->inverse_1[5] * residual_n1_2);
        const double change_xi1_1 = memory->inverse_1[6] * residual_xi1_0
            + memory->inverse_1[7] * residual_xi1_1 + (memory->inverse_1[8] * residual_xi1_2
            + memory->inverse_1[9] * residual_n1_0) + (memory->inverse_1[10] * residual_n1_1
            + memory->inverse_1[11] * residual_n1_2);
        const double change_xi1_2 = memory->inverse_1[12] * residual_xi1_0
            + memory->inverse_1[13] * residual_xi1_1 + (memory->inverse_1[14] * residual_xi1_2
            + memory->inverse_1[15] * residual_n1_0) + (memory->inverse_1[16] * residual_n1_1
            + memory->inverse_1[17] * residual_n1_2);
        const double change_n1_0 = memory->inverse_1[18] * residual_xi1_0
            + memory->inverse_1[19] * residual_xi1_1 + (memory->inverse_1[20] * residual_xi1_2
            + memory->inverse_1[21] * residual_n1_0) + (memory->inverse_1[22] * residual_n1_1
            + memory->inverse_1[23] * residual_n1_2);
        const double change_n1_1 = memory->inverse_1[24] * residual_xi1_0
            + memory->inverse_1[25] * residual_xi1_1 + (memory->inverse_1[26] * residual_xi1_2
            + memory->inverse_1[27] * residual_n1_0) + (memory->inverse_1[28] * residual_n1_1
            + memory->inverse_1[29] * residual_n1_2);
        const double change_n1_2 = memory->inverse_1[30] * residual_xi1_0
            + memory->inverse_1[31] * residual_xi1_1 + (memory->inverse_1[32] * residual_xi1_2
            + memory->inverse_1[33] * residual_n1_0) + (memory->inverse_1[34] * residual_n1_1
            + memory->inverse_1[35] * residual_n1_2);
        const double change = heavy_top_slgi_midpoint_greater(heavy_top_slgi_midpoint_greater(fabs(change_xi1_0),
            heavy_top_slgi_midpoint_greater(fabs(change_xi1_1), fabs(change_xi1_2))),
            heavy_top_slgi_midpoint_greater(fabs(change_n1_0),
            heavy_top_slgi_midpoint_greater(fabs(change_n1_1), fabs(change_n1_2))));
        const double scale = heavy_top_slgi_midpoint_greater(heavy_top_slgi_midpoint_greater(fabs(xi1_0),
            heavy_top_slgi_midpoint_greater(fabs(xi1_1), fabs(xi1_2))),
            heavy_top_slgi_midpoint_greater(fabs(n1_0), heavy_top_slgi_midpoint_greater(fabs(n1_1),
            fabs(n1_2))));
        if (sweep == 1) {
            memory->first = heavy_top_slgi_midpoint_greater(memory->first, change);
        }
        if (previous_1 > 0.0) {
            rate_1 = heavy_top_slgi_midpoint_greater(change / previous_1, 0.000244140625);
        }
        xi1_0 += change_xi1_0;
        xi1_1 += change_xi1_1;
        xi1_2 += change_xi1_2;
        n1_0 += change_n1_0;
        n1_1 += change_n1_1;
        n1_2 += change_n1_2;
        const int still = previous_1 > 0.0 && change >= previous_1;
        const int close = change <= 3.552713678800501e-15 * scale
            && change * rate_1 <= 1.1102230246251565e-16 * scale;
        const int converged = close || (still && (change <= 5.684341886080802e-14 * scale || (change
            * fabs(h) <= 7.105427357601002e-15 * heavy_top_slgi_midpoint_largest(state, 9) && change
            * fabs(h) <= 7.105427357601002e-15 * heavy_top_slgi_midpoint_largest(state + 9, 3))));
        status = isfinite(change_xi1_0 + change_xi1_1 + change_xi1_2 + change_n1_0 + change_n1_1
            + change_n1_2) ? (memory->age_1 > 0 && converged ? HEAVY_TOP_SLGI_MIDPOINT_OK
            : HEAVY_TOP_SLGI_MIDPOINT_NOT_CONVERGED) : HEAVY_TOP_SLGI_MIDPOINT_NOT_FINITE;
        astray = (still && make_1) || !(memory->age_1 > 0);
        make_1 = 0.015625 * previous_1 > 0.0 && change > 0.015625 * previous_1;
        previous_1 = change;
    } while (status == HEAVY_TOP_SLGI_MIDPOINT_NOT_CONVERGED && sweep < 100 && !astray);
    if (status != HEAVY_TOP_SLGI_MIDPOINT_OK && (status == HEAVY_TOP_SLGI_MIDPOINT_NOT_CONVERGED
        && !(memory->age_1 > 0))) {
        status = HEAVY_TOP_SLGI_MIDPOINT_SINGULAR;
    }
    heavy_top_slgi_midpoint_count_sweeps(statistics, 0, sweep,
        status != HEAVY_TOP_SLGI_MIDPOINT_OK);
    if (status != HEAVY_TOP_SLGI_MIDPOINT_OK) {
        return status;
    }
    memory->rate_1 = sweep > 1 ? rate_1 : 2.0 * rate_1;
    const double solution[6] = {xi1_0, xi1_1, xi1_2, n1_0, n1_1, n1_2};
    heavy_top_slgi_midpoint_remember(memory, solution);
    const double w101 = Y_1 * w2;
    const double w102 = Y_1 * w101;
    const double w103 = Y_2 * w2 * Y_2;
    const double g_0 = 1.0 - (w102 + w103);
    const double w104 = Y_0 * w2;
    const double w105 = Y_1 * w104;
    const double c1_2 = heavy_top_slgi_midpoint_stumpff_1(w1);
    const double w107 = Y_2 * c1_2;
    const double g_1 = w105 - w107;
    const double w108 = Y_1 * c1_2;
    const double w109 = Y_2 * w104;
    const double g_2 = w108 + w109;
    const double g_3 = w105 + w107;
    const double w110 = Y_0 * w104;
    const double g_4 = 1.0 - (w103 + w110);
    const double w111 = Y_2 * w101;
    const double w112 = Y_0 * c1_2;
    const double g_5 = w111 - w112;
    const double g_6 = w109 - w108;
    const double g_7 = w111 + w112;
    const double g_8 = 1.0 - (w102 + w110);
    const double w113 = z_1 * w10;
    const double w114 = z_2 * w10 * z_2;
    const double w115 = z_2 * w21;
    const double w116 = z_0 * w10;
    const double w117 = z_1 * w116;
    const double mu1_0 = mu0 * g_0 + mu1 * g_1 + mu2 * g_2
        + h * (n1_0 * (1.0 - (z_1 * w113 + w114)) + n1_1 * (w115 + w117));
    const double mu1_1 = mu0 * g_3 + mu1 * g_4 + mu2 * g_5
        + h * (n1_0 * (w117 - w115) + n1_1 * (1.0 - (w114 + z_0 * w116)));
    const double w118 = h * (n1_0 * (z_1 * w21 + z_2 * w116) + n1_1 * (z_2 * w113 - z_0 * w21));
    const double new_g00 = g00 * g_0 + g10 * g_1 + g20 * g_2;
    const double new_g01 = g01 * g_0 + g11 * g_1 + g21 * g_2;
    const double new_g02 = g02 * g_0 + g12 * g_1 + g22 * g_2;
    const double new_g10 = g00 * g_3 + g10 * g_4 + g20 * g_5;
    const double new_g11 = g01 * g_3 + g11 * g_4 + g21 * g_5;
    const double new_g12 = g02 * g_3 + g12 * g_4 + g22 * g_5;
    const double new_g20 = g00 * g_6 + g10 * g_7 + g20 * g_8;
    const double new_g21 = g01 * g_6 + g11 * g_7 + g21 * g_8;
    const double new_g22 = g02 * g_6 + g12 * g_7 + g22 * g_8;
    const double new_mu2 = mu0 * g_6 + mu1 * g_7 + mu2 * g_8 + w118;
    /* If the sum of all x overflows, test each x: x - x is 0 only if x is finite. */
    if (!isfinite(new_g00 + new_g01 + (new_g02 + new_g10) + (new_g11 + new_g12)
        + (new_g20 + new_g21) + (new_g22 + mu1_0) + (mu1_1 + new_mu2)) && !(new_g00 - new_g00
        + (new_g01 - new_g01) + (new_g02 - new_g02 + (new_g10 - new_g10))
        + (new_g11 - new_g11 + (new_g12 - new_g12)) + (new_g20 - new_g20 + (new_g21 - new_g21))
        + (new_g22 - new_g22 + (mu1_0 - mu1_0)) + (mu1_1 - mu1_1 + (new_mu2 - new_mu2))
        == 0.0)) {
        return HEAVY_TOP_SLGI_MIDPOINT_NOT_FINITE;
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
    state[9] = mu1_0;
    state[10] = mu1_1;
    state[11] = new_mu2;
    return HEAVY_TOP_SLGI_MIDPOINT_OK;
}

/*
 * Repeat a failed step with a new initial guess. If the step fails again, the step size is halved
 * until the step succeeds. Each solution is then the initial guess for a longer step (continuation in
 * h).
 */
static int heavy_top_slgi_midpoint_continued(double state[static 12], double h,
    struct heavy_top_slgi_midpoint_memory *memory,
    heavy_top_slgi_midpoint_statistics *statistics)
{
    if (!(h < 0.0 || h > 0.0)) {
        return heavy_top_slgi_midpoint_all_finite(state, 12) ? HEAVY_TOP_SLGI_MIDPOINT_OK
            : HEAVY_TOP_SLGI_MIDPOINT_NOT_FINITE;
    }
    double known_solution[6] = {0.0};
    double trial[12];
    double solved = 0.0;
    double part = 1.0;
    double factor = 2.0;
    int failure = HEAVY_TOP_SLGI_MIDPOINT_NOT_CONVERGED;
    int done = 0;
    size_t tries = 0;
    while (!done && tries < 100 && factor > 1.00390625) {
        memcpy(trial, state, sizeof trial);
        memset(memory, 0, sizeof *memory);
        if (solved > 0.0) {
            memory->known = 1;
            memcpy(memory->guess, known_solution, sizeof known_solution);
            memory->rate_1 = 1.0;
        }
        const int status = heavy_top_slgi_midpoint_advance(trial, part * h, memory, statistics);
        done = status == HEAVY_TOP_SLGI_MIDPOINT_OK && part >= 1.0;
        if (status == HEAVY_TOP_SLGI_MIDPOINT_OK) {
            memcpy(known_solution, memory->values[memory->place], sizeof known_solution);
            solved = part;
            factor *= factor;
        } else {
            failure = status;
            factor = solved > 0.0 ? sqrt(factor) : factor;
        }
        if (!done) {
            factor = factor < 4.0 ? factor : 4.0;
            part = solved > 0.0 ? solved * factor : 0.5 * part;
            part = part < 1.0 ? part : 1.0;
        }
        tries++;
    }
    if (!done) {
        return solved > 0.0 && failure == HEAVY_TOP_SLGI_MIDPOINT_NOT_FINITE
            ? HEAVY_TOP_SLGI_MIDPOINT_TOO_FAR : failure;
    }
    memcpy(state, trial, sizeof trial);
    memory->known = 1;
    if (statistics != NULL) {
        statistics->failed = 0;
    }
    return HEAVY_TOP_SLGI_MIDPOINT_OK;
}

int heavy_top_slgi_midpoint_step(double state[static 12], double h,
    heavy_top_slgi_midpoint_statistics *statistics)
{
    struct heavy_top_slgi_midpoint_memory memory = {0};
    int status = heavy_top_slgi_midpoint_advance(state, h, &memory, statistics);
    if (status != HEAVY_TOP_SLGI_MIDPOINT_OK && status != HEAVY_TOP_SLGI_MIDPOINT_BAD_STEP) {
        status = heavy_top_slgi_midpoint_continued(state, h, &memory, statistics);
    }
    return status;
}

int heavy_top_slgi_midpoint_run(double state[static 12], double h, size_t steps,
    double *trajectory, size_t stride, heavy_top_slgi_midpoint_statistics *statistics,
    size_t *completed)
{
    int status = HEAVY_TOP_SLGI_MIDPOINT_OK;
    size_t step = 0;
    struct heavy_top_slgi_midpoint_memory memory = {0};
    const int recording = stride > 0 && trajectory != NULL;
    size_t row = 0;
    if (recording) {
        memcpy(trajectory, state, 12 * sizeof *state);
    }
    while (status == HEAVY_TOP_SLGI_MIDPOINT_OK && step < steps) {
        status = heavy_top_slgi_midpoint_advance(state, h, &memory, statistics);
        if (status != HEAVY_TOP_SLGI_MIDPOINT_OK && status != HEAVY_TOP_SLGI_MIDPOINT_BAD_STEP) {
            status = heavy_top_slgi_midpoint_continued(state, h, &memory, statistics);
        }
        if (status == HEAVY_TOP_SLGI_MIDPOINT_OK) {
            step++;
            if (recording && step % stride == 0) {
                row++;
                memcpy(trajectory + 12 * row, state, 12 * sizeof *state);
            }
        }
    }
    if (completed != NULL) {
        *completed = step;
    }
    return status;
}
