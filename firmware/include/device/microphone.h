/* SPDX-License-Identifier: MIT
 * Microphones mic0 to mic2.
 * Interface of 2005 to 2008; webots/microphone.h has the present one and says more.
 */
#ifndef DEVICE_MICROPHONE_H
#define DEVICE_MICROPHONE_H

#include "robot_types.h"

TP_C_BEGIN

/** Period in ms, 1 to 32767, counted in whole robot steps; 0 or less disables. The first value is there one
 * period later. Does not block. */
void microphone_enable(DeviceTag tag, int ms);
void microphone_disable(DeviceTag tag);

/** The newest 100 samples of 16 bits; null before the first period is over. Does not block. */
const void* microphone_get_sample_data(DeviceTag tag);

/** Bytes at the address above: 200. */
int microphone_get_sample_size(DeviceTag tag);

TP_C_END

#endif
