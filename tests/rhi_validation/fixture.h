// A null device behind the validation, one sink that keeps every message, and a state with which every draw is right.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "rhi/null.h"
#include "rhi/rhi.h"
#include "rhi/validation.h"

namespace validation_test {

class KeepingSink final : public rhi::IMessageSink {
 public:
  struct Entry {
    rhi::Severity severity;
    rhi::MsgCode code;
    std::string object, text;
  };
  void OnMessage(const rhi::Message& m) override { entries.push_back({m.severity, m.code, m.object, m.text}); }
  std::string Dump() const;
  std::vector<Entry> entries;
};

// Hand-made blobs: the null device runs no code.
rhi::ShaderBlob VertexBlob();           // reads POSITION0 and TEXCOORD0, b3 of 64 bytes
rhi::ShaderBlob InstancedVertexBlob();  // reads POSITION0, and OFFSET0
rhi::ShaderBlob PlainVertexBlob();      // reads nothing
rhi::ShaderBlob GeometryBlob();         // takes LineListAdj
rhi::ShaderBlob PixelBlob();            // t0 "picture" Tex2D, t1 "items" of 16 bytes, s0 "smooth", b1 of 32 bytes
rhi::ShaderBlob PlainPixelBlob();
rhi::ShaderBlob ComputeBlob();  // u0 "result" of 16 bytes, u1 "drawing" Tex2D, t0 "items" of 16 bytes

class ValidationTest : public testing::Test {
 protected:
  ValidationTest();
  void TearDown() override;

  // Exactly this message came since the last look, and then none.
  void Gives(rhi::MsgCode code, rhi::Severity severity = rhi::Severity::Error);
  void GivesNothing();
  const std::string& LastText() const { return lastText_; }

  rhi::Ref<rhi::IBuffer> Buffer(const rhi::BufferDesc&, const void* init = nullptr);
  rhi::Ref<rhi::ITexture> Texture(const rhi::TextureDesc&, const rhi::SubresourceData* init = nullptr);
  rhi::Ref<rhi::IShaderResourceView> View(rhi::IResource*);
  rhi::Ref<rhi::IRenderTargetView> TargetView(rhi::ITexture*, const rhi::ViewDesc* = nullptr);
  rhi::Ref<rhi::IUnorderedAccessView> WriteView(rhi::IResource*);
  rhi::Ref<rhi::IShader> Shader(const rhi::ShaderBlob&);
  rhi::Ref<rhi::IQuery> Query(rhi::QueryType);
  rhi::Ref<rhi::ITexture> Target(uint32_t width, uint32_t height, uint32_t samples = 1);

  // Everything that the vertex and pixel blobs read, a target of 16 x 16, four vertices, six indices.
  void SetGoodState();
  void SetViewport(float x, float y, float width, float height);
  void SetTarget(rhi::IRenderTargetView*, rhi::IDepthStencilView* = nullptr);
  void SetVertices(rhi::IBuffer*, uint32_t stride = 20, uint32_t offset = 0, uint32_t slot = 0);
  void SetConstants(uint32_t slot, rhi::IBuffer*);
  void SetResource(rhi::Stage, uint32_t slot, rhi::IResource*);

  KeepingSink sink;
  rhi::Ref<rhi::IDevice> inner, device;
  rhi::IContext* context = nullptr;

  rhi::Ref<rhi::IShader> vs, ps;
  rhi::Ref<rhi::IInputLayout> layout;
  rhi::Ref<rhi::IBuffer> vertices, indices, drawConstants, passConstants, items;
  rhi::Ref<rhi::ITexture> color, depth, picture;
  rhi::Ref<rhi::IRenderTargetView> rtv;
  rhi::Ref<rhi::IDepthStencilView> dsv;
  rhi::Ref<rhi::ISamplerState> smooth;

 private:
  void MakeObjects();
  std::string lastText_;
};

}  // namespace validation_test
