/* SPDX-License-Identifier: MIT
 * Runtime of the chip: products and quotients of complex numbers. Infinities and not-a-number as the parts give them;
 * the C standard's recovery of infinities (annex G) is not done. */
float _Complex __mulsc3(float a, float b, float c, float d)
{
  float _Complex z;
  __real__ z = a * c - b * d;
  __imag__ z = a * d + b * c;
  return z;
}

/* by the larger part of the divisor, so that its square does not overflow */
float _Complex __divsc3(float a, float b, float c, float d)
{
  float _Complex z;
  const int is_wide = (c < 0 ? -c : c) < (d < 0 ? -d : d);
  const float ratio = is_wide ? c / d : d / c, by = is_wide ? c * ratio + d : c + d * ratio;
  __real__ z = (is_wide ? a * ratio + b : a + b * ratio) / by;
  __imag__ z = (is_wide ? b * ratio - a : b - a * ratio) / by;
  return z;
}
