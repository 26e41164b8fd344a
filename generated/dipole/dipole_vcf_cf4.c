/*
 * Dipole on a stick, T*SO(3): one step by vcf:cf4
 *
 * method:     family vcf, tableau cf4
 * source:     Celledoni, Marthinsen and Owren 2003; H. Marthinsen, On symplectic integration in
 *             Lie groups and manifolds, PhD thesis, NTNU 2014, Section 2.2.1
 * order:      4, certificate: exact (the residuals of all order conditions up to this order are
 *             zero in exact arithmetic)
 * digits:     with the coefficients rounded to double precision, the residuals of the order
 *             conditions are at most 3.2e-17
 * scene:      Dipole on a stick, T*SO(3), group SO(3)
 * solved by:  the equations of xi1, xi2, xi3, xi4, n1, n2, n3, n4: Newton's method, 12 unknowns;
 *             1.7 sweeps and 0.2 matrices a step, measured over the first 20 steps of size h =
 *             0.005
 * state:      [0..8] q: element of SO(3), row by row
 *             [9..11] mu: right-trivialised momentum in the dual of the Lie algebra of SO(3)
 * left out:   24 adjoint maps, 5 products, 1 sum: coefficients are zero, or terms cancel
 *             4 Legendre transforms, 19 adjoint maps, 31 evaluations of dexp*, 1 exponential, 4
 *             sums: equal values are computed once
 *             7 adjoint maps, 1 evaluation of the derivatives of H: no result depends on these
 *             operations
 *             4 adjoint maps, 9 evaluations of dexp*: a linear map is applied once to a sum and
 *             not to each term
 *             4 adjoint maps: an adjoint map and its inverse cancel
 *             5 evaluations of dexp*: functions of the same ad_x are combined
 *             arguments for constant parameters: beta = 1, depth = 3/2
 *             the time is not needed: no formula depends on the time
 * operations: 116 add, 179 mul, 2 sqrt, 2 div, 2 stumpff_12 a step
 *             2 mul once in each run, for the initial guess of the first step
 *             102 add, 184 mul for each matrix of the equations of xi1, xi2, xi3, xi4, n1, n2, n3,
 *             n4
 *             442 add, 562 mul, 6 div, 6 sqrt, 4 stumpff_123, 1 stumpff_23 for each sweep of the
 *             equations of xi1, xi2, xi3, xi4, n1, n2, n3, n4
 *             12 add, 18 mul at the start of a run, 12 add, 9 mul at the end of a run
 * stack:      at most 13440 bytes with gcc 12 and clang 14 at -O0 to -O3 on x86-64; 2536 of these
 *             bytes are a safety margin; math library functions need extra bytes
 * command:    orderconds emit dipole --method vcf:cf4 --target c -o .
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

/* c_3(z) for z <= 1/256 */
static inline double dipole_vcf_cf4_stumpff_tiny_3(double z)
{
    const double w = z * z;
    return (0.16666666666666666 + z * -0.008333333333333059)
        + w * (0.00019841269798705593 + z * -2.7555439466688165e-06);
}

/* c_2(z) for z <= 1/256 */
static inline double dipole_vcf_cf4_stumpff_tiny_2(double z)
{
    const double w = z * z;
    return (0.5 + z * -0.04166666666666365)
        + w * (0.0013888888842068215 + z * -2.4799519568559804e-05);
}

/* c_1(z) for z <= 1/256 */
static inline double dipole_vcf_cf4_stumpff_tiny_1(double z)
{
    const double w = z * z;
    return (1.0 + z * -0.16666666666663651)
        + w * (0.00833333328651266 + z * -0.00019839202108242344);
}

/* c_3(z) for z <= 1/16 */
static inline double dipole_vcf_cf4_stumpff_small_3(double z)
{
    const double w = z * z;
    return (0.16666666666666666 + z * -0.008333333333333163)
        + w * (0.0001984126983861331 + z * -2.755730638646008e-06)
        + w * w * 2.5027657390139978e-08;
}

/* c_2(z) for z <= 1/16 */
static inline double dipole_vcf_cf4_stumpff_small_2(double z)
{
    const double w = z * z;
    return (0.5 + z * -0.041666666666666664)
        + w * (0.0013888888888888278 + z * -2.4801587297080002e-05)
        + w * w * (2.7557304737591345e-07 + z * -2.0855622118602925e-09);
}

/* c_1(z) for z <= 1/16 */
static inline double dipole_vcf_cf4_stumpff_small_1(double z)
{
    const double w = z * z;
    return (1.0 + z * -0.16666666666666666)
        + w * (0.008333333333332476 + z * -0.0001984126983495962)
        + w * w * (2.755729894303353e-06 + z * -2.5022519568470477e-08);
}

/* c_3(z) = sum_j (-z)^j/(2j+3)!, truncated, for 0 <= z <= 4 */
static inline double dipole_vcf_cf4_stumpff_series_3(double z)
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
static inline double dipole_vcf_cf4_stumpff_series_2(double z)
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
static inline double dipole_vcf_cf4_stumpff_series_1(double z)
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
static inline void dipole_vcf_cf4_stumpff_23_far(double z, double *c2, double *c3)
{
    if (z <= 1.0) {
        *c2 = dipole_vcf_cf4_stumpff_series_2(z);
        *c3 = dipole_vcf_cf4_stumpff_series_3(z);
        return;
    }
    /* NaN if the angle is too large for an accurate result */
    const double half = 0.5 * sqrt(z <= 4398046511104.0 ? z : (double)NAN);
    const double sine = sin(half);
    const double cosine = cos(half);
    const double ratio = sine / half;
    *c2 = 0.5 * (ratio * ratio);
    *c3 = z <= 4.0 ? dipole_vcf_cf4_stumpff_series_3(z) : (1.0 - ratio * cosine) / z;
}

/* For z >= 0 and s = sqrt(z): c_2 = (1 - cos(s))/s^2, c_3 = (s - sin(s))/s^3 */
static inline void dipole_vcf_cf4_stumpff_23(double z, double *c2, double *c3)
{
    if (z <= 0.00390625) {
        *c2 = dipole_vcf_cf4_stumpff_tiny_2(z);
        *c3 = dipole_vcf_cf4_stumpff_tiny_3(z);
    } else if (z <= 0.0625) {
        *c2 = dipole_vcf_cf4_stumpff_small_2(z);
        *c3 = dipole_vcf_cf4_stumpff_small_3(z);
    } else {
        dipole_vcf_cf4_stumpff_23_far(z, c2, c3);
    }
}

/* For z > 1/16 and s = sqrt(z): c_1 = sin(s)/s, c_2 = (1 - cos(s))/s^2 */
static inline void dipole_vcf_cf4_stumpff_12_far(double z, double *c1, double *c2)
{
    if (z <= 1.0) {
        *c1 = dipole_vcf_cf4_stumpff_series_1(z);
        *c2 = dipole_vcf_cf4_stumpff_series_2(z);
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
static inline void dipole_vcf_cf4_stumpff_123_far(double z, double *c1, double *c2, double *c3)
{
    if (z <= 1.0) {
        *c1 = dipole_vcf_cf4_stumpff_series_1(z);
        *c2 = dipole_vcf_cf4_stumpff_series_2(z);
        *c3 = dipole_vcf_cf4_stumpff_series_3(z);
        return;
    }
    /* NaN if the angle is too large for an accurate result */
    const double half = 0.5 * sqrt(z <= 4398046511104.0 ? z : (double)NAN);
    const double sine = sin(half);
    const double cosine = cos(half);
    const double ratio = sine / half;
    *c1 = ratio * cosine;
    *c2 = 0.5 * (ratio * ratio);
    *c3 = z <= 4.0 ? dipole_vcf_cf4_stumpff_series_3(z) : (1.0 - ratio * cosine) / z;
}

/* For z >= 0 and s = sqrt(z): c_1 = sin(s)/s, c_2 = (1 - cos(s))/s^2, c_3 = (s - sin(s))/s^3 */
static inline void dipole_vcf_cf4_stumpff_123(double z, double *c1, double *c2, double *c3)
{
    if (z <= 0.0625) {
        *c1 = dipole_vcf_cf4_stumpff_small_1(z);
        *c2 = dipole_vcf_cf4_stumpff_small_2(z);
        *c3 = dipole_vcf_cf4_stumpff_small_3(z);
    } else {
        dipole_vcf_cf4_stumpff_123_far(z, c1, c2, c3);
    }
}

/* For z >= 0 and s = sqrt(z): c_1 = sin(s)/s, c_2 = (1 - cos(s))/s^2 */
static inline void dipole_vcf_cf4_stumpff_12(double z, double *c1, double *c2)
{
    if (z <= 0.00390625) {
        *c1 = dipole_vcf_cf4_stumpff_tiny_1(z);
        *c2 = dipole_vcf_cf4_stumpff_tiny_2(z);
    } else if (z <= 0.0625) {
        *c1 = dipole_vcf_cf4_stumpff_small_1(z);
        *c2 = dipole_vcf_cf4_stumpff_small_2(z);
    } else {
        dipole_vcf_cf4_stumpff_12_far(z, c1, c2);
    }
}

/* The largest absolute value of n numbers */
static double dipole_vcf_cf4_largest(const double *x, size_t n)
{
    double size = 0.0;
    for (size_t i = 0; i < n; i++) {
        size = fabs(x[i]) > size ? fabs(x[i]) : size;
    }
    return size;
}

/* Invert an n x n matrix, stored row by row, in place (Gauss-Jordan with row exchanges). Return 0 if it is
 * singular or not finite, else 1. Here n is always 12. */
static size_t dipole_vcf_cf4_invert(size_t n, double *restrict a)
{
    double row[12];
    size_t order[12];
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
                b[6] -= multiple * row[6];
                b[7] -= multiple * row[7];
                b[8] -= multiple * row[8];
                b[9] -= multiple * row[9];
                b[10] -= multiple * row[10];
                b[11] -= multiple * row[11];
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

/* Whether n numbers are all finite */
static int dipole_vcf_cf4_all_finite(const double *x, size_t n)
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
struct dipole_vcf_cf4_memory {
    size_t known; /* number of stored solutions */
    double first; /* error of the latest guess */
    size_t degree; /* degree of the extrapolation */
    size_t place; /* row of the latest solution */
    double guess[12]; /* initial guess for the next step */
    double values[32][12]; /* ring buffer, stored twice to avoid a modulo */
    double rate_1;
    size_t age_1; /* age of the stored inverse of the Newton matrix; 0 if none is stored */
    double inverse_1[144];
};

/* Row k: coefficients of the backward difference of order k, latest solution first. */
static const double dipole_vcf_cf4_differences[17][18] = {
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
static void dipole_vcf_cf4_count_sweeps(dipole_vcf_cf4_statistics *statistics, size_t block,
    size_t sweeps, int failed)
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
static void dipole_vcf_cf4_count_matrix(dipole_vcf_cf4_statistics *statistics)
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
static inline void dipole_vcf_cf4_difference(const struct dipole_vcf_cf4_memory *memory,
    size_t order, size_t first, double sign, double sum[static 12])
{
    double sum_0 = 0.0;
    double sum_1 = 0.0;
    double sum_2 = 0.0;
    double sum_3 = 0.0;
    double sum_4 = 0.0;
    double sum_5 = 0.0;
    double sum_6 = 0.0;
    double sum_7 = 0.0;
    double sum_8 = 0.0;
    double sum_9 = 0.0;
    double sum_10 = 0.0;
    double sum_11 = 0.0;
    for (size_t pair = (order - first) / 2 + 1; pair-- > 0;) {
        const size_t row = memory->place + 2 * pair;
        const size_t column = first + 2 * pair;
        const double newer = dipole_vcf_cf4_differences[order][column];
        const double older = dipole_vcf_cf4_differences[order][column + 1];
        sum_0 += sign * (newer * memory->values[row][0] + older * memory->values[row + 1][0]);
        sum_1 += sign * (newer * memory->values[row][1] + older * memory->values[row + 1][1]);
        sum_2 += sign * (newer * memory->values[row][2] + older * memory->values[row + 1][2]);
        sum_3 += sign * (newer * memory->values[row][3] + older * memory->values[row + 1][3]);
        sum_4 += sign * (newer * memory->values[row][4] + older * memory->values[row + 1][4]);
        sum_5 += sign * (newer * memory->values[row][5] + older * memory->values[row + 1][5]);
        sum_6 += sign * (newer * memory->values[row][6] + older * memory->values[row + 1][6]);
        sum_7 += sign * (newer * memory->values[row][7] + older * memory->values[row + 1][7]);
        sum_8 += sign * (newer * memory->values[row][8] + older * memory->values[row + 1][8]);
        sum_9 += sign * (newer * memory->values[row][9] + older * memory->values[row + 1][9]);
        sum_10 += sign * (newer * memory->values[row][10] + older * memory->values[row + 1][10]);
        sum_11 += sign * (newer * memory->values[row][11] + older * memory->values[row + 1][11]);
    }
    sum[0] = sum_0;
    sum[1] = sum_1;
    sum[2] = sum_2;
    sum[3] = sum_3;
    sum[4] = sum_4;
    sum[5] = sum_5;
    sum[6] = sum_6;
    sum[7] = sum_7;
    sum[8] = sum_8;
    sum[9] = sum_9;
    sum[10] = sum_10;
    sum[11] = sum_11;
}

/* The sum of the absolute values of the components of a backward difference. */
static double dipole_vcf_cf4_difference_size(const struct dipole_vcf_cf4_memory *memory,
    size_t order)
{
    double row[12];
    dipole_vcf_cf4_difference(memory, order, 0, 1.0, row);
    double size = 0.0;
    for (size_t i = 0; i < 12; i++) {
        size += fabs(row[i]);
    }
    return size;
}

/*
 * Store a solution. Then compute the guess for the next step by polynomial extrapolation of the latest
 * stored solutions.
 */
static inline void dipole_vcf_cf4_remember(struct dipole_vcf_cf4_memory *memory,
    const double solution[static 12])
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
        moved += fabs(solution[6] - memory->values[memory->place][6]);
        moved += fabs(solution[7] - memory->values[memory->place][7]);
        moved += fabs(solution[8] - memory->values[memory->place][8]);
        moved += fabs(solution[9] - memory->values[memory->place][9]);
        moved += fabs(solution[10] - memory->values[memory->place][10]);
        moved += fabs(solution[11] - memory->values[memory->place][11]);
        if (memory->first > 0.5 * moved) {
            memory->known = 0;
            memory->degree = 0;
        }
    }
    memory->first = 0.0;
    const size_t place = memory->place > 0 ? memory->place - 1 : 15;
    memory->place = place;
    memcpy(memory->values[place], solution, 12 * sizeof *solution);
    memcpy(memory->values[place + 16], solution, 12 * sizeof *solution);
    if (memory->known < 16) {
        memory->known++;
    }
    /* adapt the degree in each step until the ring buffer is full, then every 8 steps */
    if (memory->known < 16 || place % 8 == 0) {
        const double size = dipole_vcf_cf4_difference_size(memory, memory->degree);
        int grows = 0;
        if (memory->degree + 1 < memory->known) {
            const double higher = dipole_vcf_cf4_difference_size(memory, memory->degree + 1);
            grows = higher < size;
        }
        if (grows) {
            memory->degree++;
        } else if (memory->degree > 0) {
            const double lower = dipole_vcf_cf4_difference_size(memory, memory->degree - 1);
            if (size > lower) {
                memory->degree--;
            }
        }
    }
    /* extrapolate the polynomial through the latest solutions */
    dipole_vcf_cf4_difference(memory, memory->degree + 1, 1, -1.0, memory->guess);
}

/* One step. */
static inline int dipole_vcf_cf4_advance(double state[static 12], double h,
    struct dipole_vcf_cf4_memory *memory, dipole_vcf_cf4_statistics *statistics)
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
    double xi1_0, xi1_1, xi1_2, xi2_0, xi2_1, xi2_2, xi3_0, xi3_1, xi3_2, xi4_0, xi4_1, xi4_2;
    if (memory->known > 0) {
        xi1_0 = memory->guess[0];
        xi1_1 = memory->guess[1];
        xi1_2 = memory->guess[2];
        xi2_0 = memory->guess[3];
        xi2_1 = memory->guess[4];
        xi2_2 = memory->guess[5];
        xi3_0 = memory->guess[6];
        xi3_1 = memory->guess[7];
        xi3_2 = memory->guess[8];
        xi4_0 = memory->guess[9];
        xi4_1 = memory->guess[10];
        xi4_2 = memory->guess[11];
    } else {
        const double Wxi0_0 = 0.9900990099009901 * mu0;
        const double Wxi0_2 = 100.0 * mu2;
        xi1_0 = Wxi0_0;
        xi1_1 = mu1;
        xi1_2 = Wxi0_2;
        xi2_0 = Wxi0_0;
        xi2_1 = mu1;
        xi2_2 = Wxi0_2;
        xi3_0 = Wxi0_0;
        xi3_1 = mu1;
        xi3_2 = Wxi0_2;
        xi4_0 = Wxi0_0;
        xi4_1 = mu1;
        xi4_2 = Wxi0_2;
    }
    const double w1 = -0.5 * h;
    const double w2 = 0.5 * h;
    const double w59 = 0.16666666666666666 * h;
    const double w60 = 3.0 * g22;
    const double w61 = 3.26 - w60;
    const double w62 = 0.3 * g21;
    const double w63 = w61 - w62;
    const double w64 = sqrt(w63);
    const double w65 = w63 * w64;
    const double w66 = 1.5 / w65;
    const double w67 = w61 + w62;
    const double w68 = sqrt(w67);
    const double w69 = w67 * w68;
    const double w70 = 1.5 / w69;
    const double w71 = w66 - w70;
    const double w72 = -1.0 - w71;
    const double w73 = g21 * w72;
    const double w74 = w66 + w70;
    const double w75 = 0.1 * w74;
    const double w76 = g22 * w75;
    const double w77 = w73 + w76;
    const double w103 = 0.3333333333333333 * h;
    const double w104 = 0.25 * h;
    const double w107 = -0.08333333333333333 * h;
    const double w114 = g20 * w72;
    const double w117 = g20 * w75;
    const double w131 = 0.08333333333333333 * h;
    const double w132 = -0.16666666666666666 * h;
    const double w133 = -0.25 * h;
    /* the equations of xi1, xi2, xi3, xi4, n1, n2, n3, n4: Newton's method, 12 unknowns */
    double previous_1 = 0.0;
    double rate_1 = memory->known > 0 ? memory->rate_1 : 1.0;
    int make_1 = !(memory->age_1 > 0);
    size_t sweep = 0;
    int status = DIPOLE_VCF_CF4_NOT_CONVERGED;
    double s_p1_0_seen, s_p1_1_seen, s_p1_2_seen, d_xi1_0, d_xi1_1, d_xi1_2, d_xi2_0, d_xi2_1,
        d_xi2_2, d_xi3_0, d_xi3_1, d_xi3_2, d_xi4_0, d_xi4_1, d_xi4_2;
    do {
        sweep++;
        const double xE2_1_1 = xi1_1 * w2;
        const double xE2_1_0 = xi1_0 * w2;
        const double xE2_1_2 = xi1_2 * w2;
        const double w3 = xE2_1_0 * xE2_1_0 + xE2_1_1 * xE2_1_1 + xE2_1_2 * xE2_1_2;
        double c1_1, c2_1, c3_1;
        dipole_vcf_cf4_stumpff_123(w3, &c1_1, &c2_1, &c3_1);
        const double w5 = xE2_1_0 * c2_1;
        const double w6 = xE2_1_1 * w5;
        const double w8 = xE2_1_2 * c1_1;
        const double gE2_1_1 = w6 - w8;
        const double xE4_2_1 = h * xi3_1 + xi1_1 * w1;
        const double xE4_2_0 = h * xi3_0 + xi1_0 * w1;
        const double xE4_2_2 = h * xi3_2 + xi1_2 * w1;
        const double w9 = xE4_2_0 * xE4_2_0 + xE4_2_1 * xE4_2_1 + xE4_2_2 * xE4_2_2;
        double c1_2, c2_2, c3_2;
        dipole_vcf_cf4_stumpff_123(w9, &c1_2, &c2_2, &c3_2);
        const double w11 = xE4_2_1 * c2_2;
        const double w12 = xE4_2_1 * w11;
        const double w13 = xE4_2_2 * c2_2 * xE4_2_2;
        const double gE4_2_0 = 1.0 - (w12 + w13);
        const double w14 = xE2_1_0 * w5;
        const double w15 = xE2_1_2 * c2_1 * xE2_1_2;
        const double gE2_1_4 = 1.0 - (w14 + w15);
        const double w16 = xE4_2_0 * c2_2;
        const double w17 = xE4_2_1 * w16;
        const double w19 = xE4_2_2 * c1_2;
        const double gE4_2_1 = w17 - w19;
        const double w20 = xE2_1_0 * c1_1;
        const double w21 = xE2_1_1 * c2_1;
        const double w22 = xE2_1_2 * w21;
        const double gE2_1_7 = w20 + w22;
        const double w23 = xE4_2_1 * c1_2;
        const double w24 = xE4_2_2 * w16;
        const double gE4_2_2 = w23 + w24;
        const double E4_2_1 = gE2_1_1 * gE4_2_0 + gE2_1_4 * gE4_2_1 + gE2_1_7 * gE4_2_2;
        const double gE4_2_3 = w17 + w19;
        const double w25 = xE4_2_0 * w16;
        const double gE4_2_4 = 1.0 - (w13 + w25);
        const double w26 = xE4_2_2 * w11;
        const double w27 = xE4_2_0 * c1_2;
        const double gE4_2_5 = w26 - w27;
        const double E4_2_4 = gE2_1_1 * gE4_2_3 + gE2_1_4 * gE4_2_4 + gE2_1_7 * gE4_2_5;
        const double gE4_2_6 = w24 - w23;
        const double gE4_2_7 = w26 + w27;
        const double gE4_2_8 = 1.0 - (w12 + w25);
        const double E4_2_7 = gE2_1_1 * gE4_2_6 + gE2_1_4 * gE4_2_7 + gE2_1_7 * gE4_2_8;
        const double a_5_1 = xi4_0 * E4_2_1 + xi4_1 * E4_2_4 + xi4_2 * E4_2_7;
        const double w28 = xE2_1_1 * c1_1;
        const double w29 = xE2_1_2 * w5;
        const double gE2_1_2 = w28 + w29;
        const double gE2_1_5 = w22 - w20;
        const double w30 = xE2_1_1 * w21;
        const double gE2_1_8 = 1.0 - (w14 + w30);
        const double E4_2_2 = gE4_2_0 * gE2_1_2 + gE4_2_1 * gE2_1_5 + gE4_2_2 * gE2_1_8;
        const double E4_2_5 = gE4_2_3 * gE2_1_2 + gE4_2_4 * gE2_1_5 + gE4_2_5 * gE2_1_8;
        const double E4_2_8 = gE4_2_6 * gE2_1_2 + gE4_2_7 * gE2_1_5 + gE4_2_8 * gE2_1_8;
        const double a_5_2 = xi4_0 * E4_2_2 + xi4_1 * E4_2_5 + xi4_2 * E4_2_8;
        const double Q4_7 = g20 * E4_2_1 + g21 * E4_2_4 + g22 * E4_2_7;
        const double Q4_8 = g20 * E4_2_2 + g21 * E4_2_5 + g22 * E4_2_8;
        const double w31 = 3.26 - 3.0 * Q4_8;
        const double w32 = 0.3 * Q4_7;
        const double w33 = w31 - w32;
        const double w34 = 1.5 / (w33 * sqrt(w33));
        const double w35 = w31 + w32;
        const double w36 = 1.5 / (w35 * sqrt(w35));
        const double w37 = -1.0 - (w34 - w36);
        const double w38 = 0.1 * (w34 + w36);
        const double Nr4_0 = Q4_7 * w37 + Q4_8 * w38 + 0.99 * (a_5_1 * a_5_2);
        const double a_1 = xi2_0 * gE2_1_1 + xi2_1 * gE2_1_4 + xi2_2 * gE2_1_7;
        const double a_2 = xi2_0 * gE2_1_2 + xi2_1 * gE2_1_5 + xi2_2 * gE2_1_8;
        const double w39 = g22 * xE2_1_0 - g20 * xE2_1_2;
        const double w40 = g20 * xE2_1_1 - g21 * xE2_1_0;
        const double w41 = g21 * xE2_1_2 - g22 * xE2_1_1;
        const double Q2_7 = g21 + w39 * c1_1 + (xE2_1_0 * w40 - xE2_1_2 * w41) * c2_1;
        const double Q2_8 = g22 + w40 * c1_1 + (xE2_1_1 * w41 - xE2_1_0 * w39) * c2_1;
        const double w42 = 3.26 - 3.0 * Q2_8;
        const double w43 = 0.3 * Q2_7;
        const double w44 = w42 - w43;
        const double w45 = 1.5 / (w44 * sqrt(w44));
        const double w46 = w42 + w43;
        const double w47 = 1.5 / (w46 * sqrt(w46));
        const double w48 = -1.0 - (w45 - w47);
        const double w49 = 0.1 * (w45 + w47);
        const double sum_Nr4_0 = Nr4_0 + 2.0 * (Q2_7 * w48 + Q2_8 * w49 + 0.99 * (a_1 * a_2));
        const double s_nu2_0 = w1 * sum_Nr4_0;
        const double gE2_1_0 = 1.0 - (w15 + w30);
        const double gE2_1_3 = w6 + w8;
        const double gE2_1_6 = w29 - w28;
        const double a_0 = xi2_0 * gE2_1_0 + xi2_1 * gE2_1_3 + xi2_2 * gE2_1_6;
        const double Q2_6 = g20 + w41 * c1_1 + (xE2_1_2 * w39 - xE2_1_1 * w40) * c2_1;
        const double E4_2_0 = gE4_2_0 * gE2_1_0 + gE4_2_1 * gE2_1_3 + gE4_2_2 * gE2_1_6;
        const double E4_2_3 = gE4_2_3 * gE2_1_0 + gE4_2_4 * gE2_1_3 + gE4_2_5 * gE2_1_6;
        const double E4_2_6 = gE4_2_6 * gE2_1_0 + gE4_2_7 * gE2_1_3 + gE4_2_8 * gE2_1_6;
        const double a_5_0 = xi4_0 * E4_2_0 + xi4_1 * E4_2_3 + xi4_2 * E4_2_6;
        const double Q4_6 = g20 * E4_2_0 + g21 * E4_2_3 + g22 * E4_2_6;
        const double w50 = a_5_2 * a_5_0 + w37 * Q4_6;
        const double sum_Nr4_1 = -2.0 * (a_2 * a_0 + w48 * Q2_6) - w50;
        const double s_nu2_1 = w1 * sum_Nr4_1;
        const double Nr4_2 = 0.01 * (a_5_1 * a_5_0) - w38 * Q4_6;
        const double sum_Nr4_2 = Nr4_2 + 2.0 * (0.01 * (a_1 * a_0) - w49 * Q2_6);
        const double s_nu2_2 = w1 * sum_Nr4_2;
        const double w51 = xE2_1_2 * s_nu2_1 - xE2_1_1 * s_nu2_2;
        const double w53 = xE2_1_0 * s_nu2_2 - xE2_1_2 * s_nu2_0;
        const double w54 = xE2_1_1 * s_nu2_0 - xE2_1_0 * s_nu2_1;
        const double p1_11_2_0 = s_nu2_0 - w51 * c2_1 + (xE2_1_2 * w53 - xE2_1_1 * w54) * c3_1;
        const double m1_13_0 = Nr4_0 * gE2_1_0 - gE2_1_1 * w50 + gE2_1_2 * Nr4_2;
        const double m1_13_1 = Nr4_0 * gE2_1_3 - gE2_1_4 * w50 + gE2_1_5 * Nr4_2;
        const double m1_13_2 = Nr4_0 * gE2_1_6 - gE2_1_7 * w50 + gE2_1_8 * Nr4_2;
        const double w55 = xE4_2_2 * m1_13_1 - xE4_2_1 * m1_13_2;
        const double w57 = xE4_2_0 * m1_13_2 - xE4_2_2 * m1_13_0;
        const double w58 = xE4_2_1 * m1_13_0 - xE4_2_0 * m1_13_1;
        const double p1_13_0 = m1_13_0 - w55 * c2_2 + (xE4_2_2 * w57 - xE4_2_1 * w58) * c3_2;
        const double Nr1_0 = 0.99 * (xi1_1 * xi1_2) + w77;
        const double xE3_1_1 = xi2_1 * w2;
        const double xE3_1_0 = xi2_0 * w2;
        const double xE3_1_2 = xi2_2 * w2;
        const double w78 = xE3_1_0 * xE3_1_0 + xE3_1_1 * xE3_1_1 + xE3_1_2 * xE3_1_2;
        double c1_3, c2_3, c3_3;
        dipole_vcf_cf4_stumpff_123(w78, &c1_3, &c2_3, &c3_3);
        const double w80 = xE3_1_0 * c2_3;
        const double w81 = xE3_1_1 * w80;
        const double w83 = xE3_1_2 * c1_3;
        const double gE3_1_1 = w81 - w83;
        const double w84 = xE3_1_0 * w80;
        const double w85 = xE3_1_2 * c2_3 * xE3_1_2;
        const double gE3_1_4 = 1.0 - (w84 + w85);
        const double w86 = xE3_1_0 * c1_3;
        const double w87 = xE3_1_1 * c2_3;
        const double w88 = xE3_1_2 * w87;
        const double gE3_1_7 = w86 + w88;
        const double a_3_1 = xi3_0 * gE3_1_1 + xi3_1 * gE3_1_4 + xi3_2 * gE3_1_7;
        const double w89 = xE3_1_1 * c1_3;
        const double w90 = xE3_1_2 * w80;
        const double gE3_1_2 = w89 + w90;
        const double gE3_1_5 = w88 - w86;
        const double w91 = xE3_1_1 * w87;
        const double gE3_1_8 = 1.0 - (w84 + w91);
        const double a_3_2 = xi3_0 * gE3_1_2 + xi3_1 * gE3_1_5 + xi3_2 * gE3_1_8;
        const double w92 = g22 * xE3_1_0 - g20 * xE3_1_2;
        const double w93 = g20 * xE3_1_1 - g21 * xE3_1_0;
        const double w94 = g21 * xE3_1_2 - g22 * xE3_1_1;
        const double Q3_7 = g21 + w92 * c1_3 + (xE3_1_0 * w93 - xE3_1_2 * w94) * c2_3;
        const double Q3_8 = g22 + w93 * c1_3 + (xE3_1_1 * w94 - xE3_1_0 * w92) * c2_3;
        const double w95 = 3.26 - 3.0 * Q3_8;
        const double w96 = 0.3 * Q3_7;
        const double w97 = w95 - w96;
        const double w98 = 1.5 / (w97 * sqrt(w97));
        const double w99 = w95 + w96;
        const double w100 = 1.5 / (w99 * sqrt(w99));
        const double w101 = -1.0 - (w98 - w100);
        const double w102 = 0.1 * (w98 + w100);
        const double Nr3_0 = Q3_7 * w101 + Q3_8 * w102 + 0.99 * (a_3_1 * a_3_2);
        const double s_p1_0 = mu0 + w59 * (sum_Nr4_0 + Nr1_0) + Nr3_0 * w103;
        const double w105 = xi2_0 + xi3_0;
        const double w106 = w59 * w105;
        const double xe1_0 = xi1_0 * w104 + w106 + xi4_0 * w107;
        const double w108 = xi2_1 + xi3_1;
        const double w109 = w59 * w108;
        const double xe1_1 = xi1_1 * w104 + w109 + xi4_1 * w107;
        const double w110 = xi2_2 + xi3_2;
        const double w111 = w59 * w110;
        const double xe1_2 = xi1_2 * w104 + w111 + xi4_2 * w107;
        const double w112 = xe1_0 * xe1_0 + xe1_1 * xe1_1 + xe1_2 * xe1_2;
        double c1_4, c2_4, c3_4;
        dipole_vcf_cf4_stumpff_123(w112, &c1_4, &c2_4, &c3_4);
        const double w115 = xi1_0 * xi1_2 + w114;
        const double gE3_1_0 = 1.0 - (w85 + w91);
        const double gE3_1_3 = w81 + w83;
        const double gE3_1_6 = w90 - w89;
        const double a_3_0 = xi3_0 * gE3_1_0 + xi3_1 * gE3_1_3 + xi3_2 * gE3_1_6;
        const double Q3_6 = g20 + w94 * c1_3 + (xE3_1_2 * w92 - xE3_1_1 * w93) * c2_3;
        const double w116 = a_3_2 * a_3_0 + w101 * Q3_6;
        const double s_p1_1 = mu1 + w59 * (sum_Nr4_1 - w115) - w103 * w116;
        const double Nr1_2 = 0.01 * (xi1_0 * xi1_1) - w117;
        const double Nr3_2 = 0.01 * (a_3_1 * a_3_0) - w102 * Q3_6;
        const double s_p1_2 = mu2 + w59 * (sum_Nr4_2 + Nr1_2) + w103 * Nr3_2;
        const double w118 = xe1_2 * s_p1_1 - xe1_1 * s_p1_2;
        const double w120 = xe1_0 * s_p1_2 - s_p1_0 * xe1_2;
        const double w121 = s_p1_0 * xe1_1 - xe1_0 * s_p1_1;
        const double p1_11_0 = s_p1_0 - w118 * c2_4 + (xe1_2 * w120 - xe1_1 * w121) * c3_4;
        const double w122 = xe1_1 * c2_4;
        const double w123 = xe1_1 * w122;
        const double w124 = xe1_2 * c2_4 * xe1_2;
        const double ge1_0 = 1.0 - (w123 + w124);
        const double w125 = xe1_0 * c2_4;
        const double w126 = xe1_1 * w125;
        const double w128 = xe1_2 * c1_4;
        const double ge1_1 = w126 - w128;
        const double w129 = xe1_1 * c1_4;
        const double w130 = xe1_2 * w125;
        const double ge1_2 = w129 + w130;
        const double m1_6_2_0 = s_p1_0 * ge1_0 + s_p1_1 * ge1_1 + s_p1_2 * ge1_2;
        const double ye2_0 = xi1_0 * w131 + w105 * w132 + xi4_0 * w133;
        const double ye2_1 = xi1_1 * w131 + w108 * w132 + xi4_1 * w133;
        const double ye2_2 = xi1_2 * w131 + w110 * w132 + xi4_2 * w133;
        const double w134 = ye2_0 * ye2_0 + ye2_1 * ye2_1 + ye2_2 * ye2_2;
        double c2_5, c3_5;
        dipole_vcf_cf4_stumpff_23(w134, &c2_5, &c3_5);
        const double ge1_6 = w130 - w129;
        const double w136 = xe1_0 * c1_4;
        const double w137 = xe1_2 * w122;
        const double ge1_7 = w136 + w137;
        const double w138 = xe1_0 * w125;
        const double ge1_8 = 1.0 - (w123 + w138);
        const double m1_6_2_2 = s_p1_0 * ge1_6 + s_p1_1 * ge1_7 + s_p1_2 * ge1_8;
        const double ge1_3 = w126 + w128;
        const double ge1_4 = 1.0 - (w124 + w138);
        const double ge1_5 = w137 - w136;
        const double m1_6_2_1 = s_p1_0 * ge1_3 + s_p1_1 * ge1_4 + s_p1_2 * ge1_5;
        const double w139 = ye2_1 * m1_6_2_2 - ye2_2 * m1_6_2_1;
        const double w141 = ye2_0 * m1_6_2_1 - m1_6_2_0 * ye2_1;
        const double w142 = m1_6_2_0 * ye2_2 - ye2_0 * m1_6_2_2;
        const double p1_6_2_0 = m1_6_2_0 - w139 * c2_5 + (ye2_1 * w141 - ye2_2 * w142) * c3_5;
        const double M1_0 = p1_11_2_0 + w2 * p1_13_0 + 1.5 * p1_11_0 - 0.5 * p1_6_2_0;
        const double residual_0 = M1_0 - 1.01 * xi1_0;
        const double p1_11_2_1 = s_nu2_1 - w53 * c2_1 + (xE2_1_0 * w54 - xE2_1_2 * w51) * c3_1;
        const double p1_13_1 = m1_13_1 - w57 * c2_2 + (xE4_2_0 * w58 - xE4_2_2 * w55) * c3_2;
        const double p1_11_1 = s_p1_1 - w120 * c2_4 + (xe1_0 * w121 - xe1_2 * w118) * c3_4;
        const double p1_6_2_1 = m1_6_2_1 - w142 * c2_5 + (ye2_2 * w139 - ye2_0 * w141) * c3_5;
        const double M1_1 = p1_11_2_1 + w2 * p1_13_1 + 1.5 * p1_11_1 - 0.5 * p1_6_2_1;
        const double residual_1 = M1_1 - xi1_1;
        const double p1_11_2_2 = s_nu2_2 - w54 * c2_1 + (xE2_1_1 * w51 - xE2_1_0 * w53) * c3_1;
        const double p1_13_2 = m1_13_2 - w58 * c2_2 + (xE4_2_1 * w55 - xE4_2_0 * w57) * c3_2;
        const double p1_11_2 = s_p1_2 - w121 * c2_4 + (xe1_1 * w118 - xe1_0 * w120) * c3_4;
        const double p1_6_2_2 = m1_6_2_2 - w141 * c2_5 + (ye2_0 * w142 - ye2_1 * w139) * c3_5;
        const double M1_2 = p1_11_2_2 + w2 * p1_13_2 + 1.5 * p1_11_2 - 0.5 * p1_6_2_2;
        const double residual_2 = M1_2 - 0.01 * xi1_2;
        const double w143 = 0.5 * (p1_11_0 + p1_6_2_0);
        const double w144 = xE3_1_1 * Nr3_2 + xE3_1_2 * w116;
        const double w146 = xE3_1_0 * Nr3_2 - xE3_1_2 * Nr3_0;
        const double w147 = xE3_1_0 * w116 + xE3_1_1 * Nr3_0;
        const double M2_0 = w143
            + w1 * (Nr3_0 + w144 * c2_3 + (xE3_1_2 * w146 - xE3_1_1 * w147) * c3_3);
        const double p_2_0 = 1.01 * a_0;
        const double p_2_2 = 0.01 * a_2;
        const double a_4_0 = gE2_1_0 * p_2_0 + gE2_1_1 * a_1 + gE2_1_2 * p_2_2;
        const double residual_2_0 = M2_0 - a_4_0;
        const double w148 = 0.5 * (p1_11_1 + p1_6_2_1);
        const double M2_1 = w148
            + w1 * ((xE3_1_2 * w144 + xE3_1_0 * w147) * c3_3 - (w116 + w146 * c2_3));
        const double a_4_1 = gE2_1_3 * p_2_0 + gE2_1_4 * a_1 + gE2_1_5 * p_2_2;
        const double residual_2_1 = M2_1 - a_4_1;
        const double w149 = 0.5 * (p1_11_2 + p1_6_2_2);
        const double M2_2 = w149
            + w1 * (Nr3_2 - w147 * c2_3 - (xE3_1_0 * w146 + xE3_1_1 * w144) * c3_3);
        const double a_4_2 = gE2_1_6 * p_2_0 + gE2_1_7 * a_1 + gE2_1_8 * p_2_2;
        const double residual_2_2 = M2_2 - a_4_2;
        const double M3_0 = w143 + w1 * p1_13_0;
        const double p_3_0 = 1.01 * a_3_0;
        const double p_3_2 = 0.01 * a_3_2;
        const double a_7_0 = gE3_1_0 * p_3_0 + gE3_1_1 * a_3_1 + gE3_1_2 * p_3_2;
        const double residual_3_0 = M3_0 - a_7_0;
        const double M3_1 = w148 + w1 * p1_13_1;
        const double a_7_1 = gE3_1_3 * p_3_0 + gE3_1_4 * a_3_1 + gE3_1_5 * p_3_2;
        const double residual_3_1 = M3_1 - a_7_1;
        const double M3_2 = w149 + w1 * p1_13_2;
        const double a_7_2 = gE3_1_6 * p_3_0 + gE3_1_7 * a_3_1 + gE3_1_8 * p_3_2;
        const double residual_3_2 = M3_2 - a_7_2;
        const double M4_0 = 1.5 * p1_6_2_0 - 0.5 * p1_11_0;
        const double p_4_0 = 1.01 * a_5_0;
        const double p_4_2 = 0.01 * a_5_2;
        const double a_9_0 = E4_2_0 * p_4_0 + E4_2_1 * a_5_1 + E4_2_2 * p_4_2;
        const double residual_4_0 = M4_0 - a_9_0;
        const double M4_1 = 1.5 * p1_6_2_1 - 0.5 * p1_11_1;
        const double a_9_1 = E4_2_3 * p_4_0 + E4_2_4 * a_5_1 + E4_2_5 * p_4_2;
        const double residual_4_1 = M4_1 - a_9_1;
        const double M4_2 = 1.5 * p1_6_2_2 - 0.5 * p1_11_2;
        const double a_9_2 = E4_2_6 * p_4_0 + E4_2_7 * a_5_1 + E4_2_8 * p_4_2;
        const double residual_4_2 = M4_2 - a_9_2;
        s_p1_0_seen = s_p1_0;
        s_p1_1_seen = s_p1_1;
        s_p1_2_seen = s_p1_2;
        if (make_1) {
            const double w150 = 0.165 * xi1_2;
            const double w151 = 0.08333333333333333 * mu2;
            const double w152 = 0.165 * xi1_1;
            const double w153 = -0.08333333333333333 * mu1;
            const double w154 = -0.66 * h;
            const double w155 = 0.33 * h;
            const double w156 = xi3_2 * w155;
            const double w157 = xi3_1 * w155;
            const double w158 = 0.165 * xi4_2;
            const double w159 = -0.08333333333333333 * mu2;
            const double w160 = 0.165 * xi4_1;
            const double w161 = 0.08333333333333333 * mu1;
            const double w162 = -0.16666666666666666 * xi1_2;
            const double w163 = -0.16666666666666666 * xi1_0;
            const double w164 = 0.08333333333333333 * mu0;
            const double w165 = 0.6666666666666666 * h;
            const double w166 = -0.3333333333333333 * h;
            const double w167 = xi3_2 * w166;
            const double w168 = xi3_0 * w166;
            const double w169 = -0.16666666666666666 * xi4_2;
            const double w170 = -0.16666666666666666 * xi4_0;
            const double w171 = -0.08333333333333333 * mu0;
            const double w172 = 0.0016666666666666668 * xi1_1;
            const double w173 = 0.0016666666666666668 * xi1_0;
            const double w174 = -0.006666666666666667 * h;
            const double w175 = 0.0033333333333333335 * h;
            const double w176 = xi3_1 * w175;
            const double w177 = xi3_0 * w175;
            const double w178 = 0.0016666666666666668 * xi4_1;
            const double w179 = 0.0016666666666666668 * xi4_0;
            const double w180 = 0.16666666666666666 * mu2;
            const double w181 = w150 + w180;
            const double w182 = -0.16666666666666666 * mu1;
            const double w183 = w152 + w182;
            const double w184 = 0.33 * xi2_2;
            const double w185 = -0.005 * xi1_2;
            const double w186 = 0.33 * xi2_1;
            const double w187 = 0.5 * xi1_1;
            const double w188 = 0.165 * h;
            const double w189 = xi4_2 * w188;
            const double w190 = xi4_1 * w188;
            const double w191 = -0.16666666666666666 * mu2;
            const double w192 = w162 + w191;
            const double w193 = 0.16666666666666666 * mu0;
            const double w194 = w163 + w193;
            const double w195 = -0.3333333333333333 * xi2_2;
            const double w196 = -0.3333333333333333 * xi2_0;
            const double w197 = -0.495 * xi1_0;
            const double w198 = xi4_2 * w132;
            const double w199 = xi4_0 * w132;
            const double w200 = 0.16666666666666666 * mu1;
            const double w201 = w172 + w200;
            const double w202 = -0.16666666666666666 * mu0;
            const double w203 = w173 + w202;
            const double w204 = 0.0033333333333333335 * xi2_1;
            const double w205 = 0.0033333333333333335 * xi2_0;
            const double w206 = 0.0016666666666666668 * h;
            const double w207 = xi4_1 * w206;
            const double w208 = xi4_0 * w206;
            const double w209 = 0.33 * xi3_2;
            const double w210 = -0.005 * xi2_2;
            const double w211 = 0.33 * xi3_1;
            const double w212 = 0.5 * xi2_1;
            const double w213 = -0.33 * h;
            const double w214 = -0.3333333333333333 * xi3_2;
            const double w215 = -0.3333333333333333 * xi3_0;
            const double w216 = -0.495 * xi2_0;
            const double w217 = 0.0033333333333333335 * xi3_1;
            const double w218 = 0.0033333333333333335 * xi3_0;
            const double w219 = -0.0033333333333333335 * h;
            const double w220 = 0.3333333333333333 * mu2;
            const double w221 = -0.3333333333333333 * mu1;
            const double w222 = -0.01 * xi3_2;
            const double w223 = -0.3333333333333333 * mu2;
            const double w224 = 0.3333333333333333 * mu0;
            const double w225 = -0.99 * xi3_0;
            const double w226 = 0.3333333333333333 * mu1;
            const double w227 = -0.3333333333333333 * mu0;
            memory->inverse_1[0] = 1.01;
            memory->inverse_1[1] = -h * (w150 + w151);
            memory->inverse_1[2] = -h * (w152 + w153);
            memory->inverse_1[3] = 0.0;
            memory->inverse_1[4] = -xi2_2 * w154;
            memory->inverse_1[5] = -xi2_1 * w154;
            memory->inverse_1[6] = 0.0;
            memory->inverse_1[7] = -w156;
            memory->inverse_1[8] = -w157;
            memory->inverse_1[9] = 0.0;
            memory->inverse_1[10] = -h * (w158 + w159);
            memory->inverse_1[11] = -h * (w160 + w161);
            memory->inverse_1[12] = -h * (w159 + w162);
            memory->inverse_1[13] = 1.0;
            memory->inverse_1[14] = -h * (w163 + w164);
            memory->inverse_1[15] = -xi2_2 * w165;
            memory->inverse_1[16] = 0.0;
            memory->inverse_1[17] = -xi2_0 * w165;
            memory->inverse_1[18] = -w167;
            memory->inverse_1[19] = 0.0;
            memory->inverse_1[20] = -w168;
            memory->inverse_1[21] = -h * (w151 + w169);
            memory->inverse_1[22] = 0.0;
            memory->inverse_1[23] = -h * (w170 + w171);
            memory->inverse_1[24] = -h * (w161 + w172);
            memory->inverse_1[25] = -h * (w171 + w173);
            memory->inverse_1[26] = 0.01;
            memory->inverse_1[27] = -xi2_1 * w174;
            memory->inverse_1[28] = -xi2_0 * w174;
            memory->inverse_1[29] = 0.0;
            memory->inverse_1[30] = -w176;
            memory->inverse_1[31] = -w177;
            memory->inverse_1[32] = 0.0;
            memory->inverse_1[33] = -h * (w153 + w178);
            memory->inverse_1[34] = -h * (w164 + w179);
            memory->inverse_1[35] = 0.0;
            memory->inverse_1[36] = 0.0;
            memory->inverse_1[37] = -h * (0.5 * xi2_2 + w181);
            memory->inverse_1[38] = -h * (w183 - 0.005 * xi2_1);
            memory->inverse_1[39] = 1.01;
            memory->inverse_1[40] = -h * (w180 + w185 + w184);
            memory->inverse_1[41] = -h * (w182 + w187 + w186);
            memory->inverse_1[42] = 0.0;
            memory->inverse_1[43] = -h * (w180 - 0.165 * xi3_2);
            memory->inverse_1[44] = -h * (w182 - 0.165 * xi3_1);
            memory->inverse_1[45] = 0.0;
            memory->inverse_1[46] = -w189;
            memory->inverse_1[47] = -w190;
            memory->inverse_1[48] = -h * (w192 - 0.495 * xi2_2);
            memory->inverse_1[49] = 0.0;
            memory->inverse_1[50] = -h * (w194 - 0.005 * xi2_0);
            memory->inverse_1[51] = -h * (w185 + w191 + w195);
            memory->inverse_1[52] = 1.0;
            memory->inverse_1[53] = -h * (w193 + w197 + w196);
            memory->inverse_1[54] = -h * (0.16666666666666666 * xi3_2 + w191);
            memory->inverse_1[55] = 0.0;
            memory->inverse_1[56] = -h * (0.16666666666666666 * xi3_0 + w193);
            memory->inverse_1[57] = -w198;
            memory->inverse_1[58] = 0.0;
            memory->inverse_1[59] = -w199;
            memory->inverse_1[60] = -h * (w201 - 0.495 * xi2_1);
            memory->inverse_1[61] = -h * (0.5 * xi2_0 + w203);
            memory->inverse_1[62] = 0.0;
            memory->inverse_1[63] = -h * (w187 + w200 + w204);
            memory->inverse_1[64] = -h * (w197 + w202 + w205);
            memory->inverse_1[65] = 0.01;
            memory->inverse_1[66] = -h * (w200 - 0.0016666666666666668 * xi3_1);
            memory->inverse_1[67] = -h * (w202 - 0.0016666666666666668 * xi3_0);
            memory->inverse_1[68] = 0.0;
            memory->inverse_1[69] = -w207;
            memory->inverse_1[70] = -w208;
            memory->inverse_1[71] = 0.0;
            memory->inverse_1[72] = 0.0;
            memory->inverse_1[73] = -h * w181;
            memory->inverse_1[74] = -h * w183;
            memory->inverse_1[75] = 0.0;
            memory->inverse_1[76] = -h * (w180 + w184 + 0.5 * xi3_2);
            memory->inverse_1[77] = -h * (w182 + w186 - 0.005 * xi3_1);
            memory->inverse_1[78] = 1.01;
            memory->inverse_1[79] = -h * (w180 + w210 + w209);
            memory->inverse_1[80] = -h * (w182 + w212 + w211);
            memory->inverse_1[81] = 0.0;
            memory->inverse_1[82] = -xi4_2 * w213;
            memory->inverse_1[83] = -xi4_1 * w213;
            memory->inverse_1[84] = -h * w192;
            memory->inverse_1[85] = 0.0;
            memory->inverse_1[86] = -h * w194;
            memory->inverse_1[87] = -h * (w191 + w195 - 0.495 * xi3_2);
            memory->inverse_1[88] = 0.0;
            memory->inverse_1[89] = -h * (w193 + w196 - 0.005 * xi3_0);
            memory->inverse_1[90] = -h * (w191 + w210 + w214);
            memory->inverse_1[91] = 1.0;
            memory->inverse_1[92] = -h * (w193 + w216 + w215);
            memory->inverse_1[93] = -xi4_2 * w103;
            memory->inverse_1[94] = 0.0;
            memory->inverse_1[95] = -xi4_0 * w103;
            memory->inverse_1[96] = -h * w201;
            memory->inverse_1[97] = -h * w203;
            memory->inverse_1[98] = 0.0;
            memory->inverse_1[99] = -h * (w200 + w204 - 0.495 * xi3_1);
            memory->inverse_1[100] = -h * (w202 + w205 + 0.5 * xi3_0);
            memory->inverse_1[101] = 0.0;
            memory->inverse_1[102] = -h * (w200 + w212 + w217);
            memory->inverse_1[103] = -h * (w202 + w216 + w218);
            memory->inverse_1[104] = 0.01;
            memory->inverse_1[105] = -xi4_1 * w219;
            memory->inverse_1[106] = -xi4_0 * w219;
            memory->inverse_1[107] = 0.0;
            memory->inverse_1[108] = 0.0;
            memory->inverse_1[109] = -h * (0.25 * mu2 + w150);
            memory->inverse_1[110] = -h * (w152 - 0.25 * mu1);
            memory->inverse_1[111] = 0.0;
            memory->inverse_1[112] = -h * (w184 + w220);
            memory->inverse_1[113] = -h * (w186 + w221);
            memory->inverse_1[114] = 0.0;
            memory->inverse_1[115] = -h * (w209 + w220 + xi4_2);
            memory->inverse_1[116] = -h * (w211 + w221 - 0.01 * xi4_1);
            memory->inverse_1[117] = 1.01;
            memory->inverse_1[118] = -h * (w151 + w222 + w158);
            memory->inverse_1[119] = -h * (xi3_1 + w153 + w160);
            memory->inverse_1[120] = -h * (w162 - 0.25 * mu2);
            memory->inverse_1[121] = 0.0;
            memory->inverse_1[122] = -h * (0.25 * mu0 + w163);
            memory->inverse_1[123] = -h * (w195 + w223);
            memory->inverse_1[124] = 0.0;
            memory->inverse_1[125] = -h * (w196 + w224);
            memory->inverse_1[126] = -h * (w214 + w223 - 0.99 * xi4_2);
            memory->inverse_1[127] = 0.0;
            memory->inverse_1[128] = -h * (w215 + w224 - 0.01 * xi4_0);
            memory->inverse_1[129] = -h * (w159 + w222 + w169);
            memory->inverse_1[130] = 1.0;
            memory->inverse_1[131] = -h * (w164 + w225 + w170);
            memory->inverse_1[132] = -h * (0.25 * mu1 + w172);
            memory->inverse_1[133] = -h * (w173 - 0.25 * mu0);
            memory->inverse_1[134] = 0.0;
            memory->inverse_1[135] = -h * (w204 + w226);
            memory->inverse_1[136] = -h * (w205 + w227);
            memory->inverse_1[137] = 0.0;
            memory->inverse_1[138] = -h * (w217 + w226 - 0.99 * xi4_1);
            memory->inverse_1[139] = -h * (w218 + w227 + xi4_0);
            memory->inverse_1[140] = 0.0;
            memory->inverse_1[141] = -h * (xi3_1 + w161 + w178);
            memory->inverse_1[142] = -h * (w171 + w225 + w179);
            memory->inverse_1[143] = 0.01;
            memory->age_1 = dipole_vcf_cf4_invert(12, memory->inverse_1);
            if (memory->age_1 > 0) {
                dipole_vcf_cf4_count_matrix(statistics);
            }
        }
        d_xi1_0 = memory->inverse_1[0] * residual_0 + memory->inverse_1[1] * residual_1
            + (memory->inverse_1[2] * residual_2 + memory->inverse_1[3] * residual_2_0)
            + (memory->inverse_1[4] * residual_2_1 + memory->inverse_1[5] * residual_2_2)
            + (memory->inverse_1[6] * residual_3_0 + memory->inverse_1[7] * residual_3_1)
            + (memory->inverse_1[8] * residual_3_2 + memory->inverse_1[9] * residual_4_0)
            + (memory->inverse_1[10] * residual_4_1 + memory->inverse_1[11] * residual_4_2);
        d_xi1_1 = memory->inverse_1[12] * residual_0 + memory->inverse_1[13] * residual_1
            + (memory->inverse_1[14] * residual_2 + memory->inverse_1[15] * residual_2_0)
            + (memory->inverse_1[16] * residual_2_1 + memory->inverse_1[17] * residual_2_2)
            + (memory->inverse_1[18] * residual_3_0 + memory->inverse_1[19] * residual_3_1)
            + (memory->inverse_1[20] * residual_3_2 + memory->inverse_1[21] * residual_4_0)
            + (memory->inverse_1[22] * residual_4_1 + memory->inverse_1[23] * residual_4_2);
        d_xi1_2 = memory->inverse_1[24] * residual_0 + memory->inverse_1[25] * residual_1
            + (memory->inverse_1[26] * residual_2 + memory->inverse_1[27] * residual_2_0)
            + (memory->inverse_1[28] * residual_2_1 + memory->inverse_1[29] * residual_2_2)
            + (memory->inverse_1[30] * residual_3_0 + memory->inverse_1[31] * residual_3_1)
            + (memory->inverse_1[32] * residual_3_2 + memory->inverse_1[33] * residual_4_0)
            + (memory->inverse_1[34] * residual_4_1 + memory->inverse_1[35] * residual_4_2);
        d_xi2_0 = memory->inverse_1[36] * residual_0 + memory->inverse_1[37] * residual_1
            + (memory->inverse_1[38] * residual_2 + memory->inverse_1[39] * residual_2_0)
            + (memory->inverse_1[40] * residual_2_1 + memory->inverse_1[41] * residual_2_2)
            + (memory->inverse_1[42] * residual_3_0 + memory->inverse_1[43] * residual_3_1)
            + (memory->inverse_1[44] * residual_3_2 + memory->inverse_1[45] * residual_4_0)
            + (memory->inverse_1[46] * residual_4_1 + memory->inverse_1[47] * residual_4_2);
        d_xi2_1 = memory->inverse_1[48] * residual_0 + memory->inverse_1[49] * residual_1
            + (memory->inverse_1[50] * residual_2 + memory->inverse_1[51] * residual_2_0)
            + (memory->inverse_1[52] * residual_2_1 + memory->inverse_1[53] * residual_2_2)
            + (memory->inverse_1[54] * residual_3_0 + memory->inverse_1[55] * residual_3_1)
            + (memory->inverse_1[56] * residual_3_2 + memory->inverse_1[57] * residual_4_0)
            + (memory->inverse_1[58] * residual_4_1 + memory->inverse_1[59] * residual_4_2);
        d_xi2_2 = memory->inverse_1[60] * residual_0 + memory->inverse_1[61] * residual_1
            + (memory->inverse_1[62] * residual_2 + memory->inverse_1[63] * residual_2_0)
            + (memory->inverse_1[64] * residual_2_1 + memory->inverse_1[65] * residual_2_2)
            + (memory->inverse_1[66] * residual_3_0 + memory->inverse_1[67] * residual_3_1)
            + (memory->inverse_1[68] * residual_3_2 + memory->inverse_1[69] * residual_4_0)
            + (memory->inverse_1[70] * residual_4_1 + memory->inverse_1[71] * residual_4_2);
        d_xi3_0 = memory->inverse_1[72] * residual_0 + memory->inverse_1[73] * residual_1
            + (memory->inverse_1[74] * residual_2 + memory->inverse_1[75] * residual_2_0)
            + (memory->inverse_1[76] * residual_2_1 + memory->inverse_1[77] * residual_2_2)
            + (memory->inverse_1[78] * residual_3_0 + memory->inverse_1[79] * residual_3_1)
            + (memory->inverse_1[80] * residual_3_2 + memory->inverse_1[81] * residual_4_0)
            + (memory->inverse_1[82] * residual_4_1 + memory->inverse_1[83] * residual_4_2);
        d_xi3_1 = memory->inverse_1[84] * residual_0 + memory->inverse_1[85] * residual_1
            + (memory->inverse_1[86] * residual_2 + memory->inverse_1[87] * residual_2_0)
            + (memory->inverse_1[88] * residual_2_1 + memory->inverse_1[89] * residual_2_2)
            + (memory->inverse_1[90] * residual_3_0 + memory->inverse_1[91] * residual_3_1)
            + (memory->inverse_1[92] * residual_3_2 + memory->inverse_1[93] * residual_4_0)
            + (memory->inverse_1[94] * residual_4_1 + memory->inverse_1[95] * residual_4_2);
        d_xi3_2 = memory->inverse_1[96] * residual_0 + memory->inverse_1[97] * residual_1
            + (memory->inverse_1[98] * residual_2 + memory->inverse_1[99] * residual_2_0)
            + (memory->inverse_1[100] * residual_2_1 + memory->inverse_1[101] * residual_2_2)
            + (memory->inverse_1[102] * residual_3_0 + memory->inverse_1[103] * residual_3_1)
            + (memory->inverse_1[104] * residual_3_2 + memory->inverse_1[105] * residual_4_0)
            + (memory->inverse_1[106] * residual_4_1 + memory->inverse_1[107] * residual_4_2);
        d_xi4_0 = memory->inverse_1[108] * residual_0 + memory->inverse_1[109] * residual_1
            + (memory->inverse_1[110] * residual_2 + memory->inverse_1[111] * residual_2_0)
            + (memory->inverse_1[112] * residual_2_1 + memory->inverse_1[113] * residual_2_2)
            + (memory->inverse_1[114] * residual_3_0 + memory->inverse_1[115] * residual_3_1)
            + (memory->inverse_1[116] * residual_3_2 + memory->inverse_1[117] * residual_4_0)
            + (memory->inverse_1[118] * residual_4_1 + memory->inverse_1[119] * residual_4_2);
        d_xi4_1 = memory->inverse_1[120] * residual_0 + memory->inverse_1[121] * residual_1
            + (memory->inverse_1[122] * residual_2 + memory->inverse_1[123] * residual_2_0)
            + (memory->inverse_1[124] * residual_2_1 + memory->inverse_1[125] * residual_2_2)
            + (memory->inverse_1[126] * residual_3_0 + memory->inverse_1[127] * residual_3_1)
            + (memory->inverse_1[128] * residual_3_2 + memory->inverse_1[129] * residual_4_0)
            + (memory->inverse_1[130] * residual_4_1 + memory->inverse_1[131] * residual_4_2);
        d_xi4_2 = memory->inverse_1[132] * residual_0 + memory->inverse_1[133] * residual_1
            + (memory->inverse_1[134] * residual_2 + memory->inverse_1[135] * residual_2_0)
            + (memory->inverse_1[136] * residual_2_1 + memory->inverse_1[137] * residual_2_2)
            + (memory->inverse_1[138] * residual_3_0 + memory->inverse_1[139] * residual_3_1)
            + (memory->inverse_1[140] * residual_3_2 + memory->inverse_1[141] * residual_4_0)
            + (memory->inverse_1[142] * residual_4_1 + memory->inverse_1[143] * residual_4_2);
        const double change = fabs(d_xi1_0) + fabs(d_xi1_1) + (fabs(d_xi1_2) + fabs(d_xi2_0))
            + (fabs(d_xi2_1) + fabs(d_xi2_2)) + (fabs(d_xi3_0) + fabs(d_xi3_1))
            + (fabs(d_xi3_2) + fabs(d_xi4_0)) + (fabs(d_xi4_1) + fabs(d_xi4_2));
        const double scale = fabs(xi1_0) + fabs(xi1_1) + (fabs(xi1_2) + fabs(xi2_0))
            + (fabs(xi2_1) + fabs(xi2_2)) + (fabs(xi3_0) + fabs(xi3_1))
            + (fabs(xi3_2) + fabs(xi4_0)) + (fabs(xi4_1) + fabs(xi4_2));
        xi1_0 += d_xi1_0;
        xi1_1 += d_xi1_1;
        xi1_2 += d_xi1_2;
        xi2_0 += d_xi2_0;
        xi2_1 += d_xi2_1;
        xi2_2 += d_xi2_2;
        xi3_0 += d_xi3_0;
        xi3_1 += d_xi3_1;
        xi3_2 += d_xi3_2;
        xi4_0 += d_xi4_0;
        xi4_1 += d_xi4_1;
        xi4_2 += d_xi4_2;
        if (previous_1 > 0.0) {
            rate_1 = change / previous_1;
        } else {
            memory->first += change;
        }
        const int contracts = rate_1 < 0.5;
        const int converged = contracts
            ? change * (rate_1 + 0.0001220703125) <= 8.881784197001252e-16 * scale : (sweep > 1
            && (change * rate_1 <= 8.881784197001252e-16 * scale * (1.0 - rate_1) || (rate_1 >= 1.0
            && (change <= 5.684341886080802e-14 * scale
            || (change * fabs(h) <= 7.105427357601002e-15 * dipole_vcf_cf4_largest(state, 9)
            && change * fabs(h) <= 7.105427357601002e-15 * dipole_vcf_cf4_largest(state + 9, 3))))));
        status = isfinite(change) ? (memory->age_1 > 0 && converged ? DIPOLE_VCF_CF4_OK
            : DIPOLE_VCF_CF4_NOT_CONVERGED) : DIPOLE_VCF_CF4_NOT_FINITE;
        make_1 = 0;
        previous_1 = change;
    } while (status == DIPOLE_VCF_CF4_NOT_CONVERGED && sweep < 100 && !!(memory->age_1 > 0));
    if (status != DIPOLE_VCF_CF4_OK && (status == DIPOLE_VCF_CF4_NOT_CONVERGED
        && !(memory->age_1 > 0))) {
        status = DIPOLE_VCF_CF4_SINGULAR;
    }
    dipole_vcf_cf4_count_sweeps(statistics, 0, sweep, status != DIPOLE_VCF_CF4_OK);
    if (status != DIPOLE_VCF_CF4_OK) {
        return status;
    }
    memory->rate_1 = rate_1;
    const double solution[12] = {xi1_0, xi1_1, xi1_2, xi2_0, xi2_1, xi2_2, xi3_0, xi3_1, xi3_2,
        xi4_0, xi4_1, xi4_2};
    dipole_vcf_cf4_remember(memory, solution);
    const double w228 = xi2_1 + xi3_1;
    const double w229 = w59 * w228;
    const double xe1_1_ = xi1_1 * w104 + w229 + xi4_1 * w107;
    const double w230 = xi2_0 + xi3_0;
    const double w231 = w59 * w230;
    const double xe1_0_ = xi1_0 * w104 + w231 + xi4_0 * w107;
    const double w232 = xi2_2 + xi3_2;
    const double w233 = w59 * w232;
    const double xe1_2_ = xi1_2 * w104 + w233 + xi4_2 * w107;
    const double w234 = xe1_0_ * xe1_0_ + xe1_1_ * xe1_1_ + xe1_2_ * xe1_2_;
    double c1_5, c2_6;
    dipole_vcf_cf4_stumpff_12(w234, &c1_5, &c2_6);
    const double w236 = xe1_1_ * c2_6;
    const double w237 = xe1_1_ * w236;
    const double w238 = xe1_2_ * c2_6 * xe1_2_;
    const double ge1_0_ = 1.0 - (w237 + w238);
    const double xe2_1 = w229 + xi1_1 * w107 + xi4_1 * w104;
    const double ye2_0_ = xi1_0 * w131 + w132 * w230 + xi4_0 * w133;
    const double ye2_1_ = xi1_1 * w131 + w132 * w228 + xi4_1 * w133;
    const double ye2_2_ = xi1_2 * w131 + w132 * w232 + xi4_2 * w133;
    const double w239 = ye2_0_ * ye2_0_ + ye2_1_ * ye2_1_ + ye2_2_ * ye2_2_;
    double c1_6, c2_7;
    dipole_vcf_cf4_stumpff_12(w239, &c1_6, &c2_7);
    const double w241 = xe2_1 * c2_7;
    const double w242 = xe2_1 * w241;
    const double xe2_2 = w233 + xi1_2 * w107 + xi4_2 * w104;
    const double w243 = xe2_2 * c2_7 * xe2_2;
    const double ge2_0 = 1.0 - (w242 + w243);
    const double w245 = xe1_2_ * c1_5;
    const double w246 = xe1_0_ * c2_6;
    const double w247 = xe1_1_ * w246;
    const double ge1_3_ = w245 + w247;
    const double xe2_0 = w231 + xi1_0 * w107 + xi4_0 * w104;
    const double w248 = xe2_0 * c2_7;
    const double w249 = xe2_1 * w248;
    const double w251 = xe2_2 * c1_6;
    const double ge2_1 = w249 - w251;
    const double w252 = xe1_2_ * w246;
    const double w253 = xe1_1_ * c1_5;
    const double ge1_6_ = w252 - w253;
    const double w254 = xe2_1 * c1_6;
    const double w255 = xe2_2 * w248;
    const double ge2_2 = w254 + w255;
    const double e2_0 = ge1_0_ * ge2_0 + ge1_3_ * ge2_1 + ge1_6_ * ge2_2;
    const double ge2_3 = w249 + w251;
    const double w256 = xe2_0 * w248;
    const double ge2_4 = 1.0 - (w243 + w256);
    const double w257 = w241 * xe2_2;
    const double w258 = xe2_0 * c1_6;
    const double ge2_5 = w257 - w258;
    const double e2_3 = ge1_0_ * ge2_3 + ge1_3_ * ge2_4 + ge1_6_ * ge2_5;
    const double ge2_6 = w255 - w254;
    const double ge2_7 = w257 + w258;
    const double ge2_8 = 1.0 - (w242 + w256);
    const double e2_6 = ge1_0_ * ge2_6 + ge1_3_ * ge2_7 + ge1_6_ * ge2_8;
    const double ge1_1_ = w247 - w245;
    const double w259 = xe1_0_ * w246;
    const double ge1_4_ = 1.0 - (w238 + w259);
    const double w260 = xe1_0_ * c1_5;
    const double w261 = xe1_2_ * w236;
    const double ge1_7_ = w260 + w261;
    const double e2_1 = ge2_0 * ge1_1_ + ge2_1 * ge1_4_ + ge2_2 * ge1_7_;
    const double e2_4 = ge2_3 * ge1_1_ + ge2_4 * ge1_4_ + ge2_5 * ge1_7_;
    const double e2_7 = ge2_6 * ge1_1_ + ge2_7 * ge1_4_ + ge2_8 * ge1_7_;
    const double ge1_2_ = w252 + w253;
    const double ge1_5_ = w261 - w260;
    const double ge1_8_ = 1.0 - (w237 + w259);
    const double e2_2 = ge2_0 * ge1_2_ + ge2_1 * ge1_5_ + ge2_2 * ge1_8_;
    const double e2_5 = ge2_3 * ge1_2_ + ge2_4 * ge1_5_ + ge2_5 * ge1_8_;
    const double e2_8 = ge2_6 * ge1_2_ + ge2_7 * ge1_5_ + ge2_8 * ge1_8_;
    const double w262 = 0.165 * h;
    const double w263 = 0.33 * h;
    const double w264 = s_p1_0_seen + xi1_2 * w262 * d_xi1_1 + xi1_1 * w262 * d_xi1_2
        + xi2_2 * w263 * d_xi2_1 + xi2_1 * w263 * d_xi2_2;
    const double w265 = xi3_2 * w263;
    const double w266 = xi3_1 * w263;
    const double w267 = xi4_2 * w262;
    const double w268 = xi4_1 * w262;
    const double w269 = -0.3333333333333333 * h;
    const double w270 = s_p1_1_seen + xi1_2 * w132 * d_xi1_0 + xi1_0 * w132 * d_xi1_2
        + xi2_2 * w269 * d_xi2_0 + xi2_0 * w269 * d_xi2_2;
    const double w271 = xi3_2 * w269;
    const double w272 = xi3_0 * w269;
    const double w273 = xi4_2 * w132;
    const double w274 = xi4_0 * w132;
    const double w275 = 0.0016666666666666668 * h;
    const double w276 = 0.0033333333333333335 * h;
    const double w277 = s_p1_2_seen + xi1_1 * w275 * d_xi1_0 + xi1_0 * w275 * d_xi1_1
        + xi2_1 * w276 * d_xi2_0 + xi2_0 * w276 * d_xi2_1;
    const double w278 = xi3_1 * w276;
    const double w279 = xi3_0 * w276;
    const double w280 = xi4_1 * w275;
    const double w281 = xi4_0 * w275;
    const double new_g00 = g00 * e2_0 + g01 * e2_3 + g02 * e2_6;
    const double new_g01 = g00 * e2_1 + g01 * e2_4 + g02 * e2_7;
    const double new_g02 = g00 * e2_2 + g01 * e2_5 + g02 * e2_8;
    const double new_g10 = g10 * e2_0 + g11 * e2_3 + g12 * e2_6;
    const double new_g11 = g10 * e2_1 + g11 * e2_4 + g12 * e2_7;
    const double new_g12 = g10 * e2_2 + g11 * e2_5 + g12 * e2_8;
    const double new_g20 = g20 * e2_0 + g21 * e2_3 + g22 * e2_6;
    const double new_g21 = g20 * e2_1 + g21 * e2_4 + g22 * e2_7;
    const double new_g22 = g20 * e2_2 + g21 * e2_5 + g22 * e2_8;
    const double new_mu0 = w264 + d_xi3_1 * w265 + d_xi3_2 * w266 + d_xi4_1 * w267
        + d_xi4_2 * w268;
    const double new_mu1 = w270 + d_xi3_0 * w271 + d_xi3_2 * w272 + d_xi4_0 * w273
        + d_xi4_2 * w274;
    const double new_mu2 = w277 + d_xi3_0 * w278 + d_xi3_1 * w279 + d_xi4_0 * w280
        + d_xi4_1 * w281;
    /* If the sum of all x overflows, test each x: x - x is 0 only if x is finite. */
    if (!isfinite(new_g00 + new_g01 + (new_g02 + new_g10) + (new_g11 + new_g12)
        + (new_g20 + new_g21) + (new_g22 + new_mu0) + (new_mu1 + new_mu2)) && !(new_g00
        - new_g00 + (new_g01 - new_g01) + (new_g02 - new_g02 + (new_g10 - new_g10))
        + (new_g11 - new_g11 + (new_g12 - new_g12)) + (new_g20 - new_g20 + (new_g21 - new_g21))
        + (new_g22 - new_g22 + (new_mu0 - new_mu0)) + (new_mu1 - new_mu1 + (new_mu2 - new_mu2))
        == 0.0)) {
        return DIPOLE_VCF_CF4_NOT_FINITE;
    }
    memory->age_1 = memory->age_1 % 6 > 0 ? memory->age_1 + 1 : 0;
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

/*
 * Repeat a failed step with a new initial guess. If the step fails again, the step size is halved
 * until the step succeeds. Each solution is then the initial guess for a longer step (continuation in
 * h).
 */
static int dipole_vcf_cf4_continued(double state[static 12], double h,
    struct dipole_vcf_cf4_memory *memory, dipole_vcf_cf4_statistics *statistics)
{
    if (!(h < 0.0 || h > 0.0)) {
        return dipole_vcf_cf4_all_finite(state, 12) ? DIPOLE_VCF_CF4_OK : DIPOLE_VCF_CF4_NOT_FINITE;
    }
    double known_solution[12] = {0.0};
    double trial[12];
    double solved = 0.0;
    double part = 1.0;
    double factor = 2.0;
    int failure = DIPOLE_VCF_CF4_NOT_CONVERGED;
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
        const int status = dipole_vcf_cf4_advance(trial, part * h, memory, statistics);
        done = status == DIPOLE_VCF_CF4_OK && part >= 1.0;
        if (status == DIPOLE_VCF_CF4_OK) {
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
        return solved > 0.0 && failure == DIPOLE_VCF_CF4_NOT_FINITE ? DIPOLE_VCF_CF4_TOO_FAR
            : failure;
    }
    memcpy(state, trial, sizeof trial);
    memory->known = 1;
    if (statistics != NULL) {
        statistics->failed = 0;
    }
    return DIPOLE_VCF_CF4_OK;
}

/* Convert space momentum to body momentum. */
static inline void dipole_vcf_cf4_to_body(const double state[static 12],
    double momentum[static 3])
{
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
    momentum[0] = g00 * mu0 + g10 * mu1 + g20 * mu2;
    momentum[1] = g01 * mu0 + g11 * mu1 + g21 * mu2;
    momentum[2] = g02 * mu0 + g12 * mu1 + g22 * mu2;
}

/* Convert body momentum to space momentum. */
static inline void dipole_vcf_cf4_to_space(const double state[static 12],
    double momentum[static 3])
{
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
    momentum[0] = g00 * mu0 + g01 * mu1 + g02 * mu2;
    momentum[1] = g11 * mu1 + g10 * mu0 + g12 * mu2;
    momentum[2] = g20 * mu0 + g21 * mu1 + g22 * mu2;
}

/*
 * Copy the state to 'moving', and convert the momentum to the body frame. Then convert this momentum
 * back to the space frame, and write the result into 'before'.
 */
static void dipole_vcf_cf4_enter_body(const double state[static 12],
    double moving[static 12], double before[static 3])
{
    dipole_vcf_cf4_to_body(state, before);
    memcpy(moving, state, 9 * sizeof *state);
    memcpy(moving + 9, before, 3 * sizeof *before);
    dipole_vcf_cf4_to_space(moving, before);
}

/*
 * Update the state at the end of a run. The group element is copied from 'moving'. The momentum in
 * 'moving' is converted to the space frame. The converted momentum minus 'before' is the increase of
 * the momentum during the run. This increase is added to the momentum of the state.
 */
static int dipole_vcf_cf4_leave_body(const double moving[static 12],
    const double before[static 3], double state[static 12])
{
    double momentum[3];
    dipole_vcf_cf4_to_space(moving, momentum);
    for (size_t i = 0; i < 3; i++) {
        momentum[i] = state[i + 9] + (momentum[i] - before[i]);
    }
    if (!dipole_vcf_cf4_all_finite(momentum, 3)) {
        return DIPOLE_VCF_CF4_NOT_FINITE;
    }
    memcpy(state, moving, 9 * sizeof *moving);
    memcpy(state + 9, momentum, sizeof momentum);
    return DIPOLE_VCF_CF4_OK;
}

int dipole_vcf_cf4_step(double state[static 12], double h,
    dipole_vcf_cf4_statistics *statistics)
{
    double moving[12];
    double before[3];
    dipole_vcf_cf4_enter_body(state, moving, before);
    struct dipole_vcf_cf4_memory memory = {0};
    int status = dipole_vcf_cf4_advance(moving, h, &memory, statistics);
    if (status != DIPOLE_VCF_CF4_OK && status != DIPOLE_VCF_CF4_BAD_STEP) {
        status = dipole_vcf_cf4_continued(moving, h, &memory, statistics);
    }
    if (status == DIPOLE_VCF_CF4_OK) {
        status = dipole_vcf_cf4_leave_body(moving, before, state);
    }
    return status;
}

int dipole_vcf_cf4_run(double state[static 12], double h, size_t steps, double *trajectory,
    size_t stride, dipole_vcf_cf4_statistics *statistics, size_t *completed)
{
    int status = DIPOLE_VCF_CF4_OK;
    size_t step = 0;
    struct dipole_vcf_cf4_memory memory = {0};
    const int recording = stride > 0 && trajectory != NULL;
    size_t row = 0;
    if (recording) {
        memcpy(trajectory, state, 12 * sizeof *state);
    }
    double moving[12];
    double before[3];
    dipole_vcf_cf4_enter_body(state, moving, before);
    while (status == DIPOLE_VCF_CF4_OK && step < steps) {
        status = dipole_vcf_cf4_advance(moving, h, &memory, statistics);
        if (status != DIPOLE_VCF_CF4_OK && status != DIPOLE_VCF_CF4_BAD_STEP) {
            status = dipole_vcf_cf4_continued(moving, h, &memory, statistics);
        }
        if (status == DIPOLE_VCF_CF4_OK) {
            step++;
            if (recording && step % stride == 0) {
                row++;
                memcpy(trajectory + 12 * row, state, 12 * sizeof *state);
                status = dipole_vcf_cf4_leave_body(moving, before, trajectory + 12 * row);
            }
        }
    }
    if (step > 0) {
        const int ended = dipole_vcf_cf4_leave_body(moving, before, state);
        if (ended != DIPOLE_VCF_CF4_OK) {
            status = DIPOLE_VCF_CF4_NOT_FINITE;
            step = 0;
        }
    }
    if (completed != NULL) {
        *completed = step;
    }
    return status;
}
