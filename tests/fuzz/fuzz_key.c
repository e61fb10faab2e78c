/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Keys: what is taken for one is exactly 64 lower-case hexadecimal digits, and comes back. */
#include <stdlib.h>
#include <string.h>

#include "cache/key.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char *given = malloc(size + 1);
    if (given == NULL)
        return 0;
    memcpy(given, data, size);
    given[size] = '\0';
    const bool is_key = strlen(given) == 64 && strspn(given, "0123456789abcdef") == 64;
    cache_key key;
    char hex[KEY_HEX_SIZE];
    if (key_parse(given, &key) != is_key)
        abort();
    if (is_key) {
        key_hex(&key, hex);
        if (strcmp(hex, given) != 0)
            abort();
    }
    /* Cut anywhere, the same bytes are other parts, with another key. */
    cache_key whole, cut;
    const size_t at = size > 0 ? data[0] % size : 0;
    const key_part parts[] = {{given, at}, {given + at, size - at}};
    if (!key_of_parts(&(key_part){given, size}, 1, &whole) || !key_of_parts(parts, 2, &cut) ||
        memcmp(&whole, &cut, sizeof whole) == 0)
        abort();
    free(given);
    return 0;
}
