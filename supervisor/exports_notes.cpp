// SPDX-License-Identifier: MIT
// supervisor.h: tracks, pictures, labels.
#include <cerrno>
#include <cstring>
#include <fstream>

#include "sim_core/record/picture.h"
#include "supervisor/asked.h"
#include "supervisor/include/supervisor.h"

using supervisor::asking;
using supervisor::Member;

namespace {

const supervisor::Track* track_of(Member& me, const char* function, int thing) {
  if (!supervisor::is_thing(me, function, thing)) return nullptr;
  const auto found = me.tracks.find(thing);
  if (found != me.tracks.end()) return &found->second;
  me.refuse(fmt::format("{}: got '{}', which nobody tracks, expected a thing after sv_track()", function,
                        me.team.things().name(thing)));
  return nullptr;
}

}  // namespace

extern "C" {

int sv_track(int thing, double seconds) {
  Member& me = asking();
  if (!supervisor::is_movable(me, "sv_track", thing) ||
      !supervisor::in_range(me, "sv_track", "", seconds, 0, 1e7, "s"))
    return -1;
  const sim::Simulation& simulation = me.team.simulation();
  const sim::BodyState& state = simulation.state(me.team.things().body(thing));
  supervisor::Track& track = me.tracks[thing] = {};
  track.every_s = seconds;
  track.next = simulation.now() + sim::from_seconds(seconds);
  track.lifted = false;
  track.notes.push_back({me.team.now_s(), state.pose, state.z_m});
  me.team.keep_ways();
  return 0;
}

double sv_track_length(int thing) {
  const auto* track = track_of(asking(), "sv_track_length", thing);
  return track ? track->length_m : 0;
}

int sv_track_points(int thing) {
  const auto* track = track_of(asking(), "sv_track_points", thing);
  return track ? static_cast<int>(track->notes.size()) : 0;
}

int sv_track_point(int thing, int index, double* time, struct sv_pose* pose) {
  Member& me = asking();
  const auto* track = track_of(me, "sv_track_point", thing);
  if (!track) return -1;
  const int count = static_cast<int>(track->notes.size());
  if (index < 0 || index >= count)
    return me.refuse(fmt::format("sv_track_point: got index {}, expected 0 to {}", index, count - 1));
  const auto& note = track->notes[static_cast<std::size_t>(index)];
  if (time) *time = note.time_s;
  if (pose) *pose = {note.pose.x_m, note.pose.y_m, note.z_m, note.pose.heading_rad};
  return 0;
}

int sv_save_tracks(const char* file) {
  Member& me = asking();
  errno = 0;
  std::ofstream out(me.team.file_of_run(file), std::ios::binary | std::ios::trunc);
  out << "time_s,thing,x_m,y_m,z_m,heading_rad\n";
  for (const auto& [thing, track] : me.tracks)
    for (const auto& note : track.notes)
      out << fmt::format("{:.6f},{},{:.6f},{:.6f},{:.6f},{:.6f}\n", note.time_s, me.team.things().name(thing),
                         note.pose.x_m, note.pose.y_m, note.z_m, note.pose.heading_rad);
  out.close();
  if (out) return 0;
  return me.refuse(fmt::format("sv_save_tracks: {}: cannot be written: {}", file ? file : "",
                               std::strerror(errno ? errno : EIO)));
}

int sv_picture(const char* file) {
  Member& me = asking();
  sim::PictureOptions options;
  options.caption = fmt::format("{:g} s, seed {}", me.team.now_s(), me.team.twin().world().seed);
  options.labels = me.team.labels();
  const std::string error = sim::write_picture(me.team.file_of_run(file), me.team.simulation().scene(),
                                               me.team.simulation().minds(), me.team.ways(), options);
  return error.empty() ? 0 : me.refuse("sv_picture: " + error);
}

int sv_label(int id, const char* text, double x, double y, double size, uint32_t rgb, double transparency) {
  Member& me = asking();
  for (double part : {x, y, size, transparency})
    if (!supervisor::in_range(me, "sv_label", "a fraction of", part, 0, 1, "")) return -1;
  sim::PictureLabel label;
  label.id = id;
  label.text = text ? text : "";
  label.x = x;
  label.y = y;
  label.size = size;
  label.rgb = rgb & 0xFFFFFF;
  label.transparency = transparency;
  me.team.set_label(me.index, label);
  return 0;
}
}
