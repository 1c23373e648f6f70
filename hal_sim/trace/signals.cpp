// SPDX-License-Identifier: MIT
#include "hal_sim/trace/signals.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>

#include "dspic30/memory/irqs.h"
#include "dspic30/memory/sfr_table.h"
#include "hal_sim/board/wiring.h"
#include "sim_core/load/world_loader.h"

namespace trace {

namespace {

constexpr const char* kLines[] = {"TX1", "RX1", "TX2", "RX2"};
constexpr int kMostElements = 256;

struct Named {
  const char* name;
  const char* group;
  Source source;
  int index;
  int shift;
  int width;
};

constexpr Named pin(const char* name, const char* group, Source source, board::Pin pin) {
  return {name, group, source, pin.letter(), pin.bit, 1};
}
constexpr Named coil(const char* name, int bit, int width = 1) {
  return {name, "motors", Source::Lat, 'D', bit, width};
}
constexpr int kRight = board::kRightCoilsBit;

// names of e_epuck_ports.h
constexpr Named kNamed[] = {
    {"LED0", "leds", Source::Lights, 0, 0, 1},
    {"LED1", "leds", Source::Lights, 0, 1, 1},
    {"LED2", "leds", Source::Lights, 0, 2, 1},
    {"LED3", "leds", Source::Lights, 0, 3, 1},
    {"LED4", "leds", Source::Lights, 0, 4, 1},
    {"LED5", "leds", Source::Lights, 0, 5, 1},
    {"LED6", "leds", Source::Lights, 0, 6, 1},
    {"LED7", "leds", Source::Lights, 0, 7, 1},
    {"BODY_LED", "leds", Source::Lights, 0, 8, 1},
    {"FRONT_LED", "leds", Source::Lights, 0, 9, 1},
    coil("MOTOR1_PHA", 0),
    coil("MOTOR1_PHB", 1),
    coil("MOTOR1_PHC", 2),
    coil("MOTOR1_PHD", 3),
    coil("MOTOR2_PHA", kRight),
    coil("MOTOR2_PHB", kRight + 1),
    coil("MOTOR2_PHC", kRight + 2),
    coil("MOTOR2_PHD", kRight + 3),
    coil("left_coils", 0, 4),
    coil("right_coils", kRight, 4),
    {"left_steps", "motors", Source::Steps, 0, 0, 32},
    {"right_steps", "motors", Source::Steps, 1, 0, 32},
    pin("PULSE_IR0", "pins", Source::Lat, board::kEmitterPins[0]),
    pin("PULSE_IR1", "pins", Source::Lat, board::kEmitterPins[1]),
    pin("PULSE_IR2", "pins", Source::Lat, board::kEmitterPins[2]),
    pin("PULSE_IR3", "pins", Source::Lat, board::kEmitterPins[3]),
    pin("AUDIO_ON", "pins", Source::Lat, board::kCodecOnPin),
    pin("CAM_RESET", "pins", Source::Lat, board::kCameraResetPin),
    pin("REMOTE", "pins", Source::Port, board::kRemotePin),
    pin("BATT_LOW", "pins", Source::Port, board::kBatteryGoodPin),
};

Signal signal(std::string group, std::string name, Source source, int index, int shift, int width) {
  Signal s;
  s.group = std::move(group);
  s.name = std::move(name);
  s.source.kind = source;
  s.source.index = index;
  s.shift = shift;
  s.width = width;
  return s;
}

// T2CON; T2CON.TCKPS, T2CONbits.TCKPS. False: no register of the chip; or no field of it, with a sentence.
bool register_signal(const std::string& name, Signal& out, std::string& error) {
  const auto dot = name.find('.');
  std::string word = name.substr(0, dot);
  if (dot != std::string::npos && word.size() > 4 && word.compare(word.size() - 4, 4, "bits") == 0)
    word.resize(word.size() - 4);
  const dspic::SfrInfo* info = dspic::sfr_named(word);
  if (!info) return false;
  out = signal("registers", word, Source::Register, info->address, 0, 16);
  out.possible = info->implemented;
  if (dot == std::string::npos) return true;
  std::string known;
  for (const dspic::SfrField& field : dspic::fields_of(*info)) {
    known += (known.empty() ? "" : ", ") + field.name;
    if (field.name != name.substr(dot + 1)) continue;
    out.name = word + "." + field.name;
    out.shift = field.bit;
    out.width = field.width;
    out.possible >>= field.bit;
    return true;
  }
  error = "got '" + name + "', expected a field of " + word +
          (known.empty() ? ", which has none" : ", one of " + known);
  return false;
}

// coils and IR pulses, which drivers known by heart move without the chip's latches
bool is_of_drivers(const Signal& port) {
  const auto letter = static_cast<char>(port.source.index);
  if (port.source.kind == Source::Lat) return true;  // of a whole port, too
  if (port.source.kind != Source::Port || port.width > 1) return false;
  const bool is_pulse =
      std::any_of(std::begin(board::kEmitterPins), std::end(board::kEmitterPins),
                  [&](board::Pin p) { return p.letter() == letter && p.bit == port.shift; });
  return is_pulse || (letter == 'D' && port.shift < kRight + 4);
}

// the same bits of the chip's own register, unless the board alone knows
void take_from_chip(Signal& port, const host::Runner& runner) {
  if (!runner.chip() || (runner.closed_drivers() && is_of_drivers(port))) return;
  const char* kind = nullptr;
  if (port.source.kind == Source::Lat) kind = "LAT";
  if (port.source.kind == Source::Port) kind = "PORT";
  if (port.source.kind == Source::Tris) kind = "TRIS";
  if (!kind) return;
  const dspic::SfrInfo* info = dspic::sfr_named(std::string(kind) + static_cast<char>(port.source.index));
  port.source.kind = Source::Register;
  port.source.index = info->address;
  port.possible = info->implemented >> port.shift;
}

// LATA, PORTB3, TRISD, RA6; false: not a port
bool port_signal(const std::string& name, Signal& out) {
  struct Form {
    const char* prefix;
    Source source;
    bool pin;
  };
  for (const Form& form : {Form{"LAT", Source::Lat, false}, Form{"PORT", Source::Port, false},
                           Form{"TRIS", Source::Tris, false}, Form{"R", Source::Port, true}}) {
    const std::string prefix = form.prefix;
    if (name.rfind(prefix, 0) != 0 || name.size() <= prefix.size()) continue;
    const char letter = name[prefix.size()];
    if (std::string(board::kPortLetters).find(letter) == std::string::npos) continue;
    const std::string number = name.substr(prefix.size() + 1);
    if (number.empty() && !form.pin) {
      out = signal("pins", name, form.source, letter, 0, 16);
      return true;
    }
    if (number.empty() || number.size() > 2 || number.find_first_not_of("0123456789") != std::string::npos)
      continue;
    const int bit = std::atoi(number.c_str());
    if (bit > 15 || number != std::to_string(bit)) continue;
    out = signal("pins", name, form.source, letter, bit, 1);
    return true;
  }
  return false;
}

// a number, or the numbers of an array
std::string add_variable(const std::string& name, const host::Runner& runner, std::vector<Signal>& out) {
  std::string error;
  const host::Variable* v = runner.data().find_variable(name, error);
  if (!v) return error.empty() ? "got '" + name + "', expected a variable" : error;
  if (v->kind == host::Variable::Kind::Aggregate) {
    for (int i = 0; i < kMostElements; ++i) {
      const std::string element = name + "[" + std::to_string(i) + "]";
      if (!runner.data().find_variable(element, error)) {
        if (i > 0) return "";
        return "got '" + name + "', a struct, expected one of its members";
      }
      std::string wrong = add_variable(element, runner, out);
      if (!wrong.empty()) return wrong;
      if (out.size() >= kMostElements) return "";
    }
    return "";
  }
  Signal s = signal("variables", name, Source::Variable, 0, 0,
                    v->bits > 0 ? v->bits : static_cast<int>(v->bytes) * 8);
  if (s.width > 64) return "got '" + name + "', which is wider than 64 bits, expected a number";
  s.source.variable = *v;
  s.real = v->kind == host::Variable::Kind::Float;
  s.is_signed = v->kind == host::Variable::Kind::Signed;
  if (s.real) s.width = 64;
  out.push_back(std::move(s));
  return "";
}

}  // namespace

std::vector<Signal> find_signals(const std::string& name, const host::Runner* runner, std::string& error) {
  error.clear();
  const bool has_chip = runner && runner->chip();
  for (const Named& n : kNamed)
    if (name == n.name) {
      Signal found = signal(n.group, n.name, n.source, n.index, n.shift, n.width);
      found.is_signed = n.source == Source::Steps;
      if (runner) take_from_chip(found, *runner);
      return {found};
    }
  Signal port;
  if (port_signal(name, port)) {
    if (runner) take_from_chip(port, *runner);
    return {port};
  }
  for (int line = 0; line < 4; ++line)
    if (name == kLines[line])
      return {signal("uart", name, Source::WireByte, line, 0, 8),
              signal("uart", name + "_busy", Source::WireBusy, line, 0, 1)};
  for (int v = 0; v < dspic::kIrqs; ++v)
    if (name == dspic::irq_name(v) && name != "?")
      return {signal("interrupts", name + "_flag", Source::Flag, v, 0, 1),
              signal("interrupts", name + "_service", Source::Service, v, 0, 1)};
  Signal word;
  if (register_signal(name, word, error)) {
    if (has_chip) return {word};
    error = "got '" + name + "', a register, which a program of the PC has not; expected firmware";
    return {};
  }
  if (!error.empty()) return {};
  // Else it is a variable of the program.
  std::vector<Signal> found;
  std::string wrong = "no firmware";
  if (runner) {
    wrong = add_variable(name, *runner, found);
    if (wrong.empty()) return found;
  }
  // the nearest of the names that are no variables
  std::vector<std::string> known;
  for (const Named& n : kNamed) known.push_back(n.name);
  for (const char* line : kLines) known.push_back(line);
  for (int v = 0; v < dspic::kIrqs; ++v) known.push_back(dspic::irq_name(v));
  for (const char* p = board::kPortLetters; *p; ++p)
    for (const char* kind : {"LAT", "PORT", "TRIS"}) known.push_back(std::string(kind) + *p);
  if (has_chip)
    for (const dspic::SfrInfo& r : dspic::kSfrRows) known.push_back(r.name);
  error = fmt::format(
      "got '{}', expected a pin, a port, a register, an interrupt, a UART's line or a variable ({}){}", name,
      wrong, sim::did_you_mean_tail(name, known));
  return {};
}

bool value_of_signal(const Signal& signal, const std::string& text, std::uint64_t& bits, std::string& error) {
  const auto refuse = [&](const std::string& expected) {
    error = "got value '" + text + "', expected " + expected;
    return false;
  };
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  const bool is_number = !text.empty() && !std::isspace(static_cast<unsigned char>(text[0])) && *end == 0;
  // A number with a fraction, as far as the variable can hold it.
  if (signal.real) {
    const bool is_float = signal.source.variable.bytes == sizeof(float);
    const double most = is_float ? static_cast<double>(std::numeric_limits<float>::max())
                                 : std::numeric_limits<double>::max();
    if (!is_number || !std::isfinite(number) || std::fabs(number) > most)
      return refuse(fmt::format("a number from {:g} to {:g}", -most, most));
    // what a float of the robot holds of 0.1
    const double held = is_float ? static_cast<double>(static_cast<float>(number)) : number;
    std::memcpy(&bits, &held, sizeof bits);
    return true;
  }
  // A whole number: within the signal's width, or as bits in hexadecimal.
  const std::uint64_t all = signal.width < 64 ? (std::uint64_t{1} << signal.width) - 1 : ~std::uint64_t{0};
  const std::uint64_t top = signal.is_signed ? all >> 1 : all & signal.possible;
  const std::string range = signal.is_signed ? fmt::format("a whole number from -{} to {}", top + 1, top)
                                             : fmt::format("a whole number from 0 to {}", all);
  if (!is_number) return refuse(range);
  errno = 0;
  const bool is_negative = text[0] == '-';
  const std::uint64_t size = std::strtoull(text.c_str() + (is_negative || text[0] == '+'), &end, 0);
  const bool is_bits = text.compare(0, 2, "0x") == 0 || text.compare(0, 2, "0X") == 0;
  const std::uint64_t most = signal.is_signed ? (is_bits ? all : top + (is_negative ? 1 : 0)) : all;
  if (*end != 0 || errno != 0 || size > most || (is_negative && !signal.is_signed && size != 0))
    return refuse(range);
  bits = (is_negative ? 0 - size : size) & all;
  if (!signal.is_signed && (bits & ~top) != 0) return refuse(fmt::format("bits of {:#x} only", top));
  return true;
}

const std::vector<std::string>& usual_signals() {
  static const std::vector<std::string> kUsual{
      "LED0",       "LED1",        "LED2",       "LED3",       "LED4",       "LED5",
      "LED6",       "LED7",        "BODY_LED",   "FRONT_LED",  "MOTOR1_PHA", "MOTOR1_PHB",
      "MOTOR1_PHC", "MOTOR1_PHD",  "MOTOR2_PHA", "MOTOR2_PHB", "MOTOR2_PHC", "MOTOR2_PHD",
      "left_steps", "right_steps", "PULSE_IR0",  "PULSE_IR1",  "PULSE_IR2",  "PULSE_IR3",
      "AUDIO_ON",   "TX1",         "RX1",        "TX2",        "RX2"};
  return kUsual;
}

}  // namespace trace
