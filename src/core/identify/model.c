/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a state of the cable predicts, and how that moves with each quantity. */
#include "core/identify/problem.h"
#include "core/identify/sag.h"

/* An end in a state, and the share of its stiffness that stands still with the fixity. */
static beam_end end_of(const problem *p, const state *s, int i)
{
    const strum_identify_end *e = &p->ends[i];
    switch (e->kind) {
    case STRUM_IDENTIFY_CLAMPED:
        return beam_end_by_fixity(1, s->u);
    case STRUM_IDENTIFY_FIXED_FIXITY:
        return beam_end_by_fixity(e->value, s->u);
    case STRUM_IDENTIFY_UNKNOWN_FIXITY:
        return beam_end_by_fixity(s->q[FIXITY], s->u);
    case STRUM_IDENTIFY_STIFFNESS:
        return beam_end_by_stiffness(s->u > 0 ? e->value * s->q[LENGTH] / s->q[BENDING]
                                              : HUGE_VAL);
    default:
        return beam_end_by_fixity(0, s->u);
    }
}

/* Fixity of an end in the limit of no bending: a spring of any stiffness is stiff then. */
static double limit_fixity(const problem *p, const state *s, int i)
{
    const strum_identify_end *e = &p->ends[i];
    return e->kind == STRUM_IDENTIFY_PINNED           ? 0
           : e->kind == STRUM_IDENTIFY_FIXED_FIXITY   ? e->value
           : e->kind == STRUM_IDENTIFY_UNKNOWN_FIXITY ? s->q[FIXITY]
           : e->kind == STRUM_IDENTIFY_STIFFNESS      ? e->value > 0
                                                      : 1;
}

/* Derivatives of ln f by the quantities. Held: the stiffness of an end, or its fixity; then
 * k = rho/(1 - rho) (3 EI/L + sqrt(T EI)) moves with the others. */
static void differentiate(const problem *p, const state *s, const beam_mode *m, prediction *o)
{
    const double q = p->sag ? state_slack(p, s) : 0, share = q / (1 + q);
    double t = m->tension + m->sag * (2 * share - 2), bend = m->bending;
    double length = -2 * m->tension - 4 * m->bending - 2 * m->sag * share, rho = 0;
    for (int i = 0; i < 2; i++) {
        const strum_identify_end_kind kind = p->ends[i].kind;
        length -= 3 * m->ends[i];
        if (kind == STRUM_IDENTIFY_STIFFNESS)
            continue;
        /* parts of sqrt(T EI) and 3 EI/L in their sum */
        const double layer = 1 / (1 + 3 * s->u), beam = 1 - layer;
        t += m->ends[i] * 0.5 * layer;
        bend += m->ends[i] * (beam + 0.5 * layer);
        length -= m->ends[i] * beam;
        if (kind == STRUM_IDENTIFY_UNKNOWN_FIXITY)
            rho += m->by_rho[i];
    }
    o->by[TENSION] = 0.5 * t;
    o->by[BENDING] = 0.5 * bend;
    o->by[FIXITY] = 0.5 * rho;
    o->by[LENGTH] = 0.5 * length;
    o->by[MASS] = -0.5 * s->q[MASS] / state_mass(p, s);
    o->by[AXIAL] = 0.5 * m->sag;
    /* Thin layers shorten the cable by rho sqrt(EI/T) each. */
    o->by_u = s->u > 0 ? 2 * o->by[BENDING] / s->u
                       : (m->tension - 0.5 * m->sag) *
                             (limit_fixity(p, s, 0) + limit_fixity(p, s, 1));
}

static strum_status beam_predict(const problem *p, const state *s, prediction *out)
{
    const beam_end ends[2] = {end_of(p, s, 0), end_of(p, s, 1)};
    const double lambda2 = state_lambda2(p, s);
    const double scale = sqrt(s->q[TENSION] / state_mass(p, s)) / (2 * M_PI * s->q[LENGTH]);
    const strum_status status = work_spend(p->work, (p->sag ? 4.0 : 0.4) * (double)p->count);
    for (size_t i = 0; i < p->count && status == STRUM_OK; i++) {
        if (p->skip[i])
            continue;
        const beam_mode m = lambda2 > 0 ? sag_solve(p->modes[i], s->u, ends, lambda2)
                                        : beam_solve(p->modes[i], s->u, ends);
        prediction *o = &out[i];
        *o = (prediction){.value = scale * m.om,
                          .tension = m.tension,
                          .bending = m.bending,
                          .ends = m.ends[0] + m.ends[1],
                          .sag = m.sag};
        differentiate(p, s, &m, o);
        for (int q = 0; q < QUANTITIES; q++)
            o->by[q] *= o->value;
        o->by_u *= o->value;
    }
    return status;
}

strum_status model_predict(const problem *p, const state *s, prediction *out)
{
    if (p->chain != NULL)
        return model_predict_chain(p, s, out);
    if (p->ratios_at < p->count)
        return model_predict_damper(p, s, out);
    return beam_predict(p, s, out);
}
