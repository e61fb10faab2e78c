/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Gale's series: equations, matching point, and the search for the zeros of the determinant. */
#include "core/suspended/series/series.h"

#include <math.h>
#include <stdlib.h>

#include "core/suspended/modes.h"
#include "core/numerics/status.h"
#include "core/numerics/work.h"

strum_status strum_series_applies(const strum_cable *c, strum_plane plane, strum_error *error)
{
    if (c->eta_t > 0 || c->eta_n > 0)
        return error_at(error, STRUM_ERR_METHOD, STRUM_SERIES_ARG_CABLE, STRUM_NO_INDEX,
                        "the series method has no damping");
    if (c->kappa_n > 0 || (c->kappa_t > 0 && plane == STRUM_IN_PLANE))
        return error_at(error, STRUM_ERR_METHOD, STRUM_SERIES_ARG_CABLE, STRUM_NO_INDEX,
                        "the series method takes the cable as inextensible");
    if (c->mass_t != c->mass_n && plane == STRUM_IN_PLANE)
        return error_at(error, STRUM_ERR_METHOD, STRUM_SERIES_ARG_CABLE, STRUM_NO_INDEX,
                        "the series method has no added mass in plane");
    const double chi = fabs(c->chi_m) + c->mu, limit = strum_chi_of_xi(4);
    if (!(c->mu > 0 && chi < limit))
        return error_at(error, STRUM_ERR_METHOD, STRUM_SERIES_ARG_CABLE, STRUM_NO_INDEX,
                        "the series about xi = 2 diverges from |xi| = 4 on; an end is at "
                        "|xi| = %.6g",
                        strum_xi_of_chi(chi));
    return STRUM_OK;
}

static long double xi_of(long double chi)
{
    const long double sh = sinhl(chi / 2);
    return chi < 0 ? -2 * sh * sh : 2 * sh * sh;
}

/* About xi = 0 the terms shrink like |xi|^k (in plane), about xi = 2 like |xi/2 - 1|^k: at 0.6
 * both serve with about as many, and fewer digits cancel than at Gale's 0.7. A cable that stays
 * above 0.35 needs the second series alone. */
#define MATCH       0.6L
#define MATCH_LEAST 0.35L

static double problem_reach(const series_problem *p)
{
    return fmax(p->near_zero ? (double)p->zero.reach : 0,
                p->near_two ? (double)p->two.reach : 0);
}

static void problem_make(const strum_cable *c, strum_plane plane, series_problem *p)
{
    *p = (series_problem){.m = plane == STRUM_IN_PLANE ? 2 : 1};
    p->chi_1 = (long double)c->chi_m - (long double)c->mu;
    p->chi_2 = (long double)c->chi_m + (long double)c->mu;
    p->xi_1 = xi_of(p->chi_1);
    p->xi_2 = xi_of(p->chi_2);
    const long double size_1 = fabsl(p->xi_1), size_2 = fabsl(p->xi_2);
    const long double far = fmaxl(size_1, size_2);
    const long double near = p->chi_1 * p->chi_2 < 0 ? 0 : fminl(size_1, size_2);
    p->match = MATCH;
    p->near_two = far > MATCH;
    p->near_zero = !p->near_two || near < MATCH_LEAST;
    series_recursion_make(&p->zero, p->m, true);
    series_recursion_make(&p->two, p->m, false);
    p->zero.reach = p->near_two ? MATCH : far;
    const long double nearest = p->near_zero ? MATCH : near;
    p->two.reach = fmaxl(fabsl(far - 2), fabsl(nearest - 2)) / 2;
    /* 113 bits of the ratio of terms, and what frequency adds to them */
    const double reach = problem_reach(p);
    p->room = (int)fmin(400 - 120 / log(reach), SERIES_TERMS_MAX);
}

static strum_status problem_allocate(series_problem *p, arena *a)
{
    const size_t room = (size_t)p->room;
    p->zero.room = p->two.room = p->room;
    p->zero.rows = arena_alloc(a, 2 * (size_t)p->m * room, sizeof *p->zero.rows);
    p->two.rows = arena_alloc(a, room, sizeof *p->two.rows);
    for (int i = 0; i < SERIES_ARITHMETICS; i++) {
        p->work[i] = arena_alloc(a, 4 * (size_t)p->m * room, 16); /* no real is larger */
        if (p->work[i] == NULL)
            return STRUM_ERR_MEMORY;
    }
    return p->zero.rows == NULL || p->two.rows == NULL ? STRUM_ERR_MEMORY : STRUM_OK;
}

/* An interval with one frequency in it; or with a multiple one, when it is too short to split.
 */
typedef struct bracket {
    long double low, high;
    strum_symmetry symmetry;
} bracket;

typedef struct search {
    series_problem problem;
    int finest, counting; /* arithmetic allowed; arithmetic in which the count is done */
    bracket *brackets;
    int found, room;
    arena memory;
    work *work;
    strum_error *error;
} search;

/* An evaluation of the series takes about so long a term, in microseconds. */
#define TERM_US 0.1

/* Before each evaluation. */
static strum_status ask(const search *s)
{
    return work_spend(s->work, TERM_US * s->problem.terms);
}

/* What rounding may have eaten of an element's stiffness for its sign to be trusted. */
#define ASYMMETRY_MAX 1e-6L
/* Promised relative accuracy. */
#define TOLERANCE 1e-12

static strum_status refuse_digits(const search *s, long double w)
{
    return error_set(
        s->error, STRUM_ERR_ACCURACY,
        "near frequency ratio %.4g the terms of the power series cancel so far that %d bit "
        "arithmetic cannot give %.0e; ask for fewer modes or use method galerkin",
        (double)w, series_arithmetics[s->finest].bits, TOLERANCE);
}

/* Frequencies of the problem's symmetry below w. */
static strum_status count_below(search *s, long double w, int *count)
{
    long double asymmetry;
    const strum_status status = ask(s);
    if (status != STRUM_OK)
        return status;
    *count = series_arithmetics[s->counting].count(&s->problem, w, &asymmetry);
    while (asymmetry > ASYMMETRY_MAX && asymmetry <= 1 && s->counting < s->finest)
        *count = series_arithmetics[++s->counting].count(&s->problem, w, &asymmetry);
    if (asymmetry > 1)
        return error_set(
            s->error, STRUM_ERR_ACCURACY,
            "the series need more than %d terms at |xi| = %.6g (they diverge at 4)",
            SERIES_TERMS_MAX, (double)fmaxl(fabsl(s->problem.xi_1), fabsl(s->problem.xi_2)));
    return asymmetry <= ASYMMETRY_MAX ? STRUM_OK : refuse_digits(s, w);
}

static strum_status isolate(search *s, long double low, int below, long double high, int above)
{
    if (above == below)
        return STRUM_OK;
    const long double middle = low + (high - low) / 2;
    if (above == below + 1 || high - low < 1e-16L * high) {
        for (int i = below; i < above && s->found < s->room; i++)
            s->brackets[s->found++] = (bracket){low, high, s->problem.symmetry};
        return STRUM_OK;
    }
    int between;
    strum_status status = count_below(s, middle, &between);
    if (status == STRUM_OK && (between < below || between > above))
        status = refuse_digits(s, middle);
    if (status == STRUM_OK)
        status = isolate(s, low, below, middle, between);
    return status == STRUM_OK ? isolate(s, middle, between, high, above) : status;
}

/* Brackets of at least the first `count` frequencies, class by class. */
static strum_status isolate_all(search *s, const strum_cable *cable, strum_plane plane,
                                int count)
{
    const bool level = cable->chi_m == 0;
    const strum_symmetry first = level ? STRUM_SYMMETRIC : STRUM_NO_SYMMETRY;
    const int classes = level ? 2 : 1;
    const double unit = M_PI / spectrum_phase_count(cable, plane, M_PI);
    long double high = (count + 0.5 + s->problem.m - 1) * unit;
    int above[2], total = 0;
    while (total < count) {
        total = 0;
        for (int i = 0; i < classes; i++) {
            s->problem.symmetry = (strum_symmetry)((int)first + i);
            const strum_status status = count_below(s, high, &above[i]);
            if (status != STRUM_OK)
                return status;
            total += above[i];
        }
        if (total < count)
            high *= 1.15L;
    }
    s->room = total;
    s->brackets = arena_alloc(&s->memory, (size_t)total, sizeof *s->brackets);
    if (s->brackets == NULL)
        return STRUM_ERR_MEMORY;
    for (int i = 0; i < classes; i++) {
        s->problem.symmetry = (strum_symmetry)((int)first + i);
        const strum_status status = isolate(s, 0, 0, high, above[i]);
        if (status != STRUM_OK)
            return status;
    }
    return STRUM_OK;
}

/* Zero of the determinant between a and b, where its signs differ: bisection, or inverse
 * quadratic interpolation where Chandrupatla's criterion trusts it (Adv. Eng. Software 28,
 * 1997). */
static long double zero_between(search *s, const series_arithmetic *arithmetic, long double a,
                                long double b, long double fa, long double fb)
{
    long double c = a, fc = fa, t = 0.5L;
    for (int i = 0; i < 200; i++) {
        const long double x = a + t * (b - a);
        bool converged;
        if (ask(s) != STRUM_OK) /* the caller sees it */
            break;
        const long double f = arithmetic->determinant(&s->problem, x, &converged);
        if ((f > 0) == (fa > 0)) {
            c = a;
            fc = fa;
        } else {
            c = b;
            b = a;
            fc = fb;
            fb = fa;
        }
        a = x;
        fa = f;
        const long double best = fabsl(fa) < fabsl(fb) ? a : b;
        const long double least = 1e-18L * best / fabsl(b - a);
        if (least > 0.5L || fa == 0 || fb == 0)
            return best;
        const long double xi = (a - b) / (c - b), phi = (fa - fb) / (fc - fb);
        t = phi * phi < xi && (1 - phi) * (1 - phi) < 1 - xi
                ? fa / (fb - fa) * fc / (fb - fc) +
                      (c - a) / (b - a) * fa / (fc - fa) * fb / (fc - fb)
                : 0.5L;
        t = fminl(fmaxl(t, least), 1 - least);
    }
    return a;
}

/* The next coarser arithmetic: what it gets differently, scaled by their units of rounding, is
 * about the rounding of the finer one; SAFETY covers the spread. */
#define SAFETY 16
static const series_arithmetic *coarser(int finer)
{
    for (int i = finer - 1; i >= 0; i--)
        if (series_arithmetics[i].bits < series_arithmetics[finer].bits)
            return &series_arithmetics[i];
    return NULL;
}

/* The frequency in a bracket and its estimated relative error; infinite where this arithmetic
 * cannot find it. */
static long double refine(search *s, const bracket *in, int level, double *error)
{
    const series_arithmetic *arithmetic = &series_arithmetics[level], *other = coarser(level);
    bool good[4];
    *error = INFINITY;
    s->problem.symmetry = in->symmetry;
    const long double fa = arithmetic->determinant(&s->problem, in->low, &good[0]);
    const long double fb = arithmetic->determinant(&s->problem, in->high, &good[1]);
    if (!good[0] || !good[1] || (fa > 0) == (fb > 0) || other == NULL)
        return 0;
    const long double w = zero_between(s, arithmetic, in->low, in->high, fa, fb), h = 1e-6L * w;
    const long double f = arithmetic->determinant(&s->problem, w, &good[0]);
    const long double g = arithmetic->determinant(&s->problem, w + h, &good[1]);
    /* two samples: one may be small by luck */
    const long double lost = fmaxl(fabsl(other->determinant(&s->problem, w, &good[2]) - f),
                                   fabsl(other->determinant(&s->problem, w + h, &good[3]) - g));
    if (good[0] && good[1] && good[2] && good[3])
        *error = (double)(SAFETY * ldexpl(lost, other->bits - arithmetic->bits) * h /
                              (fabsl(g - f) * w) +
                          0x1p-53L);
    return w;
}

typedef struct found {
    bracket in;
    int level; /* arithmetic that resolved it */
    long double w;
    double error;
} found;

static int by_w(const void *left, const void *right)
{
    const found *l = left, *r = right;
    return l->w < r->w ? -1 : l->w > r->w;
}

/* The frequencies in all brackets, in quadruple precision where extended does not do. A bracket
 * that neither resolves counts with its lower end, so that it cannot be taken for a later mode.
 */
static strum_status refine_all(search *s, int count, double mass, strum_mode *modes,
                               strum_series_report *report)
{
    found *all = arena_alloc(&s->memory, (size_t)s->found, sizeof *all);
    if (all == NULL)
        return STRUM_ERR_MEMORY;
    for (int i = 0; i < s->found; i++) {
        if (ask(s) != STRUM_OK)
            return s->work->status;
        all[i].in = s->brackets[i];
        for (all[i].level = SERIES_EXTENDED; all[i].level <= s->finest; all[i].level++) {
            all[i].w = refine(s, &all[i].in, all[i].level, &all[i].error);
            if (all[i].error <= TOLERANCE)
                break;
            all[i].w = all[i].in.low;
        }
    }
    if (s->work->status != STRUM_OK)
        return s->work->status;
    qsort(all, (size_t)s->found, sizeof *all, by_w);
    for (int i = 0; i < count; i++) {
        if (!(all[i].error <= TOLERANCE))
            return refuse_digits(s, all[i].in.high);
        const int bits = series_arithmetics[all[i].level].bits;
        report->mantissa_bits = bits > report->mantissa_bits ? bits : report->mantissa_bits;
        report->error = fmax(report->error, all[i].error);
        modes[i] = (strum_mode){.frequency = (double)(all[i].w / sqrtl(mass)),
                                .symmetry = all[i].in.symmetry};
    }
    return STRUM_OK;
}

/* With its own room; errors without a reason are STRUM_ERR_MEMORY and what the work ended. */
static strum_status solve(search *s, const strum_series_params *params, strum_mode *modes,
                          strum_series_report *report)
{
    const strum_cable *c = &params->cable;
    const strum_cable unit = {.chi_m = c->chi_m, .mu = c->mu, .mass_t = 1, .mass_n = 1};
    problem_make(&unit, params->plane, &s->problem);
    strum_status status = problem_allocate(&s->problem, &s->memory);
    if (status == STRUM_OK)
        status = isolate_all(s, &unit, params->plane, params->count);
    if (status == STRUM_OK)
        status = refine_all(s, params->count, c->mass_n, modes, report);
    report->terms = s->problem.terms;
    report->evaluations = s->problem.evaluations;
    report->matching_xi = s->problem.near_zero && s->problem.near_two ? (double)MATCH : 0;
    return status;
}

strum_status strum_series_solve(const strum_series_params *params, const strum_options *options,
                                strum_mode *modes, strum_series_report *report,
                                strum_error *error)
{
    *report = (strum_series_report){0};
    strum_status status = strum_series_applies(&params->cable, params->plane, error);
    if (status != STRUM_OK)
        return status;
    if (params->count < 1 || params->count > STRUM_MODES_MAX)
        return error_at(error, STRUM_ERR_RANGE, STRUM_SERIES_ARG_COUNT, STRUM_NO_INDEX,
                        "1 to %d modes can be asked for", STRUM_MODES_MAX);
    work w = work_begin(options);
    search s = {.finest = params->thorough ? SERIES_QUADRUPLE : SERIES_EXTENDED,
                .counting = SERIES_EXTENDED,
                .memory = {.work = &w},
                .work = &w,
                .error = error};
    status = solve(&s, params, modes, report);
    arena_free(&s.memory);
    return status == STRUM_ERR_ACCURACY ? status : work_result(&w, status, error);
}

double strum_series_work(const strum_series_params *params)
{
    const strum_cable *cable = &params->cable;
    const strum_plane plane = params->plane;
    const int count = params->count;
    if (strum_series_applies(cable, plane, NULL) != STRUM_OK)
        return 0;
    series_problem p;
    problem_make(cable, plane, &p);
    const double terms = fmin(20 - 46 / log(problem_reach(&p)), SERIES_TERMS_MAX);
    const double evaluation = terms * 2 * p.m * (p.near_zero && p.near_two ? 1.7 : 1);
    /* the phase of the last mode that a series must span: its exponential is what cancels */
    const double w = (count + 1) * M_PI / spectrum_phase_count(cable, plane, M_PI);
    const double chi = fabs(cable->chi_m) + cable->mu;
    const double loss = 0.8 * w * fmin(chi * sqrt(cosh(0.7 * chi)), 1.2);
    /* measured, in microseconds a term: 0.055 in extended, 0.4 in quadruple precision */
    return 20 + evaluation * (0.055 * (17 * count + 10) +
                              (params->thorough && loss > 18 ? 0.12 * loss * count : 0));
}
