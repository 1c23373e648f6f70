// SPDX-License-Identifier: MIT
// The table for people: twinpuck list faults, and docs/faults.md (tools/dev/pages.cpp writes it).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "hal_sim/faults/kinds.h"
#include "hal_sim/signals/signals.h"

namespace faults {

namespace {

std::string choices_text(const Parameter& p) {
  std::string text = p.choices;
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 4)
    text.replace(at, 1, " or ");
  return text;
}

/// "0 to 1", "left or right or both", "text".
std::string range_text(const Parameter& p) {
  switch (p.type) {
    case sim::ValueType::Choice:
      return choices_text(p);
    case sim::ValueType::Text:
    case sim::ValueType::Bytes:
      return "text";
    case sim::ValueType::Triple:
      return "three numbers";
    default:
      return std::fabs(p.most) >= 1e12 ? "a number" : fmt::format("{} to {}", p.least, p.most);
  }
}

std::string unit_text(const Parameter& p) { return *p.unit ? std::string(" ") + p.unit : ""; }

bool is_required(const Parameter& p) { return std::strcmp(p.usual, "required") == 0; }

void add_kind(std::string& text, const Kind& kind) {
  text +=
      fmt::format("\n### `{}`\n\n{}{}. {}\n\nIt took effect when {}.{}\n", kind.name,
                  static_cast<char>(std::toupper(static_cast<unsigned char>(kind.does[0]))), kind.does + 1,
                  kind.meaning, kind.noticed, kind.lasts ? "" : " It is over when it is done: no `for_s`.");
  if (kind.is_stimulus())
    text += fmt::format(
        "\nIn `[[stimulus]]`: `{}`{}.\n", kind.key,
        kind.parameters.empty() ? " = true" : fmt::format(" stands for `{}`", kind.parameters[0].name));
  if (kind.parameters.empty()) return;
  text += "\n| parameter | range | usual | |\n|---|---|---|---|\n";
  for (const Parameter& p : kind.parameters)
    text += fmt::format("| `{}` | {}{} | {} | {} |\n", p.name, range_text(p), unit_text(p),
                        is_required(p) ? "needed"
                        : *p.usual     ? "`" + std::string(p.usual) + "`"
                                       : "",
                        p.does);
}

}  // namespace

std::string text_table() {
  std::string text;
  for (const Kind& kind : kinds()) {
    text += fmt::format("  {:<20} {}\n", kind.name, kind.does);
    for (const Parameter& p : kind.parameters)
      text += fmt::format("  {:<20}   {}: {}{}{}; {}\n", "", p.name, range_text(p), unit_text(p),
                          is_required(p) ? ""
                          : *p.usual     ? fmt::format(", usually {}", p.usual)
                                         : "",
                          p.does);
  }
  return text;
}

std::string page() {
  std::string text = R"(# Faults and stimuli

<!-- Made by `twinpuck-dev page faults` from hal_sim/faults/kinds.cpp; do not edit. -->

What a bench can do to a robot, and a robot must bear: a blocked sensor, a wheel that sticks, bytes that get
lost, a battery that sags, a shove. Each has one physical or electrical meaning in the models of board and
world; no number is patched in the program. A fault is told to the tick, in a file, in a line of the command
or by a call, at a time or when a condition holds, and a run in which it never took effect is not valid: it
would have shown nothing.

```toml
[[fault]]
kind = "sensor_blocked"
robot = "e-puck"        # every robot without it
sensor = 0
at_s = 2.0              # the world's time; 0 without it
for_s = 1.5             # it stays without it

[[fault]]
kind = "battery_sag"
drop_v = 0.8
when = "distance_m > 0.5 && !led0"

[[stimulus]]
send = "go\r"
uart = 1
at_s = 0.5

[[stimulus]]
press = 5
when = "$state == 2"    # a variable of the program
```

```
twinpuck run maze --fw obstacle --faults bench.toml
twinpuck run maze --fw obstacle --fault "wheel_stuck wheel=left at=2s for=500ms"
twinpuck list faults
twinpuck list signals
```

- **When.** A fault begins at the first tick (1/512 s) at or after `at_s`. With `when` the condition is looked at
  from `at_s` on at every tick, and the fault begins at the first tick at which it holds, once. It ends `for_s`
  later. Of several at one tick those that end come first, then those that begin, in the order of the file.
- **What has passed stays.** Samples of the converter are judged by the instant at which they are held, bytes to
  the robot by when their start bit comes; what had begun before is as it was.
- **Several at once.** Faults of one kind on one thing add up: films and shares multiply, voltages, resistances,
  irradiances and errors are sums. Different kinds act one behind the other: lamp, cover, dirt, dead parts.
- **Took effect.** Each kind says below by what it is seen that it changed something for the program or the world.
  Looks from outside (pages, recordings, pictures) do not count. At the end of a run each fault that never began
  or never took effect is told, and the run ends with [exit code](design.md#exit-codes) 7.
  `--summary` has a list `faults`: `fault, robot, begun_s, took_effect_s, ended_s, where`, null for what never was.
- **Chance.** Lost steps and bytes are drawn from random numbers of their own, named by seed, robot and wheel or
  line, and counted step by step and byte by byte. The same seed gives the same run, with any number of threads.
  Runs without faults are what they were.

## Conditions

A condition is an expression over [signals](#signals): `+ - * / ^ < <= > >= == != && || !` and `and or not`,
`?:`, brackets, `abs min max sqrt exp ln log10 sin cos tan asin acos atan atan2 hypot floor ceil round sign mod`
(angles in radians), `pi`, `true`, `false`. A name without a robot is that of the robot whom the fault befalls;
`ROBOT.NAME`, or `'ROBOT'.NAME`, is another's: `robot2.x_m - robot1.x_m > 0.1`.

| of the chip and the program | |
|---|---|
| `$NAME`, `$speed[1]`, `$node->count` | a global or static variable, an element or a member |
| `var(EXPRESSION)`, `$(EXPRESSION)` | an expression in C, computed as the program would |
| `reg(T2CON)`, `reg(T2CON.TCKPS)` | a register of the chip or one of its fields |
| `pin(D3)` | the level of a pin, 0 or 1 |

## Signals

)";
  text += signals::page_table();
  text += "\n## Kinds\n\n| kind | what is done |\n|---|---|\n";
  for (const Kind& kind : kinds()) text += fmt::format("| [`{0}`](#{0}) | {1} |\n", kind.name, kind.does);
  for (const Kind& kind : kinds()) add_kind(text, kind);
  text += R"(
## Not modelled

- Faults that begin or end within a tick; parts that warm up, wear or stay broken after the fault has ended.
- Framing errors and start bits taken late on a loose wire: whole bytes are lost, or one bit of them is turned.
- A rotor that is let go: it is taken to stand by the pattern of that moment, not at the nearest of its four
  places (2 steps or 0.26 mm at most).
- A brown-out of the processor: a sagging battery moves the detector's pin and the count of the voltage, and no
  reset comes.
- Levels forced on coils, IR emitters, camera, codec and serial pins; currents through a wire that holds a pin.
- A robot that is lifted is level; its microphones and camera stay where they were.
- The loudspeaker's pitch while a crystal is off.
)";
  return text;
}

}  // namespace faults
