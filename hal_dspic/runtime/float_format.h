/* SPDX-License-Identifier: MIT
 * IEEE arithmetic on the bits of a number, for the format that the including file describes:
 *
 *   BITS     unsigned type as wide as the number        FRACTION  bits of its fraction        EXPONENT  bits
 * of its exponent OF_ANY(x) __any_addsf3 or __adddf3 of add; NAME(x, n) alike              PRODUCT product():
 * upper half of a product, lowest bit sticky
 *
 * Rounds to nearest, ties to even; subnormal numbers, infinities and not-a-number as on any PC. A fraction
 * being worked on has three bits more: two that decide the rounding and one that says whether anything lay
 * below.
 */
#define WIDTH (1 + EXPONENT + FRACTION)
#define SIGN ((BITS)1 << (WIDTH - 1))
#define HIDDEN ((BITS)1 << FRACTION)
#define LARGEST ((1 << EXPONENT) - 1) /* exponent of infinities */
#define BIAS (LARGEST >> 1)
#define INFINITE ((BITS)LARGEST << FRACTION)
#define QUIET (INFINITE | HIDDEN >> 1)
#define GUARD 3

static BITS magnitude(BITS a) { return a & ~SIGN; }
static int exponent(BITS a) { return (int)(magnitude(a) >> FRACTION); }
static BITS fraction(BITS a) { return exponent(a) ? (a & (HIDDEN - 1)) | HIDDEN : a & (HIDDEN - 1); }

/* m with its leading bit at FRACTION + GUARD, or below it when e is 1 */
static BITS packed(BITS sign, int e, BITS m) {
  const unsigned rest = (unsigned)m & 7u;
  if (e >= LARGEST) return sign | INFINITE;
  m >>= GUARD;
  if (rest > 4u || (rest == 4u && (m & 1u))) m++;
  /* the hidden bit counts the exponent up by one; so does a carry out of the fraction */
  return sign | (((BITS)(unsigned)(e - 1) << FRACTION) + m);
}

/* as >>, but what falls out stays visible in the lowest bit */
static BITS shifted_down(BITS m, int n) {
  if (n >= WIDTH) return m != 0;
  if (n == 0) return m;
  return m >> n | ((m << (WIDTH - n)) != 0);
}

static BITS sum(BITS a, BITS b) {
  BITS sign, m, n;
  int e, f;
  if (magnitude(a) < magnitude(b)) {
    m = a, a = b, b = m;
  }
  sign = a & SIGN;
  e = exponent(a), f = exponent(b);
  if (e == LARGEST) {
    if (a & (HIDDEN - 1)) return a | QUIET;
    return magnitude(b) == INFINITE && a != b ? QUIET : a;
  }
  if (magnitude(b) == 0) return magnitude(a) ? a : a & b;
  m = fraction(a) << GUARD, n = fraction(b) << GUARD;
  if (!e) e = 1;
  if (!f) f = 1;
  n = shifted_down(n, e - f);
  if ((a ^ b) & SIGN) {
    m -= n;
    if (m == 0) return 0;
    while (e > 1 && !(m >> (FRACTION + GUARD))) m <<= 1, e--;
  } else {
    m += n;
    if (m >> (FRACTION + GUARD + 1)) m = m >> 1 | (m & 1), e++;
  }
  return packed(sign, e, m);
}

/* a normal fraction, and its exponent, of a number that may be subnormal */
static BITS normal(BITS a, int* e) {
  BITS m = fraction(a);
  *e = exponent(a);
  if (*e) return m;
  *e = 1;
  while (!(m & HIDDEN)) m <<= 1, --*e;
  return m;
}

/* leading bit of m at FRACTION + GUARD; e may be anything */
static BITS packed_far(BITS sign, int e, BITS m) {
  if (e > 0) return packed(sign, e, m);
  return packed(sign, 1, shifted_down(m, 1 - e));
}

static BITS times(BITS a, BITS b) {
  const BITS sign = (a ^ b) & SIGN;
  BITS m;
  int e, f;
  if (exponent(a) == LARGEST || exponent(b) == LARGEST) {
    if (magnitude(a) > INFINITE) return a | QUIET;
    if (magnitude(b) > INFINITE) return b | QUIET;
    return magnitude(a) && magnitude(b) ? sign | INFINITE : QUIET;
  }
  if (!magnitude(a) || !magnitude(b)) return sign;
  m = normal(a, &e), a = m;
  m = normal(b, &f), b = m;
  /* both with the leading bit on top: the product's is there or one below */
  m = product(a << EXPONENT, b << EXPONENT);
  e += f - BIAS + 1;
  if (!(m & SIGN)) m <<= 1, e--;
  return packed_far(sign, e, shifted_down(m, EXPONENT - GUARD));
}

static BITS quotient(BITS a, BITS b) {
  const BITS sign = (a ^ b) & SIGN;
  BITS rest, by, m = 0;
  int e, f, i;
  if (magnitude(a) > INFINITE) return a | QUIET;
  if (magnitude(b) > INFINITE) return b | QUIET;
  if (magnitude(a) == INFINITE) return magnitude(b) == INFINITE ? QUIET : sign | INFINITE;
  if (magnitude(b) == INFINITE) return sign;
  if (!magnitude(b)) return magnitude(a) ? sign | INFINITE : QUIET;
  if (!magnitude(a)) return sign;
  rest = normal(a, &e), by = normal(b, &f);
  e += BIAS - f;
  if (rest < by) rest <<= 1, e--;
  for (i = 0; i < FRACTION + GUARD; i++) {
    m <<= 1;
    if (rest >= by) rest -= by, m++;
    rest <<= 1;
  }
  m = m << 1 | (rest != 0);
  return packed_far(sign, e, m);
}

/* -1, 0, 1; `unordered` where one is not a number */
static int order(BITS a, BITS b, int unordered) {
  if (magnitude(a) > INFINITE || magnitude(b) > INFINITE) return unordered;
  if (!magnitude(a) && !magnitude(b)) return 0;
  if (a == b) return 0;
  if ((a ^ b) & SIGN) return a & SIGN ? -1 : 1;
  return (a < b) == !(a & SIGN) ? -1 : 1;
}

static BITS from_unsigned(unsigned long long v, BITS sign) {
  int e = BIAS + FRACTION;
  if (!v) return 0;
  while (v >> (FRACTION + 1)) {
    /* more bits than the fraction has: down to it, with those for rounding kept */
    int n = 0;
    unsigned long long top = v;
    while (top >> (FRACTION + 1)) top >>= 1, n++;
    e += n;
    if (n <= GUARD) return packed(sign, e, (BITS)v << (GUARD - n));
    return packed(sign, e, (BITS)(v >> (n - GUARD)) | ((v & ((1ull << (n - GUARD)) - 1)) != 0));
  }
  {
    BITS m = (BITS)v;
    while (!(m & HIDDEN)) m <<= 1, e--;
    return packed(sign, e, m << GUARD);
  }
}

/* towards zero; what does not fit is the nearest that does, not-a-number is 0 */
static unsigned long long to_unsigned(BITS a, unsigned long long most) {
  const int e = exponent(a) - BIAS;
  unsigned long long v;
  if (e < 0 || magnitude(a) > INFINITE) return 0;
  if (e >= 64) return most;
  v = fraction(a);
  v = e <= FRACTION ? v >> (FRACTION - e) : v << (e - FRACTION);
  return v > most ? most : v;
}

static long long to_signed(BITS a, unsigned long long most) {
  if (a & SIGN) return -(long long)to_unsigned(a, most + 1);
  return (long long)to_unsigned(a, most);
}

/* what the compiler calls */
BITS OF_ANY(add)(BITS a, BITS b) { return sum(a, b); }
BITS OF_ANY(mul)(BITS a, BITS b) { return times(a, b); }
BITS OF_ANY(div)(BITS a, BITS b) { return quotient(a, b); }
BITS NAME(neg, 2)(BITS a) { return a ^ SIGN; }
int NAME(eq, 2)(BITS a, BITS b) { return order(a, b, 1); }
int NAME(ne, 2)(BITS a, BITS b) { return order(a, b, 1); }
int NAME(lt, 2)(BITS a, BITS b) { return order(a, b, 1); }
int NAME(le, 2)(BITS a, BITS b) { return order(a, b, 1); }
int NAME(gt, 2)(BITS a, BITS b) { return order(a, b, -1); }
int NAME(ge, 2)(BITS a, BITS b) { return order(a, b, -1); }
int NAME(unord, 2)(BITS a, BITS b) { return magnitude(a) > INFINITE || magnitude(b) > INFINITE; }
BITS FROM(floatsi)(long v) {
  return from_unsigned(v < 0 ? 0ul - (unsigned long)v : (unsigned long)v, v < 0 ? SIGN : 0);
}
BITS FROM(floatunsi)(unsigned long v) { return from_unsigned(v, 0); }
BITS FROM(floatdi)(long long v) {
  return from_unsigned(v < 0 ? 0ull - (unsigned long long)v : (unsigned long long)v, v < 0 ? SIGN : 0);
}
BITS FROM(floatundi)(unsigned long long v) { return from_unsigned(v, 0); }
long TO(fix, si)(BITS a) { return (long)to_signed(a, 0x7FFFFFFF); }
/* of a negative number that of the signed conversion, as XC16's */
unsigned long TO(fixuns, si)(BITS a) {
  return a & SIGN ? (unsigned long)to_signed(a, 0x7FFFFFFF) : (unsigned long)to_unsigned(a, 0xFFFFFFFF);
}
long long TO(fix, di)(BITS a) { return to_signed(a, 0x7FFFFFFFFFFFFFFF); }
unsigned long long TO(fixuns, di)(BITS a) {
  return a & SIGN ? (unsigned long long)to_signed(a, 0x7FFFFFFFFFFFFFFF) : to_unsigned(a, 0xFFFFFFFFFFFFFFFF);
}
