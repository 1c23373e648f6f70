// SPDX-License-Identifier: MIT
// See include_finder.h. Exact names are always tried first, so a tidy project never pays for this.
#include "include_finder.h"

#include <algorithm>
#include <tuple>

#include "llvm/Support/FileSystem.h"
#include "llvm/Support/Path.h"

namespace cc {
namespace {

using llvm::StringRef;

std::vector<std::string> components(const std::string& path) {
  std::vector<std::string> parts;
  std::string part;
  for (char c : path + "/") {
    if (c != '/' && c != '\\') {
      part += c;
      continue;
    }
    if (!part.empty() && part != ".") parts.push_back(part);
    part.clear();
  }
  return parts;
}

/// The existing path that differs from `parts` below `root` in case only, or "".
std::string match_ignoring_case(std::string root, const std::vector<std::string>& parts, size_t first) {
  for (size_t i = first; i < parts.size(); ++i) {
    if (parts[i] == "..") {
      root += "/..";
      continue;
    }
    std::string exact = root + "/" + parts[i];
    if (llvm::sys::fs::exists(exact)) {
      root = exact;
      continue;
    }
    std::string found;
    std::error_code ec;
    for (llvm::sys::fs::directory_iterator it(root.empty() ? "/" : root, ec), end; it != end && !ec;
         it.increment(ec)) {
      StringRef name = llvm::sys::path::filename(it->path());
      // several spellings in one folder: the first by name, so the choice does not hang on the disk's order
      if (name.equals_insensitive(parts[i]) && (found.empty() || name < StringRef(found))) found = name.str();
    }
    if (found.empty()) return "";
    root += "/" + found;
  }
  return llvm::sys::fs::exists(root) ? root : "";
}

class ForgivingFileSystem : public llvm::vfs::ProxyFileSystem {
 public:
  ForgivingFileSystem(std::vector<std::string> folders, std::string project, std::set<std::string>& missing)
      : ProxyFileSystem(llvm::vfs::getRealFileSystem()),
        folders_(std::move(folders)),
        project_(std::move(project)),
        missing_(missing) {}

  llvm::ErrorOr<llvm::vfs::Status> status(const llvm::Twine& path) override {
    std::string ours = replaced_copy(path.str());
    if (!ours.empty()) {
      auto status = ProxyFileSystem::status(ours);
      if (status) return llvm::vfs::Status::copyWithNewName(*status, ours);
    }
    auto exact = ProxyFileSystem::status(path);
    if (exact) return exact;
    missing_.insert(path.str());
    std::string other = find(path.str());
    if (other.empty()) return exact;
    auto found = ProxyFileSystem::status(other);
    if (found) return llvm::vfs::Status::copyWithNewName(*found, other);
    return found;
  }

  llvm::ErrorOr<std::unique_ptr<llvm::vfs::File>> openFileForRead(const llvm::Twine& path) override {
    std::string ours = replaced_copy(path.str());
    if (!ours.empty()) return ProxyFileSystem::openFileForRead(ours);
    // a pipe or a device is no file that ends
    auto known = ProxyFileSystem::status(path);
    if (known && !known->isRegularFile() && !known->isDirectory())
      return std::make_error_code(std::errc::invalid_argument);
    auto exact = ProxyFileSystem::openFileForRead(path);
    if (exact) return exact;
    missing_.insert(path.str());
    std::string other = find(path.str());
    if (other.empty()) return exact;
    return ProxyFileSystem::openFileForRead(other);
  }

 private:
  /// Our header for a copy of the library outside the project, "" for anything else.
  std::string replaced_copy(const std::string& path) const {
    if (project_.empty() || folders_.empty() || !StringRef(path).endswith_insensitive(".h")) return "";
    llvm::SmallString<256> plain(path);
    llvm::sys::fs::make_absolute(plain);
    llvm::sys::path::remove_dots(plain, /*remove_dot_dot=*/true);
    if (plain.str().startswith(folders_.front() + "/")) return "";
    if (StringRef name = llvm::sys::path::filename(plain); name.startswith_insensitive("p30f"))
      return match_ignoring_case(folders_.front(), {name.str()}, 0);
    if (plain.str().startswith(project_ + "/")) return "";
    auto parts = components(plain.str().str());
    if (parts.size() < 2) return "";
    // folder and name, so that a header that merely has a library's name stays the project's
    for (size_t tail : {size_t{3}, size_t{2}}) {
      if (parts.size() < tail) continue;
      std::string ours = match_ignoring_case(folders_.front(), parts, parts.size() - tail);
      if (!ours.empty()) return ours;
    }
    return "";
  }

  std::string find(const std::string& path) {
    StringRef name = path;
    if (name == kFallbackRoot || name == kVendorRoot) return "";
    if (name.startswith(std::string(kVendorRoot) + "/")) {
      const StringRef header = llvm::sys::path::filename(name);
      for (const char* vendors : {"adc12.h", "dsp.h", "i2c.h", "libpic30.h", "timer.h", "uart.h", "xc.h"})
        if (header.equals_insensitive(vendors) && !folders_.empty())
          return match_ignoring_case(folders_.front(), {header.str()}, 0);
      return "";
    }
    if (name.startswith(std::string(kFallbackRoot) + "/")) {
      auto parts = components(name.substr(std::string(kFallbackRoot).size()).str());
      parts.erase(std::remove(parts.begin(), parts.end(), ".."), parts.end());
      bool is_header = !parts.empty() && llvm::StringRef(parts.back()).contains('.');
      if (!is_header) return "/";  // any folder "exists" there; what counts is the header looked up in it
      // the longest tail that exists wins: motor_led/e_motors.h before e_motors.h
      for (size_t first = 0; first < parts.size(); ++first)
        for (const auto& folder : folders_) {
          std::string found = match_ignoring_case(folder, parts, first);
          if (!found.empty()) return found;
        }
      return "";
    }
    // relative to the working folder when not absolute
    auto parts = components(path);
    std::string root = name.startswith("/") ? "" : ".";
    return match_ignoring_case(root, parts, 0);
  }

  std::vector<std::string> folders_;
  std::string project_;
  std::set<std::string>& missing_;
};

class BoundedFileSystem : public llvm::vfs::ProxyFileSystem {
 public:
  BoundedFileSystem(llvm::IntrusiveRefCntPtr<llvm::vfs::FileSystem> files, const ReadableFiles& readable,
                    std::set<std::string>& refused)
      : ProxyFileSystem(std::move(files)), readable_(readable), refused_(refused) {}

  llvm::ErrorOr<llvm::vfs::Status> status(const llvm::Twine& path) override {
    const auto nothing = std::make_error_code(std::errc::no_such_file_or_directory);
    const std::string name = path.str();
    // a file of another name does not stand in for one that is there
    if (StringRef asked = name; asked.consume_front(kFallbackRoot) && is_refused(refused_, asked.ltrim('/')))
      return nothing;
    auto found = ProxyFileSystem::status(path);
    if (!found || found->isDirectory() || readable_.has(found->getName().str())) return found;
    refused_.insert(name);
    return nothing;
  }
  llvm::ErrorOr<std::unique_ptr<llvm::vfs::File>> openFileForRead(const llvm::Twine& path) override {
    if (auto found = status(path); !found) return found.getError();
    return ProxyFileSystem::openFileForRead(path);
  }

 private:
  const ReadableFiles& readable_;
  std::set<std::string>& refused_;
};

}  // namespace

bool is_refused(const std::set<std::string>& refused, llvm::StringRef name) {
  return !name.empty() && std::any_of(refused.begin(), refused.end(), [&](const StringRef path) {
    return path == name || (path.endswith(name) && path.drop_back(name.size()).endswith("/"));
  });
}

llvm::IntrusiveRefCntPtr<llvm::vfs::FileSystem> bounded_file_system(
    llvm::IntrusiveRefCntPtr<llvm::vfs::FileSystem> files, const ReadableFiles& readable,
    std::set<std::string>& refused) {
  return new BoundedFileSystem(std::move(files), readable, refused);
}

llvm::IntrusiveRefCntPtr<llvm::vfs::FileSystem> forgiving_file_system(std::vector<std::string> folders,
                                                                      std::string project,
                                                                      std::set<std::string>& missing) {
  return new ForgivingFileSystem(std::move(folders), std::move(project), missing);
}

std::string header_like(const std::string& name, const std::vector<std::string>& folders) {
  const std::string wanted = StringRef(name).lower();
  const auto wanted_parts = components(wanted);
  if (wanted_parts.empty()) return "";
  // a third of the letters may be wrong; the folders decide between headers of one name
  const unsigned most = unsigned(wanted_parts.back().size()) / 3;
  std::tuple<unsigned, unsigned, std::string> best{most + 1, 0, ""};
  for (const std::string& folder : folders) {
    std::error_code ec;
    for (llvm::sys::fs::recursive_directory_iterator it(folder, ec), end; it != end && !ec;
         it.increment(ec)) {
      const StringRef path = it->path();
      if (!path.endswith_insensitive(".h")) continue;
      const std::string below = path.substr(folder.size()).ltrim('/').str();
      const std::string file = llvm::sys::path::filename(path).lower();
      best =
          std::min(best, std::make_tuple(StringRef(file).edit_distance(wanted_parts.back(), true, most + 1),
                                         StringRef(StringRef(below).lower()).edit_distance(wanted), below));
    }
  }
  return std::get<2>(best);
}

}  // namespace cc
