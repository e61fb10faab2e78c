/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Numbers, out and in: the input's first eight bytes are a double to print, and all of it is a
 * text to read. The C library is the judge of both. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "json/read.h"
#include "json/write.h"

static void must(bool good, const char *what, const char *shown)
{
    if (good)
        return;
    fprintf(stderr, "fuzz: %s: %s\n", what, shown);
    abort();
}

static int digits_of(const char *number)
{
    int digits = 0, zeros = 0;
    for (; *number != '\0' && *number != 'e'; number++) {
        if (*number < '0' || *number > '9' || (digits == 0 && *number == '0'))
            continue;
        zeros = *number == '0' ? zeros + 1 : 0;
        digits++;
    }
    return digits - zeros;
}

/* Reads back as it was, and with no more digits than the nearest decimal that does. */
static void check_printing(double value)
{
    char printed[JSON_NUMBER_MAX + 1], other[64];
    const size_t size = json_print_double(value, printed);
    must(size < sizeof printed, "a number is too long", "");
    printed[size] = '\0';
    must(json_number_end(printed, printed + size) == printed + size, "not JSON", printed);
    must(strtod(printed, NULL) == value, "reads back changed", printed);
    int needed = 1;
    while (snprintf(other, sizeof other, "%.*e", needed - 1, value),
           strtod(other, NULL) != value)
        needed++;
    must(digits_of(printed) <= needed, "more digits than needed", printed);
}

static void check_reading(const char *bytes, size_t size)
{
    const json_limits limits = {.depth = 2, .values = 100};
    cJSON *document;
    problem p = {0};
    if (json_read(bytes, size, &limits, &document, &p)) {
        char copy[JSON_NUMBER_CHARACTERS + 1];
        if (cJSON_IsNumber(document) && size < sizeof copy) {
            memcpy(copy, bytes, size);
            copy[size] = '\0';
            must(document->valuedouble == strtod(copy, NULL), "read as another number", copy);
            must(isfinite(document->valuedouble), "read as no finite number", copy);
        }
        cJSON_Delete(document);
    } else {
        must(p.status == 400 || p.status == 413, "refused with a strange status", "");
    }
    problem_clear(&p);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    double value;
    if (size >= sizeof value) {
        memcpy(&value, data, sizeof value);
        if (isfinite(value))
            check_printing(value);
    }
    check_reading((const char *)data, size);
    return 0;
}
