// SPDX-License-Identifier: MIT
/* sieve: primes below 60 by the sieve. */
#ifndef NOINLINE
#define NOINLINE __attribute__((noinline))
#endif

static char composite[60];
NOINLINE int sieve(int n) {
  int i, j, primes = 0;
  for (i = 2; i < n; i++) {
    if (composite[i]) continue;
    primes++;
    for (j = i + i; j < n; j += i) composite[j] = 1;
  }
  return primes;
}

/* fixed driver input */
long bench_run(void) { return sieve(60); }
