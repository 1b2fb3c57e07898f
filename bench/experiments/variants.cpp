#include "bench/experiments/variants.h"

#include <algorithm>
#include <stdexcept>

namespace spherematch::bench {

namespace {

MatchParameters without_flow(MatchParameters parameters) {
  parameters.flow_iterations = 0;
  parameters.elastic_iterations = {};
  return parameters;
}

MatchParameters optical_flow_alone() {
  MatchParameters parameters;
  parameters.elastic_iterations = {};
  return parameters;
}

}  // namespace

const std::vector<Variant>& variants() {
  static const std::vector<Variant> all{{"rotation", without_flow({})},
                                        {"flow", optical_flow_alone()},
                                        {"default", {}},
                                        {"paper-rotation", without_flow(MatchParameters::paper())},
                                        {"paper", MatchParameters::paper()}};
  return all;
}

std::vector<Variant> variants_named(const std::vector<std::string>& names) {
  std::vector<Variant> chosen;
  for (const std::string& name : names) {
    const auto found = std::find_if(variants().begin(), variants().end(), [&](const Variant& variant) { return variant.name == name; });
    if (found == variants().end()) {
      std::string message = "'" + name + "' is no variant; there are";
      for (const Variant& variant : variants()) message.append(" ").append(variant.name);
      throw std::runtime_error(message);
    }
    chosen.push_back(*found);
  }
  return chosen;
}

}  // namespace spherematch::bench
