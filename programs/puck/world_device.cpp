// SPDX-License-Identifier: MIT
#include "programs/puck/world_device.h"

#include "firmware/include/webots/nodes.h"
#include "hal_sim/board/packet_devices.h"
#include "programs/puck/ranging.h"

namespace programs {

WorldDevice world_device(const sim::DeviceDesc& d) {
  switch (d.kind) {
    case sim::DeviceKind::Emitter:
      return {WB_NODE_EMITTER, {double(d.channel), d.range_m, board::kPacketQueueBytes}};
    case sim::DeviceKind::Receiver:
      return {WB_NODE_RECEIVER, {double(d.channel)}};
    case sim::DeviceKind::Display:
      return {WB_NODE_DISPLAY, {double(d.width), double(d.height)}};
    case sim::DeviceKind::Distance:
      return {WB_NODE_DISTANCE_SENSOR, {0, 4095, 0, 0}};
    case sim::DeviceKind::Motor:
      return {WB_NODE_ROTATIONAL_MOTOR, {10, 0}};
    case sim::DeviceKind::Camera:
      return {WB_NODE_CAMERA, {double(d.width), double(d.height), d.fov_rad, 0, 0}};
    case sim::DeviceKind::Lidar:
    case sim::DeviceKind::RangeFinder: {
      const bool is_lidar = d.kind == sim::DeviceKind::Lidar;
      return {is_lidar ? WB_NODE_LIDAR : WB_NODE_RANGE_FINDER,
              {double(d.width), double(d.height), d.fov_rad, d.near_m, d.far_m,
               is_lidar ? d.vertical_fov_rad : 0}};
    }
    case sim::DeviceKind::Gps:
      return {WB_NODE_GPS, {}};
    case sim::DeviceKind::Compass:
      return {WB_NODE_COMPASS, {}};
    case sim::DeviceKind::Inertial:
      return {WB_NODE_INERTIAL_UNIT, {}};
    case sim::DeviceKind::Gyro:
      return {WB_NODE_GYRO, {}};
    case sim::DeviceKind::Touch:
      return {WB_NODE_TOUCH_SENSOR, {0}};
    case sim::DeviceKind::Light:
      return {WB_NODE_LIGHT_SENSOR, {}};
    case sim::DeviceKind::Led:
      return {WB_NODE_LED, {}};
    case sim::DeviceKind::Speaker:
      return {WB_NODE_SPEAKER, {}};
    case sim::DeviceKind::Pen:
      return {WB_NODE_PEN, {}};
    case sim::DeviceKind::Position:
      return {WB_NODE_POSITION_SENSOR, {0}};
  }
  return {};
}

}  // namespace programs
