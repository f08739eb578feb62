// SPDX-License-Identifier: Apache-2.0
/// The readers and writers behind core/image.h, one pair a library. All throw IoError.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/error.h"
#include "core/image.h"

namespace lampyris {

/// Readers refuse images of more pixels: a damaged header must not claim all memory.
inline constexpr int64_t kMaxImagePixels = int64_t{1} << 28;
/// And of more than a byte of the file can stand for: in a PNG, whose pixels have a bit at least,
/// deflate shrinks to 1/1032 at most; in a JPG nine blocks of a bit each make 32 x 32 pixels at
/// most; TGA packs 64 pixels into a byte, HDR and BMP fewer.
inline constexpr int64_t kMaxPixelsPerByte = 1032 * 8, kMaxJpgPixelsPerByte = 1024,
                         kMaxOtherPixelsPerByte = 64;
/// The same for EXR, in bytes of unpacked pixels: its DWAB deflates one byte or two for each 64
/// values.
inline constexpr int64_t kMaxExrRatio = 1 << 17;

/// Throws IoError: `cannot read image "path": why`.
[[noreturn]] void failImageRead(const std::string& path, const std::string& why);
[[noreturn]] void failImageWrite(const std::string& path, const std::string& why);
/// Throws IoError unless the size is one that an image can have.
void checkImageSize(const std::string& path, int64_t width, int64_t height);

/// `bytes` are the file's contents, `path` its name for messages.
LoadedImage readStbImage(const std::string& path, std::string_view bytes);
/// Grey, RGB or CMYK (which becomes RGB).
LoadedImage readJpegImage(const std::string& path, std::string_view bytes);
/// By its first bytes, whatever the file's name.
bool isJpeg(std::string_view bytes);
LoadedImage readExrImage(const std::string& path, std::string_view bytes);
LoadedImage readPfmImage(const std::string& path, std::string_view bytes);

/// PNG, TGA, BMP, HDR and JPG; `ending` is in lower case, with its dot.
void writeStbImage(const std::string& path, const std::string& ending, const Image& image);
void writeExrImage(const std::string& path, const Image& image, const WriteOptions& options);
void writePfmImage(const std::string& path, const Image& image);

}  // namespace lampyris
