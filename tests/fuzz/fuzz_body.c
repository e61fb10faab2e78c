/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A request's body: reader, schema engine, every endpoint and its mechanics. */

#include "evaluation_check.h"
#include "mutate.h"

int LLVMFuzzerInitialize(int *argc, char ***argv);
int LLVMFuzzerInitialize(int *argc, char ***argv)
{
    (void)argc;
    (void)argv;
    return 0;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    const endpoint *e = take_endpoint(&data, &size);
    problem p = {0};
    check_asking(e, evaluation_read(e, (const char *)data, size, &limits, &p), &p);
    return 0;
}
