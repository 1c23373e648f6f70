// SPDX-License-Identifier: MIT
// [webots] and [[robot.device]]: what programs written for Webots' interfaces find (docs/webots.md).
#include <fmt/format.h>

#include "sim_core/load/schema_keys.h"
#include "sim_core/load/schema_sections.h"

namespace sim {

SectionSpec webots_section() {
  using W = WebotsDesc;
  return {"webots",
          false,
          "What programs written for Webots' interfaces find, docs/webots.md. Others do not notice it.",
          {
              {"time_step", ValueType::Number, "s", 0.001, 10, "", "0.032",
               "basic time step that programs are told; it does not change the world's own tick",
               into<W>([](W& w, const Value& v) { w.time_step_s = v.number; })},
              {"speed_unit", ValueType::Number, "rad/s", 1e-6, 1000, "", "",
               "of one unit of `differential_wheels_set_speed`; 0.00628 otherwise: 1000 is a turn a second. "
               "Worlds of 2005 and 2006 used 0.1",
               into<W>([](W& w, const Value& v) { w.speed_unit_rad_s = v.number; })},
              {"sensor_order", ValueType::Choice, "", 0, 0, "product|lab", "\"product\"",
               "numbers of `ps0` to `ps7` and `ls0` to `ls7`. product: clockwise from the front right; lab: "
               "clockwise from the left, the rear ones last",
               into<W>([](W& w, const Value& v) { w.sensor_order = v.text; })},
              {"axes", ValueType::Choice, "", 0, 0, "enu|nue", "\"enu\"",
               "of positions and directions that programs are told. enu: x east, y north, z up (R2022 and "
               "later); nue: x to the right, y up, z towards the reader (before)",
               into<W>([](W& w, const Value& v) { w.axes = v.text == "nue" ? Axes::Nue : Axes::Enu; })},
              {"world", ValueType::Text, "", 0, 0, "", "\"\"",
               "the `.wbt` file that this world was made of, relative to this one: supervisors find all its "
               "nodes, "
               "also those that are nothing here",
               into<W>([](W& w, const Value& v) { w.world = v.text; })},
              {"floor", ValueType::Number, "m", -kFar, kFar, "", "0", "how high the floor lies in that file",
               into<W>([](W& w, const Value& v) { w.floor_m = v.number; })},
          }};
}

namespace {

struct KindWord {
  const char* word;
  DeviceKind kind;
};
constexpr KindWord kKindWords[] = {{"gps", DeviceKind::Gps},
                                   {"compass", DeviceKind::Compass},
                                   {"inertial", DeviceKind::Inertial},
                                   {"gyro", DeviceKind::Gyro},
                                   {"emitter", DeviceKind::Emitter},
                                   {"receiver", DeviceKind::Receiver},
                                   {"distance", DeviceKind::Distance},
                                   {"display", DeviceKind::Display},
                                   {"motor", DeviceKind::Motor},
                                   {"camera", DeviceKind::Camera},
                                   {"touch", DeviceKind::Touch},
                                   {"light", DeviceKind::Light},
                                   {"led", DeviceKind::Led},
                                   {"speaker", DeviceKind::Speaker},
                                   {"pen", DeviceKind::Pen},
                                   {"lidar", DeviceKind::Lidar},
                                   {"range-finder", DeviceKind::RangeFinder},
                                   {"position", DeviceKind::Position}};

}  // namespace

SectionSpec supervisor_device_section() {
  SectionSpec spec = robot_device_section();
  spec.path = "supervisor.device";
  spec.doc =
      "A device of a supervisor, found by its name. `emitter` and `receiver` of channel 1 are there without "
      "being written; writing them changes them.";
  return spec;
}

SectionSpec robot_device_section() {
  using D = DeviceDesc;
  return {
      "robot.device",
      true,
      "A device that this robot does not have in truth and that programs written for Webots' interfaces "
      "find by its name. `emitter` and `receiver` of channel 1 are there without being written; writing "
      "them changes them.",
      {
          {"name", ValueType::Text, "", 0, 0, "", "required", "by which programs ask for it",
           checked<D>([](D& d, const Value& v, const WorldDesc&) {
             if (v.text.empty() || v.text.size() > 31)
               return fmt::format("got {} characters, expected 1 to 31", v.text.size());
             d.name = v.text;
             return std::string();
           })},
          {"kind", ValueType::Choice, "", 0, 0,
           "gps|compass|inertial|gyro|emitter|receiver|distance|display|motor|camera|touch|light|led|speaker|"
           "pen|lidar|range-finder|position",
           "required",
           "gps, compass, inertial, gyro: the truth, without noise; distance: measured where it has a "
           "`table`, "
           "otherwise a virtual sensor, whose value a supervisor sets; lidar: a row of distances in m, from "
           "the "
           "left to the right; range-finder: a picture of distances; display: a picture that the program "
           "draws; motor to pen, and position: there for the program, "
           "but they move, see, feel and show nothing",
           into<D>([](D& d, const Value& v) {
             for (const KindWord& k : kKindWords)
               if (v.text == k.word) d.kind = k.kind;
           })},
          {"channel", ValueType::Integer, "", -1, 32767, "", "1",
           "of an emitter or receiver when the program begins; -1 is all",
           into<D>([](D& d, const Value& v) { d.channel = static_cast<int>(v.integer); })},
          {"range", ValueType::Number, "m", -1, kFar, "", "-1",
           "of an emitter, and the most that the program may set; -1 is unlimited",
           checked<D>([](D& d, const Value& v, const WorldDesc&) {
             if (v.number < 0 && v.number != -1)
               return fmt::format("got {} m, expected -1 (unlimited), or 0 and above", v.number);
             d.range_m = v.number;
             return std::string();
           })},
          {"baud_rate", ValueType::Number, "bit/s", -1, 1e9, "", "-1",
           "of an emitter, 8 bits a byte; -1 is unlimited",
           checked<D>([](D& d, const Value& v, const WorldDesc&) {
             if (v.number < 1 && v.number != -1)
               return fmt::format("got {} bit/s, expected -1 (unlimited), or 1 and above", v.number);
             d.baud_rate_bit_s = v.number;
             return std::string();
           })},
          {"infra_red", ValueType::Flag, "", 0, 0, "", "false",
           "of an emitter: packets need a free line of sight",
           into<D>([](D& d, const Value& v) { d.infra_red = v.flag; })},
          {"width", ValueType::Integer, "", 1, 4096, "", "128",
           "of a display or camera, in pixels; of a lidar or range finder, its columns",
           into<D>([](D& d, const Value& v) { d.width = static_cast<int>(v.integer); })},
          {"height", ValueType::Integer, "", 1, 4096, "", "64",
           "likewise, its rows: of a lidar 1, unless written; at most 12,000 distances",
           into<D>([](D& d, const Value& v) { d.height = static_cast<int>(v.integer); })},
          {"at", ValueType::Triple, "m", -1, 1, "", "[0, 0, 0]",
           "of what measures distances: its place on the robot, from the middle on the floor: ahead, left, "
           "up",
           into<D>([](D& d, const Value& v) {
             d.at_m = {v.numbers[0], v.numbers[1], v.numbers[2]};
           })},
          {"heading", ValueType::Number, "degrees", -360, 360, "", "0", "likewise: from ahead to the left",
           into<D>([](D& d, const Value& v) { d.heading_rad = radians(v.number); })},
          {"fov", ValueType::Number, "rad", 0, 6.2832, "", "1.5708",
           "of a camera, lidar or range finder: from the left edge to the right one",
           into<D>([](D& d, const Value& v) { d.fov_rad = v.number; })},
          {"vertical_fov", ValueType::Number, "rad", 0, 3.1416, "", "0.2",
           "of a lidar with several rows (`height`): from the uppermost to the lowest",
           into<D>([](D& d, const Value& v) { d.vertical_fov_rad = v.number; })},
          {"near", ValueType::Number, "m", 0, kFar, "", "0.01", "likewise: what is nearer counts as far away",
           into<D>([](D& d, const Value& v) { d.near_m = v.number; })},
          {"far", ValueType::Number, "m", 0.001, kFar, "", "1", "likewise: what is farther is infinitely far",
           into<D>([](D& d, const Value& v) { d.far_m = v.number; })},
          {"table", ValueType::Rows, "m, value, fraction", -1e9, 1e9, "", "",
           "of a distance sensor: rows of distance, value and relative noise (not drawn), distances growing; "
           "linear "
           "in between, clamped beyond the ends",
           checked<D>([](D& d, const Value& v, const WorldDesc&) {
             d.table.clear();
             for (const std::vector<double>& row : v.rows) {
               if (row[0] < 0 || (!d.table.empty() && row[0] <= d.table.back().distance_m))
                 return fmt::format("got a distance of {} m, expected growing ones from 0 m on", row[0]);
               d.table.push_back({row[0], row[1], row[2]});
             }
             if (d.table.size() < 2) return fmt::format("got {} row(s), expected at least 2", d.table.size());
             return std::string();
           })},
          {"rays", ValueType::Integer, "", 1, 100, "", "1",
           "likewise: over the aperture, whose mean distance counts",
           into<D>([](D& d, const Value& v) { d.rays = static_cast<int>(v.integer); })},
          {"aperture", ValueType::Number, "rad", 0, 6.2832, "", "1.5708", "likewise",
           into<D>([](D& d, const Value& v) { d.aperture_rad = v.number; })},
      }};
}

}  // namespace sim
