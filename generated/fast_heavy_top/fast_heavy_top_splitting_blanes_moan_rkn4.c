/*
 * Fast heavy top with body inertia, T*SO(3) (Brüls and Cardona 2010): one step by
 * splitting:blanes_moan_rkn4
 *
 * method:     family splitting, tableau blanes_moan_rkn4
 * source:     Blanes and Moan 2002, Table 3, SRKN_6^b of order four
 * order:      4, certificate: ball (interval arithmetic proves that a method of this order exists,
 *             and that its coefficients differ from the decimals of the tableau by at most one
 *             unit in the last digit)
 * digits:     with the coefficients rounded to double precision, the residuals of the order
 *             conditions are at most 5.6e-17
 * scene:      Fast heavy top with body inertia, T*SO(3) (Brüls and Cardona 2010), group SO(3)
 * flows:      T.mean, rotation about the momentum; T.turn, turn about the axis (0, 1, 0) fixed in
 *             the body; V, kick
 * state:      [0..8] q: element of SO(3), row by row
 *             [9..11] mu: right-trivialised momentum in the dual of the Lie algebra of SO(3)
 * left out:   5 flows: two flows of one term of H are joined if they commute with all flows
 *             between them
 *             the time is not needed: no formula depends on the time
 *             a solver for implicit equations: all stages are explicit
 * operations: 201 add, 335 mul, 6 stumpff_12 a step
 *             2 add, 4 mul once in each run
 *             9 add, 21 mul, 1 stumpff_12 once in each run
 * stack:      at most 3008 bytes with gcc 12 and clang 14 at -O0 to -O3 on x86-64; math library
 *             functions need extra bytes
 * command:    orderconds emit fast_heavy_top --method splitting:blanes_moan_rkn4 --target c -o .
 * version:    orderconds 0.1.0
 *
 * Build: cc -std=c11 -O2 -ffp-contract=off -c fast_heavy_top_splitting_blanes_moan_rkn4.c
 * Use:
 *
 *     #include "fast_heavy_top_splitting_blanes_moan_rkn4.h"
 *     #include <stdio.h>
 *
 *     int main(void)
 *     {
 *         double state[12] = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 70.3125, -70.3124296875};
 *         size_t completed;
 *         const int status = fast_heavy_top_splitting_blanes_moan_rkn4_run(state, 0.02, 100, NULL, 0, &completed);
 *         printf("status %d after %zu steps\n", status, completed);
 *         for (int i = 0; i < 12; i++) {
 *             printf("%.17g\n", state[i]);
 *         }
 *         return status;
 *     }
 */
#include "fast_heavy_top_splitting_blanes_moan_rkn4.h"

#include <math.h>
#include <string.h>

#if defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__
#error "compile without -ffast-math (-ffinite-math-only): it removes the checks for infinities and NaNs"
#endif

/* c_2(z) for z <= 1/256 */
static inline double fast_heavy_top_splitting_blanes_moan_rkn4_stumpff_tiny_2(double z)
{
    const double w = z * z;
    return (0.5 + z * -0.04166666666666365)
        + w * (0.0013888888842068215 + z * -2.4799519568559804e-05);
}

/* c_1(z) for z <= 1/256 */
static inline double fast_heavy_top_splitting_blanes_moan_rkn4_stumpff_tiny_1(double z)
{
    const double w = z * z;
    return (1.0 + z * -0.16666666666663651)
        + w * (0.00833333328651266 + z * -0.00019839202108242344);
}

/* c_2(z) for z <= 1/16 */
static inline double fast_heavy_top_splitting_blanes_moan_rkn4_stumpff_small_2(double z)
{
    const double w = z * z;
    return (0.5 + z * -0.041666666666666664)
        + w * (0.0013888888888888278 + z * -2.4801587297080002e-05)
        + w * w * (2.7557304737591345e-07 + z * -2.0855622118602925e-09);
}

/* c_1(z) for z <= 1/16 */
static inline double fast_heavy_top_splitting_blanes_moan_rkn4_stumpff_small_1(double z)
{
    const double w = z * z;
    return (1.0 + z * -0.16666666666666666)
        + w * (0.008333333333332476 + z * -0.0001984126983495962)
        + w * w * (2.755729894303353e-06 + z * -2.5022519568470477e-08);
}

/* c_2(z) = sum_j (-z)^j/(2j+2)!, truncated, for 0 <= z <= 1 */
static inline double fast_heavy_top_splitting_blanes_moan_rkn4_stumpff_series_2(double z)
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
static inline double fast_heavy_top_splitting_blanes_moan_rkn4_stumpff_series_1(double z)
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
static void fast_heavy_top_splitting_blanes_moan_rkn4_stumpff_12_far(double z, double *c1, double *c2)
{
    if (z <= 1.0) {
        *c1 = fast_heavy_top_splitting_blanes_moan_rkn4_stumpff_series_1(z);
        *c2 = fast_heavy_top_splitting_blanes_moan_rkn4_stumpff_series_2(z);
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

/* For z >= 0 and s = sqrt(z): c_1 = sin(s)/s, c_2 = (1 - cos(s))/s^2 */
static inline void fast_heavy_top_splitting_blanes_moan_rkn4_stumpff_12(double z, double *c1, double *c2)
{
    if (z <= 0.00390625) {
        *c1 = fast_heavy_top_splitting_blanes_moan_rkn4_stumpff_tiny_1(z);
        *c2 = fast_heavy_top_splitting_blanes_moan_rkn4_stumpff_tiny_2(z);
    } else if (z <= 0.0625) {
        *c1 = fast_heavy_top_splitting_blanes_moan_rkn4_stumpff_small_1(z);
        *c2 = fast_heavy_top_splitting_blanes_moan_rkn4_stumpff_small_2(z);
    } else {
        fast_heavy_top_splitting_blanes_moan_rkn4_stumpff_12_far(z, c1, c2);
    }
}

/* Whether n numbers are all finite */
static int fast_heavy_top_splitting_blanes_moan_rkn4_all_finite(const double *x, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        if (!isfinite(x[i])) {
            return 0;
        }
    }
    return 1;
}

/* Apply all flows of one step except the deferred flows. */
static inline void fast_heavy_top_splitting_blanes_moan_rkn4_advance(double state[static 12],
    double h, double lead_h)
{
    const double g01 = state[1];
    const double g02 = state[2];
    const double g11 = state[4];
    const double g12 = state[5];
    const double g21 = state[7];
    const double g22 = state[8];
    const double mu0 = state[9];
    const double mu1 = state[10];
    const double mu2 = state[11];
    const double w1 = 0.016101675138249585 * h;
    const double w2 = mu0 * w1;
    const double w3 = mu1 * w1;
    const double w4 = mu2 * w1;
    const double w5 = w4 * w4;
    const double w6 = w2 * w2 + w3 * w3 + w5;
    const double w8 = g01 * w4 - g21 * w2;
    const double w10 = g21 * w3 - g11 * w4;
    const double w11 = g11 * w2 - g01 * w3;
    const double w13 = 0.03970446215949653 * h;
    const double w14 = 58.31698729048485 * h;
    const double w15 = w13 * w14;
    const double w17 = -58.31698729048485 * h;
    const double w18 = w13 * w17;
    const double w21 = mu2 * w13;
    const double w22 = w21 * w21;
    const double w31 = -0.022985624477233298 * h;
    const double w33 = -5.747135269323566 * h;
    const double w34 = w31 * w33;
    const double w37 = 5.747135269323566 * h;
    const double w38 = w31 * w37;
    const double w41 = mu2 * w31;
    const double w42 = w41 * w41;
    const double w54 = 17.587985149035177 * h;
    const double w55 = w31 * w54;
    const double w58 = -17.587985149035177 * h;
    const double w59 = w31 * w58;
    const double w73 = w13 * w33;
    const double w76 = w13 * w37;
    const double w90 = w1 * w14;
    const double w93 = w1 * w17;
    const double w105 = g12 * w2 - g02 * w3;
    const double w106 = g02 * w4 - g22 * w2;
    const double w107 = g22 * w3 - g12 * w4;
    double c1_1, c2_1;
    fast_heavy_top_splitting_blanes_moan_rkn4_stumpff_12(w6, &c1_1, &c2_1);
    const double w12 = w4 * w10 - w2 * w11;
    const double w19 = w3 * w11 - w4 * w8;
    const double q1_4 = g11 + w8 * c1_1 + w12 * c2_1;
    const double w16 = w13 * (mu0 - g11 * w14) - w8 * w15 * c1_1 - w12 * w15 * c2_1;
    const double w20 = w13 * (mu1 - g01 * w17) - w10 * w18 * c1_1 - w18 * w19 * c2_1;
    const double w23 = w16 * w16 + w20 * w20 + w22;
    const double q1_1 = g01 + w10 * c1_1 + w19 * c2_1;
    const double q1_7 = g21 + w11 * c1_1 + (w2 * w8 - w3 * w10) * c2_1;
    const double w25 = w21 * q1_1 - w16 * q1_7;
    const double w27 = w20 * q1_7 - q1_4 * w21;
    const double w28 = q1_4 * w16 - w20 * q1_1;
    const double w32 = mu0 - q1_4 * w14;
    const double w36 = mu1 - w17 * q1_1;
    const double q1_8 = g22 + w105 * c1_1 + (w2 * w106 - w3 * w107) * c2_1;
    const double q1_5 = g12 + w106 * c1_1 + (w4 * w107 - w2 * w105) * c2_1;
    const double q1_2 = g02 + w107 * c1_1 + (w3 * w105 - w4 * w106) * c2_1;
    const double w108 = w16 * q1_5 - w20 * q1_2;
    const double w109 = w21 * q1_2 - w16 * q1_8;
    const double w110 = w20 * q1_8 - w21 * q1_5;
    double c1_2, c2_2;
    fast_heavy_top_splitting_blanes_moan_rkn4_stumpff_12(w23, &c1_2, &c2_2);
    const double w29 = w21 * w27 - w16 * w28;
    const double w39 = w20 * w28 - w21 * w25;
    const double w30 = q1_4 + w25 * c1_2 + w29 * c2_2;
    const double w35 = w31 * (w32 - q1_4 * w33) - w25 * w34 * c1_2 - w29 * w34 * c2_2;
    const double w40 = w31 * (w36 - q1_1 * w37) - w27 * w38 * c1_2 - w38 * w39 * c2_2;
    const double w43 = w35 * w35 + w40 * w40 + w42;
    const double w45 = q1_1 + w27 * c1_2 + w39 * c2_2;
    const double w46 = q1_7 + w28 * c1_2 + (w16 * w25 - w20 * w27) * c2_2;
    const double w47 = w41 * w45 - w35 * w46;
    const double w49 = w40 * w46 - w30 * w41;
    const double w50 = w30 * w35 - w40 * w45;
    const double w53 = w32 - w30 * w33;
    const double w57 = w36 - w37 * w45;
    const double w111 = q1_8 + w108 * c1_2 + (w16 * w109 - w20 * w110) * c2_2;
    const double w112 = q1_5 + w109 * c1_2 + (w21 * w110 - w16 * w108) * c2_2;
    const double w113 = q1_2 + w110 * c1_2 + (w20 * w108 - w21 * w109) * c2_2;
    const double w114 = w35 * w112 - w40 * w113;
    const double w115 = w41 * w113 - w35 * w111;
    const double w116 = w40 * w111 - w41 * w112;
    double c1_3, c2_3;
    fast_heavy_top_splitting_blanes_moan_rkn4_stumpff_12(w43, &c1_3, &c2_3);
    const double w51 = w41 * w49 - w35 * w50;
    const double w60 = w40 * w50 - w41 * w47;
    const double w52 = w30 + w47 * c1_3 + w51 * c2_3;
    const double w56 = w31 * (w53 - w30 * w54) - w47 * w55 * c1_3 - w51 * w55 * c2_3;
    const double w61 = w31 * (w57 - w45 * w58) - w49 * w59 * c1_3 - w59 * w60 * c2_3;
    const double w62 = w56 * w56 + w61 * w61 + w42;
    const double w64 = w45 + w49 * c1_3 + w60 * c2_3;
    const double w65 = w46 + w50 * c1_3 + (w35 * w47 - w40 * w49) * c2_3;
    const double w66 = w41 * w64 - w56 * w65;
    const double w68 = w61 * w65 - w41 * w52;
    const double w69 = w52 * w56 - w61 * w64;
    const double w72 = w53 - w52 * w54;
    const double w75 = w57 - w58 * w64;
    const double w117 = w111 + w114 * c1_3 + (w35 * w115 - w40 * w116) * c2_3;
    const double w118 = w112 + w115 * c1_3 + (w41 * w116 - w35 * w114) * c2_3;
    const double w119 = w113 + w116 * c1_3 + (w40 * w114 - w41 * w115) * c2_3;
    const double w120 = w56 * w118 - w61 * w119;
    const double w121 = w41 * w119 - w56 * w117;
    const double w122 = w61 * w117 - w41 * w118;
    double c1_4, c2_4;
    fast_heavy_top_splitting_blanes_moan_rkn4_stumpff_12(w62, &c1_4, &c2_4);
    const double w70 = w41 * w68 - w56 * w69;
    const double w77 = w61 * w69 - w41 * w66;
    const double w71 = w52 + w66 * c1_4 + w70 * c2_4;
    const double w74 = w13 * (w72 - w33 * w52) - w66 * w73 * c1_4 - w70 * w73 * c2_4;
    const double w78 = w13 * (w75 - w37 * w64) - w68 * w76 * c1_4 - w76 * w77 * c2_4;
    const double w79 = w74 * w74 + w78 * w78 + w22;
    const double w81 = w64 + w68 * c1_4 + w77 * c2_4;
    const double w82 = w65 + w69 * c1_4 + (w56 * w66 - w61 * w68) * c2_4;
    const double w83 = w21 * w81 - w74 * w82;
    const double w85 = w78 * w82 - w21 * w71;
    const double w86 = w71 * w74 - w78 * w81;
    const double w89 = w72 - w33 * w71;
    const double w92 = w75 - w37 * w81;
    const double w123 = w117 + w120 * c1_4 + (w56 * w121 - w61 * w122) * c2_4;
    const double w124 = w118 + w121 * c1_4 + (w41 * w122 - w56 * w120) * c2_4;
    const double w125 = w119 + w122 * c1_4 + (w61 * w120 - w41 * w121) * c2_4;
    const double w126 = w74 * w124 - w78 * w125;
    const double w127 = w21 * w125 - w74 * w123;
    const double w128 = w78 * w123 - w21 * w124;
    double c1_5, c2_5;
    fast_heavy_top_splitting_blanes_moan_rkn4_stumpff_12(w79, &c1_5, &c2_5);
    const double w87 = w21 * w85 - w74 * w86;
    const double w94 = w78 * w86 - w21 * w83;
    const double w88 = w71 + w83 * c1_5 + w87 * c2_5;
    const double w91 = w1 * (w89 - w14 * w71) - w83 * w90 * c1_5 - w87 * w90 * c2_5;
    const double w95 = w1 * (w92 - w17 * w81) - w85 * w93 * c1_5 - w93 * w94 * c2_5;
    const double w96 = w91 * w91 + w95 * w95 + w5;
    const double w98 = w81 + w85 * c1_5 + w94 * c2_5;
    const double w99 = w82 + w86 * c1_5 + (w74 * w83 - w78 * w85) * c2_5;
    const double w100 = w4 * w98 - w91 * w99;
    const double w102 = w95 * w99 - w4 * w88;
    const double w103 = w88 * w91 - w95 * w98;
    const double w129 = w123 + w126 * c1_5 + (w74 * w127 - w78 * w128) * c2_5;
    const double w130 = w124 + w127 * c1_5 + (w21 * w128 - w74 * w126) * c2_5;
    const double w131 = w125 + w128 * c1_5 + (w78 * w126 - w21 * w127) * c2_5;
    const double w132 = w91 * w130 - w95 * w131;
    const double w133 = w4 * w131 - w91 * w129;
    const double w134 = w95 * w129 - w4 * w130;
    double c1_6, c2_6;
    fast_heavy_top_splitting_blanes_moan_rkn4_stumpff_12(w96, &c1_6, &c2_6);
    const double w104 = w88 + w100 * c1_6 + (w4 * w102 - w91 * w103) * c2_6;
    const double w135 = w129 + w132 * c1_6 + (w91 * w133 - w95 * w134) * c2_6;
    const double w136 = w99 + w103 * c1_6 + (w91 * w100 - w95 * w102) * c2_6;
    const double w137 = w130 + w133 * c1_6 + (w4 * w134 - w91 * w132) * c2_6;
    const double w138 = w98 + w102 * c1_6 + (w95 * w103 - w4 * w100) * c2_6;
    const double w139 = w131 + w134 * c1_6 + (w95 * w132 - w4 * w133) * c2_6;
    const double new_g00 = w104 * w135 - w136 * w137;
    const double new_g10 = w136 * w139 - w135 * w138;
    const double new_g20 = w137 * w138 - w104 * w139;
    const double new_mu0 = w89 - w14 * w88 - 147.15 * lead_h * w104;
    const double new_mu1 = w92 - w17 * w98 + 147.15 * lead_h * w138;
    const double new_mu2 = mu2;
    state[0] = new_g00;
    state[1] = w138;
    state[2] = w139;
    state[3] = new_g10;
    state[4] = w104;
    state[5] = w137;
    state[6] = new_g20;
    state[7] = w136;
    state[8] = w135;
    state[9] = new_mu0;
    state[10] = new_mu1;
    state[11] = new_mu2;
}

/* Apply the first flow of a step. */
static inline void fast_heavy_top_splitting_blanes_moan_rkn4_begin(double state[static 12],
    double h)
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
    const double new_g00 = g00;
    const double new_g01 = g01;
    const double new_g02 = g02;
    const double new_g10 = g10;
    const double new_g11 = g11;
    const double new_g12 = g12;
    const double new_g20 = g20;
    const double new_g21 = g21;
    const double new_g22 = g22;
    const double new_mu0 = mu0 - 12.211155404321127 * h * g11;
    const double new_mu1 = mu1 + 12.211155404321127 * h * g01;
    const double new_mu2 = mu2;
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
}

/* Apply the flows that commute with all other flows. */
static inline void fast_heavy_top_splitting_blanes_moan_rkn4_finish(double state[static 12],
    double elapsed_h)
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
    const double w1 = (g01 * mu0 + g11 * mu1 + g21 * mu2) * (2.0676923076923077 * elapsed_h);
    const double w2 = w1 * w1;
    double c1_1, c2_1;
    fast_heavy_top_splitting_blanes_moan_rkn4_stumpff_12(w2, &c1_1, &c2_1);
    const double w3 = 1.0 - w1 * c2_1 * w1;
    const double w4 = w1 * c1_1;
    const double new_g00 = g00 * w3 - g02 * w4;
    const double new_g01 = g01;
    const double new_g02 = g00 * w4 + g02 * w3;
    const double new_g10 = g10 * w3 - g12 * w4;
    const double new_g11 = g11;
    const double new_g12 = g10 * w4 + g12 * w3;
    const double new_g20 = g20 * w3 - g22 * w4;
    const double new_g21 = g21;
    const double new_g22 = g20 * w4 + g22 * w3;
    const double new_mu0 = mu0;
    const double new_mu1 = mu1;
    const double new_mu2 = mu2;
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
}

/* Make one step. Defer no flow to a later step. */
static int fast_heavy_top_splitting_blanes_moan_rkn4_complete_step(double state[static 12],
    double h)
{
    if (!isfinite(h)) {
        return FAST_HEAVY_TOP_SPLITTING_BLANES_MOAN_RKN4_BAD_STEP;
    }
    if (!fast_heavy_top_splitting_blanes_moan_rkn4_all_finite(state, 12)) {
        return FAST_HEAVY_TOP_SPLITTING_BLANES_MOAN_RKN4_NOT_FINITE;
    }
    double next[12];
    memcpy(next, state, sizeof next);
    const double lead = 0.08298440641740487 * h;
    fast_heavy_top_splitting_blanes_moan_rkn4_begin(next, h);
    fast_heavy_top_splitting_blanes_moan_rkn4_advance(next, h, lead);
    fast_heavy_top_splitting_blanes_moan_rkn4_finish(next, h);
    if (!fast_heavy_top_splitting_blanes_moan_rkn4_all_finite(next, 12)) {
        return FAST_HEAVY_TOP_SPLITTING_BLANES_MOAN_RKN4_NOT_FINITE;
    }
    memcpy(state, next, sizeof next);
    return FAST_HEAVY_TOP_SPLITTING_BLANES_MOAN_RKN4_OK;
}

/*
 * Find the cause of a failed step. If a step of size zero succeeds, the cause is the step size.
 * Otherwise the cause is the state.
 */
static int fast_heavy_top_splitting_blanes_moan_rkn4_cause(const double state[static 12],
    double h)
{
    double same[12];
    memcpy(same, state, sizeof same);
    const int status = fast_heavy_top_splitting_blanes_moan_rkn4_complete_step(same, 0.0 * h);
    return status == FAST_HEAVY_TOP_SPLITTING_BLANES_MOAN_RKN4_OK
        ? FAST_HEAVY_TOP_SPLITTING_BLANES_MOAN_RKN4_TOO_FAR
        : FAST_HEAVY_TOP_SPLITTING_BLANES_MOAN_RKN4_NOT_FINITE;
}

int fast_heavy_top_splitting_blanes_moan_rkn4_step(double state[static 12], double h)
{
    int status = fast_heavy_top_splitting_blanes_moan_rkn4_complete_step(state, h);
    if (status == FAST_HEAVY_TOP_SPLITTING_BLANES_MOAN_RKN4_NOT_FINITE) {
        status = fast_heavy_top_splitting_blanes_moan_rkn4_cause(state, h);
    }
    return status;
}

int fast_heavy_top_splitting_blanes_moan_rkn4_run(double state[static 12], double h,
    size_t steps, double *trajectory, size_t stride, size_t *completed)
{
    int status = FAST_HEAVY_TOP_SPLITTING_BLANES_MOAN_RKN4_OK;
    size_t asked = steps;
    if (steps > 0 && !isfinite(h)) {
        status = FAST_HEAVY_TOP_SPLITTING_BLANES_MOAN_RKN4_BAD_STEP;
        asked = 0;
    }
    if (status == FAST_HEAVY_TOP_SPLITTING_BLANES_MOAN_RKN4_OK && steps > 0
        && !fast_heavy_top_splitting_blanes_moan_rkn4_all_finite(state, 12)) {
        status = FAST_HEAVY_TOP_SPLITTING_BLANES_MOAN_RKN4_NOT_FINITE;
        asked = 0;
    }
    double next[12];
    double complete[12];
    int careful = 0;
    size_t step = 0;
    int again;
    do {
        step = 0;
        size_t late = 0;
        int begun = 0;
        const int recording = stride > 0 && trajectory != NULL;
        size_t row = 0;
        if (recording) {
            memcpy(trajectory, state, 12 * sizeof *state);
        }
        memcpy(next, state, sizeof next);
        memcpy(complete, state, sizeof complete);
        int good = 1;
        while (good && step < asked) {
            const int shown = recording && (step + 1) % stride == 0;
            late++;
            const int stop = shown || careful || step + 1 == asked || late == 256;
            const double lead = (stop ? 0.08298440641740487 : 0.16596881283480974) * h;
            if (!begun) {
                fast_heavy_top_splitting_blanes_moan_rkn4_begin(next, h);
            }
            begun = !stop;
            fast_heavy_top_splitting_blanes_moan_rkn4_advance(next, h, lead);
            if (stop) {
                fast_heavy_top_splitting_blanes_moan_rkn4_finish(next, (double)late * h);
                good = fast_heavy_top_splitting_blanes_moan_rkn4_all_finite(next, 12);
                if (good) {
                    late = 0;
                    memcpy(complete, next, sizeof complete);
                    if (shown) {
                        row++;
                        memcpy(trajectory + 12 * row, complete, sizeof complete);
                    }
                }
            }
            if (good) {
                step++;
            }
        }
        again = !good;
        if (again) {
            if (careful) {
                status = FAST_HEAVY_TOP_SPLITTING_BLANES_MOAN_RKN4_NOT_FINITE;
                asked = step;
            }
            careful = 1;
        }
    } while (again);
    memcpy(state, complete, sizeof complete);
    if (status == FAST_HEAVY_TOP_SPLITTING_BLANES_MOAN_RKN4_NOT_FINITE) {
        status = fast_heavy_top_splitting_blanes_moan_rkn4_cause(state, h);
    }
    if (completed != NULL) {
        *completed = step;
    }
    return status;
}
