/* SPDX-License-Identifier: MIT
 * What a supervisor does to the simulation as a whole: its end, resets, labels, pictures; and what there is none of.
 */

#include "programs/controller/c/world.h"

/* as DO_WORLD numbers them */
enum { DO_END, DO_RESET, DO_RELOAD, DO_REST_ALL, DO_LABEL, DO_PICTURE, DO_MODE };

static WbSimulationMode simulation_mode = WB_SUPERVISOR_SIMULATION_MODE_FAST;

static void do_world(int what, const double* values, size_t count, const char* text, const char* function) {
  struct link_packet* out;
  if (!may_ask_world(function)) return;
  /* a label or picture changes nothing that may be asked for */
  out = what == DO_LABEL || what == DO_PICTURE || what == DO_MODE ? command(LINK_DO_WORLD) : world_command(LINK_DO_WORLD);
  link_int(out, what);
  link_numbers(out, values, count);
  link_text(out, text);
  command_end();
}

void wb_supervisor_simulation_quit(int status) {
  double value = status;
  do_world(DO_END, &value, 1, 0, "wb_supervisor_simulation_quit");
}
void wb_supervisor_simulation_reset(void) { do_world(DO_RESET, 0, 0, 0, "wb_supervisor_simulation_reset"); }
void wb_supervisor_world_reload(void) { do_world(DO_RELOAD, 0, 0, 0, "wb_supervisor_world_reload"); }
void wb_supervisor_simulation_revert(void) { wb_supervisor_world_reload(); }
void wb_supervisor_simulation_reset_physics(void) {
  do_world(DO_REST_ALL, 0, 0, 0, "wb_supervisor_simulation_reset_physics");
}
void wb_supervisor_simulation_physics_reset(void) { wb_supervisor_simulation_reset_physics(); }

WbSimulationMode wb_supervisor_simulation_get_mode(void) { return simulation_mode; }
void wb_supervisor_simulation_set_mode(WbSimulationMode mode) {
  double value = mode;
  simulation_mode = mode;
  do_world(DO_MODE, &value, 1, 0, "wb_supervisor_simulation_set_mode");
}

void(wb_supervisor_set_label)(int id, const char* text, double x, double y, double size, int color, double transparency,
                              const char* font) {
  double values[6] = {id, x, y, size, color & 0xFFFFFF, transparency};
  (void)font;
  do_world(DO_LABEL, values, 6, text, "wb_supervisor_set_label");
}

void wb_supervisor_export_image(const char* filename, int quality) {
  double value = quality;
  if (!filename || !*filename) {
    WARN("wb_supervisor_export_image(): got no name, expected a file");
    return;
  }
  do_world(DO_PICTURE, &value, 1, absolute_path(filename), "wb_supervisor_export_image");
}

/* --- a run has one world */

static bool no_world(const char* function) {
  if (may_ask_world(function)) WARN("%s(): a run has one world, which is neither changed for another nor written", function);
  return false;
}
void wb_supervisor_world_load(const char* filename) { (void)filename, (void)no_world("wb_supervisor_world_load"); }
bool wb_supervisor_world_save(const char* filename) { return (void)filename, no_world("wb_supervisor_world_save"); }
void wb_supervisor_load_world(const char* filename) { (void)filename, (void)no_world("wb_supervisor_load_world"); }
bool wb_supervisor_save_world(const char* filename) { return (void)filename, no_world("wb_supervisor_save_world"); }

/* --- no movies, no animations, no headset */

static void no_movie(const char* function) {
  if (may_ask_world(function))
    WARN("%s(): programs make no movies; record the run (twinpuck run --record) and replay it", function);
}
void wb_supervisor_movie_start_recording(const char* filename, int width, int height, int codec, int quality,
                                         int acceleration, bool caption) {
  (void)filename, (void)width, (void)height, (void)codec, (void)quality, (void)acceleration, (void)caption;
  no_movie("wb_supervisor_movie_start_recording");
}
void wb_supervisor_movie_stop_recording(void) {}
bool wb_supervisor_movie_is_ready(void) { return true; }
bool wb_supervisor_movie_failed(void) { return false; }
int wb_supervisor_movie_get_status(void) { return WB_SUPERVISOR_MOVIE_READY; }
void wb_supervisor_start_movie(const char* file, int width, int height, int codec, int quality, int acceleration,
                               bool caption) {
  (void)file, (void)width, (void)height, (void)codec, (void)quality, (void)acceleration, (void)caption;
  no_movie("wb_supervisor_start_movie");
}
void wb_supervisor_stop_movie(void) {}
int wb_supervisor_get_movie_status(void) { return WB_SUPERVISOR_MOVIE_READY; }
bool wb_supervisor_animation_start_recording(const char* filename) {
  (void)filename;
  no_movie("wb_supervisor_animation_start_recording");
  return false;
}
bool wb_supervisor_animation_stop_recording(void) { return false; }

bool wb_supervisor_virtual_reality_headset_is_used(void) { return false; }
const double* wb_supervisor_virtual_reality_headset_get_position(void) { return 0; }
const double* wb_supervisor_virtual_reality_headset_get_orientation(void) { return 0; }
