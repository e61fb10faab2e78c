/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Random cables, 3,000 free and 2,000 on a bed, from seeds: each hangs and passes what must hold
 * of it, or is refused with a reason that is true. The number of each is printed.
 */
#include <stdlib.h>

#include "cable/lines.h"

/* Marsaglia's xorshift64*: the same numbers everywhere. */
static uint64_t seed;

static double uniform(double from, double to)
{
    seed ^= seed >> 12;
    seed ^= seed << 25;
    seed ^= seed >> 27;
    const double unit = (double)((seed * 2685821657736338717u) >> 11) * 0x1p-53;
    return from + (to - from) * unit;
}

static double decades(double from, double to)
{
    return pow(10, uniform(from, to));
}

static int below(int n)
{
    return (int)uniform(0, n);
}

/* ---- drawing ---- */

static double length_of(const line *l)
{
    double length = 0;
    for (size_t i = 0; i < l->params.section_count; i++)
        length += l->sections[i].length;
    return length;
}

/* Pieces of one to six kinds and loads of up to twice the weight; the weight of all. */
static double draw_line(line *l, int parts_max, int lightest)
{
    part parts[PARTS_MAX];
    load loads[LOADS_MAX];
    double weight = 0, length = 0;
    const int part_count = 1 + below(parts_max), load_count = below(LOADS_MAX);
    for (int i = 0; i < part_count; i++) {
        const int kind = below(6);
        parts[i].length = decades(0, 2.5);
        parts[i].weight = (kind < lightest              ? 0
                           : kind > 3 + (lightest == 0) ? -1
                                                        : 1) *
                          decades(0, 3);
        weight += fabs(parts[i].weight) * parts[i].length;
        length += parts[i].length;
    }
    weight = weight > 0 ? weight : 100;
    for (int i = 0; i < part_count; i++)
        parts[i].axial_stiffness = below(2) ? INFINITY : weight * decades(0, 6);
    for (int i = 0; i < load_count; i++)
        loads[i] = (load){uniform(0.01, 0.99) * length, uniform(-2, 2) * weight, 0, 0};
    make_line(l, 0, 0, part_count, parts, load_count, loads);
    return weight;
}

/* ---- free lines ---- */

/* The textbook's differences of asinh and of tensions, in extended precision. */
static void textbook(const strum_cable_section *s, long double length, long double h,
                     long double v, long double *x, long double *z)
{
    const long double end = v + s->weight * length, tension = hypotl(h, v);
    if (s->weight == 0) {
        *x += h * length / tension + h * length / s->axial_stiffness;
        *z += v * length / tension + v * length / s->axial_stiffness;
        return;
    }
    if (h != 0)
        *x += h / s->weight * (asinhl(end / h) - asinhl(v / h));
    *x += h * length / s->axial_stiffness;
    *z += (hypotl(h, end) - tension) / s->weight + length * (v + end) / 2 / s->axial_stiffness;
}

static int by_place(const void *a, const void *b)
{
    const strum_cable_attachment *one = a, *other = b;
    return one->position < other->position ? -1 : one->position > other->position;
}

/* How far the line that begins with this force ends from end 2. */
static double misses(const line *l, const strum_cable_statics *f)
{
    strum_cable_attachment loads[2 * LOADS_MAX];
    const size_t count = l->params.attachment_count;
    long double h = f->horizontal_end_1, v = f->vertical_end_1, x = 0, z = 0, begin = 0;
    size_t next = 0;
    memcpy(loads, l->attachments, count * sizeof *loads);
    qsort(loads, count, sizeof *loads, by_place);
    for (size_t i = 0; i < l->params.section_count; i++) {
        const strum_cable_section *s = l->sections + i;
        const long double end = begin + s->length;
        for (long double at = begin; at < end;) {
            const long double to =
                next < count && loads[next].position < end ? loads[next].position : end;
            textbook(s, to - at, h, v, &x, &z);
            v += s->weight * (to - at);
            for (at = to; next < count && loads[next].position <= at && to < end; next++)
                v += loads[next].weight;
        }
        begin = end;
    }
    return (double)hypotl(x - l->params.span, z - l->params.rise);
}

/* A weightless section that is refused for having no tension has next to none when it weighs
 * next to nothing. */
static void is_slack(const line *l, size_t section, double weight)
{
    line near = *l;
    strum_cable_point points[64];
    double positions[64], begin = 0, least = INFINITY;
    strum_hanging *cable;
    near.params.sections = near.sections;
    near.params.attachments = near.attachments;
    for (size_t i = 0; i < near.params.section_count; i++)
        if (near.sections[i].weight == 0)
            near.sections[i].weight = 1e-10 * weight / near.sections[i].length;
    for (size_t i = 0; i < section; i++)
        begin += near.sections[i].length;
    for (int i = 0; i < 64; i++)
        positions[i] = begin + near.sections[section].length * (i + 0.5) / 64;
    if (strum_cable_hang(&near.params, NULL, &cable, NULL) != STRUM_OK)
        return; /* too slack for the precision of forces */
    assert_int_equal(strum_cable_shape(cable, positions, 64, points), STRUM_OK);
    for (int i = 0; i < 64; i++)
        least = fmin(least, points[i].tension);
    assert_true(least <= 1e-6 * weight);
    strum_cable_free(cable);
}

static void free_lines(void **state)
{
    (void)state;
    int solved = 0, slack = 0, short_ones = 0;
    double worst = 0;
    seed = 20260101;
    for (int i = 0; i < 3000; i++) {
        line l;
        strum_hanging *cable;
        strum_error error = {0};
        const double weight = draw_line(&l, PARTS_MAX, 1), length = length_of(&l);
        const int how = below(4);
        const double chord = length * (how == 0   ? decades(-9, 0)
                                       : how == 1 ? uniform(0, 1)
                                       : how == 2 ? 1 - decades(-6, -1)
                                                  : uniform(0.95, 1.01));
        const double angle = uniform(-M_PI_2, M_PI_2);
        l.params.span = chord * cos(angle);
        l.params.rise = chord * sin(angle);
        const strum_status status = strum_cable_hang(&l.params, NULL, &cable, &error);
        if (status == STRUM_OK) {
            const strum_cable_statics s = statics_of(cable);
            worst = fmax(worst, s.closure);
            if (!(s.closure <= 1e-11) || !(misses(&l, &s) <= 2e-11 * length))
                fail_msg("line %d: closure %.1e, by the textbook %.1e", i, s.closure,
                         misses(&l, &s) / length);
            strum_cable_free(cable);
            solved++;
        } else if (strstr(error.reason, "weightless") != NULL) {
            assert_int_equal(l.sections[error.index].weight, 0);
            is_slack(&l, error.index, weight);
            slack++;
        } else {
            if (strstr(error.reason, "longer") == NULL)
                fail_msg("line %d: %s", i, error.reason);
            assert_true(chord >= length * (1 - 1e-15));
            for (size_t k = 0; k < l.params.section_count; k++)
                assert_true(isinf(l.sections[k].axial_stiffness));
            short_ones++;
        }
    }
    print_message("free: %d solved (closure %.0e), %d slack, %d too short\n", solved, worst,
                  slack, short_ones);
    assert_true(solved > 2500);
}

/* ---- on a bed ---- */

static void draw_bed(line *l)
{
    const double length = length_of(l);
    const double slope = below(2) ? 0 : uniform(-5, 5) * M_PI / 180;
    const double depth = below(2) ? 0 : 0.5 * length * decades(-2, 0);
    const double reach = below(3) ? uniform(0.7, 1) : decades(-3, 0);
    const double angle = uniform(0, M_PI_2);
    l->params.bed = (strum_cable_bed){true, depth, slope, below(2) ? uniform(0.1, 1) : 0};
    l->params.span = length * reach * cos(angle);
    const double floor = l->params.span * tan(slope) - depth;
    l->params.rise = floor + (below(4) ? length * reach * sin(angle) * uniform(0, 1) : 0);
    const double chord = hypot(l->params.span, l->params.rise);
    if (chord > 0.99 * length) {
        l->params.span = 0.4 * length;
        l->params.bed.depth = 0;
        l->params.rise = l->params.span * tan(slope);
    }
}

/* Above the bed or on it at 400 places, no reaction that pulls. */
static void lies_well(const line *l, const strum_hanging *cable, int number)
{
    enum { N = 400 };
    strum_cable_point points[N];
    const strum_cable_statics s = statics_of(cable);
    const double near = 1e-9 * s.unstretched_length;
    assert_int_equal(strum_cable_shape(cable, NULL, N, points), STRUM_OK);
    for (int i = 0; i < N; i++) {
        const double height =
            points[i].z + l->params.bed.depth - points[i].x * tan(l->params.bed.slope);
        bool lies = false;
        for (size_t k = 0; k < s.contacts; k++) {
            strum_cable_contact c;
            assert_int_equal(strum_cable_contact_get(cable, k, &c), STRUM_OK);
            lies |= points[i].position >= c.from && points[i].position <= c.to;
        }
        if (!(height >= -near) || (lies && height > near))
            fail_msg("line %d at %g m: height %g", number, points[i].position, height);
    }
    if (!(s.closure <= 1e-11) || s.smallest_reaction < 0 || s.lowest_clearance < -near)
        fail_msg("line %d: closure %.1e, reaction %g, clearance %g", number, s.closure,
                 s.smallest_reaction, s.lowest_clearance);
}

static void lines_on_a_bed(void **state)
{
    (void)state;
    int solved = 0, slack = 0, slides = 0, weightless = 0, contacts[6] = {0};
    seed = 20260202;
    for (int i = 0; i < 2000; i++) {
        line l;
        strum_hanging *cable;
        strum_error error = {0};
        (void)draw_line(&l, 4, below(4) == 0);
        draw_bed(&l);
        const strum_status status = strum_cable_hang(&l.params, NULL, &cable, &error);
        if (status == STRUM_OK) {
            const strum_cable_statics s = statics_of(cable);
            lies_well(&l, cable, i);
            contacts[s.contacts < 5 ? s.contacts : 5]++;
            slack += s.slack;
            solved++;
            strum_cable_free(cable);
        } else if (strstr(error.reason, "slide") != NULL) {
            assert_true(l.params.bed.slope != 0);
            slides++;
        } else {
            if (strstr(error.reason, "weightless") == NULL)
                fail_msg("line %d: %s", i, error.reason);
            assert_int_equal(l.sections[error.index].weight, 0);
            weightless++;
        }
    }
    print_message("bed: %d solved (%d in part slack), contacts 0: %d, 1: %d, 2: %d, 3: %d, 4: "
                  "%d, more: %d; refused: %d slide, %d weightless and slack\n",
                  solved, slack, contacts[0], contacts[1], contacts[2], contacts[3],
                  contacts[4], contacts[5], slides, weightless);
    assert_true(solved > 1200 && contacts[2] > 50 && contacts[3] > 5);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(free_lines),
        cmocka_unit_test(lines_on_a_bed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
