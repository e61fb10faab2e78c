/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Climbing to a local optimum of the smallest damping ratio. Each damping ratio is smooth in
 * the variables, their minimum is not: so it is solved as max level, subject to every root's
 * damping ratio >= level, by sequential quadratic programming (NLopt's SLSQP) in a box about
 * the place reached so far. There the roots are followed by Newton's method; the trial that
 * ends a round finds and counts them anew, and decides. Roots just outside a band are kept
 * outside: where the band's border limits, the climb goes on along it.
 *
 * Where two roots coalesce neither is smooth, but the characteristic function is: the double
 * root itself becomes unknown, with F = dF/ds = 0 as conditions.
 */
#include "core/absorber/climb.h"

#include <nlopt.h>
#include <string.h>

#include "core/taut/taut.h"

/* Roots that are followed in a round, the least damped first. */
#define FOLLOWED_MAX 48
#define VARIABLES    STRUM_ABSORBER_VARIABLES_MAX
/* Step of differences, as a share of a variable's range. */
#define DIFFERENCE 1e-6
/* Conditions hold to this, in the units of a round: SLSQP gives out only what obeys them. */
#define FEASIBLE 1e-10
/* Roots outside a band are kept so far from it, in spacings of modes. */
#define OUTSIDE 1e-8

typedef enum root_rule { RULE_DAMPED, RULE_BELOW, RULE_ABOVE } root_rule;

typedef struct followed {
    cplx s, slope[VARIABLES]; /* at the place where the round began */
    root_rule rule;
} followed;

typedef struct climb {
    search *search;
    nlopt_opt opt;
    double from[VARIABLES], level, spacing; /* where it began, and the objective there */
    followed roots[FOLLOWED_MAX];
    int count;
    cplx twin; /* near the double root sought; then the unknowns are t, s, level */
    double twin_scale, twin_log;
} climb;

static double ratio_of(cplx s)
{
    return -creal(s) / cabs(s);
}

static double ratio_slope(cplx s, cplx ds)
{
    const double size = cabs(s);
    return (-creal(ds) + creal(s) * creal(conj(s) * ds) / (size * size)) / size;
}

/* Where Newton's method stands after one step at a chain nearby: right to the second order,
 * whatever factor F carries there. */
static bool one_step(search *s, const double *t, const cplx *roots, int count, cplx *out)
{
    strum_taut *chain = search_chain(s, t);
    if (chain == NULL)
        return false;
    for (int k = 0; k < count; k++) {
        const taut_at at = taut_at_s(roots[k], 1.0);
        taut_value value;
        taut_characteristic(chain, &at, &value);
        out[k] = roots[k] - over(value.f, value.d);
    }
    strum_taut_free(chain);
    return true;
}

/* The two places beside t along variable j; returns their distance. */
static double beside(const search *s, const double *t, int j, double *lower, double *upper)
{
    const size_t size = (size_t)s->params->variables * sizeof *t;
    memcpy(lower, t, size);
    memcpy(upper, t, size);
    lower[j] = fmax(t[j] - DIFFERENCE, 0.0);
    upper[j] = fmin(t[j] + DIFFERENCE, 1.0);
    return upper[j] - lower[j];
}

static bool slopes(search *s, const double *t, const cplx *roots, int count,
                   cplx (*out)[VARIABLES])
{
    double lower[VARIABLES], upper[VARIABLES];
    cplx at_lower[FOLLOWED_MAX], at_upper[FOLLOWED_MAX];
    for (int j = 0; j < s->params->variables; j++) {
        const double apart = beside(s, t, j, lower, upper);
        if (!one_step(s, lower, roots, count, at_lower) ||
            !one_step(s, upper, roots, count, at_upper))
            return false;
        for (int k = 0; k < count; k++)
            out[k][j] = (at_upper[k] - at_lower[k]) / apart;
    }
    return true;
}

/* The roots followed to t; one that no longer oscillates or escapes becomes 0 and limits
 * nothing there. */
static bool follow(climb *r, const double *t, cplx *s)
{
    strum_taut *chain = search_chain(r->search, t);
    if (chain == NULL)
        return false;
    taut_search newton = {.chain = chain, .spacing = r->spacing};
    for (int k = 0; k < r->count; k++) {
        const followed *root = &r->roots[k];
        cplx move = 0.0;
        for (int j = 0; j < r->search->params->variables; j++)
            move += (t[j] - r->from[j]) * root->slope[j];
        if (cabs(move) > r->spacing)
            move *= r->spacing / cabs(move);
        s[k] = root->s + move;
        if (!taut_newton(&newton, &s[k]) || !(cimag(s[k]) > 0.0))
            s[k] = 0.0;
    }
    strum_taut_free(chain);
    return true;
}

/* ---- the conditions, for NLopt: c <= 0 ---- */

static double level_of(unsigned n, const double *x, double *gradient, void *data)
{
    (void)data;
    if (gradient != NULL) {
        memset(gradient, 0, n * sizeof *gradient);
        gradient[n - 1] = 1.0;
    }
    return x[n - 1];
}

static double rule_value(const climb *r, const followed *root, cplx s, double level)
{
    const strum_absorber_params *p = r->search->params;
    return root->rule == RULE_BELOW   ? (cimag(s) - p->lowest) / r->spacing + OUTSIDE
           : root->rule == RULE_ABOVE ? (p->highest - cimag(s)) / r->spacing + OUTSIDE
                                      : level - ratio_of(s) / r->level;
}

static double rule_slope(const climb *r, const followed *root, cplx s, cplx ds)
{
    return root->rule == RULE_BELOW   ? cimag(ds) / r->spacing
           : root->rule == RULE_ABOVE ? -cimag(ds) / r->spacing
                                      : -ratio_slope(s, ds) / r->level;
}

static void give_up(climb *r, unsigned m, double *c)
{
    memset(c, 0, m * sizeof *c);
    (void)nlopt_force_stop(r->opt);
}

static void conditions(unsigned m, double *c, unsigned n, const double *x, double *gradient,
                       void *data)
{
    climb *r = data;
    cplx s[FOLLOWED_MAX], ds[FOLLOWED_MAX][VARIABLES];
    search_count(r->search);
    if (!search_goes_on(r->search) || !follow(r, x, s) ||
        (gradient != NULL && !slopes(r->search, x, s, r->count, ds))) {
        give_up(r, m, c);
        return;
    }
    if (gradient != NULL)
        memset(gradient, 0, (size_t)m * n * sizeof *gradient);
    for (int k = 0; k < r->count; k++) {
        const followed *root = &r->roots[k];
        c[k] = s[k] == 0.0 ? -1.0 : rule_value(r, root, s[k], x[n - 1]);
        if (gradient == NULL || s[k] == 0.0)
            continue;
        for (int j = 0; j < r->search->params->variables; j++)
            gradient[(unsigned)k * n + (unsigned)j] = rule_slope(r, root, s[k], ds[k][j]);
        if (root->rule == RULE_DAMPED)
            gradient[(unsigned)k * n + n - 1] = 1.0;
    }
    if (r->twin == 0.0)
        return;
    const cplx twin = r->twin + cabs(r->twin) * CMPLX(x[n - 3], x[n - 2]);
    c[r->count] = x[n - 1] - ratio_of(twin) / r->level;
    if (gradient == NULL)
        return;
    gradient += (unsigned)r->count * n;
    gradient[n - 3] = -ratio_slope(twin, cabs(r->twin)) / r->level;
    gradient[n - 2] = -ratio_slope(twin, CMPLX(0.0, cabs(r->twin))) / r->level;
    gradient[n - 1] = 1.0;
}

/* F and dF/ds at the twin, in the units of the round. */
static bool twin_value(climb *r, const double *t, cplx s, cplx out[2])
{
    strum_taut *chain = search_chain(r->search, t);
    if (chain == NULL)
        return false;
    const taut_at at = taut_at_s(s, 1.0);
    taut_value value;
    taut_characteristic(chain, &at, &value);
    strum_taut_free(chain);
    const double scale = exp(value.log_scale - r->twin_log) / r->twin_scale;
    out[0] = scale * value.f;
    out[1] = scale * cabs(r->twin) * value.d;
    return true;
}

static void put(double *gradient, unsigned n, unsigned j, const cplx d[2])
{
    for (unsigned k = 0; k < 2; k++) {
        gradient[2 * k * n + j] = creal(d[k]);
        gradient[(2 * k + 1) * n + j] = cimag(d[k]);
    }
}

static void twin_conditions(unsigned m, double *c, unsigned n, const double *x,
                            double *gradient, void *data)
{
    climb *r = data;
    const double size = cabs(r->twin);
    const cplx s = r->twin + size * CMPLX(x[n - 3], x[n - 2]);
    double lower[VARIABLES], upper[VARIABLES];
    cplx here[2], low[2], high[2], d[2];
    bool good = twin_value(r, x, s, here);
    if (good && gradient != NULL) {
        memset(gradient, 0, (size_t)m * n * sizeof *gradient);
        for (int j = 0; j < r->search->params->variables && good; j++) {
            const double apart = beside(r->search, x, j, lower, upper);
            good = twin_value(r, lower, s, low) && twin_value(r, upper, s, high);
            for (int k = 0; k < 2 && good; k++)
                d[k] = (high[k] - low[k]) / apart;
            if (good)
                put(gradient, n, (unsigned)j, d);
        }
        good = good && twin_value(r, x, s - DIFFERENCE * size, low) &&
               twin_value(r, x, s + DIFFERENCE * size, high);
        d[0] = here[1];
        d[1] = (high[1] - low[1]) / (2.0 * DIFFERENCE);
        if (good)
            put(gradient, n, n - 3, d);
        d[0] = times(I, d[0]);
        d[1] = times(I, d[1]);
        if (good)
            put(gradient, n, n - 2, d);
    }
    if (!good) {
        give_up(r, m, c);
        return;
    }
    for (int k = 0; k < 2; k++) {
        c[2 * k] = creal(here[k]);
        c[2 * k + 1] = cimag(here[k]);
    }
}

/* ---- a round ---- */

static bool before(const followed *a, const followed *b)
{
    const bool limits = a->rule == RULE_DAMPED;
    return limits != (b->rule == RULE_DAMPED) ? limits : ratio_of(a->s) < ratio_of(b->s);
}

/* Takes the roots about r->from: first those that limit, the least damped one first. False when
 * there is nothing to follow. */
static bool begin(climb *r, double level)
{
    search *s = r->search;
    const strum_absorber_params *p = s->params;
    strum_taut *chain = search_chain(s, r->from);
    if (chain == NULL)
        return false;
    r->spacing = taut_spacing(chain);
    r->level = level;
    r->count = 0;
    strum_taut_free(chain);
    strum_taut_roots *roots = search_roots(s, r->from, r->spacing);
    for (size_t i = 0; roots != NULL && i < roots->count; i++) {
        const cplx root = CMPLX(-roots->roots[i].decay, roots->roots[i].frequency);
        const followed new = {.s = root,
                              .rule = p->modes != NULL           ? RULE_DAMPED
                                      : cimag(root) < p->lowest  ? RULE_BELOW
                                      : cimag(root) > p->highest ? RULE_ABOVE
                                                                 : RULE_DAMPED};
        int at = r->count < FOLLOWED_MAX ? r->count++ : FOLLOWED_MAX - 1;
        for (; at > 0 && before(&new, &r->roots[at - 1]); at--)
            r->roots[at] = r->roots[at - 1];
        r->roots[at] = new;
    }
    strum_taut_roots_free(roots);
    return r->count > 0;
}

static bool set_slopes(climb *r)
{
    cplx s[FOLLOWED_MAX], ds[FOLLOWED_MAX][VARIABLES];
    for (int k = 0; k < r->count; k++)
        s[k] = r->roots[k].s;
    if (!slopes(r->search, r->from, s, r->count, ds))
        return false;
    for (int k = 0; k < r->count; k++)
        memcpy(r->roots[k].slope, ds[k], sizeof ds[k]);
    return true;
}

/* The best place for the level within `reach` of r->from, into t. */
static bool go(climb *r, double reach, double *t)
{
    const int variables = r->search->params->variables;
    const unsigned twin = r->twin != 0.0, n = (unsigned)variables + 2 * twin + 1;
    const unsigned m = (unsigned)r->count + twin;
    double x[VARIABLES + 3] = {0}, low[VARIABLES + 3], high[VARIABLES + 3], level;
    double tolerance[FOLLOWED_MAX + 1];
    for (unsigned k = 0; k < m || k < 4; k++)
        tolerance[k] = FEASIBLE;
    for (int j = 0; j < variables; j++) {
        x[j] = r->from[j];
        low[j] = fmax(x[j] - reach, 0.0);
        high[j] = fmin(x[j] + reach, 1.0);
    }
    for (unsigned j = (unsigned)variables; j < n; j++) {
        low[j] = j < n - 1 ? -0.3 : 0.0;
        high[j] = j < n - 1 ? 0.3 : 1e9;
    }
    x[n - 1] = 1.0;
    r->opt = nlopt_create(NLOPT_LD_SLSQP, n);
    if (r->opt == NULL) {
        r->search->broken = STRUM_ERR_MEMORY;
        return false;
    }
    nlopt_result end = nlopt_set_max_objective(r->opt, level_of, NULL);
    if (end > 0)
        end = nlopt_add_inequality_mconstraint(r->opt, m, conditions, r, tolerance);
    if (end > 0 && twin)
        end = nlopt_add_equality_mconstraint(r->opt, 4, twin_conditions, r, tolerance);
    nlopt_set_lower_bounds(r->opt, low);
    nlopt_set_upper_bounds(r->opt, high);
    nlopt_set_xtol_abs1(r->opt, 1e-12);
    nlopt_set_maxeval(r->opt, 40);
    if (end > 0)
        end = nlopt_optimize(r->opt, x, &level);
    nlopt_destroy(r->opt);
    if (end == NLOPT_OUT_OF_MEMORY)
        r->search->broken = STRUM_ERR_MEMORY;
    memcpy(t, x, (size_t)variables * sizeof *t);
    return search_goes_on(r->search);
}

static double most_apart(int n, const double *a, const double *b)
{
    double most = 0.0;
    for (int j = 0; j < n; j++)
        most = fmax(most, fabs(a[j] - b[j]));
    return most;
}

/* Makes the two least damped roots one unknown, when they are close. */
static bool make_twins(climb *r)
{
    if (r->search->params->variables < 2 || r->count < 2 || r->roots[1].rule != RULE_DAMPED ||
        !(cabs(r->roots[0].s - r->roots[1].s) < 0.1 * r->spacing))
        return false;
    cplx low[2], high[2];
    r->twin = 0.5 * (r->roots[0].s + r->roots[1].s);
    r->twin_scale = 1.0;
    r->count -= 2;
    memmove(r->roots, r->roots + 2, (size_t)r->count * sizeof *r->roots);
    const double step = DIFFERENCE * cabs(r->twin);
    if (!twin_value(r, r->from, r->twin - step, low) ||
        !twin_value(r, r->from, r->twin + step, high))
        return false;
    r->twin_scale = cabs(high[1] - low[1]) / (2.0 * DIFFERENCE);
    return r->twin_scale > 0.0 && isfinite(r->twin_scale);
}

double absorber_climb(search *s, double *t, double reach, int rounds, double gain)
{
    const int n = s->params->variables;
    double best = search_trial(s, t), at[VARIABLES], also[VARIABLES];
    for (; rounds > 0 && best > 0.0 && reach > 1e-10 && search_goes_on(s); rounds--) {
        climb r = {.search = s};
        memcpy(r.from, t, (size_t)n * sizeof *t);
        if (!begin(&r, best) || !set_slopes(&r) || !go(&r, reach, at))
            break;
        double found = search_trial(s, at);
        if (found < 1.01 * best && make_twins(&r) && go(&r, reach, also)) {
            const double coalesced = search_trial(s, also);
            if (coalesced > found) {
                found = coalesced;
                memcpy(at, also, sizeof at);
                if (n == 2) /* the double root takes both variables */
                    rounds = 1;
            }
        }
        const double moved = most_apart(n, at, t);
        if (!(found > best)) { /* other roots came to limit: nearer */
            reach = 0.25 * (moved > 0.0 ? fmin(reach, moved) : reach);
            continue;
        }
        const bool little = found < best * (1.0 + gain);
        best = found;
        memcpy(t, at, (size_t)n * sizeof *t);
        if (little)
            break;
        reach = moved > 0.9 * reach ? fmin(2.0 * reach, 0.5) : fmax(0.5 * reach, moved);
    }
    return best;
}
