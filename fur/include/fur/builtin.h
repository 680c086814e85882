// The built-in animal: needs no file.
#pragma once

#include "fur/model.h"

namespace fur {

// A small quadruped: torso, head with muzzle and ears, four legs, a tail, bald eyes and nose; UV seams; patterned base
// colour; a length map; a coat of strands. At least 2,000 triangles, of which the furred skin is one primitive. Looks
// along +Z, Y up, feet at y = 0, about 2 units long. Deterministic.
Model MakeBuiltinAnimal();

}  // namespace fur
