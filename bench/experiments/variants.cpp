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

std::vector<Variant> ablation_variants(bool paper) {
  std::vector<Variant> all{{"default", {}}};
  const auto add = [&all](const char* name, auto member, auto value) {
    MatchParameters parameters;
    parameters.*member = value;
    all.push_back({name, parameters});
  };
  using P = MatchParameters;
  add("no elastic flow", &P::elastic_iterations, std::vector<int>{});
  add("elastic: coarse level only", &P::elastic_iterations, std::vector<int>{P{}.elastic_iterations.front()});
  add("elastic: no signals", &P::elastic_signals, 0.0);
  add("elastic: changes of area free", &P::elastic_area, 0.01);
  add("elastic: no yielding", &P::elastic_yield, 1000.0);
  add("elastic: no yielding to signals", &P::elastic_signal_yield, 1e6);
  add("elastic: no eigenfunctions", &P::elastic_spectrum, 0.0);
  add("flow: no detail", &P::flow_detail, 0.0);
  add("flow: no level repeated", &P::flow_repeated, 0);
  add("one candidate followed", &P::fine_candidates, 1);
  all.push_back({"rotation alone", without_flow({})});
  if (paper) all.push_back({"method=paper", MatchParameters::paper()});
  return all;
}

}  // namespace spherematch::bench
