// SPDX-License-Identifier: MIT
// Where the functions of instructions are.
#include <llvm/IR/InstIterator.h>
#include <llvm/IR/InstrTypes.h>
#include <llvm/Support/Error.h>
#include <llvm/Transforms/Utils/Evaluator.h>

#include "dspic30/translate/region.h"

namespace dspic::translate {

using namespace llvm;

namespace {

constexpr const char* kChoosers[] = {"_ZN5dspic17choose_arithmeticENS_4InsnERKNS_6FieldsE",
                                     "_ZN5dspic11choose_moveENS_4InsnERKNS_6FieldsE",
                                     "_ZN5dspic10choose_bitENS_4InsnERKNS_6FieldsE",
                                     "_ZN5dspic15choose_multiplyENS_4InsnERKNS_6FieldsE",
                                     "_ZN5dspic11choose_flowENS_4InsnERKNS_6FieldsE",
                                     "_ZN5dspic13choose_systemENS_4InsnERKNS_6FieldsE",
                                     "_ZN5dspic10choose_dspENS_4InsnERKNS_6FieldsE"};

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

}  // namespace dspic::translate
