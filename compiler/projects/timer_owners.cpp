// SPDX-License-Identifier: MIT
// See timer_owners.h. Owners as the library has them; a driver counts as used when its header is included.
#include "timer_owners.h"
#include "sim_core/base/pattern.h"

#include <algorithm>

namespace cc {
namespace {

struct Owner {
  const char* header;  // trailing part of the include, lower case
  const char* driver;
  const char* timers;  // digits
};

// drivers of which a program may use a part: what it must call to have the interrupt
struct Caller {
  const char* function;
  const char* driver;
  const char* vectors[2];
};

constexpr Caller kCallers[] = {
    {"e_init_ad_scan", "the ADC scan", {"ADC", nullptr}},
    {"e_init_uart1", "the driver of UART 1", {"U1RX", "U1TX"}},
    {"e_init_uart2", "the driver of UART 2", {"U2RX", "U2TX"}},
    {"e_i2c_enable", "the I2C driver", {"MI2C", nullptr}},
    {"e_init_sound", "the codec's driver", {"DCI", nullptr}},
    {"e_init_remote_control", "the remote control's driver", {"INT0", nullptr}},
};

constexpr Owner kOwners[] = {
    {"motor_led/advance_one_timer/fast_agenda/e_agenda_fast.h", "the fast agenda", "123"},
    {"motor_led/advance_one_timer/e_agenda.h", "the agenda", "2"},
    {"motor_led/advance_one_timer/e_motors.h", "the agenda motors", "2"},
    {"motor_led/e_motors.h", "the basic motors", "45"},
    {"motor_led/e_motors_timer3.h", "the Timer 3 motors", "3"},
    {"a_d/e_prox.h", "the basic proximity sensors", "1"},
    {"camera/fast_2_timer/e_poxxxx.h", "the camera", "45"},
    {"camera/fast_2_timer/e_po3030k.h", "the camera", "45"},
    {"camera/fast_2_timer/e_po6030k.h", "the camera", "45"},
    {"camera/fast_2_timer/e_po8030d.h", "the camera", "45"},
    {"camera/slow_3_timer/e_po3030k.h", "the slow camera", "145"},
};

}  // namespace

std::vector<std::string> timer_conflicts(const std::vector<std::pair<std::string, std::string>>& texts,
                                         const std::map<std::string, std::string>& replaced_headers) {
  static const sim::Pattern kInclude(R"(^[ \t]*#[ \t]*include[ \t]*[<"]([^>"]+)[>"])", std::regex::multiline);
  static const sim::Pattern kHandler(R"(\bvoid\b[^;{}]*?\b_([A-Z0-9]+)Interrupt\s*\([^;{}]*\)[^;{}]*\{)");
  static const sim::Pattern kCall(R"(\b(e_[a-z0-9_]+)\s*\()");
  std::map<std::string, std::map<std::string, std::string>> users;  // vector -> driver -> file
  for (const auto& [file, text] : texts) {
    for (std::sregex_iterator it(text.begin(), text.end(), kInclude), end; it != end; ++it) {
      std::string name = (*it)[1];
      std::transform(name.begin(), name.end(), name.begin(),
                     [](char c) { return c == '\\' ? '/' : char(::tolower(c)); });
      for (const auto& owner : kOwners) {
        std::string tail = owner.header;
        if (name.size() < tail.size() || name.compare(name.size() - tail.size(), tail.size(), tail) != 0)
          continue;
        const auto other = replaced_headers.find(owner.header);
        const std::string header = other == replaced_headers.end() ? owner.header : other->second;
        for (const auto& linked : kOwners)
          if (header == linked.header)
            for (const char* t = linked.timers; *t; ++t)
              users[std::string("T") + *t].emplace(linked.driver, file);
        break;
      }
    }
    for (std::sregex_iterator it(text.begin(), text.end(), kHandler), end; it != end; ++it)
      users[(*it)[1]].emplace("the program's own _" + (*it)[1].str() + "Interrupt in " + file, file);
    for (std::sregex_iterator it(text.begin(), text.end(), kCall), end; it != end; ++it)
      for (const Caller& caller : kCallers)
        if (caller.function == (*it)[1].str())
          for (const char* vector : caller.vectors)
            if (vector) users[vector].emplace(caller.driver, file);
  }
  std::vector<std::string> messages;
  for (auto& [vector, drivers] : users) {
    // the agenda and the agenda motors share Timer 2 on purpose
    drivers.size() > 1 ? drivers.erase(vector == "T2" ? "the agenda motors" : "") : 0;
    if (drivers.size() < 2) continue;
    std::string list, file;
    for (const auto& [driver, where] : drivers) list += (list.empty() ? "" : " and ") + driver, file = where;
    const bool is_timer = vector.size() == 2 && vector[0] == 'T';
    messages.push_back(file + ": warning: " + (is_timer ? "Timer " + vector.substr(1) : "vector " + vector) +
                       ": got two owners (" + list + "), expected one; the later one silences the other");
  }
  return messages;
}

}  // namespace cc
