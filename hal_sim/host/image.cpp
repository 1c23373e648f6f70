// SPDX-License-Identifier: MIT
#include "hal_sim/host/image.h"

#include <elf.h>

#include <algorithm>
#include <cstring>

#include "hal_sim/host/image_stamp.h"
#include "hal_sim/host/symbols.h"
#include "sim_core/base/check.h"
#include "sim_core/base/input_file.h"

namespace host {

namespace {

constexpr std::size_t kLongest = 64u << 20;  // bytes [assumed: a hundred times the largest]

// do all segments lie inside the file?
bool is_whole(const std::string& file) {
  Elf64_Ehdr head;
  if (file.size() < sizeof head) return false;
  std::memcpy(&head, file.data(), sizeof head);
  if (head.e_phentsize != sizeof(Elf64_Phdr)) return false;
  for (unsigned i = 0; i < head.e_phnum; ++i) {
    Elf64_Phdr segment;
    const std::uint64_t at = head.e_phoff + i * sizeof segment;
    if (at > file.size() || file.size() - at < sizeof segment) return false;
    std::memcpy(&segment, file.data() + at, sizeof segment);
    if (segment.p_offset > file.size() || segment.p_filesz > file.size() - segment.p_offset) return false;
  }
  return true;
}

constexpr unsigned char kCoffMagic[] = {0x36, 0x12};
constexpr const char* kCoff = "a COFF of the dsPIC, as MPLAB C30 made by default";

std::string what_is(const std::string& file) {
  if (file.empty()) return "an empty file";
  unsigned char head[20] = {};
  std::memcpy(head, file.data(), std::min(file.size(), sizeof head));
  if (head[0] == ':') return "an Intel hex file";
  if (head[0] == kCoffMagic[0] && head[1] == kCoffMagic[1]) return kCoff;
  if (std::memcmp(head, ELFMAG, SELFMAG) != 0) return "a file that is no ELF";
  const unsigned machine = head[18] | head[19] << 8;
  if (head[16] == ET_DYN && machine == EM_X86_64 && head[4] == ELFCLASS64)
    return is_whole(file) ? "a shared object of this PC" : "a shared object that has been cut off";
  if (machine == 118) return "an ELF for the dsPIC30F";
  return "an ELF of another kind (type " + std::to_string(head[16]) + ", machine " + std::to_string(machine) +
         ")";
}

}  // namespace

ImageCopy::ImageCopy(std::string path, std::unique_ptr<ImageMemory> memory, const tp_image* image)
    : path_(std::move(path)), memory_(std::move(memory)), image_(image) {
  const std::size_t whole = static_cast<std::size_t>(image->data_end - image->data_begin);
  const std::size_t hole = static_cast<std::size_t>(image->hole_end - image->hole_begin);
  private_bytes_ = whole - hole;
  start_values_.resize(private_bytes_);
  copy_out(start_values_.data());
  const char* heap = static_cast<const char*>(memory_->symbol("tp_image_heap"));
  const void* size = memory_->symbol("tp_image_heap_bytes");
  if (!heap || !size || heap < image->data_begin || heap >= image->hole_begin) return;
  std::uint16_t bytes;
  std::memcpy(&bytes, size, sizeof bytes);
  heap_offset_ = static_cast<std::size_t>(heap - image->data_begin);
  heap_bytes_ = std::min<std::size_t>(bytes, static_cast<std::size_t>(image->hole_begin - heap));
}

void ImageCopy::copy_out(char* to) const {
  if (private_bytes_ == 0) return;
  const std::size_t before = static_cast<std::size_t>(image_->hole_begin - image_->data_begin);
  std::memcpy(to, image_->data_begin, before);
  if (before < private_bytes_) std::memcpy(to + before, image_->hole_end, private_bytes_ - before);
}

void ImageCopy::copy_in(const char* from) const {
  if (private_bytes_ == 0) return;
  const std::size_t before = static_cast<std::size_t>(image_->hole_begin - image_->data_begin);
  std::memcpy(image_->data_begin, from, before);
  if (before < private_bytes_) std::memcpy(image_->hole_end, from + before, private_bytes_ - before);
}

Image::Image(std::string path, std::string file)
    : path_(std::move(path)), file_(std::move(file)), symbols_(std::make_unique<Symbols>(path_)) {}
Image::~Image() = default;

std::unique_ptr<ImageCopy> Image::load(std::string& error) const {
  std::string why;
  auto object = ImageMemory::load(file_, path_, why);
  if (!object) {
    error = path_ + ": firmware image: got '" + why +
            "', expected a .so made by `twinpuck build`; build it again with this version";
    return nullptr;
  }
  const auto* image = static_cast<const tp_image*>(object->symbol("tp_image"));
  if (!image || image->magic != TP_IMAGE_MAGIC || image->abi != TP_IMAGE_ABI) {
    error = path_ + ": firmware image: got " +
            (image && image->magic == TP_IMAGE_MAGIC
                 ? "an image of interface version " + std::to_string(image->abi)
                 : std::string("a shared object without a firmware inside")) +
            ", expected interface version " + std::to_string(TP_IMAGE_ABI) +
            "; make it with `twinpuck build DIR -o FILE.so`";
    return nullptr;
  }
  return std::make_unique<ImageCopy>(path_, std::move(object), image);
}

bool Image::read(const std::string& path, std::string& file, std::string& error) {
  const std::string wrong = sim::read_input_file(path, kLongest, file);
  if (wrong.empty()) return true;
  error = path + ": firmware image: " + wrong + "; build it, or name the program's folder";
  return false;
}

std::shared_ptr<Image> Image::open(const std::string& path, std::string& error) {
  std::string file;
  return read(path, file, error) ? open(path, std::move(file), error) : nullptr;
}

std::shared_ptr<Image> Image::open(const std::string& path, std::string file, std::string& error) {
  const std::string kind = what_is(file);
  if (kind != "a shared object of this PC") {
    error = path + ": firmware image: got " + kind +
            ", expected a .so made by `twinpuck build`, or the .hex or .elf of a dsPIC30F" +
            (kind == kCoff ? "; take the .hex that was made beside it" : "");
    return nullptr;
  }
  std::shared_ptr<Image> image(new Image(path, std::move(file)));
  const Stamp stamp = check_stamp(image->file_);
  if (stamp != Stamp::Right) {
    error = path + ": firmware image: got " +
            (stamp == Stamp::Wrong ? "a damaged file (its checksum is another one)"
                                   : "a shared object without a firmware inside, or of an older version") +
            ", expected a .so made by `twinpuck build`; make it with `twinpuck build DIR -o FILE.so`";
    return nullptr;
  }
  auto first = image->load(error);
  if (!first) return nullptr;
  image->copies_.push_back(std::move(first));
  return image;
}

ImageCopy& Image::copy(std::size_t n) {
  while (copies_.size() <= n) {
    std::string error;
    auto next = load(error);
    CHECK(next, error.c_str());
    copies_.push_back(std::move(next));
  }
  return *copies_[n];
}

}  // namespace host
