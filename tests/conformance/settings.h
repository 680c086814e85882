// What the command line sets for the cases.
#pragma once

#include <string>

namespace conformance {

// The folder of the models: --assets, else FUR_ASSETS in the environment, else ../shared/assets. Cases whose model is
// not there are skipped: GTEST_SKIP() << "no assets: " << file.
std::string AssetsFolder();
bool SetAssetsFolder(const std::string&);  // whether it is there

}  // namespace conformance
