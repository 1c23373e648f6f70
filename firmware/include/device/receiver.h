/* SPDX-License-Identifier: MIT
 * Receiver of packets, device "receiver". In the simulator only.
 * Interface of 2005 to 2008; webots/receiver.h has the present one and says more.
 */
#ifndef DEVICE_RECEIVER_H
#define DEVICE_RECEIVER_H

#include "robot_types.h"

TP_C_BEGIN

/** Period in ms, 1 to 32767, counted in whole robot steps; 0 or less disables. The first value is there one
 * period later. Does not block. */
void receiver_enable(DeviceTag tag, int ms);
void receiver_disable(DeviceTag tag);

/** Packets that have arrived and not been dropped. */
int receiver_get_queue_length(DeviceTag tag);

/** Drops the packet at the head. */
void receiver_next_packet(DeviceTag tag);

/** Bytes and address of the packet at the head, valid until receiver_next_packet(); 0 and null when the queue
 * is empty. */
int receiver_get_data_size(DeviceTag tag);
const void* receiver_get_data(DeviceTag tag);

/** Of the packet at the head: 1 / d2 with d in m, and the unit vector to the sender in the robot's axes. */
float receiver_get_signal_strength(DeviceTag tag);
const float* receiver_get_emitter_direction(DeviceTag tag);

/** 0 and above; -1 hears every channel. */
void receiver_set_channel(DeviceTag tag, int channel);
int receiver_get_channel(DeviceTag tag);

TP_C_END

#endif
