/*
 * Free rigid body, inertia (2, 1, 2/3), by the commutator-free method of order 4 (Celledoni, Marthinsen and
 * Owren 2003), written by hand: k = -I^-1 m, the fourth stage starts from the second.
 */
#include "rotation.h"
#include <stddef.h>

void handwritten_run(double state[static 3], double h, size_t steps)
{
    double m[3] = {state[0], state[1], state[2]};
    const double half0 = -0.25 * h, half1 = -0.5 * h, half2 = -0.75 * h;
    const double c = h / 12.0;
    for (size_t n = 0; n < steps; n++) {
        double y2[3], y3[3], y4[3], z[3];
        rotate(half0 * m[0], half1 * m[1], half2 * m[2], m, y2);
        rotate(half0 * y2[0], half1 * y2[1], half2 * y2[2], m, y3);
        rotate(half0 * (2.0 * y3[0] - m[0]), half1 * (2.0 * y3[1] - m[1]), half2 * (2.0 * y3[2] - m[2]), y2,
            y4);
        const double s0 = 2.0 * (y2[0] + y3[0]), s1 = 2.0 * (y2[1] + y3[1]), s2 = 2.0 * (y2[2] + y3[2]);
        const double r0 = -0.5 * c, r1 = -c, r2 = -1.5 * c;
        rotate(r0 * (s0 + (3.0 * m[0] - y4[0])), r1 * (s1 + (3.0 * m[1] - y4[1])),
            r2 * (s2 + (3.0 * m[2] - y4[2])), m, z);
        rotate(r0 * (s0 + (3.0 * y4[0] - m[0])), r1 * (s1 + (3.0 * y4[1] - m[1])),
            r2 * (s2 + (3.0 * y4[2] - m[2])), z, m);
    }
    for (int i = 0; i < 3; i++) {
        state[i] = m[i];
    }
}
