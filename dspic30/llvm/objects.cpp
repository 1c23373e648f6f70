// SPDX-License-Identifier: MIT
// ELF objects: which places are left to the linker, and under which number. Only branches within a section
// are settled here. A word of program takes four octets, and addresses within a section count octets.
#include "dspic30/link/memory_spaces.h"
#include "dspic30/llvm/fixups.h"
#include "dspic30/llvm/mc.h"
#include "llvm/BinaryFormat/ELF.h"
#include "llvm/MC/MCAsmBackend.h"
#include "llvm/MC/MCAssembler.h"
#include "llvm/MC/MCContext.h"
#include "llvm/MC/MCELFObjectWriter.h"
#include "llvm/MC/MCFixupKindInfo.h"
#include "llvm/MC/MCObjectWriter.h"
#include "llvm/MC/MCSubtargetInfo.h"
#include "llvm/MC/MCValue.h"

namespace llvm {

namespace {

class ElfWriter : public MCELFObjectTargetWriter {
 public:
  ElfWriter() : MCELFObjectTargetWriter(/*Is64Bit=*/false, /*OSABI=*/0, ELF::EM_DSPIC30F, /*HasRela=*/true) {}
  unsigned getRelocType(MCContext& context, const MCValue&, const MCFixup& fixup, bool) const override {
    const unsigned kind = fixup.getTargetKind();
    if (kind >= FirstTargetFixupKind) return kFixups[kind - FirstTargetFixupKind].relocation;
    switch (kind) {
      case FK_Data_1:
        return dspic_elf::kByte;
      case FK_Data_2:
        return dspic_elf::kWord;
      case FK_Data_4:
        return dspic_elf::kLong;
    }
    context.reportError(fixup.getLoc(), "the linker cannot fill this expression");
    return dspic_elf::kNone;
  }
};

/// Of code without text the function is named, by its section.
std::string too_far(const MCFixup& fixup, const MCValue& target) {
  const MCSymbolRefExpr* to = target.getSymA();
  if (fixup.getLoc().isValid() || !to || !to->getSymbol().isInSection())
    return "branch of more than 32767 words";
  const StringRef section = to->getSymbol().getSection().getName();
  return (section.substr(section.rfind("._") + 2) +
          "(): got a branch of more than 32767 words, expected one within them; make several functions of it")
      .str();
}

class ObjectBackend : public MCAsmBackend {
 public:
  ObjectBackend() : MCAsmBackend(support::little) {}
  unsigned getNumFixupKinds() const override { return std::size(kFixups); }
  const MCFixupKindInfo& getFixupKindInfo(MCFixupKind kind) const override {
    static const auto infos = [] {
      std::array<MCFixupKindInfo, std::size(kFixups)> all;
      for (size_t i = 0; i < all.size(); ++i)
        all[i] = {kFixups[i].name, kFixups[i].shift, kFixups[i].bits,
                  kFixups[i].is_relative() ? unsigned(MCFixupKindInfo::FKF_IsPCRel) : 0u};
      return all;
    }();
    return kind < FirstTargetFixupKind ? MCAsmBackend::getFixupKindInfo(kind)
                                       : infos[kind - FirstTargetFixupKind];
  }
  bool shouldForceRelocation(const MCAssembler&, const MCFixup& fixup, const MCValue&) override {
    const unsigned kind = fixup.getTargetKind();
    return kind >= FirstTargetFixupKind && !kFixups[kind - FirstTargetFixupKind].is_relative();
  }
  void applyFixup(const MCAssembler& assembler, const MCFixup& fixup, const MCValue& target,
                  MutableArrayRef<char> data, uint64_t value, bool resolved,
                  const MCSubtargetInfo*) const override {
    if (!resolved) return;
    unsigned octets = 4;
    switch (fixup.getTargetKind()) {
      case FK_Data_1:
        octets = 1;
        break;
      case FK_Data_2:
        octets = 2;
        break;
      case FK_Data_4:
        break;
      case FK_Data_8:
        octets = 8;
        break;
      case DSPICFix::Branch:
      case DSPICFix::DoEnd: {
        constexpr int64_t kWord = dspic_elf::kWordOctets;
        const int64_t words = (int64_t(value) - kWord) / kWord;  // from the next instruction
        if (!isInt<16>(words)) assembler.getContext().reportError(fixup.getLoc(), too_far(fixup, target));
        value = words & 0xFFFF;
        break;
      }
      default:
        report_fatal_error("dsPIC: a fixup that only the linker can settle was settled");
    }
    for (unsigned i = 0; i < octets; ++i) data[fixup.getOffset() + i] |= char(value >> 8 * i);
  }
  bool mayNeedRelaxation(const MCInst&, const MCSubtargetInfo&) const override { return false; }
  bool fixupNeedsRelaxation(const MCFixup&, uint64_t, const MCRelaxableFragment*,
                            const MCAsmLayout&) const override {
    return false;
  }
  bool writeNopData(raw_ostream& out, uint64_t octets, const MCSubtargetInfo*) const override {
    out.write_zeros(octets);  // NOP is 0x000000
    return true;
  }
  std::unique_ptr<MCObjectTargetWriter> createObjectTargetWriter() const override {
    return std::make_unique<ElfWriter>();
  }
};

}  // namespace

MCAsmBackend* create_dspic_object_backend() { return new ObjectBackend; }

}  // namespace llvm
