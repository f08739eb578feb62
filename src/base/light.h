// SPDX-License-Identifier: Apache-2.0
/// Lights.
#pragma once

#include <optional>

#include "base/interaction.h"
#include "base/shape.h"
#include "core/bounds.h"
#include "core/huge_pages.h"
#include "core/prefetch.h"
#include "core/registry.h"
#include "core/rgb.h"

namespace lampyris {

/// Dense number of a light that can be chosen: a light object has one, or a range of them (the
/// triangles of an emitter).
using LightId = uint32_t;
inline constexpr LightId kNoLight = ~LightId{0};

/// Light arriving at a point, drawn from one light.
struct LightSample {
  Rgb radiance;  ///< unoccluded; delta lights: the irradiance on a plane facing it
  Vec3 wi{0};    ///< unit, towards the light
  float distance = kInfinity;
  float pdf = 0;               ///< by solid angle; 1 for delta lights
  Vec3 p{0}, pError{0}, n{0};  ///< where it comes from, if finite; n = 0: no surface there
};

/// A ray of light as it leaves a light: where paths from lights begin.
struct EmissionSample {
  /// Where it starts; `n` = 0: no surface there. Lights at infinity: on a disk across `w` outside
  /// of the scene.
  Vec3 p{0}, pError{0}, n{0};
  Vec3 w{0, 0, 1};  ///< unit, away from the light
  Rgb radiance;     ///< lights at a point: the intensity; of one direction: the irradiance across w
  float pdfPosition = 0;   ///< by area (of the surface, of the disk); 1 for lights at a point
  float pdfDirection = 0;  ///< by solid angle; 1 for lights of one direction
};
/// The densities with which Light::sampleEmission() draws a ray.
struct EmissionPdf {
  float position = 0, direction = 0;
};

/// What a light tree knows of a light with a position. Angles as in Conty and Kulla 2018: normals
/// lie within θo of the axis, emission within θe of a normal.
struct LightBounds {
  Bounds3 box;
  Vec3 axis{0, 0, 1};
  float cosThetaO = -1;
  float cosThetaE = 0;
  bool twoSided = false;
  /// Luminance of the largest radiant intensity in any direction (W/sr): a point light's I, a
  /// spot's I, L × area for a flat emitter, a quarter of that for a sphere. Where emission varies
  /// over directions or places by a map, its mean takes the map's place. Equal for a point light
  /// and a small sphere that looks the same from afar.
  float intensity = 0;
};

class Light {
 public:
  virtual ~Light() = default;

  /// How many LightIds it takes: its elements.
  virtual uint32_t elementCount() const { return 1; }
  /// True if no ray can hit it: point, spot, distant.
  virtual bool isDelta() const = 0;
  /// True if it has no position: distant, infinite.
  virtual bool isInfinite() const { return false; }
  /// Called once with the scene's bounds before anything else (infinite and distant lights).
  virtual void prepare(const Bounds3& scene) { (void)scene; }

  /// What sample() reads first beyond the light itself; null: nothing.
  virtual const void* beyond() const { return nullptr; }
  /// Draws incident light at `from`. None if nothing arrives.
  virtual std::optional<LightSample> sample(uint32_t element, const Vec3& from,
                                            const Vec2& u) const = 0;
  /// Density by solid angle with which sample(element, from, ·) draws the point `hit` of this
  /// emitter. 0 for delta and infinite lights.
  virtual float pdfHit(uint32_t element, const Vec3& from, const SurfaceInteraction& hit) const {
    (void)element, (void)from, (void)hit;
    return 0;
  }
  /// The same for a direction in which a ray leaves the scene. 0 unless infinite and not delta.
  virtual float pdfEscape(const Vec3& wi) const { return (void)wi, 0.f; }
  /// Radiance emitted by the surface point `at` towards `w`. Black for others than area lights.
  virtual Rgb emitted(const SurfaceInteraction& at, const Vec3& w) const {
    return (void)at, (void)w, Rgb();
  }
  /// Radiance along a ray that leaves the scene in direction `d`.
  virtual Rgb escaped(const Vec3& d) const { return (void)d, Rgb(); }

  /// Draws a ray that leaves the light: its place by `u`, its direction by `v`. None if nothing is
  /// emitted there; by default never: paths from lights do without this one.
  virtual std::optional<EmissionSample> sampleEmission(uint32_t element, const Vec2& u,
                                                       const Vec2& v) const {
    return (void)element, (void)u, (void)v, std::nullopt;
  }
  /// Densities with which sampleEmission() draws a ray along `w` (unit, away from the light) that
  /// starts where the normal is `n` (not read where there is no surface). Lights of one point or
  /// one direction: 1 in its place, and `w` must be a direction that they emit in.
  virtual EmissionPdf emissionPdf(uint32_t element, const Vec3& n, const Vec3& w) const {
    return (void)element, (void)n, (void)w, EmissionPdf{};
  }

  /// Emitted power in watts; exact for constant emission, else an estimate; black only if nothing
  /// is ever emitted.
  virtual Rgb power(uint32_t element) const = 0;
  /// None for infinite lights.
  virtual std::optional<LightBounds> bounds(uint32_t element) const = 0;
  /// For infinite lights: luminance of the irradiance on a surface with normal `n` (both sides
  /// where `transmits`), an estimate that is > 0 wherever light may arrive. 0 for others.
  virtual float irradianceEstimate(const Vec3& n, bool transmits) const {
    return (void)n, (void)transmits, 0.f;
  }
  /// The scene file's wish for samples a point in direct lighting ("samples", "nsamples").
  virtual int samples() const { return 1; }
};

struct LightContext : BuildContext {
  Transform lightToWorld;
  ImageCache& images;
};
/// Area lights know their shape.
struct AreaLightContext : BuildContext {
  const Shape& shape;
  ImageCache& images;
  const TextureResolver& textures;
};

using LightRegistry = Registry<Light, LightContext>;
using AreaLightRegistry = Registry<Light, AreaLightContext>;

/// Every light with dense ids: light `object(id)`, element `id − firstId(object)`.
class LightTable {
 public:
  struct Entry {
    const Light* light;
    uint32_t element;
  };
  /// Adds a light and returns its first id.
  LightId add(const Light* light);
  uint32_t size() const { return size_; }
  Entry operator[](LightId id) const {
    if (const Row* const row = rowOf(id)) return {row->at(id % kRow), 0};
    const Object& o = objects_[dense_ ? id : owner_[id]];
    return {o.light, id - o.firstId};
  }
  /// Fetches what Light::sample() of that light is going to read, in a row all of it at once.
  void prefetch(LightId id) const {
    if (const Row* const row = rowOf(id)) {
      const char* const light = reinterpret_cast<const char*>(row->at(id % kRow));
      prefetchLine(light);
      prefetchLine(light + row->beyond);
    } else {
      prefetchLine((*this)[id].light);
    }
  }
  size_t objectCount() const { return objects_.size(); }
  const Light& object(size_t i) const { return *objects_[i].light; }
  LightId firstId(size_t object) const { return objects_[object].firstId; }

 private:
  struct Object {
    const Light* light;
    LightId firstId;
  };
  /// Lights that lie in memory at equal distances, as those made one after the other do: they are
  /// found without a look at `objects_`, which misses the caches where lights are many.
  struct Row {
    const Light* first;
    ptrdiff_t stride = 0;  ///< in bytes; 0: they do not
    ptrdiff_t beyond = 0;  ///< from a light to Light::beyond(), if that is the same for all; else 0
    const Light* at(uint32_t i) const {
      return reinterpret_cast<const Light*>(reinterpret_cast<const char*>(first) +
                                            static_cast<ptrdiff_t>(i) * stride);
    }
  };
  static constexpr uint32_t kRow = 256;
  const Row* rowOf(LightId id) const {
    return dense_ && rows_[id / kRow].stride != 0 ? &rows_[id / kRow] : nullptr;
  }
  void addToRow(LightId id, const Light* light);

  HugeVector<Object> objects_;
  std::vector<Row> rows_;       ///< of kRow ids each, while dense
  HugeVector<uint32_t> owner_;  ///< index in objects_, per id; empty while dense
  uint32_t size_ = 0;
  /// While every object is one light its id is its index: a cache miss less where objects are many.
  bool dense_ = true;
};

}  // namespace lampyris
