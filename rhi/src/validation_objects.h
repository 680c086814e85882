// What the validation knows of the objects of its device.
#pragma once

#include <string>
#include <unordered_map>
#include <vector>

#include "rhi/device.h"

namespace rhi::validation {

enum class ObjectKind : uint8_t {
  Buffer,
  Texture,
  ShaderResourceView,
  RenderTargetView,
  DepthStencilView,
  UnorderedAccessView,
  Shader,
  InputLayout,
  BlendState,
  DepthStencilState,
  RasterizerState,
  SamplerState,
  Query
};
const char* ToString(ObjectKind);

// The counts of an object of the table that others hold.
uint32_t OtherCounts(IObject&);

struct ObjectRecord {
  Ref<IObject> object;  // null: borrowed (a back buffer), whose end the owner announces
  ObjectKind kind = ObjectKind::Buffer;
  std::string name;
  ShaderReflection shader;             // shaders; the tables have static lifetime
  std::vector<ShaderInput> inputs;     // layouts: what the shader that it was made for reads
  std::vector<InputElement> elements;  // layouts: the element of each of `inputs`
  std::vector<bool> mapped;            // resources: for each subresource
  bool active = false, ended = false;  // queries
  uint64_t workAtBegin = 0;            // queries: draws and dispatches before Begin

  bool AnyMapped() const;
};

// Holds a count of each object, so that an address here is never that of another object. An object of which nobody else
// holds a count is dropped by the next Sweep.
class ObjectTable {
 public:
  ObjectRecord& Add(ObjectKind, IObject*, const char* name);  // an interned object keeps its record
  void Borrow(ObjectKind, IObject*, const char* name);
  void Return(const IObject*);  // the end of a borrowed object
  ObjectRecord* Find(const IObject*);
  const char* NameOf(const IObject*) const;

  void Sweep();
  void Clear() { records_.clear(); }
  void SweepIfGrown();  // lest a long loading between two frames keeps all it dropped
  size_t Size() const { return records_.size(); }
  const auto& Records() const { return records_; }

  uint32_t mappedCount = 0;  // of subresources

 private:
  bool SweepOnce();
  std::unordered_map<const IObject*, ObjectRecord> records_;
  size_t sizeToSweepAt_ = 1024;
};

}  // namespace rhi::validation
