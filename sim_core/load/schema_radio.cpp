// SPDX-License-Identifier: MIT
// [radio], [bluetooth] and [robot.bluetooth].
#include <fmt/format.h>

#include "sim_core/load/schema_keys.h"
#include "sim_core/load/schema_sections.h"

namespace sim {

namespace {

/// Pairs of a beginning and a length, one after the other.
std::string read_dropouts(const Value& v, std::vector<Dropout>& out) {
  out.clear();
  for (const std::vector<double>& row : v.rows) {
    if (row[1] <= 0) return fmt::format("got a length of {} s, expected more than 0", row[1]);
    if (!out.empty() && row[0] < out.back().begin_s + out.back().span_s) {
      return fmt::format("got a beginning at {} s, expected it after the one before has ended ({} s)", row[0],
                         out.back().begin_s + out.back().span_s);
    }
    out.push_back({row[0], row[1]});
  }
  return {};
}

}  // namespace

SectionSpec radio_section() {
  using R = RadioDesc;
  return {
      "radio",
      false,
      "The channel that robots with a radio turret share. Without such a robot it costs nothing.",
      {
          {"model", ValueType::Choice, "", 0, 0, "log-distance|disc", "\"log-distance\"",
           "log-distance: the level falls with the logarithm of the distance and fades at random; disc: "
           "everything "
           "within the range arrives, nothing beyond",
           into<R>([](R& r, const Value& v) {
             r.model = v.text == "disc" ? RadioModel::Disc : RadioModel::LogDistance;
           })},
          {"range", ValueType::Number, "m", 0.01, 10000, "", "5",
           "where a frame at full power is just received; half of them, with fading",
           into<R>([](R& r, const Value& v) { r.range_m = v.number; })},
          {"exponent", ValueType::Number, "", 1, 10, "", "3.3",
           "of the path loss: an attenuation of a dB shortens the range by a factor of 10^(a / 10 exponent)",
           into<R>([](R& r, const Value& v) { r.exponent = v.number; })},
          {"fading", ValueType::Number, "dB", 0, 40, "", "2",
           "standard deviation of the level, drawn for each frame and receiver; 0 makes a sharp edge",
           into<R>([](R& r, const Value& v) { r.fading_db = v.number; })},
          {"loss", ValueType::Number, "", 0, 1, "", "0",
           "part of the frames within range that is lost by chance",
           into<R>([](R& r, const Value& v) { r.loss = v.number; })},
          {"capture", ValueType::Number, "dB", 0, 1000, "", "3",
           "of two frames that overlap the stronger one survives from this difference on; 1000: both are "
           "lost",
           into<R>([](R& r, const Value& v) { r.capture_db = v.number; })},
          {"carrier_sense", ValueType::Flag, "", 0, 0, "", "true",
           "radios wait a random time and listen before they send; false: they send at once",
           into<R>([](R& r, const Value& v) { r.carrier_sense = v.flag; })},
          {"seed", ValueType::Integer, "", 0, 9e18, "", "",
           "of fading, loss and waits; the world's otherwise",
           into<R>([](R& r, const Value& v) { r.seed = static_cast<std::uint64_t>(v.integer); })},
      }};
}

SectionSpec bluetooth_section() {
  using L = LinkDesc;
  return {
      "bluetooth",
      false,
      "Links between the Bluetooth modules of two robots, and of a robot with the computer behind its "
      "`uart1`.",
      {
          {"range", ValueType::Number, "m", 0.01, 1000, "", "10",
           "beyond it nobody is found, and links are lost",
           into<L>([](L& l, const Value& v) { l.range_m = v.number; })},
          {"latency", ValueType::Number, "s", 0, 10, "", "0.008", "one way, between two robots",
           into<L>([](L& l, const Value& v) { l.latency_s = v.number; })},
          {"bandwidth", ValueType::Number, "bit/s", 100, 1e7, "", "115200",
           "per direction, between two robots",
           into<L>([](L& l, const Value& v) { l.bandwidth_bit_s = v.number; })},
          {"timeout", ValueType::Number, "s", 0, 40, "", "20",
           "a silence that lasts longer ends a link; what comes back sooner goes on where it stopped",
           into<L>([](L& l, const Value& v) { l.timeout_s = v.number; })},
          {"dropouts", ValueType::Points, "s", 0, kMany, "", "",
           "pairs of beginning and length: nothing passes then, for any robot",
           checked<L>([](L& l, const Value& v, const WorldDesc&) { return read_dropouts(v, l.dropouts); })},
          {"dropout_rate", ValueType::Number, "1/s", 0, 10, "", "0", "further ones by chance, for each robot",
           into<L>([](L& l, const Value& v) { l.dropout_rate_hz = v.number; })},
          {"dropout_span", ValueType::Number, "s", 0.001, 3600, "", "1", "their length",
           into<L>([](L& l, const Value& v) { l.dropout_span_s = v.number; })},
      }};
}

SectionSpec robot_bluetooth_section() {
  using E = LinkEndDesc;
  return {
      "robot.bluetooth",
      false,
      "Its Bluetooth module. With `uart1` at a computer the module is linked to it when the world begins.",
      {
          {"number", ValueType::Integer, "", 0, 9999, "", "",
           "of the robot; its place in the file, from 1, otherwise",
           into<E>([](E& e, const Value& v) { e.number = static_cast<int>(v.integer); })},
          {"name", ValueType::Text, "", 0, 0, "", "", "what others find; made of its number otherwise",
           checked<E>([](E& e, const Value& v, const WorldDesc&) {
             if (v.text.size() > 40) {
               return fmt::format("got {} characters, expected at most 40", v.text.size());
             }
             e.name = v.text;
             return std::string();
           })},
          {"pin", ValueType::Text, "", 0, 0, "", "",
           "1 to 16 characters; its number as four digits otherwise",
           checked<E>([](E& e, const Value& v, const WorldDesc&) {
             if (v.text.empty() || v.text.size() > 16) {
               return fmt::format("got {} characters, expected 1 to 16", v.text.size());
             }
             e.pin = v.text;
             return std::string();
           })},
          {"dropouts", ValueType::Points, "s", 0, kMany, "", "", "as in `[bluetooth]`, for this robot alone",
           checked<E>([](E& e, const Value& v, const WorldDesc&) { return read_dropouts(v, e.dropouts); })},
      }};
}

}  // namespace sim
