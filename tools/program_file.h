// SPDX-License-Identifier: MIT
// A program of the chip, read from a file.
#pragma once
#include <string>

#include "dspic30/load/firmware_file.h"

namespace tools {

/// The bytes of a file. False when it cannot be read, a folder included.
bool read_file(const std::string& name, std::string& bytes);
/// A .hex or .elf file. False: `error` is a line for the user.
bool read_program(const std::string& name, dspic::FirmwareFile& file, std::string& error);

}  // namespace tools
