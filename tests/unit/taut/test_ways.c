/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Random damped chains, asked for their roots by place, as a window, by mode number and as a
 * band: the same roots and the same numbers must come by every way. Symmetric chains, absorbers
 * on nodes, spans behind stiff springs, dampers next to the impedance of their cable and far
 * above it are drawn on purpose.
 *
 *     STRUM_WAYS=20000 STRUM_WAYS_SEED=1 test_taut_ways      that many, from that seed
 *     STRUM_WAYS_ONLY=137 test_taut_ways                     one of them, with its roots
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "taut/parts.h"

#define PARTS_MAX 24
/* Chains without STRUM_WAYS. */
#define USUAL 90
/* Roots agree to this share of |w|; where two nearly coalesce to half their digits. */
#define SAME      1e-9
#define SAME_TWIN 3e-6

typedef struct sketch {
    strum_taut_component parts[PARTS_MAX];
    strum_taut_link links[2];
    strum_taut_joint joint;
    size_t count;
    strum_taut_end left, right;
} sketch;

static void add(sketch *s, strum_taut_component part)
{
    s->parts[s->count++] = part;
}

/* A damper about the matched one: exactly, nearly, practical or strong. */
static double damper_of(uint64_t *seed, double matched)
{
    switch ((int)draw(seed, 0.0, 4.99)) {
    case 0:
        return matched;
    case 1:
        return matched * (1.0 + (draw(seed, 0, 1) < 0.5 ? -1 : 1) * draw_log(seed, 1e-9, 0.1));
    case 2:
        return matched * draw_log(seed, 1e2, 1e7);
    default:
        return matched * draw_log(seed, 0.01, 30.0);
    }
}

static strum_taut_component device(uint64_t *seed, sketch *s, double tension, double z)
{
    switch ((int)draw(seed, 0.0, 4.99)) {
    case 0:
        return part_hanging(draw_log(seed, 0.1, 20.0), draw_log(seed, 1.0, 1e4),
                            draw_log(seed, 0.01, 100.0));
    case 1:
        return part_mass(draw_log(seed, 0.1, 1e4));
    case 2:
        s->links[0] = s->links[1] = (strum_taut_link){0.2, 0.2, draw_log(seed, 0.5, 20), 0.1};
        s->joint = (strum_taut_joint){0.03, 0.1, draw_log(seed, 1.0, 1e5),
                                      draw_log(seed, 1.0, 1e5), tension};
        return part_body(tension, tension, s->links, &s->joint, 2);
    default:
        return part_ground(0.0, damper_of(seed, (draw(seed, 0, 1) < 0.5 ? 1.0 : 2.0) * z));
    }
}

/* Spans with devices between them. */
static void any_chain(uint64_t *seed, sketch *s)
{
    const double tension = draw_log(seed, 1.0, 1e5), mass = draw_log(seed, 0.1, 10.0);
    const int spans = (int)draw(seed, 2.0, 5.99);
    for (int i = 0; i < spans; i++) {
        const double drag = draw(seed, 0, 1) < 0.8 ? 0.0 : draw_log(seed, 1e-3, 1.0);
        add(s, part_cable(tension, mass, draw_log(seed, 0.5, 50.0), drag));
        if (i + 1 < spans)
            add(s, device(seed, s, tension, sqrt(tension * mass)));
    }
    if (draw(seed, 0, 1) < 0.3) {
        add(s, part_ground(0.0, damper_of(seed, sqrt(tension * mass))));
        s->right = STRUM_TAUT_FREE;
    }
}

/* Mirrored spans, with a spring or a mass between them. */
static void mirrored(uint64_t *seed, sketch *s)
{
    const double at = draw(seed, 0.02, 0.45), c = damper_of(seed, 2.0);
    add(s, part_cable(1, 1, at, 0));
    add(s, part_ground(0, c));
    add(s, part_cable(1, 1, 0.5 - at, 0));
    add(s, draw(seed, 0, 1) < 0.5 ? part_ground(draw_log(seed, 1.0, 1e12), 0)
                                  : part_mass(draw_log(seed, 1e-2, 1e5)));
    add(s, part_cable(1, 1, 0.5 - at, 0));
    add(s, part_ground(0, c));
    add(s, part_cable(1, 1, at, 0));
}

/* An absorber at m/n of the span, tuned to mode n or almost so. */
static void on_a_node(uint64_t *seed, sketch *s)
{
    const int n = (int)draw(seed, 2.0, 5.99), m = (int)draw(seed, 1.0, n - 0.01);
    const double off = draw(seed, 0, 1) < 0.5 ? 0.0 : draw_log(seed, 1e-12, 1e-2);
    const double mass = draw_log(seed, 1e-2, 1.0), w = n * M_PI * (1.0 + off);
    add(s, part_cable(1, 1, (double)m / n, 0));
    add(s, part_hanging(mass, mass * w * w, mass * w * draw_log(seed, 1e-4, 1.0)));
    add(s, part_cable(1, 1, (double)(n - m) / n, 0));
}

/* Equal damped spans behind stiff springs. */
static void spans(uint64_t *seed, sketch *s)
{
    const int n = (int)draw(seed, 2.0, 4.99);
    const double k = draw_log(seed, 1e2, 1e10), c = damper_of(seed, 2.0);
    const double at = draw(seed, 0.05, 0.5);
    for (int i = 0; i < n; i++) {
        add(s, part_cable(1, 1, at, 0));
        add(s, part_ground(0, c));
        add(s, part_cable(1, 1, 1 - at, 0));
        if (i + 1 < n)
            add(s, part_ground(k, 0));
    }
}

/* One damper at midspan, at a rational place or at a free end. */
static void one_damper(uint64_t *seed, sketch *s)
{
    const double tension = draw_log(seed, 1.0, 1e6), mass = draw_log(seed, 0.1, 10.0);
    const double z = sqrt(tension * mass);
    const int n = (int)draw(seed, 2.0, 20.99);
    add(s, part_cable(tension, mass, 10.0 / n, 0));
    if (draw(seed, 0, 1) < 0.3) {
        add(s, part_ground(0, damper_of(seed, z)));
        s->right = STRUM_TAUT_FREE;
        return;
    }
    add(s, part_ground(0, damper_of(seed, 2.0 * z)));
    add(s, part_cable(tension, mass, 10.0 * (n - 1) / n, 0));
}

static strum_taut *make(uint64_t *seed, int kind)
{
    static void (*const kinds[5])(uint64_t *, sketch *) = {any_chain, mirrored, on_a_node,
                                                           spans, one_damper};
    sketch s = {.left = STRUM_TAUT_FIXED, .right = STRUM_TAUT_FIXED};
    kinds[kind](seed, &s);
    return chain_of(s.parts, s.count, s.left, s.right);
}

/* ---- comparing ---- */

typedef struct tally {
    long chains, roots, refused, differ;
    bool show;
    char why[400];
} tally;

static double tolerance(const strum_taut_root *r)
{
    return (r->exceptional < 1e-2 ? SAME_TWIN : SAME) * hypot(r->frequency, r->decay);
}

static double apart(const strum_taut_root *a, const strum_taut_root *b)
{
    return hypot(a->frequency - b->frequency, a->decay - b->decay);
}

/* Is every root of a, from place `first` on, `count` of them, one of b's, number and all? */
static bool within(const strum_taut_root *a, size_t count, const strum_taut_root *b, size_t all,
                   const char *way, tally *t)
{
    bool taken[1000] = {false};
    for (size_t i = 0; i < count; i++) {
        size_t at = all;
        for (size_t k = 0; k < all; k++)
            if (!taken[k] && a[i].mode == b[k].mode &&
                apart(&a[i], &b[k]) <= tolerance(&a[i]) &&
                (at == all || apart(&a[i], &b[k]) < apart(&a[i], &b[at])))
                at = k;
        if (at == all) {
            (void)snprintf(t->why, sizeof t->why, "%s: mode %ld at %.12g, decay %.6g", way,
                           a[i].mode, a[i].frequency, a[i].decay);
            return false;
        }
        taken[at] = true;
    }
    return true;
}

static strum_taut_roots *ask(const strum_taut *chain, const strum_taut_query *q, tally *t,
                             const char *way)
{
    strum_taut_roots *roots = NULL;
    strum_error fault = {0};
    if (strum_taut_solve(chain, q, NULL, &roots, &fault) != STRUM_OK)
        (void)snprintf(t->why, sizeof t->why, "%s: %s", way, fault.reason);
    else if (roots->expected != roots->found || roots->axis_expected != roots->axis_found)
        (void)snprintf(t->why, sizeof t->why, "%s: %ld of %ld", way, roots->found,
                       roots->expected);
    return roots;
}

static bool by_window(const strum_taut *chain, const strum_taut_roots *all, uint64_t *seed,
                      tally *t)
{
    const size_t from = (size_t)draw(seed, 0.0, (double)all->count - 0.01);
    const size_t count = 1 + (size_t)draw(seed, 0.0, (double)(all->count - from) - 0.01);
    const strum_taut_query q = {.first = (long)from + 1, .wanted = count};
    strum_taut_roots *got = ask(chain, &q, t, "window");
    bool good = got != NULL && t->why[0] == '\0';
    if (good && got->count != count) {
        good = false;
        (void)snprintf(t->why, sizeof t->why, "window from %zu: %zu of %zu", from + 1,
                       got->count, count);
    }
    good = good && within(got->roots, count, all->roots, all->count, "window", t);
    /* the same places, but for ties */
    for (size_t i = 0; good && i < count; i++)
        if (fabs(got->roots[i].frequency - all->roots[from + i].frequency) >
            tolerance(&got->roots[i])) {
            good = false;
            (void)snprintf(t->why, sizeof t->why, "window: place %zu is %.12g, was %.12g",
                           from + i + 1, got->roots[i].frequency,
                           all->roots[from + i].frequency);
        }
    strum_taut_roots_free(got);
    return good;
}

static bool missing_has(const strum_taut_roots *roots, long mode)
{
    for (size_t i = 0; i < roots->missing_count; i++)
        if (roots->missing[i].mode == mode)
            return true;
    return false;
}

/* All numbers up to the largest, and some single one. */
static bool by_number(const strum_taut *chain, const strum_taut_roots *all, uint64_t *seed,
                      tally *t)
{
    long numbers[1000], count = 0;
    for (size_t i = 0; i < all->count; i++)
        count = all->roots[i].mode > count ? all->roots[i].mode : count;
    if (count == 0)
        return true;
    const bool one = draw(seed, 0, 1) < 0.5;
    const long single = 1 + (long)draw(seed, 0.0, (double)count - 0.01);
    for (long k = 0; k < count; k++)
        numbers[k] = k + 1;
    const strum_taut_query q = {.numbers = one ? &single : numbers, .count = one ? 1 : count};
    strum_taut_roots *got = ask(chain, &q, t, "numbers");
    bool good = got != NULL && t->why[0] == '\0';
    const double last = all->roots[all->count - 1].frequency;
    for (size_t i = 0; good && i < all->count; i++) /* each of the list that was asked */
        if (all->roots[i].mode > 0 && (!one || all->roots[i].mode == single))
            good = within(&all->roots[i], 1, got->roots, got->count, "numbers have not", t);
    for (size_t i = 0; good && i < got->count; i++) /* and no others but beyond */
        if (got->roots[i].frequency < last * (1.0 - 1e-8))
            good = within(&got->roots[i], 1, all->roots, all->count, "numbers have", t);
    for (size_t i = 0; good && i < got->missing_count; i++)
        if (!missing_has(all, got->missing[i].mode)) {
            good = false;
            (void)snprintf(t->why, sizeof t->why, "numbers miss mode %ld, places do not",
                           got->missing[i].mode);
        }
    strum_taut_roots_free(got);
    return good;
}

/* From between two roots to between two others, as far down as the list was counted. */
static bool by_band(const strum_taut *chain, const strum_taut_roots *all, uint64_t *seed,
                    tally *t)
{
    size_t from = (size_t)draw(seed, 0.0, (double)all->count - 0.01), to = from;
    const strum_taut_root *r = all->roots;
    double low =
        from == 0 ? 0.5 * r[0].frequency : 0.5 * (r[from - 1].frequency + r[from].frequency);
    to += (size_t)draw(seed, 0.0, (double)(all->count - from) - 0.01);
    if (to + 1 >= all->count || to < from + 1)
        return true;
    double high = 0.5 * (r[to].frequency + r[to + 1].frequency);
    if (!(r[to + 1].frequency - r[to].frequency > 1e-6 * high) || !(low > 0.0) ||
        (from > 0 && !(r[from].frequency - r[from - 1].frequency > 1e-6 * high)))
        return true; /* the border would lie within a pair */
    const strum_taut_query q = {.lowest = low, .highest = high, .max_decay = all->max_decay};
    strum_taut_roots *got = ask(chain, &q, t, "band");
    bool good = got != NULL && t->why[0] == '\0';
    if (good && got->count != to - from + 1) {
        good = false;
        (void)snprintf(t->why, sizeof t->why, "band %.9g to %.9g: %zu of %zu", low, high,
                       got->count, to - from + 1);
    }
    good = good && within(got->roots, got->count, &r[from], to - from + 1, "band", t);
    strum_taut_roots_free(got);
    return good;
}

/* Half as many must be the beginning of all. */
static bool by_count(const strum_taut *chain, const strum_taut_roots *all, tally *t)
{
    const strum_taut_query q = {.first = 1, .wanted = (all->count + 1) / 2};
    strum_taut_roots *got = ask(chain, &q, t, "count");
    bool good = got != NULL && t->why[0] == '\0';
    if (good && got->count != q.wanted) {
        good = false;
        (void)snprintf(t->why, sizeof t->why, "count: %zu of %zu", got->count, q.wanted);
    }
    good = good && within(got->roots, got->count, all->roots, all->count, "count", t);
    strum_taut_roots_free(got);
    return good;
}

static void one_chain(uint64_t seed, int kind, tally *t)
{
    uint64_t state = seed;
    (void)draw(&state, 0, 1);
    strum_taut *chain = make(&state, kind);
    const strum_taut_query q = {.first = 1, .wanted = (size_t)draw(&state, 5.0, 14.99)};
    t->why[0] = '\0';
    strum_taut_roots *all = ask(chain, &q, t, "places");
    t->chains++;
    if (all != NULL && t->show) {
        printf("# evaluations %ld\n", all->evaluations);
        for (size_t i = 0; i < all->count; i++)
            printf("# %ld %.15g %.15g %g\n", all->roots[i].mode, all->roots[i].frequency,
                   all->roots[i].decay, all->roots[i].exceptional);
        for (size_t i = 0; i < all->missing_count; i++)
            printf("# missing %ld fate %d at %.15g\n", all->missing[i].mode,
                   all->missing[i].fate, all->missing[i].factor);
        printf("# counted to %g, decay %g\n", all->highest, all->max_decay);
    }
    if (all != NULL && all->count > 0 && t->why[0] == '\0') {
        t->roots += (long)all->count;
        (void)(by_count(chain, all, t) && by_window(chain, all, &state, t) &&
               by_number(chain, all, &state, t) && by_band(chain, all, &state, t));
    }
    t->differ += t->why[0] != '\0';
    strum_taut_roots_free(all);
    strum_taut_free(chain);
}

static long setting(const char *name, long usual)
{
    const char *text = getenv(name);
    return text != NULL ? strtol(text, NULL, 10) : usual;
}

static void every_way_gives_the_same(void **state)
{
    (void)state;
    const long count = setting("STRUM_WAYS", USUAL), only = setting("STRUM_WAYS_ONLY", -1);
    const uint64_t seed = (uint64_t)setting("STRUM_WAYS_SEED", 1);
    static const int usual[4] = {0, 1, 2, 4};
    tally t = {.show = only >= 0};
    for (long n = only >= 0 ? only : 0; n < (only >= 0 ? only + 1 : count); n++) {
        /* equal spans take much longer than the others: one in twenty */
        const int kind = n % 20 == 19 ? 3 : usual[n % 4];
        one_chain(seed * 1000003u + (uint64_t)n * 7919u, kind, &t);
        if (t.why[0] != '\0')
            printf("# chain %ld, kind %d: %s\n", n, kind, t.why);
    }
    printf("# %ld chains, %ld roots, %ld differ\n", t.chains, t.roots, t.differ);
    assert_int_equal(t.differ, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(every_way_gives_the_same)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
