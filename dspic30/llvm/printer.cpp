// SPDX-License-Identifier: MIT
// Instructions as text, in the syntax of XC16's assembler.
#include "dspic30/llvm/mc.h"
#include "llvm/MC/MCAsmInfo.h"
#include "llvm/MC/MCExpr.h"
#include "llvm/MC/MCInst.h"
#include "llvm/MC/MCInstPrinter.h"
#include "llvm/MC/MCInstrInfo.h"
#include "llvm/MC/MCSubtargetInfo.h"

namespace llvm {

const char* DSPICCC::name(unsigned condition) {
  static const char* const names[] = {"ov",  "geu", "z",  "n",  "le", "lt", "leu", "",
                                      "nov", "ltu", "nz", "nn", "gt", "ge", "gtu"};
  return condition < std::size(names) ? names[condition] : "?";
}

namespace {

class DSPICInstPrinter : public MCInstPrinter {
 public:
  using MCInstPrinter::MCInstPrinter;
  // made by llvm-tblgen
  std::pair<const char*, uint64_t> getMnemonic(const MCInst* mi) override;
  void printInstruction(const MCInst* mi, uint64_t address, raw_ostream& out);
  static const char* getRegisterName(unsigned reg);

  void printRegName(raw_ostream& out, unsigned reg) const override { out << getRegisterName(reg); }
  void printInst(const MCInst* mi, uint64_t address, StringRef note, const MCSubtargetInfo&,
                 raw_ostream& out) override {
    printInstruction(mi, address, out);
    printAnnotation(out, note);
  }

 private:
  void print_value(const MCOperand& op, raw_ostream& out) {
    if (op.isReg())
      out << getRegisterName(op.getReg());
    else if (op.isImm())
      out << op.getImm();
    else
      op.getExpr()->print(out, &MAI);
  }
  void printOperand(const MCInst* mi, unsigned n, raw_ostream& out) { print_value(mi->getOperand(n), out); }
  void print_literal(const MCInst* mi, unsigned n, raw_ostream& out) {
    out << '#';
    print_value(mi->getOperand(n), out);
  }
  void print_condition(const MCInst* mi, unsigned n, raw_ostream& out) {
    out << DSPICCC::name(mi->getOperand(n).getImm());
  }
  void print_near_bit(const MCInst* mi, unsigned n, raw_ostream& out) {
    print_value(mi->getOperand(n), out);
    out << ", #" << mi->getOperand(n + 1).getImm();
  }
  void print_memory(const MCInst* mi, unsigned n, raw_ostream& out) {
    out << '[';
    print_value(mi->getOperand(n), out);
    const int64_t offset = mi->getOperand(n + 1).getImm();
    if (offset) out << (offset < 0 ? "-" : "+") << std::abs(offset);
    out << ']';
  }
};

#include "DSPICGenAsmWriter.inc"

}  // namespace

MCInstPrinter* create_dspic_printer(const MCAsmInfo& syntax, const MCInstrInfo& instructions,
                                    const MCRegisterInfo& registers) {
  return new DSPICInstPrinter(syntax, instructions, registers);
}

}  // namespace llvm
