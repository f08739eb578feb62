// SPDX-License-Identifier: Apache-2.0
/// Share of a uniform sky that a plane of microfacets (Trowbridge and Reitz; Smith's masking and
/// shadowing, correlated by height) shows, by quadrature over the facets in double precision.
/// Written from the papers (Walter et al. 2007, Heitz 2014), apart from src/materials.
#pragma once

namespace lampyris::test {

/// Fresnel's reflectance at a boundary with relative index `eta`, `cosine` > 0 in front of it.
double dielectricFresnel(double cosine, double eta);
/// The same of a metal with the complex index eta + i k.
double conductorFresnel(double cosine, double eta, double k);

/// `cosine` of the viewing direction, > 0; `alpha` in both directions; `facets`² of them.
double metalAlbedo(double cosine, double alpha, double eta, double k, int facets);
/// Reflected, and transmitted from behind over eta².
double glassAlbedo(double cosine, double alpha, double eta, int facets);

}  // namespace lampyris::test
