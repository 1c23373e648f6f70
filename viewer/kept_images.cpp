// SPDX-License-Identifier: MIT
#include "viewer/kept_images.h"

#include <stdlib.h>  // mkdtemp

#include <filesystem>

#include "sim_core/base/input_file.h"
#include "sim_core/base/output_file.h"

namespace viewer {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kLargestImage = 64u << 20;  // bytes

std::string folder_of_its_own() {
  std::error_code error;
  const fs::path all = fs::temp_directory_path(error);
  std::string name = (error ? fs::path("/tmp") : all) / "twinpuck-view-XXXXXX";
  return mkdtemp(name.data()) ? name : "";
}

}  // namespace

KeptImages::~KeptImages() {
  std::error_code none;
  if (!folder_.empty()) fs::remove_all(folder_, none);
}

std::string KeptImages::keep(const std::string& image) {
  std::string bytes;
  if (!sim::read_input_file(image, kLargestImage, bytes).empty()) return image;
  if (const auto known = kept_.find(bytes); known != kept_.end()) return known->second;
  if (folder_.empty()) folder_ = folder_of_its_own();
  if (folder_.empty()) return image;
  const std::string path =
      folder_ + "/" + std::to_string(kept_.size()) + fs::path(image).extension().string();
  sim::OutputFile copy(path, "copy of an image");
  copy.append(bytes);
  copy.close();
  return !copy.error().empty() ? image : kept_[bytes] = path;
}

}  // namespace viewer
