/* SPDX-License-Identifier: MIT
 * Accelerometer, basic variant and names of before 2006.
 */
#include "a_d/e_accelerometer.h"
#include "unsimulated.h"

#define DEVICE "accelerometer"
UNSIMULATED_VOID(e_init_acc, (void))
UNSIMULATED_VOID(e_get_acc, (int *x, int *y, int *z))

void InitAcc(void);
void GetAcc(int *x, int *y, int *z);
UNSIMULATED_VOID(InitAcc, (void))
UNSIMULATED_VOID(GetAcc, (int *x, int *y, int *z))
