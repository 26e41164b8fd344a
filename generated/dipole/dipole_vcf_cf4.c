/*
 * Dipole on a stick, T*SO(3) (thesis section 3.6): one step by vcf:cf4
 *
 * method:     family vcf, tableau cf4
 * source:     Celledoni, Marthinsen and Owren 2003; H. Marthinsen, thesis, Section 2.2.1
 * order:      4, certificate: exact (every order condition up to it is zero in exact arithmetic)
 * scene:      Dipole on a stick, T*SO(3) (thesis section 3.6), group SO(3)
 * solved by:  the equations of xi1, xi2, xi3, xi4, n1, n2, n3, n4: Newton's method, 12 unknowns
 *             (2.5 sweeps of 1304 operations and 0.05 matrices of 3910 a step; fixed point: 3.0
 *             sweeps of 1065 operations; Newton's method with the matrix to first order in h: 2.3
 *             sweeps of 1341 operations and 1.00 matrices of 3992)
 * state:      [0..8] q: element of SO(3), row by row
 *             [9..11] mu: right-trivialised momentum in the dual algebra of SO(3)
 * left out:   1 Adt, 23 Adtinv, 5 mul (zeros)
 *             16 Adtinv, 31 dexpt, 1 exp, 4 identity, 2 lin (sharing)
 *             1 identity (dead code)
 *             1 dexpt (factors)
 *             4 Adtinv, 8 dexpt (common sums)
 *             1 lin (cancellation)
 *             1 lin (sharing)
 *             5 hamilton (body frame)
 *             3 Adt (opposites)
 *             6 Adtinv, 1 force (dead code)
 *             1 lin (sharing)
 *             5 dexpt (functions)
 *             3 Adinv, 4 legendre (sharing)
 *             parameters, folded: beta = 1, depth = 3/2
 *             the time: the scene does not depend on it
 * operations: 136 add, 208 mul, 2 sqrt, 2 div, 2 stumpff_12 a step
 *             2 mul a start, in steps that follow no other
 *             150 add, 304 mul a matrix of the equations of xi1, xi2, xi3, xi4, n1, n2, n3, n4
 *             453 add, 602 mul, 6 div, 6 sqrt, 4 stumpff_12, 5 stumpff_23 a sweep of the equations
 *             of xi1, xi2, xi3, xi4, n1, n2, n3, n4
 * stack:      at most 8704 bytes, without what the mathematical library takes
 * made by:    orderconds emit dipole --method vcf:cf4 --target c -o .
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

/* Replace an n x n matrix, by rows, by its inverse (Gauss-Jordan, rows exchanged); return 0 where it has none. */
static int invert(size_t n, double *a, size_t *order)
{
    for (size_t k = 0; k < n; k++) {
        size_t pivot = k;
        for (size_t i = k + 1; i < n; i++) {
            if (fabs(a[i * n + k]) > fabs(a[pivot * n + k])) {
                pivot = i;
            }
        }
        if (!(fabs(a[pivot * n + k]) > 0.0)) {
            return 0;
        }
        order[k] = pivot;
        for (size_t j = 0; pivot != k && j < n; j++) {
            const double kept = a[k * n + j];
            a[k * n + j] = a[pivot * n + j];
            a[pivot * n + j] = kept;
        }
        const double factor = 1.0 / a[k * n + k];
        a[k * n + k] = 1.0;
        for (size_t j = 0; j < n; j++) {
            a[k * n + j] *= factor;
        }
        for (size_t i = 0; i < n; i++) {
            if (i != k) {
                const double multiple = a[i * n + k];
                a[i * n + k] = 0.0;
                for (size_t j = 0; j < n; j++) {
                    a[i * n + j] -= multiple * a[k * n + j];
                }
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

static inline double greater(double a, double b)
{
    return a > b ? a : b;
}

static void count_sweeps(dipole_vcf_cf4_statistics *statistics, size_t block, size_t sweeps, int failed)
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

static void count_matrix(dipole_vcf_cf4_statistics *statistics)
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
    double guess[12];
    double differences[12][14];
    double rate_1;
    int made_1;
    double inverse_1[144];
};

/* The size of a backward difference. */
static inline double size_of(const struct memory *memory, size_t k)
{
    double size = 0.0;
    for (size_t i = 0; i < 12; i++) {
        size += fabs(memory->differences[i][k]);
    }
    return size;
}

/* Take up a solution and guess the next: the polynomial through the last ones, continued by a step. */
static inline void remember(struct memory *memory, const double solution[static 12])
{
    if (memory->known > 1) {
        double moved = 0.0;
        for (size_t i = 0; i < 12; i++) {
            moved += fabs(solution[i] - memory->differences[i][0]);
        }
        if (memory->first > 0.5 * moved) {
            memory->known = memory->degree = 0;
        }
    }
    memory->first = 0.0;
    const size_t last = memory->known < 14 ? memory->known : 13, k = memory->degree;
    for (size_t i = 0; i < 12; i++) {
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
    dipole_vcf_cf4_statistics *statistics)
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
    const double m_0 = g00 * mu0 + g10 * mu1 + g20 * mu2;
    const double m_1 = g01 * mu0 + g11 * mu1 + g21 * mu2;
    const double m_2 = g02 * mu0 + g12 * mu1 + g22 * mu2;
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
        xi4_0 = Wxi0_0;
        xi4_1 = m_1;
        xi4_2 = Wxi0_2;
    }
    const double w1 = -0.5 * h;
    const double w2 = 0.5 * h;
    const double w60 = 0.16666666666666666 * h;
    const double w61 = -2.0 * g22;
    const double w62 = 1.5 + w61;
    const double w63 = -0.2 * g21;
    const double w64 = w62 + w63;
    const double w65 = 1.5 * w64;
    const double w66 = 1.01 + w65;
    const double w67 = sqrt(w66);
    const double w68 = 1.0 / w67;
    const double w69 = w68 * w68;
    const double w70 = 0.5 * w68;
    const double w71 = w69 * w70;
    const double w72 = 1.5 * w71;
    const double w73 = 0.2 * g21;
    const double w74 = w62 + w73;
    const double w75 = 1.5 * w74;
    const double w76 = 1.01 + w75;
    const double w77 = sqrt(w76);
    const double w78 = 1.0 / w77;
    const double w79 = w78 * w78;
    const double w80 = 0.5 * w78;
    const double w81 = w79 * w80;
    const double w82 = 1.5 * w81;
    const double w83 = w72 - w82;
    const double w84 = -2.0 * w83;
    const double w85 = w84 - 1.0;
    const double w86 = g21 * w85;
    const double w87 = -0.3 * w71;
    const double w88 = -0.3 * w81;
    const double w89 = w87 + w88;
    const double w90 = g22 * w89;
    const double w91 = w86 - w90;
    const double w113 = 0.3333333333333333 * h;
    const double w114 = -0.25 * h;
    const double w116 = -0.16666666666666666 * h;
    const double w118 = 0.08333333333333333 * h;
    const double w125 = g20 * w89;
    const double w126 = g20 * w85;
    const double w131 = 0.25 * h;
    const double w133 = -0.08333333333333333 * h;
    /* the equations of xi1, xi2, xi3, xi4, n1, n2, n3, n4: Newton's method in xi1_0, xi1_1, xi1_2, xi2_0, xi2_1, xi2_2, xi3_0, xi3_1, xi3_2, xi4_0, xi4_1, xi4_2 */
    double s_p1_0_seen, s_p1_1_seen, s_p1_2_seen, d_xi1_0, d_xi1_1, d_xi1_2, d_xi2_0, d_xi2_1,
        d_xi2_2, d_xi3_0, d_xi3_1, d_xi3_2, d_xi4_0, d_xi4_1, d_xi4_2;
    double previous_1 = 0.0;
    double rate_1 = memory->known > 0 ? memory->rate_1 : 1.0;
    int make_1 = !memory->made_1;
    for (size_t sweep = 1;; sweep++) {
        const double xE2_1_1 = xi1_1 * w2;
        const double xE2_1_0 = xi1_0 * w2;
        const double xE2_1_2 = xi1_2 * w2;
        const double w3 = xE2_1_0 * xE2_1_0 + xE2_1_1 * xE2_1_1 + xE2_1_2 * xE2_1_2;
        double c1_1, c2_1;
        stumpff_12(w3, &c1_1, &c2_1);
        const double w5 = xE2_1_1 * c1_1;
        const double w7 = xE2_1_0 * c2_1;
        const double w8 = xE2_1_2 * w7;
        const double gE2_1_2 = w5 + w8;
        const double yE2_1_1 = xi1_1 * w1;
        const double w9 = h * xi3_1;
        const double xE4_2_1 = yE2_1_1 + w9;
        const double yE2_1_0 = xi1_0 * w1;
        const double w10 = h * xi3_0;
        const double xE4_2_0 = yE2_1_0 + w10;
        const double yE2_1_2 = xi1_2 * w1;
        const double w11 = h * xi3_2;
        const double xE4_2_2 = yE2_1_2 + w11;
        const double w12 = xE4_2_0 * xE4_2_0 + xE4_2_1 * xE4_2_1 + xE4_2_2 * xE4_2_2;
        double c1_2, c2_2;
        stumpff_12(w12, &c1_2, &c2_2);
        const double w14 = xE4_2_1 * c2_2;
        const double w15 = xE4_2_1 * w14;
        const double w16 = xE4_2_2 * c2_2 * xE4_2_2;
        const double gE4_2_0 = 1.0 - (w15 + w16);
        const double w17 = xE2_1_1 * c2_1;
        const double w18 = xE2_1_2 * w17;
        const double w19 = xE2_1_0 * c1_1;
        const double gE2_1_5 = w18 - w19;
        const double w20 = xE4_2_0 * c2_2;
        const double w21 = xE4_2_1 * w20;
        const double w23 = xE4_2_2 * c1_2;
        const double gE4_2_1 = w21 - w23;
        const double w24 = xE2_1_0 * w7;
        const double w25 = xE2_1_1 * w17;
        const double gE2_1_8 = 1.0 - (w24 + w25);
        const double w26 = xE4_2_1 * c1_2;
        const double w27 = xE4_2_2 * w20;
        const double gE4_2_2 = w26 + w27;
        const double E4_2_2 = gE2_1_2 * gE4_2_0 + gE2_1_5 * gE4_2_1 + gE2_1_8 * gE4_2_2;
        const double gE4_2_3 = w21 + w23;
        const double w28 = xE4_2_0 * w20;
        const double gE4_2_4 = 1.0 - (w16 + w28);
        const double w29 = xE4_2_2 * w14;
        const double w30 = xE4_2_0 * c1_2;
        const double gE4_2_5 = w29 - w30;
        const double E4_2_5 = gE2_1_2 * gE4_2_3 + gE2_1_5 * gE4_2_4 + gE2_1_8 * gE4_2_5;
        const double gE4_2_6 = w27 - w26;
        const double gE4_2_7 = w29 + w30;
        const double gE4_2_8 = 1.0 - (w15 + w28);
        const double E4_2_8 = gE2_1_2 * gE4_2_6 + gE2_1_5 * gE4_2_7 + gE2_1_8 * gE4_2_8;
        const double a_5_2 = xi4_0 * E4_2_2 + xi4_1 * E4_2_5 + xi4_2 * E4_2_8;
        const double p_4_2 = 0.01 * a_5_2;
        const double w31 = xE2_1_1 * w7;
        const double w32 = xE2_1_2 * c1_1;
        const double gE2_1_1 = w31 - w32;
        const double w33 = xE2_1_2 * c2_1 * xE2_1_2;
        const double gE2_1_4 = 1.0 - (w24 + w33);
        const double gE2_1_7 = w18 + w19;
        const double E4_2_1 = gE4_2_0 * gE2_1_1 + gE4_2_1 * gE2_1_4 + gE4_2_2 * gE2_1_7;
        const double E4_2_4 = gE4_2_3 * gE2_1_1 + gE4_2_4 * gE2_1_4 + gE4_2_5 * gE2_1_7;
        const double E4_2_7 = gE4_2_6 * gE2_1_1 + gE4_2_7 * gE2_1_4 + gE4_2_8 * gE2_1_7;
        const double a_5_1 = xi4_0 * E4_2_1 + xi4_1 * E4_2_4 + xi4_2 * E4_2_7;
        const double Q4_7 = g20 * E4_2_1 + g21 * E4_2_4 + g22 * E4_2_7;
        const double Q4_8 = g20 * E4_2_2 + g21 * E4_2_5 + g22 * E4_2_8;
        const double w34 = 1.5 - 2.0 * Q4_8;
        const double w35 = 1.0 / sqrt(1.01 + 1.5 * (w34 - 0.2 * Q4_7));
        const double w36 = w35 * w35 * (0.5 * w35);
        const double w37 = 1.0 / sqrt(1.01 + 1.5 * (w34 + 0.2 * Q4_7));
        const double w38 = w37 * w37 * (0.5 * w37);
        const double w39 = -1.0 - 2.0 * (1.5 * w36 - 1.5 * w38);
        const double w40 = -0.3 * w36 - 0.3 * w38;
        const double Nr4_0 = Q4_7 * w39 - Q4_8 * w40 + 99.0 * a_5_1 * p_4_2;
        const double p_2_2 = 0.01 * (xi2_0 * gE2_1_2 + xi2_1 * gE2_1_5 + xi2_2 * gE2_1_8);
        const double a_1 = xi2_0 * gE2_1_1 + xi2_1 * gE2_1_4 + xi2_2 * gE2_1_7;
        const double Q2_7 = g20 * gE2_1_1 + g21 * gE2_1_4 + g22 * gE2_1_7;
        const double Q2_8 = g20 * gE2_1_2 + g21 * gE2_1_5 + g22 * gE2_1_8;
        const double w41 = 1.5 - 2.0 * Q2_8;
        const double w42 = 1.0 / sqrt(1.01 + 1.5 * (w41 - 0.2 * Q2_7));
        const double w43 = w42 * w42 * (0.5 * w42);
        const double w44 = 1.0 / sqrt(1.01 + 1.5 * (w41 + 0.2 * Q2_7));
        const double w45 = w44 * w44 * (0.5 * w44);
        const double w46 = -1.0 - 2.0 * (1.5 * w43 - 1.5 * w45);
        const double w47 = -0.3 * w43 - 0.3 * w45;
        const double sum_Nr4_0 = Nr4_0 + 2.0 * (Q2_7 * w46 - Q2_8 * w47 + 99.0 * a_1 * p_2_2);
        const double s_nu2_0 = w1 * sum_Nr4_0;
        const double w48 = yE2_1_0 * yE2_1_0 + yE2_1_1 * yE2_1_1 + yE2_1_2 * yE2_1_2;
        double c2_3, c3_1;
        stumpff_23(w48, &c2_3, &c3_1);
        const double gE2_1_0 = 1.0 - (w25 + w33);
        const double gE2_1_3 = w31 + w32;
        const double gE2_1_6 = w8 - w5;
        const double E4_2_0 = gE4_2_0 * gE2_1_0 + gE4_2_1 * gE2_1_3 + gE4_2_2 * gE2_1_6;
        const double E4_2_3 = gE4_2_3 * gE2_1_0 + gE4_2_4 * gE2_1_3 + gE4_2_5 * gE2_1_6;
        const double E4_2_6 = gE4_2_6 * gE2_1_0 + gE4_2_7 * gE2_1_3 + gE4_2_8 * gE2_1_6;
        const double a_5_0 = xi4_0 * E4_2_0 + xi4_1 * E4_2_3 + xi4_2 * E4_2_6;
        const double Q4_6 = g20 * E4_2_0 + g21 * E4_2_3 + g22 * E4_2_6;
        const double Nr4_2 = 0.01 * a_5_0 * a_5_1 + w40 * Q4_6;
        const double a_0 = xi2_0 * gE2_1_0 + xi2_1 * gE2_1_3 + xi2_2 * gE2_1_6;
        const double Q2_6 = g20 * gE2_1_0 + g21 * gE2_1_3 + g22 * gE2_1_6;
        const double sum_Nr4_2 = Nr4_2 + 2.0 * (0.01 * a_0 * a_1 + w47 * Q2_6);
        const double s_nu2_2 = w1 * sum_Nr4_2;
        const double Nr4_1 = -100.0 * a_5_0 * p_4_2 - w39 * Q4_6;
        const double sum_Nr4_1 = Nr4_1 + 2.0 * (-100.0 * a_0 * p_2_2 - w46 * Q2_6);
        const double s_nu2_1 = w1 * sum_Nr4_1;
        const double w50 = yE2_1_1 * s_nu2_2 - yE2_1_2 * s_nu2_1;
        const double w52 = yE2_1_0 * s_nu2_1 - yE2_1_1 * s_nu2_0;
        const double w53 = yE2_1_2 * s_nu2_0 - yE2_1_0 * s_nu2_2;
        const double p1_11_2_0 = s_nu2_0 - w50 * c2_3 + (yE2_1_1 * w52 - yE2_1_2 * w53) * c3_1;
        const double m1_13_0 = gE2_1_1 * Nr4_1 + Nr4_0 * gE2_1_0 + gE2_1_2 * Nr4_2;
        const double yE4_2_0 = xE2_1_0 - w10;
        const double yE4_2_1 = xE2_1_1 - w9;
        const double yE4_2_2 = xE2_1_2 - w11;
        const double w54 = yE4_2_0 * yE4_2_0 + yE4_2_1 * yE4_2_1 + yE4_2_2 * yE4_2_2;
        double c2_4, c3_2;
        stumpff_23(w54, &c2_4, &c3_2);
        const double m1_13_2 = gE2_1_7 * Nr4_1 + Nr4_0 * gE2_1_6 + gE2_1_8 * Nr4_2;
        const double m1_13_1 = gE2_1_4 * Nr4_1 + Nr4_0 * gE2_1_3 + gE2_1_5 * Nr4_2;
        const double w56 = yE4_2_1 * m1_13_2 - yE4_2_2 * m1_13_1;
        const double w58 = yE4_2_0 * m1_13_1 - m1_13_0 * yE4_2_1;
        const double w59 = m1_13_0 * yE4_2_2 - yE4_2_0 * m1_13_2;
        const double p1_13_0 = m1_13_0 - w56 * c2_4 + (yE4_2_1 * w58 - yE4_2_2 * w59) * c3_2;
        const double p_2 = 0.01 * xi1_2;
        const double Nr1_0 = w91 + 99.0 * xi1_1 * p_2;
        const double xE3_1_1 = xi2_1 * w2;
        const double xE3_1_0 = xi2_0 * w2;
        const double xE3_1_2 = xi2_2 * w2;
        const double w92 = xE3_1_0 * xE3_1_0 + xE3_1_1 * xE3_1_1 + xE3_1_2 * xE3_1_2;
        double c1_3, c2_5;
        stumpff_12(w92, &c1_3, &c2_5);
        const double w94 = xE3_1_1 * c1_3;
        const double w96 = xE3_1_0 * c2_5;
        const double w97 = xE3_1_2 * w96;
        const double gE3_1_2 = w94 + w97;
        const double w98 = xE3_1_1 * c2_5;
        const double w99 = xE3_1_2 * w98;
        const double w100 = xE3_1_0 * c1_3;
        const double gE3_1_5 = w99 - w100;
        const double w101 = xE3_1_0 * w96;
        const double w102 = xE3_1_1 * w98;
        const double gE3_1_8 = 1.0 - (w101 + w102);
        const double p_3_2 = 0.01 * (xi3_0 * gE3_1_2 + xi3_1 * gE3_1_5 + xi3_2 * gE3_1_8);
        const double w103 = xE3_1_1 * w96;
        const double w104 = xE3_1_2 * c1_3;
        const double gE3_1_1 = w103 - w104;
        const double w105 = xE3_1_2 * c2_5 * xE3_1_2;
        const double gE3_1_4 = 1.0 - (w101 + w105);
        const double gE3_1_7 = w99 + w100;
        const double a_3_1 = xi3_0 * gE3_1_1 + xi3_1 * gE3_1_4 + xi3_2 * gE3_1_7;
        const double Q3_7 = g20 * gE3_1_1 + g21 * gE3_1_4 + g22 * gE3_1_7;
        const double Q3_8 = g20 * gE3_1_2 + g21 * gE3_1_5 + g22 * gE3_1_8;
        const double w106 = 1.5 - 2.0 * Q3_8;
        const double w107 = 1.0 / sqrt(1.01 + 1.5 * (w106 - 0.2 * Q3_7));
        const double w108 = w107 * w107 * (0.5 * w107);
        const double w109 = 1.0 / sqrt(1.01 + 1.5 * (w106 + 0.2 * Q3_7));
        const double w110 = w109 * w109 * (0.5 * w109);
        const double w111 = -1.0 - 2.0 * (1.5 * w108 - 1.5 * w110);
        const double w112 = -0.3 * w108 - 0.3 * w110;
        const double Nr3_0 = Q3_7 * w111 - Q3_8 * w112 + 99.0 * a_3_1 * p_3_2;
        const double s_p1_0 = m_0 + w60 * (sum_Nr4_0 + Nr1_0) + Nr3_0 * w113;
        const double w115 = xi2_0 + xi3_0;
        const double w117 = w115 * w116;
        const double ye1_0 = xi1_0 * w114 + w117 + xi4_0 * w118;
        const double w119 = xi2_1 + xi3_1;
        const double w120 = w116 * w119;
        const double ye1_1 = xi1_1 * w114 + w120 + xi4_1 * w118;
        const double w121 = xi2_2 + xi3_2;
        const double w122 = w116 * w121;
        const double ye1_2 = xi1_2 * w114 + w122 + xi4_2 * w118;
        const double w123 = ye1_0 * ye1_0 + ye1_1 * ye1_1 + ye1_2 * ye1_2;
        double c2_6, c3_3;
        stumpff_23(w123, &c2_6, &c3_3);
        const double Nr1_2 = 0.01 * xi1_0 * xi1_1 + w125;
        const double gE3_1_0 = 1.0 - (w102 + w105);
        const double gE3_1_3 = w103 + w104;
        const double gE3_1_6 = w97 - w94;
        const double a_3_0 = xi3_0 * gE3_1_0 + xi3_1 * gE3_1_3 + xi3_2 * gE3_1_6;
        const double Q3_6 = g20 * gE3_1_0 + g21 * gE3_1_3 + g22 * gE3_1_6;
        const double Nr3_2 = 0.01 * a_3_0 * a_3_1 + w112 * Q3_6;
        const double s_p1_2 = m_2 + w60 * (sum_Nr4_2 + Nr1_2) + w113 * Nr3_2;
        const double Nr1_1 = -100.0 * xi1_0 * p_2 - w126;
        const double Nr3_1 = -100.0 * a_3_0 * p_3_2 - w111 * Q3_6;
        const double s_p1_1 = m_1 + w60 * (sum_Nr4_1 + Nr1_1) + w113 * Nr3_1;
        const double w127 = ye1_1 * s_p1_2 - ye1_2 * s_p1_1;
        const double w129 = ye1_0 * s_p1_1 - s_p1_0 * ye1_1;
        const double w130 = s_p1_0 * ye1_2 - ye1_0 * s_p1_2;
        const double p1_11_0 = s_p1_0 - w127 * c2_6 + (ye1_1 * w129 - ye1_2 * w130) * c3_3;
        const double w132 = w60 * w119;
        const double xe1_1 = xi1_1 * w131 + w132 + xi4_1 * w133;
        const double w134 = w60 * w115;
        const double xe1_0 = xi1_0 * w131 + w134 + xi4_0 * w133;
        const double w135 = w60 * w121;
        const double xe1_2 = xi1_2 * w131 + w135 + xi4_2 * w133;
        const double w136 = xe1_0 * xe1_0 + xe1_1 * xe1_1 + xe1_2 * xe1_2;
        double c1_4, c2_7;
        stumpff_12(w136, &c1_4, &c2_7);
        const double w138 = xe1_1 * c2_7;
        const double w139 = xe1_1 * w138;
        const double w140 = xe1_2 * c2_7 * xe1_2;
        const double ge1_0 = 1.0 - (w139 + w140);
        const double w141 = xe1_0 * c2_7;
        const double w142 = xe1_1 * w141;
        const double w144 = xe1_2 * c1_4;
        const double ge1_1 = w142 - w144;
        const double w145 = xe1_1 * c1_4;
        const double w146 = xe1_2 * w141;
        const double ge1_2 = w145 + w146;
        const double m1_6_2_0 = s_p1_0 * ge1_0 + s_p1_1 * ge1_1 + s_p1_2 * ge1_2;
        const double ye2_0 = w117 + xi1_0 * w118 + xi4_0 * w114;
        const double ye2_1 = w120 + xi1_1 * w118 + xi4_1 * w114;
        const double ye2_2 = w122 + xi1_2 * w118 + xi4_2 * w114;
        const double w147 = ye2_0 * ye2_0 + ye2_1 * ye2_1 + ye2_2 * ye2_2;
        double c2_8, c3_4;
        stumpff_23(w147, &c2_8, &c3_4);
        const double ge1_6 = w146 - w145;
        const double w149 = xe1_0 * c1_4;
        const double w150 = xe1_2 * w138;
        const double ge1_7 = w149 + w150;
        const double w151 = xe1_0 * w141;
        const double ge1_8 = 1.0 - (w139 + w151);
        const double m1_6_2_2 = s_p1_0 * ge1_6 + s_p1_1 * ge1_7 + s_p1_2 * ge1_8;
        const double ge1_3 = w142 + w144;
        const double ge1_4 = 1.0 - (w140 + w151);
        const double ge1_5 = w150 - w149;
        const double m1_6_2_1 = s_p1_0 * ge1_3 + s_p1_1 * ge1_4 + s_p1_2 * ge1_5;
        const double w152 = ye2_1 * m1_6_2_2 - ye2_2 * m1_6_2_1;
        const double w154 = ye2_0 * m1_6_2_1 - m1_6_2_0 * ye2_1;
        const double w155 = m1_6_2_0 * ye2_2 - ye2_0 * m1_6_2_2;
        const double p1_6_2_0 = m1_6_2_0 - w152 * c2_8 + (ye2_1 * w154 - ye2_2 * w155) * c3_4;
        const double M1_0 = p1_11_2_0 + w2 * p1_13_0 + 1.5 * p1_11_0 - 0.5 * p1_6_2_0;
        const double residual_0 = M1_0 - 1.01 * xi1_0;
        const double p1_11_2_1 = s_nu2_1 - w53 * c2_3 + (yE2_1_2 * w50 - yE2_1_0 * w52) * c3_1;
        const double p1_13_1 = m1_13_1 - w59 * c2_4 + (yE4_2_2 * w56 - yE4_2_0 * w58) * c3_2;
        const double p1_11_1 = s_p1_1 - w130 * c2_6 + (ye1_2 * w127 - ye1_0 * w129) * c3_3;
        const double p1_6_2_1 = m1_6_2_1 - w155 * c2_8 + (ye2_2 * w152 - ye2_0 * w154) * c3_4;
        const double M1_1 = p1_11_2_1 + w2 * p1_13_1 + 1.5 * p1_11_1 - 0.5 * p1_6_2_1;
        const double residual_1 = M1_1 - xi1_1;
        const double p1_11_2_2 = s_nu2_2 - w52 * c2_3 + (yE2_1_0 * w53 - yE2_1_1 * w50) * c3_1;
        const double p1_13_2 = m1_13_2 - w58 * c2_4 + (yE4_2_0 * w59 - yE4_2_1 * w56) * c3_2;
        const double p1_11_2 = s_p1_2 - w129 * c2_6 + (ye1_0 * w130 - ye1_1 * w127) * c3_3;
        const double p1_6_2_2 = m1_6_2_2 - w154 * c2_8 + (ye2_0 * w155 - ye2_1 * w152) * c3_4;
        const double M1_2 = p1_11_2_2 + w2 * p1_13_2 + 1.5 * p1_11_2 - 0.5 * p1_6_2_2;
        const double residual_2 = M1_2 - p_2;
        const double w156 = 0.5 * (p1_11_0 + p1_6_2_0);
        const double yE3_1_0 = xi2_0 * w1;
        const double yE3_1_1 = xi2_1 * w1;
        const double yE3_1_2 = xi2_2 * w1;
        const double w157 = yE3_1_0 * yE3_1_0 + yE3_1_1 * yE3_1_1 + yE3_1_2 * yE3_1_2;
        double c2_9, c3_5;
        stumpff_23(w157, &c2_9, &c3_5);
        const double w159 = Nr3_2 * yE3_1_1 - Nr3_1 * yE3_1_2;
        const double w161 = Nr3_1 * yE3_1_0 - Nr3_0 * yE3_1_1;
        const double w162 = Nr3_0 * yE3_1_2 - Nr3_2 * yE3_1_0;
        const double M2_0 = w156
            + w1 * (Nr3_0 - w159 * c2_9 + (yE3_1_1 * w161 - yE3_1_2 * w162) * c3_5);
        const double p_2_0 = 1.01 * a_0;
        const double a_4_0 = gE2_1_0 * p_2_0 + gE2_1_1 * a_1 + gE2_1_2 * p_2_2;
        const double residual_2_0 = M2_0 - a_4_0;
        const double w163 = 0.5 * (p1_11_1 + p1_6_2_1);
        const double M2_1 = w163
            + w1 * (Nr3_1 - w162 * c2_9 + (yE3_1_2 * w159 - yE3_1_0 * w161) * c3_5);
        const double a_4_1 = gE2_1_3 * p_2_0 + gE2_1_4 * a_1 + gE2_1_5 * p_2_2;
        const double residual_2_1 = M2_1 - a_4_1;
        const double w164 = 0.5 * (p1_11_2 + p1_6_2_2);
        const double M2_2 = w164
            + w1 * (Nr3_2 - w161 * c2_9 + (yE3_1_0 * w162 - yE3_1_1 * w159) * c3_5);
        const double a_4_2 = gE2_1_6 * p_2_0 + gE2_1_7 * a_1 + gE2_1_8 * p_2_2;
        const double residual_2_2 = M2_2 - a_4_2;
        const double M3_0 = w156 + w1 * p1_13_0;
        const double p_3_0 = 1.01 * a_3_0;
        const double a_7_0 = gE3_1_0 * p_3_0 + gE3_1_1 * a_3_1 + gE3_1_2 * p_3_2;
        const double residual_3_0 = M3_0 - a_7_0;
        const double M3_1 = w163 + w1 * p1_13_1;
        const double a_7_1 = gE3_1_3 * p_3_0 + gE3_1_4 * a_3_1 + gE3_1_5 * p_3_2;
        const double residual_3_1 = M3_1 - a_7_1;
        const double M3_2 = w164 + w1 * p1_13_2;
        const double a_7_2 = gE3_1_6 * p_3_0 + gE3_1_7 * a_3_1 + gE3_1_8 * p_3_2;
        const double residual_3_2 = M3_2 - a_7_2;
        const double M4_0 = 1.5 * p1_6_2_0 - 0.5 * p1_11_0;
        const double p_4_0 = 1.01 * a_5_0;
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
        if (!isfinite(residual_0 + residual_1 + residual_2 + residual_2_0 + residual_2_1
            + residual_2_2 + residual_3_0 + residual_3_1 + residual_3_2 + residual_4_0
            + residual_4_1 + residual_4_2)) {
            count_sweeps(statistics, 0, sweep, 1);
            return DIPOLE_VCF_CF4_NOT_FINITE;
        }
        if (make_1) {
            const double w165 = 0.165 * xi1_2;
            const double w166 = 0.08333333333333333 * g02 * mu0 + 0.08333333333333333 * g12 * mu1
                + 0.08333333333333333 * g22 * mu2;
            const double w167 = 0.165 * xi1_1;
            const double w168 = -0.08333333333333333 * g01 * mu0 - 0.08333333333333333 * g11 * mu1
                - 0.08333333333333333 * g21 * mu2;
            const double w169 = -0.66 * h;
            const double w170 = 0.33 * h;
            const double w171 = xi3_2 * w170;
            const double w172 = xi3_1 * w170;
            const double w173 = 0.165 * xi4_2;
            const double w174 = -0.08333333333333333 * g02 * mu0 - 0.08333333333333333 * g12 * mu1
                - 0.08333333333333333 * g22 * mu2;
            const double w175 = 0.165 * xi4_1;
            const double w176 = 0.08333333333333333 * g01 * mu0 + 0.08333333333333333 * g11 * mu1
                + 0.08333333333333333 * g21 * mu2;
            const double w177 = -0.16666666666666666 * xi1_2;
            const double w178 = -0.16666666666666666 * xi1_0;
            const double w179 = 0.08333333333333333 * g00 * mu0 + 0.08333333333333333 * g10 * mu1
                + 0.08333333333333333 * g20 * mu2;
            const double w180 = 0.6666666666666666 * h;
            const double w181 = -0.3333333333333333 * h;
            const double w182 = xi3_2 * w181;
            const double w183 = xi3_0 * w181;
            const double w184 = -0.16666666666666666 * xi4_2;
            const double w185 = -0.16666666666666666 * xi4_0;
            const double w186 = -0.08333333333333333 * g00 * mu0 - 0.08333333333333333 * g10 * mu1
                - 0.08333333333333333 * g20 * mu2;
            const double w187 = 0.0016666666666666668 * xi1_1;
            const double w188 = 0.0016666666666666668 * xi1_0;
            const double w189 = -0.006666666666666667 * h;
            const double w190 = 0.0033333333333333335 * h;
            const double w191 = xi3_1 * w190;
            const double w192 = xi3_0 * w190;
            const double w193 = 0.0016666666666666668 * xi4_1;
            const double w194 = 0.0016666666666666668 * xi4_0;
            const double w195 = 0.16666666666666666 * g02 * mu0 + 0.16666666666666666 * g12 * mu1
                + 0.16666666666666666 * g22 * mu2;
            const double w196 = w165 + w195;
            const double w197 = -0.16666666666666666 * g01 * mu0 - 0.16666666666666666 * g11 * mu1
                - 0.16666666666666666 * g21 * mu2;
            const double w198 = w167 + w197;
            const double w199 = 0.33 * xi2_2;
            const double w200 = -0.005 * xi1_2;
            const double w201 = 0.33 * xi2_1;
            const double w202 = 0.5 * xi1_1;
            const double w203 = 0.165 * h;
            const double w204 = xi4_2 * w203;
            const double w205 = xi4_1 * w203;
            const double w206 = -0.16666666666666666 * g02 * mu0 - 0.16666666666666666 * g12 * mu1
                - 0.16666666666666666 * g22 * mu2;
            const double w207 = w177 + w206;
            const double w208 = 0.16666666666666666 * g00 * mu0 + 0.16666666666666666 * g10 * mu1
                + 0.16666666666666666 * g20 * mu2;
            const double w209 = w178 + w208;
            const double w210 = -0.3333333333333333 * xi2_2;
            const double w211 = -0.3333333333333333 * xi2_0;
            const double w212 = -0.495 * xi1_0;
            const double w213 = xi4_2 * w116;
            const double w214 = xi4_0 * w116;
            const double w215 = 0.16666666666666666 * g01 * mu0 + 0.16666666666666666 * g11 * mu1
                + 0.16666666666666666 * g21 * mu2;
            const double w216 = w187 + w215;
            const double w217 = -0.16666666666666666 * g00 * mu0 - 0.16666666666666666 * g10 * mu1
                - 0.16666666666666666 * g20 * mu2;
            const double w218 = w188 + w217;
            const double w219 = 0.0033333333333333335 * xi2_1;
            const double w220 = 0.0033333333333333335 * xi2_0;
            const double w221 = 0.0016666666666666668 * h;
            const double w222 = xi4_1 * w221;
            const double w223 = xi4_0 * w221;
            const double w224 = 0.33 * xi3_2;
            const double w225 = -0.005 * xi2_2;
            const double w226 = 0.33 * xi3_1;
            const double w227 = 0.5 * xi2_1;
            const double w228 = -0.33 * h;
            const double w229 = -0.3333333333333333 * xi3_2;
            const double w230 = -0.3333333333333333 * xi3_0;
            const double w231 = -0.495 * xi2_0;
            const double w232 = 0.0033333333333333335 * xi3_1;
            const double w233 = 0.0033333333333333335 * xi3_0;
            const double w234 = -0.0033333333333333335 * h;
            const double w235 = h * (0.25 * g02 * mu0 + 0.25 * g12 * mu1 + 0.25 * g22 * mu2 + w165);
            const double w236 = h * (-0.25 * g01 * mu0 - 0.25 * g11 * mu1 - 0.25 * g21 * mu2 + w167);
            const double w237 = 0.3333333333333333 * g02 * mu0 + 0.3333333333333333 * g12 * mu1
                + 0.3333333333333333 * g22 * mu2;
            const double w238 = -0.3333333333333333 * g01 * mu0 - 0.3333333333333333 * g11 * mu1
                - 0.3333333333333333 * g21 * mu2;
            const double w239 = -0.01 * xi3_2;
            const double w240 = h * (-0.25 * g02 * mu0 - 0.25 * g12 * mu1 - 0.25 * g22 * mu2 + w177);
            const double w241 = h * (0.25 * g00 * mu0 + 0.25 * g10 * mu1 + 0.25 * g20 * mu2 + w178);
            const double w242 = -0.3333333333333333 * g02 * mu0 - 0.3333333333333333 * g12 * mu1
                - 0.3333333333333333 * g22 * mu2;
            const double w243 = 0.3333333333333333 * g00 * mu0 + 0.3333333333333333 * g10 * mu1
                + 0.3333333333333333 * g20 * mu2;
            const double w244 = -0.99 * xi3_0;
            const double w245 = h * (0.25 * g01 * mu0 + 0.25 * g11 * mu1 + 0.25 * g21 * mu2 + w187);
            const double w246 = h * (-0.25 * g00 * mu0 - 0.25 * g10 * mu1 - 0.25 * g20 * mu2 + w188);
            const double w247 = 0.3333333333333333 * g01 * mu0 + 0.3333333333333333 * g11 * mu1
                + 0.3333333333333333 * g21 * mu2;
            const double w248 = -0.3333333333333333 * g00 * mu0 - 0.3333333333333333 * g10 * mu1
                - 0.3333333333333333 * g20 * mu2;
            memory->inverse_1[0] = 1.01;
            memory->inverse_1[1] = -h * (w165 + w166);
            memory->inverse_1[2] = -h * (w167 + w168);
            memory->inverse_1[3] = 0.0;
            memory->inverse_1[4] = -xi2_2 * w169;
            memory->inverse_1[5] = -xi2_1 * w169;
            memory->inverse_1[6] = 0.0;
            memory->inverse_1[7] = -w171;
            memory->inverse_1[8] = -w172;
            memory->inverse_1[9] = 0.0;
            memory->inverse_1[10] = -h * (w173 + w174);
            memory->inverse_1[11] = -h * (w175 + w176);
            memory->inverse_1[12] = -h * (w174 + w177);
            memory->inverse_1[13] = 1.0;
            memory->inverse_1[14] = -h * (w178 + w179);
            memory->inverse_1[15] = -xi2_2 * w180;
            memory->inverse_1[16] = 0.0;
            memory->inverse_1[17] = -xi2_0 * w180;
            memory->inverse_1[18] = -w182;
            memory->inverse_1[19] = 0.0;
            memory->inverse_1[20] = -w183;
            memory->inverse_1[21] = -h * (w166 + w184);
            memory->inverse_1[22] = 0.0;
            memory->inverse_1[23] = -h * (w185 + w186);
            memory->inverse_1[24] = -h * (w176 + w187);
            memory->inverse_1[25] = -h * (w186 + w188);
            memory->inverse_1[26] = 0.01;
            memory->inverse_1[27] = -xi2_1 * w189;
            memory->inverse_1[28] = -xi2_0 * w189;
            memory->inverse_1[29] = 0.0;
            memory->inverse_1[30] = -w191;
            memory->inverse_1[31] = -w192;
            memory->inverse_1[32] = 0.0;
            memory->inverse_1[33] = -h * (w168 + w193);
            memory->inverse_1[34] = -h * (w179 + w194);
            memory->inverse_1[35] = 0.0;
            memory->inverse_1[36] = 0.0;
            memory->inverse_1[37] = -h * (0.5 * xi2_2 + w196);
            memory->inverse_1[38] = -h * (w198 - 0.005 * xi2_1);
            memory->inverse_1[39] = 1.01;
            memory->inverse_1[40] = -h * (w195 + w200 + w199);
            memory->inverse_1[41] = -h * (w197 + w202 + w201);
            memory->inverse_1[42] = 0.0;
            memory->inverse_1[43] = -h * (w195 - 0.165 * xi3_2);
            memory->inverse_1[44] = -h * (w197 - 0.165 * xi3_1);
            memory->inverse_1[45] = 0.0;
            memory->inverse_1[46] = -w204;
            memory->inverse_1[47] = -w205;
            memory->inverse_1[48] = -h * (w207 - 0.495 * xi2_2);
            memory->inverse_1[49] = 0.0;
            memory->inverse_1[50] = -h * (w209 - 0.005 * xi2_0);
            memory->inverse_1[51] = -h * (w200 + w206 + w210);
            memory->inverse_1[52] = 1.0;
            memory->inverse_1[53] = -h * (w208 + w212 + w211);
            memory->inverse_1[54] = -h * (0.16666666666666666 * xi3_2 + w206);
            memory->inverse_1[55] = 0.0;
            memory->inverse_1[56] = -h * (0.16666666666666666 * xi3_0 + w208);
            memory->inverse_1[57] = -w213;
            memory->inverse_1[58] = 0.0;
            memory->inverse_1[59] = -w214;
            memory->inverse_1[60] = -h * (w216 - 0.495 * xi2_1);
            memory->inverse_1[61] = -h * (0.5 * xi2_0 + w218);
            memory->inverse_1[62] = 0.0;
            memory->inverse_1[63] = -h * (w202 + w215 + w219);
            memory->inverse_1[64] = -h * (w212 + w217 + w220);
            memory->inverse_1[65] = 0.01;
            memory->inverse_1[66] = -h * (w215 - 0.0016666666666666668 * xi3_1);
            memory->inverse_1[67] = -h * (w217 - 0.0016666666666666668 * xi3_0);
            memory->inverse_1[68] = 0.0;
            memory->inverse_1[69] = -w222;
            memory->inverse_1[70] = -w223;
            memory->inverse_1[71] = 0.0;
            memory->inverse_1[72] = 0.0;
            memory->inverse_1[73] = -h * w196;
            memory->inverse_1[74] = -h * w198;
            memory->inverse_1[75] = 0.0;
            memory->inverse_1[76] = -h * (w195 + w199 + 0.5 * xi3_2);
            memory->inverse_1[77] = -h * (w197 + w201 - 0.005 * xi3_1);
            memory->inverse_1[78] = 1.01;
            memory->inverse_1[79] = -h * (w195 + w225 + w224);
            memory->inverse_1[80] = -h * (w197 + w227 + w226);
            memory->inverse_1[81] = 0.0;
            memory->inverse_1[82] = -xi4_2 * w228;
            memory->inverse_1[83] = -xi4_1 * w228;
            memory->inverse_1[84] = -h * w207;
            memory->inverse_1[85] = 0.0;
            memory->inverse_1[86] = -h * w209;
            memory->inverse_1[87] = -h * (w206 + w210 - 0.495 * xi3_2);
            memory->inverse_1[88] = 0.0;
            memory->inverse_1[89] = -h * (w208 + w211 - 0.005 * xi3_0);
            memory->inverse_1[90] = -h * (w206 + w225 + w229);
            memory->inverse_1[91] = 1.0;
            memory->inverse_1[92] = -h * (w208 + w231 + w230);
            memory->inverse_1[93] = -xi4_2 * w113;
            memory->inverse_1[94] = 0.0;
            memory->inverse_1[95] = -xi4_0 * w113;
            memory->inverse_1[96] = -h * w216;
            memory->inverse_1[97] = -h * w218;
            memory->inverse_1[98] = 0.0;
            memory->inverse_1[99] = -h * (w215 + w219 - 0.495 * xi3_1);
            memory->inverse_1[100] = -h * (w217 + w220 + 0.5 * xi3_0);
            memory->inverse_1[101] = 0.0;
            memory->inverse_1[102] = -h * (w215 + w227 + w232);
            memory->inverse_1[103] = -h * (w217 + w231 + w233);
            memory->inverse_1[104] = 0.01;
            memory->inverse_1[105] = -xi4_1 * w234;
            memory->inverse_1[106] = -xi4_0 * w234;
            memory->inverse_1[107] = 0.0;
            memory->inverse_1[108] = 0.0;
            memory->inverse_1[109] = -w235;
            memory->inverse_1[110] = -w236;
            memory->inverse_1[111] = 0.0;
            memory->inverse_1[112] = -h * (w199 + w237);
            memory->inverse_1[113] = -h * (w201 + w238);
            memory->inverse_1[114] = 0.0;
            memory->inverse_1[115] = -h * (w224 + w237 + xi4_2);
            memory->inverse_1[116] = -h * (w226 + w238 - 0.01 * xi4_1);
            memory->inverse_1[117] = 1.01;
            memory->inverse_1[118] = -h * (w166 + w239 + w173);
            memory->inverse_1[119] = -h * (xi3_1 + w168 + w175);
            memory->inverse_1[120] = -w240;
            memory->inverse_1[121] = 0.0;
            memory->inverse_1[122] = -w241;
            memory->inverse_1[123] = -h * (w210 + w242);
            memory->inverse_1[124] = 0.0;
            memory->inverse_1[125] = -h * (w211 + w243);
            memory->inverse_1[126] = -h * (w229 + w242 - 0.99 * xi4_2);
            memory->inverse_1[127] = 0.0;
            memory->inverse_1[128] = -h * (w230 + w243 - 0.01 * xi4_0);
            memory->inverse_1[129] = -h * (w174 + w239 + w184);
            memory->inverse_1[130] = 1.0;
            memory->inverse_1[131] = -h * (w179 + w244 + w185);
            memory->inverse_1[132] = -w245;
            memory->inverse_1[133] = -w246;
            memory->inverse_1[134] = 0.0;
            memory->inverse_1[135] = -h * (w219 + w247);
            memory->inverse_1[136] = -h * (w220 + w248);
            memory->inverse_1[137] = 0.0;
            memory->inverse_1[138] = -h * (w232 + w247 - 0.99 * xi4_1);
            memory->inverse_1[139] = -h * (w233 + w248 + xi4_0);
            memory->inverse_1[140] = 0.0;
            memory->inverse_1[141] = -h * (xi3_1 + w176 + w193);
            memory->inverse_1[142] = -h * (w186 + w244 + w194);
            memory->inverse_1[143] = 0.01;
            size_t order_1[12];
            memory->made_1 = invert(12, memory->inverse_1, order_1);
            if (!memory->made_1) {
                count_sweeps(statistics, 0, sweep, 1);
                return DIPOLE_VCF_CF4_NOT_CONVERGED;
            }
            count_matrix(statistics);
        }
        d_xi1_0 = memory->inverse_1[0] * residual_0 + memory->inverse_1[1] * residual_1
            + memory->inverse_1[2] * residual_2 + memory->inverse_1[3] * residual_2_0
            + memory->inverse_1[4] * residual_2_1 + memory->inverse_1[5] * residual_2_2
            + memory->inverse_1[6] * residual_3_0 + memory->inverse_1[7] * residual_3_1
            + memory->inverse_1[8] * residual_3_2 + memory->inverse_1[9] * residual_4_0
            + memory->inverse_1[10] * residual_4_1 + memory->inverse_1[11] * residual_4_2;
        d_xi1_1 = memory->inverse_1[12] * residual_0 + memory->inverse_1[13] * residual_1
            + memory->inverse_1[14] * residual_2 + memory->inverse_1[15] * residual_2_0
            + memory->inverse_1[16] * residual_2_1 + memory->inverse_1[17] * residual_2_2
            + memory->inverse_1[18] * residual_3_0 + memory->inverse_1[19] * residual_3_1
            + memory->inverse_1[20] * residual_3_2 + memory->inverse_1[21] * residual_4_0
            + memory->inverse_1[22] * residual_4_1 + memory->inverse_1[23] * residual_4_2;
        d_xi1_2 = memory->inverse_1[24] * residual_0 + memory->inverse_1[25] * residual_1
            + memory->inverse_1[26] * residual_2 + memory->inverse_1[27] * residual_2_0
            + memory->inverse_1[28] * residual_2_1 + memory->inverse_1[29] * residual_2_2
            + memory->inverse_1[30] * residual_3_0 + memory->inverse_1[31] * residual_3_1
            + memory->inverse_1[32] * residual_3_2 + memory->inverse_1[33] * residual_4_0
            + memory->inverse_1[34] * residual_4_1 + memory->inverse_1[35] * residual_4_2;
        d_xi2_0 = memory->inverse_1[36] * residual_0 + memory->inverse_1[37] * residual_1
            + memory->inverse_1[38] * residual_2 + memory->inverse_1[39] * residual_2_0
            + memory->inverse_1[40] * residual_2_1 + memory->inverse_1[41] * residual_2_2
            + memory->inverse_1[42] * residual_3_0 + memory->inverse_1[43] * residual_3_1
            + memory->inverse_1[44] * residual_3_2 + memory->inverse_1[45] * residual_4_0
            + memory->inverse_1[46] * residual_4_1 + memory->inverse_1[47] * residual_4_2;
        d_xi2_1 = memory->inverse_1[48] * residual_0 + memory->inverse_1[49] * residual_1
            + memory->inverse_1[50] * residual_2 + memory->inverse_1[51] * residual_2_0
            + memory->inverse_1[52] * residual_2_1 + memory->inverse_1[53] * residual_2_2
            + memory->inverse_1[54] * residual_3_0 + memory->inverse_1[55] * residual_3_1
            + memory->inverse_1[56] * residual_3_2 + memory->inverse_1[57] * residual_4_0
            + memory->inverse_1[58] * residual_4_1 + memory->inverse_1[59] * residual_4_2;
        d_xi2_2 = memory->inverse_1[60] * residual_0 + memory->inverse_1[61] * residual_1
            + memory->inverse_1[62] * residual_2 + memory->inverse_1[63] * residual_2_0
            + memory->inverse_1[64] * residual_2_1 + memory->inverse_1[65] * residual_2_2
            + memory->inverse_1[66] * residual_3_0 + memory->inverse_1[67] * residual_3_1
            + memory->inverse_1[68] * residual_3_2 + memory->inverse_1[69] * residual_4_0
            + memory->inverse_1[70] * residual_4_1 + memory->inverse_1[71] * residual_4_2;
        d_xi3_0 = memory->inverse_1[72] * residual_0 + memory->inverse_1[73] * residual_1
            + memory->inverse_1[74] * residual_2 + memory->inverse_1[75] * residual_2_0
            + memory->inverse_1[76] * residual_2_1 + memory->inverse_1[77] * residual_2_2
            + memory->inverse_1[78] * residual_3_0 + memory->inverse_1[79] * residual_3_1
            + memory->inverse_1[80] * residual_3_2 + memory->inverse_1[81] * residual_4_0
            + memory->inverse_1[82] * residual_4_1 + memory->inverse_1[83] * residual_4_2;
        d_xi3_1 = memory->inverse_1[84] * residual_0 + memory->inverse_1[85] * residual_1
            + memory->inverse_1[86] * residual_2 + memory->inverse_1[87] * residual_2_0
            + memory->inverse_1[88] * residual_2_1 + memory->inverse_1[89] * residual_2_2
            + memory->inverse_1[90] * residual_3_0 + memory->inverse_1[91] * residual_3_1
            + memory->inverse_1[92] * residual_3_2 + memory->inverse_1[93] * residual_4_0
            + memory->inverse_1[94] * residual_4_1 + memory->inverse_1[95] * residual_4_2;
        d_xi3_2 = memory->inverse_1[96] * residual_0 + memory->inverse_1[97] * residual_1
            + memory->inverse_1[98] * residual_2 + memory->inverse_1[99] * residual_2_0
            + memory->inverse_1[100] * residual_2_1 + memory->inverse_1[101] * residual_2_2
            + memory->inverse_1[102] * residual_3_0 + memory->inverse_1[103] * residual_3_1
            + memory->inverse_1[104] * residual_3_2 + memory->inverse_1[105] * residual_4_0
            + memory->inverse_1[106] * residual_4_1 + memory->inverse_1[107] * residual_4_2;
        d_xi4_0 = memory->inverse_1[108] * residual_0 + memory->inverse_1[109] * residual_1
            + memory->inverse_1[110] * residual_2 + memory->inverse_1[111] * residual_2_0
            + memory->inverse_1[112] * residual_2_1 + memory->inverse_1[113] * residual_2_2
            + memory->inverse_1[114] * residual_3_0 + memory->inverse_1[115] * residual_3_1
            + memory->inverse_1[116] * residual_3_2 + memory->inverse_1[117] * residual_4_0
            + memory->inverse_1[118] * residual_4_1 + memory->inverse_1[119] * residual_4_2;
        d_xi4_1 = memory->inverse_1[120] * residual_0 + memory->inverse_1[121] * residual_1
            + memory->inverse_1[122] * residual_2 + memory->inverse_1[123] * residual_2_0
            + memory->inverse_1[124] * residual_2_1 + memory->inverse_1[125] * residual_2_2
            + memory->inverse_1[126] * residual_3_0 + memory->inverse_1[127] * residual_3_1
            + memory->inverse_1[128] * residual_3_2 + memory->inverse_1[129] * residual_4_0
            + memory->inverse_1[130] * residual_4_1 + memory->inverse_1[131] * residual_4_2;
        d_xi4_2 = memory->inverse_1[132] * residual_0 + memory->inverse_1[133] * residual_1
            + memory->inverse_1[134] * residual_2 + memory->inverse_1[135] * residual_2_0
            + memory->inverse_1[136] * residual_2_1 + memory->inverse_1[137] * residual_2_2
            + memory->inverse_1[138] * residual_3_0 + memory->inverse_1[139] * residual_3_1
            + memory->inverse_1[140] * residual_3_2 + memory->inverse_1[141] * residual_4_0
            + memory->inverse_1[142] * residual_4_1 + memory->inverse_1[143] * residual_4_2;
        const double change = greater(greater(greater(fabs(d_xi1_0), greater(fabs(d_xi1_1),
            fabs(d_xi1_2))), greater(fabs(d_xi2_0), greater(fabs(d_xi2_1), fabs(d_xi2_2)))),
            greater(greater(fabs(d_xi3_0), greater(fabs(d_xi3_1), fabs(d_xi3_2))),
            greater(fabs(d_xi4_0), greater(fabs(d_xi4_1), fabs(d_xi4_2)))));
        const double scale = greater(greater(greater(1.0, greater(fabs(xi1_0), fabs(xi1_1))),
            greater(fabs(xi1_2), greater(fabs(xi2_0), fabs(xi2_1)))), greater(greater(fabs(xi2_2),
            greater(fabs(xi3_0), fabs(xi3_1))), greater(greater(fabs(xi3_2), fabs(xi4_0)),
            greater(fabs(xi4_1), fabs(xi4_2)))));
        const int still = previous_1 > 0.0 && change >= previous_1;
        if (sweep == 1) {
            memory->first = greater(memory->first, change);
        }
        if (previous_1 > 0.0) {
            rate_1 = greater(change / previous_1, 0.000244140625);
        }
        const int close = change <= 5.684341886080802e-14 * scale
            && change * rate_1 <= 1.1102230246251565e-16 * scale;
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
        if (close || (still && change <= 5.684341886080802e-14 * scale)) {
            count_sweeps(statistics, 0, sweep, 0);
            memory->rate_1 = sweep > 1 ? rate_1 : 2.0 * rate_1;
            break;
        }
        if (sweep == 100) {
            count_sweeps(statistics, 0, sweep, 1);
            return DIPOLE_VCF_CF4_NOT_CONVERGED;
        }
        make_1 = 0;
        previous_1 = change;
    }
    const double w249 = xi2_1 + xi3_1;
    const double w250 = w60 * w249;
    const double xe1_1_ = xi1_1 * w131 + w250 + xi4_1 * w133;
    const double w251 = xi2_0 + xi3_0;
    const double w252 = w60 * w251;
    const double xe1_0_ = xi1_0 * w131 + w252 + xi4_0 * w133;
    const double w253 = xi2_2 + xi3_2;
    const double w254 = w60 * w253;
    const double xe1_2_ = xi1_2 * w131 + w254 + xi4_2 * w133;
    const double w255 = xe1_0_ * xe1_0_ + xe1_1_ * xe1_1_ + xe1_2_ * xe1_2_;
    double c1_5, c2_10;
    stumpff_12(w255, &c1_5, &c2_10);
    const double w257 = xe1_1_ * c2_10;
    const double w258 = xe1_1_ * w257;
    const double w259 = xe1_2_ * c2_10 * xe1_2_;
    const double ge1_0_ = 1.0 - (w258 + w259);
    const double xe2_1 = w250 + xi1_1 * w133 + xi4_1 * w131;
    const double xe2_0 = w252 + xi1_0 * w133 + xi4_0 * w131;
    const double xe2_2 = w254 + xi1_2 * w133 + xi4_2 * w131;
    const double w260 = xe2_0 * xe2_0 + xe2_1 * xe2_1 + xe2_2 * xe2_2;
    double c1_6, c2_11;
    stumpff_12(w260, &c1_6, &c2_11);
    const double w262 = xe2_1 * c2_11;
    const double w263 = xe2_1 * w262;
    const double w264 = xe2_2 * c2_11 * xe2_2;
    const double ge2_0 = 1.0 - (w263 + w264);
    const double w266 = xe1_2_ * c1_5;
    const double w267 = xe1_0_ * c2_10;
    const double w268 = xe1_1_ * w267;
    const double ge1_3_ = w266 + w268;
    const double w269 = xe2_0 * c2_11;
    const double w270 = xe2_1 * w269;
    const double w272 = xe2_2 * c1_6;
    const double ge2_1 = w270 - w272;
    const double w273 = xe1_2_ * w267;
    const double w274 = xe1_1_ * c1_5;
    const double ge1_6_ = w273 - w274;
    const double w275 = xe2_1 * c1_6;
    const double w276 = xe2_2 * w269;
    const double ge2_2 = w275 + w276;
    const double e2_0 = ge1_0_ * ge2_0 + ge1_3_ * ge2_1 + ge1_6_ * ge2_2;
    const double ge2_3 = w270 + w272;
    const double w277 = xe2_0 * w269;
    const double ge2_4 = 1.0 - (w264 + w277);
    const double w278 = xe2_2 * w262;
    const double w279 = xe2_0 * c1_6;
    const double ge2_5 = w278 - w279;
    const double e2_3 = ge1_0_ * ge2_3 + ge1_3_ * ge2_4 + ge1_6_ * ge2_5;
    const double ge2_6 = w276 - w275;
    const double ge2_7 = w278 + w279;
    const double ge2_8 = 1.0 - (w263 + w277);
    const double e2_6 = ge1_0_ * ge2_6 + ge1_3_ * ge2_7 + ge1_6_ * ge2_8;
    const double ge1_1_ = w268 - w266;
    const double w280 = xe1_0_ * w267;
    const double ge1_4_ = 1.0 - (w259 + w280);
    const double w281 = xe1_0_ * c1_5;
    const double w282 = xe1_2_ * w257;
    const double ge1_7_ = w281 + w282;
    const double e2_1 = ge2_0 * ge1_1_ + ge2_1 * ge1_4_ + ge2_2 * ge1_7_;
    const double e2_4 = ge2_3 * ge1_1_ + ge2_4 * ge1_4_ + ge2_5 * ge1_7_;
    const double e2_7 = ge2_6 * ge1_1_ + ge2_7 * ge1_4_ + ge2_8 * ge1_7_;
    const double ge1_2_ = w273 + w274;
    const double ge1_5_ = w282 - w281;
    const double ge1_8_ = 1.0 - (w258 + w280);
    const double e2_2 = ge2_0 * ge1_2_ + ge2_1 * ge1_5_ + ge2_2 * ge1_8_;
    const double e2_5 = ge2_3 * ge1_2_ + ge2_4 * ge1_5_ + ge2_5 * ge1_8_;
    const double e2_8 = ge2_6 * ge1_2_ + ge2_7 * ge1_5_ + ge2_8 * ge1_8_;
    const double w283 = 0.165 * h;
    const double w284 = 0.33 * h;
    const double w285 = s_p1_0_seen + xi1_2 * w283 * d_xi1_1 + xi1_1 * w283 * d_xi1_2
        + xi2_2 * w284 * d_xi2_1 + xi2_1 * w284 * d_xi2_2;
    const double w286 = xi3_2 * w284;
    const double w287 = xi3_1 * w284;
    const double w288 = xi4_2 * w283;
    const double w289 = xi4_1 * w283;
    const double w290 = w285 + d_xi3_1 * w286 + d_xi3_2 * w287 + d_xi4_1 * w288
        + d_xi4_2 * w289;
    const double w291 = -0.3333333333333333 * h;
    const double w292 = s_p1_1_seen + xi1_2 * w116 * d_xi1_0 + xi1_0 * w116 * d_xi1_2
        + xi2_2 * w291 * d_xi2_0 + xi2_0 * w291 * d_xi2_2;
    const double w293 = xi3_2 * w291;
    const double w294 = xi3_0 * w291;
    const double w295 = xi4_2 * w116;
    const double w296 = xi4_0 * w116;
    const double w297 = w292 + d_xi3_0 * w293 + d_xi3_2 * w294 + d_xi4_0 * w295
        + d_xi4_2 * w296;
    const double w298 = 0.0016666666666666668 * h;
    const double w299 = 0.0033333333333333335 * h;
    const double w300 = s_p1_2_seen + xi1_1 * w298 * d_xi1_0 + xi1_0 * w298 * d_xi1_1
        + xi2_1 * w299 * d_xi2_0 + xi2_0 * w299 * d_xi2_1;
    const double w301 = xi3_1 * w299;
    const double w302 = xi3_0 * w299;
    const double w303 = xi4_1 * w298;
    const double w304 = xi4_0 * w298;
    const double w305 = w300 + d_xi3_0 * w301 + d_xi3_1 * w302 + d_xi4_0 * w303
        + d_xi4_1 * w304;
    const double change_0 = e2_0 * w290 + e2_1 * w297 + e2_2 * w305 - m_0;
    const double change_1 = e2_3 * w290 + e2_4 * w297 + e2_5 * w305 - m_1;
    const double change_2 = e2_6 * w290 + e2_7 * w297 + e2_8 * w305 - m_2;
    const double new_g00 = g00 * e2_0 + g01 * e2_3 + g02 * e2_6;
    const double new_g01 = g00 * e2_1 + g01 * e2_4 + g02 * e2_7;
    const double new_g02 = g00 * e2_2 + g01 * e2_5 + g02 * e2_8;
    const double new_g10 = g10 * e2_0 + g11 * e2_3 + g12 * e2_6;
    const double new_g11 = g10 * e2_1 + g11 * e2_4 + g12 * e2_7;
    const double new_g12 = g10 * e2_2 + g11 * e2_5 + g12 * e2_8;
    const double new_g20 = g20 * e2_0 + g21 * e2_3 + g22 * e2_6;
    const double new_g21 = g20 * e2_1 + g21 * e2_4 + g22 * e2_7;
    const double new_g22 = g20 * e2_2 + g21 * e2_5 + g22 * e2_8;
    const double new_mu0 = g00 * change_0 + g01 * change_1 + g02 * change_2 + mu0;
    const double new_mu1 = g10 * change_0 + g11 * change_1 + g12 * change_2 + mu1;
    const double new_mu2 = g20 * change_0 + g21 * change_1 + g22 * change_2 + mu2;
    if (!(isfinite(new_g00) && isfinite(new_g01) && isfinite(new_g02) && isfinite(new_g10)
        && isfinite(new_g11) && isfinite(new_g12) && isfinite(new_g20) && isfinite(new_g21)
        && isfinite(new_g22) && isfinite(new_mu0) && isfinite(new_mu1) && isfinite(new_mu2))) {
        return DIPOLE_VCF_CF4_NOT_FINITE;
    }
    const double solution[12] = {xi1_0, xi1_1, xi1_2, xi2_0, xi2_1, xi2_2, xi3_0, xi3_1, xi3_2,
        xi4_0, xi4_1, xi4_2};
    remember(memory, solution);
    memory->made_1 = memory->made_1 % 8 > 0 ? memory->made_1 + 1 : 0;
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

int dipole_vcf_cf4_step(double state[static 12], double h,
    dipole_vcf_cf4_statistics *statistics)
{
    struct memory memory = {0};
    return advance(state, h, &memory, statistics);
}

int dipole_vcf_cf4_run(double state[static 12], double h, size_t steps, double *trajectory,
    size_t stride, dipole_vcf_cf4_statistics *statistics, size_t *completed)
{
    int status = DIPOLE_VCF_CF4_OK;
    size_t step = 0;
    struct memory memory = {0};
    double *row = stride > 0 ? trajectory : NULL;
    if (row != NULL) {
        memcpy(row, state, 12 * sizeof *state);
    }
    while (step < steps) {
        status = advance(state, h, &memory, statistics);
        if (status != DIPOLE_VCF_CF4_OK && memory.known > 0) {
            /* the solutions before may mislead where the motion changes: begin as the first step does */
            memset(&memory, 0, sizeof memory);
            if (statistics != NULL) {
                statistics->failed = 0;
            }
            status = advance(state, h, &memory, statistics);
        }
        if (status != DIPOLE_VCF_CF4_OK) {
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
