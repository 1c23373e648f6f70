/* SPDX-License-Identifier: MIT
 * Microphones mic0 right, mic1 left, mic2 behind.
 */
#ifndef WB_MICROPHONE_H
#define WB_MICROPHONE_H

#include "types.h"

TP_C_BEGIN

/** Period in ms, 1 to 32767, counted in whole robot steps; 0 or less disables. The first value is there one
 * period later. Does not block. */
void wb_microphone_enable(WbDeviceTag tag, int sampling_period);
void wb_microphone_disable(WbDeviceTag tag);

/** ms; 0 when disabled. */
int wb_microphone_get_sampling_period(WbDeviceTag tag);

/** The newest samples, signed 16 bits as in Webots (counts of the converter minus 2048, times 16), 16384 a
 * second: 100 of them, the oldest first, once a period. Null before the first period is over. Does not block.
 */
const void* wb_microphone_get_sample_data(WbDeviceTag tag);

/** Bytes at the address above: 200. */
int wb_microphone_get_sample_size(WbDeviceTag tag);

TP_C_END

#endif
