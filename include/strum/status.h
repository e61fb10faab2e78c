/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Status codes of libstrum and their texts, from one table.
 *
 * Every function of the library that can fail returns a strum_status: 0 is success, a negative
 * value an error. A function that can say more than the code takes a `strum_error *` (may be
 * NULL) and writes the reason there in a sentence a user can act on.
 */
#ifndef STRUM_STATUS_H
#define STRUM_STATUS_H

#ifdef __cplusplus
extern "C" {
#endif

/* ENTRY(name, value, text) */
#define STRUM_STATUS_LIST(ENTRY)                                                               \
    ENTRY(STRUM_OK, 0, "success")                                                              \
    ENTRY(STRUM_ERR_RANGE, -1, "an argument is outside its documented range")                  \
    ENTRY(STRUM_ERR_IMPOSSIBLE, -2, "no such cable can exist")                                 \
    ENTRY(STRUM_ERR_METHOD, -3, "the method does not apply to this cable")                     \
    ENTRY(STRUM_ERR_ACCURACY, -4,                                                              \
          "the promised accuracy was not reached within the size limit")                       \
    ENTRY(STRUM_ERR_MEMORY, -5, "out of memory")                                               \
    ENTRY(STRUM_ERR_CANCELLED, -6, "the computation was cancelled")                            \
    ENTRY(STRUM_ERR_INTERNAL, -7, "internal error")

typedef enum strum_status {
#define STRUM_STATUS_ENTRY(name, value, text) name = value,
    STRUM_STATUS_LIST(STRUM_STATUS_ENTRY)
#undef STRUM_STATUS_ENTRY
} strum_status;

/* Why a call failed. `reason` is NUL-terminated; empty when there is nothing to add to the
 * code's text. */
typedef struct strum_error {
    strum_status status;
    char reason[240];
} strum_error;

/* The text of a code; never NULL, owned by the library. */
const char *strum_status_text(strum_status status);

/* The library's version, "major.minor.patch". Answers may change only when it does. */
const char *strum_version(void);

#ifdef __cplusplus
}
#endif
#endif
