// SPDX-License-Identifier: MIT
// Instruction selection: the patterns of the .td files, and by hand what patterns cannot say (pairs of
// results, post-increment, stack objects).
#include "dspic30/link/memory_spaces.h"
#include "dspic30/llvm/machine.h"
#include "dspic30/llvm/small_variables.h"
#include "llvm/CodeGen/SelectionDAGISel.h"
#include "llvm/IR/DiagnosticInfo.h"

namespace llvm {

namespace {

constexpr uint64_t kNearEnd = 0x2000;  // what 13 bits of address reach

/// Whether file instructions reach the variable: it says so, or it is small. The linker puts all of these
/// below kNearEnd, and says which variables are too many.
bool is_near(const GlobalValue* g) {
  auto* v = dyn_cast<GlobalVariable>(g);
  if (!v || v->isConstant()) return false;
  if (v->hasSection()) {
    const auto* space = dspic_elf::space_of(v->getSection());
    return space && space->flags & dspic_elf::kNearSpace;
  }
  return dspic_elf::is_small(*v);
}

class Selection : public SelectionDAGISel {
 public:
  Selection(TargetMachine& machine, CodeGenOpt::Level level) : SelectionDAGISel(machine, level) {}
  StringRef getPassName() const override { return "dsPIC instruction selection"; }

 private:
#include "DSPICGenDAGISel.inc"

  SDValue word(int64_t v, const SDLoc& where) { return CurDAG->getTargetConstant(v, where, MVT::i16); }
  SDNode* machine_node(unsigned opcode, const SDLoc& where, ArrayRef<EVT> types, ArrayRef<SDValue> ops) {
    return CurDAG->getMachineNode(opcode, where, CurDAG->getVTList(types), ops);
  }

  // --- shapes of addresses (operands.td). An address has exactly one of them for words, and one for bytes.

  bool select_absolute(SDValue n, SDValue& file) {
    if (n.getOpcode() == DSPICISD::WRAP) {
      file = n.getOperand(0);
      return true;
    }
    auto* c = dyn_cast<ConstantSDNode>(n);
    if (!c || c->getZExtValue() & 1) return false;
    file = word(c->getZExtValue(), SDLoc(n));
    return true;
  }
  bool select_near_byte(SDValue n, SDValue& file) {
    if (auto* c = dyn_cast<ConstantSDNode>(n)) {
      file = word(c->getZExtValue(), SDLoc(n));
      return c->getZExtValue() < kNearEnd;
    }
    if (n.getOpcode() != DSPICISD::WRAP) return false;
    file = n.getOperand(0);
    auto* g = dyn_cast<GlobalAddressSDNode>(file);
    return g && is_near(g->getGlobal());
  }
  bool select_near(SDValue n, SDValue& file) {
    return select_near_byte(n, file) &&
           !(isa<ConstantSDNode>(file) && cast<ConstantSDNode>(file)->getZExtValue() & 1);
  }
  bool select_offset(SDValue n, SDValue& base, SDValue& offset, bool byte) {
    int64_t k = 0;
    const bool is_sum = CurDAG->isBaseWithConstantOffset(n) ||
                        (n.getOpcode() == ISD::ADD && isa<ConstantSDNode>(n.getOperand(1)));
    if (is_sum) {
      k = cast<ConstantSDNode>(n.getOperand(1))->getSExtValue();
      n = n.getOperand(0);
      // how far a stack object lies is not known yet: it may have any offset here
      const bool reaches = byte ? isInt<10>(k) : isInt<11>(k) && !(k & 1);
      if (!reaches && !isa<FrameIndexSDNode>(n)) return false;
    } else if (!isa<FrameIndexSDNode>(n)) {
      return false;
    }
    if (auto* f = dyn_cast<FrameIndexSDNode>(n)) n = CurDAG->getTargetFrameIndex(f->getIndex(), MVT::i16);
    base = n;
    offset = word(k, SDLoc(n));
    return true;
  }
  bool select_word_offset(SDValue n, SDValue& base, SDValue& offset) {
    return select_offset(n, base, offset, false);
  }
  bool select_byte_offset(SDValue n, SDValue& base, SDValue& offset) {
    return select_offset(n, base, offset, true);
  }
  bool select_indexed(SDValue n, SDValue& base, SDValue& index) {
    if (n.getOpcode() != ISD::ADD || !n.hasOneUse() || isa<ConstantSDNode>(n.getOperand(1))) return false;
    base = n.getOperand(0);
    index = n.getOperand(1);
    return true;
  }
  bool select_indirect(SDValue n, SDValue& pointer) {
    SDValue a, b;
    pointer = n;
    return !select_absolute(n, a) && !select_word_offset(n, a, b) && !select_indexed(n, a, b);
  }
  bool select_indirect_byte(SDValue n, SDValue& pointer) {
    SDValue a, b;
    pointer = n;
    return !select_byte_offset(n, a, b) && !select_indexed(n, a, b);
  }
  bool SelectInlineAsmMemoryOperand(const SDValue& op, unsigned, std::vector<SDValue>& out) override {
    SDValue base, offset;
    if (!select_byte_offset(op, base, offset)) base = op, offset = word(0, SDLoc(op));
    out.push_back(base);
    out.push_back(offset);
    return false;
  }

  // --- by hand

  void Select(SDNode* n) override {
    if (n->isMachineOpcode()) return n->setNodeId(-1);
    switch (n->getOpcode()) {
      case ISD::FrameIndex:
        return select_stack_address(n, cast<FrameIndexSDNode>(n), 0);
      case ISD::ADD:
        if (auto* f = dyn_cast<FrameIndexSDNode>(n->getOperand(0)))
          if (auto* c = dyn_cast<ConstantSDNode>(n->getOperand(1)))
            return select_stack_address(n, f, c->getSExtValue());
        break;
      case ISD::MUL:
      case ISD::SMUL_LOHI:
      case ISD::UMUL_LOHI:
        return select_product(n);
      case ISD::SDIVREM:
      case ISD::UDIVREM:
        return select_division(n);
      case ISD::LOAD:
        if (cast<LoadSDNode>(n)->getAddressingMode() == ISD::POST_INC) return select_post_increment(n);
        break;
      case DSPICISD::COPY:
        return select_copy(n);
      case ISD::INLINEASM:
      case ISD::INLINEASM_BR:
        if (pair_operands(n)) return;
        break;
      case DSPICISD::SELECT2: {
        SmallVector<SDValue, 6> ops(n->op_begin(), n->op_end());
        return ReplaceNode(n, machine_node(DSPIC::SELECT2, SDLoc(n), {MVT::i16, MVT::i16}, ops));
      }
    }
    SelectCode(n);
  }

  void select_stack_address(SDNode* n, FrameIndexSDNode* object, int64_t offset) {
    SDValue target = CurDAG->getTargetFrameIndex(object->getIndex(), MVT::i16);
    CurDAG->SelectNodeTo(n, DSPIC::LEA, MVT::i16, target, word(offset, SDLoc(n)));
  }
  void select_product(SDNode* n) {
    const SDLoc where(n);
    SDValue l = n->getOperand(0), r = n->getOperand(1);
    unsigned opcode = n->getOpcode() == ISD::SMUL_LOHI ? DSPIC::MULSS : DSPIC::MULUU;
    auto* c = dyn_cast<ConstantSDNode>(r);
    if (c && opcode == DSPIC::MULUU && c->getZExtValue() < 32) {
      opcode = DSPIC::MULUUi;
      r = word(c->getZExtValue(), where);
    }
    SDValue pair(machine_node(opcode, where, {MVT::Untyped}, {l, r}), 0);
    const auto half = [&](unsigned i) { return CurDAG->getTargetExtractSubreg(i, where, MVT::i16, pair); };
    ReplaceUses(SDValue(n, 0), half(DSPIC::sub_lo));
    if (n->getOpcode() != ISD::MUL) ReplaceUses(SDValue(n, 1), half(DSPIC::sub_hi));
    CurDAG->RemoveDeadNode(n);
  }
  void select_division(SDNode* n) {
    const SDLoc where(n);
    const unsigned opcode = n->getOpcode() == ISD::SDIVREM ? DSPIC::DIVS : DSPIC::DIVU;
    SDValue glue(machine_node(opcode, where, {MVT::Glue}, {n->getOperand(0), n->getOperand(1)}), 0);
    const unsigned results[] = {DSPIC::W0, DSPIC::W1};  // quotient, remainder
    for (unsigned i : {0, 1}) {
      if (!n->hasAnyUseOfValue(i)) continue;
      SDValue v = CurDAG->getCopyFromReg(CurDAG->getEntryNode(), where, results[i], MVT::i16, glue);
      glue = v.getValue(2);
      ReplaceUses(SDValue(n, i), v);
    }
    CurDAG->RemoveDeadNode(n);
  }
  void select_copy(SDNode* n) {
    const bool by_words = cast<ConstantSDNode>(n->getOperand(4))->getZExtValue() == 2;
    SDNode* made = machine_node(by_words ? DSPIC::COPY_WORDS : DSPIC::COPY_BYTES, SDLoc(n),
                                {MVT::i16, MVT::i16, MVT::Other},
                                {n->getOperand(1), n->getOperand(2), n->getOperand(3), n->getOperand(0)});
    ReplaceUses(SDValue(n, 0), SDValue(made, 2));
    CurDAG->RemoveDeadNode(n);
  }

  /// A long operand of inline assembler is a pair, of which the text names the first word, %0, and the second,
  /// %d0. LLVM hands over two registers that lie anywhere; where they are not fixed, a pair takes their place.
  /// False: there are none.
  bool pair_operands(SDNode* n) {
    const SDLoc where(n);
    const bool is_glued = n->getGluedNode() != nullptr;
    const unsigned count = n->getNumOperands() - (is_glued ? 1 : 0);
    SmallVector<SDValue, 16> operands(n->op_begin(), n->op_begin() + InlineAsm::Op_FirstOperand);
    SDValue glue = is_glued ? n->getOperand(count) : SDValue();
    SmallVector<const TargetRegisterClass*, 8> pairs;  // of each operand; null: it is none
    bool any = false;
    for (unsigned at = InlineAsm::Op_FirstOperand; at < count;) {
      // An operand is a word that says what follows, and that.
      unsigned flag = cast<ConstantSDNode>(n->getOperand(at))->getZExtValue();
      const unsigned kind = InlineAsm::getKind(flag), words = InlineAsm::getNumOperandRegisters(flag);
      unsigned class_id = 0, tied = 0;
      const bool is_use = kind == InlineAsm::Kind_RegUse;
      const bool is_register =
          is_use || kind == InlineAsm::Kind_RegDef || kind == InlineAsm::Kind_RegDefEarlyClobber;
      const bool is_tied = InlineAsm::isUseOperandTiedToDef(flag, tied);
      const TargetRegisterClass* of = nullptr;
      if (is_register && words == 2) {
        if (is_tied)
          of = tied < pairs.size() ? pairs[tied] : nullptr;
        else if (InlineAsm::hasRegClassConstraint(flag, class_id))
          of = registers().getMatchingSuperRegClass(&DSPIC::WPRegClass, registers().getRegClass(class_id),
                                                    DSPIC::sub_lo);
      }
      if (is_register && words > 2 && InlineAsm::hasRegClassConstraint(flag, class_id))
        CurDAG->getContext()->diagnose(DiagnosticInfoUnsupported(
            MF->getFunction(), "hands asm an operand of " + Twine(16 * words) + " bits, expected at most 32",
            DiagnosticLocation(where.getDebugLoc())));
      pairs.push_back(of);
      if (!of) {
        for (unsigned i = 0; i <= words; ++i) operands.push_back(n->getOperand(at + i));
        at += 1 + words;
        continue;
      }
      // The two registers' values go to the pair before, or come from it behind.
      any = true;
      const Register low = cast<RegisterSDNode>(n->getOperand(at + 1))->getReg(),
                     high = cast<RegisterSDNode>(n->getOperand(at + 2))->getReg();
      const Register pair = MF->getRegInfo().createVirtualRegister(of);
      if (is_use)
        fill_pair(pair, low, high, of, operands[InlineAsm::Op_InputChain], glue, where);
      else
        empty_pair(pair, low, high, n, where);
      flag = InlineAsm::getFlagWord(kind, 1);
      flag = is_tied ? InlineAsm::getFlagWordForMatchingOp(flag, tied)
                     : InlineAsm::getFlagWordForRegClass(flag, of->getID());
      operands.push_back(CurDAG->getTargetConstant(flag, where, MVT::i32));
      operands.push_back(CurDAG->getRegister(pair, MVT::Untyped));
      at += 3;
    }
    if (!any) return false;
    if (glue.getNode()) operands.push_back(glue);
    SDValue made = CurDAG->getNode(n->getOpcode(), where, CurDAG->getVTList(MVT::Other, MVT::Glue), operands);
    made->setNodeId(-1);
    ReplaceNode(n, made.getNode());
    return true;
  }
  void fill_pair(Register pair, Register low, Register high, const TargetRegisterClass* of, SDValue& chain,
                 SDValue& glue, const SDLoc& where) {
    SDValue first = CurDAG->getCopyFromReg(chain, where, low, MVT::i16, glue);
    SDValue second = CurDAG->getCopyFromReg(first.getValue(1), where, high, MVT::i16, first.getValue(2));
    SDValue both(machine_node(TargetOpcode::REG_SEQUENCE, where, {MVT::Untyped},
                              {CurDAG->getTargetConstant(of->getID(), where, MVT::i32), first,
                               CurDAG->getTargetConstant(DSPIC::sub_lo, where, MVT::i32), second,
                               CurDAG->getTargetConstant(DSPIC::sub_hi, where, MVT::i32)}),
                 0);
    // not glued to the copies before: the pair is made in between
    chain = CurDAG->getCopyToReg(second.getValue(1), where, pair, both, SDValue());
    glue = chain.getValue(1);
  }
  void empty_pair(Register pair, Register low, Register high, SDNode* from, const SDLoc& where) {
    // whoever was glued to the text, for its results, is glued to the copies
    SDNode* const user = from->getGluedUser();
    SDValue both = CurDAG->getCopyFromReg(SDValue(from, 0), where, pair, MVT::Untyped, SDValue(from, 1));
    const auto half = [&](unsigned i) { return CurDAG->getTargetExtractSubreg(i, where, MVT::i16, both); };
    SDValue first = CurDAG->getCopyToReg(both.getValue(1), where, low, half(DSPIC::sub_lo), SDValue());
    SDValue second = CurDAG->getCopyToReg(first, where, high, half(DSPIC::sub_hi), SDValue());
    if (!user) return;
    SmallVector<SDValue, 8> operands(user->op_begin(), user->op_end() - 1);
    operands.push_back(second.getValue(1));
    CurDAG->UpdateNodeOperands(user, operands);
  }
  const TargetRegisterInfo& registers() const { return *MF->getSubtarget().getRegisterInfo(); }

  void select_post_increment(SDNode* n) {
    auto* load = cast<LoadSDNode>(n);
    const unsigned opcode = load->getMemoryVT() == MVT::i16             ? DSPIC::MOVldpi
                            : load->getExtensionType() == ISD::SEXTLOAD ? DSPIC::SEpi
                                                                        : DSPIC::ZEpi;
    SDNode* made = machine_node(opcode, SDLoc(n), {MVT::i16, MVT::i16, MVT::Other},
                                {load->getBasePtr(), load->getChain()});
    CurDAG->setNodeMemRefs(cast<MachineSDNode>(made), {load->getMemOperand()});
    ReplaceNode(n, made);
  }
};

}  // namespace

FunctionPass* create_dspic_selection(TargetMachine& machine, CodeGenOpt::Level level) {
  return new Selection(machine, level);
}

}  // namespace llvm
