// The immediate context: records into the command buffer of the current submission.
//
// A pass (vkCmdBeginRendering) is begun by the first draw that needs it. Draw looks at the dirty bits: none set, it is
// the call itself; only new constants, set 0 is bound again with new offsets; other shaders or blending as well,
// SwitchPipeline; else PrepareDraw does the rest.
#pragma once

#include <optional>

#include "barriers.h"
#include "context_bits.h"
#include "descriptors.h"
#include "pipeline.h"
#include "queries.h"
#include "resources.h"
#include "spirv.h"

namespace rhi_vulkan {

class VulkanDevice;

struct WindowImage {
  VkImage image;
  VkFormat format;
  VkExtent2D extent;
};

// Command buffers and descriptor sets of one submission.
struct Batch {
  explicit Batch(Core& c) : core(c), sets(c) {}
  ~Batch();
  Status Create();

  Core& core;
  VkCommandPool pool = VK_NULL_HANDLE;
  VkCommandBuffer setup = VK_NULL_HANDLE;  // runs before `main`: contents of new resources, so that no pass is broken
  VkCommandBuffer main = VK_NULL_HANDLE;
  bool setupBegun = false;
  uint64_t serial = 0;
  DescriptorArena sets;
};

inline constexpr uint32_t kNoStarts = ~0u;  // of the arguments of a dispatch

// Stand-ins for registers with nothing bound.
struct NullResources {
  GpuBuffer zeros;  // kMaxConstantBufferBytes of zero
  GpuBuffer sink;   // writes to unbound u registers, where null descriptors are missing
  std::array<std::array<Ref<ITexture>, 2>, 5> textures;  // [TextureDim][integer], made when first needed
  std::array<std::array<VkImageView, 2>, 5> views{};
  Ref<ISamplerState> sampler;
};

class Context final : public backend::ContextBase {
 public:
  Context(VulkanDevice& device, std::shared_ptr<Core> core, uint32_t framesInFlight);
  ~Context();
  Status Init();

  void ClearRenderTargetView(IRenderTargetView*, const float rgba[4]) override;
  void ClearDepthStencilView(IDepthStencilView*, bool clearDepth, float depth, bool clearStencil,
                             uint8_t stencil) override;
  Status Map(IResource*, uint32_t subresource, MapMode, Mapped*) override;
  void Unmap(IResource*, uint32_t subresource) override;
  void UpdateConstants(IBuffer*, const void* data, uint32_t size) override;
  void UpdateSubresource(IResource*, uint32_t subresource, const Box*, const void* data, uint32_t rowPitch,
                         uint32_t slicePitch) override;
  void CopyResource(IResource* dst, IResource* src) override;
  void CopySubresourceRegion(IResource* dst, uint32_t dstSubresource, uint32_t x, uint32_t y, uint32_t z,
                             IResource* src, uint32_t srcSubresource, const Box*) override;
  void ResolveSubresource(ITexture* dst, uint32_t dstSubresource, ITexture* src, uint32_t srcSubresource,
                          Format) override;
  void GenerateMips(IShaderResourceView*) override;
  void Draw(uint32_t vertexCount, uint32_t startVertex) override;
  void DrawIndexed(uint32_t indexCount, uint32_t startIndex, int32_t baseVertex) override;
  void DrawInstanced(uint32_t vertexCountPerInstance, uint32_t instanceCount, uint32_t startVertex,
                     uint32_t startInstance) override;
  void DrawIndexedInstanced(uint32_t indexCountPerInstance, uint32_t instanceCount, uint32_t startIndex,
                            int32_t baseVertex, uint32_t startInstance) override;
  void DrawInstancedIndirect(IBuffer* args, uint32_t offset) override;
  void DrawIndexedInstancedIndirect(IBuffer* args, uint32_t offset) override;
  void Dispatch(uint32_t x, uint32_t y, uint32_t z) override;
  void DispatchIndirect(IBuffer* args, uint32_t offset) override;
  void Begin(IQuery*) override;
  void End(IQuery*) override;
  Status GetData(IQuery*, void* data, uint32_t size, bool flush) override;
  void BeginEvent(const char* name) override;
  void EndEvent() override;
  void Flush() override;
  void EndFrame() override;
  IDevice* Device() override;

  // For the device.
  Status InitBuffer(Buffer&, const void* data);
  Status InitTexture(Texture&, const SubresourceData*);
  Status ReadBuffer(Buffer&, uint32_t offset, uint32_t size, void* out);
  Status ReadTexture(Texture&, uint32_t subresource, void* out, size_t capacity, uint32_t rowPitch);
  Status Finish();  // submits and waits
  Status SubmitAll(const PresentSync& = {});
  // Brings a texture to an image of a window, scaled and converted where they differ, and submits.
  Status WriteWindowImage(Texture& from, const WindowImage& to, const PresentSync&);
  Stats TakeStats(bool reset);
  void Disown(const Buffer&);  // nobody holds the constant buffer any more

 private:
  struct PendingClear {
    Ref<IView> view;
    Texture* texture;
    SubresourceRange range;
    VkImageView image;
    VkExtent2D extent;
    uint32_t layers;
    VkImageAspectFlags aspects;  // what to clear
    VkClearValue value;
  };
  struct PassTargets {
    std::array<TargetView*, kMaxRenderTargets> colors{};
    uint32_t colorCount = 0;
    DepthView* depth = nullptr;
    VkExtent2D extent{};
    uint32_t layers = 1, samples = 1;
    bool operator==(const PassTargets& o) const {
      return colors == o.colors && colorCount == o.colorCount && depth == o.depth;
    }
  };
  struct TextureRegion {  // one end of a copy
    Texture* texture;
    uint32_t subresource, x, y, z;
  };

  // context_submit.cpp
  Status BeginBatch();
  void RecycleBatches();
  VkCommandBuffer Setup();
  void Report(Severity, MsgCode, const char* object, const char* text);  // once for each code and frame
  void OpenEvent(const std::string& name);
  void CloseEvent();
  Status WaitForSerial(uint64_t serial);  // submits first if need be

  // context_pass.cpp
  void Use(Texture&, const SubresourceRange&, const Access&);
  void Use(Buffer&, Access);
  void RecordBarriers();
  void LeavePass();  // before work that cannot be in a pass
  void EndPass(bool broken);
  bool GatherTargets(PassTargets*);
  void BeginPass(const PassTargets&);
  void AddClear(PendingClear);
  bool ClearInPass(const PendingClear&);
  bool TakeClear(const IView*, PendingClear* out);
  void FlushClears(const Texture* only);
  void RunClear(const PendingClear&);

  // context_draw.cpp
  bool PrepareDraw();
  bool SwitchPipeline();
  bool ReadyToDraw() {
    const uint32_t dirty = dirty_ & kDirtyDraw;
    if (dirty == 0) return true;
    if (dirty != kDirtyOffsets) return ((dirty & ~kDirtySwitch) == 0 && SwitchPipeline()) || PrepareDraw();
    BindConstantOffsets();
    return true;
  }
  bool CheckDraw();
  bool CheckGeometryInput(const Shader* gs);
  void UseInputs();
  void UseStageInputs(Stage, const Shader*);
  bool BindPipeline();
  PipelineKey CurrentKey() const;
  bool CheckIndexBuffer();
  // `startsAt`: where in the arguments the starts of vertices and instances are.
  Buffer* PrepareIndirect(IBuffer*, uint32_t offset, uint32_t size, uint32_t startsAt);
  void PushStarts(const DrawStarts&);
  void CopyStarts(Buffer& args, uint32_t offset);
  void BindVertexBuffers();
  void BindIndexBuffer();
  // context_state.cpp
  void ApplyDynamicState();
  void ApplyViewports();
  void ApplyScissors();
  void ApplyRaster();
  void ApplyDepthStencil();
  // context_sets.cpp
  void BindConstantOffsets() {
    dirty_ &= ~kDirtyOffsets;
    vk_.vkCmdBindDescriptorSets(cmd_, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline_->layout, kVkConstantSet, 1,
                                &constantSet_, kMaxConstantBuffers, constantOffsets_.data());
  }
  void OwnOffset(uint32_t slot, Buffer*);
  bool BindConstants();
  VkDescriptorSet ConstantSet();
  bool BindStageSets();
  VkDescriptorSet StageSet(Stage, const Shader&);
  VkDescriptorSet UavSet(const Shader&);
  void WriteSet(VkDescriptorSet);
  void AddResource(Stage, const ShaderResource&);
  void AddSampler(Stage, const ShaderSampler&);
  void AddUav(const ShaderResource&);
  void AddImage(uint32_t binding, VkDescriptorType, VkImageView, VkImageLayout, uint64_t id);
  void AddBuffer(uint32_t binding, VkBuffer, VkDeviceSize offset, VkDeviceSize range, uint64_t id);
  VkImageView NullView(TextureDim, bool integer);
  // context_compute.cpp
  bool PrepareDispatch();
  void EndDispatch();
  // context_queries.cpp
  void StartSegments(bool compute);
  void StopSegments();
  // context_map.cpp
  bool Discard(Buffer&);
  bool DiscardInPage(Buffer&);
  bool DiscardInNewPage(Buffer&);
  void UpdateInNewPage(Buffer*, const void* data, uint32_t size);
  Status MapBuffer(Buffer&, MapMode, Mapped*);
  Status MapTexture(Texture&, uint32_t subresource, MapMode, Mapped*);
  Status MapError(MsgCode, const char* object, const char* text);
  // context_upload.cpp
  void UpdateBuffer(Buffer&, const Box*, const void* data);
  void UpdateTexture(Texture&, uint32_t subresource, const Box*, const SubresourceData&);
  bool Upload(VkCommandBuffer, Texture&, uint32_t subresource, const Box&, const SubresourceData&);
  // context_copy.cpp
  void CopyBuffers(Buffer& dst, uint32_t x, Buffer& src, const Box*);
  void CopyTextures(const TextureRegion& dst, const TextureRegion& src, const Box*);
  void CopyImages(const TextureRegion& dst, const TextureRegion& src, const Box& box);
  void CopyImageAndBuffer(const TextureRegion& image, const TextureRegion& staging, const Box& box, bool toImage);
  void CopyStaging(const TextureRegion& dst, const TextureRegion& src, const Box& box);
  void UseStaging(GpuBuffer&, Access);
  void FinishStaging(GpuBuffer&, bool written);
  void Complain(MsgCode, const char* object, const char* text);
  void Blit(Texture&, const SubresourceRange& range, uint32_t mip);
  // context_readback.cpp
  void CopyToBuffer(Texture&, uint32_t subresource, const backend::MipLayout&, GpuBuffer&, VkDeviceSize stencilAt);

  VulkanDevice& device_;
  std::shared_ptr<Core> core_;
  const VolkDeviceTable& vk_;
  Ring& ring_;
  VkCommandBuffer cmd_ = VK_NULL_HANDLE;
  // Where the contents of b0..b3 are in their pages. A dynamic buffer writes its own entry when its contents move.
  std::array<uint32_t, kMaxConstantBuffers> constantOffsets_{};
  std::array<Buffer*, kMaxConstantBuffers> offsetOwners_{};  // no references: a buffer that goes says so (Disown)
  VkDescriptorSet constantSet_ = VK_NULL_HANDLE;
  const Pipeline* pipeline_ = nullptr;
  bool inPass_ = false;
  const bool emulateStarts_;  // see DrawStarts

  PipelineKey key_;
  std::array<const SetLayout*, 3> boundLayouts_{};
  std::array<VkDescriptorSet, 3> boundSets_{};
  PassTargets pass_;
  std::vector<PendingClear> clears_;
  BarrierBatch barriers_;
  SetKey setKey_;
  bool setIncomplete_ = false;  // no memory for the texture that stands in for an unbound one
  std::vector<VkWriteDescriptorSet> writes_;
  std::array<VkDescriptorImageInfo, 32> imageInfos_{};
  std::array<VkDescriptorBufferInfo, 32> bufferInfos_{};

  std::unique_ptr<Batch> batch_;
  std::deque<std::unique_ptr<Batch>> inFlight_;
  std::vector<std::unique_ptr<Batch>> idle_;  // reset, to be used again
  std::deque<uint64_t> frames_;  // last serials of the frames in flight
  uint32_t framesInFlight_;
  NullResources null_;
  GpuBuffer starts_;                        // DrawStarts of the latest indirect draw, where they are emulated
  std::optional<DrawStarts> pushedStarts_;  // none: nothing pushed in this command buffer
  VkPipelineStageFlags2 constantStages_ = 0;
  std::vector<MsgCode> reported_;
  std::vector<std::string> events_;  // begun and not ended
  uint64_t pipelinesBefore_ = 0;     // PipelineCache::made at the last reset of the statistics

  std::array<std::vector<Ref<Query>>, 2> active_;  // [SegmentKind]: queries begun and not ended
  std::array<std::shared_ptr<QuerySegment>, 2> running_;
};

}  // namespace rhi_vulkan
