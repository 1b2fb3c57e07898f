#include "server/negotiation.h"

#include <algorithm>
#include <cctype>
#include <charconv>

#include "server/problem.h"

namespace spherematch {

namespace {

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

/// Cuts off and returns what stands before the separator.
std::string_view next_part(std::string_view& rest, char separator) {
  const auto end = rest.find(separator);
  const std::string_view part = rest.substr(0, end);
  rest = end == std::string_view::npos ? std::string_view() : rest.substr(end + 1);
  return trimmed(part);
}

bool same_ignoring_case(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) {
    return std::tolower(static_cast<unsigned char>(x)) == std::tolower(static_cast<unsigned char>(y));
  });
}

/// How closely a media range names the type: 0 not at all, 1 any, 2 by the part before the slash, 3 exactly.
int specificity(std::string_view range, std::string_view type) {
  if (range == "*/*") return 1;
  if (same_ignoring_case(range, type)) return 3;
  const auto slash = type.find('/');
  return range.ends_with("/*") && same_ignoring_case(range.substr(0, range.size() - 2), type.substr(0, slash)) ? 2 : 0;
}

double quality_value(std::string_view parameters) {
  while (!parameters.empty()) {
    const std::string_view parameter = next_part(parameters, ';');
    if (parameter.size() < 2 || (parameter[0] != 'q' && parameter[0] != 'Q') || parameter[1] != '=') continue;
    double value = 0;
    const std::string_view digits = parameter.substr(2);
    const auto [stop, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    const bool sound = error == std::errc() && stop == digits.data() + digits.size() && value >= 0 && value <= 1;
    return sound ? value : 0;  // a range with a broken weight asks for nothing
  }
  return 1;
}

/// The weight that the most specific range gives to the type.
double weight_of(std::string_view accept, std::string_view type) {
  int best = 0;
  double weight = 0;
  while (!accept.empty()) {
    std::string_view parameters = next_part(accept, ',');
    const std::string_view range = next_part(parameters, ';');
    if (const int closeness = specificity(range, type); closeness > best) {
      best = closeness;
      weight = quality_value(parameters);
    }
  }
  return weight;
}

template <typename Member>
std::string listed(std::span<const Representation> offers, Member member) {
  std::string text;
  for (const Representation& offer : offers) text.append(text.empty() ? "" : ", ").append(offer.*member);
  return text;
}

}  // namespace

const Representation* negotiate(std::string_view accept, std::span<const Representation> offers) {
  if (trimmed(accept).empty()) return &offers.front();
  const Representation* chosen = nullptr;
  double best = 0;
  for (const Representation& offer : offers) {
    if (const double weight = weight_of(accept, offer.media_type); weight > best) {
      best = weight;
      chosen = &offer;
    }
  }
  return chosen;
}

const Representation& choose_representation(const std::optional<std::string>& format, std::string_view accept,
                                            std::span<const Representation> offers) {
  if (format) {
    for (const Representation& offer : offers) {
      if (offer.format == *format) return offer;
    }
    throw ProblemError(api::Code::invalid_parameter,
                       "format: '" + format->substr(0, 64) + "' is not one of " + listed(offers, &Representation::format));
  }
  if (const Representation* offer = negotiate(accept, offers)) return *offer;
  throw ProblemError(api::Code::not_acceptable, "available are " + listed(offers, &Representation::media_type));
}

}  // namespace spherematch
