// SPDX-License-Identifier: MIT
#include "tests/cc/bench.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <sstream>

#include "dspic30/core/processor.h"
#include "dspic30/load/firmware_file.h"
#include "tests/dspic30/bench.h"

namespace cc_test {

namespace fs = std::filesystem;

namespace {

std::string bytes_of(const fs::path& file) {
  std::ostringstream bytes;
  bytes << std::ifstream(file, std::ios::binary).rdbuf();
  return bytes.str();
}

}  // namespace

Folder::Folder() {
  static int count = 0;
  path =
      fs::temp_directory_path() / ("twinpuck-cc-" + std::to_string(getpid()) + "-" + std::to_string(count++));
  fs::create_directories(path / "prog");
}

Folder::~Folder() {
  std::error_code ignored;
  fs::remove_all(path, ignored);
}

fs::path Folder::file(const std::string& name, const std::string& text) const {
  const fs::path file = path / name;
  fs::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary) << text;
  return file;
}

cc::BuildResult build(const Folder& folder, const std::string& main_c, const std::string& level,
                      const Change& change) {
  folder.file("prog/main.c", main_c);
  cc::BuildOptions options;
  options.source_dir = folder.path / "prog";
  options.output = folder.image();
  options.optimisation = level;
  if (change) change(options);
  return cc::build_image(options);
}

cc::BuildResult build_folder(const Folder& folder, const std::string& name) {
  cc::BuildOptions options;
  options.source_dir = folder.path / name;
  options.output = folder.path / "out.elf";
  return cc::build_image(options);
}

std::string said(const Folder& folder) { return output_of(folder.path / "out.elf"); }

std::string output_of(const fs::path& image) {
  dspic::FirmwareFile file;
  std::string error;
  EXPECT_TRUE(dspic::load_firmware(bytes_of(image), image.string(), file, error)) << error;
  dspic::ProgramMemory program;
  for (const auto& [address, word] : file.words) program.write(address, word);
  bench::FakeOutside outside;
  bench::Notes notes;
  dspic::Configuration configuration;
  configuration.program = &program;
  dspic::Dspic30f6014a chip(outside, &notes, configuration);
  dspic::Processor cpu(chip, program);
  constexpr unsigned kFastest = 0, kOn = 0x8000, kTransmits = 0x0400;
  chip.write(bench::Bench::at("U1BRG"), kFastest, 16, 0);
  chip.write(bench::Bench::at("U1MODE"), kOn, 16, 0);
  chip.write(bench::Bench::at("U1STA"), kTransmits, 16, 0);
  constexpr dspic::Cycle kMost = 60'000'000, kFrames = 5'000;
  EXPECT_TRUE(cpu.run(kMost)) << image << " does not end";
  chip.run_to(cpu.now() + kFrames);  // what is in the UART leaves
  std::string text;
  for (const dspic::UartFrame& frame : outside.sent) text += static_cast<char>(frame.word);
  return text;
}

std::string printed_by(const std::string& main_c, const std::string& level) {
  Folder folder;
  const auto built = build(folder, main_c, level);
  EXPECT_TRUE(built.ok) << main_c << "\n" << text_of(built);
  return built.ok ? output_of(folder.image()) : "";
}

std::string text_of(const cc::BuildResult& result) {
  std::string text;
  for (const auto* lines : {&result.errors, &result.conflicts, &result.warnings})
    for (const auto& line : *lines) text += line + "\n";
  return text;
}

}  // namespace cc_test
