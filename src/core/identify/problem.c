/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/identify/problem.h"

size_t problem_unknowns(const problem *p, int which[UNKNOWNS_MAX])
{
    size_t n = 0;
    for (int q = 0; q < QUANTITIES; q++)
        if (p->unknown[q] && n < UNKNOWNS_MAX)
            which[n++] = q;
    return n;
}

size_t problem_data(const problem *p)
{
    size_t n = 0;
    for (size_t i = 0; i < p->count; i++)
        n += !p->skip[i];
    return n;
}

size_t problem_rows(const problem *p)
{
    size_t n = problem_data(p);
    for (int q = 0; q < QUANTITIES; q++)
        n += p->prior[q] > 0;
    return n;
}

void state_close(const problem *p, state *s)
{
    const double length = s->q[LENGTH];
    if (p->chain != NULL)
        return;
    if (p->unknown[BENDING])
        s->q[BENDING] = s->q[TENSION] * (length * s->u) * (length * s->u);
    else
        s->u = sqrt(s->q[BENDING] / s->q[TENSION]) / length;
}

double state_mass(const problem *p, const state *s)
{
    return s->q[MASS] + p->added_mass;
}

double state_slack(const problem *p, const state *s)
{
    const double ratio = p->weight * s->q[LENGTH] / s->q[TENSION];
    return ratio * ratio / 8;
}

double state_lambda2(const problem *p, const state *s)
{
    if (!p->sag)
        return 0;
    const double q = state_slack(p, s);
    return 8 * q * s->q[AXIAL] / (s->q[TENSION] * (1 + q));
}
