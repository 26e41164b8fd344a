/*
 * Free rigid body on SE(3), inertia (3/5, 4/5, 1), mass 2, constant momenta in space, by RKMK4 with two brackets
 * (Munthe-Kaas and Owren 1999), by hand: k2 = h f(exp(k1/2) y0), k3 = h f(exp(k2/2 - [k1,k2]/8) y0), k4 = h f(exp(k3) y0),
 * y1 = exp((k1 + 2 k2 + 2 k3 + k4 - [k1,k4]/2)/6) y0.
 *
 * The state is the attitude R and the position a. exp(w, u) moves a to a + u + c1 s + c2 (w x s + r) + c3 w x r with
 * s = w x a and r = w x u: all vectors are known before c1, c2 and c3.
 */
#include "rotation.h"
#include <stddef.h>

/* y = a x b */
static inline void cross(const double a[static 3], const double b[static 3], double y[static 3])
{
    y[0] = a[1] * b[2] - a[2] * b[1];
    y[1] = a[2] * b[0] - a[0] * b[2];
    y[2] = a[0] * b[1] - a[1] * b[0];
}

/* z = exp(x) y for the attitude y[0..8] and the position y[9..11] */
static inline void move(const double x[static 6], const double y[static 12], double z[static 12])
{
    double c1, c2, c3, s[3], r[3], t[3], b[3], E[9];
    const double *w = x, *u = x + 3, *a = y + 9;
    sinc_cosc_defect(w[0] * w[0] + w[1] * w[1] + w[2] * w[2], &c1, &c2, &c3);
    cross(w, a, s);
    cross(w, u, r);
    cross(w, s, b);
    cross(w, r, t);
    z[9] = (a[0] + u[0]) + ((c1 * s[0] + c2 * (b[0] + r[0])) + c3 * t[0]);
    z[10] = (a[1] + u[1]) + ((c1 * s[1] + c2 * (b[1] + r[1])) + c3 * t[1]);
    z[11] = (a[2] + u[2]) + ((c1 * s[2] + c2 * (b[2] + r[2])) + c3 * t[2]);
    const double s0 = c1 * w[0], s1 = c1 * w[1], s2 = c1 * w[2];
    const double xy = c2 * (w[0] * w[1]), xz = c2 * (w[0] * w[2]), yz = c2 * (w[1] * w[2]);
    const double xx = c2 * (w[0] * w[0]), yy = c2 * (w[1] * w[1]), zz = c2 * (w[2] * w[2]);
    E[0] = 1.0 - (yy + zz);
    E[1] = xy - s2;
    E[2] = xz + s1;
    E[3] = xy + s2;
    E[4] = 1.0 - (xx + zz);
    E[5] = yz - s0;
    E[6] = xz - s1;
    E[7] = yz + s0;
    E[8] = 1.0 - (xx + yy);
    z[0] = E[0] * y[0] + E[1] * y[3] + E[2] * y[6];
    z[1] = E[0] * y[1] + E[1] * y[4] + E[2] * y[7];
    z[2] = E[0] * y[2] + E[1] * y[5] + E[2] * y[8];
    z[3] = E[3] * y[0] + E[4] * y[3] + E[5] * y[6];
    z[4] = E[3] * y[1] + E[4] * y[4] + E[5] * y[7];
    z[5] = E[3] * y[2] + E[4] * y[5] + E[5] * y[8];
    z[6] = E[6] * y[0] + E[7] * y[3] + E[8] * y[6];
    z[7] = E[6] * y[1] + E[7] * y[4] + E[8] * y[7];
    z[8] = E[6] * y[2] + E[7] * y[5] + E[8] * y[8];
}

/* k = h f(y): n is the angular momentum about the centre, B = R^T n and W = I^-1 B */
static inline void field(double h, const double y[static 12], double k[static 6])
{
    const double *a = y + 9;
    const double n0 = (1.8 + a[1]) + 2.0 * a[2], n1 = (0.4 - a[0]) - a[2], n2 = (a[1] - 0.9) - 2.0 * a[0];
    const double W0 = (h * (5.0 / 3.0)) * (y[0] * n0 + y[3] * n1 + y[6] * n2);
    const double W1 = (h * 1.25) * (y[1] * n0 + y[4] * n1 + y[7] * n2);
    const double W2 = h * (y[2] * n0 + y[5] * n1 + y[8] * n2);
    double t[3];
    k[0] = y[0] * W0 + y[1] * W1 + y[2] * W2;
    k[1] = y[3] * W0 + y[4] * W1 + y[5] * W2;
    k[2] = y[6] * W0 + y[7] * W1 + y[8] * W2;
    cross(k, a, t);
    k[3] = 0.5 * h - t[0];
    k[4] = h - t[1];
    k[5] = -0.5 * h - t[2];
}

/* x += q [a, b] */
static inline void bracketed(double q, const double a[static 6], const double b[static 6], double x[static 6])
{
    double c[6], r[3], s[3], t[3];
    c[0] = q * a[0];
    c[1] = q * a[1];
    c[2] = q * a[2];
    c[3] = q * a[3];
    c[4] = q * a[4];
    c[5] = q * a[5];
    cross(c, b, r);
    cross(c, b + 3, s);
    cross(c + 3, b, t);
    x[0] += r[0];
    x[1] += r[1];
    x[2] += r[2];
    x[3] += s[0] + t[0];
    x[4] += s[1] + t[1];
    x[5] += s[2] + t[2];
}

void handwritten_run(double state[static 12], double h, size_t steps)
{
    double y[12], z[12], k1[6], k2[6], k3[6], k4[6], x[6];
    for (int i = 0; i < 12; i++) {
        y[i] = state[i];
    }
    for (size_t n = 0; n < steps; n++) {
        field(h, y, k1);
        x[0] = 0.5 * k1[0];
        x[1] = 0.5 * k1[1];
        x[2] = 0.5 * k1[2];
        x[3] = 0.5 * k1[3];
        x[4] = 0.5 * k1[4];
        x[5] = 0.5 * k1[5];
        move(x, y, z);
        field(h, z, k2);
        x[0] = 0.5 * k2[0];
        x[1] = 0.5 * k2[1];
        x[2] = 0.5 * k2[2];
        x[3] = 0.5 * k2[3];
        x[4] = 0.5 * k2[4];
        x[5] = 0.5 * k2[5];
        bracketed(-0.125, k1, k2, x);
        move(x, y, z);
        field(h, z, k3);
        move(k3, y, z);
        field(h, z, k4);
        x[0] = (1.0 / 6.0) * (k1[0] + k4[0]) + (1.0 / 3.0) * (k2[0] + k3[0]);
        x[1] = (1.0 / 6.0) * (k1[1] + k4[1]) + (1.0 / 3.0) * (k2[1] + k3[1]);
        x[2] = (1.0 / 6.0) * (k1[2] + k4[2]) + (1.0 / 3.0) * (k2[2] + k3[2]);
        x[3] = (1.0 / 6.0) * (k1[3] + k4[3]) + (1.0 / 3.0) * (k2[3] + k3[3]);
        x[4] = (1.0 / 6.0) * (k1[4] + k4[4]) + (1.0 / 3.0) * (k2[4] + k3[4]);
        x[5] = (1.0 / 6.0) * (k1[5] + k4[5]) + (1.0 / 3.0) * (k2[5] + k3[5]);
        bracketed(-1.0 / 12.0, k1, k4, x);
        move(x, y, z);
        y[0] = z[0];
        y[1] = z[1];
        y[2] = z[2];
        y[3] = z[3];
        y[4] = z[4];
        y[5] = z[5];
        y[6] = z[6];
        y[7] = z[7];
        y[8] = z[8];
        y[9] = z[9];
        y[10] = z[10];
        y[11] = z[11];
    }
    for (int i = 0; i < 12; i++) {
        state[i] = y[i];
    }
}
