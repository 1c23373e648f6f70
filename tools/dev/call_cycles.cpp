// SPDX-License-Identifier: MIT
#include "tools/dev/call_cycles.h"

#include <fmt/format.h>

#include <cstdlib>
#include <utility>

#include "tools/dev/call_scenes.h"

namespace dev {
namespace {

constexpr int kCallCycles = 2;
constexpr int kPhases = 2;  // cycles

int sum(const std::vector<Cycle>& frames, std::size_t skip, std::size_t count) {
  Cycle all = 0;
  for (std::size_t i = skip; i < skip + count && i < frames.size(); ++i) all += frames[i];
  return static_cast<int>(all);
}

/// What each call took in its scenes, and the table's numbers made of that.
class Table {
 public:
  Table(std::string level, std::vector<Taken> with_usual, std::vector<Taken> with_gumstix,
        std::vector<std::string>& wrong)
      : usual(std::move(with_usual)),
        gumstix(std::move(with_gumstix)),
        level(std::move(level)),
        problems(wrong) {
    for (std::size_t i = 0; i < names.size(); ++i) {
      const std::string& name = names[i];
      const int call = static_cast<int>(usual[i + 1].call);
      of[name] = &usual[i + 1];
      // a firing takes a little more in some phases without optimisation
      if (m.count(name) && !name.empty() && std::abs(m[name] - call) > kPhases)
        problems.push_back(fmt::format("timings: {} {}: {} and {} cycles", this->level, name, m[name], call));
      m.emplace(name, call);
    }
    agendas();
    activate();
    destroy();
    motors();
    handler();
    readings();
    scan();
  }

  std::map<std::string, int> c;  ///< by the table's names

 private:
  void copy(std::initializer_list<const char*> names) {
    for (const char* name : names) c[name] = m.at(name);
  }
  int walk(const char* name, std::size_t part) const {
    const auto& parts = of.at(std::string("walk:") + name)->walk;
    return part < parts.size() ? static_cast<int>(parts[part]) : -10000;
  }
  const Taken& part(const std::vector<Taken>& all, const char* name) const {
    for (std::size_t i = 0; i < names.size(); ++i)
      if (names[i] == name) return all[i + 1];
    return all[0];
  }
  int on(const std::vector<Taken>& all, const char* name) const {
    return static_cast<int>(part(all, name).on);
  }
  int round(const char* name) const {
    const auto& began = part(usual, name).began;
    const std::size_t last = 4 + kFrames;
    return began.size() > last ? static_cast<int>(began[last] - began[4]) : -1;
  }

  void agendas() {
    copy({"agendas_start", "agendas_stop"});
    for (const std::string f : {"set_cycle", "reset", "pause", "restart"}) {
      c[f + "_empty"] = m.at(f + "_empty");
      c[f + "_found"] = m.at(f + "_found");
      c[f + "_step"] = m.at(f + "_found_1") - m.at(f + "_found");
      c[f + "_missing"] = m.at(f + "_missing_1");
      if (m.at(f + "_missing_3") != m.at(f + "_missing_1") + 2 * c[f + "_step"])
        problems.push_back(fmt::format("timings: {} {}: a search that fails passes otherwise", level, f));
    }
  }

  void activate() {
    c["activate_known"] = m["activate_known_0"];
    c["activate_known_step"] = m["activate_known_1"] - m["activate_known_0"];
    c["malloc_merge"] = (m["activate_3_merges"] - m["activate_1_merge"]) / 2;
    c["malloc_merges"] = m["activate_1_merged"] - m["activate_1"] - c["malloc_merge"];
    c["activate_empty"] = m["activate_1_merge"] - c["malloc_merge"] - c["malloc_merges"];
    c["malloc_first"] = m["activate_first"] - c["activate_empty"];
    // the first two with a block more to pass, the others with one less
    const int both = m["activate_2"] - m["activate_1"], one = m["activate_whole_3"] - m["activate_whole_2"];
    c["activate_step"] = (both + one) / 2;
    c["malloc_used"] = (both - one) / 2;
    c["activate_new"] = m["activate_1"] - c["malloc_used"];
    c["malloc_whole"] = m["activate_whole_3"] - c["activate_new"] - 2 * c["activate_step"];
    c["malloc_followed"] = m["activate_followed"] - c["activate_new"] - c["activate_step"] -
                           c["malloc_merge"] - c["malloc_merges"];
    c["activate_tick_on"] = m["activate_tick"] - m["activate_1"];
    c["activate_edge_on"] = m["activate_edge"] - m["activate_1"];
  }

  void destroy() {
    c["destroy_empty"] = m["destroy_empty"];
    c["destroy_missing"] = m["destroy_missing_1"];
    c["destroy_missing_step"] = (m["destroy_missing_3"] - m["destroy_missing_1"]) / 2;
    c["destroy_first"] = m["destroy_first"];
    c["destroy_second"] = m["destroy_second"];
    c["destroy_step"] = m["destroy_third"] - m["destroy_second"];
    c["destroy_tick_on"] = m["destroy_tick"] - m["destroy_first"];
    c["destroy_missing_tick_on"] = m["destroy_missing_tick"] - m["destroy_missing_1"];
    c["destroy_missing_edge_on"] = m["destroy_missing_edge"] - m["destroy_missing_1"];
    c["destroy_edge_on"] = m["destroy_edge"] - m["destroy_first"];
    c["destroy_running"] = m["destroy_self"] - m["destroy_first"] - c["destroy_tick_on"];
    c["destroy_following"] = m["destroy_next"] - m["destroy_second"] - c["destroy_tick_on"];
  }

  /// The right motor's agenda is the newest.
  void motors() {
    const int right = c["set_cycle_found"], left = right + c["set_cycle_step"];
    for (const std::string f : {"zero", "forward", "backward", "above", "below"}) {
      c["left_" + f] = m.at("left_" + f) - left;
      c["right_" + f] = m.at("right_" + f) - right;
    }
    const int forward = m["left_forward"] + m["right_forward"],
              backward = m["left_backward"] + m["right_backward"];
    c["both_pp"] = m["both_pp"] - forward;
    c["both_pn"] = m["both_pn"] - forward;
    c["both_np"] = m["both_np"] - backward;
    c["both_nn"] = m["both_nn"] - backward;
    copy({"both_refused_pp", "both_refused_pn", "both_refused_np", "both_refused_nn", "get_left", "get_right",
          "set_left", "set_right"});
    c["init_motors"] = m["init_known"] - 2 * c["activate_known"] - c["activate_known_step"];
    for (const std::string f : {"half", "off", "step"})
      for (const std::string turn : {"_forward_", "_backward_"}) {
        c["run_left" + turn + f] = m.at("run_left" + turn + f) - (f == "step" ? 0 : c["set_cycle_step"]);
        c["run_right" + turn + f] = m.at("run_right" + turn + f);
      }
    c["run_half_own"] = m["run_own_half"] - c["run_left_forward_half"];
    c["run_half_other"] = m["run_other_half"] - c["run_left_forward_half"] - 2 * c["set_cycle_step"];
    c["run_divides"] = m["trap:run_divides"];
  }

  void handler() {
    c["walk_empty"] = walk("empty", 0);
    c["walk_begin"] = walk("one", 0);
    c["walk_after"] = walk("two", 1);
    c["walk_end"] = walk("one", 1) - c["walk_after"];
    c["walk_paused"] = walk("paused", 0) - c["walk_begin"];
    c["walk_resting"] = walk("resting", 0) - c["walk_begin"];
    c["walk_counts"] = walk("counts", 0) - c["walk_begin"];
    c["walk_destroyed"] = walk("destroyed", 1);
    if (walk("counts_last", 1) != c["walk_after"] + c["walk_counts"] + c["walk_end"])
      problems.push_back(
          fmt::format("timings: {} Timer 2's handler: its last agenda takes otherwise", level));
    const Taken& saved = *of.at("walk:one");
    c["walk_saved_registers"] = static_cast<int>(saved.saved);
    c["walk_saved_words"] = saved.saved_words - __builtin_popcount(saved.saved);
    // a motor's firing in the handler, beside an agenda that counts
    const auto firing = [&](const std::string& f, int half) {
      const int mean = (c["run_left_forward_" + f] + c["run_right_forward_" + f]) / 2;
      return mean + half + kCallCycles + c["walk_after"] - c["walk_counts"];
    };
    c["share_motor_half"] = firing("half", c["run_half_own"]);
    c["share_motor_off"] = firing("off", c["run_half_own"]);
    c["share_motor_step"] = firing("step", 0);
  }

  void readings() {
    copy({"prox", "prox_none", "calibrated", "calibrated_none", "calibrated_zero", "light", "light_none"});
    for (const std::string f : {"prox", "calibrated"}) {
      c[f + "_dark"] = static_cast<int>(of.at(f)->dark);
      c[f + "_lit"] = static_cast<int>(of.at(f)->lit);
    }
    c["light_dark"] = static_cast<int>(of.at("light")->dark);
  }

  void scan() {
    c["scan_micro"] = on(usual, "on:scan_micro");
    c["scan_micro_gumstix"] = on(gumstix, "on:scan_micro");
    c["scan_micro_return"] = m["on:scan_micro"] - c["scan_micro"];
    c["scan_all"] = on(usual, "on:scan_all_filled");
    c["scan_all_gumstix"] = on(gumstix, "on:scan_all_filled");
    c["scan_all_return"] = m["on:scan_all_filled"] - c["scan_all"];
    c["scan_filled_return"] = static_cast<int>(part(usual, "filled:scan_all").filled);
    c["scan_round"] = round("frames:all");
    c["scan_micro_round"] = round("frames:micro");
    copy({"array_filled", "completed", "scan_on", "scan_off"});
    c["scan_counts"] = static_cast<int>(part(usual, "frames:all").counted);
    c["scan_files"] = static_cast<int>(part(usual, "frames:all").filed);
    c["share_scan_micro"] = sum(part(usual, "frames:micro").frames, 4, kFrames) / kFrames;
    c["share_scan_round"] = sum(part(usual, "frames:all").frames, 4, kFrames);
  }

  const std::vector<Taken> usual, gumstix;
  const std::vector<std::string> names = scene_names();
  const std::string level;
  std::vector<std::string>& problems;
  std::map<std::string, int> m;  // of each scene: the call
  std::map<std::string, const Taken*> of;
};

}  // namespace

std::map<std::string, int> call_cycles(const std::string& level, std::vector<std::string>& problems) {
  constexpr int kUsual = 0, kGumstix = 10;
  auto usual = run_scenes(level, kUsual, problems), gumstix = run_scenes(level, kGumstix, problems);
  if (!problems.empty()) return {};
  return Table(level, std::move(usual), std::move(gumstix), problems).c;
}

std::string call_cycles_text(const std::vector<std::map<std::string, int>>& levels) {
  static const std::pair<const char*, const char*> kRows[] = {
      {"agendas_start", "e_start_agendas_processing()"},
      {"agendas_stop", "e_end_agendas_processing()"},
      {"set_cycle_empty", "e_set_agenda_cycle(), empty list"},
      {"set_cycle_missing", "not in a list of one"},
      {"set_cycle_found", "the newest"},
      {"set_cycle_step", "each newer agenda that is passed"},
      {"reset_empty", "e_reset_agenda(), the same"},
      {"reset_missing", ""},
      {"reset_found", ""},
      {"reset_step", ""},
      {"pause_empty", "e_pause_agenda(), the same"},
      {"pause_missing", ""},
      {"pause_found", ""},
      {"pause_step", ""},
      {"restart_empty", "e_restart_agenda(), the same"},
      {"restart_missing", ""},
      {"restart_found", ""},
      {"restart_step", ""},
      {"activate_known", "e_activate_agenda(), the newest again"},
      {"activate_known_step", "each newer agenda that is passed"},
      {"activate_empty", "to an empty list"},
      {"activate_new", "to a list of one"},
      {"activate_step", "each further agenda of the list"},
      {"activate_tick_on", "with the tick's interrupt enabled"},
      {"activate_edge_on", "with the remote control's enabled"},
      {"malloc_first", "the heap's first block"},
      {"malloc_used", "each block that is taken"},
      {"malloc_merge", "each free block that is joined to another"},
      {"malloc_merges", "any, beside that"},
      {"malloc_whole", "a block that is not cut"},
      {"malloc_followed", "one that is cut, with another behind it"},
      {"destroy_empty", "e_destroy_agenda(), empty list"},
      {"destroy_missing", "not in a list of one"},
      {"destroy_missing_step", "each further agenda of the list"},
      {"destroy_first", "the newest"},
      {"destroy_second", "the one before"},
      {"destroy_step", "each further agenda that is passed"},
      {"destroy_tick_on", "with the tick's interrupt enabled"},
      {"destroy_edge_on", "with the remote control's enabled"},
      {"destroy_missing_tick_on", "with the tick's, not in the list"},
      {"destroy_missing_edge_on", "with the remote control's"},
      {"destroy_running", "the one that runs"},
      {"destroy_following", "the one that comes next"},
      {"left_zero", "e_set_speed_left(0), beside e_set_agenda_cycle()"},
      {"left_forward", "above 0"},
      {"left_backward", "below 0"},
      {"left_above", "above 1000"},
      {"left_below", "below -1000"},
      {"right_zero", "e_set_speed_right(), the same"},
      {"right_forward", ""},
      {"right_backward", ""},
      {"right_above", ""},
      {"right_below", ""},
      {"both_pp", "e_set_speed(), beside those of both wheels; signs of the two arguments"},
      {"both_pn", ""},
      {"both_np", ""},
      {"both_nn", ""},
      {"both_refused_pp", "magnitudes above 1000 together"},
      {"both_refused_pn", ""},
      {"both_refused_np", ""},
      {"both_refused_nn", ""},
      {"get_left", "e_get_steps_left()"},
      {"get_right", "e_get_steps_right()"},
      {"set_left", "e_set_steps_left()"},
      {"set_right", "e_set_steps_right()"},
      {"init_motors", "e_init_motors(), beside e_activate_agenda()"},
      {"run_left_forward_half", "run_left_motor(), its agenda the newest: a step below 601"},
      {"run_left_forward_off", "coils off"},
      {"run_left_forward_step", "a step above 600"},
      {"run_left_backward_half", ""},
      {"run_left_backward_off", ""},
      {"run_left_backward_step", ""},
      {"run_right_forward_half", "run_right_motor(), the same"},
      {"run_right_forward_off", ""},
      {"run_right_forward_step", ""},
      {"run_right_backward_half", ""},
      {"run_right_backward_off", ""},
      {"run_right_backward_step", ""},
      {"run_half_own", "below 601, called by its own agenda"},
      {"run_half_other", "by another agenda's function"},
      {"run_divides", "to the trap of a division by zero"},
      {"walk_empty", "Timer 2's handler, from entry to RETFIE: empty list"},
      {"walk_begin", "to its first call, of the newest agenda"},
      {"walk_after", "behind a call, to the next one"},
      {"walk_destroyed", "the same, when the agenda has been destroyed"},
      {"walk_end", "to RETFIE, beside what leads to a call"},
      {"walk_paused", "each agenda that is paused"},
      {"walk_resting", "that has no cycle"},
      {"walk_counts", "that counts"},
      {"walk_saved_registers", "registers that it saves, a bit each"},
      {"walk_saved_words", "other words that it saves"},
      {"share_motor_half", "a motor in it, beside an agenda that counts: a step below 601"},
      {"share_motor_off", "coils off"},
      {"share_motor_step", "a step above 600"},
      {"prox", "e_get_prox()"},
      {"prox_dark", "of it, until it reads the dark value"},
      {"prox_lit", "... the lit one"},
      {"prox_none", "of a sensor that there is not"},
      {"calibrated", "e_get_calibrated_prox(), the same"},
      {"calibrated_zero", "below the calibration"},
      {"calibrated_dark", ""},
      {"calibrated_lit", ""},
      {"calibrated_none", ""},
      {"light", "e_get_ambient_light(), the same"},
      {"light_dark", ""},
      {"light_none", ""},
      {"scan_all", "e_init_ad_scan(ALL_ADC) until the converter is on"},
      {"scan_all_gumstix", "at selector position 10"},
      {"scan_all_return", "from there, when the buffer is full"},
      {"scan_filled_return", "from the end of the handler that fills it"},
      {"scan_micro", "e_init_ad_scan(MICRO_ONLY) until the converter is on"},
      {"scan_micro_gumstix", "at selector position 10"},
      {"scan_micro_return", "from there"},
      {"array_filled", "e_ad_is_array_filled()"},
      {"completed", "e_ad_is_acquisition_completed()"},
      {"scan_on", "e_ad_scan_on()"},
      {"scan_off", "e_ad_scan_off()"},
      {"scan_round", "converter: 65 frames"},
      {"scan_micro_round", "65 frames of MICRO_ONLY"},
      {"share_scan_round", "converter's handler, entry and RETFIE included: 65 frames"},
      {"share_scan_micro", "a frame of MICRO_ONLY"},
      {"scan_counts", "its flag to the counters' step"},
      {"scan_files", "to the microphones' samples and index"},
  };
  std::string text =
      "// SPDX-License-Identifier: MIT\n"
      "// CALL_CYCLES(name, what, -O0, -O1, -O2, -Os): see call_cycles.h. Written by `twinpuck-dev timings` "
      "[measured:\n"
      "// hal_dspic on the chip]; held by `make check`.\n";
  for (const auto& [name, what] : kRows) {
    text += fmt::format("CALL_CYCLES({}, \"{}\"", name, what);
    for (const auto& level : levels) text += fmt::format(", {}", level.count(name) ? level.at(name) : -1);
    text += ")\n";
  }
  return text;
}

}  // namespace dev
