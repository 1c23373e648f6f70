/* SPDX-License-Identifier: MIT
 * Integers without end: 16- and 32-bit arithmetic, walks over arrays, small functions. The processor never
 * waits, so a run of it measures how fast code is executed.
 */
#include "helpers.h"

#define CELLS 64

static int cells[CELLS];
unsigned long checksum;

int main(void)
{
  unsigned int seed = 1;
  while (1) {
    int i;
    for (i = 0; i < CELLS; i++) {
      seed = next_random(seed);
      cells[i] = clamp((int)(seed >> 4) - 2048, 1500);
    }
    for (i = 0; i + 8 <= CELLS; i += 4) {
      long w = weighted(cells + i);
      cells[i] = (int)(w >> 8) ^ (int)w;
      checksum += (unsigned long)w;
    }
    checksum ^= (unsigned long)smallest(cells, CELLS) << 8;
    sort_some(cells + 16, 16);
    for (i = 1; i < CELLS; i++)
      checksum = checksum * 33 + (unsigned int)(cells[i] / 3 + cells[i - 1] % 7);
  }
}
