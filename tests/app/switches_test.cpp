// Every switch of the technique shells acts: what the picture or the counts must do when it is thrown.
#include "program.h"

namespace app::test {
namespace {

struct Drawn {
  fur::Image picture;
  nlohmann::json stats;
  uint64_t Fragments(const char* pass) const { return stats["fragments"][pass].get<uint64_t>(); }
  uint64_t Count(const char* key) const { return stats[key].get<uint64_t>(); }
};

Drawn With(std::vector<std::string> flags) {
  const Folder folder;
  std::vector<std::string> all{"render", "-o", folder / "x.png", "--stats", folder / "s.json", "--size", "240x180",
                               "--repeat", "0"};
  all.insert(all.end(), flags.begin(), flags.end());
  ExpectSuccess(RunFur(all));
  return {Picture(folder / "x.png"), ReadJson(folder / "s.json")};
}

uint64_t Changed(const Drawn& a, const Drawn& b) { return DifferingPixels(a.picture, b.picture); }

class Switches : public testing::Test {
 protected:
  static const Drawn& Default() {
    static const Drawn run = With({});
    return run;
  }
};

TEST_F(Switches, NoFins) {
  const Drawn run = With({"--no-fins"});
  EXPECT_EQ(run.Count("edges_submitted"), 0u);
  EXPECT_EQ(run.Fragments("fins"), 0u);
  EXPECT_EQ(run.Fragments("shells"), Default().Fragments("shells"));
  EXPECT_GT(Changed(run, Default()), 500u);
}

TEST_F(Switches, NoShells) {
  const Drawn run = With({"--no-shells"});
  EXPECT_EQ(run.Fragments("shells"), 0u);
  EXPECT_EQ(run.Fragments("fins"), Default().Fragments("fins"));
  EXPECT_GT(Changed(run, Default()), 3000u);
}

// What is seen from behind shows at the outline only.
TEST_F(Switches, NoBackFaces) {
  const Drawn run = With({"--no-back-faces"});
  EXPECT_LT(run.Fragments("shells"), Default().Fragments("shells"));
  EXPECT_GT(Changed(run, Default()), 200u);
  EXPECT_LT(Changed(run, Default()), 6000u);
  const Drawn front = With({"--no-back-faces", "--shell-mode", "instanced"}), all = With({"--shell-mode", "instanced"});
  EXPECT_LT(front.Count("triangles_submitted"), 0.6 * double(all.Count("triangles_submitted")));
}

TEST_F(Switches, FinThreshold) {
  uint64_t before = 0;
  for (const char* threshold : {"0", "0.1", "0.25", "0.6", "1"}) {
    const uint64_t fins = With({"--fin-threshold", threshold}).Fragments("fins");
    EXPECT_GT(fins, before) << threshold;
    before = fins;
  }
}

TEST_F(Switches, FinOpacity) {
  EXPECT_EQ(Changed(With({"--fin-opacity", "0"}), With({"--no-fins"})), 0u);
  EXPECT_GT(Changed(With({"--fin-opacity", "0.3"}), Default()), 200u);
}

TEST_F(Switches, Fins) {
  const Drawn compacted = With({"--fins", "compacted"}), pulled = With({"--fins", "pulled"}),
            geometry = With({"--fins", "geometry"});
  EXPECT_GT(compacted.Count("dispatches"), 0u);
  EXPECT_EQ(pulled.Count("dispatches") + geometry.Count("dispatches"), 0u);
  EXPECT_EQ(Changed(compacted, pulled), 0u);
  EXPECT_LE(Changed(geometry, pulled), 43u) << "0.1 %: geometry shaders' vertices are rounded otherwise";
}

TEST_F(Switches, ShellMode) {
  const Drawn instanced = With({"--shell-mode", "instanced"}), draws = With({"--shell-mode", "draws"}),
              amplified = With({"--shell-mode", "amplified"});
  EXPECT_GT(draws.Count("draws"), instanced.Count("draws") + 20);
  EXPECT_EQ(Changed(draws, instanced), 0u);
  EXPECT_LE(Changed(amplified, instanced), 43u);
  EXPECT_GT(amplified.Count("draws"), instanced.Count("draws") + 20);
  EXPECT_EQ(Changed(With({"--shell-mode", "sorted"}), Default()), 0u);
  EXPECT_GT(Changed(instanced, Default()), 100u) << "the animal's fur lies over its own";
  EXPECT_EQ(instanced.Fragments("shells"), Default().Fragments("shells"));
}

// Bytes are filtered with coarse weights, floats are not: the difference is small, and everywhere.
TEST_F(Switches, FloatTextures) {
  const Drawn run = With({"--float-textures"});
  EXPECT_GT(Changed(run, Default()), 1000u);
  double sum = 0;
  for (size_t i = 0; i < run.picture.pixels.size(); ++i)
    sum += std::abs(int(run.picture.pixels[i]) - int(Default().picture.pixels[i]));
  EXPECT_LT(sum / double(run.picture.pixels.size()), 0.5) << "in the mean below what 8 bits show";
}

TEST_F(Switches, Shells) {
  const Drawn run = With({"--shells", "7"});
  EXPECT_LT(run.Fragments("shells"), 0.7 * double(Default().Fragments("shells")));
}

TEST_F(Switches, CombAndItsStrengthAndBend) {
  const Drawn combed = With({"--comb", "0,-1,0"});
  EXPECT_GT(Changed(combed, Default()), 2000u);
  EXPECT_EQ(Changed(With({"--comb", "0,-1,0", "--comb-strength", "0"}), Default()), 0u);
  EXPECT_EQ(Changed(With({"--comb", "0,-7,0"}), combed), 0u) << "a direction has no length";
  EXPECT_GT(Changed(With({"--comb", "0,-1,0", "--comb-strength", "0.4"}), combed), 1000u);
  EXPECT_GT(Changed(With({"--comb", "0,-1,0", "--bend", "1"}), combed), 1000u);
  EXPECT_GT(Changed(With({"--comb", "1,0,0"}), combed), 1000u);
}

TEST_F(Switches, SpacingSetsTheLength) {
  const Drawn small = With({"--spacing", "0.001"}), large = With({"--spacing", "0.006"});
  EXPECT_LT(small.Fragments("shells"), large.Fragments("shells"));
  EXPECT_GT(Changed(small, large), 2000u);
}

// The field's animals overlap on this camera; given back to front already, the order would not show.
TEST_F(Switches, NoSort) {
  const std::vector<std::string> field{"--count", "9", "--eye", "-2,1.2,-3", "--target", "0,0.4,0"};
  std::vector<std::string> unsorted = field;
  unsorted.push_back("--no-sort");
  EXPECT_GT(Changed(With(field), With(unsorted)), 0u);
}

TEST_F(Switches, TechniqueLookAndSemantics) {
  const Drawn seed = With({"--technique", "seed"});
  EXPECT_EQ(seed.stats["technique"], "seed");
  EXPECT_EQ(seed.stats["semantics"], "sheet") << "as published";
  EXPECT_EQ(Default().stats["semantics"], "volume");
  EXPECT_EQ(With({"--look", "seed"}).stats["semantics"], "sheet");
  EXPECT_GT(Changed(seed, Default()), 3000u);
  EXPECT_GT(Changed(With({"--semantics", "sheet"}), Default()), 1000u);
}

}  // namespace
}  // namespace app::test
