/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Frequencies as people have them: in Hz, in rad/s, or as a period in s. A table takes the rows of
 * a macro, a group for each of its words, and asks for rad/s. */
#ifndef ENDPOINTS_COMMON_FREQUENCY_H
#define ENDPOINTS_COMMON_FREQUENCY_H

#include "schema/schema.h"

/* The same rows in three units; `member` is of the type that the macro names. */
#define FREQUENCY_ROW(kind_, type, name_, place, unit_, min_, max_, flags_, help_)             \
    .name = (name_), .kind = (kind_), .offset = offsetof(type, place), .unit = (unit_),        \
    .min = (min_), .max = (max_), .flags = (flags_), .help = (help_)

/* Largest frequency (rad/s, Hz) and longest period (s). */
#define FREQUENCY_MOST 1e9
#define PERIOD_MOST    1e12

/* ---- a band ---- */

typedef struct band_input {
    numbers_value rad_per_s, hertz, seconds;
} band_input;
/* `least`: of rad/s and Hz, itself excluded where `flags` has FIELD_OPEN_MIN. */
#define BAND_FIELDS(type, member, least, flags_, help_)                                        \
    {FREQUENCY_ROW(FIELD_NUMBERS, type, "band_rad_per_s", member.rad_per_s, "rad/s", least,    \
                   FREQUENCY_MOST, FIELD_ASCENDING | (flags_), help_),                         \
     .min_items = 2, .max_items = 2},                                                          \
        {FREQUENCY_ROW(FIELD_NUMBERS, type, "band_Hz", member.hertz, "Hz", least,              \
                       FREQUENCY_MOST / 10, FIELD_ASCENDING | (flags_),                        \
                       "the band in Hz, in place of band_rad_per_s"),                          \
         .min_items = 2, .max_items = 2},                                                      \
    {                                                                                          \
        FREQUENCY_ROW(FIELD_NUMBERS, type, "band_s", member.seconds, "s", 1e-8, 1e9,           \
                      FIELD_ASCENDING,                                                         \
                      "the band by its shortest and longest period, in place of "              \
                      "band_rad_per_s"),                                                       \
            .min_items = 2, .max_items = 2                                                     \
    }

bool band_given(const band_input *band);
/* Lower and upper end in rad/s; both 0 where no band is given. */
void band_read(const band_input *band, double ends[2]);
/* Pointer to the row that gives it. */
const char *band_pointer(const band_input *band);

/* ---- a list ---- */

typedef struct frequencies_input {
    numbers_value hertz, rad_per_s, seconds;
} frequencies_input;
#define FREQUENCIES_FIELDS(type, member, most)                                                 \
    {FREQUENCY_ROW(FIELD_NUMBERS, type, "frequencies_Hz", member.hertz, "Hz", 0,               \
                   FREQUENCY_MOST / 10, 0, "frequencies in Hz"),                               \
     .min_items = 1, .max_items = (most)},                                                     \
        {FREQUENCY_ROW(FIELD_NUMBERS, type, "angular_frequencies_rad_per_s", member.rad_per_s, \
                       "rad/s", 0, FREQUENCY_MOST, 0, "frequencies in rad/s"),                 \
         .min_items = 1, .max_items = (most)},                                                 \
    {                                                                                          \
        FREQUENCY_ROW(FIELD_NUMBERS, type, "periods_s", member.seconds, "s", 0, PERIOD_MOST,   \
                      FIELD_OPEN_MIN, "frequencies by their periods"),                         \
            .min_items = 1, .max_items = (most)                                                \
    }

/* Rad/s of whichever list is given, in its order, in the arena; count 0 where none is. False
 * without memory. */
bool frequencies_read(const frequencies_input *list, schema_arena *arena, numbers_value *out);
/* Pointer to the list that is given; NULL where none is. */
const char *frequencies_pointer(const frequencies_input *list);

/* ---- a range ---- */

typedef struct frequency_range_input {
    double hertz_min, hertz_max, rad_per_s_min, rad_per_s_max, seconds_min, seconds_max;
} frequency_range_input;
#define FREQUENCY_RANGE_ROW(type, name_, place, unit_, most, flags_, help_)                    \
    {                                                                                          \
        FREQUENCY_ROW(FIELD_NUMBER, type, name_, place, unit_, 0, most, flags_, help_)         \
    }
#define FREQUENCY_RANGE_FIELDS(type, member)                                                   \
    FREQUENCY_RANGE_ROW(type, "frequency_min_Hz", member.hertz_min, "Hz", FREQUENCY_MOST / 10, \
                        0, "first frequency, in Hz"),                                          \
        FREQUENCY_RANGE_ROW(type, "frequency_max_Hz", member.hertz_max, "Hz",                  \
                            FREQUENCY_MOST / 10, FIELD_OPEN_MIN, "last frequency, in Hz"),     \
        FREQUENCY_RANGE_ROW(type, "angular_frequency_min_rad_per_s", member.rad_per_s_min,     \
                            "rad/s", FREQUENCY_MOST, 0, "first frequency, in rad/s"),          \
        FREQUENCY_RANGE_ROW(type, "angular_frequency_max_rad_per_s", member.rad_per_s_max,     \
                            "rad/s", FREQUENCY_MOST, FIELD_OPEN_MIN,                           \
                            "last frequency, in rad/s"),                                       \
        FREQUENCY_RANGE_ROW(type, "period_min_s", member.seconds_min, "s", PERIOD_MOST,        \
                            FIELD_OPEN_MIN, "shortest period: of the highest frequency"),      \
        FREQUENCY_RANGE_ROW(type, "period_max_s", member.seconds_max, "s", PERIOD_MOST,        \
                            FIELD_OPEN_MIN, "longest period: of the lowest frequency")
/* Groups of words for a field_groups table; `more` in each. */
#define FREQUENCY_RANGE_GROUPS(more)                                                           \
    "frequency_min_Hz frequency_max_Hz " more,                                                 \
        "angular_frequency_min_rad_per_s angular_frequency_max_rad_per_s " more,               \
        "period_min_s period_max_s " more
#define FREQUENCIES_GROUPS(more)                                                               \
    "frequencies_Hz" more, "angular_frequencies_rad_per_s" more, "periods_s" more

/* Lower and upper end in rad/s; both 0 where no range is given. */
void frequency_range_read(const frequency_range_input *range, double ends[2]);
/* Pointer to the row that gives the highest frequency; NULL where none does. A range whose ends
 * are exchanged is laid there too. */
const char *frequency_range_pointer(const frequency_range_input *range);

#endif
