/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cache/slot.h"

#include <stdlib.h>

static atomic_size_t bytes_alive;

size_t entry_bytes(void)
{
    return atomic_load_explicit(&bytes_alive, memory_order_relaxed);
}

entry *entry_new(const cache_key *key, int status, strbuf *body)
{
    struct cached *s = body->failed || !body->data ? NULL : calloc(1, sizeof *s);
    if (!s) {
        strbuf_clear(body);
        return NULL;
    }
    s->entry.key = *key;
    key_hex(key, s->entry.hex);
    s->entry.status = status;
    /* What a growing text has to spare would be kept as long as the entry. */
    char *trimmed = realloc(body->data, body->size + 1);
    s->entry.body = trimmed ? trimmed : body->data;
    s->entry.size = body->size;
    atomic_fetch_add_explicit(&bytes_alive, body->size, memory_order_relaxed);
    *body = (strbuf){0};
    s->references = 1;
    s->body_holds = 1; /* of all references together */
    return &s->entry;
}

entry *entry_ref(entry *e)
{
    if (e)
        atomic_fetch_add_explicit(&cached_of(e)->references, 1, memory_order_relaxed);
    return e;
}

void entry_unref(entry *e)
{
    if (!e || atomic_fetch_sub_explicit(&cached_of(e)->references, 1, memory_order_acq_rel) > 1)
        return;
    for (size_t i = 0; i < ENTRY_PREBUILT; i++)
        if (e->prebuilt[i])
            e->prebuilt_drop(e->prebuilt[i]);
    entry_release_body(e);
}

void entry_hold_body(entry *e)
{
    atomic_fetch_add_explicit(&cached_of(e)->body_holds, 1, memory_order_relaxed);
}

void entry_release_body(entry *e)
{
    struct cached *s = cached_of(e);
    if (atomic_fetch_sub_explicit(&s->body_holds, 1, memory_order_acq_rel) > 1)
        return;
    atomic_fetch_sub_explicit(&bytes_alive, e->size, memory_order_relaxed);
    free(e->body);
    free(s);
}

entry *entry_solve(const evaluation *a, const cache_key *key, observer *w)
{
    char hex[KEY_HEX_SIZE];
    key_hex(key, hex);
    strbuf body = {0};
    problem p = {0};
    int status = 200;
    if (*w->cancel) {
        status = 503;
        w->cancelled = true;
        problem_set(&p, status, "nobody waits for this answer any more");
        problem_write(&p, NULL, &body);
    } else if (!evaluation_answer(a, hex, w, &body, &p)) {
        strbuf_clear(&body);
        status = p.status ? p.status : 500;
        problem_write(&p, NULL, &body);
    }
    problem_clear(&p);
    entry *e = entry_new(key, status, &body);
    if (e) {
        e->solve_us = w->solve_us;
        e->cpu_us = w->cpu_us;
        e->given_up = status == 503 && w->cancelled;
        e->estimate_us = evaluation_cost_us(a);
        e->transient = w->transient;
    }
    return e;
}
