// SPDX-License-Identifier: MIT
// A display; see webots/display.h.
#ifndef WB_DISPLAY_HPP
#define WB_DISPLAY_HPP

#include <webots/display.h>

#include "Camera.hpp"
#include "Device.hpp"

namespace webots {

class ImageRef {
 public:
  explicit ImageRef(WbImageRef image) : image_(image) {}
  WbImageRef image() const { return image_; }

 private:
  WbImageRef image_;
};

class Display : public Device {
 public:
  enum { RGB = WB_IMAGE_RGB, RGBA, ARGB, BGRA, ABGR };
  explicit Display(WbDeviceTag tag) : Device(tag) {}
  explicit Display(const std::string& name) : Device(name) {}
  static bool is_kind(int kind) { return kind == WB_NODE_DISPLAY; }
  int getWidth() const { return wb_display_get_width(tag()); }
  int getHeight() const { return wb_display_get_height(tag()); }
  void setColor(long color) { wb_display_set_color(tag(), color); }
  void setAlpha(double alpha) { wb_display_set_alpha(tag(), alpha); }
  void setOpacity(double opacity) { wb_display_set_opacity(tag(), opacity); }
  void setAntialiasing(bool on) { wb_display_set_antialiasing(tag(), on); }
  void setFont(const std::string& font, int size, bool antialiasing) {
    wb_display_set_font(tag(), font.c_str(), size, antialiasing);
  }
  void drawPixel(int x, int y) { wb_display_draw_pixel(tag(), x, y); }
  void drawLine(int x1, int y1, int x2, int y2) { wb_display_draw_line(tag(), x1, y1, x2, y2); }
  void drawRectangle(int x, int y, int width, int height) {
    wb_display_draw_rectangle(tag(), x, y, width, height);
  }
  void drawOval(int cx, int cy, int a, int b) { wb_display_draw_oval(tag(), cx, cy, a, b); }
  void drawPolygon(const int* x, const int* y, int size) { wb_display_draw_polygon(tag(), x, y, size); }
  void drawText(const std::string& text, int x, int y) { wb_display_draw_text(tag(), text.c_str(), x, y); }
  void fillRectangle(int x, int y, int width, int height) {
    wb_display_fill_rectangle(tag(), x, y, width, height);
  }
  void fillOval(int cx, int cy, int a, int b) { wb_display_fill_oval(tag(), cx, cy, a, b); }
  void fillPolygon(const int* x, const int* y, int size) { wb_display_fill_polygon(tag(), x, y, size); }
  void attachCamera(Camera* camera) { wb_display_attach_camera(tag(), camera ? camera->getTag() : 0); }
  void detachCamera() { wb_display_detach_camera(tag()); }
  ImageRef* imageNew(int width, int height, const void* data, int format) const {
    return made(wb_display_image_new(tag(), width, height, data, format));
  }
  ImageRef* imageCopy(int x, int y, int width, int height) const {
    return made(wb_display_image_copy(tag(), x, y, width, height));
  }
  ImageRef* imageLoad(const std::string& file) const {
    return made(wb_display_image_load(tag(), file.c_str()));
  }
  void imagePaste(ImageRef* image, int x, int y, bool blend = false) {
    wb_display_image_paste(tag(), image ? image->image() : 0, x, y, blend);
  }
  void imageSave(ImageRef* image, const std::string& file) const {
    wb_display_image_save(tag(), image ? image->image() : 0, file.c_str());
  }
  void imageDelete(ImageRef* image) const {
    if (image) wb_display_image_delete(tag(), image->image());
    delete image;
  }

 private:
  static ImageRef* made(WbImageRef image) { return image ? new ImageRef(image) : 0; }
};

}  // namespace webots

#endif
