// SPDX-License-Identifier: MIT
// Files that hold a program of the chip: Intel HEX, and ELF as XC16 writes it. The kind is
// read from the content.
//
//   bytes --load_firmware--> FirmwareFile: words by program address, symbols
//
// HEX: byte address = 2 x program address, four bytes a word, the fourth is not there ("phantom").
// ELF: machine 118 (dsPIC30F), addresses in units of the program counter, sizes in octets, four octets a
// word; sections of data have no bytes of their own, .dinit brings them. Not read: relocatable objects.
// Source: [chip C19].
#pragma once
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>

#include "dspic30/load/code_map.h"
#include "dspic30/load/debug_info.h"
#include "dspic30/load/late.h"

namespace dspic {

struct FirmwareFile {
  std::map<std::uint32_t, std::uint32_t>
      words;  ///< by program address: flash, EEPROM, configuration, unit ID
  std::map<std::string, std::uint32_t> functions;     ///< program addresses, of labels too
  std::map<std::string, std::uint32_t> objects;       ///< data addresses
  std::map<std::string, std::uint32_t> object_bytes;  ///< their sizes, where told
  /// Absolute symbols that begin with "_tp_": what the linker says of the image (memory/host_places.h).
  std::map<std::string, std::uint32_t> marks;
  CodeMap code;
  Late<DebugInfo> debug;
};

/// "sim" or "dspic": which HAL it was linked with here; "own": elsewhere, or the file does not say.
std::string hal_of(const FirmwareFile& file);
/// The table of host functions that an image of hal_sim was linked for, as a sum; 0: none.
std::uint32_t host_table_of(const FirmwareFile& file);
/// The first place at which the program goes on where only the simulator has something (host_places.h), so
/// that no chip can run it; kNoPlace: nowhere.
inline constexpr std::uint32_t kNoPlace = 0xFFFFFFFF;
std::uint32_t place_of_host_call(const FirmwareFile& file);

inline constexpr std::size_t kLongestFirmwareFile = 64u
                                                    << 20;  // bytes [assumed: a hundred times the largest]

/// The number, of LineTable::files, of the source that a function stands in; -1: not known.
int source_of(const FirmwareFile& file, const DebugInfo::Function& function);

enum class FileKind { Hex, Elf, Other };
FileKind kind_of(const std::string& bytes);

/// False: `error` says what is wrong: "NAME: line 12: checksum got 0x3f, expected 0x41". `name` is the
/// file's, for it.
bool load_firmware(const std::string& bytes, const std::string& name, FirmwareFile& file, std::string& error);
/// Gives an image that names no functions those that a reset, vectors and calls lead to: "_reset",
/// "_T1Interrupt", "sub_0003a0". load_firmware() does it for HEX files.
void find_functions(FirmwareFile& file);
/// Of one kind.
bool load_hex(const std::string& bytes, const std::string& name, FirmwareFile& file, std::string& error);
bool load_elf(const std::string& bytes, const std::string& name, FirmwareFile& file, std::string& error);
/// As Intel HEX.
std::string to_hex(const FirmwareFile& file);

/// Is there memory at this program address?
bool is_program_memory(std::uint32_t address);

}  // namespace dspic
