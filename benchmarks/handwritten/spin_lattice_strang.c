/* One step of Strang's splitting for the scene spin_lattice, written by hand. */
#include "spin_lattice.h"

/* Anisotropy and external field turn each spin about the third axis. */
static void single(double *s, size_t n, double h)
{
    INDEPENDENT
    for (size_t i = 0; i < n; i++) {
        const double w = h * (0.5 * s[2 * n + i] + 0.2), a = w * sinc(w * w), b = w * w * cosc(w * w);
        const double x = s[i], y = s[n + i];
        s[i] = x - a * y - b * x;
        s[n + i] = y + a * x - b * y;
    }
}

/* The spins i and j turn about their sum. */
static inline void pair(double *s, size_t n, double h, size_t i, size_t j)
{
    const double p[3] = {s[i], s[n + i], s[2 * n + i]}, q[3] = {s[j], s[n + j], s[2 * n + j]};
    const double x[3] = {h * (p[0] + q[0]), h * (p[1] + q[1]), h * (p[2] + q[2])};
    double a[3], b[3];
    turn(x, p, a);
    turn(x, q, b);
    s[i] = a[0];
    s[n + i] = a[1];
    s[2 * n + i] = a[2];
    s[j] = b[0];
    s[n + j] = b[1];
    s[2 * n + j] = b[2];
}

static void rows_of(double *s, size_t rows, size_t cols, size_t first, double h)
{
    for (size_t r = first; r < rows; r += 2) {
        const size_t o = r * cols, d = (r + 1 < rows ? r + 1 : 0) * cols;
        INDEPENDENT
        for (size_t c = 0; c < cols; c++) {
            pair(s, rows * cols, h, o + c, d + c);
        }
    }
}

static void columns_of(double *s, size_t rows, size_t cols, size_t first, double h)
{
    for (size_t r = 0; r < rows; r++) {
        const size_t o = r * cols + first;
        INDEPENDENT
        for (size_t c = 0; c < (cols - first) / 2; c++) {
            pair(s, rows * cols, h, o + 2 * c, o + 2 * c + 1);
        }
        if (first) {
            pair(s, rows * cols, h, r * cols + cols - 1, r * cols);
        }
    }
}

void hand_strang(size_t rows, size_t cols, double *s, double h, size_t steps, double *work)
{
    (void)work;
    for (size_t k = 0; k < steps; k++) {
        single(s, rows * cols, h / 2);
        rows_of(s, rows, cols, 0, h / 2);
        rows_of(s, rows, cols, 1, h / 2);
        columns_of(s, rows, cols, 0, h / 2);
        columns_of(s, rows, cols, 1, h);
        columns_of(s, rows, cols, 0, h / 2);
        rows_of(s, rows, cols, 1, h / 2);
        rows_of(s, rows, cols, 0, h / 2);
        single(s, rows * cols, h / 2);
    }
}
