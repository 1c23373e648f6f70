// SPDX-License-Identifier: MIT
// The camera; see webots/camera.h.
#ifndef WB_CAMERA_HPP
#define WB_CAMERA_HPP

#include "Device.hpp"
#include "camera.h"

namespace webots {

class Camera : public Device {
 public:
  explicit Camera(WbDeviceTag tag) : Device(tag) {}
  virtual void enable(int period) { wb_camera_enable(tag(), period); }
  virtual void disable() { wb_camera_disable(tag()); }
  int getSamplingPeriod() const { return wb_camera_get_sampling_period(tag()); }
  const unsigned char* getImage() const { return wb_camera_get_image(tag()); }
  int getWidth() const { return wb_camera_get_width(tag()); }
  int getHeight() const { return wb_camera_get_height(tag()); }
  double getFov() const { return wb_camera_get_fov(tag()); }
  static unsigned char imageGetRed(const unsigned char* image, int width, int x, int y) {
    return wb_camera_image_get_red(image, width, x, y);
  }
  static unsigned char imageGetGreen(const unsigned char* image, int width, int x, int y) {
    return wb_camera_image_get_green(image, width, x, y);
  }
  static unsigned char imageGetBlue(const unsigned char* image, int width, int x, int y) {
    return wb_camera_image_get_blue(image, width, x, y);
  }
  static unsigned char imageGetGrey(const unsigned char* image, int width, int x, int y) {
    return wb_camera_image_get_grey(image, width, x, y);
  }
  static unsigned char imageGetGray(const unsigned char* image, int width, int x, int y) {
    return imageGetGrey(image, width, x, y);
  }
};

}  // namespace webots

#endif
