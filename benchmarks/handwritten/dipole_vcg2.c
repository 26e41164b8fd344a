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
 * extrapolation of the last solutions, until the next correction would be below rounding.
 */
#define UNKNOWNS 3
#include "dipole.h"
#include "past.h"

/* Solve for W from the start in w; return the number of evaluations, 0 where it does not converge. */
static inline size_t solve(const double G0[static 3], const double m[static 3], double h, double w[static 3],
    double N[static 3], double *rate)
{
    const double k = 0.5 * h;
    double before = 0.0;
    double a00 = 0, a01 = 0, a02 = 0, a10 = 0, a11 = 0, a12 = 0, a20 = 0, a21 = 0, a22 = 0;
    for (size_t sweep = 1; sweep <= 100; sweep++) {
        const double y[3] = {k * w[0], k * w[1], k * w[2]};
        const double L[3] = {inertia[0] * w[0], w[1], inertia[2] * w[2]};
        const double z = y[0] * y[0] + y[1] * y[1] + y[2] * y[2];
        double c[3], u[3], v[3], G[3], t[3], P[3], F[3];
        functions_of(z, c);
        const double c1 = c[0], c2 = c[1], c3 = c[2];
        cross(y, G0, u);
        cross(y, u, v);
        #pragma GCC unroll 3
        for (int i = 0; i < 3; i++) {
            G[i] = G0[i] - c1 * u[i] + c2 * v[i];
        }
        torque(G, t);
        cross(L, w, N);
        #pragma GCC unroll 3
        for (int i = 0; i < 3; i++) {
            N[i] += t[i];
            P[i] = m[i] + k * N[i];
        }
        cross(y, P, u);
        cross(y, u, v);
        cross(y, N, u);
        #pragma GCC unroll 3
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
        if (before > 0.0) {
            *rate = change / before;
        }
        #pragma GCC unroll 3
        for (int i = 0; i < 3; i++) {
            w[i] -= e[i];
        }
        const double scale = fabs(w[0]) + fabs(w[1]) + fabs(w[2]);
        if (change * (*rate + h * h) <= 8.9e-16 * scale && *rate < 0.5) {
            /* the part of N that is quadratic in W is kept exact, the rest moves by h times the correction */
            const double K[3] = {inertia[0] * w[0], w[1], inertia[2] * w[2]};
            double s[3], o[3];
            cross(K, w, s);
            const double p[3] = {w[0] + e[0], w[1] + e[1], w[2] + e[2]};
            cross(L, p, o);
            #pragma GCC unroll 3
            for (int i = 0; i < 3; i++) {
                N[i] += s[i] - o[i];
            }
            return sweep;
        }
        if (change <= 4e-16 * scale || (change <= 6e-14 * scale && *rate >= 0.5)) {
            return sweep; /* it stands still at rounding level */
        }
        before = change;
    }
    return 0;
}

size_t handwritten_run(double state[static 12], double h, size_t steps)
{
    double q[9], m[3], w[3], N[3], rate = 1.0;
    size_t sweeps = 0;
    struct past past;
    forget(&past);
    for (int i = 0; i < 9; i++) {
        q[i] = state[i];
    }
    #pragma GCC unroll 3
    for (int i = 0; i < 3; i++) {
        m[i] = q[i] * state[9] + q[3 + i] * state[10] + q[6 + i] * state[11];
        w[i] = m[i] / inertia[i];
    }
    for (size_t n = 0; n < steps; n++) {
        if (n > 0) {
            extrapolate(&past, w);
        }
        const size_t made = solve(q + 6, m, h, w, N, &rate);
        if (made == 0) {
            return 0;
        }
        sweeps += made;
        const double x[3] = {h * w[0], h * w[1], h * w[2]};
        turn(q, x);
        #pragma GCC unroll 3
        for (int i = 0; i < 3; i++) {
            m[i] += h * N[i];
        }
    }
    for (int i = 0; i < 9; i++) {
        state[i] = q[i];
    }
    #pragma GCC unroll 3
    for (int i = 0; i < 3; i++) {
        state[9 + i] = q[3 * i] * m[0] + q[3 * i + 1] * m[1] + q[3 * i + 2] * m[2];
    }
    return sweeps;
}
