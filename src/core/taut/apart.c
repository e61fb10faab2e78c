/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Roots on the list that lie too near each other for Newton's method: a circle about them says
 * how many there are, and where. Branches that end there keep their numbers; a number that
 * finds no root of its own loses its place, a root without a branch gets one without a number.
 */
#include "core/taut/solve.h"

/* Roots so near each other, in spacings of modes and in their own size, are looked at together.
 */
#define NEAR 1e-6
/* Entries of one cluster: several branches may end in one root. */
#define ENTRIES (2 * TAUT_CLUSTER_MAX)

typedef struct cluster {
    size_t entry[ENTRIES]; /* places on the list */
    size_t count;
    cplx centre;
    double spread, beyond; /* of the entries; to the nearest root outside */
} cluster;

static double near_to(const taut_solve *s, cplx root)
{
    return NEAR * fmin(s->search.spacing, taut_solve_scale(s, root));
}

/* All that hangs together with entry i by steps shorter than `near`. */
static void gather(const taut_solve *s, size_t i, double near, cluster *c)
{
    *c = (cluster){.entry = {i}, .count = 1, .beyond = INFINITY};
    for (size_t k = 0; k < c->count; k++)
        for (size_t j = 0; j < s->known && c->count < ENTRIES; j++) {
            bool in = false;
            for (size_t n = 0; n < c->count; n++)
                in = in || c->entry[n] == j;
            if (!in && cabs(s->s[j] - s->s[c->entry[k]]) <= near)
                c->entry[c->count++] = j;
        }
    for (size_t k = 0; k < c->count; k++)
        c->centre += s->s[c->entry[k]] / (double)c->count;
    if (cimag(c->centre) <= 2.0 * near) /* with its conjugate */
        c->centre = creal(c->centre);
    for (size_t j = 0; j < s->known; j++) {
        bool in = false;
        for (size_t n = 0; n < c->count; n++)
            in = in || c->entry[n] == j;
        const double far = cabs(s->s[j] - c->centre);
        if (in)
            c->spread = fmax(c->spread, far);
        else
            c->beyond = fmin(c->beyond, far);
    }
    if (cimag(c->centre) > 0.0)
        c->beyond = fmin(c->beyond, 2.0 * cimag(c->centre));
}

/* The roots about a cluster in the upper half plane and on the axis; -1 where no circle tells.
 */
static int look(taut_solve *s, const cluster *c, cplx *roots)
{
    const double spacing = s->search.spacing;
    const double size = fmin(spacing, taut_solve_scale(s, c->centre));
    for (double radius = fmin(1e-3 * size, 0.3 * c->beyond);
         radius > 4.0 * c->spread && radius > 1e-9 * size; radius *= 0.2) {
        taut_ring ring;
        if (!taut_ring_make(&s->search, c->centre, radius, 1.0, &ring))
            continue;
        cplx all[TAUT_CLUSTER_MAX];
        int upper = 0;
        taut_ring_roots(&s->search, &ring, 1.0, all);
        for (int k = 0; k < ring.count; k++)
            if (cimag(all[k]) >= 0.0)
                roots[upper++] = all[k];
        return upper;
    }
    return -1;
}

/* The nearest root that no entry has taken yet; -1: none. */
static int nearest(const cplx *roots, const bool *taken, int count, cplx s)
{
    int best = -1;
    for (int k = 0; k < count; k++)
        if (!taken[k] && (best < 0 || cabs(roots[k] - s) < cabs(roots[best] - s)))
            best = k;
    return best;
}

/* Marks what leaves the list. */
#define LEAVES (-1)

static strum_status assign(taut_solve *s, const cluster *c, const cplx *roots, int count)
{
    bool taken[TAUT_CLUSTER_MAX] = {false};
    for (size_t k = 0; k < c->count; k++) {
        const size_t i = c->entry[k];
        const int at = nearest(roots, taken, count, s->s[i]);
        if (at < 0) {
            s->mode[i] = LEAVES;
            continue;
        }
        taken[at] = true;
        s->s[i] = roots[at];
    }
    const strum_status status = taut_solve_reserve(s, TAUT_CLUSTER_MAX);
    for (int k = 0; k < count && status == STRUM_OK; k++)
        if (!taken[k]) {
            s->s[s->known] = roots[k];
            s->mode[s->known++] = 0;
        }
    return status;
}

/* Without a circle that tells: what is the same to its digits is one. */
static void drop_same(taut_solve *s, const cluster *c)
{
    for (size_t k = 1; k < c->count; k++)
        for (size_t j = 0; j < k; j++)
            if (s->mode[c->entry[j]] != LEAVES &&
                cabs(s->s[c->entry[k]] - s->s[c->entry[j]]) <=
                    TAUT_SAME * taut_solve_scale(s, s->s[c->entry[k]]))
                s->mode[c->entry[k]] = LEAVES;
}

strum_status taut_solve_tell_apart(taut_solve *s)
{
    const size_t listed = s->known;
    strum_status status = STRUM_OK;
    for (size_t i = 0; i < listed && status == STRUM_OK; i++) {
        const double near = near_to(s, s->s[i]);
        /* zeros at the origin were counted, not followed: each is one */
        bool first = s->mode[i] != LEAVES && s->s[i] != 0.0, alone = true;
        for (size_t k = 0; k < listed && first; k++)
            if (k != i && cabs(s->s[k] - s->s[i]) <= near) {
                alone = false;
                first = k > i;
            }
        if (!first || alone)
            continue;
        cluster c;
        cplx roots[TAUT_CLUSTER_MAX];
        gather(s, i, near, &c);
        const int count = look(s, &c, roots);
        if (s->search.status != STRUM_OK)
            return taut_solve_stopped(s);
        if (count >= 0)
            status = assign(s, &c, roots, count);
        else
            drop_same(s, &c);
    }
    size_t kept = 0;
    for (size_t i = 0; i < s->known; i++)
        if (s->mode[i] != LEAVES) {
            s->s[kept] = s->s[i];
            s->mode[kept++] = s->mode[i];
        }
    s->known = kept;
    return status;
}
