// SPDX-License-Identifier: MIT
// A board with the library's busy drivers on it.
#pragma once
#include "hal_sim/board/board.h"
#include "hal_sim/drivers/drivers.h"

class DrivenBoard : public board::Board {
 public:
  explicit DrivenBoard(const board::Setup& setup) : Board(setup) {}

  drivers::Drivers& drivers() { return drivers_; }
  drivers::AgendaTimer& agendas() { return drivers_.agendas(); }
  drivers::AdcScan& scan() { return drivers_.scan(); }

 private:
  drivers::Drivers drivers_{*this};
};
