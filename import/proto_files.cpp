// SPDX-License-Identifier: MIT
#include "import/proto_files.h"

#include <filesystem>
#include <vector>

#include "sim_core/base/input_file.h"

namespace wbt {

const Proto* ProtoFiles::find(const std::string& type) {
  namespace fs = std::filesystem;
  if (const auto declared = text_.protos.find(type); declared != text_.protos.end()) return &declared->second;
  if (const auto read = files_.find(type); read != files_.end()) return &read->second;
  if (folder_.empty() || missing_.count(type) || type.size() >= 100 || type.find('/') != std::string::npos)
    return nullptr;
  std::vector<fs::path> places{fs::path(folder_) / ".." / "protos" / (type + ".proto"),
                               fs::path(folder_) / (type + ".proto")};
  for (const std::string& url : text_.extern_protos) {
    if (url.find("://") == std::string::npos && fs::path(url).stem().string() == type)
      places.insert(places.begin(), fs::path(folder_) / url);
  }
  std::error_code error;
  for (const fs::path& p : places) {
    Proto found;
    std::string text;
    if (!fs::is_regular_file(p, error) || !sim::read_input_file(p, kLongestFile, text).empty()) continue;
    if (read_proto_text(text, found)) return &files_.emplace(type, std::move(found)).first->second;
  }
  missing_.insert(type);
  return nullptr;
}

}  // namespace wbt
