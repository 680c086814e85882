#include "validation_objects.h"

#include <algorithm>

namespace rhi::validation {

uint32_t OtherCounts(IObject& object) {
  object.AddRef();
  return object.Release() - 1;  // one is the table's
}

const char* ToString(ObjectKind kind) {
  switch (kind) {
    case ObjectKind::Buffer: return "buffer";
    case ObjectKind::Texture: return "texture";
    case ObjectKind::ShaderResourceView: return "shader resource view";
    case ObjectKind::RenderTargetView: return "render target view";
    case ObjectKind::DepthStencilView: return "depth-stencil view";
    case ObjectKind::UnorderedAccessView: return "unordered access view";
    case ObjectKind::Shader: return "shader";
    case ObjectKind::InputLayout: return "input layout";
    case ObjectKind::BlendState: return "blend state";
    case ObjectKind::DepthStencilState: return "depth-stencil state";
    case ObjectKind::RasterizerState: return "rasterizer state";
    case ObjectKind::SamplerState: return "sampler state";
    case ObjectKind::Query: return "query";
  }
  return "object";
}

bool ObjectRecord::AnyMapped() const { return std::find(mapped.begin(), mapped.end(), true) != mapped.end(); }

ObjectRecord& ObjectTable::Add(ObjectKind kind, IObject* object, const char* name) {
  SweepIfGrown();
  ObjectRecord& record = records_[object];
  if (record.object) return record;
  record.object = Ref<IObject>(object);
  record.kind = kind;
  record.name = name ? name : "";
  return record;
}

void ObjectTable::Borrow(ObjectKind kind, IObject* object, const char* name) {
  ObjectRecord& record = records_[object];
  record.kind = kind;
  record.name = name ? name : "";
}

void ObjectTable::Return(const IObject* object) {
  const auto found = records_.find(object);
  if (found != records_.end() && !found->second.object) records_.erase(found);
}

ObjectRecord* ObjectTable::Find(const IObject* object) {
  const auto found = records_.find(object);
  return found == records_.end() ? nullptr : &found->second;
}

const char* ObjectTable::NameOf(const IObject* object) const {
  const auto found = records_.find(object);
  return found == records_.end() ? "" : found->second.name.c_str();
}

bool ObjectTable::SweepOnce() {
  const size_t before = records_.size();
  std::erase_if(records_, [this](const auto& entry) {
    const ObjectRecord& record = entry.second;
    // An open query stays, so that it can be named.
    if (!record.object || record.active || OtherCounts(*record.object) > 0) return false;
    mappedCount -= uint32_t(std::count(record.mapped.begin(), record.mapped.end(), true));
    return true;
  });
  return records_.size() != before;
}

void ObjectTable::Sweep() {
  while (SweepOnce()) {
  }  // a view that goes frees its resource
  sizeToSweepAt_ = std::max<size_t>(1024, records_.size() * 2);
}

void ObjectTable::SweepIfGrown() {
  if (records_.size() >= sizeToSweepAt_) Sweep();
}

}  // namespace rhi::validation
