/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "endpoints/common/frequency.h"

#include <math.h>

/* ---- a band ---- */

bool band_given(const band_input *band)
{
    return band->rad_per_s.count + band->hertz.count + band->seconds.count > 0;
}

void band_read(const band_input *band, double ends[2])
{
    for (size_t i = 0; i < 2; i++)
        ends[i] = band->rad_per_s.count > 0 ? band->rad_per_s.items[i]
                  : band->hertz.count > 0   ? 2 * M_PI * band->hertz.items[i]
                  : band->seconds.count > 0 ? 2 * M_PI / band->seconds.items[1 - i]
                                            : 0;
}

const char *band_pointer(const band_input *band)
{
    return band->hertz.count > 0     ? "/band_Hz"
           : band->seconds.count > 0 ? "/band_s"
                                     : "/band_rad_per_s";
}

/* ---- a list ---- */

bool frequencies_read(const frequencies_input *list, schema_arena *arena, numbers_value *out)
{
    const numbers_value *given = list->hertz.count > 0       ? &list->hertz
                                 : list->rad_per_s.count > 0 ? &list->rad_per_s
                                                             : &list->seconds;
    *out = (numbers_value){0};
    if (given->count == 0)
        return true;
    out->items = schema_alloc(arena, given->count * sizeof *out->items);
    if (out->items == NULL)
        return false;
    out->count = given->count;
    for (size_t i = 0; i < given->count; i++)
        out->items[i] = given == &list->hertz       ? 2 * M_PI * given->items[i]
                        : given == &list->rad_per_s ? given->items[i]
                                                    : 2 * M_PI / given->items[i];
    return true;
}

const char *frequencies_pointer(const frequencies_input *list)
{
    return list->hertz.count > 0       ? "/frequencies_Hz"
           : list->rad_per_s.count > 0 ? "/angular_frequencies_rad_per_s"
           : list->seconds.count > 0   ? "/periods_s"
                                       : NULL;
}

/* ---- a range ---- */

void frequency_range_read(const frequency_range_input *range, double ends[2])
{
    ends[0] = ends[1] = 0;
    if (range->hertz_max > 0) {
        ends[0] = 2 * M_PI * range->hertz_min;
        ends[1] = 2 * M_PI * range->hertz_max;
    } else if (range->rad_per_s_max > 0) {
        ends[0] = range->rad_per_s_min;
        ends[1] = range->rad_per_s_max;
    } else if (range->seconds_max > 0) {
        ends[0] = 2 * M_PI / range->seconds_max;
        ends[1] = 2 * M_PI / range->seconds_min;
    }
}

const char *frequency_range_pointer(const frequency_range_input *range)
{
    return range->hertz_max > 0       ? "/frequency_max_Hz"
           : range->rad_per_s_max > 0 ? "/angular_frequency_max_rad_per_s"
           : range->seconds_max > 0   ? "/period_max_s"
                                      : NULL;
}
