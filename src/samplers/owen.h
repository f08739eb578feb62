// SPDX-License-Identifier: Apache-2.0
/// Owen-scrambled Sobol' points in two dimensions, by hashing: Burley 2020, "Practical Hash-based
/// Owen Scrambling" (JCGT 9(4)), after Laine and Karras 2011, with the hash constants of Vegdahl
/// 2021, "Building a Better LK Hash".
///
/// "Reversed" numbers have their most significant digit in bit 0: a product then carries from more
/// to less significant digits only, which is what nested uniform scrambling asks for.
#pragma once

#ifdef __GFNI__
#include <immintrin.h>
#endif

#include <bit>
#include <cstdint>

#include "core/hash.h"
#include "core/vector.h"

namespace lampyris {

#ifdef __GFNI__
inline uint64_t reverseBits(uint64_t v) {
  // One instruction reverses the bits of each byte, as a product with the antidiagonal matrix.
  const __m128i x = _mm_cvtsi64_si128(static_cast<long long>(v));
  const __m128i antidiagonal = _mm_set1_epi64x(static_cast<long long>(0x8040201008040201ULL));
  const __m128i bytes = _mm_gf2p8affine_epi64_epi8(x, antidiagonal, 0);
  return __builtin_bswap64(static_cast<uint64_t>(_mm_cvtsi128_si64(bytes)));
}
#else
constexpr uint64_t reverseBits(uint64_t v) {
  v = ((v >> 1) & 0x5555555555555555ULL) | ((v & 0x5555555555555555ULL) << 1);
  v = ((v >> 2) & 0x3333333333333333ULL) | ((v & 0x3333333333333333ULL) << 2);
  v = ((v >> 4) & 0x0f0f0f0f0f0f0f0fULL) | ((v & 0x0f0f0f0f0f0f0f0fULL) << 4);
  return __builtin_bswap64(v);
}
#endif
inline uint32_t reverseBits(uint32_t v) {
  return static_cast<uint32_t>(reverseBits(uint64_t{v}) >> 32);
}

/// Flips each bit of a reversed number in dependence on the bits below it: a bijection. The number
/// may stand in the upper half of a longer word. `multiplier` is odd.
template <class Word = uint32_t>
constexpr Word scrambleReversed(Word v, Word seed, uint32_t multiplier) {
  v ^= v * 0x3d20adeau;
  v += seed;
  v *= multiplier;
  v ^= v * 0x05526c56u;
  v ^= v * 0x53a22864u;
  return v;
}
constexpr uint32_t scrambleReversed(uint32_t v, uint32_t seed) {
  return scrambleReversed(v, seed, (seed >> 16) | 1);
}

/// The same, with the lowest bits, as far as `quaternary` has bits set, taken as base-4 digits (bit
/// 2k before bit 2k + 1): there each digit is permuted in dependence on the ones below it. Binary
/// scrambling knows 8 of the 24 permutations of a digit; adding one of its bits to the other, where
/// the digits below say so, gives the rest. `quaternary` = 0b…0101 over the digits.
constexpr uint32_t scrambleReversedBase4(uint32_t v, uint32_t seed, uint32_t quaternary) {
  v ^= v * 0x3d20adeau;
  v += seed;
  // An even factor, so that bit 2k of the product knows the bits below 2k only.
  v ^= (v >> 1) & (v * 0xb82f1e52u + (seed >> 7)) & quaternary;
  v += std::rotr(seed, 11);
  v *= (seed >> 16) | 1;
  v ^= v * 0x05526c56u;
  v ^= v * 0x53a22864u;
  return v;
}

/// Permutes indices such that each aligned block of 2^k of them stays together, for every k.
inline uint32_t shuffleIndex(uint32_t index, uint32_t seed) {
  return reverseBits(scrambleReversed(reverseBits(index), seed));
}

/// The reversed second coordinate of Sobol' point `index`; the reversed first one is `index`. Its
/// generator matrix is Pascal's triangle modulo 2: digit i is the sum of the digits j that contain
/// i bitwise (Lucas' theorem), a superset sum in five steps.
constexpr uint32_t sobolSecond(uint32_t index) {
  index ^= index >> 16;
  index ^= (index >> 8) & 0x00ff00ffu;
  index ^= (index >> 4) & 0x0f0f0f0fu;
  index ^= (index >> 2) & 0x33333333u;
  index ^= (index >> 1) & 0x55555555u;
  return index;
}

inline float owenPoint1D(uint32_t index, uint64_t seed) {
  return toUnitFloat(reverseBits(scrambleReversed(index, static_cast<uint32_t>(seed))));
}

inline Vec2 owenPoint2D(uint32_t index, uint64_t seed) {
  // y lives in the upper half of a 64-bit word: two scalar chains are faster than the vector
  // multiplications that compilers make of two equal ones.
  const uint32_t x = scrambleReversed(index, static_cast<uint32_t>(seed));
  const uint64_t y =
      scrambleReversed<uint64_t>(uint64_t{sobolSecond(index)} << 32, seed & 0xffffffff00000000ULL,
                                 static_cast<uint32_t>(seed >> 48) | 1);
  const uint64_t both = reverseBits(y | x);
  return {toUnitFloat(both), toUnitFloat(static_cast<uint32_t>(both))};
}

}  // namespace lampyris
