#include "reflect.h"

#include <algorithm>

#include "check_layout.h"
#include "error.h"

namespace shaderc {
namespace {

using spirv_cross::SPIRType;

// GL's and Direct3D's limit: scalars that one geometry shader invocation may emit.
constexpr uint32_t kMaxGsScalars = 1024;

struct Range {
  char letter;
  uint32_t first, count;  // Vulkan bindings
};
constexpr Range kB{'b', 0, rhi::kMaxConstantBuffers}, kT{'t', rhi::kVkTextureBinding, rhi::kMaxShaderResources},
    kS{'s', rhi::kVkSamplerBinding, rhi::kMaxSamplers}, kU{'u', rhi::kVkUavBinding, rhi::kMaxUnorderedAccess};

class Reflector {
 public:
  Reflector(const spirv_cross::Compiler& c, rhi::Stage stage) : c_(c), stage_(stage), all_(c.get_shader_resources()) {}

  Reflection Run() {
    RefuseOthers();
    for (const auto& r : all_.uniform_buffers) AddConstantBuffer(r);
    for (const auto& r : all_.separate_images) AddTexture(r);
    for (const auto& r : all_.storage_buffers) AddBuffer(r);
    for (const auto& r : all_.storage_images) AddImage(r);
    for (const auto& r : all_.separate_samplers) out_.samplers.push_back({Slot(r, kS), Name(r), r.id});
    Sort();
    AddStage();
    return std::move(out_);
  }

 private:
  std::string Name(const spirv_cross::Resource& r) const {
    const std::string& name = c_.get_name(r.id);
    return name.empty() ? c_.get_name(r.base_type_id) : name;
  }

  void RefuseOthers() const {
    if (!all_.sampled_images.empty())
      throw CompileError("'" + Name(all_.sampled_images[0]) +
                         "' is a texture and sampler in one; declare a Texture2D and a SamplerState");
    if (!all_.subpass_inputs.empty() || !all_.push_constant_buffers.empty() || !all_.atomic_counters.empty())
      throw CompileError("subpass inputs, push constants and counters are not supported");
  }

  uint8_t Slot(const spirv_cross::Resource& r, const Range& range) const {
    const std::string name = Name(r);
    if (name == "$Global")
      throw CompileError("a global variable is outside every cbuffer; move it into one, or make it static const");
    if (!c_.get_type(r.type_id).array.empty())
      throw CompileError("'" + name + "' is an array of resources; declare each by itself");
    if (!c_.has_decoration(r.id, spv::DecorationBinding))
      throw CompileError("'" + name + "' has no register; write ': register(" + range.letter + "N)'");
    if (c_.get_decoration(r.id, spv::DecorationDescriptorSet) != 0)
      throw CompileError("'" + name + "' names a space or a set; they are given by the stage");
    const uint32_t binding = c_.get_decoration(r.id, spv::DecorationBinding);
    if (binding < range.first || binding - range.first >= range.count)
      throw CompileError("'" + name + "' is not in " + range.letter + "0.." + range.letter +
                         std::to_string(range.count - 1));
    return uint8_t(binding - range.first);
  }

  void AddConstantBuffer(const spirv_cross::Resource& r) {
    const uint8_t slot = Slot(r, kB);
    const SPIRType& type = c_.get_type(r.base_type_id);
    CheckConstantBuffer(c_, type, Name(r));
    const uint32_t bytes = (uint32_t(c_.get_declared_struct_size(type)) + 15) / 16 * 16;
    if (bytes > rhi::kMaxConstantBufferBytes)
      throw CompileError("cbuffer '" + Name(r) + "' has " + std::to_string(bytes) + " bytes; at most " +
                         std::to_string(rhi::kMaxConstantBufferBytes));
    out_.constantBuffers.push_back({slot, bytes, Name(r), r.id});
  }

  rhi::TextureDim Dim(const SPIRType& type, const std::string& name) const {
    const auto& image = type.image;
    if (image.dim == spv::Dim2D && !image.arrayed) return image.ms ? rhi::TextureDim::Tex2DMS : rhi::TextureDim::Tex2D;
    if (image.dim == spv::Dim2D && !image.ms) return rhi::TextureDim::Tex2DArray;
    if (image.dim == spv::DimCube && !image.arrayed) return rhi::TextureDim::TexCube;
    if (image.dim == spv::Dim3D) return rhi::TextureDim::Tex3D;
    throw CompileError("'" + name +
                       "' is of a kind that the RHI lacks; it has Texture2D, Texture2DArray, TextureCube, "
                       "Texture3D, Texture2DMS and structured buffers");
  }

  bool IsInteger(const SPIRType& type) const {
    const SPIRType& scalar = c_.get_type(type.image.type);
    return scalar.basetype == SPIRType::Int || scalar.basetype == SPIRType::UInt;
  }

  void AddTexture(const spirv_cross::Resource& r) {
    const SPIRType& type = c_.get_type(r.base_type_id);
    out_.resources.push_back(
        {rhi::ShaderResourceKind::Texture, Slot(r, kT), Dim(type, Name(r)), IsInteger(type), 0, Name(r), r.id});
  }

  void RequireCompute(const std::string& name) const {
    if (stage_ != rhi::Stage::Compute)
      throw CompileError("'" + name + "' is a u register; only compute shaders have them");
  }

  void AddImage(const spirv_cross::Resource& r) {
    RequireCompute(Name(r));
    const SPIRType& type = c_.get_type(r.base_type_id);
    out_.resources.push_back(
        {rhi::ShaderResourceKind::RWTexture, Slot(r, kU), Dim(type, Name(r)), IsInteger(type), 0, Name(r), r.id});
  }

  void AddBuffer(const spirv_cross::Resource& r) {
    const SPIRType& block = c_.get_type(r.base_type_id);
    const bool readOnly = c_.get_buffer_block_flags(r.id).get(spv::DecorationNonWritable);
    const uint32_t stride = c_.type_struct_member_array_stride(block, 0);
    CheckElement(c_, c_.get_type(c_.get_type(block.member_types[0]).parent_type), stride, Name(r));
    if (!readOnly) RequireCompute(Name(r));
    out_.resources.push_back(
        {readOnly ? rhi::ShaderResourceKind::StructuredBuffer : rhi::ShaderResourceKind::RWStructuredBuffer,
         Slot(r, readOnly ? kT : kU), rhi::TextureDim::Tex2D, false, stride, Name(r), r.id});
  }

  void Sort() {
    const auto bySlot = [](const auto& a, const auto& b) { return a.slot < b.slot; };
    std::sort(out_.constantBuffers.begin(), out_.constantBuffers.end(), bySlot);
    std::sort(out_.samplers.begin(), out_.samplers.end(), bySlot);
    std::sort(out_.resources.begin(), out_.resources.end(), [](const Resource& a, const Resource& b) {
      const auto isU = [](const Resource& r) { return r.kind >= rhi::ShaderResourceKind::RWTexture; };
      return isU(a) != isU(b) ? isU(b) : a.slot < b.slot;
    });
    RefuseSharedSlots(out_.constantBuffers, 'b');
    RefuseSharedSlots(out_.samplers, 's');
    for (size_t i = 1; i < out_.resources.size(); ++i) {
      const Resource &a = out_.resources[i - 1], &b = out_.resources[i];
      const bool sameLetter =
          (a.kind >= rhi::ShaderResourceKind::RWTexture) == (b.kind >= rhi::ShaderResourceKind::RWTexture);
      if (sameLetter && a.slot == b.slot) throw CompileError("'" + a.name + "' and '" + b.name + "' share a register");
    }
  }

  template <class List>
  static void RefuseSharedSlots(const List& list, char letter) {
    for (size_t i = 1; i < list.size(); ++i)
      if (list[i - 1].slot == list[i].slot)
        throw CompileError("'" + list[i - 1].name + "' and '" + list[i].name + "' share register " + letter +
                           std::to_string(list[i].slot));
  }

  void AddStage() {
    if (stage_ == rhi::Stage::Geometry) AddGeometry();
    if (stage_ == rhi::Stage::Compute)
      for (uint32_t i = 0; i < 3; ++i)
        out_.groupSize[i] = c_.get_execution_mode_argument(spv::ExecutionModeLocalSize, i);
  }

  void AddGeometry() {
    constexpr std::pair<spv::ExecutionMode, rhi::PrimitiveTopology> kInputs[] = {
        {spv::ExecutionModeInputPoints, rhi::PrimitiveTopology::PointList},
        {spv::ExecutionModeInputLines, rhi::PrimitiveTopology::LineList},
        {spv::ExecutionModeInputLinesAdjacency, rhi::PrimitiveTopology::LineListAdj},
        {spv::ExecutionModeTriangles, rhi::PrimitiveTopology::TriangleList},
        {spv::ExecutionModeInputTrianglesAdjacency, rhi::PrimitiveTopology::TriangleListAdj}};
    for (const auto& [mode, topology] : kInputs)
      if (c_.get_execution_mode_bitset().get(mode)) out_.gsInput = topology;
    out_.gsMaxVertices = c_.get_execution_mode_argument(spv::ExecutionModeOutputVertices);
    for (const auto& r : all_.stage_outputs) out_.gsOutputComponents += Scalars(c_.get_type(r.base_type_id));
    for (const auto& r : all_.builtin_outputs) AddGsBuiltIn(r);
    if (out_.gsMaxVertices * out_.gsOutputComponents > kMaxGsScalars)
      throw CompileError("the geometry shader can emit " + std::to_string(out_.gsMaxVertices) + " vertices of " +
                         std::to_string(out_.gsOutputComponents) + " scalars; vertices x scalars is at most " +
                         std::to_string(kMaxGsScalars));
  }

  void AddGsBuiltIn(const spirv_cross::BuiltInResource& r) {
    out_.gsOutputComponents += Scalars(c_.get_type(r.value_type_id));
    if (r.builtin == spv::BuiltInLayer) out_.writesLayer = true;
  }

  static uint32_t Scalars(const SPIRType& type) {
    uint32_t n = type.vecsize * type.columns;
    for (const uint32_t count : type.array) n *= count;
    return n;
  }

  const spirv_cross::Compiler& c_;
  rhi::Stage stage_;
  spirv_cross::ShaderResources all_;
  Reflection out_;
};

}  // namespace

Reflection Reflect(const spirv_cross::Compiler& compiler, rhi::Stage stage) { return Reflector(compiler, stage).Run(); }

}  // namespace shaderc
