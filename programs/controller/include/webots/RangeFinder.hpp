// SPDX-License-Identifier: MIT
// See webots/range_finder.h.
#ifndef WB_RANGEFINDER_HPP
#define WB_RANGEFINDER_HPP

#include <webots/range_finder.h>
#include "Device.hpp"

namespace webots {

class RangeFinder : public Device {
 public:
  explicit RangeFinder(WbDeviceTag tag) : Device(tag) {}
  explicit RangeFinder(const std::string& name) : Device(name) {}
  static bool is_kind(int kind) { return kind == WB_NODE_RANGE_FINDER; }
  virtual void enable(int samplingPeriod) { wb_range_finder_enable(tag(), samplingPeriod); }
  virtual void disable() { wb_range_finder_disable(tag()); }
  int getSamplingPeriod() const { return wb_range_finder_get_sampling_period(tag()); }
  const float* getRangeImage() const { return wb_range_finder_get_range_image(tag()); }
  static float rangeImageGetDepth(const float* image, int width, int x, int y) {
    return image[y * width + x];
  }
  int getWidth() const { return wb_range_finder_get_width(tag()); }
  int getHeight() const { return wb_range_finder_get_height(tag()); }
  double getFov() const { return wb_range_finder_get_fov(tag()); }
  double getMinRange() const { return wb_range_finder_get_min_range(tag()); }
  double getMaxRange() const { return wb_range_finder_get_max_range(tag()); }
  int saveImage(const std::string& file, int quality) const {
    return wb_range_finder_save_image(tag(), file.c_str(), quality);
  }
};

}  // namespace webots

#endif
