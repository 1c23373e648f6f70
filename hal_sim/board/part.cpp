// SPDX-License-Identifier: MIT
#include "hal_sim/board/part.h"

#include <cstdlib>

#include "hal_sim/board/board.h"
#include "sim_core/base/check.h"
#include "sim_core/base/portable_math.h"
#include "sim_core/world/scene.h"

namespace board {

namespace {

constexpr std::uint32_t kPartStream = sim::kStreamBoard + 1024;  // + 16 a part
constexpr std::uint32_t kStreamsPerPart = 16;

/// The numbers in a default such as "0.1" or "[0.03, 0]".
std::vector<double> numbers_in(const std::string& text) {
  std::vector<double> out;
  for (const char* p = text.c_str(); *p;) {
    char* end = nullptr;
    const double value = std::strtod(p, &end);
    if (end == p) {
      ++p;
    } else {
      out.push_back(value);
      p = end;
    }
  }
  return out;
}

}  // namespace

const sim::PartKey& PartSettings::key_of(const std::string& key) const {
  for (const sim::PartKey& k : kind_->keys)
    if (k.key == key) return k;
  CHECK(false, "a part asks for a key that its kind does not list");
  return kind_->keys.front();
}

std::vector<double> PartSettings::numbers(const std::string& key) const {
  const sim::PartKey& k = key_of(key);
  const auto found = desc_.values.find(key);
  return found != desc_.values.end() ? found->second.numbers : numbers_in(k.fallback);
}

double PartSettings::number(const std::string& key) const {
  const std::vector<double> all = numbers(key);
  CHECK(!all.empty(), "a part asks for the number of a key that has none and no default");
  return all.front();
}

bool PartSettings::flag(const std::string& key) const {
  const sim::PartKey& k = key_of(key);
  const auto found = desc_.values.find(key);
  return found != desc_.values.end() ? found->second.flag : k.fallback == "true";
}

std::string PartSettings::text(const std::string& key) const {
  const sim::PartKey& k = key_of(key);
  const auto found = desc_.values.find(key);
  if (found != desc_.values.end()) return found->second.text;
  const std::string& f = k.fallback;  // in quotes
  return f.size() >= 2 && f.front() == '"' ? f.substr(1, f.size() - 2) : std::string();
}

sim::Pose2 Part::pose(Cycle at) const {
  const sim::Scene* scene = board_->scene();
  return scene ? scene->pose(board_->setup().robot, board_->clock().click_at(at)) : sim::Pose2{};
}

sim::Vec2 Part::to_world(sim::Vec2 point_m, Cycle at) const {
  const sim::Pose2 p = pose(at);
  const sim::SinCos turn = sim::sin_cos(p.heading_rad);
  return {p.x_m + turn.c * point_m.x - turn.s * point_m.y, p.y_m + turn.s * point_m.x + turn.c * point_m.y};
}

sim::RandomKey Part::random(int stream) const {
  const std::uint32_t own = static_cast<std::uint32_t>(settings_.part_number()) * kStreamsPerPart;
  return {board_->setup().seed, static_cast<std::uint32_t>(board_->setup().robot),
          kPartStream + own + static_cast<std::uint32_t>(stream)};
}

const PartType* find_part_type(const std::string& kind) {
  for (const PartType* type : part_types())
    if (type->kind.name == kind) return type;
  return nullptr;
}

std::vector<sim::PartKind> part_kinds() {
  std::vector<sim::PartKind> out;
  for (const PartType* type : part_types()) out.push_back(type->kind);
  return out;
}

}  // namespace board
