// Passes, pending clears, and barriers.
#include "context.h"

namespace rhi_vulkan {
namespace {

bool Overlap(const SubresourceRange& a, const SubresourceRange& b) {
  return a.mip < b.mip + b.mips && b.mip < a.mip + a.mips && a.slice < b.slice + b.slices &&
         b.slice < a.slice + a.slices;
}

VkRenderingAttachmentInfo Attachment(VkImageView view, VkImageLayout layout) {
  VkRenderingAttachmentInfo info{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
  info.imageView = view;
  info.imageLayout = layout;
  info.loadOp = VK_ATTACHMENT_LOAD_OP_LOAD;
  info.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
  return info;
}

void SetClear(VkRenderingAttachmentInfo& info, const VkClearValue& value) {
  info.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
  info.clearValue = value;
}

VkClearColorValue ColorOf(Format format, const float rgba[4]) {
  VkClearColorValue out{};
  if (GetFormatInfo(format).isInteger) {
    for (int i = 0; i < 4; ++i) out.uint32[i] = rgba[i] > 0 ? uint32_t(double(rgba[i])) : 0;
  } else {
    std::copy(rgba, rgba + 4, out.float32);
  }
  return out;
}

// The three attachment lists of a pass.
struct PassInfo {
  std::array<VkRenderingAttachmentInfo, kMaxRenderTargets> colors{};
  VkRenderingAttachmentInfo depth{}, stencil{};
  VkRenderingInfo info{VK_STRUCTURE_TYPE_RENDERING_INFO};

  PassInfo(VkExtent2D extent, uint32_t layers) {
    info.renderArea.extent = extent;
    info.layerCount = layers;
    info.pColorAttachments = colors.data();
  }
  PassInfo(const PassInfo&) = delete;
  PassInfo& operator=(const PassInfo&) = delete;

  void SetDepth(VkImageView view, VkImageAspectFlags has, VkImageAspectFlags clear, const VkClearValue& value) {
    depth = stencil = Attachment(view, kDepthTarget.layout);
    if (clear & VK_IMAGE_ASPECT_DEPTH_BIT) SetClear(depth, value);
    if (clear & VK_IMAGE_ASPECT_STENCIL_BIT) SetClear(stencil, value);
    info.pDepthAttachment = &depth;
    if (has & VK_IMAGE_ASPECT_STENCIL_BIT) info.pStencilAttachment = &stencil;
  }
};

}  // namespace

void Context::Use(Texture& texture, const SubresourceRange& range, const Access& use) {
  if (texture.pendingClears) [[unlikely]] {
    LeavePass();
    FlushClears(&texture);
  }
  texture.Advance(range, use, barriers_);
}

void Context::Use(Buffer& buffer, Access use) {
  if (buffer.IsDynamic()) return;  // the CPU writes it, before the submission
  use.layout = VK_IMAGE_LAYOUT_UNDEFINED;
  const Dependency d = Advance(buffer.gpu.state, use);
  if (d.needed) barriers_.Buffer(buffer.gpu.handle, d);
}

void Context::RecordBarriers() {
  if (barriers_.Empty()) return;
  LeavePass();
  stats_.barriers += barriers_.Record(vk_, cmd_);
}

void Context::LeavePass() { EndPass(true); }

void Context::EndPass(bool broken) {
  if (!inPass_) return;
  StopSegments();
  vk_.vkCmdEndRendering(cmd_);
  inPass_ = false;
  dirty_ |= kDirtyPass;
  if (broken) ++stats_.passBreaks;
}

bool Context::GatherTargets(PassTargets* out) {
  bool first = true, same = true;
  const auto add = [&](const auto& view) {
    const VkExtent2D extent{view.Width(), view.Height()};
    const uint32_t samples = view.texture->Desc().sampleCount, layers = view.Layers();
    if (first) {
      out->extent = extent;
      out->samples = samples;
      out->layers = layers;
    }
    first = false;
    same = same && extent.width == out->extent.width && extent.height == out->extent.height && samples == out->samples;
    out->layers = std::min(out->layers, layers);
  };
  out->colorCount = state_.targetCount;
  for (uint32_t i = 0; i < state_.targetCount; ++i) {
    out->colors[i] = static_cast<TargetView*>(state_.targets[i].get());
    if (out->colors[i]) add(*out->colors[i]);
  }
  out->depth = static_cast<DepthView*>(state_.depthTarget.get());
  if (out->depth) add(*out->depth);
  if (first)
    Report(Severity::Error, MsgCode::NoTarget, "", "draw without a target; call OMSetRenderTargets; it is skipped");
  if (!same)
    Report(Severity::Error, MsgCode::TargetsDiffer, "",
           "the bound targets differ in size or sample count; the draw is skipped");
  return !first && same;
}

void Context::BeginPass(const PassTargets& targets) {
  PassInfo pass(targets.extent, targets.layers);
  std::array<PendingClear, kMaxRenderTargets> colorClears;
  PendingClear depthClear{};
  std::array<bool, kMaxRenderTargets> cleared{};
  // First take the clears that become load ops: Use would run what is left in the list.
  for (uint32_t i = 0; i < targets.colorCount; ++i)
    if (targets.colors[i]) cleared[i] = TakeClear(targets.colors[i], &colorClears[i]);
  const bool depthCleared = targets.depth && TakeClear(targets.depth, &depthClear);
  for (uint32_t i = 0; i < targets.colorCount; ++i) {
    TargetView* view = targets.colors[i];
    pass.colors[i] = Attachment(view ? view->view : VK_NULL_HANDLE, kColorTarget.layout);
    if (!view) continue;
    Use(*view->texture, view->Range(), kColorTarget);
    if (cleared[i]) SetClear(pass.colors[i], colorClears[i].value);
  }
  pass.info.colorAttachmentCount = targets.colorCount;
  if (DepthView* view = targets.depth) {
    Use(*view->texture, view->Range(), kDepthTarget);
    pass.SetDepth(view->view, view->texture->aspects, depthCleared ? depthClear.aspects : 0, depthClear.value);
  }
  RecordBarriers();
  vk_.vkCmdBeginRendering(cmd_, &pass.info);
  ++stats_.passes;
  pass_ = targets;
  inPass_ = true;
  dirty_ &= ~kDirtyPass;
  StartSegments(false);
}

void Context::ClearRenderTargetView(IRenderTargetView* target, const float rgba[4]) {
  auto* view = static_cast<TargetView*>(target);
  if (!view) return Complain(MsgCode::InvalidDesc, "", "ClearRenderTargetView of no view; it is ignored");
  PendingClear clear{Ref<IView>(view),
                     view->texture,
                     view->Range(),
                     view->view,
                     {view->Width(), view->Height()},
                     view->Layers(),
                     VK_IMAGE_ASPECT_COLOR_BIT,
                     {}};
  clear.value.color = ColorOf(view->Desc().format, rgba);
  AddClear(std::move(clear));
}

void Context::ClearDepthStencilView(IDepthStencilView* target, bool clearDepth, float depth, bool clearStencil,
                                    uint8_t stencil) {
  auto* view = static_cast<DepthView*>(target);
  if (!view) return Complain(MsgCode::InvalidDesc, "", "ClearDepthStencilView of no view; it is ignored");
  VkImageAspectFlags aspects = 0;
  if (clearDepth) aspects |= VK_IMAGE_ASPECT_DEPTH_BIT;
  if (clearStencil) aspects |= VK_IMAGE_ASPECT_STENCIL_BIT;
  aspects &= view->texture->aspects;
  if (!aspects) return;
  PendingClear clear{Ref<IView>(view),
                     view->texture,
                     view->Range(),
                     view->view,
                     {view->Width(), view->Height()},
                     view->Layers(),
                     aspects,
                     {}};
  clear.value.depthStencil = {std::clamp(depth, 0.0f, 1.0f), stencil};
  AddClear(std::move(clear));
}

void Context::AddClear(PendingClear clear) {
  if (core_->lost) return;
  if (inPass_ && ClearInPass(clear)) return;
  for (PendingClear& old : clears_) {
    if (old.view == clear.view) {  // the later clear of an aspect counts
      if (clear.aspects & VK_IMAGE_ASPECT_COLOR_BIT) old.value = clear.value;
      if (clear.aspects & VK_IMAGE_ASPECT_DEPTH_BIT) old.value.depthStencil.depth = clear.value.depthStencil.depth;
      if (clear.aspects & VK_IMAGE_ASPECT_STENCIL_BIT)
        old.value.depthStencil.stencil = clear.value.depthStencil.stencil;
      old.aspects |= clear.aspects;
      return;
    }
    if (old.texture != clear.texture || !Overlap(old.range, clear.range)) continue;
    LeavePass();
    FlushClears(clear.texture);
    break;
  }
  // A draw may read the texture without any new binding: let it look.
  dirty_ |= kDirtyGraphicsResources;
  ++clear.texture->pendingClears;
  clears_.push_back(std::move(clear));
}

// True if the pass that is begun has the view among its targets: then the clear is a command of that pass.
bool Context::ClearInPass(const PendingClear& clear) {
  VkClearAttachment attachment{clear.aspects, 0, clear.value};
  bool attached = static_cast<IView*>(pass_.depth) == clear.view.get();
  bool sameTexture = pass_.depth && pass_.depth->texture == clear.texture;
  for (uint32_t i = 0; i < pass_.colorCount; ++i) {
    if (!pass_.colors[i]) continue;
    sameTexture = sameTexture || pass_.colors[i]->texture == clear.texture;
    if (static_cast<IView*>(pass_.colors[i]) != clear.view.get()) continue;
    attached = true;
    attachment.colorAttachment = i;
  }
  if (!attached || clear.layers != pass_.layers) {
    if (sameTexture) LeavePass();
    return false;
  }
  const VkClearRect rect{{{0, 0}, clear.extent}, 0, clear.layers};
  vk_.vkCmdClearAttachments(cmd_, 1, &attachment, 1, &rect);
  return true;
}

bool Context::TakeClear(const IView* view, PendingClear* out) {
  for (size_t i = 0; i < clears_.size(); ++i) {
    if (clears_[i].view.get() != view) continue;
    *out = std::move(clears_[i]);
    clears_.erase(clears_.begin() + ptrdiff_t(i));
    --out->texture->pendingClears;
    return true;
  }
  return false;
}

// Runs the clears of one texture, or all. Not in a pass.
void Context::FlushClears(const Texture* only) {
  for (size_t i = 0; i < clears_.size();) {
    if (only && clears_[i].texture != only) {
      ++i;
      continue;
    }
    PendingClear clear;
    TakeClear(clears_[i].view.get(), &clear);
    RunClear(clear);
    i = 0;  // the list has changed
  }
}

void Context::RunClear(const PendingClear& clear) {
  PassInfo pass(clear.extent, clear.layers);
  const bool color = clear.aspects & VK_IMAGE_ASPECT_COLOR_BIT;
  clear.texture->Advance(clear.range, color ? kColorTarget : kDepthTarget, barriers_);
  if (color) {
    pass.colors[0] = Attachment(clear.image, kColorTarget.layout);
    SetClear(pass.colors[0], clear.value);
    pass.info.colorAttachmentCount = 1;
  } else {
    pass.SetDepth(clear.image, clear.texture->aspects, clear.aspects, clear.value);
  }
  RecordBarriers();
  vk_.vkCmdBeginRendering(cmd_, &pass.info);
  vk_.vkCmdEndRendering(cmd_);
  ++stats_.passes;
}

}  // namespace rhi_vulkan
