// NPY in and out.
#include <gtest/gtest.h>

#include <cstring>
#include <numeric>

#include "engine/data/error.h"
#include "engine/io/array_reader.h"
#include "engine/io/array_writer.h"

namespace spherematch {
namespace {

/// A file of the given header, padded as NumPy does, and items.
std::string npy(const std::string& header, const std::string& items, int version = 1) {
  std::string file = std::string("\x93NUMPY") + static_cast<char>(version) + '\0';
  const std::string text = header + '\n';
  for (int i = 0; i < (version == 1 ? 2 : 4); ++i) file += static_cast<char>(text.size() >> (8 * i) & 0xFF);
  return file + text + items;
}

std::string header(const std::string& dtype, const std::string& shape, const std::string& fortran_order = "False") {
  return "{'descr': '" + dtype + "', 'fortran_order': " + fortran_order + ", 'shape': (" + shape + "), }";
}

std::string counted(std::size_t count) {
  std::string items(count, '\0');
  std::iota(items.begin(), items.end(), '\0');
  return items;
}

std::string refusal(const std::string& file) {
  try {
    (void)decode_npy(file);
  } catch (const EngineError& error) {
    EXPECT_EQ(error.code(), ErrorCode::malformed_array);
    return error.what();
  }
  return "accepted";
}

void expect_refused(const std::string& file, const std::string& reason) {
  EXPECT_NE(refusal(file).find(reason), std::string::npos) << refusal(file) << ", expected '" << reason << "': " << file.substr(0, 200);
}

TEST(Array, ReadsWhatItWrites) {
  for (const std::vector<std::int64_t>& shape : {std::vector<std::int64_t>{6}, {6, 1}, {2, 3}, {1, 2, 3}, {6, 0}, {0}, {0, 7}}) {
    Array array{.dtype = "<i2", .kind = 'i', .item_bytes = 2, .big_endian = false, .shape = shape, .bytes = {}};
    std::size_t items = 2;
    for (const std::int64_t length : shape) items *= static_cast<std::size_t>(length);
    array.bytes = counted(items);
    const std::string file = encode_npy(array);
    EXPECT_EQ((file.size() - items) % 64, 0U);
    const Array read = decode_npy(file);
    EXPECT_EQ(read.dtype, array.dtype);
    EXPECT_EQ(read.shape, array.shape);
    EXPECT_EQ(read.bytes, array.bytes);
    EXPECT_EQ(read.item_bytes, 2U);
  }
}

TEST(Array, EveryPlainDtypeIsRead) {
  for (const auto& [dtype, size] : std::vector<std::pair<std::string, std::size_t>>{
           {"|b1", 1}, {"|i1", 1}, {"|u1", 1},     {"<u1", 1},      {"<i2", 2},   {">u4", 4}, {"<i8", 8},
           {"<f2", 2}, {">f4", 4}, {"<f8", 8},     {"<c8", 8},      {">c16", 16}, {"|S5", 5}, {"<U3", 12},
           {">U1", 4}, {"|V7", 7}, {"<M8[ns]", 8}, {">m8[25s]", 8}, {"<M8", 8},   {"|S1", 1}}) {
    const Array array = decode_npy(npy(header(dtype, "2,"), counted(2 * size)));
    EXPECT_EQ(array.dtype, dtype);
    EXPECT_EQ(array.kind, dtype[1]);
    EXPECT_EQ(array.item_bytes, size) << dtype;
    EXPECT_EQ(array.row_bytes(), size) << dtype;
    EXPECT_EQ(array.big_endian, dtype[0] == '>');
    EXPECT_EQ(array.bytes, counted(2 * size));
  }
}

TEST(Array, OtherDtypesAreRefused) {
  expect_refused(npy(header("|O", "2,"), ""), "objects");
  expect_refused(npy("{'descr': [('x', '<f4')], 'fortran_order': False, 'shape': (2,), }", counted(8)), "structured");
  expect_refused(npy("{'descr': ('<f4', (2,)), 'fortran_order': False, 'shape': (2,), }", counted(16)), "header");
  for (const char* dtype : {"<f16", ">f12"}) expect_refused(npy(header(dtype, "2,"), counted(32)), "differ between machines");
  for (const char* dtype : {"|f4", "|U2", "|i8", "|M8[s]"}) expect_refused(npy(header(dtype, "2,"), counted(16)), "byte order");
  for (const char* dtype :
       {"",    "f",   "f4",  "<f",  "<f3",  "<f1",    "<i16", "<i0",   "|S0",     "<U0",    "|V0", "|S-1",         "|S99999999999999999999",
        "<b2", "|b2", "<x4", "=f4", "<f4x", "<f4[s]", "<M8[", "<M8[s", "<M8[s]s", "<M4[s]", "<c4", "|S4294967296", " <f4",
        "<f4 "}) {
    EXPECT_NE(refusal(npy(header(dtype, "2,"), counted(8))).find("dtype"), std::string::npos) << dtype;
  }
}

TEST(Array, FortranOrderBecomesCOrder) {
  // Item (i, j, k) of a (2, 3, 4) array stands at i + 2 (j + 3 k).
  const std::string items = counted(24);
  const Array array = decode_npy(npy(header("|u1", "2, 3, 4", "True"), items));
  std::size_t at = 0;
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 4; ++k) EXPECT_EQ(array.bytes.at(at++), i + 2 * (j + 3 * k));
  const Array wide = decode_npy(npy(header("<i2", "2, 2", "True"), counted(8)));
  EXPECT_EQ(wide.bytes, std::string("\0\1\4\5\2\3\6\7", 8));
  EXPECT_EQ(decode_npy(npy(header("|u1", "4,", "True"), counted(4))).bytes, counted(4));
  EXPECT_EQ(decode_npy(npy(header("|u1", "4, 0, 9", "True"), "")).bytes, "");
}

TEST(Array, EveryVersionAndSpellingOfTheHeaderIsRead) {
  for (const int version : {1, 2, 3}) EXPECT_EQ(decode_npy(npy(header("<f4", "2,"), counted(8), version)).rows(), 2);
  for (const std::string& text : {std::string(R"({"shape":(2,),"descr":"<f4","fortran_order":False})"),
                                  std::string("  {'fortran_order' : False ,\n 'shape' : ( 2 , ) , 'descr' : '<f4'}  "),
                                  std::string("{'descr': '<f4', 'fortran_order': False, 'shape': (2), }")}) {
    EXPECT_EQ(decode_npy(npy(text, counted(8))).rows(), 2) << text;
  }
}

TEST(Array, HostileHeadersAreRefused) {
  for (const std::string& text : {std::string(),
                                  std::string("{"),
                                  std::string("{}"),
                                  std::string("[]"),
                                  std::string("1"),
                                  std::string("{'descr'"),
                                  std::string("{'descr':"),
                                  std::string("{'descr': '<f4', 'fortran_order': False}"),
                                  std::string("{'shape': (2,), 'fortran_order': False}"),
                                  header("<f4", "2,") + "x",
                                  header("<f4", "2,") + header("<f4", "2,"),
                                  std::string("{'descr': '<f4' 'fortran_order': False, 'shape': (2,)}"),
                                  std::string("{'descr': '<f4', 'descr': '<f4', 'fortran_order': False, 'shape': (2,)}"),
                                  std::string("{'descr': '<f4', 'fortran_order': False, 'shape': (2,), 'more': 1}"),
                                  header("<f4", "2,", "0"),
                                  header("<f4", "2,", "true"),
                                  header("<f4", "2, 'x'"),
                                  header("<f4", "2 2"),
                                  header("<f4", "(2,),"),
                                  header("<f4", ",2"),
                                  header("<f4", "2.0,"),
                                  header("<f4", "0x2,"),
                                  std::string("{'descr': '<f4', 'fortran_order': False, 'shape': [2]}"),
                                  std::string("{'descr': {'a': 1}, 'fortran_order': False, 'shape': (2,)}"),
                                  std::string("{'descr': '<f4, 'fortran_order': False, 'shape': (2,)}"),
                                  std::string(3000, '{'),
                                  std::string(3000, '(')}) {
    EXPECT_NE(refusal(npy(text, counted(8))).find("header"), std::string::npos) << text;
  }
  expect_refused(npy(std::string("{'descr': '<f4', 'fortran_order': False, 'shape': (2,)}\0", 56), counted(8)), "header");
}

TEST(Array, HostileShapesAreRefused) {
  expect_refused(npy(header("<f4", "-2,"), counted(8)), "negative");
  expect_refused(npy(header("<f4", "99999999999999999999,"), counted(8)), "64 bits");
  expect_refused(npy(header("<f4", ""), counted(4)), "no dimensions");
  for (const char* shape : {"9223372036854775807,", "4611686018427387904, 4", "1000000000, 1000000000, 1000000000", "3,", "1, 3"}) {
    expect_refused(npy(header("<f4", shape), counted(8)), "ends before its last item");
  }
  // An array without items whose lengths cannot be multiplied: NumPy refuses it too.
  expect_refused(npy(header("<f4", "0, 9223372036854775807, 9223372036854775807"), ""), "ends before");
  std::string many = "1";
  for (int i = 1; i < 40; ++i) many += ", 1";
  expect_refused(npy(header("<f4", many), counted(4)), "dimensions");
  EXPECT_EQ(decode_npy(npy(header("|u1", "0, 9223372036854775807"), "")).rows(), 0);
  EXPECT_EQ(decode_npy(npy(header("|u1", "9223372036854775807, 0"), "")).rows(), 9223372036854775807);
}

TEST(Array, TheFileEndsWithItsLastItem) {
  const std::string whole = npy(header("<f4", "3,"), counted(12));
  for (std::size_t length = 0; length < whole.size(); ++length) EXPECT_NE(refusal(whole.substr(0, length)), "accepted") << length;
  expect_refused(whole + "x", "1 bytes more");
  expect_refused("no NPY", "no NPY file");
  expect_refused(std::string("\x93NUMPY\x04\0\x01\0{}", 12), "version");
  std::string long_header = npy(header("<f4", "3,") + std::string(70'000, ' '), counted(12), 2);
  expect_refused(long_header, "longer than 65536");
}

TEST(Array, ChangedFilesNeverCrash) {
  const std::string whole = npy(header("<f4", "2, 3", "True"), counted(24));
  int accepted = 0;
  for (std::size_t at = 0; at < whole.size(); ++at) {
    for (int value = 0; value < 256; value += 5) {
      std::string changed = whole;
      changed[at] = static_cast<char>(value);
      if (refusal(changed) == "accepted") ++accepted;
    }
  }
  EXPECT_GT(accepted, 0);
}

TEST(ArrayWriter, HeadersAreNumPys) {
  const auto head = [](std::span<const std::int64_t> shape) { return encode_npy("<f4", shape, {}); };
  EXPECT_NE(head(std::array<std::int64_t, 1>{5}).find("{'descr': '<f4', 'fortran_order': False, 'shape': (5,), }"), std::string::npos);
  EXPECT_NE(head(std::array<std::int64_t, 2>{5, 3}).find("'shape': (5, 3), }"), std::string::npos);
  EXPECT_NE(head(std::array<std::int64_t, 3>{5, 0, 1}).find("'shape': (5, 0, 1), }"), std::string::npos);
}

}  // namespace
}  // namespace spherematch
