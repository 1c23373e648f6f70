// SPDX-License-Identifier: MIT
// A board with the library's drivers on it, as a robot of the native way has.
#pragma once
#include "hal_sim/board/board.h"
#include "hal_sim/drivers/drivers.h"

class DrivenBoard : public board::Board {
 public:
  explicit DrivenBoard(const board::Setup& setup) : Board(setup) {}

  drivers::Drivers& drivers() { return drivers_; }
  drivers::AgendaTimer& agendas() { return drivers_.agendas(); }
  drivers::TimerMotors& timer_motors() { return drivers_.timer_motors(); }
  drivers::AdcScan& scan() { return drivers_.scan(); }
  drivers::UartRing& uart_ring(int number) { return drivers_.uart_ring(number); }
  drivers::BasicProx& basic_prox() { return drivers_.basic_prox(); }
  drivers::I2cMaster& i2c_master() { return drivers_.i2c_master(); }

 private:
  drivers::Drivers drivers_{*this};
};
