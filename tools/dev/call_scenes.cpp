// SPDX-License-Identifier: MIT
#include "tools/dev/call_scenes.h"

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

constexpr double kMostS = 4;  // simulated; the program takes a second
constexpr unsigned kAdcon1 = dspic::sfr("ADCON1"), kAdon = 0x8000;
constexpr int kT2 = dspic::kFirstIrqVector + dspic::irq::T2, kAdc = dspic::kFirstIrqVector + dspic::irq::Adc,
              kMathError = 4, kStack = 15;
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

class Watch final : public chip::StepWatch {
 public:
  explicit Watch(chip::ChipRunner& runner) : runner_(runner), scenes_(std::size(kScenes) + 1) {
    const auto& file = runner.image()->file();
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
      flagged_at_ = runner_.device().interrupts().flag_since(kAdc);
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
    const std::uint32_t instruction = runner_.image()->program().read(step.pc);
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

}  // namespace

std::vector<std::string> scene_names() {
  std::vector<std::string> names;
  for (const Scene& scene : kScenes) names.push_back(scene.name);
  return names;
}

std::vector<Taken> run_scenes(const std::string& level, int selector, std::vector<std::string>& problems) {
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
  while (runner.data().read_variable("done", 2)[0] == 0) {
    if (sim::to_seconds(twin->simulation().now()) > kMostS) {
      problems.push_back(fmt::format("timings: the program of calls did not end in {} s", kMostS));
      return {};
    }
    twin->simulation().step();
  }
  runner.watch_steps(&watch, false);
  return watch.scenes();
}

}  // namespace dev
