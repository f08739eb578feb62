// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <atomic>
#include <filesystem>

#include "core/image.h"
#include "core/parallel.h"
#include "textures/image_pyramid.h"
#include "textures/texture_input.h"
#include "textures/texture_mapping.h"

namespace lampyris {

namespace {

struct ImagemapParameters {
  std::string filename;
  std::string wrap = "repeat";
  float scale = 1;
  std::optional<bool> gamma;
  bool trilinear = false;
  float maxanisotropy = 8;
  MappingParameters mapping;

  void declare(Declaration& d) {
    d.add("filename", filename, "The image: PNG, JPG, TGA, BMP, HDR, EXR or PFM.")
        .rangeIs("any file name");
    d.add("wrap", wrap, "What lies beyond the image.").oneOf({"repeat", "black", "clamp"});
    d.add("scale", scale, "Factor on the image's values.").any();
    d.add("gamma", gamma, "Whether the image's values are sRGB-encoded.")
        .defaultIs("true for .png, .tga, .jpg and .bmp files");
    d.add("trilinear", trilinear, "Trilinear instead of elliptical filtering.");
    d.add("maxanisotropy", maxanisotropy, "Largest ratio of the axes of an elliptical filter.")
        .range(1, 1000);
    mapping.declare(d);
  }
};

template <class T>
class ImagemapTexture final : public Texture<T> {
 public:
  ImagemapTexture(const ImagemapParameters& p, const TextureMapping2D& mapping,
                  std::shared_ptr<const ImagePyramid<T>> pyramid)
      : mapping_(mapping),
        pyramid_(std::move(pyramid)),
        scale_(p.scale),
        maxAnisotropy_(p.maxanisotropy),
        trilinear_(p.trilinear) {}

  T evaluate(const SurfaceInteraction& at) const override {
    const TextureCoordinates c = mapping_.map(at);
    // Most vertices of a path carry no differentials.
    if (!c.hasFootprint()) return scale_ * pyramid_->bilinear(0, c.st);
    if (!trilinear_) return scale_ * pyramid_->elliptical(c.st, c.dstdx, c.dstdy, maxAnisotropy_);
    const Vec2 largest = glm::max(absComponents(c.dstdx), absComponents(c.dstdy));
    return scale_ * pyramid_->trilinear(c.st, std::max(largest.x, largest.y));
  }

 private:
  TextureMapping2D mapping_;
  std::shared_ptr<const ImagePyramid<T>> pyramid_;
  float scale_, maxAnisotropy_;
  bool trilinear_;
};

/// As in pbrt-v3 a float texture decodes the luminance of the encoded values.
float convert(const Image& image, int x, int y, bool gamma, float) {
  const float v = image.rgb(x, y).luminance();
  return gamma && image.channels() >= 3 ? srgbToLinear(v) : v;
}
Rgb convert(const Image& image, int x, int y, bool, const Rgb&) { return image.rgb(x, y); }

/// Texels from the bottom row up; values that are not finite become 0 and are counted.
template <class T>
std::vector<T> texels(LoadedImage loaded, bool gamma, size_t& faults) {
  Image& image = loaded.image;
  const bool colour = image.channels() >= 3;
  if (gamma && (!colour || std::is_same_v<T, Rgb>)) decodeSrgb(image);
  std::vector<T> result(static_cast<size_t>(image.width()) * static_cast<size_t>(image.height()));
  std::atomic<size_t> notFinite{0};
  parallelFor(static_cast<size_t>(image.height()), 16, [&](size_t begin, size_t end) {
    size_t found = 0;
    for (size_t row = begin; row < end; ++row) {
      const int y = image.height() - 1 - static_cast<int>(row);
      T* out = &result[row * static_cast<size_t>(image.width())];
      for (int x = 0; x < image.width(); ++x) {
        const T v = convert(image, x, y, gamma, T{});
        const bool finite = Rgb(v).isFinite();
        found += finite ? 0 : 1;
        out[x] = finite ? v : T{};
      }
    }
    notFinite += found;
  });
  faults = notFinite;
  return result;
}

bool isUsuallyEncoded(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  for (char& c : ending)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return ending == ".png" || ending == ".tga" || ending == ".jpg" || ending == ".jpeg" ||
         ending == ".bmp";
}

/// One pyramid for all textures that differ in how it is looked up only.
template <class T>
std::shared_ptr<const ImagePyramid<T>> loadPyramid(const ImagemapParameters& p,
                                                   const TextureContext& context) {
  if (p.filename.empty())
    throw SceneError(context.location, "texture \"imagemap\" needs a \"string filename\"");
  const std::string path = context.resolvePath(p.filename);
  const bool gamma = p.gamma.value_or(isUsuallyEncoded(path));
  const ImageWrap wrap = p.wrap == "clamp"   ? ImageWrap::Clamp
                         : p.wrap == "black" ? ImageWrap::Black
                                             : ImageWrap::Repeat;
  const std::string normal = std::filesystem::path(path).lexically_normal().string();
  const std::string key = fmt::format("{} {} {}", gamma, p.wrap, normal);
  try {
    return context.images.shared<ImagePyramid<T>>(key, [&] {
      // Not through the cache: the pixels are needed just once, and large.
      LoadedImage loaded = readImageFile(path);
      const Int2 size(loaded.image.width(), loaded.image.height());
      size_t faults = 0;
      std::vector<T> values = texels<T>(std::move(loaded), gamma, faults);
      if (faults > 0)
        context.diagnostics.warn(
            context.location, fmt::format("image \"{}\": {} pixels are infinite or not a number; "
                                          "they are taken as black",
                                          path, faults));
      return std::make_shared<const ImagePyramid<T>>(size.x, size.y, std::move(values), wrap);
    });
  } catch (const IoError& e) {
    throw SceneError(context.location, e.what());
  }
}

template <class T>
std::unique_ptr<Texture<T>> create(const ImagemapParameters& p, const TextureContext& context) {
  return std::make_unique<ImagemapTexture<T>>(
      p, TextureMapping2D(p.mapping, context.textureToWorld), loadPyramid<T>(p, context));
}

template <class T>
TexturePlugin<T> plugin() {
  return makePlugin("imagemap", "An image file.", create<T>);
}

}  // namespace

TexturePlugin<float> imagemapFloatTexturePlugin() { return plugin<float>(); }
TexturePlugin<Rgb> imagemapSpectrumTexturePlugin() { return plugin<Rgb>(); }

}  // namespace lampyris
