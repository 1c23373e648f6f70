// SPDX-License-Identifier: MIT
// Which ELF section a function or variable gets: one each, so that the linker can leave out what nobody uses.
#include "dspic30/link/memory_spaces.h"
#include "dspic30/llvm/machine.h"
#include "dspic30/llvm/small_variables.h"
#include "llvm/BinaryFormat/ELF.h"
#include "llvm/CodeGen/TargetLoweringObjectFileImpl.h"
#include "llvm/IR/GlobalVariable.h"
#include "llvm/IR/Module.h"
#include "llvm/MC/MCContext.h"
#include "llvm/MC/MCSectionELF.h"

namespace llvm {

bool dspic_elf::is_small(const GlobalVariable& v) {
  constexpr uint64_t kSmall =
      32;  // bytes; of a program's variables the few larger ones hold nearly all bytes
  Type* type = v.getValueType();
  const bool is_unknown = !type->isSized() || (type->isArrayTy() && type->getArrayNumElements() == 0);
  return !is_unknown && v.getParent()->getDataLayout().getTypeAllocSize(type) <= kSmall;
}

namespace {

using dspic_elf::MemorySpace;

class Sections : public TargetLoweringObjectFileELF {
  MCSection* of_space(const GlobalObject* object, const Twine& name, const MemorySpace& space, unsigned more,
                      const TargetMachine& machine) const {
    const unsigned type = space.zeroed ? ELF::SHT_NOBITS : ELF::SHT_PROGBITS;
    const unsigned flags =
        ELF::SHF_ALLOC | (space.writable ? unsigned(ELF::SHF_WRITE) : 0u) | space.flags | more;
    return getContext().getELFSection(name + "." + machine.getSymbol(object)->getName(), type, flags);
  }

  MCSection* SelectSectionForGlobal(const GlobalObject* object, SectionKind kind,
                                    const TargetMachine& machine) const override {
    if (kind.isText())
      return getContext().getELFSection(".text." + machine.getSymbol(object)->getName(), ELF::SHT_PROGBITS,
                                        ELF::SHF_ALLOC | ELF::SHF_EXECINSTR);
    auto* v = cast<GlobalVariable>(object);
    const char* name = kind.isReadOnly()         ? ".const"
                       : dspic_elf::is_small(*v) ? (kind.isBSS() || kind.isCommon() ? ".nbss" : ".ndata")
                       : kind.isBSS() || kind.isCommon() ? ".bss"
                                                         : ".data";
    return of_space(object, name, *dspic_elf::space_of(name), 0, machine);
  }

  MCSection* getExplicitSectionGlobal(const GlobalObject* object, SectionKind kind,
                                      const TargetMachine& machine) const override {
    const StringRef name = object->getSection();
    if (const MemorySpace* space = dspic_elf::space_of(name))
      return of_space(object, name, *space, name.contains('@') ? unsigned(dspic_elf::kAbsolute) : 0u,
                      machine);
    return TargetLoweringObjectFileELF::getExplicitSectionGlobal(object, kind, machine);
  }

  MCSection* getSectionForConstant(const DataLayout&, SectionKind, const Constant*, Align&) const override {
    return getContext().getELFSection(".const", ELF::SHT_PROGBITS,
                                      unsigned{ELF::SHF_ALLOC} | dspic_elf::kPsv);
  }
};

}  // namespace

std::unique_ptr<TargetLoweringObjectFile> create_dspic_sections() { return std::make_unique<Sections>(); }

}  // namespace llvm
