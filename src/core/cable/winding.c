/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/cable/winding.h"

#include <math.h>

#define DEPTH   24
#define LONGEST 1.0 /* step of the phase that is not halved */
#define PARTS   4   /* of each edge, at least */

typedef struct {
    const damped *d;
    double _Complex *room;
    work *w;
    strum_status status;
    bool sure;
} walk;

static double _Complex at(walk *k, double _Complex lambda)
{
    double _Complex phase = 1;
    if (k->status == STRUM_OK)
        k->status = damped_phase(k->d, lambda, k->room, k->w, &phase);
    return phase;
}

/* Turn of the phase from a to b, where it is u and v. */
static double turn(walk *k, double _Complex a, double _Complex b, double _Complex u,
                   double _Complex v, int depth)
{
    const double _Complex middle = (a + b) / 2, m = at(k, middle);
    const double first = carg(m / u), second = carg(v / m);
    const bool follows = fabs(first) < LONGEST && fabs(second) < LONGEST;
    if (follows || k->status != STRUM_OK)
        return first + second;
    if (depth == DEPTH) {
        k->sure = false;
        return first + second;
    }
    return turn(k, a, middle, u, m, depth + 1) + turn(k, middle, b, m, v, depth + 1);
}

static double edge(walk *k, double _Complex a, double _Complex b)
{
    double sum = 0;
    double _Complex from = a, phase = at(k, a);
    for (int i = 1; i <= PARTS; i++) {
        const double _Complex to = a + (b - a) * ((double)i / PARTS);
        const double _Complex next = at(k, to);
        sum += turn(k, from, to, phase, next, 0);
        from = to;
        phase = next;
    }
    return sum;
}

/* Undamped frequencies in the box: poles of the function, where it has them. */
static long poles(const damped *d, const winding_box *box)
{
    long count = 0;
    for (int k = 0; k < d->n && damped_has_poles(d); k++) {
        const double mu = d->reduced->mu[k];
        const double frequency = mu > 0 ? 1 / sqrt(mu) : HUGE_VAL;
        count += frequency > box->low && frequency < box->high;
    }
    return count;
}

strum_status winding_count(const damped *d, const winding_box *box, work *w, long *count,
                           bool *sure)
{
    arena scratch = {.work = w};
    walk k = {d, arena_alloc(&scratch, damped_phase_room(d), sizeof(double _Complex)), w,
              STRUM_OK, true};
    if (k.room == NULL)
        return STRUM_ERR_MEMORY;
    const double _Complex corner[] = {CMPLX(box->left, box->low), CMPLX(box->right, box->low),
                                      CMPLX(box->right, box->high),
                                      CMPLX(box->left, box->high)};
    double sum = 0;
    for (int i = 0; i < 4; i++)
        sum += edge(&k, corner[i], corner[(i + 1) % 4]);
    arena_free(&scratch);
    const double turns = sum / (2 * M_PI);
    *count = lround(turns) + poles(d, box);
    *sure = k.sure && fabs(turns - (double)lround(turns)) < 1e-3;
    return k.status;
}
