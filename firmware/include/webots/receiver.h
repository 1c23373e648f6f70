/* SPDX-License-Identifier: MIT
 * Receiver of packets, device "receiver". Every robot has one, with a channel of 1; the world file may add
 * others or change it ([[robot.device]]). In the simulator only.
 */
#ifndef WB_RECEIVER_H
#define WB_RECEIVER_H

#include "types.h"

TP_C_BEGIN

/** Period in ms, 1 to 32767, counted in whole robot steps; 0 or less disables. The first value is there one
 * period later. Does not block. */
void wb_receiver_enable(WbDeviceTag tag, int sampling_period);
void wb_receiver_disable(WbDeviceTag tag);

/** ms; 0 when disabled. */
int wb_receiver_get_sampling_period(WbDeviceTag tag);

/** Packets that have arrived and not been dropped; the queue grows once a period and holds 4096 bytes with 8
 * bytes for each packet. What does not fit is lost. */
int wb_receiver_get_queue_length(WbDeviceTag tag);

/** Drops the packet at the head. */
void wb_receiver_next_packet(WbDeviceTag tag);

/** Bytes and address of the packet at the head, valid until wb_receiver_next_packet(); 0 and null when the
 * queue is empty. */
int wb_receiver_get_data_size(WbDeviceTag tag);
const void* wb_receiver_get_data(WbDeviceTag tag);

/** Of the packet at the head: 1 / d2 with d in m. */
double wb_receiver_get_signal_strength(WbDeviceTag tag);

/** Of the packet at the head: unit vector to the sender in the robot's axes (see accelerometer.h). */
const double* wb_receiver_get_emitter_direction(WbDeviceTag tag);

/** 0 and above; -1 hears every channel. */
void wb_receiver_set_channel(WbDeviceTag tag, int channel);
int wb_receiver_get_channel(WbDeviceTag tag);

#define WB_CHANNEL_BROADCAST -1

TP_C_END

#endif
