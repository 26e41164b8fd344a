/* Loops for Heisenberg spins on a periodic plane lattice, written by hand (benchmarks/lattice.py). */
#include <stddef.h>

#if defined(__clang__)
#define INDEPENDENT _Pragma("clang loop vectorize(assume_safety)")
#else
#define INDEPENDENT _Pragma("GCC ivdep")
#endif

/* sin(s)/s and (1 - cos(s))/s^2 for z = s^2 <= 1, by their Taylor polynomials of degree 8 in z */
static inline double sinc(double z)
{
    return 1.0 + z * (-1.0 / 6 + z * (1.0 / 120 + z * (-1.0 / 5040 + z * (1.0 / 362880 + z * (-1.0 / 39916800
        + z * (1.0 / 6227020800.0 + z * (-1.0 / 1307674368000.0 + z * (1.0 / 355687428096000.0))))))));
}

static inline double cosc(double z)
{
    return 0.5 + z * (-1.0 / 24 + z * (1.0 / 720 + z * (-1.0 / 40320 + z * (1.0 / 3628800 + z * (-1.0 / 479001600
        + z * (1.0 / 87178291200.0 + z * (-1.0 / 20922789888000.0 + z * (1.0 / 6402373705728000.0))))))));
}

/* y = exp(x) s: the rotation of s about x by the angle |x| */
static inline void turn(const double x[3], const double s[3], double y[3])
{
    const double z = x[0] * x[0] + x[1] * x[1] + x[2] * x[2], a = sinc(z), b = cosc(z);
    const double u = x[1] * s[2] - x[2] * s[1], v = x[2] * s[0] - x[0] * s[2], w = x[0] * s[1] - x[1] * s[0];
    y[0] = s[0] + a * u + b * (x[1] * w - x[2] * v);
    y[1] = s[1] + a * v + b * (x[2] * u - x[0] * w);
    y[2] = s[2] + a * w + b * (x[0] * v - x[1] * u);
}
