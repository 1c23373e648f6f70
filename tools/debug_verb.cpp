// SPDX-License-Identifier: MIT
// twinpuck debug: the chip way's debugger, as a monitor on the terminal or as a DAP server for editors.
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <iostream>

#include "hal_sim/debug/monitor.h"
#include "hal_sim/twin/world_file.h"
#include "tools/command_line.h"
#include "tools/serial_text.h"
#include "tools/verbs.h"

namespace tools {

namespace {

namespace fs = std::filesystem;

struct DebugArguments {
  std::string world, robot, commands;
  std::vector<std::string> firmware;
  double seconds = 1e6;
  long long seed = -1;
  bool quiet = false;
};

volatile std::sig_atomic_t pause_asked = 0;

/// What a world and its robots are, of the command line.
bool set_up(const DebugArguments& a, debug::Session::Setup& setup, std::vector<std::string>& problems) {
  if (!split_choices(a.firmware, "--fw", setup.options.firmware)) return false;
  const std::string file = find_world(a.world, problems);
  if (file.empty()) return false;
  sim::LoadedWorld loaded = twin::load_world(file);
  if (!loaded.world) {
    problems.push_back(loaded.report(file));
    return false;
  }
  if (a.seed >= 0) loaded.world->seed = static_cast<std::uint64_t>(a.seed);
  setup.world = std::move(*loaded.world);
  setup.options.world_folder = fs::path(setup.world.file).parent_path().string();
  setup.options.way = "chip";
  setup.robot = a.robot;
  setup.seconds = a.seconds;
  return true;
}

int debug_in_terminal(const DebugArguments& a) {
  std::vector<std::string> problems;
  debug::Session::Setup setup;
  std::unique_ptr<SerialText> serial;
  setup.opened = [&](twin::Twin& twin) {
    serial = std::make_unique<SerialText>([](const std::string& line) { std::cout << line << '\n'; });
    for (int i = 0; i < twin.robots(); ++i)
      for (int port = 1; port <= 2; ++port)
        if (twin.uart_choice(i, port) == "-") serial->listen(twin, i, port);
  };
  setup.ticked = [&](twin::Twin&) { serial->show(); };
  if (!set_up(a, setup, problems)) {
    complain(problems);
    return kBadInput;
  }
  const auto session = debug::Session::open(std::move(setup), problems);
  complain(problems);
  if (!session) return kBadInput;
  std::signal(SIGINT, [](int) { pause_asked = 1; });
  debug::Monitor monitor(*session, [] { return std::exchange(pause_asked, 0) != 0; });
  std::ifstream file(a.commands);
  if (!a.commands.empty() && !file) {
    complain({a.commands + ": -x: cannot be read, expected a file of commands"});
    return kBadInput;
  }
  std::istream& in = a.commands.empty() ? std::cin : file;
  const bool is_person = a.commands.empty() && isatty(0) != 0;
  std::cout << session->robot() << ": " << monitor.where();
  if (is_person) std::cout << "help lists the commands\n";
  for (std::string line; !monitor.wants_end();) {
    if (is_person) std::cout << "(twinpuck) " << std::flush;
    if (!std::getline(in, line)) break;
    if (!is_person) std::cout << "> " << line << '\n';
    std::cout << monitor.execute(line) << std::flush;
  }
  return kPass;
}

}  // namespace

void add_debug(CLI::App& app, int& exit_code) {
  auto* verb =
      app.add_subcommand("debug", "Debug a robot's program on the chip: breakpoints, steps, also backwards");
  auto a = std::make_shared<DebugArguments>();
  verb->add_option("WORLD", a->world, "world file, or the name of one in worlds/")->required();
  one_each(verb->add_option("--fw", a->firmware,
                            "[ROBOT=]FILE: a .elf or .hex, a folder of C files, or a controller's name"));
  verb->add_option("-x,--commands", a->commands, "file of commands, instead of the terminal");
  verb->add_option("--robot", a->robot, "the robot to look at; else the first");
  verb->add_option("--for", a->seconds, "simulated seconds after which the world ends")
      ->check(between(0, 1e7));
  verb->add_option("--seed", a->seed, "the world's seed, 0 or more, instead of the file's")
      ->check(CLI::NonNegativeNumber);
  verb->footer("Commands are read from the terminal, or from a pipe; help lists them. See docs/debug.md");
  verb->callback([a, &exit_code] { exit_code = debug_in_terminal(*a); });
}

}  // namespace tools
