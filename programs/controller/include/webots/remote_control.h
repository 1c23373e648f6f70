/* SPDX-License-Identifier: MIT
 * The remote control library of a real robot. There is none: NULL.
 */
#ifndef WB_REMOTE_CONTROL_H
#define WB_REMOTE_CONTROL_H

#include <webots/camera_recognition_object.h>
#include <webots/radar_target.h>
#include <webots/types.h>

TP_C_BEGIN

void* wb_remote_control_custom_function(void* argument);

TP_C_END

#endif
