// SPDX-License-Identifier: MIT
// See webots/position_sensor.h.
#ifndef WB_POSITIONSENSOR_HPP
#define WB_POSITIONSENSOR_HPP

#include <webots/position_sensor.h>
#include "Brake.hpp"
#include "Device.hpp"

namespace webots {

class Motor;

class PositionSensor : public Device {
 public:
  explicit PositionSensor(WbDeviceTag tag) : Device(tag) {}
  explicit PositionSensor(const std::string& name) : Device(name) {}
  static bool is_kind(int kind) { return kind == WB_NODE_POSITION_SENSOR; }
  virtual void enable(int samplingPeriod) { wb_position_sensor_enable(tag(), samplingPeriod); }
  virtual void disable() { wb_position_sensor_disable(tag()); }
  int getSamplingPeriod() const { return wb_position_sensor_get_sampling_period(tag()); }
  typedef enum { ROTATIONAL = 0, LINEAR } Type;
  double getValue() const { return wb_position_sensor_get_value(tag()); }
  Type getType() const { return static_cast<Type>(wb_position_sensor_get_type(tag())); }
  Motor* getMotor();
  Brake* getBrake();
};

}  // namespace webots

#include "Motor.hpp"

#endif
