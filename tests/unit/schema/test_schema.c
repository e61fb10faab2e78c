/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The schema engine: what it fills, what it refuses and how it says so. */
#include <string.h>

#include "check.h"
#include "tables.h"

static const json_limits limits = {.depth = 16, .values = 10000};

/* Reads `json` by a table; false with the faults in p. */
static void *read_json(const schema *s, bool variables, const char *json, schema_arena **arena,
                       problem *p)
{
    cJSON *document;
    assert_true(json_read(json, strlen(json), &limits, &document, p));
    void *request = schema_read(s, document, variables, arena, p);
    cJSON_Delete(document);
    return request;
}

/* The faults as "pointer: detail" lines. */
static void expect_faults(const schema *s, bool variables, const char *json, const char *lines)
{
    schema_arena *arena;
    problem p = {0};
    assert_null(read_json(s, variables, json, &arena, &p));
    assert_null(arena);
    assert_int_equal(p.status, 400);
    strbuf got = {0};
    for (size_t i = 0; i < p.count; i++)
        strbuf_format(&got, "%s: %s\n", p.entries[i].pointer, p.entries[i].detail);
    assert_false(got.failed);
    assert_string_equal(got.data, lines);
    strbuf_clear(&got);
    problem_clear(&p);
}

static void expect_echo(const schema *s, bool variables, const char *json, const char *echo)
{
    schema_arena *arena;
    problem p = {0};
    void *request = read_json(s, variables, json, &arena, &p);
    if (request == NULL)
        fail_msg("%s: %s: %s", json, p.count > 0 ? p.entries[0].pointer : "",
                 p.count > 0 ? p.entries[0].detail : p.detail);
    strbuf out = {0};
    json_writer writer = {.out = &out};
    schema_echo(s, request, &writer);
    assert_false(out.failed);
    assert_string_equal(out.data, echo);
    strbuf_clear(&out);
    schema_free(arena);
}

/* ---- what is filled ---- */

static void defaults_follow_the_group(void **state)
{
    (void)state;
    expect_echo(&cable_schema, false, "{\"sag_parameter\": 5e-1}",
                "{\"rise_to_span\":0,\"sag_parameter\":0.5,\"gravity_m_per_s2\":9.80665,"
                "\"flexibility\":0,\"plane\":\"both\",\"modes\":6,\"verify\":false}");
    /* rise_m belongs to the group of span_m, rise_to_span does not; axial_stiffness_N ends
     * flexibility's default. */
    expect_echo(&cable_schema, false,
                "{\"length_m\": 110, \"span_m\": 100.0, \"axial_stiffness_N\": 1E7, "
                "\"plane\": \"in_plane\", \"modes\": 1e1, \"verify\": true, \"chi\": [-1, 2]}",
                "{\"span_m\":100,\"rise_m\":0,\"length_m\":110,\"gravity_m_per_s2\":9.80665,"
                "\"axial_stiffness_N\":10000000,\"plane\":\"in_plane\",\"modes\":10,"
                "\"verify\":true,\"chi\":[-1,2]}");
    expect_echo(&cable_schema, false,
                "{\"unstretched_length_m\": 99, \"span_m\": 100, \"axial_stiffness_N\": 1e7, "
                "\"mass_kg_per_m\": 2, \"rise_m\": -0.0}",
                "{\"span_m\":100,\"rise_m\":0,\"unstretched_length_m\":99,"
                "\"gravity_m_per_s2\":9.80665,\"mass_kg_per_m\":2,"
                "\"axial_stiffness_N\":10000000,\"plane\":\"both\",\"modes\":6,"
                "\"verify\":false}");
}

static void struct_holds_what_was_given(void **state)
{
    (void)state;
    schema_arena *arena;
    problem p = {0};
    cable_request *q = read_json(&cable_schema, false,
                                 "{\"xi_1\": -0.25, \"xi_2\": 3, \"modes\": 200, "
                                 "\"plane\": \"out_of_plane\", \"chi\": [0, 0.5, 20]}",
                                 &arena, &p);
    assert_non_null(q);
    assert_true(q->xi_1 == -0.25 && q->xi_2 == 3);
    assert_true(q->gravity_m_per_s2 == 9.80665);
    assert_int_equal(q->modes, 200);
    assert_int_equal(q->plane, 1);
    assert_int_equal(q->chi.count, 3);
    assert_true(q->chi.items[1] == 0.5 && q->chi.items[2] == 20);
    assert_true(FIELD_GIVEN(&cable_schema, q, xi_1));
    assert_true(FIELD_GIVEN(&cable_schema, q, flexibility));
    assert_false(FIELD_GIVEN(&cable_schema, q, span_m));
    assert_true(FIELD_GIVEN(&cable_schema, q, xi_1));
    assert_false(FIELD_GIVEN(&cable_schema, q, span_m));
    FIELD_GIVE(&cable_schema, q, span_m);
    assert_true(FIELD_GIVEN(&cable_schema, q, span_m));
    void *more = schema_alloc(arena, 100000);
    assert_non_null(more);
    memset(more, 1, 100000);
    schema_free(arena);
}

static const char chain_json[] =
    "{\"tension_N\": 1000, \"components\": ["
    "{\"type\": \"cable\", \"length_m\": {\"variable\": \"x\"}, \"mass_kg_per_m\": 2},"
    "{\"mass_kg\": 5, \"type\": \"point_mass\"},"
    "{\"type\": \"inline_absorber\", \"links\": [{\"left_m\": 1, \"right_m\": 2, \"mass_kg\": "
    "3},"
    " {\"left_m\": 0.5, \"right_m\": 0.25, \"mass_kg\": 0}], \"joints\": "
    "[{\"damping_N_s_per_m\": "
    "{\"variable\": \"R\"}}]},"
    "{\"type\": \"cable\", \"length_m\": {\"variable\": \"x\", \"scale\": -1, \"offset\": 50}, "
    "\"mass_kg_per_m\": 2, \"tension_left_N\": 900, \"tension_right_N\": 1000}],"
    "\"variables\": [{\"name\": \"x\", \"min\": 0, \"max\": 50}, {\"name\": \"R\", \"min\": 1, "
    "\"max\": 1e4}],"
    "\"mode_numbers\": [3, 4], \"angular_frequencies\": [1, {\"re\": 2, \"im\": -0.5}],"
    "\"required\": {\"diameter_m\": 0.02}}";

static void nested_requests_are_echoed(void **state)
{
    (void)state;
    expect_echo(
        &chain_schema, true, chain_json,
        "{\"tension_N\":1000,\"components\":["
        "{\"type\":\"cable\",\"length_m\":{\"variable\":\"x\",\"scale\":1,\"offset\":0},"
        "\"mass_kg_per_m\":2},"
        "{\"type\":\"point_mass\",\"mass_kg\":5},"
        "{\"type\":\"inline_absorber\",\"links\":[{\"left_m\":1,\"right_m\":2,\"mass_kg\":3},"
        "{\"left_m\":0.5,\"right_m\":0.25,\"mass_kg\":0}],\"joints\":[{\"damping_N_s_per_m\":"
        "{\"variable\":\"R\",\"scale\":1,\"offset\":0},\"stiffness_N_per_m\":0}]},"
        "{\"type\":\"cable\",\"length_m\":{\"variable\":\"x\",\"scale\":-1,\"offset\":50},"
        "\"mass_kg_per_m\":2,\"tension_left_N\":900,\"tension_right_N\":1000}],"
        "\"variables\":[{\"name\":\"x\",\"min\":0,\"max\":50},{\"name\":\"R\",\"min\":1,"
        "\"max\":10000}],\"mode_numbers\":[3,4],"
        "\"angular_frequencies\":[{\"re\":1,\"im\":0},{\"re\":2,\"im\":-0.5}],"
        "\"required\":{\"strouhal\":0.2,\"diameter_m\":0.02}}");
    /* No modes named: the group that needs nothing; a damper that is infinite, and by default
     */
    expect_echo(
        &chain_schema, false,
        "{\"tension_N\": 1, \"components\": [{\"type\": \"inline_absorber\", \"links\": "
        "[{\"left_m\": 1, \"right_m\": 1, \"mass_kg\": 1}, {\"left_m\": 1, \"right_m\": "
        "1, \"mass_kg\": 1}], \"joints\": [{\"damping_N_s_per_m\": \"infinite\"}, {}]}]}",
        "{\"tension_N\":1,\"components\":[{\"type\":\"inline_absorber\",\"links\":["
        "{\"left_m\":1,\"right_m\":1,\"mass_kg\":1},{\"left_m\":1,\"right_m\":1,"
        "\"mass_kg\":1}],\"joints\":[{\"damping_N_s_per_m\":\"infinite\","
        "\"stiffness_N_per_m\":0},{\"damping_N_s_per_m\":\"infinite\","
        "\"stiffness_N_per_m\":0}]}],\"modes\":10,\"first_mode\":1}");
}

static void nested_structs_hold_what_was_given(void **state)
{
    (void)state;
    schema_arena *arena;
    problem p = {0};
    chain_request *q = read_json(&chain_schema, true, chain_json, &arena, &p);
    assert_non_null(q);
    assert_int_equal(q->components.count, 4);
    const object_item *items = q->components.items;
    assert_string_equal(parts[items[3].variant].type, "cable");
    const part_cable *cable = items[3].object;
    assert_string_equal(cable->length_m.name.text, "x");
    assert_true(cable->length_m.scale == -1 && cable->length_m.value == 50);
    assert_string_equal(cable->mass_kg_per_m.name.text, "");
    assert_true(cable->mass_kg_per_m.value == 2 && cable->mass_kg_per_m.scale == 1);
    assert_true(FIELD_GIVEN(&part_cable_schema, cable, tension_left_N));
    assert_false(FIELD_GIVEN(&part_cable_schema, cable, tension_N));
    const part_absorber *absorber = items[2].object;
    assert_int_equal(absorber->links.count, 2);
    assert_true(((const part_link *)absorber->links.items)[1].right_m.value == 0.25);
    assert_true(creal(q->angular_frequencies.items[1]) == 2 &&
                cimag(q->angular_frequencies.items[1]) == -0.5);
    assert_true(q->required.strouhal == 0.2);
    schema_free(arena);
}

/* ---- what is refused ---- */

static void every_fault_is_named_at_once(void **state)
{
    (void)state;
    expect_faults(
        &cable_schema, false,
        "{\"sag_parameter\": 1, \"modes\": 2.5, \"plane\": \"inplane\", \"verify\": 1, "
        "\"gravity_m_per_s2\": -9.8, \"mass_kg_per_m\": \"2\", \"chi\": [1, true, 21], "
        "\"flexibility\": null}",
        "/sag_parameter: must be greater than 0 and less than 1, found 1\n"
        "/modes: expected a whole number, found 2.5\n"
        "/plane: expected one of \"in_plane\", \"out_of_plane\", \"both\", found the "
        "string \"inplane\"; did you mean \"in_plane\"?\n"
        "/verify: expected true or false, found 1\n"
        "/gravity_m_per_s2: must be greater than 0 m/s2 and at most 1000 m/s2, found "
        "-9.8\n"
        "/mass_kg_per_m: expected a number, found the string \"2\"\n"
        "/chi/1: expected a number, found true\n"
        "/chi/2: must be at least -20 and at most 20, found 21\n"
        "/flexibility: expected a number, found null\n");
    expect_faults(&cable_schema, false,
                  "{\"sag_parameter\": 0.5, \"modes\": 201, \"chi\": [1, 1], \"plane\": 3, "
                  "\"verify\": \"yes\"}",
                  "/modes: must be at least 1 and at most 200, found 201\n"
                  "/chi/1: must be greater than the item before it\n"
                  "/plane: expected one of \"in_plane\", \"out_of_plane\", \"both\", found 3\n"
                  "/verify: expected true or false, found the string \"yes\"\n");
    expect_faults(&cable_schema, false, "{\"sag_parameter\": 0.5, \"chi\": []}",
                  "/chi: expected at least 1 and at most 4 items, found 0\n");
    expect_faults(&cable_schema, false,
                  "{\"sag_parameter\": 0.5, \"chi\": 1, \"modes\": 1e300}",
                  "/chi: expected a list, found 1\n"
                  "/modes: expected a whole number, found 1e+300\n");
    expect_faults(&cable_schema, false, "[]",
                  ": expected an object with the fields of cable_request\n");
}

static void unknown_fields_get_a_suggestion(void **state)
{
    (void)state;
    expect_faults(&cable_schema, false,
                  "{\"sag_parameter\": 0.5, \"span\": 1, \"mode\": 2, \"Flexibility\": 0, "
                  "\"mass_per_m\": 2, \"colour\": 1, \"a~b/c\": 1, \"\": 0}",
                  "/span: unknown field; did you mean span_m?\n"
                  "/mode: unknown field; did you mean modes?\n"
                  "/Flexibility: unknown field; did you mean flexibility?\n"
                  "/mass_per_m: unknown field; did you mean mass_kg_per_m?\n"
                  "/colour: unknown field\n"
                  "/a~0b~1c: unknown field\n"
                  "/: unknown field\n");
}

#define GEOMETRIES                                                                             \
    "(1) sag_parameter, optionally rise_to_span; (2) xi_1, xi_2; (3) span_m, length_m, "       \
    "optionally rise_m; (4) span_m, unstretched_length_m, optionally rise_m, with "            \
    "mass_kg_per_m, axial_stiffness_N"

static void groups_are_explained(void **state)
{
    (void)state;
    expect_faults(&cable_schema, false, "{}",
                  ": the geometry is missing; give one of " GEOMETRIES "\n");
    /* mass and stiffness go with any geometry: they choose none */
    expect_faults(&cable_schema, false, "{\"axial_stiffness_N\": 1, \"mass_kg_per_m\": 1}",
                  ": the geometry is missing; give one of " GEOMETRIES "\n");
    expect_faults(
        &cable_schema, false, "{\"sag_parameter\": 0.5, \"xi_1\": 0, \"xi_2\": 1}",
        "/sag_parameter: cannot stand beside xi_1, xi_2: give the geometry by only one "
        "of " GEOMETRIES "\n");
    expect_faults(&cable_schema, false, "{\"xi_2\": 1}",
                  "/xi_1: missing: the geometry by xi_2 needs it\n");
    expect_faults(&cable_schema, false, "{\"span_m\": 1}",
                  ": the geometry is incomplete with span_m alone; give one of (1) span_m, "
                  "length_m, optionally rise_m; (2) span_m, unstretched_length_m, optionally "
                  "rise_m, with mass_kg_per_m, axial_stiffness_N\n");
    expect_faults(&cable_schema, false, "{\"span_m\": 1, \"unstretched_length_m\": 2}",
                  "/mass_kg_per_m: missing: the geometry by span_m, unstretched_length_m needs "
                  "it\n"
                  "/axial_stiffness_N: missing: the geometry by span_m, unstretched_length_m "
                  "needs it\n");
    expect_faults(&cable_schema, false,
                  "{\"sag_parameter\": 0.5, \"flexibility\": 0, \"axial_stiffness_N\": 1}",
                  "/axial_stiffness_N: cannot stand beside flexibility: give the elasticity by "
                  "only one of (1) flexibility; (2) axial_stiffness_N\n");
    /* A field of the wrong type still says which group was meant. */
    expect_faults(&cable_schema, false, "{\"sag_parameter\": \"half\"}",
                  "/sag_parameter: expected a number, found the string \"half\"\n");
}

static void nested_faults_carry_full_pointers(void **state)
{
    (void)state;
    expect_faults(
        &chain_schema, false,
        "{\"components\": [{\"type\": \"cabel\"}, {\"length_m\": 1}, 7, {\"type\": "
        "\"point_mass\", \"mass_kg\": -1, \"typ\": 0}, {\"type\": \"cable\", \"length_m\": "
        "{\"variable\": \"x\"}, \"tension_N\": 1, \"tension_left_N\": 2}, {\"type\": "
        "\"inline_absorber\", \"links\": [{\"left_m\": 1, \"right_m\": 1}], \"joints\": "
        "[{\"damping_N_s_per_m\": \"infinity\"}]}], \"mode_numbers\": [1.5], \"modes\": 3}",
        "/components/0/type: expected one of cable, point_mass, inline_absorber, found the "
        "string \"cabel\"; did you mean \"cable\"?\n"
        "/components/1/type: missing: one of cable, point_mass, inline_absorber\n"
        "/components/2: expected an object with a type, found 7\n"
        "/components/3/mass_kg: must be at least 0 kg and at most 1000000000 kg, found -1\n"
        "/components/3/typ: unknown field; did you mean type?\n"
        "/components/4/length_m: expected a number; this endpoint takes no variables\n"
        "/components/4/tension_left_N: cannot stand beside tension_N: give the tension by only "
        "one of (1) tension_N; (2) tension_left_N, tension_right_N\n"
        "/components/4/mass_kg_per_m: missing: mass per length\n"
        "/components/5/links: expected at least 2 and at most 8 items, found 1\n"
        "/components/5/joints/0/damping_N_s_per_m: expected a number or \"infinite\", found "
        "the "
        "string \"infinity\"\n"
        "/mode_numbers/0: expected a whole number, found 1.5\n"
        "/mode_numbers: cannot stand beside modes: give the choice of modes by only one of (1) "
        "modes, first_mode; (2) mode_numbers; (3) band_rad_per_s, optionally "
        "max_decay_per_s\n"
        "/tension_N: missing: tension\n");
    expect_faults(
        &chain_schema, true,
        "{\"tension_N\": 1, \"components\": [{\"type\": \"cable\", \"length_m\": "
        "{\"variable\": "
        "\"2x\", \"factor\": 1}, \"mass_kg_per_m\": {\"scale\": 2}}], \"angular_frequencies\": "
        "[1, {\"re\": 1}, \"i\", {\"re\": 2e9, \"im\": 0}], \"variables\": [{\"name\": \"\", "
        "\"min\": 0, \"max\": 1}], \"band_rad_per_s\": [2, 1], \"required\": {}}",
        "/components/0/length_m/variable: expected a name of at most 63 letters, digits and "
        "underscores, a letter or underscore first, found the string \"2x\"\n"
        "/components/0/length_m/factor: unknown field\n"
        "/components/0/mass_kg_per_m/variable: missing: name of the variable\n"
        "/angular_frequencies/1/im: missing: imaginary part\n"
        "/angular_frequencies/2: expected a number or an object with re and im, found the "
        "string "
        "\"i\"\n"
        "/angular_frequencies/3: real and imaginary part must be at most 1000000000 in "
        "magnitude\n"
        "/variables/0/name: expected a name of at most 63 letters, digits and underscores, a "
        "letter or underscore first, found the string \"\"\n"
        "/band_rad_per_s/1: must be greater than the item before it\n"
        "/required/diameter_m: missing: diameter\n");
}

static void endless_faults_are_counted(void **state)
{
    (void)state;
    strbuf body = {0};
    strbuf_add_string(&body, "{\"sag_parameter\":0.5");
    for (int i = 0; i < 5000; i++)
        strbuf_format(&body, ",\"unknown_%d\":1", i);
    strbuf_add_string(&body, "}");
    schema_arena *arena;
    problem p = {0};
    assert_null(read_json(&cable_schema, false, body.data, &arena, &p));
    assert_int_equal(p.count, PROBLEM_ENTRIES_MAX);
    assert_int_equal(p.count + p.omitted, 5000);
    strbuf_clear(&body);
    problem_clear(&p);
}

/* ---- query strings ---- */

static void expect_query(const query_pair *pairs, size_t count, const char *json)
{
    schema_arena *arena, *other;
    problem p = {0};
    void *by_query = schema_read_query(&cable_schema, pairs, count, &arena, &p);
    assert_non_null(by_query);
    void *by_body = read_json(&cable_schema, false, json, &other, &p);
    assert_non_null(by_body);
    strbuf one = {0}, two = {0};
    schema_canonical(&cable_schema, by_query, &one);
    schema_canonical(&cable_schema, by_body, &two);
    assert_false(one.failed || two.failed);
    assert_int_equal(one.size, two.size);
    assert_memory_equal(one.data, two.data, one.size);
    strbuf_clear(&one);
    strbuf_clear(&two);
    schema_free(arena);
    schema_free(other);
}

static void query_is_the_same_request(void **state)
{
    (void)state;
    expect_query((query_pair[]){{"sag_parameter", "0.5"},
                                {"chi", "-1,0,2.5e0"},
                                {"verify", "true"},
                                {"plane", "both"},
                                {"modes", "6"}},
                 5, "{\"chi\": [-1, 0, 2.5], \"verify\": true, \"sag_parameter\": 0.5}");
    expect_query((query_pair[]){{"verify", "True"}, {"sag_parameter", "0.5"}}, 2,
                 "{\"verify\": true, \"sag_parameter\": 0.5}");
    /* a list may be named again: it goes on */
    expect_query(
        (query_pair[]){
            {"chi", "-1"}, {"sag_parameter", "0.5"}, {"chi", "0,1"}, {"chi", "2.5e0"}},
        4, "{\"chi\": [-1, 0, 1, 2.5], \"sag_parameter\": 0.5}");
    expect_query((query_pair[]){{"xi_1", "-1e-1"}, {"xi_2", "3"}, {"verify", "false"}}, 3,
                 "{\"xi_1\": -0.1, \"xi_2\": 3.0}");
}

static void expect_query_faults(const query_pair *pairs, size_t count, const schema *s,
                                const char *lines)
{
    schema_arena *arena;
    problem p = {0};
    assert_null(schema_read_query(s, pairs, count, &arena, &p));
    assert_int_equal(p.status, 400);
    strbuf got = {0};
    for (size_t i = 0; i < p.count; i++)
        strbuf_format(&got, "%s: %s\n", p.entries[i].pointer, p.entries[i].detail);
    assert_string_equal(got.data, lines);
    strbuf_clear(&got);
    problem_clear(&p);
}

static const field span_fields[] = {{.name = "span_m",
                                     .kind = FIELD_NUMBER,
                                     .offset = sizeof(field_set),
                                     .min = -1e9,
                                     .max = 1e9},
                                    {.kind = FIELD_END}};
static const schema span_schema = {
    .name = "span", .fields = span_fields, .size = sizeof(field_set) + sizeof(double)};

/* As other programs write numbers, and as + arrives that was not escaped. */
static void query_numbers_may_be_spelt_otherwise(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        double value;
    } numbers[] = {
        {"3e6", 3e6},
        {"+3E+6", 3e6},
        {" 3e 6", 3e6},
        {".5", 0.5},
        {"5.", 5},
        {"007", 7},
        {"+.5e-1", 0.05},
        {"5.e2", 500},
        {"12e0", 12},
        {"0.10000000000000000000000000000000000000000000000000000000000000000001", 0.1}};
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++) {
        const query_pair pair = {"span_m", numbers[i].text};
        problem p = {0};
        schema_arena *arena = NULL;
        const char *span = schema_read_query(&span_schema, &pair, 1, &arena, &p);
        double value;
        assert_non_null(span);
        memcpy(&value, span + sizeof(field_set), sizeof value);
        assert_true(value == numbers[i].value);
        schema_free(arena);
        problem_clear(&p);
    }
    static const char *const none[] = {"",    ".",   "+",   "e5",  "1e", "1e+",
                                       "--1", "1 2", "0x1", "inf", "1f"};
    for (size_t i = 0; i < sizeof none / sizeof none[0]; i++) {
        const query_pair pair = {"span_m", none[i]};
        problem p = {0};
        schema_arena *arena = NULL;
        assert_null(schema_read_query(&span_schema, &pair, 1, &arena, &p));
        problem_clear(&p);
    }
}

static void query_faults_are_named(void **state)
{
    (void)state;
    const query_pair pairs[] = {
        {"sag_parameter", "0.5 "},
        {"xi_1", "1,5"},
        {"mass_kg_per_m", "0x10"},
        {"flexibility", "1e400"},
        {"verify", "yes"},
        {"chi", "1,,2"},
        {"modes", ""},
        {"span", "1"},
        {"modes", "3"},
        {"plane", "both "},
        {"flexibility", "1"},
    };
    expect_query_faults(
        pairs, sizeof pairs / sizeof pairs[0], &cable_schema,
        "/modes: given more than once\n"
        "/flexibility: given more than once\n"
        "/sag_parameter: expected a number, found the string \"0.5 \"\n"
        "/xi_1: expected a number, found the string \"1,5\"\n"
        "/mass_kg_per_m: expected a number, found the string \"0x10\"\n"
        "/flexibility: expected a number, found a number too large for a double\n"
        "/verify: expected true or false, found the string \"yes\"\n"
        "/chi/1: expected a number, found the string \"\"\n"
        "/modes: expected a whole number, found the string \"\"\n"
        "/span: unknown field; did you mean span_m?\n"
        "/plane: expected one of \"in_plane\", \"out_of_plane\", \"both\", found the string "
        "\"both \"; did you mean \"both\"?\n"
        "/xi_1: cannot stand beside sag_parameter: give the geometry by only one of " GEOMETRIES
        "\n");
    expect_query_faults((query_pair[]){{"components", "1"}, {"tension_N", "1"}}, 2,
                        &chain_schema,
                        "/components: cannot be given in a query string: send JSON by POST\n"
                        "/components: missing: from left to right\n");
}

/* ---- what a request owns ---- */

void *__real_calloc(size_t count, size_t size);
void *__wrap_calloc(size_t count, size_t size);
static bool memory_is_out;

void *__wrap_calloc(size_t count, size_t size)
{
    return memory_is_out ? NULL : __real_calloc(count, size);
}

static char destroyed[8];

static void destroy(void *object)
{
    strncat(destroyed, object, sizeof destroyed - strlen(destroyed) - 1);
}

static void objects_end_with_the_request(void **state)
{
    (void)state;
    schema_arena *arena;
    problem p = {0};
    assert_non_null(read_json(&cable_schema, false, "{\"sag_parameter\": 0.5}", &arena, &p));
    char a[] = "a", b[] = "b", c[] = "c", d[] = "d";
    assert_true(schema_arena_own(arena, a, destroy));
    assert_non_null(schema_alloc(arena, 10000)); /* a chunk of its own, and full */
    assert_true(schema_arena_own(arena, b, destroy));
    assert_true(schema_arena_own(arena, c, destroy));
    assert_non_null(schema_alloc(arena, 10000));
    assert_string_equal(destroyed, "");
    memory_is_out = true;
    assert_false(schema_arena_own(arena, d, destroy));
    memory_is_out = false;
    assert_string_equal(destroyed, "d");
    schema_free(arena);
    assert_string_equal(destroyed, "dcba");
}

/* ---- canonical form ---- */

static strbuf canonical_of(const schema *s, const char *json)
{
    schema_arena *arena;
    problem p = {0};
    void *request = read_json(s, true, json, &arena, &p);
    assert_non_null(request);
    strbuf out = {0};
    schema_canonical(s, request, &out);
    assert_false(out.failed);
    schema_free(arena);
    return out;
}

static void expect_same(const schema *s, const char *one, const char *two, bool same)
{
    strbuf a = canonical_of(s, one), b = canonical_of(s, two);
    const bool equal = a.size == b.size && memcmp(a.data, b.data, a.size) == 0;
    if (equal != same)
        fail_msg("%s and %s: %s", one, two, equal ? "equal" : "different");
    strbuf_clear(&a);
    strbuf_clear(&b);
}

static void equal_requests_have_equal_bytes(void **state)
{
    (void)state;
    const schema *s = &cable_schema;
    expect_same(s, "{\"sag_parameter\": 0.5, \"modes\": 6}",
                "{ \"modes\" : 6.0, \"rise_to_span\": -0.0, \"sag_parameter\":5E-1, "
                "\"plane\":\"both\"}",
                true);
    expect_same(s, "{\"sag_parameter\": 0.5}", "{\"sag_parameter\": 0.50000000000000011}",
                false);
    expect_same(s, "{\"sag_parameter\": 0.5}", "{\"sag_parameter\": 0.5, \"modes\": 7}", false);
    expect_same(s, "{\"sag_parameter\": 0.5}", "{\"sag_parameter\": 0.5, \"verify\": true}",
                false);
    expect_same(s, "{\"sag_parameter\": 0.5, \"plane\": \"in_plane\"}",
                "{\"sag_parameter\": 0.5, \"plane\": \"out_of_plane\"}", false);
    /* the same numbers under other names */
    expect_same(s, "{\"span_m\": 1, \"length_m\": 2}",
                "{\"span_m\": 1, \"unstretched_length_m\": 2, \"axial_stiffness_N\": 1, "
                "\"mass_kg_per_m\": 1}",
                false);
    expect_same(s, "{\"sag_parameter\": 0.5, \"chi\": [1, 2]}",
                "{\"sag_parameter\": 0.5, \"chi\": [1]}", false);
    const schema *c = &chain_schema;
#define CHAIN(part) "{\"tension_N\": 1, \"components\": [" part "]}"
    expect_same(c, CHAIN("{\"type\": \"cable\", \"length_m\": 1, \"mass_kg_per_m\": 2}"),
                CHAIN("{\"mass_kg_per_m\": 2.0, \"length_m\": 1, \"type\": \"cable\"}"), true);
    expect_same(
        c, CHAIN("{\"type\": \"cable\", \"length_m\": 1, \"mass_kg_per_m\": 2}"),
        CHAIN("{\"type\": \"cable\", \"length_m\": 1, \"mass_kg_per_m\": {\"variable\": "
              "\"m\", \"offset\": 2}}"),
        false);
    expect_same(
        c,
        CHAIN("{\"type\": \"cable\", \"length_m\": 1, \"mass_kg_per_m\": {\"variable\": "
              "\"m\"}}"),
        CHAIN("{\"type\": \"cable\", \"length_m\": 1, \"mass_kg_per_m\": {\"offset\": 0, "
              "\"scale\": 1e0, \"variable\": \"m\"}}"),
        true);
    expect_same(c, CHAIN("{\"type\": \"point_mass\", \"mass_kg\": 1}"),
                CHAIN("{\"type\": \"point_mass\", \"mass_kg\": 1}, {\"type\": \"point_mass\", "
                      "\"mass_kg\": 1}"),
                false);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(defaults_follow_the_group),
        cmocka_unit_test(struct_holds_what_was_given),
        cmocka_unit_test(nested_requests_are_echoed),
        cmocka_unit_test(nested_structs_hold_what_was_given),
        cmocka_unit_test(every_fault_is_named_at_once),
        cmocka_unit_test(unknown_fields_get_a_suggestion),
        cmocka_unit_test(groups_are_explained),
        cmocka_unit_test(nested_faults_carry_full_pointers),
        cmocka_unit_test(endless_faults_are_counted),
        cmocka_unit_test(query_is_the_same_request),
        cmocka_unit_test(query_faults_are_named),
        cmocka_unit_test(query_numbers_may_be_spelt_otherwise),
        cmocka_unit_test(objects_end_with_the_request),
        cmocka_unit_test(equal_requests_have_equal_bytes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
