/*
 * Dipole on a stick, T*SO(3) (thesis section 3.6): one step by vcg:triple_jump
 *
 * method:     family vcg, tableau triple_jump
 * source:     Yoshida 1990; Hairer, Lubich and Wanner, (II.4.4); Table 3.2b of Bogfjellmo and
 *             Marthinsen
 * order:      4, certificate: exact (every order condition up to it is zero in exact arithmetic)
 * scene:      Dipole on a stick, T*SO(3) (thesis section 3.6), group SO(3)
 * solved by:  the equations of xi1, n1: Newton's method with the matrix to first order in h, 3
 *             unknowns (1.9 sweeps of 304 operations and 1.00 matrices of 105 a step; fixed point:
 *             3.2 sweeps of 289 operations; Newton's method: 2.5 sweeps of 304 operations and 0.05
 *             matrices of 1048)
 * solved by:  the equations of xi2, n2: Newton's method with the matrix to first order in h, 3
 *             unknowns (2.0 sweeps of 394 operations and 1.00 matrices of 111 a step; fixed point:
 *             3.4 sweeps of 379 operations; Newton's method: 2.5 sweeps of 394 operations and 0.05
 *             matrices of 1499)
 * solved by:  the equations of xi3, n3: Newton's method with the matrix to first order in h, 3
 *             unknowns (1.9 sweeps of 400 operations and 1.00 matrices of 109 a step; fixed point:
 *             3.2 sweeps of 385 operations; Newton's method: 2.4 sweeps of 400 operations and 0.05
 *             matrices of 1499)
 * state:      [0..8] q: element of SO(3), row by row
 *             [9..11] mu: right-trivialised momentum in the dual algebra of SO(3)
 * left out:   7 Adtinv, 3 exp, 7 mul (zeros)
 *             3 Adtinv, 3 dexpt, 3 exp, 6 identity, 6 lin, 1 mul, 2 zero (sharing)
 *             1 Adtinv, 3 dexpt, 1 identity, 1 zero (dead code)
 *             3 Adtinv, 6 dexpt (factors)
 *             2 lin (cancellation)
 *             1 lin (sharing)
 *             4 hamilton (body frame)
 *             1 Adinv (opposites)
 *             3 Adt (opposites)
 *             6 Adtinv, 1 force (dead code)
 *             6 dexpt (functions)
 *             1 Adinv (opposites)
 *             2 Adinv, 3 legendre (sharing)
 *             1 lin (scalars)
 *             1 lin (sharing)
 *             parameters, folded: beta = 1, depth = 3/2
 *             the time: the scene does not depend on it
 * operations: 120 add, 170 mul, 3 stumpff_12 a step
 *             2 mul a start, in steps that follow no other
 *             29 add, 72 mul, 1 div a matrix of the equations of xi1, n1
 *             84 add, 137 mul, 2 div, 2 sqrt, 1 stumpff_12, 2 stumpff_23 a sweep of the equations
 *             of xi1, n1
 *             32 add, 75 mul, 1 div a matrix of the equations of xi2, n2
 *             120 add, 191 mul, 2 div, 2 sqrt, 1 stumpff_12, 2 stumpff_23 a sweep of the equations
 *             of xi2, n2
 *             32 add, 73 mul, 1 div a matrix of the equations of xi3, n3
 *             126 add, 191 mul, 2 div, 2 sqrt, 1 stumpff_12, 2 stumpff_23 a sweep of the equations
 *             of xi3, n3
 * stack:      at most 6848 bytes, without what the mathematical library takes
 * made by:    orderconds emit dipole --method vcg:triple_jump --target c -o .
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

static inline double greater(double a, double b)
{
    return a > b ? a : b;
}

static void count_sweeps(dipole_vcg_triple_jump_statistics *statistics, size_t block, size_t sweeps, int failed)
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
    double past[9][9];
    double rate_1;
    double rate_2;
    double rate_3;
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
    const double m_0 = g00 * mu0 + g10 * mu1 + g20 * mu2;
    const double m_1 = g01 * mu0 + g11 * mu1 + g21 * mu2;
    const double m_2 = g02 * mu0 + g12 * mu1 + g22 * mu2;
    double xi1_0, xi1_1, xi1_2, xi2_0, xi2_1, xi2_2, xi3_0, xi3_1, xi3_2;
    if (memory->known > 0) {
        xi1_0 = extrapolated(memory, 0);
        xi1_1 = extrapolated(memory, 1);
        xi1_2 = extrapolated(memory, 2);
        xi2_0 = extrapolated(memory, 3);
        xi2_1 = extrapolated(memory, 4);
        xi2_2 = extrapolated(memory, 5);
        xi3_0 = extrapolated(memory, 6);
        xi3_1 = extrapolated(memory, 7);
        xi3_2 = extrapolated(memory, 8);
    } else {
        const double Wxi0_0 = 0.9900990099009901 * m_0;
        const double Wxi0_2 = 100.0 * m_2;
        xi1_0 = Wxi0_0;
        xi1_1 = m_1;
        xi1_2 = Wxi0_2;
        xi2_0 = Wxi0_0;
        xi2_1 = m_1;
        xi2_2 = Wxi0_2;
        xi3_0 = Wxi0_0;
        xi3_1 = m_1;
        xi3_2 = Wxi0_2;
    }
    const double w46 = 0.6756035959798288 * h;
    const double w69 = 1.3512071919596575 * h;
    const double w70 = -1.3512071919596575 * h;
    const double w79 = -0.6756035959798288 * h;
    /* the equations of xi1, n1: Newton's method with the matrix to first order in h in xi1_0, xi1_1, xi1_2 */
    double Nr1_0, s_mu_0, Nr1_2, s_mu_2, Nr1_1, s_mu_1;
    double previous_1 = 0.0;
    double rate_1 = memory->known > 0 ? memory->rate_1 : 1.0;
    const double w1 = 100.0 * m_0;
    const double Wxi0_0_ = 0.9900990099009901 * m_0;
    const double w2 = h * Wxi0_0_;
    const double w3 = h * w1 - w2;
    const double w4 = -50.0 * h;
    const double w5 = m_0 * w4;
    const double w6 = 1.3512071919596575 * w5;
    const double w7 = 0.01 * xi1_0;
    const double w8 = 67.56035959798288 * h;
    const double w9 = 0.6756035959798288 * w3 + w6 + w7 * w8;
    const double w10 = h * m_0;
    const double w11 = w2 - w10;
    const double w12 = -0.5 * h;
    const double w13 = m_0 * w12;
    const double w14 = -1.3512071919596575 * w13;
    const double w15 = 0.6756035959798288 * h;
    const double w16 = -100.0 * xi1_0;
    const double w17 = 0.6756035959798288 * w11 + w14 + 0.01 * (w15 * w16);
    const double w18 = 1.0 - w9 * w17;
    const double Wxi0_2_ = 100.0 * m_2;
    const double w19 = h * Wxi0_2_;
    const double w20 = 0.9900990099009901 * m_2;
    const double w21 = w19 - h * w20;
    const double w22 = -0.49504950495049505 * h;
    const double w23 = m_2 * w22;
    const double w24 = -1.3512071919596575 * w23;
    const double w25 = 0.668914451465177 * h;
    const double w26 = 0.6756035959798288 * w21 + w24 + 0.99 * xi1_2 * w25;
    const double w27 = h * m_1;
    const double w28 = 100.0 * m_1;
    const double w29 = w27 - h * w28;
    const double w30 = m_1 * w4;
    const double w31 = -1.3512071919596575 * w30;
    const double w32 = 0.6756035959798288 * w29 + w31 + 0.01 * xi1_1 * w8;
    const double xE1_1_2 = xi1_2 * w15;
    const double w33 = h * m_2 - w19;
    const double w34 = m_2 * w12;
    const double w35 = 1.3512071919596575 * w34;
    const double w36 = xE1_1_2 - (0.6756035959798288 * w33 + w35);
    const double w37 = w17 * w32 - w36;
    const double w38 = 0.9900990099009901 * m_1;
    const double w39 = h * w38 - w27;
    const double w40 = m_1 * w22;
    const double w41 = 1.3512071919596575 * w40;
    const double w42 = 99.0 * xi1_1;
    const double w43 = 0.6756035959798288 * w39 + w41 + 0.01 * (w25 * w42);
    const double w44 = w32 - w9 * w36;
    const double w45 = 1.0 / (w18 - w26 * w37 - w43 * w44);
    const double inverse_1_0 = w18 * w45;
    const double inverse_1_1 = w45 * (w26 + w9 * w43);
    const double inverse_1_2 = w45 * (w43 + w17 * w26);
    const double inverse_1_3 = w37 * w45;
    const double inverse_1_4 = w45 * (1.0 - w32 * w43);
    const double inverse_1_5 = w45 * (w17 - w36 * w43);
    const double inverse_1_6 = w44 * w45;
    const double inverse_1_7 = w45 * (w9 + w26 * w32);
    const double inverse_1_8 = w45 * (1.0 + w26 * w36);
    for (size_t sweep = 1;; sweep++) {
        const double xE1_1_1 = xi1_1 * w46;
        const double xE1_1_0 = xi1_0 * w46;
        const double xE1_1_2_ = xi1_2 * w46;
        const double w47 = xE1_1_0 * xE1_1_0 + xE1_1_1 * xE1_1_1 + xE1_1_2_ * xE1_1_2_;
        double c1_1, c2_1;
        stumpff_12(w47, &c1_1, &c2_1);
        const double w49 = xE1_1_1 * c2_1;
        const double w50 = xE1_1_1 * w49;
        const double w51 = xE1_1_2_ * c2_1 * xE1_1_2_;
        const double gE1_1_0 = 1.0 - (w50 + w51);
        const double p_2 = 0.01 * xi1_2;
        const double w52 = 99.0 * xi1_1;
        const double w53 = xE1_1_0 * c2_1;
        const double w54 = xE1_1_1 * w53;
        const double w56 = xE1_1_2_ * c1_1;
        const double gE1_1_1 = w54 - w56;
        const double w57 = xE1_1_0 * w53;
        const double gE1_1_4 = 1.0 - (w51 + w57);
        const double w58 = xE1_1_0 * c1_1;
        const double w59 = xE1_1_2_ * w49;
        const double gE1_1_7 = w58 + w59;
        const double Q1_7 = g20 * gE1_1_1 + g21 * gE1_1_4 + g22 * gE1_1_7;
        const double w60 = xE1_1_1 * c1_1;
        const double w61 = xE1_1_2_ * w53;
        const double gE1_1_2 = w60 + w61;
        const double gE1_1_5 = w59 - w58;
        const double gE1_1_8 = 1.0 - (w50 + w57);
        const double Q1_8 = g20 * gE1_1_2 + g21 * gE1_1_5 + g22 * gE1_1_8;
        const double w62 = 1.5 - 2.0 * Q1_8;
        const double w63 = 1.0 / sqrt(1.01 + 1.5 * (w62 - 0.2 * Q1_7));
        const double w64 = w63 * w63 * (0.5 * w63);
        const double w65 = 1.0 / sqrt(1.01 + 1.5 * (w62 + 0.2 * Q1_7));
        const double w66 = w65 * w65 * (0.5 * w65);
        const double w67 = -1.0 - 2.0 * (1.5 * w64 - 1.5 * w66);
        const double w68 = -0.3 * w64 - 0.3 * w66;
        Nr1_0 = Q1_7 * w67 - Q1_8 * w68 + p_2 * w52;
        s_mu_0 = m_0 + Nr1_0 * w69;
        const double y1_0 = xi1_0 * w70;
        const double y1_1 = xi1_1 * w70;
        const double y1_2 = xi1_2 * w70;
        const double w71 = y1_0 * y1_0 + y1_1 * y1_1 + y1_2 * y1_2;
        double c2_2, c3_1;
        stumpff_23(w71, &c2_2, &c3_1);
        const double w73 = 0.01 * xi1_0;
        const double gE1_1_3 = w54 + w56;
        const double gE1_1_6 = w61 - w60;
        const double Q1_6 = g20 * gE1_1_0 + g21 * gE1_1_3 + g22 * gE1_1_6;
        Nr1_2 = xi1_1 * w73 + w68 * Q1_6;
        s_mu_2 = m_2 + w69 * Nr1_2;
        const double w74 = -100.0 * xi1_0;
        Nr1_1 = p_2 * w74 - w67 * Q1_6;
        s_mu_1 = m_1 + w69 * Nr1_1;
        const double w75 = y1_1 * s_mu_2 - y1_2 * s_mu_1;
        const double w77 = y1_0 * s_mu_1 - s_mu_0 * y1_1;
        const double w78 = s_mu_0 * y1_2 - y1_0 * s_mu_2;
        const double y1_2_0 = xi1_0 * w79;
        const double y1_2_1 = xi1_1 * w79;
        const double y1_2_2 = xi1_2 * w79;
        const double w80 = y1_2_0 * y1_2_0 + y1_2_1 * y1_2_1 + y1_2_2 * y1_2_2;
        double c2_3, c3_2;
        stumpff_23(w80, &c2_3, &c3_2);
        const double w82 = Nr1_2 * y1_2_1 - Nr1_1 * y1_2_2;
        const double w84 = Nr1_1 * y1_2_0 - Nr1_0 * y1_2_1;
        const double w85 = Nr1_0 * y1_2_2 - Nr1_2 * y1_2_0;
        const double M1_0 = s_mu_0 - w75 * c2_2 + (y1_1 * w77 - y1_2 * w78) * c3_1
            + w79 * (Nr1_0 - w82 * c2_3 + (y1_2_1 * w84 - y1_2_2 * w85) * c3_2);
        const double M1_1 = s_mu_1 - w78 * c2_2 + (y1_2 * w75 - y1_0 * w77) * c3_1
            + w79 * (Nr1_1 - w85 * c2_3 + (y1_2_2 * w82 - y1_2_0 * w84) * c3_2);
        const double M1_2 = s_mu_2 - w77 * c2_2 + (y1_0 * w78 - y1_1 * w75) * c3_1
            + w79 * (Nr1_2 - w84 * c2_3 + (y1_2_0 * w85 - y1_2_1 * w82) * c3_2);
        const double Wf1_0 = 0.9900990099009901
            * (gE1_1_0 * M1_0 + gE1_1_3 * M1_1 + gE1_1_6 * M1_2);
        const double Pf1_1 = gE1_1_1 * M1_0 + gE1_1_4 * M1_1 + gE1_1_7 * M1_2;
        const double Wf1_2 = 100.0 * (gE1_1_2 * M1_0 + gE1_1_5 * M1_1 + gE1_1_8 * M1_2);
        const double next_xi1_0 = gE1_1_0 * Wf1_0 + gE1_1_1 * Pf1_1 + gE1_1_2 * Wf1_2;
        const double next_xi1_1 = gE1_1_3 * Wf1_0 + gE1_1_4 * Pf1_1 + gE1_1_5 * Wf1_2;
        const double next_xi1_2 = gE1_1_6 * Wf1_0 + gE1_1_7 * Pf1_1 + gE1_1_8 * Wf1_2;
        const double residual_xi1_0 = next_xi1_0 - xi1_0;
        const double residual_xi1_1 = next_xi1_1 - xi1_1;
        const double residual_xi1_2 = next_xi1_2 - xi1_2;
        if (!isfinite(residual_xi1_0 + residual_xi1_1 + residual_xi1_2)) {
            count_sweeps(statistics, 0, sweep, 1);
            return DIPOLE_VCG_TRIPLE_JUMP_NOT_FINITE;
        }
        const double change_xi1_0 = inverse_1_0 * residual_xi1_0 + inverse_1_1 * residual_xi1_1
            + inverse_1_2 * residual_xi1_2;
        const double change_xi1_1 = inverse_1_3 * residual_xi1_0 + inverse_1_4 * residual_xi1_1
            + inverse_1_5 * residual_xi1_2;
        const double change_xi1_2 = inverse_1_6 * residual_xi1_0 + inverse_1_7 * residual_xi1_1
            + inverse_1_8 * residual_xi1_2;
        const double change = greater(fabs(change_xi1_0), greater(fabs(change_xi1_1),
            fabs(change_xi1_2)));
        const double scale = greater(greater(1.0, fabs(xi1_0)), greater(fabs(xi1_1), fabs(xi1_2)));
        const int still = previous_1 > 0.0 && change >= previous_1;
        if (sweep == 1) {
            memory->first = greater(memory->first, change);
        }
        if (previous_1 > 0.0) {
            rate_1 = greater(change / previous_1, 0.000244140625);
        }
        const int close = change <= 5.684341886080802e-14 * scale
            && change * rate_1 <= 1.1102230246251565e-16 * scale;
        xi1_0 += change_xi1_0;
        xi1_1 += change_xi1_1;
        xi1_2 += change_xi1_2;
        if (close || (still && change <= 5.684341886080802e-14 * scale)) {
            count_sweeps(statistics, 0, sweep, 0);
            memory->rate_1 = sweep > 1 ? rate_1 : 2.0 * rate_1;
            break;
        }
        if (sweep == 100) {
            count_sweeps(statistics, 0, sweep, 1);
            return DIPOLE_VCG_TRIPLE_JUMP_NOT_CONVERGED;
        }
        previous_1 = change;
    }
    const double xe1_1 = xi1_1 * w69;
    const double xe1_0 = xi1_0 * w69;
    const double w124 = xe1_0 * xe1_0;
    const double w125 = xe1_1 * xe1_1;
    const double w126 = w124 + w125;
    const double xe1_2 = xi1_2 * w69;
    const double w127 = xe1_2 * xe1_2;
    const double w128 = w126 + w127;
    double c1_2, c2_4;
    stumpff_12(w128, &c1_2, &c2_4);
    const double w130 = xe1_1 * c2_4;
    const double w131 = xe1_1 * w130;
    const double w132 = xe1_2 * c2_4;
    const double w133 = xe1_2 * w132;
    const double w134 = w131 + w133;
    const double ge1_0 = 1.0 - w134;
    const double w135 = -0.8512071919596577 * h;
    const double w142 = xe1_2 * c1_2;
    const double w143 = xe1_0 * c2_4;
    const double w144 = xe1_1 * w143;
    const double ge1_3 = w142 + w144;
    const double w149 = xe1_2 * w143;
    const double w150 = xe1_1 * c1_2;
    const double ge1_6 = w149 - w150;
    const double ge1_2 = w149 + w150;
    const double w153 = xe1_2 * w130;
    const double w154 = xe1_0 * c1_2;
    const double ge1_5 = w153 - w154;
    const double w155 = xe1_0 * w143;
    const double w156 = w131 + w155;
    const double ge1_8 = 1.0 - w156;
    const double ge1_1 = w144 - w142;
    const double w160 = w133 + w155;
    const double ge1_4 = 1.0 - w160;
    const double ge1_7 = w153 + w154;
    const double w168 = -1.7024143839193153 * h;
    const double w172 = 1.7024143839193153 * h;
    const double w179 = 0.8512071919596577 * h;
    /* the equations of xi2, n2: Newton's method with the matrix to first order in h in xi2_0, xi2_1, xi2_2 */
    double w169, w170, w171;
    double previous_2 = 0.0;
    double rate_2 = memory->known > 0 ? memory->rate_2 : 1.0;
    const double w86 = 0.8512071919596577 * h;
    const double w87 = -1.7024143839193153 * h;
    const double w88 = w86 + w87;
    const double Wxi0_0__ = 0.9900990099009901 * m_0;
    const double w89 = h * Wxi0_0__;
    const double w90 = h * m_0;
    const double w91 = w89 - w90;
    const double w92 = -0.5 * h;
    const double w93 = m_0 * w92;
    const double w94 = -0.01 * (100.0 * xi2_0 * w88) - 0.8512071919596577 * w91
        + 1.7024143839193153 * w93;
    const double w95 = 85.12071919596576 * h - 170.24143839193152 * h;
    const double w96 = 100.0 * m_0;
    const double w97 = h * w96 - w89;
    const double w98 = -50.0 * h;
    const double w99 = m_0 * w98;
    const double w100 = 0.01 * xi2_0 * w95 - 0.8512071919596577 * w97
        - 1.7024143839193153 * w99;
    const double w101 = 1.0 - w94 * w100;
    const double w102 = 0.842779397979859 * h - 1.685558795959718 * h;
    const double Wxi0_2__ = 100.0 * m_2;
    const double w103 = h * Wxi0_2__;
    const double w104 = 0.9900990099009901 * m_2;
    const double w105 = w103 - h * w104;
    const double w106 = -0.49504950495049505 * h;
    const double w107 = m_2 * w106;
    const double w108 = 0.99 * xi2_2 * w102 - 0.8512071919596577 * w105
        + 1.7024143839193153 * w107;
    const double w109 = h * m_2 - w103;
    const double w110 = m_2 * w92;
    const double w111 = -0.8512071919596577 * w109 - xi2_2 * w88 - 1.7024143839193153 * w110;
    const double w112 = h * m_1;
    const double w113 = 100.0 * m_1;
    const double w114 = w112 - h * w113;
    const double w115 = m_1 * w98;
    const double w116 = 0.01 * xi2_1 * w95 - 0.8512071919596577 * w114
        + 1.7024143839193153 * w115;
    const double w117 = w111 + w94 * w116;
    const double w118 = 0.9900990099009901 * m_1;
    const double w119 = h * w118 - w112;
    const double w120 = m_1 * w106;
    const double w121 = 0.01 * (99.0 * xi2_1 * w102) - 0.8512071919596577 * w119
        - 1.7024143839193153 * w120;
    const double w122 = w116 + w100 * w111;
    const double w123 = 1.0 / (w101 - w108 * w117 - w121 * w122);
    const double inverse_2_0 = w101 * w123;
    const double inverse_2_1 = w123 * (w108 + w100 * w121);
    const double inverse_2_2 = w123 * (w121 + w94 * w108);
    const double inverse_2_3 = w117 * w123;
    const double inverse_2_4 = w123 * (1.0 - w116 * w121);
    const double inverse_2_5 = w123 * (w94 + w111 * w121);
    const double inverse_2_6 = w122 * w123;
    const double inverse_2_7 = w123 * (w100 + w108 * w116);
    const double inverse_2_8 = w123 * (1.0 - w108 * w111);
    for (size_t sweep = 1;; sweep++) {
        const double xE2_2_1 = xi2_1 * w135;
        const double xE2_2_0 = xi2_0 * w135;
        const double xE2_2_2 = xi2_2 * w135;
        const double w136 = xE2_2_0 * xE2_2_0 + xE2_2_1 * xE2_2_1 + xE2_2_2 * xE2_2_2;
        double c1_3, c2_5;
        stumpff_12(w136, &c1_3, &c2_5);
        const double w138 = xE2_2_1 * c2_5;
        const double w139 = xE2_2_1 * w138;
        const double w140 = xE2_2_2 * c2_5 * xE2_2_2;
        const double gE2_2_0 = 1.0 - (w139 + w140);
        const double w145 = xE2_2_0 * c2_5;
        const double w146 = xE2_2_1 * w145;
        const double w148 = xE2_2_2 * c1_3;
        const double gE2_2_1 = w146 - w148;
        const double w151 = xE2_2_1 * c1_3;
        const double w152 = xE2_2_2 * w145;
        const double gE2_2_2 = w151 + w152;
        const double E2_2_0 = ge1_0 * gE2_2_0 + ge1_3 * gE2_2_1 + ge1_6 * gE2_2_2;
        const double E2_2_2 = gE2_2_0 * ge1_2 + gE2_2_1 * ge1_5 + gE2_2_2 * ge1_8;
        const double gE2_2_3 = w146 + w148;
        const double w157 = xE2_2_0 * w145;
        const double gE2_2_4 = 1.0 - (w140 + w157);
        const double w158 = xE2_2_2 * w138;
        const double w159 = xE2_2_0 * c1_3;
        const double gE2_2_5 = w158 - w159;
        const double E2_2_5 = ge1_2 * gE2_2_3 + ge1_5 * gE2_2_4 + ge1_8 * gE2_2_5;
        const double gE2_2_6 = w152 - w151;
        const double gE2_2_7 = w158 + w159;
        const double gE2_2_8 = 1.0 - (w139 + w157);
        const double E2_2_8 = ge1_2 * gE2_2_6 + ge1_5 * gE2_2_7 + ge1_8 * gE2_2_8;
        const double p_2_2 = 0.01 * (xi2_0 * E2_2_2 + xi2_1 * E2_2_5 + xi2_2 * E2_2_8);
        const double E2_2_1 = gE2_2_0 * ge1_1 + gE2_2_1 * ge1_4 + gE2_2_2 * ge1_7;
        const double E2_2_4 = gE2_2_3 * ge1_1 + gE2_2_4 * ge1_4 + gE2_2_5 * ge1_7;
        const double E2_2_7 = gE2_2_6 * ge1_1 + gE2_2_7 * ge1_4 + gE2_2_8 * ge1_7;
        const double a_3_1 = xi2_0 * E2_2_1 + xi2_1 * E2_2_4 + xi2_2 * E2_2_7;
        const double Q2_7 = g20 * E2_2_1 + g21 * E2_2_4 + g22 * E2_2_7;
        const double Q2_8 = g20 * E2_2_2 + g21 * E2_2_5 + g22 * E2_2_8;
        const double w161 = 1.5 - 2.0 * Q2_8;
        const double w162 = 1.0 / sqrt(1.01 + 1.5 * (w161 - 0.2 * Q2_7));
        const double w163 = w162 * w162 * (0.5 * w162);
        const double w164 = 1.0 / sqrt(1.01 + 1.5 * (w161 + 0.2 * Q2_7));
        const double w165 = w164 * w164 * (0.5 * w164);
        const double w166 = -1.0 - 2.0 * (1.5 * w163 - 1.5 * w165);
        const double w167 = -0.3 * w163 - 0.3 * w165;
        const double Nr2_0 = Q2_7 * w166 - Q2_8 * w167 + 99.0 * a_3_1 * p_2_2;
        w169 = Nr2_0 * w168;
        const double s_m2_4_0 = s_mu_0 + w169;
        const double E2_2_3 = ge1_0 * gE2_2_3 + ge1_3 * gE2_2_4 + ge1_6 * gE2_2_5;
        const double E2_2_6 = ge1_0 * gE2_2_6 + ge1_3 * gE2_2_7 + ge1_6 * gE2_2_8;
        const double a_3_0 = xi2_0 * E2_2_0 + xi2_1 * E2_2_3 + xi2_2 * E2_2_6;
        const double Q2_6 = g20 * E2_2_0 + g21 * E2_2_3 + g22 * E2_2_6;
        const double Nr2_1 = -100.0 * a_3_0 * p_2_2 - w166 * Q2_6;
        w170 = w168 * Nr2_1;
        const double s_m2_4_1 = s_mu_1 + w170;
        const double Nr2_2 = 0.01 * a_3_0 * a_3_1 + w167 * Q2_6;
        w171 = w168 * Nr2_2;
        const double s_m2_4_2 = s_mu_2 + w171;
        const double m2_4_2_0 = ge1_0 * s_m2_4_0 + ge1_1 * s_m2_4_1 + ge1_2 * s_m2_4_2;
        const double y2_0 = xi2_0 * w172;
        const double y2_1 = xi2_1 * w172;
        const double y2_2 = xi2_2 * w172;
        const double w173 = y2_0 * y2_0 + y2_1 * y2_1 + y2_2 * y2_2;
        double c2_6, c3_3;
        stumpff_23(w173, &c2_6, &c3_3);
        const double m2_4_2_2 = ge1_6 * s_m2_4_0 + ge1_7 * s_m2_4_1 + ge1_8 * s_m2_4_2;
        const double m2_4_2_1 = ge1_3 * s_m2_4_0 + ge1_4 * s_m2_4_1 + ge1_5 * s_m2_4_2;
        const double w175 = y2_1 * m2_4_2_2 - y2_2 * m2_4_2_1;
        const double w177 = y2_0 * m2_4_2_1 - m2_4_2_0 * y2_1;
        const double w178 = m2_4_2_0 * y2_2 - y2_0 * m2_4_2_2;
        const double m2_3_0 = ge1_0 * Nr2_0 + ge1_1 * Nr2_1 + ge1_2 * Nr2_2;
        const double y2_2_0 = xi2_0 * w179;
        const double y2_2_1 = xi2_1 * w179;
        const double y2_2_2 = xi2_2 * w179;
        const double w180 = y2_2_0 * y2_2_0 + y2_2_1 * y2_2_1 + y2_2_2 * y2_2_2;
        double c2_7, c3_4;
        stumpff_23(w180, &c2_7, &c3_4);
        const double m2_3_2 = ge1_6 * Nr2_0 + ge1_7 * Nr2_1 + ge1_8 * Nr2_2;
        const double m2_3_1 = ge1_3 * Nr2_0 + ge1_4 * Nr2_1 + ge1_5 * Nr2_2;
        const double w182 = y2_2_1 * m2_3_2 - y2_2_2 * m2_3_1;
        const double w184 = y2_2_0 * m2_3_1 - m2_3_0 * y2_2_1;
        const double w185 = m2_3_0 * y2_2_2 - y2_2_0 * m2_3_2;
        const double M2_0 = m2_4_2_0 - w175 * c2_6 + (y2_1 * w177 - y2_2 * w178) * c3_3
            + w179 * (m2_3_0 - w182 * c2_7 + (y2_2_1 * w184 - y2_2_2 * w185) * c3_4);
        const double M2_1 = m2_4_2_1 - w178 * c2_6 + (y2_2 * w175 - y2_0 * w177) * c3_3
            + w179 * (m2_3_1 - w185 * c2_7 + (y2_2_2 * w182 - y2_2_0 * w184) * c3_4);
        const double M2_2 = m2_4_2_2 - w177 * c2_6 + (y2_0 * w178 - y2_1 * w175) * c3_3
            + w179 * (m2_3_2 - w184 * c2_7 + (y2_2_0 * w185 - y2_2_1 * w182) * c3_4);
        const double Wf2_0 = 0.9900990099009901 * (E2_2_0 * M2_0 + E2_2_3 * M2_1 + E2_2_6 * M2_2);
        const double Pf2_1 = E2_2_1 * M2_0 + E2_2_4 * M2_1 + E2_2_7 * M2_2;
        const double Wf2_2 = 100.0 * (E2_2_2 * M2_0 + E2_2_5 * M2_1 + E2_2_8 * M2_2);
        const double next_xi2_0 = E2_2_0 * Wf2_0 + E2_2_1 * Pf2_1 + E2_2_2 * Wf2_2;
        const double next_xi2_1 = E2_2_3 * Wf2_0 + E2_2_4 * Pf2_1 + E2_2_5 * Wf2_2;
        const double next_xi2_2 = E2_2_6 * Wf2_0 + E2_2_7 * Pf2_1 + E2_2_8 * Wf2_2;
        const double residual_xi2_0 = next_xi2_0 - xi2_0;
        const double residual_xi2_1 = next_xi2_1 - xi2_1;
        const double residual_xi2_2 = next_xi2_2 - xi2_2;
        if (!isfinite(residual_xi2_0 + residual_xi2_1 + residual_xi2_2)) {
            count_sweeps(statistics, 1, sweep, 1);
            return DIPOLE_VCG_TRIPLE_JUMP_NOT_FINITE;
        }
        const double change_xi2_0 = inverse_2_0 * residual_xi2_0 + inverse_2_1 * residual_xi2_1
            + inverse_2_2 * residual_xi2_2;
        const double change_xi2_1 = inverse_2_3 * residual_xi2_0 + inverse_2_4 * residual_xi2_1
            + inverse_2_5 * residual_xi2_2;
        const double change_xi2_2 = inverse_2_6 * residual_xi2_0 + inverse_2_7 * residual_xi2_1
            + inverse_2_8 * residual_xi2_2;
        const double change = greater(fabs(change_xi2_0), greater(fabs(change_xi2_1),
            fabs(change_xi2_2)));
        const double scale = greater(greater(1.0, fabs(xi2_0)), greater(fabs(xi2_1), fabs(xi2_2)));
        const int still = previous_2 > 0.0 && change >= previous_2;
        if (sweep == 1) {
            memory->first = greater(memory->first, change);
        }
        if (previous_2 > 0.0) {
            rate_2 = greater(change / previous_2, 0.000244140625);
        }
        const int close = change <= 5.684341886080802e-14 * scale
            && change * rate_2 <= 1.1102230246251565e-16 * scale;
        xi2_0 += change_xi2_0;
        xi2_1 += change_xi2_1;
        xi2_2 += change_xi2_2;
        if (close || (still && change <= 5.684341886080802e-14 * scale)) {
            count_sweeps(statistics, 1, sweep, 0);
            memory->rate_2 = sweep > 1 ? rate_2 : 2.0 * rate_2;
            break;
        }
        if (sweep == 100) {
            count_sweeps(statistics, 1, sweep, 1);
            return DIPOLE_VCG_TRIPLE_JUMP_NOT_CONVERGED;
        }
        previous_2 = change;
    }
    const double xe2_1 = xi2_1 * w168;
    const double xe2_0 = xi2_0 * w168;
    const double w221 = xe2_0 * xe2_0;
    const double w222 = xe2_1 * xe2_1;
    const double w223 = w221 + w222;
    const double xe2_2 = xi2_2 * w168;
    const double w224 = xe2_2 * xe2_2;
    const double w225 = w223 + w224;
    double c1_4, c2_8;
    stumpff_12(w225, &c1_4, &c2_8);
    const double w227 = xe2_1 * c2_8;
    const double w228 = xe2_1 * w227;
    const double w229 = xe2_2 * c2_8;
    const double w230 = xe2_2 * w229;
    const double w231 = w228 + w230;
    const double ge2_0 = 1.0 - w231;
    const double w232 = ge1_0 * ge2_0;
    const double w233 = xe2_0 * c2_8;
    const double w234 = xe2_1 * w233;
    const double w236 = xe2_2 * c1_4;
    const double ge2_1 = w234 - w236;
    const double w237 = ge1_3 * ge2_1;
    const double w238 = w232 + w237;
    const double w239 = xe2_1 * c1_4;
    const double w240 = xe2_2 * w233;
    const double ge2_2 = w239 + w240;
    const double w241 = ge1_6 * ge2_2;
    const double e2_0 = w238 + w241;
    const double ge2_3 = w234 + w236;
    const double w247 = ge1_0 * ge2_3;
    const double w248 = xe2_0 * w233;
    const double w249 = w230 + w248;
    const double ge2_4 = 1.0 - w249;
    const double w250 = ge1_3 * ge2_4;
    const double w251 = w247 + w250;
    const double w252 = xe2_2 * w227;
    const double w253 = xe2_0 * c1_4;
    const double ge2_5 = w252 - w253;
    const double w254 = ge1_6 * ge2_5;
    const double e2_3 = w251 + w254;
    const double ge2_6 = w240 - w239;
    const double w259 = ge1_0 * ge2_6;
    const double ge2_7 = w252 + w253;
    const double w260 = ge1_3 * ge2_7;
    const double w261 = w259 + w260;
    const double w262 = w228 + w248;
    const double ge2_8 = 1.0 - w262;
    const double w263 = ge1_6 * ge2_8;
    const double e2_6 = w261 + w263;
    const double w266 = ge1_2 * ge2_0;
    const double w267 = ge1_5 * ge2_1;
    const double w268 = w266 + w267;
    const double w269 = ge1_8 * ge2_2;
    const double e2_2 = w268 + w269;
    const double w270 = ge1_2 * ge2_3;
    const double w271 = ge1_5 * ge2_4;
    const double w272 = w270 + w271;
    const double w273 = ge1_8 * ge2_5;
    const double e2_5 = w272 + w273;
    const double w274 = ge1_2 * ge2_6;
    const double w275 = ge1_5 * ge2_7;
    const double w276 = w274 + w275;
    const double w277 = ge1_8 * ge2_8;
    const double e2_8 = w276 + w277;
    const double w281 = ge1_1 * ge2_0;
    const double w282 = ge1_4 * ge2_1;
    const double w283 = w281 + w282;
    const double w284 = ge1_7 * ge2_2;
    const double e2_1 = w283 + w284;
    const double w285 = ge1_1 * ge2_3;
    const double w286 = ge1_4 * ge2_4;
    const double w287 = w285 + w286;
    const double w288 = ge1_7 * ge2_5;
    const double e2_4 = w287 + w288;
    const double w289 = ge1_1 * ge2_6;
    const double w290 = ge1_4 * ge2_7;
    const double w291 = w289 + w290;
    const double w292 = ge1_7 * ge2_8;
    const double e2_7 = w291 + w292;
    /* the equations of xi3, n3: Newton's method with the matrix to first order in h in xi3_0, xi3_1, xi3_2 */
    double s_m3_5_0, s_m3_5_1, s_m3_5_2;
    double previous_3 = 0.0;
    double rate_3 = memory->known > 0 ? memory->rate_3 : 1.0;
    const double w186 = -0.5 * h;
    const double w187 = m_0 * w186;
    const double w188 = -1.3512071919596575 * w187;
    const double Wxi0_0___ = 0.9900990099009901 * m_0;
    const double w189 = w46 * Wxi0_0___;
    const double w190 = h * m_0;
    const double w191 = w69 + w79;
    const double w192 = w189 - 0.6756035959798288 * w190 - 0.01 * (100.0 * xi3_0 * w191) + w188;
    const double w193 = -50.0 * h;
    const double w194 = m_0 * w193;
    const double w195 = 1.3512071919596575 * w194;
    const double w196 = 100.0 * m_0;
    const double w197 = 135.12071919596576 * h - 67.56035959798288 * h;
    const double w198 = w46 * w196 - w189 + 0.01 * xi3_0 * w197 + w195;
    const double w199 = 1.0 - w192 * w198;
    const double w200 = -0.49504950495049505 * h;
    const double w201 = m_2 * w200;
    const double w202 = -1.3512071919596575 * w201;
    const double w203 = 0.9900990099009901 * m_2;
    const double w204 = 1.337828902930354 * h - 0.668914451465177 * h;
    const double w205 = 67.56035959798288 * m_2 * h - w46 * w203 + 0.99 * xi3_2 * w204 + w202;
    const double w206 = m_2 * w186;
    const double w207 = 1.3512071919596575 * w206;
    const double Wxi0_2___ = 100.0 * m_2;
    const double w208 = 0.6756035959798288 * m_2 * h - w46 * Wxi0_2___ - xi3_2 * w191 + w207;
    const double w209 = m_1 * w193;
    const double w210 = -1.3512071919596575 * w209;
    const double w211 = 100.0 * m_1;
    const double w212 = m_1 * w46 - w46 * w211 + 0.01 * xi3_1 * w197 + w210;
    const double w213 = w208 + w192 * w212;
    const double w214 = m_1 * w200;
    const double w215 = 1.3512071919596575 * w214;
    const double w216 = 0.9900990099009901 * m_1;
    const double w217 = h * m_1;
    const double w218 = w46 * w216 - 0.6756035959798288 * w217 + 0.01 * (99.0 * xi3_1 * w204)
        + w215;
    const double w219 = w212 + w198 * w208;
    const double w220 = 1.0 / (w199 - w205 * w213 - w218 * w219);
    const double inverse_3_0 = w199 * w220;
    const double inverse_3_1 = w220 * (w205 + w198 * w218);
    const double inverse_3_2 = w220 * (w218 + w192 * w205);
    const double inverse_3_3 = w213 * w220;
    const double inverse_3_4 = w220 * (1.0 - w212 * w218);
    const double inverse_3_5 = w220 * (w192 + w208 * w218);
    const double inverse_3_6 = w219 * w220;
    const double inverse_3_7 = w220 * (w198 + w205 * w212);
    const double inverse_3_8 = w220 * (1.0 - w205 * w208);
    for (size_t sweep = 1;; sweep++) {
        const double xE3_3_1 = xi3_1 * w46;
        const double xE3_3_0 = xi3_0 * w46;
        const double xE3_3_2 = xi3_2 * w46;
        const double w242 = xE3_3_0 * xE3_3_0 + xE3_3_1 * xE3_3_1 + xE3_3_2 * xE3_3_2;
        double c1_5, c2_9;
        stumpff_12(w242, &c1_5, &c2_9);
        const double w244 = xE3_3_1 * c2_9;
        const double w245 = xE3_3_1 * w244;
        const double w246 = xE3_3_2 * c2_9 * xE3_3_2;
        const double gE3_3_0 = 1.0 - (w245 + w246);
        const double w255 = xE3_3_0 * c2_9;
        const double w256 = xE3_3_1 * w255;
        const double w258 = xE3_3_2 * c1_5;
        const double gE3_3_1 = w256 - w258;
        const double w264 = xE3_3_1 * c1_5;
        const double w265 = xE3_3_2 * w255;
        const double gE3_3_2 = w264 + w265;
        const double E3_3_0 = e2_0 * gE3_3_0 + e2_3 * gE3_3_1 + e2_6 * gE3_3_2;
        const double E3_3_2 = gE3_3_0 * e2_2 + gE3_3_1 * e2_5 + gE3_3_2 * e2_8;
        const double gE3_3_3 = w256 + w258;
        const double w278 = xE3_3_0 * w255;
        const double gE3_3_4 = 1.0 - (w246 + w278);
        const double w279 = xE3_3_2 * w244;
        const double w280 = xE3_3_0 * c1_5;
        const double gE3_3_5 = w279 - w280;
        const double E3_3_5 = e2_2 * gE3_3_3 + e2_5 * gE3_3_4 + e2_8 * gE3_3_5;
        const double gE3_3_6 = w265 - w264;
        const double gE3_3_7 = w279 + w280;
        const double gE3_3_8 = 1.0 - (w245 + w278);
        const double E3_3_8 = e2_2 * gE3_3_6 + e2_5 * gE3_3_7 + e2_8 * gE3_3_8;
        const double p_3_2 = 0.01 * (xi3_0 * E3_3_2 + xi3_1 * E3_3_5 + xi3_2 * E3_3_8);
        const double E3_3_1 = gE3_3_0 * e2_1 + gE3_3_1 * e2_4 + gE3_3_2 * e2_7;
        const double E3_3_4 = gE3_3_3 * e2_1 + gE3_3_4 * e2_4 + gE3_3_5 * e2_7;
        const double E3_3_7 = gE3_3_6 * e2_1 + gE3_3_7 * e2_4 + gE3_3_8 * e2_7;
        const double a_5_1 = xi3_0 * E3_3_1 + xi3_1 * E3_3_4 + xi3_2 * E3_3_7;
        const double Q3_7 = g20 * E3_3_1 + g21 * E3_3_4 + g22 * E3_3_7;
        const double Q3_8 = g20 * E3_3_2 + g21 * E3_3_5 + g22 * E3_3_8;
        const double w293 = 1.5 - 2.0 * Q3_8;
        const double w294 = 1.0 / sqrt(1.01 + 1.5 * (w293 - 0.2 * Q3_7));
        const double w295 = w294 * w294 * (0.5 * w294);
        const double w296 = 1.0 / sqrt(1.01 + 1.5 * (w293 + 0.2 * Q3_7));
        const double w297 = w296 * w296 * (0.5 * w296);
        const double w298 = -1.0 - 2.0 * (1.5 * w295 - 1.5 * w297);
        const double w299 = -0.3 * w295 - 0.3 * w297;
        const double Nr3_0 = Q3_7 * w298 - Q3_8 * w299 + 99.0 * a_5_1 * p_3_2;
        s_m3_5_0 = m_0 + w69 * (Nr1_0 + Nr3_0) + w169;
        const double E3_3_3 = e2_0 * gE3_3_3 + e2_3 * gE3_3_4 + e2_6 * gE3_3_5;
        const double E3_3_6 = e2_0 * gE3_3_6 + e2_3 * gE3_3_7 + e2_6 * gE3_3_8;
        const double a_5_0 = xi3_0 * E3_3_0 + xi3_1 * E3_3_3 + xi3_2 * E3_3_6;
        const double Q3_6 = g20 * E3_3_0 + g21 * E3_3_3 + g22 * E3_3_6;
        const double Nr3_1 = -100.0 * a_5_0 * p_3_2 - w298 * Q3_6;
        s_m3_5_1 = m_1 + w69 * (Nr1_1 + Nr3_1) + w170;
        const double Nr3_2 = 0.01 * a_5_0 * a_5_1 + w299 * Q3_6;
        s_m3_5_2 = m_2 + w69 * (Nr1_2 + Nr3_2) + w171;
        const double m3_5_2_0 = e2_0 * s_m3_5_0 + e2_1 * s_m3_5_1 + e2_2 * s_m3_5_2;
        const double y3_0 = xi3_0 * w70;
        const double y3_1 = xi3_1 * w70;
        const double y3_2 = xi3_2 * w70;
        const double w300 = y3_0 * y3_0 + y3_1 * y3_1 + y3_2 * y3_2;
        double c2_10, c3_5;
        stumpff_23(w300, &c2_10, &c3_5);
        const double m3_5_2_2 = e2_6 * s_m3_5_0 + e2_7 * s_m3_5_1 + e2_8 * s_m3_5_2;
        const double m3_5_2_1 = e2_3 * s_m3_5_0 + e2_4 * s_m3_5_1 + e2_5 * s_m3_5_2;
        const double w302 = y3_1 * m3_5_2_2 - y3_2 * m3_5_2_1;
        const double w304 = y3_0 * m3_5_2_1 - m3_5_2_0 * y3_1;
        const double w305 = m3_5_2_0 * y3_2 - y3_0 * m3_5_2_2;
        const double m3_4_0 = e2_0 * Nr3_0 + e2_1 * Nr3_1 + e2_2 * Nr3_2;
        const double y3_2_0 = xi3_0 * w79;
        const double y3_2_1 = xi3_1 * w79;
        const double y3_2_2 = xi3_2 * w79;
        const double w306 = y3_2_0 * y3_2_0 + y3_2_1 * y3_2_1 + y3_2_2 * y3_2_2;
        double c2_11, c3_6;
        stumpff_23(w306, &c2_11, &c3_6);
        const double m3_4_2 = e2_6 * Nr3_0 + e2_7 * Nr3_1 + e2_8 * Nr3_2;
        const double m3_4_1 = e2_3 * Nr3_0 + e2_4 * Nr3_1 + e2_5 * Nr3_2;
        const double w308 = y3_2_1 * m3_4_2 - y3_2_2 * m3_4_1;
        const double w310 = y3_2_0 * m3_4_1 - m3_4_0 * y3_2_1;
        const double w311 = m3_4_0 * y3_2_2 - y3_2_0 * m3_4_2;
        const double M3_0 = m3_5_2_0 - w302 * c2_10 + (y3_1 * w304 - y3_2 * w305) * c3_5
            + w79 * (m3_4_0 - w308 * c2_11 + (y3_2_1 * w310 - y3_2_2 * w311) * c3_6);
        const double M3_1 = m3_5_2_1 - w305 * c2_10 + (y3_2 * w302 - y3_0 * w304) * c3_5
            + w79 * (m3_4_1 - w311 * c2_11 + (y3_2_2 * w308 - y3_2_0 * w310) * c3_6);
        const double M3_2 = m3_5_2_2 - w304 * c2_10 + (y3_0 * w305 - y3_1 * w302) * c3_5
            + w79 * (m3_4_2 - w310 * c2_11 + (y3_2_0 * w311 - y3_2_1 * w308) * c3_6);
        const double Wf3_0 = 0.9900990099009901 * (E3_3_0 * M3_0 + E3_3_3 * M3_1 + E3_3_6 * M3_2);
        const double Pf3_1 = E3_3_1 * M3_0 + E3_3_4 * M3_1 + E3_3_7 * M3_2;
        const double Wf3_2 = 100.0 * (E3_3_2 * M3_0 + E3_3_5 * M3_1 + E3_3_8 * M3_2);
        const double next_xi3_0 = E3_3_0 * Wf3_0 + E3_3_1 * Pf3_1 + E3_3_2 * Wf3_2;
        const double next_xi3_1 = E3_3_3 * Wf3_0 + E3_3_4 * Pf3_1 + E3_3_5 * Wf3_2;
        const double next_xi3_2 = E3_3_6 * Wf3_0 + E3_3_7 * Pf3_1 + E3_3_8 * Wf3_2;
        const double residual_xi3_0 = next_xi3_0 - xi3_0;
        const double residual_xi3_1 = next_xi3_1 - xi3_1;
        const double residual_xi3_2 = next_xi3_2 - xi3_2;
        if (!isfinite(residual_xi3_0 + residual_xi3_1 + residual_xi3_2)) {
            count_sweeps(statistics, 2, sweep, 1);
            return DIPOLE_VCG_TRIPLE_JUMP_NOT_FINITE;
        }
        const double change_xi3_0 = inverse_3_0 * residual_xi3_0 + inverse_3_1 * residual_xi3_1
            + inverse_3_2 * residual_xi3_2;
        const double change_xi3_1 = inverse_3_3 * residual_xi3_0 + inverse_3_4 * residual_xi3_1
            + inverse_3_5 * residual_xi3_2;
        const double change_xi3_2 = inverse_3_6 * residual_xi3_0 + inverse_3_7 * residual_xi3_1
            + inverse_3_8 * residual_xi3_2;
        const double change = greater(fabs(change_xi3_0), greater(fabs(change_xi3_1),
            fabs(change_xi3_2)));
        const double scale = greater(greater(1.0, fabs(xi3_0)), greater(fabs(xi3_1), fabs(xi3_2)));
        const int still = previous_3 > 0.0 && change >= previous_3;
        if (sweep == 1) {
            memory->first = greater(memory->first, change);
        }
        if (previous_3 > 0.0) {
            rate_3 = greater(change / previous_3, 0.000244140625);
        }
        const int close = change <= 5.684341886080802e-14 * scale
            && change * rate_3 <= 1.1102230246251565e-16 * scale;
        xi3_0 += change_xi3_0;
        xi3_1 += change_xi3_1;
        xi3_2 += change_xi3_2;
        if (close || (still && change <= 5.684341886080802e-14 * scale)) {
            count_sweeps(statistics, 2, sweep, 0);
            memory->rate_3 = sweep > 1 ? rate_3 : 2.0 * rate_3;
            break;
        }
        if (sweep == 100) {
            count_sweeps(statistics, 2, sweep, 1);
            return DIPOLE_VCG_TRIPLE_JUMP_NOT_CONVERGED;
        }
        previous_3 = change;
    }
    const double xe3_1 = xi3_1 * w69;
    const double xe3_0 = xi3_0 * w69;
    const double xe3_2 = xi3_2 * w69;
    const double w312 = xe3_0 * xe3_0 + xe3_1 * xe3_1 + xe3_2 * xe3_2;
    double c1_6, c2_12;
    stumpff_12(w312, &c1_6, &c2_12);
    const double w314 = xe3_1 * c2_12;
    const double w315 = xe3_1 * w314;
    const double w316 = xe3_2 * c2_12 * xe3_2;
    const double ge3_0 = 1.0 - (w315 + w316);
    const double w317 = xe3_0 * c2_12;
    const double w318 = xe3_1 * w317;
    const double w320 = xe3_2 * c1_6;
    const double ge3_1 = w318 - w320;
    const double w321 = xe3_1 * c1_6;
    const double w322 = xe3_2 * w317;
    const double ge3_2 = w321 + w322;
    const double e3_0 = e2_0 * ge3_0 + e2_3 * ge3_1 + e2_6 * ge3_2;
    const double ge3_3 = w318 + w320;
    const double w323 = xe3_0 * w317;
    const double ge3_4 = 1.0 - (w316 + w323);
    const double w324 = xe3_2 * w314;
    const double w325 = xe3_0 * c1_6;
    const double ge3_5 = w324 - w325;
    const double e3_3 = e2_0 * ge3_3 + e2_3 * ge3_4 + e2_6 * ge3_5;
    const double ge3_6 = w322 - w321;
    const double ge3_7 = w324 + w325;
    const double ge3_8 = 1.0 - (w315 + w323);
    const double e3_6 = e2_0 * ge3_6 + e2_3 * ge3_7 + e2_6 * ge3_8;
    const double e3_1 = e2_1 * ge3_0 + e2_4 * ge3_1 + e2_7 * ge3_2;
    const double e3_4 = e2_1 * ge3_3 + e2_4 * ge3_4 + e2_7 * ge3_5;
    const double e3_7 = e2_1 * ge3_6 + e2_4 * ge3_7 + e2_7 * ge3_8;
    const double e3_2 = e2_2 * ge3_0 + e2_5 * ge3_1 + e2_8 * ge3_2;
    const double e3_5 = e2_2 * ge3_3 + e2_5 * ge3_4 + e2_8 * ge3_5;
    const double e3_8 = e2_2 * ge3_6 + e2_5 * ge3_7 + e2_8 * ge3_8;
    const double change_0 = s_m3_5_0 * e3_0 + s_m3_5_1 * e3_1 + s_m3_5_2 * e3_2 - m_0;
    const double change_1 = s_m3_5_0 * e3_3 + s_m3_5_1 * e3_4 + s_m3_5_2 * e3_5 - m_1;
    const double change_2 = s_m3_5_0 * e3_6 + s_m3_5_1 * e3_7 + s_m3_5_2 * e3_8 - m_2;
    const double new_g00 = g00 * e3_0 + g01 * e3_3 + g02 * e3_6;
    const double new_g01 = g00 * e3_1 + g01 * e3_4 + g02 * e3_7;
    const double new_g02 = g00 * e3_2 + g01 * e3_5 + g02 * e3_8;
    const double new_g10 = g10 * e3_0 + g11 * e3_3 + g12 * e3_6;
    const double new_g11 = g10 * e3_1 + g11 * e3_4 + g12 * e3_7;
    const double new_g12 = g10 * e3_2 + g11 * e3_5 + g12 * e3_8;
    const double new_g20 = g20 * e3_0 + g21 * e3_3 + g22 * e3_6;
    const double new_g21 = g20 * e3_1 + g21 * e3_4 + g22 * e3_7;
    const double new_g22 = g20 * e3_2 + g21 * e3_5 + g22 * e3_8;
    const double new_mu0 = g00 * change_0 + g01 * change_1 + g02 * change_2 + mu0;
    const double new_mu1 = g10 * change_0 + g11 * change_1 + g12 * change_2 + mu1;
    const double new_mu2 = g20 * change_0 + g21 * change_1 + g22 * change_2 + mu2;
    if (!(isfinite(new_g00) && isfinite(new_g01) && isfinite(new_g02) && isfinite(new_g10)
        && isfinite(new_g11) && isfinite(new_g12) && isfinite(new_g20) && isfinite(new_g21)
        && isfinite(new_g22) && isfinite(new_mu0) && isfinite(new_mu1) && isfinite(new_mu2))) {
        return DIPOLE_VCG_TRIPLE_JUMP_NOT_FINITE;
    }
    const double moved = greater(greater(greater(fabs(xi1_0 - memory->past[0][0]),
        fabs(xi1_1 - memory->past[0][1])), greater(fabs(xi1_2 - memory->past[0][2]),
        fabs(xi2_0 - memory->past[0][3]))), greater(greater(fabs(xi2_1 - memory->past[0][4]),
        fabs(xi2_2 - memory->past[0][5])), greater(fabs(xi3_0 - memory->past[0][6]),
        greater(fabs(xi3_1 - memory->past[0][7]), fabs(xi3_2 - memory->past[0][8])))));
    memmove(memory->past[1], memory->past[0], 8 * sizeof memory->past[0]);
    memory->past[0][0] = xi1_0;
    memory->past[0][1] = xi1_1;
    memory->past[0][2] = xi1_2;
    memory->past[0][3] = xi2_0;
    memory->past[0][4] = xi2_1;
    memory->past[0][5] = xi2_2;
    memory->past[0][6] = xi3_0;
    memory->past[0][7] = xi3_1;
    memory->past[0][8] = xi3_2;
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
    return DIPOLE_VCG_TRIPLE_JUMP_OK;
}

int dipole_vcg_triple_jump_step(double state[static 12], double h,
    dipole_vcg_triple_jump_statistics *statistics)
{
    struct memory memory = {0};
    return advance(state, h, &memory, statistics);
}

int dipole_vcg_triple_jump_run(double state[static 12], double h, size_t steps,
    double *trajectory, size_t stride, dipole_vcg_triple_jump_statistics *statistics,
    size_t *completed)
{
    int status = DIPOLE_VCG_TRIPLE_JUMP_OK;
    size_t step = 0;
    struct memory memory = {0};
    double *row = stride > 0 ? trajectory : NULL;
    if (row != NULL) {
        memcpy(row, state, 12 * sizeof *state);
    }
    while (step < steps) {
        status = advance(state, h, &memory, statistics);
        if (status != DIPOLE_VCG_TRIPLE_JUMP_OK && memory.known > 0) {
            /* the solutions before may mislead where the motion changes: begin as the first step does */
            memset(&memory, 0, sizeof memory);
            if (statistics != NULL) {
                statistics->failed = 0;
            }
            status = advance(state, h, &memory, statistics);
        }
        if (status != DIPOLE_VCG_TRIPLE_JUMP_OK) {
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
