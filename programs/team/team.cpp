// SPDX-License-Identifier: MIT
#include "programs/team/team.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "programs/team/names.h"

namespace programs {

namespace fs = std::filesystem;

Team::Team(twin::Twin& twin, const twin::Options&) : twin_(twin), run_folder_(fs::current_path().string()) {
  say = [](const std::string& text) { std::fprintf(stderr, "%s\n", text.c_str()); };
}

Team::~Team() {
  if (!members_.empty()) twin_.simulation().attend(nullptr);
  link_free(&packet_);
}

void note_supervisors(const sim::WorldDesc& world, const std::string& world_folder,
                      const std::vector<std::string>& supervisors, sim::FileUses& files) {
  std::vector<std::string> missing;  // told when it is to run
  for (const NamedSupervisor& named : supervisors_of(world, world_folder, supervisors, missing))
    files.reads_program(twin::find_supervisor(named.desc.program, named.folder, missing));
}

std::unique_ptr<Team> Team::open(twin::Twin& twin, const twin::Options& options,
                                 const std::vector<std::string>& supervisors,
                                 std::vector<std::string>& problems) {
  const std::size_t before = problems.size();
  std::unique_ptr<Team> team(new Team(twin, options));
  const sim::WorldDesc& world = twin.world();
  for (int r = 0; r < twin.robots(); ++r) {
    if (!twin.launch(r)) continue;
    const sim::RobotDesc& robot = world.robots[static_cast<std::size_t>(r)];
    auto member = std::make_unique<Member>();
    member->name = robot.name;
    member->robot = r;
    member->is_supervisor = robot.supervisor;
    member->launch = *twin.launch(r);
    member->arguments = robot.args;
    member->custom = robot.custom_data;
    auto body = std::make_shared<RobotBody>(twin.seat(r));
    member->of_robot = body.get();
    member->body = std::move(body);
    team->members_.push_back(std::move(member));
  }
  for (const NamedSupervisor& named : supervisors_of(world, options.world_folder, supervisors, problems)) {
    auto member = std::make_unique<Member>();
    member->name = named.desc.name;
    member->is_supervisor = true;
    member->arguments = named.desc.args;
    member->custom = named.desc.custom_data;
    member->supervisor = named.of_world;
    const std::size_t of_others = problems.size();
    if (!twin::provide_launch(named.desc.program, named.folder, options, problems, member->launch)) {
      if (problems.size() > of_others)
        problems[of_others] = "supervisor '" + named.desc.name + "': " + problems[of_others];
      continue;
    }
    auto body = std::make_shared<BodilessBody>(named.desc);
    twin.packets().add(*body);
    member->bodiless = body.get();
    member->body = std::move(body);
    team->members_.push_back(std::move(member));
  }
  if (problems.size() != before) return nullptr;
  if (team->members_.empty()) return team;
  team->at_first_ = std::make_unique<const sim::WorldDesc>(world);
  team->make_nodes();
  twin.simulation().attend(team.get());
  return team;
}

void Team::make_nodes() {
  // after a reset programs go on with the numbers of nodes and fields that they have
  if (nodes_) return nodes_->begin_again();
  nodes_ = std::make_unique<Nodes>(static_cast<SupervisorHost&>(*this));
  for (const auto& member : members_)
    if (member->supervisor >= 0) nodes_->attach(number_of(*member), member->supervisor);
}

int Team::number_of(const Member& member) const {
  for (std::size_t i = 0; i < members_.size(); ++i)
    if (members_[i].get() == &member) return static_cast<int>(i);
  return -1;
}

// --- between ticks

void Team::before_first_tick() {
  if (began_) return;
  began_ = true;
  take_turns();
}

void Team::after_tick() {
  if (!began_) return before_first_tick();
  moved_.clear();
  take_turns();
}

void Team::take_turns() {
  constexpr int kMostRounds = 100;
  for (int round = 0;; ++round) {
    if (should_give_up && should_give_up()) return;
    // whoever reloads the world as soon as it begins would do so for ever
    if (round == kMostRounds) return end_beginners();
    // all that are to begin are started before anybody waits for one of them
    for (const auto& member : members_) {
      // another program was flashed into its robot
      if (member->of_robot && !member->of_robot->runner()) {
        if (member->partner) over(*member);
        continue;
      }
      if (is_to_begin(*member) || (!member->partner && !member->is_over)) begin(*member);
    }
    // Programs whose step has ended get their samples, all before the first of them commands anything.
    const sim::Clicks now = twin_.simulation().now();
    std::vector<Member*> due;
    for (const auto& member : members_)
      if (member->partner && (!member->has_said_hello || member->body->is_due(now)))
        due.push_back(member.get());
    bool is_as_it_will_be = true;  // until a supervisor that may change the world comes before
    for (Member* member : due) {
      if (member->has_said_hello) hand_over_samples(*member, is_as_it_will_be);
      is_as_it_will_be = is_as_it_will_be && !member->is_supervisor;
    }
    // Each in turn commands what it likes, up to its next step.
    for (Member* member : due) {
      if (outcome_.ended) return;  // the others have their last go in finish()
      in_turn_ = member;
      if (member->partner && !is_to_begin(*member)) turn(*member);
      in_turn_ = nullptr;
      if (member->robot >= 0) twin_.mind(member->robot).wake();
    }
    // steps shorter than a tick: the next one may have ended as well; and a reset has programs begin
    if (due.empty()) break;
  }
}

void Team::end_beginners() {
  for (const auto& member : members_) {
    if (!is_to_begin(*member)) continue;
    member->starts_anew = false;
    if (member->of_robot) member->began = member->of_robot->began();
    fail(*member, "has the world begin again and again at one instant; it was ended");
  }
}

/// It was not started since its robot, or the world, began anew.
bool Team::is_to_begin(const Member& member) const {
  return member.starts_anew ||
         (member.of_robot && member.of_robot->runner() && member.began != member.of_robot->began());
}

/// Its process is started, or is waited for.
void Team::begin(Member& member) {
  member.starts_anew = false;
  member.partner.reset();
  member.has_said_hello = member.is_over = member.is_waiting = member.is_told_end = false;
  member.text.clear();
  member.place = {};
  nodes_->forget_followed(number_of(member));
  if (member.of_robot) {
    member.began = member.of_robot->began();
    member.launch = *twin_.launch(member.robot);  // may have been built anew
  }
  if (member.bodiless) {
    member.bodiless->restart();
    member.bodiless->begin(twin_.simulation().now());
  }
  std::string why;
  if (member.launch.is_extern) {
    member.partner = Partner::listen(member.name, why);
    if (member.partner)
      say(fmt::format("{}: waits for its program: TWINPUCK_CONTROLLER=unix:{}", member.name,
                      member.partner->path()));
  } else {
    Start start{member.launch.words, member.launch.name, member.launch.environment, member.launch.folder};
    for (const std::string& word : sim::argument_words(member.arguments)) start.words.push_back(word);
    member.partner = Partner::start(start, why);
  }
  if (!member.partner) return fail(member, why);
  member.partner->on_text = [this, &member](const char* text, std::size_t bytes) {
    print(member, text, bytes);
  };
}

std::int64_t Team::ns_of(const Member& member) { return member.body->time_ms() * 1000000; }

void Team::hand_over_samples(Member& member, bool with_followed) {
  link_clear(&packet_);
  const std::int64_t passed = member.body->take_samples(packet_);
  if (member.has_new_custom) {
    link_begin(&packet_, LINK_CUSTOM);
    link_text(&packet_, member.custom.c_str());
    link_end(&packet_);
    member.has_new_custom = false;
  }
  if (with_followed) nodes_->tell_followed(number_of(member), packet_);
  done(member, passed);
}

/// The answer to a step, behind what is in the packet already.
void Team::done(Member& member, std::int64_t passed_ms) {
  link_begin(&packet_, LINK_DONE);
  link_int(&packet_, ns_of(member));
  link_int(&packet_, passed_ms);
  link_end(&packet_);
  member.is_waiting = false;
  reply(member);
}

void Team::tell_end(Member& member) {
  link_clear(&packet_);
  link_begin(&packet_, LINK_END);
  link_end(&packet_);
  member.is_waiting = false;
  member.is_told_end = true;
  reply(member);
}

/// What is in the packet. Who does not read it is ended: it would stop the world.
void Team::reply(Member& member) {
  if (send_in_pieces(*member.partner, packet_) == Partner::Sent::Deaf)
    fail(member, "does not read what it asked for; it was ended");
}

/// Up to its next step, or its end.
void Team::turn(Member& member) {
  using Clock = std::chrono::steady_clock;
  constexpr int kLookMs = 50;
  constexpr auto kSlow = std::chrono::seconds(10);
  constexpr int kMostProcesses = 256;
  const auto began = Clock::now();
  bool is_told = false;
  while (member.partner) {
    switch (member.partner->receive(kLookMs)) {
      case Partner::Got::Packet:
        if (carry_out(member)) return;
        continue;
      case Partner::Got::Too_long:
        refuse(member, fmt::format("got a packet of more than {} bytes", LINK_MOST_BYTES));
        return;
      case Partner::Got::Gone:
        note_gone(member);
        return;
      case Partner::Got::Nothing:
        break;
    }
    // Nothing has come for a while: the run may be given up, the program may be making processes without end,
    // or the user wonders why nothing moves.
    const std::string since =
        fmt::format("{} for {:.0f} s (t={:.3f} s)",
                    member.has_said_hello ? "has not stepped" : "has not called wb_robot_init()",
                    std::chrono::duration<double>(Clock::now() - began).count(), now_s());
    if (should_give_up && should_give_up()) {
      say(member.name + ": its program " + since + "; it was ended");
      return over(member);
    }
    if (const int processes = member.partner->processes(); processes > kMostProcesses)
      return fail(member,
                  fmt::format("has started {} processes, expected at most {}", processes, kMostProcesses));
    if (!is_told && Clock::now() - began > kSlow && !member.launch.is_extern) {
      is_told = true;
      say(member.name + ": its program " + since + "; the world waits for it");
    }
  }
}

// --- what a program says

bool Team::carry_out(Member& member) {
  link_reader reader;
  link_read(&reader, member.partner->packet(), member.partner->packet_bytes());
  link_record record;
  bool is_over = false;
  while (!is_over && member.partner && link_next(&reader, &record)) is_over = carry_out(member, record);
  if (reader.error) {
    const link_row* row = link_row_of(reader.number);
    refuse(member, fmt::format("{} ({})", reader.error, row ? row->name : std::to_string(reader.number)));
  }
  return is_over || !member.partner;
}

bool Team::carry_out(Member& member, const link_record& record) {
  // A record that this side sends, or one before HELLO, is no program of ours.
  const link_row* row = link_row_of(record.number);
  if (row->who == LINK_FROM_SIMULATOR)
    return refuse(member, fmt::format("got {}, which the simulator sends", row->name)), true;
  if (!member.has_said_hello && record.number != LINK_HELLO)
    return refuse(member, fmt::format("got {}, expected HELLO first", row->name)), true;
  switch (record.number) {
    case LINK_HELLO:
      if (member.has_said_hello) return refuse(member, "got HELLO again"), true;
      if (record.ints[0] != LINK_VERSION)
        return refuse(member,
                      fmt::format("got version {} of the link, expected {}", record.ints[0], LINK_VERSION)),
               true;
      welcome(member);
      return false;
    case LINK_STEP:
      step(member, record.ints[0]);
      return record.ints[0] > 0;
    case LINK_CRASH:
      member.place = place_of_crash(record);
      return false;
    case LINK_SAY: {
      const std::string text(record.texts[0].bytes, record.texts[0].size);
      print(member, text.data(), text.size());
      return false;
    }
    case LINK_SET_CUSTOM:
      member.custom.assign(record.texts[0].bytes, record.texts[0].size);
      if (member.robot >= 0) nodes_->set_custom_data(member.robot, member.custom);
      return false;
    default:
      break;
  }
  // Questions are answered at once.
  if (row->who == LINK_FROM_ASKS) {
    answer(member, record);
    return false;
  }
  // Changes of the world are a supervisor's.
  if (record.number >= LINK_SET) {
    if (member.is_supervisor) {
      nodes_->carry_out(record, number_of(member), member.robot);
      if (wants_reset_ || wants_reload_ || !wants_restart_.empty()) carry_out_resets();
      return is_to_begin(member);
    } else
      line(member,
           fmt::format(
               "{}: got a program without the right of a supervisor; set supervisor = true for its robot",
               row->name));
    return false;
  }
  // Everything else is for the robot's devices.
  const std::string wrong = member.body->command(record);
  if (!wrong.empty()) warn(number_of(member), wrong);
  return false;
}

void Team::welcome(Member& member) {
  member.has_said_hello = true;
  const sim::WorldDesc& world = twin_.world();
  const bool is_lab = world.webots.sensor_order == "lab";
  constexpr double kUsualSpeedUnit =
      0.00628;  // rad/s: 1000 is a turn a second [Webots: e-puck of versions 6 to 8]
  link_clear(&packet_);
  link_begin(&packet_, LINK_WELCOME);
  // What programs of Webots ask about their robot and its world.
  for (const std::int64_t number :
       {std::int64_t{LINK_VERSION}, std::int64_t{member.is_supervisor},
        std::int64_t{world.webots.axes == sim::Axes::Nue}, std::int64_t{is_lab},
        static_cast<std::int64_t>(seed_of(world, member.robot, member.name) >> 1), ns_of(member)})
    link_int(&packet_, number);
  std::error_code none;
  const std::string path =
      world.file.empty() ? "" : fs::absolute(world.file, none).lexically_normal().string();
  const std::string project = fs::path(member.launch.folder).parent_path().parent_path().string();
  for (const std::string& text : {member.name, std::string(member.robot >= 0 ? "GCtronic e-puck" : ""),
                                  project, path, world.title, member.custom})
    link_text(&packet_, text.c_str());
  link_number(&packet_, world.webots.time_step_s * 1000);
  link_number(&packet_, world.webots.speed_unit_rad_s > 0 ? world.webots.speed_unit_rad_s : kUsualSpeedUnit);
  link_end(&packet_);
  member.body->tell_devices(world, packet_);
  link_begin(&packet_, LINK_READY);
  link_end(&packet_);
  reply(member);
}

void Team::answer(Member& member, const link_record& question) {
  link_clear(&packet_);
  if (question.number == LINK_FIND_DEVICE) {
    member.body->find_device({question.texts[0].bytes, question.texts[0].size}, packet_);
  } else if (member.is_supervisor) {
    nodes_->answer(question, number_of(member), member.robot, packet_);
  } else {
    link_begin(&packet_, LINK_NOTHING);
    link_text(&packet_,
              "got a program without the right of a supervisor, expected supervisor = true for its robot");
    link_end(&packet_);
  }
  reply(member);
}

void Team::step(Member& member, std::int64_t milliseconds) {
  if (milliseconds < 0 || milliseconds > kMostStepMs)
    return refuse(member, fmt::format("got a step of {} ms, expected 0 to {}", milliseconds, kMostStepMs));
  if (finished_) return tell_end(member);
  if (milliseconds > 0) {
    member.is_waiting = true;
    return member.body->begin_step(milliseconds);
  }
  link_clear(&packet_);
  nodes_->tell_followed(number_of(member), packet_);
  done(member, 0);
}

// --- how programs end

void Team::refuse(Member& member, const std::string& why) {
  link_clear(&packet_);
  link_begin(&packet_, LINK_REFUSED);
  link_text(&packet_, why.c_str());
  link_end(&packet_);
  member.partner->send(packet_, 100);
  fail(member, "spoke wrongly: " + why);
}

/// Its process has ended, or nobody is at the other end of the socket.
void Team::note_gone(Member& member) {
  constexpr int kAfterLinkMs = 2000;
  const bool is_extern = member.launch.is_extern;
  const std::optional<ProcessEnd> end = is_extern ? std::nullopt : member.partner->await_end(kAfterLinkMs);
  if (!end && !is_extern) return fail(member, "closed its link and went on; it was ended");
  if (end && member.is_told_end && (end->signal != 0 || end->status != 0)) {
    // the run is over, and what it simulated is good
    line(member, "its program, told that the run is over, ended " +
                     (end->signal ? "by " + words_of(*end) : "with " + words_of(*end)));
    return over(member);
  }
  if (end && end->signal != 0) return fail(member, "ended by " + words_of(*end));
  if (end && end->status != 0) return fail(member, "ended with " + words_of(*end));
  // a program from outside that crashed said so before
  if (!member.place.function.empty()) return fail(member, "ended by a signal");
  over(member);
}

void Team::over(Member& member) {
  if (!member.text.empty()) print(member, "\n", 1);
  member.partner.reset();
  member.is_over = true;
  if (member.of_robot && member.of_robot->runner()) member.of_robot->runner()->end();
}

void Team::fail(Member& member, const std::string& what) {
  over(member);
  if (member.of_robot && member.of_robot->runner()) {
    host::TrapReport report;
    report.robot = member.name;
    report.kind = host::kProgramEnded;
    report.message = what;
    report.place = member.place;
    report.cycle = member.of_robot->runner()->now();
    report.time_s = now_s();
    member.of_robot->runner()->fail(std::move(report));
    twin_.mind(member.robot).wake();
    return;
  }
  if (outcome_.ended && !outcome_.crashed && !finished_) return;
  const std::string place = member.place.function.empty() ? "" : " at " + to_string(member.place);
  outcome_ = {
      true, true, 1,
      fmt::format("supervisor '{}', t={:.6f} s: its program {}{}", member.name, now_s(), what, place)};
}

void Team::finish() {
  if (finished_) return;
  if (!began_) before_first_tick();
  finished_ = true;
  // who computes is told with its next step
  for (const auto& member : members_)
    if (member->partner && member->is_waiting) tell_end(*member);
  // a second for all together, less where somebody wants the command to end
  using Clock = std::chrono::steady_clock;
  const auto until =
      Clock::now() + std::chrono::milliseconds(should_give_up && should_give_up() ? 300 : 1000);
  for (const auto& member : members_) {
    while (member->partner && member->has_said_hello) {
      const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(until - Clock::now()).count();
      const Partner::Got got = member->partner->receive(static_cast<int>(std::max<std::int64_t>(0, left)));
      if (got == Partner::Got::Packet) {
        carry_out(*member);
      } else if (got == Partner::Got::Gone) {
        note_gone(*member);
      } else {
        over(*member);  // ended without asking, as Webots does
      }
    }
    if (member->partner) over(*member);
  }
}

// --- text

void Team::print(Member& member, const char* text, std::size_t bytes) {
  constexpr std::size_t kLongestLine = 4096;
  for (std::size_t i = 0; i < bytes; ++i) {
    const char c = text[i];
    if (c == '\n' || member.text.size() >= kLongestLine) {
      line(member, member.text);
      member.text.clear();
    }
    // a form feed clears Webots' console; a carriage return belongs to the line's end
    if (c != '\n' && c != '\f' && c != '\r') member.text += c;
  }
}

void Team::line(Member& member, const std::string& text) {
  if (member.robot >= 0) {
    const auto& console = twin_.mind(member.robot).board().virtual_devices().on_console;
    if (console) console(text);
  } else {
    say(member.name + ": " + text);
  }
}

void Team::warn(int program, const std::string& text) {
  Member& member = *members_[static_cast<std::size_t>(program)];
  constexpr std::size_t kMostTold = 50;  // different texts; more would help nobody
  if (member.told.size() < kMostTold && member.told.insert(text).second) line(member, "Warning: " + text);
}

}  // namespace programs
