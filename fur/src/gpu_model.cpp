#include "gpu_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>

#include "driver_error.h"
#include "fur/fur_mesh.h"
#include "fur/groom.h"
#include "gpu_constants.h"
#include "mips.h"
#include "preset_textures.h"
#include "presets.h"
#include "volume_mips.h"

namespace fur {
namespace {

// Uploads; keeps the first failure instead of passing a Result through every helper.
class Uploader {
 public:
  Uploader(rhi::IDevice& device, const Model& model, const RenderSettings& settings)
      : device_(device), model_(model), settings_(settings), bounds_(ComputeBounds(model)) {}

  Result<GpuModel> Run() {
    GpuModel gpu;
    for (const Primitive& p : model_.primitives) gpu.geometry.push_back(Geometry(p));
    if (settings_.technique == Technique::Shells)
      for (const FurMesh& mesh : MakeFurMeshes(model_, Correct() ? FurTiling::Isometric : FurTiling::Model))
        gpu.furMeshes.push_back(UploadFurMesh(mesh));
    gpu.bounds = bounds_;
    for (uint32_t i = 0; i < model_.materials.size(); ++i) gpu.materials.push_back(MakeMaterial(i));
    for (const Part& p : model_.parts)
      gpu.parts.push_back({p.primitive, model_.primitives[p.primitive].material, p.transform,
                           glm::determinant(glm::dmat3(p.transform)) < 0, {}, {}, {}});
    if (Sorts()) PrepareSorting(&gpu);
    for (size_t i = 0; i < gpu.materials.size() && gpu.firstFur < 0; ++i)
      if (gpu.materials[i].shells > 0) gpu.firstFur = int32_t(i);
    if (failed_) return error_;
    return gpu;
  }

 private:
  using Rgb = std::array<double, 3>;
  static constexpr Rgb kWhite{1, 1, 1};

  bool Correct() const { return settings_.look == Look::Correct; }
  bool Sorted() const { return settings_.shellMode == ShellMode::Sorted; }
  bool Sorts() const {
    const bool chunks = settings_.shellMode == ShellMode::Amplified && settings_.shellsAtOnce > 1;
    return settings_.technique == Technique::Shells && (Sorted() || chunks) && settings_.drawShells;
  }
  // Technique shells has no preset: the plain one's traits change nothing.
  const PresetTraits& Traits() const { return TraitsOf(settings_.preset); }
  // The published demo takes its asset as shipped; everything else handles it as docs/accuracy.md says.
  bool AsShipped() const { return !Correct() && settings_.preset == Preset::DemoFur; }

  void Check(rhi::Status status, const std::string& what) {
    if (status == rhi::Status::Ok || failed_) return;
    failed_ = true;
    error_ = DriverError(status, "cannot upload " + what);
  }

  template <class T>
  rhi::Ref<rhi::IBuffer> Buffer(const std::vector<T>& data, rhi::Bind bind, const std::string& name, uint32_t stride = 0) {
    rhi::Ref<rhi::IBuffer> buffer;
    if (data.empty()) return buffer;
    const auto bytes = uint32_t(data.size() * sizeof(T));
    Check(device_.CreateBuffer({.byteWidth = bytes, .usage = rhi::Usage::Immutable, .bind = bind, .structureStride = stride,
                                .name = name.c_str()},
                               data.data(), &buffer),
          name);
    return buffer;
  }

  rhi::Ref<rhi::IShaderResourceView> View(const rhi::Ref<rhi::IBuffer>& buffer) {
    rhi::Ref<rhi::IShaderResourceView> view;
    if (buffer) Check(device_.CreateShaderResourceView(buffer.get(), nullptr, &view), "a view of a buffer");
    return view;
  }

  GpuFurMesh UploadFurMesh(const FurMesh& mesh) {
    using rhi::Bind;
    constexpr uint32_t kEdgeBytes = 4 * sizeof(uint32_t);
    GpuFurMesh g;
    g.vertices = Buffer(mesh.vertices, Bind::VertexBuffer | Bind::ShaderResource, "fur vertices", sizeof(FurVertex));
    g.indices = Sorted() ? Buffer(mesh.indices, Bind::ShaderResource, "fur indices", sizeof(uint32_t))
                         : Buffer(mesh.indices, Bind::IndexBuffer, "fur indices");
    if (Sorted()) g.indicesView = View(g.indices);
    g.edges = Buffer(mesh.edges, Bind::IndexBuffer | Bind::ShaderResource, "fur edges", kEdgeBytes);
    g.verticesView = View(g.vertices);
    g.edgesView = View(g.edges);
    g.indexCount = uint32_t(mesh.indices.size());
    g.edgeCount = uint32_t(mesh.edges.size() / 4);
    g.baldTriangles = mesh.baldTriangles;
    g.baldEdges = mesh.baldEdges;
    if (Sorts()) {
      g.cpuIndices = mesh.indices;
      g.order = TriangleOrder(mesh.vertices, mesh.indices);
    }
    return g;
  }

  // Each part has indices of its own: two parts of one primitive are seen from different sides.
  void PrepareSorting(GpuModel* gpu) {
    for (GpuPart& part : gpu->parts) {
      const auto bytes = uint32_t(gpu->furMeshes[part.primitive].cpuIndices.size() * sizeof(uint32_t));
      if (bytes == 0) continue;
      if (Sorted()) {
        part.order = DynamicBuffer({.byteWidth = bytes / 3, .usage = rhi::Usage::Dynamic, .bind = rhi::Bind::ShaderResource,
                                    .structureStride = sizeof(uint32_t), .name = "order of fur"});
        part.orderView = View(part.order);
      } else {
        part.sortedIndices = DynamicBuffer({.byteWidth = bytes, .usage = rhi::Usage::Dynamic,
                                            .bind = rhi::Bind::IndexBuffer, .name = "sorted fur indices"});
      }
    }
  }

  rhi::Ref<rhi::IBuffer> DynamicBuffer(const rhi::BufferDesc& desc) {
    rhi::Ref<rhi::IBuffer> buffer;
    Check(device_.CreateBuffer(desc, nullptr, &buffer), desc.name);
    return buffer;
  }

  GpuGeometry Geometry(const Primitive& p) {
    GpuGeometry g;
    const bool seed = settings_.technique == Technique::Seed;
    const std::vector<uint32_t> edges = seed ? FinIndices(p, settings_.preset) : std::vector<uint32_t>();
    g.vertices = Buffer(p.vertices, rhi::Bind::VertexBuffer, p.name + " vertices");
    g.indices = Buffer(p.indices, rhi::Bind::IndexBuffer, p.name + " indices");
    g.finIndices = Buffer(edges, rhi::Bind::IndexBuffer, p.name + " edges");
    g.indexCount = uint32_t(p.indices.size());
    g.finIndexCount = uint32_t(edges.size());
    if (settings_.skinSamples > settings_.samples && !Furred(model_.materials[p.material])) g.pieces = PieceBounds(p);
    return g;
  }

  static std::vector<float> Decoded(const std::vector<uint8_t>& texels, bool srgb) {
    std::vector<float> values(texels.size());
    for (size_t i = 0; i < texels.size(); ++i)
      values[i] = float(srgb && i % 4 != 3 ? SrgbToLinear(texels[i] / 255.0) : texels[i] / 255.0);
    return values;
  }

  rhi::Ref<rhi::IShaderResourceView> FloatTexture(const std::vector<MipChain>& mips, rhi::TextureDesc desc) {
    const bool srgb = desc.format == rhi::Format::RGBA8_UNorm_sRGB;
    desc.format = rhi::Format::RGBA32_Float;
    std::vector<std::vector<float>> levels;
    std::vector<rhi::SubresourceData> init;
    for (const MipChain& chain : mips)
      for (uint32_t level = 0; level < chain.size(); ++level) {
        levels.push_back(Decoded(chain[level], srgb));
        init.push_back({levels.back().data(), uint32_t(std::max(1u, desc.width >> level) * 4 * sizeof(float)), 0});
      }
    return ViewOfTexture(desc, init);
  }

  rhi::Ref<rhi::IShaderResourceView> ViewOfTexture(const rhi::TextureDesc& desc, const std::vector<rhi::SubresourceData>& init) {
    rhi::Ref<rhi::ITexture> texture;
    rhi::Ref<rhi::IShaderResourceView> view;
    Check(device_.CreateTexture(desc, init.data(), &texture), desc.name);
    if (texture) Check(device_.CreateShaderResourceView(texture.get(), nullptr, &view), desc.name);
    return view;
  }

  // A texture of layers with all their levels.
  rhi::Ref<rhi::IShaderResourceView> Texture(const std::vector<MipChain>& mips, uint32_t width,
                                             uint32_t height, bool array, rhi::Format format, const std::string& name) {
    const rhi::TextureDesc desc{.dim = array ? rhi::TextureDim::Tex2DArray : rhi::TextureDim::Tex2D,
                                .width = width, .height = height, .depthOrArray = uint32_t(mips.size()),
                                .mipLevels = uint32_t(mips[0].size()), .format = format,
                                .usage = rhi::Usage::Immutable, .name = name.c_str()};
    if (settings_.floatTextures) return FloatTexture(mips, desc);
    std::vector<rhi::SubresourceData> init;
    for (const auto& chain : mips)
      for (uint32_t level = 0; level < chain.size(); ++level)
        init.push_back({chain[level].data(), std::max(1u, width >> level) * 4, 0});
    return ViewOfTexture(desc, init);
  }

  rhi::Ref<rhi::IShaderResourceView> ImageTexture(const Image& image, MipFilter filter) {
    return Texture({MakeMips(image.pixels, image.width, image.height, filter)}, image.width, image.height, false,
                   filter == MipFilter::Srgb ? rhi::Format::RGBA8_UNorm_sRGB : rhi::Format::RGBA8_UNorm, image.name);
  }

  // An image of the model, uploaded once for each filter however many materials use it.
  rhi::Ref<rhi::IShaderResourceView> ModelTexture(int32_t image, MipFilter filter) {
    rhi::Ref<rhi::IShaderResourceView>& view = modelTextures_[{image, filter}];
    if (!view) view = ImageTexture(model_.images[size_t(image)], filter);
    return view;
  }

  rhi::Ref<rhi::IShaderResourceView> OneTexel(std::array<uint8_t, 4> value, const std::string& name) {
    return Texture({{{value.begin(), value.end()}}}, 1, 1, false, rhi::Format::RGBA8_UNorm, name);
  }

  // Look seed has no colour factors: they are multiplied into the texels, as the published demo would have painted them.
  static Image Tinted(Image image, const Rgb& factor) {
    if (factor == kWhite) return image;
    for (size_t i = 0; i < image.pixels.size(); ++i)
      if (i % 4 != 3) image.pixels[i] = uint8_t(std::lround(image.pixels[i] * std::clamp(factor[i % 4], 0.0, 1.0)));
    return image;
  }

  // Technique shells reads colour and length with one sample, the length map in alpha.
  rhi::Ref<rhi::IShaderResourceView> ColorAndLength(const Material& m) {
    rhi::Ref<rhi::IShaderResourceView>& view = colorsAndLengths_[{m.baseColorTexture.image, m.fur->lengthMap, TexelFactor(m)}];
    if (view) return view;
    Image color = Tinted(ColorImage(m), TexelFactor(m));
    for (size_t i = 3; i < color.pixels.size(); i += 4) color.pixels[i] = 255;
    view = ImageTexture(LengthInAlpha(color, model_, m), ColorFilter());
    return view;
  }

  // What a furred material has for its colours.
  rhi::Ref<rhi::IShaderResourceView> FurredColor(uint32_t index, const Material& m) {
    if (settings_.technique == Technique::Shells) return ColorAndLength(m);
    const PresetTraits& traits = Traits();
    if (traits.coatColors) return ImageTexture(PaintCoat(model_, index, settings_.fourCoat), MipFilter::Raw);
    if (traits.lengthInAlpha)
      return ImageTexture(LengthInAlpha(Tinted(ColorImage(m), RawFactor(m)), model_, m), MipFilter::Raw);
    return BaseColor(m);
  }

  Image ColorImage(const Material& m) const {
    const int32_t image = m.baseColorTexture.image;
    return image < 0 ? Image{"white", 1, 1, {255, 255, 255, 255}} : model_.images[size_t(image)];
  }
  static Rgb RawFactor(const Material& m) {
    return {LinearToSrgb(m.baseColor.r), LinearToSrgb(m.baseColor.g), LinearToSrgb(m.baseColor.b)};
  }
  Rgb TexelFactor(const Material& m) const { return Correct() ? kWhite : RawFactor(m); }
  MipFilter ColorFilter() const { return Correct() ? MipFilter::Srgb : MipFilter::Raw; }

  rhi::Ref<rhi::IShaderResourceView> BaseColor(const Material& m) {
    const int32_t image = m.baseColorTexture.image;
    if (image >= 0 && TexelFactor(m) == kWhite) return ModelTexture(image, ColorFilter());
    return ImageTexture(Tinted(ColorImage(m), TexelFactor(m)), ColorFilter());
  }

  rhi::Ref<rhi::ISamplerState> Sampler(bool wrapU, bool wrapV) {
    rhi::SamplerDesc desc;
    if (settings_.technique == Technique::Shells) desc.mipBias = kSurfaceMipBias;
    desc.u = wrapU ? rhi::AddressMode::Wrap : rhi::AddressMode::Clamp;
    desc.v = wrapV ? rhi::AddressMode::Wrap : rhi::AddressMode::Clamp;
    rhi::Ref<rhi::ISamplerState> sampler;
    Check(device_.CreateSamplerState(desc, &sampler), "a sampler");
    return sampler;
  }

  // The demo takes the asset as shipped; else the top slice is emptied, which the fur model asks for.
  std::vector<MipChain> VolumeMips(const FurVolume& volume, double heightFalloff) const {
    if (!AsShipped()) return MakeVolumeMips(WithoutTopSlice(volume), heightFalloff);
    const size_t texels = size_t(volume.width) * volume.height;
    std::vector<MipChain> mips;
    for (size_t layer = 0; layer < volume.layers; ++layer)
      mips.push_back(MakeMips({&volume.pixels[layer * texels * 4], texels * 4}, volume.width, volume.height,
                              MipFilter::Raw));
    return mips;
  }

  // A volume or its tint: the levels of all slices, and what was uploaded of them, by the number of slices.
  struct SharedSlices {
    std::vector<MipChain> slices;
    std::map<uint32_t, rhi::Ref<rhi::IShaderResourceView>> views;
  };

  // All slices, or fewer, as `fewer` makes them of all.
  template <class Fewer>
  rhi::Ref<rhi::IShaderResourceView> UploadSlices(SharedSlices* shared, const FurVolume& volume, uint32_t count,
                                                  const std::string& name, Fewer fewer) {
    rhi::Ref<rhi::IShaderResourceView>& view = shared->views[count];
    if (!view)
      view = Texture(count < volume.layers ? fewer(shared->slices) : shared->slices, volume.width, volume.height, true,
                     rhi::Format::RGBA8_UNorm, name);
    return view;
  }

  // Fewer shells than slices have slices of their own, one to read instead of two; fins read all heights.
  void AddVolume(int32_t index, const FurVolume& volume, const FurParams& p, double falloff, GpuMaterial* gpu) {
    SharedSlices& shared = furVolumes_[{index, p.thickness, falloff}];
    if (shared.slices.empty()) shared.slices = VolumeMips(volume, falloff);
    const auto upload = [&](uint32_t count) {
      return UploadSlices(&shared, volume, count, volume.name,
                          [&](const auto& slices) { return VolumeAtShells(slices, count, falloff); });
    };
    gpu->furVolume = upload(volume.layers);
    gpu->shellVolume = settings_.technique == Technique::Shells ? upload(std::min(gpu->shells, volume.layers)) : gpu->furVolume;
  }

  // Strands' own colours belong to look correct: no published system has them.
  void AddTint(int32_t index, const FurVolume& volume, const FurParams& p, GpuMaterial* gpu) {
    gpu->tinted = settings_.technique == Technique::Shells && Correct() && p.tint > 0 && !volume.tint.empty();
    if (!gpu->tinted) return;
    SharedSlices& shared = furTints_[{index, p.thickness}];
    if (shared.slices.empty()) shared.slices = MakeTintMips(WithoutTopSlice(volume));
    const auto upload = [&](uint32_t count) {
      return UploadSlices(&shared, volume, count, volume.name + " tint",
                          [&](const auto& slices) { return SlicesAtShells(slices, count); });
    };
    gpu->furTint = upload(volume.layers);
    gpu->shellTint = upload(std::min(gpu->shells, volume.layers));
  }

  MaterialConstants SurfaceConstants(const Material& m) const {
    MaterialConstants c{};
    const bool mapped = m.specularTexture.image >= 0;
    // Without a specular map a rough surface shines little: half of what is not rough.
    const glm::vec3 gloss = m.specularColor * (mapped ? 1.0f : 0.5f * (1 - m.roughness));
    // Look correct: Blinn-Phong power of a roughness r, 2 / r^4 - 2. Look seed: the demo's 10.
    const float power = Correct() ? std::clamp(2 / std::pow(std::max(m.roughness, 0.05f), 4.0f) - 2, 2.0f, 256.0f) : 10.0f;
    c.baseColor = Correct() ? m.baseColor : glm::vec4(1);
    c.specular = glm::vec4(gloss, power);
    c.surface = {m.normalScale, m.normalTexture.image >= 0 ? 1 : 0, 0, 0};
    return c;
  }

  // Shells of a preset that asks for it are a thousandth of the model's diameter apart, in the material's units: those
  // of the first part that wears it.
  double FurLength(uint32_t material, const FurParams& p, uint32_t shells) const {
    if (settings_.spacing > 0) return settings_.spacing * shells;
    if (!Traits().spacingOfDiameter) return p.length * Traits().lengthShare;
    double unit = 1;
    for (size_t i = model_.parts.size(); i-- > 0;)
      if (model_.primitives[model_.parts[i].primitive].material == material)
        unit = std::cbrt(std::abs(glm::determinant(glm::dmat3(model_.parts[i].transform))));
    return bounds_.Diameter() / 1000 * shells / (unit > 0 ? unit : 1);
  }

  bool InVolume() const { return settings_.technique == Technique::Shells && settings_.semantics == Semantics::Volume; }
  double FinOpacity() const { return settings_.finOpacity.value_or(InVolume() ? 1 : 0.9); }

  // Below it shells leave the way through the fur to fins, or, alone, carry the most that a slab can have: docs/accuracy.md.
  double LeastCosine(uint32_t shells) const {
    const bool fins = InVolume() && settings_.drawFins && FinOpacity() > 0;
    return (fins ? 0.5 : 0.25) / std::sqrt(double(shells));
  }

  // The groom belongs to technique shells; a preset knows the comb.
  FurParams Groomed(const FurParams& params) const {
    FurParams p = params;
    if (settings_.comb) {
      p.comb = *settings_.comb;
      p.combStrength = glm::length(p.comb);
    }
    if (settings_.bend) p.bend = *settings_.bend;
    if (settings_.technique != Technique::Shells) return PlainWithComb(p);
    if (p.windLength == 0) p.windLength = std::max(bounds_.Diameter() / 2, 1e-30);
    p.specularScale = WetSpecularScale(p.specularScale, p.wetness);
    p.specularPower = WetSpecularPower(p.specularPower, p.wetness);
    return p;
  }

  static FurParams PlainWithComb(FurParams p) {
    const FurParams plain;
    p.density = plain.density;
    p.thickness = plain.thickness;
    p.gravity = plain.gravity;
    p.rootColor = plain.rootColor;
    p.tipColor = plain.tipColor;
    p.colorFromBase = plain.colorFromBase;
    p.clumping = plain.clumping;
    p.wetness = plain.wetness;
    p.windStrength = plain.windStrength;
    return p;
  }

  static void AddGroom(const FurParams& p, GpuMaterial* gpu, MaterialConstants* c) {
    gpu->groom = p;
    gpu->groomed = IsGroomed(p);
    gpu->sways = MakeFurSway(p, glm::dmat4(1), glm::dmat4(1), 0, glm::dvec3(0)).Varies();
    gpu->wet = p.wetness > 0;
    c->groom = {float(p.density), float(WetClumping(p.clumping, p.wetness)), float(p.colorFromBase),
                float(WetDarkening(p.wetness))};
    c->rootColor = glm::vec4(p.rootColor, 0);
    c->tipColor = glm::vec4(p.tipColor, 0);
  }

  void AddFur(uint32_t index, const Material& m, GpuMaterial* gpu, MaterialConstants* c) {
    const MaterialFur& fur = *m.fur;
    const FurParams p = Groomed(fur.params);
    const FurVolume& thin = model_.volumes[size_t(fur.volume)];
    const FurVolume thick = p.thickness == 1 ? FurVolume{} : Thickened(thin, p.thickness);
    const FurVolume& volume = p.thickness == 1 ? thin : thick;
    gpu->shells = ShellCount(settings_, p.shells, volume.layers);
    if (settings_.technique == Technique::Seed)
      gpu->lengthMap = fur.lengthMap < 0 ? OneTexel({255, 255, 255, 255}, "full length")
                                         : ModelTexture(fur.lengthMap, MipFilter::Raw);
    // The demo's shells lose coverage with height whatever the volume holds.
    const double falloff = AsShipped() ? 1 : p.heightFalloff;
    const double length = gpu->length = WetLength(FurLength(index, p, gpu->shells), p.wetness);
    AddVolume(fur.volume, volume, p, falloff, gpu);
    AddTint(fur.volume, volume, p, gpu);
    c->furShape = {float(length), float(p.layerUvScale), float(volume.layers), float(gpu->shells)};
    c->furLight = {float(p.selfShadow), float(p.specularPower), float(p.specularScale), float(falloff)};
    // The longest way through one shell's slab, and the published slabs that one shell stands for: docs/accuracy.md.
    c->furSemantics = {float(LeastCosine(gpu->shells)), float(volume.layers) / float(gpu->shells),
                       float(length / gpu->shells), float(p.tint)};
    c->fin = {float(settings_.finThreshold), float(FinOpacity()), float(settings_.finDeadZone), 0};
    gpu->betweenSlices = gpu->shells > volume.layers;
    AddGroom(p, gpu, c);
    AddPreset(m, volume, gpu, c);
  }

  void AddPreset(const Material& m, const FurVolume& volume, GpuMaterial* gpu, MaterialConstants* c) {
    const PresetTraits& traits = Traits();
    const auto& light = traits.furLight;
    if (light[0] > 0) c->furLight = {light[0], light[1], light[2], c->furLight.w};
    if (traits.opacityMap) gpu->opacityMap = ImageTexture(OpacityMap(WithoutTopSlice(volume)), MipFilter::Raw);
    if (traits.finMap) gpu->finMap = ImageTexture(FinMap(WithoutTopSlice(volume)), MipFilter::Raw);
    if (!traits.spots) return;
    const Image color = Tinted(ColorImage(m), RawFactor(m));
    gpu->spots = ImageTexture(FurlessSpots(color, model_, m), MipFilter::Raw);
  }

  static bool Furred(const Material& m) { return m.fur && m.fur->params.enabled; }

  GpuMaterial MakeMaterial(uint32_t index) {
    const Material& m = model_.materials[index];
    const bool furred = Furred(m);
    GpuMaterial gpu;
    gpu.baseColor = furred ? FurredColor(index, m) : BaseColor(m);
    gpu.normal = m.normalTexture.image < 0 ? OneTexel({128, 128, 255, 255}, "flat normal")
                                           : ModelTexture(m.normalTexture.image, MipFilter::Raw);
    gpu.specular = m.specularTexture.image < 0
                       ? OneTexel({255, 255, 255, 255}, "white")
                       : ModelTexture(m.specularTexture.image, Correct() ? MipFilter::Srgb : MipFilter::Raw);
    gpu.surfaceSampler = Sampler(m.baseColorTexture.wrapU, m.baseColorTexture.wrapV);
    gpu.doubleSided = m.doubleSided;
    MaterialConstants constants = SurfaceConstants(m);
    if (furred) AddFur(index, m, &gpu, &constants);
    gpu.constants = Constants(constants, m.name + " constants");
    return gpu;
  }

  rhi::Ref<rhi::IBuffer> Constants(const MaterialConstants& c, const std::string& name) {
    return Buffer(std::vector<MaterialConstants>{c}, rhi::Bind::ConstantBuffer, name);
  }

  rhi::IDevice& device_;
  const Model& model_;
  const RenderSettings& settings_;
  const Bounds bounds_;
  std::map<std::pair<int32_t, MipFilter>, rhi::Ref<rhi::IShaderResourceView>> modelTextures_;
  // By the images of colour and length, and the factor in the texels.
  std::map<std::tuple<int32_t, int32_t, Rgb>, rhi::Ref<rhi::IShaderResourceView>> colorsAndLengths_;
  // However many materials wear it: mips of volumes are the dearest thing made here. By volume, thickness, height falloff.
  std::map<std::tuple<int32_t, double, double>, SharedSlices> furVolumes_;
  std::map<std::pair<int32_t, double>, SharedSlices> furTints_;  // by volume and thickness, whose coverage weighs
  bool failed_ = false;
  Error error_;
};

}  // namespace

Result<GpuModel> UploadModel(rhi::IDevice& device, const Model& model, const RenderSettings& settings) {
  return Uploader(device, model, settings).Run();
}

}  // namespace fur
