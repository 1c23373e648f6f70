// SPDX-License-Identifier: MIT
// The robot in C++, as Webots' controllers know it; see webots/robot.h. Classes are thin: each function is
// the one of C with the same name. The end of the robot is the end of its connection to the simulation.
#ifndef WB_ROBOT_HPP
#define WB_ROBOT_HPP

#include <twinpuck/program.h>
#include <webots/robot.h>
#include <webots/robot_window.h>
#include <webots/robot_wwi.h>

#include <string>
#include <vector>

#include "Accelerometer.hpp"
#include "Altimeter.hpp"
#include "Brake.hpp"
#include "Camera.hpp"
#include "Compass.hpp"
#include "Connector.hpp"
#include "Device.hpp"
#include "Display.hpp"
#include "DistanceSensor.hpp"
#include "Emitter.hpp"
#include "GPS.hpp"
#include "Gyro.hpp"
#include "InertialUnit.hpp"
#include "Joystick.hpp"
#include "Keyboard.hpp"
#include "LED.hpp"
#include "Lidar.hpp"
#include "LightSensor.hpp"
#include "Microphone.hpp"
#include "Motor.hpp"
#include "Mouse.hpp"
#include "Pen.hpp"
#include "PositionSensor.hpp"
#include "Radar.hpp"
#include "RangeFinder.hpp"
#include "Receiver.hpp"
#include "Speaker.hpp"
#include "TouchSensor.hpp"

namespace webots {

class Robot {
 public:
  typedef enum { MODE_SIMULATION = WB_MODE_SIMULATION, MODE_CROSS_COMPILATION, MODE_REMOTE_CONTROL } Mode;
  typedef enum {
    EVENT_QUIT = -1,
    EVENT_NO_EVENT = 0,
    EVENT_MOUSE_CLICK = 1,
    EVENT_MOUSE_MOVE = 2,
    EVENT_KEYBOARD = 4,
    EVENT_JOYSTICK_BUTTON = 8,
    EVENT_JOYSTICK_AXIS = 16,
    EVENT_JOYSTICK_POV = 32
  } UserInputEvent;
  // versions 5 to 8
  enum {
    KEYBOARD_END = WB_KEYBOARD_END,
    KEYBOARD_HOME,
    KEYBOARD_LEFT,
    KEYBOARD_UP,
    KEYBOARD_RIGHT,
    KEYBOARD_DOWN,
    KEYBOARD_PAGEUP = WB_KEYBOARD_PAGEUP,
    KEYBOARD_PAGEDOWN,
    KEYBOARD_KEY = WB_KEYBOARD_KEY,
    KEYBOARD_SHIFT = WB_KEYBOARD_SHIFT,
    KEYBOARD_CONTROL = WB_KEYBOARD_CONTROL,
    KEYBOARD_ALT = WB_KEYBOARD_ALT
  };

  Robot() {
    twinpuck_language(1, 0);
    wb_robot_init();
    instance() = this;
  }
  virtual ~Robot() { wb_robot_cleanup(); }
  Robot(const Robot&) = delete;
  Robot& operator=(const Robot&) = delete;
  static Robot* internalGetInstance() { return instance(); }

  virtual int step(int duration) { return wb_robot_step(duration); }
  int stepBegin(int duration) { return wb_robot_step_begin(duration); }
  int stepEnd() { return wb_robot_step_end(); }
  UserInputEvent waitForUserInputEvent(UserInputEvent event, int timeout) {
    return static_cast<UserInputEvent>(
        wb_robot_wait_for_user_input_event(static_cast<WbUserInputEvent>(event), timeout));
  }
  double getTime() const { return wb_robot_get_time(); }
  double getBasicTimeStep() const { return wb_robot_get_basic_time_step(); }
  std::string getName() const { return wb_robot_get_name(); }
  std::string getUrdf(std::string prefix = "") const { return wb_robot_get_urdf(prefix.c_str()); }
  std::string getModel() const { return wb_robot_get_model(); }
  std::string getCustomData() const { return wb_robot_get_custom_data(); }
  void setCustomData(const std::string& data) { wb_robot_set_custom_data(data.c_str()); }
  std::string getData() const { return getCustomData(); }
  void setData(const std::string& data) { setCustomData(data); }
  std::string getControllerName() const { return wb_robot_get_controller_name(); }
  std::string getControllerArguments() const { return ""; }
  Mode getMode() const { return static_cast<Mode>(wb_robot_get_mode()); }
  void setMode(Mode mode, const char* argument) {
    wb_robot_set_mode(static_cast<WbRobotMode>(mode), argument);
  }
  bool getSynchronization() const { return wb_robot_get_synchronization(); }
  bool getSupervisor() const { return wb_robot_get_supervisor(); }
  std::string getProjectPath() const { return wb_robot_get_project_path(); }
  std::string getWorldPath() const { return wb_robot_get_world_path(); }
  int getType() const { return wb_robot_get_type(); }

  virtual void batterySensorEnable(int period) { wb_robot_battery_sensor_enable(period); }
  virtual void batterySensorDisable() { wb_robot_battery_sensor_disable(); }
  int batterySensorGetSamplingPeriod() const { return wb_robot_battery_sensor_get_sampling_period(); }
  double batterySensorGetValue() const { return wb_robot_battery_sensor_get_value(); }

  Keyboard* getKeyboard() { return &keyboard_; }
  Mouse* getMouse() { return &mouse_; }
  Joystick* getJoystick() { return &joystick_; }
  // versions 5 to 8; 0: no key
  virtual void keyboardEnable(int period) { wb_robot_keyboard_enable(period); }
  virtual void keyboardDisable() { wb_robot_keyboard_disable(); }
  int keyboardGetKey() const { return static_cast<int>(wb_robot_keyboard_get_key()); }

  void* windowCustomFunction(void* argument) { return wb_robot_window_custom_function(argument); }
  void wwiSend(const char* data, int size) { wb_robot_wwi_send(data, size); }
  void wwiSendText(const std::string& text) { wb_robot_wwi_send_text(text.c_str()); }
  const char* wwiReceive(int* size) { return wb_robot_wwi_receive(size); }
  std::string wwiReceiveText() {
    const char* text = wb_robot_wwi_receive_text();
    return text ? text : "";
  }

  // devices: null, with a warning, when the robot has none of that name; null for one of another kind
  int getNumberOfDevices() const { return wb_robot_get_number_of_devices(); }
  Device* getDeviceByIndex(int index) { return getDeviceFromTag(wb_robot_get_device_by_index(index)); }
  Device* getDevice(const std::string& name) { return getDeviceFromTag(wb_robot_get_device(name.c_str())); }
  static Device* getDeviceFromTag(int tag) {
    switch (wb_device_get_node_type(static_cast<WbDeviceTag>(tag))) {
      case WB_NODE_ACCELEROMETER:
        return of_tag<Accelerometer>(tag);
      case WB_NODE_ALTIMETER:
        return of_tag<Altimeter>(tag);
      case WB_NODE_BRAKE:
        return of_tag<Brake>(tag);
      case WB_NODE_CAMERA:
        return of_tag<Camera>(tag);
      case WB_NODE_COMPASS:
        return of_tag<Compass>(tag);
      case WB_NODE_CONNECTOR:
        return of_tag<Connector>(tag);
      case WB_NODE_DISPLAY:
        return of_tag<Display>(tag);
      case WB_NODE_DISTANCE_SENSOR:
        return of_tag<DistanceSensor>(tag);
      case WB_NODE_EMITTER:
        return of_tag<Emitter>(tag);
      case WB_NODE_GPS:
        return of_tag<GPS>(tag);
      case WB_NODE_GYRO:
        return of_tag<Gyro>(tag);
      case WB_NODE_INERTIAL_UNIT:
        return of_tag<InertialUnit>(tag);
      case WB_NODE_LED:
        return of_tag<LED>(tag);
      case WB_NODE_LIDAR:
        return of_tag<Lidar>(tag);
      case WB_NODE_LIGHT_SENSOR:
        return of_tag<LightSensor>(tag);
      case WB_NODE_MICROPHONE:
        return of_tag<Microphone>(tag);
      case WB_NODE_ROTATIONAL_MOTOR:
      case WB_NODE_LINEAR_MOTOR:
        return of_tag<Motor>(tag);
      case WB_NODE_PEN:
        return of_tag<Pen>(tag);
      case WB_NODE_POSITION_SENSOR:
        return of_tag<PositionSensor>(tag);
      case WB_NODE_RADAR:
        return of_tag<Radar>(tag);
      case WB_NODE_RANGE_FINDER:
        return of_tag<RangeFinder>(tag);
      case WB_NODE_RECEIVER:
        return of_tag<Receiver>(tag);
      case WB_NODE_SPEAKER:
        return of_tag<Speaker>(tag);
      case WB_NODE_TOUCH_SENSOR:
        return of_tag<TouchSensor>(tag);
      default:
        return of_tag<Device>(tag);
    }
  }
  static int getDeviceTypeFromTag(int tag) { return wb_device_get_node_type(static_cast<WbDeviceTag>(tag)); }
  static std::string getDeviceNameFromTag(int tag) {
    return wb_device_get_name(static_cast<WbDeviceTag>(tag));
  }
  static int getDeviceTagFromIndex(int index) { return wb_robot_get_device_by_index(index); }
  static int getDeviceTagFromName(const std::string& name) { return wb_robot_get_device(name.c_str()); }
  Accelerometer* getAccelerometer(const std::string& name) { return get<Accelerometer>(name); }
  Altimeter* getAltimeter(const std::string& name) { return get<Altimeter>(name); }
  Brake* getBrake(const std::string& name) { return get<Brake>(name); }
  Camera* getCamera(const std::string& name) { return get<Camera>(name); }
  Compass* getCompass(const std::string& name) { return get<Compass>(name); }
  Connector* getConnector(const std::string& name) { return get<Connector>(name); }
  Display* getDisplay(const std::string& name) { return get<Display>(name); }
  DistanceSensor* getDistanceSensor(const std::string& name) { return get<DistanceSensor>(name); }
  Emitter* getEmitter(const std::string& name) { return get<Emitter>(name); }
  GPS* getGPS(const std::string& name) { return get<GPS>(name); }
  Gyro* getGyro(const std::string& name) { return get<Gyro>(name); }
  InertialUnit* getInertialUnit(const std::string& name) { return get<InertialUnit>(name); }
  LED* getLED(const std::string& name) { return get<LED>(name); }
  Lidar* getLidar(const std::string& name) { return get<Lidar>(name); }
  LightSensor* getLightSensor(const std::string& name) { return get<LightSensor>(name); }
  Microphone* getMicrophone(const std::string& name) { return get<Microphone>(name); }
  Motor* getMotor(const std::string& name) { return get<Motor>(name); }
  Pen* getPen(const std::string& name) { return get<Pen>(name); }
  PositionSensor* getPositionSensor(const std::string& name) { return get<PositionSensor>(name); }
  Radar* getRadar(const std::string& name) { return get<Radar>(name); }
  RangeFinder* getRangeFinder(const std::string& name) { return get<RangeFinder>(name); }
  Receiver* getReceiver(const std::string& name) { return get<Receiver>(name); }
  Speaker* getSpeaker(const std::string& name) { return get<Speaker>(name); }
  TouchSensor* getTouchSensor(const std::string& name) { return get<TouchSensor>(name); }

 private:
  static Robot*& instance() {
    static Robot* robot = 0;
    return robot;
  }
  template <class T>
  static T* of_tag(int tag) {
    return Device::of_tag<T>(static_cast<WbDeviceTag>(tag));
  }
  template <class T>
  static T* get(const std::string& name) {
    return of_tag<T>(wb_robot_get_device(name.c_str()));
  }

  Keyboard keyboard_;
  Mouse mouse_;
  Joystick joystick_;
};

}  // namespace webots

#endif
