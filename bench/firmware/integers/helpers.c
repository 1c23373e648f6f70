/* SPDX-License-Identifier: MIT
 * Small functions of a file of their own, so they are called.
 */
#include "helpers.h"

static const int weights[8] = {3, -5, 7, 11, -13, 17, 19, -23};

int clamp(int value, int limit)
{
  if (value > limit)
    return limit;
  return value < -limit ? -limit : value;
}

unsigned int next_random(unsigned int seed)
{
  return 25173u * seed + 13849u;
}

long weighted(const int *from)
{
  long sum = 0;
  int i;
  for (i = 0; i < 8; i++)
    sum += (long)from[i] * weights[i];
  return sum;
}

int smallest(const int *from, int count)
{
  int place = 0, i;
  for (i = 1; i < count; i++)
    if (from[i] < from[place])
      place = i;
  return place;
}

void sort_some(int *from, int count)
{
  int i, j;
  for (i = 1; i < count; i++) {
    int moved = from[i];
    for (j = i; j > 0 && from[j - 1] > moved; j--)
      from[j] = from[j - 1];
    from[j] = moved;
  }
}
