/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a damped solve knows: its list of roots, and how it ends. */
#include "core/taut/solve.h"

#include <stdlib.h>

double taut_solve_scale(const taut_solve *s, cplx root)
{
    /* slow overdamped roots crowd about 0 when a damper is strong */
    return cimag(root) == 0.0 ? cabs(root) : cabs(root) + 1e-3 * s->search.spacing;
}

bool taut_solve_before(cplx a, cplx b)
{
    if (fabs(cimag(a) - cimag(b)) > TAUT_TIE * cimag(a))
        return cimag(a) < cimag(b);
    return creal(a) > creal(b);
}

strum_status taut_solve_no_memory(taut_solve *s)
{
    return error_set(s->fault, STRUM_ERR_MEMORY, "no memory for damped roots");
}

strum_status taut_solve_stopped(taut_solve *s)
{
    return s->search.status == s->search.work.status
               ? work_error(&s->search.work, s->fault)
               : error_set(s->fault, s->search.status,
                           "the roots were not all found within the work allowed; ask fewer "
                           "modes or a narrower band");
}

/* Room for `more` further roots. */
strum_status taut_solve_reserve(taut_solve *s, size_t more)
{
    if (s->known + more <= s->room)
        return STRUM_OK;
    const size_t room = 2 * s->room + more;
    cplx *roots = realloc(s->s, room * sizeof *roots);
    if (roots == NULL)
        return taut_solve_no_memory(s);
    s->s = roots;
    long *modes = realloc(s->mode, room * sizeof *modes);
    if (modes == NULL)
        return taut_solve_no_memory(s);
    s->mode = modes;
    s->room = room;
    return STRUM_OK;
}

void taut_solve_clear(taut_solve *s)
{
    free(s->s);
    free(s->mode);
    free(s->branches);
}
