/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Least squares by Gauss and Newton's method, with Levenberg and Marquardt's damping where a step
 * does not help. Coordinates: ln T, u in place of EI (regular at EI = 0, which data may well ask
 * for), the fixity in [0, 1], ln L, ln m, ln EA, ln c. */
#include "core/identify/problem.h"

#include <string.h>

#include "core/numerics/linalg.h"

#define ITERATIONS_MAX 200
/* Steps of less are taken without looking: chi^2 is drowned by rounding then. */
#define STEP_BLIND 1e-7
#define STEP_LAST  1e-13
#define BLIND_MAX  6
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

static strum_status look(const problem *p, fit *f)
{
    const strum_status status = model_predict(p, &f->at, f->predictions);
    if (status != STRUM_OK)
        return status;
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

/* Chi^2 of a state alone. */
static strum_status chi2_at(const problem *p, const state *s, double *chi2)
{
    prediction out[DATA_MAX];
    const strum_status status = model_predict(p, s, out);
    *chi2 = status == STRUM_OK ? state_chi2(p, s, out) : HUGE_VAL;
    return status;
}

/* A coordinate rests at a bound that chi^2 pushes it against. */
static bool held(const fit *f, size_t j)
{
    const int q = f->which[j];
    const double x = q == BENDING ? f->at.u : q == FIXITY ? f->at.q[FIXITY] : 0.5;
    const double top = q == BENDING ? U_MAX : 1;
    if ((q != BENDING && q != FIXITY) || (x > 0 && x < top))
        return false;
    double downhill = 0;
    for (size_t i = 0; i < f->rows; i++)
        downhill += f->jacobian[i + j * f->rows] * f->residuals[i];
    return x <= 0 ? downhill <= 0 : downhill >= 0;
}

/* Step of the free coordinates, with the damping `lambda`; false where there is none. */
static bool step(const fit *f, double lambda, double dx[UNKNOWNS_MAX])
{
    double a[(ROWS_MAX + UNKNOWNS_MAX) * UNKNOWNS_MAX], b[ROWS_MAX + UNKNOWNS_MAX];
    size_t free_of[UNKNOWNS_MAX], n = 0;
    memset(dx, 0, UNKNOWNS_MAX * sizeof *dx);
    for (size_t j = 0; j < f->unknowns; j++)
        if (!held(f, j))
            free_of[n++] = j;
    if (n == 0)
        return true;
    const size_t extra = lambda > 0 || f->rows < n ? n : 0, rows = f->rows + extra;
    memset(a, 0, sizeof a);
    memset(b, 0, sizeof b);
    memcpy(b, f->residuals, f->rows * sizeof *b);
    for (size_t k = 0; k < n; k++) {
        const double *column = &f->jacobian[free_of[k] * f->rows];
        double norm = 0;
        for (size_t i = 0; i < f->rows; i++) {
            a[i + k * rows] = column[i];
            norm += column[i] * column[i];
        }
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

/* How far a step goes, as a share of what it changes. */
static double step_size(const fit *f, const double dx[UNKNOWNS_MAX])
{
    double size = 0;
    for (size_t j = 0; j < f->unknowns; j++)
        size = fmax(size, fabs(dx[j]) / (f->which[j] == BENDING ? f->at.u + 1e-9 : 1));
    return size;
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
            /* not to 0 in one stride where something is known of EI */
            s.u = fmin(fmax(s.u + d, p->prior[BENDING] > 0 ? 0.1 * s.u : 0), U_MAX);
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

strum_status fit_descend(const problem *p, fit *f)
{
    begin(p, f);
    strum_status status = look(p, f);
    double lambda = 0, dx[UNKNOWNS_MAX];
    int blind = 0;
    for (int i = 0; i < ITERATIONS_MAX && status == STRUM_OK && f->unknowns > 0; i++) {
        const bool found = step(f, lambda, dx);
        const double size = found ? step_size(f, dx) : HUGE_VAL;
        if (found && size < STEP_LAST)
            break;
        double chi2 = HUGE_VAL;
        const state next = moved(p, f, dx);
        if (found)
            status = chi2_at(p, &next, &chi2);
        const bool small = lambda == 0 && size < STEP_BLIND;
        if (status == STRUM_OK && found && (chi2 <= f->chi2 || small)) {
            blind += small;
            f->at = next;
            lambda = lambda < 1e-6 ? 0 : lambda / 10;
            status = look(p, f);
            if (blind >= BLIND_MAX)
                break;
        } else if (status == STRUM_OK) {
            lambda = lambda > 0 ? lambda * 10 : 1e-3;
            if (lambda > 1e12)
                break;
        }
    }
    if (status == STRUM_OK) {
        data_rows(p, f, false);
        prior_rows(p, f, false);
    }
    return status;
}
