// SPDX-License-Identifier: MIT
// Functions of the C library that a program calls without its header. gcc knows printf(), sqrt() and their
// like by itself, so such programs run on the robot; as "int f()" the arguments of the first would lie in the
// wrong places, and the result of the second would be an int.
#pragma once
#include "clang/Sema/ExternalSemaSource.h"
#include "llvm/ADT/IntrusiveRefCntPtr.h"

namespace cc {

/// `is_told`: each function that is taken so is a warning.
llvm::IntrusiveRefCntPtr<clang::ExternalSemaSource> implicit_functions(bool is_told);

}  // namespace cc
