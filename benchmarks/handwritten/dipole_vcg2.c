/*
 * Dipole on a stick by VCG on the midpoint rule, by hand.
 *
 * In the body frame the six unknowns (xi, n) become three: with xi = Q W, n = Q N, y = h W/2 and m = q^T mu,
 *
 *     Q = q exp(y),   N = tau(G) + I W x W,   G = exp(-y) q^T e3,   P = m + h N/2,
 *     I W = P + (h/2) c2 y x N + c3 y x (y x P),
 *     q' = q exp(2 y),   m' = m + h N,
 *
 * because exp(-ad_y) dexp_{2y} is even and dexp_{2y} exp(-ad_y) - (1 - exp(-ad_y))/(2 ad_y) = dexp_y/2. Only
 * q^T e3 enters the equation. It is solved by Newton's method with the Jacobian to first order in h, from the
 * extrapolation of the last three solutions, until the next correction would be below rounding.
 */
#include "rotation.h"
#include <stddef.h>

static const double inertia[3] = {1.01, 1.0, 0.01};

static inline void torque(const double g[static 3], double t[static 3])
{
    const double p = 3.26 + 3.0 * (0.1 * g[1] - g[2]), m = 3.26 - 3.0 * (0.1 * g[1] + g[2]);
    const double u = 1.5 / (p * sqrt(p)), v = 1.5 / (m * sqrt(m));
    const double v1 = -0.1 * (u + v), v2 = u - v - 1.0;
    t[0] = g[1] * v2 - g[2] * v1;
    t[1] = -g[0] * v2;
    t[2] = g[0] * v1;
}

static inline void cross(const double a[static 3], const double b[static 3], double c[static 3])
{
    c[0] = a[1] * b[2] - a[2] * b[1];
    c[1] = a[2] * b[0] - a[0] * b[2];
    c[2] = a[0] * b[1] - a[1] * b[0];
}

/* Solve for W from the start in w; return the number of evaluations, 0 where it does not converge. */
static inline size_t solve(const double G0[static 3], const double m[static 3], double h, double w[static 3],
    double N[static 3])
{
    const double k = 0.5 * h;
    double before = 0.0;
    double a00 = 0, a01 = 0, a02 = 0, a10 = 0, a11 = 0, a12 = 0, a20 = 0, a21 = 0, a22 = 0;
    for (size_t sweep = 1; sweep <= 100; sweep++) {
        const double y[3] = {k * w[0], k * w[1], k * w[2]};
        const double L[3] = {inertia[0] * w[0], w[1], inertia[2] * w[2]};
        const double z = y[0] * y[0] + y[1] * y[1] + y[2] * y[2];
        double c1, c2, u[3], v[3], G[3], t[3], P[3], F[3];
        sinc_cosc(z, &c1, &c2);
        const double c3 = sinc_defect(z);
        cross(y, G0, u);
        cross(y, u, v);
        for (int i = 0; i < 3; i++) {
            G[i] = G0[i] - c1 * u[i] + c2 * v[i];
        }
        torque(G, t);
        cross(L, w, N);
        for (int i = 0; i < 3; i++) {
            N[i] += t[i];
            P[i] = m[i] + k * N[i];
        }
        cross(y, P, u);
        cross(y, u, v);
        cross(y, N, u);
        for (int i = 0; i < 3; i++) {
            F[i] = L[i] - (P[i] + k * c2 * u[i] + c3 * v[i]);
        }
        if (sweep == 1) {
            /* inverse of I + (h/2) (hat(W) I - hat(I W)), by columns of cofactors */
            const double j01 = k * (L[2] - w[2]), j02 = k * (inertia[2] * w[1] - L[1]);
            const double j10 = k * (inertia[0] * w[2] - L[2]), j12 = k * (L[0] - inertia[2] * w[0]);
            const double j20 = k * (L[1] - inertia[0] * w[1]), j21 = k * (w[0] - L[0]);
            const double j00 = inertia[0], j11 = inertia[1], j22 = inertia[2];
            a00 = j11 * j22 - j12 * j21;
            a10 = j12 * j20 - j10 * j22;
            a20 = j10 * j21 - j11 * j20;
            const double d = 1.0 / (j00 * a00 + j01 * a10 + j02 * a20);
            a00 *= d;
            a10 *= d;
            a20 *= d;
            a01 = d * (j02 * j21 - j01 * j22);
            a11 = d * (j00 * j22 - j02 * j20);
            a21 = d * (j01 * j20 - j00 * j21);
            a02 = d * (j01 * j12 - j02 * j11);
            a12 = d * (j02 * j10 - j00 * j12);
            a22 = d * (j00 * j11 - j01 * j10);
        }
        const double e[3] = {a00 * F[0] + a01 * F[1] + a02 * F[2], a10 * F[0] + a11 * F[1] + a12 * F[2],
            a20 * F[0] + a21 * F[1] + a22 * F[2]};
        const double change = fabs(e[0]) + fabs(e[1]) + fabs(e[2]);
        const double rate = before > 0.0 ? change / before : 1.0;
        for (int i = 0; i < 3; i++) {
            w[i] -= e[i];
        }
        const double scale = 1.0 + fabs(w[0]) + fabs(w[1]) + fabs(w[2]);
        if (change * (rate + h * h) <= 2e-16 * scale && rate < 0.5) {
            /* the part of N that is quadratic in W is kept exact, the rest moves by h times the correction */
            const double K[3] = {inertia[0] * w[0], w[1], inertia[2] * w[2]};
            double s[3], o[3];
            cross(K, w, s);
            const double p[3] = {w[0] + e[0], w[1] + e[1], w[2] + e[2]};
            cross(L, p, o);
            for (int i = 0; i < 3; i++) {
                N[i] += s[i] - o[i];
            }
            return sweep;
        }
        if (change <= 4e-16 * scale || (change <= 6e-14 * scale && rate >= 0.5)) {
            return sweep; /* it stands still at rounding level */
        }
        before = change;
    }
    return 0;
}

size_t handwritten_run(double state[static 12], double h, size_t steps)
{
    double q[9], m[3], w1[3], w2[3], w3[3], w[3], N[3];
    size_t sweeps = 0;
    for (int i = 0; i < 9; i++) {
        q[i] = state[i];
    }
    for (int i = 0; i < 3; i++) {
        m[i] = q[i] * state[9] + q[3 + i] * state[10] + q[6 + i] * state[11];
        w[i] = m[i] / inertia[i];
    }
    for (size_t n = 0; n < steps; n++) {
        for (int i = 0; i < 3; i++) {
            w3[i] = n > 1 ? w2[i] : w[i];
            w2[i] = n > 0 ? w1[i] : w[i];
            w1[i] = w[i];
            w[i] = n > 2 ? 3.0 * (w1[i] - w2[i]) + w3[i] : w[i];
        }
        const size_t made = solve(q + 6, m, h, w, N);
        if (made == 0) {
            return 0;
        }
        sweeps += made;
        const double x[3] = {h * w[0], h * w[1], h * w[2]};
        double c1, c2;
        sinc_cosc(x[0] * x[0] + x[1] * x[1] + x[2] * x[2], &c1, &c2);
        const double a = c1 * x[0], b = c1 * x[1], c = c1 * x[2];
        const double xy = c2 * x[0] * x[1], xz = c2 * x[0] * x[2], yz = c2 * x[1] * x[2];
        const double xx = c2 * x[0] * x[0], yy = c2 * x[1] * x[1], zz = c2 * x[2] * x[2];
        const double E[9] = {1.0 - (yy + zz), xy - c, xz + b, xy + c, 1.0 - (xx + zz), yz - a, xz - b, yz + a,
            1.0 - (xx + yy)};
        for (int i = 0; i < 9; i += 3) {
            const double r0 = q[i], r1 = q[i + 1], r2 = q[i + 2];
            q[i] = r0 * E[0] + r1 * E[3] + r2 * E[6];
            q[i + 1] = r0 * E[1] + r1 * E[4] + r2 * E[7];
            q[i + 2] = r0 * E[2] + r1 * E[5] + r2 * E[8];
        }
        for (int i = 0; i < 3; i++) {
            m[i] += h * N[i];
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
