/* SPDX-License-Identifier: MIT
 * All that programs may call. The library is compiled with hidden symbols; what is declared here is exported.
 */
#ifndef PROGRAMS_CONTROLLER_C_PUBLIC_H
#define PROGRAMS_CONTROLLER_C_PUBLIC_H

#pragma GCC visibility push(default)
#include <device/accelerometer.h>
#include <device/camera.h>
#include <device/compass.h>
#include <device/differential_wheels.h>
#include <device/distance_sensor.h>
#include <device/emitter.h>
#include <device/gps.h>
#include <device/gyro.h>
#include <device/led.h>
#include <device/light_sensor.h>
#include <device/microphone.h>
#include <device/receiver.h>
#include <device/robot.h>
#include <device/speaker.h>
#include <device/supervisor.h>
#include <device/touch_sensor.h>
#include <time.h>
#include <twinpuck/program.h>
#include <webots/accelerometer.h>
#include <webots/altimeter.h>
#include <webots/brake.h>
#include <webots/camera.h>
#include <webots/compass.h>
#include <webots/connector.h>
#include <webots/console.h>
#include <webots/device.h>
#include <webots/differential_wheels.h>
#include <webots/display.h>
#include <webots/distance_sensor.h>
#include <webots/emitter.h>
#include <webots/gps.h>
#include <webots/gyro.h>
#include <webots/inertial_unit.h>
#include <webots/joystick.h>
#include <webots/keyboard.h>
#include <webots/led.h>
#include <webots/lidar.h>
#include <webots/light_sensor.h>
#include <webots/microphone.h>
#include <webots/motor.h>
#include <webots/mouse.h>
#include <webots/pen.h>
#include <webots/position_sensor.h>
#include <webots/radar.h>
#include <webots/radio.h>
#include <webots/range_finder.h>
#include <webots/receiver.h>
#include <webots/remote_control.h>
#include <webots/robot.h>
#include <webots/robot_window.h>
#include <webots/robot_wwi.h>
#include <webots/servo.h>
#include <webots/skin.h>
#include <webots/speaker.h>
#include <webots/supervisor.h>
#include <webots/touch_sensor.h>
#include <webots/utils/default_robot_window.h>
#include <webots/utils/system.h>
#include <webots/vacuum_gripper.h>
#pragma GCC visibility pop

#endif
