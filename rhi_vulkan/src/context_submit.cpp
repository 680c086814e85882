// The context's life: batches of commands, submission, frames.
#include <cstring>

#include "context.h"
#include "device.h"

namespace rhi_vulkan {
namespace {

// More submissions than this in flight, and the oldest is waited for: a program that only calls Flush must not grow.
constexpr size_t kMaxBatches = 16;

void BeginCommands(Core& core, VkCommandBuffer cmd) {
  VkCommandBufferBeginInfo info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
  info.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  if (const VkResult r = core.vk.vkBeginCommandBuffer(cmd, &info); r != VK_SUCCESS)
    core.Lose(r, "vkBeginCommandBuffer");
}

}  // namespace

Batch::~Batch() {
  if (pool) core.vk.vkDestroyCommandPool(core.device, pool, nullptr);
}

Status Batch::Create() {
  VkCommandPoolCreateInfo poolInfo{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
  poolInfo.flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT;
  poolInfo.queueFamilyIndex = core.adapter.queueFamily;
  VkResult result = core.vk.vkCreateCommandPool(core.device, &poolInfo, nullptr, &pool);
  Status s = core.CheckOnce(result, "", "vkCreateCommandPool");
  if (s != Status::Ok) return s;
  VkCommandBufferAllocateInfo info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
  info.commandPool = pool;
  info.commandBufferCount = 2;
  std::array<VkCommandBuffer, 2> buffers{};
  result = core.vk.vkAllocateCommandBuffers(core.device, &info, buffers.data());
  s = core.CheckOnce(result, "", "vkAllocateCommandBuffers");
  setup = buffers[0];
  main = buffers[1];
  return s;
}

Context::Context(VulkanDevice& device, std::shared_ptr<Core> core, uint32_t framesInFlight)
    : ContextBase(core->log),
      device_(device),
      core_(std::move(core)),
      vk_(core_->vk),
      ring_(*core_->ring),
      emulateStarts_(!core_->adapter.features.drawParameters),
      framesInFlight_(std::max(1u, framesInFlight)) {
  constantStages_ = StageBits(Stage::Vertex) | StageBits(Stage::Pixel);
  if (core_->adapter.caps.geometryShader) constantStages_ |= StageBits(Stage::Geometry);
  core_->context = this;
}

Context::~Context() {
  core_->context = nullptr;
  running_ = {};
  active_ = {};
  clears_.clear();
  for (uint32_t slot = 0; slot < kMaxConstantBuffers; ++slot) OwnOffset(slot, nullptr);
  ContextBase::ClearState();
  for (auto& views : null_.views)
    for (VkImageView view : views)
      if (view) vk_.vkDestroyImageView(core_->device, view, nullptr);
  null_.zeros.Destroy(*core_);
  null_.sink.Destroy(*core_);
  starts_.Destroy(*core_);
}

Status Context::Init() {
  constexpr VkBufferUsageFlags kUsage = VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT |
                                        VK_BUFFER_USAGE_VERTEX_BUFFER_BIT | VK_BUFFER_USAGE_INDEX_BUFFER_BIT;
  for (GpuBuffer* buffer : {&null_.zeros, &null_.sink}) {
    const Status s = buffer->Create(*core_, "rhi unbound", kMaxConstantBufferBytes, kUsage, MemoryKind::Upload);
    if (s != Status::Ok) return s;
    std::memset(buffer->memory.mapped, 0, kMaxConstantBufferBytes);
  }
  if (emulateStarts_) {
    const Status s =
        starts_.Create(*core_, "rhi draw starts", sizeof(DrawStarts),
                       VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT, MemoryKind::Upload);
    if (s != Status::Ok) return s;
    std::memset(starts_.memory.mapped, 0, sizeof(DrawStarts));
  }
  if (Status s = device_.CreateSamplerState({}, &null_.sampler); s != Status::Ok) return s;
  return BeginBatch();
}

Status Context::BeginBatch() {
  RecycleBatches();
  if (idle_.empty()) {
    auto fresh = std::make_unique<Batch>(*core_);
    const Status s = fresh->Create();
    if (s != Status::Ok && inFlight_.empty()) return s;
    if (s == Status::Ok) {
      idle_.push_back(std::move(fresh));
    } else {  // then one that the GPU is done with serves again
      core_->Wait(inFlight_.back()->serial);
      RecycleBatches();
    }
  }
  batch_ = std::move(idle_.back());
  idle_.pop_back();
  batch_->serial = core_->recording;
  batch_->setupBegun = false;
  cmd_ = batch_->main;
  BeginCommands(*core_, cmd_);
  // A new command buffer knows no state.
  dirty_ = backend::DirtyAll;
  pipeline_ = nullptr;
  boundLayouts_ = {};
  boundSets_ = {};
  constantSet_ = VK_NULL_HANDLE;
  pushedStarts_.reset();
  for (const std::string& event : events_) OpenEvent(event);
  return core_->lost ? Status::DeviceLost : Status::Ok;
}

void Context::RecycleBatches() {
  if (inFlight_.size() >= kMaxBatches) core_->Wait(inFlight_.front()->serial);
  core_->Collect();
  while (!inFlight_.empty() && inFlight_.front()->serial <= core_->Completed()) {
    Batch& done = *inFlight_.front();
    // At once: drivers that keep each command in memory of its own then fill the same memory again and again.
    const VkResult reset = vk_.vkResetCommandPool(core_->device, done.pool, 0);
    if (reset != VK_SUCCESS) core_->Lose(reset, "vkResetCommandPool");
    done.sets.Reset();
    idle_.push_back(std::move(inFlight_.front()));
    inFlight_.pop_front();
  }
}

VkCommandBuffer Context::Setup() {
  if (!batch_->setupBegun) BeginCommands(*core_, batch_->setup);
  batch_->setupBegun = true;
  return batch_->setup;
}

void Context::Flush() { SubmitAll(); }

// A lost device goes through the same motions, so that a program that draws on does not fill the memory.
Status Context::SubmitAll(const PresentSync& present) {
  EndPass(false);
  FlushClears(nullptr);
  RecordBarriers();
  // Events that are open go on in the next command buffer. The API would let one end a label of the last one there, but
  // Mesa 22.3 then crashes.
  for (size_t i = 0; i < events_.size(); ++i) CloseEvent();
  std::array<VkCommandBuffer, 2> commands{};
  uint32_t count = 0;
  if (batch_->setupBegun) commands[count++] = batch_->setup;
  commands[count++] = batch_->main;
  for (uint32_t i = 0; i < count; ++i)
    if (const VkResult r = vk_.vkEndCommandBuffer(commands[i]); r != VK_SUCCESS) core_->Lose(r, "vkEndCommandBuffer");
  const Status submitted = core_->Submit(count, commands.data(), present);
  inFlight_.push_back(std::move(batch_));
  BeginBatch();
  return submitted;
}

void Context::EndFrame() {
  Flush();
  reported_.clear();
  core_->SpeakAgain();
  core_->pipelines->ForgetFailed();
  frames_.push_back(core_->recording - 1);
  if (frames_.size() <= framesInFlight_) return;
  core_->Wait(frames_.front());
  frames_.pop_front();
}

Status Context::Finish() {
  Flush();
  const Status s = core_->Wait(core_->recording - 1);
  RecycleBatches();
  return s;
}

Status Context::WaitForSerial(uint64_t serial) {
  if (serial == core_->recording) Flush();
  return core_->Wait(serial);
}

void Context::Report(Severity severity, MsgCode code, const char* object, const char* text) {
  if (std::find(reported_.begin(), reported_.end(), code) != reported_.end()) return;
  reported_.push_back(code);
  log_.Report(severity, code, object, "%s", text);
}

Stats Context::TakeStats(bool reset) {
  Stats out = stats_;
  out.pipelineMisses = core_->pipelines->made - pipelinesBefore_;
  if (!reset) return out;
  stats_ = {};
  pipelinesBefore_ = core_->pipelines->made;
  return out;
}

IDevice* Context::Device() { return &device_; }

void Context::BeginEvent(const char* name) {
  events_.emplace_back(name ? name : "");
  OpenEvent(events_.back());
}

void Context::EndEvent() {
  if (events_.empty())
    return Report(Severity::Warning, MsgCode::QueryOrder, "", "EndEvent without a BeginEvent is ignored");
  events_.pop_back();
  CloseEvent();
}

void Context::OpenEvent(const std::string& name) {
  if (!core_->instance.vk.vkCmdBeginDebugUtilsLabelEXT) return;
  VkDebugUtilsLabelEXT label{VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT};
  label.pLabelName = name.c_str();
  core_->instance.vk.vkCmdBeginDebugUtilsLabelEXT(cmd_, &label);
}

void Context::CloseEvent() {
  if (core_->instance.vk.vkCmdEndDebugUtilsLabelEXT) core_->instance.vk.vkCmdEndDebugUtilsLabelEXT(cmd_);
}

}  // namespace rhi_vulkan
