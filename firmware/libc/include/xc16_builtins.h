/* SPDX-License-Identifier: MIT
 * What XC16 has as built-in functions, known to every file without an #include. Those that name registers are
 * in p30F6014A.h.
 */
#ifndef XC16_BUILTINS_H
#define XC16_BUILTINS_H

#define __builtin_nop() __asm__ volatile("nop")
#define __builtin_clrwdt() __asm__ volatile("clrwdt")
#define __builtin_software_breakpoint() __asm__ volatile("nop")
#define __builtin_pwrsav(mode) __asm__ volatile("pwrsav %0" : : "i"(mode))
#define __builtin_disi(cycles) __asm__ volatile("disi %0" : : "i"(cycles))
#define TP_OF_ADDRESS(function, object)                              \
  ({                                                                 \
    unsigned __v;                                                    \
    __asm__("mov #" #function "(%1), %0" : "=r"(__v) : "i"(object)); \
    __v;                                                             \
  })
#define __builtin_tblpage(object) TP_OF_ADDRESS(tblpage, object)
#define __builtin_tbloffset(object) TP_OF_ADDRESS(tbloffset, object)
#define __builtin_psvpage(object) TP_OF_ADDRESS(psvpage, object)
#define __builtin_psvoffset(object) TP_OF_ADDRESS(psvoffset, object)
#define __builtin_tbladdress(object) \
  ((unsigned long)__builtin_tblpage(object) << 16 | __builtin_tbloffset(object))
#define TP_TABLE_READ(instruction, offset)                               \
  ({                                                                     \
    unsigned __v;                                                        \
    __asm__ volatile(instruction " [%1], %0" : "=r"(__v) : "r"(offset)); \
    __v;                                                                 \
  })
#define __builtin_tblrdl(offset) TP_TABLE_READ("tblrdl", offset)
#define __builtin_tblrdh(offset) TP_TABLE_READ("tblrdh", offset)
#define __builtin_tblrdlb(offset) (TP_TABLE_READ("tblrdl.b", offset) & 0xFFu)
#define __builtin_tblrdhb(offset) (TP_TABLE_READ("tblrdh.b", offset) & 0xFFu)
#define __builtin_tblwtl(offset, value) __asm__ volatile("tblwtl %0, [%1]" : : "r"(value), "r"(offset))
#define __builtin_tblwth(offset, value) __asm__ volatile("tblwth %0, [%1]" : : "r"(value), "r"(offset))

/* 16 x 16 -> 32 bits */
#define __builtin_mulss(a, b) ((long)(int)(a) * (int)(b))
#define __builtin_muluu(a, b) ((unsigned long)(unsigned)(a) * (unsigned)(b))
#define __builtin_mulsu(a, b) ((long)(int)(a) * (long)(unsigned)(b))
#define __builtin_mulus(a, b) ((long)(unsigned)(a) * (long)(int)(b))

/* 32 / 16 -> 16 bits; divf: the fraction a / b in 1.15 */
#define __builtin_divsd(a, b) ((int)((long)(a) / (int)(b)))
#define __builtin_divud(a, b) ((unsigned)((unsigned long)(a) / (unsigned)(b)))
#define __builtin_modsd(a, b) ((int)((long)(a) % (int)(b)))
#define __builtin_modud(a, b) ((unsigned)((unsigned long)(a) % (unsigned)(b)))
#define __builtin_divmodsd(a, b, rest) tp_divmodsd(a, b, rest)
#define __builtin_divmodud(a, b, rest) tp_divmodud(a, b, rest)
#define __builtin_divf(a, b) ((int)((long)(int)(a)*32768L / (int)(b)))

/* single bits of a word; ff1l and ff1r: number of the first one from the left or right, from 1 on, 0 for
 * none; fbcl: minus the number of bits that only repeat the sign */
#define __builtin_btg(pointer, bit) (*(pointer) ^= 1u << (bit))
#define TP_FIND_BIT(instruction, word)                             \
  ({                                                               \
    int __v;                                                       \
    __asm__(instruction " %1, %0" : "=r"(__v) : "r"((int)(word))); \
    __v;                                                           \
  })
#define __builtin_ff1l(word) TP_FIND_BIT("ff1l", word)
#define __builtin_ff1r(word) TP_FIND_BIT("ff1r", word)
#define __builtin_fbcl(word) TP_FIND_BIT("fbcl", word)

/* The DSP unit. An `acc` is a variable in an accumulator, register int x asm("A"), and so is the result of
 * those that give one. x and y: address of the pointer to fetch from, place of the value, step; null pointers
 * fetch nothing. back: place for the other accumulator, rounded. */
extern int __builtin_addab(int acc, int other_acc);
extern int __builtin_subab(int acc, int other_acc);
extern int __builtin_add(int acc, int value, int shift);
extern int __builtin_lac(int value, int shift);
extern int __builtin_clr(void);
extern int __builtin_clr_prefetch(int** x, int* x_value, int x_step, int** y, int* y_value, int y_step,
                                  int* back, int other_acc);
extern int __builtin_mac(int acc, int a, int b, int** x, int* x_value, int x_step, int** y, int* y_value,
                         int y_step, int* back, int other_acc);
extern int __builtin_msc(int acc, int a, int b, int** x, int* x_value, int x_step, int** y, int* y_value,
                         int y_step, int* back, int other_acc);
extern int __builtin_mpy(int a, int b, int** x, int* x_value, int x_step, int** y, int* y_value, int y_step);
extern int __builtin_mpyn(int a, int b, int** x, int* x_value, int x_step, int** y, int* y_value, int y_step);
extern int __builtin_ed(int square, int** x, int x_step, int** y, int y_step, int* distance);
extern int __builtin_edac(int acc, int square, int** x, int x_step, int** y, int y_step, int* distance);
extern void __builtin_movsac(int** x, int* x_value, int x_step, int** y, int* y_value, int y_step, int* back,
                             int other_acc);
extern int __builtin_sac(int acc, int shift);
extern int __builtin_sacr(int acc, int shift);
extern int __builtin_sftac(int acc, int shift);


#define TP_BUILTIN static __inline__ __attribute__((always_inline, unused))

TP_BUILTIN int tp_divmodsd(long __a, int __b, int* __rest) {
  *__rest = (int)(__a % __b);
  return (int)(__a / __b);
}

TP_BUILTIN unsigned tp_divmodud(unsigned long __a, unsigned __b, unsigned* __rest) {
  *__rest = (unsigned)(__a % __b);
  return (unsigned)(__a / __b);
}


#undef TP_BUILTIN

#endif
