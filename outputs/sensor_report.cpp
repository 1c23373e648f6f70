// SPDX-License-Identifier: MIT
#include "outputs/sensor_report.h"

#include "hal_sim/drivers/drivers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace outputs {

namespace {

using Json = nlohmann::ordered_json;

constexpr double kTwoSided95 = 1.96;  // standard deviations that hold 95 of 100 samples

double mm(double metres) { return 1000 * metres; }
double volts(double counts) {
  return std::clamp(counts, 0.0, double{board::kAdcMax}) * board::kAdcReferenceV / board::kAdcMax;
}

std::string side(double bearing_rad) {
  const double degrees = sim::degrees(bearing_rad);
  if (std::fabs(degrees) < 0.05) return "straight ahead";
  return fmt::format("{:.1f} deg to the {} of the nose", std::fabs(degrees), degrees > 0 ? "left" : "right");
}

const char* rule_name(const sim::ProximityConfig& c) {
  if (c.type == sim::SensorType::Generic) return "none (generic)";
  return c.colour_rule == sim::ColourRule::Old   ? "old"
         : c.colour_rule == sim::ColourRule::New ? "new"
                                                 : "none";
}

const char* law_name(bool uniform) { return uniform ? "uniform" : "gaussian"; }

std::string settings_text(const sim::ProximityConfig& c) {
  std::string text =
      (c.profile.empty() ? fmt::format("own table of {} rows", c.table.size()) : "profile " + c.profile) +
      (c.type == sim::SensorType::Generic ? ", generic" : ", infra-red") + ", colour rule " + rule_name(c) +
      fmt::format(", range {:.4g} mm, ", mm(c.max_range_m()));
  if (c.rays == 1) {
    text += "1 ray";
  } else {
    text += fmt::format("{} rays, aperture {:.4g} rad, gaussian width {:.4g}, {}", c.rays, c.aperture_rad,
                        c.gaussian_width, c.layout == sim::RayLayout::Fan ? "fan" : "cone");
  }
  return text;
}

std::string row_text(int row, const sim::ResponseRow& r) {
  return fmt::format("row {} ({:.4g} mm: {:.6g}, noise {:.4g})", row + 1, mm(r.distance_m), r.value,
                     r.relative_noise);
}

std::string table_text(const SensorReport& r) {
  const sim::TableStep& s = r.proximity.step;
  const std::string result =
      fmt::format("{:.2f} counts, relative noise {:.4g}", s.result.value, s.result.relative_noise);
  if (s.fraction == 0)
    return row_text(s.row, s.from) + (s.clamped ? ", clamped beyond the table's end: " : ": ") + result;
  return fmt::format("{:.1f} % of the way from {} to {}: {}", 100 * s.fraction, row_text(s.row, s.from),
                     row_text(s.row + 1, s.to), result);
}

std::string noise_text(const SensorReport& r) {
  const sim::ProximityResponse& p = r.proximity.response;
  const char* what = p.uniform_noise ? "half width" : "standard deviation";
  if (r.proximity.config.noise_scale == 0)
    return std::string(law_name(p.uniform_noise)) + ", switched off: scale 0";
  return fmt::format("{}, {} {:.2f} % of the value (noise scale {:.4g} included) = {:.1f} counts",
                     law_name(p.uniform_noise), what, 100 * p.relative_noise, r.proximity.config.noise_scale,
                     r.noise_counts);
}

std::string rays_text(const SensorReport& r) {
  const bool singly = r.proximity.config.rays_answer_singly;
  std::string text = fmt::format("  {:>3} {:>9} {:>8} {:>8} {:>6}  {:<20} {:>9} {:>5} {:>7} {:>9}{}\n", "ray",
                                 "off axis", "azimuth", "bearing", "rise", "hit", "distance", "f", "weight",
                                 "seems at", singly ? "   answers" : "");
  for (std::size_t i = 0; i < r.proximity.rays.size(); ++i) {
    const sim::RayExplanation& ray = r.proximity.rays[i];
    text += fmt::format(
        "  {:>3} {:>5.2f} deg {:>4.0f} deg {:>4.0f} deg {:>6.1f}  {:<20} {:>6.2f} mm {:>5.3f} {:>7.4f} "
        "{:>6.2f} mm",
        i, sim::degrees(ray.off_axis_rad), sim::degrees(ray.azimuth_rad), sim::degrees(ray.bearing_rad),
        sim::degrees(ray.rise_rad), ray.trace.hit ? ray.met.name : "nothing in range",
        mm(ray.trace.distance_m), ray.trace.colour_factor, ray.trace.weight, mm(ray.apparent_m));
    if (singly) text += fmt::format("  {:>8.2f}", ray.answer_counts);
    text += '\n';
  }
  return text;
}

std::string light_text(const SensorReport& r) {
  std::string text = fmt::format("  light      {:.4g} W/m2 from everywhere", r.light.ambient_w_m2);
  for (const sim::LampExplanation& l : r.light.lamps) {
    const sim::LampShare& s = l.share;
    text += fmt::format("\n             {}: ", l.name);
    if (!s.on) {
      text += "off";
    } else if (s.facing <= 0) {
      text += fmt::format("behind the sensor ({:.3f} m away)", s.distance_m);
    } else if (s.blocked) {
      text += fmt::format("{:.3f} m away, in the shadow of {}", s.distance_m, l.blocked_by);
    } else {
      text += fmt::format("{:.4g} W/m2: {:.3f} m away, attenuated {:.4g} times, cosine to the axis {:.4f}",
                          s.w_m2, s.distance_m, s.divisor, s.facing);
    }
  }
  return text + fmt::format("\n             together {:.4g} W/m2, {:.1f} counts below darkness\n",
                            r.light.total_w_m2, r.dark_made_of.light_counts);
}

Json surface_json(const sim::Surface& s) {
  return {{"colour", {s.colour.r, s.colour.g, s.colour.b}},
          {"ir_reflectance", s.ir_reflectance},
          {"roughness", s.roughness}};
}

Json row_json(int row, const sim::ResponseRow& r) {
  return {
      {"row", row}, {"distance_m", r.distance_m}, {"counts", r.value}, {"relative_noise", r.relative_noise}};
}

}  // namespace

SensorReport report_sensor(twin::Twin& twin, const std::string& world_file, int robot, int sensor) {
  const sim::Scene& scene = twin.simulation().scene();
  host::FirmwareMind& mind = twin.mind(robot);
  board::Board& board = mind.board();
  board.look_at(&scene);
  const board::Cycle cycle = std::max<board::Cycle>(0, board.clock().cycle_at(scene.now()));
  const sim::Clicks at = board.clock().click_at(cycle);  // the instant that a conversion at this cycle sees
  SensorReport r;
  r.world = world_file;
  r.robot = scene.world().robots[static_cast<std::size_t>(robot)].name;
  r.robot_index = robot;
  r.sensor = sensor;
  r.at_s = sim::to_seconds(scene.now());
  r.heading_rad = scene.pose(robot, at).heading_rad;
  r.proximity = sim::explain_proximity(scene, robot, sensor, at);
  r.light = sim::explain_light(scene, robot, sensor, at);
  r.gain = board.setup().ir_gain[static_cast<std::size_t>(sensor)];
  r.offset_counts = board.setup().ir_offset_counts[static_cast<std::size_t>(sensor)];
  const board::Cycle flash = drivers::scan_flash_cycles(sensor);
  r.flash_us = 1e6 * static_cast<double>(flash) / static_cast<double>(board::kFcyHz);
  r.dark_made_of = board.ir().conversion(sensor, cycle, -1);
  r.lit_made_of = board.ir().conversion(sensor, cycle, flash);
  const auto sample = [](double level) { return Sample{volts(level), board::adc_counts(level)}; };
  r.dark = sample(r.dark_made_of.counts());
  r.lit = sample(r.lit_made_of.counts());
  r.prox_counts = r.dark.counts - r.lit.counts;
  const board::IrConversion& lit = r.lit_made_of;
  r.noise_counts = lit.reflection_counts * lit.relative_noise * board.setup().ir_noise_scale * lit.settled;
  const double reach = std::fabs(r.noise_counts) * (lit.uniform_noise ? 1 : kTwoSided95);
  r.band_low = r.dark.counts - board::adc_counts(lit.counts() + reach);
  r.band_high = r.dark.counts - board::adc_counts(lit.counts() - reach);
  const drivers::Drivers* drivers = mind.runner() ? mind.runner()->closed_drivers() : nullptr;
  if (!drivers) return r;
  const drivers::AdcScan& scan = drivers->scan();
  const board::Cycle now = mind.now();
  r.firmware_scans = scan.dark_number(sensor, now) >= 0 && scan.lit_number(sensor, now) >= 0;
  if (r.firmware_scans) {
    r.held_dark = scan.peek_dark(sensor, now);
    r.held_lit = scan.peek_lit(sensor, now);
  }
  return r;
}

std::string to_text(const SensorReport& r) {
  const sim::ProximityExplanation& p = r.proximity;
  std::string text = fmt::format("{}: robot {}, sensor {} at {:.4g} s\n", r.world, r.robot, r.sensor, r.at_s);
  text += fmt::format("  sensor     at [{:.4f}, {:.4f}] m, {:.0f} mm high, looks {}\n", p.at_m.x, p.at_m.y,
                      mm(p.at_m.z), side(p.bearing_rad));
  text += "  settings   " + settings_text(p.config) + "\n";
  text += rays_text(r);
  text += fmt::format("  together   {:.2f} mm / {:.4g} = {:.2f} mm apparent distance\n", mm(p.distance_m),
                      p.factor, mm(p.response.apparent_distance_m));
  if (p.config.rays_answer_singly) {
    text += fmt::format("  value      {:.2f} counts: rays answer singly and add up\n", p.response.value);
  } else {
    text += "  table      " + table_text(r) + "\n";
  }
  text += "  noise      " + noise_text(r) + "\n";
  text +=
      fmt::format("  robot      gain {:.4g}, offset {:.4g} counts; flash of {:.0f} us, {:.2f} % followed\n",
                  r.gain, r.offset_counts, r.flash_us, 100 * r.lit_made_of.settled);
  text += light_text(r);
  text += fmt::format("  dark       {:.3f} V, {} counts: what e_get_ambient_light({}) returns\n",
                      r.dark.volts, r.dark.counts, r.sensor);
  text += fmt::format("  lit        {:.3f} V, {} counts\n", r.lit.volts, r.lit.counts);
  text += fmt::format("  reading    e_get_prox({}) = {} without noise", r.sensor, r.prox_counts);
  if (r.noise_counts != 0)
    text += fmt::format(", {} between {} and {}", r.lit_made_of.uniform_noise ? "always" : "95 times in 100",
                        r.band_low, r.band_high);
  text += '\n';
  if (r.firmware_scans)
    text += fmt::format("  held now   dark {}, lit {}: the program's e_get_prox({}) returns {}\n",
                        r.held_dark, r.held_lit, r.sensor, r.held_dark - r.held_lit);
  return text;
}

std::string overview_head() {
  return fmt::format("{:>6}  {:>8}  {:<20} {:>10} {:>10} {:>6} {:>6} {:>6}\n", "sensor", "bearing",
                     "nearest hit", "distance", "apparent", "dark", "lit", "prox");
}

std::string overview_line(const SensorReport& r) {
  const sim::RayExplanation* nearest = nullptr;
  for (const sim::RayExplanation& ray : r.proximity.rays) {
    if (ray.trace.hit && (!nearest || ray.trace.distance_m < nearest->trace.distance_m)) nearest = &ray;
  }
  return fmt::format("{:>6}  {:>4.0f} deg  {:<20} {:>7.2f} mm {:>7.2f} mm {:>6} {:>6} {:>6}\n", r.sensor,
                     sim::degrees(r.proximity.bearing_rad), nearest ? nearest->met.name : "nothing in range",
                     mm(r.proximity.distance_m), mm(r.proximity.response.apparent_distance_m), r.dark.counts,
                     r.lit.counts, r.prox_counts);
}

Json to_json(const SensorReport& r) {
  const sim::ProximityExplanation& p = r.proximity;
  Json rays = Json::array();
  for (const sim::RayExplanation& ray : p.rays) {
    Json j = {{"off_axis_rad", ray.off_axis_rad},
              {"azimuth_rad", ray.azimuth_rad},
              {"bearing_rad", ray.bearing_rad},
              {"rise_rad", ray.rise_rad},
              {"hit", ray.trace.hit},
              {"distance_m", ray.trace.distance_m},
              {"factor", ray.trace.colour_factor},
              {"weight", ray.trace.weight},
              {"apparent_m", ray.apparent_m}};
    if (ray.trace.hit) {
      j["what"] = ray.met.name;
      j["surface"] = surface_json(ray.met.surface);
    }
    if (p.config.rays_answer_singly) j["answer_counts"] = ray.answer_counts;
    rays.push_back(std::move(j));
  }
  Json lamps = Json::array();
  for (const sim::LampExplanation& l : r.light.lamps) {
    Json j = {{"name", l.name},           {"on", l.share.on},           {"distance_m", l.share.distance_m},
              {"facing", l.share.facing}, {"divisor", l.share.divisor}, {"w_m2", l.share.w_m2}};
    if (l.share.blocked) j["blocked_by"] = l.blocked_by;
    lamps.push_back(std::move(j));
  }
  const sim::ProximityConfig& c = p.config;
  Json out = {
      {"world", r.world},
      {"robot", r.robot},
      {"sensor", r.sensor},
      {"at_s", r.at_s},
      {"settings",
       {{"profile", c.profile.empty() ? Json(nullptr) : Json(c.profile)},
        {"type", c.type == sim::SensorType::Generic ? "generic" : "infra-red"},
        {"colour_rule", rule_name(c)},
        {"rays", c.rays},
        {"aperture_rad", c.aperture_rad},
        {"gaussian_width", c.gaussian_width},
        {"layout", c.layout == sim::RayLayout::Fan ? "fan" : "cone"},
        {"range_m", c.max_range_m()},
        {"table_rows", c.table.size()},
        {"noise_scale", c.noise_scale}}},
      {"rays", std::move(rays)},
      {"distance_m", p.distance_m},
      {"factor", p.factor},
      {"apparent_distance_m", p.response.apparent_distance_m},
      {"table",
       {{"from", row_json(p.step.row, p.step.from)},
        {"to", row_json(p.step.fraction == 0 ? p.step.row : p.step.row + 1, p.step.to)},
        {"fraction", p.step.fraction},
        {"clamped", p.step.clamped}}},
      {"value_counts", p.response.value},
      {"noise",
       {{"law", law_name(p.response.uniform_noise)},
        {"relative", p.response.relative_noise},
        {"counts", r.noise_counts},
        {"band", {r.band_low, r.band_high}}}},
      {"robot_gain", r.gain},
      {"robot_offset_counts", r.offset_counts},
      {"flash_us", r.flash_us},
      {"light",
       {{"ambient_w_m2", r.light.ambient_w_m2},
        {"lamps", std::move(lamps)},
        {"total_w_m2", r.light.total_w_m2}}},
      {"dark", {{"volts", r.dark.volts}, {"counts", r.dark.counts}}},
      {"lit", {{"volts", r.lit.volts}, {"counts", r.lit.counts}}},
      {"prox_counts", r.prox_counts},
  };
  if (r.firmware_scans)
    out["held"] = {{"dark", r.held_dark}, {"lit", r.held_lit}, {"prox", r.held_dark - r.held_lit}};
  return out;
}

}  // namespace outputs
