/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Modes of a cable: sizes, the agreement of two of them, order and number. */
#include "core/suspended/modes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/numerics/work.h"
#include "core/suspended/displacement.h"

strum_status spectrum_roots(const root_search *q, arena *a, root_list *list, root_list *inner,
                            in_plane_part *parts[3])
{
    if (q->plane == STRUM_OUT_OF_PLANE)
        return out_of_plane_roots(q, a, list, inner);
    const bool level = q->cable->chi_m == 0;
    const strum_symmetry first = level ? STRUM_SYMMETRIC : STRUM_NO_SYMMETRY;
    const strum_symmetry last = level ? STRUM_ANTISYMMETRIC : STRUM_NO_SYMMETRY;
    for (strum_symmetry symmetry = first; symmetry <= last; symmetry++) {
        in_plane_assembly *m = arena_alloc(a, 1, sizeof *m);
        if (m == NULL)
            return STRUM_ERR_MEMORY;
        arena scratch = {.work = a->work};
        strum_status status = in_plane_assemble(q, symmetry, a, &scratch, m);
        if (status == STRUM_OK)
            status = in_plane_roots(q, m, q->size, q->vectors, a, list);
        if (status == STRUM_OK && inner != NULL)
            status = in_plane_roots(q, m, q->block, false, a, inner);
        arena_free(&scratch);
        if (status != STRUM_OK)
            return status;
        if (parts != NULL)
            parts[symmetry] = &m->part;
    }
    return STRUM_OK;
}

static int by_frequency(const void *left, const void *right)
{
    const root *l = left, *r = right;
    if (cimag(l->s) != cimag(r->s))
        return cimag(l->s) < cimag(r->s) ? -1 : 1;
    return creal(l->s) < creal(r->s) ? -1 : creal(l->s) > creal(r->s);
}

static int by_value(const void *left, const void *right)
{
    const double l = *(const double *)left, r = *(const double *)right;
    return l < r ? -1 : l > r;
}

/* No decay rate of an overdamped motion exceeds the largest ratio of damping to mass. */
static double largest_rate(const strum_cable *cable, strum_plane plane)
{
    const double normal = cable->eta_n / cable->mass_n;
    return plane == STRUM_OUT_OF_PLANE ? normal : fmax(normal, cable->eta_t / cable->mass_t);
}

/* Roots that oscillate, by frequency, and the decay rates of those that do not, ascending. */
typedef struct sorted_roots {
    root_list modes;
    double *decays;
    int overdamped;
} sorted_roots;

/* Sorts `list`, of which at most `count` oscillating roots are kept; arrays are the arena's.
 * Roots beyond what damping can reach are rounding and left out. */
static strum_status sort_roots(const strum_modes *sp, const root_list *list, int count,
                               arena *a, sorted_roots *out)
{
    const size_t room = (size_t)(list->count > 0 ? list->count : 1);
    root_list *modes = &out->modes;
    *out = (sorted_roots){.modes.items = arena_alloc(a, room, sizeof *modes->items),
                          .decays = arena_doubles(a, room)};
    if (modes->items == NULL || out->decays == NULL)
        return STRUM_ERR_MEMORY;
    const double limit = largest_rate(&sp->cable, sp->plane) * (1 + 1e-9);
    for (int i = 0; i < list->count; i++) {
        const double _Complex s = list->items[i].s;
        if (cimag(s) > 0)
            modes->items[modes->count++] = list->items[i];
        else if (-creal(s) > 0 && -creal(s) <= limit)
            out->decays[out->overdamped++] = -creal(s);
    }
    qsort(modes->items, (size_t)modes->count, sizeof *modes->items, by_frequency);
    qsort(out->decays, (size_t)out->overdamped, sizeof *out->decays, by_value);
    if (modes->count > count)
        modes->count = count;
    return STRUM_OK;
}

/* INT of the wave number of unit frequency, of transverse waves and along an elastic cable of
 * longitudinal ones; and its largest value in x. */
static void wave_phase(const strum_cable *cable, const mapping *x, strum_plane plane,
                       double *phase, double *steepest)
{
    enum { STEPS = 64 };
    *phase = *steepest = 0;
    for (int i = 0; i <= STEPS; i++) {
        const double at = 2.0 * i / STEPS - 1, slope = mapping_slope(x, at);
        const double c = cosh(cable->chi_m + mapping_offset(x, at));
        const double across = sqrt(cable->mass_n * (1 + cable->kappa_n * c) * c);
        const double along =
            plane == STRUM_IN_PLANE ? sqrt(cable->mass_t * cable->kappa_t) * c : 0;
        *phase += (i == 0 || i == STEPS ? 0.5 : 1) * 2 / STEPS * slope * (across + along);
        *steepest = fmax(*steepest, fmax(across, along) * slope);
    }
}

double spectrum_phase_count(const strum_cable *cable, strum_plane plane, double frequency)
{
    const mapping x = mapping_linear(cable);
    double phase, steepest;
    if (frequency == 0) /* every undamped cable asks this */
        return 0;
    wave_phase(cable, &x, plane, &phase, &steepest);
    return frequency * phase / M_PI;
}

/*
 * A wave e^{ikx} on [-1, 1] needs about k + 3 k^{1/3} + 7 Legendre functions for 1e-7 of
 * itself, hence 1e-13 of a frequency; slopes and the singularities at chi = +-i pi/2 of a deep
 * cable add to it. Too small a first size costs a second round, never digits.
 */
int spectrum_first_size(const strum_cable *cable, const mapping *x, strum_plane plane,
                        int count)
{
    double phase, steepest;
    wave_phase(cable, x, plane, &phase, &steepest);
    const double k = (count + 1) * M_PI / phase * steepest;
    return (int)ceil(k + 3.2 * cbrt(k) + 7 + 1.9 / mapping_singularity(x) +
                     0.6 * fabs(cable->chi_m));
}

/* 2.5 keeps the lowest point, where the coefficients vary most, in sight of the functions. */
#define STRETCH 2.5
/* Rounding grows with the range of cosh chi in the integrals' weights; from here on it shows,
 * and a stretched coordinate takes a root of it: this one where the lowest point lies well
 * inside. */
#define CHI_STEEP     9
#define STRETCH_STEEP 5

/* Another coordinate is worth it for what is both large and made much smaller, and for digits.
 */
mapping spectrum_mapping(const strum_cable *cable, strum_plane plane, int count, int *size)
{
    const mapping linear = mapping_linear(cable);
    const mapping stretched = mapping_stretched(cable, STRETCH);
    *size = spectrum_first_size(cable, &linear, plane, count);
    const bool steep = fabs(cable->chi_m) + cable->mu >= CHI_STEEP;
    if (*size <= 120 && !steep)
        return linear;
    const int other = spectrum_first_size(cable, &stretched, plane, count);
    const bool smaller = *size > 120 && other < 0.75 * *size;
    if (!smaller && !steep)
        return linear;
    if (smaller || mapping_ellipse_rate(&stretched) > 0.02) {
        *size = other;
        return stretched;
    }
    const mapping steeper = mapping_stretched(cable, STRETCH_STEEP);
    *size = spectrum_first_size(cable, &steeper, plane, count);
    return steeper;
}

/* Largest relative difference of each root to the nearest of `other`. */
static double disagreement(const sorted_roots *of, const sorted_roots *other)
{
    const root_list *list = &of->modes;
    double worst = 0;
    if (other->modes.count < list->count || other->overdamped != of->overdamped)
        return INFINITY;
    for (int i = 0; i < list->count; i++) {
        const root *r = &list->items[i];
        double nearest = INFINITY;
        for (int j = 0; j < other->modes.count; j++) {
            const root *o = &other->modes.items[j];
            if (o->symmetry == r->symmetry)
                nearest =
                    fmin(nearest, r->natural > 0 ? fabs(o->natural - r->natural) / r->natural
                                                 : cabs(o->s - r->s) / cabs(r->s));
        }
        worst = fmax(worst, nearest);
    }
    /* a proportional pair is as good as its natural frequency, which may sit beside critical
     * damping */
    for (int i = 0; i < of->overdamped && (list->count == 0 || list->items[0].natural == 0);
         i++)
        worst = fmax(worst, fabs(of->decays[i] - other->decays[i]) / of->decays[i]);
    return worst;
}

strum_status spectrum_check_cable(const strum_cable *c, strum_error *fault)
{
    const double values[] = {c->chi_m,  c->mu,     c->kappa_t, c->kappa_n,
                             c->mass_t, c->mass_n, c->eta_t,   c->eta_n};
    for (size_t i = 0; i < sizeof values / sizeof *values; i++)
        if (!isfinite(values[i]))
            return error_at(fault, STRUM_ERR_RANGE, STRUM_MODES_ARG_CABLE, STRUM_NO_INDEX,
                            "a property of the cable is not finite");
    if (!(c->mu > 0 && fabs(c->chi_m) + c->mu <= STRUM_CHI_MAX * (1 + 1e-12)))
        return error_at(fault, STRUM_ERR_RANGE, STRUM_MODES_ARG_CABLE, STRUM_NO_INDEX,
                        "the slope parameters must lie within +-%g", STRUM_CHI_MAX);
    if (!(c->kappa_t >= 0 && c->kappa_n >= 0 && c->eta_t >= 0 && c->eta_n >= 0 &&
          c->mass_t > 0 && c->mass_n > 0))
        return error_at(fault, STRUM_ERR_RANGE, STRUM_MODES_ARG_CABLE, STRUM_NO_INDEX,
                        "masses must be positive, flexibility and damping not negative");
    return STRUM_OK;
}

/* Frequencies alone of an inextensible cable of moderate depth come as well from the
 * displacement form, which is half as large. */
static bool by_displacement(const strum_cable *c, strum_plane plane, bool shapes)
{
    return plane == STRUM_IN_PLANE && !shapes && c->kappa_t == 0 && c->kappa_n == 0 &&
           in_plane_proportional(c) && fabs(c->chi_m) + c->mu <= DISPLACEMENT_CHI_PRECISE;
}

/* Largest of the last coefficients of any mode, relative to the mode's largest: what the size
 * leaves out of the shapes, which converge at half the rate of the frequencies. */
static double shape_tail(const strum_modes *sp)
{
    double worst = 0;
    for (int i = 0; i < sp->count; i++) {
        const root *r = &sp->roots[i];
        double largest = 0, last = 0;
        for (int j = 0; j < r->length; j++) {
            const int k =
                sp->plane == STRUM_OUT_OF_PLANE ? j : sp->parts[r->symmetry]->index[j];
            largest = fmax(largest, cabs(r->vector[j]));
            if (k >= sp->size - 4)
                last = fmax(last, cabs(r->vector[j]));
        }
        worst = fmax(worst, last / largest);
    }
    return worst;
}

/* Relative; makes shapes right to about 1e-9 of their largest value. Where no larger size can
 * be solved or would help, a hundred times it is let pass: a verification shows it as residual.
 */
#define SHAPE_TAIL_MAX 1e-11

/* Of frequencies. */
static double tolerance_of(const strum_modes *sp)
{
    return sp->cable.eta_t > 0 || sp->cable.eta_n > 0 ? 1e-10 : 1e-12;
}

/* One try at one size, of `count` modes; STRUM_ERR_ACCURACY when the two sizes differ or shapes
 * are cut off: `*excess` is how many times too much. */
static strum_status attempt(strum_modes *sp, const root_search *q, int count, double *excess)
{
    arena *a = &sp->memory;
    root_list all = {0}, inner = {0};
    sorted_roots found, checked;
    strum_status status = by_displacement(&sp->cable, sp->plane, sp->shapes)
                              ? displacement_roots(q, sp->cable.chi_m == 0, a, &all, &inner)
                              : spectrum_roots(q, a, &all, &inner, sp->parts);
    if (status == STRUM_OK)
        status = sort_roots(sp, &all, count, a, &found);
    if (status == STRUM_OK)
        status = sort_roots(sp, &inner, inner.count, a, &checked);
    if (status != STRUM_OK)
        return status;
    sp->difference = disagreement(&found, &checked);
    sp->size = q->size;
    sp->count = found.modes.count;
    sp->roots = found.modes.items;
    sp->decays = found.decays;
    sp->overdamped = found.overdamped;
    sp->tail = sp->shapes ? shape_tail(sp) : 0;
    *excess = fmax(sp->difference / tolerance_of(sp), sp->tail / SHAPE_TAIL_MAX);
    return sp->count == count && *excess <= 1 ? STRUM_OK : STRUM_ERR_ACCURACY;
}

static strum_status number_modes(strum_modes *sp)
{
    sp->modes = arena_alloc(&sp->memory, (size_t)sp->count, sizeof *sp->modes);
    if (sp->modes == NULL)
        return STRUM_ERR_MEMORY;
    for (int i = 0; i < sp->count; i++)
        sp->modes[i] = (strum_mode){.frequency = cimag(sp->roots[i].s),
                                    .decay = 0 - creal(sp->roots[i].s),
                                    .symmetry = sp->roots[i].symmetry};
    if (!sp->shapes || sp->unscaled)
        return STRUM_OK;
    sp->factors = arena_doubles(&sp->memory, 4 * (size_t)sp->size);
    if (sp->factors == NULL)
        return STRUM_ERR_MEMORY;
    legendre_factors(sp->size, sp->factors);
    return spectrum_normalise(sp);
}

/* Why no size of a search up to `largest` serves, the next being `next`. */
static strum_status unsolved(const strum_modes *sp, int want, double next, int largest,
                             strum_error *fault)
{
    if (sp->size == 0)
        return error_set(
            fault, STRUM_ERR_ACCURACY,
            "%d modes of this cable need about %.0f unknowns a component; %d can be "
            "solved",
            want, next, largest);
    if (sp->difference <= tolerance_of(sp) && sp->tail > 100 * SHAPE_TAIL_MAX)
        return error_set(fault, STRUM_ERR_ACCURACY,
                         "the last terms of the mode shapes are still %.1e of the first (%.0e "
                         "is promised) at %d unknowns a component; frequencies alone can be "
                         "answered",
                         sp->tail, 100 * SHAPE_TAIL_MAX, sp->size);
    return error_set(
        fault, STRUM_ERR_ACCURACY,
        "two sizes still differ by %.1e (%.0e is promised) at %d unknowns a component",
        sp->difference, tolerance_of(sp), sp->size);
}

/* Functions more than `inner`: what converges slowly needs more of a difference between the two
 * sizes. */
static int margin(const strum_modes *sp, int inner)
{
    if (by_displacement(&sp->cable, sp->plane, sp->shapes))
        return displacement_margin(&sp->cable, inner);
    if (sp->coordinate.stretch != 0)
        return inner / 4;
    return inner > 40 ? inner / 10 : 4;
}

/* Chooses the coordinate; returns the size to begin with. Shapes converge at half the rate of
 * frequencies. */
static double choose(strum_modes *sp, int want)
{
    if (by_displacement(&sp->cable, sp->plane, sp->shapes))
        return displacement_first_size(&sp->cable, want);
    int first;
    sp->coordinate = spectrum_mapping(&sp->cable, sp->plane, want, &first);
    return first * (sp->shapes ? 1.35 : 1);
}

/* Grows the size until two agree. */
static strum_status solve(strum_modes *sp, int count, strum_error *fault)
{
    const double critical = largest_rate(&sp->cable, sp->plane) / 2;
    const double lost = ceil(1.1 * spectrum_phase_count(&sp->cable, sp->plane, critical));
    if (lost > 2 * STRUM_MODES_MAX)
        return error_set(
            fault, STRUM_ERR_RANGE,
            "about %.6g modes would be overdamped, more than %d: less damping can be "
            "answered",
            lost, 2 * STRUM_MODES_MAX);
    const int largest = sp->plane == STRUM_OUT_OF_PLANE || in_plane_proportional(&sp->cable)
                            ? SPECTRUM_SIZE_MAX
                            : SPECTRUM_SIZE_MAX_QUADRATIC;
    root_search q = {.cable = &sp->cable,
                     .x = &sp->coordinate,
                     .plane = sp->plane,
                     .form = IN_PLANE_FORCE_FORM,
                     .want = count + (int)lost,
                     .vectors = sp->shapes};
    double block = choose(sp, q.want), before = INFINITY, excess = INFINITY;
    while (block < largest) {
        q.block = (int)block;
        q.size = q.block + margin(sp, q.block);
        const strum_status status = attempt(sp, &q, count, &excess);
        block = 1.3 * block + 6;
        /* rounding, not size, stands in the way once a larger size helps no more */
        const bool stalled = sp->difference < 1e-8 && excess > before / 3;
        const bool passable = (stalled || block >= largest) && sp->count == count &&
                              sp->difference <= tolerance_of(sp) &&
                              sp->tail < 100 * SHAPE_TAIL_MAX;
        if (status == STRUM_OK || (status == STRUM_ERR_ACCURACY && passable))
            return work_result(sp->memory.work, number_modes(sp), fault);
        if (status != STRUM_ERR_ACCURACY)
            return work_result(sp->memory.work, status, fault);
        arena_free(&sp->memory);
        if (stalled)
            break;
        before = excess;
    }
    return unsolved(sp, q.want, block, largest, fault);
}

/* The modes by `params`, their work counted by `w`. */
static strum_status make(const strum_modes_params *params, bool unscaled, work *w,
                         strum_modes **modes, strum_error *error)
{
    *modes = NULL;
    strum_status status = spectrum_check_cable(&params->cable, error);
    if (status != STRUM_OK)
        return status;
    if (params->count < 1 || params->count > STRUM_MODES_MAX)
        return error_at(error, STRUM_ERR_RANGE, STRUM_MODES_ARG_COUNT, STRUM_NO_INDEX,
                        "1 to %d modes can be asked for", STRUM_MODES_MAX);
    strum_modes *sp = calloc(1, sizeof *sp);
    if (sp == NULL)
        return error_set(error, STRUM_ERR_MEMORY, "out of memory");
    sp->memory.work = w;
    sp->cable = params->cable;
    sp->plane = params->plane;
    sp->shapes = params->shapes;
    sp->unscaled = unscaled;
    status = solve(sp, params->count, error);
    if (status != STRUM_OK) {
        strum_modes_free(sp);
        return status;
    }
    sp->memory.work = NULL; /* it ends here */
    *modes = sp;
    return status;
}

strum_status strum_modes_solve(const strum_modes_params *params, const strum_options *options,
                               strum_modes **modes, strum_error *error)
{
    work w = work_begin(options);
    return make(params, false, &w, modes, error);
}

strum_status spectrum_unscaled(const strum_cable *cable, int count, work *w,
                               strum_modes **modes, strum_error *error)
{
    return make(&(strum_modes_params){*cable, STRUM_IN_PLANE, count, true}, true, w, modes,
                error);
}

double strum_modes_work(const strum_modes_params *params)
{
    const strum_cable *cable = &params->cable;
    const strum_plane plane = params->plane;
    const bool shapes = params->shapes;
    const int count = params->count;
    const double lost = spectrum_phase_count(cable, plane, largest_rate(cable, plane) / 2);
    const int want = count + (int)fmin(lost, 400);
    const bool level = cable->chi_m == 0; /* a symmetry to split by */
    /* measured: tests/bench; a fixed part, assembly, and the eigenproblems */
    if (by_displacement(cable, plane, shapes)) {
        const double size = displacement_first_size(cable, want);
        return 25 + size * size * ((level ? 0.04 : 0.09) + (level ? 1.5e-4 : 6e-4) * size);
    }
    int first;
    (void)spectrum_mapping(cable, plane, want, &first);
    double size = first * (shapes ? 1.35 : 1);
    if (plane == STRUM_IN_PLANE && !level)
        size *= 2;
    const bool quadratic = plane == STRUM_IN_PLANE && !in_plane_proportional(cable);
    return 30 + 0.04 * size * size + (quadratic ? 0.03 : 0.0016) * size * size * size;
}

void strum_modes_free(strum_modes *sp)
{
    if (sp == NULL)
        return;
    arena_free(&sp->memory);
    free(sp);
}

size_t strum_modes_count(const strum_modes *sp)
{
    return (size_t)sp->count;
}

strum_status strum_modes_get(const strum_modes *sp, size_t index, strum_mode *mode)
{
    if (index >= (size_t)sp->count)
        return STRUM_ERR_RANGE;
    *mode = sp->modes[index];
    return STRUM_OK;
}

size_t strum_modes_overdamped(const strum_modes *sp, const double **decays)
{
    *decays = sp->decays;
    return (size_t)sp->overdamped;
}

double strum_modes_difference(const strum_modes *sp)
{
    return sp->difference;
}

int strum_modes_size(const strum_modes *sp)
{
    return sp->size;
}
