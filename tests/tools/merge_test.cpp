// SPDX-License-Identifier: Apache-2.0
// Images of which ranges of samples are rendered apart.
#include <fmt/format.h>

#include "core/image.h"
#include "integrators/registry.h"
#include "tools/command_test_support.h"

namespace lampyris::test {

namespace {

constexpr const char* kAovs =
    "albedo,normal,depth,samplecount,variance,lightcut,bsdfshare,lightentropy,pathlength";

class Merge : public CommandTest {
 protected:
  void render(const std::string& options) const {
    const CommandResult r = run("-q --spp 13 -D filter=mitchell " + options + " tiny.pbrt");
    EXPECT_EQ(r.code, 0) << options << r.err;
    EXPECT_EQ(r.err, "") << options;
  }
  void renderParts(const std::string& options) const {
    for (const char* range : {"0:1", "1:6", "6:13"})
      render(fmt::format("{} --samples {} -o {}.part", options, range, *range));
  }
  std::string merge(const std::string& parts) const {
    const CommandResult r = run("merge -o merged.exr " + parts);
    EXPECT_EQ(r.code, 0) << r.err;
    EXPECT_EQ(r.err, "");
    return read("merged.exr");
  }
  /// The message of a merge that must fail, without the program's name.
  std::string refusal(const std::string& parts) const {
    const CommandResult r = run("merge -o refused.exr " + parts);
    EXPECT_EQ(r.code, 3) << r.err;
    EXPECT_FALSE(exists("refused.exr"));
    constexpr std::string_view kStart = "lampyris: error: ";
    return r.err.starts_with(kStart) ? r.err.substr(kStart.size()) : r.err;
  }
  double mean(const std::string& name) const {
    const Image image = readImageFile(path(name).string()).image;
    double sum = 0;
    for (const float v : image.data()) sum += static_cast<double>(v);
    return sum / static_cast<double>(image.data().size());
  }
};

TEST_F(Merge, EveryIntegratorGivesTheBitsOfOneRender) {
  for (const auto& plugin : integratorRegistry().entries()) {
    // What these two's parts are is said, and tested, elsewhere.
    if (plugin.name == "guidedpath" || plugin.name == "mlt") continue;
    const std::string options = "-D integrator=" + plugin.name + " --aov " + kAovs;
    render(options + " -o whole.exr");
    renderParts(options);
    for (const char* order :
         {"0.part 1.part 6.part", "6.part 0.part 1.part", "1.part 6.part 0.part"})
      EXPECT_TRUE(merge(order) == read("whole.exr")) << plugin.name;
  }
}

TEST_F(Merge, IntegratorsThatLearnSayWhatAPartIs) {
  for (const auto& [name, why] :
       {std::pair{"guidedpath", "each part learns from its own samples alone"},
        std::pair{"mlt", "each part has chains of its own, from the same bootstrap paths"}}) {
    const CommandResult r =
        run(fmt::format("--spp 4 --samples 1:3 -D integrator={} -o a.part tiny.pbrt", name));
    EXPECT_EQ(r.code, 0);
    EXPECT_NE(r.err.find(fmt::format("tiny.pbrt: note: {}: the merged image is unbiased, but not "
                                     "bit for bit that of one render\n",
                                     why)),
              std::string::npos)
        << r.err;
  }
}

TEST_F(Merge, ChainsOfPartsHaveTheMean) {
  std::string parts;
  for (int i = 0; i < 4; ++i) {
    const std::string range = fmt::format("{}:{}", 40 * i, 40 * i + 40);
    const CommandResult r = run(
        fmt::format("-q --spp 160 -D integrator=mlt --samples {} -o {}.part tiny.pbrt", range, i));
    EXPECT_EQ(r.code, 0) << r.err;
    parts += fmt::format(" {}.part", i);
  }
  merge(parts);
  EXPECT_EQ(run("-q --spp 400 -o whole.pfm tiny.pbrt").code, 0);
  // By hand: 61 440 mutations leave noise of less than 1 %.
  EXPECT_NEAR(mean("merged.exr") / mean("whole.pfm"), 1, 0.04);
}

TEST_F(Merge, RefusesWhatIsNoPartOfTheSameImage) {
  renderParts("");
  const auto other = [&](const std::string& options) {
    EXPECT_EQ(run("-q --samples 6:13 -o other.part " + options).code, 0);
    EXPECT_EQ(refusal("0.part other.part"),
              "\"other.part\" is of another scene or of other settings (--spp, --seed, -D, --crop, "
              "--quick) than \"0.part\"\n")
        << options;
  };
  const std::string same = "-D filter=mitchell tiny.pbrt";
  other("--spp 14 " + same);
  other("--spp 13 --seed 1 " + same);
  other("--spp 13 --crop 0 1 0 0.5 " + same);
  other("--spp 13 --aov depth " + same);
  other("--spp 13 -D integrator.maxdepth=2 " + same);
  write("other.pbrt", scene() + "# another file\n");
  other("--spp 13 -D filter=mitchell other.pbrt");
  EXPECT_EQ(refusal("1.part 6.part 1.part"),
            "\"1.part\" and \"1.part\" both have samples 1 to 5\n");
  render("--samples 5:7 -o 5.part");
  EXPECT_EQ(refusal("1.part 5.part"), "\"1.part\" and \"5.part\" both have sample 5\n");
  EXPECT_EQ(refusal("tiny.pbrt"),
            "\"tiny.pbrt\" is no checkpoint or partial file of this version\n");
  EXPECT_EQ(refusal("none.part"), "cannot open \"none.part\": No such file or directory\n");
  render("--checkpoint c -o whole.pfm");
  EXPECT_EQ(refusal("c"), "\"c\" is a checkpoint of a whole image, no partial file\n");
}

/// A mesh that has changed makes another scene, though the scene's text is the same.
TEST_F(Merge, RefusesPartsWithOtherMeshes) {
  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
  std::string text = scene();
  text.insert(text.find("Shape"), "Shape \"plymesh\" \"string filename\" \"a.ply\"\n");
  write("tiny.pbrt", text);
  write("a.ply", header + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  render("--samples 0:1 -o a.part");
  write("a.ply", header + "0 0 0\n1 0 0\n0 1 1\n3 0 1 2\n");
  render("--samples 1:13 -o b.part");
  EXPECT_NE(refusal("a.part b.part").find("is of another scene"), std::string::npos);
}

TEST_F(Merge, RefusesDamagedParts) {
  renderParts("");
  const std::string part = read("1.part");
  for (size_t at = 30; at < part.size(); at += part.size() / 20) {
    std::string damaged = part;
    damaged[at] = static_cast<char>(damaged[at] ^ 1);
    write("bad.part", damaged);
    EXPECT_EQ(refusal("0.part bad.part"), "\"bad.part\" is damaged\n") << at;
    write("bad.part", part.substr(0, at));
    EXPECT_EQ(refusal("0.part bad.part"), "\"bad.part\" is damaged\n") << at;
  }
}

TEST_F(Merge, WarnsOfSamplesThatAreMissing) {
  renderParts("");
  const CommandResult r = run("merge -o a.pfm -o a.exr 1.part");
  EXPECT_EQ(r.code, 0);
  EXPECT_EQ(r.err,
            "a.pfm: warning: sample 0 of 13 a pixel are in no file; the image goes without them\n"
            "a.pfm: warning: samples 6 to 12 of 13 a pixel are in no file; the image goes without "
            "them\n");
  EXPECT_GT(mean("a.exr"), 0.1);
}

TEST_F(Merge, PartsAreResumed) {
  renderParts("");
  const std::string whole = merge("0.part 1.part 6.part");
  render("--samples 6:13 --checkpoint c --checkpoint-interval 0 -o 6.part");
  // A checkpoint on the way is a part that has not come to its end; the last one is the part.
  EXPECT_EQ(read("c"), read("6.part"));
  const CommandResult other =
      run("-q --spp 13 -D filter=mitchell --samples 6:12 --resume c "
          "-o 7.part tiny.pbrt");
  EXPECT_EQ(other.code, 3);
  EXPECT_EQ(other.err, "lampyris: error: checkpoint \"c\" is of --samples 6:13\n");
  render("--samples 6:13 --resume c -o 6.part");
  EXPECT_EQ(merge("1.part 6.part 0.part"), whole);
}

TEST_F(Merge, UsageErrors) {
  const auto error = [&](const std::string& arguments) {
    const CommandResult r = run(arguments);
    EXPECT_EQ(r.code, 2) << arguments << r.err;
    return r.err.substr(0, r.err.find('\n'));
  };
  for (const char* range : {"3", "3:3", "4:3", "a:b", "-1:2", "1:2x", ":"})
    EXPECT_EQ(error(fmt::format("--samples {} tiny.pbrt", range)),
              fmt::format("lampyris: error: --samples: expected a range like 0:16 (first, one "
                          "behind the last), got \"{}\"",
                          range));
  EXPECT_EQ(error("--samples 2:5 tiny.pbrt"),
            "lampyris: error: --samples 2:5: the image has 4 samples a pixel; --spp tells the "
            "number of all parts together");
  EXPECT_EQ(error("--samples 0:2 -o a.exr tiny.pbrt"),
            "lampyris: error: --samples writes one partial file: expected --out NAME.part, got "
            "\"a.exr\"");
  EXPECT_EQ(error("--samples 0:2 --seconds 1 tiny.pbrt"),
            "lampyris: error: --samples renders a part of an image: no --seconds, --noise, "
            "--snapshots, --pixel, --cat or --toply goes with it");
  EXPECT_EQ(error("merge -o a.gif x.part"),
            "lampyris: error: cannot tell the format of the image \"a.gif\": expected an ending "
            "like .exr, .png or .pfm");
}

TEST_F(Merge, PartsAreNamedAfterTheImage) {
  EXPECT_EQ(run("-q --samples 1:3 tiny.pbrt").code, 0);
  EXPECT_TRUE(exists("tiny.1-3.part"));
  EXPECT_FALSE(exists("tiny.exr"));
}

}  // namespace
}  // namespace lampyris::test
