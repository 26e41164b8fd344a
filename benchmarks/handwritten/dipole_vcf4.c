/*
 * Dipole on a stick by VCF on the commutator-free method CF4 (order 4), by hand.
 *
 * Seen from the body at the start of the step, with the velocities u_i as unknowns:
 *
 *     Q_1 = 1, Q_2 = exp(h u_1/2), Q_3 = exp(h u_2/2), Q_4 = exp(X) Q_2 with X = h (u_3 - u_1/2),
 *     W_i = Q_i^T u_i, P_i = I W_i, G_i = Q_i^T q^T e3, N_i = tau(G_i) + P_i x W_i,
 *     m' = m + h (N_1 + 2 N_2 + 2 N_3 + N_4)/6,  L_1 = dexp_{Y_1} m',  L_2 = dexp_{Y_2} exp(Y_1) m',
 *     Q_1 P_1 = 3/2 L_1 - 1/2 L_2 - h dexp_{h u_1/2} (N_2 + N_4/2) + h/2 dexp_X Q_2 N_4,
 *     Q_2 P_2 = (L_1 + L_2)/2 - h/2 dexp_{h u_2/2} N_3,
 *     Q_3 P_3 = (L_1 + L_2)/2 - h/2 dexp_X Q_2 N_4,
 *     Q_4 P_4 = 3/2 L_2 - 1/2 L_1,
 *     q' = q exp(Y_2) exp(Y_1),
 *
 * with the exponents Y_1 and Y_2 of CF4's update. The twelve equations are solved by Newton's method; its Jacobian
 * to first order in h is inverted in every eighth step. The start is extrapolated from the last solutions;
 * the iteration ends where the next correction would be below rounding.
 */
#define UNKNOWNS 12
#include "dipole.h"
#include "past.h"

static const double b[4] = {1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0}, c[4] = {0.0, 0.5, 0.5, 1.0};
static const double a[4][4] = {{0}, {0.5}, {0.0, 0.5}, {0.0, 0.0, 1.0}};
static const double beta[2][4] = {{0.25, 1.0 / 6.0, 1.0 / 6.0, -1.0 / 12.0}, {-1.0 / 12.0, 1.0 / 6.0, 1.0 / 6.0, 0.25}};

/* exp(x) with the exponent and the functions of its angle */
typedef struct {
    double x[3], k[3], E[9];
} rotation;

static inline void functions(rotation *g)
{
    const double z = dot(g->x, g->x);
    sinc_cosc_defect(z, g->k, g->k + 1, g->k + 2);
}

static inline void matrix(rotation *g)
{
    const double *x = g->x;
    const double s = g->k[0] * x[0], t = g->k[0] * x[1], u = g->k[0] * x[2];
    const double xy = g->k[1] * x[0] * x[1], xz = g->k[1] * x[0] * x[2], yz = g->k[1] * x[1] * x[2];
    const double xx = g->k[1] * x[0] * x[0], yy = g->k[1] * x[1] * x[1], zz = g->k[1] * x[2] * x[2];
    double *E = g->E;
    E[0] = 1.0 - (yy + zz);
    E[1] = xy - u;
    E[2] = xz + t;
    E[3] = xy + u;
    E[4] = 1.0 - (xx + zz);
    E[5] = yz - s;
    E[6] = xz - t;
    E[7] = yz + s;
    E[8] = 1.0 - (xx + yy);
}

static inline void times(const rotation *g, const double v[static 3], double y[static 3])
{
    const double *E = g->E;
    y[0] = E[0] * v[0] + E[1] * v[1] + E[2] * v[2];
    y[1] = E[3] * v[0] + E[4] * v[1] + E[5] * v[2];
    y[2] = E[6] * v[0] + E[7] * v[1] + E[8] * v[2];
}

static inline void back(const rotation *g, const double v[static 3], double y[static 3])
{
    const double *E = g->E;
    y[0] = E[0] * v[0] + E[3] * v[1] + E[6] * v[2];
    y[1] = E[1] * v[0] + E[4] * v[1] + E[7] * v[2];
    y[2] = E[2] * v[0] + E[5] * v[1] + E[8] * v[2];
}

/* dexp_x v, and exp(x) v without the matrix */
static inline void dexp(const rotation *g, const double v[static 3], double y[static 3])
{
    double u[3], w[3];
    cross(g->x, v, u);
    cross(g->x, u, w);
#pragma GCC unroll 3
    for (int i = 0; i < 3; i++) {
        y[i] = v[i] + g->k[1] * u[i] + g->k[2] * w[i];
    }
}

static inline void dexp_and_exp(const rotation *g, const double v[static 3], double d[static 3], double y[static 3])
{
    double u[3], w[3];
    cross(g->x, v, u);
    cross(g->x, u, w);
#pragma GCC unroll 3
    for (int i = 0; i < 3; i++) {
        d[i] = v[i] + g->k[1] * u[i] + g->k[2] * w[i];
        y[i] = v[i] + g->k[0] * u[i] + g->k[1] * w[i];
    }
}

/* P and N of the velocity W seen from the body */
static inline void force(const double W[static 3], const double G[static 3], double P[static 3], double N[static 3])
{
    double t[3];
    torque(G, t);
#pragma GCC unroll 3
    for (int i = 0; i < 3; i++) {
        P[i] = inertia[i] * W[i];
    }
    cross(P, W, N);
#pragma GCC unroll 3
    for (int i = 0; i < 3; i++) {
        N[i] += t[i];
    }
}

static inline double first(const double *u, double h)
{
    return h * (0.25 * u[0] + (1.0 / 6.0) * (u[3] + u[6]) - (1.0 / 12.0) * u[9]);
}

static inline double second(const double *u, double h)
{
    return h * (0.25 * u[9] + (1.0 / 6.0) * (u[3] + u[6]) - (1.0 / 12.0) * u[0]);
}

/* What the twelve equations leave at u, and m' - m. */
static inline void residual(const double u[static 12], const double G0[static 3], const double m[static 3], double h,
    double r[static 12], double impulse[static 3])
{
    rotation g2, g3, g4, y1, y2;
    double P1[3], P2[3], P3[3], P4[3], N1[3], N2[3], N3[3], N4[3], W[3], G[3], v[3], s[3];
    double M[3], L1[3], L2[3], D3[3], D4[3], D24[3];
#pragma GCC unroll 3
    for (int i = 0; i < 3; i++) {
        g2.x[i] = 0.5 * h * u[i];
        g3.x[i] = 0.5 * h * u[3 + i];
        g4.x[i] = h * (u[6 + i] - 0.5 * u[i]);
        y1.x[i] = first(u + i, h);
        y2.x[i] = second(u + i, h);
    }
    functions(&g2);
    functions(&g3);
    functions(&g4);
    functions(&y1);
    functions(&y2);
    matrix(&g2);
    matrix(&g3);
    matrix(&g4);
    force(u, G0, P1, N1);
    back(&g2, u + 3, W);
    back(&g2, G0, G);
    force(W, G, v, N2);
    times(&g2, v, P2);
    back(&g3, u + 6, W);
    back(&g3, G0, G);
    force(W, G, v, N3);
    times(&g3, v, P3);
    back(&g4, u + 9, v);
    back(&g2, v, W);
    back(&g4, G0, v);
    back(&g2, v, G);
    force(W, G, v, N4);
    times(&g2, v, s);
    times(&g4, s, P4);
#pragma GCC unroll 3
    for (int i = 0; i < 3; i++) {
        impulse[i] = h * ((1.0 / 6.0) * (N1[i] + N4[i]) + (1.0 / 3.0) * (N2[i] + N3[i]));
        M[i] = m[i] + impulse[i];
        v[i] = N2[i] + 0.5 * N4[i];
    }
    dexp(&g2, v, D24);
    dexp(&g3, N3, D3);
    times(&g2, N4, v);
    dexp(&g4, v, D4);
    dexp_and_exp(&y1, M, L1, v);
    dexp(&y2, v, L2);
#pragma GCC unroll 3
    for (int i = 0; i < 3; i++) {
        const double mean = 0.5 * (L1[i] + L2[i]), gap = L1[i] - L2[i], half = 0.5 * h;
        r[i] = P1[i] - (mean + gap - h * D24[i] + half * D4[i]);
        r[3 + i] = P2[i] - (mean - half * D3[i]);
        r[6 + i] = P3[i] - (mean - half * D4[i]);
        r[9 + i] = P4[i] - (mean - gap);
    }
}

/* The impulse after the correction e that led to u, up to h^2 e: its part quadratic in u follows. */
static inline void follow(const double u[static 12], const double e[static 12], double h, double impulse[static 3])
{
#pragma GCC unroll 4
    for (int i = 0; i < 12; i += 3) {
        const double k = h * b[i / 3];
        const double v0 = u[i] + 0.5 * e[i], v1 = u[i + 1] + 0.5 * e[i + 1], v2 = u[i + 2] + 0.5 * e[i + 2];
        impulse[0] -= k * (inertia[1] - inertia[2]) * (v1 * e[i + 2] + v2 * e[i + 1]);
        impulse[1] -= k * (inertia[2] - inertia[0]) * (v2 * e[i] + v0 * e[i + 2]);
        impulse[2] -= k * (inertia[0] - inertia[1]) * (v0 * e[i + 1] + v1 * e[i]);
    }
}

/* B = the inverse of the Jacobian at u to first order in h, by Gauss and Jordan in place */
static void inverse(const double u[static 12], double h, double B[static 12][12])
{
    double H[3][3] = {{0}}, KI[3][3] = {{0}}, IK[3][3] = {{0}};
    for (int p = 0; p < 3; p++) {
        const int q = (p + 1) % 3, o = (p + 2) % 3;
        const double W = first(u + o, 1.0) + second(u + o, 1.0), L = inertia[o] * W;
        H[p][q] = -h * L;
        H[q][p] = h * L;
        KI[p][q] = -h * W * inertia[q];
        KI[q][p] = h * W * inertia[p];
        IK[p][q] = -h * W * inertia[p];
        IK[q][p] = h * W * inertia[q];
    }
    for (int i = 0; i < 4; i++) {
        for (int j = 0; j < 4; j++) {
            const double hat = b[j] * (1.0 - a[j][i] / b[i]);
            const double carried
                = ((0.5 * beta[0][i] + beta[1][i]) * beta[0][j] + 0.5 * beta[1][i] * beta[1][j]) / b[i];
            for (int p = 0; p < 3; p++) {
                for (int q = 0; q < 3; q++) {
                    B[3 * i + p][3 * j + q]
                        = a[i][j] * (IK[p][q] - H[p][q]) - hat * (H[p][q] - KI[p][q]) + carried * H[p][q];
                }
            }
        }
        for (int p = 0; p < 3; p++) {
            for (int q = 0; q < 3; q++) {
                B[3 * i + p][3 * i + q] += (p == q ? inertia[p] : 0.0) + c[i] * (KI[p][q] - IK[p][q]);
            }
        }
    }
    for (int k = 0; k < 12; k++) {
        const double d = 1.0 / B[k][k];
        B[k][k] = 1.0;
        for (int j = 0; j < 12; j++) {
            B[k][j] *= d;
        }
        for (int i = 0; i < 12; i++) {
            if (i != k) {
                const double f = B[i][k];
                B[i][k] = 0.0;
                for (int j = 0; j < 12; j++) {
                    B[i][j] -= f * B[k][j];
                }
            }
        }
    }
}

size_t handwritten_run(double state[static 12], double h, size_t steps)
{
    double q[9], m[3], u[12], r[12], impulse[3], B[12][12];
    struct past past;
    double rate = 1.0;
    size_t sweeps = 0;
    forget(&past);
    for (int i = 0; i < 9; i++) {
        q[i] = state[i];
    }
    for (int i = 0; i < 3; i++) {
        m[i] = q[i] * state[9] + q[3 + i] * state[10] + q[6 + i] * state[11];
        u[i] = u[3 + i] = u[6 + i] = u[9 + i] = m[i] / inertia[i];
    }
    for (size_t n = 0; n < steps; n++) {
        if (n > 0) {
            extrapolate(&past, u);
        }
        if (n % 8 == 0 || n < DEPTH) {
            inverse(u, h, B);
        }
        double before = 0.0;
        for (size_t sweep = 1;; sweep++) {
            double change = 0.0, scale = 0.0, e[12];
            residual(u, q + 6, m, h, r, impulse);
            for (int i = 0; i < 12; i++) {
                const double e0 = (B[i][0] * r[0] + B[i][1] * r[1]) + (B[i][2] * r[2] + B[i][3] * r[3]);
                const double e1 = (B[i][4] * r[4] + B[i][5] * r[5]) + (B[i][6] * r[6] + B[i][7] * r[7]);
                const double e2 = (B[i][8] * r[8] + B[i][9] * r[9]) + (B[i][10] * r[10] + B[i][11] * r[11]);
                e[i] = e0 + e1 + e2;
                u[i] -= e[i];
                change += fabs(e[i]);
                scale += fabs(u[i]);
            }
            sweeps++;
            if (before > 0.0) {
                rate = change / before;
            }
            /* the next correction is below rounding, and what the impulse then lacks, or it stands still */
            if ((change * (rate + h * h) <= 8.9e-16 * scale && rate < 0.5) || change <= 4e-16 * scale
                || (rate >= 0.5 && change <= 6e-14 * scale)) {
                follow(u, e, h, impulse);
                break;
            }
            if (sweep == 100) {
                return 0;
            }
            before = change;
        }
        const double y1[3] = {first(u, h), first(u + 1, h), first(u + 2, h)};
        const double y2[3] = {second(u, h), second(u + 1, h), second(u + 2, h)};
        turn(q, y2);
        turn(q, y1);
        for (int i = 0; i < 3; i++) {
            m[i] += impulse[i];
        }
    }
    for (int i = 0; i < 9; i++) {
        state[i] = q[i];
    }
    for (int i = 0; i < 3; i++) {
        state[9 + i] = q[3 * i] * m[0] + q[3 * i + 1] * m[1] + q[3 * i + 2] * m[2];
    }
    return sweeps;
}
