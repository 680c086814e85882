// Whether every number of a vector or a matrix is one.
#pragma once

#include <cmath>
#include <glm/glm.hpp>

namespace fur {

template <glm::length_t N, class T>
bool IsFinite(const glm::vec<N, T>& v) {
  for (glm::length_t i = 0; i < N; ++i)
    if (!std::isfinite(v[i])) return false;
  return true;
}

inline bool IsFinite(const glm::dmat4& m) { return IsFinite(m[0]) && IsFinite(m[1]) && IsFinite(m[2]) && IsFinite(m[3]); }

}  // namespace fur
