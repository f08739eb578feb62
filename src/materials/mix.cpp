// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "materials/surface_material.h"

namespace lampyris {
namespace {

struct MixParameters {
  std::string first, second;
  RgbInput amount = 0.5f;
  void declare(Declaration& d) {
    d.add("namedmaterial1", first, "Name of a material; its bump map counts for both.")
        .rangeIs("a name given by MakeNamedMaterial");
    d.add("namedmaterial2", second, "Name of another.")
        .rangeIs("a name given by MakeNamedMaterial");
    d.add("amount", amount, "Share of the first; the second has the rest.").clamped(0);
  }
};

const SurfaceMaterial& find(const std::string& parameter, const std::string& name,
                            const MaterialContext& c) {
  if (name.empty())
    throw SceneError(c.location, fmt::format("material \"mix\" needs \"string {}\": the name of a "
                                             "material made with MakeNamedMaterial",
                                             parameter));
  const auto* m = dynamic_cast<const SurfaceMaterial*>(c.materials.resolve(name, c.location));
  if (!m)
    throw SceneError(c.location,
                     fmt::format("material \"{}\" cannot be mixed: it scatters no light", name));
  return *m;
}

/// As in pbrt-v3 the frame is the first material's: the second one's lobes stand in it, and its
/// bump map is not seen.
class MixMaterial final : public SurfaceMaterial {
 public:
  MixMaterial(const MixParameters& p, const MaterialContext& c)
      : first_(find("namedmaterial1", p.first, c)),
        second_(find("namedmaterial2", p.second, c)),
        amount_(input(c, p.amount)) {
    if (second_.scattersBelow())
      c.diagnostics.warn(c.location,
                         "material \"mix\": only the first material scatters below the surface");
    if (maxLobes() > Bsdf::kMaxLobes)
      throw SceneError(c.location,
                       fmt::format("this mixture has up to {} lobes, the limit is {}: mix fewer or "
                                   "simpler materials",
                                   maxLobes(), Bsdf::kMaxLobes));
  }

  void bend(SurfaceInteraction& at) const override { first_.bend(at); }
  SurfaceDetail detail() const override { return first_.detail(); }
  bool wantsDifferentials() const override {
    return SurfaceMaterial::wantsDifferentials() || first_.wantsDifferentials() ||
           second_.wantsDifferentials();
  }
  /// As in pbrt-v3, what scatters below the surface is the first material alone.
  bool scattersBelow() const override { return first_.scattersBelow(); }
  const Bssrdf* bssrdf(const SurfaceInteraction& at, BssrdfStorage& storage) const override {
    return first_.bssrdf(at, storage);
  }
  size_t maxLobes() const override { return first_.maxLobes() + second_.maxLobes(); }

  void addLobes(const SurfaceInteraction& at, Bsdf& bsdf) const override {
    const Rgb share = reflectance(amount_(at));
    const Rgb rest = clampPositive(Rgb(1) - share);
    addScaled(first_, share, at, bsdf);
    addScaled(second_, rest, at, bsdf);
  }

 private:
  static void addScaled(const SurfaceMaterial& m, const Rgb& share, const SurfaceInteraction& at,
                        Bsdf& bsdf) {
    if (share.isBlack()) return;
    const size_t before = bsdf.lobeCount();
    m.addLobes(at, bsdf);
    bsdf.scaleLobes(before, share);
  }
  const SurfaceMaterial& first_;
  const SurfaceMaterial& second_;
  TexturedRgb amount_;
};

}  // namespace

MaterialRegistry::Entry mixMaterialPlugin() {
  return makePlugin("mix", "Two materials, added up in given shares.",
                    createMaterial<MixMaterial, MixParameters>);
}

}  // namespace lampyris
