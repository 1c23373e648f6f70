// SPDX-License-Identifier: MIT
#include "dspic30/llvm/machine.h"

#include "llvm/CodeGen/BasicTTIImpl.h"
#include "llvm/CodeGen/Passes.h"
#include "llvm/CodeGen/TargetPassConfig.h"

using llvm::DSPICSubtarget, llvm::StringRef;  // the table names them so
#define GET_SUBTARGETINFO_TARGET_DESC
#define GET_SUBTARGETINFO_CTOR
#define DEBUG_TYPE "dspic"
#include "DSPICGenSubtargetInfo.inc"

namespace llvm {

DSPICSubtarget::DSPICSubtarget(const Triple& triple, StringRef cpu, StringRef features,
                               const TargetMachine& machine)
    : DSPICGenSubtargetInfo(triple, cpu, cpu, features), lowering_(machine, *this) {
  ParseSubtargetFeatures(cpu, cpu, features);
}

namespace {

/// LLVM writes debugging information with pointers as wide as the machine's layout says, and everything else
/// by the module's. Program addresses go to 0x18000: 32 bits here, as XC16 has them; C's pointers keep 16.
std::string layout_for_debugging() {
  constexpr StringRef kPointers = "p:16:16";
  return (StringRef(kDspicDataLayout).split(kPointers).first + "p:32:16" +
          StringRef(kDspicDataLayout).split(kPointers).second)
      .str();
}

/// What the loop passes ask about costs.
class Costs : public BasicTTIImplBase<Costs> {
  friend class BasicTTIImplBase<Costs>;

 public:
  Costs(const TargetMachine* machine, const Function& f, const DSPICSubtarget& subtarget)
      : BasicTTIImplBase(machine, f.getParent()->getDataLayout()), subtarget_(&subtarget) {}
  unsigned getNumberOfRegisters(unsigned) const { return 14; }
  TargetTransformInfo::AddressingModeKind getPreferredAddressingMode(const Loop*, ScalarEvolution*) const {
    return TargetTransformInfo::AMK_PostIndexed;
  }

 private:
  const DSPICSubtarget* getST() const { return subtarget_; }
  const DSPICTargetLowering* getTLI() const { return subtarget_->getTargetLowering(); }
  const DSPICSubtarget* subtarget_;
};

class PassConfig : public TargetPassConfig {
 public:
  PassConfig(DSPICTargetMachine& machine, PassManagerBase& passes) : TargetPassConfig(machine, passes) {}
  bool addInstSelector() override {
    addPass(create_dspic_selection(getTM<DSPICTargetMachine>(), getOptLevel()));
    return false;
  }
  void addPostRegAlloc() override { addPass(create_dspic_long_flag_reuse()); }  // before blocks are merged
  void addPreEmitPass() override {
    if (getOptLevel() <= CodeGenOpt::Less) addPass(create_dspic_unoptimised());
    addPass(create_dspic_flag_reuse());
    if (getOptLevel() > CodeGenOpt::Less) addPass(create_dspic_tail_calls());  // at -O0 every call is seen
  }
};

}  // namespace

DSPICTargetMachine::DSPICTargetMachine(const Target& target, const Triple& triple, StringRef cpu,
                                       StringRef features, const TargetOptions& options,
                                       Optional<Reloc::Model>, Optional<CodeModel::Model>,
                                       CodeGenOpt::Level level, bool)
    : LLVMTargetMachine(target, layout_for_debugging(), triple, cpu, features, options, Reloc::Static,
                        CodeModel::Small, level),
      sections_(create_dspic_sections()),
      subtarget_(triple, cpu, features, *this) {
  initAsmInfo();
}

TargetPassConfig* DSPICTargetMachine::createPassConfig(PassManagerBase& passes) {
  return new PassConfig(*this, passes);
}

TargetTransformInfo DSPICTargetMachine::getTargetTransformInfo(const Function& f) {
  return TargetTransformInfo(Costs(this, f, subtarget_));
}

Target& dspic_target() {
  static Target target;
  static const bool registered = [] {
    // Triple has no name for this chip: no triple matches, and the target is found by this function alone
    TargetRegistry::RegisterTarget(target, "dspic30f", "Microchip dsPIC30F", "DSPIC",
                                   [](Triple::ArchType) { return false; });
    RegisterTargetMachine<DSPICTargetMachine> machine(target);
    register_dspic_mc(target);
    register_dspic_printer(target);
    register_dspic_parser(target);

    return true;
  }();
  (void)registered;
  return target;
}

}  // namespace llvm
