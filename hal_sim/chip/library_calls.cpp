// SPDX-License-Identifier: MIT
#include "hal_sim/chip/library_calls.h"

#include <fmt/core.h>

#include <algorithm>

#include "dspic30/memory/hex.h"
#include "hal_sim/board/epuck_params.h"
#include "hal_sim/drivers/driver_params.h"

namespace chip {

namespace {

constexpr Cycle kSpeedGrace =
    board::kFcyHz / 10;  // a speed may be set a little before the motors are started
constexpr Cycle kStandsStill = 10 * board::kFcyHz, kLookEvery = board::kFcyHz;
// A wheel is slow that makes less than this share of the steps asked for, where its speed is set more often than so
// many times a second. Of lower speeds than kLeastSlow, steps/s, too few steps come in a look. Assumed: far from what
// rounding and the first step make of it.
constexpr double kSlow = 0.8, kOften = 200, kLeastLook_s = 0.5;
constexpr int kLeastSlow = 20;
constexpr int kMaxSpeed = 1000;  // steps/s [lib: motor_led/advance_one_timer/e_motors.c]
constexpr int kAllLeds = 8, kProximity = 8, kGumstixProximity = 10, kAxes = 3, kMicrophones = 3;
constexpr unsigned kAdcon1 = dspic::sfr("ADCON1"), kAdon = 0x8000;
constexpr const char* kForms[] = {"", "tp_basic_", "tp_timer3_", "tpfast_",
                                  "tp_t2_"};  // cc/driver_variants.cpp

}  // namespace

enum class LibraryCalls::Function : std::uint8_t {
  InitMotors,
  StartAgendas,
  StartScan,
  SpeedLeft,
  SpeedRight,
  Speed,
  Proximity,
  Acceleration,
  Microphone,
  Led,
  ActivateAgenda,
  SetAgendaCycle,
};

struct LibraryCalls::Known {
  const char* name;
  Function function;
};

bool LibraryCalls::starts(Function f) { return f <= Function::StartScan; }

const LibraryCalls::Known LibraryCalls::kKnown[] = {
    {"e_init_motors", Function::InitMotors},
    {"e_start_agendas_processing", Function::StartAgendas},
    {"e_init_ad_scan", Function::StartScan},
    {"e_set_speed_left", Function::SpeedLeft},
    {"e_set_speed_right", Function::SpeedRight},
    {"e_set_speed", Function::Speed},
    {"e_get_prox", Function::Proximity},
    {"e_get_ambient_light", Function::Proximity},
    {"e_get_calibrated_prox", Function::Proximity},
    {"e_get_acc", Function::Acceleration},
    {"e_get_acc_filtered", Function::Acceleration},
    {"e_get_micro", Function::Microphone},
    {"e_get_micro_average", Function::Microphone},
    {"e_get_micro_volume", Function::Microphone},
    {"e_set_led", Function::Led},
    {"e_activate_agenda", Function::ActivateAgenda},
    {"e_set_agenda_cycle", Function::SetAgendaCycle},
};

LibraryCalls::LibraryCalls(const Functions& functions, const dspic::Processor& processor,
                           const ProgramPlaces& places, SolderedChip& chip, const board::Board& board)
    : functions_(functions), processor_(processor), places_(places), chip_(chip), board_(board) {}

LibraryCalls::Functions::Functions(const dspic::FirmwareFile& file) : file_(file) {
  for (const Known& known : kKnown)
    for (const char* form : kForms) {
      const auto found = file.functions.find(std::string(form) + known.name);
      if (found == file.functions.end()) continue;
      const unsigned to = goto_target(file, found->second);
      sites_[dspic::is_host_place(to) ? to : found->second] = {&known, form};
    }
  for (const char* name : {"run_left_motor", "run_right_motor"})
    if (const auto found = file.functions.find(name); found != file.functions.end())
      motors_.insert(found->second);
  // a compiler may have put the other two into e_set_speed()
  for (auto& [address, site] : sites_) {
    if (site.known->function != Function::Speed) continue;
    site.is_whole = true;
    const auto* const function = file.code.function_at(address);
    for (unsigned a = address; function && a < function->end; a += 2)
      if (const auto called = sites_.find(destination(file, a));
          called != sites_.end() && called->second.known->function == Function::SpeedLeft)
        site.is_whole = false;
  }
  for (const auto& [address, site] : sites_) {
    if (!dspic::is_host_place(address)) addresses_.push_back(address);
    const std::size_t slot = slot_of(address);
    if (slot >= by_slot_.size()) by_slot_.resize(slot + 1);
    by_slot_[slot] = &site;
  }
}

void LibraryCalls::forget_starts() {
  look(processor_.now());
  started_ = 0;
  wheels_ = {};
  first_speed_ = -1;
  idle_agendas_.clear();
}

// --- what a call says

void LibraryCalls::called(api::HostFunction function) { entered(api::host_place(function)); }

// by far the most calls are readings of one of eight sensors while the scan runs, and LEDs that there are
bool LibraryCalls::is_right(const Site& site) const {
  switch (site.known->function) {
    case Function::Proximity:
      return processor_.w(0) < kProximity && has_started(Function::StartScan);
    case Function::Led:
      return processor_.w(0) <= kAllLeds;
    default:
      return false;
  }
}

void LibraryCalls::entered(unsigned address) {
  const Site* const found = functions_.at(address);
  if (!found || is_right(*found)) return;
  const Site& site = *found;
  if (!starts(site.known->function) && functions_.is_own(address)) return;
  const auto signed_w = [this](int n) {
    return static_cast<int>(static_cast<std::int16_t>(processor_.w(n)));
  };
  // Two mistakes that several functions share: an index out of range, and a scan that was never started.
  const auto index = [&](const char* what, int count, const char* then) {
    if (processor_.w(0) >= count) note_range(site, what, processor_.w(0), 0, count - 1, then);
  };
  const auto scanned = [&] {
    if (!site.prefix.empty() || has_started(Function::StartScan)) return;
    if (chip_.device().peek(kAdcon1, chip_.latest()) & kAdon) return;  // started by other means
    note("sensors not started", "e_init_ad_scan()",
         std::string(site.known->name) +
             "() reads what no scan has written, for e_init_ad_scan() was not called",
         "call e_init_ad_scan(ALL_ADC) before the loop");
  };
  switch (site.known->function) {
    case Function::SpeedLeft:
      return set_speed(site, 0, signed_w(0));
    case Function::SpeedRight:
      return set_speed(site, 1, signed_w(0));
    case Function::Speed: {
      const int linear = signed_w(0), angular = signed_w(1), all = std::abs(linear) + std::abs(angular);
      // the library adds in 16 bits: what goes beyond them becomes negative, and passes
      const auto set = [](int n) {
        return std::clamp(static_cast<int>(static_cast<std::int16_t>(n)), -kMaxSpeed, kMaxSpeed);
      };
      const int left = set(linear - angular), right = set(linear + angular),
                seen = static_cast<std::int16_t>(all);
      if (all > kMaxSpeed)
        note("speed out of range", "e_set_speed()",
             "got " + std::to_string(linear) + " and " + std::to_string(angular) +
                 " steps/s, expected magnitudes of together at most " + std::to_string(kMaxSpeed) +
                 (seen > kMaxSpeed
                      ? "; the library leaves the speed as it is"
                      : "; in 16 bits their sum is " + std::to_string(seen) + ", so the library sets " +
                            std::to_string(left) + " left and " + std::to_string(right) + " right"),
             "the motors are not faster");
      if (seen > kMaxSpeed || !site.is_whole) return;
      set_speed(site, 0, left);
      return set_speed(site, 1, right);
    }
    case Function::Proximity:
      index("sensor", board_.selector() == drivers::kGumstixPosition ? kGumstixProximity : kProximity,
            "the library returns 0");
      return scanned();
    case Function::Acceleration:
      if (!site.prefix.empty()) return;
      index("axis", kAxes, "the library returns 666");
      return scanned();
    case Function::Microphone:
      if (!site.prefix.empty()) return;
      index("microphone", kMicrophones, "what lies behind the array is read");
      return scanned();
    case Function::Led:
      return note("LED out of range", "e_set_led()",
                  "got LED " + std::to_string(processor_.w(0)) +
                      ", expected 0 to 7, or 8 for all; the library sets all eight",
                  "count from 0; body and front have functions of their own");
    case Function::ActivateAgenda:
      return activate_agenda(site);
    case Function::SetAgendaCycle:
      if (processor_.w(1) != 0 && !idle_agendas_.empty()) idle_agendas_.erase(processor_.w(0));
      return;
    default:
      started_ |= bit(site.known->function);
  }
}

void LibraryCalls::set_speed(const Site& site, int wheel, int speed) {
  Wheel& w = wheels_[static_cast<std::size_t>(wheel)];
  const Cycle now = processor_.now();
  // what e_set_speed() passes on is told of that
  if ((speed > kMaxSpeed || speed < -kMaxSpeed) &&
      places_.place_of(places_.caller()).function != "e_set_speed")
    note(std::string("speed out of range ") + (wheel == 0 ? "left" : "right"),
         std::string(site.known->name) + "()",
         "got " + std::to_string(speed) + " steps/s, expected -" + std::to_string(kMaxSpeed) + " to " +
             std::to_string(kMaxSpeed) + "; the library takes the nearest of these",
         "the motors are not faster");
  // It shall turn from now on: look() holds this against the steps that it makes.
  if (speed != 0 && w.speed == 0) {
    w.since = now;
    w.steps = steps_of(wheel, now);
    w.place = places_.own(caller());
    if (is_of_agendas(site) && first_speed_ < 0) {
      first_speed_ = now;
      first_speed_at_ = w.place;
      first_steps_ = steps_of(0, now) + steps_of(1, now);
    }
  }
  if (speed == 0) look(now);
  if (speed != w.speed) w.is_steady = false;
  ++w.again;
  w.speed = speed;
}

void LibraryCalls::activate_agenda(const Site& site) {
  const unsigned function = processor_.w(0), cycle = processor_.w(1);
  if (function == 0)
    note("agenda without a function", "e_activate_agenda()",
         "got a null pointer, expected a function: the first tick calls address 0, and the program begins "
         "anew",
         "name the function");
  if (cycle != 0 || !site.prefix.empty() || functions_.motors_.count(function)) return;
  // Somebody may still give it a cycle, so this is told at the end.
  board::Diagnosis& idle = idle_agendas_[function];
  if (!idle.cause.empty()) return;
  idle = {"agenda without a period",
          "e_activate_agenda()",
          "got cycle 0, expected 1 to 65535 (0.1 ms each): the agenda's function is never called" + where(),
          "give it a cycle, now or with e_set_agenda_cycle()",
          processor_.now(),
          0,
          1};
}

// --- standing still

std::int64_t LibraryCalls::steps_of(int wheel, Cycle now) const {
  return wheel == 0 ? board_.motors().left_steps(now) : board_.motors().right_steps(now);
}

/// The library's motors begin a half step anew with each call: set all the time, one speed is another.
void LibraryCalls::look_for_slow(int wheel, std::int64_t steps, double span_s) {
  Wheel& w = wheels_[static_cast<std::size_t>(wheel)];
  const int asked = std::min(std::abs(w.speed), kMaxSpeed);
  const double made = static_cast<double>(std::abs(steps - w.looked_steps)) / span_s;
  if (w.is_steady && w.again > kOften * span_s && asked >= kLeastSlow && made > 0 && made < kSlow * asked) {
    const std::string side = wheel == 0 ? "left" : "right";
    note_at(
        "wheel slow", "e_set_speed_" + side + "()",
        fmt::format("got {} steps/s, {:.0f} times a second, and the wheel makes {:.0f}: each call stretches "
                    "the step that is under way; set at {}",
                    w.speed, w.again / span_s, made, places_.text_of(w.place)),
        "set a speed when it changes");
  }
  w.is_steady = true;
  w.again = 0;
  w.looked_steps = steps;
}

bool LibraryCalls::is_told(const char* cause, const std::string& place) const {
  return std::any_of(diagnoses_.begin(), diagnoses_.end(),
                     [&](const board::Diagnosis& d) { return d.cause == cause && d.place == place; });
}

/// The chip tells of inputs that a program drives; a scan known by heart writes no latch.
void LibraryCalls::look_for_dark_emitters(Cycle now) {
  const board::PinDriver* const driver = board_.pins().driver();
  if (!driver || driver->mean_pulses() == 0) return;
  for (const board::Pin pin : board::kEmitterPins) {
    const char letter = dspic::kPortLetters[pin.port];
    if (!(board_.pins().read(letter, board::Pins::Register::Tris, now) & pin.mask())) continue;
    const std::string tris = fmt::format("TRIS{}{}", letter, pin.bit);
    if (!is_told("input driven", tris))
      diagnoses_.push_back(
          {"input driven", tris,
           fmt::format("LAT{}{} is written again and again by the scan, but {} = 1 makes the pin an "
                       "input: the emitters of the proximity sensors stay dark",
                       letter, pin.bit, tris),
           "call e_init_port() first", now, 0, 1});
  }
}

void LibraryCalls::look(Cycle now) {
  const double span_s = static_cast<double>(now - looked_at_) / board::kFcyHz;
  const bool is_long = span_s >= kLeastLook_s;
  if (is_long) looked_at_ = now;
  next_look_ = now + kLookEvery;
  look_for_dark_emitters(now);
  for (int wheel = 0; wheel < 2; ++wheel) {
    Wheel& w = wheels_[static_cast<std::size_t>(wheel)];
    if (w.speed == 0) continue;
    const std::int64_t steps = steps_of(wheel, now);
    if (is_long) look_for_slow(wheel, steps, span_s);
    if (steps != w.steps) {
      w.steps = steps;
      w.since = now;
    } else if (now - w.since >= kStandsStill) {
      const std::string side = wheel == 0 ? "left" : "right";
      const std::string place = "e_set_speed_" + side + "()";
      if (!is_told("wheel stands", place))
        diagnoses_.push_back({"wheel stands", place,
                              "the " + side + " wheel was given " + std::to_string(w.speed) +
                                  " steps/s, and has not turned for 10 s; set at " + places_.text_of(w.place),
                              "see that e_init_port() and e_init_motors() were called, that the timer of the "
                              "motors runs, and that nothing holds its interrupt off",
                              w.since, 0, 1});
    }
  }
}

std::vector<board::Diagnosis> LibraryCalls::diagnoses(Cycle now) const {
  std::vector<board::Diagnosis> all = diagnoses_;
  for (const auto& [function, idle] : idle_agendas_) all.push_back(idle);
  if (first_speed_ < 0 || now - first_speed_ < kSpeedGrace) return all;
  if (steps_of(0, now) + steps_of(1, now) != first_steps_) return all;  // started by other means
  for (const auto& [start, name] : {std::pair{Function::InitMotors, "e_init_motors()"},
                                    std::pair{Function::StartAgendas, "e_start_agendas_processing()"}}) {
    if (has_started(start)) continue;
    all.push_back({"motors stand", name,
                   "speed set, but " + std::string(name) + " was never called: no motor turns; set at " +
                       places_.text_of(first_speed_at_),
                   "call " + std::string(name) + " before the loop", first_speed_, 0, 1});
    break;
  }
  return all;
}

// --- what the library's handlers would stumble over

void LibraryCalls::index_written(api::HostVariable index, unsigned value, int size) {
  const std::string name =
      index == api::HostVariable::e_last_mic_scan_id ? "e_last_mic_scan_id" : "e_last_acc_scan_id";
  note_at("index out of range", name,
          "got " + std::to_string(value) + ", expected 0 to " + std::to_string(size - 1) +
              "; on the robot the next sample is written outside the array; written at " +
              places_.text_of(places_.own(processor_.pc_of_access())),
          "leave the driver's variables to the driver");
}

void LibraryCalls::stack_out_of_range(unsigned stack, unsigned least, unsigned limit, unsigned pushed) {
  // a limit that nothing fits below is what is wrong
  const bool has_room = limit + 2 >= least + pushed;
  const std::string what = has_room
                               ? "got W15 " + dspic::hex(stack, 4) + ", expected " + dspic::hex(least, 4) +
                                     " to " + dspic::hex(limit + 2 - pushed, 4) + ", SPLIM less the " +
                                     std::to_string(pushed) + " bytes that the library's interrupts push"
                               : "got SPLIM " + dspic::hex(limit, 4) + ", expected " +
                                     dspic::hex(least + pushed - 2, 4) + " or more, for the " +
                                     std::to_string(pushed) + " bytes that the library's interrupts push";
  note_at("stack out of range", has_room ? "W15" : "SPLIM",
          what + "; on the robot the next one traps, or writes over variables; at " +
              places_.text_of(places_.own(processor_.pc())),
          "see that nothing writes to W15 or SPLIM, and how deep calls and local arrays reach");
}

// --- telling

/// The call that led here; one of the host's functions need not have left a return address.
unsigned LibraryCalls::caller() const {
  const unsigned at = processor_.pc_of_access();
  for (const unsigned behind : {at + 2, at + 4})
    if (places_.call_before(behind) == at) return at;
  return places_.caller();
}

unsigned LibraryCalls::return_address() const {
  const unsigned at = caller();
  for (const unsigned behind : {at + 2, at + 4})
    if (places_.call_before(behind) == at) return behind;
  return 0;
}

bool LibraryCalls::Functions::activates_agenda(unsigned address) const {
  const Site* const site = at(address);
  return site && site->prefix.empty() && site->known->function == Function::ActivateAgenda &&
         !is_own(address);
}

bool LibraryCalls::Functions::is_own(unsigned address) const {
  if (dspic::is_host_place(address)) return false;
  std::call_once(own_once_, [this] {
    if (file_.code.lines().rows.empty()) return;
    for (const auto& [begin, site] : sites_)
      if (!starts(site.known->function) && ProgramPlaces::is_own(file_, begin)) own_.insert(begin);
  });
  return own_.count(address) > 0;
}

std::string LibraryCalls::where() const { return "; called at " + places_.text_of(places_.own(caller())); }

void LibraryCalls::note_range(const Site& site, const std::string& what, int got, int least, int most,
                              const std::string& then) {
  note(what + " out of range", std::string(site.known->name) + "()",
       "got " + what + " " + std::to_string(got) + ", expected " + std::to_string(least) + " to " +
           std::to_string(most) + "; " + then,
       "count from 0");
}

void LibraryCalls::note(const std::string& cause, const std::string& place, const std::string& message,
                        const std::string& hint) {
  note_at(cause, place, message + where(), hint);
}

void LibraryCalls::note_at(const std::string& cause, const std::string& place, const std::string& message,
                           const std::string& hint) {
  for (board::Diagnosis& known : diagnoses_)
    if (known.cause == cause && known.place == place) {
      ++known.count;
      return;
    }
  diagnoses_.push_back({cause, place, message, hint, processor_.now(), 0, 1});
}

}  // namespace chip
