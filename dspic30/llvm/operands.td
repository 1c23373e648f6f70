// SPDX-License-Identifier: MIT
// Operands: literals by their width, addresses by their shape; and the nodes of the selection graph that only
// this chip has (lowering.cpp makes them).

// --- what a constant becomes in an instruction that says the same with another constant
def neg_x  : SDNodeXForm<imm, [{ return CurDAG->getTargetConstant(-N->getSExtValue() & 0xFFFF, SDLoc(N), MVT::i16); }]>;
def com_x  : SDNodeXForm<imm, [{ return CurDAG->getTargetConstant(~N->getSExtValue() & 0xFFFF, SDLoc(N), MVT::i16); }]>;
def log2_x : SDNodeXForm<imm, [{ return CurDAG->getTargetConstant(Log2_32(N->getZExtValue() & 0xFFFF), SDLoc(N), MVT::i16); }]>;
def clog2_x: SDNodeXForm<imm, [{ return CurDAG->getTargetConstant(Log2_32(~N->getZExtValue() & 0xFFFF), SDLoc(N), MVT::i16); }]>;

// --- literals
def lit4   : Operand<i16>, ImmLeaf<i16, [{ return Imm >= 0 && Imm < 16; }]> { let PrintMethod = "print_literal"; }
def lit5   : Operand<i16>, ImmLeaf<i16, [{ return Imm >= 0 && Imm < 32; }]> { let PrintMethod = "print_literal"; }
def lit10  : Operand<i16>, ImmLeaf<i16, [{ return Imm >= 0 && Imm < 1024; }]> { let PrintMethod = "print_literal"; }
def lit14  : Operand<i16> { let PrintMethod = "print_literal"; }
def nlit5  : ImmLeaf<i16, [{ return Imm < 0 && Imm > -32; }]>;
def nlit10 : ImmLeaf<i16, [{ return Imm < 0 && Imm > -1024; }]>;
def clit5  : ImmLeaf<i16, [{ return Imm < 0 && Imm >= -32; }]>;
def clit10 : ImmLeaf<i16, [{ return Imm < 0 && Imm >= -1024; }]>;
def onebit : ImmLeaf<i16, [{ return isPowerOf2_32(Imm & 0xFFFF); }]>;
def nobit  : ImmLeaf<i16, [{ return isPowerOf2_32(~Imm & 0xFFFF); }]>;
def lit16  : Operand<i16> { let PrintMethod = "print_literal"; let EncoderMethod = "encode_word"; }
def bitno  : Operand<i16> { let PrintMethod = "print_literal"; }

// --- addresses in instructions
// Near: the first 8 KB, which file instructions reach (13 bits). MOV of a word reaches everything (15 bits).
def abs15  : Operand<i16> { let EncoderMethod = "encode_word_address"; }
def near   : Operand<i16> { let EncoderMethod = "encode_near"; }
def near8  : Operand<i16> { let EncoderMethod = "encode_near_byte"; }
def nearbit : Operand<i16> {  // near byte address and bit 0..15
  let MIOperandInfo = (ops i16imm, i16imm); let EncoderMethod = "encode_near_bit"; let PrintMethod = "print_near_bit"; }
def mem16  : Operand<i16> { let MIOperandInfo = (ops W, i16imm); let EncoderMethod = "encode_word_offset"; let PrintMethod = "print_memory"; }
def mem8   : Operand<i16> { let MIOperandInfo = (ops W, i16imm); let EncoderMethod = "encode_byte_offset"; let PrintMethod = "print_memory"; }
def brtarget : Operand<OtherVT> { let EncoderMethod = "encode_branch"; }
def calltarget : Operand<i16> { let EncoderMethod = "encode_branch"; }
def filetarget : Operand<i16> { let EncoderMethod = "encode_file"; }
def ccop   : Operand<i16> { let PrintMethod = "print_condition"; }

// --- addresses in the graph; each shape excludes the others, so the order of patterns does not matter
def addrabs   : ComplexPattern<i16, 1, "select_absolute", [], []>;     // symbol or even constant
def addrnear  : ComplexPattern<i16, 1, "select_near", [], []>;         // the same, known to be near
def addrnear8 : ComplexPattern<i16, 1, "select_near_byte", [], []>;    // odd ones as well
def addrri    : ComplexPattern<i16, 2, "select_word_offset", [], []>;  // [Ws+lit], even, -1024..1022
def addrri8   : ComplexPattern<i16, 2, "select_byte_offset", [], []>;  // [Ws+lit], -512..511
def addrrr    : ComplexPattern<i16, 2, "select_indexed", [], []>;      // [Ws+Wb]
def addrind   : ComplexPattern<i16, 1, "select_indirect", [], []>;     // [Ws]: what is none of these
def addrind8  : ComplexPattern<i16, 1, "select_indirect_byte", [], []>;

// --- nodes
def SDTCall : SDTypeProfile<0, -1, [SDTCisPtrTy<0>]>;
def callseq_start : SDNode<"ISD::CALLSEQ_START", SDCallSeqStart<[SDTCisVT<0, i16>, SDTCisVT<1, i16>]>, [SDNPHasChain, SDNPOutGlue]>;
def callseq_end : SDNode<"ISD::CALLSEQ_END", SDCallSeqEnd<[SDTCisVT<0, i16>, SDTCisVT<1, i16>]>, [SDNPHasChain, SDNPOptInGlue, SDNPOutGlue]>;
def dscall : SDNode<"DSPICISD::CALL", SDTCall, [SDNPHasChain, SDNPOutGlue, SDNPOptInGlue, SDNPVariadic]>;
def dsret  : SDNode<"DSPICISD::RETURN", SDTNone, [SDNPHasChain, SDNPOptInGlue, SDNPVariadic]>;
def dsreti : SDNode<"DSPICISD::RETURN_FROM_INTERRUPT", SDTNone, [SDNPHasChain, SDNPOptInGlue]>;
def wrap   : SDNode<"DSPICISD::WRAP", SDTypeProfile<1, 1, [SDTCisSameAs<0, 1>, SDTCisPtrTy<0>]>>;
def cmp    : SDNode<"DSPICISD::CMP", SDTypeProfile<0, 2, [SDTCisVT<0, i16>, SDTCisVT<1, i16>]>, [SDNPOutGlue]>;
def cmpb   : SDNode<"DSPICISD::CMPB", SDTypeProfile<0, 2, [SDTCisVT<0, i16>, SDTCisVT<1, i16>]>, [SDNPInGlue, SDNPOutGlue]>;
def btst   : SDNode<"DSPICISD::BTST", SDTypeProfile<0, 2, [SDTCisVT<0, i16>, SDTCisVT<1, i16>]>, [SDNPOutGlue]>;
def dsbrcc : SDNode<"DSPICISD::BRANCH", SDTypeProfile<0, 2, [SDTCisVT<0, OtherVT>, SDTCisVT<1, i16>]>, [SDNPHasChain, SDNPInGlue]>;
def select_ : SDNode<"DSPICISD::SELECT", SDTypeProfile<1, 3, [SDTCisSameAs<0, 1>, SDTCisSameAs<0, 2>, SDTCisVT<3, i16>]>, [SDNPInGlue]>;
def shlv   : SDNode<"DSPICISD::SHLV", SDTIntBinOp>;   // amounts 16..31 give 0 (or the sign)
def lsrv   : SDNode<"DSPICISD::LSRV", SDTIntBinOp>;
def asrv   : SDNode<"DSPICISD::ASRV", SDTIntBinOp>;
