/*
 * Fast heavy top with body inertia, T*SO(3) (Brüls and Cardona 2010): one step by
 * splitting:blanes_moan_rkn6a
 *
 * method:     family splitting, tableau blanes_moan_rkn6a
 * source:     Blanes and Moan 2002, Table 3, SRKN_14^a of order six
 * order:      6, certificate: ball (interval arithmetic proves that a method of this order exists,
 *             and that its coefficients differ from the decimals of the tableau by at most one
 *             unit in the last digit)
 * digits:     with the coefficients rounded to double precision, the residuals of the order
 *             conditions are at most 1.8e-17
 * scene:      Fast heavy top with body inertia, T*SO(3) (Brüls and Cardona 2010), group SO(3)
 * flows:      T.mean, rotation about the momentum; T.turn, turn about the axis (0, 1, 0) fixed in
 *             the body; V, kick
 * state:      [0..8] q: element of SO(3), row by row
 *             [9..11] mu: right-trivialised momentum in the dual of the Lie algebra of SO(3)
 * left out:   14 flows: two flows of one term of H are joined if they commute with all flows
 *             between them
 *             the time is not needed: no formula depends on the time
 *             a solver for implicit equations: all stages are explicit
 * operations: 473 add, 786 mul, 14 stumpff_12 a step
 *             29 add, 49 mul, 1 stumpff_12 once in each run
 *             9 add, 21 mul, 1 stumpff_12 once in each run
 * stack:      at most 4800 bytes with gcc 12 and clang 14 at -O0 to -O3 on x86-64; math library
 *             functions need extra bytes
 * command:    orderconds emit fast_heavy_top --method splitting:blanes_moan_rkn6a --target c -o .
 * version:    orderconds 0.1.0
 *
 * Build: cc -std=c11 -O2 -ffp-contract=off -c fast_heavy_top_splitting_blanes_moan_rkn6a.c
 * Use:
 *
 *     #include "fast_heavy_top_splitting_blanes_moan_rkn6a.h"
 *     #include <stdio.h>
 *
 *     int main(void)
 *     {
 *         double state[12] = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 70.3125, -70.3124296875};
 *         size_t completed;
 *         const int status = fast_heavy_top_splitting_blanes_moan_rkn6a_run(state, 0.02, 100, NULL, 0, &completed);
 *         printf("status %d after %zu steps\n", status, completed);
 *         for (int i = 0; i < 12; i++) {
 *             printf("%.17g\n", state[i]);
 *         }
 *         return status;
 *     }
 */
#include "fast_heavy_top_splitting_blanes_moan_rkn6a.h"

#include <math.h>
#include <string.h>

#if defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__
#error "compile without -ffast-math (-ffinite-math-only): it removes the checks for infinities and NaNs"
#endif

/* c_2(z) for z <= 1/256 */
static inline double fast_heavy_top_splitting_blanes_moan_rkn6a_stumpff_tiny_2(double z)
{
    const double w = z * z;
    return (0.5 + z * -0.04166666666666365)
        + w * (0.0013888888842068215 + z * -2.4799519568559804e-05);
}

/* c_1(z) for z <= 1/256 */
static inline double fast_heavy_top_splitting_blanes_moan_rkn6a_stumpff_tiny_1(double z)
{
    const double w = z * z;
    return (1.0 + z * -0.16666666666663651)
        + w * (0.00833333328651266 + z * -0.00019839202108242344);
}

/* c_2(z) for z <= 1/16 */
static inline double fast_heavy_top_splitting_blanes_moan_rkn6a_stumpff_small_2(double z)
{
    const double w = z * z;
    return (0.5 + z * -0.041666666666666664)
        + w * (0.0013888888888888278 + z * -2.4801587297080002e-05)
        + w * w * (2.7557304737591345e-07 + z * -2.0855622118602925e-09);
}

/* c_1(z) for z <= 1/16 */
static inline double fast_heavy_top_splitting_blanes_moan_rkn6a_stumpff_small_1(double z)
{
    const double w = z * z;
    return (1.0 + z * -0.16666666666666666)
        + w * (0.008333333333332476 + z * -0.0001984126983495962)
        + w * w * (2.755729894303353e-06 + z * -2.5022519568470477e-08);
}

/* c_2(z) = sum_j (-z)^j/(2j+2)!, truncated, for 0 <= z <= 1 */
static inline double fast_heavy_top_splitting_blanes_moan_rkn6a_stumpff_series_2(double z)
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
static inline double fast_heavy_top_splitting_blanes_moan_rkn6a_stumpff_series_1(double z)
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
static void fast_heavy_top_splitting_blanes_moan_rkn6a_stumpff_12_far(double z, double *c1, double *c2)
{
    if (z <= 1.0) {
        *c1 = fast_heavy_top_splitting_blanes_moan_rkn6a_stumpff_series_1(z);
        *c2 = fast_heavy_top_splitting_blanes_moan_rkn6a_stumpff_series_2(z);
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
static inline void fast_heavy_top_splitting_blanes_moan_rkn6a_stumpff_12(double z, double *c1, double *c2)
{
    if (z <= 0.00390625) {
        *c1 = fast_heavy_top_splitting_blanes_moan_rkn6a_stumpff_tiny_1(z);
        *c2 = fast_heavy_top_splitting_blanes_moan_rkn6a_stumpff_tiny_2(z);
    } else if (z <= 0.0625) {
        *c1 = fast_heavy_top_splitting_blanes_moan_rkn6a_stumpff_small_1(z);
        *c2 = fast_heavy_top_splitting_blanes_moan_rkn6a_stumpff_small_2(z);
    } else {
        fast_heavy_top_splitting_blanes_moan_rkn6a_stumpff_12_far(z, c1, c2);
    }
}

/* Whether n numbers are all finite */
static int fast_heavy_top_splitting_blanes_moan_rkn6a_all_finite(const double *x, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        if (!isfinite(x[i])) {
            return 0;
        }
    }
    return 1;
}

/* Apply all flows of one step except the deferred flows. */
static inline void fast_heavy_top_splitting_blanes_moan_rkn6a_advance(double state[static 12],
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
    const double w1 = 13.496473308689533 * h;
    const double w2 = mu0 - g11 * w1;
    const double w3 = 0.006737108224160042 * h;
    const double w4 = w2 * w3;
    const double w5 = -13.496473308689533 * h;
    const double w6 = mu1 - g01 * w5;
    const double w7 = w3 * w6;
    const double w8 = mu2 * w3;
    const double w9 = w8 * w8;
    const double w18 = -0.001697994716984392 * h;
    const double w19 = 27.073123466236634 * h;
    const double w20 = w18 * w19;
    const double w22 = -27.073123466236634 * h;
    const double w23 = w18 * w22;
    const double w26 = mu2 * w18;
    const double w27 = w26 * w26;
    const double w38 = 0.020627127996484727 * h;
    const double w40 = -8.319031932309509 * h;
    const double w41 = w38 * w40;
    const double w44 = 8.319031932309509 * h;
    const double w45 = w38 * w44;
    const double w48 = mu2 * w38;
    const double w49 = w48 * w48;
    const double w60 = -0.00854281580422006 * h;
    const double w62 = 0.7231964531988159 * h;
    const double w63 = w60 * w62;
    const double w66 = -0.7231964531988159 * h;
    const double w67 = w60 * w66;
    const double w70 = mu2 * w60;
    const double w71 = w70 * w70;
    const double w82 = 0.006985366998616156 * h;
    const double w84 = 21.154449862824507 * h;
    const double w85 = w82 * w84;
    const double w88 = -21.154449862824507 * h;
    const double w89 = w82 * w88;
    const double w92 = mu2 * w82;
    const double w93 = w92 * w92;
    const double w104 = -0.0005772631386919248 * h;
    const double w106 = 48.348736134842206 * h;
    const double w107 = w104 * w106;
    const double w110 = -48.348736134842206 * h;
    const double w111 = w104 * w110;
    const double w114 = mu2 * w104;
    const double w115 = w114 * w114;
    const double w126 = 0.013607717353477945 * h;
    const double w128 = -28.901947293482188 * h;
    const double w129 = w126 * w128;
    const double w132 = 28.901947293482188 * h;
    const double w133 = w126 * w132;
    const double w136 = mu2 * w126;
    const double w149 = w104 * w128;
    const double w153 = w104 * w132;
    const double w167 = w82 * w106;
    const double w170 = w82 * w110;
    const double w184 = w60 * w84;
    const double w187 = w60 * w88;
    const double w201 = w38 * w62;
    const double w204 = w38 * w66;
    const double w218 = w18 * w40;
    const double w221 = w18 * w44;
    const double w235 = w3 * w19;
    const double w238 = w3 * w22;
    const double w251 = 0.06564102564102564 * lead_h;
    const double w253 = w1 * w251;
    const double w256 = w5 * w251;
    const double w259 = mu2 * w251;
    const double w10 = w4 * w4 + w7 * w7 + w9;
    const double w12 = g01 * w8 - g21 * w4;
    const double w14 = g21 * w7 - g11 * w8;
    const double w15 = g11 * w4 - g01 * w7;
    const double w16 = w8 * w14 - w4 * w15;
    const double w24 = w7 * w15 - w8 * w12;
    const double w269 = g12 * w4 - g02 * w7;
    const double w270 = g02 * w8 - g22 * w4;
    const double w271 = g22 * w7 - g12 * w8;
    double c1_1, c2_1;
    fast_heavy_top_splitting_blanes_moan_rkn6a_stumpff_12(w10, &c1_1, &c2_1);
    const double w17 = g11 + w12 * c1_1 + w16 * c2_1;
    const double w21 = w18 * (w2 - g11 * w19) - w12 * w20 * c1_1 - w16 * w20 * c2_1;
    const double w25 = w18 * (w6 - g01 * w22) - w14 * w23 * c1_1 - w23 * w24 * c2_1;
    const double w30 = g01 + w14 * c1_1 + w24 * c2_1;
    const double w31 = g21 + w15 * c1_1 + (w4 * w12 - w7 * w14) * c2_1;
    const double w272 = g22 + w269 * c1_1 + (w4 * w270 - w7 * w271) * c2_1;
    const double w273 = g12 + w270 * c1_1 + (w8 * w271 - w4 * w269) * c2_1;
    const double w274 = g02 + w271 * c1_1 + (w7 * w269 - w8 * w270) * c2_1;
    const double w28 = w21 * w21 + w25 * w25 + w27;
    const double w32 = w26 * w30 - w21 * w31;
    const double w34 = w25 * w31 - w17 * w26;
    const double w35 = w17 * w21 - w25 * w30;
    const double w36 = w26 * w34 - w21 * w35;
    const double w39 = w2 - w17 * w19;
    const double w43 = w6 - w22 * w30;
    const double w46 = w25 * w35 - w26 * w32;
    const double w275 = w21 * w273 - w25 * w274;
    const double w276 = w26 * w274 - w21 * w272;
    const double w277 = w25 * w272 - w26 * w273;
    double c1_2, c2_2;
    fast_heavy_top_splitting_blanes_moan_rkn6a_stumpff_12(w28, &c1_2, &c2_2);
    const double w37 = w17 + w32 * c1_2 + w36 * c2_2;
    const double w42 = w38 * (w39 - w17 * w40) - w32 * w41 * c1_2 - w36 * w41 * c2_2;
    const double w47 = w38 * (w43 - w30 * w44) - w34 * w45 * c1_2 - w45 * w46 * c2_2;
    const double w52 = w30 + w34 * c1_2 + w46 * c2_2;
    const double w53 = w31 + w35 * c1_2 + (w21 * w32 - w25 * w34) * c2_2;
    const double w278 = w272 + w275 * c1_2 + (w21 * w276 - w25 * w277) * c2_2;
    const double w279 = w273 + w276 * c1_2 + (w26 * w277 - w21 * w275) * c2_2;
    const double w280 = w274 + w277 * c1_2 + (w25 * w275 - w26 * w276) * c2_2;
    const double w50 = w42 * w42 + w47 * w47 + w49;
    const double w54 = w48 * w52 - w42 * w53;
    const double w56 = w47 * w53 - w37 * w48;
    const double w57 = w37 * w42 - w47 * w52;
    const double w58 = w48 * w56 - w42 * w57;
    const double w61 = w39 - w37 * w40;
    const double w65 = w43 - w44 * w52;
    const double w68 = w47 * w57 - w48 * w54;
    const double w281 = w42 * w279 - w47 * w280;
    const double w282 = w48 * w280 - w42 * w278;
    const double w283 = w47 * w278 - w48 * w279;
    double c1_3, c2_3;
    fast_heavy_top_splitting_blanes_moan_rkn6a_stumpff_12(w50, &c1_3, &c2_3);
    const double w59 = w37 + w54 * c1_3 + w58 * c2_3;
    const double w64 = w60 * (w61 - w37 * w62) - w54 * w63 * c1_3 - w58 * w63 * c2_3;
    const double w69 = w60 * (w65 - w52 * w66) - w56 * w67 * c1_3 - w67 * w68 * c2_3;
    const double w74 = w52 + w56 * c1_3 + w68 * c2_3;
    const double w75 = w53 + w57 * c1_3 + (w42 * w54 - w47 * w56) * c2_3;
    const double w284 = w278 + w281 * c1_3 + (w42 * w282 - w47 * w283) * c2_3;
    const double w285 = w279 + w282 * c1_3 + (w48 * w283 - w42 * w281) * c2_3;
    const double w286 = w280 + w283 * c1_3 + (w47 * w281 - w48 * w282) * c2_3;
    const double w72 = w64 * w64 + w69 * w69 + w71;
    const double w76 = w70 * w74 - w64 * w75;
    const double w78 = w69 * w75 - w59 * w70;
    const double w79 = w59 * w64 - w69 * w74;
    const double w80 = w70 * w78 - w64 * w79;
    const double w83 = w61 - w59 * w62;
    const double w87 = w65 - w66 * w74;
    const double w90 = w69 * w79 - w70 * w76;
    const double w287 = w64 * w285 - w69 * w286;
    const double w288 = w70 * w286 - w64 * w284;
    const double w289 = w69 * w284 - w70 * w285;
    double c1_4, c2_4;
    fast_heavy_top_splitting_blanes_moan_rkn6a_stumpff_12(w72, &c1_4, &c2_4);
    const double w81 = w59 + w76 * c1_4 + w80 * c2_4;
    const double w86 = w82 * (w83 - w59 * w84) - w76 * w85 * c1_4 - w80 * w85 * c2_4;
    const double w91 = w82 * (w87 - w74 * w88) - w78 * w89 * c1_4 - w89 * w90 * c2_4;
    const double w96 = w74 + w78 * c1_4 + w90 * c2_4;
    const double w97 = w75 + w79 * c1_4 + (w64 * w76 - w69 * w78) * c2_4;
    const double w290 = w284 + w287 * c1_4 + (w64 * w288 - w69 * w289) * c2_4;
    const double w291 = w285 + w288 * c1_4 + (w70 * w289 - w64 * w287) * c2_4;
    const double w292 = w286 + w289 * c1_4 + (w69 * w287 - w70 * w288) * c2_4;
    const double w94 = w86 * w86 + w91 * w91 + w93;
    const double w98 = w92 * w96 - w86 * w97;
    const double w100 = w91 * w97 - w81 * w92;
    const double w101 = w81 * w86 - w91 * w96;
    const double w102 = w92 * w100 - w86 * w101;
    const double w105 = w83 - w81 * w84;
    const double w109 = w87 - w88 * w96;
    const double w112 = w91 * w101 - w92 * w98;
    const double w293 = w86 * w291 - w91 * w292;
    const double w294 = w92 * w292 - w86 * w290;
    const double w295 = w91 * w290 - w92 * w291;
    double c1_5, c2_5;
    fast_heavy_top_splitting_blanes_moan_rkn6a_stumpff_12(w94, &c1_5, &c2_5);
    const double w103 = w81 + w98 * c1_5 + w102 * c2_5;
    const double w108 = w104 * (w105 - w81 * w106) - w98 * w107 * c1_5 - w102 * w107 * c2_5;
    const double w113 = w104 * (w109 - w96 * w110) - w100 * w111 * c1_5 - w111 * w112 * c2_5;
    const double w118 = w96 + w100 * c1_5 + w112 * c2_5;
    const double w119 = w97 + w101 * c1_5 + (w86 * w98 - w91 * w100) * c2_5;
    const double w296 = w290 + w293 * c1_5 + (w86 * w294 - w91 * w295) * c2_5;
    const double w297 = w291 + w294 * c1_5 + (w92 * w295 - w86 * w293) * c2_5;
    const double w298 = w292 + w295 * c1_5 + (w91 * w293 - w92 * w294) * c2_5;
    const double w116 = w108 * w108 + w113 * w113 + w115;
    const double w120 = w114 * w118 - w108 * w119;
    const double w122 = w113 * w119 - w103 * w114;
    const double w123 = w103 * w108 - w113 * w118;
    const double w124 = w114 * w122 - w108 * w123;
    const double w127 = w105 - w103 * w106;
    const double w131 = w109 - w110 * w118;
    const double w134 = w113 * w123 - w114 * w120;
    const double w299 = w108 * w297 - w113 * w298;
    const double w300 = w114 * w298 - w108 * w296;
    const double w301 = w113 * w296 - w114 * w297;
    double c1_6, c2_6;
    fast_heavy_top_splitting_blanes_moan_rkn6a_stumpff_12(w116, &c1_6, &c2_6);
    const double w125 = w103 + w120 * c1_6 + w124 * c2_6;
    const double w130 = w126 * (w127 - w103 * w128) - w120 * w129 * c1_6 - w124 * w129 * c2_6;
    const double w135 = w126 * (w131 - w118 * w132) - w122 * w133 * c1_6 - w133 * w134 * c2_6;
    const double w139 = w118 + w122 * c1_6 + w134 * c2_6;
    const double w140 = w119 + w123 * c1_6 + (w108 * w120 - w113 * w122) * c2_6;
    const double w147 = w125 * w128;
    const double w151 = w132 * w139;
    const double w302 = w296 + w299 * c1_6 + (w108 * w300 - w113 * w301) * c2_6;
    const double w303 = w297 + w300 * c1_6 + (w114 * w301 - w108 * w299) * c2_6;
    const double w304 = w298 + w301 * c1_6 + (w113 * w299 - w114 * w300) * c2_6;
    const double w137 = w130 * w130 + w135 * w135 + w136 * w136;
    const double w141 = w136 * w139 - w130 * w140;
    const double w143 = w135 * w140 - w125 * w136;
    const double w144 = w125 * w130 - w135 * w139;
    const double w145 = w136 * w143 - w130 * w144;
    const double w148 = w127 - w147;
    const double w152 = w131 - w151;
    const double w154 = w135 * w144 - w136 * w141;
    const double w305 = w130 * w303 - w135 * w304;
    const double w306 = w136 * w304 - w130 * w302;
    const double w307 = w135 * w302 - w136 * w303;
    double c1_7, c2_7;
    fast_heavy_top_splitting_blanes_moan_rkn6a_stumpff_12(w137, &c1_7, &c2_7);
    const double w146 = w125 + w141 * c1_7 + w145 * c2_7;
    const double w150 = w104 * (w148 - w147) - w141 * w149 * c1_7 - w145 * w149 * c2_7;
    const double w155 = w104 * (w152 - w151) - w143 * w153 * c1_7 - w153 * w154 * c2_7;
    const double w158 = w139 + w143 * c1_7 + w154 * c2_7;
    const double w159 = w140 + w144 * c1_7 + (w130 * w141 - w135 * w143) * c2_7;
    const double w308 = w302 + w305 * c1_7 + (w130 * w306 - w135 * w307) * c2_7;
    const double w309 = w303 + w306 * c1_7 + (w136 * w307 - w130 * w305) * c2_7;
    const double w310 = w304 + w307 * c1_7 + (w135 * w305 - w136 * w306) * c2_7;
    const double w156 = w150 * w150 + w155 * w155 + w115;
    const double w160 = w114 * w158 - w150 * w159;
    const double w162 = w155 * w159 - w114 * w146;
    const double w163 = w146 * w150 - w155 * w158;
    const double w164 = w114 * w162 - w150 * w163;
    const double w166 = w148 - w128 * w146;
    const double w169 = w152 - w132 * w158;
    const double w171 = w155 * w163 - w114 * w160;
    const double w311 = w150 * w309 - w155 * w310;
    const double w312 = w114 * w310 - w150 * w308;
    const double w313 = w155 * w308 - w114 * w309;
    double c1_8, c2_8;
    fast_heavy_top_splitting_blanes_moan_rkn6a_stumpff_12(w156, &c1_8, &c2_8);
    const double w165 = w146 + w160 * c1_8 + w164 * c2_8;
    const double w168 = w82 * (w166 - w106 * w146) - w160 * w167 * c1_8 - w164 * w167 * c2_8;
    const double w172 = w82 * (w169 - w110 * w158) - w162 * w170 * c1_8 - w170 * w171 * c2_8;
    const double w175 = w158 + w162 * c1_8 + w171 * c2_8;
    const double w176 = w159 + w163 * c1_8 + (w150 * w160 - w155 * w162) * c2_8;
    const double w314 = w308 + w311 * c1_8 + (w150 * w312 - w155 * w313) * c2_8;
    const double w315 = w309 + w312 * c1_8 + (w114 * w313 - w150 * w311) * c2_8;
    const double w316 = w310 + w313 * c1_8 + (w155 * w311 - w114 * w312) * c2_8;
    const double w173 = w168 * w168 + w172 * w172 + w93;
    const double w177 = w92 * w175 - w168 * w176;
    const double w179 = w172 * w176 - w92 * w165;
    const double w180 = w165 * w168 - w172 * w175;
    const double w181 = w92 * w179 - w168 * w180;
    const double w183 = w166 - w106 * w165;
    const double w186 = w169 - w110 * w175;
    const double w188 = w172 * w180 - w92 * w177;
    const double w317 = w168 * w315 - w172 * w316;
    const double w318 = w92 * w316 - w168 * w314;
    const double w319 = w172 * w314 - w92 * w315;
    double c1_9, c2_9;
    fast_heavy_top_splitting_blanes_moan_rkn6a_stumpff_12(w173, &c1_9, &c2_9);
    const double w182 = w165 + w177 * c1_9 + w181 * c2_9;
    const double w185 = w60 * (w183 - w84 * w165) - w177 * w184 * c1_9 - w181 * w184 * c2_9;
    const double w189 = w60 * (w186 - w88 * w175) - w179 * w187 * c1_9 - w187 * w188 * c2_9;
    const double w192 = w175 + w179 * c1_9 + w188 * c2_9;
    const double w193 = w176 + w180 * c1_9 + (w168 * w177 - w172 * w179) * c2_9;
    const double w320 = w314 + w317 * c1_9 + (w168 * w318 - w172 * w319) * c2_9;
    const double w321 = w315 + w318 * c1_9 + (w92 * w319 - w168 * w317) * c2_9;
    const double w322 = w316 + w319 * c1_9 + (w172 * w317 - w92 * w318) * c2_9;
    const double w190 = w185 * w185 + w189 * w189 + w71;
    const double w194 = w70 * w192 - w185 * w193;
    const double w196 = w189 * w193 - w70 * w182;
    const double w197 = w182 * w185 - w189 * w192;
    const double w198 = w70 * w196 - w185 * w197;
    const double w200 = w183 - w84 * w182;
    const double w203 = w186 - w88 * w192;
    const double w205 = w189 * w197 - w70 * w194;
    const double w323 = w185 * w321 - w189 * w322;
    const double w324 = w70 * w322 - w185 * w320;
    const double w325 = w189 * w320 - w70 * w321;
    double c1_10, c2_10;
    fast_heavy_top_splitting_blanes_moan_rkn6a_stumpff_12(w190, &c1_10, &c2_10);
    const double w199 = w182 + w194 * c1_10 + w198 * c2_10;
    const double w202 = w38 * (w200 - w62 * w182) - w194 * w201 * c1_10 - w198 * w201 * c2_10;
    const double w206 = w38 * (w203 - w66 * w192) - w196 * w204 * c1_10 - w204 * w205 * c2_10;
    const double w209 = w192 + w196 * c1_10 + w205 * c2_10;
    const double w210 = w193 + w197 * c1_10 + (w185 * w194 - w189 * w196) * c2_10;
    const double w326 = w320 + w323 * c1_10 + (w185 * w324 - w189 * w325) * c2_10;
    const double w327 = w321 + w324 * c1_10 + (w70 * w325 - w185 * w323) * c2_10;
    const double w328 = w322 + w325 * c1_10 + (w189 * w323 - w70 * w324) * c2_10;
    const double w207 = w202 * w202 + w206 * w206 + w49;
    const double w211 = w48 * w209 - w202 * w210;
    const double w213 = w206 * w210 - w48 * w199;
    const double w214 = w199 * w202 - w206 * w209;
    const double w215 = w48 * w213 - w202 * w214;
    const double w217 = w200 - w62 * w199;
    const double w220 = w203 - w66 * w209;
    const double w222 = w206 * w214 - w48 * w211;
    const double w329 = w202 * w327 - w206 * w328;
    const double w330 = w48 * w328 - w202 * w326;
    const double w331 = w206 * w326 - w48 * w327;
    double c1_11, c2_11;
    fast_heavy_top_splitting_blanes_moan_rkn6a_stumpff_12(w207, &c1_11, &c2_11);
    const double w216 = w199 + w211 * c1_11 + w215 * c2_11;
    const double w219 = w18 * (w217 - w40 * w199) - w211 * w218 * c1_11 - w215 * w218 * c2_11;
    const double w223 = w18 * (w220 - w44 * w209) - w213 * w221 * c1_11 - w221 * w222 * c2_11;
    const double w226 = w209 + w213 * c1_11 + w222 * c2_11;
    const double w227 = w210 + w214 * c1_11 + (w202 * w211 - w206 * w213) * c2_11;
    const double w332 = w326 + w329 * c1_11 + (w202 * w330 - w206 * w331) * c2_11;
    const double w333 = w327 + w330 * c1_11 + (w48 * w331 - w202 * w329) * c2_11;
    const double w334 = w328 + w331 * c1_11 + (w206 * w329 - w48 * w330) * c2_11;
    const double w224 = w219 * w219 + w223 * w223 + w27;
    const double w228 = w26 * w226 - w219 * w227;
    const double w230 = w223 * w227 - w26 * w216;
    const double w231 = w216 * w219 - w223 * w226;
    const double w232 = w26 * w230 - w219 * w231;
    const double w234 = w217 - w40 * w216;
    const double w237 = w220 - w44 * w226;
    const double w239 = w223 * w231 - w26 * w228;
    const double w335 = w219 * w333 - w223 * w334;
    const double w336 = w26 * w334 - w219 * w332;
    const double w337 = w223 * w332 - w26 * w333;
    double c1_12, c2_12;
    fast_heavy_top_splitting_blanes_moan_rkn6a_stumpff_12(w224, &c1_12, &c2_12);
    const double w233 = w216 + w228 * c1_12 + w232 * c2_12;
    const double w236 = w3 * (w234 - w19 * w216) - w228 * w235 * c1_12 - w232 * w235 * c2_12;
    const double w240 = w3 * (w237 - w22 * w226) - w230 * w238 * c1_12 - w238 * w239 * c2_12;
    const double w243 = w226 + w230 * c1_12 + w239 * c2_12;
    const double w244 = w227 + w231 * c1_12 + (w219 * w228 - w223 * w230) * c2_12;
    const double w338 = w332 + w335 * c1_12 + (w219 * w336 - w223 * w337) * c2_12;
    const double w339 = w333 + w336 * c1_12 + (w26 * w337 - w219 * w335) * c2_12;
    const double w340 = w334 + w337 * c1_12 + (w223 * w335 - w26 * w336) * c2_12;
    const double w241 = w236 * w236 + w240 * w240 + w9;
    const double w245 = w8 * w243 - w236 * w244;
    const double w247 = w240 * w244 - w8 * w233;
    const double w248 = w233 * w236 - w240 * w243;
    const double w249 = w8 * w247 - w236 * w248;
    const double w252 = w234 - w19 * w233;
    const double w255 = w237 - w22 * w243;
    const double w257 = w240 * w248 - w8 * w245;
    const double w341 = w236 * w339 - w240 * w340;
    const double w342 = w8 * w340 - w236 * w338;
    const double w343 = w240 * w338 - w8 * w339;
    double c1_13, c2_13;
    fast_heavy_top_splitting_blanes_moan_rkn6a_stumpff_12(w241, &c1_13, &c2_13);
    const double w250 = w233 + w245 * c1_13 + w249 * c2_13;
    const double w254 = w251 * (w252 - w1 * w233) - w245 * w253 * c1_13 - w249 * w253 * c2_13;
    const double w258 = w251 * (w255 - w5 * w243) - w247 * w256 * c1_13 - w256 * w257 * c2_13;
    const double w262 = w243 + w247 * c1_13 + w257 * c2_13;
    const double w263 = w244 + w248 * c1_13 + (w236 * w245 - w240 * w247) * c2_13;
    const double w344 = w338 + w341 * c1_13 + (w236 * w342 - w240 * w343) * c2_13;
    const double w345 = w339 + w342 * c1_13 + (w8 * w343 - w236 * w341) * c2_13;
    const double w346 = w340 + w343 * c1_13 + (w240 * w341 - w8 * w342) * c2_13;
    const double w260 = w254 * w254 + w258 * w258 + w259 * w259;
    const double w264 = w259 * w262 - w254 * w263;
    const double w266 = w258 * w263 - w250 * w259;
    const double w267 = w250 * w254 - w258 * w262;
    const double w347 = w254 * w345 - w258 * w346;
    const double w348 = w259 * w346 - w254 * w344;
    const double w349 = w258 * w344 - w259 * w345;
    double c1_14, c2_14;
    fast_heavy_top_splitting_blanes_moan_rkn6a_stumpff_12(w260, &c1_14, &c2_14);
    const double w268 = w250 + w264 * c1_14 + (w259 * w266 - w254 * w267) * c2_14;
    const double w350 = w344 + w347 * c1_14 + (w254 * w348 - w258 * w349) * c2_14;
    const double w351 = w263 + w267 * c1_14 + (w254 * w264 - w258 * w266) * c2_14;
    const double w352 = w345 + w348 * c1_14 + (w259 * w349 - w254 * w347) * c2_14;
    const double w353 = w262 + w266 * c1_14 + (w258 * w267 - w259 * w264) * c2_14;
    const double w354 = w346 + w349 * c1_14 + (w258 * w347 - w259 * w348) * c2_14;
    const double new_g00 = w268 * w350 - w351 * w352;
    const double new_g10 = w351 * w354 - w350 * w353;
    const double new_g20 = w352 * w353 - w268 * w354;
    const double new_mu0 = w252 - w1 * w250;
    const double new_mu1 = w255 - w5 * w262;
    const double new_mu2 = mu2;
    state[0] = new_g00;
    state[1] = w353;
    state[2] = w354;
    state[3] = new_g10;
    state[4] = w268;
    state[5] = w352;
    state[6] = new_g20;
    state[7] = w351;
    state[8] = w350;
    state[9] = new_mu0;
    state[10] = new_mu1;
    state[11] = new_mu2;
}

/* Apply the first flow of a step. */
static inline void fast_heavy_top_splitting_blanes_moan_rkn6a_begin(double state[static 12],
    double h)
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
    const double w1 = 0.0024851245844093018 * h;
    const double w2 = mu0 * w1;
    const double w3 = mu1 * w1;
    const double w4 = mu2 * w1;
    const double w5 = w2 * w2 + w3 * w3 + w4 * w4;
    const double w7 = g01 * w4 - g21 * w2;
    const double w9 = g21 * w3 - g11 * w4;
    const double w10 = g11 * w2 - g01 * w3;
    const double w11 = g12 * w2 - g02 * w3;
    const double w12 = g02 * w4 - g22 * w2;
    const double w13 = g22 * w3 - g12 * w4;
    double c1_1, c2_1;
    fast_heavy_top_splitting_blanes_moan_rkn6a_stumpff_12(w5, &c1_1, &c2_1);
    const double q1_4 = g11 + w7 * c1_1 + (w4 * w9 - w2 * w10) * c2_1;
    const double q1_8 = g22 + w11 * c1_1 + (w2 * w12 - w3 * w13) * c2_1;
    const double q1_7 = g21 + w10 * c1_1 + (w2 * w7 - w3 * w9) * c2_1;
    const double q1_5 = g12 + w12 * c1_1 + (w4 * w13 - w2 * w11) * c2_1;
    const double q1_1 = g01 + w9 * c1_1 + (w3 * w10 - w4 * w7) * c2_1;
    const double q1_2 = g02 + w13 * c1_1 + (w3 * w11 - w4 * w12) * c2_1;
    const double new_g00 = q1_4 * q1_8 - q1_7 * q1_5;
    const double new_g10 = q1_7 * q1_2 - q1_8 * q1_1;
    const double new_g20 = q1_5 * q1_1 - q1_4 * q1_2;
    const double new_mu0 = mu0;
    const double new_mu1 = mu1;
    const double new_mu2 = mu2;
    state[0] = new_g00;
    state[1] = q1_1;
    state[2] = q1_2;
    state[3] = new_g10;
    state[4] = q1_4;
    state[5] = q1_5;
    state[6] = new_g20;
    state[7] = q1_7;
    state[8] = q1_8;
    state[9] = new_mu0;
    state[10] = new_mu1;
    state[11] = new_mu2;
}

/* Apply the flows that commute with all other flows. */
static inline void fast_heavy_top_splitting_blanes_moan_rkn6a_finish(double state[static 12],
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
    fast_heavy_top_splitting_blanes_moan_rkn6a_stumpff_12(w2, &c1_1, &c2_1);
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
static int fast_heavy_top_splitting_blanes_moan_rkn6a_complete_step(double state[static 12],
    double h)
{
    if (!isfinite(h)) {
        return FAST_HEAVY_TOP_SPLITTING_BLANES_MOAN_RKN6A_BAD_STEP;
    }
    if (!fast_heavy_top_splitting_blanes_moan_rkn6a_all_finite(state, 12)) {
        return FAST_HEAVY_TOP_SPLITTING_BLANES_MOAN_RKN6A_NOT_FINITE;
    }
    double next[12];
    memcpy(next, state, sizeof next);
    const double lead = 0.03785931984061045 * h;
    fast_heavy_top_splitting_blanes_moan_rkn6a_begin(next, h);
    fast_heavy_top_splitting_blanes_moan_rkn6a_advance(next, h, lead);
    fast_heavy_top_splitting_blanes_moan_rkn6a_finish(next, h);
    if (!fast_heavy_top_splitting_blanes_moan_rkn6a_all_finite(next, 12)) {
        return FAST_HEAVY_TOP_SPLITTING_BLANES_MOAN_RKN6A_NOT_FINITE;
    }
    memcpy(state, next, sizeof next);
    return FAST_HEAVY_TOP_SPLITTING_BLANES_MOAN_RKN6A_OK;
}

/*
 * Find the cause of a failed step. If a step of size zero succeeds, the cause is the step size.
 * Otherwise the cause is the state.
 */
static int fast_heavy_top_splitting_blanes_moan_rkn6a_cause(const double state[static 12],
    double h)
{
    double same[12];
    memcpy(same, state, sizeof same);
    const int status = fast_heavy_top_splitting_blanes_moan_rkn6a_complete_step(same, 0.0 * h);
    return status == FAST_HEAVY_TOP_SPLITTING_BLANES_MOAN_RKN6A_OK
        ? FAST_HEAVY_TOP_SPLITTING_BLANES_MOAN_RKN6A_TOO_FAR
        : FAST_HEAVY_TOP_SPLITTING_BLANES_MOAN_RKN6A_NOT_FINITE;
}

int fast_heavy_top_splitting_blanes_moan_rkn6a_step(double state[static 12], double h)
{
    int status = fast_heavy_top_splitting_blanes_moan_rkn6a_complete_step(state, h);
    if (status == FAST_HEAVY_TOP_SPLITTING_BLANES_MOAN_RKN6A_NOT_FINITE) {
        status = fast_heavy_top_splitting_blanes_moan_rkn6a_cause(state, h);
    }
    return status;
}

int fast_heavy_top_splitting_blanes_moan_rkn6a_run(double state[static 12], double h,
    size_t steps, double *trajectory, size_t stride, size_t *completed)
{
    int status = FAST_HEAVY_TOP_SPLITTING_BLANES_MOAN_RKN6A_OK;
    size_t asked = steps;
    if (steps > 0 && !isfinite(h)) {
        status = FAST_HEAVY_TOP_SPLITTING_BLANES_MOAN_RKN6A_BAD_STEP;
        asked = 0;
    }
    if (status == FAST_HEAVY_TOP_SPLITTING_BLANES_MOAN_RKN6A_OK && steps > 0
        && !fast_heavy_top_splitting_blanes_moan_rkn6a_all_finite(state, 12)) {
        status = FAST_HEAVY_TOP_SPLITTING_BLANES_MOAN_RKN6A_NOT_FINITE;
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
            const double lead = (stop ? 0.03785931984061045 : 0.0757186396812209) * h;
            if (!begun) {
                fast_heavy_top_splitting_blanes_moan_rkn6a_begin(next, h);
            }
            begun = !stop;
            fast_heavy_top_splitting_blanes_moan_rkn6a_advance(next, h, lead);
            if (stop) {
                fast_heavy_top_splitting_blanes_moan_rkn6a_finish(next, (double)late * h);
                good = fast_heavy_top_splitting_blanes_moan_rkn6a_all_finite(next, 12);
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
                status = FAST_HEAVY_TOP_SPLITTING_BLANES_MOAN_RKN6A_NOT_FINITE;
                asked = step;
            }
            careful = 1;
        }
    } while (again);
    memcpy(state, complete, sizeof complete);
    if (status == FAST_HEAVY_TOP_SPLITTING_BLANES_MOAN_RKN6A_NOT_FINITE) {
        status = fast_heavy_top_splitting_blanes_moan_rkn6a_cause(state, h);
    }
    if (completed != NULL) {
        *completed = step;
    }
    return status;
}
