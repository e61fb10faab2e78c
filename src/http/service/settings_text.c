/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Settings as text: --help, the manual page, --print-config. */
#include <inttypes.h>
#include <string.h>

#include "http/service/settings.h"
#include "http/service/settings_table.h"

static const struct {
    const char *flag, *help;
} program_flags[] = {
    {"--config FILE", "read settings from a file (also STRUM_CONFIG); # begins a comment line"},
    {"--check-config", "name every fault in the settings and exit"},
    {"--print-config", "print the settings in force, as a file, and exit"},
    {"--version", "print the version and exit"},
    {"--help", "print all settings and exit"},
    {"--help-man", "print the manual page and exit"},
};
#define PROGRAM_FLAGS (sizeof program_flags / sizeof *program_flags)

static void flag_of(const setting *row, char flag[64])
{
    snprintf(flag, 64, "--%s", row->name);
    for (char *c = flag; *c; c++)
        *c = *c == '_' ? '-' : *c;
}

static const char purpose[] = "Answers questions about cables as JSON over HTTP";
static const char rules[] =
    "Every setting can stand in a file (key = value), in the environment and among the\n"
    "flags; the later of these wins. A setting workers is the key workers, the variable\n"
    "STRUM_WORKERS and the flag --workers.";

/* "(default; minimum to maximum)" */
static void write_range(const setting *row, FILE *out)
{
    fprintf(out, "(%s", *row->fallback ? row->fallback : "empty");
    if (row->min < row->max && row->kind != SETTING_CHOICE)
        fprintf(out, "; %.15g to %.15g", row->min, row->max);
    fputs(")\n", out);
}

void settings_help(FILE *out)
{
    fprintf(out, "usage: strumd [--setting value]...\n\n%s.\n\n%s\n\n", purpose, rules);
    for (size_t i = 0; i < PROGRAM_FLAGS; i++)
        fprintf(out, "  %-16s %s\n", program_flags[i].flag, program_flags[i].help);
    fputs("\nsettings (default; range):\n", out);
    for (size_t i = 0; i < settings_rows; i++) {
        char flag[64];
        flag_of(&settings_table[i], flag);
        fprintf(out, "  %s ", flag);
        write_range(&settings_table[i], out);
        fprintf(out, "      %s\n", settings_table[i].help);
    }
}

/* A line of text as roff reads it back unchanged. */
static void write_roff(const char *text, FILE *out)
{
    for (; *text; text++) {
        if (*text == '-' || *text == '\\')
            fputs(*text == '-' ? "\\-" : "\\e", out);
        else
            fputc(*text, out);
    }
    fputc('\n', out);
}

void settings_man(const char *version, FILE *out)
{
    fprintf(out,
            ".TH STRUMD 8 \"\" \"strum %s\"\n.SH NAME\nstrumd \\- %s\n.SH SYNOPSIS\n.B strumd\n"
            "[\\fB\\-\\-\\fIsetting value\\fR]...\n.SH DESCRIPTION\n",
            version, purpose);
    write_roff(rules, out);
    for (size_t i = 0; i < PROGRAM_FLAGS; i++) {
        fputs(i ? ".TP\n.B " : ".SH OPTIONS\n.TP\n.B ", out);
        write_roff(program_flags[i].flag, out);
        write_roff(program_flags[i].help, out);
    }
    fputs(".SH SETTINGS\nEach with its default and its range.\n", out);
    for (size_t i = 0; i < settings_rows; i++) {
        char flag[64];
        flag_of(&settings_table[i], flag);
        fputs(".TP\n.B ", out);
        write_roff(flag, out);
        write_range(&settings_table[i], out);
        fputs(".br\n", out);
        write_roff(settings_table[i].help, out);
    }
    fputs(
        ".SH SIGNALS\n.TP\n.B SIGTERM, SIGINT\n"
        "refuse new connections and finish the requests under way; a second one ends at once\n"
        ".SH EXIT STATUS\n0 when every request was finished, 1 when it could not start or cut\n"
        "requests short, 2 when the settings have a fault.\n",
        out);
}

void settings_print(const settings *s, FILE *out)
{
    for (size_t i = 0; i < settings_rows; i++) {
        const void *place = (const char *)s + settings_table[i].offset;
        fprintf(out, "%s = ", settings_table[i].name);
        switch (settings_table[i].kind) {
        case SETTING_TEXT:
            fprintf(out, "%s\n", *(char *const *)place);
            break;
        case SETTING_FLAG:
            fprintf(out, "%s\n", *(const bool *)place ? "yes" : "no");
            break;
        case SETTING_NUMBER:
            fprintf(out, "%.17g\n", *(const double *)place);
            break;
        case SETTING_CHOICE:
            fprintf(out, "%s\n", settings_log_choices[*(const int64_t *)place]);
            break;
        default:
            fprintf(out, "%" PRId64 "\n", *(const int64_t *)place);
        }
    }
}
