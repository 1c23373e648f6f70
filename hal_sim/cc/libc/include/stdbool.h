/* SPDX-License-Identifier: MIT
 * Firmware libc: bool. */
#ifndef TP_LIBC_STDBOOL_H
#define TP_LIBC_STDBOOL_H
#ifndef __cplusplus
#define bool _Bool
#define true 1
#define false 0
#endif
#define __bool_true_false_are_defined 1
#endif
