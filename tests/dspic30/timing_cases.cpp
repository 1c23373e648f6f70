// SPDX-License-Identifier: MIT
#include "tests/dspic30/timing_cases.h"

#include "tests/dspic30/bench.h"

namespace timing {

namespace {

using bench::Bench;
using dspic::Cycle;
using dspic::UartFrame;
namespace irq = dspic::irq;

// distance of the first two flags of a source that repeats; the flag is cleared in between
Cycle period(Bench& b, int flag) {
  const Cycle first = b.flag_rises(flag, 1);
  b.clear_flag(flag, first + 1);
  return b.flag_rises(flag, first + 2) - first;
}

Cycle timer_period(int timer, unsigned pr, unsigned code) {
  const int flags[] = {irq::T1, irq::T2, irq::T3, irq::T4, irq::T5};
  Bench b;
  const std::string n = std::to_string(timer);
  b.write("PR" + n, pr, 0);
  b.write("T" + n + "CON", 0x8000 | code << 4, 0);
  return period(b, flags[timer - 1]);
}

Cycle wide_period(unsigned low, unsigned high) {
  Bench b;
  b.write("PR2", low, 0);
  b.write("PR3", high, 0);
  b.write("T2CON", 0x8008, 0);
  return period(b, irq::T3);
}

Cycle flag_after_match(unsigned code) {
  Bench b;
  b.write("PR1", 2, 0);
  b.write("T1CON", 0x8000 | code << 4, 0);
  const Cycle ratio[] = {1, 8, 64, 256};
  return b.flag_rises(irq::T1, 1) - (1 + 2 * ratio[code]);
}

Cycle scan_period(unsigned inputs, unsigned adcs, unsigned channels, unsigned samc) {
  Bench b;
  b.write("ADCON2", 0x0400 | (channels - 1) << 2, 0);
  b.write("ADCON3", samc << 8 | adcs, 0);
  b.write("ADCSSL", inputs, 0);
  b.write("ADCON1", 0x80E4, 0);
  return period(b, irq::Adc);
}

Cycle end_to_adif() {
  Bench b;
  b.write("ADCON3", 0x0127, 0);
  b.write("ADCON1", 0x80E2, 0);
  return b.flag_rises(irq::Adc, 1) - (1 + 300);
}

UartFrame frame_sent(unsigned brg, unsigned mode) {
  Bench b;
  b.write("U1BRG", brg, 0);
  b.write("U1MODE", mode, 0);
  b.write("U1STA", 0x0400, 0);
  b.write("U1TXREG", 0x55, 10);
  b.chip.run_to(100000);
  return b.outside.sent.at(0);
}

Cycle rxif_after_start() {
  Bench b;
  b.write("U1BRG", 7, 0);
  b.write("U1MODE", 0x8000, 0);
  UartFrame f;
  f.start = 1001;
  b.chip.uart_receive(1, f, f.start);
  return b.flag_rises(irq::U1Rx, 1) - f.start;
}

// each I2C operation in turn; its length
Cycle i2c(unsigned control, bool byte = false) {
  Bench b;
  b.write("I2CBRG", 150, 0);
  b.write("I2CCON", 0x9000, 0);
  if (byte)
    b.write("I2CTRN", 0xA0, 100);
  else
    b.set("I2CCON", control, 100);
  return b.flag_rises(irq::MasterI2c, 101) - 100;
}

Cycle dci_period(unsigned con2, unsigned slots) {
  Bench b;
  b.write("DCICON2", con2, 0);
  b.write("DCICON3", 3, 0);
  b.write("TSCON", slots, 0);
  b.write("DCICON1", 0x8020, 0);
  return period(b, irq::Dci);
}

Cycle spi_byte() {
  Bench b;
  b.write("SPI1CON", 0x0020 | 6 << 2 | 3, 0);
  b.write("SPI1STAT", 0x8000, 0);
  b.write("SPI1BUF", 1, 100);
  return b.flag_rises(irq::Spi1, 101) - 101;
}

Cycle entry() {
  Bench b;
  b.enable(irq::T1, 0);
  b.write("PR1", 99, 0);
  b.write("T1CON", 0x8000, 0);
  const Cycle flag = b.flag_rises(irq::T1, 1);
  Cycle boundary = flag;
  while (b.chip.interrupts().pending(boundary) < 0) ++boundary;
  return b.chip.interrupts().enter(dspic::kFirstIrqVector + irq::T1, boundary).first_instruction - flag;
}

Cycle leave() {
  Bench b;
  b.chip.interrupts().enter(dspic::kFirstIrqVector + irq::T1, 10);
  return b.chip.interrupts().leave(50) - 50;
}

Cycle disi(unsigned count) {
  Bench b;
  b.chip.interrupts().disi(count, 100);
  Cycle now = 100;
  while (b.chip.interrupts().disi_active(now)) ++now;
  return now - 100;
}

Cycle watchdog(unsigned fwdt) {
  dspic::Configuration c;
  c.fwdt = static_cast<std::uint16_t>(fwdt);
  return Bench(c).chip.next_event(0);
}

Cycle nvm() {
  Bench b;
  b.write("NVMCON", 0x4004, 10);
  b.write("NVMKEY", 0x55, 11);
  b.write("NVMKEY", 0xAA, 12);
  b.set("NVMCON", 0x8000, 13);
  return b.flag_rises(irq::Nvm, 14) - 13;
}

std::vector<Case> list() {
  std::vector<Case> all;
  const auto add = [&](const char* part, std::string what, Cycle document, std::string formula,
                       std::string doubt, std::function<Cycle()> measure) {
    all.push_back(
        {part, std::move(what), document, std::move(formula), std::move(doubt), std::move(measure)});
  };
  const Cycle ratio[] = {1, 8, 64, 256};
  const char* timers = "Timers";
  for (int timer = 1; timer <= 5; ++timer)
    for (unsigned code = 0; code < 4; ++code)
      add(timers,
          "period of T" + std::to_string(timer) + ", PR 1474, prescaler 1:" + std::to_string(ratio[code]),
          1475 * ratio[code], "(PR + 1) x prescaler", "", [=] { return timer_period(timer, 1474, code); });
  add(timers, "period of T1 in the basic proximity driver, PR 645, 1:8", 646 * 8, "(PR + 1) x prescaler", "",
      [] { return timer_period(1, 645, 1); });
  add(timers, "period of T2 with T3, PR3:PR2 = 2:5", 0x20006, "({PR3, PR2} + 1) x prescaler", "",
      [] { return wide_period(5, 2); });
  add(timers, "TMR = PR to TxIF, 1:1", 1, "one cycle: the flag comes as TMR returns to 0", "",
      [] { return flag_after_match(0); });
  add(timers, "TMR = PR to TxIF, 1:8", 1, "one cycle",
      "with a prescaler the flag may come on the resetting tick instead, up to one prescale period later",
      [] { return flag_after_match(1); });

  const char* adc = "Converter";
  const struct {
    const char* what;
    unsigned inputs, adcs, channels;
    Cycle cycles;
  } scans[] = {{"scan of 2 inputs, ADCS 59", 0x0003, 59, 2, 2 * 15 * 30},
               {"scan of 3 inputs, ADCS 39 (microphones, all-ADC mode)", 0x001C, 39, 3, 3 * 15 * 20},
               {"scan of 5 inputs, ADCS 23 (with a pair of proximity sensors)", 0x111C, 23, 5, 5 * 15 * 12},
               {"scan of 6 inputs, ADCS 19 (with the accelerometer)", 0x00FC, 19, 6, 6 * 15 * 10},
               {"scan of 3 inputs, ADCS 19 (microphones only)", 0x001C, 19, 3, 3 * 15 * 10}};
  for (const auto& s : scans)
    add(adc, s.what, s.cycles, "N x (SAMC + 14) TAD, TAD = (ADCS + 1) / 2", "",
        [s] { return scan_period(s.inputs, s.adcs, s.channels, 1); });
  add(adc, "one input, SAMC 31, ADCS 63", (31 + 14) * 32, "(SAMC + 14) TAD", "",
      [] { return scan_period(1, 63, 1, 31); });
  add(adc, "end of the conversion to ADIF", 1, "not given", "taken as one cycle",
      [] { return end_to_adif(); });

  const char* uart = "UART";
  for (const unsigned brg : {0u, 1u, 3u, 7u, 95u})
    add(uart, "bit, BRG " + std::to_string(brg), 16 * (brg + 1), "16 x (BRG + 1)", "",
        [=] { return frame_sent(brg, 0x8000).bit; });
  const std::pair<const char*, unsigned> formats[] = {{"character 8N1, BRG 7", 10},
                                                      {"character 8E1, BRG 7", 11},
                                                      {"character 9N1, BRG 7", 11},
                                                      {"character 8N2, BRG 7", 11}};
  const unsigned modes[] = {0x8000, 0x8002, 0x8006, 0x8001};
  for (int i = 0; i < 4; ++i)
    add(uart, formats[i].first, formats[i].second * 128, "bits x bit time", "", [mode = modes[i]] {
      const UartFrame f = frame_sent(7, mode);
      return f.end() - f.start;
    });
  add(uart, "start edge to RXIF, 8N1, BRG 7", 9 * 128 + 64, "middle of the stop bit: 9.5 bits", "",
      [] { return rxif_after_start(); });

  const char* bus = "I2C, BRG 150 (SCL period 151 + 13 = 164)";
  const std::string rough =
      "lengths of start, restart and stop, and the fixed 0.9 us of the period, are approximations";
  add(bus, "start", 164, "2 half periods", rough, [] { return i2c(0x01); });
  add(bus, "restart", 328, "4 half periods", rough, [] { return i2c(0x02); });
  add(bus, "stop", 246, "3 half periods", rough, [] { return i2c(0x04); });
  add(bus, "byte sent, with its acknowledge", 9 * 164, "9 SCL periods", "fixed part of the period",
      [] { return i2c(0, true); });
  add(bus, "byte received", 8 * 164, "8 SCL periods", "fixed part of the period", [] { return i2c(0x08); });
  add(bus, "acknowledge", 164, "1 SCL period", "fixed part of the period", [] { return i2c(0x10); });

  const char* serial = "DCI and SPI";
  add(serial, "codec interrupt: BCG 3, WS 15, COFSG 15, BLEN 3, slot 0", 8192,
      "4 frames of 16 x 16 bits of 8 cycles", "", [] { return dci_period(3 << 10 | 15 << 5 | 15, 1); });
  add(serial, "codec set-up: BCG 3, WS 15, COFSG 7, BLEN 1, slot 0", 2048,
      "2 frames of 8 x 16 bits of 8 cycles", "", [] { return dci_period(1 << 10 | 7 << 5 | 15, 1); });
  add(serial, "SPI byte at FCY / 2", 16, "8 bits", "", [] { return spi_byte(); });

  const char* core = "Interrupts";
  add(core, "flag to the handler's first instruction", 4,
      "4 cycles, of one- and two-cycle instructions alike",
      "after a two-cycle instruction that began with the flag one more is charged", [] { return entry(); });
  add(core, "RETFIE", 3, "3 cycles (2 when another interrupt waits)", "always 3 here",
      [] { return leave(); });
  add(core, "DISI #10000", 10001, "count + 1", "", [] { return disi(10000); });

  const char* system = "Watchdog and EEPROM (FCY 14,745,600 Hz)";
  add(system, "shortest time-out, A 1:1, B 1:1", 29491, "2 ms",
      "LPRC taken as 512 kHz; the part is given +-25 % and more", [] { return watchdog(0x8000); });
  add(system, "A 1:8, B 1:3", 707789, "2 ms x A x B = 48 ms", "as above", [] { return watchdog(0x8012); });
  add(system, "longest time-out, A 1:512, B 1:16", 241591910, "16.384 s", "as above",
      [] { return watchdog(0x803F); });
  add(system, "EEPROM word, erase or write", 29491, "2 ms", "0.8 to 2.6 ms", [] { return nvm(); });
  return all;
}

}  // namespace

const std::vector<Case>& cases() {
  static const std::vector<Case> all = list();
  return all;
}

std::string document() {
  std::string text =
      "# Timing of the chip's models\n\n"
      "Instruction cycles (67.8 ns on the e-puck), measured on the models of `dspic30/` and held against "
      "numbers worked\n"
      "out by hand from our notes on the chip. The notes restate the data sheet DS70143 and the family "
      "manual DS70046,\n"
      "which were not read again for this page; nothing here has been measured on a chip. Rows without a "
      "doubt are\n"
      "those that the notes give without one. `make chip-tables` writes this file; `dspic30_test` compares "
      "every "
      "row.\n";
  std::string part;
  for (const Case& c : cases()) {
    if (c.part != part) {
      part = c.part;
      text += "\n## " + part + "\n\n| what | notes | model | formula | doubt |\n|---|---|---|---|---|\n";
    }
    text += "| " + c.what + " | " + std::to_string(c.document) + " | " + std::to_string(c.measure()) + " | " +
            c.formula + " | " + c.doubt + " |\n";
  }
  text +=
      "\n## Other doubts\n\n"
      "What the notes leave open and the models had to choose:\n\n"
      "- The first tick comes a whole prescale period after the cycle that follows the write of TON.\n"
      "- TMR = PR made by a write of TMR or PR while the timer runs sets the flag, once.\n"
      "- An edge on TxCK ticks one cycle later, on INTx it sets the flag two cycles later, on ICx it "
      "captures one\n"
      "  later; the chip's synchronisers take one to two.\n"
      "- Between clearing SAMP and the conversion lies one TAD. Sampling begins in the cycle after ADON or "
      "SAMP is\n"
      "  written. With ADRC = 1 a TAD is 1.2 us.\n"
      "- When SMPI + 1 is not the number of scanned inputs, the scan starts again at the interrupt.\n"
      "- The first start bit after an idle line begins at the next sixteenth of a bit of the baud counter.\n"
      "- Setting UTXEN sets TXIF whatever UTXISEL says.\n"
      "- The first frame of the DCI begins one bit clock after DCIEN; ROV clears when an RXBUF is read, TUNF "
      "when a\n"
      "  TXBUF is written.\n"
      "- After RETFIE one instruction of the interrupted program runs before an interrupt of the same "
      "priority.\n"
      "- A flag that hardware sets between the read and the write of one read-modify-write (three cycles) "
      "survives.\n"
      "- Change notification compares with the last read of the port, and tells a pin that has moved.\n"
      "- Trap levels: oscillator 14, address 13, stack 12, arithmetic 11; documents disagree about the "
      "middle two.\n"
      "- OSCCON reads 0x7720 after a reset of an e-puck; RCON.LVDL is 5.\n"
      "- Registers whose power-on value is undefined come up as 0.\n";
  return text;
}

}  // namespace timing
