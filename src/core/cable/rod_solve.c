/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Newton's method for the rod: bubbles eliminated in each element, a tridiagonal system for the
 * angles at nodes, then two equations for the force at end 1. */
#include <float.h>
#include <math.h>

#include "core/cable/form.h"
#include "core/cable/rod.h"
#include "core/cable/rod_element.h"

#define STEPS_MAX    40
#define TURN_MAX     0.3 /* largest step of an angle, in radians */
#define HALVINGS_MAX 3
/* Of the largest angle: what the last bubbles of an element may be. */
#define TAIL 1e-10
/* Estimated time of an element, in microseconds. */
#define ELEMENT_US 10

typedef struct {
    strum_hanging *cable;
    double span;
    rod_rule rules[ROD_DEGREE_MAX + 1]; /* by degree; made when needed */
    double *room, *solved;              /* of all bubbles, five columns each */
    double *diagonal, *off;             /* of the nodes' system */
    double (*column)[ROD_COLUMNS];
    double force[2][2], along[2], miss[2];
    double tension;
    bool stable;
} solver;

/* ---- forces of the pieces ---- */

/* Direction of a tension jump: the tangent of the rod or, without bending, of the force. */
static void tangent_at(const strum_hanging *cable, size_t station, double h, double v,
                       double *x, double *z)
{
    const size_t side = rod_bends(cable, station - 1) ? station - 1 : station;
    double angle = atan2(v, h);
    if (rod_bends(cable, side))
        angle =
            rod_at(cable, side, side == station ? 0 : cable->pieces[side].length, false).angle;
    *x = cos(angle);
    *z = sin(angle);
}

static void place_forces(strum_hanging *cable, double h, double v)
{
    for (size_t i = 0; i < cable->piece_count; i++) {
        cable_piece *piece = cable->pieces + i;
        const cable_station *station = cable->stations + i;
        double jump = 0, x, z;
        for (size_t k = station->first; k < station->first + station->count; k++) {
            const strum_cable_attachment *a = cable->attachments + k;
            if (a->kind == STRUM_CABLE_TENSION_JUMP)
                jump += a->jump;
        }
        if (jump != 0) {
            tangent_at(cable, i, h, v, &x, &z);
            h += jump * x;
            v += jump * z;
        }
        for (size_t k = station->first; k < station->first + station->count; k++) {
            const strum_cable_attachment *a = cable->attachments + k;
            v += line_weight(a);
            if (a->kind == STRUM_CABLE_FORCE) {
                h -= a->force_x;
                v -= a->force_z;
            }
        }
        piece->h = h;
        piece->v = v;
        v += piece->section->weight * piece->length;
    }
}

/* ---- the system ---- */

static void add_flexible(solver *s, const cable_piece *piece)
{
    const cable_arc arc = form_arc(piece);
    const cable_arc_reach r = arc_reach_slopes(&arc, piece->h, piece->v);
    s->miss[0] -= r.x;
    s->miss[1] -= r.z;
    s->force[0][0] += r.xx;
    s->force[0][1] += r.xz;
    s->force[1][1] += r.zz;
    s->tension = fmax(s->tension, hypot(piece->h, piece->v));
}

static void add_element(solver *s, const rod_element *e)
{
    double *solved = s->solved + 5 * e->first;
    const rod_condensed c = rod_condense(s->cable, e, s->rules + e->degree, solved, s->room);
    for (size_t a = 0; a < 2; a++) {
        s->diagonal[e->node + a] += c.hats[a][a];
        s->miss[a] -= c.reach[a];
        s->along[a] += c.along[a];
        for (int k = 0; k < ROD_COLUMNS; k++)
            s->column[e->node + a][k] += c.column[a][k];
        for (size_t b = a; b < 2; b++)
            s->force[a][b] += c.force[a][b];
    }
    s->off[e->node] = c.hats[0][1];
    s->tension = fmax(s->tension, c.tension);
    s->stable = s->stable && c.stable;
}

/* Node of an end of the cable; false: its piece does not bend. */
static bool end_node(const strum_hanging *cable, int end, size_t *node)
{
    const cable_rod *rod = cable->rod;
    *node = end == 0 ? 0 : rod->nodes - 1;
    return rod_bends(cable, end == 0 ? 0 : cable->piece_count - 1);
}

static void hold_ends(solver *s, const double angle[2])
{
    const strum_cable_end *ends[] = {&s->cable->params.end_1, &s->cable->params.end_2};
    for (int i = 0; i < 2; i++) {
        size_t node;
        if (!end_node(s->cable, i, &node))
            continue;
        /* what holds the end's angle: the moment, and as precise as the energy is */
        const double moment = s->column[node][ROD_GRADIENT];
        s->cable->rod->moment[i] = i == 0 ? -moment : moment;
        if (ends[i]->rotation == STRUM_CABLE_SPRUNG) {
            s->diagonal[node] += ends[i]->stiffness;
            s->column[node][ROD_GRADIENT] +=
                ends[i]->stiffness * (s->cable->rod->angle[node] - angle[i]);
        }
        if (ends[i]->rotation == STRUM_CABLE_CLAMPED) {
            s->diagonal[node] = 1;
            s->off[i == 0 ? node : node - 1] = 0;
            for (int k = 0; k < ROD_COLUMNS; k++)
                s->column[node][k] = 0;
        }
    }
}

static void assemble(solver *s, const double angle[2])
{
    const cable_rod *rod = s->cable->rod;
    s->miss[0] = s->span;
    s->miss[1] = s->cable->params.rise;
    s->along[0] = s->along[1] = s->tension = 0;
    s->force[0][0] = s->force[0][1] = s->force[1][1] = 0;
    s->stable = true;
    for (size_t i = 0; i < rod->nodes; i++) {
        s->diagonal[i] = s->off[i] = 0;
        for (int k = 0; k < ROD_COLUMNS; k++)
            s->column[i][k] = 0;
    }
    for (size_t i = 0; i < s->cable->piece_count; i++)
        if (!rod_bends(s->cable, i))
            add_flexible(s, s->cable->pieces + i);
    for (size_t i = 0; i < rod->count; i++)
        add_element(s, rod->elements + i);
    hold_ends(s, angle);
}

/* Tridiagonal, LDL'; column becomes the solution. `own`: kept copies of it. */
static void solve_nodes(solver *s, double (*own)[ROD_COLUMNS])
{
    const size_t n = s->cable->rod->nodes;
    for (size_t i = 0; i < n; i++)
        for (int k = 0; k < ROD_COLUMNS; k++)
            own[i][k] = s->column[i][k];
    for (size_t i = 0; i + 1 < n; i++) {
        s->stable = s->stable && s->diagonal[i] > 0;
        const double factor = s->off[i] / s->diagonal[i];
        s->diagonal[i + 1] -= factor * s->off[i];
        for (int k = 0; k < ROD_COLUMNS; k++)
            s->column[i + 1][k] -= factor * s->column[i][k];
    }
    s->stable = s->stable && s->diagonal[n - 1] > 0;
    for (size_t i = n; i-- > 0;)
        for (int k = 0; k < ROD_COLUMNS; k++) {
            if (i + 1 < n)
                s->column[i][k] -= s->off[i] * s->column[i + 1][k];
            s->column[i][k] /= s->diagonal[i];
        }
}

/* ---- one step ---- */

/* (C + B'K^-1 B) dF = miss - B'K^-1 g. */
static void step_force(solver *s, double (*own)[ROD_COLUMNS], double step[2])
{
    for (size_t i = 0; i < s->cable->rod->nodes; i++)
        for (int a = 0; a < 2; a++) {
            s->along[a] += own[i][ROD_FORCE_X + a] * s->column[i][ROD_GRADIENT];
            for (int b = a; b < 2; b++)
                s->force[a][b] += own[i][ROD_FORCE_X + a] * s->column[i][ROD_FORCE_X + b];
        }
    const double x = s->miss[0] - s->along[0], z = s->miss[1] - s->along[1];
    /* by eigenvectors: a straight inextensible cable leaves the force along it as it is */
    const double half = (s->force[0][0] - s->force[1][1]) / 2,
                 mean = (s->force[0][0] + s->force[1][1]) / 2;
    const double radius = hypot(half, s->force[0][1]);
    const double turn = atan2(s->force[0][1], half) / 2, c = cos(turn), d = sin(turn);
    const double large = mean + radius,
                 small = (s->force[0][0] * s->force[1][1] - s->force[0][1] * s->force[0][1]) /
                         large;
    const double along = (c * x + d * z) / large;
    const double across = small > 1e-14 * large ? (c * z - d * x) / small : 0;
    step[0] = c * along - d * across;
    step[1] = d * along + c * across;
}

/* Step of a bubble: -K^-1 (g + B dF) less what the nodes' steps bring. */
static double bubble_step(const solver *s, const rod_element *e, int k, const double force[2],
                          const double *nodes)
{
    const int m = e->degree - 1;
    const double *solved = s->solved + 5 * e->first + k;
    return -solved[2 * m] - solved[3 * m] * force[0] - solved[4 * m] * force[1] -
           solved[0] * nodes[e->node] - solved[m] * nodes[e->node + 1];
}

/* Size of the step, in radians and of the force. */
static double advance(solver *s, double (*own)[ROD_COLUMNS], double *nodes, double force[2])
{
    cable_rod *rod = s->cable->rod;
    double turn = 0, part = 1;
    solve_nodes(s, own);
    step_force(s, own, force);
    for (size_t i = 0; i < rod->nodes; i++) {
        nodes[i] = -s->column[i][ROD_GRADIENT] - s->column[i][ROD_FORCE_X] * force[0] -
                   s->column[i][ROD_FORCE_Z] * force[1];
        turn = fmax(turn, fabs(nodes[i]));
    }
    for (size_t i = 0; i < rod->count; i++)
        for (int k = 0; k < rod->elements[i].degree - 1; k++)
            turn = fmax(turn, fabs(bubble_step(s, rod->elements + i, k, force, nodes)));
    if (turn > TURN_MAX)
        part = TURN_MAX / turn;
    for (size_t i = 0; i < rod->count; i++)
        for (int k = 0; k < rod->elements[i].degree - 1; k++)
            rod->bubble[rod->elements[i].first + (size_t)k] +=
                part * bubble_step(s, rod->elements + i, k, force, nodes);
    for (size_t i = 0; i < rod->nodes; i++)
        rod->angle[i] += part * nodes[i];
    const double size = fmax(turn, hypot(force[0], force[1]) / s->tension);
    force[0] *= part;
    force[1] *= part;
    return size;
}

static strum_status newton(solver *s, const double angle[2], arena *memory)
{
    const size_t n = s->cable->rod->nodes;
    double(*own)[ROD_COLUMNS] = arena_alloc(memory, n, sizeof *own);
    double *nodes = arena_doubles(memory, n), last = INFINITY;
    if (own == NULL || nodes == NULL)
        return STRUM_ERR_MEMORY;
    for (int i = 0; i < STEPS_MAX; i++) {
        double force[2];
        const double us = ELEMENT_US * (double)s->cable->rod->count;
        if (work_spend(memory->work, us) != STRUM_OK)
            return memory->work->status;
        assemble(s, angle);
        const double size = advance(s, own, nodes, force);
        if (!isfinite(size))
            return STRUM_ERR_ACCURACY;
        place_forces(s->cable, s->cable->pieces[0].h + force[0],
                     s->cable->pieces[0].v + force[1]);
        if (size < 16 * DBL_EPSILON || (size < (i < 20 ? 1e-11 : 1e-9) && size > last / 4))
            return s->stable ? STRUM_OK : STRUM_ERR_IMPOSSIBLE;
        last = size;
    }
    return STRUM_ERR_ACCURACY;
}

/* ---- preparing, and looking back ---- */

/* Nearest to what the angle is now. */
static double end_angle(const strum_cable_end *end, double now)
{
    return isnan(end->angle) ? now : now + remainder(end->angle - now, 2 * M_PI);
}

static strum_status prepare(solver *s, arena *memory, double angle[2])
{
    cable_rod *rod = s->cable->rod;
    const strum_cable_end *ends[] = {&s->cable->params.end_1, &s->cable->params.end_2};
    for (size_t i = 0; i < rod->count; i++) {
        const int degree = rod->elements[i].degree;
        if (s->rules[degree].points == 0 &&
            rod_rule_make(degree, memory, s->rules + degree) != STRUM_OK)
            return STRUM_ERR_MEMORY;
    }
    s->room = arena_doubles(memory, rod_element_room(ROD_DEGREE_MAX));
    s->solved = arena_doubles(memory, 5 * rod->bubbles + 1);
    s->diagonal = arena_doubles(memory, 2 * rod->nodes);
    s->column = arena_alloc(memory, rod->nodes, sizeof *s->column);
    if (s->room == NULL || s->solved == NULL || s->diagonal == NULL || s->column == NULL)
        return STRUM_ERR_MEMORY;
    s->off = s->diagonal + rod->nodes;
    for (int i = 0; i < 2; i++) {
        size_t node;
        if (!end_node(s->cable, i, &node))
            continue;
        angle[i] = end_angle(ends[i], rod->angle[node]);
        if (ends[i]->rotation == STRUM_CABLE_CLAMPED)
            rod->angle[node] = angle[i];
    }
    return STRUM_OK;
}

/* Whether the last bubbles of every element are small: the series has ended. */
static bool resolved(const cable_rod *rod)
{
    double largest = 1;
    for (size_t i = 0; i < rod->nodes; i++)
        largest = fmax(largest, fabs(rod->angle[i]));
    for (size_t i = 0; i < rod->count; i++) {
        const rod_element *e = rod->elements + i;
        const double *c = rod->bubble + e->first + e->degree - 3;
        /* a bubble of degree k is about k^-3/2 high */
        if (fmax(fabs(c[0]), fabs(c[1])) > TAIL * largest * e->degree)
            return false;
    }
    return true;
}

static void place_all(const solver *s)
{
    strum_hanging *cable = s->cable;
    double x = 0, z = 0;
    for (size_t i = 0; i < cable->piece_count; i++) {
        cable_piece *piece = cable->pieces + i;
        piece->x = cable->stations[i].x = x;
        piece->z = cable->stations[i].z = z;
        if (!rod_bends(cable, i)) {
            const form_state end = form_at(piece, piece->length);
            x = end.x;
            z = end.z;
            continue;
        }
        for (size_t k = cable->rod->first[i]; k < cable->rod->first[i + 1]; k++) {
            rod_element *e = cable->rod->elements + k;
            e->x = x;
            e->z = z;
            double dx, dz;
            rod_reach(cable, e, s->rules + e->degree, s->room, &dx, &dz, &e->stretched);
            x += dx;
            z += dz;
        }
    }
    cable->stations[cable->piece_count].x = x;
    cable->stations[cable->piece_count].z = z;
}

static strum_status attempt(strum_hanging *cable, double span, int halvings, work *w)
{
    arena scratch = {.work = w};
    double angle[2] = {0, 0};
    cable->rod = NULL;
    strum_status status = rod_divide(cable, halvings, &cable->memory, &cable->rod);
    solver *s = arena_alloc(&scratch, 1, sizeof *s);
    if (status == STRUM_OK)
        status = s == NULL ? STRUM_ERR_MEMORY : STRUM_OK;
    if (status == STRUM_OK) {
        s->cable = cable;
        s->span = span;
        status = prepare(s, &scratch, angle);
    }
    if (status == STRUM_OK)
        status = newton(s, angle, &scratch);
    if (status == STRUM_OK)
        place_all(s);
    arena_free(&scratch);
    return status;
}

strum_status rod_settle(strum_hanging *cable, double span, work *w, strum_error *error)
{
    const double h = cable->pieces[0].h, v = cable->pieces[0].v;
    strum_status status = STRUM_ERR_ACCURACY;
    for (int halvings = 0; halvings <= HALVINGS_MAX; halvings++) {
        cable->rod = NULL;
        place_forces(cable, h, v);
        status = attempt(cable, span, halvings, w);
        if (w->status != STRUM_OK)
            return work_error(w, error);
        if (status != STRUM_ERR_ACCURACY && (status != STRUM_OK || resolved(cable->rod)))
            break;
        status = STRUM_ERR_ACCURACY;
    }
    if (status == STRUM_ERR_IMPOSSIBLE)
        return error_set(error, status,
                         "the static shape with bending stiffness is not stable: the cable "
                         "buckles");
    if (status == STRUM_ERR_ACCURACY)
        return error_set(error, status,
                         "the static shape with bending stiffness was not found");
    if (status != STRUM_OK)
        return work_result(w, status, error);
    return STRUM_OK;
}
