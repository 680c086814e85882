// A case in another process of this program, with a shader cache of its own.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "../rhi/gpu.h"

namespace conformance {

// An empty folder that lives as long as this.
class CacheFolder {
 public:
  CacheFolder();
  ~CacheFolder();
  CacheFolder(const CacheFolder&) = delete;
  CacheFolder& operator=(const CacheFolder&) = delete;
  const std::string& Path() const { return path_; }
  size_t Files() const;  // below it

 private:
  std::string path_;
};

struct ChildRun {
  std::vector<uint8_t> bytes;  // all that the case read back
  std::string problem;         // "", or what the process said
};
// `name` without the backend. The same adapter as this process; Mesa's drivers keep their cache in the folder.
ChildRun RunInChild(const std::string& name, rhi::Backend, const CacheFolder&);

}  // namespace conformance
