// SPDX-License-Identifier: MIT
#include "outputs/curve_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hal_sim/board/epuck_params.h"
#include "sim_core/light/proximity.h"

namespace outputs {

namespace {

constexpr double kStepM = 0.00025;  // between points of a plotted line
constexpr double kTableStepM = 0.005;

struct Point {
  double counts, noise_counts;
};

/// What the converter leaves of a reading in the dark.
double within(double counts) { return std::clamp(counts, 0.0, double{board::kAdcMax}); }

Point at(const CurveRequest& q, const sim::FlatWall& wall, double distance_m) {
  const sim::ProximityResponse r = wall.at(distance_m);
  const double seen = r.value * q.gain;
  return {within(seen + q.offset_counts), std::fabs(seen * r.relative_noise)};
}

double longest_m(const std::vector<CurveRequest>& requests) {
  double most = 0;
  for (const CurveRequest& q : requests) most = std::max(most, q.config.max_range_m());
  return most;
}

/// Distances of the printed table: the rows of a single curve, round steps of several.
std::vector<double> table_distances(const std::vector<CurveRequest>& requests) {
  std::vector<double> out;
  if (requests.size() == 1 && requests[0].config.table.size() <= 20) {
    for (const sim::ResponseRow& row : requests[0].config.table) out.push_back(row.distance_m);
    return out;
  }
  const double end = longest_m(requests);
  for (int k = 0; k * 0.5 * kTableStepM < 0.02 - 1e-9; ++k) out.push_back(k * 0.5 * kTableStepM);
  for (int k = 4; k * kTableStepM < end + 1e-9 && k < 400; ++k) out.push_back(k * kTableStepM);
  return out;
}

/// Greatest distance at which the curve still stands above what it answers to nothing, m.
double sees_until_m(const CurveRequest& q, const sim::FlatWall& wall) {
  const double end = 1.0001 * q.config.max_range_m();
  const double nothing = wall.at(10 * q.config.max_range_m() + 1).value;
  double seen = 0;
  for (double d = 0; d <= end; d += 1e-4)
    if (wall.at(d).value > nothing + 0.5) seen = d;
  return seen;
}

}  // namespace

sim::CurveLine curve_line(const CurveRequest& q, const sim::Surface& surface) {
  const sim::FlatWall wall(q.config, surface);
  sim::CurveLine line;
  line.name = q.name;
  const double end = q.config.max_range_m();
  const int points = std::clamp(static_cast<int>(end / kStepM), 200, 4000);
  for (int i = 0; i <= points; ++i) {
    const double d = end * i / points;
    const Point p = at(q, wall, d);
    line.points.push_back(
        {d, p.counts, within(p.counts - p.noise_counts), within(p.counts + p.noise_counts)});
  }
  if (wall.factor() == 1 && q.config.rays == 1 && q.gain == 1 && q.offset_counts == 0 &&
      q.config.table.size() <= 20)
    line.table = q.config.table;
  return line;
}

std::string curve_table(const std::vector<CurveRequest>& requests, const sim::Surface& surface) {
  std::string text = fmt::format("{:>12}", "distance mm");
  for (const CurveRequest& q : requests) text += fmt::format(" {:>20}", q.name);
  text += '\n';
  std::vector<std::unique_ptr<sim::FlatWall>> walls;
  for (const CurveRequest& q : requests) walls.push_back(std::make_unique<sim::FlatWall>(q.config, surface));
  for (const double d : table_distances(requests)) {
    text += fmt::format("{:>12.4g}", 1000 * d);
    for (std::size_t i = 0; i < requests.size(); ++i) {
      const Point p = at(requests[i], *walls[i], d);
      text += fmt::format(" {:>20}", fmt::format("{:.1f} +- {:.1f}", p.counts, p.noise_counts));
    }
    text += '\n';
  }
  const auto row = [&](const char* name, auto value) {
    text += fmt::format("{:>12}", name);
    for (std::size_t i = 0; i < requests.size(); ++i)
      text += fmt::format(" {:>20}", value(requests[i], *walls[i]));
    text += '\n';
  };
  using Q = CurveRequest;
  using W = sim::FlatWall;
  row("rows", [](const Q& q, const W&) { return std::to_string(q.config.table.size()); });
  row("range mm", [](const Q& q, const W&) { return fmt::format("{:.4g}", 1000 * q.config.max_range_m()); });
  row("seen until",
      [](const Q& q, const W& w) { return fmt::format("{:.1f} mm", 1000 * sees_until_m(q, w)); });
  row("colour f", [](const Q&, const W& w) { return fmt::format("{:.4g}", w.factor()); });
  row("noise", [](const Q& q, const W&) {
    return std::string(q.config.noise_law == sim::NoiseLaw::Uniform ? "+- half width" : "+- 1 sigma");
  });
  return text;
}

nlohmann::ordered_json curve_json(const std::vector<CurveRequest>& requests, const sim::Surface& surface) {
  nlohmann::ordered_json out = nlohmann::ordered_json::array();
  for (const CurveRequest& q : requests) {
    const sim::FlatWall wall(q.config, surface);
    nlohmann::ordered_json points = nlohmann::ordered_json::array();
    for (const double d : table_distances(requests)) {
      const Point p = at(q, wall, d);
      points.push_back({{"distance_m", d}, {"counts", p.counts}, {"noise_counts", p.noise_counts}});
    }
    out.push_back({{"name", q.name},
                   {"rows", q.config.table.size()},
                   {"range_m", q.config.max_range_m()},
                   {"seen_until_m", sees_until_m(q, wall)},
                   {"factor", wall.factor()},
                   {"noise_law", q.config.noise_law == sim::NoiseLaw::Uniform ? "uniform" : "gaussian"},
                   {"points", std::move(points)}});
  }
  return out;
}

}  // namespace outputs
