// SPDX-License-Identifier: MIT
// What supervisors ask of the team: ends, resets, labels, pictures.
#include <fmt/format.h>

#include <filesystem>

#include "programs/team/team.h"
#include "sim_core/record/picture.h"

namespace programs {

void Team::end_run(int status, const std::string& why) {
  if (!outcome_.ended) outcome_ = {true, false, status == 0 ? 0 : 1, why};
}

void Team::reset(bool reload) {
  (reload ? wants_reload_ : wants_reset_) = true;
  resetter_ = in_turn_;
}

void Team::restart_program(int robot) { wants_restart_.insert(robot); }

/// Puts everything back to its beginning, at once, so that what the program commands next finds the world as
/// it began. Programs of robots begin anew, but for the one that asked for it, as in Webots; with a reload
/// all do.
void Team::carry_out_resets() {
  sim::Simulation& simulation = twin_.simulation();
  const bool resets = wants_reset_ || wants_reload_;
  // Programs of robots; the one that asked for the reset goes on in the world that begins.
  for (int r = 0; r < twin_.robots(); ++r) {
    if (!resets && wants_restart_.count(r) == 0) continue;
    if (wants_reset_ && !wants_reload_ && resetter_ && resetter_->robot == r && resetter_->partner) {
      resetter_->of_robot->runner()->reset_under_program();
      continue;
    }
    if (host::Runner* runner = twin_.mind(r).runner()) runner->restart();
  }
  if (resets) {
    // all that lies about is new; what came with the run is gone
    int movable = 0;
    for (const sim::ObjectDesc& object : at_first_->objects) movable += object.movable;
    simulation.refurnish(*at_first_, std::vector<int>(static_cast<std::size_t>(movable), -1));
    for (int r = 0; r < twin_.robots(); ++r) {
      moved_.insert(r);
      simulation.move(r, at_first_->robots[static_cast<std::size_t>(r)].pose);
      twin_.begin_again(r);
    }
    simulation.begin_again();
    for (const auto& member : members_)
      if (member->robot >= 0)
        member->custom = at_first_->robots[static_cast<std::size_t>(member->robot)].custom_data;
    make_nodes();
  }
  // Supervisors without a robot.
  for (const auto& member : members_) {
    if (!resets || !member->bodiless) continue;
    if (wants_reload_ || member.get() != resetter_)
      member->starts_anew = true;
    else
      member->bodiless->begin_again(simulation.now());
  }
  resetter_ = nullptr;
  for (const int r : wants_restart_) simulation.note_intervention(static_cast<std::uint64_t>(r));
  wants_reset_ = wants_reload_ = false;
  wants_restart_.clear();
}

void Team::set_label(int program, const sim::PictureLabel& label) {
  if (label.text.empty())
    labels_.erase({program, label.id});
  else
    labels_[{program, label.id}] = label;
}

std::vector<sim::PictureLabel> Team::labels() const {
  std::vector<sim::PictureLabel> all;
  for (const auto& [key, label] : labels_) all.push_back(label);
  return all;
}

std::string Team::device_name(int program, int tag) {
  return members_[static_cast<std::size_t>(program)]->body->device_name(tag);
}

void Team::picture(const std::string& file) {
  sim::PictureOptions options;
  options.caption = fmt::format("{:g} s, seed {}", now_s(), twin_.world().seed);
  options.labels = labels();
  // programs say where: their own folder
  const std::string path = (std::filesystem::path(run_folder_) / file).string();
  const std::string error =
      sim::write_picture(path, twin_.simulation().scene(), twin_.simulation().minds(), nullptr, options);
  if (!error.empty()) say(error);
}

void Team::note_custom_data(int robot, const std::string& text) {
  for (const auto& member : members_)
    if (member->robot == robot) {
      member->custom = text;
      member->has_new_custom = true;
    }
}

}  // namespace programs
