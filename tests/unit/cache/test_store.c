/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The shared store: whatever a server says, lies and silence included, an answer is the right
 * one or there is none. */
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <strum/version.h>

#include "cache/store.h"

#include "check.h"

/* ---- allocations that fail: the linker leads them here (meson.build) ---- */

#define NEVER 1000000
static atomic_long allocations, fails_at = NEVER;
static atomic_bool and_all_after;

static bool refuse_memory(void)
{
    const long number = atomic_fetch_add(&allocations, 1);
    return and_all_after ? number >= fails_at : number == fails_at;
}

#include "failing_memory.h"

/* ---- a server that does as it is told: one connection at a time, one value ---- */

typedef enum manner {
    HONEST,
    OTHER_VALUE, /* the reply to GET is `lie`, as a value */
    OTHER_REPLY, /* the reply is `lie`, as it stands */
    LAST_WORDS,  /* the same, and the connection is closed */
    SILENT,
    DRIPPING, /* a value that is always about to end */
} manner;

static struct {
    char path[64], folder[32];
    int listening;
    pthread_t thread;
    atomic_int manner, connections, commands;
    char name[256], value[1 << 16], lie[1 << 16]; /* read and written between commands only */
    size_t name_size, value_size, lie_size;
    char expiry[32];
} fake;

/* A reply that makes an end of the connection orders nothing in ThreadSanitizer's eyes. */
static pthread_mutex_t lying = PTHREAD_MUTEX_INITIALIZER;

typedef struct word {
    const char *bytes;
    size_t size;
} word;

/* The words of a command that is there as a whole; 0: it is not yet. */
static size_t split(const char *got, size_t size, word words[8])
{
    const char *end = got + size;
    char *at;
    if (size < 4 || *got != '*')
        return 0;
    const size_t count = strtoul(got + 1, &at, 10);
    assert_true(count <= 8);
    for (size_t i = 0; i < count; i++) {
        at += 2;
        if (at >= end || *at != '$' || !memchr(at, '\n', (size_t)(end - at)))
            return 0;
        words[i].size = strtoul(at + 1, &at, 10);
        words[i].bytes = at + 2;
        at += 2 + words[i].size;
        if (at + 2 > end)
            return 0;
    }
    return count;
}

static bool is(const word *w, const char *string)
{
    return w->size == strlen(string) && memcmp(w->bytes, string, w->size) == 0;
}

static void tell(int fd, const void *bytes, size_t size)
{
    (void)!send(fd, bytes, size, MSG_NOSIGNAL);
}

static void tell_value(int fd, const char *value, size_t size)
{
    char head[32];
    tell(fd, head, (size_t)snprintf(head, sizeof head, "$%zu\r\n", size));
    tell(fd, value, size);
    tell(fd, "\r\n", 2);
}

static void set_value(const word *words, size_t count)
{
    memcpy(fake.name, words[1].bytes, fake.name_size = words[1].size);
    memcpy(fake.value, words[2].bytes, fake.value_size = words[2].size);
    snprintf(fake.expiry, sizeof fake.expiry, "%.*s", count == 5 ? (int)words[4].size : 0,
             count == 5 ? words[4].bytes : "");
}

/* False: the connection ends. */
static bool reply(int fd, const word *words, size_t count)
{
    char byte;
    atomic_fetch_add(&fake.commands, 1);
    if (fake.manner == SILENT)
        return recv(fd, &byte, 1, 0) > 0;
    if (fake.manner == DRIPPING) {
        tell(fd, "$60000\r\n", 8);
        while (send(fd, "x", 1, MSG_NOSIGNAL) == 1)
            usleep(5000);
        return false;
    }
    if (fake.manner == OTHER_REPLY || fake.manner == LAST_WORDS) {
        pthread_mutex_lock(&lying);
        tell(fd, fake.lie, fake.lie_size);
        pthread_mutex_unlock(&lying);
        return fake.manner == OTHER_REPLY;
    }
    if (is(&words[0], "SET")) {
        set_value(words, count);
        tell(fd, "+OK\r\n", 5);
    } else if (is(&words[0], "AUTH")) {
        const bool right = is(&words[1], "a secret of ours");
        tell(fd, right ? "+OK\r\n" : "-ERR\r\n", right ? 5 : 6);
    } else if (fake.manner == OTHER_VALUE) {
        tell_value(fd, fake.lie, fake.lie_size);
    } else if (words[1].size == fake.name_size &&
               memcmp(words[1].bytes, fake.name, fake.name_size) == 0) {
        tell_value(fd, fake.value, fake.value_size);
    } else {
        tell(fd, "$-1\r\n", 5);
    }
    return true;
}

static void *serve(void *nothing)
{
    static char got[1 << 17];
    for (int fd; (fd = accept(fake.listening, NULL, NULL)) >= 0;) {
        size_t size = 0;
        word words[8];
        /* A test that fails leaves its connection open: the next must get its turn. */
        const struct timeval patience = {.tv_sec = 60};
        setsockopt(fd, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
        atomic_fetch_add(&fake.connections, 1);
        for (ssize_t more; (more = recv(fd, got + size, sizeof got - size, 0)) > 0;) {
            size += (size_t)more;
            const size_t count = split(got, size, words);
            if (count && !reply(fd, words, count))
                break;
            size = count ? 0 : size;
        }
        close(fd);
    }
    return nothing;
}

static int start(void **state)
{
    (void)state;
    snprintf(fake.folder, sizeof fake.folder, "/tmp/strum-store-XXXXXX");
    if (!mkdtemp(fake.folder))
        return -1;
    snprintf(fake.path, sizeof fake.path, "%s/socket", fake.folder);
    struct sockaddr_un address = {.sun_family = AF_UNIX};
    snprintf(address.sun_path, sizeof address.sun_path, "%s", fake.path);
    fake.listening = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
    if (bind(fake.listening, (struct sockaddr *)&address, sizeof address) != 0 ||
        listen(fake.listening, 16) != 0)
        return -1;
    return pthread_create(&fake.thread, NULL, serve, NULL);
}

static int stop(void **state)
{
    (void)state;
    shutdown(fake.listening, SHUT_RDWR);
    pthread_join(fake.thread, NULL);
    close(fake.listening);
    unlink(fake.path);
    return rmdir(fake.folder);
}

/* ---- the store ---- */

#define LONG_MS  60000 /* never waited for */
#define SHORT_MS 50

static int turns_away, turns_back;
static char last_reason[256];

static void turned(bool away, const char *why)
{
    turns_away += away;
    turns_back += !away;
    snprintf(last_reason, sizeof last_reason, "%s", why);
}

static const store_options usual = {
    .host = "", .secret_file = "", .password_file = "", .connections = 2, .turned = turned};

static store *open_with(int wait_ms, const char *secret_file)
{
    store_options o = usual;
    char fault[256] = "";
    o.port = fake.path;
    o.wait_ms = wait_ms;
    o.secret_file = secret_file;
    fake.manner = HONEST;
    turns_away = turns_back = 0;
    store *s = store_new(&o, fault);
    if (!s)
        fail_msg("%s", fault);
    return s;
}

static cache_key key_number(uint64_t number)
{
    cache_key key;
    assert_true(key_of_parts(&(key_part){&number, sizeof number}, 1, &key));
    return key;
}

static void keep(store *s, uint64_t number, const char *body)
{
    const cache_key key = key_number(number);
    strbuf t = {0};
    strbuf_add_string(&t, body);
    entry *e = entry_new(&key, 200, &t);
    assert_non_null(e);
    store_keep(s, e);
    entry_unref(e);
}

/* Whether `body` is found; anything else must not be. */
static bool finds(store *s, uint64_t number, const char *body)
{
    const cache_key key = key_number(number);
    entry *e = store_find(s, &key);
    if (!e)
        return false;
    assert_int_equal(e->status, 200);
    assert_true(e->from_store && !e->stored && !e->transient);
    assert_memory_equal(&e->key, &key, sizeof key);
    assert_int_equal(e->size, strlen(body));
    assert_string_equal(e->body, body);
    entry_unref(e);
    return true;
}

static void lie_with(manner m, const void *bytes, size_t size)
{
    pthread_mutex_lock(&lying);
    memcpy(fake.lie, bytes, fake.lie_size = size);
    fake.manner = m;
    pthread_mutex_unlock(&lying);
}

static void what_one_keeps_another_finds(void **state)
{
    (void)state;
    store *s = open_with(LONG_MS, "");
    assert_false(finds(s, 1, ""));
    keep(s, 1, "{\"an\":\"answer\"}");
    assert_string_equal(fake.expiry, ""); /* none was asked for */
    assert_true(finds(s, 1, "{\"an\":\"answer\"}"));
    assert_false(finds(s, 2, ""));
    /* An answer of this solver only. */
    char name[128], hex[KEY_HEX_SIZE];
    const cache_key key = key_number(1);
    key_hex(&key, hex);
    const int head = snprintf(name, sizeof name, "strum:%s-%d-%s-", strum_version(),
                              strum_solver(), evaluation_numerics());
    assert_memory_equal(fake.name, name, (size_t)head);
    assert_int_equal(strspn(fake.name + head, "0123456789abcdef"), 16);
    assert_memory_not_equal(fake.name + head, "0000000000000000", 16);
    assert_int_equal(fake.name_size, head + 16 + 1 + 64);
    assert_memory_equal(fake.name + head + 17, hex, 64);
    const store_counters c = store_count(s);
    assert_int_equal(c.hits, 1);
    assert_int_equal(c.misses, 2);
    assert_int_equal(c.writes, 1);
    assert_int_equal(c.errors + c.rejected, 0);
    assert_int_equal(turns_back, 1);
    assert_int_equal(turns_away, 0);
    store_free(s);
    s = open_with(LONG_MS, "");
    assert_true(finds(s, 1, "{\"an\":\"answer\"}"));
    store_free(s);
}

static void without_a_store_nothing_is_found(void **state)
{
    (void)state;
    const cache_key key = key_number(1);
    assert_null(store_find(NULL, &key));
    keep(NULL, 1, "{}");
}

static void an_expiry_is_asked_for(void **state)
{
    (void)state;
    store_options o = usual;
    char fault[256];
    o.port = fake.path;
    o.wait_ms = LONG_MS;
    o.expiry_s = 2592000;
    store *s = store_new(&o, fault);
    assert_non_null(s);
    keep(s, 1, "{}");
    assert_string_equal(fake.expiry, "2592000");
    store_free(s);
}

/* ---- lies ---- */

static void a_value_that_was_changed_is_rejected(void **state)
{
    (void)state;
    static const char body[] = "{\"frequency\":0.2662618164906}";
    store *s = open_with(LONG_MS, "");
    keep(s, 2, body);
    char other[sizeof fake.value];
    const size_t other_size = fake.value_size;
    memcpy(other, fake.value, other_size);
    keep(s, 1, body);
    const size_t size = fake.value_size;
    uint64_t rejected = 0;
    for (size_t i = 0; i < size; i++) { /* any byte */
        lie_with(OTHER_VALUE, fake.value, size);
        fake.lie[i] ^= 1;
        assert_false(finds(s, 1, ""));
        rejected++;
    }
    for (size_t i = 0; i < size; i++) { /* any length */
        lie_with(OTHER_VALUE, fake.value, i);
        assert_false(finds(s, 1, ""));
        rejected++;
    }
    lie_with(OTHER_VALUE, fake.value, size + 1);
    assert_false(finds(s, 1, ""));
    /* another key's, which is whole */
    lie_with(OTHER_VALUE, other, other_size);
    assert_false(finds(s, 1, ""));
    assert_true(finds(s, 2, body));
    rejected += 2;
    assert_int_equal(store_count(s).rejected, rejected);
    assert_int_equal(store_count(s).errors, 0);
    fake.manner = HONEST;
    assert_true(finds(s, 1, body));
    store_free(s);
}

static void write_secret(char path[96], const char *name, const char *secret)
{
    snprintf(path, 96, "%s/%s", fake.folder, name);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(secret, file);
    fclose(file);
}

static void who_does_not_know_the_secret_cannot_write(void **state)
{
    (void)state;
    char one[96], two[96];
    write_secret(one, "one", "a secret of ours\n");
    write_secret(two, "two", "a secret of them\n");
    static const char *const writers[] = {"", NULL, NULL};
    for (int i = 0; i < 3; i++) {
        store *s = open_with(LONG_MS, i == 0 ? writers[0] : i == 1 ? two : one);
        keep(s, 1, "{}");
        assert_true(finds(s, 1, "{}"));
        store_free(s);
        s = open_with(LONG_MS, one);
        assert_int_equal(finds(s, 1, "{}"), i == 2);
        assert_int_equal(store_count(s).rejected, i != 2);
        store_free(s);
    }
    unlink(one);
    unlink(two);
}

static void a_faulty_file_is_told(void **state)
{
    (void)state;
    char path[96], fault[256];
    store_options o = usual;
    o.port = fake.path;
    o.secret_file = "/nowhere/secret";
    assert_null(store_new(&o, fault));
    assert_string_equal(fault, "store_secret_file: /nowhere/secret: No such file or directory");
    write_secret(path, "short", "fifteen letters\n");
    o.secret_file = path;
    assert_null(store_new(&o, fault));
    assert_non_null(strstr(fault, "too short"));
    o.secret_file = "";
    write_secret(path, "short", "\n");
    o.password_file = path;
    assert_null(store_new(&o, fault));
    assert_non_null(strstr(fault, "store_password_file"));
    unlink(path);
}

static void what_is_no_value_is_none(void **state)
{
    (void)state;
    static const struct {
        const char *reply;
        const char *reason; /* of an error; NULL: it is rejected, or not there */
        uint64_t rejected, errors, misses;
    } rows[] = {
        {"$-1\r\n", NULL, 0, 0, 1},
        {"$0\r\n\r\n", NULL, 1, 0, 0},
        {"+OK\r\n", NULL, 1, 0, 0},
        {"$5000000\r\nand so on", NULL, 1, 0, 0},
        {"$999999999999\r\n", NULL, 1, 0, 0},
        {"-NOAUTH Authentication \xc3\xa9 required.\r\n", "NOAUTH Authentication ?? required.",
         0, 1, 0},
        {"-LOADING\r\n", "LOADING", 0, 1, 0},
        {"$-2\r\n", "what it sends is not the Redis protocol", 0, 1, 0},
        {"$99999999999999999999\r\n", "what it sends is not the Redis protocol", 0, 1, 0},
        {"$ 5\r\nabcde\r\n", "what it sends is not the Redis protocol", 0, 1, 0},
        {"$\r\n", "what it sends is not the Redis protocol", 0, 1, 0},
        {"$-1\n", "what it sends is not the Redis protocol", 0, 1, 0},
        {"\n", "what it sends is not the Redis protocol", 0, 1, 0},
        {"\r\n", "what it sends is not the Redis protocol", 0, 1, 0},
        {":1\r\n", "what it sends is not the Redis protocol", 0, 1, 0},
        {"*1\r\n$1\r\na\r\n", "what it sends is not the Redis protocol", 0, 1, 0},
        {"HTTP/1.1 400 Bad Request\r\n\r\n", "what it sends is not the Redis protocol", 0, 1,
         0},
        {"$-1\r\n$-1\r\n", "what it sends is not the Redis protocol", 0, 1, 0},
        {"$1\r\nab\r\n", "the reply is not as long as it says", 0, 1, 0},
        {"$1\r\na\r\n$1\r\na\r\n", "the reply is not as long as it says", 0, 1, 0},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        store *s = open_with(LONG_MS, "");
        keep(s, 1, "{}");
        lie_with(OTHER_REPLY, rows[i].reply, strlen(rows[i].reply));
        assert_false(finds(s, 1, ""));
        const store_counters c = store_count(s);
        if (c.rejected != rows[i].rejected || c.errors != rows[i].errors ||
            c.misses != rows[i].misses)
            fail_msg("row %zu: rejected %d, errors %d, misses %d", i, (int)c.rejected,
                     (int)c.errors, (int)c.misses);
        /* Nothing of it is left for the next reply. */
        fake.manner = HONEST;
        assert_true(finds(s, 1, "{}"));
        assert_false(finds(s, 2, "{}"));
        /* As the first word it is a reason to stay away. */
        store_free(s);
        s = open_with(LONG_MS, "");
        fake.manner = OTHER_REPLY;
        assert_false(finds(s, 1, ""));
        assert_int_equal(store_count(s).away, rows[i].reason != NULL);
        if (rows[i].reason)
            assert_string_equal(last_reason, rows[i].reason);
        store_free(s);
    }
}

static void a_line_without_end_is_not_read_to_its_end(void **state)
{
    (void)state;
    store *s = open_with(LONG_MS, "");
    keep(s, 1, "{}");
    memset(fake.lie, '-', sizeof fake.lie);
    fake.lie_size = sizeof fake.lie;
    fake.manner = OTHER_REPLY;
    assert_false(finds(s, 1, ""));
    assert_int_equal(store_count(s).errors, 1);
    store_free(s);
}

/* ---- half replies, silence, and staying away ---- */

static void a_reply_that_breaks_off_is_none(void **state)
{
    (void)state;
    store *s = open_with(LONG_MS, "");
    keep(s, 1, "{}");
    char reply[256];
    const int head = snprintf(reply, sizeof reply, "$%zu\r\n", fake.value_size);
    memcpy(reply + head, fake.value, fake.value_size);
    memcpy(reply + head + fake.value_size, "\r\n", 2);
    const size_t size = (size_t)head + fake.value_size + 2;
    for (size_t i = 0; i < size; i++) {
        store_free(s);
        s = open_with(LONG_MS, "");
        assert_true(finds(s, 1, "{}"));
        lie_with(LAST_WORDS, reply, i);
        assert_false(finds(s, 1, ""));
        assert_int_equal(store_count(s).errors, 1);
    }
    lie_with(LAST_WORDS, reply, size);
    assert_true(finds(s, 1, "{}"));
    store_free(s);
}

/* A server that restarts, or ends what lies idle: no failure. */
static void a_connection_that_was_closed_is_made_anew(void **state)
{
    (void)state;
    store *s = open_with(LONG_MS, "");
    keep(s, 1, "{}");
    lie_with(LAST_WORDS, "$-1\r\n", 5);
    const int before = fake.connections;
    for (int i = 0; i < 10; i++)
        assert_false(finds(s, 1, ""));
    assert_int_equal(store_count(s).misses, 10);
    assert_int_equal(store_count(s).errors, 0);
    assert_int_equal(fake.connections - before, 9); /* the first was over the old one */
    store_free(s);
}

static void silence_and_dripping_end_in_time(void **state)
{
    (void)state;
    for (manner m = SILENT; m <= DRIPPING; m++) {
        store *s = open_with(SHORT_MS, "");
        fake.manner = m;
        assert_false(finds(s, 1, ""));
        assert_int_equal(store_count(s).errors, 1);
        assert_string_equal(last_reason, "it did not answer in time");
        store_free(s);
    }
}

static void a_store_that_fails_is_left_alone_until_it_is_back(void **state)
{
    (void)state;
    store *s = open_with(LONG_MS, "");
    keep(s, 1, "{}");
    lie_with(OTHER_REPLY, "-LOADING\r\n", 10);
    for (int i = 0; i < 3; i++) {
        assert_false(store_count(s).away);
        assert_int_equal(turns_away, 0);
        assert_false(finds(s, 1, ""));
    }
    assert_true(store_count(s).away);
    assert_int_equal(turns_away, 1);
    assert_string_equal(last_reason, "LOADING");
    /* It is asked no more, but now and then whether it is back: each time after twice as long.
     */
    while (store_count(s).errors < 4) {
        assert_false(finds(s, 1, ""));
        usleep(10000);
    }
    assert_int_equal(turns_away, 1);
    const int commands = fake.commands;
    fake.manner = HONEST;
    assert_false(finds(s, 1, ""));
    assert_int_equal(fake.commands, commands);
    while (!finds(s, 1, "{}"))
        usleep(10000);
    assert_false(store_count(s).away);
    assert_int_equal(turns_back, 2);
    assert_int_equal(fake.commands, commands + 1);
    store_free(s);
}

static void a_store_that_is_not_there_is_left_alone(void **state)
{
    (void)state;
    store_options o = usual;
    char fault[256];
    o.port = "/nowhere/socket";
    o.wait_ms = LONG_MS;
    turns_away = 0;
    store *s = store_new(&o, fault);
    assert_non_null(s);
    assert_false(finds(s, 1, ""));
    assert_true(store_count(s).away);
    assert_int_equal(turns_away, 1);
    assert_string_equal(last_reason, "No such file or directory");
    keep(s, 1, "{}");
    assert_int_equal(store_count(s).errors, 1);
    store_free(s);
}

/* ---- memory ---- */

static void every_allocation_may_fail(void **state)
{
    (void)state;
    static char body[40000];
    memset(body, 'x', sizeof body - 1);
    char secret[96], fault[256];
    write_secret(secret, "secret", "a secret of ours\n");
    store_options o = usual;
    o.port = fake.path;
    o.wait_ms = LONG_MS;
    o.secret_file = o.password_file = secret;
    fake.manner = HONEST;
    lie_with(HONEST, "", 0);
    for (int all = 0; all < 2; all++) {
        and_all_after = all;
        bool whole = false;
        for (long n = 0; !whole; n++) {
            assert_true(n < 200);
            const cache_key key = key_number(1);
            strbuf t = {0};
            strbuf_add_string(&t, body);
            entry *e = entry_new(&key, 200, &t);
            fake.name_size = 0;
            allocations = 0;
            fails_at = n;
            store *s = store_new(&o, fault);
            store_keep(s, e);
            const bool found = finds(s, 1, body);
            whole = allocations <= n;
            fails_at = NEVER;
            if (whole)
                assert_true(found);
            store_free(s);
            entry_unref(e);
        }
    }
    unlink(secret);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_one_keeps_another_finds),
        cmocka_unit_test(without_a_store_nothing_is_found),
        cmocka_unit_test(an_expiry_is_asked_for),
        cmocka_unit_test(a_value_that_was_changed_is_rejected),
        cmocka_unit_test(who_does_not_know_the_secret_cannot_write),
        cmocka_unit_test(a_faulty_file_is_told),
        cmocka_unit_test(what_is_no_value_is_none),
        cmocka_unit_test(a_line_without_end_is_not_read_to_its_end),
        cmocka_unit_test(a_reply_that_breaks_off_is_none),
        cmocka_unit_test(a_connection_that_was_closed_is_made_anew),
        cmocka_unit_test(silence_and_dripping_end_in_time),
        cmocka_unit_test(a_store_that_fails_is_left_alone_until_it_is_back),
        cmocka_unit_test(a_store_that_is_not_there_is_left_alone),
        cmocka_unit_test(every_allocation_may_fail),
    };
    return cmocka_run_group_tests(tests, start, stop);
}
