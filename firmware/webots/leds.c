/* SPDX-License-Identifier: MIT
 * LEDs, by either interface. What is on is remembered, since starting the camera clears all ports.
 */
#include "core.h"
#include "device/led.h"
#include "webots/led.h"

static void set(WbDeviceTag tag, long value, const char* function) {
  struct webots_device* d = webots_device_of(tag, WB_NODE_LED, function);
  if (!d) return;
  d->value = (float)value;
  webots_led(d->index, value != 0);
}

void wb_led_set(WbDeviceTag tag, long value) { set(tag, value, "wb_led_set"); }

int wb_led_get(WbDeviceTag tag) {
  const struct webots_device* d = webots_device_of(tag, WB_NODE_LED, "wb_led_get");
  return d ? (int)(long)d->value : 0;
}

void led_set(DeviceTag tag, long value) { set(tag, value, "led_set"); }
