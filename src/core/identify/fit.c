/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Least squares by Gauss and Newton's method, with Levenberg and Marquardt's damping where a step
 * does not help. Coordinates: ln T, u in place of EI (regular at EI = 0, which data may well ask
 * for), the fixity in [0, 1], ln L, ln m, ln EA, ln c. */
#include "core/identify/problem.h"

#include <string.h>

#include "core/numerics/linalg.h"

#define ITERATIONS_MAX 80
/* Steps of less are taken without looking: chi^2 is drowned by rounding then. */
#define STEP_BLIND 1e-7
#define STEP_LAST  1e-13
/* Enough where chi^2 alone is wanted, which is flat there. */
#define STEP_ROUGH 1e-7
#define BLIND_MAX  30
#define UPHILL_MAX 4
/* Where chi^2 alone is wanted: so many steps that gain less end it. */
#define GAIN_SMALL 1e-7
#define IDLE_MAX   7
#define LAMBDA_MAX 1e12
/* u: beyond, the tension is below 1e-6 of what bending gives */
#define U_MAX 1e3
/* Longest step of a logarithm. */
#define LOG_STEP_MAX 1.5

/* Derivative of a prediction by a coordinate: with u held, EI goes with T and L^2. */
static double by_coordinate(const problem *p, const prediction *o, int q)
{
    const double moved = p->unknown[BENDING] ? o->by[BENDING] : 0;
    return q == BENDING   ? o->by_u
           : q == TENSION ? o->by[TENSION] + moved
           : q == LENGTH  ? o->by[LENGTH] + 2 * moved
                          : o->by[q];
}

/* The rows of what is known of quantities, r = (known - value)/deviation; of ln quantities, of the
 * fixity itself. `jacobian` by coordinates where `inner`, else by ln quantity. */
static void prior_rows(const problem *p, fit *f, bool inner)
{
    size_t row = problem_data(p);
    for (int q = 0; q < QUANTITIES; q++) {
        if (!(p->prior[q] > 0))
            continue;
        const double sd = p->prior[q];
        const double value = f->at.q[q], known = p->prior_value[q];
        f->residuals[row] = q == FIXITY ? (known - value) / sd : log(known / value) / sd;
        for (size_t j = 0; j < f->unknowns; j++) {
            const int c = f->which[j];
            double slope = c == q;
            if (inner && q == BENDING && p->unknown[BENDING])
                slope = c == BENDING ? 2 / f->at.u : c == TENSION ? 1 : c == LENGTH ? 2 : 0;
            f->jacobian[row + j * f->rows] = slope / sd;
        }
        row++;
    }
}

static void data_rows(const problem *p, fit *f, bool inner)
{
    size_t row = 0;
    for (size_t i = 0; i < p->count; i++) {
        if (p->skip[i])
            continue;
        const prediction *o = &f->predictions[i];
        f->residuals[row] = (p->measured[i] - o->value) / p->deviation[i];
        for (size_t j = 0; j < f->unknowns; j++)
            f->jacobian[row + j * f->rows] =
                (inner ? by_coordinate(p, o, f->which[j]) : o->by[f->which[j]]) /
                p->deviation[i];
        row++;
    }
}

/* Residuals and derivatives of the predictions that `f` holds. */
static strum_status look(const problem *p, fit *f)
{
    data_rows(p, f, true);
    prior_rows(p, f, true);
    f->chi2 = 0;
    for (size_t i = 0; i < f->rows; i++)
        f->chi2 += f->residuals[i] * f->residuals[i];
    return isfinite(f->chi2) ? STRUM_OK : STRUM_ERR_ACCURACY;
}

double state_chi2(const problem *p, const state *s, const prediction *out)
{
    double sum = 0;
    for (size_t i = 0; i < p->count; i++) {
        const double r = p->skip[i] ? 0 : (p->measured[i] - out[i].value) / p->deviation[i];
        sum += r * r;
    }
    for (int q = 0; q < QUANTITIES; q++)
        if (p->prior[q] > 0) {
            const double known = p->prior_value[q];
            const double r = q == FIXITY ? known - s->q[q] : log(known / s->q[q]);
            sum += r / p->prior[q] * (r / p->prior[q]);
        }
    return isfinite(sum) ? sum : HUGE_VAL;
}

/* A fixity goes to its bound in strides: a fit that jumps there may find itself in another valley. */
static double fixity_room(double distance)
{
    return distance < 0.04 ? distance : 0.5 * distance + 0.02;
}

/* How far coordinate `j` may go down and up. Tension ends where bending alone is left of the cable,
 * whether u or, with EI known, T itself is the coordinate. */
static void room(const problem *p, const fit *f, size_t j, double *down, double *up)
{
    const int q = f->which[j];
    *down = *up = HUGE_VAL;
    if (q == FIXITY) {
        *down = fixity_room(f->at.q[FIXITY]);
        *up = fixity_room(1 - f->at.q[FIXITY]);
    } else if (q == BENDING) {
        *down = f->at.u;
        *up = fmax(0, U_MAX - f->at.u);
    } else if (q == TENSION && !p->unknown[BENDING] && f->at.u > 0) {
        *down = fmax(0, 2 * log(U_MAX / f->at.u));
    }
}

/* A coordinate rests at a bound that chi^2 pushes it against. */
static bool held(const problem *p, const fit *f, size_t j)
{
    double down, up, downhill = 0;
    room(p, f, j, &down, &up);
    if (down > 0 && up > 0)
        return false;
    for (size_t i = 0; i < f->rows; i++)
        downhill += f->jacobian[i + j * f->rows] * f->residuals[i];
    return down <= 0 ? downhill <= 0 : downhill >= 0;
}

/* Least squares step of the coordinates `free_of`, with the damping `lambda`, where the others step
 * by what `dx` has; false where there is none. */
static bool solve_step(const fit *f, double lambda, const size_t *free_of, size_t n,
                       double dx[UNKNOWNS_MAX])
{
    double a[(ROWS_MAX + UNKNOWNS_MAX) * UNKNOWNS_MAX], b[ROWS_MAX + UNKNOWNS_MAX];
    const size_t extra = lambda > 0 || f->rows < n ? n : 0, rows = f->rows + extra;
    for (size_t i = 0; i < f->rows; i++) {
        b[i] = f->residuals[i];
        for (size_t j = 0; j < f->unknowns; j++)
            b[i] -= f->jacobian[i + j * f->rows] * dx[j];
    }
    memset(b + f->rows, 0, extra * sizeof *b);
    for (size_t k = 0; k < n; k++) {
        const double *column = &f->jacobian[free_of[k] * f->rows];
        double norm = 0;
        for (size_t i = 0; i < f->rows; i++)
            norm += column[i] * column[i];
        memcpy(&a[k * rows], column, f->rows * sizeof *a);
        memset(&a[k * rows + f->rows], 0, extra * sizeof *a);
        if (extra > 0)
            a[f->rows + k + k * rows] = sqrt(fmax(lambda, 1e-12) * norm) + 1e-150;
    }
    if (linalg_least_squares((int)rows, (int)n, a, (int)rows, b) != STRUM_OK)
        return false;
    for (size_t k = 0; k < n; k++) {
        if (!isfinite(b[k]))
            return false;
        dx[free_of[k]] = b[k];
    }
    return true;
}

/* The step within the bounds: what would pass one stops there, and the others follow. */
static bool step(const problem *p, const fit *f, double lambda, double dx[UNKNOWNS_MAX])
{
    size_t free_of[UNKNOWNS_MAX], n = 0;
    for (size_t j = 0; j < f->unknowns; j++)
        if (!held(p, f, j))
            free_of[n++] = j;
    memset(dx, 0, UNKNOWNS_MAX * sizeof *dx);
    while (n > 0) {
        for (size_t k = 0; k < n; k++)
            dx[free_of[k]] = 0;
        if (!solve_step(f, lambda, free_of, n, dx))
            return false;
        size_t kept = 0;
        for (size_t k = 0; k < n; k++) {
            const size_t j = free_of[k];
            double down, up;
            room(p, f, j, &down, &up);
            const double d = fmin(fmax(dx[j], -down), up);
            if (d == dx[j])
                free_of[kept++] = j;
            dx[j] = d;
        }
        if (kept == n)
            break;
        n = kept;
    }
    return true;
}

/* How far a step goes, as a share of what it changes. */
static double step_size(const fit *f, const double dx[UNKNOWNS_MAX])
{
    double size = 0;
    for (size_t j = 0; j < f->unknowns; j++)
        size = fmax(size, fabs(dx[j]) / (f->which[j] == BENDING ? f->at.u + 1e-9 : 1));
    return size;
}

/* Where bending rules the data tell EI = T (L u)^2, and the valley of chi^2 is straight in ln u;
 * towards 0 u itself leads on, and where something is known of EI not to 0 in one stride. */
static double moved_u(double u, double d, bool known)
{
    const double next = d > -0.5 * u ? u * exp(fmin(d / u, LOG_STEP_MAX)) : u + d;
    return fmin(fmax(u > 0 ? next : d, known ? 0.1 * u : 0), U_MAX);
}

static state moved(const problem *p, const fit *f, const double dx[UNKNOWNS_MAX])
{
    state s = f->at;
    double most = 0;
    for (size_t j = 0; j < f->unknowns; j++)
        if (f->which[j] != BENDING && f->which[j] != FIXITY)
            most = fmax(most, fabs(dx[j]));
    const double scale = most > LOG_STEP_MAX ? LOG_STEP_MAX / most : 1;
    for (size_t j = 0; j < f->unknowns; j++) {
        const int q = f->which[j];
        const double d = scale * dx[j];
        if (q == BENDING)
            s.u = moved_u(s.u, d, p->prior[BENDING] > 0);
        else if (q == FIXITY)
            s.q[q] = fmin(fmax(s.q[q] + d, 0), 1);
        else
            s.q[q] *= exp(d);
    }
    state_close(p, &s);
    return s;
}

static void begin(const problem *p, fit *f)
{
    f->unknowns = problem_unknowns(p, f->which);
    f->rows = problem_rows(p);
    for (int q = 0; q < QUANTITIES; q++)
        if (!p->unknown[q])
            f->at.q[q] = p->value[q];
    state_close(p, &f->at);
}

/* A descent on its way. Valleys of chi^2 are narrow and curved where data are exact: a full step
 * leaves the valley, and the next ones come back farther along. So some steps may go uphill before
 * the best point is returned to, and damping begins. */
typedef struct descent {
    state best;
    double best_chi2, lambda, size;
    int uphill, blind, idle;
} descent;

static strum_status place(const problem *p, fit *f, const state *at)
{
    const strum_status status = model_predict(p, at, f->predictions);
    f->at = *at;
    return status == STRUM_OK ? look(p, f) : status;
}

static strum_status go_back(const problem *p, fit *f, descent *d)
{
    d->uphill = 0;
    d->lambda = d->lambda > 0 ? d->lambda * 10 : 1e-3;
    return place(p, f, &d->best);
}

/* One trial; `small`: too small to tell whether it helps. */
static strum_status try_step(const problem *p, fit *f, const double *dx, bool small, descent *d)
{
    const state next = moved(p, f, dx);
    strum_status status = model_predict(p, &next, f->trial);
    if (status != STRUM_OK)
        return status;
    const double chi2 = state_chi2(p, &next, f->trial);
    const bool helps = chi2 <= d->best_chi2 || (small && d->uphill == 0);
    if (!helps && (d->lambda > 0 || d->uphill >= UPHILL_MAX || !isfinite(chi2)))
        return go_back(p, f, d);
    f->at = next;
    memcpy(f->predictions, f->trial, p->count * sizeof *f->trial);
    status = look(p, f);
    d->uphill = helps ? 0 : d->uphill + 1;
    if (helps) {
        d->best = next;
        d->best_chi2 = chi2;
        d->lambda = d->lambda < 1e-6 ? 0 : d->lambda / 10;
    }
    return status;
}

static strum_status descend(const problem *p, fit *f, double last)
{
    double dx[UNKNOWNS_MAX];
    begin(p, f);
    strum_status status = place(p, f, &f->at);
    descent d = {.best = f->at, .best_chi2 = f->chi2, .size = HUGE_VAL};
    for (int i = 0; i < ITERATIONS_MAX && status == STRUM_OK && f->unknowns > 0; i++) {
        const bool found = step(p, f, d.lambda, dx);
        const double size = found ? step_size(f, dx) : HUGE_VAL;
        const bool small = d.lambda == 0 && size < STEP_BLIND;
        if (d.lambda > LAMBDA_MAX || (size < STEP_LAST && d.uphill == 0))
            break;
        if (!found || size < STEP_LAST) {
            status = go_back(p, f, &d);
            continue;
        }
        const double before = d.best_chi2;
        status = try_step(p, f, dx, small, &d);
        d.blind += small;
        d.idle = d.best_chi2 < before * (1 - GAIN_SMALL) ? 0 : d.idle + 1;
        if (last > 0 && d.idle >= IDLE_MAX)
            break;
        /* Rounding alone is left where small steps become no smaller. */
        if (small && d.uphill == 0 &&
            (size < last || d.blind >= BLIND_MAX || size > 0.9 * d.size))
            break;
        d.size = small ? size : HUGE_VAL;
    }
    return status == STRUM_OK && f->chi2 > d.best_chi2 && d.blind == 0 ? place(p, f, &d.best)
                                                                       : status;
}

strum_status fit_descend(const problem *p, fit *f)
{
    const strum_status status = descend(p, f, 0);
    if (status == STRUM_OK) {
        data_rows(p, f, false);
        prior_rows(p, f, false);
    }
    return status;
}

strum_status fit_chi2(const problem *p, fit *f)
{
    return descend(p, f, STEP_ROUGH);
}

void fit_start(fit *to, const fit *from)
{
    to->at = from->at;
    to->chi2 = from->chi2;
}
