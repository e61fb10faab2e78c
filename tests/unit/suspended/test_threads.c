/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Threads that solve at once get what each gets alone, to the last bit. */
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include <cblas.h>

#include "check.h"

enum { THREADS = 4, ROUNDS = 10000, N = 64 };

/* Small whole numbers: every product and sum is exact, in whatever order. */
static void *multiply(void *argument)
{
    const long id = (long)argument;
    double *a = malloc(sizeof(double[N][N])), *b = malloc(sizeof(double[N][N])),
           *c = malloc(sizeof(double[N][N])), *exact = malloc(sizeof(double[N][N]));
    for (int i = 0; i < N * N; i++) {
        a[i] = (double)(i * 37 % 101 + id);
        b[i] = (double)(i * 17 % 89 - id);
    }
    for (int i = 0; i < N; i++) {
        for (int j = 0; j < N; j++) {
            double sum = 0;
            for (int k = 0; k < N; k++)
                sum += a[i * N + k] * b[k * N + j];
            exact[i * N + j] = sum;
        }
    }
    long wrong = 0;
    for (int round = 0; round < ROUNDS; round++) {
        cblas_dgemm(CblasRowMajor, CblasNoTrans, CblasNoTrans, N, N, N, 1, a, N, b, N, 0, c, N);
        wrong += memcmp(c, exact, sizeof(double[N][N])) != 0;
    }
    free(a);
    free(b);
    free(c);
    free(exact);
    return (void *)wrong;
}

static void products_of_several_threads_are_exact(void **state)
{
    (void)state;
    pthread_t threads[THREADS];
    for (long i = 0; i < THREADS; i++)
        assert_int_equal(pthread_create(&threads[i], NULL, multiply, (void *)i), 0);
    for (int i = 0; i < THREADS; i++) {
        void *wrong;
        pthread_join(threads[i], &wrong);
        assert_int_equal((long)wrong, 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(products_of_several_threads_are_exact),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
