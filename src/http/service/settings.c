/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "http/service/settings.h"

#include <ctype.h>
#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "http/service/settings_table.h"
#include "schema/schema.h"

const char *const log_choices[] = {"none", "errors", "refusals", "all", NULL};

#define AT(member) offsetof(settings, member)
const setting settings_table[] = {
    {"listen", SETTING_TEXT, AT(listen), 0, 0, "127.0.0.1:8080",
     "address:port to listen on, [address]:port for IPv6; port 0 takes a free port and logs "
     "it; "
     "a socket passed by systemd or a parent (LISTEN_FDS) takes precedence"},
    {"allow_non_loopback", SETTING_FLAG, AT(allow_non_loopback), 0, 0, "no",
     "accept a listen address that other machines can reach even without token_file"},
    {"token_file", SETTING_TEXT, AT(token_file), 0, 0, "",
     "file of bearer tokens, one a line; every request except probes must carry one of them; "
     "read "
     "again at SIGHUP"},
    {"event_threads", SETTING_COUNT, AT(event_threads), 1, 64, "1",
     "threads that read requests and send answers"},
    {"workers", SETTING_COUNT, AT(workers), 0, 1024, "0",
     "threads that solve requests estimated to take inline_us or longer; 0: one for each core"},
    {"queue_depth", SETTING_COUNT, AT(queue_depth), 0, 100000, "0",
     "maximum number of requests that wait for a worker, cheap_us and others each; more get "
     "503; 0: 16 for each worker"},
    {"inline_us", SETTING_NUMBER, AT(inline_us), 0, 1e6, "250",
     "a request estimated to take fewer microseconds is solved at once, without a worker"},
    {"cheap_us", SETTING_NUMBER, AT(cheap_us), 0, 1e6, "2000",
     "a request estimated to take fewer microseconds is cheap: one more worker is kept for "
     "these; "
     "0: none is"},
    {"cache_bytes", SETTING_BYTES, AT(cache_bytes), 0, 1e12, "64M",
     "maximum memory for stored answers, their bookkeeping included; 0 stores none"},
    {"memory_bytes", SETTING_BYTES, AT(memory_bytes), 0, 1e15, "0",
     "maximum memory of requests under way, beside the cache: bodies, solves (estimated) and "
     "answers not sent yet; "
     "solves beyond it wait, then get 503; 0: half of the smallest memory.max of the control "
     "groups, or of the machine"},
    {"store", SETTING_TEXT, AT(store), 0, 0, "",
     "address:port or unix:/path of a Redis server, as a second level of stored answers that "
     "several daemons share; empty: none"},
    {"store_timeout_ms", SETTING_NUMBER, AT(store_timeout_ms), 1, 60000, "20",
     "maximum time (milliseconds) a worker waits for the store, connecting included; then it "
     "solves"},
    {"store_expiry_s", SETTING_COUNT, AT(store_expiry_s), 0, 1e9, "2592000",
     "seconds that the store keeps an answer; 0: no limit is set"},
    {"store_secret_file", SETTING_TEXT, AT(store_secret_file), 0, 0, "",
     "file of a secret that the daemons share, 16 characters or more, so that nobody else who "
     "can write to the store can forge an answer"},
    {"store_password_file", SETTING_TEXT, AT(store_password_file), 0, 0, "",
     "file of the store's password, which is sent unencrypted"},
    {"answer_bytes", SETTING_BYTES, AT(answer_bytes), 4096, 1 << 30, "16M",
     "maximum size of an answer, also of a batch's item; a request for a larger one gets 400, "
     "or "
     "422 where only solving tells"},
    {"body_bytes", SETTING_BYTES, AT(body_bytes), 256, 64 << 20, "64K",
     "maximum size of a request body; a larger one gets 413"},
    {"json_depth", SETTING_COUNT, AT(json_depth), 1, 256, "16",
     "maximum nesting depth of a request body"},
    {"json_values", SETTING_COUNT, AT(json_values), 1, 1e7, "20000",
     "maximum number of values in a request body"},
    {"batches", SETTING_COUNT, AT(batches), 0, 100000, "16",
     "maximum number of batches at once; more get 503"},
    {"batch_items", SETTING_COUNT, AT(batch_items), 1, 1e7, "10000",
     "maximum number of items of a batch; more get 413"},
    {"batch_body_bytes", SETTING_BYTES, AT(batch_body_bytes), 256, 1 << 30, "8M",
     "maximum size of the body of a batch; a larger one gets 413"},
    {"connections", SETTING_COUNT, AT(connections), 1, 1000000, "4096",
     "maximum number of connections at once; more wait unanswered"},
    {"connection_memory_bytes", SETTING_BYTES, AT(connection_memory_bytes), 4096, 1 << 20,
     "16K", "maximum memory for a request's line and headers; more gets 414 or 431"},
    {"idle_timeout_s", SETTING_NUMBER, AT(idle_timeout_s), 0.1, 3600, "15",
     "seconds without traffic before a connection is closed"},
    {"request_timeout_s", SETTING_NUMBER, AT(request_timeout_s), 0.1, 3600, "10",
     "maximum time (seconds) to receive a request and to send its answer, also for slow "
     "clients"},
    {"stream_bytes_per_s", SETTING_BYTES, AT(stream_bytes_per_s), 0, 1e15, "16K",
     "minimum rate at which the client of a batch or of an event stream reads what is ready, on "
     "average and after request_timeout_s; a slower one is cut; 0: any"},
    {"solve_timeout_s", SETTING_NUMBER, AT(solve_timeout_s), 0.1, 86400, "60",
     "maximum time (seconds) to wait for an answer and solve it; then 503"},
    {"drain_timeout_s", SETTING_NUMBER, AT(drain_timeout_s), 0, 3600, "30",
     "maximum time (seconds) to finish the requests under way after SIGTERM or SIGINT"},
    {"retry_after_s", SETTING_COUNT, AT(retry_after_s), 0, 3600, "1",
     "minimum of the seconds named in Retry-After with 503, which follow from the queue"},
    {"cors_origins", SETTING_TEXT, AT(cors_origins), 0, 0, "",
     "origins whose pages may ask and read answers: a comma-separated list, or *; pages of "
     "others get "
     "403"},
    {"allowed_hosts", SETTING_TEXT, AT(allowed_hosts), 0, 0, "",
     "names, without a port, by which requests may ask for this daemon in Host: a "
     "comma-separated "
     "list, or *; on loopback localhost, 127.0.0.0/8 and [::1] always may, and others only if "
     "they "
     "stand here (a proxy passes its own name on); elsewhere an empty list allows every name"},
    {"log_requests", SETTING_CHOICE, AT(log_requests), 0, LOG_ALL, "errors",
     "requests to log: none, errors (5xx), refusals (4xx and 5xx) or all"},
    {"log_sample", SETTING_COUNT, AT(log_sample), 1, 1e9, "1",
     "one successful request in this number is logged; errors and refusals always are"},
};
#define ROWS (sizeof settings_table / sizeof *settings_table)
const size_t settings_rows = ROWS;

/* ---- one value ---- */

static bool read_flag(const char *value, bool *flag)
{
    static const char *const words[] = {"no", "false", "off", "0", "yes", "true", "on", "1"};
    for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
        if (strcmp(value, words[i]) == 0) {
            *flag = i >= 4;
            return true;
        }
    }
    return false;
}

static bool read_number(const char *value, bool suffix, double *number)
{
    char *end;
    /* strtod would also take signs, blanks, hexadecimal, inf and nan. */
    if ((!isdigit((unsigned char)*value) && *value != '.') || strpbrk(value, "xX"))
        return false;
    *number = strtod(value, &end);
    if (suffix && *end) {
        static const char units[] = "KMG";
        const char *unit = strchr(units, toupper((unsigned char)*end));
        if (!unit)
            return false;
        *number *= (double)(INT64_C(1024) << (10 * (unit - units)));
        end++;
        if (strcmp(end, "iB") == 0)
            end += 2;
    }
    return *end == '\0' && isfinite(*number);
}

static void fault_of(const setting *row, const char *value, const char *source, strbuf *faults)
{
    switch (row->kind) {
    case SETTING_FLAG:
        strbuf_format(faults, "%s: %s must be yes or no, not \"%s\"\n", source, row->name,
                      value);
        break;
    case SETTING_CHOICE:
        strbuf_format(faults, "%s: %s must be one of", source, row->name);
        for (size_t i = 0; log_choices[i]; i++)
            strbuf_format(faults, "%s %s", i ? "," : "", log_choices[i]);
        strbuf_format(faults, ", not \"%s\"\n", value);
        break;
    default:
        strbuf_format(faults, "%s: %s must be %s from %.15g to %.15g%s, not \"%s\"\n", source,
                      row->name, row->kind == SETTING_NUMBER ? "a number" : "a whole number",
                      row->min, row->max,
                      row->kind == SETTING_BYTES ? " (K, M or G may follow)" : "", value);
    }
}

static void set(settings *s, const setting *row, const char *value, const char *source,
                strbuf *faults)
{
    void *place = (char *)s + row->offset;
    double number = 0;
    bool good = true;
    switch (row->kind) {
    case SETTING_TEXT: {
        char *copy = strdup(value);
        if (!copy) {
            strbuf_format(faults, "%s: out of memory\n", source);
            return;
        }
        free(*(char **)place);
        *(char **)place = copy;
        break;
    }
    case SETTING_FLAG:
        good = read_flag(value, place);
        break;
    case SETTING_CHOICE:
        good = false;
        for (size_t i = 0; log_choices[i]; i++) {
            if (strcmp(value, log_choices[i]) == 0) {
                *(int64_t *)place = (int64_t)i;
                good = true;
            }
        }
        break;
    default:
        good = read_number(value, row->kind == SETTING_BYTES, &number) && number >= row->min &&
               number <= row->max;
        if (row->kind == SETTING_NUMBER && good)
            *(double *)place = number;
        else if (good && (good = number == floor(number)))
            *(int64_t *)place = (int64_t)number;
    }
    if (!good)
        fault_of(row, value, source, faults);
}

/* ---- names ---- */

/* Writes a name as in the table: lower case, "_" for "-". */
static void plain_name(const char *name, size_t size, char plain[64])
{
    size_t i = 0;
    for (; i < size && i < 63; i++)
        plain[i] = name[i] == '-' ? '_' : (char)tolower((unsigned char)name[i]);
    plain[i] = '\0';
}

static const setting *known(const char *plain)
{
    for (size_t i = 0; i < ROWS; i++)
        if (strcmp(settings_table[i].name, plain) == 0)
            return &settings_table[i];
    return NULL;
}

static const setting *find(const char *plain, const char *source, const char *given,
                           strbuf *faults)
{
    const setting *row = known(plain);
    if (row)
        return row;
    nearest near = {.wanted = plain};
    for (size_t i = 0; i < ROWS; i++)
        nearest_try(&near, settings_table[i].name);
    strbuf_format(faults, "%s: unknown setting \"%s\"", source, given);
    if (near.name)
        strbuf_format(faults, "; did you mean %s?", near.name);
    strbuf_add_string(faults, "\n");
    return NULL;
}

/* ---- the sources ---- */

static char *trim(char *line)
{
    while (isspace((unsigned char)*line))
        line++;
    char *end = line + strlen(line);
    while (end > line && isspace((unsigned char)end[-1]))
        end--;
    *end = '\0';
    return line;
}

static void read_file(settings *s, const char *path, strbuf *faults)
{
    FILE *file = fopen(path, "re");
    if (!file) {
        strbuf_format(faults, "%s: %s\n", path, strerror(errno));
        return;
    }
    char *line = NULL;
    size_t room = 0;
    for (int number = 1; getline(&line, &room, file) >= 0; number++) {
        char source[512], plain[64];
        snprintf(source, sizeof source, "%s:%d", path, number);
        char *key = trim(line);
        if (*key == '\0' || *key == '#')
            continue;
        char *equals = strchr(key, '=');
        if (!equals) {
            strbuf_format(faults, "%s: expected \"key = value\", not \"%s\"\n", source, key);
            continue;
        }
        *equals = '\0';
        key = trim(key);
        plain_name(key, strlen(key), plain);
        const setting *row = find(plain, source, key, faults);
        if (row)
            set(s, row, trim(equals + 1), source, faults);
    }
    if (ferror(file))
        strbuf_format(faults, "%s: %s\n", path, strerror(errno));
    free(line);
    fclose(file);
}

#define ENVIRONMENT_PREFIX "STRUM_"

/* Whether `plain` has the word `word`, at its beginning or after "_", and at its end or before "_".
 */
static bool has_word(const char *plain, const char *word)
{
    const size_t size = strlen(word);
    for (const char *at = strstr(plain, word); at; at = strstr(at + 1, word))
        if ((at == plain || at[-1] == '_') && (at[size] == '\0' || at[size] == '_'))
            return true;
    return false;
}

/* For each service of its namespace Kubernetes sets NAME_SERVICE_HOST, NAME_SERVICE_PORT...,
 * NAME_PORT and NAME_PORT_80_TCP...: those named strum or strum-store get our prefix. */
static bool is_of_cluster(const char *plain)
{
    return has_word(plain, "service_host") || has_word(plain, "service_port") ||
           has_word(plain, "port");
}

static void read_environment(settings *s, char *const environment[], strbuf *faults)
{
    const size_t prefix = sizeof ENVIRONMENT_PREFIX - 1;
    for (char *const *variable = environment; *variable; variable++) {
        const char *equals = strchr(*variable, '=');
        if (strncmp(*variable, ENVIRONMENT_PREFIX, prefix) != 0 || !equals)
            continue;
        char plain[64], name[96];
        snprintf(name, sizeof name, "%.*s", (int)(equals - *variable), *variable);
        plain_name(name + prefix, strlen(name + prefix), plain);
        if (strcmp(plain, "config") == 0 || (!known(plain) && is_of_cluster(plain)))
            continue;
        const setting *row = find(plain, "environment", name, faults);
        if (row)
            set(s, row, equals + 1, name, faults);
    }
}

static bool action_of(const char *flag, settings_action *action)
{
    static const struct {
        const char *flag;
        settings_action action;
    } actions[] = {{"--help", SETTINGS_HELP},          {"-h", SETTINGS_HELP},
                   {"--help-man", SETTINGS_MAN},       {"--version", SETTINGS_VERSION},
                   {"--print-config", SETTINGS_PRINT}, {"--check-config", SETTINGS_CHECK}};
    for (size_t i = 0; i < sizeof actions / sizeof *actions; i++) {
        if (strcmp(flag, actions[i].flag) == 0) {
            *action = actions[i].action;
            return true;
        }
    }
    return false;
}

/* Returns the value of flag i: after "=", or the next argument (*i moves on); NULL if there is
 * none. */
static const char *flag_value(int argc, char *const argv[], int *i, bool alone)
{
    const char *equals = strchr(argv[*i], '=');
    if (equals)
        return equals + 1;
    if (alone)
        return "yes";
    return *i + 1 < argc ? argv[++*i] : NULL;
}

static bool is_config_flag(const char *flag)
{
    return strcmp(flag, "--config") == 0 || strncmp(flag, "--config=", 9) == 0;
}

static const char *config_path(int argc, char *const argv[], char *const environment[])
{
    const char *path = NULL;
    for (char *const *variable = environment; *variable; variable++)
        if (strncmp(*variable, ENVIRONMENT_PREFIX "CONFIG=", 13) == 0)
            path = *variable + 13;
    for (int i = 1; i < argc; i++)
        if (is_config_flag(argv[i]))
            path = flag_value(argc, argv, &i, false);
    return path;
}

static void read_flags(settings *s, int argc, char *const argv[], settings_action *action,
                       strbuf *faults)
{
    for (int i = 1; i < argc; i++) {
        const char *flag = argv[i];
        char name[64], plain[64];
        if (action_of(flag, action))
            continue;
        if (strncmp(flag, "--", 2) != 0) {
            strbuf_format(faults, "flags: unexpected \"%s\"\n", flag);
            continue;
        }
        snprintf(name, sizeof name, "%.*s", (int)strcspn(flag, "="), flag);
        plain_name(name + 2, strlen(name + 2), plain);
        const bool config = is_config_flag(flag);
        const setting *row = config ? NULL : find(plain, "flags", name, faults);
        if (!row && !config)
            continue;
        const char *value = flag_value(argc, argv, &i, row && row->kind == SETTING_FLAG);
        if (!value)
            strbuf_format(faults, "flags: %s needs a value\n", name);
        else if (row)
            set(s, row, value, name, faults);
    }
}

bool settings_read(settings *s, int argc, char *const argv[], char *const environment[],
                   settings_action *action, strbuf *faults)
{
    *s = (settings){0};
    *action = SETTINGS_RUN;
    for (size_t i = 0; i < ROWS; i++)
        set(s, &settings_table[i], settings_table[i].fallback, "default", faults);
    const char *path = config_path(argc, argv, environment);
    if (path)
        read_file(s, path, faults);
    read_environment(s, environment, faults);
    read_flags(s, argc, argv, action, faults);
    return faults->size == 0 && !faults->failed;
}

void settings_clear(settings *s)
{
    for (size_t i = 0; i < ROWS; i++)
        if (settings_table[i].kind == SETTING_TEXT)
            free(*(char **)((char *)s + settings_table[i].offset));
    *s = (settings){0};
}
