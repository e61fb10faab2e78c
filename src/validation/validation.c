/* SPDX-License-Identifier: GPL-3.0-or-later */
/* /v1/validation: the printed and reference cases of tests/cases, asked of this very program by
 * the way that every request goes, and held against what they expect. */
#include <ctype.h>
#include <math.h>
#include <string.h>

#include "validation/cases.h"
#include "validation/compare.h"
#include "endpoints/table.h"

/* The defaults of strumd, under which the cases say what is refused. */
static const json_limits limits = {.depth = 16, .values = 20000};
/* Rough work of a case; validation is always handed to the thread_pool. */
#define CASE_US 3000.0

typedef struct request {
    field_set given;
    int report;
    name_value family, endpoint;
    bool values;
} request;

static const char *const reports[] = {"all",         "gale",    "grinfogel", "levesque",
                                      "sergev_iwan", "general", NULL};

static const field fields[] = {
    {FIELD_AT(FIELD_CHOICE, request, report), .choices = reports, .flags = FIELD_DEFAULT,
     .help = "cases of one report's theory only; general: of the cable as it hangs"},
    {FIELD_AT(FIELD_NAME, request, family),
     .help = "families whose name begins so, with _ for what is no letter or digit: "
             "gale_table_B_3"},
    {FIELD_AT(FIELD_NAME, request, endpoint),
     .help = "endpoints whose path begins so, likewise: taut_modes"},
    {FIELD_AT(FIELD_FLAG, request, values), .flags = FIELD_DEFAULT,
     .help = "list every value compared, not only the failed ones"},
    {.kind = FIELD_END}};

static const schema validation_request = {
    .name = "validation_request", .fields = fields, .size = sizeof(request)};

/* Does `name`, with _ for all that is no letter or digit, begin with `start`? */
static bool begins(const char *name, const char *start)
{
    for (; *start; name++, start++) {
        const char c = isalnum((unsigned char)*name) ? *name : '_';
        if (!*name || c != *start)
            return false;
    }
    return true;
}

static bool chosen(const request *r, const validation_case *one)
{
    return (r->report == 0 || strcmp(one->report, reports[r->report]) == 0) &&
           begins(one->family, r->family.text) &&
           begins(one->path + strlen("/v1/"), r->endpoint.text);
}

static double cost(const void *request_)
{
    double us = CASE_US;
    for (const validation_case *one = validation_cases; one->report; one++)
        us += chosen(request_, one) ? CASE_US : 0;
    return us;
}

/* ---- one case ---- */

typedef struct outcome {
    strbuf rows;  /* what was compared, as items of a JSON list */
    strbuf fault; /* a sentence where there was nothing to compare */
    comparison compared;
    bool failed;    /* memory ran out */
    int unanswered; /* status of a refusal that is no fault of the case, so that there is
                       nothing to judge: out of memory, cancelled; or 0 */
} outcome;

static void outcome_clear(outcome *o)
{
    strbuf_clear(&o->rows);
    strbuf_clear(&o->fault);
}

/* A refusal was expected: with this status, at these places, neither more nor fewer. A place
 * may be named twice, as the request's root is where two groups are missing. */
static void judge_refusal(const cJSON *expect, const problem *p, outcome *o)
{
    const cJSON *status = cJSON_GetObjectItemCaseSensitive(expect, "status");
    const cJSON *errors = cJSON_GetObjectItemCaseSensitive(expect, "errors"), *pointer;
    o->compared.values = 1;
    if (p->status != (int)status->valuedouble) {
        strbuf_format(&o->fault, "status %d, expected %d", p->status, (int)status->valuedouble);
        return;
    }
    size_t named = 0;
    for (size_t i = 0; i < p->count; i++) {
        bool wanted = false;
        cJSON_ArrayForEach(pointer, errors) wanted |=
            strcmp(p->entries[i].pointer, pointer->valuestring) == 0;
        named += wanted;
    }
    cJSON_ArrayForEach(pointer, errors)
    {
        bool found = false;
        for (size_t i = 0; i < p->count; i++)
            found |= strcmp(p->entries[i].pointer, pointer->valuestring) == 0;
        if (!found && !o->fault.size)
            strbuf_format(&o->fault, "\"%s\" was not named", pointer->valuestring);
    }
    if (errors && named != p->count && !o->fault.size)
        strbuf_format(&o->fault, "%zu faults named, %zu of them expected", p->count, named);
}

static void judge_answer(const cJSON *expect, const strbuf *answered, const problem *p,
                         outcome *o)
{
    if (p->status) {
        strbuf_format(&o->fault, "refused with %d: %s", p->status, p->detail ? p->detail : "");
        return;
    }
    cJSON *document = cJSON_ParseWithLength(answered->data, answered->size);
    if (document == NULL) {
        o->failed = true;
        return;
    }
    json_writer rows = {.out = &o->rows};
    o->compared.rows = &rows;
    compare_answer(cJSON_GetObjectItemCaseSensitive(expect, "checks"), document, &o->compared);
    o->failed |= o->compared.failed;
    cJSON_Delete(document);
}

static void run_case(const validation_case *one, const answer *a, outcome *o)
{
    problem p = {0};
    strbuf answered = {0};
    observer w = {.cancel = a->cancel};
    cJSON *expect = cJSON_Parse(one->expect);
    const endpoint *e = mechanics_find(one->path);
    evaluation *asked = e ? evaluation_read(e, one->body, one->body_size, &limits, &p) : NULL;
    if (asked)
        evaluation_answer(asked, "", &w, &answered, &p);
    if (w.cancelled && a->observer != NULL)
        a->observer->cancelled = true;
    if (expect == NULL || p.failed)
        o->failed = true;
    else if (p.status >= 500)
        o->unanswered = p.status;
    else if (e == NULL)
        strbuf_format(&o->fault, "there is no %s", one->path);
    else if (cJSON_HasObjectItem(expect, "status"))
        judge_refusal(expect, &p, o);
    else
        judge_answer(expect, &answered, &p, o);
    o->failed |= o->fault.failed || o->rows.failed;
    evaluation_free(asked);
    cJSON_Delete(expect);
    strbuf_clear(&answered);
    problem_clear(&p);
}

/* ---- all of them ---- */

typedef struct tally {
    int64_t cases, passed, values;
} tally;

static void write_tally(json_writer *json, const tally *t)
{
    json_put_integer(json, "cases", t->cases);
    json_put_integer(json, "passed", t->passed);
    json_put_integer(json, "failed", t->cases - t->passed);
    json_put_integer(json, "values", t->values);
}

static void write_case(json_writer *json, const validation_case *one, const outcome *o,
                       bool good, bool values)
{
    json_open_object(json);
    json_put_string(json, "family", one->family);
    json_put_string(json, "case", one->id);
    json_put_string(json, "report", one->report);
    json_put_string(json, "endpoint", one->path);
    json_put_flag(json, "passed", good);
    json_put_integer(json, "values", (int64_t)o->compared.values);
    if (o->compared.worst_tolerance > 0) {
        json_put_number(json, "largest_difference", o->compared.worst_difference);
        json_put_number(json, "tolerance", o->compared.worst_tolerance);
    }
    if (o->fault.size)
        json_put_string(json, "fault", o->fault.data);
    json_put_string(json, "source", one->source);
    if (o->rows.size && (values || !good)) {
        json_key(json, "compared");
        json_open_array(json);
        json_raw(json, o->rows.data, o->rows.size);
        json_close_array(json);
    }
    json_close_object(json);
}

static void close_family(json_writer *json, const validation_case *one, const tally *t)
{
    json_open_object(json);
    json_put_string(json, "family", one->family);
    json_put_string(json, "report", one->report);
    write_tally(json, t);
    json_close_object(json);
}

/* Runs the chosen cases; false when cancelled or out of memory. */
static bool run_all(const request *r, answer *a, strbuf *cases, strbuf *families, tally *all)
{
    json_writer case_json = {.out = cases}, family_json = {.out = families};
    const validation_case *last = NULL;
    tally family = {0};
    for (const validation_case *one = validation_cases; one->report; one++) {
        if (!chosen(r, one))
            continue;
        if (answer_cancelled(a))
            return false;
        if (last && strcmp(last->family, one->family) != 0) {
            close_family(&family_json, last, &family);
            family = (tally){0};
        }
        last = one;
        outcome o = {0};
        run_case(one, a, &o);
        const bool good = !o.fault.size && o.compared.missed == 0 && o.compared.values > 0;
        write_case(&case_json, one, &o, good, r->values);
        const bool failed = o.failed;
        const int unanswered = o.unanswered;
        for (tally *t = all;; t = &family) {
            t->cases++;
            t->passed += good;
            t->values += (int64_t)o.compared.values;
            if (t == &family)
                break;
        }
        outcome_clear(&o);
        if (failed) {
            problem_out_of_memory(a->problem);
            return false;
        }
        if (unanswered != 0) {
            problem_set(a->problem, unanswered, "the case \"%s\" of %s found no answer",
                        one->id, one->family);
            return false;
        }
        answer_progress(a, all->cases, NAN, "cases");
    }
    if (last)
        close_family(&family_json, last, &family);
    return true;
}

static bool validate(const void *request_, answer *a)
{
    const request *r = request_;
    strbuf cases = {0}, families = {0};
    tally all = {0};
    bool good = run_all(r, a, &cases, &families, &all);
    if (good && all.cases == 0) {
        problem_set(a->problem, 422,
                    "no case is chosen: ask without family and endpoint for the "
                    "families there are");
        good = false;
    } else if (!good) {
        problem_set(a->problem, 503, "nobody waits for the answer any more");
    }
    if (good) {
        json_writer *json = a->result;
        a->theory =
            "every case by the way of a request; expected values from the sources named";
        json_open_object(json);
        json_key(json, "totals");
        json_open_object(json);
        write_tally(json, &all);
        json_close_object(json);
        json_key(json, "families");
        json_open_array(json);
        json_raw(json, families.data, families.size);
        json_close_array(json);
        json_key(json, "cases");
        json_open_array(json);
        json_raw(json, cases.data, cases.size);
        json_close_array(json);
        json_close_object(json);
        json->out->failed |= cases.failed || families.failed;
    }
    strbuf_clear(&cases);
    strbuf_clear(&families);
    return good;
}

const endpoint validation = {
    .path = "/v1/validation",
    .title = "Every printed and reference case, run live",
    .request = &validation_request,
    .query = true,
    .cost_us = cost,
    .answer = validate,
};
