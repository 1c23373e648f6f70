/* SPDX-License-Identifier: MIT
 * Camera, by either interface: RGB565 of the robot's camera as BGRA. Two pictures are kept, the one that the program
 * looks at and the one that is being taken; together 12 KB, more than the robot has. On the robot there is one of
 * 4056 bytes, RGB565 as the camera sends it, and the macros that tell a pixel's colours know that. The next picture is
 * taken into it while the program waits in a step; what a step finds half taken is finished in the next one.
 */
#include "core.h"
#include "camera/fast_2_timer/e_poxxxx.h"
#include "device/camera.h"
#include "webots/camera.h"

#define COLUMNS 52
#define ROWS 39
#define ZOOM 8
#define PIXELS (COLUMNS * ROWS)
#define FOV_RAD 0.84f /* [Webots: E-puck.proto] */

static char shown[2 * PIXELS];
static unsigned char is_on;
static unsigned char is_wanted; /* the program has seen the picture */
static struct webots_device* seen_by;

/* the camera's lines arrive while the program waits for the end of its step */
static void take_next(void) {
  if (!is_wanted || !seen_by || seen_by->period <= 0) return;
  is_wanted = 0;
  e_poxxxx_launch_capture(shown);
}

static void start(void) {
  if (is_on) return;
  is_on = 1;
  e_poxxxx_init_cam(); /* clears the ports: motors go on with their next step */
  webots_show_leds();
  e_poxxxx_config_cam((ARRAY_WIDTH - COLUMNS * ZOOM) / 2, (ARRAY_HEIGHT - ROWS * ZOOM) / 2, COLUMNS * ZOOM,
                      ROWS * ZOOM, ZOOM, ZOOM, RGB_565_MODE);
  e_poxxxx_write_cam_registers();
  e_poxxxx_launch_capture(shown);
  webots_before_step = take_next;
}

static void sample(struct webots_device* device) {
  seen_by = device;
  if (e_poxxxx_is_img_ready()) is_wanted = 1;
}

static struct webots_device* camera(WbDeviceTag tag, const char* function) {
  return webots_device_of(tag, WB_NODE_CAMERA, function);
}

void wb_camera_enable(WbDeviceTag tag, int sampling_period) {
  struct webots_device* d = camera(tag, "wb_camera_enable");
  if (!d) return;
  if (sampling_period > 0) start();
  webots_enable(d, sampling_period, sample);
}
void wb_camera_disable(WbDeviceTag tag) { wb_camera_enable(tag, 0); }
int wb_camera_get_sampling_period(WbDeviceTag tag) {
  const struct webots_device* d = camera(tag, "wb_camera_get_sampling_period");
  return d ? d->period : 0;
}
const unsigned char* wb_camera_get_image(WbDeviceTag tag) {
  return camera(tag, "wb_camera_get_image") && is_on ? (const unsigned char*)shown : 0;
}
int wb_camera_get_width(WbDeviceTag tag) { return (void)tag, COLUMNS; }
int wb_camera_get_height(WbDeviceTag tag) { return (void)tag, ROWS; }
double wb_camera_get_fov(WbDeviceTag tag) { return (void)tag, FOV_RAD; }
double wb_camera_get_near(WbDeviceTag tag) { return (void)tag, 0; }

void camera_enable(DeviceTag tag, int ms) { wb_camera_enable(tag, ms); }
void camera_disable(DeviceTag tag) { wb_camera_disable(tag); }
unsigned char* camera_get_image(DeviceTag tag) {
  return camera(tag, "camera_get_image") && is_on ? (unsigned char*)shown : 0;
}
int camera_get_width(DeviceTag tag) { return (void)tag, COLUMNS; }
int camera_get_height(DeviceTag tag) { return (void)tag, ROWS; }
float camera_get_fov(DeviceTag tag) { return (void)tag, FOV_RAD; }
void camera_move_window(DeviceTag tag, int x, int y) { (void)tag, (void)x, (void)y; }
