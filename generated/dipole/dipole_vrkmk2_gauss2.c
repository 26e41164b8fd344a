/*
 * Dipole on a stick, T*SO(3): one step by vrkmk(2):gauss2
 *
 * method:     family vrkmk(2), tableau gauss2
 * source:     Hammer and Hollingsworth 1955; Hairer, Lubich and Wanner, Table II.1.1; Table 3.1c
 *             of Bogfjellmo and Marthinsen
 * order:      4, certificate: exact (the residuals of all order conditions up to this order are
 *             zero in exact arithmetic)
 * digits:     with the coefficients rounded to double precision, the residuals of the order
 *             conditions are at most 1.6e-17
 * scene:      Dipole on a stick, T*SO(3), group SO(3)
 * solved by:  the equations of v1, v2, m1, m2: Newton's method, 6 unknowns; 1.7 sweeps and 0.35
 *             matrices a step, measured over the first 20 steps of size h = 0.005
 * state:      [0..8] q: element of SO(3), row by row
 *             [9..11] mu: right-trivialised momentum in the dual of the Lie algebra of SO(3)
 * left out:   2 Legendre transforms, 7 evaluations of dexp*, 4 functions of ad, 4 sums: equal
 *             values are computed once
 *             1 adjoint map, 1 evaluation of dexp*, 1 evaluation of the derivatives of H, 3 sums:
 *             no result depends on these operations
 *             6 adjoint maps, 2 evaluations of dexp*, 2 exponentials, 2 functions of ad: a linear
 *             map is applied once to a sum and not to each term
 *             3 adjoint maps: an adjoint map and its inverse cancel
 *             4 adjoint maps, 3 evaluations of dexp*, 4 evaluations of dexpinv: functions of the
 *             same ad_x are combined
 *             2 sums: numeric factors become coefficients of sums
 *             arguments for constant parameters: beta = 1, depth = 3/2
 *             the time is not needed: no formula depends on the time
 * operations: 47 add, 80 mul, 1 stumpff_12 a step
 *             2 mul once in each run, for the initial guess of the first step
 *             48 add, 72 mul for each matrix of the equations of v1, v2, m1, m2
 *             269 add, 371 mul, 6 div, 4 sqrt, 2 stumpff_123, 1 stumpff_23 for each sweep of the
 *             equations of v1, v2, m1, m2
 *             12 add, 18 mul at the start of a run, 12 add, 9 mul at the end of a run
 * stack:      at most 7360 bytes with gcc 12 and clang 14 at -O0 to -O3 on x86-64; 1280 of these
 *             bytes are a safety margin; math library functions need extra bytes
 * command:    orderconds emit dipole --method 'vrkmk(2):gauss2' --target c -o .
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

/* c_3(z) for z <= 1/256 */
static inline double dipole_vrkmk2_gauss2_stumpff_tiny_3(double z)
{
    const double w = z * z;
    return (0.16666666666666666 + z * -0.008333333333333059)
        + w * (0.00019841269798705593 + z * -2.7555439466688165e-06);
}

/* c_2(z) for z <= 1/256 */
static inline double dipole_vrkmk2_gauss2_stumpff_tiny_2(double z)
{
    const double w = z * z;
    return (0.5 + z * -0.04166666666666365)
        + w * (0.0013888888842068215 + z * -2.4799519568559804e-05);
}

/* c_1(z) for z <= 1/256 */
static inline double dipole_vrkmk2_gauss2_stumpff_tiny_1(double z)
{
    const double w = z * z;
    return (1.0 + z * -0.16666666666663651)
        + w * (0.00833333328651266 + z * -0.00019839202108242344);
}

/* c_3(z) for z <= 1/16 */
static inline double dipole_vrkmk2_gauss2_stumpff_small_3(double z)
{
    const double w = z * z;
    return (0.16666666666666666 + z * -0.008333333333333163)
        + w * (0.0001984126983861331 + z * -2.755730638646008e-06)
        + w * w * 2.5027657390139978e-08;
}

/* c_2(z) for z <= 1/16 */
static inline double dipole_vrkmk2_gauss2_stumpff_small_2(double z)
{
    const double w = z * z;
    return (0.5 + z * -0.041666666666666664)
        + w * (0.0013888888888888278 + z * -2.4801587297080002e-05)
        + w * w * (2.7557304737591345e-07 + z * -2.0855622118602925e-09);
}

/* c_1(z) for z <= 1/16 */
static inline double dipole_vrkmk2_gauss2_stumpff_small_1(double z)
{
    const double w = z * z;
    return (1.0 + z * -0.16666666666666666)
        + w * (0.008333333333332476 + z * -0.0001984126983495962)
        + w * w * (2.755729894303353e-06 + z * -2.5022519568470477e-08);
}

/* c_3(z) = sum_j (-z)^j/(2j+3)!, truncated, for 0 <= z <= 4 */
static inline double dipole_vrkmk2_gauss2_stumpff_series_3(double z)
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
static inline double dipole_vrkmk2_gauss2_stumpff_series_2(double z)
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
static inline double dipole_vrkmk2_gauss2_stumpff_series_1(double z)
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
static inline void dipole_vrkmk2_gauss2_stumpff_23_far(double z, double *c2, double *c3)
{
    if (z <= 1.0) {
        *c2 = dipole_vrkmk2_gauss2_stumpff_series_2(z);
        *c3 = dipole_vrkmk2_gauss2_stumpff_series_3(z);
        return;
    }
    /* NaN if the angle is too large for an accurate result */
    const double half = 0.5 * sqrt(z <= 4398046511104.0 ? z : (double)NAN);
    const double sine = sin(half);
    const double cosine = cos(half);
    const double ratio = sine / half;
    *c2 = 0.5 * (ratio * ratio);
    *c3 = z <= 4.0 ? dipole_vrkmk2_gauss2_stumpff_series_3(z) : (1.0 - ratio * cosine) / z;
}

/* For z >= 0 and s = sqrt(z): c_2 = (1 - cos(s))/s^2, c_3 = (s - sin(s))/s^3 */
static inline void dipole_vrkmk2_gauss2_stumpff_23(double z, double *c2, double *c3)
{
    if (z <= 0.00390625) {
        *c2 = dipole_vrkmk2_gauss2_stumpff_tiny_2(z);
        *c3 = dipole_vrkmk2_gauss2_stumpff_tiny_3(z);
    } else if (z <= 0.0625) {
        *c2 = dipole_vrkmk2_gauss2_stumpff_small_2(z);
        *c3 = dipole_vrkmk2_gauss2_stumpff_small_3(z);
    } else {
        dipole_vrkmk2_gauss2_stumpff_23_far(z, c2, c3);
    }
}

/* For z > 1/16 and s = sqrt(z): c_1 = sin(s)/s, c_2 = (1 - cos(s))/s^2 */
static inline void dipole_vrkmk2_gauss2_stumpff_12_far(double z, double *c1, double *c2)
{
    if (z <= 1.0) {
        *c1 = dipole_vrkmk2_gauss2_stumpff_series_1(z);
        *c2 = dipole_vrkmk2_gauss2_stumpff_series_2(z);
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
static inline void dipole_vrkmk2_gauss2_stumpff_123_far(double z, double *c1, double *c2, double *c3)
{
    if (z <= 1.0) {
        *c1 = dipole_vrkmk2_gauss2_stumpff_series_1(z);
        *c2 = dipole_vrkmk2_gauss2_stumpff_series_2(z);
        *c3 = dipole_vrkmk2_gauss2_stumpff_series_3(z);
        return;
    }
    /* NaN if the angle is too large for an accurate result */
    const double half = 0.5 * sqrt(z <= 4398046511104.0 ? z : (double)NAN);
    const double sine = sin(half);
    const double cosine = cos(half);
    const double ratio = sine / half;
    *c1 = ratio * cosine;
    *c2 = 0.5 * (ratio * ratio);
    *c3 = z <= 4.0 ? dipole_vrkmk2_gauss2_stumpff_series_3(z) : (1.0 - ratio * cosine) / z;
}

/* For z >= 0 and s = sqrt(z): c_1 = sin(s)/s, c_2 = (1 - cos(s))/s^2, c_3 = (s - sin(s))/s^3 */
static inline void dipole_vrkmk2_gauss2_stumpff_123(double z, double *c1, double *c2, double *c3)
{
    if (z <= 0.0625) {
        *c1 = dipole_vrkmk2_gauss2_stumpff_small_1(z);
        *c2 = dipole_vrkmk2_gauss2_stumpff_small_2(z);
        *c3 = dipole_vrkmk2_gauss2_stumpff_small_3(z);
    } else {
        dipole_vrkmk2_gauss2_stumpff_123_far(z, c1, c2, c3);
    }
}

/* For z >= 0 and s = sqrt(z): c_1 = sin(s)/s, c_2 = (1 - cos(s))/s^2 */
static inline void dipole_vrkmk2_gauss2_stumpff_12(double z, double *c1, double *c2)
{
    if (z <= 0.00390625) {
        *c1 = dipole_vrkmk2_gauss2_stumpff_tiny_1(z);
        *c2 = dipole_vrkmk2_gauss2_stumpff_tiny_2(z);
    } else if (z <= 0.0625) {
        *c1 = dipole_vrkmk2_gauss2_stumpff_small_1(z);
        *c2 = dipole_vrkmk2_gauss2_stumpff_small_2(z);
    } else {
        dipole_vrkmk2_gauss2_stumpff_12_far(z, c1, c2);
    }
}

/* The largest absolute value of n numbers */
static double dipole_vrkmk2_gauss2_largest(const double *x, size_t n)
{
    double size = 0.0;
    for (size_t i = 0; i < n; i++) {
        size = fabs(x[i]) > size ? fabs(x[i]) : size;
    }
    return size;
}

/* Invert an n x n matrix, stored row by row, in place (Gauss-Jordan with row exchanges). Return 0 if it is
 * singular or not finite, else 1. Here n is always 6. */
static size_t dipole_vrkmk2_gauss2_invert(size_t n, double *restrict a)
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

/* Whether n numbers are all finite */
static int dipole_vrkmk2_gauss2_all_finite(const double *x, size_t n)
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
struct dipole_vrkmk2_gauss2_memory {
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
static const double dipole_vrkmk2_gauss2_differences[17][18] = {
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
static void dipole_vrkmk2_gauss2_count_sweeps(dipole_vrkmk2_gauss2_statistics *statistics,
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
static void dipole_vrkmk2_gauss2_count_matrix(dipole_vrkmk2_gauss2_statistics *statistics)
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
static inline void dipole_vrkmk2_gauss2_difference(const struct dipole_vrkmk2_gauss2_memory *memory,
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
        const double newer = dipole_vrkmk2_gauss2_differences[order][column];
        const double older = dipole_vrkmk2_gauss2_differences[order][column + 1];
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
static double dipole_vrkmk2_gauss2_difference_size(const struct dipole_vrkmk2_gauss2_memory *memory,
    size_t order)
{
    double row[6];
    dipole_vrkmk2_gauss2_difference(memory, order, 0, 1.0, row);
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
static inline void dipole_vrkmk2_gauss2_remember(struct dipole_vrkmk2_gauss2_memory *memory,
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
        const double size = dipole_vrkmk2_gauss2_difference_size(memory, memory->degree);
        int grows = 0;
        if (memory->degree + 1 < memory->known) {
            const double higher = dipole_vrkmk2_gauss2_difference_size(memory, memory->degree + 1);
            grows = higher < size;
        }
        if (grows) {
            memory->degree++;
        } else if (memory->degree > 0) {
            const double lower = dipole_vrkmk2_gauss2_difference_size(memory, memory->degree - 1);
            if (size > lower) {
                memory->degree--;
            }
        }
    }
    /* extrapolate the polynomial through the latest solutions */
    dipole_vrkmk2_gauss2_difference(memory, memory->degree + 1, 1, -1.0, memory->guess);
}

/* One step. */
static inline int dipole_vrkmk2_gauss2_advance(double state[static 12], double h,
    struct dipole_vrkmk2_gauss2_memory *memory, dipole_vrkmk2_gauss2_statistics *statistics)
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
    double v1_0, v1_1, v1_2, v2_0, v2_1, v2_2;
    if (memory->known > 0) {
        v1_0 = memory->guess[0];
        v1_1 = memory->guess[1];
        v1_2 = memory->guess[2];
        v2_0 = memory->guess[3];
        v2_1 = memory->guess[4];
        v2_2 = memory->guess[5];
    } else {
        const double Wxi0_0 = 0.9900990099009901 * mu0;
        const double Wxi0_2 = 100.0 * mu2;
        v1_0 = Wxi0_0;
        v1_1 = mu1;
        v1_2 = Wxi0_2;
        v2_0 = Wxi0_0;
        v2_1 = mu1;
        v2_2 = Wxi0_2;
    }
    const double w1 = 0.5 * h;
    const double w2 = 0.5386751345948129 * h;
    const double w3 = 0.25 * h;
    const double w29 = -0.03867513459481288 * h;
    const double w78 = -0.5386751345948129 * h;
    const double w92 = -0.25 * h;
    const double w99 = -0.25 * h;
    const double w100 = 0.03867513459481288 * h;
    /* the equations of v1, v2, m1, m2: Newton's method, 6 unknowns */
    double previous_1 = 0.0;
    double rate_1 = memory->known > 0 ? memory->rate_1 : 1.0;
    int make_1 = !(memory->age_1 > 0);
    size_t sweep = 0;
    int status = DIPOLE_VRKMK2_GAUSS2_NOT_CONVERGED;
    double s_L_0_seen, s_L_1_seen, s_L_2_seen, d_v1_0, d_v1_1, d_v1_2, d_v2_0, d_v2_1, d_v2_2;
    do {
        sweep++;
        const double X2_2 = v1_2 * w2 + v2_2 * w3;
        const double X2_0 = v1_0 * w2 + v2_0 * w3;
        const double w4 = v2_0 * X2_2 - v2_2 * X2_0;
        const double X2_1 = v1_1 * w2 + v2_1 * w3;
        const double w5 = X2_0 * X2_0 + X2_1 * X2_1 + X2_2 * X2_2;
        double c1_1, c2_1, c3_1;
        dipole_vrkmk2_gauss2_stumpff_123(w5, &c1_1, &c2_1, &c3_1);
        const double w7 = 1.0 - 0.08333333333333333 * w5;
        const double w8 = 1.0 / (w7 * w7 + 0.25 * w5);
        const double w9 = w8 * (0.25 - 0.08333333333333333 * w7);
        const double w11 = -0.5 * w8;
        const double w12 = w5 * (w9 * c1_1 + w11 * c2_1) - (w11 + c1_1);
        const double w13 = v2_2 * X2_1 - v2_1 * X2_2;
        const double w14 = v2_1 * X2_0 - v2_0 * X2_1;
        const double w15 = X2_2 * w13 - X2_0 * w14;
        const double w16 = w9 + c2_1 + w11 * c1_1 - w9 * c2_1 * w5;
        const double a_6_1 = v2_1 + w4 * w12 + w15 * w16;
        const double w17 = X2_0 * w4 - X2_1 * w13;
        const double a_6_2 = v2_2 + w12 * w14 + w16 * w17;
        const double w18 = g22 * X2_0 - g20 * X2_2;
        const double w19 = g20 * X2_1 - g21 * X2_0;
        const double w20 = g21 * X2_2 - g22 * X2_1;
        const double Q2_7 = g21 + w18 * c1_1 + (X2_0 * w19 - X2_2 * w20) * c2_1;
        const double Q2_8 = g22 + w19 * c1_1 + (X2_1 * w20 - X2_0 * w18) * c2_1;
        const double w21 = 3.26 - 3.0 * Q2_8;
        const double w22 = 0.3 * Q2_7;
        const double w23 = w21 - w22;
        const double w24 = 1.5 / (w23 * sqrt(w23));
        const double w25 = w21 + w22;
        const double w26 = 1.5 / (w25 * sqrt(w25));
        const double w27 = -1.0 - (w24 - w26);
        const double w28 = 0.1 * (w24 + w26);
        const double Nn2_0 = Q2_7 * w27 + Q2_8 * w28 + 0.99 * (a_6_1 * a_6_2);
        const double X1_2 = v1_2 * w3 + v2_2 * w29;
        const double X1_0 = v1_0 * w3 + v2_0 * w29;
        const double w30 = v1_0 * X1_2 - v1_2 * X1_0;
        const double X1_1 = v1_1 * w3 + v2_1 * w29;
        const double w31 = X1_0 * X1_0 + X1_1 * X1_1 + X1_2 * X1_2;
        double c1_2, c2_2, c3_2;
        dipole_vrkmk2_gauss2_stumpff_123(w31, &c1_2, &c2_2, &c3_2);
        const double w33 = 1.0 - 0.08333333333333333 * w31;
        const double w34 = 1.0 / (w33 * w33 + 0.25 * w31);
        const double w35 = w34 * (0.25 - 0.08333333333333333 * w33);
        const double w37 = -0.5 * w34;
        const double w38 = w31 * (w35 * c1_2 + w37 * c2_2) - (w37 + c1_2);
        const double w39 = v1_2 * X1_1 - v1_1 * X1_2;
        const double w40 = v1_1 * X1_0 - v1_0 * X1_1;
        const double w41 = X1_2 * w39 - X1_0 * w40;
        const double w42 = w35 + c2_2 + w37 * c1_2 - w35 * c2_2 * w31;
        const double a_2_1 = v1_1 + w30 * w38 + w41 * w42;
        const double w43 = X1_0 * w30 - X1_1 * w39;
        const double a_2_2 = v1_2 + w38 * w40 + w42 * w43;
        const double w44 = g22 * X1_0 - g20 * X1_2;
        const double w45 = g20 * X1_1 - g21 * X1_0;
        const double w46 = g21 * X1_2 - g22 * X1_1;
        const double Q1_7 = g21 + w44 * c1_2 + (X1_0 * w45 - X1_2 * w46) * c2_2;
        const double Q1_8 = g22 + w45 * c1_2 + (X1_1 * w46 - X1_0 * w44) * c2_2;
        const double w47 = 3.26 - 3.0 * Q1_8;
        const double w48 = 0.3 * Q1_7;
        const double w49 = w47 - w48;
        const double w50 = 1.5 / (w49 * sqrt(w49));
        const double w51 = w47 + w48;
        const double w52 = 1.5 / (w51 * sqrt(w51));
        const double w53 = -1.0 - (w50 - w52);
        const double w54 = 0.1 * (w50 + w52);
        const double Nn1_0 = Q1_7 * w53 + Q1_8 * w54 + 0.99 * (a_2_1 * a_2_2);
        const double s_L_0 = mu0 + w1 * (Nn2_0 + Nn1_0);
        const double Y_0 = (v1_0 + v2_0) * w1;
        const double Y_1 = (v1_1 + v2_1) * w1;
        const double Y_2 = (v1_2 + v2_2) * w1;
        const double w55 = Y_0 * Y_0 + Y_1 * Y_1 + Y_2 * Y_2;
        double c2_3, c3_3;
        dipole_vrkmk2_gauss2_stumpff_23(w55, &c2_3, &c3_3);
        const double w57 = X2_1 * w14 - X2_2 * w4;
        const double a_6_0 = v2_0 + w12 * w13 + w16 * w57;
        const double Q2_6 = g20 + w20 * c1_1 + (X2_2 * w18 - X2_1 * w19) * c2_1;
        const double w58 = a_6_2 * a_6_0 + w27 * Q2_6;
        const double w59 = X1_1 * w40 - X1_2 * w30;
        const double a_2_0 = v1_0 + w38 * w39 + w42 * w59;
        const double Q1_6 = g20 + w46 * c1_2 + (X1_2 * w44 - X1_1 * w45) * c2_2;
        const double w60 = a_2_2 * a_2_0 + w53 * Q1_6;
        const double s_L_1 = mu1 - w1 * (w58 + w60);
        const double Nn2_2 = 0.01 * (a_6_1 * a_6_0) - w28 * Q2_6;
        const double Nn1_2 = 0.01 * (a_2_1 * a_2_0) - w54 * Q1_6;
        const double s_L_2 = mu2 + w1 * (Nn2_2 + Nn1_2);
        const double w61 = Y_2 * s_L_1 - Y_1 * s_L_2;
        const double w63 = Y_0 * s_L_2 - s_L_0 * Y_2;
        const double w64 = s_L_0 * Y_1 - Y_0 * s_L_1;
        const double L_4_0 = s_L_0 - w61 * c2_3 + (Y_2 * w63 - Y_1 * w64) * c3_3;
        const double w65 = X2_1 * Nn2_2 + X2_2 * w58;
        const double w67 = X2_0 * w58 + X2_1 * Nn2_0;
        const double w68 = X2_2 * Nn2_0 - X2_0 * Nn2_2;
        const double p_2_0 = 1.01 * a_6_0;
        const double p_2_2 = 0.01 * a_6_2;
        const double w69 = X2_2 * p_2_0 - X2_0 * p_2_2;
        const double w70 = X2_1 * p_2_2 - X2_2 * a_6_1;
        const double w71 = X2_0 * a_6_1 - X2_1 * p_2_0;
        const double a_8_1 = a_6_1 - w12 * w69 + w16 * (X2_2 * w70 - X2_0 * w71);
        const double a_5_2 = v2_2 - w11 * w14 + w9 * w17;
        const double a_5_1 = v2_1 - w4 * w11 + w9 * w15;
        const double a_5_0 = v2_0 - w11 * w13 + w9 * w57;
        const double w72 = 0.5 * a_5_2 - 0.08333333333333333 * (X2_0 * a_5_1 - X2_1 * a_5_0);
        const double a_8_2 = p_2_2 - w12 * w71 + w16 * (X2_0 * w69 - X2_1 * w70);
        const double w73 = 0.5 * a_5_1 - 0.08333333333333333 * (X2_2 * a_5_0 - X2_0 * a_5_2);
        const double a_8_0 = p_2_0 - w12 * w70 + w16 * (X2_1 * w71 - X2_2 * w69);
        const double w74 = X2_0 * a_8_2 - X2_2 * a_8_0;
        const double w75 = -0.08333333333333333 * a_5_2;
        const double w76 = X2_1 * a_8_0 - X2_0 * a_8_1;
        const double w77 = -0.08333333333333333 * a_5_1;
        const double sum_d2_0 = Nn2_0 + w65 * c2_1 - (X2_1 * w67 + X2_2 * w68) * c3_1
            - (a_8_1 * w72 - a_8_2 * w73 + (w74 * w75 - w76 * w77));
        const double w79 = X1_1 * Nn1_2 + X1_2 * w60;
        const double w81 = X1_0 * w60 + X1_1 * Nn1_0;
        const double w82 = X1_2 * Nn1_0 - X1_0 * Nn1_2;
        const double p_0 = 1.01 * a_2_0;
        const double p_2 = 0.01 * a_2_2;
        const double w83 = X1_2 * p_0 - X1_0 * p_2;
        const double w84 = X1_1 * p_2 - X1_2 * a_2_1;
        const double w85 = X1_0 * a_2_1 - X1_1 * p_0;
        const double a_4_1 = a_2_1 - w38 * w83 + w42 * (X1_2 * w84 - X1_0 * w85);
        const double a_2 = v1_2 - w37 * w40 + w35 * w43;
        const double a_1 = v1_1 - w30 * w37 + w35 * w41;
        const double a_0 = v1_0 - w37 * w39 + w35 * w59;
        const double w86 = 0.5 * a_2 - 0.08333333333333333 * (X1_0 * a_1 - X1_1 * a_0);
        const double a_4_2 = p_2 - w38 * w85 + w42 * (X1_0 * w83 - X1_1 * w84);
        const double w87 = 0.5 * a_1 - 0.08333333333333333 * (X1_2 * a_0 - X1_0 * a_2);
        const double a_4_0 = p_0 - w38 * w84 + w42 * (X1_1 * w85 - X1_2 * w83);
        const double w88 = X1_0 * a_4_2 - X1_2 * a_4_0;
        const double w89 = -0.08333333333333333 * a_2;
        const double w90 = X1_1 * a_4_0 - X1_0 * a_4_1;
        const double w91 = -0.08333333333333333 * a_1;
        const double sum_d1_0 = Nn1_0 + w79 * c2_2 - (X1_1 * w81 + X1_2 * w82) * c3_2
            - (a_4_1 * w86 - a_4_2 * w87 + (w88 * w89 - w90 * w91));
        const double w1_0 = L_4_0 + sum_d2_0 * w78 + sum_d1_0 * w92;
        const double residual_0 = w1_0 - a_4_0;
        const double L_4_1 = s_L_1 - w63 * c2_3 + (Y_0 * w64 - Y_2 * w61) * c3_3;
        const double w93 = 0.5 * a_5_0 - 0.08333333333333333 * (X2_1 * a_5_2 - X2_2 * a_5_1);
        const double w94 = -0.08333333333333333 * a_5_0;
        const double w95 = X2_2 * a_8_1 - X2_1 * a_8_2;
        const double sum_d2_1 = w68 * c2_1 - w58 + (X2_2 * w65 + X2_0 * w67) * c3_1
            - (a_8_2 * w93 - w72 * a_8_0 + (w76 * w94 - w75 * w95));
        const double w96 = 0.5 * a_0 - 0.08333333333333333 * (X1_1 * a_2 - X1_2 * a_1);
        const double w97 = -0.08333333333333333 * a_0;
        const double w98 = X1_2 * a_4_1 - X1_1 * a_4_2;
        const double sum_d1_1 = w82 * c2_2 - w60 + (X1_2 * w79 + X1_0 * w81) * c3_2
            - (a_4_2 * w96 - w86 * a_4_0 + (w90 * w97 - w89 * w98));
        const double w1_1 = L_4_1 + w78 * sum_d2_1 + w92 * sum_d1_1;
        const double residual_1 = w1_1 - a_4_1;
        const double L_4_2 = s_L_2 - w64 * c2_3 + (Y_1 * w61 - Y_0 * w63) * c3_3;
        const double sum_d2_2 = Nn2_2 - w67 * c2_1 + (X2_0 * w68 - X2_1 * w65) * c3_1
            - (w73 * a_8_0 - a_8_1 * w93 + (w77 * w95 - w74 * w94));
        const double sum_d1_2 = Nn1_2 - w81 * c2_2 + (X1_0 * w82 - X1_1 * w79) * c3_2
            - (w87 * a_4_0 - a_4_1 * w96 + (w91 * w98 - w88 * w97));
        const double w1_2 = L_4_2 + w78 * sum_d2_2 + w92 * sum_d1_2;
        const double residual_2 = w1_2 - a_4_2;
        const double w2_0 = L_4_0 + sum_d2_0 * w99 + sum_d1_0 * w100;
        const double residual_2_0 = w2_0 - a_8_0;
        const double w2_1 = L_4_1 + sum_d2_1 * w99 + sum_d1_1 * w100;
        const double residual_2_1 = w2_1 - a_8_1;
        const double w2_2 = L_4_2 + sum_d2_2 * w99 + sum_d1_2 * w100;
        const double residual_2_2 = w2_2 - a_8_2;
        s_L_0_seen = s_L_0;
        s_L_1_seen = s_L_1;
        s_L_2_seen = s_L_2;
        if (make_1) {
            const double w101 = 0.0001933756729740644 * v2_2;
            const double w102 = 0.25 * mu2;
            const double w103 = -0.01933756729740644 * v2_1;
            const double w104 = -0.25 * mu1;
            const double w105 = -0.25 * mu2;
            const double w106 = 0.019144191624432375 * v2_0;
            const double w107 = 0.25 * mu0;
            const double w108 = 0.25 * mu1;
            const double w109 = -0.25 * mu0;
            const double w110 = -0.0026933756729740645 * v1_2;
            const double w111 = 0.26933756729740643 * v1_1;
            const double w112 = -0.26664419162443237 * v1_0;
            memory->inverse_1[0] = 1.01;
            memory->inverse_1[1] = -h * (0.495 * v1_2 + w102 + w101);
            memory->inverse_1[2] = -h * (0.495 * v1_1 + w104 + w103);
            memory->inverse_1[3] = 0.0;
            memory->inverse_1[4] = -h
                * (w102 - 0.01933756729740644 * v1_2 + 0.22835580837556763 * v2_2);
            memory->inverse_1[5] = -h
                * (0.0001933756729740644 * v1_1 + w104 + 0.22835580837556763 * v2_1);
            memory->inverse_1[6] = -h * (w105 - 0.5 * v1_2 + w101);
            memory->inverse_1[7] = 1.0;
            memory->inverse_1[8] = -h * (w107 - 0.5 * v1_0 + w106);
            memory->inverse_1[9] = -h
                * (0.019144191624432375 * v1_2 + w105 - 0.23066243270259357 * v2_2);
            memory->inverse_1[10] = 0.0;
            memory->inverse_1[11] = -h
                * (0.0001933756729740644 * v1_0 + w107 - 0.23066243270259357 * v2_0);
            memory->inverse_1[12] = -h * (0.005 * v1_1 + w108 + w103);
            memory->inverse_1[13] = -h * (0.005 * v1_0 + w109 + w106);
            memory->inverse_1[14] = 0.01;
            memory->inverse_1[15] = -h
                * (0.019144191624432375 * v1_1 + w108 + 0.0023066243270259356 * v2_1);
            memory->inverse_1[16] = -h
                * (w109 - 0.01933756729740644 * v1_0 + 0.0023066243270259356 * v2_0);
            memory->inverse_1[17] = 0.0;
            memory->inverse_1[18] = 0.0;
            memory->inverse_1[19] = -h
                * (0.5141441916244324 * v1_2 + w102 + 0.26933756729740643 * v2_2);
            memory->inverse_1[20] = -h
                * (0.5141441916244324 * v1_1 + w104 - 0.0026933756729740645 * v2_1);
            memory->inverse_1[21] = 1.01;
            memory->inverse_1[22] = -h * (w102 + w110 + 0.495 * v2_2);
            memory->inverse_1[23] = -h * (w104 + w111 + 0.495 * v2_1);
            memory->inverse_1[24] = -h
                * (w105 - 0.5193375672974064 * v1_2 - 0.26664419162443237 * v2_2);
            memory->inverse_1[25] = 0.0;
            memory->inverse_1[26] = -h
                * (w107 - 0.5193375672974064 * v1_0 - 0.0026933756729740645 * v2_0);
            memory->inverse_1[27] = -h * (w105 + w110 - 0.5 * v2_2);
            memory->inverse_1[28] = 1.0;
            memory->inverse_1[29] = -h * (w107 + w112 - 0.5 * v2_0);
            memory->inverse_1[30] = -h
                * (0.005193375672974065 * v1_1 + w108 - 0.26664419162443237 * v2_1);
            memory->inverse_1[31] = -h
                * (0.005193375672974065 * v1_0 + w109 + 0.26933756729740643 * v2_0);
            memory->inverse_1[32] = 0.0;
            memory->inverse_1[33] = -h * (w108 + w111 + 0.005 * v2_1);
            memory->inverse_1[34] = -h * (w109 + w112 + 0.005 * v2_0);
            memory->inverse_1[35] = 0.01;
            memory->age_1 = dipole_vrkmk2_gauss2_invert(6, memory->inverse_1);
            if (memory->age_1 > 0) {
                dipole_vrkmk2_gauss2_count_matrix(statistics);
            }
        }
        d_v1_0 = memory->inverse_1[0] * residual_0 + memory->inverse_1[1] * residual_1
            + (memory->inverse_1[2] * residual_2 + memory->inverse_1[3] * residual_2_0)
            + (memory->inverse_1[4] * residual_2_1 + memory->inverse_1[5] * residual_2_2);
        d_v1_1 = memory->inverse_1[6] * residual_0 + memory->inverse_1[7] * residual_1
            + (memory->inverse_1[8] * residual_2 + memory->inverse_1[9] * residual_2_0)
            + (memory->inverse_1[10] * residual_2_1 + memory->inverse_1[11] * residual_2_2);
        d_v1_2 = memory->inverse_1[12] * residual_0 + memory->inverse_1[13] * residual_1
            + (memory->inverse_1[14] * residual_2 + memory->inverse_1[15] * residual_2_0)
            + (memory->inverse_1[16] * residual_2_1 + memory->inverse_1[17] * residual_2_2);
        d_v2_0 = memory->inverse_1[18] * residual_0 + memory->inverse_1[19] * residual_1
            + (memory->inverse_1[20] * residual_2 + memory->inverse_1[21] * residual_2_0)
            + (memory->inverse_1[22] * residual_2_1 + memory->inverse_1[23] * residual_2_2);
        d_v2_1 = memory->inverse_1[24] * residual_0 + memory->inverse_1[25] * residual_1
            + (memory->inverse_1[26] * residual_2 + memory->inverse_1[27] * residual_2_0)
            + (memory->inverse_1[28] * residual_2_1 + memory->inverse_1[29] * residual_2_2);
        d_v2_2 = memory->inverse_1[30] * residual_0 + memory->inverse_1[31] * residual_1
            + (memory->inverse_1[32] * residual_2 + memory->inverse_1[33] * residual_2_0)
            + (memory->inverse_1[34] * residual_2_1 + memory->inverse_1[35] * residual_2_2);
        const double change = fabs(d_v1_0) + fabs(d_v1_1) + (fabs(d_v1_2) + fabs(d_v2_0))
            + (fabs(d_v2_1) + fabs(d_v2_2));
        const double scale = fabs(v1_0) + fabs(v1_1) + (fabs(v1_2) + fabs(v2_0))
            + (fabs(v2_1) + fabs(v2_2));
        v1_0 += d_v1_0;
        v1_1 += d_v1_1;
        v1_2 += d_v1_2;
        v2_0 += d_v2_0;
        v2_1 += d_v2_1;
        v2_2 += d_v2_2;
        if (previous_1 > 0.0) {
            rate_1 = change / previous_1;
        } else {
            memory->first += change;
        }
        const int contracts = rate_1 < 0.5;
        const int converged = contracts
            ? change * (rate_1 + 0.0001220703125) <= 8.881784197001252e-16 * scale : (sweep > 1
            && (change * rate_1 <= 8.881784197001252e-16 * scale * (1.0 - rate_1) || (rate_1 >= 1.0
            && (change <= 5.684341886080802e-14 * scale || (change * fabs(h)
            <= 7.105427357601002e-15 * dipole_vrkmk2_gauss2_largest(state, 9) && change * fabs(h)
            <= 7.105427357601002e-15 * dipole_vrkmk2_gauss2_largest(state + 9, 3))))));
        status = isfinite(change) ? (memory->age_1 > 0 && converged ? DIPOLE_VRKMK2_GAUSS2_OK
            : DIPOLE_VRKMK2_GAUSS2_NOT_CONVERGED) : DIPOLE_VRKMK2_GAUSS2_NOT_FINITE;
        make_1 = 0;
        previous_1 = change;
    } while (status == DIPOLE_VRKMK2_GAUSS2_NOT_CONVERGED && sweep < 100
        && !!(memory->age_1 > 0));
    if (status != DIPOLE_VRKMK2_GAUSS2_OK && (status == DIPOLE_VRKMK2_GAUSS2_NOT_CONVERGED
        && !(memory->age_1 > 0))) {
        status = DIPOLE_VRKMK2_GAUSS2_SINGULAR;
    }
    dipole_vrkmk2_gauss2_count_sweeps(statistics, 0, sweep, status != DIPOLE_VRKMK2_GAUSS2_OK);
    if (status != DIPOLE_VRKMK2_GAUSS2_OK) {
        return status;
    }
    memory->rate_1 = rate_1;
    const double solution[6] = {v1_0, v1_1, v1_2, v2_0, v2_1, v2_2};
    dipole_vrkmk2_gauss2_remember(memory, solution);
    const double Y_1_ = (v1_1 + v2_1) * w1;
    const double Y_0_ = (v1_0 + v2_0) * w1;
    const double Y_2_ = (v1_2 + v2_2) * w1;
    const double w113 = Y_0_ * Y_0_ + Y_1_ * Y_1_ + Y_2_ * Y_2_;
    double c1_3, c2_4;
    dipole_vrkmk2_gauss2_stumpff_12(w113, &c1_3, &c2_4);
    const double w115 = Y_1_ * c2_4;
    const double w116 = Y_1_ * w115;
    const double w117 = Y_2_ * c2_4 * Y_2_;
    const double g_0 = 1.0 - (w116 + w117);
    const double w119 = Y_2_ * c1_3;
    const double w120 = Y_0_ * c2_4;
    const double w121 = Y_1_ * w120;
    const double g_3 = w119 + w121;
    const double w122 = Y_2_ * w120;
    const double w123 = Y_1_ * c1_3;
    const double g_6 = w122 - w123;
    const double g_1 = w121 - w119;
    const double w124 = Y_0_ * w120;
    const double g_4 = 1.0 - (w117 + w124);
    const double w125 = Y_0_ * c1_3;
    const double w126 = Y_2_ * w115;
    const double g_7 = w125 + w126;
    const double g_2 = w122 + w123;
    const double g_5 = w126 - w125;
    const double g_8 = 1.0 - (w116 + w124);
    const double w127 = 0.495 * h;
    const double w128 = s_L_0_seen + v1_2 * w127 * d_v1_1 + v1_1 * w127 * d_v1_2
        + v2_2 * w127 * d_v2_1 + v2_1 * w127 * d_v2_2;
    const double w129 = -0.5 * h;
    const double w130 = s_L_1_seen + v1_2 * w129 * d_v1_0 + v1_0 * w129 * d_v1_2
        + v2_2 * w129 * d_v2_0 + v2_0 * w129 * d_v2_2;
    const double w131 = 0.005 * h;
    const double w132 = s_L_2_seen + v1_1 * w131 * d_v1_0 + v1_0 * w131 * d_v1_1
        + v2_1 * w131 * d_v2_0 + v2_0 * w131 * d_v2_1;
    const double new_g00 = g00 * g_0 + g01 * g_3 + g02 * g_6;
    const double new_g01 = g00 * g_1 + g01 * g_4 + g02 * g_7;
    const double new_g02 = g00 * g_2 + g01 * g_5 + g02 * g_8;
    const double new_g10 = g10 * g_0 + g11 * g_3 + g12 * g_6;
    const double new_g11 = g10 * g_1 + g11 * g_4 + g12 * g_7;
    const double new_g12 = g10 * g_2 + g11 * g_5 + g12 * g_8;
    const double new_g20 = g20 * g_0 + g21 * g_3 + g22 * g_6;
    const double new_g21 = g20 * g_1 + g21 * g_4 + g22 * g_7;
    const double new_g22 = g20 * g_2 + g21 * g_5 + g22 * g_8;
    /* If the sum of all x overflows, test each x: x - x is 0 only if x is finite. */
    if (!isfinite(new_g00 + new_g01 + (new_g02 + new_g10) + (new_g11 + new_g12)
        + (new_g20 + new_g21) + (new_g22 + w128) + (w130 + w132)) && !(new_g00 - new_g00
        + (new_g01 - new_g01) + (new_g02 - new_g02 + (new_g10 - new_g10))
        + (new_g11 - new_g11 + (new_g12 - new_g12)) + (new_g20 - new_g20 + (new_g21 - new_g21))
        + (new_g22 - new_g22 + (w128 - w128)) + (w130 - w130 + (w132 - w132)) == 0.0)) {
        return DIPOLE_VRKMK2_GAUSS2_NOT_FINITE;
    }
    memory->age_1 = memory->age_1 % 3 > 0 ? memory->age_1 + 1 : 0;
    state[0] = new_g00;
    state[1] = new_g01;
    state[2] = new_g02;
    state[3] = new_g10;
    state[4] = new_g11;
    state[5] = new_g12;
    state[6] = new_g20;
    state[7] = new_g21;
    state[8] = new_g22;
    state[9] = w128;
    state[10] = w130;
    state[11] = w132;
    return DIPOLE_VRKMK2_GAUSS2_OK;
}

/*
 * Repeat a failed step with a new initial guess. If the step fails again, the step size is halved
 * until the step succeeds. Each solution is then the initial guess for a longer step (continuation in
 * h).
 */
static int dipole_vrkmk2_gauss2_continued(double state[static 12], double h,
    struct dipole_vrkmk2_gauss2_memory *memory, dipole_vrkmk2_gauss2_statistics *statistics)
{
    if (!(h < 0.0 || h > 0.0)) {
        return dipole_vrkmk2_gauss2_all_finite(state, 12) ? DIPOLE_VRKMK2_GAUSS2_OK
            : DIPOLE_VRKMK2_GAUSS2_NOT_FINITE;
    }
    double known_solution[6] = {0.0};
    double trial[12];
    double solved = 0.0;
    double part = 1.0;
    double factor = 2.0;
    int failure = DIPOLE_VRKMK2_GAUSS2_NOT_CONVERGED;
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
        const int status = dipole_vrkmk2_gauss2_advance(trial, part * h, memory, statistics);
        done = status == DIPOLE_VRKMK2_GAUSS2_OK && part >= 1.0;
        if (status == DIPOLE_VRKMK2_GAUSS2_OK) {
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
        return solved > 0.0 && failure == DIPOLE_VRKMK2_GAUSS2_NOT_FINITE
            ? DIPOLE_VRKMK2_GAUSS2_TOO_FAR : failure;
    }
    memcpy(state, trial, sizeof trial);
    memory->known = 1;
    if (statistics != NULL) {
        statistics->failed = 0;
    }
    return DIPOLE_VRKMK2_GAUSS2_OK;
}

/* Convert space momentum to body momentum. */
static inline void dipole_vrkmk2_gauss2_to_body(const double state[static 12],
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
static inline void dipole_vrkmk2_gauss2_to_space(const double state[static 12],
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
static void dipole_vrkmk2_gauss2_enter_body(const double state[static 12],
    double moving[static 12], double before[static 3])
{
    dipole_vrkmk2_gauss2_to_body(state, before);
    memcpy(moving, state, 9 * sizeof *state);
    memcpy(moving + 9, before, 3 * sizeof *before);
    dipole_vrkmk2_gauss2_to_space(moving, before);
}

/*
 * Update the state at the end of a run. The group element is copied from 'moving'. The momentum in
 * 'moving' is converted to the space frame. The converted momentum minus 'before' is the increase of
 * the momentum during the run. This increase is added to the momentum of the state.
 */
static int dipole_vrkmk2_gauss2_leave_body(const double moving[static 12],
    const double before[static 3], double state[static 12])
{
    double momentum[3];
    dipole_vrkmk2_gauss2_to_space(moving, momentum);
    for (size_t i = 0; i < 3; i++) {
        momentum[i] = state[i + 9] + (momentum[i] - before[i]);
    }
    if (!dipole_vrkmk2_gauss2_all_finite(momentum, 3)) {
        return DIPOLE_VRKMK2_GAUSS2_NOT_FINITE;
    }
    memcpy(state, moving, 9 * sizeof *moving);
    memcpy(state + 9, momentum, sizeof momentum);
    return DIPOLE_VRKMK2_GAUSS2_OK;
}

int dipole_vrkmk2_gauss2_step(double state[static 12], double h,
    dipole_vrkmk2_gauss2_statistics *statistics)
{
    double moving[12];
    double before[3];
    dipole_vrkmk2_gauss2_enter_body(state, moving, before);
    struct dipole_vrkmk2_gauss2_memory memory = {0};
    int status = dipole_vrkmk2_gauss2_advance(moving, h, &memory, statistics);
    if (status != DIPOLE_VRKMK2_GAUSS2_OK && status != DIPOLE_VRKMK2_GAUSS2_BAD_STEP) {
        status = dipole_vrkmk2_gauss2_continued(moving, h, &memory, statistics);
    }
    if (status == DIPOLE_VRKMK2_GAUSS2_OK) {
        status = dipole_vrkmk2_gauss2_leave_body(moving, before, state);
    }
    return status;
}

int dipole_vrkmk2_gauss2_run(double state[static 12], double h, size_t steps,
    double *trajectory, size_t stride, dipole_vrkmk2_gauss2_statistics *statistics,
    size_t *completed)
{
    int status = DIPOLE_VRKMK2_GAUSS2_OK;
    size_t step = 0;
    struct dipole_vrkmk2_gauss2_memory memory = {0};
    const int recording = stride > 0 && trajectory != NULL;
    size_t row = 0;
    if (recording) {
        memcpy(trajectory, state, 12 * sizeof *state);
    }
    double moving[12];
    double before[3];
    dipole_vrkmk2_gauss2_enter_body(state, moving, before);
    while (status == DIPOLE_VRKMK2_GAUSS2_OK && step < steps) {
        status = dipole_vrkmk2_gauss2_advance(moving, h, &memory, statistics);
        if (status != DIPOLE_VRKMK2_GAUSS2_OK && status != DIPOLE_VRKMK2_GAUSS2_BAD_STEP) {
            status = dipole_vrkmk2_gauss2_continued(moving, h, &memory, statistics);
        }
        if (status == DIPOLE_VRKMK2_GAUSS2_OK) {
            step++;
            if (recording && step % stride == 0) {
                row++;
                memcpy(trajectory + 12 * row, state, 12 * sizeof *state);
                status = dipole_vrkmk2_gauss2_leave_body(moving, before, trajectory + 12 * row);
            }
        }
    }
    if (step > 0) {
        const int ended = dipole_vrkmk2_gauss2_leave_body(moving, before, state);
        if (ended != DIPOLE_VRKMK2_GAUSS2_OK) {
            status = DIPOLE_VRKMK2_GAUSS2_NOT_FINITE;
            step = 0;
        }
    }
    if (completed != NULL) {
        *completed = step;
    }
    return status;
}
