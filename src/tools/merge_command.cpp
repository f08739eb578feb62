// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

#include "core/error.h"
#include "core/image.h"
#include "film/film_sums.h"
#include "tools/checkpoint.h"
#include "tools/commands.h"
#include "tools/messages.h"
#include "tools/outputs.h"

namespace lampyris {

namespace {

/// "sample 4" or "samples 4 to 7".
std::string nameOf(const SampleRange& r) {
  return r.size() == 1 ? fmt::format("sample {}", r.begin)
                       : fmt::format("samples {} to {}", r.begin, r.end - 1);
}

/// The parts of an image, summed up.
class Merger {
 public:
  /// Throws IoError if the file is no finished part of the same image as those before it.
  void add(const std::string& path);
  /// Those of the whole image that no part has, in ascending order.
  std::vector<SampleRange> missing() const;
  const FilmSums& film() const { return *film_; }
  ImageMetadata metadata() const;
  uint64_t whole() const { return first_.whole; }

 private:
  struct Part {
    std::string path;
    SampleRange range;
  };
  void check(const std::string& path, const Checkpoint& part) const;

  Checkpoint first_;  ///< that the others are held against
  std::vector<Part> parts_;
  std::unique_ptr<FilmSums> film_;
};

void Merger::check(const std::string& path, const Checkpoint& part) const {
  if (!part.isPart())
    throw IoError(fmt::format("\"{}\" is a checkpoint of a whole image, no partial file", path));
  if (!parts_.empty() && part.fingerprint != first_.fingerprint)
    throw IoError(
        fmt::format("\"{}\" is of another scene or of other settings (--spp, --seed, -D, --crop, "
                    "--quick) than \"{}\"",
                    path, parts_.front().path));
  if (part.samples != part.range.size())
    throw IoError(fmt::format("\"{}\" is unfinished: it has {} of the {}; go on with --resume",
                              path, part.samples, nameOf(part.range)));
  for (const Part& other : parts_) {
    const SampleRange both{std::max(part.range.begin, other.range.begin),
                           std::min(part.range.end, other.range.end)};
    if (both.begin < both.end)
      throw IoError(fmt::format("\"{}\" and \"{}\" both have {}", other.path, path, nameOf(both)));
  }
}

void Merger::add(const std::string& path) {
  Checkpoint part = readCheckpoint(path);
  check(path, part);
  std::unique_ptr<FilmSums> film = FilmSums::decode(part.film);
  if (!film || (film_ && !film_->merge(*film)))
    throw IoError(fmt::format("\"{}\" is of another film", path));
  if (!film_) {
    film_ = std::move(film);
    part.film.clear();
    first_ = part;
  }
  parts_.push_back({path, part.range});
}

std::vector<SampleRange> Merger::missing() const {
  std::vector<SampleRange> ranges;
  for (const Part& p : parts_) ranges.push_back(p.range);
  std::ranges::sort(ranges, {}, &SampleRange::begin);
  ranges.push_back({first_.whole, first_.whole});
  std::vector<SampleRange> gaps;
  uint64_t next = 0;
  for (const SampleRange& r : ranges) {
    if (r.begin > next) gaps.push_back({next, r.begin});
    next = r.end;
  }
  return gaps;
}

ImageMetadata Merger::metadata() const {
  uint64_t samples = 0;
  for (const Part& p : parts_) samples += p.range.size();
  return imageMetadata(static_cast<double>(samples), first_.seed);
}

}  // namespace

int runMerge(const Arguments& arguments) {
  std::vector<std::string> parts, outputs;
  CLI::App app("Makes the image of partial files, which --samples has made.", "lampyris merge");
  app.add_option("FILES", parts, "Partial files of one image, in any order")->required();
  app.add_option("-o,--out,--outfile", outputs, "Image to write; may be given several times")
      ->required()
      ->expected(1)
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  if (const auto code = parseArguments(app, arguments)) return *code;
  for (const std::string& out : outputs) checkWritableImage(out);
  Merger merger;
  for (const std::string& part : parts) merger.add(part);
  for (const std::string& out : outputs) merger.film().write(out, merger.metadata());
  for (const SampleRange& gap : merger.missing())
    say("{}: warning: {} of {} a pixel are in no file; the image goes without them\n",
        outputs.front(), nameOf(gap), merger.whole());
  return kDone;
}

}  // namespace lampyris
