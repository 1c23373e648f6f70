// SPDX-License-Identifier: MIT
// Numbers and names of the chip's interrupt sources; the table is irqs.inc.
#pragma once
#include <string>

namespace dspic {

/// Interrupt sources by their bit in IFS0..IFS3.
namespace irq {
enum : int {
#define IRQ(id, name) id,
#define UNUSED_IRQ(bit, handler) Unused##bit,
#include "dspic30/memory/irqs.inc"
  Count
};
}  // namespace irq

inline constexpr int kIrqs = irq::Count;

/// "T1", "U1RX", "ADC" ... as in _T1Interrupt; "?" for those that this chip has not.
inline const char* irq_name(int irq) {
  static constexpr const char* kNames[] = {
#define IRQ(id, name) #name,
#define UNUSED_IRQ(bit, handler) "?",
#include "dspic30/memory/irqs.inc"
  };
  return irq >= 0 && irq < kIrqs ? kNames[irq] : "?";
}

/// "T1Interrupt", "Interrupt45": what the handler of a source is called, without underscore.
inline std::string irq_handler(int irq) {
  const std::string name = irq_name(irq);
  return name == "?" ? "Interrupt" + std::to_string(irq) : name + "Interrupt";
}

}  // namespace dspic
