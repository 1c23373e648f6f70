/* SPDX-License-Identifier: MIT
 * What the contract's headers need to serve two compilers: twinpuck-cc (which defines __TWINPUCK__) and
 * Microchip's XC16. Controllers never need this file.
 */
#ifndef TWINPUCK_H
#define TWINPUCK_H

#ifdef __TWINPUCK__
/** The library has two or three implementations of some functions under one name; on the robot the object
 *  file that is linked decides. Here the header decides: it gives the function the label of its variant. */
#define TP_VARIANT(prefix, name) __asm__(#prefix #name)
/** A second form of a function that had no argument in older versions of the library: both calls compile. Its
 *  condition holds for each call, but for no compiler that is asked for the function's address, which is that of the
 *  form of today. */
extern int tp_older_call;
#define TP_OLDER_CALL static __inline__ __attribute__((overloadable, unused, enable_if(!__builtin_constant_p(tp_older_call), "")))
#else
/* the same labels with hal_dspic, as one archive of all variants; C names begin with an underscore in assembler */
#define TP_VARIANT(prefix, name) __asm__("_" #prefix #name)
#endif

/* the program is one of the robot's chip, by either compiler: no simulator is behind it, and memory is 8 KB */
#if defined(__TWINPUCK__) || defined(__C30__)
#define TP_ON_CHIP
#endif

/* around prototypes that supervisor programs in C++ include as well */
#ifdef __cplusplus
#define TP_C_BEGIN extern "C" {
#define TP_C_END }
#else
#define TP_C_BEGIN
#define TP_C_END
#endif

#endif
