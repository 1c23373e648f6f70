// SPDX-License-Identifier: MIT
// The dsPIC30F6014A of one robot, soldered in: the models of the chip, their pins on the board, resets
// with their causes, data EEPROM, and what the chip has to say about a program. Its runner gives it
// time and instructions.
//
//   runner --registers, interrupts, instants--> SolderedChip: Dspic30f6014a <--> BoardOutside <--> Board
//
// Its clock never goes back: at() moves an instant of the caller's to the latest one seen, since
// whoever looks may ask once more for a cycle that has passed. Modelled: everything dspic30/ models. The
// processor core is the runner's.
#pragma once
#include <functional>
#include <memory>
#include <vector>

#include "dspic30/device/chip_parts.h"
#include "hal_sim/chip/board_outside.h"

namespace chip {

class SolderedChip final : private dspic::DiagnosticSink {
 public:
  /// `board` outlives this. There is no device before power_up().
  explicit SolderedChip(board::Board& board) : board_(board), eeprom_(board.eeprom()), outside_(board) {}

  // --- life
  /// A new device at cycle 0. `configuration`: the program's words; the EEPROM is the board's.
  void power_up(dspic::Configuration configuration);
  /// Chip and board: registers and pins to their reset values, for the cause noted last; without one
  /// for an instruction.
  void reset(Cycle now);
  /// Behind a reset whose instant may lie some cycles beyond the end of the last window: as when it was
  /// powered up, at `now`.
  void begin_again(Cycle now);
  void note_reset(dspic::ResetKind cause) { next_reset_ = cause; }

  // --- time
  Cycle at(Cycle now) {
    if (now > latest_) latest_ = now;
    return latest_;
  }
  Cycle latest() const { return latest_; }
  /// Tick boundary, after Board::exchange(): what came from outside is on its way. True: there was anything.
  bool may_have_news() const { return outside_.may_have_news(); }
  bool begin_window(Cycle now) { return outside_.begin_window(*device_, at(now)); }
  /// Everything that happens by itself up to `now` has happened.
  void end_window(Cycle now);

  EventDigest& digest() { return outside_.digest(); }
  const EventDigest& digest() const { return outside_.digest(); }
  /// See BoardOutside.
  void share_coils() { outside_.share_coils(); }

  // --- the device
  dspic::Dspic30f6014a& device() { return *device_; }
  const dspic::Dspic30f6014a& device() const { return *device_; }
  /// The same, for accesses that must be fast.
  dspic::ChipParts& parts() { return *parts_; }
  /// Whoever draws registers over time, now and after every power-up. Null: nobody.
  void watch(dspic::EventWatch* watch);

  /// Whoever may add to the sentence of a diagnosis when it comes up: where the program is then.
  void comment_on(std::function<std::string(const dspic::Diagnosis&)> comment) {
    comment_ = std::move(comment);
  }
  /// What the models have to say about the program so far, in order of time.
  std::vector<board::Diagnosis> diagnoses() const;

 private:
  void report(const dspic::Diagnosis& diagnosis) override {
    diagnoses_.push_back(diagnosis);
    if (comment_) diagnoses_.back().message += comment_(diagnosis);
  }
  std::int64_t count_of(const dspic::Diagnosis& diagnosis) const;

  /// The board's EEPROM as the chip sees it.
  class BoardEeprom final : public dspic::EepromMemory {
   public:
    explicit BoardEeprom(board::DataEeprom& words) : words_(words) {}
    std::uint16_t read(int word) const override {
      return words_.read(board::DataEeprom::kFirst + 2 * static_cast<unsigned>(word));
    }
    dspic::Eeprom& words() override { return words_.words(); }

   private:
    board::DataEeprom& words_;
  };

  board::Board& board_;
  Cycle latest_ = 0;
  std::unique_ptr<dspic::Dspic30f6014a> device_;
  dspic::ChipParts* parts_ = nullptr;  // of device_
  BoardEeprom eeprom_;
  BoardOutside outside_;
  dspic::EventWatch* watch_ = nullptr;
  dspic::ResetKind next_reset_ = dspic::ResetKind::PowerOn;
  std::vector<dspic::Diagnosis> diagnoses_;
  std::function<std::string(const dspic::Diagnosis&)> comment_;
};

}  // namespace chip
