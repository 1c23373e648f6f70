// SPDX-License-Identifier: MIT
// Which instructions are translated together, and where their functions are.
#include <llvm/IR/InstIterator.h>
#include <llvm/IR/InstrTypes.h>
#include <llvm/Support/Error.h>
#include <llvm/Transforms/Utils/Evaluator.h>

#include <algorithm>

#include "dspic30/translate/region.h"

namespace dspic::translate {

namespace {

using namespace llvm;

constexpr std::ptrdiff_t kLongest = 48;  // words

constexpr const char* kChoosers[] = {"_ZN5dspic17choose_arithmeticENS_4InsnERKNS_6FieldsE",
                                     "_ZN5dspic11choose_moveENS_4InsnERKNS_6FieldsE",
                                     "_ZN5dspic10choose_bitENS_4InsnERKNS_6FieldsE",
                                     "_ZN5dspic15choose_multiplyENS_4InsnERKNS_6FieldsE",
                                     "_ZN5dspic11choose_flowENS_4InsnERKNS_6FieldsE",
                                     "_ZN5dspic13choose_systemENS_4InsnERKNS_6FieldsE",
                                     "_ZN5dspic10choose_dspENS_4InsnERKNS_6FieldsE"};
bool has(const Row& row, Operand kind) {
  return std::find(row.kinds.begin(), row.kinds.end(), kind) != row.kinds.end();
}

bool ends_a_stretch(Insn id) {
  switch (id) {
    case Insn::Bra_Expr:
    case Insn::Bra_Wn:
    case Insn::Goto_Expr:
    case Insn::Goto_Wn:
    case Insn::Call_Expr:
    case Insn::Call_Wn:
    case Insn::Rcall_Expr:
    case Insn::Rcall_Wn:
    case Insn::Return:
    case Insn::Retfie:
    case Insn::Retlw_lit10_Wn:
    case Insn::Do_lit14_Expr:
    case Insn::Do_Wn_Expr:
    case Insn::Reset:
    case Insn::Pwrsav_lit1:
    case Insn::Clrwdt:
    case Insn::Disi_lit14:
      return true;
    default:
      return false;
  }
}

bool is_skip(const Row& row) {
  return StringRef(row.mnemonic).startswith("BTSS") || StringRef(row.mnemonic).startswith("BTSC") ||
         StringRef(row.mnemonic).startswith("CPS");
}

}  // namespace

Semantics::Semantics(std::unique_ptr<Module> bitcode) : module(std::move(bitcode)) {
  SmallVector<Function*, 32> work;
  for (const char* name : kChoosers) work.push_back(module->getFunction(name));
  while (!work.empty()) {  // they are evaluated, with what they call
    Function* const f = work.pop_back_val();
    if (!f || !f->isMaterializable() || f->materialize()) continue;
    for (Instruction& i : instructions(*f))
      if (auto* const call = dyn_cast<CallBase>(&i)) work.push_back(call->getCalledFunction());
  }
}

Function* Semantics::of(std::uint32_t word) {
  const auto [place, is_new] = found.try_emplace(word);
  const Row* const row = find_row(word);
  if (!is_new || !row) return place->second;
  const Fields fields = fields_of(*row, word);
  LLVMContext& context = module->getContext();
  ArrayRef<unsigned> all(reinterpret_cast<const unsigned*>(&fields), sizeof fields / sizeof(unsigned));
  Constant* const values = ConstantDataArray::get(context, all);
  auto* const given =
      new GlobalVariable(*module, values->getType(), true, GlobalValue::PrivateLinkage, values);
  for (const char* name : kChoosers) {
    Function* const chooser = module->getFunction(name);
    if (!chooser) continue;
    const FunctionType* const type = chooser->getFunctionType();
    Evaluator evaluator(module->getDataLayout(), nullptr);
    Constant* result = nullptr;
    const SmallVector<Constant*, 2> arguments = {
        ConstantInt::get(type->getParamType(0), static_cast<std::uint64_t>(row->id)),
        ConstantExpr::getBitCast(given, type->getParamType(1))};
    if (!evaluator.EvaluateFunction(chooser, result, arguments) || !result || result->isNullValue()) continue;
    place->second = dyn_cast<Function>(result->stripPointerCasts());
    break;
  }
  given->eraseFromParent();
  return place->second;
}

std::vector<Item> stretch(const Cpu& cpu, const Decoded* head) {
  std::vector<Item> items;
  std::ptrdiff_t reach = 0;  // as far as jumps within it lead
  for (std::ptrdiff_t place = 0; place < kLongest && head + place < cpu.code() + kFlashWords;) {
    const Decoded* const d = head + place;
    Item item;
    item.word = cpu.program.read(cpu.address_of(d));
    const Row* const row = find_row(item.word);
    if (!row || d == cpu.loop_end) break;
    const bool is_known = cpu.is_decoded(d) && cpu.plain(d) == function_of(item.word);
    if (!is_known && (items.empty() || place >= reach)) break;
    const bool ends = ends_a_stretch(row->id);
    if (is_known) {
      item.is_last = ends && row->id != Insn::Bra_Expr;
      item.place = place;
      item.decoded = *d;
      item.plain = cpu.plain(d);
      item.words = row->words;
      item.by_call = ((1u << d->s | 1u << d->d) & cpu.unsteady_pointers) != 0;
      // a branch that is taken, and a skip over two words, take longer
      item.most_cycles = d->cycles + (has(*row, Operand::Branch) ? 1 : is_skip(*row) ? 2 : 0);
      if (has(*row, Operand::Branch) && row->id != Insn::Rcall_Expr)
        reach = std::max<std::ptrdiff_t>(reach, place + d->imm);
      if (is_skip(*row)) reach = std::max<std::ptrdiff_t>(reach, place + 1 + d->d);
      items.push_back(item);
    }
    place += row->words;
    if (ends && place > reach) break;
  }
  if (items.size() < 3 || items[0].plain == &no_operation) items.clear();
  return items;
}

std::string key_of(const std::vector<Item>& items) {
  std::string key;
  const auto add = [&key](const auto& value) {
    key.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  for (const Item& item : items) {
    add(item.place);
    add(item.word);
    add(item.decoded.lead);
    add(item.decoded.d);
    add(item.decoded.s_kind);
    add(item.decoded.d_kind);
    add(item.by_call);
  }
  return key;
}

}  // namespace dspic::translate
