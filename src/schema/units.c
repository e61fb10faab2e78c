/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "schema/units.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

typedef struct unit {
    const char *token;
    double factor;
    int metre, kilogram, second, radian;
} unit;

/* Exact by definition: inch, pound (international, 1959), standard gravity 9.80665 m/s^2. */
#define INCH       0.0254
#define POUND      0.45359237
#define KILOGRAM_F 9.80665

/* clang-format off */
static const unit units[] = {
    {"m", 1, 1, 0, 0, 0},         {"mm", 1e-3, 1, 0, 0, 0},     {"cm", 1e-2, 1, 0, 0, 0},
    {"km", 1e3, 1, 0, 0, 0},      {"in", INCH, 1, 0, 0, 0},     {"ft", 12 * INCH, 1, 0, 0, 0},
    {"m2", 1, 2, 0, 0, 0},        {"mm2", 1e-6, 2, 0, 0, 0},    {"m3", 1, 3, 0, 0, 0},
    {"ft3", 1728 * INCH * INCH * INCH, 3, 0, 0, 0},
    {"kg", 1, 0, 1, 0, 0},        {"g", 1e-3, 0, 1, 0, 0},      {"t", 1e3, 0, 1, 0, 0},
    {"lb", POUND, 0, 1, 0, 0},    {"lbm", POUND, 0, 1, 0, 0},
    {"slug", POUND * KILOGRAM_F / (12 * INCH), 0, 1, 0, 0},
    {"s", 1, 0, 0, 1, 0},         {"ms", 1e-3, 0, 0, 1, 0},     {"min", 60, 0, 0, 1, 0},
    {"s2", 1, 0, 0, 2, 0},        {"knots", 1852.0 / 3600, 1, 0, -1, 0},
    {"N", 1, 1, 1, -2, 0},        {"kN", 1e3, 1, 1, -2, 0},     {"MN", 1e6, 1, 1, -2, 0},
    {"kgf", KILOGRAM_F, 1, 1, -2, 0}, {"tf", 1e3 * KILOGRAM_F, 1, 1, -2, 0},
    {"lbf", POUND * KILOGRAM_F, 1, 1, -2, 0}, {"kip", 1e3 * POUND * KILOGRAM_F, 1, 1, -2, 0},
    {"Pa", 1, -1, 1, -2, 0},      {"kPa", 1e3, -1, 1, -2, 0},   {"MPa", 1e6, -1, 1, -2, 0},
    {"GPa", 1e9, -1, 1, -2, 0},   {"Nm2", 1, 3, 1, -2, 0},      {"Nm", 1, 2, 1, -2, 0},
    {"Hz", 2 * M_PI, 0, 0, -1, 1}, {"rpm", 2 * M_PI / 60, 0, 0, -1, 1},
    {"rad", 1, 0, 0, 0, 1},       {"deg", M_PI / 180, 0, 0, 0, 1},
    {"ratio", 1, 0, 0, 0, 0},     {"ratios", 1, 0, 0, 0, 0},    {"percent", 0.01, 0, 0, 0, 0},
};
/* clang-format on */

#define TOKENS_MAX 16

static const unit *unit_named(const char *token)
{
    for (size_t i = 0; i < sizeof units / sizeof *units; i++)
        if (strcmp(token, units[i].token) == 0)
            return &units[i];
    return NULL;
}

/* Tokens of a name and how many; 0 where it has too many. */
static size_t split(char *name, char *tokens[TOKENS_MAX])
{
    size_t count = 0;
    for (char *rest, *token = strtok_r(name, "_", &rest); token != NULL;
         token = strtok_r(NULL, "_", &rest)) {
        if (count == TOKENS_MAX)
            return 0;
        tokens[count++] = token;
    }
    return count;
}

static void append(char text[NAME_MAX_SIZE], const char *between, const char *what)
{
    const size_t length = strlen(text);
    (void)snprintf(text + length, NAME_MAX_SIZE - length, "%s%s", length > 0 ? between : "",
                   what);
}

static void multiply(name_unit *n, const unit *u, int sign)
{
    n->factor *= sign > 0 ? u->factor : 1 / u->factor;
    n->powers[0] += sign * u->metre;
    n->powers[1] += sign * u->kilogram;
    n->powers[2] += sign * u->second;
    n->powers[3] += sign * u->radian;
}

/* A unit is a run of unit tokens, with "per" between two of them; the last such run counts, and
 * never the first token, which is the quantity. "min" and "max" behind a unit are bounds. */
name_unit unit_of_name(const char *name)
{
    name_unit n = {.factor = 1};
    char copy[NAME_MAX_SIZE], *tokens[TOKENS_MAX];
    if (strlen(name) >= sizeof copy)
        return n;
    memcpy(copy, name, strlen(name) + 1);
    const size_t count = split(copy, tokens);
    size_t end = count;
    if (end > 2 && strcmp(tokens[end - 1], "min") == 0 && unit_named(tokens[end - 2]) != NULL)
        end--;
    while (end > 1 && unit_named(tokens[end - 1]) == NULL)
        end--;
    size_t begin = end;
    while (begin > 1 && (unit_named(tokens[begin - 1]) != NULL ||
                         (begin < end && begin > 2 && strcmp(tokens[begin - 1], "per") == 0)))
        begin--;
    if (begin < end &&
        (strcmp(tokens[begin], "per") == 0 || strcmp(tokens[begin - 1], "per") == 0))
        return n; /* mass_per_m: of what? */
    int sign = 1;
    for (size_t i = begin; i < end; i++) {
        const unit *u = unit_named(tokens[i]);
        if (u == NULL) {
            sign = -1;
            continue;
        }
        multiply(&n, u, sign);
        append(n.text, strcmp(tokens[i - 1], "per") == 0 ? "/" : " ", tokens[i]);
        n.known = true;
    }
    for (size_t i = 0; i < count; i++)
        if (i < begin || i >= end)
            append(n.quantity, "_", tokens[i]);
    return n;
}

bool same_dimension(const name_unit *a, const name_unit *b)
{
    return a->known && b->known && memcmp(a->powers, b->powers, sizeof a->powers) == 0;
}
