/* SPDX-License-Identifier: MIT
 * Connectors. No e-puck has one here: no device of the kind exists, so each function warns of its tag, and
 * answers 0.
 */
#ifndef WB_CONNECTOR_H
#define WB_CONNECTOR_H

#include <webots/types.h>

TP_C_BEGIN

void wb_connector_enable_presence(WbDeviceTag tag, int sampling_period);
void wb_connector_disable_presence(WbDeviceTag tag);
int wb_connector_get_presence_sampling_period(WbDeviceTag tag);
int wb_connector_get_presence(WbDeviceTag tag);
bool wb_connector_is_locked(WbDeviceTag tag);
void wb_connector_lock(WbDeviceTag tag);
void wb_connector_unlock(WbDeviceTag tag);

TP_C_END

#endif
