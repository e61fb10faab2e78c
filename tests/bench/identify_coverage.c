/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * How often the intervals of strum_identify hold the truth: simulated records of cables of xi 1 to
 * 1000, with errors of 0.01 to 1 % of the first frequency, 1 to 20 modes of which some are missing.
 * Every `stride`-th fit is compared with a dense scan of all there is to vary. Prints the tables
 * of doc/identify.md:
 *
 *     build-bench/tests/bench/identify_coverage [RECORDS [STRIDE]]
 */
#include <math.h>
#include <stdint.h>
#include <string.h>

#include <strum/identify.h>

#include "bench.h"
#include "core/identify/beam.h"

#define MODES_MAX 20
#define LENGTH    100.0
#define MASS      50.0
#define TENSION   2e6
#define BANDS     4
#define KINDS     3

static uint64_t generator = 20240607;

static double uniform(void)
{
    generator = generator * 6364136223846793005u + 1442695040888963407u;
    return ((double)(generator >> 11) + 0.5) * 0x1p-53;
}

static double normal(void)
{
    const double r = sqrt(-2 * log(uniform()));
    return r * cos(2 * M_PI * uniform());
}

typedef struct record {
    double f[MODES_MAX], sd[MODES_MAX];
    int modes[MODES_MAX];
    size_t count;
    double xi, bending, rho;
    int kind; /* unknown: T; T and EI; T, EI and fixity */
    bool weighted;
    strum_identify_params p;
} record;

static void draw(record *r)
{
    *r = (record){.p = STRUM_IDENTIFY_PARAMS_INIT};
    r->xi = pow(10, 3 * uniform());
    r->bending = TENSION * LENGTH * LENGTH / (r->xi * r->xi);
    r->weighted = uniform() < 0.7;
    const double noise = 1e-4 * pow(100, uniform()), u = 1 / r->xi;
    const int wanted = 1 + (int)(MODES_MAX * uniform());
    r->kind = (int)(KINDS * uniform());
    r->rho = r->kind == 2 ? uniform() : (double)(int)(3 * uniform()) / 2;
    const beam_end ends[2] = {beam_end_by_fixity(r->rho, u), beam_end_by_fixity(r->rho, u)};
    const double scale = sqrt(TENSION / MASS) / (2 * M_PI * LENGTH);
    const double sd = noise * scale * beam_solve(1, u, ends).om;
    for (int n = 1; n <= wanted; n++) {
        if (wanted > 1 && uniform() < 0.2)
            continue;
        r->modes[r->count] = n;
        r->sd[r->count] = sd;
        r->f[r->count++] = scale * beam_solve(n, u, ends).om + sd * normal();
    }
    const size_t needed = (size_t)r->kind + 1 + !r->weighted;
    if (r->count < needed) { /* too few for so many unknowns */
        draw(r);
        return;
    }
    r->p.frequencies = r->f;
    r->p.standard_deviations = r->weighted ? r->sd : NULL;
    r->p.modes = r->modes;
    r->p.count = r->count;
    r->p.quantities[STRUM_IDENTIFY_TENSION].unknown = true;
    r->p.quantities[STRUM_IDENTIFY_BENDING] =
        (strum_identify_value){r->kind > 0, r->bending, 0};
    r->p.quantities[STRUM_IDENTIFY_FIXITY].unknown = r->kind == 2;
    r->p.quantities[STRUM_IDENTIFY_LENGTH].value = LENGTH;
    r->p.quantities[STRUM_IDENTIFY_MASS].value = MASS;
    for (int i = 0; i < 2; i++)
        r->p.ends[i] = (strum_identify_end){
            r->kind == 2 ? STRUM_IDENTIFY_UNKNOWN_FIXITY : STRUM_IDENTIFY_FIXED_FIXITY, r->rho};
}

/* Chi^2 at u and fixity, with the best tension; or at a tension where EI is known. */
static double chi2_at(const record *r, double u, double rho, double tension)
{
    const beam_end ends[2] = {beam_end_by_fixity(rho, u), beam_end_by_fixity(rho, u)};
    const double unit = sqrt((tension > 0 ? tension : 1) / MASS) / (2 * M_PI * LENGTH);
    double f[MODES_MAX], g[MODES_MAX], fg = 0, gg = 0, sum = 0;
    for (size_t i = 0; i < r->count; i++) {
        const double sd = r->weighted ? r->sd[i] : 1;
        f[i] = r->f[i] / sd;
        g[i] = unit * beam_solve(r->modes[i], u, ends).om / sd;
        fg += f[i] * g[i];
        gg += g[i] * g[i];
    }
    const double scale = tension > 0 ? 1 : fg / gg;
    for (size_t i = 0; i < r->count; i++)
        sum += (f[i] - scale * g[i]) * (f[i] - scale * g[i]);
    return sum;
}

static double dense_scan(const record *r)
{
    const int rhos = r->kind == 2 ? 41 : 1, points = r->kind == 2 ? 240 : 2000;
    double least = HUGE_VAL;
    for (int j = 0; j < rhos; j++)
        for (int i = 0; i < points; i++) {
            const double part = (double)i / (points - 1),
                         rho = rhos > 1 ? (double)j / (rhos - 1) : r->rho;
            const double tension = r->kind == 0 ? TENSION * pow(10, 3 * part - 2) : 0;
            const double u =
                r->kind == 0 ? sqrt(r->bending / tension) / LENGTH : 1e-5 * pow(3e6, part);
            least = fmin(least, chi2_at(r, u, rho, tension));
        }
    return least;
}

typedef struct tally {
    long records, determined, covered;
} tally;

static void count(tally *t, const strum_identify_estimate *e, double truth)
{
    t->records++;
    if (!e->determined)
        return;
    t->determined++;
    t->covered += e->low <= truth && truth <= e->high;
}

static const char *const kinds[KINDS] = {"T", "T, EI", "T, EI, fixity"};
static const char *const bands[BANDS] = {"1 to 10", "10 to 30", "30 to 100", "100 to 1000"};
static const double edges[BANDS - 1] = {10, 30, 100};

static void print_table(const char *name, tally t[KINDS][BANDS])
{
    printf("\n| %s: unknown | xi | records | determined | of these covered |\n| --- | ---: | "
           "---: | ---: | ---: |\n",
           name);
    for (int k = 0; k < KINDS; k++)
        for (int b = 0; b < BANDS; b++)
            if (t[k][b].records > 0 && t[k][b].determined > 0)
                printf("| %s | %s | %ld | %ld | %.1f %% |\n", kinds[k], bands[b],
                       t[k][b].records, t[k][b].determined,
                       100.0 * (double)t[k][b].covered / (double)t[k][b].determined);
}

typedef struct study {
    tally t[3][KINDS][BANDS]; /* of tension, bending stiffness, fixity */
    double slowest, sum;
    long records, refused, scanned, beaten;
} study;

static void look(study *s, const record *r, const strum_identify *found)
{
    static const strum_identify_quantity which[3] = {
        STRUM_IDENTIFY_TENSION, STRUM_IDENTIFY_BENDING, STRUM_IDENTIFY_FIXITY};
    const double truth[3] = {TENSION, r->bending, r->rho};
    int band = 0;
    while (band < BANDS - 1 && r->xi > edges[band])
        band++;
    for (int q = 0; q < 3; q++)
        if (strum_identify_estimate_of(found, which[q])->unknown)
            count(&s->t[q][r->kind][band], strum_identify_estimate_of(found, which[q]),
                  truth[q]);
}

static void scan(study *s, const record *r, const strum_identify *found)
{
    const double chi2 = strum_identify_summary_of(found)->chi_squared, least = dense_scan(r);
    s->scanned++;
    if (chi2 <= least * (1 + 1e-9))
        return;
    s->beaten++;
    fprintf(stderr, "record %ld: chi^2 %.12g, scan %.12g (kind %d, xi %.4g, %zu modes)\n",
            s->records, chi2, least, r->kind, r->xi, r->count);
}

static void solve(study *s, long stride)
{
    record r;
    draw(&r);
    strum_identify *found = NULL;
    strum_error error = {0};
    const double begin = bench_now_us();
    const strum_status status = strum_identify_solve(&r.p, NULL, &found, &error);
    const double us = bench_now_us() - begin;
    s->slowest = fmax(s->slowest, us);
    s->sum += us;
    if (status == STRUM_OK) {
        look(s, &r, found);
        if (s->records % stride == 0)
            scan(s, &r, found);
    } else {
        s->refused++;
        fprintf(stderr, "record %ld: %s\n", s->records, error.reason);
    }
    s->records++;
    strum_identify_free(found);
}

int main(int argc, char **argv)
{
    const long records = argc > 1 ? atol(argv[1]) : 10000,
               stride = argc > 2 ? atol(argv[2]) : 10;
    static study s;
    while (s.records < records)
        solve(&s, stride > 0 ? stride : 10);
    print_table("tension", s.t[0]);
    print_table("bending stiffness", s.t[1]);
    print_table("fixity", s.t[2]);
    printf("\n%ld records, %ld refused; %ld minima compared with a dense scan, %ld beaten; CPU "
           "%.0f us each, %.1f ms at most\n",
           s.records, s.refused, s.scanned, s.beaten, s.sum / (double)s.records,
           s.slowest / 1000);
    return s.refused + s.beaten > 0;
}
