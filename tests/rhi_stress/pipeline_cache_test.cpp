// The pipeline cache's blob: a device made with it draws the same, and one that is damaged or foreign never reaches the
// driver. No driver at hand saves anything (lavapipe and SwiftShader give a bare header), so the layer pretends to.
#include "lost_layer.h"
#include "rhi_vulkan/rhi_vulkan.h"
#include "rig.h"

namespace rhi_stress {
namespace {

using namespace rhi;
using Blob = std::vector<uint8_t>;

class PipelineCacheTest : public testing::Test {
 protected:
  void SetUp() override { TheLostLayer().saveCaches(true); }
  void TearDown() override {
    TheLostLayer().pass();
    TheLostLayer().saveCaches(false);
    sink.Verify();
  }
  Ref<IDevice> Make(const Blob* blob, bool validation = false) {
    DeviceDesc desc;
    desc.preferSoftware = true;
    desc.apiValidation = validation;
    desc.sink = &sink;
    desc.pipelineCache = blob ? blob->data() : nullptr;
    desc.pipelineCacheSize = blob ? blob->size() : 0;
    Ref<IDevice> device;
    EXPECT_EQ(rhi_vulkan::CreateDevice(desc, &device), Status::Ok) << sink.Dump();
    return device;
  }
  static Blob Save(IDevice& device) {
    Blob blob(device.GetPipelineCacheBlob(nullptr, 0));
    EXPECT_EQ(device.GetPipelineCacheBlob(blob.data(), blob.size()), blob.size());
    return blob;
  }
  void ExpectRefused(const Blob& blob, const char* why) {
    const int before = sink.Count(MsgCode::PipelineCacheRefused);
    EXPECT_TRUE(Make(&blob)) << why;
    EXPECT_EQ(sink.Count(MsgCode::PipelineCacheRefused), before + 1) << why;
    EXPECT_NE(sink.LastText(MsgCode::PipelineCacheRefused).find(why), std::string::npos) << sink.Dump();
  }
  static Image Picture(Rig& rig) {
    const Target target = rig.MakeTarget(16, 1);
    rig.context->ClearRenderTargetView(target.view.get(), Rgba32F{0.1f, 0.2f, 0.3f, 1}.data());
    rig.SetTarget(target);
    rig.SetConstants(rig.Constants().get(), {.tint = {0.9f, 0.4f, 0.7f, 1}, .rectangle = {-0.8f, 0.9f, 0.3f, -0.4f}});
    rig.DrawRect(rig.Shader(stress_shaders::stress_VSRect).get(), rig.Shader(stress_shaders::stress_PSTinted).get());
    return rig.Read(target.texture.get());
  }
  TestSink sink;
};

TEST_F(PipelineCacheTest, WarmEqualsCold) {
  Rig cold(Make(nullptr, true));
  ASSERT_TRUE(cold.device->GetCaps().pipelineCacheBlob);
  const Image expected = Picture(cold);
  const Blob blob = Save(*cold.device);
  EXPECT_GT(blob.size(), 32u);
  uint8_t small = 77;
  EXPECT_EQ(cold.device->GetPipelineCacheBlob(&small, 1), blob.size());
  EXPECT_EQ(small, 77) << "no room, nothing written";
  EXPECT_EQ(TheLostLayer().warmCaches(), 0u);
  Rig warm(Make(&blob, true));
  EXPECT_EQ(TheLostLayer().warmCaches(), 1u) << "the driver was not given what it saved";
  EXPECT_TRUE(SameImage(Picture(warm), expected));
  EXPECT_EQ(Save(*warm.device), blob);
}

TEST_F(PipelineCacheTest, DamagedBlobsStayAway) {
  sink.Expect(MsgCode::PipelineCacheRefused, "the blob is damaged");
  const Blob blob = Save(*Make(nullptr));
  for (size_t i = 0; i < blob.size(); i += 3) {
    Blob damaged = blob;
    damaged[i] ^= uint8_t(1u << i % 8);
    ExpectRefused(damaged, i < 8 ? "GetPipelineCacheBlob" : "damaged");
  }
  for (size_t bytes = 1; bytes < blob.size(); bytes += 5)
    ExpectRefused(Blob(blob.begin(), blob.begin() + ptrdiff_t(bytes)), bytes < 56 ? "too short" : "damaged");
  Blob longer = blob;
  longer.push_back(0);
  ExpectRefused(longer, "damaged");
  EXPECT_EQ(TheLostLayer().warmCaches(), 0u);
}

// The driver's own data without our header, and data that the driver refuses.
TEST_F(PipelineCacheTest, ForeignBlobsStayAway) {
  sink.Expect(MsgCode::PipelineCacheRefused, "the blob is another's");
  const Blob blob = Save(*Make(nullptr));
  ExpectRefused(Blob(blob.begin() + 24, blob.end()), "GetPipelineCacheBlob");
  ExpectRefused(Blob(4096, 0), "GetPipelineCacheBlob");
  TheLostLayer().fail("vkCreatePipelineCache", kOutOfHostMemory, 0, 1);
  ExpectRefused(blob, "does not take it");
}

// The same, unharmed, but of an adapter with another identity; its check is made right again.
TEST_F(PipelineCacheTest, BlobOfAnotherDriver) {
  sink.Expect(MsgCode::PipelineCacheRefused, "the blob is another driver's");
  Blob blob = Save(*Make(nullptr));
  blob[24 + 16] ^= 1;  // the first byte of the driver's identity
  uint64_t hash = 0xcbf29ce484222325ull;
  for (size_t i = 24; i < blob.size(); ++i) hash = (hash ^ blob[i]) * 0x100000001b3ull;
  std::memcpy(blob.data() + 16, &hash, sizeof hash);
  ExpectRefused(blob, "another driver");
}

// Where nothing can be saved, that is said by the cap, and by a size of 0.
TEST_F(PipelineCacheTest, NoneWhereTheDriverSavesNothing) {
  TheLostLayer().saveCaches(false);
  Rig rig(Make(nullptr));
  Picture(rig);
  if (rig.device->GetCaps().pipelineCacheBlob) GTEST_SKIP() << "this driver saves its cache";
  EXPECT_EQ(rig.device->GetPipelineCacheBlob(nullptr, 0), 0u);
}

}  // namespace
}  // namespace rhi_stress
