/*
 * Dipole on a stick, T*SO(3): one step by vcg:triple_jump
 *
 * method:     family vcg, tableau triple_jump
 * source:     Yoshida 1990; Hairer, Lubich and Wanner, (II.4.4); Table 3.2b of Bogfjellmo and
 *             Marthinsen
 * order:      4, certificate: exact (the residuals of all order conditions up to this order are
 *             zero in exact arithmetic)
 * digits:     with the coefficients rounded to double precision, the residuals of the order
 *             conditions are at most 2.3e-16
 * scene:      Dipole on a stick, T*SO(3), group SO(3)
 * substeps:   3 calls of one function with the step sizes 1.35121 h, -1.70241 h, 1.35121 h
 * solved by:  the equations of xi1, n1: Newton's method, 3 unknowns; 4.85 sweeps and 3 matrices a
 *             step, measured over the first 20 steps of size h = 0.005
 * state:      [0..8] q: element of SO(3), row by row
 *             [9..11] mu: right-trivialised momentum in the dual of the Lie algebra of SO(3)
 * left out:   17 adjoint maps, 15 evaluations of dexp*, 2 evaluations of the derivatives of H, 10
 *             exponentials, 12 products, 16 sums: the step is a sequence of substeps
 *             3 adjoint maps, 2 products: coefficients are zero, or terms cancel
 *             1 Legendre transform, 1 sum: equal values are computed once
 *             3 adjoint maps, 1 evaluation of the derivatives of H: no result depends on these
 *             operations
 *             1 evaluation of dexp*, 1 exponential, 2 functions of ad, 1 sum: a linear map is
 *             applied once to a sum and not to each term
 *             4 adjoint maps: an adjoint map and its inverse cancel
 *             2 adjoint maps, 2 evaluations of dexp*: functions of the same ad_x are combined
 *             arguments for constant parameters: beta = 1, depth = 3/2
 *             the time is not needed: no formula depends on the time
 * operations: 114 add, 174 mul, 3 stumpff_12 a step
 *             6 mul once in each run, for the initial guess of the first step
 *             11 add, 34 mul, 1 div for each matrix of the equations of xi1, n1
 *             51 add, 73 mul, 2 div, 2 sqrt, 1 stumpff_123 for each sweep of the equations of xi1,
 *             n1
 *             12 add, 18 mul at the start of a run, 12 add, 9 mul at the end of a run
 * stack:      at most 7168 bytes with gcc 12 and clang 14 at -O0 to -O3 on x86-64; 1264 of these
 *             bytes are a safety margin; math library functions need extra bytes
 * command:    orderconds emit dipole --method vcg:triple_jump --target c -o .
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

/* c_2(z) for z <= 1/256 */
static inline double dipole_vcg_triple_jump_stumpff_tiny_2(double z)
{
    const double w = z * z;
    return (0.5 + z * -0.04166666666666365)
        + w * (0.0013888888842068215 + z * -2.4799519568559804e-05);
}

/* c_1(z) for z <= 1/256 */
static inline double dipole_vcg_triple_jump_stumpff_tiny_1(double z)
{
    const double w = z * z;
    return (1.0 + z * -0.16666666666663651)
        + w * (0.00833333328651266 + z * -0.00019839202108242344);
}

/* c_3(z) for z <= 1/16 */
static inline double dipole_vcg_triple_jump_stumpff_small_3(double z)
{
    const double w = z * z;
    return (0.16666666666666666 + z * -0.008333333333333163)
        + w * (0.0001984126983861331 + z * -2.755730638646008e-06)
        + w * w * 2.5027657390139978e-08;
}

/* c_2(z) for z <= 1/16 */
static inline double dipole_vcg_triple_jump_stumpff_small_2(double z)
{
    const double w = z * z;
    return (0.5 + z * -0.041666666666666664)
        + w * (0.0013888888888888278 + z * -2.4801587297080002e-05)
        + w * w * (2.7557304737591345e-07 + z * -2.0855622118602925e-09);
}

/* c_1(z) for z <= 1/16 */
static inline double dipole_vcg_triple_jump_stumpff_small_1(double z)
{
    const double w = z * z;
    return (1.0 + z * -0.16666666666666666)
        + w * (0.008333333333332476 + z * -0.0001984126983495962)
        + w * w * (2.755729894303353e-06 + z * -2.5022519568470477e-08);
}

/* c_3(z) = sum_j (-z)^j/(2j+3)!, truncated, for 0 <= z <= 4 */
static inline double dipole_vcg_triple_jump_stumpff_series_3(double z)
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
static inline double dipole_vcg_triple_jump_stumpff_series_2(double z)
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
static inline double dipole_vcg_triple_jump_stumpff_series_1(double z)
{
    const double w = z * z;
    const double w2 = w * w;
    double even = -2.505210838544172e-08 + w * -7.647163731819816e-13;
    even = -0.16666666666666666 + w * -0.0001984126984126984 + w2 * even;
    double odd = 1.6059043836821613e-10 + w * 2.8114572543455206e-15;
    odd = 0.008333333333333333 + w * 2.7557319223985893e-06 + w2 * odd;
    return 1.0 + z * (even + z * odd);
}

/* For z > 1/16 and s = sqrt(z): c_1 = sin(s)/s, c_2 = (1 - cos(s))/s^2 */
static inline void dipole_vcg_triple_jump_stumpff_12_far(double z, double *c1, double *c2)
{
    if (z <= 1.0) {
        *c1 = dipole_vcg_triple_jump_stumpff_series_1(z);
        *c2 = dipole_vcg_triple_jump_stumpff_series_2(z);
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
static inline void dipole_vcg_triple_jump_stumpff_123_far(double z, double *c1, double *c2, double *c3)
{
    if (z <= 1.0) {
        *c1 = dipole_vcg_triple_jump_stumpff_series_1(z);
        *c2 = dipole_vcg_triple_jump_stumpff_series_2(z);
        *c3 = dipole_vcg_triple_jump_stumpff_series_3(z);
        return;
    }
    /* NaN if the angle is too large for an accurate result */
    const double half = 0.5 * sqrt(z <= 4398046511104.0 ? z : (double)NAN);
    const double sine = sin(half);
    const double cosine = cos(half);
    const double ratio = sine / half;
    *c1 = ratio * cosine;
    *c2 = 0.5 * (ratio * ratio);
    *c3 = z <= 4.0 ? dipole_vcg_triple_jump_stumpff_series_3(z) : (1.0 - ratio * cosine) / z;
}

/* For z >= 0 and s = sqrt(z): c_1 = sin(s)/s, c_2 = (1 - cos(s))/s^2, c_3 = (s - sin(s))/s^3 */
static inline void dipole_vcg_triple_jump_stumpff_123(double z, double *c1, double *c2, double *c3)
{
    if (z <= 0.0625) {
        *c1 = dipole_vcg_triple_jump_stumpff_small_1(z);
        *c2 = dipole_vcg_triple_jump_stumpff_small_2(z);
        *c3 = dipole_vcg_triple_jump_stumpff_small_3(z);
    } else {
        dipole_vcg_triple_jump_stumpff_123_far(z, c1, c2, c3);
    }
}

/* For z >= 0 and s = sqrt(z): c_1 = sin(s)/s, c_2 = (1 - cos(s))/s^2 */
static inline void dipole_vcg_triple_jump_stumpff_12(double z, double *c1, double *c2)
{
    if (z <= 0.00390625) {
        *c1 = dipole_vcg_triple_jump_stumpff_tiny_1(z);
        *c2 = dipole_vcg_triple_jump_stumpff_tiny_2(z);
    } else if (z <= 0.0625) {
        *c1 = dipole_vcg_triple_jump_stumpff_small_1(z);
        *c2 = dipole_vcg_triple_jump_stumpff_small_2(z);
    } else {
        dipole_vcg_triple_jump_stumpff_12_far(z, c1, c2);
    }
}

/* The largest absolute value of n numbers */
static double dipole_vcg_triple_jump_largest(const double *x, size_t n)
{
    double size = 0.0;
    for (size_t i = 0; i < n; i++) {
        size = fabs(x[i]) > size ? fabs(x[i]) : size;
    }
    return size;
}

/* Whether n numbers are all finite */
static int dipole_vcg_triple_jump_all_finite(const double *x, size_t n)
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
struct dipole_vcg_triple_jump_memory {
    size_t known; /* number of stored solutions */
    double first; /* error of the latest guess */
    size_t degree; /* degree of the extrapolation */
    size_t place; /* row of the latest solution */
    double guess[3]; /* initial guess for the next step */
    double values[32][3]; /* ring buffer, stored twice to avoid a modulo */
    double rate_1;
    size_t age_1; /* age of the stored inverse of the Newton matrix; 0 if none is stored */
    double inverse_1[9];
};

/* Row k: coefficients of the backward difference of order k, latest solution first. */
static const double dipole_vcg_triple_jump_differences[17][18] = {
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

/* Lengths of the substeps, in units of h. */
static const double dipole_vcg_triple_jump_fraction[3] = {1.3512071919596575,
    -1.7024143839193153, 1.3512071919596575};

/* Record the number of sweeps over one block, and whether the block failed. */
static void dipole_vcg_triple_jump_count_sweeps(dipole_vcg_triple_jump_statistics *statistics,
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
static void dipole_vcg_triple_jump_count_matrix(dipole_vcg_triple_jump_statistics *statistics)
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
static inline void dipole_vcg_triple_jump_difference(const struct dipole_vcg_triple_jump_memory *memory,
    size_t order, size_t first, double sign, double sum[static 3])
{
    double sum_0 = 0.0;
    double sum_1 = 0.0;
    double sum_2 = 0.0;
    for (size_t pair = (order - first) / 2 + 1; pair-- > 0;) {
        const size_t row = memory->place + 2 * pair;
        const size_t column = first + 2 * pair;
        const double newer = dipole_vcg_triple_jump_differences[order][column];
        const double older = dipole_vcg_triple_jump_differences[order][column + 1];
        sum_0 += sign * (newer * memory->values[row][0] + older * memory->values[row + 1][0]);
        sum_1 += sign * (newer * memory->values[row][1] + older * memory->values[row + 1][1]);
        sum_2 += sign * (newer * memory->values[row][2] + older * memory->values[row + 1][2]);
    }
    sum[0] = sum_0;
    sum[1] = sum_1;
    sum[2] = sum_2;
}

/* The sum of the absolute values of the components of a backward difference. */
static double dipole_vcg_triple_jump_difference_size(const struct dipole_vcg_triple_jump_memory *memory,
    size_t order)
{
    double row[3];
    dipole_vcg_triple_jump_difference(memory, order, 0, 1.0, row);
    double size = 0.0;
    for (size_t i = 0; i < 3; i++) {
        size += fabs(row[i]);
    }
    return size;
}

/*
 * Store a solution. Then compute the guess for the next step by polynomial extrapolation of the latest
 * stored solutions.
 */
static inline void dipole_vcg_triple_jump_remember(struct dipole_vcg_triple_jump_memory *memory,
    const double solution[static 3])
{
    /* the guess is tested only if at least three solutions are stored */
    if (memory->known > 2) {
        double moved = 0.0;
        moved += fabs(solution[0] - memory->values[memory->place][0]);
        moved += fabs(solution[1] - memory->values[memory->place][1]);
        moved += fabs(solution[2] - memory->values[memory->place][2]);
        if (memory->first > 0.5 * moved) {
            memory->known = 0;
            memory->degree = 0;
        }
    }
    memory->first = 0.0;
    const size_t place = memory->place > 0 ? memory->place - 1 : 15;
    memory->place = place;
    memcpy(memory->values[place], solution, 3 * sizeof *solution);
    memcpy(memory->values[place + 16], solution, 3 * sizeof *solution);
    if (memory->known < 16) {
        memory->known++;
    }
    /* adapt the degree in each step until the ring buffer is full, then every 8 steps */
    if (memory->known < 16 || place % 8 == 0) {
        const double size = dipole_vcg_triple_jump_difference_size(memory, memory->degree);
        int grows = 0;
        if (memory->degree + 1 < memory->known) {
            const double higher = dipole_vcg_triple_jump_difference_size(memory, memory->degree + 1);
            grows = higher < size;
        }
        if (grows) {
            memory->degree++;
        } else if (memory->degree > 0) {
            const double lower = dipole_vcg_triple_jump_difference_size(memory, memory->degree - 1);
            if (size > lower) {
                memory->degree--;
            }
        }
    }
    /* extrapolate the polynomial through the latest solutions */
    dipole_vcg_triple_jump_difference(memory, memory->degree + 1, 1, -1.0, memory->guess);
}

/* One substep. */
static inline int dipole_vcg_triple_jump_substep(double state[static 12], double h,
    struct dipole_vcg_triple_jump_memory *memory,
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
    double xi1_0, xi1_1, xi1_2;
    if (memory->known > 0) {
        xi1_0 = memory->guess[0];
        xi1_1 = memory->guess[1];
        xi1_2 = memory->guess[2];
    } else {
        xi1_0 = 0.9900990099009901 * mu0;
        xi1_1 = mu1;
        xi1_2 = 100.0 * mu2;
    }
    const double w1 = 0.5 * h;
    /* the equations of xi1, n1: Newton's method, 3 unknowns */
    double previous_1 = 0.0;
    double rate_1 = memory->known > 0 ? memory->rate_1 : 1.0;
    int make_1 = !(memory->age_1 > 0);
    size_t sweep = 0;
    int status = DIPOLE_VCG_TRIPLE_JUMP_NOT_CONVERGED;
    double s_mu_0_seen, s_mu_1_seen, s_mu_2_seen, d_xi1_0, d_xi1_1, d_xi1_2;
    do {
        sweep++;
        const double xE1_1_0 = xi1_0 * w1;
        const double xE1_1_1 = xi1_1 * w1;
        const double xE1_1_2 = xi1_2 * w1;
        const double w2 = xE1_1_0 * xE1_1_0 + xE1_1_1 * xE1_1_1 + xE1_1_2 * xE1_1_2;
        double c1_1, c2_1, c3_1;
        dipole_vcg_triple_jump_stumpff_123(w2, &c1_1, &c2_1, &c3_1);
        const double w4 = g22 * xE1_1_0 - g20 * xE1_1_2;
        const double w6 = g20 * xE1_1_1 - g21 * xE1_1_0;
        const double w7 = g21 * xE1_1_2 - g22 * xE1_1_1;
        const double Q1_7 = g21 + w4 * c1_1 + (xE1_1_0 * w6 - xE1_1_2 * w7) * c2_1;
        const double Q1_8 = g22 + w6 * c1_1 + (xE1_1_1 * w7 - xE1_1_0 * w4) * c2_1;
        const double w8 = 3.26 - 3.0 * Q1_8;
        const double w9 = 0.3 * Q1_7;
        const double w10 = w8 - w9;
        const double w11 = 1.5 / (w10 * sqrt(w10));
        const double w12 = w8 + w9;
        const double w13 = 1.5 / (w12 * sqrt(w12));
        const double w14 = -1.0 - (w11 - w13);
        const double w15 = 0.1 * (w11 + w13);
        const double Nr1_0 = Q1_7 * w14 + Q1_8 * w15 + 0.99 * (xi1_1 * xi1_2);
        const double w16 = w1 * Nr1_0;
        const double w17 = mu0 + w16;
        const double Q1_6 = g20 + w7 * c1_1 + (xE1_1_2 * w4 - xE1_1_1 * w6) * c2_1;
        const double w18 = xi1_0 * xi1_2 + w14 * Q1_6;
        const double w19 = w1 * w18;
        const double Nr1_2 = 0.01 * (xi1_0 * xi1_1) - w15 * Q1_6;
        const double w21 = w1 * Nr1_2;
        const double w22 = mu2 + w21;
        const double w23 = w19 * c2_1 + (xE1_1_0 * w22 - xE1_1_2 * w17) * c3_1;
        const double w24 = mu1 - w19;
        const double w25 = (xE1_1_1 * w17 - xE1_1_0 * w24) * c3_1 - w21 * c2_1;
        const double M1_2_0 = xE1_1_2 * w23 - xE1_1_1 * w25 + w17;
        const double residual_0 = M1_2_0 - 1.01 * xi1_0;
        const double w26 = (xE1_1_2 * w24 - xE1_1_1 * w22) * c3_1 - w16 * c2_1;
        const double M1_2_1 = xE1_1_0 * w25 - xE1_1_2 * w26 + w24;
        const double residual_1 = M1_2_1 - xi1_1;
        const double M1_2_2 = xE1_1_1 * w26 - xE1_1_0 * w23 + w22;
        const double residual_2 = M1_2_2 - 0.01 * xi1_2;
        const double s_mu_0 = mu0 + h * Nr1_0;
        s_mu_0_seen = s_mu_0;
        const double s_mu_1 = mu1 - h * w18;
        s_mu_1_seen = s_mu_1;
        const double s_mu_2 = mu2 + h * Nr1_2;
        s_mu_2_seen = s_mu_2;
        if (make_1) {
            const double w27 = -0.5 * h;
            const double w28 = xi1_0 * w27;
            const double w29 = 0.005 * h;
            const double w30 = xi1_0 * w29;
            const double w31 = 0.01 - w28 * w30;
            const double w32 = 0.495 * h;
            const double w33 = xi1_2 * w32;
            const double w34 = xi1_1 * w29;
            const double w35 = xi1_2 * w27;
            const double w36 = w28 * w34 + 0.01 * w35;
            const double w37 = xi1_1 * w32;
            const double w38 = w34 + w30 * w35;
            const double w39 = 1.0 / (1.01 * w31 - w33 * w36 - w37 * w38);
            memory->inverse_1[0] = w31 * w39;
            memory->inverse_1[1] = w39 * (w30 * w37 + 0.01 * w33);
            memory->inverse_1[2] = w39 * (w37 + w28 * w33);
            memory->inverse_1[3] = w36 * w39;
            memory->inverse_1[4] = w39 * (0.0101 - w34 * w37);
            memory->inverse_1[5] = w39 * (w35 * w37 + 1.01 * w28);
            memory->inverse_1[6] = w38 * w39;
            memory->inverse_1[7] = w39 * (w33 * w34 + 1.01 * w30);
            memory->inverse_1[8] = w39 * (1.01 - w33 * w35);
            memory->age_1 = dipole_vcg_triple_jump_largest(memory->inverse_1, 9) > 0.0 ? 1 : 0;
            dipole_vcg_triple_jump_count_matrix(statistics);
        }
        d_xi1_0 = memory->inverse_1[0] * residual_0 + memory->inverse_1[1] * residual_1
            + memory->inverse_1[2] * residual_2;
        d_xi1_1 = memory->inverse_1[3] * residual_0 + memory->inverse_1[4] * residual_1
            + memory->inverse_1[5] * residual_2;
        d_xi1_2 = memory->inverse_1[6] * residual_0 + memory->inverse_1[7] * residual_1
            + memory->inverse_1[8] * residual_2;
        const double change = fabs(d_xi1_0) + fabs(d_xi1_1) + fabs(d_xi1_2);
        const double scale = fabs(xi1_0) + fabs(xi1_1) + fabs(xi1_2);
        xi1_0 += d_xi1_0;
        xi1_1 += d_xi1_1;
        xi1_2 += d_xi1_2;
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
            <= 7.105427357601002e-15 * dipole_vcg_triple_jump_largest(state, 9) && change * fabs(h)
            <= 7.105427357601002e-15 * dipole_vcg_triple_jump_largest(state + 9, 3))))));
        status = isfinite(change) && memory->age_1 > 0 ? (converged ? DIPOLE_VCG_TRIPLE_JUMP_OK
            : DIPOLE_VCG_TRIPLE_JUMP_NOT_CONVERGED) : DIPOLE_VCG_TRIPLE_JUMP_NOT_FINITE;
        make_1 = 0;
        previous_1 = change;
    } while (status == DIPOLE_VCG_TRIPLE_JUMP_NOT_CONVERGED && sweep < 100);
    dipole_vcg_triple_jump_count_sweeps(statistics, 0, sweep,
        status != DIPOLE_VCG_TRIPLE_JUMP_OK);
    if (status != DIPOLE_VCG_TRIPLE_JUMP_OK) {
        return status;
    }
    memory->rate_1 = rate_1;
    const double solution[3] = {xi1_0, xi1_1, xi1_2};
    dipole_vcg_triple_jump_remember(memory, solution);
    const double xe1_1 = h * xi1_1;
    const double xe1_0 = h * xi1_0;
    const double xe1_2 = h * xi1_2;
    const double w40 = xe1_0 * xe1_0 + xe1_1 * xe1_1 + xe1_2 * xe1_2;
    double c1_2, c2_2;
    dipole_vcg_triple_jump_stumpff_12(w40, &c1_2, &c2_2);
    const double w42 = xe1_1 * c2_2;
    const double w43 = xe1_1 * w42;
    const double w44 = xe1_2 * c2_2 * xe1_2;
    const double ge1_0 = 1.0 - (w43 + w44);
    const double w46 = xe1_2 * c1_2;
    const double w47 = xe1_0 * c2_2;
    const double w48 = xe1_1 * w47;
    const double ge1_3 = w46 + w48;
    const double w49 = xe1_2 * w47;
    const double w50 = xe1_1 * c1_2;
    const double ge1_6 = w49 - w50;
    const double ge1_1 = w48 - w46;
    const double w51 = xe1_0 * w47;
    const double ge1_4 = 1.0 - (w44 + w51);
    const double w52 = xe1_0 * c1_2;
    const double w53 = xe1_2 * w42;
    const double ge1_7 = w52 + w53;
    const double ge1_2 = w49 + w50;
    const double ge1_5 = w53 - w52;
    const double ge1_8 = 1.0 - (w43 + w51);
    const double w54 = 0.99 * h;
    const double w55 = 0.01 * h;
    const double new_g00 = g00 * ge1_0 + g01 * ge1_3 + g02 * ge1_6;
    const double new_g01 = g00 * ge1_1 + g01 * ge1_4 + g02 * ge1_7;
    const double new_g02 = g00 * ge1_2 + g01 * ge1_5 + g02 * ge1_8;
    const double new_g10 = g10 * ge1_0 + g11 * ge1_3 + g12 * ge1_6;
    const double new_g11 = g10 * ge1_1 + g11 * ge1_4 + g12 * ge1_7;
    const double new_g12 = g10 * ge1_2 + g11 * ge1_5 + g12 * ge1_8;
    const double new_g20 = g20 * ge1_0 + g21 * ge1_3 + g22 * ge1_6;
    const double new_g21 = g20 * ge1_1 + g21 * ge1_4 + g22 * ge1_7;
    const double new_g22 = g20 * ge1_2 + g21 * ge1_5 + g22 * ge1_8;
    const double new_mu0 = s_mu_0_seen + xi1_2 * w54 * d_xi1_1 + xi1_1 * w54 * d_xi1_2;
    const double new_mu1 = s_mu_1_seen - d_xi1_0 * xe1_2 - d_xi1_2 * xe1_0;
    const double new_mu2 = s_mu_2_seen + xi1_1 * w55 * d_xi1_0 + xi1_0 * w55 * d_xi1_1;
    /* If the sum of all x overflows, test each x: x - x is 0 only if x is finite. */
    if (!isfinite(new_g00 + new_g01 + (new_g02 + new_g10) + (new_g11 + new_g12)
        + (new_g20 + new_g21) + (new_g22 + new_mu0) + (new_mu1 + new_mu2)) && !(new_g00
        - new_g00 + (new_g01 - new_g01) + (new_g02 - new_g02 + (new_g10 - new_g10))
        + (new_g11 - new_g11 + (new_g12 - new_g12)) + (new_g20 - new_g20 + (new_g21 - new_g21))
        + (new_g22 - new_g22 + (new_mu0 - new_mu0)) + (new_mu1 - new_mu1 + (new_mu2 - new_mu2))
        == 0.0)) {
        return DIPOLE_VCG_TRIPLE_JUMP_NOT_FINITE;
    }
    memory->age_1 = 0;
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
    return DIPOLE_VCG_TRIPLE_JUMP_OK;
}

/*
 * Repeat a failed substep with a new initial guess. If the substep fails again, the step size is
 * halved until the substep succeeds. Each solution is then the initial guess for a longer substep
 * (continuation in h).
 */
static int dipole_vcg_triple_jump_continued(double state[static 12], double h,
    struct dipole_vcg_triple_jump_memory *memory,
    dipole_vcg_triple_jump_statistics *statistics)
{
    if (!(h < 0.0 || h > 0.0)) {
        return dipole_vcg_triple_jump_all_finite(state, 12) ? DIPOLE_VCG_TRIPLE_JUMP_OK
            : DIPOLE_VCG_TRIPLE_JUMP_NOT_FINITE;
    }
    double known_solution[3] = {0.0};
    double trial[12];
    double solved = 0.0;
    double part = 1.0;
    double factor = 2.0;
    int failure = DIPOLE_VCG_TRIPLE_JUMP_NOT_CONVERGED;
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
        const int status = dipole_vcg_triple_jump_substep(trial, part * h, memory, statistics);
        done = status == DIPOLE_VCG_TRIPLE_JUMP_OK && part >= 1.0;
        if (status == DIPOLE_VCG_TRIPLE_JUMP_OK) {
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
        return solved > 0.0 && failure == DIPOLE_VCG_TRIPLE_JUMP_NOT_FINITE
            ? DIPOLE_VCG_TRIPLE_JUMP_TOO_FAR : failure;
    }
    memcpy(state, trial, sizeof trial);
    memory->known = 1;
    if (statistics != NULL) {
        statistics->failed = 0;
    }
    return DIPOLE_VCG_TRIPLE_JUMP_OK;
}

/* One step: the composition of its substeps. */
static inline int dipole_vcg_triple_jump_advance(double state[static 12], double h,
    struct dipole_vcg_triple_jump_memory memory[static 3],
    dipole_vcg_triple_jump_statistics *statistics)
{
    double next[12];
    memcpy(next, state, sizeof next);
    int status = DIPOLE_VCG_TRIPLE_JUMP_OK;
    size_t part_number = 0;
    while (status == DIPOLE_VCG_TRIPLE_JUMP_OK && part_number < 3) {
        status = dipole_vcg_triple_jump_substep(next,
            dipole_vcg_triple_jump_fraction[part_number] * h, &memory[part_number], statistics);
        if (status != DIPOLE_VCG_TRIPLE_JUMP_OK && status != DIPOLE_VCG_TRIPLE_JUMP_BAD_STEP) {
            status = dipole_vcg_triple_jump_continued(next,
                dipole_vcg_triple_jump_fraction[part_number] * h, &memory[part_number], statistics);
        }
        part_number++;
    }
    if (status == DIPOLE_VCG_TRIPLE_JUMP_OK) {
        memcpy(state, next, sizeof next);
    }
    return status;
}

/* Convert space momentum to body momentum. */
static inline void dipole_vcg_triple_jump_to_body(const double state[static 12],
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
static inline void dipole_vcg_triple_jump_to_space(const double state[static 12],
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
static void dipole_vcg_triple_jump_enter_body(const double state[static 12],
    double moving[static 12], double before[static 3])
{
    dipole_vcg_triple_jump_to_body(state, before);
    memcpy(moving, state, 9 * sizeof *state);
    memcpy(moving + 9, before, 3 * sizeof *before);
    dipole_vcg_triple_jump_to_space(moving, before);
}

/*
 * Update the state at the end of a run. The group element is copied from 'moving'. The momentum in
 * 'moving' is converted to the space frame. The converted momentum minus 'before' is the increase of
 * the momentum during the run. This increase is added to the momentum of the state.
 */
static int dipole_vcg_triple_jump_leave_body(const double moving[static 12],
    const double before[static 3], double state[static 12])
{
    double momentum[3];
    dipole_vcg_triple_jump_to_space(moving, momentum);
    for (size_t i = 0; i < 3; i++) {
        momentum[i] = state[i + 9] + (momentum[i] - before[i]);
    }
    if (!dipole_vcg_triple_jump_all_finite(momentum, 3)) {
        return DIPOLE_VCG_TRIPLE_JUMP_NOT_FINITE;
    }
    memcpy(state, moving, 9 * sizeof *moving);
    memcpy(state + 9, momentum, sizeof momentum);
    return DIPOLE_VCG_TRIPLE_JUMP_OK;
}

int dipole_vcg_triple_jump_step(double state[static 12], double h,
    dipole_vcg_triple_jump_statistics *statistics)
{
    double moving[12];
    double before[3];
    dipole_vcg_triple_jump_enter_body(state, moving, before);
    struct dipole_vcg_triple_jump_memory memory[3] = {0};
    int status = dipole_vcg_triple_jump_advance(moving, h, memory, statistics);
    if (status == DIPOLE_VCG_TRIPLE_JUMP_OK) {
        status = dipole_vcg_triple_jump_leave_body(moving, before, state);
    }
    return status;
}

int dipole_vcg_triple_jump_run(double state[static 12], double h, size_t steps,
    double *trajectory, size_t stride, dipole_vcg_triple_jump_statistics *statistics,
    size_t *completed)
{
    int status = DIPOLE_VCG_TRIPLE_JUMP_OK;
    size_t step = 0;
    struct dipole_vcg_triple_jump_memory memory[3] = {0};
    const int recording = stride > 0 && trajectory != NULL;
    size_t row = 0;
    if (recording) {
        memcpy(trajectory, state, 12 * sizeof *state);
    }
    double moving[12];
    double before[3];
    dipole_vcg_triple_jump_enter_body(state, moving, before);
    while (status == DIPOLE_VCG_TRIPLE_JUMP_OK && step < steps) {
        status = dipole_vcg_triple_jump_advance(moving, h, memory, statistics);
        if (status == DIPOLE_VCG_TRIPLE_JUMP_OK) {
            step++;
            if (recording && step % stride == 0) {
                row++;
                memcpy(trajectory + 12 * row, state, 12 * sizeof *state);
                status = dipole_vcg_triple_jump_leave_body(moving, before, trajectory + 12 * row);
            }
        }
    }
    if (step > 0) {
        const int ended = dipole_vcg_triple_jump_leave_body(moving, before, state);
        if (ended != DIPOLE_VCG_TRIPLE_JUMP_OK) {
            status = DIPOLE_VCG_TRIPLE_JUMP_NOT_FINITE;
            step = 0;
        }
    }
    if (completed != NULL) {
        *completed = step;
    }
    return status;
}
