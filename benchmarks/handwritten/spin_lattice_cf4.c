/* One step of cf4 for the scene spin_lattice, written by hand. */
#include "spin_lattice.h"

/* The effective field at a site from its four neighbours */
static inline void field(const double *y, size_t n, size_t i, size_t up, size_t down, size_t left, size_t right, double k[3])
{
    k[0] = y[up] + y[down] + y[left] + y[right];
    k[1] = y[n + up] + y[n + down] + y[n + left] + y[n + right];
    k[2] = y[2 * n + up] + y[2 * n + down] + y[2 * n + left] + y[2 * n + right] + 0.5 * y[2 * n + i] + 0.2;
}

#define AT(a, i) {(a)[i], (a)[n + (i)], (a)[2 * n + (i)]}
#define PUT(a, i, x) ((a)[i] = (x)[0], (a)[n + (i)] = (x)[1], (a)[2 * n + (i)] = (x)[2])

/* Stage 2 or 3: k = field(y), new = exp(h/2 k) base */
static inline void early(const double *y, const double *base, double *k, double *new, double h, size_t n, size_t i,
    size_t up, size_t down, size_t left, size_t right)
{
    const double s[3] = AT(base, i);
    double f[3], p[3];
    field(y, n, i, up, down, left, right, f);
    const double x[3] = {0.5 * h * f[0], 0.5 * h * f[1], 0.5 * h * f[2]};
    turn(x, s, p);
    PUT(k, i, f);
    PUT(new, i, p);
}

/* Stage 4: k = field(y), new = exp(h k - h/2 k1) y2 */
static inline void third(const double *y, const double *y2, const double *k1, double *k, double *new, double h, size_t n,
    size_t i, size_t up, size_t down, size_t left, size_t right)
{
    const double s[3] = AT(y2, i), a[3] = AT(k1, i);
    double f[3], p[3];
    field(y, n, i, up, down, left, right, f);
    const double x[3] = {h * f[0] - 0.5 * h * a[0], h * f[1] - 0.5 * h * a[1], h * f[2] - 0.5 * h * a[2]};
    turn(x, s, p);
    PUT(k, i, f);
    PUT(new, i, p);
}

/* The update by two exponentials */
static inline void update(const double *y, const double *state, const double *k1, const double *k2, const double *k3,
    double *new, double h, size_t n, size_t i, size_t up, size_t down, size_t left, size_t right)
{
    const double s[3] = AT(state, i), a[3] = AT(k1, i), b[3] = AT(k2, i), c[3] = AT(k3, i);
    double d[3], x[3], z[3], p[3], q[3];
    field(y, n, i, up, down, left, right, d);
    for (int j = 0; j < 3; j++) {
        const double m = h / 6 * (b[j] + c[j]);
        x[j] = h / 4 * a[j] + m - h / 12 * d[j];
        z[j] = m - h / 12 * a[j] + h / 4 * d[j];
    }
    turn(x, s, p);
    turn(z, p, q);
    PUT(new, i, q);
}

/* All sites; the first and last site of a row have neighbours at the other end */
#define SWEEP(STAGE, ...)                                                                  \
    for (size_t r = 0; r < rows; r++) {                                                    \
        const size_t o = r * cols, u = (r ? r - 1 : rows - 1) * cols, d = (r + 1 < rows ? r + 1 : 0) * cols; \
        STAGE(__VA_ARGS__, h, n, o, u, d, o + cols - 1, o + 1);                            \
        INDEPENDENT                                                                        \
        for (size_t c = 1; c < cols - 1; c++) {                                            \
            STAGE(__VA_ARGS__, h, n, o + c, u + c, d + c, o + c - 1, o + c + 1);           \
        }                                                                                  \
        STAGE(__VA_ARGS__, h, n, o + cols - 1, u + cols - 1, d + cols - 1, o + cols - 2, o); \
    }

void hand_cf4(size_t rows, size_t cols, double *state, double h, size_t steps, double *work)
{
    const size_t n = rows * cols;
    double *k1 = work, *k2 = work + 3 * n, *k3 = work + 6 * n;
    double *y2 = work + 9 * n, *y3 = work + 12 * n, *y4 = work + 15 * n;
    for (size_t k = 0; k < steps; k++) {
        SWEEP(early, state, state, k1, y2)
        SWEEP(early, y2, state, k2, y3)
        SWEEP(third, y3, y2, k1, k3, y4)
        SWEEP(update, y4, state, k1, k2, k3, state)
    }
}
