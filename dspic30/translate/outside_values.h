// SPDX-License-Identifier: MIT
// What a stretch refers to outside of itself, as it moves to a module of its own.
#pragma once
#include <dlfcn.h>
#include <llvm/IR/Constants.h>
#include <llvm/IR/GlobalVariable.h>
#include <llvm/IR/Module.h>
#include <llvm/Transforms/Utils/ValueMapper.h>

namespace dspic::translate {

/// Constants by value, functions by their address in this process.
class OutsideValues final : public llvm::ValueMaterializer {
 public:
  explicit OutsideValues(llvm::Module& into) : into_(into) {}
  llvm::Value* materialize(llvm::Value* value) override {
    const auto* const global = llvm::dyn_cast<llvm::GlobalValue>(value);
    if (!global) return nullptr;
    if (const auto* const table = llvm::dyn_cast<llvm::GlobalVariable>(global);
        table && table->isConstant() && table->hasInitializer())
      return new llvm::GlobalVariable(into_, table->getValueType(), true, llvm::GlobalValue::PrivateLinkage,
                                      const_cast<llvm::Constant*>(table->getInitializer()));
    void* const address = dlsym(RTLD_DEFAULT, global->getName().str().c_str());
    is_whole &= address != nullptr;
    return llvm::ConstantExpr::getIntToPtr(llvm::ConstantInt::get(llvm::Type::getInt64Ty(into_.getContext()),
                                                                  reinterpret_cast<std::uint64_t>(address)),
                                           global->getType());
  }
  bool is_whole = true;

 private:
  llvm::Module& into_;
};

}  // namespace dspic::translate
