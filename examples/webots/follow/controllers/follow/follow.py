# SPDX-License-Identifier: MIT
"""Follows what is red."""
import numpy
from controller import Robot

TIME_STEP = 64
MOST = 6.28          # rad/s of a wheel
NEAR = 0.25          # part of the picture that is red when it is near enough

robot = Robot()
camera = robot.getDevice("camera")
camera.enable(TIME_STEP)
left, right = (robot.getDevice(side + " wheel motor") for side in ("left", "right"))
for wheel in (left, right):
    wheel.setPosition(float("inf"))

turn, seen, steps = 0.5, 0, 0
while robot.step(TIME_STEP) != -1:
    blue, green, red = numpy.asarray(camera)[:, :, :3].astype(int).transpose(2, 0, 1)
    is_red = (red > 60) & (red > 2 * green) & (red > 2 * blue)
    steps += 1
    if is_red.any():
        column = is_red.nonzero()[1].mean()
        turn = column / (camera.width - 1) - 0.5            # -0.5 at the left edge, 0.5 at the right one
        speed = 5.0 * (1 - is_red.mean() / NEAR)            # backwards when it is too near
        seen += 1
    else:
        speed, turn = 0, 0.5 if turn > 0 else -0.5          # looks where it saw the last one
    left.setVelocity(numpy.clip(speed + 4 * turn, -MOST, MOST))
    right.setVelocity(numpy.clip(speed - 4 * turn, -MOST, MOST))
print("saw it in %.0f %% of %d pictures" % (100 * seen / max(steps, 1), steps))
