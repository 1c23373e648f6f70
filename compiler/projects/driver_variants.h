// SPDX-License-Identifier: MIT
// The library has several forms of some drivers under the same names of functions: motors on agendas, on
// timers 4 and 5, on timer 3. On the robot one form is linked, whatever header a file includes. Which one, in
// this order:
//   1. what the program defines itself;
//   2. the form whose source the project file lists;
//   3. the form whose header the program includes; of several the usual one, which comes first in the table;
//   4. without a header, the form that has all functions that are called.
// Where forms take different arguments (e_get_acc(&x, &y, &z) and e_get_acc(0)), each file's header decides
// for it. Our headers label the functions of the less usual forms ("tp_basic_e_init_motors"), so a choice is
// a set of names to replace in the program's objects.
#pragma once
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace cc {

struct DriverForm {
  const char* source;  ///< its place in the library; nullptr ends a list
  const char* header;
  const char* prefix;  ///< of its functions' labels here
};

struct Driver {
  const char* name;
  bool is_exchangeable;  ///< functions of one name take the same arguments in all forms
  DriverForm forms[4];
};

struct DriverChoice {
  const Driver* driver;
  const DriverForm* form;
  std::string told;  ///< a warning when files of the program disagree; "" otherwise
};

struct ProgramSymbols {
  std::set<std::string> wanted, defined;  ///< by the program's own objects
};

/// What is chosen for the drivers that `symbols` name. `listed`: places of the library's sources that the
/// project file names and that are not compiled from the project; `texts`: the program's sources and headers.
std::vector<DriverChoice> choose_driver_forms(const ProgramSymbols& symbols,
                                              const std::vector<std::string>& listed,
                                              const std::vector<std::string>& texts,
                                              const std::filesystem::path& include_root);

/// Headers of forms that are not linked -> the header of that which is.
std::map<std::string, std::string> replaced_headers(const std::vector<DriverChoice>& choices);

/// A source of the library as a form of a driver.
struct FormOfSource {
  bool is_linked = true;                     ///< false: another form of its driver is
  std::vector<std::string> prefixes = {""};  ///< of labels by which the program may call its functions
};
FormOfSource form_of_source(const std::string& source, const std::vector<DriverChoice>& choices);

/// Names to replace in the program's objects so that the choices and the program's own functions are linked.
std::map<std::string, std::string> renamed_functions(const ProgramSymbols& symbols,
                                                     const std::vector<DriverChoice>& choices,
                                                     const std::filesystem::path& include_root);

/// What the library itself shall call by another name, since the program has the function: its drivers of one
/// form call one another by their labels.
std::map<std::string, std::string> own_functions(const ProgramSymbols& symbols,
                                                 const std::filesystem::path& include_root);

/// What the program calls that the linked form of a driver has not, but another form has, where the two share
/// names of functions, so that the robot's linker takes only one of them. A message each.
std::vector<std::string> functions_of_two_drivers(const ProgramSymbols& symbols,
                                                  const std::vector<DriverChoice>& choices,
                                                  const std::filesystem::path& include_root);

}  // namespace cc
