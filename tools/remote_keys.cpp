// SPDX-License-Identifier: MIT
// See remote_keys.h.
#include "tools/remote_keys.h"

#include <fmt/format.h>

#include <cstdlib>

#include "sim_core/load/world_loader.h"

namespace tools {

namespace {

struct NamedKey {
  const char* name;
  int code;
};
// as motor_led/advance_one_timer/e_remote_control.h spells them
constexpr NamedKey kNames[] = {{"BOTTOMR", 10}, {"BOTTOMl", 11},  {"STANDBY", 12}, {"MUTE", 13},
                               {"VOL_UP", 16},  {"VOL_DOWN", 17}, {"CHAN_UP", 32}, {"CHAN_DOWN", 33},
                               {"I_II", 35},    {"OUT_AUX_1", 56}};

/// A keyboard's, by Webots' numbers.
constexpr NamedKey kTyped[] = {{"END", 312},   {"HOME", 313}, {"LEFT", 314},   {"UP", 315},
                               {"RIGHT", 316}, {"DOWN", 317}, {"PAGEUP", 366}, {"PAGEDOWN", 367},
                               {"SPACE", ' '}, {"ENTER", 4}};

/// Number of a key of the keyboard: a name, or a character, of which letters are capitals; 0: none.
int typed_key(const std::string& name) {
  for (const NamedKey& named : kTyped)
    if (name == named.name) return named.code;
  if (name.size() != 1 || name[0] <= ' ' || name[0] > '~') return 0;
  return name[0] >= 'a' && name[0] <= 'z' ? name[0] - 'a' + 'A' : name[0];
}

bool whole_number(const std::string& text, int most, int& out) {
  if (text.empty() || text.size() > 3 || text.find_first_not_of("0123456789") != std::string::npos)
    return false;
  out = std::atoi(text.c_str());
  return out <= most;
}

bool seconds(const std::string& text, double& out) {
  char* end = nullptr;
  out = std::strtod(text.c_str(), &end);
  return !text.empty() && *end == '\0' && out >= 0 && out <= 1e7;
}

}  // namespace

std::string add_key(const std::string& robot, const std::string& press, std::vector<sim::RobotDesc>& robots,
                    double& at_s) {
  const std::string form = fmt::format("got '{}', expected [ADDRESS:]KEY@TIME[+HOLD]", press);
  const std::size_t at = press.find('@');
  if (at == std::string::npos) return form + " such as 5@1.5 or VOL_UP@2+0.5";
  sim::KeyDesc key;
  std::string code = press.substr(0, at);
  constexpr const char* kKeyboard = "keyboard:";
  const bool is_typed = code.rfind(kKeyboard, 0) == 0;
  if (is_typed) {
    key.typed = typed_key(code.substr(std::string(kKeyboard).size()));
    if (!key.typed)
      return form +
             ", after keyboard: a character or one of UP, DOWN, LEFT, RIGHT, HOME, END, PAGEUP, "
             "PAGEDOWN, SPACE, ENTER";
  } else if (const std::size_t colon = code.find(':'); colon != std::string::npos) {
    if (!whole_number(code.substr(0, colon), 31, key.address)) return form + ", ADDRESS 0 to 31";
    code = code.substr(colon + 1);
  }
  bool known = is_typed || whole_number(code, 63, key.code);
  std::vector<std::string> names;
  for (const NamedKey& named : kNames) {
    names.push_back(named.name);
    if (code == named.name) key.code = named.code, known = true;
  }
  if (!known) {
    return form + ", KEY 0 to 63 or a name" + sim::did_you_mean_tail(code, names);
  }
  std::string time = press.substr(at + 1);
  if (const std::size_t plus = time.find('+', 1); plus != std::string::npos) {
    if (!seconds(time.substr(plus + 1), key.hold_s)) return form + ", HOLD 0 to 1e7 s";
    time = time.substr(0, plus);
  }
  if (!seconds(time, key.at_s)) return form + ", TIME 0 to 1e7 s";
  at_s = key.at_s;
  bool found = false;
  std::vector<std::string> robot_names;
  for (sim::RobotDesc& r : robots) {
    robot_names.push_back(r.name);
    if (robot != "*" && robot != r.name) continue;
    r.keys.push_back(key);
    found = true;
  }
  if (found) return "";
  return fmt::format("got robot '{}', expected a robot of the world{}", robot,
                     sim::did_you_mean_tail(robot, robot_names));
}

}  // namespace tools
