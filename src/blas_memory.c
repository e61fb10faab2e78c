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
 */
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
    void *buffer = mmap(NULL, BUFFER_SIZE, PROT_READ | PROT_WRITE,
                        MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    pthread_once(&once, start);
    (void)pthread_setspecific(thread_end, &spares);
    return buffer != MAP_FAILED ? buffer : NULL; /* OpenBLAS has no way to fail */
}

void blas_memory_free(void *buffer)
{
    spare *s = buffer;
    s->next = spares;
    spares = s;
}
