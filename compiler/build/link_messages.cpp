// SPDX-License-Identifier: MIT
// See link_messages.h.
#include "link_messages.h"

#include <algorithm>
#include <array>
#include <sstream>

#include "robot_lacks.h"

namespace cc {
namespace {

bool starts_with(const std::string& text, const std::string& head) { return text.rfind(head, 0) == 0; }

bool is_of_webots(const std::string& name) {
  static constexpr std::array kPrefixes = {
      "wb_",        "wbu_", "supervisor_",         "robot_", "camera_", "speaker_", "display_", "servo_",
      "connector_", "pen_", "differential_wheels_"};
  return std::any_of(kPrefixes.begin(), kPrefixes.end(), [&](const char* p) { return starts_with(name, p); });
}

/// Functions that the original library declares, and defines in no file.
bool is_only_declared(const std::string& name) {
  static constexpr std::array kNames = {"e_i2cp_read_string", "e_i2cp_write_string",
                                        "e_po6030k_set_color_mode", "e_po8030d_set_color_mode"};
  return std::find(kNames.begin(), kNames.end(), name) != kNames.end();
}

/// Of XC16's dsp.h, beside those that are here.
bool is_of_dsp_library(const std::string& name) {
  static constexpr std::array kNames = {"BartlettInit",
                                        "BlackmanInit",
                                        "CosFactorInit",
                                        "DCT",
                                        "DCTIP",
                                        "FIR",
                                        "FIRDecimate",
                                        "FIRDelayInit",
                                        "FIRInterpDelayInit",
                                        "FIRInterpolate",
                                        "FIRLMS",
                                        "FIRLMSNorm",
                                        "FIRLattice",
                                        "FIRStructInit",
                                        "HammingInit",
                                        "HanningInit",
                                        "IFFTComplex",
                                        "IFFTComplexIP",
                                        "IIRCanonic",
                                        "IIRCanonicInit",
                                        "IIRLattice",
                                        "IIRLatticeInit",
                                        "IIRTransposed",
                                        "IIRTransposedInit",
                                        "KaiserInit",
                                        "MatrixAdd",
                                        "MatrixInvert",
                                        "MatrixMultiply",
                                        "MatrixScale",
                                        "MatrixSubtract",
                                        "MatrixTranspose",
                                        "PID",
                                        "PIDCoeffCalc",
                                        "PIDInit",
                                        "VectorAdd",
                                        "VectorConvolve",
                                        "VectorCopy",
                                        "VectorCorrelate",
                                        "VectorDotProduct",
                                        "VectorMin",
                                        "VectorMultiply",
                                        "VectorNegate",
                                        "VectorPower",
                                        "VectorScale",
                                        "VectorSubtract",
                                        "VectorWindow",
                                        "VectorZeroPad"};
  return std::find(kNames.begin(), kNames.end(), name) != kNames.end();
}

/// What may be the matter with a name that nobody defines.
std::string hint_for(const std::string& name) {
  if (is_only_declared(name))
    return "the e-puck library declares this function and defines it nowhere, so the robot's linker refuses "
           "it, too";
  if (is_of_dsp_library(name))
    return "it is a function of Microchip's signal-processing library: put XC16's libdsp-elf.a into the "
           "folder, or write it";
  if (is_of_webots(name))
    return "a controller runs on the robot and has not this function of Webots; docs/webots.md lists what "
           "there "
           "is, and supervisors are programs of their own";
  if (starts_with(name, "e_"))
    return "this function of the e-puck library is not simulated yet, or its name is misspelt";
  return "is a .c file missing from the folder, or the name misspelt?";
}

}  // namespace

std::string with_hints(const std::string& text) {
  static const std::string kMissing = ": got no definition, expected one in the program or the library";
  std::string out;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t at = line.find(kMissing);
    if (at != std::string::npos && at + kMissing.size() == line.size()) {
      const std::size_t begin = line.rfind(' ', at) + 1;
      std::string name = line.substr(begin, at - begin);
      if (name.size() > 2 && name.compare(name.size() - 2, 2, "()") == 0) name.resize(name.size() - 2);
      if (const std::string lack = what_the_robot_lacks(name); !lack.empty())
        line.replace(at, std::string::npos, ": " + lack);
      else
        line += "; " + hint_for(name);
    }
    out += line + "\n";
  }
  return out;
}

namespace {

/// "In file included from main.c:3:" and what goes on from it: where the next message's file is asked for.
bool is_way_to_header(const std::string& line) {
  return line.rfind("In file included from ", 0) == 0 ||
         (line.rfind("  ", 0) == 0 && line.find_first_not_of(' ') == line.find("from "));
}

}  // namespace

void sort_messages(const std::string& text, BuildResult& result, bool failed) {
  std::istringstream lines(text);
  std::vector<std::string>* last = nullptr;
  std::string way;  // to the header of the next message
  for (std::string line; std::getline(lines, line);) {
    const bool is_summary = line.size() > 11 && line.compare(line.size() - 11, 11, " generated.") == 0;
    if (line.empty() || is_summary) continue;
    if (is_way_to_header(line)) {
      way += "\n" + line;
      continue;
    }
    bool is_error =
        line.find(" error: ") != std::string::npos || line.find("fatal error: ") != std::string::npos;
    bool is_warning = line.find("warning: ") != std::string::npos;
    if (is_error || is_warning) {
      last = is_error ? &result.errors : &result.warnings;
      const std::string whole = is_error ? line + way : line;
      if (std::find(last->begin(), last->end(), whole) == last->end()) last->push_back(whole);
    } else if (last && !last->empty() && line.find("note: ") != std::string::npos) {
      last->back() += "\n" + line;
    } else if (failed) {
      last = &result.errors;
      last->push_back(line);
    }
    way.clear();
  }
}

std::string first_error(const std::string& text) {
  BuildResult sorted;
  sort_messages(text, sorted, true);
  const std::string error = sorted.errors.empty() ? "" : sorted.errors.front();
  return error.substr(0, error.find('\n'));
}

}  // namespace cc
