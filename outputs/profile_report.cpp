// SPDX-License-Identifier: MIT
#include "outputs/profile_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "install/places.h"

namespace outputs {

namespace {

constexpr std::size_t kMostWaits = 12, kMostOfLibrary = 12;  // in text

double seconds(double cycles) { return cycles / static_cast<double>(board::kFcyHz); }
double share(chip::Cycle part, const chip::ProfileReport& r) {
  return r.to > r.from ? 100 * static_cast<double>(part) / static_cast<double>(r.to - r.from) : 0;
}

std::string us(double cycles) { return fmt::format("{:.2f}", micros(cycles)); }

std::string least_to_most(const chip::Spread& s) {
  return fmt::format("{:>9} {:>9.0f} {:>9}", s.min, s.mean(), s.max);
}

std::string in_microseconds(const chip::Spread& s) {
  return fmt::format("{} / {} / {} us", us(static_cast<double>(s.min)), us(s.mean()),
                     us(static_cast<double>(s.max)));
}

nlohmann::ordered_json json_of(const chip::Spread& s) {
  return {{"count", s.count}, {"min", s.min}, {"mean", s.mean()}, {"max", s.max}, {"max_at_cycle", s.max_at}};
}

}  // namespace

bool is_library_place(const std::string& place) {
  for (const char* room : {"hal_dspic/", "firmware/libc/", "firmware/library/", "firmware/webots/"})
    if (place.rfind(room, 0) == 0) return true;
  return place.empty();
}

std::string from_here(const std::string& path) {
  for (const std::string& folder : {std::filesystem::current_path().string(), places::share_root().string()})
    if (path.rfind(folder + "/", 0) == 0) return path.substr(folder.size() + 1);
  return path;
}

double micros(double cycles) { return 1e6 * seconds(cycles); }

chip::ChipRunner* chip_runner(twin::Twin& twin, int robot) {
  return dynamic_cast<chip::ChipRunner*>(twin.mind(robot).runner());
}

void Profiles::begin(const std::string& option, std::vector<std::string>& problems) {
  for (int i = 0; i < twin_.robots(); ++i) {
    chip::ChipRunner* runner = chip_runner(twin_, i);
    if (!runner) continue;
    watched_.push_back({i, runner,
                        std::make_unique<chip::Profile>(runner->image()->file(), runner->processor(),
                                                        runner->device(), runner->host())});
    runner->watch_steps(watched_.back().profile.get(), true);
  }
  if (watched_.empty())
    problems.push_back("command line: " + option +
                       ": got no robot that runs firmware, expected one; give one with --fw");
}

Profiles::~Profiles() {
  for (const Watched& w : watched_)
    if (twin_.mind(w.robot).runner() == w.runner) w.runner->watch_steps(w.profile.get(), false);
}

std::vector<Profiles::Named> Profiles::reports() const {
  std::vector<Named> all;
  for (const Watched& w : watched_)
    all.push_back({twin_.world().robots[static_cast<std::size_t>(w.robot)].name, w.profile->report(),
                   &w.runner->image()->file()});
  return all;
}

std::string to_text(const std::string& robot, const chip::ProfileReport& r) {
  std::string out = fmt::format(
      "{}: profile of {:.1f} s, exact to the cycle at 14.7456 MHz\n"
      "load       {:.1f} % ({:.1f} % in handlers); {:.1f} % waiting, {:.1f} % asleep\n",
      robot, seconds(static_cast<double>(r.to - r.from)), 100 * r.load(), share(r.in_handlers, r),
      share(r.waited, r), share(r.slept, r));
  if (r.turn.count > 0)
    out += fmt::format("main loop  {}: {} turns of {} (least, mean, most), the longest at {:.6f} s\n",
                       r.turn_place, r.turn.count, in_microseconds(r.turn),
                       seconds(static_cast<double>(r.turn.max_at)));
  else
    out += "main loop  none was found\n";
  out += fmt::format("stack      {} bytes at most, at {:.6f} s in {}; {} bytes of data, {} free of 8192\n",
                     r.stack_bytes, seconds(static_cast<double>(r.stack_at)), r.stack_path, r.data_bytes,
                     r.stack_free);
  out += fmt::format("\n{:<28} {:>9} {:>9} {:>9} {:>9} {:>10} {:>8}  {}\n", "function", "calls", "min",
                     "mean", "max", "max (us)", "own load", "where");
  std::size_t of_library = 0;
  for (const auto& f : r.functions) {
    const std::string place = from_here(f.place);
    if (is_library_place(place) && ++of_library > kMostOfLibrary) continue;
    const std::string name = f.name + (f.is_agenda ? " (agenda)" : "");
    const std::string load = fmt::format("{:.2f}%", share(f.own, r));
    if (f.cycles.count == 0)
      out += fmt::format("{:<28} {:>9} {:>9} {:>9} {:>9} {:>10} {:>8}  {}\n", name, "runs on", "", "", "", "",
                         load, place);
    else
      out += fmt::format("{:<28} {:>9} {} {:>10} {:>8}  {}\n", name, f.cycles.count, least_to_most(f.cycles),
                         us(static_cast<double>(f.cycles.max)), load, place);
  }
  if (of_library > kMostOfLibrary)
    out += fmt::format("and {} functions of the library that take less\n", of_library - kMostOfLibrary);
  if (!r.interrupts.empty())
    out += fmt::format("\n{:<14} {:>8} {:>9} {:>9} {:>9}   {:>22} {:>7} {:>17} {:>7} {:>7}\n", "interrupt",
                       "served", "min", "mean", "max", "latency (cycles)", "jitter", "every (us)", "merged",
                       "missed");
  for (const auto& i : r.interrupts)
    out += fmt::format("{:<14} {:>8} {}   {:>6} {:>7.1f} {:>7} {:>7} {:>8} {:>8} {:>7} {:>7}\n", i.name,
                       i.cycles.count, least_to_most(i.cycles), i.latency.min, i.latency.mean(),
                       i.latency.max, i.latency.max - i.latency.min, us(static_cast<double>(i.period.min)),
                       us(static_cast<double>(i.period.max)), i.merged, i.missed);
  if (!r.by_heart.empty())
    out += fmt::format(
        "{}: known by heart; only ticks that call a function are listed, --hal dspic measures all\n",
        fmt::join(r.by_heart, ", "));
  if (!r.waits.empty())
    out += fmt::format("\n{:<44} {:>8} {:>10} {:>8}  {}\n", "busy wait", "times", "longest", "share", "kind");
  for (std::size_t i = 0; i < r.waits.size() && i < kMostWaits; ++i) {
    const auto& w = r.waits[i];
    out += fmt::format("{:<44} {:>8} {:>7.0f} us {:>7.2f}%  {}\n", w.place, w.cycles.count,
                       micros(static_cast<double>(w.cycles.max)), share(w.cycles.sum, r),
                       w.counts ? "counts" : "polls");
  }
  if (r.waits.size() > kMostWaits) out += fmt::format("... and {} more\n", r.waits.size() - kMostWaits);
  return out;
}

std::string to_json(const std::vector<Profiles::Named>& profiles) {
  nlohmann::ordered_json all;
  all["version"] = TWINPUCK_VERSION;
  all["fcy_hz"] = board::kFcyHz;
  for (const auto& [robot, r, program] : profiles) {
    nlohmann::ordered_json j;
    j["robot"] = robot;
    j["from_cycle"] = r.from;
    j["to_cycle"] = r.to;
    j["load"] = r.load();
    j["slept"] = r.slept;
    j["waited"] = r.waited;
    j["in_handlers"] = r.in_handlers;
    j["by_heart"] = r.by_heart;
    j["turn"] = json_of(r.turn);
    j["turn"]["place"] = r.turn_place;
    j["stack"] = {{"bytes", r.stack_bytes},
                  {"free", r.stack_free},
                  {"data", r.data_bytes},
                  {"at_cycle", r.stack_at},
                  {"path", r.stack_path}};
    for (const auto& f : r.functions) {
      auto one = json_of(f.cycles);
      one["name"] = f.name;
      one["own"] = f.own;
      one["place"] = f.place;
      one["max_caller"] = f.max_caller;
      one["is_agenda"] = f.is_agenda;
      j["functions"].push_back(one);
    }
    for (const auto& i : r.interrupts)
      j["interrupts"].push_back({{"name", i.name},
                                 {"cycles", json_of(i.cycles)},
                                 {"latency", json_of(i.latency)},
                                 {"period", json_of(i.period)},
                                 {"merged", i.merged},
                                 {"missed", i.missed}});
    for (const auto& w : r.waits)
      j["waits"].push_back({{"place", w.place}, {"counts", w.counts}, {"cycles", json_of(w.cycles)}});
    all["robots"].push_back(j);
  }
  return all.dump(2) + "\n";
}

}  // namespace outputs
