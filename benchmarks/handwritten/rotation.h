/*
 * sin(s)/s, (1 - cos(s))/s^2 and (s - sin(s))/s^3 of z = s^2, and rotation of a vector: shared by the hand-written steps.
 *
 * Written for short latency: a step is one chain of rotations, so what counts is the time from an argument to
 * its result. Up to s = 1/16 polynomials of degree three have a relative error below 6e-18, up to s = 1/4 those of
 * degree four one below 6e-17 (minimax, the value at zero kept); beyond, the half angle serves.
 */
#ifndef HANDWRITTEN_ROTATION_H
#define HANDWRITTEN_ROTATION_H

#include <math.h>

#define TINY 0.00390625
#define SMALL 0.0625

static inline double tiny_1(double z, double w)
{
    return (1.0 - z * 0.16666666666663651) + w * (0.008333333286511445 - z * 0.00019839202130765885);
}

static inline double tiny_2(double z, double w)
{
    return (0.5 - z * 0.04166666666666365) + w * (0.0013888888842068662 - z * 2.479951961412866e-05);
}

static inline double tiny_3(double z, double w)
{
    return (0.16666666666666666 - z * 0.008333333333333059) + w * (0.00019841269798706425 - z * 2.755543951073856e-06);
}

static inline double small_1(double z, double w)
{
    return (1.0 - z * 0.16666666666663993)
        + w * ((0.008333333329181914 - z * 0.00019841249796395693) + w * 2.7519163069776255e-06);
}

static inline double small_2(double z, double w)
{
    return (0.5 - z * 0.041666666666664444)
        + w * ((0.001388888888543239 - z * 2.4801570605100115e-05) + w * 2.7525527501314537e-07);
}

static inline double small_3(double z, double w)
{
    return (0.16666666666666666 - z * 0.008333333333333161)
        + w * ((0.00019841269838611768 - z * 2.755730638220446e-06) + w * 2.5027653846910286e-08);
}

static inline void sinc_cosc(double z, double *c1, double *c2)
{
    if (z <= TINY) {
        *c1 = tiny_1(z, z * z);
        *c2 = tiny_2(z, z * z);
        return;
    }
    if (z <= SMALL) {
        *c1 = small_1(z, z * z);
        *c2 = small_2(z, z * z);
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
    if (z <= TINY) {
        return tiny_3(z, z * z);
    }
    if (z <= SMALL) {
        return small_3(z, z * z);
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

/* all three, by one branch where z is small */
static inline void sinc_cosc_defect(double z, double *c1, double *c2, double *c3)
{
    if (z <= TINY) {
        *c1 = tiny_1(z, z * z);
        *c2 = tiny_2(z, z * z);
        *c3 = tiny_3(z, z * z);
        return;
    }
    if (z <= SMALL) {
        *c1 = small_1(z, z * z);
        *c2 = small_2(z, z * z);
        *c3 = small_3(z, z * z);
        return;
    }
    sinc_cosc(z, c1, c2);
    *c3 = sinc_defect(z);
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
