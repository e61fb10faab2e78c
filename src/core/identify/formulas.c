/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The formulas that practice compares with. */
#include "core/identify/report.h"

/* What the formulas take. C = sqrt(EI/(m L^4)); xi = L sqrt(T/EI) of the answer itself. */
typedef struct cable {
    const problem *p;
    const state *s;
    double length, mass, bending, c;
} cable;

static double xi_of(const cable *k, double tension)
{
    return k->bending > 0 ? k->length * sqrt(fmax(tension, 0) / k->bending) : HUGE_VAL;
}

/* One branch: m (f L)^2 [a0 + a1 C/f + a2 (C/f)^2] for xi from `low` to `high`. */
typedef struct branch {
    double low, high, a0, a1, a2;
    const char *name;
} branch;

/* H. Zui, T. Shinke and Y. Namita, 1996, of cables with small sag and fixed ends. */
static const branch zui_1[] = {{17, HUGE_VAL, 4, 4 * -2.20, 4 * -0.550, "xi >= 17"},
                               {6, 17, 4 * 0.865, 0, 4 * -11.6, "6 <= xi <= 17"},
                               {0, 6, 4 * 0.828, 0, 4 * -10.5, "xi <= 6"},
                               {.name = NULL}};
static const branch zui_2[] = {{60, HUGE_VAL, 1, -4.40, -1.10, "xi >= 60"},
                               {17, 60, 1.03, -6.33, -1.58, "17 <= xi <= 60"},
                               {0, 17, 0.882, 0, -85.0, "xi <= 17"},
                               {.name = NULL}};
/* W. X. Ren, G. Chen and W. H. Hu, 2005, bending: of mode 1. (2 L f - 2.363 C L)^2 m written out. */
static const branch ren[] = {{210, HUGE_VAL, 4, 0, 0, "xi >= 210: string"},
                             {18, 210, 4, -4 * 2.363, 2.363 * 2.363, "18 <= xi <= 210"},
                             {0, 18, 3.432, 0, -45.191, "xi <= 18"},
                             {.name = NULL}};

/* The branch that holds its own answer, else the nearest. */
static double by_branches(const cable *k, const branch *all, double f, const char **name,
                          bool *outside)
{
    double best = NAN, miss = HUGE_VAL;
    const double r = k->c / f;
    for (const branch *b = all; b->name != NULL; b++) {
        const double t =
            k->mass * f * f * k->length * k->length * (b->a0 + b->a1 * r + b->a2 * r * r);
        const double xi = xi_of(k, t);
        const double away = !(t > 0)       ? 1e300
                            : xi < b->low  ? log(b->low / xi)
                            : xi > b->high ? log(xi / b->high)
                                           : 0;
        if (away < miss) {
            miss = away;
            best = t;
            *name = b->name;
        }
    }
    *outside = miss > 0;
    return best;
}

/* A. B. Mehrabi and H. Tabatabai, 1998: f over that of the string is
 * (1 + 0.039 mu)(1 + 2/xi + (4 + n^2 pi^2/2)/xi^2) - 0.24 mu/xi, mu = lambda^2 for n = 1, else 0.
 * With s = sqrt T, f_s = c s, 1/xi = a/s this is quadratic in s for a given mu. */
static double mehrabi_tabatabai(const cable *k, int n, double f)
{
    const double c = n / (2 * k->length * sqrt(k->mass));
    const double a = sqrt(k->bending) / k->length, b = a * a * (4 + n * n * M_PI * M_PI / 2);
    state at = *k->s;
    double mu = 0, s = f / c;
    for (int i = 0; i < 100; i++) {
        const double w = 1 + 0.039 * mu;
        const double half = 0.5 * ((f / c + 0.24 * mu * a) / w - 2 * a);
        const double root = half * half - b;
        if (root < 0 || half <= 0)
            return NAN;
        s = half + sqrt(root);
        at.q[TENSION] = s * s;
        const double next = n == 1 ? state_lambda2(k->p, &at) : 0;
        if (fabs(next - mu) <= 1e-14 * next)
            break;
        mu = next;
    }
    return s * s;
}

static void regress(const cable *k, strum_identify_comparison *o)
{
    double n = 0, x = 0, y = 0, xx = 0, xy = 0;
    for (size_t i = 0; i < k->p->ratios_at; i++) {
        const double m = k->p->modes[i], f = k->p->measured[i], u = m * m, v = f * f / u;
        n += 1;
        x += u;
        y += v;
        xx += u * u;
        xy += u * v;
    }
    const double slope = (n * xy - x * y) / (n * xx - x * x), at_0 = (y - slope * x) / n;
    const double ml2 = k->mass * k->length * k->length;
    o->regression = n > 1 ? 4 * ml2 * at_0 : NAN;
    o->regression_bending =
        n > 1 ? 4 * ml2 * k->length * k->length * slope / (M_PI * M_PI) : NAN;
}

static void compare_mode(const cable *k, size_t i, strum_identify_comparison *o)
{
    const int n = k->p->modes[i];
    const double f = k->p->measured[i], ml2 = k->mass * k->length * k->length;
    o->string_rule[i] = 4 * ml2 * f * f / n / n;
    o->string_mean += f / n;
    o->mehrabi_tabatabai[i] = mehrabi_tabatabai(k, n, f);
    o->mehrabi_tabatabai_outside[i] =
        !(xi_of(k, o->mehrabi_tabatabai[i]) >= 50) || state_lambda2(k->p, k->s) > 3.1;
    o->zui_n[i] = NAN;
    if (n == 1) {
        o->zui_1 = by_branches(k, zui_1, f, &o->zui_1_branch, &o->zui_1_outside);
        o->ren = by_branches(k, ren, f, &o->ren_branch, &o->ren_outside);
    } else if (n == 2) {
        o->zui_2 = by_branches(k, zui_2, f, &o->zui_2_branch, &o->zui_2_outside);
    } else {
        o->zui_n[i] = 4 * ml2 * f * f / n / n * (1 - 2.20 * n * k->c / f);
        o->zui_n_outside[i] = !(xi_of(k, o->zui_n[i]) >= 200);
    }
}

strum_status strum_identify_compare(const strum_identify *found,
                                    strum_identify_comparison *comparison)
{
    const problem *p = &found->p;
    const state *s = &found->fits[0].at;
    if (p->ratios_at == 0 || isnan(found->modes[0].string_rule))
        return STRUM_ERR_METHOD;
    cable k = {p, s, s->q[LENGTH], state_mass(p, s), s->q[BENDING], 0};
    k.c = sqrt(k.bending / k.mass) / (k.length * k.length);
    *comparison = (strum_identify_comparison){.zui_1 = NAN, .zui_2 = NAN, .ren = NAN};
    for (size_t i = 0; i < p->ratios_at; i++)
        compare_mode(&k, i, comparison);
    const double mean = 2 * k.length * comparison->string_mean / (double)p->ratios_at;
    comparison->string_mean = k.mass * mean * mean;
    regress(&k, comparison);
    return STRUM_OK;
}
