// SPDX-License-Identifier: MIT
#include "dspic30/periph/adc.h"

#include <string>
#include <type_traits>

namespace dspic {

namespace {

constexpr unsigned kCon1 = sfr("ADCON1"), kCon2 = sfr("ADCON2"), kCon3 = sfr("ADCON3"), kChs = sfr("ADCHS"),
                   kCssl = sfr("ADCSSL");
constexpr std::uint16_t kDone = sfr_bits("ADCON1", "DONE"), kSamp = sfr_bits("ADCON1", "SAMP"),
                        kAdon = sfr_bits("ADCON1", "ADON"), kCscna = sfr_bits("ADCON2", "CSCNA"),
                        kAlts = sfr_bits("ADCON2", "ALTS"), kBufm = sfr_bits("ADCON2", "BUFM"),
                        kAdrc = sfr_bits("ADCON3", "ADRC");
constexpr SfrBits kForm = sfr_field("ADCON1", "FORM"), kAdcs = sfr_field("ADCON3", "ADCS"),
                  kSamc = sfr_field("ADCON3", "SAMC"), kCh0sa = sfr_field("ADCHS", "CH0SA"),
                  kCh0sb = sfr_field("ADCHS", "CH0SB");
constexpr int kConversionTads = 14;       // [chip P4]
constexpr int kManualStartTads = 1;       // between clearing SAMP and the conversion [?]
constexpr Cycle kEndToFlag = 1;           // [?]
constexpr double kRcTadSeconds = 1.2e-6;  // ADRC = 1 [?]
constexpr int kSoftware = 0, kInt0 = 1, kTimer3 = 2, kAutomatic = 7;

}  // namespace

void Adc::attach() {
  f_.bus.attach(*this, kBuffer, kChs);
  f_.bus.attach(*this, kCssl, kCssl);
  f_.bus.mark_unmodelled(kCon1, std::integral_constant<std::uint16_t, sfr_bits("ADCON1", "ADSIDL")>());
  f_.bus.mark_unmodelled(kCon2, std::integral_constant<std::uint16_t, sfr_bits("ADCON2", "VCFG")>());
  f_.bus.mark_unmodelled(kChs, std::integral_constant<std::uint16_t, sfr_bits("ADCHS", "CH0NA", "CH0NB")>());
  slot_ = f_.events.add(*this, 0, std::uint64_t{1} << irq::Adc, false);
  timers_.listen(*this);
}

void Adc::reset(Cycle now) {
  con1_ = con2_ = con3_ = chs_ = cssl_ = 0;
  form_ = kForms[0];
  set_times();
  buffer_.fill(0);
  fine_ = 0;
  sampling_ = converting_ = cruising_ = false;
  flag_at_ = kNever;
  if (wants_timer_) timers_.want_matches(3, false, now);
  wants_timer_ = false;
  restart_sequence();
  f_.events.set(slot_, kNever);
}

void Adc::set_times() {
  tad_ = (con3_ & kAdrc) ? static_cast<Half>(2 * kRcTadSeconds * f_.fcy_hz)
                         : static_cast<Half>(kAdcs.of(con3_)) + 1;
  sample_time_ = static_cast<Half>(kSamc.of(con3_)) * tad_;
  conversion_time_ = kConversionTads * tad_;
}

// --- the sequence

void Adc::restart_sequence() {
  begun_ = false;
  pointer_ = count_ = 0;
  upper_half_ = mux_b_ = false;
  scan_at_ = cssl_ ? __builtin_ctz(cssl_) : -1;
}

int Adc::channel() const {
  if (mux_b_) return static_cast<int>(kCh0sb.of(chs_));
  if ((con2_ & kCscna) && scan_at_ >= 0) return scan_at_;
  return static_cast<int>(kCh0sa.of(chs_));
}

void Adc::next_channel() {
  const bool was_scanned = !mux_b_;
  if (con2_ & kAlts) mux_b_ = !mux_b_;
  if (!(con2_ & kCscna) || !was_scanned || !cssl_) return;
  const auto above =
      static_cast<std::uint16_t>(scan_at_ >= 15 || scan_at_ < 0 ? 0 : cssl_ & (0xFFFEu << scan_at_));
  scan_at_ = __builtin_ctz(above ? above : cssl_);
}

void Adc::start_sampling(Half at) {
  sampling_ = true;
  con1_ |= kSamp;
  sampling_since_ = at;
  if (count_ == 0 && is_regular() && (begun_ || begins_regularly())) start_cruising(at);
}

void Adc::hold(Half at, Half conversion_start) {
  const int input = channel();
  const Cycle instant = at / 2;
  check_channel(input, instant);
  held_ = std::clamp(f_.outside.analogue_counts(input, instant), 0, 4095);
  sampling_ = false;
  converting_ = true;
  con1_ &= static_cast<std::uint16_t>(~(kSamp | kDone));
  conversion_end_ = conversion_start + conversion_time_;
}

void Adc::finish() {
  buffer_[static_cast<std::size_t>(pointer_)] = formatted(held_);
  converting_ = false;
  con1_ |= kDone;
  pointer_ = (pointer_ + 1) & 15;
  next_channel();
  if (++count_ >= per_interrupt()) {
    flag_at_ = up(conversion_end_) + kEndToFlag;
    count_ = 0;
    upper_half_ = (con2_ & kBufm) && !upper_half_;
    pointer_ = upper_half_ ? 8 : 0;
    mux_b_ = false;
    scan_at_ = cssl_ ? __builtin_ctz(cssl_) : -1;
    begun_ = true;
  }
  if (asam()) start_sampling(conversion_end_);
}

// --- cruising

bool Adc::is_regular() const {
  return on() && asam() && ssrc() == kAutomatic && !(con2_ & (kAlts | kBufm)) && sample_time_ > 0 &&
         f_.outside.analogue_is_function_of_time();
}

bool Adc::begins_regularly() const {
  const std::uint16_t scanned = (con2_ & kCscna) ? cssl_ : 0,
                      inputs = scanned ? scanned : static_cast<std::uint16_t>(1u << kCh0sa.of(chs_));
  return pointer_ == 0 && !mux_b_ && (!scanned || scan_at_ == __builtin_ctz(scanned)) && !(inputs & ~fine_);
}

void Adc::start_cruising(Half at) {
  cruising_ = true;
  cruise_.sample = sample_time_;
  cruise_.cycle = cruise_.sample + conversion_time_;
  cruise_.count = per_interrupt();
  cruise_.sequence = cruise_.count * cruise_.cycle;
  cruise_.first = cruise_.start = at;
  const std::uint16_t scanned = (con2_ & kCscna) ? cssl_ : 0;
  cruise_.held.fill(-kNever);
  std::uint16_t left = scanned;
  for (int i = 0; i < cruise_.count; ++i) {
    if (!left) left = scanned;
    cruise_.channel[static_cast<std::size_t>(i)] =
        static_cast<std::uint8_t>(scanned ? __builtin_ctz(left) : kCh0sa.of(chs_));
    left &= static_cast<std::uint16_t>(left - 1);
    cruise_.held[static_cast<std::size_t>(i)] = i * cruise_.cycle + cruise_.sample;
    cruise_.done[static_cast<std::size_t>(i)] = (i + 1) * cruise_.cycle;
  }
  result_of_.fill(-1);
}

void Adc::cruise(Cycle now) {
  const Half since = 2 * now - cruise_.start;
  if (since < cruise_.sequence) return;
  cruise_.start +=
      since < 2 * cruise_.sequence ? cruise_.sequence : since / cruise_.sequence * cruise_.sequence;
  flag_at_ = up(cruise_.start) + kEndToFlag;
}

void Adc::keep_results(Cycle now) {
  cruise(now);
  for (int slot = 0; slot < cruise_.count; ++slot)
    buffer_[static_cast<std::size_t>(slot)] = slot_now(slot, now);
}

/// Back to single stages, as if there had never been anything else.
void Adc::stop_cruising(Cycle now) {
  if (!cruising_) return;
  keep_results(now);
  cruising_ = false;
  restart_sequence();
  if (!is_fresh(now)) con1_ |= kDone;
  sampling_ = true;
  con1_ |= kSamp;
  sampling_since_ = cruise_.start;
  advance(now);
}

std::uint16_t Adc::slot_now(int slot, Cycle now) const {
  const auto s = static_cast<std::size_t>(slot);
  const Half held = held_instant(slot, now);
  return held < cruise_.first || result_of_[s] == held ? buffer_[s]
                                                       : cruised_result(cruise_.channel[s], held);
}

void Adc::advance_by_stages(Cycle now) {
  // a stage that ends within a cycle is over in the next one
  for (Half stage = next_stage(); !cruising_ && up(stage) <= now; stage = next_stage()) {
    if (converting_)
      finish();
    else
      hold(stage, stage);
  }
  if (cruising_) cruise(now);
}

void Adc::schedule(Cycle now) {
  Cycle at = kNever;
  if (cruising_) {
    at = std::max(up(cruise_.start + cruise_.sequence) + kEndToFlag, now + 1);
    return f_.events.set(slot_, std::min(at, flag_at_));
  }
  if (on() && (converting_ || (sampling_ && ssrc() == kAutomatic))) {
    const Half cycle = sample_time_ + conversion_time_;
    const bool runs_on = asam() && ssrc() == kAutomatic;
    const Half first = converting_ ? conversion_end_ : sampling_since_ + cycle;
    // a stage at which nobody looks needs no event of its own
    at = runs_on ? up(first + (std::max(1, per_interrupt() - count_) - 1) * cycle) : up(first);
    at = std::max(at + kEndToFlag, now + 1);
  }
  f_.events.set(slot_, std::min(at, flag_at_));
}

void Adc::on_event(int /*id*/, Cycle at) {
  const Half end = cruise_.start + cruise_.sequence;
  if (cruising_ && flag_at_ == kNever && up(end) + kEndToFlag == at) {
    // one sequence as the one before: what the rest of this function and schedule() come to
    cruise_.start = end;
    f_.events.fill(slot_, up(end + cruise_.sequence) + kEndToFlag);
    return f_.interrupts.raise(irq::Adc, at);
  }
  irregular_event(at);
}

void Adc::irregular_event(Cycle at) {
  advance(at - kEndToFlag);  // what ended in the cycle before raises the flag now
  if (flag_at_ <= at) {
    f_.interrupts.raise(irq::Adc, at);
    flag_at_ = kNever;
  }
  schedule(at);
}

void Adc::timer_matched(int timer, Cycle at) {
  if (timer != 3 || !sampling_ || ssrc() != kTimer3) return;
  hold(2 * at, 2 * at);
  schedule(at);
}

void Adc::int0_edge(Cycle at) {
  if (!sampling_ || ssrc() != kInt0) return;
  hold(2 * at, 2 * at);
  schedule(at);
}

// --- registers

std::uint16_t Adc::read(unsigned address, Cycle now) {
  advance(now);
  return peek(address, now);
}

std::uint16_t Adc::peek(unsigned address, Cycle now) const {
  switch (address) {
    case kCon1: {
      if (!cruising_ || is_fresh(now)) return con1_;
      const bool samples = (2 * now - cruise_.start) % cruise_.cycle < cruise_.sample;
      return static_cast<std::uint16_t>((con1_ & ~(kSamp | kDone)) | (samples ? kSamp | kDone : 0));
    }
    case kCon2:
      return static_cast<std::uint16_t>(con2_ | (upper_half_ ? kBufs : 0));
    case kCon3:
      return con3_;
    case kChs:
      return chs_;
    case kCssl:
      return cssl_;
    default:
      if (cruising_) {
        return slot_now(static_cast<int>(address - kBuffer) / 2, now);
      }
      return buffer_[(address - kBuffer) / 2];
  }
}

void Adc::changed_while_on(unsigned address, Cycle now) {
  const auto bit = static_cast<std::uint16_t>(1 << (address - kCon1) / 2);
  if (changed_told_ & bit) return;
  changed_told_ |= bit;
  const std::string name = sfr_info(address)->name;
  f_.diagnostics.report(
      Cause::ChangedWhileOn, name,
      name +
          " is changed while ADCON1.ADON = 1; the manual forbids it, and what the converter "
          "does then is not known",
      now);
}

void Adc::write(unsigned address, std::uint16_t value, std::uint16_t lanes, Cycle now) {
  advance(now);
  if (cruising_) {
    // what switches it off needs no stages any more
    const bool goes_off = address == kCon1 && !(merge_lanes(con1_, value, lanes) & kAdon);
    if (goes_off) {
      const std::uint16_t status = peek(kCon1, now);
      keep_results(now);
      cruising_ = false;
      con1_ = status;
    } else {
      stop_cruising(now);
    }
  }
  // Times of the converter are in half cycles.
  const Half at = 2 * (now + 1);
  switch (address) {
    case kCon1: {
      const std::uint16_t before = con1_, wanted = merge_lanes(con1_, value, lanes);
      con1_ = static_cast<std::uint16_t>((wanted & ~(kSamp | kDone)) | (before & kSamp) |
                                         (before & wanted & kDone));
      form_ = kForms[kForm.of(con1_)];
      if (const bool waits = on() && ssrc() == kTimer3; waits != wants_timer_) {
        wants_timer_ = waits;
        timers_.want_matches(3, waits, now);
      }
      // Off: what was under way gives no result.
      if (!(wanted & kAdon)) {
        sampling_ = converting_ = false;
        con1_ &= static_cast<std::uint16_t>(~kSamp);
        restart_sequence();
        break;
      }
      if (!(before & kAdon)) {
        set_times();
        restart_sequence();
      }
      // SAMP begins to sample; with the software trigger, clearing it begins the conversion.
      const bool asked = (wanted & kSamp) && !(before & kSamp);
      if (!sampling_ && !converting_ && (asked || asam()))
        start_sampling(at);
      else if (sampling_ && (before & kSamp) && !(wanted & kSamp) && ssrc() == kSoftware)
        hold(at, at + kManualStartTads * tad_);
      break;
    }
    case kCon2:
      if (on() && ((con2_ ^ value) & lanes & ~kBufs)) changed_while_on(address, now);
      con2_ = merge_lanes(con2_, value, lanes) & static_cast<std::uint16_t>(~kBufs);
      if (!(con2_ & kBufm)) upper_half_ = false;
      break;
    case kCon3:
      if (on() && ((con3_ ^ value) & lanes)) changed_while_on(address, now);
      con3_ = merge_lanes(con3_, value, lanes);
      set_times();
      break;
    case kChs:
      chs_ = merge_lanes(chs_, value, lanes);
      break;
    case kCssl:
      if (on() && ((cssl_ ^ value) & lanes)) changed_while_on(address, now);
      cssl_ = merge_lanes(cssl_, value, lanes);
      if (count_ == 0 || !on()) scan_at_ = cssl_ ? __builtin_ctz(cssl_) : -1;
      break;
    default:
      break;  // results are read-only
  }
  if (on() || address == kCon1) schedule(now);
}

Cycle Adc::horizon(unsigned address, Cycle now) const {
  if (!on() || address == kCon3 || address == kChs || address == kCssl) return kNever;
  if (cruising_) {
    const Half r = (2 * now - cruise_.start) % cruise_.cycle;
    return std::max(now + 1, up(2 * now + (r < cruise_.sample ? cruise_.sample : cruise_.cycle) - r));
  }
  const Half stage = next_stage();
  return stage >= kNever ? kNever : std::max(now + 1, up(stage));
}

void Adc::check_channel(int channel, Cycle at) {
  const bool output = f_.ports.is_output({Port::B, channel});
  if (f_.ports.is_analogue(channel) && !output) {
    fine_ |= static_cast<std::uint16_t>(1 << channel);
    return;
  }
  if (complained_ >> channel & 1) return;
  complained_ |= static_cast<std::uint16_t>(1 << channel);
  const std::string n = std::to_string(channel);
  const std::string why = output ? "TRISB.TRISB" + n + " = 0 makes its pin an output"
                                 : "ADPCFG.PCFG" + n + " = 1 makes it a digital input";
  f_.diagnostics.report(Cause::AnalogueDigital, "AN" + n, "AN" + n + " is converted, but " + why, at);
}

}  // namespace dspic
