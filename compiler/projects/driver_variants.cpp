// SPDX-License-Identifier: MIT
// See driver_variants.h. Which functions a form has, its header says.
#include "driver_variants.h"

#include <algorithm>
#include <iterator>

#include "compiler/cache/inputs.h"
#include "compiler/cache/object_cache.h"
#include "library_copies.h"
#include "sim_core/base/pattern.h"

namespace cc {
namespace fs = std::filesystem;
namespace {

// the usual form first
constexpr Driver kDrivers[] = {
    {"motors",
     true,
     {{"motor_led/advance_one_timer/e_motors.c", "motor_led/advance_one_timer/e_motors.h", ""},
      {"motor_led/e_motors.c", "motor_led/e_motors.h", "tp_basic_"},
      {"motor_led/e_motors_timer3.c", "motor_led/e_motors_timer3.h", "tp_timer3_"},
      {"motor_led/advance_one_timer/fast_agenda/e_motors.c",
       "motor_led/advance_one_timer/fast_agenda/e_motors.h", "tpfast_"}}},
    {"LEDs",
     true,
     {{"motor_led/advance_one_timer/e_led.c", "motor_led/advance_one_timer/e_led.h", ""},
      {"motor_led/e_led.c", "motor_led/e_led.h", "tp_basic_"},
      {"motor_led/advance_one_timer/fast_agenda/e_led.c", "motor_led/advance_one_timer/fast_agenda/e_led.h",
       "tpfast_"}}},
    {"agendas",
     true,
     {{"motor_led/advance_one_timer/e_agenda.c", "motor_led/advance_one_timer/e_agenda.h", ""},
      {"motor_led/advance_one_timer/fast_agenda/e_agenda_fast.c",
       "motor_led/advance_one_timer/fast_agenda/e_agenda_fast.h", "tpfast_"}}},
    {"converter",
     true,
     {{"a_d/advance_ad_scan/e_ad_conv.c", "a_d/advance_ad_scan/e_ad_conv.h", ""},
      {"a_d/e_ad_conv.c", "a_d/e_ad_conv.h", "tp_basic_"}}},
    {"proximity sensors",
     true,
     {{"a_d/advance_ad_scan/e_prox.c", "a_d/advance_ad_scan/e_prox.h", ""},
      {"a_d/e_prox.c", "a_d/e_prox.h", "tp_basic_"},
      {"a_d/e_prox_timer2.c", "a_d/e_prox_timer2.h", "tp_t2_"}}},
    {"accelerometer",
     false,
     {{"a_d/advance_ad_scan/e_acc.c", "a_d/advance_ad_scan/e_acc.h", ""},
      {"a_d/e_accelerometer.c", "a_d/e_accelerometer.h", "tp_basic_"}}},
    {"microphones",
     false,
     {{"a_d/advance_ad_scan/e_micro.c", "a_d/advance_ad_scan/e_micro.h", ""},
      {"a_d/e_micro.c", "a_d/e_micro.h", "tp_basic_"}}},
};

template <typename Visit>
void each_form(const Driver& driver, Visit visit) {
  for (const DriverForm& form : driver.forms)
    if (form.source) visit(form);
}

/// Functions that the form's header declares. The variants on other timers have no header of their own here.
std::set<std::string> functions_of(const DriverForm& form, const fs::path& include_root) {
  fs::path header = include_root / form.header;
  look_at(header);
  if (!fs::exists(header)) {
    static const sim::Pattern kTimer("_timer[23]\\.h$");
    header = std::regex_replace(header.string(), kTimer, ".h");
  }
  static const sim::Pattern kFunction(R"(\b(e_\w+)\s*\()");
  const std::string text = without_comments(read_text(header));
  std::set<std::string> names;
  for (std::sregex_iterator it(text.begin(), text.end(), kFunction), end; it != end; ++it)
    names.insert((*it)[1]);
  return names;
}

std::set<std::string> functions_of(const Driver& driver, const fs::path& include_root) {
  std::set<std::string> all;
  each_form(driver, [&](const DriverForm& form) { all.merge(functions_of(form, include_root)); });
  return all;
}

/// Headers of a form that the texts include, by the trailing part of the path.
bool is_included(const DriverForm& form, const std::vector<std::string>& texts) {
  static const sim::Pattern kInclude(R"(#[ \t]*include[ \t]*[<"]([^>"\n]+)[>"])");
  const std::string tail = std::string("/") + form.header;
  for (const std::string& text : texts)
    for (std::sregex_iterator it(text.begin(), text.end(), kInclude), end; it != end; ++it) {
      std::string name = "/" + (*it)[1].str();
      std::transform(name.begin(), name.end(), name.begin(),
                     [](unsigned char c) { return c == '\\' ? '/' : char(std::tolower(c)); });
      if (name.size() >= tail.size() && name.compare(name.size() - tail.size(), tail.size(), tail) == 0)
        return true;
    }
  return false;
}

/// The form that has every function the program calls without a header, null when the usual one has them all.
const DriverForm* form_without_header(const Driver& driver, const ProgramSymbols& symbols,
                                      const fs::path& include_root) {
  const auto all = functions_of(driver, include_root);
  std::set<std::string> called;
  std::set_intersection(all.begin(), all.end(), symbols.wanted.begin(), symbols.wanted.end(),
                        std::inserter(called, called.end()));
  const DriverForm* found = nullptr;
  each_form(driver, [&](const DriverForm& form) {
    const auto has = functions_of(form, include_root);
    if (!found && std::includes(has.begin(), has.end(), called.begin(), called.end())) found = &form;
  });
  return found == &driver.forms[0] ? nullptr : found;
}

}  // namespace

std::vector<DriverChoice> choose_driver_forms(const ProgramSymbols& symbols,
                                              const std::vector<std::string>& listed,
                                              const std::vector<std::string>& texts,
                                              const fs::path& include_root) {
  std::vector<DriverChoice> choices;
  for (const Driver& driver : kDrivers) {
    std::vector<const DriverForm*> of_project, of_headers, of_labels;
    each_form(driver, [&](const DriverForm& form) {
      if (std::find(listed.begin(), listed.end(), form.source) != listed.end()) of_project.push_back(&form);
      const auto has = functions_of(form, include_root);
      bool is_wanted = false;
      for (const std::string& name : has) is_wanted = is_wanted || symbols.wanted.count(form.prefix + name);
      if (!is_wanted) return;
      if (*form.prefix) of_labels.push_back(&form);
      if (*form.prefix || is_included(form, texts)) of_headers.push_back(&form);
    });
    if (!driver.is_exchangeable && (of_headers.size() > 1 || !of_labels.empty())) continue;
    if (of_project.size() == 1) {
      choices.push_back({&driver, of_project[0], ""});
    } else if (of_headers.size() > 1) {
      // names that two forms share can be linked once only
      const auto first = functions_of(*of_headers[0], include_root),
                 other = functions_of(*of_headers[1], include_root);
      std::set<std::string> shared;
      std::set_intersection(first.begin(), first.end(), other.begin(), other.end(),
                            std::inserter(shared, shared.end()));
      bool is_wanted_twice = false;
      for (const std::string& name : shared)
        is_wanted_twice = is_wanted_twice || symbols.wanted.count(of_headers[1]->prefix + name);
      if (is_wanted_twice)
        choices.push_back({&driver, of_headers[0],
                           std::string(driver.name) + ": got headers of several drivers (" +
                               of_headers[0]->header + " and " + of_headers[1]->header + "), expected one; " +
                               of_headers[0]->source + " is linked for the whole program"});
    } else if (of_headers.size() == 1) {
      choices.push_back({&driver, of_headers[0], ""});
    } else if (const DriverForm* form = form_without_header(driver, symbols, include_root)) {
      choices.push_back({&driver, form, ""});
    }
  }
  return choices;
}

std::map<std::string, std::string> replaced_headers(const std::vector<DriverChoice>& choices) {
  std::map<std::string, std::string> replaced;
  for (const DriverChoice& choice : choices)
    each_form(*choice.driver, [&](const DriverForm& form) {
      if (&form != choice.form) replaced[form.header] = choice.form->header;
    });
  return replaced;
}

FormOfSource form_of_source(const std::string& source, const std::vector<DriverChoice>& choices) {
  FormOfSource found;
  for (const Driver& driver : kDrivers)
    each_form(driver, [&](const DriverForm& form) {
      if (source != form.source) return;
      const auto chosen = std::find_if(choices.begin(), choices.end(),
                                       [&](const DriverChoice& c) { return c.driver == &driver; });
      found.prefixes = {form.prefix};
      if (chosen != choices.end())
        found.is_linked = chosen->form == &form;
      else if (driver.is_exchangeable)
        found.is_linked = &form == &driver.forms[0];
      // whatever header a file includes, one form is linked
      if (driver.is_exchangeable || chosen != choices.end())
        each_form(driver, [&](const DriverForm& other) { found.prefixes.push_back(other.prefix); });
    });
  return found;
}

std::map<std::string, std::string> own_functions(const ProgramSymbols& symbols,
                                                 const fs::path& include_root) {
  std::map<std::string, std::string> own;
  for (const Driver& driver : kDrivers)
    each_form(driver, [&](const DriverForm& form) {
      if (!*form.prefix) return;
      for (const std::string& name : functions_of(form, include_root))
        if (symbols.defined.count(name)) own[form.prefix + name] = name;
    });
  return own;
}

std::vector<std::string> functions_of_two_drivers(const ProgramSymbols& symbols,
                                                  const std::vector<DriverChoice>& choices,
                                                  const fs::path& include_root) {
  std::vector<std::string> messages;
  for (const Driver& driver : kDrivers) {
    // the chosen form, or the usual one, which is linked under the functions' own names
    const auto chosen = std::find_if(choices.begin(), choices.end(),
                                     [&](const DriverChoice& c) { return c.driver == &driver; });
    if (!driver.is_exchangeable && chosen == choices.end()) continue;
    const DriverForm& form = chosen == choices.end() ? driver.forms[0] : *chosen->form;
    const auto has = functions_of(form, include_root);
    const auto is_wanted = [&](const std::string& name) {
      bool is = false;
      each_form(driver, [&](const DriverForm& f) { is = is || symbols.wanted.count(f.prefix + name); });
      return is && !symbols.defined.count(name);
    };
    // of a driver that is the program's own nothing is ours
    const bool is_used = std::any_of(has.begin(), has.end(), is_wanted);
    each_form(driver, [&](const DriverForm& other) {
      std::string names, twice;
      for (const std::string& name : functions_of(other, include_root))
        if (has.count(name))
          twice = twice.empty() ? name : twice;
        else if (is_wanted(name))
          names += (names.empty() ? "" : ", ") + name + "()";
      const bool is_told = std::any_of(messages.begin(), messages.end(), [&](const std::string& m) {
        return m.find(": got " + names + " of ") != std::string::npos;
      });
      if (!is_used || names.empty() || twice.empty() || is_told) return;
      messages.push_back(std::string(driver.name) + ": got " + names + " of " + other.source + ", but " +
                         form.source +
                         " is linked, expected functions of one of them; the robot's linker "
                         "refuses both: multiple definition of " +
                         twice + "()");
    });
  }
  return messages;
}

std::map<std::string, std::string> renamed_functions(const ProgramSymbols& symbols,
                                                     const std::vector<DriverChoice>& choices,
                                                     const fs::path& include_root) {
  std::map<std::string, std::string> renamed;
  for (const DriverChoice& choice : choices) {
    const auto has = functions_of(*choice.form, include_root);
    const auto all = functions_of(*choice.driver, include_root);
    each_form(*choice.driver, [&](const DriverForm& form) {
      for (const std::string& name : all) {
        const std::string label = form.prefix + name;
        if (!symbols.wanted.count(label)) continue;
        if (symbols.defined.count(name)) {
          if (label != name) renamed[label] = name;  // the program's own
        } else if (has.count(name) && label != choice.form->prefix + name) {
          renamed[label] = choice.form->prefix + name;
        }
      }
      // a function that only another form has, called without its header
      for (const std::string& name : functions_of(form, include_root))
        if (*form.prefix && !has.count(name) && symbols.wanted.count(name) && !symbols.defined.count(name))
          renamed.emplace(name, form.prefix + name);
    });
  }
  return renamed;
}

}  // namespace cc
