// SPDX-License-Identifier: MIT
#include "supervisor/team.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "supervisor/build.h"

namespace supervisor {

// --- Things

Things::Things(const sim::Simulation& simulation) : robots_(simulation.robots()) {
  const sim::WorldDesc& world = simulation.scene().world();
  const sim::Layout& layout = simulation.scene().layout();
  for (int r = 0; r < robots_; ++r) {
    names_.push_back(world.robots[static_cast<std::size_t>(r)].name);
    defs_.push_back(world.robots[static_cast<std::size_t>(r)].def);
    places_.push_back({r, true});
  }
  for (std::size_t o = 0; o < world.objects.size(); ++o) {
    const int object = static_cast<int>(o);
    names_.push_back(world.objects[o].name);
    defs_.push_back(world.objects[o].def);
    sim::Candidate place{-1, false};
    for (std::size_t i = 0; i < layout.loose_object.size(); ++i)
      if (layout.loose_object[i] == object) place = {robots_ + static_cast<int>(i), true};
    for (std::size_t i = 0; i < layout.fixed_object.size(); ++i)
      if (layout.fixed_object[i] == object) place = {static_cast<int>(i), false};
    places_.push_back(place);
  }
}

int Things::find(const std::string& name) const {
  if (name.empty()) return -1;
  for (const std::vector<std::string>* list : {&defs_, &names_}) {
    const auto found = std::find(list->begin(), list->end(), name);
    if (found != list->end()) return static_cast<int>(found - list->begin());
  }
  return -1;
}

// --- Member

Member::Member(Team& its_team, int number, const sim::SupervisorDesc& desc)
    : team(its_team), index(number), name(desc.name), period_s(desc.period_s) {}

bool Member::listens(int channel) const {
  return channel == sim::kAllChannels ? !channels.empty()
                                      : channels.count(channel) > 0 || channels.count(sim::kAllChannels) > 0;
}

int Member::refuse(const std::string& what) {
  last_error = what;
  constexpr std::size_t kMostTold = 50;  // different texts; more would help nobody
  if (told_.size() < kMostTold && told_.insert(what).second)
    team.say(fmt::format("supervisor '{}', t={:.6f} s: {}", name, team.now_s(), what));
  return -1;
}

double Member::step(double seconds) {
  const sim::Simulation& simulation = team.simulation();
  const sim::Clicks before = simulation.now(), tick = simulation.scene().tick_clicks();
  if (finishing_) {
    // it was told once; whoever goes on stepping has nothing more to say
    while (over_) Program::wait();
    over_ = true;
    return -1;
  }
  constexpr double kLongest = 1e9;  // s
  // periods follow each other exactly, however ticks round them; a step counts from now
  wake_ = seconds > 0 ? before + sim::from_seconds(std::min(seconds, kLongest))
                      : wake_ + sim::from_seconds(period_s);
  wake_ = std::max(wake_, before + tick);
  Program::wait();
  if (!finishing_) return sim::to_seconds(simulation.now() - before);
  over_ = true;
  return -1;
}

// --- Team

Team::Team(twin::Twin& twin, std::vector<sim::SupervisorDesc> descs)
    : run_folder_(std::filesystem::current_path().string()), twin_(twin), things_(twin.simulation()) {
  say = [](const std::string& line) { std::fprintf(stderr, "%s\n", line.c_str()); };
  for (std::size_t i = 0; i < descs.size(); ++i)
    members_.push_back(std::make_unique<Member>(*this, static_cast<int>(i), descs[i]));
}

Team::~Team() {
  if (!members_.empty()) twin_.simulation().attend(nullptr);
}

std::unique_ptr<Team> Team::open(twin::Twin& twin, const twin::Options& options,
                                 const std::vector<std::string>& extra, std::vector<std::string>& problems) {
  std::vector<sim::SupervisorDesc> descs = twin.world().supervisors;
  const std::size_t of_world = descs.size(), before = problems.size();
  for (const std::string& program : extra) {
    sim::SupervisorDesc desc;
    desc.program = program;
    descs.push_back(desc);
  }
  for (std::size_t i = 0; i < descs.size(); ++i) {
    if (!descs[i].name.empty()) continue;
    std::string stem = descs[i].program.substr(descs[i].program.find_last_of('/') + 1);
    descs[i].name = stem.substr(0, stem.find_last_of('.'));
  }
  std::vector<std::string> paths;
  for (std::size_t i = 0; i < descs.size(); ++i)
    paths.push_back(
        provide_program(descs[i].program, i < of_world ? options.world_folder : "", options.tell, problems));
  if (problems.size() != before) return nullptr;
  std::unique_ptr<Team> team(new Team(twin, descs));
  for (std::size_t i = 0; i < descs.size(); ++i) {
    Member& member = *team->members_[i];
    const std::string folder = program_folder(descs[i].program, i < of_world ? options.world_folder : "");
    member.program = Program::open(paths[i], member.name, folder, descs[i].args, &member, problems);
  }
  if (problems.size() != before) return nullptr;
  for (const auto& member : team->members_) twin.packets().add(*member);
  if (!team->members_.empty()) twin.simulation().attend(team.get());
  return team;
}

void Team::before_first_tick() {
  if (began_) return;
  began_ = true;
  take_turns();
}

void Team::after_tick() {
  if (!began_) before_first_tick();
  if (ways_) ways_->sample(simulation().scene());
  moved_.clear();
  for (const auto& member : members_) take_notes(*member);
  take_turns();
}

void Team::take_turns() {
  for (const auto& member : members_) {
    if (outcome_.ended) return;  // the others have their last go in finish()
    if (member->program->state() != Program::State::Waiting || member->wake_ > simulation().now()) continue;
    member->program->run();
    look_after(*member);
  }
}

/// A program that has come back may be over.
void Team::look_after(Member& member) {
  const Program& program = *member.program;
  if (program.state() == Program::State::Crashed) {
    end({true, true, 1,
         fmt::format("supervisor '{}', t={:.6f} s: crashed: {}", member.name, now_s(), program.crash())});
  } else if (program.state() == Program::State::Done && program.exit_status() != 0) {
    end({true, false, 1,
         fmt::format("supervisor '{}', t={:.6f} s: {} {}", member.name, now_s(),
                     program.has_exited() ? "ended by exit() with" : "main() returned",
                     program.exit_status())});
  }
}

void Team::end(Outcome outcome) {
  if (!outcome_.ended || (outcome.crashed && !outcome_.crashed)) outcome_ = std::move(outcome);
}

void Team::finish() {
  if (finished_) return;
  finished_ = true;
  if (!began_) before_first_tick();
  for (const auto& member : members_) {
    member->finishing_ = true;
    member->program->run();
    look_after(*member);
  }
}

void Team::take_notes(Member& member) {
  const sim::Clicks now = simulation().now();
  for (auto& [thing, track] : member.tracks) {
    if (now < track.next) continue;
    track.next = std::max(now + 1, track.next + sim::from_seconds(track.every_s));
    const int body = things_.body(thing);
    if (body < 0) continue;
    const sim::BodyState& state = simulation().state(body);
    if (!track.lifted && !track.notes.empty()) {
      const sim::Pose2& last = track.notes.back().pose;
      track.length_m += std::hypot(state.pose.x_m - last.x_m, state.pose.y_m - last.y_m);
    }
    track.lifted = false;
    track.notes.push_back({now_s(), state.pose, state.z_m});
  }
}

void Team::note_move(int thing) {
  const int body = things_.body(thing);
  if (things_.is_robot(thing)) {
    moved_.insert(body);
    if (ways_) ways_->lift_pen(body);
  }
  for (const auto& member : members_) {
    const auto track = member->tracks.find(thing);
    if (track != member->tracks.end()) track->second.lifted = true;
  }
}

void Team::note_reset(int robot, bool program) {
  Reset& reset = resets_[robot];
  (program ? reset.program : reset.place) = simulation().now();
  if (reset.place != reset.program) return;
  twin_.begin_again(robot);
  // whoever is switched off does nothing that could differ
  for (int r = 0; r < twin_.robots(); ++r) {
    const Reset& other = resets_[r];
    const bool begins = other.place == simulation().now() && other.program == simulation().now();
    if (!begins && !twin_.image_path(r).empty()) return;
  }
  simulation().begin_again();
}

std::string Team::file_of_run(const char* file) const {
  return file && *file ? (std::filesystem::path(run_folder_) / file).string() : "";
}

void Team::keep_ways() {
  if (ways_) return;
  ways_ = std::make_unique<sim::Trajectories>(simulation().robots());
  ways_->sample(simulation().scene());
}

void Team::set_label(int member, const sim::PictureLabel& label) {
  if (label.text.empty()) {
    labels_.erase({member, label.id});
  } else {
    labels_[{member, label.id}] = label;
  }
}

std::vector<sim::PictureLabel> Team::labels() const {
  std::vector<sim::PictureLabel> all;
  for (const auto& [key, label] : labels_) all.push_back(label);
  return all;
}

}  // namespace supervisor
