/*
 * Free rigid body, inertia (2, 1, 2/3), by RKMK4 with two brackets (Munthe-Kaas and Owren 1999), by hand:
 * k3 = h f(exp(k2/2 - [k1,k2]/8) y0), y1 = exp((k1 + 2 k2 + 2 k3 + k4 - [k1,k4]/2)/6) y0.
 */
#include "rotation.h"
#include <stddef.h>

void handwritten_run(double state[static 3], double h, size_t steps)
{
    double m[3] = {state[0], state[1], state[2]};
    const double e0 = -0.5 * h, e1 = -h, e2 = -1.5 * h;
    for (size_t n = 0; n < steps; n++) {
        double y[3];
        const double a0 = e0 * m[0], a1 = e1 * m[1], a2 = e2 * m[2];
        rotate(0.5 * a0, 0.5 * a1, 0.5 * a2, m, y);
        const double b0 = e0 * y[0], b1 = e1 * y[1], b2 = e2 * y[2];
        rotate(0.5 * b0 - 0.125 * (a1 * b2 - a2 * b1), 0.5 * b1 - 0.125 * (a2 * b0 - a0 * b2),
            0.5 * b2 - 0.125 * (a0 * b1 - a1 * b0), m, y);
        const double c0 = e0 * y[0], c1 = e1 * y[1], c2 = e2 * y[2];
        rotate(c0, c1, c2, m, y);
        const double d0 = e0 * y[0], d1 = e1 * y[1], d2 = e2 * y[2];
        const double sixth = 1.0 / 6.0;
        const double x0 = sixth * ((a0 + 2.0 * (b0 + c0)) + (d0 - 0.5 * (a1 * d2 - a2 * d1)));
        const double x1 = sixth * ((a1 + 2.0 * (b1 + c1)) + (d1 - 0.5 * (a2 * d0 - a0 * d2)));
        const double x2 = sixth * ((a2 + 2.0 * (b2 + c2)) + (d2 - 0.5 * (a0 * d1 - a1 * d0)));
        rotate(x0, x1, x2, m, y);
        m[0] = y[0];
        m[1] = y[1];
        m[2] = y[2];
    }
    for (int i = 0; i < 3; i++) {
        state[i] = m[i];
    }
}
