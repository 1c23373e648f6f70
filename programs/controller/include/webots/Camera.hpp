// SPDX-License-Identifier: MIT
// See webots/camera.h.
#ifndef WB_CAMERA_HPP
#define WB_CAMERA_HPP

#include <webots/camera.h>
#include "Device.hpp"

namespace webots {

typedef WbCameraRecognitionObject CameraRecognitionObject;

class Camera : public Device {
 public:
  explicit Camera(WbDeviceTag tag) : Device(tag) {}
  explicit Camera(const std::string& name) : Device(name) {}
  static bool is_kind(int kind) { return kind == WB_NODE_CAMERA; }
  virtual void enable(int samplingPeriod) { wb_camera_enable(tag(), samplingPeriod); }
  virtual void disable() { wb_camera_disable(tag()); }
  int getSamplingPeriod() const { return wb_camera_get_sampling_period(tag()); }
  const unsigned char* getImage() const { return wb_camera_get_image(tag()); }
  static unsigned char imageGetRed(const unsigned char* image, int width, int x, int y) {
    return wb_camera_image_get_red(image, width, x, y);
  }
  static unsigned char imageGetGreen(const unsigned char* image, int width, int x, int y) {
    return wb_camera_image_get_green(image, width, x, y);
  }
  static unsigned char imageGetBlue(const unsigned char* image, int width, int x, int y) {
    return wb_camera_image_get_blue(image, width, x, y);
  }
  static unsigned char imageGetGray(const unsigned char* image, int width, int x, int y) {
    return wb_camera_image_get_gray(image, width, x, y);
  }
  static unsigned char imageGetGrey(const unsigned char* image, int width, int x, int y) {
    return imageGetGray(image, width, x, y);
  }
  int getWidth() const { return wb_camera_get_width(tag()); }
  int getHeight() const { return wb_camera_get_height(tag()); }
  double getFov() const { return wb_camera_get_fov(tag()); }
  double getMinFov() const { return wb_camera_get_min_fov(tag()); }
  double getMaxFov() const { return wb_camera_get_max_fov(tag()); }
  double getExposure() const { return wb_camera_get_exposure(tag()); }
  double getFocalLength() const { return wb_camera_get_focal_length(tag()); }
  double getFocalDistance() const { return wb_camera_get_focal_distance(tag()); }
  double getMinFocalDistance() const { return wb_camera_get_min_focal_distance(tag()); }
  double getMaxFocalDistance() const { return wb_camera_get_max_focal_distance(tag()); }
  double getNear() const { return wb_camera_get_near(tag()); }
  virtual void setFov(double fov) { wb_camera_set_fov(tag(), fov); }
  virtual void setExposure(double exposure) { wb_camera_set_exposure(tag(), exposure); }
  virtual void setFocalDistance(double distance) { wb_camera_set_focal_distance(tag(), distance); }
  int saveImage(const std::string& file, int quality) const {
    return wb_camera_save_image(tag(), file.c_str(), quality);
  }

  bool hasRecognition() const { return wb_camera_has_recognition(tag()); }
  virtual void recognitionEnable(int samplingPeriod) { wb_camera_recognition_enable(tag(), samplingPeriod); }
  virtual void recognitionDisable() { wb_camera_recognition_disable(tag()); }
  int getRecognitionSamplingPeriod() const { return wb_camera_recognition_get_sampling_period(tag()); }
  int getRecognitionNumberOfObjects() const { return wb_camera_recognition_get_number_of_objects(tag()); }
  const CameraRecognitionObject* getRecognitionObjects() const {
    return wb_camera_recognition_get_objects(tag());
  }
  bool hasRecognitionSegmentation() const { return wb_camera_recognition_has_segmentation(tag()); }
  void enableRecognitionSegmentation() { wb_camera_recognition_enable_segmentation(tag()); }
  void disableRecognitionSegmentation() { wb_camera_recognition_disable_segmentation(tag()); }
  bool isRecognitionSegmentationEnabled() const {
    return wb_camera_recognition_is_segmentation_enabled(tag());
  }
  const unsigned char* getRecognitionSegmentationImage() const {
    return wb_camera_recognition_get_segmentation_image(tag());
  }
  int saveRecognitionSegmentationImage(const std::string& file, int quality) {
    return wb_camera_recognition_save_segmentation_image(tag(), file.c_str(), quality);
  }
};

}  // namespace webots

#endif
