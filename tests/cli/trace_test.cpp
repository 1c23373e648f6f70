// SPDX-License-Identifier: MIT
// --vcd and --trace: files that strict readers take, changes at the cycles at which they happen. Times in the
// expectations are worked out from the timers' periods at 14,745,600 cycles a second.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "tests/cli/command.h"
#include "tests/cli/timeline_reader.h"
#include "tests/cli/vcd_reader.h"

using namespace cli_test;
using nlohmann::json;

namespace {

class Traces : public CommandTest {
 protected:
  Traces() {
    write("world.toml",
          "twinpuck = 1\n[[robot]]\nname = \"puck\"\n[[robot]]\nname = \"two\"\nposition = [0.5, 0.5]\n");
    write("busy/main.c",
          "#include <p30F6014A.h>\n"
          "#include <motor_led/e_init_port.h>\n"
          "#include <motor_led/advance_one_timer/e_agenda.h>\n"
          "#include <motor_led/advance_one_timer/e_motors.h>\n"
          "#include <uart/e_uart_char.h>\n"
          "int count;\n"
          "double half;\n"
          "int pair[2] = {3, -4};\n"
          "volatile unsigned int ticks;\n"
          "void __attribute__((interrupt, auto_psv)) _T1Interrupt(void) { IFS0bits.T1IF = 0; ticks++; }\n"
          "static void beat(void) {\n"
          "  volatile int i;\n"
          "  count++; half = count * 0.5; pair[1]--;\n"
          "  for (i = 0; i < 20; i++);\n"  // longer than T1's period, shorter than an agenda tick
          "}\n"
          "int main(void) {\n"
          "  e_init_port(); e_init_uart1(); e_init_motors(); e_start_agendas_processing();\n"
          "  e_activate_agenda(beat, 500);\n"
          "  e_set_speed_right(500); e_set_speed_left(-250);\n"
          "  IPC0bits.T1IP = 6; PR1 = 499; T1CON = 0x8000; IEC0bits.T1IE = 1;\n"
          "  e_send_uart1_char(\"AB\", 2);\n"
          "  while (1);\n"
          "}\n");
  }
  Said run(const std::string& options, const std::string& before = "") const {
    return twinpuck("run " + path("world.toml") + " -q --fw 'puck=" + path("busy") + "' " + hal_ + options,
                    before);
  }
  std::string hal_;  // "--hal sim "; empty: the usual one
};

/// What is drawn of a program, whichever library it is linked with.
class TracesOfBoth : public Traces, public ::testing::WithParamInterface<const char*> {
 protected:
  TracesOfBoth() { hal_ = "--hal " + std::string(GetParam()) + " "; }
  bool is_closed_form() const { return hal_ == "--hal sim "; }
};
INSTANTIATE_TEST_SUITE_P(, TracesOfBoth, ::testing::Values("sim", "dspic"),
                         [](const auto& info) { return std::string(info.param); });

TEST_P(TracesOfBoth, blink_toggles_at_every_thousandth_agenda_tick) {
  const Said s = twinpuck("run empty --fw '*=blink' -q " + hal_ + "--for 0.65 --vcd " + path("b.vcd"));
  ASSERT_EQ(s.exit_code, 0) << s.text;
  const Dump dump = parse(read(path("b.vcd")));
  const auto& led = dump.signals.at("puck/leds/LED0");
  ASSERT_EQ(led.size(), 7u);  // off at 0, then one each 0.1 s
  EXPECT_EQ(led[0], (std::pair<long long, std::string>{0, "0"}));
  for (std::size_t i = 2; i < led.size(); ++i) {
    EXPECT_EQ(led[i].second, i % 2 ? "1" : "0");
    // the callback begins within two cycles: instructions are whole, and what ticks steal from the program
    // is rounded to whole cycles
    EXPECT_NEAR(static_cast<double>(led[i].first - led[i - 1].first), 1000 * 1475 * kCycleNs,
                2 * kCycleNs + 1.01);
  }
  EXPECT_EQ(dump.signals.at("puck/leds/LED1").size(), 1u);
  EXPECT_EQ(dump.last_ns, 650'390'625);  // the tick after 0.65 s: 333 of 512 a second
}

// 500 steps/s are 20 ticks of 1475 cycles; the simulation asks the wheels 512 times a second how they turn
TEST_F(Traces, each_step_has_its_cycle_whoever_asks) {
  write("drives/main.c",
        "#include <motor_led/e_init_port.h>\n"
        "#include <motor_led/advance_one_timer/e_agenda.h>\n"
        "#include <motor_led/advance_one_timer/e_motors.h>\n"
        "int main(void) {\n"
        "  e_init_port(); e_init_motors(); e_start_agendas_processing();\n"
        "  e_set_speed_left(500); e_set_speed_right(500);\n"
        "  while (1);\n"
        "}\n");
  for (const char* hal : {"--hal sim", "--hal dspic"}) {
    SCOPED_TRACE(hal);
    const Said s = twinpuck("run empty -q --fw '*=" + path("drives") + "' --for 3 --vcd " + path("d.vcd") +
                            " --vcd-signals '*:left_steps' " + hal);
    ASSERT_EQ(s.exit_code, 0) << s.text;
    const auto steps = parse(read(path("d.vcd"))).signals.at("puck/motors/left_steps");
    ASSERT_NEAR(static_cast<double>(steps.size()), 1495, 6);  // e_init_port() takes a while
    // where the handler runs, phases take it a few cycles more and less
    const double jitter_ns = std::string(hal) == "--hal dspic" ? 8 * kCycleNs : 0;
    for (std::size_t i = 3; i < steps.size(); ++i)
      EXPECT_NEAR(static_cast<double>(steps[i].first - steps[i - 1].first), 20 * 1475 * kCycleNs,
                  1.01 + jitter_ns)
          << i;
  }
}

// and a run that is looked at is the run that it is without
TEST_F(Traces, no_output_changes_a_run) {
  for (const char* hal : {"--hal sim", "--hal dspic"}) {
    SCOPED_TRACE(hal);
    const auto digest = [&](const std::string& output) {
      const Said s =
          twinpuck("run maze --for 2 -q " + std::string(hal) + " --summary " + path("s.json") + " " + output);
      EXPECT_EQ(s.exit_code, 0) << s.text;
      return json::parse(read(path("s.json")))["digest"].get<std::string>();
    };
    const std::string alone = digest("");
    for (const std::string& output :
         {"--trace " + path("t.json"), "--vcd " + path("t.vcd"), "--record " + path("r.csv"),
          "--vcd " + path("t.vcd") +
              " --vcd-signals 'puck:T2,puck:ADC,puck:TMR2,puck:SR,puck:U1STA,puck:left_steps'",
          "--profile-json " + path("p.json"),
          "--profile-json " + path("p.json") + " --trace " + path("t.json")})
      EXPECT_EQ(digest(output), alone) << output;
  }
}

TEST_P(TracesOfBoth, time_line_of_the_chips_code_has_waits_handlers_and_agendas) {
  const Said s =
      twinpuck("run empty -q --fw '*=" + path("busy") + "' " + hal_ + "--for 0.5 --trace " + path("t.json"));
  ASSERT_EQ(s.exit_code, 0) << s.text;
  double busy = 0, waiting = 0;
  int handlers = 0, agendas = 0;
  for (const json& e : json::parse(read(path("t.json")))) {
    if (e["ph"] != "X") continue;
    const std::string name = e["name"];
    // each on its track, and only a handler interrupts anything
    const bool is_handler = std::isupper(static_cast<unsigned char>(name[0])) != 0;
    if (name != "waiting") {
      EXPECT_EQ(e["tid"], name == "busy" ? 1 : is_handler ? 2 : 3) << e;
    }
    EXPECT_EQ(e["args"].contains("first_instruction_us"), is_handler) << e;
    if (name == "busy") busy += e["dur"].get<double>();
    if (name == "waiting") waiting += e["dur"].get<double>();
    if (name == "T1") ++handlers;
    if (name != "beat") continue;
    ++agendas;
    // its loop of 20 rounds, not the time up to the next
    EXPECT_LT(e["args"]["cycles"].get<int>(), 2000);
  }
  EXPECT_NEAR(busy + waiting, 5e5, 1);
  EXPECT_GT(waiting, 0.9 * busy);  // but for 5 % of T1's handlers, and their looks
  EXPECT_NEAR(handlers, 0.49 * 14745600 / 500, 100);
  EXPECT_EQ(agendas, 9);
}

// hal_dspic's driver writes a motor's four pins one after the other, so the states in between are drawn, too:
// those that last
Dump::Changes settled(const Dump::Changes& all) {
  Dump::Changes kept;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (i + 1 == all.size() || static_cast<double>(all[i + 1].first - all[i].first) > 500 * kCycleNs)
      if (kept.empty() || kept.back().second != all[i].second) kept.push_back(all[i]);
  return kept;
}

TEST_P(TracesOfBoth, coils_variables_interrupts_and_bytes_have_their_times) {
  const Said s =
      run("--for 0.5 --vcd " + path("t.vcd") +
          " --vcd-signals puck:right_coils,puck:right_steps,puck:left_steps,puck:count,puck:half,puck:pair,"
          "puck:T1,puck:TX1,puck:LATD --trace " +
          path("t.json"));
  ASSERT_EQ(s.exit_code, 0) << s.text;
  const Dump dump = parse(read(path("t.vcd")));

  // 500 steps/s: 20 ticks of 1475 cycles; coils off after 15 of them (power save)
  const Dump::Changes coils = settled(dump.signals.at("puck/motors/right_coils"));
  const std::vector<std::string> kPhases{"1010", "110", "101", "1001"};
  ASSERT_GT(coils.size(), 400u);
  std::size_t phase = 9;
  int intervals = 0, exact = 0;
  // where the handler runs, its way to the pins takes a few cycles more and less
  const double near_ns = is_closed_form() ? 1.01 : 10 * kCycleNs;
  for (std::size_t i = 100; i < 300; ++i) {
    if (coils[i].second == "0") {
      const double off_ns = static_cast<double>(coils[i].first - coils[i - 1].first) - 15 * 1475 * kCycleNs;
      const double next_ns =
          static_cast<double>(coils[i + 1].first - coils[i - 1].first) - 20 * 1475 * kCycleNs;
      // the tick of beat, which stands before the motors in the list, moves them when beat has returned
      ++intervals;
      exact += std::abs(off_ns) < near_ns && std::abs(next_ns) < near_ns;
      EXPECT_LT(std::abs(off_ns), 1475 * kCycleNs);
      EXPECT_LT(std::abs(next_ns), 1475 * kCycleNs);
      continue;
    }
    const std::size_t now = static_cast<std::size_t>(
        std::find(kPhases.begin(), kPhases.end(), coils[i].second) - kPhases.begin());
    ASSERT_LT(now, 4u) << coils[i].second;
    if (phase < 4) {
      EXPECT_EQ(now, (phase + 1) % 4);
    }
    phase = now;
  }
  EXPECT_EQ(intervals, 100);
  EXPECT_GE(exact,
            86);  // 0.2 s: four or five beats, two intervals each; now and then a tick waits for T1's handler
  // a step each 20 ticks forward, each 40 ticks backward (32 bits of two's complement), from the first one on
  const auto steps_since = [&](const Dump::Changes& steps, int ticks) {
    return 1 + static_cast<double>(dump.last_ns - steps[1].first) / (ticks * 1475 * kCycleNs);
  };
  const auto& right = dump.signals.at("puck/motors/right_steps");
  EXPECT_NEAR(static_cast<double>(std::stoul(right.back().second, nullptr, 2)), steps_since(right, 20), 1.01);
  const auto& left = dump.signals.at("puck/motors/left_steps");
  ASSERT_EQ(left.back().second.size(), 32u);
  EXPECT_NEAR(static_cast<double>(static_cast<std::int32_t>(std::stoul(left.back().second, nullptr, 2))),
              -steps_since(left, 40), 1.01);

  // the agenda of 500 ticks: 50.015 ms; 9 of them
  const auto& count = dump.signals.at("puck/variables/count");
  ASSERT_EQ(count.size(), 10u);
  for (std::size_t i = 2; i < count.size(); ++i) {
    EXPECT_EQ(std::stoul(count[i].second, nullptr, 2), i);
    EXPECT_NEAR(static_cast<double>(count[i].first - count[i - 1].first), 500 * 1475 * kCycleNs,
                200 * kCycleNs);  // variables are looked at every 100 cycles
  }
  EXPECT_EQ(dump.signals.at("puck/variables/half").back().second, "4.5");
  EXPECT_EQ(dump.signals.at("puck/variables/pair(0)").back().second, "11");
  EXPECT_EQ(dump.signals.at("puck/variables/pair(1)").back().second, "1111111111110011");  // -4 - 9 = -13

  // timer 1: a flag every 500 cycles, its handler after that
  const auto& flag = dump.signals.at("puck/interrupts/T1_flag");
  std::vector<long long> rises;
  for (const auto& [ns, value] : flag)
    if (value == "1") rises.push_back(ns);
  ASSERT_GT(rises.size(), 1000u);
  EXPECT_NEAR(static_cast<double>(rises[1000] - rises[500]), 500 * 500 * kCycleNs, 1.01);

  // 115,200 baud: 1280 cycles a byte
  const auto& busy = dump.signals.at("puck/uart/TX1_busy");
  ASSERT_EQ(busy.size(), 3u);
  EXPECT_NEAR(static_cast<double>(busy[2].first - busy[1].first), 2 * 1280 * kCycleNs, 1.01);
  const auto& byte = dump.signals.at("puck/uart/TX1");
  ASSERT_EQ(byte.size(), 3u);
  EXPECT_EQ(byte[1].second, "1000001");
  EXPECT_EQ(byte[2].second, "1000010");

  // the time line: T1 nested within T2, whose callback is beat
  const json events = json::parse(read(path("t.json")));
  check_timeline(events);
  int nested = 0, beats = 0;
  std::set<std::string> counters;
  for (const json& e : events) {
    if (e["ph"] == "C") counters.insert(e["name"]);
    if (e["ph"] != "X") continue;
    EXPECT_GE(e["dur"].get<double>(), 0);
    if (e["name"] == "beat") ++beats;
    if (e["name"] != "T1") continue;
    const auto& args = e["args"];
    EXPECT_GE(args["latency_cycles"].get<int>(), 0);
    nested += args["interrupted_handlers"] == 1;
  }
  EXPECT_EQ(beats, 9);
  EXPECT_GE(nested, 9);
  for (const char* name : {"cpu load", "battery", "UART bytes sent", "UART bytes received"})
    EXPECT_TRUE(counters.count(name)) << name;
}

TEST_P(TracesOfBoth, do_not_depend_on_threads_nor_change_the_run) {
  const std::string common = "--fw 'two=blink' --for 0.3 --summary ";
  for (const char* threads : {"1", "3"})
    ASSERT_EQ(run(common + path(std::string(threads) + ".s") + " --threads " + threads + " --vcd " +
                  path(std::string(threads) + ".vcd") + " --vcd-signals '*:LED0,puck:count' --trace " +
                  path(std::string(threads) + ".json"))
                  .exit_code,
              0);
  ASSERT_EQ(run(common + path("0.s")).exit_code, 0);
  EXPECT_EQ(read(path("1.vcd")), read(path("3.vcd")));
  EXPECT_EQ(read(path("1.json")), read(path("3.json")));
  EXPECT_EQ(json::parse(read(path("0.s")))["digest"], json::parse(read(path("1.s")))["digest"]);
  EXPECT_EQ(parse(read(path("1.vcd"))).signals.at("two/leds/LED0").size(), 3u);
}

TEST_P(TracesOfBoth, a_window_and_a_trigger_bound_the_dump) {
  ASSERT_EQ(run("--for 0.3 --vcd-from 0.1 --vcd-to 0.2 --vcd-signals puck:right_coils --vcd " + path("w.vcd"))
                .exit_code,
            0);
  const Dump window = parse(read(path("w.vcd")));
  EXPECT_EQ(window.first_ns, 100'000'000);
  EXPECT_EQ(window.last_ns, 200'000'000);
  // the third beat, after 150 ms, starts it
  ASSERT_EQ(run("--for 0.3 --vcd-trigger puck:count=3 --vcd-signals puck:right_coils --vcd " + path("c.vcd"))
                .exit_code,
            0);
  const Dump triggered = parse(read(path("c.vcd")));
  EXPECT_NEAR(static_cast<double>(triggered.first_ns), 150e6 + 21e6, 21e6);
  EXPECT_EQ(triggered.signals.at("puck/variables/count").front().second, "11");
}

TEST_P(TracesOfBoth, a_trigger_that_cannot_come_is_refused_and_one_that_did_not_is_told) {
  const auto tried = [&](const std::string& trigger) {
    return run("--for 0.02 --vcd " + path("t.vcd") + " --vcd-trigger puck:" + trigger);
  };
  struct Case {
    const char *trigger, *expected;
  };
  for (const Case& c :
       {Case{"LED0=2", "got value '2', expected a whole number from 0 to 1"},
        Case{"LED0=-1", "got value '-1', expected a whole number from 0 to 1"},
        Case{"left_coils=16", "got value '16', expected a whole number from 0 to 15"},
        Case{"TX1=256", "got value '256', expected a whole number from 0 to 255"},
        Case{"T1=2", "got value '2', expected a whole number from 0 to 1"},
        Case{"count=32768", "got value '32768', expected a whole number from -32768 to 32767"},
        Case{"count=-32769", "got value '-32769', expected a whole number from -32768 to 32767"},
        Case{"count=1.5", "got value '1.5', expected a whole number from -32768 to 32767"},
        Case{"count=0x10000", "got value '0x10000', expected a whole number from -32768 to 32767"},
        Case{"ticks=-1", "got value '-1', expected a whole number from 0 to 65535"},
        Case{"ticks=65536", "got value '65536', expected a whole number from 0 to 65535"},
        Case{"half=1e40", "got value '1e40', expected a number from -3.40282e+38 to 3.40282e+38"},
        Case{"half=much", "got value 'much', expected a number from -3.40282e+38 to 3.40282e+38"},
        Case{"pair=3", "got 'pair', an array, expected one of its elements"},
        Case{"left_steps=4294967296",
             "got value '4294967296', expected a whole number from -2147483648 to 2147483647"},
        Case{"T1CON=0x10000", "got value '0x10000', expected a whole number from 0 to 65535"},
        Case{"T1CON=1", "got value '1', expected bits of 0xa076 only"},
        Case{"T1CON.TCKPS=4", "got value '4', expected a whole number from 0 to 3"}}) {
    const Said s = tried(c.trigger);
    EXPECT_EQ(s.exit_code, 2) << c.trigger;
    const std::string signal = std::string(c.trigger).substr(0, std::string(c.trigger).find('='));
    EXPECT_TRUE(reads(s.text, "command line: --vcd-trigger: puck:" + signal + ": " + c.expected));
  }
  for (const char* never : {"count=-5", "count=0xFFFB", "half=0.1", "pair[0]=4", "LED7=1"}) {
    const Said s = tried(never);
    EXPECT_EQ(s.exit_code, 7) << never << s.text;
    EXPECT_TRUE(reads(s.text, "@/t.vcd: --vcd-trigger: got no puck:" + std::string(never) +
                                  " in the window, expected it once; the dump is empty"));
  }
  for (const char* comes : {"pair[1]=-4", "pair[1]=0xFFFC", "T1CON=0x8000", "ticks=3"}) {
    const Said s = tried(comes);
    EXPECT_EQ(s.exit_code, 0) << comes << s.text;
    EXPECT_NE(read(path("t.vcd")).find("$dumpvars"), std::string::npos) << comes;
  }
}

TEST_F(Traces, a_full_dump_ends_cleanly) {
  ASSERT_EQ(run("--for 1 --vcd-max-mb 0.01 --vcd " + path("c.vcd")).exit_code, 0);
  const std::string text = read(path("c.vcd"));
  EXPECT_LE(text.size(), 10'000u);
  EXPECT_GT(text.size(), 9'000u);
  EXPECT_NE(parse(text).comment.find("--vcd-max-mb"), std::string::npos);
}

TEST_F(Traces, a_full_time_line_ends_cleanly) {
  ASSERT_EQ(run("--for 1 --trace-max-mb 0.01 --trace " + path("c.json")).exit_code, 0);
  const std::string text = read(path("c.json"));
  EXPECT_LE(text.size(), 10'000u);
  EXPECT_GT(text.size(), 9'000u);
  const json events = json::parse(text);
  check_timeline(events);
  EXPECT_NE(events.back()["name"].get<std::string>().find("--trace-max-mb"), std::string::npos);
}

TEST_F(Traces, a_killed_run_leaves_files_that_can_be_read) {
  twinpuck("run empty --fw '*=blink' -q --for 1000000 --vcd-max-mb 100000 --vcd " + path("k.vcd") +
               " --trace " + path("k.json"),
           cli_test::signal_once("KILL", path("k.json"), 20000));
  const Dump dump = parse(read(path("k.vcd")));
  EXPECT_GT(dump.last_ns, 0);
  std::string text = read(path("k.json"));
  ASSERT_GT(text.size(), 1000u);
  text.resize(text.rfind(",\n"));  // Linux cuts a write() at a page when it kills
  json events;
  EXPECT_NO_THROW(events = json::parse(text + "]"));
  EXPECT_GT(events.size(), 10u);
  check_timeline(events);
}

}  // namespace
