// SPDX-License-Identifier: MIT
#include "import/surface.h"

#include <fmt/format.h>

#include <cctype>
#include <filesystem>

#include "import/picture.h"

namespace wbt {
namespace {

namespace fs = std::filesystem;

double part(double x) { return std::clamp(x, 0.0, 1.0); }

sim::Colour times(sim::Colour a, sim::Colour b) { return {a.r * b.r, a.g * b.g, a.b * b.b}; }

// what names of pictures and appearances say
std::optional<sim::Colour> named(std::string name) {
  for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  const struct {
    const char* word;
    sim::Colour colour;
  } kKnown[] = {{"parquet", kParquet},     {"wood", kWood},       {"pine", kWood},
                {"cardboard", kCardboard}, {"grass", kGreen},     {"brick", kRed},
                {"stone", kStone},         {"concrete", kStone},  {"asphalt", kStone},
                {"pavement", kStone},      {"roughcast", kStone}, {"metal", kMetal},
                {"steel", kMetal},         {"aluminium", kMetal}, {"tile", kMetal}};
  for (const auto& k : kKnown) {
    if (name.find(k.word) != std::string::npos) return k.colour;
  }
  return std::nullopt;
}

std::string url_of(const Node& texture) { return texture.text("url"); }

}  // namespace

sim::Colour colour_of(const Node& n, const char* field, double otherwise) {
  return {part(n.number(field, otherwise, 0)), part(n.number(field, otherwise, 1)),
          part(n.number(field, otherwise, 2))};
}

std::string Surfaces::find(const std::string& url) const {
  if (folder_.empty() || url.empty() || url.size() > 1000) return {};
  const std::string base = fs::path(url).filename().string();
  std::error_code error;
  for (const fs::path& p : {fs::path(folder_) / url, fs::path(folder_) / "textures" / base,
                            fs::path(folder_) / ".." / "protos" / "textures" / base,
                            fs::path(folder_) / ".." / "textures" / base}) {
    if (fs::is_regular_file(p, error)) return p.lexically_normal().string();
  }
  return {};
}

std::string Surfaces::picture_of(const Node* a) const {
  if (!a) return {};
  const Node* texture = a->node("baseColorMap");
  if (!texture) texture = a->node("texture");
  return texture ? find(url_of(*texture)) : std::string();
}

std::optional<sim::Colour> Surfaces::average(const std::string& file) { return average_colour(file); }

sim::Colour Surfaces::textured(sim::Colour base, const Node& texture) {
  const std::string url = url_of(texture);
  if (url.empty()) return base;
  const auto known = averages_.find(url);
  if (known != averages_.end()) return known->second ? times(base, *known->second) : base;
  const std::string file = find(url);
  std::optional<sim::Colour> colour = file.empty() ? std::nullopt : average(file);
  if (!colour) {
    colour = named(fs::path(url).filename().string());
    report_.add(texture,
                fmt::format("the picture \"{}\" {}", printable(url, 100),
                            file.empty() ? "is not beside the world" : "cannot be read"),
                colour ? "a colour after its name" : "the colour without it");
  }
  averages_[url] = colour;
  return colour ? times(base, *colour) : base;
}

Surface Surfaces::of(const Node* a) {
  Surface out;
  if (!a) return out;
  if (a->type == "Appearance") {
    const Node* material = a->node("material");
    if (material) out.colour = colour_of(*material, "diffuseColor", kMaterialDiffuse);
    if (const Node* texture = a->node("texture")) out.colour = textured(out.colour, *texture);
  } else if (a->type == "PBRAppearance") {
    out.colour = colour_of(*a, "baseColor", 1);
    out.roughness = part(a->number("roughness", 0));
    if (const Node* texture = a->node("baseColorMap")) out.colour = textured(out.colour, *texture);
  } else {
    const auto colour = named(a->type);
    if (colour) out.colour = *colour;
    for (const char* field : {"colorOverride", "baseColor"}) {
      if (a->field(field)) out.colour = times(out.colour, colour_of(*a, field, 1));
    }
    if (!colour && !a->field("baseColor"))
      report_.add(*a, "an appearance with a picture of its own", "white");
  }
  return out;
}

}  // namespace wbt
