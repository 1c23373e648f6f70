// SPDX-License-Identifier: MIT
// [[robot]], [robot.variation] and [[robot.part]].
#include <fmt/format.h>

#include "sim_core/geometry/pose.h"
#include "sim_core/load/schema_keys.h"
#include "sim_core/load/schema_sections.h"

namespace sim {

namespace {

/// none, pty, pty:LINK, tcp:PORT or file:PATH.
std::string uart_text(const Value& v, std::string& out) {
  const std::string& t = v.text;
  bool good = t == "none" || t == "-" || t == "pty" || (t.rfind("file:", 0) == 0 && t.size() > 5) ||
              (t.rfind("pty:", 0) == 0 && t.size() > 4);
  if (t.rfind("tcp:", 0) == 0 && t.size() > 4 && t.size() <= 9 &&
      t.find_first_not_of("0123456789", 4) == std::string::npos) {
    good = std::stoi(t.substr(4)) <= 65535;  // 0: one that is free
  }
  if (!good)
    return fmt::format(
        "got \"{}\", expected none, -, pty, pty:LINK, tcp:PORT with a port of 0 to 65535, or file:PATH", t);
  out = t;
  return {};
}

std::vector<KeySpec> variation_keys() {
  using V = Variation;
  const auto number = [](const char* key, const char* unit, double least, double most, const char* fallback,
                         const char* doc, double V::*field) {
    return KeySpec{
        key, ValueType::Number, unit, least, most, "", fallback, doc, into<V>([field](V& t, const Value& v) {
          t.*field = v.number;
        })};
  };
  return {
      {"sensor_gain", ValueType::Numbers, "", 0, 10, "", "", "factor per proximity sensor, from sensor 0 on",
       into<V>([](V& t, const Value& v) { t.sensor_gain = v.numbers; })},
      {"sensor_offset", ValueType::Numbers, "counts", -4095, 4095, "", "", "added per proximity sensor",
       into<V>([](V& t, const Value& v) { t.sensor_offset_counts = v.numbers; })},
      number("left_wheel", "", 0.5, 2, "1", "true over nominal size of the left wheel", &V::left_wheel_ratio),
      number("right_wheel", "", 0.5, 2, "1", "true over nominal size of the right wheel",
             &V::right_wheel_ratio),
      number("axle", "", 0.5, 2, "1", "effective over nominal distance of the wheels", &V::axle_ratio),
      number("clock_ppm", "ppm", -10000, 10000, "0", "error of the robot's clock; positive is fast",
             &V::clock_ppm),
      number("boot_delay", "s", 0, 3600, "0", "from the world's beginning to the robot's first instruction",
             &V::boot_delay_s),
      number("gain_spread", "", 0, 1, "0", "standard deviation of a further factor per sensor",
             &V::gain_spread),
      number("offset_spread", "counts", 0, 1000, "0", "standard deviation of a further offset per sensor",
             &V::offset_spread_counts),
      number("wheel_spread", "", 0, 0.2, "0", "standard deviation of a further factor per wheel",
             &V::wheel_spread),
      number("axle_spread", "", 0, 0.2, "0", "standard deviation of a further factor on the axle",
             &V::axle_spread),
      number("clock_spread", "ppm", 0, 1000, "0", "standard deviation of a further clock error",
             &V::clock_spread_ppm),
      number("boot_spread", "s", 0, 3600, "0", "the boot delay grows by a random time from 0 to this",
             &V::boot_spread_s),
      {"acc_offset", ValueType::Triple, "m/s2", -20, 20, "", "[0, 0, 0]",
       "added to what the accelerometer feels: forward, left, up", into<V>([](V& t, const Value& v) {
         t.acc_offset_m_s2 = {v.numbers[0], v.numbers[1], v.numbers[2]};
       })},
      number("acc_offset_spread", "m/s2", 0, 20, "0", "standard deviation of a further offset per axis",
             &V::acc_offset_spread_m_s2),
      {"gyro_offset", ValueType::Triple, "deg/s", -250, 250, "", "[0, 0, 0]",
       "added to what the gyroscope feels about these axes", into<V>([](V& t, const Value& v) {
         t.gyro_offset_rad_s = {radians(v.numbers[0]), radians(v.numbers[1]), radians(v.numbers[2])};
       })},
      {"gyro_offset_spread", ValueType::Number, "deg/s", 0, 250, "", "0",
       "standard deviation of a further offset per axis",
       into<V>([](V& t, const Value& v) { t.gyro_offset_spread_rad_s = radians(v.number); })},
      number("motion_noise", "", 0, 100, "1", "factor on the noise of accelerometer and gyroscope; 0 = none",
             &V::motion_noise_scale),
  };
}

}  // namespace

SectionSpec robot_section() {
  using R = RobotDesc;
  return {
      "robot", true, "A robot.",
      joined(
          {
              {"name", ValueType::Text, "", 0, 0, "", "\"robotN\"", "N counts from 0; names differ",
               checked<R>([](R& r, const Value& v, const WorldDesc&) {
                 if (v.text.empty() || v.text.find_first_of(",\"\n\r=") != std::string::npos) {
                   return fmt::format("got \"{}\", expected a name without comma, quote, = or line break",
                                      v.text);
                 }
                 r.name = v.text;
                 return std::string();
               })},
              def_key<R>(),
              {"model", ValueType::Text, "", 0, 0, "", "", "kind of robot; the first that the program knows",
               checked<R>([](R& r, const Value& v, const WorldDesc& d) {
                 r.model = v.text;
                 std::string known;
                 for (const RobotModel& m : d.models) known += (known.empty() ? "" : ", ") + m.name;
                 return d.model_of(r)
                            ? std::string()
                            : fmt::format("got \"{}\", expected one of the models: {}", v.text, known);
               })},
              {"firmware", ValueType::Text, "", 0, 0, "", "\"\"",
               "controller by name, or a file relative to this one",
               into<R>([](R& r, const Value& v) { r.firmware = v.text; })},
              {"args", ValueType::Text, "", 0, 0, "", "\"\"",
               "what a controller that runs on the PC gets as its arguments: words between blanks, `'two "
               "words'` "
               "in quotes; firmware has none",
               into<R>([](R& r, const Value& v) { r.args = v.text; })},
              {"supervisor", ValueType::Flag, "", 0, 0, "", "false",
               "its controller, which runs on the PC, may do what supervisors may (docs/connecting.md)",
               into<R>([](R& r, const Value& v) { r.supervisor = v.flag; })},
              custom_data_key<R>(),
              {"position", ValueType::Pair, "m", -kFar, kFar, "", "[0, 0]",
               "x and y of the middle between its wheels",
               into<R>([](R& r, const Value& v) { r.pose.x_m = v.numbers[0], r.pose.y_m = v.numbers[1]; })},
              {"heading", ValueType::Number, "deg", -kMany, kMany, "", "0", "counter-clockwise from +x",
               into<R>([](R& r, const Value& v) { r.pose.heading_rad = radians(v.number); })},
              {"seed", ValueType::Integer, "", 0, 9e18, "", "",
               "its own seed; otherwise made of the world's seed and its number",
               into<R>([](R& r, const Value& v) { r.seed = static_cast<std::uint64_t>(v.integer); })},
              {"battery", ValueType::Number, "V", 2.5, 5, "", "",
               "voltage at the beginning, only the electronics being on; the model's otherwise",
               into<R>([](R& r, const Value& v) { r.battery_v = v.number; })},
              {"battery_wh", ValueType::Number, "Wh", 1e-3, 1000, "", "",
               "energy of its battery when full; the model's otherwise",
               into<R>([](R& r, const Value& v) { r.battery_wh = v.number; })},
              {"colour", ValueType::Colour, "", 0, 1, "", "", "of the body; the model's otherwise",
               into<R>([](R& r, const Value& v) { r.colour = colour_of(v); })},
              {"uart1", ValueType::Text, "", 0, 0, "", "\"-\"",
               "- (text is shown on the terminal), none, pty, pty:LINK, tcp:PORT or file:PATH",
               checked<R>([](R& r, const Value& v, const WorldDesc&) { return uart_text(v, r.uart1); })},
              {"uart2", ValueType::Text, "", 0, 0, "", "\"none\"",
               "none, -, pty, pty:LINK, tcp:PORT or file:PATH",
               checked<R>([](R& r, const Value& v, const WorldDesc&) { return uart_text(v, r.uart2); })},
          },
          joined(wheel_keys<R>("", ""), {recognition_key<R>(), node_key<R>()}))};
}

SectionSpec robot_variation_section() {
  return {"robot.variation", false, "How this robot differs from its model.", variation_keys()};
}

SectionSpec robot_part_section() {
  return {"robot.part",
          true,
          "Something plugged into this robot, such as a turret or a sensor board. The other keys depend on "
          "the kind.",
          {{"kind", ValueType::Text, "", 0, 0, "", "required", "which part",
            into<PartDesc>([](PartDesc& p, const Value& v) { p.kind = v.text; })}}};
}

}  // namespace sim
