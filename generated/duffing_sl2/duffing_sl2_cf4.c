/*
 * Duffing's equation, SL(2) acting linearly: one step by cf:cf4
 *
 * method:     family cf, tableau cf4
 * source:     Celledoni, Marthinsen and Owren 2003; H. Marthinsen, On symplectic integration in
 *             Lie groups and manifolds, PhD thesis, NTNU 2014, Section 2.2.1
 * order:      4, certificate: exact (the residuals of all order conditions up to this order are
 *             zero in exact arithmetic)
 * digits:     with the coefficients rounded to double precision, the residuals of the order
 *             conditions are at most 2.8e-17
 * scene:      Duffing's equation, SL(2) acting linearly, group SL(2)
 * state:      [0..1] y: point on which SL(2) acts by linear maps
 * left out:   1 evaluation of the field: equal values are computed once
 *             5 exponentials: exp(x).y is computed without exp(x)
 *             the time is not needed: no formula depends on the time
 *             a solver for implicit equations: all stages are explicit
 * operations: 23 add, 48 mul, 5 signed_stumpff0, 5 signed_stumpff1 a step
 * stack:      at most 832 bytes with gcc 12 and clang 14 at -O0 to -O3 on x86-64; math library
 *             functions need extra bytes
 * command:    orderconds emit duffing_sl2 --method cf4 --target c -o .
 * version:    orderconds 0.1.0
 *
 * Build: cc -std=c11 -O2 -ffp-contract=off -c duffing_sl2_cf4.c
 * Use:
 *
 *     #include "duffing_sl2_cf4.h"
 *     #include <stdio.h>
 *
 *     int main(void)
 *     {
 *         double state[2] = {0.75, 0.75};
 *         size_t completed;
 *         const int status = duffing_sl2_cf4_run(state, 0.02, 100, NULL, 0, &completed);
 *         printf("status %d after %zu steps\n", status, completed);
 *         for (int i = 0; i < 2; i++) {
 *             printf("%.17g\n", state[i]);
 *         }
 *         return status;
 *     }
 */
#include "duffing_sl2_cf4.h"

#include <math.h>
#include <string.h>

#if defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__
#error "compile without -ffast-math (-ffinite-math-only): it removes the checks for infinities and NaNs"
#endif

/* c_1(z) for z <= 1/256 */
static inline double duffing_sl2_cf4_stumpff_tiny_1(double z)
{
    const double w = z * z;
    return (1.0 + z * -0.16666666666663651)
        + w * (0.00833333328651266 + z * -0.00019839202108242344);
}

/* c_0(z) for z <= 1/256 */
static inline double duffing_sl2_cf4_stumpff_tiny_0(double z)
{
    const double w = z * z;
    return (1.0 + z * -0.5)
        + w * (0.04166666666665553 + z * -0.001388888880278194)
        + w * w * 2.479896366618844e-05;
}

/* c_1(z) for z <= 1/16 */
static inline double duffing_sl2_cf4_stumpff_small_1(double z)
{
    const double w = z * z;
    return (1.0 + z * -0.16666666666666666)
        + w * (0.008333333333332476 + z * -0.0001984126983495962)
        + w * w * (2.755729894303353e-06 + z * -2.5022519568470477e-08);
}

/* c_0(z) for z <= 1/16 */
static inline double duffing_sl2_cf4_stumpff_small_0(double z)
{
    const double w = z * z;
    return (1.0 + z * -0.49999999999999994)
        + w * (0.04166666666665553 + z * -0.0013888888880685601)
        + w * w * (2.480156093634923e-05 + z * -2.7518853761923276e-07);
}

/* c_1(z) = sum_j (-z)^j/(2j+1)!, truncated, for 0 <= z <= 1 */
static inline double duffing_sl2_cf4_stumpff_series_1(double z)
{
    const double w = z * z;
    const double w2 = w * w;
    double even = -2.505210838544172e-08 + w * -7.647163731819816e-13;
    even = -0.16666666666666666 + w * -0.0001984126984126984 + w2 * even;
    double odd = 1.6059043836821613e-10 + w * 2.8114572543455206e-15;
    odd = 0.008333333333333333 + w * 2.7557319223985893e-06 + w2 * odd;
    return 1.0 + z * (even + z * odd);
}

/* c_0(z) = sum_j (-z)^j/(2j+0)!, truncated, for 0 <= z <= 1 */
static inline double duffing_sl2_cf4_stumpff_series_0(double z)
{
    const double w = z * z;
    const double w2 = w * w;
    double even = -1.5619206968586225e-16;
    even = -2.755731922398589e-07 + w * -1.1470745597729725e-11 + w2 * even;
    even = -0.5 + w * -0.001388888888888889 + w2 * even;
    double odd = 2.08767569878681e-09 + w * 4.779477332387385e-14;
    odd = 0.041666666666666664 + w * 2.48015873015873e-05 + w2 * odd;
    return 1.0 + z * (even + z * odd);
}

/* For z > 1/16 and s = sqrt(z): c_1 = sin(s)/s */
static double duffing_sl2_cf4_stumpff_1_far(double z)
{
    if (z <= 1.0) {
        return duffing_sl2_cf4_stumpff_series_1(z);
    }
    /* NaN if the angle is too large for an accurate result */
    const double s = sqrt(z <= 65536.0 ? z : (double)NAN);
    return sin(s) / s;
}

/* For z >= 0 and s = sqrt(z): c_1 = sin(s)/s */
static inline double duffing_sl2_cf4_stumpff_1(double z)
{
    if (z <= 0.00390625) {
        return duffing_sl2_cf4_stumpff_tiny_1(z);
    }
    return z <= 0.0625 ? duffing_sl2_cf4_stumpff_small_1(z) : duffing_sl2_cf4_stumpff_1_far(z);
}

/* For z > 1/16 and s = sqrt(z): c_0 = cos(s) */
static double duffing_sl2_cf4_stumpff_0_far(double z)
{
    if (z <= 1.0) {
        return duffing_sl2_cf4_stumpff_series_0(z);
    }
    /* NaN if the angle is too large for an accurate result */
    const double s = sqrt(z <= 65536.0 ? z : (double)NAN);
    return cos(s);
}

/* For z >= 0 and s = sqrt(z): c_0 = cos(s) */
static inline double duffing_sl2_cf4_stumpff_0(double z)
{
    if (z <= 0.00390625) {
        return duffing_sl2_cf4_stumpff_tiny_0(z);
    }
    return z <= 0.0625 ? duffing_sl2_cf4_stumpff_small_0(z) : duffing_sl2_cf4_stumpff_0_far(z);
}

/* c_1 = sin(s)/s with s = sqrt(z) for z >= 0, sinh(r)/r with r = sqrt(-z) for z < 0 */
static inline double duffing_sl2_cf4_signed_stumpff1(double z)
{
    if (z >= 0.0) {
        return duffing_sl2_cf4_stumpff_1(z);
    }
    const double r = sqrt(-z);
    return sinh(r) / r;
}

/* c_0 = cos(s) with s = sqrt(z) for z >= 0, cosh(r) with r = sqrt(-z) for z < 0 */
static inline double duffing_sl2_cf4_signed_stumpff0(double z)
{
    if (z >= 0.0) {
        return duffing_sl2_cf4_stumpff_0(z);
    }
    const double r = sqrt(-z);
    return cosh(r);
}

/* The loop over the steps of a run. */
static int duffing_sl2_cf4_loop(double state[static 2], double h, size_t steps,
    double *trajectory, size_t stride, size_t *completed)
{
    int status = DUFFING_SL2_CF4_OK;
    size_t step = 0;
    const int recording = stride > 0 && trajectory != NULL;
    size_t row = 0;
    if (recording) {
        memcpy(trajectory, state, 2 * sizeof *state);
    }
    if (steps > 0 && !isfinite(h)) {
        status = DUFFING_SL2_CF4_BAD_STEP;
    }
    double z0 = state[0];
    double z1 = state[1];
    while (status == DUFFING_SL2_CF4_OK && step < steps) {
        const double w1 = 0.25 * h;
        const double w2 = 0.3333333333333333 * h;
        const double w3 = -0.08333333333333333 * h;
        const double x_0 = w1 + w2 + w3;
        const double k0_1 = -1.0 - z0 * z0;
        const double x2_0 = 0.5 * h;
        const double w4 = x2_0 * x2_0;
        const double w5 = -k0_1 * w4;
        const double w6 = duffing_sl2_cf4_signed_stumpff0(w5);
        const double w7 = duffing_sl2_cf4_signed_stumpff1(w5);
        const double w8 = z0 * w6 + x2_0 * w7 * z1;
        const double w9 = -1.0 - w8 * w8;
        const double w10 = -w4 * w9;
        const double p_1 = z0 * duffing_sl2_cf4_signed_stumpff0(w10)
            + x2_0 * duffing_sl2_cf4_signed_stumpff1(w10) * z1;
        const double w11 = -1.0 - p_1 * p_1;
        const double w12 = 0.16666666666666666 * h * (w9 + w11);
        const double w13 = -0.5 * h;
        const double x4_0 = h + w13;
        const double w14 = -x4_0 * (k0_1 * w13 + h * w11);
        const double w15 = w8 * duffing_sl2_cf4_signed_stumpff0(w14)
            + x4_0 * duffing_sl2_cf4_signed_stumpff1(w14) * (z1 * w6 + k0_1 * x2_0 * w7 * z0);
        const double w16 = -1.0 - w15 * w15;
        const double w17 = w12 + w1 * k0_1 + w3 * w16;
        const double w18 = -x_0 * w17;
        const double w19 = duffing_sl2_cf4_signed_stumpff0(w18);
        const double w20 = duffing_sl2_cf4_signed_stumpff1(w18);
        const double w21 = z0 * w19 + x_0 * w20 * z1;
        const double x_2_0 = w2 + w3 + w1;
        const double w22 = w12 + w3 * k0_1 + w1 * w16;
        const double w23 = -x_2_0 * w22;
        const double w24 = duffing_sl2_cf4_signed_stumpff0(w23);
        const double w25 = w17 * w20 * z0 + z1 * w19;
        const double w26 = duffing_sl2_cf4_signed_stumpff1(w23);
        const double new_z0 = w21 * w24 + x_2_0 * w26 * w25;
        const double new_z1 = w22 * w26 * w21 + w24 * w25;
        /* If the sum of all x overflows, test each x: x - x is 0 only if x is finite. */
        if (isfinite(new_z0 + new_z1) || new_z0 - new_z0 + (new_z1 - new_z1) == 0.0) {
            z0 = new_z0;
            z1 = new_z1;
            step++;
            if (recording && step % stride == 0) {
                row++;
                trajectory[2 * row] = z0;
                trajectory[2 * row + 1] = z1;
            }
        } else {
            status = DUFFING_SL2_CF4_NOT_FINITE;
        }
    }
    state[0] = z0;
    state[1] = z1;
    if (completed != NULL) {
        *completed = step;
    }
    return status;
}

/*
 * Find the cause of a failed step. If a step of size zero succeeds, the cause is the step size.
 * Otherwise the cause is the state.
 */
static int duffing_sl2_cf4_cause(const double state[static 2], double h)
{
    double same[2];
    memcpy(same, state, sizeof same);
    const int status = duffing_sl2_cf4_loop(same, 0.0 * h, 1, NULL, 0, NULL);
    return status == DUFFING_SL2_CF4_OK ? DUFFING_SL2_CF4_TOO_FAR : DUFFING_SL2_CF4_NOT_FINITE;
}

int duffing_sl2_cf4_run(double state[static 2], double h, size_t steps, double *trajectory,
    size_t stride, size_t *completed)
{
    int status = duffing_sl2_cf4_loop(state, h, steps, trajectory, stride, completed);
    if (status == DUFFING_SL2_CF4_NOT_FINITE) {
        status = duffing_sl2_cf4_cause(state, h);
    }
    return status;
}

int duffing_sl2_cf4_step(double state[static 2], double h)
{
    const int status = duffing_sl2_cf4_run(state, h, 1, NULL, 0, NULL);
    return status;
}
