// SPDX-License-Identifier: MIT
// Writes a program into a robot's flash, through its bootloader and a serial line
// (hal_dspic/bootloader has the protocol).
//
//   FirmwareFile --plan_upload--> UploadPlan: rows --upload(line)--> Upload: what the robot holds now
//
// Order, so that a robot whose upload is cut off never starts half a program: first the way into the old
// program goes (the bootloader then begins again and again), then come the rows, then each is read back; the
// way into the new program comes last.
#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "dspic30/load/firmware_file.h"

namespace flash {

constexpr std::uint32_t kBootloaderRow = 0x17F00;    ///< its last four words lead into the program
constexpr std::uint32_t kBootloaderUser = 0x17F38;   ///< the first of them
constexpr std::uint32_t kBootloaderEntry = 0x17F40;  ///< from here to the end of flash: the bootloader

/// A row of flash: what is erased and written at once.
using FlashRow = std::array<std::uint32_t, 32>;

struct UploadPlan {
  std::map<std::uint32_t, FlashRow> rows;  ///< by address; the bootloader's row has no way in yet
  std::array<std::uint32_t, 4> way_in{};   ///< words for kBootloaderUser
  std::vector<std::string> notes;          ///< what of the file does not go into the robot, a line each
};

/// False: `error` says why the program cannot be written by a bootloader. `name` is the file's, for it.
bool plan_upload(const dspic::FirmwareFile& file, const std::string& name, UploadPlan& plan,
                 std::string& error);

/// The line to the robot. Seconds are the line's own: the wall's for a device, virtual ones in a test.
class SerialLine {
 public:
  virtual ~SerialLine() = default;
  /// False: the line is gone.
  virtual bool write(const std::vector<std::uint8_t>& bytes) = 0;
  /// The next byte; nothing when none came for `seconds`. 0 takes only what is there.
  virtual std::optional<std::uint8_t> read(double seconds) = 0;
  virtual double now_s() const = 0;
};

struct UploadSettings {
  std::string
      reset_text;      ///< sent before each try to begin: what makes the running program reset, such as "R"
  double wait_s = 30;  ///< for the bootloader's first answer
  int tries = 100;     ///< of a row, before the upload is given up
};

struct Upload {
  enum class State {
    Verified,   ///< each row was read back and is right
    Written,    ///< no frame was spoiled; this bootloader cannot read back
    Untouched,  ///< no bootloader answered
    Refused,    ///< the robot has no whole program and knows it: its bootloader waits for the next upload
    Unknown,    ///< the line failed while a way in was being written: the old program, the new one, or none
  };
  State state = State::Untouched;
  int repeated = 0;  ///< frames that were sent again
  std::string why;   ///< Untouched, Refused, Unknown: what was got, what was expected
};

/// Blocks until it is over. `progress` hears how many frames of how many are through, and of which kind.
Upload upload(SerialLine& line, const UploadPlan& plan, const UploadSettings& settings,
              const std::function<void(const char* phase, int done, int total)>& progress);

}  // namespace flash
