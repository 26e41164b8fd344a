/*
 * Free rigid body, inertia (2, 1, 2/3), by RKMK4 with two brackets (Munthe-Kaas and Owren 1999), by hand:
 * k3 = h f(exp(k2/2 - [k1,k2]/8) y0), y1 = exp((k1 + 2 k2 + 2 k3 + k4 - [k1,k4]/2)/6) y0.
 *
 * A step is one chain from each angle to the next. Every exponent is linear in the stage before it, which is
 * m + c1 x cross m + c2 x cross (x cross m): it is written as a sum over c1 and c2, whose factors are ready before
 * these are.
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

/* y = p k + q a cross k */
static inline void bracketed(double p, double q, const double a[static 3], const double k[static 3], double y[static 3])
{
    const double r0 = q * k[0], r1 = q * k[1], r2 = q * k[2];
    y[0] = p * k[0] + (a[1] * r2 - a[2] * r1);
    y[1] = p * k[1] + (a[2] * r0 - a[0] * r2);
    y[2] = p * k[2] + (a[0] * r1 - a[1] * r0);
}

void handwritten_run(double state[static 3], double h, size_t steps)
{
    const double e0 = -0.5 * h, e1 = -h, e2 = -1.5 * h, sixth = 1.0 / 6.0, twelfth = -1.0 / 12.0;
    double m0 = state[0], m1 = state[1], m2 = state[2];
    double a0 = e0 * m0, a1 = e1 * m1, a2 = e2 * m2; /* h f(y0) */
    for (size_t n = 0; n < steps; n++) {
        const double m[3] = {m0, m1, m2}, a[3] = {a0, a1, a2};
        double u[3], v[3], U[3], V[3], c1, c2;

        const double x2[3] = {0.5 * a0, 0.5 * a1, 0.5 * a2};
        sinc_cosc(square(x2), &c1, &c2);
        turns(x2, m, u, v);
        const double eu2[3] = {e0 * u[0], e1 * u[1], e2 * u[2]}, ev2[3] = {e0 * v[0], e1 * v[1], e2 * v[2]};
        bracketed(0.5, -0.125, a, eu2, U);
        bracketed(0.5, -0.125, a, ev2, V);
        const double b0 = c1 * eu2[0] + c2 * ev2[0], b1 = c1 * eu2[1] + c2 * ev2[1], b2 = c1 * eu2[2] + c2 * ev2[2];

        const double x3[3]
            = {(x2[0] + c1 * U[0]) + c2 * V[0], (x2[1] + c1 * U[1]) + c2 * V[1], (x2[2] + c1 * U[2]) + c2 * V[2]};
        sinc_cosc(square(x3), &c1, &c2);
        turns(x3, m, u, v);
        const double d0 = c1 * (e0 * u[0]) + c2 * (e0 * v[0]), d1 = c1 * (e1 * u[1]) + c2 * (e1 * v[1]),
                     d2 = c1 * (e2 * u[2]) + c2 * (e2 * v[2]);

        const double x4[3] = {a0 + d0, a1 + d1, a2 + d2};
        sinc_cosc(square(x4), &c1, &c2);
        turns(x4, m, u, v);
        const double eu4[3] = {e0 * u[0], e1 * u[1], e2 * u[2]}, ev4[3] = {e0 * v[0], e1 * v[1], e2 * v[2]};
        bracketed(sixth, twelfth, a, eu4, U);
        bracketed(sixth, twelfth, a, ev4, V);

        const double third = 1.0 / 3.0;
        const double x[3] = {((a0 + third * (b0 + d0)) + c1 * U[0]) + c2 * V[0],
            ((a1 + third * (b1 + d1)) + c1 * U[1]) + c2 * V[1], ((a2 + third * (b2 + d2)) + c1 * U[2]) + c2 * V[2]};
        sinc_cosc(square(x), &c1, &c2);
        turns(x, m, u, v);
        a0 = (a0 + c1 * (e0 * u[0])) + c2 * (e0 * v[0]);
        a1 = (a1 + c1 * (e1 * u[1])) + c2 * (e1 * v[1]);
        a2 = (a2 + c1 * (e2 * u[2])) + c2 * (e2 * v[2]);
        m0 = (m0 + c1 * u[0]) + c2 * v[0];
        m1 = (m1 + c1 * u[1]) + c2 * v[1];
        m2 = (m2 + c1 * u[2]) + c2 * v[2];
    }
    state[0] = m0;
    state[1] = m1;
    state[2] = m2;
}
