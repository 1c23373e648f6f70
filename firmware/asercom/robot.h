/* SPDX-License-Identifier: MIT
 * What text commands, binary commands and the remote control share: the last orders, the camera's settings,
 * and a buffer for lines, replies and pictures.
 */
#ifndef ASERCOM_ROBOT_H
#define ASERCOM_ROBOT_H

/* the largest picture of either dialect, and with it the buffer: nearly half of the robot's memory */
#define IMAGE_BYTES 3456
#define WEBOTS_IMAGE_BYTES (2 * 52 * 39)
#define BUFFER_BYTES WEBOTS_IMAGE_BYTES
#define IMAGE_HEADER 3 /* mode, width, height */

/** Command lines and replies; a picture lands here behind what is already in it. */
extern char buffer[BUFFER_BYTES + IMAGE_HEADER];

/** 1: the dialect that Webots expects of a real robot. It has another version, three ground sensors instead
 *  of five, larger pictures, and command X. */
extern char is_webots;

/** Wheel speeds as last ordered, steps/s, not clamped. */
extern int speed_left, speed_right;

/** Camera as last set: mode 0 grey, 1 RGB565, 2 YUV; pixels; zoom; bytes of a picture. */
struct camera {
  int mode, width, height, zoom, size;
};
extern struct camera camera;

/** Gives both motors their speeds, steps/s; remembers them for command E. */
void set_speeds(int left, int right);

/** Plays sound 1 to 5; any other number switches the codec off. */
void play(int sound);

/** 40 x 40 pixels in colour, zoom 8, from the middle. */
void camera_default(void);

/** Puts `camera` into effect with the window's corner at (x1, y1) of 640 x 480, -1 for centred. Settings that
 *  do not fit the buffer become 40 x 40 in colour, the zoom is kept; those that the driver refuses become the
 *  default. Resets the camera: LEDs go out, motors lose their current, about 0.2 s. */
void camera_set(int x1, int y1);

/** Starts a picture into `to`. */
void camera_capture(char *to);

/** Waits until the picture that was started is complete; returns at once when none was. */
void camera_finish(void);

/** Reads the ground sensor board into `values`: left, centre, right, and the two cliff sensors unless the
 *  dialect is without them. Returns how many. */
int read_ground(int values[5]);

/** Reads or writes a register of an I2C device. */
int i2c_read(int device, int reg);
void i2c_write(int device, int reg, int value);

#endif
