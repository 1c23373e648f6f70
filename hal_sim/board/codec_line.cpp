// SPDX-License-Identifier: MIT
#include "hal_sim/board/codec_line.h"

#include <algorithm>
#include <cmath>

#include "hal_sim/board/sound_params.h"
#include "sim_core/base/hash.h"

namespace board {

namespace {

// control words and registers [SI3000]
constexpr std::uint16_t kAsks = 0x0001, kReads = 0x2000;
constexpr unsigned kControl1 = 1, kControl2 = 2, kDivider = 3, kMultiplier = 4, kDacVolume = 7,
                   kAttenuation = 9;
constexpr std::uint8_t kSoftwareReset = 0x80, kSpeakerOn = 0x10, kChipOff = 0x01;
constexpr std::uint8_t kDivideBy10 = 0x08, kSpeakersUnmuted = 0x03;

// so many samples of silence end a stretch: longer than the air is behind (the longest tick and a sample)
constexpr int kSilentSamples = 128;
// from time to time the samples that nobody can ask for any more are dropped
constexpr std::size_t kLongestStretch = 8192, kKept = 512;

}  // namespace

void CodecLine::reset_registers() {
  registers_.fill(0);
  asked_ = false;
  gain_ = 0;
}

void CodecLine::power(bool on) {
  if (on == powered_) return;
  powered_ = on;
  reset_registers();
  if (!on && open_) {
    open_ = false;
    news_ = true;
  }
}

// digital volume in steps of 1.5 dB around 0x17, then the attenuator before the loudspeakers
double CodecLine::gain() const {
  const std::uint8_t c1 = registers_[kControl1], volume = registers_[kDacVolume];
  if (!(c1 & kSpeakerOn) || (c1 & kChipOff) || !(volume & kSpeakersUnmuted)) return 0;
  const double db = kCodecVolumeStepDb * ((volume >> 2 & 31) - kCodecVolume0Db) -
                    kCodecAttenuationStepDb * (registers_[kAttenuation] & 3);
  return db == 0 ? 1.0 : std::pow(10.0, db / 20);
}

void CodecLine::write_register(unsigned number, std::uint8_t value) {
  if (number == 0 || number >= kRegisters || number == 8) return;
  registers_[number] = value;
  if (number == kControl1 && (value & kSoftwareReset)) reset_registers();
  gain_ = gain();
}

std::uint16_t CodecLine::word(std::uint16_t word, Cycle end) {
  used_ = active_ = true;
  first_use.note();
  const Cycle since = last_end_ >= 0 ? end - last_end_ : 0;
  last_end_ = end;
  if (!powered_) return 0;
  if (asked_) {
    asked_ = false;
    const unsigned number = word >> 8 & 31;
    if (word & kReads) return number < kRegisters ? registers_[number] : 0;
    write_register(number, static_cast<std::uint8_t>(word));
    return 0;
  }
  asked_ = (word & kAsks) != 0;
  // with a control frame in between, samples are two frames apart
  const Cycle period = last_sample_ >= 0 ? end - last_sample_ : since;
  is_even_ = period == period_;
  period_ = period;
  last_sample_ = end;
  const double level = static_cast<std::int16_t>(word & ~kAsks) * gain_;
  sample(static_cast<std::int16_t>(std::clamp(std::lround(level), -32768L, 32767L)), end);
  return 0;
}

void CodecLine::sample(std::int16_t value, Cycle at) {
  if (open_) {
    const Stretch& s = stretches_.back();
    const bool even = at == s.first_at + s.size() * s.period || s.size() == 1;
    zeros_ = value == 0 ? zeros_ + 1 : 0;
    if (zeros_ >= kSilentSamples || !even) {
      open_ = false;
      news_ = true;
    }
  }
  if (!open_ && value == 0) return;
  if (!open_) {
    stretches_.push_back({at, period_, std::make_shared<std::vector<std::int16_t>>(), {}});
    open_ = true;
    zeros_ = 0;
  } else if (stretches_.back().size() == 1) {
    stretches_.back().period = at - stretches_.back().first_at;
  }
  stretches_.back().fresh.push_back(value);
  heard_hash_ = sim::fold(heard_hash_, std::uint64_t{static_cast<std::uint16_t>(value)});
  news_ = true;
}

int CodecLine::output(Cycle at) const {
  for (auto s = stretches_.rbegin(); s != stretches_.rend(); ++s) {
    if (at < s->first_at) continue;
    if (s->period <= 0) return 0;
    const std::int64_t n = (at - s->first_at) / s->period;
    if (n >= s->size()) return 0;
    const auto old = static_cast<std::int64_t>(s->published->size());
    return n < old ? (*s->published)[static_cast<std::size_t>(n)]
                   : s->fresh[static_cast<std::size_t>(n - old)];
  }
  return 0;
}

void CodecLine::forget(Cycle at) {
  while (stretches_.size() > (open_ ? 1u : 0u) &&
         stretches_.front().first_at + stretches_.front().size() * stretches_.front().period < at)
    stretches_.erase(stretches_.begin());
}

bool CodecLine::take_activity() {
  const bool was = active_;
  active_ = false;
  return was;
}

double CodecLine::register_rate_hz() const {
  if (bit_cycles_ <= 0) return 0;
  const double multiplied = static_cast<double>(kFcyHz) / static_cast<double>(bit_cycles_) *
                            (registers_[kMultiplier] + 1) / (registers_[kDivider] + 1);
  return multiplied / (registers_[kControl2] & kDivideBy10 ? 10 : 5) / kCodecOversampling;
}

double CodecLine::frame_rate_hz() const {
  return is_even_ && period_ > 0 ? static_cast<double>(kFcyHz) / static_cast<double>(period_) : 0;
}

const CodecLine::Stretch* CodecLine::publish() {
  news_ = false;
  for (Stretch& s : stretches_) {
    s.published->insert(s.published->end(), s.fresh.begin(), s.fresh.end());
    s.fresh.clear();
  }
  if (open_ && stretches_.back().published->size() > kLongestStretch) {
    Stretch& s = stretches_.back();
    const auto& all = *s.published;
    s.first_at += static_cast<Cycle>(all.size() - kKept) * s.period;
    s.published = std::make_shared<std::vector<std::int16_t>>(all.end() - kKept, all.end());
  }
  return open_ ? &stretches_.back() : nullptr;
}

std::uint64_t CodecLine::state_hash() const {
  std::uint64_t h = heard_hash_;
  for (const std::uint8_t r : registers_) h = sim::fold(h, std::uint64_t{r});
  return sim::fold(h, static_cast<std::uint64_t>(last_end_) << 2 | (asked_ ? 2u : 0u) | (powered_ ? 1u : 0u));
}

}  // namespace board
