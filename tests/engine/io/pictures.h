// PNG files read back, for the tests of pictures.
#pragma once

#include <gtest/gtest.h>
#include <png.h>

#include <string>

#include "engine/io/renderer.h"

namespace spherematch::test {

/// Expects a PNG file with the channels that pictures on this background have.
inline Image decoded_png(const std::string& bytes, Background background = Background::white) {
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  EXPECT_NE(png_image_begin_read_from_memory(&header, bytes.data(), bytes.size()), 0) << header.message;
  const png_uint_32 format = background == Background::white ? PNG_FORMAT_RGB : PNG_FORMAT_RGBA;
  EXPECT_EQ(header.format, format);
  header.format = format;
  Image image(static_cast<int>(header.width), static_cast<int>(header.height), background);
  EXPECT_NE(png_image_finish_read(&header, nullptr, image.pixels.data(), 0, nullptr), 0) << header.message;
  return image;
}

}  // namespace spherematch::test
