// SPDX-License-Identifier: MIT
// One function for each kind of input that a user or a stranger hands us. It takes any bytes and returns, or
// aborts: whatever they are, the answer is a result or a list of problems, soon. `make fuzz` drives them by
// libFuzzer (one program a kind, fuzz_main.cpp), `make test` by a few hundred changed seeds and by everything
// that crashed once (fuzz_test.cpp). They are linked with the very libraries of the command: a target that
// was built from a few sources of its own did not see what another file's copy of the parser does.
#pragma once
#include <string_view>

namespace fuzz {

void world(std::string_view bytes);     ///< world files: loaded, checked and, when small, run for three ticks
void wbt(std::string_view bytes);       ///< worlds of Webots: what is accepted must be a world of ours
void proto(std::string_view bytes);     ///< PROTO files beside them
void lab(std::string_view bytes);       ///< tables of exercises
void project(std::string_view bytes);   ///< .mcp, configurations.xml and Makefile beside a controller
void source(std::string_view bytes);    ///< C files, as far as the build itself reads them
void elf(std::string_view bytes);       ///< images and objects, as far as `cycles` and the build read them
void picture(std::string_view bytes);   ///< floors (PNG), pictures of Webots' worlds (PNG, JPEG)
void wav(std::string_view bytes);       ///< WAV files
void firmware(std::string_view bytes);  ///< programs of the chip: Intel HEX and ELF
void assembler(std::string_view bytes);  ///< assembler text
void code(std::string_view bytes);       ///< words of flash that the core runs for a moment
void faults(std::string_view bytes);   ///< files of faults; as a line of the command, too, and as a condition
void options(std::string_view bytes);  ///< command lines: a verb, then a word a line

struct Kind {
  const char* name;
  void (*run)(std::string_view bytes);
};
inline constexpr Kind kKinds[] = {{"world", world},     {"wbt", wbt},           {"proto", proto},
                                  {"lab", lab},         {"project", project},   {"source", source},
                                  {"elf", elf},         {"picture", picture},   {"wav", wav},
                                  {"options", options}, {"firmware", firmware}, {"assembler", assembler},
                                  {"code", code},       {"faults", faults}};

}  // namespace fuzz
