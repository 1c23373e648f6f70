/* SPDX-License-Identifier: MIT
 * Cycles of mathematical functions on the dsPIC30F with the vendor's library. [vendor] measured by a third
 * party on the same core family (igor-m, Floating-Point-Library-for-FlashForth, 2015); [scaled] generic
 * figure of xc16-cycles/library_cost.csv times 0.3, the median ratio of the functions known both ways. */
#ifndef TP_MATH_COSTS_H
#define TP_MATH_COSTS_H
#define kCycles_sin 2221   /* [vendor] */
#define kCycles_cos 2984   /* [vendor] */
#define kCycles_tan 2863   /* [vendor] */
#define kCycles_atan2 3239 /* [vendor] */
#define kCycles_exp 3058   /* [vendor] */
#define kCycles_log 2485   /* [vendor] */
#define kCycles_pow 8666   /* [vendor] */
#define kCycles_sqrt 479   /* [vendor] */
#define kCycles_asin 3613  /* [scaled] */
#define kCycles_acos 3090  /* [scaled] */
#define kCycles_atan 3174  /* [scaled] */
#define kCycles_log10 3303 /* [scaled] */
#define kCycles_sinh 6500  /* [assumed: two exponentials] */
#define kCycles_cosh 6500  /* [assumed: two exponentials] */
#define kCycles_tanh 7000  /* [assumed: two exponentials and a division] */
#define kCycles_floor 122  /* [scaled] */
#define kCycles_ceil 122   /* [scaled] */
#define kCycles_fmod 153   /* [scaled] */
#endif
