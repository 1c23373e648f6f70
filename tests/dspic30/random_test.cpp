// SPDX-License-Identifier: MIT
// Programs that make no sense: whatever is written to the registers in whatever order, the chip goes on, its
// promises about the future hold, and looking at it changes nothing.
#include "dspic30/memory/sfr_table.h"
#include "tests/dspic30/bench.h"

namespace {

using bench::Bench;
using bench::Cycle;
using bench::Draw;
using dspic::Port;

// `peeks`: look at everything after every so many steps
std::uint64_t wander(std::uint32_t seed, int peeks) {
  Draw draw{seed};
  Bench b;
  b.outside.reply = {true, 0x3C, 0};
  b.outside.clock({Port::C, 3}, 100, 700, 300, 200);
  b.outside.clock({Port::C, 14}, 50, 911, 500, 200);
  b.outside.clock({Port::F, 6}, 77, 1303, 600, 200);
  b.outside.clock({Port::D, 8}, 77, 503, 100, 200);
  b.chip.outside_changed(0);
  const auto registers = static_cast<unsigned>(std::end(dspic::kSfrRows) - std::begin(dspic::kSfrRows));
  Cycle now = 0;
  for (int step = 0; step < 3000; ++step) {
    now += draw(100) ? draw(80) : draw(20000);
    const unsigned address = std::begin(dspic::kSfrRows)[draw(registers)].address;
    const unsigned value = draw(4) ? draw(0x10000) : 1u << draw(16);
    switch (draw(6)) {
      case 0:
        b.chip.read(address, 16, now);
        break;
      case 1:
        b.chip.write(address + draw(2), static_cast<std::uint16_t>(value), 8, now);
        break;
      case 2:
        if (const int v = b.chip.interrupts().pending(now); v >= 0) {
          now = b.chip.interrupts().enter(v, now).first_instruction;
          if (v >= dspic::kFirstIrqVector) b.clear_flag(v - dspic::kFirstIrqVector, now);
        } else if (b.chip.interrupts().nesting() > 0) {
          now = b.chip.interrupts().leave(now);
        }
        break;
      case 3: {
        dspic::UartFrame f;
        f.word = static_cast<std::uint16_t>(value & 0xFF);
        f.start = now + draw(500);
        b.chip.uart_receive(1 + static_cast<int>(draw(2)), f, f.start);
        break;
      }
      default:
        b.chip.write(address, static_cast<std::uint16_t>(value), 16, now);
        break;
    }
    if (peeks && step % peeks == 0)
      for (const dspic::SfrInfo* r = std::begin(dspic::kSfrRows); r != std::end(dspic::kSfrRows); ++r)
        b.chip.peek(r->address, now);
    EXPECT_GT(b.chip.next_event(now), now);
  }
  return b.chip.state_hash(now);
}

TEST(Random, chip_survives_and_looking_changes_nothing) {
  for (std::uint32_t seed = 1; seed <= 20; ++seed)
    EXPECT_EQ(wander(seed, 0), wander(seed, 37)) << "seed " << seed;
}

// a register that promises not to change before its horizon does not
TEST(Random, horizons_are_kept) {
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    Draw draw{seed};
    Bench b;
    b.outside.clock({Port::C, 3}, 100, 700, 300, 500);
    b.outside.clock({Port::C, 14}, 50, 911, 500, 500);
    b.outside.clock({Port::D, 8}, 77, 503, 100, 500);
    b.chip.outside_changed(0);
    const auto registers = static_cast<unsigned>(std::end(dspic::kSfrRows) - std::begin(dspic::kSfrRows));
    Cycle now = 0;
    for (int step = 0; step < 300; ++step) {
      now += draw(60);
      b.chip.write(std::begin(dspic::kSfrRows)[draw(registers)].address,
                   static_cast<std::uint16_t>(draw(0x10000)), 16, now);
      if (b.chip.stalled_until() > now || step % 10) continue;
      now += 3;
      const unsigned address = std::begin(dspic::kSfrRows)[draw(registers)].address;
      const std::uint16_t before = b.chip.peek(address, now);
      const Cycle until = std::min(b.chip.horizon(address, now), now + 3000);
      for (Cycle t = now + 1; t < until; ++t)
        ASSERT_EQ(b.chip.peek(address, t), before) << b.chip.register_name(address) << " seed " << seed
                                                   << " from " << now << " until " << until << " at " << t;
      now = until;
    }
  }
}

// between now and next_event() nothing becomes pending
TEST(Random, next_event_is_never_late) {
  for (std::uint32_t seed = 1; seed <= 40; ++seed) {
    Draw draw{seed};
    Bench b;
    b.outside.clock({Port::C, 3}, 100, 700, 300, 500);
    b.outside.clock({Port::F, 6}, 50, 911, 500, 500);
    b.outside.clock({Port::D, 8}, 77, 503, 100, 500);
    b.chip.outside_changed(0);
    b.write("IEC0", 0xFFFF, 0);
    b.write("IEC1", 0xFFFF, 0);
    b.write("IEC2", 0xFFFF, 0);
    const auto registers = static_cast<unsigned>(std::end(dspic::kSfrRows) - std::begin(dspic::kSfrRows));
    Cycle now = 0;
    for (int step = 0; step < 200; ++step) {
      now += draw(40);
      const unsigned address = std::begin(dspic::kSfrRows)[draw(registers)].address;
      if (address >= 0x84 && address < 0x94) continue;  // flags and enables
      b.chip.write(address, static_cast<std::uint16_t>(draw(0x10000)), 16, now);
      const int before = b.chip.interrupts().pending(now);
      const Cycle next = std::min(b.chip.next_event(now), now + 2000);
      for (Cycle t = now + 1; t < next; ++t)
        ASSERT_EQ(b.chip.interrupts().pending(t), before) << "seed " << seed << " at " << t;
      now = next;
      b.write("IFS0", 0, now);
      b.write("IFS1", 0, now);
      b.write("IFS2", 0, now);
    }
  }
}

}  // namespace
