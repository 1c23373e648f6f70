// SPDX-License-Identifier: MIT
#include "hal_sim/api/scan_variables.h"

#include <algorithm>

#include "hal_sim/board/setup.h"

namespace api {

namespace {

constexpr int kMostTicks = 65535, kMostRefresh = 64;  // where tickAdcIsr and updateAccI2CCounter stop
constexpr Cycle kLongestFiling = 200;                 // more than any of them takes

constexpr bool is_array(HostVariable which) {
  return which == HostVariable::e_ambient_ir || which == HostVariable::e_ambient_and_reflected_ir ||
         which == HostVariable::e_mic_scan || which == HostVariable::e_acc_scan;
}

std::uint16_t word_of(int value) { return static_cast<std::uint16_t>(value); }

}  // namespace

ScanVariables::Place ScanVariables::place_of(unsigned address) {
  constexpr std::size_t kWords = (served_address(HostVariable::Count) - kServedStart) / 2;
  static const std::array<Place, kWords> kPlaces = [] {
    std::array<Place, kWords> places{};
    std::size_t word = 0;
    for (std::size_t i = 0; i < std::size(kHostRegisters); ++i)
      for (unsigned index = 0; index < (kHostRegisters[i].bytes + 1) / 2; ++index)
        places[word++] = {static_cast<HostVariable>(i), index};
    return places;
  }();
  const std::size_t word = (address - kServedStart) / 2;
  return word < kWords ? kPlaces[word] : Place{};
}

std::uint16_t ScanVariables::Counter::at(std::int64_t interrupts, int most) const {
  if (base >= most) return base;
  return static_cast<std::uint16_t>(std::min<std::int64_t>(most, base + interrupts - since));
}

void ScanVariables::reset() {
  overlay_.reset();
  ticks_.since = acc_refresh_.since = 0;
  mic_offset_ = acc_offset_ = 0;
}

void ScanVariables::started(int selector) {
  selector_ = word_of(selector);
  ++starts_;
}

std::uint64_t ScanVariables::share_q32() const {
  if (!scan_.clock().is_on) return 0;
  const bool micro = scan_.clock().run.micro_only;
  const Cycle taken = micro ? cycles_.share_scan_micro : cycles_.share_scan_round,
              of = micro ? drivers::kScanMicroFrameCycles : scan_.clock().run.round;
  if (share_.taken != taken || share_.of != of)
    share_ = {taken, of, (static_cast<std::uint64_t>(taken) << 32) / static_cast<std::uint64_t>(of)};
  return share_.q32;
}

// --- samples

std::int64_t ScanVariables::filed(Cycle at) const {
  return scan_.clock().interrupts(at - cycles_.scan_files);
}

std::int64_t ScanVariables::newest(std::int64_t count, std::int64_t offset, unsigned index, int ring) {
  // number n lies at (n + offset) mod ring
  const std::int64_t last = count - 1;
  const std::int64_t ago = ((last + offset - static_cast<std::int64_t>(index)) % ring + ring) % ring;
  return last - ago;
}

ScanVariables::Written* ScanVariables::written_at(Place place) const {
  if (!overlay_) return nullptr;
  switch (place.which) {
    case HostVariable::e_ambient_ir:
      return &overlay_->dark[place.index];
    case HostVariable::e_ambient_and_reflected_ir:
      return &overlay_->lit[place.index];
    case HostVariable::e_mic_scan:
      return &overlay_->mic[place.index];
    case HostVariable::e_acc_scan:
      return &overlay_->acc[place.index];
    default:
      return nullptr;
  }
}

/// The turret's sensors, when the scan does not take them.
bool ScanVariables::is_left_out(Place place) const {
  const bool is_sensor =
      place.which == HostVariable::e_ambient_ir || place.which == HostVariable::e_ambient_and_reflected_ir;
  return is_sensor && place.index >= board::kRingSensors && !scan_.five_pairs();
}

std::int64_t ScanVariables::number_of(Place place, Cycle at) const {
  if (is_left_out(place)) return -1;
  switch (place.which) {
    case HostVariable::e_ambient_ir:
      return scan_.dark_number(static_cast<int>(place.index), at);
    case HostVariable::e_ambient_and_reflected_ir:
      return scan_.lit_number(static_cast<int>(place.index), at);
    case HostVariable::e_mic_scan:
      return newest(filed(at), mic_offset_, place.index % drivers::kMicSamples, drivers::kMicSamples);
    default:
      // sample n of the accelerometer lies at n + 1
      return newest(scan_.clock().acc_samples(at), acc_offset_ + 1, place.index % drivers::kAccSamples,
                    drivers::kAccSamples);
  }
}

std::uint16_t ScanVariables::sample(Place place, Cycle at, bool keep) const {
  // What the program has written itself stands there until the scan files the next sample.
  if (const Written* written = overlay_ ? written_at(place) : nullptr;
      written && written->number != kNobody &&
      std::max<std::int64_t>(-1, number_of(place, at)) <= written->number)
    return written->value;
  const int index = static_cast<int>(place.index);
  switch (place.which) {
    case HostVariable::e_ambient_ir:
      return word_of(keep ? scan_.dark(index, at) : scan_.peek_dark(index, at));
    case HostVariable::e_ambient_and_reflected_ir:
      return word_of(keep ? scan_.lit(index, at) : scan_.peek_lit(index, at));
    case HostVariable::e_mic_scan: {
      const std::int64_t number = number_of(place, at);
      return number < 0 ? std::uint16_t{0} : word_of(scan_.mic_sample(index / drivers::kMicSamples, number));
    }
    default: {
      const std::int64_t number = number_of(place, at);
      if (number < 0) return 0;
      const int axis = index / drivers::kAccSamples;
      const int own = static_cast<int>((number + 1) % drivers::kAccSamples);
      if (!keep) return word_of(scan_.peek_acc(axis, own, at));
      return word_of(scan_.acc_scan(at)[static_cast<std::size_t>(axis)][static_cast<std::size_t>(own)]);
    }
  }
}

// --- words

std::uint16_t ScanVariables::value(unsigned address, Cycle at, bool keep) const {
  const Place place = place_of(address);
  const auto ring_index = [](std::int64_t count, std::int64_t offset, int ring) {
    return static_cast<std::uint16_t>(((count + offset) % ring + ring) % ring);
  };
  switch (place.which) {
    case HostVariable::e_last_mic_scan_id:
      return ring_index(filed(at), mic_offset_, drivers::kMicSamples);
    case HostVariable::e_last_acc_scan_id:
      return ring_index(scan_.clock().acc_samples(at), acc_offset_, drivers::kAccSamples);
    case HostVariable::selector:
      return selector_;
    case HostVariable::tickAdcIsr:
      return ticks_.at(scan_.clock().interrupts(at - cycles_.scan_counts), kMostTicks);
    case HostVariable::updateAccI2CCounter: {
      const std::int64_t counted = scan_.clock().interrupts(at - cycles_.scan_counts);
      return static_cast<std::uint16_t>(acc_refresh_.at(counted, kMostRefresh) | beside_refresh_ << 8);
    }
    case HostVariable::hal_starts:
      return starts_;
    case HostVariable::Count:
      return 0;
    default:
      return sample(place, at, keep);
  }
}

__attribute__((noinline)) int ScanVariables::written_dark_less_lit(unsigned sensor, Cycle dark_at,
                                                                   Cycle lit_at) const {
  return static_cast<std::int16_t>(read(HostVariable::e_ambient_ir, sensor, dark_at) -
                                   read(HostVariable::e_ambient_and_reflected_ir, sensor, lit_at));
}

std::uint16_t ScanVariables::read(unsigned address, Cycle at) { return value(address, at, true); }

std::uint16_t ScanVariables::peek(unsigned address, Cycle at) const { return value(address, at, false); }

void ScanVariables::write(unsigned address, std::uint16_t value, std::uint16_t lanes, Cycle at) {
  const Place place = place_of(address);
  // start-up code clears arrays that are empty, byte by byte
  if (!(value & lanes) && !overlay_ && !scan_.clock().is_on && scan_.starts() == 0 && is_array(place.which))
    return;
  const std::uint16_t old = read(address, at);
  value = static_cast<std::uint16_t>((old & ~lanes) | (value & lanes));
  const std::int64_t interrupts = scan_.clock().interrupts(at - cycles_.scan_counts);
  // a ring that goes on elsewhere keeps what it holds
  const auto move_ring = [&](HostVariable ring, int words) {
    const unsigned start = served_address(ring);
    for (int i = 0; i < words; ++i) {
      const unsigned one = start + 2 * static_cast<unsigned>(i);
      write(one, read(one, at), 0xFFFF, at);
    }
  };
  switch (place.which) {
    case HostVariable::e_last_mic_scan_id:
      if (value == old) return;
      if (scan_.starts() > 0) move_ring(HostVariable::e_mic_scan, kMicWords);
      mic_offset_ = value % drivers::kMicSamples - filed(at);
      if (overlay_)
        for (Written& w : overlay_->mic)
          if (w.number != kNobody) w.number = filed(at) - 1;
      return;
    case HostVariable::e_last_acc_scan_id:
      if (value == old) return;
      if (scan_.starts() > 0) move_ring(HostVariable::e_acc_scan, kAccWords);
      acc_offset_ = value % drivers::kAccSamples - scan_.clock().acc_samples(at);
      if (overlay_)
        for (Written& w : overlay_->acc)
          if (w.number != kNobody) w.number = scan_.clock().acc_samples(at) - 1;
      return;
    case HostVariable::selector:
      selector_ = value;
      return;
    case HostVariable::tickAdcIsr:
      ticks_ = {value, interrupts};
      return;
    case HostVariable::updateAccI2CCounter:
      beside_refresh_ = static_cast<std::uint8_t>(value >> 8);
      if (lanes & 0xFF) acc_refresh_ = {static_cast<std::uint16_t>(value & 0xFF), interrupts};
      return;
    case HostVariable::hal_starts:
      starts_ = value;
      return;
    case HostVariable::Count:
      return;
    default:
      break;
  }
  // what is there already, as behind the start-up code, needs no memory
  Written* written = written_at(place);
  if (value == old && !written) return;
  if (!overlay_) overlay_ = std::make_unique<Overlay>();
  if (!written) written = written_at(place);
  *written = {value, std::max<std::int64_t>(-1, number_of(place, at))};
}

Cycle ScanVariables::horizon(unsigned address, Cycle at) {
  const Place place = place_of(address);
  // nothing is filed while the handler is held off, but what was under way
  if (const Cycle since = scan_.clock().held_since; since >= 0)
    return at < since + kLongestFiling ? since + kLongestFiling : board::kNever;
  const auto after = [&](std::int64_t count, Cycle delay) {
    const Cycle when = scan_.clock().interrupt_cycle(count);
    return when >= board::kNever ? board::kNever : when + delay;
  };
  switch (place.which) {
    case HostVariable::e_last_mic_scan_id:
      return after(filed(at) + 1, cycles_.scan_files);
    case HostVariable::tickAdcIsr:
    case HostVariable::updateAccI2CCounter:
      return after(scan_.clock().interrupts(at - cycles_.scan_counts) + 1, cycles_.scan_counts);
    case HostVariable::e_mic_scan:
      return after(number_of(place, at) + drivers::kMicSamples + 1, cycles_.scan_files);
    case HostVariable::e_last_acc_scan_id:
    case HostVariable::e_acc_scan:
      return scan_.acc_until(at);
    case HostVariable::e_ambient_ir:
    case HostVariable::e_ambient_and_reflected_ir:
      return is_left_out(place) ? board::kNever : scan_.pair(static_cast<int>(place.index), at).until;
    default:
      return board::kNever;
  }
}

}  // namespace api
