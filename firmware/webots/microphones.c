/* SPDX-License-Identifier: MIT
 * Microphones, by either interface: the samples of the ADC scan, as signed 16-bit sound.
 */
#include "a_d/advance_ad_scan/e_ad_conv.h"
#include "a_d/advance_ad_scan/e_micro.h"
#include "core.h"
#include "device/microphone.h"
#include "webots/microphone.h"

#define MICROPHONES 3
#define ZERO_COUNTS 2048
#define SCALE 16 /* 12 bits of the converter to 16 */

/* the library defines it and declares it nowhere */
void e_get_micro_last_values(int micro_id, int* result, unsigned samples_nb);

static int samples[MICROPHONES][MIC_SAMP_NB];

static void sample(struct webots_device* device) {
  int* to = samples[device->index];
  int i;
  e_get_micro_last_values(device->index, to, MIC_SAMP_NB);
  for (i = 0; i < MIC_SAMP_NB; i++) to[i] = (to[i] - ZERO_COUNTS) * SCALE;
}

static struct webots_device* microphone(WbDeviceTag tag, const char* function) {
  return webots_device_of(tag, WB_NODE_MICROPHONE, function);
}

void wb_microphone_enable(WbDeviceTag tag, int sampling_period) {
  struct webots_device* d = microphone(tag, "wb_microphone_enable");
  if (d) webots_enable(d, sampling_period, sample);
}
void wb_microphone_disable(WbDeviceTag tag) { wb_microphone_enable(tag, 0); }
int wb_microphone_get_sampling_period(WbDeviceTag tag) {
  const struct webots_device* d = microphone(tag, "wb_microphone_get_sampling_period");
  return d ? d->period : 0;
}
const void* wb_microphone_get_sample_data(WbDeviceTag tag) {
  const struct webots_device* d = microphone(tag, "wb_microphone_get_sample_data");
  return d && d->fresh ? samples[d->index] : 0;
}
int wb_microphone_get_sample_size(WbDeviceTag tag) {
  return wb_microphone_get_sample_data(tag) ? MIC_SAMP_NB * 2 : 0;
}

void microphone_enable(DeviceTag tag, int ms) { wb_microphone_enable(tag, ms); }
void microphone_disable(DeviceTag tag) { wb_microphone_disable(tag); }
const void* microphone_get_sample_data(DeviceTag tag) { return wb_microphone_get_sample_data(tag); }
int microphone_get_sample_size(DeviceTag tag) { return wb_microphone_get_sample_size(tag); }
