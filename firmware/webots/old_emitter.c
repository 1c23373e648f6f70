/* SPDX-License-Identifier: MIT
 * Emitters of versions before 5.1.10: a buffer that is filled and sent. In a file of its own, so that only programs
 * that use the buffer carry it; on the robot it holds what the turret sends at once.
 */
#include "core.h"
#include "device/emitter.h"

#define BUFFER_BYTES 108

static char buffer[BUFFER_BYTES];

void* emitter_get_buffer(DeviceTag tag) { return (void)tag, buffer; }
int emitter_send(DeviceTag tag, int size) {
  return emitter_send_packet(tag, buffer, size > BUFFER_BYTES ? BUFFER_BYTES : size);
}
