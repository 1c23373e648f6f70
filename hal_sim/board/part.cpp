// SPDX-License-Identifier: MIT
#include "hal_sim/board/part.h"

#include "hal_sim/board/board.h"
#include "sim_core/base/portable_math.h"
#include "sim_core/world/scene.h"

namespace board {

namespace {

constexpr std::uint32_t kPartStream = sim::kStreamBoard + 1024;  // + 16 a part
constexpr std::uint32_t kStreamsPerPart = 16;

}  // namespace

sim::Pose2 Part::pose(Cycle at) const {
  const sim::Scene* scene = board_->scene();
  return scene ? scene->pose(board_->setup().robot, board_->clock().click_at(at)) : sim::Pose2{};
}

Cycle Part::since_begin(Cycle at) const { return at - board_->noise().begun_at(); }

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
