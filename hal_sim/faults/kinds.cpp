// SPDX-License-Identifier: MIT
#include "hal_sim/faults/kinds.h"

namespace faults {

namespace {

using Type = sim::ValueType;

const Parameter kSensor{"sensor", Type::Integer, "", 0, 7, "", "", "which proximity sensor; without it all"};
const Parameter kWheel{"wheel", Type::Choice, "", 0, 0, "left|right|both", "\"both\"", "which wheel"};
const Parameter kUart{"uart", Type::Integer, "", 1, 2, "", "1", "which line: 1 Bluetooth, 2 RS232"};
const Parameter kDirection{
    "direction", Type::Choice, "",         0,
    0,           "rx|tx|both", "\"both\"", "as the robot sees it: rx comes in, tx goes out"};
const Parameter kShareOfBytes{"share", Type::Number, "", 0, 1, "", "0.1", "of the bytes"};

}  // namespace

// The one table of faults and stimuli; kinds.h says what the columns are.
const std::vector<Kind>& kinds() {
  static const std::vector<Kind> kAll{
      {"sensor_blocked",
       "something covers a proximity sensor",
       "An opaque cover lies before emitter and phototransistor. Light from outside is shut out; the flash "
       "comes "
       "back as from a wall of that reflectance at that distance, by the sensor's own response curve.",
       "a sample differed from the one without the cover",
       true,
       nullptr,
       {kSensor,
        {"reflects", Type::Number, "", 0, 1, "", "0.9", "share of the flash that the cover reflects"},
        {"gap_mm", Type::Number, "mm", 0, 100, "", "1", "from the sensor to the cover"}}},
      {"sensor_dead",
       "a proximity sensor's emitter or receiver is broken",
       "An emitter that is open gives no flash: lit samples are as dark ones. A phototransistor that is open "
       "draws "
       "no current: every sample is at the converter's top, as in the dark.",
       "a sample differed from the sound sensor's",
       true,
       nullptr,
       {kSensor, {"part", Type::Choice, "", 0, 0, "emitter|receiver", "\"emitter\"", "what is broken"}}},
      {"sensor_dirty",
       "dirt on a proximity sensor",
       "A film lets a share of the light through: once for light from outside, twice for the flash, which "
       "goes "
       "and comes.",
       "a sample differed from the clean sensor's",
       true,
       nullptr,
       {kSensor,
        {"transmits", Type::Number, "", 0, 1, "", "0.5", "share of the light that passes the film once"}}},
      {"hot_light",
       "a lamp shines on proximity sensors",
       "Its light falls on the phototransistor beside the world's, dark and lit samples alike; enough of it "
       "drives them to the converter's bottom.",
       "a sample differed from the one without the lamp",
       true,
       nullptr,
       {kSensor, {"w_m2", Type::Number, "W/m2", 0, 2000, "", "8", "irradiance at the sensor"}}},
      {"wheel_stuck",
       "something blocks a wheel",
       "The motor's field turns as its coils are switched, the wheel does not: every step that is asked for "
       "is "
       "lost. Coils draw what they draw.",
       "a step was asked for and not made",
       true,
       nullptr,
       {kWheel}},
      {"steps_lost",
       "a motor loses steps",
       "With a chance of its own at each step the rotor falls behind by a whole electrical turn and is "
       "caught by "
       "the same pattern: four steps in a row are not made. Random numbers of the wheel's own.",
       "a step was asked for and not made",
       true,
       nullptr,
       {kWheel, {"share", Type::Number, "", 0, 1, "", "0.1", "of the steps, in the long run"}}},
      {"wheel_slip",
       "a wheel slips on the floor",
       "A share of the rim's way is no way over the floor, as on oil or dust. Steps are made and counted.",
       "the wheel turned",
       true,
       nullptr,
       {kWheel, {"share", Type::Number, "", 0, 1, "", "0.3", "of the rim's way that is lost"}}},
      {"bytes_lost",
       "bytes get lost on a serial line",
       "Between the processor's UART and whatever is plugged in a byte does not arrive, each with that "
       "chance. "
       "Random numbers of the line's own, counted byte by byte. Bytes that had begun to come stay as they "
       "are.",
       "a byte that was sent did not arrive",
       true,
       nullptr,
       {kUart, kDirection, kShareOfBytes}},
      {"bytes_garbled",
       "bytes arrive as others",
       "One of a byte's eight bits is turned over on the way, each byte with that chance.",
       "a byte that was sent arrived as another",
       true,
       nullptr,
       {kUart, kDirection, kShareOfBytes}},
      {"line_cut",
       "a wire of a serial line is cut",
       "No byte passes; the line idles high.",
       "a byte that was sent did not arrive",
       true,
       nullptr,
       {kUart, kDirection}},
      {"battery_sag",
       "the battery's voltage breaks in",
       "The cell's voltage at rest is lower by so much, and so much more resistance lies in series: the "
       "terminals "
       "fall further the more the robot draws.",
       "the low-battery detector, or the count of the battery's voltage (revision 1.3), differed",
       true,
       nullptr,
       {{"drop_v", Type::Number, "V", 0, 2, "", "0.6", "by which the cell's own voltage is lower"},
        {"more_ohm", Type::Number, "ohm", 0, 20, "", "0", "added to its inner resistance"}}},
      {"bump",
       "somebody shoves the robot",
       "A blow of that impulse changes the body's speed at once by impulse over mass; the wheels' grip then "
       "brakes "
       "it. The kinematic engine knows no forces: nothing happens there.",
       "the body's speed changed",
       false,
       nullptr,
       {{"impulse_n_s", Type::Number, "N s", 0, 10, "", "0.05", "how hard"},
        {"direction_deg", Type::Number, "deg", -360, 360, "", "0",
         "in which direction, as the robot looks: 0 forward, 90 to its left"},
        {"spin_deg_s", Type::Number, "deg/s", -3600, 3600, "", "0", "added to how fast it turns"}}},
      {"lifted",
       "somebody lifts the robot",
       "The body is held still in the air: wheels turn and move nothing, proximity sensors look at nothing, "
       "other "
       "robots' rays and bodies pass below. The accelerometer feels the robot at rest. It is put down where "
       "it was. "
       "On worlds with ramps, and with the planar engine, the body stays in the way.",
       "the body left the floor, a wheel turned, or a sample differed",
       true,
       nullptr,
       {{"height_m", Type::Number, "m", 0.01, 5, "", "0.3", "of the body above the floor"}}},
      {"crystal_slow",
       "the processor's crystal is off",
       "Instruction cycles come that much slower than they should, and with them everything that they time, "
       "serial "
       "lines too, whose far end follows. Adds to the robot's own error.",
       "a whole cycle was missing",
       true,
       nullptr,
       {{"ppm", Type::Number, "ppm", -500000, 500000, "", "5000",
         "parts per million slower; negative: faster"}}},
      {"microphone_silent",
       "a microphone hears nothing",
       "No sound gets through to its membrane. The amplifier's level and noise stay.",
       "a sample differed by a count or more from what was to be heard",
       true,
       nullptr,
       {{"microphone", Type::Integer, "", 0, 2, "", "", "0 right, 1 left, 2 back; without it all"}}},
      {"accelerometer_stuck",
       "the accelerometer's outputs stand still",
       "All axes keep what they had at that moment. Of revision 1.3 the data registers keep the last sample "
       "and "
       "no new one is told; its gyroscope goes on.",
       "a sample differed, or (revision 1.3) a new one was due",
       true,
       nullptr,
       {}},
      {"led_dead",
       "an LED is broken",
       "It is open: switched on it gives no light, to cameras and eyes, and draws no current.",
       "the program had it switched on",
       true,
       nullptr,
       {{"led", Type::Integer, "", 0, 9, "", "", "0 to 7 the ring, 8 body, 9 front; without it all"}}},
      {"camera_covered",
       "something covers the camera's lens",
       "No light reaches the sensor: lines that begin meanwhile are black, with the sensor's own noise, and "
       "the "
       "automatics open up.",
       "a line of a picture was exposed",
       true,
       nullptr,
       {}},
      {"bytes_sent",
       "somebody sends bytes to the robot",
       "They come over the line to the UART behind one another at its rate, as soon as the program has set "
       "it up, "
       "whatever else is plugged in.",
       "the first of them came to a UART that is on",
       false,
       "send",
       {{"bytes", Type::Bytes, "", 0, 0, "", "required",
         "a text, each character a byte up to U+00FF; \\r as TOML writes it"},
        kUart}},
      {"key_pressed",
       "somebody presses a key of a remote control",
       "An RC5 transmitter sends its code while it is held; the receiver's pin follows.",
       "it was pressed",
       false,
       "press",
       {{"key", Type::Integer, "", 0, 63, "", "required", "0 to 9 the digits, 12 standby, 16 and 17 volume"},
        {"hold_s", Type::Number, "s", 0, 1000, "", "0.1", "for how long"},
        {"address", Type::Integer, "", 0, 31, "", "0", "kind of device; 0 is a television"}}},
      {"selector_turned",
       "somebody turns the selector",
       "Its four lines have another level from then on.",
       "the position changed",
       false,
       "turn",
       {{"position", Type::Integer, "", 0, 15, "", "required", "to which position"}}},
      {"robot_moved",
       "somebody puts the robot somewhere else",
       "It stands there, at rest. That way is no part of its distance.",
       "its place or heading changed",
       false,
       "move",
       {{"to", Type::Triple, "m, m, deg", -1000, 1000, "", "required", "x, y and heading"}}},
      {"pin_forced",
       "a pin is held at a level",
       "A wire of low resistance to ground or to the supply: inputs of the board (selector, remote control, "
       "battery) read it, LEDs follow it whatever the program drives.",
       "the level differed from the one without the wire",
       true,
       "pin",
       {{"pin", Type::Text, "", 0, 0, "", "required", "port and bit: F1, F6, G6 to G9, A6 ... A15, C1, C2"},
        {"level", Type::Integer, "", 0, 1, "", "1", "0 low, 1 high"}}},
      {"variable_set",
       "a variable of the program gets a value",
       "As a debugger writes it: bytes in the chip's memory change between two instructions.",
       "its bytes changed",
       false,
       "set",
       {{"variable", Type::Text, "", 0, 0, "", "required",
         "a global or static, an element or member: speed[1]"},
        {"value", Type::Number, "", -1e15, 1e15, "", "0", "cut to the variable's width"}}},
      {"reset_pressed",
       "somebody presses the reset button",
       "The processor begins anew; motors stop where they are.",
       "it was pressed",
       false,
       "reset",
       {}},
  };
  return kAll;
}

const Kind* find_kind(const std::string& name) {
  for (const Kind& kind : kinds())
    if (name == kind.name) return &kind;
  return nullptr;
}

std::vector<std::string> kind_names() {
  std::vector<std::string> names;
  for (const Kind& kind : kinds()) names.push_back(kind.name);
  return names;
}

}  // namespace faults
