// Flags that make no sense: exit code 2, one line, no file.
#include "program.h"

namespace app::test {
namespace {

struct BadFlag {
  const char* name;
  std::vector<std::string> arguments;
  std::vector<std::string> words;  // that the message names
};
void PrintTo(const BadFlag& f, std::ostream* out) { *out << f.name; }

class BadFlags : public testing::TestWithParam<BadFlag> {};
TEST_P(BadFlags, AreRefused) { ExpectRenderFailure(GetParam().arguments, kUsage, GetParam().words); }

const BadFlag kSizes[] = {
    {"SizeZero", {"--size", "0x0"}, {"--size", "0x0"}},
    {"SizeZeroHigh", {"--size", "320x0"}, {"--size", "320x0"}},
    {"SizeHuge", {"--size", "100000x100000"}, {"--size", "16384"}},
    {"SizeBeyond32Bits", {"--size", "4294967616x240"}, {"--size"}},
    {"SizeBeyond64Bits", {"--size", "99999999999999999999999x240"}, {"--size"}},
    {"SizeNegative", {"--size", "-320x240"}, {}},
    {"SizeNegativeAssigned", {"--size=-320x240"}, {"--size", "-320x240"}},
    {"SizeText", {"--size", "large"}, {"--size", "large"}},
    {"SizeOneNumber", {"--size", "320"}, {"--size"}},
    {"SizeTrailing", {"--size", "320x240x2"}, {"--size"}},
    {"SizeFraction", {"--size", "320.5x240"}, {"--size"}},
    {"SizeHex", {"--size", "0x140x240"}, {"--size"}},
    {"SizeEmpty", {"--size", ""}, {"--size"}},
    {"SizeMissing", {"--size"}, {"--size"}},
    {"SizeTwice", {"--size", "8x8", "--size", "9x9"}, {"--size"}},
};
const BadFlag kChoices[] = {
    {"UnknownFlag", {"--furr"}, {"--furr"}},
    {"UnknownBackend", {"--backend", "metal"}, {"--backend", "metal"}},
    {"UnknownTechnique", {"--technique", "magic"}, {"--technique", "magic"}},
    {"UnknownLook", {"--look", "pretty"}, {"--look", "pretty"}},
    {"UnknownSemantics", {"--semantics", "x"}, {"--semantics"}},
    {"ThreeSamples", {"--samples", "3"}, {"--samples"}},
    {"SamplesText", {"--samples", "many"}, {"--samples"}},
    {"NoShells", {"--shells", "0"}, {"--shells"}},
    {"ManyShells", {"--shells", "513"}, {"--shells"}},
    {"NoShellsAtOnce", {"--shells-at-once", "0"}, {"--shells-at-once"}},
    {"ManyShellsAtOnce", {"--shells-at-once", "15"}, {"--shells-at-once"}},
    {"NegativeShells", {"--shells=-1"}, {"--shells"}},
    {"NoAnimals", {"--count", "0"}, {"--count"}},
    {"TooManyAnimals", {"--count", "10001"}, {"--count"}},
    {"NegativeRepeat", {"--repeat=-1"}, {"--repeat"}},
    {"RepeatText", {"--repeat", "1.5"}, {"--repeat"}},
    {"SecondModel", {"a.gltf", "b.gltf"}, {"b.gltf"}},
};
const BadFlag kCamera[] = {
    {"EyeText", {"--eye", "here"}, {"--eye", "here"}},
    {"EyeTwoNumbers", {"--eye", "1,2"}, {"--eye"}},
    {"EyeFourNumbers", {"--eye", "1,2,3,4"}, {"--eye"}},
    {"EyeNan", {"--eye", "nan,0,0"}, {"--eye", "finite"}},
    {"EyeInfinite", {"--eye", "1,inf,0"}, {"--eye", "finite"}},
    {"EyeOverflow", {"--eye", "1e999,0,0"}, {"--eye"}},
    {"TargetNan", {"--target", "0,nan,0"}, {"--target"}},
    {"EyeIsTarget", {"--eye", "1,1,1", "--target", "1,1,1"}, {"--eye", "--target"}},
    {"EyeAboveTarget", {"--eye", "1,9,1", "--target", "1,1,1"}, {"--eye", "--target"}},
    {"FovZero", {"--fov", "0"}, {"--fov"}},
    {"FovTooWide", {"--fov", "180"}, {"--fov"}},
    {"FovNan", {"--fov", "nan"}, {"--fov"}},
    {"NearNegative", {"--near=-1"}, {"--near"}},
    {"NearNan", {"--near", "nan"}, {"--near"}},
    {"FarNan", {"--far", "nan"}, {"--far"}},
    {"NearBehindFar", {"--near", "10", "--far", "1"}, {"--far", "--near"}},
    {"BackgroundNan", {"--background", "0,0,nan"}, {"--background"}},
    {"BackgroundText", {"--background", "red"}, {"--background", "red"}},
};

std::string Name(const testing::TestParamInfo<BadFlag>& info) { return info.param.name; }
INSTANTIATE_TEST_SUITE_P(Size, BadFlags, testing::ValuesIn(kSizes), Name);
INSTANTIATE_TEST_SUITE_P(Choice, BadFlags, testing::ValuesIn(kChoices), Name);
INSTANTIATE_TEST_SUITE_P(Camera, BadFlags, testing::ValuesIn(kCamera), Name);

TEST(BadCommands, AreRefused) {
  ExpectFailure(RunFur({}), kUsage, {"--help"});
  ExpectFailure(RunFur({"paint"}), kUsage, {"--help"});
  ExpectFailure(RunFur({"--bogus"}), kUsage, {"--help"});
  ExpectFailure(RunFur({""}), kUsage);
}

TEST(BadCommands, UnknownAdapterIsNamed) {
  for (const char* backend : {"vulkan", "gl"})
    ExpectRenderFailure({"--backend", backend, "--adapter", "no such adapter"}, kNoDevice,
                        {backend, "no such adapter"});
}

}  // namespace
}  // namespace app::test
