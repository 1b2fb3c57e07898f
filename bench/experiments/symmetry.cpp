#include <cstdio>
#include <utility>

#include "bench/experiments/experiments.h"
#include "bench/experiments/report.h"
#include "bench/experiments/shape_classes.h"
#include "bench/experiments/variants.h"
#include "engine/engine.h"

namespace spherematch::bench {

namespace {

constexpr int drawn_vertices = 100;

/// Of the first shape of a class that is symmetric as it stands; the others share its numbering where they have as many vertices.
struct Representative {
  std::vector<Landmark> pairs;
  std::int32_t vertices = 0;
};

std::optional<Representative> representative_of(const std::vector<std::filesystem::path>& files) {
  for (const auto& file : files) {
    const Surface surface = read_shape(file);
    if (auto pairs = extrinsic_symmetry(surface, drawn_vertices)) return Representative{std::move(*pairs), surface.uploaded_vertices()};
  }
  return std::nullopt;
}

/// What is known of the symmetry of a file.
std::vector<Landmark> symmetry_of(const std::filesystem::path& file, const Surface& surface,
                                  const std::optional<Representative>& representative) {
  if (auto listed = listed_symmetry(file)) return std::move(*listed);
  if (representative && representative->vertices == surface.uploaded_vertices()) return representative->pairs;
  return {};
}

}  // namespace

void run_symmetry(const ExperimentSettings& settings) {
  const std::vector<Variant> variants = variants_named(settings.variants);
  std::vector<VariantResults> all = no_results(variants);
  for (const auto& [name, files] : classes_in(settings.places, settings.whole_folders, 1)) {
    const std::optional<Representative> representative = listed_symmetry(files.front()) ? std::nullopt : representative_of(files);
    for (const auto& file : files) {
      Surface surface = read_shape(file);
      GroundTruth truth;
      truth.direct = symmetry_of(file, surface, representative);
      if (truth.direct.empty()) {
        std::printf("%s: %s is left out, nothing is known of its symmetry\n", name.c_str(), file.filename().c_str());
        continue;
      }
      for (const Landmark& landmark : truth.direct) truth.mirrored.push_back({landmark.source, landmark.source});
      const PreprocessedShape shape = preprocess(std::move(surface), settings.preparation(), {}, settings.threads);
      std::printf("%s: %s", name.c_str(), file.stem().c_str());
      for (std::size_t v = 0; v < variants.size(); ++v) {
        MatchParameters parameters = variants[v].parameters;
        parameters.orientation = Orientation::reverse;
        // One object twice: the engine then knows that it looks for a symmetry.
        const MatchResult result = match(shape, shape, parameters, {}, settings.threads);
        all[v].pairs.push_back(
            {file.stem().string(), file.stem().string(), evaluate(shape, shape, result.map, nullptr, truth, {}, settings.threads)});
        std::printf("  %s %.2f", variants[v].name.c_str(), 100 * all[v].pairs.back().evaluation.geodesic->mean);
      }
      std::printf("\n");
      std::fflush(stdout);
    }
  }
  std::puts("all shapes");
  print(all);
  write_text(settings.out + "/symmetry.json", to_json("symmetry", settings, all).dump(1) + "\n");
  write_text(settings.out + "/symmetry-geodesic.svg",
             curves_svg("Intrinsic mirror images", "geodesic distance to the truth, at unit area", all, &Evaluation::geodesic));
}

}  // namespace spherematch::bench
