// SPDX-License-Identifier: MIT
// Robots that run programs assembled here, as .hex files.
#pragma once
#include <filesystem>
#include <fstream>

#include "dspic30/asm/assembler.h"
#include "dspic30/load/firmware_file.h"
#include "hal_sim/chip/chip_runner.h"
#include "tests/support/firmware_test.h"
#include "twinpuck_paths.h"

namespace chip_test {

using firmware_test::Robot;

class ChipTest : public firmware_test::FirmwareTest {
 protected:
  ~ChipTest() override {
    for (const auto& file : files_) std::filesystem::remove(file);
  }
  /// The program as a .hex file.
  std::string hex(const std::string& text) {
    const dspic::assembly::Image image = dspic::assembly::assemble(text, "test.s");
    EXPECT_TRUE(image.is_whole()) << image.report();
    dspic::FirmwareFile file;
    file.words = image.program;
    return write(dspic::to_hex(file));
  }
  std::string write(const std::string& bytes) {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    files_.push_back(std::string(TWINPUCK_BUILD_DIR) + "/tests/chip-" + info->name() +
                     std::to_string(files_.size()) + ".hex");
    std::ofstream(files_.back(), std::ios::binary) << bytes;
    return files_.back();
  }
  chip::ChipRunner& runner(int robot = 0) {
    return dynamic_cast<chip::ChipRunner&>(*twin().mind(robot).runner());
  }
  /// The program with its labels as functions, as an ELF file would have them.
  static dspic::FirmwareFile with_labels(const std::string& text) {
    const dspic::assembly::Image image = dspic::assembly::assemble(text, "test.s");
    dspic::FirmwareFile file;
    file.words = image.program;
    for (const auto& [name, address] : image.symbols) {
      const std::string plain = name[0] == '_' ? name.substr(1) : name;
      if (image.program.count(address)) file.code.functions.push_back({address, dspic::kFlashEnd, plain});
      file.functions[plain] = address;
    }
    file.code.sort();
    return file;
  }

 private:
  std::vector<std::string> files_;
};

}  // namespace chip_test
