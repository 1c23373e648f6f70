// SPDX-License-Identifier: MIT
// twinpuck flash IMAGE --port PORT: a program into a robot's flash.
#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <iostream>

#include "flash/serial_device.h"
#include "tools/command_line.h"
#include "tools/program_file.h"
#include "tools/verbs.h"

namespace tools {

namespace {

namespace fs = std::filesystem;

struct FlashOptions {
  std::string image, port;
  flash::UploadSettings settings;
};

void show_progress(const char* phase, int done, int total) {
  static const bool is_terminal = isatty(STDERR_FILENO) != 0;
  if (!is_terminal) return;
  std::cerr << fmt::format("\r{} {} of {} rows ", phase, done, total) << (done == total ? "\n" : "")
            << std::flush;
}

int tell(const FlashOptions& options, const flash::UploadPlan& plan, const flash::Upload& result,
         double seconds) {
  const std::string rows = fmt::format("{} rows", plan.rows.size());
  const std::string again = fmt::format("in {:.1f} s, {} frames again", seconds, result.repeated);
  switch (result.state) {
    case flash::Upload::State::Verified:
      std::cout << fmt::format("{}: {} written and verified {}; the program runs\n", options.image, rows,
                               again);
      return kPass;
    case flash::Upload::State::Written:
      std::cout << fmt::format(
          "{}: {} written {}; not verified: this bootloader cannot read back, each row's sum was right\n",
          options.image, rows, again);
      return kPass;
    case flash::Upload::State::Untouched:
      complain({fmt::format(
          "{}: {}; press the robot's reset button while this waits, or give --reset TEXT; the robot has "
          "the program that it had",
          options.port, result.why)});
      return kTimeOut;
    case flash::Upload::State::Refused:
      complain({fmt::format(
          "{}: {}; the program is not whole and does not start, the bootloader waits for the next upload",
          options.port, result.why)});
      return kTestFailed;
    case flash::Upload::State::Unknown:
      complain({fmt::format(
          "{}: {}; the robot has its old program, the new one, or waits in its bootloader: upload again",
          options.port, result.why)});
      return kTestFailed;
  }
  return kInternal;
}

int flash(const FlashOptions& options) {
  dspic::FirmwareFile file;
  flash::UploadPlan plan;
  std::string error;
  if (!read_program(options.image, file, error) || !flash::plan_upload(file, options.image, plan, error)) {
    complain({error});
    return kBadInput;
  }
  if (const std::uint32_t at = dspic::place_of_host_call(file); at != dspic::kNoPlace) {
    complain({fmt::format(
        "{}: image: got one linked with hal_sim, which goes on in the simulator at 0x{:06x}, "
        "expected one for the robot; `twinpuck build DIR --hal dspic -o {}` makes it",
        options.image, at, fs::path(options.image).replace_extension(".elf").filename().string())});
    return kBadInput;
  }
  flash::SerialDevice line(options.port);
  if (!line.error().empty()) {
    complain({line.error()});
    return kBadInput;
  }
  for (const std::string& note : plan.notes) std::cerr << "note: " << note << '\n';
  std::cerr << fmt::format("waiting for the bootloader on {}: press the robot's reset button\n",
                           options.port);
  flash::UploadSettings settings = options.settings;
  if (!settings.reset_text.empty()) settings.reset_text += '\r';
  const double begin = line.now_s();
  const flash::Upload result = flash::upload(line, plan, settings, show_progress);
  return tell(options, plan, result, line.now_s() - begin);
}

}  // namespace

void add_flash(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<FlashOptions>();
  CLI::App* verb = app.add_subcommand("flash", "Write a program into a robot through its bootloader");
  verb->add_option("IMAGE", options->image,
                   "the program, .hex or .elf: twinpuck build DIR --hal dspic makes it")
      ->required();
  verb->add_option("--port", options->port,
                   "serial device of the robot: /dev/rfcomm0 (Bluetooth), /dev/ttyUSB0, a pty")
      ->required();
  verb->add_option(
      "--reset", options->settings.reset_text,
      "sent first, with a carriage return: what makes the running program reset, R for SerCom's");
  verb->add_option("--wait", options->settings.wait_s, "s to wait for the bootloader")
      ->check(between(0.1, 3600))
      ->capture_default_str();
  verb->add_option("--tries", options->settings.tries, "of a row, before the upload is given up")
      ->check(between(1, 10000))
      ->capture_default_str();
  verb->callback([options, &exit_code] { exit_code = flash(*options); });
}

}  // namespace tools
