/* SPDX-License-Identifier: MIT
 * Brakes. No e-puck has one here: no device of the kind exists, so each function warns of its tag, and
 * answers 0.
 */
#ifndef WB_BRAKE_H
#define WB_BRAKE_H

#include <webots/types.h>

TP_C_BEGIN

void wb_brake_set_damping_constant(WbDeviceTag tag, double damping_constant);
WbJointType wb_brake_get_type(WbDeviceTag tag);
WbDeviceTag wb_brake_get_motor(WbDeviceTag tag);
WbDeviceTag wb_brake_get_position_sensor(WbDeviceTag tag);

TP_C_END

#endif
