// SPDX-License-Identifier: MIT
// twinpuck debug: the debugger as a monitor on the terminal or as a DAP server for editors.
#include <unistd.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <iostream>
#include <sstream>
#include <utility>

#include "hal_sim/debug/dap.h"
#include "hal_sim/debug/monitor.h"
#include "outputs/serial_text.h"
#include "outputs/summary.h"
#include "sim_core/base/input_file.h"
#include "tools/command_line.h"
#include "tools/printable.h"
#include "tools/run_guard.h"
#include "tools/verbs.h"

namespace tools {

namespace {

namespace fs = std::filesystem;

constexpr double kMostSeconds = 1e7;
constexpr std::size_t kLongestLine = 64u << 10, kLongestFile = 1u << 20;  // bytes of commands

struct DebugArguments {
  std::string world, robot, commands, hal, optimisation;
  std::vector<std::string> firmware;
  double seconds = 1e6;
  std::optional<std::uint64_t> seed;
  bool dap = false;
};

constexpr const char* kUsualHal = "sim";
const std::vector<std::string> kHals{"sim", "dspic"}, kLevels{"-O0", "-O1", "-O2", "-Os"};

bool is_one_of(const std::string& word, const std::vector<std::string>& words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

// --- Ctrl-C at a terminal

volatile std::sig_atomic_t pause_asked = 0;
volatile long long asked_ms = 0;  // when, or 0

/// The first pauses what runs. A second one that finds it without effect, or comes within a second, ends.
void on_interrupt(int) {
  const long long now_ms = steady_ms();
  if (pause_asked || (asked_ms != 0 && now_ms - asked_ms < 1000)) ask_for_end();
  pause_asked = 1;
  asked_ms = now_ms;
}

/// What a world and its robots are, of the command line.
bool set_up(const DebugArguments& a, debug::Session::Setup& setup, std::vector<std::string>& problems) {
  if (!split_choices(a.firmware, "--fw", setup.options.firmware)) return false;
  std::optional<sim::WorldDesc> world = open_world(a.world, problems);
  if (!world) return false;
  if (a.seed) world->seed = *a.seed;
  setup.world = std::move(*world);
  setup.options.world_folder = fs::path(setup.world.file).parent_path().string();
  setup.options.hal = a.hal.empty() ? kUsualHal : a.hal;
  setup.options.optimisation = a.optimisation;
  setup.robot = a.robot;
  setup.seconds = a.seconds;
  return true;
}

/// Robots' text goes to `say`.
std::shared_ptr<outputs::SerialText> listen(debug::Session::Setup& setup,
                                            const std::function<void(const std::string&)>& say) {
  auto serial = std::make_shared<outputs::SerialText>(say);
  setup.opened = [=](twin::Twin& twin) {
    *serial = outputs::SerialText(say);
    for (int i = 0; i < twin.robots(); ++i)
      for (int port = 1; port <= 2; ++port)
        if (twin.uart_choice(i, port) == "-") serial->listen(twin, i, port);
  };
  setup.ticked = [=] { serial->show(); };
  setup.repeated = [=] { serial->forget(); };
  return serial;
}

/// A session as an editor's launch.json asks for it.
std::unique_ptr<debug::Session> launched(const nlohmann::json& launch,
                                         const std::function<void(const std::string&)>& output,
                                         std::vector<std::string>& problems) {
  DebugArguments a;
  a.world = launch.value("world", "maze");
  a.robot = launch.value("robot", "");
  if (launch.contains("way")) {
    problems.push_back("launch: way: expected hal, \"sim\" or \"dspic\"; native is hal sim now");
    return nullptr;
  }
  a.optimisation = launch.value("opt", a.optimisation);
  a.hal = launch.value("hal", a.hal);
  for (const auto& [key, value, known] :
       {std::tuple("hal", &a.hal, &kHals), std::tuple("opt", &a.optimisation, &kLevels)})
    if (!value->empty() && !is_one_of(*value, *known)) {
      problems.push_back(
          fmt::format("launch: {}: got '{}', expected {}", key, *value, fmt::join(*known, ", ")));
      return nullptr;
    }
  const auto seed = launch.find("seed"), seconds = launch.find("seconds");
  if (seed != launch.end() && !(seed->is_number_unsigned()))
    problems.push_back(fmt::format("launch: seed: got {}, expected 0 to {}", seed->dump(), kMostSeed));
  if (seconds != launch.end() && !(seconds->is_number() && *seconds >= 0 && *seconds <= kMostSeconds))
    problems.push_back(
        fmt::format("launch: seconds: got {}, expected 0 to {:g} s", seconds->dump(), kMostSeconds));
  if (!problems.empty()) return nullptr;
  a.seconds = launch.value("seconds", a.seconds);
  if (seed != launch.end()) a.seed = seed->get<std::uint64_t>();
  if (const std::string firmware = launch.value("firmware", ""); !firmware.empty())
    a.firmware.push_back(firmware);
  debug::Session::Setup setup;
  listen(setup, output);
  return set_up(a, setup, problems) ? debug::Session::open(std::move(setup), problems) : nullptr;
}

/// The next line of commands. False: there is none, or what comes is none, which `problems` says.
bool read_line(std::istream& in, std::string& line, std::vector<std::string>& problems) {
  line.resize(kLongestLine + 1);
  in.getline(line.data(), static_cast<std::streamsize>(line.size()));
  if (in.bad() || in.gcount() == 0) return false;
  if (in.fail())
    problems.push_back(
        fmt::format("commands: got a line of more than {} bytes, expected at most that", kLongestLine));
  line.resize(static_cast<std::size_t>(in.gcount()) - (in.eof() ? 0 : 1));
  return problems.empty();
}

/// Carries out commands until they end, or somebody wants an end.
int obey(debug::Session& session, std::istream& in, bool is_person) {
  if (is_person) std::signal(SIGINT, on_interrupt);
  debug::Monitor monitor(
      session, [] { return end_asked() != 0 || is_stdout_lost() || std::exchange(pause_asked, 0) != 0; });
  std::cout << outputs::programs_text(session.twin()) << session.robot() << ": " << monitor.where();
  if (is_person) std::cout << "help lists the commands\n";
  std::vector<std::string> problems;
  for (std::string line; !monitor.wants_end() && end_asked() == 0 && !is_stdout_lost();) {
    if (is_person) std::cout << "(twinpuck) " << std::flush;
    if (!read_line(in, line, problems)) break;
    if (!is_person) std::cout << "> " << line << std::endl;  // before what may take long
    pause_asked = 0;                                         // what was typed before is no wish to pause this
    const GracefulEnd guard([] {});
    std::cout << monitor.execute(line) << std::flush;
  }
  complain(problems);
  if (end_asked() != 0) return end_asked();
  if (!problems.empty()) return kBadInput;
  if (monitor.wants_end() || !is_stdout_lost()) return kPass;
  complain({"standard output: cannot be written any more; debugging ended"});
  return kInvalidRun;
}

int debug_in_terminal(const DebugArguments& a) {
  std::vector<std::string> problems;
  std::string commands;
  if (!a.commands.empty()) {
    const std::string wrong = sim::read_input_file(a.commands, kLongestFile, commands);
    if (!wrong.empty()) problems.push_back(a.commands + ": -x: " + wrong);
  }
  debug::Session::Setup setup;
  listen(setup, [](const std::string& line) { std::cout << line << '\n'; });
  if (!problems.empty() || !set_up(a, setup, problems)) {
    complain(problems);
    return kBadInput;
  }
  const auto session = debug::Session::open(std::move(setup), problems);
  complain(problems);
  if (!session) return kBadInput;
  std::istringstream file(commands);
  return a.commands.empty() ? obey(*session, std::cin, isatty(0) != 0) : obey(*session, file, false);
}

}  // namespace

void add_debug(CLI::App& app, int& exit_code) {
  auto* verb = app.add_subcommand("debug", "Debug a robot's program: breakpoints, steps forwards and back");
  auto a = std::make_shared<DebugArguments>();
  auto* world = verb->add_option("WORLD", a->world, "world file, or the name of one in worlds/");
  one_each(verb->add_option("--fw", a->firmware,
                            "[ROBOT=]FILE: an .elf or .hex, a folder of C files, or a controller's name"));
  add_hal(*verb, a->hal);
  verb->add_option("-x,--commands", a->commands, "file of commands, instead of the terminal");
  verb->add_option("--robot", a->robot, "the robot to look at; else the first");
  verb->add_option("--for", a->seconds, "simulated seconds after which the world ends")
      ->check(between(0, kMostSeconds));
  verb->add_option("--seed", a->seed, "the world's seed, 0 or more, instead of the file's")
      ->check(seed_range());
  verb->footer("Commands are read from the terminal, or from a pipe; help lists them. See docs/looking.md");
  verb->add_flag("--dap", a->dap, "speak the Debug Adapter Protocol with an editor, which says what to run");
  verb->add_option("--opt", a->optimisation,
                   "level for a program that is built, as run --opt; at -O0 every variable keeps its place")
      ->check(CLI::IsMember(kLevels));
  verb->callback([a, world, &exit_code] {
    if (a->dap) {
      std::signal(SIGPIPE, SIG_IGN);
      exit_code = debug::DapLine(0, 1).serve(launched) ? kPass : kBadInput;
      return;
    }
    if (world->count() == 0) throw CLI::RequiredError("WORLD or --dap");
    exit_code = debug_in_terminal(*a);
  });
}

}  // namespace tools
