// SPDX-License-Identifier: MIT
#include "viewer/robot_look.h"

#include "hal_sim/board/camera_params.h"
#include "sim_core/base/base64.h"

namespace viewer {

using Json = nlohmann::json;

RobotLook::RobotLook(twin::Twin& twin, int robot) : twin_(twin), robot_(robot) {
  // called while the robot runs, and read between ticks
  if (board::Camera* camera = twin.mind(robot).board().camera()) {
    before_ = camera->on_picture;
    camera->on_picture = [this](const board::CameraPicture& picture) {
      if (before_) before_(picture);
      const auto pixels = static_cast<std::size_t>(picture.columns) * static_cast<std::size_t>(picture.rows);
      // one that had begun before anybody looked is not whole
      if (pixels > 0 && picture.bytes.size() >= pixels && picture.bytes.size() % pixels == 0)
        picture_ = picture;
    };
  }
}

RobotLook::~RobotLook() {
  if (board::Camera* camera = twin_.mind(robot_).board().camera()) camera->on_picture = before_;
}

Json RobotLook::take() {
  const host::FirmwareMind& mind = std::as_const(twin_).mind(robot_);
  Json look{{"event", "look"}, {"robot", twin_.world().robots[static_cast<std::size_t>(robot_)].name}};
  // Where its program is.
  if (const host::Runner* program = mind.runner()) {
    const host::Place place = program->data().place_now();
    look["place"] = {{"function", place.function}, {"file", place.file}, {"line", place.line}};
    look["hal"] = twin_.hal(robot_);
  }
  // What its parts and its camera show.
  Json parts = Json::array();
  for (const auto& part : mind.board().parts())
    parts.push_back({{"kind", part->settings().kind()}, {"shows", part->shows(mind.now())}});
  look["parts"] = std::move(parts);
  if (const board::Camera* camera = mind.board().camera()) {
    const bool has_picture = picture_.columns > 0;
    look["camera"] = {{"at", {board::kCameraXM, 0, board::kCameraZM}},
                      {"edges", has_picture ? picture_.edges : camera->widest_edges()},
                      {"pictures", camera->pictures()}};
    if (has_picture) {
      if (packed_ != picture_.number) {
        const auto rgb = board::decode_picture(picture_);
        pixels_ = sim::base64(std::string(rgb.begin(), rgb.end()));
        packed_ = picture_.number;
      }
      look["picture"] = {{"number", picture_.number},
                         {"columns", picture_.columns},
                         {"rows", picture_.rows},
                         {"bytes_per_pixel",
                          picture_.bytes.size() / static_cast<std::size_t>(picture_.columns * picture_.rows)},
                         {"rgb", pixels_}};
    }
  }
  // Only what is new is told.
  if (look == told_) return {};
  told_ = look;
  look["time_s"] = sim::to_seconds(twin_.simulation().now());
  return look;
}

}  // namespace viewer
