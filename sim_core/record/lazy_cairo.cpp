// SPDX-License-Identifier: MIT
// cairo, loaded with the first surface. With the twenty libraries behind it, it takes longer to load than all
// that most runs do, and most runs draw nothing. Programs are linked against the functions of this file
// instead of the library: those that make a surface load it, all others jump to it. A function that is
// missing here is missed by the linker. Without cairo.h, whose declarations would stand against these.
#include <dlfcn.h>

#include <cstdio>
#include <cstdlib>

// clang-format off
#define CAIRO_CALLS(X) \
  X(arc) X(clip) X(close_path) X(create) X(destroy) X(fill) X(fill_preserve) \
  X(image_surface_get_data) X(image_surface_get_height) X(image_surface_get_stride) \
  X(image_surface_get_width) X(line_to) X(move_to) X(new_path) X(paint) \
  X(pattern_add_color_stop_rgb) X(pattern_create_linear) X(pattern_destroy) X(rectangle) \
  X(rel_line_to) X(restore) X(save) X(scale) X(select_font_face) X(set_antialias) X(set_dash) \
  X(set_font_size) X(set_line_cap) X(set_line_join) X(set_line_width) X(set_source) \
  X(set_source_rgb) X(set_source_rgba) X(set_source_surface) X(show_text) X(status) \
  X(status_to_string) X(stroke) X(stroke_preserve) X(surface_destroy) X(surface_finish) \
  X(surface_flush) X(surface_mark_dirty) X(surface_status) X(surface_write_to_png) X(text_extents) \
  X(text_path) X(translate)
// clang-format on

#pragma GCC visibility push(hidden)  // or the library itself would find these
extern "C" {
#define SLOT(name) void* sim_cairo_##name;
CAIRO_CALLS(SLOT)
#undef SLOT

// registers and stack are the caller's, so any signature will do
#define JUMP(name) \
  __attribute__((naked)) void cairo_##name() { __asm__("jmp *sim_cairo_" #name "(%rip)"); }
CAIRO_CALLS(JUMP)
#undef JUMP
}

namespace sim {
namespace {

void* loaded_cairo() {
  void* library = dlopen("libcairo.so.2", RTLD_NOW | RTLD_LOCAL);
  if (!library) {
    std::fprintf(stderr, "pictures need cairo: %s\n", dlerror());
    std::abort();
  }
#define FIND(name) sim_cairo_##name = dlsym(library, "cairo_" #name);
  CAIRO_CALLS(FIND)
#undef FIND
  return library;
}

/// A function that makes a surface.
template <typename Function>
Function* maker(const char* name) {
  static void* const library = loaded_cairo();
  return reinterpret_cast<Function*>(dlsym(library, name));
}

}  // namespace
}  // namespace sim

extern "C" {
void* cairo_image_surface_create(int format, int width_px, int height_px) {
  return sim::maker<void*(int, int, int)>("cairo_image_surface_create")(format, width_px, height_px);
}
void* cairo_image_surface_create_from_png_stream(void* read, void* closure) {
  return sim::maker<void*(void*, void*)>("cairo_image_surface_create_from_png_stream")(read, closure);
}
void* cairo_svg_surface_create(const char* file, double width, double height) {
  return sim::maker<void*(const char*, double, double)>("cairo_svg_surface_create")(file, width, height);
}
}
#pragma GCC visibility pop
