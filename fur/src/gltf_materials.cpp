// Materials and their pictures.
#include <cmath>

#include "fur/image_io.h"
#include "gltf_internal.h"

namespace fur::gltf {
namespace {

class MaterialReader {
 public:
  MaterialReader(Document& doc, Model* model) : doc_(doc), model_(model), imageOf_(doc.model.images.size(), -1) {}

  void ReadAll() {
    for (size_t i = 0; i < doc_.model.materials.size(); ++i) model_->materials.push_back(Read(i));
  }

 private:
  Document& doc_;
  Model* model_;
  std::vector<int32_t> imageOf_;  // index into Model::images for each glTF image that is used

  Material Read(size_t index) {
    const tinygltf::Material& m = doc_.model.materials[index];
    const tinygltf::PbrMetallicRoughness& pbr = m.pbrMetallicRoughness;
    Material out;
    out.name = m.name.empty() ? Text("material ", index) : OneLine(m.name);
    for (int c = 0; c < 4; ++c) out.baseColor[c] = static_cast<float>(pbr.baseColorFactor[static_cast<size_t>(c)]);
    out.baseColorTexture = Texture(pbr.baseColorTexture, out.name);
    out.normalTexture = Texture(m.normalTexture, out.name);
    out.normalScale = static_cast<float>(m.normalTexture.scale);
    out.roughness = static_cast<float>(pbr.roughnessFactor);
    out.metallic = static_cast<float>(pbr.metallicFactor);
    out.doubleSided = m.doubleSided;
    ReadSpecular(index, &out);
    return out;
  }

  // From the JSON, whose types CheckSchema has seen.
  void ReadSpecular(size_t index, Material* out) {
    const Json& material = doc_.json["materials"][index];
    const Json::json_pointer path("/extensions/KHR_materials_specular");
    if (!material.contains(path)) return;
    const Json& specular = material[path];
    if (specular.contains("specularColorFactor"))
      for (int c = 0; c < 3; ++c) out->specularColor[c] = specular["specularColorFactor"][static_cast<size_t>(c)];
    if (!specular.contains("specularColorTexture")) return;
    tinygltf::TextureInfo info;
    info.index = specular["specularColorTexture"]["index"];
    info.texCoord = specular["specularColorTexture"].value("texCoord", 0);
    out->specularTexture = Texture(info, out->name);
  }

  template <class Info>
  TextureRef Texture(const Info& info, const std::string& material) {
    if (info.index < 0) return {};
    if (info.texCoord != 0)
      doc_.Warn("material \"", material, "\": a texture asks for TEXCOORD_", info.texCoord, "; TEXCOORD_0 is used");
    if (info.extensions.count("KHR_texture_transform") != 0)
      doc_.Warn("material \"", material, "\": KHR_texture_transform is ignored");
    const tinygltf::Texture& texture = doc_.model.textures[info.index];
    if (texture.source < 0) {
      doc_.Warn("material \"", material, "\": textures[", info.index, "] has no PNG or JPEG image; it is left out");
      return {};
    }
    TextureRef ref{ImageIndex(texture.source), true, true};
    if (texture.sampler >= 0) {
      ref.wrapU = Wraps(texture.sampler, doc_.model.samplers[texture.sampler].wrapS);
      ref.wrapV = Wraps(texture.sampler, doc_.model.samplers[texture.sampler].wrapT);
    }
    return ref;
  }

  bool Wraps(int sampler, int mode) {
    if (mode == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT)
      doc_.Warn("samplers[", sampler, "]: mirrored repeat is read as plain repeat");
    else if (mode != TINYGLTF_TEXTURE_WRAP_REPEAT && mode != TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE)
      doc_.Malformed("samplers[", sampler, "] has wrap mode ", mode, ", which is none of glTF's");
    return mode != TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE;
  }

  // Decodes a picture at its first use.
  int32_t ImageIndex(int index) {
    int32_t& slot = imageOf_[static_cast<size_t>(index)];
    if (slot >= 0) return slot;
    const tinygltf::Image& image = doc_.model.images[index];
    const std::string label = !image.name.empty() ? image.name : !image.uri.empty() ? image.uri : Text("image ", index);
    const std::string where = Text(doc_.file.string(), ": images[", index, "] ", image.uri);
    if (image.image.empty() && image.bufferView < 0)
      throw LoadFailure(ErrorCode::InputMissing,
                        Text(where, ": no such file in ", doc_.file.parent_path().string(), ", or not readable"));
    Result<Image> decoded = ReadImageFromMemory(Bytes(image), OneLine(label), where);
    if (!decoded) throw LoadFailure(decoded.error().code, decoded.error().message);
    model_->images.push_back(std::move(*decoded));
    return slot = static_cast<int32_t>(model_->images.size() - 1);
  }

  std::span<const uint8_t> Bytes(const tinygltf::Image& image) const {
    if (image.bufferView < 0) return image.image;
    const tinygltf::BufferView& view = doc_.model.bufferViews[image.bufferView];
    const std::vector<unsigned char>& data = doc_.model.buffers[view.buffer].data;
    if (view.byteOffset + view.byteLength > data.size())
      doc_.Malformed("bufferViews[", image.bufferView, "] of an image is out of its buffer's range");
    return std::span(data).subspan(view.byteOffset, view.byteLength);
  }
};

}  // namespace

void ReadMaterials(Document& doc, Model* model) {
  MaterialReader(doc, model).ReadAll();
  for (const Primitive& primitive : model->primitives) {
    if (primitive.material < model->materials.size()) continue;
    model->materials.push_back({});
    model->materials.back().name = "default";
    model->materials.back().metallic = 1;  // glTF's default
  }
}

}  // namespace fur::gltf
