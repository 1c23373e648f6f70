/* SPDX-License-Identifier: MIT
 * Skins. No e-puck has one here: no device of the kind exists, so each function warns of its tag, and answers
 * 0.
 */
#ifndef WB_SKIN_H
#define WB_SKIN_H

#include <webots/types.h>

TP_C_BEGIN

void wb_skin_set_bone_orientation(WbDeviceTag tag, int index, const double orientation[4], bool absolute);
void wb_skin_set_bone_position(WbDeviceTag tag, int index, const double position[3], bool absolute);
int wb_skin_get_bone_count(WbDeviceTag tag);
const char* wb_skin_get_bone_name(WbDeviceTag tag, int index);
const double* wb_skin_get_bone_orientation(WbDeviceTag tag, int index, bool absolute);
const double* wb_skin_get_bone_position(WbDeviceTag tag, int index, bool absolute);

TP_C_END

#endif
