// SPDX-License-Identifier: Apache-2.0
// JPG files through libjpeg.
#include <csetjmp>
#include <cstdio>
// jpeglib.h needs cstdio before it.
#include <jerror.h>
#include <jpeglib.h>

#include <vector>

#include "core/image_formats.h"

namespace lampyris {

namespace {

/// One file on its way to rows of bytes. libjpeg reports errors by a call that must not return: it
/// jumps back into the member function that called libjpeg, which then returns false.
class JpegReader {
 public:
  explicit JpegReader(std::string_view bytes) : bytes_(bytes) {
    info_.err = jpeg_std_error(&errors_);
    info_.client_data = this;
    errors_.error_exit = fail;
    errors_.emit_message = onMessage;
  }
  ~JpegReader() { jpeg_destroy_decompress(&info_); }
  JpegReader(const JpegReader&) = delete;
  JpegReader& operator=(const JpegReader&) = delete;

  /// Reads up to the first scan. Then width() and height() are known.
  bool readHeader() {
    if (setjmp(caller_)) return false;
    jpeg_create_decompress(&info_);
    jpeg_mem_src(&info_, reinterpret_cast<const unsigned char*>(bytes_.data()), bytes_.size());
    jpeg_read_header(&info_, TRUE);
    return true;
  }
  /// After it components() is known: 1 for grey, 3 for RGB, 4 for CMYK.
  bool start() {
    if (setjmp(caller_)) return false;
    if (info_.num_components == 3) info_.out_color_space = JCS_RGB;
    return jpeg_start_decompress(&info_) != FALSE;
  }
  /// `row` holds width() x components() bytes.
  bool readRow(unsigned char* row) {
    if (setjmp(caller_)) return false;
    return jpeg_read_scanlines(&info_, &row, 1) == 1;
  }

  JDIMENSION width() const { return info_.image_width; }
  JDIMENSION height() const { return info_.image_height; }
  int components() const { return info_.output_components; }
  /// Whether CMYK is stored as what is left of white, as Adobe's programs do.
  bool isInverted() const { return info_.saw_Adobe_marker != FALSE; }
  /// Why a function returned false.
  const char* fault() const { return fault_; }

 private:
  static JpegReader& of(j_common_ptr info) { return *static_cast<JpegReader*>(info->client_data); }

  [[noreturn]] static void fail(j_common_ptr info) {
    JpegReader& reader = of(info);
    const int code = info->err->msg_code;
    if (code == JWRN_JPEG_EOF || code == JWRN_HIT_MARKER || code == JERR_INPUT_EOF)
      std::snprintf(reader.fault_, sizeof reader.fault_, "the file is truncated");
    else
      info->err->format_message(info, reader.fault_);
    std::longjmp(reader.caller_, 1);
  }

  /// libjpeg guesses what damaged files held and warns (level -1) where it does; that is an error
  /// here, unless the warning is of marks and stray bytes beside the image.
  static void onMessage(j_common_ptr info, int level) {
    const int code = info->err->msg_code;
    const bool harmless =
        code == JWRN_EXTRANEOUS_DATA || code == JWRN_ADOBE_XFORM || code == JWRN_JFIF_MAJOR;
    if (level < 0 && !harmless) fail(info);
  }

  std::string_view bytes_;
  jpeg_decompress_struct info_{};
  jpeg_error_mgr errors_{};
  std::jmp_buf caller_{};
  char fault_[JMSG_LENGTH_MAX] = "it is damaged";
};

float unit(int byte) { return static_cast<float>(byte) / 255.f; }

/// A pixel of CMYK, what is left of white, as sRGB bytes.
void setInks(Image& image, int x, int y, const unsigned char* left) {
  const float black = unit(left[3]);
  image.setRgb(x, y, black * Rgb(unit(left[0]), unit(left[1]), unit(left[2])));
}

}  // namespace

bool isJpeg(std::string_view bytes) { return bytes.starts_with("\xff\xd8"); }

LoadedImage readJpegImage(const std::string& path, std::string_view bytes) {
  JpegReader reader(bytes);
  if (!reader.readHeader()) failImageRead(path, reader.fault());
  const int64_t pixels = int64_t{reader.width()} * reader.height();
  checkImageSize(path, reader.width(), reader.height());
  if (pixels / kMaxJpgPixelsPerByte > static_cast<int64_t>(bytes.size()))
    failImageRead(path, "the file is truncated, or its size is wrong");
  if (!reader.start()) failImageRead(path, reader.fault());

  const int width = static_cast<int>(reader.width()), height = static_cast<int>(reader.height());
  const int components = reader.components();
  const bool inks = components == 4;
  Image image(width, height, components == 1 ? 1 : 3);
  std::vector<unsigned char> row(static_cast<size_t>(width) * static_cast<size_t>(components));
  float* to = image.data().data();
  for (int y = 0; y < height; ++y) {
    if (!reader.readRow(row.data())) failImageRead(path, reader.fault());
    if (inks && !reader.isInverted())
      for (unsigned char& byte : row) byte = static_cast<unsigned char>(255 - byte);
    if (inks)
      for (int x = 0; x < width; ++x) setInks(image, x, y, &row[static_cast<size_t>(x) * 4]);
    else
      for (const unsigned char byte : row) *to++ = unit(byte);
  }
  return {std::move(image), true};
}

}  // namespace lampyris
