// SPDX-License-Identifier: MIT
// See lsm330.h. Random streams: kStreamBoard + 36 .. 41.
#include "hal_sim/board/lsm330.h"

#include <algorithm>
#include <cmath>

#include "hal_sim/board/accelerometer.h"
#include "hal_sim/board/specimen.h"
#include "sim_core/base/hash.h"
#include "sim_core/random/counter_random.h"

namespace board {

namespace {

enum : int {
  kCtrlRate = 0x20,
  kGyroCtrl4 = 0x23,
  kAccCtrlRange = 0x24,
  kAccCtrlIncrement = 0x25,
  kGyroTemperature = 0x26,
  kStatus = 0x27,
  kData = 0x28,
  kDataEnd = 0x2E
};
constexpr std::uint8_t kGyroWho = 0xD4;  // [LSM330 table 75]
constexpr double kAccRateHz[16] = {0,   3.125, 6.25, 12.5, 25, 50, 100, 400,
                                   800, 1600,  0,    0,    0,  0,  0,   0};  // [LSM330 table 30]
constexpr double kAccRangeFactor[8] = {1, 2, 3, 4, 12, 1, 1, 1};             // [LSM330 table 3]
constexpr double kGyroRateHz[4] = {95, 190, 380, 760};                       // [LSM330 table 77]
constexpr double kGyroCutHz[4][4] = {
    {12.5, 25, 25, 25}, {12.5, 25, 50, 70}, {20, 25, 50, 100}, {30, 35, 50, 100}};  // [LSM330 table 77]
constexpr double kGyroRangeFactor[4] = {1, 2, 8, 8};                                // [LSM330 table 4]
constexpr double kAccBandHz = 800;  // anti-aliasing filter as it is after power-up [LSM330 table 39]
constexpr std::uint32_t kStream = sim::kStreamBoard + 36;
constexpr double kHalfPi = 1.5707963267948966;
constexpr double kDegPerRad = 57.29577951308232;

}  // namespace

Lsm330::Lsm330(const Specimen& robot) : robot_(robot) { begin_again(0); }

void Lsm330::begin_again(Cycle at) {
  acc_ = gyro_ = Half{};
  acc_.since = gyro_.since = at;
  addressed_ = nullptr;
  expects_register_ = increments_ = false;
  number_ = 0;
  gyro_.gyro = true;
  acc_.registers[kLsmWhoAmI] = kLsmAccWho;
  acc_.registers[kCtrlRate] = 0x07;
  acc_.registers[kAccCtrlIncrement] = 0x10;
  gyro_.registers[kLsmWhoAmI] = kGyroWho;
  gyro_.registers[kCtrlRate] = 0x07;
  gyro_.registers[kGyroTemperature] = kLsmTemperature;
}

bool Lsm330::answers_to(std::uint8_t address) const {
  return address == kLsmAccAddress || address == kLsmGyroAddress;
}

void Lsm330::begin(std::uint8_t address, bool reading, Cycle) {
  addressed_ = address == kLsmGyroAddress ? &gyro_ : &acc_;
  expects_register_ = !reading;
}

bool Lsm330::write(std::uint8_t byte, Cycle at) {
  if (!addressed_) return false;
  if (expects_register_) {
    expects_register_ = false;
    number_ = byte & 0x3F;
    increments_ =
        addressed_->gyro ? (byte & 0x80) != 0 : (addressed_->registers[kAccCtrlIncrement] & 0x10) != 0;
    return true;
  }
  set(*addressed_, number_, byte, at);
  if (increments_) number_ = (number_ + 1) & 0x3F;
  return true;
}

std::uint8_t Lsm330::read(Cycle at) {
  if (!addressed_) return 0xFF;
  const int number = number_;
  if (increments_) number_ = (number_ + 1) & 0x3F;
  if (number >= kData && number < kDataEnd) return data_byte(*addressed_, number - kData, at);
  if (number == kStatus) {
    const std::int64_t fresh = newest(*addressed_, at) - addressed_->read_sample;
    return static_cast<std::uint8_t>((fresh > 0 ? 0x0F : 0) | (fresh > 1 ? 0xF0 : 0));
  }
  return addressed_->registers[static_cast<std::size_t>(number)];
}

void Lsm330::set(Half& half, int number, std::uint8_t value, Cycle at) {
  const bool fixed = number == kLsmWhoAmI || number == kStatus || (number >= kData && number < kDataEnd) ||
                     (half.gyro && number == kGyroTemperature);
  if (fixed) return;
  const double rate_before = rate_hz(half);
  if (number == kCtrlRate) this->value(half, 0, at);  // what it showed last stays while it is off
  half.registers[static_cast<std::size_t>(number)] = value;
  if (number != kCtrlRate || rate_hz(half) == rate_before) return;
  half.since = at;
  ++half.epoch;
  half.read_sample = half.known_sample = -1;
}

double Lsm330::rate_hz(const Half& half) const {
  const std::uint8_t control = half.registers[kCtrlRate];
  if (!half.gyro) return kAccRateHz[control >> 4];
  return control & 0x08 ? kGyroRateHz[control >> 6] : 0;
}

bool Lsm330::is_block_update(const Half& half) const {
  return half.gyro ? (half.registers[kGyroCtrl4] & 0x80) != 0 : (half.registers[kCtrlRate] & 0x08) != 0;
}

/// Number of the newest sample, -1 before the first. Sample n is taken (n + 1) periods after the beginning.
std::int64_t Lsm330::newest(const Half& half, Cycle at) const {
  // outputs that stand still have the last sample of before, and say that none is new
  if (const Damage* damage = robot_.damage(); damage && !half.gyro && damage->acc_stuck.at(at) != 0) {
    if (newest_of(half, at) != newest_of(half, damage->acc_since)) damage->note(damage->acc_stood_still, at);
    at = std::min(at, damage->acc_since);
  }
  return newest_of(half, at);
}

std::int64_t Lsm330::newest_of(const Half& half, Cycle at) const {
  const double rate = rate_hz(half);
  if (rate == 0) return half.known_sample;
  return static_cast<std::int64_t>(static_cast<double>(at - half.since) * rate /
                                   static_cast<double>(kFcyHz)) -
         1;
}

std::int16_t Lsm330::value(Half& half, int axis, Cycle at) {
  const std::int64_t sample = newest(half, at);
  if (sample > half.known_sample) {
    // A new sample: what the part feels at the instant at which it was taken.
    const std::uint8_t control = half.registers[kCtrlRate];
    const Cycle taken = half.since + static_cast<Cycle>(static_cast<double>(sample + 1) *
                                                        static_cast<double>(kFcyHz) / rate_hz(half));
    double scale, noise, band_hz;
    sim::Vec3 felt;
    if (half.gyro) {
      band_hz = kGyroCutHz[control >> 6][control >> 4 & 3];
      felt = felt_turn_rad_s(robot_, taken, band_hz);
      const double per_dps = kLsmGyroPerDps / kGyroRangeFactor[half.registers[kGyroCtrl4] >> 4 & 3];
      scale = kDegPerRad * per_dps;
      noise = per_dps * kLsmGyroNoiseDpsPerRtHz * std::sqrt(kHalfPi * band_hz);
    } else {
      band_hz = std::min(kAccBandHz, 0.5 * rate_hz(half));
      felt = felt_force_m_s2(robot_, taken, kAccBandHz);
      const double per_g = kLsmAccPerG / kAccRangeFactor[half.registers[kAccCtrlRange] >> 3 & 7];
      scale = per_g / kStandardGravityMS2;
      noise = per_g * kLsmAccNoiseGPerRtHz * std::sqrt(kHalfPi * band_hz);
    }
    const double parts[3] = {felt.x, felt.y, felt.z};
    // In counts, with the noise of this very sample, rounded and limited.
    for (int i = 0; i < 3; ++i) {
      double counts = scale * parts[i];
      if (robot_.setup().motion_noise_scale > 0) {
        const sim::RandomKey key{robot_.setup().seed, static_cast<std::uint32_t>(robot_.setup().robot),
                                 kStream + static_cast<std::uint32_t>(3 * half.gyro + i)};
        counts += robot_.setup().motion_noise_scale * noise *
                  sim::random_gaussian(key, half.epoch << 40 | static_cast<std::uint64_t>(sample));
      }
      // enable bits: x lowest
      if (!(control >> i & 1)) counts = 0;
      half.known[static_cast<std::size_t>(i)] =
          static_cast<std::int16_t>(std::clamp(std::floor(counts + 0.5), -32768.0, 32767.0));
    }
    half.known_sample = sample;
  }
  return half.known[static_cast<std::size_t>(axis)];
}

std::uint8_t Lsm330::data_byte(Half& half, int number, Cycle at) {
  const std::size_t axis = static_cast<std::size_t>(number / 2);
  const bool high = number % 2 == 1;
  std::int16_t word;
  if (high && half.holding[axis] && is_block_update(half)) {
    word = half.held[axis];
  } else {
    word = value(half, static_cast<int>(axis), at);
    half.held[axis] = word;
    half.read_sample = std::max(half.read_sample, half.known_sample);
  }
  half.holding[axis] = !high;
  return static_cast<std::uint8_t>(static_cast<std::uint16_t>(word) >> (high ? 8 : 0));
}

std::uint64_t Lsm330::state_hash() const {
  std::uint64_t h = number_;
  for (const Half* half : {&acc_, &gyro_}) {
    for (std::uint8_t value : half->registers) h = sim::fold(h, std::uint64_t{value});
    h = sim::fold(h, static_cast<std::uint64_t>(half->since));
  }
  return h;
}

}  // namespace board
