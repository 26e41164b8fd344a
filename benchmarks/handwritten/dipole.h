/* The dipole on a stick in the body frame: what its hand-written steps share. */
#ifndef HANDWRITTEN_DIPOLE_H
#define HANDWRITTEN_DIPOLE_H

#include "rotation.h"

static const double inertia[3] = {1.01, 1.0, 0.01};

static inline void cross(const double a[static 3], const double b[static 3], double c[static 3])
{
    c[0] = a[1] * b[2] - a[2] * b[1];
    c[1] = a[2] * b[0] - a[0] * b[2];
    c[2] = a[0] * b[1] - a[1] * b[0];
}

static inline double dot(const double a[static 3], const double b[static 3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* The functions of z for angles that are small in nearly every step: all else is called. */
static __attribute__((noinline)) void far_functions(double z, double c[static 3])
{
    sinc_cosc_defect(z, c, c + 1, c + 2);
}

static inline void functions_of(double z, double c[static 3])
{
    if (z <= TINY) {
        c[0] = tiny_1(z, z * z);
        c[1] = tiny_2(z, z * z);
        c[2] = tiny_3(z, z * z);
    } else {
        far_functions(z, c);
    }
}

/* The torque of gravity and charge, where the vertical seen from the body is g. */
static inline void torque(const double g[static 3], double t[static 3])
{
    const double p = 3.26 + 3.0 * (0.1 * g[1] - g[2]), m = 3.26 - 3.0 * (0.1 * g[1] + g[2]);
    const double u = 1.5 / (p * sqrt(p)), v = 1.5 / (m * sqrt(m));
    const double v1 = -0.1 * (u + v), v2 = u - v - 1.0;
    t[0] = g[1] * v2 - g[2] * v1;
    t[1] = -g[0] * v2;
    t[2] = g[0] * v1;
}

/* q exp(x), the new orientation from an increment seen from the body */
static inline void turn(double q[static 9], const double x[static 3])
{
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
}

#endif
