// SPDX-License-Identifier: MIT
// The ADC driver's public variables. On the robot its interrupt writes them; here nobody does until somebody
// looks, so every access of a controller to one of them is preceded by a call that brings it up to date
// (hal_sim/api/adc_seen.c). The calls cost no cycles and change nothing else, so a polling loop over such a
// variable stays one. Only variables that the file itself does not define.
#include "driver_arrays.h"

#include <set>

#include "llvm/ADT/StringSwitch.h"
#include "llvm/Analysis/ValueTracking.h"
#include "llvm/IR/IRBuilder.h"
#include "llvm/IR/InstIterator.h"
#include "llvm/IR/IntrinsicInst.h"

namespace cc {
namespace {

using namespace llvm;

/// The function that brings a variable of the driver up to date; null for anything else.
const char* refresher_of(const Value* v) {
  auto* g = dyn_cast<GlobalVariable>(v);
  if (!g || !g->isDeclaration()) return nullptr;
  return StringSwitch<const char*>(g->getName())
      .Case("e_mic_scan", "tp_image_see_mic")
      .Case("e_acc_scan", "tp_image_see_acc")
      .Case("e_last_mic_scan_id", "tp_image_see_mic_index")
      .Case("e_last_acc_scan_id", "tp_image_see_acc_index")
      .Case("e_ambient_ir", "tp_image_see_ir")
      .Case("e_ambient_and_reflected_ir", "tp_image_see_ir")
      .Case("tickAdcIsr", "tp_image_see_counters")
      .Case("updateAccI2CCounter", "tp_image_see_counters")
      .Default(nullptr);
}

/// Functions to call before an access by pointer, whichever way the pointer was made.
void collect(const Value* pointer, std::set<std::string>& out) {
  if (!pointer->getType()->isPointerTy()) return;
  SmallVector<const Value*, 4> objects;
  getUnderlyingObjects(pointer, objects);
  for (const Value* object : objects)
    if (const char* refresher = refresher_of(object)) out.insert(refresher);
}

/// True when the access already has its call: nothing but harmless instructions stand between them.
bool is_fresh(const Instruction& access, const std::string& refresher) {
  for (const Instruction* i = access.getPrevNode(); i; i = i->getPrevNode()) {
    if (calls(*i, refresher)) return true;
    auto* call = dyn_cast<CallBase>(i);
    if (call && !isa<IntrinsicInst>(call) &&
        !(call->getCalledFunction() && call->getCalledFunction()->getName().startswith(kRefresher)))
      return false;
  }
  return false;
}

}  // namespace

void refresh_driver_arrays(Unit& unit) {
  if (unit.options.library || unit.options.uncounted) return;
  bool any = false;
  for (GlobalVariable& g : unit.module.globals()) any = any || refresher_of(&g);
  if (!any) return;
  for (Function& f : unit.module) {
    std::vector<std::pair<Instruction*, std::string>> added;
    for (Instruction& i : instructions(f)) {
      std::set<std::string> refreshers;
      if (auto* load = dyn_cast<LoadInst>(&i)) collect(load->getPointerOperand(), refreshers);
      // what the program writes to a counter comes after what the interrupt has written to it
      if (auto* store = dyn_cast<StoreInst>(&i)) collect(store->getPointerOperand(), refreshers);
      if (auto* call = dyn_cast<CallBase>(&i))
        if (!isa<DbgInfoIntrinsic>(call) && !call->isLifetimeStartOrEnd())
          for (const Value* argument : call->args()) collect(argument, refreshers);
      for (const std::string& name : refreshers)
        if (!is_fresh(i, name)) added.emplace_back(&i, name);
    }
    for (auto& [before, name] : added) {
      IRBuilder<> b(before);
      mark_free(b.CreateCall(host_function(unit.module, name.c_str(), b.getVoidTy(), {})));
    }
  }
}

}  // namespace cc
