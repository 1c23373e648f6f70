// SPDX-License-Identifier: MIT
// The converter with the e-puck library's settings and the modes that others use.
// TAD = (ADCS + 1) / 2 cycles, 14 of them a conversion. ADON written in cycle 9: sampling begins at 10.
#include "tests/dspic30/core_bench.h"

namespace {

using bench::Bench;
using bench::Cycle;
using bench::kNever;
using dspic::Port;
namespace irq = dspic::irq;

/// The library's set-up for `channels` inputs: scan, ASAM, SSRC = 7, SAMC = 1.
void set_up(Bench& b, unsigned inputs, unsigned adcs, unsigned smpi, Cycle on_at) {
  b.write("ADCON1", 0x00E4, 0);
  b.write("ADCON2", 0x0400 | (smpi - 1) << 2, 0);
  b.write("ADCON3", 0x0100 | adcs, 0);
  b.write("ADCSSL", inputs, 0);
  b.set("ADCON1", 0x8000, on_at);
}

struct Scan : ::testing::TestWithParam<std::tuple<unsigned, unsigned, unsigned, Cycle>> {};
// channels x 15 TAD: 3 x 15 x 20 = 5 x 15 x 12 = 6 x 15 x 10 = 900; 3 x 15 x 10 = 450; 2 x 15 x 30 = 900
TEST_P(Scan, period_is_15_tad_a_channel) {
  const auto [inputs, adcs, channels, period] = GetParam();
  Bench b;
  set_up(b, inputs, adcs, channels, 9);
  const Cycle first = b.flag_rises(irq::Adc, 10);
  EXPECT_EQ(first, 10 + period + 1);
  for (int i = 1; i < 5; ++i) {
    b.clear_flag(irq::Adc, first + (i - 1) * period + 30);
    EXPECT_EQ(b.flag_rises(irq::Adc, first + (i - 1) * period + 31), first + i * period);
  }
}
INSTANTIATE_TEST_SUITE_P(Library, Scan,
                         ::testing::Values(std::tuple{0x001Cu, 39u, 3u, Cycle{900}},
                                           std::tuple{0x111Cu, 23u, 5u, Cycle{900}},
                                           std::tuple{0x00FCu, 19u, 6u, Cycle{900}},
                                           std::tuple{0x0003u, 59u, 2u, Cycle{900}},
                                           std::tuple{0x001Cu, 19u, 3u, Cycle{450}}));

// input n is held 20 cycles (SAMC = 1) after its turn begins, turns are 300 cycles long
TEST(Adc, inputs_are_held_in_order_at_the_end_of_sampling) {
  Bench b;
  set_up(b, 0x001C, 39, 3, 9);
  b.chip.run_to(10 + 900);
  const std::vector<std::pair<int, Cycle>> expected = {{2, 30}, {3, 330}, {4, 630}};
  EXPECT_EQ(b.outside.held, expected);
  EXPECT_EQ(b.read("ADCBUF0", 911), 200u);
  EXPECT_EQ(b.read("ADCBUF1", 911), 300u);
  EXPECT_EQ(b.read("ADCBUF2", 911), 400u);
}

// restarted in the interrupt handler as the library does: the scan starts over at its lowest input
TEST(Adc, switching_off_and_on_starts_over) {
  Bench b;
  set_up(b, 0x001C, 39, 3, 9);
  b.clear("ADCON1", 0x8000, 500);  // in the middle of the second input
  b.write("ADCSSL", 0x0060, 510);
  b.write("ADCON2", 0x0404, 511);
  b.set("ADCON1", 0x8000, 519);
  EXPECT_EQ(b.flag_rises(irq::Adc, 520), 520 + 600 + 1);
  EXPECT_EQ(b.outside.held.back(), std::make_pair(6, Cycle{520 + 300 + 20}));
  EXPECT_EQ(b.read("ADCBUF0", 1200), 500u);
  EXPECT_EQ(b.notes.count(dspic::Cause::ChangedWhileOn), 0);
}

TEST(Adc, half_cycles_of_tad_add_up) {
  Bench b;
  set_up(b, 0x0001, 4, 1, 9);  // TAD 2.5 cycles, 15 TAD = 37.5
  EXPECT_EQ(b.flag_rises(irq::Adc, 10), 10 + 38 + 1);
  b.clear_flag(irq::Adc, 49);
  EXPECT_EQ(b.flag_rises(irq::Adc, 50), 10 + 75 + 1);
}

// SSRC = 0: sampling from 101, held when SAMP is cleared at 200, 1 + 14 TAD of 10 cycles
TEST(Adc, software_starts_sampling_and_conversion) {
  Bench b;
  b.write("ADCON3", 19, 0);
  b.write("ADCHS", 7, 0);
  b.write("ADCON1", 0x8000, 10);
  b.set("ADCON1", 0x0002, 100);
  EXPECT_EQ(b.read("ADCON1", 150) & 3u, 2u);
  b.clear("ADCON1", 0x0002, 200);
  EXPECT_EQ(b.outside.held.back(), std::make_pair(7, Cycle{201}));
  EXPECT_EQ(b.read("ADCON1", 350) & 3u, 0u);
  EXPECT_EQ(b.read("ADCON1", 351) & 3u, 1u);
  EXPECT_EQ(b.read("ADCBUF0", 352), 700u);
  b.set("ADCON1", 0x0002, 400);
  b.clear("ADCON1", 0x0002, 450);
  EXPECT_EQ(b.read("ADCON1", 460) & 1u, 0u);  // DONE falls when the next conversion starts
}

// SSRC = 7 with ASAM = 0: one conversion for each SAMP
TEST(Adc, automatic_conversion_after_samp) {
  Bench b;
  b.write("ADCON3", 0x0100 | 19, 0);
  b.write("ADCHS", 3, 0);
  b.write("ADCON1", 0x80E0, 10);
  EXPECT_EQ(b.chip.next_event(20), kNever);
  b.set("ADCON1", 0x0002, 99);
  EXPECT_EQ(b.flag_rises(irq::Adc, 100), 100 + 150 + 1);
  EXPECT_EQ(b.read("ADCBUF0", 260), 300u);
  EXPECT_EQ(b.read("ADCON1", 300) & 3u, 1u);
  b.clear_flag(irq::Adc, 310);
  EXPECT_FALSE(b.flag(irq::Adc, 5000));
}

// timer 3 matches every 1000 cycles: flag at 1 + 999 + 1 = 1001, conversion 140 cycles
TEST(Adc, timer_3_triggers_conversions) {
  Bench b;
  b.write("PR3", 999, 0);
  b.write("ADCON3", 19, 0);
  b.write("ADCON1", 0x8044, 0);
  b.write("T3CON", 0x8000, 0);
  EXPECT_EQ(b.flag_rises(irq::Adc, 1), 1001 + 140 + 1);
  b.clear_flag(irq::Adc, 1200);  // T3IF stays set, triggers go on
  EXPECT_EQ(b.flag_rises(irq::Adc, 1201), 2001 + 140 + 1);
}

TEST(Adc, int0_triggers_a_conversion) {
  Bench b;
  b.outside.clock({Port::F, 6}, 5000, 10000, 100, 3);
  b.write("ADCON3", 19, 0);
  b.write("ADCON1", 0x8024, 0);
  EXPECT_EQ(b.flag_rises(irq::Adc, 1), 5000 + 2 + 140 + 1);
  b.clear_flag(irq::Adc, 6000);
  EXPECT_EQ(b.flag_rises(irq::Adc, 6001), 15000 + 2 + 140 + 1);
}

// ... also when one instruction of a program switches it on
TEST(Adc, int0_triggers_what_a_program_switched_on) {
  bench::CoreBench b(
      "mov #19, w0\n mov w0, ADCON3\n mov #0x24, w0\n mov w0, ADCON1\n bset ADCON1, #15\nend: bra end\n");
  b.outside.clock({Port::F, 6}, 5000, 10000, 100, 1);
  const auto flag = [&] { return b.sfr("IFS0") >> irq::Adc & 1; };
  b.run(5000 + 2 + 140 - 2);  // ends with an instruction, up to two cycles later
  EXPECT_EQ(flag(), 0u);
  b.run(5000 + 2 + 140 + 1);
  EXPECT_EQ(flag(), 1u);
}

TEST(Adc, buffer_halves_take_turns) {
  Bench b;
  b.write("ADCON2", 0x0402 | 1 << 2, 0);  // scan, BUFM, two conversions
  b.write("ADCON3", 0x0100 | 19, 0);
  b.write("ADCSSL", 0x0006, 0);
  b.write("ADCON1", 0x80E4, 9);  // two inputs: 300 cycles
  EXPECT_EQ(b.read("ADCON2", 200) & 0x80, 0u);
  EXPECT_EQ(b.read("ADCON2", 400) & 0x80, 0x80u);
  EXPECT_EQ(b.read("ADCBUF8", 400), 0u);
  b.chip.run_to(700);
  EXPECT_EQ(b.read("ADCBUF8", 700), 100u);
  EXPECT_EQ(b.read("ADCBUF9", 700), 200u);
  EXPECT_EQ(b.read("ADCON2", 700) & 0x80, 0u);
}

TEST(Adc, multiplexers_alternate_and_start_again_with_a) {
  Bench b;
  b.write("ADCON2", 0x0001 | 2 << 2, 0);  // ALTS, three conversions
  b.write("ADCON3", 0x0100 | 19, 0);
  b.write("ADCHS", 0x0904, 0);  // A: 4, B: 9
  b.write("ADCON1", 0x80E4, 9);
  b.chip.run_to(10 + 6 * 150);
  std::vector<int> inputs;
  for (const auto& h : b.outside.held) inputs.push_back(h.first);
  EXPECT_EQ(inputs, (std::vector<int>{4, 9, 4, 4, 9, 4}));
}

TEST(Adc, formats_of_the_result) {
  // 0x123: integer 0x123 - 0x800 = -1757 = 0xF923, fraction 0x1230, signed fraction 0x9230
  const unsigned expected[] = {0x0123, 0xF923, 0x1230, 0x9230};
  for (unsigned form = 0; form < 4; ++form) {
    Bench b;
    b.outside.analogue = [](int, Cycle) { return 0x123; };
    b.write("ADCON3", 0x0100 | 19, 0);
    b.write("ADCON1", 0x80E2 | form << 8, 0);
    EXPECT_EQ(b.read("ADCBUF0", 1000), expected[form]);
  }
}

TEST(Adc, input_is_held_before_a_later_pin_change) {
  Bench b;
  std::vector<std::size_t> changes_before;
  b.outside.analogue = [&](int, Cycle) {
    changes_before.push_back(b.outside.driven.size());
    return 0;
  };
  b.write("TRISF", 0x007F, 0);
  set_up(b, 0x001C, 39, 3, 9);
  const std::size_t told = b.outside.driven.size();
  b.write("LATF", 0x0080, 100);  // after the first hold at 30, before the second at 330
  b.chip.run_to(400);
  ASSERT_EQ(changes_before.size(), 2u);
  EXPECT_EQ(changes_before[0], told);
  EXPECT_EQ(changes_before[1], told + 1);
}

TEST(Adc, reading_a_result_twice_gives_the_same) {
  Bench b;
  set_up(b, 0x0004, 39, 1, 9);
  EXPECT_EQ(b.read("ADCBUF0", 320), 200u);
  EXPECT_EQ(b.read("ADCBUF0", 321), 200u);
  EXPECT_EQ(b.chip.horizon(0x280, 320), 330);  // the next input is held, and converted by 610
}

TEST(Adc, set_up_while_on_is_reported_once) {
  Bench b;
  set_up(b, 0x001C, 39, 3, 9);
  b.write("ADCON3", 0x0105, 50);
  b.write("ADCON3", 0x0106, 60);
  b.write("ADCSSL", 0x001C, 70);  // the same value
  EXPECT_EQ(b.notes.count(dspic::Cause::ChangedWhileOn), 1);
}

TEST(Adc, digital_channel_is_named) {
  Bench b;
  b.write("ADPCFG", 0x0008, 0);
  set_up(b, 0x001C, 39, 3, 9);
  b.chip.run_to(5000);
  ASSERT_EQ(b.notes.count(dspic::Cause::AnalogueDigital), 1);
  EXPECT_EQ(b.notes.all.back().place, "AN3");
  EXPECT_EQ(b.notes.all.back().message, "AN3 is converted, but ADPCFG.PCFG3 = 1 makes it a digital input");
}

TEST(Adc, channel_whose_pin_is_an_output_is_named) {
  Bench b;
  b.write("TRISB", 0xFFFB, 0);
  set_up(b, 0x001C, 39, 3, 9);
  b.chip.run_to(5000);
  ASSERT_EQ(b.notes.count(dspic::Cause::AnalogueDigital), 1);
  EXPECT_EQ(b.notes.all.back().place, "AN2");
}

TEST(Adc, slow_handler_misses_scans) {
  Bench b;
  b.enable(irq::Adc, 0);
  set_up(b, 0x001C, 39, 3, 9);
  b.chip.run_to(10 + 5 * 900 + 1);
  EXPECT_EQ(b.chip.interrupts().missed(dspic::kFirstIrqVector + irq::Adc, 10 + 5 * 900 + 1), 4);
  EXPECT_EQ(b.notes.count(dspic::Cause::MissedInterrupt), 1);
}

// Whoever draws registers over time sees each access; for others the registers of a converter that is off
// are words, and ADCON1 is changed in one step. It is the same.
struct Onlooker : dspic::EventWatch {
  void about_to_change(Cycle) override {}
};

/// Instructions on the converter's registers by chance, in ones and bytes, on and off, and with its module
/// switched off.
std::string instructions(unsigned seed) {
  const char* registers[] = {"ADCON1", "ADCON2", "ADCON3", "ADCHS", "ADCSSL", "ADCBUF0", "ADPCFG"};
  bench::Draw draw{seed};
  std::string text = "mov #0x1000, w12\n mov #0x00E4, w0\n mov w0, ADCON1\n";
  for (int i = 0; i < 300; ++i) {
    const std::string name = registers[draw(7)], bit = std::to_string(draw(16)),
                      low = std::to_string(draw(8));
    switch (draw(9)) {
      case 0:
      case 1:
        text += "mov #" + std::to_string(draw(0x10000)) + ", w1\n mov w1, " + name + "\n";
        break;
      case 2:
        text += "mov " + name + ", w2\n mov w2, [w12++]\n";
        break;
      case 3:
        text += "bset " + name + ", #" + bit + "\n";
        break;
      case 4:
        text += "bclr " + name + ", #" + bit + "\n";
        break;
      case 5:
        text += "mov.b #" + std::to_string(draw(0x100)) + ", w0\n mov.b wreg, " + name + "+1\n";
        break;
      case 6:
        text += std::string(draw(2) ? "bset" : "bclr") + " ADCON1, #15\n bclr ADCON2, #1\n";
        break;
      case 7:
        text += "repeat #" + std::to_string(draw(2000)) + "\n nop\n";
        break;
      default:
        if (draw(8) == 0) text += std::string(draw(3) ? "bclr" : "bset") + " PMD1, #0\n";
        text += "bset.b " + name + "+1, #" + low + "\n";
    }
  }
  return text + "end: bra end\n";
}

TEST(Adc, registers_are_alike_when_they_are_words_and_when_each_access_is_seen) {
  int converted = 0, told = 0;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    const std::string text = instructions(seed);
    bench::CoreBench quick(text), seen(text);
    Onlooker onlooker;
    seen.chip->watch(&onlooker);
    for (bench::CoreBench* b : {&quick, &seen}) ASSERT_TRUE(b->run_to("end")) << seed;
    ASSERT_EQ(quick.cpu->now(), seen.cpu->now()) << seed;
    EXPECT_EQ(quick.cpu->state_hash(), seen.cpu->state_hash()) << seed;
    EXPECT_EQ(quick.chip->state_hash(quick.cpu->now()), seen.chip->state_hash(seen.cpu->now())) << seed;
    ASSERT_EQ(quick.notes.all.size(), seen.notes.all.size()) << seed;
    for (std::size_t i = 0; i < quick.notes.all.size(); ++i)
      EXPECT_EQ(quick.notes.all[i].message, seen.notes.all[i].message) << seed;
    converted += static_cast<int>(quick.outside.held.size());
    told += static_cast<int>(quick.notes.all.size());
  }
  EXPECT_GT(converted, 1000);
  EXPECT_GT(told, 100);
}

}  // namespace
