// SPDX-License-Identifier: MIT
// The calling convention, XC16's (its manual's section on function parameters; facts that objects show):
//
//   arguments   left to right, each takes the first free registers of W0..W7 that suit it: a word any, a long
//               or float an even pair, 64 bits W0..W3 or W4..W7; a struct as many in a row as it has words,
//               of 4 and 8 bytes as a number of that size, if no member is an array or struct of another size
//               than numbers have. So a later short argument may fill a gap. What finds none goes on the
//               stack, the first nearest to the return address; so do the last named argument before "..."
//               and all behind it, structs as well.
//   result      W0, W1:W0, W3..W0; a struct of whatever size where W0 points
//   kept        W8 to W14; lost W0 to W7
#include "dspic30/llvm/interrupts.h"
#include "dspic30/llvm/subtarget.h"
#include "dspic30/llvm/target.h"
#include "llvm/CodeGen/MachineFrameInfo.h"
#include "llvm/CodeGen/MachineRegisterInfo.h"

namespace llvm {

namespace {

constexpr unsigned kArgumentRegisters = 8, kResultRegisters = 4;
constexpr int kReturnAddress = 4;  // bytes between the stacked arguments and the callee's frame
const MCPhysReg kRegisters[kArgumentRegisters] = {DSPIC::W0, DSPIC::W1, DSPIC::W2, DSPIC::W3,
                                                  DSPIC::W4, DSPIC::W5, DSPIC::W6, DSPIC::W7};

/// One word of an argument and where it travels.
struct Word {
  unsigned value;     // index among the values LLVM hands over; a struct is one value
  unsigned of_value;  // which word of it
  bool in_register;
  MCPhysReg reg = 0;
  int offset = 0;  // on the stack, from W15 at the CALL
};

struct Places {
  SmallVector<Word, 16> words;
  int stack_bytes = 0;
};

template <class Argument>
bool is_struct(const Argument& a) {
  return a.Flags.isByVal();
}

template <class Argument>
bool is_named(const Argument& a) {
  if constexpr (std::is_same_v<Argument, ISD::OutputArg>)
    return a.IsFixed;
  else
    return true;
}

template <class Argument>
Places place(const SmallVectorImpl<Argument>& arguments, bool variadic) {
  Places places;
  unsigned last_named = 0, used = 0;  // a bit a register
  for (const Argument& a : arguments)
    if (is_named(a)) last_named = std::max(last_named, a.OrigArgIndex);
  for (unsigned i = 0; i < arguments.size();) {
    const Argument& a = arguments[i];
    if (variadic && a.OrigArgIndex >= last_named) used = ~0u;
    // LLVM hands a long over as two values, 64 bits as four
    unsigned end = i + 1;
    if (a.Flags.isSplit())
      while (!arguments[end++].Flags.isSplitEnd()) {
      }
    const unsigned size = is_struct(a) ? (a.Flags.getByValSize() + 1) / 2 : end - i;
    // a struct that is a whole word, pair or four of them travels like an integer of its
    // size, unless it is odd
    const Align align = is_struct(a) ? a.Flags.getNonZeroByValAlign() : Align(2);
    const bool is_whole = !is_struct(a) || (a.Flags.getByValSize() == 2 * size && align == Align(2));
    const unsigned step = is_whole && (size == 2 || size == 4) ? size : 1;
    const unsigned mask = (1u << size) - 1;
    // The first registers that are free, one behind the other; else all of it goes on the stack.
    unsigned first = 0;
    while (first + size <= kArgumentRegisters && (used >> first & mask)) first += step;
    const bool fits = size <= kArgumentRegisters && first + size <= kArgumentRegisters;
    if (fits)
      used |= mask << first;
    else
      places.stack_bytes += 2 * size;
    for (unsigned w = 0; w < size; ++w) {
      Word word{is_struct(a) ? i : i + w, is_struct(a) ? w : 0, fits};
      if (fits)
        word.reg = kRegisters[first + w];
      else
        word.offset = -places.stack_bytes + 2 * int(w);
      places.words.push_back(word);
    }
    i = end;
  }
  return places;
}

/// The address of word `n` of the struct at `base`.
SDValue word_of(SDValue base, unsigned n, const SDLoc& where, SelectionDAG& dag) {
  return n ? dag.getNode(ISD::ADD, where, MVT::i16, base, dag.getConstant(2 * n, where, MVT::i16)) : base;
}

/// Reads word `n` of a struct of `size` bytes; an odd last byte alone, for nothing may lie behind it.
SDValue load_word(SDValue chain, SDValue base, unsigned n, unsigned size, Align align, const SDLoc& where,
                  SelectionDAG& dag) {
  SDValue at = word_of(base, n, where, dag);
  if (2 * n + 1 == size)
    return dag.getExtLoad(ISD::ZEXTLOAD, where, MVT::i16, chain, at, MachinePointerInfo(), MVT::i8);
  const Align at_least = align == kDspicOddStruct ? Align(2) : align == kDspicOddBytes ? Align(1) : align;
  return dag.getLoad(MVT::i16, where, chain, at, MachinePointerInfo(), std::min(at_least, Align(2)));
}

}  // namespace

SDValue DSPICTargetLowering::LowerFormalArguments(SDValue chain, CallingConv::ID, bool variadic,
                                                  const SmallVectorImpl<ISD::InputArg>& ins,
                                                  const SDLoc& where, SelectionDAG& dag,
                                                  SmallVectorImpl<SDValue>& all) const {
  auto& mf = dag.getMachineFunction();
  auto& frame = mf.getFrameInfo();
  // structs without members take no word; nothing is at their address
  SmallVector<SDValue, 8> values(ins.size(), dag.getConstant(0, where, MVT::i16));
  const Places places = place(ins, variadic);
  if (variadic) mf.getInfo<DSPICFunctionInfo>()->named_stack_bytes = places.stack_bytes;
  SDValue object;  // of the struct being received
  SmallVector<SDValue, 8> stores;
  for (const Word& w : places.words) {
    const bool starts_struct = is_struct(ins[w.value]) && w.of_value == 0;
    const unsigned size = is_struct(ins[w.value]) ? ins[w.value].Flags.getByValSize() : 2;
    if (!w.in_register) {
      // it lies on the stack already
      if (w.of_value) continue;
      const int fixed = frame.CreateFixedObject(alignTo(size, 2), -kReturnAddress + w.offset, !starts_struct);
      SDValue at = dag.getFrameIndex(fixed, MVT::i16);
      values[w.value] = starts_struct ? at
                                      : dag.getLoad(MVT::i16, where, chain, at,
                                                    MachinePointerInfo::getFixedStack(mf, fixed));
      continue;
    }
    const Register v = mf.getRegInfo().createVirtualRegister(&DSPIC::WRegClass);
    mf.getRegInfo().addLiveIn(w.reg, v);
    SDValue word = dag.getCopyFromReg(chain, where, v, MVT::i16);
    if (!is_struct(ins[w.value])) {
      values[w.value] = word;
      continue;
    }
    if (starts_struct) {
      object = dag.getFrameIndex(frame.CreateStackObject(alignTo(size, 2), Align(2), false), MVT::i16);
      values[w.value] = object;
    }
    stores.push_back(dag.getStore(word.getValue(1), where, word, word_of(object, w.of_value, where, dag),
                                  MachinePointerInfo()));
  }
  all.append(values.begin(), values.end());
  if (stores.empty()) return chain;
  stores.push_back(chain);
  return dag.getNode(ISD::TokenFactor, where, MVT::Other, stores);
}

SDValue DSPICTargetLowering::LowerCall(CallLoweringInfo& call, SmallVectorImpl<SDValue>& values) const {
  SelectionDAG& dag = call.DAG;
  const SDLoc where = call.DL;
  call.IsTailCall = false;
  SDValue before = call.Chain;

  // the words of structs are read before the stack moves
  const Places places = place(call.Outs, call.IsVarArg);
  SmallVector<SDValue, 16> words, loads;
  for (const Word& w : places.words) {
    const auto& out = call.Outs[w.value];
    if (!is_struct(out)) {
      words.push_back(call.OutVals[w.value]);
      continue;
    }
    words.push_back(load_word(before, call.OutVals[w.value], w.of_value, out.Flags.getByValSize(),
                              out.Flags.getNonZeroByValAlign(), where, dag));
    loads.push_back(words.back().getValue(1));
  }
  if (!loads.empty()) before = dag.getNode(ISD::TokenFactor, where, MVT::Other, loads);

  // Arguments without a register go on the stack.
  SDValue chain = dag.getCALLSEQ_START(before, places.stack_bytes, 0, where);
  SDValue stack;
  SmallVector<SDValue, 8> stores;
  for (unsigned i = 0; i < places.words.size(); ++i) {
    if (places.words[i].in_register) continue;
    if (!stack) stack = dag.getCopyFromReg(chain, where, DSPIC::W15, MVT::i16);
    SDValue offset = dag.getConstant(places.words[i].offset, where, MVT::i16);
    SDValue at = dag.getNode(ISD::ADD, where, MVT::i16, stack, offset);
    stores.push_back(dag.getStore(chain, where, words[i], at, MachinePointerInfo()));
  }
  if (!stores.empty()) chain = dag.getNode(ISD::TokenFactor, where, MVT::Other, stores);

  // The others go into theirs, straight before the call.
  SDValue glue;
  SmallVector<SDValue, 16> ops(2);  // chain and callee, below
  for (unsigned i = 0; i < places.words.size(); ++i) {
    if (!places.words[i].in_register) continue;
    chain = dag.getCopyToReg(chain, where, places.words[i].reg, words[i], glue);
    glue = chain.getValue(1);
    ops.push_back(dag.getRegister(places.words[i].reg, MVT::i16));
  }
  ops[0] = chain;
  ops[1] = call.Callee;
  if (auto* g = dyn_cast<GlobalAddressSDNode>(call.Callee))
    ops[1] = dag.getTargetGlobalAddress(g->getGlobal(), where, MVT::i16, g->getOffset());
  else if (auto* e = dyn_cast<ExternalSymbolSDNode>(call.Callee))
    ops[1] = dag.getTargetExternalSymbol(e->getSymbol(), MVT::i16);
  // The call, which says what it preserves.
  const auto* registers = dag.getSubtarget().getRegisterInfo();
  ops.push_back(
      dag.getRegisterMask(registers->getCallPreservedMask(dag.getMachineFunction(), call.CallConv)));
  if (glue) ops.push_back(glue);
  chain = dag.getNode(DSPICISD::CALL, where, dag.getVTList(MVT::Other, MVT::Glue), ops);
  chain = dag.getCALLSEQ_END(chain, dag.getIntPtrConstant(places.stack_bytes, where, true),
                             dag.getIntPtrConstant(0, where, true), chain.getValue(1), where);
  // The result, word by word.
  glue = chain.getValue(1);
  for (unsigned i = 0; i < call.Ins.size(); ++i) {
    SDValue word = dag.getCopyFromReg(chain, where, kRegisters[i], MVT::i16, glue);
    chain = word.getValue(1);
    glue = word.getValue(2);
    values.push_back(word);
  }
  return chain;
}

bool DSPICTargetLowering::CanLowerReturn(CallingConv::ID, MachineFunction&, bool,
                                         const SmallVectorImpl<ISD::OutputArg>& outs, LLVMContext&) const {
  return outs.size() <= kResultRegisters;
}

SDValue DSPICTargetLowering::LowerReturn(SDValue chain, CallingConv::ID, bool,
                                         const SmallVectorImpl<ISD::OutputArg>& outs,
                                         const SmallVectorImpl<SDValue>& results, const SDLoc& where,
                                         SelectionDAG& dag) const {
  SDValue glue;
  SmallVector<SDValue, 6> ops(1);
  for (unsigned i = 0; i < outs.size(); ++i) {
    chain = dag.getCopyToReg(chain, where, kRegisters[i], results[i], glue);
    glue = chain.getValue(1);
    ops.push_back(dag.getRegister(kRegisters[i], MVT::i16));
  }
  ops[0] = chain;
  if (glue) ops.push_back(glue);
  const bool from_interrupt = is_interrupt(dag.getMachineFunction().getFunction());
  return dag.getNode(from_interrupt ? DSPICISD::RETURN_FROM_INTERRUPT : DSPICISD::RETURN, where, MVT::Other,
                     ops);
}

}  // namespace llvm
