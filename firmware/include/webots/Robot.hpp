// SPDX-License-Identifier: MIT
// The robot in C++, as Webots' controllers know it; see webots/robot.h. Classes are thin: each function is the
// one of C with the same name.
#ifndef WB_ROBOT_HPP
#define WB_ROBOT_HPP

#include <string>
#include <vector>

#include "Accelerometer.hpp"
#include "Camera.hpp"
#include "Compass.hpp"
#include "Display.hpp"
#include "DistanceSensor.hpp"
#include "Emitter.hpp"
#include "GPS.hpp"
#include "Gyro.hpp"
#include "InertialUnit.hpp"
#include "Keyboard.hpp"
#include "LED.hpp"
#include "LightSensor.hpp"
#include "Microphone.hpp"
#include "Motor.hpp"
#include "PositionSensor.hpp"
#include "Receiver.hpp"
#include "Speaker.hpp"
#include "TouchSensor.hpp"
#include "robot.h"

namespace webots {

class Robot {
 public:
  enum { MODE_SIMULATION = WB_MODE_SIMULATION, MODE_CROSS_COMPILATION, MODE_REMOTE_CONTROL };
  enum {
    KEYBOARD_END = WB_KEYBOARD_END,
    KEYBOARD_HOME,
    KEYBOARD_LEFT,
    KEYBOARD_UP,
    KEYBOARD_RIGHT,
    KEYBOARD_DOWN
  };

  Robot() { wb_robot_init(); }
  virtual ~Robot() {
    for (Device* device : devices_) delete device;
  }
  Robot(const Robot&) = delete;
  Robot& operator=(const Robot&) = delete;

  virtual int step(int duration) { return wb_robot_step(duration); }
  int stepBegin(int duration) { return wb_robot_step_begin(duration); }
  int stepEnd() { return wb_robot_step_end(); }
  double getTime() const { return wb_robot_get_time(); }
  double getBasicTimeStep() const { return wb_robot_get_basic_time_step(); }
  std::string getName() const { return wb_robot_get_name(); }
  std::string getModel() const { return wb_robot_get_model(); }
  std::string getCustomData() const { return wb_robot_get_custom_data(); }
  void setCustomData(const std::string& data) { wb_robot_set_custom_data(data.c_str()); }
  std::string getData() const { return getCustomData(); }
  void setData(const std::string& data) { setCustomData(data); }
  int getMode() const { return wb_robot_get_mode(); }
  bool getSynchronization() const { return wb_robot_get_synchronization(); }
  bool getSupervisor() const { return wb_robot_get_supervisor(); }
  std::string getProjectPath() const { return wb_robot_get_project_path(); }
  std::string getWorldPath() const { return wb_robot_get_world_path(); }
  int getType() const { return wb_robot_get_type(); }

  void batterySensorEnable(int period) { wb_robot_battery_sensor_enable(period); }
  void batterySensorDisable() { wb_robot_battery_sensor_disable(); }
  int batterySensorGetSamplingPeriod() const { return wb_robot_battery_sensor_get_sampling_period(); }
  double batterySensorGetValue() const { return wb_robot_battery_sensor_get_value(); }

  Keyboard* getKeyboard() { return &keyboard_; }
  void keyboardEnable(int period) { wb_robot_keyboard_enable(period); }
  void keyboardDisable() { wb_robot_keyboard_disable(); }
  long keyboardGetKey() const { return wb_robot_keyboard_get_key(); }

  int getNumberOfDevices() const { return wb_robot_get_number_of_devices(); }
  Device* getDeviceByIndex(int index) { return of_tag(wb_robot_get_device_by_index(index)); }
  /// The device of that name; NULL, with a warning on the console, when the robot has none.
  Device* getDevice(const std::string& name) { return of_tag(wb_robot_get_device(name.c_str())); }
  Accelerometer* getAccelerometer(const std::string& name) { return get<Accelerometer>(name); }
  Camera* getCamera(const std::string& name) { return get<Camera>(name); }
  Compass* getCompass(const std::string& name) { return get<Compass>(name); }
  Display* getDisplay(const std::string& name) { return get<Display>(name); }
  DistanceSensor* getDistanceSensor(const std::string& name) { return get<DistanceSensor>(name); }
  Emitter* getEmitter(const std::string& name) { return get<Emitter>(name); }
  GPS* getGPS(const std::string& name) { return get<GPS>(name); }
  Gyro* getGyro(const std::string& name) { return get<Gyro>(name); }
  InertialUnit* getInertialUnit(const std::string& name) { return get<InertialUnit>(name); }
  LED* getLED(const std::string& name) { return get<LED>(name); }
  LightSensor* getLightSensor(const std::string& name) { return get<LightSensor>(name); }
  Microphone* getMicrophone(const std::string& name) { return get<Microphone>(name); }
  Motor* getMotor(const std::string& name) { return get<Motor>(name); }
  PositionSensor* getPositionSensor(const std::string& name) { return get<PositionSensor>(name); }
  Receiver* getReceiver(const std::string& name) { return get<Receiver>(name); }
  Speaker* getSpeaker(const std::string& name) { return get<Speaker>(name); }
  TouchSensor* getTouchSensor(const std::string& name) { return get<TouchSensor>(name); }

 private:
  /// One object for each device, of the class that its kind has.
  Device* of_tag(WbDeviceTag tag) {
    if (tag == 0) return nullptr;
    for (Device* device : devices_)
      if (device->getTag() == tag) return device;
    Device* made = make(tag);
    if (made) devices_.push_back(made);
    return made;
  }
  static Device* make(WbDeviceTag tag) {
    switch (wb_device_get_node_type(tag)) {
      case WB_NODE_ACCELEROMETER:
        return new Accelerometer(tag);
      case WB_NODE_CAMERA:
        return new Camera(tag);
      case WB_NODE_COMPASS:
        return new Compass(tag);
      case WB_NODE_DISPLAY:
        return new Display(tag);
      case WB_NODE_DISTANCE_SENSOR:
        return new DistanceSensor(tag);
      case WB_NODE_EMITTER:
        return new Emitter(tag);
      case WB_NODE_GPS:
        return new GPS(tag);
      case WB_NODE_GYRO:
        return new Gyro(tag);
      case WB_NODE_INERTIAL_UNIT:
        return new InertialUnit(tag);
      case WB_NODE_LED:
        return new LED(tag);
      case WB_NODE_LIGHT_SENSOR:
        return new LightSensor(tag);
      case WB_NODE_MICROPHONE:
        return new Microphone(tag);
      case WB_NODE_ROTATIONAL_MOTOR:
        return new Motor(tag);
      case WB_NODE_POSITION_SENSOR:
        return new PositionSensor(tag);
      case WB_NODE_RECEIVER:
        return new Receiver(tag);
      case WB_NODE_SPEAKER:
        return new Speaker(tag);
      case WB_NODE_TOUCH_SENSOR:
        return new TouchSensor(tag);
      default:
        return new Device(tag);
    }
  }
  template <class T>
  T* get(const std::string& name) {
    return dynamic_cast<T*>(getDevice(name));
  }

  std::vector<Device*> devices_;
  Keyboard keyboard_;
};

}  // namespace webots

#endif
