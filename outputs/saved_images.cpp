// SPDX-License-Identifier: MIT
#include "outputs/saved_images.h"

#include <fmt/format.h>

#include "outputs/output_folder.h"
#include "sim_core/record/image_file.h"

namespace outputs {

bool SavedImages::open(twin::Twin& twin, std::vector<std::string>& problems) {
  if (!make_output_folder(folder_, "--save-images", problems)) return false;
  for (int r = 0; r < twin.robots(); ++r) {
    board::Camera* camera = twin.mind(r).board().camera();
    if (!camera) continue;
    const std::string file = output_file(folder_, twin.world(), r);
    camera->on_picture = [this, file](const board::CameraPicture& picture) {
      const std::string path = fmt::format("{}_{:06}.png", file, picture.number);
      const std::string wrong =
          sim::write_png(path, picture.columns, picture.rows, board::decode_picture(picture));
      if (wrong.empty()) return;
      const std::lock_guard<std::mutex> held(writing_);
      if (!failed_.exchange(true)) first_ = wrong;
    };
  }
  return true;
}

std::string SavedImages::error() const {
  const std::lock_guard<std::mutex> held(writing_);
  return folder_ + ": --save-images: " + first_;
}

}  // namespace outputs
