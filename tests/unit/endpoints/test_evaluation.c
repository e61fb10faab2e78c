/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One asking from body or query to answer, also with every allocation failing in turn. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <strum/version.h>

#include "check.h"
#include "endpoints/endpoint.h"
#include "tables.h"
#include "validation/registry.h"

/* ---- allocations that fail: the linker sends malloc and its kin here ---- */

static long allocations, failing = -1; /* count, and number of the one that fails (-1: none) */

static bool refuse_memory(void)
{
    return allocations++ == failing;
}

#include "failing_memory.h"

/* ---- an endpoint ---- */

static void cable_prepare(void *request, schema_arena *arena, problem *p)
{
    cable_request *q = request;
    /* a default that follows from another field */
    if (!FIELD_GIVEN(&cable_schema, q, mass_kg_per_m)) {
        q->mass_kg_per_m = 2 * (double)q->modes;
        FIELD_GIVE(&cable_schema, q, mass_kg_per_m);
    }
    if (!FIELD_GIVEN(&cable_schema, q, chi)) {
        q->chi.items = schema_alloc(arena, 2 * sizeof(double));
        if (q->chi.items == NULL) {
            problem_out_of_memory(p);
            return;
        }
        q->chi.items[1] = q->gravity_m_per_s2;
        q->chi.count = 2;
        FIELD_GIVE(&cable_schema, q, chi);
    }
    if (q->xi_1 > q->xi_2)
        problem_add(p, "/xi_1", "must be less than xi_2");
}

static double cable_cost_us(const void *request)
{
    return (double)((const cable_request *)request)->modes;
}

static bool cable_answer(const void *request, answer *a)
{
    const cable_request *q = request;
    a->theory = "none \"at all\"";
    if (q->modes == 100) {
        problem_set(a->problem, 422, "no such cable: %s", "impossible");
        return false;
    }
    if (q->modes == 101)
        return false; /* and says nothing */
    if (answer_cancelled(a)) {
        problem_set(a->problem, 503, "cancelled");
        return false;
    }
    json_open_object(a->result);
    json_put_number(a->result, "x", q->modes == 102 ? NAN : 0.1);
    json_close_object(a->result);
    if (q->verify) {
        answer_warn(a, "first %d", 1);
        answer_warn(a, "second \"%s\"", "two");
    }
    return true;
}

static const endpoint cable_endpoint = {
    .path = "/v1/test/cable",
    .title = "a cable",
    .request = &cable_schema,
    .query = true,
    .prepare = cable_prepare,
    .cost_us = cable_cost_us,
    .answer = cable_answer,
};

static bool chain_answer(const void *request, answer *a)
{
    (void)request;
    answer_progress(a, 7, 0.5, "halfway");
    answer_progress(a, 8, NAN, NULL);
    a->transient = true;
    json_integer(a->result, 1);
    return true;
}

static const endpoint chain_endpoint = {
    .path = "/v1/test/chain",
    .title = "a chain",
    .request = &chain_schema,
    .variables = true,
    .cost_us = cable_cost_us,
    .answer = chain_answer,
};

static const json_limits limits = {.depth = 16, .values = 10000};

static evaluation *ask(const endpoint *e, const char *body, problem *p)
{
    return evaluation_read(e, body, strlen(body), &limits, p);
}

static void expect_refusal(const endpoint *e, const char *body, int status, const char *pointer,
                           const char *detail)
{
    problem p = {0};
    assert_null(ask(e, body, &p));
    assert_int_equal(p.status, status);
    assert_int_equal(p.count, 1);
    assert_string_equal(p.entries[0].pointer, pointer);
    assert_string_equal(p.entries[0].detail, detail);
    problem_clear(&p);
}

/* ---- tests ---- */

static void an_answer_has_four_parts(void **state)
{
    (void)state;
    problem p = {0};
    evaluation *a =
        ask(&cable_endpoint, "{\"xi_1\":0,\"xi_2\":1,\"modes\":3,\"verify\":true}", &p);
    assert_non_null(a);
    assert_true(evaluation_cost_us(a) == 3);
    strbuf out = {0};
    observer w = {.solve_us = -1, .transient = true};
    assert_true(evaluation_answer(a, "abc123", &w, &out, &p));
    assert_true(w.solve_us >= 0 && !w.transient);
    char numerics[STRUM_NUMERICS_SIZE];
    assert_int_equal(strum_numerics(numerics, NULL), STRUM_OK);
    assert_int_equal(strspn(numerics, "0123456789abcdef"), STRUM_NUMERICS_SIZE - 1);
    strbuf want = {0};
    strbuf_format(&want,
                  "{\"request\":{\"xi_1\":0,\"xi_2\":1,\"gravity_m_per_s2\":9.80665,"
                  "\"mass_kg_per_m\":6,\"flexibility\":0,\"plane\":\"both\",\"modes\":3,"
                  "\"verify\":true,\"chi\":[0,9.80665]},\"result\":{\"x\":0.1},\"warnings\":["
                  "\"first 1\",\"second \\\"two\\\"\"],\"meta\":{\"key\":\"abc123\",\"solver\":"
                  "\"strum %s\",\"solver_number\":%d,\"numerics\":\"%s\",\"theory\":\"none "
                  "\\\"at all\\\"\"}}",
                  strum_version(), strum_solver(), numerics);
    assert_string_equal(out.data, want.data);
    strbuf_clear(&want);
    strbuf_clear(&out);
    /* the same again: bodies are deterministic */
    assert_true(evaluation_answer(a, "abc123", NULL, &out, &p));
    assert_non_null(strstr(out.data, "\"result\":{\"x\":0.1}"));
    strbuf_clear(&out);
    evaluation_free(a);
}

/* One who looks on. */
typedef struct onlooker {
    observer observer;
    int told;
    progress last;
} onlooker;

static void look_on(observer *w, const progress *so_far)
{
    onlooker *o = (onlooker *)(void *)w;
    if (o->told++ == 0) {
        assert_int_equal(so_far->evaluations, 7);
        assert_true(so_far->best == 0.5);
        assert_string_equal(so_far->what, "halfway");
    }
    o->last = *so_far;
}

static void progress_and_transience_are_passed_on(void **state)
{
    (void)state;
    problem p = {0};
    evaluation *a = ask(&chain_endpoint,
                        "{\"tension_N\":5,\"components\":[{\"type\":\"cable\",\"length_m\":1,"
                        "\"mass_kg_per_m\":1}]}",
                        &p);
    if (a == NULL)
        fail_msg("%s", p.detail ? p.detail : p.entries[0].detail);
    onlooker o = {.observer.progress = look_on};
    strbuf out = {0};
    assert_true(evaluation_answer(a, "k", &o.observer, &out, &p));
    assert_int_equal(o.told, 2);
    assert_int_equal(o.last.evaluations, 8);
    assert_true(isnan(o.last.best) && o.last.what == NULL);
    assert_true(o.observer.transient);
    strbuf_clear(&out);
    /* nobody looks on: nothing to tell */
    assert_true(evaluation_answer(a, "k", NULL, &out, &p));
    strbuf_clear(&out);
    evaluation_free(a);
}

static void canonical_bytes_name_endpoint_and_solver(void **state)
{
    (void)state;
    problem p = {0};
    evaluation *body = ask(&cable_endpoint, "{\"modes\":3,\"xi_1\":-0.0,\"xi_2\":1.0}", &p);
    evaluation *query = evaluation_read_query(
        &cable_endpoint,
        (query_pair[]){{"xi_2", "1e0"}, {"xi_1", "0"}, {"modes", "3"}, {"plane", "both"}}, 4,
        &p);
    assert_non_null(body);
    assert_non_null(query);
    strbuf one = {0}, two = {0}, head = {0};
    evaluation_canonical(body, &one);
    evaluation_canonical(query, &two);
    assert_int_equal(one.size, two.size);
    assert_memory_equal(one.data, two.data, one.size);
    strbuf_format(&head, "/v1/test/cable%c1%c%s%c%d %s%c", 0, 0, strum_version(), 0,
                  strum_solver(), evaluation_numerics(), 0);
    /* then the first field that has a value: its name, its tag, +0 */
    strbuf_add(&head, "xi_1\0n\0\0\0\0\0\0\0\0", 14);
    assert_true(one.size > head.size);
    assert_memory_equal(one.data, head.data, head.size);
    strbuf_clear(&one);
    strbuf_clear(&two);
    strbuf_clear(&head);
    evaluation_free(body);
    evaluation_free(query);
    evaluation_free(NULL);
}

static void refusals_of_every_layer(void **state)
{
    (void)state;
    problem p = {0};
    assert_null(ask(&cable_endpoint, "{", &p));
    assert_int_equal(p.status, 400);
    problem_clear(&p);
    expect_refusal(&cable_endpoint, "{\"xi_1\":0,\"xi_2\":1,\"xi_1\":0}", 400, "/xi_1",
                   "given more than once");
    expect_refusal(&cable_endpoint, "{\"xi_1\":0,\"xi_2\":true}", 400, "/xi_2",
                   "expected a number, found true");
    expect_refusal(&cable_endpoint, "{\"xi_1\":2,\"xi_2\":1}", 400, "/xi_1",
                   "must be less than xi_2");
    expect_refusal(&cable_endpoint, "3", 400, "",
                   "expected an object with the fields of cable_request");
    assert_null(evaluation_read_query(&chain_endpoint, NULL, 0, &p));
    assert_int_equal(p.status, 405);
    problem_clear(&p);
    assert_null(evaluation_read_query(&cable_endpoint, (query_pair[]){{"xi_1", "1"}}, 1, &p));
    assert_int_equal(p.status, 400);
    problem_clear(&p);
}

static void expect_no_answer(const char *body, const _Atomic bool *cancel, int status,
                             const char *detail)
{
    problem p = {0};
    evaluation *a = ask(&cable_endpoint, body, &p);
    assert_non_null(a);
    strbuf out = {0};
    observer w = {.cancel = cancel};
    assert_false(evaluation_answer(a, "k", &w, &out, &p));
    assert_int_equal(p.status, status);
    assert_non_null(strstr(p.detail, detail));
    assert_null(out.data);
    problem_clear(&p);
    evaluation_free(a);
}

static void no_answer_says_why(void **state)
{
    (void)state;
    const _Atomic bool cancelled = true;
    expect_no_answer("{\"xi_1\":0,\"xi_2\":1,\"modes\":100}", NULL, 422, "impossible");
    expect_no_answer("{\"xi_1\":0,\"xi_2\":1,\"modes\":101}", NULL, 500, "no answer");
    expect_no_answer("{\"xi_1\":0,\"xi_2\":1,\"modes\":102}", NULL, 500, "not a finite number");
    expect_no_answer("{\"xi_1\":0,\"xi_2\":1}", &cancelled, 503, "cancelled");
}

static void endpoints_are_found_by_path(void **state)
{
    (void)state;
    for (int i = 0; endpoints[i] != NULL; i++)
        assert_ptr_equal(endpoint_find(endpoints[i]->path), endpoints[i]);
    assert_null(endpoint_find("/v1/no/such"));
    assert_null(endpoint_find(""));
}

/* ---- memory ---- */

/* The whole cycle, to the document a client would get; its status, 0 for an answer. A document
 * that could not be written whole is cleared (http has a fixed one then). */
static int cycle(const endpoint *e, const char *body, const query_pair *pairs, size_t count,
                 strbuf *document)
{
    problem p = {0};
    strbuf canonical = {0};
    evaluation *a =
        body != NULL ? ask(e, body, &p) : evaluation_read_query(e, pairs, count, &p);
    if (a != NULL) {
        assert_int_equal(p.status, 0);
        evaluation_canonical(a, &canonical);
        if (canonical.failed)
            problem_out_of_memory(&p);
        else
            (void)evaluation_answer(a, "key", NULL, document, &p);
    }
    const int status = p.status;
    assert_true((status == 0) == (document->data != NULL));
    if (status != 0)
        problem_write(&p, NULL, document);
    if (document->failed)
        strbuf_clear(document);
    strbuf_clear(&canonical);
    problem_clear(&p);
    evaluation_free(a);
    return status;
}

/* Fails each allocation in turn until none is left to fail: then the request is refused with
 * 500 or 503, or (where the failure hit the writing of a refusal, or memory that can be done
 * without) nothing but the right document is sent. */
static void fail_each(const endpoint *e, const char *body, const query_pair *pairs,
                      size_t count, int status, long at_least)
{
    long hits = 0, refusals = 0;
    strbuf right = {0};
    assert_int_equal(cycle(e, body, pairs, count, &right), status);
    assert_non_null(right.data);
    for (failing = 0;; failing++) {
        allocations = 0;
        strbuf got = {0};
        const int got_status = cycle(e, body, pairs, count, &got);
        if (allocations <= failing) {
            strbuf_clear(&got);
            break;
        }
        hits++;
        if (got_status == 500 || got_status == 503)
            refusals++;
        else if (got_status != status)
            fail_msg("allocation %ld failed, and the status was %d", failing, got_status);
        else if (got.data != NULL)
            assert_string_equal(got.data, right.data);
        strbuf_clear(&got);
    }
    failing = -1;
    if (refusals < at_least)
        fail_msg("only %ld of %ld failures were refused", refusals, hits);
    strbuf_clear(&right);
}

static const char chain_body[] =
    "{\"tension_N\":1000,\"components\":[{\"type\":\"cable\",\"length_m\":{\"variable\":\"x\"},"
    "\"mass_kg_per_m\":2},{\"type\":\"inline_absorber\",\"links\":[{\"left_m\":1,\"right_m\":2,"
    "\"mass_kg\":3},{\"left_m\":1,\"right_m\":2,\"mass_kg\":3}],\"joints\":[{}]}],"
    "\"variables\":[{\"name\":\"x\",\"min\":0,\"max\":50}],\"mode_numbers\":[3,4],"
    "\"angular_frequencies\":[1,{\"re\":2,\"im\":-0.5}],\"required\":{\"diameter_m\":0.02}}";

static const char faulty_body[] =
    "{\"tension\":1,\"components\":[{\"type\":\"cabel\"},{\"type\":\"cable\",\"tension_N\":1,"
    "\"tension_left_N\":2},{\"mass_kg\":\"3\"}],\"modes\":0,\"mode_numbers\":[0],"
    "\"band_rad_per_s\":[2,1]}";

static void every_allocation_may_fail(void **state)
{
    (void)state;
    /* cJSON takes its memory through the same gate */
    cJSON_Hooks hooks = {.malloc_fn = __wrap_malloc, .free_fn = free};
    cJSON_InitHooks(&hooks);
    fail_each(&cable_endpoint, "{\"xi_1\":0,\"xi_2\":1,\"verify\":true}", NULL, 0, 0, 12);
    fail_each(&chain_endpoint, chain_body, NULL, 0, 0, 70);
    fail_each(&chain_endpoint, faulty_body, NULL, 0, 400, 70);
    fail_each(&cable_endpoint, "{\"span_m\":1,\"xi_1\":2,\"xi_2\":true}", NULL, 0, 400, 10);
    fail_each(&cable_endpoint, "{\"a\":1,\"a\":2,\"b\":1e999}", NULL, 0, 400, 10);
    fail_each(&cable_endpoint, "{", NULL, 0, 400, 1);
    fail_each(&cable_endpoint, "{\"modes\":2}", NULL, 0, 400, 5);
    fail_each(&cable_endpoint, "{\"span_m\":2}", NULL, 0, 400, 5);
    fail_each(&cable_endpoint, "{\"xi_1\":2}", NULL, 0, 400, 5);
    fail_each(&cable_endpoint, "{\"xi_1\":0,\"xi_2\":1,\"modes\":100}", NULL, 0, 422, 10);
    char list[600] = "1";
    for (int i = 1; i < 4; i++) /* items longer than what a list usually holds */
        (void)snprintf(list + strlen(list), sizeof list - strlen(list), ",%d%0140d", i, 0);
    strbuf many = {0}; /* a list that needs more than the request's first piece of memory */
    strbuf_add_string(&many,
                      "{\"tension_N\":1,\"components\":[{\"type\":\"point_mass\",\"mass_kg\":"
                      "1}],\"mode_numbers\":[1");
    for (int i = 2; i < 600; i++)
        strbuf_format(&many, ",%d", i);
    strbuf_add_string(&many, "]}");
    fail_each(&chain_endpoint, many.data, NULL, 0, 0, 600);
    strbuf_clear(&many);
    const query_pair pairs[] = {
        {"xi_1", "0"}, {"xi_2", "1"}, {"chi", "1,2,3"}, {"plane", "both"}};
    fail_each(&cable_endpoint, NULL, pairs, 4, 0, 15);
    const query_pair faulty[] = {{"xi_1", "0"}, {"chi", list}, {"chi", "1"}, {"plan", list}};
    fail_each(&cable_endpoint, NULL, faulty, 4, 400, 15);
    cJSON_InitHooks(NULL);
}

/* The endpoints themselves, with the core below them. */
static void endpoints_survive_failing_memory(void **state)
{
    (void)state;
    const endpoint *e = endpoint_find("/v1/catenary/frequencies");
    assert_non_null(e);
    fail_each(e,
              "{\"span_m\":100,\"length_m\":110,\"mass_kg_per_m\":2,\"modes\":2,"
              "\"shape_points\":3,\"eta_normal\":0.5,\"verify\":true}",
              NULL, 0, 0, 20);
    fail_each(e, "{\"sag_parameter\":0.5,\"modes\":3,\"shape_points\":3,\"verify\":true}", NULL,
              0, 0, 20);
    fail_each(e, "{\"sag_parameter\":0.5,\"method\":\"rayleigh\",\"verify\":true}", NULL, 0, 0,
              20);
    fail_each(e,
              "{\"sag_parameter\":0.7,\"modes\":2,\"method\":\"series\",\"compare\":true,"
              "\"verify\":true}",
              NULL, 0, 0, 20);
    fail_each(e, "{\"span_m\":100,\"length_m\":90}", NULL, 0, 422, 5);
    e = endpoint_find("/v1/forced/tension");
    assert_non_null(e);
    /* an answer that comes all the same is the right one: both resonances are in it */
    fail_each(e,
              "{\"span_m\":100,\"length_m\":110,\"mass_kg_per_m\":2,\"frequency_ratio_min\":3,"
              "\"frequency_ratio_max\":6,\"points\":2}",
              NULL, 0, 0, 20);
    fail_each(e,
              "{\"sag_parameter\":0.8,\"frequency_ratios\":[0,1.1],\"profiles_at\":[1.1],"
              "\"profile_points\":3,\"verify\":true}",
              NULL, 0, 0, 20);
    fail_each(e,
              "{\"span_m\":100,\"length_m\":110,\"mass_kg_per_m\":2,\"eta_normal\":0.2,"
              "\"frequency_ratios\":[0.7],\"harmonics\":[{\"multiple\":1,\"tangential\":0.01},"
              "{\"multiple\":2,\"normal\":0.01}]}",
              NULL, 0, 0, 20);
    e = endpoint_find("/v1/inclined/modes");
    assert_non_null(e);
    fail_each(e,
              "{\"length_m\":100,\"tension_N\":9000,\"mass_kg_per_m\":2,\"inclination_deg\":20,"
              "\"axial_stiffness_N\":1e6,\"modes\":2,\"shape_points\":3,\"compare\":true,"
              "\"verify\":true}",
              NULL, 0, 0, 20);
    fail_each(e,
              "{\"epsilon\":0.2,\"inclination_deg\":0,\"lambda_squared\":38,\"modes\":2,"
              "\"model\":\"airy\",\"shape_points\":3,\"verify\":true}",
              NULL, 0, 0, 20);
    e = endpoint_find("/v1/taut/modes");
    assert_non_null(e);
#define CABLE "{\"type\":\"cable\",\"length_m\":9,\"mass_kg_per_m\":1}"
#define LINK  "{\"left_m\":0.1,\"right_m\":0.2,\"mass_kg\":3,\"inertia_kg_m2\":0.1}"
#define JOINT                                                                                  \
    "{\"spring_arm_m\":0.1,\"damper_arm_m\":0.1,\"stiffness_N_per_m\":1000,"                   \
    "\"damping_N_s_per_m\":50}"
    fail_each(e,
              "{\"tension_N\":100,\"components\":[" CABLE
              ",{\"type\":\"point_mass\",\"mass_kg\":2}," CABLE
              "],\"modes\":20,\"shape_points\":3,\"verify\":true}",
              NULL, 0, 0, 20);
    fail_each(e,
              "{\"tension_N\":100,\"components\":[" CABLE ",{\"type\":\"inline_absorber\","
              "\"links\":[" LINK "," LINK "," LINK "],\"joints\":[" JOINT "," JOINT "]}," CABLE
              "],\"modes\":4,\"shape_points\":3,\"verify\":true}",
              NULL, 0, 0, 20);
    fail_each(e,
              "{\"tension_N\":100,\"components\":[" CABLE ",{\"type\":\"damper\","
              "\"damping_N_s_per_m\":200}," CABLE
              "],\"band_rad_per_s\":[1,9],\"method\":\"muller\"}",
              NULL, 0, 0, 20);
    e = endpoint_find("/v1/taut/matrix");
    assert_non_null(e);
    fail_each(e,
              "{\"tension_N\":100,\"components\":[" CABLE ",{\"type\":\"bar\",\"length_m\":1,"
              "\"mass_kg\":2}],\"angular_frequencies\":[3,{\"re\":1,\"im\":2}]}",
              NULL, 0, 0, 15);
    e = endpoint_find("/v1/absorber/optimize");
    assert_non_null(e);
    fail_each(e,
              "{\"tension_N\":100,\"components\":[" CABLE ",{\"type\":\"damper\","
              "\"damping_N_s_per_m\":{\"variable\":\"c\"}}," CABLE "],\"variables\":[{"
              "\"name\":\"c\",\"min\":1,\"max\":100}],\"modes\":[1],\"max_evaluations\":100}",
              NULL, 0, 0, 20);
    e = endpoint_find("/v1/validation");
    assert_non_null(e);
    fail_each(e, "{\"family\":\"levesque_table_4_1\",\"values\":true}", NULL, 0, 0, 20);
}

/* A large object's names are compared in memory of their own. */
static void comparing_names_may_fail(void **state)
{
    (void)state;
    strbuf body = {0};
    strbuf_add_string(&body, "{");
    for (int i = 0; i < 40; i++)
        strbuf_format(&body, "\"m%d\":1,", i);
    strbuf_add_string(&body, "\"m0\":1}");
    fail_each(&cable_endpoint, body.data, NULL, 0, 400, 5);
    strbuf_clear(&body);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_answer_has_four_parts),
        cmocka_unit_test(progress_and_transience_are_passed_on),
        cmocka_unit_test(canonical_bytes_name_endpoint_and_solver),
        cmocka_unit_test(refusals_of_every_layer),
        cmocka_unit_test(no_answer_says_why),
        cmocka_unit_test(endpoints_are_found_by_path),
        cmocka_unit_test(every_allocation_may_fail),
        cmocka_unit_test(endpoints_survive_failing_memory),
        cmocka_unit_test(comparing_names_may_fail),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
