// SPDX-License-Identifier: Apache-2.0
// OpenEXR files. As in pbrt-v3 the image read is the data window, whatever the display window is.
// All calls name 0 worker threads: the library then has no global state to set.
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <set>
#include <stdexcept>

#include "core/atomic_file.h"
#include "core/exr_header.h"
#include "core/image_formats.h"
#include "core/image_layers.h"
#include "core/source.h"

namespace lampyris {

namespace {

class ByteStream final : public Imf::IStream {
 public:
  ByteStream(const char* name, std::string_view bytes) : IStream(name), bytes_(bytes) {}

  bool read(char c[], int n) override {
    const auto count = static_cast<size_t>(std::max(n, 0));
    if (at_ > bytes_.size() || count > bytes_.size() - at_)
      throw std::runtime_error("the file is truncated");
    std::memcpy(c, bytes_.data() + at_, count);
    at_ += count;
    return at_ < bytes_.size();
  }
  uint64_t tellg() override { return at_; }
  void seekg(uint64_t to) override { at_ = to; }

 private:
  std::string_view bytes_;
  size_t at_ = 0;
};

class AtomicStream final : public Imf::OStream {
 public:
  AtomicStream(const char* name, AtomicFile& file) : OStream(name), file_(file) {}
  void write(const char c[], int n) override { file_.write(c, static_cast<size_t>(n)); }
  uint64_t tellp() override { return file_.tell(); }
  void seekp(uint64_t to) override { file_.seek(to); }

 private:
  AtomicFile& file_;
};

/// The channels that make up the image, in its order.
std::vector<std::string> colourChannels(const std::string& path, const Imf::ChannelList& channels) {
  const bool alpha = channels.findChannel("A");
  std::vector<std::string> names;
  if (channels.findChannel("R") || channels.findChannel("G") || channels.findChannel("B")) {
    names = {"R", "G", "B"};
  } else if (channels.findChannel("Y")) {
    if (channels.findChannel("RY") || channels.findChannel("BY"))
      failImageRead(path, "luminance/chroma images are not supported; save it as RGB");
    names = {"Y"};
  } else {
    std::vector<std::string> all;
    for (auto c = channels.begin(); c != channels.end(); ++c) all.emplace_back(c.name());
    if (all.size() == 1) return all;
    failImageRead(path,
                  fmt::format("expected channels R, G, B or Y, found {}",
                              all.empty() ? "none" : fmt::format("{}", fmt::join(all, ", "))));
  }
  if (alpha) names.emplace_back("A");
  return names;
}

Image readPixels(const std::string& path, Imf::InputFile& file,
                 const std::vector<std::string>& names) {
  const Imath::Box2i window = file.header().dataWindow();
  const int64_t width = int64_t{window.max.x} - window.min.x + 1;
  const int64_t height = int64_t{window.max.y} - window.min.y + 1;
  checkImageSize(path, width, height);
  const Imf::ChannelList& channels = file.header().channels();
  for (const std::string& name : names) {
    const Imf::Channel* const c = channels.findChannel(name);
    if (c && (c->xSampling != 1 || c->ySampling != 1))
      failImageRead(path, fmt::format("channel {} is subsampled, which is not supported", name));
  }
  // Before the pixels' memory is taken: a few bytes can claim to be a huge image.
  if (!file.isComplete()) failImageRead(path, "the file is truncated or was not finished");

  Image image(static_cast<int>(width), static_cast<int>(height), static_cast<int>(names.size()));
  const size_t pixelBytes = names.size() * sizeof(float);
  Imf::FrameBuffer buffer;
  for (size_t c = 0; c < names.size(); ++c)
    buffer.insert(names[c], Imf::Slice::Make(Imf::FLOAT, image.data().data() + c, window,
                                             pixelBytes, pixelBytes * static_cast<size_t>(width)));
  file.setFrameBuffer(buffer);
  file.readPixels(window.min.y, window.max.y);
  return image;
}

std::vector<std::string> layerChannels(const std::string& path, const Imf::ChannelList& channels,
                                       const std::string& layer) {
  for (const auto& letters : {std::array{"R", "G", "B"}, std::array{"X", "Y", "Z"}}) {
    std::vector<std::string> names;
    names.reserve(letters.size());
    for (const char* letter : letters) names.push_back(layer + "." + letter);
    if (std::all_of(names.begin(), names.end(),
                    [&](const std::string& n) { return channels.findChannel(n); }))
      return names;
  }
  for (const char* letter : {"Y", "Z"})
    if (channels.findChannel(layer + "." + letter)) return {layer + "." + letter};
  std::set<std::string> names;
  channels.layers(names);
  failImageRead(path,
                fmt::format("no layer \"{}\"; its layers are: {}", layer,
                            names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "))));
}

/// f(file) of the EXR file with these bytes; all that the library throws becomes an IoError.
template <class F>
auto withExrFile(const std::string& path, std::string_view bytes, F&& f) {
  try {
    checkExrHeaders(path, bytes);
    ByteStream stream(path.c_str(), bytes);
    Imf::InputFile file(stream, 0);
    return f(file);
  } catch (const IoError&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& e) {
    failImageRead(path, e.what());
  }
}

Imf::Header makeHeader(const std::string& path, const Image& image, const WriteOptions& options) {
  const ImagePlacement& place = options.placement;
  const bool placed = place.fullSize.x > 0 && place.fullSize.y > 0;
  const Imath::V2i size(image.width(), image.height());
  const Imath::V2i first = placed ? Imath::V2i(place.offset.x, place.offset.y) : Imath::V2i(0, 0);
  const Imath::V2i full = placed ? Imath::V2i(place.fullSize.x, place.fullSize.y) : size;
  const Imath::V2i one(1, 1);
  Imf::Header header(Imath::Box2i(Imath::V2i(0, 0), full - one),
                     Imath::Box2i(first, first + size - one));
  for (const auto& [name, value] : options.metadata) {
    if (name.empty() || header.find(name) != header.end())
      failImageWrite(path, fmt::format("\"{}\" cannot be the name of an attribute", name));
    header.insert(name, Imf::StringAttribute(value));
  }
  return header;
}

/// Values beyond ±65504 would be infinite as half floats.
Image clampedToHalf(const Image& image) {
  constexpr float kLargestHalf = 65504;
  Image clamped = image;
  for (float& v : clamped.data()) v = std::clamp(v, -kLargestHalf, kLargestHalf);
  return clamped;
}

void writePixels(const std::string& path, AtomicFile& target, const Image& image,
                 const WriteOptions& options) {
  static constexpr std::array<std::array<const char*, 4>, 4> kNames = {
      {{"Y"}, {"Y", "A"}, {"R", "G", "B"}, {"R", "G", "B", "A"}}};
  Imf::Header header = makeHeader(path, image, options);
  const Imath::Box2i window = header.dataWindow();
  const auto width = static_cast<size_t>(image.width());
  const size_t pixelBytes = static_cast<size_t>(image.channels()) * sizeof(float);
  const auto& names = kNames[static_cast<size_t>(image.channels()) - 1];
  Imf::FrameBuffer buffer;
  std::vector<Imath::half> halves;
  if (!options.fullFloat) halves.assign(image.data().begin(), image.data().end());
  for (size_t c = 0; c < static_cast<size_t>(image.channels()); ++c) {
    const Imf::PixelType type = options.fullFloat ? Imf::FLOAT : Imf::HALF;
    const size_t stride = options.fullFloat ? pixelBytes : pixelBytes / 2;
    const void* const first = options.fullFloat ? static_cast<const void*>(image.data().data() + c)
                                                : static_cast<const void*>(halves.data() + c);
    header.channels().insert(names[c], Imf::Channel(type));
    buffer.insert(names[c], Imf::Slice::Make(type, first, window, stride, stride * width));
  }
  for (const ImageLayer& layer : options.layers) {
    if (layer.values.size() != width * static_cast<size_t>(image.height()))
      failImageWrite(path, fmt::format("layer \"{}\" has {} values, expected one a pixel",
                                       layer.name, layer.values.size()));
    if (layer.name.empty() || header.channels().findChannel(layer.name))
      failImageWrite(path, fmt::format("layer name \"{}\" is empty or stands twice", layer.name));
    header.channels().insert(layer.name, Imf::Channel(Imf::FLOAT));
    buffer.insert(layer.name, Imf::Slice::Make(Imf::FLOAT, layer.values.data(), window,
                                               sizeof(float), sizeof(float) * width));
  }
  AtomicStream stream(path.c_str(), target);
  Imf::OutputFile file(stream, header, 0);
  file.setFrameBuffer(buffer);
  file.writePixels(image.height());
}

}  // namespace

LoadedImage readExrImage(const std::string& path, std::string_view bytes) {
  return withExrFile(path, bytes, [&path](Imf::InputFile& file) {
    return LoadedImage{readPixels(path, file, colourChannels(path, file.header().channels())),
                       false};
  });
}

std::vector<std::string> exrLayerNames(const std::string& path) {
  const MappedFile bytes(path);
  return withExrFile(path, bytes.text(), [](Imf::InputFile& file) {
    std::set<std::string> names;
    file.header().channels().layers(names);
    return std::vector<std::string>(names.begin(), names.end());
  });
}

Image readExrLayer(const std::string& path, const std::string& layer) {
  const MappedFile bytes(path);
  return withExrFile(path, bytes.text(), [&](Imf::InputFile& file) {
    return readPixels(path, file, layerChannels(path, file.header().channels(), layer));
  });
}

ImagePlacement readExrPlacement(const std::string& path) {
  const MappedFile bytes(path);
  return withExrFile(path, bytes.text(), [](Imf::InputFile& file) {
    const Imath::Box2i data = file.header().dataWindow(), whole = file.header().displayWindow();
    const Imath::V2i offset = data.min - whole.min, size = whole.max - whole.min;
    return ImagePlacement{{offset.x, offset.y}, {size.x + 1, size.y + 1}};
  });
}

void writeExrImage(const std::string& path, const Image& image, const WriteOptions& options) {
  AtomicFile file(path);
  try {
    writePixels(path, file, options.fullFloat ? image : clampedToHalf(image), options);
  } catch (const IoError&) {
    throw;
  } catch (const std::exception& e) {
    failImageWrite(path, e.what());
  }
  // Also throws what the library swallowed when it finished the file in a destructor.
  file.commit();
}

}  // namespace lampyris
