# SPDX-License-Identifier: MIT
"""Steps of 32 ms, eight sensors: what a program of the PC costs (docs/dev/performance.md)."""
from controller import Robot

STEP_MS = 32
NEAR = 300  # counts of four sensors

robot = Robot()
sensors = [robot.getDevice(f"ps{i}") for i in range(8)]
for sensor in sensors:
    sensor.enable(STEP_MS)
left, right = robot.getDevice("left wheel motor"), robot.getDevice("right wheel motor")
for motor in (left, right):
    motor.setPosition(float("inf"))
while robot.step(STEP_MS) != -1:
    v = [sensor.getValue() for sensor in sensors]
    left.setVelocity(3)
    right.setVelocity(-3 if v[0] + v[1] + v[6] + v[7] > NEAR else 3)
