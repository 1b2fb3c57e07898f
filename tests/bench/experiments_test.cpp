#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>

#include "bench/experiments/pair_list.h"
#include "bench/experiments/report.h"
#include "bench/experiments/shape_classes.h"
#include "bench/experiments/variants.h"
#include "engine/io/mesh_writer.h"
#include "engine/mesh/repair.h"
#include "tests/support/meshes.h"

namespace spherematch::bench {
namespace {

namespace fs = std::filesystem;

class ShapeFolder : public testing::Test {
 protected:
  ShapeFolder() {
    std::string pattern = (fs::temp_directory_path() / "spherematch-bench-XXXXXX").string();
    place = mkdtemp(pattern.data());
  }
  ~ShapeFolder() override {
    std::error_code ignored;
    fs::remove_all(place, ignored);
  }
  void write(const std::string& name, const std::string& text) const { std::ofstream(place / name) << text; }
  void write_mesh(const std::string& name, const TriMesh& mesh) const { write(name, encode_mesh(MeshFormat::off, test::polygons(mesh))); }

  fs::path place;
};

TEST_F(ShapeFolder, ClassesAreNamesWithoutNumbers) {
  for (const char* name : {"cat0.off", "cat10.off", "cat2.off", "tr_reg_000.off", "tr_reg_001.off", "lone.off", "cat3.vts"})
    write(name, "");
  const ShapeClasses classes = classes_in({place.string()}, false, 2);
  const std::string folder = place.filename().string();
  ASSERT_EQ(classes.size(), 2U);
  EXPECT_EQ(classes.at(folder + "/cat").size(), 3U);
  EXPECT_EQ(classes.at(folder + "/tr_reg").at(1).filename(), "tr_reg_001.off");
  EXPECT_EQ(classes_in({place.string()}, true, 2).at(folder).size(), 6U);
  EXPECT_EQ(classes_in({(place / "lone.off").string()}, false, 1).at(folder + "/lone").size(), 1U);
  EXPECT_THROW((void)classes_in({(place / "lone.off").string()}, false, 2), std::runtime_error);
}

TEST_F(ShapeFolder, LandmarksComeBeforeTheIdentity) {
  write_mesh("a.off", test::icosphere(1));
  write_mesh("b.off", test::icosphere(1));
  write_mesh("c.off", test::icosphere(2));
  const fs::path a = place / "a.off", b = place / "b.off", c = place / "c.off";
  const Surface fine = read_shape(c), coarse = read_shape(a);
  EXPECT_TRUE(truth_between(a, b, coarse, coarse).value().dense);
  EXPECT_FALSE(truth_between(a, c, coarse, fine));
  write("a.vts", "1\n2\n");
  write("c.vts", "5\n6\n");
  EXPECT_EQ(truth_between(a, c, coarse, fine).value().direct.at(1).target, 5);
  EXPECT_FALSE(truth_between(a, c, coarse, fine).value().dense);
  EXPECT_TRUE(truth_between(a, c, coarse, fine).value().mirrored.empty());
  EXPECT_FALSE(listed_symmetry(c));
  write("c.sym.vts", "7\n6\n");
  EXPECT_EQ(truth_between(a, c, coarse, fine).value().mirrored.at(0).target, 6);
  EXPECT_EQ(listed_symmetry(c).value().at(0).source, 4);
  EXPECT_EQ(listed_symmetry(c).value().at(0).target, 6);
}

TEST_F(ShapeFolder, PairsOfAListComeBySet) {
  write("pairs.json",
        R"({"pairs": [{"set": "x", "src": "a", "tgt": "b", "truth": "vts"}, {"set": "y", "src": "a", "tgt": "c", "truth": "identity"},
                         {"set": "x", "src": "b", "tgt": "a", "truth": "vts", "reference": {}}]})");
  const std::vector<PairSet> sets = read_pair_list({.pairs = place / "pairs.json", .data = place});
  ASSERT_EQ(sets.size(), 2U);
  EXPECT_EQ(sets[0].name, "x");
  ASSERT_EQ(sets[0].pairs.size(), 2U);
  EXPECT_EQ(sets[0].pairs[1].source, place / "x" / "b.off");
  EXPECT_FALSE(sets[0].pairs[1].identity);
  EXPECT_TRUE(sets[1].pairs.at(0).identity);
  EXPECT_EQ(read_pair_list({.pairs = place / "pairs.json", .data = place, .most_pairs = 1}).at(0).pairs.size(), 1U);
  for (const char* wrong :
       {"", "[]", R"({"pairs": [{"set": "x", "src": "a", "tgt": "b", "truth": "x"}]})", R"({"pairs": [{"set": "x"}]})"}) {
    write("wrong.json", wrong);
    EXPECT_THROW((void)read_pair_list({.pairs = place / "wrong.json", .data = place}), std::runtime_error) << wrong;
  }
  EXPECT_THROW((void)read_pair_list({.pairs = place / "none.json", .data = place}), std::runtime_error);
}

TEST_F(ShapeFolder, TheTruthOfAPairIsWhatItsListSays) {
  write_mesh("a.off", test::icosphere(2));
  write_mesh("b.off", test::icosphere(2));
  const ListedPair identity{place / "a.off", place / "b.off", true}, listed{place / "a.off", place / "b.off", false};
  const Surface surface = read_shape(identity.source);
  const GroundTruth drawn = truth_of(identity, surface, surface);
  EXPECT_EQ(drawn.direct.size(), 500U);
  for (const Landmark& landmark : drawn.direct) EXPECT_EQ(landmark.source, landmark.target);
  EXPECT_EQ(vertices_drawn_by_area(surface, 500), vertices_drawn_by_area(surface, 500));
  EXPECT_THROW((void)truth_of(listed, surface, surface), std::runtime_error);
  write("a.vts", "1\n");
  write("b.vts", "2\n");
  EXPECT_EQ(truth_of(listed, surface, surface).direct.at(0).target, 1);
}

TEST(ExtrinsicSymmetry, IsFoundInTheYzPlaneAlone) {
  const auto surface = [](const TriMesh& mesh) { return repair(test::polygons(mesh), RepairMode::fill); };
  const TriMesh lens = test::transformed(test::ellipsoid(3, {1, 2, 3}), 1, Eigen::Matrix3d::Identity(), {7, 0, 0});
  const auto pairs = extrinsic_symmetry(surface(lens), 50);
  ASSERT_TRUE(pairs);
  EXPECT_EQ(pairs->size(), 50U);
  for (const Landmark& pair : *pairs) {
    const Eigen::RowVector3d mirrored = lens.vertices.row(pair.target), place = lens.vertices.row(pair.source);
    EXPECT_NEAR(mirrored[0] + place[0], 14, 1e-5);
    EXPECT_NEAR(mirrored[1], place[1], 1e-5);
  }
  EXPECT_FALSE(extrinsic_symmetry(surface(test::transformed(lens, 1, test::some_rotation(), {0, 0, 0})), 50));
}

TEST(Variants, AreThereUnderTheirNames) {
  const std::vector<Variant> chosen = variants_named({"paper", "rotation"});
  EXPECT_TRUE(chosen.at(0).parameters.paper_selection);
  EXPECT_EQ(chosen.at(1).parameters.flow_iterations, 0);
  EXPECT_THROW((void)variants_named({"other"}), std::runtime_error);
  for (const Variant& variant : variants()) variant.parameters.validate();
}

TEST(Variants, AnAblationChangesOnePartAtATime) {
  const std::vector<Variant> some = ablation_variants(false), all = ablation_variants(true);
  EXPECT_EQ(all.size(), some.size() + 1);
  EXPECT_TRUE(all.back().parameters.paper_selection);
  EXPECT_EQ(some.front().name, "default");
  std::set<std::string> names;
  for (const Variant& variant : all) {
    variant.parameters.validate();
    EXPECT_TRUE(names.insert(variant.name).second) << variant.name;
  }
  EXPECT_TRUE(variants_named({"flow"}).at(0).parameters.elastic_iterations.empty());
  EXPECT_TRUE(variants_named({"rotation"}).at(0).parameters.elastic_iterations.empty());
}

TEST(Report, EveryPairCountsAlike) {
  VariantResults results{"x", {}};
  for (const double mean : {0.25, 0.75}) {
    Evaluation evaluation;
    evaluation.geodesic.emplace();
    evaluation.geodesic->mean = mean;
    evaluation.geodesic->curve.assign(curve_steps + 1, mean);
    results.pairs.push_back({"a", "b", evaluation});
  }
  results.pairs.push_back({"c", "d", {}});  // without that error
  const MapError mean = average(results, &Evaluation::geodesic);
  EXPECT_EQ(mean.scored, 2);
  EXPECT_EQ(mean.mean, 0.5);
  EXPECT_EQ(mean.curve, std::vector<double>(curve_steps + 1, 0.5));
  EXPECT_EQ(average(results, &Evaluation::biharmonic).scored, 0);
  const Json json = to_json("test", {}, {results});
  EXPECT_EQ(json.at("variants").at(0).at("pairs").size(), 3U);
  EXPECT_NE(curves_svg("t", "x", {results}, &Evaluation::geodesic).find("<polyline"), std::string::npos);
  EXPECT_EQ(curves_svg("t", "x", {results}, &Evaluation::biharmonic).find("<polyline"), std::string::npos);
}

}  // namespace
}  // namespace spherematch::bench
