/* SPDX-License-Identifier: MIT
 * Runtime of the chip: functions that objects of XC16 call where this compiler's code has a few instructions. */

long __mulsi3(long a, long b) { return a * b; }

int __clzhi2(unsigned x) { return __builtin_clz(x); }
int __ctzsi2(unsigned long x) { return __builtin_ctzl(x); }
int __ffshi2(int x) { return __builtin_ffs(x); }
int __parityhi2(unsigned x) { return __builtin_parity(x); }
int __popcounthi2(unsigned x) { return __builtin_popcount(x); }
int __popcountsi2(unsigned long x) { return __builtin_popcountl(x); }
