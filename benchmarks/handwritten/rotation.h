/*
 * sin(s)/s and (1 - cos(s))/s^2 of z = s^2, and rotation of a vector: shared by the hand-written steps.
 *
 * Written for short latency: a step is one chain of rotations, so what counts is the time from an argument to
 * its result. Up to s = 1/4 a polynomial of degree five is exact to rounding; beyond, the half angle serves.
 */
#ifndef HANDWRITTEN_ROTATION_H
#define HANDWRITTEN_ROTATION_H

#include <math.h>

static inline void sinc_cosc(double z, double *c1, double *c2)
{
    if (z <= 0.0625) {
        const double w = z * z;
        const double w2 = w * w;
        *c1 = (1.0 - z * (1.0 / 6.0)) + w * (1.0 / 120.0 - z * (1.0 / 5040.0))
            + w2 * (1.0 / 362880.0 - z * (1.0 / 39916800.0));
        *c2 = (0.5 - z * (1.0 / 24.0)) + w * (1.0 / 720.0 - z * (1.0 / 40320.0))
            + w2 * (1.0 / 3628800.0 - z * (1.0 / 479001600.0));
        return;
    }
    const double half = 0.5 * sqrt(z);
    const double sine = sin(half);
    const double ratio = sine / half;
    *c1 = ratio * cos(half);
    *c2 = 0.5 * (ratio * ratio);
}

/* (1 - sin(s)/s)/s^2 of z = s^2 */
static inline double sinc_defect(double z)
{
    if (z <= 0.0625) {
        const double w = z * z;
        return (1.0 / 6.0 - z * (1.0 / 120.0)) + w * (1.0 / 5040.0 - z * (1.0 / 362880.0))
            + w * w * (1.0 / 39916800.0 - z * (1.0 / 6227020800.0));
    }
    if (z <= 4.0) {
        double sum = 0.0;
        for (int j = 11; j >= 0; j--) {
            sum = (1.0 - z * sum) / (double)((2 * j + 2) * (2 * j + 3));
        }
        return sum;
    }
    const double s = sqrt(z);
    return (1.0 - sin(s) / s) / z;
}

/* y = exp(x) m by Rodrigues' formula, without the matrix */
static inline void rotate(double a, double b, double c, const double m[static 3], double y[static 3])
{
    double c1, c2;
    sinc_cosc(a * a + b * b + c * c, &c1, &c2);
    const double u = b * m[2] - c * m[1], v = c * m[0] - a * m[2], w = a * m[1] - b * m[0];
    y[0] = m[0] + c1 * u + c2 * (b * w - c * v);
    y[1] = m[1] + c1 * v + c2 * (c * u - a * w);
    y[2] = m[2] + c1 * w + c2 * (a * v - b * u);
}

#endif
