/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <strum/absorber.h>

#include <math.h>
#include <nlopt.h>
#include <stdlib.h>
#include <string.h>

#include "core/status.h"

/* Local searches that begin, at most. */
#define STARTS 6
/* A variable whose bounds differ by more is searched by its logarithm. */
#define LOG_RANGE 30.0

typedef struct search {
    const strum_absorber_problem *problem;
    long evaluations, limit;
    double best, best_at[STRUM_ABSORBER_VARIABLES_MAX];
    bool stopped;        /* by progress or the budget */
    strum_status broken; /* an error that ends everything */
    strum_fault *fault;
    strum_taut_roots *last; /* of the trial before: guesses for the next */
} search;

double strum_absorber_scale(double low, double high, double share)
{
    if (share <= 0)
        return low;
    if (share >= 1)
        return high;
    if (low > 0 && high / low > LOG_RANGE)
        return low * pow(high / low, share);
    if (low == 0)
        return high * expm1(share * log(1e6)) / (1e6 - 1);
    return low + (high - low) * share;
}

static void values_of(const strum_absorber_problem *p, const double *t, double *values)
{
    for (int i = 0; i < p->variables; i++)
        values[i] = strum_absorber_scale(p->lowest_values[i], p->highest_values[i], t[i]);
}

static strum_status roots_of(const strum_absorber_problem *p, const strum_taut *chain,
                             const strum_taut_roots *guesses, strum_taut_roots **roots,
                             strum_fault *fault)
{
    strum_taut_query query = {.numbers = p->modes,
                              .count = p->modes != NULL ? p->mode_count : 0,
                              .lowest = p->lowest,
                              .highest = p->highest};
    if (p->modes == NULL) {
        /* whatever decays faster than twice its own frequency limits nothing */
        query.max_decay = 2 * p->highest;
        if (guesses != NULL) {
            query.guesses = guesses->roots;
            query.guess_count = guesses->count;
        }
    }
    return strum_taut_solve(chain, &query, roots, fault);
}

static double damping_ratio(const strum_taut_root *root)
{
    return root->decay > 0 ? root->decay / hypot(root->frequency, root->decay) : 0;
}

int strum_absorber_limiting(const strum_taut_roots *roots)
{
    int worst = -1;
    for (size_t i = 0; i < roots->count; i++)
        if (worst < 0 || damping_ratio(&roots->roots[i]) < damping_ratio(&roots->roots[worst]))
            worst = (int)i;
    return worst;
}

strum_status strum_absorber_roots(const strum_absorber_problem *p, const double *values,
                                  strum_taut_roots **roots, strum_fault *fault)
{
    strum_taut *chain = NULL;
    strum_status status = p->build(p->context, values, &chain, fault);
    if (status == STRUM_OK)
        status = roots_of(p, chain, NULL, roots, fault);
    strum_taut_free(&chain);
    return status;
}

/* The smallest damping ratio at one trial. A trial that cannot be answered counts as undamped:
 * a search may pass by, it may not end there. */
static double trial(search *s, const double *t)
{
    const strum_absorber_problem *p = s->problem;
    double values[STRUM_ABSORBER_VARIABLES_MAX], objective = 0;
    if (s->stopped || s->broken != STRUM_OK)
        return 0;
    values_of(p, t, values);
    strum_taut *chain = NULL;
    strum_taut_roots *roots = NULL;
    strum_status status = p->build(p->context, values, &chain, s->fault);
    if (status == STRUM_OK)
        status = roots_of(p, chain, s->last, &roots, s->fault);
    strum_taut_free(&chain);
    s->evaluations++;
    if (status == STRUM_ERR_MEMORY || status == STRUM_ERR_CANCELLED ||
        status == STRUM_ERR_INTERNAL)
        s->broken = status;
    if (status == STRUM_OK) {
        const int limiting = strum_absorber_limiting(roots);
        objective = limiting >= 0 ? damping_ratio(&roots->roots[limiting]) : 0;
        strum_taut_roots_free(&s->last);
        s->last = roots;
    }
    if (objective > s->best) {
        s->best = objective;
        memcpy(s->best_at, t, (size_t)p->variables * sizeof *t);
    }
    values_of(p, s->best_at, values);
    if (s->evaluations >= s->limit ||
        (p->progress != NULL && !p->progress(p->context, s->evaluations, s->best, values)))
        s->stopped = true;
    return objective;
}

static double nlopt_trial(unsigned n, const double *t, double *gradient, void *data)
{
    (void)n;
    (void)gradient; /* the search asks for none */
    return trial(data, t);
}

/* Subplex from `t` with at most `budget` trials a round, restarted with smaller steps until a
 * round gains less than `gain` of what there is; ends at the best place. */
static double climb(search *s, double *t, double step, int rounds, double gain, int budget)
{
    const int n = s->problem->variables;
    double best = trial(s, t);
    for (; rounds > 0 && !s->stopped && s->broken == STRUM_OK; rounds--, step /= 4) {
        double at[STRUM_ABSORBER_VARIABLES_MAX], found = best;
        memcpy(at, t, sizeof at);
        nlopt_opt opt = nlopt_create(NLOPT_LN_SBPLX, (unsigned)n);
        if (opt == NULL) {
            s->broken = STRUM_ERR_MEMORY;
            return best;
        }
        nlopt_set_max_objective(opt, nlopt_trial, s);
        nlopt_set_lower_bounds1(opt, 0);
        nlopt_set_upper_bounds1(opt, 1);
        nlopt_set_initial_step1(opt, step);
        nlopt_set_xtol_abs1(opt, 1e-9);
        nlopt_set_ftol_rel(opt, gain / 10);
        nlopt_set_maxeval(opt, (int)fmin(budget, (double)(s->limit - s->evaluations)));
        (void)nlopt_optimize(opt, at, &found);
        nlopt_destroy(opt);
        if (!(found > best))
            break;
        const bool little = found < best * (1 + gain);
        best = found;
        memcpy(t, at, sizeof at);
        if (little)
            break;
    }
    return best;
}

/* Golden section about a place of a scan in one variable. */
static double climb_one(search *s, double *t, double step)
{
    const double golden = 0.6180339887498949;
    double low = fmax(*t - step, 0), high = fmin(*t + step, 1);
    double left = high - golden * (high - low), right = low + golden * (high - low);
    double at_left = trial(s, &left), at_right = trial(s, &right);
    while (high - low > 1e-10 && !s->stopped && s->broken == STRUM_OK) {
        if (at_left > at_right) {
            high = right;
            right = left;
            at_right = at_left;
            left = high - golden * (high - low);
            at_left = trial(s, &left);
        } else {
            low = left;
            left = right;
            at_left = at_right;
            right = low + golden * (high - low);
            at_right = trial(s, &right);
        }
    }
    *t = at_left > at_right ? left : right;
    return fmax(at_left, at_right);
}

typedef struct place {
    double t[STRUM_ABSORBER_VARIABLES_MAX], value;
} place;

/* The generalised golden ratio's sequence, which fills the unit cube evenly (R-sequence). */
static void sequence(int n, long index, double *t)
{
    double g = 2;
    for (int i = 0; i < 40; i++)
        g = pow(1 + g, 1.0 / (n + 1));
    for (int i = 0; i < n; i++) {
        const double x = 0.5 + (double)index * pow(g, -(i + 1));
        t[i] = x - floor(x);
    }
}

static double distance(int n, const double *a, const double *b)
{
    double most = 0;
    for (int i = 0; i < n; i++)
        most = fmax(most, fabs(a[i] - b[i]));
    return most;
}

/* Keeps the best places of the scan that are apart from each other. */
static void keep(place *best, int *count, const place *new, int n, double apart)
{
    int worst = -1;
    for (int i = 0; i < *count; i++)
        if (distance(n, best[i].t, new->t) < apart) {
            if (new->value > best[i].value)
                best[i] = *new;
            return;
        }
    if (*count < STARTS) {
        best[(*count)++] = *new;
        return;
    }
    for (int i = 0; i < *count; i++)
        if (worst < 0 || best[i].value < best[worst].value)
            worst = i;
    if (new->value > best[worst].value)
        best[worst] = *new;
}

static int scan(search *s, place *best)
{
    const int n = s->problem->variables;
    const long points = n == 1 ? 33 : (long)fmin(40.0 * n, 0.3 * (double)s->limit);
    const double apart = n == 1 ? 1.5 / 32 : 0.1;
    int count = 0;
    for (long k = 0; k < points && !s->stopped && s->broken == STRUM_OK; k++) {
        place p = {.value = 0};
        if (n == 1)
            p.t[0] = (double)k / (double)(points - 1);
        else
            sequence(n, k + 1, p.t);
        p.value = trial(s, p.t);
        keep(best, &count, &p, n, apart);
    }
    return count;
}

static void note(const strum_absorber_problem *p, const place *end, strum_absorber_optimum *out)
{
    int at = out->optima_count < STRUM_ABSORBER_OPTIMA_MAX ? out->optima_count++
                                                           : STRUM_ABSORBER_OPTIMA_MAX - 1;
    for (; at > 0 && out->optima[at - 1].damping_ratio < end->value; at--)
        out->optima[at] = out->optima[at - 1];
    values_of(p, end->t, out->optima[at].values);
    out->optima[at].damping_ratio = end->value;
}

static int by_value(const void *left, const void *right)
{
    const place *l = left, *r = right;
    return l->value > r->value ? -1 : l->value < r->value;
}

static void run(search *s, strum_absorber_optimum *out)
{
    place best[STARTS];
    const int n = s->problem->variables;
    out->starts = scan(s, best);
    for (int i = 0; i < out->starts && !s->stopped && s->broken == STRUM_OK; i++)
        best[i].value = n == 1 ? climb_one(s, best[i].t, 1.0 / 32)
                               : climb(s, best[i].t, 0.08, 1, 1e-3, 50 * n);
    qsort(best, (size_t)out->starts, sizeof *best, by_value);
    /* the two best to the end: which is the better shows only there */
    for (int i = 0; i < 2 && i < out->starts && n > 1 && !s->stopped && s->broken == STRUM_OK;
         i++)
        if (best[i].value > 0.97 * best[0].value)
            best[i].value = climb(s, best[i].t, 0.02, 3, 1e-6, 120 * n);
    for (int i = 0; i < out->starts; i++)
        note(s->problem, &best[i], out);
    /* the winner once more from where it stands: a kink may have held the simplex */
    if (n > 1 && !s->stopped && s->broken == STRUM_OK)
        (void)climb(s, s->best_at, 0.002, 4, 1e-7, 120 * n);
}

strum_status strum_absorber_optimize(const strum_absorber_problem *p,
                                     strum_absorber_optimum *out, strum_fault *fault)
{
    if (p->variables < 1 || p->variables > STRUM_ABSORBER_VARIABLES_MAX)
        return fault_set(fault, STRUM_ERR_RANGE, "1 to %d numbers may vary",
                         STRUM_ABSORBER_VARIABLES_MAX);
    search s = {.problem = p, .limit = p->max_evaluations, .fault = fault};
    memset(out, 0, sizeof *out);
    run(&s, out);
    strum_taut_roots_free(&s.last);
    out->evaluations = s.evaluations;
    out->complete = !s.stopped;
    if (s.broken != STRUM_OK)
        return fault_set(fault, s.broken, "%s", strum_status_text(s.broken));
    if (!(s.best > 1e-12)) /* a mode that is not reached has rounding for a decay */
        return fault_set(
            fault, STRUM_ERR_IMPOSSIBLE,
            "nothing within the bounds damps every mode that was asked for (%ld trials)",
            s.evaluations);
    values_of(p, s.best_at, out->values);
    out->damping_ratio = s.best;
    out->loss_ratio = s.best / sqrt((1 - s.best) * (1 + s.best));
    return STRUM_OK;
}

static double tuned_stiffness(double mass, double ratio, double frequency)
{
    return mass * pow(frequency / (1 + ratio), 2);
}

strum_absorber_form strum_absorber_den_hartog(double mass, double ratio, double frequency)
{
    return (strum_absorber_form){
        tuned_stiffness(mass, ratio, frequency),
        2 * mass * frequency * sqrt(3 * ratio / (8 * pow(1 + ratio, 3))), NAN};
}

strum_absorber_form strum_absorber_coalescence(double mass, double ratio, double frequency)
{
    return (strum_absorber_form){tuned_stiffness(mass, ratio, frequency),
                                 2 * mass * frequency * sqrt(ratio) / pow(1 + ratio, 1.5),
                                 sqrt(ratio) / 2};
}

strum_absorber_form strum_absorber_universal_curve(double length, double mass_per_length,
                                                   double tension, double position, long mode)
{
    const double share = fmin(position, length - position) / length;
    const double first = M_PI / length * sqrt(tension / mass_per_length);
    return (strum_absorber_form){
        0, 0.10 * mass_per_length * length * first / ((double)mode * share), 0.52 * share};
}
