/* SPDX-License-Identifier: MIT
 * What a device is.
 */
#ifndef WB_DEVICE_H
#define WB_DEVICE_H

#include "nodes.h"
#include "types.h"

TP_C_BEGIN

/** Name of the device; empty for tag 0. */
const char* wb_device_get_name(WbDeviceTag tag);

/** The name again: e-puck's devices have no other model. */
const char* wb_device_get_model(WbDeviceTag tag);

/** Kind of the device; WB_NODE_NO_NODE for tag 0. */
WbNodeType wb_device_get_node_type(WbDeviceTag tag);
WbNodeType wb_device_get_type(WbDeviceTag tag);

TP_C_END

#endif
