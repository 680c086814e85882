// fur reference from the outside.
#include "program.h"

namespace app::test {
namespace {

std::vector<std::string> Arguments(const Folder& folder, const std::vector<std::string>& more = {}) {
  std::vector<std::string> arguments{"reference", "-o", folder / "x.png", "--cache", folder / "cache", "--size", "96x60",
                                     "--spp", "2"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

TEST(Reference, DrawsAndKeepsThePicture) {
  const Folder folder;
  const Outcome first = RunFur(Arguments(folder));
  ExpectSuccess(first);
  const fur::Image picture = Picture(folder / "x.png");
  ExpectDrawn(picture);
  const Outcome second = RunFur(Arguments(folder));
  ExpectSuccess(second);
  EXPECT_NE(second.out.find("from the cache"), std::string::npos) << second.out;
  EXPECT_EQ(DifferingPixels(picture, Picture(folder / "x.png")), 0u);
}

TEST(Reference, RefusesFlagsThatMakeNoSense) {
  const Folder folder;
  for (const std::vector<std::string>& flags : std::vector<std::vector<std::string>>{
           {"--crop", "90,0,10,10"}, {"--crop", "1,2,3"}, {"--crop", "-1,0,5,5"}, {"--spp", "0"}, {"--tolerance", "nan"},
           {"--threads", "-1"}})
    ExpectFailure(RunFur(Arguments(folder, flags)), kUsage, {flags[0]});
  ExpectFailure(RunFur({"reference", "-o", folder / "x.bmp"}), kUsage, {".png"});
}

}  // namespace
}  // namespace app::test
