/* SPDX-License-Identifier: MIT
 * Runtime of the chip: functions that objects of XC16 call where this compiler's code has a few instructions. */

long __mulsi3(long a, long b) { return a * b; }

/* bits counted and bytes turned round; hi: 16 bits, si: 32, di: 64 */
int __clzhi2(unsigned x) { return __builtin_clz(x); }
int __clzsi2(unsigned long x) { return __builtin_clzl(x); }
int __clzdi2(unsigned long long x) { return __builtin_clzll(x); }
int __ctzhi2(unsigned x) { return __builtin_ctz(x); }
int __ctzsi2(unsigned long x) { return __builtin_ctzl(x); }
int __ctzdi2(unsigned long long x) { return __builtin_ctzll(x); }
int __ffshi2(int x) { return __builtin_ffs(x); }
int __ffssi2(long x) { return __builtin_ffsl(x); }
int __ffsdi2(long long x) { return __builtin_ffsll(x); }
int __parityhi2(unsigned x) { return __builtin_parity(x); }
int __paritysi2(unsigned long x) { return __builtin_parityl(x); }
int __paritydi2(unsigned long long x) { return __builtin_parityll(x); }
int __popcounthi2(unsigned x) { return __builtin_popcount(x); }
int __popcountsi2(unsigned long x) { return __builtin_popcountl(x); }
int __popcountdi2(unsigned long long x) { return __builtin_popcountll(x); }
unsigned long __bswapsi2(unsigned long x) { return __builtin_bswap32(x); }
unsigned long long __bswapdi2(unsigned long long x) { return __builtin_bswap64(x); }
