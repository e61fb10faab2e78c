#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Debian's serial OpenBLAS multiplies wrongly when two threads multiply at once.
#
# One would guess: "serial" says that the library starts no threads of its own, so that a program with threads of its own takes this
#   flavour: dgemm has no state that a caller could share, and the reference BLAS, which it replaces, may be called from any thread.
# What happens: libopenblas0-serial is built without locks (USE_LOCKING). The flag that marks a work buffer as taken is read, and set only
#   afterwards: two threads can take the same buffer and pack their matrices over each other's. The products are wrong by whole terms, not
#   by rounding, in up to 7 of a hundred calls here (in other runs in none), and no call reports anything. The matrices are the threads'
#   own, nothing is shared. The threaded flavour (libopenblas0-pthread, told to use one thread) and the reference BLAS make no mistake in as
#   many calls.
# What follows: a test of a few thousand products may well pass, and whatever multiplies through BLAS is concerned.
# Seen with libopenblas0-serial 0.3.21+ds-4 (Debian 12) on two cores, on 2026-11-28.
#
# Needs gcc, two cores, and apt-get. Exit status: 0 as described, 1 it has changed, 2 it could not be tried.
set -euo pipefail
[ "$(nproc)" -ge 2 ] || { echo "one core: two threads would hardly meet" >&2 && exit 2; }
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT
(cd "$place" && apt-get download -qq -o APT::Sandbox::User=root libopenblas0-serial=0.3.21+ds-4 \
    libopenblas0-pthread=0.3.21+ds-4 libblas3=3.11.0-2 libgfortran5 libquadmath0 >&2) || exit 2
for package in "$place"/*.deb; do dpkg-deb -x "$package" "$place"; done

cat >"$place/try.c" <<'TRY'
#include <pthread.h>
#include <stdio.h>
#include <string.h>

enum { SIZE = 48, TIMES = 200000 };
void dgemm_(const char *, const char *, const int *, const int *, const int *, const double *, const double *, const int *,
            const double *, const int *, const double *, double *, const int *);

typedef struct task {
    double left[SIZE * SIZE], right[SIZE * SIZE], wanted[SIZE * SIZE], product[SIZE * SIZE];
    int wrong;
} task;

/* Small whole numbers: every sum is exact, whatever its order. */
static void prepare(task *t, int seed)
{
    memset(t, 0, sizeof *t);
    for (int i = 0; i < SIZE * SIZE; i++) {
        t->left[i] = (7 * i + 3 * seed) % 11 - 5;
        t->right[i] = (5 * i + seed) % 13 - 6;
    }
    for (int column = 0; column < SIZE; column++)
        for (int k = 0; k < SIZE; k++)
            for (int row = 0; row < SIZE; row++)
                t->wanted[row + column * SIZE] += t->left[row + k * SIZE] * t->right[k + column * SIZE];
}

static void *multiply(void *argument)
{
    task *t = argument;
    const int n = SIZE;
    const double one = 1, zero = 0;
    t->wrong = 0;
    for (int i = 0; i < TIMES; i++) {
        dgemm_("N", "N", &n, &n, &n, &one, t->left, &n, t->right, &n, &zero, t->product, &n);
        t->wrong += memcmp(t->product, t->wanted, sizeof t->product) != 0;
    }
    return NULL;
}

int main(void)
{
    static task tasks[2];
    pthread_t threads[2];
    for (int i = 0; i < 2; i++)
        prepare(&tasks[i], i);
    for (int i = 0; i < 2; i++)
        multiply(&tasks[i]);
    int alone = tasks[0].wrong + tasks[1].wrong;
    for (int i = 0; i < 2; i++)
        pthread_create(&threads[i], NULL, multiply, &tasks[i]);
    for (int i = 0; i < 2; i++)
        pthread_join(threads[i], NULL);
    printf("%d %d %d\n", 2 * TIMES, alone, tasks[0].wrong + tasks[1].wrong);
    return 0;
}
TRY
usr=$place/usr/lib/x86_64-linux-gnu
gcc -O1 -o "$place/try" "$place/try.c" "$usr/blas/libblas.so.3" -lpthread -Wl,--allow-shlib-undefined

attempt() { # attempt NAME FOLDER: prints the counts and leaves them in $alone and $together
    local calls
    read -r calls alone together < <(LD_LIBRARY_PATH=$usr/$2:$usr OPENBLAS_NUM_THREADS=1 "$place/try")
    echo "  $1: of $calls products, $alone wrong one thread after the other, $together wrong with two at once"
}
echo "dgemm of 48 x 48 whole numbers from two threads:"
status=0
attempt "libblas3 3.11.0 (reference)" blas
[ "$alone $together" = "0 0" ] || status=1
attempt "libopenblas0-pthread 0.3.21, one thread" openblas-pthread
[ "$alone $together" = "0 0" ] || status=1
for ((try = 1; try <= 10; try++)); do
    attempt "libopenblas0-serial 0.3.21, try $try" openblas-serial
    [ "$alone" = 0 ] || status=1
    [ "$together" = 0 ] || exit $status
done
echo "CHANGED: no wrong product in ten tries"
exit 1
