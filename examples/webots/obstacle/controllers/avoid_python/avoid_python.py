# SPDX-License-Identifier: MIT
"""Drives on and turns away from what is near."""
from controller import Robot

TIME_STEP = 64
CRUISE = 4.0  # rad/s
MOST = 6.28

# rad/s a count of ps0 to ps7, clockwise from the front right, for the left and the right wheel
WEIGHTS = [(-0.004, 0.006), (-0.003, 0.004), (-0.001, 0.002), (0.001, 0.001),
           (0.001, 0.001), (0.002, -0.001), (0.004, -0.003), (0.006, -0.008)]

robot = Robot()
wheels = [robot.getDevice(side + " wheel motor") for side in ("left", "right")]
sensors = [robot.getDevice("ps%d" % i) for i in range(8)]
for sensor in sensors:
    sensor.enable(TIME_STEP)
for wheel in wheels:
    wheel.setPosition(float("inf"))

while robot.step(TIME_STEP) != -1:
    near = [sensor.getValue() for sensor in sensors]
    for side, wheel in enumerate(wheels):
        speed = CRUISE + sum(weights[side] * value for weights, value in zip(WEIGHTS, near))
        wheel.setVelocity(max(-MOST, min(MOST, speed)))
print("drove for %.0f s" % robot.getTime())
