// SPDX-License-Identifier: MIT
#include "dspic30/llvm/frames.h"

#include <algorithm>

#include "dspic30/llvm/instructions.h"
#include "dspic30/llvm/interrupts.h"
#include "llvm/CodeGen/MachineFrameInfo.h"
#include "llvm/CodeGen/MachineFunction.h"
#include "llvm/CodeGen/MachineInstrBuilder.h"
#include "llvm/CodeGen/RegisterScavenging.h"
#include "llvm/IR/DiagnosticInfo.h"
#include "llvm/IR/InlineAsm.h"

namespace llvm {

namespace {

constexpr int kRcount = 0x36, kPsvpag = 0x34;  // addresses of registers a handler may have to keep

const TargetInstrInfo& instructions_of(const MachineFunction& mf) {
  return *mf.getSubtarget().getInstrInfo();
}

/// W15 += bytes, in steps a ten-bit literal can hold; W15 stays even.
void move_stack(MachineBasicBlock& mbb, MachineBasicBlock::iterator it, const DebugLoc& where,
                int64_t bytes) {
  constexpr int64_t kLargestStep = 1022;
  const auto& ii = instructions_of(*mbb.getParent());
  const unsigned opcode = bytes < 0 ? DSPIC::SUBi10 : DSPIC::ADDi10;
  for (int64_t left = std::abs(bytes); left > 0; left -= kLargestStep)
    BuildMI(mbb, it, where, ii.get(opcode), DSPIC::W15)
        .addReg(DSPIC::W15)
        .addImm(std::min(left, kLargestStep));
}

// --- what an interrupt handler keeps besides registers

/// REPEAT counts in RCOUNT; a handler that may use it must not end a repetition it interrupted.
bool needs_rcount(const MachineFunction& mf) {
  if (mf.getFrameInfo().hasCalls()) return true;
  for (auto& block : mf)
    for (auto& i : block)
      if (i.getOpcode() == DSPIC::DIVS || i.getOpcode() == DSPIC::DIVU ||
          i.getOpcode() == DSPIC::COPY_WORDS || i.getOpcode() == DSPIC::COPY_BYTES || i.isInlineAsm())
        return true;
  return false;
}

/// Names of variables to keep, as the linker knows them.
SmallVector<StringRef, 4> saved_variables(const Function& f) {
  SmallVector<StringRef, 4> names;
  f.getFnAttribute(kSave).getValueAsString().split(names, ',', -1, /*KeepEmpty=*/false);
  return names;
}

const char* lasting_name(MachineFunction& mf, StringRef name) { return mf.createExternalSymbolName(name); }

bool opens_constants(const Function& f) { return is_interrupt(f) && f.hasFnAttribute(kAutoPsv); }

/// The handler reads constants through the page of the program's constants, whatever page main() had open.
void open_constants(const MachineFunction& mf, MachineBasicBlock& mbb, MachineBasicBlock::iterator it) {
  const auto& ii = instructions_of(mf);
  BuildMI(mbb, it, DebugLoc(), ii.get(DSPIC::MOVi), DSPIC::W0).addExternalSymbol("__const_psvpage");
  BuildMI(mbb, it, DebugLoc(), ii.get(DSPIC::MOVabst)).addReg(DSPIC::W0, RegState::Kill).addImm(kPsvpag);
}

/// Before the frame is made.
void push_context(MachineFunction& mf, MachineBasicBlock& mbb, MachineBasicBlock::iterator it) {
  const auto& ii = instructions_of(mf);
  const Function& f = mf.getFunction();
  if (has_shadow(f)) BuildMI(mbb, it, DebugLoc(), ii.get(DSPIC::PUSHS));
  if (needs_rcount(mf)) BuildMI(mbb, it, DebugLoc(), ii.get(DSPIC::PUSHf)).addImm(kRcount);
  if (opens_constants(f)) BuildMI(mbb, it, DebugLoc(), ii.get(DSPIC::PUSHf)).addImm(kPsvpag);
  for (StringRef name : saved_variables(f))
    BuildMI(mbb, it, DebugLoc(), ii.get(DSPIC::PUSHf)).addExternalSymbol(lasting_name(mf, name));
  if (opens_constants(f) && has_shadow(f)) open_constants(mf, mbb, it);
}

/// After the frame is gone.
void pop_context(MachineFunction& mf, MachineBasicBlock& mbb, MachineBasicBlock::iterator it) {
  const auto& ii = instructions_of(mf);
  const Function& f = mf.getFunction();
  auto names = saved_variables(f);
  for (StringRef name : reverse(names))
    BuildMI(mbb, it, DebugLoc(), ii.get(DSPIC::POPf)).addExternalSymbol(lasting_name(mf, name));
  if (opens_constants(f)) BuildMI(mbb, it, DebugLoc(), ii.get(DSPIC::POPf)).addImm(kPsvpag);
  if (needs_rcount(mf)) BuildMI(mbb, it, DebugLoc(), ii.get(DSPIC::POPf)).addImm(kRcount);
  if (has_shadow(f)) BuildMI(mbb, it, DebugLoc(), ii.get(DSPIC::POPS));
}

/// W15 to where the kept registers end: after an array of variable length it is anywhere.
void find_kept_registers(const MachineFunction& mf, MachineBasicBlock& mbb, MachineBasicBlock::iterator end) {
  auto first_pop = end;
  unsigned pops = 0;
  while (first_pop != mbb.begin()) {
    const unsigned opcode = std::prev(first_pop)->getOpcode();
    if (opcode != DSPIC::POP && opcode != DSPIC::POPD) break;
    pops += opcode == DSPIC::POPD ? 2 : 1;
    --first_pop;
  }
  if (!pops) return;
  BuildMI(mbb, first_pop, DebugLoc(), instructions_of(mf).get(DSPIC::MOVrr), DSPIC::W15).addReg(DSPIC::W14);
  move_stack(mbb, first_pop, DebugLoc(), alignTo(mf.getFrameInfo().getStackSize(), 2) + 2 * pops);
}

}  // namespace

bool DSPICFrameLowering::hasFP(const MachineFunction& mf) const {
  const auto& frame = mf.getFrameInfo();
  return frame.getStackSize() || frame.getNumFixedObjects() || frame.hasVarSizedObjects() ||
         frame.isFrameAddressTaken();
}

StackOffset DSPICFrameLowering::getFrameIndexReference(const MachineFunction& mf, int object,
                                                       Register& base) const {
  base = DSPIC::W14;
  return StackOffset::getFixed(mf.getFrameInfo().getObjectOffset(object) - kSavedFrame);
}

void DSPICFrameLowering::emitPrologue(MachineFunction& mf, MachineBasicBlock& mbb) const {
  constexpr int64_t kLargestFrame = 16382;  // LNK #lit14
  const auto& ii = instructions_of(mf);
  const Function& f = mf.getFunction();
  const auto it = mbb.begin();
  const StringRef first = f.getFnAttribute(kPreprologue).getValueAsString();
  if (!first.empty())
    BuildMI(mbb, it, DebugLoc(), ii.get(DSPIC::INLINEASM))
        .addExternalSymbol(lasting_name(mf, first))
        .addImm(InlineAsm::Extra_HasSideEffects);
  if (is_interrupt(f)) push_context(mf, mbb, it);
  if (!hasFP(mf)) return;
  const int64_t size = alignTo(mf.getFrameInfo().getStackSize(), 2);
  if (size > kLargestFrame) {
    const std::string text =
        "needs " + std::to_string(size) + " bytes of stack, which the chip does not have";
    f.getContext().diagnose(DiagnosticInfoUnsupported(f, text, DiagnosticLocation(f.getSubprogram())));
  }
  BuildMI(mbb, it, DebugLoc(), ii.get(DSPIC::LNK)).addImm(std::min(size, kLargestFrame));
}

void DSPICFrameLowering::emitEpilogue(MachineFunction& mf, MachineBasicBlock& mbb) const {
  const auto end = mbb.getLastNonDebugInstr();
  if (mf.getFrameInfo().hasVarSizedObjects()) find_kept_registers(mf, mbb, end);
  if (hasFP(mf)) BuildMI(mbb, end, DebugLoc(), instructions_of(mf).get(DSPIC::ULNK));
  if (is_interrupt(mf.getFunction())) pop_context(mf, mbb, end);
}

void DSPICFrameLowering::processFunctionBeforeFrameFinalized(MachineFunction& mf,
                                                             RegScavenger* scavenger) const {
  constexpr unsigned kReach = 480;  // beyond it, [W14+lit] of a byte may fail, and a register must be found
  auto& frame = mf.getFrameInfo();
  if (scavenger && frame.estimateStackSize(mf) > kReach)
    scavenger->addScavengingFrameIndex(frame.CreateStackObject(2, Align(2), false));
}

namespace {

/// Two neighbours that one instruction keeps, as their pair; or the one.
SmallVector<Register, 8> in_pairs(ArrayRef<CalleeSavedInfo> saved, const TargetRegisterInfo& registers) {
  SmallVector<Register, 8> all;
  for (size_t i = 0; i < saved.size(); ++i) {
    const MCRegister pair =
        registers.getMatchingSuperReg(saved[i].getReg(), DSPIC::sub_lo, &DSPIC::WPRegClass);
    const bool is_pair = pair && i + 1 < saved.size() &&
                         registers.getSubReg(pair, DSPIC::sub_hi) == MCRegister(saved[i + 1].getReg());
    all.push_back(is_pair ? Register(pair) : Register(saved[i].getReg()));
    i += is_pair;
  }
  return all;
}

}  // namespace

bool DSPICFrameLowering::spillCalleeSavedRegisters(MachineBasicBlock& mbb, MachineBasicBlock::iterator it,
                                                   ArrayRef<CalleeSavedInfo> saved,
                                                   const TargetRegisterInfo* registers) const {
  auto& mf = *mbb.getParent();
  for (auto& s : saved) mbb.addLiveIn(s.getReg());
  for (Register r : in_pairs(saved, *registers))
    BuildMI(mbb, it, DebugLoc(),
            instructions_of(mf).get(DSPIC::WPRegClass.contains(r) ? DSPIC::PUSHD : DSPIC::PUSH))
        .addReg(r, RegState::Kill);
  if (opens_constants(mf.getFunction()) && !has_shadow(mf.getFunction())) open_constants(mf, mbb, it);
  return true;
}

bool DSPICFrameLowering::restoreCalleeSavedRegisters(MachineBasicBlock& mbb, MachineBasicBlock::iterator it,
                                                     MutableArrayRef<CalleeSavedInfo> saved,
                                                     const TargetRegisterInfo* registers) const {
  const SmallVector<Register, 8> kept = in_pairs(saved, *registers);
  for (Register r : reverse(kept))
    BuildMI(mbb, it, DebugLoc(),
            instructions_of(*mbb.getParent()).get(DSPIC::WPRegClass.contains(r) ? DSPIC::POPD : DSPIC::POP),
            r);
  return true;
}

MachineBasicBlock::iterator DSPICFrameLowering::eliminateCallFramePseudoInstr(
    MachineFunction& /*mf*/, MachineBasicBlock& mbb, MachineBasicBlock::iterator it) const {
  const int64_t bytes = it->getOperand(0).getImm();
  move_stack(mbb, it, it->getDebugLoc(), it->getOpcode() == DSPIC::ADJDOWN ? bytes : -bytes);
  return mbb.erase(it);
}

void DSPICFrameLowering::determineCalleeSaves(MachineFunction& mf, BitVector& saved,
                                              RegScavenger* scavenger) const {
  TargetFrameLowering::determineCalleeSaves(mf, saved, scavenger);
  saved.reset(DSPIC::W14);  // LNK keeps it
  const Function& f = mf.getFunction();
  if (opens_constants(f) && !has_shadow(f)) saved.set(DSPIC::W0);
}

}  // namespace llvm
