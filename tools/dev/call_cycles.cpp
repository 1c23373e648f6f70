// SPDX-License-Identifier: MIT
#include "tools/dev/call_cycles.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <utility>

#include "dspic30/memory/sfr_table.h"
#include "hal_sim/api/host_table.h"
#include "hal_sim/chip/chip_runner.h"
#include "hal_sim/twin/twin.h"
#include "hal_sim/twin/world_file.h"
#include "install/places.h"
#include "outputs/profile_report.h"

namespace fs = std::filesystem;

namespace dev {
namespace {

using chip::Step;
using Cycle = dspic::Cycle;

constexpr double kMostS = 4;  // simulated; the program takes a second
constexpr unsigned kAdcon1 = dspic::sfr("ADCON1"), kAdon = 0x8000;
constexpr int kT2 = dspic::kFirstIrqVector + dspic::irq::T2, kAdc = dspic::kFirstIrqVector + dspic::irq::Adc,
              kMathError = 4, kStack = 15;
constexpr int kCallCycles = 2, kEntryAndReturn = 7;  // of an interrupt: entry 4, RETFIE 3 [DS70143 5.4]
constexpr int kFrames = 65;
constexpr int kPhases = 2;                    // cycles
constexpr int kDark = 0x1235, kLit = 0x0777;  // values that no register has otherwise

/// What happens in the program: code that is not measured, then what is.
struct Scene {
  const char* name;
  const char* before;
  const char* code;
};

// --- the program

// lists are written newest first
const Scene kScenes[] = {
    // nothing runs, the list is empty, the heap was never asked
    {"set_cycle_empty", "", "e_set_agenda_cycle(f0, 1);"},
    {"reset_empty", "", "e_reset_agenda(f0);"},
    {"pause_empty", "", "e_pause_agenda(f0);"},
    {"restart_empty", "", "e_restart_agenda(f0);"},
    {"destroy_empty", "", "e_destroy_agenda(f0);"},
    {"activate_first", "", "e_activate_agenda(f0, 0);"},
    {"activate_1_merge", "e_destroy_agenda(f0);", "e_activate_agenda(f0, 0);"},
    {"activate_1", "", "e_activate_agenda(f1, 0);"},
    {"activate_1_merged", "e_destroy_agenda(f1);", "e_activate_agenda(f1, 0);"},
    {"activate_2", "", "e_activate_agenda(f2, 0);"},
    {"activate_3_merges", "e_destroy_agenda(f0); e_destroy_agenda(f1); e_destroy_agenda(f2);",
     "e_activate_agenda(f0, 0);"},
    // 3 2 1 0, then its blocks from the front
    {"", "e_activate_agenda(f1, 0); e_activate_agenda(f2, 0); e_activate_agenda(f3, 0);", ""},
    {"activate_whole_3", "e_destroy_agenda(f0);", "e_activate_agenda(f0, 0);"},
    {"activate_whole_2", "e_destroy_agenda(f1); e_destroy_agenda(f3);", "e_activate_agenda(f1, 0);"},
    {"activate_followed", "e_activate_agenda(f3, 0); e_destroy_agenda(f0); e_destroy_agenda(f1);",
     "e_activate_agenda(f0, 0);"},
    // 0 3 2
    {"activate_known_0", "", "e_activate_agenda(f0, 0);"},
    {"activate_known_1", "", "e_activate_agenda(f3, 0);"},
    {"activate_known_2", "", "e_activate_agenda(f2, 0);"},
    {"set_cycle_found", "", "e_set_agenda_cycle(f0, 0);"},
    {"set_cycle_found_1", "", "e_set_agenda_cycle(f3, 0);"},
    {"set_cycle_found_2", "", "e_set_agenda_cycle(f2, 0);"},
    {"set_cycle_missing_3", "", "e_set_agenda_cycle(f5, 0);"},
    {"reset_found", "", "e_reset_agenda(f0);"},
    {"reset_found_1", "", "e_reset_agenda(f3);"},
    {"reset_missing_3", "", "e_reset_agenda(f5);"},
    {"pause_found", "", "e_pause_agenda(f0);"},
    {"pause_found_1", "", "e_pause_agenda(f3);"},
    {"pause_missing_3", "", "e_pause_agenda(f5);"},
    {"restart_found", "", "e_restart_agenda(f0);"},
    {"restart_found_1", "", "e_restart_agenda(f3);"},
    {"restart_missing_3", "", "e_restart_agenda(f5);"},
    {"destroy_missing_3", "", "e_destroy_agenda(f5);"},
    {"destroy_third", "", "e_destroy_agenda(f2);"},
    {"destroy_second", "", "e_destroy_agenda(f3);"},
    {"set_cycle_missing_1", "", "e_set_agenda_cycle(f5, 0);"},
    {"reset_missing_1", "", "e_reset_agenda(f5);"},
    {"pause_missing_1", "", "e_pause_agenda(f5);"},
    {"restart_missing_1", "", "e_restart_agenda(f5);"},
    {"destroy_missing_1", "", "e_destroy_agenda(f5);"},
    {"destroy_first", "", "e_destroy_agenda(f0);"},
    // what is held off meanwhile comes again
    {"destroy_tick", "e_activate_agenda(f0, 0); IEC0bits.T2IE = 1;", "e_destroy_agenda(f0);"},
    {"destroy_missing_tick", "e_activate_agenda(f0, 0);", "e_destroy_agenda(f5);"},
    {"activate_tick", "", "e_activate_agenda(f1, 0);"},
    {"activate_edge",
     "e_destroy_agenda(f1); e_destroy_agenda(f0); IEC0bits.T2IE = 0; e_activate_agenda(f0, 0); "
     "IEC0bits.INT0IE = 1;",
     "e_activate_agenda(f1, 0);"},
    {"destroy_edge", "", "e_destroy_agenda(f1);"},
    {"destroy_missing_edge", "", "e_destroy_agenda(f5);"},
    {"agendas_start", "IEC0bits.INT0IE = 0; e_destroy_agenda(f0);", "e_start_agendas_processing();"},
    {"agendas_stop", "", "e_end_agendas_processing();"},
    // the handler's walk
    {"walk:empty", "", "tick();"},
    {"walk:one", "e_activate_agenda(f0, 1);", "tick();"},
    {"walk:two", "e_activate_agenda(f1, 1);", "tick();"},
    {"walk:paused", "e_pause_agenda(f1);", "tick();"},
    {"walk:resting", "e_restart_agenda(f1); e_set_agenda_cycle(f1, 0);", "tick();"},
    {"walk:counts", "e_set_agenda_cycle(f1, 30000);", "tick();"},
    {"walk:counts_last", "e_set_agenda_cycle(f1, 1); e_set_agenda_cycle(f0, 30000);", "tick();"},
    {"walk:destroyed", "e_destroy_agenda(f1); e_set_agenda_cycle(f0, 1); e_activate_agenda(ends_itself, 1);",
     "tick();"},
    {"destroy_self", "e_activate_agenda(ends_itself, 1);", "tick();"},
    {"destroy_next", "e_activate_agenda(ends_next, 1);", "tick();"},
    // motors: right left
    {"activate_motors", "e_destroy_agenda(ends_next);", "e_init_motors();"},
    {"init_known", "", "e_init_motors();"},
    {"left_zero", "", "e_set_speed_left(0);"},
    {"left_forward", "", "e_set_speed_left(500);"},
    {"left_backward", "", "e_set_speed_left(-500);"},
    {"left_above", "", "e_set_speed_left(2000);"},
    {"left_below", "", "e_set_speed_left(-2000);"},
    {"right_zero", "", "e_set_speed_right(0);"},
    {"right_forward", "", "e_set_speed_right(500);"},
    {"right_backward", "", "e_set_speed_right(-500);"},
    {"right_above", "", "e_set_speed_right(2000);"},
    {"right_below", "", "e_set_speed_right(-2000);"},
    {"both_pp", "", "e_set_speed(300, 50);"},
    {"both_pn", "", "e_set_speed(300, -50);"},
    {"both_np", "", "e_set_speed(-300, 50);"},
    {"both_nn", "", "e_set_speed(-300, -50);"},
    {"both_refused_pp", "", "e_set_speed(900, 900);"},
    {"both_refused_pn", "", "e_set_speed(900, -900);"},
    {"both_refused_np", "", "e_set_speed(-900, 900);"},
    {"both_refused_nn", "", "e_set_speed(-900, -900);"},
    {"get_left", "", "sink = e_get_steps_left();"},
    {"get_right", "", "sink = e_get_steps_right();"},
    {"set_left", "", "e_set_steps_left(7);"},
    {"set_right", "", "e_set_steps_right(7);"},
    // firings, called: all four phases
    {"run_left_forward_half", "e_set_speed_left(500);", "run_left_motor();"},
    {"run_left_forward_off", "", "run_left_motor();"},
    {"run_left_forward_half", "", "run_left_motor();"},
    {"run_left_forward_off", "", "run_left_motor();"},
    {"run_left_forward_half", "", "run_left_motor();"},
    {"run_left_forward_off", "", "run_left_motor();"},
    {"run_left_forward_half", "", "run_left_motor();"},
    {"run_left_forward_off", "", "run_left_motor();"},
    {"run_left_backward_half", "e_set_speed_left(-500);", "run_left_motor();"},
    {"run_left_backward_off", "", "run_left_motor();"},
    {"run_right_forward_half", "e_set_speed_right(500);", "run_right_motor();"},
    {"run_right_forward_off", "", "run_right_motor();"},
    {"run_right_backward_half", "e_set_speed_right(-500);", "run_right_motor();"},
    {"run_right_backward_off", "", "run_right_motor();"},
    {"run_left_forward_step", "e_set_speed_left(800);", "run_left_motor();"},
    {"run_left_forward_step", "", "run_left_motor();"},
    {"run_left_forward_step", "", "run_left_motor();"},
    {"run_left_forward_step", "", "run_left_motor();"},
    {"run_left_backward_step", "e_set_speed_left(-800);", "run_left_motor();"},
    {"run_right_forward_step", "e_set_speed_right(800);", "run_right_motor();"},
    {"run_right_forward_step", "", "run_right_motor();"},
    {"run_right_forward_step", "", "run_right_motor();"},
    {"run_right_forward_step", "", "run_right_motor();"},
    {"run_right_backward_step", "e_set_speed_right(-800);", "run_right_motor();"},
    // ... by their own agenda, and by another one
    {"run_own_half", "e_set_speed(0, 0); e_set_speed_left(500); e_set_agenda_cycle(run_left_motor, 1);",
     "tick();"},
    {"run_own_off", "e_set_agenda_cycle(run_left_motor, 1);", "tick();"},
    {"run_other_half", "e_set_agenda_cycle(run_left_motor, 0); e_activate_agenda(runs_left, 1);", "tick();"},
    {"trap:run_divides",
     "e_destroy_agenda(runs_left); e_set_speed_left(500); run_left_motor(); run_left_motor(); "
     "run_left_motor(); "
     "e_set_speed_left(0);",
     "run_left_motor();"},
    // readings of what stands there
    {"prox", "e_ambient_ir[3] = DARK; e_ambient_and_reflected_ir[3] = LIT;", "sink = e_get_prox(3);"},
    {"prox_none", "", "sink = e_get_prox(77);"},
    {"calibrated", "", "sink = e_get_calibrated_prox(3);"},
    {"calibrated_none", "", "sink = e_get_calibrated_prox(77);"},
    {"light", "", "sink = e_get_ambient_light(3);"},
    {"light_none", "", "sink = e_get_ambient_light(77);"},
    {"calibrated_zero", "e_ambient_ir[3] = LIT;", "sink = e_get_calibrated_prox(3);"},
    // scan
    {"on:scan_micro", "e_set_speed(0, 0);", "e_init_ad_scan(MICRO_ONLY);"},
    {"frames:micro", "", "wait_frames(80);"},
    {"on:scan_all_filled", "IEC0bits.ADIE = 0; e_ad_scan_off(); e_last_acc_scan_id = 49;",
     "hold_converter(); e_init_ad_scan(ALL_ADC); free_converter();"},
    {"scan_off", "", "e_ad_scan_off();"},
    {"scan_on", "IEC0bits.ADIE = 0;", "e_ad_scan_on();"},
    {"array_filled", "", "sink = e_ad_is_array_filled();"},
    {"completed", "", "sink = e_ad_is_acquisition_completed();"},
    {"filled:scan_all", "e_ad_scan_off(); e_last_acc_scan_id = 40;", "e_init_ad_scan(ALL_ADC);"},
    {"frames:all", "", "wait_frames(200);"},
};

const char* const kHead = R"(#include <p30F6014A.h>
#include <a_d/advance_ad_scan/e_prox.h>
#include <a_d/advance_ad_scan/e_ad_conv.h>
#include <motor_led/advance_one_timer/e_agenda.h>
#include <motor_led/advance_one_timer/e_motors.h>
#include <motor_led/e_init_port.h>
extern unsigned int e_last_acc_scan_id, tickAdcIsr;
extern int e_ambient_ir[], e_ambient_and_reflected_ir[];
void run_left_motor(void);
void run_right_motor(void);
volatile int scene, done, sink;
static void f0(void) {}
static void f1(void) { sink = 1; }
static void f2(void) { sink = 2; }
static void f3(void) { sink = 3; }
static void f5(void) { sink = 5; }
static void ends_itself(void) { e_destroy_agenda(ends_itself); }
static void ends_next(void) { e_destroy_agenda(f0); }
static void runs_left(void) { run_left_motor(); }
void __attribute__((__interrupt__, no_auto_psv)) _MathError(void) { INTCON1bits.MATHERR = 0; }
/* one tick, without a timer */
static void tick(void) { IFS0bits.T2IF = 0; IEC0bits.T2IE = 1; IFS0bits.T2IF = 1; Nop(); Nop(); IEC0bits.T2IE = 0; }
static void wait_frames(unsigned int frames) { tickAdcIsr = 0; while (*(volatile unsigned int *)&tickAdcIsr < frames); }
static void hold_converter(void) { SRbits.IPL = 7; }
static void free_converter(void) { IEC0bits.ADIE = 0; SRbits.IPL = 0; }
int main(void) {
  e_init_port();
)";

std::string source() {
  std::string text = fmt::format("#define DARK {}\n#define LIT {}\n", kDark, kLit) + kHead;
  int n = 0;
  for (const Scene& s : kScenes)
    text += fmt::format("  {} scene = {}; {} scene = 0;\n", s.before, ++n, s.code);
  return text + "  done = 1;\n  for (;;);\n}\n";
}

// --- the watch

/// What a scene has taken.
struct Taken {
  Cycle call = -1;                 // the call, from behind it to behind RETURN
  Cycle on = -1;                   // of it, until the converter is on
  Cycle dark = -1, lit = -1;       // of it, until the instruction that reads that value
  Cycle filled = -1;               // of it, behind the last handler's end
  std::vector<Cycle> walk;         // the T2 handler, cut at calls
  std::vector<Cycle> began;        // ADC handlers' flags were served
  std::vector<Cycle> frames;       // ADC handlers, entry and RETFIE included
  Cycle counted = -1, filed = -1;  // ADC's flag to the counters' step, to the microphones' index
  unsigned saved = 0;              // registers that the handler saves
  int saved_words = 0;             // other words
};

class Watch final : public chip::StepWatch {
 public:
  explicit Watch(chip::ChipRunner& runner) : runner_(runner), scenes_(std::size(kScenes) + 1) {
    const auto& file = runner.file();
    for (const auto& row : api::kHostFunctions)
      if (const auto found = file.functions.find(row.name); found != file.functions.end())
        functions_.insert(found->second);
    scene_at_ = file.objects.at("scene");
    counter_at_ = file.objects.at("tickAdcIsr");
    index_at_ = file.objects.at("e_last_mic_scan_id");
  }

  void after(const Step& step) override {
    const auto& cpu = runner_.processor();
    Taken& t = scenes_[cpu.ram(scene_at_) | cpu.ram(scene_at_ + 1) << 8];
    const unsigned stack = cpu.w(kStack);
    follow_handler(t, step, stack);
    if (step.entered == kMathError && called_at_ >= 0) {
      if (t.call < 0) t.call = step.begin - called_at_;
      called_at_ = -1;
    }
    if (called_at_ >= 0) {
      note_reads(t, step);
      if (t.on < 0 && runner_.device().peek(kAdcon1, step.end) & kAdon) t.on = step.end - called_at_;
      if (stack + 4 == stack_ && step.next == back_) {
        if (t.call < 0) t.call = step.end - called_at_, t.filled = step.end - last_frame_;
        called_at_ = -1;
      }
    } else if (functions_.count(step.next) && step.entered == dspic::kNoVector && step.next != step.pc + 2) {
      called_at_ = step.end;
      for (int n = 0; n < kFree; ++n) before_[n] = cpu.w(n);
      stack_ = stack;
      back_ = cpu.ram(stack - 4) | cpu.ram(stack - 3) << 8 | (cpu.ram(stack - 2) & 0x7F) << 16;
    }
  }

  const std::vector<Taken>& scenes() const { return scenes_; }

 private:
  void follow_handler(Taken& t, const Step& step, unsigned stack) {
    // how long after its flag the handler has counted, and filed the microphones: where nothing is in its way
    const auto word = [&](unsigned at) {
      return runner_.processor().ram(at) | runner_.processor().ram(at + 1) << 8;
    };
    const auto note = [&](int& seen, unsigned at, Cycle& least) {
      if (word(at) == seen) return;
      seen = -1;
      const Cycle took = step.end - flagged_at_;
      least = least < 0 ? took : std::min(least, took);
    };
    if (frame_since_ >= 0 && counter_ >= 0) note(counter_, counter_at_, t.counted);
    if (frame_since_ >= 0 && index_ >= 0) note(index_, index_at_, t.filed);
    if (step.entered == kAdc) {
      flagged_at_ = runner_.device().flag_since(kAdc);
      counter_ = word(counter_at_);
      index_ = word(index_at_);
      frame_since_ = step.begin;
      t.began.push_back(step.begin);
    }
    if (step.left && frame_since_ >= 0) {
      t.frames.push_back(step.end - frame_since_);
      frame_since_ = -1;
      last_frame_ = step.end;
    }
    if (step.entered == kT2) {
      depth_ = 0;
      handler_stack_ = stack;
      since_ = step.end;
      return;
    }
    if (handler_stack_ == 0) return;
    if (step.left) {
      if (t.walk.empty() || !walked_) t.walk.push_back(step.begin - since_);
      handler_stack_ = 0;
      walked_ = false;
      return;
    }
    const std::uint32_t instruction = runner_.program().read(step.pc);
    if (depth_ == 0 && t.walk.empty()) note_push(t, instruction);
    // CALL Wn of a list's function: its frame is all that lies above
    if (depth_ == 0 && (instruction & 0xFFFFF0) == 0x010000) {
      t.walk.push_back(step.begin - since_);
      if (t.walk.size() == 1) t.saved_words = static_cast<int>(stack - 4 - handler_stack_) / 2;
      depth_ = stack;
    } else if (depth_ != 0 && stack + 4 == depth_) {
      depth_ = 0;
      since_ = step.end;
    }
  }

  /// The first step that leaves a sample, or the difference of both, in a register.
  void note_reads(Taken& t, const Step& step) {
    for (int n = 0; n < kFree; ++n) {
      const int value = runner_.processor().w(n);
      const bool is_difference = value == kDark - kLit;
      if (value == std::exchange(before_[n], value)) continue;
      if (t.dark < 0 && (value == kDark || is_difference)) t.dark = step.begin - called_at_;
      if (t.lit < 0 && (value == kLit || is_difference)) t.lit = step.begin - called_at_;
    }
  }

  static void note_push(Taken& t, std::uint32_t word) {
    if ((word & 0xFFFFF0) == 0x781F80) t.saved |= 1u << (word & 15);  // MOV Wn, [W15++]
    if ((word & 0xFFFFF0) == 0xBE9F80) t.saved |= 3u << (word & 15);  // MOV.D Wn, [W15++]
    if ((word & 0xFFC000) == 0xFA0000) t.saved |= 1u << 14;           // LNK
  }

  chip::ChipRunner& runner_;
  std::vector<Taken> scenes_;
  std::set<unsigned> functions_;
  unsigned counter_at_ = 0, index_at_ = 0;
  int counter_ = -1, index_ = -1;  // as the handler found them; -1: it has changed them
  Cycle flagged_at_ = 0;
  unsigned scene_at_ = 0, stack_ = 0, back_ = 0, handler_stack_ = 0, depth_ = 0;
  static constexpr int kFree = 8;  // W0 to W7
  int before_[kFree] = {};
  Cycle called_at_ = -1, since_ = 0, frame_since_ = -1, last_frame_ = 0;
  bool walked_ = false;
};

/// Runs the program to its end.
std::vector<Taken> run(const std::string& level, int selector, std::vector<std::string>& problems) {
  const fs::path folder = places::cache_folder("timings") / ("timings-calls" + level);
  fs::create_directories(folder);
  std::ofstream(folder / "main.c") << source();
  sim::WorldDesc world;
  world.models = twin::robot_models();
  world.robots.resize(1);
  world.robots[0].name = "puck";
  world.robots[0].firmware = folder.string();
  world.robots[0].own["selector"] = selector;
  twin::Options options;
  options.hal = "dspic";
  options.optimisation = level;
  const auto twin = twin::Twin::open(world, options, problems);
  if (!twin) return {};
  chip::ChipRunner& runner = *outputs::chip_runner(*twin, 0);
  Watch watch(runner);
  runner.watch_steps(&watch, true);
  while (runner.read_variable("done", 2)[0] == 0) {
    if (sim::to_seconds(twin->simulation().now()) > kMostS) {
      problems.push_back(fmt::format("timings: the program of calls did not end in {} s", kMostS));
      return {};
    }
    twin->simulation().step();
  }
  runner.watch_steps(&watch, false);
  return watch.scenes();
}

int sum(const std::vector<Cycle>& frames, std::size_t skip, std::size_t count) {
  Cycle all = 0;
  for (std::size_t i = skip; i < skip + count && i < frames.size(); ++i) all += frames[i];
  return static_cast<int>(all);
}

}  // namespace

std::map<std::string, int> call_cycles(const std::string& level, std::vector<std::string>& problems) {
  constexpr int kUsual = 0, kGumstix = 10;
  const auto usual = run(level, kUsual, problems), gumstix = run(level, kGumstix, problems);
  if (!problems.empty()) return {};
  std::map<std::string, int> m;  // of each scene: the call
  std::map<std::string, const Taken*> of;
  for (std::size_t i = 0; i < std::size(kScenes); ++i) {
    const std::string name = kScenes[i].name;
    const Taken& t = usual[i + 1];
    of[name] = &t;
    const int call = static_cast<int>(t.call);
    // a firing takes a little more in some phases without optimisation
    if (m.count(name) && !name.empty() && std::abs(m[name] - call) > kPhases)
      problems.push_back(fmt::format("timings: {} {}: {} and {} cycles", level, name, m[name], call));
    m.emplace(name, call);
  }
  const auto walk = [&](const char* name, std::size_t part) {
    const auto& parts = of.at(std::string("walk:") + name)->walk;
    return part < parts.size() ? static_cast<int>(parts[part]) : -10000;
  };
  std::map<std::string, int> c;
  const auto copy = [&](std::initializer_list<const char*> names) {
    for (const char* name : names) c[name] = m.at(name);
  };
  copy({"agendas_start", "agendas_stop"});
  for (const std::string f : {"set_cycle", "reset", "pause", "restart"}) {
    c[f + "_empty"] = m.at(f + "_empty");
    c[f + "_found"] = m.at(f + "_found");
    c[f + "_step"] = m.at(f + "_found_1") - m.at(f + "_found");
    c[f + "_missing"] = m.at(f + "_missing_1");
    if (m.at(f + "_missing_3") != m.at(f + "_missing_1") + 2 * c[f + "_step"])
      problems.push_back(fmt::format("timings: {} {}: a search that fails passes otherwise", level, f));
  }
  // activate
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
  c["malloc_followed"] = m["activate_followed"] - c["activate_new"] - c["activate_step"] - c["malloc_merge"] -
                         c["malloc_merges"];
  c["activate_tick_on"] = m["activate_tick"] - m["activate_1"];
  c["activate_edge_on"] = m["activate_edge"] - m["activate_1"];
  // destroy
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
  // motors: the right one's agenda is the newest
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
  // walk
  c["walk_empty"] = walk("empty", 0);
  c["walk_begin"] = walk("one", 0);
  c["walk_after"] = walk("two", 1);
  c["walk_end"] = walk("one", 1) - c["walk_after"];
  c["walk_paused"] = walk("paused", 0) - c["walk_begin"];
  c["walk_resting"] = walk("resting", 0) - c["walk_begin"];
  c["walk_counts"] = walk("counts", 0) - c["walk_begin"];
  c["walk_destroyed"] = walk("destroyed", 1);
  if (walk("counts_last", 1) != c["walk_after"] + c["walk_counts"] + c["walk_end"])
    problems.push_back(fmt::format("timings: {} Timer 2's handler: its last agenda takes otherwise", level));
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
  // readings
  copy({"prox", "prox_none", "calibrated", "calibrated_none", "calibrated_zero", "light", "light_none"});
  for (const std::string f : {"prox", "calibrated"}) {
    c[f + "_dark"] = static_cast<int>(of.at(f)->dark);
    c[f + "_lit"] = static_cast<int>(of.at(f)->lit);
  }
  c["light_dark"] = static_cast<int>(of.at("light")->dark);
  // scan
  const auto part = [&](const std::vector<Taken>& all, const char* name) -> const Taken& {
    for (std::size_t i = 0; i < std::size(kScenes); ++i)
      if (std::string(kScenes[i].name) == name) return all[i + 1];
    return all[0];
  };
  const auto on = [&](const std::vector<Taken>& all, const char* name) {
    return static_cast<int>(part(all, name).on);
  };
  c["scan_micro"] = on(usual, "on:scan_micro");
  c["scan_micro_gumstix"] = on(gumstix, "on:scan_micro");
  c["scan_micro_return"] = m["on:scan_micro"] - c["scan_micro"];
  c["scan_all"] = on(usual, "on:scan_all_filled");
  c["scan_all_gumstix"] = on(gumstix, "on:scan_all_filled");
  c["scan_all_return"] = m["on:scan_all_filled"] - c["scan_all"];
  c["scan_filled_return"] = static_cast<int>(part(usual, "filled:scan_all").filled);
  const auto round = [&](const char* name) {
    const auto& began = part(usual, name).began;
    const std::size_t last = 4 + kFrames;
    return began.size() > last ? static_cast<int>(began[last] - began[4]) : -1;
  };
  c["scan_round"] = round("frames:all");
  c["scan_micro_round"] = round("frames:micro");
  copy({"array_filled", "completed", "scan_on", "scan_off"});
  c["scan_counts"] = static_cast<int>(part(usual, "frames:all").counted);
  c["scan_files"] = static_cast<int>(part(usual, "frames:all").filed);
  c["share_scan_micro"] = sum(part(usual, "frames:micro").frames, 4, kFrames) / kFrames;
  c["share_scan_round"] = sum(part(usual, "frames:all").frames, 4, kFrames);
  return c;
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
