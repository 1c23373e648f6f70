// SPDX-License-Identifier: MIT
#include "tools/program_file.h"

#include "hal_sim/chip/library_sources.h"
#include "sim_core/base/input_file.h"

namespace tools {

bool read_file(const std::string& name, std::string& bytes) {
  return sim::read_input_file(name, dspic::kLongestFirmwareFile, bytes).empty();
}

bool read_program(const std::string& name, dspic::FirmwareFile& file, std::string& error) {
  file = chip::firmware_file();
  std::string bytes;
  if (read_file(name, bytes)) return dspic::load_firmware(bytes, name, file, error);
  error = name + ": cannot be read, expected a .hex or .elf file";
  return false;
}

}  // namespace tools
