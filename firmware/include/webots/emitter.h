/* SPDX-License-Identifier: MIT
 * Emitter of packets, device "emitter". Every robot has one, with a channel of 1 and no limit of range; the
 * world file may add others or change it ([[robot.device]]). In the simulator only.
 */
#ifndef WB_EMITTER_H
#define WB_EMITTER_H

#include "types.h"

#ifndef WB_CHANNEL_BROADCAST
#define WB_CHANNEL_BROADCAST -1
#endif

TP_C_BEGIN

/** Sends `size` bytes (1 to 4088) as one packet. It leaves at the end of the world's tick and arrives whole
 * and in order. Returns 1, or 0 when the emitter's queue of 4096 bytes is full. Does not block. */
int wb_emitter_send(WbDeviceTag tag, const void* data, int size);

/** 0 and above, or WB_CHANNEL_BROADCAST. */
void wb_emitter_set_channel(WbDeviceTag tag, int channel);
int wb_emitter_get_channel(WbDeviceTag tag);

/** m; negative is unlimited. Not above the world file's range, when that is not negative. */
void wb_emitter_set_range(WbDeviceTag tag, double range);
double wb_emitter_get_range(WbDeviceTag tag);

/** Bytes: 4096. */
int wb_emitter_get_buffer_size(WbDeviceTag tag);

TP_C_END

#endif
