/*
 * Heavy top as printed, T*SO(3) (thesis section 2.5): one step by slgi:midpoint
 *
 * method:     family slgi, tableau midpoint
 * source:     Table 3.2a of Bogfjellmo and Marthinsen
 * order:      2, certificate: exact (every order condition up to it is zero in exact arithmetic)
 * scene:      Heavy top as printed, T*SO(3) (thesis section 2.5), group SO(3)
 * state:      [0..8] q: element of SO(3), row by row
 *             [9..11] mu: right-trivialised momentum in the dual algebra of SO(3)
 * left out:   the time: the scene does not depend on it
 * operations: 52 add, 80 mul, 1 stumpff_12, 1 stumpff_1 a step
 *             45 add, 78 mul, 1 stumpff_12, 2 stumpff_23 a sweep of the equations of xi1, n1
 * stack:      at most 1600 bytes, without what the mathematical library takes
 * made by:    orderconds emit heavy_top --method slgi:midpoint --target c -o .
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

static void count_sweeps(heavy_top_slgi_midpoint_statistics *statistics, size_t block, size_t sweeps, int failed)
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
    const double w10 = -0.5 * h;
    const double w17 = 0.5 * h;
    /* the equations of xi1, n1: fixed point in xi1_0, xi1_1, xi1_2, n1_0, n1_1, n1_2 */
    double xi1_0 = 0.001 * mu0;
    double xi1_1 = 0.0002 * mu1;
    double xi1_2 = 0.00016666666666666666 * mu2;
    double n1_0 = -g12;
    double n1_1 = g02;
    double n1_2 = 0.0;
    double z_0, z_1, z_2, w11, w12, f1_0, f1_1, f1_2, Q1_5, Q1_2;
    double previous_1 = 0.0;
    for (size_t sweep = 1;; sweep++) {
        const double w1 = h * xi1_0;
        const double w2 = h * xi1_1;
        const double w3 = h * xi1_2;
        const double w4 = w1 * w1 + w2 * w2 + w3 * w3;
        double c2_1, c3_1;
        stumpff_23(w4, &c2_1, &c3_1);
        const double w6 = mu1 * w3 - mu2 * w2;
        const double w8 = mu2 * w1 - mu0 * w3;
        const double w9 = mu0 * w2 - mu1 * w1;
        z_0 = xi1_0 * w10;
        z_1 = xi1_1 * w10;
        z_2 = xi1_2 * w10;
        w11 = z_0 * z_0 + z_1 * z_1 + z_2 * z_2;
        double c2_2, c3_2;
        stumpff_23(w11, &c2_2, &c3_2);
        w12 = c2_2;
        const double w13 = n1_2 * z_1 - n1_1 * z_2;
        const double w15 = n1_1 * z_0 - n1_0 * z_1;
        const double w16 = n1_0 * z_2 - n1_2 * z_0;
        const double M1_0 = mu0 - w6 * c2_1 + (w3 * w8 - w2 * w9) * c3_1
            + w17 * (n1_0 - w12 * w13 + (z_1 * w15 - z_2 * w16) * c3_2);
        f1_0 = 0.001 * M1_0;
        const double M1_1 = mu1 - w8 * c2_1 + (w1 * w9 - w3 * w6) * c3_1
            + w17 * (n1_1 - w12 * w16 + (z_2 * w13 - z_0 * w15) * c3_2);
        f1_1 = 0.0002 * M1_1;
        const double M1_2 = mu2 - w9 * c2_1 + (w2 * w6 - w1 * w8) * c3_1
            + w17 * (n1_2 - w12 * w15 + (z_0 * w16 - z_1 * w13) * c3_2);
        f1_2 = 0.00016666666666666666 * M1_2;
        const double X1_2 = xi1_2 * w17;
        const double X1_0 = xi1_0 * w17;
        const double X1_1 = xi1_1 * w17;
        const double w18 = X1_0 * X1_0 + X1_1 * X1_1 + X1_2 * X1_2;
        double c1_1, c2_3;
        stumpff_12(w18, &c1_1, &c2_3);
        const double w20 = X1_2 * c1_1;
        const double w22 = X1_0 * c2_3;
        const double w23 = X1_1 * w22;
        const double w24 = X1_2 * c2_3 * X1_2;
        const double w25 = X1_1 * c2_3;
        Q1_5 = g02 * (w20 + w23) + g12 * (1.0 - (X1_0 * w22 + w24))
            + g22 * (X1_2 * w25 - X1_0 * c1_1);
        Q1_2 = g12 * (w23 - w20) + g02 * (1.0 - (w24 + X1_1 * w25))
            + g22 * (X1_2 * w22 + X1_1 * c1_1);
        const double next_n1_0 = -Q1_5;
        const double next_n1_2 = 0.0;
        const double change_xi1_0 = fabs(f1_0 - xi1_0);
        const double change_xi1_1 = fabs(f1_1 - xi1_1);
        const double change_xi1_2 = fabs(f1_2 - xi1_2);
        const double change_n1_0 = fabs(next_n1_0 - n1_0);
        const double change_n1_1 = fabs(Q1_2 - n1_1);
        const double change_n1_2 = fabs(next_n1_2 - n1_2);
        const double change = greater(greater(change_xi1_0, greater(change_xi1_1, change_xi1_2)),
            greater(change_n1_0, greater(change_n1_1, change_n1_2)));
        const double scale = greater(greater(1.0, greater(fabs(xi1_0), fabs(xi1_1))),
            greater(greater(fabs(xi1_2), fabs(n1_0)), greater(fabs(n1_1), fabs(n1_2))));
        if (!isfinite(change_xi1_0 + change_xi1_1 + change_xi1_2 + change_n1_0 + change_n1_1
            + change_n1_2)) {
            count_sweeps(statistics, 0, sweep, 1);
            return HEAVY_TOP_SLGI_MIDPOINT_NOT_FINITE;
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
            return HEAVY_TOP_SLGI_MIDPOINT_NOT_CONVERGED;
        }
        previous_1 = change;
        xi1_0 = f1_0;
        xi1_1 = f1_1;
        xi1_2 = f1_2;
        n1_0 = next_n1_0;
        n1_1 = Q1_2;
        n1_2 = next_n1_2;
    }
    const double Y_1 = h * f1_1;
    const double Y_0 = h * f1_0;
    const double Y_2 = h * f1_2;
    const double w26 = Y_0 * Y_0 + Y_1 * Y_1 + Y_2 * Y_2;
    double c1_2, c2_4;
    stumpff_12(w26, &c1_2, &c2_4);
    const double w28 = Y_1 * c2_4;
    const double w29 = Y_1 * w28;
    const double w30 = Y_2 * c2_4 * Y_2;
    const double g_0 = 1.0 - (w29 + w30);
    const double w31 = Y_0 * c2_4;
    const double w32 = Y_1 * w31;
    const double w34 = Y_2 * c1_2;
    const double g_1 = w32 - w34;
    const double w35 = Y_1 * c1_2;
    const double w36 = Y_2 * w31;
    const double g_2 = w35 + w36;
    const double g_3 = w32 + w34;
    const double w37 = Y_0 * w31;
    const double g_4 = 1.0 - (w30 + w37);
    const double w38 = Y_2 * w28;
    const double w39 = Y_0 * c1_2;
    const double g_5 = w38 - w39;
    const double g_6 = w36 - w35;
    const double g_7 = w38 + w39;
    const double g_8 = 1.0 - (w29 + w37);
    const double c1_3 = stumpff_1(w11);
    const double w41 = z_2 * c1_3;
    const double w42 = z_0 * w12;
    const double w43 = z_1 * w42;
    const double w44 = z_1 * w12;
    const double w45 = z_2 * w12 * z_2;
    const double mu1_0 = mu0 * g_0 + mu1 * g_1 + mu2 * g_2
        + h * (Q1_2 * (w41 + w43) - Q1_5 * (1.0 - (z_1 * w44 + w45)));
    const double mu1_1 = mu0 * g_3 + mu1 * g_4 + mu2 * g_5
        + h * (Q1_2 * (1.0 - (w45 + z_0 * w42)) - Q1_5 * (w43 - w41));
    const double w46 = h * (Q1_2 * (z_2 * w44 - z_0 * c1_3) - Q1_5 * (z_2 * w42 + z_1 * c1_3));
    const double new_g00 = g00 * g_0 + g10 * g_1 + g20 * g_2;
    const double new_g01 = g01 * g_0 + g11 * g_1 + g21 * g_2;
    const double new_g02 = g02 * g_0 + g12 * g_1 + g22 * g_2;
    const double new_g10 = g00 * g_3 + g10 * g_4 + g20 * g_5;
    const double new_g11 = g01 * g_3 + g11 * g_4 + g21 * g_5;
    const double new_g12 = g02 * g_3 + g12 * g_4 + g22 * g_5;
    const double new_g20 = g00 * g_6 + g10 * g_7 + g20 * g_8;
    const double new_g21 = g01 * g_6 + g11 * g_7 + g21 * g_8;
    const double new_g22 = g02 * g_6 + g12 * g_7 + g22 * g_8;
    const double new_mu2 = mu0 * g_6 + mu1 * g_7 + mu2 * g_8 + w46;
    if (!(isfinite(new_g00) && isfinite(new_g01) && isfinite(new_g02) && isfinite(new_g10)
        && isfinite(new_g11) && isfinite(new_g12) && isfinite(new_g20) && isfinite(new_g21)
        && isfinite(new_g22) && isfinite(mu1_0) && isfinite(mu1_1) && isfinite(new_mu2))) {
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

int heavy_top_slgi_midpoint_step(double state[static 12], double h,
    heavy_top_slgi_midpoint_statistics *statistics)
{
    return advance(state, h, statistics);
}

int heavy_top_slgi_midpoint_run(double state[static 12], double h, size_t steps,
    double *trajectory, size_t stride, heavy_top_slgi_midpoint_statistics *statistics,
    size_t *completed)
{
    int status = HEAVY_TOP_SLGI_MIDPOINT_OK;
    size_t step = 0;
    double *row = stride > 0 ? trajectory : NULL;
    if (row != NULL) {
        memcpy(row, state, 12 * sizeof *state);
    }
    while (step < steps) {
        status = advance(state, h, statistics);
        if (status != HEAVY_TOP_SLGI_MIDPOINT_OK) {
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
