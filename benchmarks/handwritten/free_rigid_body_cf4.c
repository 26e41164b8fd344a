/*
 * Free rigid body, inertia (2, 1, 2/3), by the commutator-free method of order 4 (Celledoni, Marthinsen and
 * Owren 2003), by hand: k = -h I^-1 m, the fourth stage starts from the second.
 *
 * A step is one chain from each angle to the next. Every exponent is linear in the stage before it, which is
 * m + c1 x cross m + c2 x cross (x cross m): it is written as a sum over c1 and c2, whose factors are ready before
 * these are. The two exponents of the update are ready together.
 */
#include "rotation.h"
#include <stddef.h>

/* u = x cross m and v = x cross u */
static inline void turns(const double x[static 3], const double m[static 3], double u[static 3], double v[static 3])
{
    u[0] = x[1] * m[2] - x[2] * m[1];
    u[1] = x[2] * m[0] - x[0] * m[2];
    u[2] = x[0] * m[1] - x[1] * m[0];
    v[0] = x[1] * u[2] - x[2] * u[1];
    v[1] = x[2] * u[0] - x[0] * u[2];
    v[2] = x[0] * u[1] - x[1] * u[0];
}

static inline double square(const double x[static 3])
{
    return x[0] * x[0] + x[1] * x[1] + x[2] * x[2];
}

void handwritten_run(double state[static 3], double h, size_t steps)
{
    const double e0 = -0.5 * h, e1 = -h, e2 = -1.5 * h;
    double m0 = state[0], m1 = state[1], m2 = state[2];
    for (size_t n = 0; n < steps; n++) {
        const double m[3] = {m0, m1, m2};
        const double a0 = e0 * m0, a1 = e1 * m1, a2 = e2 * m2;
        double u[3], v[3], c1, c2, s1, s2;

        const double x2[3] = {0.5 * a0, 0.5 * a1, 0.5 * a2};
        sinc_cosc(square(x2), &c1, &c2);
        turns(x2, m, u, v);
        const double y2[3]
            = {(m0 + c1 * u[0]) + c2 * v[0], (m1 + c1 * u[1]) + c2 * v[1], (m2 + c1 * u[2]) + c2 * v[2]};
        const double f0 = 0.5 * e0, f1 = 0.5 * e1, f2 = 0.5 * e2;
        const double x3[3] = {(x2[0] + c1 * (f0 * u[0])) + c2 * (f0 * v[0]),
            (x2[1] + c1 * (f1 * u[1])) + c2 * (f1 * v[1]), (x2[2] + c1 * (f2 * u[2])) + c2 * (f2 * v[2])};

        sinc_cosc(square(x3), &c1, &c2);
        turns(x3, m, u, v);
        const double x4[3] = {(x2[0] + c1 * (e0 * u[0])) + c2 * (e0 * v[0]),
            (x2[1] + c1 * (e1 * u[1])) + c2 * (e1 * v[1]), (x2[2] + c1 * (e2 * u[2])) + c2 * (e2 * v[2])};

        sinc_cosc(square(x4), &c1, &c2);
        turns(x4, y2, u, v);
        /* b = h f(y2) = 2 x3, c = x4 + a/2, d = b + ...: the exponents (3a + 2b + 2c - d)/12, (-a + 2b + 2c + 3d)/12 */
        const double sixth = 1.0 / 6.0, third = 1.0 / 3.0, p = -1.0 / 12.0, q = 0.25;
        const double U[3] = {e0 * u[0], e1 * u[1], e2 * u[2]}, V[3] = {e0 * v[0], e1 * v[1], e2 * v[2]};
        double x[3], y[3];
        const double A[3] = {a0, a1, a2};
        #pragma GCC unroll 3
        for (int i = 0; i < 3; i++) {
            const double s = sixth * (x3[i] + x4[i]);
            x[i] = ((third * A[i] + s) + c1 * (p * U[i])) + c2 * (p * V[i]);
            y[i] = ((5.0 * sixth * x3[i] + sixth * x4[i]) + c1 * (q * U[i])) + c2 * (q * V[i]);
        }
        sinc_cosc(square(x), &c1, &c2);
        sinc_cosc(square(y), &s1, &s2);
        turns(x, m, u, v);
        const double z0 = (m0 + c1 * u[0]) + c2 * v[0], z1 = (m1 + c1 * u[1]) + c2 * v[1],
                     z2 = (m2 + c1 * u[2]) + c2 * v[2];
        /* exp(y) as a matrix, which is ready when z is */
        const double g0 = s1 * y[0], g1 = s1 * y[1], g2 = s1 * y[2];
        const double r0 = s2 * y[0], r1 = s2 * y[1], r2 = s2 * y[2];
        const double yy0 = r0 * y[0], yy1 = r1 * y[1], yy2 = r2 * y[2];
        const double y01 = r0 * y[1], y02 = r0 * y[2], y12 = r1 * y[2];
        m0 = (1.0 - (yy1 + yy2)) * z0 + ((y01 - g2) * z1 + (y02 + g1) * z2);
        m1 = (1.0 - (yy0 + yy2)) * z1 + ((y01 + g2) * z0 + (y12 - g0) * z2);
        m2 = (1.0 - (yy0 + yy1)) * z2 + ((y02 - g1) * z0 + (y12 + g0) * z1);
    }
    state[0] = m0;
    state[1] = m1;
    state[2] = m2;
}
