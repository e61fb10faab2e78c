/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The same data otherwise: both ends pinned, both clamped, and the modes numbered otherwise. */
#include "core/identify/report.h"

/* Numbers that fit better by this factor of chi^2 are reported. */
#define SHIFT_RATIO 10.0

static strum_status tension_with(const strum_identify *f, strum_identify_end_kind kind,
                                 double *tension)
{
    problem p = f->p;
    fit other = f->fits[0];
    p.unknown[FIXITY] = false;
    p.prior[FIXITY] = 0;
    p.value[FIXITY] = kind == STRUM_IDENTIFY_CLAMPED;
    for (int i = 0; i < 2; i++)
        p.ends[i].kind = kind;
    *tension = NAN;
    const strum_status status = fit_descend(&p, &other);
    if (status == STRUM_OK)
        *tension = other.at.q[TENSION];
    return status == STRUM_ERR_ACCURACY ? STRUM_OK : status;
}

/* Numbers moved by `shift`: from the state as it is, and with little bending. */
static strum_status shifted(const strum_identify *f, int shift, double *chi2, double *tension)
{
    problem p = f->p;
    strum_status status = STRUM_OK;
    *chi2 = HUGE_VAL;
    for (size_t i = 0; i < p.count; i++)
        p.modes[i] += shift;
    if (p.chain != NULL)
        status = model_prepare_chain(&p, NULL);
    for (int pass = 0; pass < 2 && status == STRUM_OK; pass++) {
        fit other = f->fits[0];
        const size_t last = p.count - 1;
        const double factor = (double)f->p.modes[last] / p.modes[last];
        other.at.q[TENSION] *= factor * factor;
        if (pass == 1)
            other.at.u = 1e-3;
        if (pass == 1 && !p.unknown[BENDING])
            break;
        status = fit_descend(&p, &other);
        if (status == STRUM_ERR_ACCURACY)
            status = STRUM_OK;
        else if (status == STRUM_OK && other.chi2 < *chi2) {
            *chi2 = other.chi2;
            *tension = other.at.q[TENSION];
        }
    }
    return status;
}

static strum_status try_shifts(strum_identify *f)
{
    static const int shifts[] = {-1, 1, 2};
    strum_identify_summary *s = &f->summary;
    const double own = f->fits[0].chi2;
    strum_status status = STRUM_OK;
    double best = own / SHIFT_RATIO;
    /* Few residuals differ by as much by chance; and with known deviations the difference counts. */
    if (s->degrees_of_freedom < (f->p.weighted ? 1 : 2) || (f->p.weighted && own < SHIFT_RATIO))
        return STRUM_OK;
    for (size_t i = 0; i < 3 && status == STRUM_OK; i++) {
        double chi2, tension;
        if (f->p.modes[0] + shifts[i] < 1 ||
            f->p.modes[f->p.count - 1] + shifts[i] > STRUM_IDENTIFY_MODE_MAX)
            continue;
        status = shifted(f, shifts[i], &chi2, &tension);
        if (status == STRUM_OK && chi2 < best) {
            best = chi2;
            s->better_shift = shifts[i];
            s->shift_tension = tension;
            s->shift_ratio = own / chi2;
        }
    }
    return status;
}

/* Where EI is not determined: the tension of a cable without any. */
static strum_status without_bending(strum_identify *f)
{
    problem p = f->p;
    fit other = f->fits[0];
    p.unknown[BENDING] = p.unknown[FIXITY] = false;
    p.value[BENDING] = 0;
    p.prior[FIXITY] = 0;
    other.at.q[BENDING] = 0;
    const strum_status status = fit_descend(&p, &other);
    if (status == STRUM_OK)
        f->summary.tension_at_no_bending = other.at.q[TENSION];
    return status == STRUM_ERR_ACCURACY ? STRUM_OK : status;
}

strum_status report_alternatives(strum_identify *f)
{
    strum_identify_summary *s = &f->summary;
    const problem *p = &f->p;
    strum_status status = STRUM_OK;
    s->tension_if_pinned = s->tension_if_clamped = s->tension_at_no_bending = NAN;
    if (!p->unknown[TENSION] || p->ratios_at < p->count)
        return STRUM_OK;
    if (p->chain == NULL && f->fits[0].at.u > 0) {
        status = tension_with(f, STRUM_IDENTIFY_PINNED, &s->tension_if_pinned);
        if (status == STRUM_OK)
            status = tension_with(f, STRUM_IDENTIFY_CLAMPED, &s->tension_if_clamped);
    }
    if (status == STRUM_OK && p->unknown[BENDING] && !(p->prior[BENDING] > 0) &&
        !f->estimates[BENDING].determined)
        status = without_bending(f);
    if (status == STRUM_OK && f->reading_count == 0)
        status = try_shifts(f);
    return status;
}
