// SPDX-License-Identifier: MIT
#include "tools/program_file.h"

#include <filesystem>
#include <fstream>
#include <iterator>

namespace tools {

bool read_file(const std::string& name, std::string& bytes) {
  std::ifstream in(name, std::ios::binary);
  if (!in || std::filesystem::is_directory(name)) return false;
  bytes.assign(std::istreambuf_iterator<char>(in), {});
  return true;
}

bool read_program(const std::string& name, dspic::FirmwareFile& file, std::string& error) {
  std::string bytes;
  if (read_file(name, bytes)) return dspic::load_firmware(bytes, name, file, error);
  error = name + ": cannot be read, expected a .hex or .elf file";
  return false;
}

}  // namespace tools
