/* SPDX-License-Identifier: MIT
 * Refers to every routine of the chip's runtime, and to the C library's that are known by heart. */
#include <math.h>
#include <string.h>
#include <stdlib.h>
volatile float fa = 1.5f, fb = 2.5f, fr;
volatile long la = 100, lb = 7, lr; volatile unsigned long ua = 100, ub = 7, ur;
volatile long long qa=5, qb=3, qr; volatile unsigned long long va=5, vb=3, vr;
volatile long double da=1, db=2, dr;
volatile int ia=3, ir; volatile unsigned wa=3;
char b1[40], b2[40] = "hello";
const char k[] = "aaa\0aab\0aaaaab\0\0aaaaaaaaaaaaaa, a constant text\0aa";
int main(void)
{
  fr = fa + fb; fr = fa - fb; fr = fa * fb; fr = fa / fb; fr = -fa;
  ir = fa == fb; ir = fa != fb; ir = fa < fb; ir = fa <= fb; ir = fa > fb; ir = fa >= fb; ir = isnan(fa);ir = __builtin_isunordered(fa,fb);
  fr = la; fr = ua; fr = qa; fr = va; fr = ia; fr = wa;
  lr = fa; ur = fa; qr = fa; vr = fa; ir = fa; wa = fa;
  lr = la / lb; lr = la % lb; ur = ua / ub; ur = ua % ub; lr = la * lb;
  qr = qa / qb; qr = qa % qb; vr = va / vb; vr = va % vb; qr = qa * qb; qr = qa << ia; vr = va >> ia; qr = qa >> ia;
  dr = da + db; dr = da - db; dr = da*db; dr = da/db; ir = da < db; ir = da == db; ir = da<=db; ir = da>db; ir=da>=db; ir=da!=db; dr = fa; fr = da; dr = la; dr = ua; dr = qa; dr = va; lr = da; ur = da; qr = da; vr = da; dr=-da;
  fr = sqrtf(fa); fr = sinf(fa); fr = cosf(fa); fr = tanf(fa); fr = atanf(fa); fr = atan2f(fa, fb); fr = expf(fa); fr = logf(fa); fr = powf(fa, fb); fr = log10f(fa); fr= asinf(fa); fr = acosf(fa); fr = floorf(fa); fr = ceilf(fa); fr = fmodf(fa, fb); fr = fabsf(fa); fr= sinhf(fa); fr=coshf(fa); fr=tanhf(fa); fr=ldexpf(fa, ia); fr=frexpf(fa, (int*)&ir); fr=modff(fa,(float*)&fb);
  fr = sqrt(fa); fr = sin(fa); fr = cos(fa); fr = fabs(fa); fr = atan2(fa, fb); fr=pow(fa,fb);fr=exp(fa);
  memcpy(b1, b2, ia); memset(b1, ia, ia); memmove(b1, b2, ia); ir = memcmp(b1, b2, ia); ir = strlen(b1); strcpy(b1, b2); ir = strcmp(b1, k); strncpy(b1, k, ia); ir = strncmp(b1, b2, ia); strcat(b1, b2); strchr(b1, ia); strrchr(b1, ia); memchr(b1, ia, ia); ir = abs(ia); lr = labs(la);
  ir = atoi(b1); lr = atol(b1); fr = atof(b1); ir= rand();
  { div_t d = div(ia, 3); ir = d.quot; }
  { long r; ir = __builtin_smull_overflow(la, lb, &r); lr = r; } 
  { long long r; ir = __builtin_smulll_overflow(qa, qb, &r); qr = r; }
  for (;;) ;
}
