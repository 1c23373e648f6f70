// SPDX-License-Identifier: MIT
// Moves: between registers, from and to memory. No move touches the flags. Suffixes: ld and st, x indexed by a register,
// pi post-incremented, o with an offset, abs at an address.
// --- bytes become words: sign or zero extended, from a register or on the way from memory
let Defs = [SR] in {
  def SErr : Alu2<0b111110110, 0, 0, 0, (outs W:$d), (ins W:$s), "se\t$s, $d", [(set W:$d, (sext_inreg W:$s, i8))]>;
  def ZErr : Alu2<0b111110111, 0, 0, 0, (outs W:$d), (ins W:$s), "ze\t$s, $d", [(set W:$d, (and W:$s, 255))]>;
  let mayLoad = 1 in {
  def SErm : Alu2<0b111110110, 0, 0, 1, (outs W:$d), (ins W:$s), "se\t[$s], $d", [(set W:$d, (sextloadi8 addrind8:$s))]>;
  def ZErm : Alu2<0b111110111, 0, 0, 1, (outs W:$d), (ins W:$s), "ze\t[$s], $d", [(set W:$d, (zextloadi8 addrind8:$s))]>;
  let Constraints = "$s2 = $s,@earlyclobber $d" in {
    def SEpi : Alu2<0b111110110, 0, 0, 3, (outs W:$d, W:$s2), (ins W:$s), "se\t[$s++], $d", []>;
    def ZEpi : Alu2<0b111110111, 0, 0, 3, (outs W:$d, W:$s2), (ins W:$s), "ze\t[$s++], $d", []>;
  } }
}
def : Pat<(i16 (extloadi8 addrind8:$s)), (ZErm addrind:$s)>;

// --- words
let isMoveReg = 1, hasSideEffects = 0 in
def MOVrr : MoveIndirect<0, 0, 0, (outs W:$d), (ins W:$s), "mov\t$s, $d", []> { let b = 0; }
let isReMaterializable = 1, isAsCheapAsAMove = 1, isMoveImm = 1 in
def MOVi : I<(outs W:$d), (ins lit16:$k), "mov\t$k, $d", [(set W:$d, imm:$k)]> {
  bits<4> d; bits<16> k; let Inst{23-20} = 2; let Inst{19-4} = k; let Inst{3-0} = d; }
def : Pat<(wrap tglobaladdr:$a), (MOVi tglobaladdr:$a)>;
def : Pat<(wrap texternalsym:$a), (MOVi texternalsym:$a)>;
def : Pat<(wrap tblockaddress:$a), (MOVi tblockaddress:$a)>;
class MoveOffset<bits<5> op, bit B, dag o, dag i, string a, list<dag> pat> : I<o, i, a, pat> {
  bits<4> r; bits<14> m; let Inst{23-19} = op; let Inst{18-15} = m{13-10}; let Inst{14} = B; let Inst{13-11} = m{9-7}; let Inst{6-4} = m{6-4}; }
let mayLoad = 1 in {
  def MOVld : MoveIndirect<1, 0, 0, (outs W:$d), (ins W:$s), "mov\t[$s], $d", [(set W:$d, (load addrind:$s))]> { let b = 0; }
  def MOVldx : MoveIndirect<6, 0, 0, (outs W:$d), (ins W:$s, W:$b), "mov\t[$s+$b], $d", []>;
  def MOVBldx : MoveIndirect<6, 0, 1, (outs W:$d), (ins W:$s, W:$b), "mov.b\t[$s+$b], $d", []>;
  let Constraints = "$s2 = $s,@earlyclobber $d" in
  def MOVldpi : MoveIndirect<3, 0, 0, (outs W:$d, W:$s2), (ins W:$s), "mov\t[$s++], $d", []> { let b = 0; }
  def MOVldo : MoveOffset<0b10010, 0, (outs W:$r), (ins mem16:$m), "mov\t$m, $r", [(set W:$r, (load addrri:$m))]>
    { let Inst{10-7} = r; let Inst{3-0} = m{3-0}; }
  def MOVBldo : MoveOffset<0b10010, 1, (outs W:$r), (ins mem8:$m), "mov.b\t$m, $r", [(set W:$r, (extloadi8 addrri8:$m))]>
    { let Inst{10-7} = r; let Inst{3-0} = m{3-0}; }
  let AddedComplexity = 20 in
  def MOVabs : I<(outs W:$d), (ins abs15:$f), "mov\t$f, $d", [(set W:$d, (load addrabs:$f))]> {
    bits<4> d; bits<15> f; let Inst{23-19} = 0b10000; let Inst{18-4} = f; let Inst{3-0} = d; }
}
let mayStore = 1 in {
  def MOVst : MoveIndirect<0, 1, 0, (outs), (ins W:$s, W:$d), "mov\t$s, [$d]", [(store W:$s, addrind:$d)]> { let b = 0; }
  def MOVBst : MoveIndirect<0, 1, 1, (outs), (ins W:$s, W:$d), "mov.b\t$s, [$d]", [(truncstorei8 W:$s, addrind8:$d)]> { let b = 0; }
  def MOVstx : MoveIndirect<0, 6, 0, (outs), (ins W:$s, W:$d, W:$b), "mov\t$s, [$d+$b]", []>;
  def MOVBstx : MoveIndirect<0, 6, 1, (outs), (ins W:$s, W:$d, W:$b), "mov.b\t$s, [$d+$b]", []>;
  let Constraints = "$d2 = $d" in {
    def MOVstpi : MoveIndirect<0, 3, 0, (outs W:$d2), (ins W:$s, W:$d), "mov\t$s, [$d++]", []> { let b = 0; }
    def MOVBstpi : MoveIndirect<0, 3, 1, (outs W:$d2), (ins W:$s, W:$d), "mov.b\t$s, [$d++]", []> { let b = 0; }
  }
  def MOVsto : MoveOffset<0b10011, 0, (outs), (ins W:$r, mem16:$m), "mov\t$r, $m", [(store W:$r, addrri:$m)]>
    { let Inst{10-7} = m{3-0}; let Inst{3-0} = r; }
  def MOVBsto : MoveOffset<0b10011, 1, (outs), (ins W:$r, mem8:$m), "mov.b\t$r, $m", [(truncstorei8 W:$r, addrri8:$m)]>
    { let Inst{10-7} = m{3-0}; let Inst{3-0} = r; }
  let AddedComplexity = 20 in
  def MOVabst : I<(outs), (ins W:$s, abs15:$f), "mov\t$s, $f", [(store W:$s, addrabs:$f)]> {
    bits<4> s; bits<15> f; let Inst{23-19} = 0b10001; let Inst{18-4} = f; let Inst{3-0} = s; }
}
def : Pat<(i16 (load (addrrr W:$a, W:$b))), (MOVldx W:$a, W:$b)>;
def : Pat<(i16 (extloadi8 (addrrr W:$a, W:$b))), (MOVBldx W:$a, W:$b)>;
def : Pat<(i16 (zextloadi8 (addrrr W:$a, W:$b))), (ZErr (MOVBldx W:$a, W:$b))>;
def : Pat<(i16 (sextloadi8 (addrrr W:$a, W:$b))), (SErr (MOVBldx W:$a, W:$b))>;
def : Pat<(i16 (zextloadi8 addrri8:$m)), (ZErr (MOVBldo addrri8:$m))>;
def : Pat<(i16 (sextloadi8 addrri8:$m)), (SErr (MOVBldo addrri8:$m))>;
def : Pat<(store W:$s, (addrrr W:$d, W:$b)), (MOVstx W:$s, W:$d, W:$b)>;
def : Pat<(truncstorei8 W:$s, (addrrr W:$d, W:$b)), (MOVBstx W:$s, W:$d, W:$b)>;
def : Pat<(post_store W:$s, W:$d, (i16 2)), (MOVstpi W:$s, W:$d)>;
def : Pat<(post_truncsti8 W:$s, W:$d, (i16 1)), (MOVBstpi W:$s, W:$d)>;
// REPEAT and MOV [Ws++], [Wd++]: nothing may come between them, so both are one instruction up to the very end
// (asm_printer.cpp)
let mayLoad = 1, mayStore = 1, Size = 8, Constraints = "$d2 = $d,$s2 = $s" in {
  def COPY_WORDS : Pseudo<(outs W:$d2, W:$s2), (ins W:$d, W:$s, i16imm:$n), []>;
  def COPY_BYTES : Pseudo<(outs W:$d2, W:$s2), (ins W:$d, W:$s, i16imm:$n), []>;
}
let mayLoad = 1, mayStore = 1 in {
  def MOVpipi : MoveIndirect<3, 3, 0, (outs), (ins W:$s, W:$d), "mov\t[$s++], [$d++]", []> { let b = 0; }
  def MOVBpipi : MoveIndirect<3, 3, 1, (outs), (ins W:$s, W:$d), "mov.b\t[$s++], [$d++]", []> { let b = 0; }
}
// a pair to and from the stack; both become two moves when the frame is laid out
let mayLoad = 1 in def LOAD_PAIR : Pseudo<(outs WP:$d), (ins mem16:$m)>;
let mayStore = 1 in def STORE_PAIR : Pseudo<(outs), (ins WP:$s, mem16:$m)>;
// address of a stack object
def LEA : Pseudo<(outs W:$d), (ins mem16:$m)>;
