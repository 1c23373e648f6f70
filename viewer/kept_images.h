// SPDX-License-Identifier: MIT
// Copies of the images that robots ran, as long as a page may want to repeat the run: a program that is built anew
// takes the place of its image.
#pragma once
#include <map>
#include <string>

namespace viewer {

class KeptImages {
 public:
  KeptImages() = default;
  KeptImages(const KeptImages&) = delete;
  KeptImages& operator=(const KeptImages&) = delete;
  /// The copies go.
  ~KeptImages();

  /// A file with what `image` holds now. Where none can be written, the image itself: then the run is repeated with
  /// what it has become.
  std::string keep(const std::string& image);

 private:
  std::string folder_;                       // of its own, made with the first copy
  std::map<std::string, std::string> kept_;  // by content
};

}  // namespace viewer
