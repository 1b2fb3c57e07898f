#include "engine/io/array_reader.h"

#include <algorithm>
#include <charconv>
#include <initializer_list>
#include <optional>
#include <string>
#include <utility>

#include "engine/data/error.h"
#include "engine/io/text_scanner.h"

namespace spherematch {

namespace {

constexpr std::size_t most_dimensions = 32;
constexpr std::size_t longest_header = 65536;

[[noreturn]] void fail(const std::string& reason) { throw EngineError(ErrorCode::malformed_array, "the array is not usable: " + reason); }

struct Header {
  std::string dtype;
  bool fortran_order = false;
  std::vector<std::int64_t> shape;
};

/// The one Python literal that a header is: {'descr': TEXT, 'fortran_order': BOOL, 'shape': (INTEGER, ...)}, in any order.
class HeaderParser {
 public:
  explicit HeaderParser(std::string_view text) : text_(text) {}

  Header parse() {
    std::optional<std::string> dtype;
    std::optional<bool> fortran_order;
    std::optional<std::vector<std::int64_t>> shape;
    expect('{');
    while (!take('}')) {
      const std::string key = quoted_text();
      expect(':');
      if (key == "descr" && !dtype) {
        dtype = description();
      } else if (key == "fortran_order" && !fortran_order) {
        fortran_order = boolean();
      } else if (key == "shape" && !shape) {
        shape = tuple();
      } else {
        fail("its header has the entry " + quoted(key) + " twice, or should not have it");
      }
      if (!take(',') && next() != '}') fail_here();
    }
    if (next() != '\0' || !text_.empty()) fail_here();
    if (!dtype || !fortran_order || !shape) fail("its header lacks one of 'descr', 'fortran_order' and 'shape'");
    return {*std::move(dtype), *fortran_order, *std::move(shape)};
  }

 private:
  [[noreturn]] static void fail_here() { fail("its header is not {'descr': TEXT, 'fortran_order': BOOL, 'shape': (INTEGER, ...)}"); }

  /// The next character that is no space; zero at the end.
  char next() {
    const std::size_t at = text_.find_first_not_of(" \t\r\n");
    text_.remove_prefix(at == std::string_view::npos ? text_.size() : at);
    return text_.empty() ? '\0' : text_.front();
  }
  bool take(char wanted) {
    if (next() != wanted || text_.empty()) return false;
    text_.remove_prefix(1);
    return true;
  }
  void expect(char wanted) {
    if (!take(wanted)) fail_here();
  }
  bool take_word(std::string_view word) {
    (void)next();
    if (!text_.starts_with(word)) return false;
    text_.remove_prefix(word.size());
    return true;
  }

  std::string quoted_text() {
    const char quote = next();
    if (quote != '\'' && quote != '"') fail_here();
    const std::size_t end = text_.find(quote, 1);
    if (end == std::string_view::npos) fail_here();
    const std::string result(text_.substr(1, end - 1));
    text_.remove_prefix(end + 1);
    return result;
  }
  std::string description() {
    if (next() == '[') fail("structured dtypes are not read; send one field at a time");
    return quoted_text();
  }
  bool boolean() {
    if (take_word("True")) return true;
    if (!take_word("False")) fail_here();
    return false;
  }
  std::vector<std::int64_t> tuple() {
    std::vector<std::int64_t> numbers;
    expect('(');
    while (!take(')')) {
      if (numbers.size() == most_dimensions) fail("it has more than " + std::to_string(most_dimensions) + " dimensions");
      numbers.push_back(length());
      if (!take(',') && next() != ')') fail_here();
    }
    return numbers;
  }
  std::int64_t length() {
    (void)next();
    std::int64_t value = 0;
    const auto [stop, error] = std::from_chars(text_.data(), text_.data() + text_.size(), value);
    if (error == std::errc::result_out_of_range) fail("a length in its shape is no number of 64 bits");
    if (error != std::errc()) fail_here();
    if (value < 0) fail("a length in its shape is negative");
    text_.remove_prefix(static_cast<std::size_t>(stop - text_.data()));
    return value;
  }

  std::string_view text_;
};

/// The bytes of an item: `size` is the number in the dtype, which counts characters of text.
std::size_t item_bytes(char kind, std::size_t size, const std::string& dtype) {
  const auto one_of = [size](std::initializer_list<std::size_t> sizes) {
    return std::find(sizes.begin(), sizes.end(), size) != sizes.end();
  };
  constexpr std::size_t longest_item = std::size_t{1} << 30;
  switch (kind) {
    case 'b':
      if (size == 1) return size;
      break;
    case 'i':
    case 'u':
      if (one_of({1, 2, 4, 8})) return size;
      break;
    case 'f':
      if (one_of({2, 4, 8})) return size;
      if (one_of({12, 16})) fail("numbers of dtype " + quoted(dtype) + " differ between machines; send float64");
      break;
    case 'c':
      if (one_of({8, 16})) return size;
      break;
    case 'M':
    case 'm':
      if (size == 8) return size;
      break;
    case 'S':
    case 'V':
      if (size > 0 && size <= longest_item) return size;
      break;
    case 'U':
      if (size > 0 && size <= longest_item / 4) return 4 * size;
      break;
    default:
      break;
  }
  fail("its dtype " + quoted(dtype) + " is not known");
}

/// Sets what the dtype tells.
void read_dtype(Array& array) {
  const std::string& dtype = array.dtype;
  if (dtype.find('O') != std::string::npos) fail("arrays of objects are not read");
  if (dtype.size() < 3 || std::string_view("<>|").find(dtype[0]) == std::string_view::npos)
    fail("its dtype " + quoted(dtype) + " is not known");
  array.kind = dtype[1];
  std::size_t size = 0;
  const auto [stop, error] = std::from_chars(dtype.data() + 2, dtype.data() + dtype.size(), size);
  const std::string_view unit(stop, static_cast<std::size_t>(dtype.data() + dtype.size() - stop));
  const bool is_time = array.kind == 'M' || array.kind == 'm';
  const bool sound_unit = unit.empty() || (is_time && unit.size() <= 20 && unit.front() == '[' && unit.find(']') == unit.size() - 1 &&
                                           unit.find_first_of("'\"\\") == std::string_view::npos);
  if (error != std::errc() || !sound_unit) fail("its dtype " + quoted(dtype) + " is not known");
  array.item_bytes = item_bytes(array.kind, size, dtype);
  array.big_endian = dtype[0] == '>';
  const bool has_order = array.item_bytes > 1 && array.kind != 'S' && array.kind != 'V';
  if (has_order && dtype[0] == '|') fail("its dtype " + quoted(dtype) + " does not say its byte order");
}

/// The bytes that the shape asks for; nothing where they cannot be counted, also of an empty array.
std::optional<std::size_t> data_bytes(const Array& array) {
  std::size_t size = array.item_bytes;
  bool empty = false;
  for (const std::int64_t length : array.shape) {
    empty = empty || length == 0;
    if (length > 0 && __builtin_mul_overflow(size, static_cast<std::size_t>(length), &size)) return std::nullopt;
  }
  return empty ? 0 : size;
}

/// Items in C order from items in Fortran order, where the first index runs fastest.
std::string in_c_order(const Array& array, std::string_view items) {
  std::string result;
  result.reserve(items.size());
  const std::size_t dimensions = array.shape.size();
  std::vector<std::size_t> strides(dimensions, array.item_bytes);
  for (std::size_t k = 1; k < dimensions; ++k) strides[k] = strides[k - 1] * static_cast<std::size_t>(array.shape[k - 1]);
  std::vector<std::int64_t> index(dimensions, 0);
  std::size_t from = 0;
  while (result.size() < items.size()) {
    result.append(items.substr(from, array.item_bytes));
    for (std::size_t k = dimensions; k-- > 0;) {
      from += strides[k];
      if (++index[k] < array.shape[k]) break;
      from -= strides[k] * static_cast<std::size_t>(array.shape[k]);
      index[k] = 0;
    }
  }
  return result;
}

/// Cuts the header off and returns it.
std::string_view take_header(std::string_view& bytes) {
  constexpr std::string_view magic = "\x93NUMPY";
  constexpr std::size_t preamble = 8;
  if (!bytes.starts_with(magic)) fail("it is no NPY file");
  if (bytes.size() < preamble) fail("it ends within its header");
  const char version = bytes[6];
  if (version < 1 || version > 3) fail("its version of NPY is not known");
  const std::size_t width = version == 1 ? 2 : 4;
  if (bytes.size() < preamble + width) fail("it ends within its header");
  std::size_t length = 0;
  for (std::size_t i = width; i-- > 0;) length = 256 * length + static_cast<unsigned char>(bytes[preamble + i]);
  bytes.remove_prefix(preamble + width);
  if (length > longest_header) fail("its header is longer than " + std::to_string(longest_header) + " bytes");
  if (bytes.size() < length) fail("it ends within its header");
  const std::string_view header = bytes.substr(0, length);
  bytes.remove_prefix(length);
  return header;
}

}  // namespace

Array decode_npy(std::string file) {
  std::string_view bytes = file;
  Header header = HeaderParser(take_header(bytes)).parse();
  Array array;
  array.dtype = std::move(header.dtype);
  array.shape = std::move(header.shape);
  read_dtype(array);
  if (array.shape.empty()) fail("it has no dimensions, so no rows");
  const auto size = data_bytes(array);
  if (!size || *size > bytes.size()) fail("it ends before its last item");
  if (*size < bytes.size()) fail("it has " + std::to_string(bytes.size() - *size) + " bytes more than its shape asks for");
  if (header.fortran_order && array.shape.size() > 1) {
    array.bytes = in_c_order(array, bytes);
  } else {
    file.erase(0, file.size() - bytes.size());
    array.bytes = std::move(file);
  }
  return array;
}

}  // namespace spherematch
