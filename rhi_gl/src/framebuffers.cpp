#include "framebuffers.h"

#include "core.h"
#include "resources.h"

namespace rhi_gl {
namespace {

GLenum AttachmentPoint(Format format, uint32_t colorIndex) {
  const FormatInfo& info = GetFormatInfo(format);
  if (!info.depth) return GL_COLOR_ATTACHMENT0 + colorIndex;
  return info.stencil ? GL_DEPTH_STENCIL_ATTACHMENT : GL_DEPTH_ATTACHMENT;
}

const TextureDesc& TextureOf(const ViewData& v) { return v.texture->Desc(); }

Attachment AttachmentOf(const ViewData& v) { return {v.name, v.target, v.desc.format, v.level, v.layer, v.layered}; }

// What all targets of one framebuffer must have in common.
struct Extent {
  uint32_t width, height, samples, layers;
  bool operator==(const Extent&) const = default;
};

Extent ExtentOf(const ViewData& v) {
  const TextureDesc& t = TextureOf(v);
  const backend::MipLayout m = backend::GetMipLayout(t, v.desc.firstMip);
  return {m.width, m.height, t.sampleCount, t.dim == TextureDim::Tex3D ? m.depth : v.desc.sliceCount};
}

std::string Describe(const Extent& e) {
  return std::to_string(e.width) + " x " + std::to_string(e.height) + ", " + std::to_string(e.layers) + " slices, " +
         std::to_string(e.samples) + " samples";
}

void SetDrawBuffers(GLuint framebuffer, const TargetSet& set) {
  std::array<GLenum, kMaxRenderTargets> buffers{};
  for (uint32_t i = 0; i < set.colorCount; ++i) buffers[i] = set.colors[i] ? GL_COLOR_ATTACHMENT0 + i : GLenum(GL_NONE);
  if (set.colorCount == 0) {
    glNamedFramebufferDrawBuffer(framebuffer, GL_NONE);
  } else {
    glNamedFramebufferDrawBuffers(framebuffer, GLsizei(set.colorCount), buffers.data());
  }
}

}  // namespace

size_t FramebufferCache::Hash::operator()(const Key& key) const {
  uint64_t hash = 14695981039346656037u;  // FNV-1a, a word at a time
  for (uint32_t uid : key) hash = (hash ^ uid) * 1099511628211u;
  return size_t(hash);
}

const Framebuffer& FramebufferCache::Get(const TargetSet& set) {
  Key key{};
  for (uint32_t i = 0; i < set.colorCount; ++i) key[i] = set.colors[i] ? set.colors[i]->uid : 0;
  key.back() = set.depth ? set.depth->uid : 0;
  const auto found = made_.find(key);
  if (found != made_.end()) return found->second;
  return made_.emplace(key, Make(set)).first->second;
}

void FramebufferCache::Forget(uint32_t viewUid) {
  std::erase_if(made_, [&](const auto& entry) {
    const auto& [key, framebuffer] = entry;
    if (std::find(key.begin(), key.end(), viewUid) == key.end()) return false;
    core_.Discard(NameKind::Framebuffer, framebuffer.name);
    return true;
  });
}

bool FramebufferCache::TargetsAgree(const TargetSet& set, Framebuffer* fb) const {
  const ViewData* first = set.depth;
  const auto agree = [&](const ViewData* v) {
    if (!v) return true;
    if (!first) first = v;
    if (ExtentOf(*v) == ExtentOf(*first)) return true;
    fb->problem = MsgCode::TargetsDiffer;
    fb->explanation = "the targets differ: " + Describe(ExtentOf(*first)) + " and " + Describe(ExtentOf(*v)) +
                      "; bind targets of one size, slice count and sample count";
    return false;
  };
  if (!std::all_of(set.colors.begin(), set.colors.begin() + set.colorCount, agree)) return false;
  if (first) {
    fb->samples = TextureOf(*first).sampleCount;
    return true;
  }
  fb->problem = MsgCode::NoTarget;
  fb->explanation = "no target is bound; call OMSetRenderTargets";
  return false;
}

Framebuffer FramebufferCache::Make(const TargetSet& set) {
  Framebuffer fb;
  fb.uid = core_.NewUid();
  if (!TargetsAgree(set, &fb)) return fb;
  glCreateFramebuffers(1, &fb.name);
  for (uint32_t i = 0; i < set.colorCount; ++i)
    if (set.colors[i]) Attach(fb.name, i, AttachmentOf(*set.colors[i]));
  if (set.depth) {
    const Attachment depth = AttachmentOf(*set.depth);
    Attach(fb.name, 0, depth);
    fb.floatDepth = rhi::GetFormatInfo(depth.format).isFloat;
  }
  SetDrawBuffers(fb.name, set);
  const GLenum status = glCheckNamedFramebufferStatus(fb.name, GL_DRAW_FRAMEBUFFER);
  if (status == GL_FRAMEBUFFER_COMPLETE) return fb;
  fb.problem = MsgCode::TargetsDiffer;
  fb.explanation = "GL cannot draw to this set of targets (framebuffer status " + std::to_string(status) + ")";
  return fb;
}

void Attach(GLuint framebuffer, uint32_t colorIndex, const Attachment& a) {
  const GLenum point = AttachmentPoint(a.format, colorIndex);
  const bool slices = a.target != GL_TEXTURE_2D && a.target != GL_TEXTURE_2D_MULTISAMPLE;
  if (slices && !a.layered) {
    glNamedFramebufferTextureLayer(framebuffer, point, a.texture, GLint(a.level), GLint(a.layer));
  } else {
    glNamedFramebufferTexture(framebuffer, point, a.texture, GLint(a.level));
  }
}

BlitPair::BlitPair() {
  glCreateFramebuffers(1, &read_);
  glCreateFramebuffers(1, &draw_);
}

BlitPair::~BlitPair() {
  glDeleteFramebuffers(1, &read_);
  glDeleteFramebuffers(1, &draw_);
}

void BlitPair::Blit(const Attachment& from, uint32_t fromWidth, uint32_t fromHeight, const Attachment& to,
                    uint32_t toWidth, uint32_t toHeight, GLenum filter) {
  Attach(read_, 0, from);
  Attach(draw_, 0, to);
  glBlitNamedFramebuffer(read_, draw_, 0, 0, GLint(fromWidth), GLint(fromHeight), 0, 0, GLint(toWidth), GLint(toHeight),
                         GL_COLOR_BUFFER_BIT, filter);
}

}  // namespace rhi_gl
