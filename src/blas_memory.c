/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The work buffers of OpenBLAS, a set for each thread.
 *
 * Debian 12's serial OpenBLAS (0.3.21, built without USE_LOCKING) picks a free buffer by a test
 * and a later store, under no lock: two threads that multiply at once can get the same one, and
 * wrong products. OpenBLAS calls its allocator through the dynamic linker, so that these two
 * functions of the same names take its place in the daemon; libstrum leaves its host's alone.
 * tests/unit/suspended/test_threads.c fails without them.
 * The threaded flavour is no way out: it starts threads before main, and more of them.
 *
 * A call of BLAS cannot fail: without a buffer it writes to address 0. One buffer is therefore
 * shared, made before any thread, for which those wait that find no address space for their own.
 */
#include "blas_memory.h"

#include <pthread.h>
#include <stddef.h>
#include <sys/mman.h>

/* OpenBLAS' own: BUFFER_SIZE of x86_64 and a page. Address space only, until it is used. */
#define BUFFER_SIZE ((size_t)0x8001000)

void *blas_memory_alloc(int position);
void blas_memory_free(void *buffer);

/* A buffer that this thread does not use now: the link stands in it. */
typedef struct spare {
    struct spare *next;
} spare;

static _Thread_local spare *spares;
static pthread_key_t thread_end;
static pthread_once_t once = PTHREAD_ONCE_INIT;

/* The shared one; NULL until it is made. */
static pthread_mutex_t shared_lock = PTHREAD_MUTEX_INITIALIZER;
static pthread_cond_t shared_back = PTHREAD_COND_INITIALIZER;
static void *shared;
static bool shared_taken;

static void *map_buffer(void)
{
    void *buffer = mmap(NULL, BUFFER_SIZE, PROT_READ | PROT_WRITE,
                        MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    return buffer != MAP_FAILED ? buffer : NULL;
}

bool blas_memory_start(void)
{
    pthread_mutex_lock(&shared_lock);
    if (shared == NULL)
        shared = map_buffer();
    const bool made = shared != NULL;
    pthread_mutex_unlock(&shared_lock);
    return made;
}

/* The shared buffer; NULL where it is taken, and `wait` is false, or was never made. */
static void *take_shared(bool wait)
{
    pthread_mutex_lock(&shared_lock);
    while (wait && shared != NULL && shared_taken)
        pthread_cond_wait(&shared_back, &shared_lock);
    void *buffer = shared_taken ? NULL : shared;
    shared_taken = shared_taken || buffer != NULL;
    pthread_mutex_unlock(&shared_lock);
    return buffer;
}

static void release(void *unused)
{
    (void)unused;
    for (spare *next; spares != NULL; spares = next) {
        next = spares->next;
        munmap(spares, BUFFER_SIZE);
    }
}

static void start(void)
{
    (void)pthread_key_create(&thread_end, release);
}

void *blas_memory_alloc(int position)
{
    (void)position;
    spare *s = spares;
    if (s != NULL) {
        spares = s->next;
        return s;
    }
    void *buffer = take_shared(false);
    if (buffer != NULL)
        return buffer;
    buffer = map_buffer();
    if (buffer == NULL)
        return take_shared(true);
    pthread_once(&once, start);
    (void)pthread_setspecific(thread_end, &spares);
    return buffer;
}

void blas_memory_free(void *buffer)
{
    pthread_mutex_lock(&shared_lock);
    const bool was_shared = buffer == shared;
    if (was_shared) {
        shared_taken = false;
        pthread_cond_signal(&shared_back);
    }
    pthread_mutex_unlock(&shared_lock);
    if (was_shared)
        return;
    spare *s = buffer;
    s->next = spares;
    spares = s;
}
