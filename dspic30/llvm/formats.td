// SPDX-License-Identifier: MIT
// Formats: where the operands lie in the 24 bits of an instruction word. Names of fields are the manual's: b base
// register, s source, d destination, p and q their addressing modes, B byte form, k literal, f file address.
class I<dag outs, dag ins, string asm, list<dag> pat = []> : Instruction {
  let Namespace = "DSPIC"; let OutOperandList = outs; let InOperandList = ins; let AsmString = asm; let Pattern = pat;
  let Size = 4; bits<24> Inst;
}
class Pseudo<dag outs, dag ins, list<dag> pat = []> : I<outs, ins, "; pseudo", pat> { let isPseudo = 1; let Inst = 0; }

// [23:19]=op wwww B qqq dddd ppp ssss
class Alu3<bits<5> op, bits<3> q, bits<3> p, dag o, dag i, string a, list<dag> pat> : I<o, i, a, pat> {
  bits<4> b; bits<4> d; bits<4> s;
  let Inst{23-19} = op; let Inst{18-15} = b; let Inst{14} = 0; let Inst{13-11} = q; let Inst{10-7} = d; let Inst{6-4} = p; let Inst{3-0} = s; }
class Alu3Lit5<bits<5> op, dag o, dag i, string a, list<dag> pat> : I<o, i, a, pat> {
  bits<4> b; bits<4> d; bits<5> k;
  let Inst{23-19} = op; let Inst{18-15} = b; let Inst{14} = 0; let Inst{13-11} = 0; let Inst{10-7} = d; let Inst{6-5} = 3; let Inst{4-0} = k; }
class AluLit10<bits<9> op, dag o, dag i, string a, list<dag> pat> : I<o, i, a, pat> {  // #lit10,Wn
  bits<4> d; bits<10> k; let Constraints = "$d = $n";
  let Inst{23-15} = op; let Inst{14} = 0; let Inst{13-4} = k; let Inst{3-0} = d; }
class Alu2<bits<9> op, bit B, bits<3> q, bits<3> p, dag o, dag i, string a, list<dag> pat> : I<o, i, a, pat> {
  bits<4> d; bits<4> s;
  let Inst{23-15} = op; let Inst{14} = B; let Inst{13-11} = q; let Inst{10-7} = d; let Inst{6-4} = p; let Inst{3-0} = s; }
class MoveIndirect<bits<3> g, bits<3> h, bit B, dag o, dag i, string a, list<dag> pat> : I<o, i, a, pat> { // MOV Wso,Wdo
  bits<4> b; bits<4> d; bits<4> s;
  let Inst{23-19} = 0b01111; let Inst{18-15} = b; let Inst{14} = B; let Inst{13-11} = h; let Inst{10-7} = d; let Inst{6-4} = g; let Inst{3-0} = s; }
class Shift3<bits<9> op, bits<3> f, dag o, dag i, string a, list<dag> pat> : I<o, i, a, pat> {  // shifts, MUL
  bits<4> b; bits<4> d; bits<4> s;
  let Inst{23-15} = op; let Inst{14-11} = b; let Inst{10-7} = d; let Inst{6-4} = f; let Inst{3-0} = s; }
class File<bits<9> op, bit B, dag o, dag i, string a, list<dag> pat> : I<o, i, a, pat> {   // f, result to f
  bits<13> f; let Inst{23-15} = op; let Inst{14} = B; let Inst{13} = 1; let Inst{12-0} = f; }
