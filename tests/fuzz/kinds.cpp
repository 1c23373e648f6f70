// SPDX-License-Identifier: MIT
#include "tests/fuzz/kinds.h"

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>

#include "compiler/build/build.h"
#include "compiler/cache/elf_reader.h"
#include "compiler/projects/library_copies.h"
#include "compiler/projects/makefile_project.h"
#include "compiler/projects/mplab_project.h"
#include "exercises/table.h"
#include "hal_sim/board/epuck_model.h"
#include "hal_sim/board/part.h"
#include "hal_sim/faults/injector.h"
#include "hal_sim/signals/condition.h"
#include "hal_sim/twin/world_file.h"
#include "import/import.h"
#include "import/picture.h"
#include "import/wbt_reader.h"
#include "sim_core/load/floor_image.h"
#include "sim_core/load/world_loader.h"
#include "sim_core/simulation.h"
#include "sim_core/sound/wav_file.h"
#include "tests/sim_core/fixture.h"
#include "tools/verbs.h"

namespace fuzz {
namespace {

namespace fs = std::filesystem;

void require(bool holds, const std::string& what) {
  if (holds) return;
  std::fprintf(stderr, "%s\n", what.c_str());
  std::abort();
}

// what a name leads to is read from a folder of this process
const fs::path& scratch() {
  static const fs::path folder = [] {
    const fs::path made = fs::temp_directory_path() / ("twinpuck-fuzz-" + std::to_string(getpid()));
    fs::create_directories(made);
    std::atexit([] {
      std::error_code none;
      fs::remove_all(fs::temp_directory_path() / ("twinpuck-fuzz-" + std::to_string(getpid())), none);
    });
    return made;
  }();
  return folder;
}

void write(const fs::path& file, std::string_view bytes) {
  fs::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

}  // namespace

void world(std::string_view bytes) {
  const sim::LoadedWorld loaded =
      sim::parse_world(bytes, "/nonexistent/fuzz.toml", {board::epuck_model()}, board::part_kinds());
  require(loaded.world.has_value() == loaded.problems.empty(), "neither a world nor a problem");
  for (const sim::WorldProblem& p : loaded.problems) require(!p.text.empty(), "a problem without a word");
  if (!loaded.world || loaded.world->robots.size() + loaded.world->objects.size() > 40) return;
  const auto simulation = sim_test::cruising(*loaded.world, 3, 2);
  for (int i = 0; i < 3; ++i) simulation->step();
  for (int r = 0; r < simulation->robots(); ++r) {
    const sim::Pose2 at = simulation->pose(r);
    require(std::isfinite(at.x_m) && std::isfinite(at.y_m) && std::isfinite(at.heading_rad),
            "a pose that is none");
  }
}

void wbt(std::string_view bytes) {
  ::wbt::Options given;
  given.file = "fuzz.wbt";
  given.model = board::epuck_model();
  given.has_firmware = given.has_program = [](const std::string& name) { return name.size() % 2 == 0; };
  const ::wbt::Imported made = ::wbt::import_world(bytes, given);
  require(made.errors.empty() != made.toml.empty(), "neither a world nor an error");
  for (const ::wbt::Remark& r : made.report) require(!r.text.empty(), "a remark without a word");
  if (!made.errors.empty()) return;
  const auto loaded =
      sim::parse_world(made.toml, "/nonexistent/fuzz.toml", {given.model}, board::part_kinds());
  require(loaded.world.has_value(), made.toml + loaded.report("fuzz.toml"));
}

void proto(std::string_view bytes) {
  ::wbt::Proto read;
  if (!::wbt::read_proto_text(bytes, read)) return;
  ::wbt::Node instance;
  instance.type = "Block";
  std::size_t budget = 20000;
  ::wbt::unfold(read, instance, budget);
}

void lab(std::string_view bytes) {
  std::vector<std::string> problems;
  const auto table = lab::parse_table(std::string(bytes), "lab.toml", problems);
  require(table.empty() == !problems.empty(), "neither a table nor a problem");
}

void project(std::string_view bytes) {
  const fs::path folder = scratch() / "project";
  write(folder / "main.c", "int main(void) { return 0; }\n");
  write(folder / "p.mcp", bytes);
  write(folder / "Makefile", bytes);
  std::string told;
  cc::find_mplab_project(folder, told);
  cc::read_makefile(folder);
  write(folder / "p.mcp", "");
  write(folder / "nbproject/configurations.xml", bytes);
  cc::find_mplab_project(folder, told);
}

void source(std::string_view bytes) {
  const fs::path file = scratch() / "source" / "main.c";
  write(file, bytes);
  cc::defines_main(file);
  cc::find_library_members(file.parent_path(), {file});
}

void elf(std::string_view bytes) {
  const fs::path file = scratch() / "x.so";
  write(file, bytes);
  cc::read_elf(file);
}

void picture(std::string_view bytes) {
  if (const auto colour = ::wbt::average_colour_of(std::string(bytes)))
    require(colour->r >= 0 && colour->r <= 1 && colour->g >= 0 && colour->b <= 1, "a colour beyond 0 to 1");
}

void wav(std::string_view bytes) {
  sim::WavSound sound;
  const std::string wrong = sim::parse_wav(bytes, sound);
  require(wrong.empty() != sound.samples.empty(), "neither samples nor a problem");
  for (const float s : sound.samples) require(s >= -1 && s <= 1, "a sample beyond -1 to 1");
}

void faults(std::string_view bytes) {
  const ::faults::LoadedFaults loaded = ::faults::parse_faults(bytes, "f.toml");
  for (const sim::WorldProblem& p : loaded.problems) require(!p.text.empty(), "a problem without a word");
  static const std::unique_ptr<twin::Twin> twin = [] {
    sim::WorldDesc world;
    world.models = twin::robot_models();
    for (const char* name : {"e-puck", "b.2"}) {
      world.robots.emplace_back();
      world.robots.back().name = name;
    }
    std::vector<std::string> problems;
    return twin::Twin::open(world, {}, problems);
  }();
  require(twin != nullptr, "no world");
  ::faults::Injector injector(*twin);
  for (const ::faults::Fault& fault : loaded.faults) {
    require(!::faults::said(fault).empty(), "a fault without a word");
    if (!loaded.problems.empty()) continue;
    try {
      injector.add(fault);
    } catch (const std::runtime_error&) {
    }
  }
  ::faults::Fault fault;
  std::string wrong;
  const std::string line(bytes.substr(0, bytes.find('\n')));
  require(::faults::parse_fault_line(line, fault, wrong) || !wrong.empty(), "neither a fault nor a problem");
  try {
    signals::Condition(line, *twin, 0).holds(*twin);
  } catch (const std::runtime_error& e) {
    require(*e.what() != 0, "refused without a word");
  }
}

// every verb but those that write without being asked for a file, on files that do not exist
void options(std::string_view bytes) {
  std::vector<std::string> words{"twinpuck"};
  for (std::size_t begin = 0; begin <= bytes.size() && words.size() < 60;) {
    const std::size_t end = std::min(bytes.find('\n', begin), bytes.size());
    const std::string word(bytes.substr(begin, end - begin));
    words.push_back(word.substr(0, word.find('\0')));
    if (words.size() == 2) words.push_back("/nonexistent/file");
    begin = end + 1;
  }
  int exit_code = 0;
  CLI::App app{"fuzz"};
  app.require_subcommand(1);
  tools::add_run(app, exit_code);
  tools::add_lint(app, exit_code);
  tools::add_cycles(app, exit_code);
  tools::add_import(app, exit_code);
  std::vector<char*> argv;
  for (std::string& w : words) argv.push_back(w.data());
  std::streambuf* const out = std::cout.rdbuf(nullptr);
  std::streambuf* const error = std::cerr.rdbuf(nullptr);
  try {
    app.parse(static_cast<int>(argv.size()), argv.data());
    require(exit_code == 2, "a file that does not exist: got exit code " + std::to_string(exit_code));
  } catch (const CLI::Error&) {
  } catch (const fs::filesystem_error&) {  // main() says which
  }
  std::cout.rdbuf(out);
  std::cerr.rdbuf(error);
}

}  // namespace fuzz
