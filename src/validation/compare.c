/* SPDX-License-Identifier: GPL-3.0-or-later */
/* tests/cases/README.md says what each kind of check means; tests/cases/run is the same in
 * Python. */
#include "validation/compare.h"

#include <complex.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define TOKEN_MAX 128

/* ---- JSON pointers with "*" ---- */

typedef struct found {
    const cJSON **items; /* owned */
    size_t count;
    bool missing; /* something on the way is not there */
} found;

static bool found_add(found *f, const cJSON *item)
{
    /* Twice the room at every power of two. */
    if ((f->count & (f->count - 1)) == 0) {
        const cJSON **grown = realloc(f->items, sizeof *grown * (f->count ? 2 * f->count : 1));
        if (grown == NULL)
            return false;
        f->items = grown;
    }
    f->items[f->count++] = item;
    return true;
}

static const cJSON *step(const cJSON *value, const char *token)
{
    char *end;
    const long index = strtol(token, &end, 10);
    if (cJSON_IsArray(value))
        return *token && !*end ? cJSON_GetArrayItem(value, (int)index) : NULL;
    return cJSON_GetObjectItemCaseSensitive(value, token);
}

/* All children of every item. */
static bool found_spread(found *f)
{
    found next = {0};
    bool good = true;
    for (size_t i = 0; i < f->count && good; i++) {
        next.missing |= !cJSON_IsArray(f->items[i]);
        for (const cJSON *child = f->items[i]->child; child && good; child = child->next)
            good = found_add(&next, child);
    }
    next.missing |= f->missing;
    free(f->items);
    *f = next;
    return good;
}

/* False when memory ran out. The items are the caller's to free. */
static bool resolve(const cJSON *document, const char *pointer, found *f)
{
    *f = (found){0};
    bool good = found_add(f, document);
    while (good && *pointer == '/' && !f->missing) {
        char token[TOKEN_MAX];
        size_t size = 0;
        for (pointer++; *pointer && *pointer != '/' && size < TOKEN_MAX - 1; pointer++) {
            const bool escaped = *pointer == '~' && (pointer[1] == '0' || pointer[1] == '1');
            token[size++] = !escaped ? *pointer : *++pointer == '0' ? '~' : '/';
        }
        token[size] = '\0';
        if (strcmp(token, "*") == 0) {
            good = found_spread(f);
            continue;
        }
        for (size_t i = 0; i < f->count; i++) {
            f->items[i] = step(f->items[i], token);
            f->missing |= f->items[i] == NULL;
        }
    }
    return good;
}

/* ---- values ---- */

static const cJSON *member(const cJSON *object, const char *name)
{
    return cJSON_GetObjectItemCaseSensitive(object, name);
}

static const char *word(const cJSON *object, const char *name)
{
    const char *value = cJSON_GetStringValue(member(object, name));
    return value ? value : "";
}

/* A number, {"re", "im"}, or the two named members of an object taken as one. */
static bool number_of(const cJSON *value, const cJSON *members, double _Complex *z)
{
    if (cJSON_IsNumber(value)) {
        *z = value->valuedouble;
        return true;
    }
    const cJSON *re = member(value, members ? members->child->valuestring : "re");
    const cJSON *im = member(value, members ? members->child->next->valuestring : "im");
    if (!cJSON_IsNumber(re) || !cJSON_IsNumber(im))
        return false;
    *z = CMPLX(re->valuedouble, im->valuedouble);
    return true;
}

static void write_value(json_writer *json, const cJSON *value)
{
    if (cJSON_IsNumber(value)) {
        json_number(json, value->valuedouble);
    } else if (cJSON_IsString(value)) {
        json_string(json, value->valuestring);
    } else if (cJSON_IsBool(value)) {
        json_flag(json, cJSON_IsTrue(value));
    } else if (cJSON_IsObject(value)) {
        json_open_object(json);
        for (const cJSON *child = value->child; child; child = child->next) {
            json_key(json, child->string);
            write_value(json, child);
        }
        json_close_object(json);
    } else {
        json_open_array(json);
        for (const cJSON *child = value ? value->child : NULL; child; child = child->next)
            write_value(json, child);
        json_close_array(json);
    }
}

/* The computed value: of an object with `members` only these. */
static void write_computed(json_writer *json, const cJSON *value, const cJSON *members)
{
    double _Complex z;
    json_key(json, "computed");
    if (!cJSON_IsNumber(value) && number_of(value, members, &z))
        json_complex(json, z);
    else
        write_value(json, value);
}

/* ---- rows ---- */

typedef struct row {
    const cJSON *check, *want, *got, *allowed; /* got NULL: not there */
    int item;                                  /* -1: no list */
    double difference;                         /* NAN: not of numbers */
    bool holds;
} row;

static void write_row(comparison *c, const row *r)
{
    json_writer *json = c->rows;
    json_open_object(json);
    json_put_string(json, "pointer", word(r->check, "pointer"));
    if (r->item >= 0)
        json_put_integer(json, "item", r->item);
    json_put_string(json, "kind", word(r->check, "kind"));
    if (r->want) {
        json_key(json, "expected");
        write_value(json, r->want);
    }
    if (r->got)
        write_computed(json, r->got, member(r->check, "members"));
    if (isfinite(r->difference))
        json_put_number(json, "difference", r->difference);
    if (cJSON_IsNumber(r->allowed))
        json_put_number(json, "tolerance", r->allowed->valuedouble);
    json_put_flag(json, "holds", r->holds);
    const cJSON *printed =
        cJSON_GetArrayItem(member(r->check, "printed"), r->item < 0 ? 0 : r->item);
    if (printed) {
        json_put_string(json, "printed", word(printed, "value"));
        json_put_string(json, "verdict", word(printed, "verdict"));
        if (*word(printed, "why"))
            json_put_string(json, "why", word(printed, "why"));
    }
    json_close_object(json);
    c->values++;
    c->missed += !r->holds;
    const double tolerance = cJSON_IsNumber(r->allowed) ? r->allowed->valuedouble : 0;
    if (isfinite(r->difference) && tolerance > 0 &&
        !(r->difference * c->worst_tolerance <= c->worst_difference * tolerance &&
          c->worst_tolerance > 0)) {
        c->worst_difference = r->difference;
        c->worst_tolerance = tolerance;
    }
}

/* Fills difference and verdict; `scale` is a factor on the computed number. */
static void judge(row *r, double _Complex scale)
{
    double _Complex got, want;
    const cJSON *members = member(r->check, "members");
    r->difference = NAN;
    if (r->got && number_of(r->got, members, &got) && number_of(r->want, NULL, &want)) {
        r->difference = cabs(got * scale - want);
        r->holds =
            r->difference <= (cJSON_IsNumber(r->allowed) ? r->allowed->valuedouble : 0.0);
    } else {
        r->holds =
            r->got && !cJSON_IsNumber(r->allowed) && cJSON_Compare(r->got, r->want, true);
    }
}

static void check_list(const cJSON *check, const found *f, bool single, double _Complex scale,
                       comparison *c)
{
    const cJSON *want = member(check, "want")->child,
                *allowed = member(check, "allowed")->child;
    size_t i = 0;
    for (; want; want = want->next, allowed = allowed->next, i++) {
        row r = {
            .check = check, .want = want, .allowed = allowed, .item = single ? -1 : (int)i};
        r.got = !f->missing && i < f->count ? f->items[i] : NULL;
        judge(&r, scale);
        write_row(c, &r);
    }
    for (; !f->missing && i < f->count; i++) /* more than expected */
        write_row(
            c, &(row){.check = check, .got = f->items[i], .item = (int)i, .difference = NAN});
}

/* Each expected value among the found ones, each beside another one. */
static void check_matches(const cJSON *check, found *f, comparison *c)
{
    const cJSON *want = member(check, "want")->child,
                *allowed = member(check, "allowed")->child;
    for (int i = 0; want; want = want->next, allowed = allowed->next, i++) {
        row best = {
            .check = check, .want = want, .allowed = allowed, .item = i, .difference = NAN};
        size_t at = f->count;
        for (size_t k = 0; k < f->count && !f->missing; k++) {
            row r = best;
            r.got = f->items[k];
            if (r.got == NULL)
                continue;
            judge(&r, 1);
            if (!best.got || r.difference < best.difference || (r.holds && !best.holds)) {
                best = r;
                at = k;
            }
        }
        if (at < f->count)
            f->items[at] = NULL; /* taken */
        write_row(c, &best);
    }
}

static void check_one(const cJSON *check, const found *f, comparison *c)
{
    const char *kind = word(check, "kind");
    row r = {
        .check = check, .want = member(check, "want")->child, .item = -1, .difference = NAN};
    r.got = !f->missing && f->count ? f->items[0] : NULL;
    const bool numbers = cJSON_IsNumber(r.got) && cJSON_IsNumber(r.want);
    if (strcmp(kind, "below") == 0) {
        r.holds = numbers && r.got->valuedouble < r.want->valuedouble;
    } else if (strcmp(kind, "above") == 0) {
        r.holds = numbers && r.got->valuedouble > r.want->valuedouble;
    } else if (strcmp(kind, "count") == 0) {
        const bool list = strchr(word(check, "pointer"), '*') == NULL;
        const double count = !list ? (double)f->count : cJSON_GetArraySize(r.got);
        r.difference = f->missing ? NAN : fabs(count - r.want->valuedouble);
        r.holds = r.difference == 0;
        r.got = NULL; /* the list itself would be too much to show */
    } else {
        r.holds = f->missing; /* absent */
        r.want = NULL;
    }
    write_row(c, &r);
}

static bool find_list(const cJSON *check, const cJSON *answer, found *f)
{
    return resolve(answer, word(check, "pointer"), f) &&
           (strchr(word(check, "pointer"), '*') != NULL || f->missing || found_spread(f));
}

/* Least squares for the one factor of all parts; lists weigh alike although their units differ.
 */
static void check_scaled(const cJSON *check, const cJSON *answer, comparison *c)
{
    double _Complex above = 0, got, want;
    double below = 0;
    const cJSON *part;
    for (int round = 0; round < 2 && !c->failed; round++)
        cJSON_ArrayForEach(part, member(check, "parts"))
        {
            found f;
            const cJSON *members = member(part, "members"), *one;
            if (!find_list(part, answer, &f))
                c->failed = true;
            else if (round == 1)
                check_list(part, &f, false, below > 0 ? above / below : 1, c);
            double size = 0;
            cJSON_ArrayForEach(one, member(part, "want")) if (number_of(one, NULL, &want))
                size = fmax(size, cabs(want));
            size_t i = 0;
            if (round == 0 && !f.missing && size > 0)
                cJSON_ArrayForEach(one, member(part, "want"))
                {
                    if (i < f.count && number_of(f.items[i], members, &got) &&
                        number_of(one, NULL, &want)) {
                        above += want * conj(got) / (size * size);
                        below += creal(got * conj(got)) / (size * size);
                    }
                    i++;
                }
            free(f.items);
        }
}

void compare_answer(const cJSON *checks, const cJSON *answer, comparison *c)
{
    const cJSON *check;
    cJSON_ArrayForEach(check, checks)
    {
        const char *kind = word(check, "kind");
        const bool list = strcmp(kind, "values") == 0 || strcmp(kind, "matches") == 0;
        if (strcmp(kind, "up_to_scale") == 0) {
            check_scaled(check, answer, c);
            continue;
        }
        found f = {0};
        if (!(list ? find_list(check, answer, &f)
                   : resolve(answer, word(check, "pointer"), &f)))
            c->failed = true;
        else if (strcmp(kind, "matches") == 0)
            check_matches(check, &f, c);
        else if (list || strcmp(kind, "value") == 0)
            check_list(check, &f, !list, 1, c);
        else
            check_one(check, &f, c);
        free(f.items);
    }
}
