#include <cstdio>
#include <memory>
#include <utility>

#include "bench/experiments/experiments.h"
#include "bench/experiments/report.h"
#include "bench/experiments/shape_classes.h"
#include "bench/experiments/variants.h"
#include "engine/engine.h"

namespace spherematch::bench {

namespace {

using Pair = std::pair<std::size_t, std::size_t>;

/// All ordered pairs, or so many of them at even distances.
std::vector<Pair> pairs_of(std::size_t shapes, int most) {
  std::vector<Pair> all;
  for (std::size_t i = 0; i < shapes; ++i)
    for (std::size_t j = 0; j < shapes; ++j)
      if (i != j) all.emplace_back(i, j);
  if (most <= 0 || all.size() <= static_cast<std::size_t>(most)) return all;
  std::vector<Pair> some;
  for (std::size_t k = 0; k < static_cast<std::size_t>(most); ++k) some.push_back(all[k * all.size() / static_cast<std::size_t>(most)]);
  return some;
}

/// Adds the pairs of one class to the results of every variant.
void run_class(const std::vector<std::filesystem::path>& files, const ExperimentSettings& settings, const std::vector<Variant>& variants,
               std::vector<VariantResults>& results) {
  std::vector<std::shared_ptr<const PreprocessedShape>> shapes;
  shapes.reserve(files.size());
  for (const auto& file : files) {
    shapes.push_back(std::make_shared<const PreprocessedShape>(preprocess(read_shape(file), settings.preparation(), {}, settings.threads)));
  }
  std::vector<MatchShape> sides(shapes.begin(), shapes.end());
  for (const auto& [i, j] : pairs_of(files.size(), settings.most_pairs)) {
    const auto truth = truth_between(files[i], files[j], shapes[i]->surface, shapes[j]->surface);
    if (!truth) continue;
    for (std::size_t v = 0; v < variants.size(); ++v) {
      MatchParameters parameters = variants[v].parameters;
      parameters.both = true;
      const MatchResult result = match(sides[i], sides[j], parameters, {}, settings.threads);
      results[v].pairs.push_back({files[i].stem().string(), files[j].stem().string(),
                                  evaluate(*shapes[i], *shapes[j], result.map, &result.reverse, *truth, {}, settings.threads)});
    }
  }
}

}  // namespace

void run_correspondences(const ExperimentSettings& settings) {
  const std::vector<Variant> variants = variants_named(settings.variants);
  std::vector<VariantResults> all = no_results(variants);
  for (const auto& [name, files] : classes_in(settings.places, settings.whole_folders, 2)) {
    std::vector<VariantResults> results = no_results(variants);
    run_class(files, settings, variants, results);
    std::printf("%s\n", name.c_str());
    print(results);
    std::fflush(stdout);
    for (std::size_t v = 0; v < all.size(); ++v) {
      for (PairEvaluation& pair : results[v].pairs) all[v].pairs.push_back(std::move(pair));
    }
  }
  std::puts("all classes");
  print(all);
  write_text(settings.out + "/correspondences.json", to_json("correspondences", settings, all).dump(1) + "\n");
  write_text(settings.out + "/correspondences-biharmonic.svg",
             curves_svg("Pairs within a class", "biharmonic distance to the truth, at unit area", all, &Evaluation::biharmonic));
  write_text(settings.out + "/correspondences-geodesic.svg",
             curves_svg("Pairs within a class", "geodesic distance to the truth, at unit area", all, &Evaluation::geodesic));
}

}  // namespace spherematch::bench
