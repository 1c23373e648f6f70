// SPDX-License-Identifier: MIT
// The translator's front door: one for all robots of a process. Robots that run the same program share its
// code. What is translated when depends on nothing but the programs' own course, and changes no result.
#include <llvm/Bitcode/BitcodeReader.h>
#include <llvm/ExecutionEngine/Orc/LLJIT.h>
#include <llvm/Support/TargetSelect.h>

#include <mutex>

#include "dspic30/translate/region.h"

extern "C" const char dspic_semantics[], dspic_semantics_end[];

namespace dspic::translate {

namespace {

class SharedTranslator final : public Translator {
 public:
  /// Null: LLVM cannot make code for this machine.
  static std::unique_ptr<SharedTranslator> make();
  Translation translate(const Cpu& cpu, const Decoded* head) override;

 private:
  std::mutex mutex_;
  llvm::orc::ThreadSafeContext context_{std::make_unique<llvm::LLVMContext>()};
  std::unique_ptr<llvm::orc::LLJIT> jit_;
  std::unique_ptr<Semantics> semantics_;
  std::map<std::string, Translation> known_;
};

template <class T>
bool take(llvm::Expected<T> from, T& to) {
  if (from) {
    to = std::move(*from);
    return true;
  }
  llvm::consumeError(from.takeError());
  return false;
}

std::unique_ptr<SharedTranslator> SharedTranslator::make() {
  llvm::InitializeNativeTarget();
  llvm::InitializeNativeTargetAsmPrinter();
  auto made = std::make_unique<SharedTranslator>();
  auto machine = llvm::orc::JITTargetMachineBuilder(llvm::Triple(LLVM_HOST_TRIPLE));
  machine.setCodeGenOptLevel(llvm::CodeGenOpt::Less);
  machine.getOptions().EnableFastISel = true;  // makes code in two thirds of the time, hardly slower
  llvm::orc::LLJITBuilder builder;
  builder.setJITTargetMachineBuilder(std::move(machine));
  if (!take(builder.create(), made->jit_)) return nullptr;
  const llvm::StringRef bitcode(dspic_semantics,
                                static_cast<std::size_t>(dspic_semantics_end - dspic_semantics));
  std::unique_ptr<llvm::Module> module;
  if (!take(llvm::getLazyBitcodeModule({bitcode, "semantics"}, *made->context_.getContext()), module))
    return nullptr;
  made->semantics_ = std::make_unique<Semantics>(std::move(module));
  return made;
}

Translation SharedTranslator::translate(const Cpu& cpu, const Decoded* head) {
  const std::lock_guard lock(mutex_);
  const std::vector<Item> items = stretch(cpu, head);
  if (items.empty()) return {};
  const auto [place, is_new] = known_.try_emplace(key_of(items));
  Translation& made = place->second;
  if (!is_new) return made;
  const std::string name = "stretch" + std::to_string(known_.size());
  auto module = dspic::translate::translate(*semantics_, cpu, items, name);
  if (!module) return made;
  if (llvm::Error e = jit_->addIRModule({std::move(module), context_})) {
    llvm::consumeError(std::move(e));
    return made;
  }
  llvm::JITEvaluatedSymbol symbol;
  if (!take(jit_->lookup(name), symbol)) return made;
  made.run = reinterpret_cast<Run>(symbol.getAddress());
  for (const Item& item : items)
    if (!item.by_call) made.pointers |= 1u << item.decoded.s | 1u << item.decoded.d;
  return made;
}

}  // namespace
}  // namespace dspic::translate

/// Null: no translator on this machine. Lives as long as the process.
extern "C" dspic::Translator* dspic_translator() {
  static auto* translator = dspic::translate::SharedTranslator::make().release();
  return translator;
}
