/* SPDX-License-Identifier: MIT
 * Loudspeaker, device "speaker".
 * Interface of 2005 to 2008.
 */
#ifndef DEVICE_SPEAKER_H
#define DEVICE_SPEAKER_H

#include "robot_types.h"

TP_C_BEGIN

/** Samples of 16 bits, `size` bytes. The e-puck plays stored sounds only (codec/e_sound.h): a warning; on the robot
 *  a program that calls this does not link. */
void speaker_emit_sample(DeviceTag tag, const void* data, int size);

TP_C_END

#endif
