/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Summing Gale's series in one arithmetic. Included once for each by series_terms.c, which
 * defines REAL, EPSILON and NAME(): a power series loses digits to cancellation as its
 * frequency grows, and only a wider arithmetic gives them back. No include guard, on purpose.
 */

/* Coefficients of the solutions about one point. */
typedef struct NAME(expansion) {
    const REAL *c; /* of solution j from c + j * room */
    int room, terms;
} NAME(expansion);

/* The solutions of one frequency. */
typedef struct NAME(solutions) {
    const series_problem *problem;
    REAL w2;
    NAME(expansion) zero, two;
    REAL alpha[4][4]; /* [ZR]^-1 [YR]: constants A_i of C_j  [2.66, 2.103] */
} NAME(solutions);

static REAL NAME(size)(REAL x)
{
    return x < 0 ? -x : x;
}

/* Newton's method from the double root; <math.h> knows no quadruple one. */
static REAL NAME(root)(REAL x)
{
    REAL r = (REAL)sqrt((double)x);
    for (int i = 0; i < 2 && r > 0; i++)
        r = (r + x / r) / 2;
    return r;
}

/* Coefficients of every solution until a term, tripled by differentiation, no longer counts;
 * false when that takes too many. */
static bool NAME(expand)(series_recursion *r, REAL w2, REAL *c, NAME(expansion) * out)
{
    const REAL reach = (REAL)r->reach;
    REAL power = 1, largest[4] = {0};
    int quiet = 0;
    for (int k = 0; k < r->room; k++) {
        series_recursion_extend(r, k);
        bool small = true;
        for (int j = 0; j < r->order; j++) {
            REAL *cj = c + (size_t)j * (size_t)r->room, sum = 0;
            if (k < (r->singular ? 1 : r->order)) {
                cj[k] = k == (r->singular ? 0 : j);
            } else {
                const series_row *row =
                    &r->rows[(r->singular ? (size_t)j * (size_t)r->room : 0) + (size_t)k];
                for (int i = 0; i < SERIES_LAGS && i < k; i++)
                    sum += ((REAL)row->steady[i] + w2 * (REAL)row->inertial[i]) * cj[k - 1 - i];
                cj[k] = -sum / (REAL)row->lead;
            }
            const REAL term = NAME(size)(cj[k]) * power;
            if (term > largest[j])
                largest[j] = term;
            small = small && term * k * k * k < EPSILON * (1 - reach) * largest[j];
        }
        power *= reach;
        quiet = small ? quiet + 1 : 0;
        if (quiet > SERIES_LAGS) {
            *out = (NAME(expansion)){c, r->room, k + 1};
            return true;
        }
    }
    return false;
}

/* sum c_k x^k and its first three derivatives. */
static void NAME(polynomial)(const NAME(expansion) * e, int j, REAL x, REAL d[4])
{
    const REAL *c = e->c + (size_t)j * (size_t)e->room;
    REAL a0 = 0, a1 = 0, a2 = 0, a3 = 0;
    for (int k = e->terms - 1; k >= 0; k--) {
        a3 = a3 * x + a2;
        a2 = a2 * x + a1;
        a1 = a1 * x + a0;
        a0 = a0 * x + c[k];
    }
    d[0] = a0;
    d[1] = a1;
    d[2] = 2 * a2;
    d[3] = 6 * a3;
}

/*
 * y_j and its derivatives by chi. In s = sqrt(xi) the Frobenius series are ordinary power
 * series, y_j = s^j B(s^2), and with cosh chi = 1 + s^2, sinh chi = s g, g = sqrt(2 + s^2), so
 * is everything else: nothing is singular at the lowest point, where Gale's derivatives by xi
 * are.
 */
static void NAME(near_zero)(const NAME(expansion) * e, int j, REAL xi, REAL u[4])
{
    static const int binomial[4][4] = {{1}, {1, 1}, {1, 2, 1}, {1, 3, 3, 1}};
    const REAL s = NAME(root)(xi), g2 = 2 + xi, g = NAME(root)(g2);
    REAL a[4], power[4], y[4];
    NAME(polynomial)(e, j, xi, a);
    const REAL b[4] = {a[0], 2 * s * a[1], 2 * a[1] + 4 * xi * a[2],
                       s * (12 * a[2] + 8 * xi * a[3])};
    for (int i = 0; i < 4; i++) { /* derivatives of s^j */
        power[i] = i <= j;
        for (int k = 0; k < j; k++)
            power[i] *= k < i ? (REAL)(j - k) : s;
    }
    for (int n = 0; n < 4; n++) {
        y[n] = 0;
        for (int i = 0; i <= n; i++)
            y[n] += binomial[n][i] * power[i] * b[n - i];
    }
    u[0] = y[0];
    u[1] = g / 2 * y[1];
    u[2] = (s * y[1] + g2 * y[2]) / 4;
    u[3] = g / 8 * (y[1] + 3 * s * y[2] + g2 * y[3]);
}

/* z_j and its derivatives by chi: d xi/d chi = sinh chi. */
static void NAME(near_two)(const NAME(expansion) * e, int j, REAL xi, REAL u[4])
{
    const REAL sinh_chi = NAME(root)(xi * (2 + xi)), cosh_chi = 1 + xi;
    REAL z[4];
    NAME(polynomial)(e, j, (xi - 2) / 2, z);
    for (int i = 1; i < 4; i++)
        z[i] /= 1 << i;
    u[0] = z[0];
    u[1] = sinh_chi * z[1];
    u[2] = cosh_chi * z[1] + sinh_chi * sinh_chi * z[2];
    u[3] = sinh_chi * (z[1] + 3 * cosh_chi * z[2] + sinh_chi * sinh_chi * z[3]);
}

/* Displacements, then forces, continuous along the cable: in plane u, v = cosh u', T, N; out of
 * plane W, W'  [2.36, 2.37 written in chi; N = dv/d sigma + u/cosh^2]. */
static void NAME(column)(int m, REAL w2, REAL xi, const REAL u[4], REAL state[4])
{
    state[0] = u[0];
    state[1] = u[1];
    if (m == 1)
        return;
    const REAL c = 1 + xi, sh = NAME(root)(xi * (2 + xi)), c2 = c * c;
    state[1] = c * u[1];
    state[2] =
        -c * (w2 * c2 * u[1] + c * u[3] + 2 * sh * u[2] + (c + 1 / c) * u[1]) + sh / c * u[0];
    state[3] = c * u[2] + sh * u[1] + u[0] / c;
}

/* a x = b for `columns` right sides, in place; both are rows of 4. Returns det a. */
static REAL NAME(solve)(int n, REAL a[4][4], REAL b[4][4], int columns)
{
    REAL determinant = 1;
    for (int k = 0; k < n; k++) {
        int best = k;
        for (int i = k + 1; i < n; i++)
            if (NAME(size)(a[i][k]) > NAME(size)(a[best][k]))
                best = i;
        for (int j = 0; j < 4 && best != k; j++) {
            const REAL keep = a[k][j], other = b[k][j];
            a[k][j] = a[best][j];
            a[best][j] = keep;
            b[k][j] = b[best][j];
            b[best][j] = other;
        }
        determinant *= best != k ? -a[k][k] : a[k][k];
        for (int i = 0; i < n && a[k][k] != 0; i++) {
            if (i == k || (columns == 0 && i < k))
                continue;
            const REAL f = a[i][k] / a[k][k];
            for (int j = k; j < n; j++)
                a[i][j] -= f * a[k][j];
            for (int j = 0; j < columns; j++)
                b[i][j] -= f * b[k][j];
        }
    }
    for (int i = 0; i < n && columns > 0; i++)
        for (int j = 0; j < columns; j++)
            b[i][j] /= a[i][i];
    return determinant;
}

/* The state of every solution at xi (row: component, column: solution). The mirror image of a
 * solution solves too (2.35 is even), so that y_j(-s) = (-1)^j y_j(s)  [2.56, 2.93] and one
 * matching serves both sides. */
static void NAME(state)(const NAME(solutions) * s, long double xi, REAL state[4][4])
{
    static const int mirror[2][4] = {{1, -1}, {1, -1, -1, 1}};
    const series_problem *p = s->problem;
    const REAL size = (REAL)(xi < 0 ? -xi : xi);
    const bool far = p->near_two && (!p->near_zero || size > (REAL)p->match);
    const int n = 2 * p->m;
    REAL here[4][4] = {{0}}, u[4], column[4];
    for (int j = 0; j < n; j++) {
        if (far)
            NAME(near_two)(&s->two, j, size, u);
        else
            NAME(near_zero)(&s->zero, j, size, u);
        NAME(column)(p->m, s->w2, size, u, column);
        for (int i = 0; i < n; i++)
            here[i][j] = column[i];
    }
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) {
            state[i][j] = far && p->near_zero ? 0 : here[i][j];
            for (int k = 0; far && p->near_zero && k < n; k++)
                state[i][j] += here[i][k] * s->alpha[k][j];
            if (xi < 0)
                state[i][j] *= mirror[p->m - 1][i] * (j % 2 == 0 ? 1 : -1);
        }
}

/* Expands about the points that are needed and matches. Gale matches U and three derivatives by
 * xi [2.64]; displacements and forces, which are what has to be continuous, are a regular
 * transform of them and better scaled. */
static bool NAME(prepare)(series_problem *p, long double w, NAME(solutions) * s)
{
    REAL *work = p->work[ARITHMETIC];
    s->problem = p;
    s->w2 = (REAL)w * (REAL)w;
    p->evaluations++;
    if ((p->near_zero && !NAME(expand)(&p->zero, s->w2, work, &s->zero)) ||
        (p->near_two &&
         !NAME(expand)(&p->two, s->w2, work + 2 * (size_t)p->m * (size_t)p->room, &s->two)))
        return false;
    if (p->near_zero && s->zero.terms > p->terms)
        p->terms = s->zero.terms;
    if (p->near_two && s->two.terms > p->terms)
        p->terms = s->two.terms;
    if (!p->near_zero || !p->near_two)
        return true;
    const int n = 2 * p->m;
    REAL z[4][4] = {{0}}, u[4], column[4];
    const REAL match = (REAL)p->match;
    for (int j = 0; j < n; j++) {
        NAME(near_zero)(&s->zero, j, match, u);
        NAME(column)(p->m, s->w2, match, u, column);
        for (int i = 0; i < n; i++)
            s->alpha[i][j] = column[i];
        NAME(near_two)(&s->two, j, match, u);
        NAME(column)(p->m, s->w2, match, u, column);
        for (int i = 0; i < n; i++)
            z[i][j] = column[i];
    }
    (void)NAME(solve)(n, z, s->alpha, n);
    return true;
}

static long double NAME(determinant)(series_problem *p, long double w, bool *converged)
{
    NAME(solutions) s;
    *converged = NAME(prepare)(p, w, &s);
    if (!*converged)
        return 0;
    REAL d[4][4] = {{0}}, none[4][4] = {{0}}, at_1[4][4], at_2[4][4];
    NAME(state)(&s, p->xi_2, at_2);
    if (p->symmetry != STRUM_NO_SYMMETRY) {
        /* U is odd in a symmetric mode, W even: solutions of that parity alone, clamped at end
         * 2 */
        const int first = (p->symmetry == STRUM_SYMMETRIC) == (p->m == 2);
        for (int i = 0; i < p->m; i++)
            for (int j = 0; j < p->m; j++)
                d[i][j] = at_2[i][2 * j + first];
        return (long double)NAME(solve)(p->m, d, none, 0);
    }
    NAME(state)(&s, p->xi_1, at_1);
    for (int i = 0; i < p->m; i++)
        for (int j = 0; j < 2 * p->m; j++) {
            d[i][j] = at_1[i][j];
            d[i + p->m][j] = at_2[i][j];
        }
    return (long double)NAME(solve)(2 * p->m, d, none, 0);
}

/* Symmetric 2 x 2 matrices as {11, 12, 22}. */
static int NAME(negatives)(const REAL s[3])
{
    const REAL determinant = s[0] * s[2] - s[1] * s[1];
    return determinant < 0 ? 1 : s[0] + s[2] < 0 ? 2 : 0;
}

/* Stiffness of an element between two states: (F_a, F_b) -> (X_a, -X_b). Returns what is not
 * symmetric in it, relative. */
static REAL NAME(element)(int m, REAL a[4][4], REAL b[4][4], REAL stiffness[4][4])
{
    const int n = 2 * m;
    REAL f[4][4] = {{0}}; /* transposed: f' stiffness' = x' */
    for (int i = 0; i < m; i++)
        for (int j = 0; j < n; j++) {
            f[j][i] = a[i + m][j];
            f[j][i + m] = b[i + m][j];
            stiffness[j][i] = a[i][j];
            stiffness[j][i + m] = -b[i][j];
        }
    (void)NAME(solve)(n, f, stiffness, n);
    REAL largest = 0, asymmetry = 0;
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) {
            const REAL value = NAME(size)(stiffness[i][j]);
            const REAL difference = NAME(size)(stiffness[i][j] - stiffness[j][i]);
            largest = value > largest ? value : largest;
            asymmetry = difference > asymmetry ? difference : asymmetry;
        }
    return asymmetry < largest ? asymmetry / largest : 1;
}

/*
 * -(F'/cosh)' = w^2 A F, A <= I, with free ends: as many negative pivots as frequencies below
 * w, where no element has a frequency below w with F = 0 at both its ends. That holds for
 * elements shorter than pi/(w sqrt(cosh)) in chi. One or two of the frequencies are 0 (F
 * constant). On a level cable half of it is counted; the force that symmetry forbids at the
 * lowest point is held there by a great stiffness.
 */
static int NAME(count)(series_problem *p, long double w, long double *asymmetry)
{
    NAME(solutions) s;
    *asymmetry = 2;
    if (!NAME(prepare)(p, w, &s))
        return 0;
    const bool half = p->symmetry != STRUM_NO_SYMMETRY;
    const long double from = half ? 0 : p->chi_1, width = p->chi_2 - from;
    const double steepest = fmax(cosh((double)p->chi_1), cosh((double)p->chi_2));
    const int elements = 1 + (int)ceil((double)(w * width) * sqrt(steepest) / 2.2);
    REAL a[4][4], b[4][4], k[4][4] = {{0}}, pivot[3] = {0, 0, p->m == 1}, worst = 0;
    if (half && p->m == 1)
        pivot[0] = p->symmetry == STRUM_SYMMETRIC ? (REAL)1e60 : 0;
    else if (half) /* T is odd in an antisymmetric mode, N in a symmetric one */
        pivot[p->symmetry == STRUM_SYMMETRIC ? 2 : 0] = (REAL)1e60;
    NAME(state)(&s, half ? 0 : p->xi_1, a);
    int negative = 0;
    for (int e = 1; e <= elements; e++) {
        const long double chi = from + width * e / elements, sh = sinhl(chi / 2);
        NAME(state)(&s, e == elements ? p->xi_2 : chi < 0 ? -2 * sh * sh : 2 * sh * sh, b);
        const REAL bad = NAME(element)(p->m, a, b, k);
        worst = bad > worst ? bad : worst;
        const int m = p->m;
        pivot[0] += k[0][0];
        if (m == 2) {
            pivot[1] += k[0][1];
            pivot[2] += k[1][1];
        }
        negative += NAME(negatives)(pivot);
        const REAL d = pivot[0] * pivot[2] - pivot[1] * pivot[1];
        REAL next[3] = {k[m][m], 0, 1};
        for (int i = 0; i < m; i++)
            for (int j = i; j < m; j++) {
                const REAL li[2] = {k[0][m + i], m == 2 ? k[1][m + i] : 0};
                const REAL lj[2] = {k[0][m + j], m == 2 ? k[1][m + j] : 0};
                next[i + j] =
                    k[m + i][m + j] - (li[0] * (pivot[2] * lj[0] - pivot[1] * lj[1]) +
                                       li[1] * (pivot[0] * lj[1] - pivot[1] * lj[0])) /
                                          d;
            }
        for (int i = 0; i < 3; i++)
            pivot[i] = next[i];
        for (int i = 0; i < 4; i++)
            for (int j = 0; j < 4; j++)
                a[i][j] = b[i][j];
    }
    *asymmetry = (long double)worst;
    const int constant = !half ? p->m : p->m == 2 || p->symmetry == STRUM_ANTISYMMETRIC;
    return negative + NAME(negatives)(pivot) - constant;
}
