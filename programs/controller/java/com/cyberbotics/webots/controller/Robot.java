// SPDX-License-Identifier: MIT
package com.cyberbotics.webots.controller;

import java.util.HashMap;
import java.util.Map;

/**
 * The robot of this program. Make one, find its devices, then step:
 *
 * <pre>
 *   Robot robot = new Robot();
 *   int timeStep = (int) robot.getBasicTimeStep();
 *   DistanceSensor sensor = robot.getDistanceSensor("ps0");
 *   sensor.enable(timeStep);
 *   while (robot.step(timeStep) != -1) System.out.println(sensor.getValue());
 * </pre>
 */
public class Robot {
  public static final int EVENT_QUIT = -1;
  public static final int EVENT_NO_EVENT = 0;
  public static final int EVENT_MOUSE_CLICK = 1;
  public static final int EVENT_MOUSE_MOVE = 2;
  public static final int EVENT_KEYBOARD = 4;
  public static final int EVENT_JOYSTICK_BUTTON = 8;
  public static final int EVENT_JOYSTICK_AXIS = 16;
  public static final int EVENT_JOYSTICK_POV = 32;
  public static final int MODE_SIMULATION = 0;
  public static final int MODE_CROSS_COMPILATION = 1;
  public static final int MODE_REMOTE_CONTROL = 2;

  private static final Map<Integer, Device> devices = new HashMap<>();
  private static final Keyboard keyboard = new Keyboard();

  /** Connects to the simulator; a program that was not started by it is told so and ends. */
  public Robot() {
    Native.robot_init();
  }

  /** The object of a device, one for each; null: 0. */
  static Device deviceOf(int tag) {
    return tag == 0 ? null : devices.computeIfAbsent(tag, Robot::make);
  }

  private static Device make(int tag) {
    switch (Native.device_get_node_type(tag)) {
      case Kinds.ACCELEROMETER:
        return new Accelerometer(tag);
      case Kinds.CAMERA:
        return new Camera(tag);
      case Kinds.COMPASS:
        return new Compass(tag);
      case Kinds.DISPLAY:
        return new Display(tag);
      case Kinds.DISTANCE_SENSOR:
        return new DistanceSensor(tag);
      case Kinds.EMITTER:
        return new Emitter(tag);
      case Kinds.GPS:
        return new GPS(tag);
      case Kinds.GYRO:
        return new Gyro(tag);
      case Kinds.INERTIAL_UNIT:
        return new InertialUnit(tag);
      case Kinds.LED:
        return new LED(tag);
      case Kinds.LIGHT_SENSOR:
        return new LightSensor(tag);
      case Kinds.MICROPHONE:
        return new Microphone(tag);
      case Kinds.LINEAR_MOTOR:
      case Kinds.ROTATIONAL_MOTOR:
        return new Motor(tag);
      case Kinds.POSITION_SENSOR:
        return new PositionSensor(tag);
      case Kinds.RECEIVER:
        return new Receiver(tag);
      case Kinds.SPEAKER:
        return new Speaker(tag);
      case Kinds.TOUCH_SENSOR:
        return new TouchSensor(tag);
      default:
        return new Device(tag);
    }
  }

  private static <T extends Device> T find(String name, Class<T> kind) {
    Device device = deviceOf(Native.robot_get_device(name));
    return kind.isInstance(device) ? kind.cast(device) : null;
  }

  /** The device of that name; always the same object. null: the robot has none, and a warning says so. */
  public Device getDevice(String name) {
    return deviceOf(Native.robot_get_device(name));
  }

  /** A device by its place, from 0 on. */
  public Device getDeviceByIndex(int index) {
    return deviceOf(Native.robot_get_device_by_index(index));
  }

  /** How many devices the robot has. */
  public int getNumberOfDevices() {
    return Native.robot_get_number_of_devices();
  }

  /** null: the robot has none of that name. */
  public Accelerometer getAccelerometer(String name) {
    return find(name, Accelerometer.class);
  }

  /** null: the robot has none of that name. */
  public Brake getBrake(String name) {
    return find(name, Brake.class);
  }

  /** null: the robot has none of that name. */
  public Camera getCamera(String name) {
    return find(name, Camera.class);
  }

  /** null: the robot has none of that name. */
  public Compass getCompass(String name) {
    return find(name, Compass.class);
  }

  /** null: the robot has none of that name. */
  public Display getDisplay(String name) {
    return find(name, Display.class);
  }

  /** null: the robot has none of that name. */
  public DistanceSensor getDistanceSensor(String name) {
    return find(name, DistanceSensor.class);
  }

  /** null: the robot has none of that name. */
  public Emitter getEmitter(String name) {
    return find(name, Emitter.class);
  }

  /** null: the robot has none of that name. */
  public GPS getGPS(String name) {
    return find(name, GPS.class);
  }

  /** null: the robot has none of that name. */
  public Gyro getGyro(String name) {
    return find(name, Gyro.class);
  }

  /** null: the robot has none of that name. */
  public InertialUnit getInertialUnit(String name) {
    return find(name, InertialUnit.class);
  }

  /** null: the robot has none of that name. */
  public LED getLED(String name) {
    return find(name, LED.class);
  }

  /** null: the robot has none of that name. */
  public Lidar getLidar(String name) {
    return find(name, Lidar.class);
  }

  /** null: the robot has none of that name. */
  public LightSensor getLightSensor(String name) {
    return find(name, LightSensor.class);
  }

  /** null: the robot has none of that name. */
  public Microphone getMicrophone(String name) {
    return find(name, Microphone.class);
  }

  /** null: the robot has none of that name. */
  public Motor getMotor(String name) {
    return find(name, Motor.class);
  }

  /** null: the robot has none of that name. */
  public Pen getPen(String name) {
    return find(name, Pen.class);
  }

  /** null: the robot has none of that name. */
  public PositionSensor getPositionSensor(String name) {
    return find(name, PositionSensor.class);
  }

  /** null: the robot has none of that name. */
  public RangeFinder getRangeFinder(String name) {
    return find(name, RangeFinder.class);
  }

  /** null: the robot has none of that name. */
  public Receiver getReceiver(String name) {
    return find(name, Receiver.class);
  }

  /** null: the robot has none of that name. */
  public Speaker getSpeaker(String name) {
    return find(name, Speaker.class);
  }

  /** null: the robot has none of that name. */
  public TouchSensor getTouchSensor(String name) {
    return find(name, TouchSensor.class);
  }

  /** The keyboard; it is to be enabled. */
  public Keyboard getKeyboard() {
    return keyboard;
  }

  /**
   * Lets the world go on for {@code timeStep} ms, a multiple of getBasicTimeStep(), and takes the samples. Commands of
   * the program, as a motor's speed, begin with the step. 0; or -1: the run is over, and the program should write its
   * files and end within a second. A further step ends it.
   */
  public int step(int timeStep) {
    return Memory.step(timeStep);
  }

  /** The first half of step(): the program goes on while the world steps. */
  public int stepBegin(int timeStep) {
    return Native.robot_step_begin(timeStep);
  }

  /** The second half of step(): waits and takes the samples. -1: the run is over. */
  public int stepEnd() {
    return Memory.stepEnd();
  }

  /** s since the run began. */
  public double getTime() {
    return Native.robot_get_time();
  }

  /** ms: the world's step. */
  public double getBasicTimeStep() {
    return Native.robot_get_basic_time_step();
  }

  /** The robot's name in the world file. */
  public String getName() {
    return Native.robot_get_name();
  }

  /** The robot's model. */
  public String getModel() {
    return Native.robot_get_model();
  }

  /** The robot's text, which supervisors and the program may change. */
  public String getCustomData() {
    return Native.robot_get_custom_data();
  }

  /** The robot's text, from the next step on for others. */
  public void setCustomData(String data) {
    Native.robot_set_custom_data(data);
  }

  /** The folder above worlds/ and controllers/. */
  public String getProjectPath() {
    return Native.robot_get_project_path();
  }

  /** The world file. */
  public String getWorldPath() {
    return Native.robot_get_world_path();
  }

  /** Whether it may do what {@link Supervisor} has. */
  public boolean getSupervisor() {
    return Native.robot_get_supervisor();
  }

  /** true: the world waits for the program. */
  public boolean getSynchronization() {
    return Native.robot_get_synchronization();
  }

  /** MODE_SIMULATION. */
  public int getMode() {
    return Native.robot_get_mode();
  }

  /** A remote control: there is none here. */
  public void setMode(int mode, String arg) {
    Native.robot_set_mode(mode, arg);
  }

  /** Measures the battery every {@code samplingPeriod} ms. */
  public void batterySensorEnable(int samplingPeriod) {
    Native.robot_battery_sensor_enable(samplingPeriod);
  }

  /** Measures no more. */
  public void batterySensorDisable() {
    Native.robot_battery_sensor_disable();
  }

  /** ms; 0: not enabled. */
  public int batterySensorGetSamplingPeriod() {
    return Native.robot_battery_sensor_get_sampling_period();
  }

  /** What is in the battery, J. */
  public double batterySensorGetValue() {
    return Native.robot_battery_sensor_get_value();
  }

  /** To the robot's window: nobody reads it. */
  public void wwiSendText(String text) {
    Native.robot_wwi_send_text(text);
  }

  /** From the robot's window: null. */
  public String wwiReceiveText() {
    return Native.robot_wwi_receive_text();
  }
}
