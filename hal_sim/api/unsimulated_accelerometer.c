/* SPDX-License-Identifier: MIT
 * Accelerometer, advanced variant. The basic variant has a file of its own, since its
 * e_get_acc() has other arguments.
 */
#include "a_d/advance_ad_scan/e_acc.h"
#include "unsimulated.h"
#define DEVICE "accelerometer"

UNSIMULATED(int, e_get_acc, (unsigned int captor))
UNSIMULATED(int, e_get_acc_filtered, (unsigned int captor, unsigned int filter_size))
UNSIMULATED_STRUCT(TypeAccSpheric, e_read_acc_spheric, (void))
UNSIMULATED(float, e_read_orientation, (void))
UNSIMULATED(float, e_read_inclination, (void))
UNSIMULATED(float, e_read_acc, (void))
UNSIMULATED_STRUCT(TypeAccRaw, e_read_acc_xyz, (void))
UNSIMULATED(int, e_read_acc_x, (void))
UNSIMULATED(int, e_read_acc_y, (void))
UNSIMULATED(int, e_read_acc_z, (void))
UNSIMULATED_VOID(e_acc_calibr, (void))
UNSIMULATED_VOID(e_display_angle, (void))
