// SPDX-License-Identifier: MIT
// What a stretch refers to outside of itself, as it moves to a module of its own.
#pragma once
#include <llvm/IR/Constants.h>
#include <llvm/IR/GlobalVariable.h>
#include <llvm/IR/Module.h>
#include <llvm/Transforms/Utils/ValueMapper.h>

namespace dspic::translate {

/// Constants by value, functions by name.
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
    const auto* const function = llvm::dyn_cast<llvm::Function>(global);
    return function ? into_.getOrInsertFunction(function->getName(), function->getFunctionType()).getCallee()
                    : nullptr;
  }

 private:
  llvm::Module& into_;
};

}  // namespace dspic::translate
