#include "engine/io/ply_header.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "engine/io/text_scanner.h"

namespace spherematch {

namespace {

/// A number and what parts it from the next; the last one of an ASCII file may lack that.
constexpr std::size_t shortest_number = 2;
/// Each element is compared with those before it.
constexpr std::size_t most_elements = 100;

struct TypeName {
  std::string_view name;
  PlyType type;
};
constexpr std::array<TypeName, 16> type_names{{{"char", PlyType::int8},
                                               {"int8", PlyType::int8},
                                               {"uchar", PlyType::uint8},
                                               {"uint8", PlyType::uint8},
                                               {"short", PlyType::int16},
                                               {"int16", PlyType::int16},
                                               {"ushort", PlyType::uint16},
                                               {"uint16", PlyType::uint16},
                                               {"int", PlyType::int32},
                                               {"int32", PlyType::int32},
                                               {"uint", PlyType::uint32},
                                               {"uint32", PlyType::uint32},
                                               {"float", PlyType::float32},
                                               {"float32", PlyType::float32},
                                               {"double", PlyType::float64},
                                               {"float64", PlyType::float64}}};

class HeaderReader {
 public:
  explicit HeaderReader(std::string_view text) : text_(text), scanner_(text, LineEnds::end_statements) {}

  PlyHeader read() {
    if (scanner_.word() != "ply") scanner_.fail("a PLY file starts with 'ply'");
    next_line();
    read_format();
    for (std::string_view keyword = scanner_.word(); keyword != "end_header"; keyword = scanner_.word()) {
      if (keyword == "element") {
        read_element();
      } else if (keyword == "property") {
        read_property();
      } else if (!keyword.empty() && keyword != "comment" && keyword != "obj_info") {
        scanner_.fail(quoted(keyword) + " is not a statement of a PLY header");
      }
      next_line();
    }
    next_line();
    header_.length = text_.size() - scanner_.remaining();
    header_.lines = scanner_.line() - 1;
    check_counts();
    return std::move(header_);
  }

 private:
  void next_line() {
    const std::int64_t line = scanner_.line();
    scanner_.skip_line();
    if (scanner_.line() == line) scanner_.fail("the file ends within the header");
  }

  void read_format() {
    std::string_view keyword = scanner_.word();
    for (; keyword.empty() || keyword == "comment" || keyword == "obj_info"; keyword = scanner_.word()) next_line();
    if (keyword != "format") scanner_.fail(quoted(keyword) + " stands where 'format' should be");
    const std::string_view name = scanner_.word();
    if (name == "ascii") {
      header_.encoding = PlyEncoding::ascii;
    } else if (name == "binary_little_endian") {
      header_.encoding = PlyEncoding::little_endian;
    } else if (name == "binary_big_endian") {
      header_.encoding = PlyEncoding::big_endian;
    } else {
      scanner_.fail(quoted(name) + " is not a PLY encoding");
    }
    next_line();
  }

  void read_element() {
    PlyElement element;
    element.name = scanner_.word();
    element.count = scanner_.integer("the number of rows");
    if (element.count < 0) scanner_.fail("a count is negative");
    for (const PlyElement& other : header_.elements)
      if (other.name == element.name) scanner_.fail("there are two elements named " + quoted(element.name));
    if (header_.elements.size() == most_elements) scanner_.fail("there are more than " + std::to_string(most_elements) + " elements");
    header_.elements.push_back(std::move(element));
  }

  void read_property() {
    if (header_.elements.empty()) scanner_.fail("a property stands before the first element");
    PlyProperty property{};
    std::string_view type = scanner_.word();
    if (type == "list") {
      property.is_list = true;
      property.length_type = type_of(scanner_.word());
      if (!is_integer(property.length_type)) scanner_.fail("the length of a list must be an integer");
      type = scanner_.word();
    }
    property.type = type_of(type);
    property.name = scanner_.word();
    if (property.name.empty()) scanner_.fail("a property has no name");
    header_.elements.back().properties.push_back(property);
  }

  PlyType type_of(std::string_view name) const {
    const auto* const entry = std::find_if(type_names.begin(), type_names.end(), [&](const TypeName& t) { return t.name == name; });
    if (entry == type_names.end()) scanner_.fail(quoted(name) + " is not a type of PLY");
    return entry->type;
  }

  void check_counts() const {
    const bool ascii = header_.encoding == PlyEncoding::ascii;
    std::size_t room = scanner_.remaining() + (ascii ? 1 : 0);
    for (const PlyElement& element : header_.elements) {
      const std::size_t row = element.shortest_row(header_.encoding);
      if (row == 0) continue;
      const auto count = static_cast<std::size_t>(element.count);
      if (count > room / row)
        scanner_.fail("the file is too short for " + std::to_string(count) + " rows of element " + quoted(element.name));
      room -= count * row;
    }
  }

  std::string_view text_;
  TextScanner scanner_;
  PlyHeader header_;
};

}  // namespace

std::size_t size_of(PlyType type) {
  switch (type) {
    case PlyType::int8:
    case PlyType::uint8:
      return 1;
    case PlyType::int16:
    case PlyType::uint16:
      return 2;
    case PlyType::int32:
    case PlyType::uint32:
    case PlyType::float32:
      return 4;
    case PlyType::float64:
      return 8;
  }
  return 0;
}

bool is_integer(PlyType type) { return type != PlyType::float32 && type != PlyType::float64; }

std::size_t PlyElement::shortest_row(PlyEncoding encoding) const {
  if (encoding == PlyEncoding::ascii) return properties.size() * shortest_number;
  return std::accumulate(properties.begin(), properties.end(), std::size_t{0}, [](std::size_t sum, const PlyProperty& property) {
    return sum + size_of(property.is_list ? property.length_type : property.type);
  });
}

bool PlyElement::has_lists() const {
  return std::any_of(properties.begin(), properties.end(), [](const PlyProperty& property) { return property.is_list; });
}

PlyHeader read_ply_header(std::string_view text) { return HeaderReader(text).read(); }

}  // namespace spherematch
