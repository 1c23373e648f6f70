// SPDX-License-Identifier: MIT
// Data and code of a program on the chip, and its registers, for whoever looks from outside.
#pragma once
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "dspic30/core/processor.h"
#include "dspic30/load/firmware_file.h"
#include "hal_sim/api/host_library.h"
#include "hal_sim/chip/program_places.h"
#include "hal_sim/chip/soldered_chip.h"
#include "hal_sim/host/chip_view.h"
#include "hal_sim/host/program_data.h"

namespace chip {

class ChipData final : public host::ProgramData {
 public:
  /// What it looks at; outlives it.
  struct Parts {
    const dspic::FirmwareFile& file;
    const dspic::ProgramMemory& program;
    SolderedChip& chip;
    dspic::Processor& processor;
    const ProgramPlaces& places;
    api::HostLibrary* library;  ///< null: all drivers are the image's own
    unsigned plain_from;        ///< RAM below is the library's, which hal_sim serves
  };
  /// `written` hears of each byte, `done` of the end of a change.
  ChipData(const Parts& parts, std::function<void(unsigned address, unsigned char byte)> written,
           std::function<void()> done)
      : p_(parts), written_(std::move(written)), done_(std::move(done)) {}

  const host::Variable* find_variable(const std::string& expression, std::string& error) const override;
  std::vector<char> read_variable(const std::string& name, std::size_t bytes) const override;
  void read_memory(std::uintptr_t address, void* to, std::size_t bytes) const override;
  void write_memory(std::uintptr_t address, const void* from, std::size_t bytes) override;
  host::Place place_of(std::uintptr_t code) const override;
  /// The program's own line: of the call, where a function of the library runs.
  host::Place place_now() const override;

 private:
  bool is_served(unsigned address) const;

  const Parts p_;
  const std::function<void(unsigned, unsigned char)> written_;
  const std::function<void()> done_;
  mutable std::map<std::string, host::Variable> variables_;  // that were asked for
};

/// Of a device that outlives it.
std::unique_ptr<host::ChipView> view_of(dspic::Dspic30f6014a& device);

}  // namespace chip
