/*
 * Dipole on a stick by VRKMK on Gauss's two stages with two brackets (order 4), by hand.
 *
 * Seen from the body at the start of the step, and with the velocities w_i = dexp^{-1}_{(2),x_i} xi_i as unknowns:
 * x_i = h sum_j a_ij w_j, y = h (w_1 + w_2)/2, xi_i = E w_i, W_i = exp(-ad_x_i) E w_i, P_i = I W_i,
 *
 *     G_i = exp(-x_i) q^T e3,  N_i = tau(G_i) + P_i x W_i,  mu_i = exp(ad_x_i) E^T P_i,  T_i = S_i - dexp_{x_i} N_i,
 *     mu_i = dexp_y (m + h (N_1 + N_2)/2) + h sum_j a_ji T_j,  q' = q exp(y),  m' = m + h (N_1 + N_2)/2,
 *
 * where E = (1 - ad_x/2 + ad_x^2/12)^{-1} and S = mu x xi/2 - (2 x mu.xi - xi mu.x - mu xi.x)/12. On SO(3) every
 * function of ad_x is 1 + b ad_x + c ad_x^2 with b and c rational in z = |x|^2 and in the Stumpff functions of z, and
 * products with ad_x are shared. The six equations are solved by Newton's method; its Jacobian to first order in h is
 * inverted in every second step. The start is extrapolated from the last solutions; the iteration ends where
 * the next correction would be below rounding.
 */
#define UNKNOWNS 6
#include "dipole.h"
#include "past.h"
#define R 0.28867513459481288225 /* sqrt(3)/6 */

static const double a11 = 0.25, a12 = 0.25 - R, a21 = 0.25 + R, a22 = 0.25;

/* The force N, the momentum mu and the slope T of one stage. */
static inline void stage(const double x[static 3], const double w[static 3], const double G0[static 3],
    double N[static 3], double mu[static 3], double T[static 3])
{
    const double z = dot(x, x);
    double k[3], v[3], vv[3], g[3], gg[3], G[3], t[3], xi[3], W[3], P[3], u[3], uu[3], s[3];
    functions_of(z, k);
    const double p = 1.0 - z * (1.0 / 12.0), d = 1.0 / (p * p + 0.25 * z);
    const double b = 0.5 * d, c = (1.0 / 6.0 + z * (1.0 / 144.0)) * d;
    const double b0 = b - k[0] - z * (k[1] * b - k[0] * c), c0 = c - k[0] * b + k[1] * (1.0 - z * c);
    cross(x, G0, g);
    cross(x, g, gg);
    cross(x, w, v);
    cross(x, v, vv);
    #pragma GCC unroll 9
    for (int i = 0; i < 3; i++) {
        G[i] = G0[i] - k[0] * g[i] + k[1] * gg[i];
        xi[i] = w[i] + b * v[i] + c * vv[i];
        W[i] = w[i] + b0 * v[i] + c0 * vv[i];
        P[i] = inertia[i] * W[i];
    }
    torque(G, t);
    cross(P, W, N);
    cross(x, P, u);
    cross(x, u, uu);
    #pragma GCC unroll 9
    for (int i = 0; i < 3; i++) {
        N[i] += t[i];
        mu[i] = P[i] - b0 * u[i] + c0 * uu[i];
    }
    cross(x, N, u);
    cross(x, u, uu);
    cross(mu, xi, s);
    const double along = dot(mu, xi) * (1.0 / 6.0), px = dot(P, x) * (1.0 / 12.0), wx = dot(w, x) * (1.0 / 12.0);
    #pragma GCC unroll 9
    for (int i = 0; i < 3; i++) {
        T[i] = 0.5 * s[i] - (along * x[i] - px * xi[i] - wx * mu[i]) - (N[i] + k[1] * u[i] + k[2] * uu[i]);
    }
}

/* What the six equations leave at w, and h/2 (N_1 + N_2). */
static inline void residual(const double w[static 6], const double G0[static 3], const double m[static 3], double h,
    double r[static 6], double impulse[static 3])
{
    double x1[3], x2[3], y[3], N1[3], N2[3], mu1[3], mu2[3], T1[3], T2[3], M[3], u[3], uu[3], k[3];
    #pragma GCC unroll 9
    for (int i = 0; i < 3; i++) {
        x1[i] = h * (a11 * w[i] + a12 * w[3 + i]);
        x2[i] = h * (a21 * w[i] + a22 * w[3 + i]);
        y[i] = 0.5 * h * (w[i] + w[3 + i]);
    }
    stage(x1, w, G0, N1, mu1, T1);
    stage(x2, w + 3, G0, N2, mu2, T2);
    functions_of(dot(y, y), k);
    #pragma GCC unroll 9
    for (int i = 0; i < 3; i++) {
        impulse[i] = 0.5 * h * (N1[i] + N2[i]);
        M[i] = m[i] + impulse[i];
    }
    cross(y, M, u);
    cross(y, u, uu);
    #pragma GCC unroll 9
    for (int i = 0; i < 3; i++) {
        const double L = M[i] + k[1] * u[i] + k[2] * uu[i];
        r[i] = mu1[i] - L - h * (a11 * T1[i] + a21 * T2[i]);
        r[3 + i] = mu2[i] - L - h * (a12 * T1[i] + a22 * T2[i]);
    }
}

/* The impulse after the correction e that led to w, up to h^2 e: its part quadratic in w follows. */
static inline void follow(const double w[static 6], const double e[static 6], double h, double impulse[static 3])
{
    #pragma GCC unroll 9
    for (int i = 0; i < 6; i += 3) {
        const double k = 0.5 * h, v0 = w[i] + 0.5 * e[i], v1 = w[i + 1] + 0.5 * e[i + 1], v2 = w[i + 2] + 0.5 * e[i + 2];
        impulse[0] -= k * (inertia[1] - inertia[2]) * (v1 * e[i + 2] + v2 * e[i + 1]);
        impulse[1] -= k * (inertia[2] - inertia[0]) * (v2 * e[i] + v0 * e[i + 2]);
        impulse[2] -= k * (inertia[0] - inertia[1]) * (v0 * e[i + 1] + v1 * e[i]);
    }
}

/* B = the inverse of the Jacobian at w to first order in h, by Gauss and Jordan in place */
static void inverse(const double w[static 6], double h, double B[static 6][6])
{
    const double W[3] = {0.5 * (w[0] + w[3]), 0.5 * (w[1] + w[4]), 0.5 * (w[2] + w[5])};
    const double L[3] = {inertia[0] * W[0], inertia[1] * W[1], inertia[2] * W[2]};
    const double a[2][2] = {{a11, a12}, {a21, a22}}, c[2] = {0.5 - R, 0.5 + R};
    #pragma GCC unroll 9
    for (int p = 0; p < 3; p++) {
        #pragma GCC unroll 9
        for (int q = 0; q < 3; q++) {
            const int o = 3 - p - q;
            const double sign = p == q ? 0.0 : (q - p + 3) % 3 == 1 ? -h : h;
            const double H = p == q ? 0.0 : sign * L[o], K = p == q ? 0.0 : sign * W[o];
            const double KI = K * inertia[q], IK = inertia[p] * K;
            #pragma GCC unroll 9
            for (int i = 0; i < 2; i++) {
                #pragma GCC unroll 9
                for (int j = 0; j < 2; j++) {
                    B[3 * i + p][3 * j + q] = 0.5 * a[i][j] * (IK - H) + 0.5 * (a[j][i] - 1.0) * (H - KI) + 0.25 * H;
                }
                B[3 * i + p][3 * i + q] += (p == q ? inertia[p] : 0.0) + 0.5 * c[i] * (KI - IK);
            }
        }
    }
    #pragma GCC unroll 9
    for (int k = 0; k < 6; k++) {
        const double d = 1.0 / B[k][k];
        B[k][k] = 1.0;
        #pragma GCC unroll 9
        for (int j = 0; j < 6; j++) {
            B[k][j] *= d;
        }
        #pragma GCC unroll 9
        for (int i = 0; i < 6; i++) {
            if (i != k) {
                const double f = B[i][k];
                B[i][k] = 0.0;
                #pragma GCC unroll 9
                for (int j = 0; j < 6; j++) {
                    B[i][j] -= f * B[k][j];
                }
            }
        }
    }
}

size_t handwritten_run(double state[static 12], double h, size_t steps)
{
    double q[9], m[3], w[6], r[6], impulse[3], B[6][6];
    struct past past;
    double rate = 1.0;
    size_t sweeps = 0;
    forget(&past);
    #pragma GCC unroll 9
    for (int i = 0; i < 9; i++) {
        q[i] = state[i];
    }
    #pragma GCC unroll 9
    for (int i = 0; i < 3; i++) {
        m[i] = q[i] * state[9] + q[3 + i] * state[10] + q[6 + i] * state[11];
        w[i] = w[3 + i] = m[i] / inertia[i];
    }
    for (size_t n = 0; n < steps; n++) {
        if (n > 0) {
            extrapolate(&past, w);
        }
        if (n % 2 == 0 || n < DEPTH) {
            inverse(w, h, B);
        }
        double before = 0.0;
        for (size_t sweep = 1;; sweep++) {
            double change = 0.0, scale = 0.0, e[6];
            residual(w, q + 6, m, h, r, impulse);
            #pragma GCC unroll 9
            for (int i = 0; i < 6; i++) {
                e[i] = (B[i][0] * r[0] + B[i][1] * r[1]) + (B[i][2] * r[2] + B[i][3] * r[3])
                    + (B[i][4] * r[4] + B[i][5] * r[5]);
                w[i] -= e[i];
                change += fabs(e[i]);
                scale += fabs(w[i]);
            }
            sweeps++;
            if (before > 0.0) {
                rate = change / before;
            }
            /* the next correction is below rounding, and what the impulse then lacks, or it stands still */
            if ((change * (rate + h * h) <= 8.9e-16 * scale && rate < 0.5) || change <= 4e-16 * scale
                || (rate >= 0.5 && change <= 6e-14 * scale)) {
                follow(w, e, h, impulse);
                break;
            }
            if (sweep == 100) {
                return 0;
            }
            before = change;
        }
        const double y[3] = {0.5 * h * (w[0] + w[3]), 0.5 * h * (w[1] + w[4]), 0.5 * h * (w[2] + w[5])};
        turn(q, y);
        #pragma GCC unroll 9
        for (int i = 0; i < 3; i++) {
            m[i] += impulse[i];
        }
    }
    #pragma GCC unroll 9
    for (int i = 0; i < 9; i++) {
        state[i] = q[i];
    }
    #pragma GCC unroll 9
    for (int i = 0; i < 3; i++) {
        state[9 + i] = q[3 * i] * m[0] + q[3 * i + 1] * m[1] + q[3 * i + 2] * m[2];
    }
    return sweeps;
}
