// SPDX-License-Identifier: MIT
// The functions of pins_sound.h on hal_sim/board.
#include <algorithm>

#include "hal_sim/board/board.h"
#include "hal_sim/drivers/drivers.h"
#include "hal_sim/host/context.h"
#include "hal_sim/host/pins_sound.h"

using board::Cycle;
using host::Context;

extern "C" {

tp_i64 tp_mic_scan(void* scan, tp_i64 from) {
  Context& context = Context::current();
  const drivers::AdcScan& adc = context.drivers().scan();
  const Cycle now = context.now();
  const std::int64_t count = adc.interrupts(now);
  context.lower_horizon(adc.next_interrupt(now));
  auto* words = static_cast<std::int16_t*>(scan);
  for (std::int64_t n = std::max<std::int64_t>(from, count - drivers::kMicSamples); n < count; ++n)
    for (int microphone = 0; microphone < board::kMicrophones; ++microphone)
      words[microphone * drivers::kMicSamples + n % drivers::kMicSamples] =
          static_cast<std::int16_t>(adc.mic_sample(microphone, n));
  return count;
}

void tp_codec_start(void) {
  Context& context = Context::current();
  context.drivers().sound().start(context.now());
  context.note_write();
}

void tp_codec_configure(void) {
  Context& context = Context::current();
  context.drivers().sound().codec().configure();
  context.note_write();
}

void tp_codec_play(tp_i64 offset, tp_i64 length) {
  Context& context = Context::current();
  context.drivers().sound().play(static_cast<int>(offset), static_cast<int>(length), context.now());
  context.note_write();
}

void tp_codec_stop(void) {
  Context& context = Context::current();
  context.drivers().sound().stop(context.now());
  context.note_write();
}

tp_i64 tp_codec_next_group(void) {
  Context& context = Context::current();
  const Cycle next = context.drivers().sound().next_group(context.now());
  return next < board::kNever ? next : -1;
}

void tp_codec_idle(tp_i64 idle) {
  Context::current().set_background(TP_BG_DCI, idle ? drivers::kCodecGroupCycles : 0,
                                    idle ? drivers::kDciIdleIsrCycles : 0);
}

}  // extern "C"
