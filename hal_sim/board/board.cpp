// SPDX-License-Identifier: MIT
// See board.h; pins: wiring.h.
#include "hal_sim/board/board.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "hal_sim/board/accelerometer.h"
#include "hal_sim/board/lsm330.h"
#include "hal_sim/board/parts_params.h"
#include "hal_sim/board/remote_params.h"
#include "hal_sim/board/sound_bank.h"
#include "sim_core/base/hash.h"
#include "sim_core/base/portable_math.h"
#include "sim_core/light/proximity.h"
#include "sim_core/sound/sound_field.h"

namespace board {

namespace {

constexpr std::uint16_t kImplemented[] = {0xF6C0, 0xFFFF, 0xE01E, 0xFFFF, 0x01FF, 0xF3CF};  // [DS70143 3.2]

constexpr std::uint16_t bit(int n) { return static_cast<std::uint16_t>(1u << n); }
constexpr int kOnes[16] = {0, 1, 1, 2, 1, 2, 2, 3, 1, 2, 2, 3, 2, 3, 3, 4};
constexpr std::uint16_t kRingMask = mask(kA, kRingLedPins);
constexpr std::uint16_t kNearLeds = mask(kC, kFrontLedPin, kBodyLedPin);  // that a pulse driver may flash

constexpr double kMicLoudest = 1e6;                       // counts; beyond what any converter tells apart
constexpr std::int64_t kOpenEnd = std::int64_t{1} << 40;  // samples of a sound whose end is not known

std::int64_t to_ppb(double ppm) { return static_cast<std::int64_t>(std::llround(ppm * 1000.0)); }

}  // namespace

Board::Board(const Setup& setup)
    : clock_(to_ppb(setup.clock_ppm), sim::from_seconds(setup.boot_delay_s)),
      setup_(setup),
      battery_(setup.battery_wh, setup.battery_v, kProcessorA + kBluetoothA + kBoardA),
      noise_(setup.seed, setup.robot),
      mic_noise_per_face_(
          std::llround(setup.mic_noise_counts * SampleNoise::kPerFace * (1 << kMicFraction))) {
  for (std::size_t i = 0; i < kPorts; ++i) tris_[i] = kImplemented[i];
  if (setup.camera != CameraKind::None) {
    auto sensor = std::make_unique<CameraSensor>(setup.camera);
    camera_ = std::make_unique<Camera>(*this, *sensor, setup.camera_mount, setup.camera_noise);
    i2c_.attach(std::move(sensor));
    // bits 0 and 1: 1 upright, 2 inverted, 3 sideways [lib: camera/fast_2_timer/e_common.c]
    eeprom_.set_factory_word(setup.camera_mount == CameraMount::Upright    ? 0xFFFD
                             : setup.camera_mount == CameraMount::Inverted ? 0xFFFE
                                                                           : 0xFFFF);
  }
  if (setup.revision == Revision::Rev13) i2c_.attach(std::make_unique<Lsm330>(*this));
  for (Uart& uart : uarts_) uart.first_use.tell(is_any_used_);
  codec_.first_use.tell(is_any_used_);
  codec_.line().first_use.tell(is_any_used_);
  eeprom_.first_use.tell(is_any_used_);
  if (camera_) camera_->first_use.tell(is_any_used_);
  is_any_used_ = setup.revision == Revision::Rev13;  // its sensors are asked at the start
}

Board::~Board() = default;

int Board::port_index(char port) {
  constexpr signed char kIndex[] = {0, 1, 2, 3, -1, 4, 5};  // A B C D, no E, F G
  return port >= 'A' && port <= 'G' ? kIndex[port - 'A'] : -1;
}

void Board::find_sound() { may_hear_ = scene_ && sim::has_sound(*scene_); }

// --- motors

Stepper& Board::stepper(Wheel wheel, Cycle at) {
  if (driver_) driver_->bring_motor(wheel, at);
  return own_motor(wheel);
}

double Board::wheel_angle_rad(Wheel wheel, Cycle at) const {
  const double steps = stepper_at(wheel, at).position(at);
  return steps * (sim::kTwoPi / kStepsPerTurn) * setup_.wheel_ratio[static_cast<std::size_t>(wheel)];
}

WheelTurn Board::wheel_turn(Wheel wheel, Cycle at) const {
  const double rad_per_step =
      sim::kTwoPi / kStepsPerTurn * setup_.wheel_ratio[static_cast<std::size_t>(wheel)];
  const Stepper& own = motors_[static_cast<std::size_t>(wheel)];
  const RotorCourse rotor = driver_ ? driver_->motor_course(wheel, at) : own.course(at);
  return {rotor.steps * rad_per_step, rotor.rate * rad_per_step, rotor.until};
}

std::int64_t Board::steps(Wheel wheel, Cycle at) const { return stepper_at(wheel, at).steps(); }

unsigned Board::coils(Wheel wheel, Cycle at) const { return stepper_at(wheel, at).coils(); }

void Board::connect_steppers(Cycle at) {
  stepper(Wheel::Left, at).connect((tris_[kD] & kLeftCoils) == 0, at);
  stepper(Wheel::Right, at).connect((tris_[kD] & kRightCoils) == 0, at);
}

// --- ports

std::uint16_t Board::port_read(char port, Register reg, Cycle at) const {
  const int index = port_index(port);
  if (index < 0) return 0;
  const std::uint16_t tris = tris_[static_cast<std::size_t>(index)];
  if (reg == Register::Tris) return tris;

  std::uint16_t lat = lat_[static_cast<std::size_t>(index)];
  if (index == kD)
    lat = static_cast<std::uint16_t>((lat & kCameraData) | coils(Wheel::Right, at) << kRightCoilsBit |
                                     coils(Wheel::Left, at));
  if (index == kF || index == kG || index == kC) {
    const unsigned on = pulses(at);
    for (int pair = 0; pair < 4; ++pair)
      if (on & (1u << pair) && kEmitterPins[pair].port == index) lat |= kEmitterPins[pair].mask();
    if (index == kC && on & 16u) lat |= kNearLeds;
  }
  if (reg == Register::Lat) return lat;

  // levels that the board puts on input pins; open pins read 0, idle serial lines and pull-ups 1
  std::uint16_t level = 0;
  if (index == kF) {
    level = mask(kF, kUartInPins, kUartOutPins);
    if (battery_.voltage(at) >= kBatteryLowV) level |= kBatteryGoodPin.mask();
    if (remote_.level(at)) level |= kRemotePin.mask();
  }
  if (index == kG)
    level = static_cast<std::uint16_t>((setup_.selector & 15) << kSelectorPins[0].bit | mask(kG, kI2cPins));
  const auto pins = static_cast<std::uint16_t>((lat & ~tris) | (level & tris));
  return with_held_pins(index, pins) & kImplemented[index];
}

void Board::port_write(char port, Register reg, std::uint16_t value, Cycle at) {
  const int index = port_index(port);
  if (index < 0) return;
  const std::size_t i = static_cast<std::size_t>(index);
  value &= kImplemented[index];
  if (reg == Register::Tris) {
    note_pulses(i, lat_[i], value, at);
    tris_[i] = value;
    if (index == kD) connect_steppers(at);
    outputs_changed(at);
    return;
  }
  // The chip's own program drives: the two frequent cases, coils and emitters, are short.
  if (is_led_by_pins()) {
    if (index == kD) return write_coils(value, at);
    if (value == lat_[i]) return;
    if (!((value ^ lat_[i]) & ~kEmitterMask[i])) return write_emitters(i, value, at);
  }
  // Coils: each motor whose pattern changed follows.
  if (index == kD) {
    for (Wheel wheel : {Wheel::Left, Wheel::Right}) {
      const unsigned coils = (value >> (wheel == Wheel::Left ? 0 : kRightCoilsBit)) & 15u;
      if (coils != this->coils(wheel, at)) stepper(wheel, at).energise(coils, at);
    }
    lat_[i] = value & kCameraData;
    follow_power(at);
    return;
  }
  // Emitters: a line that rises begins a pulse.
  for (int pair = 0; pair < 4; ++pair) {
    const Pin line = kEmitterPins[pair];
    if (line.port != index) continue;
    // a driver that owns the lines switches them off itself; a read-modify-write must not latch its pulse
    if (owns_emitters()) value = static_cast<std::uint16_t>(value & ~line.mask());
    if (value & ~lat_[i] & line.mask()) line_since_[static_cast<std::size_t>(pair)] = at;
  }
  if (index == kC && camera_ && lat_[i] & ~value & kCameraResetPin.mask()) camera_->sensor_reset(at);
  if (index == kC && pulses(at) & 16u) value = static_cast<std::uint16_t>(value & ~kNearLeds);
  if (value == lat_[i]) return;
  note_pulses(i, value, tris_[i], at);
  lat_[i] = value;
  outputs_changed(at);
}

// a robot whose drivers are its own program, on the models of the chip
bool Board::is_led_by_pins() const { return is_soldered_ && !driver_ && parts_.empty(); }

void Board::write_coils(std::uint16_t value, Cycle at) {
  bool same_current = true;
  for (const Wheel wheel : {Wheel::Left, Wheel::Right}) {
    const unsigned coils = (value >> (wheel == Wheel::Left ? 0 : kRightCoilsBit)) & 15u;
    Stepper& motor = own_motor(wheel);
    if (coils == motor.coils()) continue;
    same_current &= kOnes[coils] == kOnes[motor.coils()];
    motor.energise(coils, at);
  }
  lat_[kD] = value & kCameraData;
  if (!same_current) follow_motors(at);
}

void Board::write_emitters(std::size_t port, std::uint16_t value, Cycle at) {
  const unsigned risen = value & ~static_cast<unsigned>(lat_[port]);
  for (std::size_t pair = port == kF ? 0 : 2, end = pair + 2; pair < end; ++pair)
    if (risen & kEmitterPins[pair].mask()) line_since_[pair] = at;
  note_pulses(port, value, tris_[port], at);
  lat_[port] = value;
  // all else draws what it drew
  const int lines = __builtin_popcount(static_cast<unsigned>(lat_[kF] & ~tris_[kF] & kEmitterMask[kF])) +
                    __builtin_popcount(static_cast<unsigned>(lat_[kG] & ~tris_[kG] & kEmitterMask[kG]));
  emitters_a_ = 2 * kIrEmitterA * lines;
  draw(at);
}

void Board::outputs_changed(Cycle at) {
  codec_.power(output_high(kCodecOnPin), at);
  for (const auto& part : parts_) part->pins_changed(at);
  follow_power(at);
}

bool Board::output_high(Pin pin) const {
  return (lat_[pin.port] & ~static_cast<unsigned>(tris_[pin.port]) & pin.mask()) != 0;
}

void Board::latch_bit(char port, int n, bool level, Cycle at) {
  const std::uint16_t old = port_read(port, Register::Lat, at);
  port_write(port, Register::Lat, static_cast<std::uint16_t>(level ? old | bit(n) : old & ~bit(n)), at);
}

Cycle Board::port_horizon(char port, Cycle at) const {
  switch (port_index(port)) {
    case kD:
      return driver_
                 ? std::min(driver_->coils_horizon(Wheel::Left, at), driver_->coils_horizon(Wheel::Right, at))
                 : kNever;
    case kF:
      return std::min({driver_ ? driver_->pulses_horizon(at) : kNever, battery_.below(kBatteryLowV, at),
                       remote_.horizon(at)});
    case kC:
    case kG:
      return driver_ ? driver_->pulses_horizon(at) : kNever;
    default:
      return kNever;
  }
}

std::uint32_t Board::leds(Cycle at) const {
  const std::uint32_t driven = driven_leds(at);
  return damage_ ? driven & ~damage_->dead_leds : driven;
}

std::uint32_t Board::driven_leds(Cycle at) const {
  const unsigned ring =
      with_held_pins(kA, static_cast<std::uint16_t>(lat_[kA] & ~static_cast<unsigned>(tris_[kA]))) &
      kRingMask;
  std::uint32_t mask = 0;
  for (int led = 0; ring && led < 8; ++led)
    if (ring & kRingLedPins[led].mask()) mask |= 1u << led;
  unsigned other = lat_[kC];
  if (pulses(at) & 16u) other |= kNearLeds;
  other &= ~static_cast<unsigned>(tris_[kC]);
  other = with_held_pins(kC, static_cast<std::uint16_t>(other));
  if (other & kBodyLedPin.mask()) mask |= 1u << 8;
  if (other & kFrontLedPin.mask()) mask |= 1u << 9;
  return mask;
}

void Board::init_ports(Cycle at) {
  lat_[kA] = static_cast<std::uint16_t>(lat_[kA] & ~kRingMask);
  tris_[kA] = static_cast<std::uint16_t>(tris_[kA] & ~kRingMask);
  const std::uint16_t outputs_c = kNearLeds | kCameraResetPin.mask();
  lat_[kC] = static_cast<std::uint16_t>(lat_[kC] & ~outputs_c);
  tris_[kC] = static_cast<std::uint16_t>(tris_[kC] & ~outputs_c);
  const std::uint16_t outputs_f = kCodecOnPin.mask() | kEmitterMask[kF];
  lat_[kF] = static_cast<std::uint16_t>(lat_[kF] & ~outputs_f);
  tris_[kF] =
      static_cast<std::uint16_t>((tris_[kF] & ~outputs_f) | kBatteryGoodPin.mask() | kRemotePin.mask());
  codec_.power(false, at);
  const std::uint16_t outputs_g = kEmitterMask[kG] | mask(kG, kI2cPins);
  lat_[kG] = static_cast<std::uint16_t>(lat_[kG] & ~outputs_g);
  tris_[kG] = static_cast<std::uint16_t>((tris_[kG] & ~outputs_g) | mask(kG, kSelectorPins));
  // coils last: a running driver energises them again at its next step
  tris_[kD] = kCameraData;
  connect_steppers(at);
  stepper(Wheel::Left, at).set_coils_only(0);
  stepper(Wheel::Right, at).set_coils_only(0);
  follow_power(at);
}

void Board::processor_reset(Cycle at) {
  if (driver_) driver_->processor_reset(at);
  for (Stepper& motor : motors_) {
    motor.connect(false);
    motor.set_coils_only(0);
  }
  codec_.reset(at);
  for (Uart& uart : uarts_) uart.reset(at);
  i2c_.processor_reset(at);
  for (std::size_t i = 0; i < kPorts; ++i) note_pulses(i, 0, tris_[i], at);
  lat_.fill(0);
  for (std::size_t i = 0; i < kPorts; ++i) tris_[i] = kImplemented[i];
  follow_power(at);
  for (const auto& part : parts_) part->processor_reset(at);
}

void Board::begin_again(sim::Clicks now, Cycle at) {
  clock_.begin_again(now);
  for (Stepper& motor : motors_) motor.begin_again(at);
  for (Uart& uart : uarts_) uart.begin_again(at);
  i2c_.begin_again(at);
  if (camera_) camera_->begin_again(at);
  packets_.begin_again();
  eeprom_.begin_again();
  line_since_.fill(at);
  lit_since_.fill(at);
  noise_.begin_at(at);
  for (Stepper& motor : motors_) motor.lose_steps(nullptr);
  damage_.reset();
  battery_.weaken(0, 0, at);
  battery_.begin_again(setup_.battery_v, kProcessorA + kBluetoothA + kBoardA, at);
  follow_power(at);
}

void Board::plug_in(std::unique_ptr<Part> part) {
  part->board_ = this;
  is_any_used_ = true;
  parts_.push_back(std::move(part));
  parts_.back()->connect();
}

std::optional<double> Board::part_analogue_v(int channel, Cycle at) const {
  for (const auto& part : parts_)
    if (const auto level_v = part->analogue_v(channel, at)) return level_v;
  return std::nullopt;
}

std::optional<int> Board::counts_of_others(int channel, Cycle at) const {
  if (const auto level_v = part_analogue_v(channel, at))
    return static_cast<int>(
        std::clamp(std::floor(*level_v / kAdcReferenceV * (kAdcMax + 1)), 0.0, double{kAdcMax}));
  if (setup_.revision == Revision::Analogue || channel < kAccChannel) return std::nullopt;
  return channel == kBatteryChannel ? battery_counts(at) : 0;  // 5 and 6 are open
}

void Board::turn_selector(int position) { setup_.selector = position & 15; }

void Board::set_battery(double volts, Cycle at) { battery_.set_voltage(volts, at); }

void Board::exchange(Cycle at) {
  if (is_any_used_) {
    for (Uart& uart : uarts_) {
      uart.exchange(at);
      has_wire_news_ |= uart.has_on_wire();
    }
    codec_.forget(at);
  }
  if (driver_) driver_->exchange(at);
}

Cycle Board::horizon(Cycle at) const {
  // packets wait in their queues until the program looks
  const bool has_news_of_its_own =
      is_any_used_ && (!uarts_[0].is_quiet() || !uarts_[1].is_quiet() || !parts_.empty() ||
                       codec_.was_used() || (camera_ && camera_->is_used()));
  if (has_news_of_its_own) return at;
  return driver_ ? driver_->horizon(at) : kNever;
}

// --- analogue inputs

IrConversion Board::ir_conversion(int sensor, Cycle at, Cycle lit_for) const {
  const std::size_t i = static_cast<std::size_t>(sensor);
  IrConversion c;
  if (scene_) {
    const sim::Clicks when = clock_.click_at(at);
    if (is_lit_) c.irradiance_w_m2 = sim::sense_irradiance_w_m2(*scene_, setup_.robot, sensor, when);
    if (lit_for >= 0) {
      const sim::ProximityResponse seen = sim::sense_proximity(*scene_, setup_.robot, sensor, when);
      c.reflection_counts = seen.value * setup_.ir_gain[i];
      c.relative_noise = seen.relative_noise;
      c.uniform_noise = seen.uniform_noise;
    }
  }
  c.light_counts = c.irradiance_w_m2 * setup_.ambient_counts_per_w_m2;
  if (lit_for >= 0) {
    c.offset_counts = setup_.ir_offset_counts[i];
    c.settled = settled_share(sensor, lit_for);
  }
  return c;
}

// the phototransistor follows the flash with one time constant; after 300 us nothing is missing
inline double Board::settled_share(int sensor, Cycle lit_for) const {
  if (lit_for >= 40 * kIrSettleCycles) return 1;
  Settled& kept = settled_[sensor < kRingSensors / 2 ? 0 : 1];
  if (lit_for != kept.lit_for)
    kept = {lit_for, 1.0 - std::exp(-static_cast<double>(lit_for) / static_cast<double>(kIrSettleCycles))};
  return kept.share;
}

__attribute__((always_inline)) inline double Board::reflected_counts(int sensor, Cycle at,
                                                                     Cycle lit_for) const {
  const std::size_t i = static_cast<std::size_t>(sensor);
  double reflection = 0;
  if (scene_) {
    const sim::ProximityResponse seen =
        sim::sense_proximity(*scene_, setup_.robot, sensor, clock_.click_at(at));
    reflection = seen.value * setup_.ir_gain[i];
    if (reflection != 0 && seen.relative_noise > 0 && setup_.ir_noise_scale > 0) {
      const double noise = seen.uniform_noise ? noise_.uniform(NoiseOf::Reflection, sensor, at)
                                              : noise_.normal(NoiseOf::Reflection, sensor, at);
      reflection *= 1.0 + noise * seen.relative_noise * setup_.ir_noise_scale;
    }
  }
  return (reflection + setup_.ir_offset_counts[i]) * settled_share(sensor, lit_for);
}

int Board::ir_counts(int sensor, Cycle at, Cycle lit_for) const {
  if (damage_) return damaged_ir_counts(sensor, at, lit_for);
  const bool lit = lit_for >= 0;
  if (is_dark()) return lit ? adc_counts(kAdcMax - reflected_counts(sensor, at, lit_for)) : kAdcMax;
  double light = 0;
  if (scene_ && is_lit_)
    light = sim::sense_irradiance_w_m2(*scene_, setup_.robot, sensor, clock_.click_at(at)) *
            setup_.ambient_counts_per_w_m2;
  if (setup_.ambient_noise_counts > 0)
    light += setup_.ambient_noise_counts *
             noise_.normal(lit ? NoiseOf::AmbientLit : NoiseOf::AmbientDark, sensor, at);
  return adc_counts(kAdcMax - light - (lit ? reflected_counts(sensor, at, lit_for) : 0));
}

/// ir_counts() with all that may be wrong, one thing behind the other.
int Board::damaged_ir_counts(int sensor, Cycle at, Cycle lit_for) const {
  const bool lit = lit_for >= 0;
  const Damage::Sensor& wrong = damage_->sensors[static_cast<std::size_t>(sensor)];
  double light = 0, noise = 0;
  if (scene_ && is_lit_)
    light = sim::sense_irradiance_w_m2(*scene_, setup_.robot, sensor, clock_.click_at(at)) *
            setup_.ambient_counts_per_w_m2;
  if (setup_.ambient_noise_counts > 0)
    noise = setup_.ambient_noise_counts *
            noise_.normal(lit ? NoiseOf::AmbientLit : NoiseOf::AmbientDark, sensor, at);
  const double settled = lit ? settled_share(sensor, lit_for) : 0;
  double reflected = lit ? reflected_counts(sensor, at, lit_for) : 0;
  // in the order of a sum without damage, so that one which is over leaves the same numbers
  const auto counts = [&] { return adc_counts(kAdcMax - (light + noise) - reflected); };
  int before = counts();
  const auto noted = [&](const Noticed& what) {
    const int now = counts();
    if (now != before) damage_->note(what, at);
    before = now;
  };
  if (damage_->lifted.at(at) != 0) {
    reflected = lit ? setup_.ir_offset_counts[static_cast<std::size_t>(sensor)] * settled : 0;
    noted(damage_->saw_nothing);
  }
  if (const double lamp = wrong.lamp_w_m2.at(at); lamp != 0) {
    light += lamp * setup_.ambient_counts_per_w_m2;
    noted(wrong.lit);
  }
  if (const double cover = wrong.cover.at(at); cover >= 0) {
    light = 0;
    if (lit)
      reflected = (cover * setup_.ir_gain[static_cast<std::size_t>(sensor)] +
                   setup_.ir_offset_counts[static_cast<std::size_t>(sensor)]) *
                  settled;
    noted(wrong.covered);
  }
  if (const double passes = wrong.transmits.at(at); passes != 1) {
    light *= passes;
    reflected *= passes * passes;
    noted(wrong.dirty);
  }
  if (wrong.emitter_dead.at(at) != 0) {
    reflected = 0;
    noted(wrong.dead);
  }
  if (wrong.receiver_dead.at(at) != 0) {
    light = reflected = 0;
    noted(wrong.dead);
  }
  return before;
}

double Board::mic_level(int microphone, Cycle at) const {
  if (!scene_ || !sim::has_sound(*scene_)) return kMicIdleCounts;
  const Place& place = kMicrophone[microphone];
  return kMicIdleCounts + kMicCountsPerPa * sim::sense_sound_pa(*scene_, setup_.robot,
                                                                {place.x_m, place.y_m, kMicrophoneZM},
                                                                clock_.click_at(at));
}

int Board::mic_counts_in_sound(int microphone, Cycle at) const {
  double level = std::clamp(mic_level(microphone, at), -kMicLoudest, kMicLoudest);
  if (damage_ && damage_->deaf[static_cast<std::size_t>(microphone)].at(at) != 0) {
    // less than a count is nothing that a converter tells apart
    if (std::fabs(level - kMicIdleCounts) >= 1)
      damage_->note(damage_->heard_nothing[static_cast<std::size_t>(microphone)], at);
    level = kMicIdleCounts;
  }
  return with_mic_noise(std::llround((level + 0.5) * (1 << kMicFraction)), microphone, at);
}

void Board::publish_sound(sim::SoundField& field, sim::Clicks now) {
  sim::SpeakerTrack track;
  const auto sample_s = [&](Cycle cycles) {
    return static_cast<double>(cycles) / static_cast<double>(kFcyHz) /
           (1 + static_cast<double>(clock_.ppb()) * 1e-9);
  };
  track.pa_per_unit = kSpeakerFullScalePa / 32768;
  track.at_m = {kSpeaker.x_m, kSpeaker.y_m, kSpeakerZM};
  if (codec_.line().was_used()) {
    const CodecLine::Stretch* heard = codec_.line().publish();
    if (!heard) on_air_.reset();
    if (!heard) return field.stop(setup_.robot, now);
    if (heard->published == on_air_) return;  // the air has it, and sees what has been added
    on_air_ = heard->published;
    track.samples = heard->published;
    track.count = kOpenEnd;
    track.sample_s = sample_s(heard->period);
    // what is put out within a tick is known after it: everything leaves a tick and a sample late
    track.start_s = sim::to_seconds(clock_.click_at(heard->first_at) + field.tick()) + track.sample_s;
    return field.play(setup_.robot, track, now);
  }
  const Codec::Play& play = codec_.take_news();
  if (play.count == 0) return field.stop(setup_.robot, now);
  track.samples = sound_bank();
  track.first = play.first;
  track.count = play.count;
  track.start_s = sim::to_seconds(clock_.click_at(play.first_at));
  track.sample_s = sample_s(kCodecSampleCycles);
  field.play(setup_.robot, track, now);
}

Cycle Board::line_on_for(int sensor, Cycle at) const {
  const int pair = sensor & 3;
  const Pin line = kEmitterPins[pair];
  if (!(lat_[static_cast<std::size_t>(line.port)] & ~tris_[static_cast<std::size_t>(line.port)] &
        line.mask()))
    return -1;
  return at - line_since_[static_cast<std::size_t>(pair)];
}

int Board::convert(int channel, Cycle at) const {
  if (channel < 0 || channel > 15) return 0;
  if (channel >= kIrChannel) {
    const int sensor = channel - kIrChannel;
    Cycle lit_for = line_on_for(sensor, at);
    if (lit_for < 0 && pulses(at) & (1u << (sensor & 3))) lit_for = 40 * kIrSettleCycles;
    return ir_counts(sensor, at, lit_for);
  }
  if (channel >= kMicChannel && channel < kMicChannel + kMicrophones)
    return mic_counts(channel - kMicChannel, at);
  if (const auto counts = counts_of_others(channel, at)) return *counts;
  return channel >= kAccChannel ? accelerometer_counts(*this, channel - kAccChannel, at) : -1;
}

int Board::battery_counts(Cycle at) const {
  if (setup_.revision != Revision::Rev13) return 0;
  constexpr double kPerVolt = (kBatteryRawAt4V2 - kBatteryRawAt3V4) / (4.2 - 3.4);
  return static_cast<int>(std::lround(kBatteryRawAt3V4 + (battery_.voltage(at) - 3.4) * kPerVolt));
}

int Board::proximity_counts(int sensor, Cycle at) const {
  const Unseen unseen(*this);
  if (const auto counts = driver_ ? driver_->proximity_counts(sensor, at) : std::nullopt) return *counts;
  if (!scene_) return 0;
  if (damage_) return damaged_ir_counts(sensor, at, -1) - damaged_ir_counts(sensor, at, 40 * kIrSettleCycles);
  const sim::Clicks when = clock_.click_at(at);
  const double seen = sim::sense_proximity(*scene_, setup_.robot, sensor, when).value *
                      setup_.ir_gain[static_cast<std::size_t>(sensor)];
  return static_cast<int>(std::clamp(std::floor(seen + 0.5), 0.0, double{kAdcMax}));
}

std::uint64_t Board::state_hash(Cycle at) const {
  // a sum of products with odd numbers: the parts do not wait for one another; mixed once at the end
  std::uint64_t sum = driver_ ? driver_->state_sum(at) : 0;
  std::uint64_t factor = 0x9E3779B97F4A7C15u;
  const auto add = [&](std::uint64_t part) {
    sum += part * factor;
    factor += 0xD1B54A32D192ED02u;  // even, so the factor stays odd
  };
  // what a driver has made of them follows from its own state
  if (!driver_)
    for (const Stepper& motor : motors_) add(static_cast<std::uint64_t>(motor.steps()) << 4 ^ motor.coils());
  for (std::size_t i = 0; i < kPorts; ++i) add(lat_[i] | static_cast<std::uint64_t>(tris_[i]) << 16);
  if (!is_any_used_) return sim::mix64(sum);
  for (const Uart& uart : uarts_) add(uart.state_hash());
  // every robot has a camera on its bus; it counts once a program films
  const bool films = camera_ && camera_->is_used();
  if (films || i2c_.devices().size() > (camera_ ? 1u : 0u)) add(i2c_.state_hash());
  if (films) add(camera_->state_hash());
  if (codec_.was_used()) add(codec_.state_hash());
  for (const auto& part : parts_) add(part->state_hash());
  if (const std::uint64_t changes = eeprom_.state_hash()) add(changes);
  return sim::mix64(sum);
}

}  // namespace board
