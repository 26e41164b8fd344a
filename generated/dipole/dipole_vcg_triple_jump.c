/*
 * Dipole on a stick, T*SO(3) (thesis section 3.6): one step by vcg:triple_jump
 *
 * method:     family vcg, tableau triple_jump
 * source:     Yoshida 1990; Hairer, Lubich and Wanner, (II.4.4); Table 3.2b of Bogfjellmo and
 *             Marthinsen
 * order:      4, certificate: exact (every order condition up to it is zero in exact arithmetic)
 * scene:      Dipole on a stick, T*SO(3) (thesis section 3.6), group SO(3)
 * solved by:  the equations of xi1, n1: Newton's method, 3 unknowns (2.1 sweeps of 306 operations
 *             and 0.05 matrices of 106 a step; fixed point: 3.2 sweeps of 304 operations; Newton's
 *             method with the matrix to first order in h: 2.0 sweeps of 319 operations and 1.00
 *             matrices of 105)
 * solved by:  the equations of xi2, n2: Newton's method, 3 unknowns (2.1 sweeps of 381 operations
 *             and 0.05 matrices of 73 a step; fixed point: 3.4 sweeps of 379 operations; Newton's
 *             method with the matrix to first order in h: 2.0 sweeps of 394 operations and 1.00
 *             matrices of 111)
 * solved by:  the equations of xi3, n3: Newton's method, 3 unknowns (2.0 sweeps of 387 operations
 *             and 0.05 matrices of 124 a step; fixed point: 3.2 sweeps of 385 operations; Newton's
 *             method with the matrix to first order in h: 1.9 sweeps of 400 operations and 1.00
 *             matrices of 109)
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
 *             1 mul (rows)
 *             6 dexpt (functions)
 *             1 Adinv (opposites)
 *             2 Adinv, 3 legendre (sharing)
 *             1 lin (scalars)
 *             1 lin (sharing)
 *             parameters, folded: beta = 1, depth = 3/2
 *             the time: the scene does not depend on it
 * operations: 214 add, 340 mul, 5 stumpff_12, 4 sqrt, 4 div a step
 *             2 mul a start, in steps that follow no other
 *             29 add, 73 mul, 1 div a matrix of the equations of xi1, n1
 *             87 add, 136 mul, 2 div, 2 sqrt, 1 stumpff_12, 2 stumpff_23 a sweep of the equations
 *             of xi1, n1
 *             23 add, 46 mul, 1 div a matrix of the equations of xi2, n2
 *             117 add, 181 mul, 2 div, 2 sqrt, 1 stumpff_12, 2 stumpff_23 a sweep of the equations
 *             of xi2, n2
 *             41 add, 79 mul, 1 div a matrix of the equations of xi3, n3
 *             123 add, 181 mul, 2 div, 2 sqrt, 1 stumpff_12, 2 stumpff_23 a sweep of the equations
 *             of xi3, n3
 * stack:      at most 9280 bytes, without what the mathematical library takes
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
static inline void stumpff_23_far(double z, double *c2, double *c3)
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
static inline void stumpff_12_far(double z, double *c1, double *c2)
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

static void count_matrix(dipole_vcg_triple_jump_statistics *statistics)
{
    if (statistics != NULL) {
        statistics->matrices++;
    }
}

/* What one step of a run leaves for the next: solutions of its equations, the latest first, and inverses of Newton's matrices. */
struct memory {
    size_t known;
    double first; /* by how much the guess was off */
    size_t degree;
    double guess[9];
    double differences[9][16];
    double rate_1;
    double rate_2;
    double rate_3;
    int made_1;
    double inverse_1[9];
    int made_2;
    double inverse_2[9];
    int made_3;
    double inverse_3[9];
};

/* The size of a backward difference. */
static inline double size_of(const struct memory *memory, size_t k)
{
    double size = 0.0;
    for (size_t i = 0; i < 9; i++) {
        size += fabs(memory->differences[i][k]);
    }
    return size;
}

/* Take up a solution and guess the next: the polynomial through the last ones, continued by a step. */
static inline void remember(struct memory *memory, const double solution[static 9])
{
    if (memory->known > 2) { /* the guess was no mere copy */
        double moved = 0.0;
        for (size_t i = 0; i < 9; i++) {
            moved += fabs(solution[i] - memory->differences[i][0]);
        }
        if (memory->first > 0.5 * moved) {
            memory->known = memory->degree = 0;
        }
    }
    memory->first = 0.0;
    const size_t last = memory->known < 16 ? memory->known : 15, k = memory->degree;
    for (size_t i = 0; i < 9; i++) {
        double *const differences = memory->differences[i];
        double d = solution[i], sum = 0.0;
        for (size_t j = 0; j <= k; j++) {
            const double before = differences[j];
            differences[j] = d;
            sum += d;
            d -= before;
        }
        for (size_t j = k + 1; j <= last; j++) {
            const double before = differences[j];
            differences[j] = d;
            d -= before;
        }
        memory->guess[i] = sum;
    }
    memory->known = last + 1;
    /* the degree of the next guess grows while the differences fall */
    if (k + 1 < memory->known && size_of(memory, k + 1) < size_of(memory, k)) {
        memory->degree = k + 1;
    } else if (k > 0 && size_of(memory, k) > size_of(memory, k - 1)) {
        memory->degree = k - 1;
    }
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
        xi1_0 = memory->guess[0];
        xi1_1 = memory->guess[1];
        xi1_2 = memory->guess[2];
        xi2_0 = memory->guess[3];
        xi2_1 = memory->guess[4];
        xi2_2 = memory->guess[5];
        xi3_0 = memory->guess[6];
        xi3_1 = memory->guess[7];
        xi3_2 = memory->guess[8];
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
    const double w1 = 0.6756035959798288 * h;
    const double w15 = 1.3512071919596575 * h;
    const double w16 = -1.3512071919596575 * h;
    const double w23 = -0.6756035959798288 * h;
    /* the equations of xi1, n1: Newton's method in xi1_0, xi1_1, xi1_2 */
    double s_mu_0_seen, s_mu_1_seen, s_mu_2_seen, d_xi1_0, d_xi1_1, d_xi1_2;
    double previous_1 = 0.0;
    double rate_1 = memory->known > 0 ? memory->rate_1 : 1.0;
    int make_1 = !memory->made_1;
    for (size_t sweep = 1;; sweep++) {
        const double p_2 = 0.01 * xi1_2;
        const double xE1_1_0 = xi1_0 * w1;
        const double xE1_1_1 = xi1_1 * w1;
        const double xE1_1_2 = xi1_2 * w1;
        const double w2 = xE1_1_0 * xE1_1_0 + xE1_1_1 * xE1_1_1 + xE1_1_2 * xE1_1_2;
        double c1_1, c2_1;
        stumpff_12(w2, &c1_1, &c2_1);
        const double w4 = g22 * xE1_1_0 - g20 * xE1_1_2;
        const double w6 = g20 * xE1_1_1 - g21 * xE1_1_0;
        const double w7 = g21 * xE1_1_2 - g22 * xE1_1_1;
        const double Q1_7 = g21 + w4 * c1_1 + (xE1_1_0 * w6 - xE1_1_2 * w7) * c2_1;
        const double Q1_8 = g22 + w6 * c1_1 + (xE1_1_1 * w7 - xE1_1_0 * w4) * c2_1;
        const double w8 = 1.5 - 2.0 * Q1_8;
        const double w9 = 1.0 / sqrt(1.01 + 1.5 * (w8 - 0.2 * Q1_7));
        const double w10 = w9 * w9 * (0.5 * w9);
        const double w11 = 1.0 / sqrt(1.01 + 1.5 * (w8 + 0.2 * Q1_7));
        const double w12 = w11 * w11 * (0.5 * w11);
        const double w13 = -1.0 - 2.0 * (1.5 * w10 - 1.5 * w12);
        const double w14 = -0.3 * w10 - 0.3 * w12;
        const double Nr1_0 = Q1_7 * w13 - Q1_8 * w14 + 99.0 * xi1_1 * p_2;
        const double s_mu_0 = m_0 + Nr1_0 * w15;
        const double y1_0 = xi1_0 * w16;
        const double y1_1 = xi1_1 * w16;
        const double y1_2 = xi1_2 * w16;
        const double w17 = y1_0 * y1_0 + y1_1 * y1_1 + y1_2 * y1_2;
        double c2_2, c3_1;
        stumpff_23(w17, &c2_2, &c3_1);
        const double Q1_6 = g20 + w7 * c1_1 + (xE1_1_2 * w4 - xE1_1_1 * w6) * c2_1;
        const double Nr1_2 = 0.01 * xi1_0 * xi1_1 + w14 * Q1_6;
        const double s_mu_2 = m_2 + w15 * Nr1_2;
        const double Nr1_1 = -100.0 * xi1_0 * p_2 - w13 * Q1_6;
        const double s_mu_1 = m_1 + w15 * Nr1_1;
        const double w19 = y1_1 * s_mu_2 - y1_2 * s_mu_1;
        const double w21 = y1_0 * s_mu_1 - s_mu_0 * y1_1;
        const double w22 = s_mu_0 * y1_2 - y1_0 * s_mu_2;
        const double p1_4_0 = s_mu_0 - w19 * c2_2 + (y1_1 * w21 - y1_2 * w22) * c3_1;
        const double y1_2_0 = xi1_0 * w23;
        const double y1_2_1 = xi1_1 * w23;
        const double y1_2_2 = xi1_2 * w23;
        const double w24 = y1_2_0 * y1_2_0 + y1_2_1 * y1_2_1 + y1_2_2 * y1_2_2;
        double c2_3, c3_2;
        stumpff_23(w24, &c2_3, &c3_2);
        const double w26 = Nr1_2 * y1_2_1 - Nr1_1 * y1_2_2;
        const double w28 = Nr1_1 * y1_2_0 - Nr1_0 * y1_2_1;
        const double w29 = Nr1_0 * y1_2_2 - Nr1_2 * y1_2_0;
        const double M1_0 = p1_4_0
            + w23 * (Nr1_0 - w26 * c2_3 + (y1_2_1 * w28 - y1_2_2 * w29) * c3_2);
        const double w30 = xE1_1_1 * c2_1;
        const double w31 = xE1_1_1 * w30;
        const double w32 = xE1_1_2 * c2_1 * xE1_1_2;
        const double gE1_1_0 = 1.0 - (w31 + w32);
        const double p_0 = 1.01 * xi1_0;
        const double w33 = xE1_1_0 * c2_1;
        const double w34 = xE1_1_1 * w33;
        const double w35 = xE1_1_2 * c1_1;
        const double gE1_1_1 = w34 - w35;
        const double w36 = xE1_1_1 * c1_1;
        const double w37 = xE1_1_2 * w33;
        const double gE1_1_2 = w36 + w37;
        const double a_2_0 = gE1_1_0 * p_0 + xi1_1 * gE1_1_1 + p_2 * gE1_1_2;
        const double residual_0 = M1_0 - a_2_0;
        const double p1_4_1 = s_mu_1 - w22 * c2_2 + (y1_2 * w19 - y1_0 * w21) * c3_1;
        const double M1_1 = p1_4_1
            + w23 * (Nr1_1 - w29 * c2_3 + (y1_2_2 * w26 - y1_2_0 * w28) * c3_2);
        const double gE1_1_3 = w34 + w35;
        const double w38 = xE1_1_0 * w33;
        const double gE1_1_4 = 1.0 - (w32 + w38);
        const double w39 = xE1_1_2 * w30;
        const double w40 = xE1_1_0 * c1_1;
        const double gE1_1_5 = w39 - w40;
        const double a_2_1 = xi1_1 * gE1_1_4 + p_0 * gE1_1_3 + p_2 * gE1_1_5;
        const double residual_1 = M1_1 - a_2_1;
        const double p1_4_2 = s_mu_2 - w21 * c2_2 + (y1_0 * w22 - y1_1 * w19) * c3_1;
        const double M1_2 = p1_4_2
            + w23 * (Nr1_2 - w28 * c2_3 + (y1_2_0 * w29 - y1_2_1 * w26) * c3_2);
        const double gE1_1_6 = w37 - w36;
        const double gE1_1_7 = w39 + w40;
        const double gE1_1_8 = 1.0 - (w31 + w38);
        const double a_2_2 = xi1_1 * gE1_1_7 + p_0 * gE1_1_6 + p_2 * gE1_1_8;
        const double residual_2 = M1_2 - a_2_2;
        s_mu_0_seen = s_mu_0;
        s_mu_1_seen = s_mu_1;
        s_mu_2_seen = s_mu_2;
        if (make_1) {
            const double w41 = 0.6756035959798288 * g00 * mu0 + 0.6756035959798288 * g10 * mu1
                + 0.6756035959798288 * g20 * mu2;
            const double w42 = h * (w41 - 1.3512071919596575 * xi1_0);
            const double w43 = -0.6756035959798288 * g00 * mu0 - 0.6756035959798288 * g10 * mu1
                - 0.6756035959798288 * g20 * mu2;
            const double w44 = h * (0.013512071919596576 * xi1_0 + w43);
            const double w45 = 0.01 - w42 * w44;
            const double w46 = 0.6756035959798288 * g02 * mu0 + 0.6756035959798288 * g12 * mu1
                + 0.6756035959798288 * g22 * mu2;
            const double w47 = h * (1.337695120040061 * xi1_2 + w46);
            const double w48 = 0.6756035959798288 * g01 * mu0 + 0.6756035959798288 * g11 * mu1
                + 0.6756035959798288 * g21 * mu2;
            const double w49 = h * (0.013512071919596576 * xi1_1 + w48);
            const double w50 = -0.6756035959798288 * g02 * mu0 - 0.6756035959798288 * g12 * mu1
                - 0.6756035959798288 * g22 * mu2;
            const double w51 = h * (w50 - 1.3512071919596575 * xi1_2);
            const double w52 = w42 * w49 + 0.01 * w51;
            const double w53 = -0.6756035959798288 * g01 * mu0 - 0.6756035959798288 * g11 * mu1
                - 0.6756035959798288 * g21 * mu2;
            const double w54 = h * (1.337695120040061 * xi1_1 + w53);
            const double w55 = w49 + w44 * w51;
            const double w56 = 1.0 / (1.01 * w45 - w47 * w52 - w54 * w55);
            memory->inverse_1[0] = w45 * w56;
            memory->inverse_1[1] = w56 * (w44 * w54 + 0.01 * w47);
            memory->inverse_1[2] = w56 * (w54 + w42 * w47);
            memory->inverse_1[3] = w52 * w56;
            memory->inverse_1[4] = w56 * (0.0101 - w49 * w54);
            memory->inverse_1[5] = w56 * (w51 * w54 + 1.01 * w42);
            memory->inverse_1[6] = w55 * w56;
            memory->inverse_1[7] = w56 * (w47 * w49 + 1.01 * w44);
            memory->inverse_1[8] = w56 * (1.01 - w47 * w51);
            memory->made_1 = 1;
            count_matrix(statistics);
        }
        d_xi1_0 = (memory->inverse_1[0] * residual_0 + memory->inverse_1[1] * residual_1)
            + memory->inverse_1[2] * residual_2;
        d_xi1_1 = (memory->inverse_1[3] * residual_0 + memory->inverse_1[4] * residual_1)
            + memory->inverse_1[5] * residual_2;
        d_xi1_2 = (memory->inverse_1[6] * residual_0 + memory->inverse_1[7] * residual_1)
            + memory->inverse_1[8] * residual_2;
        const double change = (fabs(d_xi1_0) + fabs(d_xi1_1)) + fabs(d_xi1_2);
        if (!isfinite(change)) {
            count_sweeps(statistics, 0, sweep, 1);
            return DIPOLE_VCG_TRIPLE_JUMP_NOT_FINITE;
        }
        const double scale = (1.0 + fabs(xi1_0)) + (fabs(xi1_1) + fabs(xi1_2));
        xi1_0 += d_xi1_0;
        xi1_1 += d_xi1_1;
        xi1_2 += d_xi1_2;
        if (previous_1 > 0.0) {
            rate_1 = change / previous_1;
        } else {
            memory->first += change;
        }
        const int contracts = rate_1 < 0.5;
        if (contracts ? change * (rate_1 + 0.0009765625) <= 2.220446049250313e-16 * scale
                      : previous_1 > 0.0 && change <= 5.684341886080802e-14 * scale) {
            memory->rate_1 = rate_1;
            count_sweeps(statistics, 0, sweep, 0);
            break;
        }
        if (sweep == 100) {
            count_sweeps(statistics, 0, sweep, 1);
            return DIPOLE_VCG_TRIPLE_JUMP_NOT_CONVERGED;
        }
        make_1 = 0;
        previous_1 = change;
    }
    const double xe1_1 = xi1_1 * w15;
    const double xe1_0 = xi1_0 * w15;
    const double w57 = xe1_0 * xe1_0;
    const double w58 = xe1_1 * xe1_1;
    const double w59 = w57 + w58;
    const double xe1_2 = xi1_2 * w15;
    const double w60 = xe1_2 * xe1_2;
    const double w61 = w59 + w60;
    double c1_2, c2_4;
    stumpff_12(w61, &c1_2, &c2_4);
    const double w63 = xe1_1 * c2_4;
    const double w64 = xe1_1 * w63;
    const double w65 = xe1_2 * c2_4;
    const double w66 = xe1_2 * w65;
    const double w67 = w64 + w66;
    const double ge1_0 = 1.0 - w67;
    const double w68 = 1.337695120040061 * h;
    const double w69 = xi1_2 * w68;
    const double w70 = d_xi1_1 * w69;
    const double w71 = s_mu_0_seen + w70;
    const double w72 = xi1_1 * w68;
    const double w73 = d_xi1_2 * w72;
    const double w74 = w71 + w73;
    const double w76 = xe1_1 * c1_2;
    const double w77 = xe1_0 * c2_4;
    const double w78 = xe1_2 * w77;
    const double ge1_2 = w76 + w78;
    const double w79 = -0.8512071919596577 * h;
    const double w85 = xe1_2 * w63;
    const double w86 = xe1_0 * c1_2;
    const double ge1_5 = w85 - w86;
    const double w91 = xe1_0 * w77;
    const double w92 = w64 + w91;
    const double ge1_8 = 1.0 - w92;
    const double w98 = xe1_1 * w77;
    const double w99 = xe1_2 * c1_2;
    const double ge1_1 = w98 - w99;
    const double w100 = w66 + w91;
    const double ge1_4 = 1.0 - w100;
    const double ge1_7 = w85 + w86;
    const double w108 = -1.7024143839193153 * h;
    const double y1_2_ = xi1_2 * w16;
    const double w110 = d_xi1_0 * y1_2_;
    const double w111 = s_mu_1_seen + w110;
    const double y1_0_ = xi1_0 * w16;
    const double w112 = d_xi1_2 * y1_0_;
    const double w113 = w111 + w112;
    const double ge1_3 = w98 + w99;
    const double ge1_6 = w78 - w76;
    const double w115 = 0.013512071919596576 * h;
    const double w116 = xi1_1 * w115;
    const double w117 = d_xi1_0 * w116;
    const double w118 = s_mu_2_seen + w117;
    const double w119 = xi1_0 * w115;
    const double w120 = d_xi1_1 * w119;
    const double w121 = w118 + w120;
    const double w123 = 1.7024143839193153 * h;
    const double w130 = 0.8512071919596577 * h;
    /* the equations of xi2, n2: Newton's method in xi2_0, xi2_1, xi2_2 */
    double d_xi2_0, d_xi2_1, d_xi2_2;
    double previous_2 = 0.0;
    double rate_2 = memory->known > 0 ? memory->rate_2 : 1.0;
    int make_2 = !memory->made_2;
    for (size_t sweep = 1;; sweep++) {
        const double xE2_2_1 = xi2_1 * w79;
        const double xE2_2_0 = xi2_0 * w79;
        const double xE2_2_2 = xi2_2 * w79;
        const double w80 = xE2_2_0 * xE2_2_0 + xE2_2_1 * xE2_2_1 + xE2_2_2 * xE2_2_2;
        double c1_3, c2_5;
        stumpff_12(w80, &c1_3, &c2_5);
        const double w82 = xE2_2_1 * c2_5;
        const double w83 = xE2_2_1 * w82;
        const double w84 = xE2_2_2 * c2_5 * xE2_2_2;
        const double gE2_2_0 = 1.0 - (w83 + w84);
        const double w87 = xE2_2_0 * c2_5;
        const double w88 = xE2_2_1 * w87;
        const double w90 = xE2_2_2 * c1_3;
        const double gE2_2_1 = w88 - w90;
        const double w93 = xE2_2_1 * c1_3;
        const double w94 = xE2_2_2 * w87;
        const double gE2_2_2 = w93 + w94;
        const double E2_2_2 = ge1_2 * gE2_2_0 + ge1_5 * gE2_2_1 + ge1_8 * gE2_2_2;
        const double gE2_2_3 = w88 + w90;
        const double w95 = xE2_2_0 * w87;
        const double gE2_2_4 = 1.0 - (w84 + w95);
        const double w96 = xE2_2_2 * w82;
        const double w97 = xE2_2_0 * c1_3;
        const double gE2_2_5 = w96 - w97;
        const double E2_2_5 = ge1_2 * gE2_2_3 + ge1_5 * gE2_2_4 + ge1_8 * gE2_2_5;
        const double gE2_2_6 = w94 - w93;
        const double gE2_2_7 = w96 + w97;
        const double gE2_2_8 = 1.0 - (w83 + w95);
        const double E2_2_8 = ge1_2 * gE2_2_6 + ge1_5 * gE2_2_7 + ge1_8 * gE2_2_8;
        const double a_3_2 = xi2_0 * E2_2_2 + xi2_1 * E2_2_5 + xi2_2 * E2_2_8;
        const double p_2_2 = 0.01 * a_3_2;
        const double E2_2_1 = gE2_2_0 * ge1_1 + gE2_2_1 * ge1_4 + gE2_2_2 * ge1_7;
        const double E2_2_4 = gE2_2_3 * ge1_1 + gE2_2_4 * ge1_4 + gE2_2_5 * ge1_7;
        const double E2_2_7 = gE2_2_6 * ge1_1 + gE2_2_7 * ge1_4 + gE2_2_8 * ge1_7;
        const double a_3_1 = xi2_0 * E2_2_1 + xi2_1 * E2_2_4 + xi2_2 * E2_2_7;
        const double Q2_7 = g20 * E2_2_1 + g21 * E2_2_4 + g22 * E2_2_7;
        const double Q2_8 = g20 * E2_2_2 + g21 * E2_2_5 + g22 * E2_2_8;
        const double w101 = 1.5 - 2.0 * Q2_8;
        const double w102 = 1.0 / sqrt(1.01 + 1.5 * (w101 - 0.2 * Q2_7));
        const double w103 = w102 * w102 * (0.5 * w102);
        const double w104 = 1.0 / sqrt(1.01 + 1.5 * (w101 + 0.2 * Q2_7));
        const double w105 = w104 * w104 * (0.5 * w104);
        const double w106 = -1.0 - 2.0 * (1.5 * w103 - 1.5 * w105);
        const double w107 = -0.3 * w103 - 0.3 * w105;
        const double Nr2_0 = Q2_7 * w106 - Q2_8 * w107 + 99.0 * a_3_1 * p_2_2;
        const double w109 = Nr2_0 * w108;
        const double s_m2_4_0 = w74 + w109;
        const double E2_2_0 = ge1_0 * gE2_2_0 + gE2_2_1 * ge1_3 + gE2_2_2 * ge1_6;
        const double E2_2_3 = ge1_0 * gE2_2_3 + gE2_2_4 * ge1_3 + gE2_2_5 * ge1_6;
        const double E2_2_6 = ge1_0 * gE2_2_6 + gE2_2_7 * ge1_3 + gE2_2_8 * ge1_6;
        const double a_3_0 = xi2_0 * E2_2_0 + xi2_1 * E2_2_3 + xi2_2 * E2_2_6;
        const double Q2_6 = g20 * E2_2_0 + g21 * E2_2_3 + g22 * E2_2_6;
        const double Nr2_1 = -100.0 * a_3_0 * p_2_2 - w106 * Q2_6;
        const double w114 = w108 * Nr2_1;
        const double s_m2_4_1 = w113 + w114;
        const double Nr2_2 = 0.01 * a_3_0 * a_3_1 + w107 * Q2_6;
        const double w122 = w108 * Nr2_2;
        const double s_m2_4_2 = w121 + w122;
        const double m2_4_2_0 = ge1_0 * s_m2_4_0 + ge1_1 * s_m2_4_1 + ge1_2 * s_m2_4_2;
        const double y2_0 = xi2_0 * w123;
        const double y2_1 = xi2_1 * w123;
        const double y2_2 = xi2_2 * w123;
        const double w124 = y2_0 * y2_0 + y2_1 * y2_1 + y2_2 * y2_2;
        double c2_6, c3_3;
        stumpff_23(w124, &c2_6, &c3_3);
        const double m2_4_2_2 = ge1_7 * s_m2_4_1 + s_m2_4_0 * ge1_6 + ge1_8 * s_m2_4_2;
        const double m2_4_2_1 = ge1_4 * s_m2_4_1 + s_m2_4_0 * ge1_3 + ge1_5 * s_m2_4_2;
        const double w126 = y2_1 * m2_4_2_2 - y2_2 * m2_4_2_1;
        const double w128 = y2_0 * m2_4_2_1 - m2_4_2_0 * y2_1;
        const double w129 = m2_4_2_0 * y2_2 - y2_0 * m2_4_2_2;
        const double p2_5_0 = m2_4_2_0 - w126 * c2_6 + (y2_1 * w128 - y2_2 * w129) * c3_3;
        const double m2_3_0 = ge1_0 * Nr2_0 + ge1_1 * Nr2_1 + ge1_2 * Nr2_2;
        const double y2_2_0 = xi2_0 * w130;
        const double y2_2_1 = xi2_1 * w130;
        const double y2_2_2 = xi2_2 * w130;
        const double w131 = y2_2_0 * y2_2_0 + y2_2_1 * y2_2_1 + y2_2_2 * y2_2_2;
        double c2_7, c3_4;
        stumpff_23(w131, &c2_7, &c3_4);
        const double m2_3_2 = ge1_7 * Nr2_1 + Nr2_0 * ge1_6 + ge1_8 * Nr2_2;
        const double m2_3_1 = ge1_4 * Nr2_1 + Nr2_0 * ge1_3 + ge1_5 * Nr2_2;
        const double w133 = y2_2_1 * m2_3_2 - y2_2_2 * m2_3_1;
        const double w135 = y2_2_0 * m2_3_1 - m2_3_0 * y2_2_1;
        const double w136 = m2_3_0 * y2_2_2 - y2_2_0 * m2_3_2;
        const double M2_0 = p2_5_0
            + w130 * (m2_3_0 - w133 * c2_7 + (y2_2_1 * w135 - y2_2_2 * w136) * c3_4);
        const double p_2_0 = 1.01 * a_3_0;
        const double a_6_0 = E2_2_0 * p_2_0 + E2_2_1 * a_3_1 + E2_2_2 * p_2_2;
        const double residual_2_0 = M2_0 - a_6_0;
        const double p2_5_1 = m2_4_2_1 - w129 * c2_6 + (y2_2 * w126 - y2_0 * w128) * c3_3;
        const double M2_1 = p2_5_1
            + w130 * (m2_3_1 - w136 * c2_7 + (y2_2_2 * w133 - y2_2_0 * w135) * c3_4);
        const double a_6_1 = E2_2_3 * p_2_0 + E2_2_4 * a_3_1 + E2_2_5 * p_2_2;
        const double residual_2_1 = M2_1 - a_6_1;
        const double p2_5_2 = m2_4_2_2 - w128 * c2_6 + (y2_0 * w129 - y2_1 * w126) * c3_3;
        const double M2_2 = p2_5_2
            + w130 * (m2_3_2 - w135 * c2_7 + (y2_2_0 * w136 - y2_2_1 * w133) * c3_4);
        const double a_6_2 = E2_2_6 * p_2_0 + E2_2_7 * a_3_1 + E2_2_8 * p_2_2;
        const double residual_2_2 = M2_2 - a_6_2;
        if (make_2) {
            const double w137 = -1.337695120040061 * xi1_0;
            const double w138 = h
                * (w137 - 0.8512071919596577 * s_mu_0_seen + 1.7024143839193153 * xi2_0);
            const double w139 = h
                * (0.8512071919596577 * s_mu_0_seen + w137 - 0.01702414383919315 * xi2_0);
            const double w140 = 0.01 - w138 * w139;
            const double w141 = -0.013512071919596576 * xi1_2;
            const double w142 = h
                * (w141 - 0.8512071919596577 * s_mu_2_seen - 1.6853902400801222 * xi2_2);
            const double w143 = 1.3512071919596575 * xi1_1;
            const double w144 = h
                * (w143 - 0.8512071919596577 * s_mu_1_seen - 0.01702414383919315 * xi2_1);
            const double w145 = h
                * (0.8512071919596577 * s_mu_2_seen + w141 + 1.7024143839193153 * xi2_2);
            const double w146 = w138 * w144 + 0.01 * w145;
            const double w147 = h
                * (0.8512071919596577 * s_mu_1_seen + w143 - 1.6853902400801222 * xi2_1);
            const double w148 = w144 + w139 * w145;
            const double w149 = 1.0 / (1.01 * w140 - w142 * w146 - w147 * w148);
            memory->inverse_2[0] = w140 * w149;
            memory->inverse_2[1] = w149 * (w139 * w147 + 0.01 * w142);
            memory->inverse_2[2] = w149 * (w147 + w138 * w142);
            memory->inverse_2[3] = w146 * w149;
            memory->inverse_2[4] = w149 * (0.0101 - w144 * w147);
            memory->inverse_2[5] = w149 * (w145 * w147 + 1.01 * w138);
            memory->inverse_2[6] = w148 * w149;
            memory->inverse_2[7] = w149 * (w142 * w144 + 1.01 * w139);
            memory->inverse_2[8] = w149 * (1.01 - w142 * w145);
            memory->made_2 = 1;
            count_matrix(statistics);
        }
        d_xi2_0 = (memory->inverse_2[0] * residual_2_0 + memory->inverse_2[1] * residual_2_1)
            + memory->inverse_2[2] * residual_2_2;
        d_xi2_1 = (memory->inverse_2[3] * residual_2_0 + memory->inverse_2[4] * residual_2_1)
            + memory->inverse_2[5] * residual_2_2;
        d_xi2_2 = (memory->inverse_2[6] * residual_2_0 + memory->inverse_2[7] * residual_2_1)
            + memory->inverse_2[8] * residual_2_2;
        const double change = (fabs(d_xi2_0) + fabs(d_xi2_1)) + fabs(d_xi2_2);
        if (!isfinite(change)) {
            count_sweeps(statistics, 1, sweep, 1);
            return DIPOLE_VCG_TRIPLE_JUMP_NOT_FINITE;
        }
        const double scale = (1.0 + fabs(xi2_0)) + (fabs(xi2_1) + fabs(xi2_2));
        xi2_0 += d_xi2_0;
        xi2_1 += d_xi2_1;
        xi2_2 += d_xi2_2;
        if (previous_2 > 0.0) {
            rate_2 = change / previous_2;
        } else {
            memory->first += change;
        }
        const int contracts = rate_2 < 0.5;
        if (contracts ? change * (rate_2 + 0.0009765625) <= 2.220446049250313e-16 * scale
                      : previous_2 > 0.0 && change <= 5.684341886080802e-14 * scale) {
            memory->rate_2 = rate_2;
            count_sweeps(statistics, 1, sweep, 0);
            break;
        }
        if (sweep == 100) {
            count_sweeps(statistics, 1, sweep, 1);
            return DIPOLE_VCG_TRIPLE_JUMP_NOT_CONVERGED;
        }
        make_2 = 0;
        previous_2 = change;
    }
    const double xe2_1 = xi2_1 * w108;
    const double xe2_0 = xi2_0 * w108;
    const double w150 = xe2_0 * xe2_0;
    const double w151 = xe2_1 * xe2_1;
    const double w152 = w150 + w151;
    const double xe2_2 = xi2_2 * w108;
    const double w153 = xe2_2 * xe2_2;
    const double w154 = w152 + w153;
    double c1_4, c2_8;
    stumpff_12(w154, &c1_4, &c2_8);
    const double w156 = xe2_1 * c2_8;
    const double w157 = xe2_1 * w156;
    const double w158 = xe2_2 * c2_8;
    const double w159 = xe2_2 * w158;
    const double w160 = w157 + w159;
    const double ge2_0 = 1.0 - w160;
    const double w161 = ge1_0 * ge2_0;
    const double w162 = xe2_0 * c2_8;
    const double w163 = xe2_1 * w162;
    const double w165 = xe2_2 * c1_4;
    const double ge2_1 = w163 - w165;
    const double w166 = ge1_3 * ge2_1;
    const double w167 = w161 + w166;
    const double w168 = xe2_1 * c1_4;
    const double w169 = xe2_2 * w162;
    const double ge2_2 = w168 + w169;
    const double w170 = ge1_6 * ge2_2;
    const double e2_0 = w167 + w170;
    const double xE2_2_1_ = xi2_1 * w79;
    const double xE2_2_0_ = xi2_0 * w79;
    const double w171 = xE2_2_0_ * xE2_2_0_;
    const double w172 = xE2_2_1_ * xE2_2_1_;
    const double w173 = w171 + w172;
    const double xE2_2_2_ = xi2_2 * w79;
    const double w174 = xE2_2_2_ * xE2_2_2_;
    const double w175 = w173 + w174;
    double c1_5, c2_9;
    stumpff_12(w175, &c1_5, &c2_9);
    const double w177 = xE2_2_1_ * c2_9;
    const double w178 = xE2_2_1_ * w177;
    const double w179 = xE2_2_2_ * c2_9;
    const double w180 = xE2_2_2_ * w179;
    const double w181 = w178 + w180;
    const double gE2_2_0_ = 1.0 - w181;
    const double w182 = ge1_2 * gE2_2_0_;
    const double w183 = xE2_2_0_ * c2_9;
    const double w184 = xE2_2_1_ * w183;
    const double w186 = xE2_2_2_ * c1_5;
    const double gE2_2_1_ = w184 - w186;
    const double w187 = ge1_5 * gE2_2_1_;
    const double w188 = w182 + w187;
    const double w189 = xE2_2_1_ * c1_5;
    const double w190 = xE2_2_2_ * w183;
    const double gE2_2_2_ = w189 + w190;
    const double w191 = ge1_8 * gE2_2_2_;
    const double E2_2_2_ = w188 + w191;
    const double w192 = xi2_0 * E2_2_2_;
    const double gE2_2_3_ = w184 + w186;
    const double w193 = ge1_2 * gE2_2_3_;
    const double w194 = xE2_2_0_ * w183;
    const double w195 = w180 + w194;
    const double gE2_2_4_ = 1.0 - w195;
    const double w196 = ge1_5 * gE2_2_4_;
    const double w197 = w193 + w196;
    const double w198 = xE2_2_2_ * w177;
    const double w199 = xE2_2_0_ * c1_5;
    const double gE2_2_5_ = w198 - w199;
    const double w200 = ge1_8 * gE2_2_5_;
    const double E2_2_5_ = w197 + w200;
    const double w201 = xi2_1 * E2_2_5_;
    const double w202 = w192 + w201;
    const double gE2_2_6_ = w190 - w189;
    const double w203 = ge1_2 * gE2_2_6_;
    const double gE2_2_7_ = w198 + w199;
    const double w204 = ge1_5 * gE2_2_7_;
    const double w205 = w203 + w204;
    const double w206 = w178 + w194;
    const double gE2_2_8_ = 1.0 - w206;
    const double w207 = ge1_8 * gE2_2_8_;
    const double E2_2_8_ = w205 + w207;
    const double w208 = xi2_2 * E2_2_8_;
    const double a_3_2_ = w202 + w208;
    const double p_2_2_ = 0.01 * a_3_2_;
    const double w209 = ge1_1 * gE2_2_0_;
    const double w210 = ge1_4 * gE2_2_1_;
    const double w211 = w209 + w210;
    const double w212 = ge1_7 * gE2_2_2_;
    const double E2_2_1_ = w211 + w212;
    const double w213 = xi2_0 * E2_2_1_;
    const double w214 = ge1_1 * gE2_2_3_;
    const double w215 = ge1_4 * gE2_2_4_;
    const double w216 = w214 + w215;
    const double w217 = ge1_7 * gE2_2_5_;
    const double E2_2_4_ = w216 + w217;
    const double w218 = xi2_1 * E2_2_4_;
    const double w219 = w213 + w218;
    const double w220 = ge1_1 * gE2_2_6_;
    const double w221 = ge1_4 * gE2_2_7_;
    const double w222 = w220 + w221;
    const double w223 = ge1_7 * gE2_2_8_;
    const double E2_2_7_ = w222 + w223;
    const double w224 = xi2_2 * E2_2_7_;
    const double a_3_1_ = w219 + w224;
    const double w225 = 99.0 * a_3_1_;
    const double w226 = p_2_2_ * w225;
    const double w227 = g20 * E2_2_1_;
    const double w228 = g21 * E2_2_4_;
    const double w229 = w227 + w228;
    const double w230 = g22 * E2_2_7_;
    const double Q2_7_ = w229 + w230;
    const double w231 = g20 * E2_2_2_;
    const double w232 = g21 * E2_2_5_;
    const double w233 = w231 + w232;
    const double w234 = g22 * E2_2_8_;
    const double Q2_8_ = w233 + w234;
    const double w235 = -2.0 * Q2_8_;
    const double w236 = 1.5 + w235;
    const double w237 = -0.2 * Q2_7_;
    const double w238 = w236 + w237;
    const double w239 = 1.5 * w238;
    const double w240 = 1.01 + w239;
    const double w241 = sqrt(w240);
    const double w242 = 1.0 / w241;
    const double w243 = w242 * w242;
    const double w244 = 0.5 * w242;
    const double w245 = w243 * w244;
    const double w246 = 1.5 * w245;
    const double w247 = 0.2 * Q2_7_;
    const double w248 = w236 + w247;
    const double w249 = 1.5 * w248;
    const double w250 = 1.01 + w249;
    const double w251 = sqrt(w250);
    const double w252 = 1.0 / w251;
    const double w253 = w252 * w252;
    const double w254 = 0.5 * w252;
    const double w255 = w253 * w254;
    const double w256 = 1.5 * w255;
    const double w257 = w246 - w256;
    const double w258 = -2.0 * w257;
    const double w259 = w258 - 1.0;
    const double w260 = Q2_7_ * w259;
    const double w261 = -0.3 * w245;
    const double w262 = -0.3 * w255;
    const double w263 = w261 + w262;
    const double w264 = Q2_8_ * w263;
    const double w265 = w260 - w264;
    const double Nr2_0_ = w226 + w265;
    const double w266 = w108 * Nr2_0_;
    const double p_2_ = 0.01 * xi1_2;
    const double w267 = 99.0 * xi1_1;
    const double w268 = p_2_ * w267;
    const double xE1_1_0_ = xi1_0 * w1;
    const double w269 = xE1_1_0_ * xE1_1_0_;
    const double xE1_1_1_ = xi1_1 * w1;
    const double w270 = xE1_1_1_ * xE1_1_1_;
    const double w271 = w269 + w270;
    const double xE1_1_2_ = xi1_2 * w1;
    const double w272 = xE1_1_2_ * xE1_1_2_;
    const double w273 = w271 + w272;
    double c1_6, c2_10;
    stumpff_12(w273, &c1_6, &c2_10);
    const double w275 = g22 * xE1_1_0_;
    const double w276 = g20 * xE1_1_2_;
    const double w277 = w275 - w276;
    const double w278 = w277 * c1_6;
    const double w279 = g21 + w278;
    const double w281 = g20 * xE1_1_1_;
    const double w282 = g21 * xE1_1_0_;
    const double w283 = w281 - w282;
    const double w284 = xE1_1_0_ * w283;
    const double w285 = g21 * xE1_1_2_;
    const double w286 = g22 * xE1_1_1_;
    const double w287 = w285 - w286;
    const double w288 = xE1_1_2_ * w287;
    const double w289 = w284 - w288;
    const double w290 = w289 * c2_10;
    const double Q1_7_ = w279 + w290;
    const double w291 = w283 * c1_6;
    const double w292 = g22 + w291;
    const double w293 = xE1_1_1_ * w287;
    const double w294 = xE1_1_0_ * w277;
    const double w295 = w293 - w294;
    const double w296 = w295 * c2_10;
    const double Q1_8_ = w292 + w296;
    const double w297 = -2.0 * Q1_8_;
    const double w298 = 1.5 + w297;
    const double w299 = -0.2 * Q1_7_;
    const double w300 = w298 + w299;
    const double w301 = 1.5 * w300;
    const double w302 = 1.01 + w301;
    const double w303 = sqrt(w302);
    const double w304 = 1.0 / w303;
    const double w305 = w304 * w304;
    const double w306 = 0.5 * w304;
    const double w307 = w305 * w306;
    const double w308 = 1.5 * w307;
    const double w309 = 0.2 * Q1_7_;
    const double w310 = w298 + w309;
    const double w311 = 1.5 * w310;
    const double w312 = 1.01 + w311;
    const double w313 = sqrt(w312);
    const double w314 = 1.0 / w313;
    const double w315 = w314 * w314;
    const double w316 = 0.5 * w314;
    const double w317 = w315 * w316;
    const double w318 = 1.5 * w317;
    const double w319 = w308 - w318;
    const double w320 = -2.0 * w319;
    const double w321 = w320 - 1.0;
    const double w322 = Q1_7_ * w321;
    const double w323 = -0.3 * w307;
    const double w324 = -0.3 * w317;
    const double w325 = w323 + w324;
    const double w326 = Q1_8_ * w325;
    const double w327 = w322 - w326;
    const double Nr1_0_ = w268 + w327;
    const double w328 = ge1_2 * ge2_0;
    const double w329 = ge1_5 * ge2_1;
    const double w330 = w328 + w329;
    const double w331 = ge1_8 * ge2_2;
    const double e2_2 = w330 + w331;
    const double ge2_3 = w163 + w165;
    const double w337 = ge1_2 * ge2_3;
    const double w338 = xe2_0 * w162;
    const double w339 = w159 + w338;
    const double ge2_4 = 1.0 - w339;
    const double w340 = ge1_5 * ge2_4;
    const double w341 = w337 + w340;
    const double w342 = xe2_2 * w156;
    const double w343 = xe2_0 * c1_4;
    const double ge2_5 = w342 - w343;
    const double w344 = ge1_8 * ge2_5;
    const double e2_5 = w341 + w344;
    const double ge2_6 = w169 - w168;
    const double w349 = ge1_2 * ge2_6;
    const double ge2_7 = w342 + w343;
    const double w350 = ge1_5 * ge2_7;
    const double w351 = w349 + w350;
    const double w352 = w157 + w338;
    const double ge2_8 = 1.0 - w352;
    const double w353 = ge1_8 * ge2_8;
    const double e2_8 = w351 + w353;
    const double w359 = ge1_1 * ge2_0;
    const double w360 = ge1_4 * ge2_1;
    const double w361 = w359 + w360;
    const double w362 = ge1_7 * ge2_2;
    const double e2_1 = w361 + w362;
    const double w363 = ge1_1 * ge2_3;
    const double w364 = ge1_4 * ge2_4;
    const double w365 = w363 + w364;
    const double w366 = ge1_7 * ge2_5;
    const double e2_4 = w365 + w366;
    const double w367 = ge1_1 * ge2_6;
    const double w368 = ge1_4 * ge2_7;
    const double w369 = w367 + w368;
    const double w370 = ge1_7 * ge2_8;
    const double e2_7 = w369 + w370;
    const double w378 = ge1_0 * gE2_2_0_;
    const double w379 = ge1_3 * gE2_2_1_;
    const double w380 = w378 + w379;
    const double w381 = ge1_6 * gE2_2_2_;
    const double E2_2_0_ = w380 + w381;
    const double w382 = xi2_0 * E2_2_0_;
    const double w383 = ge1_0 * gE2_2_3_;
    const double w384 = ge1_3 * gE2_2_4_;
    const double w385 = w383 + w384;
    const double w386 = ge1_6 * gE2_2_5_;
    const double E2_2_3_ = w385 + w386;
    const double w387 = xi2_1 * E2_2_3_;
    const double w388 = w382 + w387;
    const double w389 = ge1_0 * gE2_2_6_;
    const double w390 = ge1_3 * gE2_2_7_;
    const double w391 = w389 + w390;
    const double w392 = ge1_6 * gE2_2_8_;
    const double E2_2_6_ = w391 + w392;
    const double w393 = xi2_2 * E2_2_6_;
    const double a_3_0_ = w388 + w393;
    const double w394 = -100.0 * a_3_0_;
    const double w395 = p_2_2_ * w394;
    const double w396 = g20 * E2_2_0_;
    const double w397 = g21 * E2_2_3_;
    const double w398 = w396 + w397;
    const double w399 = g22 * E2_2_6_;
    const double Q2_6_ = w398 + w399;
    const double w400 = w259 * Q2_6_;
    const double Nr2_1_ = w395 - w400;
    const double w401 = w108 * Nr2_1_;
    const double w402 = -100.0 * xi1_0;
    const double w403 = p_2_ * w402;
    const double w404 = w287 * c1_6;
    const double w405 = g20 + w404;
    const double w406 = xE1_1_2_ * w277;
    const double w407 = xE1_1_1_ * w283;
    const double w408 = w406 - w407;
    const double w409 = w408 * c2_10;
    const double Q1_6_ = w405 + w409;
    const double w410 = w321 * Q1_6_;
    const double Nr1_1_ = w403 - w410;
    const double w411 = ge1_0 * ge2_3;
    const double w412 = ge1_3 * ge2_4;
    const double w413 = w411 + w412;
    const double w414 = ge1_6 * ge2_5;
    const double e2_3 = w413 + w414;
    const double w415 = ge1_0 * ge2_6;
    const double w416 = ge1_3 * ge2_7;
    const double w417 = w415 + w416;
    const double w418 = ge1_6 * ge2_8;
    const double e2_6 = w417 + w418;
    const double w419 = 0.01 * a_3_0_;
    const double w420 = a_3_1_ * w419;
    const double w421 = w263 * Q2_6_;
    const double Nr2_2_ = w420 + w421;
    const double w422 = w108 * Nr2_2_;
    const double w423 = 0.01 * xi1_0;
    const double w424 = xi1_1 * w423;
    const double w425 = w325 * Q1_6_;
    const double Nr1_2_ = w424 + w425;
    /* the equations of xi3, n3: Newton's method in xi3_0, xi3_1, xi3_2 */
    double s_m3_5_0_seen, s_m3_5_1_seen, s_m3_5_2_seen, d_xi3_0, d_xi3_1, d_xi3_2;
    double previous_3 = 0.0;
    double rate_3 = memory->known > 0 ? memory->rate_3 : 1.0;
    int make_3 = !memory->made_3;
    for (size_t sweep = 1;; sweep++) {
        const double xE3_3_1 = xi3_1 * w1;
        const double xE3_3_0 = xi3_0 * w1;
        const double xE3_3_2 = xi3_2 * w1;
        const double w332 = xE3_3_0 * xE3_3_0 + xE3_3_1 * xE3_3_1 + xE3_3_2 * xE3_3_2;
        double c1_7, c2_11;
        stumpff_12(w332, &c1_7, &c2_11);
        const double w334 = xE3_3_1 * c2_11;
        const double w335 = xE3_3_1 * w334;
        const double w336 = xE3_3_2 * c2_11 * xE3_3_2;
        const double gE3_3_0 = 1.0 - (w335 + w336);
        const double w345 = xE3_3_0 * c2_11;
        const double w346 = xE3_3_1 * w345;
        const double w348 = xE3_3_2 * c1_7;
        const double gE3_3_1 = w346 - w348;
        const double w354 = xE3_3_1 * c1_7;
        const double w355 = xE3_3_2 * w345;
        const double gE3_3_2 = w354 + w355;
        const double E3_3_2 = e2_2 * gE3_3_0 + e2_5 * gE3_3_1 + e2_8 * gE3_3_2;
        const double gE3_3_3 = w346 + w348;
        const double w356 = xE3_3_0 * w345;
        const double gE3_3_4 = 1.0 - (w336 + w356);
        const double w357 = xE3_3_2 * w334;
        const double w358 = xE3_3_0 * c1_7;
        const double gE3_3_5 = w357 - w358;
        const double E3_3_5 = e2_2 * gE3_3_3 + e2_5 * gE3_3_4 + e2_8 * gE3_3_5;
        const double gE3_3_6 = w355 - w354;
        const double gE3_3_7 = w357 + w358;
        const double gE3_3_8 = 1.0 - (w335 + w356);
        const double E3_3_8 = e2_2 * gE3_3_6 + e2_5 * gE3_3_7 + e2_8 * gE3_3_8;
        const double a_5_2 = xi3_0 * E3_3_2 + xi3_1 * E3_3_5 + xi3_2 * E3_3_8;
        const double p_3_2 = 0.01 * a_5_2;
        const double E3_3_1 = gE3_3_0 * e2_1 + gE3_3_1 * e2_4 + gE3_3_2 * e2_7;
        const double E3_3_4 = gE3_3_3 * e2_1 + gE3_3_4 * e2_4 + gE3_3_5 * e2_7;
        const double E3_3_7 = gE3_3_6 * e2_1 + gE3_3_7 * e2_4 + gE3_3_8 * e2_7;
        const double a_5_1 = xi3_0 * E3_3_1 + xi3_1 * E3_3_4 + xi3_2 * E3_3_7;
        const double Q3_7 = g20 * E3_3_1 + g21 * E3_3_4 + g22 * E3_3_7;
        const double Q3_8 = g20 * E3_3_2 + g21 * E3_3_5 + g22 * E3_3_8;
        const double w371 = 1.5 - 2.0 * Q3_8;
        const double w372 = 1.0 / sqrt(1.01 + 1.5 * (w371 - 0.2 * Q3_7));
        const double w373 = w372 * w372 * (0.5 * w372);
        const double w374 = 1.0 / sqrt(1.01 + 1.5 * (w371 + 0.2 * Q3_7));
        const double w375 = w374 * w374 * (0.5 * w374);
        const double w376 = -1.0 - 2.0 * (1.5 * w373 - 1.5 * w375);
        const double w377 = -0.3 * w373 - 0.3 * w375;
        const double Nr3_0 = Q3_7 * w376 - Q3_8 * w377 + 99.0 * a_5_1 * p_3_2;
        const double s_m3_5_0 = m_0 + w15 * (Nr1_0_ + Nr3_0) + w266;
        const double E3_3_0 = e2_0 * gE3_3_0 + gE3_3_1 * e2_3 + gE3_3_2 * e2_6;
        const double E3_3_3 = e2_0 * gE3_3_3 + gE3_3_4 * e2_3 + gE3_3_5 * e2_6;
        const double E3_3_6 = e2_0 * gE3_3_6 + gE3_3_7 * e2_3 + gE3_3_8 * e2_6;
        const double a_5_0 = xi3_0 * E3_3_0 + xi3_1 * E3_3_3 + xi3_2 * E3_3_6;
        const double Q3_6 = g20 * E3_3_0 + g21 * E3_3_3 + g22 * E3_3_6;
        const double Nr3_1 = -100.0 * a_5_0 * p_3_2 - w376 * Q3_6;
        const double s_m3_5_1 = m_1 + w15 * (Nr1_1_ + Nr3_1) + w401;
        const double Nr3_2 = 0.01 * a_5_0 * a_5_1 + w377 * Q3_6;
        const double s_m3_5_2 = m_2 + w15 * (Nr1_2_ + Nr3_2) + w422;
        const double m3_5_2_0 = e2_0 * s_m3_5_0 + e2_1 * s_m3_5_1 + e2_2 * s_m3_5_2;
        const double y3_0 = xi3_0 * w16;
        const double y3_1 = xi3_1 * w16;
        const double y3_2 = xi3_2 * w16;
        const double w426 = y3_0 * y3_0 + y3_1 * y3_1 + y3_2 * y3_2;
        double c2_12, c3_5;
        stumpff_23(w426, &c2_12, &c3_5);
        const double m3_5_2_2 = e2_7 * s_m3_5_1 + s_m3_5_0 * e2_6 + e2_8 * s_m3_5_2;
        const double m3_5_2_1 = e2_4 * s_m3_5_1 + s_m3_5_0 * e2_3 + e2_5 * s_m3_5_2;
        const double w428 = y3_1 * m3_5_2_2 - y3_2 * m3_5_2_1;
        const double w430 = y3_0 * m3_5_2_1 - m3_5_2_0 * y3_1;
        const double w431 = m3_5_2_0 * y3_2 - y3_0 * m3_5_2_2;
        const double p3_6_0 = m3_5_2_0 - w428 * c2_12 + (y3_1 * w430 - y3_2 * w431) * c3_5;
        const double m3_4_0 = e2_0 * Nr3_0 + e2_1 * Nr3_1 + e2_2 * Nr3_2;
        const double y3_2_0 = xi3_0 * w23;
        const double y3_2_1 = xi3_1 * w23;
        const double y3_2_2 = xi3_2 * w23;
        const double w432 = y3_2_0 * y3_2_0 + y3_2_1 * y3_2_1 + y3_2_2 * y3_2_2;
        double c2_13, c3_6;
        stumpff_23(w432, &c2_13, &c3_6);
        const double m3_4_2 = e2_7 * Nr3_1 + Nr3_0 * e2_6 + e2_8 * Nr3_2;
        const double m3_4_1 = e2_4 * Nr3_1 + Nr3_0 * e2_3 + e2_5 * Nr3_2;
        const double w434 = y3_2_1 * m3_4_2 - y3_2_2 * m3_4_1;
        const double w436 = y3_2_0 * m3_4_1 - m3_4_0 * y3_2_1;
        const double w437 = m3_4_0 * y3_2_2 - y3_2_0 * m3_4_2;
        const double M3_0 = p3_6_0
            + w23 * (m3_4_0 - w434 * c2_13 + (y3_2_1 * w436 - y3_2_2 * w437) * c3_6);
        const double p_3_0 = 1.01 * a_5_0;
        const double a_8_0 = E3_3_0 * p_3_0 + E3_3_1 * a_5_1 + E3_3_2 * p_3_2;
        const double residual_3_0 = M3_0 - a_8_0;
        const double p3_6_1 = m3_5_2_1 - w431 * c2_12 + (y3_2 * w428 - y3_0 * w430) * c3_5;
        const double M3_1 = p3_6_1
            + w23 * (m3_4_1 - w437 * c2_13 + (y3_2_2 * w434 - y3_2_0 * w436) * c3_6);
        const double a_8_1 = E3_3_3 * p_3_0 + E3_3_4 * a_5_1 + E3_3_5 * p_3_2;
        const double residual_3_1 = M3_1 - a_8_1;
        const double p3_6_2 = m3_5_2_2 - w430 * c2_12 + (y3_0 * w431 - y3_1 * w428) * c3_5;
        const double M3_2 = p3_6_2
            + w23 * (m3_4_2 - w436 * c2_13 + (y3_2_0 * w437 - y3_2_1 * w434) * c3_6);
        const double a_8_2 = E3_3_6 * p_3_0 + E3_3_7 * a_5_1 + E3_3_8 * p_3_2;
        const double residual_3_2 = M3_2 - a_8_2;
        s_m3_5_0_seen = s_m3_5_0;
        s_m3_5_1_seen = s_m3_5_1;
        s_m3_5_2_seen = s_m3_5_2;
        if (make_3) {
            const double w438 = 1.6853902400801222 * xi2_0;
            const double w439 = 0.6756035959798288 * g00 * mu0 + 0.6756035959798288 * g10 * mu1
                + 0.6756035959798288 * g20 * mu2;
            const double w440 = -1.337695120040061 * xi1_0;
            const double w441 = h * (w439 + w440 + w438 - 1.3512071919596575 * xi3_0);
            const double w442 = -0.6756035959798288 * g00 * mu0 - 0.6756035959798288 * g10 * mu1
                - 0.6756035959798288 * g20 * mu2;
            const double w443 = h * (w440 + w442 + w438 + 0.013512071919596576 * xi3_0);
            const double w444 = 0.01 - w441 * w443;
            const double w445 = 0.01702414383919315 * xi2_2;
            const double w446 = 0.6756035959798288 * g02 * mu0 + 0.6756035959798288 * g12 * mu1
                + 0.6756035959798288 * g22 * mu2;
            const double w447 = -0.013512071919596576 * xi1_2;
            const double w448 = h * (w446 + w447 + w445 + 1.337695120040061 * xi3_2);
            const double w449 = -1.7024143839193153 * xi2_1;
            const double w450 = 0.6756035959798288 * g01 * mu0 + 0.6756035959798288 * g11 * mu1
                + 0.6756035959798288 * g21 * mu2;
            const double w451 = 1.3512071919596575 * xi1_1;
            const double w452 = h * (w450 + w451 + w449 + 0.013512071919596576 * xi3_1);
            const double w453 = -0.6756035959798288 * g02 * mu0 - 0.6756035959798288 * g12 * mu1
                - 0.6756035959798288 * g22 * mu2;
            const double w454 = h * (w447 + w453 + w445 - 1.3512071919596575 * xi3_2);
            const double w455 = w441 * w452 + 0.01 * w454;
            const double w456 = -0.6756035959798288 * g01 * mu0 - 0.6756035959798288 * g11 * mu1
                - 0.6756035959798288 * g21 * mu2;
            const double w457 = h * (w451 + w456 + w449 + 1.337695120040061 * xi3_1);
            const double w458 = w452 + w443 * w454;
            const double w459 = 1.0 / (1.01 * w444 - w448 * w455 - w457 * w458);
            memory->inverse_3[0] = w444 * w459;
            memory->inverse_3[1] = w459 * (w443 * w457 + 0.01 * w448);
            memory->inverse_3[2] = w459 * (w457 + w441 * w448);
            memory->inverse_3[3] = w455 * w459;
            memory->inverse_3[4] = w459 * (0.0101 - w452 * w457);
            memory->inverse_3[5] = w459 * (w454 * w457 + 1.01 * w441);
            memory->inverse_3[6] = w458 * w459;
            memory->inverse_3[7] = w459 * (w448 * w452 + 1.01 * w443);
            memory->inverse_3[8] = w459 * (1.01 - w448 * w454);
            memory->made_3 = 1;
            count_matrix(statistics);
        }
        d_xi3_0 = (memory->inverse_3[0] * residual_3_0 + memory->inverse_3[1] * residual_3_1)
            + memory->inverse_3[2] * residual_3_2;
        d_xi3_1 = (memory->inverse_3[3] * residual_3_0 + memory->inverse_3[4] * residual_3_1)
            + memory->inverse_3[5] * residual_3_2;
        d_xi3_2 = (memory->inverse_3[6] * residual_3_0 + memory->inverse_3[7] * residual_3_1)
            + memory->inverse_3[8] * residual_3_2;
        const double change = (fabs(d_xi3_0) + fabs(d_xi3_1)) + fabs(d_xi3_2);
        if (!isfinite(change)) {
            count_sweeps(statistics, 2, sweep, 1);
            return DIPOLE_VCG_TRIPLE_JUMP_NOT_FINITE;
        }
        const double scale = (1.0 + fabs(xi3_0)) + (fabs(xi3_1) + fabs(xi3_2));
        xi3_0 += d_xi3_0;
        xi3_1 += d_xi3_1;
        xi3_2 += d_xi3_2;
        if (previous_3 > 0.0) {
            rate_3 = change / previous_3;
        } else {
            memory->first += change;
        }
        const int contracts = rate_3 < 0.5;
        if (contracts ? change * (rate_3 + 0.0009765625) <= 2.220446049250313e-16 * scale
                      : previous_3 > 0.0 && change <= 5.684341886080802e-14 * scale) {
            memory->rate_3 = rate_3;
            count_sweeps(statistics, 2, sweep, 0);
            break;
        }
        if (sweep == 100) {
            count_sweeps(statistics, 2, sweep, 1);
            return DIPOLE_VCG_TRIPLE_JUMP_NOT_CONVERGED;
        }
        make_3 = 0;
        previous_3 = change;
    }
    const double xe3_1 = xi3_1 * w15;
    const double xe3_0 = xi3_0 * w15;
    const double xe3_2 = xi3_2 * w15;
    const double w460 = xe3_0 * xe3_0 + xe3_1 * xe3_1 + xe3_2 * xe3_2;
    double c1_8, c2_14;
    stumpff_12(w460, &c1_8, &c2_14);
    const double w462 = xe3_1 * c2_14;
    const double w463 = xe3_1 * w462;
    const double w464 = xe3_2 * c2_14 * xe3_2;
    const double ge3_0 = 1.0 - (w463 + w464);
    const double w465 = xe3_0 * c2_14;
    const double w466 = xe3_1 * w465;
    const double w468 = xe3_2 * c1_8;
    const double ge3_1 = w466 - w468;
    const double w469 = xe3_1 * c1_8;
    const double w470 = xe3_2 * w465;
    const double ge3_2 = w469 + w470;
    const double e3_0 = e2_0 * ge3_0 + e2_3 * ge3_1 + e2_6 * ge3_2;
    const double ge3_3 = w466 + w468;
    const double w471 = xe3_0 * w465;
    const double ge3_4 = 1.0 - (w464 + w471);
    const double w472 = xe3_2 * w462;
    const double w473 = xe3_0 * c1_8;
    const double ge3_5 = w472 - w473;
    const double e3_3 = e2_0 * ge3_3 + e2_3 * ge3_4 + e2_6 * ge3_5;
    const double ge3_6 = w470 - w469;
    const double ge3_7 = w472 + w473;
    const double ge3_8 = 1.0 - (w463 + w471);
    const double e3_6 = e2_0 * ge3_6 + e2_3 * ge3_7 + e2_6 * ge3_8;
    const double e3_1 = e2_1 * ge3_0 + e2_4 * ge3_1 + e2_7 * ge3_2;
    const double e3_4 = e2_1 * ge3_3 + e2_4 * ge3_4 + e2_7 * ge3_5;
    const double e3_7 = e2_1 * ge3_6 + e2_4 * ge3_7 + e2_7 * ge3_8;
    const double e3_2 = e2_2 * ge3_0 + e2_5 * ge3_1 + e2_8 * ge3_2;
    const double e3_5 = e2_2 * ge3_3 + e2_5 * ge3_4 + e2_8 * ge3_5;
    const double e3_8 = e2_2 * ge3_6 + e2_5 * ge3_7 + e2_8 * ge3_8;
    const double w474 = s_m3_5_0_seen + xi3_2 * w68 * d_xi3_1 + xi3_1 * w68 * d_xi3_2;
    const double y3_2_ = xi3_2 * w16;
    const double y3_0_ = xi3_0 * w16;
    const double w475 = s_m3_5_1_seen + d_xi3_0 * y3_2_ + d_xi3_2 * y3_0_;
    const double w476 = s_m3_5_2_seen + xi3_1 * w115 * d_xi3_0 + xi3_0 * w115 * d_xi3_1;
    const double change_0 = e3_0 * w474 + e3_1 * w475 + e3_2 * w476 - m_0;
    const double change_1 = e3_3 * w474 + e3_4 * w475 + e3_5 * w476 - m_1;
    const double change_2 = e3_6 * w474 + e3_7 * w475 + e3_8 * w476 - m_2;
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
    const double solution[9] = {xi1_0, xi1_1, xi1_2, xi2_0, xi2_1, xi2_2, xi3_0, xi3_1, xi3_2};
    remember(memory, solution);
    memory->made_1 = 0;
    memory->made_2 = 0;
    memory->made_3 = 0;
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
