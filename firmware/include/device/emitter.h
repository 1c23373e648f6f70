/* SPDX-License-Identifier: MIT
 * Emitter of packets, device "emitter". In the simulator only.
 * Interface of 2005 to 2008; webots/emitter.h has the present one and says more.
 */
#ifndef DEVICE_EMITTER_H
#define DEVICE_EMITTER_H

#include "robot_types.h"

TP_C_BEGIN

/** Sends `size` bytes as one packet. Returns 1, or 0 when the queue is full. Does not block. */
int emitter_send_packet(DeviceTag tag, const void* data, int size);

/** Before 5.1.10: fill the buffer of 1024 bytes, then send its first `size` bytes. */
void* emitter_get_buffer(DeviceTag tag);
int emitter_send(DeviceTag tag, int size);

/** 0 and above; -1 to everybody. */
void emitter_set_channel(DeviceTag tag, int channel);
int emitter_get_channel(DeviceTag tag);

/** m; negative is unlimited. */
void emitter_set_range(DeviceTag tag, float range);
float emitter_get_range(DeviceTag tag);

TP_C_END

#endif
