// Functions that give the same bits on every machine: only what IEEE 754 fixes, besides frexp, ldexp and floor.
#pragma once

#include <glm/glm.hpp>

namespace fur {

// x^p for x in [0, 1], p >= 0; better than 1e-10. 0^0 = 1.
double Power(double x, double p);

// (cos, sin) of 2 pi turns; better than 1e-14 for |turns| < 1e6.
glm::dvec2 CosSinTurns(double turns);

// The shortest way around the unit tile from 0 to d.
double Nearest(double d);
glm::dvec2 Nearest(glm::dvec2 d);

}  // namespace fur
