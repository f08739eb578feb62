// SPDX-License-Identifier: Apache-2.0
#include "accelerators/embree_memory.h"

#include <vector>

namespace lampyris {

namespace {

// Bytes, measured with Embree 3.13. An element is a sphere, a piece of a curve, …
constexpr double kTriangle = 100, kMesh = 600, kElement = 170;
constexpr double kObject = 2700, kElementsOfObject = 800;
constexpr double kInstance = 420, kMovingInstance = 900;

double memoryOf(const std::vector<Primitive>& primitives) {
  double sum = 0, elements = 0;
  for (const Primitive& p : primitives) {
    const auto triangles = static_cast<double>(p.shape->triangles().triangleCount);
    if (triangles > 0)
      sum += kMesh + kTriangle * triangles;
    else
      elements += p.shape->elementCount();
  }
  return sum + (elements > 0 ? kElementsOfObject + kElement * elements : 0);
}

}  // namespace

double estimateEmbreeMemory(const GeometryDescription& description) {
  double sum = memoryOf(description.primitives);
  for (const ObjectDefinition& object : description.objects)
    sum += kObject + memoryOf(object.primitives);
  for (const ObjectInstance& instance : description.instances)
    sum += instance.motion.empty() ? kInstance : kMovingInstance;
  return sum;
}

}  // namespace lampyris
