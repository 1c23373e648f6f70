// SPDX-License-Identifier: MIT
// a_d/advance_ad_scan/e_ad_conv.h. Source: [lib: a_d/advance_ad_scan/e_ad_conv.c], facts restated.
#include "hal_sim/api/host_functions.h"
#include "hal_sim/api/host_library.h"
#include "hal_sim/board/board.h"

namespace api {

namespace {

constexpr int kMicroOnly = 1;
constexpr unsigned kAdpcfg = dspic::sfr("ADPCFG"), kIpc2 = dspic::sfr("IPC2");
constexpr unsigned kConverterBit = 1u << 11;  // ADC [DS70143 5]
constexpr unsigned kConverterPriority = 0x7000, kGumstixPriority = 0x6000;
constexpr unsigned kDebuggersInputs = 0x0003;  // AN0 and AN1 stay digital but for the turret

}  // namespace

HostResult HostLibrary::e_init_ad_scan(const Call& call) {
  Cpu& cpu = call.cpu;
  const CallCycles& c = cycles_;
  if (!call.again) {
    effect(call);
    const bool micro_only = (call.word(0) & 0xFF) == kMicroOnly;
    const int selector = board_.selector() & 15;
    const bool five_pairs = selector == drivers::kGumstixPosition;
    variables_.started(selector);
    cpu.write16(kAdpcfg, five_pairs ? 0 : kDebuggersInputs);
    if (five_pairs) cpu.write16(kIpc2, (cpu.read16(kIpc2) & ~kConverterPriority) | kGumstixPriority);
    cpu.write16(kIfs0, cpu.read16(kIfs0) & ~kConverterBit);
    cpu.write16(kIec0, cpu.read16(kIec0) | kConverterBit);
    const Cycle on = call.at + (micro_only ? (five_pairs ? c.scan_micro_gumstix : c.scan_micro)
                                           : (five_pairs ? c.scan_all_gumstix : c.scan_all));
    follow_ticks(call.at);
    scan().start(micro_only, five_pairs, on);
    board_.pins().follow(on);
    changed(call);
    if (micro_only) return HostResult::done(on - call.at + c.scan_micro_return);
    if (const Cycle full = scan().first_fill(on); full > on) return HostResult::waits(full);
    return HostResult::done(on - call.at + c.scan_all_return);
  }
  // the scan may have been stopped, or held off, by what came in between
  if (!scan().clock().is_on) return HostResult::waits(board::kNever);
  if (const Cycle full = scan().first_fill(call.at); full > call.at) return HostResult::waits(full);
  return HostResult::done(c.scan_filled_return);
}

HostResult HostLibrary::e_ad_is_array_filled(const Call& call) {
  const std::int64_t count = scan().clock().interrupts(call.at);
  const bool filled = count > 0 && count % drivers::kMicSamples == 0;
  const std::int64_t next = filled ? count + 1 : count - count % drivers::kMicSamples + drivers::kMicSamples;
  call.cpu.note_look(scan().clock().held_since >= 0 ? board::kNever : scan().clock().interrupt_cycle(next));
  call.give(filled ? 1 : 0);
  return HostResult::done(cycles_.array_filled);
}

// the program never runs inside the handler, so after the first sample it always sees 1
HostResult HostLibrary::e_ad_is_acquisition_completed(const Call& call) {
  const std::int64_t count = scan().clock().interrupts(call.at);
  const bool stays = count > 0 || scan().clock().held_since >= 0;
  call.cpu.note_look(stays ? board::kNever : scan().clock().next_interrupt(call.at));
  call.give(count > 0 ? 1 : 0);
  return HostResult::done(cycles_.completed);
}

HostResult HostLibrary::e_ad_scan_on(const Call& call) {
  effect(call);
  scan().switch_converter(true, call.at);
  board_.pins().follow(call.at);
  changed(call);
  return HostResult::done(cycles_.scan_on);
}

HostResult HostLibrary::e_ad_scan_off(const Call& call) {
  effect(call);
  scan().switch_converter(false, call.at);
  board_.pins().follow(call.at);
  changed(call);
  return HostResult::done(cycles_.scan_off);
}

}  // namespace api
