// --preset and what goes with it.
#pragma once

#include <set>
#include <string>
#include <utility>

#include "fur/renderer.h"

namespace app {

// The value of the first of `choices` that is named `text`; else the first.
template <class T>
T Choose(const std::string& text, std::initializer_list<std::pair<const char*, T>> choices) {
  for (const auto& [name, value] : choices)
    if (text == name) return value;
  return choices.begin()->second;
}

// Sets the preset, its coat, technique and look. `given`: the names of the flags on the command line. Usage, in words,
// for flags that contradict the preset or that it does not have.
fur::Result<fur::Done> SetPreset(const std::string& preset, const std::string& coat, const std::set<std::string>& given,
                                 fur::RenderSettings* settings);

}  // namespace app
