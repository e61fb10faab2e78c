/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>

#include <strum/strum.h>

#include "check.h"

static void every_code_has_a_text(void **state)
{
    (void)state;
#define CHECK_ENTRY(name, value, text)                                                         \
    assert_string_equal(strum_status_text(name), text);                                        \
    assert_int_equal(name, value);
    STRUM_STATUS_LIST(CHECK_ENTRY)
#undef CHECK_ENTRY
    assert_string_equal(strum_status_text((strum_status)-1000), "unknown status");
}

static void version_is_three_numbers(void **state)
{
    (void)state;
    int major, minor, patch, read = 0;
    assert_int_equal(sscanf(strum_version(), "%d.%d.%d%n", &major, &minor, &patch, &read), 3);
    assert_int_equal(read, (int)strlen(strum_version()));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_code_has_a_text),
        cmocka_unit_test(version_is_three_numbers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
