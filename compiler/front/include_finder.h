// SPDX-License-Identifier: MIT
// Header lookup for code written on Windows: any case, backslashes, drive letters, and the e-puck library
// named by a path that does not exist here ("../../library/motor_led/e_motors.h", "C:\...\h\p30F6014A.h").
#pragma once
#include <set>
#include <string>
#include <vector>

#include "compiler/cache/readable_files.h"
#include "llvm/Support/VirtualFileSystem.h"

namespace cc {

/// Stands last in the include path; what is looked up below it is searched by trailing path components.
inline constexpr const char* kFallbackRoot = "/twinpuck-fallback";

/// Holds the vendor's headers alone (timer.h, uart.h ...), which lie among the library's in the first
/// fallback folder: a program's own header of such a name comes after them, unless it lies beside the file or
/// in a folder of -I.
inline constexpr const char* kVendorRoot = "/twinpuck-vendor";

/// The real file system, forgiving about case and separators in names of header files. `project`: the
/// controller's own folder. A copy of the e-puck library that lies outside it
/// ("../lib/motor_led/e_led.h") is passed over in favour of the first fallback folder's header of the
/// same place and name, because our library is what is linked. So is the chip's own p30Fxxxx.h wherever
/// the project has one. `missing` gets the names that were looked up and are not there as they were asked
/// for: a file of such a name would be taken.
llvm::IntrusiveRefCntPtr<llvm::vfs::FileSystem> forgiving_file_system(
    std::vector<std::string> fallback_folders, std::string project, std::set<std::string>& missing);

/// `files`, in which there are only those that may be read. `refused`: names of others that were asked for.
llvm::IntrusiveRefCntPtr<llvm::vfs::FileSystem> bounded_file_system(
    llvm::IntrusiveRefCntPtr<llvm::vfs::FileSystem> files, const ReadableFiles& readable,
    std::set<std::string>& refused);

/// Whether one of them is meant by an #include of `name`.
bool is_refused(const std::set<std::string>& refused, llvm::StringRef name);

/// The header below the folders whose name is most like `name`, as an #include would have it; "" for none.
std::string header_like(const std::string& name, const std::vector<std::string>& folders);

}  // namespace cc
