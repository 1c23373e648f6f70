/* SPDX-License-Identifier: MIT
 * Floats without end: polynomials of three terms and what people do with their results. The processor never
 * waits, so a run of it measures how fast soft float is executed.
 */
#include "polynomial.h"

#define POINTS 16

float results[POINTS];
float sum;
int turns;

int main(void)
{
  while (1) {
    int i;
    float largest = -1e9f;
    for (i = 0; i < POINTS; i++) {
      float y = polynomial(i & 3, 0.1f * i - 0.5f);
      results[i] = y;
      if (y > largest)
        largest = y;
    }
    sum = 0.9f * sum + largest / POINTS;
    turns += (int)(10.0f * sum);
  }
}
