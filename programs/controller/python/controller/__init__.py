# SPDX-License-Identifier: MIT
"""Programs of robots and supervisors, written as for Webots (docs/webots.md).

    from controller import Robot

`help(controller.Robot)`, `help(controller.DistanceSensor)` ... say what there is, in which units.
"""
from .absent import Altimeter, Brake, Connector, Motion, Pen, Radar, RadarTarget, Skin, VacuumGripper
from .accelerometer import Accelerometer
from .ansi_codes import AnsiCodes
from .camera import Camera, CameraRecognitionObject
from .compass import Compass
from .device import Device, Sensor
from .differential_wheels import DifferentialWheels
from .display import Display
from .distance_sensor import DistanceSensor
from .emitter import Emitter
from .field import Field
from .gps import GPS
from .gyro import Gyro
from .inertial_unit import InertialUnit
from .keyboard import Joystick, Keyboard, Mouse, MouseState
from .led import LED
from .lidar import Lidar, LidarPoint, RangeFinder
from .light_sensor import LightSensor
from .motor import Motor
from .node import ContactPoint, Node
from .position_sensor import PositionSensor
from .receiver import Receiver
from .robot import Robot
from .speaker import Microphone, Speaker
from .supervisor import Supervisor
from .touch_sensor import TouchSensor

__all__ = ["Accelerometer", "Altimeter", "AnsiCodes", "Brake", "Camera", "CameraRecognitionObject", "Compass", "Connector",
           "ContactPoint", "Device", "DifferentialWheels", "Display", "DistanceSensor", "Emitter", "Field", "GPS", "Gyro",
           "InertialUnit", "Joystick", "Keyboard", "LED", "Lidar", "LidarPoint", "LightSensor", "Microphone", "Motion", "Motor",
           "Mouse", "MouseState", "Node", "Pen", "PositionSensor", "Radar", "RadarTarget", "RangeFinder", "Receiver",
           "Robot", "Sensor", "Skin", "Speaker", "Supervisor", "TouchSensor", "VacuumGripper"]
